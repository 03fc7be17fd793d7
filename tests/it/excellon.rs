//! Drill files: each construct, each format, and every hole of every board that is at hand.

use std::fs;
use std::path::Path;

use proptest::prelude::*;

use voromill::board::{Hole, Plating};
use voromill::geometry::{Nm, Point, Rect};
use voromill::import::excellon::{self, Context, Drilling};

use crate::corpus;

fn fixture(name: &str) -> Drilling {
    fixture_among(name, &Context::default())
}

fn fixture_among(name: &str, context: &Context) -> Drilling {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/excellon").join(name);
    let bytes = fs::read(&path).expect("the fixture is readable");
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
    drilling.warnings.iter().map(|warning| warning.code()).collect()
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
fn what_a_file_declares_gives_way_to_the_copper_alone() {
    let pads = [at(10_000, 5_500), at(12_540, 5_500), at(15_080, 5_500), at(17_620, 5_500)];
    let drilling = fixture_among("wrong_unit.drl", &Context::new(pads, Rect::around(pads)));
    assert_eq!(starts(&drilling), pads, "millimetres, though it says inches");
    assert_eq!(drilling.holes[0].diameter, Nm::from_um(800), "its tools too");
    assert_eq!(codes(&drilling), ["drill-format-guessed"], "and says so");
    assert!(
        drilling.warnings[0].message.contains("0 of 4 holes lie on the board"),
        "{:?}",
        drilling.warnings
    );
    let elsewhere = Rect::around([at(-90_000, -90_000), at(-80_000, -80_000)]);
    let drilling = fixture_among("wrong_unit.drl", &Context::new([], elsewhere));
    assert_eq!(drilling.source.units, "inch", "as it says, where no reading fits");
    assert_eq!(codes(&drilling), ["drill-off-board", "drill-implausible"], "and says so");
}

#[test]
fn holes_round_the_copper_are_the_boards_own() {
    let copper = Rect::around([at(10_000, 10_000), at(40_000, 30_000)]);
    let context = Context::new([], copper);
    let codes_among = |text: &str, context: &Context| {
        codes(&excellon::read("f.drl", text.as_bytes(), context).expect("it reads")).join(" ")
    };
    let mounting = "M48\nMETRIC\nT1C3.2\n%\nT1\nX2.0Y2.0\nX48.0Y2.0\nX48.0Y38.0\nX2.0Y38.0\nM30\n";
    assert_eq!(codes_among(mounting, &context), "", "mounting holes with the copper between them");
    assert_eq!(codes_among(mounting, &context.clone().with_edge()), "drill-off-board", "8 mm off the edge");
    let tooling = "M48\nMETRIC\nT1C3.2\n%\nT1\nX6.0Y20.0\nX44.0Y20.0\nM30\n";
    assert_eq!(codes_among(tooling, &context.clone().with_edge()), "", "tooling holes in a frame of 5 mm");
    let one_corner = "M48\nMETRIC\nT1C3.2\n%\nT1\nX2.0Y2.0\nX3.0Y2.0\nM30\n";
    assert_eq!(codes_among(one_corner, &context), "drill-off-board", "no copper between them");
    // Of two readings neither of which puts a hole on the board, nobody knows which is meant.
    let undeclared = "M48\nT1C3.2\n%\nT1\nX6000Y20000\nX44000Y20000\nM30\n";
    assert!(codes_among(undeclared, &context.with_edge()).contains("drill-off-board"), "undeclared");
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

    let slots = "X1.0Y1.0\nX5.0Y1.0\nG85X5.0Y3.0\nG85X7.0Y3.0\nT2\nG85X8.0Y3.0";
    let drilling = read(&format!("M48\nMETRIC\nT1C1.0\nT2C2.0\n%\nT1\n{slots}\nM30\n")).expect("readable");
    let ends: Vec<_> = drilling.holes.iter().map(|hole| (hole.path.start, hole.path.end())).collect();
    let hole = (at(1_000, 1_000), at(1_000, 1_000));
    let corners = [at(5_000, 1_000), at(5_000, 3_000), at(7_000, 3_000), at(8_000, 3_000)];
    let expected: Vec<_> =
        [hole].into_iter().chain(corners.windows(2).map(|pair| (pair[0], pair[1]))).collect();
    assert_eq!(ends, expected, "a line that begins with G85 goes on from the hole or slot before it");
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
fn what_is_no_hole_is_repeated_as_it_is() {
    let text = "M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0G85X3.0Y1.0\nR2Y5.0\nX9.0Y9.0\nR1X1.0\n\
                X20.0Y20.0G84X4000\nR1X8.0\nM30\n";
    let drilling = read(text).expect("a drill file");
    // Left, bottom, right and top; the bounds of arcs are a nanometre wider.
    let bounds = |hole: &Hole| {
        let bounds = hole.path.bounds();
        [bounds.min().x, bounds.min().y, bounds.max().x, bounds.max().y].map(|nm| (nm.get() + 500) / 1000)
    };
    let found: Vec<[i64; 4]> = drilling.holes.iter().map(bounds).collect();
    let expected = [
        [1000, 1000, 3000, 1000],
        [1000, 6000, 3000, 6000],
        [1000, 11_000, 3000, 11_000],
        [9000, 9000, 9000, 9000],
        [10_000, 9000, 10_000, 9000],
        [18_400, 18_400, 21_600, 21_600],
        [26_400, 18_400, 29_600, 21_600],
    ];
    assert_eq!(found, expected, "three slots, two holes, and two circles");
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
    let drilling = fixture("allegro_tools.drl");
    let sizes: Vec<_> = drilling.holes.iter().map(|hole| hole.diameter).collect();
    let expected = [Nm::new(304_800), Nm::new(304_800), Nm::new(609_600), Nm::new(3_175_000)];
    assert_eq!(sizes, expected, "12 mils, 0.024 inches and 125 mils, of tools named before the sizes");
    assert_eq!(drilling.holes[3].plating, Plating::NonPlated, "as the table says");
}

#[test]
fn where_no_tool_is_chosen_a_stop_changes_to_the_next_of_the_table() {
    let drilling = fixture("allegro_stops.drl");
    let tools: Vec<_> = drilling.holes.iter().map(|hole| hole.tool).collect();
    assert_eq!(tools, [1, 1, 1, 1, 2, 2], "two, two repeats, and two behind the stop");
    let (first, last) = (&drilling.holes[0], &drilling.holes[5]);
    assert_eq!((first.diameter, last.diameter), (Nm::new(609_600), Nm::new(3_175_000)), "24 and 125 mils");
    assert_eq!((first.plating, last.plating), (Plating::Plated, Plating::NonPlated), "of the table");
    assert_eq!(last.path.start, at(63_500, 38_100), "inches, as the sizes are in mils, of seven digits");
    let table = "; Holesize 1. = 24.0 PLATED MILS Quantity = 1\n%\nG90\nX1.0Y1.0\nM00\nX2.0Y1.0\nM30\n";
    assert!(read(table).is_err_and(|error| error.starts_with("f.drl:6:1: a hole is drilled")), "too short");
}

#[test]
fn who_writes_points_leaves_them_out_of_whole_numbers() {
    let drilling = fixture("points_where_needed.drl");
    let expected = [at(10_500, 7_620), at(12_000, 7_620), at(5_000, 5_000), at(15_000, 5_000)];
    assert_eq!(starts(&drilling), expected, "millimetres, whatever zeros are said to be kept");
    let text = "M48\nMETRIC\nT1C0.8\n%\nT1\nX10Y20\nX12Y20\nX5Y5\nM30\n";
    let pads = [at(10_000, 20_000), at(12_000, 20_000), at(5_000, 5_000)];
    let bounds = Rect::new(at(0, 0), at(30_000, 30_000));
    let context = Context::new(pads, Some(bounds));
    let drilling = excellon::read("f.drl", text.as_bytes(), &context).expect("readable");
    assert_eq!(starts(&drilling), pads, "where pads say so, without any point, too");
    assert_eq!(codes(&drilling), ["drill-format-guessed"], "and says so");
}

#[test]
fn a_stop_ends_nothing_and_what_follows_the_end_is_told() {
    let drilling = fixture("two_programs.drl");
    assert_eq!(starts(&drilling), [at(1_000, 2_000), at(3_000, 2_000)], "one behind M00, none behind M30");
    assert_eq!(codes(&drilling), ["text-after-end"], "what is left out");
    let cut = read("M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0\nM00\nX2.0Y1.0\n").expect("readable");
    assert_eq!(codes(&cut), ["missing-end-of-file"], "a stop with holes behind it is no end");
}

#[test]
fn a_tool_that_cannot_be_read_matters_where_it_drills() {
    let drilling = fixture("malformed_tool.drl");
    assert_eq!(starts(&drilling), [at(1_000, 2_000)], "the hole of another tool");
    assert_eq!(codes(&drilling), ["malformed-tool", "malformed-tool"], "and says so");
    for tool in ["T2C-0.8", "T2C", "T2C0.8.1"] {
        let text = format!("M48\nMETRIC\nT1C0.8\n{tool}\n%\nT2\nX1.0Y2.0\nM30\n");
        assert!(read(&text).is_err_and(|error| error.starts_with("f.drl:4:")), "{tool} drills");
    }
}

#[test]
fn a_tool_that_is_numbered_nought_drills() {
    let holes =
        read("M48\nINCH\nT0C0.02\nT1C0.03\n%\nT0\nX1.0Y1.0\nT1\nX2.0Y1.0\nM30\n").expect("two tools").holes;
    let diameters: Vec<i64> = holes.iter().map(|hole| hole.diameter.get()).collect();
    assert_eq!(diameters, [508_000, 762_000]);
}

#[test]
fn what_cannot_be_drilled_for_certain_is_an_error_with_its_place() {
    let cases = [
        ("M48\nMETRIC\nT1C-0.8\n%\nT1\nX1.0Y1.0\nM30\n", "f.drl:3:3: a drill cannot have this diameter"),
        ("M48\nMETRIC\n%\nT1\nX1.0Y1.0\nM30\n", "f.drl:5:1: tool T1 drills here"),
        ("M48\nMETRIC\nT1C0.8\n%\nT0\nX1.0Y1.0\nM30\n", "f.drl:6:1: a hole is drilled before any tool"),
        (
            "M48\nMETRIC\nT1C0.8\n%\nT1\nG99X1.0Y1.0\nM30\n",
            "f.drl:6:1: a drill command that is not supported",
        ),
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0X2.0\nM30\n", "f.drl:6:9: a second position in one line"),
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nG82\nX0Y0\nX5.0Y5.0\nM30\n", "f.drl:8:1: the corners of this package"),
        ("M48\nINCH\nT1C0.03\n%\nT1\nG82\nX0Y0\nX0.3Y0.3\nM30\n", "f.drl:8:1: a square package"),
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nG82\nX1.0Y1.0\nM30\n", "f.drl:7:1: a package of which only one"),
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nG83X1.0Y1.0\n", "f.drl:6:1: a package of which only one"),
        (
            "M48\nMETRIC\nT1C0.8\nT2C1.0\n%\nT1\nG82\nX1.0Y1.0\nT2\nX3.54Y8.62\nM30\n",
            "f.drl:8:1: a package of which only one",
        ),
        (
            "M48\nMETRIC\nT1C0.8\n%\nT1\nG82\nX1.0Y1.0\nG05\nX3.54Y8.62\nM30\n",
            "f.drl:7:1: a package of which only one",
        ),
        (
            "M48\nMETRIC\nT1C0.8\n%\nT1\nG82\nX1.0Y1.0\nG82\nX1.0Y1.0\nX3.54Y8.62\nM30\n",
            "f.drl:7:1: a package of which only one",
        ),
        (
            "M48\nMETRIC\nT1C0.8\n%\nT1\nG82\nX1.0Y1.0\nX3.0Y1.0G85X5.0Y1.0\nM30\n",
            "f.drl:7:1: a package of which only one",
        ),
        (
            "M48\nMETRIC\nT1C0.8\n%\nT1\nG82\nX1.0Y1.0\nR3X3.54Y8.62\nM30\n",
            "f.drl:8:1: R between the corners of a package",
        ),
        (
            "M48\nMETRIC\nT1C0.8\n%\nT1\nG00X1.0Y1.0\nM15\nG01X2.0Y1.0\nR3Y5.0\nM16\nM30\n",
            "f.drl:9:1: R repeats a hole, but here the router moves",
        ),
        (
            "M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0G84X1000\nM30\n",
            "f.drl:6:12: a circle too small for its drill",
        ),
        (
            "M48\nMETRIC\nT1C0.8\n%\nT1\nG32X1.0Y1.0A0.4\nM30\n",
            "f.drl:6:1: a circle too small for the router",
        ),
        ("M48\nMETRIC\nT1C0.8\n%\nT1\nX1.0Y1.0\nP3X1.0\nM30\n", "f.drl:7:1: P repeats a package"),
        (
            "M48\nMETRIC\nT1C0.8\n%\nM25\nT1\nX1.0Y1.0\nM01\nM02X5.0M70M80\nM30\n",
            "f.drl:9:1: swapped and mirrored axes",
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
        ("M48\nINCH\nT1C0.8\n%\nT1\nX1.0Y1.0\nM30\n", "drill-implausible"),
        ("M48\nINCH\nT1C0.03\n%\nM71\nT1\nX1.0Y1.0\nM30\n", "unit-changes"),
    ];
    for (text, code) in cases {
        let drilling = read(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
        assert!(codes(&drilling).contains(&code), "{text:?} gave {:?}", codes(&drilling));
    }
}

/// The corpus' drill files with what an independent reader found: holes, slots.
#[test]
fn drill_files_of_the_corpus_are_read() {
    let Some(folder) = corpus::boards() else { return };
    let index = fs::read(folder.join("syntax/INDEX.json")).expect("readable");
    let index: serde_json::Value = serde_json::from_slice(&index).expect("JSON");
    let entries = index.as_array().cloned().or_else(|| index["files"].as_array().cloned()).expect("a list");
    for entry in entries.iter().filter(|entry| entry["kind"] == "drill") {
        let name = entry["file"].as_str().expect("a name");
        let bytes = fs::read(folder.join("syntax").join(name)).expect("readable");
        let drilling =
            excellon::read(name, &bytes, &Context::default()).unwrap_or_else(|e| panic!("{}", e.render()));
        let slots = drilling.holes.iter().filter(|hole| hole.is_slot()).count() as u64;
        let holes = drilling.holes.len() as u64 - slots;
        assert_eq!(Some(holes), entry["n_hits"].as_u64(), "{name}: holes");
        assert_eq!(Some(slots), entry["n_slots"].as_u64(), "{name}: slots");
        // The independent reader counts repeated holes, but does not place them.
        if entry["reader_notes"].to_string().contains("repeat") {
            continue;
        }
        let Some(bounds) = entry["bbox_mm_at_assumed_format"].as_array() else { continue };
        let plain = drilling.holes.iter().filter(|hole| !hole.is_slot()).map(|hole| hole.path.start);
        let found = Rect::around(plain).expect("holes");
        let corners = [found.min().x, found.min().y, found.max().x, found.max().y];
        for (corner, expected) in corners.iter().zip(bounds) {
            let off = (corner.to_mm() - expected.as_f64().expect("a number")).abs();
            assert!(off < 0.001, "{name}: {corner} mm, expected {expected}");
        }
    }
}

#[test]
fn broken_drill_files_end_in_words() {
    let Some(folder) = corpus::boards() else { return };
    let cases = [
        ("drill_empty.drl", Err("the drill file is empty")),
        ("drill_no_holes.drl", Ok("drill-without-holes")),
        ("drill_undefined_tool.drl", Err("its diameter is not defined")),
        ("drill_truncated.drl", Ok("truncated-file")),
        ("drill_gerbv_bad_tool.exc", Ok("drill-without-holes")),
        ("drill_negative_diameter.drl", Err("a drill cannot have this diameter")),
        ("gerber_named_drl.drl", Err("a Gerber file where an Excellon drill file was expected")),
        ("garbage_random.gbr", Err("not an Excellon drill file")),
    ];
    for (name, expected) in cases {
        let Ok(bytes) = fs::read(folder.join("broken").join(name)) else { continue };
        match (excellon::read(name, &bytes, &Context::default()), expected) {
            (Ok(drilling), Ok(code)) => {
                assert!(codes(&drilling).contains(&code), "{name}: {:?}", codes(&drilling))
            }
            (Err(error), Err(text)) => assert!(error.to_string().contains(text), "{name}: {error}"),
            (found, _) => panic!("{name}: {found:?}"),
        }
    }
}

/// The fixtures, as seeds for damage.
fn seeds() -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/excellon");
    let mut paths: Vec<_> =
        fs::read_dir(folder).expect("readable").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths.iter().map(|path| fs::read(path).expect("readable")).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2_000, ..ProptestConfig::default() })]

    #[test]
    fn damage_never_panics(
        seed in 0..seeds().len(),
        cut in any::<prop::sample::Index>(),
        edits in prop::collection::vec((any::<prop::sample::Index>(), prop::sample::select(b"XYTRGMCAIJ0189.-+;%,/\r\n \0\xff".to_vec())), 0..8),
    ) {
        let mut bytes = seeds().swap_remove(seed);
        for (place, byte) in edits {
            let at = place.index(bytes.len());
            bytes[at] = byte;
        }
        let end = cut.index(bytes.len() * 2).min(bytes.len());
        match excellon::read("f.drl", &bytes[..end], &Context::default()) {
            Ok(drilling) => for hole in &drilling.holes {
                let bounds = hole.path.bounds();
                prop_assert!(hole.diameter > Nm::ZERO, "a hole of no size");
                prop_assert!(Nm::try_new(bounds.min().x.get()).is_ok() || hole.is_slot(), "a hole beyond a metre");
            },
            Err(error) => prop_assert!(!error.render().is_empty(), "an error without words"),
        }
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let text = [b"M48\nMETRIC\nT1C1.0\n%\nT1\n", bytes.as_slice()].concat();
        drop(excellon::read("f.drl", &text, &Context::default()));
        let _: bool = excellon::looks_like(&bytes);
    }
}

#[test]
fn repeats_without_end_are_refused_in_time() {
    let head = "M48\nINCH\nT01C0.05\n%\nT01\nX0Y0\n";
    for body in [
        "R4294967295X0\n",
        "M25\nX1Y1\nM01\nR4294967295M02X0Y0\n",
        "M25\nM01\nR4294967295M02X1Y1\nR4294967295X0\n",
    ] {
        let error = read(&format!("{head}{body}M30\n")).expect_err(body);
        assert!(error.contains("more than 2000000 holes"), "{body}: {error}");
    }
}

#[test]
fn g_code_is_no_drill_file() {
    let programs = [
        "G21\nG90\nG00 Z5\n",
        "G90 G94\nG17\nG21\n",
        "(made by hand)\nG00 Z5.0\nG01 X1 Y1\n",
        "G01 Z-1 F100\n",
    ];
    for text in programs {
        assert!(!excellon::looks_like(text.as_bytes()), "{text:?} was taken for a drill file");
    }
}

/// The fixtures that a table of `docs/excellon.md` names, and the files of the folder.
#[test]
fn every_fixture_stands_in_the_table_of_constructs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let table = fs::read_to_string(root.join("docs/excellon.md")).expect("readable");
    let rows = table.lines().filter(|line| line.starts_with("| "));
    let words = rows.flat_map(|row| row.split('`')).filter(|word| !word.contains([' ', ',', '#']));
    let mut named: Vec<&str> =
        words.filter(|word| [".drl", ".txt", ".tap"].iter().any(|end| word.ends_with(end))).collect();
    named.sort_unstable();
    named.dedup();
    let folder = fs::read_dir(root.join("fixtures/excellon")).expect("readable");
    let mut files: Vec<String> =
        folder.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name")).collect();
    files.sort();
    assert_eq!(named, files, "the table names every fixture, and only fixtures");
    for name in files {
        let bytes = fs::read(root.join("fixtures/excellon").join(&name)).expect("readable");
        let read = excellon::read(&name, &bytes, &Context::default());
        assert_eq!(read.is_err(), name.starts_with("error_"), "{name} is named for what it comes to");
    }
}

#[test]
fn packages_are_drilled_from_two_of_their_holes() {
    let holes = starts(&fixture("packages.drl"));
    assert_eq!(holes.len(), 16 + 16 + 8 + 8 + 1, "two packages of 16, one of 8, a round one, and a hole");
    let inch = |x: i64, y: i64| Point::new(Nm::new(x * 25_400), Nm::new(y * 25_400));
    assert_eq!(holes[..3], [inch(1000, 1000), inch(1100, 1000), inch(1200, 1000)], "along the row");
    assert_eq!(
        holes[7..9],
        [inch(1700, 1000), inch(1700, 1300)],
        "the row's end, and back from the other corner"
    );
    assert_eq!(holes[15], inch(1000, 1300), "the last lies beside the first");
    assert_eq!(holes[16], inch(1000, 2000), "the package again, an inch up");
    let rows: Vec<Point> = vec![inch(4000, 2150), inch(4000, 2100), inch(4000, 2050), inch(4000, 2000)];
    assert_eq!(holes[32..36], rows, "rows of its own pitch, downwards");
    let round = &holes[40..48];
    let middle = inch(6200, 1000);
    assert!(
        round.iter().all(|at| (at.distance(middle) - 5_080_000.0).abs() < 2.0),
        "0.2 inch from the middle: {round:?}"
    );
    assert_eq!(round[4], inch(6400, 1000), "the fifth lies opposite");
}

#[test]
fn circles_are_cut_by_drill_and_router() {
    let drilling = fixture("circles.drl");
    let rings: Vec<(Point, i64)> = drilling.holes[..3]
        .iter()
        .map(|hole| {
            let bounds = hole.path.bounds();
            let middle =
                Point::new((bounds.min().x + bounds.max().x) / 2, (bounds.min().y + bounds.max().y) / 2);
            (middle, (hole.bounds().width().get() + 500) / 1000)
        })
        .collect();
    let expected = [(at(10_000, 10_000), 5_000), (at(20_000, 10_000), 8_000), (at(30_000, 10_000), 8_000)];
    assert_eq!(rings, expected, "as wide as said, the second radius as the first");
    let half = &drilling.holes[3].path;
    let expected = std::f64::consts::PI * 1e6;
    assert!((half.length() - expected).abs() < 10.0, "offsets counted from the centre: {}", half.length());
}

#[test]
fn patterns_are_swapped_and_mirrored_and_nested() {
    let drilling = fixture("patterns.drl");
    let holes = starts(&drilling);
    assert_eq!(holes.len(), 2 * 3 * 2, "a hole and an arc, swapped, mirrored, and all of it again");
    assert_eq!(holes[2], at(12_000, 1_000), "X for Y");
    assert_eq!(holes[4], at(19_000, 2_000), "-X, twice as far");
    assert_eq!(holes[6], at(1_000, 102_000), "all of it, up");
    let quarter = std::f64::consts::FRAC_PI_2 * 1e6;
    let arcs = drilling.holes.iter().filter(|hole| hole.is_slot());
    assert!(arcs.clone().count() == 6, "six arcs");
    for arc in arcs {
        assert!((arc.path.length() - quarter).abs() < 10.0, "a quarter still: {:?}", arc.path);
    }
}

#[test]
fn the_codes_of_format_1_are_known() {
    let mils = |x: i64, y: i64| Point::new(Nm::new(x * 25_400), Nm::new(y * 25_400));
    let expected = [mils(1000, 1000), mils(1500, 1000), mils(2000, 1000), mils(2000, 0)];
    assert_eq!(starts(&fixture("format_1.drl")), expected, "two further, and one mirrored below");
}

#[test]
fn a_line_that_lost_its_end_is_not_drilled() {
    let drilling = fixture("cut_off.drl");
    assert_eq!(starts(&drilling), [at(10_500, 20_250)], "the whole line alone");
    assert_eq!(codes(&drilling), ["truncated-file"], "and says so");
}

/// The header only says which tools there are.
#[test]
fn holes_before_the_body_names_one_of_several_tools_are_refused() {
    let file = |tools: &str, body: &str| read(&format!("M48\nMETRIC\n{tools}%\n{body}X1.0Y2.0\nM30\n"));
    let two = "T1C0.8\nT2C1.2\n";
    let refused = file(two, "").expect_err("nobody knows with which");
    assert!(refused.contains("a hole is drilled before any tool is selected"), "{refused}");
    let diameter = |tools: &str, body: &str| file(tools, body).expect("a drill file").holes[0].diameter;
    assert_eq!(diameter(two, "T1\n"), Nm::from_um(800));
    assert_eq!(diameter("T1C0.8\n", ""), Nm::from_um(800), "there is no other");
}
