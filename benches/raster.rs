//! The raster engine's figures, as ratios measured in one run: `cargo bench --bench raster`.
//!
//! A plain program rather than a Criterion suite, because what counts are ratios between two things done in turns
//! on the same warm memory, and peak memory. Times are the least of several rounds.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

use std::time::Instant;

use rayon::prelude::*;
use voromill::raster::{
    Buffers, Caps, Label, Options, PixelPoint, Scene, Sides, SubPx, Surface, render, stream,
};

/// SplitMix64: the same scene on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: i32) -> i32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let high = (z ^ (z >> 31)) >> 32;
        i32::try_from((high * u64::from(limit.unsigned_abs())) >> 32).expect("below the limit")
    }
}

/// `count` segments of up to `length` pixels along x and y in a square picture, each with its own label or all
/// under `labels`.
fn segments(side: u32, count: u32, length: i32, labels: u32) -> Scene {
    let mut random = Random(u64::from(count));
    let mut scene = Scene::new(side, side);
    let side = side.cast_signed() * SubPx::STEPS;
    let reach = length * SubPx::STEPS;
    for number in 0..count {
        let (x, y) = (random.below(side), random.below(side));
        let mut end = |at: i32| SubPx::new((at + random.below(2 * reach) - reach).clamp(0, side));
        let to = PixelPoint::new(end(x), end(y));
        let from = PixelPoint::new(SubPx::new(x), SubPx::new(y));
        let (caps, sides) = (Caps::Both, Sides::Both);
        let curtain = Surface::Curtain { from, to, caps, sides, offset: 0.0, limit: None };
        scene.add(Label(1 + number % labels), curtain);
    }
    scene
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

/// Writes 8 bytes a pixel once, in the bands and threads that `render` uses.
fn memset(labels: &mut [u32], depths: &mut [f32], side: usize) {
    let band = side * 64;
    labels.par_chunks_mut(band).zip(depths.par_chunks_mut(band)).for_each(|(labels, depths)| {
        labels.fill(std::hint::black_box(7));
        depths.fill(std::hint::black_box(7.0));
    });
}

/// Peak resident memory of the process so far, in MiB; none where the system does not say.
fn peak_mib() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kib| kib / 1024)
}

fn streamed(scene: &Scene, skip_uniform: bool) -> f64 {
    let options = Options { skip_uniform, ..Options::default() };
    least(3, || {
        let mut tiles = 0_u32;
        stream(scene, &options, |tile| tile.width, |_| tiles += 1);
        std::hint::black_box(tiles);
    })
}

fn main() {
    println!("threads: {}", rayon::current_num_threads());
    let scene = segments(16384, 20_000, 100, u32::MAX);
    let large = streamed(&scene, false);
    println!("16384², 20000 segments streamed: {:.1} ms, peak {:?} MiB", large * 1e3, peak_mib());
    drop(scene);

    let side = 4096_usize;
    let (mut labels, mut depths) = (vec![1_u32; side * side], vec![1.0_f32; side * side]);
    let mut buffers = Buffers::new();
    let scene = segments(4096, 2000, 100, u32::MAX);
    render(&scene, &mut buffers);
    let (mut written, mut drawn) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..10 {
        written = written.min(least(1, || memset(&mut labels, &mut depths, side)));
        drawn = drawn.min(least(1, || render(&scene, &mut buffers)));
    }
    println!("4096², 8 bytes a pixel written once: {:.2} ms", written * 1e3);
    println!("4096², 2000 segments: {:.2} ms = {:.2} x", drawn * 1e3, drawn / written);
    println!("16384² a pixel / 4096² a pixel: {:.2}", large / 16.0 / drawn);
    let small = streamed(&scene, false);
    println!("4096² streamed: {:.2} ms; 16384² a pixel / that: {:.2}", small * 1e3, large / 16.0 / small);

    for count in [100, 1000, 10_000, 100_000, 1_000_000] {
        let scene = segments(4096, count, 100.min(400_000 / count.cast_signed().isqrt() / 100), u32::MAX);
        let time = least(3, || render(&scene, &mut buffers));
        println!("4096², {count} segments: {:.1} ms = {:.2} x", time * 1e3, time / written);
    }
    let long = segments(4096, 2000, 4096, u32::MAX);
    let time = least(3, || render(&long, &mut buffers));
    println!("4096², 2000 segments across: {:.1} ms = {:.2} x", time * 1e3, time / written);

    let times: Vec<f64> = [2048, 4096, 8192, 16384]
        .into_iter()
        .map(|side| streamed(&segments(side, 2000, side.cast_signed() / 40, 50), true))
        .collect();
    println!("50 labels, 2048² to 16384², uniform skipped: {times:.4?}");
    for pair in times.windows(2) {
        println!("  doubling: {:.2} x", pair[1] / pair[0]);
    }
}
