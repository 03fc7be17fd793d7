//! Random boards through the whole of `mill`: the laws that hold whatever the copper looks like.
//!
//! The same boards every time. `PROPTEST_CASES=5000` makes it others, so many;
//! `PROPTEST_RNG_SEED=7` beside it the same others again. What was found so and mended stays in
//! `fixtures/random-boards`.

mod drawing;

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use rayon::ThreadPoolBuilder;
use voromill::board::{Board, Copper, FLATTEN, Shape, Side, polarity};
use voromill::gcode::read;
use voromill::geometry::{Nm, Point, Rect};
use voromill::import::Loaded;
use voromill::import::gerber::{self, Image};
use voromill::import::outline;
use voromill::job::{self, Job, Options, Settings};
use voromill::verify::{Finding, Severity};

use crate::cases;
use crate::euler;
use crate::oracle::distance::distance;
use drawing::{Drawing, coarse_drawing, drawing, drawing_with_holes};

/// What cuts them: settings as a settings file gives them.
const SETTINGS: [&str; 14] = [
    "",
    "strategy = \"outline\"\ntool = \"endmill:0.15mm\"",
    "passes = 3\ntool = \"endmill:0.15mm\"",
    "width = \"0.8mm\"\ntool = \"vbit:0.1mm:30deg\"",
    "tool = [\"endmill:0.4mm\", \"endmill:0.12mm\"]",
    "adaptive-depth = \"0.05mm\"",
    "sites = \"core\"",
    "limit = \"0.3mm\"",
    "clear = true\ntool = [\"endmill:1mm\", \"endmill:0.2mm\"]",
    "rotate = \"17deg\"\norigin = \"center\"\ndialect = \"linuxcnc\"",
    "sites = \"core\"\nlimit = \"0.3mm\"",
    "sites = \"core\"\nadaptive-depth = \"0.05mm\"\ntool = \"vbit:0.05mm:45deg\"",
    "adaptive-depth = \"0.05mm\"\ntool = [\"vbit:0.2mm:60deg\", \"vbit:0.1mm:20deg\"]",
    "adaptive-depth = \"0.05mm\"\nwidth = \"0.8mm\"\ntool = \"vbit:0.1mm:30deg\"",
];

fn config() -> ProptestConfig {
    let cases = if cfg!(debug_assertions) { 30 } else { 100 };
    ProptestConfig { max_shrink_time: 60_000, ..cases::same(cases, 73) }
}

fn image(text: &str) -> Result<Image, String> {
    gerber::read("random.gbr", text.as_bytes(), &gerber::Options::default())
        .map_err(|error| error.to_string())
}

/// The copper of a board's one side; none where all was cleared away again.
fn copper(text: &str, side: Side) -> Result<Option<Copper>, String> {
    let Image { features, attributes, .. } = image(text)?;
    Ok(Some(Copper { side, features, attributes }).filter(|copper| !copper.features.is_empty()))
}

/// The board with that copper, and that edge if there is one.
fn board(copper: Copper, edge: Option<&str>) -> Result<Board, String> {
    let outline = match edge {
        None => None,
        Some(text) => {
            outline::join("edge.gbr", text.as_bytes(), &image(text)?.features, outline::GAP).outline
        }
    };
    let side = copper.side;
    let [front, back] = [Side::Front, Side::Back].map(|other| Some(copper.clone()).filter(|_| other == side));
    Ok(Board { name: "random".to_owned(), front, back, outline, ..Board::default() })
}

fn mill(board: &Board, settings: &Settings, threads: usize) -> Result<Job, String> {
    let loaded = Loaded { board: board.clone(), sources: vec![], warnings: vec![], ignored: vec![] };
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| job::mill(loaded, settings)).map_err(|error| error.to_string())
}

/// Whether the job said that a cut does not fit beside one of the nets that something was found of,
/// or that what is not held has no room for a tab.
fn is_told(finding: &Finding, job: &Job) -> bool {
    if finding.name == "tab-missing" {
        return job.warnings.iter().any(|warning| warning.code() == "no-place-for-tabs");
    }
    let narrow = job.warnings.iter().filter(|warning| warning.code() == "gap-narrower-than-tool");
    let mut gaps = narrow.filter_map(|warning| warning.message.split_once(" has ").map(|(gap, _)| gap));
    let beside = |gap: &str, net: &String| {
        gap.ends_with(&format!(" and {net}")) || gap.starts_with(&format!("the cut between {net} and "))
    };
    ["gouge", "open", "destroyed"].contains(&finding.name)
        && gaps.any(|gap| finding.nets.iter().any(|net| beside(gap, net)))
}

/// Whether holes took all the copper.
fn is_bare(board: &Board) -> bool {
    let Some(outline) = &board.outline else { return false };
    let sides = [&board.front, &board.back].into_iter().flatten();
    let mut shapes = sides.flat_map(|copper| &copper.features).filter_map(|one| one.shape.polygon(FLATTEN));
    let within = outline.polygon(FLATTEN);
    shapes.all(|shape| polarity::intersection(&shape, &within).is_empty())
}

/// Which law is broken, if one is.
fn judge(board: &Board, settings: &str) -> Result<(), String> {
    let options = Options::from_toml("voromill.toml", settings).expect("settings");
    let settings = Settings::resolve(options).expect("settings that make sense");
    if is_bare(board) {
        let refused = mill(board, &settings, 2).map(|_| ()).expect_err("nothing to isolate");
        return if refused.contains("no copper lies within") { Ok(()) } else { Err(refused) };
    }
    let (job, alone) = (mill(board, &settings, 2)?, mill(board, &settings, 1)?);
    for (program, other) in job.programs.iter().zip(&alone.programs) {
        if program.text != other.text {
            return Err("one thread cuts otherwise than two".to_owned());
        }
        read(&program.text).map_err(|error| format!("it does not read back: {error}"))?;
    }
    if let Some(fault) = job.warnings.iter().find(|warning| warning.code() == "passes-missing") {
        return Err(format!("{} at {:?}: {}", fault.code(), fault.at, fault.message));
    }
    for layer in &job.layers {
        euler::wrong(&layer.boundaries).map_or(Ok(()), Err)?;
    }
    let report = job.verify(&settings).map_err(|error| error.to_string())?;
    let bad = |finding: &&Finding| finding.severity == Severity::Error && !is_told(finding, &job);
    match report.findings.iter().find(bad) {
        Some(finding) => Err(format!("{} at {:?}: {}", finding.name, finding.at, finding.message)),
        None => Ok(()),
    }
}

/// The same of a drawing; what is wrong is told with its edge.
fn judge_drawing(drawing: &Drawing, side: Side, settings: &str) -> Result<(), String> {
    let Some(copper) = copper(&drawing.copper(), side)? else { return Ok(()) };
    let edge = copper.bounds().and_then(|bounds| drawing.edge(bounds));
    let board = board(copper, edge.as_deref())?;
    judge(&board, settings)
        .map_err(|wrong| edge.map_or(wrong.clone(), |edge| format!("{wrong}\nwith the edge\n{edge}")))
}

/// Widths that a V-bit of 60° and 0.1 mm cuts at half a tenth of a millimetre and at two tenths:
/// half of them, in nanometres.
const HALF_WIDTHS: [f64; 2] = [78_868.0, 165_470.0];

/// How far the tool may be off the depth that the room asks for, told by half its width there, in
/// nanometres. Chosen: what a cut may be off the middle, and what sampling leaves.
const OFF: f64 = 3_000.0;

/// Where a V-bit that goes evenly from vertex to vertex is not as wide as there is room, as far as
/// it can be.
fn rises_wrong(board: &Board, settings: &str) -> Result<(), String> {
    let tool = "tool = \"vbit:0.1mm:60deg\"\ndepth = \"0.2mm\"\nadaptive-depth = \"0.05mm\"";
    let options = Options::from_toml("voromill.toml", &format!("{tool}\n{settings}")).expect("settings");
    let job = mill(board, &Settings::resolve(options).expect("settings that make sense"), 2)?;
    for layer in &job.layers {
        let features = &board.copper(layer.side).expect("copper").features;
        let areas = features.iter().filter_map(|one| one.shape.polygon(FLATTEN)).map(Shape::Polygon);
        // What is farther makes no difference.
        let near = |area: &Shape| area.bounds().inflate(Nm::from_f64(HALF_WIDTHS[1]));
        let copper: Vec<(Rect, Shape)> = areas.map(|area| (near(&area), area)).collect();
        let room = |at: Point| {
            let near = copper.iter().filter(|(near, _)| near.contains(at));
            let (x, y) = at.to_f64();
            near.map(|(_, area)| distance(area, x, y)).fold(f64::INFINITY, f64::min)
        };
        let half = |room: f64| room.clamp(HALF_WIDTHS[0], HALF_WIDTHS[1]);
        for boundary in layer.boundaries.edges.iter().filter(|edge| !edge.is_border()) {
            for ((from, segment), ends) in boundary.path.steps().zip(boundary.clearance.windows(2)) {
                let [first, last] = [ends[0], ends[1]].map(|end| half(end.to_f64()));
                for share in (0..=16).map(|part| f64::from(part) / 16.0) {
                    let at = segment.at(from, share);
                    let (cut, fits) = (first + (last - first) * share, half(room(at)));
                    if (cut - fits).abs() > OFF {
                        return Err(format!("at {at:?} half the kerf is {cut} nm, where {fits} fit"));
                    }
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn on_a_random_board_the_tool_rises_where_it_must_and_nowhere_else(
        drawing in drawing(),
        settings in prop::sample::select(vec!["", "width = \"0.5mm\""]),
    ) {
        let text = drawing.copper();
        if let Some(copper) = copper(&text, Side::Front).map_err(TestCaseError::fail)? {
            let board = board(copper, None).map_err(TestCaseError::fail)?;
            rises_wrong(&board, settings).map_err(|wrong| TestCaseError::fail(format!("{wrong}\n{text}")))?;
        }
    }

    #[test]
    fn a_random_board_is_isolated_as_it_was_drawn(
        drawing in drawing(),
        side in prop::sample::select(vec![Side::Front, Side::Back]),
        settings in prop::sample::select(SETTINGS.to_vec()),
    ) {
        judge_drawing(&drawing, side, settings).map_err(TestCaseError::fail)?;
    }

    #[test]
    fn a_random_board_on_a_coarse_grid_is_isolated_as_it_was_drawn(
        drawing in coarse_drawing(),
        side in prop::sample::select(vec![Side::Front, Side::Back]),
        settings in prop::sample::select(SETTINGS.to_vec()),
    ) {
        judge_drawing(&drawing, side, settings).map_err(TestCaseError::fail)?;
    }

    #[test]
    fn a_random_board_with_drawn_holes_is_isolated_as_it_was_drawn(
        drawing in drawing_with_holes(),
        side in prop::sample::select(vec![Side::Front, Side::Back]),
        settings in prop::sample::select(SETTINGS.to_vec()),
    ) {
        judge_drawing(&drawing, side, settings).map_err(TestCaseError::fail)?;
    }
}

#[test]
fn what_random_boards_once_brought_to_light_stays_mended() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/random-boards");
    for (name, settings) in [
        ("tip-at-the-border", SETTINGS[0]),
        ("end-at-the-border", SETTINGS[0]),
        ("slit", SETTINGS[0]),
        ("slit-and-trace", SETTINGS[2]),
        ("band", SETTINGS[6]),
        ("facing-corners", SETTINGS[0]),
        ("gap-of-a-micrometre", SETTINGS[3]),
        ("half-turn-round-an-end", SETTINGS[0]),
        ("hole-a-nanometre-wider", SETTINGS[1]),
        ("nonagon-in-its-hole", SETTINGS[3]),
        ("pads-that-overlap-by-a-nanometre", SETTINGS[8]),
        ("row-of-pads-that-touch", SETTINGS[8]),
        ("corners-a-hair-apart", SETTINGS[7]),
        ("trace-in-a-round-hole", SETTINGS[6]),
        ("web-thinner-than-an-arc-bulges", SETTINGS[0]),
        ("row-across-a-trace", SETTINGS[6]),
        ("arc-that-ends-a-hair-beyond-its-corner", SETTINGS[0]),
        ("ways-that-meet-far-away", SETTINGS[8]),
        ("wedge-thinner-than-a-fit", SETTINGS[7]),
        ("corner-within-an-open-ring", SETTINGS[0]),
        ("slanted-pads-side-by-side", SETTINGS[0]),
        ("hole-drawn-nearly-twice", SETTINGS[0]),
        ("ring-that-just-opens-an-edge", SETTINGS[0]),
        ("sliver-between-two-bands", SETTINGS[6]),
        ("pads-that-the-tool-rises-between", SETTINGS[5]),
        ("pad-alone", SETTINGS[10]),
        ("sliver-at-the-limit", SETTINGS[10]),
        ("pad-as-far-as-an-arc-from-its-middle", SETTINGS[0]),
        ("trace-as-far-as-an-arc-from-its-middle", SETTINGS[10]),
    ] {
        let text = fs::read_to_string(folder.join(format!("{name}.gbr"))).expect("a fixture");
        let edge = fs::read_to_string(folder.join(format!("{name}.edge.gbr"))).ok();
        let copper = copper(&text, Side::Front).expect("readable").expect("copper");
        let board = board(copper, edge.as_deref()).expect("a board");
        assert_eq!(judge(&board, settings), Ok(()), "{name}");
    }
}
