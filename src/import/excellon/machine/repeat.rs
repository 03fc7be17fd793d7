//! Holes again, elsewhere: rows of one hole, and patterns of many.

use std::ops::Range;

use super::Machine;
use crate::board::Hole;
use crate::geometry::{Path, Segment, Vector};
use crate::import::error::Error;
use crate::import::excellon::block::Block;
use crate::import::excellon::lex::{Line, Word};

impl Machine<'_, '_, '_> {
    /// `R#X#Y#`: the last hole again and again, each that much further.
    pub(super) fn repeat(&mut self, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        let way = self.way(block.x, block.y)?;
        for _ in 0..block.repeats().map_err(|word| self.unknown(word))? {
            self.at = self.in_range(self.at + way, &line.place)?;
            self.cut(Path { start: self.at, segments: vec![] }, line)?;
        }
        Ok(())
    }

    /// `M02X#Y#`: the pattern once more, moved; `R#M02X#Y#`: that many times.
    pub(super) fn step(&mut self, word: &Word, block: &Block<'_>, line: &Line) -> Result<(), Error> {
        if block.miscellaneous.iter().any(|w| matches!(w.number.integer(), Some(70 | 80 | 90))) {
            return Err(self.wrong(
                word,
                "a mirrored pattern is not supported",
                "M02 without M70, M80 or M90",
            ));
        }
        let Some((from, to)) = self.pattern else {
            self.warnings.add(
                "pattern-missing",
                word.place.clone(),
                "M02 repeats no pattern, as none was begun with M25",
            );
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
                let path = self.moved(&hole.path, self.stepped, &line.place)?;
                self.push(Hole { path, line: line.number, ..hole }, &line.place)?;
            }
        }
        Ok(())
    }

    fn moved(&self, path: &Path, way: Vector, place: &Range<usize>) -> Result<Path, Error> {
        let step = |segment: &Segment| -> Result<Segment, Error> {
            Ok(match *segment {
                Segment::Line { to } => Segment::Line { to: self.in_range(to + way, place)? },
                Segment::Arc { to, center, turn } => Segment::Arc {
                    to: self.in_range(to + way, place)?,
                    center: self.in_range(center + way, place)?,
                    turn,
                },
            })
        };
        let segments = path.segments.iter().map(step).collect::<Result<_, _>>()?;
        Ok(Path { start: self.in_range(path.start + way, place)?, segments })
    }
}
