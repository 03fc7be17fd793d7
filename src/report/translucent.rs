//! The picture that Algorithm 2 looks at (§III-A.2 of the paper): every trace translucent in a
//! random colour.

use crate::board::Copper;
use crate::geometry::{Nm, Path, Turn};
use crate::grid::{Grid, GridError};
use crate::topology::{self, Method, Nets, Sampling, Translucency};

use super::{Canvas, Rgb};

/// The radius of the ring round a pick, in pixels. Chosen: it is seen, and hides little.
const RING: i64 = 5;

/// The traces that shared vertices leave, as translucent sheets; a white ring round every pixel
/// that was picked.
pub struct Translucent<'a> {
    copper: &'a Copper,
    traces: Nets,
    found: Translucency,
    rings: Vec<Path>,
}

impl<'a> Translucent<'a> {
    /// Looks at copper through pixels of `pitch`.
    ///
    /// # Errors
    ///
    /// [`GridError`] where the pixels are too fine for all of the copper.
    pub fn new(copper: &'a Copper, pitch: Nm) -> Result<Self, GridError> {
        let traces = topology::recover(copper, Method::Coincidence);
        let found = topology::translucency(copper, &traces, Sampling { pitch, ..Sampling::default() })?;
        let rings = found
            .overlaps
            .iter()
            .map(|overlap| Path::circle(overlap.at, pitch * RING, Turn::CounterClockwise))
            .collect();
        Ok(Self { copper, traces, found, rings })
    }

    /// What lies within `grid`.
    #[must_use]
    pub fn draw(&self, grid: Grid) -> Canvas {
        let mut canvas = Canvas::new(grid, Rgb(0, 0, 0));
        let picture = self.found.picture(self.copper, &self.traces, &grid);
        for (row, colours) in (0..grid.height()).zip(picture.chunks_exact(grid.width() as usize)) {
            for (column, &[red, green, blue]) in (0..).zip(colours) {
                canvas.set(column, row, Rgb(red, green, blue));
            }
        }
        canvas.strokes(&self.rings, Nm::ZERO, Rgb(255, 255, 255), 0.9);
        canvas
    }
}
