//! Marching squares: closed lines where the interpolated picture passes the level.

use bitvec::vec::BitVec;

use super::{Field, Inside};

/// A closed line, the inside on its left as one looks at the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// Where it passes between neighbouring samples, in pixels; the last is followed by the first.
    pub points: Vec<(f64, f64)>,
}

impl Contour {
    /// How long it is, in pixels.
    #[must_use]
    pub fn length(&self) -> f64 {
        let ends = self.points.iter().zip(self.points.iter().cycle().skip(1));
        ends.map(|(a, b)| libm::hypot(b.0 - a.0, b.1 - a.1)).sum()
    }
}

/// Where a contour passes: between the sample at a column and row, which may be −1, and that to its
/// right or below it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Crossing {
    x: i64,
    y: i64,
    /// Whether the other sample is below.
    down: bool,
}

/// Which way a contour leaves a crossing: across a square of four samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    Up,
    Down,
    Left,
    Right,
}

/// All contours of what is inside, from the top; none where there would be more than `most` points.
#[must_use]
pub fn contours(field: &Field, inside: Inside, most: usize) -> Option<Vec<Contour>> {
    let tracer = Tracer { field, inside };
    let (columns, rows) = (field.width() + 1, field.height() + 1);
    let mut seen: BitVec = BitVec::repeat(false, columns * rows);
    let mut found = Vec::new();
    let mut points = 0;
    // Every contour passes between a sample and the one to its right.
    for y in (0..).take(field.height()) {
        for x in (-1..).take(columns) {
            let first = Crossing { x, y, down: false };
            if !tracer.is_crossed(first) || seen[number(first, columns)] {
                continue;
            }
            let mut contour = Contour { points: Vec::new() };
            let mut at = first;
            loop {
                if !at.down {
                    seen.set(number(at, columns), true);
                }
                contour.points.push(tracer.place(at));
                points += 1;
                if points > most {
                    return None;
                }
                at = tracer.next(at);
                if at == first {
                    break;
                }
            }
            found.push(contour);
        }
    }
    Some(found)
}

fn number(crossing: Crossing, columns: usize) -> usize {
    let index = |at: i64| usize::try_from(at + 1).unwrap_or(0);
    index(crossing.y) * columns + index(crossing.x)
}

struct Tracer<'a> {
    field: &'a Field,
    inside: Inside,
}

impl Tracer<'_> {
    fn depth(&self, x: i64, y: i64) -> i64 {
        self.inside.depth(self.field, x, y)
    }

    fn ends(&self, Crossing { x, y, down }: Crossing) -> (i64, i64) {
        let other = if down { self.depth(x, y + 1) } else { self.depth(x + 1, y) };
        (self.depth(x, y), other)
    }

    fn is_crossed(&self, crossing: Crossing) -> bool {
        let (a, b) = self.ends(crossing);
        (a > 0) != (b > 0)
    }

    #[expect(clippy::cast_precision_loss, reason = "columns, rows and samples are far below 2⁵³")]
    fn place(&self, crossing: Crossing) -> (f64, f64) {
        let (a, b) = self.ends(crossing);
        let part = a as f64 / (a - b) as f64;
        let (x, y) = (crossing.x as f64 + 0.5, crossing.y as f64 + 0.5);
        if crossing.down { (x, y + part) } else { (x + part, y) }
    }

    /// Which way a contour leaves a crossing, the inside on its left.
    fn way(&self, crossing: Crossing) -> Way {
        match (crossing.down, self.depth(crossing.x, crossing.y) > 0) {
            (false, true) => Way::Up,
            (false, false) => Way::Down,
            (true, true) => Way::Right,
            (true, false) => Way::Left,
        }
    }

    /// The crossing on the other side of the square that a contour goes into.
    fn next(&self, from: Crossing) -> Crossing {
        let way = self.way(from);
        // The upper left sample of the square.
        let (x, y) = match way {
            Way::Up => (from.x, from.y - 1),
            Way::Left => (from.x - 1, from.y),
            Way::Down | Way::Right => (from.x, from.y),
        };
        let top = Crossing { x, y, down: false };
        let bottom = Crossing { x, y: y + 1, down: false };
        let left = Crossing { x, y, down: true };
        let right = Crossing { x: x + 1, y, down: true };
        // To the left, ahead and to the right of the contour.
        let [near, ahead, far] = match way {
            Way::Up => [left, top, right],
            Way::Down => [right, bottom, left],
            Way::Left => [bottom, left, top],
            Way::Right => [top, right, bottom],
        };
        match (self.is_crossed(near), self.is_crossed(far)) {
            (false, false) => ahead,
            (true, false) => near,
            (false, true) => far,
            // A saddle: round the inside corner on the left, or past it where the inside goes
            // through.
            (true, true) => {
                if self.joins(x, y) {
                    far
                } else {
                    near
                }
            }
        }
    }

    /// Whether the two inside corners of a saddle hang together: by the bilinear interpolant, the
    /// outside where it cannot tell.
    fn joins(&self, x: i64, y: i64) -> bool {
        let [a, b, c, d] =
            [self.depth(x, y), self.depth(x + 1, y), self.depth(x, y + 1), self.depth(x + 1, y + 1)];
        if a > 0 { a * d > b * c } else { b * c > a * d }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contours of a picture of text, `#` inside.
    fn traced(rows: &[&str]) -> Vec<Contour> {
        let samples = rows.iter().flat_map(|row| row.bytes()).map(|byte| if byte == b'#' { 200 } else { 0 });
        let field = Field::new(rows[0].len(), samples.collect()).expect("a picture");
        contours(&field, Inside::new(100, true, 0), 10_000).expect("few points")
    }

    fn area(contour: &Contour) -> f64 {
        let ends = contour.points.iter().zip(contour.points.iter().cycle().skip(1));
        // y points down.
        -ends.map(|(a, b)| a.0 * b.1 - a.1 * b.0).sum::<f64>() / 2.0
    }

    #[test]
    fn what_is_inside_lies_on_the_left() {
        let found = traced(&["....", ".##.", ".##.", "...."]);
        assert_eq!(found.len(), 1, "one square");
        assert!((area(&found[0]) - 3.5).abs() < 0.1, "four pixels less their corners: {}", area(&found[0]));
    }

    #[test]
    fn a_hole_runs_the_other_way_round() {
        let areas: Vec<f64> = traced(&["###", "#.#", "###"]).iter().map(area).collect();
        assert_eq!(areas.len(), 2, "{areas:?}");
        assert!(areas[0] > 8.0 && areas[1] < 0.0, "{areas:?}");
    }

    #[test]
    fn corners_that_touch_stay_apart() {
        assert_eq!(traced(&["#.", ".#"]).len(), 2, "two squares");
        let samples = vec![200, 90, 90, 200];
        let field = Field::new(2, samples).expect("four samples");
        let found = contours(&field, Inside::new(100, true, 0), 100).expect("few points");
        assert_eq!(found.len(), 1, "unless what lies between is nearly inside");
    }

    #[test]
    fn greys_move_the_line_between_pixels() {
        let field = Field::new(4, vec![0, 0, 50, 200]).expect("a row");
        let found = contours(&field, Inside::new(100, true, 0), 100).expect("few points");
        let left = found[0].points.iter().map(|point| point.0).fold(f64::INFINITY, f64::min);
        assert!((left - (2.5 + 50.5 / 150.0)).abs() < 1e-9, "a third of the way: {left}");
    }
}
