//! Which number format a file means that does not say.
//!
//! Drill files of thirty years name their units, their zeros and their digits in any combination,
//! or not at all. Each reading that the file allows is tried, and the one that puts most holes on
//! pads (and next, inside the copper) wins; among equals the formats of the Excellon manual come
//! first.

use std::collections::BTreeSet;

use super::declared::Declared;
use super::format::{Digits, NumberFormat, Units, Zeros};
use super::lex::{Kind, Line, Number, Word};
use crate::board::Hole;
use crate::geometry::{Nm, Point, Rect};

/// What is known of the board's copper, to judge a reading by.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// The middles of flashed pads, in cells of [`NEAR`].
    pads: BTreeSet<(i64, i64)>,
    /// A rectangle that holds all copper, and the board if its edge is known.
    bounds: Option<Rect>,
    /// Whether the board's edge is known, so that it does not go on beyond its copper.
    has_edge: bool,
}

/// The cell that a pad fills: a hole in it or in one beside it counts as its hole, so within 0.1 mm
/// always.
///
/// Chosen: above the 25 µm that rounding both to mils may part them, below the distance of any two
/// pads.
const NEAR: i64 = 100_000;

/// How far off a hole of a board's own frame may lie. Chosen: tooling holes lie in the 5 mm that
/// panels have round them.
pub(in crate::import) const FRAME: Nm = Nm::from_mm(5);

impl Context {
    /// A board with `pads` flashed within `bounds`.
    #[must_use]
    pub fn new(pads: impl IntoIterator<Item = Point>, bounds: Option<Rect>) -> Self {
        Self { pads: pads.into_iter().map(cell).collect(), bounds, has_edge: false }
    }

    /// The same, of a board that ends where its bounds do.
    #[must_use]
    pub fn with_edge(self) -> Self {
        Self { has_edge: true, ..self }
    }

    /// Whether there is nothing to judge by.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bounds.is_none()
    }

    fn on_pad(&self, at: Point) -> bool {
        let (x, y) = cell(at);
        (x - 1..=x + 1).any(|x| (y - 1..=y + 1).any(|y| self.pads.contains(&(x, y))))
    }

    /// How many of `holes` begin on a pad and within the copper.
    pub(super) fn judge(&self, holes: &[Hole]) -> Score {
        let starts = || holes.iter().map(|hole| hole.path.start);
        let within = |bounds: Option<Rect>| {
            starts().filter(|&at| bounds.is_some_and(|bounds| bounds.contains(at))).count()
        };
        Score {
            on_pads: starts().filter(|&at| self.on_pad(at)).count(),
            inside: within(self.bounds),
            beside: if self.lies_among(holes) {
                holes.len()
            } else {
                within(self.bounds.map(|bounds| bounds.inflate(FRAME)))
            },
            holes: holes.len(),
        }
    }

    /// Whether all copper lies between `holes`, of a board that may go on beyond it.
    fn lies_among(&self, holes: &[Hole]) -> bool {
        let around = || Rect::around(holes.iter().map(|hole| hole.path.start));
        let among = |bounds: Rect| around().is_some_and(|around| around.union(bounds) == around);
        !self.has_edge && self.bounds.is_some_and(among)
    }
}

fn cell(at: Point) -> (i64, i64) {
    (at.x.get().div_euclid(NEAR), at.y.get().div_euclid(NEAR))
}

/// How well a reading fits the copper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Score {
    pub(super) on_pads: usize,
    pub(super) inside: usize,
    /// Within what a board may have round its copper, a frame of tooling holes for one.
    pub(super) beside: usize,
    pub(super) holes: usize,
}

impl Score {
    /// The figure to compare: a hole on a pad counts twice, as chance puts many inside but few on
    /// pads.
    pub(super) const fn points(self) -> usize {
        2 * self.on_pads + self.inside
    }

    /// Whether most holes lie off the board.
    pub(super) const fn is_off(self) -> bool {
        2 * self.inside < self.holes
    }

    /// Whether they lie so far off that nothing of the board is there.
    pub(super) const fn is_elsewhere(self) -> bool {
        2 * self.beside < self.holes
    }
}

/// Whether `holes` are so wide, and so narrow, as drills are.
pub(super) fn are_drilled(holes: &[Hole]) -> bool {
    /// Chosen: the finest mechanical drills, and beyond the widest.
    const DRILLS: std::ops::RangeInclusive<Nm> = Nm::from_um(100)..=Nm::from_mm(10);
    holes.iter().all(|hole| DRILLS.contains(&hole.diameter))
}

/// All readings of a file that is not believed in what it declares.
pub(super) fn all(lines: &[Line]) -> Vec<NumberFormat> {
    candidates(&Declared::default(), lines)
}

/// The readings that a file allows, the likeliest first. One alone where it says all, or writes
/// every point.
pub(super) fn candidates(declared: &Declared, lines: &[Line]) -> Vec<NumberFormat> {
    let units =
        declared.units.as_ref().map_or_else(|| likely_units(declared, lines), |(units, _)| vec![*units]);
    let open = has_bare_coordinates(lines);
    let zeros = match declared.zeros {
        Some(zeros) => vec![zeros],
        None if !open => vec![Zeros::Trailing],
        None => vec![Zeros::Trailing, Zeros::Leading],
    };
    let is_left_open = open && declared.digits.is_none();
    let writes_points = places(lines).any(|number| number.decimals.is_some());
    let mut formats = Vec::new();
    for &units in &units {
        // Who writes points leaves them out of whole numbers alone.
        if is_left_open && writes_points {
            formats.push(NumberFormat::whole(units));
        }
        let digits = match declared.digits {
            Some(digits) => vec![digits],
            None if !open => vec![units.default_digits()],
            None => usual_digits(units, width(lines)),
        };
        formats.extend(
            digits
                .iter()
                .flat_map(|&digits| zeros.iter().map(move |&zeros| NumberFormat { units, digits, zeros })),
        );
    }
    if is_left_open && !writes_points {
        formats.extend(units.iter().map(|&units| NumberFormat::whole(units)));
    }
    formats
}

/// Those in use, the commonest first; before them those of as many digits as `width`.
fn usual_digits(units: Units, width: Option<u8>) -> Vec<Digits> {
    let usual: &[(u8, u8)] = match units {
        Units::Inch => &[(2, 4), (3, 3), (2, 3), (1, 4), (2, 5), (2, 6), (3, 5), (4, 4)],
        Units::Mm => {
            &[(3, 3), (4, 2), (3, 2), (2, 3), (4, 3), (3, 4), (2, 4), (4, 4), (5, 3), (3, 5), (3, 6)]
        }
    };
    let mut usual: Vec<Digits> = usual.iter().map(|&(whole, decimals)| Digits { whole, decimals }).collect();
    usual.sort_by_key(|digits| width.is_some_and(|width| digits.whole + digits.decimals != width));
    usual
}

/// How many digits a coordinate has, if zeros are left out at neither end: all have as many, some
/// begin with a zero and some end with one.
fn width(lines: &[Line]) -> Option<u8> {
    let mut numbers = places(lines).filter(|number| number.decimals.is_none());
    let first = numbers.next()?;
    let (mut starts, mut ends) = (first.has_leading_zero(), first.digits % 10 == 0);
    for number in numbers {
        if number.count != first.count {
            return None;
        }
        starts |= number.has_leading_zero();
        ends |= number.digits % 10 == 0;
    }
    (starts && ends).then_some(first.count)
}

/// The units of a table of tools in comments, or else those by the sizes of the tools: no board has
/// all its holes below 0.3 mm, nor one of 7 mm that is an inch wide.
fn likely_units(declared: &Declared, lines: &[Line]) -> Vec<Units> {
    if let Some(tool) = declared.commented.values().next() {
        let other = if tool.units == Units::Inch { Units::Mm } else { Units::Inch };
        return vec![tool.units, other];
    }
    let sizes = || words(lines).filter(|word| word.letter == b'C').filter_map(|word| value(word.number));
    let largest = sizes().fold(0.0_f64, f64::max);
    if largest > 0.0 && largest < 0.28 { vec![Units::Inch, Units::Mm] } else { vec![Units::Mm, Units::Inch] }
}

#[expect(clippy::cast_precision_loss, reason = "a size to be compared with others")]
fn value(number: Number) -> Option<f64> {
    let decimals = number.decimals?;
    Some((0..decimals).fold(number.digits as f64, |value, _| value / 10.0))
}

pub(super) fn has_bare_coordinates(lines: &[Line]) -> bool {
    places(lines).any(|number| number.decimals.is_none())
}

/// The coordinates of all places.
fn places(lines: &[Line]) -> impl Iterator<Item = Number> {
    words(lines).filter(|word| word.is_coordinate()).map(|word| word.number)
}

fn words(lines: &[Line]) -> impl Iterator<Item = &Word> {
    lines.iter().flat_map(|line| match &line.kind {
        Kind::Words(words) => words.as_slice(),
        _ => &[],
    })
}

/// Where some of `holes` are, spread over the file: enough to tell readings apart.
pub(super) fn some_places(holes: &[Hole]) -> Vec<Point> {
    holes.iter().step_by(holes.len() / 256 + 1).map(|hole| hole.path.start).collect()
}

/// Whether two readings come to the same, but for the rounding of a nanometre.
pub(super) fn same_places(a: &[Point], b: &[Point]) -> bool {
    let close = |a: Nm, b: Nm| (a - b).abs() <= Nm::new(1);
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| close(a.x, b.x) && close(a.y, b.y))
}
