//! Scans: turned ones are turned back, the size of a pixel is found by drill dots, and the picture
//! of the back is laid on that of the front.

use std::io::Cursor;
use std::path::PathBuf;

use image::{DynamicImage, GrayImage, ImageFormat, Luma};
use voromill::board::{Copper, Shape};
use voromill::geometry::Nm;
use voromill::import::picture::{Colour, Options, Picture, read};
use voromill::import::{self, Error, Loaded, Selection};

/// A line with round ends, in millimetres: from, to, half its width.
type Stroke = ((f64, f64), (f64, f64), f64);

/// The size of the board, in millimetres.
const SIZE: (f64, f64) = (42.0, 34.0);

/// The pins: two rows of ten, a column of seven and some vias, a tenth of an inch apart where they
/// are not vias.
fn pins() -> Vec<(f64, f64)> {
    const PITCH: f64 = 2.54;
    let step = |number: u32| f64::from(number) * PITCH;
    let rows = [6.0, 6.0 + 3.0 * PITCH].into_iter();
    let rows = rows.flat_map(|y| (0..10).map(move |pin| (6.0 + f64::from(pin) * PITCH, y)));
    let column = (0..7).map(|pin| (36.2, 6.3 + step(pin)));
    rows.chain(column).chain([(9.3, 24.1), (17.77, 26.9), (25.9, 22.3), (31.4, 27.7)]).collect()
}

/// The copper of a side: a pad for each pin, and traces.
fn strokes(is_front: bool) -> Vec<Stroke> {
    let pads = pins().into_iter().map(|pin| (pin, pin, 0.85));
    let front = [
        ((6.0, 9.0), (33.0, 9.0), 0.25),
        ((6.0, 10.0), (28.0, 10.0), 0.2),
        ((4.0, 17.0), (32.0, 17.0), 0.3),
        ((4.0, 17.0), (4.0, 30.0), 0.3),
        ((4.0, 30.0), (38.5, 30.0), 0.25),
        ((38.5, 30.0), (38.5, 4.0), 0.25),
        ((13.0, 19.0), (22.0, 28.0), 0.2),
        ((9.3, 24.1), (9.3, 19.0), 0.2),
        ((33.5, 5.0), (33.5, 25.0), 0.2),
    ];
    let back = [
        ((5.0, 3.0), (36.0, 3.0), 0.3),
        ((28.0, 11.5), (13.0, 11.5), 0.25),
        ((12.0, 19.0), (12.0, 31.0), 0.25),
        ((12.0, 31.0), (34.0, 31.0), 0.25),
        ((21.0, 17.0), (33.0, 29.0), 0.2),
        ((39.0, 6.0), (39.0, 30.0), 0.3),
        ((3.0, 5.0), (3.0, 29.0), 0.3),
    ];
    let traces = if is_front { front.to_vec() } else { back.to_vec() };
    pads.chain(traces).collect()
}

/// How far a place is outside of the copper, in millimetres; negative within it.
fn outside(strokes: &[Stroke], dots: &[(f64, f64)], (x, y): (f64, f64)) -> f64 {
    let from_stroke = |&((ax, ay), (bx, by), radius): &Stroke| {
        let (dx, dy) = (bx - ax, by - ay);
        let along = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy).max(1e-9);
        let along = along.clamp(0.0, 1.0);
        libm::hypot(x - ax - dx * along, y - ay - dy * along) - radius
    };
    let copper = strokes.iter().map(from_stroke).fold(f64::INFINITY, f64::min);
    let dot = dots.iter().map(|&(cx, cy)| libm::hypot(x - cx, y - cy) - 0.4).fold(f64::INFINITY, f64::min);
    copper.max(-dot)
}

/// How a board lies on the scanner.
#[derive(Clone, Copy)]
struct Scan {
    /// Turned counter-clockwise about the middle.
    degrees: f64,
    /// Shifted, in millimetres.
    shift: (f64, f64),
    is_mirrored: bool,
    dpi: f64,
    is_grey: bool,
}

const FLAT: Scan = Scan { degrees: 0.0, shift: (0.0, 0.0), is_mirrored: false, dpi: 400.0, is_grey: false };

impl Scan {
    /// The scan of copper with drill dots, as PNG: dark on light.
    fn of(self, strokes: &[Stroke], dots: &[(f64, f64)]) -> Vec<u8> {
        let pixel = 25.4 / self.dpi;
        let (sin, cos) = libm::sincos(self.degrees.to_radians());
        let middle = (SIZE.0 / 2.0, SIZE.1 / 2.0);
        let pixels = |length: f64| format!("{:.0}", length / pixel).parse::<u32>().expect("a size");
        let (width, height) = (pixels(SIZE.0), pixels(SIZE.1));
        let (right, top) = (f64::from(width) * pixel / 2.0, f64::from(height) * pixel / 2.0);
        let picture = GrayImage::from_fn(width, height, |column, row| {
            let x = (f64::from(column) + 0.5) * pixel - right - self.shift.0;
            let y = top - (f64::from(row) + 0.5) * pixel - self.shift.1;
            let (x, y) = (x * cos + y * sin, y * cos - x * sin);
            let x = if self.is_mirrored { -x } else { x };
            let off = outside(strokes, dots, (middle.0 + x, middle.1 + y)) / pixel;
            let share =
                if self.is_grey { (off + 0.5).clamp(0.0, 1.0) } else { f64::from(u8::from(off > 0.0)) };
            Luma([format!("{:.0}", share * 240.0).parse::<u8>().expect("a byte")])
        });
        let mut bytes = Cursor::new(Vec::new());
        DynamicImage::from(picture).write_to(&mut bytes, ImageFormat::Png).expect("it is encoded");
        bytes.into_inner()
    }

    fn front(self) -> Vec<u8> {
        self.of(&strokes(true), &pins())
    }
}

const OPTIONS: Options = Options {
    dpi: Some(400.0),
    dpi_unless_said: None,
    width: None,
    pitch: None,
    straighten: false,
    colour: Colour::Dark,
    invert: false,
    despeckle: 0.0,
    crop: None,
    most_pixels: None,
};

const STRAIGHTEN: Options = Options { straighten: true, ..OPTIONS };

/// The first warning with a code.
fn said(picture: &Picture, code: &str) -> Option<String> {
    picture.warnings.iter().find(|warning| warning.code() == code).map(|warning| warning.message.clone())
}

/// The number that stands before some words of a message.
fn number_before(message: &str, words: &str) -> f64 {
    let (before, _) = message.split_once(words).expect(words);
    before.rsplit(' ').next().and_then(|word| word.parse().ok()).expect("a number")
}

/// The degrees that a message names, counter-clockwise.
fn degrees(message: &str) -> f64 {
    let number = number_before(message, " degrees");
    if message.contains("degrees counter-clockwise") { number } else { -number }
}

/// How far the corners of copper are from the edges of a board on average and at most, in
/// millimetres.
fn off(copper: &Copper, strokes: &[Stroke], dots: &[(f64, f64)], shift: (f64, f64)) -> (f64, f64) {
    let (mut count, mut sum, mut worst) = (0.0, 0.0, 0.0);
    for feature in &copper.features {
        let Shape::Polygon(polygon) = &feature.shape else { panic!("pictures have polygons") };
        for corner in polygon.contours().iter().flatten() {
            let place = (corner.x.to_mm() - shift.0, corner.y.to_mm() - shift.1);
            // A drill dot is filled: copper may lie in it.
            let in_a_dot = dots.iter().any(|dot| libm::hypot(place.0 - dot.0, place.1 - dot.1) < 0.5);
            if !in_a_dot {
                let off = outside(strokes, &[], place).abs();
                (count, sum, worst) = (count + 1.0, sum + off, f64::max(worst, off));
            }
        }
    }
    assert!(count > 100.0, "a board has corners");
    (sum / count, worst)
}

fn copper_of(picture: &Picture) -> Copper {
    Copper {
        side: voromill::board::Side::Front,
        features: picture.features.clone(),
        attributes: vec![Default::default()],
    }
}

#[test]
fn a_turned_scan_is_turned_back_by_its_edges() {
    for is_grey in [true, false] {
        for turn in [0.4, -1.3, 3.77, -10.0] {
            let bytes = Scan { degrees: turn, is_grey, ..FLAT }.front();
            let picture = read("scan.png", &bytes, &STRAIGHTEN).expect("a board");
            let message = said(&picture, "picture-straightened").expect("it is said");
            let found = degrees(&message);
            assert!((found - turn).abs() < 0.02, "turned by {turn}, {found} found, greys: {is_grey}");
            // The picture's middle stays where it is, within the rounding of its size to pixels.
            let pixel = 25.4 / 400.0;
            let half = |length: f64| (length / pixel).round() * pixel / 2.0 - length / 2.0;
            let shift = (half(SIZE.0), half(SIZE.1));
            let (mean, worst) = off(&copper_of(&picture), &strokes(true), &pins(), shift);
            let (mean, worst) = (mean / pixel, worst / pixel);
            assert!(
                mean < if is_grey { 0.2 } else { 0.35 } && worst < 1.4,
                "edges are {mean} and {worst} pixels off, {turn} degrees, greys: {is_grey}"
            );
            assert_eq!(picture.holes.len(), pins().len(), "holes at {turn} degrees");
            for hole in &picture.holes {
                let place = (hole.path.start.x.to_mm() - shift.0, hole.path.start.y.to_mm() - shift.1);
                let near = pins().into_iter().map(|pin| libm::hypot(place.0 - pin.0, place.1 - pin.1));
                let off = near.fold(f64::INFINITY, f64::min) / pixel;
                assert!(off < 0.5, "a hole is {off} pixels off, {turn} degrees, greys: {is_grey}");
            }
        }
    }
}

#[test]
fn a_scan_that_is_not_to_be_straightened_is_as_it_is_and_warned_of() {
    let flat = read("scan.png", &FLAT.front(), &OPTIONS).expect("a board");
    assert_eq!(said(&flat, "picture-skewed"), None, "nothing is turned");
    let told = read("scan.png", &FLAT.front(), &STRAIGHTEN).expect("a board");
    assert_eq!(told.features, flat.features, "what is straight stays as it is, to the nanometre");
    let turned = Scan { degrees: 2.5, ..FLAT }.front();
    let picture = read("scan.png", &turned, &OPTIONS).expect("a board");
    let message = said(&picture, "picture-skewed").expect("a warning");
    assert!((degrees(&message) - 2.5).abs() < 0.02, "{message}");
    let folder = tempfile::TempDir::new().expect("a temporary folder");
    std::fs::write(folder.path().join("scan.png"), turned).expect("written");
    let run = |more: &[&str]| {
        let arguments = ["inspect", "scan.png", "--copper", "dark", "--picture-dpi", "400"];
        super::cli::stdout(&super::cli::voromill(folder.path(), &[&arguments, more].concat()))
    };
    let text = run(&[]);
    assert!(text.contains("picture-skewed") && text.contains("--straighten"), "the way out: {text}");
    let text = run(&["--straighten"]);
    assert!(!text.contains("picture-skewed") && text.contains("DPI, turned by 2."), "{text}");
}

#[test]
fn a_picture_without_directions_is_not_straightened() {
    let round: Vec<Stroke> = pins().into_iter().map(|pin| (pin, pin, 0.85)).collect();
    let discs = FLAT.of(&round, &pins());
    let error = read("discs.png", &discs, &STRAIGHTEN).expect_err("which way is up?").to_string();
    for word in ["discs.png", "cannot be straightened", "run in the same directions", "--straighten"] {
        assert!(error.contains(word), "{error}");
    }
    let plain = read("discs.png", &discs, &OPTIONS).expect("a board");
    assert_eq!(said(&plain, "picture-skewed"), None, "nor is anything said without being asked");
    let far = Scan { degrees: 19.0, ..FLAT }.front();
    let error = read("far.png", &far, &STRAIGHTEN).expect_err("or a diagonal?").to_string();
    assert!(error.contains("at most 15 degrees"), "{error}");
}

/// The pixels to the inch that a picture is read with.
fn dpi(picture: &Picture) -> f64 {
    let words: Vec<&str> = picture.source.number_format.split(' ').collect();
    let at = words.iter().position(|word| word.starts_with("DPI")).expect("a resolution");
    words[at - 1].parse().expect("a number")
}

#[test]
fn pins_tell_the_resolution() {
    let pitch = Options { dpi: None, pitch: Some(Nm::from_um(2540)), ..OPTIONS };
    for (is_grey, resolution, turn) in [
        (true, 400.0, 0.0),
        (false, 400.0, 0.0),
        (false, 313.3, 2.0),
        (true, 251.7, -6.0),
        (false, 601.3, 0.7),
    ] {
        let bytes = Scan { is_grey, dpi: resolution, degrees: turn, ..FLAT }.front();
        let picture = read("scan.png", &bytes, &pitch).expect("a board");
        let found = dpi(&picture);
        assert!((found / resolution - 1.0).abs() < 0.002, "{found} DPI for {resolution}, {turn} degrees");
        assert!(said(&picture, "picture-pitch").is_some(), "it is said");
    }
}

#[test]
fn too_few_dots_and_dots_without_a_grid_are_told_so() {
    let pitch = Options { dpi: None, pitch: Some(Nm::from_um(2540)), ..OPTIONS };
    let scattered =
        [(5.0, 5.0), (9.1, 7.7), (13.9, 4.2), (20.3, 11.7), (27.7, 8.9), (31.0, 15.3), (8.2, 21.9)];
    let pads: Vec<Stroke> = scattered.into_iter().map(|dot| (dot, dot, 0.85)).collect();
    for (copper, dots, word) in
        [(strokes(true), &pins()[..3], "of 3 dots"), (pads, &scattered[..], "of 7 dots")]
    {
        let bytes = FLAT.of(&copper, dots);
        let error = read("scan.png", &bytes, &pitch).expect_err("no grid").to_string();
        for word in [word, "scan.png", "grid of its drill dots", "--picture-dpi", "--picture-width"] {
            assert!(error.contains(word), "{word}: {error}");
        }
    }
}

#[test]
fn a_file_that_says_half_the_resolution_of_its_pins_is_doubted() {
    let pitch = Options { dpi: None, pitch: Some(Nm::from_um(2540)), ..OPTIONS };
    // 200 DPI in a chunk pHYs behind the header.
    let bytes = FLAT.front();
    let mut chunk = b"pHYs".to_vec();
    chunk.extend([7874_u32.to_be_bytes(), 7874_u32.to_be_bytes()].concat());
    chunk.push(1);
    let sum = super::pictures::crc(&chunk);
    let said_so = [&bytes[..33], &9_u32.to_be_bytes(), &chunk, &sum.to_be_bytes(), &bytes[33..]].concat();
    let picture = read("scan.png", &said_so, &pitch).expect("a board");
    let message = said(&picture, "picture-pitch-disputed").expect("a warning");
    assert!(message.contains("400 DPI") && message.contains("200"), "{message}");
}

/// The board of a front and a back.
fn both(front: &[u8], back: &[u8]) -> Result<Loaded, Error> {
    let folder = tempfile::TempDir::new().expect("a temporary folder");
    let file = |name: &str, bytes: &[u8]| -> PathBuf {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).expect("written");
        path
    };
    let selection = Selection {
        front: Some(file("front.png", front)),
        back: Some(file("back.png", back)),
        picture: OPTIONS,
        ..Selection::default()
    };
    import::load(&[], &selection)
}

fn codes(loaded: &Loaded) -> Vec<&str> {
    loaded.warnings.iter().map(|warning| warning.code()).collect()
}

#[test]
fn the_back_is_laid_on_the_front_by_the_dots_of_both() {
    let pixel = 25.4 / 400.0;
    let half = |length: f64| (length / pixel).round() * pixel / 2.0 - length / 2.0;
    let shift = (half(SIZE.0), half(SIZE.1));
    let front = FLAT.front();
    for (turn, x, y, is_grey) in
        [(0.0, 0.0, 0.0, false), (0.0, 1.3, -0.7, false), (1.7, -1.1, 0.9, true), (-4.0, 0.6, 0.4, false)]
    {
        let scan = Scan { degrees: turn, shift: (x, y), is_grey, ..FLAT };
        let loaded = both(&front, &scan.of(&strokes(false), &pins())).expect("a board");
        let is_moved = codes(&loaded).contains(&"pictures-registered");
        assert_eq!(is_moved, turn != 0.0 || x != 0.0, "{:?}", codes(&loaded));
        assert!(!codes(&loaded).contains(&"pictures-not-registered"), "{:?}", codes(&loaded));
        assert_eq!(loaded.board.holes.len(), pins().len(), "each hole once");
        let back = loaded.board.back.as_ref().expect("a back");
        let (mean, worst) = off(back, &strokes(false), &pins(), shift);
        let (mean, worst) = (mean / pixel, worst / pixel);
        assert!(
            mean < if is_grey { 0.3 } else { 0.5 } && worst < 1.6,
            "{mean} and {worst} pixels off at {turn} degrees, {x}, {y} mm"
        );
        let moved = loaded.warnings.iter().find(|warning| warning.code() == "pictures-registered");
        let Some(message) = moved.map(|warning| &warning.message) else { continue };
        // Where the lower left corner and the turn must be.
        let (sin, cos) = libm::sincos(turn.to_radians());
        let (dx, dy) = (-SIZE.0 / 2.0 - shift.0 - x, -SIZE.1 / 2.0 - shift.1 - y);
        let corner =
            (dx * cos + dy * sin + SIZE.0 / 2.0 + shift.0, dy * cos - dx * sin + SIZE.1 / 2.0 + shift.1);
        let found = (number_before(message, ", "), number_before(message, " mm: "));
        let off = libm::hypot(found.0 - corner.0, found.1 - corner.1) / pixel;
        assert!(off < 0.5, "{message}: {off} pixels from {corner:?}");
        assert!((number_before(message, " degrees") + turn).abs() < 0.05, "{message}");
    }
}

#[test]
fn dots_that_some_scans_lack_do_no_harm() {
    let front = FLAT.of(&strokes(true), &pins()[3..]);
    let scan = Scan { degrees: 0.8, shift: (0.4, 1.2), ..FLAT };
    let mut dots = pins();
    dots.truncate(24);
    dots.extend([(5.0, 20.0), (16.3, 21.1)]);
    let pads = [((5.0, 20.0), (5.0, 20.0), 0.85), ((16.3, 21.1), (16.3, 21.1), 0.85)];
    let back = [strokes(false), pads.to_vec()].concat();
    let loaded = both(&front, &scan.of(&back, &dots)).expect("a board");
    let message = loaded.warnings.iter().find(|warning| warning.code() == "pictures-registered");
    let message = &message.expect("it is moved").message;
    assert!(message.contains("21 meet"), "{message}");
    assert!((number_before(message, " degrees") + 0.8).abs() < 0.02, "{message}");
    let alone = loaded.warnings.iter().find(|warning| warning.code() == "picture-dots-differ");
    let alone = &alone.expect("the back has more").message;
    assert!(alone.starts_with("5 drill dots of the back"), "{alone}");
    assert_eq!(loaded.board.holes.len(), pins().len() + 2, "those of either side");
}

#[test]
fn a_mirrored_back_is_told_so() {
    let scan = Scan { is_mirrored: true, degrees: 0.6, ..FLAT };
    let error = both(&FLAT.front(), &scan.of(&strokes(false), &pins())).expect_err("mirrored").to_string();
    for word in ["back.png", "is mirrored", "mirror the picture"] {
        assert!(error.contains(word), "{error}");
    }
}

#[test]
fn pictures_with_too_few_dots_stay_corner_on_corner_with_a_warning() {
    let back = FLAT.of(&strokes(false), &pins()[..2]);
    let loaded = both(&FLAT.front(), &back).expect("a board");
    assert!(codes(&loaded).contains(&"pictures-not-registered"), "{:?}", codes(&loaded));
    let alone = read("back.png", &back, &OPTIONS).expect("a back");
    assert_eq!(loaded.board.back.expect("a back").features, alone.features, "as it lies");
    // Dots at other places: none of them meet.
    let other: Vec<(f64, f64)> =
        (0..9_u32).map(|at| (5.0 + f64::from(at) * 3.7, 4.0 + f64::from(at * at % 11) * 2.3)).collect();
    let pads: Vec<Stroke> = other.iter().map(|&dot| (dot, dot, 0.85)).collect();
    let loaded = both(&FLAT.front(), &FLAT.of(&pads, &other)).expect("a board");
    assert!(codes(&loaded).contains(&"pictures-not-registered"), "{:?}", codes(&loaded));
}
