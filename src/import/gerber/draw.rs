//! What an aperture leaves behind when flashed, drawn along a line or drawn along an arc.

use crate::board::{Axis, FLATTEN, Shape, polarity};
use crate::geometry::{Arc, Nm, Point, Polygon, Rect};

use super::aperture::Form;
use super::canvas::{Refusal, stroke};

/// The copper of `form` flashed at `at`.
pub(super) fn flash(form: &Form, at: Point) -> Vec<Shape> {
    match form {
        Form::Disc(radius) => vec![Shape::Disc { center: at, radius: *radius }],
        Form::Obround { half, radius } => vec![stroke(at - *half, at + *half, *radius)],
        Form::Holed { pieces, .. } | Form::Area { pieces, .. } => {
            let way = at - Point::default();
            pieces.iter().map(|piece| Shape::Polygon(piece.translated(way))).collect()
        }
    }
}

/// Checks that `form`, drawn along `axis`, stays in the range of coordinates.
pub(super) fn check_reach(form: &Form, axis: Axis) -> Result<(), Refusal> {
    let own = match form {
        Form::Disc(_) | Form::Holed { .. } => return Ok(()),
        Form::Obround { half, radius } => {
            Rect::new(Point::default() - *half, Point::default() + *half).inflate(*radius)
        }
        Form::Area { hull, .. } => match Rect::around(hull.iter().copied()) {
            Some(own) => own,
            None => return Ok(()),
        },
    };
    let bounds = match axis {
        Axis::Line(from, to) => Rect::new(from, to),
        Axis::Arc(arc) => arc.bounds(),
        Axis::Flash(_) | Axis::Region => return Ok(()),
    };
    let low = (bounds.min().x + own.min().x).min(bounds.min().y + own.min().y);
    let high = (bounds.max().x + own.max().x).max(bounds.max().y + own.max().y);
    if low >= Nm::MIN && high <= Nm::MAX { Ok(()) } else { Err(Refusal::Range) }
}

/// The copper of `form` drawn along a line: exact for circles and convex apertures such as
/// rectangles, the hull of both ends for others (the specification allows circles alone).
pub(super) fn line(form: &Form, from: Point, to: Point) -> Vec<Shape> {
    match form {
        Form::Disc(radius) => vec![stroke(from, to, *radius)],
        _ if from == to => flash(form, from),
        Form::Holed { radius, .. } => vec![stroke(from, to, *radius)],
        Form::Obround { .. } | Form::Area { .. } => {
            sweep(&form.hull(), from, to).map(Shape::Polygon).into_iter().collect()
        }
    }
}

/// The copper of `form` drawn along an arc: exact for circles, a chain of lines for others.
pub(super) fn along(form: &Form, arc: Arc) -> Vec<Shape> {
    match form {
        Form::Disc(radius) | Form::Holed { radius, .. } => vec![Shape::Arc { arc, radius: *radius }],
        Form::Obround { .. } | Form::Area { .. } => {
            let (hull, mut from) = (form.hull(), arc.start);
            let steps = arc.flatten(FLATTEN).filter_map(|to| {
                let swept = sweep(&hull, from, to);
                from = to;
                swept
            });
            let steps: Vec<Polygon> = steps.collect();
            together(&steps).into_iter().map(Shape::Polygon).collect()
        }
    }
}

/// Steps of an arc that are united at once. Chosen: more overlap each other so often that halves
/// are faster.
const FEW: usize = 256;

/// The area of steps that follow one another. Where an aperture is hundreds of steps long each
/// overlaps as many: halves are united first, whose insides are gone then.
fn together(steps: &[Polygon]) -> Vec<Polygon> {
    if steps.len() <= FEW {
        return polarity::union(steps);
    }
    let (first, rest) = steps.split_at(steps.len() / 2);
    polarity::union(&[together(first), together(rest)].concat())
}

/// About how many vertices drawing `form` along `arc` takes in: each step overlaps as many others
/// as the aperture is steps long.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates, as it should here"
)]
pub(super) fn effort(form: &Form, arc: &Arc) -> u64 {
    if matches!(form, Form::Disc(_) | Form::Holed { .. }) {
        return 0;
    }
    let steps = u32::try_from(arc.chords(FLATTEN)).unwrap_or(u32::MAX);
    let hull = form.hull();
    let reach = hull.iter().map(|p| p.distance(Point::default())).fold(0.0, f64::max);
    let overlapped = f64::from(steps) * (2.0 * reach / arc.length().max(1.0)).min(1.0);
    (hull.len() as u64).saturating_mul(u64::from(steps)).saturating_mul(1 + overlapped as u64)
}

/// The hull of `hull` placed at both ends.
fn sweep(hull: &[Point], from: Point, to: Point) -> Option<Polygon> {
    let ends = [from, to].into_iter().flat_map(|end| {
        let way = end - Point::default();
        hull.iter().map(move |&p| p + way)
    });
    Polygon::hull(ends)
}
