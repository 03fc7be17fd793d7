//! How good the order of trails is: `cargo bench --bench order [-- TRAILS…]`.
//!
//! Random trails and holes; the travel between them, nearest next and improved, beside a length
//! below which no order can be: Held and Karp's bound (The traveling-salesman problem and minimum
//! spanning trees, 1970), a spanning tree whose penalties push every end of a trail to one way
//! through the air. The bound itself lies up to a percent or two below the best order. Ten thousand
//! take minutes.
#![allow(clippy::print_stdout, reason = "a program that prints its figures")]

use std::time::Instant;

use voromill::board::{Hole, Plating};
use voromill::geometry::{Nm, Path, Point};
use voromill::toolpath::strategy::{Drilling, Isolation, Narrow, Role, drill, isolate};
use voromill::toolpath::{
    DrillSpeeds, Heights, Machine, Order, POINT, Placement, Program, Section, Tool, measure,
};
use voromill::topology::{DisjointSets, NetId};
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
    let boundaries =
        Boundaries { nodes: trails.as_flattened().to_vec(), edges: edges.collect(), links: vec![] };
    let (placement, machine) = (Placement::default(), Machine::default());
    let settings = Isolation {
        tool: &tool,
        heights: heights(),
        placement: &placement,
        order,
        machine: &machine,
        narrow: Narrow::Centre,
        adaptive: None,
        direction: None,
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
        bored_from: None,
        heights: heights(),
        turn: None,
        placement: &placement,
        order,
        dwell: 0,
        tips: false,
        one: false,
        speeds: DrillSpeeds::default(),
        point: POINT,
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
    ///
    /// The penalties are sought with a tree of short ways alone, which is not quite the shortest;
    /// the bound is that of the shortest.
    fn rise(mut self, length: f64) -> f64 {
        let ways = self.short_ways();
        let mut best = (f64::NEG_INFINITY, self.penalties.clone());
        let (mut boldness, mut idle) = (1.0, 0);
        for _ in 0..STEPS {
            let (bound, degrees) = self.tree_of(&ways);
            if bound > best.0 {
                idle = if bound > best.0 * (1.0 + 1e-6) { 0 } else { idle + 1 };
                best = (bound, self.penalties.clone());
            } else {
                idle += 1;
            }
            if idle == PATIENCE {
                (boldness, idle) = (boldness * 0.7, 0);
                self.penalties.clone_from(&best.1);
                continue;
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
        self.penalties = best.1;
        self.tree().0
    }

    /// The ways from each end to its nearest, and those of the shortest tree, so that all trails
    /// hang together.
    fn short_ways(&self) -> Vec<(usize, usize)> {
        const NEAR: usize = 10;
        // Ends in strips as wide as about ten of them: the nearest are hardly ever farther than in
        // the strips beside.
        let ends = self.ends.len() - 1;
        let extent = self.ends.iter().map(|end| end.0).fold(0.0, f64::max);
        let width = extent / (f64::from(u32::try_from(ends).expect("few")) / 10.0).sqrt() + 1.0;
        let mut order: Vec<usize> = (0..ends).collect();
        let strip = |end: usize| (self.ends[end].0 / width).floor();
        order.sort_by(|&a, &b| strip(a).total_cmp(&strip(b)).then(self.ends[a].1.total_cmp(&self.ends[b].1)));
        let mut ways = self.joins();
        for &from in &order {
            let mut near: Vec<(f64, usize)> = Vec::new();
            for beside in [-1.0, 0.0, 1.0] {
                let key = (strip(from) + beside, self.ends[from].1);
                let middle = order.partition_point(|&end| (strip(end), self.ends[end].1) < key);
                let window = &order[middle.saturating_sub(3 * NEAR)..(middle + 3 * NEAR).min(ends)];
                near.extend(
                    window.iter().filter(|&&to| to / 2 != from / 2).map(|&to| (self.length(from, to), to)),
                );
            }
            near.sort_by(|a, b| a.0.total_cmp(&b.0));
            ways.extend(near.into_iter().take(NEAR).map(|(_, to)| (from.min(to), from.max(to))));
        }
        ways.sort_unstable();
        ways.dedup();
        ways
    }

    /// As [`Bound::tree`], of some ways alone (Kruskal).
    fn tree_of(&self, ways: &[(usize, usize)]) -> (f64, Vec<i32>) {
        let mut sorted: Vec<(f64, usize, usize)> =
            ways.iter().map(|&(a, b)| (self.length(a, b), a, b)).collect();
        sorted.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut parts = DisjointSets::new(self.ends.len() / 2);
        let trail = |end: usize| u32::try_from(end / 2).expect("few trails");
        let mut joins = Vec::with_capacity(self.ends.len() / 2);
        for (_, a, b) in sorted {
            if parts.union(trail(a), trail(b)) {
                joins.push((a, b));
            }
        }
        self.less_penalties(&joins)
    }

    /// The shortest tree with the ways lengthened by the penalties of their ends, less all
    /// penalties; and how many ways come to each end.
    fn tree(&self) -> (f64, Vec<i32>) {
        self.less_penalties(&self.joins())
    }

    /// The ways of the shortest tree (Prim).
    fn joins(&self) -> Vec<(usize, usize)> {
        let (trails, home) = (self.ends.len() / 2, self.ends.len() - 2);
        let mut near = vec![(f64::INFINITY, home, home); trails];
        let mut waiting: Vec<usize> = (0..trails - 1).collect();
        let (mut joined, mut joins) = (trails - 1, Vec::with_capacity(trails));
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
            let (_, from, to) = near[joined];
            joins.push((from.min(to), from.max(to)));
        }
        joins
    }

    /// The length of a tree, less all penalties, and its degrees. The order's last end has no way,
    /// so the least penalty counts twice.
    fn less_penalties(&self, joins: &[(usize, usize)]) -> (f64, Vec<i32>) {
        let home = self.ends.len() - 2;
        let mut degrees = vec![0; self.ends.len()];
        for &(a, b) in joins {
            degrees[a] += 1;
            degrees[b] += 1;
        }
        let last = (0..home).min_by(|&a, &b| self.penalties[a].total_cmp(&self.penalties[b])).unwrap_or(0);
        degrees[last] += 1;
        degrees[home + 1] = 1;
        let sum: f64 = joins.iter().map(|&(a, b)| self.length(a, b)).sum();
        (sum + self.penalties[last] - self.penalties[..=home].iter().sum::<f64>(), degrees)
    }

    fn length(&self, a: usize, b: usize) -> f64 {
        let ((x, y), (u, v)) = (self.ends[a], self.ends[b]);
        let (dx, dy) = (x - u, y - v);
        (dx * dx + dy * dy).sqrt() + self.penalties[a] + self.penalties[b]
    }
}

/// How often the penalties are changed, and how many changes in vain make them smaller. Measured:
/// twice as many raise the bound by less than a tenth of a percent.
const STEPS: usize = 1500;
const PATIENCE: usize = 12;
