//! A drawing → the shapes of it that are milled, where it is no board.
//!
//! ```text
//!  something is filled ─────▶ what is filled, and what strokes paint
//!  nothing ─┬─ a wide line is open, or of copper ─▶ what strokes paint
//!           ├─ lines close ──▶ what they enclose
//!           └─ none does ────▶ what strokes paint
//! ```
//!
//! A drawing program gives every line a width, so that of a hairline says nothing: a shape that is
//! drawn by its edge alone is meant as what it encloses. Letters and traces drawn with a wide pen
//! are not: some of their lines are open, or their layer is named like copper of a board, of which
//! Fritzing draws pads as rings.

use std::path::Path;

use super::archive::Found;
use super::drawing::{self, Drawing, role_of};
use super::drawing_board::{Named, middles, named_as};
use super::error::{Error, line};
use super::layers::Role;
use super::outline::{self, Enclosed};
use super::selection::Selection;
use super::{diagnostic, naming};
use crate::artwork::{self, Area, Artwork, Drawn, Figure, Layer};
use crate::board::{FLATTEN, Feature, Outline, Side, Source, Warning, Words, polarity};
use crate::geometry::{Nm, Path as Course, Polygon, Rect};

/// The widest line that is drawn for its middle alone. Chosen: a pixel of Inkscape, 0.26 mm or in
/// old versions 0.28 mm, is one, and a pen of half a millimetre is not.
const HAIRLINE: Nm = Nm::from_um(300);

/// What of a drawing is milled.
#[derive(Clone, Debug)]
pub struct Shapes {
    /// What the drawing is called.
    pub name: String,
    /// Its areas, simple polygons with holes; at least one.
    pub areas: Vec<Polygon>,
    /// The file.
    pub source: Source,
    /// What was left out or assumed.
    pub warnings: Vec<Warning>,
}

/// Reads the shapes of the drawing `path`, or with `#LAYER` behind its name of one layer of it;
/// none where it is no drawing. Ends of lines meet that are up to `gap` apart.
///
/// # Errors
///
/// A file that cannot be read, a layer that is not there, one that neither fills nor encloses
/// anything, and what the readers say of a drawing.
pub fn load_shapes(path: &Path, options: &drawing::Options, gap: Nm) -> Result<Option<Shapes>, Error> {
    let Some(Named { file, drawing, layer, .. }) = named_as(path, None, options)? else { return Ok(None) };
    let Drawing { artwork, source, mut warnings } = drawing;
    let artwork = match layer {
        Some(name) => drawing::layer(artwork, &file.shown, &name)?,
        None => of_one_side(artwork, &file, &mut warnings),
    };
    let areas = shapes(artwork, &file, gap, &mut warnings)?;
    warn_of_size(&areas, &mut warnings);
    let name = naming::whole_board_name(&file.name, &Selection::default());
    Ok(Some(Shapes { name, areas, source, warnings }))
}

/// All layers, or those of the front alone where layers are named like those of a board, or those
/// of the back where there is no front.
fn of_one_side(artwork: Artwork, file: &Found, warnings: &mut Vec<Warning>) -> Artwork {
    let has =
        |side: Side| artwork.layers.iter().any(|layer| role_of(&layer.name) == Some(Role::Copper(side)));
    let Some(side) = [Side::Front, Side::Back].into_iter().find(|&side| has(side)) else {
        return artwork;
    };
    let is_milled = |layer: &mut Layer| role_of(&layer.name) == Some(Role::Copper(side));
    let mut layers = artwork.layers;
    let milled: Vec<Layer> = layers.extract_if(.., is_milled).collect();
    let called = |name: &str| if name.is_empty() { "no name".to_owned() } else { format!("`{name}`") };
    if !layers.is_empty() {
        let list =
            |layers: &[Layer]| layers.iter().map(|layer| called(&layer.name)).collect::<Vec<_>>().join(", ");
        let message = format!(
            "of {} only what is in {} is milled, which is named like copper of the {side}; not what is in {}",
            file.name,
            list(&milled),
            list(&layers)
        );
        warnings.push(diagnostic::DRAWING_ASIDE.warning(message));
    }
    Artwork { layers: milled }
}

/// What of the artwork is milled.
fn shapes(
    artwork: Artwork,
    file: &Found,
    gap: Nm,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Polygon>, Error> {
    let is_copper = artwork.layers.iter().all(|layer| matches!(role_of(&layer.name), Some(Role::Copper(_))));
    let figures = artwork.into_figures();
    let is_pad_or_trace = |figure: &Figure| is_copper && figure.radius() > HAIRLINE / 2;
    if figures.iter().any(|figure| is_filled(figure) || is_pad_or_trace(figure)) {
        warnings.extend(unfilled(&figures, file, gap));
        return painted(figures, file);
    }
    let features = figures.iter().flat_map(middles);
    let Enclosed { outline, open, warnings: told } =
        outline::enclosed(&file.name, &file.bytes, features, gap);
    let by_pen = open.as_ref().is_some_and(|open| open.width > HAIRLINE && open.length >= gap.to_f64());
    if let Some(outline) = outline.filter(|_| !by_pen) {
        warnings.extend(told);
        return Ok(polarity::clean(outline.polygon(FLATTEN).contours()));
    }
    warnings.extend(unfilled(&figures, file, gap));
    let areas = painted(figures, file)?;
    if areas.is_empty() {
        return Err(nothing_closed(file, open.map_or(1, |open| open.place.1)));
    }
    Ok(areas)
}

/// Whether a figure is an area that covers anything.
fn is_filled(figure: &Figure) -> bool {
    match &figure.drawn {
        Drawn::Area(area) => area.contours.iter().filter_map(ring).any(|ring| ring.area_mm2().abs() > 0.0),
        Drawn::Line(_) => false,
    }
}

/// What is inside a contour.
fn ring(contour: &Course) -> Option<Polygon> {
    Polygon::new(vec![contour.flatten(FLATTEN)])
}

/// What is left of the figures once all are painted.
fn painted(figures: Vec<Figure>, file: &Found) -> Result<Vec<Polygon>, Error> {
    let too_much = |_| {
        let what = "areas cross each other or themselves too often to be worked out";
        Error::content(&file.shown, what, "draw with fewer crossings")
    };
    let features = Layer { name: String::new(), figures }.into_features().map_err(too_much)?;
    let shape = |feature: &Feature| feature.shape.polygon(FLATTEN);
    artwork::united(&features.iter().filter_map(shape).collect::<Vec<_>>()).map_err(too_much)
}

/// What there is to tell of thin lines beside what is filled or painted, but for those along the
/// edge of an area.
fn unfilled(figures: &[Figure], file: &Found, gap: Nm) -> Option<Warning> {
    let edges: Vec<Edge> = figures.iter().flat_map(edges).collect();
    let is_edge = |path: &Course| Edge::new(path).is_among(&edges);
    let is_thin = |figure: &&Figure| match &figure.drawn {
        Drawn::Line(line) => line.width <= HAIRLINE && !is_edge(&line.path),
        Drawn::Area(_) => false,
    };
    let thin: Vec<&Figure> = figures.iter().filter(is_thin).collect();
    let features = thin.iter().flat_map(|figure| middles(figure));
    let Enclosed { outline, open, .. } = outline::enclosed(&file.name, &file.bytes, features, gap);
    let contours = outline.iter().flat_map(Outline::contours);
    let own: Vec<&Course> = contours.filter(|contour| !is_edge(contour)).collect();
    let Some(first) = own.first() else {
        let open = open.filter(|open| open.width <= Nm::ZERO)?;
        let message = "open lines without a width lie beside shapes that are filled: they are not milled";
        let (at, number) = open.place;
        return Some(
            diagnostic::DRAWING_LINES_UNFILLED.warning(message).at(at).caused_by(file.at_line(number)),
        );
    };
    let beside = "nothing, beside shapes that are filled";
    let message = match own.len() {
        1 => format!("1 closed line fills {beside}: what it encloses is not milled"),
        many => format!("{many} closed lines fill {beside}: what they enclose is not milled"),
    };
    let drew = |figure: &&Figure| figure.paths().iter().any(|path| path.start == first.start);
    let number = thin.iter().copied().find(drew).or(thin.first().copied()).map_or(1, |figure| figure.line);
    let warning = diagnostic::DRAWING_LINES_UNFILLED.warning(message).at(first.start);
    Some(warning.caused_by(file.at_line(number)))
}

/// A closed contour, told by what no other is likely to have in common with it.
struct Edge {
    bounds: Rect,
    length: f64,
}

impl Edge {
    fn new(contour: &Course) -> Self {
        Self { bounds: contour.bounds(), length: contour.length() }
    }

    /// Whether it is one of `edges`, drawn a second time by other means.
    fn is_among(&self, edges: &[Self]) -> bool {
        /// Chosen: what curves differ by where one is flattened.
        const NEAR: Nm = Nm::from_um(20);
        /// Chosen: of the length, for the same reason.
        const PART: f64 = 0.01;
        let is_same = |other: &Self| {
            let off = [self.bounds.min() - other.bounds.min(), self.bounds.max() - other.bounds.max()];
            off.iter().all(|way| way.x.abs().max(way.y.abs()) <= NEAR)
                && (self.length - other.length).abs() <= PART * self.length
        };
        edges.iter().any(is_same)
    }
}

/// The edges of a figure that is an area.
fn edges(figure: &Figure) -> Vec<Edge> {
    match &figure.drawn {
        Drawn::Area(Area { contours, .. }) => contours.iter().map(Edge::new).collect(),
        Drawn::Line(_) => Vec::new(),
    }
}

fn nothing_closed(file: &Found, number: u32) -> Error {
    let hint = Words::of(
        "close the lines in the drawing program, fill the shapes, or allow wider gaps with {outline-gap}",
    );
    let place = line(&file.bytes, number);
    let what = "nothing in it has an area: nothing is filled, and no line is closed";
    Error::syntax(&file.name, &file.bytes, place, what, "a line that ends where it begins", hint)
}

fn warn_of_size(areas: &[Polygon], warnings: &mut Vec<Warning>) {
    /// As of boards.
    const WIDEST: Nm = Nm::from_mm(620);
    let Some(bounds) = areas.iter().map(Polygon::bounds).reduce(Rect::union) else { return };
    let (width, height) = (bounds.width(), bounds.height());
    if width.max(height) > WIDEST {
        let message =
            format!("the shapes are {width:.1} × {height:.1} mm: the unit of the file may be wrong");
        warnings.push(diagnostic::SIZE_IMPLAUSIBLE.warning(message));
    }
}
