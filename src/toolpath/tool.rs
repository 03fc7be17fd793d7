//! Tools: the shape of the cutting end, and how each is run.

use std::fmt;
use std::str::FromStr;

use crate::geometry::{Nm, ParseLengthError};

use super::angle::{Angle, ParseAngleError};
use super::drill_speed::DrillSpeeds;
use super::feed::Feed;

/// What a tool's cutting end looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ToolKind {
    /// A cone with a flat end: the deeper, the wider the kerf.
    ///
    /// ```text
    ///   \      |angle|      /
    ///    \                 /   width at depth d = tip + 2 d tan(angle / 2)
    ///     \_______________/
    ///           tip
    /// ```
    VBit {
        /// The width of the flat end.
        tip: Nm,
        /// The full angle between the two flanks; more than 0°, less than 180°.
        angle: Angle,
    },
    /// A cylinder that cuts with its end and its sides.
    EndMill {
        /// Its diameter.
        diameter: Nm,
    },
    /// A twist drill: it goes down and up, never sideways.
    Drill {
        /// Its diameter.
        diameter: Nm,
    },
}

/// A tool and how it is run.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Tool {
    /// What the settings or the user call it.
    pub name: String,
    /// Its shape.
    pub kind: ToolKind,
    /// The number in the machine's tool table, from 1.
    pub number: u32,
    /// The speed sideways.
    pub feed: Feed,
    /// The speed downwards into material.
    pub plunge: Feed,
    /// Revolutions per minute.
    pub spindle: u32,
    /// The full angle of a drill's tip; more than 0°, less than 180°. Other tools have none.
    pub point: Angle,
}

/// The tip of a common twist drill. DIN 1412's type N.
pub const POINT: Angle = Angle::from_degrees(118);

/// The tip of a solid carbide drill for boards, as their makers state it.
pub const CARBIDE_POINT: Angle = Angle::from_degrees(130);

/// Why a text is not a tool.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseToolError {
    /// No known kind before the first colon, or too many or too few fields after it.
    #[error(
        "`{0}` is not a tool: expected vbit:TIP:ANGLE, endmill:DIAMETER or drill:DIAMETER, such as `vbit:0.1mm:30deg`"
    )]
    Form(String),
    /// A length that cannot be read.
    #[error("in the tool `{tool}`: {reason}")]
    Length {
        /// The whole text.
        tool: String,
        /// What is wrong with the length.
        reason: ParseLengthError,
    },
    /// An angle that cannot be read.
    #[error("in the tool `{tool}`: {reason}")]
    Angle {
        /// The whole text.
        tool: String,
        /// What is wrong with the angle.
        reason: ParseAngleError,
    },
    /// A size that no tool has.
    #[error("in the tool `{tool}`: {expected}")]
    Size {
        /// The whole text.
        tool: String,
        /// What was expected.
        expected: &'static str,
    },
}

/// No end mill or drill is finer. Chosen: below the finest that are sold, a unit is mistaken.
const FINEST: Nm = Nm::from_um(10);

impl ToolKind {
    /// The width of the groove that it cuts at `depth` below the surface.
    #[must_use]
    pub fn width_at(&self, depth: Nm) -> Nm {
        match *self {
            Self::VBit { tip, angle } => tip + Nm::from_f64(2.0 * slope(angle) * depth.to_f64()),
            Self::EndMill { diameter } | Self::Drill { diameter } => diameter,
        }
    }

    /// How much wider it cuts on either side for each unit of depth: the tangent of half a V-bit's
    /// angle, and zero for other tools.
    #[must_use]
    pub fn flank(&self) -> f64 {
        match *self {
            Self::VBit { angle, .. } => slope(angle),
            Self::EndMill { .. } | Self::Drill { .. } => 0.0,
        }
    }

    /// How deep it must go to cut a groove of `width`; none where no depth gives it.
    #[must_use]
    pub fn depth_for(&self, width: Nm) -> Option<Nm> {
        match *self {
            Self::VBit { tip, angle } => {
                (width >= tip).then(|| Nm::from_f64((width - tip).to_f64() / (2.0 * slope(angle))))
            }
            Self::EndMill { diameter } | Self::Drill { diameter } => (width == diameter).then_some(Nm::ZERO),
        }
    }

    /// Checks that a tool can have this size; the error says what was expected.
    ///
    /// # Errors
    ///
    /// For a diameter below a hundredth of a millimetre, a negative tip, and an angle outside 0° to
    /// 180°.
    pub fn check(&self) -> Result<(), &'static str> {
        match *self {
            Self::VBit { tip, .. } if tip < Nm::ZERO => Err("expected a tip that is not negative"),
            Self::VBit { angle, .. } if angle <= Angle::ZERO || angle >= Angle::from_degrees(180) => {
                Err("expected an angle between 0deg and 180deg")
            }
            Self::EndMill { diameter } | Self::Drill { diameter } if diameter < FINEST => {
                Err("expected a diameter of 0.01 mm or more")
            }
            Self::VBit { .. } | Self::EndMill { .. } | Self::Drill { .. } => Ok(()),
        }
    }
}

impl Tool {
    /// A tool of this kind with a name after it, number 1 and careful speeds for copper-clad FR4.
    ///
    /// Chosen: what makers of small engravers state for their bits, at the lower end.
    #[must_use]
    pub fn new(kind: ToolKind) -> Self {
        let speeds = |feed, plunge| (Feed::from_mm_per_min(feed), Feed::from_mm_per_min(plunge), 12_000);
        let (feed, plunge, spindle) = match kind {
            ToolKind::VBit { .. } => speeds(200, 100),
            ToolKind::EndMill { .. } => speeds(150, 60),
            ToolKind::Drill { diameter } => {
                let (plunge, spindle) = DrillSpeeds::default().of(diameter);
                (plunge, plunge, spindle)
            }
        };
        Self { name: kind.to_string(), kind, number: 1, feed, plunge, spindle, point: POINT }
    }

    /// How far its tip reaches below the place from which on it cuts its full width: a drill's
    /// cone.
    ///
    /// ```text
    ///   │  d  │
    ///   ├╌╌╌╌╌┤  ┐
    ///    ╲   ╱   │ d / 2 / tan(point / 2)
    ///      V     ┘
    /// ```
    #[must_use]
    pub fn tip_length(&self) -> Nm {
        match self.kind {
            ToolKind::Drill { diameter } => Nm::from_f64(diameter.to_f64() / 2.0 / slope(self.point)),
            ToolKind::VBit { .. } | ToolKind::EndMill { .. } => Nm::ZERO,
        }
    }

    /// The width of the groove that it cuts at `depth` below the surface: the kerf.
    #[must_use]
    pub fn width_at(&self, depth: Nm) -> Nm {
        self.kind.width_at(depth)
    }

    /// The narrowest that it cuts at `depth`, where it may rise to no less than `least`, if that is
    /// said.
    #[must_use]
    pub fn least_width(&self, depth: Nm, least: Option<Nm>) -> Nm {
        self.width_at(least.unwrap_or(depth).min(depth))
    }

    /// How deep it must go to cut a groove of `width`; none where no depth gives it. An end mill
    /// cuts its one width at any depth, of which the least is returned.
    #[must_use]
    pub fn depth_for(&self, width: Nm) -> Option<Nm> {
        self.kind.depth_for(width)
    }
}

/// The tangent of half the angle: how fast a flank goes outwards.
fn slope(angle: Angle) -> f64 {
    libm::tan(angle.radians() / 2.0)
}

/// A length with no more decimals than it has: `0.1mm`.
fn short(length: Nm) -> String {
    let text = length.to_string();
    format!("{}mm", text.trim_end_matches('0').trim_end_matches('.'))
}

/// As the command line takes it: `vbit:0.1mm:30deg`.
impl fmt::Display for ToolKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::VBit { tip, angle } => write!(f, "vbit:{}:{angle}", short(tip)),
            Self::EndMill { diameter } => write!(f, "endmill:{}", short(diameter)),
            Self::Drill { diameter } => write!(f, "drill:{}", short(diameter)),
        }
    }
}

impl FromStr for ToolKind {
    type Err = ParseToolError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let length = |field: &str| {
            field.parse().map_err(|reason| ParseToolError::Length { tool: text.to_owned(), reason })
        };
        let fields: Vec<&str> = text.trim().split(':').collect();
        let kind = match fields.as_slice() {
            ["vbit", tip, angle] => Self::VBit {
                tip: length(tip)?,
                angle: angle
                    .parse()
                    .map_err(|reason| ParseToolError::Angle { tool: text.to_owned(), reason })?,
            },
            ["endmill", diameter] => Self::EndMill { diameter: length(diameter)? },
            ["drill", diameter] => Self::Drill { diameter: length(diameter)? },
            _ => return Err(ParseToolError::Form(text.to_owned())),
        };
        kind.check().map_err(|expected| ParseToolError::Size { tool: text.to_owned(), expected })?;
        Ok(kind)
    }
}

impl FromStr for Tool {
    type Err = ParseToolError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.parse().map(Self::new)
    }
}

/// The tools that `voromill tools` lists before the user's own: name and what it is.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("engraver", "vbit:0.1mm:30deg"),
    ("fine-engraver", "vbit:0.1mm:10deg"),
    ("isolator", "endmill:0.2mm"),
    ("clearer", "endmill:0.8mm"),
    ("router", "endmill:2mm"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_v_bit_is_wider_the_deeper_it_goes_and_depth_undoes_width() {
        let tool: Tool = "vbit:0.1mm:30deg".parse().unwrap();
        assert_eq!(tool.width_at(Nm::ZERO), Nm::from_um(100), "the tip at the surface");
        let width = tool.width_at(Nm::from_um(100));
        assert_eq!(width, Nm::new(153_590), "0.1 + 2 · 0.1 · tan 15°");
        assert_eq!(tool.depth_for(width), Some(Nm::from_um(100)), "and back");
        assert_eq!(tool.depth_for(Nm::from_um(99)), None, "narrower than its tip");
    }

    #[test]
    fn a_drills_tip_is_longer_the_thicker_and_the_sharper_it_is() {
        let tip = |text: &str, point| Tool { point, ..text.parse().unwrap() }.tip_length();
        // 0.5 mm / tan 59° and tan 65°, 1.6 mm / tan 59°.
        assert_eq!(tip("drill:1mm", POINT), Nm::new(300_430), "118 degrees");
        assert_eq!(tip("drill:1mm", CARBIDE_POINT), Nm::new(233_154), "130 degrees");
        assert_eq!(tip("drill:3.2mm", POINT), Nm::new(961_377), "of a thick one");
        assert_eq!(tip("endmill:1mm", POINT), Nm::ZERO, "an end mill is flat");
    }

    #[test]
    fn tools_are_written_as_they_are_read() {
        for (_, text) in BUILT_IN {
            assert_eq!(text.parse::<Tool>().unwrap().kind.to_string(), *text, "there and back");
        }
    }

    #[test]
    fn nonsense_is_refused() {
        for text in [
            "",
            "vbit",
            "vbit:0.1mm",
            "vbit:0.1:30deg",
            "vbit:0.1mm:0deg",
            "vbit:-1mm:30deg",
            "endmill:0mm",
            "endmill:1mm:2mm",
            "saw:3mm",
            "vbit:0.1mm:180deg",
        ] {
            assert!(text.parse::<Tool>().is_err(), "{text} was taken for a tool");
        }
    }
}
