//! `--strategy auto`, and what is predicted of strategies.

use std::path::Path;

use voromill::board::{Board, Copper, Side};
use voromill::import::{self, Loaded, Selection, gerber};
use voromill::job::{self, Job, Options, Settings};
use voromill::prediction::Known;
use voromill::topology;
use voromill::verify::Severity;

fn settings(text: &str) -> Settings {
    Settings::resolve(Options::from_toml("options", text).expect("options")).expect("settings")
}

fn mill(board: &Board, text: &str) -> Job {
    let loaded = Loaded { board: board.clone(), sources: vec![], warnings: vec![], ignored: vec![] };
    job::mill(loaded, &settings(text)).expect("a job")
}

fn fixture(name: &str) -> Board {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(name);
    import::load(&[folder], &Selection::default()).expect("a board").board
}

/// Pads 1 mm wide in a square, so many micrometres apart.
fn pads(apart: i64, along: i64) -> Board {
    let mut text = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,1*%\nD10*\n".to_owned();
    for (x, y) in (0..along).flat_map(|x| (0..along).map(move |y| (x * apart * 1000, y * apart * 1000))) {
        text += &format!("X{x}Y{y}D03*\n");
    }
    let image = gerber::read("pads.gbr", (text + "M02*\n").as_bytes(), &gerber::Options::default());
    let image = image.expect("Gerber");
    let front = Copper { side: Side::Front, features: image.features, attributes: image.attributes };
    Board { name: "pads".to_owned(), front: Some(front), ..Board::default() }
}

/// The time that the machine needs for isolation.
fn seconds(job: &Job) -> f64 {
    let sides = job.programs.iter().filter(|program| ["front", "back"].contains(&program.part.name()));
    sides.map(|program| program.statistics.seconds).sum()
}

#[test]
fn auto_never_takes_longer_than_either_strategy() {
    for board in [fixture("blinker"), fixture("qfn-breakout"), pads(12_000, 4), pads(1500, 4)] {
        let [auto, voronoi, outline] = ["auto", "voronoi", "outline"]
            .map(|strategy| seconds(&mill(&board, &format!("strategy = \"{strategy}\""))));
        assert!(auto <= voronoi.min(outline) + 0.05, "{}: {auto}, not {voronoi} or {outline}", board.name);
    }
}

#[test]
fn auto_isolates_all_nets() {
    let options = "strategy = \"auto\"\ntool = \"endmill:0.15mm\"";
    for board in [fixture("blinker"), pads(12_000, 4)] {
        let job = mill(&board, options);
        let report = job.verify(&settings(options)).expect("it reads back");
        let errors: Vec<_> =
            report.findings.iter().filter(|found| found.severity == Severity::Error).collect();
        assert!(errors.is_empty(), "{}: {errors:?}", board.name);
    }
}

#[test]
fn pads_far_apart_get_loops_and_close_ones_a_lattice() {
    let loops = |board: &Board, text: &str| {
        let job = mill(board, text);
        let chosen = job.layers[0].chosen.clone().expect("it was left open");
        chosen.tried[chosen.taken].loops
    };
    assert!(loops(&pads(12_000, 4), "strategy = \"auto\"") >= 15, "a loop is shorter than the way between");
    assert_eq!(loops(&pads(1500, 4), "strategy = \"auto\""), 0, "close pads share their boundaries");
    let one = loops(&pads(12_000, 4), "strategy-for = [\"net 1=auto\"]");
    assert!(one <= 1, "only what is left open is chosen: {one}");
}

#[test]
fn what_is_predicted_is_near_what_is_cut() {
    for board in [fixture("blinker"), fixture("qfn-breakout"), pads(2000, 10)] {
        let (voronoi, outline) = (mill(&board, ""), mill(&board, "strategy = \"outline\""));
        for (layer, loops) in voronoi.layers.iter().zip(&outline.layers) {
            let copper = board.copper(layer.side).expect("copper");
            let extents = topology::extents(copper, &layer.nets);
            let known = Known::new(copper, &layer.nets, &extents, board.outline.as_ref()).expect("nets");
            let off = known.voronoi() / layer.boundary_length().to_mm() - 1.0;
            assert!(off.abs() < 0.45, "{} {}: off by {off:+.2}", board.name, layer.side);
            let round = known.outline(settings("").kerf() / 2) / loops.boundary_length().to_mm() - 1.0;
            // Loops that meet are cut once, and where one net encloses all there is none.
            assert!(
                (-0.01..0.06).contains(&round),
                "{} {}: loops are off by {round:+.3}",
                board.name,
                layer.side
            );
        }
    }
}
