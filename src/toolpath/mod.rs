//! Boundaries, holes and outline + tools → what the machine does.
//!
//! Every strategy plans a [`Section`]: the moves of one tool, in machine coordinates, which its
//! planner makes so that sideways below the safe height is always a feed and everything begins and
//! ends retracted. Sections make a [`Program`], which [`gcode`](crate::gcode) writes down. What a
//! retract costs is counted in seconds on the [`Machine`], so re-cutting a short way, lifting, and
//! rapid travel are compared in one currency.

mod angle;
mod direction;
mod drill_speed;
mod feed;
mod head;
mod heights;
mod machine;
mod measure;
mod order;
mod ordered;
mod percent;
mod placement;
mod planner;
mod program;
pub mod strategy;
mod tiling;
mod tool;
mod trails;

pub use angle::{Angle, ParseAngleError};
pub use direction::Direction;
pub use drill_speed::{DrillSpeeds, Material};
pub use feed::{Feed, ParseFeedError};
pub use heights::Heights;
pub use machine::{Acceleration, Machine, ParseAccelerationError};
pub use measure::{Statistics, ToolStatistics, duration, measure};
pub use order::Order;
pub use percent::{ParsePercentError, Percent};
pub use placement::{Origin, Placement};
pub use program::{Move, Position, Program, Section};
pub use tiling::{Tiling, alignment_holes};
pub use tool::{BUILT_IN, CARBIDE_POINT, POINT, ParseToolError, Tool, ToolKind};
