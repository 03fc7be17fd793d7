//! The course of an edge: places along it, as dense as wanted, and where its clearance turns or
//! passes a level.
//!
//! ```text
//!     a ●───────●───────● b      Between two places of an edge there is a third one: that whose
//!              mid               foot on one of the two generators lies midway. Halved again and
//!                                again it is as dense as wanted, whatever conic it is.
//! ```

use super::form::{Form, Place};
use super::pair::Pair;
use super::{Diagram, Edge, Vertex};
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::{CHORD, CLEARANCE_CHORD, Sample};

/// What chords may leave of the place and the clearance.
pub(super) const COURSE: [f64; 2] = [CHORD, CLEARANCE_CHORD];

/// An edge is looked at in so many halvings for where its clearance turns. Derived: a conic's turns
/// at most twice in a turn round it, and generators end there.
const HALVINGS: u32 = 2;

/// Places are found to so many nanometres. Chosen: a nanometre is rounded away in the end.
const EXACT: f64 = 1e-4;

impl Diagram {
    /// Points along an edge from its beginning to its end, with the distance to copper: chords stay
    /// within `tolerance` nanometres of it, but none is shorter than a nanometre.
    #[must_use]
    pub fn course(&self, edge: &Edge, tolerance: f64) -> Vec<((f64, f64), f64)> {
        self.points(edge, [tolerance, CLEARANCE_CHORD])
    }

    /// The same, with chords that stay within `tolerance` nanometres of the distance, too.
    #[must_use]
    pub fn profile(&self, edge: &Edge, tolerance: f64) -> Vec<((f64, f64), f64)> {
        self.points(edge, [tolerance; 2])
    }

    fn points(&self, edge: &Edge, tolerances: [f64; 2]) -> Vec<((f64, f64), f64)> {
        let mut samples = Vec::new();
        self.add_samples(edge, tolerances, &mut samples);
        samples.into_iter().map(|Sample { at, clearance }| ((at.x, at.y), clearance)).collect()
    }

    /// The unit vectors straight away from the generators on the left and on the right of an edge,
    /// at a place on it.
    #[must_use]
    pub fn away(&self, edge: &Edge, (x, y): (f64, f64)) -> [(f64, f64); 2] {
        [edge.left, edge.right].map(|generator| {
            let away = self.forms()[generator as usize].away(Spot::new(x, y));
            (away.x, away.y)
        })
    }

    /// Adds places along an edge from its beginning to its end, of which chords leave no more than
    /// the tolerances.
    pub(super) fn add_samples(&self, edge: &Edge, tolerances: [f64; 2], samples: &mut Vec<Sample>) {
        let (from, to) = (self.sample_at(edge.from), self.sample_at(edge.to));
        samples.push(from);
        self.pair_of(edge).halve((from, to), tolerances, 16, samples);
        samples.push(to);
    }

    /// A vertex as a place on its edges.
    pub(super) fn sample_at(&self, vertex: u32) -> Sample {
        let Vertex { at: (x, y), clearance, .. } = self.vertices[vertex as usize];
        Sample { at: Spot::new(x, y), clearance }
    }

    /// The two generators of an edge.
    pub(super) fn pair_of(&self, edge: &Edge) -> Pair {
        self.pair(edge.left, edge.right)
    }
}

impl Pair {
    /// The place midway between two of the bisector, by the foot on one of its generators.
    ///
    /// Between lines, and between corners that all but meet, it is straight, and its middle that of
    /// the chord: where lines turn by a hundred thousandth, or corners lie a nanometre apart, feet
    /// a fraction of a nanometre apart are those of places far apart.
    pub(super) fn midway(&self, a: Spot, b: Spot) -> Option<Sample> {
        if self.is_straight() {
            let at = a.midpoint(b);
            return Some(Sample { at, clearance: self.forms[0].distance(at) });
        }
        let main = self.main(a.midpoint(b));
        let form = &self.forms[main];
        let middle = form.place(a).halfway(form.place(b), self.sense(main))?;
        self.at(main, middle).map(|(at, clearance)| Sample { at, clearance })
    }

    /// Adds places between two of the bisector, until chords leave no more than the tolerances.
    pub(super) fn halve(
        &self,
        (a, b): (Sample, Sample),
        tolerances: [f64; 2],
        left: u32,
        samples: &mut Vec<Sample>,
    ) {
        if left == 0 || (b.at - a.at).length() < 1.0 {
            return;
        }
        let Some(middle) = self.midway(a.at, b.at) else { return };
        let is_off = middle.at.distance_to_chord(a.at, b.at) > tolerances[0];
        let straight = f64::midpoint(a.clearance, b.clearance);
        if is_off || (middle.clearance - straight).abs() > tolerances[1] {
            self.halve((a, middle), tolerances, left - 1, samples);
            samples.push(middle);
            self.halve((middle, b), tolerances, left - 1, samples);
        }
    }

    /// The places from one to another between which the clearance only rises or only falls.
    pub(super) fn stretches(&self, from: Sample, to: Sample) -> Vec<Sample> {
        let mut places = vec![from];
        self.halve_evenly(from, to, HALVINGS, &mut places);
        let mut stretches = vec![from];
        for pair in places.windows(2) {
            stretches.extend(self.turning(pair[0], pair[1]));
            stretches.push(pair[1]);
        }
        stretches
    }

    fn halve_evenly(&self, a: Sample, b: Sample, left: u32, places: &mut Vec<Sample>) {
        if left > 0
            && let Some(middle) = self.midway(a.at, b.at)
        {
            self.halve_evenly(a, middle, left - 1, places);
            self.halve_evenly(middle, b, left - 1, places);
        } else {
            places.push(b);
        }
    }

    /// How the clearance changes along the bisector, at a place on it.
    fn slope(&self, at: Spot) -> f64 {
        self.way(at).dot(self.forms[0].away(at))
    }

    /// Where between two places the clearance is least or greatest, if it is.
    fn turning(&self, a: Sample, b: Sample) -> Option<Sample> {
        let rises = |place: &Sample| self.slope(place.at) > 0.0;
        let first = rises(&a);
        (rises(&b) != first).then(|| self.last(a, b, |place| rises(place) == first))
    }

    /// The last place from one to another, which is not, that is as the first.
    fn last(&self, mut a: Sample, mut b: Sample, is_as_first: impl Fn(&Sample) -> bool) -> Sample {
        for _ in 0..60 {
            if (b.at - a.at).length() < EXACT {
                break;
            }
            let Some(middle) = self.midway(a.at, b.at) else { break };
            if is_as_first(&middle) { a = middle } else { b = middle }
        }
        a
    }

    /// Where the clearance passes a level, between two places on different sides of it: where the
    /// parallels of both generators cross, if rounding leaves that between them.
    pub(super) fn crossing(&self, a: Sample, b: Sample, level: f64) -> Spot {
        let rises = b.clearance > level;
        let halved = || self.last(a, b, |place| (place.clearance > level) != rises).at;
        self.parallels_cross(a.at, b.at, level).unwrap_or_else(halved)
    }

    /// The one place between two of the bisector at which both generators are `level` nanometres
    /// away.
    fn parallels_cross(&self, from: Spot, to: Spot, level: f64) -> Option<Spot> {
        let main = self.main(from.midpoint(to));
        let (form, sense) = (&self.forms[main], self.sense(main));
        let [start, end] = [from, to].map(|p| form.place(p));
        let progress = |place: Place| form.progress(start, place, sense);
        let is_between = |p: &Spot| {
            let is_level = |form: &Form| (form.distance(*p) - level).abs() < EXACT;
            self.forms.iter().all(is_level) && (0.0..progress(end)).contains(&progress(form.place(*p)))
        };
        let [left, right] = self.forms.map(|form| form.parallel(level));
        let mut found = left?.crossings(&right?).into_iter().flatten().filter(is_between);
        found.next().filter(|_| found.next().is_none())
    }
}
