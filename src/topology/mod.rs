//! Which features conduct to each other.
//!
//! Gerber does not say what is connected; three [`Method`]s find it, all with one result, a partition of the features
//! of a layer into [`Nets`]:
//!
//! | method | joins | time |
//! |---|---|---|
//! | [`coincidence`](Method::Coincidence) | features that share a vertex: Algorithm 1 of the paper (§III-A.1) | linear |
//! | [`contact`](Method::Contact) | features whose copper touches, exactly | near-linear |
//!
//! Contact runs after coincidence, which does most of its work for next to nothing.

mod coincidence;
mod contact;
mod electrical;
mod gap;
mod index;
mod names;
mod nets;
mod sets;

pub use electrical::{Electrical, ElectricalNet, electrical};
pub use gap::{Gap, smallest_gap};
pub use names::{islands_of_names, names_check};
pub use nets::{Net, NetId, Nets};

use crate::board::Copper;

use contact::Bodies;

/// How connected copper is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Algorithm 1 alone: shared end points and centres. Misses what touches elsewhere.
    Coincidence,
    /// Algorithm 1, then exact contact.
    #[default]
    Contact,
}

/// The nets of `copper`, found by `method`.
#[must_use]
pub fn recover(copper: &Copper, method: Method) -> Nets {
    let coincident = coincidence::join(copper);
    let sets = match method {
        Method::Coincidence => coincident,
        Method::Contact => Bodies::new(copper).join(&coincident),
    };
    Nets::from_sets(copper, sets)
}
