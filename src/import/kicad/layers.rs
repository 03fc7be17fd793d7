//! The layers of a board file that are milled, and which of them a thing lies on.

use super::tree::Node;
use crate::board::Side;

/// What the board calls the layers of copper that are milled.
///
/// Until version 5 a person could call them as they liked, and everything on them names them so;
/// their numbers tell them. Since then, only what is shown changes.
#[derive(Clone, Debug)]
pub(super) struct Names {
    front: String,
    back: String,
}

impl Default for Names {
    fn default() -> Self {
        let name = |side| copper_name(side).to_owned();
        Self { front: name(Side::Front), back: name(Side::Back) }
    }
}

impl Names {
    /// Those in the `(layers …)` of a board of the given version of the format.
    pub(super) fn of(board: Node<'_>, version: u32) -> Self {
        /// The last version of the format that names layers as a person does.
        const LAST: u32 = 20_200_921;
        let (front, back): (&[u8], &[u8]) = match version {
            0..=3 => (b"15", b"0"),
            4..=LAST => (b"0", b"31"),
            _ => return Self::default(),
        };
        let name = |number: &[u8], side| {
            let layers = board.find("layers").into_iter().flat_map(Node::arguments);
            let named = layers.filter(|layer| layer.head() == number).find_map(|layer| layer.argument(0));
            named.map_or_else(|| copper_name(side).to_owned(), |name| name.text().into_owned())
        };
        Self { front: name(front, Side::Front), back: name(back, Side::Back) }
    }
}

/// The layers that something lies on, of those that are milled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Layers {
    pub(super) front: bool,
    pub(super) back: bool,
    pub(super) edge: bool,
}

impl Layers {
    /// Those that `node` names in its `(layer …)` or `(layers …)`.
    pub(super) fn of(node: Node<'_>, names: &Names) -> Self {
        let lists = node.children().filter(|list| matches!(list.head(), b"layer" | b"layers"));
        lists.flat_map(Node::arguments).fold(Self::default(), |layers, name| layers.with(&name.text(), names))
    }

    fn with(self, name: &str, names: &Names) -> Self {
        let both = matches!(name, "*.Cu" | "F&B.Cu" | "*");
        Self {
            front: self.front || both || name == names.front,
            back: self.back || both || name == names.back,
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
