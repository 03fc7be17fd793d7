//! A dialect of one's own: a built-in one, with whatever differs said in TOML.

use std::borrow::Cow;

use serde::Deserialize;

use crate::geometry::Nm;

use super::{ALL, Arcs, Blending, Comments, Dialect, Dwell, LineNumbers, Text, ToolChange, Touches};

/// Why a text does not describe a dialect.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DialectError {
    /// Not TOML, a key that is not known, or a value that does not fit.
    #[error("the dialect cannot be read: {0}")]
    Form(String),
    /// `base` names no built-in dialect.
    #[error("`{0}` is not a dialect to build on: expected one of {names}", names = names())]
    Base(String),
    /// How far corners may be rounded off is no length above zero.
    #[error("`blend` is `{0}`: expected a length above zero, such as 0.01mm, or `machine`")]
    Blend(String),
    /// A number outside what makes sense.
    #[error("`{key}` is {value}: expected {expected}")]
    Range {
        /// The key.
        key: &'static str,
        /// Its value.
        value: usize,
        /// What was expected.
        expected: &'static str,
    },
}

fn names() -> String {
    ALL.iter().map(|dialect| dialect.name.as_ref()).collect::<Vec<_>>().join(", ")
}

/// The keys of the TOML text; all but the first two take the base's value where they are not given.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Keys {
    name: String,
    base: String,
    about: Option<String>,
    extension: Option<String>,
    decimals: Option<usize>,
    arcs: Option<Arcs>,
    comments: Option<Comments>,
    dwell: Option<Dwell>,
    tool_change: Option<ToolChange>,
    line_numbers: Option<LineNumbers>,
    longest_line: Option<usize>,
    blend: Option<String>,
    start: Option<Vec<String>>,
    end: Option<Vec<String>>,
    coolant: Option<(String, String)>,
    spin_up: Option<u32>,
    touches: Option<Touches>,
}

impl Dialect {
    /// A dialect described in TOML: `name`, the `base` that it is like, and the fields of [`Dialect`] that differ.
    ///
    /// # Errors
    ///
    /// [`DialectError`] for what is not TOML, an unknown key or base, and numbers outside their range.
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
        let keys: Keys = toml::from_str(text).map_err(|error| DialectError::Form(error.to_string()))?;
        let base = Self::by_name(&keys.base).ok_or_else(|| DialectError::Base(keys.base.clone()))?.clone();
        let text = |given: Option<String>, base: Text| given.map_or(base, Cow::Owned);
        let lines = |given: Option<Vec<String>>, base: Cow<'static, [Text]>| {
            given.map_or(base, |lines| Cow::Owned(lines.into_iter().map(Cow::Owned).collect()))
        };
        let blending = match (&keys.blend, &keys.start, base.blending) {
            (Some(text), ..) => blending(text)?,
            // Start lines of one's own say all there is to say.
            (None, Some(_), Blending::Within(_)) => Blending::AsSet,
            (None, _, blending) => blending,
        };
        Ok(Self {
            name: Cow::Owned(keys.name),
            about: text(keys.about, base.about),
            extension: text(keys.extension, base.extension),
            decimals: within("decimals", keys.decimals.unwrap_or(base.decimals), 2, 6, "2 to 6")?,
            arcs: keys.arcs.unwrap_or(base.arcs),
            comments: keys.comments.unwrap_or(base.comments),
            dwell: keys.dwell.unwrap_or(base.dwell),
            tool_change: keys.tool_change.unwrap_or(base.tool_change),
            line_numbers: keys.line_numbers.unwrap_or(base.line_numbers),
            longest_line: within(
                "longest-line",
                keys.longest_line.unwrap_or(base.longest_line),
                60,
                255,
                "60 to 255 characters",
            )?,
            blending,
            start: lines(keys.start, base.start),
            end: lines(keys.end, base.end),
            coolant: keys.coolant.map(|(on, off)| (Cow::Owned(on), Cow::Owned(off))).or(base.coolant),
            spin_up: keys.spin_up.unwrap_or(base.spin_up),
            touches: keys.touches.unwrap_or(base.touches),
        })
    }
}

fn blending(text: &str) -> Result<Blending, DialectError> {
    if text == "machine" {
        return Ok(Blending::AsSet);
    }
    let most = text.parse::<Nm>().ok().filter(|&most| most > Nm::ZERO);
    most.map(Blending::Within).ok_or_else(|| DialectError::Blend(text.to_owned()))
}

fn within(
    key: &'static str,
    value: usize,
    least: usize,
    most: usize,
    expected: &'static str,
) -> Result<usize, DialectError> {
    if (least..=most).contains(&value) {
        Ok(value)
    } else {
        Err(DialectError::Range { key, value, expected })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_said_is_as_in_the_base() {
        let mine = Dialect::from_toml("name = 'mine'\nbase = 'linuxcnc'\ncoolant = ['M8', 'M9']")
            .expect("a dialect");
        let base = Dialect::by_name("linuxcnc").expect("built in");
        assert_eq!(mine.start, base.start, "the start lines are LinuxCNC's");
        assert_eq!(mine.blending, base.blending, "and so is how it rounds corners");
        assert_eq!(mine.coolant, Some(("M8".into(), "M9".into())), "the coolant is its own");
    }

    #[test]
    fn start_lines_of_ones_own_say_all_of_how_corners_are_rounded() {
        let mine = |more: &str| {
            Dialect::from_toml(&format!("name = 'mine'\nbase = 'linuxcnc'\n{more}")).expect(more)
        };
        assert_eq!(mine("start = ['G64 P0.02']").blending, Blending::AsSet, "no second word for it");
        let both = mine("start = ['G21']\nblend = '0.02mm'").blending;
        assert_eq!(both, Blending::Within(Nm::from_um(20)), "unless it says so");
        assert_eq!(mine("blend = 'machine'").blending, Blending::AsSet, "nothing at all");
    }

    #[test]
    fn mistakes_are_named() {
        let cases = [
            ("name = 'x'\nbase = 'grlb'", "grbl, linuxcnc"),
            ("name = 'x'\nbase = 'grbl'\ndecimal = 3", "decimal"),
            ("name = 'x'\nbase = 'grbl'\ndecimals = 9", "2 to 6"),
            ("base = 'grbl'", "name"),
            ("name = 'x'\nbase = 'linuxcnc'\nblend = '0mm'", "above zero"),
            ("name = 'x'\nbase = 'grbl'\narcs = 'round'", "round"),
        ];
        for (text, expected) in cases {
            let error = Dialect::from_toml(text).expect_err(text).to_string();
            assert!(error.contains(expected), "{text} gives {error}");
        }
    }
}
