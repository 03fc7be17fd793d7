//! The person's machine: what it can do, for times and for what a retract costs.

use std::fmt;
use std::str::FromStr;

use crate::board::Warning;
use crate::board::diagnostic::planning;
use crate::geometry::{Arc, Nm, ParseLengthError, nanometres};

use super::feed::Feed;
use super::program::{Move, Position, Program};

/// How fast an axis comes up to speed, in whole micrometres per second squared; always positive.
///
/// # Range
///
/// 1 µm/s² to 1 km/s².
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Acceleration(i64);

/// Why a text is not an acceleration.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseAccelerationError {
    /// No `/s2` after the length.
    #[error("`{0}` is not an acceleration: expected a length per second squared, such as `50mm/s2`")]
    NoTime(String),
    /// The part before the slash is not a length.
    #[error(transparent)]
    Length(#[from] ParseLengthError),
    /// Zero, negative or beyond a kilometre.
    #[error("`{0}` lies outside 1 µm/s2 to 1 km/s2")]
    OutOfRange(String),
}

impl Acceleration {
    /// `acceleration` millimetres per second squared: for constants.
    ///
    /// # Panics
    ///
    /// For zero and beyond a kilometre per second squared.
    #[must_use]
    pub const fn from_mm_per_s2(acceleration: i64) -> Self {
        assert!(acceleration > 0 && acceleration <= 1_000_000, "within 1 mm/s² and 1 km/s²");
        Self(acceleration * 1_000)
    }

    /// In nanometres per second squared, for estimating time.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "below 2⁵³")]
    pub fn nm_per_s2(self) -> f64 {
        self.0 as f64 * 1000.0
    }
}

impl FromStr for Acceleration {
    type Err = ParseAccelerationError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let text = text.trim();
        let length = ["/s2", "/s^2", "/s²"].iter().find_map(|time| text.strip_suffix(time));
        let length = length.ok_or_else(|| ParseAccelerationError::NoTime(text.to_owned()))?;
        let value = nanometres(length)? / 1000;
        if (1..=1_000_000_000).contains(&value) {
            return Ok(Self(value));
        }
        Err(ParseAccelerationError::OutOfRange(text.to_owned()))
    }
}

/// In millimetres, with no more decimals than it has: `50mm/s2`.
impl fmt::Display for Acceleration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{}.{:03}", self.0 / 1_000, self.0 % 1_000);
        write!(f, "{}mm/s2", text.trim_end_matches('0').trim_end_matches('.'))
    }
}

/// What the machine can do: for the time estimate, for what a retract costs, and for what programs
/// may ask of it.
///
/// Figures for x, y and z are in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Machine {
    /// The speed of each axis in a rapid.
    pub rapid: [Feed; 3],
    /// The most speed of each axis in a feed; none where nobody said so.
    pub feed: Option<[Feed; 3]>,
    /// The acceleration of each axis.
    pub acceleration: [Acceleration; 3],
    /// How far the planner lets a corner be cut in its thoughts: Grbl's `$11`.
    pub junction_deviation: Nm,
    /// The least and the most turns per minute; none where nobody said so.
    pub spindle: Option<(u32, u32)>,
    /// How long the spindle takes to come up to speed, in milliseconds.
    pub spin_up: u32,
    /// How long a change of tools takes a person, in milliseconds.
    pub tool_change: u32,
    /// How far it can go in x, y and z; none where nobody said so.
    pub travel: Option<[Nm; 3]>,
}

/// A small desktop engraver under Grbl. Chosen: the settings that the common 3018 machines are sold
/// with, and Grbl's own junction deviation.
impl Default for Machine {
    fn default() -> Self {
        let [level, vertical] = [1500, 600].map(Feed::from_mm_per_min);
        Self {
            rapid: [level, level, vertical],
            feed: None,
            acceleration: [Acceleration::from_mm_per_s2(50); 3],
            junction_deviation: Nm::from_um(10),
            spindle: None,
            spin_up: 3000,
            tool_change: 60_000,
            travel: None,
        }
    }
}

impl Machine {
    /// The speed of a level rapid whatever its direction: that of the slower axis.
    #[must_use]
    pub fn level_rapid(&self) -> Feed {
        self.rapid[0].min(self.rapid[1])
    }

    /// The acceleration of level motions whatever their direction: that of the slower axis.
    #[must_use]
    pub fn level_acceleration(&self) -> Acceleration {
        self.acceleration[0].min(self.acceleration[1])
    }

    /// Lowers the speeds of a program to what the machine can do, and says so:
    /// `beyond-the-machine-speed`, once for each tool and speed.
    #[must_use]
    pub fn restrain(&self, program: &mut Program) -> Vec<Warning> {
        let mut warnings: Vec<Warning> = Vec::new();
        for section in &mut program.sections {
            let tool = &mut section.tool;
            let name = tool.kind.to_string();
            let mut say = |message: String| {
                if warnings.iter().all(|warning| warning.message != message) {
                    warnings.push(planning::BEYOND_THE_MACHINE_SPEED.warning(message));
                }
            };
            if let Some((least, most)) = self.spindle {
                let within = tool.spindle.clamp(least, most);
                if within != tool.spindle {
                    let wanted = tool.spindle;
                    say(format!(
                        "{name} needs {wanted} rpm, but the spindle runs at {least} to {most} rpm: {within} rpm is used"
                    ));
                    tool.spindle = within;
                }
            }
            let Some([x, y, z]) = self.feed else { continue };
            let level = x.min(y);
            tool.feed = tool.feed.min(level);
            tool.plunge = tool.plunge.min(z);
            let mut before = None;
            for step in &mut section.moves {
                let to = step.to();
                let is_vertical =
                    before.zip(to).is_some_and(|(a, b): (Position, Position)| a.point() == b.point());
                // Down a slope z goes no faster than straight down, of which was told.
                let down = before.map_or(0.0, |from| descent(from, step));
                let slope = if down > 0.0 { z.times(1.0 / down) } else { level };
                if let Move::Feed { feed, .. } | Move::Arc { feed, .. } = step {
                    let (most, way) = if is_vertical { (z, "down") } else { (level, "sideways") };
                    // Up it goes as fast as it can: nobody has asked for a speed.
                    let rises = before.zip(to).is_some_and(|(a, b)| is_vertical && b.z > a.z);
                    if *feed > most && !rises {
                        say(format!(
                            "{name} needs a feed of {feed} {way}, but the machine reaches {most}: that is used"
                        ));
                    }
                    *feed = (*feed).min(most).min(slope);
                }
                before = to.or(before);
            }
        }
        warnings
    }
}

/// How far a move goes down for each unit of its way; zero where it does not.
fn descent(from: Position, step: &Move) -> f64 {
    let along = match *step {
        Move::Feed { to, .. } => from.point().distance(to.point()),
        Move::Arc { to, center, turn, .. } => {
            Arc { start: from.point(), end: to.point(), center, turn }.length()
        }
        Move::Rapid { .. } | Move::Dwell { .. } => return 0.0,
    };
    let down = step.to().map_or(0.0, |to| (from.z - to.z).to_f64().max(0.0));
    if down > 0.0 { down / (along * along + down * down).sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accelerations_carry_length_and_time() {
        for (text, shown) in [("50mm/s2", "50mm/s2"), ("2.5 mm/s^2", "2.5mm/s2"), ("1in/s²", "25.4mm/s2")] {
            let acceleration: Acceleration = text.parse().unwrap();
            assert_eq!(acceleration.to_string(), shown, "{text}");
        }
        for text in ["50", "50mm", "50mm/s", "0mm/s2", "-5mm/s2", "2000000mm/s2", "/s2"] {
            assert!(text.parse::<Acceleration>().is_err(), "{text} was taken for an acceleration");
        }
    }
}
