//! Areas made smaller: what of them is farther from their edges than a distance.
//!
//! Where an area is narrow, or its edge has many chords, edges that are moved inwards cross each
//! other as often as there are pairs of them, and a boolean that sorts that out takes minutes. A
//! level set of the certified [diagram](crate::voronoi::exact) crosses nothing.

use rayon::prelude::*;

use super::Interior;
use super::nest::rings;
use crate::board::polarity::clean;
use crate::geometry::{Nm, Point, Polygon};

/// What of areas is at least `by` from every edge, which must be more than nothing; polygons as a
/// boolean returns them. Of an area whose diagram has a flaw an exact boolean answers.
#[must_use]
pub fn insets(areas: &[Interior<'_>], by: Nm) -> Vec<Polygon> {
    let height = by.to_f64();
    let inset = |area: &Interior<'_>| {
        let diagram = area.diagram();
        let known = diagram.faults().is_empty().then(|| diagram.level_set(height)).flatten();
        let place = |(x, y): (f64, f64)| Point::from_f64(x, y);
        let points = |ring: Vec<(f64, f64)>| ring.into_iter().map(place).collect();
        clean(&rings(known, area.area(), height).into_iter().map(points).collect::<Vec<_>>())
    };
    areas.par_iter().flat_map_iter(inset).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::FLATTEN;
    use crate::board::polarity::{difference, offset};
    use crate::topology::random;

    #[test]
    fn an_inset_is_what_a_boolean_makes_of_it() {
        let mut below = random();
        for number in 0..40 {
            let corners = 5 + below(20);
            let mut corner = |i: i64| {
                let far = 1e6 + Nm::new(below(4_000_000)).to_f64();
                let (sin, cos) =
                    libm::sincos(std::f64::consts::TAU * Nm::new(i).to_f64() / Nm::new(corners).to_f64());
                Point::from_f64(far * cos, far * sin)
            };
            let areas = clean(&[(0..corners).map(&mut corner).collect()]);
            let interiors = Interior::all(&areas);
            for by in [1, 150, 600, 1_500, 9_000].map(Nm::from_um) {
                let ours = insets(&interiors, by);
                let theirs: Vec<Polygon> = areas.iter().flat_map(|area| offset(area, -by, FLATTEN)).collect();
                let beyond = |one: &[Polygon], other: &[Polygon]| -> f64 {
                    one.iter().flat_map(|piece| difference(piece, other)).map(|piece| piece.area_mm2()).sum()
                };
                // Half a micrometre along edges of some 50 mm.
                let (more, less) = (beyond(&ours, &theirs), beyond(&theirs, &ours));
                assert!(more + less < 0.025, "area {number} by {by}: {more} mm² more, {less} mm² less");
            }
        }
    }
}
