//! Loops in rows, each milled without a retract: from one level of loops over to the next one
//! outwards.
//!
//! ```text
//!   ╭──────────────╮
//!   │  ╭────────╮  │    The first loop of a row, which may begin anywhere, ends where it is nearest to one of the next level.
//!   │  │   ╭─╮  │  │    Each other begins where it is led on to, and after a full turn leads on as soon as the next one is
//!   │  │   ╰●──●──●    near enough: what lies between its beginning and there is milled twice.
//!   │  ╰────────╯  │
//!   ╰──────────────╯
//! ```

use std::ops::ControlFlow;

use crate::geometry::{Nm, Point, Rect, RectIndex};

/// The corners of a closed loop, each once.
pub(super) type Ring = Vec<Point>;

/// Where a loop leads over to one of the next level: how far that is, squared, to which loop, from
/// which corner, and to which corner.
type Lead = (i64, usize, usize, usize);

/// The loops of a level that are in no row yet, by place.
struct Level {
    rings: Vec<Option<Ring>>,
    /// The ring of each corner, and its number in it.
    corners: Vec<(usize, usize)>,
    index: RectIndex,
}

/// The loops of `levels`, the outermost first, in rows that lead from the inside out on ways no
/// longer than `most`.
///
/// Corners must lie so close to each other that it does not matter at which of them a loop is left.
/// A loop has a tail where it goes on after a full turn: its first corner comes twice.
pub(super) fn rows(levels: &[Vec<Ring>], most: Nm) -> Vec<Vec<Ring>> {
    let mut open: Vec<Level> = levels.iter().map(|rings| Level::new(rings)).collect();
    let mut rows = Vec::new();
    for level in (0..open.len()).rev() {
        for number in 0..open[level].rings.len() {
            let Some(first) = open[level].rings[number].take() else { continue };
            let mut row = vec![first];
            for outer in open[..level].iter_mut().rev() {
                let is_first = row.len() == 1;
                let last = row.last_mut().expect("it has a loop");
                let Some(next) = outer.next(last, is_first, most) else { break };
                row.push(next);
            }
            rows.push(row);
        }
    }
    rows
}

impl Level {
    fn new(rings: &[Ring]) -> Self {
        let corners = rings.iter().enumerate();
        let corners = corners.flat_map(|(ring, corners)| (0..corners.len()).map(move |i| (ring, i)));
        let corners: Vec<(usize, usize)> = corners.collect();
        let index =
            RectIndex::new(corners.iter().map(|&(ring, i)| Rect::new(rings[ring][i], rings[ring][i])));
        Self { rings: rings.iter().cloned().map(Some).collect(), corners, index }
    }

    /// Takes the loop that `last` leads to, begun where it is reached; `last` is made to end where
    /// it is left.
    fn next(&mut self, last: &mut Ring, is_first: bool, most: Nm) -> Option<Ring> {
        let mut leads = last.iter().enumerate().filter_map(|(from, &p)| self.lead(from, p, most));
        let (_, ring, from, to) = if is_first { leads.min() } else { leads.next() }?;
        if is_first {
            last.rotate_left(from);
        } else if from > 0 {
            let tail: Vec<Point> = last[..=from].to_vec();
            last.extend(tail);
        }
        let mut next = self.rings[ring].take()?;
        next.rotate_left(to);
        Some(next)
    }

    /// The way from the corner of a loop to the nearest one here.
    fn lead(&self, from: usize, p: Point, most: Nm) -> Option<Lead> {
        let mut best: Option<Lead> = None;
        let _ = self.index.visit(Rect::new(p, p).inflate(most), |number| {
            let (ring, to) = self.corners[number];
            if let Some(corners) = &self.rings[ring] {
                let lead = ((corners[to] - p).length_squared(), ring, from, to);
                if lead.0 <= most.get() * most.get() && best.is_none_or(|best| lead < best) {
                    best = Some(lead);
                }
            }
            ControlFlow::Continue(())
        });
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topology::random;

    /// The same by looking at all pairs.
    fn lead_of_all(last: &[Point], outer: &[Option<Ring>], is_first: bool, most: Nm) -> Option<Lead> {
        let ways = |(from, p): (usize, &Point)| {
            let rings =
                outer.iter().enumerate().filter_map(|(ring, corners)| Some((ring, corners.as_ref()?)));
            let ways = rings.flat_map(|(ring, corners)| {
                corners.iter().enumerate().map(move |(to, q)| ((*q - *p).length_squared(), ring, from, to))
            });
            ways.filter(|way| way.0 <= most.get() * most.get()).min()
        };
        let mut leads = last.iter().enumerate().filter_map(ways);
        if is_first { leads.min() } else { leads.next() }
    }

    #[test]
    fn a_loop_leads_where_looking_at_all_of_the_next_level_says() {
        let mut below = random();
        for _ in 0..200 {
            let mut ring = |count: i64| -> Ring {
                (0..count).map(|_| Point::new(Nm::new(below(3_000)), Nm::new(below(3_000)))).collect()
            };
            let rings: Vec<Ring> = [3, 9, 1, 30].map(&mut ring).into();
            let last = ring(40);
            let most = Nm::new(50 + below(400));
            let mut level = Level::new(&rings);
            for is_first in [true, false] {
                let wanted = lead_of_all(&last, &level.rings, is_first, most);
                let mut left = last.clone();
                let next = level.next(&mut left, is_first, most);
                let begun = wanted.map(|(_, ring, _, to)| rings[ring][to]);
                assert_eq!(next.and_then(|next| next.first().copied()), begun, "is first: {is_first}");
                let Some((.., from, _)) = wanted else { continue };
                let end = if is_first { left[0] } else { left[left.len() - 1] };
                assert!(end == last[from] || (from == 0 && left == last), "it ends where it is left");
            }
        }
    }
}
