//! The cellular automaton that thins a picture: against a slow one, and against its original.

use std::process::Command;

use voromill::raster::{Bits, Node, thin};

use crate::corpus;

/// The automaton pixel by pixel, straight from its description.
fn slow(width: usize, height: usize, set: &[bool]) -> (Vec<bool>, u32) {
    let inner = |at: usize| {
        let (x, y) = (at % width, at / width);
        set[at] && x > 0 && y > 0 && x + 1 < width && y + 1 < height
    };
    let mut now: Vec<bool> = (0..set.len()).map(inner).collect();
    let (mut passes, mut idle) = (0, 0);
    while idle < 2 {
        let gone: Vec<usize> =
            (0..now.len()).filter(|&at| now[at] && goes(&now, width, at, passes % 2)).collect();
        idle = if gone.is_empty() { idle + 1 } else { 0 };
        gone.into_iter().for_each(|at| now[at] = false);
        passes += 1;
    }
    (now, passes)
}

fn goes(now: &[bool], width: usize, at: usize, odd: u32) -> bool {
    // Clockwise from the upper left; in odd passes from the lower right. The rim is never set.
    let w = width;
    let round = [at - w - 1, at - w, at - w + 1, at + 1, at + w + 1, at + w, at + w - 1, at - 1];
    let turn = if odd == 1 { 4 } else { 0 };
    let p = |bit: usize| now[round[(bit + turn) % 8]];
    let pieces = [1, 3, 5, 7].into_iter().filter(|&side| !p(side) && (p(side + 1) || p(side + 2))).count();
    let pairs = |first: usize| (0..4).filter(|pair| p(first + 2 * pair) || p(first + 2 * pair + 1)).count();
    let count = pairs(0).min(pairs(1));
    let taken = (p(5) || p(6) || !p(0)) && p(7);
    let set: Vec<usize> = (0..8).filter(|&bit| p(bit)).collect();
    let ends: [&[usize]; 8] = [&[5], &[7], &[6], &[0], &[6, 7], &[5, 6], &[0, 7], &[0, 1]];
    (pieces == 1 && (2..=3).contains(&count) && !taken) || ends.contains(&set.as_slice())
}

#[test]
fn words_of_pixels_and_pixels_are_thinned_alike() {
    for (width, height, seed) in [(70, 90, 1_u64), (64, 70, 2), (129, 40, 3), (3, 3, 4), (200, 150, 5)] {
        // Blobs: noise of a cell of five pixels.
        let cell = |x: usize, y: usize| {
            let mut hash =
                (x as u64 / 5 * 7919 + y as u64 / 5 * 104_729 + seed).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            hash ^= hash >> 29;
            hash.wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 60 < 9
        };
        let set: Vec<bool> = (0..width * height).map(|at| cell(at % width, at / width)).collect();
        let thinned = thin(&Bits::new(width, height, |x, y| set[y * width + x]));
        let (expected, passes) = slow(width, height, &set);
        let found: Vec<(usize, usize)> = thinned.left.pixels().collect();
        let expected: Vec<(usize, usize)> =
            (0..set.len()).filter(|&at| expected[at]).map(|at| (at % width, at / width)).collect();
        assert_eq!(found, expected, "{width} × {height}");
        assert_eq!(thinned.generations, passes, "{width} × {height}");
        for (at, &age) in thinned.ages.iter().enumerate() {
            let (x, y) = (at % width, at / width);
            let is_inner = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
            assert_eq!(age > 0, set[at] && is_inner, "({x}, {y}) has an age where it was in the set");
        }
        let ends = found.iter().filter(|&&(x, y)| thinned.left.around(x, y).count_ones() == 1).count();
        assert_eq!(ends, 0, "{width} × {height}: no line ends anywhere");
    }
}

/// So many columns and rows of square pads, 30 pixels apart, of different sizes and a little out of
/// line: four regions meet nearly in a point between each four of them.
pub(crate) fn pads(count: u32) -> image::GrayImage {
    let hash = |column: u32, row: u32| (column * 7919 + row * 104_729 + 13).wrapping_mul(0x9e37_79b9) >> 20;
    image::GrayImage::from_fn(count * 30, count * 30, |x, y| {
        let hash = hash(x / 30, y / 30);
        let (left, top, side) = (4 + hash % 4, 4 + hash / 4 % 4, 16 + hash / 16 % 4);
        let is_pad = (left..left + side).contains(&(x % 30)) && (top..top + side).contains(&(y % 30));
        image::Luma([if is_pad { 255 } else { 0 }])
    })
}

/// What `inspect --thinning` says of a picture with pixels of a tenth of a millimetre.
fn neighbours(picture: &image::GrayImage) -> serde_json::Value {
    let folder = tempfile::tempdir().expect("a folder");
    picture.save(folder.path().join("pads.png")).expect("written");
    let line = "inspect pads.png --picture-dpi 254 --copper light --thinning --format json";
    let done = super::cli::voromill(folder.path(), &line.split(' ').collect::<Vec<_>>());
    let report: serde_json::Value = serde_json::from_slice(&done.stdout).expect("JSON");
    report["layers"][0]["thinning"].clone()
}

#[test]
fn neighbours_by_thinning_are_those_of_regions_but_for_short_boundaries() {
    let row = image::GrayImage::from_fn(100, 30, |x, y| {
        let is_pad = (5..25).contains(&y) && (x % 33 > 5) && x < 94;
        image::Luma([if is_pad { 255 } else { 0 }])
    });
    let found = neighbours(&row);
    assert_eq!(found["common"], 2, "three pads in a row: {found}");
    let none = |key: &str| found[key].as_array().is_some_and(Vec::is_empty);
    assert!(none("only_voronoi") && none("only_thinning") && none("merged"), "{found}");
    let found = neighbours(&pads(12));
    assert!(found["common"].as_u64() >= Some(2 * 12 * 11), "all that lie side by side: {found}");
    for key in ["only_voronoi", "only_thinning"] {
        let alone = found[key].as_array().expect("a list");
        assert!(!alone.is_empty(), "four that meet nearly in a point: {found}");
        for entry in alone {
            let length = entry["boundary_mm"].as_f64().expect("a length");
            assert!(length < 0.6, "six pixels at most: {entry}");
        }
    }
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let set = Bits::new(700, 300, |x, y| (x * x + y * 37) % 97 > 30 || (x / 20 + y / 20) % 2 == 0);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| thin(&set))
    };
    assert_eq!(with(1), with(5), "the same bits and ages");
}

#[test]
fn a_lattice_has_its_junctions_and_routes() {
    // Two rooms side by side: two junctions of three lines, three ways between them.
    let rows = ["############", "#....#.....#", "#....#.....#", "#....#.....#", "############"];
    let lines = Bits::new(12, 5, |x, y| rows[y].as_bytes()[x] == b'#');
    let three = lines.pixels().filter(|&(x, y)| Node::of(lines.around(x, y)) == Node::Three).count();
    assert_eq!((three, lines.routes()), (2, 3), "a theta");
}

#[test]
fn cisolates_own_example_has_its_own_figures() {
    let Some(artwork) = corpus::artwork() else { return };
    let picture = artwork.join("pictures/cisolate_visolate_example.bmp");
    let out = tempfile::tempdir().expect("a folder");
    let done = Command::new(env!("CARGO_BIN_EXE_voromill"))
        .current_dir(out.path())
        .args(["draw", &picture.to_string_lossy(), "--stage", "thinning", "-o", "thin.png"])
        .output()
        .expect("runs");
    let said = String::from_utf8_lossy(&done.stderr);
    let expected = "82 generations, 111 drill dots, 140 three-way and 5 four-way junctions, 251 routes";
    assert!(done.status.success() && said.contains(expected), "{said}");
    let size = image::open(out.path().join("thin.png")).expect("a PNG").to_rgb8().dimensions();
    assert_eq!(size, (720, 480), "by its own pixels");
}
