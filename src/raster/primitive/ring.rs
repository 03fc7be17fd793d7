//! The distance to a circular arc, as a surface.

use std::ops::Range;

use super::super::canvas::{Canvas, Extent, Field, Slope};
use super::super::cell::Cell;
use super::super::half_plane::{Convex, Cover, HalfPlane};
use super::super::lanes::Lanes;
use super::super::mosaic::Mosaic;
use super::super::simd::Simd;
use super::super::subpixel::sample;
use super::super::{Caps, Label, PixelPoint, Spin};
use super::cone::floats;
use super::stroke::StrokeLanes;
use super::{Bounds, Stroke, at};

/// A circular arc's distance; stored as it runs clockwise.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Ring {
    center: (i32, i32),
    start: (i32, i32),
    end: (i32, i32),
    caps: Caps,
    pub stroke: Stroke,
    /// In steps.
    radius: f32,
}

/// The sector between two rays, decided in integers: convex up to half a turn, else what a convex
/// one leaves.
enum Sector {
    All,
    Convex(Convex<2>),
    Rest(Convex<2>),
}

impl Ring {
    pub(in super::super) fn new(
        center: PixelPoint,
        start: PixelPoint,
        end: PixelPoint,
        spin: Spin,
        caps: Caps,
        stroke: Stroke,
    ) -> Self {
        let (start, end, caps) = match spin {
            Spin::Clockwise => (start, end, caps),
            Spin::CounterClockwise => (end, start, caps.reversed()),
        };
        let (center, start, end) = (center.raw(), start.raw(), end.raw());
        let radius = f64::midpoint(length(center, start), length(center, end));
        #[expect(clippy::cast_possible_truncation, reason = "rounded correctly")]
        let radius = radius as f32;
        Self { center, start, end, caps, stroke, radius }
    }

    fn sector(&self) -> Sector {
        if self.start == self.end {
            return Sector::All;
        }
        let (s, e) = (way(self.center, self.start), way(self.center, self.end));
        let cross = s.0 * e.1 - s.1 * e.0;
        let opposite = cross == 0 && s.0 * e.0 + s.1 * e.1 < 0;
        let after_start = HalfPlane::clockwise(self.center, s);
        let before_end = HalfPlane::clockwise(self.center, (-e.0, -e.1));
        if cross > 0 || opposite {
            Sector::Convex(Convex([Some(after_start), Some(before_end)]))
        } else {
            Sector::Rest(Convex([Some(after_start.complement()), Some(before_end.complement())]))
        }
    }

    pub(super) fn bounds(&self) -> Bounds {
        let circle = Bounds::curve([self.center], self.radius / 256.0, self.stroke.offset, self.stroke.limit);
        circle.union(Bounds::curve([self.start, self.end], 0.0, self.stroke.offset, self.stroke.limit))
    }

    /// The depth at a pixel, infinite where there is none; the limit is the caller's to apply.
    pub(super) fn depth_at(&self, column: i32, row: i32) -> f32 {
        let inside = match self.sector() {
            Sector::All => true,
            Sector::Convex(convex) => convex.holds(column, row),
            Sector::Rest(convex) => !convex.holds(column, row),
        };
        if inside { at(&Strip(*self), column, row) } else { at(&Ends(*self), column, row) }
    }

    /// Has the mosaic sample it.
    pub(super) fn weigh(&self, mosaic: &mut Mosaic) {
        mosaic.sample(&Weighed(*self), self.stroke.offset, self.radius / 128.0, self.stroke.limit);
    }

    /// Lays it on a block: its strip on the sector, its round ends on the rest.
    pub(super) fn draw(&self, label: Label, cover: Cover, canvas: &mut Canvas) {
        let sector = self.sector();
        let limit = self.stroke.limit;
        if cover == Cover::Whole && sector.cover(canvas.block()) == Cover::Whole {
            canvas.lay(label, &Strip(*self), Extent::Whole);
            return;
        }
        let (all, cell) = (canvas.padded_columns(), canvas.block());
        let mut columns = std::mem::take(&mut canvas.columns);
        // In each row the convex region leaves two pieces: the one before it and the one beyond.
        for piece in [Piece::Within, Piece::Before, Piece::Beyond] {
            let rows = (cell.y..cell.y + cell.height).map(sample);
            columns.clear();
            match &sector {
                Sector::All if piece == Piece::Within => columns.extend(rows.map(|_| all.clone())),
                Sector::All => continue,
                Sector::Convex(convex) | Sector::Rest(convex) => {
                    columns.extend(rows.map(|y| piece.of(&all, &convex.columns(y, all.clone()))));
                }
            }
            if matches!(sector, Sector::Rest(_)) == (piece == Piece::Within) {
                canvas.lay(label, &Ends(*self), Extent::Part(&columns, limit));
            } else {
                canvas.lay(label, &Strip(*self), Extent::Part(&columns, limit));
            }
        }
        canvas.columns = columns;
    }
}

/// A piece of a row, as a convex region cuts it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Piece {
    Before,
    Within,
    Beyond,
}

impl Piece {
    /// The piece of the columns `all`, of which the region holds `within`. Where it holds none, all
    /// lie before it.
    fn of(self, all: &Range<i32>, within: &Range<i32>) -> Range<i32> {
        match self {
            Self::Within => within.clone(),
            Self::Before if within.is_empty() => all.clone(),
            Self::Before => all.start..within.start,
            Self::Beyond if within.is_empty() => all.end..all.end,
            Self::Beyond => within.end..all.end,
        }
    }
}

/// What is known of a surface that bends both ways: how deep it lies, and that it is no steeper
/// than 1.
#[inline(always)]
fn flat_slope<S: Simd>(near: Lanes<S>, far: Lanes<S>) -> Slope<S> {
    let unknown = near.all(f32::INFINITY);
    Slope { near, far, way: (unknown, unknown), curve: unknown }
}

/// The strip of an arc, as if it were the whole circle.
struct Strip(Ring);

#[derive(Clone, Copy)]
struct StripColumns<S: Simd> {
    dx: Lanes<S>,
    dx2: Lanes<S>,
    center_y: Lanes<S>,
    radius: Lanes<S>,
    stroke: StrokeLanes<S>,
}

impl Field for Strip {
    type Columns<S: Simd> = StripColumns<S>;

    #[inline(always)]
    fn columns<S: Simd>(&self, simd: S, x: Lanes<S>) -> Self::Columns<S> {
        let (x0, y0) = floats(self.0.center);
        let dx = x - Lanes::splat(simd, x0);
        StripColumns {
            dx,
            dx2: dx * dx,
            center_y: Lanes::splat(simd, y0),
            radius: Lanes::splat(simd, self.0.radius),
            stroke: self.0.stroke.lanes(simd),
        }
    }

    #[inline(always)]
    fn depth<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S> {
        let dy = y - columns.center_y;
        columns.stroke.depth(((columns.dx2 + dy * dy).sqrt() - columns.radius).abs())
    }

    #[inline(always)]
    fn slope<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>, _: Lanes<S>) -> Slope<S> {
        let depth = Self::depth(columns, y);
        flat_slope(depth, depth)
    }
}

/// The round ends of an arc: the distance to the nearer of those there are, infinite where there
/// are none.
struct Ends(Ring);

#[derive(Clone, Copy)]
struct EndsColumns<S: Simd> {
    /// The square of the way along x to the start, infinite where it is not round, and the start's
    /// y.
    start: (Lanes<S>, Lanes<S>),
    end: (Lanes<S>, Lanes<S>),
    stroke: StrokeLanes<S>,
}

impl Field for Ends {
    type Columns<S: Simd> = EndsColumns<S>;

    #[inline(always)]
    fn columns<S: Simd>(&self, simd: S, x: Lanes<S>) -> Self::Columns<S> {
        let end = |place: (i32, i32), there: bool| {
            let (end_x, end_y) = floats(place);
            let dx = x - Lanes::splat(simd, end_x);
            (if there { dx * dx } else { x.all(f32::INFINITY) }, Lanes::splat(simd, end_y))
        };
        let Ring { start, end: last, caps, stroke, .. } = self.0;
        EndsColumns {
            start: end(start, caps.start()),
            end: end(last, caps.end()),
            stroke: stroke.lanes(simd),
        }
    }

    #[inline(always)]
    fn depth<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S> {
        let square = |(dx2, end_y): (Lanes<S>, Lanes<S>)| {
            let dy = y - end_y;
            dx2 + dy * dy
        };
        columns.stroke.depth(square(columns.start).min(square(columns.end)).sqrt())
    }

    #[inline(always)]
    fn slope<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>, _: Lanes<S>) -> Slope<S> {
        let depth = Self::depth(columns, y);
        flat_slope(depth, depth)
    }
}

/// Strip and ends together, as far as a piece of a mosaic can tell which of them a sample belongs
/// to.
struct Weighed(Ring);

#[derive(Clone, Copy)]
struct WeighedColumns<S: Simd> {
    strip: StripColumns<S>,
    ends: EndsColumns<S>,
    /// The unit ways to start and end, a pixel: their x, and the columns' part of their cross
    /// products with the way to a sample.
    start: (Lanes<S>, Lanes<S>),
    end: (Lanes<S>, Lanes<S>),
    /// Whether the sector is at most half a turn (all lanes alike), and −∞ where it is the whole
    /// circle.
    convex: Lanes<S>,
    closed: Lanes<S>,
    /// 0 where there is no round end, else −∞.
    bare: Lanes<S>,
}

impl<S: Simd> WeighedColumns<S> {
    /// How many pixels a sample lies inside the sector; negative outside.
    #[inline(always)]
    fn inside(self, y: Lanes<S>) -> Lanes<S> {
        let wy = y - self.strip.center_y;
        // How far clockwise of the start, and counter-clockwise of the end.
        let after_start = self.start.0 * wy - self.start.1;
        let before_end = self.end.1 - self.end.0 * wy;
        let (both, either) = (after_start.min(before_end), after_start.max(before_end));
        y.all(0.0).less(self.convex).select(both, either) - self.closed
    }
}

impl Field for Weighed {
    type Columns<S: Simd> = WeighedColumns<S>;

    #[inline(always)]
    fn columns<S: Simd>(&self, simd: S, x: Lanes<S>) -> Self::Columns<S> {
        let ring = &self.0;
        let (center, start, end) = (floats(ring.center), floats(ring.start), floats(ring.end));
        let (s, e) = ((start.0 - center.0, start.1 - center.1), (end.0 - center.0, end.1 - center.1));
        let splat = |number| Lanes::splat(simd, number);
        let strip = Strip(*ring).columns(simd, x);
        let ray = |(x, y): (f32, f32)| {
            let length = (x * x + y * y).sqrt() * 256.0;
            let (x, y) = if length > 0.0 { (x / length, y / length) } else { (0.0, 0.0) };
            (splat(x), strip.dx * splat(y))
        };
        let sector = ring.sector();
        WeighedColumns {
            strip,
            ends: Ends(*ring).columns(simd, x),
            start: ray(s),
            end: ray(e),
            convex: splat(if matches!(sector, Sector::Convex(_)) { 1.0 } else { 0.0 }),
            closed: splat(if matches!(sector, Sector::All) { f32::NEG_INFINITY } else { 0.0 }),
            bare: splat(if ring.caps == Caps::None { 0.0 } else { f32::NEG_INFINITY }),
        }
    }

    #[inline(always)]
    fn depth<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S> {
        Strip::depth(columns.strip, y)
    }

    #[inline(always)]
    fn slope<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>, radius: Lanes<S>) -> Slope<S> {
        let zero = y.all(0.0);
        let strip = Strip::depth(columns.strip, y);
        let ends = zero.at_most(columns.bare).select(strip, Ends::depth(columns.ends, y));
        let inside = columns.inside(y);
        // The doubt of two roundings in a product of large numbers, far above them.
        let doubt = radius + (strip + columns.strip.radius) * y.all(1.0 / 65536.0);
        let (surely_in, surely_out) = (doubt.less(inside), inside.less(zero - doubt));
        let near = surely_in.select(strip, surely_out.select(ends, strip.min(ends)));
        let far = surely_in.select(strip, surely_out.select(ends, strip.max(ends)));
        flat_slope(near, far)
    }

    #[inline(always)]
    fn beyond<S: Simd>(columns: Self::Columns<S>, y: Lanes<S>) -> Lanes<S> {
        y.all(0.0) - columns.inside(y) + columns.bare
    }
}

impl Sector {
    fn cover(&self, cell: Cell) -> Cover {
        match self {
            Self::All => Cover::Whole,
            Self::Convex(convex) => convex.cover(cell),
            Self::Rest(convex) => match convex.cover(cell) {
                Cover::Empty => Cover::Whole,
                Cover::Part => Cover::Part,
                Cover::Whole => Cover::Empty,
            },
        }
    }
}

fn way(from: (i32, i32), to: (i32, i32)) -> (i64, i64) {
    (i64::from(to.0) - i64::from(from.0), i64::from(to.1) - i64::from(from.1))
}

/// In steps.
fn length(from: (i32, i32), to: (i32, i32)) -> f64 {
    let (x, y) = (f64::from(to.0) - f64::from(from.0), f64::from(to.1) - f64::from(from.1));
    (x * x + y * y).sqrt()
}
