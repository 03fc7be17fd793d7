//! Passes end where a cut has cleared already.
//!
//! ```text
//!    pass ───────────────╮
//!    ┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄│┄┄┄
//!    ━━━━━━━━━━━━━━━━━━━━━┿━━ cut
//! ```
//!
//! A pass runs on for as long as it clears anything that a cut does not: up to where it comes
//! nearer to the cut than passes do to each other. The passes of a finer tool also end where two
//! cuts beside each other, each of which clears past the middle between them, have cleared together
//! all that it would clear:
//!
//! ```text
//!    ━━━━━━━━━━━━━━━━━━━━ cut
//!    ▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒
//!    ━━━━━━━━━━━━━━━━━━━━ cut
//! ```

use std::ops::ControlFlow;
use std::sync::Arc;

use crate::geometry::{BoxTree, Nm};
use crate::voronoi::Boundary;
use crate::voronoi::clip::{Node, Piece};
use crate::voronoi::plane::{Span, Spot, sides};
use crate::voronoi::sample::Sample;

/// A pass goes on until it is so much nearer to a cut than it need be, in nanometres, so that one
/// along the very edge of what is cleared is one pass. Chosen.
const DEEP: f64 = 5_000.0;
/// Places this far apart are looked at, in nanometres. Chosen: less than what passes share, for any
/// kerf that is worth widening.
const STEP: f64 = 10_000.0;
/// Cuts are gathered so far beyond their reach, in nanometres. Chosen: of 0.3, 0.6 and 1.2 mm the
/// fewest instructions.
const FARTHEST: f64 = 600_000.0;
/// Where a pass ends is halved so often. Chosen.
const HALVINGS: usize = 12;

/// What cuts have cleared for passes.
#[derive(Clone)]
pub(super) struct Grooves {
    cuts: Arc<Cuts>,
    /// How far from a cut nothing is left to clear, in nanometres.
    reach: f64,
    /// What several cuts clear together, if that is asked.
    together: Option<Together>,
}

/// What several cuts clear together, in nanometres.
#[derive(Clone, Copy)]
struct Together {
    /// How far from its middle each clears.
    wide: f64,
    /// Within so much of a place nothing may be left.
    disc: f64,
}

/// Where in a disc it is looked whether anything is left, but for its middle: all round, and half
/// as far out.
const DIRECTIONS: [(f64, f64); 8] = {
    const SLANT: f64 = std::f64::consts::FRAC_1_SQRT_2;
    [
        (1.0, 0.0),
        (SLANT, SLANT),
        (0.0, 1.0),
        (-SLANT, SLANT),
        (-1.0, 0.0),
        (-SLANT, -SLANT),
        (0.0, -1.0),
        (SLANT, -SLANT),
    ]
};

/// Cuts by place.
struct Cuts {
    spans: Vec<Span>,
    tree: BoxTree,
}

impl Grooves {
    /// What lies within `reach` of `cuts`; none where there are none.
    pub(super) fn new<'a>(cuts: impl Iterator<Item = &'a Boundary>, reach: Nm) -> Option<Self> {
        let (mut spans, mut bounds) = (Vec::new(), Vec::new());
        for (from, segment) in cuts.filter(|edge| !edge.is_border()).flat_map(|edge| edge.path.steps()) {
            spans.push(Span::new(from, segment));
            bounds.push(sides(segment.bounds(from)));
        }
        let tree = BoxTree::new(bounds.into_iter());
        let is_any = !spans.is_empty();
        is_any.then(|| Self { cuts: Arc::new(Cuts { spans, tree }), reach: reach.to_f64(), together: None })
    }

    /// What of it lies within `reach` of the same cuts.
    pub(super) fn within(&self, reach: Nm) -> Self {
        Self { reach: self.reach.min(reach.to_f64()), ..self.clone() }
    }

    /// The same, and what cuts clear together, each as far from its middle as `wide`, of what is
    /// within `disc` of a place.
    pub(super) fn together(self, wide: Nm, disc: Nm) -> Self {
        let [wide, disc] = [wide, disc].map(Nm::to_f64);
        Self { together: Some(Together { wide, disc }), ..self }
    }

    /// Whether nothing is left to clear at `p`.
    pub(super) fn holds(&self, p: Spot) -> bool {
        let Cuts { spans, tree } = &*self.cuts;
        let region = tree.round((p.x, p.y), self.reach);
        let near = tree.visit(&region, |i| {
            if spans[i].distance(p) < self.reach { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        near.is_break()
    }

    /// What is left of a pass.
    pub(super) fn take_out(&self, piece: Piece) -> Vec<Piece> {
        let first = piece.samples[0];
        let about = About { center: first.at, radius: 0.0, spans: Vec::new() };
        let mut walk = Walk { grooves: self, is_cleared: false, parts: vec![vec![first]], sure: 0.0, about };
        let distance = walk.distance(first.at);
        if distance < self.reach {
            (walk.is_cleared, walk.parts) = (true, Vec::new());
        }
        walk.sure = walk.spare(distance);
        let begins_cleared = walk.is_cleared;
        piece.samples.windows(2).for_each(|pair| walk.go(&pair[0], &pair[1]));
        let mut parts = walk.parts;
        if piece.ends.is_none() && !begins_cleared && parts.len() == 1 && !walk.is_cleared {
            return vec![piece];
        }
        if piece.ends.is_none()
            && !begins_cleared
            && !walk.is_cleared
            && let Some(mut last) = parts.pop()
        {
            // One way round: it goes on where it began.
            last.extend(parts.remove(0).into_iter().skip(1));
            parts.push(last);
        }
        let Piece { left, right, ends, .. } = piece;
        let ends = ends.or(Some([Node::END; 2]));
        let part = |samples| Piece { left, right, samples, ends };
        parts.into_iter().filter(|part| part.len() > 1).map(part).collect()
    }
}

/// A pass walked along.
struct Walk<'a> {
    grooves: &'a Grooves,
    is_cleared: bool,
    parts: Vec<Vec<Sample>>,
    /// So far on from where the walk is nothing changes.
    sure: f64,
    about: About,
}

/// The cuts about a place, gathered once for all places near it.
struct About {
    center: Spot,
    /// Within so much of the center all are gathered.
    radius: f64,
    spans: Vec<Span>,
}

impl Walk<'_> {
    /// Goes on from one sample to the next.
    fn go(&mut self, from: &Sample, to: &Sample) {
        let length = (to.at - from.at).length();
        let count = (length / STEP).ceil().max(1.0);
        let step = length / count;
        let mut looked = 0.0;
        // What is far from changing is stepped over.
        while looked * step + self.sure < length {
            let i = (looked + (self.sure / step).floor() + 1.0).min(count);
            let distance = self.distance(from.toward(to, i / count).at);
            if self.changes(distance) {
                let crossing = from.toward(to, self.crossing([from, to], (i - 1.0) / count, i / count));
                if self.is_cleared {
                    self.parts.push(vec![crossing]);
                } else {
                    self.part().push(crossing);
                }
                self.is_cleared = !self.is_cleared;
            }
            (looked, self.sure) = (i, self.spare(distance));
        }
        self.sure -= length - looked * step;
        if !self.is_cleared {
            self.part().push(*to);
        }
    }

    /// How far on from a place nothing changes: distances change no faster than the way goes.
    fn spare(&self, distance: f64) -> f64 {
        let Grooves { reach, .. } = *self.grooves;
        let spare = if self.is_cleared { reach - distance } else { distance - (reach - DEEP) };
        spare.max(0.0)
    }

    /// How far a place is from the nearest cut, or less where several have cleared together what is
    /// beside it; no more than [`Grooves::reach`] where nothing is left.
    fn distance(&mut self, p: Spot) -> f64 {
        let alone = self.off_cut(p);
        let Grooves { reach, together, .. } = *self.grooves;
        let Some(Together { wide, disc }) = together.filter(|_| alone >= reach) else { return alone };
        let rings = [disc, disc / 2.0];
        let places = rings.into_iter().flat_map(|part| DIRECTIONS.map(|(x, y)| p + Spot::new(x, y) * part));
        let mut farthest = alone;
        for place in places {
            if farthest >= wide {
                break;
            }
            farthest = farthest.max(self.off_cut(place));
        }
        alone.min(farthest - wide + reach)
    }

    /// How far a place is from the nearest cut; where none is near, at least how far none is.
    fn off_cut(&mut self, p: Spot) -> f64 {
        let Self { grooves, about, .. } = self;
        let known = about.radius - (p - about.center).length();
        let enough = grooves.together.map_or(grooves.reach, |together| together.wide.max(grooves.reach));
        let known = if known > enough {
            known
        } else {
            about.center = p;
            about.radius = enough + FARTHEST;
            about.spans.clear();
            let Cuts { spans, tree } = &*grooves.cuts;
            let [x, y, reach] = [p.x, p.y, about.radius];
            tree.visit_window([x - reach, y - reach, x + reach, y + reach], |i| about.spans.push(spans[i]));
            about.radius
        };
        about.spans.iter().fold(known, |nearest, span| nearest.min(span.distance(p)))
    }

    fn part(&mut self) -> &mut Vec<Sample> {
        self.parts.last_mut().expect("what is not cleared has begun")
    }

    /// Whether what holds of the way so far does not hold so far from a cut.
    fn changes(&self, distance: f64) -> bool {
        if self.is_cleared { distance >= self.grooves.reach } else { distance < self.grooves.reach - DEEP }
    }

    /// Where between two places it changes.
    fn crossing(&mut self, [from, to]: [&Sample; 2], mut before: f64, mut after: f64) -> f64 {
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(before, after);
            let distance = self.distance(from.toward(to, middle).at);
            if self.changes(distance) {
                after = middle;
            } else {
                before = middle;
            }
        }
        f64::midpoint(before, after)
    }
}
