//! A milled surface as one sees it lying on a table: from above at a slant, lit from the upper
//! left.
//!
//! ```text
//!   light ╲                 Each column is drawn from its far end to its near one: a place lies as far down in the picture as it
//!          ╲   eye ╱        is near and deep, and what is drawn later hides what lies behind it. Between two places of a column
//!   ───╲    ╲╱────────      the pixels have the colour of the nearer one.
//!       ╲  ╱
//! ```

use rayon::prelude::*;

use super::{Canvas, Rgb, png};
use crate::geometry::{Nm, Rect};
use crate::grid::{Grid, GridError};

/// How much of the way to the back, and of the height, one sees: the cosine and sine of the slant,
/// of a triangle with whole sides.
const BACK: f64 = 0.8;
const UP: f64 = 0.6;

/// Where the light comes from: a direction of length one. Chosen for the look.
const LIGHT: [f64; 3] = [-0.48, 0.6, 0.64];

/// What is not milled, and what is: colours that are lit. Chosen: walnut stained dark and bare.
const TOP: [f64; 3] = [116.0, 76.0, 48.0];
const CUT: [f64; 3] = [226.0, 184.0, 130.0];
/// How bright what no light reaches is.
const SHADE: f64 = 0.25;

/// What lies shallower counts as not milled, in nanometres. Chosen: rounding.
const SKIN: f64 = 1_000.0;

/// The picture, as a PNG, of `area` where `depth` says how deep each place is milled, in
/// nanometres.
///
/// # Errors
///
/// [`GridError`] for pixels that are too small or too many.
pub fn relief(depth: impl Fn((f64, f64)) -> f64 + Sync, area: Rect, pitch: Nm) -> Result<Vec<u8>, GridError> {
    let grid = Grid::covering(area, pitch)?;
    let (width, height) = (grid.width(), grid.height());
    let place = |column: u32, row: u32| grid.center(i64::from(column), i64::from(row)).to_f64();
    let columns: Vec<Vec<f64>> = (0..width)
        .into_par_iter()
        .map(|column| (0..height).map(|row| depth(place(column, row)).max(0.0)).collect())
        .collect();
    let rows = (f64::from(height) * BACK).ceil();
    let shown = grid.rows(0, pixel(rows).clamp(1, height));
    let mut canvas = Canvas::new(shown, Rgb(255, 255, 255));
    for column in 0..width {
        let here = &columns[column as usize];
        let beside = &columns[(column + 1).min(width - 1) as usize];
        let mut drawn = 0;
        for row in 0..height {
            let deep = here[row as usize];
            let behind = here[row.saturating_sub(1) as usize];
            let slope = [beside[row as usize] - deep, behind - deep].map(|rise| rise / pitch.to_f64());
            let down = pixel(f64::from(row + 1) * BACK + deep / pitch.to_f64() * UP).min(shown.height());
            let colour = colour(deep > SKIN, slope);
            let from = if down > drawn { drawn } else { down.saturating_sub(1) };
            (from..down).for_each(|row| canvas.set(column, row, colour));
            drawn = down;
        }
    }
    Ok(png::rgb(canvas))
}

/// A number of pixels.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
const fn pixel(number: f64) -> u32 {
    number as u32
}

/// The colour of a place by how much deeper it is to the right and behind.
fn colour(is_cut: bool, [right, behind]: [f64; 2]) -> Rgb {
    // Deeper to the right is lower there: the normal leans that way.
    let normal = [right, behind, 1.0];
    let length = (right * right + behind * behind + 1.0).sqrt();
    let lit = normal.iter().zip(LIGHT).map(|(a, b)| a * b).sum::<f64>() / length;
    // What is level is as bright as its colour.
    let bright = SHADE + (1.0 - SHADE) * (lit / LIGHT[2]).max(0.0);
    let [r, g, b] = if is_cut { CUT } else { TOP }.map(|part| byte(part * bright));
    Rgb(r, g, b)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
const fn byte(number: f64) -> u8 {
    number as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    #[test]
    fn walls_that_face_the_light_are_brighter_and_level_places_have_their_colour() {
        let sum = |Rgb(r, g, b): Rgb| u32::from(r) + u32::from(g) + u32::from(b);
        let level = sum(colour(true, [0.0, 0.0]));
        assert_eq!(level, 226 + 184 + 130, "as it is");
        assert!(sum(colour(true, [-0.5, 0.0])) > level, "it falls to the left, where the light is");
        assert!(sum(colour(true, [0.5, 0.0])) < level, "it falls away from it");
        assert!(sum(colour(true, [0.0, 0.5])) > level, "it falls to the back, where the light is, too");
    }

    #[test]
    fn a_picture_is_as_wide_as_its_area() {
        let area = Rect::new(Point::default(), Point::new(Nm::from_mm(2), Nm::from_mm(1)));
        let picture = relief(|_| 0.0, area, Nm::from_um(100)).expect("a picture");
        assert_eq!(picture[16..24], [0, 0, 0, 20, 0, 0, 0, 8], "20 by 8 pixels");
    }
}
