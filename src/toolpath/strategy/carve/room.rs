//! Where the V-bit may go at the full depth: ways that stay within the floor need no retract.

use crate::geometry::{BoxTree, Point, Polygon, cross, spanned};

/// Areas by their edges.
#[derive(Debug, Default)]
pub(super) struct Room {
    edges: Vec<(Point, Point)>,
    tree: BoxTree,
}

impl Room {
    pub(super) fn new(areas: &[Polygon]) -> Self {
        let rings = areas.iter().flat_map(Polygon::contours);
        let edges: Vec<(Point, Point)> =
            rings.flat_map(|ring| ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))).collect();
        let tree = BoxTree::new(edges.iter().map(|(a, b)| spanned(a.to_f64(), b.to_f64())));
        Self { edges, tree }
    }

    /// Whether the straight way between two places in it stays in it.
    pub(super) fn leads(&self, from: Point, to: Point) -> bool {
        let mut is_left = false;
        self.tree.visit_window(spanned(from.to_f64(), to.to_f64()), |edge| {
            is_left |= cross(self.edges[edge], (from, to));
        });
        !is_left
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;

    #[test]
    fn a_way_round_an_island_or_a_corner_is_none_straight_through_it() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let ring = |corners: &[(i64, i64)]| corners.iter().map(|&(x, y)| at(x, y)).collect::<Vec<_>>();
        let outer = ring(&[(0, 0), (1000, 0), (1000, 400), (400, 400), (400, 1000), (0, 1000)]);
        let island = ring(&[(100, 100), (100, 200), (200, 200), (200, 100)]);
        let room = Room::new(&[Polygon::new(vec![outer, island]).expect("an area")]);
        assert!(room.leads(at(50, 50), at(900, 50)), "along an edge");
        assert!(!room.leads(at(900, 350), at(350, 900)), "across the corner");
        assert!(!room.leads(at(50, 150), at(250, 150)), "across the island");
    }
}
