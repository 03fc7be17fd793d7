//! Aperture and macro definitions (AD, AM; specification §4.3 to §4.5).

use std::ops::Range;

use crate::geometry::Nm;
use crate::import::diagnostic;

use super::super::error::{Error, printable};
use super::aperture::{Hole, Template};
use super::aperture_macro::{Macro, MacroFault, VERTICES};
use super::lex::{Block, End, Number, is_blank};
use super::reader::{Aperture, Malformed, Reader};
use super::state::Unit;

impl<'a> Reader<'a> {
    /// Defines an aperture, or keeps what is wrong with it until it is selected.
    pub(super) fn define(&mut self, text: &[u8], place: Range<usize>) {
        if let Err(error) = self.define_aperture(text, place.clone()) {
            let number =
                text.strip_prefix(b"D").and_then(Number::read).and_then(|(number, _)| number.to_integer());
            let number = number.and_then(|number| u32::try_from(number).ok());
            if let Some(number) = number {
                self.apertures.remove(&number);
                self.forget_aperture(number);
            }
            self.malformed.push(Malformed { number, place, error });
        }
    }

    /// Why aperture `number` cannot be selected, where its last definition cannot be read.
    pub(super) fn malformed(&self, number: u32) -> Option<Error> {
        let of = |malformed: &&Malformed| malformed.number == Some(number);
        self.malformed.iter().rfind(of).map(|malformed| malformed.error.clone())
    }

    /// Says what is wrong with apertures that nothing selects.
    pub(super) fn explain_malformed(&mut self) {
        for Malformed { place, error, .. } in std::mem::take(&mut self.malformed) {
            let what = match &error {
                Error::Syntax(diagnosis) => diagnosis.what.clone(),
                Error::Content { what, .. } => what.to_string(),
            };
            let message = format!("{what}; this aperture is never selected and is ignored");
            self.warnings.add(&diagnostic::MALFORMED_APERTURE, place, message);
        }
    }

    /// `ADD10C,0.25`
    fn define_aperture(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        let expected = "an aperture definition, such as `%ADD10C,0.25*%`";
        let read = text.strip_prefix(b"D").and_then(Number::read);
        let (number, length) =
            read.ok_or_else(|| self.error(place.clone(), "this aperture has no number", expected, ""))?;
        let number = number.to_integer().and_then(|n| u32::try_from(n).ok()).filter(|n| *n >= 10);
        let number =
            number.ok_or_else(|| self.error(place.clone(), "aperture numbers begin at D10", expected, ""))?;
        let text = &text[1 + length..];
        let (name, parameters) = match text.iter().position(|&b| b == b',') {
            Some(comma) => (&text[..comma], &text[comma + 1..]),
            None => (text, &text[text.len()..]),
        };
        let template = self.template(name.trim_ascii(), parameters, &place)?;
        let function = self.attributes.aperture.clone();
        if self.apertures.insert(number, Aperture::new(template, function)).is_some() {
            let message = format!("aperture D{number} is defined twice; what follows uses the later one");
            self.warnings.add(&diagnostic::APERTURE_DEFINED_TWICE, place, message);
        }
        self.forget_aperture(number);
        Ok(())
    }

    pub(super) fn template(
        &mut self,
        name: &[u8],
        parameters: &[u8],
        place: &Range<usize>,
    ) -> Result<Template, Error> {
        let mut numbers = Vec::new();
        for field in parameters.split(|b| matches!(b, b'X' | b'x')) {
            if field.iter().all(|&b| is_blank(b)) {
                continue;
            }
            let number = Number::whole(field).ok_or_else(|| {
                let what = format!("`{}` is not a number", printable(field));
                self.error(
                    place.clone(),
                    what,
                    "decimal numbers with `X` between them, as in `R,1.5X0.6`",
                    "",
                )
            })?;
            numbers.push(number);
        }
        let unit = self.unit(place)?;
        match name {
            b"C" | b"R" | b"O"
                if numbers.iter().skip(usize::from(name != b"C") + 1).any(|n| n.mantissa < 0) =>
            {
                let message = "the hole of an aperture has a negative size; the hole is ignored";
                self.warnings.add(&diagnostic::NEGATIVE_HOLE, place.clone(), message);
                self.standard(name[0], &numbers, unit, place)
            }
            b"C" | b"R" | b"O" | b"P" => self.standard(name[0], &numbers, unit, place),
            _ => {
                let definition = self.macros.get(name).ok_or_else(|| {
                    let what = format!("the aperture macro `{}` is not defined", printable(name));
                    let expected = "C, R, O, P or a macro that %AM defines before it";
                    self.error(place.clone(), what, expected, "")
                })?;
                let parameters = numbers.iter().map(|number| number.to_f64()).collect();
                let primitives = definition.evaluate(parameters, unit);
                let primitives = primitives.map_err(|MacroFault { place, what, expected }| {
                    let name = printable(name);
                    self.error(place, format!("in the aperture macro `{name}`: {what}"), expected, "")
                })?;
                Ok(Template::Macro { name: printable(name), primitives })
            }
        }
    }

    pub(super) fn standard(
        &self,
        name: u8,
        numbers: &[Number],
        unit: Unit,
        place: &Range<usize>,
    ) -> Result<Template, Error> {
        let (least, expected) = match name {
            b'C' => (1, "a diameter, and optionally that of a hole: `C,1.5X0.8`"),
            b'P' => {
                (2, "a diameter, a number of vertices, and optionally a rotation and a hole: `P,1.5X6X30`")
            }
            _ => (2, "a width and a height, and optionally the diameter of a hole: `R,1.5X0.6`"),
        };
        let fault = |what: &str| self.error(place.clone(), what, expected, "");
        if numbers.len() < least {
            return Err(fault("this aperture has too few parameters"));
        }
        let length = |number: &Number| {
            let length = unit.length(*number).filter(|length| *length >= Nm::ZERO);
            length.ok_or_else(|| fault("this is not an aperture size: negative, or above one metre"))
        };
        let hole = |rest: &[Number]| {
            Ok(match rest {
                [] => Hole::None,
                [width, ..] if width.mantissa <= 0 => Hole::None,
                [diameter] => Hole::Round(length(diameter)?),
                [width, height, ..] => Hole::Rectangular(length(width)?, length(height)?),
            })
        };
        Ok(match name {
            b'C' => Template::Circle { diameter: length(&numbers[0])?, hole: hole(&numbers[1..])? },
            b'P' => {
                let vertices = numbers[1].to_integer().and_then(|n| u32::try_from(n).ok());
                let vertices = vertices
                    .filter(|n| (3..=VERTICES).contains(n))
                    .ok_or_else(|| fault(&format!("a polygon has from 3 to {VERTICES} vertices")))?;
                let rotation = numbers.get(2).map_or(0.0, |number| number.to_f64());
                let hole = hole(numbers.get(3..).unwrap_or(&[]))?;
                Template::Polygon { diameter: length(&numbers[0])?, vertices, rotation, hole }
            }
            _ => {
                let (width, height) = (length(&numbers[0])?, length(&numbers[1])?);
                let hole = hole(&numbers[2..])?;
                if name == b'R' {
                    Template::Rectangle { width, height, hole }
                } else {
                    Template::Obround { width, height, hole }
                }
            }
        })
    }

    /// `AMDONUT*1,1,$1,0,0*1,0,$2,0,0*%`: the name is this block, the statements are those up to
    /// the `%`.
    pub(super) fn define_macro(&mut self, block: Block<'a>) -> Result<(), Error> {
        let name = block.text[2..].trim_ascii();
        let mut body = Vec::new();
        while !self.lexer.percent_follows() {
            let mut ahead = self.lexer.clone();
            let Some(statement) = ahead.next().filter(|statement| statement.end != End::File) else {
                let place = block.place();
                let what = format!("the file ends within the aperture macro `{}`", printable(name));
                return Err(self.error(
                    place,
                    what,
                    "statements that end with `*`, and a `%` after the last",
                    "",
                ));
            };
            let starts = statement.text.first();
            if !starts.is_some_and(|b| b.is_ascii_digit() || *b == b'$') {
                break; // the `%` is missing, and the next command begins
            }
            self.lexer = ahead;
            body.push(statement);
        }
        if self.macros.insert(name, Macro { body }).is_some() {
            let message = format!("the aperture macro `{}` is defined twice", printable(name));
            self.warnings.add(&diagnostic::MACRO_DEFINED_TWICE, block.place(), message);
        }
        Ok(())
    }
}
