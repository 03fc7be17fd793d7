//! The picture swept tile by tile: drawn, traced and placed on the spot, joined as the tiles come.
//!
//! Boundaries between regions are one set of lines; level sets of the distance are one for each
//! level, all from the same picture, and each only in the tiles that it crosses.

use std::ops::Range;

use crate::geometry::Nm;
use crate::raster::{self, Scene, TileContent};

use super::place::Placer;
use super::plane::Spot;
use super::stitch::Stitcher;
use super::trace::{self, APRON, Course, Pixels, Traced};
use super::vicinity::Vicinity;
use super::{BACKGROUND, Diagram, OUTSIDE};

/// Pixels along a side of a tile. Measured: with 32, an eighth less time than with 64 or 16;
/// smaller ones hug the boundaries closer, and pay more for their aprons.
const TILE: u32 = 32;

impl Diagram {
    /// The lines between regions.
    pub(super) fn trace(&self, scene: &Scene) -> Stitcher {
        let course = self.course(None);
        let mut stitcher = Stitcher::default();
        let work = |tile: raster::Tile<'_>| {
            let seen = Seen::new(self, &tile)?;
            Some(trace::trace(seen.pixels(&seen.owners), &self.placer(), course))
        };
        raster::stream(scene, &options(Vec::new()), work, |traced| {
            traced.into_iter().for_each(|traced| stitcher.add(traced));
        });
        stitcher
    }

    /// For each of `levels`, which ascend, the lines between what lies within it of copper and what
    /// lies beyond.
    pub(super) fn trace_levels(&self, scene: &Scene, levels: &[Nm]) -> Vec<Stitcher> {
        let depths: Vec<f32> = levels.iter().map(|&level| self.grid.pixels(level)).collect();
        let courses: Vec<Course> = levels.iter().map(|&level| self.course(Some(level))).collect();
        let mut stitchers: Vec<Stitcher> = levels.iter().map(|_| Stitcher::default()).collect();
        let work = |tile: raster::Tile<'_>| -> Vec<(usize, Traced)> {
            let Some(seen) = Seen::new(self, &tile) else { return Vec::new() };
            let placer = self.placer();
            let line = |i: usize| {
                let owners = seen.owners_within(depths[i]);
                (i, trace::trace(seen.pixels(&owners), &placer, courses[i]))
            };
            seen.crossed(&depths).map(line).collect()
        };
        raster::stream(scene, &options(depths.clone()), work, |traced| {
            traced.into_iter().for_each(|(i, traced)| stitchers[i].add(traced));
        });
        stitchers
    }

    /// What places the points of one tile.
    fn placer(&self) -> Placer<'_> {
        // So far around, the next points of a boundary find their neighbours known. Measured: an
        // eighth of a tile is less work than half of one.
        let spare = self.grid.pitch().to_f64() * f64::from(TILE / 8);
        Placer {
            sites: &self.sites,
            owners: self.owners.as_slice(),
            near: self.near.as_ref().map(|near| Vicinity::new(near, spare)),
            border: &self.border.rings,
            border_rings: self.border.ring_count,
            leash: 1.5 * self.grid.pitch().to_f64(),
        }
    }

    /// What tracing the boundaries needs to know, or the lines of a level alone.
    fn course(&self, level: Option<Nm>) -> Course {
        Course {
            origin: Spot::from(self.grid.corner(0, 0)),
            pitch: self.grid.pitch().to_f64(),
            level: level.or(self.settings.limit).map_or(f64::INFINITY, Nm::to_f64),
            groove: self.sites.groove(),
            framed: self.border.frame.is_some(),
            levels_only: level.is_some(),
        }
    }
}

/// How the picture is streamed where these depths are told apart.
pub(super) fn options(levels: Vec<f32>) -> raster::Options {
    raster::Options { tile: TILE, apron: APRON, levels, skip_uniform: true }
}

/// A tile with its apron; beyond the picture lies the outside.
struct Seen<'a> {
    tile: raster::Tile<'a>,
    drawn: raster::TilePixels<'a>,
    owners: Vec<u32>,
    labels: Vec<u32>,
}

impl<'a> Seen<'a> {
    /// What a tile shows; none for one of one owner.
    fn new(diagram: &Diagram, tile: &raster::Tile<'a>) -> Option<Self> {
        let TileContent::Pixels(pixels) = tile.content else { return None };
        let apron = signed(APRON);
        // Columns and rows of the picture, counted from the tile.
        let columns = -signed(tile.column0)..signed(diagram.grid.width()) - signed(tile.column0);
        let rows = -signed(tile.row0)..signed(diagram.grid.height()) - signed(tile.row0);
        let inner = columns.contains(&-apron)
            && columns.contains(&(signed(tile.width) + apron - 1))
            && rows.contains(&-apron)
            && rows.contains(&(signed(tile.height) + apron - 1));
        let area = ((tile.width + 2 * APRON) * (tile.height + 2 * APRON)) as usize;
        let (mut owners, mut labels) = (Vec::with_capacity(area), Vec::with_capacity(area));
        for row in Self::rows(tile) {
            let start = labels.len();
            labels.extend_from_slice(pixels.label_row(row));
            if !inner {
                for (column, label) in (-apron..).zip(&mut labels[start..]) {
                    if !columns.contains(&column) || !rows.contains(&row) {
                        *label = OUTSIDE;
                    }
                }
            }
            owners.extend(labels[start..].iter().map(|&label| diagram.owners[label as usize]));
        }
        Some(Self { tile: *tile, drawn: pixels, owners, labels })
    }

    /// The rows of the tile and its apron.
    fn rows(tile: &raster::Tile<'_>) -> Range<i32> {
        -signed(APRON)..signed(tile.height) + signed(APRON)
    }

    /// How many pixels a row has with the apron.
    const fn width(&self) -> usize {
        (self.tile.width + 2 * APRON) as usize
    }

    /// The owners of each row with the depths of their pixels.
    fn drawn(&self) -> impl Iterator<Item = (&[u32], &[f32])> {
        self.owners
            .chunks_exact(self.width())
            .zip(Self::rows(&self.tile).map(|row| self.drawn.depth_row(row)))
    }

    /// Which of the ascending `depths` some pixel of a net lies within and some pixel beyond.
    fn crossed(&self, depths: &[f32]) -> Range<usize> {
        let (mut near, mut far) = (f32::INFINITY, 0.0_f32);
        for (owners, deep) in self.drawn() {
            for (&owner, &deep) in owners.iter().zip(deep) {
                near = near.min(if owner > OUTSIDE { deep } else { f32::INFINITY });
                far = far.max(if owner == OUTSIDE { 0.0 } else { deep });
            }
        }
        let [first, end] = [near, far].map(|bound| depths.partition_point(|&depth| depth < bound));
        first..end.max(first)
    }

    /// The owners where nobody owns what lies beyond `depth`.
    fn owners_within(&self, depth: f32) -> Vec<u32> {
        let mut within = self.owners.clone();
        let width = self.width();
        for (owners, row) in within.chunks_exact_mut(width).zip(Self::rows(&self.tile)) {
            for (owner, &deep) in owners.iter_mut().zip(self.drawn.depth_row(row)) {
                let is_beyond = (*owner > OUTSIDE) & (deep > depth);
                *owner = if is_beyond { BACKGROUND } else { *owner };
            }
        }
        within
    }

    fn pixels<'b>(&'b self, owners: &'b [u32]) -> Pixels<'b> {
        Pixels {
            owners,
            labels: &self.labels,
            width: signed(self.tile.width),
            height: signed(self.tile.height),
            column0: self.tile.column0,
            row0: self.tile.row0,
        }
    }
}

fn signed(n: u32) -> i32 {
    i32::try_from(n).expect("a picture has at most 2¹⁶ pixels a side")
}
