//! A sweep: the empty circles of all places between two of a bisector, without solving for any.
//!
//! ```text
//!      a ─────────────────────╮          Both generators of the bisector are lines or full circles, or one is: then the distance
//!     ╭───╮ ╭──╮ ╭──╮ ╭─╮      ╲  hull   to it, which is the clearance, is a convex function of the place, and what lies between
//!    (  ●─┼─┼──┼─┼──┼─┼─●─)     ▕        two circles is no larger than evenly between them. So all of them lie in the *hull* of the
//!     ╰───╯ ╰──╯ ╰──╯ ╰─╯      ╱         first and the last, but for how far the bisector strays from its chord.
//!      b ─────────────────────╯
//! ```

use super::form::{Form, clockwise, unit};
use super::pair::Pair;
use super::tolerances::SNAP;
use crate::voronoi::plane::Spot;

/// Boxes are looked at so much farther out than what may enter, in nanometres. Chosen: more than
/// rounding.
const MARGIN: f64 = 10.0;

/// A place on a bisector with its clearance.
type Disc = (Spot, f64);

/// The discs round all places between two of a bisector.
pub(super) struct Sweep {
    from: Disc,
    /// The last of them.
    pub(super) to: Disc,
    /// The direction in which the bisector leaves the first place; none where it is straight.
    way: Option<Spot>,
    /// Whether clearance is nowhere more than evenly between those at both ends.
    is_convex: bool,
    tie: f64,
    hull: Hull,
    /// How far the bisector strays from its chord.
    stray: f64,
}

impl Sweep {
    /// Those from one place to another, with what touches the last but for a `tie`.
    pub(super) fn new(pair: &Pair, from: Disc, to: Disc, tie: f64) -> Self {
        let way = (!pair.is_straight()).then(|| pair.way(from.0));
        let is_convex = !pair.forms.iter().all(Form::is_hollow);
        let (hull, stray) = reach(from, to, way, [tie, tie]);
        Self { from, to, way, is_convex, tie, hull, stray }
    }

    /// Those up to a place at which a generator enters: what only touches there is none of them.
    pub(super) fn shorten(&mut self, to: Disc) {
        self.to = to;
        (self.hull, self.stray) = reach(self.from, to, self.way, [self.tie, -self.tie]);
    }

    /// A chord and a distance within which all of them lie, with a form of the bisector.
    pub(super) fn swath(&self, form: &Form) -> ([Spot; 2], f64) {
        let [(p, r), (q, s)] = [self.from, self.to];
        let (reach, stray) = if self.is_convex {
            (r.max(s), 2.0 * self.stray)
        } else {
            (form.distance(p.midpoint(q)).max(r).max(s), (q - p).length() / 2.0)
        };
        ([p, q], reach + stray + MARGIN)
    }

    /// Whether a generator surely enters none of them.
    pub(super) fn misses(&self, form: &Form) -> bool {
        let Hull { ends: [p, q], radii: [r, s], .. } = self.hull;
        let is_out = || match *form {
            Form::Circle { center, radius, hollow: false, .. } => self.hull.off(center) >= radius,
            // Concave, so no nearer than evenly between the ends.
            Form::Circle { .. } => form.distance(p) >= r && form.distance(q) >= s,
            Form::Line { from, along, length } => {
                let out = SNAP + self.stray;
                let off = [p, q].map(|end| form.distance(end));
                // Their feet beyond its ends, or themselves behind it.
                let is_elsewhere = || {
                    let feet = [p, q].map(|end| along.dot(end - from));
                    off[0].max(off[1]) < -out
                        || feet[0].max(feet[1]) < -out
                        || feet[0].min(feet[1]) > length + out
                };
                (off[0] >= r && off[1] >= s) || is_elsewhere()
            }
        };
        self.is_convex && is_out()
    }
}

/// The hull of two discs, the first of them smaller by one length and the other larger by another
/// than they are, and what lies between them on the bisector; how far that strays from the chord.
///
/// No farther than the direction in which it begins leads away, for it turns by less than a
/// quarter; and where it strays clearance and distance change by no more than that.
fn reach((p, r): Disc, (q, s): Disc, way: Option<Spot>, [less, more]: [f64; 2]) -> (Hull, f64) {
    let stray = way.map_or(0.0, |way| way.cross(q - p).abs());
    (Hull::new([p, q], [r - less, s + 2.0 * stray + more]), stray)
}

/// The hull of two discs.
struct Hull {
    ends: [Spot; 2],
    radii: [f64; 2],
    /// The direction from one to the other, and how far that is.
    along: Spot,
    length: f64,
    /// The normal of a tangent of both, along and across the chord.
    normal: Spot,
}

impl Hull {
    fn new(ends: [Spot; 2], radii: [f64; 2]) -> Self {
        let chord = ends[1] - ends[0];
        let length = chord.length();
        // Where one lies within the other they have none.
        let taper = if length > 0.0 { ((radii[0] - radii[1]) / length).clamp(-1.0, 1.0) } else { 0.0 };
        let normal = Spot::new(taper, (1.0 - taper * taper).sqrt());
        Self { ends, radii, along: unit(chord), length, normal }
    }

    /// How far a place lies outside, or less than zero within.
    fn off(&self, p: Spot) -> f64 {
        let [from, to] = self.ends.map(|end| p - end);
        // On the side of the place.
        let place = Spot::new(self.along.dot(from), self.along.cross(from).abs());
        let beside = clockwise(self.normal).dot(place);
        if self.radii[0] - self.radii[1] >= self.length || (beside <= 0.0 && self.normal.y > 0.0) {
            from.length() - self.radii[0]
        } else if beside >= self.length * self.normal.y {
            to.length() - self.radii[1]
        } else {
            self.normal.dot(place) - self.radii[0]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_lies_outside_the_hull_of_two_discs_by_its_distance_from_all_between() {
        let discs = [(3.0, 1.0), (1.0, 3.0), (2.0, 2.0), (6.0, 0.5), (0.5, 6.0), (0.0, 0.0), (9.0, 1.0)];
        for ((r, s), turn) in discs.into_iter().zip(1_u8..) {
            let chord = Spot::new(f64::from(turn), 4.0 - f64::from(turn));
            let hull = Hull::new([Spot::default(), chord], [r, s]);
            for i in 0_u8..=200 {
                let p = Spot::new(f64::from(i % 14) - 5.0, f64::from(i / 14) - 6.0) * 1.3;
                let parts = (0_u16..=4000).map(|part| f64::from(part) / 4000.0);
                let off =
                    parts.map(|t| (p - chord * t).length() - (r + (s - r) * t)).fold(f64::INFINITY, f64::min);
                let found = hull.off(p);
                assert!((found - off).abs() < 1e-5, "{found} is not {off} at {p:?}, {r} and {s}");
            }
        }
    }
}
