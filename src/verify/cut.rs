//! A piece of what programs cut.

use super::machining::{Machining, Swept};

/// A piece of what is cut, and whose it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut<'a> {
    pub(super) program: &'a Machining,
    pub(super) swept: &'a Swept,
}

impl<'a> Cut<'a> {
    /// All that `programs` cut, in their order.
    pub(super) fn all(programs: &[&'a Machining]) -> impl Iterator<Item = Self> {
        let of = |program: &'a Machining| program.swept.iter().map(move |swept| Cut { program, swept });
        programs.iter().flat_map(move |&program| of(program))
    }
}
