//! Aperture definitions (AD; specification §4.3 and §4.4).

use crate::geometry::Nm;
use crate::import::diagnostic;
use crate::import::error::printable;

use super::aperture::{Hole, Template};
use super::aperture_macro::VERTICES;
use super::fault::{Fault, Here};
use super::format::Unit;
use super::lex::{Number, is_blank};

/// `ADD10C,0.25` as it is written.
#[derive(Debug)]
pub(super) struct Definition {
    pub(super) number: u32,
    /// C, R, O, P or a macro.
    pub(super) name: Vec<u8>,
    pub(super) parameters: Vec<Number>,
}

/// The number of an aperture, `D10`, which `text` begins with, and how many bytes it takes.
fn numbered(text: &[u8]) -> Option<(Number, usize)> {
    let text = text.strip_prefix(b"D")?;
    // Behind it a name follows, which may begin with a point.
    let end = text.iter().position(|&b| !b.is_ascii_digit() && !is_blank(b)).unwrap_or(text.len());
    let (number, length) = Number::read(&text[..end])?;
    Some((number, 1 + length))
}

impl Definition {
    /// Reads `D10C,0.25`; of one that cannot be read, its number where that can.
    pub(super) fn read(text: &[u8]) -> Result<Self, (Option<u32>, Fault)> {
        let number = numbered(text).and_then(|(number, _)| u32::try_from(number.to_integer()?).ok());
        Self::read_all(text).map_err(|fault| (number, fault))
    }

    fn read_all(text: &[u8]) -> Result<Self, Fault> {
        let expected = "an aperture definition, such as `%ADD10C,0.25*%`";
        let (number, length) =
            numbered(text).ok_or_else(|| Fault::new("this aperture has no number", expected))?;
        let number =
            aperture_number(number).ok_or_else(|| Fault::new("aperture numbers begin at D10", expected))?;
        let text = &text[length..];
        let (name, fields) = match text.iter().position(|&b| b == b',') {
            Some(comma) => (&text[..comma], &text[comma + 1..]),
            None => (text, &text[text.len()..]),
        };
        let fields = fields.split(|b| matches!(b, b'X' | b'x'));
        let parameters = fields.filter(|field| !field.iter().all(|&b| is_blank(b))).map(|field| {
            Number::whole(field).ok_or_else(|| {
                let what = format!("`{}` is not a number", printable(field));
                Fault::new(what, "decimal numbers with `X` between them, as in `R,1.5X0.6`")
            })
        });
        Ok(Self {
            number,
            name: name.trim_ascii().to_vec(),
            parameters: parameters.collect::<Result<_, _>>()?,
        })
    }

    /// The standard aperture C, R, O or P that it defines; none where it uses a macro.
    pub(super) fn standard(&self, unit: Unit, here: &mut Here<'_, '_>) -> Result<Option<Template>, Fault> {
        let (name, numbers) = (self.name.as_slice(), self.parameters.as_slice());
        let (least, expected) = match name {
            b"C" => (1, "a diameter, and optionally that of a hole: `C,1.5X0.8`"),
            b"P" => {
                (2, "a diameter, a number of vertices, and optionally a rotation and a hole: `P,1.5X6X30`")
            }
            b"R" | b"O" => (2, "a width and a height, and optionally the diameter of a hole: `R,1.5X0.6`"),
            _ => return Ok(None),
        };
        if name != b"P" && numbers.iter().skip(least).any(|n| n.mantissa < 0) {
            let message = "the hole of an aperture has a negative size; the hole is ignored";
            here.warn(&diagnostic::NEGATIVE_HOLE, message);
        }
        let fault = |what: &str| Fault::new(what, expected);
        if numbers.len() < least {
            return Err(fault("this aperture has too few parameters"));
        }
        let length = |number: &Number| {
            let length = unit.length(*number).filter(|length| *length >= Nm::ZERO);
            length.ok_or_else(|| fault("this is not an aperture size: negative, or above one metre"))
        };
        let hole = |rest: &[Number]| -> Result<Hole, Fault> {
            Ok(match rest {
                [] => Hole::None,
                [width, ..] if width.mantissa <= 0 => Hole::None,
                [diameter] => Hole::Round(length(diameter)?),
                [width, height, ..] => Hole::Rectangular(length(width)?, length(height)?),
            })
        };
        Ok(Some(match name {
            b"C" => Template::Circle { diameter: length(&numbers[0])?, hole: hole(&numbers[1..])? },
            b"P" => {
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
                if name == b"R" {
                    Template::Rectangle { width, height, hole }
                } else {
                    Template::Obround { width, height, hole }
                }
            }
        }))
    }
}

/// The number of an aperture: those below 10 are operations.
pub(super) fn aperture_number(number: Number) -> Option<u32> {
    u32::try_from(number.to_integer()?).ok().filter(|n| *n >= 10)
}
