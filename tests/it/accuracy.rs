//! How far cuts are from the true bisector on every real board, judged by distances from an index
//! of the tests' own (`oracle::field`), as `docs/accuracy.md` has it.
//!
//! Places are looked at every 50 µm, three in each segment at least. Where the true bisector is, is
//! found by walking from the cut up or down the slope of the difference of the two distances until
//! that is less than a nanometre.

use std::fmt::Write as _;
use std::path::Path;

use rayon::prelude::*;

use voromill::geometry::{Nm, Point, Segment};
use voromill::topology::{self, Method, NetId, Nets};
use voromill::voronoi::{Boundaries, Boundary, Diagram, Frame, Owner, Settings};

use crate::oracle::field::{Field, Reach, Spot};
use crate::real_boards::{self, Layer};

/// 500 DPI.
const PITCH: Nm = Nm::new(50_800);
/// How far apart the places are that are looked at, in nanometres.
const STEP: f64 = 50_000.0;
/// An unoptimised test looks at layers with at most so many features.
const FEATURES_UNOPTIMISED: usize = 300;

/// What is found at one place of a cut, in nanometres.
#[derive(Clone, Copy)]
struct Off {
    at: Spot,
    /// How far the true boundary is.
    bisector: f64,
    /// The difference of the distances to the nets that it parts, or to a third one that is nearer.
    difference: f64,
    /// How much of the cut the place stands for.
    weight: f64,
}

/// Places of a cut, evenly within each segment, with the length that each stands for.
fn places(edge: &Boundary) -> Vec<(Spot, f64)> {
    let mut places = Vec::new();
    for (from, segment) in edge.path.steps() {
        let length = segment.length(from);
        let mut count = 3.0;
        while length / count > STEP {
            count += 2.0;
        }
        let mut place = 0.5;
        while place < count {
            places.push((along(from, segment, place / count), length / count));
            place += 1.0;
        }
    }
    places
}

fn along(from: Point, segment: &Segment, part: f64) -> Spot {
    if let Some(arc) = segment.arc(from) {
        return arc.at(part).into();
    }
    let ((ax, ay), (bx, by)) = (from.to_f64(), segment.to().to_f64());
    [ax + (bx - ax) * part, ay + (by - ay) * part]
}

/// What is found along all cuts between two nets.
fn offs(field: &Field, found: &Boundaries) -> Vec<Off> {
    let of = |edge: &Boundary| {
        let (Owner::Net(left), Owner::Net(right)) = (edge.left, edge.right) else { return Vec::new() };
        let off = |(at, weight)| off(field, at, [left, right], weight);
        places(edge).into_iter().map(off).collect()
    };
    found.edges.par_iter().flat_map_iter(of).collect()
}

fn off(field: &Field, at: Spot, pair: [NetId; 2], weight: f64) -> Off {
    let seen = field.see(at, pair);
    let [left, right] = seen.two;
    let near = if left.distance < right.distance { left } else { right };
    // What lies in the region of a third net is off by the way to the border of that.
    let excess = seen.other.map_or(0.0, |other| (near.distance - other.distance).max(0.0));
    let way_out = seen.other.map_or(0.0, |other| excess / slope(near, other).1.max(0.1));
    let bisector = to_bisector(field, at, pair, seen.two).max(way_out);
    Off { at, bisector, difference: (left.distance - right.distance).abs().max(excess), weight }
}

/// How the difference of two distances changes: the vector and its length.
fn slope(one: Reach, other: Reach) -> (Spot, f64) {
    let slope = [0, 1].map(|i| one.away[i] - other.away[i]);
    (slope, (slope[0] * slope[0] + slope[1] * slope[1]).sqrt())
}

/// How far from `at` two nets are equally far, straight up or down the slope of the difference: by
/// the rule of false position.
fn to_bisector(field: &Field, at: Spot, pair: [NetId; 2], [left, right]: [Reach; 2]) -> f64 {
    let difference = left.distance - right.distance;
    let (slope, steepness) = slope(left, right);
    if difference.abs() < 1.0 || steepness < 1e-3 {
        return difference.abs();
    }
    let way = slope.map(|part| -part / steepness * difference.signum());
    let miss = |t: f64| {
        let [left, right] = field.see([at[0] + way[0] * t, at[1] + way[1] * t], pair).two;
        (left.distance - right.distance) * difference.signum()
    };
    let (mut low, mut high) = ((0.0, difference.abs()), difference.abs() / steepness);
    let mut beyond = miss(high);
    while beyond > 1.0 {
        if high > 1e6 {
            return high;
        }
        (low, high) = ((high, beyond), high * 1.5);
        beyond = miss(high);
    }
    for _ in 0..50 {
        if beyond > -1.0 {
            break;
        }
        let middle = low.0 + (high - low.0) * (low.1 / (low.1 - beyond)).clamp(0.05, 0.95);
        let found = miss(middle);
        if found > 0.0 {
            low = (middle, found)
        } else {
            (high, beyond) = (middle, found)
        }
        if low.1 < 1.0 {
            return low.0;
        }
    }
    high
}

/// Figures of a set of places, in nanometres.
struct Figures {
    /// Of the distance to the bisector: the median, the 99th percentile and the worst.
    bisector: [f64; 3],
    /// Of the difference of the distances: the median, the 95th and 99th percentile and the worst.
    difference: [f64; 4],
    /// The place that is farthest from its bisector.
    worst: Spot,
    /// The length of all cuts, in millimetres.
    length: f64,
}

impl Figures {
    fn of(mut offs: Vec<Off>) -> Self {
        let difference = [0.5, 0.95, 0.99, 1.0].map(|part| percentile(&mut offs, |off| off.difference, part));
        let bisector = [0.5, 0.99, 1.0].map(|part| percentile(&mut offs, |off| off.bisector, part));
        let worst = offs.last().map_or([0.0; 2], |off| off.at);
        let length = offs.iter().map(|off| off.weight).sum::<f64>() / 1e6;
        Self { bisector, difference, worst, length }
    }
}

/// The value that so much of the whole length does not exceed; sorts by it.
fn percentile(offs: &mut [Off], of: fn(&Off) -> f64, part: f64) -> f64 {
    offs.sort_unstable_by(|a, b| of(a).total_cmp(&of(b)));
    let wanted = part * offs.iter().map(|off| off.weight).sum::<f64>();
    let mut sum = 0.0;
    let reached = offs.iter().find(|off| {
        sum += off.weight;
        part < 1.0 && sum >= wanted
    });
    reached.or(offs.last()).map_or(0.0, of)
}

/// The figures of one layer: its cuts as they are placed, and as they are fitted.
struct Measured {
    name: String,
    nets: usize,
    pitch: Nm,
    placed: Figures,
    fitted: Figures,
}

fn measure(layer: &Layer) -> Measured {
    let Layer { name, copper, outline } = layer;
    let nets = topology::recover(copper, Method::Contact);
    let gap = topology::smallest_gap(copper, &nets);
    // As the program does it: what is narrower than three pixels is not surely seen.
    let pitch = gap.map_or(PITCH, |gap| (gap.width / 3).max(Nm::from_um(5)).min(PITCH));
    let field = Field::new(copper, &nets);
    let figures = |settings: Settings| {
        let diagram = Diagram::new(copper, &nets, outline.as_ref(), &settings).expect("a diagram");
        Figures::of(offs(&field, &diagram.boundaries().expect("whole boundaries")))
    };
    let fitted = Settings { pitch, ..Settings::default() };
    // With a tolerance of a nanometre every placed point is a vertex.
    let placed = Settings { tolerance: Nm::new(1), arcs: false, ..fitted.clone() };
    let nets = Nets::nets(&nets).len();
    Measured { name: name.clone(), nets, pitch, placed: figures(placed), fitted: figures(fitted) }
}

impl Measured {
    /// What is not as good as it must be.
    fn wrong(&self) -> String {
        let mut wrong = String::new();
        let Self { name, placed, fitted, .. } = self;
        for (what, found, most) in [
            ("median before fitting", placed.bisector[0], 100.0),
            ("99th percentile before fitting", placed.bisector[1], 1_000.0),
            ("worst after fitting", fitted.bisector[2], 2_000.0),
            ("95th percentile of the difference", fitted.difference[1], 2_000.0),
            ("worst difference", fitted.difference[3], 5_000.0),
        ] {
            if found > most {
                let [x, y] = fitted.worst.map(|x| x / 1e6);
                let _ = writeln!(
                    wrong,
                    "{name}: {what} {found:.0} nm, more than {most:.0}; the worst is at {x:.4}, {y:.4} mm"
                );
            }
        }
        wrong
    }

    /// A row of the table: what figures do not exceed, in micrometres.
    fn row(&self) -> String {
        let Self { name, nets, pitch, placed, fitted } = self;
        let mut row =
            format!("| {name} | {nets} | {:.0} | {:.0} |", pitch.to_f64() / 1000.0, fitted.length / 10.0);
        for nanometres in placed.bisector.into_iter().chain(fitted.bisector).chain(fitted.difference) {
            let _ = write!(row, " {} |", at_most(nanometres / 1000.0));
        }
        row
    }
}

/// The next of a few steps in micrometres, so that small changes of a figure do not show.
fn at_most(micrometres: f64) -> f64 {
    let steps = [0.1, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0];
    steps.into_iter().find(|&step| micrometres <= step).unwrap_or(f64::INFINITY)
}

/// Layers with the length of all boundaries between their nets, in millimetres, by Boost's exact
/// segment diagram of the copper's edges (64 corners to a circle, chords within a micrometre), up
/// to a frame two millimetres round the copper.
const EXACT: &[(&str, f64)] = &[
    ("gerbv_protel_se_sg front", 6173.3),
    ("p2g_project_controller back", 334.17),
    ("visolate_dan front", 1055.60),
    ("visolate_eaglecad1 front", 1872.13),
    ("visolate_example front", 1869.31),
    ("visolate_numpres front", 786.47),
    ("visolate_orcad_rs232 back", 168.79),
    ("visolate_orcad_rs232 front", 225.13),
];

#[test]
fn boundaries_are_as_long_as_in_an_exact_diagram() {
    let mut wrong = String::new();
    for Layer { name, copper, .. } in real_boards::layers(usize::MAX) {
        let Some((_, exact)) = EXACT.iter().find(|(layer, _)| *layer == name) else { continue };
        let nets = topology::recover(&copper, Method::Contact);
        let settings = Settings { frame: Frame::Rectangle(Nm::from_mm(2)), ..Settings::default() };
        let found = Diagram::new(&copper, &nets, None, &settings)
            .expect("a diagram")
            .boundaries()
            .expect("whole boundaries");
        let ours = found.length() / 1e6;
        let row = format!("| {name} | {} | {exact:.1} | {ours:.1} |", nets.nets().len());
        println!("{row} {:+.4} %", (ours / exact - 1.0) * 100.0);
        if (ours / exact - 1.0).abs() > 0.001 || !documented(&row) {
            let _ = writeln!(wrong, "{row} is off by more than 0.1 %, or not in docs/accuracy.md");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// Whether a row is in the docs.
fn documented(row: &str) -> bool {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/accuracy.md");
    std::fs::read_to_string(&file).unwrap_or_default().contains(row)
}

#[test]
fn cuts_run_on_the_true_bisectors_of_every_board() {
    let measured: Vec<Measured> =
        real_boards::layers(FEATURES_UNOPTIMISED).map(|layer| measure(&layer)).collect();
    let measured: Vec<_> = measured.into_iter().filter(|layer| layer.nets > 1).collect();
    for Measured { name, placed, fitted, .. } in &measured {
        let [[.., before], [.., after]] = [placed.bisector, fitted.bisector];
        println!("{name}: {before:.0} nm before, {after:.0} after at {:.0?}", fitted.worst);
    }
    let wrong: String = measured.iter().map(Measured::wrong).collect();
    assert!(wrong.is_empty(), "{wrong}");

    let rows: Vec<String> = measured.iter().map(Measured::row).collect();
    if !rows.iter().all(|row| documented(row)) {
        let actual = Path::new(env!("CARGO_TARGET_TMPDIR")).join("accuracy.md");
        std::fs::write(&actual, rows.join("\n")).expect("the target folder is writable");
        panic!("docs/accuracy.md is not what the boards give: see {}", actual.display());
    }
}
