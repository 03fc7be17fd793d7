//! How good the order of trails is: `cargo bench --bench order [-- TRAILS…]`.
//!
//! Random trails and holes; the travel between them, nearest next and improved, beside a length below which no order can be:
//! Held and Karp's bound (The traveling-salesman problem and minimum spanning trees, 1970), a spanning tree whose penalties push every end of
//! a trail to one way through the air. The bound itself lies up to a percent or two below the best order. Ten thousand take minutes.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

use std::time::Instant;

use voromill::board::{Hole, Plating};
use voromill::geometry::{Nm, Path, Point};
use voromill::toolpath::strategy::{Drilling, Isolation, Narrow, Role, drill, isolate};
use voromill::toolpath::{Heights, Machine, Order, Placement, Program, Section, Tool, measure};
use voromill::topology::NetId;
use voromill::voronoi::{Boundaries, Boundary, NodeId, Owner};

fn main() {
    let sizes: Vec<usize> = std::env::args().skip(1).filter_map(|argument| argument.parse().ok()).collect();
    println!("what      count   greedy mm  improved mm   bound mm   over %   seconds");
    for count in if sizes.is_empty() { vec![100, 1000, 10_000] } else { sizes } {
        let trails = scattered(count, true);
        row("trails", &trails, |order| cut(&trails, order));
        let holes = scattered(count, false);
        row("holes", &holes, |order| drilled(&holes, order));
    }
}

/// A trail by its ends.
type Trail = [Point; 2];

/// Prints what an order comes to.
fn row(what: &str, trails: &[Trail], work: impl Fn(Order) -> Section) {
    let greedy = travel(work(Order::Greedy));
    let start = Instant::now();
    let section = work(Order::Improved);
    let seconds = start.elapsed().as_secs_f64();
    let improved = travel(section);
    let bound = Bound::new(trails).rise(improved);
    let over = (improved / bound - 1.0) * 100.0;
    let [greedy, improved, bound] = [greedy, improved, bound].map(|length| length / 1e6);
    println!(
        "{what:8} {:6} {greedy:11.1} {improved:12.1} {bound:10.1} {over:8.2} {seconds:9.3}",
        trails.len()
    );
}

/// Trails of some millimetres, as dense as boards have them; or points.
fn scattered(count: usize, long: bool) -> Vec<Trail> {
    let mut state = 88_172_645_463_325_252_u64;
    let mut draw = |below: i64| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        i64::try_from(state >> 1).expect("63 bits") % below
    };
    // One for every 4 mm².
    let side = 2_000_000 * i64::try_from(count).expect("a count").isqrt();
    (0..count)
        .map(|_| {
            let from = Point::new(Nm::new(draw(side)), Nm::new(draw(side)));
            let reach = 4_000_000;
            let by = || Nm::new(0);
            let (x, y) = if long {
                (Nm::new(draw(reach) - reach / 2), Nm::new(draw(reach) - reach / 2))
            } else {
                (by(), by())
            };
            [from, Point::new(from.x + x, from.y + y)]
        })
        .collect()
}

fn heights() -> Heights {
    Heights { safe: Nm::from_mm(2), approach: Nm::from_um(200), cut: Nm::from_um(100), step: None }
}

/// The trails as boundaries that meet nowhere.
fn cut(trails: &[Trail], order: Order) -> Section {
    let tool: Tool = "vbit:0.1mm:30deg".parse().expect("a tool");
    let node = |index: usize| NodeId(u32::try_from(index).expect("few"));
    let edges = trails.iter().enumerate().map(|(index, &[from, to])| Boundary {
        path: Path::polyline([from, to]).expect("two points"),
        clearance: vec![Nm::from_mm(1); 2],
        left: Owner::Net(NetId(0)),
        right: Owner::Net(NetId(1)),
        ends: Some((node(2 * index), node(2 * index + 1))),
    });
    let boundaries = Boundaries { nodes: trails.as_flattened().to_vec(), edges: edges.collect() };
    let (placement, machine) = (Placement::default(), Machine::default());
    let settings = Isolation {
        tool: &tool,
        heights: heights(),
        placement: &placement,
        order,
        machine: &machine,
        narrow: Narrow::Centre,
        adaptive: None,
    };
    isolate("trails", &boundaries, &[], |_| Role::Cut, |_| String::new(), &settings).0
}

/// Holes at the beginnings.
fn drilled(holes: &[Trail], order: Order) -> Section {
    let hole = |&[start, _]: &Trail| Hole {
        path: Path { start, segments: Vec::new() },
        diameter: Nm::from_um(800),
        plating: Plating::Plated,
        tool: 1,
        line: 1,
    };
    let (placement, holes) = (Placement::default(), holes.iter().map(hole).collect::<Vec<_>>());
    let settings = Drilling {
        drills: &[],
        tolerance: Nm::ZERO,
        mill: None,
        heights: heights(),
        placement: &placement,
        order,
        dwell: 0,
        speeds: (None, None),
    };
    drill(&holes, &settings).0.remove(0)
}

/// The length of the level rapids, in nanometres; the first begins at zero.
fn travel(section: Section) -> f64 {
    let program =
        Program { title: String::new(), notes: Vec::new(), safe: heights().safe, sections: vec![section] };
    measure(&program, &Machine::default()).rapid_length.to_f64()
}

/// Held and Karp's bound of the way from zero through all trails.
///
/// ```text
///   home ╌╌ a══b ╌╌ c══d ╌╌ …     ══ a trail, ╌╌ a way through the air: as many as there are trails, a tree
/// ```
struct Bound {
    ends: Vec<(f64, f64)>,
    penalties: Vec<f64>,
}

impl Bound {
    fn new(trails: &[Trail]) -> Self {
        let mut ends: Vec<_> = trails.as_flattened().iter().map(|end| end.to_f64()).collect();
        // Home twice: as a trail that is left at zero and never entered.
        ends.extend([(0.0, 0.0); 2]);
        Self { penalties: vec![0.0; ends.len()], ends }
    }

    /// The highest bound found in a number of steps towards `length`, that of a known order.
    fn rise(mut self, length: f64) -> f64 {
        let (mut best, mut boldness, mut idle) = (f64::NEG_INFINITY, 1.0, 0);
        for _ in 0..steps(self.ends.len()) {
            let (bound, degrees) = self.tree();
            if bound > best * (1.0 + 1e-6) || best < 0.0 {
                (best, idle) = (bound.max(best), 0);
            } else {
                idle += 1;
                if idle % 4 == 0 {
                    boldness *= 0.6;
                }
            }
            let off: f64 = degrees.iter().map(|&degree| f64::from(degree - 1) * f64::from(degree - 1)).sum();
            if off < 0.5 {
                break;
            }
            let step = boldness * (length - bound).max(length * 1e-4) / off;
            for (penalty, &degree) in self.penalties.iter_mut().zip(&degrees) {
                *penalty += step * f64::from(degree - 1);
            }
        }
        best
    }

    /// The shortest tree (Prim) with the ways lengthened by the penalties of their ends, less all penalties; and how many ways come to each end.
    /// The order's last end has no way, so the least penalty counts twice.
    fn tree(&self) -> (f64, Vec<i32>) {
        let (trails, home) = (self.ends.len() / 2, self.ends.len() - 2);
        let mut near = vec![(f64::INFINITY, home, home); trails];
        let mut degrees = vec![0; self.ends.len()];
        let mut waiting: Vec<usize> = (0..trails - 1).collect();
        let (mut joined, mut sum) = (trails - 1, 0.0);
        while !waiting.is_empty() {
            let (mut best, mut place) = (f64::INFINITY, 0);
            for (index, &trail) in waiting.iter().enumerate() {
                let nearest = &mut near[trail];
                for from in [2 * joined, 2 * joined + 1] {
                    // Home is never entered.
                    if from == home + 1 {
                        continue;
                    }
                    for to in [2 * trail, 2 * trail + 1] {
                        let length = self.length(from, to);
                        if length < nearest.0 {
                            *nearest = (length, from, to);
                        }
                    }
                }
                if nearest.0 < best {
                    (best, place) = (nearest.0, index);
                }
            }
            joined = waiting.swap_remove(place);
            let (length, from, to) = near[joined];
            sum += length;
            degrees[from] += 1;
            degrees[to] += 1;
        }
        let last = (0..home).min_by(|&a, &b| self.penalties[a].total_cmp(&self.penalties[b])).unwrap_or(0);
        degrees[last] += 1;
        degrees[home + 1] = 1;
        (sum + self.penalties[last] - self.penalties[..=home].iter().sum::<f64>(), degrees)
    }

    fn length(&self, a: usize, b: usize) -> f64 {
        let ((x, y), (u, v)) = (self.ends[a], self.ends[b]);
        let (dx, dy) = (x - u, y - v);
        (dx * dx + dy * dy).sqrt() + self.penalties[a] + self.penalties[b]
    }
}

/// How often the penalties of so many ends are changed: until the bound rises no more, but for thousands not for hours.
const fn steps(ends: usize) -> usize {
    if ends > 4000 { 60 } else { 300 }
}
