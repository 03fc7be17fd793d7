//! What stands at a place of a file, as a terminal shows it: one look for errors and warnings.

use std::ops::Range;

use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use serde::Serialize;

use super::Severity;

/// A line of a file, or of a long one what surrounds a place, with that place marked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Excerpt {
    text: String,
    marked: Range<usize>,
}

impl Excerpt {
    /// `text`, printable and without a line's end, with its bytes `marked`, which lie in it.
    ///
    /// # Panics
    ///
    /// If `marked` does not lie in `text`, or cuts a character.
    #[must_use]
    pub fn new(text: String, marked: Range<usize>) -> Self {
        assert!(text.get(marked.clone()).is_some(), "the mark lies in the text");
        Self { text, marked }
    }
}

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

/// ```text
/// error: `what`
///  --> file:line:column
///   |
/// 3 | the line, with
///   |     ^^^^ expected `expected`
///   |
///   = help: `advice`
/// ```
///
/// Without a place, what was expected is a note; `expected` and `advice` may be empty.
#[must_use]
pub fn show(
    severity: Severity,
    what: &str,
    span: Option<&SourceSpan>,
    expected: &str,
    advice: &str,
) -> String {
    let mut group = Group::with_title(level(severity).primary_title(what));
    let expected = if expected.is_empty() { String::new() } else { format!("expected {expected}") };
    if let Some(span) = span {
        let Excerpt { text, marked } = &span.excerpt;
        let annotation = AnnotationKind::Primary.span(marked.clone()).label(expected.as_str());
        let snippet = Snippet::source(text.as_str()).line_start(span.line as usize).annotation(annotation);
        // The column counts from the start of the excerpt, which is that of the line unless that is
        // long.
        group = if marked.start + 1 == span.column as usize {
            group.element(snippet.path(span.file.as_str()))
        } else {
            let place = Origin::path(span.file.as_str()).line(span.line as usize);
            group.element(place.char_column(span.column as usize)).element(snippet)
        };
    } else if !expected.is_empty() {
        group = group.element(Level::NOTE.message(expected.as_str()));
    }
    if !advice.is_empty() {
        group = group.element(Level::HELP.message(advice));
    }
    Renderer::plain().render(&[group])
}

const fn level(severity: Severity) -> Level<'static> {
    match severity {
        Severity::Info => Level::INFO,
        Severity::Warning => Level::WARNING,
        Severity::Error => Level::ERROR,
    }
}
