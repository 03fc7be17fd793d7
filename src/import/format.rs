//! The formats of layers and boards, told by content.

use super::{excellon, gerber, kicad};

/// A format of files that are layers of a board, or all of it. Drawings have
/// [`drawing::FORMATS`](super::drawing::FORMATS).
pub struct Format {
    /// What reports call it.
    pub name: &'static str,
    pub(super) kind: Kind,
    looks_like: fn(&[u8]) -> bool,
}

/// Every format, a folder each, in the order in which a file is asked whether it is one.
pub const FORMATS: &[Format] = &[
    Format { name: "kicad-pcb", kind: Kind::Kicad, looks_like: kicad::looks_like },
    Format { name: "excellon", kind: Kind::Excellon, looks_like: excellon::looks_like },
    Format { name: "gerber", kind: Kind::Gerber, looks_like: gerber::looks_like },
];

/// What kind of file it is, by content.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Gerber.
    Gerber,
    /// Excellon.
    Excellon,
    /// A KiCad board, which has all layers.
    Kicad,
    /// Neither.
    Unknown,
}

impl Kind {
    /// Looks at the content.
    pub(super) fn of(bytes: &[u8]) -> Self {
        let format = FORMATS.iter().find(|format| (format.looks_like)(bytes));
        format.map_or(Self::Unknown, |format| format.kind)
    }

    /// What reports call it.
    pub(super) fn name(self) -> &'static str {
        FORMATS.iter().find(|format| format.kind == self).map_or("unknown", |format| format.name)
    }
}
