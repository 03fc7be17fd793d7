//! Gerber files: what others drew from them, pixel for pixel, and what broken ones come to.
#![expect(
    clippy::print_stdout,
    reason = "the figures are what these tests are for: see them with --nocapture"
)]

use std::fs;
use std::path::Path;

use serde_json::Value;
use voromill::board::polarity;
use voromill::geometry::{Nm, Polygon};
use voromill::import::gerber::{self, Image, Options};

use crate::corpus::{board_folders, boards};

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("the file is there")).expect("it is JSON")
}

fn read(path: &Path) -> Result<Image, voromill::import::Error> {
    let name = path.file_name().expect("a file").to_string_lossy().into_owned();
    gerber::read(&name, &fs::read(path).expect("the file is there"), &Options::default())
}

/// The copper of an image as disjoint polygons.
fn copper(image: &Image) -> Vec<Polygon> {
    let polygons: Vec<Polygon> =
        image.features.iter().filter_map(|feature| feature.shape.polygon(Nm::new(100))).collect();
    polarity::union(&polygons)
}

/// A picture of a window: row 0 on top, true for copper.
struct Picture {
    width: usize,
    height: usize,
    pixels: Vec<bool>,
}

/// Where a picture lies on the board.
struct Window {
    origin: (f64, f64),
    pitch: f64,
    width: usize,
    height: usize,
}

impl Window {
    fn of(reference: &Value) -> Self {
        let inch = |index: usize| reference["origin_inch"][index].as_f64().expect("inches");
        let inch = |index| (inch(index) * 25.4e6).round();
        let size = |name: &str| usize::try_from(reference[name].as_u64().expect("pixels")).expect("a size");
        let dpi = reference["dpi"].as_f64().expect("a resolution");
        let (width, height) = (size("width_px"), size("height_px"));
        Self { origin: (inch(0), inch(1)), pitch: 25.4e6 / dpi, width, height }
    }

    /// The picture of disjoint polygons, sampled at pixel centres.
    fn draw(&self, polygons: &[Polygon]) -> Picture {
        let mut crossings: Vec<Vec<(f64, i32)>> = vec![Vec::new(); self.height];
        for (a, b) in polygons.iter().flat_map(Polygon::edges) {
            let ((ax, ay), (bx, by)) = (a.to_f64(), b.to_f64());
            let row = |y: f64| (y - self.origin.1) / self.pitch - 0.5;
            let (low, high, winding) = if ay < by { (ay, by, 1) } else { (by, ay, -1) };
            let (first, last) = (index(row(low).floor() + 1.0), index(row(high).floor() + 1.0));
            let rows = crossings.iter_mut().zip(0_u32..).skip(first).take(last.saturating_sub(first));
            for (row, number) in rows {
                let y = self.origin.1 + (f64::from(number) + 0.5) * self.pitch;
                row.push((ax + (bx - ax) * (y - ay) / (by - ay), winding));
            }
        }
        let mut pixels = vec![false; self.width * self.height];
        for (row, crossings) in crossings.iter_mut().enumerate() {
            crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut winding = 0;
            for pair in crossings.windows(2) {
                winding += pair[0].1;
                if winding == 0 {
                    continue;
                }
                let column = |x: f64| index(((x - self.origin.0) / self.pitch - 0.5).ceil());
                let (from, to) = (column(pair[0].0).min(self.width), column(pair[1].0).min(self.width));
                let top = (self.height - 1 - row) * self.width;
                pixels[top + from..top + to.max(from)].fill(true);
            }
        }
        Picture { width: self.width, height: self.height, pixels }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates, as it should here"
)]
fn index(value: f64) -> usize {
    value as usize
}

/// `part` ÷ `whole`.
fn share(part: usize, whole: usize) -> f64 {
    let count = |n: usize| f64::from(u32::try_from(n).expect("a count of pixels"));
    count(part) / count(whole)
}

impl Picture {
    fn load(path: &Path) -> Self {
        let image = image::open(path).expect("a picture").to_luma8();
        let (width, height) = (image.width() as usize, image.height() as usize);
        Self { width, height, pixels: image.pixels().map(|pixel| pixel.0[0] >= 128).collect() }
    }

    fn at(&self, x: usize, y: usize) -> bool {
        self.pixels[y * self.width + x]
    }

    /// Whether the pixels around (`x`, `y`) are not all alike.
    fn is_edge(&self, x: usize, y: usize) -> bool {
        let around = (y.saturating_sub(1)..=(y + 1).min(self.height - 1))
            .flat_map(|y| (x.saturating_sub(1)..=(x + 1).min(self.width - 1)).map(move |x| (x, y)));
        let dark = around.clone().filter(|&(x, y)| self.at(x, y)).count();
        dark != 0 && dark != around.count()
    }

    /// The pixels in which `other` differs, and how many of them are more than a pixel from an
    /// edge.
    fn compare(&self, other: &Self) -> (usize, usize) {
        assert_eq!((self.width, self.height), (other.width, other.height), "the same window");
        let differ = (0..self.pixels.len()).filter(|&i| self.pixels[i] != other.pixels[i]);
        let beyond = differ.clone().filter(|&i| !self.is_edge(i % self.width, i / self.width));
        (differ.count(), beyond.count())
    }
}

/// The largest share of pixels that may differ: what two independent readers at worst differ in.
const MISMATCH: f64 = 0.0006;

/// Where more pixels lie beyond an edge of the other picture, how many, and why.
///
/// The arcs of `gerbv_protel_se_sg`, in steps of a thousandth of an inch, have radii at their ends
/// that differ by up to that; which one holds is not specified (§4.7.2). The other program takes
/// the first, this one goes over evenly from the first to the second, so that both ends are met. In
/// `kicad_custom_pads` two edges of an outline primitive (§4.5.1) meet at an acute angle; the two
/// pixels lie in the wedge between them, 6 µm outside, where the winding number is zero.
const BEYOND: &[(&str, usize)] =
    &[("gerbv_protel_se_sg/front", 4), ("gerbv_protel_se_sg/back", 6), ("kicad_custom_pads/front", 2)];

#[test]
fn copper_is_what_other_programs_draw() {
    let mut failures = Vec::new();
    for folder in board_folders() {
        for side in ["front", "back"] {
            let picture = folder.join(format!("ref/{side}_500.png"));
            if picture.exists() {
                let name = format!("{}/{side}", folder.file_name().expect("a name").to_string_lossy());
                failures.extend(compare(&folder, &picture, side, &name).err());
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Compares one layer of a board with its reference picture and its known islands.
fn compare(folder: &Path, picture: &Path, side: &str, name: &str) -> Result<(), String> {
    let reference = json(&picture.with_extension("json"));
    let file = folder.join(reference["layer_file"].as_str().expect("a file"));
    let image = read(&file).map_err(|error| format!("{name}: {error}"))?;
    let copper = copper(&image);
    let expected = Picture::load(picture);
    let (differ, beyond) = expected.compare(&Window::of(&reference).draw(&copper));
    let share = share(differ, expected.pixels.len());
    let truth = json(&folder.join("truth_nets.json"));
    let islands = truth[side]["islands_shapely"].as_u64();
    let excused = BEYOND.iter().find(|(file, _)| *file == name).map_or(0, |(_, count)| *count);
    let found = format!(
        "{name}: {:.4} % differ, {beyond} beyond an edge, {} islands ({islands:?} expected), {} features",
        share * 100.0,
        copper.len(),
        image.features.len(),
    );
    println!("{found}");
    let agrees = share <= MISMATCH && beyond <= excused && islands == Some(copper.len() as u64);
    if agrees { Ok(()) } else { Err(found) }
}

#[test]
fn tricky_files_read_as_their_index_says() {
    let Some(boards) = boards() else { return };
    let folder = boards.join("syntax");
    let index = json(&folder.join("INDEX.json"));
    let mut failures = Vec::new();
    for entry in index.as_array().expect("a list").iter().filter(|entry| entry["kind"] == "gerber") {
        failures.extend(tricky(&folder, entry).err());
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Compares one file of `syntax` with its entry in the index.
fn tricky(folder: &Path, entry: &Value) -> Result<(), String> {
    let name = entry["file"].as_str().expect("a name");
    let verdict = entry["verdict"].as_str().unwrap_or_default();
    let image = match read(&folder.join(name)) {
        Ok(image) => image,
        Err(_) if verdict.starts_with("NO REFERENCE") || verdict.starts_with("nothing drawn") => {
            return Ok(());
        }
        Err(error) => return Err(format!("{name}: {error}")),
    };
    if verdict.starts_with("NO REFERENCE") {
        return Ok(());
    }
    let copper = copper(&image);
    let area: f64 = copper.iter().map(Polygon::area_mm2).sum();
    let expected = entry["shapely"]["area_mm2"].as_f64().expect("an area");
    let islands = entry["shapely"]["islands"].as_u64().expect("islands");
    let mut found = format!("{name}: area {area:.4} ({expected:.4}), {} islands ({islands})", copper.len());
    let mut agrees = (area - expected).abs() <= 1e-3 * expected && islands == copper.len() as u64;
    if let (Some(bounds), Some(expected)) = (
        copper.iter().map(Polygon::bounds).reduce(voromill::geometry::Rect::union),
        entry["shapely"]["bbox_mm"].as_array(),
    ) {
        let sides = [bounds.min().x, bounds.min().y, bounds.max().x, bounds.max().y].map(Nm::to_mm);
        let far = sides.iter().zip(expected).map(|(a, b)| (a - b.as_f64().expect("mm")).abs());
        agrees &= far.fold(0.0, f64::max) <= 0.001;
        found += &format!(", bounds {sides:?} ({expected:?})");
    }
    if let Some(png) = entry["ref"]["png"].as_str() {
        let expected = Picture::load(&folder.join(png));
        let (differ, beyond) = expected.compare(&Window::of(&entry["ref"]).draw(&copper));
        found += &format!(", {differ} pixels differ, {beyond} beyond an edge");
        agrees &= beyond == 0 && share(differ, expected.pixels.len()) <= MISMATCH;
    }
    println!("{found}");
    if agrees { Ok(()) } else { Err(found) }
}

#[test]
fn broken_files_end_as_they_should() {
    let Some(boards) = boards() else { return };
    let folder = boards.join("broken");
    let expect = json(&folder.join("EXPECT.json"));
    let mut failures = Vec::new();
    for entry in expect["files"].as_array().expect("a list") {
        let name = entry["file"].as_str().expect("a name");
        // What is wrong with the outlines shows only when they are put together.
        let outline = ["p2g_broken_box.gbr", "p2g_broken_loop_edge_cuts.gbr"].contains(&name);
        if outline || !(name.ends_with(".gbr") || name.ends_with(".millproject")) {
            continue;
        }
        let result = read(&folder.join(name));
        let described = match &result {
            Ok(image) => {
                let warnings: Vec<_> =
                    image.warnings.iter().map(|warning| warning.message.as_str()).collect();
                format!("{} features, {warnings:?}", image.features.len())
            }
            Err(error) => error.to_string(),
        };
        let as_expected = match (entry["expect"].as_str().expect("an expectation"), &result) {
            ("error", Err(_)) | ("recoverable", Err(_)) => true,
            ("recoverable", Ok(image)) => !image.warnings.is_empty(),
            // That it draws nothing, or nothing but bare lines, is for the caller to say.
            ("empty_layer", Ok(image)) => copper(image).is_empty(),
            _ => false,
        };
        let line = format!("{name}, {} ({}): {described}", entry["expect"], entry["what_is_wrong"]);
        println!("{line}");
        if !as_expected {
            failures.push(line);
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// As EasyEDA 6.5.42 writes them; points that mean something are kept.
#[test]
fn whole_numbers_with_a_decimal_point_are_read_by_the_number_format() {
    let square = |scale: &str, low: &str, high: &str| {
        let text = format!(
            "%FSLAX45Y45*%\n%MOMM*%\n%ADD10C,0.1*%\nG36*\nX{low}Y{low}D02*\nG01X{high}D01*\nY{high}D01*\nX{low}D01*\n\
             Y{low}D01*\nG37*\nM02*\n"
        );
        let image = gerber::read("a.gbr", text.as_bytes(), &Options::default()).expect(scale);
        let codes: Vec<_> = image.warnings.iter().map(|warning| warning.code()).collect();
        (copper(&image).iter().map(Polygon::area_mm2).sum::<f64>(), codes)
    };
    // From 5 µm to 63.5 mm: the first is no length that is beyond any board.
    let (area, codes) = square("whole numbers", "500.0", "6350000.0");
    assert!((area - 63.495 * 63.495).abs() < 1e-6, "{area}");
    assert_eq!(codes, ["idle-points"]);
    let (area, codes) = square("millimetres", "1.0", "11.0");
    assert!((area - 100.0).abs() < 1e-6, "{area}");
    assert_eq!(codes, [""; 0]);
    let text = b"%FSLAX45Y45*%\n%MOMM*%\n%ADD10C,1*%\nD10*\nX6350000.5Y0D03*\nM02*\n";
    let error = gerber::read("a.gbr", text, &Options::default()).expect_err("half of what?").to_string();
    assert!(error.contains("out of range"), "{error}");
}

/// A star whose thousand edges all cross each other in a few kilobytes took seconds, one of two
/// thousand a minute.
#[test]
fn a_region_of_few_edges_that_all_cross_is_refused() {
    let star = |points: u32| {
        let corner = |i: u32| {
            let turn = f64::from(i % points) * f64::from(points / 2) / f64::from(points);
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * turn);
            format!("X{:.0}Y{:.0}D0{}*\n", 5e7 * cos, 5e7 * sin, if i == 0 { 2 } else { 1 })
        };
        let corners: String = (0..=points).map(corner).collect();
        let file = format!("%FSLAX46Y46*%\n%MOMM*%\nG36*\n{corners}G37*\nM02*\n");
        gerber::read("star.gbr", file.as_bytes(), &Options::default())
    };
    assert_eq!(star(101).expect("a star").features.len(), 1, "few crossings are worked out");
    let error = star(1_001).expect_err("half a million crossings").to_string();
    assert!(error.contains("crosses itself too often"), "{error}");
}
