//! The raster engine against brute force, and its law: nothing but the scene decides a bit of the picture.

use proptest::prelude::*;
use voromill::raster::{
    Buffers, Caps, FillRule, Label, Options, PixelPoint, Scene, Sides, Spin, SubPx, Surface, TileContent,
    render, stream,
};

use crate::oracle::raster::claims;

type Primitives = Vec<(Label, Surface)>;

/// A picture that no tile size divides.
const SIZE: (u32, u32) = (147, 101);

fn point() -> impl Strategy<Value = PixelPoint> {
    // Some on samples and pixel corners, where fill rules decide; some beyond the picture.
    let coordinate = prop_oneof![
        -10_000..50_000_i32,
        (-20..160_i32).prop_map(|p| p * 256 + 128),
        (-20..160_i32).prop_map(|p| p * 256)
    ];
    (coordinate.clone(), coordinate).prop_map(|(x, y)| PixelPoint::new(SubPx::new(x), SubPx::new(y)))
}

fn caps() -> impl Strategy<Value = Caps> {
    prop_oneof![Just(Caps::Both), Just(Caps::None), Just(Caps::Start), Just(Caps::End)]
}

fn distances() -> impl Strategy<Value = (f32, Option<f32>)> {
    (prop_oneof![Just(0.0_f32), 0.0..20.0_f32], prop::option::of(0.5..60.0_f32))
}

fn flat() -> impl Strategy<Value = Surface> {
    let ring = prop::collection::vec(point(), 3..9);
    let rule = prop_oneof![Just(FillRule::NonZero), Just(FillRule::EvenOdd)];
    let depth = prop_oneof![Just(0.0_f32), Just(-1.0), 0.0..30.0_f32];
    prop_oneof![
        (prop::collection::vec(ring, 1..4), rule, depth)
            .prop_map(|(contours, rule, depth)| Surface::Polygon { contours, rule, depth }),
        (prop::array::uniform3(point()), prop::array::uniform3(0.0..40.0_f32))
            .prop_map(|(corners, depths)| Surface::Triangle { corners, depths }),
    ]
}

fn surface() -> impl Strategy<Value = Surface> {
    let sides = prop_oneof![Just(Sides::Both), Just(Sides::Left), Just(Sides::Right)];
    let spin = prop_oneof![Just(Spin::Clockwise), Just(Spin::CounterClockwise)];
    prop_oneof![
        1 => flat(),
        2 => (point(), distances())
            .prop_map(|(apex, (offset, limit))| Surface::Cone { apex, offset, limit }),
        4 => (point(), point(), caps(), sides, distances()).prop_map(|(from, to, caps, sides, (offset, limit))| {
            Surface::Curtain { from, to, caps, sides, offset, limit }
        }),
        2 => (prop::array::uniform3(point()), prop::bool::ANY, spin, caps(), distances())
            .prop_map(|([center, start, end], closed, spin, caps, (offset, limit))| {
                let end = if closed { start } else { end };
                Surface::Ring { center, start, end, spin, caps, offset, limit }
            }),
    ]
}

fn primitives() -> impl Strategy<Value = Primitives> {
    prop::collection::vec(((1..20_u32).prop_map(Label), surface()), 0..40)
}

fn scene(primitives: &[(Label, Surface)]) -> Scene {
    let mut scene = Scene::new(SIZE.0, SIZE.1);
    for (label, surface) in primitives {
        scene.add(*label, surface.clone());
    }
    scene
}

fn picture(primitives: &[(Label, Surface)]) -> Buffers {
    let mut buffers = Buffers::new();
    render(&scene(primitives), &mut buffers);
    buffers
}

/// Labels and the bits of depths.
fn bits(buffers: &Buffers) -> (Vec<u32>, Vec<u32>) {
    (buffers.labels().to_vec(), buffers.depths().iter().map(|depth| depth.to_bits()).collect())
}

/// Checks one pixel of the picture against all claims on it; says what is wrong.
fn judge(primitives: &[(Label, Surface)], buffers: &Buffers, column: u32, row: u32) -> Result<(), String> {
    let claims = claims(primitives, column.cast_signed(), row.cast_signed());
    let pixel = buffers.pixel(column as usize, row as usize);
    let depth = f64::from(pixel.depth);
    let sure = claims.iter().filter(|claim| claim.depth + claim.tolerance <= claim.limit);
    let nearest = sure.map(|claim| claim.depth + claim.tolerance).fold(f64::INFINITY, f64::min);
    if depth > nearest {
        return Err(format!("({column}, {row}) is {pixel:?} but something lies at {nearest}"));
    }
    if pixel.label == Label::BACKGROUND {
        return Ok(());
    }
    let backed = claims.iter().any(|claim| {
        claim.label == pixel.label
            && (claim.depth - depth).abs() <= claim.tolerance
            && claim.depth - claim.tolerance <= claim.limit
    });
    if backed {
        Ok(())
    } else {
        Err(format!("({column}, {row}) is {pixel:?}, which no claim backs: {claims:?}"))
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_pixel_is_the_nearest_claim(primitives in primitives()) {
        let buffers = picture(&primitives);
        for row in 0..SIZE.1 {
            for column in 0..SIZE.0 {
                judge(&primitives, &buffers, column, row).map_err(TestCaseError::fail)?;
            }
        }
    }

    #[test]
    fn the_order_of_the_scene_does_not_matter(
        (ordered, shuffled) in primitives().prop_flat_map(|all| (Just(all.clone()), Just(all).prop_shuffle())),
    ) {
        prop_assert_eq!(bits(&picture(&ordered)), bits(&picture(&shuffled)));
    }

    #[test]
    fn streamed_tiles_are_the_dense_picture(
        primitives in primitives(),
        tile in 8..=256_u32,
        apron in 0..=4_u32,
        threads in 1..=8_usize,
    ) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let options = Options { tile, apron, ..Options::default() };
        let dense = picture(&primitives);
        pool.install(|| streamed_equals(&scene(&primitives), &options, &dense)).map_err(TestCaseError::fail)?;
    }
}

/// Streams and compares every pixel of every tile, apron included, with the dense picture.
fn streamed_equals(scene: &Scene, options: &Options, dense: &Buffers) -> Result<(), String> {
    let apron = options.apron.cast_signed();
    let expected = |x: i32, y: i32| {
        let inside = (0..SIZE.0.cast_signed()).contains(&x) && (0..SIZE.1.cast_signed()).contains(&y);
        let pixel = inside.then(|| dense.pixel(x.cast_unsigned() as usize, y.cast_unsigned() as usize));
        pixel.map_or((0, f32::INFINITY.to_bits()), |pixel| (pixel.label.0, pixel.depth.to_bits()))
    };
    let mut places = Vec::new();
    let work = |tile: voromill::raster::Tile<'_>| {
        let (x0, y0) = (tile.column0.cast_signed(), tile.row0.cast_signed());
        for y in -apron..tile.height.cast_signed() + apron {
            for x in -apron..tile.width.cast_signed() + apron {
                let wanted = expected(x0 + x, y0 + y);
                let beyond = x0 + x < 0
                    || y0 + y < 0
                    || x0 + x >= SIZE.0.cast_signed()
                    || y0 + y >= SIZE.1.cast_signed();
                let same = match tile.content {
                    TileContent::Uniform(owner) => beyond || wanted.0 == owner,
                    TileContent::Pixels(pixels) => {
                        (pixels.label(x, y).0, pixels.depth(x, y).to_bits()) == wanted
                    }
                };
                if !same {
                    return Err(format!("({}, {}) differs from {wanted:?}", x0 + x, y0 + y));
                }
            }
        }
        Ok((tile.row0, tile.column0))
    };
    let mut failure = Ok(());
    stream(scene, options, work, |place| match place {
        Ok(place) => places.push(place),
        Err(text) => failure = Err(text),
    });
    failure?;
    let tile = options.tile as usize;
    let rows = (0..SIZE.1).step_by(tile);
    let all: Vec<_> =
        rows.flat_map(|row| (0..SIZE.0).step_by(tile).map(move |column| (row, column))).collect();
    if places == all { Ok(()) } else { Err(format!("tiles came as {places:?}")) }
}
