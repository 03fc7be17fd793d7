//! The profile layer → the board's edge: loose lines and arcs joined into closed contours.
//!
//! The layer is a drawing. Its lines may have any width (their middle is the edge), come in any
//! order and direction, be drawn twice, cross, end short of each other, or carry a title block
//! beside. What counts is what they enclose:
//!
//! ```text
//!  edges ─ heal ─▶ gaps closed ─ edge ─▶ parted where they meet
//!        ─ heal ─▶ dead ends off ─ chords ─▶ crossing nowhere
//!        ─ faces, areas, nest ─▶ contours
//! ```
//!
//! Of every connected drawing the outermost boundary is a contour. What lies inside it without
//! touching it is a contour of its own, a cut-out; what lies inside and touches it is left out with
//! a warning.
//!
//! So far goes what any drawing is read by, `enclosed` alone. A board has more rules, since much
//! else is on its layer ([`join`]): what comes nearer to a contour around it than lines are joined
//! over is left out, as are letters beside the board and what is too small to be cut; and where
//! lines are open that reach around all the rest, nothing is the edge.

mod areas;
mod chords;
mod edge;
mod faces;
mod heal;
mod nest;
mod notes;

use std::borrow::Borrow;

use crate::board::{Axis, Feature, Outline, Shape, Warning};
use crate::geometry::{Nm, Path, Point};
use crate::import::diagnostic;
use edge::Edge;
pub(in crate::import) use heal::Loose;
use notes::{Notes, Reading};

/// How far apart two ends may lie and still be taken for one corner.
///
/// Chosen: programs that flatten arcs or round twice leave up to 0.1 mm between lines; a slot
/// narrower than that cannot be milled.
pub const GAP: Nm = Nm::from_um(100);

/// What a profile layer was found to be.
#[derive(Clone, Debug)]
pub struct Joined {
    /// The contours; none where nothing closes.
    pub outline: Option<Outline>,
    /// Gaps closed, lines left out, an empty layer.
    pub warnings: Vec<Warning>,
}

/// What the lines of a drawing enclose, where it is no board: all that closes, however small it is,
/// near to what is around it or beside, whatever else is drawn.
pub(in crate::import) struct Enclosed {
    /// The contours; none where nothing closes.
    pub(in crate::import) outline: Option<Outline>,
    /// What does not close; nothing where all lines do.
    pub(in crate::import) open: Option<Loose>,
    /// Gaps closed, lines left out.
    pub(in crate::import) warnings: Vec<Warning>,
}

/// Joins the axes of `features`, read from the file `file` with content `bytes`, into contours;
/// ends meet whose strokes touch, and then such as are up to `gap` apart.
#[must_use]
pub fn join(
    file: &str,
    bytes: &[u8],
    features: impl IntoIterator<Item = impl Borrow<Feature>>,
    gap: Nm,
) -> Joined {
    let mut notes = Notes::new(Reading::Board, file, bytes);
    let Some(Closed { contours, loose }) = close(features, gap, &mut notes) else {
        notes.add(&diagnostic::OUTLINE_EMPTY, "the outline layer has nothing that can be cut", None);
        return Joined { outline: None, warnings: notes.warnings };
    };
    let contours = nest::without_decoration(contours, &mut notes);
    let contours = nest::without_doubles(contours, gap, &mut notes);
    let closes = |outline: &Outline| !loose.as_ref().is_some_and(|loose| reaches_around(loose, outline));
    let outline = Outline::new(contours).filter(closes);
    if outline.is_none() {
        let message = "the outline of the board is not closed; close it in the layer";
        notes.add(&diagnostic::OUTLINE_OPEN, message, loose.map(|loose| loose.place));
    }
    Joined { outline, warnings: notes.warnings }
}

/// The same of a drawing that is no board: none of the rules by which a board's edge is told from
/// what else is on its layer.
pub(in crate::import) fn enclosed(
    file: &str,
    bytes: &[u8],
    features: impl IntoIterator<Item = impl Borrow<Feature>>,
    gap: Nm,
) -> Enclosed {
    let mut notes = Notes::new(Reading::Drawing, file, bytes);
    let Closed { contours, loose: open } = close(features, gap, &mut notes).unwrap_or_default();
    let outline = Outline::new(nest::without_copies(contours));
    Enclosed { outline, open, warnings: notes.warnings }
}

/// What of a layer is closed, and what is not.
#[derive(Default)]
struct Closed {
    contours: Vec<Path>,
    loose: Option<Loose>,
}

/// Joins axes into contours, by no rule but that they close; none where nothing is drawn.
fn close(
    features: impl IntoIterator<Item = impl Borrow<Feature>>,
    gap: Nm,
    notes: &mut Notes<'_>,
) -> Option<Closed> {
    let (mut edges, mut contours) = collect(features, notes);
    if edges.is_empty() && contours.is_empty() {
        return None;
    }
    edge::drop_doubles(&mut edges);
    heal::close_gaps(&mut edges, gap, notes);
    edges = edge::part_where_they_meet(edges);
    let joints = heal::join_to_middles(&mut edges);
    if !joints.is_empty() {
        edges = edge::part_where_they_meet(edges);
    }
    let loose = heal::prune(&mut edges, notes);
    heal::note_joints(&edges, joints, notes);
    let is_filled = !contours.is_empty();
    contours.extend(faces::outermost(&chords::of_crowded(edges), notes));
    if is_filled {
        contours = areas::united(contours, notes);
    }
    contours.sort_by_cached_key(|contour| (contour.bounds().min(), contour.start, contour.segments.len()));
    contours.dedup();
    Some(Closed { contours, loose })
}

/// Whether what does not close is the board's edge, and what closes but its cut-outs.
fn reaches_around(loose: &Loose, outline: &Outline) -> bool {
    let longest = outline.contours().iter().map(Path::length).fold(0.0, f64::max);
    let within = |p: Point| outline.bounds().inflate(GAP).contains(p);
    loose.length > longest && !(within(loose.bounds.min()) && within(loose.bounds.max()))
}

/// The axes of drawn features as edges, and the contours of regions, closed as they come.
fn collect(
    features: impl IntoIterator<Item = impl Borrow<Feature>>,
    notes: &mut Notes<'_>,
) -> (Vec<Edge>, Vec<Path>) {
    let (mut edges, mut contours) = (Vec::new(), Vec::new());
    let (mut flashes, mut dots) = (Vec::new(), Vec::new());
    let mut drawn: Vec<(Point, u32)> = Vec::new();
    for feature in features {
        let feature: &Feature = feature.borrow();
        let line = feature.line;
        let half = half_width(&feature.shape);
        match (&feature.axis, &feature.shape) {
            (Axis::Line(from, to), _) if from != to => edges.push(Edge::line(*from, *to, line).drawn(half)),
            (Axis::Arc(arc), _) if arc.start == arc.end => {
                edges.extend(edge::halves(&Edge::arc(*arc, line).drawn(half), arc));
            }
            (Axis::Arc(arc), _) => edges.push(Edge::arc(*arc, line).drawn(half)),
            (Axis::Region, Shape::Polygon(polygon)) => {
                for ring in polygon.contours() {
                    drawn.extend(ring.iter().map(|&corner| (corner, line)));
                    contours.extend(Path::polyline(ring.iter().copied().chain(ring.first().copied())));
                }
            }
            (Axis::Line(at, _), _) => dots.push((*at, line)),
            (Axis::Flash(_) | Axis::Region, _) => flashes.push((feature.shape.anchor(), line)),
        }
    }
    drawn.extend(edges.iter().flat_map(|edge| [(edge.from, edge.line), (edge.to, edge.line)]));
    notes.drawn(drawn);
    // A corner that is there twice draws a line of no length.
    flashes.extend(dots.into_iter().filter(|&(at, _)| !notes.has_drawn(at)));
    if let Some(&first) = flashes.first() {
        let message = format!("{} flashes on the outline layer are ignored", flashes.len());
        notes.add(&diagnostic::OUTLINE_FLASHES, message, Some(first));
    }
    (edges, contours)
}

/// Half the width of what is drawn; nothing of what is not drawn with a round aperture.
const fn half_width(shape: &Shape) -> Nm {
    match shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => *radius,
        Shape::Polygon(_) => Nm::ZERO,
    }
}

/// The signed area inside, counter-clockwise positive.
fn area_mm2(contour: &Path) -> f64 {
    nest::ring(contour).map_or(0.0, |ring| ring.area_mm2())
}
