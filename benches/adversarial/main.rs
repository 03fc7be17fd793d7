//! How time and memory grow on boards that are made to be hard:
//! `cargo bench --bench adversarial [-- MEMBER…]`.
//!
//! A plain program: each member of the family is milled and judged at its least size, at four times
//! and at sixteen times as many, each in a process of its own. Times are CPU seconds; an exponent
//! is that of growth over the factor of sixteen, 1 where time grows as the board does. A member
//! that takes longer than [`PATIENCE`] is ended, and stands as `-`. `-- --write FOLDER MEMBER SIZE`
//! writes the files of one board instead.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

mod boards;
#[path = "../usage/mod.rs"]
mod usage;

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use voromill::import::{self, Selection};
use voromill::job::{self, Options, Settings};

use boards::{FAMILY, Member};
use usage::{cpu_seconds, cpu_seconds_of, peak_mib};

/// Names the folder to the process that mills it.
const ONE: &str = "VOROMILL_ADVERSARIAL_ONE";

/// How many CPU seconds one board may take.
const PATIENCE: f64 = 60.0;

/// How many times as many each size has.
const FACTORS: [u32; 3] = [1, 4, 16];

/// What one board took.
#[derive(Clone, Copy)]
struct Taken {
    /// Seconds to read, to make the programs, to judge them.
    seconds: [f64; 3],
    mib: f64,
}

fn main() {
    if let Some(folder) = std::env::var_os(ONE) {
        return one(Path::new(&folder));
    }
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    if let [option, folder, name, size] = &arguments[..]
        && option == "--write"
    {
        let member = FAMILY.iter().find(|member| member.name == name).expect("a member of the family");
        return write(*member, size.parse().expect("a number"), Path::new(folder));
    }
    println!("| | least | read s | made s | judged s | MiB | read ^ | made ^ | judged ^ | MiB ^ |");
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let asked = |member: &Member| arguments.is_empty() || arguments.iter().any(|name| name == member.name);
    for member in FAMILY.into_iter().filter(asked) {
        grow(member);
    }
}

/// Prints how a member grows.
fn grow(member: Member) {
    let taken = FACTORS.map(|factor| measured(member, member.least * factor));
    let column = |of: &dyn Fn(&Taken) -> f64, digits: usize| {
        let each = taken.iter().map(|one| one.map_or("-".to_owned(), |one| format!("{:.digits$}", of(&one))));
        each.collect::<Vec<_>>().join(", ")
    };
    let exponent = |of: &dyn Fn(&Taken) -> f64| match (taken[0], taken[2]) {
        (Some(least), Some(most)) => format!("{:.2}", libm::log2(of(&most) / of(&least)) / 4.0),
        _ => "-".to_owned(),
    };
    let stages: [&dyn Fn(&Taken) -> f64; 3] =
        [&|taken| taken.seconds[0], &|taken| taken.seconds[1], &|taken| taken.seconds[2]];
    let mib = |taken: &Taken| taken.mib;
    println!(
        "| {}: {} | {} | {} | {} | {} |",
        member.name,
        member.of,
        member.least,
        stages.map(|stage| column(stage, 3)).join(" | "),
        column(&mib, 0),
        stages.map(exponent).into_iter().chain([exponent(&mib)]).collect::<Vec<_>>().join(" | ")
    );
}

/// Writes a board's files.
fn write(member: Member, size: u32, folder: &Path) {
    std::fs::create_dir_all(folder).expect("a folder to write to");
    for (name, text) in member.files(size) {
        std::fs::write(folder.join(name), text).expect("writable");
    }
}

/// What a board of this size takes, in a process of its own; none where it does not end in time.
fn measured(member: Member, size: u32) -> Option<Taken> {
    let folder: PathBuf =
        std::env::temp_dir().join(format!("voromill-{}-{size}-{}", member.name, std::process::id()));
    write(member, size, &folder);
    let own = std::env::current_exe().expect("a program has a name");
    let mut child = Command::new(own).env(ONE, &folder).stdout(Stdio::piped()).spawn().expect("it starts");
    while child.try_wait().expect("it can be waited for").is_none() {
        if cpu_seconds_of(&child.id().to_string()).is_some_and(|seconds| seconds > PATIENCE) {
            child.kill().expect("it can be ended");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    let output = child.wait_with_output().expect("it ended");
    std::fs::remove_dir_all(&folder).expect("ours");
    let said = String::from_utf8_lossy(&output.stdout);
    let figures: Vec<f64> = said.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let &[read, made, judged, mib] = &figures[..] else { return None };
    Some(Taken { seconds: [read, made, judged], mib })
}

/// Reads, mills and judges one board.
fn one(folder: &Path) {
    let timed = || cpu_seconds().expect("a Linux");
    let settings = Settings::resolve(Options::default()).expect("the defaults");
    let start = timed();
    let loaded = import::load(&[folder.to_owned()], &Selection::default()).expect("a good board");
    let read = timed();
    let job = job::mill(loaded, &settings).expect("it is milled");
    let made = timed();
    job.verify(&settings).expect("it is judged");
    let judged = timed();
    let mib = peak_mib().expect("a Linux");
    println!("{:.5} {:.5} {:.5} {mib:.2}", read - start, made - read, judged - made);
}
