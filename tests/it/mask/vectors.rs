//! Path data of SVG, read by its grammar alone: lines and circular arcs, filled or stroked.

use voromill::board::Shape;
use voromill::geometry::{Nm, Point};

type Place = (f64, f64);

/// The contours of each path of `svg`, a user unit being `unit`: what is stroked as an area of its
/// own for each line.
pub(super) fn ink(svg: &str, unit: Nm) -> Vec<Vec<Vec<Point>>> {
    let mut all = Vec::new();
    for element in svg.split("<path").skip(1) {
        let element = element.split("/>").next().expect("it ends");
        let lines = lines(value(element, "d").expect("path data"));
        let place = |&(x, y): &Place| Point::from_f64(x * unit.to_f64(), y * unit.to_f64());
        let lines: Vec<Vec<Point>> = lines.iter().map(|line| line.iter().map(place).collect()).collect();
        match value(element, "stroke-width") {
            None => all.push(lines),
            Some(width) => {
                let radius = Nm::from_f64(width.parse::<f64>().expect("a number") * unit.to_f64() / 2.0);
                for pair in lines.iter().flat_map(|line| line.windows(2)) {
                    let shape = if pair[0] == pair[1] {
                        Shape::Disc { center: pair[0], radius }
                    } else {
                        Shape::Stroke { from: pair[0], to: pair[1], radius }
                    };
                    all.extend(shape.polygon(Nm::new(20)).map(|polygon| polygon.contours().to_vec()));
                }
            }
        }
    }
    all
}

fn value<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    let from = element.find(&format!(" {name}=\""))? + name.len() + 3;
    element[from..].split('"').next()
}

/// Path data as polylines.
fn lines(data: &str) -> Vec<Vec<Place>> {
    let mut tokens = Tokens { rest: data.as_bytes() };
    let mut lines: Vec<Vec<Place>> = Vec::new();
    let (mut at, mut letter) = ((0.0, 0.0), b' ');
    while let Some(next) = tokens.letter().or_else(|| tokens.has_number().then_some(letter)) {
        // Numbers after a moveto are lines.
        letter = match (next == letter, next) {
            (true, b'm') => b'l',
            (true, b'M') => b'L',
            _ => next,
        };
        let from = if letter.is_ascii_lowercase() { at } else { (0.0, 0.0) };
        match letter.to_ascii_lowercase() {
            b'm' => {
                at = tokens.place(from);
                lines.push(vec![at]);
            }
            b'l' => {
                at = tokens.place(from);
                lines.last_mut().expect("a line").push(at);
            }
            b'h' => {
                at.0 = from.0 + tokens.number();
                lines.last_mut().expect("a line").push(at);
            }
            b'a' => {
                let [rx, ry, _, large, sweep] = [(); 5].map(|()| tokens.number());
                assert!((rx - ry).abs() < 1e-12 && large < 0.5, "a circle, and at most half of it");
                let to = tokens.place(from);
                lines.last_mut().expect("a line").extend(arc(at, to, rx, sweep > 0.5));
                at = to;
            }
            b'z' => {
                let line = lines.last_mut().expect("a line");
                at = line[0];
                line.push(at);
            }
            other => panic!("`{}` is no letter that is written", char::from(other)),
        }
    }
    lines
}

/// Points of an arc of at most half a circle, the last of them `to`.
fn arc(from: Place, to: Place, radius: f64, sweep: bool) -> Vec<Place> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let half = libm::hypot(dx, dy) / 2.0;
    let height = (radius * radius - half * half).max(0.0).sqrt() * if sweep { 1.0 } else { -1.0 };
    // The centre lies to the side of the chord that the sweep asks for, y pointing down.
    let (cx, cy) =
        (from.0 + dx / 2.0 - dy / half / 2.0 * height, from.1 + dy / 2.0 + dx / half / 2.0 * height);
    let start = libm::atan2(from.1 - cy, from.0 - cx);
    let mut turn = libm::atan2(to.1 - cy, to.0 - cx) - start;
    let full = std::f64::consts::TAU;
    match sweep {
        true if turn <= 0.0 => turn += full,
        false if turn >= 0.0 => turn -= full,
        _ => {}
    }
    let radius = libm::hypot(from.0 - cx, from.1 - cy);
    let point = |step: u32| {
        let (sin, cos) = libm::sincos(start + turn * f64::from(step) / 64.0);
        (cx + radius * cos, cy + radius * sin)
    };
    (1..64).map(point).chain([to]).collect()
}

struct Tokens<'a> {
    rest: &'a [u8],
}

impl Tokens<'_> {
    fn skip(&mut self) {
        let blank = |byte: &&u8| byte.is_ascii_whitespace() || **byte == b',';
        self.rest = &self.rest[self.rest.iter().take_while(blank).count()..];
    }

    fn letter(&mut self) -> Option<u8> {
        self.skip();
        let letter = self.rest.first().copied().filter(u8::is_ascii_alphabetic)?;
        self.rest = &self.rest[1..];
        Some(letter)
    }

    fn has_number(&mut self) -> bool {
        self.skip();
        !self.rest.is_empty()
    }

    fn number(&mut self) -> f64 {
        self.skip();
        let sign = usize::from(self.rest.first().is_some_and(|byte| b"+-".contains(byte)));
        let digits = |byte: &&u8| byte.is_ascii_digit() || **byte == b'.';
        let end = sign + self.rest[sign..].iter().take_while(digits).count();
        let text = std::str::from_utf8(&self.rest[..end]).expect("ASCII");
        self.rest = &self.rest[end..];
        text.parse().expect("a number")
    }

    fn place(&mut self, from: Place) -> Place {
        let x = self.number();
        (from.0 + x, from.1 + self.number())
    }
}
