//! How much copper each net has, and how long its edge is.

use rayon::prelude::*;
use rustc_hash::FxHashSet;

use crate::board::{Copper, Shape, polarity};
use crate::geometry::{Nm, Point, Polygon, Rect, merge};

use super::{Groups, Net, Nets};

/// The size of a net's copper.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// Its area, in square nanometres.
    pub area: f64,
    /// The length of its edge, that of holes in it included, in nanometres.
    pub perimeter: f64,
    /// How many pieces it has, less its holes: so many times 2πr is a loop at the distance r longer
    /// than the edge, as long as it meets nothing (Steiner's formula).
    pub turns: f64,
}

impl Extent {
    /// How wide the copper is on average: what a long strip of this area and perimeter is.
    #[must_use]
    pub fn mean_width(&self) -> f64 {
        if self.perimeter > 0.0 { 2.0 * self.area / self.perimeter } else { 0.0 }
    }

    /// The length of loops round it at the distance `radius`, in nanometres.
    #[must_use]
    pub fn loop_length(&self, radius: Nm) -> f64 {
        self.perimeter + 2.0 * std::f64::consts::PI * radius.to_f64() * self.turns
    }
}

/// How far chords may leave the arcs of the copper. Chosen: a disc of half a millimetre then has a
/// perimeter right to one part in a thousand.
const CHORDS: Nm = Nm::from_um(2);

/// About so many features are joined at a time, so that not all of a large net's are polygons at
/// once. Chosen.
const PART: usize = 512;

/// The size of each net's copper, by number. Features that overlap count once,
/// but for those of thousands that cross each other so often that no boolean is tried.
#[must_use]
pub fn extents(copper: &Copper, nets: &Nets) -> Vec<Extent> {
    nets.nets().par_iter().map(|net| extent(copper, net)).collect()
}

fn extent(copper: &Copper, net: &Net) -> Extent {
    // What is drawn a million times in one place counts once.
    let mut seen = FxHashSet::default();
    let shapes = net.features.iter().map(|&feature| &copper.features[feature as usize].shape);
    let shapes: Vec<(&Shape, Rect)> =
        shapes.filter(|&shape| seen.insert(shape)).map(|shape| (shape, shape.bounds())).collect();
    drop(seen);
    let Some(bounds) = shapes.iter().map(|shape| shape.1).reduce(Rect::union) else {
        return Extent::default();
    };
    let mut sum = Extent::default();
    let mut before: Vec<Span> = Vec::new();
    let (windows, within) = strips(bounds, &shapes);
    for (&window, within) in windows.iter().zip(within.iter()) {
        let part = |&i: &u32| shapes[i as usize].0.polygon(CHORDS)?.clipped(window);
        let pieces = joined(within.iter().filter_map(part).collect(), windows.len() > 1);
        // What two strips have in common is in both, and its length an edge of neither.
        for (low, high) in common(&before, &along(&pieces, window.min().x)) {
            sum.perimeter -= 2.0 * (high - low).to_f64();
            sum.turns -= 1.0;
        }
        for piece in &pieces {
            let holes = u32::try_from(piece.contours().len() - 1).unwrap_or(u32::MAX);
            sum.area += piece.area_mm2() * 1e12;
            sum.perimeter += piece.perimeter();
            sum.turns += 1.0 - f64::from(holes);
        }
        before = along(&pieces, window.max().x);
    }
    sum
}

/// Strips side by side that together hold `bounds`, and which of `shapes` lie in each: about as
/// many as are joined at a time, but more where they would lie in three strips on average.
fn strips(bounds: Rect, shapes: &[(&Shape, Rect)]) -> (Vec<Rect>, Groups<u32>) {
    let mut begins: Vec<Nm> = shapes.iter().map(|(_, bounds)| bounds.min().x).collect();
    begins.sort_unstable();
    let mut part = PART;
    loop {
        let mut borders: Vec<Nm> = begins.iter().copied().step_by(part).skip(1).collect();
        borders.dedup();
        let within = |shape: &Rect| {
            let strip = |x: Nm| number(borders.partition_point(|&border| border <= x));
            strip(shape.min().x)..=strip(shape.max().x)
        };
        let ranges = (0_u32..).zip(shapes).map(|(i, (_, bounds))| (i, within(bounds)));
        let count: usize = ranges.clone().map(|(_, strips)| strips.count()).sum();
        if count > 3 * shapes.len() && !borders.is_empty() {
            part *= 2;
            continue;
        }
        let pairs = ranges.flat_map(|(i, strips)| strips.map(move |strip| (strip, i)));
        let within = Groups::new(borders.len() + 1, pairs);
        borders.insert(0, bounds.min().x);
        borders.push(bounds.max().x);
        let strip =
            |ends: &[Nm]| Rect::new(Point::new(ends[0], bounds.min().y), Point::new(ends[1], bounds.max().y));
        return (borders.windows(2).map(strip).collect(), within);
    }
}

fn number(count: usize) -> u32 {
    u32::try_from(count).expect("below 2³² strips")
}

/// What polygons cover together, where that is not too much work; those that were clipped may have
/// edges there and back.
fn joined(polygons: Vec<Polygon>, are_clipped: bool) -> Vec<Polygon> {
    let is_easy = || !polarity::is_tangled(polygons.iter().flat_map(Polygon::contours));
    if (polygons.len() > 1 || are_clipped) && is_easy() { polarity::union(&polygons) } else { polygons }
}

/// A part of an upright line, from below.
type Span = (Nm, Nm);

/// The parts of the line at `x` that are edges of polygons, in order.
fn along(pieces: &[Polygon], x: Nm) -> Vec<Span> {
    let edges = pieces.iter().flat_map(Polygon::edges).filter(|(from, to)| from.x == x && to.x == x);
    let mut spans: Vec<Span> = edges.map(|(from, to)| (from.y.min(to.y), from.y.max(to.y))).collect();
    spans.sort_unstable();
    merge(&mut spans);
    spans
}

/// What two lists of spans have in common.
fn common(a: &[Span], b: &[Span]) -> Vec<Span> {
    let (mut i, mut j) = (0, 0);
    let mut common = Vec::new();
    while let (Some(one), Some(other)) = (a.get(i), b.get(j)) {
        let (low, high) = (one.0.max(other.0), one.1.min(other.1));
        if low < high {
            common.push((low, high));
        }
        if one.1 < other.1 { i += 1 } else { j += 1 }
    }
    common
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::{Attributes, Axis, Feature, Side};
    use crate::topology::{Method, recover, splitmix};

    #[test]
    fn overlapping_strokes_count_once() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let stroke = |from: Point, to: Point| Feature {
            axis: Axis::Line(from, to),
            shape: Shape::Stroke { from, to, radius: Nm::from_um(500) },
            attributes: 0,
            line: 1,
        };
        // Many times over, which must not take longer.
        let mut features = vec![stroke(at(0, 0), at(6000, 0)); 500];
        features.push(stroke(at(4000, 0), at(10_000, 0)));
        let copper = Copper { side: Side::Front, features, attributes: vec![Attributes::default()] };
        let [extent] = extents(&copper, &recover(&copper, Method::Contact))[..] else { panic!("one net") };
        // A stadium of 10 mm between the middles of its ends, 1 mm wide.
        let (area, perimeter) = (10.0 + std::f64::consts::PI / 4.0, 20.0 + std::f64::consts::PI);
        assert!((extent.area / 1e12 / area - 1.0).abs() < 2e-3, "{extent:?}");
        assert!((extent.perimeter / 1e6 / perimeter - 1.0).abs() < 1e-3, "{extent:?}");
        let grown = 20.0 + std::f64::consts::PI * 1.2;
        assert!((extent.loop_length(Nm::from_um(100)) / 1e6 / grown - 1.0).abs() < 1e-3, "{extent:?}");
        assert!((extent.mean_width() / 1e6 - 0.93).abs() < 0.02, "{extent:?}");
    }

    #[test]
    fn strips_add_up_to_the_whole() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let mut state = 0;
        let mut next = |below: i64| {
            state += 1;
            i64::try_from(splitmix(state) >> 33).expect("31 bits") % below
        };
        let mut shapes: Vec<Shape> = (0..4 * PART)
            .map(|_| {
                let (from, radius) = (at(next(30_000), next(30_000)), Nm::from_um(40 + next(100)));
                let to = from + (at(next(600), next(600)) - at(300, 300));
                if next(3) > 0 {
                    Shape::Stroke { from, to, radius }
                } else {
                    Shape::Disc { center: from, radius }
                }
            })
            .collect();
        // A frame that all strips cross, one edge of which may lie on a border.
        let ring = |low: i64, high: i64| Rect::new(at(low, low), at(high, high)).corners().to_vec();
        let mut hole = ring(2000, 28_000);
        hole.reverse();
        shapes.push(Shape::Polygon(Polygon::new(vec![ring(0, 30_000), hole]).expect("a frame")));
        let polygons: Vec<Polygon> = shapes.iter().filter_map(|shape| shape.polygon(CHORDS)).collect();
        let whole = polarity::union(&polygons);
        let feature = |shape: Shape| Feature { axis: Axis::Region, shape, attributes: 0, line: 1 };
        let features: Vec<Feature> = shapes.into_iter().map(feature).collect();
        let bounds = features.iter().map(|feature| (&feature.shape, feature.shape.bounds()));
        assert!(
            strips(Rect::new(at(-500, -500), at(31_000, 31_000)), &bounds.collect::<Vec<_>>()).0.len() > 3
        );
        let copper = Copper { side: Side::Front, features, attributes: vec![Attributes::default()] };
        let net = Net { features: (0_u32..).take(copper.features.len()).collect(), ..Net::default() };
        let extent = extent(&copper, &net);
        let sum = |of: fn(&Polygon) -> f64| whole.iter().map(of).sum::<f64>();
        let turns = sum(|piece| 2.0 - f64::from(u32::try_from(piece.contours().len()).expect("few")));
        assert!((extent.area / 1e12 - sum(Polygon::area_mm2)).abs() < 1e-6, "{extent:?}");
        assert!((extent.perimeter / sum(Polygon::perimeter) - 1.0).abs() < 1e-6, "{extent:?}");
        assert!((extent.turns - turns).abs() < 0.5, "{extent:?}, {turns} of the whole");
    }
}
