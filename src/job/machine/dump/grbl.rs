//! Grbl's answer to `$$`, as a console shows it.

use std::collections::BTreeMap;

use super::{Draft, FAR, ImportError};
use crate::geometry::{Nm, nanometres};
use crate::toolpath::{Acceleration, Feed};

/// The most of `$30` that is taken for a scale of S and not for turns per minute: no spindle for
/// boards turns so slowly, and Grbl is delivered with 1000.
const SCALE: u32 = 1000;

/// Number and value of a line that says a setting, such as `$110=500.000` or
/// `$110 = 500.000 (x max rate, mm/min)`.
pub(super) fn setting(line: &str) -> Option<(u32, &str)> {
    let (number, value) = line.trim().strip_prefix('$')?.split_once('=')?;
    let value = value.split('(').next().unwrap_or_default();
    Some((number.trim().parse().ok()?, value.trim()))
}

/// The settings by number, with their lines.
struct Settings<'a>(BTreeMap<u32, (usize, &'a str)>);

impl Settings<'_> {
    /// A setting as `parse` reads it; none where it is not there.
    fn get<T>(&self, number: u32, parse: impl Fn(&str) -> Option<T>) -> Result<Option<T>, ImportError> {
        let Some(&(line, value)) = self.0.get(&number) else { return Ok(None) };
        let no = || ImportError::at(line, format!("`{value}` is not a value for ${number}"));
        parse(value).map(Some).ok_or_else(no)
    }

    /// Three settings in a row, as text; none where one is missing.
    fn axes<T: ToString>(
        &self,
        first: u32,
        parse: impl Fn(&str) -> Option<T>,
    ) -> Result<Option<String>, ImportError> {
        let mut texts = Vec::with_capacity(3);
        for number in first..first + 3 {
            texts.extend(self.get(number, &parse)?.map(|value| value.to_string()));
        }
        Ok((texts.len() == 3).then(|| texts.join(",")))
    }
}

pub(super) fn read(name: &str, text: &str) -> Result<Draft, ImportError> {
    let mut settings = Settings(BTreeMap::new());
    for (line, (number, value)) in (1..).zip(text.lines()).filter_map(|(n, line)| Some((n, setting(line)?))) {
        match settings.0.insert(number, (line, value)) {
            Some((_, before)) if before != value => {
                let message = format!("${number} is set twice: {before} and {value}");
                return Err(ImportError::at(line, message));
            }
            _ => {}
        }
    }
    let missing = |first: u32, what: &str| {
        ImportError::whole(format!("${first} to ${} are not all set: {what}", first + 2))
    };
    let speed = |value: &str| format!("{value}mm/min").parse::<Feed>().ok();
    let acceleration = |value: &str| format!("{value}mm/s2").parse::<Acceleration>().ok();
    let length = |value: &str| {
        let length = nanometres(&format!("{value}mm")).ok()?.min(FAR.get());
        (length >= 0).then_some(crate::job::Length(Nm::new(length)))
    };
    let turns = |value: &str| value.split('.').next()?.parse::<u32>().ok();
    let mut draft = Draft::default();
    draft.notes.push("read from Grbl's settings ($$)".to_owned());
    draft.text("name", name);
    draft.text("dialect", "grbl");
    let travel = settings.axes(130, length)?;
    if let Some(travel) = travel.filter(|text| !text.split(',').any(|length| length == "0mm")) {
        draft.text("travel", &travel);
    } else {
        draft.notes.push("$130 to $132 do not give the travel".to_owned());
    }
    let rapid = settings.axes(110, speed)?.ok_or_else(|| missing(110, "the speeds of the axes"))?;
    draft.text("rapid", &rapid);
    let ramps =
        settings.axes(120, acceleration)?.ok_or_else(|| missing(120, "the accelerations of the axes"))?;
    draft.text("acceleration", &ramps);
    if let Some(deviation) = settings.get(11, length)?.filter(|deviation| deviation.nm() > Nm::ZERO) {
        draft.text("junction-deviation", &deviation.to_string());
    }
    match settings.get(30, turns)? {
        Some(most) if most > SCALE => {
            if let Some(least) = settings.get(31, turns)?.filter(|&least| least > 0) {
                draft.number("spindle-min", least);
            }
            draft.number("spindle-max", most);
        }
        Some(most) => draft.notes.push(format!(
            "$30 is {most}: S sets the motor voltage in steps, not the speed, so an S above {most} is full speed; \
             set $30 to the maximum rpm of your spindle and add spindle-max"
        )),
        None => {}
    }
    if settings.get(32, turns)? == Some(1) {
        draft.notes.push("$32 is 1, laser mode: the spindle would stop in every rapid; set $32=0".to_owned());
    }
    Ok(draft)
}
