//! Feeds in micrometres per minute, and the texts that say them.

use std::fmt;
use std::str::FromStr;

use crate::geometry::{ParseLengthError, nanometres};

/// A speed along a path, in whole micrometres per minute; always positive.
///
/// # Range
///
/// 1 µm/min to 1 km/min.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Feed(i64);

/// Why a text is not a feed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseFeedError {
    /// No `/min` or `/s` after the length.
    #[error("`{0}` is not a feed: expected a length and a time, such as `200mm/min` or `8in/min`")]
    NoTime(String),
    /// A time that is not known.
    #[error("`{0}` is not a unit of time: expected min or s")]
    UnknownTime(String),
    /// The part before the slash is not a length.
    #[error(transparent)]
    Length(#[from] ParseLengthError),
    /// Zero, negative or beyond a kilometre a minute.
    #[error("`{0}` lies outside 1 µm/min to 1 km/min")]
    OutOfRange(String),
}

impl Feed {
    /// `speed` millimetres per minute: for constants.
    ///
    /// # Panics
    ///
    /// For zero and beyond a kilometre a minute.
    #[must_use]
    pub const fn from_mm_per_min(speed: i64) -> Self {
        assert!(speed > 0 && speed <= 1_000_000, "a feed lies within 1 mm/min and 1 km/min");
        Self(speed * 1_000)
    }

    /// `speed` micrometres per minute, if that is a feed.
    #[must_use]
    pub const fn try_new(speed: i64) -> Option<Self> {
        if speed > 0 && speed <= 1_000_000_000 { Some(Self(speed)) } else { None }
    }

    /// In micrometres per minute.
    #[must_use]
    pub const fn get(self) -> i64 {
        self.0
    }

    /// So many times as fast, at least once: in whole millimetres per minute, rounded down.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "`as` saturates")]
    pub(crate) fn times(self, ratio: f64) -> Self {
        const MOST: i64 = 1_000_000_000;
        #[expect(clippy::cast_precision_loss, reason = "a feed is below 2⁵³")]
        let faster = (self.0 as f64 * ratio) as i64;
        Self((faster.min(MOST) / 1_000 * 1_000).max(self.0))
    }

    /// In nanometres per second, for estimating time.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a feed is below 2⁵³")]
    pub fn nm_per_second(self) -> f64 {
        self.0 as f64 * 1000.0 / 60.0
    }
}

impl FromStr for Feed {
    type Err = ParseFeedError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (length, time) =
            text.trim().split_once('/').ok_or_else(|| ParseFeedError::NoTime(text.trim().to_owned()))?;
        let per_minute = match time.trim() {
            "min" | "minute" => 1,
            "s" | "sec" | "second" => 60,
            other => return Err(ParseFeedError::UnknownTime(other.to_owned())),
        };
        let speed =
            nanometres(length)?.checked_mul(per_minute).and_then(|speed| Self::try_new(speed / 1_000));
        speed.ok_or_else(|| ParseFeedError::OutOfRange(text.to_owned()))
    }
}

/// In millimetres per minute, with no more decimals than it has: `200mm/min`, `203.2mm/min`.
impl fmt::Display for Feed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}mm/min", self.number())
    }
}

impl Feed {
    /// The millimetres per minute alone, as a machine reads them after an F.
    #[must_use]
    pub fn number(self) -> String {
        let text = format!("{}.{:03}", self.0 / 1_000, self.0 % 1_000);
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn feeds_carry_length_and_time() {
        for (text, um, shown) in [
            ("200mm/min", 200_000, "200mm/min"),
            ("8in/min", 203_200, "203.2mm/min"),
            ("5mm/s", 300_000, "300mm/min"),
            // Farther in a minute than any board is long.
            ("1500mm/min", 1_500_000, "1500mm/min"),
            ("60in/min", 1_524_000, "1524mm/min"),
        ] {
            let feed: Feed = text.parse().unwrap();
            assert_eq!((feed.get(), feed.to_string().as_str()), (um, shown), "{text}");
        }
    }

    #[test]
    fn nonsense_is_refused() {
        for text in [
            "200",
            "200mm",
            "200/min",
            "0mm/min",
            "-5mm/min",
            "5mm/h",
            "mm/min",
            "2000000mm/min",
            "1e9mm/min",
        ] {
            assert!(text.parse::<Feed>().is_err(), "{text} was taken for a feed");
        }
    }
}
