//! The raster engine's figures, as ratios measured in one run: `cargo bench --bench raster`, or a
//! part of them: `-- picture`, `pick`, `growth`, `doubling`.
//!
//! A plain program rather than a Criterion suite, because what counts are ratios between two things
//! done in turns on the same warm memory, and peak memory. Times are the least of several rounds.
//! `VOROMILL_PEERS=FOLDER` writes the scenes and pictures instead that `benches/peers/raster.py`
//! holds others against.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

mod usage;

#[path = "../tests/it/random.rs"]
mod random;

use std::path::Path;
use std::time::Instant;

use rayon::prelude::*;
use voromill::raster::{
    Buffers, Caps, Label, Options, Picker, PixelPoint, Scene, Sides, SubPx, Surface, render, stream,
};

use random::splitmix64;

/// SplitMix64: the same scene on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: i32) -> i32 {
        let high = splitmix64(&mut self.0) >> 32;
        i32::try_from((high * u64::from(limit.unsigned_abs())) >> 32).expect("below the limit")
    }
}

/// `count` segments of up to `length` pixels along x and y in a square picture, each with its own
/// label or all under `labels`.
fn segments(side: u32, count: u32, length: i32, labels: u32) -> Scene {
    limited_segments(side, count, length, labels, None).1
}

/// The same and their ends as x, y, x, y in pixels, their distances drawn up to a limit.
fn limited_segments(
    side: u32,
    count: u32,
    length: i32,
    labels: u32,
    limit: Option<f32>,
) -> (Vec<[f64; 4]>, Scene) {
    let mut random = Random(u64::from(count));
    let mut scene = Scene::new(side, side);
    let side = side.cast_signed() * SubPx::STEPS;
    let reach = length * SubPx::STEPS;
    let mut lines = Vec::new();
    for number in 0..count {
        let (x, y) = (random.below(side), random.below(side));
        let mut end = |at: i32| (at + random.below(2 * reach) - reach).clamp(0, side);
        let ends = [x, y, end(x), end(y)];
        let [from, to] = [0, 2].map(|i| PixelPoint::new(SubPx::new(ends[i]), SubPx::new(ends[i + 1])));
        let (caps, sides) = (Caps::Both, Sides::Both);
        scene.add(Label(1 + number % labels), Surface::Curtain { from, to, caps, sides, offset: 0.0, limit });
        lines.push(ends.map(|steps| f64::from(steps) / f64::from(SubPx::STEPS)));
    }
    (lines, scene)
}

/// Seconds of the fastest of `rounds`.
fn least(rounds: u32, mut work: impl FnMut()) -> f64 {
    let once = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    (0..rounds).map(once).fold(f64::INFINITY, f64::min)
}

/// A picture drawn and the same bytes merely written, in turns on warm memory.
struct Beside {
    labels: Vec<u32>,
    depths: Vec<f32>,
    buffers: Buffers,
    side: usize,
}

impl Beside {
    fn new(side: u32) -> Self {
        let side = side as usize;
        let pixels = side * side;
        Self { labels: vec![1; pixels], depths: vec![1.0; pixels], buffers: Buffers::new(), side }
    }

    /// Seconds to draw the scene, and to write 8 bytes a pixel once in as many threads.
    fn time(&mut self, scene: &Scene) -> (f64, f64) {
        let (mut drawn, mut written) = (f64::INFINITY, f64::INFINITY);
        render(scene, &mut self.buffers);
        for _ in 0..10 {
            written = written.min(least(1, || self.write()));
            drawn = drawn.min(least(1, || render(scene, &mut self.buffers)));
        }
        (drawn, written)
    }

    fn write(&mut self) {
        let band = self.side * 128;
        self.labels.par_chunks_mut(band).zip(self.depths.par_chunks_mut(band)).for_each(
            |(labels, depths)| {
                labels.fill(std::hint::black_box(7));
                depths.fill(std::hint::black_box(7.0));
            },
        );
    }
}

fn streamed(scene: &Scene, options: &Options) -> f64 {
    least(3, || {
        let mut tiles = 0_u32;
        stream(scene, options, |tile| tile.width, |_| tiles += 1);
        std::hint::black_box(tiles);
    })
}

/// Microseconds of a pick among 100 000 segments: its first fragment, and its first ten.
fn picks() {
    let scene = segments(4096, 100_000, 12, u32::MAX);
    let start = Instant::now();
    let picker = Picker::new(&scene);
    println!("picker of 100000 segments made: {:.1} ms", start.elapsed().as_secs_f64() * 1e3);
    for fragments in [1, 10] {
        let time = least(5, || {
            let mut random = Random(1);
            for _ in 0..1000 {
                let (column, row) = (random.below(4096), random.below(4096));
                let list = picker.pick(column.unsigned_abs(), row.unsigned_abs()).take(fragments);
                std::hint::black_box(list.count());
            }
        });
        println!("a pick of {fragments}: {:.2} µs", time * 1e3);
    }
}

/// Writes scenes and what the engine makes of them for the programs under `benches/peers`:
/// `NAME.segments` has a line `label x0 y0 x1 y1` each, in pixels; `NAME.labels` is 32 bits a
/// pixel; `NAME.time` is in seconds.
fn write_for_peers(folder: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let mut buffers = Buffers::new();
    for (name, side, count, limit) in
        [("small", 1024, 500, None), ("large", 4096, 2000, None), ("limited", 4096, 2000, Some(300.0))]
    {
        let (lines, scene) = limited_segments(side, count, 100, u32::MAX, limit);
        let time = least(10, || render(&scene, &mut buffers));
        println!("{name}: {side}², {count} segments, limit {limit:?}: {:.2} ms", time * 1e3);
        let text: String =
            (1..).zip(&lines).map(|(label, [a, b, c, d])| format!("{label} {a} {b} {c} {d}\n")).collect();
        let labels: Vec<u8> = buffers.labels().iter().flat_map(|label| label.to_le_bytes()).collect();
        std::fs::write(folder.join(format!("{name}.segments")), text)?;
        std::fs::write(folder.join(format!("{name}.labels")), labels)?;
        std::fs::write(folder.join(format!("{name}.time")), format!("{time}\n"))?;
    }
    Ok(())
}

fn main() -> std::io::Result<()> {
    println!("threads: {}", rayon::current_num_threads());
    if let Some(folder) = std::env::var_os("VOROMILL_PEERS") {
        return write_for_peers(Path::new(&folder));
    }
    let sections: [(&str, fn()); 4] =
        [("picture", large_and_small), ("pick", picks), ("growth", growth), ("doubling", doubling)];
    let asked: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    for (name, section) in sections {
        if asked.is_empty() || asked.iter().any(|asked| asked == name) {
            section();
        }
    }
    Ok(())
}

/// The picture that the others are held against, and sixteen times as many pixels streamed.
fn large_and_small() {
    let scene = segments(16384, 20_000, 100, u32::MAX);
    let large = streamed(&scene, &Options::default());
    println!("16384², 20000 segments streamed: {:.1} ms, peak {:.0?} MiB", large * 1e3, usage::peak_mib());
    drop(scene);
    let scene = segments(4096, 2000, 100, u32::MAX);
    let mut beside = Beside::new(4096);
    let (drawn, written) = beside.time(&scene);
    println!("4096², 8 bytes a pixel written once: {:.2} ms", written * 1e3);
    println!("4096², 2000 segments: {:.2} ms = {:.2} x", drawn * 1e3, drawn / written);
    let small = streamed(&scene, &Options::default());
    println!("4096² streamed: {:.2} ms = {:.2} x", small * 1e3, small / written);
    println!(
        "16384² a pixel / 4096² a pixel: {:.2} streamed, {:.2} drawn",
        large / 16.0 / small,
        large / 16.0 / drawn
    );
}

/// Time against the number of primitives and of pixels.
fn growth() {
    let mut beside = Beside::new(4096);
    for count in [100_u32, 1000, 10_000, 100_000, 1_000_000] {
        let length = 100.min(400_000 / count.cast_signed().isqrt() / 100);
        let (time, written) = beside.time(&segments(4096, count, length, u32::MAX));
        println!(
            "4096², {count} segments of {length} pixels: {:.1} ms = {:.2} x",
            time * 1e3,
            time / written
        );
    }
    let (time, written) = beside.time(&segments(4096, 2000, 4096, u32::MAX));
    println!("4096², 2000 segments across: {:.1} ms = {:.2} x", time * 1e3, time / written);
    for side in [512, 1024, 2048, 4096, 8192] {
        let mut beside = Beside::new(side);
        let (time, written) = beside.time(&segments(side, 2000, side.cast_signed() / 40, u32::MAX));
        println!("{side}², 2000 segments: {:.2} ms = {:.2} x", time * 1e3, time / written);
    }
}

/// Pictures of ever more pixels, of which the tiles that one label has to itself are left out.
fn doubling() {
    let scenes = [2048, 4096, 8192, 16384].map(|side| segments(side, 2000, side.cast_signed() / 40, 50));
    for tile in [16, 32, 64] {
        let options = Options { tile, skip_uniform: true, ..Options::default() };
        let mut times = [f64::INFINITY; 4];
        for _ in 0..5 {
            for (time, scene) in times.iter_mut().zip(&scenes) {
                *time = time.min(streamed(scene, &options));
            }
        }
        let doublings: Vec<f64> = times.windows(2).map(|pair| pair[1] / pair[0]).collect();
        println!(
            "50 labels, 2048² to 16384², tiles of {tile} skipped: {times:.4?}, doublings {doublings:.2?}"
        );
    }
}
