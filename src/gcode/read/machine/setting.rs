//! Words that set something: feed, speed, tool, and how long to wait.

use crate::gcode::read::block::Word;
use crate::gcode::read::error::ReadError;
use crate::gcode::read::expression::index;
use crate::gcode::read::meaning::FeedMode;
use crate::geometry::Nm;

use super::{Machine, Run};

/// The largest length or feed, in nanometres. Chosen: about a kilometre, and no danger of overflow.
const LARGEST: f64 = 1e12;

impl Machine {
    /// F, S and T; of a dwell without P the time may be S.
    pub(super) fn settings(&mut self, run: Run<'_>, dwells: bool) -> Result<(), ReadError> {
        let is_time = dwells && run.block.get('P').is_none();
        if let Some(word) = run.block.get('S').filter(|_| !is_time) {
            self.modal.speed = Some(speed(run, word)?);
        }
        self.inverse = None;
        if let Some(word) = run.block.get('F') {
            match self.modal.feed_mode {
                FeedMode::PerMinute => self.modal.feed = Some(self.scaled(run, word)?),
                FeedMode::Inverse => self.inverse = Some(word.value),
                FeedMode::PerTurn => {
                    let turns = self.modal.speed.ok_or_else(|| {
                        run.error(
                            word,
                            "a feed per revolution, but the program does not give the spindle speed",
                        )
                    })?;
                    self.modal.feed = Some(self.per_turn(run, word, turns)?);
                }
            }
        }
        // With M61 the tool is Q.
        let tool = run.block.get('T').or_else(|| {
            let sets = run.block.orders.iter().any(|order| (order.letter, order.key) == ('M', 610));
            run.block.get('Q').filter(|_| sets)
        });
        if let Some(word) = tool {
            self.selected =
                Some(index(word.value).ok_or_else(|| run.error(word, "expected a whole number"))?);
        }
        Ok(())
    }

    /// G4: P in seconds with a decimal point or below 100, else in milliseconds, as controllers
    /// differ; S and X in seconds.
    pub(super) fn dwell(&mut self, run: Run<'_>) -> Result<(), ReadError> {
        let time = |word: Word, unit: f64| {
            let value = word.value * unit;
            let wrong = || run.error(word, "expected a time that is not negative");
            if (0.0..1e12).contains(&value) { Ok(milliseconds(value)) } else { Err(wrong()) }
        };
        let waits = match (run.block.get('P'), run.block.first("SX")) {
            (Some(p), _) if p.value >= 100.0 && p.value.fract() == 0.0 => time(p, 1.0)?,
            (Some(word), _) | (None, Some(word)) => time(word, 1000.0)?,
            (None, None) => 0,
        };
        self.listing.dwell += waits;
        if let Some(p) = run.block.get('P') {
            self.listing.waits(milliseconds(p.value * 1000.0), run.line());
        }
        Ok(())
    }

    /// A feed of so much in each turn of the spindle, in nanometres per minute.
    pub(super) fn per_turn(&self, run: Run<'_>, word: Word, turns: u32) -> Result<i64, ReadError> {
        let feed = self.scaled(run, word)?.checked_mul(i64::from(turns));
        let feed = feed.filter(|feed| Nm::new(*feed).to_f64().abs() < LARGEST);
        feed.ok_or_else(|| run.error(word, "expected a feed below a kilometre a minute"))
    }

    /// A length or feed in nanometres, halves away from zero.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_precision_loss,
        reason = "checked before; a small unit"
    )]
    pub(super) fn scaled(&self, run: Run<'_>, word: Word) -> Result<i64, ReadError> {
        let value = (word.value * self.modal.unit as f64).round();
        if value.abs() < LARGEST {
            Ok(value as i64)
        } else {
            Err(run.error(word, "expected a length below a kilometre"))
        }
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked before")]
const fn milliseconds(value: f64) -> u64 {
    value as u64
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked before")]
fn speed(run: Run<'_>, word: Word) -> Result<u32, ReadError> {
    let turns = word.value.round();
    let wrong = || run.error(word, "expected revolutions per minute that are not negative");
    if (0.0..1e9).contains(&turns) { Ok(turns as u32) } else { Err(wrong()) }
}
