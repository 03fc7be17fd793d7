//! Triangles by OpenGL's rules: what tessellated cones and curtains are made of.

use super::super::canvas::{Canvas, count, put};
use super::super::cell::Cell;
use super::super::half_plane::{Convex, Cover, HalfPlane};
use super::super::subpixel::sample;
use super::super::{Fragment, Label, PixelPoint};
use super::{Bounds, Reach};

/// A triangle, clockwise on the picture, and the plane its depth lies in.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Triangle {
    corners: [(i32, i32); 3],
    /// Depth at the first corner, and its change a step along x and y.
    depth: f64,
    slope: (f64, f64),
    /// The least and the greatest corner.
    range: (f32, f32),
}

impl Triangle {
    /// None where it has no area.
    ///
    /// # Panics
    ///
    /// Where a depth is not finite.
    pub(in super::super) fn new(corners: [PixelPoint; 3], depths: [f32; 3]) -> Option<Self> {
        assert!(depths.iter().all(|depth| depth.is_finite()), "a depth is a finite number");
        let mut corners = corners.map(PixelPoint::raw);
        // Adding 0 turns −0 into 0, so that equal depths are equal bits.
        let mut depths = depths.map(|depth| depth + 0.0);
        let way = |k: usize| {
            let (from, to): ((i32, i32), (i32, i32)) = (corners[0], corners[k]);
            (i64::from(to.0) - i64::from(from.0), i64::from(to.1) - i64::from(from.1))
        };
        let (u, v) = (way(1), way(2));
        let area = u.0 * v.1 - u.1 * v.0;
        if area == 0 {
            return None;
        }
        // The plane comes from the corners in a fixed order, whichever way round the caller named
        // them.
        let slope = slope(u, v, area, depths);
        let depth = f64::from(depths[0]);
        let range =
            depths.iter().fold((depths[0], depths[0]), |(least, most), &d| (least.min(d), most.max(d)));
        let first = corners[0];
        if area < 0 {
            corners.swap(1, 2);
            depths.swap(1, 2);
        }
        debug_assert!(corners[0] == first, "the plane hangs on the first corner");
        Some(Self { corners, depth, slope, range })
    }

    fn region(&self) -> Convex<3> {
        let [a, b, c] = self.corners;
        let edge = |from: (i32, i32), to: (i32, i32)| {
            let way = (i64::from(to.0) - i64::from(from.0), i64::from(to.1) - i64::from(from.1));
            Some(HalfPlane::clockwise(from, way).top_left())
        };
        Convex([edge(a, b), edge(b, c), edge(c, a)])
    }

    pub(super) fn reach(&self, cell: Cell) -> Option<Reach> {
        let cover = self.region().cover(cell);
        if cover == Cover::Empty {
            return None;
        }
        let (x, y) = cell.center();
        let (hx, hy) = cell.half_size();
        let (least, most) = (f64::from(self.range.0), f64::from(self.range.1));
        let middle = self.at(x * 256.0, y * 256.0);
        let change = (self.slope.0.abs() * hx + self.slope.1.abs() * hy) * 256.0;
        let slack = (middle.abs() + change) * 1e-6;
        let near = (middle - change - slack).clamp(least, most);
        let far = (middle + change + slack).clamp(least, most);
        Some(Reach { near, far: if cover == Cover::Whole { far } else { f64::INFINITY } })
    }

    pub(super) fn bounds(&self) -> Bounds {
        Bounds::flat(self.corners, self.range.0)
    }

    /// Its depth at a pixel; none beside it.
    pub(super) fn fragment(&self, column: i32, row: i32) -> Option<f32> {
        self.region().holds(column, row).then(|| self.depth_at(sample(column), sample(row)))
    }

    /// The depth of its plane at a sample, not beyond those of its corners.
    fn depth_at(&self, x: i32, y: i32) -> f32 {
        #[expect(clippy::cast_possible_truncation, reason = "rounded correctly")]
        let depth = self.at(f64::from(x), f64::from(y)) as f32;
        depth.max(self.range.0).min(self.range.1) + 0.0
    }

    fn at(&self, x: f64, y: f64) -> f64 {
        let (x0, y0) = self.corners[0];
        self.depth + ((x - f64::from(x0)) * self.slope.0 + (y - f64::from(y0)) * self.slope.1)
    }

    pub(super) fn draw(&self, label: Label, canvas: &mut Canvas) {
        let region = self.region();
        let cell = canvas.block();
        for (row, depths, labels) in canvas.rows() {
            let y = sample(row);
            let columns = region.columns(y, cell.x..cell.x + cell.width);
            for column in columns {
                let at = count(column - cell.x);
                put(
                    &mut depths[at],
                    &mut labels[at],
                    Fragment { depth: self.depth_at(sample(column), y), label },
                );
            }
        }
    }
}

/// How the depth changes along x and y, a step each.
#[expect(clippy::cast_precision_loss, reason = "rounded correctly")]
fn slope(u: (i64, i64), v: (i64, i64), area: i64, depths: [f32; 3]) -> (f64, f64) {
    let (du, dv) = (f64::from(depths[1]) - f64::from(depths[0]), f64::from(depths[2]) - f64::from(depths[0]));
    let area = area as f64;
    ((du * v.1 as f64 - dv * u.1 as f64) / area, (dv * u.0 as f64 - du * v.0 as f64) / area)
}
