//! Distances to copper, from every feature.

use voromill::board::{Copper, Shape};
use voromill::geometry::{Nm, Point};
use voromill::topology::{NetId, Nets};

/// The distance from (`x`, `y`) to the copper of `shape`, in nanometres; zero inside.
pub(crate) fn distance(shape: &Shape, x: f64, y: f64) -> f64 {
    let bare = |d: f64, radius: &Nm| (d - radius.to_f64()).max(0.0);
    match shape {
        Shape::Disc { center, radius } => bare(to_segment(x, y, *center, *center), radius),
        Shape::Stroke { from, to, radius } => bare(to_segment(x, y, *from, *to), radius),
        Shape::Arc { arc, radius } => {
            let points: Vec<_> = std::iter::once(arc.start).chain(arc.flatten(Nm::new(5))).collect();
            bare(
                points
                    .windows(2)
                    .map(|pair| to_segment(x, y, pair[0], pair[1]))
                    .fold(f64::INFINITY, f64::min),
                radius,
            )
        }
        Shape::Polygon(polygon) => {
            if polygon.contains(Point::from_f64(x, y)) {
                return 0.0;
            }
            polygon.edges().map(|(a, b)| to_segment(x, y, a, b)).fold(f64::INFINITY, f64::min)
        }
    }
}

fn to_segment(x: f64, y: f64, a: Point, b: Point) -> f64 {
    let ((ax, ay), (bx, by)) = (a.to_f64(), b.to_f64());
    let (wx, wy) = (bx - ax, by - ay);
    let squared = wx * wx + wy * wy;
    let t = if squared > 0.0 { (((x - ax) * wx + (y - ay) * wy) / squared).clamp(0.0, 1.0) } else { 0.0 };
    let (dx, dy) = (x - ax - t * wx, y - ay - t * wy);
    (dx * dx + dy * dy).sqrt()
}

/// The distance from (`x`, `y`) to the copper of each net, in nanometres.
pub(crate) fn distances(copper: &Copper, nets: &Nets, x: f64, y: f64) -> Vec<f64> {
    let mut nearest = vec![f64::INFINITY; nets.nets().len()];
    for (i, feature) in copper.features.iter().enumerate() {
        let NetId(net) = nets.of(i);
        let slot = &mut nearest[net as usize];
        *slot = slot.min(distance(&feature.shape, x, y));
    }
    nearest
}
