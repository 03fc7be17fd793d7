//! A line → its words: codes, values, assignments, each where it stands.

use super::error::ReadError;
use super::expression::{Scope, name, value};
use super::source::Code;
use super::variables::Name;

/// A letter with its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word {
    pub(super) value: f64,
    pub(super) column: u32,
}

/// A G or M with its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Order {
    pub(super) letter: char,
    /// Ten times the number: 382 for G38.2.
    pub(super) key: u32,
    pub(super) column: u32,
}

/// What a line says.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    pub(super) orders: Vec<Order>,
    words: [Option<Word>; 26],
    /// `@` and `^`: LinuxCNC's polar coordinates.
    pub(super) radius: Option<Word>,
    pub(super) angle: Option<Word>,
    pub(super) assignments: Vec<(Name, f64)>,
    /// Axes that are named without a number: Marlin's `G28 X Y`.
    pub(super) named: Vec<char>,
    /// Letters of axes that are not followed, and the extruder.
    pub(super) others: Vec<char>,
    /// Whether a number is not written out: a parameter or an expression.
    pub(super) computed: bool,
    /// The checksum behind the line, and whether it is right.
    pub(super) checksum: Option<bool>,
    /// Whether the line may be left out by a switch of the machine.
    pub(super) optional: bool,
}

impl Block {
    pub(super) fn get(&self, letter: char) -> Option<Word> {
        self.words[slot(letter)]
    }

    /// Where the first of these letters stands.
    pub(super) fn first(&self, letters: &str) -> Option<Word> {
        letters.chars().find_map(|letter| self.get(letter))
    }

    /// Reads what is left of a line.
    pub(super) fn read(code: &mut Code<'_>, scope: &mut dyn Scope) -> Result<Self, ReadError> {
        let mut block = Self::begin(code);
        while let Some(byte) = code.peek() {
            if !block.next(code, scope, byte)? {
                break;
            }
        }
        Ok(block)
    }

    /// What stands before the words of a line.
    pub(super) fn begin(code: &mut Code<'_>) -> Self {
        let block = Self { optional: code.take(b'/'), ..Self::default() };
        if block.optional {
            // `/2`: one of several switches.
            code.take_while(|byte| byte.is_ascii_digit());
        }
        block
    }

    /// Reads what is next and begins with this byte; false where that is no more words.
    pub(super) fn next(
        &mut self,
        code: &mut Code<'_>,
        scope: &mut dyn Scope,
        byte: u8,
    ) -> Result<bool, ReadError> {
        if self.tells_text() {
            return Ok(false);
        }
        let column = code.column();
        match byte {
            b'#' => self.assign(code, scope)?,
            b'*' => self.check(code)?,
            b'@' | b'^' => {
                code.take(byte);
                let word = Word { value: self.number(code, scope)?, column };
                let polar = if byte == b'@' { &mut self.radius } else { &mut self.angle };
                if polar.replace(word).is_some() {
                    return Err(code.pointer.error(column, "the word is twice in the line"));
                }
            }
            b'A'..=b'Z' => return self.word(code, scope, byte),
            _ => return Err(code.error("expected a letter and a number, such as X1.5")),
        }
        Ok(true)
    }

    /// A letter and its value; false where a text for the operator follows.
    fn word(&mut self, code: &mut Code<'_>, scope: &mut dyn Scope, byte: u8) -> Result<bool, ReadError> {
        let (column, letter) = (code.column(), char::from(byte));
        if byte == b'E' && is_exponent(code) {
            return Err(code.error("a number with an exponent, which no controller reads"));
        }
        code.take(byte);
        let begins = matches!(code.peek(), Some(b'0'..=b'9' | b'.' | b'+' | b'-' | b'#' | b'['));
        if !begins && self.names_axes() && matches!(letter, 'X' | 'Y' | 'Z' | 'E') {
            self.named.push(letter);
            return Ok(true);
        }
        if !begins && self.shows_text() {
            return Ok(false);
        }
        if !begins && !matches!(code.peek(), Some(b'A'..=b'Z')) {
            return Err(code.pointer.error(column, "expected a number after the letter"));
        }
        let number = self.number(code, scope).map_err(|error| match begins {
            true => error,
            false => code.pointer.error(column, "expected a number after the letter"),
        })?;
        match letter {
            'G' | 'M' => {
                self.orders.push(order(letter, number, column).ok_or_else(|| {
                    code.pointer.error(column, format!("expected the number of a {letter} code"))
                })?);
            }
            'N' => {}
            'A' | 'B' | 'C' | 'U' | 'V' | 'W' | 'E' => self.others.push(letter),
            _ => {
                if self.words[slot(letter)].replace(Word { value: number, column }).is_some() {
                    return Err(code.pointer.error(column, "the letter is twice in the line"));
                }
            }
        }
        Ok(true)
    }

    fn number(&mut self, code: &mut Code<'_>, scope: &mut dyn Scope) -> Result<f64, ReadError> {
        self.computed |= !matches!(code.peek(), Some(b'0'..=b'9' | b'.' | b'+' | b'-'));
        value(code, scope)
    }

    /// `#3 = 1.5`.
    fn assign(&mut self, code: &mut Code<'_>, scope: &mut dyn Scope) -> Result<(), ReadError> {
        code.take(b'#');
        let name = name(code, scope)?;
        if !code.take(b'=') {
            return Err(code.error("expected a `=` and what the parameter is set to"));
        }
        let value = value(code, scope)?;
        self.computed = true;
        self.assignments.push((name, value));
        Ok(())
    }

    /// `*71`: all bytes before it, each exclusive-ored with the rest.
    fn check(&mut self, code: &mut Code<'_>) -> Result<(), ReadError> {
        let at = usize::try_from(code.column()).unwrap_or(1) - 1;
        code.take(b'*');
        let before = code.clone();
        let expected: u8 = code
            .take_while(|byte| byte.is_ascii_digit())
            .parse()
            .map_err(|_| before.error("expected a checksum from 0 to 255"))?;
        let sum = code.pointer.source.bytes().take(at).fold(0, |sum, byte| sum ^ byte);
        self.checksum = Some(sum == expected);
        Ok(())
    }

    /// Whether the line is one in which printers' firmware takes axes without numbers: G28, and
    /// M17, M18 and M84.
    fn names_axes(&self) -> bool {
        let order = self.orders.last().map(|order| (order.letter, order.key));
        matches!(order, Some(('G', 280) | ('M', 170 | 180 | 840)))
    }

    /// Whether what follows the words so far is a text in any case: Marlin's messages, its file
    /// names, its host commands.
    fn tells_text(&self) -> bool {
        let order = self.orders.last().map(|order| (order.letter, order.key));
        matches!(order, Some(('M', 1170 | 1180 | 230 | 280 | 9500)))
    }

    /// Whether what follows the words so far is a text for the operator (Marlin's `M0 insert the
    /// drill`).
    fn shows_text(&self) -> bool {
        self.orders.last().is_some_and(|order| order.letter == 'M' && matches!(order.key, 0 | 10))
    }
}

/// Whether an E stands right behind a number, and digits behind it.
fn is_exponent(code: &Code<'_>) -> bool {
    let at = usize::try_from(code.column()).unwrap_or(1) - 1;
    let bytes = code.pointer.source.as_bytes();
    let is_digit = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_digit);
    let behind = bytes.get(at + 1..).unwrap_or_default();
    let behind = behind.strip_prefix(b"-").or_else(|| behind.strip_prefix(b"+")).unwrap_or(behind);
    let before = at.checked_sub(1).and_then(|before| bytes.get(before));
    (is_digit(before) || before == Some(&b'.')) && is_digit(behind.first())
}

fn slot(letter: char) -> usize {
    usize::from(u8::try_from(letter).unwrap_or(b'A').saturating_sub(b'A')).min(25)
}

/// The code of this number: whole, or with one decimal.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked before")]
fn order(letter: char, number: f64, column: u32) -> Option<Order> {
    let tenfold = (number * 10.0).round();
    let fits = (number * 10.0 - tenfold).abs() <= 1e-3 && (0.0..100_000.0).contains(&tenfold);
    fits.then_some(Order { letter, key: tenfold as u32, column })
}
