//! Wide isolation: what is cut beside the boundaries so that a gap of some width, or all copper
//! between the nets, is cleared.
//!
//! ```text
//!   Diagram ─ passes ─▶ level sets ─ groove ─▶ what they alone clear ─ spike ─▶ passes ─ link ─▶ Boundaries
//!     │         │                                                                │
//!     │         ╰─ farthest: how far out they run; clearing: where             │
//!     ╰─ residual ──▶ what lies between two passes, along the medial axis ─────╯
//! ```

mod clearing;
mod farthest;
mod groove;
mod link;
mod passes;
mod residual;
mod spike;

pub use clearing::Clearing;
pub use link::Link;
pub use passes::Widening;
