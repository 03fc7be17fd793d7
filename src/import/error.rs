//! What can be wrong with a file, and where: errors stop the reading, [`Warnings`] are collected on
//! the way.
//!
//! Both know their place as bytes of the file. Line and column are worked out only when something
//! is reported, so the readers do not count while nothing is wrong.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::board::{self, Diagnostic, Excerpt, Sentence, Severity, SourceSpan, Warning};

/// Why a file could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Something in the file is not as it must be.
    #[error("{0}")]
    Syntax(Box<Diagnosis>),
    /// The file as a whole is not what it was taken for.
    #[error("{file}: {what}; {hint}")]
    Content {
        /// The file's name without its folder.
        file: String,
        /// What is wrong with it.
        what: Sentence,
        /// What to do.
        hint: Sentence,
    },
}

/// One thing wrong at one place of a file, in the words of its reader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnosis {
    /// Where, with the offending text.
    pub span: SourceSpan,
    /// What is wrong.
    pub what: String,
    /// What was expected there.
    pub expected: String,
    /// What to do about it; may be empty.
    pub hint: Sentence,
}

impl std::fmt::Display for Diagnosis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let SourceSpan { file, line, column, text, .. } = &self.span;
        write!(f, "{file}:{line}:{column}: {} at `{text}`; expected {}", self.what, self.expected)?;
        if self.hint.is_empty() { Ok(()) } else { write!(f, "; {}", self.hint) }
    }
}

impl Error {
    /// An error at the bytes `place` of the file `file` with content `bytes`. `hint` says what to
    /// do; it may be empty.
    pub(in crate::import) fn syntax(
        file: &str,
        bytes: &[u8],
        place: Range<usize>,
        what: impl Into<String>,
        expected: impl Into<String>,
        hint: impl Into<Sentence>,
    ) -> Self {
        let span = locate(file, bytes, place);
        let (what, expected, hint) = (what.into(), expected.into(), hint.into());
        Self::Syntax(Box::new(Diagnosis { span, what, expected, hint }))
    }

    /// An error about the file `file` as a whole.
    pub(in crate::import) fn content(
        file: &str,
        what: impl Into<Sentence>,
        hint: impl Into<Sentence>,
    ) -> Self {
        Self::Content { file: file.to_owned(), what: what.into(), hint: hint.into() }
    }

    /// The same, with another thing to do about it.
    pub(in crate::import) fn or(mut self, way_out: impl Into<Sentence>) -> Self {
        let hint = match &mut self {
            Self::Syntax(diagnosis) => &mut diagnosis.hint,
            Self::Content { hint, .. } => hint,
        };
        *hint = std::mem::take(hint).then(way_out);
        self
    }

    /// The error as a terminal shows it: the line with a marker under the offending text, what was
    /// expected, the hint.
    #[must_use]
    pub fn render(&self) -> String {
        let Self::Syntax(diagnosis) = self else { return format!("error: {self}") };
        let Diagnosis { span, what, expected, hint } = diagnosis.as_ref();
        board::show(Severity::Error, what, Some(span), expected, &hint.to_string())
    }
}

/// The bytes of an offending text that are shown; the rest of a longer one is cut. Chosen: fits a
/// line with the message round it.
const SHOWN: usize = 60;

/// The place of the bytes `place` of a file: CR, LF and CR LF each end a line.
pub(in crate::import) fn locate(file: &str, bytes: &[u8], place: Range<usize>) -> SourceSpan {
    let start = place.start.min(bytes.len());
    let lines = (0..start).filter(|&i| ends_line(bytes, i)).count();
    let line_start = (0..start).rev().find(|&i| ends_line(bytes, i)).map_or(0, |i| i + 1);
    let shown = place.end.clamp(start, bytes.len()).min(start + SHOWN);
    SourceSpan {
        file: file.to_owned(),
        line: u32::try_from(lines + 1).unwrap_or(u32::MAX),
        column: u32::try_from(start - line_start + 1).unwrap_or(u32::MAX),
        text: printable(&bytes[start..shown]).trim_end().to_owned(),
        excerpt: excerpt(bytes, place),
    }
}

const fn ends_line(bytes: &[u8], at: usize) -> bool {
    match bytes[at] {
        b'\n' => true,
        b'\r' => at + 1 == bytes.len() || bytes[at + 1] != b'\n',
        _ => false,
    }
}

/// What stands on line `number`, counted from 1, without its end; the last line where there is no
/// such one.
pub(in crate::import) fn line(bytes: &[u8], number: u32) -> Range<usize> {
    let mut ends = (0..bytes.len()).filter(|&i| ends_line(bytes, i));
    let before = (number as usize).checked_sub(2);
    let Some(start) = before.map_or(Some(0), |skipped| ends.nth(skipped).map(|i| i + 1)) else {
        return last_line(bytes);
    };
    let end = ends.next().unwrap_or(bytes.len());
    start..start + bytes[start..end].trim_ascii_end().len()
}

/// The line around `place`, at most [`SHOWN`] bytes of it on either side, and where in it the place
/// is.
fn excerpt(bytes: &[u8], place: Range<usize>) -> Excerpt {
    let is_end = |b: &u8| matches!(b, b'\n' | b'\r');
    let start = place.start.min(bytes.len());
    let end = place.end.clamp(start, bytes.len()).min(start + SHOWN);
    let from = bytes[..start].iter().rposition(is_end).map_or(0, |i| i + 1).max(start.saturating_sub(SHOWN));
    let line_end = bytes[start..].iter().position(is_end).map_or(bytes.len(), |i| start + i);
    let to = line_end.min(end + SHOWN);
    let end = end.min(to).max(start);
    let before = printable(&bytes[from..start]);
    let marked = printable(&bytes[start..end]);
    let after = printable(&bytes[end..to]);
    let range = before.len()..before.len() + marked.len();
    Excerpt::new(before + &marked + &after, range)
}

/// The bytes as text: Latin-1, with a middle dot for what cannot be seen.
pub(in crate::import) fn printable(bytes: &[u8]) -> String {
    bytes
        .iter()
        .map(|&b| match b {
            b'\t' | b'\n' | b'\r' => ' ',
            0x20..=0x7e | 0xa1..=0xff => char::from(b),
            _ => '·',
        })
        .collect()
}

/// Where `words` stand first in `bytes`.
pub(in crate::import) fn find(bytes: &[u8], words: &[u8]) -> Option<usize> {
    bytes.windows(words.len().max(1)).position(|window| window == words)
}

/// The last line of a file that says anything, for what is wrong with a file's end or with all of
/// it.
pub(in crate::import) fn last_line(bytes: &[u8]) -> Range<usize> {
    let end = bytes.iter().rposition(|&b| b > b' ').map_or(0, |i| i + 1);
    let start = bytes[..end].iter().rposition(|b| matches!(b, b'\n' | b'\r')).map_or(0, |i| i + 1);
    start.max(end.saturating_sub(SHOWN))..end
}

/// What was repaired or left out while reading one file: of each kind the first place, and how many
/// there were.
///
/// A file with a habit has it on every line, and a thousand equal warnings hide the one that
/// matters.
#[derive(Debug)]
pub(in crate::import) struct Warnings<'a> {
    file: &'a str,
    bytes: &'a [u8],
    /// By code and message: the first place, and the count.
    found: BTreeMap<(&'static str, String), Found>,
    /// By code: how many messages there are, and one more than are kept.
    kinds: BTreeMap<&'static str, Found>,
}

/// A diagnostic, where it occurs first, and how often.
#[derive(Debug)]
struct Found {
    diagnostic: &'static Diagnostic,
    place: Range<usize>,
    count: u32,
}

/// How many different messages of one code are kept; the rest are only counted. Chosen.
const KEPT_OF_A_KIND: u32 = 8;

impl<'a> Warnings<'a> {
    /// None so far, for the file `file` with content `bytes`.
    pub(in crate::import) const fn new(file: &'a str, bytes: &'a [u8]) -> Self {
        Self { file, bytes, found: BTreeMap::new(), kinds: BTreeMap::new() }
    }

    /// Notes a diagnostic at the bytes `place`. The same diagnostic and message again only counts.
    pub(in crate::import) fn add(
        &mut self,
        diagnostic: &'static Diagnostic,
        place: Range<usize>,
        message: impl Into<String>,
    ) {
        let key = (diagnostic.code, message.into());
        if let Some(found) = self.found.get_mut(&key) {
            found.count += 1;
            return;
        }
        let kind =
            self.kinds.entry(diagnostic.code).or_insert(Found { diagnostic, place: place.clone(), count: 0 });
        kind.count += 1;
        if kind.count <= KEPT_OF_A_KIND {
            self.found.insert(key, Found { diagnostic, place, count: 1 });
        } else if kind.count == KEPT_OF_A_KIND + 1 {
            kind.place = place;
        }
    }

    /// All warnings, in file order.
    pub(in crate::import) fn finish(self) -> Vec<Warning> {
        let mut found: Vec<_> =
            self.found.into_iter().map(|((_, message), found)| (message, found)).collect();
        found.sort_by_key(|(_, found)| found.place.start);
        for (message, Found { count, .. }) in found.iter_mut().filter(|(_, found)| found.count > 1) {
            *message += &match *count {
                2 => " (and once more)".to_owned(),
                count => format!(" (and {} more times)", count - 1),
            };
        }
        let more = self.kinds.into_values().filter(|kind| kind.count > KEPT_OF_A_KIND);
        found.extend(more.map(|kind| (format!("{} more of this kind", kind.count - KEPT_OF_A_KIND), kind)));
        let warning = |(message, Found { diagnostic, place, .. }): (String, Found)| {
            diagnostic.warning(message).caused_by(locate(self.file, self.bytes, place))
        };
        found.into_iter().map(warning).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::diagnostic;

    #[test]
    fn every_kind_of_line_end_counts_once() {
        for text in ["a\nb\ncd", "a\rb\rcd", "a\r\nb\r\ncd"] {
            let span = locate("f", text.as_bytes(), text.len() - 1..text.len());
            assert_eq!((span.line, span.column, span.text.as_str()), (3, 2, "d"), "{text:?}");
        }
    }

    #[test]
    fn an_error_in_a_file_of_one_line_shows_its_surroundings_only() {
        let text = format!("{}D99*{}", "X1Y1D02*".repeat(10_000), "X1Y1D01*".repeat(10_000));
        let error = Error::syntax(
            "top.gbr",
            text.as_bytes(),
            80_000..80_004,
            "aperture D99 is not defined",
            "an aperture that an %ADD…% defined before",
            "",
        );
        let shown = error.render();
        assert!(shown.len() < 800, "{} bytes:\n{shown}", shown.len());
        assert!(shown.contains("top.gbr:1:80001"), "names the place:\n{shown}");
        assert!(shown.contains("^^^^"), "marks the text:\n{shown}");
    }

    #[test]
    fn a_habit_is_reported_once_with_a_count() {
        let mut warnings = Warnings::new("f", b"abc");
        for _ in 0..3 {
            warnings.add(&diagnostic::MISSING_STAR, 1..2, "does it");
        }
        let warnings = warnings.finish();
        assert_eq!(warnings.len(), 1, "one entry");
        assert_eq!(warnings[0].message, "does it (and 2 more times)", "with the count");
    }
}
