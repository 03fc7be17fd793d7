//! The drilling machine: runs the lines of a file under a given number format and notes every hole.

mod repeat;

use std::collections::BTreeMap;
use std::ops::Range;

use super::block::Block;
use super::declared::{Declared, plating_of, units_of};
use super::format::{NumberFormat, Units};
use super::lex::{Kind, Line, Word};
use super::route::{self, Center, Interpolation};
use crate::board::{Hole, Plating};
use crate::geometry::{Nm, Path, Point, Segment, Turn, Vector};
use crate::import::error::{Error, Warnings};

/// The most holes that a file may have, repeats included.
///
/// Chosen: forty times the densest panel met, and some 200 MB of memory.
pub(super) const MOST_HOLES: usize = 2_000_000;

/// A drill or router bit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tool {
    pub(super) diameter: Nm,
    pub(super) plating: Plating,
}

/// What a run leaves behind.
#[derive(Debug)]
pub(super) struct Run {
    /// In the order in which they are drilled.
    pub(super) holes: Vec<Hole>,
    /// By number, as last defined.
    pub(super) tools: BTreeMap<u32, Tool>,
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
}

/// Runs the whole file.
pub(super) fn run(file: File<'_>, format: NumberFormat, warnings: &mut Warnings<'_>) -> Result<Run, Error> {
    let mut machine = Machine::new(file, format, warnings, MOST_HOLES);
    machine.all()?;
    Ok(Run { holes: machine.holes, tools: machine.tools })
}

/// The first holes of a file, to judge a number format by.
pub(super) fn sample(file: File<'_>, format: NumberFormat) -> Result<Vec<Hole>, Error> {
    /// Enough to tell one format from another.
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
    tool: Option<u32>,
    /// What comments said of the tools that follow.
    plating: Plating,
    /// The hole that a lowered router bit is cutting.
    routing: Option<Hole>,
    holes: Vec<Hole>,
    /// How many holes there may be.
    most: usize,
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
            tool: None,
            plating: file.plating,
            routing: None,
            holes: Vec::new(),
            most,
            pattern: None,
            stepped: Vector::default(),
            ended: false,
        }
    }

    fn all(&mut self) -> Result<(), Error> {
        for line in self.file.lines {
            self.line(line)?;
            if self.ended {
                break;
            }
        }
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
            Kind::Percent => Ok(()),
            Kind::Keyword(fields) => {
                self.keyword(fields, &line.place);
                Ok(())
            }
            Kind::Words(words) => self.block(&Block::new(words), line),
        }
    }

    fn keyword(&mut self, fields: &[String], place: &Range<usize>) {
        const WITHOUT_EFFECT: [&str; 30] = [
            "AFS", "ATC", "BLKD", "CCW", "CP", "DETECT", "DN", "DTMDIST", "EDI", "EXDA", "FMAT", "FSB",
            "HPCK", "NCSL", "OM48", "OSTOP", "PCKPARAM", "PF", "PLD", "R", "RC", "RTSEL", "SBK", "SG",
            "SIXM", "TCST", "UP", "VER", "ZA", "ZC",
        ];
        let name = fields[0].as_str();
        if let Some(units) = units_of(name) {
            self.units(units, place);
        } else if name == "ICI" {
            self.absolute = fields.get(1).is_none_or(|field| field != "ON");
        } else if name.starts_with("M97") || name.starts_with("M98") {
            self.warnings.add("drilled-text", place.clone(), "text to be drilled is left out");
        } else if !WITHOUT_EFFECT.contains(&name) && !name.starts_with("M4") {
            self.left_out(name, place);
        }
    }

    fn left_out(&mut self, what: &str, place: &Range<usize>) {
        let message = format!("`{what}` is no drill command that is known, so it is left out");
        self.warnings.add("unknown-drill-command", place.clone(), message);
    }

    /// The same unit again says nothing new; another one changes what follows.
    fn units(&mut self, units: Units, place: &Range<usize>) {
        if units != self.format.units {
            let message = format!("the unit changes to {} here; what follows is read in it", units.name());
            self.warnings.add("unit-changes", place.clone(), message);
            self.format = NumberFormat { units, digits: units.default_digits(), zeros: self.format.zeros };
        }
    }

    fn block(&mut self, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        for letter in block.unknown.iter() {
            self.left_out(&char::from(letter.letter).to_string(), &letter.place);
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

    /// Changes the tool, defining it where a diameter is given.
    fn select(&mut self, word: &Word, diameter: Option<&Word>) -> Result<(), Error> {
        let number = word.number.integer().ok_or_else(|| self.unknown(word))?;
        if let Some(size) = diameter {
            let length = self.format.diameter(size.number).filter(|&d| d > Nm::ZERO);
            let Some(diameter) = length else {
                let expected = "a diameter above zero, such as C0.8";
                return Err(self.wrong(size, "a drill cannot have this diameter", expected));
            };
            if size.number.decimals.is_none() {
                let message = format!("the diameter has no decimal point and is taken for {diameter:.3} mm");
                self.warnings.add("diameter-without-point", size.place.clone(), message);
            }
            self.tools.insert(number, Tool { diameter, plating: self.plating });
        } else if let (false, Some(&diameter)) =
            (self.tools.contains_key(&number), self.file.declared.commented.get(&number))
        {
            self.tools.insert(number, Tool { diameter, plating: self.plating });
        }
        self.raise()?;
        self.tool = (number != 0).then_some(number);
        Ok(())
    }

    fn general(&mut self, word: &Word) -> Result<(), Error> {
        match word.number.integer() {
            Some(0) => {
                self.raise()?;
                self.mode = Mode::Route(Interpolation::Rapid);
            }
            Some(1) => self.mode = Mode::Route(Interpolation::Line),
            Some(2) => self.mode = Mode::Route(Interpolation::Arc(Turn::Clockwise)),
            Some(3) => self.mode = Mode::Route(Interpolation::Arc(Turn::CounterClockwise)),
            Some(5 | 38 | 81) => {
                self.raise()?;
                self.mode = Mode::Drill;
            }
            // Dwell, feeds, cameras, compensation off; slots and zero are read from the block.
            Some(4 | 7 | 34..=37 | 39 | 40 | 45..=47 | 85 | 87 | 92 | 93) => {}
            Some(41 | 42) => {
                let message = "cutter compensation is not applied: the cut is centred on the programmed line";
                self.warnings.add("cutter-compensation", word.place.clone(), message);
            }
            Some(70) => self.units(Units::Inch, &word.place),
            Some(71) => self.units(Units::Mm, &word.place),
            Some(90) => self.absolute = true,
            Some(91) => self.absolute = false,
            _ => return Err(self.unknown(word)),
        }
        Ok(())
    }

    /// An `M` code; whether X and Y of its block are still to be gone to.
    fn miscellaneous(&mut self, word: &Word, block: &Block<'_>, line: &Line) -> Result<bool, Error> {
        match word.number.integer() {
            Some(0 | 30) => {
                self.raise()?;
                self.ended = true;
            }
            Some(1) => self.pattern = self.pattern.map(|(from, _)| (from, Some(self.holes.len()))),
            Some(2) => self.step(word, block, line)?,
            Some(6 | 9) => {}
            Some(8) => self.pattern = None,
            Some(14 | 15) => {
                if block.x.is_some() || block.y.is_some() {
                    self.at = self.target(self.at, block.x, block.y)?;
                }
                self.lower(line)?;
            }
            Some(16 | 17) => {
                self.raise()?;
                return Ok(true);
            }
            Some(25 | 31) => {
                self.pattern = Some((self.holes.len(), None));
                self.stepped = Vector::default();
            }
            Some(71) => self.units(Units::Mm, &word.place),
            Some(72) => self.units(Units::Inch, &word.place),
            Some(18 | 45..=49 | 60..=62 | 95) => return Ok(true),
            Some(70 | 80 | 90) => {
                let message = "swapped or mirrored axes are not applied outside a repeated pattern";
                self.warnings.add("axes-not-swapped", word.place.clone(), message);
                return Ok(true);
            }
            _ => self.left_out(&format!("M{:02}", word.number.digits), &word.place),
        }
        Ok(false)
    }

    /// Goes to X and Y of the block, drilling or routing as the mode has it.
    fn motion(&mut self, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        if let Some((x, y)) = block.slot {
            let from = self.target(self.at, block.x, block.y)?;
            self.at = from;
            self.at = self.target(from, x, y)?;
            let segments = if self.at == from { vec![] } else { vec![Segment::Line { to: self.at }] };
            return self.cut(Path { start: from, segments }, line);
        }
        if block.x.is_none() && block.y.is_none() {
            return Ok(());
        }
        match self.mode {
            Mode::Drill if block.repeat.is_some() => self.repeat(block, line),
            Mode::Drill => {
                self.at = self.target(self.at, block.x, block.y)?;
                self.cut(Path { start: self.at, segments: vec![] }, line)
            }
            Mode::Route(interpolation) => self.route(interpolation, block, line),
        }
    }

    fn route(&mut self, interpolation: Interpolation, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        let from = self.at;
        self.at = self.target(from, block.x, block.y)?;
        let Some(hole) = &mut self.routing else {
            if interpolation != Interpolation::Rapid {
                let message = "the router moves here without having been lowered (M15), so nothing is cut";
                self.warnings.add("router-not-lowered", line.place.clone(), message);
            }
            return Ok(());
        };
        match interpolation {
            Interpolation::Rapid | Interpolation::Line if self.at == from => {}
            Interpolation::Rapid | Interpolation::Line => {
                hole.path.segments.push(Segment::Line { to: self.at })
            }
            Interpolation::Arc(turn) => {
                let center = self.center(block)?;
                let segment =
                    center.and_then(|center| route::arc(from, self.at, turn, center)).ok_or_else(|| {
                        let expected =
                            "I and J to the centre, or the radius A of an arc of at most half a circle";
                        self.wrong_line(line, "an arc without a centre", expected)
                    })?;
                if let Some(hole) = &mut self.routing {
                    hole.path.segments.push(segment);
                }
            }
        }
        Ok(())
    }

    fn center(&self, block: &Block<'_>) -> Result<Option<Center>, Error> {
        if let Some(radius) = block.radius {
            return Ok(Some(Center::Radius(self.length(radius)?)));
        }
        if block.i.is_none() && block.j.is_none() {
            return Ok(None);
        }
        Ok(Some(Center::Offset(self.way(block.i, block.j)?)))
    }

    /// Lowers the router where it is.
    fn lower(&mut self, line: &Line) -> Result<(), Error> {
        self.raise()?;
        self.routing = Some(self.hole(Path { start: self.at, segments: vec![] }, line)?);
        Ok(())
    }

    /// Raises the router; what it has cut is a hole.
    fn raise(&mut self) -> Result<(), Error> {
        let Some(hole) = self.routing.take() else { return Ok(()) };
        self.push(hole, &(self.file.bytes.len()..self.file.bytes.len()))
    }

    fn cut(&mut self, path: Path, line: &Line) -> Result<(), Error> {
        let hole = self.hole(path, line)?;
        self.push(hole, &line.place)
    }

    fn push(&mut self, hole: Hole, place: &Range<usize>) -> Result<(), Error> {
        if self.holes.len() >= self.most {
            let what = format!("more than {} holes", self.most);
            let hint = "a repeat count may be damaged";
            let expected = "a board that can be drilled";
            return Err(Error::syntax(self.file.name, self.file.bytes, place.clone(), what, expected, hint));
        }
        self.holes.push(hole);
        Ok(())
    }

    /// A hole along `path` with the tool at hand.
    fn hole(&self, path: Path, line: &Line) -> Result<Hole, Error> {
        let Some(number) = self.tool else {
            let expected = "a line such as T01 before it";
            return Err(self.wrong_line(line, "a hole is drilled before any tool is chosen", expected));
        };
        let Some(tool) = self.tools.get(&number) else {
            let what = format!("tool T{number} drills here, but its diameter is given nowhere");
            let hint = format!("add its diameter to the header: T{number}C0.8");
            let (file, bytes) = (self.file.name, self.file.bytes);
            return Err(Error::syntax(file, bytes, line.place.clone(), what, "a tool with a diameter", hint));
        };
        Ok(Hole { path, diameter: tool.diameter, plating: tool.plating, tool: number, line: line.number })
    }

    /// The place that X and Y name, from `base`.
    fn target(&self, base: Point, x: Option<&Word>, y: Option<&Word>) -> Result<Point, Error> {
        let along = |base: Nm, zero: Nm, word: Option<&Word>| -> Result<Nm, Error> {
            let Some(word) = word else { return Ok(base) };
            let length = self.length(word)?;
            let to = if self.absolute { zero + length } else { base + length };
            Nm::try_new(to.get()).map_err(|_| self.too_far(&word.place))
        };
        Ok(Point::new(along(base.x, self.zero.x, x)?, along(base.y, self.zero.y, y)?))
    }

    /// X and Y as a way, zero where one is missing.
    fn way(&self, x: Option<&Word>, y: Option<&Word>) -> Result<Vector, Error> {
        let length = |word: Option<&Word>| word.map_or(Ok(Nm::ZERO), |word| self.length(word));
        Ok(Vector::new(length(x)?, length(y)?))
    }

    fn in_range(&self, point: Point, place: &Range<usize>) -> Result<Point, Error> {
        let fits = |c: Nm| Nm::try_new(c.get()).is_ok();
        if fits(point.x) && fits(point.y) { Ok(point) } else { Err(self.too_far(place)) }
    }

    fn length(&self, word: &Word) -> Result<Nm, Error> {
        self.format.length(word.number).ok_or_else(|| self.too_far(&word.place))
    }

    fn too_far(&self, place: &Range<usize>) -> Error {
        let what =
            format!("coordinate beyond ±1073 mm (read as {}, {})", self.format.units.name(), self.format);
        let hint = "the number format may be another one, or the file damaged";
        Error::syntax(self.file.name, self.file.bytes, place.clone(), what, "a place on a board", hint)
    }

    fn unknown(&self, word: &Word) -> Error {
        self.wrong(
            word,
            "a drill command that is not supported",
            "holes, G85 slots, or routing with G00 to G03",
        )
    }

    fn wrong(&self, word: &Word, what: &str, expected: &str) -> Error {
        Error::syntax(self.file.name, self.file.bytes, word.place.clone(), what, expected, "")
    }

    fn wrong_line(&self, line: &Line, what: &str, expected: &str) -> Error {
        Error::syntax(self.file.name, self.file.bytes, line.place.clone(), what, expected, "")
    }
}
