//! What parts of the copper hang together by, and how wide that is.
//!
//! Imagine all cuts and the board's edge growing until everything is gone, and then receding:
//! pixels come back, the farthest from all of them first. Where one of them joins two parts that
//! are looked for, the copper between these is narrowest: no way from one to the other has a wider
//! narrowest place (Kruskal's maximum spanning tree). Pixels under the cuts come back last, so that
//! parts that are cut apart join too, at a width below zero.
//!
//! J. B. Kruskal, *On the shortest spanning subtree of a graph and the traveling salesman problem*,
//! Proceedings of the AMS 7, 1956.
//!
//! The picture finds the place; how wide it is there is asked of the exact shapes.

use crate::geometry::{Nm, Point, Rect};
use crate::grid::Grid;
use crate::topology::DisjointSets;

use super::sheet::{OUTSIDE, Sheet, Show};

/// Pixels along a side of the picture, at most. Chosen: a fifth of a second for the worst.
const SIDE: u32 = 700;

/// A picture of a part of the sheet, to be flooded.
pub(super) struct Basin {
    pub(super) grid: Grid,
    /// What is left: see [`Sheet`].
    pub(super) labels: Vec<u32>,
    /// How far each pixel is from the way of the nearest cut, in nanometres.
    depths: Vec<f32>,
    /// The order in which pixels come back.
    order: Vec<u32>,
}

/// Two parts that join.
#[derive(Clone, Copy, Debug)]
pub(super) struct Join {
    /// The pixel that joins them.
    pub(super) pixel: usize,
    /// What stood for each before: the first, which is smaller, stands for both from then on.
    pub(super) roots: (u32, u32),
}

impl Basin {
    /// The part of `sheet` within `place`.
    pub(super) fn new(sheet: &Sheet<'_>, place: Rect) -> Self {
        let (grid, pictures) =
            sheet.window(place, sheet.pitch(), SIDE, &[Show::Left, Show::Ways, Show::Edge]);
        let labels = pictures[0].labels().to_vec();
        let half = grid.pixels(sheet.floor);
        let nearest = |(ways, edge): (&f32, &f32)| ways.min(edge + half);
        let depths: Vec<f32> = pictures[1].depths().iter().zip(pictures[2].depths()).map(nearest).collect();
        let mut order: Vec<u32> =
            (0_u32..).zip(&labels).filter(|(_, label)| **label != OUTSIDE).map(|(at, _)| at).collect();
        order.sort_unstable_by(|&a, &b| depths[b as usize].total_cmp(&depths[a as usize]).then(a.cmp(&b)));
        Self { grid, labels, depths, order }
    }

    /// The middle of a pixel.
    pub(super) fn place(&self, pixel: usize) -> Point {
        let index = i64::try_from(pixel).unwrap_or(0);
        self.grid.center(index % i64::from(self.grid.width()), index / i64::from(self.grid.width()))
    }

    /// How wide it is at a pixel as far as the picture tells: twice the way to the nearest kerf;
    /// none where no cut is near.
    fn seen(&self, sheet: &Sheet<'_>, pixel: usize) -> Option<f64> {
        let depth = self.depths[pixel];
        depth
            .is_finite()
            .then(|| 2.0 * (f64::from(depth) * self.grid.pitch().to_f64() - sheet.floor.to_f64()))
    }

    /// How wide it is where a pixel joins two parts, and where exactly; no width where nothing
    /// bounds it on both sides. A width that is not above zero says that the parts are apart.
    pub(super) fn width(&self, sheet: &Sheet<'_>, pixel: usize) -> (Option<Nm>, Point) {
        let at = self.place(pixel);
        let Some(seen) = self.seen(sheet, pixel) else { return (None, at) };
        let reach = Nm::from_f64(seen.max(0.0)) + self.grid.pitch() * 4;
        match sheet.walls.neck(at, reach, self.grid.pitch() * 3) {
            Some(neck) => (Some(Nm::from_f64(neck.width)), neck.at),
            None => (Some(Nm::from_f64(seen)), at),
        }
    }

    /// Lets pixels come back, those near `plugs` excepted, and tells `joined` of each two parts
    /// that join; until it says that it has seen enough.
    pub(super) fn flood(&self, water: &mut Water, plugs: &[Point], mut joined: impl FnMut(Join) -> bool) {
        let (width, count) = (self.grid.width() as usize, self.labels.len());
        let plug = self.grid.pitch().to_f64() * 3.0;
        for at in self.order.iter().map(|&at| at as usize) {
            if !plugs.is_empty() && plugs.iter().any(|p| p.distance(self.place(at)) <= plug) {
                continue;
            }
            water.dry[at] = true;
            let column = at % width;
            let left = if column > 0 { at - 1 } else { usize::MAX };
            let right = if column + 1 < width { at + 1 } else { usize::MAX };
            let (above, below) = (at.wrapping_sub(width), at + width);
            for other in [left, right, above, below] {
                if other >= count || !water.dry[other] {
                    continue;
                }
                let Some(roots) = water.join(at, other) else { continue };
                if joined(Join { pixel: at, roots }) {
                    return;
                }
            }
        }
    }
}

/// Which pixels have come back, and in which connected parts.
pub(super) struct Water {
    dry: Vec<bool>,
    parts: DisjointSets,
}

impl Water {
    pub(super) fn new(pixels: usize) -> Self {
        Self { dry: vec![false; pixels], parts: DisjointSets::new(pixels) }
    }

    /// Takes two pixels for one part from the beginning.
    pub(super) fn tie(&mut self, one: u32, other: u32) {
        self.parts.union(one, other);
    }

    /// Joins the parts of two pixels; their roots where they were two.
    fn join(&mut self, a: usize, b: usize) -> Option<(u32, u32)> {
        let [a, b] = [a, b].map(|at| self.parts.find(u32::try_from(at).unwrap_or(0)));
        self.parts.union(a, b).then_some((a.min(b), a.max(b)))
    }
}
