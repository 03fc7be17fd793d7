//! Gerber files: what others drew from them, pixel for pixel, and what broken ones come to.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use voromill::board::polarity;
use voromill::geometry::{Nm, Polygon};
use voromill::import::gerber::{self, Image, Options};

/// The folder of real boards, which is not part of the repository; none where there is none.
fn boards() -> Option<PathBuf> {
    let folder = std::env::var_os("VOROMILL_BOARDS")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/boards"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no boards in {}", folder.display());
    None
}

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
            let first = (row(low).floor() + 1.0).max(0.0) as usize;
            for index in first..self.height {
                let y = self.origin.1 + (index as f64 + 0.5) * self.pitch;
                if y > high {
                    break;
                }
                crossings[index].push((ax + (bx - ax) * (y - ay) / (by - ay), winding));
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
                let column = |x: f64| ((x - self.origin.0) / self.pitch - 0.5).ceil().max(0.0) as usize;
                let (from, to) = (column(pair[0].0).min(self.width), column(pair[1].0).min(self.width));
                let top = (self.height - 1 - row) * self.width;
                pixels[top + from..top + to.max(from)].fill(true);
            }
        }
        Picture { width: self.width, height: self.height, pixels }
    }
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

    /// The pixels in which `other` differs, and how many of them are more than a pixel from an edge.
    fn compare(&self, other: &Self) -> (usize, usize) {
        assert_eq!((self.width, self.height), (other.width, other.height), "the same window");
        let differ = (0..self.pixels.len()).filter(|&i| self.pixels[i] != other.pixels[i]);
        let beyond = differ.clone().filter(|&i| !self.is_edge(i % self.width, i / self.width));
        (differ.count(), beyond.count())
    }
}

/// The largest share of pixels that may differ: what two independent readers at worst differ in.
const MISMATCH: f64 = 0.0006;

/// How many pixels may lie beyond an edge of the other picture.
const BEYOND: usize = 6;

#[test]
fn copper_is_what_other_programs_draw() {
    let Some(boards) = boards() else { return };
    let mut failures = Vec::new();
    let mut folders: Vec<_> =
        fs::read_dir(&boards).expect("boards").map(|e| e.expect("an entry").path()).collect();
    folders.sort();
    for folder in folders.iter().filter(|folder| folder.join("meta.json").exists()) {
        for side in ["front", "back"] {
            let (picture, place) =
                (folder.join(format!("ref/{side}_500.png")), folder.join(format!("ref/{side}_500.json")));
            if !picture.exists() {
                continue;
            }
            let reference = json(&place);
            let file = folder.join(reference["layer_file"].as_str().expect("a file"));
            let name = format!("{}/{}", folder.file_name().expect("a name").to_string_lossy(), side);
            let image = match read(&file) {
                Ok(image) => image,
                Err(error) => {
                    failures.push(format!("{name}: {error}"));
                    continue;
                }
            };
            let copper = copper(&image);
            let expected = Picture::load(&picture);
            let (differ, beyond) = expected.compare(&Window::of(&reference).draw(&copper));
            let share = differ as f64 / expected.pixels.len() as f64;
            let islands = json(&folder.join("truth_nets.json"))[side]["islands_shapely"].as_u64();
            let warnings: Vec<_> = image.warnings.iter().map(|w| w.code).collect();
            eprintln!(
                "{name}: {:.4} % differ, {beyond} beyond, {} islands (expected {islands:?}), {} features, {warnings:?}",
                share * 100.0,
                copper.len(),
                image.features.len()
            );
            if share > MISMATCH || beyond > BEYOND || islands != Some(copper.len() as u64) {
                failures.push(format!("{name}: {share} {beyond} {} {islands:?}", copper.len()));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
