//! The radial engagement that is asked for.

use std::fmt;
use std::str::FromStr;

use crate::toolpath::Percent;

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
pub struct Engagement(Percent);

/// Why a text is not an engagement.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a radial engagement: expected 1% to 50% of the tool diameter, such as `15%`")]
pub struct ParseEngagementError(String);

impl Engagement {
    /// What is usual for trochoidal milling. Chosen.
    pub const USUAL: Self = Self(Percent::new(15));

    /// As a part of the diameter.
    #[must_use]
    pub fn part(self) -> f64 {
        self.0.part()
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
        let part = text.parse().ok().filter(|part| (Percent::new(1)..=Percent::new(50)).contains(part));
        part.map(Self).ok_or_else(|| ParseEngagementError(text.to_owned()))
    }
}

impl fmt::Display for Engagement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
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
