//! A piece of what programs cut.

use super::machining::{Machining, Swept};

/// A piece of what is cut, and whose it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut<'a> {
    pub(super) program: &'a Machining,
    pub(super) swept: &'a Swept,
}
