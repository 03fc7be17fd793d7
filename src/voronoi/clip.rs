//! What lies on the board of the chains of a diagram, and the border itself, cut where they cross.
//!
//! ```text
//!     outside ╎ board             Where a chain crosses the border is a node. What lies beyond is left
//!             ╎   A               away; the pieces of the border between two crossings are boundaries
//!    ─ ─ ─ ─ ─●──────────●        of the outside and of the net whose region they close.
//!             ╎   B       ╲
//! ```

use std::cmp::Ordering;
use std::ops::Range;

use rayon::prelude::*;

use crate::geometry::{BoxTree, Polygon};

use super::edge::Border;
use super::exact::Chain;
use super::plane::{Spot, spanned};
use super::sample::{Sample, length};
use super::{BACKGROUND, OUTSIDE};

/// Where a piece ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Node {
    /// At a vertex of the diagram.
    Vertex(u32),
    /// Where a chain crosses the border.
    Crossing(u32),
}

impl Node {
    /// Where a part of a pass ends.
    pub(super) const END: Self = Self::Vertex(0);
}

/// A part of the graph of boundaries before it is fitted.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    /// The number of the owner on its left.
    pub(super) left: u32,
    /// The number of the owner on its right.
    pub(super) right: u32,
    pub(super) samples: Vec<Sample>,
    /// The nodes at its ends; none for a loop.
    pub(super) ends: Option<[Node; 2]>,
}

impl Piece {
    /// Whether it runs along the border.
    pub(super) const fn is_border(&self) -> bool {
        self.left == OUTSIDE || self.right == OUTSIDE
    }

    /// Makes it begin at the end that comes first by place, so that it does not matter from where
    /// it was found.
    fn orient(&mut self) {
        let samples = &self.samples;
        let backwards = || samples.iter().rev().zip(samples).map(|(b, a)| by_place(a, b)).find(|o| o.is_ne());
        if self.ends.is_some() && backwards() == Some(Ordering::Greater) {
            self.samples.reverse();
            self.ends.iter_mut().for_each(|ends| ends.reverse());
            std::mem::swap(&mut self.left, &mut self.right);
        }
    }

    fn compare(&self, other: &Self) -> Ordering {
        let pairs = self.samples.iter().zip(&other.samples);
        pairs.map(|(a, b)| by_place(a, b)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
    }
}

fn by_place(a: &Sample, b: &Sample) -> Ordering {
    a.at.x.total_cmp(&b.at.x).then(a.at.y.total_cmp(&b.at.y))
}

/// The border lies off whole nanometres by this, so that nothing on the grid of a board lies on it
/// exactly. Chosen: two unequal parts of a nanometre that is rounded away in the end.
const OFF_GRID: Spot = Spot::new(0.013_7, 0.007_1);

/// Crossings this near to each other, in nanometres, may come in either order. Chosen: far more
/// than rounding.
const SAME: f64 = 10.0;

/// The edges of a border by place: that of the board, or of other areas.
pub(super) struct Fence {
    /// From vertex to vertex, with the board on the left.
    edges: Vec<[Spot; 2]>,
    /// Of each ring its first edge; one more ends the last.
    starts: Vec<usize>,
    tree: BoxTree,
}

/// Where a chain crosses the border.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    /// Between which samples of the chain, and how far from the first to the second.
    sample: usize,
    part: f64,
    /// On which edge of the border, and how far from its start.
    edge: usize,
    along: f64,
    /// Whether the chain leaves the board.
    leaves: bool,
    at: Sample,
    /// The owners on the board ahead and behind, for who follows the border.
    ahead: u32,
    behind: u32,
}

/// Whether `p` lies on the left of the way from `a` to `b`; on it counts as not.
fn is_left(a: Spot, b: Spot, p: Spot) -> bool {
    (b - a).cross(p - a) > 0.0
}

fn bounds(samples: &[Sample]) -> [f64; 4] {
    let far = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    samples.iter().fold(far, |[left, bottom, right, top], sample| {
        let Spot { x, y } = sample.at;
        [left.min(x), bottom.min(y), right.max(x), top.max(y)]
    })
}

impl Fence {
    pub(super) fn new(border: &Border) -> Self {
        Self::of(border.rings.iter())
    }

    /// The edges of areas, polygons as a boolean returns them.
    pub(super) fn around(areas: &[Polygon]) -> Self {
        let contours = areas.iter().flat_map(Polygon::contours);
        let rings: Vec<Vec<Spot>> =
            contours.map(|contour| contour.iter().copied().map(Spot::from).collect()).collect();
        Self::of(rings.iter().map(Vec::as_slice))
    }

    fn of<'a>(rings: impl Iterator<Item = &'a [Spot]>) -> Self {
        let (mut edges, mut starts) = (Vec::new(), vec![0]);
        for ring in rings {
            let next = ring.iter().cycle().skip(1);
            edges.extend(ring.iter().zip(next).map(|(&a, &b)| [a + OFF_GRID, b + OFF_GRID]));
            starts.push(edges.len());
        }
        let tree = BoxTree::new(edges.iter().map(|&[a, b]| spanned(a, b)));
        Self { edges, starts, tree }
    }

    /// Its rings, corner by corner.
    pub(super) fn rings(&self) -> Vec<Vec<Spot>> {
        let ring = |ends: &[usize]| self.edges[ends[0]..ends[1]].iter().map(|&[a, _]| a).collect();
        self.starts.windows(2).map(ring).collect()
    }

    /// Whether `p` lies on the board.
    pub(super) fn holds(&self, p: Spot) -> bool {
        let beyond = self.tree.within([p.x, p.y, f64::MAX, p.y]).into_iter().filter(|&edge| {
            let [a, b] = self.edges[edge];
            (a.y > p.y) != (b.y > p.y) && (is_left(a, b, p) == (b.y > a.y))
        });
        beyond.count() % 2 == 1
    }

    /// Whether all of the straight way between two places lies beyond the border.
    pub(super) fn is_beyond(&self, a: Spot, b: Spot) -> bool {
        let ends = [a, b].map(|at| Sample { at, clearance: 0.0 });
        !self.holds(a) && self.crossings(&ends, (BACKGROUND, BACKGROUND)).is_empty()
    }

    /// The parts of a piece within the border, or those beyond it.
    pub(super) fn parts(&self, piece: Piece, is_within: bool) -> impl Iterator<Item = Piece> + use<> {
        let Piece { left, right, samples, ends } = piece;
        let found = self.crossings(&samples, (left, right)).into_iter().map(|crossing| {
            let leaves = crossing.leaves == is_within;
            (Crossing { leaves, ..crossing }, Node::END)
        });
        let found: Vec<(Crossing, Node)> = found.collect();
        let is_wanted = self.holds(samples[0].at) == is_within;
        parts(samples, ends, is_wanted, &found).map(move |(samples, ends)| Piece {
            left,
            right,
            samples,
            ends,
        })
    }

    /// Where a line crosses the border, in its order; the owners are those on its left and right.
    fn crossings(&self, samples: &[Sample], owners: (u32, u32)) -> Vec<Crossing> {
        let mut crossings = Vec::new();
        self.add_crossings(samples, 0..samples.len() - 1, owners, &mut crossings);
        crossings
    }

    /// Adds those between the samples of some steps of the line. Steps none of which comes near the
    /// border are passed over together.
    fn add_crossings(
        &self,
        samples: &[Sample],
        steps: Range<usize>,
        (left, right): (u32, u32),
        crossings: &mut Vec<Crossing>,
    ) {
        if steps.len() > 1 {
            if self.tree.meets(bounds(&samples[steps.start..=steps.end])) {
                let middle = steps.start.midpoint(steps.end);
                self.add_crossings(samples, steps.start..middle, (left, right), crossings);
                self.add_crossings(samples, middle..steps.end, (left, right), crossings);
            }
            return;
        }
        let (sample, pair) = (steps.start, [samples[steps.start], samples[steps.end]]);
        let [p, q] = pair.map(|sample| sample.at);
        let from = crossings.len();
        for edge in self.tree.within(bounds(&pair)) {
            let [a, b] = self.edges[edge];
            let leaves = is_left(a, b, p);
            if leaves == is_left(a, b, q) || is_left(p, q, a) == is_left(p, q, b) {
                continue;
            }
            let (way, side) = (q - p, b - a);
            let part = (side.cross(a - p) / side.cross(way)).clamp(0.0, 1.0);
            let at = p + way * part;
            let clearance = pair[0].clearance + (pair[1].clearance - pair[0].clearance) * part;
            let (ahead, behind) = if leaves { (left, right) } else { (right, left) };
            let (along, at) = ((at - a).length(), Sample { at, clearance });
            crossings.push(Crossing { sample, part, edge, along, leaves, at, ahead, behind });
        }
        crossings[from..].sort_by(|a, b| a.part.total_cmp(&b.part).then(a.edge.cmp(&b.edge)));
    }
}

/// The pieces of `chains` on the board, then those of the border; and where the border's owners
/// contradict each other: nowhere, unless the program is at fault. The chains' owners, and those
/// that `owner` finds at a place, become the pieces' numbers by `number`.
pub(super) fn within(
    border: &Border,
    chains: Vec<Chain>,
    owner: impl Fn(Spot) -> Option<u32>,
    number: impl Fn(u32) -> u32,
) -> (Vec<Piece>, Vec<Spot>) {
    let fence = Fence::new(border);
    let crossed = |chain: &Chain| fence.crossings(&chain.samples, (chain.left, chain.right));
    let cut: Vec<(bool, Vec<Crossing>)> =
        chains.par_iter().map(|chain| (fence.holds(chain.samples[0].at), crossed(chain))).collect();
    let mut pieces = Vec::new();
    let mut crossings: Vec<(Crossing, Node)> = Vec::new();
    for (chain, (starts_inside, found)) in chains.into_iter().zip(cut) {
        let first = u32::try_from(crossings.len()).expect("below 2³² crossings");
        let numbered = (first..).map(Node::Crossing);
        let found: Vec<(Crossing, Node)> = found.into_iter().zip(numbered).collect();
        crossings.extend(&found);
        let sides = (number(chain.left), number(chain.right));
        let whole = chain.ends.map(|ends| ends.map(Node::Vertex));
        pieces.extend(parts(chain.samples, whole, starts_inside, &found).map(|(samples, ends)| {
            let (left, right) = sides;
            Piece { left, right, samples, ends }
        }));
    }
    pieces.iter_mut().for_each(Piece::orient);
    pieces.sort_by(Piece::compare);
    let mut faults = Vec::new();
    for ring in 0..fence.starts.len() - 1 {
        let edges = fence.starts[ring]..fence.starts[ring + 1];
        let mut on: Vec<(Crossing, Node)> =
            crossings.iter().filter(|(crossing, _)| edges.contains(&crossing.edge)).copied().collect();
        on.sort_by(|(a, _), (b, _)| a.edge.cmp(&b.edge).then(a.along.total_cmp(&b.along)));
        let corners = border.rings.of(ring);
        let clearance = border.clearance.to_f64();
        let lap = Lap { corners, first_edge: edges.start, clearance };
        if on.is_empty() {
            let left = owner(corners[0]).map_or(BACKGROUND, &number);
            pieces.push(Piece { left, right: OUTSIDE, samples: lap.whole(), ends: None });
        }
        for (i, &(from, start)) in on.iter().enumerate() {
            let (to, end) = on[(i + 1) % on.len()];
            let samples = lap.between(&from, &to, on.len() == 1);
            let length = length(&samples);
            let mut side = from.ahead;
            if from.ahead != to.behind {
                let middle = &samples[samples.len() / 2 - 1..=samples.len() / 2];
                side = owner(middle[0].at.midpoint(middle[1].at)).unwrap_or(side);
                if length > SAME && side != from.ahead && side != to.behind {
                    faults.push(samples[0].at);
                }
            }
            pieces.push(Piece { left: number(side), right: OUTSIDE, samples, ends: Some([start, end]) });
        }
    }
    (pieces, faults)
}

type Part = (Vec<Sample>, Option<[Node; 2]>);

/// The parts of a line on the board; `whole` are the nodes at its ends.
fn parts(
    samples: Vec<Sample>,
    whole: Option<[Node; 2]>,
    starts_inside: bool,
    crossings: &[(Crossing, Node)],
) -> impl Iterator<Item = Part> + use<> {
    let mut parts: Vec<Part> = Vec::new();
    let (Some((first, _)), Some((last, last_node))) = (crossings.first(), crossings.last()) else {
        if starts_inside {
            parts.push((samples, whole));
        }
        return parts.into_iter();
    };
    let mut head: Vec<Sample> = samples[..=first.sample].to_vec();
    let mut tail: Vec<Sample> = vec![last.at];
    tail.extend_from_slice(&samples[last.sample + 1..]);
    for pair in crossings.windows(2) {
        let ((from, start), (to, end)) = (&pair[0], &pair[1]);
        if !from.leaves {
            let mut part = vec![from.at];
            part.extend_from_slice(&samples[from.sample + 1..=to.sample.max(from.sample)]);
            part.push(to.at);
            parts.push((part, Some([*start, *end])));
        }
    }
    let (_, first_node) = crossings[0];
    head.push(first.at);
    match whole {
        Some([from, to]) => {
            if first.leaves {
                parts.insert(0, (head, Some([from, first_node])));
            }
            if !last.leaves {
                parts.push((tail, Some([*last_node, to])));
            }
        }
        // A loop: its beginning and its end are one part.
        None if !last.leaves => {
            tail.extend_from_slice(&head[1..]);
            parts.push((tail, Some([*last_node, first_node])));
        }
        None => {}
    }
    parts.into_iter()
}

/// One ring of the border.
struct Lap<'a> {
    corners: &'a [Spot],
    /// The number of its first edge.
    first_edge: usize,
    clearance: f64,
}

impl Lap<'_> {
    fn sample(&self, at: Spot) -> Sample {
        Sample { at, clearance: self.clearance }
    }

    /// Once round.
    fn whole(&self) -> Vec<Sample> {
        self.corners.iter().chain(self.corners.first()).map(|&at| self.sample(at)).collect()
    }

    /// From one crossing to the next, along the border; all the way round where they are one.
    fn between(&self, from: &Crossing, to: &Crossing, round: bool) -> Vec<Sample> {
        let n = self.corners.len();
        let (mut edge, last) = (from.edge - self.first_edge, to.edge - self.first_edge);
        let mut samples = vec![self.sample(from.at.at)];
        let is_behind = edge == last && (round || to.along < from.along);
        let mut left = if is_behind { n } else { (last + n - edge) % n };
        while left > 0 {
            edge = (edge + 1) % n;
            samples.push(self.sample(self.corners[edge]));
            left -= 1;
        }
        samples.push(self.sample(to.at.at));
        samples
    }
}
