//! Whole programs of whole boards: what every dialect's text makes the machine do is what was
//! planned, to the last digit.

use std::path::{Path, PathBuf};

use voromill::gcode::dialect::ALL;
use voromill::gcode::read::{Motion, Way};
use voromill::gcode::{Dialect, Header, read, write};
use voromill::geometry::{Arc, Nm, Point};
use voromill::import;
use voromill::job::{self, Job, Options, Settings};
use voromill::toolpath::{Feed, Move, Position, Program, Section};

use crate::corpus::board_folders;
use crate::real_boards::selection;

/// The job on the files in `folder`.
fn job(folder: &Path, settings: &str) -> Job {
    let loaded = import::load(&[folder.to_path_buf()], &selection(folder)).expect("a board");
    let options = Options::from_toml("voromill.toml", settings).expect("settings");
    job::mill(loaded, &Settings::resolve(options).expect("settings that make sense")).expect("a job")
}

fn fixtures() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards");
    ["blinker", "regulator", "qfn-breakout"].map(|board| folder.join(board)).to_vec()
}

/// The built-in dialects, and some of one's own for what they leave out.
fn dialects() -> Vec<Dialect> {
    let own = [
        "name = 'radius'\nbase = 'linuxcnc'\narcs = 'radius'\nline-numbers = 'by-tens'",
        "name = 'lines'\nbase = 'grbl'\narcs = 'lines'\ndecimals = 3\ncoolant = ['M8', 'M9']",
    ];
    let own = own.map(|text| Dialect::from_toml(text).expect("a dialect"));
    ALL.iter().cloned().chain(own).collect()
}

/// The motions of a text, one after another, held against a plan.
struct Follower<'a> {
    motions: std::iter::Peekable<std::slice::Iter<'a, Motion>>,
    /// One unit of the last digit.
    unit: i64,
    at: Option<Position>,
    /// Where the last move that was planned ends, before it is rounded.
    planned: Option<Position>,
    what: &'a str,
}

impl Follower<'_> {
    fn rounded(&self, p: Position) -> Position {
        let round = |length: Nm| {
            Nm::new((length.get() + self.unit / 2 * length.get().signum()) / self.unit * self.unit)
        };
        Position { x: round(p.x), y: round(p.y), z: round(p.z) }
    }

    /// The next motion, which ends at a known place.
    fn next(&mut self, wanted: Position) -> (Motion, Position) {
        let motion =
            self.motions.next().unwrap_or_else(|| panic!("{}: it ends before {wanted:?}", self.what));
        let to = motion.to;
        let to = Position {
            x: to.x.unwrap_or(wanted.x),
            y: to.y.unwrap_or(wanted.y),
            z: to.z.unwrap_or(wanted.z),
        };
        (*motion, to)
    }

    /// Lifts that the writer adds: at the start, and after a change of tools.
    fn skip_lifts(&mut self, safe: Nm) {
        let lift = |motion: &&Motion| {
            motion.way == Way::Rapid && motion.from.point() == motion.to.point() && motion.to.z == Some(safe)
        };
        while self.motions.next_if(lift).is_some() {
            self.at = self.at.map(|at| Position { z: safe, ..at });
        }
    }

    fn follow(&mut self, step: &Move) {
        let Some(planned) = step.to() else { return };
        let (from, wanted) = (self.at, self.rounded(planned));
        match *step {
            // What stays where it is is not written.
            Move::Rapid { .. } | Move::Feed { .. } if from == Some(wanted) => {}
            Move::Rapid { .. } | Move::Feed { .. } => {
                let (motion, to) = self.next(wanted);
                assert_eq!(to, wanted, "{} line {}", self.what, motion.line);
                let way = if matches!(step, Move::Rapid { .. }) { Way::Rapid } else { Way::Feed };
                assert_eq!(motion.way, way, "{} line {}", self.what, motion.line);
                if let Move::Feed { feed, .. } = step {
                    assert_eq!(motion.feed, Some(feed.get() * 1000), "{} line {}", self.what, motion.line);
                }
            }
            Move::Arc { center, turn, feed, .. } => {
                let from = from.expect("an arc follows a move");
                let start = self.planned.map_or(from.point(), Position::point);
                let exact = Arc { start, end: planned.point(), center, turn };
                if from == wanted && exact.length() < Nm::new(2 * self.unit).to_f64() {
                    // So short an arc that it ends on the digit it began on.
                    self.planned = Some(planned);
                    return;
                }
                self.round(Arc { start: from.point(), end: wanted.point(), center, turn }, wanted, feed);
            }
            Move::Dwell { .. } => {}
        }
        self.at = Some(wanted);
        self.planned = Some(planned);
    }

    /// An arc, whole, in parts, or as chords: never off it, the same way round, to its end.
    fn round(&mut self, arc: Arc, wanted: Position, feed: Feed) {
        let off = |p: Point| (arc.center.distance(p) - arc.radius()).abs();
        let most = Nm::new(4 * self.unit).to_f64() + 1_000.0;
        let mut parts = 0;
        while parts == 0 || self.at != Some(wanted) {
            let (motion, to) = self.next(wanted);
            assert_eq!(motion.feed, Some(feed.get() * 1000), "{} line {}", self.what, motion.line);
            assert!(off(to.point()) <= most, "{} line {}: off the arc", self.what, motion.line);
            match motion.way {
                Way::Arc { center, turn } => {
                    assert_eq!(turn, arc.turn, "{} line {}: the other way round", self.what, motion.line);
                    let moved = center.distance(arc.center);
                    // A radius says where the centre is only as exactly as the arc is round.
                    let flat = arc.radius() / arc.length().min(arc.radius());
                    assert!(
                        moved <= most * flat * flat * 4.0,
                        "{} line {}: centre off {moved}",
                        self.what,
                        motion.line
                    );
                }
                Way::Feed => {}
                Way::Rapid => panic!("{} line {}: a rapid on an arc", self.what, motion.line),
            }
            self.at = Some(to);
            parts += 1;
        }
    }
}

/// Holds `text` against the plan it was written from.
fn assert_does_as_planned(text: &str, program: &Program, dialect: &Dialect, what: &str) {
    let listing = read(text).unwrap_or_else(|error| panic!("{what}: {error}"));
    let unit = 10_i64.pow(u32::try_from(6 - dialect.decimals).expect("at most six"));
    let mut follower =
        Follower { motions: listing.motions.iter().peekable(), unit, at: None, planned: None, what };
    for section in &program.sections {
        follower.skip_lifts(program.safe);
        section.moves.iter().for_each(|step| follower.follow(step));
        assert_goes_down_no_faster_than_it_plunges(section, what);
    }
    follower.skip_lifts(program.safe);
    assert!(follower.motions.next().is_none(), "{what} does more than was planned");
    assert_safe(&listing.motions, program.safe, what);
    assert!(!listing.spinning, "{what} ends with the spindle on");
}

/// However much sideways a feed goes, down it goes no faster than straight down.
fn assert_goes_down_no_faster_than_it_plunges(section: &Section, what: &str) {
    let mut at: Option<Position> = None;
    for step in &section.moves {
        let Some(to) = step.to() else { continue };
        if let Some(from) = at {
            let (along, feed) = match *step {
                Move::Arc { center, turn, feed, .. } => {
                    (Arc { start: from.point(), end: to.point(), center, turn }.length(), feed)
                }
                Move::Feed { feed, .. } => (from.point().distance(to.point()), feed),
                Move::Rapid { .. } | Move::Dwell { .. } => (0.0, section.tool.plunge),
            };
            let down = (from.z - to.z).to_f64().max(0.0);
            let whole = (along * along + down * down).sqrt().max(1.0);
            let speed = feed.nm_per_second() * down / whole;
            let most = section.tool.plunge.nm_per_second();
            assert!(speed <= most * 1.000_001, "{what}, {}: {step:?} from {from:?}", section.label);
        }
        at = Some(to);
    }
}

/// No sideways rapid below the safe height, no cut with the spindle off.
fn assert_safe(motions: &[Motion], safe: Nm, what: &str) {
    for motion in motions {
        let sideways = motion.from.point() != motion.to.point();
        let low = motion.from.z.min(motion.to.z).is_some_and(|z| z < safe);
        let into = motion.to.z.is_some_and(|z| z < Nm::ZERO);
        assert!(
            motion.way != Way::Rapid || !(sideways && low),
            "{what}: a low rapid in line {}",
            motion.line
        );
        assert!(!into || motion.way != Way::Rapid, "{what}: a rapid into the board in line {}", motion.line);
        assert!(!into || motion.spindle.turns(), "{what}: spindle off in line {}", motion.line);
    }
}

fn assert_all_dialects_do_as_planned(folder: &Path, settings: &str) {
    let job = job(folder, settings);
    for dialect in dialects() {
        for written in &job.programs {
            let what = format!("{} {:?} in {}", job.board.name, written.part, dialect.name);
            let text = write(&written.program, &dialect, &Header::default());
            assert_does_as_planned(&text, &written.program, &dialect, &what);
        }
    }
}

#[test]
fn every_dialect_does_with_the_fixture_boards_as_was_planned() {
    for folder in fixtures() {
        assert_all_dialects_do_as_planned(&folder, "");
    }
}

#[test]
fn every_option_is_done_as_was_planned() {
    let folder = &fixtures()[1];
    for settings in [
        "tool = [\"endmill:0.6mm\", \"vbit:0.1mm:20deg\"]\nwidth = \"0.4mm\"\nrotate = \"17deg\"",
        "strategy = \"outline\"\ncutout-ramp = \"4deg\"\ndrill-bore = true\ntab-spacing = \"25mm\"\ndrills = \"0.6mm\"",
        "cutout-ramp = \"60deg\"\ncutout-pass = \"0.3mm\"\ncutout-tool = \"endmill:0.8mm\"\ndrill-bore-from = \"0.9mm\"",
        "adaptive-depth = \"0.04mm\"\ndrill-peck = \"0.5mm\"\ntabs = 0\nalignment-holes = \"3mm\"\norigin = \"keep\"",
    ] {
        assert_all_dialects_do_as_planned(folder, settings);
    }
}

#[test]
#[cfg_attr(debug_assertions, ignore = "takes minutes in a debug build")]
fn every_dialect_does_with_real_boards_as_was_planned() {
    for board in board_folders() {
        eprintln!("{}", board.display());
        assert_all_dialects_do_as_planned(&board, "tool = \"endmill:0.1mm\"");
    }
}
