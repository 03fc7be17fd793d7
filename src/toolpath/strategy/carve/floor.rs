//! Wide places: a flat floor, which an end mill clears and of which the V-bit cuts the walls and
//! what the end mill does not reach.
//!
//! ```text
//!   ══╲                              ╱══     The floor is where the cone that touches the nearest edge is deeper than asked for. The end
//!      ╲   ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁   ╱        mill goes round it in loops, from the inside out, each a step from the one before, and
//!       ╲▁▁▏   end mill, in loops ▕▁╱        along the axis where loops turn too sharply to touch; the V-bit goes along the rim.
//!        ╵rim                   rim╵
//! ```
//!
//! Loops are level sets of the distance from the areas' edges. From one to the next the mill stays
//! down: the way lies between them, and is as long as they are apart. So does the V-bit where the
//! way from one of its lines to the next leads over the floor.

use std::slice;

use crate::board::FLATTEN;
use crate::board::polarity::{difference, offset, union};
use crate::geometry::{Edges, Nm, Path, Point, Polygon};
use crate::toolpath::head::Head;
use crate::toolpath::{Heights, Placement, Section, Tool, ToolKind};
use crate::voronoi::fit_points;
use crate::voronoi::medial::{Interior, MedialAxis, insets};

use super::room::Room;

/// What of the end mill's radius two loops are apart. Chosen: loops that turn by up to 130° leave
/// nothing between them.
const STEP: f64 = 0.8;

/// What of the tip's width two loops of the V-bit are apart where it clears. Chosen: an overlap of
/// 15 %.
const FINE_STEP: f64 = 0.85;

/// Links between loops are at most so many steps long: a longer one would leave what is wide
/// enough. Chosen: one, and rounding.
const REACH: f64 = 1.02;

/// The corners of a closed loop, each once.
type Ring = Vec<Point>;

/// What is done about wide places.
#[derive(Debug, Default)]
pub struct Floor {
    /// The loops of the end mill, the outermost level first.
    levels: Vec<Vec<Ring>>,
    /// Where it follows the axis, since loops leave something there.
    strokes: Vec<Path>,
    /// What the V-bit goes along at the full depth.
    pub(super) rims: Vec<Path>,
    /// Where the V-bit may be at that depth, and a little beyond: as far as fitted lines may stray.
    pub(super) room: Room,
    /// How far loops are apart, in nanometres.
    step: f64,
    tolerance: Nm,
}

impl Floor {
    /// What is to be done so that areas are flat at the depth of the V-bit's heights; the end mill
    /// and the V-bit must be such, and the V-bit's tip above zero. The walls are within `tolerance`
    /// of their depth.
    #[must_use]
    pub fn new(
        areas: &[Interior<'_>],
        axis: &MedialAxis,
        v_bit: &Tool,
        depth: Nm,
        mill: &Tool,
        tolerance: Nm,
    ) -> Self {
        let (ToolKind::VBit { tip, .. }, ToolKind::EndMill { diameter }) = (v_bit.kind, mill.kind) else {
            return Self::default();
        };
        // Along a wall what is off sideways is off by more in depth.
        let tolerance = Nm::from_f64(tolerance.to_f64() * v_bit.kind.flank().min(1.0));
        // Where the floor begins, and how far from the edges either tool goes.
        let edge = v_bit.width_at(depth) / 2 - tip / 2;
        let (radius, rim) = (diameter / 2, edge + tip / 2);
        let step = Nm::from_f64(radius.to_f64() * STEP);
        let mut levels = Vec::new();
        let mut cleared: Vec<Polygon> = Vec::new();
        for count in 0.. {
            let inside = edge + radius + step * count;
            let level = insets(areas, inside);
            if level.is_empty() {
                break;
            }
            // What a mill clears along their edges.
            let within = insets(areas, inside + radius);
            let grown = level.iter().flat_map(|polygon| offset(polygon, radius, FLATTEN));
            cleared.extend(grown.flat_map(|outer| difference(&outer, &within)));
            levels.push(level.iter().flat_map(Polygon::contours).map(|ring| dense(ring)).collect());
        }
        let cleared = union(&cleared);
        let mut rest: Vec<Polygon> =
            insets(areas, edge).iter().flat_map(|floor| difference(floor, &cleared)).collect();
        let strokes = strokes(axis, edge + radius, &rest, tolerance);
        let along: Vec<Polygon> = strokes.iter().filter_map(|path| hull_of(path, radius)).collect();
        rest = rest.iter().flat_map(|piece| difference(piece, &along)).collect();
        let fine = Nm::from_f64(tip.to_f64() * FINE_STEP);
        let mut rims = loops(&insets(areas, rim), tolerance);
        rims.extend(fill(areas, axis, &rest, (rim + fine, fine, tip), tolerance));
        let room = Room::new(&insets(areas, rim - tolerance));
        Self { levels, strokes, rims, room, step: step.to_f64(), tolerance }
    }

    /// The end mill's part.
    #[must_use]
    pub fn clear(
        &self,
        label: impl Into<String>,
        mill: &Tool,
        heights: Heights,
        placement: &Placement,
    ) -> Section {
        let mut head = Head::new(heights, mill.plunge);
        for row in self.rows() {
            let row: Vec<Path> = row.iter().map(|path| placement.path(path)).collect();
            for depth in heights.passes() {
                clear_row(&mut head, &row, depth, mill);
            }
        }
        for stroke in &self.strokes {
            let stroke = placement.path(stroke);
            for depth in heights.passes() {
                head.over(stroke.start);
                head.plunge(depth);
                head.follow(&stroke, mill.feed);
            }
        }
        Section { tool: mill.clone(), label: label.into(), moves: head.finish() }
    }

    /// Loops that are milled without a retract: each begins where it is nearest to the one before.
    fn rows(&self) -> Vec<Vec<Path>> {
        let mut open: Vec<Vec<Option<Ring>>> =
            self.levels.iter().map(|level| level.iter().cloned().map(Some).collect()).collect();
        let mut rows = Vec::new();
        for level in (0..open.len()).rev() {
            for number in 0..open[level].len() {
                let Some(first) = open[level][number].take() else { continue };
                let mut row = vec![first];
                for outer in open[..level].iter_mut().rev() {
                    let is_first = row.len() == 1;
                    let last = row.last_mut().expect("it has a loop");
                    let Some(next) = self.next(last, is_first, outer) else { break };
                    row.push(next);
                }
                rows.push(row.iter().filter_map(|ring| self.path(ring)).collect());
            }
        }
        rows
    }

    /// The loop of the next level outwards that `last` leads to, begun where it is reached; `last`
    /// is made to end where it is left: where they are nearest, if it is the first of its row and
    /// may begin anywhere, else as soon after its beginning as the next one is near enough.
    fn next(&self, last: &mut Ring, is_first: bool, outer: &mut [Option<Ring>]) -> Option<Ring> {
        let most = REACH * self.step;
        let leads = outer.iter().enumerate().filter_map(|(i, ring)| {
            let ring = ring.as_ref()?;
            let (from, to, far) = if is_first { nearest(last, ring) } else { soonest(last, ring, most)? };
            (far <= most).then_some((i, from, to, far))
        });
        let late = |from: usize| if is_first { 0 } else { from };
        let (i, from, to, _) = leads.min_by(|a, b| late(a.1).cmp(&late(b.1)).then(a.3.total_cmp(&b.3)))?;
        if is_first {
            last.rotate_left(from);
        } else if from > 0 {
            // It begins where it was reached: after a full turn it goes on to where it is left.
            let tail: Vec<Point> = last[..=from].to_vec();
            last.extend(tail);
        }
        let mut next = outer[i].take()?;
        next.rotate_left(to);
        Some(next)
    }

    /// A ring, or one with a tail, as lines and arcs.
    fn path(&self, ring: &[Point]) -> Option<Path> {
        let has_tail = ring.iter().skip(1).any(|p| *p == ring[0]);
        let close = ring.first().filter(|_| !has_tail);
        fit_points(ring.iter().chain(close).copied(), self.tolerance)
    }
}

/// One row at a depth: down along the first loop, and round it once more; then outwards.
fn clear_row(head: &mut Head, row: &[Path], depth: Nm, mill: &Tool) {
    let Some(first) = row.first() else { return };
    head.over(first.start);
    head.plunge(Nm::ZERO);
    head.descend(first, depth, mill.feed);
    head.follow(first, mill.feed);
    for path in &row[1..] {
        head.reach(path.start, depth, mill.feed);
        head.follow(path, mill.feed);
    }
}

/// The contours of polygons as closed paths of lines and arcs.
fn loops(polygons: &[Polygon], tolerance: Nm) -> Vec<Path> {
    let rings = polygons.iter().flat_map(Polygon::contours);
    rings.filter_map(|ring| fit_points(ring.iter().chain(ring.first()).copied(), tolerance)).collect()
}

/// A polygon round what a mill clears along a path.
fn hull_of(path: &Path, radius: Nm) -> Option<Polygon> {
    let points = path.flatten(FLATTEN);
    let discs = points.windows(2).filter_map(|pair| {
        let ends = pair.iter().filter_map(|&end| Polygon::disc(end, radius, FLATTEN));
        Polygon::hull(ends.flat_map(|disc| disc.contours().concat()))
    });
    union(&discs.collect::<Vec<_>>()).into_iter().next()
}

/// The parts of the axis that an end mill follows where its loops leave something.
fn strokes(axis: &MedialAxis, reach: Nm, rest: &[Polygon], tolerance: Nm) -> Vec<Path> {
    let pieces = Pieces::new(rest);
    let is_left = |pair: &[Point]| dense_line(pair).into_iter().any(|p| pieces.hold(p));
    let parts = wide_parts(axis, reach.to_f64());
    parts.filter(|part| part.windows(2).any(is_left)).filter_map(|part| fit_points(part, tolerance)).collect()
}

/// The parts of the axis that are at least so far from the edges.
fn wide_parts(axis: &MedialAxis, least: f64) -> impl Iterator<Item = Vec<Point>> {
    let parts = axis.ways.iter().flat_map(move |way| way.wide_parts(least));
    let parts = parts.filter(|part| part.len() > 1);
    parts.map(|part| part.iter().map(|place| Point::from_f64(place.at.0, place.at.1)).collect())
}

/// Pieces to be asked what lies in them.
struct Pieces(Vec<Edges>);

impl Pieces {
    fn new(pieces: &[Polygon]) -> Self {
        Self(pieces.iter().map(Edges::new).collect())
    }

    fn hold(&self, p: Point) -> bool {
        let mut stack = Vec::new();
        self.0.iter().any(|piece| piece.winding(p, &mut stack) != Some(0))
    }
}

/// Ways of the V-bit over what is left of the floor, as far as they come within half a `tip` of it:
/// loops, `first` from the edges and then a `fine` step apart, and the axis between the last ones.
fn fill(
    areas: &[Interior<'_>],
    axis: &MedialAxis,
    rest: &[Polygon],
    (first, fine, tip): (Nm, Nm, Nm),
    tolerance: Nm,
) -> Vec<Path> {
    let pieces = rest.iter().filter(|piece| piece.area_mm2() > SPECK);
    let near: Vec<Polygon> = pieces.flat_map(|piece| offset(piece, tip / 2, FLATTEN)).collect();
    if near.is_empty() {
        return Vec::new();
    }
    let near = Pieces::new(&near);
    let mut found: Vec<Vec<Point>> = Vec::new();
    let mut empty = 0;
    for count in 0..MOST_LOOPS {
        let level = insets(areas, first + fine * count);
        let parts = level.iter().flat_map(Polygon::contours).flat_map(|ring| runs(ring, true, &near));
        let before = found.len();
        found.extend(parts);
        // Farther in nothing is left: what is, lies in corners.
        empty = if found.len() == before { empty + 1 } else { 0 };
        if level.is_empty() || empty > EMPTY {
            break;
        }
    }
    let along = wide_parts(axis, (first - fine).to_f64());
    found.extend(along.flat_map(|part| runs(&part, false, &near)));
    found.into_iter().filter_map(|run| fit_points(run, tolerance)).collect()
}

/// Less is left to nobody, in mm². Chosen.
const SPECK: f64 = 1e-6;

/// Loops at most, and how many in a row may find nothing before it is over. Chosen: far more than
/// floors have.
const MOST_LOOPS: i64 = 400;
const EMPTY: i64 = 40;

/// The parts of a line or, closed, a ring that lie in pieces.
fn runs(line: &[Point], closed: bool, pieces: &Pieces) -> Vec<Vec<Point>> {
    let mut dense = if closed { dense(line) } else { dense_line(line) };
    let inside: Vec<bool> = dense.iter().map(|&p| pieces.hold(p)).collect();
    let mut start = 0;
    if closed {
        let Some(outside) = inside.iter().position(|inside| !inside) else {
            dense.extend(dense.first().copied());
            return vec![dense];
        };
        start = outside;
        dense.rotate_left(start);
    }
    // With a place on either side, which is as good a place of the line.
    let mut runs: Vec<Vec<Point>> = Vec::new();
    let mut before: Option<(Point, bool)> = None;
    let flags = inside.iter().cycle().skip(start);
    for (&p, &inside) in dense.iter().zip(flags) {
        match (before, inside) {
            (Some((_, true)), _) => runs.last_mut().expect("one was begun").push(p),
            (Some((last, false)), true) => runs.push(vec![last, p]),
            (None, true) => runs.push(vec![p]),
            (Some((_, false)) | None, false) => {}
        }
        before = Some((p, inside));
    }
    runs.retain(|run| run.len() > 1);
    runs
}

/// So far apart places of a loop are looked at, in nanometres. Chosen.
const DENSE: f64 = 50_000.0;

/// A ring with corners no farther apart than [`DENSE`].
fn dense(ring: &[Point]) -> Ring {
    let closed: Vec<Point> = ring.iter().chain(ring.first()).copied().collect();
    let mut dense = dense_line(&closed);
    dense.pop();
    dense
}

/// The same for a line from its first point to its last.
fn dense_line(line: &[Point]) -> Vec<Point> {
    let mut dense = Vec::new();
    for pair in line.windows(2) {
        let ((ax, ay), (bx, by)) = (pair[0].to_f64(), pair[1].to_f64());
        let count = (pair[0].distance(pair[1]) / DENSE).ceil().max(1.0);
        let mut place = 0.0;
        while place < count {
            let t = place / count;
            dense.push(Point::from_f64(ax + (bx - ax) * t, ay + (by - ay) * t));
            place += 1.0;
        }
    }
    dense.extend(line.last());
    dense
}

/// The first corner of a ring that is no farther than `most` from another, with the corner of that
/// which is nearest to it, and how far apart they are.
fn soonest(one: &[Point], other: &[Point], most: f64) -> Option<(usize, usize, f64)> {
    let mut leads = one.iter().enumerate().map(|(from, p)| {
        let (_, to, far) = nearest(slice::from_ref(p), other);
        (from, to, far)
    });
    leads.find(|&(_, _, far)| far <= most)
}

/// Corners of two rings that are nearest to each other, and how far apart they are.
fn nearest(one: &[Point], other: &[Point]) -> (usize, usize, f64) {
    let mut best = (0, 0, f64::INFINITY);
    for (i, &p) in one.iter().enumerate() {
        for (j, &q) in other.iter().enumerate() {
            let far = (q - p).length_squared();
            let far = Nm::new(far).to_f64();
            if far < best.2 {
                best = (i, j, far);
            }
        }
    }
    (best.0, best.1, best.2.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::voronoi::medial::{Interior, Pruning};

    #[test]
    fn the_end_mill_goes_round_each_loop_once() {
        let at = |(x, y): (i64, i64)| Point::new(Nm::from_mm(x), Nm::from_mm(y));
        let corners = [(0, 0), (41, 3), (37, 19), (16, 14), (11, 38), (2, 33)].map(at);
        let area = [Polygon::new(vec![corners.to_vec()]).expect("an area")];
        let areas = Interior::all(&area);
        let axis = MedialAxis::new(&areas, &Pruning { loss: 1.0, corner: 1.0 });
        let [v_bit, mill]: [Tool; 2] =
            ["vbit:0.2mm:60deg", "endmill:2mm"].map(|tool| tool.parse().expect("a tool"));
        let floor = Floor::new(&areas, &axis, &v_bit, Nm::from_mm(1), &mill, Nm::from_um(2));
        let around = |ring: &Ring| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(a, b)| a.distance(*b)).sum::<f64>()
        };
        let loops: f64 = floor.levels.iter().flatten().map(around).sum();
        let milled: f64 = floor.rows().iter().flatten().map(Path::length).sum();
        assert!(floor.levels.len() > 5, "{} levels", floor.levels.len());
        assert!((0.99..1.05).contains(&(milled / loops)), "{milled} nm along loops of {loops} nm");
    }
}
