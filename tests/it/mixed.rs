//! Loops round some nets, boundaries midway between the others, against flooding and brute-force
//! distances.

use std::collections::BTreeMap;

use proptest::prelude::*;
use voromill::board::{Attributes, Axis, Copper, Feature, Shape, Side};
use voromill::geometry::{Nm, Point, Polygon, Rect};
use voromill::topology::{self, Method, NetId, Nets};
use voromill::voronoi::{Boundaries, Diagram, Loops, NodeId, Owner, Settings};

use crate::oracle::distance as oracle;

const RADIUS: Nm = Nm::from_um(100);

fn at(x: i64, y: i64) -> Point {
    Point::new(Nm::from_um(x), Nm::from_um(y))
}

fn layer(shapes: impl IntoIterator<Item = Shape>) -> Copper {
    let feature = |shape: Shape| Feature { axis: Axis::Region, shape, attributes: 0, line: 0 };
    Copper {
        side: Side::Front,
        features: shapes.into_iter().map(feature).collect(),
        attributes: vec![Attributes::default()],
    }
}

/// A square ring, which may hold other nets.
fn ring(x: i64, y: i64, half: i64) -> Shape {
    let square = |half: i64| Rect::new(at(x - half, y - half), at(x + half, y + half)).corners().to_vec();
    let inner = square(half - 300).into_iter().rev().collect();
    Shape::Polygon(Polygon::new(vec![square(half), inner]).expect("a ring"))
}

fn any_shape() -> impl Strategy<Value = Shape> {
    let place = || (0..8000_i64, 0..6000_i64);
    prop_oneof![
        (place(), 150..600_i64)
            .prop_map(|((x, y), r)| Shape::Disc { center: at(x, y), radius: Nm::from_um(r) }),
        (place(), -1500..1500_i64, -1500..1500_i64, 80..300_i64).prop_map(|((x, y), dx, dy, r)| {
            Shape::Stroke { from: at(x, y), to: at(x + dx, y + dy), radius: Nm::from_um(r) }
        }),
        (place(), 900..2000_i64).prop_map(|((x, y), half)| ring(x, y, half)),
    ]
}

fn mixed(copper: &Copper, nets: &Nets, looped: impl Fn(usize) -> bool) -> (Boundaries, Vec<bool>) {
    let looped: Vec<bool> = (0..nets.nets().len()).map(looped).collect();
    let chosen = (0..).map(NetId).zip(&looped).filter(|(_, looped)| **looped).map(|(net, _)| net).collect();
    let loops = Loops { nets: chosen, radius: RADIUS };
    let diagram = Diagram::mixed(copper, nets, None, &Settings::default(), &loops).expect("a diagram");
    (diagram.boundaries().expect("whole boundaries"), looped)
}

/// What is cut: all but the frame where it borders on nothing.
fn cuts(found: &Boundaries) -> Vec<Vec<Point>> {
    let bare = |owner: Owner| owner == Owner::Background;
    let cut = found.edges.iter().filter(|e| !(e.is_border() && (bare(e.left) || bare(e.right))));
    cut.map(|edge| edge.path.flatten(Nm::from_um(1))).collect()
}

/// How far a fitted cut may be off at worst, in nanometres: in the inner corner of two offset
/// curves.
const OFF: f64 = 5_000.0;

/// A pixel of the flood, and how wide it takes cuts to be: a little less than the cutter is.
const PIXEL: f64 = 30_000.0;
const HALF: f64 = 80_000.0;

/// The pixels that the cuts leave.
struct Flood {
    columns: i64,
    rows: i64,
    corner: (f64, f64),
    /// 0 is cut, 1 is left; higher numbers are what was flooded from a net.
    pixels: Vec<usize>,
}

impl Flood {
    fn new(bounds: Rect, cuts: &[Vec<Point>]) -> Self {
        let bounds = bounds.inflate(Nm::from_um(1500));
        let count = |length: Nm| Nm::from_f64(length.to_f64() / PIXEL).get() + 1;
        let (columns, rows) = (count(bounds.width()), count(bounds.height()));
        let pixels = vec![1; usize::try_from(columns * rows).expect("a small scene")];
        let mut flood = Self { columns, rows, corner: bounds.min().to_f64(), pixels };
        for pair in cuts.iter().flat_map(|cut| cut.windows(2)) {
            let way = Shape::Stroke { from: pair[0], to: pair[1], radius: Nm::ZERO };
            let (low, high) = (flood.cell(way.bounds().min()), flood.cell(way.bounds().max()));
            for row in low.1 - 4..=high.1 + 4 {
                for column in low.0 - 4..=high.0 + 4 {
                    let (x, y) = flood.middle(column, row);
                    if oracle::distance(&way, x, y) <= HALF
                        && let Some(index) = flood.index(column, row)
                    {
                        flood.pixels[index] = 0;
                    }
                }
            }
        }
        flood
    }

    fn cell(&self, p: Point) -> (i64, i64) {
        let (x, y) = p.to_f64();
        let step = |d: f64| Nm::from_f64((d / PIXEL).floor()).get();
        (step(x - self.corner.0), step(y - self.corner.1))
    }

    fn middle(&self, column: i64, row: i64) -> (f64, f64) {
        let along = |n: i64| (Nm::new(n).to_f64() + 0.5) * PIXEL;
        (self.corner.0 + along(column), self.corner.1 + along(row))
    }

    fn index(&self, column: i64, row: i64) -> Option<usize> {
        let inside = (0..self.columns).contains(&column) && (0..self.rows).contains(&row);
        inside.then(|| usize::try_from(row * self.columns + column).expect("inside"))
    }

    /// Floods from `p` as `net`; the other net that is reached, if there is one.
    fn pour(&mut self, p: Point, net: usize) -> Option<usize> {
        let mut waiting = vec![self.cell(p)];
        while let Some((column, row)) = waiting.pop() {
            let Some(index) = self.index(column, row) else { continue };
            match self.pixels[index] {
                1 => self.pixels[index] = net + 2,
                other if other > 1 && other != net + 2 => return Some(other - 2),
                _ => continue,
            }
            waiting.extend([(column + 1, row), (column - 1, row), (column, row + 1), (column, row - 1)]);
        }
        None
    }
}

/// A point well inside the copper of a shape.
fn inside(shape: &Shape) -> Point {
    match shape {
        Shape::Disc { center, .. } => *center,
        Shape::Stroke { from, .. } => *from,
        Shape::Arc { arc, .. } => arc.start,
        // A ring's corner and the one within it.
        Shape::Polygon(polygon) => {
            let outer = polygon.contours()[0][0];
            let inner = polygon.contours()[1].iter().min_by_key(|corner| (**corner - outer).length_squared());
            outer.midpoint(*inner.expect("a ring"))
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn nets_with_loops_and_nets_without_are_all_parted(
        shapes in prop::collection::vec(any_shape(), 2..14),
        chosen in prop::collection::vec(any::<bool>(), 14),
    ) {
        let copper = layer(shapes);
        let nets = topology::recover(&copper, Method::Contact);
        // What is nearer than a cutter is wide the flood cannot see.
        let gap = topology::smallest_gap(&copper, &nets);
        prop_assume!(gap.is_none_or(|gap| gap.width > RADIUS * 2));
        let (found, looped) = mixed(&copper, &nets, |net| chosen[net]);
        let mut flood = Flood::new(copper.bounds().expect("copper"), &cuts(&found));
        for (i, feature) in copper.features.iter().enumerate() {
            let net = nets.of(i).index();
            let reached = flood.pour(inside(&feature.shape), net);
            prop_assert_eq!(reached, None, "nets {} ({:?}) joined to another", net, looped);
        }
        // What is no loop keeps off the loops.
        let has_loop = |owner: Owner| matches!(owner, Owner::Net(net) if looped[net.index()]);
        let midway = found.edges.iter().filter(|e| !e.is_border() && !has_loop(e.left) && !has_loop(e.right));
        for p in midway.flat_map(|edge| edge.path.flatten(Nm::from_um(1))) {
            let distances = oracle::distances(&copper, &nets, p.to_f64().0, p.to_f64().1);
            for (net, &distance) in distances.iter().enumerate().filter(|(net, _)| looped[*net]) {
                prop_assert!(distance >= RADIUS.to_f64() - OFF, "{distance} nm from net {net} at {p:?}");
            }
        }
    }

    #[test]
    fn all_with_loops_is_the_outline_and_none_the_voronoi_diagram(
        shapes in prop::collection::vec(any_shape(), 2..10),
    ) {
        let copper = layer(shapes);
        let nets = topology::recover(&copper, Method::Contact);
        let plain = |limit: Option<Nm>| {
            let settings = Settings { limit, ..Settings::default() };
            Diagram::new(&copper, &nets, None, &settings).expect("a diagram").boundaries().expect("whole boundaries").length()
        };
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-3 * a.max(b) + 1.0;
        let all = mixed(&copper, &nets, |_| true).0.length();
        prop_assert!(close(all, plain(Some(RADIUS))), "{all} nm of loops");
        let none = mixed(&copper, &nets, |_| false).0.length();
        prop_assert!(close(none, plain(None)), "{none} nm midway");
    }
}

#[test]
fn a_net_within_a_ring_shares_nothing_with_those_outside() {
    // The neighbour outside is nearer to the ring's inner corners than the net inside.
    let copper = layer([
        ring(0, 0, 2000),
        Shape::Disc { center: at(0, 0), radius: Nm::from_um(200) },
        Shape::Disc { center: at(2600, 0), radius: Nm::from_um(300) },
    ]);
    let nets = topology::recover(&copper, Method::Contact);
    let (found, _) = mixed(&copper, &nets, |net| net == nets.of(0).index());
    let inner: Vec<_> = found.edges.iter().filter(|edge| !edge.is_border()).collect();
    assert_eq!(inner.len(), 2, "the ring's two loops part all three: {inner:#?}");
}

#[test]
fn what_ends_on_a_loop_shares_a_node_with_it() {
    let copper = layer([
        Shape::Stroke { from: at(0, 0), to: at(0, 3000), radius: Nm::from_um(200) },
        Shape::Disc { center: at(2000, 0), radius: Nm::from_um(300) },
        Shape::Disc { center: at(2000, 3000), radius: Nm::from_um(300) },
    ]);
    let nets = topology::recover(&copper, Method::Contact);
    let (found, _) = mixed(&copper, &nets, |net| net == nets.of(0).index());
    let mut degrees = BTreeMap::new();
    for edge in found.edges.iter().filter_map(|edge| edge.ends) {
        *degrees.entry(edge.0).or_insert(0) += 1;
        *degrees.entry(edge.1).or_insert(0) += 1;
    }
    let forks = degrees.into_iter().filter(|(_, degree)| *degree == 3);
    let on_loop: Vec<_> = forks
        .map(|(node, _): (NodeId, u32)| found.nodes[node.0 as usize])
        .filter(|p| {
            (oracle::distance(&copper.features[0].shape, p.to_f64().0, p.to_f64().1) - 1e5).abs() < 5e3
        })
        .collect();
    assert_eq!(
        on_loop.len(),
        2,
        "the boundary of the discs begins at the loop and goes on behind it: {on_loop:?}"
    );
}
