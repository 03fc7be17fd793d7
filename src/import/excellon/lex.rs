//! Bytes → lines of words. Excellon is a language of lines; any of CR, LF and CR LF ends one.

use std::ops::Range;

use crate::import::error::Error;

/// The text of a number, not yet a length: that takes units and, without a decimal point, a number
/// format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Number {
    /// Whether a minus stands before it.
    pub(super) negative: bool,
    /// The first 18 digits, zeros before the first of them left aside, as one integer, the point
    /// left out.
    pub(super) digits: u64,
    /// How many digits there are, leading zeros counted.
    pub(super) count: u8,
    /// How many of `digits` stand after the point; none without a point.
    pub(super) decimals: Option<u8>,
    /// How many digits before the point `digits` does not hold; those after it that it does not
    /// hold are below any rounding.
    pub(super) beyond: u8,
}

impl Number {
    /// Whether its first digit, of several, is a zero.
    pub(super) const fn has_leading_zero(self) -> bool {
        self.count > 1 && self.beyond == 0 && self.digits < 10_u64.saturating_pow(self.count as u32 - 1)
    }

    /// As a count or a code, `T01`, `R5`: none with a sign or a point, or beyond 2³² − 1.
    pub(super) fn integer(self) -> Option<u32> {
        (!self.negative && self.decimals.is_none() && self.beyond == 0)
            .then(|| u32::try_from(self.digits).ok())?
    }
}

/// A letter with its number.
#[derive(Clone, Debug)]
pub(super) struct Word {
    /// Upper case.
    pub(super) letter: u8,
    /// What follows it.
    pub(super) number: Number,
    /// Where in the file.
    pub(super) place: Range<usize>,
}

/// What a line is.
#[derive(Clone, Debug)]
pub(super) enum Kind {
    /// After a semicolon, without it.
    Comment(String),
    /// `%`: the end of the header, or the start of the program.
    Percent,
    /// A header command that is a word: `INCH,TZ`, `M71,LZ`, `FMAT,2`; in upper case, split at the
    /// commas.
    Keyword(Vec<String>),
    /// Letters with numbers.
    Words(Vec<Word>),
    /// The definition of a tool, by its number, that cannot be read.
    BrokenTool(u32, Box<Error>),
}

/// A line that says something.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// Where in the file.
    pub(super) place: Range<usize>,
    /// From 1.
    pub(super) number: u32,
    /// What it is.
    pub(super) kind: Kind,
}

impl Word {
    /// Whether it is a coordinate of a place.
    pub(super) const fn is_coordinate(&self) -> bool {
        matches!(self.letter, b'X' | b'Y')
    }
}

impl Line {
    /// Whether it names a place.
    pub(super) fn has_place(&self) -> bool {
        matches!(&self.kind, Kind::Words(words) if words.iter().any(Word::is_coordinate))
    }
}

/// The most lines that a file may have. Chosen above [`MOST_HOLES`](super::machine::MOST_HOLES),
/// and below a gigabyte of memory.
const MOST_LINES: usize = 3_000_000;

/// The lines of a file that say something, in order.
pub(super) fn lines(file: &str, bytes: &[u8]) -> Result<Vec<Line>, Error> {
    let mut found = Vec::new();
    for (number, place) in (1_u32..).zip(line_places(bytes)) {
        let lexer = Lexer { file, bytes, at: place.start, end: place.end };
        lexer.line(number, &mut found)?;
        if found.len() > MOST_LINES {
            let what = format!("the drill file has more than {MOST_LINES} lines");
            return Err(Error::content(file, what, "no board has as many holes; the file may be damaged"));
        }
    }
    Ok(found)
}

/// Where each line lies, without its end.
fn line_places(bytes: &[u8]) -> impl Iterator<Item = Range<usize>> {
    let mut at = 0;
    std::iter::from_fn(move || {
        if at >= bytes.len() {
            return None;
        }
        let start = at;
        let end =
            bytes[start..].iter().position(|b| matches!(b, b'\n' | b'\r')).map_or(bytes.len(), |i| start + i);
        let both = bytes[end..].starts_with(b"\r\n");
        at = end + if both { 2 } else { 1 };
        Some(start..end)
    })
}

/// Messages for the operator, whose text is free: `M47,CHANGE BIT`, `M97,` and `M98,` (text to be
/// drilled).
const MESSAGES: [&str; 4] = ["M45", "M47", "M97", "M98"];

struct Lexer<'a> {
    file: &'a str,
    bytes: &'a [u8],
    at: usize,
    end: usize,
}

impl Lexer<'_> {
    /// Reads the whole line into at most two lines: what stands before a semicolon, and the comment
    /// after it.
    fn line(mut self, number: u32, found: &mut Vec<Line>) -> Result<(), Error> {
        self.skip_blanks();
        let place = self.at..self.end;
        let code_end =
            self.bytes[place.clone()].iter().position(|&b| b == b';').map_or(place.end, |i| place.start + i);
        let comment = (code_end < place.end).then(|| text(&self.bytes[code_end + 1..place.end]));
        self.end = code_end;
        let code = self.code().or_else(|error| {
            let tool = broken_tool(&self.bytes[place.start..code_end]);
            tool.map(|number| Some(Kind::BrokenTool(number, Box::new(error.clone())))).ok_or(error)
        });
        if let Some(kind) = code? {
            found.push(Line { place: place.clone(), number, kind });
        }
        found.extend(comment.map(|text| Line { place, number, kind: Kind::Comment(text) }));
        Ok(())
    }

    fn code(&mut self) -> Result<Option<Kind>, Error> {
        // An optional block (`/`) is drilled: leaving it out is the operator's choice, made at the
        // machine.
        while matches!(self.peek(), Some(b'/')) {
            self.at += 1;
            self.skip_blanks();
        }
        let rest = text(&self.bytes[self.at..self.end]);
        Ok(match self.peek() {
            None => None,
            Some(b'%') => Some(Kind::Percent),
            Some(b'(') => Some(Kind::Comment(rest)),
            Some(_) if is_keyword(&rest) => Some(Kind::Keyword(
                rest.to_ascii_uppercase().split(',').map(|s| s.trim().to_owned()).collect(),
            )),
            Some(_) => Some(Kind::Words(self.words()?)),
        })
    }

    fn words(&mut self) -> Result<Vec<Word>, Error> {
        let mut words = Vec::with_capacity(2);
        loop {
            self.skip_blanks();
            let Some(letter) = self.peek() else { return Ok(words) };
            let start = self.at;
            if !letter.is_ascii_alphabetic() {
                return Err(self.unexpected(
                    start,
                    "not a drill command",
                    "a letter with a number, such as X01500",
                ));
            }
            self.at += 1;
            let number = self.number(start)?;
            words.push(Word { letter: letter.to_ascii_uppercase(), number, place: start..self.at });
        }
    }

    fn number(&mut self, word: usize) -> Result<Number, Error> {
        self.skip_blanks();
        let negative = self.peek() == Some(b'-');
        if matches!(self.peek(), Some(b'+' | b'-')) {
            self.at += 1;
        }
        /// From here on a further digit may be more than an `i64` holds.
        const FULL: u64 = 10_u64.pow(17);
        let (mut digits, mut count, mut decimals, mut beyond) = (0_u64, 0_u8, None, 0_u8);
        while let Some(b) = self.peek() {
            match b {
                b'0'..=b'9' => {
                    count = count.saturating_add(1);
                    if digits < FULL {
                        digits = digits * 10 + u64::from(b - b'0');
                        decimals = decimals.map(|d: u8| d.saturating_add(1));
                    } else if decimals.is_none() {
                        beyond = beyond.saturating_add(1);
                    }
                }
                b'.' if decimals.is_none() => decimals = Some(0),
                b'.' => {
                    self.at += 1;
                    return Err(self.unexpected(word, "not a number", "digits and one point"));
                }
                _ => break,
            }
            self.at += 1;
        }
        if count == 0 {
            return Err(self.unexpected(word, "a letter without its number", "digits after the letter"));
        }
        Ok(Number { negative, digits, count, decimals, beyond })
    }

    fn unexpected(&self, start: usize, what: &str, expected: &str) -> Error {
        let end = (self.at + 1).clamp(start + 1, self.end.max(start + 1));
        let hint = "the file may be damaged, or not an Excellon drill file";
        Error::syntax(self.file, self.bytes, start..end, what, expected, hint)
    }

    fn peek(&self) -> Option<u8> {
        (self.at < self.end).then(|| self.bytes[self.at])
    }

    /// Blanks, and the stray NULs and commas that some programs leave.
    fn skip_blanks(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | 0 | b',' | 0x1a)) {
            self.at += 1;
        }
        if self.at == 0 && self.bytes.starts_with(b"\xef\xbb\xbf") {
            self.at = 3.min(self.end);
        }
    }
}

/// The number of the tool that a line defines, `T3C…`.
fn broken_tool(line: &[u8]) -> Option<u32> {
    let rest = line.strip_prefix(b"T").or_else(|| line.strip_prefix(b"t"))?;
    let digits = rest.iter().take_while(|b| b.is_ascii_digit()).count();
    let is_definition = rest.get(digits).is_some_and(|b| b.eq_ignore_ascii_case(&b'C'));
    text(&rest[..digits]).parse().ok().filter(|_| is_definition)
}

/// Whether a line is a header command or a message and not letters with numbers: `INCH,TZ`,
/// `M71,LZ`, `R,T`, `M47…`.
fn is_keyword(line: &str) -> bool {
    let bytes = line.as_bytes();
    let two_letters = bytes.len() >= 2 && bytes[..2].iter().all(u8::is_ascii_alphabetic);
    let starts = |head: &&str| line.get(..3).is_some_and(|start| start.eq_ignore_ascii_case(head));
    let message = MESSAGES.iter().any(starts);
    let units = ["M71", "M72"].iter().any(starts) && line.contains(',');
    two_letters || message || units || bytes.get(1) == Some(&b',')
}

/// The bytes as Latin-1, without blanks at the ends.
fn text(bytes: &[u8]) -> String {
    bytes.iter().map(|&b| char::from(b)).collect::<String>().trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<(char, u64, Option<u8>)> {
        let lines = lines("f", text.as_bytes()).unwrap();
        let all = lines.into_iter().filter_map(|l| match l.kind {
            Kind::Words(words) => Some(words),
            _ => None,
        });
        all.flatten().map(|w| (char::from(w.letter), w.number.digits, w.number.decimals)).collect()
    }

    #[test]
    fn every_line_end_and_every_blank_is_taken() {
        let expected = vec![('X', 100, None), ('Y', 25, Some(1)), ('M', 30, None)];
        for text in
            ["X0100Y2.5\nM30", "X0100Y2.5\r\nM30\r\n", "X 0100 Y +2.5\rM30", "\0X0100y2.5\n\n/M30 ; end"]
        {
            assert_eq!(words(text), expected, "{text:?}");
        }
    }

    #[test]
    fn a_number_has_any_number_of_digits() {
        assert_eq!(
            words("X0.024000000000000004"),
            [('X', 24_000_000_000_000_004, Some(18))],
            "all that matter"
        );
        assert_eq!(
            words("X1.00000000000000000000000000"),
            [('X', 100_000_000_000_000_000, Some(17))],
            "the first"
        );
        assert_eq!(words("X0000000000000000000000012"), [('X', 12, None)], "zeros before it");
    }

    #[test]
    fn a_letter_without_a_number_names_its_place() {
        let error = lines("a.drl", b"T1\nX01Y\n").unwrap_err().to_string();
        assert!(error.starts_with("a.drl:2:4:"), "{error}");
    }
}
