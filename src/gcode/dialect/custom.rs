//! A dialect of one's own: a built-in one, with whatever differs said in TOML.

use std::borrow::Cow;
use std::fmt::Display;
use std::ops::RangeInclusive;

use serde::de::{Deserialize, Deserializer, Error};

use super::{
    Arcs, Blend, Comments, Dialect, Dwell, LineNumbers, Messages, Rapids, Text, ToolChange, Touches,
};

/// Why a text does not describe a dialect: what is wrong with it, and in which line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the dialect cannot be read: {0}")]
pub struct DialectError(String);

/// The keys of the TOML text; all but the first two take the base's value where they are not given.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Keys {
    name: String,
    #[serde(deserialize_with = "base")]
    base: &'static Dialect,
    about: Option<String>,
    #[serde(default, deserialize_with = "extension")]
    extension: Option<String>,
    #[serde(default, deserialize_with = "decimals")]
    decimals: Option<usize>,
    arcs: Option<Arcs>,
    comments: Option<Comments>,
    messages: Option<Messages>,
    dwell: Option<Dwell>,
    tool_change: Option<ToolChange>,
    #[serde(default, deserialize_with = "line")]
    pause: Option<String>,
    #[serde(default, deserialize_with = "line")]
    spindle: Option<String>,
    rapids: Option<Rapids>,
    line_numbers: Option<LineNumbers>,
    #[serde(default, deserialize_with = "longest_line")]
    longest_line: Option<usize>,
    blend: Option<Blend>,
    #[serde(default, deserialize_with = "lines")]
    start: Option<Vec<String>>,
    #[serde(default, deserialize_with = "lines")]
    end: Option<Vec<String>>,
    #[serde(default, deserialize_with = "pair")]
    coolant: Option<[String; 2]>,
    #[serde(default, deserialize_with = "spin_up")]
    spin_up: Option<u32>,
    touches: Option<Touches>,
}

impl Dialect {
    /// A dialect described in TOML: `name`, the `base` that it is like, and the fields of
    /// [`Dialect`] that differ.
    ///
    /// # Errors
    ///
    /// [`DialectError`] for what is not TOML, an unknown key or base, and values that make no
    /// sense.
    ///
    /// # Examples
    ///
    /// ```
    /// let mine = voromill::gcode::Dialect::from_toml(
    ///     "name = 'mine'\nbase = 'grbl'\ndecimals = 3\narcs = 'lines'\nstart = ['G21', 'G90', 'M8']",
    /// )?;
    /// assert_eq!(mine.decimals, 3);
    /// # Ok::<(), voromill::gcode::dialect::DialectError>(())
    /// ```
    pub fn from_toml(text: &str) -> Result<Self, DialectError> {
        let keys: Keys = toml::from_str(text).map_err(|error| DialectError(error.to_string()))?;
        let base = keys.base.clone();
        let text = |given: Option<String>, base: Text| given.map_or(base, Cow::Owned);
        let lines = |given: Option<Vec<String>>, base: Cow<'static, [Text]>| {
            given.map_or(base, |lines| Cow::Owned(lines.into_iter().map(Cow::Owned).collect()))
        };
        let blend = match (keys.blend, &keys.start, base.blend) {
            // Start lines of one's own say all there is to say.
            (None, Some(_), Some(Blend::Within(_))) => Some(Blend::Machine),
            (given, _, blend) => given.or(blend),
        };
        let mut changes = base.changes.clone();
        if let Some(own) = keys.tool_change.filter(|own| !changes.contains(own)) {
            // Who describes a controller knows what it waits at, or a sender that does.
            changes.to_mut().push(own);
        }
        Ok(Self {
            name: Cow::Owned(keys.name),
            about: text(keys.about, base.about),
            extension: text(keys.extension, base.extension),
            decimals: keys.decimals.unwrap_or(base.decimals),
            arcs: keys.arcs.unwrap_or(base.arcs),
            comments: keys.comments.unwrap_or(base.comments),
            messages: keys.messages.unwrap_or(base.messages),
            dwell: keys.dwell.unwrap_or(base.dwell),
            arc_check: base.arc_check,
            rapids: keys.rapids.unwrap_or(base.rapids),
            rapid: base.rapid,
            tool_change: keys.tool_change.unwrap_or(base.tool_change),
            changes,
            pause: text(keys.pause, base.pause),
            spindle: text(keys.spindle, base.spindle),
            line_numbers: keys.line_numbers.unwrap_or(base.line_numbers),
            longest_line: keys.longest_line.unwrap_or(base.longest_line),
            blend,
            start: lines(keys.start, base.start),
            end: lines(keys.end, base.end),
            coolant: keys.coolant.map(|[on, off]| (Cow::Owned(on), Cow::Owned(off))).or(base.coolant),
            spin_up: keys.spin_up.unwrap_or(base.spin_up),
            touches: keys.touches.unwrap_or(base.touches),
            probes_from: base.probes_from,
            sets_height: base.sets_height,
            no_probe: base.no_probe,
            touch_off: base.touch_off,
            condition: base.condition,
            own: base.own,
        })
    }
}

fn base<'de, D: Deserializer<'de>>(written: D) -> Result<&'static Dialect, D::Error> {
    let name = String::deserialize(written)?;
    Dialect::by_name(&name).ok_or_else(|| {
        let names = Dialect::names();
        D::Error::custom(format!("`{name}` is not a base dialect: expected one of {names}"))
    })
}

/// The ending of a file's name, and nothing that leads elsewhere.
fn extension<'de, D: Deserializer<'de>>(written: D) -> Result<Option<String>, D::Error> {
    let ending = String::deserialize(written)?;
    let is_plain = (1..=10).contains(&ending.len()) && ending.bytes().all(|b| b.is_ascii_alphanumeric());
    if is_plain {
        return Ok(Some(ending));
    }
    Err(D::Error::custom(format!(
        "`{ending}` is not a file extension: expected up to ten letters and digits"
    )))
}

fn decimals<'de, D: Deserializer<'de>>(written: D) -> Result<Option<usize>, D::Error> {
    within(written, 2..=6, "decimals")
}

fn longest_line<'de, D: Deserializer<'de>>(written: D) -> Result<Option<usize>, D::Error> {
    within(written, 60..=255, "characters")
}

/// As long as `--spin-up` may be.
fn spin_up<'de, D: Deserializer<'de>>(written: D) -> Result<Option<u32>, D::Error> {
    within(written, 0..=600_000, "milliseconds")
}

fn within<'de, D, T>(written: D, sensible: RangeInclusive<T>, what: &str) -> Result<Option<T>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de> + PartialOrd + Display,
{
    let value = T::deserialize(written)?;
    if sensible.contains(&value) {
        return Ok(Some(value));
    }
    let (least, most) = (sensible.start(), sensible.end());
    Err(D::Error::custom(format!("`{value}` is invalid: expected {least} to {most} {what}")))
}

/// Lines as they will stand in a program: one each.
fn lines<'de, D: Deserializer<'de>>(written: D) -> Result<Option<Vec<String>>, D::Error> {
    one_each::<D, _>(Vec::<String>::deserialize(written)?)
}

/// One line as it will stand in a program.
fn line<'de, D: Deserializer<'de>>(written: D) -> Result<Option<String>, D::Error> {
    Ok(one_each::<D, _>([String::deserialize(written)?])?.map(|[line]| line))
}

fn pair<'de, D: Deserializer<'de>>(written: D) -> Result<Option<[String; 2]>, D::Error> {
    one_each::<D, _>(<[String; 2]>::deserialize(written)?)
}

fn one_each<'de, D: Deserializer<'de>, L: AsRef<[String]>>(lines: L) -> Result<Option<L>, D::Error> {
    if lines.as_ref().iter().any(|line| line.contains(char::is_control)) {
        return Err(D::Error::custom(
            "a line holds a control character: expected each line in quotes of its own",
        ));
    }
    if let Some(line) = lines.as_ref().iter().find(|line| !line.is_ascii()) {
        // Grbl takes bytes from 0x80 for commands, wherever they stand.
        return Err(D::Error::custom(format!(
            "`{line}` is not ASCII: controllers take other bytes for commands"
        )));
    }
    Ok(Some(lines))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;

    #[test]
    fn what_is_not_said_is_as_in_the_base() {
        let mine = Dialect::from_toml("name = 'mine'\nbase = 'linuxcnc'\ncoolant = ['M8', 'M9']")
            .expect("a dialect");
        let base = Dialect::by_name("linuxcnc").expect("built in");
        assert_eq!(mine.start, base.start, "the start lines are LinuxCNC's");
        assert_eq!(mine.blend, base.blend, "and so is how it rounds corners");
        assert_eq!(mine.coolant, Some(("M8".into(), "M9".into())), "the coolant is its own");
    }

    #[test]
    fn a_way_of_changing_tools_that_is_described_is_one_that_holds() {
        let mine = Dialect::from_toml("name = 'mine'\nbase = 'GRBL'\ntool-change = 'm6'").expect("a dialect");
        assert!(
            mine.changes.contains(&ToolChange::M6) && mine.changes.contains(&ToolChange::Files),
            "{mine:?}"
        );
        let plain = Dialect::from_toml("name = 'mine'\nbase = 'grbl'").expect("a dialect");
        assert!(!plain.changes.contains(&ToolChange::M6), "Grbl alone knows no M6");
    }

    #[test]
    fn start_lines_of_ones_own_say_all_of_how_corners_are_rounded() {
        let mine = |more: &str| {
            Dialect::from_toml(&format!("name = 'mine'\nbase = 'linuxcnc'\n{more}")).expect(more)
        };
        assert_eq!(mine("start = ['G64 P0.02']").blend, Some(Blend::Machine), "no second word for it");
        let both = mine("start = ['G21']\nblend = '0.02mm'").blend;
        assert_eq!(both, Some(Blend::Within(Nm::from_um(20))), "unless it says so");
        assert_eq!(mine("blend = 'machine'").blend, Some(Blend::Machine), "nothing at all");
    }

    #[test]
    fn mistakes_are_named() {
        let cases = [
            ("name = 'x'\nbase = 'grlb'", "grbl, grblhal, fluidnc, linuxcnc"),
            ("name = 'x'\nbase = 'grbl'\ndecimal = 3", "decimal"),
            ("name = 'x'\nbase = 'grbl'\ndecimals = 9", "2 to 6"),
            ("base = 'grbl'", "name"),
            ("name = 'x'\nbase = 'linuxcnc'\nblend = '0mm'", "above zero"),
            ("name = 'x'\nbase = 'grbl'\narcs = 'round'", "round"),
            ("name = 'x'\nbase = 'grbl'\nlongest-line = 5", "60 to 255"),
            ("name = 'x'\nbase = 'grbl'\nspin-up = 99999999", "0 to 600000 milliseconds"),
            ("name = 'x'\nbase = 'grbl'\nextension = '../x'", "letters and digits"),
            ("name = 'x'\nbase = 'grbl'\nextension = ''", "letters and digits"),
            ("name = 'x'\nbase = 'grbl'\nstart = [\"G21\\nG90\"]", "control character"),
            ("name = 'x'\nbase = 'grbl'\ncoolant = ['M8']", "length 1"),
            ("name = 'x'\nbase = 'grbl'\nstart = ['(für F)']", "not ASCII"),
            ("name = 'x'\nbase = 'grbl'\npause = \"M0\\nM3\"", "control character"),
        ];
        for (text, expected) in cases {
            let error = Dialect::from_toml(text).expect_err(text).to_string();
            assert!(error.contains(expected), "{text} gives {error}");
            assert!(error.contains("at line "), "{text} gives {error}");
        }
    }
}
