//! A milled surface as one sees it lying on a table: from above at a slant, lit from the upper
//! left.
//!
//! ```text
//!   light ╲                 Each column is drawn from its far end to its near one: a place lies as far down in the picture as it
//!          ╲   eye ╱        is near and deep, and what is drawn later hides what lies behind it. Between two places of a column
//!   ───╲    ╲╱────────      one sees the wall from the one to the other, and below the last one the edge of the sheet.
//!       ╲  ╱
//! ```

use crate::geometry::{Nm, Rect};
use crate::grid::{Grid, GridError};

use super::{Canvas, Rgb, png};

/// How much of the way to the back, and of the height, one sees: the cosine and sine of the slant,
/// of a triangle with whole sides.
const BACK: f64 = 0.8;
const UP: f64 = 0.6;

/// Where the light comes from: a direction of length one. Chosen for the look.
const LIGHT: [f64; 3] = [-0.48, 0.6, 0.64];

/// How bright what no light reaches is.
const SHADE: f64 = 0.25;
/// The same of the edge of the sheet, which faces the eye. Chosen: walls seen in it stand out.
const EDGE: f64 = 0.55;
/// What is neither milled nor sheet.
const GROUND: Rgb = Rgb(255, 255, 255);

/// What lies shallower counts as not milled, in nanometres. Chosen: rounding.
const SKIN: f64 = 1_000.0;

/// What is milled. Colours are as lit from straight above; all are chosen for the look.
#[derive(Clone, Copy, Debug)]
pub enum Material {
    /// Walnut, stained dark: bare where it is milled.
    Wood,
    /// A board clad with copper on both sides.
    Clad {
        /// How thick the copper is.
        copper: Nm,
        /// How thick the whole board is: through deeper places one sees the table.
        thickness: Nm,
    },
}

impl Material {
    /// The colour at a depth in nanometres.
    fn colour(self, depth: f64) -> [f64; 3] {
        const STAINED: [f64; 3] = [116.0, 76.0, 48.0];
        const BARE: [f64; 3] = [226.0, 184.0, 130.0];
        const COPPER: [f64; 3] = [214.0, 144.0, 92.0];
        const LAMINATE: [f64; 3] = [190.0, 184.0, 134.0];
        const TABLE: [f64; 3] = [138.0, 134.0, 128.0];
        match self {
            Self::Wood if depth > SKIN => BARE,
            Self::Wood => STAINED,
            Self::Clad { thickness, .. } if depth >= thickness.to_f64() => TABLE,
            Self::Clad { copper, thickness } => {
                let is_core = depth >= copper.to_f64() && depth < (thickness - copper).to_f64();
                if is_core { LAMINATE } else { COPPER }
            }
        }
    }

    /// How deep a place is seen: not below the table.
    fn seen(self, depth: f64) -> f64 {
        match self {
            Self::Wood => depth.max(0.0),
            Self::Clad { thickness, .. } => depth.clamp(0.0, thickness.to_f64()),
        }
    }

    /// The sheet's thickness, as far as its edge is seen.
    const fn edge(self) -> Nm {
        match self {
            Self::Wood => Nm::ZERO,
            Self::Clad { thickness, .. } => thickness,
        }
    }
}

/// A surface that can be drawn.
pub struct Relief<D> {
    depths: D,
    surface: Grid,
    /// The picture, whose rows are no longer those of the surface.
    grid: Grid,
    material: Material,
    /// How many pixels the deepest place lies lower than the surface.
    lowest: f64,
}

impl<D: Fn(&Grid) -> Vec<f32>> Relief<D> {
    /// The surface over `area`, a pixel each `pitch`: `depths` says how deep it is milled, in
    /// nanometres at the centres of the pixels of a grid, nowhere deeper than `deepest`.
    ///
    /// # Errors
    ///
    /// [`GridError`] for pixels that are too small or too many.
    pub fn new(
        depths: D,
        deepest: Nm,
        (area, pitch): (Rect, Nm),
        material: Material,
    ) -> Result<Self, GridError> {
        let surface = Grid::covering(area, pitch)?;
        let low = |depth: f64| depth / pitch.to_f64() * UP;
        let rows = f64::from(surface.height()) * BACK + low(material.edge().to_f64());
        let grid = surface.rows(0, pixel(rows.ceil()));
        Ok(Self { depths, surface, grid, material, lowest: low(material.seen(deepest.to_f64())) })
    }

    /// The pixels of the picture.
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// A band of the picture.
    pub fn draw(&self, band: Grid) -> Canvas {
        let (width, height) = (self.surface.width(), self.surface.height());
        let top = band.first_row(&self.grid);
        let lines = top..top + band.height();
        // What may lie in these lines, and a row before it, which says how far up its walls go.
        let first = pixel(((f64::from(top) - self.lowest) / BACK).floor() - 2.0);
        let end = pixel((f64::from(lines.end) / BACK).ceil() + 2.0).min(height);
        let mut canvas = Canvas::new(band, GROUND);
        if first >= end {
            return canvas;
        }
        let depths = (self.depths)(&self.surface.rows(first, end - first));
        let mut paint = |column: u32, line: u32, colour: Rgb| {
            if lines.contains(&line) {
                canvas.set(column, line - top, colour);
            }
        };
        // Where each column is drawn to; what lies above the first row is out of sight.
        let mut drawn = vec![if first > 0 { u32::MAX } else { 0 }; width as usize];
        let mut behind: &[f32] = &[];
        for (row, depths) in (first..end).zip(depths.chunks_exact(width as usize)) {
            self.row(row, [behind, depths], &mut drawn, &mut paint);
            behind = depths;
        }
        if end == height {
            self.edge(behind, &drawn, paint);
        }
        canvas
    }

    /// Paints a row of the surface, with the walls up to the row behind it, if there is one.
    fn row(
        &self,
        row: u32,
        [behind, depths]: [&[f32]; 2],
        drawn: &mut [u32],
        mut paint: impl FnMut(u32, u32, Rgb),
    ) {
        let pitch = self.surface.pitch().to_f64();
        for (column, from) in (0..).zip(drawn) {
            let at = column as usize;
            let seen = |depth: &f32| self.material.seen(f64::from(*depth));
            let deep = seen(&depths[at]);
            let behind = behind.get(at).map_or(deep, seen);
            let beside = depths.get(at + 1).map_or(deep, seen);
            let lit = lit([beside - deep, behind - deep].map(|rise| rise / pitch));
            let foot = f64::from(row + 1) * BACK + deep / pitch * UP;
            let down = pixel(foot);
            for line in (*from).min(down.saturating_sub(1))..down {
                let wall = deep - (foot - f64::from(line + 1)).max(0.0) * pitch / UP;
                paint(column, line, shaded(self.material.colour(wall.max(behind.min(deep))), lit));
            }
            *from = down;
        }
    }

    /// Paints the edge of the sheet below its nearest row.
    fn edge(&self, depths: &[f32], drawn: &[u32], mut paint: impl FnMut(u32, u32, Rgb)) {
        let edge = self.material.edge().to_f64();
        let foot = f64::from(self.surface.height()) * BACK;
        for (column, (&from, &depth)) in (0..).zip(drawn.iter().zip(depths)) {
            for line in from..self.grid.height() {
                let low = (f64::from(line) + 0.5 - foot) * self.surface.pitch().to_f64() / UP;
                if low.max(f64::from(depth)) < edge {
                    paint(column, line, shaded(self.material.colour(low), EDGE));
                }
            }
        }
    }

    /// The whole picture as a PNG.
    #[must_use]
    pub fn png(&self) -> Vec<u8> {
        png::bands(&self.grid, |band| self.draw(band))
    }
}

/// A number of pixels.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
const fn pixel(number: f64) -> u32 {
    number as u32
}

/// How bright a place is by how much it rises to the right and to the back: 1 where it is level.
fn lit([right, behind]: [f64; 2]) -> f64 {
    // Deeper to the right is lower there: the normal leans that way.
    let normal = [right, behind, 1.0];
    let length = (right * right + behind * behind + 1.0).sqrt();
    let lit = normal.iter().zip(LIGHT).map(|(a, b)| a * b).sum::<f64>() / length;
    SHADE + (1.0 - SHADE) * (lit / LIGHT[2]).max(0.0)
}

/// A colour so bright.
fn shaded(colour: [f64; 3], bright: f64) -> Rgb {
    let [r, g, b] = colour.map(|part| byte(part * bright));
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

    fn area(width: i64, height: i64) -> Rect {
        Rect::new(Point::default(), Point::new(Nm::from_um(width), Nm::from_um(height)))
    }

    #[test]
    fn walls_that_face_the_light_are_brighter_and_level_places_have_their_colour() {
        assert!((lit([0.0, 0.0]) - 1.0).abs() < 1e-12, "as it is");
        assert!(lit([-0.5, 0.0]) > 1.0, "it falls to the left, where the light is");
        assert!(lit([0.5, 0.0]) < 1.0, "it falls away from it");
        assert!(lit([0.0, 0.5]) > 1.0, "it falls to the back, where the light is, too");
    }

    #[test]
    fn a_picture_is_as_wide_as_its_area() {
        let flat = |grid: &Grid| vec![0.0; (grid.width() * grid.height()) as usize];
        let place = (area(2_000, 1_000), Nm::from_um(100));
        let picture = Relief::new(flat, Nm::ZERO, place, Material::Wood).expect("a picture").png();
        assert_eq!(picture[16..24], [0, 0, 0, 20, 0, 0, 0, 8], "20 by 8 pixels");
    }

    /// A hole through the middle and a groove, drawn at once and in bands.
    #[test]
    fn bands_show_no_seams() {
        let clad = Material::Clad { copper: Nm::from_um(35), thickness: Nm::from_um(1_600) };
        let depths = |grid: &Grid| {
            let rows = (0..grid.height()).flat_map(|row| (0..grid.width()).map(move |column| (column, row)));
            let deep = |(column, row): (u32, u32)| {
                let (x, y) = grid.center(i64::from(column), i64::from(row)).to_f64();
                let off = ((x - 2e6) * (x - 2e6) + (y - 5e6) * (y - 5e6)).sqrt();
                if off < 1e6 {
                    2e6
                } else if (x - 3.5e6).abs() < 2e5 {
                    1e5
                } else {
                    0.0
                }
            };
            rows.map(deep).collect()
        };
        let place = (area(4_000, 10_000), Nm::from_um(20));
        let relief = Relief::new(depths, Nm::from_mm(2), place, clad).expect("a picture");
        let whole = relief.draw(*relief.grid()).into_rgb();
        let band = |top: u32| relief.draw(relief.grid().rows(top, 56)).into_rgb();
        let bands: Vec<u8> = (0..relief.grid().height()).step_by(56).flat_map(band).collect();
        assert!(bands[..whole.len()] == whole, "as drawn at once");
        let colours: std::collections::BTreeSet<&[u8]> = whole.chunks(3).collect();
        for wanted in [clad.colour(0.0), clad.colour(1e5), clad.colour(2e6)] {
            assert!(colours.contains(wanted.map(byte).as_slice()), "{wanted:?} is seen");
        }
    }
}
