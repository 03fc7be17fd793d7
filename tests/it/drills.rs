//! Holes as settings make them: how deep, how fast, how wide, and with what.

use std::path::{Path, PathBuf};

use voromill::board::Plating;
use voromill::geometry::Nm;
use voromill::import::{self, Selection};
use voromill::job::{self, Job, Options, Part, Settings};
use voromill::toolpath::{Move, Section, ToolKind};

fn job(board: &str, settings: &str) -> (Job, Settings) {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(board);
    let loaded = import::load(&[path], &Selection::default()).expect("a board");
    let options = Options::from_toml("voromill.toml", settings).expect("settings");
    let settings = Settings::resolve(options).expect("settings that make sense");
    (job::mill(loaded, &settings).expect("a job"), settings)
}

/// The sections of all programs for a part.
fn sections(job: &Job, part: Part) -> Vec<&Section> {
    let programs = job.programs.iter().filter(|program| program.part == part);
    programs.flat_map(|program| &program.program.sections).collect()
}

fn depth(section: &Section) -> Nm {
    -section.moves.iter().filter_map(Move::to).map(|to| to.z).min().expect("moves")
}

fn diameter(section: &Section) -> Nm {
    section.tool.width_at(Nm::ZERO)
}

fn is_drill(section: &&&Section) -> bool {
    matches!(section.tool.kind, ToolKind::Drill { .. })
}

#[test]
fn a_hole_is_as_deep_as_its_drills_tip_asks_for() {
    let (usual, _) = job("blinker", "");
    let drilled = sections(&usual, Part::Drill);
    assert!(drilled.iter().filter(is_drill).count() > 2, "several drills");
    for section in &drilled {
        // 1.6 mm of board, 0.2 mm beyond it, and a cone of 118 degrees.
        let tip = diameter(section).to_mm() / 2.0 / libm::tan(59.0_f64.to_radians());
        let wanted = 1.8 + tip;
        let off = (depth(section).to_mm() - wanted).abs();
        assert!(off < 1e-5, "{}: {} mm, not {wanted} mm", section.label, depth(section));
    }
    let (thick, _) =
        job("blinker", "thickness = \"2mm\"\nbreak-through = \"0.5mm\"\ndrill-tip-angle = \"130deg\"");
    let tip = diameter(sections(&thick, Part::Drill)[0]).to_mm() / 2.0 / libm::tan(65.0_f64.to_radians());
    let first = depth(sections(&thick, Part::Drill)[0]).to_mm();
    assert!((first - 2.5 - tip).abs() < 1e-5, "{first} mm");
    let (same, _) = job("blinker", "drill-depth = \"1.9mm\"");
    for section in sections(&same, Part::Drill) {
        assert_eq!(
            depth(section),
            Nm::from_um(1900),
            "{}: one depth for all, where it is said",
            section.label
        );
    }
}

#[test]
fn a_drill_of_ones_own_has_its_own_tip() {
    let carbide =
        "drills = \"c\"\ndrill-tolerance = \"5mm\"\n[tools.c]\nkind = \"drill\"\ndiameter = \"1mm\"\n";
    let deep = |more: &str| depth(sections(&job("blinker", &format!("{carbide}{more}")).0, Part::Drill)[0]);
    assert_eq!(deep(""), Nm::new(2_100_430), "118 degrees");
    assert_eq!(deep("carbide = true\n"), Nm::new(2_033_154), "130 degrees");
    assert_eq!(deep("angle = \"90deg\"\n"), Nm::from_um(2300), "as its table says");
}

#[test]
fn a_drill_is_at_hand_as_a_tool_too() {
    let tool = |drills: &str| {
        let settings = format!("drills = \"{drills}\"\ndrill-tolerance = \"5mm\"");
        sections(&job("blinker", &settings).0, Part::Drill)[0].tool.clone()
    };
    assert_eq!(tool("drill:1mm"), tool("1mm"));
    let options = Options::from_toml("settings", "drills = \"endmill:1mm\"").expect("options");
    let error = Settings::resolve(options).expect_err("no drill").to_string();
    assert!(error.contains("`endmill:1mm` is not a drill"), "{error}");
}

#[test]
fn drills_run_as_their_diameter_the_board_and_the_machine_ask() {
    let (usual, _) = job("blinker", "");
    let drilled = sections(&usual, Part::Drill);
    let drills: Vec<&&Section> = drilled.iter().filter(is_drill).collect();
    for pair in drills.windows(2) {
        let (thin, thick) = (&pair[0].tool, &pair[1].tool);
        assert!(thin.plunge < thick.plunge, "{} and {}", thin.plunge, thick.plunge);
    }
    let first = |settings: &str| {
        let (job, _) = job("blinker", settings);
        let tool = &sections(&job, Part::Drill)[0].tool;
        (tool.plunge, tool.spindle)
    };
    let (plunge, turns) = first("");
    assert_eq!(turns, 12_000, "as fast as the spindle is to turn");
    assert!(first("material = \"fr1\"").0 > plunge, "paper is softer");
    let (quick, turns) = first("machine = \"shapeoko\"");
    assert!(turns == 30_000 && quick > plunge, "a fast spindle: {turns} rpm, {quick}");
    let asked = first("drill-plunge = \"33mm/min\"\ndrill-spindle = 7000");
    assert_eq!((asked.0.number().as_str(), asked.1), ("33", 7000), "as was asked for");
}

#[test]
fn holes_and_slots_thicker_than_the_thickest_drill_are_bored_unless_told_otherwise() {
    let (bored, settings) = job("regulator", "drills = \"0.6mm,0.8mm,1mm\"");
    let mills = |job: &Job| sections(job, Part::Drill).iter().filter(|section| !is_drill(section)).count();
    assert_eq!(mills(&bored), 1, "the cutter that cuts the board out bores");
    let bore = *sections(&bored, Part::Drill).last().expect("sections");
    assert_eq!(depth(bore), Nm::from_um(1800), "and has no tip to allow for");
    let findings = bored.verify(&settings).expect("a verdict").findings;
    assert!(findings.iter().all(|finding| !finding.name.starts_with("hole")), "{findings:?}");
    let (left, _) = job("regulator", "drills = \"0.6mm,0.8mm,1mm\"\ndrill-bore = false");
    assert_eq!(mills(&left), 0, "unless nothing is to be bored");
    assert!(left.warnings.iter().any(|warning| warning.code() == "no-drill-for-hole"), "and that is said");
}

#[test]
fn pins_stand_in_alignment_holes() {
    let at = |settings: &str| {
        let (job, _) = job("regulator", &format!("alignment-holes = \"3mm\"\n{settings}"));
        let notes = job.programs[0].program.notes.join(" ");
        (depth(sections(&job, Part::Alignment)[0]).to_mm(), notes)
    };
    let tip = 1.5 / libm::tan(59.0_f64.to_radians());
    let (usual, notes) = at("");
    assert!((usual - 4.6 - tip).abs() < 1e-5, "the board, 3 mm and the tip: {usual} mm");
    assert!(notes.contains("3.0 mm into what lies below"), "and says so: {notes}");
    assert!((at("alignment-depth = \"6mm\"").0 - 6.0 - tip).abs() < 1e-5, "as was asked for");
}

#[test]
fn holes_for_rivets_are_wider_where_a_fab_would_plate() {
    let (usual, _) = job("blinker", "");
    let (wide, settings) = job("blinker", "rivet = \"0.3mm\"");
    for (before, after) in usual.board.holes.iter().zip(&wide.board.holes) {
        let wider = match before.plating {
            Plating::NonPlated => Nm::ZERO,
            Plating::Plated | Plating::Unknown => Nm::from_um(300),
        };
        assert_eq!(after.diameter - before.diameter, wider, "{:?}", before.plating);
    }
    let holes =
        |job: &Job| sections(job, Part::Drill).iter().map(|section| diameter(section)).collect::<Vec<_>>();
    assert_ne!(holes(&usual), holes(&wide), "other drills");
    let findings = wide.verify(&settings).expect("a verdict").findings;
    assert!(findings.iter().all(|finding| !finding.name.starts_with("hole")), "as was meant: {findings:?}");
    let drill = wide.programs.iter().find(|program| program.part == Part::Drill).expect("holes");
    assert!(drill.text.contains("rivet 0.3mm"), "whoever judges the program alone is told");
}

#[test]
fn holes_have_a_height_for_travel_of_their_own() {
    let (low, _) = job("blinker", "drill-safe-z = \"0.7mm\"");
    for written in &low.programs {
        let highest = written.program.sections.iter().flat_map(|section| &section.moves).filter_map(Move::to);
        let highest = highest.map(|to| to.z).max().expect("moves");
        let wanted = if written.part == Part::Drill { 700 } else { 2000 };
        assert_eq!(highest, Nm::from_um(wanted), "{:?}", written.part);
    }
    let drill = low.programs.iter().find(|program| program.part == Part::Drill).expect("holes");
    assert!(drill.text.contains("G0 Z0.7\n") && drill.statistics.seconds > 0.0, "in the text too");
}

#[test]
fn a_turn_of_boring_goes_no_deeper_than_a_pass_of_the_cutout() {
    for (settings, most) in [
        ("", 500),
        ("cutout-pass = \"0.2mm\"\ndrill-peck = \"0.05mm\"", 200),
        ("cutout-pass = \"1.8mm\"", 1000),
    ] {
        let settings = format!("drill-bore-from = \"2mm\"\ncutout-tool = \"endmill:2mm\"\n{settings}");
        let (bored, _) = job("blinker", &settings);
        let bore = *sections(&bored, Part::Drill).last().expect("sections");
        let turn = |pair: &[Move]| match pair {
            [from, to @ Move::Arc { .. }] => Some(from.to()?.z - to.to()?.z),
            _ => None,
        };
        let deepest = bore.moves.windows(2).filter_map(turn).max().expect("turns");
        assert!(deepest <= Nm::from_um(most), "{settings}: {deepest} at once");
        assert!(deepest * 5 >= Nm::from_um(most) * 4, "{settings}: {deepest} at once, where more may be");
    }
}
