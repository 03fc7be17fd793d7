//! A machine's profile: what it can do, as a person or a ready table says it.

use std::fmt;
use std::str::FromStr;

use serde::Deserialize;

use crate::geometry::Nm;
use crate::toolpath::{Acceleration, Feed, Machine};

use super::per_axis::PerAxis;
use super::ready::READY;
use crate::job::choice::DialectChoice;
use crate::job::described::{self, ParseDescribedError};
use crate::job::quantity::{Length, Wait, text};

/// What is known of a machine; what nobody said is as of a small engraver, or has no limit.
///
/// # Guarantees
///
/// Lengths are above zero, and the spindle's least speed is not above its most.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(try_from = "Table")]
pub struct Profile {
    /// What it is called.
    pub name: String,
    /// What it is, in one line.
    pub about: String,
    /// What it speaks.
    pub dialect: Option<DialectChoice>,
    /// How far it goes.
    pub travel: Option<PerAxis<Length>>,
    /// The speed of each axis in a rapid.
    pub rapid: Option<PerAxis<Feed>>,
    /// The most speed of each axis in a feed; that of a rapid where nobody said so.
    pub max_feed: Option<PerAxis<Feed>>,
    /// The acceleration of each axis.
    pub acceleration: Option<PerAxis<Acceleration>>,
    /// Grbl's `$11`.
    pub junction_deviation: Option<Length>,
    /// The least turns per minute.
    pub spindle_min: Option<u32>,
    /// The most turns per minute.
    pub spindle_max: Option<u32>,
    /// How long a person takes to change a tool.
    pub tool_change_time: Option<Wait>,
}

/// The keys of a table, as they are written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, default, rename_all = "kebab-case")]
#[derive(Default)]
struct Table {
    base: Option<String>,
    name: Option<String>,
    about: Option<String>,
    #[serde(with = "text")]
    dialect: Option<DialectChoice>,
    #[serde(with = "text")]
    travel: Option<PerAxis<Length>>,
    #[serde(with = "text")]
    rapid: Option<PerAxis<Feed>>,
    #[serde(with = "text")]
    max_feed: Option<PerAxis<Feed>>,
    #[serde(with = "text")]
    acceleration: Option<PerAxis<Acceleration>>,
    #[serde(with = "text")]
    junction_deviation: Option<Length>,
    spindle_min: Option<u32>,
    spindle_max: Option<u32>,
    #[serde(with = "text")]
    tool_change_time: Option<Wait>,
}

/// The keys of a table, for whoever mistypes one.
pub(in crate::job) const KEYS: &[&str] = &[
    "base",
    "about",
    "dialect",
    "travel",
    "rapid",
    "max-feed",
    "acceleration",
    "junction-deviation",
    "spindle-min",
    "spindle-max",
    "tool-change-time",
];

/// A file that holds a `[machine]` table and nothing else.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    machine: Profile,
}

impl TryFrom<Table> for Profile {
    type Error = String;

    fn try_from(table: Table) -> Result<Self, String> {
        let base = match &table.base {
            None => Self { name: "my machine".to_owned(), ..Self::default() },
            Some(base) => Self::ready(base).ok_or_else(|| {
                format!("`{base}` is not a known base machine: expected one of {}", known())
            })?,
        };
        let profile = Self {
            name: table.name.unwrap_or(base.name),
            about: table.about.unwrap_or(base.about),
            dialect: table.dialect.or(base.dialect),
            travel: table.travel.or(base.travel),
            // Rapids of its own say how fast it feeds, too.
            max_feed: table.max_feed.or(if table.rapid.is_some() { None } else { base.max_feed }),
            rapid: table.rapid.or(base.rapid),
            acceleration: table.acceleration.or(base.acceleration),
            junction_deviation: table.junction_deviation.or(base.junction_deviation),
            spindle_min: table.spindle_min.or(base.spindle_min),
            spindle_max: table.spindle_max.or(base.spindle_max),
            tool_change_time: table.tool_change_time.or(base.tool_change_time),
        };
        let lengths = profile.travel.map_or(Vec::new(), |travel| travel.0.to_vec());
        let lengths = lengths.into_iter().chain(profile.junction_deviation);
        if let Some(length) = lengths.into_iter().find(|length| length.nm() <= Nm::ZERO) {
            return Err(format!("`{length}` is invalid: travel and junction-deviation are above zero"));
        }
        let most = profile.spindle_max.unwrap_or(u32::MAX);
        if most == 0 || profile.spindle_min.unwrap_or(0) > most {
            return Err(format!(
                "expected a spindle-max above zero and no less than spindle-min, not {most} and {}",
                profile.spindle_min.unwrap_or(0)
            ));
        }
        Ok(profile)
    }
}

impl Profile {
    /// The profile that is built in under this name; upper and lower case are the same.
    #[must_use]
    pub fn ready(name: &str) -> Option<Self> {
        let (_, text) = READY.iter().find(|(known, _)| known.eq_ignore_ascii_case(name))?;
        Some(Self::from_toml(text).expect("the built-in profiles are right"))
    }

    /// The profile in a text with a `[machine]` table.
    ///
    /// # Errors
    ///
    /// What is wrong, with the line.
    pub fn from_toml(text: &str) -> Result<Self, String> {
        toml::from_str(text).map(|File { machine }| machine).map_err(|error| error.to_string())
    }

    /// What the planner and the programs must know of it.
    #[must_use]
    pub fn machine(&self) -> Machine {
        let usual = Machine::default();
        let rapid = self.rapid.map_or(usual.rapid, |rapid| rapid.0);
        let spindle = (self.spindle_min, self.spindle_max);
        Machine {
            rapid,
            feed: self.max_feed.or(self.rapid).map(|feed| feed.0),
            acceleration: self.acceleration.map_or(usual.acceleration, |acceleration| acceleration.0),
            junction_deviation: self.junction_deviation.map_or(usual.junction_deviation, Length::nm),
            spindle: (spindle != (None, None))
                .then(|| (spindle.0.unwrap_or(0), spindle.1.unwrap_or(u32::MAX))),
            spin_up: usual.spin_up,
            tool_change: self.tool_change_time.map_or(usual.tool_change, |wait| wait.milliseconds),
            travel: self.travel.map(|travel| travel.0.map(Length::nm)),
        }
    }
}

/// The machine that a job is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MachineChoice(pub Profile);

fn known() -> String {
    READY.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}

/// A name, or the path of a file that ends in `.toml`, as seen from the working directory.
impl FromStr for MachineChoice {
    type Err = ParseDescribedError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if let Some(profile) = Profile::ready(text.trim()) {
            return Ok(Self(profile));
        }
        let expected = || format!("{} or a file such as mine.toml with a [machine] table", known());
        described::from_file("machine", text, expected, Profile::from_toml).map(Self)
    }
}

/// Its name.
impl fmt::Display for MachineChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.name)
    }
}

/// For serde: a machine as a name, a file, or a table of its own; written as its name.
pub(in crate::job) mod in_settings {
    use serde::de::{Deserialize, Deserializer, Error};
    use serde::{Serialize, Serializer};

    use super::{MachineChoice, Profile};

    #[derive(serde::Deserialize)]
    #[serde(untagged)]
    enum Written {
        Name(String),
        /// 3018 looks like one.
        Number(i64),
        Table(toml::Table),
    }

    pub(crate) fn serialize<S: Serializer>(
        machine: &Option<MachineChoice>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        machine.as_ref().map(ToString::to_string).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<MachineChoice>, D::Error> {
        let choice = match Written::deserialize(deserializer)? {
            Written::Name(name) => name.parse().map_err(D::Error::custom)?,
            Written::Number(number) => number.to_string().parse().map_err(D::Error::custom)?,
            Written::Table(table) => {
                let profile: Result<Profile, _> = toml::Value::Table(table).try_into();
                MachineChoice(profile.map_err(|error| D::Error::custom(error.message()))?)
            }
        };
        Ok(Some(choice))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_ready_profile_has_its_name_and_says_all_there_is_to_say() {
        for (name, _) in READY {
            let profile = Profile::ready(name).expect("a profile");
            assert_eq!(&profile.name, name, "its name");
            assert!(profile.about.contains("figures"), "{name} says how far to believe it");
            let machine = profile.machine();
            assert!(
                machine.travel.is_some() && machine.feed.is_some() && machine.spindle.is_some(),
                "{name}"
            );
            assert!(profile.dialect.is_some() && profile.acceleration.is_some(), "{name}");
        }
    }

    #[test]
    fn a_table_builds_on_a_ready_profile() {
        let mine = Profile::from_toml("[machine]\nbase = \"3018\"\nname = \"mine\"\nspindle-max = 20000\n");
        let mine = mine.expect("a profile").machine();
        assert_eq!(mine.spindle, Some((0, 20_000)), "its own");
        assert_eq!(mine.rapid, Profile::ready("3018").expect("built in").machine().rapid, "the base's");
    }

    #[test]
    fn tables_that_make_no_sense_are_refused_with_the_line() {
        for (text, expected) in [
            ("[machine]\nbase = \"3019\"", "3018, shapeoko"),
            ("[machine]\ntravle = \"1mm\"", "travle"),
            ("[machine]\nrapid = \"500mm/min,2mm/min\"", "three"),
            ("[machine]\nrapid = 500", "feed"),
            ("[machine]\nacceleration = \"50\"", "50mm/s2"),
            ("[machine]\ntravel = \"100mm,0mm,3mm\"", "above zero"),
            ("[machine]\nspindle-min = 9\nspindle-max = 3", "spindle-min"),
            ("[machine]\ndialect = \"esperanto\"", "not a dialect"),
            ("name = \"x\"", "machine"),
        ] {
            let error = Profile::from_toml(text).expect_err(text);
            assert!(error.contains(expected) && error.contains("line"), "{text}: {error}");
        }
    }
}
