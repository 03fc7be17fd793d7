//! Boring: holes and slots wider than the end mill, milled out along their wall.
//!
//! A hole is a helix down to the bottom and a full turn there; what is wider than two cutters is
//! cleared from the middle outwards. Along the wall one more turn follows at the bottom, the spring
//! pass, which takes what the cutter left by giving way. A slot is the same round its whole length:
//! an obround, deeper with every turn.
//!
//! ```text
//!     ╭───────────────╮      the cutter's middle runs (width − cutter) / 2
//!     │ ╶───────────╴ │      from the slot's axis, against the clock: climb milling
//!     ╰───────────────╯      with a spindle that turns clockwise
//! ```

use crate::board::Hole;
use crate::geometry::{Nm, Path, Point, Segment, Turn, Vector};
use crate::toolpath::head::Head;
use crate::toolpath::order::{Order, Stretch, arrange};
use crate::toolpath::{Heights, Placement, Section, Tool};

/// A turn of the helix goes down at most this part of the cutter's width, whatever a pass may be.
/// Chosen.
const TURN: i64 = 2;

/// Whether `mill` can make this hole: it fits in, and a slot is one straight way.
pub(super) fn fits(hole: &Hole, mill: &Tool, tolerance: Nm) -> bool {
    let wide = mill.width_at(Nm::ZERO) <= hole.diameter + tolerance;
    wide && matches!(hole.path.segments.as_slice(), [] | [Segment::Line { .. }])
}

/// Mills out all `holes` with one end mill; the step of `heights` is how deep a turn goes at most.
pub(super) fn bore(
    holes: &[&Hole],
    mill: &Tool,
    heights: Heights,
    placement: &Placement,
    order: Order,
) -> Section {
    let paths: Vec<Path> = holes.iter().map(|hole| placement.path(&hole.path)).collect();
    let stretches: Vec<Stretch> = paths.iter().map(|path| Stretch::open(path.start, path.start)).collect();
    let mut head = Head::new(heights, mill.plunge);
    for leg in arrange(&stretches, Point::default(), order, 0.0) {
        let (path, hole) = (&paths[leg.stretch], holes[leg.stretch]);
        let reaches = reaches(hole.diameter, mill.width_at(Nm::ZERO));
        for (reach, inside) in reaches.iter().zip((0..reaches.len()).rev()) {
            let turns = if inside == 0 { 2 } else { 1 };
            mill_out(&mut head, path.start, path.end(), *reach, turns, mill, heights);
        }
    }
    let count = holes.len();
    let label = format!("bore {count} {}", if count == 1 { "hole or slot" } else { "holes and slots" });
    Section { tool: mill.clone(), label, moves: head.finish() }
}

/// How far from the axis the cutter's middle runs, from the inside out: as few laps as leave no
/// core.
fn reaches(width: Nm, cutter: Nm) -> Vec<Nm> {
    let last = (width - cutter).max(Nm::ZERO) / 2;
    if last <= cutter / 2 {
        return vec![last];
    }
    // The first turn crosses the axis, and turns a little less than a cutter apart clear everything
    // between them.
    let first = cutter * 9 / 20;
    let apart = (cutter.get() * 9 / 10).max(1);
    let gaps = ((last - first).get() + apart - 1) / apart;
    (0..=gaps).map(|i| first + (last - first) * i / gaps).collect()
}

/// One obround (a circle where both ends are one) down to the bottom, and `turns` there.
fn mill_out(head: &mut Head, a: Point, b: Point, reach: Nm, turns: u32, mill: &Tool, heights: Heights) {
    let most = mill.width_at(Nm::ZERO) / TURN;
    let turn = heights.step.unwrap_or(most).min(most).max(Nm::new(1));
    let depths = Heights { step: Some(turn), ..heights };
    if reach == Nm::ZERO && a == b {
        head.over(a);
        depths.passes().for_each(|depth| head.plunge(depth));
        return head.retract();
    }
    let way = b - a;
    let aside = if a == b { Vector::new(reach, Nm::ZERO) } else { across(way, reach) };
    let laps = obround(a, b, aside);
    head.over(laps.start);
    head.plunge(Nm::ZERO);
    depths.passes().for_each(|depth| head.descend(&laps, depth, mill.feed));
    (0..turns).for_each(|_| head.follow(&laps, mill.feed));
    head.retract();
}

/// A vector of this length a quarter turn clockwise of `way`.
fn across(way: Vector, length: Nm) -> Vector {
    Vector::new(way.y, -way.x).scaled(length.to_f64() / way.length())
}

/// The way round from `a + aside` along to b and back against the clock.
fn obround(a: Point, b: Point, aside: Vector) -> Path {
    let start = a + aside;
    let round = |to: Point, center: Point| Segment::Arc { to, center, turn: Turn::CounterClockwise };
    let segments = if a == b {
        vec![round(start, a)]
    } else if aside == Vector::default() {
        vec![Segment::Line { to: b }, Segment::Line { to: a }]
    } else {
        let (there, back) = (Segment::Line { to: b + aside }, Segment::Line { to: a - aside });
        vec![there, round(b - aside, b), back, round(start, a)]
    };
    Path { start, segments }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laps_clear_everything_from_the_middle_to_the_wall() {
        for width in [1000, 1500, 2000, 3000, 8000, 9999] {
            let cutter = 1000;
            let reaches = reaches(Nm::new(width), Nm::new(cutter));
            let mut cleared = 0;
            for reach in reaches {
                assert!(reach.get() - cutter / 2 <= cleared, "a core stays in a hole of {width}");
                cleared = reach.get() + cutter / 2;
            }
            assert!((cleared - width / 2).abs() <= 1, "the wall of {width} is at {cleared}");
        }
    }
}
