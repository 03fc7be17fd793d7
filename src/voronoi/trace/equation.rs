//! Which equation a boundary satisfies at a crack or corner, read from the pixels round it; and
//! nodes, which satisfy two.

use super::Tracer;
use super::crack::{Crack, Heading};
use crate::voronoi::place::{Candidates, Placed, Target};
use crate::voronoi::plane::Spot;
use crate::voronoi::span::Vertex;
use crate::voronoi::{BACKGROUND, OUTSIDE};

/// A place to sample: where the pixels have the boundary, and what equation holds there.
#[derive(Clone, Copy)]
pub(super) struct Anchor {
    pub(super) at: Spot,
    pub(super) target: Target,
}

impl Tracer<'_> {
    pub(super) fn anchor(&self, crack: Crack) -> Anchor {
        let (left, right) = crack.sides();
        let at = self.middle(crack);
        let (x0, x1) = (left.0.min(right.0), left.0.max(right.0));
        let (y0, y1) = (left.1.min(right.1), left.1.max(right.1));
        let owners = (self.pixels.owner(left.0, left.1), self.pixels.owner(right.0, right.1));
        let pair = (self.pixels.label(left.0, left.1), self.pixels.label(right.0, right.1));
        let apron = self.apron(owners);
        Anchor { at, target: self.target(owners, pair, (x0 - apron, y0 - apron, x1 + apron, y1 + apron)) }
    }

    /// The place half way along a crack.
    pub(super) fn middle(&self, crack: Crack) -> Spot {
        let (x, y) = crack.end();
        self.spot(f64::from(crack.x + x) / 2.0, f64::from(crack.y + y) / 2.0)
    }

    /// How far beyond the pixels at a boundary of `owners` sites are looked for. Between two nets
    /// an index of all sites tells of nearer ones, where there is one; it does not tell of polygons
    /// that a limit curve may run into.
    const fn apron(&self, owners: (u32, u32)) -> i32 {
        let bare = owners.0 == BACKGROUND || owners.1 == BACKGROUND;
        if self.placer.near.is_some() && !bare { 0 } else { 1 }
    }

    /// The equation of a boundary between two owners, with the sites seen in a window of pixels.
    fn target(&self, owners: (u32, u32), pair: (u32, u32), window: (i32, i32, i32, i32)) -> Target {
        let (a, b) = (self.candidates(owners.0, pair.0, window), self.candidates(owners.1, pair.1, window));
        let (band, level) = (self.placer.band(), self.course.level);
        match (owners, self.alike(a), self.alike(b)) {
            ((OUTSIDE, _) | (_, OUTSIDE), ..) => Target::OnBorder,
            ((BACKGROUND, _), _, (is_flat, b)) => Target::At(b, if is_flat { band } else { level }),
            ((_, BACKGROUND), (is_flat, a), _) => Target::At(a, if is_flat { band } else { level }),
            (_, (true, a), (false, _)) => Target::At(a, band),
            (_, (false, _), (true, b)) => Target::At(b, band),
            (_, (_, a), (_, b)) => Target::Between(a, b),
        }
    }

    /// The labels of an owner in a window of pixels, the given one first.
    fn candidates(&self, owner: u32, label: u32, (x0, y0, x1, y1): (i32, i32, i32, i32)) -> Candidates {
        let mut candidates = Candidates::default();
        if owner <= OUTSIDE {
            return candidates;
        }
        if self.placer.owners[label as usize] == owner {
            candidates.add(label);
        }
        let mut last = label;
        for y in y0..=y1 {
            let row = self.pixels.index(x0, y)..=self.pixels.index(x1, y);
            for &label in &self.pixels.labels[row] {
                if label != last && self.placer.owners[label as usize] == owner {
                    candidates.add(label);
                }
                last = label;
            }
        }
        candidates
    }

    /// Whether the first candidate is a trace's own copper above the cones, with those that are as
    /// it is.
    fn alike(&self, candidates: Candidates) -> (bool, Candidates) {
        let is_flat = |label: u32| self.placer.sites.sites[label as usize].flat;
        let first = candidates.as_slice().first().is_some_and(|&label| is_flat(label));
        if self.placer.near.is_some() {
            return (first, candidates);
        }
        let mut alike = Candidates::default();
        candidates
            .as_slice()
            .iter()
            .copied()
            .filter(|&label| is_flat(label) == first)
            .for_each(|l| alike.add(l));
        (first, alike)
    }

    /// The place of a piece's end, and whether it is open: the same whichever piece, of whichever
    /// tile, asks. `crack` leaves from there.
    pub(super) fn end_vertex(&mut self, at: (i32, i32), crack: Crack) -> (Placed, bool) {
        let spot = self.spot(f64::from(at.0), f64::from(at.1));
        if self.joined(at).is_some() {
            let mut target = self.anchor(crack).target;
            return (self.placed(&mut target, self.beside(at, crack)), false);
        }
        if self.cracks.degree(at) > 2 {
            let (vertex, open) = self.node(at, spot);
            (self.placer.join_node(&mut self.anchor(crack).target, vertex), open)
        } else {
            (self.placed(&mut self.passing(at), spot), false)
        }
    }

    /// A place between a checkerboard corner and the centre of the pixel that the boundary passes
    /// round there.
    fn beside(&self, at: (i32, i32), crack: Crack) -> Spot {
        let others = [Heading::North, Heading::East, Heading::South, Heading::West]
            .map(|heading| Crack { x: at.0, y: at.1, heading })
            .into_iter()
            .find(|other| *other != crack && self.branch(*other) == self.branch(crack));
        let sides = |crack: Crack| [crack.sides().0, crack.sides().1];
        let round = others.and_then(|other| sides(other).into_iter().find(|p| sides(crack).contains(p)));
        let (x, y) = round.map_or((0.0, 0.0), |(x, y)| {
            (f64::from(x) + 0.5 - f64::from(at.0), f64::from(y) + 0.5 - f64::from(at.1))
        });
        self.spot(f64::from(at.0) + x / 2.0, f64::from(at.1) + y / 2.0)
    }

    /// The equation at a corner that passes a boundary on.
    fn passing(&self, at: (i32, i32)) -> Target {
        let regions = self.around(at);
        let first = regions[0];
        let other = regions.into_iter().find(|r| r.0 != first.0).unwrap_or(first);
        let (a, b) = if first.0 < other.0 { (first, other) } else { (other, first) };
        self.target((a.0, b.0), (a.1, b.1), round(at, 1 + self.apron((a.0, b.0))))
    }

    /// Owner and label of the four pixels round a corner.
    fn around(&self, (x, y): (i32, i32)) -> [(u32, u32); 4] {
        [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)]
            .map(|(x, y)| (self.pixels.owner(x, y), self.pixels.label(x, y)))
    }

    /// The place where three or more regions meet: equally far from the first three, or on the
    /// limit, or on the border. It is open where none such is near: a region that ends in a wedge
    /// thinner than a pixel is seen to end too early.
    fn node(&self, at: (i32, i32), spot: Spot) -> (Vertex, bool) {
        let window = round(at, 2);
        let mut regions = self.around(at).to_vec();
        regions.sort_unstable();
        // A groove has no border to be placed on: what meets there runs on along its own course.
        if regions.iter().any(|region| region.1 != self.course.groove && region.0 != BACKGROUND) {
            regions.retain(|region| region.1 != self.course.groove);
        }
        regions.dedup_by_key(|region| region.0);
        let target = |a: (u32, u32), b: (u32, u32)| self.target((a.0, b.0), (a.1, b.1), window);
        let mut wedge = false;
        let met = match regions.as_slice() {
            [a, b] => self.placer.project(&mut target(*a, *b), spot),
            [a, b, c, ..] => {
                // Sorted by owner: background and outside come first, so both equations hold with
                // what follows.
                let mut first = target(*a, *b);
                let mut second = match a.0 {
                    BACKGROUND | OUTSIDE if b.0 == OUTSIDE => target(*a, *c),
                    BACKGROUND | OUTSIDE => target(*b, *c),
                    _ => target(*a, *c),
                };
                if matches!((first, second), (Target::At(..), Target::At(..))) && a.0 > OUTSIDE {
                    // Where the first region ends with its own copper's band, both say no more than
                    // that.
                    second = target(*b, *c);
                }
                let met = self.placer.meet(&mut first, &mut second, spot);
                wedge = met.is_none();
                met.or_else(|| self.placer.project(&mut first, spot))
            }
            _ => None,
        };
        let fallback = target(regions[regions.len() - 1], regions[0]);
        let open = wedge || met.is_none();
        let kept = || Vertex::new(spot, self.placer.clearance(&fallback, spot).max(0.0));
        (met.unwrap_or_else(kept), open)
    }
}

/// The window of so many pixels on every side of a corner.
const fn round((x, y): (i32, i32), reach: i32) -> (i32, i32, i32, i32) {
    (x - reach, y - reach, x + reach - 1, y + reach - 1)
}
