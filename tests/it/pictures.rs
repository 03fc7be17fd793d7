//! Pictures of copper: each format gives the board that was drawn, and what is no artwork is told
//! so.

use std::io::Cursor;
use std::path::Path;
use std::sync::LazyLock;

use image::{DynamicImage, GrayImage, ImageFormat, Luma, Rgb, RgbImage, Rgba, RgbaImage};
use proptest::prelude::*;
use voromill::board::{Board, Copper, FLATTEN, Side};
use voromill::geometry::{Nm, Point, Polygon};
use voromill::import::picture::{Colour, Options, Picture, read};
use voromill::import::{self, Selection};
use voromill::report::mask::{self, Sheet};
use voromill::topology::{self, Method};

use crate::corpus::{self, board_folders};

/// Pads with a drill dot, in millimetres from the lower left: x, y, pad, dot.
const PADS: [(f64, f64, f64, f64); 4] =
    [(3.0, 3.0, 2.0, 0.8), (9.0, 3.0, 2.0, 0.8), (3.0, 8.0, 2.4, 1.0), (9.0, 8.0, 1.8, 0.6)];
/// A pixel of the pictures drawn here: 600 DPI.
const PIXEL: f64 = 25.4 / 600.0;

/// Whether a place is copper: pads, a slanted trace between the lower two, a ring that is no dot.
fn is_copper(x: f64, y: f64) -> bool {
    let away = |(cx, cy): (f64, f64)| libm::hypot(x - cx, y - cy);
    let in_dot = PADS.iter().any(|&(cx, cy, _, dot)| away((cx, cy)) < dot / 2.0);
    let in_pad = PADS.iter().any(|&(cx, cy, pad, _)| away((cx, cy)) < pad / 2.0);
    let in_trace = (3.0..9.0).contains(&x) && (y - 3.0 - (x - 3.0) * 0.02).abs() < 0.2;
    let in_ring = (1.0..1.5).contains(&away((6.0, 6.0)));
    !in_dot && (in_pad || in_trace || in_ring)
}

/// How much of each pixel is copper, of 16 samples: 12 × 11 mm.
fn drawn() -> (u32, u32, Vec<u8>) {
    let (width, height) = (284_u32, 260_u32);
    let share = |at: u32| {
        let (column, row) = (f64::from(at % width), f64::from(height - 1 - at / width));
        let inked = (0..16_u8).filter(|step| {
            let (dx, dy) = (f64::from(step % 4) / 4.0 + 0.125, f64::from(step / 4) / 4.0 + 0.125);
            is_copper((column + dx) * PIXEL, (row + dy) * PIXEL)
        });
        u8::try_from(inked.count()).expect("16 at most")
    };
    (width, height, (0..width * height).map(share).collect())
}

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).expect("it is encoded");
    bytes.into_inner()
}

/// Light copper on dark.
fn grey() -> DynamicImage {
    let (width, height, shares) = drawn();
    GrayImage::from_fn(width, height, |x, y| Luma([shares[(y * width + x) as usize] * 15 + 8])).into()
}

const OPTIONS: Options = Options {
    dpi: None,
    dpi_unless_said: Some(600.0),
    width: None,
    pitch: None,
    straighten: false,
    colour: Colour::Rarer,
    invert: false,
    despeckle: 0.0,
    crop: None,
    most_pixels: None,
};

fn copper_of(picture: &Picture) -> Copper {
    Copper { side: Side::Front, features: picture.features.clone(), attributes: vec![Default::default()] }
}

fn islands(picture: &Picture) -> usize {
    topology::recover(&copper_of(picture), Method::Contact).nets().len()
}

/// Asserts that a picture is the board that was drawn.
fn assert_is_the_board(bytes: &[u8], options: &Options, what: &str) {
    let picture = read("board", bytes, options).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert_eq!(islands(&picture), 4, "{what}: two pads with a trace, two pads, a ring");
    assert_eq!(picture.holes.len(), PADS.len(), "{what}: {:?}", picture.holes);
    for (x, y, _, dot) in PADS {
        let off = |p: Point| libm::hypot(p.x.to_mm() - x, p.y.to_mm() - y);
        let hole = picture.holes.iter().min_by(|a, b| off(a.path.start).total_cmp(&off(b.path.start)));
        let hole = hole.expect("a hole");
        assert!(off(hole.path.start) < PIXEL / 2.0, "{what}: {x}, {y} is at {:?}", hole.path.start);
        assert!((hole.diameter.to_mm() - dot).abs() < PIXEL / 2.0, "{what}: {dot} is {:?}", hole.diameter);
    }
}

#[test]
fn every_format_gives_the_board_that_was_drawn() {
    for format in [
        ImageFormat::Png,
        ImageFormat::Bmp,
        ImageFormat::Jpeg,
        ImageFormat::Tiff,
        ImageFormat::Gif,
        ImageFormat::WebP,
        ImageFormat::Pnm,
    ] {
        let picture = match format {
            ImageFormat::Gif => grey().to_rgba8().into(),
            ImageFormat::WebP => grey().to_rgb8().into(),
            _ => grey(),
        };
        assert_is_the_board(&encoded(&picture, format), &OPTIONS, &format!("{format:?}"));
    }
}

#[test]
fn colours_greys_and_clear_pixels_tell_copper_alike() {
    let (width, height, shares) = drawn();
    let share = |x: u32, y: u32| shares[(y * width + x) as usize];
    let two = |x: u32, y: u32| share(x, y) > 7;
    // Green mask and copper are about as bright as each other.
    let mask =
        RgbImage::from_fn(width, height, |x, y| Rgb(if two(x, y) { [190, 110, 60] } else { [20, 140, 60] }));
    let clear = |ink: u8| {
        RgbaImage::from_fn(width, height, |x, y| Rgba([ink, ink, ink, if two(x, y) { 255 } else { 0 }]))
    };
    let sixteen = DynamicImage::from(grey().to_luma16());
    for (picture, what) in [
        (mask.into(), "green mask"),
        (clear(0).into(), "black on nothing"),
        (clear(255).into(), "white on nothing"),
        (sixteen, "sixteen bits"),
        (grey().to_luma_alpha8().into(), "grey with alpha"),
    ] {
        assert_is_the_board(&encoded(&picture, ImageFormat::Png), &OPTIONS, what);
    }
    let mut inverted = grey();
    inverted.invert();
    let inverted = encoded(&inverted, ImageFormat::Png);
    assert_is_the_board(&inverted, &OPTIONS, "dark on light");
    assert_is_the_board(&inverted, &Options { colour: Colour::Dark, ..OPTIONS }, "dark as told");
    assert_is_the_board(&inverted, &Options { colour: Colour::Light, invert: true, ..OPTIONS }, "not light");
}

/// As a picture program leaves it at the corners of a scan that it turned.
#[test]
fn what_is_clear_beside_two_colours_is_bare_board() {
    let (width, height, shares) = drawn();
    for (ink, ground) in [(0, 255), (255, 0), (180, 250)] {
        let colour = |x: u32, y: u32| {
            let is_clear = x + y < 14 || (width - x) + y < 14;
            let value = if shares[(y * width + x) as usize] > 7 { ink } else { ground };
            Rgba(if is_clear { [0; 4] } else { [value, value, value, 255] })
        };
        let bytes = encoded(&RgbaImage::from_fn(width, height, colour).into(), ImageFormat::Png);
        let what = format!("{ink} on {ground}");
        assert_is_the_board(&bytes, &OPTIONS, &what);
        let told = if ink < ground { Colour::Dark } else { Colour::Light };
        assert_is_the_board(&bytes, &Options { colour: told, ..OPTIONS }, &what);
    }
}

#[test]
fn squares_that_touch_at_corners_stay_apart() {
    let is_ink = |x: u32, y: u32| {
        (0..4).any(|n| (5 + 10 * n..15 + 10 * n).contains(&x.max(y)) && x.min(y) >= 5 + 10 * n)
    };
    let ink = |x, y| Luma([if is_ink(x, y) { 0 } else { 255 }]);
    let bytes = encoded(&GrayImage::from_fn(90, 90, ink).into(), ImageFormat::Png);
    assert_eq!(islands(&read("corners", &bytes, &OPTIONS).expect("squares")), 4, "as they are traced");
}

#[test]
fn lines_of_single_pixels_and_further_pages_are_told() {
    let codes = |bytes: &[u8]| -> Vec<&str> {
        read("board", bytes, &OPTIONS)
            .expect("a board")
            .warnings
            .iter()
            .map(|warning| warning.code())
            .collect()
    };
    let line = |x: u32, y: u32| (!(10..=80).contains(&x) || y == 10 + x / 7) && (5..30).contains(&y);
    let ink = |x, y| Luma([if line(x, y) { 0 } else { 255 }]);
    let thin = encoded(&GrayImage::from_fn(90, 90, ink).into(), ImageFormat::Png);
    assert!(codes(&thin).contains(&"picture-specks"), "its pieces touch at corners alone");
    let mut tiff = encoded(&grey(), ImageFormat::Tiff);
    assert!(!codes(&tiff).contains(&"picture-pages"), "one page");
    // Another directory like the first, behind it.
    let at = u32::from_le_bytes(tiff[4..8].try_into().expect("four bytes")) as usize;
    let entries = 2 + 12 * usize::from(u16::from_le_bytes([tiff[at], tiff[at + 1]]));
    let (copy, end) = (tiff[at..at + entries].to_vec(), u32::try_from(tiff.len()).expect("small"));
    tiff[at + entries..at + entries + 4].copy_from_slice(&end.to_le_bytes());
    tiff.extend(copy.into_iter().chain([0; 4]));
    assert!(codes(&tiff).contains(&"picture-pages"), "two of them");
}

#[test]
fn what_stands_behind_the_end_of_a_jpeg_is_none_of_it() {
    let mut bytes = encoded(&grey(), ImageFormat::Jpeg);
    bytes.extend(b"a film \xff\xda of a telephone \xff\x00");
    assert_is_the_board(&bytes, &OPTIONS, "with a film behind it");
}

#[test]
fn a_guess_of_the_colour_is_said_and_a_told_one_is_not() {
    let bytes = encoded(&grey(), ImageFormat::Png);
    let codes = |options: &Options| -> Vec<&str> {
        read("board", &bytes, options)
            .expect("a board")
            .warnings
            .iter()
            .map(|warning| warning.code())
            .collect()
    };
    assert_eq!(codes(&OPTIONS), ["picture-colour-guessed"], "the rarer one");
    assert!(codes(&Options { colour: Colour::Light, ..OPTIONS }).is_empty(), "told");
}

#[test]
fn a_picture_is_as_large_as_it_is_told_or_says() {
    let bytes = encoded(&grey(), ImageFormat::Png);
    let right = |options: &Options| {
        let picture = read("board", &bytes, options).expect("a board");
        copper_of(&picture).bounds().expect("copper").max().x.to_mm()
    };
    let at_600 = right(&OPTIONS);
    assert!((at_600 - 10.0).abs() < 0.02, "a pad ends at 10 mm: {at_600}");
    let halved = right(&Options { dpi: Some(1200.0), ..OPTIONS });
    assert!((halved * 2.0 - at_600).abs() < 1e-5, "told: {halved}");
    let width = Nm::from_f64(284.0 * PIXEL * 1e6 * 2.0);
    let doubled = right(&Options { dpi_unless_said: None, width: Some(width), ..OPTIONS });
    assert!((doubled / 2.0 - at_600).abs() < 1e-5, "by its width: {doubled}");
    let part =
        Options { dpi_unless_said: None, width: Some(width), crop: Some([142, 0, 142, 130]), ..OPTIONS };
    let dot = read("board", &bytes, &part).expect("a quarter").holes[0].diameter.to_mm();
    assert!((dot - 1.2).abs() < PIXEL, "the width is that of the whole: {dot}");
    let open = read("board", &bytes, &Options { dpi_unless_said: None, ..OPTIONS }).expect_err("no DPI");
    for word in ["has no resolution (DPI)", "--dpi 600", "--picture-width"] {
        assert!(open.to_string().contains(word), "{open}");
    }
}

#[test]
fn an_oblong_opening_of_a_few_pixels_is_no_dot() {
    // Of a letter, at 150 DPI.
    let is_bare = |x: u32, y: u32| (18..22).contains(&x) && (17..24).contains(&y);
    let is_pad = |x: u32, y: u32| (10..30).contains(&x) && (10..30).contains(&y);
    let ink = |x, y| Luma([if is_pad(x, y) && !is_bare(x, y) { 255 } else { 0 }]);
    let bytes = encoded(&GrayImage::from_fn(60, 60, ink).into(), ImageFormat::Png);
    let picture = read("board", &bytes, &Options { dpi: Some(150.0), ..OPTIONS }).expect("a pad");
    assert!(picture.holes.is_empty(), "{:?}", picture.holes);
}

#[test]
fn specks_go_and_parts_are_read_where_asked_for() {
    let mut picture = grey().to_luma8();
    for at in 0..40 {
        picture.put_pixel(5 + at * 6, 130 + at % 3, Luma([255]));
        picture.put_pixel(70 + at % 5, 185 - at % 7, Luma([0]));
    }
    let bytes = encoded(&picture.into(), ImageFormat::Png);
    let specked = read("board", &bytes, &OPTIONS).expect("a board");
    assert!(islands(&specked) > 20, "specks are islands");
    assert!(specked.warnings.iter().any(|warning| warning.code() == "picture-specks"), "and warned of");
    let clean = read("board", &bytes, &Options { despeckle: 0.05, ..OPTIONS }).expect("a board");
    assert_eq!(islands(&clean), 4, "none is left");
    let part = Options { crop: Some([142, 0, 142, 130]), despeckle: 0.05, ..OPTIONS };
    let quarter = read("board", &bytes, &part).expect("a quarter");
    assert_eq!(quarter.holes.len(), 1, "the pad at the upper right");
    let error = read("board", &bytes, &Options { crop: Some([142, 0, 143, 130]), ..OPTIONS });
    assert!(error.expect_err("beyond the edge").to_string().contains("284 × 260"), "the true size");
}

#[test]
fn what_is_no_artwork_is_refused_with_its_reason() {
    let photo = RgbImage::from_fn(200, 200, |x, y| {
        let byte = |value: u32| u8::try_from(value % 256).expect("below 256");
        Rgb([byte(x), byte(y / 2 + x / 3), byte(200 - y / 2)])
    });
    let blank = GrayImage::from_pixel(50, 50, Luma([255]));
    let whole = encoded(&grey(), ImageFormat::Png);
    let mut huge = whole.clone();
    huge[16..24].copy_from_slice(&[0, 0, 0xEA, 0x60, 0, 0, 0xEA, 0x60]);
    let mut cut = encoded(&grey(), ImageFormat::Jpeg);
    cut.truncate(cut.len() * 9 / 10);
    let sum = crc(&huge[12..29]);
    huge[29..33].copy_from_slice(&sum.to_be_bytes());
    for (bytes, word) in [
        (encoded(&photo.into(), ImageFormat::Png), "does not have two clear colours"),
        (encoded(&blank.into(), ImageFormat::Png), "one colour"),
        (whole[..whole.len() / 2].to_vec(), "cannot be read"),
        (cut, "the JPEG is truncated"),
        (huge, "60000 × 60000 pixels are too many"),
        (b"no picture".to_vec(), "not a picture"),
        (Vec::new(), "an empty file"),
    ] {
        let error = read("board.png", &bytes, &OPTIONS).expect_err(word).to_string();
        assert!(error.contains(word) && error.starts_with("board.png"), "{error}");
    }
}

/// The sum of a chunk of a PNG (ISO 3309).
pub(crate) fn crc(bytes: &[u8]) -> u32 {
    let step = |sum: u32, _| if sum & 1 == 1 { 0xEDB8_8320 ^ (sum >> 1) } else { sum >> 1 };
    !bytes.iter().fold(u32::MAX, |sum, &byte| (0..8).fold(sum ^ u32::from(byte), step))
}

#[test]
fn a_mask_read_back_is_the_board() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    let board: Board = import::load(&[path], &Selection::default()).expect("a board").board;
    let copper = board.back.as_ref().expect("copper");
    let nets = topology::recover(copper, Method::Contact);
    let sheet = Sheet::copper(&board, copper, &nets, copper.bounds().expect("copper"));
    let bytes = mask::bitmap(sheet, 1200).expect("a picture");
    let picture =
        read("mask.png", &bytes, &Options { dpi_unless_said: None, colour: Colour::Dark, ..OPTIONS });
    let picture = picture.expect("it says how large its pixels are");
    assert_eq!(islands(&picture), nets.nets().len(), "the same islands");
    let area = |copper: &Copper| -> f64 {
        let shapes: Vec<Polygon> =
            copper.features.iter().filter_map(|feature| feature.shape.polygon(FLATTEN)).collect();
        voromill::board::polarity::union(&shapes).iter().map(Polygon::area_mm2).sum()
    };
    let (found, expected) = (area(&copper_of(&picture)), area(copper));
    assert!((found / expected - 1.0).abs() < 0.005, "{found} instead of {expected} mm²");
}

#[test]
fn a_picture_is_a_board_of_its_own() {
    let folder = tempfile::TempDir::new().expect("a temporary folder");
    let path = folder.path().join("scan.png");
    std::fs::write(&path, encoded(&grey(), ImageFormat::Png)).expect("written");
    let run = |arguments: &[&str]| super::cli::voromill(folder.path(), arguments);
    let done = run(&["mill", "scan.png", "--dpi", "600", "-o", "out", "--no-html"]);
    assert!(done.status.success(), "{}", super::cli::stderr(&done));
    let names = super::cli::listing(&folder.path().join("out"));
    assert!(names.contains(&"scan-front.ngc".to_owned()), "{names:?}");
    assert!(names.iter().any(|name| name.starts_with("scan-drill-0.8mm")), "dots are drilled: {names:?}");
    let with_drill = run(&["inspect", "scan.png", "--drill", "scan.drl", "--picture-dpi", "600"]);
    assert_eq!(with_drill.status.code(), Some(2), "their alignment is unknown");
}

/// A pad with its dot.
static SMALL: LazyLock<DynamicImage> = LazyLock::new(|| grey().crop_imm(40, 160, 60, 60));

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn any_bytes_are_read_or_refused(
        start in prop::sample::select(vec![
            &b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x10\0\0\0\x10\x08\0\0\0\0"[..],
            b"BM", b"GIF89a", b"II*\0\x08\0\0\0", b"MM\0*", b"RIFF\0\0\0\0WEBP", b"P5 4 4 255\n", b"P1\n3 3\n",
            b"\xff\xd8\xff\xe0\0\x10JFIF\0", b"",
        ]),
        rest in prop::collection::vec(any::<u8>(), 0..300),
    ) {
        let options = Options { most_pixels: Some(1 << 16), ..OPTIONS };
        if let Err(error) = read("any", &[start, &rest].concat(), &options) {
            prop_assert!(!error.render().is_empty());
        }
    }

    #[test]
    fn damaged_pictures_are_read_or_refused(
        format in prop::sample::select(vec![
            ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Jpeg, ImageFormat::Tiff, ImageFormat::Pnm,
        ]),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let mut bytes = encoded(&SMALL, format);
        for (index, value) in damage {
            let at = index.index(bytes.len());
            bytes[at] = value;
        }
        let options = Options { most_pixels: Some(1 << 16), ..OPTIONS };
        if let Err(error) = read("any", &bytes, &options) {
            prop_assert!(!error.render().is_empty());
        }
    }
}

#[test]
fn one_board_in_many_encodings_is_one_board() {
    let Some(folder) = corpus::artwork() else { return };
    let entries = std::fs::read_dir(folder.join("pictures/odd")).expect("pictures");
    let mut seen = 0;
    for path in entries.map(|entry| entry.expect("an entry").path()) {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if !name.starts_with("base") || name.contains("part") {
            continue;
        }
        seen += 1;
        let picture = read(&name, &std::fs::read(&path).expect("readable"), &OPTIONS).expect(&name);
        assert_eq!(islands(&picture), 4, "{name}");
        let mut places: Vec<(i64, i64)> = picture.holes.iter().map(|hole| place(hole.path.start)).collect();
        places.sort_unstable();
        assert_eq!(places, [(4, 3), (4, 9), (16, 3), (16, 9)], "{name}");
        for hole in &picture.holes {
            assert!((hole.diameter.to_mm() - 0.8).abs() < 0.011, "{name}: {:?}", hole.diameter);
        }
    }
    assert!(seen >= 15, "{seen} encodings");
}

/// In whole millimetres.
fn place(p: Point) -> (i64, i64) {
    (Nm::from_f64(p.x.to_mm()).get(), Nm::from_f64(p.y.to_mm()).get())
}

/// Every picture of a layer of the test boards; unoptimised, the small ones.
#[test]
fn pictures_of_layers_have_the_islands_of_their_boards() {
    let boards = board_folders();
    if boards.is_empty() {
        return;
    }
    let json = |path: &Path| -> Option<serde_json::Value> {
        serde_json::from_slice(&std::fs::read(path).ok()?).ok()
    };
    let (mut seen, mut right) = (0, 0);
    for board in boards {
        let Some(truth) = json(&board.join("truth_nets.json")) else { continue };
        for side in ["front", "back"] {
            let path = board.join(format!("ref/{side}_500.png"));
            let Ok(bytes) = std::fs::read(&path) else { continue };
            if cfg!(debug_assertions) && bytes.len() > 12_000 {
                continue;
            }
            let options = Options { dpi: Some(500.0), colour: Colour::Light, ..OPTIONS };
            let picture = read("layer", &bytes, &options).expect("a picture of copper");
            seen += 1;
            right += usize::from(truth[side]["islands_shapely"].as_u64() == Some(islands(&picture) as u64));
        }
    }
    assert!(seen >= 5 && right + seen / 46 >= seen, "{right} of {seen}");
}

/// The window of a reference picture: its lower left corner in millimetres.
fn corner(window: &serde_json::Value) -> (f64, f64) {
    let at = |number: usize| window["origin_mm"][number].as_f64().expect("a number");
    (at(0), at(1))
}

/// Pixels of a test board's picture are 500 to the inch.
const REFERENCE: f64 = 25.4 / 500.0;

/// A round hole of a board's drill files: x and y in millimetres from the lower left corner of the
/// picture, diameter.
type Drilled = (f64, f64, f64);

/// All round holes of a board's drill files, each once.
fn drilled(truth: &serde_json::Value, corner: (f64, f64)) -> Vec<Drilled> {
    let list = |value: &serde_json::Value| value.as_array().cloned().unwrap_or_default();
    let mut holes: Vec<Drilled> = Vec::new();
    for tool in list(truth).iter().flat_map(|file| list(&file["tools"])) {
        let Some(diameter) = tool["diameter_mm"].as_f64() else { continue };
        for at in list(&tool["xy_mm"]) {
            let (Some(x), Some(y)) = (at[0].as_f64(), at[1].as_f64()) else { continue };
            holes.push((x - corner.0, y - corner.1, diameter));
        }
    }
    holes.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    holes.dedup_by(|a, b| libm::hypot(a.0 - b.0, a.1 - b.1) < 0.001);
    holes
}

/// The pixels of a picture with their distance from `(x, y)` in millimetres, up to `reach`.
fn round((width, height): (u32, u32), (x, y): (f64, f64), reach: f64) -> Vec<(u32, u32, f64)> {
    let mut found = Vec::new();
    for row in 0..height {
        let dy = (f64::from(height - 1 - row) + 0.5) * REFERENCE - y;
        if dy.abs() > reach {
            continue;
        }
        for column in 0..width {
            let dx = (f64::from(column) + 0.5) * REFERENCE - x;
            let away = libm::hypot(dx, dy);
            if away <= reach {
                found.push((column, row, away));
            }
        }
    }
    found
}

/// The holes of which a picture shows a dot once they are bare: of 0.25 to 1.6 mm, with two pixels
/// of copper all round, and no other hole in these.
fn visible(layer: &GrayImage, holes: &[Drilled]) -> Vec<Drilled> {
    let is_free = |&(x, y, diameter): &Drilled| {
        let reach = diameter / 2.0 + 2.0 * REFERENCE;
        let alone = holes.iter().all(|&(u, v, other)| {
            let away = libm::hypot(x - u, y - v);
            away == 0.0 || away > reach + other / 2.0
        });
        let pixels = round(layer.dimensions(), (x, y), reach);
        let all =
            |pixels: &[(u32, u32, f64)]| pixels.iter().all(|&(c, r, _)| layer.get_pixel(c, r).0[0] > 127);
        alone && (0.25..=1.6).contains(&diameter) && !pixels.is_empty() && all(&pixels)
    };
    holes.iter().copied().filter(is_free).collect()
}

/// What drill dots were found of those that a picture shows.
#[derive(Debug, Default)]
struct Found {
    pictures: usize,
    /// Dots that are to be seen, and how many of them were found.
    shown: usize,
    right: usize,
    /// Dots found where no hole is; and where none was drawn yet.
    wrong: usize,
    before: usize,
    /// How far found ones are off: their middles in pixels, their diameters in millimetres.
    places: Vec<f64>,
    sizes: Vec<f64>,
}

impl Found {
    /// Counts the dots of a layer before its holes are drawn into it, and after.
    fn add(&mut self, mut layer: GrayImage, holes: &[Drilled]) {
        let options = Options { dpi: Some(500.0), colour: Colour::Light, ..OPTIONS };
        let dots = |layer: &GrayImage| {
            let bytes = encoded(&layer.clone().into(), ImageFormat::Png);
            read("layer", &bytes, &options).expect("a picture of copper").holes
        };
        let shown = visible(&layer, holes);
        self.before += dots(&layer).len();
        for &(x, y, diameter) in holes {
            for (column, row, _) in round(layer.dimensions(), (x, y), diameter / 2.0) {
                layer.put_pixel(column, row, Luma([0]));
            }
        }
        let found = dots(&layer);
        let away = |&(x, y, _): &Drilled, dot: &voromill::board::Hole| {
            libm::hypot(dot.path.start.x.to_mm() - x, dot.path.start.y.to_mm() - y)
        };
        let is_hole = |dot| holes.iter().any(|hole| away(hole, dot) < REFERENCE);
        self.wrong += found.iter().filter(|dot| !is_hole(dot)).count();
        self.pictures += 1;
        self.shown += shown.len();
        for hole in &shown {
            if let Some(dot) = found.iter().find(|dot| away(hole, dot) < REFERENCE) {
                self.right += 1;
                self.places.push(away(hole, dot) / REFERENCE);
                self.sizes.push((dot.diameter.to_mm() - hole.2).abs());
            }
        }
    }
}

/// The value that 95 of a hundred do not exceed.
fn most(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() * 95 / 100).copied().unwrap_or_default()
}

/// The pictures show no holes, as copper layers do not: the test draws those of the drill files.
/// Unoptimised, into the small ones.
#[test]
fn drill_dots_of_layers_are_their_holes() {
    let boards = board_folders();
    if boards.is_empty() {
        return;
    }
    let json = |path: &Path| -> Option<serde_json::Value> {
        serde_json::from_slice(&std::fs::read(path).ok()?).ok()
    };
    let mut found = Found::default();
    for board in boards {
        let Some(truth) = json(&board.join("truth_drill.json")) else { continue };
        for side in ["front", "back"] {
            let Some(window) = json(&board.join(format!("ref/{side}_500.json"))) else { continue };
            let bytes = std::fs::read(board.join(format!("ref/{side}_500.png"))).expect("a picture");
            if !cfg!(debug_assertions) || bytes.len() < 12_000 {
                let layer = image::load_from_memory(&bytes).expect("a picture").to_luma8();
                found.add(layer, &drilled(&truth, corner(&window)));
            }
        }
    }
    let Found { pictures, shown, right, wrong, before, .. } = found;
    let (place, size) = (most(&mut found.places), most(&mut found.sizes));
    eprintln!(
        "{pictures} pictures: of {shown} dots {right} found, {wrong} wrong ones, {before} before any was drawn; \
         95 % within {place:.3} pixel and {size:.3} mm"
    );
    assert!(pictures >= 5 && shown > 0, "{pictures} pictures with {shown} dots");
    assert!(right * 100 >= shown * 98, "{right} of {shown} are found");
    assert!(wrong * 100 <= right * 2, "{wrong} wrong ones beside {right}");
    assert!(before <= 20, "{before} dots where no hole is drawn");
    assert!(place < 0.25 && size < REFERENCE / 2.0, "95 % within {place} pixel and {size} mm");
}

#[test]
fn edges_in_greys_are_known_to_a_quarter_of_a_pixel() {
    let bytes = encoded(&grey(), ImageFormat::Png);
    let picture = read("board", &bytes, &OPTIONS).expect("a board");
    let circles = PADS.iter().map(|&(x, y, pad, _)| (x, y, pad / 2.0));
    let circles: Vec<(f64, f64, f64)> = circles.chain([(6.0, 6.0, 1.0), (6.0, 6.0, 1.5)]).collect();
    let off = |x: f64, y: f64| {
        let trace = ((y - 3.0 - (x - 3.0) * 0.02).abs() - 0.2).abs();
        circles
            .iter()
            .fold(trace, |least, &(u, v, radius)| least.min((libm::hypot(x - u, y - v) - radius).abs()))
    };
    let mut offs = Vec::new();
    for polygon in picture.features.iter().filter_map(|feature| feature.shape.polygon(FLATTEN)) {
        for (a, b) in polygon.edges() {
            let steps = (a.distance(b) / 1e4).ceil();
            let mut step = 0.0;
            while step < steps {
                let mix = |p: Nm, q: Nm| p.to_mm() + (q.to_mm() - p.to_mm()) * step / steps;
                offs.push(off(mix(a.x, b.x), mix(a.y, b.y)) / PIXEL);
                step += 1.0;
            }
        }
    }
    let most = most(&mut offs);
    assert!(offs.len() > 1000 && most < 0.25, "95 % of {} places are within {most} pixel", offs.len());
}

#[test]
fn photos_of_boards_are_refused() {
    let Some(folder) = corpus::artwork() else { return };
    for name in ["hello_t1616/board_photo.jpg", "milled_board_photo.jpeg"] {
        let bytes = std::fs::read(folder.join("pictures").join(name)).expect(name);
        let error = read(name, &bytes, &OPTIONS).expect_err(name).to_string();
        assert!(error.contains("photo"), "{error}");
    }
}
