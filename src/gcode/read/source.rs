//! A text → its lines, whatever ends them, and the code of a line without comments.

use super::error::ReadError;

/// The lines of a program's text: ended by LF, by CR LF or by CR alone, without a byte order mark.
/// They are counted so everywhere.
pub fn lines(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = Some(text.strip_prefix('\u{feff}').unwrap_or(text)).filter(|rest| !rest.is_empty());
    std::iter::from_fn(move || {
        let text = rest?;
        let Some(end) = text.find(['\n', '\r']) else {
            rest = None;
            return Some(text);
        };
        let next = if text[end..].starts_with("\r\n") { end + 2 } else { end + 1 };
        rest = Some(&text[next..]).filter(|rest| !rest.is_empty());
        Some(&text[..end])
    })
}

/// How lines begin that a controller takes at once, and that are no part of the program.
pub(super) const AT_ONCE: [char; 4] = ['$', '?', '!', '~'];

/// How many characters of an offending text an error shows. Chosen: more than any word, less than a
/// line of a terminal.
const SHOWN: usize = 40;

/// A line with its number, to make errors that point into it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pointer<'a> {
    pub(super) line: u32,
    pub(super) source: &'a str,
}

impl Pointer<'_> {
    /// An error at `column`, from 1; it shows the text from there to the next blank.
    pub(super) fn error(self, column: u32, expected: impl Into<String>) -> ReadError {
        let at = usize::try_from(column).unwrap_or(1) - 1;
        let rest = self.source.get(at..).unwrap_or_default();
        let word = rest.split_whitespace().next().unwrap_or_default();
        let mut shown: String = word.chars().take(SHOWN).collect();
        if shown.len() < word.len() {
            shown.push('…');
        }
        ReadError { line: self.line, column, text: shown, expected: expected.into() }
    }
}

/// The code of a line: capitals without blanks and comments, since controllers read it so, each
/// with its column.
#[derive(Clone, Debug)]
pub(super) struct Code<'a> {
    pub(super) pointer: Pointer<'a>,
    bytes: Vec<u8>,
    columns: Vec<u32>,
    at: usize,
    /// Whether a comment does not end in its line.
    pub(super) open_comment: bool,
}

impl<'a> Code<'a> {
    pub(super) fn new(pointer: Pointer<'a>) -> Self {
        let most = pointer.source.len();
        let (bytes, columns) = (Vec::with_capacity(most), Vec::with_capacity(most));
        let mut code = Self { pointer, bytes, columns, at: 0, open_comment: false };
        let mut depth = 0_u32;
        for (column, byte) in (1_u32..).zip(pointer.source.bytes()) {
            match byte {
                // Comments in comments: some write the name of a tool so, `(end mill (long))`.
                b'(' => depth += 1,
                b')' if depth > 0 => depth -= 1,
                _ if depth > 0 => {}
                b';' => break,
                // Other control characters are no blanks: they belong to no program.
                b' ' | b'\t' | b'\r' | 0 | 0x1a => {}
                _ => {
                    code.bytes.push(byte.to_ascii_uppercase());
                    code.columns.push(column);
                }
            }
        }
        code.open_comment = depth > 0;
        code
    }

    /// The next byte.
    pub(super) fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Takes the next byte where it is this one.
    pub(super) fn take(&mut self, byte: u8) -> bool {
        let found = self.peek() == Some(byte);
        self.at += usize::from(found);
        found
    }

    /// Takes this text where it is next.
    pub(super) fn take_text(&mut self, text: &str) -> bool {
        let found = self.bytes[self.at..].starts_with(text.as_bytes());
        self.at += if found { text.len() } else { 0 };
        found
    }

    /// Takes what is next as long as it is `wanted`.
    pub(super) fn take_while(&mut self, wanted: impl Fn(u8) -> bool) -> String {
        let rest = &self.bytes[self.at..];
        let count = rest.iter().take_while(|byte| wanted(**byte)).count();
        let taken = String::from_utf8_lossy(&rest[..count]).into_owned();
        self.at += count;
        taken
    }

    /// Takes digits and points; the number they are, if they are one.
    pub(super) fn take_number(&mut self) -> Option<f64> {
        let rest = &self.bytes[self.at..];
        let count = rest.iter().take_while(|byte| byte.is_ascii_digit() || **byte == b'.').count();
        let text = str::from_utf8(&rest[..count]).unwrap_or_default();
        self.at += count;
        text.parse::<f64>().ok()
    }

    /// What was taken since it was as `before`, and where in the line that ends.
    pub(super) fn since(&self, before: &Self) -> (&[u8], usize) {
        let end = self.columns[..self.at].last().map_or(0, |column| usize::try_from(*column).unwrap_or(0));
        (&self.bytes[before.at..self.at], end)
    }

    /// The column of what is next; of the end, that behind the line.
    pub(super) fn column(&self) -> u32 {
        let end = || u32::try_from(self.pointer.source.len() + 1).unwrap_or(u32::MAX);
        self.columns.get(self.at).copied().unwrap_or_else(end)
    }

    /// An error at what is next.
    pub(super) fn error(&self, expected: impl Into<String>) -> ReadError {
        self.pointer.error(self.column(), expected)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_as_any_editor_ends_them() {
        let all: Vec<&str> = lines("\u{feff}G21\rG90\r\nX1\n\nM2").collect();
        assert_eq!(all, ["G21", "G90", "X1", "", "M2"], "three ends of lines and a byte order mark");
        assert_eq!(lines("a\n").count(), 1, "what ends a line begins none");
    }

    #[test]
    fn comments_within_comments_are_dropped_whole() {
        let mut code = Code::new(Pointer { line: 1, source: "g1 (drill (long)) x 1 ; y2" });
        assert_eq!(code.take_while(|_| true), "G1X1", "capitals without blanks");
    }
}
