//! The ini file of a LinuxCNC configuration: `[TRAJ]`, `[AXIS_X]` or `[JOINT_0]`, `[SPINDLE_0]`.

use super::{Draft, FAR, ImportError};
use crate::geometry::Nm;
use crate::job::Length;
use crate::toolpath::{Acceleration, Feed};

/// The name of a line that begins a section.
pub(super) fn section(line: &str) -> Option<&str> {
    line.trim().strip_prefix('[')?.split(']').next()
}

/// One `KEY = value` with its section and line.
struct Entry<'a> {
    section: &'a str,
    key: &'a str,
    value: &'a str,
    line: usize,
}

struct Ini<'a> {
    entries: Vec<Entry<'a>>,
    /// `mm` or `in`.
    unit: &'static str,
}

impl<'a> Ini<'a> {
    fn find(&self, section: &str, key: &str) -> Option<&Entry<'a>> {
        self.entries.iter().find(|entry| entry.section == section && entry.key == key)
    }

    /// A value with a unit behind it, as `T` reads it.
    fn get<T: std::str::FromStr>(
        &self,
        section: &str,
        key: &str,
        unit: &str,
    ) -> Result<Option<T>, ImportError> {
        let Some(entry) = self.find(section, key) else { return Ok(None) };
        let no = |_| ImportError::at(entry.line, format!("`{}` is not a value for {key}", entry.value));
        format!("{}{unit}", entry.value).parse().map(Some).map_err(no)
    }

    /// The same of an axis, by its letter or by its joint.
    fn of_axis<T: std::str::FromStr>(
        &self,
        (letter, joint): (char, u32),
        key: &str,
        unit: &str,
    ) -> Result<T, ImportError> {
        for section in [format!("AXIS_{letter}"), format!("JOINT_{joint}"), format!("AXIS_{joint}")] {
            if let Some(value) = self.get(&section, key, unit)? {
                return Ok(value);
            }
        }
        Err(ImportError::whole(format!(
            "neither [AXIS_{letter}]{key} nor [JOINT_{joint}]{key} is set; included files are not read"
        )))
    }
}

const AXES: [(char, u32); 3] = [('X', 0), ('Y', 1), ('Z', 2)];

fn entries(text: &str) -> Vec<Entry<'_>> {
    let (mut all, mut here) = (Vec::new(), "");
    for (line, text) in (1..).zip(text.lines()) {
        if let Some(name) = section(text) {
            here = name;
        } else if let Some((key, value)) = text.split_once('=') {
            // A comment begins a line, or stands behind a blank.
            let value = value.split([';', '#']).next().unwrap_or_default();
            if !key.trim_start().starts_with(['#', ';']) {
                all.push(Entry { section: here, key: key.trim(), value: value.trim(), line });
            }
        }
    }
    all
}

pub(super) fn read(name: &str, text: &str) -> Result<Draft, ImportError> {
    let mut ini = Ini { entries: entries(text), unit: "mm" };
    let units = ini
        .find("TRAJ", "LINEAR_UNITS")
        .ok_or_else(|| ImportError::whole("[TRAJ]LINEAR_UNITS is not set: expected mm or inch"))?;
    ini.unit = match units.value.to_ascii_lowercase().as_str() {
        "mm" | "metric" => "mm",
        "inch" | "in" | "imperial" => "in",
        other => {
            return Err(ImportError::at(units.line, format!("`{other}` is not a unit: expected mm or inch")));
        }
    };
    let (unit, per_second, per_second_squared) =
        (ini.unit, format!("{}/s", ini.unit), format!("{}/s2", ini.unit));
    let most_speed: Option<Feed> = ini.get("TRAJ", "MAX_LINEAR_VELOCITY", &per_second)?;
    let most_ramp: Option<Acceleration> = ini.get("TRAJ", "MAX_LINEAR_ACCELERATION", &per_second_squared)?;
    let (mut travel, mut rapid, mut ramps) = (Vec::new(), Vec::new(), Vec::new());
    for axis in AXES {
        let speed: Feed = ini.of_axis(axis, "MAX_VELOCITY", &per_second)?;
        rapid.push(most_speed.map_or(speed, |most| most.min(speed)).to_string());
        let ramp: Acceleration = ini.of_axis(axis, "MAX_ACCELERATION", &per_second_squared)?;
        ramps.push(most_ramp.map_or(ramp, |most| most.min(ramp)).to_string());
        let limit = |key| ini.of_axis::<Nm>(axis, key, unit);
        // An axis without limits is LinuxCNC's for one without an end.
        if let (Ok(least), Ok(most)) = (limit("MIN_LIMIT"), limit("MAX_LIMIT")) {
            travel.push(Length((most - least).min(FAR)).to_string());
        }
    }
    let mut draft = Draft::default();
    draft.notes.push(
        "read from a LinuxCNC ini file; the junction deviation is set from the tolerance of G64 P".to_owned(),
    );
    draft.text("name", ini.find("EMC", "MACHINE").map_or(name, |entry| entry.value));
    draft.text("dialect", "linuxcnc");
    if travel.len() == 3 {
        draft.text("travel", &travel.join(","));
    } else {
        draft.notes.push("not all axes have MIN_LIMIT and MAX_LIMIT, so the travel is unknown".to_owned());
    }
    draft.text("rapid", &rapid.join(","));
    draft.text("acceleration", &ramps.join(","));
    draft.text("junction-deviation", "0.005mm");
    for (key, setting) in [("spindle-min", "MIN_FORWARD_VELOCITY"), ("spindle-max", "MAX_FORWARD_VELOCITY")] {
        if let Some(entry) = ini.find("SPINDLE_0", setting) {
            let turns = entry.value.split('.').next().and_then(|whole| whole.parse().ok());
            let no =
                || ImportError::at(entry.line, format!("`{}` is not a value for {setting}", entry.value));
            draft.number(key, turns.ok_or_else(no)?);
        }
    }
    Ok(draft)
}
