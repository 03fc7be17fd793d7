//! What reports are made of: lengths, places and counts, as data and as words.

use serde::Serialize;

use crate::geometry::{Nm, Point};

/// The version of the shape of a [`Document`](super::Document): it grows when a key changes its
/// meaning or goes, not when one is added.
pub const SCHEMA_VERSION: u32 = 2;

/// A length in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Millimetres(pub Nm);

/// As a number with at most six decimals, exactly.
impl Serialize for Millimetres {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.0.to_mm())
    }
}

/// A place on the board.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Place {
    /// To the right.
    pub x_mm: Millimetres,
    /// Up.
    pub y_mm: Millimetres,
}

impl From<Point> for Place {
    fn from(point: Point) -> Self {
        Self { x_mm: Millimetres(point.x), y_mm: Millimetres(point.y) }
    }
}

/// As JSON text, indented, ended by a line feed.
pub(super) fn json(value: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(value).expect("reports have string keys and finite numbers");
    text.push('\n');
    text
}
