//! What T, G and M words do.

use std::ops::Range;

use super::{Machine, Mode, Tool};
use crate::geometry::{Nm, Turn, Vector};
use crate::import::diagnostic;
use crate::import::error::Error;
use crate::import::excellon::block::Block;
use crate::import::excellon::format::Units;
use crate::import::excellon::lex::{Line, Word};
use crate::import::excellon::route::Interpolation;

impl Machine<'_, '_, '_> {
    /// Changes the tool, defining it where a diameter is given.
    pub(super) fn select(&mut self, word: &Word, diameter: Option<&Word>) -> Result<(), Error> {
        let number = word.number.integer().ok_or_else(|| self.unknown(word))?;
        if let Some(size) = diameter {
            let length = self.format.diameter(size.number).filter(|&d| d > Nm::ZERO);
            let Some(diameter) = length else {
                let expected = "a diameter above zero, such as C0.8";
                let error = self.wrong(size, "a drill cannot have this diameter", expected);
                self.break_tool(number, size.place.clone(), error);
                return self.change_to(number);
            };
            self.broken.remove(&number);
            if size.number.decimals.is_none() {
                let message = format!("the diameter has no decimal point and is read as {diameter:.3} mm");
                self.warnings.add(&diagnostic::DIAMETER_WITHOUT_POINT, size.place.clone(), message);
            }
            self.tools.insert(number, Tool { diameter, plating: self.plating, place: word.place.clone() });
        } else {
            self.take_commented(number, &word.place);
        }
        self.change_to(number)
    }

    /// Defines a tool that a table in comments has, where nothing else does.
    fn take_commented(&mut self, number: u32, place: &Range<usize>) {
        let commented = self.file.declared.commented.get(&number);
        if let (false, Some(tool)) = (self.tools.contains_key(&number), commented) {
            let plating = tool.plating.unwrap_or(self.plating);
            self.tools.insert(number, Tool { diameter: tool.diameter, plating, place: place.clone() });
        }
    }

    /// Takes up the next tool of the table in comments, in a file that chooses none otherwise; none
    /// after the last.
    pub(super) fn take_next(&mut self, place: &Range<usize>) -> Result<(), Error> {
        if !self.file.declared.changes_by_stops() {
            return Ok(());
        }
        let next = self.file.declared.tool_after(self.tool);
        if let Some(next) = next {
            self.take_commented(next, place);
        }
        self.change_to(next.unwrap_or(0))
    }

    /// Takes up another tool.
    pub(super) fn change_to(&mut self, number: u32) -> Result<(), Error> {
        self.package_is_whole()?;
        self.raise()?;
        // T0 puts the tool back, unless there is one of that number.
        self.tool = (number != 0 || self.tools.contains_key(&0)).then_some(number);
        Ok(())
    }

    /// Keeps what is wrong with a tool until it drills.
    pub(super) fn break_tool(&mut self, number: u32, place: Range<usize>, error: Error) {
        self.tools.remove(&number);
        self.broken.insert(number, (place, error));
    }

    pub(super) fn general(&mut self, word: &Word) -> Result<(), Error> {
        match word.number.integer() {
            Some(0) => {
                self.package_is_whole()?;
                self.raise()?;
                self.mode = Mode::Route(Interpolation::Rapid);
            }
            Some(1) => self.mode = Mode::Route(Interpolation::Line),
            Some(2) => self.mode = Mode::Route(Interpolation::Arc(Turn::Clockwise)),
            Some(3) => self.mode = Mode::Route(Interpolation::Arc(Turn::CounterClockwise)),
            Some(5 | 38 | 81) => {
                self.package_is_whole()?;
                self.raise()?;
                self.mode = Mode::Drill;
            }
            Some(32 | 33) => {
                self.raise()?;
                self.mode = Mode::Route(Interpolation::Rapid);
            }
            Some(82..=84) => {
                self.raise()?;
                self.mode = Mode::Drill;
            }
            // Dwell, feeds, cameras, compensation off; slots and zero are read from the block.
            Some(4 | 7 | 34..=37 | 39 | 40 | 45..=47 | 85 | 87 | 92 | 93) => {}
            Some(41 | 42) => {
                let message = "cutter compensation is not applied: the cut is centred on the programmed line";
                self.warnings.add(&diagnostic::CUTTER_COMPENSATION, word.place.clone(), message);
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
    pub(super) fn miscellaneous(
        &mut self,
        word: &Word,
        block: &Block<'_>,
        line: &Line,
    ) -> Result<bool, Error> {
        match word.number.integer() {
            // The end, or a stop to change the tool: then the program goes on.
            Some(0) => {
                self.raise()?;
                self.take_next(&word.place)?;
            }
            Some(30) => {
                self.raise()?;
                self.ended = true;
            }
            // Without M25 a pattern begins where the program does. M21 to M27 are the codes of
            // format 1.
            Some(1 | 24) => {
                self.raise()?;
                let from = self.pattern.map_or(0, |(from, _)| from);
                self.pattern = Some((from, Some(self.holes.len())));
                self.stepped = Vector::default();
            }
            Some(2 | 26) => self.step(word, block, line)?,
            Some(6 | 9) => {}
            Some(8 | 27) => self.pattern = None,
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
            Some(21..=23 | 70 | 80 | 90) if block.repeats_pattern() => {}
            Some(21..=23 | 70 | 80 | 90) => {
                let message = "swapped or mirrored axes are not applied outside a repeated pattern";
                self.warnings.add(&diagnostic::AXES_NOT_SWAPPED, word.place.clone(), message);
                return Ok(true);
            }
            _ => self.left_out(&format!("M{:02}", word.number.digits), &word.place),
        }
        Ok(false)
    }
}
