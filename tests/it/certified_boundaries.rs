//! The boundaries of the certified diagram beside the picture of its regions, and at any pixel.

use voromill::geometry::Nm;
use voromill::grid::Grid;
use voromill::topology::{self, Method};
use voromill::voronoi::{Diagram, Owner, Settings, SiteKind};

use crate::real_boards::{self, Layer};

/// Unoptimised, boards with more features are left out: a picture takes its time.
const FEATURES_UNOPTIMISED: usize = 600;

/// What is wrong with the boundaries of a layer beside the picture of its regions: on either side
/// of each lies the region that it says, and between two pixels of different regions lies one.
///
/// A place within two pixels of a third region, or of where it is cut, is not asked.
fn difference(layer: &Layer, settings: &Settings) -> Option<String> {
    let nets = topology::recover(&layer.copper, Method::Contact);
    let diagram = Diagram::new(&layer.copper, &nets, layer.outline.as_ref(), settings).expect("a diagram");
    let regions = diagram.regions();
    let grid = regions.grid().expect("a picture");
    let width = grid.width() as usize;
    let mut picture = vec![Owner::Outside; width * grid.height() as usize];
    regions.paint(&layer.copper, &nets, &grid, |row, columns, owner| {
        let row = row as usize * width;
        picture[row + columns.start as usize..row + columns.end as usize].fill(owner);
    });
    let found = diagram.boundaries().expect("whole boundaries");
    let (mut wrong, mut asked, mut unseen) = (Vec::new(), 0, 0);
    let mut is_near = vec![false; picture.len()];
    for edge in &found.edges {
        for pair in edge.path.flatten(Nm::from_um(1)).windows(2) {
            let (from, to) = (pair[0].to_f64(), pair[1].to_f64());
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let (length, pitch) = ((dx * dx + dy * dy).sqrt(), grid.pitch().to_f64());
            let count = (length / pitch * 2.0).ceil().max(1.0);
            let mut part = 0.5;
            while part < count {
                let at = (from.0 + dx * part / count, from.1 + dy * part / count);
                mark(&grid, at, &mut is_near);
                let aside = |way: f64| {
                    let off = 1.5 * way * pitch / length;
                    pixel(&grid, (at.0 - dy * off, at.1 + dx * off)).map(|i| picture[i])
                };
                let known = around(&grid, at, &picture);
                if length > 0.0 && known.iter().all(|owner| [edge.left, edge.right].contains(owner)) {
                    asked += 1;
                    // What is narrower than a pixel no picture shows.
                    unseen += usize::from(known.len() < 2);
                    if known.len() == 2 && [aside(1.0), aside(-1.0)] == [Some(edge.right), Some(edge.left)] {
                        wrong.push(format!("{at:?}: not {:?} and {:?}", edge.left, edge.right));
                    }
                }
                part += 1.0;
            }
        }
    }
    for (i, &owner) in picture.iter().enumerate() {
        let next = [(i % width + 1 < width).then_some(i + 1), Some(i + width).filter(|&i| i < picture.len())];
        for other in next.into_iter().flatten() {
            if picture[other] != owner && !is_near[i] && !is_near[other] {
                wrong.push(format!("pixel {} of row {}: nothing parts {owner:?}", i % width, i / width));
            }
        }
    }
    let is_wrong = wrong.len() * 1000 > asked || unseen * 100 > asked;
    is_wrong.then(|| {
        wrong.truncate(5);
        format!("{} with {:?}: {wrong:#?}, {unseen} unseen of {asked}", layer.name, settings.limit)
    })
}

/// The index of the pixel that a place in nanometres lies in.
fn pixel(grid: &Grid, (x, y): (f64, f64)) -> Option<usize> {
    let (first, pitch) = (grid.center(0, 0).to_f64(), grid.pitch().to_f64());
    let (column, row) = (((x - first.0) / pitch).round(), ((first.1 - y) / pitch).round());
    let holds = |at: f64, size: u32| (0.0..f64::from(size)).contains(&at);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the picture")]
    let index = |at: f64| at as usize;
    let is_within = holds(column, grid.width()) && holds(row, grid.height());
    is_within.then(|| index(row) * grid.width() as usize + index(column))
}

/// The pixels within two of a place.
fn square(grid: &Grid, at: (f64, f64)) -> impl Iterator<Item = usize> {
    let (width, all) = (grid.width() as usize, grid.width() as usize * grid.height() as usize);
    pixel(grid, at).into_iter().flat_map(move |i| {
        let rows = (i / width).saturating_sub(2)..(i / width + 3).min(all / width);
        rows.flat_map(move |row| {
            let columns = (i % width).saturating_sub(2)..(i % width + 3).min(width);
            columns.map(move |column| row * width + column)
        })
    })
}

/// The owners within two pixels of a place.
fn around(grid: &Grid, at: (f64, f64), picture: &[Owner]) -> Vec<Owner> {
    let mut owners: Vec<Owner> = square(grid, at).map(|i| picture[i]).collect();
    owners.sort_unstable();
    owners.dedup();
    owners
}

/// Marks the pixels within two of a place.
fn mark(grid: &Grid, at: (f64, f64), is_near: &mut [bool]) {
    square(grid, at).for_each(|i| is_near[i] = true);
}

/// Pixels that see the gaps of a layer.
fn settings(layer: &Layer) -> Settings {
    let nets = topology::recover(&layer.copper, Method::Contact);
    let gap = topology::smallest_gap(&layer.copper, &nets);
    let least = gap.map_or(Nm::from_um(50), |gap| gap.width / 3);
    Settings { pitch: least.clamp(Nm::from_um(8), Nm::from_um(50)), ..Settings::default() }
}

#[test]
fn every_side_has_the_boundaries_that_a_picture_shows() {
    let layers = real_boards::layers(FEATURES_UNOPTIMISED);
    let wrong: Vec<_> = layers.filter_map(|layer| difference(&layer, &settings(&layer))).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_side_has_the_loops_that_a_picture_shows() {
    let layers = real_boards::layers(FEATURES_UNOPTIMISED);
    let loops = |layer: &Layer| Settings { limit: Some(Nm::new(237_300)), ..settings(layer) };
    let wrong: Vec<_> = layers.filter_map(|layer| difference(&layer, &loops(&layer))).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Each layer with one of the bands: a picture of all with each takes long.
#[test]
fn every_side_has_the_boundaries_between_core_axes_that_a_picture_shows() {
    let bands = [None, Some(Nm::ZERO), Some(Nm::from_um(80))];
    let layers = real_boards::layers(FEATURES_UNOPTIMISED).zip(bands.into_iter().cycle());
    let wrong: Vec<_> = layers
        .filter_map(|(layer, min_width)| {
            let core = Settings { sites: SiteKind::Core, min_width, ..settings(&layer) };
            difference(&layer, &core).map(|wrong| (min_width, wrong))
        })
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn boundaries_are_the_same_at_any_pixel() {
    let kinds =
        [(SiteKind::Copper, None), (SiteKind::Copper, Some(Nm::from_um(200))), (SiteKind::Core, None)];
    for (layer, (sites, limit)) in real_boards::layers(FEATURES_UNOPTIMISED).zip(kinds.into_iter().cycle()) {
        let nets = topology::recover(&layer.copper, Method::Contact);
        let [fine, coarse] = [5, 100].map(|um| {
            let settings = Settings { pitch: Nm::from_um(um), sites, limit, ..Settings::default() };
            let diagram = Diagram::new(&layer.copper, &nets, layer.outline.as_ref(), &settings);
            diagram.expect("a diagram").boundaries().expect("whole boundaries")
        });
        assert_eq!(fine, coarse, "{}: pixels of 5 and 100 µm", layer.name);
    }
}
