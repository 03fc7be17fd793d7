//! Drill files: each construct, each format, and every hole of every board that is at hand.

use std::path::Path;

use voromill::board::{Hole, Plating};
use voromill::geometry::{Nm, Point, Rect};
use voromill::import::excellon::{self, Context, Drilling};

fn fixture(name: &str) -> Drilling {
    fixture_among(name, &Context::default())
}

fn fixture_among(name: &str, context: &Context) -> Drilling {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/excellon").join(name);
    let bytes = std::fs::read(&path).expect("the fixture is readable");
    assert!(excellon::looks_like(&bytes), "{name} is not recognised");
    excellon::read(name, &bytes, context).unwrap_or_else(|error| panic!("{}", error.render()))
}

fn read(text: &str) -> Result<Drilling, String> {
    excellon::read("f.drl", text.as_bytes(), &Context::default()).map_err(|error| error.to_string())
}

/// Micrometres.
fn at(x: i64, y: i64) -> Point {
    Point::new(Nm::from_um(x), Nm::from_um(y))
}

fn starts(drilling: &Drilling) -> Vec<Point> {
    drilling.holes.iter().map(|hole| hole.path.start).collect()
}

fn codes(drilling: &Drilling) -> Vec<&'static str> {
    drilling.warnings.iter().map(|warning| warning.code).collect()
}

#[test]
fn a_kicad_file_says_everything() {
    let drilling = fixture("kicad.drl");
    assert_eq!(starts(&drilling), [at(10_000, -5_500), at(12_540, -5_500), at(3_500, -3_500)], "places");
    let platings: Vec<_> = drilling.holes.iter().map(|hole| hole.plating).collect();
    assert_eq!(platings, [Plating::Plated, Plating::Plated, Plating::NonPlated], "attributes of the tools");
    assert_eq!(drilling.holes[2].diameter, Nm::from_um(3_200), "diameter");
    assert_eq!(drilling.function.as_deref(), Some("MixedPlating,1,2"), "function");
    assert_eq!(drilling.source.generator.as_deref(), Some("Kicad,Pcbnew,6.0.11"), "generator");
    assert!(drilling.warnings.is_empty(), "{:?}", drilling.warnings);
}

#[test]
fn tools_may_be_defined_where_they_are_chosen() {
    let drilling = fixture("headerless.tap");
    assert_eq!(starts(&drilling), [at(5_715, 5_842), at(6_096, 9_779), at(25_400, 5_588)], "inches, 2.4");
    assert_eq!(drilling.holes[2].diameter, Nm::new(863_600), "0.034 inch");
    assert_eq!(codes(&drilling), ["drill-units-guessed"], "and says so");
}

#[test]
fn the_copper_decides_between_number_formats() {
    let holes = [at(77_978, 51_054), at(77_978, 61_214), at(76_962, 46_228)];
    let context = Context::new(holes, Rect::around(holes));
    let drilling = fixture_among("undeclared.drl", &context);
    assert_eq!(starts(&drilling), holes, "3.3 puts every hole on its pad");
    assert_eq!(codes(&drilling), ["drill-format-guessed"], "and says so");
    let message = &drilling.warnings[0].message;
    assert!(message.contains("3 of 3 holes on pads"), "with the reason: {message}");
    assert_eq!(
        starts(&fixture("undeclared.drl"))[0],
        Point::new(Nm::new(7_797_800), Nm::new(5_105_400)),
        "else 2.4"
    );
}

#[test]
fn leading_zeros_are_counted_where_trailing_ones_are_left_out() {
    let drilling = fixture("altium.txt");
    let expected = [at(38_608, 11_557), at(38_608, 42_672), at(31_750, 42_672)];
    assert_eq!(starts(&drilling)[..3], expected, "2.3 with trailing zeros left out, X and Y modal");
    assert_eq!(drilling.holes[0].plating, Plating::Plated, "by the comment before the tool");
    assert_eq!(drilling.holes[3].plating, Plating::NonPlated, "by the comment before the other");
}

#[test]
fn a_slot_has_two_ends() {
    let drilling = fixture("slots_g85.drl");
    let ends: Vec<_> = drilling.holes.iter().map(|hole| (hole.path.start, hole.path.end())).collect();
    let expected = [(at(96_901, -65_701), at(96_901, -67_700)), (at(102_599, -63_701), at(100_601, -63_701))];
    assert_eq!(ends, expected, "both slots");
    assert!(drilling.holes.iter().all(Hole::is_slot), "and neither is a plain hole");
}

#[test]
fn a_router_cuts_between_lowering_and_raising() {
    let drilling = fixture("routed.drl");
    assert_eq!(drilling.holes.len(), 3, "a slot, a contour, a hole");
    assert_eq!(drilling.holes[0].path.end(), at(151_250, -109_250), "the slot's end");
    let contour = &drilling.holes[1].path;
    let quarter = std::f64::consts::FRAC_PI_2 * 10e6;
    assert!((contour.length() - 2.0 * quarter).abs() < 10.0, "two quarter circles: {}", contour.length());
    assert!(!drilling.holes[2].is_slot(), "drilling goes on behind G05");
}

#[test]
fn repeats_repeat() {
    let drilling = fixture("repeats.drl");
    let holes = starts(&drilling);
    assert_eq!(holes.len(), 5 + 2 + 4 + 2, "a row of five, and a pattern of two, four times");
    assert_eq!(holes[4], at(20_160, 0), "the row's last");
    assert_eq!(holes[9..11], [at(10_000, 10_000), at(10_000, 12_000)], "the pattern twice as far");
    assert_eq!(holes[11], at(10_000, 30_000), "and up");
}

#[test]
fn modes_hold_until_changed() {
    let drilling = fixture("modes.drl");
    let expected =
        [at(1_000, 1_000), at(2_000, 1_000), at(3_000, 1_000), at(3_000, 2_000), at(11_000, 11_000)];
    assert_eq!(starts(&drilling), expected, "absolute, incremental, and from another zero");
    assert_eq!(drilling.holes[1].tool, 2, "a tool behind coordinates drills them");
}

#[test]
fn tool_sizes_may_stand_in_comments() {
    let drilling = fixture("allegro.drl");
    let sizes: Vec<_> = drilling.holes.iter().map(|hole| hole.diameter).collect();
    assert_eq!(sizes, [Nm::new(609_600), Nm::new(609_600), Nm::new(3_175_000)], "24 and 125 mils");
}

#[test]
fn what_cannot_be_drilled_for_certain_is_an_error_with_its_place() {
    let cases = [
        ("M48\nMETRIC\nT1C-0.8\n%\nT1\nX1.0Y1.0\nM30\n", "f.drl:3:3: a drill cannot have this diameter"),
        ("M48\nMETRIC\n%\nT1\nX1.0Y1.0\nM30\n", "f.drl:5:1: tool T1 drills here"),
        ("M48\nMETRIC\nT1C0.8\n%\nT0\nX1.0Y1.0\nM30\n", "f.drl:6:1: a hole is drilled before any tool"),
        (
            "M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0G82X5.0Y5.0\nM30\n",
            "f.drl:6:9: a drill command that is not supported",
        ),
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nX9999.0Y1.0\nM30\n", "f.drl:6:1: coordinate beyond"),
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0\nR4000000X0.0\nM30\n", "f.drl:7:1: more than 2000000 holes"),
        ("%%3000\nX1Y1T1\nM30\n", "a Sieb & Meyer drill file"),
        (" \r\n", "the drill file is empty"),
        ("%FSLAX24Y24*%\n%MOIN*%\nM02*\n", "a Gerber file where"),
        ("Dear reader,\nthis is prose.\n", "not an Excellon drill file"),
    ];
    for (text, expected) in cases {
        let error = read(text).expect_err(text);
        assert!(error.contains(expected), "{text:?} gave {error:?} and not {expected:?}");
    }
}

#[test]
fn what_is_repaired_or_left_out_is_a_warning() {
    let cases = [
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0\n", "missing-end-of-file"),
        ("M48\nMETRIC\n%\nM30\n", "drill-without-holes"),
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nG00X1.0Y1.0\nG01X2.0\nG05\nX1.0Y1.0\nM30\n", "router-not-lowered"),
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nM98,VORO\nX1.0Y1.0\nM30\n", "drilled-text"),
        ("M48\nMETRIC\nT1C1\n%\nT1\nX1.0Y1.0\nM30\n", "diameter-without-point"),
        ("M48\nMETRIC\nFROBNICATE\nT1C0.8\n%\nT1\nX1.0Y1.0\nM30\n", "unknown-drill-command"),
        ("M48\nINCH\nT1C0.03\n%\nM71\nT1\nX1.0Y1.0\nM30\n", "unit-changes"),
    ];
    for (text, code) in cases {
        let drilling = read(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        assert!(codes(&drilling).contains(&code), "{text:?} gave {:?}", codes(&drilling));
    }
}
