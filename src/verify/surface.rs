//! What programs leave of a surface: how deep each place is milled, exactly for a cone that moves
//! straight.

use crate::board::Board;
use crate::gcode::read::{Motion, Way};
use crate::geometry::{Arc, Nm, Rect};
use crate::grid::Grid;
use rayon::prelude::*;

use super::cutter::Cutter;
use super::edges::Spot;
use super::followed::Followed;
use super::machining::Machining;
use super::sweep::{Sweep, Sweeps};
use super::{Error, Program, Settings};

/// Arcs become chords within this of them where that is measured. Chosen: far below what is
/// tolerated.
pub(super) const CHORD: Nm = Nm::new(50);

/// The same for pictures. Chosen: a tenth of a pixel.
pub(super) const COARSE: Nm = Nm::from_um(2);

/// Pixels that are drawn together, each way. Chosen: some times as wide as a cut.
const TILE: u32 = 64;

/// A surface that was milled.
pub struct Surface {
    sweeps: Sweeps,
}

impl Surface {
    /// All that the motions of programs mill; arcs as chords within `chord`.
    pub(super) fn new(programs: &[Followed], chord: Nm) -> Self {
        let sweeps = programs.iter().flat_map(|program| all_swept(program, chord));
        Self { sweeps: Sweeps::new(sweeps.collect()) }
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
            let mut sweeps = all_swept(&machining.followed, COARSE);
            sweeps.iter_mut().for_each(|sweep| sweep.lay(&machining.followed.placement));
            Ok(sweeps)
        };
        let sweeps: Vec<Vec<Sweep>> = programs.par_iter().map(followed).collect::<Result<_, Error>>()?;
        Ok(Self { sweeps: Sweeps::new(sweeps.concat()) })
    }

    /// How deep it is milled at a place, in nanometres; zero where it is not.
    #[must_use]
    pub fn depth(&self, p: (f64, f64)) -> f64 {
        self.depth_after(p, &mut 0)
    }

    /// The same after a place nearby; `last` is the sweep that was deepest there, and becomes the
    /// one that is so here: what cannot go deeper than that is not asked how deep it goes.
    pub(super) fn depth_after(&self, p: Spot, last: &mut usize) -> f64 {
        let mut deepest = self.sweeps.all().get(*last).map_or(0.0, |sweep| sweep.depth(p)).max(0.0);
        self.sweeps.deeper_than(deepest, [p.0, p.1, p.0, p.1], |number, sweep| {
            let depth = sweep.depth(p);
            if depth > deepest {
                (deepest, *last) = (depth, number);
            }
            deepest
        });
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
        let pitch = tile.pitch().to_f64();
        let ((left, bottom), (right, top)) = (tile.rect().min().to_f64(), tile.rect().max().to_f64());
        let span = |low: f64, high: f64, count: u32| {
            pixel(low / pitch).min(count)..pixel(high / pitch + 1.0).min(count)
        };
        self.sweeps.deeper_than(0.0, [left, bottom, right, top], |_, sweep| {
            let bounds = sweep.bounds();
            for row in span(top - bounds[3], top - bounds[1], tile.height()) {
                for column in span(bounds[0] - left, bounds[2] - left, tile.width()) {
                    let center = tile.center(i64::from(column), i64::from(row)).to_f64();
                    #[expect(clippy::cast_possible_truncation, reason = "a picture")]
                    take(column, row, sweep.depth(center) as f32);
                }
            }
            0.0
        });
    }

    /// The deepest that it is milled anywhere.
    #[must_use]
    pub fn deepest(&self) -> Nm {
        Nm::from_f64(self.sweeps.all().iter().flat_map(|sweep| sweep.depths).fold(0.0, f64::max))
    }

    /// The ways of the tip below the surface, from where to where.
    pub(super) fn ways(&self) -> impl Iterator<Item = [Spot; 2]> + Clone {
        self.sweeps.all().iter().map(|sweep| [sweep.from, sweep.to])
    }

    /// The deepest place of the tip beyond a rectangle, with its depth; none where it stays within.
    pub(super) fn beyond(&self, rect: Rect) -> Option<(Spot, f64)> {
        let (low, high) = (rect.min().to_f64(), rect.max().to_f64());
        let is_out = |p: Spot| p.0 < low.0 || p.1 < low.1 || p.0 > high.0 || p.1 > high.1;
        let ends = self.sweeps.all().iter().flat_map(|s| [(s.from, s.depths[0]), (s.to, s.depths[1])]);
        ends.filter(|&(at, _)| is_out(at)).max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// The pixel that holds a place, so many pixels from the first one's edge.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
const fn pixel(place: f64) -> u32 {
    place as u32
}

/// The straight sweeps of all motions of a program whose tool is known.
fn all_swept(program: &Followed, chord: Nm) -> Vec<Sweep> {
    let mut sweeps = Vec::new();
    for motion in &program.listing.motions {
        if let Some(cutter) = program.tools.at(motion.line) {
            swept(motion, &cutter, chord, &mut sweeps);
        }
    }
    sweeps
}

/// The straight sweeps of a motion that reaches below the surface.
fn swept(motion: &Motion, cutter: &Cutter, chord: Nm, sweeps: &mut Vec<Sweep>) {
    let cone = cutter.cone();
    let sweep = |(from, to, depths)| Sweep { from, to, depths, cone };
    sweeps.extend(stretches(motion, chord).into_iter().map(sweep));
}

/// The straight parts of a motion that reaches below the surface, arcs as chords within `chord`:
/// from where, to where, and how deep at either end. None of one that does not, or whose places are
/// not known.
pub(super) fn stretches(motion: &Motion, chord: Nm) -> Vec<(Spot, Spot, [f64; 2])> {
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
            places.extend(arc.divided(count));
        }
    }
    let parts = u32::try_from(places.len() - 1).unwrap_or(u32::MAX);
    let depth = |part: u32| -(top.to_f64() + (bottom - top).to_f64() * (f64::from(part) / f64::from(parts)));
    let stretch = |(pair, part): (&[Spot], u32)| (pair[0], pair[1], [depth(part), depth(part + 1)]);
    places.windows(2).zip(0..).map(stretch).collect()
}
