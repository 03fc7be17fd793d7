//! What a text that cannot be followed is refused with.

/// Why a text is not a program that can be followed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}, column {column}: `{text}`: {expected}")]
#[non_exhaustive]
pub struct ReadError {
    /// From 1.
    pub line: u32,
    /// From 1, in bytes.
    pub column: u32,
    /// The offending text.
    pub text: String,
    /// What was expected, or why it is refused.
    pub expected: String,
}
