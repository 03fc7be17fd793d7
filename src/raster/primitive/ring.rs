use super::super::block::Block;
use super::super::cell::Cell;
use super::super::half_plane::{Convex, Cover, HalfPlane};
use super::super::{Caps, Label, PixelPoint, Spin};
use super::cone::float;
use super::{Reach, Stroke};

/// A circular arc's distance; stored as it runs clockwise.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Ring {
    center: (i32, i32),
    start: (i32, i32),
    end: (i32, i32),
    caps: Caps,
    stroke: Stroke,
    /// In steps.
    radius: f32,
}

/// The sector between two rays, decided in integers: convex up to half a turn, else what a convex one leaves.
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

    pub(super) fn reach(&self, cell: Cell) -> Option<Reach> {
        let (x, y) = cell.center();
        let to = |p: (i32, i32)| {
            let (dx, dy) = (x - f64::from(p.0) / 256.0, y - f64::from(p.1) / 256.0);
            (dx * dx + dy * dy).sqrt()
        };
        let radius = f64::from(self.radius) / 256.0;
        let ring = (to(self.center) - radius).abs();
        let cap = match self.caps {
            Caps::None => f64::INFINITY,
            Caps::Start => to(self.start),
            Caps::End => to(self.end),
            Caps::Both => to(self.start).min(to(self.end)),
        };
        let size = 2.0 * radius;
        match self.sector().cover(cell) {
            Cover::Whole => self.stroke.reach(ring, ring, size, Cover::Whole, cell),
            Cover::Empty if cap.is_infinite() => None,
            Cover::Empty => self.stroke.reach(cap, cap, size, Cover::Whole, cell),
            Cover::Part if cap.is_infinite() => self.stroke.reach(ring, ring, size, Cover::Part, cell),
            Cover::Part => self.stroke.reach(ring.min(cap), ring.max(cap), size, Cover::Whole, cell),
        }
    }

    pub(super) fn draw(&self, label: Label, cover: Cover, block: &mut Block) {
        let sector = self.sector();
        let limit = self.stroke.limit;
        let whole = cover == Cover::Whole && sector.cover(block.cell()) == Cover::Whole;
        for mut row in block.rows() {
            let arc = self.along(row.y);
            if whole {
                row.draw(label, arc);
                continue;
            }
            let all = row.columns();
            let cap = self.caps_along(row.y);
            match &sector {
                Sector::All => row.draw_part(label, &all, limit, arc),
                Sector::Convex(convex) => {
                    let within = convex.columns(row.y, all.clone());
                    row.draw_part(label, &within, limit, arc);
                    row.draw_part(label, &(all.start..within.start), limit, cap);
                    row.draw_part(label, &(within.end..all.end), limit, cap);
                }
                Sector::Rest(convex) => {
                    let without = convex.columns(row.y, all.clone());
                    row.draw_part(label, &without, limit, cap);
                    row.draw_part(label, &(all.start..without.start), limit, arc);
                    row.draw_part(label, &(without.end..all.end), limit, arc);
                }
            }
        }
    }

    /// The depth of the arc's strip along the row at `y`, by the sample position: | |w| − radius |.
    #[inline(always)]
    fn along(&self, y: i32) -> impl Fn(i32) -> f32 + Copy {
        let (center, radius, stroke) = (self.center.0, self.radius, self.stroke);
        let dy = float(y - self.center.1);
        let dy2 = dy * dy;
        move |x| {
            let dx = float(x - center);
            stroke.depth(((dx * dx + dy2).sqrt() - radius).abs() * (1.0 / 256.0))
        }
    }

    /// The depth of the round ends: the distance to the nearer of those there are.
    #[inline(always)]
    fn caps_along(&self, y: i32) -> impl Fn(i32) -> f32 + Copy {
        let (start, end, stroke) = (self.start, self.end, self.stroke);
        let square = |dy: f32, there: bool| if there { dy * dy } else { f32::INFINITY };
        let start_y2 = square(float(y - start.1), self.caps.start());
        let end_y2 = square(float(y - end.1), self.caps.end());
        move |x| {
            let (to_start, to_end) = (float(x - start.0), float(x - end.0));
            let (a, b) = (to_start * to_start + start_y2, to_end * to_end + end_y2);
            let nearer = if a < b { a } else { b };
            stroke.depth(nearer.sqrt() * (1.0 / 256.0))
        }
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
