//! Drilling and routing: where the spindle goes.

use std::ops::Range;

use super::{Machine, Mode};
use crate::board::Hole;
use crate::geometry::{Path, Segment};
use crate::import::diagnostic;
use crate::import::error::Error;
use crate::import::excellon::block::Block;
use crate::import::excellon::lex::Line;
use crate::import::excellon::route::{self, Center, Interpolation};

impl Machine<'_, '_, '_> {
    /// Goes to X and Y of the block, drilling or routing as the mode has it.
    pub(super) fn motion(&mut self, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        if let Some(cycle) = block.cycle {
            return self.cycle(cycle, block, line);
        }
        if let Some(times) = block.packages {
            return self.repeat_package(times, block, line);
        }
        if block.x.is_none() && block.y.is_none() {
            return Ok(());
        }
        if std::mem::take(&mut self.text_follows) {
            self.at = self.target(self.at, block.x, block.y)?;
            return Ok(());
        }
        self.repeats_holes(block)?;
        if let Some(package) = self.package.take() {
            return self.package(package, block, line);
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

    pub(super) fn route(
        &mut self,
        interpolation: Interpolation,
        block: &Block<'_>,
        line: &Line,
    ) -> Result<(), Error> {
        let from = self.at;
        self.at = self.target(from, block.x, block.y)?;
        let Some(hole) = &mut self.routing else {
            if interpolation != Interpolation::Rapid {
                let message = "the router moves here without a plunge (M15) before it, so nothing is cut";
                self.warnings.add(&diagnostic::ROUTER_NOT_LOWERED, line.place.clone(), message);
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

    /// Where the block has the centre of its arc; where it says nothing, as the arc before it.
    pub(super) fn center(&mut self, block: &Block<'_>) -> Result<Option<Center>, Error> {
        if let Some(radius) = block.radius {
            self.center = Some(Center::Radius(self.length(radius)?));
        } else if block.i.is_some() || block.j.is_some() {
            self.center = Some(Center::Offset(self.way(block.i, block.j)?));
        }
        Ok(self.center)
    }

    /// Lowers the router where it is.
    pub(super) fn lower(&mut self, line: &Line) -> Result<(), Error> {
        self.raise()?;
        self.routing = Some(self.hole(Path { start: self.at, segments: vec![] }, line)?);
        Ok(())
    }

    /// Raises the router; what it has cut is a hole.
    pub(super) fn raise(&mut self) -> Result<(), Error> {
        let Some(hole) = self.routing.take() else { return Ok(()) };
        self.push(hole, &(self.file.bytes.len()..self.file.bytes.len()))
    }

    pub(super) fn cut(&mut self, path: Path, line: &Line) -> Result<(), Error> {
        let hole = self.hole(path, line)?;
        self.push(hole, &line.place)
    }

    pub(super) fn push(&mut self, hole: Hole, place: &Range<usize>) -> Result<(), Error> {
        if self.holes.len() >= self.most {
            let what = format!("more than {} holes", self.most);
            let hint = "a repeat count may be damaged";
            let expected = "a board that can be drilled";
            return Err(Error::syntax(self.file.name, self.file.bytes, place.clone(), what, expected, hint));
        }
        self.holes.push(hole);
        Ok(())
    }
}
