//! The edge of a board: the closed contours along which it is cut out of its sheet.

use crate::geometry::{Nm, Path, Polygon, Rect, RectIndex};

use super::FLATTEN;

/// The edge of a board: closed contours along which it is cut out.
///
/// # Guarantees
///
/// At least one contour; every contour is closed, has an area, and touches no other. A contour
/// inside an odd number of others is a cut-out, the rest are boards (several in a panel).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outline {
    contours: Vec<Path>,
}

impl Outline {
    /// The outline made of `contours`, without those that are not closed; none where no contour is
    /// left.
    #[must_use]
    pub fn new(mut contours: Vec<Path>) -> Option<Self> {
        contours.retain(Path::is_closed);
        (!contours.is_empty()).then_some(Self { contours })
    }

    /// The closed contours, boards and cut-outs alike.
    #[must_use]
    pub fn contours(&self) -> &[Path] {
        &self.contours
    }

    /// A rectangle that holds all contours.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        let first = self.contours[0].bounds();
        self.contours.iter().fold(first, |bounds, contour| bounds.union(contour.bounds()))
    }

    /// Takes out those cut-outs that something else makes, as `is_made` says.
    pub(crate) fn drop_cut_outs(&mut self, is_made: impl Fn(&Path) -> bool) {
        for (number, _, is_cut_out) in self.rings(FLATTEN).into_iter().rev() {
            if is_cut_out && is_made(&self.contours[number]) {
                self.contours.remove(number);
            }
        }
    }

    /// The contours flattened within `tolerance`, each turned so that the non-zero rule fills the
    /// board and leaves its cut-outs empty: boards counter-clockwise, cut-outs clockwise.
    #[must_use]
    pub fn polygon(&self, tolerance: Nm) -> Polygon {
        let turned = self.rings(tolerance).into_iter().map(|(_, ring, is_cut_out)| {
            let mut points = ring.contours()[0].clone();
            if (ring.area_mm2() > 0.0) == is_cut_out {
                points.reverse();
            }
            points
        });
        Polygon::new(turned.collect()).unwrap_or_else(|| Polygon::rectangle(self.bounds()))
    }

    /// The contours flattened within `tolerance`, each with its number, and whether it is a
    /// cut-out; without those that have no area then.
    fn rings(&self, tolerance: Nm) -> Vec<(usize, Polygon, bool)> {
        let ring = |(number, contour): (usize, &Path)| {
            let mut points = contour.flatten(tolerance);
            points.pop();
            Some((number, Polygon::new(vec![points])?))
        };
        let rings: Vec<(usize, Polygon)> = self.contours.iter().enumerate().filter_map(ring).collect();
        let index = RectIndex::new(rings.iter().map(|(_, ring)| ring.bounds()));
        let is_cut_out = |i: usize| {
            let probe = rings[i].1.contours()[0][0];
            let near = index.touching(Rect::new(probe, probe));
            near.into_iter().filter(|&j| j != i && rings[j].1.contains(probe)).count() % 2 == 1
        };
        let are_cut_outs: Vec<bool> = (0..rings.len()).map(is_cut_out).collect();
        rings
            .into_iter()
            .zip(are_cut_outs)
            .map(|((number, ring), is_cut_out)| (number, ring, is_cut_out))
            .collect()
    }
}
