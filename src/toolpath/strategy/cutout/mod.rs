//! Cutout: round the board outside its edge, in passes, with tabs that hold it until the end.
//!
//! The way of the cutter's middle is the outline offset by half its width, by exact polygons and in
//! lines and arcs again: outwards round a board, inwards in a cut-out. Cut-outs go first, while the
//! board is still held all round. Each contour is cut in passes without a retract, the next one
//! begun by a plunge or down a ramp; below a tab's top the cutter climbs over the tabs, which are
//! spread evenly and kept off corners, where they would be hard to file away. Of a cutter that
//! cannot plunge every way down is a ramp, behind each tab, too.

mod boards;
mod ramp;
mod ring;
mod tabs;

use crate::board::diagnostic::{count, planning};
use crate::board::{FLATTEN, Hole, Outline, Warning, polarity};
use crate::geometry::{Nm, Path, Point, Polygon, RectIndex};
use crate::toolpath::head::Head;
use crate::toolpath::order::{self, Order, arrange};
use crate::toolpath::{Angle, Direction, Heights, Placement, Position, Section, Tool};
use crate::voronoi;

use boards::Stretches;
use ring::Ring;
pub use tabs::{TabPlaces, Tabs};

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
    pub tabs: Tabs<'a>,
    /// How steeply the cutter goes down along the contour wherever it goes down into the board;
    /// none for straight down.
    pub ramp: Option<Angle>,
    /// Which way round; none for either.
    pub direction: Option<Direction>,
    /// The holes that are drilled: cut-outs that are such holes, too, are left to the drill.
    pub drilled: &'a [Hole],
}

/// How far the cutter's way may leave the offset curve: a fifth of what mills of this kind repeat
/// to. Chosen.
const TOLERANCE: Nm = Nm::from_um(4);

/// Cuts along every contour of `outline`, half the cutter's width outside the board; cut-outs
/// first. Cut-outs that are drilled are left out.
///
/// Warned about: `cut-out-narrower-than-tool` where the cutter does not fit into a cut-out or round
/// a board, `boards-closer-than-tool` where it does not fit between two, `no-place-for-tabs` where
/// a contour round a board is too short for them, `tab-off-the-outline` where one is wanted far
/// from any contour.
pub fn cutout(outline: &Outline, settings: &Cutout<'_>) -> (Section, Vec<Warning>) {
    let radius = settings.tool.width_at(settings.heights.cut) / 2;
    let board = without_drilled(&outline.polygon(FLATTEN), settings.drilled);
    let mut warnings = Vec::new();
    let (mut inner, mut outer) = (Vec::new(), Vec::new());
    // Contours of a polygon have it on their left, those of its holes too.
    let turned = |direction: Direction| direction.reverses(true, settings.placement.mirror.is_some());
    let is_turned = settings.direction.is_some_and(turned);
    for polygon in polarity::offset(&board, radius, FLATTEN) {
        for contour in polygon.contours() {
            let boards = Polygon::new(vec![contour.clone()]).is_some_and(|ring| ring.area_mm2() > 0.0);
            let closed = contour.iter().chain(contour.first()).copied();
            let way = voronoi::fit_points(closed, TOLERANCE).filter(Path::is_closed);
            let way = way.map(|way| if is_turned { way.reversed() } else { way });
            if boards { &mut outer } else { &mut inner }.extend(way.map(Ring::new));
        }
    }
    let (edges, holes): (Vec<Polygon>, Vec<Polygon>) = board
        .contours()
        .iter()
        .filter_map(|contour| Polygon::new(vec![contour.clone()]))
        .partition(|ring| ring.area_mm2() > 0.0);
    let stretches = boards::stretches(&outer, &edges, radius);
    warn([&inner, &outer], &stretches, [&edges, &holes], radius, &mut warnings);
    let held = hold(&inner, &outer, &stretches, settings, &mut warnings);
    let mut head = Head::new(settings.heights, settings.tool.plunge);
    let (inner_held, outer_held) = held.split_at(inner.len());
    cut_all(&mut head, &inner, inner_held, settings);
    cut_all(&mut head, &outer, outer_held, settings);
    let label = format!("cut out along {}", count(inner.len() + outer.len(), "contour"));
    (Section { tool: settings.tool.clone(), label, moves: head.finish() }, warnings)
}

/// A board without the cut-outs that `holes` reach all round: EAGLE and others draw mounting holes
/// as both. One that another board lies in is milled along all the same.
fn without_drilled(board: &Polygon, holes: &[Hole]) -> Polygon {
    /// What the drill may leave of such a cut-out. Chosen: what cheap machines repeat to.
    const RIM: Nm = Nm::from_um(20);
    let index = RectIndex::new(holes.iter().map(Hole::bounds));
    let is_drilled = |contour: &&Vec<Point>| {
        let ring = Polygon::new(vec![(*contour).clone()]).filter(|ring| ring.area_mm2() < 0.0);
        let Some(ring) = ring else { return false };
        let reaches = |hole: usize| holes[hole].reaches_all(contour, RIM);
        let holds = |other: &Vec<Point>| !std::ptr::eq(other, *contour) && ring.contains(other[0]);
        index.touching(ring.bounds()).into_iter().any(reaches) && !board.contours().iter().any(holds)
    };
    let kept = board.contours().iter().filter(|contour| !is_drilled(contour));
    Polygon::new(kept.cloned().collect()).unwrap_or_else(|| board.clone())
}

/// Tells where the cutter does not fit round `edges` of boards, between them, or into `holes`.
fn warn(
    [inner, outer]: [&[Ring]; 2],
    stretches: &[Stretches],
    [edges, holes]: [&[Polygon]; 2],
    radius: Nm,
    warnings: &mut Vec<Warning>,
) {
    let holds = |hole: &Polygon, p: Point| hole.bounds().contains(p) && hole.contains(p);
    let is_empty = |hole: &&Polygon| !inner.iter().any(|way| holds(hole, way.path().start));
    let narrow: Vec<&Polygon> = holes.iter().filter(is_empty).collect();
    let rounded: usize = stretches.iter().map(Vec::len).sum();
    let missing = narrow.len() + edges.len().saturating_sub(rounded);
    if missing > 0 {
        let message = format!(
            "the cutter of {:.3} mm does not fit into {missing} of {} contours of the outline: they are not cut",
            radius * 2,
            edges.len() + holes.len(),
        );
        let warning = planning::CUT_OUT_NARROWER_THAN_TOOL.warning(message);
        warnings.push(match narrow.first() {
            Some(hole) => warning.at(hole.bounds().min().midpoint(hole.bounds().max())),
            None => warning,
        });
    }
    let joined = || outer.iter().zip(stretches).filter(|(_, boards)| boards.len() > 1);
    if let Some((way, boards)) = joined().next() {
        let message = format!(
            "{} boards are closer to others than the cutter of {:.3} mm: it goes round them together",
            joined().map(|(_, boards)| boards.len()).sum::<usize>(),
            radius * 2
        );
        warnings.push(planning::BOARDS_CLOSER_THAN_TOOL.warning(message).at(way.at(boards[1][0])));
    }
}

/// How wide the way over a tab is: the tab, and half a cutter on both sides.
fn opening(settings: &Cutout<'_>) -> f64 {
    (settings.tabs.width + settings.tool.width_at(settings.heights.cut)).to_f64()
}

/// The middles of the tabs of each contour, those of `inner` first.
fn hold(
    inner: &[Ring],
    outer: &[Ring],
    stretches: &[Stretches],
    settings: &Cutout<'_>,
    warnings: &mut Vec<Warning>,
) -> Vec<Vec<f64>> {
    if let TabPlaces::At(places) = settings.tabs.places {
        let rings: Vec<&Ring> = inner.iter().chain(outer).collect();
        return at_places(&rings, places, settings, warnings);
    }
    let opening = opening(settings);
    let small = inner.iter().map(|ring| {
        // What falls out of a small cut-out needs no holding.
        let own: Vec<f64> = tabs::places(ring).collect();
        let count = wanted(ring.length(), settings).min(tabs::room(ring.length(), 2.0 * opening));
        tabs::spread(ring, &own, if count < 2 { 0 } else { count }, opening)
    });
    let mut held: Vec<Vec<f64>> = small.collect();
    for (ring, boards) in outer.iter().zip(stretches) {
        let mut all = Vec::new();
        for own in boards {
            let length = tabs::length(ring, own);
            let wanted = wanted(length, settings);
            let found = tabs::spread(ring, own, wanted.min(tabs::room(length, opening)), opening);
            if found.len() < wanted as usize {
                let message = format!("only {} of {wanted} tabs fit on a contour", found.len());
                warnings.push(planning::NO_PLACE_FOR_TABS.warning(message).at(ring.at(own[0])));
            }
            all.extend(found);
        }
        all.sort_by(f64::total_cmp);
        held.push(all);
    }
    held
}

/// How many tabs a contour of a length is to have.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
fn wanted(length: f64, settings: &Cutout<'_>) -> u32 {
    match settings.tabs.places {
        TabPlaces::Count(count) => count,
        TabPlaces::Spacing(apart) => (length / apart.to_f64().max(1.0)).ceil() as u32,
        TabPlaces::At(places) => u32::try_from(places.len()).unwrap_or(u32::MAX),
    }
}

/// How far from a contour a tab may be asked for, beside half the cutter. Chosen: nobody clicks a
/// place more exactly.
const NEAR: Nm = Nm::from_mm(2);

/// Each tab on the contour nearest to where it is wanted.
fn at_places(
    rings: &[&Ring],
    places: &[Point],
    settings: &Cutout<'_>,
    warnings: &mut Vec<Warning>,
) -> Vec<Vec<f64>> {
    let mut held = vec![Vec::new(); rings.len()];
    let width = settings.tool.width_at(settings.heights.cut);
    let radius = width / 2;
    // Between two tabs there is room for a ramp.
    let least = opening(settings) + if settings.ramp.is_some() { width.to_f64() } else { 0.0 };
    for &place in places {
        let measured = rings.iter().enumerate().map(|(index, ring)| (ring.nearest(place), index));
        let Some(((off, along), index)) = measured.min_by(|a, b| a.0.0.total_cmp(&b.0.0)) else { continue };
        let apart = |other: &f64| tabs::apart(*other, along, rings[index].length());
        let next = held[index].iter().map(apart).min_by(f64::total_cmp);
        let taken = next.filter(|next| *next < least);
        if off > (radius + NEAR).to_f64() {
            let message = format!("a tab is requested {:.1} mm off any contour, and left out", off / 1e6);
            warnings.push(planning::TAB_OFF_THE_OUTLINE.warning(message).at(place));
        } else if let Some(next) = taken {
            let message = format!(
                "a tab is requested {:.1} mm from another, where {:.1} mm are needed, and left out",
                next / 1e6,
                least / 1e6
            );
            warnings.push(planning::NO_PLACE_FOR_TABS.warning(message).at(place));
        } else {
            held[index].push(along);
        }
    }
    held.iter_mut().for_each(|held| held.sort_by(f64::total_cmp));
    held
}

/// Contours of one kind with the middles of their tabs, in an order of short travel.
fn cut_all(head: &mut Head, rings: &[Ring], held: &[Vec<f64>], settings: &Cutout<'_>) {
    let placed: Vec<Ring> =
        rings.iter().map(|ring| Ring::new(settings.placement.path(ring.path()))).collect();
    let starts: Vec<Vec<f64>> =
        rings.iter().zip(held).map(|(ring, held)| entries(ring, held, settings)).collect();
    let stretch = |(ring, starts): (&Ring, &Vec<f64>)| {
        let entries: Vec<Point> = starts.iter().map(|&start| ring.at(start)).collect();
        order::Stretch { from: entries[0], to: entries[0], entries }
    };
    let stretches: Vec<order::Stretch> = placed.iter().zip(&starts).map(stretch).collect();
    let start = head.at().map_or(Point::default(), Position::point);
    for leg in arrange(&stretches, start, Order::Improved, 0.0) {
        let (ring, length) = (&placed[leg.stretch], placed[leg.stretch].length());
        let from = starts[leg.stretch][leg.entry.unwrap_or(0)];
        let mut middles: Vec<f64> =
            held[leg.stretch].iter().map(|middle| (middle - from).rem_euclid(length)).collect();
        middles.sort_by(f64::total_cmp);
        cut_ring(head, &ring.begun_at(from), &middles, settings);
    }
}

/// Where a contour may be begun: anywhere but on a tab.
fn entries(ring: &Ring, held: &[f64], settings: &Cutout<'_>) -> Vec<f64> {
    /// Beside the corners, for contours that have none to begin at. Chosen.
    const BETWEEN: u32 = 32;
    let even = (0..BETWEEN).map(|share| ring.length() * f64::from(share) / f64::from(BETWEEN));
    let from_tab = |start: f64| {
        let apart = held.iter().map(|middle| tabs::apart(start, *middle, ring.length()));
        apart.fold(f64::INFINITY, f64::min)
    };
    let places: Vec<f64> = ring.corners().chain(even).collect();
    let at_least = |least: f64| places.iter().copied().filter(|&p| from_tab(p) > least).collect::<Vec<_>>();
    // A ramp needs room.
    let opening = opening(settings);
    let roomy = settings.ramp.map_or_else(Vec::new, |_| at_least(opening));
    let found = if roomy.is_empty() { at_least(opening / 2.0) } else { roomy };
    if found.is_empty() { vec![0.0] } else { found }
}

/// One contour in all its passes, from its start.
fn cut_ring(head: &mut Head, ring: &Ring, middles: &[f64], settings: &Cutout<'_>) {
    head.over(ring.path().start);
    if let Some(angle) = settings.ramp {
        ramp::cut(head, ring, middles, angle, settings);
    } else {
        for depth in settings.heights.passes() {
            head.plunge(depth);
            let tabs = if depth > settings.tabs.top { middles } else { &[] };
            for stretch in stretched(ring, tabs, settings) {
                go_to(head, if stretch.is_tab { settings.tabs.top } else { depth }, settings);
                head.follow(&ring.between(stretch.from, stretch.to), settings.tool.feed);
            }
        }
    }
    head.retract();
}

/// Straight up or down where the head is: up as fast as it cuts, down as fast as it plunges.
fn go_to(head: &mut Head, depth: Nm, settings: &Cutout<'_>) {
    let at = head.at().expect("the head is on the contour");
    let speed = if -depth > at.z { settings.tool.feed } else { settings.tool.plunge };
    head.feed_to(Position { z: -depth, ..at }, speed);
}

/// A part of a contour: over a tab, or between two.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: f64,
    to: f64,
    is_tab: bool,
}

/// A contour from its start round to it, in parts, tabs having these `middles`.
fn stretched(ring: &Ring, middles: &[f64], settings: &Cutout<'_>) -> Vec<Stretch> {
    let half = opening(settings) / 2.0;
    let spans: Vec<(f64, f64)> = middles.iter().map(|middle| (middle - half, middle + half)).collect();
    let mut knots: Vec<f64> = spans.iter().flat_map(|span| [span.0, span.1]).collect();
    knots.retain(|&knot| knot > 0.0 && knot < ring.length());
    knots.push(ring.length());
    knots.sort_by(f64::total_cmp);
    let mut from = 0.0;
    let mut stretches = Vec::with_capacity(knots.len());
    for to in knots {
        if to - from < 1.0 {
            continue;
        }
        let middle = f64::midpoint(from, to);
        let is_tab = spans.iter().any(|span| span.0 < middle && middle < span.1);
        stretches.push(Stretch { from, to, is_tab });
        from = to;
    }
    stretches
}
