//! The picture that Algorithm 2 looks at (§III-A.2 of the paper): every trace translucent in a random colour.

use crate::board::Copper;
use crate::geometry::{Nm, Path, Point, Segment, Turn, Vector};
use crate::grid::{Grid, GridError};
use crate::topology::{self, Method, Sampling};

use super::{Canvas, Rgb};

/// The radius of the ring round a pick, in pixels. Chosen: it is seen, and hides little.
const RING: i64 = 5;

/// The traces that shared vertices leave, as translucent sheets; a white ring round every pixel that was picked.
///
/// # Errors
///
/// [`GridError`] where the pixels are too fine for all of the copper.
pub fn translucent(copper: &Copper, grid: &Grid) -> Result<Canvas, GridError> {
    let traces = topology::recover(copper, Method::Coincidence);
    let sampling = Sampling { pitch: grid.pitch(), ..Sampling::default() };
    let found = topology::translucency(copper, &traces, sampling)?;
    let mut canvas = Canvas::new(*grid, Rgb(0, 0, 0));
    let picture = found.picture(copper, &traces, grid);
    for (row, colours) in (0..grid.height()).zip(picture.chunks_exact(grid.width() as usize)) {
        for (column, &[red, green, blue]) in (0..).zip(colours) {
            canvas.set(column, row, Rgb(red, green, blue));
        }
    }
    let rings: Vec<Path> =
        found.overlaps.iter().map(|overlap| ring(overlap.at, grid.pitch() * RING)).collect();
    canvas.strokes(&rings, Nm::ZERO, Rgb(255, 255, 255), 0.9);
    Ok(canvas)
}

/// A circle.
fn ring(center: Point, radius: Nm) -> Path {
    let start = center + Vector::new(radius, Nm::ZERO);
    Path { start, segments: vec![Segment::Arc { to: start, center, turn: Turn::CounterClockwise }] }
}
