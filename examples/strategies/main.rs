//! Voronoi toolpaths beside outlines, on random boards and the corpus:
//!
//! - `cargo run --release --example strategies -- fit` makes the coefficients of
//!   [`voromill::prediction`] and states the error on boards that took no part;
//! - `cargo run --release --example strategies -- compare` writes `docs/strategies.md`: machine
//!   time by strategy and what was predicted, layer by layer.
//!
//! `VOROMILL_BOARDS` names the folder of the corpus, which is not part of the repository.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

mod random;

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use voromill::board::{Board, Copper, Side};
use voromill::import::gerber;
use voromill::import::{self, Loaded, Selection};
use voromill::job::{self, Job, Layer, Options, Settings};
use voromill::prediction::{FEATURES, Known};
use voromill::toolpath::duration;
use voromill::topology;

/// Random boards that are fitted.
const RANDOM: u64 = 200;
/// Parts that the random boards are divided into, of which each takes no part once.
const FOLDS: u64 = 10;
/// What is added to the diagonal of the normal equations. Chosen: it keeps the coefficients of
/// features that few boards have small.
const RIDGE: f64 = 0.3;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    match std::env::args().nth(1).as_deref() {
        Some("fit") => fit(),
        Some("compare") => compare(),
        _ => Err("say fit or compare".into()),
    }
}

/// The boards of the corpus and our own, by name.
fn corpus() -> Outcome<Vec<(String, Board)>> {
    let folder =
        std::env::var_os("VOROMILL_BOARDS").map_or_else(|| PathBuf::from("../shared/boards"), PathBuf::from);
    let mut folders = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        folders.push(entry?.path());
    }
    folders.retain(|folder| folder.join("meta.json").is_file());
    folders.sort();
    let ours = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards");
    folders.extend(["blinker", "qfn-breakout", "regulator"].map(|name| ours.join(name)));
    let mut boards = Vec::new();
    for folder in folders {
        let untold = folder.join("example.grb");
        let selection = Selection { front: untold.is_file().then_some(untold), ..Selection::default() };
        if let Ok(loaded) = import::survey(std::slice::from_ref(&folder), &selection) {
            boards
                .push((folder.file_name().unwrap_or_default().to_string_lossy().into_owned(), loaded.board));
        }
    }
    Ok(boards)
}

fn random(seed: u64) -> Outcome<Option<Board>> {
    let text = random::gerber(seed);
    let image = gerber::read("random.gbr", text.as_bytes(), &gerber::Options::default())?;
    let copper = Copper { side: Side::Front, features: image.features, attributes: image.attributes };
    let is_some = !copper.features.is_empty();
    Ok(is_some.then(|| Board { name: "random".to_owned(), front: Some(copper), ..Board::default() }))
}

fn settings(strategy: &str) -> Outcome<Settings> {
    Ok(Settings::resolve(Options::from_toml("options", &format!("strategy = \"{strategy}\""))?)?)
}

fn mill(board: &Board, settings: &Settings) -> Outcome<Job> {
    Ok(job::mill(
        Loaded { board: board.clone(), sources: vec![], warnings: vec![], ignored: vec![] },
        settings,
    )?)
}

fn known(board: &Board, layer: &Layer) -> Option<Known> {
    let copper = board.copper(layer.side)?;
    Known::new(copper, &layer.nets, &topology::extents(copper, &layer.nets), board.outline.as_ref())
}

/// A layer that is fitted: the part that it is left out with, its features, and the logarithm of
/// its boundaries' length.
struct Sample {
    name: String,
    fold: String,
    is_random: bool,
    known: Known,
    target: f64,
    /// Whether boundaries are shorter than outlines.
    is_shorter: bool,
}

fn samples() -> Outcome<Vec<Sample>> {
    let (voronoi, outline) = (settings("voronoi")?, settings("outline")?);
    let mut boards = Vec::new();
    for seed in 1..=RANDOM {
        if let Some(board) = random(seed)? {
            boards.push((format!("random {seed}"), format!("part {}", seed % FOLDS), board));
        }
    }
    boards.extend(corpus()?.into_iter().map(|(name, board)| (name.clone(), name, board)));
    let mut samples = Vec::new();
    for (name, fold, board) in boards {
        // A side without copper, or nothing on the board, is no sample.
        let (Ok(job), Ok(loops)) = (mill(&board, &voronoi), mill(&board, &outline)) else { continue };
        for (layer, round) in job.layers.iter().zip(&loops.layers) {
            let (length, loops) = (layer.boundary_length().to_mm(), round.boundary_length().to_mm());
            if let Some(known) = known(&board, layer).filter(|_| length > 0.0) {
                let target = libm::log(length / known.unit());
                let (name, fold) = (format!("{name} {}", layer.side), fold.clone());
                let is_random = name.starts_with("random ");
                samples.push(Sample { name, fold, is_random, known, target, is_shorter: length < loops });
            }
        }
    }
    Ok(samples)
}

fn fit() -> Outcome<()> {
    let samples = samples()?;
    let all: Vec<&Sample> = samples.iter().collect();
    println!("{:.4?}", coefficients(&all));
    let (mut random, mut corpus, mut wrong) = (Vec::new(), Vec::new(), 0);
    for sample in &samples {
        let others: Vec<&Sample> = samples.iter().filter(|other| other.fold != sample.fold).collect();
        let found: f64 = coefficients(&others).iter().zip(sample.known.features()).map(|(a, b)| a * b).sum();
        let off = libm::exp(found - sample.target) - 1.0;
        if sample.is_random {
            random.push(off.abs());
        } else {
            let length = libm::exp(found) * sample.known.unit();
            let is_shorter = length < sample.known.outline(settings("voronoi")?.kerf() / 2);
            wrong += usize::from(is_shorter != sample.is_shorter);
            corpus.push(off.abs());
            println!("{:32} {:+.0} %", sample.name, off * 100.0);
        }
    }
    for (name, mut off) in [("random boards", random), ("the corpus", corpus)] {
        off.sort_by(f64::total_cmp);
        let at = |part: usize| off[(off.len() * part / 10).min(off.len() - 1)] * 100.0;
        println!("{} of {name}: half within {:.1} %, nine in ten within {:.1} %", off.len(), at(5), at(9));
    }
    println!("which is shorter is wrong on {wrong} layers of the corpus");
    Ok(())
}

/// The least squares with a ridge; all random boards weigh as much as the rest.
fn coefficients(samples: &[&Sample]) -> [f64; FEATURES] {
    let random = samples.iter().filter(|sample| sample.is_random).count();
    let count = |number: usize| f64::from(u32::try_from(number).unwrap_or(u32::MAX));
    let weight = count(random) / count(samples.len() - random).max(1.0);
    let mut rows = [[0.0; FEATURES + 1]; FEATURES];
    for sample in samples {
        let features = sample.known.features();
        let weight = if sample.is_random { 1.0 } else { weight };
        for (row, one) in rows.iter_mut().zip(features) {
            row.iter_mut().zip(features).for_each(|(sum, other)| *sum += weight * one * other);
            row[FEATURES] += weight * one * sample.target;
        }
    }
    (0..FEATURES).for_each(|i| rows[i][i] += RIDGE);
    // Gauss and Jordan; with the ridge no pivot is zero.
    for pivot in 0..FEATURES {
        let row = rows[pivot];
        for (i, other) in rows.iter_mut().enumerate().filter(|(i, _)| *i != pivot) {
            let factor = other[pivot] / row[pivot];
            debug_assert!(factor.is_finite(), "row {i} has a solution");
            other.iter_mut().zip(row).for_each(|(value, known)| *value -= factor * known);
        }
    }
    std::array::from_fn(|i| rows[i][FEATURES] / rows[i][i])
}

fn compare() -> Outcome<()> {
    let auto = settings("auto")?;
    let mut text = PREFACE.to_owned();
    let (mut sums, mut worse, mut layers) = ([0.0; 3], 0, 0);
    for (name, board) in corpus()? {
        let Ok(job) = mill(&board, &auto) else { continue };
        for layer in &job.layers {
            let Some(chosen) = &layer.chosen else { continue };
            let [voronoi, outline] = [chosen.tried[0], *chosen.tried.get(1).unwrap_or(&chosen.tried[0])];
            let taken = chosen.tried[chosen.taken];
            let predicted = known(&board, layer).map_or_else(String::new, |known| {
                format!("{:+.0}", (known.voronoi() / known.outline(auto.kerf() / 2) - 1.0) * 100.0)
            });
            let gain = (1.0 - taken.seconds / voronoi.seconds.min(outline.seconds)) * 100.0;
            let nets = layer.nets.nets().len();
            let times = [voronoi.seconds, outline.seconds, taken.seconds];
            let [v, o, t] = times.map(duration);
            let side = layer.side;
            writeln!(
                text,
                "| {name} {side} | {nets} | {v} | {o} | {t} | {} | {gain:.1} | {predicted} |",
                taken.loops
            )?;
            sums.iter_mut().zip(times).for_each(|(sum, time)| *sum += time);
            worse += usize::from(taken.seconds > voronoi.seconds.min(outline.seconds));
            layers += 1;
        }
    }
    let [v, o, t] = sums.map(duration);
    writeln!(
        text,
        "| all | | {v} | {o} | {t} | | | |\n\nOf {layers} layers, auto takes longer than the faster of the two on {worse}."
    )?;
    std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/strategies.md"), &text)?;
    println!("{text}");
    Ok(())
}

const PREFACE: &str = "\
# Regions, loops, or both

`--strategy voronoi` cuts once between neighbouring nets, `--strategy outline` round every net, and `--strategy auto` makes several plans, times each on the machine
and takes the fastest: regions for all, loops for all, a loop round all but the net whose loop is longest (what is left is that net), and loops round nets
whose loop is short beside the edge of their region. So it never takes longer than either. It takes as long to compute as all of its plans together.

`voromill inspect` predicts the lengths of both from what is known before anything is drawn: nets, pads, area of board and copper, and the edge of the copper
(`src/prediction.rs`). The model is fitted on 200 random boards and the layers below by `cargo run --release --example strategies -- fit`, which also states the
error on boards that took no part: the length of boundaries is off by less than 10 % on half of the corpus' layers and by less than 26 % on nine in
ten; which of the two is shorter is right on 48 of 49. Where it is far off (`protel`, `arduino`, the back of `regulator`), planes are riddled with holes that part nothing.

This table is written by `cargo run --release --example strategies -- compare`: machine time of one side's isolation with the default V-bit, feeds and machine; what auto saves
of the faster of the two, and how much shorter (−) or longer (+) Voronoi was predicted to be than outlines, both in percent.

| layer | nets | voronoi | outline | auto | loops | saves % | predicted % |
|---|---|---|---|---|---|---|---|
";
