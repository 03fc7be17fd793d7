//! How long one unit of a drawing is.

use std::fmt;
use std::str::FromStr;

use crate::geometry::{Nm, ParseLengthError};

/// The length of one unit of a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit(f64);

impl Unit {
    /// A pixel of CSS, of which 96 are an inch.
    pub const PIXEL: Self = Self(25.4e6 / 96.0);
    /// A millimetre.
    pub const MILLIMETRE: Self = Self(1e6);

    /// A unit of so many nanometres; none where that is no length.
    #[must_use]
    pub fn of_nanometres(length: f64) -> Option<Self> {
        (length.is_finite() && length > 0.0).then_some(Self(length))
    }

    /// Its length in nanometres.
    #[must_use]
    pub const fn nanometres(self) -> f64 {
        self.0
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.6} mm", self.0 / 1e6)
    }
}

/// `mm`, `in`, `0.1mm`, or how many of it are an inch: `90dpi`.
impl FromStr for Unit {
    type Err = ParseLengthError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let trimmed = text.trim();
        let none = || ParseLengthError::NoNumber(text.to_owned());
        if let Some(count) = trimmed.strip_suffix("dpi") {
            let count = count.trim().parse::<f64>().map_err(|_| none())?;
            return Self::of_nanometres(25.4e6 / count).ok_or_else(none);
        }
        let is_bare = trimmed.starts_with(|c: char| c.is_alphabetic());
        let length: Nm = if is_bare { format!("1{trimmed}").parse()? } else { trimmed.parse()? };
        Self::of_nanometres(length.to_f64()).ok_or_else(none)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_named_measured_or_counted() {
        for (text, nm) in [("mm", 1e6), ("in", 25.4e6), ("0.1mm", 1e5), ("90dpi", 25.4e6 / 90.0)] {
            let unit: Unit = text.parse().expect(text);
            assert!((unit.nanometres() - nm).abs() < 1e-6, "{text}: {unit}");
        }
        for text in ["", "5", "-1mm", "0dpi", "furlong", "0mm"] {
            assert!(text.parse::<Unit>().is_err(), "{text} is no unit");
        }
    }
}
