//! What was painted in one go: an area or a line.

use crate::board::polarity::{self, FillRule, Polarity, TooMuch};
use crate::board::{Axis, FLATTEN, Feature, Shape};
use crate::geometry::{Nm, Path, Point, Polygon, Rect, Segment, Vector};

/// The inside of closed contours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Area {
    /// The contours. One that does not end where it begins is closed by a straight line.
    pub contours: Vec<Path>,
    /// Which points are inside.
    pub rule: FillRule,
}

/// A pen drawn along a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Where its middle goes.
    pub path: Path,
    /// The pen's diameter; zero for a line that only marks a place, such as a board's edge.
    pub width: Nm,
    /// What it covers, where that is not what a round pen leaves: square ends, mitred corners,
    /// dashes.
    pub painted: Option<Area>,
}

/// The kinds of figures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// A filled area.
    Area(Area),
    /// A line.
    Line(Line),
}

/// A figure with what is known of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// What was painted.
    pub drawn: Drawn,
    /// Whether it adds, or erases what was painted before it.
    pub polarity: Polarity,
    /// The line of the file that it stands on, from 1; 1 where the reader does not know.
    pub line: u32,
}

impl Figure {
    /// The paths it consists of: contours, or the middle of a line.
    #[must_use]
    pub fn paths(&self) -> &[Path] {
        match &self.drawn {
            Drawn::Area(area) => &area.contours,
            Drawn::Line(line) => std::slice::from_ref(&line.path),
        }
    }

    /// Half the width of its line; zero for an area.
    #[must_use]
    pub fn radius(&self) -> Nm {
        match &self.drawn {
            Drawn::Area(_) => Nm::ZERO,
            Drawn::Line(line) => line.width / 2,
        }
    }

    /// A rectangle that holds it; none for an area without contours.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        let painted = match &self.drawn {
            Drawn::Line(Line { painted: Some(area), .. }) => area.contours.as_slice(),
            Drawn::Area(_) | Drawn::Line(_) => &[],
        };
        let middles = self.paths().iter().map(|path| path.bounds().inflate(self.radius()));
        middles.chain(painted.iter().map(Path::bounds)).reduce(Rect::union)
    }

    /// What it covers: an area as polygons, curves within `tolerance`; a line as its strokes.
    ///
    /// # Errors
    ///
    /// [`TooMuch`] for contours that cross themselves too often.
    pub fn shapes(&self, tolerance: Nm) -> Result<Vec<(Shape, Axis)>, TooMuch> {
        match &self.drawn {
            Drawn::Area(area) | Drawn::Line(Line { painted: Some(area), .. }) => {
                let polygons = area.polygons(tolerance)?.into_iter();
                Ok(polygons.map(|polygon| (Shape::Polygon(polygon), Axis::Region)).collect())
            }
            Drawn::Line(line) => Ok(line.shapes()),
        }
    }

    /// The same as copper, curves of areas within [`FLATTEN`].
    ///
    /// # Errors
    ///
    /// [`TooMuch`], as [`shapes`](Self::shapes) has it.
    pub fn features(&self) -> Result<Vec<Feature>, TooMuch> {
        let feature = |(shape, axis)| Feature { shape, axis, attributes: 0, line: self.line };
        Ok(self.shapes(FLATTEN)?.into_iter().map(feature).collect())
    }

    /// Moved by `way`.
    #[must_use]
    pub fn translated(&self, way: Vector) -> Self {
        let drawn = match &self.drawn {
            Drawn::Area(area) => Drawn::Area(area.translated(way)),
            Drawn::Line(line) => Drawn::Line(Line {
                path: line.path.translated(way),
                width: line.width,
                painted: line.painted.as_ref().map(|area| area.translated(way)),
            }),
        };
        Self { drawn, ..self.clone() }
    }
}

impl Area {
    fn translated(&self, way: Vector) -> Self {
        Self { contours: self.contours.iter().map(|path| path.translated(way)).collect(), rule: self.rule }
    }

    /// Simple polygons with holes, one for each connected piece, curves within `tolerance`.
    ///
    /// # Errors
    ///
    /// [`TooMuch`] for contours that cross themselves too often.
    pub fn polygons(&self, tolerance: Nm) -> Result<Vec<Polygon>, TooMuch> {
        let rings: Vec<Vec<Point>> = self.contours.iter().map(|path| path.flatten(tolerance)).collect();
        if polarity::is_tangled(rings.iter()) {
            return Err(TooMuch);
        }
        let circles = self.contours.iter().flat_map(Path::circles).collect();
        Ok(polarity::of_circles(polarity::filled(&rings, self.rule), circles))
    }
}

impl Line {
    /// What a round pen leaves: a stroke for each segment; a disc for a path that goes nowhere.
    fn shapes(&self) -> Vec<(Shape, Axis)> {
        let radius = self.width / 2;
        let start = self.path.start;
        let stroke = |(from, segment): (Point, &Segment)| match segment.arc(from) {
            Some(arc) => Some((Shape::Arc { arc, radius }, Axis::Arc(arc))),
            None if from == segment.to() => None,
            None => {
                let to = segment.to();
                Some((Shape::Stroke { from, to, radius }, Axis::Line(from, to)))
            }
        };
        let strokes: Vec<_> = self.path.steps().filter_map(stroke).collect();
        if strokes.is_empty() {
            return vec![(Shape::Disc { center: start, radius }, Axis::Flash(start))];
        }
        strokes
    }
}
