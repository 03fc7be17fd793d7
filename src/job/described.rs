//! What a person chooses by its name, or by a file of one's own that describes it.

use std::fmt;

/// A text that is neither a known name nor a file that can be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseDescribedError {
    /// Neither a name nor a file.
    #[error("`{text}` is not a {kind}: expected {expected}")]
    Unknown {
        /// The text.
        text: String,
        /// What it should name.
        kind: &'static str,
        /// The names, and an example of a file.
        expected: String,
    },
    /// A file that cannot be read.
    #[error("cannot read the {kind} {file}: {reason}")]
    File {
        /// Its name.
        file: String,
        /// What it should describe.
        kind: &'static str,
        /// Why.
        reason: String,
    },
    /// A file that describes none.
    #[error("{file}: {reason}")]
    Content {
        /// Its name.
        file: String,
        /// Why.
        reason: String,
    },
}

/// What the file at the path `text` describes, as seen from the working directory, which must end
/// in `.toml`; other than that only a name is `expected`.
pub(super) fn from_file<T, E: fmt::Display>(
    kind: &'static str,
    text: &str,
    expected: impl FnOnce() -> String,
    read: impl FnOnce(&str) -> Result<T, E>,
) -> Result<T, ParseDescribedError> {
    let file = text.to_owned();
    if !text.ends_with(".toml") {
        return Err(ParseDescribedError::Unknown { text: file, kind, expected: expected() });
    }
    match std::fs::read_to_string(text) {
        Ok(described) => read(&described)
            .map_err(|reason| ParseDescribedError::Content { file, reason: reason.to_string() }),
        Err(error) => Err(ParseDescribedError::File { file, kind, reason: error.to_string().to_lowercase() }),
    }
}
