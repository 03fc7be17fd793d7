//! Corners of passes, cut out to their tips.
//!
//! ```text
//!   ▓▓▓▓▓▓▓▓▓▓▓▓        Beside an inner corner of copper passes have corners, too, and these lie farther apart than
//!   ▓▓┌───────── near   the passes. A round cutter leaves a speck of copper between two of them where the passes
//!   ▓▓│ ╲               share little. So the far one goes towards the near one from its corner, and back: a spike
//!   ▓▓│  ┌────── far    just so long that nothing stays.
//! ```
//!
//! Corners of copper are often rounded by a few short edges: what turns within a quarter of a kerf
//! is one corner.

use crate::geometry::{Nm, Path, Point, Segment, Turn};
use crate::voronoi::clip::{Fence, Node, Piece};
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::Sample;
use crate::voronoi::{BACKGROUND, Boundary, Owner};

/// Ways that turn back on themselves have no tip: 2°. Chosen.
const LEAST_SINE: f64 = 0.02;
/// A speck that a shorter spike would clear is too small to see, in nanometres. Chosen.
const LEAST_LENGTH: f64 = 1_000.0;

/// Leads the corners of passes out to their tips.
pub(super) struct Spikes<'a> {
    /// How wide the cutter clears, in nanometres.
    pub(super) kerf: f64,
    /// How far passes lie apart.
    pub(super) step: f64,
    /// How far a place is from copper, in nanometres.
    pub(super) clearance: &'a (dyn Fn(Point) -> f64 + Sync),
    /// How near to copper a spike may come.
    pub(super) nearest: f64,
    /// Where the board ends, and spikes with it.
    pub(super) fence: &'a Fence,
}

/// What a corner needs.
struct Tip {
    /// The leg after which it is cut.
    last: usize,
    at: Spot,
    /// Whether it lies where the passes have their corners: the ways before and after a jog meet
    /// anywhere.
    is_near: bool,
}

/// A segment with the directions in which it begins and ends.
struct Leg {
    from: Spot,
    to: Spot,
    begins: Spot,
    ends: Spot,
}

impl Spikes<'_> {
    /// Adds what the corners of a pass need beside the pass that is a step nearer to copper.
    pub(super) fn add(&self, pass: &mut Boundary) {
        let legs: Vec<Leg> = pass.path.steps().map(|(from, segment)| Leg::new(from, segment)).collect();
        let copper_on_left = matches!(pass.left, Owner::Net(_));
        let mut tips = vec![None; legs.len()];
        for corner in self.corners(&legs, pass.path.is_closed()) {
            for Tip { last, at, .. } in self.tips(&legs, &corner, copper_on_left) {
                let to = self.on_board(legs[last].to, at);
                if (to - legs[last].to).length() >= LEAST_LENGTH {
                    let tip = to.rounded();
                    tips[last] = Some((tip, Nm::from_f64((self.clearance)(tip))));
                }
            }
        }
        let mut path = Path { start: pass.path.start, segments: Vec::with_capacity(legs.len()) };
        let mut clearance = vec![pass.clearance[0]];
        for ((segment, &room), tip) in pass.path.segments.iter().zip(&pass.clearance[1..]).zip(tips) {
            path.segments.push(*segment);
            clearance.push(room);
            if let Some((to, narrow)) = tip {
                path.segments.extend([Segment::Line { to }, Segment::Line { to: segment.to() }]);
                clearance.extend([narrow, room]);
            }
        }
        (pass.path, pass.clearance) = (path, clearance);
    }

    /// The corners of a way: runs of legs of which all but the first and the last are short, as
    /// their numbers.
    fn corners(&self, legs: &[Leg], is_closed: bool) -> Vec<Vec<usize>> {
        let is_long = |&i: &usize| (legs[i].to - legs[i].from).length() >= self.kerf / 4.0;
        let Some(first) = (0..legs.len()).find(is_long) else { return Vec::new() };
        let last = if is_closed { first + legs.len() } else { legs.len() - 1 };
        let mut corners = Vec::new();
        let mut run = vec![first];
        for i in (first + 1..=last).map(|i| i % legs.len()) {
            run.push(i);
            if is_long(&i) {
                corners.push(std::mem::replace(&mut run, vec![i]));
            }
        }
        corners
    }

    /// The tips that a corner needs: one, or one for each bend where that would pierce the wall at
    /// the narrow end of a wedge, or is no tip of the corner.
    fn tips(&self, legs: &[Leg], corner: &[usize], copper_on_left: bool) -> Vec<Tip> {
        let tip = |bends: &[usize]| self.tip(legs, bends, copper_on_left);
        let is_good = |tip: &Tip| tip.is_near && self.is_clear(legs[tip.last].to, tip.at);
        let whole = tip(corner);
        if whole.as_ref().is_none_or(is_good) {
            return whole.into_iter().collect();
        }
        corner.windows(2).filter_map(tip).filter(is_good).collect()
    }

    /// The last place of a way up to which it stays on the board.
    fn on_board(&self, from: Spot, to: Spot) -> Spot {
        let samples = [from, to].map(|at| Sample { at, clearance: 0.0 }).to_vec();
        let way = Piece { left: BACKGROUND, right: BACKGROUND, samples, ends: Some([Node::END; 2]) };
        let first = self.fence.parts(way, true).find(|part| part.samples[0].at == from);
        first.and_then(|part| part.samples.last().map(|end| end.at)).unwrap_or(from)
    }

    /// Whether a way keeps off the copper.
    fn is_clear(&self, from: Spot, to: Spot) -> bool {
        let (way, length) = (to - from, (to - from).length());
        let mut along = 0.0;
        loop {
            let room = (self.clearance)((from + way * (along / length)).rounded());
            if room < self.nearest || along >= length {
                return room >= self.nearest;
            }
            // Copper comes no faster than the way goes.
            along = (along + (room - self.nearest).max(LEAST_LENGTH)).min(length);
        }
    }

    /// The tip that a corner needs; none where it needs none, or is none of an inner corner.
    fn tip(&self, legs: &[Leg], corner: &[usize], copper_on_left: bool) -> Option<Tip> {
        let (before, after) = (&legs[*corner.first()?], &legs[*corner.last()?]);
        let turn = before.ends.cross(after.begins);
        // A pass turns away from the copper at an inner corner of it.
        let is_inner = (turn < 0.0) == copper_on_left;
        // Half the angle between the two ways; its sine is the cosine of half the turn.
        let sine = ((1.0 + before.ends.dot(after.begins)) / 2.0).max(0.0).sqrt();
        let way = before.ends - after.begins;
        if !is_inner || sine < LEAST_SINE || way.length() < LEAST_SINE {
            return None;
        }
        let apex = before.to + before.ends * ((after.from - before.to).cross(after.begins) / turn);
        let length = (self.step - self.kerf / 2.0 * (1.0 + sine)) / sine;
        let way = way * (1.0 / way.length());
        let at = apex + way * length;
        let reach = |last: &usize| (at - legs[*last].to).length();
        let bends = &corner[..corner.len() - 1];
        let last = bends.iter().copied().min_by(|a, b| reach(a).total_cmp(&reach(b)))?;
        let round: f64 = bends[1..].iter().map(|&leg| (legs[leg].to - legs[leg].from).length()).sum();
        let is_near = reach(&last) <= (self.step + round) / sine;
        ((at - legs[last].to).dot(way) >= LEAST_LENGTH).then_some(Tip { last, at, is_near })
    }
}

impl Leg {
    fn new(from: Point, segment: &Segment) -> Self {
        let unit = |way: Spot| if way.length() > 0.0 { way * (1.0 / way.length()) } else { way };
        let (start, end) = (Spot::from(from), Spot::from(segment.to()));
        let [begins, ends] = match segment.arc(from) {
            None => [unit(end - start); 2],
            Some(arc) => {
                let round = if arc.turn == Turn::Clockwise { -1.0 } else { 1.0 };
                [start, end].map(|at| {
                    let out = at - Spot::from(arc.center);
                    unit(Spot::new(-out.y, out.x) * round)
                })
            }
        };
        Self { from: start, to: end, begins, ends }
    }
}
