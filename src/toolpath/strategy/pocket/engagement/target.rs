//! The radial engagement that is asked for.

use std::fmt;
use std::str::FromStr;

/// How much of its diameter a tool that goes straight on along a wall of material takes off it.
///
/// ```text
///   ▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒   The part e of the diameter and the angle a of the circumference along which the tool meets
///   ▒▒▒▒▒╭──╮▒▒▒▒▒▒▒▒▒▒   material are two measures of one thing: e = (1 − cos a) / 2. What a tool bears is the angle,
///   ─────┤  │ e           also where its way or the wall is bent.
///        ╰──╯ →
/// ```
///
/// # Range
///
/// 1 % to 50 %: with more the tool would meet more than a quarter of its circumference, and loops
/// would be less load.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Engagement {
    /// In hundredths of a percent.
    hundredths: u32,
}

/// Why a text is not an engagement.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a radial engagement: expected 1% to 50% of the tool diameter, such as `15%`")]
pub struct ParseEngagementError(String);

/// One percent, in hundredths.
const PERCENT: u32 = 100;

impl Engagement {
    /// What is usual for trochoidal milling. Chosen.
    pub const USUAL: Self = Self { hundredths: 15 * PERCENT };

    /// As a part of the diameter.
    #[must_use]
    pub fn part(self) -> f64 {
        f64::from(self.hundredths) / f64::from(100 * PERCENT)
    }

    /// Along how much of the circumference the tool meets material, in radians.
    #[must_use]
    pub fn contact(self) -> f64 {
        libm::acos(1.0 - 2.0 * self.part())
    }
}

impl FromStr for Engagement {
    type Err = ParseEngagementError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let wrong = || ParseEngagementError(text.to_owned());
        let part = text.trim().strip_suffix('%').ok_or_else(wrong)?.trim();
        let (whole, rest) = part.split_once('.').unwrap_or((part, ""));
        let is_number = |text: &str| text.bytes().all(|digit| digit.is_ascii_digit());
        let hundredths = (is_number(whole) && is_number(rest) && rest.len() <= 2 && !whole.is_empty())
            .then(|| format!("{whole}{rest:0<2}").parse().ok())
            .flatten();
        hundredths
            .filter(|hundredths| (PERCENT..=50 * PERCENT).contains(hundredths))
            .map(|hundredths| Self { hundredths })
            .ok_or_else(wrong)
    }
}

/// As it is written, without needless zeros.
impl fmt::Display for Engagement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.hundredths / 100, self.hundredths % 100) {
            (whole, 0) => write!(f, "{whole}%"),
            (whole, tenths) if tenths % 10 == 0 => write!(f, "{whole}.{}%", tenths / 10),
            (whole, hundredths) => write!(f, "{whole}.{hundredths:02}%"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn engagements_are_read_and_shown() {
        for text in ["15%", "1%", "50%", "7.5%", "12.25%"] {
            assert_eq!(text.parse::<Engagement>().map(|read| read.to_string()), Ok(text.to_owned()));
        }
        for text in ["15", "0.99%", "50.01%", "%", "-3%", "1.234%", "a%", "99999999999%", ""] {
            assert!(text.parse::<Engagement>().is_err(), "{text}");
        }
        let contact = Engagement::USUAL.contact().to_degrees();
        assert!((contact - 45.57).abs() < 0.01, "15 % of the diameter: {contact}°");
    }
}
