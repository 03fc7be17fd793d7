//! Parallels of generators, of which level sets are made: lines and arcs from the foot of one place
//! to that of the next.

use super::Diagram;
use super::form::{Form, Place, halfway, turn};
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::{CHORD, Sample};

/// Ends of a parallel that are so near to each other the wrong way round, in nanometres, are one:
/// where a level all but touches an edge, it crosses anywhere near.
/// Chosen: more than rounding leaves; no net is open by so little.
const BACK: f64 = 2_000.0;

/// A piece of a level set: the parallel of a generator from the foot of one place to that of
/// another, and the crossing that ends it there, if one does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    pub(super) generator: u32,
    pub(super) from: Spot,
    pub(super) to: Spot,
    pub(super) crossing: Option<usize>,
}

impl Diagram {
    /// Places along the parallels of generators, `level` nanometres away; if it `returns` to where
    /// it begins, a single one goes all the way round, and none else that ends where it begins.
    pub(super) fn leg_samples(&self, legs: &[Leg], level: f64, returns: bool) -> Vec<Sample> {
        let mut samples: Vec<Sample> = Vec::new();
        let mut add = |at: Spot| {
            if samples.last().is_none_or(|last| (last.at - at).length() > 1.0) {
                samples.push(Sample { at, clearance: level });
            }
        };
        for leg in legs {
            let form = &self.forms()[leg.generator as usize];
            let along = |place: Place| {
                let (foot, normal) = form.foot(place);
                foot + normal * level
            };
            let places = [place_from(form, leg.from, true), place_from(form, leg.to, false)];
            // A vertex on the corner itself has no direction from it: the legs before and behind
            // say where its parallel begins and ends.
            let is_somewhere = |place: &Place| !matches!(place, Place::Toward(u) if u.length() == 0.0);
            if !places.iter().all(is_somewhere) {
                places.into_iter().filter(is_somewhere).for_each(|place| add(along(place)));
                continue;
            }
            match (*form, places[0], places[1]) {
                (Form::Circle { center, radius, hollow, .. }, Place::Toward(u), Place::Toward(v)) => {
                    let out = if hollow { radius - level } else { radius + level };
                    add(center + u * out);
                    let closed = leg.from == leg.to
                        && match form.around(leg.from) {
                            Some(sector) => sector.is_none(),
                            None => returns && legs.len() == 1,
                        };
                    let is_back = (u - v).length() * out < BACK && swept(form.sense_on_left(), u, v) > 2.0;
                    if is_back && !closed {
                        continue;
                    }
                    arc(center, out, [u, v], form.sense_on_left(), closed, &mut add);
                }
                (_, from, to) => {
                    add(along(from));
                    add(along(to));
                }
            }
        }
        samples
    }
}

/// The place of the foot of `p`, at which the parallel begins or ends. From its centre an arc is
/// everywhere: there it has come to its end.
fn place_from(form: &Form, p: Spot, begins: bool) -> Place {
    match form.around(p) {
        Some(Some([first, last])) => Place::Toward(if begins { last } else { first }),
        Some(None) => Place::Toward(Spot::new(1.0, 0.0)),
        None => form.place(p),
    }
}

/// Samples that begin and end at two places which theirs miss by rounding.
pub(super) fn between(mut samples: Vec<Sample>, [from, to]: [Spot; 2]) -> Vec<Sample> {
    if samples.len() < 2 {
        let clearance = samples.first().map_or(0.0, |sample| sample.clearance);
        samples = [from, to].map(|at| Sample { at, clearance }).to_vec();
    }
    let last = samples.len() - 1;
    (samples[0].at, samples[last].at) = (from, to);
    samples
}

/// Legs along the same generator made one. Round a circle each stays apart: of one that goes back
/// by rounding nobody could tell that it does not go all the way round.
pub(super) fn joined(legs: Vec<Leg>, forms: &[Form]) -> Vec<Leg> {
    let mut joined: Vec<Leg> = Vec::with_capacity(legs.len());
    for leg in legs {
        match joined.last_mut() {
            Some(last)
                if last.generator == leg.generator
                    && last.crossing.is_none()
                    && matches!(forms[leg.generator as usize], Form::Line { .. }) =>
            {
                (last.to, last.crossing) = (leg.to, leg.crossing);
            }
            _ => joined.push(leg),
        }
    }
    joined
}

/// How far an arc turns from one direction to another, as [`turn`] measures.
fn swept(sense: f64, u: Spot, v: Spot) -> f64 {
    if sense > 0.0 { turn(u, v) } else { turn(v, u) }
}

/// Shows places along an arc behind its first, so dense that chords follow it.
fn arc(center: Spot, radius: f64, [u, v]: [Spot; 2], sense: f64, closed: bool, add: &mut impl FnMut(Spot)) {
    let swept = swept(sense, u, v);
    if closed || (1.0..4.0 - 1e-9).contains(&swept) {
        let middle = if closed { u * -1.0 } else { halfway(u, v, sense) };
        arc(center, radius, [u, middle], sense, false, add);
        arc(center, radius, [middle, v], sense, false, add);
        return;
    }
    let mut halvings = 0;
    if (1e-9..1.0).contains(&swept) {
        // The height of the arc over its chord, over half of it, and so on.
        let half = |cos: f64| ((1.0 + cos.clamp(-1.0, 1.0)) / 2.0).sqrt();
        let mut cos = half(u.dot(v));
        while radius * (1.0 - cos) > CHORD {
            (cos, halvings) = (half(cos), halvings + 1);
        }
    }
    halved([u, v], sense, halvings, &mut |v| add(center + v * radius));
}

/// Shows the directions between two and the second, halved so often.
fn halved([u, v]: [Spot; 2], sense: f64, halvings: u32, add: &mut impl FnMut(Spot)) {
    if halvings == 0 {
        return add(v);
    }
    let middle = halfway(u, v, sense);
    halved([u, middle], sense, halvings - 1, add);
    halved([middle, v], sense, halvings - 1, add);
}
