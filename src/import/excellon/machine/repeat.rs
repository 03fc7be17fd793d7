//! Holes again, elsewhere: rows of one hole or slot, and patterns of many.

use std::ops::Range;

use super::{Machine, Mode};
use crate::board::Hole;
use crate::geometry::{Nm, Path, Point, Segment, Vector};
use crate::import::diagnostic;
use crate::import::error::Error;
use crate::import::excellon::block::Block;
use crate::import::excellon::lex::{Line, Word};

impl Machine<'_, '_, '_> {
    /// Whether `R` stands where a hole can be repeated, if it is there.
    pub(super) fn repeats_holes(&self, block: &Block<'_>) -> Result<(), Error> {
        let Some(word) = block.repeat else { return Ok(()) };
        let what = match self.mode {
            _ if self.package.is_some() => "R between the corners of a package",
            Mode::Route(_) => "R repeats a hole, but here the router moves",
            Mode::Drill => return Ok(()),
        };
        Err(self.wrong(word, what, "R after a hole or a slot, or each cut by itself"))
    }

    /// `R#X#Y#`: the last hole again and again, each that much further; of a slot or a circle all.
    pub(super) fn repeat(&mut self, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        let way = self.way(block.x, block.y)?;
        let slot = self.holes.last().filter(|hole| self.was_just_cut(hole)).map(|hole| hole.path.clone());
        let mut far = Vector::default();
        for _ in 0..block.repeats().map_err(|word| self.unknown(word))? {
            self.at = self.in_range(self.at + way, &line.place)?;
            far = far + way;
            let path = match &slot {
                Some(slot) => self.moved(slot, Axes::UNCHANGED, far, &line.place)?,
                None => Path { start: self.at, segments: vec![] },
            };
            self.cut(path, line)?;
        }
        Ok(())
    }

    /// Whether a slot or a circle is what the tool has cut where it is.
    fn was_just_cut(&self, hole: &Hole) -> bool {
        let is_here = |segment: &Segment| match *segment {
            Segment::Line { to } => to == self.at,
            Segment::Arc { to, center, .. } => to == self.at || center == self.at,
        };
        self.tool == Some(hole.tool) && hole.path.segments.last().is_some_and(is_here)
    }

    /// `M02X#Y#`: the pattern once more, moved; `R#M02X#Y#`: that many times. `M02` alone ends the
    /// repeats.
    pub(super) fn step(&mut self, word: &Word, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        if block.x.is_none() && block.y.is_none() && block.repeat.is_none() {
            self.stepped = Vector::default();
            return Ok(());
        }
        let axes = Axes::of(block);
        if axes.swapped && axes.mirrored.0 != axes.mirrored.1 {
            let what = "swapped and mirrored axes together, whose order the format does not define";
            return Err(self.wrong(word, what, "M70, M80, M90, M80 with M90, or all three"));
        }
        let Some((from, to)) = self.pattern else {
            let message = "M02 repeats a pattern, but none was ended with M01";
            self.warnings.add(&diagnostic::PATTERN_MISSING, word.place.clone(), message);
            return Ok(());
        };
        let to = to.unwrap_or(self.holes.len());
        self.pattern = Some((from, Some(to)));
        if from == to {
            return Ok(());
        }
        let way = self.way(block.x, block.y)?;
        for _ in 0..block.repeats().map_err(|word| self.unknown(word))? {
            self.stepped = self.stepped + way;
            for index in from..to {
                let hole = self.holes[index].clone();
                let path = self.moved(&hole.path, axes, self.stepped, &line.place)?;
                self.push(Hole { path, line: line.number, ..hole }, &line.place)?;
            }
        }
        Ok(())
    }

    /// `path` with other axes, and moved.
    fn moved(&self, path: &Path, axes: Axes, way: Vector, place: &Range<usize>) -> Result<Path, Error> {
        let moved = |p: Point| self.in_range(self.zero + axes.vector(p - self.zero) + way, place);
        let step = |segment: &Segment| -> Result<Segment, Error> {
            Ok(match *segment {
                Segment::Line { to } => Segment::Line { to: moved(to)? },
                Segment::Arc { to, center, turn } => {
                    let turn = if axes.turn_over() { turn.reversed() } else { turn };
                    Segment::Arc { to: moved(to)?, center: moved(center)?, turn }
                }
            })
        };
        let segments = path.segments.iter().map(step).collect::<Result<_, _>>()?;
        Ok(Path { start: moved(path.start)?, segments })
    }
}

/// What `M70`, `M80` and `M90` do to a repeated pattern.
#[derive(Clone, Copy)]
struct Axes {
    /// X for Y.
    swapped: bool,
    /// −X for X, −Y for Y.
    mirrored: (bool, bool),
}

impl Axes {
    const UNCHANGED: Self = Self { swapped: false, mirrored: (false, false) };

    fn of(block: &Block<'_>) -> Self {
        Self { swapped: block.has([70, 23]), mirrored: (block.has([80, 21]), block.has([90, 22])) }
    }

    fn vector(self, way: Vector) -> Vector {
        let signed = |length: Nm, mirrored: bool| if mirrored { -length } else { length };
        let (x, y) = if self.swapped { (way.y, way.x) } else { (way.x, way.y) };
        Vector::new(signed(x, self.mirrored.0), signed(y, self.mirrored.1))
    }

    /// Whether left becomes right.
    const fn turn_over(self) -> bool {
        self.swapped ^ self.mirrored.0 ^ self.mirrored.1
    }
}
