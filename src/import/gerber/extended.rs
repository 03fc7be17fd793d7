//! The commands between `%` (specification §4; the deprecated ones §8).

use std::borrow::Cow;
use std::ops::Range;

use crate::board::polarity::Polarity;
use crate::geometry::{Nm, Vector};

use super::super::error::{Error, printable};
use super::aperture::{Hole, Template};
use super::aperture_macro::{Macro, MacroFault, VERTICES};
use super::canvas::Frame;
use super::lex::{Block, End, Number, is_blank};
use super::reader::{Aperture, Reader};
use super::state::{Format, Linear, Unit, Zeros};

/// The largest factor of LS and SF. Chosen: it keeps products far from the ends of the integers.
const SCALE: f64 = 1e6;

/// A field of a command that has such letters: `A1.5B2`.
type Field = (u8, Number);

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
            b"AD" => self.define_aperture(rest, place),
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
            // Names, of the image and of what follows.
            b"IN" | b"LN" => Ok(()),
            b"IJ" | b"IO" | b"PF" | b"RO" => {
                let code = printable(code);
                let message = format!("%{code} was never used by tools and is not followed");
                self.warnings.add("unknown-command", place, message);
                Ok(())
            }
            b"KO" => Err(self.error(place, "%KO, knockout, is not handled", "%LPC and %LPD", "")),
            b"IF" => {
                let hint = "put the content of the other file in its place";
                Err(self.error(
                    place,
                    "%IF includes another file, which is not followed",
                    "a file by itself",
                    hint,
                ))
            }
            _ => {
                let shown = printable(&block.text[..block.text.len().min(20)]);
                let message = format!("`{shown}` is no command that is known; it is left out");
                self.warnings.add("unknown-command", place, message);
                Ok(())
            }
        }
    }

    /// The number format. Where none has been given yet, the file is searched for one that comes late.
    pub(super) fn format(&mut self, place: &Range<usize>) -> Result<Format, Error> {
        if let Some(format) = self.format {
            return Ok(format);
        }
        let mut ahead = self.lexer.clone();
        let found = std::iter::from_fn(|| ahead.next()).find(|block| block.text.starts_with(b"FS"));
        if let Some(block) = found {
            self.warnings.add(
                "late-format",
                block.place(),
                "the number format comes after the first coordinate",
            );
            self.format_statement(one_line(&block.text[2..]).as_ref(), block.place())?;
        }
        let bare = self.apertures.is_empty();
        self.format.ok_or_else(|| {
            let (what, expected) = if bare {
                let what = "this file (RS-274-D) says neither how its numbers are written nor what its apertures are";
                (what, "a number format, `%FSLAX46Y46*%`, and apertures, `%ADD10C,0.25*%`, before the first coordinate")
            } else {
                let what = "this file does not say how its numbers are written";
                (what, "a number format, such as `%FSLAX46Y46*%`, before the first coordinate")
            };
            self.error(place.clone(), what, expected, "have the file written as RS-274X")
        })
    }

    /// The unit. Where none has been given yet, the file is searched for one that comes late.
    pub(super) fn unit(&mut self, place: &Range<usize>) -> Result<Unit, Error> {
        if let Some(unit) = self.unit {
            return Ok(unit);
        }
        let mut ahead = self.lexer.clone();
        let found = std::iter::from_fn(|| ahead.next()).find_map(|block| match block.text {
            [b'M', b'O', b'I', ..] | [b'G', b'7', b'0', ..] => Some((Unit::Inch, block)),
            [b'M', b'O', b'M', ..] | [b'G', b'7', b'1', ..] => Some((Unit::Millimetre, block)),
            _ => None,
        });
        let unit = if let Some((unit, block)) = found {
            let message = format!(
                "the unit, {}, comes after the first length; it holds for the whole file",
                unit.name()
            );
            self.warnings.add("late-units", block.place(), message);
            unit
        } else {
            // Four digits before the point are ten metres in millimetres and 250 m in inches.
            let unit = if self.format(place)?.x.0 >= 4 { Unit::Millimetre } else { Unit::Inch };
            let message = format!(
                "the file does not say its unit; {} is assumed, as its number format suggests",
                unit.name()
            );
            self.warnings.add("missing-units", place.clone(), message);
            unit
        };
        self.unit = Some(unit);
        Ok(unit)
    }

    /// `FSLAX46Y46`
    fn format_statement(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        let mut format = Format { zeros: Zeros::Leading, incremental: false, x: (0, 0), y: (0, 0) };
        let mut at = 0;
        while let Some(&letter) = text.get(at) {
            at += 1;
            let digit = |at: usize| text.get(at).filter(|b| b.is_ascii_digit()).map(|b| u32::from(b - b'0'));
            match letter.to_ascii_uppercase() {
                // `D` of old: no zeros are left out, so either way of reading is right.
                b'L' | b'D' if digit(at).is_none() => format.zeros = Zeros::Leading,
                b'T' => format.zeros = Zeros::Trailing,
                b'A' => format.incremental = false,
                b'I' => format.incremental = true,
                axis @ (b'X' | b'Y') => {
                    let (Some(whole), Some(decimals)) = (digit(at), digit(at + 1)) else {
                        return Err(self.bad_format(place));
                    };
                    at += 2;
                    *(if axis == b'X' { &mut format.x } else { &mut format.y }) = (whole, decimals);
                }
                // Lengths of sequence numbers and codes, which nothing depends on.
                b'N' | b'G' | b'D' | b'M' | b'Z' if digit(at).is_some() => {
                    at += text[at..].iter().take_while(|b| b.is_ascii_digit()).count();
                }
                byte if is_blank(byte) => {}
                _ => return Err(self.bad_format(place)),
            }
        }
        match (format.x, format.y) {
            ((0, 0), (0, 0)) => return Err(self.bad_format(place)),
            ((0, 0), y) => format.x = y,
            (x, (0, 0)) => format.y = x,
            _ => {}
        }
        if self.format.is_some_and(|before| before != format) {
            let message =
                "the number format changes within the file; coordinates after it are read the new way";
            self.warnings.add("format-changes", place, message);
        }
        self.format = Some(format);
        Ok(())
    }

    fn bad_format(&self, place: Range<usize>) -> Error {
        self.error(place, "this number format cannot be read", "a format such as `FSLAX46Y46`", "")
    }

    /// `MOMM` or `MOIN`
    fn unit_statement(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        let unit = match text.trim_ascii() {
            b"MM" => Unit::Millimetre,
            b"IN" => Unit::Inch,
            _ => return Err(self.error(place, "this unit is not known", "`%MOMM*%` or `%MOIN*%`", "")),
        };
        if self.unit_by_mode && self.unit != Some(unit) {
            let hint = "find out which of the two the file means, and delete the other";
            return Err(self.error(
                place,
                "the file gives two units that contradict each other",
                "one %MO",
                hint,
            ));
        }
        if self.unit.is_some_and(|before| before != unit) {
            let message = "%MO contradicts G70 or G71 before it; %MO is followed";
            self.warnings.add("conflicting-units", place, message);
        }
        (self.unit, self.unit_by_mode) = (Some(unit), true);
        Ok(())
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
            self.warnings.add("aperture-defined-twice", place, message);
        }
        self.forget_aperture(number);
        Ok(())
    }

    fn template(&mut self, name: &[u8], parameters: &[u8], place: &Range<usize>) -> Result<Template, Error> {
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
                let message = "a hole of an aperture is less than nothing; the aperture has none";
                self.warnings.add("negative-hole", place.clone(), message);
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

    fn standard(
        &self,
        name: u8,
        numbers: &[Number],
        unit: Unit,
        place: &Range<usize>,
    ) -> Result<Template, Error> {
        let (least, expected) = match name {
            b'C' => (1, "a diameter, and perhaps that of a hole: `C,1.5X0.8`"),
            b'P' => (2, "a diameter, a number of vertices, and perhaps a rotation and a hole: `P,1.5X6X30`"),
            _ => (2, "a width and a height, and perhaps the diameter of a hole: `R,1.5X0.6`"),
        };
        let fault = |what: &str| self.error(place.clone(), what, expected, "");
        if numbers.len() < least {
            return Err(fault("this aperture has too few parameters"));
        }
        let length = |number: &Number| {
            let length = unit.length(*number).filter(|length| *length >= Nm::ZERO);
            length.ok_or_else(|| fault("this is not a size of an aperture: below zero, or above a metre"))
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

    /// `AMDONUT*1,1,$1,0,0*1,0,$2,0,0*%`: the name is this block, the statements are those up to the `%`.
    fn define_macro(&mut self, block: Block<'a>) -> Result<(), Error> {
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
            self.warnings.add("macro-defined-twice", block.place(), message);
        }
        Ok(())
    }

    /// `ABD12` opens a block aperture, `AB` closes it.
    fn block_aperture(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        if text.iter().all(|&b| is_blank(b)) {
            let (number, objects) = self.canvas.close_block().ok_or_else(|| {
                self.error(place, "this closes a block that is not open", "`%ABD12*%` before it", "")
            })?;
            self.apertures.insert(number, Aperture::new(Template::Block(objects), None));
            self.forget_aperture(number);
            return Ok(());
        }
        let number = text.strip_prefix(b"D").and_then(Number::whole).and_then(Number::to_integer);
        let number = number.and_then(|n| u32::try_from(n).ok()).filter(|n| *n >= 10);
        let number = number.ok_or_else(|| {
            self.error(place.clone(), "this block has no number", "an aperture number, as in `%ABD12*%`", "")
        })?;
        self.canvas.open(Frame::Block(number)).map_err(|refusal| self.refused(place, &refusal))
    }

    /// `SRX2Y3I4.0J3.0` opens a repeat, `SR` closes it, and so does the next one.
    fn repeat(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        self.canvas.close_repeat().map_err(|refusal| self.refused(place.clone(), &refusal))?;
        let fields = self.fields(text, &place)?;
        let field = |letter: u8| fields.iter().find(|(l, _)| *l == letter).map(|(_, number)| *number);
        let copies = |letter: u8| match field(letter) {
            None => Some(1),
            Some(number) => number.to_integer().and_then(|n| u32::try_from(n).ok()).filter(|n| *n >= 1),
        };
        let (Some(x), Some(y)) = (copies(b'X'), copies(b'Y')) else {
            let expected = "how many copies there are in x and y, as in `%SRX2Y3I4.0J3.0*%`";
            return Err(self.error(place, "this is not a number of copies", expected, ""));
        };
        if (x, y) == (1, 1) {
            return Ok(());
        }
        let step = Vector::new(self.optional(field(b'I'), &place)?, self.optional(field(b'J'), &place)?);
        let frame = Frame::Repeat { copies: (x, y), step };
        self.canvas.open(frame).map_err(|refusal| self.refused(place, &refusal))
    }

    /// A length, zero where it is left out.
    fn optional(&mut self, number: Option<Number>, place: &Range<usize>) -> Result<Nm, Error> {
        let Some(number) = number else { return Ok(Nm::ZERO) };
        let unit = self.unit(place)?;
        unit.length(number).ok_or_else(|| {
            self.error(place.clone(), "this length lies beyond what is handled", "at most 1073.741823 mm", "")
        })
    }

    /// Letters, each with a number.
    fn fields(&self, text: &[u8], place: &Range<usize>) -> Result<Vec<Field>, Error> {
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

    fn load_polarity(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        self.polarity = match text.trim_ascii() {
            b"D" => Polarity::Dark,
            b"C" => Polarity::Clear,
            _ => return Err(self.error(place, "this polarity is not known", "`%LPD*%` or `%LPC*%`", "")),
        };
        Ok(())
    }

    fn load_transformation(&mut self, code: &[u8], text: &[u8], place: Range<usize>) -> Result<(), Error> {
        let text = text.trim_ascii();
        if code == b"LM" {
            self.mirror = match text {
                b"N" => (false, false),
                b"X" => (true, false),
                b"Y" => (false, true),
                b"XY" => (true, true),
                _ => {
                    return Err(self.error(
                        place,
                        "this mirroring is not known",
                        "`LMN`, `LMX`, `LMY` or `LMXY`",
                        "",
                    ));
                }
            };
        } else {
            let number = Number::whole(text).map(Number::to_f64);
            let valid = number.filter(|n| code == b"LR" || (*n > 0.0 && *n <= SCALE));
            let value = valid.ok_or_else(|| {
                let expected = "degrees, as in `%LR45*%`, or a factor above zero, as in `%LS0.8*%`";
                self.error(place, "this transformation cannot be read", expected, "")
            })?;
            *(if code == b"LR" { &mut self.rotation } else { &mut self.scale }) = value;
        }
        self.forget_form();
        Ok(())
    }

    fn image_polarity(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        self.negative = match text.trim_ascii() {
            b"POS" => false,
            b"NEG" => true,
            _ => {
                return Err(self.error(
                    place,
                    "this image polarity is not known",
                    "`%IPPOS*%` or `%IPNEG*%`",
                    "",
                ));
            }
        };
        Ok(())
    }

    /// The deprecated commands that move the image.
    fn place_statement(&mut self, code: &[u8], text: &[u8], place: Range<usize>) -> Result<(), Error> {
        let text = text.trim_ascii();
        match code {
            b"AS" => {
                self.placement.swap = match text {
                    b"AXBY" => false,
                    b"AYBX" => true,
                    _ => {
                        return Err(self.error(
                            place,
                            "these axes are not known",
                            "`ASAXBY` or `ASAYBX`",
                            "",
                        ));
                    }
                };
            }
            b"IR" => {
                let degrees = Number::whole(text).and_then(Number::to_integer);
                let quarter = degrees.filter(|degrees| [0, 90, 180, 270].contains(degrees));
                let quarter = quarter.and_then(|degrees| i16::try_from(degrees).ok());
                let quarter = quarter.ok_or_else(|| {
                    self.error(
                        place.clone(),
                        "this rotation is not known",
                        "`IR0`, `IR90`, `IR180` or `IR270`",
                        "",
                    )
                })?;
                self.placement.rotation = Linear::rotation(f64::from(quarter));
                self.forget_form();
            }
            _ => {
                let fields = self.fields(text, &place)?;
                let field = |letter: u8| fields.iter().find(|(l, _)| *l == letter).map(|(_, number)| *number);
                let (a, b) = (field(b'A'), field(b'B'));
                match code {
                    b"OF" => {
                        let offset = Vector::new(self.optional(a, &place)?, self.optional(b, &place)?);
                        self.placement.offset = offset;
                    }
                    b"MI" => {
                        let set = |field: Option<Number>| field.is_some_and(|n| n.mantissa != 0);
                        self.placement.mirror = (set(a), set(b));
                    }
                    _ => {
                        let factor = |field: Option<Number>| field.map_or(1.0, Number::to_f64);
                        let (x, y) = (factor(a), factor(b));
                        if !(x > 0.0 && y > 0.0 && x <= SCALE && y <= SCALE) {
                            let expected = "factors above zero, as in `SFA1.0B1.0`";
                            return Err(self.error(place, "this scale cannot be used", expected, ""));
                        }
                        self.placement.scale = (x, y);
                    }
                }
            }
        }
        self.placement.update();
        Ok(())
    }
}

/// The text without line ends, which may stand anywhere in a command.
fn one_line(text: &[u8]) -> Cow<'_, [u8]> {
    let is_end = |b: &u8| matches!(b, b'\r' | b'\n' | 0);
    if text.iter().any(is_end) {
        Cow::Owned(text.iter().copied().filter(|b| !is_end(b)).collect())
    } else {
        Cow::Borrowed(text)
    }
}
