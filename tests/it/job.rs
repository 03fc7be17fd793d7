//! The whole pipeline through the library: what settings change, and what is said of it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use voromill::board::Side;
use voromill::gcode::{dialect, read};
use voromill::geometry::{Nm, Segment, Vector};
use voromill::import::{self, Loaded, Selection};
use voromill::job::{self, Job, Options, Part, Reach, Settings};
use voromill::verify::Severity;

/// The job on a board of `fixtures/boards`, with settings as a settings file gives them.
fn job(files: &str, settings: &str) -> (Job, Settings) {
    let settings = of_file(settings);
    (job::mill(load(files), &settings).expect("a job"), settings)
}

/// A board of `fixtures/boards`.
fn load(files: &str) -> Loaded {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(files);
    import::load(&[path], &Selection::default()).expect("a board")
}

/// Settings as a settings file gives them.
fn of_file(text: &str) -> Settings {
    let options = Options::from_toml("voromill.toml", text).expect("settings");
    Settings::resolve(options).expect("settings that make sense")
}

fn warned(job: &Job, code: &str) -> bool {
    job.warnings.iter().any(|warning| warning.code() == code)
}

fn cut_mm(job: &Job, part: Part) -> f64 {
    let programs = job.programs.iter().filter(|program| program.part == part);
    let lengths: Vec<f64> = programs.map(|program| program.statistics.cut_length.to_mm()).collect();
    assert!(!lengths.is_empty(), "there is such a program");
    lengths.into_iter().sum()
}

#[test]
fn a_tool_that_cuts_nothing_is_warned_of() {
    let (wide, _) = job("blinker", "tool = [\"endmill:9mm\", \"endmill:0.2mm\"]");
    assert!(warned(&wide, "tool-cuts-nothing"), "nine millimetres fit nowhere");
    let (both, _) = job("blinker", "tool = [\"endmill:0.4mm\", \"endmill:0.2mm\"]");
    assert!(!warned(&both, "tool-cuts-nothing"), "each cuts where it fits");
}

#[test]
fn a_board_cut_out_from_the_back_is_cut_turned_over() {
    let (front, settings) = job("regulator", "");
    let (back, turned) = job("regulator", "cutout-side = \"back\"");
    let ends = |job: &Job| {
        let program = job.programs.iter().find(|program| program.part == Part::Cutout).expect("a cutout");
        let motions = read(&program.text).expect("a program").motions;
        motions.iter().filter_map(|motion| motion.to.point()).collect::<BTreeSet<_>>()
    };
    let over = |job: &Job| {
        let turn = |p: voromill::geometry::Point| voromill::geometry::Point::new(job.axis * 2 - p.x, p.y);
        ends(job).into_iter().map(turn).collect::<Vec<_>>()
    };
    let near = |p: &voromill::geometry::Point, all: &BTreeSet<voromill::geometry::Point>| {
        all.iter().any(|q| p.distance(*q) <= 2000.0)
    };
    let (there, here) = (over(&front), ends(&back));
    let placed = there.iter().filter(|p| near(p, &here)).count();
    assert!(placed * 10 >= there.len() * 9, "{placed} of {} ends are mirrored", there.len());
    assert!(back.verify(&turned).expect("a verdict").passes(Severity::Error), "it fits");
    assert!(front.verify(&settings).expect("a verdict").passes(Severity::Error), "so does it");
}

#[test]
fn every_dialect_writes_a_program_that_reads_back() {
    for dialect in dialect::ALL {
        let (job, _) = job("blinker", &format!("dialect = \"{}\"", dialect.name));
        for program in &job.programs {
            let back = read(&program.text);
            assert!(back.is_ok(), "{} {:?}: {:?}", dialect.name, program.part, back.err());
        }
    }
}

#[test]
fn a_cache_key_changes_with_files_and_settings_and_with_nothing_else() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards");
    let temporary = tempfile::tempdir().expect("a folder");
    let copy = temporary.path().to_path_buf();
    for entry in std::fs::read_dir(folder.join("blinker")).expect("readable") {
        let path = entry.expect("an entry").path();
        std::fs::copy(&path, copy.join(path.file_name().expect("a name"))).expect("writable");
    }
    let key = |path: &Path, settings: &str| {
        let loaded = import::load(&[path.to_path_buf()], &Selection::default()).expect("a board");
        let options = Options::from_toml("voromill.toml", settings).expect("settings");
        job::cache_key(&loaded, &Settings::resolve(options).expect("settings"), &[])
    };
    let first = key(&copy, "");
    assert_eq!(first.len(), 64, "SHA-256 in hexadecimal");
    assert_eq!(first, key(&folder.join("blinker"), ""), "in another folder");
    assert_eq!(first, key(&copy, "tabs = 4"), "with a default said aloud");
    assert_ne!(first, key(&copy, "tabs = 3"), "with another setting");
    let copper = copy.join("blinker-B_Cu.gbr");
    let text = std::fs::read_to_string(&copper).expect("readable");
    std::fs::write(&copper, text + "G04 a comment*\n").expect("writable");
    assert_ne!(first, key(&copy, ""), "with another file, even one that means the same");
}

#[test]
fn without_an_outline_the_frame_is_cut_unless_told_otherwise() {
    let layer = "blinker/blinker-B_Cu.gbr";
    let (framed, _) = job(layer, "");
    assert!(framed.layers[0].frame_cut.is_some(), "a frame cut round the copper");
    assert!(warned(&framed, "outline-missing"), "and why: {:?}", framed.warnings);
    let (open, _) = job(layer, "frame = false");
    assert!(
        open.layers[0].frame_cut.is_none() && warned(&open, "frame-not-cut"),
        "said, as nets stay joined"
    );
    assert!(cut_mm(&open, Part::Back) < cut_mm(&framed, Part::Back), "and less is cut");
}

#[test]
fn outlines_go_round_every_net_and_take_longer() {
    let (voronoi, _) = job("blinker", "");
    let (outline, _) = job("blinker", "strategy = \"outline\"");
    assert!(outline.layers[0].frame_cut.is_none(), "no net reaches the edge");
    assert!(cut_mm(&outline, Part::Back) > cut_mm(&voronoi, Part::Back), "the paper's saving");
}

#[test]
fn the_back_is_turned_over_and_registers_with_the_drills() {
    let (job, _) = job("regulator", "");
    let back = job.layers.iter().find(|layer| layer.placement.mirror.is_some()).expect("a back");
    let axis = back.placement.mirror.expect("mirrored");
    let hole = job.board.holes[0].path.start;
    let (front, turned) = (job.placement.point(hole), back.placement.point(hole));
    assert_eq!((front.x + turned.x, front.y), (axis * 2, turned.y), "the same hole, seen from behind");
    let program = job.programs.iter().find(|program| program.part == Part::Back).expect("a back");
    assert!(program.text.contains("mirrored left to right"), "the header says so");
}

#[test]
fn holes_are_drilled_from_behind_where_that_is_asked_for() {
    let bored = "drill-bore = true\ndrill-bore-tool = \"endmill:0.9mm\"\ntool-change = \"pause\"";
    let places = |side: &str| {
        let (job, settings) = job("regulator", &format!("{bored}\ndrill-side = \"{side}\""));
        let report = job.verify(&settings).expect("programs that can be followed");
        assert!(report.findings.is_empty(), "{side}: {:?}", report.findings);
        let written = job.programs.iter().find(|program| program.part == Part::Drill).expect("holes");
        assert_eq!(written.text.contains("mirrored left to right"), side == "back", "the header says so");
        assert!(written.text.contains("endmill:0.9mm"), "bored with a tool of its own");
        let moves = written.program.sections.iter().flat_map(|section| &section.moves);
        let plunges = moves.filter_map(|step| step.to()).filter(|to| to.z < Nm::ZERO);
        let mut places: Vec<_> = plunges.map(|to| (to.x, to.y)).collect();
        places.sort_unstable();
        places.dedup();
        (places, job.axis)
    };
    let ((front, axis), (back, _)) = (places("front"), places("back"));
    let mut turned: Vec<_> = back.into_iter().map(|(x, y)| (axis * 2 - x, y)).collect();
    turned.sort_unstable();
    let drilled = |places: &[(Nm, Nm)]| places.len() > 50;
    assert!(drilled(&front) && drilled(&turned), "{} and {}", front.len(), turned.len());
    let shared = front.iter().filter(|place| turned.binary_search(place).is_ok()).count();
    assert!(shared >= 50, "the same holes, seen from behind: {shared}");
}

#[test]
fn the_report_names_everything_that_was_read_and_written() {
    let (job, settings) = job("regulator", "");
    let report = job.describe(&settings);
    assert_eq!(report.programs.len(), job.programs.len(), "every program");
    assert_eq!(report.layers.len(), 2, "both sides");
    assert!(report.sources.iter().all(|source| source.sha256.len() == 64), "files by their content");
    assert!(report.electrical_nets.is_some(), "sides joined through holes");
    let key = |name: &str| report.settings.contains_key(name);
    assert!(key("tool") && key("depth") && key("sites"), "the settings: {:?}", report.settings);
    let text = report.summary(false);
    assert!(text.lines().count() < 40 && text.contains("total"), "short:\n{text}");
}

#[test]
fn holes_that_no_drill_fits_are_bored_or_named() {
    let (left, _) = job("regulator", "drills = \"0.8mm\"\ndrill-tolerance = \"0.05mm\"");
    assert!(warned(&left, "no-drill-for-hole"), "named: {:?}", left.warnings);
    let settings = "drills = \"0.8mm\"\ndrill-tolerance = \"0.05mm\"\ndrill-bore = true\ncutout-tool = \"endmill:0.6mm\"";
    let (bored, _) = job("regulator", settings);
    assert!(!warned(&bored, "no-drill-for-hole"), "bored: {:?}", bored.warnings);
}

/// However far drills may be off, an end mill makes no slot wider than it is.
#[test]
fn a_slot_is_not_bored_by_a_mill_that_does_not_fit() {
    let mut loaded = load("regulator");
    let mut slot = loaded.board.holes[0].clone();
    slot.path.segments = vec![Segment::Line { to: slot.path.start + Vector::new(Nm::from_mm(2), Nm::ZERO) }];
    slot.diameter = Nm::from_um(600);
    loaded.board.holes = vec![slot];
    let tools = |settings: &str| -> Vec<String> {
        let settings = of_file(&format!("drill-tolerance = \"10mm\"\n{settings}"));
        let job = job::mill(loaded.clone(), &settings).expect("programs");
        let drill = job.programs.iter().find(|written| written.part == Part::Drill);
        let sections = drill.map_or(&[][..], |written| &written.program.sections);
        sections.iter().map(|section| section.tool.kind.to_string()).collect()
    };
    assert_eq!(tools("drill-bore-tool = \"endmill:2mm\"\ndrills = \"0.6mm\""), ["drill:0.6mm"]);
    assert_eq!(tools("drill-bore-tool = \"endmill:0.65mm\"\ndrills = \"0.6mm\""), ["endmill:0.65mm"]);
}

/// What is said for drills replaces what a drill's table says, and what is said for cutters does
/// not.
#[test]
fn speeds_of_drills_are_those_that_are_said_for_drills() {
    let table = Options::from_toml(
        "voromill.toml",
        "drills = \"d08\"\n[tools.d08]\nkind = \"drill\"\ndiameter = \"0.8mm\"\nplunge = \"40mm/min\"\nspindle = 6000\n",
    );
    let table = table.expect("options");
    let speeds = |given: &str| {
        let given = Options::from_toml("given", given).expect("options");
        let drill = Settings::resolve(given.or(table.clone())).expect("settings").drills[0].clone();
        (drill.plunge.to_string(), drill.spindle)
    };
    assert_eq!(speeds(""), ("40mm/min".to_owned(), 6000));
    assert_eq!(speeds("plunge = \"90mm/min\"\nspindle = 11000"), ("40mm/min".to_owned(), 6000));
    assert_eq!(speeds("drill-plunge = \"70mm/min\""), ("70mm/min".to_owned(), 6000));
}

/// What is a board's alone does not stop shapes from being milled.
#[test]
fn settings_of_boards_are_no_matter_where_shapes_are_milled() {
    let of = |text: &str| Options::from_toml("voromill.toml", text).expect("options");
    for text in [
        "kerf = \"0.2mm\"\ntool = \"vbit:0.5mm:60deg\"",
        "adaptive-depth = \"0.05mm\"\nframe-margin = \"0.3mm\"\nlimit = \"0.5mm\"\ntool = \"endmill:3mm\"",
        "tool = \"endmill:12.7mm\"\ndepth = \"3mm\"",
    ] {
        assert!(Settings::resolve(of(text)).is_err(), "no board: {text}");
        for reach in [Reach::POCKETS, Reach::CARVING] {
            Settings::for_artwork(of(text), reach).expect(text);
        }
    }
    let own = "depth = \"4mm\"\ntool = \"small\"\n[tools.small]\nkind = \"endmill\"\ndiameter = \"1mm\"\ndepth = \"0.1mm\"\n";
    let deep = |settings: Settings| settings.isolation[0].heights.cut;
    assert_eq!(deep(Settings::resolve(of(own)).expect("a board's")), Nm::from_um(100), "to isolate");
    assert_eq!(deep(Settings::for_artwork(of(own), Reach::POCKETS).expect("a pocket's")), Nm::from_mm(4));
}

/// Of several tiles one is judged: the line that is told is that of the whole program.
#[test]
fn of_tiles_the_line_of_the_whole_program_is_told() {
    let text = "tile = \"2x2\"\ndialect = \"linuxcnc\"\ntool = [\"endmill:0.4mm\", \"endmill:0.2mm\"]";
    let (job, settings) = job("unsafe-gap", text);
    let found = job.verify(&settings).expect("programs that can be followed").findings;
    let gouge = found.iter().find(|found| found.name == "gouge").expect("a gap too narrow for the tool");
    let front = job.programs.iter().find(|written| written.part == Part::Front).expect("a front");
    let motions = read(&front.text).expect("a program").motions;
    let own = motions.iter().find(|motion| Some(motion.line) == gouge.line).expect("its line moves");
    let at = gouge.on_machine.expect("a place");
    let off = [own.from, own.to].map(|place| place.point().expect("a place").distance(at));
    assert!(off[0].min(off[1]) < 1e6, "{at:?} is beside line {:?}: {own:?}", gouge.line);
}

/// Whether verification finds nothing worse than a sliver.
fn is_sound(job: &Job, settings: &Settings) -> bool {
    job.verify(settings).expect("a verdict").findings.iter().all(|finding| finding.name == "sliver")
}

/// Whether verification finds nothing.
fn is_clean(job: &Job, settings: &Settings) -> bool {
    job.verify(settings).expect("a verdict").findings.is_empty()
}

#[test]
fn a_tool_has_one_number_in_all_programs_and_no_other_has_it() {
    let own = "[tools.mine]\nkind = \"vbit\"\ntip = \"0.1mm\"\nangle = \"30deg\"\nnumber = 2\n";
    let bored = "drill-bore = true\ndrills = \"1mm\"\nalignment-holes = \"1mm\"\n";
    let files = "tool-change = \"files\"\n";
    for settings in ["", bored, files, &format!("tool = \"mine\"\n{bored}{own}")] {
        let (job, _) = job("regulator", settings);
        let sections = job.programs.iter().flat_map(|program| &program.program.sections);
        let mut tools: Vec<_> =
            sections.map(|section| (section.tool.number, section.tool.kind.to_string())).collect();
        tools.sort();
        tools.dedup();
        let numbers: BTreeSet<u32> = tools.iter().map(|(number, _)| *number).collect();
        let kinds: BTreeSet<&String> = tools.iter().map(|(_, kind)| kind).collect();
        assert_eq!((numbers.len(), kinds.len()), (tools.len(), tools.len()), "{settings}: {tools:?}");
        let mine = settings.contains("mine").then_some(2);
        assert!(mine.is_none_or(|two| tools.contains(&(two, "vbit:0.1mm:30deg".to_owned()))), "{tools:?}");
    }
}

#[test]
fn of_two_tools_the_wide_one_cuts_where_it_fits() {
    let fine = "tool = \"endmill:0.2mm\"";
    let both = "tool = [\"endmill:0.2mm\", \"wide\"]\n[tools.wide]\nkind = \"endmill\"\ndiameter = \"0.6mm\"\nnumber = 9";
    let (one, _) = job("blinker", fine);
    let (two, settings) = job("blinker", both);
    let programs = two.programs.iter().filter(|written| written.part == Part::Back);
    let sections = programs.flat_map(|written| &written.program.sections);
    let tools: Vec<_> = sections.map(|section| (section.tool.name.as_str(), section.tool.number)).collect();
    assert_eq!(tools, [("wide", 9), ("endmill:0.2mm", 1)], "the wide one first");
    let (alone, shared) = (cut_mm(&one, Part::Back), cut_mm(&two, Part::Back));
    // Where a lift would take longer, one tool goes over a boundary again; which ones, depends on
    // what it has to cut.
    let once = two.layers[0].boundary_length().to_mm();
    assert!(alone >= once - 0.01 && shared >= once - 0.01, "{alone} and {shared} mm of {once} mm");
    // Short ends beside the other tool's are cut there and back rather than left by a lift.
    assert!(shared <= alone * 1.2, "{shared} mm instead of {alone} mm");
    assert!(is_clean(&two, &settings), "and every net is isolated");
}

#[test]
fn clearing_with_two_tools_leaves_no_net_joined_and_takes_no_copper() {
    let tools = "tool = [\"endmill:0.2mm\", \"endmill:0.6mm\"]\n";
    let (wide, settings) = job("blinker", &format!("{tools}width = \"1mm\""));
    assert!(is_sound(&wide, &settings), "nothing is gouged");
    let (all, settings) = job("blinker", &format!("{tools}clear = true"));
    assert!(is_sound(&all, &settings), "nothing is gouged");
    assert!(cut_mm(&all, Part::Back) > cut_mm(&wide, Part::Back), "clearing goes on to the middle");
}

#[test]
fn tiles_lie_beside_each_other_on_both_sides() {
    let (one, _) = job("regulator", "tabs = 2");
    let (four, settings) = job("regulator", "tabs = 2\ntile = \"2x2\"\ntile-spacing = \"4mm\"");
    for part in [Part::Front, Part::Back, Part::Drill, Part::Cutout] {
        let (single, panel) = (cut_mm(&one, part), cut_mm(&four, part));
        assert!((panel - 4.0 * single).abs() < 0.01, "{part:?}: {panel} mm for {single} mm");
    }
    let axis = four.layers[1].placement.mirror.expect("a back").to_mm();
    assert!((axis - (60.0 + 4.0 + 60.0) / 2.0).abs() < 1e-3, "the middle of the panel, not {axis}");
    let back = four.programs.iter().find(|program| program.part == Part::Back).expect("a back");
    let listing = read(&back.text).expect("a program");
    let xs = || listing.motions.iter().filter_map(|motion| motion.to.x).map(|x| x.to_mm());
    assert!(xs().all(|x| (-1.0..125.0).contains(&x)), "the back lies where the front lies");
    assert!(xs().any(|x| x < 60.0) && xs().any(|x| x > 64.0), "on all tiles");
    assert!(is_clean(&four, &settings), "and each is isolated");
}

#[test]
fn boards_that_lie_too_near_to_each_other_or_to_the_pins_are_refused() {
    let refused = |text: &str| {
        let made = job::mill(load("regulator"), &of_file(text));
        made.err().map(|error| error.to_string())
    };
    for (text, words) in [
        ("tile = \"2x1\"\ntile-spacing = \"0.5mm\"", Some("nothing between the cuts")),
        ("tile = \"1x2\"\ntile-spacing = \"2mm\"", Some("it must be more than 2mm")),
        ("tile = \"1x2\"\ntile-spacing = \"2.1mm\"", None),
        ("tile = \"3x3\"\ncutout-tool = \"endmill:3mm\"", None),
        ("tile = \"2x1\"\nrotate = \"30deg\"", None),
        ("alignment-holes = \"3mm\"\nalignment-margin = \"2mm\"", Some("it must be more than 2.5mm")),
        (
            "alignment-holes = \"3mm\"\ncutout-tool = \"endmill:4mm\"",
            Some("the pins stand in what is milled"),
        ),
        ("alignment-holes = \"3mm\"\nalignment-margin = \"2.6mm\"\nmirror-axis = \"10mm\"", None),
    ] {
        match (refused(text), words) {
            (None, None) => {}
            (Some(error), Some(words)) => assert!(error.contains(words), "{text}: {error}"),
            (error, _) => panic!("{text}: {error:?}"),
        }
    }
}

#[test]
fn a_board_of_one_side_that_is_turned_has_pins_too() {
    let first = |text: &str| {
        let mut loaded = load("regulator");
        loaded.board.back = None;
        let settings = of_file(&format!("alignment-holes = \"3mm\"\n{text}"));
        job::mill(loaded, &settings).expect("programs").programs[0].part
    };
    assert_eq!(first(""), Part::Front, "nothing is turned");
    let mut loaded = load("regulator");
    loaded.board.back = None;
    let alone = job::mill(loaded, &of_file("alignment-holes = \"3mm\"")).expect("programs");
    assert!(warned(&alone, "pins-without-flip"), "it is said: {:?}", alone.warnings);
    assert_eq!(first("cutout-side = \"back\""), Part::Alignment, "for the cutout");
    assert_eq!(first("drill-side = \"back\""), Part::Alignment, "for the holes");
}

#[test]
fn programs_that_the_machine_cannot_reach_are_named() {
    let (small, _) = job("regulator", "machine-travel = \"50mm,50mm,40mm\"");
    assert!(warned(&small, "beyond-the-machine"), "60 mm on 50: {:?}", small.warnings);
    let (large, _) = job("regulator", "machine-travel = \"100mm,100mm,40mm\"");
    assert!(!warned(&large, "beyond-the-machine"), "60 mm on 100");
    let found = |settings: &str| {
        let (job, settings) = job("regulator", settings);
        let findings = job.verify(&settings).expect("programs that can be followed").findings;
        let far = findings.into_iter().filter(|finding| finding.name == "overtravel");
        far.map(|finding| finding.message).collect::<Vec<_>>()
    };
    assert_eq!(found("machine-travel = \"100mm,100mm,40mm\""), [""; 0]);
    let panel = found("tile = \"2x1\"\nmachine-travel = \"100mm,100mm,40mm\"");
    assert!(panel.len() > 3, "each program that mills both boards: {panel:?}");
    assert!(panel.iter().all(|message| message.starts_with("x goes from ")), "{panel:?}");
    assert_eq!(found("tile = \"2x1\"\nmachine-travel = \"200mm,100mm,40mm\""), [""; 0]);
    // Pins stand beside the board, farther out than anything else goes.
    let pins = "alignment-holes = \"3mm\"\nmachine-travel = \"200mm,45mm,40mm\"";
    let beside = found(&format!("tile = \"2x1\"\n{pins}"));
    assert!(beside.iter().any(|message| message.starts_with("y goes from ")), "the pins: {beside:?}");
}

#[test]
fn alignment_holes_are_a_program_of_their_own() {
    let (job, _) = job("regulator", "alignment-holes = \"3mm\"");
    let first = &job.programs[0];
    assert_eq!((first.part, first.program.sections.len()), (Part::Alignment, 1), "before everything else");
    let axis = job.layers[1].placement.mirror.expect("a back");
    let moves = first.program.sections[0].moves.iter().filter_map(voromill::toolpath::Move::to);
    let deep: Vec<_> = moves.filter(|to| to.z < Nm::ZERO).collect();
    assert!(deep.len() == 2 && deep.iter().all(|to| to.x == axis), "two, on the axis: {deep:?}");
    let (aslant, settings) = self::job("regulator", "alignment-holes = \"3mm\"\nrotate = \"30deg\"");
    assert!(is_clean(&aslant, &settings), "the stock reaches round the board as it lies");
}

#[test]
fn the_machine_waits_where_it_is_told_to() {
    let (job, _) = job("regulator", "tool-change-at = \"-5mm,80mm,30mm\"\ntool-change = \"pause\"");
    let drill = job.programs.iter().find(|program| program.part == Part::Drill).expect("holes");
    let changes = drill.text.matches("\nM0").count();
    assert!(changes > 1, "several drills");
    assert_eq!(drill.text.matches("G0 X-5 Y80\nM5").count(), changes, "there before each change");
}

#[test]
fn ignored_nets_are_not_isolated() {
    let (all, _) = job("blinker", "");
    let (less, settings) = job("blinker", "ignore = \"net 1\"");
    let nets = |job: &Job| job.layers[0].nets.nets().len();
    assert!(
        warned(&less, "nets-ignored") || warned(&less, "pattern-without-net"),
        "said: {:?}",
        less.warnings
    );
    if warned(&less, "nets-ignored") {
        assert_eq!(nets(&less) + 1, nets(&all), "one less");
    }
    assert!(is_clean(&less, &settings), "the rest are isolated");
    let (same, _) = job("blinker", "ignore = \"NOBODY*\"");
    assert!(
        warned(&same, "pattern-without-net") && nets(&same) == nets(&all),
        "a pattern that means nothing"
    );
}

#[test]
fn spindle_and_drills_are_given_the_time_that_is_asked_for() {
    let (unhurried, _) = job("regulator", "spin-up = \"0s\"\ndialect = \"marlin\"");
    assert!(unhurried.programs.iter().all(|program| !program.text.contains("G4")), "nothing is waited for");
    let (job, settings) =
        job("regulator", "spin-up = \"4s\"\ndrill-dwell = \"250ms\"\ndialect = \"linuxcnc\"");
    let drill = job.programs.iter().find(|program| program.part == Part::Drill).expect("holes");
    let waits = |seconds: &str| drill.text.lines().filter(|line| *line == format!("G4 P{seconds}")).count();
    assert_eq!(waits("4"), drill.program.sections.len(), "once for each drill");
    let holes = job.board.holes.iter().filter(|hole| !hole.is_slot()).count();
    assert!(waits("0.25") >= holes, "{} times in {holes} holes", waits("0.25"));
    assert_eq!(settings.machine.spin_up, 4000, "and the estimate knows");
    for wrong in ["spin-up = \"3\"", "drill-dwell = \"-1s\"", "drill-dwell = \"1h\""] {
        let error = Options::from_toml("voromill.toml", wrong).expect_err(wrong).to_string();
        assert!(error.contains("such as `3s` or `200ms`"), "{error}");
    }
}

#[test]
fn nets_may_have_a_strategy_of_their_own() {
    let cut = |settings: &str| {
        let (job, settings) = job("regulator", settings);
        assert!(is_sound(&job, &settings), "{:?} isolate every net", settings.options().strategy_for);
        cut_mm(&job, Part::Front)
    };
    let (voronoi, outline) = (cut(""), cut("strategy = \"outline\""));
    let ground = cut("strategy-for = \"GND=outline\"");
    assert!(voronoi < ground && ground < outline, "{voronoi}, {ground}, {outline} mm");
    // Every other net has a loop, and the rest is ground.
    let rest = cut("strategy = \"outline\"\nstrategy-for = [\"GND=voronoi\", \"G*=outline\"]");
    assert!(rest < outline / 2.0, "{rest} of {outline} mm: the first pattern decides");
    let passes = cut("strategy-for = \"GND=outline\"\npasses = 2");
    assert!(passes > ground, "a second pass beside all: {passes} mm");
    cut("strategy-for = \"SW=outline\"\ntool = [\"endmill:0.2mm\", \"endmill:0.6mm\"]");
    let (same, _) = job("regulator", "strategy-for = \"NOBODY=outline\"");
    assert!(warned(&same, "pattern-without-net"), "{:?}", same.warnings);
}

#[test]
fn tabs_stand_where_they_are_asked_for() {
    let (job, settings) = job("regulator", "tab-at = [\"110mm,-60mm\", \"150mm,-100mm\", \"100mm,100mm\"]");
    assert!(warned(&job, "tab-off-the-outline"), "far away: {:?}", job.warnings);
    assert!(is_clean(&job, &settings), "the board is cut out");
    // One of 2 mm needs 3 mm with a cutter of 1 mm, and 1 mm more for a ramp.
    for (more, warns) in [("", false), ("cutout-ramp = \"3deg\"\n", true)] {
        let near = format!("{more}tab-at = [\"110mm,-60mm\", \"113.5mm,-60mm\"]");
        let (job, _) = self::job("regulator", &near);
        assert_eq!(warned(&job, "no-place-for-tabs"), warns, "{near}: {:?}", job.warnings);
    }
    let (job, _) = self::job("regulator", "tab-at = [\"110mm,-60mm\", \"112mm,-60mm\"]");
    assert!(warned(&job, "no-place-for-tabs"), "one within the other: {:?}", job.warnings);
}

#[test]
fn the_walkthrough_does_what_it_says() {
    let settings = include_str!("../../docs/walkthrough/voromill.toml");
    let (job, settings) = job("regulator", settings);
    let tags: Vec<&str> = job.programs.iter().map(|program| program.tag.as_str()).collect();
    assert_eq!(
        tags,
        [
            "alignment",
            "front-endmill-0.4mm",
            "front-vbit-0.1mm-20deg",
            "back",
            "drill-0.6mm",
            "drill-0.8mm",
            "drill-1.0mm",
            "drill-endmill-1.0mm",
            "cutout"
        ],
        "what there is to run, in order"
    );
    let tools = |part: Part| {
        let programs = job.programs.iter().filter(|program| program.part == part);
        let sections = programs.flat_map(|program| &program.program.sections);
        sections.map(|section| (section.tool.number, section.tool.name.clone())).collect::<Vec<_>>()
    };
    assert_eq!(tools(Part::Front), [(1, "slim-mill".to_owned()), (2, "engraver-20".to_owned())], "two tools");
    let drilling: Vec<u32> = tools(Part::Drill).into_iter().map(|(number, _)| number).collect();
    assert_eq!(drilling, [4, 5, 6, 3], "one's own tools keep 1 and 2, and three drills follow the mill");
    for part in [Part::Alignment, Part::Cutout] {
        assert_eq!(tools(part), [(3, "endmill:1mm".to_owned())], "which is the same in {part:?}");
    }
    assert!(is_clean(&job, &settings), "{:?}", job.verify(&settings).expect("a verdict").findings);
}

#[test]
fn pads_over_drawn_holes_are_isolated() {
    for settings in
        ["", "strategy = \"outline\"\ntool = \"endmill:0.15mm\"", "strategy-for = \"LOWER=outline\""]
    {
        let (job, settings) = job("../drawn-holes", settings);
        assert!(!warned(&job, "copper-outside-board"), "the pads round the holes are on the board");
        let report = job.verify(&settings).expect("it can be judged");
        let bad = report.findings.iter().find(|finding| finding.severity == Severity::Error);
        assert_eq!(bad.map(|finding| &finding.message), None, "no shorts");
    }
}

#[test]
fn a_board_without_copper_is_drilled_and_cut_out() {
    let (job, settings) = job("../bare", "");
    assert!(warned(&job, "copper-missing"), "says that there is none");
    let mut parts: Vec<Part> = job.programs.iter().map(|program| program.part).collect();
    parts.dedup();
    assert_eq!(parts, [Part::Drill, Part::Cutout], "what there is to do");
    let report = job.verify(&settings).expect("it can be judged");
    assert!(
        report.findings.iter().all(|finding| finding.severity < Severity::Error),
        "{:?}",
        report.findings
    );
    let document = job.describe(&settings);
    assert!(job.page(&settings, &document).is_ok(), "it has a page");
    assert!(job.picture(Side::Front, &settings).is_none(), "no copper, no picture of it");
}

#[test]
fn gaps_narrower_than_the_kerf_are_one_entry_a_side_and_none_beside_what_is_found_there() {
    let (job, settings) = job("blinker", "tool = \"endmill:0.6mm\"");
    let narrow = "gap-narrower-than-tool";
    let sizes: Vec<Nm> =
        job.warnings.iter().filter(|warning| warning.code() == narrow).filter_map(|w| w.size).collect();
    let deepest = sizes.iter().copied().max().expect("some gaps are too narrow");
    assert!(sizes.len() > 5 && deepest > Nm::from_um(20), "{sizes:?}");
    let mut document = job.describe(&settings);
    let entries: Vec<_> = document.warnings.iter().filter(|entry| entry.kind.code == narrow).collect();
    assert!(entries.len() <= 2, "those that verification tells of, and those it does not: {entries:?}");
    assert!(entries.iter().any(|entry| entry.size_mm.is_some_and(|size| size.0 == deepest)), "the worst");
    let told: usize = entries.iter().map(|entry| entry.places.len() + 1).sum();
    let slight: usize = document.layers.iter().map(|layer| layer.negligible_gaps).sum();
    assert_eq!(told + slight, sizes.len(), "none is left out");
    let report = job.verify(&settings).expect("it can be judged");
    let gouges: Vec<_> = report.findings.iter().filter(|finding| finding.name == "gouge").collect();
    assert!(!gouges.is_empty(), "verification finds them, too");
    document.verification = Some((&report).into());
    document.leave_out_explained_gaps();
    let left: Vec<_> = document.warnings.iter().filter(|entry| entry.kind.code == narrow).collect();
    assert!(
        left.iter().all(|entry| entry.size_mm.is_some_and(|size| size.0 <= Nm::from_um(10))),
        "what is found is told once: {left:?}"
    );
}
