//! Settings as people write them, with units, and as the report repeats them.

use std::fmt;
use std::str::FromStr;

use crate::geometry::{Nm, ParseLengthError, Point, Rect, Vector};

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

/// A time to wait, written as `3s` or `200ms`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wait {
    /// In milliseconds.
    pub milliseconds: u32,
}

/// The longest time to wait, in milliseconds. Chosen: an hour is a mistake in the unit.
const LONGEST_WAIT: f64 = 600_000.0;

/// A text that is no time to wait.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a pause: expected up to ten minutes with a unit, such as `3s` or `200ms`")]
pub struct ParseWaitError(String);

impl FromStr for Wait {
    type Err = ParseWaitError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let error = || ParseWaitError(text.to_owned());
        let (number, unit) = match text.strip_suffix("ms") {
            Some(number) => (number, 1.0),
            None => (text.strip_suffix('s').ok_or_else(error)?, 1000.0),
        };
        let count: f64 = number.trim().parse().map_err(|_| error())?;
        if !(0.0..=LONGEST_WAIT).contains(&(count * unit)) {
            return Err(error());
        }
        let milliseconds = u32::try_from(Nm::from_f64(count * unit).get()).map_err(|_| error())?;
        Ok(Self { milliseconds })
    }
}

impl fmt::Display for Wait {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.milliseconds {
            whole if whole % 1000 == 0 => write!(f, "{}s", whole / 1000),
            milliseconds => write!(f, "{milliseconds}ms"),
        }
    }
}

/// A place on the board or a step from one to another, written as `10mm,5mm`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// To the right.
    pub x: Length,
    /// Up.
    pub y: Length,
}

/// A text that is not a place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParsePlaceError {
    /// Not two parts.
    #[error("`{0}` is not a place: expected two lengths, such as `10mm,5mm`")]
    Form(String),
    /// Not three parts.
    #[error("`{0}` is not x, y and z: expected three lengths, such as `280mm,170mm,40mm`")]
    Triple(String),
    /// Not four parts, or no area.
    #[error(
        "`{0}` is not an area: expected its lower left corner, and a width and a height above zero, such as `10mm,5mm,20mm,15mm`"
    )]
    Area(String),
    /// A part that is no length.
    #[error(transparent)]
    Length(#[from] ParseLengthError),
}

impl FromStr for Place {
    type Err = ParsePlaceError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (x, y) = text.split_once(',').ok_or_else(|| ParsePlaceError::Form(text.to_owned()))?;
        Ok(Self { x: x.trim().parse()?, y: y.trim().parse()? })
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", self.x, self.y)
    }
}

impl From<Place> for Point {
    fn from(place: Place) -> Self {
        Self::new(place.x.nm(), place.y.nm())
    }
}

/// A rectangle on the board, written as its lower left corner, its width and its height:
/// `10mm,5mm,20mm,15mm`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// Its lower left corner.
    pub corner: Place,
    /// Above zero.
    pub width: Length,
    /// Above zero.
    pub height: Length,
}

impl FromStr for Area {
    type Err = ParsePlaceError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let refused = || ParsePlaceError::Area(text.to_owned());
        let lengths: Vec<&str> = text.split(',').map(str::trim).collect();
        let [x, y, width, height] = lengths[..] else { return Err(refused()) };
        let (width, height): (Length, Length) = (width.parse()?, height.parse()?);
        if width.nm() <= Nm::ZERO || height.nm() <= Nm::ZERO {
            return Err(refused());
        }
        Ok(Self { corner: Place { x: x.parse()?, y: y.parse()? }, width, height })
    }
}

impl fmt::Display for Area {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{}", self.corner, self.width, self.height)
    }
}

impl From<Area> for Rect {
    fn from(area: Area) -> Self {
        let corner = Point::from(area.corner);
        Self::new(corner, corner + Vector::new(area.width.nm(), area.height.nm()))
    }
}

/// Where the machine waits for a tool: a place, written as three lengths, or a height above where
/// it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToolChangeAt {
    /// Such as `0mm,0mm,30mm`.
    Place(Triple),
    /// Such as `30mm`.
    Height(Length),
}

impl FromStr for ToolChangeAt {
    type Err = ParsePlaceError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text.contains(',') {
            text.parse().map(Self::Place)
        } else {
            Ok(Self::Height(text.trim().parse()?))
        }
    }
}

impl fmt::Display for ToolChangeAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Place(place) => place.fmt(f),
            Self::Height(height) => height.fmt(f),
        }
    }
}

/// Three lengths: along x, y and z.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triple(pub [Length; 3]);

impl FromStr for Triple {
    type Err = ParsePlaceError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let lengths: Vec<&str> = text.split(',').map(str::trim).collect();
        let [x, y, z] = lengths[..] else { return Err(ParsePlaceError::Triple(text.to_owned())) };
        Ok(Self([x.parse()?, y.parse()?, z.parse()?]))
    }
}

impl fmt::Display for Triple {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0;
        write!(f, "{x},{y},{z}")
    }
}

/// Columns and rows of the same board: `3x2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiles {
    /// How many side by side; at least one.
    pub columns: u32,
    /// How many one above the other; at least one.
    pub rows: u32,
}

/// A text that does not say columns and rows.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a number of columns and rows: expected, 1 to 100 each, such as `3x2`")]
pub struct ParseTilesError(String);

impl FromStr for Tiles {
    type Err = ParseTilesError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let refused = || ParseTilesError(text.to_owned());
        let (columns, rows) = text.trim().split_once(['x', '×']).ok_or_else(refused)?;
        let count = |part: &str| part.trim().parse().ok().filter(|count| (1..=100).contains(count));
        Ok(Self { columns: count(columns).ok_or_else(refused)?, rows: count(rows).ok_or_else(refused)? })
    }
}

impl fmt::Display for Tiles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.columns, self.rows)
    }
}

/// A drill at hand: by its diameter, or as a tool.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DrillChoice {
    /// Such as `0.8mm`.
    Diameter(Length),
    /// Such as `carbide-08`, the name of a table, or `drill:0.8mm`.
    Named(String),
}

impl FromStr for DrillChoice {
    type Err = ParseLengthError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let text = text.trim();
        let begins_a_name = text.starts_with(char::is_alphabetic);
        if begins_a_name { Ok(Self::Named(text.to_owned())) } else { text.parse().map(Self::Diameter) }
    }
}

impl fmt::Display for DrillChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Diameter(length) => length.fmt(f),
            Self::Named(name) => f.write_str(name),
        }
    }
}

/// Drills at hand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drills(pub Vec<DrillChoice>);

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

/// For serde: an optional value as the text people write. A bare number in a settings file is read
/// as text too, so that it meets the same refusal, with the same hint, as on the command line.
pub(super) mod text {
    use std::fmt;
    use std::marker::PhantomData;
    use std::str::FromStr;

    use serde::de::{Deserializer, Error, SeqAccess, Visitor};
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

        impl<'de, T: FromStr<Err: fmt::Display>> Visitor<'de> for Written<T> {
            type Value = T;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a text in quotes")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<T, E> {
                text.parse().map_err(E::custom)
            }

            /// Several texts are one with commas.
            fn visit_seq<A: SeqAccess<'de>>(self, mut several: A) -> Result<T, A::Error> {
                let mut texts: Vec<String> = Vec::new();
                while let Some(text) = several.next_element()? {
                    texts.push(text);
                }
                texts.join(",").parse().map_err(A::Error::custom)
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

/// For serde: a list, as texts in an array, or as one text with blanks or commas between; written
/// with blanks, those within a text as `^20`, and `^` as `^5E`.
pub(super) mod list {
    use std::fmt;
    use std::str::FromStr;

    use serde::de::{Deserialize, Deserializer, Error};
    use serde::{Serialize, Serializer};

    pub(crate) fn serialize<S: Serializer, T: fmt::Display>(
        values: &[T],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let written = |value: &T| value.to_string().replace('^', "^5E").replace(' ', "^20");
        values.iter().map(written).collect::<Vec<_>>().join(" ").serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D, T>(deserializer: D) -> Result<Vec<T>, D::Error>
    where
        D: Deserializer<'de>,
        T: FromStr<Err: fmt::Display>,
    {
        #[derive(serde::Deserialize)]
        #[serde(untagged, expecting = "expected a text in quotes, or several in brackets")]
        enum Written {
            One(String),
            Several(Vec<String>),
        }

        let texts = match Written::deserialize(deserializer)? {
            // A place has a comma of its own.
            Written::One(text) if text.parse::<T>().is_ok() => vec![text],
            Written::One(text) => {
                text.split([',', ' ']).filter(|text| !text.is_empty()).map(str::to_owned).collect()
            }
            Written::Several(texts) => texts,
        };
        texts.iter().map(|text| text.parse().map_err(D::Error::custom)).collect()
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
