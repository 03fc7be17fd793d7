//! The profile layer → the board's edge: loose lines and arcs joined into closed contours.
//!
//! The layer is a drawing. Its lines may have any width (their middle is the edge), come in any order and direction,
//! be drawn twice, cross, end short of each other, or carry a title block beside. What counts is what they enclose:
//!
//! ```text
//!  edges ─ heal ─▶ gaps closed ─ edge ─▶ parted where they meet ─ heal ─▶ dead ends off ─ faces, nest ─▶ contours
//! ```
//!
//! Of every connected drawing the outermost boundary is a contour. What lies inside it without touching it is a
//! contour of its own, a cut-out; what lies inside and touches it is left out with a warning.

mod edge;
mod faces;
mod heal;
mod nest;

use crate::board::{Axis, Feature, Outline, Shape, SourceSpan, Warning};
use crate::geometry::{Nm, Path, Point};
use edge::Edge;

/// How far apart two ends may lie and still be taken for one corner.
///
/// Chosen: programs that flatten arcs or round twice leave up to 0.1 mm between lines; a slot narrower than that
/// cannot be milled.
pub const GAP: Nm = Nm::from_um(100);

/// What a profile layer was found to be.
#[derive(Clone, Debug)]
pub struct Joined {
    /// The contours; none where nothing closes.
    pub outline: Option<Outline>,
    /// Gaps closed, lines left out, an empty layer.
    pub warnings: Vec<Warning>,
}

/// Joins the axes of `features`, read from `file`, into contours; ends up to `gap` apart meet.
#[must_use]
pub fn join(file: &str, features: &[Feature], gap: Nm) -> Joined {
    let mut notes = Notes { file, warnings: Vec::new() };
    let (mut edges, mut contours) = collect(features, &mut notes);
    if edges.is_empty() && contours.is_empty() {
        notes.add("outline-empty", "the outline layer draws nothing that could be cut", None);
        return Joined { outline: None, warnings: notes.warnings };
    }
    edge::drop_doubles(&mut edges);
    heal::close_gaps(&mut edges, gap, &mut notes);
    edges = edge::part_where_they_meet(edges);
    let loose = heal::prune(&mut edges, &mut notes);
    contours.extend(faces::outermost(&edges, &mut notes));
    contours.sort_by_key(|contour| (contour.bounds().min(), contour.start, contour.segments.len()));
    contours.dedup();
    let contours = nest::without_decoration(contours, &mut notes);
    let outline =
        Outline::new(contours).filter(|outline| !loose.is_some_and(|loose| reaches_around(&loose, outline)));
    if outline.is_none() {
        let message =
            "the outer edge of the board does not close, so the outline is not known; close it in the layer";
        notes.add("outline-open", message, None);
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
    warnings: Vec<Warning>,
}

impl Notes<'_> {
    fn add(&mut self, code: &'static str, message: impl Into<String>, place: Option<(Point, u32)>) {
        let warning = Warning::new(code, message);
        let (warning, line) = match place {
            Some((at, line)) => (warning.at(at), line),
            None => (warning, 1),
        };
        let source = SourceSpan { file: self.file.to_owned(), line, column: 1, text: String::new() };
        self.warnings.push(warning.caused_by(source));
    }
}

/// The axes of drawn features as edges, and the contours of regions, closed as they come.
fn collect(features: &[Feature], notes: &mut Notes<'_>) -> (Vec<Edge>, Vec<Path>) {
    let (mut edges, mut contours, mut flashes) = (Vec::new(), Vec::new(), 0_u32);
    for feature in features {
        let line = feature.line;
        match (&feature.axis, &feature.shape) {
            (Axis::Line(from, to), _) if from != to => edges.push(Edge::line(*from, *to, line)),
            (Axis::Arc(arc), _) if arc.start == arc.end => edges.extend(edge::halves(arc, line)),
            (Axis::Arc(arc), _) => edges.push(Edge::arc(*arc, line)),
            (Axis::Region, Shape::Polygon(polygon)) => {
                for ring in polygon.contours() {
                    contours.extend(Path::polyline(ring.iter().copied().chain(ring.first().copied())));
                }
            }
            (Axis::Line(..) | Axis::Flash(_) | Axis::Region, _) => flashes += 1,
        }
    }
    if flashes > 0 {
        let message = format!("{flashes} flashes on the outline layer are no edge and are left out");
        notes.add("outline-flashes", message, None);
    }
    (edges, contours)
}

/// The signed area inside, counter-clockwise positive.
fn area_mm2(contour: &Path) -> f64 {
    nest::ring(contour).map_or(0.0, |ring| ring.area_mm2())
}
