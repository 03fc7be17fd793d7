//! Wide places: a flat floor, which an end mill clears and of which the V-bit cuts the walls and
//! what the end mill does not reach. Without an end mill it cuts the walls alone.
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
//! way from one of its lines to the next leads over a floor that was cleared.

use std::ops::ControlFlow;
use std::slice;

use rayon::prelude::*;

use crate::board::FLATTEN;
use crate::board::polarity::{difference, offset, union};
use crate::geometry::{Edges, Nm, Path, Point, Polygon, Rect, RectIndex};
use crate::toolpath::head::Head;
use crate::toolpath::{Heights, Placement, Section, Tool, ToolKind};
use crate::voronoi::fit_points;
use crate::voronoi::medial::{Interior, MedialAxis, insets};

use super::room::Room;
use super::rows::{Ring, rows};

/// What of the end mill's radius two loops are apart. Chosen: loops that turn by up to 130° leave
/// nothing between them.
const STEP: f64 = 0.8;

/// What of the tip's width two loops of the V-bit are apart where it clears. Chosen: an overlap of
/// 15 %.
const FINE_STEP: f64 = 0.85;

/// Links between loops are at most so many steps long: a longer one would leave what is wide
/// enough. Chosen: one, and rounding.
const REACH: f64 = 1.02;

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
    /// Whether it is cleared, so that a way over it cuts nothing.
    pub(super) is_cleared: bool,
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
        let walls = Self::walls(areas, v_bit, depth, tolerance);
        let tolerance = walls.tolerance;
        // Where the floor begins, and how far from the edges either tool goes.
        let rim = v_bit.width_at(depth) / 2;
        let (radius, edge) = (diameter / 2, rim - tip / 2);
        let step = Nm::from_f64(radius.to_f64() * STEP);
        // A loop of some nanometres is no way, and clears nothing.
        let is_milled =
            |area: &Polygon| loops(slice::from_ref(area), tolerance).len() == area.contours().len();
        let level = |count: i64| {
            let inside = edge + radius + step * count;
            let level: Vec<Polygon> = insets(areas, inside).into_iter().filter(is_milled).collect();
            // What a mill clears along their edges.
            let within = insets(areas, inside + radius);
            let grown = level.iter().flat_map(|polygon| offset(polygon, radius, FLATTEN));
            let cleared: Vec<Polygon> = grown.flat_map(|outer| difference(&outer, &within)).collect();
            let rings: Vec<Ring> = level.iter().flat_map(Polygon::contours).map(|ring| dense(ring)).collect();
            (rings, cleared)
        };
        let deepest = (Nm::from_f64(axis.widest()) - edge - radius).get() / step.get();
        let found: Vec<(Vec<Ring>, Vec<Polygon>)> = (0..=deepest).into_par_iter().map(level).collect();
        let (mut levels, cleared): (Vec<Vec<Ring>>, Vec<Vec<Polygon>>) = found.into_iter().unzip();
        levels.truncate(levels.iter().position(Vec::is_empty).unwrap_or(levels.len()));
        let cleared = union(&cleared.concat());
        let mut rest: Vec<Polygon> =
            insets(areas, edge).iter().flat_map(|floor| difference(floor, &cleared)).collect();
        let strokes = strokes(axis, edge + radius, &rest, tolerance);
        let along: Vec<Polygon> = strokes.iter().filter_map(|path| hull_of(path, radius)).collect();
        rest = rest.iter().flat_map(|piece| difference(piece, &along)).collect();
        let fine = Nm::from_f64(tip.to_f64() * FINE_STEP);
        let mut rims = walls.rims;
        rims.extend(fill(areas, axis, &rest, (rim + fine, fine, tip), tolerance));
        Self { levels, strokes, rims, step: step.to_f64(), is_cleared: true, ..walls }
    }

    /// What is to be done where nothing clears what is wide: the V-bit cuts the walls.
    #[must_use]
    pub fn walls(areas: &[Interior<'_>], v_bit: &Tool, depth: Nm, tolerance: Nm) -> Self {
        // Along a wall what is off sideways is off by more in depth.
        let tolerance = Nm::from_f64(tolerance.to_f64() * v_bit.kind.flank().min(1.0));
        let rim = v_bit.width_at(depth) / 2;
        let rims = loops(&insets(areas, rim), tolerance);
        let room = Room::new(&insets(areas, rim - tolerance));
        Self { rims, room, tolerance, ..Self::default() }
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

    /// Loops that are milled without a retract.
    fn rows(&self) -> Vec<Vec<Path>> {
        let rows = rows(&self.levels, Nm::from_f64(REACH * self.step));
        let paths = |row: &Vec<Ring>| row.iter().filter_map(|ring| self.path(ring)).collect();
        rows.iter().map(paths).collect()
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

/// Pieces to be asked what lies in them, by place.
struct Pieces {
    pieces: Vec<Edges>,
    index: RectIndex,
}

impl Pieces {
    fn new(pieces: &[Polygon]) -> Self {
        let index = RectIndex::new(pieces.iter().map(Polygon::bounds));
        Self { pieces: pieces.iter().map(Edges::new).collect(), index }
    }

    fn hold(&self, p: Point) -> bool {
        let holds = |piece: usize| match self.pieces[piece].winding(p) {
            Some(0) => ControlFlow::Continue(()),
            None | Some(_) => ControlFlow::Break(()),
        };
        self.index.visit(Rect::new(p, p), holds).is_break()
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
