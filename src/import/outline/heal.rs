//! Ends that do not meet: near ones are joined, lonely ones are left out.

use std::collections::BTreeMap;
use std::iter::successors;

use rustc_hash::FxHashSet;

use super::edge::Edge;
use super::notes::Notes;
use crate::geometry::{Nm, Point, Rect, RectIndex};

/// What an end that lies this near to another is not even worth mentioning: the rounding of a
/// file's last digit.
const ROUNDING: Nm = Nm::from_um(3);

/// What ends at a point.
#[derive(Clone, Copy, Debug, Default)]
struct End {
    /// How many edges, one with both its ends there twice.
    count: u32,
    /// The last of them.
    edge: usize,
}

/// The ends of `edges` with the edge of each, sorted: those that meet stand together.
pub(super) fn meeting(edges: &[Edge]) -> Vec<(Point, usize)> {
    let both = |(index, edge): (usize, &Edge)| [(edge.from, index), (edge.to, index)];
    let mut meeting: Vec<(Point, usize)> = edges.iter().enumerate().flat_map(both).collect();
    meeting.sort_unstable();
    meeting
}

fn ends(edges: &[Edge]) -> BTreeMap<Point, End> {
    meeting(edges).chunk_by(|a, b| a.0 == b.0).filter_map(end).collect()
}

/// What ends at the point where all of `meeting` do.
fn end(meeting: &[(Point, usize)]) -> Option<(Point, End)> {
    let &(p, edge) = meeting.last()?;
    Some((p, End { count: u32::try_from(meeting.len()).unwrap_or(u32::MAX), edge }))
}

/// How far apart ends may be that meet.
enum Limit {
    /// As far as the strokes that end there touch: by half the width of each.
    Touch(BTreeMap<Point, Nm>),
    /// So far.
    Gap(Nm),
}

impl Limit {
    /// What strokes of `edges` reach; nothing where there are so many ends that looking at all that
    /// are near would take long.
    fn touch(edges: &[Edge]) -> Self {
        /// Chosen: with all ends in one place, a second.
        const MOST: usize = 10_000;
        let mut halves = BTreeMap::<Point, Nm>::new();
        for (edge, end) in edges.iter().take(MOST + 1).flat_map(|edge| [(edge, edge.from), (edge, edge.to)]) {
            let half = halves.entry(end).or_default();
            *half = edge.half.max(*half);
        }
        Self::Touch(if edges.len() > MOST { BTreeMap::new() } else { halves })
    }

    /// What no two ends that meet are farther apart than.
    fn widest(&self) -> Nm {
        match self {
            Self::Touch(halves) => halves.values().copied().max().unwrap_or_default() * 2,
            Self::Gap(gap) => *gap,
        }
    }

    fn between(&self, p: Point, q: Point) -> Nm {
        match self {
            Self::Touch(halves) => {
                let half = |end| halves.get(&end).copied().unwrap_or_default();
                half(p) + half(q)
            }
            Self::Gap(gap) => *gap,
        }
    }
}

/// Joins each loose end to the nearest other loose one that its stroke touches, and then moves such
/// as are left onto the nearest within `gap`: loose ends first, so that pairs find each other. What
/// touches a corner that is closed already closes nothing.
pub(super) fn close_gaps(edges: &mut Vec<Edge>, gap: Nm, notes: &mut Notes<'_>) {
    let (mut closed, mut widest) = (0_u32, None::<(f64, Point)>);
    let rounds = [(false, true), (true, true), (true, false)];
    for (anywhere, loose_only) in rounds {
        let limit = if anywhere { Limit::Gap(gap) } else { Limit::touch(edges) };
        let mut moves = nearest_pairs(edges, &limit, loose_only);
        for &(width, from, to) in &moves {
            if width > gap.to_f64() {
                edges.push(Edge::line(from, to, line_at(edges, from)));
            }
        }
        for &(width, _, to) in &moves {
            if width > ROUNDING.to_f64() {
                closed += 1;
                if widest.is_none_or(|(w, _)| width > w) {
                    widest = Some((width, to));
                }
            }
        }
        // What is wider is bridged by the line between the ends, which the strokes cover; ends do
        // not go so far.
        moves.retain(|&(width, ..)| width <= gap.to_f64());
        let moved: BTreeMap<Point, Point> = moves.into_iter().map(|(_, from, to)| (from, to)).collect();
        for edge in edges.iter_mut() {
            edge.from = *moved.get(&edge.from).unwrap_or(&edge.from);
            edge.to = *moved.get(&edge.to).unwrap_or(&edge.to);
        }
        edges.retain(|edge| edge.round.is_some() || edge.from != edge.to);
    }
    if let Some((width, at)) = widest {
        notes.closed_gaps(closed, Nm::from_f64(width), (at, line_at(edges, at)));
    }
}

/// An end that was led to the middle of another line: how far, from where, by which line drawn.
pub(super) type Joint = (f64, Point, u32);

/// Leads each end that is still loose to the nearest stroke whose middle its own touches; where
/// any is, the edges are to be parted anew.
///
/// ```text
///            ║      what the line lacks to the middle of the other
///   ━━━━━━━  ║      is not more than half the width of both
///            ║
/// ```
pub(super) fn join_to_middles(edges: &mut Vec<Edge>) -> Vec<Joint> {
    /// Chosen, as for strokes that touch at their ends.
    const MOST: usize = 10_000;
    if edges.len() > MOST {
        return Vec::new();
    }
    let widest = edges.iter().map(|edge| edge.half).max().unwrap_or_default();
    let by_place = RectIndex::new(edges.iter().map(Edge::bounds));
    let (mut joints, mut bridges) = (Vec::new(), Vec::new());
    for (p, index) in ends(edges).into_iter().filter(|(_, end)| end.count == 1).map(|(p, end)| (p, end.edge))
    {
        let end = edges[index];
        let near = Rect::new(p, p).inflate(end.half + widest);
        let others = by_place.touching(near).into_iter().map(|other| &edges[other]);
        let feet = others.filter_map(|other| {
            let foot = other.foot(p)?;
            let distance = p.distance(foot);
            let touches = distance > 0.0 && distance <= (end.half + other.half).to_f64();
            (touches && !is_overrun(&end, other, distance)).then_some((distance, foot))
        });
        if let Some((distance, foot)) = feet.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))) {
            bridges.push(Edge::line(p, foot, end.line));
            joints.push((distance, p, end.line));
        }
    }
    edges.extend(bridges);
    joints
}

/// Says of those `joints` that are part of what closes.
pub(super) fn note_joints(edges: &[Edge], mut joints: Vec<Joint>, notes: &mut Notes<'_>) {
    joints.retain(|(_, p, _)| edges.iter().any(|edge| edge.from == *p || edge.to == *p));
    let Some(&(widest, at, line)) = joints.iter().max_by(|a, b| a.0.total_cmp(&b.0)) else { return };
    notes.joined_to_middles(joints.len(), Nm::from_f64(widest), (at, line));
}

/// Whether `end` leaves `other` and is but what a line was drawn too far across it.
fn is_overrun(end: &Edge, other: &Edge, distance: f64) -> bool {
    /// Chosen: what leaves at 15 degrees or more is an overrun.
    const FLAT: f64 = 4.0;
    let shares = [end.from, end.to].iter().any(|p| [other.from, other.to].contains(p));
    shares && end.length() < FLAT * distance
}

/// Pairs of points within `limit`, the nearest first, none in two pairs: (distance, loose end, what
/// it goes to).
///
/// The reach grows fourfold from one round to the next, and who has found a partner is out. So
/// however many ends lie in one place, few of them are left to be looked at together, and the work
/// grows with their number alone. That the nearest come first makes it the same as sorting all
/// pairs at once.
fn nearest_pairs(edges: &[Edge], limit: &Limit, loose_only: bool) -> Vec<(f64, Point, Point)> {
    let widest = limit.widest();
    let mut free = near_loose(edges, widest);
    free.retain(|_, end| end.count == 1 || !loose_only);
    let mut pairs = Vec::new();
    let first = (!free.is_empty()).then_some(Nm::new(1));
    for reach in successors(first, |&reach| (reach < widest).then(|| (reach * 4).min(widest))) {
        let mut round = pairs_within(edges, &free, limit, reach);
        round.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for pair in round {
            if free.contains_key(&pair.1) && free.remove(&pair.2).is_some() {
                free.remove(&pair.1);
                pairs.push(pair);
            }
        }
    }
    pairs
}

/// The loose ends, and all others that may be within `reach` of one.
fn near_loose(edges: &[Edge], reach: Nm) -> BTreeMap<Point, End> {
    if reach <= Nm::ZERO {
        return BTreeMap::new();
    }
    let meeting = meeting(edges);
    let all = || meeting.chunk_by(|a, b| a.0 == b.0).filter_map(end);
    let loose = all().filter(|(_, end)| end.count == 1);
    let cells: FxHashSet<(i64, i64)> = loose.map(|(p, _)| cell(p, reach)).collect();
    if cells.is_empty() {
        return BTreeMap::new();
    }
    let is_near = |(p, _): &(Point, End)| {
        let (x, y) = cell(*p, reach);
        (x - 1..=x + 1).any(|x| (y - 1..=y + 1).any(|y| cells.contains(&(x, y))))
    };
    all().filter(is_near).collect()
}

/// All pairs of a loose end and another one of `free` within `limit` and `reach`.
fn pairs_within(
    edges: &[Edge],
    free: &BTreeMap<Point, End>,
    limit: &Limit,
    reach: Nm,
) -> Vec<(f64, Point, Point)> {
    let cells = Cells::new(free.keys().copied(), reach);
    let mut pairs = Vec::new();
    for (&p, end) in free.iter().filter(|(_, end)| end.count == 1) {
        for q in cells.around(p).filter(|&q| q != p) {
            let distance = p.distance(q);
            // A loose end is joined to a loose one from one side only: to the smaller point.
            let one_way = free[&q].count != 1 || q < p;
            let fits = distance <= reach.to_f64() && one_way && distance <= limit.between(p, q).to_f64();
            if fits && may_meet(&edges[end.edge], p, q, distance) {
                pairs.push((distance, p, q));
            }
        }
    }
    pairs
}

/// Whether `p`, at which `edge` alone ends, may be moved to `q`. The two ends of one edge may not,
/// unless it is a circle drawn not quite to its start.
fn may_meet(edge: &Edge, p: Point, q: Point, distance: f64) -> bool {
    let other = if edge.from == p { edge.to } else { edge.from };
    other != q || edge.length() > 2.0 * distance
}

/// Points sorted into square cells.
struct Cells {
    size: Nm,
    points: Vec<((i64, i64), Point)>,
}

impl Cells {
    fn new(points: impl Iterator<Item = Point>, size: Nm) -> Self {
        let mut points: Vec<_> = points.map(|p| (cell(p, size), p)).collect();
        points.sort_unstable();
        Self { size, points }
    }

    /// The points in the cell of `p` and the eight around it: all within the size of a cell, and
    /// some farther off.
    fn around(&self, p: Point) -> impl Iterator<Item = Point> {
        let (x, y) = cell(p, self.size);
        (x - 1..=x + 1).flat_map(move |x| {
            let start = self.points.partition_point(|(cell, _)| *cell < (x, y - 1));
            let column = self.points[start..].iter().take_while(move |(cell, _)| *cell <= (x, y + 1));
            column.map(|&(_, q)| q)
        })
    }
}

fn cell(p: Point, size: Nm) -> (i64, i64) {
    (p.x.get().div_euclid(size.get()), p.y.get().div_euclid(size.get()))
}

/// What does not close.
pub(in crate::import) struct Loose {
    /// Its length in nanometres.
    pub(in crate::import) length: f64,
    /// A rectangle that holds it.
    pub(super) bounds: Rect,
    /// The width of the widest line of it.
    pub(in crate::import) width: Nm,
    /// Its first end, and the line of the file that drew it.
    pub(in crate::import) place: (Point, u32),
}

/// Leaves out edges that lead nowhere, until all that is left closes.
pub(super) fn prune(edges: &mut Vec<Edge>, notes: &mut Notes<'_>) -> Option<Loose> {
    let ends = ends(edges);
    if ends.values().all(|end| end.count > 1) {
        return None;
    }
    let dead = dead_ends(edges);
    let left_out = || edges.iter().zip(&dead).filter_map(|(edge, &dead)| dead.then_some(edge));
    let bounds = left_out().map(Edge::bounds).reduce(Rect::union)?;
    let length = left_out().map(Edge::length).fold(0.0, |sum, length| sum + length);
    let loose = |edge: &Edge| [edge.from, edge.to].into_iter().find(|p| ends[p].count == 1);
    let place = left_out().find_map(|edge| Some((loose(edge)?, edge.line)))?;
    // Shorter, it is but a corner that was drawn twice.
    if length >= super::GAP.to_f64() {
        notes.left_open(left_out().count(), Nm::from_f64(length), place);
    }
    let width = left_out().map(|edge| edge.half * 2).max().unwrap_or_default();
    leave_out(edges, dead);
    Some(Loose { length, bounds, width, place })
}

/// Leaves out edges that lead nowhere, without a word.
pub(super) fn drop_dead_ends(edges: &mut Vec<Edge>) {
    let dead = dead_ends(edges);
    leave_out(edges, dead);
}

fn leave_out(edges: &mut Vec<Edge>, dead: Vec<bool>) {
    let mut dead = dead.into_iter();
    edges.retain(|_| !dead.next().unwrap_or(false));
}

/// Which edges lead nowhere: those with a loose end, and those whose end is loose without them, one
/// after the other.
fn dead_ends(edges: &[Edge]) -> Vec<bool> {
    let meeting = meeting(edges);
    let groups = meeting.chunk_by(|a, b| a.0 == b.0);
    let mut live: BTreeMap<Point, usize> = groups.map(|group| (group[0].0, group.len())).collect();
    let mut dead = vec![false; edges.len()];
    let mut loose: Vec<Point> = live.iter().filter(|&(_, &count)| count == 1).map(|(&p, _)| p).collect();
    while let Some(p) = loose.pop() {
        let here = meeting[meeting.partition_point(|end| end.0 < p)..].iter().take_while(|end| end.0 == p);
        let Some(last) = here.map(|end| end.1).find(|&edge| !dead[edge]) else { continue };
        dead[last] = true;
        for end in [edges[last].from, edges[last].to] {
            let count = live.entry(end).and_modify(|count| *count -= 1).or_default();
            if *count == 1 {
                loose.push(end);
            }
        }
    }
    dead
}

fn line_at(edges: &[Edge], at: Point) -> u32 {
    edges.iter().find(|edge| edge.from == at || edge.to == at).map_or(1, |edge| edge.line)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;

    /// As [`nearest_pairs`], the obvious way: every pair of ends, sorted once.
    fn obvious_pairs(edges: &[Edge], gap: Nm, loose_only: bool) -> Vec<(f64, Point, Point)> {
        let ends = ends(edges);
        let between = |e: &&Edge, p, q| (e.from, e.to) == (p, q) || (e.from, e.to) == (q, p);
        let mut pairs = Vec::new();
        for &p in ends.keys().filter(|p| ends[p].count == 1) {
            for &q in ends.keys().filter(|&&q| q != p && (ends[&q].count == 1 || !loose_only)) {
                let distance = p.distance(q);
                let mut joining = edges.iter().filter(|e| between(e, p, q));
                let partner = edges.iter().any(|e| between(&e, p, q));
                let open = joining.any(|e| e.length() > 2.0 * distance);
                let one_way = ends[&q].count != 1 || q < p;
                if distance <= gap.to_f64() && one_way && (!partner || open) {
                    pairs.push((distance, p, q));
                }
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut used = BTreeSet::new();
        pairs.retain(|&(_, p, q)| {
            let free = !used.contains(&p) && !used.contains(&q);
            if free {
                used.extend([p, q]);
            }
            free
        });
        pairs
    }

    /// As [`dead_ends`], the obvious way: pass after pass.
    fn what_closes(mut edges: Vec<Edge>) -> Vec<Edge> {
        loop {
            let ends = ends(&edges);
            let before = edges.len();
            edges.retain(|edge| ends[&edge.from].count > 1 && ends[&edge.to].count > 1);
            if edges.len() == before {
                return edges;
            }
        }
    }

    /// Lines between few places, some of them near each other, so that all that can happen does.
    fn drawings() -> impl Strategy<Value = Vec<Edge>> {
        let place = (0..4_i64, 0..4_i64, 0..60_i64, 0..3_i64).prop_map(|(x, y, beside, above)| {
            Point::new(Nm::new(x * 1_000 + beside), Nm::new(y * 1_000 + above * 30))
        });
        let edge = (place.clone(), place).prop_map(|(from, to)| Edge::line(from, to, 1));
        proptest::collection::vec(edge, 0..40).prop_map(|mut edges| {
            super::super::edge::drop_doubles(&mut edges);
            edges
        })
    }

    proptest! {
        #[test]
        fn ends_meet_as_if_all_pairs_were_sorted(edges in drawings(), gap in 1..2_500_i64, loose_only: bool) {
            let gap = Nm::new(gap);
            prop_assert_eq!(
                nearest_pairs(&edges, &Limit::Gap(gap), loose_only),
                obvious_pairs(&edges, gap, loose_only),
                "the same pairs in the same order"
            );
        }

        #[test]
        fn what_leads_nowhere_is_what_pass_after_pass_leaves_out(edges in drawings()) {
            let dead = dead_ends(&edges);
            let left: Vec<Edge> = edges.iter().zip(dead).filter(|(_, dead)| !dead).map(|(e, _)| *e).collect();
            prop_assert_eq!(left, what_closes(edges), "the same edges");
        }
    }
}
