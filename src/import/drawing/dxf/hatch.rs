//! Hatches: areas whose boundaries are polylines or chains of edges (DXF Reference, *Boundary path
//! data*).

use super::curve::{Ellipse, Spline, ahead, bulge, radians};
use super::file::Entity;
use super::frame::Frame;
use super::pairs::{NoNumber, Pair};
use super::vertex::{Beyond, Vertex};
use crate::artwork::Area;
use crate::board::polarity::FillRule;
use crate::geometry::Segment;
use crate::import::drawing::{Contour, Place};

/// The area of a hatch; none without a boundary.
pub(super) fn area(entity: &Entity<'_>, frame: &Frame) -> Result<Option<Result<Area, Beyond>>, NoNumber> {
    let mut reader = Reader { pairs: entity.pairs(), frame };
    reader.skip_to(91);
    let paths = reader.whole(91)?.unwrap_or(0);
    let mut contours = Vec::new();
    for _ in 0..paths {
        let Some(flags) = reader.next_whole(92)? else { break };
        /// A polyline, and not edges. Bit 2 of group code 92 in the DXF reference.
        const POLYLINE: i64 = 2;
        let contour = if flags & POLYLINE == 0 { reader.edges()? } else { reader.polyline()? };
        if let Some(mut contour) = contour {
            contour.close();
            match contour.finish() {
                Some(path) => contours.push(path),
                None => return Ok(Some(Err(Beyond))),
            }
        }
    }
    // A line there and back has nothing inside; a whole circle is one arc.
    contours.retain(|path| path.segments.len() > 1 || path.segments.iter().any(is_arc));
    Ok((!contours.is_empty()).then_some(Ok(Area { contours, rule: FillRule::EvenOdd })))
}

fn is_arc(segment: &Segment) -> bool {
    matches!(segment, Segment::Arc { .. })
}

/// What is left of a hatch's pairs.
struct Reader<'a, 'b> {
    pairs: &'a [Pair<'b>],
    frame: &'a Frame,
}

impl Reader<'_, '_> {
    /// Moves to the next pair of `code`, or to the end.
    fn skip_to(&mut self, code: i32) {
        let at = self.pairs.iter().position(|pair| pair.code == code).unwrap_or(self.pairs.len());
        self.pairs = &self.pairs[at..];
    }

    /// The number of the pair here, if that is of `code`.
    fn whole(&mut self, code: i32) -> Result<Option<i64>, NoNumber> {
        let Some(first) = self.pairs.first().filter(|pair| pair.code == code) else { return Ok(None) };
        self.pairs = &self.pairs[1..];
        first.whole().map(Some)
    }

    /// The number of the next pair of `code`; none where no more follows.
    fn next_whole(&mut self, code: i32) -> Result<Option<i64>, NoNumber> {
        self.skip_to(code);
        self.whole(code)
    }

    fn real(&mut self, code: i32) -> Result<Option<f64>, NoNumber> {
        let Some(first) = self.pairs.first().filter(|pair| pair.code == code) else { return Ok(None) };
        self.pairs = &self.pairs[1..];
        first.real().map(Some)
    }

    fn real_or(&mut self, code: i32, or: f64) -> Result<f64, NoNumber> {
        Ok(self.real(code)?.unwrap_or(or))
    }

    fn point(&mut self, code: i32) -> Result<Option<Place>, NoNumber> {
        let Some(x) = self.real(code)? else { return Ok(None) };
        Ok(Some((x, self.real_or(code + 10, 0.0)?)))
    }

    fn polyline(&mut self) -> Result<Option<Contour>, NoNumber> {
        let _has_bulges = self.whole(72)?;
        let _is_closed = self.whole(73)?;
        let count = self.whole(93)?.unwrap_or(0);
        let mut vertices: Vec<Vertex> = Vec::new();
        for _ in 0..count {
            let Some(at) = self.point(10)? else { break };
            vertices.push(Vertex { at, bulge: self.real_or(42, 0.0)?, ..Vertex::default() });
        }
        let Some(first) = vertices.first() else { return Ok(None) };
        let mut contour = Contour::new(self.frame.place(first.at));
        let next = vertices.iter().skip(1).chain([first]);
        for (from, to) in vertices.iter().zip(next) {
            bulge(self.frame, &mut contour, from.at, to.at, from.bulge);
        }
        Ok(Some(contour))
    }

    fn edges(&mut self) -> Result<Option<Contour>, NoNumber> {
        let count = self.whole(93)?.unwrap_or(0);
        let mut contour = None;
        for _ in 0..count {
            let Some(kind) = self.whole(72)? else { break };
            match kind {
                1 => self.line(&mut contour)?,
                2 | 3 => self.round(kind, &mut contour)?,
                4 => self.spline(&mut contour)?,
                _ => break,
            }
        }
        Ok(contour)
    }

    fn line(&mut self, contour: &mut Option<Contour>) -> Result<(), NoNumber> {
        let (from, to) = (self.point(10)?.unwrap_or_default(), self.point(11)?.unwrap_or_default());
        let [from, to] = [from, to].map(|p| self.frame.place(p));
        // Edges may be written from either end.
        let forward = is_nearer(contour.as_ref(), from, to);
        let (from, to) = if forward { (from, to) } else { (to, from) };
        begun(contour, from).line(to);
        Ok(())
    }

    /// A part of a circle, or of an ellipse.
    fn round(&mut self, kind: i64, contour: &mut Option<Contour>) -> Result<(), NoNumber> {
        let center = self.point(10)?.unwrap_or_default();
        let major = if kind == 3 { self.point(11)?.unwrap_or_default() } else { (0.0, 0.0) };
        let size = self.real_or(40, 0.0)?;
        let (from, to) = (radians(self.real_or(50, 0.0)?), radians(self.real_or(51, 360.0)?));
        let is_left = self.whole(73)?.unwrap_or(1) != 0;
        let axes =
            if kind == 3 { (major, (-major.1 * size, major.0 * size)) } else { ((size, 0.0), (0.0, size)) };
        // Clockwise ones have their angles counted clockwise, too.
        let side = if is_left { 1.0 } else { -1.0 };
        let part = Ellipse { center, axes, from: from * side, sweep: ahead(from, to) * side };
        let (start, end) = (self.frame.place(part.start()), self.frame.place(part.reversed().start()));
        let part = if is_nearer(contour.as_ref(), start, end) { part } else { part.reversed() };
        let start = self.frame.place(part.start());
        part.follow(self.frame, begun(contour, start));
        Ok(())
    }

    fn spline(&mut self, contour: &mut Option<Contour>) -> Result<(), NoNumber> {
        let degree = self.whole(94)?.unwrap_or(3);
        let (_rational, _periodic) = (self.whole(73)?, self.whole(74)?);
        let (knots, controls) = (self.whole(95)?.unwrap_or(0), self.whole(96)?.unwrap_or(0));
        let mut spline = Spline {
            degree: usize::try_from(degree).unwrap_or(0),
            knots: Vec::new(),
            controls: Vec::new(),
            weights: Vec::new(),
        };
        for _ in 0..knots {
            let Some(knot) = self.real(40)? else { break };
            spline.knots.push(knot);
        }
        for _ in 0..controls {
            let Some(point) = self.point(10)? else { break };
            spline.controls.push(point);
            spline.weights.extend(self.real(42)?);
        }
        // Points that it was fitted to, and the tangents at its ends, say nothing new. A count of
        // the same code closes the boundary, where the next pair is no point.
        if self.pairs.first().is_some_and(|pair| pair.code == 97)
            && self.pairs.get(1).is_some_and(|pair| pair.code == 11)
        {
            self.pairs = &self.pairs[1..];
            while self.pairs.first().is_some_and(|pair| matches!(pair.code, 11 | 21 | 12 | 22 | 13 | 23)) {
                self.pairs = &self.pairs[1..];
            }
        }
        if spline.is_sound() {
            let start = self.frame.place(spline.start());
            spline.follow(self.frame, begun(contour, start));
        }
        Ok(())
    }
}

/// Whether an edge from `start` to `end` goes on from where the contour is.
fn is_nearer(contour: Option<&Contour>, start: Place, end: Place) -> bool {
    let Some(at) = contour.map(Contour::at) else { return true };
    let off = |p: Place| libm::hypot(p.0 - at.0, p.1 - at.1);
    off(start) <= off(end)
}

/// The contour, at `start`.
fn begun(contour: &mut Option<Contour>, start: Place) -> &mut Contour {
    let contour = contour.get_or_insert_with(|| Contour::new(start));
    contour.line(start);
    contour
}
