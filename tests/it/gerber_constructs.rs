//! One fixture a Gerber construct: the area it covers, known from geometry, in how many pieces, and
//! what is said of it.

use std::f64::consts::{FRAC_PI_4 as DISC, PI};
use std::fs;
use std::path::{Path, PathBuf};

use voromill::board::polarity;
use voromill::geometry::{Nm, Polygon, Rect};
use voromill::import::gerber::{Image, Options, read};

/// A line of 10 mm drawn with a circle of 1 mm.
const LINE: f64 = 10.0 + DISC;
/// What a right angle between two such lines adds: the outer quarter disc, less the overlap.
const CORNER: f64 = DISC / 4.0 - 0.25;
/// A regular hexagon of diameter 2.
const HEXAGON: f64 = 2.598_076_211_353_316;

/// A fixture, its copper in mm², its islands, and the codes of its warnings.
type Case = (&'static str, f64, usize, &'static [&'static str]);

const CASES: &[Case] = &[
    ("draw", LINE, 1, &[]),
    ("modal_operation", 30.0 + DISC + 2.0 * CORNER, 1, &["operation-code-missing"]),
    ("combined_codes", LINE, 1, &[]),
    ("one_line", LINE + DISC, 2, &[]),
    ("line_ends", LINE, 1, &[]),
    ("trailing_zeros", (0.1 + 2.0 * DISC * 0.01) * 645.16, 2, &[]),
    ("incremental", 10.0 + DISC + CORNER + DISC, 2, &[]),
    ("decimal_point", LINE + DISC, 2, &[]),
    ("late_units", LINE, 1, &["late-units"]),
    ("no_units", LINE, 1, &["missing-units"]),
    ("no_units_wide", 80.0 + DISC, 1, &["missing-units"]),
    ("g70_inches", (0.1 + DISC * 0.01) * 645.16, 1, &[]),
    ("seven_decimals", LINE, 1, &[]),
    ("aperture_circle", 2.0 * PI - DISC, 2, &[]),
    ("aperture_rectangle", 12.0 - DISC, 2, &[]),
    ("aperture_obround", 2.0 * (2.0 + PI) - DISC, 2, &[]),
    ("aperture_polygon", HEXAGON + 2.0 - DISC, 2, &[]),
    ("aperture_rectangular_hole", 2.25 * PI - 0.5 + 5.5, 2, &[]),
    ("aperture_hole_too_large", 3.0 - 1.913_223, 2, &[]),
    ("aperture_zero", 0.0, 0, &[]),
    ("aperture_defined_twice", PI + 4.0 + 1.0, 3, &["aperture-defined-twice"]),
    (
        "malformed_aperture",
        LINE,
        1,
        &["malformed-aperture", "malformed-aperture", "malformed-aperture", "malformed-aperture"],
    ),
    ("rectangle_sweep", 13.0 + 6.0, 2, &[]),
    ("flat_rectangle_sweep", 6.0, 1, &[]),
    ("holed_circle_draw", LINE + 2.0 * PI + DISC, 2, &[]),
    ("zero_length_draw", DISC + 2.0, 2, &[]),
    ("macro_circle", PI + DISC, 2, &[]),
    ("macro_vector_line", 8.0, 2, &[]),
    ("macro_center_line", 4.0, 1, &[]),
    ("macro_lower_left_line", 4.0, 1, &[]),
    ("macro_outline", 6.0, 1, &[]),
    ("macro_polygon", HEXAGON, 1, &[]),
    ("macro_moire", 14.0 * PI + 11.75 - 4.004_514, 1, &[]),
    ("macro_thermal", 3.0 * PI - 2.010_59, 4, &[]),
    ("macro_exposure", 3.0 * PI + 1.0, 2, &[]),
    ("macro_variables", 7.5, 1, &[]),
    ("macro_empty_statement", 2.0, 2, &[]),
    ("macro_under_erasure", 3.0 * PI + DISC, 2, &[]),
    ("macro_sweep", 11.5, 1, &[]),
    ("arc_multi_quadrant", 7.5 * PI + DISC, 1, &[]),
    ("arc_clockwise", 2.5 * PI + DISC, 1, &[]),
    ("arc_full_circle", 10.0 * PI, 1, &[]),
    ("arc_single_quadrant", 5.0 * PI + DISC, 1, &[]),
    ("arc_single_quadrant_point", DISC, 1, &[]),
    ("arc_without_mode", 2.5 * PI + DISC, 1, &["quadrant-mode"]),
    ("arc_without_mode_single", 7.5 * PI + DISC, 1, &["quadrant-mode"]),
    ("arc_against_mode", 5.0 * PI + DISC, 1, &["quadrant-mode"]),
    ("region", 100.0, 1, &[]),
    ("region_arcs", 12.5 * PI, 1, &[]),
    ("region_contours", 104.0, 2, &[]),
    ("region_cut_in", 84.0, 1, &[]),
    ("region_not_closed", 100.0, 1, &["region-not-closed"]),
    ("region_winds_twice", 100.0, 1, &["region-winds-twice"]),
    ("region_without_area", DISC, 1, &["nothing-drawn"]),
    ("clear_polarity", 100.0 - 8.0 * PI, 2, &[]),
    ("clear_stroke", LINE - 1.0, 2, &[]),
    ("image_negative", 100.0 - PI, 1, &["negative-image"]),
    ("block", 4.0 * PI, 4, &[]),
    ("block_nested", 200.0, 5, &[]),
    ("block_transformed", 2.0, 1, &[]),
    ("step_repeat", 7.0 * PI, 7, &[]),
    ("step_repeat_mixed", 20.0, 1, &[]),
    ("step_repeat_open", 6.0 * PI, 6, &[]),
    ("load_mirroring", 16.0, 1, &[]),
    ("load_rotation", 8.0, 2, &[]),
    ("load_scaling", 9.0 + PI, 2, &[]),
    ("mirror_image", 11.180_34 + DISC, 1, &[]),
    ("mirror_image_repeat", 3.0 * PI, 3, &[]),
    ("offset", LINE, 1, &[]),
    ("scale_factor", 20.0 + DISC, 1, &[]),
    ("scale_factor_repeat", 2.0 * PI, 2, &[]),
    ("axis_select", LINE, 1, &[]),
    ("axis_select_bars", 6.0, 2, &[]),
    ("image_rotation", 8.0, 1, &[]),
    ("image_rotation_repeat", 6.0 * PI, 6, &[]),
    ("image_rotation_block", 16.0, 2, &[]),
    ("attributes", 2.0 * PI + LINE, 3, &[]),
    ("attributes_in_comments", 2.0 * PI, 2, &[]),
    ("block_attributes", 2.0 * PI + 0.5, 3, &[]),
    ("missing_star", LINE, 1, &["missing-star"]),
    ("missing_percent", LINE, 1, &["missing-percent"]),
    ("missing_end", LINE, 1, &["missing-end-of-file"]),
    ("cut_off", LINE, 1, &["missing-end-of-file", "truncated-file"]),
    ("text_after_end", LINE, 1, &["text-after-end"]),
    ("unknown_command", LINE, 1, &["unknown-command"]),
    ("old_words", 10.0, 1, &["conflicting-units", "unknown-command"]),
    ("conflicting_g71", LINE, 1, &["conflicting-units"]),
    ("negative_hole", PI, 1, &["negative-hole"]),
    ("negative_file", LINE, 1, &["negative-file"]),
    ("flash_in_region", 100.0, 1, &["flash-in-region"]),
    ("polarity_in_region", 96.0, 1, &["polarity-in-region"]),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/gerber")
}

fn load(name: &str) -> Result<Image, voromill::import::Error> {
    let file = format!("{name}.gbr");
    read(&file, &fs::read(folder().join(&file)).expect("the fixture is there"), &Options::default())
}

/// The copper as disjoint polygons.
fn copper(image: &Image) -> Vec<Polygon> {
    let polygon = |feature: &voromill::board::Feature| feature.shape.polygon(Nm::new(20));
    polarity::union(&image.features.iter().filter_map(polygon).collect::<Vec<_>>())
}

/// Left, bottom, right and top, in micrometres.
fn bounds(name: &str) -> [i64; 4] {
    let image = load(name).expect("it reads");
    let bounds = image.features.iter().map(|feature| feature.shape.bounds()).reduce(Rect::union);
    let bounds = bounds.expect("something is drawn");
    [bounds.min().x, bounds.min().y, bounds.max().x, bounds.max().y].map(|nm| nm.get() / 1000)
}

#[test]
fn each_construct_covers_the_area_that_geometry_gives_it() {
    let mut failures = Vec::new();
    for &(name, area, islands, warnings) in CASES {
        let image = match load(name) {
            Ok(image) => image,
            Err(error) => {
                failures.push(format!("{name}: {error}"));
                continue;
            }
        };
        let copper = copper(&image);
        let found: f64 = copper.iter().map(Polygon::area_mm2).sum();
        let codes: Vec<_> = image.warnings.iter().map(|warning| warning.code()).collect();
        if (found - area).abs() > 5e-4 * area || copper.len() != islands || codes != warnings {
            failures.push(format!("{name}: {found} mm² for {area}, {} islands, {codes:?}", copper.len()));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn transformations_put_copper_in_its_place() {
    for (name, expected) in [
        ("block_transformed", [-500, -3000, 500, -1000]),
        ("load_mirroring", [-4000, -2000, 4000, 2000]),
        ("mirror_image", [-10_500, -500, 500, 5500]),
        ("offset", [4500, -500, 15_500, 500]),
        ("axis_select", [-500, -500, 500, 10_500]),
        ("axis_select_bars", [-500, 8500, 2500, 11_500]),
        ("mirror_image_repeat", [-2000, -1000, 10_000, 1000]),
        ("scale_factor_repeat", [1000, -1000, 8000, 1000]),
        ("image_rotation", [-1000, 8000, 1000, 12_000]),
        ("image_rotation_repeat", [-5000, -1000, 1000, 11_000]),
        ("image_rotation_block", [-11_000, -5000, 1000, 7000]),
        ("trailing_zeros", [-1270, -1270, 39_370, 52_070]),
        ("arc_clockwise", [-500, -5500, 5500, 500]),
    ] {
        let found = bounds(name);
        // An arc's bounds may be a nanometre too wide.
        let near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() <= 1);
        assert!(near, "{name}: {found:?}, expected {expected:?}");
    }
}

#[test]
fn round_apertures_stay_what_they_are() {
    use voromill::board::{Axis, Shape};
    let kinds = |name: &str| -> Vec<&'static str> {
        let image = load(name).expect("it reads");
        let kind = |feature: &voromill::board::Feature| match (&feature.shape, &feature.axis) {
            (Shape::Disc { .. }, Axis::Flash(_)) => "flashed disc",
            (Shape::Disc { .. }, _) => "drawn disc",
            (Shape::Stroke { .. }, Axis::Flash(_)) => "flashed stroke",
            (Shape::Stroke { .. }, _) => "drawn stroke",
            (Shape::Arc { .. }, _) => "arc",
            (Shape::Polygon(_), _) => "polygon",
        };
        image.features.iter().map(kind).collect()
    };
    assert_eq!(kinds("one_line"), ["drawn stroke", "flashed disc"], "draws and flashes");
    assert_eq!(kinds("zero_length_draw"), ["drawn disc", "polygon"], "draws of no length");
    assert_eq!(kinds("aperture_obround"), ["flashed stroke", "polygon"], "obrounds, the second with a hole");
    assert_eq!(kinds("arc_full_circle"), ["arc"], "arcs");
    assert_eq!(kinds("holed_circle_draw"), ["drawn stroke", "arc"], "draws of a circle with a hole");
    assert_eq!(kinds("clear_stroke"), ["polygon", "polygon"], "what clear polarity left");
}

#[test]
fn attributes_stay_with_what_they_were_set_for() {
    let image = load("attributes").expect("it reads");
    assert_eq!(image.function.as_deref(), Some("Copper,L1,Top"), "the file's function");
    assert_eq!(image.source.generator.as_deref(), Some("voromill by hand 1"), "the program");
    let sets: Vec<_> = image.features.iter().map(|f| &image.attributes[f.attributes as usize]).collect();
    let names: Vec<_> = sets.iter().map(|set| set.net.as_deref()).collect();
    assert_eq!(names, [Some("GND"), Some("/A,B"), None], "N/C is no net");
    let pins: Vec<_> = sets.iter().map(|set| (set.component.as_deref(), set.pin.as_deref())).collect();
    assert_eq!(pins, [(Some("R1"), Some("1")), (Some("R1"), Some("2")), (Some("R1"), None)], "pins");
    let functions: Vec<_> = sets.iter().map(|set| set.function.as_deref()).collect();
    assert_eq!(functions, [Some("ComponentPad"), Some("ComponentPad"), Some("Conductor")], "functions");

    let image = load("block_attributes").expect("it reads");
    let sets = image.features.iter().map(|f| &image.attributes[f.attributes as usize]);
    let found: Vec<_> = sets.map(|set| (set.net.as_deref(), set.function.as_deref())).collect();
    let pad = Some("SMDPad,CuDef");
    assert_eq!(found, [(Some("GND"), pad), (Some("VCC"), pad), (Some("OWN"), None)], "of flash and object");

    let image = load("attributes_in_comments").expect("it reads");
    assert_eq!(image.function.as_deref(), Some("Copper,L2,Bot,Signal"), "from a comment");
    let net = |index: usize| image.attributes[image.features[index].attributes as usize].net.as_deref();
    assert_eq!((net(0), net(1)), (Some("GND"), None), "set and deleted in comments");
}

#[test]
fn errors_show_the_place_and_what_to_do() {
    let mut shown = String::new();
    for name in fixtures().iter().filter(|name| name.starts_with("error_") || name.starts_with("bomb_")) {
        let error = load(name).expect_err("it must not read");
        shown += &format!("{}\n\n", error.render());
    }
    insta::with_settings!({
        snapshot_path => concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots/import"),
        prepend_module_to_snapshot => false,
    }, {
        insta::assert_snapshot!("gerber_errors", shown);
    });
}

/// The names of all fixtures, sorted.
fn fixtures() -> Vec<String> {
    let entries =
        fs::read_dir(folder()).expect("the fixtures are there").map(|entry| entry.expect("an entry").path());
    let mut names: Vec<String> =
        entries.map(|path| path.file_stem().expect("a name").to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn every_fixture_is_tested_and_in_the_table() {
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/gerber.md");
    let table = fs::read_to_string(table).expect("the table is there");
    for name in fixtures() {
        let tested = name.starts_with("error_") || name.starts_with("bomb_") || name == "arc_rectangle";
        assert!(tested || CASES.iter().any(|case| case.0 == name), "{name} has no case");
        assert!(table.contains(&format!("`{name}`")), "{name} is not in docs/gerber.md");
    }
}
