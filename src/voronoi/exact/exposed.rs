//! Seeds in what one owner encloses: from every piece of edge that lies open a normal leads to the
//! medial axis.
//!
//! ```text
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//!   ▓▓▓┬───────┬▓▓▓      An edge lies open between the places where others cross it, or not at all. Where no
//!   ▓▓▓│ enclosed▓▓      vertex is known that has its foot there, the normal of its middle is a ray.
//!   ▓▓▓┴───────┴▓▓▓
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//! ```

use super::Diagram;
use super::form::{Form, Place, turn, unit};
use super::generator::Body;
use super::graph::Growth;
use super::tolerances::OFF;
use super::vertex::Junction;
use crate::geometry::BoxTree;
use crate::voronoi::plane::Spot;

/// Shorter pieces of an edge are none, unless they are all of it, in nanometres. Chosen: no cutter
/// fits what they enclose.
const SHORT: f64 = 200.0;

/// Bodies by place.
pub(super) struct Bodies<'a> {
    diagram: &'a Diagram,
    tree: &'a BoxTree,
}

/// How far along an edge a place is: nanometres, or a number in 0..4 that grows round a circle.
fn position(form: &Form, p: Spot) -> f64 {
    match (*form, form.place(p)) {
        (Form::Circle { sector, .. }, Place::Toward(n)) => turn(start(sector), n),
        (_, Place::Along(t)) => t,
        (Form::Line { .. }, Place::Toward(_)) => 0.0,
    }
}

fn start(sector: Option<[Spot; 2]>) -> Spot {
    sector.map_or(Spot::new(1.0, 0.0), |[from, _]| from)
}

/// The place at a position.
fn at_position(form: &Form, position: f64) -> Place {
    match *form {
        Form::Line { .. } => Place::Along(position),
        Form::Circle { sector, .. } => {
            // The inverse of [`turn`].
            let quarter = position.rem_euclid(4.0);
            let (x, y) = match quarter {
                q if q < 1.0 => (1.0 - q, q),
                q if q < 2.0 => (1.0 - q, 2.0 - q),
                q if q < 3.0 => (q - 3.0, 2.0 - q),
                q => (q - 3.0, q - 4.0),
            };
            let from = start(sector);
            Place::Toward(unit(Spot::new(from.x * x - from.y * y, from.y * x + from.x * y)))
        }
    }
}

impl<'a> Bodies<'a> {
    pub(super) fn new(diagram: &'a Diagram) -> Self {
        let bounds = || diagram.generators.bodies.iter().map(|body| diagram.bounds_of(body));
        Self { diagram, tree: diagram.bodies.get_or_init(|| BoxTree::new(bounds())) }
    }

    /// Whether copper lies off an edge with this foot and normal.
    pub(super) fn cover(&self, foot: Spot, normal: Spot) -> bool {
        self.hold(foot + normal * OFF, true)
    }

    /// Whether copper lies at `p`; what rings keep free ends within them where `beyond` says so.
    pub(super) fn hold(&self, p: Spot, beyond: bool) -> bool {
        let bodies = &self.diagram.generators.bodies;
        let found = self.tree.within([p.x, p.y, p.x, p.y]);
        let is_open = |body: &&Body| matches!(body, Body::Rings { open: true, .. });
        let (open, closed): (Vec<&Body>, Vec<&Body>) =
            found.into_iter().map(|i| &bodies[i]).partition(is_open);
        let is_beyond = beyond && !open.is_empty() && open.iter().all(|body| self.holds(body, p));
        is_beyond || closed.iter().any(|body| self.holds(body, p))
    }

    fn holds(&self, body: &Body, p: Spot) -> bool {
        let form = |i: u32| &self.diagram.forms()[i as usize];
        match body {
            Body::Disc(disc) => form(*disc).distance(p) < 0.0,
            Body::Strip([one, other]) => {
                form(*one).distance(p) < 0.0 && form(*other).distance(p) < 0.0 && form(*one).slack(p) >= 0.0
            }
            Body::Band(outer, inner) => {
                form(*outer).distance(p) < 0.0
                    && form(*outer).slack(p) >= 0.0
                    && inner.is_none_or(|inner| form(inner).distance(p) < 0.0)
            }
            Body::Rings { rings, open } => {
                let start = |i: u32| self.diagram.generators.start_of(i);
                let is_crossed =
                    |(&edge, &next): (&u32, &u32)| is_crossed(form(edge), [start(edge), start(next)], p);
                let crossed = |ring: &Vec<u32>| {
                    ring.iter().zip(ring.iter().cycle().skip(1)).filter(|&pair| is_crossed(pair)).count()
                };
                (rings.iter().map(crossed).sum::<usize>() % 2 == 1) != *open
            }
        }
    }
}

/// Whether the way from `p` in +x crosses an edge an odd number of times; a way along an end of it
/// is one a hair higher.
fn is_crossed(edge: &Form, [from, to]: [Spot; 2], p: Spot) -> bool {
    // Against the clock about the centre of an arc.
    let [from, to] = if edge.is_hollow() { [to, from] } else { [from, to] };
    let side = (to - from).cross(p - from);
    let chord = (from.y > p.y) != (to.y > p.y) && (side > 0.0) == (to.y > from.y);
    match *edge {
        Form::Line { .. } => chord,
        Form::Circle { center, radius, sector, .. } => {
            // Between the arc and its chord, which lies to the left of it.
            let is_level = (from.y - to.y).abs() <= 0.0;
            let is_upper = !is_level || to.x < from.x;
            let is_beyond = side < 0.0 || (side <= 0.0 && is_upper);
            let is_within = (p - center).length() < radius;
            chord != (is_within && (is_beyond || sector.is_none()))
        }
    }
}

impl Diagram {
    /// The box round a body: left, bottom, right, top.
    fn bounds_of(&self, body: &Body) -> [f64; 4] {
        let form = |i: u32| &self.forms()[i as usize];
        let round = |edges: &mut dyn Iterator<Item = [f64; 4]>| {
            let far = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
            edges.fold(far, |[a, b, c, d], [left, bottom, right, top]| {
                [a.min(left), b.min(bottom), c.max(right), d.max(top)]
            })
        };
        match body {
            Body::Disc(disc) => form(*disc).bounds(),
            Body::Strip(sides) => round(&mut sides.iter().map(|&i| form(i).bounds())),
            Body::Band(outer, _) => {
                let Form::Circle { center, .. } = *form(*outer) else { return form(*outer).bounds() };
                let middle = [center.x, center.y, center.x, center.y];
                round(&mut [form(*outer).bounds(), middle].into_iter())
            }
            Body::Rings { rings, open: false } => {
                round(&mut rings.iter().flatten().map(|&i| form(i).bounds()))
            }
            // It is everywhere but inside.
            Body::Rings { open: true, .. } => [f64::MIN, f64::MIN, f64::MAX, f64::MAX],
        }
    }

    /// Whether copper lies at `p`.
    pub(super) fn is_copper(&self, p: Spot) -> bool {
        Bodies::new(self).hold(p, false)
    }

    /// Sows where edges lie open of which no part of the graph is known.
    pub(super) fn sow_exposed(&self, growth: &mut Growth) {
        let bodies = Bodies::new(self);
        let mut feet: Vec<Vec<f64>> = vec![Vec::new(); self.forms().len()];
        let mut seen = 0;
        for (number, form) in (0_u32..).zip(self.forms()) {
            if growth.is_faulty() {
                return;
            }
            for piece in self.pieces(number).windows(2) {
                // Where the axis runs into a corner, the edge may go on in another part of the free
                // space.
                let is_off = |junction: &&Junction| junction.clearance >= self.tie;
                for junction in growth.junctions[seen..].iter().filter(is_off) {
                    for &tied in &junction.tied {
                        feet[tied as usize].push(position(&self.forms()[tied as usize], junction.at));
                    }
                }
                seen = growth.junctions.len();
                let [from, to] = [piece[0], piece[1]];
                let (foot, normal) = form.foot(at_position(form, f64::midpoint(from, to)));
                let slack = (to - from) * 1e-6;
                let is_known = |&at: &f64| at > from - slack && at < to + slack;
                if !feet[number as usize].iter().any(is_known) && !bodies.cover(foot, normal) {
                    if let Some(seed) = self.shoot((number, foot, normal), Some(&bodies)) {
                        growth.place(seed);
                    }
                    self.grow(growth);
                }
            }
        }
    }

    /// The positions on a generator where it begins, where others cross it, and where it ends.
    fn pieces(&self, number: u32) -> Vec<f64> {
        let form = &self.forms()[number as usize];
        let (end, scale) = match *form {
            Form::Line { length, .. } => (length, 1.0),
            Form::Circle { radius, sector: None, .. } => (4.0, radius),
            Form::Circle { radius, sector: Some([from, to]), .. } => (turn(from, to), radius),
        };
        if form.ends().is_none() && scale < SHORT {
            // A corner: all of it, or nothing.
            return Vec::new();
        }
        let mut positions = vec![0.0, end];
        self.index.visit(form.bounds(), |i| {
            let other = &self.forms()[i as usize];
            if i != number {
                let crossings = form.crossings(other).into_iter().flatten();
                positions.extend(crossings.filter(|&p| other.slack(p) >= -OFF).map(|p| position(form, p)));
            }
        });
        positions.retain(|at| (0.0..=end).contains(at));
        positions.sort_unstable_by(f64::total_cmp);
        positions.dedup_by(|b, a| (*b - *a) * scale < SHORT);
        if positions.len() == 1 {
            positions.push(end);
        }
        positions
    }
}
