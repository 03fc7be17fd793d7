//! What there is to tell of a layer whose lines are closed, in the words of what it is read for.

use crate::board::{Diagnostic, Warning};
use crate::geometry::{Nm, Point};
use crate::import::diagnostic;
use crate::import::error::{last_line, line, locate};

/// What the lines of a layer are to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
    /// The edge of a board and its cut-outs.
    Board,
    /// Shapes that are milled.
    Drawing,
}

/// Warnings about one layer.
pub(super) struct Notes<'a> {
    reading: Reading,
    file: &'a str,
    bytes: &'a [u8],
    /// The line of the file that drew a point first, by point.
    lines: Vec<(Point, u32)>,
    pub(super) warnings: Vec<Warning>,
}

impl<'a> Notes<'a> {
    /// None yet, about the file `file` with content `bytes`.
    pub(super) const fn new(reading: Reading, file: &'a str, bytes: &'a [u8]) -> Self {
        Self { reading, file, bytes, lines: Vec::new(), warnings: Vec::new() }
    }

    /// So many gaps were closed, the widest at a place.
    pub(super) fn closed_gaps(&mut self, closed: u32, width: Nm, widest: (Point, u32)) {
        let (kind, one, many) = match self.reading {
            Reading::Board => (&diagnostic::OUTLINE_GAP, "in the outline", "of the outline"),
            Reading::Drawing => (&diagnostic::DRAWING_GAP, "between lines", "between lines"),
        };
        let message = match closed {
            1 => format!("a gap of {width:.3} mm {one} is closed"),
            _ => format!("{closed} gaps {many} are closed, the widest of {width:.3} mm"),
        };
        self.add(kind, message, Some(widest));
    }

    /// So many ends were joined to the middle of another line, the farthest at a place.
    pub(super) fn joined_to_middles(&mut self, joined: usize, width: Nm, farthest: (Point, u32)) {
        let (kind, of) = match self.reading {
            Reading::Board => (&diagnostic::OUTLINE_GAP, "of the outline"),
            Reading::Drawing => (&diagnostic::DRAWING_GAP, "of lines"),
        };
        let message = format!(
            "{joined} ends {of} that nearly touch the middle of another line are joined to it, the farthest by {width:.3} mm"
        );
        self.add(kind, message, Some(farthest));
    }

    /// So many lines, so long in all, are part of nothing that closes.
    pub(super) fn left_open(&mut self, count: usize, length: Nm, place: (Point, u32)) {
        let (kind, message) = match self.reading {
            Reading::Board => (
                &diagnostic::OUTLINE_LOOSE_LINES,
                format!(
                    "{count} lines of the outline layer, {length:.1} mm in all, belong to no closed contour and are ignored"
                ),
            ),
            Reading::Drawing => {
                let message = match count {
                    1 => format!("1 line, {length:.1} mm long, is not closed: it is not milled"),
                    _ => format!("{count} lines, {length:.1} mm in all, are not closed: they are not milled"),
                };
                (&diagnostic::DRAWING_LINES_OPEN, message)
            }
        };
        self.add(kind, message, Some(place));
    }

    /// Lines touch or cross within what they enclose together.
    pub(super) fn parted(&mut self, place: Option<(Point, u32)>) {
        let (kind, message) = match self.reading {
            Reading::Board => (
                &diagnostic::OUTLINE_PARTED,
                "lines inside the outline touch it; only its outer edge is used",
            ),
            Reading::Drawing => (
                &diagnostic::DRAWING_LINES_TOUCH,
                "closed lines touch or cross each other; only the outer edge of what they enclose together is used",
            ),
        };
        self.add(kind, message, place);
    }

    /// Without a place, the file as a whole is meant.
    pub(super) fn add(
        &mut self,
        diagnostic: &'static Diagnostic,
        message: impl Into<String>,
        place: Option<(Point, u32)>,
    ) {
        let warning = diagnostic.warning(message);
        let (warning, bytes) = match place {
            Some((at, number)) => (warning.at(at), line(self.bytes, number)),
            None => (warning, last_line(self.bytes)),
        };
        self.warnings.push(warning.caused_by(locate(self.file, self.bytes, bytes)));
    }

    /// Each point that was drawn, in order, with its line.
    pub(super) fn drawn(&mut self, lines: Vec<(Point, u32)>) {
        self.lines = lines;
        self.lines.sort_by_key(|(p, _)| *p);
        self.lines.dedup_by_key(|(p, _)| *p);
    }

    /// Whether `at` is such a point.
    pub(super) fn has_drawn(&self, at: Point) -> bool {
        self.lines.binary_search_by_key(&at, |(p, _)| *p).is_ok()
    }

    /// `at`, with the line that drew it; a point that crossing lines made is on the line of one
    /// beside it.
    pub(super) fn place(&self, at: Point) -> Option<(Point, u32)> {
        let next = self.lines.partition_point(|(p, _)| *p < at);
        let drawn = self.lines.get(next).or_else(|| self.lines.last());
        drawn.map(|&(_, line)| (at, line))
    }
}
