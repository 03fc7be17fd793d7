//! What a tool cuts, as the judge sees it: kept apart from the planner's tool on purpose.

use std::fmt;
use std::str::FromStr;

use crate::geometry::Nm;

/// What a tool cuts: how wide at which depth.
///
/// Written as everywhere on the command line: `vbit:0.1mm:30deg`, `endmill:0.2mm`, `drill:0.8mm`.
/// Judging is kept apart from planning, so this is not the planner's tool, nor is it read by the
/// planner's parser: whether an angle is the full one or half of it is just what a judge must not
/// take over. It may have an angle at the point, too, which the planner's drills have elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutter {
    /// What it is called.
    pub kind: CutterKind,
    /// Its width at the tip.
    pub tip: Nm,
    /// The full angle in degrees between the flanks of a V-bit, or at the point of a drill; zero
    /// for an end mill.
    pub degrees: f64,
}

/// The part of a tool that mills: a cone on a flat tip, or a cylinder. In nanometres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cone {
    /// Half the width of the tip.
    pub(super) blunt: f64,
    /// How much wider it is on either side for each unit of height; zero for a cylinder.
    pub(super) flank: f64,
}

/// The angle at the point of a twist drill of steel that nobody said more of (DIN 1897, type N);
/// drills of carbide have 130°.
const POINT: f64 = 118.0;

/// What a tool is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutterKind {
    /// A cone.
    VBit,
    /// A cylinder that cuts sideways.
    EndMill,
    /// A cylinder that goes down and up.
    Drill,
}

/// A text that is not a tool.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not a tool: expected vbit:TIP:ANGLE, endmill:DIAMETER, drill:DIAMETER or drill:DIAMETER:POINT, such as `vbit:0.1mm:30deg`"
)]
pub struct ParseCutterError(String);

impl Cutter {
    /// The width of the groove that it cuts at `depth` below the surface.
    #[must_use]
    pub fn width_at(&self, depth: Nm) -> Nm {
        match self.kind {
            CutterKind::VBit => self.tip + Nm::from_f64(2.0 * self.slope() * depth.to_f64().max(0.0)),
            CutterKind::EndMill | CutterKind::Drill => self.tip,
        }
    }

    /// How far the point of a drill reaches below where it has its full diameter.
    #[must_use]
    pub fn point(&self) -> Nm {
        match self.kind {
            CutterKind::Drill => Nm::from_f64(self.tip.to_f64() / 2.0 / self.slope()),
            CutterKind::VBit | CutterKind::EndMill => Nm::ZERO,
        }
    }

    /// The same with a point of this angle, where it is a drill that nobody said more of, and the
    /// angle one that a point can have.
    pub(super) fn pointed(self, degrees: f64) -> Self {
        let is_usual = self.kind == CutterKind::Drill && (self.degrees - POINT).abs() < 1e-9;
        if is_usual && degrees > 0.0 && degrees < 180.0 { Self { degrees, ..self } } else { self }
    }

    /// What of it mills.
    pub(super) fn cone(&self) -> Cone {
        let flank = match self.kind {
            CutterKind::VBit => self.slope(),
            CutterKind::EndMill | CutterKind::Drill => 0.0,
        };
        Cone { blunt: self.tip.to_f64() / 2.0, flank }
    }

    /// How much wider its cone is on one side for a depth of one.
    fn slope(&self) -> f64 {
        libm::tan(self.degrees / 360.0 * std::f64::consts::PI)
    }
}

impl Cone {
    /// One as wide as both.
    pub(super) const fn and(self, other: Self) -> Self {
        Self { blunt: self.blunt.max(other.blunt), flank: self.flank.max(other.flank) }
    }

    /// How deep a tool whose tip is at a depth mills so far off its axis.
    pub(super) const fn below(&self, depth: f64, off: f64) -> f64 {
        let beyond = (off - self.blunt).max(0.0);
        if self.flank > 0.0 {
            depth - beyond / self.flank
        } else if beyond > 0.0 {
            f64::NEG_INFINITY
        } else {
            depth
        }
    }
}

impl FromStr for Cutter {
    type Err = ParseCutterError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let wrong = || ParseCutterError(text.to_owned());
        let length =
            |field: &str| field.parse::<Nm>().ok().filter(|&length| length >= Nm::ZERO).ok_or_else(wrong);
        let angle = |field: &str| {
            let degrees = field.strip_suffix("deg").and_then(|number| number.parse().ok());
            degrees.filter(|degrees: &f64| *degrees > 0.0 && *degrees < 180.0).ok_or_else(wrong)
        };
        let fields: Vec<&str> = text.trim().split(':').collect();
        let cutter = match fields.as_slice() {
            ["vbit", tip, degrees] => {
                Self { kind: CutterKind::VBit, tip: length(tip)?, degrees: angle(degrees)? }
            }
            ["endmill", diameter] => Self { kind: CutterKind::EndMill, tip: length(diameter)?, degrees: 0.0 },
            ["drill", diameter] => Self { kind: CutterKind::Drill, tip: length(diameter)?, degrees: POINT },
            ["drill", diameter, point] => {
                Self { kind: CutterKind::Drill, tip: length(diameter)?, degrees: angle(point)? }
            }
            _ => return Err(wrong()),
        };
        if cutter.kind != CutterKind::VBit && cutter.tip <= Nm::ZERO {
            return Err(wrong());
        }
        Ok(cutter)
    }
}

impl fmt::Display for Cutter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = self.tip.to_string();
        let tip = text.trim_end_matches('0').trim_end_matches('.');
        match self.kind {
            CutterKind::VBit => write!(f, "vbit:{tip}mm:{}deg", self.degrees),
            CutterKind::EndMill => write!(f, "endmill:{tip}mm"),
            CutterKind::Drill if (self.degrees - POINT).abs() < 1e-9 => write!(f, "drill:{tip}mm"),
            CutterKind::Drill => write!(f, "drill:{tip}mm:{}deg", self.degrees),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cutters_are_read_as_they_are_written() {
        for text in ["vbit:0.1mm:30deg", "endmill:0.2mm", "drill:0.8mm", "drill:0.8mm:130deg"] {
            assert_eq!(text.parse::<Cutter>().expect(text).to_string(), text, "there and back");
        }
        for text in ["", "vbit:0.1mm", "endmill:0mm", "vbit:0.1mm:180deg", "saw:1mm", "endmill:-1mm"] {
            assert!(text.parse::<Cutter>().is_err(), "{text} was taken for a tool");
        }
    }

    #[test]
    fn the_point_of_a_drill_is_a_cone_below_its_full_diameter() {
        let point = |text: &str| text.parse::<Cutter>().expect("a tool").point();
        assert_eq!(point("drill:1mm"), Nm::new(300_430), "0.5 / tan 59°");
        assert_eq!(point("drill:1mm:130deg"), Nm::new(233_154), "0.5 / tan 65°");
        assert_eq!(point("endmill:1mm"), Nm::ZERO, "flat");
    }

    #[test]
    fn a_v_bit_is_wider_the_deeper_it_goes() {
        let cutter: Cutter = "vbit:0.1mm:30deg".parse().expect("a tool");
        assert_eq!(cutter.width_at(Nm::from_um(100)), Nm::new(153_590), "0.1 + 2 · 0.1 · tan 15°");
    }
}
