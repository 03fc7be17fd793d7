//! What programs leave of a board, as pictures show it, beside what the board's files say.

use std::path::Path;

use voromill::board::{Axis, Board, Side};
use voromill::geometry::{Nm, Point, Rect};
use voromill::grid::Grid;
use voromill::import::{self, Selection};
use voromill::job::{self, Job, Options, Part};
use voromill::verify::{Placement, Program, Role, Settings, Surface};

fn milled() -> (Job, job::Settings) {
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/regulator");
    let settings = job::Settings::resolve(Options::default()).expect("settings");
    let loaded = import::load(&[board], &Selection::default()).expect("a board");
    (job::mill(loaded, &settings).expect("a job"), settings)
}

/// What the programs for one part mill, all with the same placement.
fn surface(job: &Job, board: &Board, part: Part, role: Role) -> Surface {
    let placement = Placement { shift: job.placement.shift, ..Placement::default() };
    let programs = job.programs.iter().filter(|written| written.part == part).map(|written| Program {
        file: written.tag.clone(),
        text: written.text.clone(),
        role: Some(role),
        placement: Some(placement),
        ..Program::default()
    });
    Surface::of_board(&programs.collect::<Vec<_>>(), board, &Settings::default()).expect("our own")
}

#[test]
fn copper_stands_holes_go_through_and_cuts_are_as_deep_as_asked() {
    let (job, settings) = milled();
    let board = &job.board;
    let front = surface(&job, board, Part::Front, Role::Isolation(Side::Front));
    let thickness = settings.thickness.to_f64();
    let copper = board.copper(Side::Front).expect("copper");
    let pads = copper.features.iter().filter_map(|feature| match feature.axis {
        Axis::Flash(center) => Some(center.to_f64()),
        Axis::Line(..) | Axis::Arc(_) | Axis::Region => None,
    });
    let pads: Vec<(f64, f64)> = pads.collect();
    assert!(pads.len() > 10, "there are pads: {}", pads.len());
    assert!(pads.iter().all(|&p| front.depth(p) <= 0.0), "nothing is cut in the middle of a pad");
    let layer = job.layer(Side::Front).expect("a front");
    let depth = Nm::from_um(100).to_f64();
    let mut cut = 0;
    for boundary in layer.boundaries.edges.iter().filter(|boundary| !boundary.is_border()) {
        let p = boundary.path.start.to_f64();
        cut += usize::from((front.depth(p) - depth).abs() < 1.0);
    }
    assert!(cut > 5, "boundaries begin where it is cut: {cut}");
    let holes = surface(&job, board, Part::Drill, Role::Drilling);
    for hole in &board.holes {
        let at = hole.path.start.to_f64();
        assert!(holes.depth(at) >= thickness, "a hole at {at:?} goes through");
        let beside = (at.0 + hole.diameter.to_f64() * 0.51, at.1);
        assert!(hole.is_slot() || holes.depth(beside) <= 0.0, "and is no wider: {at:?}");
    }
}

/// The pixels are those that single places have.
#[test]
fn a_grid_of_depths_is_the_depth_of_each_of_its_pixels() {
    let (job, _) = milled();
    let front = surface(&job, &job.board, Part::Front, Role::Isolation(Side::Front));
    let bounds = job.board.bounds().expect("a board");
    let window = Rect::new(bounds.min(), bounds.min().midpoint(bounds.max()));
    let grid = Grid::covering(window, Nm::from_um(90)).expect("pixels");
    let depths = front.depths(&grid);
    let mut deep = 0;
    for row in 0..grid.height() {
        for column in 0..grid.width() {
            let alone = front.depth(grid.center(i64::from(column), i64::from(row)).to_f64());
            let here = f64::from(depths[(row * grid.width() + column) as usize]);
            assert!((here - alone).abs() < 0.1, "at {column}, {row}: {here} and {alone} nm");
            deep += usize::from(alone > 0.0);
        }
    }
    assert!(deep > 1_000, "and some are cut: {deep}");
}

/// Seen from behind, a hole at the left is one at the right.
#[test]
fn the_back_is_seen_from_behind() {
    let (job, settings) = milled();
    let hole = job.board.holes.iter().find(|hole| hole.is_slot()).expect("a slot");
    let bounds = job.board.bounds().expect("a board");
    let columns = |side: Side| {
        let picture = job.milled(side, (bounds, Nm::from_um(100)), &settings).expect("a picture");
        let band = *picture.grid();
        let pixels = picture.draw(band).into_rgb();
        let copper = pixels.chunks(3).fold(std::collections::BTreeMap::new(), |mut counts, pixel| {
            *counts.entry(pixel.to_vec()).or_insert(0) += 1;
            counts
        });
        let ground = copper.iter().max_by_key(|(_, count)| **count).expect("pixels").0.clone();
        let center: Point = hole.path.start;
        // The middle of the hole lies so far down in the picture, and a little lower in depth.
        let pixels_in = |way: Nm| usize::try_from(way.get() / 100_000).expect("within");
        let row = pixels_in(bounds.max().y - center.y) * 4 / 5;
        let row = &pixels[row * band.width() as usize * 3..(row + 1) * band.width() as usize * 3];
        let column = |x: Nm| pixels_in(x - bounds.min().x);
        let mirrored = bounds.min().x + bounds.max().x - center.x;
        [center.x, mirrored].map(|x| row[column(x) * 3..][..3] != ground[..])
    };
    assert_eq!(columns(Side::Front), [true, false], "from the front");
    assert_eq!(columns(Side::Back), [false, true], "from behind");
}
