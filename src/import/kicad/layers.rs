//! The layers of a board file that are milled, and which of them a thing lies on.

use super::tree::Node;
use crate::board::Side;

/// The layers that something lies on, of those that are milled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Layers {
    pub(super) front: bool,
    pub(super) back: bool,
    pub(super) edge: bool,
}

impl Layers {
    /// Those that `node` names in its `(layer …)` or `(layers …)`.
    pub(super) fn of(node: Node<'_>) -> Self {
        let lists = node.children().filter(|list| matches!(list.head(), b"layer" | b"layers"));
        lists.flat_map(Node::arguments).fold(Self::default(), |layers, name| layers.with(&name.text()))
    }

    fn with(self, name: &str) -> Self {
        let both = matches!(name, "*.Cu" | "F&B.Cu" | "*");
        Self {
            front: self.front || both || name == "F.Cu",
            back: self.back || both || name == "B.Cu",
            edge: self.edge || matches!(name, "Edge.Cuts" | "*"),
        }
    }

    /// Whether it lies on the copper of `side`.
    pub(super) const fn on(self, side: Side) -> bool {
        match side {
            Side::Front => self.front,
            Side::Back => self.back,
        }
    }

    /// The sides whose copper it lies on.
    pub(super) fn sides(self) -> impl Iterator<Item = Side> {
        [Side::Front, Side::Back].into_iter().filter(move |&side| self.on(side))
    }

    /// Whether it lies on copper.
    pub(super) const fn is_copper(self) -> bool {
        self.front || self.back
    }

    /// Whether it is milled at all.
    pub(super) const fn is_milled(self) -> bool {
        self.is_copper() || self.edge
    }
}

/// What KiCad calls the copper of `side`.
pub(super) const fn copper_name(side: Side) -> &'static str {
    match side {
        Side::Front => "F.Cu",
        Side::Back => "B.Cu",
    }
}
