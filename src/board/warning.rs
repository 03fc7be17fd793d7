use crate::geometry::Point;

use super::Side;

/// Where in a file something was found.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct SourceSpan {
    /// The file's name without its folder.
    pub file: String,
    /// From 1.
    pub line: u32,
    /// From 1, in bytes.
    pub column: u32,
    /// The offending text, at most a line of it.
    pub text: String,
}

/// Something a person must know and the program could go on from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// A stable name in kebab case: `missing-end-of-file`, `gap-narrower-than-tool`. People filter by it.
    pub code: &'static str,
    /// What was found and what was done about it, one sentence without a full stop.
    pub message: String,
    /// The side it concerns.
    pub side: Option<Side>,
    /// The place on the board.
    pub at: Option<Point>,
    /// The place in a file.
    pub source: Option<SourceSpan>,
}

impl Warning {
    /// A warning without a place.
    #[must_use]
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), side: None, at: None, source: None }
    }

    /// The same, at a place on the board.
    #[must_use]
    pub fn at(self, at: Point) -> Self {
        Self { at: Some(at), ..self }
    }

    /// The same, on a side.
    #[must_use]
    pub fn on(self, side: Side) -> Self {
        Self { side: Some(side), ..self }
    }

    /// The same, with the place in a file that caused it.
    #[must_use]
    pub fn caused_by(self, source: SourceSpan) -> Self {
        Self { source: Some(source), ..self }
    }
}
