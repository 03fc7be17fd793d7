//! The certified diagram of a layer's copper, or of its core axes.
//!
//! Where a diagram contradicts itself, which equal distances may make it do, chords stay chords,
//! and then the copper is shaken: every point is moved by up to 25 nanometres, the same point
//! alike. Nets whose copper touches, as Algorithm 1 alone may leave them, have one owner here,
//! since nothing can part them.

use std::borrow::Cow;

use crate::board::{Axis, Copper, FLATTEN, Feature, Shape};
use crate::geometry::{Nm, Point, Rect};
use crate::topology::{self, Method, NetId, Nets, smallest_gap};

use super::exact::{Diagram, Generators, Kind, Space};

/// Copper is shaken so often at most. Chosen: once is rare.
const ATTEMPTS: u32 = 4;

/// What distances are measured to, with its owners.
pub(super) struct Owned<'a> {
    features: Vec<(&'a Feature, u32)>,
    /// Whether it is their axes: what one owner has may lie in pieces then.
    is_of_axes: bool,
    /// Whether gaps are wide enough for arcs where flattening made chords.
    is_round: bool,
}

impl<'a> Owned<'a> {
    /// The copper of the features that `keep` accepts.
    pub(super) fn copper(copper: &'a Copper, nets: &Nets, keep: impl Fn(usize) -> bool) -> Self {
        Self::new(copper, nets, keep, false)
    }

    /// Their core axes, or their copper where it does not hold its axis.
    pub(super) fn axes(copper: &'a Copper, nets: &Nets, keep: impl Fn(usize) -> bool) -> Self {
        Self::new(copper, nets, keep, true)
    }

    /// The features that `keep` accepts, each with the first of the nets that its own one touches.
    fn new(copper: &'a Copper, nets: &Nets, keep: impl Fn(usize) -> bool, is_of_axes: bool) -> Self {
        let gap = smallest_gap(copper, nets).map(|gap| gap.width);
        let is_touching = gap.is_some_and(|gap| gap <= topology::JOINED);
        let pieces = is_touching.then(|| pieces(copper, nets));
        let owner = |net: NetId| pieces.as_ref().map_or(net.0, |pieces| pieces[net.index()]);
        let kept = copper.features.iter().enumerate().filter(|(feature, _)| keep(*feature));
        let features = kept.map(|(number, feature)| (feature, owner(nets.of(number)))).collect();
        Self { features, is_of_axes, is_round: gap.is_none_or(|gap| gap >= ROUND) }
    }

    /// The shapes that distances are measured to, with their owners.
    fn shapes(&self) -> impl Iterator<Item = (Cow<'a, Shape>, u32)> {
        let shape = |feature| if self.is_of_axes { core(feature) } else { Cow::Borrowed(&feature.shape) };
        self.features.iter().map(move |&(feature, owner)| (shape(feature), owner))
    }

    /// Whether one owner has all.
    pub(super) fn is_of_one(&self) -> bool {
        self.features.windows(2).all(|pair| pair[0].1 == pair[1].1)
    }

    /// The diagram of these edges of copper, which a wall may enclose, and what is `asked` of it;
    /// where that or the diagram contradicts itself, of the copper with chords that stay chords,
    /// since arcs may bulge through a web that these leave; then of the copper shaken. None for the
    /// one that is at fault in the end.
    pub(super) fn diagram<T>(
        &self,
        kind: Kind,
        space: Space,
        wall: Option<Rect>,
        asked: impl Fn(&Diagram) -> Option<T>,
    ) -> (Diagram, Option<T>) {
        let attempt = |number: u32, rounds: bool| {
            let mut generators = Generators::shaken(number);
            generators.weld(self.shapes().flat_map(|(shape, _)| points(&shape)).collect());
            if self.is_of_axes {
                generators.loosen();
            }
            if rounds {
                generators.round();
            }
            self.shapes().for_each(|(shape, owner)| generators.add(&shape, owner));
            if let Some(wall) = wall {
                generators.wall(wall);
            }
            let diagram = Diagram::new(generators, kind, space);
            let answer = if diagram.faults().is_empty() { asked(&diagram) } else { None };
            (diagram, answer)
        };
        let first = attempt(0, self.is_round);
        if first.1.is_some() {
            return first;
        }
        let mut others = (u32::from(!self.is_round)..=ATTEMPTS).map(|number| attempt(number, false));
        others.find(|(_, answer)| answer.is_some()).unwrap_or(first)
    }
}

/// The axis of a feature as a shape without width, or its copper where that does not hold it.
pub(super) fn core(feature: &Feature) -> Cow<'_, Shape> {
    let radius = Nm::ZERO;
    match axis(feature) {
        Some(Axis::Flash(center)) => Cow::Owned(Shape::Disc { center, radius }),
        Some(Axis::Line(from, to)) => Cow::Owned(Shape::Stroke { from, to, radius }),
        Some(Axis::Arc(arc)) => Cow::Owned(Shape::Arc { arc, radius }),
        Some(Axis::Region) | None => Cow::Borrowed(&feature.shape),
    }
}

/// The points that a shape is drawn by.
fn points(shape: &Shape) -> Vec<Point> {
    match shape {
        Shape::Disc { center, .. } => vec![*center],
        Shape::Stroke { from, to, .. } => vec![*from, *to],
        Shape::Arc { arc, .. } => vec![arc.start, arc.end],
        Shape::Polygon(polygon) => polygon.contours().iter().flatten().copied().collect(),
    }
}

/// Nets nearer to each other than this keep the chords that flattening made. Chosen: four times
/// what arcs differ from them.
const ROUND: Nm = Nm::new(4 * FLATTEN.get());

/// The axis of a feature, if its copper still holds it: clear polarity may have cut it away.
pub(super) fn axis(feature: &Feature) -> Option<Axis> {
    let probe = match feature.axis {
        Axis::Flash(p) => p,
        Axis::Line(a, b) => a.midpoint(b),
        Axis::Arc(arc) => arc.point(0.5),
        Axis::Region => return None,
    };
    match &feature.shape {
        Shape::Polygon(polygon) => polygon.contains(probe).then_some(feature.axis),
        Shape::Disc { .. } | Shape::Stroke { .. } | Shape::Arc { .. } => Some(feature.axis),
    }
}

/// Of each net the first of those whose copper it touches.
fn pieces(copper: &Copper, nets: &Nets) -> Vec<u32> {
    let mut first: Vec<u32> = (0_u32..).take(nets.nets().len()).collect();
    let touching = topology::recover(copper, Method::Contact);
    loop {
        let before = first.clone();
        for piece in touching.nets() {
            let members = || piece.features.iter().map(|&feature| nets.of(feature as usize).index());
            if let Some(least) = members().map(|net| first[net]).min() {
                members().for_each(|net| first[net] = least);
            }
        }
        if first == before {
            return first;
        }
    }
}
