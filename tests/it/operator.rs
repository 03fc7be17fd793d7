//! What a person at the machine gets: a header that tells what to mount, a tool that stands high
//! before a hand reaches in, files that can be run one after another on Grbl.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use voromill::gcode::dialect;
use voromill::gcode::read::{self, Way, read};
use voromill::geometry::{Arc, Nm, Point};
use voromill::import::{self, Selection};
use voromill::job::{self, Job, Options, Part, Settings};

use crate::cli::{stderr, voromill};

fn board(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(name)
}

fn mill(name: &str, settings: &str) -> (Job, Settings) {
    let loaded = import::load(&[board(name)], &Selection::default()).expect("a board");
    let options = Options::from_toml("voromill.toml", settings).expect("settings");
    let settings = Settings::resolve(options).expect("settings that make sense");
    (job::mill(loaded, &settings).expect("a job"), settings)
}

/// The text of the comment in a line.
fn comment(line: &str) -> Option<&str> {
    line.strip_prefix('(').and_then(|rest| rest.strip_suffix(')')).or_else(|| line.strip_prefix("; "))
}

#[test]
fn the_first_ten_lines_tell_what_to_mount_and_where_zero_is() {
    let everything = "drills = \"0.6mm,0.8mm\"\ndrill-bore = true\nalignment-holes = \"3mm\"\n";
    for dialect in ["grbl", "linuxcnc", "marlin"] {
        let (job, _) = mill("regulator", &format!("{everything}dialect = \"{dialect}\""));
        for program in &job.programs {
            let useful: Vec<&str> = program
                .text
                .lines()
                .map_while(comment)
                .take_while(|line| !line.starts_with("made by"))
                .collect();
            let what = format!("{} in {dialect}: {useful:#?}", program.tag);
            assert!((5..=10).contains(&useful.len()), "{what}");
            assert!(useful[0].starts_with("regulator "), "what it makes: {what}");
            let mounts = useful[1].starts_with("mount tool ") || useful[1].starts_with("tools: T");
            assert!(mounts, "the tool: {what}");
            let says = |begin: &str| useful.iter().any(|line| line.starts_with(begin));
            assert!(says("takes about ") && says("x ") && says("zero: x y the lower left corner"), "{what}");
            assert_eq!(says("mirrored left to right"), program.part == Part::Back, "{what}");
        }
    }
}

#[test]
fn the_header_says_how_far_the_program_goes() {
    let (job, _) = mill("blinker", "");
    for program in &job.programs {
        let said =
            program.text.lines().filter_map(comment).find(|line| line.starts_with("x ")).expect("extents");
        let figures: Vec<f64> = said.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
        let [x0, x1, y0, y1, z0, z1] = figures[..] else { panic!("{said}") };
        let listing = read(&program.text).expect("a program");
        let (mut xs, mut ys, mut zs) = (Vec::new(), Vec::new(), Vec::new());
        for motion in &listing.motions {
            zs.extend(motion.to.z.map(Nm::to_mm));
            let (Some(from), Some(to)) = (motion.from.point(), motion.to.point()) else { continue };
            let mut points = vec![to];
            if let Way::Arc { center, turn } = motion.way {
                points.extend(Arc { start: from, end: to, center, turn }.flatten(Nm::from_um(1)));
            }
            xs.extend(points.iter().map(|p: &Point| p.x.to_mm()));
            ys.extend(points.iter().map(|p| p.y.to_mm()));
        }
        for (said, found) in [([x0, x1], xs), ([y0, y1], ys), ([z0, z1], zs)] {
            let least = found.iter().copied().fold(f64::MAX, f64::min);
            let most = found.iter().copied().fold(f64::MIN, f64::max);
            assert!(
                (said[0] - least).abs() < 0.008,
                "{}: {} is said, {least} is gone to",
                program.tag,
                said[0]
            );
            assert!(
                (said[1] - most).abs() < 0.008,
                "{}: {} is said, {most} is gone to",
                program.tag,
                said[1]
            );
        }
    }
}

#[test]
fn controllers_that_show_messages_are_told_what_to_fit() {
    for dialect in dialect::ALL {
        let (job, _) = mill("blinker", &format!("dialect = \"{}\"", dialect.name));
        let shows =
            ["grblhal", "fluidnc", "linuxcnc", "mach3", "mach4", "g2core"].contains(&dialect.name.as_ref());
        for program in &job.programs {
            assert_eq!(program.text.contains("(MSG, "), shows, "{} {}", dialect.name, program.tag);
        }
    }
}

/// A stop or the end of a program: the height, the place, and whether the spindle turns.
type Stand = (f64, Option<(f64, f64)>, bool);

/// Each stop and the end.
fn stands(text: &str) -> Vec<Stand> {
    let listing = read(text).expect("a program");
    let mut stands = Vec::new();
    let ends = listing.stops.iter().map(|stop| stop.before).chain([listing.motions.len()]);
    for count in ends {
        let place = listing.motions[count - 1].to;
        let line = listing.motions[count - 1].line as usize;
        // The spindle is off before the next word that waits or ends.
        let waits = |line: &&str| line.contains("M0") || line.contains("M6") || line.contains("M2");
        let before = text.lines().skip(line).take_while(|line| !waits(line));
        let off = before.into_iter().any(|line| line == "M5");
        let point = place.point().map(|p| (p.x.to_mm(), p.y.to_mm()));
        stands.push((place.z.expect("a height").to_mm(), point, !off));
    }
    stands
}

#[test]
fn the_tool_stands_high_and_still_wherever_a_hand_reaches_in() {
    for (settings, height, place) in [
        ("tool-change = \"pause\"", 20.0, None),
        ("dialect = \"linuxcnc\"\npark = \"35mm\"", 35.0, None),
        (
            "dialect = \"smoothieware\"\ntool-change = \"pause\"\npark = \"-5mm,80mm,30mm\"",
            30.0,
            Some((-5.0, 80.0)),
        ),
        ("park = \"2mm\"", 2.0, None),
    ] {
        let (job, settings_made) = mill("regulator", settings);
        let drilling = job.programs.iter().find(|program| program.part == Part::Drill).expect("holes");
        let stood = stands(&drilling.text);
        let waits = ["pause", "linuxcnc"].iter().any(|way| settings.contains(way));
        assert_eq!(stood.len() > 3, waits, "{settings}");
        for (z, at, spins) in stood {
            // The very first M6 finds the tool where it was lifted to.
            assert!((z - height).abs() < 1e-9, "{settings}: at {z} mm");
            assert!(place.is_none() || at.is_none() || at == place, "{settings}: at {at:?}");
            assert!(!spins || at.is_none(), "{settings}: the spindle turns");
        }
        let report = job.verify(&settings_made).expect("programs that can be followed");
        assert!(
            report.findings.iter().all(|finding| finding.severity < voromill::verify::Severity::Error),
            "{settings}"
        );
    }
}

#[test]
fn the_way_from_a_change_of_tools_is_as_high_as_the_change() {
    let (job, _) = mill("regulator", "tool-change = \"pause\"\npark = \"25mm\"");
    let drilling = job.programs.iter().find(|program| program.part == Part::Drill).expect("holes");
    let lines: Vec<&str> = drilling.text.lines().filter(|line| !line.starts_with('(')).collect();
    let stops: Vec<usize> = (0..lines.len()).filter(|&at| lines[at] == "M0").collect();
    assert!(stops.len() > 2, "several drills");
    for at in stops {
        let [up, spin, wait, over, down] = [1, 2, 3, 4, 5].map(|next| lines[at + next]);
        assert_eq!(
            (lines[at - 1], lines[at - 2], up, wait),
            ("M5", "G0 Z25", "G0 Z25", "G4 P3"),
            "raised, and up to speed"
        );
        assert!(spin.starts_with("M3 S") && over.starts_with("G0 X") && !over.contains('Z'), "{spin} {over}");
        assert_eq!(down, "G0 Z2", "over the place, then down");
    }
}

#[test]
fn ones_own_lines_stand_where_they_are_asked_for() {
    let folder = TempDir::new().expect("a folder");
    for (file, text) in [("before.nc", "M64 P0\nG91\n"), ("after.nc", "G53 G0 Z0\n"), ("change.nc", "G28\n")]
    {
        fs::write(folder.path().join(file), text).expect("written");
    }
    let path = board("regulator");
    let mill = |more: &[&str]| {
        let fixed = ["mill", &path.to_string_lossy(), "-o", "out", "--no-html"];
        voromill(folder.path(), &[&fixed[..], more].concat())
    };
    let own = ["--before", "before.nc", "--after", "after.nc"];
    let done = mill(&[&own[..], &["--at-tool-change", "change.nc", "--dialect", "linuxcnc"]].concat());
    assert!(done.status.success(), "they are passed over when programs are judged: {}", stderr(&done));
    let text = fs::read_to_string(folder.path().join("out/regulator-drill.ngc")).expect("written");
    let modes = "G17 G21 G40 G49 G80 G90 G91.1 G94\nG64 P0.005\nG0 Z20\n";
    let begins = format!("(own G-code begins)\nM64 P0\nG91\n(own G-code ends)\n{modes}");
    assert!(text.contains(&begins), "before all else, with our modes after it: {text}");
    assert!(text.ends_with("M5\n(own G-code begins)\nG53 G0 Z0\n(own G-code ends)\nM2\n"), "{text}");
    let changes = text.matches(" M6\n").count() - 1;
    assert_eq!(text.matches("(own G-code begins)\nG28\n(own G-code ends)\n").count(), changes, "{text}");
    assert_eq!(text.matches("G91.1 G94\n").count(), changes + 1, "modes are said anew after each");
    let read = read::without_own_code(&text);
    assert!(voromill::gcode::read(&read).is_ok(), "what is ours is followed");
    let done = mill(&["--at-tool-change", "change.nc"]);
    assert!(
        stderr(&done).contains("at-tool-change: with the dialect grbl each tool has a file of its own"),
        "{}",
        stderr(&done)
    );
    fs::write(folder.path().join("after.nc"), "G4 P1\n(für)\n").expect("written");
    let done = mill(&own);
    assert_eq!(done.status.code(), Some(2), "no ASCII");
    assert!(stderr(&done).contains("after.nc:2: expected printable ASCII"), "{}", stderr(&done));
}

/// Twice the area on the left of each closed way at one depth, in mm².
fn turns(text: &str) -> Vec<f64> {
    let listing = read(text).expect("a program");
    let mut areas = Vec::new();
    let (mut area, mut start): (f64, Option<Point>) = (0.0, None);
    for motion in &listing.motions {
        let (Some(from), Some(to)) = (motion.from.point(), motion.to.point()) else { continue };
        if motion.way == Way::Rapid || from == to {
            (area, start) = (0.0, Some(to));
            continue;
        }
        let mut at = from;
        let mut points = vec![to];
        if let Way::Arc { center, turn } = motion.way {
            points = Arc { start: from, end: to, center, turn }.flatten(Nm::from_um(5)).collect();
        }
        for point in points {
            area += at.x.to_mm() * point.y.to_mm() - point.x.to_mm() * at.y.to_mm();
            at = point;
        }
        if start == Some(to) {
            areas.push(area);
            area = 0.0;
        }
    }
    areas
}

#[test]
fn loops_that_share_a_cut_go_round_what_is_kept_as_they_are_asked_to() {
    let folder = TempDir::new().expect("a temporary folder");
    // Two squares of 2 mm, either side of zero, nearer to each other than two cuts are wide.
    let text = "%FSLAX33Y33*%\n%MOMM*%\n%ADD10R,2X2*%\nD10*\nX-1051Y0D03*\nX1051Y0D03*\nM02*\n";
    fs::write(folder.path().join("a-F_Cu.gbr"), text).expect("written");
    for (direction, sign) in [("climb", -1.0), ("conventional", 1.0)] {
        let arguments = ["isolate", "a-F_Cu.gbr", "--tool", "endmill:0.1mm", "--strategy", "outline"];
        let more = ["--direction", direction, "--origin", "keep", "-o", "a.ngc"];
        let done = voromill(folder.path(), &[&arguments[..], &more].concat());
        assert!(done.status.success(), "{}", stderr(&done));
        let text = fs::read_to_string(folder.path().join("a.ngc")).expect("written");
        let listing = read(&text).expect("a program");
        let cuts = listing.motions.iter().filter(|motion| motion.way != Way::Rapid);
        let places = cuts.filter_map(|motion| Some((motion.from.point()?, motion.to.point()?)));
        // Twice the area that the way sweeps as seen from zero.
        let swept =
            |(from, to): (Point, Point)| from.x.to_mm() * to.y.to_mm() - to.x.to_mm() * from.y.to_mm();
        let area: f64 = places.map(swept).sum();
        assert!(area * sign > 15.0, "{direction}: {area} mm²");
    }
}

#[test]
fn loops_go_round_what_is_kept_as_they_are_asked_to() {
    for (direction, sign) in [("climb", -1.0), ("conventional", 1.0)] {
        let settings = format!("direction = \"{direction}\"\nstrategy = \"outline\"\ntabs = 0");
        // The one is flipped. No loop of it goes round a hole in copper.
        for (name, part) in [("blinker", Part::Back), ("qfn-breakout", Part::Front)] {
            let (job, _) = mill(name, &settings);
            let program = job.programs.iter().find(|program| program.part == part).expect("a side");
            let turns = turns(&program.text);
            let kept = turns.iter().filter(|&&area| area * sign > 0.0).count();
            assert!(
                turns.len() > 10 && kept + 1 >= turns.len(),
                "{name} {direction}: {kept} of {}",
                turns.len()
            );
        }
        let (job, made) = mill("regulator", &settings);
        let cutout = job.programs.iter().find(|program| program.part == Part::Cutout).expect("an outline");
        let turns = turns(&cutout.text);
        let largest = turns.iter().copied().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        assert!(largest * sign > 0.0, "round the board: {turns:?}");
        let window: Vec<f64> =
            turns.iter().copied().filter(|area| area.abs() < largest.abs() / 2.0).collect();
        assert!(
            !window.is_empty() && window.iter().all(|area| area * sign < 0.0),
            "in the window: {turns:?}"
        );
        let report = job.verify(&made).expect("programs that can be followed");
        let is_wrong =
            |finding: &voromill::verify::Finding| finding.severity == voromill::verify::Severity::Error;
        assert!(!report.findings.iter().any(is_wrong), "{direction}");
    }
}

/// Grbl 1.1 as far as a person sees it (protocol.c, system.c, gcode.c): what it takes in which
/// state, where the tip of the tool is above the copper.
struct Grbl {
    state: State,
    /// Of the spindle's nose above the copper, in nanometres.
    nose: i64,
    /// What is added to z in a program (G54), kept until it is set anew.
    offset: i64,
    /// From the nose to the tip.
    tool: i64,
    spinning: bool,
    /// Whether z counts from where the tool is (G91).
    relative: bool,
    /// How high a plate lies above the copper, where the probe's wires are on it and on the tool.
    plate: Option<i64>,
    /// The lowest that the tip has been above the copper.
    deepest: i64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Idle,
    Hold,
}

/// The number of Grbl's error, or that it does not answer.
#[derive(Debug, PartialEq)]
enum Refusal {
    Error(u8),
    Silent,
}

impl Grbl {
    fn new() -> Self {
        Self {
            state: State::Idle,
            nose: 60_000_000,
            offset: 0,
            tool: 0,
            spinning: false,
            relative: false,
            plate: None,
            deepest: 0,
        }
    }

    fn send(&mut self, line: &str) -> Result<(), Refusal> {
        if line == "~" {
            self.state = State::Idle;
            return Ok(());
        }
        if let Some(jog) = line.strip_prefix("$J=G91 Z") {
            if self.state != State::Idle {
                return Err(Refusal::Error(8));
            }
            self.nose += number(jog.split(' ').next().unwrap_or_default());
            return Ok(());
        }
        if self.state == State::Hold {
            return Err(Refusal::Silent);
        }
        let words: Vec<&str> = line.split(' ').filter(|_| !line.starts_with('(')).collect();
        let z = words.iter().find_map(|word| word.strip_prefix('Z')).map(number);
        if line.starts_with("G10 L20 P1 ") {
            self.offset = self.nose - z.unwrap_or(self.nose);
            return Ok(());
        }
        if words.contains(&"G92") {
            self.offset = self.nose - z.expect("z alone");
            return Ok(());
        }
        if words.contains(&"M6") {
            return Err(Refusal::Error(20));
        }
        for word in &words {
            match *word {
                "M0" => self.state = State::Hold,
                "M3" => self.spinning = true,
                "M5" | "M2" => self.spinning = false,
                "G91" => self.relative = true,
                "G90" => self.relative = false,
                _ => {}
            }
        }
        if let Some(z) = z {
            let to = z + if self.relative { self.nose } else { self.offset };
            self.nose = if words.contains(&"G38.2") {
                let contact = self.plate.expect("the wires are on") + self.tool;
                assert!(!self.spinning, "nobody probes with a tool that turns");
                assert!(to <= contact && contact < self.nose, "no alarm: it touches, and not at once");
                contact
            } else {
                to
            };
            self.deepest = self.deepest.min(self.tip());
        }
        Ok(())
    }

    /// The tip above the copper.
    const fn tip(&self) -> i64 {
        self.nose - self.tool
    }

    /// A person fits a tool that sticks out so far: the machine must stand, high enough.
    fn mount(&mut self, length: i64) {
        assert!(!self.spinning, "nobody reaches for a spindle that turns");
        assert!(self.tip() > 10_000_000, "there is room for a hand: {} nm", self.tip());
        self.tool = length;
        self.deepest = 0;
    }

    /// A person jogs down until the tip touches, and sets z to zero there.
    fn touch_off(&mut self) -> Result<(), Refusal> {
        let way = self.tip();
        self.send(&format!("$J=G91 Z{}.{:06} F100", -way / 1_000_000, way % 1_000_000))?;
        self.send("G10 L20 P1 Z0")?;
        self.send("$J=G91 Z5 F100")
    }
}

/// In nanometres.
fn number(text: &str) -> i64 {
    let (whole, part) = text.split_once('.').unwrap_or((text, ""));
    let negative = whole.starts_with('-');
    let value: i64 = format!("{}{part:0<6}", whole.trim_start_matches('-')).parse().expect("a number");
    if negative { -value } else { value }
}

#[test]
fn a_drill_job_is_run_on_grbl_file_by_file() {
    let (job, settings) = mill("regulator", "");
    let mut grbl = Grbl::new();
    let files: Vec<_> = job.programs.iter().filter(|program| program.part == Part::Drill).collect();
    assert!(files.len() > 3, "several drills");
    for (program, length) in files.iter().zip([20_000_000, 27_500_000, 18_000_000, 24_000_000, 31_000_000]) {
        assert!(program.file_name("b", &settings).contains("mm.ngc"), "one knows which to mount");
        grbl.mount(length);
        grbl.touch_off().expect("it is idle");
        for line in program.text.lines() {
            assert_eq!(grbl.send(line), Ok(()), "{line}");
        }
        assert_eq!(grbl.state, State::Idle, "it has come to its end");
        let planned = program.program.sections.iter().flat_map(|section| &section.moves);
        let deepest = planned.filter_map(voromill::toolpath::Move::to).map(|to| to.z.get()).min();
        let off = (grbl.deepest - deepest.expect("holes")).abs();
        assert!(off <= 50, "{off} nm off what was planned to the last digit, however long the drill is");
    }
}

#[test]
fn with_a_plate_every_drill_finds_its_own_zero() {
    let (job, _) = mill("regulator", "tool-probe = \"-10mm,5mm,1.6mm\"");
    let mut grbl = Grbl::new();
    let files: Vec<_> = job.programs.iter().filter(|program| program.part == Part::Drill).collect();
    assert!(files.len() > 3, "several drills");
    // Zero is set once, with the first.
    grbl.mount(20_000_000);
    grbl.touch_off().expect("it is idle");
    grbl.send("$J=G91 Z40 F100").expect("up");
    grbl.plate = Some(1_600_000);
    for (program, length) in files.iter().zip([20_000_000, 27_500_000, 18_000_000, 24_000_000, 31_000_000]) {
        grbl.mount(length);
        for line in program.text.lines() {
            assert_eq!(grbl.send(line), Ok(()), "{line}");
        }
        let planned = program.program.sections.iter().flat_map(|section| &section.moves);
        let deepest = planned.filter_map(voromill::toolpath::Move::to).map(|to| to.z.get()).min();
        let off = (grbl.deepest - deepest.expect("holes")).abs();
        assert!(off <= 50, "{off} nm off what was planned, however long the drill is");
    }
}

#[test]
fn at_a_pause_grbl_takes_no_new_zero() {
    let (job, _) = mill("regulator", "tool-change = \"pause\"");
    let program = job.programs.iter().find(|program| program.part == Part::Drill).expect("holes");
    let mut grbl = Grbl::new();
    grbl.mount(20_000_000);
    grbl.touch_off().expect("it is idle");
    for line in program.text.lines() {
        assert_eq!(grbl.send(line), Ok(()), "{line}");
        if grbl.state == State::Hold {
            break;
        }
    }
    assert_eq!(grbl.touch_off(), Err(Refusal::Error(8)), "no jog while it holds");
    assert_eq!(grbl.send("G10 L20 P1 Z0"), Err(Refusal::Silent), "and no zero");
    assert_eq!(grbl.send("T2 M6"), Err(Refusal::Silent), "nor anything else");
    grbl.send("~").expect("it goes on");
    assert_eq!(grbl.send("T2 M6"), Err(Refusal::Error(20)), "M6 is unknown to it");
}
