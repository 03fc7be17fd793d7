//! Paths as short text: letters name what follows, whole units from where the pen is: micrometres,
//! or hundredths of them.

use std::fmt::Write as _;

use crate::board::Shape;
use crate::geometry::{Arc, Nm, Path, Point, Segment, Turn};

/// In whole micrometres, halves up.
pub(super) const fn um(length: Nm) -> i64 {
    units(length, MICROMETRE)
}

/// In whole units of so many nanometres, halves up.
pub(super) const fn units(length: Nm, unit: i64) -> i64 {
    (length.get() + unit / 2).div_euclid(unit)
}

/// A point in whole micrometres.
pub(super) fn place(p: Point) -> [i64; 2] {
    [um(p.x), um(p.y)]
}

/// The width of the pen that draws a shape; none for an area.
pub(super) const fn pen(shape: &Shape) -> Nm {
    match *shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => {
            Nm::new(radius.get() * 2)
        }
        Shape::Polygon(_) => Nm::ZERO,
    }
}

/// A pen that writes where it goes.
///
/// Points are rounded before they are subtracted, so that errors do not add up and paths that share
/// a point share it in the text too. A letter that repeats is left out, and so is the blank before
/// a minus.
#[derive(Debug)]
pub(super) struct Ink {
    text: String,
    at: [i64; 2],
    letter: char,
    /// In nanometres.
    unit: i64,
}

impl Default for Ink {
    /// In micrometres.
    fn default() -> Self {
        Self::of(MICROMETRE)
    }
}

/// A unit in nanometres: as short as a picture needs.
const MICROMETRE: i64 = 1000;

impl Ink {
    /// A pen that writes in units of so many nanometres.
    pub(super) const fn of(unit: i64) -> Self {
        Self { text: String::new(), at: [0; 2], letter: '\0', unit }
    }

    /// In whole units, halves up.
    const fn units(&self, length: Nm) -> i64 {
        units(length, self.unit)
    }

    fn place(&self, p: Point) -> [i64; 2] {
        [self.units(p.x), self.units(p.y)]
    }

    /// What it wrote.
    pub(super) fn into_text(self) -> String {
        self.text
    }

    /// A letter with its numbers.
    pub(super) fn put(&mut self, letter: char, numbers: &[i64]) {
        if letter != self.letter || numbers.is_empty() {
            self.text.push(letter);
            self.letter = letter;
        }
        for &number in numbers {
            if number >= 0 && self.text.ends_with(|c: char| c.is_ascii_digit()) {
                self.text.push(' ');
            }
            _ = write!(self.text, "{number}");
        }
    }

    /// A letter with the way to `p`, and more numbers behind it; the pen is there then.
    pub(super) fn step(&mut self, letter: char, p: [i64; 2], more: &[i64]) {
        let [dx, dy] = self.to(p);
        self.put(letter, &[&[dx, dy], more].concat());
        self.at = p;
    }

    /// The way from where the pen is.
    pub(super) const fn to(&self, [x, y]: [i64; 2]) -> [i64; 2] {
        [x - self.at[0], y - self.at[1]]
    }

    /// SVG: begins a line at `p`.
    pub(super) fn begin(&mut self, p: Point) {
        // A moveto that follows one would be read as a line.
        self.letter = ' ';
        self.step('m', self.place(p), &[]);
        self.letter = 'l';
    }

    /// SVG: a straight line to `p`.
    pub(super) fn line(&mut self, p: Point) {
        self.step('l', self.place(p), &[]);
    }

    /// SVG: a spot that round ends make a disc of. A line of no length would not be drawn
    /// everywhere.
    pub(super) fn spot(&mut self, p: Point) {
        self.begin(p);
        self.put('h', &[1]);
        self.at[0] += 1;
    }

    /// SVG: a segment that begins at `from`, where the pen is; in a drawing whose y points up.
    pub(super) fn segment(&mut self, from: Point, segment: &Segment) {
        match segment.arc(from) {
            None => self.line(segment.to()),
            Some(arc) => self.arc(&arc),
        }
    }

    /// SVG: an arc, in halves where it is more than one: then its ends and radius tell which it is.
    pub(super) fn arc(&mut self, arc: &Arc) {
        let radius = self.units(Nm::from_f64(arc.radius())).max(1);
        let sweep = i64::from(arc.turn == Turn::CounterClockwise);
        let halves = if arc.sweep().abs() > 3.0 { 2 } else { 1 };
        for end in arc.parts(halves) {
            let place = self.place(end);
            let [dx, dy] = self.to(place);
            self.put('a', &[radius, radius, 0, 0, sweep, dx, dy]);
            self.at = place;
        }
    }

    /// SVG: back to where the line began, which was `start`.
    pub(super) fn close(&mut self, start: Point) {
        self.put('z', &[]);
        self.at = self.place(start);
    }

    /// SVG: a whole path.
    pub(super) fn path(&mut self, path: &Path) {
        self.begin(path.start);
        for (from, segment) in path.steps() {
            self.segment(from, segment);
        }
        if path.is_closed() {
            self.close(path.start);
        }
    }

    /// SVG: the middle line of a stroke, the rings of an area.
    pub(super) fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Disc { center, .. } => self.spot(*center),
            Shape::Stroke { from, to, .. } => {
                self.begin(*from);
                self.line(*to);
            }
            Shape::Arc { arc, .. } => {
                self.begin(arc.start);
                self.arc(arc);
            }
            Shape::Polygon(polygon) => self.rings(polygon.contours()),
        }
    }

    /// SVG: closed rings.
    pub(super) fn rings(&mut self, rings: &[Vec<Point>]) {
        for ring in rings {
            self.begin(ring[0]);
            ring[1..].iter().for_each(|&p| self.line(p));
            self.close(ring[0]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    #[test]
    fn a_path_is_short_and_says_where_it_turns() {
        let path = Path {
            start: at(100, -200),
            segments: vec![
                Segment::Line { to: at(110, -200) },
                Segment::Line { to: at(110, -180) },
                Segment::Arc { to: at(120, -170), center: at(120, -180), turn: Turn::Clockwise },
            ],
        };
        let mut ink = Ink::default();
        ink.path(&path);
        assert_eq!(ink.into_text(), "m100-200 10 0 0 20a10 10 0 0 0 10 10", "relative, letters once");
    }

    #[test]
    fn a_circle_is_two_halves() {
        let mut ink = Ink::default();
        let circle = Arc { start: at(10, 0), end: at(10, 0), center: at(0, 0), turn: Turn::CounterClockwise };
        ink.begin(circle.start);
        ink.arc(&circle);
        assert_eq!(ink.into_text(), "m10 0a10 10 0 0 1-20 0 10 10 0 0 1 20 0", "there and back");
    }

    #[test]
    fn roundings_do_not_add_up() {
        let mut ink = Ink::default();
        ink.begin(Point::default());
        for step in 1..=5 {
            ink.line(Point::new(Nm::new(step * 600), Nm::ZERO));
        }
        assert_eq!(ink.into_text(), "m0 0 1 0 0 0 1 0 0 0 1 0", "five steps of 0.6 µm are 3 µm");
    }
}
