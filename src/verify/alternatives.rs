//! A levelled program beside the one that it was made of: either is milled, never both, so what one
//! of them does not cut the other cannot have cut.

use super::machining::Machining;

/// Programs of which some take the place of others.
pub(super) struct Alternatives {
    /// Those that others take the place of first, those that take it last.
    programs: Vec<Machining>,
    replaced: usize,
    replacing: usize,
}

impl Alternatives {
    /// A levelled program takes the place of those that are not, have the same part in making the
    /// board, and the same tools.
    pub(super) fn new(programs: Vec<Machining>) -> Self {
        let stands_in = |one: &Machining, other: &Machining| {
            one.is_levelled && !other.is_levelled && one.role == other.role && one.tools.are(&other.tools)
        };
        let rank = |program: &Machining| {
            let is_replaced = programs.iter().any(|other| stands_in(other, program));
            let replaces = programs.iter().any(|other| stands_in(program, other));
            1 + usize::from(replaces) - usize::from(is_replaced)
        };
        let ranks: Vec<usize> = programs.iter().map(rank).collect();
        let count = |rank| ranks.iter().filter(|&&other| other == rank).count();
        let (replaced, replacing) = (count(0), count(2));
        let mut ranked: Vec<(usize, Machining)> = ranks.into_iter().zip(programs).collect();
        ranked.sort_by_key(|(rank, _)| *rank);
        Self { programs: ranked.into_iter().map(|(_, program)| program).collect(), replaced, replacing }
    }

    /// What is milled together: all, or without those that take a place, and without those whose
    /// place is taken.
    pub(super) fn together(&self) -> Vec<&[Machining]> {
        match (self.replacing, self.programs.len() - self.replacing) {
            (0, _) => vec![&self.programs],
            (_, first) => vec![&self.programs[..first], &self.programs[self.replaced..]],
        }
    }
}
