//! The ways to plan a [`Section`](super::Section), one file each.

mod bore;
mod carve;
mod cutout;
mod drill;
mod isolate;
mod pocket;
mod share;

pub use carve::{Carving, Floor, carve};
pub use cutout::{Cutout, TabPlaces, Tabs, cutout};
pub use drill::{Drilling, drill, drilled};
pub use isolate::{Isolation, Narrow, Role, isolate};
pub use pocket::{
    Clearings, Engagement, Engaging, Entries, Groove, Levels, ParseEngagementError, Planned, Pocketing,
    Sequence, pocket,
};
pub use share::{fits, share};
