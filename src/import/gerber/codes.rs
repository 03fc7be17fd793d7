//! What D, G and M codes do (specification §4.2 to §4.13; those of old §8).

use std::ops::Range;

use crate::geometry::Turn;
use crate::import::diagnostic;

use super::super::error::Error;
use super::lex::Number;
use super::quadrants::Quadrants;
use super::reader::{Interpolation, Operation, Reader};
use super::region::Region;
use super::state::{Format, Unit};

impl<'a> Reader<'a> {
    pub(super) fn d_code(
        &mut self,
        number: Number,
        place: &Range<usize>,
    ) -> Result<Option<Operation>, Error> {
        match number.to_integer() {
            Some(1) => Ok(Some(Operation::Draw)),
            Some(2) => Ok(Some(Operation::Move)),
            Some(3) => Ok(Some(Operation::Flash)),
            Some(code @ 10..=0x7fff_ffff) => {
                self.aperture = u32::try_from(code).ok();
                (self.form, self.set) = (None, None);
                if self.aperture.is_none_or(|number| !self.apertures.contains_key(&number)) {
                    if let Some(error) = self.aperture.and_then(|number| self.malformed(number)) {
                        return Err(error);
                    }
                    let message = format!("aperture D{code} is selected, but not defined");
                    self.warnings.add(&diagnostic::UNDEFINED_APERTURE, place.clone(), message);
                }
                Ok(None)
            }
            _ => Err(self.error(
                place.clone(),
                "this is neither an operation nor an aperture",
                "D01 to draw, D02 to move, D03 to flash, or an aperture from D10 on",
                "",
            )),
        }
    }

    pub(super) fn g_code(&mut self, number: Number, place: &Range<usize>) -> Result<(), Error> {
        match number.to_integer() {
            // G54 selects an aperture and G55 announces a flash: the D code says as much. G00 moves
            // as D02 does.
            Some(0 | 54 | 55) => {}
            Some(1) => self.interpolation = Interpolation::Linear,
            Some(2) => self.interpolation = Interpolation::Circular(Turn::Clockwise),
            Some(3) => self.interpolation = Interpolation::Circular(Turn::CounterClockwise),
            Some(36) => {
                self.end_contour()?;
                self.region = Some(Region::default());
                self.set = None;
            }
            Some(37) => {
                self.end_contour()?;
                self.region = None;
                self.set = None;
            }
            Some(70) => self.old_unit(Unit::Inch, place),
            Some(71) => self.old_unit(Unit::Millimetre, place),
            Some(74) => self.quadrants = Some(Quadrants::Single),
            Some(75) => self.quadrants = Some(Quadrants::Multi),
            Some(mode @ (90 | 91)) => {
                let format = self.format(place)?;
                self.format = Some(Format { incremental: mode == 91, ..format });
            }
            Some(code @ 10..=12) => {
                return Err(self.error(
                    place.clone(),
                    format!("G{code}, scaled interpolation, is not supported"),
                    "G01, G02 or G03",
                    "export the file again as RS-274X",
                ));
            }
            _ => {
                let message = "this G code is unknown; it is ignored";
                self.warnings.add(&diagnostic::UNKNOWN_COMMAND, place.clone(), message);
            }
        }
        Ok(())
    }

    /// G70 and G71, which MO overrides.
    pub(super) fn old_unit(&mut self, unit: Unit, place: &Range<usize>) {
        if !self.unit_by_mode {
            self.unit = Some(unit);
        } else if self.unit != Some(unit) {
            let message = "G70 or G71 contradicts %MO; %MO is used";
            self.warnings.add(&diagnostic::CONFLICTING_UNITS, place.clone(), message);
        }
    }

    pub(super) fn m_code(&mut self, number: Number, place: &Range<usize>) {
        match number.to_integer() {
            Some(0 | 2) => self.ended = true,
            Some(1) => {}
            _ => self.warnings.add(
                &diagnostic::UNKNOWN_COMMAND,
                place.clone(),
                "this M code is unknown; it is ignored",
            ),
        }
    }
}
