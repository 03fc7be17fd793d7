//! Angles in millionths of a degree, exact as they are written.

use std::f64::consts::PI;
use std::fmt;
use std::str::FromStr;

/// An angle in whole millionths of a degree, so that `30deg` and `0.1deg` are exact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Angle(i64);

/// Why a text is not an angle.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not an angle: expected degrees within ±360 with at most six decimals, such as `30deg`")]
pub struct ParseAngleError(String);

impl Angle {
    /// No turn at all.
    pub const ZERO: Self = Self(0);

    /// `degrees` degrees.
    #[must_use]
    pub const fn from_degrees(degrees: i64) -> Self {
        Self(degrees * 1_000_000)
    }

    /// In millionths of a degree.
    #[must_use]
    pub const fn get(self) -> i64 {
        self.0
    }

    /// The same the other way round.
    #[must_use]
    pub const fn reversed(self) -> Self {
        Self(-self.0)
    }

    /// In degrees.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "at most 360 million")]
    pub const fn degrees(self) -> f64 {
        self.0 as f64 / 1e6
    }

    /// In radians.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "at most 360 million")]
    pub fn radians(self) -> f64 {
        self.0 as f64 / 180e6 * PI
    }

    /// How many quarter turns it is, 0 to 3 counter-clockwise; none in between.
    #[must_use]
    pub const fn quarter_turns(self) -> Option<u8> {
        match self.0.rem_euclid(360_000_000) {
            0 => Some(0),
            90_000_000 => Some(1),
            180_000_000 => Some(2),
            270_000_000 => Some(3),
            _ => None,
        }
    }
}

impl FromStr for Angle {
    type Err = ParseAngleError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let refused = || ParseAngleError(text.to_owned());
        let trimmed = text.trim();
        let number =
            trimmed.strip_suffix("deg").or_else(|| trimmed.strip_suffix('°')).ok_or_else(refused)?.trim();
        let (sign, digits) = number.strip_prefix('-').map_or((1, number), |rest| (-1, rest));
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let all_digits = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
        let fits = whole.len() <= 3 && fraction.len() <= 6 && whole.len() + fraction.len() > 0;
        if !fits || !all_digits(whole) || !all_digits(fraction) {
            return Err(refused());
        }
        let value: i64 = format!("{whole}{fraction:0<6}").parse().map_err(|_| refused())?;
        if value > 360_000_000 { Err(refused()) } else { Ok(Self(sign * value)) }
    }
}

/// In degrees, with no more decimals than it has: `30deg`.
impl fmt::Display for Angle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.0 < 0 { "-" } else { "" };
        let text = format!("{}.{:06}", self.0.abs() / 1_000_000, self.0.abs() % 1_000_000);
        write!(f, "{sign}{}deg", text.trim_end_matches('0').trim_end_matches('.'))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_exact_decimals() {
        for text in ["30deg", "0.1deg", "-90deg", "22.5deg", "360deg"] {
            assert_eq!(text.parse::<Angle>().unwrap().to_string(), text, "there and back");
        }
        assert_eq!("30°".parse::<Angle>(), Ok(Angle::from_degrees(30)), "the sign for degrees will do");
        for text in ["30", "deg", "1.2.3deg", "361deg", "3e1deg", "--3deg", "0.1234567deg"] {
            assert!(text.parse::<Angle>().is_err(), "{text} was taken for an angle");
        }
    }
}
