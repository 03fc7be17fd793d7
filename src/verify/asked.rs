//! What programs were asked to clear of the copper beside the cuts that isolate: told, or as their
//! headers say.

use crate::board::Copper;
use crate::geometry::{Nm, Point, Polygon, Rect, Vector};
use crate::topology::{NetId, Nets, Pattern, called};

use super::declared::{declared_list, declared_setting};

/// What was to be cleared of a side, in the files' coordinates.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Asked {
    /// Whether all of the board was.
    pub everything: bool,
    /// Where all was.
    pub areas: Vec<Polygon>,
    /// Nets whose regions were: what is nearer to them than to any other.
    pub nets: Vec<Pattern>,
    /// Nets from which all other copper was to be as far.
    pub distances: Vec<(Pattern, Nm)>,
    /// Where nothing was.
    pub kept: Vec<Polygon>,
    /// How far cuts may be from where they should be.
    pub tolerance: Nm,
    /// Files of areas that the header names and nobody has given: what they cover is unknown.
    pub unread: Vec<String>,
}

impl Asked {
    /// Whether anything was.
    #[must_use]
    pub const fn is_something(&self) -> bool {
        self.everything || !self.areas.is_empty() || !self.nets.is_empty() || !self.distances.is_empty()
    }

    /// What a program says of itself.
    pub(super) fn declared(text: &str) -> Self {
        let all = |setting| declared_list(text, setting).into_iter();
        let one = |setting| declared_setting(text, setting).unwrap_or_default();
        let rectangles = |setting| all(setting).filter_map(|text| rectangle(&text)).collect();
        let unread = ["clear-area", "keep-area"].into_iter().flat_map(all);
        let distance = |text: String| {
            let (nets, distance) = text.rsplit_once('=')?;
            Some((pattern(nets), distance.parse().ok()?))
        };
        Self {
            everything: one("clear") == "true",
            areas: rectangles("clear-area"),
            nets: all("clear-nets").map(|text| pattern(&text)).collect(),
            distances: all("distance-for").filter_map(distance).collect(),
            kept: rectangles("keep-area"),
            tolerance: one("tolerance").parse().unwrap_or_default(),
            unread: unread.filter(|text| rectangle(text).is_none()).collect(),
        }
    }

    /// What this or `other` asks for.
    pub(super) fn and(mut self, other: &Self) -> Self {
        // Programs of one side say the same.
        if self != *other {
            self.everything |= other.everything;
            self.areas.extend_from_slice(&other.areas);
            self.nets.extend_from_slice(&other.nets);
            self.distances.extend_from_slice(&other.distances);
            self.kept.extend_from_slice(&other.kept);
            self.tolerance = self.tolerance.max(other.tolerance);
            self.unread.extend_from_slice(&other.unread);
        }
        self
    }

    /// The same on each of several boards, so far away.
    pub(super) fn repeated(self, ways: &[Vector]) -> Self {
        let all = |areas: &[Polygon]| -> Vec<Polygon> {
            ways.iter().flat_map(|&way| areas.iter().map(move |area| area.translated(way))).collect()
        };
        Self { areas: all(&self.areas), kept: all(&self.kept), ..self }
    }
}

/// The nets that one of `patterns` means, rising.
pub(super) fn meant<'a>(
    patterns: impl Iterator<Item = &'a Pattern> + Clone,
    copper: &Copper,
    nets: &Nets,
) -> Vec<NetId> {
    let is_meant = |id: &NetId| {
        let names = called(copper, nets, *id);
        patterns.clone().any(|pattern| pattern.matches_any(&names))
    };
    (0..).map(NetId).take(nets.nets().len()).filter(is_meant).collect()
}

fn pattern(text: &str) -> Pattern {
    let Ok(pattern) = text.parse();
    pattern
}

/// A rectangle as `X,Y,W,H`.
fn rectangle(text: &str) -> Option<Polygon> {
    let lengths: Option<Vec<Nm>> = text.split(',').map(|length| length.parse().ok()).collect();
    let [x, y, width, height] = lengths?[..] else { return None };
    let corner = Point::new(x, y);
    Some(Polygon::rectangle(Rect::new(corner, corner + Vector::new(width, height))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_says_what_was_asked_for() {
        let text = "(x front isolation)\n(clear-area -1mm,2mm,3mm,4mm 1mm,1mm,2mm,2mm)\n(clear-nets HV^2A VCC^5E205V)\n\
                    (distance-for HV^3F=6mm GND=1mm)\n(tolerance 0.002mm)\n";
        let asked = Asked::declared(text);
        assert!(asked.is_something() && !asked.everything, "{asked:?}");
        assert_eq!(asked.areas.len(), 2, "two areas");
        assert_eq!(asked.areas[0].bounds().max(), Point::new(Nm::from_mm(2), Nm::from_mm(6)), "the first");
        assert_eq!(asked.nets, [pattern("HV*"), pattern("VCC 5V")], "patterns");
        assert_eq!(asked.distances, [(pattern("HV?"), Nm::from_mm(6)), (pattern("GND"), Nm::from_mm(1))]);
        assert!(Asked::declared("(clear true)\nG21\n").everything, "all");
        assert!(!Asked::declared("G21\n").is_something(), "nothing");
    }
}
