//! The time that a program takes, held against a machine that is driven through it in small steps
//! of time.
//!
//! The driver shares nothing with the planner but Grbl's rule for corners: twenty thousand times a
//! second it looks how fast it may be, so that it can still slow down for every corner that it
//! knows of and stop at the end of what the buffer holds.

use std::path::{Path, PathBuf};

use voromill::geometry::{Nm, Point, Turn};
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Settings};
use voromill::toolpath::{Acceleration, Feed, Machine, Move, Position, Program, Section, Tool, measure};

/// Millimetres.
type Place = [f64; 3];

/// A straight way with the most speed along it; none for a rapid.
struct Leg {
    from: Place,
    to: Place,
    feed: Option<f64>,
}

impl Leg {
    fn direction(&self) -> Place {
        let length = self.length();
        [0, 1, 2].map(|axis| (self.to[axis] - self.from[axis]) / length)
    }

    fn length(&self) -> f64 {
        [0, 1, 2]
            .map(|axis| (self.to[axis] - self.from[axis]) * (self.to[axis] - self.from[axis]))
            .iter()
            .sum::<f64>()
            .sqrt()
    }
}

/// A machine that obeys its axes' limits (mm, s) and knows so many legs at once.
struct Driver {
    rapid: Place,
    acceleration: Place,
    deviation: f64,
    knows: usize,
}

/// The most that a vector of this direction may have so that no axis has more than its limit.
fn limited(limits: Place, direction: Place) -> f64 {
    let mut most = f64::MAX;
    for axis in 0..3 {
        if direction[axis].abs() > 1e-12 {
            most = most.min(limits[axis] / direction[axis].abs());
        }
    }
    most
}

impl Driver {
    fn speed(&self, leg: &Leg) -> f64 {
        leg.feed.unwrap_or(f64::MAX).min(limited(self.rapid, leg.direction()))
    }

    /// The speed on a circle that touches both legs and passes the corner at the deviation.
    fn corner(&self, before: &Leg, after: &Leg) -> f64 {
        let (a, b) = (before.direction(), after.direction());
        let cos = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).clamp(-1.0, 1.0);
        // Between the legs, as one stands in the corner: half a turn where they go straight on.
        let between = std::f64::consts::PI - libm::acos(cos);
        let straight = self.speed(before).min(self.speed(after));
        if between > std::f64::consts::PI - 1.5e-3 {
            return straight;
        }
        let sine = libm::sin(between / 2.0);
        let radius = self.deviation * sine / (1.0 - sine);
        let turn = [0, 1, 2].map(|axis| b[axis] - a[axis]);
        let size = (turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]).sqrt();
        let inwards = limited(self.acceleration, turn.map(|part| part / size));
        straight.min((inwards * radius).sqrt())
    }

    /// How long it takes from a standstill to a standstill.
    fn drive(&self, legs: &[Leg], dt: f64) -> f64 {
        let acceleration: Vec<f64> =
            legs.iter().map(|leg| limited(self.acceleration, leg.direction())).collect();
        let corner: Vec<f64> = legs.windows(2).map(|pair| self.corner(&pair[0], &pair[1])).collect();
        let (mut seconds, mut speed) = (0.0, 0.0_f64);
        for (index, leg) in legs.iter().enumerate() {
            let (mut gone, length, most) = (0.0, leg.length(), self.speed(leg));
            // How fast it may be at the end of this leg: each corner ahead asks for its own, and
            // the end of what is known for none.
            let last = (index + self.knows - 1).min(legs.len() - 1);
            let mut at_end = f64::MAX;
            for ahead in index..=last {
                let there = corner.get(ahead).filter(|_| ahead < last).copied().unwrap_or(0.0);
                let braking: f64 =
                    (index + 1..=ahead).map(|leg| 2.0 * acceleration[leg] * legs[leg].length()).sum();
                at_end = at_end.min((there * there + braking).sqrt());
            }
            while gone < length {
                let rest = length - gone;
                let may = (at_end * at_end + 2.0 * acceleration[index] * rest).sqrt().min(most);
                let next = (speed + acceleration[index] * dt).min(may);
                // Never quite still: the last step ends the leg.
                let step = ((speed + next) / 2.0 * dt).max(1e-7);
                if step >= rest {
                    seconds += dt * rest / step;
                    speed = next.min(at_end);
                    break;
                }
                gone += step;
                seconds += dt;
                speed = next;
            }
        }
        seconds
    }
}

fn place(at: Position) -> Place {
    [at.x, at.y, at.z].map(Nm::to_mm)
}

fn per_second(feed: Feed) -> f64 {
    feed.nm_per_second() / 1e6
}

/// The moves of a program as straight ways, in stretches from a stop to a stop, and the seconds
/// that it waits.
fn stretches(program: &Program, machine: &Machine) -> (Vec<Vec<Leg>>, f64) {
    let mut at = Position { z: program.safe, ..Position::default() };
    let (mut all, mut waits): (Vec<Vec<Leg>>, f64) = (Vec::new(), 0.0);
    for section in &program.sections {
        all.push(Vec::new());
        waits += f64::from(machine.spin_up) / 1000.0;
        for step in &section.moves {
            let legs = all.last_mut().expect("begun above");
            match *step {
                Move::Dwell { milliseconds } => {
                    waits += f64::from(milliseconds) / 1000.0;
                    all.push(Vec::new());
                }
                Move::Rapid { to } => legs.push(Leg { from: place(at), to: place(to), feed: None }),
                Move::Feed { to, feed } => {
                    legs.push(Leg { from: place(at), to: place(to), feed: Some(per_second(feed)) });
                }
                Move::Arc { to, center, turn, feed } => {
                    let (from, end) = (place(at), place(to));
                    let (x, y) = (center.x.to_mm(), center.y.to_mm());
                    let radius = ((from[0] - x) * (from[0] - x) + (from[1] - y) * (from[1] - y)).sqrt();
                    let [start, stop] = [from, end].map(|p| libm::atan2(p[1] - y, p[0] - x));
                    let full = 2.0 * std::f64::consts::PI;
                    let ccw = (stop - start).rem_euclid(full);
                    let sweep = match turn {
                        _ if at.point() == to.point() => full,
                        Turn::CounterClockwise => ccw,
                        Turn::Clockwise => full - ccw,
                    };
                    let sign = if turn == Turn::Clockwise { -1.0 } else { 1.0 };
                    // A chord that leaves the circle by two micrometres.
                    let chord = 2.0 * libm::acos((1.0 - 0.002 / radius).max(-1.0));
                    let count = (sweep / chord).floor().max(1.0);
                    let (mut before, mut index) = (from, 1.0);
                    while index <= count {
                        let angle = start + sign * sweep * index / count;
                        let height = from[2] + (end[2] - from[2]) * index / count;
                        let next = [x + radius * libm::cos(angle), y + radius * libm::sin(angle), height];
                        legs.push(Leg { from: before, to: next, feed: Some(per_second(feed)) });
                        (before, index) = (next, index + 1.0);
                    }
                }
            }
            at = step.to().unwrap_or(at);
        }
    }
    for legs in &mut all {
        legs.retain(|leg| leg.length() > 1e-9);
    }
    (all, waits)
}

/// A machine whose axes all differ.
fn uneven() -> Machine {
    let [x, y, z] = [1200, 900, 500].map(Feed::from_mm_per_min);
    Machine {
        rapid: [x, y, z],
        feed: Some([x, y, z]),
        acceleration: [60, 40, 25].map(Acceleration::from_mm_per_s2),
        ..Machine::default()
    }
}

/// The planner's seconds and the driver's.
fn both(program: &Program, machine: &Machine, knows: usize) -> (f64, f64) {
    let driver = Driver {
        rapid: machine.rapid.map(per_second),
        acceleration: machine.acceleration.map(|a| a.nm_per_s2() / 1e6),
        deviation: machine.junction_deviation.to_mm(),
        knows,
    };
    let (stretches, waits) = stretches(program, machine);
    let driven: f64 = stretches.iter().map(|legs| driver.drive(legs, 5e-5)).sum();
    (measure(program, machine).seconds, driven + waits)
}

fn assert_agree(program: &Program, machine: &Machine, what: &str) {
    let (planned, driven) = both(program, machine, 15);
    let off = (planned - driven).abs() / driven;
    assert!(off < 0.02, "{what}: planned {planned:.3} s, driven {driven:.3} s, {:.2} %", off * 100.0);
}

fn at(x: i64, y: i64, z: i64) -> Position {
    Position { x: Nm::from_um(x), y: Nm::from_um(y), z: Nm::from_um(z) }
}

fn program(moves: Vec<Move>) -> Program {
    let tool: Tool = "endmill:1mm".parse().expect("a tool");
    let section = Section { tool, label: "a test".to_owned(), moves };
    Program { title: "a test".to_owned(), notes: Vec::new(), safe: Nm::from_mm(2), sections: vec![section] }
}

#[test]
fn corners_arcs_ramps_and_dwells_take_the_time_that_a_driven_machine_takes() {
    let feed = Feed::from_mm_per_min(800);
    let mut moves =
        vec![Move::Rapid { to: at(5000, 3000, 2000) }, Move::Feed { to: at(5000, 3000, -100), feed }];
    for step in 1..40_i64 {
        // A zigzag of all angles, some of it uphill.
        let (x, y) = (5000 + step * 700, 3000 + (step * step * 137) % 2900);
        moves.push(Move::Feed { to: at(x, y, -100 - (step % 3) * 200), feed });
        if step % 10 == 0 {
            moves.push(Move::Dwell { milliseconds: 120 });
        }
    }
    let end = moves.last().and_then(Move::to).expect("a move");
    let center = end.point() + (Point::new(Nm::from_mm(2), Nm::ZERO) - Point::default());
    moves.push(Move::Arc { to: end, center, turn: Turn::Clockwise, feed });
    let to = Position::over(center + (center - end.point()), end.z - Nm::from_um(300));
    moves.push(Move::Arc { to, center, turn: Turn::CounterClockwise, feed });
    moves.push(Move::Rapid { to: Position { z: Nm::from_mm(2), ..to } });
    moves.push(Move::Rapid { to: at(0, 0, 2000) });
    assert_agree(&program(moves), &uneven(), "zigzag");
}

#[test]
fn short_motions_run_no_faster_than_the_buffer_lets_them_stop() {
    let feed = Feed::from_mm_per_min(900);
    let moves = (1..=1000).map(|step| Move::Feed { to: at(step * 10, 0, 2000), feed }).collect();
    let program = program(moves);
    assert_agree(&program, &uneven(), "a thousand moves of ten micrometres");
    let (planned, all_known) = both(&program, &uneven(), 1000);
    assert!(planned > 1.3 * all_known, "{planned:.2} s, and {all_known:.2} s if all were known");
}

#[test]
fn the_programs_of_a_board_take_the_time_that_a_driven_machine_takes() {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    let loaded = import::load(&[path], &Selection::default()).expect("a board");
    let settings = Settings::resolve(Options::default()).expect("the defaults");
    let job = job::mill(loaded, &settings).expect("a job");
    for written in &job.programs {
        for machine in [Machine::default(), uneven()] {
            assert_agree(&written.program, &machine, written.part.name());
        }
    }
}
