//! Round a contour with a cutter that cannot plunge: wherever it goes down into the board it goes
//! down a ramp.
//!
//! ```text
//!  ╲              the surface  ┌ tab ┐
//!    ╲  turn by turn     ────────┘     └╱╲  to and fro
//!      ╲  down to where tabs begin       ────────→  and on
//! ```
//!
//! As far down as tabs begin the contour is cut as a helix. What the last turn leaves of the ramp
//! is cut level. Below, each stretch between two tabs is a place of its own: the ramp goes down it
//! to and fro, so that nothing of it is left where it began.

use crate::geometry::Nm;
use crate::toolpath::Angle;
use crate::toolpath::head::Head;

use super::ring::Ring;
use super::{Cutout, go_to, stretched};

/// Less than this way along the contour, in nanometres, is none: what programs write.
const NOTHING: f64 = 1_000.0;

/// One contour in all its passes, from its start, over which the head is.
pub(super) fn cut(head: &mut Head, ring: &Ring, middles: &[f64], angle: Angle, settings: &Cutout<'_>) {
    let slope = libm::tan(angle.radians());
    let heights = settings.heights;
    let has_tabs = !middles.is_empty() && settings.tabs.top < heights.cut;
    let floor = if has_tabs { settings.tabs.top.max(Nm::ZERO) } else { heights.cut };
    head.plunge(Nm::ZERO);
    let mut before = Nm::ZERO;
    let mut left = 0.0;
    for depth in heights.passes().filter(|&depth| depth < floor).chain([floor]) {
        left = turns(head, ring, [before, depth], slope, settings);
        before = depth;
    }
    level(head, ring, left, has_tabs, settings);
    for depth in heights.passes().filter(|&depth| depth > floor) {
        for stretch in stretched(ring, middles, settings) {
            if stretch.is_tab {
                go_to(head, floor, settings);
                head.follow(&ring.between(stretch.from, stretch.to), settings.tool.feed);
            } else {
                // What was cut before is air.
                go_to(head, before, settings);
                to_and_fro(head, ring, [stretch.from, stretch.to], [before, depth], slope, settings);
            }
        }
        before = depth;
    }
}

/// Round the contour, as often as the slope asks for, from one depth to another; returns how long
/// the ramp of the last turn is, which is left.
fn turns(head: &mut Head, ring: &Ring, [from, to]: [Nm; 2], slope: f64, settings: &Cutout<'_>) -> f64 {
    let (length, feed) = (ring.length(), settings.tool.feed);
    let ramp = (to - from).to_f64() / slope;
    let turns = (ramp / length).ceil().max(1.0);
    let each = ramp / turns;
    let mut done = 0.0;
    while done < turns {
        done += 1.0;
        let depth = from + Nm::from_f64((to - from).to_f64() * done / turns);
        // The rest of a turn that is nearly all ramp is no way.
        if each > length - NOTHING {
            head.descend(&ring.between(0.0, length), depth, feed);
        } else {
            if each >= NOTHING {
                head.descend(&ring.between(0.0, each), depth, feed);
            }
            go_to(head, depth, settings);
            head.follow(&ring.between(each, length), feed);
        }
    }
    each
}

/// Cuts what the last ramp has left, `ramp` long from the contour's start; and comes back there if
/// more is to follow.
fn level(head: &mut Head, ring: &Ring, ramp: f64, returns: bool, settings: &Cutout<'_>) {
    let (length, feed) = (ring.length(), settings.tool.feed);
    if ramp < NOTHING {
        return;
    }
    let is_round = ramp > length - NOTHING || (returns && ramp > length / 2.0);
    let way = ring.between(0.0, if is_round { length } else { ramp });
    head.follow(&way, feed);
    if returns && !is_round {
        head.follow(&way.reversed(), feed);
    }
}

/// Down a stretch from one depth to another, to and fro at its beginning, and then along all of it.
fn to_and_fro(
    head: &mut Head,
    ring: &Ring,
    [begin, end]: [f64; 2],
    [from, to]: [Nm; 2],
    slope: f64,
    settings: &Cutout<'_>,
) {
    let feed = settings.tool.feed;
    let ramp = (to - from).to_f64() / slope;
    let pairs = (ramp / (2.0 * (end - begin))).ceil().max(1.0);
    let reach = ramp / (2.0 * pairs);
    if reach >= NOTHING {
        let there = ring.between(begin, begin + reach);
        let back = there.reversed();
        let mut done = 0.0;
        while done < pairs {
            for (way, legs) in [(&there, 0.5), (&back, 1.0)] {
                let share = (done + legs) / pairs;
                head.descend(way, from + Nm::from_f64((to - from).to_f64() * share), feed);
            }
            done += 1.0;
        }
    }
    go_to(head, to, settings);
    head.follow(&ring.between(begin, end), feed);
}
