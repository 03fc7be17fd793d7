//! A PDF of one page, found by its table of objects, its content run by the operators it has.

use voromill::board::Shape;
use voromill::geometry::{Nm, Point, Polygon};

/// What a page shows.
pub(super) struct Page {
    /// In points.
    pub(super) size: (f64, f64),
    pub(super) ink: Vec<Polygon>,
}

/// Reads the file as a reader must: from its end, by the places of its objects.
pub(super) fn read(bytes: &[u8]) -> Page {
    let text = std::str::from_utf8(bytes).expect("nothing is compressed");
    assert!(text.starts_with("%PDF-1.") && text.ends_with("%%EOF\n"), "a whole file");
    let table = after(text, "startxref\n");
    let table: usize = table.lines().next().and_then(|line| line.parse().ok()).expect("a place");
    let mut lines = text[table..].lines();
    assert_eq!(lines.next(), Some("xref"), "the table is where the end says");
    let count: usize = lines.next().and_then(|line| line.strip_prefix("0 ")?.parse().ok()).expect("a count");
    for (number, line) in lines.take(count).enumerate().skip(1) {
        let place: usize = line[..10].parse().expect("ten digits");
        assert!(line.ends_with(" 00000 n "), "twenty bytes: {line:?}");
        assert!(text[place..].starts_with(&format!("{number} 0 obj\n")), "object {number} is at {place}");
    }
    let length = after(text, "/Length ").split(' ').next().and_then(|n| n.parse::<usize>().ok());
    let content = after(text, "stream\n").get(..length.expect("a length")).expect("as long as it says");
    assert!(after(text, content).starts_with("endstream"), "the length is right");
    let size = after(text, "/MediaBox [0 0 ").split(']').next().expect("a size");
    let size = size.split_once(' ').expect("two numbers");
    let number = |text: &str| text.parse::<f64>().expect("a number");
    Page { size: (number(size.0), number(size.1)), ink: run(content) }
}

fn after<'a>(text: &'a str, word: &str) -> &'a str {
    &text[text.find(word).unwrap_or_else(|| panic!("there is a {word:?}")) + word.len()..]
}

fn run(content: &str) -> Vec<Polygon> {
    let (mut ink, mut numbers) = (Vec::new(), Vec::<f64>::new());
    let (mut paths, mut unit, mut width) = (Vec::<Vec<Point>>::new(), 0.0, 0.0);
    for token in content.split_ascii_whitespace() {
        if let Ok(number) = token.parse::<f64>() {
            numbers.push(number);
            continue;
        }
        let place = |at: usize| Point::from_f64(numbers[at] * unit, numbers[at + 1] * unit);
        match token {
            "g" | "G" => assert_eq!(numbers, [0.0], "black"),
            "J" | "j" => assert_eq!(numbers, [1.0], "round"),
            "cm" => unit = numbers[0] / 72.0 * 25.4e6,
            "w" => width = numbers[0] * unit,
            "m" => paths.push(vec![place(0)]),
            "l" => paths.last_mut().expect("a path").push(place(0)),
            "c" => {
                let path = paths.last_mut().expect("a path");
                let from = *path.last().expect("a place");
                path.extend(curve([from, place(0), place(2), place(4)]));
            }
            "h" => {}
            "f" => ink.extend(voromill::board::polarity::clean(&std::mem::take(&mut paths))),
            "S" => {
                let radius = Nm::from_f64(width / 2.0);
                for pair in std::mem::take(&mut paths).iter().flat_map(|path| path.windows(2)) {
                    let shape = if pair[0] == pair[1] {
                        Shape::Disc { center: pair[0], radius }
                    } else {
                        Shape::Stroke { from: pair[0], to: pair[1], radius }
                    };
                    ink.extend(shape.polygon(Nm::new(20)));
                }
            }
            other => panic!("`{other}` is no operator that is written"),
        }
        numbers.clear();
    }
    ink
}

/// Points of a Bézier curve, without its first.
fn curve(places: [Point; 4]) -> impl Iterator<Item = Point> {
    let places = places.map(Point::to_f64);
    (1..=32_u32).map(move |step| {
        let t = f64::from(step) / 32.0;
        let weights = [(1.0 - t).powi(3), 3.0 * t * (1.0 - t).powi(2), 3.0 * t * t * (1.0 - t), t.powi(3)];
        let sum = |part: fn(&(f64, f64)) -> f64| {
            places.iter().zip(weights).map(|(place, weight)| part(place) * weight).sum::<f64>()
        };
        Point::from_f64(sum(|place| place.0), sum(|place| place.1))
    })
}
