//! Masks read back, each format by a reader that shares nothing with its writer: the same islands,
//! the same copper, the same names.

mod pixels;
mod portable;
mod vectors;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use voromill::board::{Board, Copper, FLATTEN, Side, polarity};
use voromill::geometry::{Nm, Polygon, Rect};
use voromill::import::{self, Selection, gerber};
use voromill::job::{self, Masking, Options, Settings};
use voromill::report::mask::{self, Placing, Sheet, What};
use voromill::topology::{self, Method};

use super::cli::{stderr, stdout, voromill};

fn board(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(name)
}

/// Every layer of our own boards.
fn layers() -> Vec<(Board, Side)> {
    let names = ["blinker", "regulator", "unsafe-gap"];
    let load = |name: &str| import::load(&[board(name)], &Selection::default()).expect(name).board;
    let boards = names.into_iter().map(load);
    boards
        .flat_map(|board| [Side::Front, Side::Back].map(|side| (board.clone(), side)))
        .filter(|(board, side)| board.copper(*side).is_some())
        .collect()
}

/// How far chords leave what is round here: small pads lose a part in ten thousand to
/// [`FLATTEN`].
const FINE: Nm = Nm::new(20);

/// Islands and their area in mm², from polygons that may overlap.
fn islands<'a>(polygons: impl IntoIterator<Item = &'a Polygon>) -> (usize, f64) {
    let united = polarity::union(polygons);
    (united.len(), united.iter().map(Polygon::area_mm2).sum())
}

fn islands_of(copper: &Copper) -> (usize, f64) {
    let shapes: Vec<Polygon> =
        copper.features.iter().filter_map(|feature| feature.shape.polygon(FINE)).collect();
    islands(&shapes)
}

fn copper_sheet(board: &Board, side: Side) -> Sheet {
    let copper = board.copper(side).expect("copper");
    let nets = topology::recover(copper, Method::Contact);
    Sheet::copper(board, copper, &nets, copper.bounds().expect("copper has a size"))
}

fn names(copper: &Copper) -> BTreeSet<String> {
    copper.features.iter().filter_map(|feature| copper.attributes_of(feature).net.clone()).collect()
}

/// Whether two areas agree within so many parts of a million.
fn assert_alike(found: (usize, f64), expected: (usize, f64), millionths: f64, what: &str) {
    assert_eq!(found.0, expected.0, "{what}: islands");
    let off = (found.1 / expected.1 - 1.0).abs() * 1e6;
    assert!(off <= millionths, "{what}: {} mm² instead of {}: {off:.1} millionths", found.1, expected.1);
}

#[test]
fn gerber_read_back_is_the_copper_with_the_names_of_its_nets() {
    for (board, side) in layers() {
        let copper = board.copper(side).expect("copper");
        let text = mask::film(&copper_sheet(&board, side));
        let image = gerber::read("mask.gbr", text.as_bytes(), &gerber::Options::default()).expect(&text);
        assert!(image.warnings.is_empty(), "{}: {:?}", board.name, image.warnings);
        let function = if side == Side::Front { "Copper,L1,Top" } else { "Copper,L2,Bot" };
        assert_eq!(image.function.as_deref(), Some(function), "{}", board.name);
        let back = Copper { side, features: image.features, attributes: image.attributes };
        assert_alike(islands_of(&back), islands_of(copper), 100.0, &format!("{} {side}", board.name));
        assert_eq!(names(&back), names(copper), "{} {side}", board.name);
        let nets = |copper: &Copper| topology::recover(copper, Method::Contact).nets().len();
        assert_eq!(nets(&back), nets(copper), "{} {side}", board.name);
    }
}

#[test]
fn svg_read_back_is_the_copper() {
    for (board, side) in layers() {
        let copper = board.copper(side).expect("copper");
        let shapes = vectors::ink(&mask::drawing(&copper_sheet(&board, side)), Nm::from_mm(1));
        let polygons: Vec<Polygon> = shapes.iter().flat_map(|rings| polarity::clean(rings)).collect();
        assert_alike(islands(&polygons), islands_of(copper), 100.0, &format!("{} {side}", board.name));
    }
}

#[test]
fn pdf_read_back_is_the_copper() {
    for (board, side) in layers() {
        let copper = board.copper(side).expect("copper");
        let sheet = copper_sheet(&board, side);
        let file = portable::read(&mask::page(&sheet));
        let points = |length: Nm| length.to_mm() / 25.4 * 72.0;
        let size = (points(sheet.area.width()), points(sheet.area.height()));
        let off = (file.size.0 - size.0).abs().max((file.size.1 - size.1).abs());
        assert!(off < 1e-5, "{:?} instead of {size:?} points", file.size);
        assert_alike(islands(&file.ink), islands_of(copper), 100.0, &format!("{} {side}", board.name));
    }
}

#[test]
fn png_read_back_is_the_copper_and_says_how_large_a_pixel_is() {
    for (board, side) in layers() {
        let copper = board.copper(side).expect("copper");
        let sheet = copper_sheet(&board, side);
        let picture = pixels::read(&mask::bitmap(sheet, 2400).expect("not too large"));
        assert_eq!(picture.per_metre, 94_488, "2400 DPI");
        let pixel = 25.4 / 2400.0;
        let (count, area) = islands_of(copper);
        assert_eq!(picture.islands(), count, "{} {side}", board.name);
        // An edge along a row or a column is off by half a pixel at most, and the edges of these
        // boards are all at a few places of their pixels.
        let polygons: Vec<Polygon> =
            copper.features.iter().filter_map(|feature| feature.shape.polygon(FLATTEN)).collect();
        let perimeter: f64 = polarity::union(&polygons).iter().map(Polygon::perimeter).sum();
        let off = (picture.ink() * pixel * pixel - area).abs();
        assert!(off < perimeter * 1e-6 * pixel / 2.0, "{} {side}: {off} mm² of {area}", board.name);
    }
}

#[test]
fn a_page_of_pixels_ends_where_it_must() {
    // 2400 DPI is 10583⅓ nm: on a grid of whole nanometres 200 mm would end 6 µm off.
    let mut board = Board { name: "bar".to_owned(), ..Board::default() };
    let at = |x, y| voromill::geometry::Point::new(Nm::from_um(x), Nm::from_um(y));
    let square =
        |x| voromill::board::Shape::Polygon(Polygon::rectangle(Rect::new(at(x, 0), at(x + 254, 254))));
    let feature = |shape| voromill::board::Feature {
        shape,
        axis: voromill::board::Axis::Region,
        attributes: 0,
        line: 1,
    };
    let features = vec![feature(square(0)), feature(square(254_000))];
    board.front = Some(Copper { side: Side::Front, features, attributes: vec![Default::default()] });
    let picture = pixels::read(&mask::bitmap(copper_sheet(&board, Side::Front), 2400).expect("a bar"));
    assert_eq!((picture.width, picture.height), (24_024, 24), "ten inches and a hundredth");
    let row: Vec<usize> = (0..picture.width).filter(|&x| picture.is_ink(x, 12)).collect();
    assert_eq!(row, (0..24).chain(24_000..24_024).collect::<Vec<_>>(), "exactly");
}

fn masked(board: &Board, what: What, change: impl FnOnce(&mut Masking)) -> Sheet {
    let loaded = import::Loaded {
        board: board.clone(),
        sources: Vec::new(),
        warnings: Vec::new(),
        ignored: Vec::new(),
    };
    let side = if board.front.is_some() { Side::Front } else { Side::Back };
    let mut masking = Masking {
        side,
        what,
        gap: Nm::from_um(200),
        clearance: Nm::from_um(50),
        margin: Nm::ZERO,
        negative: false,
    };
    change(&mut masking);
    let settings = Settings::resolve(Options::default()).expect("the defaults");
    job::mask(&loaded, &settings, &masking).expect("a mask").0
}

fn polygons(sheet: &Sheet) -> Vec<Polygon> {
    sheet.shapes().filter_map(|shape| shape.polygon(FLATTEN)).collect()
}

#[test]
fn regions_are_one_for_each_net_and_a_gap_apart() {
    for name in ["blinker", "regulator"] {
        let board = import::load(&[board(name)], &Selection::default()).expect(name).board;
        let sheet = masked(&board, What::Regions, |_| {});
        let copper = board.copper(sheet.side).expect("copper");
        let nets = topology::recover(copper, Method::Contact);
        assert_eq!(islands(&polygons(&sheet)).0, nets.nets().len(), "{name}: a region for each net");
        let named: BTreeSet<&String> = sheet.nets.iter().filter_map(|net| net.name.as_ref()).collect();
        let names = names(copper);
        assert_eq!(named, names.iter().collect(), "{name}: with its name");
        // Grown by a little less than half the gap they touch nowhere, by a little more they are
        // one.
        let grown = |by: i64| -> Vec<Polygon> {
            let regions = polygons(&sheet);
            regions.iter().flat_map(|region| polarity::offset(region, Nm::from_um(by), FLATTEN)).collect()
        };
        assert_eq!(islands(&grown(98)).0, nets.nets().len(), "{name}: no gap is narrower");
        assert_eq!(islands(&grown(103)).0, 1, "{name}: and none is wider");
    }
}

#[test]
fn a_region_is_its_nets_where_the_gap_takes_the_corner_that_copper_begins_at() {
    let out = TempDir::new().expect("a temporary folder");
    // Two areas, the first corner of each a tenth of a millimetre from the other, and one of three
    // hundredths between others, of which nothing is left.
    let area = |corners: &[(i32, i32)]| {
        let place = |&(x, y): &(i32, i32)| format!("X{x}Y{y}");
        let (first, rest) = corners.split_first().expect("corners");
        let drawn: String =
            rest.iter().chain([first]).map(|corner| format!("{}D01*\n", place(corner))).collect();
        format!("G36*\n{}D02*\nG01*\n{drawn}G37*\n", place(first))
    };
    let gerber = [
        area(&[(1950, 0), (0, 0), (0, 2000), (1950, 2000)]),
        area(&[(2050, 0), (4000, 0), (4000, 2000), (2050, 2000)]),
        area(&[(4100, 0), (4130, 0), (4130, 2000), (4100, 2000)]),
        area(&[(4230, 0), (6000, 0), (6000, 2000), (4230, 2000)]),
    ];
    let text = format!("%FSLAX33Y33*%\n%MOMM*%\n{}M02*\n", gerber.concat());
    fs::write(out.path().join("a-F_Cu.gbr"), text).expect("written");
    let arguments = ["mask", "a-F_Cu.gbr", "--what", "regions", "--gap", "0.4mm", "-o", "a.svg"];
    let done = voromill(out.path(), &arguments);
    assert!(done.status.success(), "{}", stderr(&done));
    let drawn = fs::read_to_string(out.path().join("a.svg")).expect("written");
    let titles: Vec<&str> =
        drawn.match_indices("<title>net ").map(|(at, _)| &drawn[at + 7..at + 12]).collect();
    assert_eq!(titles, ["net 1", "net 2", "net 4"], "{drawn}");
    let lost = stderr(&done).matches("has no region left").count();
    assert_eq!(lost, 1, "the narrow one alone: {}", stderr(&done));
    assert!(!drawn.contains("no net"), "{drawn}");
}

#[test]
fn a_negative_is_all_the_rest_of_the_page() {
    let board = import::load(&[board("blinker")], &Selection::default()).expect("a board").board;
    let margin = |masking: &mut Masking| masking.margin = Nm::from_mm(2);
    let positive = masked(&board, What::Copper, margin);
    let negative = masked(&board, What::Copper, |masking| {
        margin(masking);
        masking.negative = true;
    });
    let page = Polygon::rectangle(positive.area).area_mm2();
    let both = islands(&polygons(&positive)).1 + islands(&polygons(&negative)).1;
    assert!((both / page - 1.0).abs() < 1e-9, "{both} of {page} mm²");
    assert!(mask::film(&negative).contains("%TF.FilePolarity,Negative*%"), "and says so");
}

#[test]
fn openings_are_pads_with_room_round_them() {
    let board = import::load(&[board("regulator")], &Selection::default()).expect("a board").board;
    let sheet = masked(&board, What::Openings, |_| {});
    let tight = masked(&board, What::Openings, |masking| masking.clearance = Nm::ZERO);
    let (count, area) = islands(&polygons(&sheet));
    let (pads, copper) = islands(&polygons(&tight));
    assert!(count > 0 && count <= pads, "{count} openings for {pads} pads");
    assert!(area > copper, "{area} mm² round {copper}");
    let strokes = board.copper(sheet.side).expect("copper").features.len();
    assert!(sheet.shapes().count() < strokes, "traces stay covered");
}

#[test]
fn a_mirrored_page_is_the_same_from_behind() {
    let (board, side) = layers().remove(0);
    let sheet = copper_sheet(&board, side);
    let mirror = Placing { mirrored: true, scale: (1.0, 1.0) };
    let once = mirror.place(sheet.clone());
    assert_ne!(once, sheet, "left is right");
    assert_eq!(mirror.place(once.clone()), sheet, "and back again");
    assert_alike(islands(&polygons(&once)), islands(&polygons(&sheet)), 1.0, "mirrored");
    let stretched = Placing { mirrored: true, scale: (1.002, 0.998) }.place(sheet.clone());
    let (count, area) = islands(&polygons(&sheet));
    let expected = (count, area * 1.002 * 0.998);
    assert_alike(islands(&polygons(&stretched)), expected, 30.0, "stretched");
}

#[test]
fn the_program_writes_each_kind_and_says_how_large_it_is() {
    let out = TempDir::new().expect("a temporary folder");
    let board = board("regulator");
    let board = board.to_string_lossy();
    let mask = |arguments: &[&str]| voromill(out.path(), &[&["mask", &board], arguments].concat());
    for (name, starts) in
        [("a.png", "\u{fffd}PNG"), ("a.svg", "<svg"), ("a.pdf", "%PDF-1.4"), ("a.gbr", "%TF.")]
    {
        for what in ["copper", "regions", "mask"] {
            let done = mask(&["--side", "back", "--what", what, "-o", name]);
            assert!(done.status.success(), "{name} {what}: {}", stderr(&done));
            let bytes = fs::read(out.path().join(name)).expect("written");
            assert!(String::from_utf8_lossy(&bytes).starts_with(starts), "{name} {what}");
            let said = stdout(&done);
            assert!(said.starts_with(name) && said.contains("of the back"), "{said}");
            assert_eq!(said.contains("mirrored"), name != "a.gbr", "the back as one looks at it: {said}");
        }
    }
    for (arguments, word) in [
        (&["-o", "a.bmp"][..], "the format of a.bmp is unknown"),
        (&["-o", "a.svg", "--dpi", "600"], "--dpi has no effect"),
        (&["-o", "a.svg", "--gap", "1mm"], "--gap has no effect"),
        (&["-o", "a.svg", "--what", "regions", "--gap", "0.001mm"], "gap: 0.001 mm is out of range"),
        (&["-o", "a.svg", "--scale", "10"], "not a scale"),
        (&["-o", "a.png", "--dpi", "25400", "--margin", "30mm"], "too many"),
    ] {
        let failed = mask(arguments);
        assert_eq!(failed.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&failed).contains(word), "{arguments:?}: {}", stderr(&failed));
    }
}

#[test]
fn a_drawing_of_copper_read_back_is_the_copper() {
    let out = TempDir::new().expect("a temporary folder");
    for (name, side) in [("blinker", "back"), ("regulator", "front")] {
        let path = board(name);
        let loaded = import::load(std::slice::from_ref(&path), &Selection::default()).expect(name);
        let side_of = if side == "front" { Side::Front } else { Side::Back };
        let copper = loaded.board.copper(side_of);
        let Some(copper) = copper else { panic!("{name} has a {side}") };
        for stage in ["copper", "nets"] {
            let arguments =
                ["draw", &*path.to_string_lossy(), "--side", side, "--stage", stage, "-o", "x.svg"];
            let done = voromill(out.path(), &arguments);
            assert!(done.status.success(), "{}", stderr(&done));
            let text = fs::read_to_string(out.path().join("x.svg")).expect("written");
            let from = text.find("<g id=\"copper\"").expect("a layer of copper");
            let to = text.find("<g id=\"drills\"").expect("a layer of drills");
            let shapes = vectors::ink(&text[from..to], Nm::new(10));
            let polygons: Vec<Polygon> = shapes.iter().flat_map(|rings| polarity::clean(rings)).collect();
            assert_alike(islands(&polygons), islands_of(copper), 100.0, &format!("{name} {stage}"));
        }
    }
}
