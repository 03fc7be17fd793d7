//! Figures that are holes: circles and obrounds, with the cutter that makes them.

use std::f64::consts::PI;

use super::figure::{Drawn, Figure};
use crate::board::{FLATTEN, Hole, Plating};
use crate::geometry::{Nm, Path, Point, Polygon, Segment};

/// How far a contour may leave the circle or obround that it is taken for. Chosen: drawings of
/// circles by four cubic curves are off by a 3700th of the radius, those of thirty chords by two
/// hundredths of a 1 mm radius.
const ROUND: f64 = 20_000.0;

/// The hole that a figure marks: a dot, a circle or a ring as its inner edge would be drilled, an
/// obround as a slot; none where it is neither.
///
/// A circle that is drawn by a line is the hole's edge: the line's width does not count. Where it
/// leaves nothing inside, a dot is drawn.
#[must_use]
pub fn hole(figure: &Figure) -> Option<Hole> {
    let made = |path: Path, diameter: Nm| Hole {
        path,
        diameter,
        plating: Plating::Unknown,
        tool: 0,
        line: figure.line,
    };
    let [path] = figure.paths() else { return None };
    if let Drawn::Line(line) = &figure.drawn
        && !path.is_closed()
    {
        let goes = path.segments.iter().any(|segment| segment.to() != path.start);
        let kept = if goes { path.clone() } else { Path { segments: Vec::new(), ..path.clone() } };
        return (line.width > Nm::ZERO).then(|| made(kept, line.width));
    }
    let dot = |middle: Nm| match &figure.drawn {
        Drawn::Line(line) if line.width >= middle => middle + line.width,
        Drawn::Line(_) | Drawn::Area(_) => middle,
    };
    let ring = ring(path)?;
    if let Some((center, diameter)) = circle(&ring) {
        return Some(made(Path { start: center, segments: Vec::new() }, dot(diameter)));
    }
    let (from, to, diameter) = obround(&ring)?;
    Some(made(Path { start: from, segments: vec![Segment::Line { to }] }, dot(diameter)))
}

/// Those of `paths`, the contours of one area, that are no circle round another one: of a ring the
/// inner edge.
#[must_use]
pub fn innermost(paths: &[Path]) -> Vec<&Path> {
    let of_paths: Vec<Option<(Point, Nm)>> = paths.iter().map(diameter).collect();
    let mut circles: Vec<(Point, Nm)> = of_paths.iter().flatten().copied().collect();
    circles.sort_by_key(|(center, _)| center.x);
    let reach = Nm::from_f64(ROUND);
    let goes_round = |(center, wide): (Point, Nm)| {
        let first = circles.partition_point(|(other, _)| other.x < center.x - reach);
        let mut near = circles[first..].iter().take_while(|(other, _)| other.x <= center.x + reach);
        near.any(|&(other, narrow)| narrow < wide && center.distance(other) <= ROUND)
    };
    let is_inner =
        |(path, circle): (_, &Option<(Point, Nm)>)| (!circle.is_some_and(goes_round)).then_some(path);
    paths.iter().zip(&of_paths).filter_map(is_inner).collect()
}

/// The diameter of the circle that a closed path is, with its middle; none where it is none.
#[must_use]
pub fn diameter(path: &Path) -> Option<(Point, Nm)> {
    circle(&ring(path)?)
}

/// The corners of a closed path.
fn ring(path: &Path) -> Option<Vec<Point>> {
    let mut points = path.flatten(FLATTEN);
    points.dedup();
    if points.first() == points.last() {
        points.pop();
    }
    (points.len() >= 3).then_some(points)
}

/// The circle through the corners of `ring`, unless some leave it or few are there.
fn circle(ring: &[Point]) -> Option<(Point, Nm)> {
    /// The fewest corners of a ring that is a circle. Chosen.
    const FEWEST: usize = 8;
    let (area, center) = middle(ring)?;
    let reach = |&p: &Point| libm::hypot(p.to_f64().0 - center.0, p.to_f64().1 - center.1);
    let radius = ring.iter().map(reach).sum::<f64>() / count(ring);
    let fits = ring.iter().all(|p| (reach(p) - radius).abs() <= ROUND.min(radius * 0.05));
    // Corners on a circle that go round it once, and not to and fro.
    let is_round = area > PI * radius * radius * 0.85;
    (ring.len() >= FEWEST && fits && is_round)
        .then(|| (Point::from_f64(center.0, center.1), Nm::from_f64(radius * 2.0)))
}

/// The ends of the middle and the width of the obround that `ring` is.
fn obround(ring: &[Point]) -> Option<(Point, Point, Nm)> {
    let (area, center) = middle(ring)?;
    let perimeter = Polygon::new(vec![ring.to_vec()])?.perimeter();
    // Of radius r and a middle of length l: 2πr + 2l round it, πr² + 2rl in it.
    let root = perimeter * perimeter - 4.0 * PI * area;
    let radius = (perimeter - root.max(0.0).sqrt()) / (2.0 * PI);
    let half = perimeter / 4.0 - PI * radius / 2.0;
    let (x, y) = axis(ring, center);
    let end = |by: f64| (center.0 + x * by, center.1 + y * by);
    let off = |p: &Point| {
        let (dx, dy) = (p.to_f64().0 - center.0, p.to_f64().1 - center.1);
        let along = (dx * x + dy * y).clamp(-half, half);
        (libm::hypot(dx - along * x, dy - along * y) - radius).abs()
    };
    let fits = radius > 0.0 && half > 0.0 && ring.iter().all(|p| off(p) <= ROUND.min(radius * 0.05));
    let (from, to) = (end(-half), end(half));
    fits.then(|| (Point::from_f64(from.0, from.1), Point::from_f64(to.0, to.1), Nm::from_f64(radius * 2.0)))
}

/// The area inside and its middle.
fn middle(ring: &[Point]) -> Option<(f64, (f64, f64))> {
    let (x0, y0) = ring[0].to_f64();
    let (mut x, mut y, mut twice) = (0.0, 0.0, 0.0);
    for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let (ax, ay) = (a.to_f64().0 - x0, a.to_f64().1 - y0);
        let (bx, by) = (b.to_f64().0 - x0, b.to_f64().1 - y0);
        let cross = ax * by - bx * ay;
        (x, y, twice) = (x + (ax + bx) * cross, y + (ay + by) * cross, twice + cross);
    }
    let center = (x0 + x / (3.0 * twice), y0 + y / (3.0 * twice));
    (twice.abs() > 0.0).then_some((twice.abs() / 2.0, center))
}

/// The direction in which `ring` reaches farthest from its middle.
fn axis(ring: &[Point], center: (f64, f64)) -> (f64, f64) {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let ((ax, ay), (bx, by)) = (a.to_f64(), b.to_f64());
        let length = libm::hypot(bx - ax, by - ay);
        let (dx, dy) = (f64::midpoint(ax, bx) - center.0, f64::midpoint(ay, by) - center.1);
        (xx, xy, yy) = (xx + dx * dx * length, xy + dx * dy * length, yy + dy * dy * length);
    }
    let (sin, cos) = libm::sincos(libm::atan2(2.0 * xy, xx - yy) / 2.0);
    (cos, sin)
}

fn count(ring: &[Point]) -> f64 {
    ring.iter().map(|_| 1.0).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::artwork::{Area, Line};
    use crate::board::polarity::{FillRule, Polarity};
    use crate::geometry::{Arc, Turn};

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    fn figure(drawn: Drawn) -> Figure {
        Figure { drawn, polarity: Polarity::Dark, line: 1 }
    }

    fn area(points: Vec<Point>) -> Figure {
        let contours = Path::polyline(points).into_iter().collect();
        figure(Drawn::Area(Area { contours, rule: FillRule::NonZero }))
    }

    #[test]
    fn a_circle_is_drilled_and_an_obround_milled() {
        let circle = Arc { start: at(2, 0), end: at(2, 0), center: at(-500, 0), turn: Turn::Clockwise };
        let found = hole(&area(circle.flatten(FLATTEN).collect())).expect("a hole");
        assert_eq!((found.path.start, found.is_slot()), (at(-500, 0), false), "in its middle");
        assert!((found.diameter - Nm::from_um(1004)).abs() < Nm::from_um(1), "{}", found.diameter);
        let slot = Path {
            start: at(0, 500),
            segments: vec![
                Segment::Arc { to: at(0, -500), center: at(0, 0), turn: Turn::CounterClockwise },
                Segment::Line { to: at(3000, -500) },
                Segment::Arc { to: at(3000, 500), center: at(3000, 0), turn: Turn::CounterClockwise },
                Segment::Line { to: at(0, 500) },
            ],
        };
        let found =
            hole(&figure(Drawn::Line(Line { path: slot, width: Nm::ZERO, painted: None }))).expect("a slot");
        let ends = [found.path.start, found.path.end()];
        for end in [at(0, 0), at(3000, 0)] {
            let off = ends.iter().map(|p| p.distance(end)).fold(f64::INFINITY, f64::min);
            assert!(off < 2_000.0, "{end:?} is {off} nm off: {ends:?}");
        }
        assert!((found.diameter - Nm::from_um(1000)).abs() < Nm::from_um(2), "{}", found.diameter);
    }

    #[test]
    fn a_line_that_fills_its_circle_draws_a_dot() {
        let round = |width: i64| {
            let path = Path::circle(at(0, 0), Nm::from_um(250), Turn::Clockwise);
            let line = Line { path, width: Nm::from_um(width), painted: None };
            hole(&figure(Drawn::Line(line))).expect("a hole").diameter
        };
        for (width, diameter) in [(0, 500), (400, 500), (500, 1000), (600, 1100)] {
            let off = (round(width) - Nm::from_um(diameter)).abs();
            assert!(off < Nm::from_um(1), "a line of {width} µm: {off} off {diameter} µm");
        }
    }

    #[test]
    fn a_square_and_a_star_are_no_holes() {
        assert_eq!(hole(&area(vec![at(0, 0), at(1000, 0), at(1000, 1000), at(0, 1000)])), None, "a square");
        let star = (0..16_u32).map(|corner| {
            let (sin, cos) = libm::sincos(f64::from(corner) * PI / 8.0);
            let reach = if corner % 2 == 0 { 1e6 } else { 0.8e6 };
            Point::from_f64(cos * reach, sin * reach)
        });
        assert_eq!(hole(&area(star.collect())), None, "a star");
    }
}
