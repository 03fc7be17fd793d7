//! What of a drawing `carve` and `pocket` mill: what is filled, or what closed lines enclose.

use std::fmt::Write as _;

use voromill::geometry::{Nm, Polygon};
use voromill::import::drawing::{Options, Unit};
use voromill::import::outline::GAP;
use voromill::import::{Error, Shapes, load_shapes};

/// The shapes of the drawing `text`, saved as `name`, of which `layer` is asked for where it is
/// not empty.
fn try_shapes(name: &str, text: &str, layer: &str, options: &Options) -> Result<Shapes, Error> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join(name), text).expect("writable");
    let path = if layer.is_empty() { name.to_owned() } else { format!("{name}#{layer}") };
    let shapes = load_shapes(&folder.path().join(path), options, GAP)?;
    Ok(shapes.expect("a drawing"))
}

fn shapes(name: &str, text: &str) -> Shapes {
    try_shapes(name, text, "", &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// How many areas there are, how large they are together in mm², and the codes of what is told.
fn told(shapes: &Shapes) -> (usize, f64, Vec<&'static str>) {
    let area: f64 = shapes.areas.iter().map(Polygon::area_mm2).sum();
    let codes = shapes.warnings.iter().map(|warning| warning.kind.code).collect();
    (shapes.areas.len(), (area * 100.0).round() / 100.0, codes)
}

/// A DXF of these entities, its unit as `$INSUNITS` has it.
fn dxf_in(unit: u32, entities: &[String]) -> String {
    let head = format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n");
    format!("{head}0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n", entities.concat())
}

fn dxf(entities: &[String]) -> String {
    dxf_in(4, entities)
}

/// A polyline through places in micrometres, closed or not.
fn polyline(layer: &str, closed: bool, places: &[(i32, i32)]) -> String {
    let mut text = format!("0\nLWPOLYLINE\n8\n{layer}\n90\n{}\n70\n{}\n", places.len(), u8::from(closed));
    for (x, y) in places {
        let [x, y] = [x, y].map(|&um| f64::from(um) / 1000.0);
        write!(text, "10\n{x}\n20\n{y}\n").expect("a text");
    }
    text
}

/// A closed rectangle: its lower left corner and its size, in micrometres.
fn rectangle(layer: &str, [x, y, w, h]: [i32; 4]) -> String {
    polyline(layer, true, &[(x, y), (x + w, y), (x + w, y + h), (x, y + h)])
}

fn plain(ring: [i32; 4]) -> String {
    rectangle("0", ring)
}

fn svg(elements: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='60mm' height='30mm' viewBox='0 0 60 30'>{elements}</svg>"
    )
}

/// The rules by which a board's edge is told from what else is on its layer are none of drawings.
#[test]
fn all_that_closes_counts_however_near_or_small_it_is() {
    let near_and_small: [(&str, &[[i32; 4]], usize, f64); 5] = [
        ("a border", &[[0, 0, 50_000, 20_000], [400, 400, 49_200, 19_200]], 1, 55.36),
        ("an island by the wall", &[[0, 0, 50_000, 20_000], [50, 5_000, 10_000, 10_000]], 1, 900.0),
        ("a small one beside", &[[0, 0, 100_000, 60_000], [110_000, 0, 8_000, 8_000]], 2, 6064.0),
        ("a dot", &[[0, 0, 100_000, 60_000], [110_000, 0, 200, 200]], 2, 6000.04),
        ("the same twice", &[[0, 0, 10_000, 10_000], [2, 2, 9_996, 9_996]], 1, 100.0),
    ];
    for (name, rings, count, area) in near_and_small {
        let drawing = dxf(&rings.iter().map(|&ring| plain(ring)).collect::<Vec<_>>());
        assert_eq!(told(&shapes("plate.dxf", &drawing)), (count, area, vec![]), "{name}");
    }
}

#[test]
fn lines_that_are_not_closed_are_told_and_lose_nothing_else() {
    let long = || polyline("0", false, &[(-10_000, 30_000), (90_000, 30_000)]);
    let drawing = dxf(&[plain([0, 0, 20_000, 20_000]), long()]);
    let found = shapes("plate.dxf", &drawing);
    assert_eq!(told(&found), (1, 400.0, vec!["drawing-lines-open"]), "longer than all that closes");
    let warning = &found.warnings[0];
    assert!(warning.message.contains("1 line, 100.0 mm long, is not closed"), "{}", warning.message);
    assert_eq!(warning.at.map(|at| (at.x, at.y)), Some((Nm::from_mm(-10), Nm::from_mm(30))), "its place");
    let open = [(50_000, 0), (90_000, 0), (90_000, 20_000), (50_000, 20_000), (50_000, 300)];
    let drawing = dxf(&[plain([0, 0, 20_000, 20_000]), polyline("0", false, &open)]);
    assert_eq!(
        told(&shapes("plate.dxf", &drawing)),
        (1, 400.0, vec!["drawing-lines-open"]),
        "a gap of 0.3 mm"
    );
    let open = [(50_000, 0), (90_000, 0), (90_000, 20_000), (50_000, 20_000), (50_000, 80)];
    let drawing = dxf(&[plain([0, 0, 20_000, 20_000]), polyline("0", false, &open)]);
    let (count, _, codes) = told(&shapes("plate.dxf", &drawing));
    assert_eq!((count, codes), (2, vec!["drawing-gap"]), "one of 0.08 mm is closed");
    let drawing = dxf(&[plain([0, 0, 20_000, 20_000]), plain([10_000, 10_000, 20_000, 20_000])]);
    assert_eq!(told(&shapes("plate.dxf", &drawing)), (1, 700.0, vec!["drawing-lines-touch"]), "together");
    let error =
        try_shapes("plate.dxf", &dxf(&[long()]), "", &Options::default()).expect_err("nothing closes");
    let error = error.to_string();
    assert!(error.starts_with("plate.dxf:16:1: ") && error.contains("no line is closed"), "{error}");
}

#[test]
fn a_layer_of_lines_is_milled_alone_in_the_unit_that_is_asked_for() {
    let layers = [
        rectangle("Outline", [0, 0, 100_000, 50_000]),
        rectangle("Pockets", [10_000, 10_000, 20_000, 20_000]),
    ];
    let options = Options::default();
    let pockets =
        |unit: u32, options: &Options| try_shapes("panel.dxf", &dxf_in(unit, &layers), "Pockets", options);
    assert_eq!(told(&pockets(4, &options).expect("a layer")), (1, 400.0, vec![]));
    assert_eq!(told(&shapes("panel.dxf", &dxf(&layers))), (1, 4600.0, vec![]), "all of it: an island");
    let in_millimetres = Options { unit: Some(Unit::MILLIMETRE), ..Options::default() };
    for unit in [0, 1] {
        assert_eq!(told(&pockets(unit, &in_millimetres).expect("a layer")), (1, 400.0, vec![]), "{unit}");
    }
    let missing = pockets(0, &options).expect_err("no unit").to_string();
    assert!(missing.contains("--unit"), "{missing}");
}

/// A drawing program gives every line a width.
#[test]
fn strokes_that_close_enclose_and_a_wide_pen_paints() {
    let pen = |width: &str, path: &str| {
        svg(&format!("<path d='{path}' fill='none' stroke='black' stroke-width='{width}'/>"))
    };
    let square = "M5 5H25V25H5Z";
    for (name, drawing, area, codes) in [
        ("a hairline", pen("0.1", square), 400.0, vec![]),
        ("a wide line", pen("1", square), 400.0, vec![]),
        ("not closed by Z", pen("0.1", "M5 5H25V25H5V5"), 400.0, vec![]),
        ("with an island", pen("0.1", "M5 5H25V25H5Z M10 10H20V20H10Z"), 300.0, vec![]),
        ("with a mark", pen("0.1", "M5 5H25V25H5Z M30 5H50"), 400.0, vec!["drawing-lines-open"]),
        ("a letter L", pen("1", "M5 5V25H15"), 30.0, vec![]),
        ("letters", pen("1", "M5 5H25V25H5Z M30 5H50"), 100.0, vec![]),
        ("a hairline that is open", pen("0.1", "M5 5H25"), 2.0, vec![]),
    ] {
        let (_, found, told) = told(&shapes("plate.svg", &drawing));
        assert_eq!((found, &told), (area, &codes), "{name}");
    }
}

#[test]
fn closed_lines_beside_what_is_filled_are_told() {
    let square = |x: i32, paint: &str| format!("<rect x='{x}' y='5' width='10' height='10' {paint}/>");
    let line = "fill='none' stroke='black' stroke-width='0.1'";
    let found = shapes("plate.svg", &svg(&(square(5, "") + &square(25, line))));
    let (count, _, codes) = told(&found);
    assert_eq!((count, codes), (2, vec!["drawing-lines-unfilled"]), "and painted");
    let message = &found.warnings[0].message;
    assert!(message.contains("1 closed line fills nothing"), "{message}");
    assert!(found.warnings[0].at.is_some() && found.warnings[0].source.is_some(), "its place");
    let hatched = svg(&(square(5, "") + &square(5, line)));
    assert_eq!(told(&shapes("plate.svg", &hatched)).2, [""; 0], "along the edge of what is filled");
    let path = "<path d='M5 5V25H15' fill='none' stroke='black' stroke-width='1'/>";
    let drawn = shapes("plate.svg", &svg(&(path.to_owned() + &square(25, line))));
    assert_eq!(told(&drawn).2, ["drawing-lines-unfilled"], "beside what a pen paints, too");
    let framed = svg(&(square(5, "") + &square(25, "fill='none' stroke='black' stroke-width='1'")));
    assert_eq!(told(&shapes("plate.svg", &framed)).2, [""; 0], "what a wide pen paints is meant");
}

#[test]
fn layers_that_are_not_milled_are_told() {
    let square = |id: &str, x: i32| format!("<g id='{id}'><rect x='{x}' y='5' width='10' height='10'/></g>");
    let drawing = svg(&(square("top", 5) + &square("bottom", 25)));
    let found = shapes("both.svg", &drawing);
    assert_eq!(told(&found), (1, 100.0, vec!["drawing-not-milled"]));
    assert!(found.warnings[0].message.ends_with("not what is in `bottom`"), "{}", found.warnings[0].message);
    let back = try_shapes("both.svg", &drawing, "bottom", &Options::default()).expect("a layer");
    assert_eq!(told(&back), (1, 100.0, vec![]), "as asked for");
    let pad = "<g id='copper1'><path d='M5 5H25V25H5Z' fill='none' stroke='black' stroke-width='1'/></g>";
    assert_eq!(told(&shapes("pad.svg", &svg(pad))), (1, 80.0, vec![]), "copper is what is painted");
    let neither = svg(&(square("text", 5) + &square("logo", 25)));
    assert_eq!(
        told(&shapes("both.svg", &neither)),
        (2, 200.0, vec![]),
        "all where no name is one of a board"
    );
}
