//! What a reader or planner tells a person without stopping: what kind of thing, text and place.

use super::diagnostic::planning;
use super::{Diagnostic, Sentence, Side, SourceSpan};
use crate::geometry::{Nm, Point};

/// Something a person must know and the program could go on from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// What kind of thing it is: code, severity and advice.
    pub kind: &'static Diagnostic,
    /// What was found, one sentence without a full stop.
    pub message: String,
    /// What was done about it, or what comes of it, where that is not part of the message.
    pub outcome: Sentence,
    /// The nets it concerns, by name.
    pub nets: Vec<String>,
    /// The side it concerns.
    pub side: Option<Side>,
    /// The place on the board.
    pub at: Option<Point>,
    /// The place in a file.
    pub source: Option<SourceSpan>,
    /// How large: how much copper goes.
    pub size: Option<Nm>,
}

impl Warning {
    /// A warning of a kind, without a place.
    fn of(kind: &'static Diagnostic, message: String) -> Self {
        Self {
            kind,
            message,
            outcome: Sentence::default(),
            nets: Vec::new(),
            side: None,
            at: None,
            source: None,
            size: None,
        }
    }

    /// A warning of planning, without a place, by its code.
    ///
    /// # Panics
    ///
    /// If no kind of planning has this code.
    #[must_use]
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        let kind = planning::ALL.iter().find(|kind| kind.code == code);
        kind.expect("a code of planning").warning(message)
    }

    /// The stable name of its kind.
    #[must_use]
    pub const fn code(&self) -> &'static str {
        self.kind.code
    }

    /// Whether it is of this kind.
    #[must_use]
    pub fn is(&self, kind: &Diagnostic) -> bool {
        self.kind == kind
    }

    /// What was found and what came of it, as one sentence.
    #[must_use]
    pub fn text(&self) -> String {
        let Self { message, outcome, .. } = self;
        if outcome.is_empty() { message.clone() } else { format!("{message}: {outcome}") }
    }

    /// The same, with what comes of it.
    #[must_use]
    pub fn so(self, outcome: impl Into<Sentence>) -> Self {
        Self { outcome: outcome.into(), ..self }
    }

    /// The same, about these nets.
    #[must_use]
    pub fn about(self, nets: impl IntoIterator<Item = String>) -> Self {
        Self { nets: nets.into_iter().collect(), ..self }
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

impl Diagnostic {
    /// A warning of this kind, without a place: what was found, one sentence without a full stop.
    #[must_use]
    pub fn warning(&'static self, message: impl Into<String>) -> Warning {
        Warning::of(self, message.into())
    }
}
