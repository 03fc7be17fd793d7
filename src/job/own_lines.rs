//! G-code of one's own, from a file.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// Lines that are written as they stand.
///
/// # Guarantees
///
/// There is one at least; each is printable ASCII, and short enough for every controller.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnLines {
    file: String,
    lines: Vec<String>,
}

/// A file whose lines cannot stand in a program.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseOwnLinesError {
    /// A file that cannot be read.
    #[error("cannot read the G-code {file}: {reason}")]
    File {
        /// Its name.
        file: String,
        /// Why.
        reason: String,
    },
    /// Nothing in it.
    #[error("{0} has no lines: expected G-code")]
    Empty(String),
    /// A line that controllers misread.
    #[error("{file}:{line}: {expected}")]
    Line {
        /// Its name.
        file: String,
        /// From 1.
        line: usize,
        /// What was expected.
        expected: &'static str,
    },
}

/// The longest line. Marlin drops what is beyond 95 characters. Chosen: leaves room for a line
/// number and a checksum.
const LONGEST: usize = 90;

impl OwnLines {
    /// The lines.
    #[must_use]
    pub fn lines(&self) -> &[String] {
        &self.lines
    }

    /// The lines of a file.
    pub(super) fn read(path: &Path) -> Result<Self, ParseOwnLinesError> {
        let shown = path.to_string_lossy();
        let text = std::fs::read_to_string(path).map_err(|error| ParseOwnLinesError::File {
            file: shown.clone().into_owned(),
            reason: error.to_string().to_lowercase(),
        })?;
        Self::new(&shown, &text)
    }

    fn new(path: &str, text: &str) -> Result<Self, ParseOwnLinesError> {
        let name =
            Path::new(path).file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let mut lines = Vec::new();
        for (line, number) in text.lines().map(str::trim_end).zip(1..) {
            let refused =
                |expected| ParseOwnLinesError::Line { file: path.to_owned(), line: number, expected };
            if !line.bytes().all(|byte| (b' '..0x7f).contains(&byte)) {
                return Err(refused("expected printable ASCII: controllers take other bytes for commands"));
            }
            if line.len() > LONGEST {
                return Err(refused("expected at most 90 characters, which every controller reads"));
            }
            if !line.is_empty() {
                lines.push(line.to_owned());
            }
        }
        if lines.is_empty() {
            return Err(ParseOwnLinesError::Empty(path.to_owned()));
        }
        Ok(Self { file: name, lines })
    }
}

/// The path of the file, as seen from the working directory.
impl FromStr for OwnLines {
    type Err = ParseOwnLinesError;

    fn from_str(path: &str) -> Result<Self, Self::Err> {
        Self::read(Path::new(path))
    }
}

/// Its name: where its file lies says nothing to who reads a program.
impl fmt::Display for OwnLines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.file)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_controllers_misread_are_refused_with_their_place() {
        let own = OwnLines::new("a/b.nc", "G28 \r\n\nM64 P0\n").expect("two lines");
        assert_eq!(
            (own.lines(), own.to_string()),
            (&["G28".to_owned(), "M64 P0".to_owned()][..], "b.nc".to_owned())
        );
        let long = "x".repeat(91);
        for (text, reason) in [
            ("", "no lines"),
            ("G0\n\u{e4}", "a/b.nc:2: expected printable"),
            (&long, "a/b.nc:1: expected at most"),
        ] {
            let error = OwnLines::new("a/b.nc", text).expect_err(text).to_string();
            assert!(error.contains(reason), "{error}");
        }
    }
}
