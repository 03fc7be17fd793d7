//! What is cut out of a polygon: what touches neither its edge nor anything else that is cut is a
//! hole as it is, and needs no boolean. Most antipads of a plane are such.

use crate::geometry::{Edges, Point, Polygon, Rect, RectIndex, twice_area};

/// What is cut out of a polygon.
pub(super) struct Cuts<'a> {
    /// Each a ring inside the polygon that touches nothing.
    pub(super) holes: Vec<&'a Polygon>,
    /// All others that may reach it.
    pub(super) others: Vec<&'a Polygon>,
}

impl<'a> Cuts<'a> {
    /// `clips` sorted into those that leave holes in `subject` and others; what lies beside it is
    /// neither.
    pub(super) fn of(subject: &Polygon, clips: impl IntoIterator<Item = &'a Polygon>) -> Self {
        let clips: Vec<(&Polygon, Rect)> = clips.into_iter().map(|clip| (clip, clip.bounds())).collect();
        let near = RectIndex::new(clips.iter().map(|&(_, bounds)| bounds));
        let edges = Edges::new(subject);
        let is_whole = subject.contours().iter().filter(|ring| twice_area(ring) > 0).count() == 1;
        let mut cuts = Self { holes: Vec::new(), others: Vec::new() };
        for (clip, bounds) in clips {
            if edges.any(bounds, |_| true) {
                cuts.others.push(clip);
            } else if edges.winding(bounds.min()) != Some(0) {
                let is_alone = is_whole && clip.contours().len() == 1 && near.touching(bounds).len() == 1;
                if is_alone { cuts.holes.push(clip) } else { cuts.others.push(clip) }
            }
        }
        cuts
    }

    /// `pieces` with the holes in them.
    pub(super) fn punched(&self, pieces: Vec<Polygon>) -> Vec<Polygon> {
        if self.holes.is_empty() {
            return pieces;
        }
        let places: Vec<Edges> = pieces.iter().map(Edges::new).collect();
        let near = RectIndex::new(places.iter().map(Edges::bounds));
        let mut rings: Vec<Vec<Vec<Point>>> = pieces.iter().map(|piece| piece.contours().to_vec()).collect();
        for hole in &self.holes {
            let ring = &hole.contours()[0];
            let mut around = near.touching(Rect::new(ring[0], ring[0])).into_iter();
            if let Some(piece) = around.find(|&i| places[i].winding(ring[0]) != Some(0)) {
                rings[piece].push(clockwise(ring));
            }
        }
        rings.into_iter().filter_map(Polygon::new).collect()
    }
}

/// A ring, turned round where it is not clockwise.
fn clockwise(ring: &[Point]) -> Vec<Point> {
    let mut ring = ring.to_vec();
    if twice_area(&ring) > 0 {
        ring.reverse();
    }
    ring
}

#[cfg(test)]
mod tests {
    use i_overlay::core::overlay::ShapeType;
    use i_overlay::core::overlay_rule::OverlayRule;

    use super::super::{Operands, difference};
    use super::*;
    use crate::geometry::Nm;
    use crate::topology::random;

    /// The contours of `polygons`, each from its least point, in order.
    fn contours(polygons: &[Polygon]) -> Vec<Vec<Vec<Point>>> {
        let turned = |ring: &Vec<Point>| {
            let mut ring = ring.clone();
            let least = (0..ring.len()).min_by_key(|&at| ring[at]).expect("three points");
            ring.rotate_left(least);
            ring
        };
        let sorted = |polygon: &Polygon| {
            let mut rings: Vec<Vec<Point>> = polygon.contours().iter().map(turned).collect();
            rings.sort();
            rings
        };
        let mut all: Vec<Vec<Vec<Point>>> = polygons.iter().map(sorted).collect();
        all.sort();
        all
    }

    #[test]
    fn holes_are_what_a_boolean_makes_of_them() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let plane = Polygon::rectangle(Rect::new(at(0, 0), at(1000, 1000)));
        // Some on the edge, some beside the plane, some that touch each other, most alone; then two
        // slits, that leave three pieces.
        let mut next = random();
        for slits in [0, 2] {
            let mut clips: Vec<Polygon> = (0..120)
                .map(|_| (at(next(1200) - 100, next(1200) - 100), Nm::from_um(5 + next(30))))
                .map(|(center, radius)| Polygon::disc(center, radius, Nm::new(500)).expect("a disc"))
                .collect();
            let slit = |at_x: i64| Polygon::rectangle(Rect::new(at(at_x, -10), at(at_x + 3, 1010)));
            clips.extend((1..=slits).map(|i| slit(300 * i)));
            let mut operands = Operands::new();
            operands.add(&plane, ShapeType::Subject);
            clips.iter().for_each(|clip| operands.add(clip, ShapeType::Clip));
            let whole = operands.overlay(OverlayRule::Difference);
            let cuts = Cuts::of(&plane, &clips);
            assert!(cuts.holes.len() > 20 && cuts.others.len() > 20, "both kinds");
            assert!(cuts.holes.len() + cuts.others.len() < clips.len(), "and some beside it");
            assert_eq!(contours(&difference(&plane, &clips)), contours(&whole), "{slits} slits");
        }
    }
}
