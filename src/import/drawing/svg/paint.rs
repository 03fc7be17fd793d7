//! Resolved paths → figures: fills and strokes, in the order in which they are painted.

use std::collections::BTreeMap;
use std::rc::Rc;

use rustc_hash::FxHashMap;
use usvg::tiny_skia_path::{self, PathSegment};
use usvg::{
    BlendMode, ClipPath, Group, LineCap, LineJoin, Mask, MaskType, Node, Paint, Path, Transform, Tree,
};

use super::document::{Document, Rank};
use super::size::Size;
use super::window::Window;
use crate::artwork::{Area, Drawn, Effort, Figure, Layer, Line};
use crate::board::polarity::{FillRule, Polarity, TooMuch};
use crate::board::{FLATTEN, Words};
use crate::geometry::{self, Nm, Segment};
use crate::import::drawing::layers::Layers;
use crate::import::drawing::{Contour, Options, Place, leaves};
use crate::import::error::Error;

/// What is fainter is not seen. Chosen: a twentieth of the ink.
const FAINTEST: f32 = 0.05;

/// The least of each colour that is white. Chosen: what programs paint a page with.
const WHITE: u8 = 250;

/// The most of each colour that is black, in a mask. Chosen, as far from it.
const BLACK: u8 = 5;

/// What is less opaque lets the white below it through, in a mask. Chosen.
const OPAQUE: f32 = 0.95;

/// The most lines and arcs of a drawing. Chosen: a gigabyte of them.
const MOST_SEGMENTS: usize = 20_000_000;

/// What was painted.
#[derive(Debug, Default)]
pub(super) struct Painted {
    pub(super) layers: Layers,
    /// Effects that are not followed, and how many of each there are.
    pub(super) effects: BTreeMap<&'static str, u64>,
    /// White figures that erase.
    pub(super) erased: u64,
    /// Paths that nothing is painted of.
    unpainted: u64,
    /// Figures of which a clipping path or a mask shows nothing.
    clipped: u64,
    segments: usize,
    effort: Effort,
    /// Those of clipping paths and masks that are known.
    windows: FxHashMap<Seen, Option<Rc<Window>>>,
}

/// What the group of a clipping path or a mask is drawn as: the group, by its place in memory, what
/// paint does in it, and the bits of the turn.
type Seen = (usize, Ink, [u32; 6]);

/// Paints all of `tree`.
pub(super) fn painted(name: &str, tree: &Tree, document: &Document, size: &Size) -> Result<Painted, Error> {
    let mut painted = Painted::default();
    let scope = Scope {
        name,
        document,
        size,
        layer: String::new(),
        also: None,
        rank: Rank::None,
        opacity: 1.0,
        ink: Ink::Copper,
        turn: Transform::default(),
        window: None,
    };
    painted.group(tree.root(), &scope)?;
    let is_clear = |figure: &&Figure| figure.polarity == Polarity::Clear;
    let clear = painted.layers.figures().filter(is_clear).count() as u64;
    if clear == painted.layers.count() {
        // White alone is what was meant.
        painted.layers.figures_mut().for_each(|figure| figure.polarity = Polarity::Dark);
    } else {
        painted.erased = clear;
    }
    Ok(painted)
}

/// Whether these are Fritzing's groups of copper, one for each side.
fn are_both_sides(a: &str, b: &str) -> bool {
    let is = |name: &str, side: &str| name.eq_ignore_ascii_case(side);
    (is(a, "copper0") && is(b, "copper1")) || (is(a, "copper1") && is(b, "copper0"))
}

/// Where a figure stands.
#[derive(Clone)]
struct Scope<'a> {
    name: &'a str,
    document: &'a Document,
    size: &'a Size,
    layer: String,
    rank: Rank,
    /// The copper of the other side: Fritzing has what goes through the board in one side's group
    /// within the other's.
    also: Option<String>,
    opacity: f32,
    ink: Ink,
    /// From the page of a clipping path or a mask to that of the drawing.
    turn: Transform,
    /// Where it is seen; everywhere, if there is none.
    window: Option<Rc<Window>>,
}

/// What paint does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Ink {
    /// White erases, all else is copper.
    Copper,
    /// All paint covers: in a clipping path, and in a mask of alpha.
    Shape,
    /// White shows and black hides: in a mask of luminance.
    Light,
}

impl Scope<'_> {
    fn too_much(&self, _: TooMuch) -> Error {
        let what = "clipping paths and masks of the drawing take too long to apply";
        Error::content(self.name, what, "apply them in the drawing program, so that only paths are left")
    }
}

impl Painted {
    /// What is not drawn, in words.
    pub(super) fn left_out(&self, document: &Document, options: &Options) -> Vec<String> {
        let texts = if options.fonts.is_empty() { document.texts } else { 0 };
        let all = [
            (document.hidden, "hidden elements", "1 hidden element"),
            (self.unpainted, "paths without fill and stroke", "1 path without fill and stroke"),
            (
                self.clipped,
                "shapes that are clipped or masked away",
                "1 shape that is clipped or masked away",
            ),
            (texts, "texts without a font ({font})", "1 text without a font ({font})"),
            (document.images, "images", "1 image"),
        ];
        let present = all.into_iter().filter(|(count, ..)| *count > 0);
        present
            .map(|(count, many, one)| match count {
                1 => Words::of(one).to_string(),
                _ => format!("{count} {}", Words::of(many)),
            })
            .collect()
    }

    fn group(&mut self, group: &Group, above: &Scope<'_>) -> Result<(), Error> {
        let mut scope = above.clone();
        if above.ink == Ink::Copper
            && let Some((name, rank)) = above.document.group(group.id())
        {
            if rank.counts_in(above.rank) || leaves(name, &above.layer) {
                (scope.layer, scope.rank, scope.also) = (name.to_owned(), rank, None);
            } else if are_both_sides(name, &above.layer) {
                scope.also = Some(name.to_owned());
            }
        }
        scope.opacity *= group.opacity().get();
        if !group.filters().is_empty() {
            self.effect("filters");
        }
        if group.blend_mode() != BlendMode::Normal {
            self.effect("blend modes");
        }
        self.narrow(group, &mut scope)?;
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, &scope)?,
                Node::Path(path) => self.path(path, &scope)?,
                Node::Text(text) => self.group(text.flattened(), &scope)?,
                // Images of the drawing are counted as its elements are.
                Node::Image(_) if scope.ink == Ink::Copper => {}
                Node::Image(_) => self.effect("images in masks"),
            }
        }
        Ok(())
    }

    fn effect(&mut self, what: &'static str) {
        *self.effects.entry(what).or_insert(0) += 1;
    }

    /// Narrows the window of `scope` to what the clipping path and the mask of `group` show.
    fn narrow(&mut self, group: &Group, scope: &mut Scope<'_>) -> Result<(), Error> {
        let inner = Scope {
            ink: Ink::Shape,
            turn: scope.turn.pre_concat(group.abs_transform()),
            window: None,
            opacity: 1.0,
            ..scope.clone()
        };
        let mut windows = Vec::new();
        if let Some(clip) = group.clip_path() {
            self.clip(clip, &inner, &mut windows)?;
        }
        if let Some(mask) = group.mask()
            && !self.mask(mask, &inner, &mut windows)?
        {
            self.effect("masks that are not black and white");
        }
        for window in windows {
            let both = match &scope.window {
                None => window,
                Some(outer) => {
                    let both = outer.and(&window, &mut self.effort);
                    Rc::new(both.map_err(|error| scope.too_much(error))?)
                }
            };
            scope.window = Some(both);
        }
        Ok(())
    }

    /// The windows of a clipping path and of those set on it.
    fn clip(
        &mut self,
        clip: &ClipPath,
        scope: &Scope<'_>,
        windows: &mut Vec<Rc<Window>>,
    ) -> Result<(), Error> {
        let inner = Scope { turn: scope.turn.pre_concat(clip.transform()), ..scope.clone() };
        windows.extend(self.covered(clip.root(), &inner)?);
        match clip.clip_path() {
            Some(above) => self.clip(above, scope, windows),
            None => Ok(()),
        }
    }

    /// The windows of a mask and of those set on it; false, and none, where one is no area.
    fn mask(&mut self, mask: &Mask, scope: &Scope<'_>, windows: &mut Vec<Rc<Window>>) -> Result<bool, Error> {
        let before = windows.len();
        let mut next = Some(mask);
        while let Some(mask) = next {
            let ink = if mask.kind() == MaskType::Alpha { Ink::Shape } else { Ink::Light };
            let Some(window) = self.covered(mask.root(), &Scope { ink, ..scope.clone() })? else {
                windows.truncate(before);
                return Ok(false);
            };
            windows.push(window);
            let rect = tiny_skia_path::PathBuilder::from_rect(mask.rect().to_rect());
            let contours = contours(&rect, true, scope.turn, scope)?;
            let area = Area { contours, rule: FillRule::NonZero }.polygons(FLATTEN);
            let window = area.and_then(|pieces| Window::new(pieces, &mut self.effort));
            windows.push(Rc::new(window.map_err(|error| scope.too_much(error))?));
            next = mask.mask();
        }
        Ok(true)
    }

    /// What the group of a clipping path or a mask covers; none where that is no area. Of groups
    /// that are clipped by the same one it is worked out once.
    fn covered(&mut self, root: &Group, scope: &Scope<'_>) -> Result<Option<Rc<Window>>, Error> {
        let Transform { sx, kx, ky, sy, tx, ty } = scope.turn;
        let turn = [sx, kx, ky, sy, tx, ty].map(f32::to_bits);
        let seen = (std::ptr::from_ref(root).addr(), scope.ink, turn);
        if let Some(known) = self.windows.get(&seen) {
            return Ok(known.clone());
        }
        let window = self.painted_over(root, scope)?.map(Rc::new);
        self.windows.insert(seen, window.clone());
        Ok(window)
    }

    fn painted_over(&mut self, root: &Group, scope: &Scope<'_>) -> Result<Option<Window>, Error> {
        let mut inner = Self { segments: self.segments, effort: self.effort, ..Self::default() };
        inner.group(root, scope)?;
        (self.segments, self.effort) = (inner.segments, inner.effort);
        if !inner.effects.is_empty() {
            return Ok(None);
        }
        let figures = inner.layers.into_artwork().into_figures();
        let window = || {
            let pieces = Layer { name: String::new(), figures }.polygons_at(FLATTEN, &mut self.effort)?;
            Window::new(pieces, &mut self.effort)
        };
        window().map(Some).map_err(|error| scope.too_much(error))
    }

    fn path(&mut self, path: &Path, scope: &Scope<'_>) -> Result<(), Error> {
        let fill = path.fill().filter(|fill| fill.opacity().get() * scope.opacity >= FAINTEST);
        let stroke = path.stroke().filter(|stroke| stroke.opacity().get() * scope.opacity >= FAINTEST);
        if !path.is_visible() || (fill.is_none() && stroke.is_none()) {
            self.unpainted += 1;
            return Ok(());
        }
        let shape = Shape { path, scope };
        let mut figures = Vec::new();
        if let Some(fill) = fill {
            let rule = match fill.rule() {
                usvg::FillRule::NonZero => FillRule::NonZero,
                usvg::FillRule::EvenOdd => FillRule::EvenOdd,
            };
            // A path of one point fills nothing.
            let contours = shape.contours(path.data(), true)?;
            let contours: Vec<_> = contours.into_iter().filter(geometry::Path::is_closed).collect();
            if !contours.is_empty() {
                let drawn = Drawn::Area(Area { contours, rule });
                figures.push(self.figure(drawn, fill.paint(), fill.opacity().get(), scope));
            }
        }
        if let Some(stroke) = stroke {
            for drawn in shape.stroked(stroke)? {
                figures.push(self.figure(drawn, stroke.paint(), stroke.opacity().get(), scope));
            }
        }
        if path.paint_order() == usvg::PaintOrder::StrokeAndFill {
            figures.reverse();
        }
        if figures.is_empty() {
            self.unpainted += 1;
        }
        for figure in &figures {
            self.segments += figure.paths().iter().map(|path| path.segments.len()).sum::<usize>();
        }
        if self.segments > MOST_SEGMENTS {
            let what = format!("the drawing has more than {MOST_SEGMENTS} lines and arcs");
            return Err(Error::content(scope.name, what, "simplify it, or draw it without dashes"));
        }
        for figure in figures {
            let seen = match &scope.window {
                None => Some(figure),
                Some(window) => {
                    window.cut(figure, &mut self.effort).map_err(|error| scope.too_much(error))?
                }
            };
            self.clipped += u64::from(seen.is_none());
            if let Some(also) = &scope.also {
                self.layers.of(also).extend(seen.clone());
            }
            self.layers.of(&scope.layer).extend(seen);
        }
        Ok(())
    }

    fn figure(&mut self, drawn: Drawn, paint: &Paint, opacity: f32, scope: &Scope<'_>) -> Figure {
        let colour = match paint {
            Paint::Color(colour) => Some(colour),
            Paint::LinearGradient(_) | Paint::RadialGradient(_) => {
                self.effect("gradients");
                None
            }
            Paint::Pattern(_) => {
                self.effect("patterns");
                None
            }
        };
        let is_white = colour.is_some_and(|c| c.red.min(c.green).min(c.blue) >= WHITE);
        let is_black = colour.is_some_and(|c| c.red.max(c.green).max(c.blue) <= BLACK);
        let polarity = match scope.ink {
            Ink::Shape => Polarity::Dark,
            Ink::Copper if is_white => Polarity::Clear,
            Ink::Copper => Polarity::Dark,
            Ink::Light if is_white => Polarity::Dark,
            Ink::Light => {
                if !is_black || opacity * scope.opacity < OPAQUE {
                    self.effect("greys");
                }
                Polarity::Clear
            }
        };
        Figure { drawn, polarity, line: 1 }
    }
}

/// A path with where it stands.
struct Shape<'a> {
    path: &'a Path,
    scope: &'a Scope<'a>,
}

impl Shape<'_> {
    /// From the path to the page of the drawing.
    fn turn(&self) -> Transform {
        self.scope.turn.pre_concat(self.path.abs_transform())
    }

    /// A stroke as the lines of a round pen, or where it is none as what it covers.
    fn stroked(&self, stroke: &usvg::Stroke) -> Result<Vec<Drawn>, Error> {
        let pixel = self.scope.size.pixel.nanometres();
        let (x, y, is_similar) = scales(self.turn());
        let width = Nm::from_f64(f64::from(stroke.width().get()) * (x * y).sqrt() * pixel);
        // A pixel to the stroker is 250 nm.
        #[expect(clippy::cast_possible_truncation, reason = "a scale")]
        let scale = (x.max(y) * pixel / 250.0) as f32;
        let mut pen = stroke.to_tiny_skia();
        let dashes = stroke.dasharray().map(|lengths| dashes(self.path.data(), lengths));
        let middle = match (dashes, pen.dash.take()) {
            (Some(dashes), _) if dashes > MOST_DASHES => {
                let what = "a line has more than a million dashes";
                return Err(Error::content(self.scope.name, what, "draw it without dashes"));
            }
            (_, Some(dash)) => match self.path.data().dash(&dash, scale) {
                Some(middle) => Some(middle),
                // All of it is a gap.
                None => return Ok(Vec::new()),
            },
            (_, None) => None,
        };
        let data = middle.as_ref().unwrap_or_else(|| self.path.data());
        let paths = self.contours(data, false)?;
        let is_round = stroke.linecap() == LineCap::Round && stroke.linejoin() == LineJoin::Round;
        if is_similar && (is_round || paths.iter().all(is_circle)) {
            return Ok(paths
                .into_iter()
                .map(|path| Drawn::Line(Line { path, width, painted: None }))
                .collect());
        }
        // Each part by itself, so that a line and what it covers stay together.
        let mut drawn = Vec::new();
        for (part, path) in parts(data).into_iter().zip(paths) {
            let Some(edge) = part.and_then(|part| part.stroke(&pen, scale)) else { continue };
            let painted = Area { contours: self.contours(&edge, true)?, rule: FillRule::NonZero };
            drawn.push(Drawn::Line(Line { path, width, painted: Some(painted) }));
        }
        Ok(drawn)
    }

    /// The parts of `data` on the board; closed ones only, where an area is meant.
    fn contours(&self, data: &tiny_skia_path::Path, closes: bool) -> Result<Vec<geometry::Path>, Error> {
        contours(data, closes, self.turn(), self.scope)
    }
}

/// The parts of `data` on the board, turned by `turn`; closed ones only, where an area is meant.
fn contours(
    data: &tiny_skia_path::Path,
    closes: bool,
    turn: Transform,
    scope: &Scope<'_>,
) -> Result<Vec<geometry::Path>, Error> {
    let place = |p: tiny_skia_path::Point| -> Place {
        let (x, y) = (f64::from(p.x), f64::from(p.y));
        let across = f64::from(turn.sx) * x + f64::from(turn.kx) * y + f64::from(turn.tx);
        let down = f64::from(turn.ky) * x + f64::from(turn.sy) * y + f64::from(turn.ty);
        scope.size.place((across, down))
    };
    let mut done: Vec<Contour> = Vec::new();
    for segment in data.segments() {
        if let PathSegment::MoveTo(p) = segment {
            done.push(Contour::new(place(p)));
            continue;
        }
        let Some(contour) = done.last_mut() else { continue };
        match segment {
            PathSegment::MoveTo(_) => {}
            PathSegment::LineTo(p) => contour.line(place(p)),
            PathSegment::QuadTo(a, p) => contour.quadratic(place(a), place(p)),
            PathSegment::CubicTo(a, b, p) => contour.cubic(place(a), place(b), place(p)),
            PathSegment::Close => contour.close(),
        }
    }
    let finished = done.into_iter().map(|mut contour| {
        if closes {
            contour.close();
        }
        contour.finish()
    });
    finished.collect::<Option<Vec<_>>>().ok_or_else(|| {
        let what = "a path lies more than 1073 mm from the corner of the page";
        Error::content(scope.name, what, Words::of("set its unit with {unit}, or move it to the page"))
    })
}

/// Dashes of a line. What `tiny-skia-path` makes at most.
const MOST_DASHES: f64 = 1e6;

/// How many dashes a path has at most, by the length of the lines between its control points.
#[expect(clippy::cast_precision_loss, reason = "an estimate")]
fn dashes(data: &tiny_skia_path::Path, lengths: &[f32]) -> f64 {
    let far = |a: tiny_skia_path::Point, b: tiny_skia_path::Point| f64::from(a.distance(b));
    let (mut first, mut last) = (tiny_skia_path::Point::zero(), tiny_skia_path::Point::zero());
    let mut length = 0.0;
    for segment in data.segments() {
        let (way, end) = match segment {
            PathSegment::MoveTo(p) => {
                first = p;
                (0.0, p)
            }
            PathSegment::LineTo(p) => (far(last, p), p),
            PathSegment::QuadTo(a, p) => (far(last, a) + far(a, p), p),
            PathSegment::CubicTo(a, b, p) => (far(last, a) + far(a, b) + far(b, p), p),
            PathSegment::Close => (far(last, first), first),
        };
        length += way;
        last = end;
    }
    let period: f64 = lengths.iter().copied().map(f64::from).sum();
    length * lengths.len() as f64 / 2.0 / period
}

/// Each part of a path by itself, as many as it has moves.
fn parts(data: &tiny_skia_path::Path) -> Vec<Option<tiny_skia_path::Path>> {
    let mut builders: Vec<tiny_skia_path::PathBuilder> = Vec::new();
    for segment in data.segments() {
        if let PathSegment::MoveTo(p) = segment {
            let mut builder = tiny_skia_path::PathBuilder::new();
            builder.move_to(p.x, p.y);
            builders.push(builder);
            continue;
        }
        let Some(builder) = builders.last_mut() else { continue };
        match segment {
            PathSegment::MoveTo(_) => {}
            PathSegment::LineTo(p) => builder.line_to(p.x, p.y),
            PathSegment::QuadTo(a, p) => builder.quad_to(a.x, a.y, p.x, p.y),
            PathSegment::CubicTo(a, b, p) => builder.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y),
            PathSegment::Close => builder.close(),
        }
    }
    builders.into_iter().map(tiny_skia_path::PathBuilder::finish).collect()
}

/// How much a transform stretches along its two axes, and whether a circle stays one.
fn scales(turn: Transform) -> (f64, f64, bool) {
    let [a, b, c, d] = [turn.sx, turn.ky, turn.kx, turn.sy].map(f64::from);
    // The singular values of the matrix.
    let (sum, difference) = (libm::hypot(a + d, b - c), libm::hypot(a - d, b + c));
    let (large, small) = (f64::midpoint(sum, difference), (sum - difference).abs() / 2.0);
    (large, small, large - small <= large * 1e-5)
}

/// Whether a path is arcs of one circle all the way round: it has neither ends nor corners.
fn is_circle(path: &geometry::Path) -> bool {
    let mut middles = path.segments.iter().map(|segment| match segment {
        Segment::Arc { center, .. } => Some(*center),
        Segment::Line { .. } => None,
    });
    let Some(Some(first)) = middles.next() else { return false };
    /// Middles are rounded, and 32-bit floats. In nanometres; chosen.
    const SAME: f64 = 200.0;
    path.is_closed() && middles.all(|middle| middle.is_some_and(|p| p.distance(first) < SAME))
}
