//! The union of shapes that overlap, in halves by place.
//!
//! Of shapes that lie on each other edges cross as often as there are pairs of shapes. What two
//! halves of them cover has few edges left to cross: those within are gone.
//!
//! ```text
//!  ╭───╮             ╭───╮
//!  │ ╭─┼─╮   ╭───╮   │   ╰─╮
//!  ╰─┼─╯ │ ∪ │ ╭─┼─╮ ╰─╮   │ …
//!    ╰───╯   ╰─┼─╯ │   ╰───╯
//!              ╰───╯
//! ```

use super::effort::Effort;
use crate::board::polarity::{self, TooMuch};
use crate::geometry::{Polygon, RectIndex};

/// What one boolean works out whatever it is of, in vertices. Chosen: less than a second.
const LITTLE: u64 = 250_000;

/// What `polygons`, each simple, cover, one for each connected piece: by one boolean, unless edges
/// that cross are most of a large one.
///
/// # Errors
///
/// [`TooMuch`] for polygons made to keep a program busy.
pub fn united(polygons: &[Polygon]) -> Result<Vec<Polygon>, TooMuch> {
    if crossed(polygons.iter()) <= vertices(polygons.iter()).max(LITTLE) {
        return Ok(merged(polygons.iter()));
    }
    let index = RectIndex::new(polygons.iter().map(Polygon::bounds));
    let by_place: Vec<&Polygon> = index.order().into_iter().map(|i| &polygons[i]).collect();
    halves(&by_place, &mut Effort::default())
}

fn halves(polygons: &[&Polygon], effort: &mut Effort) -> Result<Vec<Polygon>, TooMuch> {
    let crossing = crossed(polygons.iter().copied());
    if polygons.len() < 2 || crossing <= vertices(polygons.iter().copied()) {
        effort.spend(crossing)?;
        return Ok(merged(polygons.iter().copied()));
    }
    let (some, others) = polygons.split_at(polygons.len() / 2);
    let both = [halves(some, effort)?, halves(others, effort)?].concat();
    effort.spend(crossed(both.iter()))?;
    Ok(merged(both.iter()))
}

/// The union by one boolean.
fn merged<'a>(polygons: impl Iterator<Item = &'a Polygon>) -> Vec<Polygon> {
    polarity::clean(&polygons.flat_map(Polygon::contours).cloned().collect::<Vec<_>>())
}

/// What one boolean takes for edges that cross or are near each other, in vertices.
fn crossed<'a>(polygons: impl Iterator<Item = &'a Polygon> + Clone) -> u64 {
    polarity::effort(polygons.clone().flat_map(Polygon::contours)) - vertices(polygons)
}

fn vertices<'a>(polygons: impl Iterator<Item = &'a Polygon>) -> u64 {
    polygons.flat_map(Polygon::contours).map(|ring| ring.len() as u64).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::FLATTEN;
    use crate::geometry::{Nm, Point};
    use crate::topology::random;

    /// Discs of 5 mm on a square of `side`.
    fn discs(count: usize, side: Nm) -> Vec<Polygon> {
        let mut below = random();
        let mut place = || Nm::new(below(side.get()));
        let disc = |_| Polygon::disc(Point::new(place(), place()), Nm::from_mm(5), FLATTEN);
        (0..count).map(disc).collect::<Option<_>>().expect("discs")
    }

    #[test]
    fn halves_cover_what_one_boolean_does() {
        let discs = discs(300, Nm::from_mm(80));
        let by_place: Vec<&Polygon> = discs.iter().collect();
        let mut effort = Effort::default();
        let ours = halves(&by_place, &mut effort).expect("little work");
        let theirs = polarity::union(&discs);
        assert_eq!(ours.len(), theirs.len(), "as many pieces");
        let more = polarity::remainder(&ours, &theirs).into_iter();
        let less = polarity::remainder(&theirs, &ours);
        let apart: f64 = more.chain(less).map(|piece| piece.area_mm2()).sum();
        // A nanometre along some metres of edges.
        assert!(apart < 1e-5, "{apart} mm² are covered by one alone");
    }

    #[test]
    fn shapes_that_lie_on_each_other_are_worked_out_in_halves() {
        let discs = discs(4_000, Nm::from_mm(10));
        let crossed = crossed(discs.iter());
        assert!(crossed > 16_000_000, "more than all may cost together: {crossed}");
        let covered = united(&discs).expect("little work, in halves");
        assert_eq!(covered.len(), 1, "one piece");
    }
}
