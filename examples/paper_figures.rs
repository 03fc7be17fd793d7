//! Figures 4, 5 and 6 of the VIsolate paper, drawn from a board of our own or the Gerber file that
//! is named: `cargo run --release --example paper_figures [FILE]` writes `figure_4.png` to
//! `figure_6.png`.

use std::path::PathBuf;

use voromill::board::{Axis, Copper, Side};
use voromill::geometry::Nm;
use voromill::grid::Grid;
use voromill::import;
use voromill::raster::view::{Face, Projection, View, draw};
use voromill::raster::{Buffers, Caps, FillRule, Label, PixelPoint, Scene, Sides, Surface, mesh, render};
use voromill::topology::{self, Method};
use voromill::voronoi::{self, Diagram, Owner, SiteKind};

type Picture = image::RgbImage;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ours = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/boards/qfn-breakout/qfn-breakout-F_Cu.gbr");
    let file = std::env::args_os().nth(1).map_or_else(|| PathBuf::from(ours), PathBuf::from);
    let board = import::load_copper(&file, Side::Front)?.board;
    let copper = board.copper(Side::Front).ok_or("no copper")?;
    let bounds = copper.bounds().ok_or("no copper")?.inflate(Nm::from_mm(1));
    let grid = Grid::covering(bounds, Nm::new(bounds.width().max(bounds.height()).get() / 900))?;
    let (layout, axes) = (copper_areas(copper, &grid), core_axes(copper, &grid));
    let black = |(_, _, pixel): (u32, u32, &mut image::Rgb<u8>)| *pixel = image::Rgb([0; 3]);

    let mut left = Picture::from_pixel(grid.width(), grid.height(), image::Rgb([255; 3]));
    left.enumerate_pixels_mut().filter(|&(x, y, _)| covered(&layout, x, y)).for_each(black);
    left.save("figure_4_left.png")?;
    for (name, limit) in [("figure_4.png", None), ("figure_6.png", Some(Nm::new(1_016_000)))] {
        let mut picture = regions(copper, &grid, limit)?;
        picture.enumerate_pixels_mut().filter(|&(x, y, _)| covered(&axes, x, y)).for_each(black);
        picture.save(name)?;
    }
    oblique().save("figure_5.png")?;
    Ok(())
}

fn covered(buffers: &Buffers, x: u32, y: u32) -> bool {
    buffers.pixel(x as usize, y as usize).label != Label::BACKGROUND
}

/// A PCB layout: Figure 4, left.
fn copper_areas(copper: &Copper, grid: &Grid) -> Buffers {
    let mut scene = Scene::new(grid.width(), grid.height());
    for polygon in copper.features.iter().filter_map(|feature| feature.shape.polygon(Nm::from_um(10))) {
        let ring = |ring: &Vec<_>| ring.iter().map(|&point| grid.pixel(point)).collect();
        let contours = polygon.contours().iter().map(ring).collect();
        scene.add(Label(1), Surface::Polygon { contours, rule: FillRule::NonZero, depth: 0.0 });
    }
    rendered(&scene)
}

/// The approximate core medial axes, a pixel or two wide.
fn core_axes(copper: &Copper, grid: &Grid) -> Buffers {
    let mut scene = Scene::new(grid.width(), grid.height());
    let limit = Some(1.3);
    for feature in &copper.features {
        let surface = match feature.axis {
            Axis::Flash(center) => Surface::Cone { apex: grid.pixel(center), offset: 0.0, limit: Some(2.5) },
            Axis::Line(from, to) => curtain(grid.pixel(from), grid.pixel(to), limit),
            Axis::Arc(arc) => curtain(grid.pixel(arc.start), grid.pixel(arc.end), limit),
            Axis::Region => continue,
        };
        scene.add(Label(1), surface);
    }
    rendered(&scene)
}

fn curtain(from: PixelPoint, to: PixelPoint, limit: Option<f32>) -> Surface {
    Surface::Curtain { from, to, caps: Caps::Both, sides: Sides::Both, offset: 0.0, limit }
}

fn rendered(scene: &Scene) -> Buffers {
    let mut buffers = Buffers::new();
    render(scene, &mut buffers);
    buffers
}

/// The Voronoi regions of the core axes, a colour each: Figure 4, right, and with a limit Figure 6.
fn regions(copper: &Copper, grid: &Grid, limit: Option<Nm>) -> Result<Picture, voronoi::Error> {
    let nets = topology::recover(copper, Method::Contact);
    let settings = voronoi::Settings { sites: SiteKind::Core, limit, ..voronoi::Settings::default() };
    let diagram = Diagram::new(copper, &nets, None, &settings)?;
    let mut picture = Picture::from_pixel(grid.width(), grid.height(), image::Rgb([255; 3]));
    diagram.regions(grid, |y, columns, owner| {
        if let Owner::Net(net) = owner {
            let shade = |k: u32| u8::try_from(100 + (net.0 + 1) * k % 150).unwrap_or(u8::MAX);
            let colour = image::Rgb([shade(67), shade(101), shade(43)]);
            columns.for_each(|x| picture.put_pixel(x, y, colour));
        }
    });
    Ok(picture)
}

/// What is drawn for a trace of two strokes, cones and roofs, seen from the side with its edges:
/// Figure 5.
fn oblique() -> Picture {
    let at = PixelPoint::from_pixels;
    let corners = [at(160, 240), at(420, 240), at(600, 120)];
    let meshes = corners.windows(2).flat_map(|pair| mesh::curtain(pair[0], pair[1], 110.0, 2.0));
    let face = |surface| match surface {
        Surface::Triangle { corners, depths } => {
            let corner =
                |i: usize| [corners[i].x.to_pixels(), corners[i].y.to_pixels(), f64::from(depths[i])];
            Some(Face { corners: [0, 1, 2].map(corner), color: [120, 170, 230] })
        }
        _ => None,
    };
    let view = View {
        projection: Projection::Oblique { tilt: 0.55 },
        size: (760, 420),
        origin: [0.0, 60.0],
        background: [255; 3],
        edges: Some([0; 3]),
    };
    let pixels = draw(&meshes.filter_map(face).collect::<Vec<_>>(), &view);
    Picture::from_fn(760, 420, |x, y| image::Rgb(pixels[(y * 760 + x) as usize]))
}
