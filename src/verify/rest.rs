//! What became of nets where that is not beyond doubt, and where it is in doubt.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::{Polygon, Rect};
use crate::topology::NetId;

use super::Settings;

/// What is left where it is not beyond doubt.
#[derive(Debug, Default)]
pub(super) struct Remains {
    /// Connected pieces of what is left that hold considerable copper of several nets.
    pub(super) joined: Vec<Joined>,
    /// The nets that a cut may have parted.
    pub(super) nets: BTreeMap<NetId, Rest>,
    /// Nets of which it was not worked out whether they are joined or parted.
    pub(super) unsure: BTreeSet<NetId>,
}

/// Nets that are joined.
#[derive(Clone, Debug)]
pub(super) struct Joined {
    /// Where all of it lies.
    pub(super) place: Rect,
    /// In order.
    pub(super) nets: Vec<NetId>,
    /// Whether too many cuts cross there to say by what.
    pub(super) crowded: bool,
}

/// What became of a net.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    /// Its copper as designed, as far as it lies on the board.
    pub(super) designed: Vec<Polygon>,
    /// Its considerable parts, the largest first.
    pub(super) parts: Vec<Remnant>,
}

/// A connected piece of a net's copper.
#[derive(Clone, Debug)]
pub(super) struct Remnant {
    pub(super) polygon: Polygon,
    /// In mm².
    pub(super) area: f64,
    /// The connected piece of clad that it is part of.
    pub(super) piece: usize,
}

impl Rest {
    /// Its area as designed, in mm².
    pub(super) fn area(&self) -> f64 {
        self.designed.iter().map(Polygon::area_mm2).sum()
    }

    /// The area from which on a part of it counts, in mm²: a crumb, or of small nets three tenths.
    pub(super) fn least(&self, settings: &Settings) -> f64 {
        least(self.area(), settings)
    }

    /// The parts by what they conduct to, each group the largest first; more than one for a net
    /// that is cut in two.
    pub(super) fn apart(&self) -> Vec<Vec<&Remnant>> {
        let mut groups: Vec<Vec<&Remnant>> = Vec::new();
        for part in &self.parts {
            match groups.iter_mut().find(|group| group[0].piece == part.piece) {
                Some(group) => group.push(part),
                None => groups.push(vec![part]),
            }
        }
        groups
    }
}

/// The same, of a net of this area in mm².
pub(super) fn least(area: f64, settings: &Settings) -> f64 {
    (area * SMALL).min(settings.crumb)
}

/// A part of the board in doubt.
#[derive(Clone, Debug)]
pub(super) struct Doubt {
    pub(super) rect: Rect,
    /// The nets that may be joined.
    pub(super) nets: BTreeSet<NetId>,
    /// Of these, those that may be parted; all of each lies in the rectangle.
    pub(super) parted: BTreeSet<NetId>,
}

/// In shares of a crumb, the copper of a net in the picture from which on a piece is in doubt.
/// Chosen: pixels are coarse.
pub(super) const HINT: f64 = 0.1;
/// The part of a small net that is left of it where something is.
pub(super) const SMALL: f64 = 0.3;
