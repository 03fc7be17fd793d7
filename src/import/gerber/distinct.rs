//! Copper drawn more than once in one place.
//!
//! A file may draw the same thing in the same place any number of times, and all that comes after
//! looks at pairs of features that overlap: ten thousand equal flashes are a hundred million pairs.
//! What is drawn again adds nothing, so it goes here, where a look at a table tells.

use std::hash::{Hash, Hasher};

use rustc_hash::{FxHashMap, FxHasher};

use super::canvas::Object;

/// `objects` without those that one before them has drawn already, with nothing of the other
/// polarity between the two.
pub(super) fn distinct(objects: Vec<Object>) -> Vec<Object> {
    let mut kept: Vec<Object> = Vec::with_capacity(objects.len());
    let mut drawn: FxHashMap<u64, usize> = FxHashMap::default();
    for object in objects {
        if kept.last().is_some_and(|before| before.1 != object.1) {
            drawn.clear();
        }
        let mut key = hash(&object);
        // Where two hashes are alike and the objects are not, the next number is as good.
        let is_new = loop {
            match drawn.get(&key) {
                None => break true,
                Some(&before) if is_same(&kept[before], &object) => break false,
                Some(_) => key = key.wrapping_add(1),
            }
        };
        if is_new {
            drawn.insert(key, kept.len());
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
    fn what_is_drawn_again_goes_unless_something_was_erased_between() {
        let disc = |x: i64, attributes: u32, line: u32| {
            let center = Point::new(Nm::from_um(x), Nm::ZERO);
            let shape = Shape::Disc { center, radius: Nm::from_um(500) };
            Feature { shape, axis: Axis::Flash(center), attributes, line }
        };
        let drawn = vec![
            (disc(0, 0, 1), Dark),
            (disc(0, 0, 2), Dark),
            (disc(0, 1, 3), Dark),
            (disc(100, 0, 4), Dark),
            (disc(0, 0, 5), Clear),
            (disc(0, 0, 6), Clear),
            (disc(0, 0, 7), Dark),
        ];
        let lines: Vec<u32> = distinct(drawn).iter().map(|(feature, _)| feature.line).collect();
        assert_eq!(
            lines,
            [1, 3, 4, 5, 7],
            "the first of each, of each attribute set, and again after an erasure"
        );
    }
}
