//! How deep inside the copper of a net a place lies: the distance to its edge, exactly, however far
//! that is.

use crate::board::Shape;
use crate::geometry::{Nm, Point, Polygon};
use crate::topology::{NetId, Proximity};

use super::sheet::Sheet;

/// The edges of a net, to be asked how far they are.
pub(super) struct Interior<'a> {
    sheet: &'a Sheet<'a>,
    net: NetId,
    edges: Proximity,
    /// As far as any edge can be from any place.
    most: Nm,
}

/// A place on a way, and how deep it lies inside, in nanometres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Deepest {
    pub(super) at: Point,
    pub(super) depth: f64,
}

/// How much deeper the deepest place may be than what is found, in nanometres. Chosen: what is told
/// is rounded to this.
const NEAR: f64 = 1_000.0;
/// How far edges are looked for at first. Chosen: half of a wide trace.
const REACH: Nm = Nm::from_um(200);

impl<'a> Interior<'a> {
    /// Of a net that was designed so.
    pub(super) fn new(sheet: &'a Sheet<'a>, net: NetId, designed: &[Polygon]) -> Self {
        let edges = designed.iter().flat_map(Polygon::edges).filter(|(from, to)| from != to);
        let edge = |(from, to)| Shape::Stroke { from, to, radius: Nm::ZERO };
        let edges: Vec<Shape> = edges.map(edge).collect();
        let rect = sheet.rect();
        let most = (rect.width() + rect.height()) * 2;
        Self { sheet, net, edges: Proximity::of(&edges), most }
    }

    /// The deepest place of a way, where one is deeper than `floor` nanometres: within a micrometre
    /// of the deepest there is.
    ///
    /// From one place to the next the depth changes by no more than the way between them, so that a
    /// stretch whose middle is not deep enough for its length holds nothing deeper (Piyavskii
    /// 1972).
    pub(super) fn deepest(&self, way: &Shape, floor: f64) -> Option<Deepest> {
        let (mut found, mut floor) = (None, floor);
        let mut stretches = vec![(0.0_f64, 1.0_f64)];
        let length = way.length();
        while let Some((from, to)) = stretches.pop() {
            let middle = f64::midpoint(from, to);
            let at = way.at(middle);
            let room = length * (to - from) / 2.0;
            let edge = self.edge(at);
            if edge + room <= floor + NEAR {
                continue;
            }
            let depth = if self.holds(at) { edge } else { -edge };
            if depth > floor {
                floor = depth;
                found = Some(Deepest { at, depth });
            }
            if depth + room > floor + NEAR {
                stretches.extend([(from, middle), (middle, to)]);
            }
        }
        found
    }

    /// How far the nearest edge is, in nanometres.
    fn edge(&self, p: Point) -> f64 {
        let spot = Shape::Disc { center: p, radius: Nm::ZERO };
        let mut reach = REACH;
        loop {
            let near = self.edges.near(&spot, reach);
            if let Some(width) = near.iter().map(|near| near.width).reduce(f64::min) {
                return width;
            }
            if reach > self.most {
                return 0.0;
            }
            reach = reach * 3;
        }
    }

    /// Whether a place lies on the net.
    fn holds(&self, p: Point) -> bool {
        let spot = Shape::Disc { center: p, radius: Nm::ZERO };
        let near = self.sheet.proximity.near(&spot, Nm::ZERO);
        near.iter().any(|near| self.sheet.nets.of(near.feature) == self.net) && self.sheet.holds(p)
    }
}
