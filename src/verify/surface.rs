//! What programs leave of a surface: how deep each place is milled, exactly for a cone that moves
//! straight.

use rayon::prelude::*;
use static_aabb2d_index::StaticAABB2DIndex;

use crate::board::Board;
use crate::gcode::read::{Listing, Motion, Way};
use crate::geometry::{Arc, Nm, Point, Rect};
use crate::grid::Grid;

use super::boxes::boxes;
use super::cutter::Cutter;
use super::edges::length;
use super::machining::Machining;
use super::{Error, Placement, Program, Settings};

/// A point in nanometres.
type At = (f64, f64);

/// Arcs become chords within this of them where that is measured. Chosen: far below what is
/// tolerated.
pub(super) const CHORD: Nm = Nm::new(50);

/// The same for pictures. Chosen: a tenth of a pixel.
pub(super) const COARSE: Nm = Nm::from_um(2);

/// Pixels that are drawn together, each way. Chosen: some times as wide as a cut.
const TILE: u32 = 64;

/// A straight motion of a tool below the surface.
#[derive(Clone, Copy, Debug)]
struct Sweep {
    from: At,
    to: At,
    /// How deep the tip is at either end, downwards.
    depths: [f64; 2],
    blunt: f64,
    /// How much wider the tool is on either side for each unit of height; zero for a cylinder.
    flank: f64,
}

/// A surface that was milled.
pub struct Surface {
    sweeps: Vec<Sweep>,
    tree: Option<StaticAABB2DIndex<f64>>,
}

impl Surface {
    /// All that the motions of programs mill, each with its tool; arcs as chords within `chord`.
    pub(super) fn new(programs: &[(Listing, Cutter)], chord: Nm) -> Self {
        let mut sweeps = Vec::new();
        for (listing, cutter) in programs {
            listing.motions.iter().for_each(|motion| swept(motion, cutter, chord, &mut sweeps));
        }
        Self::of(sweeps)
    }

    /// What programs mill of a side of a board, for pictures of it: on the board, as
    /// [`verify`](super::verify) lays them.
    ///
    /// # Errors
    ///
    /// [`Error`] for a text that cannot be followed, and a tool that nothing names.
    pub fn of_board(programs: &[Program], board: &Board, settings: &Settings) -> Result<Self, Error> {
        let followed = |program: &Program| {
            let machining = Machining::read(program, board, settings)?;
            let mut sweeps = Vec::new();
            for motion in &machining.motions {
                if let Some(cutter) = machining.tools.at(motion.line) {
                    swept(motion, &cutter, COARSE, &mut sweeps);
                }
            }
            sweeps.iter_mut().for_each(|sweep| sweep.lay(&machining.placement));
            Ok(sweeps)
        };
        let sweeps: Vec<Vec<Sweep>> = programs.par_iter().map(followed).collect::<Result<_, Error>>()?;
        Ok(Self::of(sweeps.concat()))
    }

    fn of(sweeps: Vec<Sweep>) -> Self {
        let tree = boxes(sweeps.iter().map(Sweep::bounds));
        Self { sweeps, tree }
    }

    /// How deep it is milled at a place, in nanometres; zero where it is not.
    #[must_use]
    pub fn depth(&self, p: (f64, f64)) -> f64 {
        let mut deepest = 0.0_f64;
        if let Some(tree) = &self.tree {
            tree.visit_query(p.0, p.1, p.0, p.1, &mut |i: usize| {
                deepest = deepest.max(self.sweeps[i].depth(p));
            });
        }
        deepest
    }

    /// The same at the centre of each pixel of `grid`, row by row from the top.
    #[must_use]
    pub fn depths(&self, grid: &Grid) -> Vec<f32> {
        let width = grid.width() as usize;
        let mut depths = vec![0.0_f32; width * grid.height() as usize];
        let strips = depths.par_chunks_mut(width * TILE as usize).enumerate();
        strips.for_each(|(strip, pixels)| {
            let top = u32::try_from(strip).expect("few") * TILE;
            let rows = TILE.min(grid.height() - top);
            for left in (0..grid.width()).step_by(TILE as usize) {
                self.tile(
                    &grid.part((left, top), TILE.min(grid.width() - left), rows),
                    |column, row, depth| {
                        let pixel = &mut pixels[row as usize * width + (left + column) as usize];
                        *pixel = pixel.max(depth);
                    },
                );
            }
        });
        depths
    }

    /// Tells how deep sweeps mill the pixels of a small grid, by column and row.
    fn tile(&self, tile: &Grid, mut take: impl FnMut(u32, u32, f32)) {
        let Some(tree) = &self.tree else { return };
        let pitch = tile.pitch().to_f64();
        let ((left, bottom), (right, top)) = (tile.rect().min().to_f64(), tile.rect().max().to_f64());
        let span = |low: f64, high: f64, count: u32| {
            pixel(low / pitch).min(count)..pixel(high / pitch + 1.0).min(count)
        };
        tree.visit_query(left, bottom, right, top, &mut |i: usize| {
            let sweep = &self.sweeps[i];
            let bounds = sweep.bounds();
            for row in span(top - bounds[3], top - bounds[1], tile.height()) {
                for column in span(bounds[0] - left, bounds[2] - left, tile.width()) {
                    let center = tile.center(i64::from(column), i64::from(row)).to_f64();
                    #[expect(clippy::cast_possible_truncation, reason = "a picture")]
                    take(column, row, sweep.depth(center) as f32);
                }
            }
        });
    }

    /// The deepest that it is milled anywhere.
    #[must_use]
    pub fn deepest(&self) -> Nm {
        Nm::from_f64(self.sweeps.iter().flat_map(|sweep| sweep.depths).fold(0.0, f64::max))
    }

    /// The deepest place of the tip beyond a rectangle, with its depth; none where it stays within.
    pub(super) fn beyond(&self, rect: Rect) -> Option<(At, f64)> {
        let (low, high) = (rect.min().to_f64(), rect.max().to_f64());
        let is_out = |p: At| p.0 < low.0 || p.1 < low.1 || p.0 > high.0 || p.1 > high.1;
        let ends = self.sweeps.iter().flat_map(|s| [(s.from, s.depths[0]), (s.to, s.depths[1])]);
        ends.filter(|&(at, _)| is_out(at)).max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// The pixel that holds a place, so many pixels from the first one's edge.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
const fn pixel(place: f64) -> u32 {
    place as u32
}

/// The straight sweeps of a motion that reaches below the surface.
fn swept(motion: &Motion, cutter: &Cutter, chord: Nm, sweeps: &mut Vec<Sweep>) {
    let [blunt, flank] = cutter.cone();
    let sweep = |(from, to, depths)| Sweep { from, to, depths, blunt, flank };
    sweeps.extend(stretches(motion, chord).into_iter().map(sweep));
}

/// The straight parts of a motion that reaches below the surface, arcs as chords within `chord`:
/// from where, to where, and how deep at either end. None of one that does not, or whose places are
/// not known.
pub(super) fn stretches(motion: &Motion, chord: Nm) -> Vec<(At, At, [f64; 2])> {
    let (Some(from), Some(to)) = (motion.from.point(), motion.to.point()) else { return Vec::new() };
    let (Some(top), Some(bottom)) = (motion.from.z, motion.to.z) else { return Vec::new() };
    if top >= Nm::ZERO && bottom >= Nm::ZERO {
        return Vec::new();
    }
    let mut places = vec![from.to_f64()];
    match motion.way {
        Way::Rapid | Way::Feed => places.push(to.to_f64()),
        Way::Arc { center, turn } => {
            let arc = Arc { start: from, end: to, center, turn };
            let count = u32::try_from(arc.chords(chord)).unwrap_or(u32::MAX).max(1);
            places.extend((1..=count).map(|i| arc.at(f64::from(i) / f64::from(count))));
        }
    }
    let parts = u32::try_from(places.len() - 1).unwrap_or(u32::MAX);
    let depth = |part: u32| -(top.to_f64() + (bottom - top).to_f64() * (f64::from(part) / f64::from(parts)));
    let stretch = |(pair, part): (&[At], u32)| (pair[0], pair[1], [depth(part), depth(part + 1)]);
    places.windows(2).zip(0..).map(stretch).collect()
}

impl Sweep {
    /// Takes it from the machine to the board.
    fn lay(&mut self, placement: &Placement) {
        let undo = |(x, y): At| placement.undo(Point::from_f64(x, y)).to_f64();
        [self.from, self.to] = [self.from, self.to].map(undo);
    }

    /// Left, bottom, right, top of what it mills at the surface.
    fn bounds(&self) -> [f64; 4] {
        let deepest = self.depths[0].max(self.depths[1]).max(0.0);
        let reach = self.blunt + deepest * self.flank;
        [
            self.from.0.min(self.to.0) - reach,
            self.from.1.min(self.to.1) - reach,
            self.from.0.max(self.to.0) + reach,
            self.from.1.max(self.to.1) + reach,
        ]
    }

    /// How deep it mills at a place; less than zero where it does not.
    ///
    /// With the tip a way s along, that is D + k s − max(ρ − blunt, 0) / flank, ρ being how far off
    /// the place is: concave in s, so it is greatest at an end, where ρ is the tip's radius, or
    /// where the slope of the cone is that of the way.
    fn depth(&self, p: At) -> f64 {
        let way = (self.to.0 - self.from.0, self.to.1 - self.from.1);
        let whole = length(way);
        let off = (p.0 - self.from.0, p.1 - self.from.1);
        if whole <= 0.0 {
            let deepest = self.depths[0].max(self.depths[1]);
            return self.below(deepest, length(off));
        }
        let along = (off.0 * way.0 + off.1 * way.1) / whole;
        let across = (off.0 * way.1 - off.1 * way.0).abs() / whole;
        if (self.depths[1] - self.depths[0]).abs() <= 0.0 {
            return self.below(self.depths[0], length((along - along.clamp(0.0, whole), across)));
        }
        let rise = (self.depths[1] - self.depths[0]) / whole;
        let flat = (self.blunt * self.blunt - across * across).max(0.0).sqrt();
        let steep = rise * self.flank;
        let slope = if steep.abs() < 1.0 { across * steep / (1.0 - steep * steep).sqrt() } else { 0.0 };
        [0.0, whole, along, along - flat, along + flat, along + slope]
            .into_iter()
            .map(|s| {
                let s = s.clamp(0.0, whole);
                let off = length((along - s, across));
                self.below(self.depths[0] + rise * s, off)
            })
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// How deep a tool whose tip is at a depth mills so far off its axis.
    fn below(&self, depth: f64, off: f64) -> f64 {
        let beyond = (off - self.blunt).max(0.0);
        if self.flank > 0.0 {
            depth - beyond / self.flank
        } else if beyond > 0.0 {
            f64::NEG_INFINITY
        } else {
            depth
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The closed form beside many places along the way.
    #[test]
    fn a_sweep_mills_what_its_places_mill() {
        for (depths, blunt, flank) in
            [([1e5, 4e5], 5e4, 0.5), ([4e5, 1e5], 0.0, 0.3), ([2e5, 2e5], 1e5, 1.0), ([0.0, 9e5], 2e4, 1.5)]
        {
            let sweep = Sweep { from: (0.0, 0.0), to: (3e5, 4e5), depths, blunt, flank };
            for i in 0..40_i32 {
                let p = (f64::from(i * 7919 % 61) * 1e4 - 1e5, f64::from(i * 104_729 % 67) * 1e4 - 1e5);
                let one = |t: f64| {
                    let off = length((p.0 - 3e5 * t, p.1 - 4e5 * t));
                    sweep.below(depths[0] + (depths[1] - depths[0]) * t, off)
                };
                let brute = (0..=20_000_i32).map(|t| one(f64::from(t) / 20_000.0)).fold(f64::MIN, f64::max);
                let exact = sweep.depth(p);
                assert!(exact >= brute - 1e-6 && exact - brute < 60.0, "{p:?}: {exact} and {brute} nm");
            }
        }
    }
}
