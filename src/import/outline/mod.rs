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
//! touching it is a contour of its own, a cut-out; what lies inside and touches it, or comes nearer
//! to it than lines are joined over, is left out with a warning.

mod areas;
mod chords;
mod edge;
mod faces;
mod heal;
mod nest;

use std::borrow::Borrow;

use crate::board::Diagnostic;
use crate::board::{Axis, Feature, Outline, Shape, Warning};
use crate::geometry::{Nm, Path, Point};
use crate::import::diagnostic;
use crate::import::error::{last_line, line, locate};
use edge::Edge;

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

/// Joins the axes of `features`, read from the file `file` with content `bytes`, into contours;
/// ends meet whose strokes touch, and then such as are up to `gap` apart.
#[must_use]
pub fn join(
    file: &str,
    bytes: &[u8],
    features: impl IntoIterator<Item = impl Borrow<Feature>>,
    gap: Nm,
) -> Joined {
    let mut notes = Notes { file, bytes, lines: Vec::new(), warnings: Vec::new() };
    let (mut edges, mut contours) = collect(features, &mut notes);
    if edges.is_empty() && contours.is_empty() {
        notes.add(&diagnostic::OUTLINE_EMPTY, "the outline layer has nothing that can be cut", None);
        return Joined { outline: None, warnings: notes.warnings };
    }
    edge::drop_doubles(&mut edges);
    heal::close_gaps(&mut edges, gap, &mut notes);
    edges = edge::part_where_they_meet(edges);
    let joints = heal::join_to_middles(&mut edges);
    if !joints.is_empty() {
        edges = edge::part_where_they_meet(edges);
    }
    let loose = heal::prune(&mut edges, &mut notes);
    heal::note_joints(&edges, joints, &mut notes);
    let is_filled = !contours.is_empty();
    contours.extend(faces::outermost(&chords::of_crowded(edges), &mut notes));
    if is_filled {
        contours = areas::united(contours, &mut notes);
    }
    contours.sort_by_cached_key(|contour| (contour.bounds().min(), contour.start, contour.segments.len()));
    contours.dedup();
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

/// Whether what does not close is the board's edge, and what closes but its cut-outs.
fn reaches_around(loose: &heal::Loose, outline: &Outline) -> bool {
    let longest = outline.contours().iter().map(Path::length).fold(0.0, f64::max);
    let within = |p: Point| outline.bounds().inflate(GAP).contains(p);
    loose.length > longest && !(within(loose.bounds.min()) && within(loose.bounds.max()))
}

/// Warnings about one layer.
pub(in crate::import::outline) struct Notes<'a> {
    file: &'a str,
    bytes: &'a [u8],
    /// The line of the file that drew a point first, by point.
    lines: Vec<(Point, u32)>,
    warnings: Vec<Warning>,
}

impl Notes<'_> {
    /// Without a place, the file as a whole is meant.
    fn add(
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
    fn drawn(&mut self, lines: Vec<(Point, u32)>) {
        self.lines = lines;
        self.lines.sort_by_key(|(p, _)| *p);
        self.lines.dedup_by_key(|(p, _)| *p);
    }

    /// Whether `at` is such a point.
    fn has_drawn(&self, at: Point) -> bool {
        self.lines.binary_search_by_key(&at, |(p, _)| *p).is_ok()
    }

    /// `at`, with the line that drew it; a point that crossing lines made is on the line of one
    /// beside it.
    fn place(&self, at: Point) -> Option<(Point, u32)> {
        let next = self.lines.partition_point(|(p, _)| *p < at);
        let drawn = self.lines.get(next).or_else(|| self.lines.last());
        drawn.map(|&(_, line)| (at, line))
    }
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
