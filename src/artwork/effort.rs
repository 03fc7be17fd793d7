//! What booleans of figures may cost, so that a drawing made to keep a program busy is refused.

use crate::board::FLATTEN;
use crate::board::polarity::{self, TooMuch};
use crate::geometry::Point;

use super::{Drawn, Figure, Line};

/// The most that booleans may cost, in vertices: about a microsecond each. Chosen: the masks of a
/// board drawn by EasyEDA take some millions.
const MOST: u64 = 16_000_000;

/// What booleans have cost so far, in vertices.
#[derive(Clone, Copy, Debug, Default)]
pub struct Effort(u64);

impl Effort {
    /// Counts what a boolean of so many vertices costs, before it is done.
    ///
    /// # Errors
    ///
    /// [`TooMuch`] where that is more than all may cost together.
    pub fn spend(&mut self, vertices: u64) -> Result<(), TooMuch> {
        self.0 += vertices;
        if self.0 > MOST { Err(TooMuch) } else { Ok(()) }
    }

    /// Counts what it costs to make polygons of `figure`, before that is done.
    ///
    /// # Errors
    ///
    /// As [`spend`](Self::spend).
    pub fn spend_on(&mut self, figure: &Figure) -> Result<(), TooMuch> {
        let (Drawn::Area(area) | Drawn::Line(Line { painted: Some(area), .. })) = &figure.drawn else {
            return Ok(());
        };
        let rings: Vec<Vec<Point>> = area.contours.iter().map(|path| path.flatten(FLATTEN)).collect();
        self.spend(polarity::effort(rings.iter()))
    }
}
