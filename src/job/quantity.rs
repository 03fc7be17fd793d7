//! Settings as people write them, with units, and as the report repeats them.

use std::fmt;
use std::str::FromStr;

use crate::geometry::{Nm, ParseLengthError};

/// A length that prints as it is written: `0.1mm`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Length(pub Nm);

impl Length {
    /// In nanometres.
    #[must_use]
    pub const fn nm(self) -> Nm {
        self.0
    }
}

impl FromStr for Length {
    type Err = ParseLengthError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.parse().map(Self)
    }
}

/// Diameters of drills.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drills(pub Vec<Length>);

impl FromStr for Drills {
    type Err = ParseLengthError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.split(',').map(str::parse).collect::<Result<_, _>>().map(Self)
    }
}

/// As it is written: `0.8mm,1mm`.
impl fmt::Display for Drills {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.iter().map(ToString::to_string).collect::<Vec<_>>().join(","))
    }
}

/// Millimetres without needless zeros.
impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = self.0.to_string();
        write!(f, "{}mm", text.trim_end_matches('0').trim_end_matches('.'))
    }
}

/// For serde: an optional value as the text people write. A bare number in a settings file is read as text too, so
/// that it meets the same refusal, with the same hint, as on the command line.
pub(super) mod text {
    use std::fmt;
    use std::marker::PhantomData;
    use std::str::FromStr;

    use serde::de::{Deserializer, Error, Visitor};
    use serde::{Serialize, Serializer};

    pub(crate) fn serialize<S: Serializer, T: fmt::Display>(
        value: &Option<T>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        value.as_ref().map(ToString::to_string).serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D, T>(deserializer: D) -> Result<Option<T>, D::Error>
    where
        D: Deserializer<'de>,
        T: FromStr<Err: fmt::Display>,
    {
        struct Written<T>(PhantomData<T>);

        impl<T: FromStr<Err: fmt::Display>> Visitor<'_> for Written<T> {
            type Value = T;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a text in quotes")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
                text.parse().map_err(E::custom)
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<T, E> {
                self.visit_str(&number.to_string())
            }

            fn visit_f64<E: Error>(self, number: f64) -> Result<T, E> {
                self.visit_str(&number.to_string())
            }
        }

        deserializer.deserialize_any(Written(PhantomData)).map(Some)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_printed_reads_back() {
        for text in ["0.1mm", "25.4um", "8mil", "-3mm", "0mm"] {
            let length: Length = text.parse().expect("a length");
            assert_eq!(length.to_string().parse(), Ok(length), "{text}");
        }
        assert_eq!("200um".parse::<Length>().expect("a length").to_string(), "0.2mm", "no needless zeros");
    }
}
