//! How numbers are written: format and unit (FS, MO; specification §4.2), also where they come late
//! or never.

use std::ops::Range;

use super::super::error::Error;
use super::extended::one_line;
use super::lex::is_blank;
use super::reader::Reader;
use super::state::{Format, Unit, Zeros};
use crate::geometry::Nm;
use crate::import::diagnostic;

impl<'a> Reader<'a> {
    /// The number format. Where none has been given yet, the file is searched for one that comes
    /// late.
    pub(super) fn format(&mut self, place: &Range<usize>) -> Result<Format, Error> {
        if let Some(format) = self.format {
            return Ok(format);
        }
        let mut ahead = self.lexer.clone();
        let found = std::iter::from_fn(|| ahead.next()).find(|block| block.text.starts_with(b"FS"));
        if let Some(block) = found {
            self.warnings.add(
                &diagnostic::LATE_FORMAT,
                block.place(),
                "the number format comes after the first coordinate",
            );
            self.format_statement(one_line(&block.text[2..]).as_ref(), block.place())?;
        }
        if self.format.is_none()
            && let Some(format) = self.list.and_then(|list| list.format)
        {
            self.format = Some(format);
        }
        let bare = self.apertures.is_empty();
        self.format.ok_or_else(|| {
            if let Some(list) = self.list {
                let what = format!("neither this file nor its aperture list {} has a number format", list.file);
                let expected = "a number format: `%FSLAX23Y23*%` as the first line here, or `FORMAT 2.3` in the list";
                let hint = "the plot settings of the CAD program show the format";
                return self.error(place.clone(), what, expected, hint);
            }
            let (what, expected) = if bare {
                let what = "this file (RS-274-D) has neither a number format nor aperture definitions";
                (what, "a number format, `%FSLAX46Y46*%`, and apertures, `%ADD10C,0.25*%`, before the first coordinate, \
                     or an aperture list (.apt, .gap, .rep) beside the file")
            } else {
                let what = "this file has no number format";
                (what, "a number format, such as `%FSLAX46Y46*%`, before the first coordinate")
            };
            self.error(place.clone(), what, expected, "export the file as RS-274X")
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
            self.warnings.add(&diagnostic::LATE_UNITS, block.place(), message);
            unit
        } else if let Some(list) = self.list {
            list.unit
        } else {
            // Four digits before the point are ten metres in millimetres and 250 m in inches.
            let usual = if self.format(place)?.x.0 >= 4 { Unit::Millimetre } else { Unit::Inch };
            let unit = self.reading.unit.unwrap_or(usual);
            self.unit_guessed = true;
            let reason = if unit == usual {
                "as its number format suggests"
            } else {
                "because in inches it would be wider than any board"
            };
            let message = format!("the file does not declare its unit; {} is assumed, {reason}", unit.name());
            self.warnings.add(&diagnostic::MISSING_UNITS, place.clone(), message);
            unit
        };
        self.unit = Some(unit);
        Ok(unit)
    }

    /// Whether what is drawn so far, its unit a guess, is wider than a board in inches, or lies
    /// beyond what is handled: then it is in millimetres.
    pub(super) fn is_too_wide(&self) -> bool {
        /// Chosen: the largest panels are 610 mm long.
        const WIDEST: Nm = Nm::from_mm(620);
        let extent = self.canvas.bounds().map_or(Nm::ZERO, |bounds| bounds.width().max(bounds.height()));
        self.unit_guessed && self.unit == Some(Unit::Inch) && (extent > WIDEST || self.is_beyond)
    }

    /// `FSLAX46Y46`
    pub(super) fn format_statement(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
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
                "the number format changes within the file; coordinates after it are read with the new one";
            self.warnings.add(&diagnostic::FORMAT_CHANGES, place, message);
        }
        self.format = Some(format);
        Ok(())
    }

    pub(super) fn bad_format(&self, place: Range<usize>) -> Error {
        self.error(place, "this number format cannot be read", "a format such as `FSLAX46Y46`", "")
    }

    /// `MOMM` or `MOIN`
    pub(super) fn unit_statement(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        let unit = match text.trim_ascii() {
            b"MM" => Unit::Millimetre,
            b"IN" => Unit::Inch,
            _ => return Err(self.error(place, "this unit is unknown", "`%MOMM*%` or `%MOIN*%`", "")),
        };
        if self.unit_by_mode && self.unit != Some(unit) {
            let hint = "find out which of the two is right, and delete the other";
            return Err(self.error(place, "the file declares two different units", "one %MO", hint));
        }
        if self.unit.is_some_and(|before| before != unit) {
            let message = "%MO contradicts G70 or G71 before it; %MO is used";
            self.warnings.add(&diagnostic::CONFLICTING_UNITS, place, message);
        }
        (self.unit, self.unit_by_mode) = (Some(unit), true);
        Ok(())
    }
}
