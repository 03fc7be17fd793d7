//! The fields of a command that has letters, each with a number: `SRX2Y3I4.0J3.0`.

use super::fault::Fault;
use super::lex::{Number, is_blank};

/// Letters, each with a number.
#[derive(Debug)]
pub(super) struct Fields(Vec<(u8, Number)>);

impl Fields {
    pub(super) fn read(text: &[u8]) -> Result<Self, Fault> {
        let mut fields = Vec::new();
        let mut at = 0;
        while let Some(&letter) = text.get(at) {
            at += 1;
            if is_blank(letter) {
                continue;
            }
            let read = if letter.is_ascii_alphabetic() { Number::read(&text[at..]) } else { None };
            let (number, length) =
                read.ok_or_else(|| Fault::new("this command cannot be read", "letters, each with a number"))?;
            fields.push((letter.to_ascii_uppercase(), number));
            at += length;
        }
        Ok(Self(fields))
    }

    /// The number of the first field with this letter.
    pub(super) fn get(&self, letter: u8) -> Option<Number> {
        self.0.iter().find(|field| field.0 == letter).map(|field| field.1)
    }
}
