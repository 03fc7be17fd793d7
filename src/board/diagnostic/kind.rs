//! A kind of thing that a person is told of.

use super::{Severity, Words};

/// A kind of thing that a person is told of.
#[derive(Clone, Copy, Debug)]
pub struct Diagnostic {
    /// Its stable name in kebab case: `missing-end-of-file`, `gap-narrower-than-tool`. By it people
    /// filter.
    pub code: &'static str,
    /// Who says it.
    pub stage: Stage,
    /// How bad it is at worst.
    pub severity: Severity,
    /// What was found.
    pub what: Words,
    /// What it does to the board, the tool or the machine; of files, what was expected.
    pub effect: Words,
    /// What to try.
    pub advice: Words,
}

/// Who says something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// What programs do to the board.
    Verification,
    /// What planning noticed.
    Planning,
    /// What reading files noticed.
    Files,
}

/// Kinds are the same that have the same code.
impl PartialEq for Diagnostic {
    fn eq(&self, other: &Self) -> bool {
        self.code == other.code
    }
}

impl Eq for Diagnostic {}

/// As its code.
impl serde::Serialize for Diagnostic {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.code)
    }
}

impl Diagnostic {
    /// Whether it tells of the edge of the board.
    #[must_use]
    pub fn is_of_the_outline(&self) -> bool {
        self.code.starts_with("outline-")
    }

    /// Whether it tells of the program's own work alone: shown where more is asked for, and never a
    /// reason to fail.
    #[must_use]
    pub fn is_bookkeeping(&self) -> bool {
        self.severity == Severity::Info
    }
}

/// A constant for each kind of a stage: its severity, code, what was found, effect, advice; and
/// `ALL` of them.
macro_rules! diagnostics {
    ($stage:expr; $($name:ident: $severity:ident = $code:literal, $what:literal, $effect:literal, $advice:literal;)*) => {
        $(
            #[doc = $what]
            pub const $name: $crate::board::Diagnostic = $crate::board::Diagnostic {
                code: $code,
                stage: $stage,
                severity: $crate::board::Severity::$severity,
                what: $crate::board::Words::of($what),
                effect: $crate::board::Words::of($effect),
                advice: $crate::board::Words::of($advice),
            };
        )*

        /// Every kind.
        pub const ALL: &[$crate::board::Diagnostic] = &[$($name),*];
    };
}

pub(crate) use diagnostics;
