//! Judging a board's programs beside making them, in time and in memory:
//! `cargo bench --bench verify [-- BOARD…]`.
//!
//! A plain program: each board is milled in one process, which writes the programs, and these are
//! judged in another, so that the peak memory of each can be told. Both begin with the board as it
//! was read. Times are CPU seconds of all threads, the least of several rounds. The boards are ours
//! and, where there are some, those of `VOROMILL_BOARDS`.
//!
//! Last come programs that nobody would mill, chords and full circles by chance over a whole board
//! (`regulator`): what is cut a hundred times over must take seconds, not hours.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

mod usage;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use voromill::board::Board;
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Settings};
use voromill::verify::{self, Program, verify};

use usage::{cpu_seconds, peak_mib};

/// What a process is to do: `mill` or `judge`; the board is its first argument, the folder of
/// programs the second.
const TASK: &str = "VOROMILL_VERIFY_TASK";

/// Rounds go on until they have taken so many CPU seconds, or there are enough of them.
const ENOUGH: f64 = 0.5;
const ROUNDS: u32 = 20;

fn main() {
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    match std::env::var(TASK).as_deref() {
        Ok("mill") => return mill(Path::new(&arguments[0]), Path::new(&arguments[1])),
        Ok(_) => return judge(Path::new(&arguments[0]), Path::new(&arguments[1])),
        Err(_) => {}
    }
    println!("{:24} {:>9} {:>9} {:>6} {:>8} {:>8} {:>6}", "", "made, s", "judged, s", "", "MiB", "MiB", "");
    let boards = boards().into_iter().filter(|(name, _)| arguments.is_empty() || arguments.contains(name));
    for (name, board) in boards {
        let folder = std::env::temp_dir().join(format!("voromill-verify-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder to write to");
        let [made, judged] = ["mill", "judge"].map(|task| measured(task, &board, &folder));
        std::fs::remove_dir_all(&folder).expect("ours");
        let [time, memory] = [judged.0 / made.0, judged.1 / made.1];
        println!(
            "{name:24} {:9.4} {:9.4} {time:6.2} {:8.1} {:8.1} {memory:6.2}",
            made.0, judged.0, made.1, judged.1
        );
    }
    crowds(&arguments);
}

/// Programs that cut the same places over and over: what of, and how many.
const CROWDS: [(&str, u32); 4] =
    [("chords", 10_000), ("chords", 100_000), ("circles", 10_000), ("circles", 20_000)];

/// Judges [`CROWDS`], those among `wanted` where there are any.
fn crowds(wanted: &[String]) {
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/regulator");
    for (kind, count) in CROWDS {
        let name = format!("{kind}-{count}");
        if !wanted.is_empty() && !wanted.contains(&name) {
            continue;
        }
        let folder = std::env::temp_dir().join(format!("voromill-verify-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder to write to");
        std::fs::write(folder.join("crowd.ngc"), crowd(kind, count, &board)).expect("writable");
        let (seconds, mib) = measured("judge", &board, &folder);
        std::fs::remove_dir_all(&folder).expect("ours");
        println!("{name:24} {:>9} {seconds:9.4} {:6} {:>8} {mib:8.1}", "", "", "");
    }
}

/// So many cuts by chance over a board, the same every time.
fn crowd(kind: &str, count: u32, board: &Path) -> String {
    let bounds = load(board).board.bounds().expect("a board has bounds");
    let mut seed = 7_u64;
    let mut chance = |from: f64, to: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let share = f64::from(u32::try_from(seed >> 33).expect("31 bits")) / f64::from(1_u32 << 31);
        from + (to - from) * share
    };
    let mut text =
        "(crowd front isolation)\n(origin keep)\n(tool endmill:0.2mm)\nG21 G90 G17 F100\nM3 S1000\nG0 Z2\n"
            .to_owned();
    for _ in 0..count {
        let ends = [0, 1].map(|_| {
            let x = chance(bounds.min().x.to_mm(), bounds.max().x.to_mm());
            [x, chance(bounds.min().y.to_mm(), bounds.max().y.to_mm())]
        });
        let _ = match kind {
            "chords" => {
                let [[x, y], [to_x, to_y]] = ends;
                writeln!(text, "G0 X{x:.4} Y{y:.4}\nG1 Z-0.1\nG1 X{to_x:.4} Y{to_y:.4}\nG0 Z2")
            }
            _ => {
                let ([x, y], radius) = (ends[0], chance(0.5, 10.0));
                writeln!(
                    text,
                    "G0 X{:.4} Y{y:.4}\nG1 Z-0.1\nG2 X{:.4} Y{y:.4} I{:.4} J0\nG0 Z2",
                    x + radius,
                    x + radius,
                    -radius
                )
            }
        };
    }
    text + "M5\nM2\n"
}

/// Names and folders, ours first.
fn boards() -> Vec<(String, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let theirs = std::env::var_os("VOROMILL_BOARDS").map_or(root.join("../shared/boards"), PathBuf::from);
    let within = |folder: &Path, holds: &str| {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
        let mut found: Vec<PathBuf> =
            entries.filter(|path| path.is_dir() && path.join(holds).exists()).collect();
        found.sort();
        found
    };
    let ours = within(&root.join("fixtures/boards"), "");
    let name = |path: PathBuf| Some((path.file_name()?.to_str()?.to_owned(), path));
    ours.into_iter().chain(within(&theirs, "meta.json")).filter_map(name).collect()
}

/// CPU seconds and MiB of a task in a process of its own.
fn measured(task: &str, board: &Path, folder: &Path) -> (f64, f64) {
    let own = std::env::current_exe().expect("a program has a name");
    let output = Command::new(own).env(TASK, task).arg(board).arg(folder).output().expect("it starts");
    let told = String::from_utf8_lossy(&output.stdout);
    let mut figures = told.split_whitespace().filter_map(|word| word.parse().ok());
    match (figures.next(), figures.next()) {
        (Some(seconds), Some(mib)) => (seconds, mib),
        _ => panic!("{task} of {}: {}", board.display(), String::from_utf8_lossy(&output.stderr)),
    }
}

/// Makes the programs, and writes them into `folder`.
fn mill(board: &Path, folder: &Path) {
    let settings = Settings::resolve(Options::default()).expect("the defaults");
    let made = rounds(|| job::mill(load(board), &settings).expect("it is milled"));
    for program in &made.programs {
        let name = program.file_name(&made.board.name, &settings);
        std::fs::write(folder.join(name), &program.text).expect("writable");
    }
}

/// Judges the programs in `folder`.
fn judge(board: &Path, folder: &Path) {
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(folder).expect("programs").flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let program = |path: &PathBuf| Program {
        file: path.display().to_string(),
        text: std::fs::read_to_string(path).expect("it was written"),
        ..Program::default()
    };
    let programs: Vec<Program> = paths.iter().map(program).collect();
    let board: Board = load(board).board;
    rounds(|| verify(&programs, &board, &[], &verify::Settings::default()).expect("it is judged"));
}

fn load(board: &Path) -> import::Loaded {
    // One board has a file that does not tell its side.
    import::survey(&[board.to_owned()], &Selection::default()).expect("a good board")
}

/// Does it several times, and prints the CPU seconds that the quickest took, and the peak memory in
/// MiB.
fn rounds<T>(work: impl Fn() -> T) -> T {
    let (mut spent, mut least) = (0.0, f64::INFINITY);
    let mut last = None;
    for _ in 0..ROUNDS {
        let start = cpu_seconds().expect("a Linux");
        last = Some(work());
        let took = cpu_seconds().expect("a Linux") - start;
        spent += took;
        least = least.min(took);
        if spent >= ENOUGH {
            break;
        }
    }
    println!("{least:.6} {:.1}", peak_mib().expect("a Linux"));
    last.expect("at least one round")
}
