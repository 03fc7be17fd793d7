//! Ends that do not meet: near ones are joined, lonely ones are left out.

use std::collections::BTreeMap;

use super::Notes;
use super::edge::Edge;
use crate::geometry::{Nm, Point, Rect};
use crate::import::flaw;

/// What an end that lies this near to another is not even worth mentioning: the rounding of a file's last digit.
const ROUNDING: Nm = Nm::from_um(3);

/// How many edges end at each point.
fn ends(edges: &[Edge]) -> BTreeMap<Point, u32> {
    let mut ends = BTreeMap::new();
    for edge in edges {
        *ends.entry(edge.from).or_insert(0) += 1;
        *ends.entry(edge.to).or_insert(0) += 1;
    }
    ends
}

/// Moves each loose end onto the nearest other end within `gap`: loose ends first, so that pairs find each other.
pub(super) fn close_gaps(edges: &mut Vec<Edge>, gap: Nm, notes: &mut Notes<'_>) {
    let (mut closed, mut widest) = (0_u32, None::<(f64, Point)>);
    for loose_only in [true, false] {
        let moves = nearest_pairs(edges, gap, loose_only);
        for &(width, _, to) in &moves {
            if width > ROUNDING.to_f64() {
                closed += 1;
                if widest.is_none_or(|(w, _)| width > w) {
                    widest = Some((width, to));
                }
            }
        }
        let moved: BTreeMap<Point, Point> = moves.into_iter().map(|(_, from, to)| (from, to)).collect();
        for edge in edges.iter_mut() {
            edge.from = *moved.get(&edge.from).unwrap_or(&edge.from);
            edge.to = *moved.get(&edge.to).unwrap_or(&edge.to);
        }
        edges.retain(|edge| edge.round.is_some() || edge.from != edge.to);
    }
    if let Some((width, at)) = widest {
        let message =
            format!("{closed} gaps of the outline are closed, the widest of {:.3} mm", Nm::from_f64(width));
        notes.add(&flaw::OUTLINE_GAP, message, Some((at, line_at(edges, at))));
    }
}

/// Pairs of points within `gap`, the nearest first, none in two pairs: (distance, loose end, what it goes to).
fn nearest_pairs(edges: &[Edge], gap: Nm, loose_only: bool) -> Vec<(f64, Point, Point)> {
    let ends = ends(edges);
    let partner =
        |p: Point, q: Point| edges.iter().any(|e| (e.from, e.to) == (p, q) || (e.from, e.to) == (q, p));
    let mut pairs = Vec::new();
    for (&p, _) in ends.iter().filter(|&(_, &count)| count == 1) {
        let low = Point::new(p.x - gap, Nm::MIN);
        for (&q, &count) in ends.range(low..).take_while(|(q, _)| q.x <= p.x + gap) {
            let distance = p.distance(q);
            let fits = q != p && distance <= gap.to_f64() && (count == 1 || !loose_only);
            // A loose end is joined to a loose one from one side only: to the smaller point.
            if fits && (count != 1 || q < p) && (!partner(p, q) || is_open_circle(edges, p, q)) {
                pairs.push((distance, p, q));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut used = std::collections::BTreeSet::new();
    pairs.retain(|&(_, p, q)| {
        let free = !used.contains(&p) && !used.contains(&q);
        if free {
            used.insert(p);
            used.insert(q);
        }
        free
    });
    pairs
}

/// Whether an edge from `p` to `q` is a circle drawn not quite to its start, whose ends may meet.
fn is_open_circle(edges: &[Edge], p: Point, q: Point) -> bool {
    let between = |e: &&Edge| (e.from, e.to) == (p, q) || (e.from, e.to) == (q, p);
    edges.iter().filter(between).any(|e| e.length() > 2.0 * p.distance(q))
}

/// What [`prune`] left out.
pub(super) struct Loose {
    /// Its length in nanometres.
    pub(super) length: f64,
    /// A rectangle that holds it.
    pub(super) bounds: Rect,
    /// Its first end, and the line that drew it.
    pub(super) place: (Point, u32),
}

/// Leaves out edges that lead nowhere, until all that is left closes.
pub(super) fn prune(edges: &mut Vec<Edge>, notes: &mut Notes<'_>) -> Option<Loose> {
    let (mut dropped, mut length, mut first) = (0_u32, 0.0, None);
    let mut bounds = None::<Rect>;
    loop {
        let ends = ends(edges);
        let before = edges.len();
        edges.retain(|edge| {
            let loose = [edge.from, edge.to].into_iter().find(|p| ends[p] == 1);
            if let Some(at) = loose {
                dropped += 1;
                length += edge.length();
                bounds = Some(bounds.map_or(edge.bounds(), |b| b.union(edge.bounds())));
                first = first.or(Some((at, edge.line)));
            }
            loose.is_none()
        });
        if edges.len() == before {
            break;
        }
    }
    let (place, bounds) = first.zip(bounds)?;
    let message = format!(
        "{dropped} lines of the outline layer, {:.1} mm in all, close no contour and are left out",
        Nm::from_f64(length)
    );
    notes.add(&flaw::OUTLINE_LOOSE_LINES, message, Some(place));
    Some(Loose { length, bounds, place })
}

fn line_at(edges: &[Edge], at: Point) -> u32 {
    edges.iter().find(|edge| edge.from == at || edge.to == at).map_or(1, |edge| edge.line)
}
