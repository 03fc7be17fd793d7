//! Nets of one layer: a partition of its features into islands of copper.

use std::sync::OnceLock;

use crate::board::Copper;
use crate::geometry::{Nm, Point};

use super::sets::DisjointSets;

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
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Net {
    /// The names that its features carry (X2), sorted, each once; usually one or none.
    pub names: Vec<String>,
    /// Its features, ascending indices into [`Copper::features`](crate::board::Copper::features).
    pub features: Vec<u32>,
}

/// The narrowest place between two nets of a layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gap {
    /// The nets on both sides, the smaller number first.
    pub between: (NetId, NetId),
    /// The middle of the gap.
    pub at: Point,
    /// Its width to the nanometre; zero only where the nets touch after all.
    pub width: Nm,
}

/// A partition of the features of a layer: two features are in one net exactly if they conduct to
/// each other.
///
/// # Guarantees
///
/// Every feature is in exactly one net. Nets are numbered by their first feature, so the numbering
/// does not depend on how they were found.
#[derive(Clone, Debug, Default)]
pub struct Nets {
    of: Vec<NetId>,
    nets: Vec<Net>,
    /// The narrowest gap between two, once it was asked for.
    pub(super) gap: OnceLock<Option<Gap>>,
}

impl PartialEq for Nets {
    fn eq(&self, other: &Self) -> bool {
        (&self.of, &self.nets) == (&other.of, &other.nets)
    }
}

impl Eq for Nets {}

impl Nets {
    /// The nets of `copper` where `joined` gives pairs of features that conduct to each other.
    ///
    /// # Panics
    ///
    /// If a pair names a feature that `copper` has not.
    #[must_use]
    pub fn from_pairs(copper: &Copper, joined: impl IntoIterator<Item = (u32, u32)>) -> Self {
        let mut sets = DisjointSets::new(copper.features.len());
        for (a, b) in joined {
            sets.union(a, b);
        }
        Self::from_sets(copper, sets)
    }

    /// The nets of `copper`, one for each of `sets`.
    pub(super) fn from_sets(copper: &Copper, mut sets: DisjointSets) -> Self {
        let mut found = Self { of: Vec::with_capacity(copper.features.len()), ..Self::default() };
        for (feature, index) in copper.features.iter().zip(0_u32..) {
            // The representative of a set is its smallest member, so it has been numbered before
            // the others come.
            let first = sets.find(index);
            if first == index {
                found.of.push(NetId(u32::try_from(found.nets.len()).expect("no more nets than features")));
                found.nets.push(Net::default());
            } else {
                found.of.push(found.of[first as usize]);
            }
            let net = &mut found.nets[found.of[index as usize].index()];
            net.features.push(index);
            if let Some(name) = &copper.attributes_of(feature).net
                && net.names.last() != Some(name)
            {
                net.names.push(name.clone());
            }
        }
        for net in &mut found.nets {
            net.names.sort_unstable();
            net.names.dedup();
        }
        found
    }

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
