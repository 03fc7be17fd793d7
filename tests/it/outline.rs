//! The board's edge: loose lines and arcs become closed contours.

use std::fs;
use std::path::PathBuf;

use proptest::prelude::*;
use voromill::board::{Shape, polarity};
use voromill::geometry::{Nm, Path, Point, Polygon, Segment};
use voromill::import::gerber;
use voromill::import::outline::{GAP, Joined, join};

use crate::cases;
use crate::corpus;

/// A profile layer with `body` behind its header: coordinates in micrometres, D10 of no width.
fn joined(body: &str) -> Joined {
    joined_in("FSLAX33Y33", body)
}

/// A profile layer with `body` behind its header: coordinates as it says, D10 of no width.
fn joined_in(format: &str, body: &str) -> Joined {
    let text = format!("%{format}*%\n%MOMM*%\n%ADD10C,0*%\nG75*\nG01*\nD10*\n{body}\nM02*\n");
    let image = gerber::read("edge.gbr", text.as_bytes(), &gerber::Options::default());
    let image = image.unwrap_or_else(|error| panic!("{}", error.render()));
    join("edge.gbr", text.as_bytes(), &image.features, GAP)
}

/// As [`joined`], of coordinates in nanometres.
fn joined_finely(body: &str) -> Joined {
    joined_in("FSLAX46Y46", body)
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
    assert!(joined.warnings[0].message.starts_with("a gap of 0.450 mm"), "{}", joined.warnings[0].message);
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
    // Beyond a tenth of a millimetre they are the two sides of a line.
    for (apart, contours) in [(2, 1), (20, 1), (99, 1), (101, 1), (490, 1), (510, 2)] {
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
    let twice = joined(&format!("X0Y0D02*\nX0Y0D01*\n{}", lines(&SQUARE)));
    assert_eq!((areas(&twice), codes(&twice)), (vec![10_000], vec![]), "a corner that is there twice");
    let dot = joined(&format!("X5000Y5000D02*\nX5000Y5000D01*\n{}", lines(&SQUARE)));
    assert_eq!(codes(&dot), ["outline-flashes"], "a dot beside the lines is perhaps a hole");
    assert!(flash.outline.is_none(), "and nothing else");
}

/// A filled rectangle.
fn region([left, bottom, right, top]: [i64; 4]) -> String {
    format!(
        "G36*\nX{left}Y{bottom}D02*\nX{right}Y{bottom}D01*\nX{right}Y{top}D01*\nX{left}Y{top}D01*\n\
         X{left}Y{bottom}D01*\nG37*\n"
    )
}

#[test]
fn filled_areas_that_overlap_are_one_board() {
    let filled = |areas: &[[i64; 4]]| areas.iter().copied().map(region).collect::<String>();
    let cases: [(&str, String, &[i64], &[&str]); 6] = [
        ("an L", filled(&[[0, 0, 10_000, 2000], [0, 0, 2000, 10_000]]), &[3600], &["outline-parted"]),
        (
            "a step",
            filled(&[[0, 0, 10_000, 5000], [5000, 2500, 15_000, 9000]]),
            &[10_250],
            &["outline-parted"],
        ),
        (
            "a frame of four bars",
            filled(&[
                [0, 0, 10_000, 1000],
                [0, 9000, 10_000, 10_000],
                [0, 0, 1000, 10_000],
                [9000, 0, 10_000, 10_000],
            ]),
            &[10_000, 6400],
            &["outline-parted"],
        ),
        (
            "one within another",
            filled(&[[0, 0, 10_000, 10_000], [2000, 2000, 8000, 8000]]),
            &[10_000, 3600],
            &[],
        ),
        ("two beside each other", filled(&[[0, 0, 5000, 5000], [6000, 0, 9000, 5000]]), &[2500, 1500], &[]),
        (
            "an area across what lines enclose",
            lines(&SQUARE) + &region([500, 500, 12_000, 12_000]),
            &[10_000 + 13_225 - 9025],
            &["outline-parted"],
        ),
    ];
    for (what, body, expected, warnings) in cases {
        let joined = joined(&body);
        assert_eq!((areas(&joined).as_slice(), codes(&joined).as_slice()), (expected, warnings), "{what}");
    }
}

#[test]
fn outlines_of_the_corpus_close() {
    let Some(folder) = corpus::boards() else { return };
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

/// A place or a length, off by a nanometre as well as by thirty micrometres.
fn off() -> impl Strategy<Value = i64> {
    (0..15_u32, -1.0..1.0_f64)
        .prop_map(|(scale, share)| Nm::from_f64(share * f64::from(2_u32 << scale)).get())
}

proptest! {
    #![proptest_config(cases::same(500, 41))]

    /// A hole that a footprint and a drawing both have, each rounded otherwise.
    #[test]
    fn circles_drawn_nearly_twice_become_what_they_cover(
        radius in 300_000..3_000_000_i64,
        circles in prop::collection::vec((off(), off(), off(), 0.0..6.3_f64), 2..4),
    ) {
        let circle = |&(x, y, larger, start): &(i64, i64, i64, f64)| {
            let (sine, cosine) = libm::sincos(start);
            let part = |share: f64| Nm::from_f64(Nm::new(radius + larger).to_f64() * share).get();
            (x, y, part(cosine), part(sine))
        };
        let circles: Vec<(i64, i64, i64, i64)> = circles.iter().map(circle).collect();
        let draw = |&(x, y, i, j): &(i64, i64, i64, i64)| {
            let (from_x, from_y) = (x + i, y + j);
            format!("X{from_x}Y{from_y}D02*\nG03*\nX{from_x}Y{from_y}I{}J{}D01*\n", -i, -j)
        };
        let joined = joined_finely(&circles.iter().map(draw).collect::<String>());
        let disc = |&(x, y, i, j): &(i64, i64, i64, i64)| {
            let radius = Nm::from_f64(libm::hypot(Nm::new(i).to_f64(), Nm::new(j).to_f64()));
            Polygon::disc(Point::new(Nm::new(x), Nm::new(y)), radius, Nm::new(250)).expect("a disc")
        };
        let discs: Vec<Polygon> = circles.iter().map(disc).collect();
        let expected: f64 = polarity::union(&discs).iter().map(Polygon::area_mm2).sum();
        let contours = joined.outline.iter().flat_map(|outline| outline.contours());
        let found: Vec<f64> = contours.map(area).collect();
        prop_assert_eq!(found.len(), 1, "one contour of {} mm²: {:?}", expected, found);
        // As much as two micrometres all round.
        let slack = 2e-3 * 6.3 * Nm::new(radius).to_mm();
        prop_assert!((found[0] - expected).abs() < slack, "{} mm² of {} mm²", found[0], expected);
    }
}

proptest! {
    #![proptest_config(cases::same(500, 41))]

    /// The edge of a board on two layers of one export, its corners rounded otherwise on each.
    #[test]
    fn edges_drawn_nearly_twice_become_what_they_cover(
        corners in prop::collection::vec((2_000_000..9_000_000_i64, off(), off()), 3..9),
        begin in 0..9_usize,
    ) {
        let step = std::f64::consts::TAU / Nm::new(i64::try_from(corners.len()).expect("a few")).to_f64();
        let at = |index: usize, far: i64| {
            let (sine, cosine) = libm::sincos(step * Nm::new(i64::try_from(index).expect("a few")).to_f64());
            [cosine, sine].map(|part| Nm::from_f64(Nm::new(far).to_f64() * part).get())
        };
        let first: Vec<[i64; 2]> = corners.iter().enumerate().map(|(i, corner)| at(i, corner.0)).collect();
        let second = || first.iter().zip(&corners).map(|(&[x, y], &(_, right, up))| [x + right, y + up]);
        let mut second: Vec<[i64; 2]> = second().collect();
        let turned = begin % second.len();
        second.rotate_left(turned);
        let draw = |ring: &[[i64; 2]]| {
            let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
            lines(&pairs.map(|(&[a, b], &[c, d])| [a, b, c, d]).collect::<Vec<_>>())
        };
        let joined = joined_finely(&(draw(&first) + &draw(&second)));
        let polygon = |ring: &[[i64; 2]]| {
            Polygon::new(vec![ring.iter().map(|&[x, y]| Point::new(Nm::new(x), Nm::new(y))).collect()])
        };
        let rings: Vec<Polygon> = [&first, &second].into_iter().filter_map(|ring| polygon(ring)).collect();
        let hole_less = |polygon: &Polygon| Polygon::new(vec![polygon.contours()[0].clone()]);
        let expected: f64 =
            polarity::union(&rings).iter().filter_map(hole_less).map(|ring| ring.area_mm2()).sum();
        let contours = joined.outline.iter().flat_map(|outline| outline.contours());
        let found: Vec<f64> = contours.map(area).collect();
        prop_assert_eq!(found.len(), 1, "one contour of {} mm²: {:?}", expected, found);
        let perimeter: f64 = rings[0].perimeter() / 1e6;
        prop_assert!((found[0] - expected).abs() < 2e-3 * perimeter, "{} mm² of {} mm²", found[0], expected);
    }
}

proptest! {
    #![proptest_config(cases::same(500, 41))]

    /// Slots of which a footprint and a drawing both have the edge, each moved and turned by
    /// little.
    #[test]
    fn slots_drawn_nearly_twice_become_what_they_cover(
        length in 300_000..5_000_000_i64,
        radius in 300_000..2_000_000_i64,
        slots in prop::collection::vec((off(), off(), off(), off(), 0..2_usize), 2..4),
    ) {
        // Each by the middles of its ends, its radius, and which of its parts is drawn first.
        let ends = |&(x, y, turned, wider, _): &(i64, i64, i64, i64, usize)| {
            ([x, y], [x + length, y + turned], radius + wider)
        };
        let corners = |slot: &(i64, i64, i64, i64, usize)| {
            let ([ax, ay], [bx, by], radius) = ends(slot);
            let (x, y) = (Nm::new(bx - ax).to_f64(), Nm::new(by - ay).to_f64());
            let reach = Nm::new(radius).to_f64() / libm::hypot(x, y);
            let (x, y) = (Nm::from_f64(-y * reach).get(), Nm::from_f64(x * reach).get());
            [[ax + x, ay + y], [ax - x, ay - y], [bx - x, by - y], [bx + x, by + y]]
        };
        let draw = |slot: &(i64, i64, i64, i64, usize)| {
            let (a, b, _) = ends(slot);
            let [first, second, third, fourth] = corners(slot);
            let arc = |from: [i64; 2], to: [i64; 2], center: [i64; 2]| {
                let [i, j] = [center[0] - from[0], center[1] - from[1]];
                format!(
                    "X{}Y{}D02*\nG03*\nX{}Y{}I{i}J{j}D01*\nG01*\n",
                    from[0], from[1], to[0], to[1]
                )
            };
            let line = |from: [i64; 2], to: [i64; 2]| lines(&[[from[0], from[1], to[0], to[1]]]);
            let mut parts =
                [arc(first, second, a), line(second, third), arc(third, fourth, b), line(fourth, first)];
            parts.rotate_left(slot.4);
            parts.concat()
        };
        let joined = joined_finely(&slots.iter().map(draw).collect::<String>());
        let stroke = |slot: &(i64, i64, i64, i64, usize)| {
            let ([ax, ay], [bx, by], radius) = ends(slot);
            let [from, to] = [[ax, ay], [bx, by]].map(|[x, y]| Point::new(Nm::new(x), Nm::new(y)));
            Shape::Stroke { from, to, radius: Nm::new(radius) }.polygon(Nm::new(250)).expect("a slot")
        };
        let strokes: Vec<Polygon> = slots.iter().map(stroke).collect();
        let expected: f64 = polarity::union(&strokes).iter().map(Polygon::area_mm2).sum();
        let contours = joined.outline.iter().flat_map(|outline| outline.contours());
        let found: Vec<f64> = contours.map(area).collect();
        prop_assert_eq!(found.len(), 1, "one contour of {} mm²: {:?}", expected, found);
        let slack = 2e-3 * strokes[0].perimeter() / 1e6;
        prop_assert!((found[0] - expected).abs() < slack, "{} mm² of {} mm²", found[0], expected);
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
