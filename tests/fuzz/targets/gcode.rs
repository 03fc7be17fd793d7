//! Any text as a program: what it moves, what it does to a board, and how it is levelled to a
//! surface.
#![no_main]

use libfuzzer_sys::fuzz_target;
use voromill::board::{Axis, Board, Copper, Feature, Shape, Side};
use voromill::gcode::level::{HeightMap, Levelling, level};
use voromill::geometry::{Nm, Point, Polygon, Rect};
use voromill::verify::{self, Program, Role, Settings};

fn at(x: i64, y: i64) -> Point {
    Point::new(Nm::from_mm(x), Nm::from_mm(y))
}

/// Two pads beside each other.
fn board() -> Board {
    let pad = |low: Point, high: Point| Feature {
        shape: Shape::Polygon(Polygon::rectangle(Rect::new(low, high))),
        axis: Axis::Region,
        attributes: 0,
        line: 1,
    };
    let features = vec![pad(at(0, 0), at(2, 2)), pad(at(3, 0), at(5, 2))];
    let copper = Copper { side: Side::Front, features, attributes: vec![Default::default()] };
    Board { name: "pads".to_owned(), front: Some(copper), ..Board::default() }
}

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes).into_owned();
    if let Err(error) = voromill::gcode::read(&text) {
        assert!(!error.to_string().is_empty(), "an error has words");
    }
    let surface = [[0.0, 0.0, 0.0], [5e6, 0.0, 1e4], [0.0, 5e6, 2e4], [5e6, 5e6, 0.0]];
    let map = HeightMap::through(&surface).expect("a surface");
    let (tolerance, margin) = (Nm::from_um(5), Nm::from_mm(2));
    if let Err(error) = level(&text, &map, &Levelling { tolerance, margin, safe: None, note: String::new() }) {
        assert!(!error.to_string().is_empty(), "an error has words");
    }
    let cutter = Some("endmill:0.2mm".parse().expect("a tool"));
    let role = Some(Role::Isolation(Side::Front));
    let program = Program { file: "fuzz.nc".to_owned(), text, role, cutter, ..Program::default() };
    let settings = Settings { pixel: Some(Nm::from_um(50)), ..Settings::default() };
    if let Err(error) = verify::verify(&[program], &board(), &[], &settings) {
        assert!(!error.to_string().is_empty(), "an error has words");
    }
});
