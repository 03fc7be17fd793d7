//! Pictures for `tests/gl_parity.py`, which draws the same with an OpenGL and compares. Calling one
//! from here would take `unsafe`, which this crate forbids; so the comparison lives on the other
//! side.

use std::path::{Path, PathBuf};

use voromill::board::{Copper, Side};
use voromill::geometry::Nm;
use voromill::grid::Grid;
use voromill::import::{Selection, load};
use voromill::raster::{Buffers, FillRule, Label, PixelPoint, Scene, SubPx, Surface, mesh, render};

use crate::raster::Random;

type Primitives = Vec<(Label, Surface)>;

/// Where the pictures go; none where nobody asked for them.
#[expect(clippy::print_stderr, reason = "a test that skips says so")]
fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("VOROMILL_GL_PARITY").map(PathBuf::from);
    match &folder {
        Some(folder) => std::fs::create_dir_all(folder).expect("a folder to write to"),
        None => eprintln!("skipped: VOROMILL_GL_PARITY names no folder to write scenes to"),
    }
    folder
}

/// Writes what the engine makes of a scene, and the lines that describe it to an OpenGL.
fn write(folder: &Path, name: &str, scene: &Scene, end: &str, lines: &str) {
    let mut buffers = Buffers::new();
    render(scene, &mut buffers);
    let bytes = |words: &mut dyn Iterator<Item = u32>| words.flat_map(u32::to_le_bytes).collect::<Vec<u8>>();
    let write = |end: &str, data: &[u8]| {
        std::fs::write(folder.join(format!("{name}.{end}")), data).expect("writable");
    };
    write(end, lines.as_bytes());
    write("labels", &bytes(&mut buffers.labels().iter().copied()));
    write("depths", &bytes(&mut buffers.depths().iter().map(|depth| depth.to_bits())));
}

#[test]
fn an_opengl_gets_the_same_triangles_to_draw() {
    let Some(folder) = folder() else { return };
    for number in 0..240 {
        let mut random = Random(number);
        let (kind, primitives, triangles) =
            if number < 200 { flat_scene(&mut random) } else { mesh_scene(&mut random) };
        let mut scene = Scene::new(128, 128);
        primitives.into_iter().for_each(|(label, surface)| scene.add(label, surface));
        let line = |(label, corners, depths): &(Label, [PixelPoint; 3], [f32; 3])| {
            let corners = corners.iter().map(|p| format!(" {} {}", p.x.raw(), p.y.raw())).collect::<String>();
            format!("{}{corners} {:?} {:?} {:?}\n", label.0, depths[0], depths[1], depths[2])
        };
        let lines: String = triangles.iter().map(line).collect();
        write(&folder, &format!("{kind}_{number:03}"), &scene, "triangles", &lines);
    }
}

/// Every feature of the boards is a polygon under a label of its own, all at one depth.
#[test]
fn an_opengl_gets_the_same_boards_to_draw() {
    let Some(folder) = folder() else { return };
    let boards = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards");
    for entry in std::fs::read_dir(boards).expect("the fixtures are there") {
        let path = entry.expect("an entry").path();
        if !path.is_dir() {
            continue;
        }
        let board = load(std::slice::from_ref(&path), &Selection::default()).expect("a good board").board;
        for side in [Side::Front, Side::Back] {
            if let Some(copper) = board.copper(side) {
                let (scene, lines) = board_scene(copper);
                write(&folder, &format!("board_{}_{side}", board.name), &scene, "polygons", &lines);
            }
        }
    }
}

/// The features of a side about 1000 pixels wide; a line `label` or `also` and x, y of all corners
/// for each contour.
fn board_scene(copper: &Copper) -> (Scene, String) {
    let bounds = copper.bounds().expect("some copper");
    let widest = bounds.width().max(bounds.height()).get();
    let grid = Grid::covering(bounds, Nm::new(widest / 1000)).expect("a picture of a thousand pixels");
    let mut scene = Scene::new(grid.width(), grid.height());
    let mut lines = format!("{} {}\n", grid.width(), grid.height());
    for (label, feature) in (1..).zip(&copper.features) {
        let Some(polygon) = feature.shape.polygon(Nm::from_um(10)) else { continue };
        let ring = |ring: &Vec<_>| ring.iter().map(|&point| grid.pixel(point)).collect::<Vec<_>>();
        let contours: Vec<_> = polygon.contours().iter().map(ring).collect();
        for (number, contour) in contours.iter().enumerate() {
            let corners: String = contour.iter().map(|p| format!(" {} {}", p.x.raw(), p.y.raw())).collect();
            let first = if number == 0 { label.to_string() } else { "also".to_owned() };
            lines += &format!("{first}{corners}\n");
        }
        scene.add(Label(label), Surface::Polygon { contours, rule: FillRule::NonZero, depth: 0.0 });
    }
    (scene, lines)
}

type Triangles = Vec<(Label, [PixelPoint; 3], [f32; 3])>;

/// Flat triangles and convex polygons, the latter for an OpenGL as fans, each at a depth of its
/// own.
fn flat_scene(random: &mut Random) -> (&'static str, Primitives, Triangles) {
    let (mut primitives, mut triangles) = (Primitives::new(), Triangles::new());
    // Half of the points on samples and corners of pixels, where the fill rule decides.
    let coordinate = |random: &mut Random| match random.below(2) {
        0 => SubPx::new(random.below(140 * 2) * 128 - 6 * 256),
        _ => SubPx::new(random.below(140 * 256) - 6 * 256),
    };
    for number in 1..=30 {
        let label = Label(number);
        let depth = f32::from(u8::try_from((number * 37) % 61).expect("small"));
        if number % 3 == 0 {
            let (x, y) = (coordinate(random), coordinate(random));
            let radius = 1024 + random.below(8000);
            // The corners of a diamond, a square or an octagon: convex, and many of their edges are
            // axis-parallel.
            let k = radius * 5 / 12;
            let ring = [
                (radius, k),
                (k, radius),
                (-k, radius),
                (-radius, k),
                (-radius, -k),
                (-k, -radius),
                (k, -radius),
                (radius, -k),
            ];
            let step = [1, 2][usize::try_from(random.below(2)).expect("small")];
            let ring: Vec<_> = ring
                .into_iter()
                .step_by(step)
                .map(|(dx, dy)| PixelPoint::new(SubPx::new(x.raw() + dx), SubPx::new(y.raw() + dy)))
                .collect();
            for pair in ring[1..].windows(2) {
                triangles.push((label, [ring[0], pair[0], pair[1]], [depth; 3]));
            }
            primitives
                .push((label, Surface::Polygon { contours: vec![ring], rule: FillRule::NonZero, depth }));
        } else {
            let corners = [(); 3].map(|()| PixelPoint::new(coordinate(random), coordinate(random)));
            primitives.push((label, Surface::Triangle { corners, depths: [depth; 3] }));
            triangles.push((label, corners, [depth; 3]));
        }
    }
    ("flat", primitives, triangles)
}

/// Tessellated cones and curtains.
fn mesh_scene(random: &mut Random) -> (&'static str, Primitives, Triangles) {
    let mut primitives = Primitives::new();
    for label in (1..=20).map(Label) {
        let mut point =
            || PixelPoint::new(SubPx::new(random.below(128 * 256)), SubPx::new(random.below(128 * 256)));
        let (from, to) = (point(), point());
        let faces =
            if label.0 % 2 == 0 { mesh::cone(from, 60.0, 0.1) } else { mesh::curtain(from, to, 60.0, 0.1) };
        primitives.extend(faces.into_iter().map(|face| (label, face)));
    }
    let triangle = |(label, surface): &(Label, Surface)| match surface {
        Surface::Triangle { corners, depths } => Some((*label, *corners, *depths)),
        _ => None,
    };
    let triangles = primitives.iter().filter_map(triangle).collect();
    ("mesh", primitives, triangles)
}
