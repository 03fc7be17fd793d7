//! A name for what a file says, whatever it says it with: a hash of what was read.
//!
//! KiCad writes the date into every file, so a file's own hash changes with each export though the
//! board does not. The programs name their inputs by this hash instead: the same design gives the
//! same programs, and a program can be told from one of another revision.
//!
//! Hashed are numbers of eight bytes, lowest first, and texts with their lengths before them, in
//! this order:
//!
//! * of a Gerber file, for each feature in file order, with polarity, macros and repeats resolved:
//!   its shape with all coordinates in nanometres, its axis, and the texts of its net, component,
//!   pin and function;
//! * of a drill file, for each hole in file order: its path, its diameter, its plating and its
//!   tool's number;
//! * of an aperture list: the number and the shape of each aperture;
//! * of a KiCad board: the hashes, as such, of its front, its back, its edge and its holes.
//!
//! So comments, dates, units, number formats, line ends and names of apertures do not count.
//! Another version of this program may flatten curves otherwise and hash to something else.

use sha2::{Digest, Sha256};

use crate::board::{Attributes, Axis, Feature, Hole, Plating, Shape};
use crate::geometry::{Arc, Nm, Path, Point, Segment, Turn};

use super::digest::hexadecimal;

/// The hash of what a Gerber file draws.
pub(super) fn of_features(features: &[Feature], attributes: &[Attributes]) -> String {
    let mut design = Design::default();
    for feature in features {
        design.feature(feature);
        if let Some(set) = attributes.get(feature.attributes as usize) {
            for text in [&set.net, &set.component, &set.pin, &set.function] {
                design.text(text.as_deref());
            }
        }
    }
    design.finish()
}

/// The hash of what a drill file drills.
pub(super) fn of_holes(holes: &[Hole]) -> String {
    let mut design = Design::default();
    for hole in holes {
        design.path(&hole.path);
        design.length(hole.diameter);
        design.number(match hole.plating {
            Plating::Plated => 0,
            Plating::NonPlated => 1,
            Plating::Unknown => 2,
        });
        design.number(hole.tool.into());
    }
    design.finish()
}

/// The hash of numbered texts.
pub(super) fn of_texts<'a>(texts: impl Iterator<Item = (u32, &'a str)>) -> String {
    let mut design = Design::default();
    for (number, text) in texts {
        design.number(number.into());
        design.text(Some(text));
    }
    design.finish()
}

/// A hash in the making.
#[derive(Default)]
struct Design(Sha256);

impl Design {
    fn number(&mut self, number: i64) {
        self.0.update(number.to_le_bytes());
    }

    fn text(&mut self, text: Option<&str>) {
        self.number(text.map_or(-1, |text| i64::try_from(text.len()).unwrap_or(i64::MAX)));
        self.0.update(text.unwrap_or_default());
    }

    fn length(&mut self, length: Nm) {
        self.number(length.get());
    }

    fn point(&mut self, point: Point) {
        self.length(point.x);
        self.length(point.y);
    }

    fn arc(&mut self, arc: &Arc) {
        [arc.start, arc.end, arc.center].into_iter().for_each(|point| self.point(point));
        self.turn(arc.turn);
    }

    fn turn(&mut self, turn: Turn) {
        self.number(match turn {
            Turn::Clockwise => 0,
            Turn::CounterClockwise => 1,
        });
    }

    fn path(&mut self, path: &Path) {
        self.point(path.start);
        for segment in &path.segments {
            match *segment {
                Segment::Line { to } => {
                    self.number(1);
                    self.point(to);
                }
                Segment::Arc { to, center, turn } => {
                    self.number(2);
                    self.point(to);
                    self.point(center);
                    self.turn(turn);
                }
            }
        }
        self.number(0);
    }

    fn feature(&mut self, feature: &Feature) {
        match &feature.shape {
            Shape::Disc { center, radius } => {
                self.number(0);
                self.point(*center);
                self.length(*radius);
            }
            Shape::Stroke { from, to, radius } => {
                self.number(1);
                self.point(*from);
                self.point(*to);
                self.length(*radius);
            }
            Shape::Arc { arc, radius } => {
                self.number(2);
                self.arc(arc);
                self.length(*radius);
            }
            Shape::Polygon(polygon) => {
                self.number(3);
                for contour in polygon.contours() {
                    self.number(i64::try_from(contour.len()).unwrap_or(i64::MAX));
                    contour.iter().for_each(|&point| self.point(point));
                }
                self.number(0);
            }
        }
        match &feature.axis {
            Axis::Flash(at) => {
                self.number(0);
                self.point(*at);
            }
            Axis::Line(from, to) => {
                self.number(1);
                self.point(*from);
                self.point(*to);
            }
            Axis::Arc(arc) => {
                self.number(2);
                self.arc(arc);
            }
            Axis::Region => self.number(3),
        }
    }

    fn finish(self) -> String {
        hexadecimal(&self.0.finalize())
    }
}
