//! Polarity and transformations of what follows, and of the whole image (LP, LM, LR, LS; of old IP,
//! AS, IR, MI, OF, SF).

use std::ops::Range;

use crate::board::polarity::Polarity;
use crate::geometry::Vector;

use super::super::error::Error;
use super::lex::Number;
use super::reader::Reader;
use super::state::Linear;

/// The largest factor of LS and SF. Chosen: it keeps products far from the ends of the integers.
const SCALE: f64 = 1e6;

impl<'a> Reader<'a> {
    pub(super) fn load_polarity(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        self.polarity = match text.trim_ascii() {
            b"D" => Polarity::Dark,
            b"C" => Polarity::Clear,
            _ => return Err(self.error(place, "this polarity is unknown", "`%LPD*%` or `%LPC*%`", "")),
        };
        Ok(())
    }

    pub(super) fn load_transformation(
        &mut self,
        code: &[u8],
        text: &[u8],
        place: Range<usize>,
    ) -> Result<(), Error> {
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
                        "this mirroring is unknown",
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

    pub(super) fn image_polarity(&mut self, text: &[u8], place: Range<usize>) -> Result<(), Error> {
        self.negative = match text.trim_ascii() {
            b"POS" => None,
            b"NEG" => Some(place),
            _ => {
                return Err(self.error(
                    place,
                    "this image polarity is unknown",
                    "`%IPPOS*%` or `%IPNEG*%`",
                    "",
                ));
            }
        };
        Ok(())
    }

    /// The deprecated commands that move the image.
    pub(super) fn place_statement(
        &mut self,
        code: &[u8],
        text: &[u8],
        place: Range<usize>,
    ) -> Result<(), Error> {
        let text = text.trim_ascii();
        match code {
            b"AS" => {
                self.placement.swap = match text {
                    b"AXBY" => false,
                    b"AYBX" => true,
                    _ => {
                        return Err(self.error(place, "these axes are unknown", "`ASAXBY` or `ASAYBX`", ""));
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
                        "this rotation is unknown",
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
