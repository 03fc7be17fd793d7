//! Copper drawn more than once in one place.
//!
//! A file may draw the same thing in the same place any number of times, and all that comes after
//! looks at pairs of features that overlap: ten thousand equal flashes are a hundred million pairs.
//! What is drawn again adds nothing, so it goes here, where a look at a table tells.

use std::hash::{Hash, Hasher};

use rustc_hash::{FxHashMap, FxHasher};

use super::canvas::Object;

/// How often a thing may be drawn in one place before the rest is left out. Not once, because the
/// paper's figures count what was drawn: a stroke drawn twice has no loose end, and widths are
/// averaged over all. Chosen: with two the widths of Table V were off in the last digit, with eight
/// they are as before.
const OFTEN: usize = 8;

/// `objects` without those that have been drawn [`OFTEN`] already, with nothing of the other
/// polarity in between.
pub(super) fn distinct(objects: Vec<Object>) -> Vec<Object> {
    let mut kept: Vec<Object> = Vec::with_capacity(objects.len());
    // The last of each that was kept, and how many of them were.
    let mut drawn: FxHashMap<u64, (usize, usize)> = FxHashMap::default();
    for object in objects {
        if kept.last().is_some_and(|before| before.1 != object.1) {
            drawn.clear();
        }
        let mut key = hash(&object);
        // Where two hashes are alike and the objects are not, the next number is as good.
        let times = loop {
            match drawn.get(&key) {
                None => break 0,
                Some(&(before, times)) if is_same(&kept[before], &object) => break times,
                Some(_) => key = key.wrapping_add(1),
            }
        };
        if times < OFTEN {
            drawn.insert(key, (kept.len(), times + 1));
            kept.push(object);
        }
    }
    kept
}

/// Whether two objects of one polarity are one: the line that drew them does not matter.
fn is_same((a, _): &Object, (b, _): &Object) -> bool {
    a.attributes == b.attributes && a.axis == b.axis && a.shape == b.shape
}

fn hash((feature, _): &Object) -> u64 {
    let mut hasher = FxHasher::default();
    (feature.attributes, &feature.axis, &feature.shape).hash(&mut hasher);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::polarity::Polarity::{Clear, Dark};
    use crate::board::{Axis, Feature, Shape};
    use crate::geometry::{Nm, Point};

    #[test]
    fn what_is_drawn_often_goes_unless_something_was_erased_between() {
        let disc = |x: i64, attributes: u32, line: u32| {
            let center = Point::new(Nm::from_um(x), Nm::ZERO);
            let shape = Shape::Disc { center, radius: Nm::from_um(500) };
            Feature { shape, axis: Axis::Flash(center), attributes, line }
        };
        let again = |at: i64, line: u32| (0..20).map(move |_| (at, line));
        let dark = again(0, 1).chain(again(100, 2)).map(|(x, line)| (disc(x, 0, line), Dark));
        let clear = again(0, 4).map(|(x, line)| (disc(x, 0, line), Clear));
        let drawn: Vec<_> =
            dark.chain([(disc(0, 1, 3), Dark)]).chain(clear).chain([(disc(0, 0, 5), Dark)]).collect();
        let kept = distinct(drawn);
        let count = |line: u32| kept.iter().filter(|(feature, _)| feature.line == line).count();
        let counts: Vec<usize> = (1..=5).map(count).collect();
        assert_eq!(
            counts,
            [OFTEN, OFTEN, 1, OFTEN, 1],
            "some of each place, of each attribute set, and again after an erasure"
        );
    }
}
