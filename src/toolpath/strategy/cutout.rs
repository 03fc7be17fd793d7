//! Cutout: round the board outside its edge, in passes, with tabs that hold it until the end.
//!
//! The way of the cutter's middle is the outline offset by half its width, by exact polygons: outwards round a board,
//! inwards in a cut-out. Cut-outs go first, while the board is still held all round. Each contour is cut in passes without a lift;
//! below a tab's top the cutter climbs over the tabs, which are spread evenly and moved off corners, where they
//! would be hard to file away.

use crate::board::{Outline, Warning, polarity};
use crate::geometry::{Nm, Path, Point, Polygon, Vector};
use crate::toolpath::head::Head;
use crate::toolpath::order::{Order, Stretch, arrange};
use crate::toolpath::{Heights, Placement, Position, Section, Tool};

/// What holds the board while it is cut out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tabs {
    /// How many on each contour; none for a board that is held otherwise.
    pub count: u32,
    /// How wide each stays.
    pub width: Nm,
    /// How thick each stays, from the bottom of the cut upwards.
    pub height: Nm,
}

/// How the board is cut out.
#[derive(Clone, Copy, Debug)]
pub struct Cutout<'a> {
    /// The cutter.
    pub tool: &'a Tool,
    /// How high and how deep, and how much a pass takes.
    pub heights: Heights,
    /// From board to machine.
    pub placement: &'a Placement,
    /// What holds the board.
    pub tabs: Tabs,
}

/// How far the cutter's way may leave the offset curve: a tenth of what mills of this kind repeat to. Chosen.
const TOLERANCE: Nm = Nm::from_um(2);

/// Cuts along every contour of `outline`, half the cutter's width outside the board; cut-outs first.
///
/// Warned about: `cut-out-narrower-than-tool` where the cutter does not fit into a cut-out, `no-place-for-tabs`
/// where a contour is too short for them.
pub fn cutout(outline: &Outline, settings: &Cutout<'_>) -> (Section, Vec<Warning>) {
    let radius = settings.tool.width_at(settings.heights.cut) / 2;
    let board = outline.polygon(TOLERANCE);
    let mut warnings = Vec::new();
    let (mut inner, mut outer) = (Vec::new(), Vec::new());
    for polygon in polarity::offset(&board, radius, TOLERANCE) {
        for ring in polygon.contours() {
            let boards = Polygon::new(vec![ring.clone()]).is_some_and(|ring| ring.area_mm2() > 0.0);
            if boards { &mut outer } else { &mut inner }.push(ring.clone());
        }
    }
    let (wanted, count) = (board.contours().len(), inner.len() + outer.len());
    if count < wanted {
        let message = format!(
            "the cutter of {:.3} mm does not fit into {} of {wanted} contours of the outline: they are left",
            radius * 2,
            wanted - count
        );
        warnings.push(Warning::new("cut-out-narrower-than-tool", message));
    }
    let mut head = Head::new(settings.heights, settings.tool.plunge);
    for rings in [inner, outer] {
        warnings.extend(rings.iter().filter_map(|ring| cramped(ring, settings)));
        cut_all(&mut head, &rings, settings);
    }
    let label = format!("cut out along {count} {}", if count == 1 { "contour" } else { "contours" });
    (Section { tool: settings.tool.clone(), label, moves: head.finish() }, warnings)
}

/// Contours of one kind, in an order of short travel.
fn cut_all(head: &mut Head, rings: &[Vec<Point>], settings: &Cutout<'_>) {
    let rings: Vec<Ring> = rings.iter().map(|ring| Ring::placed(ring, settings.placement)).collect();
    let ends =
        |ring: &Ring| Stretch { from: ring.points[0], to: ring.points[0], entries: ring.points.clone() };
    let stretches: Vec<Stretch> = rings.iter().map(ends).collect();
    let start = head.at().map_or(Point::default(), Position::point);
    for leg in arrange(&stretches, start, Order::Improved) {
        let ring = rings[leg.stretch].begun_at(leg.entry.unwrap_or(0));
        cut_ring(head, &ring, settings);
    }
}

/// One contour in all its passes.
fn cut_ring(head: &mut Head, ring: &Ring, settings: &Cutout<'_>) {
    let opening = settings.tabs.width + settings.tool.width_at(settings.heights.cut);
    let tabs = ring.tabs(settings.tabs.count, opening.to_f64());
    let top = settings.heights.cut - settings.tabs.height;
    let feed = settings.tool.feed;
    head.over(ring.points[0]);
    for depth in settings.heights.passes() {
        head.plunge(depth);
        if depth <= top || tabs.is_empty() {
            head.follow(&ring.path(), feed);
            continue;
        }
        for (piece, tab) in ring.pieces(&tabs) {
            let at = head.at().expect("the head is on the contour");
            let z = if tab { -top } else { -depth };
            let speed = if z > at.z { feed } else { settings.tool.plunge };
            head.feed_to(Position { z, ..at }, speed);
            piece.into_iter().for_each(|p| head.feed_to(Position::over(p, z), feed));
        }
        let at = head.at().expect("the head is on the contour");
        head.feed_to(Position { z: -depth, ..at }, settings.tool.plunge);
    }
    head.lift();
}

/// The warning for a contour on which the tabs have no place.
fn cramped(ring: &[Point], settings: &Cutout<'_>) -> Option<Warning> {
    let opening = settings.tabs.width + settings.tool.width_at(settings.heights.cut);
    let found = Ring::placed(ring, &Placement::default()).tabs(settings.tabs.count, opening.to_f64()).len();
    (found < settings.tabs.count as usize).then(|| {
        let message = format!("only {found} of {} tabs find a place on a contour", settings.tabs.count);
        Warning::new("no-place-for-tabs", message).at(ring[0])
    })
}

/// A closed way of straight lines; the first point is not repeated.
struct Ring {
    points: Vec<Point>,
}

/// A stretch of a ring, by the distances along it at which it begins and ends, the first before the second.
type Span = (f64, f64);

impl Ring {
    fn placed(points: &[Point], placement: &Placement) -> Self {
        Self { points: points.iter().map(|&p| placement.point(p)).collect() }
    }

    fn begun_at(&self, entry: usize) -> Self {
        let mut points = self.points.clone();
        points.rotate_left(entry);
        Self { points }
    }

    fn path(&self) -> Path {
        let points = self.points.iter().chain(&self.points[..1]);
        Path::polyline(points.copied()).expect("a ring has three points")
    }

    /// The distance along the ring of each point, then its whole length.
    fn distances(&self) -> Vec<f64> {
        let mut sum = 0.0;
        let ends = self.points.iter().zip(self.points.iter().cycle().skip(1)).map(|(a, b)| {
            sum += a.distance(*b);
            sum
        });
        std::iter::once(0.0).chain(ends).collect()
    }

    /// Where the tabs are, in order: evenly spread, then moved to the nearest place that is straight, each `opening` wide; fewer than
    /// `count` where they would touch.
    fn tabs(&self, count: u32, opening: f64) -> Vec<Span> {
        let distances = self.distances();
        let length = distances[self.points.len()];
        if count == 0 || length < f64::from(count) * opening * 2.0 {
            return Vec::new();
        }
        let bends = self.bends(&distances);
        let share = length / f64::from(count);
        let mut tabs: Vec<Span> = Vec::new();
        for index in 0..count {
            let even = share * (f64::from(index) + 0.5);
            let middle = straightest(even, share, opening, length, &bends);
            let tab = (middle - opening / 2.0, middle + opening / 2.0);
            let clear = tabs.last().is_none_or(|last| last.1 + opening < tab.0);
            if clear && tab.0 > 0.0 && tab.1 < length {
                tabs.push(tab);
            }
        }
        tabs
    }

    /// How far the way turns at each point, in radians, with its distance.
    fn bends(&self, distances: &[f64]) -> Vec<(f64, f64)> {
        let count = self.points.len();
        let turn = |i: usize| {
            let [a, b, c] = [(i + count - 1) % count, i, (i + 1) % count].map(|i| self.points[i]);
            let (into, out) = (b - a, c - b);
            // Atan2 of numbers in nm² needs no more than their ratio.
            libm::atan2(exact(into.cross(out)), exact(into.dot(out))).abs()
        };
        (0..count).map(|i| (distances[i], turn(i))).collect()
    }

    /// The ring from its first point round, cut where tabs begin and end: the points of each piece after its start,
    /// and whether it is a tab.
    fn pieces(&self, tabs: &[Span]) -> Vec<(Vec<Point>, bool)> {
        let distances = self.distances();
        let length = distances[self.points.len()];
        let mut cuts: Vec<(f64, bool)> =
            tabs.iter().flat_map(|tab| [(tab.0, false), (tab.1, true)]).collect();
        cuts.push((length, false));
        let mut from = 0.0;
        let mut pieces = Vec::with_capacity(cuts.len());
        for (to, tab) in cuts {
            let inside = (1..self.points.len()).filter(|&i| distances[i] > from && distances[i] < to);
            let mut points: Vec<Point> = inside.map(|i| self.points[i]).collect();
            points.push(if to < length { self.at(to, &distances) } else { self.points[0] });
            pieces.push((points, tab));
            from = to;
        }
        pieces
    }

    /// The point at this distance along the ring.
    fn at(&self, distance: f64, distances: &[f64]) -> Point {
        let i = distances.partition_point(|&before| before <= distance).clamp(1, self.points.len()) - 1;
        let (a, b) = (self.points[i], self.points[(i + 1) % self.points.len()]);
        let fraction = (distance - distances[i]) / (distances[i + 1] - distances[i]).max(1.0);
        let way = b - a;
        a + Vector::new(Nm::from_f64(way.x.to_f64() * fraction), Nm::from_f64(way.y.to_f64() * fraction))
    }
}

/// A product of differences as a float; its last bits do not matter to an angle.
#[expect(clippy::cast_precision_loss, reason = "an angle needs no more than 53 bits")]
const fn exact(product: i64) -> f64 {
    product as f64
}

/// How far the way may turn within a tab and half its width to both sides: about 20°. Chosen.
const STRAIGHT: f64 = 0.35;

/// The place nearest to `even`, within 40 % of a share, around which the way turns by less than [`STRAIGHT`]; the
/// straightest of those looked at where there is none.
fn straightest(even: f64, share: f64, opening: f64, length: f64, bends: &[(f64, f64)]) -> f64 {
    let turning = |middle: f64| -> f64 {
        let apart = |at: f64| {
            let direct = (at - middle).abs();
            direct.min(length - direct)
        };
        bends.iter().filter(|bend| apart(bend.0) <= opening).map(|bend| bend.1).sum()
    };
    let tries = (0..=40).flat_map(|step| {
        let off = share * 0.01 * f64::from(step);
        [even + off, even - off]
    });
    let mut best = (f64::INFINITY, even);
    for middle in tries {
        let turn = turning(middle);
        if turn < STRAIGHT {
            return middle;
        }
        if turn < best.0 {
            best = (turn, middle);
        }
    }
    best.1
}
