//! The raster engine against brute force, and its law: nothing but the scene decides a bit of the
//! picture.

use proptest::prelude::*;
use voromill::raster::blend::{Window, mix, render_overdraw, render_translucent};
use voromill::raster::view::{Face, Projection, View, draw};
use voromill::raster::{
    Buffers, Caps, FillRule, Label, Options, Picker, PixelPoint, Scene, Sides, Spin, SubPx, Surface,
    TileContent, mesh, render, stream,
};

use crate::oracle::raster::claims;
use crate::random::splitmix64;

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
                    TileContent::Uniform(label) => beyond || wanted.0 == label.0,
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

/// Fragments as (depth bits, label).
fn picked(picker: &Picker<'_>, column: u32, row: u32) -> Vec<(u32, u32)> {
    picker.pick(column, row).map(|fragment| (fragment.depth.to_bits(), fragment.label.0)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_pick_lists_every_fragment_nearest_first(primitives in primitives()) {
        let scene = scene(&primitives);
        let picker = Picker::new(&scene);
        let dense = picture(&primitives);
        let single: Vec<_> = primitives.iter().map(|one| picture(std::slice::from_ref(one))).collect();
        for (column, row) in (0..SIZE.1).step_by(7).flat_map(|row| (0..SIZE.0).step_by(5).map(move |c| (c, row))) {
            let mut all: Vec<_> = single
                .iter()
                .map(|picture| picture.pixel(column as usize, row as usize))
                .filter(|fragment| fragment.label != Label::BACKGROUND)
                .collect();
            all.sort_by(|a, b| a.depth.total_cmp(&b.depth).then(a.label.cmp(&b.label)));
            let bits: Vec<_> = all.iter().map(|f| (f.depth.to_bits(), f.label.0)).collect();
            prop_assert_eq!(&picked(&picker, column, row), &bits, "at {}, {}", column, row);
            let seen = dense.pixel(column as usize, row as usize);
            prop_assert_eq!(all.first().map_or(Label::BACKGROUND, |first| first.label), seen.label);
        }
    }

    #[test]
    fn blended_pixels_are_made_of_their_picks(primitives in primitives()) {
        let scene = scene(&primitives);
        let picker = Picker::new(&scene);
        let colors: Vec<[u8; 3]> = (0..20_u8).map(|i| [i * 13, 255 - i * 12, i * 7 + 90]).collect();
        let window = Window { column: 13, row: 5, width: 130, height: 90 };
        let (mixed, counted) = (render_translucent(&scene, &colors, window), render_overdraw(&scene, window));
        let pixels = (5..95).flat_map(|row| (13..143).map(move |column| (column, row)));
        for ((column, row), (color, count)) in pixels.zip(mixed.into_iter().zip(counted)) {
            let labels: Vec<_> = picker.pick(column, row).map(|fragment| fragment.label.0 as usize).collect();
            let mut distinct = Vec::new();
            for &label in &labels {
                if !distinct.contains(&label) {
                    distinct.push(label);
                }
            }
            prop_assert_eq!(mix(distinct.into_iter().map(|label| colors[label])), color);
            prop_assert_eq!(labels.len(), count as usize);
        }
    }
}

#[test]
fn no_mixed_component_is_likelier_than_one_in_128() {
    // Lemma 3 of the paper, by running through every value of every layer: the sums of k layers and
    // how many of the 256^k choices give them, a layer at a time.
    let share = |component: u8, layer: u32| {
        let black = std::iter::repeat_n([0; 3], layer as usize - 1);
        usize::from(mix(black.chain([[component; 3]]))[0])
    };
    let mut ways = vec![1.0_f64];
    for layer in 1..=7 {
        let mut next = vec![0.0; ways.len() + 128];
        for (sum, count) in ways.iter().enumerate() {
            for component in 0..=255 {
                next[sum + share(component, layer)] += count / 256.0;
            }
        }
        ways = next;
        let likeliest = ways.iter().copied().fold(0.0, f64::max);
        assert!(likeliest <= 1.0 / 128.0, "{layer} layers: {likeliest}");
        assert!(ways.iter().skip(256).all(|&p| p <= 0.0), "a component of {layer} layers is a byte");
    }
    // And two layers without the shortcut, through the whole function.
    let mut counts = [0_u32; 256];
    for (a, b) in (0..=255).flat_map(|a| (0..=255).map(move |b| (a, b))) {
        counts[usize::from(mix([[a; 3], [b; 3]])[1])] += 1;
    }
    assert!(counts.iter().all(|&count| count <= 65536 / 128), "at most 512 of 65 536 pairs: {counts:?}");
}

#[test]
fn the_golden_scenes_have_the_recorded_bits() {
    use sha2::{Digest, Sha256};
    use std::fmt::Write;

    let mut text = String::new();
    for (name, primitives) in golden() {
        let buffers = picture(&primitives);
        let mut hash = Sha256::new();
        buffers.labels().iter().for_each(|label| hash.update(label.to_le_bytes()));
        buffers.depths().iter().for_each(|depth| hash.update(depth.to_bits().to_le_bytes()));
        let hex = hash.finalize().iter().fold(String::new(), |hex, byte| format!("{hex}{byte:02x}"));
        writeln!(text, "{name:12} {hex}").expect("a string");
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots/raster");
    insta::with_settings!({snapshot_path => path, prepend_module_to_snapshot => false, omit_expression => true}, {
        insta::assert_snapshot!("golden", text);
    });
}

/// SplitMix64 on whole numbers below a limit: the same scenes everywhere, whatever the test library
/// draws.
pub(crate) struct Random(pub u64);

impl Random {
    pub(crate) fn below(&mut self, limit: i32) -> i32 {
        let high = splitmix64(&mut self.0) >> 32;
        i32::try_from((high * u64::from(limit.unsigned_abs())) >> 32).expect("below the limit")
    }

    fn point(&mut self) -> PixelPoint {
        PixelPoint::new(SubPx::new(self.below(40_000) - 1000), SubPx::new(self.below(30_000) - 1000))
    }

    fn length(&mut self) -> f32 {
        f32::from(i16::try_from(self.below(5000)).expect("small")) / 256.0
    }
}

/// Scenes that between them use every kind of surface.
fn golden() -> Vec<(&'static str, Primitives)> {
    let mut random = Random(20);
    let mut scene = |count: u32, mut surface: Box<dyn FnMut(&mut Random) -> Surface>| -> Primitives {
        (1..=count).map(|label| (Label(label), surface(&mut random))).collect()
    };
    let limit = |random: &mut Random| (random.below(3) == 0).then(|| 5.0 + random.length());
    let caps = |random: &mut Random| {
        [Caps::None, Caps::Start, Caps::End, Caps::Both][usize::try_from(random.below(4)).expect("small")]
    };
    let sides = |random: &mut Random| {
        [Sides::Both, Sides::Left, Sides::Right][usize::try_from(random.below(3)).expect("small")]
    };
    let cones = scene(
        60,
        Box::new(move |r| Surface::Cone { apex: r.point(), offset: r.length() / 4.0, limit: limit(r) }),
    );
    let curtains = scene(
        60,
        Box::new(move |r| Surface::Curtain {
            from: r.point(),
            to: r.point(),
            caps: caps(r),
            sides: sides(r),
            offset: r.length() / 8.0,
            limit: limit(r),
        }),
    );
    let rings = scene(
        30,
        Box::new(move |r| Surface::Ring {
            center: r.point(),
            start: r.point(),
            end: r.point(),
            spin: if r.below(2) == 0 { Spin::Clockwise } else { Spin::CounterClockwise },
            caps: caps(r),
            offset: r.length() / 8.0,
            limit: limit(r),
        }),
    );
    let polygons = scene(
        20,
        Box::new(|r| {
            let contours = (0..1 + r.below(3)).map(|_| (0..3 + r.below(6)).map(|_| r.point()).collect());
            let contours = contours.collect();
            let rule = if r.below(2) == 0 { FillRule::NonZero } else { FillRule::EvenOdd };
            Surface::Polygon { contours, rule, depth: r.length() }
        }),
    );
    let triangles = scene(
        80,
        Box::new(|r| Surface::Triangle {
            corners: [r.point(), r.point(), r.point()],
            depths: [r.length(), r.length(), r.length()],
        }),
    );
    let all = [&cones, &curtains, &rings, &polygons, &triangles];
    let mixed = all.iter().flat_map(|scene| scene.iter().cloned().step_by(3)).collect();
    vec![
        ("cones", cones),
        ("curtains", curtains),
        ("rings", rings),
        ("polygons", polygons),
        ("triangles", triangles),
        ("mixed", mixed),
    ]
}

#[test]
fn a_mesh_is_no_farther_from_its_surface_than_was_asked_for() {
    let (apex, other) = (PixelPoint::from_pixels(40, 50), PixelPoint::from_pixels(90, 30));
    let circle = PixelPoint::from_pixels(70, 50);
    let start = PixelPoint::from_pixels(100, 50);
    let (offset, limit, caps) = (0.0, Some(25.0), Caps::Both);
    let pairs = [
        (mesh::cone(apex, 30.0, 0.1), Surface::Cone { apex, offset, limit }),
        (
            mesh::curtain(apex, other, 30.0, 0.1),
            Surface::Curtain { from: apex, to: other, caps, sides: Sides::Both, offset, limit },
        ),
        (
            mesh::ring(circle, 30.0, 30.0, 0.1),
            Surface::Ring { center: circle, start, end: start, spin: Spin::Clockwise, caps, offset, limit },
        ),
    ];
    for (mesh, surface) in pairs {
        let tessellated = picture(&mesh.into_iter().map(|face| (Label(1), face)).collect::<Vec<_>>());
        let analytic = picture(&[(Label(1), surface)]);
        for (mesh, exact) in tessellated.depths().iter().zip(analytic.depths()).filter(|(_, d)| d.is_finite())
        {
            // A quarter of a hundredth more for corners rounded to 1/256 pixel.
            assert!((mesh - exact).abs() <= 0.11, "{mesh} against {exact}");
        }
    }
}

#[test]
fn a_view_shows_faces_and_edges() {
    let face = |z: f64, color| Face { corners: [[1.0, 1.0, z], [15.0, 1.0, z], [1.0, 7.0, z]], color };
    let far_away =
        Face { corners: [[0.0, 0.0, 9.0], [16.0, 0.0, 9.0], [16.0, 8.0, 9.0]], color: [0, 0, 255] };
    let view = View {
        azimuth: 0.0,
        projection: Projection::Above,
        size: (16, 8),
        origin: [0.0, 0.0],
        background: [255; 3],
        edges: Some([0; 3]),
    };
    let pixels = draw(&[far_away, face(0.0, [255, 0, 0])], &view);
    let letters: Vec<String> = pixels
        .chunks(16)
        .map(|row| {
            row.iter()
                .map(|pixel| match pixel {
                    [255, 255, 255] => '.',
                    [0, 0, 0] => '#',
                    [_, 0, 0] => 'r',
                    _ => 'b',
                })
                .collect()
        })
        .collect();
    insta::with_settings!({snapshot_path => concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots/raster"),
        prepend_module_to_snapshot => false, omit_expression => true}, {
        insta::assert_snapshot!("view", letters.join("\n"));
    });
    let tilted = View { projection: Projection::Oblique { tilt: 0.5 }, ..view };
    let near = View {
        projection: Projection::Perspective { tilt: 1.0, distance: 50.0, center: [8.0, 4.0] },
        ..view
    };
    for view in [tilted, near] {
        assert_ne!(draw(&[far_away, face(0.0, [255, 0, 0])], &view), pixels, "{view:?} is another picture");
    }
}
