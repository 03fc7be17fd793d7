//! What a reader or planner tells a person without stopping: code, text, place and advice.

use serde::Serialize;

use super::{Excerpt, Side};
use crate::geometry::{Nm, Point};

/// Where in a file something was found.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SourceSpan {
    /// The file's name without its folder.
    pub file: String,
    /// From 1.
    pub line: u32,
    /// From 1, in bytes.
    pub column: u32,
    /// The offending text, at most a line of it.
    pub text: String,
    /// The line around it, to be shown.
    #[serde(skip)]
    pub excerpt: Excerpt,
}

impl SourceSpan {
    /// The whole of a line that says `text`.
    #[must_use]
    pub fn of_line(file: &str, line: u32, text: &str) -> Self {
        let excerpt = Excerpt::new(text.to_owned(), 0..text.len());
        Self { file: file.to_owned(), line, column: 1, text: text.to_owned(), excerpt }
    }
}

/// What would have been right, and what to do about what is not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Help {
    /// What was expected at the place of the warning.
    pub expected: &'static str,
    /// What a person can do, in the words of an order.
    pub advice: &'static str,
}

/// Something a person must know and the program could go on from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// A stable name in kebab case: `missing-end-of-file`, `gap-narrower-than-tool`. People filter
    /// by it.
    pub code: &'static str,
    /// What was found and what was done about it, one sentence without a full stop.
    pub message: String,
    /// The side it concerns.
    pub side: Option<Side>,
    /// The place on the board.
    pub at: Option<Point>,
    /// The place in a file.
    pub source: Option<SourceSpan>,
    /// What to do about it; every warning about a file has that.
    pub help: Option<Help>,
    /// How large: how much copper goes.
    pub size: Option<Nm>,
}

impl Warning {
    /// A warning without a place.
    #[must_use]
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self { code, message: message.into(), side: None, at: None, source: None, help: None, size: None }
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

    /// The same, with what to do about it.
    #[must_use]
    pub fn with(self, help: Help) -> Self {
        Self { help: Some(help), ..self }
    }
}
