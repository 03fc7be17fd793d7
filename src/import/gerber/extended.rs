//! The commands between `%` (specification §4; the deprecated ones §8).

use std::borrow::Cow;
use std::ops::Range;

use crate::geometry::Nm;
use crate::import::diagnostic;

use super::super::error::{Error, printable};
use super::lex::{Block, Number, is_blank};
use super::reader::Reader;

/// A field of a command that has such letters: `A1.5B2`.
pub(super) type Field = (u8, Number);

impl<'a> Reader<'a> {
    /// A command that begins with two letters.
    pub(super) fn extended(&mut self, block: Block<'a>) -> Result<(), Error> {
        let (code, rest) = block.text.split_at(2);
        let rest = one_line(rest);
        let rest = rest.as_ref();
        let place = block.place();
        match code {
            b"FS" => self.format_statement(rest, place),
            b"MO" => self.unit_statement(rest, place),
            b"AD" => {
                self.define(rest, place);
                Ok(())
            }
            b"AM" => self.define_macro(block),
            b"AB" => self.block_aperture(rest, place),
            b"SR" => self.repeat(rest, place),
            b"LP" => self.load_polarity(rest, place),
            b"LM" | b"LR" | b"LS" => self.load_transformation(code, rest, place),
            b"TF" | b"TA" | b"TO" | b"TD" => {
                let text = one_line(block.text);
                self.attributes.command(text.as_ref());
                self.forget_set();
                Ok(())
            }
            b"IP" => self.image_polarity(rest, place),
            b"AS" | b"MI" | b"OF" | b"SF" | b"IR" => self.place_statement(code, rest, place),
            // Names, of the image and of what follows; the plotter's film.
            b"IN" | b"LN" | b"PF" => Ok(()),
            // The code of the file's characters, which is ASCII if it can be read at all; and what
            // says nothing but the default.
            b"IC" if rest.eq_ignore_ascii_case(b"AS") => Ok(()),
            b"IO" | b"RO" if rest.iter().all(|b| b"AB0.+-".contains(b) || is_blank(*b)) => Ok(()),
            b"IJ" if rest.iter().all(|b| b"ABL".contains(b) || is_blank(*b)) => Ok(()),
            b"IC" | b"IJ" | b"IO" | b"RO" => {
                let code = printable(code);
                let message = format!("%{code} is not supported and is ignored");
                self.warnings.add(&diagnostic::UNKNOWN_COMMAND, place, message);
                Ok(())
            }
            b"KO" => Err(self.error(place, "%KO, knockout, is not supported", "%LPC and %LPD", "")),
            b"IF" => {
                let hint = "put the content of the other file in its place";
                Err(self.error(
                    place,
                    "%IF includes another file, which is not supported",
                    "a file without includes",
                    hint,
                ))
            }
            _ => {
                let shown = printable(&block.text[..block.text.len().min(20)]);
                let message = format!("`{shown}` is not a known command; it is ignored");
                self.warnings.add(&diagnostic::UNKNOWN_COMMAND, place, message);
                Ok(())
            }
        }
    }

    /// A length, zero where it is left out.
    pub(super) fn optional(&mut self, number: Option<Number>, place: &Range<usize>) -> Result<Nm, Error> {
        let Some(number) = number else { return Ok(Nm::ZERO) };
        let unit = self.unit(place)?;
        unit.length(number).ok_or_else(|| {
            self.error(place.clone(), "this length is out of range", "at most 1073.741823 mm", "")
        })
    }

    /// Letters, each with a number.
    pub(super) fn fields(&self, text: &[u8], place: &Range<usize>) -> Result<Vec<Field>, Error> {
        let mut fields = Vec::new();
        let mut at = 0;
        while let Some(&letter) = text.get(at) {
            at += 1;
            if is_blank(letter) {
                continue;
            }
            let read = if letter.is_ascii_alphabetic() { Number::read(&text[at..]) } else { None };
            let (number, length) = read.ok_or_else(|| {
                self.error(place.clone(), "this command cannot be read", "letters, each with a number", "")
            })?;
            fields.push((letter.to_ascii_uppercase(), number));
            at += length;
        }
        Ok(fields)
    }
}

/// The text without line ends, which may stand anywhere in a command.
pub(super) fn one_line(text: &[u8]) -> Cow<'_, [u8]> {
    let is_end = |b: &u8| matches!(b, b'\r' | b'\n' | 0);
    if text.iter().any(is_end) {
        Cow::Owned(text.iter().copied().filter(|b| !is_end(b)).collect())
    } else {
        Cow::Borrowed(text)
    }
}
