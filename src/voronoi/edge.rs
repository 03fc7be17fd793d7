//! The board's edge, beyond which nothing is cut.
//!
//! Nets are also joined through whatever copper lies outside the board, so boundaries must run out
//! to where the board is cut free: to the outline and a little beyond, or, where no outline is
//! known, to a frame round the copper that is cut once. Whatever lies beyond is drawn above
//! everything else with a label of its own; boundaries end where they meet it.

use crate::board::{Copper, FLATTEN, Outline, Shape, polarity};
use crate::geometry::{Nm, Path, Point, Polygon, Rect};
use crate::topology::Groups;

use super::Settings;
use super::plane::Spot;

/// What is cut, and what is drawn, ends here.
#[derive(Clone)]
pub(super) struct Border {
    /// What lies within it.
    pub(super) inside: Vec<Polygon>,
    /// The rectangle that a picture shows.
    pub(super) window: Rect,
    /// The rings of the border, for distances.
    pub(super) rings: Groups<Spot>,
    /// One lap round the frame, where no outline is known.
    pub(super) frame: Option<Path>,
    /// How far copper is from it where it is cut: along a frame, no nearer; along an outline nobody
    /// asks, and it is finite so that it can be interpolated.
    pub(super) clearance: Nm,
}

impl Border {
    /// The border of a board with an outline, or of one with this `copper`, which lies within
    /// `bounds`.
    pub(super) fn new(outline: Option<&Outline>, copper: &Copper, bounds: Rect, settings: &Settings) -> Self {
        let (inside, frame, clearance) = match outline {
            Some(outline) => {
                (polarity::offset(&outline.polygon(FLATTEN), settings.overlap, FLATTEN), None, Nm::MAX)
            }
            None => {
                let frame = settings.frame.enclose(copper, bounds);
                let corners = &frame.contours()[0];
                let lap = Path::polyline(corners.iter().copied().chain([corners[0]]));
                (vec![frame], lap, settings.frame.margin())
            }
        };
        let window = inside.iter().map(Polygon::bounds).reduce(Rect::union).unwrap_or(bounds);
        // A few pixels of outside all round, so that no boundary meets the edge of the picture
        // itself.
        Self::round(inside, window.inflate(settings.pitch * 4), frame, clearance)
    }

    /// The border of what lies within `inside`, in a picture of `window`; where it is cut, copper
    /// is farther than `clearance`.
    pub(super) fn round(inside: Vec<Polygon>, window: Rect, frame: Option<Path>, clearance: Nm) -> Self {
        let mut rings = Groups::default();
        for contour in inside.iter().flat_map(Polygon::contours) {
            rings.push(contour.iter().map(|&p| Spot::from(p)));
        }
        Self { inside, window, rings, frame, clearance }
    }

    /// The rectangle round what lies within it; none where nothing does.
    pub(super) fn bounds(&self) -> Option<Rect> {
        self.inside.iter().map(Polygon::bounds).reduce(Rect::union)
    }

    /// The contours of what lies outside, by the even-odd rule.
    pub(super) fn outside(&self) -> Vec<Vec<Point>> {
        let beyond = self.window.inflate(self.window.width().max(self.window.height()));
        let mut contours = vec![beyond.corners().to_vec()];
        contours.extend(self.inside.iter().flat_map(Polygon::contours).cloned());
        contours
    }

    /// Whether any of a shape's area lies on the board: a pad round a drawn hole does, though its
    /// middle does not.
    pub(super) fn has_some_of(&self, shape: &Shape) -> bool {
        self.inside.iter().any(|inside| shape.lies_in(inside))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    /// A board of 10 mm with a square hole of 1 mm in its middle.
    fn border() -> Border {
        let ring = |low: i64, high: i64| vec![at(low, low), at(high, low), at(high, high), at(low, high)];
        let mut hole = ring(4500, 5500);
        hole.reverse();
        let board = Polygon::new(vec![ring(0, 10_000), hole]).expect("a board");
        let window = board.bounds();
        Border::round(vec![board], window, None, Nm::MAX)
    }

    #[test]
    fn copper_is_on_the_board_by_its_area_alone() {
        let disc = |x, y, radius| Shape::Disc { center: at(x, y), radius: Nm::from_um(radius) };
        let across = Shape::Stroke { from: at(-1000, 2000), to: at(11_000, 2100), radius: Nm::from_um(50) };
        let corner =
            Shape::Polygon(Polygon::hull([at(-4000, 5), at(5, -4000), at(400, 400)]).expect("a triangle"));
        for (shape, expected, what) in [
            (disc(5000, 5000, 1000), true, "a pad round the hole"),
            (disc(5000, 5000, 400), false, "one that the hole takes altogether"),
            (disc(5000, 5000, 499), false, "just so"),
            (disc(-500, 5000, 600), true, "a disc that reaches over the edge"),
            (disc(-500, 5000, 499), false, "and one that does not"),
            (across, true, "a trace with both ends and its middle off the board"),
            (corner, true, "a polygon's corner"),
        ] {
            assert_eq!(border().has_some_of(&shape), expected, "{what}");
        }
    }
}
