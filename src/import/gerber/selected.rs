//! The aperture in use, and the form it takes under the transformation in force.

use std::ops::Range;
use std::rc::Rc;

use crate::geometry::Nm;
use crate::import::diagnostic;

use super::super::error::Error;
use super::aperture::Form;
use super::aperture_list::{ApertureList, Entry};
use super::canvas::Refusal;
use super::reader::{Aperture, Reader};
use super::state::Linear;

impl<'a> Reader<'a> {
    /// Takes the apertures of `list` for those of the file.
    pub(super) fn take_list(&mut self, list: &'a ApertureList) {
        self.list = Some(list);
        for (&number, entry) in &list.entries {
            if let Entry::Known(template) = entry {
                self.apertures.insert(number, Aperture::new(template.clone(), None));
            }
        }
        if let Some(unit) = list.guessed {
            let message = format!(
                "the aperture list {} does not declare its unit; its sizes are read as {unit}",
                list.file
            );
            self.warnings.add(&diagnostic::APERTURE_UNITS_GUESSED, 0..0, message);
        }
    }

    /// The aperture in use, which must be defined.
    pub(super) fn selected(&mut self, place: &Range<usize>) -> Result<u32, Error> {
        match self.aperture {
            Some(number) if self.apertures.contains_key(&number) => Ok(number),
            Some(number) if self.list.is_some() => Err(self.not_in_list(number, place)),
            _ if self.apertures.is_empty() => Err(self.error(
                place.clone(),
                "this file draws with apertures that it does not define (RS-274-D)",
                "aperture definitions, such as `%ADD10C,0.25*%`, or an aperture list (.apt, .gap, .rep) beside the file",
                "export the file as RS-274X, with embedded apertures",
            )),
            Some(number) => Err(self.error(
                place.clone(),
                format!("this draws with aperture D{number}, which is not defined"),
                format!("`%ADD{number}…*%` before it"),
                "",
            )),
            None => Err(self.error(
                place.clone(),
                "this draws without an aperture",
                "an aperture, such as `D10*`, before it",
                "",
            )),
        }
    }

    /// The error for an aperture that the list beside the file does not have, or leaves unclear.
    pub(super) fn not_in_list(&self, number: u32, place: &Range<usize>) -> Error {
        let file = self.list.map_or("", |list| &list.file);
        let (what, expected) = match self.list.and_then(|list| list.entries.get(&number)) {
            Some(Entry::Unclear { line, reason }) => {
                let what = format!(
                    "this draws with aperture D{number}, which {file}:{line} does not define clearly: {reason}"
                );
                (what, "a shape with its sizes in the list")
            }
            _ => {
                let what = format!(
                    "this draws with aperture D{number}, which the aperture list {file} does not have"
                );
                (what, "the list that belongs to this file")
            }
        };
        self.error(place.clone(), what, expected, "export the file as RS-274X, with embedded apertures")
    }

    /// The transformation of apertures in force: mirrored, then rotated, then scaled (specification
    /// §4.9).
    pub(super) fn linear(&self) -> Linear {
        let sign = |mirror: bool| if mirror { -1.0 } else { 1.0 };
        let mirror = Linear::stretch(sign(self.mirror.0), sign(self.mirror.1));
        let scale = Linear::stretch(self.scale, self.scale);
        self.placement.rotation.after(scale).after(Linear::rotation(self.rotation)).after(mirror)
    }

    /// To be called when an aperture or the transformation changed.
    pub(super) fn forget_form(&mut self) {
        self.form = None;
    }

    /// To be called when aperture `number` is defined anew.
    pub(super) fn forget_aperture(&mut self, number: u32) {
        self.forms.retain(|(of, _), _| *of != number);
        (self.form, self.set) = (None, None);
    }

    /// To be called when attributes changed.
    pub(super) fn forget_set(&mut self) {
        self.set = None;
    }

    pub(super) fn form(&mut self, number: u32, place: &Range<usize>) -> Result<Rc<Form>, Error> {
        if let Some(form) = &self.form {
            return Ok(Rc::clone(form));
        }
        let linear = self.linear();
        let key = (number, linear.bits());
        let form = match self.forms.get(&key) {
            Some(form) => Rc::clone(form),
            None => Rc::new(self.make_form(number, linear, place)?),
        };
        self.forms.insert(key, Rc::clone(&form));
        self.form = Some(Rc::clone(&form));
        Ok(form)
    }

    pub(super) fn make_form(
        &mut self,
        number: u32,
        linear: Linear,
        place: &Range<usize>,
    ) -> Result<Form, Error> {
        let template = Rc::clone(&self.apertures.get(&number).expect("selected").template);
        if template.reach() * linear.scale() > Nm::MAX.to_f64() {
            return Err(self.refused(place.clone(), &Refusal::Range));
        }
        if template.is_tangled() {
            return Err(self.refused(place.clone(), &Refusal::Tangled));
        }
        let charged = self.canvas.charge(template.vertex_count(linear));
        let charged = charged.and_then(|()| self.canvas.charge(template.effort(linear)));
        charged.map_err(|refusal| self.refused(place.clone(), &refusal))?;
        template.form(linear).ok_or_else(|| {
            let what = format!("D{number} is a block, which cannot be drawn along a line");
            self.error(place.clone(), what, "a flash, D03", "")
        })
    }

    /// The attribute set of what is drawn now.
    pub(super) fn set(&mut self) -> u32 {
        if let Some(set) = self.set {
            return set;
        }
        let of_region = self.attributes.aperture.clone();
        let function = match (&self.region, self.aperture.and_then(|number| self.apertures.get(&number))) {
            (Some(_), _) => of_region,
            (None, aperture) => aperture.and_then(|aperture| aperture.function.clone()),
        };
        let set = self.attributes.set(function.as_deref());
        self.set = Some(set);
        set
    }
}
