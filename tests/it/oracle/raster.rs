//! The raster engine by brute force: every pixel asks every surface, in `f64` and integers.

#![expect(clippy::cast_precision_loss, reason = "the tolerance is far above an f64's rounding")]

use voromill::raster::{Caps, FillRule, Label, PixelPoint, Sides, Spin, Surface};

/// What a surface says to a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Claim {
    pub depth: f64,
    /// By how much a single-precision computation of the depth may be off.
    pub tolerance: f64,
    /// Nothing is drawn deeper.
    pub limit: f64,
    pub label: Label,
}

/// The roundings of a depth, as `raster`'s docs count them, with each length that enters it.
const ROUNDING: f64 = 10.0 / 16_777_216.0;

/// All claims on the pixel at a column and row.
pub(crate) fn claims(scene: &[(Label, Surface)], column: i32, row: i32) -> Vec<Claim> {
    let sample = (256 * i64::from(column) + 128, 256 * i64::from(row) + 128);
    scene.iter().filter_map(|(label, surface)| claim(*label, surface, sample)).collect()
}

fn claim(label: Label, surface: &Surface, p: (i64, i64)) -> Option<Claim> {
    let flat =
        |depth: f64, size: f64| Claim { depth, tolerance: size * ROUNDING, limit: f64::INFINITY, label };
    let stroke = |distance: f64, size: f64, offset: f32, limit: Option<f32>| Claim {
        depth: (distance - f64::from(offset)).max(0.0),
        tolerance: (distance + size + f64::from(offset.abs())) * ROUNDING,
        limit: limit.map_or(f64::INFINITY, f64::from),
        label,
    };
    match surface {
        Surface::Polygon { contours, rule, depth } => {
            let winding: i32 = contours.iter().map(|ring| winding(ring, p)).sum();
            let inside = match rule {
                FillRule::NonZero => winding != 0,
                FillRule::EvenOdd => winding.rem_euclid(2) == 1,
            };
            inside.then(|| flat(f64::from(*depth), 0.0))
        }
        Surface::Triangle { corners, depths } => {
            let area = cross(raw(corners[0]), raw(corners[1]), raw(corners[2]));
            if area == 0 || winding(corners, p) == 0 {
                return None;
            }
            let part = |a: usize, b: usize| cross(raw(corners[a]), raw(corners[b]), p) as f64 / area as f64;
            let [a, b, c] = depths.map(f64::from);
            Some(flat(a * part(1, 2) + b * part(2, 0) + c * part(0, 1), a.abs() + b.abs() + c.abs()))
        }
        Surface::Cone { apex, offset, limit } => Some(stroke(distance(raw(*apex), p), 0.0, *offset, *limit)),
        Surface::Curtain { from, to, caps, sides, offset, limit } => {
            let (a, b) = (raw(*from), raw(*to));
            let length = distance(a, b);
            if !on_side(*sides, cross(a, b, p)) {
                return None;
            }
            let (before, beyond) = (dot(a, b, p) < 0, dot(b, a, p) < 0);
            let (start, end) = ends(*caps);
            if a == b {
                return (start || end).then(|| stroke(distance(a, p), 0.0, *offset, *limit));
            }
            let to_segment = match (before, beyond) {
                (true, _) if start => distance(a, p),
                (_, true) if end => distance(b, p),
                (false, false) => cross(a, b, p).abs() as f64 / 65536.0 / length,
                _ => return None,
            };
            Some(stroke(to_segment, length, *offset, *limit))
        }
        Surface::Ring { center, start, end, spin, caps, offset, limit } => {
            let (c, s, e) = (raw(*center), raw(*start), raw(*end));
            let radius = f64::midpoint(distance(c, s), distance(c, e));
            let (capped_start, capped_end) = ends(*caps);
            let to_arc = if in_sector(c, s, e, *spin, p) {
                (distance(c, p) - radius).abs()
            } else {
                let to_start = if capped_start { distance(s, p) } else { f64::INFINITY };
                to_start.min(if capped_end { distance(e, p) } else { f64::INFINITY })
            };
            (to_arc < f64::INFINITY).then(|| stroke(to_arc, 2.0 * radius, *offset, *limit))
        }
    }
}

fn raw(p: PixelPoint) -> (i64, i64) {
    (i64::from(p.x.raw()), i64::from(p.y.raw()))
}

/// In pixels.
fn distance(a: (i64, i64), b: (i64, i64)) -> f64 {
    let (x, y) = (a.0 - b.0, a.1 - b.1);
    ((x * x + y * y) as f64).sqrt() / 256.0
}

/// Positive where `p` lies clockwise of the way from `a` to `b` (y points down).
fn cross(a: (i64, i64), b: (i64, i64), p: (i64, i64)) -> i64 {
    (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0)
}

fn dot(a: (i64, i64), b: (i64, i64), p: (i64, i64)) -> i64 {
    (b.0 - a.0) * (p.0 - a.0) + (b.1 - a.1) * (p.1 - a.1)
}

fn ends(caps: Caps) -> (bool, bool) {
    match caps {
        Caps::None => (false, false),
        Caps::Start => (true, false),
        Caps::End => (false, true),
        Caps::Both => (true, true),
    }
}

fn on_side(sides: Sides, cross: i64) -> bool {
    match sides {
        Sides::Both => true,
        Sides::Left => cross <= 0,
        Sides::Right => cross >= 0,
    }
}

fn in_sector(c: (i64, i64), s: (i64, i64), e: (i64, i64), spin: Spin, p: (i64, i64)) -> bool {
    let (s, e) = match spin {
        Spin::Clockwise => (s, e),
        Spin::CounterClockwise => (e, s),
    };
    let (turn, after, before) = (cross(c, s, e), cross(c, s, p) >= 0, cross(c, p, e) >= 0);
    let half = turn == 0 && dot(c, s, e) < 0;
    if s == e {
        true
    } else if turn > 0 || half {
        after && before
    } else {
        after || before
    }
}

/// How often a ring winds round a sample; one on an edge is inside on the left and on the top.
fn winding(ring: &[PixelPoint], p: (i64, i64)) -> i32 {
    if ring.len() < 3 {
        return 0;
    }
    let edges = ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| (raw(a), raw(b)));
    edges
        .map(|(a, b)| {
            if a.1 <= p.1 && p.1 < b.1 && cross(a, b, p) <= 0 {
                1
            } else if b.1 <= p.1 && p.1 < a.1 && cross(b, a, p) <= 0 {
                -1
            } else {
                0
            }
        })
        .sum()
}
