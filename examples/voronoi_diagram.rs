//! The Voronoi diagram of points, segments and a circle, drawn with the raster engine alone:
//! `cargo run --release --example voronoi_diagram` writes `voronoi_diagram.png`.

use voromill::raster::{Buffers, Caps, Label, PixelPoint, Scene, Sides, Spin, Surface, render};

const SIDE: i32 = 800;

fn main() -> Result<(), image::ImageError> {
    let mut scene = Scene::new(SIDE.unsigned_abs(), SIDE.unsigned_abs());
    let at = PixelPoint::from_pixels;
    let place = |i: i32| ((i * 367 + 61) % SIDE, (i * 523 + 97) % SIDE);
    for i in 0..40 {
        let (x, y) = place(i);
        let label = Label(1 + i.unsigned_abs());
        let (offset, limit) = (0.0, None);
        scene.add(
            label,
            match i % 3 {
                0 => Surface::Cone { apex: at(x, y), offset, limit },
                _ => Surface::Curtain {
                    from: at(x, y),
                    to: at((x + 90 - i * 4).clamp(0, SIDE), (y + 60).min(SIDE)),
                    caps: Caps::Both,
                    sides: Sides::Both,
                    offset,
                    limit,
                },
            },
        );
    }
    let (center, start) = (at(430, 380), at(530, 380));
    let (spin, caps) = (Spin::Clockwise, Caps::Both);
    scene.add(Label(41), Surface::Ring { center, start, end: start, spin, caps, offset: 0.0, limit: None });

    let mut diagram = Buffers::new();
    render(&scene, &mut diagram);
    let side = SIDE.unsigned_abs();
    let picture = image::RgbImage::from_fn(side, side, |column, row| {
        let pixel = diagram.pixel(column as usize, row as usize);
        // A colour for each label, dark on the site itself, with a contour every 20 pixels of
        // distance.
        let shade = if pixel.depth < 2.0 {
            0
        } else if pixel.depth % 20.0 < 1.0 {
            2
        } else {
            3
        };
        let hue = |k: u32| u8::try_from((pixel.label.0 * k % 128 + 127) * shade / 3).unwrap_or(u8::MAX);
        image::Rgb([hue(47), hue(101), hue(71)])
    });
    picture.save("voronoi_diagram.png")
}
