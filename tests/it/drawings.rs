//! SVG and DXF drawings: what is read of them, against figures that others established.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use voromill::artwork::Figure;
use voromill::board::{Board, Shape, Side};
use voromill::geometry::{Nm, Polygon};
use voromill::import::drawing::{self, Drawing, Options, Unit};
use voromill::import::{Loaded, Selection, load, svg};
use voromill::job::{self, Options as JobOptions, Settings};

use crate::corpus;

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/drawings").join(name)
}

/// Drawings of others.
fn gathered(kind: &str) -> Option<PathBuf> {
    corpus::artwork().map(|root| root.join(kind))
}

fn in_millimetres() -> Options {
    Options { unit: Some(Unit::MILLIMETRE), ..Options::default() }
}

fn read(path: &Path, options: &Options) -> Result<Drawing, String> {
    let bytes = std::fs::read(path).expect("readable");
    let name = path.file_name().expect("a name").to_string_lossy();
    drawing::read(&name, &bytes, options).map_err(|error| error.to_string())
}

/// The area in mm² that a layer covers, or all of them.
fn area(drawing: &Drawing, layer: Option<&str>) -> f64 {
    let tolerance = Nm::new(100);
    let polygons = match layer {
        None => drawing.artwork.polygons(tolerance),
        Some(name) => drawing.artwork.layer(name).expect(name).polygons(tolerance),
    };
    polygons.expect("little work").iter().map(Polygon::area_mm2).sum()
}

fn codes(loaded: &Loaded) -> Vec<&str> {
    loaded.warnings.iter().map(|warning| warning.code()).collect()
}

fn board(path: &str) -> Loaded {
    load(&[fixture(path)], &Selection::default()).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The pad, track and ring of the front as islands.
fn islands(board: &Board) -> usize {
    let copper = board.front.as_ref().expect("copper");
    let polygon = |shape: &Shape| shape.polygon(Nm::from_um(1));
    let polygons: Vec<Polygon> =
        copper.features.iter().filter_map(|feature| polygon(&feature.shape)).collect();
    voromill::board::polarity::union(&polygons).len()
}

#[test]
fn strokes_cover_what_their_ends_and_corners_ask_for() {
    let drawing = read(&fixture("strokes.svg"), &Options::default()).expect("read");
    let quarter = std::f64::consts::FRAC_PI_4;
    let ellipse = |width: f64| std::f64::consts::PI * (2.0 + width) * (2.0 + width) * 3.0;
    for (layer, expected) in [
        ("butt", 20.0),
        ("square", 21.0),
        ("round", 20.0 + quarter),
        ("mitre", 20.0),
        ("dashed", 12.0),
        ("ring", 10.0 * std::f64::consts::PI),
        ("stretched", ellipse(0.5) - ellipse(-0.5)),
    ] {
        let area = area(&drawing, Some(layer));
        // A circle of cubic curves, before it is stretched, is itself off by that.
        let most = if layer == "stretched" { 2e-4 } else { 1e-4 };
        assert!((area / expected - 1.0).abs() < most, "{layer}: {area} mm², expected {expected}");
    }
}

#[test]
fn a_drawing_without_a_unit_asks_and_white_erases() {
    let error = read(&fixture("no_unit.svg"), &Options::default()).expect_err("no unit");
    assert!(error.contains("--unit mm"), "{error}");
    let drawing = read(&fixture("no_unit.svg"), &in_millimetres()).expect("told");
    let expected = 100.0 - 4.0 * std::f64::consts::PI;
    assert!((area(&drawing, None) - expected).abs() < 0.01, "{} mm²", area(&drawing, None));
    let bounds = drawing.artwork.bounds().expect("figures");
    assert_eq!(bounds.min().y, Nm::from_mm(5), "the page's lower edge is zero: {bounds:?}");
}

/// A drawing of 40 by 40 mm.
fn drawn(inner: &str) -> Drawing {
    try_drawn(inner).unwrap_or_else(|e| panic!("{inner}: {e}"))
}

fn try_drawn(inner: &str) -> Result<Drawing, voromill::import::Error> {
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' height='40mm' viewBox='0 0 40 40'>{inner}</svg>"
    );
    drawing::read("x.svg", text.as_bytes(), &Options::default())
}

#[test]
fn a_line_that_lies_in_a_gap_of_its_dashes_is_not_there() {
    let line = |dashes: &str| {
        format!("<path d='M5 5h2' stroke='#000' stroke-width='1' {dashes}/><rect width='3' height='2'/>")
    };
    let gap = drawn(&line("stroke-dasharray='4' stroke-dashoffset='5'"));
    assert!((area(&gap, None) - 6.0).abs() < 1e-3, "the rectangle alone: {} mm²", area(&gap, None));
    let error = try_drawn(&line("stroke-dasharray='0.000001'")).expect_err("too many");
    assert!(error.to_string().contains("a million dashes"), "{error}");
}

#[test]
fn clipping_paths_show_what_lies_in_them() {
    let plain = "<clipPath id='c'><rect x='2' y='2' width='10' height='10'/></clipPath>";
    let ring = "<clipPath id='c'><path clip-rule='evenodd' d='M0 0H10V10H0Z M2 2H8V8H2Z'/></clipPath>";
    let linked = "<clipPath id='b'><rect width='6' height='40'/></clipPath>\
        <clipPath id='c' clip-path='url(#b)'><rect x='2' y='2' width='10' height='10'/></clipPath>";
    let moved = "<clipPath id='c' transform='translate(10 0)'><rect width='5' height='5'/></clipPath>";
    let boxed =
        "<clipPath id='c' clipPathUnits='objectBoundingBox'><rect width='.5' height='.25'/></clipPath>";
    let square = "<rect width='20' height='20' clip-path='url(#c)'/>";
    let group =
        "<g transform='translate(10 10) scale(2)' clip-path='url(#c)'><rect width='20' height='20'/></g>";
    for (clip, shape, expected) in [
        (plain, square, 100.0),
        (ring, square, 64.0),
        (linked, square, 40.0),
        (moved, square, 25.0),
        (boxed, square, 50.0),
        (plain, group, 400.0),
        (plain, "<path d='M0 4H20' stroke='#000' stroke-width='2' clip-path='url(#c)'/>", 20.0),
        (
            plain,
            "<g clip-path='url(#c)'><rect width='20' height='20'/><rect width='7' height='7' fill='#fff'/></g>",
            75.0,
        ),
    ] {
        let drawing = drawn(&format!("<defs>{clip}</defs>{shape}"));
        let area = area(&drawing, None);
        assert!((area - expected).abs() < 0.001, "{clip} {shape}: {area} mm², expected {expected}");
        let told: Vec<&str> = drawing.warnings.iter().map(|warning| warning.code()).collect();
        assert!(!told.contains(&"svg-effects"), "{clip}: {told:?}");
    }
}

/// Of groups with one clipping path, as programs write a page of them, its shapes are worked out
/// once.
#[test]
fn many_groups_share_a_clipping_path_of_many_shapes() {
    let shapes = |shape: &dyn Fn(i32, i32) -> String| -> String {
        (0..400).map(|i| shape(i % 20 * 2, i / 20 * 2)).collect()
    };
    let circles = shapes(&|x, y| format!("<circle cx='{}' cy='{}' r='1'/>", x + 1, y + 1));
    let square = |x, y| format!("<g clip-path='url(#c)'><rect x='{x}' y='{y}' width='2' height='2'/></g>");
    let drawing = drawn(&format!("<defs><clipPath id='c'>{circles}</clipPath></defs>{}", shapes(&square)));
    let (area, expected) = (area(&drawing, None), 400.0 * std::f64::consts::PI);
    // Circles are chords within a quarter of a micrometre.
    assert!((area - expected).abs() < 0.5, "{area} mm², expected {expected}");
}

#[test]
fn what_lies_inside_a_clipping_path_stays_as_it_is() {
    let clip = "<clipPath id='c'><rect width='40' height='40'/></clipPath>";
    let whole =
        drawn(&format!("{clip}<g id='Drill' clip-path='url(#c)'><circle cx='20' cy='20' r='1'/></g>"));
    let bare = drawn("<g id='Drill'><circle cx='20' cy='20' r='1'/></g>");
    assert_eq!(whole.artwork, bare.artwork, "a circle of arcs, on its layer");
    let away = drawn(
        "<clipPath id='c'><rect width='4' height='4'/></clipPath><rect width='9' height='9'/>\
         <circle cx='20' cy='20' r='1' clip-path='url(#c)'/>",
    );
    let told = format!("{:?}", away.warnings);
    assert!(told.contains("1 shape that is clipped or masked away"), "nothing disappears: {told}");
}

#[test]
fn masks_show_what_lies_under_white_and_hide_what_lies_under_black() {
    let mask = |inner: &str| {
        format!("<mask id='m' maskUnits='userSpaceOnUse' x='0' y='0' width='30' height='10'>{inner}</mask>")
    };
    let white = "<rect width='40' height='40' fill='#fff'/>";
    let alpha = "<mask id='m' style='mask-type:alpha' maskUnits='userSpaceOnUse' width='40' height='40'>\
        <rect width='5' height='5'/></mask>";
    for (mask, expected) in [
        (mask(white), 200.0),
        (
            mask(&format!("{white}<circle cx='5' cy='5' r='2' fill='#000'/>")),
            200.0 - 4.0 * std::f64::consts::PI,
        ),
        (mask("<rect width='4' height='5' fill='white'/><rect width='40' height='1'/>"), 16.0),
        (alpha.to_owned(), 25.0),
    ] {
        let drawing = drawn(&format!("{mask}<rect width='20' height='20' mask='url(#m)'/>"));
        let area = area(&drawing, None);
        assert!((area / expected - 1.0).abs() < 1e-4, "{mask}: {area} mm², expected {expected}");
    }
    let grey = mask("<rect width='4' height='5' fill='#888'/>");
    let drawing = drawn(&format!("{grey}<rect width='20' height='20' mask='url(#m)'/>"));
    assert!((area(&drawing, None) - 400.0).abs() < 0.001, "a mask with greys is no area");
    let told = format!("{:?}", drawing.warnings);
    assert!(told.contains("1 masks that are not black and white"), "and that is said: {told}");
}

#[test]
fn references_that_multiply_or_go_deep_are_refused() {
    let chain = |kind: &str, attribute: &str, count: u32, times: usize| {
        let inner = if kind == "mask" {
            "<rect width='9' height='9' fill='#fff'"
        } else {
            "<rect width='9' height='9'"
        };
        let one = |number: u32| match number {
            0 => format!("<{kind} id='r0'>{inner}/></{kind}>"),
            _ => {
                let used = format!("{inner} {attribute}='url(#r{})'/>", number - 1).repeat(times);
                format!("<{kind} id='r{number}'>{used}</{kind}>")
            }
        };
        let all: String = (0..=count).map(one).collect();
        let text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' height='40mm'>{all}\
             <rect width='20' height='20' {attribute}='url(#r{count})'/></svg>"
        );
        drawing::read("x.svg", text.as_bytes(), &Options::default()).map_err(|error| error.to_string())
    };
    for (kind, attribute) in [("clipPath", "clip-path"), ("mask", "mask"), ("pattern", "fill")] {
        // A pattern without a size fills nothing.
        if kind != "pattern" {
            chain(kind, attribute, 8, 1).unwrap_or_else(|error| panic!("{kind}: {error}"));
        }
        for (count, times) in [(20_000, 1), (40, 2)] {
            let error = chain(kind, attribute, count, times).expect_err(kind);
            assert!(error.contains("refer to each other too often"), "{kind}: {error}");
        }
    }
}

#[test]
fn markers_are_drawn_and_gradients_are_filled() {
    let marker = "<marker id='k' markerWidth='2' markerHeight='2' markerUnits='userSpaceOnUse' refX='1' refY='1'>\
        <rect width='2' height='3'/></marker><path d='M10 10H20' fill='none' stroke='#000' \
        stroke-width='.5' marker-start='url(#k)' marker-end='url(#k)'/>";
    let found = area(&drawn(marker), None);
    assert!((found - 12.0).abs() < 0.001, "two squares, cut at the marker's edge, and a line: {found} mm²");
    let gradient = "<linearGradient id='g'><stop stop-color='#fff'/><stop offset='1'/></linearGradient>\
        <rect width='10' height='10' fill='url(#g)'/>";
    let drawing = drawn(gradient);
    assert!((area(&drawing, None) - 100.0).abs() < 0.001, "copper throughout");
    assert!(format!("{:?}", drawing.warnings).contains("1 gradients"), "{:?}", drawing.warnings);
}

#[test]
fn layers_are_what_their_names_say() {
    for name in ["layers.svg", "layers.dxf"] {
        let loaded = board(name);
        let Board { outline, holes, back, .. } = &loaded.board;
        let bounds = outline.as_ref().expect("an outline").bounds();
        let off = (bounds.width() - Nm::from_mm(30)).abs() + (bounds.height() - Nm::from_mm(20)).abs();
        assert!(off < Nm::new(20), "{name}: the edge is {bounds:?}");
        assert_eq!(islands(&loaded.board), 3, "{name}: two pads, one with a track, and a frame");
        assert_eq!(holes.len(), 2, "{name}: two holes");
        for (hole, x) in holes.iter().zip([6, 24]) {
            assert_eq!((hole.diameter, hole.is_slot()), (Nm::from_um(800), false), "{name}: {hole:?}");
            let off =
                hole.path.start.distance(voromill::geometry::Point::new(Nm::from_mm(x), Nm::from_mm(10)));
            assert!(off < 200.0, "{name}: {hole:?} is {off} nm off");
        }
        assert!(back.is_none(), "{name}: nothing on the back");
        let expected = if name.ends_with("svg") { "drawing-layers-aside" } else { "dxf-left-out" };
        assert_eq!(codes(&loaded), [expected], "{name}");
    }
}

/// As Fritzing groups: what goes through the board is in one side's copper within the other's, and
/// parts have outlines of their own on the silkscreen.
#[test]
fn groups_within_groups_of_a_known_name_do_not_leave_it() {
    let at = |x: u32| format!("<rect x='{x}' y='4' width='1' height='1'/>");
    let group = |id: &str, inner: &str| format!("<g id='{id}'>{inner}</g>");
    let layer = |label: &str, inner: &str| {
        format!("<g inkscape:groupmode='layer' inkscape:label='{label}'>{inner}</g>")
    };
    let edge = "<rect width='20' height='10' fill='none' stroke='#000' stroke-width='.1'/>";
    let groups = [
        group("board", &group("boardoutline", edge)),
        group("copper0", &group("copper1", &at(2))),
        group("copper1", &[at(6), group("outline", &at(9))].concat()),
        group("silkscreen", &group("outline", &at(12))),
        layer("F.Mask", &layer("B.Cu", &at(15))),
    ];
    let text = |groups: &str| {
        format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='20mm' height='10mm' viewBox='0 0 20 10' \
             xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape'>{groups}</svg>"
        )
    };
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("amp.svg");
    let read = |text: &str| {
        std::fs::write(&path, text).expect("written");
        load(std::slice::from_ref(&path), &Selection::default())
    };
    let board = read(&text(&groups.concat())).expect("a board").board;
    let places = |side| -> Vec<i64> {
        let lefts = board.copper(side).expect("copper").features.iter();
        lefts.map(|feature| feature.shape.bounds().min().x.get() / 1_000_000).collect()
    };
    assert_eq!(places(Side::Front), [2, 6, 9], "through the board, and with an outline of its own");
    assert_eq!(places(Side::Back), [2, 15], "a layer within a layer is one by itself");
    assert_eq!(board.outline.expect("an edge").contours().len(), 1, "none of the silkscreen's");
    let stray = read(&text(&[groups.concat(), at(17)].concat())).expect_err("whose is it?").to_string();
    assert!(stray.contains("1 shape is in no layer, beside layers of copper"), "{stray}");
}

#[test]
fn copper_that_is_taken_for_something_else_is_missed_aloud() {
    let group = |id: &str, inner: &str| format!("<g id='{id}'>{inner}</g>");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("amp.svg");
    let square = |x: u32| format!("<rect x='{x}' y='4' width='1' height='1'/>");
    let read = |groups: &[String]| {
        let text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' height='10mm' viewBox='0 0 40 10'>{}{}</svg>",
            group("F.Cu", &square(1)),
            groups.concat()
        );
        std::fs::write(&path, text).expect("written");
        let mut loaded = load(std::slice::from_ref(&path), &Selection::default()).expect("a board");
        loaded.warnings.retain(|warning| warning.code() == "drawing-layers-aside");
        loaded
    };
    let usual = [
        "F.SilkS",
        "F.Mask",
        "B.Paste",
        "F.Fab",
        "F.CrtYd",
        "Dwgs.User",
        "In1.Cu",
        "silkscreen0",
        "soldermask",
        "tStop",
        "tCream",
        "Top Solder Mask",
        "TopOverlay",
        "PCBMask",
    ];
    let loaded = read(&usual.map(|name| group(name, &square(3))));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let roles = [
        ("pads", "pad master"),
        ("GND-plane", "inner copper"),
        ("mid", "inner copper"),
        ("traces-in1", "inner copper"),
        ("unmasked", "solder mask"),
    ];
    for (name, role) in roles {
        let loaded = read(&[group(name, &square(3))]);
        let messages: Vec<&str> = loaded.warnings.iter().map(|w| w.message.as_str()).collect();
        let expected = format!("layers of amp.svg are ignored for what their names say: `{name}` ({role})");
        assert_eq!(messages, [expected]);
    }
    let within = |outer: &str, inner: &str| read(&[group(outer, &group(inner, &square(3)))]).board;
    let fronts = |board: Board| board.front.expect("copper").features.len();
    assert_eq!(fronts(within("mask-group", "F.Cu")), 2, "copper in a group of masks");
    assert_eq!(fronts(within("silkscreen", "top")), 1, "what only sounds so");
    assert!(within("mask-group", "B.Cu").back.is_some(), "on the other side");
}

#[test]
fn a_text_that_nobody_sees_is_not_missed() {
    let said = |opacity: &str| {
        let square = "<rect width='10' height='10'/>";
        let drawing = drawn(&format!("{square}<text y='5' {opacity}>R1</text>"));
        drawing.warnings.iter().any(|warning| warning.code() == "svg-left-out")
    };
    assert!(said("") && said("opacity='0.5'"), "one without a font");
    assert!(!said("opacity='0'"), "KiCad's, beside the strokes of its letters");
}

#[test]
fn a_layer_that_is_chosen_must_draw_copper() {
    let edge = Some(fixture("loose.dxf"));
    let drawing = in_millimetres();
    let selection = Selection { front: edge.clone(), outline: edge, drawing, ..Selection::default() };
    let error = load(&[], &selection).expect_err("bare lines").to_string();
    assert!(error.contains("loose.dxf: chosen as the copper of the front, but it draws none"), "{error}");
}

#[test]
fn a_person_says_what_a_layer_is_for() {
    let layer = |name: &str| Some(PathBuf::from(format!("{}#{name}", fixture("layers.svg").display())));
    let selection = Selection { back: layer("F.Cu"), outline: layer("edge.cuts"), ..Selection::default() };
    let paths: Vec<PathBuf> = [&selection.back, &selection.outline].into_iter().flatten().cloned().collect();
    let loaded = load(&paths, &selection).expect("two layers");
    assert!(loaded.board.front.is_none() && loaded.board.holes.is_empty(), "no more than was named");
    assert!(loaded.board.back.is_some() && loaded.board.outline.is_some(), "both that were");
    let selection = Selection { front: layer("B.Cu"), ..Selection::default() };
    let error = load(&paths, &selection).expect_err("no such layer").to_string();
    assert!(error.contains("no layer `B.Cu`") && error.contains("F.Cu"), "{error}");
}

#[test]
fn a_drawing_is_the_edge_of_a_board_in_gerber() {
    let blinker = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    let drawing = in_millimetres();
    let selection = Selection { outline: Some(fixture("loose.dxf")), drawing, ..Selection::default() };
    let loaded = load(&[blinker], &selection).expect("a board");
    let bounds = loaded.board.outline.as_ref().expect("the drawing's").bounds();
    assert_eq!((bounds.width().to_mm().round(), bounds.height().to_mm()), (40.0, 30.0), "of the drawing");
    let roles: Vec<&str> = loaded.sources.iter().map(|source| source.role.as_str()).collect();
    assert_eq!(roles.iter().filter(|role| **role == "outline").count(), 1, "{roles:?}");
    assert!(loaded.board.back.is_some(), "the copper of the folder");
}

#[test]
fn bare_lines_are_an_edge_with_holes() {
    let selection = Selection { drawing: in_millimetres(), ..Selection::default() };
    let loaded = load(&[fixture("loose.dxf")], &selection).expect("read");
    let outline = loaded.board.outline.as_ref().expect("its ends meet");
    assert_eq!(outline.contours().len(), 2, "the edge and the ellipse");
    let ellipse = outline.contours().iter().find(|contour| contour.bounds().width() < Nm::from_mm(20));
    let ring: Vec<_> = ellipse.expect("the inner one").flatten(Nm::new(100));
    let area = Polygon::new(vec![ring]).expect("a ring").area_mm2().abs();
    assert!((area - 32.0 * std::f64::consts::PI).abs() < 0.01, "{area} mm²");
    assert_eq!(loaded.board.holes.len(), 1, "one circle");
    assert_eq!(loaded.board.holes[0].diameter, Nm::from_um(3200), "of 3.2 mm");
    assert!(codes(&loaded).contains(&"drawing-role-guessed"), "{:?}", codes(&loaded));
}

#[test]
fn of_a_ring_the_hole_is_what_it_leaves_open() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("holes.svg");
    let circle =
        |r: f64| format!("M{},20 a{r},{r} 0 1 0 {w},0 a{r},{r} 0 1 0 -{w},0 z", 20.0 - r, w = 2.0 * r);
    let rings = format!("<path fill-rule='evenodd' d='{} {} {}'/>", circle(2.0), circle(0.5), circle(1.0));
    let cases = [
        (rings, 1_000_000, "a ring and a circle round it"),
        (
            "<circle cx='20' cy='20' r='.25' fill='none' stroke='#000' stroke-width='.5'/>".to_owned(),
            1_000_000,
            "a line that fills its circle",
        ),
        (
            "<circle cx='20' cy='20' r='.5' fill='none' stroke='#000' stroke-width='.3'/>".to_owned(),
            1_000_000,
            "a line round a hole",
        ),
    ];
    for (drawn, diameter, what) in cases {
        let text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' height='40mm' viewBox='0 0 40 40'>\
             <g id='F.Cu'><rect width='9' height='9'/></g><g id='drill'>{drawn}</g></svg>"
        );
        std::fs::write(&path, text).expect("written");
        let loaded = load(std::slice::from_ref(&path), &Selection::default()).expect("a board");
        let sizes: Vec<i64> = loaded.board.holes.iter().map(|hole| hole.diameter.get()).collect();
        assert_eq!(sizes, [diameter], "{what}");
    }
}

#[test]
fn copper_drawn_as_svg_is_the_same_copper() {
    let out = tempfile::tempdir().expect("a folder");
    let blinker = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    let svg = out.path().join("copper.svg");
    let done = std::process::Command::new(env!("CARGO_BIN_EXE_voromill"))
        .args(["draw", &blinker.to_string_lossy(), "--stage", "copper", "-q", "-o", &svg.to_string_lossy()])
        .status();
    assert!(done.expect("runs").success(), "drawn");
    let covered = |features: &[voromill::board::Feature]| {
        let polygon = |feature: &voromill::board::Feature| feature.shape.polygon(Nm::new(250));
        let polygons: Vec<Polygon> = features.iter().filter_map(polygon).collect();
        let pieces = voromill::board::polarity::union(&polygons);
        (pieces.len(), pieces.iter().map(Polygon::area_mm2).sum::<f64>())
    };
    let (board, drawn) = (load(&[blinker], &Selection::default()), load(&[svg], &Selection::default()));
    let (board, drawn) = (board.expect("a board").board, drawn.expect("a drawing").board);
    let (islands, area) = covered(&board.back.expect("copper").features);
    let (found, drawn) = covered(&drawn.front.expect("copper").features);
    assert_eq!(found, islands, "the same islands");
    assert!((drawn / area - 1.0).abs() < 1e-4, "{drawn} mm², not {area}");
}

#[test]
fn a_drawing_mills_clean() {
    for name in ["layers.svg", "layers.dxf"] {
        let settings = Settings::resolve(JobOptions::default()).expect("defaults");
        let job = job::mill(board(name), &settings).expect(name);
        let parts: Vec<String> = job.programs.iter().map(|program| format!("{:?}", program.part)).collect();
        assert_eq!(parts.len(), 3, "{name}: isolation, holes and edge: {parts:?}");
        let findings = job.verify(&settings).expect("judged").findings;
        assert!(findings.is_empty(), "{name}: {findings:?}");
    }
}

#[test]
fn what_is_damaged_says_where() {
    let text = std::fs::read_to_string(fixture("layers.dxf")).expect("readable");
    for (damaged, expected) in [
        (text.replace("43\n0.8", "43\n0,8"), "this is not a number at `0,8`"),
        (text.replace("0\nENDSEC\n0\nEOF\n", ""), "truncated"),
        (text.replacen("8\nDrill", "eight\nDrill", 1), "a group code is not a number at `eight`"),
    ] {
        let error = drawing::read("x.dxf", damaged.as_bytes(), &Options::default()).expect_err(expected);
        assert!(error.to_string().contains(expected), "{error}");
    }
    let broken = b"<svg xmlns='http://www.w3.org/2000/svg'><g></svg>";
    let error = drawing::read("x.svg", broken, &Options::default()).expect_err("not closed").to_string();
    assert!(error.starts_with("x.svg:1:"), "{error}");
    for (text, place) in [("", "x.svg:1:1:"), ("\n", "x.svg:1:1:"), ("<svg>\r\n <g></b>", "x.svg:2:5:")] {
        let error = svg::read("x.svg", text.as_bytes(), &Options::default()).expect_err("no drawing");
        assert!(error.to_string().starts_with(place), "where {text:?} ends: {error}");
    }
}

/// The entities of a drawing in millimetres, its layers before them.
fn entities(layers: &str, entities: &str) -> Result<Drawing, voromill::import::Error> {
    let text = format!(
        "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n{layers}0\nENDTAB\n0\nENDSEC\n\
         0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
    );
    drawing::read("x.dxf", text.as_bytes(), &in_millimetres())
}

/// How wide and high the lines of a drawing are.
fn extent(drawing: &Drawing) -> [Nm; 2] {
    let paths = drawing.artwork.layers.iter().flat_map(|layer| layer.paths());
    let bounds = paths.map(|path| path.bounds()).reduce(voromill::geometry::Rect::union).expect("lines");
    [bounds.width(), bounds.height()]
}

/// Of floating-point numbers that are as good as equal, in arcs and curves that end where they
/// begin.
#[test]
fn what_is_shorter_than_a_nanometre_is_no_circle() {
    let line = "0\nLINE\n8\nOutline\n10\n0\n20\n0\n11\n5\n21\n4\n";
    let arc = |from: &str, to: &str| {
        let arc = format!("0\nARC\n8\nOutline\n10\n30\n20\n30\n40\n20\n50\n{from}\n51\n{to}\n");
        extent(&entities("", &format!("{line}{arc}")).expect("read"))
    };
    let is_round =
        |[width, height]: [Nm; 2]| (width - Nm::from_mm(50)).abs() <= Nm::new(2) && width == height;
    assert!(arc("10", "10.000001")[0] < Nm::from_mm(50), "{:?}", arc("10", "10.000001"));
    assert!(is_round(arc("10", "10")), "all the way round: {:?}", arc("10", "10"));
    assert!(is_round(arc("10", "9.9999999999")), "all but a hair: {:?}", arc("10", "9.9999999999"));
    let polyline =
        "0\nLWPOLYLINE\n8\nOutline\n90\n2\n70\n0\n10\n1\n20\n1\n42\n0.00000001\n10\n1.0000001\n20\n1\n";
    let bulge = entities("", &format!("{line}{polyline}")).expect("read");
    assert_eq!(extent(&bulge), [5, 4].map(Nm::from_mm), "a bulge between places that are one");
    let curve = drawn("<path d='M0,0 C1e-7,1e-7 2e-7,2e-7 3e-7,3e-7 L5,0 L5,5 L0,5Z'/>");
    assert!((area(&curve, None) - 25.0).abs() < 1e-3, "{} mm²", area(&curve, None));
}

#[test]
fn a_layer_is_hidden_however_its_name_is_spelled() {
    let layers = "0\nLAYER\n2\nConstruction\n70\n0\n62\n-7\n";
    let line = |layer: &str, x: i32| format!("0\nLINE\n8\n{layer}\n10\n0\n20\n0\n11\n{x}\n21\n4\n");
    let drawing = entities(layers, &(line("CONSTRUCTION", 50) + &line("Outline", 5))).expect("read");
    assert_eq!(extent(&drawing), [5, 4].map(Nm::from_mm), "{:?}", drawing.warnings);
}

#[test]
fn copies_of_blocks_without_anything_are_counted_too() {
    let text = std::fs::read_to_string(fixture("block_in_itself.dxf")).expect("readable");
    let insert = |name: &str| {
        format!("0\nINSERT\n8\nF.Cu\n2\n{name}\n10\n1\n20\n1\n70\n1400\n71\n1000\n44\n1\n45\n1\n")
    };
    let block = |name: &str, inner: &str| {
        format!("0\nBLOCK\n8\n0\n2\n{name}\n70\n0\n10\n0\n20\n0\n30\n0\n{inner}0\nENDBLK\n8\n0\n")
    };
    let blocks = block("NOTHING", "") + &block("ROWS", &insert("NOTHING"));
    let nested = text.replacen(
        "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
        &format!("{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}", insert("ROWS")),
        1,
    );
    assert!(
        drawing::read("nested.dxf", nested.as_bytes(), &Options::default()).is_err(),
        "two million million"
    );
}

/// Units that browsers take and the reader of SVG does not.
#[test]
fn a_page_is_as_large_as_it_says() {
    let size = |width: &str, height: &str| {
        let text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{height}' viewBox='0 0 100 50'>\
             <rect x='10' y='10' width='20' height='10'/></svg>"
        );
        drawing::read("x.svg", text.as_bytes(), &Options::default()).map(|drawing| area(&drawing, None))
    };
    for (width, height) in [("100mm", "50mm"), ("100 mm", "50 mm"), ("100MM", "50MM"), ("400q", "200q")] {
        let size = size(width, height).expect("read");
        assert!((size - 200.0).abs() < 0.01, "{width}: {size} mm²");
    }
    let error = size("100mm", "100%").expect_err("a part of nobody knows what").to_string();
    assert!(error.contains("one side of its page is a part of something"), "{error}");
}

#[test]
fn what_an_svg_says_that_is_not_followed_is_told() {
    let told =
        drawn("<path transform='scale(10)' vector-effect='non-scaling-stroke' stroke='#000' d='M1 1H3'/>");
    assert!(
        format!("{:?}", told.warnings).contains("1 strokes that keep their width"),
        "{:?}",
        told.warnings
    );
    let layer = |id: &str, label: &str| {
        format!(
            "<g id='{id}' xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' inkscape:groupmode='layer' \
             inkscape:label='{label}'><rect width='3' height='2'/></g>"
        )
    };
    let error = try_drawn(&(layer("layer1", "F.Cu") + &layer("layer1", "B.Cu"))).expect_err("one id");
    assert!(error.to_string().contains("groups of one id, `layer1`"), "{error}");
    drawn(&(layer("layer1", "F.Cu") + &layer("layer2", "B.Cu")));
}

#[test]
fn a_block_in_itself_is_drawn_once() {
    let drawing = read(&fixture("block_in_itself.dxf"), &Options::default()).expect("read");
    assert_eq!(drawing.source.counts["figures"], 1, "the pad of the one insert in the model");
    let told = format!("{:?}", drawing.warnings);
    assert!(told.contains("2 inserts of a block into itself"), "{told}");
    // Each block inserts the one before twice: a million pads, each as wide as it is long.
    let text = std::fs::read_to_string(fixture("block_in_itself.dxf")).expect("readable");
    let insert = |name: &str| format!("0\nINSERT\n8\nF.Cu\n2\n{name}\n10\n1\n20\n1\n");
    let blocks: String = (0..20)
        .map(|n| {
            let block = format!("0\nBLOCK\n8\n0\n2\nB{}\n70\n0\n10\n0\n20\n0\n30\n0\n", n + 1);
            let inner = if n == 0 { insert("PAD") } else { insert(&format!("B{n}")).repeat(2) };
            format!("{block}{inner}0\nENDBLK\n8\n0\n")
        })
        .collect();
    let many = text.replacen(
        "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
        &format!("{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}", insert("B20")),
        1,
    );
    let error = drawing::read("many.dxf", many.as_bytes(), &Options::default()).expect_err("too many");
    assert!(error.to_string().contains("four million lines and arcs"), "{error}");
}

#[test]
fn gathered_svgs_have_their_elements_or_a_reason() {
    let Some(root) = gathered("svg") else { return };
    let index: serde_json::Value =
        serde_json::from_slice(&std::fs::read(root.join("INDEX.json")).expect("an index")).expect("JSON");
    let kinds = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "text", "image", "use"];
    let (mut seen, mut refused) = (0, Vec::new());
    for entry in index.as_array().expect("a list") {
        let file = entry["file"].as_str().expect("a name");
        let own = read(&root.join(file), &Options::default());
        let Ok(drawing) = own.or_else(|_| read(&root.join(file), &in_millimetres())) else {
            refused.push(file.rsplit('/').next().unwrap_or(file));
            continue;
        };
        for kind in kinds {
            let expected = entry["facts"]["elements"][kind].as_u64().unwrap_or(0);
            let found = drawing.source.counts.get(kind).copied().unwrap_or(0);
            assert_eq!(found, expected, "{file}: {kind}");
        }
        seen += 1;
    }
    let nothing_to_draw = ["billion_laughs.svg", "logo_sac.svg", "text_no_font.svg", "use_cycle.svg"];
    refused.sort_unstable();
    assert_eq!(refused, nothing_to_draw, "only what has no path");
    assert!(seen > 80, "{seen} drawings");
}

#[test]
fn made_svgs_cover_what_their_notes_say() {
    let Some(root) = gathered("svg/made") else { return };
    let truth = 541.095_138;
    let cases = [
        ("unit_mm.svg", truth),
        ("unit_cm.svg", truth),
        ("unit_in.svg", truth),
        ("unit_pt.svg", truth),
        ("unit_px.svg", truth),
        ("unit_Q.svg", truth),
        ("no_viewbox_px.svg", truth),
        ("aspect_meet.svg", truth),
        ("mixed_units.svg", 619.634_954),
        ("use_symbol_rotate.svg", truth + 25.0),
        ("mirror_and_skew.svg", truth * 2.0),
        ("white_over_black.svg", 400.0 - 25.0 * std::f64::consts::PI),
        ("hidden_things.svg", 100.0),
    ];
    for (file, expected) in cases {
        let drawing = read(&root.join(file), &Options::default()).unwrap_or_else(|e| panic!("{file}: {e}"));
        let area = area(&drawing, None);
        assert!((area / expected - 1.0).abs() < 1e-4, "{file}: {area} mm², expected {expected}");
    }
    for file in ["no_size_no_viewbox.svg", "no_size_viewbox_only.svg", "percent_size.svg"] {
        let error = read(&root.join(file), &Options::default()).expect_err(file);
        assert!(error.contains("--unit"), "{file}: {error}");
        let area = area(&read(&root.join(file), &in_millimetres()).expect(file), None);
        assert!((area / truth - 1.0).abs() < 1e-4, "{file}: {area} mm²");
    }
}

#[test]
fn gathered_dxfs_have_their_entities_or_a_reason() {
    let Some(root) = gathered("dxf") else { return };
    let index: serde_json::Value =
        serde_json::from_slice(&std::fs::read(root.join("INDEX.json")).expect("an index")).expect("JSON");
    // A tenth of a millimetre a unit, so that nothing lies beyond a metre.
    let options = Options { unit: Unit::of_nanometres(1e4), ..Options::default() };
    let (mut seen, mut refused) = (0, Vec::new());
    for entry in index.as_array().expect("a list") {
        let (file, facts) = (entry["file"].as_str().expect("a name"), &entry["facts"]);
        let drawing = match read(&root.join(file), &options) {
            Ok(drawing) => drawing,
            Err(error) => {
                refused.push((file.to_owned(), error));
                continue;
            }
        };
        let counts = drawing.source.counts.iter().filter(|(kind, _)| *kind != "figures");
        let found: BTreeMap<&str, u64> = counts.map(|(kind, &count)| (kind.as_str(), count)).collect();
        let expected = facts["modelspace"].as_object().expect("counts");
        let expected: BTreeMap<&str, u64> =
            expected.iter().map(|(kind, count)| (kind.as_str(), count.as_u64().unwrap_or(0))).collect();
        assert_eq!(found, expected, "{file}");
        same_box(file, facts, &drawing);
        seen += 1;
    }
    let nothing = |error: &str| error.contains("nothing is drawn in the DXF");
    let odd: Vec<&str> =
        refused.iter().filter(|(_, error)| !nothing(error)).map(|(file, _)| file.as_str()).collect();
    assert_eq!(odd, ["made/truncated.dxf", "made/comma_decimals.dxf"], "damaged ones: {refused:?}");
    assert_eq!(refused.len(), 7, "and five of texts alone or of nothing: {refused:?}");
    assert!(seen > 60, "{seen} drawings");
}

/// Whether the box is that which ezdxf finds, where it knows one and takes no text for a part.
fn same_box(file: &str, facts: &serde_json::Value, drawing: &Drawing) {
    let has =
        |kind: &str| facts["modelspace"].get(kind).is_some() || facts["block_entities"].get(kind).is_some();
    let texts = ["TEXT", "MTEXT", "DIMENSION", "ATTDEF", "POINT"];
    let leaves_text = drawing.warnings.iter().any(|warning| warning.message.contains("TEXT"));
    let is_wide = |figure: &Figure| figure.radius() > Nm::ZERO;
    let wide = drawing.artwork.layers.iter().flat_map(|layer| &layer.figures).any(is_wide);
    if wide || leaves_text || texts.into_iter().any(has) || facts["bbox"].is_null() {
        return;
    }
    let expected: Vec<f64> =
        facts["bbox"].as_array().expect("four").iter().filter_map(serde_json::Value::as_f64).collect();
    // Middles of lines: a width does not count.
    let paths = drawing.artwork.layers.iter().flat_map(|layer| layer.paths());
    let bounds = paths.map(|path| path.bounds()).reduce(voromill::geometry::Rect::union).expect("figures");
    let found = [bounds.min().x, bounds.min().y, bounds.max().x, bounds.max().y].map(|nm| nm.to_f64() / 1e4);
    let size = (expected[2] - expected[0]).max(expected[3] - expected[1]);
    for (a, b) in found.iter().zip(&expected) {
        assert!((a - b).abs() < 0.002 * size + 0.001, "{file}: {found:?}, expected {expected:?}");
    }
}

#[test]
fn made_dxfs_are_as_large_as_their_notes_say() {
    let Some(root) = gathered("dxf/made") else { return };
    let plates = [
        "plate_R2000",
        "plate_R2007",
        "plate_R2018",
        "plate_R2018_binary",
        "plate_insunits_1_inch",
        "plate_insunits_5_cm",
        "plate_insunits_6_m",
        "plate_insunits_9_mil",
        "plate_insunits_13_micron",
        "plate_measurement_imperial",
        "crlf_and_spaces",
    ];
    for name in plates {
        let loaded = load(&[root.join(name).with_extension("dxf")], &Selection::default()).expect(name);
        let outline =
            loaded.board.outline.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", loaded.warnings));
        let area = outline.polygon(Nm::new(100)).area_mm2();
        // The slot lies on a layer of its own.
        let expected = 2_378.539_816;
        assert!((area - expected).abs() < 0.01, "{name}: {area} mm²");
        let holes: Vec<Nm> = loaded.board.holes.iter().map(|hole| hole.diameter).collect();
        assert_eq!(holes, [Nm::from_um(3200); 4], "{name}");
    }
    let drawing = read(&root.join("hatch_islands.dxf"), &Options::default()).expect("read");
    let shapes = drawing.artwork.layers[0].figures[0].shapes(Nm::new(100)).expect("little work");
    let covered = shapes.iter().filter_map(|(shape, _)| shape.polygon(Nm::new(100)));
    let area: f64 = covered.map(|polygon| polygon.area_mm2()).sum();
    assert!((area - 1_014.938_070).abs() < 0.01, "a hatch with an island: {area} mm²");
    let drawing = read(&root.join("insert_nested.dxf"), &Options::default()).expect("read");
    assert_eq!(drawing.source.counts["figures"], 44, "22 pads of a circle and a polyline");
    let error = read(&root.join("plate_insunits_0_unitless.dxf"), &Options::default()).expect_err("asks");
    assert!(error.contains("--unit"), "{error}");
}

/// A damaged drawing is read or refused, and never more; `VOROMILL_MUTATIONS` says how many are
/// tried of each.
#[test]
fn damage_is_read_or_refused() {
    let count = std::env::var("VOROMILL_MUTATIONS").ok().and_then(|text| text.parse().ok()).unwrap_or(150);
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        usize::try_from(state % below.max(1) as u64).expect("below a usize")
    };
    for name in ["layers.svg", "strokes.svg", "layers.dxf", "loose.dxf"] {
        let whole = std::fs::read(fixture(name)).expect("readable");
        for _ in 0..count {
            let mut bytes = whole.clone();
            for _ in 0..=random(3) {
                let (at, to) = (random(bytes.len()), random(bytes.len()));
                let (from, to) = (at.min(to), at.max(to).min(at.min(to) + 80));
                match random(5) {
                    0 => bytes[at] = u8::try_from(random(256)).expect("a byte"),
                    1 => bytes.truncate(at.max(1)),
                    2 => drop(bytes.drain(from..to)),
                    3 => {
                        let part = bytes[from..to].to_vec();
                        bytes.splice(at..at, part);
                    }
                    _ => {
                        let number = ["-1e30", "1e-30", "999999999", "0", "nan"][random(5)];
                        let digits = |i: &usize| bytes[*i].is_ascii_digit();
                        if let Some(digit) = (at..bytes.len()).find(digits) {
                            bytes.splice(digit..=digit, number.bytes());
                        }
                    }
                }
            }
            if let Ok(drawing) = drawing::read(name, &bytes, &in_millimetres()) {
                drop(drawing.artwork.polygons(Nm::from_um(10)));
                drawing.artwork.layers.into_iter().for_each(|layer| drop(layer.into_features()));
            }
        }
    }
}
