//! Time by stage and peak memory over boards of 10 to 10⁶ features:
//! `cargo bench --bench scale [-- FEATURES…]`; and of a panel of 300 × 300 mm at 5 µm, 3.6
//! gigapixels: `cargo bench --bench scale -- panel`; and of so many features in one place:
//! `cargo bench --bench scale -- 10000x 1000000x`.
//!
//! A plain program: each size runs in a process of its own, so that its peak memory can be told.
//! Without sizes it takes 10 to 100 000; a million takes some minutes. Times are seconds on all
//! cores; the CPU time of a feature, in which nets and gap are counted twice, depends less on what
//! else the machine does.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

mod synthetic;
mod usage;

use std::path::Path;
use std::process::Command;
use std::time::Instant;

use voromill::board::Side;
use voromill::geometry::Nm;
use voromill::import;
use voromill::job::{self, Length, Options, Settings};
use voromill::topology::{self, Method};

use usage::{cpu_seconds, peak_mib};

/// Names the board to the process that mills it.
const ONE: &str = "VOROMILL_SCALE_ONE";

fn main() {
    if let Some(board) = std::env::var_os(ONE) {
        return one(board.to_str().expect("a number, with or without `x`, or `panel`"));
    }
    let is_count = |text: &str| text.parse::<u32>().is_ok();
    let is_board =
        |text: &String| text == "panel" || is_count(text) || text.strip_suffix('x').is_some_and(is_count);
    let asked = std::env::args().skip(1).filter(is_board);
    let mut boards: Vec<String> = asked.collect();
    if boards.is_empty() {
        boards = ["10", "100", "1000", "10000", "100000"].map(str::to_owned).to_vec();
    }
    println!("features       read     nets      gap     rest    total  CPU µs/feature  peak MiB");
    for board in boards {
        let own = std::env::current_exe().expect("a program has a name");
        let status = Command::new(own).env(ONE, &board).status().expect("it starts");
        assert!(status.success(), "a board of {board} features is milled");
    }
}

/// Mills one board, stage by stage first and then as a whole.
fn one(board: &str) {
    let is_panel = board == "panel";
    let number = |text: &str| text.parse().expect("a number");
    let (text, features) = match board.strip_suffix('x') {
        Some(count) => (synthetic::coincident(number(count)), number(count)),
        None if is_panel => synthetic::panel(30),
        None => synthetic::gerber(number(board)),
    };
    let pixel = is_panel.then(|| Length(Nm::from_um(5)));
    let folder = std::env::temp_dir().join(format!("voromill-scale-{board}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder to write to");
    let path = folder.join("synthetic.gbr");
    std::fs::write(&path, text).expect("writable");
    let start = cpu_seconds();
    let [read, nets, gap, rest] = stages(&path, pixel);
    let spent = start.and_then(|start| Some(cpu_seconds()? - start));
    std::fs::remove_dir_all(&folder).expect("ours");
    let total = read + nets + gap + rest;
    #[expect(clippy::cast_precision_loss, reason = "a count of features")]
    let each = spent.map(|spent| spent * 1e6 / features as f64);
    let told = |figure: Option<f64>| figure.map_or("?".to_owned(), |figure| format!("{figure:.0}"));
    println!(
        "{features:8} {read:10.4} {nets:8.4} {gap:8.4} {rest:8.3} {total:8.3} {:>15} {:>9}",
        told(each),
        told(peak_mib())
    );
}

/// Seconds to read the file, to find the nets, the smallest gap, and for all that comes after.
fn stages(path: &Path, pixel: Option<Length>) -> [f64; 4] {
    let (loaded, read) = timed(|| import::load_copper(path, Side::Front).expect("a good file"));
    let copper = loaded.board.copper(Side::Front).expect("a front");
    let (found, nets) = timed(|| topology::recover(copper, Method::Contact));
    let (_, gap) = timed(|| topology::smallest_gap(copper, &found));
    drop(found);
    let settings = Settings::resolve(Options { pixel, ..Options::default() }).expect("the defaults");
    let (_, whole) = timed(|| job::mill(loaded, &settings).expect("it is milled"));
    [read, nets, gap, whole - nets - gap]
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let made = work();
    (made, start.elapsed().as_secs_f64())
}
