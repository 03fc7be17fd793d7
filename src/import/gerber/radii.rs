//! What the radii of a file's arcs say of how their centres are given.
//!
//! An arc's two ends are equally far from its centre. Under G75 the centre is where the offset
//! leads; under G74 it is one of four places, none of which may lie more than a quarter away. So an
//! arc longer than a quarter, or one whose offset has a sign, fits G75 alone, and most arcs of a
//! file that means G74 fit G74 alone. Each arc that fits one of the two alone is a witness.

use std::ops::Range;

use crate::geometry::{Arc, Point, Turn, Vector};

use super::quadrants::Quadrants;

/// How far the two radii of an arc may differ and still be one, in nanometres. Chosen: twice the
/// step of the coarsest usual format, 2.3 inches.
pub(super) const COARSE: f64 = 50_800.0;
/// The same for short arcs, on which a wrong centre is hardly off: asked only where no arc tells by
/// [`COARSE`]. Chosen: what rounding to four decimals of an inch leaves.
const FINE: f64 = 8_000.0;

/// The arcs of a file that are given in one way, and what their radii tell.
#[derive(Clone, Debug, Default)]
pub(super) struct Radii {
    /// How many arcs there are.
    pub(super) count: u32,
    /// The first of them.
    pub(super) first: Range<usize>,
    coarse: Witnesses,
    fine: Witnesses,
    /// The first arc that fits neither way.
    pub(super) unfit: Option<Range<usize>>,
}

/// How many arcs fit one mode alone, and where the first of each stands.
#[derive(Clone, Debug, Default)]
struct Witnesses {
    single: Seen,
    multi: Seen,
}

/// How many there are, and the first.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    pub(super) count: u32,
    pub(super) first: Range<usize>,
}

impl Seen {
    fn add(&mut self, place: &Range<usize>) {
        if self.count == 0 {
            self.first = place.clone();
        }
        self.count += 1;
    }
}

/// What all arcs together say.
pub(super) enum Verdict<'a> {
    /// G74 alone fits: so many arcs do not fit G75.
    Single(u32),
    /// G75 alone fits: so many arcs do not fit G74.
    Multi(u32),
    /// Both fit every arc.
    Either,
    /// Some fit G74 alone, some G75 alone.
    Contradiction { single: &'a Seen, multi: &'a Seen },
}

impl Radii {
    /// Takes an arc of the file into account.
    pub(super) fn add(
        &mut self,
        (from, to): (Point, Point),
        offset: Vector,
        turn: Turn,
        place: &Range<usize>,
    ) {
        if self.count == 0 {
            self.first = place.clone();
        }
        self.count += 1;
        // A circle under G75 is a point under G74: both fit.
        if from == to {
            return;
        }
        let multi = misfit(from, to, from + offset);
        let unsigned = offset.x.get() >= 0 && offset.y.get() >= 0;
        let single = single_quadrant(from, to, offset, turn).filter(|_| unsigned);
        let single = single.map_or(f64::INFINITY, |center| misfit(from, to, center));
        for (witnesses, tolerance) in [(&mut self.coarse, COARSE), (&mut self.fine, FINE)] {
            match (single <= tolerance, multi <= tolerance) {
                (true, false) => witnesses.single.add(place),
                (false, true) => witnesses.multi.add(place),
                _ => {}
            }
        }
        if single.min(multi) > COARSE && self.unfit.is_none() {
            self.unfit = Some(place.clone());
        }
    }

    pub(super) fn verdict(&self) -> Verdict<'_> {
        let Witnesses { single, multi } = &self.coarse;
        let fine = &self.fine;
        match (single.count, multi.count) {
            (0, 0) if fine.single.count > 0 && fine.multi.count == 0 => Verdict::Single(fine.single.count),
            (0, 0) if fine.multi.count > 0 => Verdict::Multi(fine.multi.count),
            (0, 0) => Verdict::Either,
            (count, 0) => Verdict::Single(count),
            (0, count) => Verdict::Multi(count),
            _ => Verdict::Contradiction { single, multi },
        }
    }

    /// The other mode, where all arcs given as `declared` fit it and not all of them fit what is
    /// declared.
    pub(super) fn refutes(&self, declared: Quadrants) -> Option<(Quadrants, u32)> {
        let Witnesses { single, multi } = &self.coarse;
        let (own, other, mode) = match declared {
            Quadrants::Single => (single, multi, Quadrants::Multi),
            Quadrants::Multi => (multi, single, Quadrants::Single),
        };
        (self.unfit.is_none() && own.count == 0 && other.count > 0).then_some((mode, other.count))
    }
}

/// By how much the two radii differ.
fn misfit(from: Point, to: Point, center: Point) -> f64 {
    (center.distance(from) - center.distance(to)).abs()
}

/// The centre of an arc of at most a quarter whose offsets carry no sign: of the four places it may
/// be at, the one that both ends are equally far from (specification §8.1.10, G74); none where each
/// would make it longer.
pub(super) fn single_quadrant(from: Point, to: Point, offset: Vector, turn: Turn) -> Option<Point> {
    /// A quarter, and a little for rounded coordinates. Chosen: 2 %.
    const QUARTER: f64 = std::f64::consts::FRAC_PI_2 * 1.02;
    let signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
    let candidates = signs.map(|(x, y)| from + Vector::new(offset.x * x, offset.y * y));
    let short = |center: &Point| Arc { start: from, end: to, center: *center, turn }.sweep().abs() <= QUARTER;
    candidates.into_iter().filter(short).min_by(|&a, &b| misfit(from, to, a).total_cmp(&misfit(from, to, b)))
}
