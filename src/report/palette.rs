//! Colours: a dark board, warm copper, cool soft regions, bright cuts.
//!
//! Neighbouring regions get different tints by greedy colouring of the boundary graph. It is
//! planar, so seven tints nearly always do; the least used of the free ones is taken so that no
//! tint dominates.

use crate::topology::NetId;
use crate::voronoi::{Boundaries, Owner};

/// A colour in sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub u8, pub u8, pub u8);

/// Around the board.
pub(super) const GROUND: Rgb = Rgb(0x0d, 0x10, 0x16);
/// The bare board, and what belongs to no net.
pub(super) const SUBSTRATE: Rgb = Rgb(0x1c, 0x22, 0x2b);
/// Copper.
pub(super) const COPPER: Rgb = Rgb(0xd9, 0x96, 0x52);
/// What the cutter takes away.
pub(super) const CUT: Rgb = Rgb(0xf6, 0xf1, 0xe3);
/// A drilled hole.
pub(super) const HOLE: Rgb = Rgb(0x07, 0x08, 0x0b);
/// The board's edge and the cut along it.
pub(super) const EDGE: Rgb = Rgb(0x8a, 0xa0, 0xb8);
/// Rapid moves.
pub(super) const RAPID: Rgb = Rgb(0xff, 0x5d, 0x8f);
/// No room beside a cut, some, and plenty.
pub(super) const HOT: Rgb = Rgb(0xff, 0x2b, 0x2b);
pub(super) const WARM: Rgb = Rgb(0xff, 0xd1, 0x3d);
pub(super) const COLD: Rgb = Rgb(0x3d, 0x8b, 0xff);
/// Lettering.
pub(super) const INK: Rgb = Rgb(0xd7, 0xde, 0xe8);

/// Soft tints for Voronoi regions, darker than copper and cooler, well apart from each other.
const TINTS: [Rgb; 10] = [
    Rgb(0x2f, 0x4b, 0x7c),
    Rgb(0x2f, 0x6b, 0x5e),
    Rgb(0x5b, 0x45, 0x86),
    Rgb(0x3a, 0x6f, 0x86),
    Rgb(0x7a, 0x3f, 0x66),
    Rgb(0x55, 0x6b, 0x3a),
    Rgb(0x3d, 0x3f, 0x99),
    Rgb(0x24, 0x5a, 0x3c),
    Rgb(0x80, 0x4b, 0x4b),
    Rgb(0x4e, 0x5d, 0x70),
];

/// What stands in a legend for all of them.
pub(super) const REGION: Rgb = TINTS[2];

/// A tint for every net of `count`: nets whose regions share a boundary differ.
#[must_use]
pub fn tints(count: usize, boundaries: &Boundaries) -> Vec<Rgb> {
    let mut neighbours = vec![Vec::new(); count];
    for edge in &boundaries.edges {
        if let (Owner::Net(a), Owner::Net(b)) = (edge.left, edge.right) {
            neighbours[a.index()].push(b.index());
            neighbours[b.index()].push(a.index());
        }
    }
    let mut chosen: Vec<Option<usize>> = vec![None; count];
    let mut used = [0_usize; TINTS.len()];
    for net in 0..count {
        let taken: Vec<usize> = neighbours[net].iter().filter_map(|&other| chosen[other]).collect();
        let free = (0..TINTS.len()).filter(|tint| !taken.contains(tint)).min_by_key(|&tint| used[tint]);
        let tint = free.unwrap_or(net % TINTS.len());
        used[tint] += 1;
        chosen[net] = Some(tint);
    }
    chosen.into_iter().map(|tint| TINTS[tint.unwrap_or_default()]).collect()
}

/// A colour number for each of what has these `neighbours`, by index, so that neighbours differ.
///
/// What has the fewest neighbours left is set aside, again and again, and coloured last to first:
/// regions on a plane always leave one with five at most, so six colours do (Matula and Beck:
/// *Smallest-last ordering and clustering and graph coloring algorithms*, J. ACM 30, 1983). Of the
/// free ones the least used is taken.
#[must_use]
pub(super) fn colouring(neighbours: &[Vec<usize>]) -> Vec<usize> {
    let mut left: Vec<Option<usize>> = neighbours.iter().map(|others| Some(others.len())).collect();
    let mut order = Vec::with_capacity(neighbours.len());
    while let Some((_, next)) = (0..left.len()).filter_map(|i| Some((left[i]?, i))).min() {
        left[next] = None;
        order.push(next);
        neighbours[next].iter().for_each(|&other| left[other] = left[other].map(|count| count - 1));
    }
    let mut chosen: Vec<Option<usize>> = vec![None; neighbours.len()];
    let mut used = vec![0_usize; 6];
    for &next in order.iter().rev() {
        let taken: Vec<usize> = neighbours[next].iter().filter_map(|&other| chosen[other]).collect();
        let free = (0..used.len()).filter(|colour| !taken.contains(colour)).min_by_key(|&c| (used[c], c));
        let colour = free.unwrap_or(used.len());
        if colour == used.len() {
            used.push(0);
        }
        used[colour] += 1;
        chosen[next] = Some(colour);
    }
    chosen.into_iter().map(Option::unwrap_or_default).collect()
}

/// A bright colour for a net, distinct from that of the nets numbered near it: the hue goes round
/// by the golden angle, the lightness steps.
#[must_use]
pub fn vivid(net: NetId) -> Rgb {
    let hue = (u64::from(net.0) * 2_654_435_769 % (1 << 32)) >> 16;
    let (sixth, within) = ((hue * 6) >> 16, u8::try_from(((hue * 6) & 0xffff) >> 8).unwrap_or(u8::MAX));
    let low = [0x38_u8, 0x60, 0x20][net.index() % 3];
    let scale = |value: u8| low + u8::try_from(u16::from(value) * u16::from(0xf0 - low) / 255).unwrap_or(0);
    let (up, down) = (scale(within), scale(255 - within));
    let (top, bottom) = (scale(255), scale(0));
    match sixth {
        0 => Rgb(top, up, bottom),
        1 => Rgb(down, top, bottom),
        2 => Rgb(bottom, top, up),
        3 => Rgb(bottom, down, top),
        4 => Rgb(up, bottom, top),
        _ => Rgb(top, bottom, down),
    }
}

impl Rgb {
    /// Part of the way to `other`: 0 here, 255 there.
    #[must_use]
    pub fn towards(self, other: Self, way: u8) -> Self {
        let mix = |a: u8, b: u8| {
            let sum = u32::from(a) * (255 - u32::from(way)) + u32::from(b) * u32::from(way);
            u8::try_from((sum + 127) / 255).unwrap_or(u8::MAX)
        };
        Self(mix(self.0, other.0), mix(self.1, other.1), mix(self.2, other.2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mixing_reaches_both_ends() {
        let (a, b) = (Rgb(0, 10, 255), Rgb(255, 20, 0));
        assert_eq!(a.towards(b, 0), a, "no way");
        assert_eq!(a.towards(b, 255), b, "all the way");
    }

    #[test]
    fn six_colours_tell_all_neighbours_on_a_plane_apart() {
        // Two wheels on one rim: a ring of 30, each beside the next and beside both hubs.
        let rim = 30;
        let mut neighbours: Vec<Vec<usize>> =
            (0..rim).map(|i| vec![(i + 1) % rim, (i + rim - 1) % rim, rim, rim + 1]).collect();
        neighbours.push((0..rim).collect());
        neighbours.push((0..rim).collect());
        let colours = colouring(&neighbours);
        assert!(colours.iter().all(|&colour| colour < 6), "{colours:?}");
        for (one, others) in neighbours.iter().enumerate() {
            assert!(others.iter().all(|&other| colours[one] != colours[other]), "{one} of {colours:?}");
        }
    }

    #[test]
    fn nets_numbered_in_a_row_look_different() {
        for i in 0..50 {
            assert_ne!(vivid(NetId(i)), vivid(NetId(i + 1)), "nets {i} and the next");
        }
    }
}
