//! pcb2gcode's project files: what is taken over, in whose units, and what is said of the rest.

use std::fs;
use std::path::{Path, PathBuf};

use voromill::board::Side;
use voromill::gcode::Dialect;
use voromill::gcode::dialect::{Blend, ToolChange};
use voromill::geometry::{Nm, Vector};
use voromill::job::{Holding, MillProject, Options, Settings, Strategy};
use voromill::toolpath::{Feed, ToolKind};

use crate::cli::{stderr, stdout, voromill};

fn project(text: &str) -> MillProject {
    MillProject::read("millproject", text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn settings(project: MillProject) -> Settings {
    Settings::resolve(project.options).expect("settings that make sense")
}

fn um(length: i64) -> Nm {
    Nm::from_um(length)
}

fn fixture() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/millproject/metric")
}

#[test]
fn every_option_with_a_counterpart_is_taken_over() {
    let project = project(&fs::read_to_string(fixture()).expect("a fixture"));
    let left: Vec<&str> = project.left.iter().map(|warning| warning.message.as_str()).collect();
    assert_eq!(left, ["`nog91-1` is not taken over: it has no counterpart"], "one has none");
    let place = project.left[0].source.as_ref().map(|source| (source.file.as_str(), source.line));
    assert_eq!(place, Some(("millproject", 35)), "and its line is told once, with the place");
    assert_eq!(project.files.front.as_deref(), Some(Path::new("blinker-F_Cu.gbr")), "the front");
    assert_eq!(
        (project.name.as_deref(), project.output.as_deref()),
        (Some("mine"), Some(Path::new("made"))),
        "outputs"
    );
    let settings = settings(project);
    assert_eq!(settings.isolation.len(), 2, "two mills");
    let [wide, fine] = [&settings.isolation[0], &settings.isolation[1]];
    assert_eq!((wide.kerf(), fine.kerf()), (um(400), um(200)), "the widest first");
    assert_eq!(fine.heights.cut, um(80), "zwork");
    assert_eq!(
        fine.widening.as_ref().map(|w| (w.width, w.overlap)),
        Some((um(600), um(50))),
        "0.6 wide, a quarter of 0.2 shared"
    );
    assert_eq!(
        (fine.tool.feed, fine.tool.plunge, fine.tool.spindle),
        (Feed::from_mm_per_min(240), Feed::from_mm_per_min(60), 14_000),
        "speeds"
    );
    assert_eq!((settings.safe, settings.strategy), (um(1500), Strategy::Voronoi), "zsafe and voronoi");
    assert_eq!((settings.dialect.spin_up, settings.machine.spin_up), (2000, 2000), "spinup-time");
    assert_eq!(
        (settings.drilling.cut, settings.drill_tolerance, settings.drill_bore),
        (um(1900), um(100), true),
        "drilling"
    );
    assert_eq!(settings.drills.len(), 3, "drills at hand");
    assert!(
        settings
            .drills
            .iter()
            .all(|drill| drill.plunge == Feed::from_mm_per_min(90) && drill.spindle == 9000),
        "their speeds"
    );
    let cutter = &settings.cutout_tool;
    assert_eq!(cutter.kind, ToolKind::EndMill { diameter: um(1200) }, "the cutter");
    assert_eq!(
        (cutter.feed, cutter.plunge, cutter.spindle),
        (Feed::from_mm_per_min(150), Feed::from_mm_per_min(40), 11_000),
        "its own speeds"
    );
    assert_eq!((settings.cutout.cut, settings.cutout.step), (um(1700), Some(um(400))), "zcut and cut-infeed");
    assert_eq!(
        (settings.tabs, settings.tab_width, settings.tab_height),
        (Holding::Count(3), um(2500), um(600)),
        "bridges"
    );
    assert_eq!(
        (settings.mirror_axis, settings.offset),
        (Some(Nm::ZERO), Vector::new(um(3000), Nm::ZERO)),
        "where it lies"
    );
    assert_eq!(settings.tiles.map(|(tiles, _)| (tiles.columns, tiles.rows)), Some((2, 1)), "tiles");
    assert_eq!(settings.dialect.tool_change, ToolChange::Pause, "no M6");
    assert_eq!(settings.dialect.blend, Some(Blend::Within(um(10))), "corners");
}

#[test]
fn without_metric_bare_numbers_are_inches() {
    let made = settings(project(
        "zwork=-0.003\nmill-feed=10\ncutter-diameter=1mm\nvoronoi=0\nmetric=false\nsoftware=LinuxCNC",
    ));
    assert_eq!(made.isolation[0].heights.cut, Nm::new(76_200), "three thousandths");
    assert_eq!(made.isolation[0].tool.feed, Feed::from_mm_per_min(254), "ten inches a minute");
    assert_eq!((made.strategy, made.dialect.name.as_ref()), (Strategy::Outline, "linuxcnc"), "outlines");
    assert_eq!(made.cutout_tool.kind, ToolKind::EndMill { diameter: um(1000) }, "its own unit");
}

#[test]
fn passes_and_bridges_mean_what_pcb2gcode_means() {
    let made = settings(project("metric=1\nmill-diameters=0.2\nextra-passes=2\nbridges=0"));
    assert_eq!(
        made.isolation[0].widening.as_ref().map(|w| (w.width, w.overlap)),
        Some((um(400), um(100))),
        "half a cutter each"
    );
    assert_eq!(made.tabs, Holding::Count(0), "no bridges");
    let one = settings(project("metric=1\nmill-diameters=0.2\nisolation-width=0.2\nbridges=2"));
    assert!(one.isolation[0].widening.is_none(), "one cut is wide enough");
    assert_eq!(one.tabs, Holding::Count(2), "two unless it says how many");
}

#[test]
fn holes_are_drilled_from_the_side_and_bored_with_the_mill_that_the_project_names() {
    let made = settings(project("metric=1\nmilldrill=1\nmilldrill-diameter=0.7\ndrill-side=back"));
    assert_eq!(made.drill_bore_tool.kind, ToolKind::EndMill { diameter: um(700) }, "its own mill");
    assert_eq!((made.drill_bore, made.drill_side), (true, Side::Back), "from behind");
    let made = settings(project("metric=1\ncutter-diameter=1.5\nmilldrill=1\ndrill-side=auto"));
    assert_eq!(made.drill_bore_tool.kind, ToolKind::EndMill { diameter: um(1500) }, "the cutter");
    assert_eq!(made.drill_side, Side::Front, "whatever suits");
}

#[test]
fn corners_names_and_tool_changes_are_as_the_project_says() {
    let made = settings(project("software=linuxcnc\ng64=0.0005"));
    assert_eq!(made.dialect.blend, Some(Blend::Within(Nm::new(12_700))), "half a thousandth");
    for text in
        ["software=linuxcnc\ntolerance=0.01mm\nnog64=1", "software=linuxcnc\nnog64=1\ntolerance=0.01mm"]
    {
        assert_eq!(settings(project(text)).dialect.blend, Some(Blend::Machine), "{text}");
    }
    let made = settings(project("software=linuxcnc\nnom6=0\nnog64=0\nnog81=1"));
    let linuxcnc = Dialect::by_name("linuxcnc").expect("built in");
    assert_eq!(
        (&made.dialect.blend, &made.dialect.tool_change),
        (&linuxcnc.blend, &linuxcnc.tool_change),
        "its own"
    );
    let named = project(
        "back-output=under.ngc\nback-output=below.ngc\ndrill-output=sub/holes.ngc\nmilldrill-output=x\nnog81=0",
    );
    let names: Vec<_> = named.options.output_name.iter().map(ToString::to_string).collect();
    assert_eq!(names, ["back=below.ngc"], "the last says it");
    let left: Vec<_> = named.left.iter().map(|warning| warning.message.as_str()).collect();
    assert_eq!(
        left,
        [
            "`drill-output` is not taken over: all files lie in output-dir",
            "`milldrill-output` is not taken over: it has no counterpart",
            "`nog81` is not taken over: holes are drilled with G0 and G1",
        ],
        "what has no counterpart"
    );
}

#[test]
fn options_of_the_command_line_win_over_the_project_and_that_over_the_file() {
    let from = |text| Options::from_toml("f", text).expect("options");
    let project = project("metric=1\nzsafe=3\nmill-feed=100\nmill-diameters=0.3").options;
    let made = from("feed = \"50mm/min\"")
        .or(project)
        .or(from("safe-z = \"9mm\"\nspindle = 7000\n[tools.mine]\nkind = \"drill\"\ndiameter = \"1mm\""));
    assert!(made.tools.names().contains(&"mine".to_owned()), "tools of the file stay");
    let made = Settings::resolve(made).expect("settings");
    assert_eq!(
        (made.isolation[0].tool.feed, made.safe, made.isolation[0].tool.spindle),
        (Feed::from_mm_per_min(50), um(3000), 7000),
        "in that order"
    );
}

#[test]
fn what_is_no_project_says_which_line() {
    for (text, reason) in [
        ("zwork", "millproject:1:1: `zwork`: expected option=value"),
        ("metric=1\nzwrok = 3", "millproject:2:1: `zwrok = 3`: expected an option of pcb2gcode"),
        ("zwork = 0.1", "a z below zero"),
        ("mill-feed = fast", "a speed"),
        ("metric = maybe", "true or false"),
        ("mill-diameters = 0.1;0.2", "lengths between commas"),
        ("tile-x = two", "a whole number"),
        ("drill-side = left", "front, back or auto"),
        ("milling-overlap = 120%", "less than 100%"),
        ("tolerance = 0", "above zero"),
    ] {
        let error = MillProject::read("millproject", text).expect_err(text).to_string();
        assert!(error.contains(reason), "`{text}` gives `{error}`");
    }
}

#[test]
fn a_project_mills_its_board_and_lists_what_it_could_not_take_over() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    let mut text =
        fs::read_to_string(fixture()).expect("a fixture").replace("front = blinker-F_Cu.gbr\n", "");
    // Boards of ours have their copper on either side.
    for entry in fs::read_dir(&board).expect("a board") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let role = [("F_Cu", "front"), ("B_Cu", "back"), ("Edge_Cuts", "outline"), (".drl", "drill")];
        if let Some((_, role)) =
            role.iter().find(|(part, _)| name.contains(part)).filter(|_| !name.ends_with("gbrjob"))
        {
            fs::copy(&path, folder.path().join(&name)).expect("copied");
            text.push_str(&format!("{role} = {name}\n"));
        }
    }
    fs::write(folder.path().join("millproject"), text).expect("written");
    let done = voromill(
        folder.path(),
        &["mill", "--millproject", "millproject", "--no-html", "--no-verify", "--tile", "1x1"],
    );
    assert!(done.status.success(), "{}", stderr(&done));
    let report =
        fs::read_to_string(folder.path().join("made/mine.json")).expect("in output-dir, by basename");
    assert!(report.contains("millproject-option") && report.contains("nog91-1"), "the rest is in the report");
    assert!(stdout(&done).contains("mine-drill.ngc"), "{}", stdout(&done));
    let program = |name| fs::read_to_string(folder.path().join("made").join(name)).expect(name);
    assert!(program("below.ngc").contains("\nG64 P0.01\n"), "back-output, and corners rounded as it says");
    assert!(program("board.ngc").contains("cutout"), "outline-output");
    assert!(!program("mine-drill.ngc").contains("M6"), "nom6");
    let nothing = voromill(folder.path(), &["mill", "-o", "out"]);
    assert_eq!(nothing.status.code(), Some(2), "neither files nor a project");
}
