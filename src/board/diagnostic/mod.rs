//! What can be wrong with files, plans and programs: one entry for each kind, with its code, how
//! bad it is and what a person does about it.
//!
//! Three lists make the register: the kinds of files are in [`import`](crate::import), those of
//! planning in [`planning`], those of verification with their checks in
//! [`verify`](crate::verify::check). Whoever finds something names the kind; code, heading and
//! advice follow from it where it is shown.

mod kind;
pub mod planning;
mod severity;
mod words;

pub(crate) use kind::diagnostics;
pub use kind::{Diagnostic, Stage};
pub use severity::Severity;
pub(crate) use words::count;
pub use words::{Sentence, Words};
