use std::fmt;
use std::str::FromStr;

use crate::geometry::Nm;

/// What a tool cuts: how wide at which depth.
///
/// Written as everywhere on the command line: `vbit:0.1mm:30deg`, `endmill:0.2mm`, `drill:0.8mm`. Judging is kept apart
/// from planning, so this is not the planner's tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutter {
    /// What it is called.
    pub kind: CutterKind,
    /// Its width at the tip.
    pub tip: Nm,
    /// The full angle between its flanks in degrees; zero for a cylinder.
    pub degrees: f64,
}

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
    "`{0}` is not a tool: expected vbit:TIP:ANGLE, endmill:DIAMETER or drill:DIAMETER, such as `vbit:0.1mm:30deg`"
)]
pub struct ParseCutterError(String);

impl Cutter {
    /// The width of the groove that it cuts at `depth` below the surface.
    #[must_use]
    pub fn width_at(&self, depth: Nm) -> Nm {
        let half = self.degrees / 360.0 * std::f64::consts::PI;
        self.tip + Nm::from_f64(2.0 * libm::tan(half) * depth.to_f64().max(0.0))
    }
}

impl FromStr for Cutter {
    type Err = ParseCutterError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let wrong = || ParseCutterError(text.to_owned());
        let length =
            |field: &str| field.parse::<Nm>().ok().filter(|&length| length >= Nm::ZERO).ok_or_else(wrong);
        let fields: Vec<&str> = text.trim().split(':').collect();
        let cutter = match fields.as_slice() {
            ["vbit", tip, angle] => {
                let degrees = angle.strip_suffix("deg").and_then(|number| number.parse().ok());
                let degrees = degrees.filter(|degrees: &f64| *degrees > 0.0 && *degrees < 180.0);
                Self { kind: CutterKind::VBit, tip: length(tip)?, degrees: degrees.ok_or_else(wrong)? }
            }
            ["endmill", diameter] => Self { kind: CutterKind::EndMill, tip: length(diameter)?, degrees: 0.0 },
            ["drill", diameter] => Self { kind: CutterKind::Drill, tip: length(diameter)?, degrees: 0.0 },
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
            CutterKind::Drill => write!(f, "drill:{tip}mm"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cutters_are_read_as_they_are_written() {
        for text in ["vbit:0.1mm:30deg", "endmill:0.2mm", "drill:0.8mm"] {
            assert_eq!(text.parse::<Cutter>().expect(text).to_string(), text, "there and back");
        }
        for text in ["", "vbit:0.1mm", "endmill:0mm", "vbit:0.1mm:180deg", "saw:1mm", "endmill:-1mm"] {
            assert!(text.parse::<Cutter>().is_err(), "{text} was taken for a tool");
        }
    }

    #[test]
    fn a_v_bit_is_wider_the_deeper_it_goes() {
        let cutter: Cutter = "vbit:0.1mm:30deg".parse().expect("a tool");
        assert_eq!(cutter.width_at(Nm::from_um(100)), Nm::new(153_590), "0.1 + 2 · 0.1 · tan 15°");
    }
}
