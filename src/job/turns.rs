//! Turns per minute, as people write them: `12000`, or with its unit, `12000rpm`.

use std::fmt;

use serde::de::{Deserializer, Error, Visitor};

/// A text that is no number of turns.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not a spindle speed: expected revolutions per minute, such as `12000` or `12000rpm`; of a \
     spindle that is set by hand, those that it is set to"
)]
pub struct ParseTurnsError(String);

/// Turns per minute from a number, with its unit or without.
///
/// # Errors
///
/// For what is neither, and for none at all: a spindle that stands cuts nothing.
pub fn parse(text: &str) -> Result<u32, ParseTurnsError> {
    let trimmed = text.trim();
    let number = ["rpm", "RPM"].iter().find_map(|unit| trimmed.strip_suffix(unit)).unwrap_or(trimmed);
    let turns = number.trim().parse().ok().filter(|&turns| turns > 0);
    turns.ok_or_else(|| ParseTurnsError(text.to_owned()))
}

/// For serde: a number, or a text with the unit.
pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<u32>, D::Error> {
    struct Turns;

    impl Visitor<'_> for Turns {
        type Value = u32;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("revolutions per minute, such as 12000")
        }

        fn visit_i64<E: Error>(self, number: i64) -> Result<u32, E> {
            self.visit_str(&number.to_string())
        }

        fn visit_u64<E: Error>(self, number: u64) -> Result<u32, E> {
            self.visit_str(&number.to_string())
        }

        fn visit_str<E: Error>(self, text: &str) -> Result<u32, E> {
            parse(text).map_err(E::custom)
        }
    }

    deserializer.deserialize_any(Turns).map(Some)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Options;

    #[test]
    fn turns_may_carry_their_unit() {
        for text in ["30000", "30000rpm", "30000 rpm", " 30000 RPM"] {
            assert_eq!(parse(text), Ok(30_000), "{text}");
        }
        for text in ["", "rpm", "-1", "0", "0rpm", "1.5", "30000hz", "4294967296"] {
            assert!(parse(text).is_err(), "{text}");
        }
        for text in
            ["spindle = 9000\ndrill-spindle = \"9000rpm\"", "spindle = \"9000\"\ndrill-spindle = 9000"]
        {
            let options = Options::from_toml("f", text).expect(text);
            assert_eq!((options.spindle, options.drill_spindle), (Some(9000), Some(9000)), "{text}");
        }
        assert!(Options::from_toml("f", "spindle = -1").is_err(), "no speed");
    }
}
