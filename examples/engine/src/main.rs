//! Draws with the engine alone: a Voronoi diagram of cones and curtains, whose second nearest is
//! picked, a translucent picture, and the cones from the side. Writes pictures (PPM) and depths.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

use voromill::raster::blend::{Window, render_translucent};
use voromill::raster::view::{Face, Projection, View, draw};
use voromill::raster::{
    Buffers, Caps, Label, Palette, Picker, PixelPoint, Scene, Sides, Surface, mesh, render,
};

const SIZE: (u32, u32) = (480, 320);

/// How far the translucent cones and those seen from the side reach.
const REACH: f64 = 70.0;

fn main() -> io::Result<()> {
    let folder = PathBuf::from(env::args_os().nth(1).unwrap_or_else(|| "target/engine-pictures".into()));
    fs::create_dir_all(&folder)?;
    let palette = Palette::new([16, 18, 24], tints(12));

    let scene = diagram();
    let mut picture = Buffers::new();
    render(&scene, &mut picture);
    write(&folder, "diagram.ppm", &picture.rgb(&palette))?;
    let depths: Vec<u8> = picture.depths().iter().flat_map(|depth| depth.to_le_bytes()).collect();
    fs::write(folder.join("depths.f32"), depths)?;

    let picker = Picker::new(&scene);
    let place = (240, 160);
    let list: Vec<_> = picker.pick(place.0, place.1).take(5).collect();
    assert_eq!(list[0], picture.pixel(240, 160), "a pick begins with what is seen");
    let lines =
        list.iter().map(|found| format!("label {:2}, {:.3} pixels away\n", found.label.0, found.depth));
    let lines: String = lines.collect();
    fs::write(folder.join("pick.txt"), &lines)?;
    print!("at {place:?}:\n{lines}");

    let mut cones = Scene::new(SIZE.0, SIZE.1);
    for (label, apex) in (1..).map(Label).zip(points()) {
        cones.add(label, Surface::Cone { apex, offset: 0.0, limit: Some(70.0) });
    }
    let colors: Vec<[u8; 3]> = (0..=12).map(|label| palette.rgb(Label(label))).collect();
    write(&folder, "translucent.ppm", &render_translucent(&cones, &colors, Window::all(&cones)))?;

    let faces = (1..).map(Label).zip(points()).flat_map(|(label, apex)| {
        let color = palette.rgb(label);
        mesh::cone(apex, REACH, 0.5).into_iter().filter_map(move |face| Face::of(&face, color))
    });
    let view = View {
        azimuth: PI / 8.0,
        projection: Projection::Oblique { tilt: 0.5 },
        size: SIZE,
        origin: [-40.0, 160.0],
        background: [16, 18, 24],
        edges: Some([0; 3]),
    };
    write(&folder, "aside.ppm", &draw(&faces.collect::<Vec<_>>(), &view))?;
    println!("wrote {}", folder.display());
    Ok(())
}

/// Nine cones and three curtains, a label each.
fn diagram() -> Scene {
    let mut scene = Scene::new(SIZE.0, SIZE.1);
    for (label, apex) in (1..).map(Label).zip(points()) {
        scene.add(label, Surface::Cone { apex, offset: 0.0, limit: None });
    }
    let segments =
        [[(40.0, 30.5), (200.25, 60.0)], [(300.0, 290.0), (440.0, 200.0)], [(90.0, 250.0), (90.0, 300.0)]];
    for (label, [from, to]) in (10..).map(Label).zip(segments) {
        let [from, to] = [from, to].map(|(x, y)| PixelPoint::from_f64(x, y));
        let (caps, sides) = (Caps::Both, Sides::Both);
        scene.add(label, Surface::Curtain { from, to, caps, sides, offset: 2.0, limit: None });
    }
    scene
}

/// Nine points, anywhere.
fn points() -> impl Iterator<Item = PixelPoint> {
    (0..9_u8).map(|i| {
        let i = f64::from(i);
        PixelPoint::from_f64(30.0 + (i * 269.3) % 420.0, 25.0 + (i * 103.9) % 270.0)
    })
}

/// Colours well apart from each other.
fn tints(count: u8) -> Vec<[u8; 4]> {
    let tint = |i: u8| {
        [60 + i.wrapping_mul(73) % 180, 60 + i.wrapping_mul(151) % 180, 60 + i.wrapping_mul(199) % 180, 255]
    };
    (0..count).map(tint).collect()
}

/// Writes a picture as PPM.
fn write(folder: &Path, name: &str, pixels: &[[u8; 3]]) -> io::Result<()> {
    let mut bytes = format!("P6\n{} {}\n255\n", SIZE.0, SIZE.1).into_bytes();
    bytes.extend_from_slice(pixels.as_flattened());
    fs::write(folder.join(name), bytes)
}
