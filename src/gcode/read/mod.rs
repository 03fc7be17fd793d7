//! Text → motions, from the specification, for programs from any CAM; it shares no code with the
//! writer.
//!
//! A program is followed as its controller would run it (NIST RS274/NGC version 3 §3, and what
//! LinuxCNC, Grbl, Marlin and Mach3 document): parameters, expressions, subprograms and loops, all
//! planes, cycles and curves, coordinate systems and moved zeros. What a text leaves open but does
//! not matter for what is cut is noted and followed; where the motion depends on what only the
//! machine knows (a tool table, another zero, where home is) it is refused with the reason. Silence
//! would be worse.
//!
//! ```text
//!   text ─ source ─▶ lines ─ flow ─▶ the next line ─ block ─▶ words ─ machine ─▶ Listing
//!                                         │  expression, variables     │ meaning, frame
//! ```

mod block;
mod error;
mod expression;
mod flow;
mod frame;
mod listing;
mod machine;
mod meaning;
mod own_code;
mod source;
mod spelling;
mod variables;

pub use error::ReadError;
pub use flow::read;
pub use listing::{
    Coded, Counting, Dwell, Listing, Motion, Note, Odd, Place, Spindle, Stop, Tally, Waits, Way,
};
pub use own_code::{without_own_code, without_unlevelled};
pub use source::lines;
pub use spelling::{Spelled, spelled};
