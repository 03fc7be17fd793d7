//! The board's edge: loose lines and arcs become closed contours.

use std::fs;
use std::path::PathBuf;

use proptest::prelude::*;
use voromill::geometry::{Nm, Path, Polygon, Segment};
use voromill::import::gerber;
use voromill::import::outline::{GAP, Joined, join};

/// A profile layer with `body` behind its header: coordinates in micrometres, D10 of no width.
fn joined(body: &str) -> Joined {
    let text = format!("%FSLAX33Y33*%\n%MOMM*%\n%ADD10C,0*%\nG75*\nG01*\nD10*\n{body}\nM02*\n");
    let image = gerber::read("edge.gbr", text.as_bytes(), &gerber::Options::default());
    let image = image.unwrap_or_else(|error| panic!("{}", error.render()));
    join("edge.gbr", text.as_bytes(), &image.features, GAP)
}

/// A profile layer of `fixtures/outline`.
fn fixture(name: &str) -> Joined {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fixtures/outline").join(name);
    let bytes = fs::read(path).expect("a fixture");
    let image = gerber::read(name, &bytes, &gerber::Options::default()).expect("it reads");
    join(name, &bytes, &image.features, GAP)
}

/// Lines between the corners, each drawn for itself.
fn lines(pairs: &[[i64; 4]]) -> String {
    pairs.iter().map(|[a, b, c, d]| format!("X{a}Y{b}D02*\nX{c}Y{d}D01*\n")).collect()
}

fn area(contour: &Path) -> f64 {
    let mut points = contour.flatten(Nm::new(250));
    points.pop();
    Polygon::new(vec![points]).map_or(0.0, |polygon| polygon.area_mm2())
}

/// The areas of all contours in mm², the largest first, rounded to hundredths.
fn areas(joined: &Joined) -> Vec<i64> {
    let contours = joined.outline.iter().flat_map(|outline| outline.contours());
    let mut areas: Vec<i64> =
        contours.map(|contour| Nm::from_f64(area(contour).abs() * 100.0).get()).collect();
    areas.sort_by(|a, b| b.cmp(a));
    areas
}

fn codes(joined: &Joined) -> Vec<&'static str> {
    joined.warnings.iter().map(|warning| warning.code()).collect()
}

const SQUARE: [[i64; 4]; 4] =
    [[0, 0, 10_000, 0], [10_000, 10_000, 10_000, 0], [0, 10_000, 0, 0], [0, 10_000, 10_000, 10_000]];

#[test]
fn order_and_direction_do_not_matter() {
    let joined = joined(&lines(&SQUARE));
    assert_eq!((areas(&joined), codes(&joined)), (vec![10_000], vec![]), "one square of 100 mm²");
    let outline = joined.outline.expect("an outline");
    assert!(area(&outline.contours()[0]) > 0.0, "counter-clockwise");
    assert_eq!(outline.contours()[0].segments.len(), 4, "four sides");
}

#[test]
fn small_gaps_are_closed_and_wide_ones_are_not() {
    let with_gap = |gap: i64| {
        let mut sides = SQUARE;
        sides[0][2] -= gap;
        joined(&lines(&sides))
    };
    assert_eq!(
        (areas(&with_gap(2)).len(), codes(&with_gap(2))),
        (1, vec![]),
        "a rounding is not worth a word"
    );
    let joined = with_gap(80);
    assert_eq!((areas(&joined).len(), codes(&joined)), (1, vec!["outline-gap"]), "0.08 mm is closed");
    assert!(joined.warnings[0].message.contains("0.080 mm"), "{}", joined.warnings[0].message);
    assert!(joined.warnings[0].at.is_some(), "with its place");
    let joined = with_gap(500);
    assert_eq!(codes(&joined), ["outline-loose-lines", "outline-open"], "0.5 mm is not");
    assert!(joined.outline.is_none(), "and there is no edge");
}

#[test]
fn gaps_are_closed_where_the_strokes_touch() {
    let joined = fixture("strokes_touch.gbr");
    assert_eq!(
        (areas(&joined), codes(&joined)),
        (vec![10_000], vec!["outline-gap"]),
        "0.45 mm, drawn 0.5 mm wide"
    );
    assert!(joined.warnings[0].message.contains("1 gaps"), "{}", joined.warnings[0].message);
    let joined = fixture("strokes_apart.gbr");
    assert_eq!(codes(&joined), ["outline-loose-lines", "outline-open"], "0.55 mm, drawn as wide");
}

#[test]
fn an_end_that_touches_the_middle_of_a_stroke_is_joined_to_it() {
    let joined = fixture("strokes_tee.gbr");
    assert_eq!(
        (areas(&joined), codes(&joined)),
        (vec![10_000], vec!["outline-loose-lines", "outline-gap"]),
        "the square, without what is drawn too far"
    );
    let message = &joined.warnings[1].message;
    assert!(message.starts_with("1 ends") && message.ends_with("0.300 mm"), "{message}");
}

#[test]
fn an_end_beyond_the_middle_of_a_stroke_adds_nothing_to_the_board() {
    // The upper side runs over the right one by 0.2 mm, straight or slanted.
    for over in [[0, 10_000, 10_200, 10_000], [0, 10_000, 10_150, 10_100]] {
        let sides = [[0, 10_000, 0, 0], [0, 0, 10_000, 0], [10_000, 0, 10_000, 14_000], over];
        let joined = joined(&format!("%ADD11C,0.5*%\nD11*\n{}", lines(&sides)));
        let area = areas(&joined);
        assert!(matches!(area[..], [10_000..=10_050]), "the square: {area:?}");
    }
}

#[test]
fn lines_drawn_twice_or_on_each_other_count_once() {
    let doubled = format!(
        "{}{}{}",
        lines(&SQUARE),
        lines(&SQUARE),
        lines(&[[2_000, 0, 6_000, 0], [5_000, 0, 12_000, 0]])
    );
    let joined = joined(&doubled);
    assert_eq!((areas(&joined), codes(&joined)), (vec![10_000], vec!["outline-loose-lines"]), "one square");
}

#[test]
fn an_edge_drawn_twice_a_little_apart_is_one_edge() {
    let square = |inset: i64| {
        let (low, high) = (inset, 10_000 - inset);
        lines(&[
            [low, low, high, low],
            [high, low, high, high],
            [high, high, low, high],
            [low, high, low, low],
        ])
    };
    let hole =
        |radius: i64| format!("X{0}Y5000D02*\nG03*\nX{0}Y5000I-{radius}J0D01*\nG01*\n", 5_000 + radius);
    for (apart, contours) in [(2, 1), (20, 1), (99, 1), (101, 2)] {
        let edge = joined(&(square(0) + &square(apart)));
        assert_eq!(areas(&edge).len(), contours, "squares {apart} µm apart");
        let cut_out = joined(&(square(0) + &hole(1_000) + &hole(1_000 - apart)));
        assert_eq!(areas(&cut_out).len(), contours + 1, "holes {apart} µm apart");
        assert_eq!(codes(&cut_out).len(), 2 - contours, "it is told: {:?}", cut_out.warnings);
    }
    let double = joined(&(square(0) + &square(10)));
    assert_eq!((areas(&double), codes(&double)), (vec![10_000], vec!["outline-parted"]), "the outer one");
}

#[test]
fn lines_that_cross_enclose_what_lies_between_them() {
    let hash = [
        [-1_000, 0, 11_000, 0],
        [-1_000, 10_000, 11_000, 10_000],
        [0, -1_000, 0, 11_000],
        [10_000, -1_000, 10_000, 11_000],
    ];
    let joined = joined(&lines(&hash));
    assert_eq!(
        (areas(&joined), codes(&joined)),
        (vec![10_000], vec!["outline-loose-lines"]),
        "the ends fall off"
    );
}

#[test]
fn a_line_across_parts_nothing() {
    let joined = joined(&(lines(&SQUARE) + &lines(&[[5_000, 0, 5_000, 10_000]])));
    assert_eq!(
        (areas(&joined), codes(&joined)),
        (vec![10_000], vec!["outline-parted"]),
        "the outer edge only"
    );
}

#[test]
fn boards_cut_outs_and_lettering_are_told_apart() {
    let inside =
        lines(&[[2_000, 2_000, 4_000, 2_000], [4_000, 2_000, 3_000, 4_000], [3_000, 4_000, 2_000, 2_000]]);
    let beside = lines(&[[20_000, 0, 21_000, 0], [21_000, 0, 21_000, 1_000], [21_000, 1_000, 20_000, 0]]);
    let joined = joined(&(lines(&SQUARE) + &inside + &beside));
    assert_eq!(
        (areas(&joined), codes(&joined)),
        (vec![10_000, 200], vec!["outline-lettering"]),
        "board and cut-out"
    );
}

#[test]
fn arcs_stay_arcs() {
    let whole = joined("X5000Y0D02*\nG03*\nX5000Y0I-5000J0D01*");
    assert_eq!(areas(&whole), [7_853], "a full circle, less what chords of 0.25 µm lose");
    let halves = joined("X5000Y0D02*\nG03*\nX-5000Y0I-5000J0D01*\nX5000Y0D02*\nG02*\nX-5000Y0I-5000J0D01*");
    assert_eq!(areas(&halves), [7_853], "two halves, drawn apart");
    let almost = joined("X5000Y0D02*\nG03*\nX5000Y-20I-5000J0D01*");
    assert_eq!(
        (areas(&almost).len(), codes(&almost)),
        (1, vec!["outline-gap"]),
        "one that does not quite close"
    );
    for joined in [whole, halves, almost] {
        let outline = joined.outline.expect("an outline");
        let arcs = outline.contours()[0].segments.iter().all(|s| matches!(s, Segment::Arc { .. }));
        assert!(arcs, "no chord: {outline:?}");
    }
}

#[test]
fn a_circle_across_the_edge_is_a_notch_or_an_ear() {
    // A circle of radius 2 mm about the middle of the right side: what both cover is the board.
    let notched = joined(&(lines(&SQUARE) + "X12000Y5000D02*\nG03*\nX12000Y5000I-2000J0D01*\n"));
    assert_eq!(
        (areas(&notched), codes(&notched)),
        (vec![10_628], vec!["outline-parted"]),
        "100 + π·2²/2 mm²"
    );
    let apart = joined("X5000Y0D02*\nG03*\nX5000Y0I-5000J0D01*\nX11000Y0D02*\nG03*\nX11000Y0I-5000J0D01*\n");
    assert_eq!((areas(&apart).len(), codes(&apart)), (1, vec!["outline-parted"]), "two circles that overlap");
}

#[test]
fn a_region_is_an_edge_and_a_flash_is_none() {
    let region = joined("G36*\nX0Y0D02*\nX10000Y0D01*\nX10000Y10000D01*\nX0Y10000D01*\nX0Y0D01*\nG37*");
    assert_eq!((areas(&region), codes(&region)), (vec![10_000], vec![]), "its contour");
    let flash = joined("X0Y0D03*");
    assert_eq!(codes(&flash), ["outline-flashes", "outline-empty"], "a flash");
    assert!(flash.outline.is_none(), "and nothing else");
}

#[test]
fn outlines_of_the_corpus_close() {
    let folder =
        std::env::var_os("VOROMILL_BOARDS").map_or_else(|| PathBuf::from("../shared/boards"), PathBuf::from);
    let cases: [(&str, &[i64], &[&str]); 10] = [
        (
            "syntax/p2gboard__edge-cuts-broken-loop__edge-cuts-Edge.Cuts.gbr",
            &[],
            &["outline-loose-lines", "outline-open"],
        ),
        ("syntax/p2gboard__edge-cuts-inside-cuts__edge-cuts-Edge.Cuts.gbr", &[24_839, 1_152], &[]),
        ("syntax/p2gboard__multi_outline__multi_outline-Edge.Cuts.gbr", &[58_710, 8_065], &[]),
        (
            "syntax/p2gboard__overlapping_edge_cuts__Edge.Cuts.gbr",
            &[193_548, 11_613, 7_581, 5_806, 5_806],
            &["outline-loose-lines", "outline-parted"],
        ),
        ("syntax/p2gboard__round_outline__round_outline-Edge.Cuts.gbr", &[12_667], &[]),
        ("syntax/p2gboard__shaped_pcb__shaped_pcb-Edge.Cuts.gbr", &[117_338, 10_564], &[]),
        ("broken/p2g_broken_box.gbr", &[208_604], &[]),
        ("broken/p2g_broken_loop_edge_cuts.gbr", &[], &["outline-loose-lines", "outline-open"]),
        ("broken/p2g_edge_cuts_empty.gbr", &[], &["outline-empty"]),
        ("broken/p2g_unclosed_contour.gbr", &[6_451_600, 2_064_512], &[]),
    ];
    for (name, expected, warnings) in cases {
        let Ok(bytes) = fs::read(folder.join(name)) else { continue };
        let image = gerber::read(name, &bytes, &gerber::Options::default()).expect(name);
        let joined = join(name, &bytes, &image.features, GAP);
        assert_eq!(areas(&joined), expected, "{name}: areas");
        assert_eq!(codes(&joined), warnings, "{name}: warnings");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, ..ProptestConfig::default() })]

    /// On a coarse grid lines meet, cross and lie on each other all the time.
    #[test]
    fn whatever_is_drawn_the_contours_close(
        steps in prop::collection::vec((0_i64..8, 0_i64..8, 0_i64..8, 0_i64..8, 0_i64..6, -4_i64..4, -4_i64..4), 0..30),
    ) {
        let draw = |&(a, b, c, d, how, i, j): &(i64, i64, i64, i64, i64, i64, i64)| {
            let (code, i, j) = match how {
                0 => ("G02", format!("I{}", i * 500), format!("J{}", j * 500)),
                1 => ("G03", format!("I{}", i * 500), format!("J{}", j * 500)),
                _ => ("G01", String::new(), String::new()),
            };
            format!("X{}Y{}D02*\n{code}*\nX{}Y{}{i}{j}D01*\n", a * 1000, b * 1000, c * 1000, d * 1000)
        };
        let body: String = steps.iter().map(draw).collect();
        let first = joined(&body);
        for contour in first.outline.iter().flat_map(|outline| outline.contours()) {
            prop_assert!(contour.is_closed(), "open: {contour:?}");
        }
        prop_assert_eq!(areas(&first), areas(&joined(&body)), "the same twice");
    }
}

/// A hundred thousand lines that meet nothing: spread, in one chain, and all in one place.
#[test]
fn a_drawing_of_loose_lines_is_done_soon() {
    const MANY: i64 = 100_000;
    let spread = (0..MANY).map(|i| [i % 300 * 900, i / 300 * 900, i % 300 * 900 + 400, i / 300 * 900 + 300]);
    let corner = |i: i64| {
        let (row, along) = (i / 300, i % 300);
        (if row % 2 == 0 { along } else { 299 - along } * 300, row * 300)
    };
    let chain = (0..MANY).map(|i| [corner(i).0, corner(i).1, corner(i + 1).0, corner(i + 1).1]);
    let heap = (0..MANY).map(|i| [i % 300 * 5, i / 300 * 5, i % 300 * 5 + 50_000, i / 300 * 5 + 20_000]);
    for (name, drawn) in [("spread", spread.collect::<Vec<_>>()), ("chain", chain.collect())] {
        let joined = joined(&lines(&drawn));
        assert!(joined.outline.is_none(), "{name}: nothing closes");
        assert!(codes(&joined).contains(&"outline-loose-lines"), "{name}: {:?}", codes(&joined));
    }
    let joined = joined(&lines(&heap.collect::<Vec<_>>()));
    assert!(
        codes(&joined).contains(&"outline-gap"),
        "in a heap all ends are near others: {:?}",
        codes(&joined)
    );
}
