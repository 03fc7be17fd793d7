//! Where the ends of stretches lie, and which are near each other.

use std::cmp::Ordering;

use crate::geometry::{Nm, Point};

use super::neighbours::Buckets;
use super::tour::End;

/// How many near stretches an end looks at, and how many of their ends: both ends of a hole lie at
/// one place, those of a trail hardly ever. Measured: with six or eight stretches ten thousand
/// trails take as long and come out no shorter.
const NEAR: usize = 7;
const NEAR_ENDS: usize = 12;

/// A near end, and how far it is.
pub(super) type Near = (End, f64);

/// The ends of all stretches, and home, which lies nowhere: it is left at the start and entered for
/// nothing.
pub(super) struct Ground {
    points: Vec<(f64, f64)>,
    home: End,
    /// `width` near ends of each end, nearest first; where there are fewer, the rest are infinitely
    /// far.
    near: Vec<Near>,
    width: usize,
    /// Of few stretches, home sees more ends than the others do, who leave out their own.
    near_home: Vec<Near>,
}

/// The first end of a stretch.
pub(super) fn end(stretch: usize) -> End {
    u32::try_from(2 * stretch).expect("ends are numbered in 32 bits")
}

impl Ground {
    pub(super) fn new(ends: &[[Point; 2]], start: Point) -> Self {
        let flat = ends.as_flattened();
        let buckets = Buckets::new(flat);
        let width = NEAR_ENDS.min(flat.len().saturating_sub(2));
        let mut near = Vec::with_capacity(flat.len() * width);
        for (index, &point) in (0_u32..).zip(flat) {
            near.extend(near_stretches(&buckets.nearest_few(point, width, |other| other / 2 != index / 2)));
            near.resize((index as usize + 1) * width, (0, f64::INFINITY));
        }
        let near_home = near_stretches(&buckets.nearest_few(start, NEAR_ENDS, |_| true)).collect();
        let mut points: Vec<(f64, f64)> = flat.iter().map(|p| p.to_f64()).collect();
        points.extend([start.to_f64(); 2]);
        let home = end(ends.len());
        Self { points, home, near, width, near_home }
    }

    pub(super) fn distance(&self, a: End, b: End) -> f64 {
        if a == self.home || b == self.home {
            return 0.0;
        }
        let (p, q) = (self.points[a as usize], self.points[b as usize]);
        let (x, y) = (p.0 - q.0, p.1 - q.1);
        (x * x + y * y).sqrt()
    }

    /// The near ends of `end`: home has them where it is left, none where it is entered.
    pub(super) fn near(&self, end: End) -> &[Near] {
        match end.cmp(&self.home) {
            Ordering::Less => &self.near[end as usize * self.width..(end as usize + 1) * self.width],
            Ordering::Equal => &[],
            Ordering::Greater => &self.near_home,
        }
    }
}

/// Of some ends with their squared distances those of the first few stretches.
fn near_stretches(ends: &[(i64, u32)]) -> impl Iterator<Item = Near> {
    let stretches = |count: usize| {
        let mut seen: Vec<u32> = ends[..count].iter().map(|(_, end)| end / 2).collect();
        seen.sort_unstable();
        seen.dedup();
        seen.len()
    };
    let count = (0..=ends.len()).rev().find(|&count| stretches(count) <= NEAR).unwrap_or(0);
    ends[..count].iter().map(|&(squared, end)| (end, Nm::new(squared).to_f64().sqrt()))
}
