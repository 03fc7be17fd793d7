//! pcb2gcode's project files: what is taken over, in whose units, and what is said of the rest.

use std::fs;
use std::path::{Path, PathBuf};

use voromill::board::{Side, Warning};
use voromill::gcode::Dialect;
use voromill::gcode::dialect::{Blend, ToolChange};
use voromill::geometry::{Nm, Vector};
use voromill::import::{self, Selection};
use voromill::job::{
    self, Error, Holding, Length, MillProject, Options, Part, Settings, Strategy, ToolChangeAt,
};
use voromill::toolpath::{Direction, Feed, ToolKind};
use voromill::verify::Severity;

use crate::cli::{stderr, stdout, voromill};
use crate::corpus;

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
    let left: Vec<String> = project.left.iter().map(Warning::text).collect();
    assert!(left[0].starts_with("`drills-available`: a drill without tolerances"), "{left:?}");
    assert_eq!(
        &left[1..],
        ["`nog91-1` is not taken over: the dialect sets whether programs have G91.1"],
        "one has no counterpart"
    );
    let place = project.left[1].source.as_ref().map(|source| (source.file.as_str(), source.line));
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
        Some((Some(um(600)), um(50))),
        "0.6 wide, a quarter of 0.2 shared"
    );
    assert_eq!(
        (fine.tool.feed, fine.tool.plunge, fine.tool.spindle),
        (Feed::from_mm_per_min(240), Feed::from_mm_per_min(60), 14_000),
        "speeds"
    );
    let strategy = settings.options().strategy;
    assert_eq!((settings.safe, strategy), (um(1500), Some(Strategy::Voronoi)), "zsafe and voronoi");
    assert_eq!((settings.dialect.spin_up, settings.machine.spin_up), (2000, 2000), "spinup-time");
    assert_eq!(
        (settings.drilling.cut, settings.drill_tolerance, settings.drill_bore),
        (um(1900), um(100_000), true),
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
        (settings.tabs, settings.tab_width, settings.tab_top),
        (Holding::Count(3), um(2500), um(1100)),
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
    assert_eq!(
        (made.options().strategy, made.dialect.name.as_ref()),
        (Some(Strategy::Outline), "linuxcnc"),
        "outlines"
    );
    assert_eq!(made.cutout_tool.kind, ToolKind::EndMill { diameter: um(1000) }, "its own unit");
}

#[test]
fn passes_and_bridges_mean_what_pcb2gcode_means() {
    let made = settings(project("metric=1\nmill-diameters=0.2\nextra-passes=2\nbridges=0"));
    assert_eq!(
        made.isolation[0].widening.as_ref().map(|w| (w.width, w.overlap)),
        Some((Some(um(400)), um(100))),
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
fn an_option_that_asks_for_the_front_has_the_last_word() {
    for (text, side) in [
        ("drill-front=false\ncut-front=0", Side::Back),
        ("drill-front=no\ncut-front=no\ndrill-side=front\ncut-side=front", Side::Back),
        ("drill-side=back\ncut-side=back\ndrill-front=true\ncut-front=1", Side::Front),
    ] {
        let made = settings(project(text));
        assert_eq!((made.drill_side, made.cutout_side), (side, side), "{text}");
    }
}

#[test]
fn speeds_of_the_cutter_count_where_its_diameter_is_not_said() {
    for text in ["", "cutter-diameter=0\n"] {
        let made = settings(project(&format!("\u{feff}metric=1\n{text}cut-feed=222\ncut-speed=7777")));
        let tool = &made.cutout_tool;
        assert_eq!(tool.kind, ToolKind::EndMill { diameter: um(1000) }, "the usual one");
        let expected = (Feed::from_mm_per_min(222), Feed::from_mm_per_min(111), 7777);
        assert_eq!((tool.feed, tool.plunge, tool.spindle), expected, "its speeds, the plunge halved");
    }
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
    let left: Vec<_> = named.left.iter().map(Warning::text).collect();
    assert_eq!(
        left,
        [
            "`drill-output` is not taken over: all files lie in output-dir",
            "`milldrill-output` is not taken over: bored holes are in the drill program",
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
        ("mill-diameters = 0.1;0.2", "lengths, separated by commas"),
        ("tile-x = two", "a whole number"),
        ("drill-side = left", "front, back or auto"),
        ("milling-overlap = 120%", "less than 100%"),
        ("tolerance = 0", "above zero"),
    ] {
        let error = MillProject::read("millproject", text).expect_err(text).to_string();
        assert!(error.contains(reason), "`{text}` gives `{error}`");
    }
}

/// A fixture that shows one construct.
fn construct(name: &str) -> Result<MillProject, Error> {
    let path = fixture().with_file_name(name);
    MillProject::read("millproject", &fs::read_to_string(&path).expect(name))
}

/// What is told of a project.
fn told(project: &MillProject) -> String {
    project.left.iter().map(|warning| format!("{}\n", warning.text())).collect()
}

#[test]
fn a_spindle_that_is_switched_by_hand_turns_as_usual() {
    let made = project("metric = true\nmill-speed = 0\ncut-speed = 0\ndrill-speed = 0\n");
    assert_eq!(told(&made).matches("a spindle that stands cuts nothing").count(), 3, "{}", told(&made));
    let made = settings(made);
    assert!(made.cutout_tool.spindle > 0 && made.isolation[0].tool.spindle > 0, "the usual");
}

#[test]
fn every_unit_of_pcb2gcode_is_read() {
    let made = settings(construct("units").expect("a project"));
    let fine = &made.isolation[0];
    assert_eq!((fine.heights.cut, fine.kerf()), (Nm::new(101_600), um(200)), "thousandths and millimeters");
    assert_eq!(
        (fine.tool.feed, fine.tool.plunge, fine.tool.spindle),
        (Feed::from_mm_per_min(254), Feed::from_mm_per_min(100), 12_000),
        "per minute and per second"
    );
    assert_eq!(
        fine.widening.map(|w| (w.width, w.overlap)),
        Some((Some(um(600)), um(100))),
        "metres and percent"
    );
    assert_eq!((made.safe, made.dialect.spin_up), (Nm::new(2_540_000), 1500), "inches and seconds");
    assert_eq!(made.cutout_tool.kind, ToolKind::EndMill { diameter: Nm::new(1_016_000) }, "mils");
    assert_eq!(
        (made.cutout_tool.feed, made.cutout_tool.plunge, made.cutout_tool.spindle),
        (Feed::from_mm_per_min(300), Feed::from_mm_per_min(150), 9000),
        "half the feed where the plunge is not said"
    );
}

#[test]
fn a_width_of_metres_clears_everything_and_zero_is_no_mill() {
    let made = settings(construct("clear").expect("a project"));
    assert_eq!(made.options().clear, Some(true), "2000 mm");
    assert_eq!((made.isolation.len(), made.kerf()), (1, um(800)), "one mill");
}

#[test]
fn without_voronoi_nets_are_outlined_as_far_off_as_the_offset_says() {
    let plain = settings(project("metric=1\nzwork=-0.1"));
    assert_eq!(
        (plain.options().strategy, plain.limit),
        (Some(Strategy::Outline), None),
        "pcb2gcode's own default"
    );
    let old = construct("offset").expect("a project");
    assert!(told(&old).contains("the mill is assumed to be twice as wide"), "{}", told(&old));
    let old = settings(old);
    assert_eq!(
        (old.options().strategy, old.limit, old.kerf()),
        (Some(Strategy::Voronoi), Some(um(60)), um(120)),
        "or midway"
    );
    let mill = settings(construct("offset-of-a-mill").expect("a project"));
    assert_eq!((mill.limit, mill.kerf()), (Some(um(250)), um(300)), "half a mill further");
    let wide = construct("passes-without-a-mill").expect("a project");
    assert!(told(&wide).contains("passes of a mill without a diameter lie on each other"), "{}", told(&wide));
    let wide = settings(wide);
    assert_eq!((wide.limit, wide.kerf()), (Some(um(5000)), Nm::new(153_590)), "the usual tool fits");
    let voronoi = settings(project("voronoi=1\noffset=0.01"));
    assert_eq!(
        (voronoi.options().strategy, voronoi.limit),
        (Some(Strategy::Voronoi), None),
        "midway, however far"
    );
    // What is said on the command line wins.
    let given = Options { strategy: Some(Strategy::Voronoi), ..Options::default() };
    let won = Settings::resolve(given.or(project("zwork=-0.1mm").options)).expect("settings");
    assert_eq!(won.options().strategy, Some(Strategy::Voronoi), "as asked");
}

#[test]
fn with_copper_on_the_back_alone_the_back_is_up() {
    let made = settings(construct("back-alone").expect("a project"));
    assert_eq!((made.drill_side, made.cutout_side), (Side::Back, Side::Back), "auto");
    let made = settings(project("front=f\nback=b\ncut-side=back"));
    assert_eq!((made.drill_side, made.cutout_side), (Side::Front, Side::Back), "as it says, or the front");
}

#[test]
fn holes_are_milled_from_the_diameter_that_the_project_says() {
    let made = settings(construct("milled-holes").expect("a project"));
    assert_eq!((made.drill_bore, made.drill_bore_from), (true, Some(um(1200))), "wide ones");
    let mill = &made.drill_bore_tool;
    assert_eq!(
        (mill.kind, mill.feed, mill.spindle),
        (ToolKind::EndMill { diameter: um(1000) }, Feed::from_mm_per_min(200), 9000),
        "a mill of its own"
    );
    assert_eq!(made.drill_tolerance, um(100), "the larger of both");
    let all = settings(project("metric=1\nmilldrill=1\nmilldrill-diameter=0.7\nzmilldrill=-2"));
    assert_eq!((all.drill_bore_from, all.drilling.cut), (Some(um(700)), um(2000)), "all that it fits");
    let any = construct("any-drill").expect("a project");
    assert!(told(&any).contains("is used for every hole nearest to it"), "{}", told(&any));
    assert_eq!(settings(any).drill_tolerance, Nm::from_mm(100), "any hole");
}

#[test]
fn own_code_the_way_round_and_one_drill_are_taken_over() {
    let project = construct("own-code").expect("a project");
    assert_eq!(told(&project), "", "nothing is left");
    let folder = tempfile::TempDir::new().expect("a folder");
    for (name, line) in [("before.ngc", "M64 P0"), ("after.ngc", "M65 P0")] {
        let error = project.clone().with_own_code("own-code", folder.path()).expect_err(name).to_string();
        let at = if name == "before.ngc" { "own-code:4:1:" } else { "own-code:5:1:" };
        assert!(error.starts_with(at) && error.contains(name), "{error}");
        fs::write(folder.path().join(name), format!("{line}\n")).expect("written");
    }
    let made = settings(project.with_own_code("own-code", folder.path()).expect("both are there"));
    assert_eq!(
        (&made.dialect.own.before[..], &made.dialect.own.after[..]),
        (&["M64 P0".to_owned()][..], &["M65 P0".to_owned()][..]),
        "line by line"
    );
    assert_eq!(
        made.options().direction,
        Some(Direction::Conventional),
        "against the clock round what is kept"
    );
    assert_eq!(
        (made.options().park, made.options().tool_change_at),
        (Some(ToolChangeAt::Height(Length(Nm::from_mm(35)))), None),
        "zchange"
    );
    // The board's holes of three diameters, with one drill, which the judge expects.
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    let drills = |more: &str| {
        let options = Options::from_toml("f", &format!("drill-bore = false\n{more}")).expect("options");
        let settings = Settings::resolve(options).expect("settings");
        let loaded = import::load(std::slice::from_ref(&board), &Selection::default()).expect("a board");
        let job = job::mill(loaded, &settings).expect("a job");
        assert!(job.verify(&settings).expect("judged").passes(Severity::Error), "{more}");
        let tags = job.programs.iter().filter(|program| program.part == Part::Drill);
        tags.map(|program| program.tag.clone()).collect::<Vec<_>>()
    };
    let all = drills("");
    assert!(all.len() > 1, "{all:?}");
    assert_eq!(drills("one-drill = true"), all[..1], "the thinnest");
}

#[test]
fn bridges_are_as_thick_as_they_can_be() {
    let nothing = construct("bridges-of-nothing").expect("a project");
    assert!(told(&nothing).contains("bridges below the cut hold nothing"), "{}", told(&nothing));
    assert_eq!(settings(nothing).tabs, Holding::Count(0), "none");
    let shallow = construct("shallow").expect("a project");
    assert!(told(&shallow).contains("`zbridges` is not taken over"), "{}", told(&shallow));
    assert_eq!(settings(shallow).tabs, Holding::Count(0), "nothing is cut through");
    let deep = project("metric = true\nzcut = -2.5\nbridges = 2\nzbridges = -2\n");
    assert!(told(&deep).contains("hold nothing: tabs of the usual height do"), "{}", told(&deep));
    let deep = settings(deep);
    assert_eq!((deep.tabs, deep.tab_top), (Holding::Count(2), um(1000)), "0.6 mm of 1.6 mm");
    let made = settings(construct("bridges-to-the-surface").expect("a project"));
    assert_eq!((made.tabs, made.tab_top), (Holding::Count(2), um(50)), "the cutter is lifted out");
}

#[test]
fn an_autoleveller_becomes_two_commands() {
    let project = construct("autoleveller").expect("a project");
    let told = told(&project);
    assert!(
        told.contains("`voromill probe --side front --probe-grid 8mm --probe-feed 60mm/min`")
            && told.contains("`voromill level`"),
        "{told}"
    );
}

#[test]
fn what_would_make_another_board_is_refused_with_its_line_where_it_matters() {
    for (name, reason) in [
        ("above-the-surface", "millproject:4:1: `zwork = 0.1`: expected a z below zero"),
        ("inverted", "millproject:2:1: `invert-gerbers = true`: expected false"),
        ("turned-bottom-up", "millproject:2:1: `mirror-yaxis = true`: expected false"),
        ("apart", "millproject:2:1: `milling-overlap = -0.2mm`: expected zero or more"),
        ("many-digits", "millproject:4:1: `cut-infeed = 088888888888888888.8"),
    ] {
        let error = construct(name).expect_err(name).to_string();
        assert!(error.contains(reason), "{name}: {error}");
    }
    for text in
        ["outline=o\nzwork=0.1", "drill=d\ninvert-gerbers=1", "front=f\nmirror-yaxis=1", "front=f\nzdrill=1"]
    {
        assert!(MillProject::read("millproject", text).is_ok(), "nothing of the board is made by it: {text}");
    }
    let low = construct("low-travel").expect("a project");
    let error = Settings::resolve(low.options.clone()).expect_err("no height for travel");
    assert!(low.explain(error).to_string().starts_with("millproject:3:1: `zsafe = 0.0`: "), "its line");
}

/// How a project of the corpus fared.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Fate {
    /// Its settings make sense, its board is read.
    Taken,
    /// The same, and nothing of its board is copper: holes and edge alone.
    WithoutCopper,
    /// It says why not, with the line; or its board is an outline alone that does not close.
    Refused,
    /// The corpus has its settings alone.
    WithoutFiles,
}

/// The projects of pcb2gcode and of users.
#[test]
fn every_project_of_the_corpus_is_taken_over_or_refused_with_the_line() {
    let Some(artwork) = corpus::artwork() else { return };
    let corpus = artwork.join("millprojects");
    let expected = fs::read_to_string(corpus.join("EXPECT.json")).expect("readable");
    let expected: serde_json::Value = serde_json::from_str(&expected).expect("JSON");
    let mut fates = Vec::new();
    let (users, own): (Vec<_>, Vec<_>) =
        expected.as_object().expect("cases").keys().cloned().partition(|case| case.starts_with("users/"));
    for case in own.iter().map(|case| corpus.join(case).join("millproject")).chain(
        users.iter().map(|case| case.split(' ').next().unwrap_or_default()).flat_map(|folder| {
            let entries = fs::read_dir(corpus.join(folder)).expect("a folder");
            entries
                .map(|entry| entry.expect("an entry").path())
                .filter(|path| path.to_string_lossy().contains("millproject"))
        }),
    ) {
        fates.push((case.clone(), fate(&case)));
    }
    fates.sort();
    fates.dedup();
    let count = |fate: &Fate| fates.iter().filter(|(_, other)| other == fate).count();
    let taken = count(&Fate::Taken) + count(&Fate::WithoutCopper);
    assert_eq!(
        (fates.len(), taken, count(&Fate::Refused), count(&Fate::WithoutFiles)),
        (72, 59, 8, 5),
        "{fates:#?}"
    );
}

/// Reads a project, its settings and its board, and mills the board where that is quick.
fn fate(path: &Path) -> Fate {
    let text = fs::read_to_string(path).expect("a project");
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let refused = |error: &Error| {
        let said = error.to_string();
        let place = said.strip_prefix(&name).and_then(|rest| rest.strip_prefix(':')?.split(':').next());
        let line: usize =
            place.and_then(|line| line.parse().ok()).unwrap_or_else(|| panic!("{path:?}: {said}"));
        assert!(line >= 1 && line <= text.lines().count(), "{path:?}: {said}");
        Fate::Refused
    };
    let project = match MillProject::read(&name, &text) {
        Ok(project) => project,
        Err(error) => return refused(&error),
    };
    assert!(project.left.iter().all(|warning| warning.source.is_some()), "{path:?}: with its line");
    let settings = match Settings::resolve(project.options.clone()) {
        Ok(settings) => settings,
        Err(error) => return refused(&project.explain(error)),
    };
    let within = |file: &Option<PathBuf>| file.as_ref().map(|file| path.with_file_name("").join(file));
    let files = &project.files;
    let selection = Selection {
        front: within(&files.front),
        back: within(&files.back),
        outline: within(&files.outline),
        drill: within(&files.drill).into_iter().collect(),
        outline_gap: Some(settings.outline_gap),
        ..Selection::default()
    };
    let paths: Vec<PathBuf> =
        [&files.front, &files.back, &files.outline, &files.drill].into_iter().filter_map(within).collect();
    if paths.is_empty() || paths.iter().any(|path| !path.is_file()) {
        return Fate::WithoutFiles;
    }
    let loaded = match import::load(&paths, &selection) {
        Ok(loaded) => loaded,
        Err(error) if error.to_string().contains("the outline of the board is not closed") => {
            return Fate::Refused;
        }
        Err(error) => panic!("{path:?}: {error}"),
    };
    let fate = if loaded.board.front.is_none() && loaded.board.back.is_none() {
        Fate::WithoutCopper
    } else {
        Fate::Taken
    };
    let bytes: u64 = paths.iter().map(|path| fs::metadata(path).map_or(0, |file| file.len())).sum();
    if bytes <= if cfg!(debug_assertions) { 2_500 } else { 30_000 } {
        // An outline file that draws nothing, or does not close, is warned of: nothing is cut out.
        let has_edge = loaded.board.outline.is_some();
        let is_said = |warning: &Warning| matches!(warning.code(), "outline-empty" | "outline-open");
        assert!(
            has_edge || loaded.warnings.iter().any(is_said) || files.outline.is_none(),
            "{path:?}: no edge, and no word of it"
        );
        let parts = [
            (Part::Front, files.front.is_some()),
            (Part::Back, files.back.is_some()),
            (Part::Cutout, has_edge),
        ];
        let job = job::mill(loaded, &settings).unwrap_or_else(|error| panic!("{path:?}: {error}"));
        for (part, _) in parts.into_iter().filter(|(_, is_asked)| *is_asked) {
            assert!(job.programs.iter().any(|program| program.part == part), "{path:?}: {part:?}");
        }
    }
    fate
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
