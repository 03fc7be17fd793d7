//! Which features conduct to each other.
//!
//! Gerber does not say what is connected; three [`Method`]s find it, all with one result, a partition of the features
//! of a layer into [`Nets`].

/// A net of one layer: an index into [`Nets::nets`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NetId(pub u32);

impl NetId {
    /// As an index.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// An island of copper.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Net {
    /// The names that its features carry (X2), sorted, each once; usually one or none.
    pub names: Vec<String>,
    /// Its features, ascending indices into [`Copper::features`](crate::board::Copper::features).
    pub features: Vec<u32>,
}

/// A partition of the features of a layer: two features are in one net exactly if they conduct to each other.
///
/// # Guarantees
///
/// Every feature is in exactly one net. Nets are numbered by their first feature, so the numbering does not depend
/// on how they were found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Nets {
    of: Vec<NetId>,
    nets: Vec<Net>,
}

impl Nets {
    /// The net of the feature with this index.
    #[must_use]
    pub fn of(&self, feature: usize) -> NetId {
        self.of[feature]
    }

    /// All nets, by number.
    #[must_use]
    pub fn nets(&self) -> &[Net] {
        &self.nets
    }

    /// How people call the net: its name, `GND+AGND` for several, or `net 17`, counted from 1.
    #[must_use]
    pub fn label(&self, id: NetId) -> String {
        match self.nets[id.index()].names.as_slice() {
            [] => format!("net {}", id.0 + 1),
            names => names.join("+"),
        }
    }
}
