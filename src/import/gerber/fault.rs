//! What is wrong with a command, and what a command being carried out may look at and say.

use std::ops::Range;

use crate::board::Diagnostic;
use crate::import::error::{Error, Warnings};

use super::lex::Lexer;

/// Why a command cannot be read or carried out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) what: String,
    expected: String,
    hint: &'static str,
    /// The bytes of the file; none for all of the command.
    place: Option<Range<usize>>,
}

impl Fault {
    pub(super) fn new(what: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { what: what.into(), expected: expected.into(), hint: "", place: None }
    }

    /// With what to do about it.
    pub(super) const fn hint(mut self, hint: &'static str) -> Self {
        self.hint = hint;
        self
    }

    /// At the bytes `place`, unless a place within them is known.
    pub(super) fn at(mut self, place: &Range<usize>) -> Self {
        self.place.get_or_insert_with(|| place.clone());
        self
    }

    /// In the part of the file that has this name.
    pub(super) fn within(mut self, part: &str) -> Self {
        self.what = format!("in {part}: {}", self.what);
        self
    }

    /// The error in the file `name` with content `bytes`.
    pub(super) fn error(self, name: &str, bytes: &[u8]) -> Error {
        Error::syntax(name, bytes, self.place.unwrap_or_default(), self.what, self.expected, self.hint)
    }
}

/// The command being carried out: its place, what comes after it, and what there is to say of it.
#[derive(Debug)]
pub(super) struct Here<'h, 'a> {
    pub(super) place: Range<usize>,
    /// The line on which its block begins.
    pub(super) line: u32,
    /// Whether no aperture is defined so far.
    pub(super) is_bare: bool,
    /// The rest of the file.
    pub(super) ahead: &'h Lexer<'a>,
    pub(super) warnings: &'h mut Warnings<'a>,
}

impl Here<'_, '_> {
    /// Warns of the command.
    pub(super) fn warn(&mut self, diagnostic: &'static Diagnostic, message: impl Into<String>) {
        self.warnings.add(diagnostic, self.place.clone(), message);
    }
}
