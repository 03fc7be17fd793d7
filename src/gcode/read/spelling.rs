//! The words of a line as they are spelled, for whoever changes some of them: taken as the reader
//! takes them.

use std::ops::Range;

use super::block::Block;
use super::error::ReadError;
use super::expression::Scope;
use super::source::{AT_ONCE, Code, Pointer};
use super::variables::Name;

/// A letter with its number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spelled {
    /// A capital, or the `*` of a checksum.
    pub letter: char,
    /// Its number, without blanks.
    pub number: String,
    /// The bytes of the line where both stand.
    pub place: Range<usize>,
}

/// The words of a line, without comments and texts for the operator; none of a line that is no part
/// of the program, such as `%` or `$H`.
///
/// # Errors
///
/// The first word that cannot be read, or whose number is not written out.
pub fn spelled(line: u32, source: &str) -> Result<Vec<Spelled>, ReadError> {
    let mut words = Vec::new();
    if source.trim_start().starts_with('%') || source.trim_start().starts_with(AT_ONCE) {
        return Ok(words);
    }
    let mut code = Code::new(Pointer { line, source });
    let mut block = Block::begin(&mut code);
    while let Some(byte) = code.peek() {
        let before = code.clone();
        if !block.next(&mut code, &mut Unknown, byte)? {
            break;
        }
        let (taken, end) = code.since(&before);
        let number = String::from_utf8_lossy(&taken[1..]).into_owned();
        // An axis that is named alone has none.
        if !number.is_empty() {
            let from = usize::try_from(before.column()).unwrap_or(1) - 1;
            words.push(Spelled { letter: char::from(byte), number, place: from..end });
        }
    }
    Ok(words)
}

/// Where no program runs, no parameter holds anything.
struct Unknown;

impl Scope for Unknown {
    fn parameter(&mut self, _: &Name) -> Result<f64, String> {
        Err("variables and expressions are not supported".to_owned())
    }

    fn exists(&self, _: &Name) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stand_where_they_are_spelled() {
        let line = "/2 n7 g1(end mill (long) X1)x - 1.5 Y.2*33 ; Z1";
        let words = spelled(1, line).expect("words");
        let places: Vec<&str> = words.iter().map(|word| &line[word.place.clone()]).collect();
        assert_eq!(places, ["n7", "g1", "x - 1.5", "Y.2", "*33"], "as they are written");
        let read: Vec<(char, &str)> = words.iter().map(|word| (word.letter, word.number.as_str())).collect();
        assert_eq!(
            read,
            [('N', "7"), ('G', "1"), ('X', "-1.5"), ('Y', ".2"), ('*', "33")],
            "as they are read"
        );
    }

    #[test]
    fn texts_for_the_operator_are_no_words() {
        for line in ["M118 X1 to go", "M117 Z", "M0 insert the drill", "M84 X Y", "%1", "$X", "(all of it) "]
        {
            let words = spelled(1, line).expect(line);
            assert!(words.iter().all(|word| word.letter == 'M'), "{line}: {words:?}");
        }
        assert!(spelled(1, "G1 X[1+1]").is_ok_and(|words| words[1].number == "[1+1]"), "an expression");
        assert!(spelled(1, "G1 X#1").is_err(), "a parameter");
    }
}
