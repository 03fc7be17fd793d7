//! Which features conduct to each other.
//!
//! Gerber does not say what is connected; three [`Method`]s find it, all with one result, a
//! partition of the features of a layer into [`Nets`]:
//!
//! | method | joins | time |
//! |---|---|---|
//! | [`coincidence`](Method::Coincidence) | features that share a vertex: Algorithm 1 of the paper (§III-A.1) | linear |
//! | [`translucency`](Method::Translucency) | also what overlaps at some pixel: Algorithm 2 (§III-A.2) | with the area, in pixels |
//! | [`contact`](Method::Contact) | also all copper within 0.25 µm, exactly | near-linear |
//!
//! Both others run after coincidence, which does most of their work for next to nothing.
//! [`differences()`] holds all three against each other.
//!
//! `cargo bench --bench topology` times layers of strokes, discs and rectangles at a constant
//! density (two threads):
//!
//! | features | 10³ | 10⁴ | 10⁵ | 10⁶ |
//! |---|---|---|---|---|
//! | contact, µs a feature | 0.62 | 0.75 | 0.84 | 0.99 |
//! | of that coincidence | 0.06 | 0.04 | 0.08 | 0.29 |
//!
//! Contact grows by 1.6 over three powers of ten. What grows in coincidence is reading memory: one
//! table of all vertices no longer fits a cache.

mod coincidence;
mod contact;
mod density;
mod differences;
mod electrical;
mod extent;
mod gap;
mod groups;
mod names;
mod nets;
mod pattern;
mod proximity;
mod sets;
mod splitmix;
mod stretches;
mod surface;
mod translucency;

pub use differences::{Differences, Missed, Reason, differences};
pub use electrical::{Electrical, ElectricalNet, electrical};
pub use extent::{Extent, extents};
pub use gap::smallest_gap;
pub(crate) use groups::Groups;
pub use names::{called, islands_of_names, names_check};
pub use nets::{Gap, Net, NetId, Nets};
pub use pattern::Pattern;
pub use proximity::{Near, Proximity};
pub use sets::DisjointSets;
#[cfg(test)]
pub(crate) use splitmix::random;
pub(crate) use splitmix::splitmix;
pub(crate) use surface::{grown, surface};
pub use translucency::{Colour, Odds, Overlap, Sampling, Translucency, translucency};

use crate::board::Copper;

use contact::Bodies;
pub(crate) use contact::JOINED;

/// How connected copper is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Algorithm 1 alone: shared end points and centres. Misses what touches elsewhere.
    Coincidence,
    /// Algorithm 1, then Algorithm 2 at 500 DPI: overlaps by blended colours. Misses what no pixel
    /// shows.
    Translucency,
    /// Algorithm 1, then exact contact.
    #[default]
    Contact,
}

/// The nets of `copper`, found by `method`.
#[must_use]
pub fn recover(copper: &Copper, method: Method) -> Nets {
    match method {
        Method::Coincidence => Nets::from_sets(copper, coincidence::join(copper)),
        Method::Contact => Nets::from_sets(copper, Bodies::new(copper).join(&coincidence::join(copper))),
        Method::Translucency => by_translucency(copper).nets,
    }
}

/// The nets of `copper` by Algorithm 1 and then Algorithm 2 at 500 DPI, with all that was seen on
/// the way.
#[must_use]
pub fn by_translucency(copper: &Copper) -> Translucency {
    let traces = Nets::from_sets(copper, coincidence::join(copper));
    let found = translucency(copper, &traces, Sampling::default());
    found.expect("500 DPI is neither too fine nor too large for any board")
}
