//! Boundaries by stage, over boards: `cargo bench --bench voronoi [-- BOARD…]`, where a board is
//! the name of one of `fixtures/boards` or a number of features for a synthetic one.
//!
//! * *diagram*: what `Diagram::new` takes;
//! * *boundaries*: what `Diagram::boundaries` takes beside that and fitting;
//! * *fit*: lines and arcs through all places.
//!
//! A plain program: each board runs in a process of its own, on one thread, so that
//! its peak memory can be told and its time be that of the processor, whatever else the machine
//! does.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

mod synthetic;
mod usage;

use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

use voromill::board::{Board, Side};
use voromill::geometry::{Nm, Point};
use voromill::import::{self, Selection};
use voromill::topology::{self, Method};
use voromill::voronoi::{Diagram, Settings, fit_points};

use usage::{cpu_seconds, peak_mib};

/// Names the board to the process that measures it.
const ONE: &str = "VOROMILL_VORONOI_ONE";
/// Each stage is repeated for so many CPU seconds.
const ENOUGH: f64 = 0.5;

/// What is measured of one board.
struct Figures {
    /// CPU seconds for the diagram, for boundaries, for fitting, and for all of it.
    seconds: [f64; 4],
    /// Peak resident memory in MiB.
    peak: f64,
}

fn main() {
    if let Some(asked) = std::env::var_os(ONE) {
        return one(&asked.into_string().expect("a board"));
    }
    let mut boards: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    if boards.is_empty() {
        boards = ["regulator", "qfn-breakout", "1000", "10000"].map(str::to_owned).to_vec();
    }
    println!("| board | diagram s | boundaries s | fit s | all s | peak MiB |");
    println!("|---|---|---|---|---|---|");
    for board in boards {
        let Figures { seconds: [diagram, boundaries, fitted, all], peak } = measured(&board);
        println!("| {board} | {diagram:.4} | {boundaries:.4} | {fitted:.5} | {all:.4} | {peak:.1} |");
    }
}

/// The figures of a process of its own.
fn measured(board: &str) -> Figures {
    let own = std::env::current_exe().expect("a program has a name");
    let output = Command::new(own).env(ONE, board).output().expect("it starts");
    let text = String::from_utf8_lossy(&output.stdout);
    let numbers: Vec<f64> = text.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let [diagram, boundaries, fitted, all, peak] = numbers[..] else {
        panic!("{board}: {}", String::from_utf8_lossy(&output.stderr))
    };
    Figures { seconds: [diagram, boundaries, fitted, all], peak }
}

/// Measures one board and prints the figures.
fn one(board: &str) {
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    alone.build_global().expect("the first pool");
    let board = load(board);
    let copper = board.copper(Side::Front).expect("a front");
    let nets = topology::recover(copper, Method::Contact);
    let settings = Settings::default();
    let diagram = || Diagram::new(copper, &nets, board.outline.as_ref(), &settings).expect("a diagram");
    // Boundaries first: what is asked for after them must not count as their peak.
    let all = mean(|| _ = black_box(diagram().boundaries()));
    let peak = peak_mib().expect("a Linux");
    let found = mean(|| _ = black_box(diagram()));
    // With a tolerance of a nanometre every place is a vertex.
    let bare = Settings { tolerance: Nm::new(1), arcs: false, ..settings.clone() };
    let placed = Diagram::new(copper, &nets, board.outline.as_ref(), &bare)
        .expect("a diagram")
        .boundaries()
        .expect("whole boundaries");
    let lines: Vec<Vec<Point>> = placed.edges.iter().map(|edge| edge.path.flatten(Nm::new(1))).collect();
    let fit = |line: &Vec<Point>| _ = black_box(fit_points(line.iter().copied(), settings.tolerance));
    let fitted = mean(|| lines.iter().for_each(fit));
    println!("{found} {} {fitted} {all} {peak}", all - found - fitted);
}

fn load(board: &str) -> Board {
    let Ok(features) = board.parse() else {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(board);
        return import::load(&[folder], &Selection::default()).expect("a board of ours").board;
    };
    let folder = std::env::temp_dir().join(format!("voromill-voronoi-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder to write to");
    let path = folder.join("synthetic.gbr");
    fs::write(&path, synthetic::gerber(features).0).expect("writable");
    let loaded = import::load_copper(Path::new(&path), Side::Front).expect("a good file");
    fs::remove_dir_all(&folder).expect("ours");
    loaded.board
}

/// CPU seconds of a round, in the mean of as many as take half a second: the system counts in ticks
/// of some milliseconds.
fn mean(mut work: impl FnMut()) -> f64 {
    let start = cpu_seconds().expect("a Linux");
    let mut rounds = 0.0;
    loop {
        work();
        rounds += 1.0;
        let spent = cpu_seconds().expect("a Linux") - start;
        if spent >= ENOUGH {
            return spent / rounds;
        }
    }
}
