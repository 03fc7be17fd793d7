//! The edge of a board: the closed contours along which it is cut out of its sheet.

use crate::geometry::{Nm, Path, Polygon, Rect, RectIndex};

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

    /// The contours flattened within `tolerance`, each turned so that the non-zero rule fills the
    /// board and leaves its cut-outs empty: boards counter-clockwise, cut-outs clockwise.
    #[must_use]
    pub fn polygon(&self, tolerance: Nm) -> Polygon {
        let rings: Vec<Polygon> = self
            .contours
            .iter()
            .filter_map(|contour| {
                let mut points = contour.flatten(tolerance);
                points.pop();
                Polygon::new(vec![points])
            })
            .collect();
        let index = RectIndex::new(rings.iter().map(Polygon::bounds));
        let turned = rings.iter().enumerate().map(|(i, ring)| {
            let probe = ring.contours()[0][0];
            let near = index.touching(Rect::new(probe, probe));
            let around = near.into_iter().filter(|&j| j != i && rings[j].contains(probe)).count();
            let mut points = ring.contours()[0].clone();
            if (ring.area_mm2() > 0.0) == (around % 2 == 1) {
                points.reverse();
            }
            points
        });
        Polygon::new(turned.collect()).unwrap_or_else(|| Polygon::rectangle(self.bounds()))
    }
}
