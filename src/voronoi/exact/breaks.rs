//! Breaks: the places on a generator where another one begins or ends with the same foot.

use rayon::prelude::*;

use super::form::{Form, Place};
use super::generator::Generators;
use super::index::Index;
use super::tolerances::SLAB;
use crate::topology::Groups;
use crate::voronoi::plane::Spot;

/// So far from a foot its normal is looked at, in nanometres. Chosen.
const AHEAD: f64 = 1_000.0;

/// How many generators one worker takes. Chosen.
const SHARE: usize = 1024;

/// The breaks of all generators, which only who walks along edges must know.
pub(super) type Breaks = Groups<Place>;

/// The places on each generator where distances that differ by less than `tie` are equal.
pub(super) fn breaks(generators: &Generators, index: &Index, tie: f64) -> Breaks {
    let numbers: Vec<u32> = (0_u32..).take(generators.len()).collect();
    let touching = |some: &[u32]| touching_ends(generators, index, tie, some);
    let mut found = numbers.par_chunks(SHARE).map(touching).collect::<Vec<_>>().concat();
    // A disc on its own has two all the same, so that no loop round it is without a vertex.
    let mut counts = vec![0_u32; generators.len()];
    found.iter().for_each(|(generator, _)| counts[*generator as usize] += 1);
    for (i, (form, &count)) in (0_u32..).zip(generators.forms.iter().zip(&counts)) {
        if count < 2 && matches!(form, Form::Circle { sector: None, .. }) {
            found.extend([1.0, -1.0].map(|x| (i, Place::Toward(Spot::new(x, 0.0)))));
        }
    }
    Groups::new(generators.len(), found.iter().copied())
}

/// The places on generators where a line or an arc, of some of them, ends with the same foot and
/// normal.
fn touching_ends(generators: &Generators, index: &Index, tie: f64, some: &[u32]) -> Vec<(u32, Place)> {
    let mut found: Vec<(u32, Place)> = Vec::with_capacity(4 * some.len());
    let mut near: Vec<u32> = Vec::new();
    for &i in some {
        let form = &generators.forms[i as usize];
        for place in form.ends().into_iter().flatten() {
            let (foot, normal) = form.foot(place);
            // A disc of no radius has its normal a little way off.
            let ahead = foot + normal * AHEAD;
            let touches = |other: u32| {
                let touched = &generators.forms[other as usize];
                other != i
                    && touched.distance(foot).abs() <= tie
                    && touched.slack(ahead) >= -SLAB
                    && touched.away(ahead).dot(normal) > 1.0 - 1e-9
            };
            near.clear();
            index.visit_round(foot, tie, |other| near.extend(touches(other).then_some(other)));
            near.sort_unstable();
            near.dedup();
            found.extend(near.iter().map(|&other| (other, generators.forms[other as usize].place(ahead))));
        }
    }
    found
}
