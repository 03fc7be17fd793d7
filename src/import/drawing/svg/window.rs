//! What clipping paths and masks let through.
//!
//! A clipping path shows what lies in its shapes, whatever their paint. A mask of luminance shows
//! what lies under its white shapes and hides what lies under black ones painted after them, and
//! what lies beyond its rectangle; a mask of alpha shows what lies under any shape. (CSS Masking 1,
//! W3C candidate recommendation, 2021, sections 6 and 7.) A mask with greys, gradients or pictures
//! is no area.

use crate::artwork::{Area, Drawn, Effort, Figure};
use crate::board::FLATTEN;
use crate::board::polarity::{self, FillRule, TooMuch};
use crate::geometry::{Path, Polygon, Rect, RectIndex};

/// The area in which something is seen.
#[derive(Debug)]
pub(super) struct Window {
    /// Simple, and apart from each other.
    pieces: Vec<Polygon>,
    /// The pieces by place.
    index: RectIndex,
}

impl Window {
    /// The window of `pieces`, as the booleans of [`polarity`] return them.
    pub(super) fn new(pieces: Vec<Polygon>, effort: &mut Effort) -> Result<Self, TooMuch> {
        effort.spend(pieces.iter().map(vertices).sum())?;
        Ok(Self::of(pieces))
    }

    fn of(pieces: Vec<Polygon>) -> Self {
        let index = RectIndex::new(pieces.iter().map(Polygon::bounds));
        Self { pieces, index }
    }

    /// What is seen through both.
    pub(super) fn and(&self, other: &Self, effort: &mut Effort) -> Result<Self, TooMuch> {
        Ok(Self::of(other.part_of(&self.pieces, effort)?))
    }

    /// What is seen of `figure`: itself, where it lies inside, so that circles and lines stay such.
    pub(super) fn cut(&self, figure: Figure, effort: &mut Effort) -> Result<Option<Figure>, TooMuch> {
        if figure.bounds().is_some_and(|bounds| self.holds(bounds)) {
            return Ok(Some(figure));
        }
        effort.spend_on(&figure)?;
        let shapes = figure.shapes(FLATTEN)?;
        let parts: Vec<Polygon> = shapes.iter().filter_map(|(shape, _)| shape.polygon(FLATTEN)).collect();
        // A bare line covers nothing.
        if parts.is_empty() {
            return Ok(Some(figure));
        }
        effort.spend(polarity::effort(parts.iter().flat_map(Polygon::contours)))?;
        let whole = polarity::union(&parts);
        let seen = self.part_of(&whole, effort)?;
        if area(&seen) == area(&whole) {
            return Ok(Some(figure));
        }
        let closed = |ring: &Vec<_>| Path::polyline(ring.iter().chain(ring.first()).copied());
        let contours: Vec<Path> = seen.iter().flat_map(Polygon::contours).filter_map(closed).collect();
        let drawn = Drawn::Area(Area { contours, rule: FillRule::EvenOdd });
        Ok((!seen.is_empty()).then_some(Figure { drawn, ..figure }))
    }

    /// What is seen of polygons; each simple, and apart from each other.
    fn part_of(&self, polygons: &[Polygon], effort: &mut Effort) -> Result<Vec<Polygon>, TooMuch> {
        let mut found = Vec::new();
        for one in polygons {
            for other in self.index.touching(one.bounds()).into_iter().map(|i| &self.pieces[i]) {
                let rings = || one.contours().iter().chain(other.contours());
                effort.spend(polarity::effort(rings()))?;
                if polarity::is_tangled(rings()) {
                    return Err(TooMuch);
                }
                found.extend(polarity::intersection(one, other));
            }
        }
        Ok(found)
    }

    /// Whether it is a rectangle round `bounds`, as that of a page is.
    fn holds(&self, bounds: Rect) -> bool {
        let [only] = self.pieces.as_slice() else { return false };
        let rect = only.bounds();
        only.twice_area() == Polygon::rectangle(rect).twice_area()
            && rect.contains(bounds.min())
            && rect.contains(bounds.max())
    }
}

fn vertices(polygon: &Polygon) -> u64 {
    polygon.contours().iter().map(|ring| ring.len() as u64).sum()
}

fn area(polygons: &[Polygon]) -> i128 {
    polygons.iter().map(Polygon::twice_area).sum()
}
