//! Exact polygon booleans: the one place that knows the boolean library.
//!
//! `i_overlay` works in 32-bit integers whose range is exactly that of [`Nm`]: points of the input
//! keep their place, crossings are rounded to the nanometre, and every machine gives the same
//! polygons. Of the libraries tried (a C++ and a Rust Clipper2, `geo`) it was the fastest by a
//! factor of five, and the one that independent sampling sided with where they disagreed.

mod cracks;
mod cuts;

use std::ops::Range;

use i_overlay::core::fill_rule::FillRule as LibraryRule;
use i_overlay::core::overlay::{Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::angle::Angle;
use i_overlay::i_float::int::point::IntPoint;
use i_overlay::mesh::int::arc::ArcOptions;
use i_overlay::mesh::int::outline::offset::IntOutlineOffset;
use i_overlay::mesh::int::style::{IntLineJoin, IntOutlineStyle};

use crate::geometry::{Circle, Nm, Point, Polygon, Rect, RectIndex, cross};

use cracks::without_cracks;
use cuts::Cuts;

/// Which points contours, taken together, have inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FillRule {
    /// Those that they wind round any number of times but none.
    #[default]
    NonZero,
    /// Those from which a ray crosses them an odd number of times.
    EvenOdd,
}

/// The inside of `contours` by `rule`: as simple polygons, one for each connected piece, holes
/// included.
#[must_use]
pub fn filled(contours: &[Vec<Point>], rule: FillRule) -> Vec<Polygon> {
    let mut overlay = Overlay::new(contours.iter().map(Vec::len).sum());
    let int: Vec<Vec<IntPoint<i32>>> =
        contours.iter().map(|ring| ring.iter().copied().map(int).collect()).collect();
    let rule = match rule {
        FillRule::NonZero => LibraryRule::NonZero,
        FillRule::EvenOdd => LibraryRule::EvenOdd,
    };
    polygons(overlay.simplify_source(&int, rule))
}

/// The area where `contours`, taken together, wind round a point any number of times but none: as
/// [`filled`] has it.
#[must_use]
pub fn clean(contours: &[Vec<Point>]) -> Vec<Polygon> {
    filled(contours, FillRule::NonZero)
}

/// What at least one of `polygons` covers, one polygon for each connected piece.
///
/// Each must be simple, as [`clean`] and the other functions here return them. What they remember
/// of circles is kept, here and in the others.
#[must_use]
pub fn union<'a>(polygons: impl IntoIterator<Item = &'a Polygon>) -> Vec<Polygon> {
    let mut operands = Operands::new();
    polygons.into_iter().for_each(|polygon| operands.add(polygon, ShapeType::Subject));
    operands.overlay(OverlayRule::Subject)
}

/// What `subject` covers and none of `clips` does; polygons as for [`union`].
#[must_use]
pub fn difference<'a>(subject: &Polygon, clips: impl IntoIterator<Item = &'a Polygon>) -> Vec<Polygon> {
    let cuts = Cuts::of(subject, clips);
    let mut operands = Operands::new();
    operands.add(subject, ShapeType::Subject);
    cuts.others.iter().for_each(|clip| operands.add(clip, ShapeType::Clip));
    operands.circles.extend(cuts.holes.iter().flat_map(|hole| hole.circles()));
    let left =
        cuts.punched(polygons(operands.overlay.overlay(OverlayRule::Difference, LibraryRule::NonZero)));
    of_circles(left, operands.circles)
}

/// What both cover; polygons as for [`union`].
#[must_use]
pub fn intersection(a: &Polygon, b: &Polygon) -> Vec<Polygon> {
    let mut operands = Operands::new();
    operands.add(a, ShapeType::Subject);
    operands.add(b, ShapeType::Clip);
    operands.overlay(OverlayRule::Intersect)
}

/// What some polygons and some others both cover; each as for [`union`]. Of many this is one
/// boolean, where one for each pair takes as long as there are pairs.
#[must_use]
pub fn common(some: &[Polygon], others: &[Polygon]) -> Vec<Polygon> {
    Operands::of(some, others).overlay(OverlayRule::Intersect)
}

/// What some polygons cover and none of the others does, in one boolean, too.
#[must_use]
pub fn remainder(some: &[Polygon], others: &[Polygon]) -> Vec<Polygon> {
    Operands::of(some, others).overlay(OverlayRule::Difference)
}

/// `polygon` grown by `by` on every side, with round corners within `tolerance`; shrunk where `by`
/// is negative. Polygons as for [`union`].
#[must_use]
pub fn offset(polygon: &Polygon, by: Nm, tolerance: Nm) -> Vec<Polygon> {
    let radius = by.abs().to_f64().max(1.0);
    let step = 2.0 * libm::acos(1.0 - (tolerance.to_f64().max(1.0) / radius).min(1.0));
    let max_step = Angle::from_radians(step).unwrap_or(ArcOptions::MAX_STEP);
    let join = IntLineJoin::Round(ArcOptions { max_step, ..ArcOptions::default() });
    let style = IntOutlineStyle::new(int_length(by)).line_join(join);
    let contours: Vec<Vec<IntPoint<i32>>> =
        polygon.contours().iter().map(|ring| ring.iter().copied().map(int).collect()).collect();
    let grown = contours.outline(&style).unwrap_or_default();
    let closed = rings_of(grown).map(|rings| rings.map(without_cracks).collect::<Vec<_>>());
    // The first ring is the outer one.
    closed
        .filter(|rings| rings.first().is_some_and(|outer| outer.len() > 2))
        .filter_map(Polygon::new)
        .collect()
}

/// How many pairs of edges that may cross cost as much as a vertex: measured, 0.13 µs beside 1 µs.
const NEAR_PAIRS: u64 = 8;

/// Edges below which any number of pairs may be near each other. Chosen.
const FEW: usize = 4096;

/// The most crossings for each edge, of [`FEW`] edges at least. Measured: a star whose chords all
/// cross near its middle, the slowest there is, takes 1.4 s and 45 MB with so many crossings, and
/// seven times as long with twice the edges; as many at random take 0.6 s.
const CROSSINGS: u64 = 50;

/// What a crossing costs, in vertices: measured, 5 s for the two million of 4000 edges drawn at
/// random.
const CROSSING: u64 = 2;

/// Whether the edges of `contours` cross so often that a boolean of them would take many seconds
/// and gigabytes. So few that all may cross all are never tangled.
#[must_use]
pub fn is_tangled<'a>(contours: impl Iterator<Item = &'a Vec<Point>> + Clone) -> bool {
    let edges = edges_of(contours.clone()) as u64;
    edges * edges / 2 > most_crossings(edges) && Tangle::of(contours).is_too_much()
}

/// The most crossings of so many edges that a boolean works out.
fn most_crossings(edges: u64) -> u64 {
    edges.max(FEW as u64) * CROSSINGS
}

/// What a boolean of `contours` takes, in vertices: about a microsecond each.
#[must_use]
pub fn effort<'a>(contours: impl Iterator<Item = &'a Vec<Point>> + Clone) -> u64 {
    Tangle::of(contours).effort()
}

/// What a boolean of some contours has to look at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tangle {
    edges: u64,
    /// An estimate from a sample of the edges: how many pairs may cross, going by their bounds.
    near: u64,
    /// How many do.
    crossings: u64,
}

impl Tangle {
    pub(super) fn of<'a>(contours: impl Iterator<Item = &'a Vec<Point>> + Clone) -> Self {
        /// Chosen: a fraction of what the boolean itself takes, and enough to tell a tangle from a
        /// plane.
        const SAMPLE: usize = 64;
        let count = edges_of(contours.clone());
        let all = contours.clone().flat_map(|ring| edges(ring, 0..ring.len()));
        let sample: Vec<Edge> = all.step_by(count.div_ceil(SAMPLE).max(1)).collect();
        let sampled = sample.len().max(1);
        let met = contours.map(|ring| met(&sample, ring));
        let (touched, crossed) = met.fold((0, 0), |sum, met| (sum.0 + met.0, sum.1 + met.1));
        let pairs = |found: usize| (found as u64 * count as u64) / (2 * sampled as u64);
        // Each edge touches itself and the two beside it.
        let near = pairs(touched.saturating_sub(3 * sampled));
        Self { edges: count as u64, near, crossings: pairs(crossed) }
    }

    pub(super) const fn effort(self) -> u64 {
        self.edges + self.crowd()
    }

    /// What it takes beyond its vertices.
    pub(super) const fn crowd(self) -> u64 {
        self.near / NEAR_PAIRS + self.crossings * CROSSING
    }

    pub(super) fn is_too_much(self) -> bool {
        /// Pairs of edges that may cross beyond which a layer of more edges is refused. Chosen.
        const PAIRS: u64 = 20_000_000;
        let is_crowded = self.edges >= FEW as u64 && self.near > PAIRS;
        is_crowded || self.crossings > most_crossings(self.edges)
    }
}

/// The bounds of an edge, and its ends.
type Edge = (Rect, (Point, Point));

/// The edges of `ring` that begin at its points `at`.
fn edges(ring: &[Point], at: Range<usize>) -> impl Iterator<Item = Edge> {
    at.map(|at| (ring[at], ring[(at + 1) % ring.len()])).map(|(a, b)| (Rect::new(a, b), (a, b)))
}

/// How many pairs of an edge of `sample` and one of `ring` have bounds that touch, and how many
/// cross.
fn met(sample: &[Edge], ring: &[Point]) -> (usize, usize) {
    /// Edges one after another lie together, and most of the sample is far from all of them.
    /// Chosen.
    const RUN: usize = 32;
    let (mut touched, mut crossed) = (0, 0);
    for from in (0..ring.len()).step_by(RUN) {
        let run = || edges(ring, from..(from + RUN).min(ring.len()));
        let Some(around) = run().map(|edge| edge.0).reduce(Rect::union) else { continue };
        for (bounds, one) in sample.iter().filter(|(bounds, _)| bounds.touches(around)) {
            for (_, other) in run().filter(|(other, _)| other.touches(*bounds)) {
                touched += 1;
                crossed += usize::from(cross(*one, other));
            }
        }
    }
    (touched, crossed)
}

/// How many edges `contours` have.
fn edges_of<'a>(contours: impl Iterator<Item = &'a Vec<Point>>) -> usize {
    contours.map(Vec::len).sum()
}

/// What a boolean is of.
struct Operands {
    overlay: Overlay<i32>,
    circles: Vec<Circle>,
}

impl Operands {
    fn new() -> Self {
        Self { overlay: Overlay::new(0), circles: Vec::new() }
    }

    fn of(subjects: &[Polygon], clips: &[Polygon]) -> Self {
        let mut operands = Self::new();
        subjects.iter().for_each(|polygon| operands.add(polygon, ShapeType::Subject));
        clips.iter().for_each(|polygon| operands.add(polygon, ShapeType::Clip));
        operands
    }

    fn add(&mut self, polygon: &Polygon, kind: ShapeType) {
        for ring in polygon.contours() {
            self.overlay.add_path_iter(ring.iter().copied().map(int), kind);
        }
        self.circles.extend_from_slice(polygon.circles());
    }

    fn overlay(mut self, rule: OverlayRule) -> Vec<Polygon> {
        of_circles(polygons(self.overlay.overlay(rule, LibraryRule::NonZero)), self.circles)
    }
}

/// Polygons that remember those of `circles` that reach them.
pub(crate) fn of_circles(polygons: Vec<Polygon>, mut circles: Vec<Circle>) -> Vec<Polygon> {
    circles.sort_unstable();
    circles.dedup();
    if circles.is_empty() {
        return polygons;
    }
    let index = RectIndex::new(circles.iter().map(|circle| circle.bounds()));
    let remembering = |polygon: Polygon| {
        let near = index.touching(polygon.bounds());
        polygon.of_circles(near.into_iter().map(|i| circles[i]))
    };
    polygons.into_iter().map(remembering).collect()
}

fn polygons(shapes: Vec<Vec<Vec<IntPoint<i32>>>>) -> Vec<Polygon> {
    rings_of(shapes).filter_map(|rings| Polygon::new(rings.collect())).collect()
}

/// The rings of each shape that the library returns.
fn rings_of(shapes: Vec<Vec<Vec<IntPoint<i32>>>>) -> impl Iterator<Item = impl Iterator<Item = Vec<Point>>> {
    let point = |p: IntPoint<i32>| Point::new(Nm::new(i64::from(p.x)), Nm::new(i64::from(p.y)));
    let ring = move |ring: Vec<IntPoint<i32>>| ring.into_iter().map(point).collect();
    shapes.into_iter().map(move |shape| shape.into_iter().map(ring))
}

/// The library's point. Coordinates of a board are in range; those of a margin beyond it are drawn
/// back to the range.
fn int(p: Point) -> IntPoint<i32> {
    IntPoint::new(int_length(p.x), int_length(p.y))
}

fn int_length(nm: Nm) -> i32 {
    i32::try_from(nm.clamp(Nm::MIN, Nm::MAX).get()).expect("the range of Nm fits 31 bits")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tangle_is_what_comparing_every_edge_with_the_sample_counts() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let ring = |count: i64, step: i64| (0..count).map(|i| at(i * step % 1009, i * i * 7 % 997)).collect();
        // Longer than a run, a run and shorter, and as many edges as the sample has, or not.
        for counts in [[500, 32, 3], [64, 33, 31], [1, 2, 61], [0, 0, 0]] {
            let rings: Vec<Vec<Point>> = counts.iter().map(|&count| ring(count, 5 + count)).collect();
            let tangle = Tangle::of(rings.iter());
            let all: Vec<Edge> = rings.iter().flat_map(|ring| edges(ring, 0..ring.len())).collect();
            let sample: Vec<&Edge> = all.iter().step_by(all.len().div_ceil(64).max(1)).collect();
            let pairs = sample.iter().flat_map(|one| all.iter().map(move |other| (*one, other)));
            let touching: Vec<_> = pairs.filter(|(one, other)| one.0.touches(other.0)).collect();
            let crossing = touching.iter().filter(|(one, other)| cross(one.1, other.1)).count();
            let share = |found: usize| (found * all.len() / (2 * sample.len().max(1))) as u64;
            assert_eq!(tangle.edges, all.len() as u64, "edges of {counts:?}");
            assert_eq!(tangle.near, share(touching.len().saturating_sub(3 * sample.len())), "of {counts:?}");
            assert_eq!(tangle.crossings, share(crossing), "of {counts:?}");
        }
    }
}
