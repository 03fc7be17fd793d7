//! The Voronoi graph alone, beside Boost's algorithm (the crate `boostvoronoi`): the CPU time
//! that so many random segments take, for each of them and in units of N·log₂N.
//!
//! The segments do not touch: one in each cell of a square grid, as in the inputs by which
//! OpenVoronoi, Boost and VRONI were compared. Each is an owner of its own, so that both have the
//! same edges but those between a segment and its own ends.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

#[path = "../tests/it/random.rs"]
mod random;
#[path = "../tests/it/segments.rs"]
mod segments;
mod usage;

use std::hint::black_box;

use boostvoronoi::prelude::Builder;
use voromill::geometry::Nm;
use voromill::voronoi::exact::{Diagram, Generators, Kind, Space};

use random::splitmix64;
use segments::{Bare, copper};
use usage::cpu_seconds;

/// The side of a cell in nanometres: what Boost takes are whole numbers of 32 bits.
const CELL: i64 = 8_000_000;
/// The best of so many runs counts.
const RUNS: usize = 5;

/// So many segments, x, y, x, y.
fn scene(count: usize) -> Vec<Bare> {
    let columns = i64::try_from(count).expect("small").isqrt();
    let side = CELL * 100 / columns.max(100);
    let mut seed = 1;
    let mut below = || i64::try_from(splitmix64(&mut seed) >> 33).expect("31 bits") % (side * 9 / 10);
    let cell = |number: i64| {
        let (x, y) = (number % columns * side, number / columns * side);
        [x + below(), y + below(), x + below(), y + below()]
            .map(|place| i32::try_from(place).expect("in 32 bits"))
    };
    (0..i64::try_from(count).expect("small")).map(cell).collect()
}

/// The CPU seconds of a run at best.
fn best<T>(mut run: impl FnMut() -> T) -> f64 {
    let time = |_| {
        let start = cpu_seconds().expect("Linux");
        black_box(run());
        cpu_seconds().expect("Linux") - start
    };
    (0..RUNS).map(time).fold(f64::INFINITY, f64::min)
}

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("a pool of one thread");
    println!("| segments | voromill, µs each | µs by N·log₂N | Boost's, µs each | µs by N·log₂N | ratio |");
    println!("|---|---|---|---|---|---|");
    for count in [128, 512, 2_048, 8_192, 32_768, 131_072] {
        let segments = scene(count);
        let copper = copper(&segments);
        let ours = best(|| {
            let generators = Generators::of_copper(&copper, |i| u32::try_from(i).ok());
            let diagram = Diagram::new(generators, Kind::Owners, Space::Around(Nm::from_mm(1)));
            assert_eq!(diagram.faults(), [], "no end is loose");
            diagram
        });
        let other = best(|| {
            let builder = Builder::<i32>::default().with_segments(segments.iter()).expect("segments");
            builder.build().expect("a diagram")
        });
        let n = Nm::new(i64::try_from(count).expect("small")).to_f64();
        let [ours, other] = [ours, other].map(|seconds| seconds * 1e6 / n);
        let log = n.log2();
        println!(
            "| {count} | {ours:.2} | {:.2} | {other:.2} | {:.2} | {:.2} |",
            ours / log,
            other / log,
            ours / other
        );
    }
}
