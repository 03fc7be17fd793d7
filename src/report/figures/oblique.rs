//! Figure 5: the roofs, fans and cones over the core axes of nets, seen at a slant from any side.
//!
//! ```text
//!            ╱╲ axis             The plane is turned by the azimuth and looked at from above by so much that the far slopes, which
//!     ╱─────╱  ╲────╲            fall at 45°, are seen, too: from more than 45° above the plane. Then the axis, a band and discs
//!    ╱─────╱────╲────╲           just above the crest, is as thick as it is asked to be.
//! ```

use std::f64::consts::PI;

use crate::board::{Axis, Copper};
use crate::geometry::{Nm, Point, Rect};
use crate::grid::Grid;
use crate::raster::view::{Face, Projection, View, draw};
use crate::raster::{PixelPoint, Surface};
use crate::report::Rgb;
use crate::topology::{NetId, Nets};
use crate::voronoi::paper;

use super::FigureError;
use super::painting::{Painting, WHITE};

/// Where a picture is taken from.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// How far the board is turned, counter-clockwise, in degrees.
    pub azimuth: f64,
    /// How far above the plane of the board the eye is, in degrees: 90 is from straight above.
    pub elevation: f64,
}

/// What is drawn: nets with their colours, and how far their slopes reach.
pub(super) struct Slopes<'a> {
    pub(super) copper: &'a Copper,
    pub(super) nets: &'a Nets,
    pub(super) shown: Vec<(NetId, Rgb)>,
    pub(super) reach: Nm,
    /// Whether the edges of triangles are drawn.
    pub(super) edges: bool,
    /// Half as wide as this part of the picture's width are axes.
    pub(super) axis: f64,
}

/// Pixels that each one shown is the mean of, in a row. Chosen: smooth edges.
const FINER: u32 = 3;
const BLACK: [u8; 3] = [16, 16, 20];

impl Slopes<'_> {
    /// The picture, `columns` wide.
    pub(super) fn draw(&self, look: Look, columns: u32) -> Result<Painting, FigureError> {
        let shown = |net: NetId| self.shown.iter().any(|(other, _)| *other == net);
        let mine = self.copper.features.iter().enumerate().filter(|(i, _)| shown(self.nets.of(*i)));
        let bounds = mine.clone().map(|(_, feature)| feature.shape.bounds()).reduce(Rect::union);
        let bounds = bounds.ok_or(FigureError::NoCopper)?.inflate(self.reach);
        // Turned, it is as wide as its diagonal at most.
        let widest = bounds.min().distance(bounds.max());
        let wide = columns * FINER;
        let grid = Grid::covering(bounds, Nm::from_f64(widest / f64::from(wide)) + Nm::new(1))?;
        let turn = Turned::new(look, &grid);
        let mut faces = Vec::new();
        for &(net, Rgb(r, g, b)) in &self.shown {
            let slopes = paper::slopes(self.copper, self.nets, net, grid, self.reach);
            faces.extend(slopes.iter().filter_map(|surface| turn.face(surface, [r, g, b])));
        }
        let half = f64::from(wide) * self.axis;
        for (_, feature) in mine {
            match feature.axis {
                Axis::Flash(center) => faces.extend(turn.dot(grid.pixel(center), half * 1.5)),
                Axis::Line(from, to) => faces.extend(turn.band(grid.pixel(from), grid.pixel(to), half)),
                Axis::Arc(arc) => {
                    let points: Vec<Point> =
                        std::iter::once(arc.start).chain(arc.flatten(grid.pitch())).collect();
                    for pair in points.windows(2) {
                        faces.extend(turn.band(grid.pixel(pair[0]), grid.pixel(pair[1]), half));
                    }
                }
                Axis::Region => {}
            }
        }
        let view = turn.view(&faces, self.edges.then_some(BLACK));
        let pixels = draw(&faces, &view);
        Ok(Painting { width: view.size.0 as usize, pixels }.smaller(FINER as usize))
    }
}

/// The plane turned about its middle.
struct Turned {
    middle: [f64; 2],
    sin: f64,
    cos: f64,
    tilt: f64,
}

impl Turned {
    fn new(look: Look, grid: &Grid) -> Self {
        let (sin, cos) = libm::sincos(look.azimuth * PI / 180.0);
        let middle = [f64::from(grid.width()) / 2.0, f64::from(grid.height()) / 2.0];
        Self { middle, sin, cos, tilt: libm::sin(look.elevation * PI / 180.0) }
    }

    fn corner(&self, x: f64, y: f64, z: f64) -> [f64; 3] {
        let (x, y) = (x - self.middle[0], y - self.middle[1]);
        [x * self.cos + y * self.sin, y * self.cos - x * self.sin, z]
    }

    fn face(&self, surface: &Surface, color: [u8; 3]) -> Option<Face> {
        let face = Face::of(surface, color)?;
        Some(Face { corners: face.corners.map(|[x, y, z]| self.corner(x, y, z)), ..face })
    }

    /// A band along an axis, with a dot at either end: above the crest by half its width, so that
    /// no slope hides any of it.
    fn band(&self, from: PixelPoint, to: PixelPoint, half: f64) -> Vec<Face> {
        let [a, b] = [from, to].map(|point| [point.x.to_pixels(), point.y.to_pixels()]);
        let way = [b[0] - a[0], b[1] - a[1]];
        let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
        let mut faces = self.dot(from, half);
        faces.extend(self.dot(to, half));
        if length > 0.0 {
            let out = [-way[1] / length * half, way[0] / length * half];
            let at = |p: [f64; 2], side: f64| self.corner(p[0] + out[0] * side, p[1] + out[1] * side, -half);
            let [left, right, far_left, far_right] = [at(a, 1.0), at(a, -1.0), at(b, 1.0), at(b, -1.0)];
            for corners in [[left, right, far_left], [right, far_right, far_left]] {
                faces.push(Face { corners, color: BLACK });
            }
        }
        faces
    }

    fn dot(&self, center: PixelPoint, radius: f64) -> Vec<Face> {
        /// Corners of a dot. Chosen: looks round.
        const CORNERS: u32 = 24;
        let (x, y) = (center.x.to_pixels(), center.y.to_pixels());
        let rim = |i: u32| {
            let (sin, cos) = libm::sincos(2.0 * PI * f64::from(i) / f64::from(CORNERS));
            self.corner(x + radius * cos, y + radius * sin, -radius)
        };
        let middle = self.corner(x, y, -radius);
        (0..CORNERS).map(|i| Face { corners: [middle, rim(i), rim(i + 1)], color: BLACK }).collect()
    }

    /// A view that holds all faces.
    fn view(&self, faces: &[Face], edges: Option<[u8; 3]>) -> View {
        let across = (1.0 - self.tilt * self.tilt).max(0.0).sqrt();
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for [x, y, z] in faces.iter().flat_map(|face| face.corners) {
            for (i, place) in [x, y * self.tilt + z * across].into_iter().enumerate() {
                low[i] = low[i].min(place);
                high[i] = high[i].max(place);
            }
        }
        let margin = f64::from(FINER) * 8.0;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
        let size = [0, 1].map(|i| (high[i] - low[i] + 2.0 * margin) as u32);
        View {
            azimuth: 0.0,
            projection: Projection::Oblique { tilt: self.tilt },
            size: (size[0], size[1]),
            origin: [margin - low[0], margin - low[1]],
            background: WHITE,
            edges,
        }
    }
}
