//! The figures of one layer, and what they cover together.

use super::effort::Effort;
use super::figure::Figure;
use crate::board::polarity::{self, TooMuch};
use crate::board::{Feature, Shape};
use crate::geometry::{Nm, Path, Polygon, Rect};

/// Figures that lie on one layer of a drawing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layer {
    /// What the file calls it; empty where figures are on none.
    pub name: String,
    /// In the order in which they were painted.
    pub figures: Vec<Figure>,
}

impl Layer {
    /// A rectangle that holds all figures; none without one.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        self.figures.iter().filter_map(Figure::bounds).reduce(Rect::union)
    }

    /// What is left of the figures once all are painted, as copper: a line stays strokes where
    /// nothing erased of it.
    ///
    /// # Errors
    ///
    /// [`TooMuch`] for figures made to keep a program busy.
    pub fn into_features(self) -> Result<Vec<Feature>, TooMuch> {
        let mut effort = Effort::default();
        self.figures.iter().try_for_each(|figure| effort.spend_on(figure))?;
        let mut objects = Vec::with_capacity(self.figures.len());
        // Each figure goes as its features come: a large drawing is in memory once.
        for figure in self.figures {
            objects.extend(figure.features()?.into_iter().map(|feature| (feature, figure.polarity)));
        }
        polarity::resolve(objects)
    }

    /// The same as simple polygons with holes, one for each connected piece, curves within
    /// `tolerance`. Lines without a width cover nothing.
    ///
    /// # Errors
    ///
    /// [`TooMuch`] for figures made to keep a program busy.
    pub fn polygons(&self, tolerance: Nm) -> Result<Vec<Polygon>, TooMuch> {
        self.polygons_at(tolerance, &mut Effort::default())
    }

    /// The same, with what it costs counted.
    pub(crate) fn polygons_at(&self, tolerance: Nm, effort: &mut Effort) -> Result<Vec<Polygon>, TooMuch> {
        self.figures.iter().try_for_each(|figure| effort.spend_on(figure))?;
        let mut objects = Vec::with_capacity(self.figures.len());
        for figure in &self.figures {
            let shapes = figure.shapes(tolerance)?.into_iter();
            objects.extend(shapes.filter_map(|(shape, axis)| {
                let shape = Shape::Polygon(shape.polygon(tolerance)?);
                Some((Feature { shape, axis, attributes: 0, line: figure.line }, figure.polarity))
            }));
        }
        let left = polarity::resolve(objects)?;
        let polygons: Vec<Polygon> =
            left.iter().filter_map(|feature| feature.shape.polygon(tolerance)).collect();
        if polarity::is_tangled(polygons.iter().flat_map(Polygon::contours)) {
            return Err(TooMuch);
        }
        Ok(polarity::union(&polygons))
    }

    /// Every path of it: contours of areas, and the middles of lines.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.figures.iter().flat_map(Figure::paths)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::artwork::{Area, Drawn, Line};
    use crate::board::FLATTEN;
    use crate::board::polarity::{FillRule, Polarity};
    use crate::geometry::Point;

    fn square(low: i64, high: i64) -> Path {
        let at = |x, y| Point::new(Nm::from_mm(x), Nm::from_mm(y));
        let corners = [at(low, low), at(high, low), at(high, high), at(low, high)];
        Path::polyline(corners).expect("four corners")
    }

    fn area(contours: Vec<Path>, rule: FillRule, polarity: Polarity) -> Figure {
        Figure { drawn: Drawn::Area(Area { contours, rule }), polarity, line: 1 }
    }

    #[test]
    fn the_order_of_painting_and_the_rule_decide_what_is_filled() {
        let name = String::new();
        let both = vec![square(0, 10), square(2, 8)];
        let painted = [
            area(both.clone(), FillRule::EvenOdd, Polarity::Dark),
            area(both, FillRule::NonZero, Polarity::Dark),
            area(vec![square(4, 6)], FillRule::NonZero, Polarity::Clear),
            Figure {
                drawn: Drawn::Line(Line { path: square(0, 10), width: Nm::ZERO, painted: None }),
                polarity: Polarity::Dark,
                line: 1,
            },
        ];
        let total = |figures: &[Figure]| {
            let layer = Layer { name: name.clone(), figures: figures.to_vec() };
            let polygons = layer.polygons(Nm::new(100)).expect("little work");
            (polygons.len(), polygons.iter().map(Polygon::area_mm2).sum::<f64>())
        };
        for (count, expected) in [(1, 64.0), (2, 100.0), (3, 96.0), (4, 96.0)] {
            let (pieces, area) = total(&painted[..count]);
            assert_eq!(pieces, 1, "of {count} figures");
            assert!((area - expected).abs() < 1e-9, "{count} figures cover {area} mm²");
        }
    }

    #[test]
    fn many_tangles_are_too_much_together() {
        // Each edge crosses half of the others; alone such a figure takes a part of a second.
        let corner = |i: i64| Point::new(Nm::from_mm((i % 2) * 10), Nm::from_um(i * 7919 % 10_000));
        let tangle = Path::polyline((0..600).map(corner)).expect("corners");
        assert!(!polarity::is_tangled([tangle.flatten(FLATTEN)].iter()), "alone it is worked out");
        let tangle = area(vec![tangle], FillRule::NonZero, Polarity::Dark);
        let layer = Layer { name: String::new(), figures: vec![tangle; 150] };
        assert_eq!(layer.polygons(Nm::new(100)), Err(TooMuch), "a minute's work");
        assert_eq!(layer.into_features(), Err(TooMuch), "as copper, too");
    }
}
