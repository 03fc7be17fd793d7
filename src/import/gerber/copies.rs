//! Blocks and repeats (AB, SR; specification §4.11 and §4.12).

use std::ops::Range;

use crate::geometry::Vector;

use super::super::error::Error;
use super::aperture::Template;
use super::canvas::Frame;
use super::lex::{Number, is_blank};
use super::reader::{Aperture, Reader};

impl<'a> Reader<'a> {
    /// `ABD12` opens a block aperture, `AB` closes it.
    pub(super) fn block_aperture(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
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
    pub(super) fn repeat(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        self.canvas.close_repeat().map_err(|refusal| self.refused(place.clone(), &refusal))?;
        let fields = self.fields(text, &place)?;
        let field = |letter: u8| fields.iter().find(|(l, _)| *l == letter).map(|(_, number)| *number);
        let copies = |letter: u8| match field(letter) {
            None => Some(1),
            Some(number) => number.to_integer().and_then(|n| u32::try_from(n).ok()).filter(|n| *n >= 1),
        };
        let (Some(x), Some(y)) = (copies(b'X'), copies(b'Y')) else {
            let expected = "numbers of copies in x and y, as in `%SRX2Y3I4.0J3.0*%`";
            return Err(self.error(place, "this is not a number of copies", expected, ""));
        };
        if (x, y) == (1, 1) {
            return Ok(());
        }
        let step = Vector::new(self.optional(field(b'I'), &place)?, self.optional(field(b'J'), &place)?);
        let frame = Frame::Repeat { copies: (x, y), step };
        self.canvas.open(frame).map_err(|refusal| self.refused(place, &refusal))
    }
}
