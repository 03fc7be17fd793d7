//! One copper layer of a resolved board: its features and its side.
//!
//! Whoever holds a `Copper` need not ask for polarity, repeats or apertures: import resolved them.

use std::fmt;

use crate::geometry::Rect;

use super::{Feature, Shape};

/// A side of the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// The component side, "top".
    Front,
    /// The solder side, "bottom".
    Back,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Front => "front",
            Self::Back => "back",
        })
    }
}

/// What the file says of a feature beside its shape (Gerber X2/X3 attributes, `%TO` and `%TA`).
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Attributes {
    /// `.N`: the net's name; none where the file gives none, or `N/C`.
    pub net: Option<String>,
    /// `.C` or the first field of `.P`: the component's reference.
    pub component: Option<String>,
    /// The second field of `.P`: the pin.
    pub pin: Option<String>,
    /// `.AperFunction`: what the aperture is for, all its fields joined by commas.
    pub function: Option<String>,
}

/// One layer of copper.
///
/// # Guarantees
///
/// Every feature's [`Feature::attributes`] is an index into [`Copper::attributes`], whose entry 0
/// is empty.
#[derive(Clone, Debug)]
pub struct Copper {
    /// Which side of the board it lies on.
    pub side: Side,
    /// The dark features, in file order; they may overlap.
    pub features: Vec<Feature>,
    /// The attribute sets that features refer to; the first is empty.
    pub attributes: Vec<Attributes>,
}

impl Copper {
    /// The shapes of the features, in file order.
    pub fn shapes(&self) -> impl Iterator<Item = &Shape> {
        self.features.iter().map(|feature| &feature.shape)
    }

    /// A rectangle that holds all features; none for an empty layer.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        self.features.iter().map(|feature| feature.shape.bounds()).reduce(Rect::union)
    }

    /// What the file says of `feature`.
    #[must_use]
    pub fn attributes_of(&self, feature: &Feature) -> &Attributes {
        &self.attributes[feature.attributes as usize]
    }
}
