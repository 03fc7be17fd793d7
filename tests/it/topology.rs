//! Which features conduct: exact contact against rational arithmetic, coincidence, names, holes,
//! gaps.

use std::fs;
use std::path::Path as FilePath;

use proptest::prelude::*;
use serde_json::Value;

use voromill::board::{Attributes, Axis, Copper, Feature, Hole, Plating, Shape, Side};
use voromill::geometry::{Arc, Nm, Path, Point, Polygon, Rect, Turn};
use voromill::grid::Grid;
use voromill::import::{self, gerber};
use voromill::topology::{self, Method, NetId, Nets, Reason, Sampling};

use crate::corpus::board_folders;

fn at(x: i64, y: i64) -> Point {
    Point::new(Nm::new(x), Nm::new(y))
}

fn disc(x: i64, y: i64, radius: i64) -> Shape {
    Shape::Disc { center: at(x, y), radius: Nm::new(radius) }
}

fn stroke(from: (i64, i64), to: (i64, i64), radius: i64) -> Shape {
    Shape::Stroke { from: at(from.0, from.1), to: at(to.0, to.1), radius: Nm::new(radius) }
}

fn polygon(contours: &[&[(i64, i64)]]) -> Shape {
    let rings = contours.iter().map(|ring| ring.iter().map(|&(x, y)| at(x, y)).collect()).collect();
    Shape::Polygon(Polygon::new(rings).expect("three points"))
}

/// An arc counter-clockwise about (0, 0), moved by `by`.
fn arc(start: (i64, i64), end: (i64, i64), by: (i64, i64), radius: i64) -> Shape {
    let point = |p: (i64, i64)| at(p.0 + by.0, p.1 + by.1);
    let arc =
        Arc { start: point(start), end: point(end), center: at(by.0, by.1), turn: Turn::CounterClockwise };
    Shape::Arc { arc, radius: Nm::new(radius) }
}

fn axis(shape: &Shape) -> Axis {
    match shape {
        Shape::Disc { center, .. } => Axis::Flash(*center),
        Shape::Stroke { from, to, .. } => Axis::Line(*from, *to),
        Shape::Arc { arc, .. } => Axis::Arc(*arc),
        Shape::Polygon(_) => Axis::Region,
    }
}

fn copper(shapes: Vec<Shape>) -> Copper {
    let features =
        shapes.into_iter().map(|shape| Feature { axis: axis(&shape), shape, attributes: 0, line: 1 });
    Copper { side: Side::Front, features: features.collect(), attributes: vec![Attributes::default()] }
}

/// How many nets two shapes are: 1 where they touch.
fn touch(a: &Shape, b: &Shape) -> bool {
    let both = [
        topology::recover(&copper(vec![a.clone(), b.clone()]), Method::Contact),
        topology::recover(&copper(vec![b.clone(), a.clone()]), Method::Contact),
    ];
    assert_eq!(both[0].nets().len(), both[1].nets().len(), "the order decided: {a:?} {b:?}");
    both[0].nets().len() == 1
}

/// As [`touch`], of shapes so much larger that copper no farther apart than one of their units is
/// joined.
fn meet(a: &Shape, b: &Shape) -> bool {
    touch(&scale_up(a, JOINED), &scale_up(b, JOINED))
}

/// Copper no farther apart than this, in nanometres, is joined.
const JOINED: i64 = 250;

#[test]
fn copper_a_quarter_of_a_micrometre_apart_is_joined_and_no_other() {
    let square: &[(i64, i64)] = &[(0, 0), (1000, 0), (1000, 1000), (0, 1000)];
    let edge = |x: i64| polygon(&[&[(x, -500), (x + 900, 0), (x, 5000)]]);
    for (what, one, beside) in [
        ("discs", disc(900, 500, 100), (|x| disc(x + 50, 500, 50)) as fn(i64) -> Shape),
        ("strokes", stroke((0, 500), (900, 500), 100), |x| stroke((x + 7, -500), (x + 7, 5000), 7)),
        ("a polygon and a disc", polygon(&[square]), |x| disc(x + 50, 500, 50)),
        ("a polygon and a stroke", polygon(&[square]), |x| stroke((x + 5, 5), (x + 50, 70), 5)),
    ] {
        for other in [beside, edge] {
            assert!(touch(&one, &other(1000 + JOINED)), "{what}");
            assert!(!touch(&one, &other(1001 + JOINED)), "{what}, a nanometre farther");
        }
    }
}

#[test]
fn touching_counts_and_a_gap_does_not() {
    let big = 100_000;
    let square: &[(i64, i64)] = &[(0, 0), (100, 0), (100, 100), (0, 100)];
    let cases: &[(&str, Shape, Shape, Shape)] = &[
        ("disc and disc", disc(0, 0, 30), disc(50, 0, 20), disc(51, 0, 20)),
        ("disc and disc, aslant", disc(0, 0, 3), disc(3, 4, 2), disc(4, 4, 2)),
        (
            "a disc and a stroke's side",
            stroke((0, 0), (300, 400), 5),
            disc(150 + 8, 200 - 6, 5),
            disc(150 + 9, 200 - 7, 5),
        ),
        ("a disc and a stroke's end", stroke((0, 0), (100, 0), 5), disc(110, 0, 5), disc(111, 0, 5)),
        (
            "strokes side by side",
            stroke((0, 0), (100, 0), 5),
            stroke((50, 10), (500, 10), 5),
            stroke((50, 11), (500, 11), 5),
        ),
        (
            "strokes that cross",
            stroke((0, 0), (100, 100), 0),
            stroke((0, 100), (100, 0), 0),
            stroke((0, 100), (49, 52), 0),
        ),
        (
            "far strokes",
            stroke((-big, -big), (big, big), 1),
            stroke((-big, big), (0, 2), 1),
            stroke((-big, big), (-2, 2), 1),
        ),
        ("a disc and a polygon's edge", polygon(&[square]), disc(110, 50, 10), disc(111, 50, 10)),
        ("a disc and a polygon's corner", polygon(&[square]), disc(103, 104, 5), disc(104, 104, 5)),
        ("a disc inside a polygon", polygon(&[square]), disc(50, 50, 1), disc(50, 150, 1)),
        (
            "polygons",
            polygon(&[square]),
            polygon(&[&[(100, 100), (200, 100), (200, 200)]]),
            polygon(&[&[(101, 100), (200, 100), (200, 200)]]),
        ),
        (
            "a polygon in a polygon",
            polygon(&[square]),
            polygon(&[&[(10, 10), (20, 10), (20, 20)]]),
            polygon(&[&[(110, 10), (120, 10), (120, 20)]]),
        ),
        (
            "a disc and an arc from outside",
            arc((65, 0), (0, 65), (0, 0), 5),
            disc(45, 60, 5),
            disc(45, 61, 5),
        ),
        ("a disc and an arc's end", arc((65, 0), (0, 65), (0, 0), 5), disc(65, -10, 5), disc(65, -11, 5)),
        (
            "a stroke across an arc",
            arc((65, 0), (0, 65), (0, 0), 0),
            stroke((0, 0), (100, 100), 0),
            stroke((0, 0), (45, 45), 0),
        ),
        (
            "a stroke beside an arc",
            arc((65, 0), (0, 65), (0, 0), 5),
            stroke((75, -30), (75, 30), 5),
            stroke((76, -30), (76, 30), 5),
        ),
        (
            "arcs side by side",
            arc((65, 0), (-65, 0), (0, 0), 5),
            arc((0, -65), (65, 0), (0, 140), 5),
            arc((-65, 0), (65, 0), (0, 141), 5),
        ),
        (
            "arcs that cross",
            arc((65, 0), (-65, 0), (0, 0), 0),
            arc((65, 0), (-65, 0), (50, 0), 0),
            arc((-65, 0), (65, 0), (50, -1), 0),
        ),
    ];
    for (what, one, near, far) in cases {
        let [one, near, far] = [one, near, far].map(|shape| scale_up(shape, 10_000));
        assert!(touch(&one, &near), "{what}: they touch");
        assert!(!touch(&one, &far), "{what}: a gap of about ten micrometres");
    }
}

/// The squared distance of two segments as a fraction: the least value of a convex quadratic over a
/// square, where its gradient vanishes or on one of the four sides.
fn squared_distance(s: (Point, Point), t: (Point, Point)) -> (i128, i128) {
    let wide = |v: voromill::geometry::Vector| (i128::from(v.x.get()), i128::from(v.y.get()));
    let dot = |a: (i128, i128), b: (i128, i128)| a.0 * b.0 + a.1 * b.1;
    let (u, v, w) = (wide(s.1 - s.0), wide(t.1 - t.0), wide(t.0 - s.0));
    // At (p / q) of s and (r / q) of t; squared length of w + v r/q − u p/q, times q².
    let value = |p: i128, r: i128, q: i128| {
        let x = (w.0 * q + v.0 * r - u.0 * p, w.1 * q + v.1 * r - u.1 * p);
        (dot(x, x), q * q)
    };
    let mut least = value(0, 0, 1);
    let mut offer = |p: i128, r: i128, q: i128| {
        if q > 0 && (0..=q).contains(&p) && (0..=q).contains(&r) {
            let new = value(p, r, q);
            if new.0 * least.1 < least.0 * new.1 {
                least = new;
            }
        }
    };
    for end in [0, 1] {
        for other in [0, 1] {
            offer(end, other, 1);
        }
        let (uu, vv) = (dot(u, u), dot(v, v));
        offer(dot(u, w) + end * dot(u, v), end * uu, uu);
        offer(end * vv, end * dot(u, v) - dot(v, w), vv);
    }
    let (uu, uv, vv, uw, vw) = (dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w));
    offer(vv * uw - uv * vw, uv * uw - uu * vw, uu * vv - uv * uv);
    least
}

/// The edges of a shape's core and its radius.
fn edges(shape: &Shape) -> (Vec<(Point, Point)>, i64) {
    match shape {
        Shape::Disc { center, radius } => (vec![(*center, *center)], radius.get()),
        Shape::Stroke { from, to, radius } => (vec![(*from, *to)], radius.get()),
        Shape::Polygon(polygon) => (polygon.edges().collect(), 0),
        Shape::Arc { .. } => panic!("the oracle knows no arcs"),
    }
}

/// The oracle: every edge against every edge, in rational numbers, and every corner against every
/// area, for what is no farther apart than `gap`.
fn meet_slowly(a: &Shape, b: &Shape, gap: i64) -> bool {
    let ((edges_a, r), (edges_b, q)) = (edges(a), edges(b));
    let reach = i128::from(r + q + gap);
    let inside = |area: &Shape, of: &[(Point, Point)]| match area {
        Shape::Polygon(polygon) => of.iter().any(|edge| polygon.contains(edge.0)),
        _ => false,
    };
    inside(a, &edges_b)
        || inside(b, &edges_a)
        || edges_a.iter().any(|&s| {
            edges_b.iter().any(|&t| {
                let (top, bottom) = squared_distance(s, t);
                top <= reach * reach * bottom
            })
        })
}

/// The nets of copper where one unit apart is joined.
fn nets_slowly(copper: &Copper) -> Nets {
    let mut pairs = Vec::new();
    for (a, i) in copper.features.iter().zip(0_u32..) {
        for (b, j) in copper.features.iter().zip(0_u32..).skip(i as usize + 1) {
            if meet_slowly(&a.shape, &b.shape, 1) {
                pairs.push((i, j));
            }
        }
    }
    Nets::from_pairs(copper, pairs)
}

/// Shapes in a square small enough that many touch exactly.
fn any_shape(size: i64) -> impl Strategy<Value = Shape> {
    let place = move || (0..size, 0..size);
    let ring = prop::collection::vec((-8_i64..8, -8_i64..8), 3..7);
    prop_oneof![
        (place(), 0..6_i64).prop_map(|((x, y), r)| disc(x, y, r)),
        (place(), (-12_i64..12, -12_i64..12), 0..4_i64).prop_map(|((x, y), (dx, dy), r)| stroke(
            (x, y),
            (x + dx, y + dy),
            r
        )),
        (place(), ring).prop_map(|((x, y), ring)| {
            let ring: Vec<_> = ring.into_iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
            polygon(&[&ring])
        }),
        (place(), 4..16_i64, 1..4_i64).prop_map(|((x, y), r, wall)| {
            let square = |r: i64| at(x - r, y - r).corners_to(at(x + r, y + r));
            let (outer, mut hole) = (square(r), square(r - wall));
            hole.reverse();
            Shape::Polygon(Polygon::new(vec![outer, hole]).expect("two squares"))
        }),
    ]
}

trait CornersTo {
    fn corners_to(self, other: Point) -> Vec<Point>;
}

impl CornersTo for Point {
    fn corners_to(self, other: Point) -> Vec<Point> {
        Rect::new(self, other).corners().to_vec()
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn contact_is_what_rational_arithmetic_finds(shapes in prop::collection::vec(any_shape(60), 2..24)) {
        let larger = copper(shapes.iter().map(|shape| scale_up(shape, JOINED)).collect());
        prop_assert_eq!(topology::recover(&larger, Method::Contact), nets_slowly(&copper(shapes)));
    }

    #[test]
    fn large_shapes_touch_as_their_scaled_down_twins(
        a in any_shape(30), b in any_shape(30), scale in 1_000_000_i64..20_000_000,
    ) {
        let scaled = |shape: &Shape| scale_up(shape, scale);
        prop_assert_eq!(meet_slowly(&a, &b, 0), touch(&scaled(&a), &scaled(&b)));
    }

    #[test]
    fn coincidence_joins_nothing_that_contact_does_not(shapes in prop::collection::vec(any_shape(40), 2..30)) {
        let copper = copper(shapes);
        let (coarse, fine) = (topology::recover(&copper, Method::Contact), topology::recover(&copper, Method::Coincidence));
        for net in fine.nets() {
            for &feature in &net.features {
                prop_assert_eq!(coarse.of(feature as usize), coarse.of(net.features[0] as usize));
            }
        }
    }

    #[test]
    fn arcs_touch_where_fine_steps_along_them_do(
        a in any_arc(), b in any_arc(), other in any_shape(60),
    ) {
        for other in [b, other] {
            let distance = distance_by_steps(&a, &other);
            if distance < 0.99 {
                prop_assert!(meet(&a, &other), "{a:?} and {other:?} are but {distance} apart");
            } else if distance > 1.1 {
                prop_assert!(!meet(&a, &other), "{a:?} and {other:?} are {distance} apart");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn where_shapes_touch_is_a_place_in_both(a in any_arc(), b in any_arc(), other in any_shape(60)) {
        let scaled = |shape: &Shape| scale_up(shape, 10_000);
        let a = scaled(&a);
        for other in [scaled(&b), scaled(&other)] {
            let copper = copper(vec![other.clone()]);
            for near in topology::Proximity::new(&copper).near(&a, Nm::ZERO) {
                let far = [&a, &other].map(|shape| distance_to(shape, near.at.to_f64()));
                prop_assert!(far.iter().all(|far| *far <= 2.0), "{:?}: {far:?} from {a:?} and {other:?}", near.at);
            }
        }
    }
}

fn scale_up(shape: &Shape, scale: i64) -> Shape {
    let point = |p: Point| at(p.x.get() * scale, p.y.get() * scale);
    match shape {
        Shape::Disc { center, radius } => Shape::Disc { center: point(*center), radius: *radius * scale },
        Shape::Stroke { from, to, radius } => {
            Shape::Stroke { from: point(*from), to: point(*to), radius: *radius * scale }
        }
        Shape::Polygon(polygon) => {
            let rings = polygon.contours().iter().map(|ring| ring.iter().map(|&p| point(p)).collect());
            Shape::Polygon(Polygon::new(rings.collect()).expect("as many points"))
        }
        Shape::Arc { arc, radius } => {
            let [start, end, center] = [arc.start, arc.end, arc.center].map(point);
            Shape::Arc { arc: Arc { start, end, center, turn: arc.turn }, radius: *radius * scale }
        }
    }
}

/// Whole points on a circle of radius 65 nm round the origin.
const ON_CIRCLE: [(i64, i64); 12] = [
    (65, 0),
    (60, 25),
    (52, 39),
    (39, 52),
    (16, 63),
    (0, 65),
    (-33, 56),
    (-63, 16),
    (-65, 0),
    (-25, -60),
    (0, -65),
    (56, -33),
];

fn any_arc() -> impl Strategy<Value = Shape> {
    (0..12_usize, 0..12_usize, (-60..60_i64, -60..60_i64), 0..9_i64)
        .prop_map(|(start, end, by, radius)| arc(ON_CIRCLE[start], ON_CIRCLE[end], by, radius))
}

/// The distance of an arc's copper from another shape's, negative where they overlap, to a
/// hundredth of a nanometre.
#[expect(clippy::cast_precision_loss, reason = "small numbers")]
fn distance_by_steps(shape: &Shape, other: &Shape) -> f64 {
    let Shape::Arc { arc, radius } = shape else { panic!("an arc") };
    let steps = 20_000;
    let along = (0..=steps).map(|i| arc.at(i as f64 / steps as f64));
    let near = |p: (f64, f64)| distance_to(other, p);
    along.map(near).fold(f64::INFINITY, f64::min) - radius.get() as f64
}

#[expect(clippy::cast_precision_loss, reason = "small numbers")]
fn distance_to(shape: &Shape, p: (f64, f64)) -> f64 {
    let from_segment = |(a, b): (Point, Point)| {
        let ((ax, ay), (bx, by)) = (a.to_f64(), b.to_f64());
        let (dx, dy) = (bx - ax, by - ay);
        let squared = dx * dx + dy * dy;
        let part = if squared > 0.0 { ((p.0 - ax) * dx + (p.1 - ay) * dy) / squared } else { 0.0 };
        let (x, y) = (ax + dx * part.clamp(0.0, 1.0) - p.0, ay + dy * part.clamp(0.0, 1.0) - p.1);
        (x * x + y * y).sqrt()
    };
    match shape {
        Shape::Arc { arc, radius } => {
            let (cx, cy) = arc.center.to_f64();
            let (x, y) = (p.0 - cx, p.1 - cy);
            let turned = libm::atan2(y, x) - arc.start_angle();
            let turned = turned - (turned / std::f64::consts::TAU).floor() * std::f64::consts::TAU;
            let ends = from_segment((arc.start, arc.start)).min(from_segment((arc.end, arc.end)));
            let round = ((x * x + y * y).sqrt() - arc.radius()).abs();
            let core = if turned <= arc.sweep() { round.min(ends) } else { ends };
            core - radius.get() as f64
        }
        Shape::Polygon(polygon) => {
            let nearest = polygon.edges().map(from_segment).fold(f64::INFINITY, f64::min);
            if polygon.contains(Point::from_f64(p.0, p.1)) && nearest > 1.0 { -nearest } else { nearest }
        }
        _ => {
            let (edges, radius) = edges(shape);
            edges.into_iter().map(from_segment).fold(f64::INFINITY, f64::min) - radius as f64
        }
    }
}

fn named(mut copper: Copper, names: &[Option<&str>]) -> Copper {
    for (feature, name) in copper.features.iter_mut().zip(names) {
        if let Some(name) = name {
            copper.attributes.push(Attributes { net: Some((*name).to_owned()), ..Attributes::default() });
            feature.attributes = u32::try_from(copper.attributes.len() - 1).expect("few");
        }
    }
    copper
}

#[test]
fn two_names_on_one_island_are_a_warning_with_the_place_where_they_meet() {
    let shapes = [disc(0, 0, 10_000), stroke((0, 0), (100_000, 0), 2_000), disc(100_000, 0, 10_000)];
    let shapes = shapes.into_iter().chain([disc(500_000, 0, 10_000)]).collect();
    let copper = named(copper(shapes), &[Some("GND"), None, Some("AGND"), Some("GND")]);
    let nets = topology::recover(&copper, Method::Contact);
    let warnings = topology::names_check(&copper, &nets);
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert_eq!(warnings[0].code(), "nets-joined", "by its stable name");
    assert!(
        warnings[0].message.starts_with("AGND and GND are one island of copper (AGND meets GND at 0.1"),
        "{}",
        warnings[0].message
    );
    let at = warnings[0].at.expect("a place");
    assert!(
        (88_000..=112_000).contains(&at.x.get()) && at.y.get().abs() <= 2_000,
        "where the trace runs into AGND: {at:?}"
    );
    assert_eq!(nets.label(NetId(0)), "AGND+GND", "both names, in order");
    let islands = topology::islands_of_names(&nets);
    assert_eq!(islands["GND"], [NetId(0), NetId(1)], "GND is on two islands, which is normal");
}

#[test]
fn names_meet_where_copper_is_as_near_as_what_touches() {
    let copper = named(copper(vec![disc(0, 0, 10_000), disc(20_200, 0, 10_000)]), &[Some("A"), Some("B")]);
    let nets = topology::recover(&copper, Method::Contact);
    let warnings = topology::names_check(&copper, &nets);
    assert_eq!(warnings.len(), 1, "200 nm are no gap: {warnings:?}");
    assert!(warnings[0].message.contains("(A meets B at 0.0101"), "{}", warnings[0].message);
}

#[test]
fn plated_holes_join_the_two_sides() {
    let front = copper(vec![disc(0, 0, 500_000), disc(5_000_000, 0, 500_000)]);
    let back = Copper { side: Side::Back, ..copper(vec![stroke((0, 0), (5_000_000, 0), 100_000)]) };
    let hole = |x: i64, plating| Hole {
        path: Path { start: at(x, 0), segments: Vec::new() },
        diameter: Nm::from_um(600),
        plating,
        tool: 1,
        line: 1,
    };
    let nets = [&front, &back].map(|copper| topology::recover(copper, Method::Contact));
    let count = |holes: &[Hole]| {
        topology::electrical(Some((&front, &nets[0])), Some((&back, &nets[1])), holes).nets.len()
    };
    assert_eq!(count(&[]), 3, "nothing joins the sides");
    assert_eq!(count(&[hole(0, Plating::Plated)]), 2, "one plated hole");
    assert_eq!(
        count(&[hole(0, Plating::Plated), hole(5_000_000, Plating::Unknown)]),
        1,
        "unknown counts as plated"
    );
    assert_eq!(
        count(&[hole(0, Plating::Plated), hole(5_000_000, Plating::NonPlated)]),
        2,
        "unplated does not"
    );
}

#[test]
fn the_smallest_gap_is_found_with_its_place() {
    let square: &[(i64, i64)] = &[(0, 0), (1_000_000, 0), (1_000_000, 1_000_000), (0, 1_000_000)];
    let shapes = vec![
        polygon(&[square]),
        disc(1_400_000, 500_000, 100_000),
        stroke((0, 1_250_000), (1_000_000, 1_350_000), 50_000),
        disc(90_000_000, 0, 10),
    ];
    let copper = copper(shapes);
    let nets = topology::recover(&copper, Method::Contact);
    let gap = topology::smallest_gap(&copper, &nets).expect("four nets");
    assert_eq!(gap.between, (NetId(0), NetId(2)), "square and stroke");
    assert_eq!(gap.width, Nm::from_um(200), "at the stroke's left end");
    assert_eq!(gap.at, at(0, 1_100_000), "in the middle");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn no_gap_is_smaller_than_the_smallest(shapes in prop::collection::vec(any_shape(200), 2..20)) {
        let copper = copper(shapes);
        let nets = topology::recover(&copper, Method::Contact);
        let found = topology::smallest_gap(&copper, &nets);
        let mut least = f64::INFINITY;
        for (i, a) in copper.features.iter().enumerate() {
            for (j, b) in copper.features.iter().enumerate().skip(i + 1) {
                if nets.of(i) != nets.of(j) {
                    least = least.min(gap_slowly(&a.shape, &b.shape));
                }
            }
        }
        match found {
            None => prop_assert!(least.is_infinite(), "{}", least),
            Some(gap) => prop_assert!((gap.width.to_f64() - least).abs() <= 0.5001, "{} and {}", gap.width, least),
        }
    }
}

#[expect(clippy::cast_precision_loss, reason = "small numbers")]
fn gap_slowly(a: &Shape, b: &Shape) -> f64 {
    let ((edges_a, r), (edges_b, q)) = (edges(a), edges(b));
    let squares = edges_a.iter().flat_map(|&s| edges_b.iter().map(move |&t| squared_distance(s, t)));
    let least =
        squares.map(|(top, bottom)| (top as f64 / bottom as f64).sqrt()).fold(f64::INFINITY, f64::min);
    least - (r + q) as f64
}

#[test]
fn an_empty_layer_has_no_nets() {
    let copper = copper(Vec::new());
    let nets = topology::recover(&copper, Method::Contact);
    assert!(nets.nets().is_empty(), "no features, no nets");
    assert!(topology::smallest_gap(&copper, &nets).is_none(), "and no gap");
}

fn json(path: &FilePath) -> Option<Value> {
    Some(serde_json::from_slice(&fs::read(path).ok()?).expect("it is JSON"))
}

/// The copper of a file, without what has no area.
fn layer(file: &FilePath, side: Side) -> Copper {
    let name = file.file_name().expect("a file").to_string_lossy();
    let bytes = fs::read(file).expect("the file is there");
    let image = gerber::read(&name, &bytes, &gerber::Options::default()).expect("it reads");
    let mut features = image.features;
    features.retain(|feature| match &feature.shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => {
            *radius > Nm::ZERO
        }
        Shape::Polygon(_) => true,
    });
    Copper { side, features, attributes: image.attributes }
}

/// Every copper layer of every real board that says what its islands are: (board and side, copper,
/// truth).
fn layers() -> Vec<(String, Copper, Value)> {
    let mut found = Vec::new();
    for board in board_folders() {
        let (Some(meta), Some(truth)) =
            (json(&board.join("meta.json")), json(&board.join("truth_nets.json")))
        else {
            continue;
        };
        for (name, side) in [("front", Side::Front), ("back", Side::Back)] {
            if let (Some(file), true) = (meta["layers"][name].as_str(), truth[name].is_object()) {
                let what = format!("{} {name}", board.file_name().expect("a folder").to_string_lossy());
                found.push((what, layer(&board.join(file), side), truth[name].clone()));
            }
        }
    }
    found
}

#[test]
fn contact_finds_the_islands_and_names_of_real_boards() {
    let mut wrong = Vec::new();
    for (what, copper, truth) in layers() {
        let nets = topology::recover(&copper, Method::Contact);
        let islands = truth["islands"].as_array().expect("a list");
        if nets.nets().len() != islands.len() {
            wrong.push(format!("{what}: {} nets, {} islands", nets.nets().len(), islands.len()));
        }
        for island in islands {
            let mm = |i: usize| Nm::from_f64(island["point_mm"][i].as_f64().expect("a number") * 1e6);
            let point = Point::new(mm(0), mm(1));
            let Some(net) = net_at(&copper, &nets, point) else {
                wrong.push(format!("{what}: no copper at {point:?}"));
                continue;
            };
            let names: Vec<&str> = island["nets"].as_array().map_or(Vec::new(), |names| {
                names
                    .iter()
                    .map(|name| name.as_str().expect("a name"))
                    .filter(|name| !["N/C", "(none)", ""].contains(name))
                    .collect()
            });
            if nets.nets()[net.index()].names != names {
                wrong.push(format!(
                    "{what}: {:?}, not {names:?}, at {point:?}",
                    nets.nets()[net.index()].names
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The net whose copper holds a point: that which a dot there joins.
fn net_at(copper: &Copper, nets: &Nets, point: Point) -> Option<NetId> {
    let dot = Shape::Disc { center: point, radius: Nm::ZERO };
    let near =
        copper.features.iter().enumerate().filter(|(_, feature)| feature.shape.bounds().contains(point));
    near.map(|(index, feature)| (index, touch(&dot, &feature.shape)))
        .find(|(_, touch)| *touch)
        .map(|(index, _)| nets.of(index))
}

/// The boards of the paper's Table V that are to be had: data set, layer, and the nets after
/// Algorithm 1 and after Algorithm 2 in the logs of the original program.
const TABLE_V: [(u32, &str, usize, usize); 5] = [
    (1, "visolate_eaglecad1 front", 102, 86),
    (2, "visolate_dan front", 164, 83),
    (4, "visolate_numpres front", 77, 38),
    (5, "visolate_orcad_rs232 front", 21, 21),
    (6, "visolate_orcad_rs232 back", 13, 13),
];

#[test]
fn the_paper_s_boards_have_as_many_traces_as_in_its_logs() {
    let layers = layers();
    for (set, name, first, second) in TABLE_V {
        let Some((_, copper, _)) = layers.iter().find(|(what, ..)| what == name) else { continue };
        let traces = topology::recover(copper, Method::Coincidence);
        let found = topology::translucency(copper, &traces, Sampling::default()).expect("500 DPI");
        let counts = (traces.nets().len(), found.nets.nets().len());
        assert_eq!(counts, (first, second), "data set {set}");
        assert_eq!(
            found.nets,
            topology::recover(copper, Method::Contact),
            "data set {set}: nothing is missed"
        );
    }
}

#[test]
fn every_net_that_translucency_misses_on_real_boards_has_a_reason() {
    for (what, copper, _) in layers() {
        let found = topology::differences(&copper, Sampling::default()).expect("500 DPI");
        let (contact, translucent) = (found.contact.nets().len(), found.translucency.nets.nets().len());
        let missed = found.missed.iter().filter(|missed| missed.by == Method::Translucency);
        let thin = missed.clone().filter(|missed| missed.reason == Reason::ThinnerThanPixel).count();
        assert_eq!(translucent - contact, missed.count(), "{what}: one place for each join that is missing");
        // Two layers are tiled with regions that share edges; one has a hairline.
        let hairlines = what.starts_with("gerbv_hellboard") || what == "ts_clockblock front";
        assert!(thin == 0 || hairlines, "{what}: {thin} overlaps are thinner than a pixel");
    }
}

/// Strokes and discs some pixels wide, far enough apart to be several nets.
fn any_copper() -> impl Strategy<Value = Copper> {
    let size = 100_i64;
    let place = move || (-size..size, -size..size);
    let shape = prop_oneof![
        (place(), 1..6_i64).prop_map(|((x, y), r)| disc(x * 100, y * 100, r * 100)),
        (place(), place(), 1..4_i64).prop_map(|((x, y), (dx, dy), r)| stroke(
            (x * 100, y * 100),
            (x * 100 + dx * 20, y * 100 + dy * 20),
            r * 100
        )),
    ];
    prop::collection::vec(shape, 2..40).prop_map(copper)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn translucency_merges_nothing_that_does_not_overlap(copper in any_copper(), pitch in 20_i64..400, seed: u64) {
        let sampling = Sampling { pitch: Nm::new(pitch * 1000), seed };
        let copper = scale_copper(&copper, 1000);
        let found = topology::differences(&copper, sampling).expect("a coarse grid");
        for net in found.translucency.nets.nets() {
            for &feature in &net.features {
                prop_assert_eq!(found.contact.of(feature as usize), found.contact.of(net.features[0] as usize));
            }
        }
    }

    #[test]
    fn translucency_finds_what_overlaps_by_a_pixel_and_a_half(copper in any_copper(), seed: u64) {
        let sampling = Sampling { pitch: Nm::new(100_000), seed };
        let copper = scale_copper(&copper, 1000);
        let traces = topology::recover(&copper, Method::Coincidence);
        let found = topology::translucency(&copper, &traces, sampling).expect("a coarse grid");
        // With the radius of a disc of a pixel and a half taken off, what still touches overlapped
        // by that disc.
        let shrunk = shrink(&copper, 75_000);
        let sure = topology::recover(&shrunk, Method::Contact);
        for net in sure.nets() {
            for &feature in &net.features {
                prop_assert_eq!(found.nets.of(feature as usize), found.nets.of(net.features[0] as usize));
            }
        }
    }
}

fn scale_copper(copper: &Copper, scale: i64) -> Copper {
    self::copper(copper.features.iter().map(|feature| scale_up(&feature.shape, scale)).collect())
}

/// The copper with every radius less by `by`.
fn shrink(copper: &Copper, by: i64) -> Copper {
    let less = |radius: Nm| Nm::new(radius.get() - by);
    let shapes = copper.features.iter().map(|feature| match feature.shape.clone() {
        Shape::Disc { center, radius } => Shape::Disc { center, radius: less(radius) },
        Shape::Stroke { from, to, radius } => Shape::Stroke { from, to, radius: less(radius) },
        other => other,
    });
    self::copper(shapes.collect())
}

#[test]
fn more_than_seven_stacked_traces_are_one_and_reported() {
    let shapes = (0..12_i64).map(|i| disc(i * 20_000, 0, 1_000_000)).collect();
    let copper = copper(shapes);
    let traces = topology::recover(&copper, Method::Coincidence);
    assert_eq!(traces.nets().len(), 12, "no two share a centre");
    let found = topology::translucency(&copper, &traces, Sampling::default()).expect("500 DPI");
    assert_eq!(found.nets.nets().len(), 1, "all overlap");
    assert_eq!(found.deepest, 12, "on top of each other in the middle");
    assert!(!found.overlaps.is_empty(), "with the places");
}

#[test]
fn the_picture_shows_the_first_mix_where_it_was_found() {
    for (what, copper, _) in layers().into_iter().filter(|(what, ..)| what.starts_with("visolate")) {
        let traces = topology::recover(&copper, Method::Coincidence);
        let found = topology::translucency(&copper, &traces, Sampling::default()).expect("500 DPI");
        let Some(first) = found.overlaps.first() else { continue };
        let grid =
            Grid::covering(copper.bounds().expect("copper"), Sampling::default().pitch).expect("500 DPI");
        let picture = found.picture(&copper, &traces, &grid);
        let corner = grid.corner(0, 0);
        let count = |way: Nm| usize::try_from(way.get() / grid.pitch().get()).expect("on the picture");
        let (column, row) = (count(first.at.x - corner.x), count(corner.y - first.at.y));
        let pixel = picture[row * usize::try_from(grid.width()).expect("small") + column];
        assert_eq!(pixel, first.colour, "{what}: at {:?}", first.at);
    }
}

#[test]
fn the_seed_decides_the_colours_and_nothing_else_does() {
    let copper = copper((0..20_i64).map(|i| disc(i * 150_000, 0, 100_000)).collect());
    let traces = topology::recover(&copper, Method::Coincidence);
    let run = |seed| {
        topology::translucency(&copper, &traces, Sampling { seed, ..Sampling::default() }).expect("500 DPI")
    };
    assert_eq!(run(1).colours, run(1).colours, "the same seed");
    assert_eq!(run(1).overlaps, run(1).overlaps, "the same run");
    assert_ne!(run(1).colours, run(2).colours, "another seed");
    assert_eq!(run(1).nets, run(2).nets, "the same nets");
}

#[test]
fn real_boards_have_as_many_electrical_nets_as_their_truth() {
    let mut wrong = Vec::new();
    for folder in board_folders() {
        let Some(truth) = json(&folder.join("truth_nets.json")) else { continue };
        let Some(groups) = truth["board"]["connected_groups"].as_u64() else { continue };
        let Ok(import::Loaded { board, .. }) =
            import::survey(std::slice::from_ref(&folder), &import::Selection::default())
        else {
            continue;
        };
        let (Some(front), Some(back)) = (&board.front, &board.back) else { continue };
        let nets = [front, back].map(|copper| topology::recover(copper, Method::Contact));
        let islands = |side: &str| truth[side]["islands"].as_array().map_or(0, Vec::len);
        if [nets[0].nets().len(), nets[1].nets().len()] != [islands("front"), islands("back")] {
            // Lettering beyond the outline was left out: other islands, other groups.
            continue;
        }
        let found = topology::electrical(Some((front, &nets[0])), Some((back, &nets[1])), &board.holes);
        if found.nets.len() as u64 != groups {
            wrong.push(format!("{}: {} nets, {groups} groups", folder.display(), found.nets.len()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
