//! How much of its circumference a mill meets material with, step by step.
//!
//! ```text
//!      ▒▒▒▒▒▒▒▒▒▒▒    The mill goes along what the program says in small steps, over a field of heights that it lowers. After each
//!   ──╮   ·▒▒▒▒▒▒▒    step the half of its circumference that leads is asked, point by point, whether material stands next to it and
//!      ╲ ╭─·▒▒▒▒▒▒    how high. The angle, weighted with that height as a part of the pass, is what the mill bears; it is told as
//!       ││ ●│→▒▒▒▒    the radial engagement that bears as much on a straight wall: (1 − cos angle) / 2.
//! ```
//!
//! Weighted by height, a groove of the mill's full width in a layer that is so much thinner counts
//! as what it is, and a helix, too: no place is left out for being narrow.
//!
//! Tile by tile: each has a field of its own, and follows what of the way comes near it.
//!
//! What counts for nothing: burrs, such as arcs leave along the wall; a load that lasts for less
//! way than a fortieth of the radius; and what no mill of this radius reaches, or only as a strip
//! of that width, by offsets of exact booleans. The field knows nothing of discs, circles or the
//! medial axis.

use std::collections::{BTreeMap, VecDeque};

use rayon::prelude::*;

use crate::board::FLATTEN;
use crate::board::polarity::{offset, union};
use crate::geometry::{Nm, Polygon, Rect, between, spanned};
use crate::verify::edges::Edges;

use crate::verify::runs::{Spot, Sweeps};

/// What a mill bears in all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Borne {
    /// The greatest radial engagement, as a part of the diameter.
    pub most: f64,
    /// Where that is.
    pub at: Spot,
    /// In the program, the line of that.
    pub line: u32,
    /// What it is at most on 99 of 100 parts of the way on which the mill meets material.
    pub p99: f64,
    /// Which part of the way at the depth of a pass meets nothing, the loop along the wall left out
    /// on both sides.
    pub air: f64,
    /// Which part of all of the way below the surface leads through cleared material above the
    /// depth of its pass.
    pub lifted: f64,
}

/// A straight part of the way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) ends: [Spot; 2],
    /// How deep the tip is at either end, downwards.
    pub(super) depths: [f64; 2],
    pub(super) line: u32,
    /// How many motions came before.
    pub(super) order: usize,
}

/// What is milled, and with what.
#[derive(Clone, Copy)]
pub(super) struct Work<'a> {
    pub(super) areas: &'a [Polygon],
    pub(super) radius: Nm,
    pub(super) depth: Nm,
    /// How thick a pass is.
    pub(super) pass: f64,
    /// The engagement above which something is found, as a part of the diameter.
    pub(super) allowed: f64,
    /// All level motions, and the slopes, which are asked only where those leave too much.
    pub(super) sweeps: [&'a Sweeps; 2],
}

/// Cells across a radius, if there are not too many. Chosen: half a cell is a part of the
/// engagement that is well below what is tolerated.
const ACROSS: f64 = 80.0;

/// Cells at most, all tiles together. Chosen: looking at so many takes some seconds.
const MOST_CELLS: f64 = 4e9;

/// Radii across a tile. Chosen: some ten megabytes a thread.
const TILE: f64 = 24.0;

/// How far round a tile the mill feels, as a part of the radius: what it bears there is told by the
/// next tile, but what it bears in this one depends on it.
const LEAD: f64 = 0.25;

/// Steps across a radius, and in all. Chosen.
const STEPS: f64 = 40.0;
const MOST_STEPS: f64 = 4_000_000.0;

/// Points on the half of the circumference that leads.
const POINTS: u32 = 180;

/// What is thinner than this part of the radius is a burr, and so is what a mill takes on a way
/// that is shorter. Chosen: two hundredths of an engagement are more than that.
const BURR: f64 = 0.025;

/// Material is looked for so far ahead of the circumference, as a part of the radius, and no less
/// than a cell and a half. Chosen: above what cells round.
const AHEAD: f64 = 0.015;

/// Where that finds more than is allowed the motions themselves are asked, too, so much within the
/// circumference in nanometres: a mill that goes round in a circle hardly wider than itself never
/// comes to what lies farther ahead. Chosen: above what chords are off.
const WITHIN: f64 = 500.0;

/// Heights are so many parts of the whole depth.
const PARTS: f64 = 60_000.0;

/// Parts of engagement that are told apart.
const BINS: usize = 10_000;

/// So many tiles are followed at once: what each has seen is kept until all of them have. Chosen:
/// enough for any number of cores, and some megabytes.
const AT_ONCE: usize = 256;

/// Follows a mill along its way.
pub(super) fn borne(stretches: &[Stretch], work: &Work<'_>) -> Borne {
    let Some(reached) = Reached::new(work) else { return Borne::default() };
    let length = stretches.iter().map(Stretch::length).sum::<f64>();
    let step = (work.radius.to_f64() / STEPS).max(length / MOST_STEPS);
    let walls = Edges::new(work.areas);
    let tiles: Vec<(Tile, Vec<usize>)> = reached.tiles(stretches).into_iter().collect();
    let load = |(tile, near): &(Tile, Vec<usize>)| {
        let mut mill = Mill::new(&reached, *tile, &walls, work);
        near.iter().for_each(|&number| mill.follow(&stretches[number], step));
        mill.load
    };
    let add = |all: Load, tiles: &[(Tile, Vec<usize>)]| {
        let loads: Vec<Load> = tiles.par_iter().map(load).collect();
        loads.into_iter().fold(all, Load::and)
    };
    tiles.chunks(AT_ONCE).fold(Load::default(), add).borne()
}

impl Stretch {
    fn length(&self) -> f64 {
        let [a, b] = self.ends;
        let (x, y) = (b.0 - a.0, b.1 - a.1);
        (x * x + y * y).sqrt()
    }
}

/// A tile, by its row and column.
type Tile = (i32, i32);

/// What of areas the mill reaches, as far as it counts.
struct Reached {
    edges: Edges,
    /// Where the first tile begins.
    corner: Spot,
    radius: f64,
    /// How wide a cell is.
    pitch: f64,
}

impl Reached {
    fn new(work: &Work<'_>) -> Option<Self> {
        let radius = work.radius;
        let fits = work.areas.iter().flat_map(|area| offset(area, -radius + SLOT, FLATTEN));
        let burr = Nm::from_f64(radius.to_f64() * BURR);
        let reached = fits.flat_map(|fit| offset(&fit, radius - SLOT - burr, FLATTEN));
        let reached = union(&reached.collect::<Vec<_>>());
        let around = reached.iter().map(Polygon::bounds).reduce(Rect::union)?;
        let (corner, radius) = (around.min().to_f64(), radius.to_f64());
        let area = around.width().to_f64() * around.height().to_f64();
        let pitch = (radius / ACROSS).max((area / MOST_CELLS).sqrt());
        Some(Self { edges: Edges::new(&reached), corner, radius, pitch })
    }

    /// How wide a tile is.
    fn side(&self) -> f64 {
        self.radius * TILE
    }

    /// How far ahead of its middle a mill feels material.
    fn ahead(&self) -> f64 {
        self.radius + (self.radius * AHEAD).max(1.5 * self.pitch)
    }

    /// How far beyond a tile its field reaches: as far as a mill that leads into it feels.
    fn margin(&self) -> f64 {
        self.radius * LEAD + self.ahead() + self.pitch
    }

    /// The tiles that stretches come near, with the numbers of these.
    fn tiles(&self, stretches: &[Stretch]) -> BTreeMap<Tile, Vec<usize>> {
        let mut tiles: BTreeMap<Tile, Vec<usize>> = BTreeMap::new();
        let reach = self.margin() + self.radius;
        for (number, stretch) in stretches.iter().enumerate() {
            let [a, b] = stretch.ends;
            let place = |tile: i32| self.corner.1 + f64::from(tile) * self.side();
            let tiles_of = |low: f64, high: f64, from: f64| {
                let tile = |place: f64| tile(((place - from) / self.side()).floor());
                tile(low - reach)..=tile(high + reach)
            };
            let [_, bottom, _, top] = spanned(a, b);
            for row in tiles_of(bottom, top, self.corner.1) {
                // What of it is as near to the row of tiles: of a level one all.
                let at = |y: f64, level: f64| {
                    let part = if top > bottom { (y - a.1) / (b.1 - a.1) } else { level };
                    between(a, b, part.clamp(0.0, 1.0)).0
                };
                let (low, high) = (at(place(row) - reach, 0.0), at(place(row + 1) + reach, 1.0));
                for column in tiles_of(low.min(high), low.max(high), self.corner.0) {
                    tiles.entry((row, column)).or_default().push(number);
                }
            }
        }
        tiles
    }
}

/// How deep each place of a tile is milled: rows of cells.
struct Field {
    corner: Spot,
    pitch: f64,
    /// How many cells there are in a row, and how many rows.
    across: usize,
    /// In parts of the whole depth; all of it where nothing counts.
    depths: Vec<u16>,
    part: f64,
}

impl Field {
    /// What is reached in a square.
    fn new(reached: &Reached, corner: Spot, side: f64, part: f64) -> Self {
        let pitch = reached.pitch;
        let across = count(side / pitch) + 1;
        let depths = vec![quantum(PARTS); across * across];
        let mut field = Self { corner, pitch, across, depths, part };
        for row in 0..across {
            let mut crossings = reached.edges.crossings(field.height(row));
            crossings.sort_by(f64::total_cmp);
            let (inside, _) = crossings.as_chunks::<2>();
            for &[from, to] in inside {
                let [from, to] = [from, to].map(|x| field.cell(field.in_cells((x, 0.0)).0));
                field.depths[row * across..][from..to].fill(0);
            }
        }
        field
    }

    /// The height of the middles of a row of cells.
    fn height(&self, row: usize) -> f64 {
        self.corner.1 + (number_of(row) + 0.5) * self.pitch
    }

    /// A place in cells from the corner.
    fn in_cells(&self, (x, y): Spot) -> Spot {
        ((x - self.corner.0) / self.pitch, (y - self.corner.1) / self.pitch)
    }

    /// The first cell whose middle lies beyond so many cells from the corner.
    fn cell(&self, place: f64) -> usize {
        count(place + 0.5).min(self.across)
    }

    /// How deep a place is milled; as deep as can be beside the field.
    fn at(&self, at: Spot) -> f64 {
        let (x, y) = self.in_cells(at);
        if x < 0.0 || y < 0.0 || count(x).max(count(y)) >= self.across {
            return f64::INFINITY;
        }
        f64::from(self.depths[count(y) * self.across + count(x)]) * self.part
    }

    /// Lowers a disc to a depth, but for what a disc round `before` has lowered already; how many
    /// cells were higher.
    fn lower(&mut self, center: Spot, radius: f64, depth: f64, before: Option<Spot>) -> usize {
        let mut lowered = 0;
        let depth = quantum(depth / self.part);
        // In cells from the corner.
        let (center, before) = (self.in_cells(center), before.map(|at| self.in_cells(at)));
        let radius = radius / self.pitch;
        let run = |(x, y): Spot, row: f64| {
            let half = (radius * radius - (row - y) * (row - y)).max(0.0).sqrt();
            (x - half, x + half)
        };
        for j in self.cell(center.1 - radius)..self.cell(center.1 + radius) {
            let y = number_of(j) + 0.5;
            let (from, to) = run(center, y);
            let known = before.map_or((to, to), |at| run(at, y));
            for (from, to) in [(from, to.min(known.0)), (from.max(known.1), to)] {
                let [from, to] = [from, to].map(|x| self.cell(x));
                let cells = &mut self.depths[j * self.across..][..self.across];
                for cell in cells.get_mut(from..to).unwrap_or_default() {
                    lowered += usize::from(*cell < depth);
                    *cell = (*cell).max(depth);
                }
            }
        }
        lowered
    }
}

/// How much nearer to the wall than its radius a mill may be, in a slot as wide as it is. Chosen:
/// rounding is less.
const SLOT: Nm = Nm::from_um(1);

/// A mill on its way near a tile.
struct Mill<'a> {
    field: Field,
    work: &'a Work<'a>,
    walls: &'a Edges,
    /// Where what it bears is told: left, bottom, right and top.
    tile: [f64; 4],
    /// How far ahead it feels, and how far beyond the tile it matters.
    ahead: f64,
    beyond: f64,
    /// The directions of the points of the half that leads, from straight on.
    points: Vec<Spot>,
    last: Option<(Spot, f64)>,
    /// What it bore on the last of its way, with how long each part was.
    lately: VecDeque<(f64, f64)>,
    load: Load,
}

/// What a mill bears in a tile.
struct Load {
    most: f64,
    at: Spot,
    line: u32,
    order: usize,
    /// How far it went with each engagement.
    bins: Vec<f64>,
    way: f64,
    level: f64,
    air: f64,
    lifted: f64,
}

impl Default for Load {
    fn default() -> Self {
        let (at, order, bins) = ((0.0, 0.0), usize::MAX, vec![0.0; BINS + 1]);
        Self { most: 0.0, at, line: 0, order, bins, way: 0.0, level: 0.0, air: 0.0, lifted: 0.0 }
    }
}

impl Load {
    /// Both together.
    fn and(mut self, other: Self) -> Self {
        self.bins.iter_mut().zip(&other.bins).for_each(|(bin, more)| *bin += more);
        self.way += other.way;
        self.level += other.level;
        self.air += other.air;
        self.lifted += other.lifted;
        if other.most > self.most || (other.most >= self.most && other.order < self.order) {
            let Self { most, at, line, order, .. } = other;
            return Self { most, at, line, order, ..self };
        }
        self
    }

    fn borne(self) -> Borne {
        let whole: f64 = self.bins.iter().sum();
        let mut sum = 0.0;
        let above = self.bins.iter().rposition(|&length| {
            sum += length;
            sum > whole * 0.01
        });
        let part = |length: f64, of: f64| if of > 0.0 { length / of } else { 0.0 };
        Borne {
            most: self.most,
            at: self.at,
            line: self.line,
            p99: above.map_or(0.0, |bin| number_of(bin + 1) / number_of(BINS)).min(self.most),
            air: part(self.air, self.level),
            lifted: part(self.lifted, self.way),
        }
    }
}

/// Whether a box, grown by so much, holds a place; of two beside each other one does.
fn holds([left, bottom, right, top]: [f64; 4], by: f64, (x, y): Spot) -> bool {
    x >= left - by && x < right + by && y >= bottom - by && y < top + by
}

impl<'a> Mill<'a> {
    fn new(reached: &Reached, (row, column): Tile, walls: &'a Edges, work: &'a Work<'a>) -> Self {
        let point = |i: u32| {
            let angle = ((f64::from(i) + 0.5) / f64::from(POINTS) - 0.5) * std::f64::consts::PI;
            let (side, on) = libm::sincos(angle);
            (on, side)
        };
        let (side, margin) = (reached.side(), reached.margin());
        let (left, bottom) =
            (reached.corner.0 + f64::from(column) * side, reached.corner.1 + f64::from(row) * side);
        let corner = (left - margin, bottom - margin);
        Self {
            field: Field::new(reached, corner, side + 2.0 * margin, work.depth.to_f64() / PARTS),
            work,
            walls,
            tile: [left, bottom, left + side, bottom + side],
            ahead: reached.ahead(),
            beyond: margin + reached.radius,
            points: (0..POINTS).map(point).collect(),
            last: None,
            lately: VecDeque::new(),
            load: Load::default(),
        }
    }

    fn follow(&mut self, stretch: &Stretch, step: f64) {
        let [from, to] = stretch.ends;
        let radius = self.work.radius.to_f64();
        let length = stretch.length();
        let steps = (length / step).ceil().max(1.0);
        let heading =
            if length > 0.0 { ((to.0 - from.0) / length, (to.1 - from.1) / length) } else { (0.0, 0.0) };
        let mut number = 1.0;
        while number <= steps {
            let part = number / steps;
            number += 1.0;
            let at = (from.0 + (to.0 - from.0) * part, from.1 + (to.1 - from.1) * part);
            if !holds(self.tile, self.beyond, at) {
                self.last = None;
                self.lately.clear();
                continue;
            }
            let depth = stretch.depths[0] + (stretch.depths[1] - stretch.depths[0]) * part;
            if depth > 0.0 {
                let known = self.last.filter(|&(_, before)| before >= depth).map(|(at, _)| at);
                let lowered = number_of(self.field.lower(at, radius, depth, known));
                let area = lowered * self.field.pitch * self.field.pitch;
                if !holds(self.tile, radius * LEAD, at) {
                    self.lately.clear();
                } else if length > 0.0 {
                    let cuts = lowered > FEW && area > length / steps * radius * THINNEST;
                    self.feel(at, heading, (depth, length / steps), cuts, stretch);
                }
            }
            self.last = Some((at, depth));
        }
    }

    /// What it meets ahead at a place, so deep and on a part of its way so long, on which it `cuts`
    /// or does not.
    fn feel(&mut self, at: Spot, heading: Spot, (depth, length): (f64, f64), cuts: bool, stretch: &Stretch) {
        let mut angle = self.angle(at, heading, depth, &[], stretch.order);
        for asked in 1..=self.work.sweeps.len() {
            if engaged(angle) > self.work.allowed {
                angle = self.angle(at, heading, depth, &self.work.sweeps[..asked], stretch.order);
            }
        }
        let part = self.lasting(engaged(angle), length);
        if !holds(self.tile, 0.0, at) {
            return;
        }
        if part > self.load.most {
            (self.load.most, self.load.at) = (part, at);
            (self.load.line, self.load.order) = (stretch.line, stretch.order);
        }
        self.load.way += length;
        let pass = self.work.pass;
        let is_level = (stretch.depths[0] - stretch.depths[1]).abs() < LEVEL
            && (depth / pass - (depth / pass).round()).abs() * pass < LEVEL;
        if cuts {
            self.load.bins[count(part * number_of(BINS)).min(BINS)] += length;
        } else if !is_level {
            self.load.lifted += length;
        }
        let radius = self.work.radius.to_f64();
        if is_level && (cuts || self.walls.nearest(at).0 > radius * (1.0 + 2.0 * BURR)) {
            self.load.level += length;
            self.load.air += if cuts { 0.0 } else { length };
        }
    }

    /// What it bore all along the last of its way, at both ends of it, too.
    fn lasting(&mut self, part: f64, length: f64) -> f64 {
        self.lately.push_back((part, length));
        let burr = self.work.radius.to_f64() * BURR;
        let mut way: f64 = self.lately.iter().skip(1).map(|lately| lately.1).sum();
        while let Some(&(_, next)) = self.lately.get(1)
            && way - next >= burr
        {
            way -= next;
            self.lately.pop_front();
        }
        self.lately.iter().map(|lately| lately.0).fold(f64::INFINITY, f64::min)
    }

    /// The angle along which it meets material, each part weighted by how much of a pass that is
    /// high, less what of the motions that are asked those before this one have cleared.
    fn angle(&self, at: Spot, heading: Spot, depth: f64, asked: &[&Sweeps], order: usize) -> f64 {
        let radius = self.work.radius.to_f64();
        let ahead = self.ahead;
        let next = radius - WITHIN;
        let mut sum = 0.0;
        for &(on, side) in &self.points {
            let way = (heading.0 * on - heading.1 * side, heading.1 * on + heading.0 * side);
            let at = |off: f64| (at.0 + way.0 * off, at.1 + way.1 * off);
            let mut known = self.field.at(at(ahead));
            for sweeps in asked {
                if depth - known > self.work.pass * THIN {
                    known = known.max(sweeps.deepest(at(next), order));
                }
            }
            let height = depth - known;
            if height > self.work.pass * THIN {
                sum += (height / self.work.pass).min(1.0);
            }
        }
        sum * std::f64::consts::PI / f64::from(POINTS)
    }
}

/// The radial engagement that an angle of contact means.
fn engaged(angle: f64) -> f64 {
    (1.0 - libm::cos(angle)) / 2.0
}

/// A mill cuts where it takes a strip wider than this part of its radius, and more cells than
/// these. Chosen: above what cells along the edge of what is cleared already are off.
const THINNEST: f64 = 0.01;
const FEW: f64 = 2.0;

/// Depths that differ by less are one, in nanometres: the last digit of a program.
const LEVEL: f64 = 1_500.0;

/// A layer of less than this part of a pass is none. Chosen: rounding of depths.
const THIN: f64 = 0.004;

/// The number of a column or row of tiles.
#[expect(clippy::cast_possible_truncation, reason = "`as` saturates")]
const fn tile(number: f64) -> i32 {
    number as i32
}

/// A number of cells; zero for less than one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
const fn count(number: f64) -> usize {
    number as usize
}

/// Parts of the whole depth.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
const fn quantum(parts: f64) -> u16 {
    parts.round() as u16
}

/// A number of cells as one that is not whole.
fn number_of(count: usize) -> f64 {
    f64::from(u32::try_from(count).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::verify::runs::Sweep;

    /// A square of 20 mm, a mill of 2 mm, and ways along y = 0 … so far beside each other.
    fn borne_beside(ways: &[f64], depths: &[f64]) -> Borne {
        let at = |x: i64, y: i64| Point::new(Nm::from_mm(x), Nm::from_mm(y));
        let square = Polygon::rectangle(Rect::new(at(-10, -10), at(10, 10)));
        // Each ends before the one beside it, clear of the rounded end of the groove.
        let ends = |y: f64| [(-8e6 + 5.0 * y, y), (8e6 - 5.0 * y, y)];
        let all = || ways.iter().zip(depths).zip(0..);
        let sweeps = all().map(|((&y, &depth), order)| {
            let [from, to] = ends(y);
            Sweep { from, to, radius: 1e6, depth, order }
        });
        let sweeps = Sweeps::new(sweeps.collect());
        let stretches =
            all().map(|((&y, &depth), order)| Stretch { ends: ends(y), depths: [depth; 2], line: 1, order });
        let work = Work {
            areas: &[square],
            radius: Nm::from_mm(1),
            depth: Nm::from_mm(1),
            pass: 1e6,
            allowed: 0.17,
            sweeps: [&sweeps, &Sweeps::new(Vec::new())],
        };
        borne(&stretches.collect::<Vec<_>>(), &work)
    }

    #[test]
    fn a_groove_is_all_and_a_step_beside_it_what_it_is() {
        let groove = borne_beside(&[0.0], &[1e6]);
        assert!(groove.most > 0.97, "half of the circumference: {groove:?}");
        let thin = borne_beside(&[0.0], &[0.25e6]);
        let quarter = (1.0 - libm::cos(std::f64::consts::PI / 4.0)) / 2.0;
        assert!((thin.most - quarter).abs() < 0.01, "a quarter of the height: {thin:?}");
        let ways = [0.0, 0.3e6, 0.6e6];
        let beside = borne_beside(&ways, &[1e6; 3]);
        assert!(beside.p99 > 0.9, "the groove is more than a hundredth: {beside:?}");
        let layered: Vec<f64> = (1..=100).map(|i| f64::from(i) * 1e4).collect();
        let [ys, depths] = [[vec![0.0; 100], ways[1..].to_vec()].concat(), [layered, vec![1e6; 2]].concat()];
        let beside = borne_beside(&ys, &depths);
        let is_near = (beside.p99 - 0.15).abs() < 0.012 && beside.most < 0.17;
        assert!(is_near, "0.3 mm of 2 mm, some more at the end of the groove: {beside:?}");
        assert!(borne_beside(&[0.0, 0.0], &[1e6; 2]).air > 0.45, "the second time there is air");
    }
}
