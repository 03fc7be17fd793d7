//! What is cleared, as discs, and how much of the tool's circumference meets material beside them.
//!
//! ```text
//!    cleared     ╱ material       A tool that goes on clears what lies behind its middle, so it meets material along the half of
//!         ╭──╮──╱─ ╌╌╌            its circumference that leads. What discs cover of it are intervals of directions, by the law of
//!        ╱   ╭─┼──╮               cosines; what they leave of the half is the contact, an angle.
//!       │ tool ●──→  heading
//!        ╲   ╰─┼──╯
//! ```

use std::f64::consts::{FRAC_PI_2, PI};

use crate::toolpath::strategy::pocket::course::{Spot, distance};

/// How much larger discs are taken for, as a part of the tool's radius: less than that is a burr.
/// Chosen: above rounding, a tenth of what the wall's loop takes.
const SLACK: f64 = 0.002;

/// The same where burrs count, in nanometres. Chosen: of hundreds of arcs less than a tool is off.
const ROUNDING: f64 = 1.0;

/// Cells of the index in a row or column at most. Chosen: some megabytes.
const MOST_CELLS: f64 = 2000.0;

/// A disc round which the tool's middle has been all over.
#[derive(Clone, Copy, Debug)]
struct Disc {
    center: Spot,
    /// Of what the tool's middle has reached: what is cleared is wider by the tool's radius.
    radius: f64,
}

/// A cell of the index.
#[derive(Clone, Debug, Default)]
struct Cell {
    /// Whether a tool with its middle anywhere in it meets nothing.
    is_free: bool,
    /// The discs that a tool may meet here.
    near: Vec<u32>,
}

/// Discs that are cleared, by place.
#[derive(Debug)]
pub(super) struct Cleared {
    radius: f64,
    corner: Spot,
    cell: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Cell>,
    discs: Vec<Disc>,
    /// The intervals of one question; kept for their memory.
    covered: Vec<(f64, f64)>,
}

impl Cleared {
    /// Nothing, within bounds (left, bottom, right, top), for a tool with this radius.
    pub(super) fn new(radius: f64, [left, bottom, right, top]: [f64; 4]) -> Self {
        let cell = radius.max((right - left).max(top - bottom) / MOST_CELLS).max(1.0);
        let (columns, rows) = (count((right - left) / cell) + 1, count((top - bottom) / cell) + 1);
        Self {
            radius,
            corner: (left, bottom),
            cell,
            columns,
            rows,
            cells: vec![Cell::default(); columns * rows],
            discs: Vec::new(),
            covered: Vec::new(),
        }
    }

    /// Adds a disc that the tool's middle has cleared.
    pub(super) fn add(&mut self, center: Spot, radius: f64) {
        let number = u32::try_from(self.discs.len()).unwrap_or(u32::MAX);
        self.discs.push(Disc { center, radius });
        let reach = radius + 2.0 * self.radius;
        let column = |x: f64| count((x - self.corner.0) / self.cell);
        let row = |y: f64| count((y - self.corner.1) / self.cell);
        let columns = column(center.0 - reach)..=column(center.0 + reach).min(self.columns - 1);
        for j in row(center.1 - reach)..=row(center.1 + reach).min(self.rows - 1) {
            let y = self.corner.1 + as_f64(j) * self.cell - center.1;
            for i in columns.clone() {
                let cell = &mut self.cells[j * self.columns + i];
                if cell.is_free {
                    continue;
                }
                let x = self.corner.0 + as_f64(i) * self.cell - center.0;
                let (near, far) = (near_and_far(x, self.cell), near_and_far(y, self.cell));
                if (far.1 * far.1 + near.1 * near.1).sqrt() <= radius {
                    *cell = Cell { is_free: true, near: Vec::new() };
                } else if (far.0 * far.0 + near.0 * near.0).sqrt() < reach {
                    cell.near.push(number);
                }
            }
        }
    }

    /// Along how much of its leading half, in radians, a tool at `at` meets material that is no
    /// burr when it goes toward `heading`, a unit vector.
    pub(super) fn contact(&mut self, at: Spot, heading: Spot) -> f64 {
        self.contact_beyond(self.radius * SLACK, at, heading)
    }

    /// Along how much of it that tool meets anything.
    pub(super) fn touch(&mut self, at: Spot, heading: Spot) -> f64 {
        self.contact_beyond(ROUNDING, at, heading)
    }

    /// The same of what is farther than `slack` from what is cleared.
    fn contact_beyond(&mut self, slack: f64, at: Spot, heading: Spot) -> f64 {
        let (i, j) = (count((at.0 - self.corner.0) / self.cell), count((at.1 - self.corner.1) / self.cell));
        let Some(cell) = self.cells.get(j * self.columns + i).filter(|_| i < self.columns) else { return PI };
        if cell.is_free {
            return 0.0;
        }
        let tool = self.radius;
        self.covered.clear();
        for &number in cell.near.iter().rev() {
            let disc = self.discs[number as usize];
            let far = distance(at, disc.center);
            if far <= disc.radius + slack {
                return 0.0;
            }
            if far >= disc.radius + 2.0 * tool {
                continue;
            }
            let cleared = disc.radius + tool + slack;
            let cosine = (far * far + tool * tool - cleared * cleared) / (2.0 * far * tool);
            let half = libm::acos(cosine.clamp(-1.0, 1.0));
            let way = (disc.center.0 - at.0, disc.center.1 - at.1);
            let toward =
                libm::atan2(heading.0 * way.1 - heading.1 * way.0, heading.0 * way.0 + heading.1 * way.1);
            for turn in [-2.0 * PI, 0.0, 2.0 * PI] {
                let (low, high) =
                    ((toward - half + turn).max(-FRAC_PI_2), (toward + half + turn).min(FRAC_PI_2));
                if low < high {
                    self.covered.push((low, high));
                }
            }
        }
        self.covered.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut met, mut reached) = (0.0, -FRAC_PI_2);
        for &(low, high) in &self.covered {
            met += (low - reached).max(0.0);
            reached = reached.max(high);
        }
        met + (FRAC_PI_2 - reached).max(0.0)
    }

    /// Whether a tool meets no more than `most` radians of material on a straight way, whichever
    /// way it looks.
    pub(super) fn is_clear(&mut self, from: Spot, to: Spot, most: f64) -> bool {
        let whole = distance(from, to);
        let heading =
            if whole > 0.0 { ((to.0 - from.0) / whole, (to.1 - from.1) / whole) } else { (1.0, 0.0) };
        let steps = (whole / (self.radius * 0.15)).ceil().max(1.0);
        let mut step = 0.0;
        while step <= steps {
            let part = step / steps;
            let at = (from.0 + (to.0 - from.0) * part, from.1 + (to.1 - from.1) * part);
            if self.contact(at, heading) > most {
                return false;
            }
            step += 1.0;
        }
        true
    }
}

/// The least and the greatest distance from zero of what lies between `low` and `low + size`.
fn near_and_far(low: f64, size: f64) -> (f64, f64) {
    let high = low + size;
    (low.max(-high).max(0.0), (-low).max(high))
}

/// A number of cells; zero for less than one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
const fn count(number: f64) -> usize {
    number as usize
}

/// A number of cells as a length.
fn as_f64(number: usize) -> f64 {
    f64::from(u32::try_from(number).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tool of 1 mm in a groove that it has cleared up to where it is.
    #[test]
    fn a_tool_that_goes_on_in_its_groove_meets_half_its_circumference() {
        let mut cleared = Cleared::new(5e5, [-5e6, -5e6, 5e6, 5e6]);
        let mut x = -4e6;
        while x <= 0.0 {
            cleared.add((x, 0.0), 0.0);
            x += 1e4;
        }
        let ahead = cleared.contact((0.0, 0.0), (1.0, 0.0));
        assert!(ahead.abs() < 1e-9, "it is in what is cleared: {ahead}");
        let ahead = cleared.contact((2e4, 0.0), (1.0, 0.0));
        assert!((ahead - PI).abs() < 0.25, "nearly all of the half: {ahead}");
        assert!(cleared.contact((-1e6, 0.0), (0.0, 1.0)).abs() < 0.01, "and nothing where it was");
        assert!(!cleared.is_clear((-3e6, 0.0), (1e6, 0.0), 0.1), "material ahead");
        assert!(cleared.is_clear((-3e6, 0.0), (-1e6, 0.0), 0.1), "none behind");
    }

    /// A step beside a straight wall of what is cleared: 1 − cos(contact) is the engagement.
    #[test]
    fn contact_beside_a_large_disc_is_that_of_its_radial_engagement() {
        let mut cleared = Cleared::new(5e5, [-3e7, -3e7, 3e7, 3e7]);
        cleared.add((0.0, 0.0), 2e7);
        for engaged in [0.05, 0.15, 0.3] {
            let contact = cleared.contact((2e7 + engaged * 1e6, 0.0), (0.0, 1.0));
            let part = (1.0 - libm::cos(contact)) / 2.0;
            assert!((part - engaged).abs() < 0.02, "{engaged}: {part}");
        }
    }
}
