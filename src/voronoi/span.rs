//! The curve between two neighbouring vertices of a boundary.
//!
//! ```text
//!         C         A boundary consists of conics: lines between two straight edges, parabolas between an edge and a corner,
//!       ╱   ╲       hyperbolas and ellipses between discs and arcs. A vertex knows its place and its course, so the curve to the
//!     ╱  ___  ╲     next one is the quadratic Bézier curve whose control point C lies where the two tangents meet: a parabola
//!    ●╱       ╲●    exactly, and the others to the fourth order of its length. Few vertices then say what chords would need many
//!   a           b   for, and finding them is what costs.
//! ```
//!
//! The clearance along the curve is the cubic that has the vertices' clearances and rises: along a
//! parabola, exact again.
//!
//! Where a boundary has a corner, two vertices lie in one place, each with its own course. Where
//! nothing is known of the way between two places, it is their chord.

use super::plane::Spot;

/// How far chords may leave a curve, in nanometres. Chosen: less than a tenth of the default
/// fitting tolerance, so that fitting has the rest.
pub(super) const CHORD: f64 = 150.0;
/// How far the true boundary may leave the curve between two vertices where it is probed, in
/// nanometres. Chosen: what remains of it between the probe, which becomes a vertex, and its
/// neighbours is a sixteenth of that.
const BEND: f64 = 200.0;
/// The same for the clearance.
const CLEARANCE_BEND: f64 = 1_000.0;
/// A step along a curve, as a part of it, that is not worth another. Chosen: a thousandth of a
/// nanometre on curves of a millimetre.
const FOUND: f64 = 1e-9;
/// How many times longer one tangent of a curve may be than the other. Derived: where it is less, a
/// corner that a probe misses is off by less than [`BEND`].
const UNEVEN: f64 = 3.0;
/// How far the clearance may leave its chord between two samples, in nanometres.
pub(super) const CLEARANCE_CHORD: f64 = 1_000.0;
/// Where the slope of an equation is less, it leads nowhere, and says nothing of a course.
pub(super) const LEVEL: f64 = 1e-3;
/// A vertex that a curve passes by so closely need not be kept, in nanometres. Chosen: a tenth of
/// what probes find good enough.
const PASSED: f64 = 20.0;
/// The same for the clearance.
const PASSED_CLEARANCE: f64 = 100.0;
/// So many vertices in a row are taken out at most, less one: all of them are looked at for each.
const MOST_PASSED: usize = 12;
/// A curve is cut into so many chords at most. Chosen: one of a metre needs fewer.
const MOST_CHORDS: u32 = 4096;

/// A point of a boundary. Its place has all digits; what is interpolated from has enough of them to
/// be a thing of 32 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Vertex {
    pub(super) at: Spot,
    clearance: f32,
    along: [f32; 2],
    rise: f32,
}

const _: () = assert!(size_of::<Vertex>() == 32, "boundaries are kept as vertices until they are whole");

impl Vertex {
    /// A point `clearance` nanometres from the nearest copper, where the boundary has no known
    /// course.
    pub(super) const fn new(at: Spot, clearance: f64) -> Self {
        Self { at, clearance: short(clearance), along: [0.0; 2], rise: 0.0 }
    }

    /// The same on the course across which `slope` points, where `away` leads straight away from
    /// the copper; on none if `slope` is nothing.
    pub(super) fn across(at: Spot, clearance: f64, slope: Spot, away: Spot) -> Self {
        let steepness = slope.length();
        if steepness < LEVEL {
            return Self::new(at, clearance);
        }
        let along = Spot::new(-slope.y, slope.x) * (1.0 / steepness);
        let rise = away.dot(along);
        Self { along: [short(along.x), short(along.y)], rise: short(rise), ..Self::new(at, clearance) }
    }

    /// Whether it is known where it leads.
    pub(super) fn has_course(self) -> bool {
        self.along.iter().any(|along| along.abs() > 0.0)
    }

    /// The two places without their courses: from the one to the other leads the chord.
    pub(super) fn chord(self, to: Self) -> [Self; 2] {
        [self, to].map(|vertex| Self::new(vertex.at, vertex.clearance()))
    }

    /// Whether it lies between two others. One that ran off along the boundary would fold the path
    /// back on itself.
    pub(super) fn is_between(self, from: Self, to: Self) -> bool {
        let way = to.at - from.at;
        (self.at - from.at).dot(way) > 0.0 && (to.at - self.at).dot(way) > 0.0
    }

    /// How far `p` is from the farther of the two places that the vertex is nearest to, on either
    /// side of its course.
    fn reaches(self, p: Spot) -> f64 {
        let (way, along, clearance, rise) =
            (p - self.at, self.along(), self.clearance(), f64::from(self.rise));
        let across = (1.0 - rise * rise).max(0.0).sqrt();
        let outward = rise * way.dot(along) + across * way.cross(along).abs();
        (clearance * clearance + way.dot(way) + 2.0 * clearance * outward).sqrt()
    }

    /// The distance to the nearest copper, in nanometres.
    pub(super) fn clearance(self) -> f64 {
        f64::from(self.clearance)
    }

    /// The direction of the boundary, one way or the other; zero where it is not known.
    pub(super) fn along(self) -> Spot {
        Spot::new(f64::from(self.along[0]), f64::from(self.along[1]))
    }

    /// Whether another vertex in the same place has the same course.
    pub(super) fn is_smooth_with(self, other: Self) -> bool {
        self.along().cross(other.along()).abs() < 1e-4
    }
}

#[expect(clippy::cast_possible_truncation, reason = "24 bits are enough for what is interpolated from")]
const fn short(value: f64) -> f32 {
    value as f32
}

/// A place on the way between vertices, in nanometres, with its clearance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    pub(super) at: Spot,
    pub(super) clearance: f64,
}

/// The curve from one vertex to the next.
pub(super) struct Span {
    from: Vertex,
    to: Vertex,
    /// Where the tangents meet.
    control: Spot,
}

impl Span {
    /// The curve between two vertices; their chord where their courses do not lead from the one to
    /// the other.
    pub(super) fn new(from: Vertex, to: Vertex) -> Self {
        let control = control(from, to).unwrap_or_else(|| from.at.midpoint(to.at));
        Self { from, to, control }
    }

    /// The place at `t` from 0 to 1.
    pub(super) fn place(&self, t: f64) -> Spot {
        let s = 1.0 - t;
        self.from.at * (s * s) + self.control * (2.0 * s * t) + self.to.at * (t * t)
    }

    /// The vertex at `t` of a curve at one level.
    pub(super) fn vertex(&self, t: f64) -> Vertex {
        let speed = self.speed(t);
        Vertex::across(self.place(t), self.clearance(t), Spot::new(speed.y, -speed.x), Spot::default())
    }

    /// How fast the place moves with `t`.
    fn speed(&self, t: f64) -> Spot {
        ((self.control - self.from.at) * (1.0 - t) + (self.to.at - self.control) * t) * 2.0
    }

    /// How fast the clearance grows with `t` at both ends.
    fn rises(&self) -> (f64, f64) {
        let rise = |vertex: Vertex, t: f64| f64::from(vertex.rise) * vertex.along().dot(self.speed(t));
        (rise(self.from, 0.0), rise(self.to, 1.0))
    }

    /// The clearance at `t`.
    pub(super) fn clearance(&self, t: f64) -> f64 {
        let (a, b) = (self.from.clearance(), self.to.clearance());
        let (rise, fall) = self.rises();
        let s = 1.0 - t;
        s * s * ((1.0 + 2.0 * t) * a + t * rise) + t * t * ((1.0 + 2.0 * s) * b - s * fall)
    }

    /// Whether a point of the true boundary, somewhere half way, lies on the curve and runs along
    /// it, with the curve's clearance.
    ///
    /// A boundary that bends one way and then the other may cross the curve half way; then it does
    /// so at an angle. A cubic that crosses at an angle whose sine is s leaves a curve of length L
    /// by 0.19 s L.
    pub(super) fn holds(&self, probe: Vertex) -> bool {
        self.is_near(probe, BEND, CLEARANCE_BEND)
    }

    /// The same, with how far it and its clearance may be off.
    fn is_near(&self, probe: Vertex, bend: f64, clearance: f64) -> bool {
        let Some(t) = self.parameter(probe.at).filter(|_| self.is_even()) else { return false };
        let speed = self.speed(t);
        (probe.at - self.place(t)).length() <= bend
            && 0.19 * speed.cross(probe.along()).abs() <= bend
            && (probe.clearance() - self.clearance(t)).abs() <= clearance
    }

    /// Whether the curve bends all along rather than at one end, where the boundary may have a
    /// corner that a probe half way does not see.
    fn is_even(&self) -> bool {
        let (before, after) = ((self.control - self.from.at).length(), (self.to.at - self.control).length());
        before.max(after) <= UNEVEN * before.min(after)
            || self.control.distance_to_chord(self.from.at, self.to.at) <= BEND
    }

    /// How far the curve leaves its chord at most, in nanometres.
    pub(super) fn bulge(&self) -> f64 {
        self.control.distance_to_chord(self.from.at, self.to.at) / 2.0
    }

    /// How far apart its ends are, in nanometres.
    pub(super) fn length(&self) -> f64 {
        (self.to.at - self.from.at).length()
    }

    /// Whether its ends tell how far the middle is from both its regions, within twice `most`
    /// nanometres: no farther than their nearest places of the ends, and no nearer than what lies
    /// outside the discs round the ends, which are empty. Nothing can then come nearer to the curve
    /// than it knows by more than `most`.
    pub(super) fn is_known_within(&self, most: f64) -> bool {
        if !self.from.has_course() || !self.to.has_course() {
            return false;
        }
        let (middle, length) = (self.place(0.5), self.length());
        let (a, b) = (self.from.clearance(), self.to.clearance());
        // The square of a median: what is as far from both ends is nearest to the middle on the
        // chord's perpendicular.
        let nearest = f64::midpoint(a * a, b * b) - length * length / 4.0;
        let farthest =
            [self.from, self.to].map(|end| end.reaches(middle)).into_iter().fold(f64::INFINITY, f64::min);
        nearest > 0.0 && farthest - nearest.sqrt() <= 2.0 * most
    }

    /// How far along the chord the foot of `p` lies, from 0 to 1.
    pub(super) fn foot(&self, p: Spot) -> f64 {
        let chord = self.to.at - self.from.at;
        ((p - self.from.at).dot(chord) / chord.dot(chord)).clamp(0.0, 1.0)
    }

    /// Where the curve is as far along the chord as `p`; none where `p` lies before or behind it.
    fn parameter(&self, p: Spot) -> Option<f64> {
        let chord = self.to.at - self.from.at;
        let (along, whole) = ((p - self.from.at).dot(chord), chord.dot(chord));
        if along <= 0.0 || along >= whole {
            return None;
        }
        let mut t = along / whole;
        for _ in 0..4 {
            let slope = self.speed(t).dot(chord);
            if slope <= 0.0 {
                return None;
            }
            let step = (self.place(t) - p).dot(chord) / slope;
            t = (t - step).clamp(0.0, 1.0);
            if step.abs() < FOUND {
                break;
            }
        }
        Some(t)
    }

    /// How many chords follow the curve and its clearance.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and positive")]
    fn chords(&self) -> u32 {
        let bend = (self.from.at - self.control * 2.0 + self.to.at).length() / 4.0;
        let (rise, fall) = self.rises();
        let growth = self.to.clearance() - self.from.clearance();
        let swing = (6.0 * growth - 4.0 * rise - 2.0 * fall)
            .abs()
            .max((4.0 * fall + 2.0 * rise - 6.0 * growth).abs())
            / 8.0;
        let squared = (bend / CHORD).max(swing / CLEARANCE_CHORD);
        (squared.sqrt().ceil().min(f64::from(MOST_CHORDS)) as u32).max(1)
    }
}

/// Where the tangents of two vertices meet, between the two; none where they do not.
fn control(from: Vertex, to: Vertex) -> Option<Spot> {
    let chord = to.at - from.at;
    let (out, back) = (from.along(), to.along());
    let turn = out.cross(back);
    if turn.abs() < 1e-9 {
        return None;
    }
    let control = from.at + out * (chord.cross(back) / turn);
    let (before, after) = (control - from.at, to.at - control);
    // Not more than a quarter turn, and onward all the way.
    (before.dot(chord) >= 0.0 && after.dot(chord) >= 0.0 && before.dot(after) >= 0.0).then_some(control)
}

/// Takes out the vertices that the curve between their neighbours passes through anyway: where
/// tiles met, for the most part.
pub(super) fn thin(vertices: &mut Vec<Vertex>) {
    let (mut kept, mut last) = (0, 0);
    for next in 2..vertices.len() {
        let span = Span::new(vertices[kept], vertices[next]);
        let passes = |probe: &Vertex| span.is_near(*probe, PASSED, PASSED_CLEARANCE);
        let held = next - last <= MOST_PASSED && vertices[last + 1..next].iter().all(passes);
        if !held {
            // The curve to the vertex before this one held all between.
            kept += 1;
            last = next - 1;
            vertices[kept] = vertices[last];
        }
    }
    if vertices.len() > 1 {
        let end = vertices[vertices.len() - 1];
        vertices.truncate(kept + 1);
        vertices.push(end);
    }
    vertices.shrink_to_fit();
}

/// Samples along all vertices, so dense that chords follow the curves between them.
pub(super) fn samples(vertices: &[Vertex]) -> Vec<Sample> {
    let Some(first) = vertices.first() else { return Vec::new() };
    let mut samples = Vec::with_capacity(2 * vertices.len());
    samples.push(Sample { at: first.at, clearance: first.clearance() });
    for pair in vertices.windows(2).filter(|pair| pair[0].at != pair[1].at) {
        let span = Span::new(pair[0], pair[1]);
        let count = span.chords();
        for i in 1..count {
            let t = f64::from(i) / f64::from(count);
            samples.push(Sample { at: span.place(t), clearance: span.clearance(t) });
        }
        samples.push(Sample { at: pair[1].at, clearance: pair[1].clearance() });
    }
    samples
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vertex of the parabola between the point (0, f) and the line y = -f, at x: y = x² / 4f, as
    /// far from both as y + f.
    fn on_parabola(x: f64, f: f64) -> Vertex {
        let slope = x / (2.0 * f);
        let length = (1.0 + slope * slope).sqrt();
        let across = Spot::new(slope / length, -1.0 / length);
        Vertex::across(Spot::new(x, x * x / (4.0 * f)), x * x / (4.0 * f) + f, across, Spot::new(0.0, 1.0))
    }

    #[test]
    fn a_parabola_is_exact() {
        let span = Span::new(on_parabola(-2e5, 3e5), on_parabola(5e5, 3e5));
        for t in [0.1, 0.5, 0.8] {
            let (place, clearance) = (span.place(t), span.clearance(t));
            let truth = on_parabola(place.x, 3e5);
            assert!((place.y - truth.at.y).abs() < 0.1, "{place:?} lies on {truth:?}");
            assert!((clearance - truth.clearance()).abs() < 0.1, "{clearance} is {truth:?}");
            assert!(span.holds(truth), "what lies on it is held: {truth:?}");
        }
        assert!(!span.holds(Vertex::new(Spot::new(1e5, 9e3), 3.1e5)), "what lies beside it is not");
    }

    #[test]
    fn samples_follow_the_curve_and_the_clearance() {
        let vertices = [on_parabola(-4e5, 2e5), on_parabola(4e5, 2e5)];
        let samples = samples(&vertices);
        assert!(samples.len() > 20, "{} samples", samples.len());
        for pair in samples.windows(2) {
            let truth = on_parabola(pair[0].at.midpoint(pair[1].at).x, 2e5);
            let off = truth.at.distance_to_chord(pair[0].at, pair[1].at);
            assert!(off <= CHORD + 0.1, "{off} nm off the chord");
        }
        let least = samples.iter().map(|sample| sample.clearance).fold(f64::INFINITY, f64::min);
        assert!((least - 2e5).abs() <= CLEARANCE_CHORD, "the narrowest place is seen: {least}");
    }

    #[test]
    fn vertices_on_one_curve_are_thinned_and_corners_are_kept() {
        let mut vertices: Vec<Vertex> =
            (-20..=20_i32).map(|i| on_parabola(f64::from(i) * 1e4, 3e5)).collect();
        vertices.push(Vertex::new(Spot::new(1e6, 0.0), 1e5));
        vertices.push(Vertex::new(Spot::new(1e6, 1e6), 1e5));
        let all = vertices.clone();
        thin(&mut vertices);
        assert!(vertices.len() < 9, "{} of {} vertices", vertices.len(), all.len());
        assert!(vertices.ends_with(&all[40..]), "the corner and the end: {vertices:?}");
        assert_eq!(vertices[0], all[0], "the start");
        let spans: Vec<Span> = vertices.windows(2).map(|pair| Span::new(pair[0], pair[1])).collect();
        for vertex in &all[1..40] {
            let is_passed = spans.iter().any(|span| span.is_near(*vertex, PASSED, PASSED_CLEARANCE));
            assert!(is_passed || vertices.contains(vertex), "still on the way: {vertex:?}");
        }
    }

    #[test]
    fn courses_that_lead_elsewhere_leave_the_chord() {
        let upward =
            |x: f64| Vertex::across(Spot::new(x, 0.0), 1e5, Spot::new(1.0, 0.0), Spot::new(1.0, 0.0));
        let samples = samples(&[upward(0.0), upward(1e6)]);
        assert_eq!(samples.len(), 2, "{samples:?}");
    }
}
