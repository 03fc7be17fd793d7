//! Boundaries beside an exact Voronoi diagram of segments: Boost's algorithm, which draws nothing.

use std::collections::BTreeMap;

use boostvoronoi::prelude::{Builder, Diagram as Exact, EdgeIndex};
use voromill::board::Copper;
use voromill::geometry::Nm;
use voromill::topology::{self, Method, NetId, Nets};
use voromill::voronoi::{Diagram, Owner, Settings, exact};

use crate::oracle::field::Spot;
use crate::oracle::parabola::parabola;
use crate::oracle::polyline;
use crate::random::splitmix64;
use crate::segments::{Bare, copper};

/// Curves by the two nets that they part.
type Curves = BTreeMap<(NetId, NetId), Vec<Vec<Spot>>>;

/// A splitmix64 generator.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: i32) -> i32 {
        let high = splitmix64(&mut self.0) >> 33;
        i32::try_from((high * u64::from(bound.unsigned_abs())) >> 31).expect("below the bound")
    }
}

/// The side of the square round all scenes.
const SIDE: i32 = 12_000_000;
/// No two nets come nearer to each other: three pixels.
const GAP: f64 = 3.0 * 25_400.0;

fn ends(segment: Bare) -> [Spot; 2] {
    let [ax, ay, bx, by] = segment.map(f64::from);
    [[ax, ay], [bx, by]]
}

/// The distance between two segments; zero where they cross.
fn apart(one: Bare, other: Bare) -> f64 {
    let ([a, b], [c, d]) = (ends(one), ends(other));
    let side = |a: Spot, b: Spot, p: Spot| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    if side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0 {
        return 0.0;
    }
    let ends = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
    ends.into_iter().map(|(p, a, b)| polyline::to_chord(p, a, b)).fold(f64::INFINITY, f64::min)
}

/// A square, and in it lines of up to three segments that keep clear of each other: each a net.
fn scene(seed: u64, count: usize, longest: i32) -> Vec<Bare> {
    let corners = [[0, 0], [SIDE, 0], [SIDE, SIDE], [0, SIDE]];
    let mut segments: Vec<Bare> = (0..4)
        .map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 4]);
            [a[0], a[1], b[0], b[1]]
        })
        .collect();
    let mut random = Random(seed);
    for _ in 0..count {
        let mut net: Vec<Bare> = Vec::new();
        let mut at = [random.below(SIDE), random.below(SIDE)];
        for _ in 0..=random.below(3) {
            let to = at.map(|x| x + random.below(2 * longest) - longest);
            let next = [at[0], at[1], to[0], to[1]];
            let clear = segments.iter().all(|&other| apart(next, other) > GAP);
            // A net may not come back to itself either, or it would be a crossing.
            let simple = net.iter().rev().skip(1).all(|&other| apart(next, other) > GAP);
            if !clear || !simple || to.iter().any(|x| !(0..SIDE).contains(x)) {
                break;
            }
            net.push(next);
            at = to;
        }
        segments.extend(net);
    }
    segments
}

fn pair(a: NetId, b: NetId) -> (NetId, NetId) {
    (a.min(b), a.max(b))
}

/// What the exact diagram has between different nets.
fn exact(segments: &[Bare], nets: &Nets) -> Curves {
    let builder = Builder::<i32>::default().with_segments(segments.iter()).expect("segments");
    let diagram = builder.build().expect("a diagram");
    let mut curves = Curves::new();
    for edge in diagram.edges() {
        let twin = edge.twin().expect("every edge has a twin");
        if edge.id().usize() > twin.usize() || !edge.is_primary() {
            continue;
        }
        let [one, other] = [edge.id(), twin].map(|id| site(&diagram, id));
        let [a, b] = [one, other].map(|(segment, _)| nets.of(segment));
        if a != b {
            let curve = curve(&diagram, edge.id(), segments, [one, other]);
            curves.entry(pair(a, b)).or_default().extend(curve);
        }
    }
    curves
}

/// The segment that an edge is beside, and which of its ends if it is only that.
fn site(diagram: &Exact, edge: EdgeIndex) -> (usize, Option<usize>) {
    let cell = diagram.cell(diagram.edge_get_cell(edge).expect("a cell")).expect("a cell");
    let end = match (cell.contains_segment_startpoint(), cell.contains_segment_endpoint()) {
        (true, _) => Some(0),
        (_, true) => Some(1),
        (false, false) => None,
    };
    (cell.source_index().usize(), end)
}

/// An edge as points; none for one that goes to infinity, outside the square.
fn curve(
    diagram: &Exact,
    edge: EdgeIndex,
    segments: &[Bare],
    sites: [(usize, Option<usize>); 2],
) -> Option<Vec<Spot>> {
    let vertices = [diagram.edge_get_vertex0(edge), diagram.edge_get_vertex1(edge)];
    let [from, to] = vertices.map(|vertex| {
        let vertex = diagram.vertex(vertex.ok()??).ok()?;
        Some([vertex.x(), vertex.y()])
    });
    let (from, to) = (from?, to?);
    let (point, line) = match sites {
        [(a, Some(end)), (b, None)] | [(b, None), (a, Some(end))] => {
            (ends(segments[a])[end], ends(segments[b]))
        }
        [(_, None), (_, None)] | [(_, Some(_)), (_, Some(_))] => return Some(vec![from, to]),
    };
    Some(parabola(point, line, from, to, |length, _| (length / 3_000.0).ceil().max(1.0)))
}

/// What voromill has between different nets.
fn ours(copper: &Copper, nets: &Nets, settings: &Settings) -> Curves {
    let diagram = Diagram::new(copper, nets, None, settings).expect("a diagram");
    let found = diagram.boundaries().expect("whole boundaries");
    let mut curves = Curves::new();
    for edge in &found.edges {
        if let (Owner::Net(a), Owner::Net(b)) = (edge.left, edge.right) {
            let points = edge.path.flatten(Nm::new(10)).into_iter().map(|p| p.to_f64().into()).collect();
            curves.entry(pair(a, b)).or_default().push(points);
        }
    }
    curves
}

/// How far the curves of one are from those of the other between the same nets, at most, with the
/// place.
fn farthest(one: &Curves, other: &Curves) -> (f64, Spot) {
    let mut farthest = (0.0, [0.0; 2]);
    for (nets, curves) in one {
        let others = other.get(nets).map_or(&[][..], Vec::as_slice);
        for p in curves.iter().flat_map(|curve| polyline::points(curve, 20_000.0)) {
            let off = polyline::distance(p, others);
            if off > farthest.0 {
                farthest = (off, p);
            }
        }
    }
    farthest
}

#[test]
fn boundaries_are_those_of_an_exact_segment_diagram() {
    for (seed, count, longest) in
        [(1, 12, 4_000_000), (2, 30, 2_500_000), (3, 60, 2_000_000), (4, 120, 1_200_000), (5, 200, 900_000)]
    {
        let segments = scene(seed, count, longest);
        let copper = copper(&segments);
        let nets = topology::recover(&copper, Method::Contact);
        let exact = exact(&segments, &nets);
        let ours = ours(&copper, &nets, &Settings::default());
        let (missing, at) = farthest(&exact, &ours);
        let (off, place) = farthest(&ours, &exact);
        println!(
            "seed {seed}: {} segments of {} nets: {off:.0} nm off, {missing:.0} nm missing",
            segments.len(),
            nets.nets().len()
        );
        assert!(off <= 2_000.0, "seed {seed}: {off:.0} nm from the exact diagram at {place:.0?}");
        assert!(missing <= 2_000.0, "seed {seed}: {missing:.0} nm to what the exact diagram has at {at:.0?}");
    }
}

/// What the certified diagram has between different nets.
fn certified(copper: &Copper, nets: &Nets) -> Curves {
    let generators = exact::Generators::of_copper(copper, |i| Some(nets.of(i).0));
    let space = exact::Space::Around(Nm::from_mm(1));
    let diagram = exact::Diagram::new(generators, exact::Kind::Owners, space);
    assert_eq!(diagram.faults(), [], "no end is loose");
    let mut curves = Curves::new();
    for edge in diagram.edges() {
        let [a, b] = [edge.left, edge.right].map(|generator| NetId(diagram.owner(generator)));
        let points = diagram.course(edge, 1.0).into_iter().map(|((x, y), _)| [x, y]).collect();
        curves.entry(pair(a, b)).or_default().push(points);
    }
    curves
}

#[test]
fn the_certified_diagram_is_that_of_another_algorithm_to_nanometres() {
    let scenes = [(1, 12, 4_000_000), (2, 30, 2_500_000), (3, 60, 2_000_000), (4, 120, 1_200_000)];
    let small = (10..40).map(|seed| (seed, 8, 5_000_000));
    for (seed, count, longest) in scenes.into_iter().chain(small) {
        let segments = scene(seed, count, longest);
        let copper = copper(&segments);
        let nets = topology::recover(&copper, Method::Contact);
        let exact = exact(&segments, &nets);
        let ours = certified(&copper, &nets);
        let (missing, at) = farthest(&exact, &ours);
        let (off, place) = farthest(&ours, &exact);
        // The other one's parabolas are chords of 3 µm; ours stay within 1 nm.
        assert!(off <= 20.0, "seed {seed}: {off:.1} nm from the other diagram at {place:.0?}");
        assert!(missing <= 20.0, "seed {seed}: {missing:.1} nm to what the other has at {at:.0?}");
    }
}
