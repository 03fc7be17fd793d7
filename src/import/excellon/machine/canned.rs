//! Canned cycles: packages, and circles cut from many holes or by the router (CNC-7 manual, "Canned
//! Cycle Commands").
//!
//! ```text
//!  G82: two corners    first o   o   o   o      G83: two holes         o
//!  tell two rows             .            .     tell eight          o     o
//!                            o   o   o   o second           first  o       o second
//!                                                                   o     o
//!                                                                      o
//! ```

use std::ops::Range;

use super::Machine;
use crate::geometry::{Nm, Path, Point, Segment, Turn, Vector};
use crate::import::error::Error;
use crate::import::excellon::block::{Block, Cycle};
use crate::import::excellon::format::Units;
use crate::import::excellon::lex::{Line, Word};
use crate::import::excellon::route::Center;

/// A package of which some corners are still to come.
#[derive(Clone, Debug)]
pub(super) struct Package {
    cycle: Cycle,
    /// From hole to hole of a row, and from row to row.
    pitch: Nm,
    rows: Nm,
    /// Its first corner, and where the file has it.
    first: Option<(Point, Range<usize>)>,
}

/// How far a corner may lie off the grid of its package. Chosen: two coordinates, each rounded to a
/// thousandth inch.
const OFF_GRID: Nm = Nm::from_um(51);

impl Machine<'_, '_, '_> {
    pub(super) fn cycle(&mut self, cycle: Cycle, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        self.package_is_whole()?;
        match cycle {
            Cycle::Slot => self.slot(block, line),
            Cycle::DrilledCircle => self.drilled_circle(block, line),
            Cycle::RoutedCircle(turn) => self.routed_circle(turn, block, line),
            Cycle::DualInLine => {
                let spacing = |word: Option<&Word>, usual: i64| match word {
                    Some(word) => self.length(word).map(Nm::abs),
                    None => Ok(Nm::new(usual)),
                };
                // 0.1 and 0.3 inch.
                let (pitch, rows) = (spacing(block.x, 2_540_000)?, spacing(block.y, 7_620_000)?);
                if pitch == Nm::ZERO || rows == Nm::ZERO {
                    return Err(self.wrong_line(
                        line,
                        "a package whose holes are all at one position",
                        "G82X0.1Y0.3",
                    ));
                }
                self.package = Some(Package { cycle, pitch, rows, first: None });
                Ok(())
            }
            Cycle::RoundPack => {
                let package = Package { cycle, pitch: Nm::ZERO, rows: Nm::ZERO, first: None };
                if block.x.is_some() || block.y.is_some() {
                    return self.package(package, block, line);
                }
                self.package = Some(package);
                Ok(())
            }
        }
    }

    fn slot(&mut self, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        let from = self.target(self.at, block.x, block.y)?;
        let (x, y) = block.beyond.unwrap_or_default();
        self.at = self.target(from, x, y)?;
        let segments = if self.at == from { vec![] } else { vec![Segment::Line { to: self.at }] };
        let slot = self.hole(Path { start: from, segments }, line)?;
        // Where a line begins with G85, as tscircuit's do, the hole before it is the slot's first.
        let goes_on = block.x.is_none() && block.y.is_none();
        match self.holes.last_mut() {
            Some(hole) if goes_on && !hole.is_slot() && hole.path.start == from && hole.tool == slot.tool => {
                *hole = slot;
                Ok(())
            }
            _ => self.push(slot, &line.place),
        }
    }

    /// Takes a corner of `package`; the second one drills it.
    pub(super) fn package(&mut self, package: Package, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        self.at = self.target(self.at, block.x, block.y)?;
        let Some((first, _)) = package.first else {
            self.package = Some(Package { first: Some((self.at, line.place.clone())), ..package });
            return Ok(());
        };
        let (from, second) = (self.holes.len(), self.at);
        if package.cycle == Cycle::RoundPack {
            self.round_pack(first, second, line)?;
        } else {
            self.in_line(&package, first, second, line)?;
        }
        self.packaged = from..self.holes.len();
        Ok(())
    }

    /// Whether no package waits for its second corner, where what follows has none for it.
    pub(super) fn package_is_whole(&self) -> Result<(), Error> {
        let Some((_, place)) = self.package.as_ref().and_then(|package| package.first.as_ref()) else {
            return Ok(());
        };
        let what = "a package of which only one corner is told";
        let expected = "its opposite corner in the next line, with the same tool";
        Err(Error::syntax(self.file.name, self.file.bytes, place.clone(), what, expected, ""))
    }

    /// The two rows between opposite corners, down the one and up the other.
    fn in_line(&mut self, package: &Package, first: Point, second: Point, line: &Line) -> Result<(), Error> {
        let way = second - first;
        let steps = |along: Nm, across: Nm| {
            let near = |a: Nm, b: Nm| (a - b).abs() <= OFF_GRID;
            let steps = (along.abs() + package.pitch / 2).get() / package.pitch.get();
            let fits = near(across.abs(), package.rows) && near(along.abs(), package.pitch * steps);
            fits.then_some(steps)
        };
        let (step, count) = match (steps(way.x, way.y), steps(way.y, way.x)) {
            (Some(count), None) => (Vector::new(package.pitch * way.x.get().signum(), Nm::ZERO), count),
            (None, Some(count)) => (Vector::new(Nm::ZERO, package.pitch * way.y.get().signum()), count),
            (Some(_), Some(_)) => {
                return Err(self.wrong_line(
                    line,
                    "a square package, whose rows may be along x or y",
                    "single holes, or rows with R",
                ));
            }
            (None, None) => {
                let what = format!(
                    "the corners of this package are not {:.3} mm apart in one axis and a multiple of {:.3} mm in the other",
                    package.rows, package.pitch
                );
                return Err(self.wrong_line(line, &what, "opposite corners on the package's grid"));
            }
        };
        for (start, sign) in [(first, 1), (second, -1)] {
            for index in 0..=count {
                let at = start + Vector::new(step.x * (sign * index), step.y * (sign * index));
                let at = self.in_range(at, &line.place)?;
                self.cut(Path { start: at, segments: vec![] }, line)?;
            }
        }
        Ok(())
    }

    /// Eight holes round the middle of two that lie opposite.
    fn round_pack(&mut self, first: Point, second: Point, line: &Line) -> Result<(), Error> {
        let ((ax, ay), (bx, by)) = (first.to_f64(), second.to_f64());
        let (middle, (mut x, mut y)) =
            (((ax + bx) / 2.0, (ay + by) / 2.0), ((ax - bx) / 2.0, (ay - by) / 2.0));
        let eighth = 0.5_f64.sqrt();
        for _ in 0..8 {
            let at = self.in_range(Point::from_f64(middle.0 + x, middle.1 + y), &line.place)?;
            self.cut(Path { start: at, segments: vec![] }, line)?;
            (x, y) = ((x - y) * eighth, (x + y) * eighth);
        }
        Ok(())
    }

    /// `P#X#Y#`: the last package again and again, each that much further.
    pub(super) fn repeat_package(
        &mut self,
        times: &Word,
        block: &Block<'_>,
        line: &Line,
    ) -> Result<(), Error> {
        let (holes, way): (Range<usize>, _) = (self.packaged.clone(), self.way(block.x, block.y)?);
        if holes.is_empty() {
            return Err(self.wrong(
                times,
                "P repeats a package, but there is none before it",
                "G82 or G83 before it",
            ));
        }
        let times = times.number.integer().ok_or_else(|| self.unknown(times))?;
        let mut far = Vector::default();
        for _ in 0..times {
            far = far + way;
            for index in holes.clone() {
                let at = self.in_range(self.holes[index].path.start + far, &line.place)?;
                self.cut(Path { start: at, segments: vec![] }, line)?;
            }
        }
        Ok(())
    }

    /// `X#Y#G84X#`: holes side by side round a circle, whose diameter is in thousandths of an inch
    /// or of a millimetre.
    fn drilled_circle(&mut self, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        let center = self.target(self.at, block.x, block.y)?;
        let Some((Some(width), _)) = block.beyond else {
            return Err(self.wrong_line(line, "a circle without a diameter", "X and the diameter after G84"));
        };
        let thousandth = match self.format.units {
            Units::Inch => 25_400,
            Units::Mm => 1_000,
        };
        let plain = width.number.decimals.is_none();
        let counted = width.number.integer().and_then(|n| Nm::try_new(i64::from(n) * thousandth).ok());
        let diameter =
            if plain { counted.ok_or_else(|| self.too_far(&width.place))? } else { self.length(width)? };
        let tool = self.hole(Path { start: center, segments: vec![] }, line)?.diameter;
        if diameter < tool * 2 {
            let expected = "a diameter at least twice that of the drill";
            return Err(self.wrong(width, "a circle too small for its drill", expected));
        }
        self.at = center;
        self.circle(center, (diameter - tool) / 2, Turn::CounterClockwise, line)
    }

    /// `G32X#Y#A#`: an inside circle, its radius less that of the router bit.
    fn routed_circle(&mut self, turn: Turn, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        let center = self.target(self.at, block.x, block.y)?;
        let Some(Center::Radius(radius)) = self.center(block)? else {
            return Err(self.wrong_line(
                line,
                "a circle without a radius",
                "A and the radius, as in G32X1.0Y1.0A0.5",
            ));
        };
        let tool = self.hole(Path { start: center, segments: vec![] }, line)?.diameter;
        if radius <= tool / 2 {
            let expected = "a radius above half the width of the router bit";
            return Err(self.wrong_line(line, "a circle too small for the router bit", expected));
        }
        self.at = center;
        self.circle(center, radius - tool / 2, turn, line)
    }

    /// A full circle of the tool's middle.
    fn circle(&mut self, center: Point, radius: Nm, turn: Turn, line: &Line) -> Result<(), Error> {
        let [start, across] = [radius, -radius].map(|x| center + Vector::new(x, Nm::ZERO));
        let (start, across) = (self.in_range(start, &line.place)?, self.in_range(across, &line.place)?);
        let segments = [across, start].map(|to| Segment::Arc { to, center, turn }).to_vec();
        self.cut(Path { start, segments }, line)
    }
}
