//! The certified diagram beside brute force: random copper at free places, and on coarse grids
//! where equal distances, tangencies and coincident edges are the rule.

use voromill::board::{Attributes, Axis, Copper, Feature, Shape, Side};
use voromill::geometry::{Arc, Nm, Point, Polygon, Rect, Turn, Vector};
use voromill::topology::{self, DisjointSets, Method, Nets};
use voromill::voronoi::exact::{Diagram, Generators, Kind, Space};

use crate::oracle::distance::distances;
use crate::oracle::polyline;
use crate::random::splitmix64;
use crate::seeds::seeds;

/// A splitmix64 generator.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn below(&mut self, bound: i64) -> i64 {
        let high = i64::from(u32::try_from(splitmix64(&mut self.0) >> 33).expect("31 bits"));
        (high * bound) >> 31
    }
}

/// The side of the square that most of a scene lies in.
const SIDE: i64 = 8_000_000;
/// A large size.
const LARGE: i64 = 1_000_000;
/// How much the brute force may be off, in nanometres: it takes arcs by chords within 5 nm.
const OFF: f64 = 20.0;

/// A point so many grid steps from the origin.
fn at(grid: i64, x: i64, y: i64) -> Point {
    Point::new(Nm::new(x * grid), Nm::new(y * grid))
}

/// An arc with both ends on the grid: quarter turns round a grid point.
fn arc(random: &mut Random, grid: i64, (x, y): (i64, i64)) -> Arc {
    let large = LARGE / grid;
    let (dx, dy) = (1 + random.below(large), random.below(large));
    let ends = [(dx, dy), (-dy, dx), (-dx, -dy), (dy, -dx)].map(|(dx, dy)| at(grid, x + dx, y + dy));
    let mut end = || ends[usize::try_from(random.below(4)).expect("below four")];
    let (start, end) = (end(), end());
    let turn = if random.below(2) == 0 { Turn::Clockwise } else { Turn::CounterClockwise };
    Arc { start, end, center: at(grid, x, y), turn }
}

fn shape(random: &mut Random, grid: i64) -> Shape {
    let large = LARGE / grid;
    let (x, y) = (random.below(SIDE / grid), random.below(SIDE / grid));
    let (center, radius) = (at(grid, x, y), Nm::new((1 + random.below(large / 2)) * grid));
    let to = at(grid, x + random.below(4 * large) - 2 * large, y + random.below(4 * large) - 2 * large);
    let mut away = || 1 + random.below(2 * large);
    match away() % 8 {
        0 | 1 if to != center => Shape::Stroke { from: center, to, radius },
        2 => Shape::Stroke { from: center, to: at(grid, x + away(), y), radius },
        3 => Shape::Arc { arc: arc(random, grid, (x, y)), radius },
        4 | 5 => Shape::Polygon(Polygon::rectangle(Rect::new(center, at(grid, x + away(), y + away())))),
        6 => {
            let corners: Vec<Point> = (0..5).map(|_| at(grid, x + away(), y + away())).collect();
            Polygon::hull(corners).map_or(Shape::Disc { center, radius }, Shape::Polygon)
        }
        _ => Shape::Disc { center, radius },
    }
}

/// Copper of these shapes, and which of them touch.
fn layer(shapes: impl IntoIterator<Item = Shape>) -> (Copper, Nets) {
    let feature = |shape| Feature { axis: Axis::Region, shape, attributes: 0, line: 0 };
    let features = shapes.into_iter().map(feature).collect();
    let copper = Copper { side: Side::Front, features, attributes: vec![Attributes::default()] };
    let nets = topology::recover(&copper, Method::Contact);
    (copper, nets)
}

fn scene(seed: u64, grid: i64) -> (Copper, Nets) {
    let mut random = Random(seed);
    let count = 3 + seed % 30;
    layer((0..count).map(|_| shape(&mut random, grid)))
}

fn diagram(copper: &Copper, nets: &Nets, kind: Kind) -> Diagram {
    let generators = Generators::of_copper(copper, |i| Some(nets.of(i).0));
    Diagram::new(generators, kind, Space::Around(Nm::from_mm(1)))
}

/// The distances to the two nearest nets, and the nearest.
fn nearest(copper: &Copper, nets: &Nets, [x, y]: [f64; 2]) -> ([f64; 2], usize) {
    let mut all: Vec<(f64, usize)> =
        distances(copper, nets, x, y).into_iter().enumerate().map(|(i, d)| (d, i)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    ([all[0].0, all.get(1).map_or(f64::INFINITY, |second| second.0)], all[0].1)
}

/// Every certificate holds, and brute force agrees with every circle and every edge.
fn check(name: &str, copper: &Copper, nets: &Nets, diagram: &Diagram) {
    assert_eq!(diagram.faults(), [], "{name}: no end is loose");
    assert_eq!(diagram.certify(100_000.0), [], "{name}: all circles are empty");
    for vertex in diagram.vertices() {
        let ([clearance, _], _) = nearest(copper, nets, vertex.at.into());
        let off = (clearance - vertex.clearance).abs();
        assert!(off <= OFF, "{name}: {off} nm beside the circle of {vertex:?}");
    }
    for edge in diagram.edges() {
        let course = diagram.course(edge, 1_000.0);
        let ((x, y), clearance) = course[course.len() / 2];
        let ([one, other], _) = nearest(copper, nets, [x, y]);
        assert!((one - clearance).abs() <= OFF, "{name}: {edge:?} at {x}, {y}: {one} and {clearance} nm");
        assert!(other - one <= OFF, "{name}: {edge:?} at {x}, {y} parts {one} from {other} nm");
    }
}

/// Wherever a way from somewhere to somewhere goes from one net's region into another's, there is
/// an edge.
fn check_complete(name: &str, copper: &Copper, nets: &Nets, diagram: &Diagram, random: &mut Random) {
    let curves: Vec<Vec<[f64; 2]>> = diagram
        .edges()
        .iter()
        .map(|edge| diagram.course(edge, 20.0).into_iter().map(|(p, _)| p.into()).collect())
        .collect();
    let bounds = copper.bounds().expect("copper");
    for _ in 0..6 {
        // Within the copper's bounds: beyond them the window ends edges.
        let mut place = || {
            let mut part = |least: Nm, size: Nm| (least + Nm::new(random.below(size.get()))).to_f64();
            [part(bounds.min().x, bounds.width()), part(bounds.min().y, bounds.height())]
        };
        let (mut from, mut to) = (place(), place());
        let [here, there] = [from, to].map(|p| nearest(copper, nets, p).1);
        if here == there {
            continue;
        }
        for _ in 0..50 {
            let middle = [f64::midpoint(from[0], to[0]), f64::midpoint(from[1], to[1])];
            if nearest(copper, nets, middle).1 == here { from = middle } else { to = middle }
        }
        let off = polyline::distance(from, &curves);
        // Where the nets all but touch, brute force cannot tell.
        let is_free = nearest(copper, nets, from).0[0] > 1_000.0;
        assert!(
            !is_free || off <= 1_000.0,
            "{name}: {off} nm from {from:?}, where regions meet, to any edge"
        );
    }
}

/// A planar graph has as many faces as edges beyond the vertices, and one more for each piece: here
/// faces are regions of nets.
fn check_euler(name: &str, nets: &Nets, diagram: &Diagram) {
    // What leaves the window ends at one place beyond it.
    let (n, mut degree) = (diagram.vertices().len(), vec![0; diagram.vertices().len()]);
    let mut sets = DisjointSets::new(n + 1);
    let ends = |i: u32| usize::try_from(i).expect("an index");
    for edge in diagram.edges() {
        [edge.from, edge.to].into_iter().for_each(|i| degree[ends(i)] += 1);
    }
    let outside = u32::try_from(n).expect("few vertices");
    let beyond = |i: u32| if degree[ends(i)] == 1 { outside } else { i };
    for edge in diagram.edges() {
        sets.union(beyond(edge.from), beyond(edge.to));
    }
    let leave = degree.iter().filter(|&&degree| degree == 1).count();
    let vertices = n - leave + usize::from(leave > 0);
    let used = (0..=outside).filter(|&i| if i == outside { leave > 0 } else { degree[ends(i)] != 1 });
    let pieces = used.filter(|&i| sets.find(i) == i).count();
    let faces = diagram.edges().len() + 1 + pieces - vertices;
    assert_eq!(faces, nets.nets().len(), "{name}: one region for each net");
}

fn check_owners(usual: std::ops::Range<u64>, grid: i64) {
    for seed in seeds(usual) {
        let name = format!("seed {seed} on a grid of {grid} nm");
        let (copper, nets) = scene(seed, grid);
        let diagram = diagram(&copper, &nets, Kind::Owners);
        check(&name, &copper, &nets, &diagram);
        check_complete(&name, &copper, &nets, &diagram, &mut Random(seed));
        check_euler(&name, &nets, &diagram);
    }
}

#[test]
fn at_free_places_brute_force_agrees_with_the_certified_diagram() {
    check_owners(0..30, 1);
}

#[test]
fn on_coarse_grids_brute_force_agrees_with_the_certified_diagram() {
    check_owners(0..30, 100_000);
    check_owners(100..130, 250_000);
}

/// A step of the walk reaches hundreds of teeth here, of which the first to enter is the next.
#[test]
fn brute_force_agrees_along_an_edge_of_fine_teeth() {
    let tooth = |i: i64| at(10_000, i, if i % 2 == 0 { 0 } else { -3 });
    let ring = (0..=600).map(tooth).chain([at(10_000, 600, -100), at(10_000, 0, -100)]).rev();
    let teeth = Shape::Polygon(Polygon::new(vec![ring.collect()]).expect("many corners"));
    let disc =
        |i: i64| Shape::Disc { center: at(10_000, 90 * i, 110 + 17 * (i % 3)), radius: Nm::from_um(300) };
    let (copper, nets) = layer(std::iter::once(teeth).chain((0..8).map(disc)));
    let diagram = diagram(&copper, &nets, Kind::Owners);
    assert!(diagram.edges().len() > 290, "{} edges: most teeth have one", diagram.edges().len());
    check("teeth", &copper, &nets, &diagram);
    check_complete("teeth", &copper, &nets, &diagram, &mut Random(1));
    check_euler("teeth", &nets, &diagram);
}

/// All edges of the free space end where others begin, and no circle holds copper.
#[test]
fn the_medial_axis_of_random_copper_is_certified() {
    for (usual, grid) in [(0..60, 1), (0..60, 100_000), (0..60, 250_000)] {
        for seed in seeds(usual) {
            let name = format!("seed {seed} on a grid of {grid} nm");
            let (copper, nets) = scene(seed, grid);
            let diagram = diagram(&copper, &nets, Kind::MedialAxis);
            assert_eq!(diagram.faults(), [], "{name}: no end is loose");
            assert_eq!(diagram.certify(100_000.0), [], "{name}: all circles are empty");
        }
    }
}

/// Tracks beside each other with a rounded corner, as CAD programs write it: a line, an arc that
/// goes on in the same direction but for rounding to whole nanometres, and a line; and a pour that
/// keeps its distance, its edge in chords.
fn rounded_tracks(seed: u64) -> (Copper, Nets) {
    let mut random = Random(seed);
    let mut number = |bound: i64| Nm::new(random.below(bound)).to_f64();
    let (x, y) = (number(LARGE), number(LARGE));
    let [heading, turn] = [number(8), 1.0 + number(2)].map(|eighths| (eighths * 45.0).to_radians());
    let (half, clearance, steps) = (75_000.0, 100_000.0 + number(100_000), 2.0 + number(12));
    // A place on a circle, and so far beyond along its tangent.
    let place = |radius: f64, angle: f64, beyond: f64| {
        let (cos, sin) = (libm::cos(heading + angle), libm::sin(heading + angle));
        Point::from_f64(x + radius * cos - beyond * sin, y + radius * sin + beyond * cos)
    };
    let mut shapes = Vec::new();
    for track in 0..3 {
        let radius = 400_000.0 + f64::from(track) * (2.0 * half + clearance);
        let (start, end) = (place(radius, 0.0, 0.0), place(radius, turn, 0.0));
        let arc = Arc { start, end, center: Point::from_f64(x, y), turn: Turn::CounterClockwise };
        let (before, after, radius) =
            (place(radius, 0.0, -2e6), place(radius, turn, 1e6), Nm::from_f64(half));
        shapes.push(Shape::Stroke { from: before, to: start, radius });
        shapes.push(Shape::Arc { arc, radius });
        shapes.push(Shape::Stroke { from: end, to: after, radius });
    }
    let edge = 400_000.0 - half - clearance;
    let chords = (0..=14).map(f64::from).take_while(|&chord| chord <= steps);
    let mut pour: Vec<Point> = chords.map(|chord| place(edge, turn * chord / steps, 0.0)).collect();
    pour.extend([place(edge, turn, 1e6), place(edge, 0.0, -2e6)]);
    shapes.extend(Polygon::hull(pour).map(Shape::Polygon));
    layer(shapes)
}

/// Where a line goes on as an arc, their ends lie fractions of a nanometre before or behind each
/// other. (Of 3000 such scenes six have a fault, which shaking repairs.)
#[test]
fn tracks_with_rounded_corners_have_a_certified_diagram() {
    let kinds = [Kind::Owners, Kind::Between(Nm::from_um(100))];
    for (seed, kind) in (0..600).flat_map(|seed| kinds.map(|kind| (seed, kind))) {
        let (copper, nets) = rounded_tracks(seed);
        assert_eq!(nets.nets().len(), 4, "seed {seed}: three tracks and a pour");
        let diagram = diagram(&copper, &nets, kind);
        assert_eq!(diagram.faults(), [], "seed {seed}, {kind:?}: no end is loose");
        assert_eq!(diagram.certify(100_000.0), [], "seed {seed}, {kind:?}: all circles are empty");
    }
}

/// What shaking makes of equal distances is well apart: it is what is tried where a diagram has a
/// fault, so it must have fewer.
#[test]
fn shaken_tracks_have_a_certified_diagram() {
    for (seed, attempt) in (0..200).flat_map(|seed| (1..=2).map(move |attempt| (seed, attempt))) {
        let (copper, nets) = rounded_tracks(seed);
        for kind in [Kind::Owners, Kind::Between(Nm::from_um(100)), Kind::MedialAxis] {
            let mut generators = Generators::shaken(attempt);
            for (number, feature) in copper.features.iter().enumerate() {
                generators.add(&feature.shape, nets.of(number).0);
            }
            let diagram = Diagram::new(generators, kind, Space::Around(Nm::from_mm(1)));
            assert_eq!(diagram.faults(), [], "seed {seed}, attempt {attempt}, {kind:?}: no end is loose");
        }
    }
}

/// A ring of tracks, each an arc from one of these places to the next, with its middle as far from
/// the place as a file says.
fn ring_of_arcs(arcs: &[[i64; 4]]) -> impl Iterator<Item = Shape> {
    arcs.iter().zip(arcs.iter().cycle().skip(1)).map(|(&[x, y, i, j], next)| {
        let (start, end, center) = (at(1, x, y), at(1, next[0], next[1]), at(1, x + i, y + j));
        Shape::Arc { arc: Arc { start, end, center, turn: Turn::CounterClockwise }, radius: Nm::from_um(150) }
    })
}

/// Within rings of arcs whose middles differ by some nanometres everything is all but equally far
/// from everything, which a tie may not resolve: that is a fault. One walk did not end there.
#[test]
fn rings_of_arcs_round_middles_that_differ_end_or_have_a_fault() {
    let one = [
        [50_527_271, 12_806_943, -2_526_288, -806_666],
        [47_194_308, 14_526_562, 806_672, -2_526_288],
        [45_474_689, 11_193_599, 2_526_286, 806_677],
        [48_807_652, 9_473_980, -806_671, 2_526_295],
    ];
    let other = [
        [51_126_561, 31_371_948, -3_125_664, -1_371_667],
        [46_629_242, 33_125_947, 1_371_670, -3_125_667],
        [44_875_243, 28_628_628, 3_125_671, 1_371_655],
        [49_372_562, 26_874_629, -1_371_659, 3_125_664],
    ];
    let (copper, nets) = layer(ring_of_arcs(&one).chain(ring_of_arcs(&other)));
    assert_eq!(nets.nets().len(), 2, "two rings");
    let wall = copper.bounds().expect("copper").inflate(Nm::from_mm(4));
    for attempt in 0..=4 {
        let mut generators = Generators::shaken(attempt);
        generators.weld(one.iter().chain(&other).map(|&[x, y, ..]| at(1, x, y)).collect());
        for (number, feature) in copper.features.iter().enumerate() {
            generators.add(&feature.shape, nets.of(number).0);
        }
        generators.wall(wall);
        let diagram = Diagram::new(generators, Kind::Above(Nm::from_um(25)), Space::Within);
        let is_finite = diagram.vertices().iter().all(|vertex| vertex.clearance.is_finite());
        assert!(is_finite, "attempt {attempt}: copper is somewhere");
    }
}

/// All level curves close and are as far from copper as they should be, and whoever goes from
/// nearer to farther crosses one.
fn check_levels(name: &str, copper: &Copper, nets: &Nets, random: &mut Random) {
    let mut generators = Generators::of_copper(copper, |i| Some(nets.of(i).0));
    let bounds = copper.bounds().expect("copper");
    generators.wall(bounds.inflate(Nm::from_mm(2)));
    let diagram = Diagram::new(generators, Kind::Above(Nm::from_um(10)), Space::Within);
    assert_eq!(diagram.faults(), [], "{name}: no end is loose");
    let reach = |p: [f64; 2]| nearest(copper, nets, p).0[0];
    for level in [50_000.0, 125_000.0, 300_000.0, 900_000.0] {
        let curves = diagram.level_set(level).expect("faces that close");
        let courses = curves.iter().filter(|curve| curve.owner < 1000).map(|curve| &curve.course);
        let courses: Vec<Vec<[f64; 2]>> =
            courses.map(|course| course.iter().map(|&p| p.into()).collect()).collect();
        for course in &courses {
            assert_eq!(course.first(), course.last(), "{name}: a curve at {level} nm closes");
            for &p in course.iter().step_by(7) {
                let off = (reach(p) - level).abs();
                assert!(off <= OFF, "{name}: {off} nm off {level} nm at {p:?}");
            }
        }
        for _ in 0..10 {
            let mut place = || {
                let mut part = |least: Nm, size: Nm| (least + Nm::new(random.below(size.get()))).to_f64();
                [part(bounds.min().x, bounds.width()), part(bounds.min().y, bounds.height())]
            };
            let (mut from, mut to) = (place(), place());
            if (reach(from) > level) == (reach(to) > level) {
                continue;
            }
            let is_far = reach(from) > level;
            for _ in 0..50 {
                let middle = [f64::midpoint(from[0], to[0]), f64::midpoint(from[1], to[1])];
                if (reach(middle) > level) == is_far { from = middle } else { to = middle }
            }
            let off = polyline::distance(from, &courses);
            assert!(off <= 1_000.0, "{name}: {off} nm from {from:?}, {level} nm from copper, to any curve");
        }
    }
}

#[test]
fn level_sets_are_where_brute_force_has_them() {
    for (usual, grid) in [(0..7, 1), (0..7, 100_000), (0..7, 250_000)] {
        for seed in seeds(usual) {
            let name = format!("seed {seed} on a grid of {grid} nm");
            let (copper, nets) = scene(seed, grid);
            check_levels(&name, &copper, &nets, &mut Random(seed));
        }
    }
}

/// A level of half a gap, but for a nanometre, crosses the edge in the gap anywhere.
#[test]
fn a_level_that_all_but_touches_an_edge_goes_round_no_corner_again() {
    let half = 200_000.0;
    let um = |x: i64, y: i64| at(1_000, x, y);
    let squares = [(0, -1_000), (0, 400), (1_400, -1_000), (1_400, 400)]
        .map(|(x, y)| [um(x, y), um(x + 1_000, y + 1_000)]);
    let mut generators = Generators::new();
    for (owner, corners) in (0_u32..).zip(squares) {
        generators.polygon(&Polygon::rectangle(Rect::new(corners[0], corners[1])), owner);
    }
    generators.wall(Rect::new(um(-1_000, -2_000), um(3_400, 2_400)));
    let diagram = Diagram::new(generators, Kind::Above(Nm::from_um(10)), Space::Within);
    assert_eq!(diagram.faults(), [], "no end is loose");
    let reach = |(x, y): (f64, f64)| {
        let off = squares.map(|[low, high]| {
            let ((a, b), (c, d)) = (low.to_f64(), high.to_f64());
            let (off_x, off_y) = ((a - x).max(x - c).max(0.0), (b - y).max(y - d).max(0.0));
            (off_x * off_x + off_y * off_y).sqrt()
        });
        off.into_iter().fold(f64::INFINITY, f64::min)
    };
    for step in 0..40_i32 {
        let level = half - 2.0 + f64::from(step) * 0.1;
        for curve in diagram.level_set(level).expect("faces that close") {
            for &p in curve.course.iter().filter(|_| curve.owner < 1000) {
                let off = (reach(p) - level).abs();
                assert!(off <= OFF, "{off} nm off {level} nm at {p:?}");
            }
        }
    }
}

/// Two discs and two strokes of one owner, from one micrometre too near to matter to one too far:
/// what a step sees of the neck must not decide where the edge ends.
#[test]
fn a_neck_about_as_wide_as_the_floor_is_followed_from_both_sides_or_from_none() {
    let um = |x: i64, y: i64| at(1_000, x, y);
    for gap in (19_000..21_000).step_by(97) {
        let far = um(2_000, 0) + Vector::new(Nm::new(gap), Nm::ZERO);
        let stroke =
            |x: i64, y: i64, to: Point| Shape::Stroke { from: um(x, y), to, radius: Nm::from_um(100) };
        let shapes = [
            Shape::Disc { center: um(0, 0), radius: Nm::from_um(1_000) },
            Shape::Disc { center: far, radius: Nm::from_um(1_000) },
            stroke(-1_500, 2_000, um(3_500, 2_100)),
            stroke(-1_500, -2_200, um(3_500, -2_000)),
        ];
        let mut generators = Generators::new();
        shapes.iter().for_each(|shape| generators.add(shape, 0));
        generators.wall(Rect::new(um(-5_000, -5_000), um(8_000, 5_000)));
        let diagram = Diagram::new(generators, Kind::Above(Nm::from_um(10)), Space::Within);
        assert_eq!(diagram.faults(), [], "a gap of {gap} nm");
        assert!(diagram.level_set(50_000.0).is_some(), "a gap of {gap} nm");
    }
}

/// The end of a stroke beside a disc, turned a little at a time: from one side of the stroke to the
/// other a boundary runs by half a turn, of which no direction is midway by rounding.
#[test]
fn half_a_turn_round_the_end_of_a_stroke_keeps_clear_of_it() {
    for step in 0..360_i64 {
        let angle = f64::from(i32::try_from(step).expect("a degree")).to_radians();
        let (x, y) = (libm::cos(angle), libm::sin(angle));
        let spot = |reach: f64| Point::from_f64(reach * x, reach * y);
        let mut generators = Generators::new();
        let radius = Nm::from_um(100);
        generators.add(&Shape::Stroke { from: spot(1_000_000.0), to: spot(4_000_000.0), radius }, 0);
        generators.add(&Shape::Disc { center: Point::default(), radius: Nm::from_um(800) }, 1);
        let diagram = Diagram::new(generators, Kind::Owners, Space::Around(Nm::from_mm(1)));
        assert_eq!(diagram.faults(), [], "{step}°");
        for edge in diagram.edges() {
            for pair in diagram.profile(edge, 1_000.0).windows(2) {
                let [((ax, ay), _), ((bx, by), _)] = [pair[0], pair[1]];
                let (u, v) = (f64::midpoint(ax, bx), f64::midpoint(ay, by));
                let along = (u * x + v * y).clamp(1_000_000.0, 4_000_000.0);
                let disc = libm::hypot(u, v) - 800_000.0;
                let stroke = libm::hypot(u - along * x, v - along * y) - 100_000.0;
                assert!((disc - stroke).abs() < 3_000.0, "{step}°: {disc} and {stroke} nm off at {u}, {v}");
            }
        }
    }
}

#[test]
fn an_edge_between_two_discs_is_a_hyperbola_with_its_clearance() {
    let disc = |x: i64, radius: i64| Shape::Disc { center: at(1_000, x, 0), radius: Nm::from_um(radius) };
    let mut generators = Generators::new();
    generators.add(&disc(0, 500), 0);
    generators.add(&disc(3_000, 1_000), 1);
    let diagram = Diagram::new(generators, Kind::Owners, Space::Around(Nm::from_mm(1)));
    assert_eq!(diagram.faults(), [], "no end is loose");
    let narrowest = diagram.vertices().iter().map(|vertex| vertex.clearance).fold(f64::INFINITY, f64::min);
    assert!((narrowest - 750_000.0).abs() < 1e-3, "half of 1.5 mm: {narrowest} nm");
    for edge in diagram.edges() {
        for ((x, y), clearance) in diagram.course(edge, 100.0) {
            let reach = |center: f64, radius: f64| ((x - center) * (x - center) + y * y).sqrt() - radius;
            let [one, other] = [reach(0.0, 5e5), reach(3e6, 1e6)];
            assert!(
                (one - clearance).abs() < 1e-3 && (other - clearance).abs() < 1e-3,
                "{one} {other} {clearance}"
            );
        }
    }
}

#[test]
fn an_edge_may_leave_the_window_where_the_course_round_a_disc_begins_anew() {
    let disc =
        |x, y, radius| Shape::Disc { center: Point::new(Nm::new(x), Nm::new(y)), radius: Nm::new(radius) };
    // Straight to the left of the first both are as far at x = -8 050 842 nm.
    for left in (-8_051_100..=-8_049_600).step_by(20) {
        let mut generators = Generators::new();
        generators.add(&disc(7_600_000, 17_900_000, 75_000), 0);
        generators.add(&disc(462_423, 4_856_566, 0), 1);
        let corner = Point::new(Nm::new(left.into()), Nm::from_mm(-8));
        let window = Rect::new(corner, Point::new(Nm::from_mm(30), Nm::from_mm(30)));
        let diagram = Diagram::new(generators, Kind::Owners, Space::Window(window));
        assert!(diagram.faults().is_empty(), "window from {left}: {:?}", diagram.faults());
        let reached = diagram.vertices().iter().any(|vertex| vertex.at.0 <= f64::from(left));
        assert!(reached, "window from {left}: an edge leaves it");
    }
}
