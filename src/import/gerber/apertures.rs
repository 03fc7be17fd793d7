//! The apertures that are defined, the one in use, and the form it takes under the transformation
//! in force.

use std::ops::Range;
use std::rc::Rc;
use std::sync::Arc as Shared;

use rustc_hash::FxHashMap;

use crate::board::ApertureUse;
use crate::geometry::Nm;
use crate::import::diagnostic;
use crate::import::error::printable;

use super::aperture::{Form, Template};
use super::aperture_list::{ApertureList, Entry};
use super::aperture_macro::Macro;
use super::canvas::{Canvas, Object, Refusal};
use super::definition::Definition;
use super::fault::{Fault, Here};
use super::format::Unit;
use super::linear::Linear;

/// An aperture and how it is used.
#[derive(Debug)]
struct Aperture {
    template: Rc<Template>,
    /// `.AperFunction` when it was defined.
    function: Option<String>,
    flashes: u64,
    draws: u64,
}

impl Aperture {
    fn new(template: Template, function: Option<String>) -> Self {
        Self { template: Rc::new(template), function, flashes: 0, draws: 0 }
    }
}

/// An aperture definition that cannot be read: an error where it is selected.
#[derive(Debug)]
struct Malformed {
    /// Its number, where that can be read.
    number: Option<u32>,
    place: Range<usize>,
    fault: Fault,
}

/// The apertures of a file.
#[derive(Debug)]
pub(super) struct Apertures<'a> {
    /// The list beside an RS-274-D file.
    list: Option<&'a ApertureList>,
    defined: FxHashMap<u32, Aperture>,
    /// Definitions that cannot be read, and that nothing has selected.
    malformed: Vec<Malformed>,
    macros: FxHashMap<&'a [u8], Macro<'a>>,
    forms: FxHashMap<(u32, [u64; 4]), Rc<Form>>,
    /// The one in use, which may not be defined.
    selected: Option<u32>,
    /// Its form under the transformation in force; none after either changed.
    form: Option<Rc<Form>>,
}

impl<'a> Apertures<'a> {
    /// Those of `list`.
    pub(super) fn new(list: Option<&'a ApertureList>) -> Self {
        let known = list.iter().flat_map(|list| &list.entries).filter_map(|(&number, entry)| match entry {
            Entry::Known(template) => Some((number, Aperture::new(template.clone(), None))),
            Entry::Unclear { .. } => None,
        });
        Self {
            list,
            defined: known.collect(),
            malformed: Vec::new(),
            macros: FxHashMap::default(),
            forms: FxHashMap::default(),
            selected: None,
            form: None,
        }
    }

    pub(super) fn are_none(&self) -> bool {
        self.defined.is_empty()
    }

    /// AM.
    pub(super) fn define_macro(&mut self, definition: Macro<'a>, here: &mut Here<'_, '_>) {
        let name = definition.name;
        if self.macros.insert(name, definition).is_some() {
            let message = format!("the aperture macro `{}` is defined twice", printable(name));
            here.warn(&diagnostic::MACRO_DEFINED_TWICE, message);
        }
    }

    /// AD, with the unit in force and the `.AperFunction`; where that cannot be, what is wrong is
    /// kept until the aperture is selected.
    pub(super) fn define(
        &mut self,
        definition: &Definition,
        unit: Result<Unit, Fault>,
        function: Option<String>,
        here: &mut Here<'_, '_>,
    ) {
        let number = definition.number;
        match unit.and_then(|unit| self.template(definition, unit, here)) {
            Ok(template) => {
                // Fritzing defines one anew before anything is drawn with it.
                let before = self.put(number, Aperture::new(template, function));
                if before.is_some_and(|before| before.flashes + before.draws > 0) {
                    let message =
                        format!("aperture D{number} is defined twice; what follows uses the later one");
                    here.warn(&diagnostic::APERTURE_DEFINED_TWICE, message);
                }
            }
            Err(fault) => self.keep_malformed(Some(number), fault, here),
        }
    }

    fn template(
        &self,
        definition: &Definition,
        unit: Unit,
        here: &mut Here<'_, '_>,
    ) -> Result<Template, Fault> {
        if let Some(standard) = definition.standard(unit, here)? {
            return Ok(standard);
        }
        let name = printable(&definition.name);
        let macro_ = self.macros.get(definition.name.as_slice()).ok_or_else(|| {
            let what = format!("the aperture macro `{name}` is not defined");
            Fault::new(what, "C, R, O, P or a macro that %AM defines before it")
        })?;
        let parameters = definition.parameters.iter().map(|number| number.to_f64()).collect();
        Ok(Template::Macro { primitives: macro_.evaluate(parameters, unit)?, name })
    }

    /// Keeps what is wrong with a definition until its aperture is selected.
    pub(super) fn keep_malformed(&mut self, number: Option<u32>, fault: Fault, here: &Here<'_, '_>) {
        if let Some(number) = number {
            self.defined.remove(&number);
            self.forget(number);
        }
        let fault = fault.at(&here.place);
        self.malformed.push(Malformed { number, place: here.place.clone(), fault });
    }

    /// AB: the aperture that puts down `objects`.
    pub(super) fn define_block(&mut self, number: u32, objects: Shared<Vec<Object>>) {
        self.put(number, Aperture::new(Template::Block(objects), None));
    }

    /// Gives back the one that had this number.
    fn put(&mut self, number: u32, aperture: Aperture) -> Option<Aperture> {
        self.forget(number);
        self.defined.insert(number, aperture)
    }

    /// To be called when aperture `number` is defined anew.
    fn forget(&mut self, number: u32) {
        self.forms.retain(|(of, _), _| *of != number);
        self.form = None;
    }

    /// To be called when the transformation of apertures changed.
    pub(super) fn forget_form(&mut self) {
        self.form = None;
    }

    /// Dnn.
    pub(super) fn select(&mut self, number: u32, here: &mut Here<'_, '_>) -> Result<(), Fault> {
        (self.selected, self.form) = (Some(number), None);
        if !self.defined.contains_key(&number) {
            if let Some(malformed) = self.malformed.iter().rfind(|m| m.number == Some(number)) {
                return Err(malformed.fault.clone());
            }
            let message = format!("aperture D{number} is selected, but not defined");
            here.warn(&diagnostic::UNDEFINED_APERTURE, message);
        }
        Ok(())
    }

    /// The number of the aperture in use, which must be defined.
    pub(super) fn selected(&self) -> Result<u32, Fault> {
        const EXPORT: &str = "export the file as RS-274X, with embedded apertures";
        match (self.selected, self.list) {
            (Some(number), _) if self.defined.contains_key(&number) => Ok(number),
            (Some(number), Some(list)) => Err(not_in_list(list, number).hint(EXPORT)),
            _ if self.defined.is_empty() => Err(Fault::new(
                "this file draws with apertures that it does not define (RS-274-D)",
                "aperture definitions, such as `%ADD10C,0.25*%`, or an aperture list (.apt, .gap, .rep) beside the file",
            )
            .hint(EXPORT)),
            (Some(number), None) => Err(Fault::new(
                format!("this draws with aperture D{number}, which is not defined"),
                format!("`%ADD{number}…*%` before it"),
            )),
            (None, _) => {
                Err(Fault::new("this draws without an aperture", "an aperture, such as `D10*`, before it"))
            }
        }
    }

    /// The `.AperFunction` of the aperture in use.
    pub(super) fn function(&self) -> Option<&str> {
        self.defined.get(&self.selected?)?.function.as_deref()
    }

    /// Counts a flash of aperture `number`, which is defined.
    pub(super) fn flash(&mut self, number: u32) -> &Rc<Template> {
        let aperture = self.defined.get_mut(&number).expect("selected");
        aperture.flashes += 1;
        &aperture.template
    }

    /// Counts a draw with aperture `number`, which is defined.
    pub(super) fn draw(&mut self, number: u32) {
        self.defined.get_mut(&number).expect("selected").draws += 1;
    }

    /// The form of aperture `number`, which is in use and defined, under the transformation in
    /// force. What it takes to make it, `canvas` is charged for.
    pub(super) fn form(
        &mut self,
        number: u32,
        linear: impl FnOnce() -> Linear,
        canvas: &mut Canvas,
    ) -> Result<Rc<Form>, Fault> {
        if let Some(form) = &self.form {
            return Ok(Rc::clone(form));
        }
        let linear = linear();
        let key = (number, linear.bits());
        let form = match self.forms.get(&key) {
            Some(form) => Rc::clone(form),
            None => Rc::new(self.make_form(number, linear, canvas)?),
        };
        self.forms.insert(key, Rc::clone(&form));
        self.form = Some(Rc::clone(&form));
        Ok(form)
    }

    fn make_form(&self, number: u32, linear: Linear, canvas: &mut Canvas) -> Result<Form, Fault> {
        let template = &self.defined.get(&number).expect("selected").template;
        if template.reach() * linear.scale() > Nm::MAX.to_f64() {
            return Err(Refusal::Range.into());
        }
        if template.is_tangled() {
            return Err(Refusal::Tangled.into());
        }
        canvas.charge(template.vertex_count(linear))?;
        canvas.charge(template.effort(linear))?;
        template.form(linear).ok_or_else(|| {
            Fault::new(format!("D{number} is a block, which cannot be drawn along a line"), "a flash, D03")
        })
    }

    /// At the end of the file: what is wrong with apertures that nothing selects.
    pub(super) fn explain_malformed(&mut self) -> impl Iterator<Item = (Range<usize>, String)> {
        std::mem::take(&mut self.malformed).into_iter().map(|Malformed { place, fault, .. }| {
            (place, format!("{}; this aperture is never selected and is ignored", fault.what))
        })
    }

    /// How often each was used, by number.
    pub(super) fn uses(&self) -> Vec<ApertureUse> {
        let mut numbers: Vec<_> = self.defined.keys().copied().collect();
        numbers.sort_unstable();
        let uses = numbers.iter().filter_map(|number| {
            let Aperture { template, flashes, draws, .. } = self.defined.get(number)?;
            let (name, what) = (format!("D{number}"), template.describe());
            Some(ApertureUse { name, what, flashes: *flashes, draws: *draws })
        });
        uses.collect()
    }
}

/// The fault of an aperture that the list beside the file does not have, or leaves unclear.
fn not_in_list(list: &ApertureList, number: u32) -> Fault {
    let file = &list.file;
    let draws = format!("this draws with aperture D{number}, which");
    match list.entries.get(&number) {
        Some(Entry::Unclear { line, reason }) => Fault::new(
            format!("{draws} {file}:{line} does not define clearly: {reason}"),
            "a shape with its sizes in the list",
        ),
        _ => Fault::new(
            format!("{draws} the aperture list {file} does not have"),
            "the list that belongs to this file",
        ),
    }
}
