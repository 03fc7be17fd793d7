//! The drilling machine: runs the lines of a file under a given number format and notes every hole.

mod canned;
mod codes;
mod motion;
mod repeat;

use std::collections::BTreeMap;
use std::ops::Range;

use canned::Package;

use super::block::Block;
use super::declared::{Declared, plating_of, units_of};
use super::format::{NumberFormat, Units};
use super::lex::{Kind, Line, Word};
use super::route::{Center, Interpolation};
use crate::board::{Hole, Plating};
use crate::geometry::{Nm, Path, Point, Vector};
use crate::import::diagnostic;
use crate::import::error::{Error, Warnings};

/// The most holes that a file may have, repeats included.
///
/// Chosen: forty times the densest panel met, and some 200 MB of memory.
pub(super) const MOST_HOLES: usize = 2_000_000;

/// Header commands without effect here.
pub(super) const WITHOUT_EFFECT: [&str; 30] = [
    "AFS", "ATC", "BLKD", "CCW", "CP", "DETECT", "DN", "DTMDIST", "EDI", "EXDA", "FMAT", "FSB", "HPCK",
    "NCSL", "OM48", "OSTOP", "PCKPARAM", "PF", "PLD", "R", "RC", "RTSEL", "SBK", "SG", "SIXM", "TCST", "UP",
    "VER", "ZA", "ZC",
];

/// A drill or router bit.
#[derive(Clone, Debug)]
pub(super) struct Tool {
    pub(super) diameter: Nm,
    pub(super) plating: Plating,
    /// Where the file defines it, or first takes it.
    pub(super) place: Range<usize>,
}

/// What a run leaves behind.
#[derive(Debug)]
pub(super) struct Run {
    /// In the order in which they are drilled.
    pub(super) holes: Vec<Hole>,
    /// By number, as last defined.
    pub(super) tools: BTreeMap<u32, Tool>,
    /// What is wrong with tools that are not among them.
    pub(super) broken: BTreeMap<u32, (Range<usize>, Error)>,
}

/// Everything a run needs to know of its file.
#[derive(Clone, Copy)]
pub(super) struct File<'a> {
    pub(super) name: &'a str,
    pub(super) bytes: &'a [u8],
    pub(super) lines: &'a [Line],
    pub(super) declared: &'a Declared,
    /// What the file's name or function says of its holes.
    pub(super) plating: Plating,
    /// Whether the number format holds whatever unit the file declares.
    pub(super) disbelieved: bool,
}

/// Runs the whole file.
pub(super) fn run(file: File<'_>, format: NumberFormat, warnings: &mut Warnings<'_>) -> Result<Run, Error> {
    let mut machine = Machine::new(file, format, warnings, MOST_HOLES);
    machine.all()?;
    Ok(Run { holes: machine.holes, tools: machine.tools, broken: machine.broken })
}

/// The first holes of a file, to judge a number format by.
pub(super) fn sample(file: File<'_>, format: NumberFormat) -> Result<Vec<Hole>, Error> {
    /// Enough to tell one format from another. Chosen.
    const SAMPLE: usize = 20_000;
    let mut warnings = Warnings::new(file.name, file.bytes);
    let mut machine = Machine::new(file, format, &mut warnings, SAMPLE);
    match machine.all() {
        Err(error) if machine.holes.len() < SAMPLE => Err(error),
        _ => Ok(machine.holes),
    }
}

/// What X and Y of a line do.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Mode {
    /// Drill there.
    Drill,
    /// Move the router there.
    Route(Interpolation),
}

struct Machine<'a, 'w, 'b> {
    file: File<'a>,
    format: NumberFormat,
    warnings: &'w mut Warnings<'b>,
    mode: Mode,
    absolute: bool,
    /// Where coordinates count from (`G92`, `G93`).
    zero: Point,
    at: Point,
    tools: BTreeMap<u32, Tool>,
    /// Where tools are defined that cannot be read, and why not: an error where one drills.
    broken: BTreeMap<u32, (Range<usize>, Error)>,
    tool: Option<u32>,
    /// What comments said of the tools that follow.
    plating: Plating,
    /// The hole that a lowered router bit is cutting.
    routing: Option<Hole>,
    holes: Vec<Hole>,
    /// How many holes there may be.
    most: usize,
    /// Where the last arc had its centre: it holds for arcs that say nothing.
    center: Option<Center>,
    /// A package whose holes are still to be told.
    package: Option<Package>,
    /// The holes of the last package.
    packaged: Range<usize>,
    /// Whether text to be drilled was left out, and its place follows.
    text_follows: bool,
    /// The holes of the pattern that `M25` began, and where `M01` ended it.
    pattern: Option<(usize, Option<usize>)>,
    /// How far `M02` has moved the pattern so far.
    stepped: Vector,
    ended: bool,
}

impl<'a, 'w, 'b> Machine<'a, 'w, 'b> {
    fn new(file: File<'a>, format: NumberFormat, warnings: &'w mut Warnings<'b>, most: usize) -> Self {
        Self {
            file,
            format,
            warnings,
            mode: Mode::Drill,
            absolute: true,
            zero: Point::default(),
            at: Point::default(),
            tools: BTreeMap::new(),
            broken: BTreeMap::new(),
            tool: None,
            plating: file.plating,
            routing: None,
            holes: Vec::new(),
            most,
            center: None,
            package: None,
            packaged: 0..0,
            text_follows: false,
            pattern: None,
            stepped: Vector::default(),
            ended: false,
        }
    }

    fn all(&mut self) -> Result<(), Error> {
        self.take_next(&(0..0))?;
        let mut lines = self.file.lines.iter();
        for line in lines.by_ref() {
            self.line(line)?;
            if self.ended {
                break;
            }
        }
        if let Some(line) = lines.find(|line| line.has_place()) {
            let message = "what follows the end of the program (M30) is ignored, with its holes";
            self.warnings.add(&diagnostic::TEXT_AFTER_END, line.place.clone(), message);
        }
        self.package_is_whole()?;
        self.raise()
    }

    fn line(&mut self, line: &Line) -> Result<(), Error> {
        match &line.kind {
            Kind::Comment(text) => {
                self.plating = match plating_of(text) {
                    Some(Plating::Unknown) => self.file.plating,
                    Some(plating) => plating,
                    None => self.plating,
                };
                Ok(())
            }
            Kind::Percent => {
                // Which of several it would be only the body says.
                if self.tools.len() > 1 {
                    self.tool = None;
                }
                Ok(())
            }
            Kind::Keyword(fields) => {
                self.keyword(fields, &line.place);
                Ok(())
            }
            Kind::Words(words) => self.block(&Block::new(words), line),
            Kind::BrokenTool(number, error) => {
                self.break_tool(*number, line.place.clone(), error.as_ref().clone());
                self.change_to(*number)
            }
        }
    }

    fn keyword(&mut self, fields: &[String], place: &Range<usize>) {
        let name = fields[0].as_str();
        if let Some(units) = units_of(name) {
            self.units(units, place);
        } else if name == "ICI" {
            self.absolute = fields.get(1).is_none_or(|field| field != "ON");
        } else if name.starts_with("M97") || name.starts_with("M98") {
            self.warnings.add(&diagnostic::DRILLED_TEXT, place.clone(), "drilled text (M97, M98) is ignored");
            self.text_follows = true;
        } else if !WITHOUT_EFFECT.contains(&name) && !name.starts_with("M4") {
            self.left_out(name, place);
        }
    }

    pub(super) fn left_out(&mut self, what: &str, place: &Range<usize>) {
        let message = format!("`{what}` is not a known drill command and is ignored");
        self.warnings.add(&diagnostic::UNKNOWN_DRILL_COMMAND, place.clone(), message);
    }

    /// The same unit again says nothing new; another one changes what follows.
    pub(super) fn units(&mut self, units: Units, place: &Range<usize>) {
        if units != self.format.units && !self.file.disbelieved {
            let message = format!("the unit changes to {} here; what follows is read in it", units.name());
            self.warnings.add(&diagnostic::UNIT_CHANGES, place.clone(), message);
            self.format = NumberFormat { units, digits: units.default_digits(), zeros: self.format.zeros };
        }
    }

    fn block(&mut self, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        for letter in block.unknown.iter() {
            self.left_out(&char::from(letter.letter).to_string(), &letter.place);
        }
        if let Some(word) = block.twice {
            return Err(self.wrong(word, "a second position in one line", "one X and one Y a line"));
        }
        if let Some(word) = block.tool {
            self.select(word, block.diameter)?;
        }
        for word in &block.general {
            self.general(word)?;
        }
        let mut moves = !block.sets_zero();
        for word in &block.miscellaneous {
            moves &= self.miscellaneous(word, block, line)?;
        }
        if block.sets_zero() {
            self.zero = Point::default();
            self.zero = self.target(self.zero, block.x, block.y)?;
        }
        if moves && !self.ended { self.motion(block, line) } else { Ok(()) }
    }

    /// A hole along `path` with the tool at hand.
    pub(super) fn hole(&self, path: Path, line: &Line) -> Result<Hole, Error> {
        let Some(number) = self.tool else {
            let expected = "a line such as T01 before it";
            return Err(self.wrong_line(line, "a hole is drilled before any tool is selected", expected));
        };
        if let Some((_, error)) = self.broken.get(&number) {
            return Err(error.clone());
        }
        let Some(tool) = self.tools.get(&number) else {
            let what = format!("tool T{number} drills here, but its diameter is not defined");
            let hint = format!("add its diameter to the header: T{number}C0.8");
            let (file, bytes) = (self.file.name, self.file.bytes);
            return Err(Error::syntax(file, bytes, line.place.clone(), what, "a tool with a diameter", hint));
        };
        Ok(Hole { path, diameter: tool.diameter, plating: tool.plating, tool: number, line: line.number })
    }

    /// The place that X and Y name, from `base`.
    pub(super) fn target(&self, base: Point, x: Option<&Word>, y: Option<&Word>) -> Result<Point, Error> {
        let along = |base: Nm, zero: Nm, word: Option<&Word>| -> Result<Nm, Error> {
            let Some(word) = word else { return Ok(base) };
            let length = self.length(word)?;
            let to = if self.absolute { zero + length } else { base + length };
            Nm::try_new(to.get()).map_err(|_| self.too_far(&word.place))
        };
        Ok(Point::new(along(base.x, self.zero.x, x)?, along(base.y, self.zero.y, y)?))
    }

    /// X and Y as a way, zero where one is missing.
    pub(super) fn way(&self, x: Option<&Word>, y: Option<&Word>) -> Result<Vector, Error> {
        let length = |word: Option<&Word>| word.map_or(Ok(Nm::ZERO), |word| self.length(word));
        Ok(Vector::new(length(x)?, length(y)?))
    }

    pub(super) fn in_range(&self, point: Point, place: &Range<usize>) -> Result<Point, Error> {
        let fits = |c: Nm| Nm::try_new(c.get()).is_ok();
        if fits(point.x) && fits(point.y) { Ok(point) } else { Err(self.too_far(place)) }
    }

    pub(super) fn length(&self, word: &Word) -> Result<Nm, Error> {
        self.format.length(word.number).ok_or_else(|| self.too_far(&word.place))
    }

    pub(super) fn too_far(&self, place: &Range<usize>) -> Error {
        let what =
            format!("coordinate beyond ±1073 mm (read as {}, {})", self.format.units.name(), self.format);
        let hint = "the number format may be wrong, or the file damaged";
        Error::syntax(self.file.name, self.file.bytes, place.clone(), what, "a position on a board", hint)
    }

    pub(super) fn unknown(&self, word: &Word) -> Error {
        self.wrong(
            word,
            "a drill command that is not supported",
            "holes, slots, circles and packages (G82 to G85, G32, G33), or routing with G00 to G03",
        )
    }

    pub(super) fn wrong(&self, word: &Word, what: &str, expected: &str) -> Error {
        Error::syntax(self.file.name, self.file.bytes, word.place.clone(), what, expected, "")
    }

    pub(super) fn wrong_line(&self, line: &Line, what: &str, expected: &str) -> Error {
        Error::syntax(self.file.name, self.file.bytes, line.place.clone(), what, expected, "")
    }
}
