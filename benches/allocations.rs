//! How much memory each stage asks for, how often, and how many pixels are drawn, over boards of 10
//! to 10⁴ features: `cargo bench --bench allocations`.
//!
//! A plain program of its own, because counting has a price that the times of other benchmarks
//! should not pay. On one thread the counts are the same in every run but for what the runtime
//! itself allocates.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

mod synthetic;

use std::alloc::System;
use std::path::Path;

use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use voromill::board::Side;
use voromill::import;
use voromill::job::{self, Options, Settings};
use voromill::topology::{self, Method};
use voromill::voronoi::{self, Diagram};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

fn main() {
    println!("features  stage       requests    a feature       KiB in all");
    for size in [10, 100, 1000, 10_000] {
        let (text, features) = synthetic::gerber(size);
        let folder = std::env::temp_dir().join(format!("voromill-allocations-{size}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder to write to");
        let path = folder.join("synthetic.gbr");
        std::fs::write(&path, text).expect("writable");
        stages(&path, features);
        std::fs::remove_dir_all(&folder).expect("ours");
    }
}

/// Prints a line for each stage of one board.
fn stages(path: &Path, features: usize) {
    let loaded = counted(features, "read", || import::load_copper(path, Side::Front).expect("a good file"));
    let copper = loaded.board.copper(Side::Front).expect("a front");
    let nets = counted(features, "nets", || topology::recover(copper, Method::Contact));
    let settings = voronoi::Settings::default();
    let diagram =
        counted(features, "diagram", || Diagram::new(copper, &nets, None, &settings).expect("a small board"));
    drop(counted(features, "boundaries", || diagram.boundaries()));
    drop((diagram, nets));
    let settings = Settings::resolve(Options::default()).expect("the defaults");
    drop(counted(features, "all of it", || job::mill(loaded, &settings).expect("it is milled")));
}

fn counted<T>(features: usize, stage: &str, work: impl FnOnce() -> T) -> T {
    let region = Region::new(ALLOCATOR);
    let made = work();
    let change = region.change();
    let requests = change.allocations + change.reallocations;
    #[expect(clippy::cast_precision_loss, reason = "counts")]
    let each = requests as f64 / features as f64;
    println!("{features:8}  {stage:10} {requests:9} {each:12.2} {:16}", change.bytes_allocated / 1024);
    made
}
