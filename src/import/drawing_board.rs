//! Drawings among what was named → their parts on a board, beside its other files.

use std::path::{Path, PathBuf};

use super::advice::quoted;
use super::archive::{Found, name_of, read_file, read_head};
use super::build::{Build, Loaded};
use super::drawing::{self, Drawing, Part, Parts, split};
use super::error::Error;
use super::format::Kind;
use super::gerber::Image;
use super::layers::{Role, is_surely_aside};
use super::selection::{Need, Selection};
use super::{naming, outline, picture};
use crate::artwork::{self, Figure, Layer};
use crate::board::diagnostic::count;
use crate::board::{Attributes, Axis, Feature, Hole, Shape, Side, Source, Words};
use crate::geometry::{Nm, Path as Course};
use crate::import::diagnostic;

/// A drawing that was named.
pub(super) struct Named {
    pub(super) file: Found,
    pub(super) drawing: Drawing,
    /// The layer of it that is meant.
    pub(super) layer: Option<String>,
    /// What a person said it is.
    role: Option<Role>,
}

/// The board of drawings among what was named; none where there is no drawing. `others` puts a
/// board together from the other files.
pub(super) fn load(
    paths: &[PathBuf],
    selection: &Selection,
    need: Need,
    others: impl FnOnce(&[PathBuf], &Selection, Need) -> Result<Loaded, Error>,
) -> Result<Option<Loaded>, Error> {
    let mut rest = selection.clone();
    let mut named = Vec::new();
    let slots = [
        (&mut rest.front, Role::Copper(Side::Front)),
        (&mut rest.back, Role::Copper(Side::Back)),
        (&mut rest.outline, Role::Outline),
    ];
    let mut chosen = Vec::new();
    for (slot, role) in slots {
        if let Some(drawing) =
            slot.as_ref().map(|path| named_as(path, Some(role), &selection.drawing)).transpose()?.flatten()
        {
            named.push(drawing);
            chosen.extend(slot.take());
        }
    }
    for path in std::mem::take(&mut rest.drill) {
        match named_as(&path, Some(Role::Drill), &selection.drawing)? {
            Some(drawing) => {
                named.push(drawing);
                chosen.push(path);
            }
            None => rest.drill.push(path),
        }
    }
    let mut left = Vec::new();
    for path in paths.iter().filter(|path| !chosen.contains(path)) {
        match named_as(path, None, &selection.drawing)? {
            Some(drawing) => named.push(drawing),
            None => left.push(path.clone()),
        }
    }
    let Some(first) = named.first() else { return Ok(None) };
    let shown = first.file.shown.clone();
    let mut build = Build::new(naming::whole_board_name(&first.file.name, selection));
    let mut ignored = Vec::new();
    let selected = [&rest.front, &rest.back, &rest.outline].into_iter().flatten().chain(&rest.drill);
    if selected.clone().next().is_some() || !left.is_empty() {
        refuse_pictures(left.iter().chain(selected))?;
        let loaded = others(&left, &rest, Need::AnyLayer)?;
        (build.board, build.sources, build.warnings) = (loaded.board, loaded.sources, loaded.warnings);
        ignored = loaded.ignored;
    }
    for named in named {
        add(&mut build, named, selection, need)?;
    }
    finish(&mut build, &shown, need)?;
    Ok(Some(Loaded { board: build.board, sources: build.sources, warnings: build.warnings, ignored }))
}

/// What was named, read, if it is a drawing.
pub(super) fn named_as(
    path: &Path,
    role: Option<Role>,
    options: &drawing::Options,
) -> Result<Option<Named>, Error> {
    let (file, layer) = split(path);
    if !file.is_file() {
        return Ok(None);
    }
    let shown = file.display().to_string();
    if !drawing::looks_like(&read_head(&file, &shown)?) {
        return Ok(None);
    }
    let bytes = read_file(&file, &shown)?;
    let drawing = drawing::read(&name_of(&file), &bytes, options)?;
    let file = Found { name: name_of(&file), shown, bytes, kind: Kind::Unknown, named: true };
    Ok(Some(Named { file, drawing, layer, role }))
}

fn refuse_pictures<'a>(paths: impl Iterator<Item = &'a PathBuf>) -> Result<(), Error> {
    for path in paths.filter(|path| path.is_file()) {
        let shown = path.display().to_string();
        if picture::is_picture(path, &read_head(path, &shown)?) {
            let what = "a picture and a drawing cannot be combined: their alignment is unknown";
            return Err(Error::content(&shown, what, "give the picture alone"));
        }
    }
    Ok(())
}

/// Takes over what one drawing has.
fn add(build: &mut Build, named: Named, selection: &Selection, need: Need) -> Result<(), Error> {
    let Named { file, drawing: Drawing { artwork, source, warnings }, layer, role } = named;
    build.warnings.extend(warnings);
    let artwork = match layer {
        None => artwork,
        Some(name) => drawing::layer(artwork, &file.shown, &name)?,
    };
    let parts = match role {
        Some(role) => {
            Parts { parts: vec![Part { role, figures: artwork.into_figures() }], ..Parts::default() }
        }
        None => Parts::of(artwork),
    };
    if parts.stray > 0 && need == Need::Job {
        let shapes =
            if parts.stray == 1 { "1 shape is".to_owned() } else { format!("{} shapes are", parts.stray) };
        let what = format!("{shapes} in no layer, beside layers of copper: what they belong to is unknown");
        let hint = "put each into a layer; or choose what is milled with {front} {0}#LAYER and {back} {0}#LAYER, which leaves them out";
        return Err(Error::content(&file.shown, what, Words::of(hint).with([&quoted(&file.shown)])));
    }
    if let Some(guess) = parts.guess {
        let message = format!("no layer of {} has a known name: {guess}", file.name);
        build.warnings.push(diagnostic::DRAWING_GUESSED.warning(message));
    }
    let called = |name: &str| if name.is_empty() { "no name".to_owned() } else { format!("`{name}`") };
    let unknown: Vec<String> =
        parts.aside.iter().filter(|(_, what)| what.is_none()).map(|(name, _)| called(name)).collect();
    if !unknown.is_empty() {
        let listed = unknown.join(", ");
        let message = format!("layers of {} with unknown names are ignored: {listed}", file.name);
        build.warnings.push(diagnostic::DRAWING_LAYERS.warning(message));
    }
    let doubtful = |(name, what): &(String, Option<&str>)| {
        what.filter(|what| !is_surely_aside(name, what)).map(|what| format!("{} ({what})", called(name)))
    };
    let doubtful: Vec<String> = parts.aside.iter().filter_map(doubtful).collect();
    if !doubtful.is_empty() {
        let listed = doubtful.join(", ");
        let message = format!("layers of {} are ignored for what their names say: {listed}", file.name);
        build.warnings.push(diagnostic::DRAWING_LAYERS.warning(message));
    }
    for (name, what) in &parts.aside {
        let what = what.unwrap_or("unknown role");
        let role = format!("ignored ({what}: {})", called(name));
        build.sources.push(Source { role, design: String::new(), ..source.clone() });
    }
    for part in parts.parts {
        match part.role {
            Role::Copper(side) => copper(build, (&file, &source), side, part.figures)?,
            Role::Outline => edge(build, (&file, &source), part.figures, selection),
            Role::Drill if selection.no_drill => {}
            Role::Drill => holes(build, (&file, &source), &part.figures),
            Role::Group(_) | Role::Other(_) => {}
        }
    }
    Ok(())
}

/// Puts aside what other files had for a role that a drawing takes.
fn replace(build: &mut Build, role: &str) {
    for source in build.sources.iter_mut().filter(|source| source.role == role) {
        source.role = format!("ignored (another {role} was chosen)");
        source.design = String::new();
    }
}

fn copper(
    build: &mut Build,
    (file, source): (&Found, &Source),
    side: Side,
    figures: Vec<Figure>,
) -> Result<(), Error> {
    let layer = Layer { name: String::new(), figures };
    let too_much = |_| {
        let what = "areas cross each other or themselves too often to be worked out".to_owned();
        Error::content(&file.shown, what, "draw with fewer crossings")
    };
    let features = layer.into_features().map_err(too_much)?;
    replace(build, &format!("{side}-copper"));
    match side {
        Side::Front => build.board.front = None,
        Side::Back => build.board.back = None,
    }
    let source = source.clone();
    let attributes = vec![Attributes::default()];
    let image = Image { features, attributes, source, function: None, warnings: Vec::new() };
    build.copper(file, image, side);
    Ok(())
}

fn edge(build: &mut Build, (file, source): (&Found, &Source), figures: Vec<Figure>, selection: &Selection) {
    let features = figures.into_iter().flat_map(|figure| middles(&figure));
    let gap = selection.outline_gap.unwrap_or(outline::GAP);
    let joined = outline::join(&file.name, &file.bytes, features, gap);
    replace(build, "outline");
    build.sources.push(Source { role: "outline".to_owned(), ..source.clone() });
    build.board.outline = joined.outline;
    build.warnings.extend(joined.warnings);
}

/// The contours of an area, or the middle of a line, as bare lines.
pub(super) fn middles(figure: &Figure) -> Vec<Feature> {
    let radius = figure.radius();
    let mut features = Vec::new();
    for path in figure.paths() {
        let closed;
        let path = if matches!(figure.drawn, artwork::Drawn::Area(_)) && !path.is_closed() {
            closed = close(path);
            &closed
        } else {
            path
        };
        for (from, segment) in path.steps() {
            let to = segment.to();
            let (shape, axis) = match segment.arc(from) {
                Some(arc) => (Shape::Arc { arc, radius }, Axis::Arc(arc)),
                None if from == to => continue,
                None => (Shape::Stroke { from, to, radius }, Axis::Line(from, to)),
            };
            features.push(Feature { shape, axis, attributes: 0, line: figure.line });
        }
    }
    features
}

fn close(path: &Course) -> Course {
    let mut path = path.clone();
    path.segments.push(crate::geometry::Segment::Line { to: path.start });
    path
}

/// Takes over the round and obround figures as holes, small ones first.
fn holes(build: &mut Build, (file, source): (&Found, &Source), figures: &[Figure]) {
    let mut holes: Vec<Hole> = Vec::new();
    let mut left_out: Vec<&Figure> = Vec::new();
    for figure in figures {
        // One figure may draw many circles. Of a ring the inner edge is drilled.
        let single: Vec<Figure> = match &figure.drawn {
            artwork::Drawn::Area(area) if area.contours.len() > 1 => {
                let of = |path: &Course| artwork::Area { contours: vec![path.clone()], rule: area.rule };
                let one = |path| Figure { drawn: artwork::Drawn::Area(of(path)), ..figure.clone() };
                artwork::innermost(&area.contours).into_iter().map(one).collect()
            }
            artwork::Drawn::Area(_) | artwork::Drawn::Line(_) => vec![figure.clone()],
        };
        for one in single {
            match artwork::hole(&one) {
                Some(hole) => holes.push(hole),
                None => left_out.push(figure),
            }
        }
    }
    // Coordinates that were rounded make one size several. Chosen: a micrometre.
    const STEP: f64 = 1_000.0;
    for hole in &mut holes {
        hole.diameter = Nm::from_f64((hole.diameter.to_f64() / STEP).round() * STEP).max(Nm::from_um(1));
    }
    let mut sizes: Vec<Nm> = holes.iter().map(|hole| hole.diameter).collect();
    sizes.sort();
    sizes.dedup();
    for hole in &mut holes {
        let at = sizes.binary_search(&hole.diameter).unwrap_or_default();
        hole.tool = u32::try_from(at + 1).unwrap_or(u32::MAX);
    }
    let mut warnings = Vec::new();
    if let Some(first) = left_out.first() {
        let message = format!(
            "neither round nor obround, and so not drilled: {} among the holes of {}",
            count(left_out.len(), "shape"),
            file.name
        );
        let warning = diagnostic::NOT_A_HOLE.warning(message);
        let at = first.bounds().map(|bounds| bounds.min()).unwrap_or_default();
        warnings.push(warning.at(at).caused_by(file.at_line(first.line)));
    }
    build.sources.push(Source { role: "drill".to_owned(), ..source.clone() });
    build.add_holes(holes, file, &mut warnings);
    build.warnings.append(&mut warnings);
}

/// What a board must have.
fn finish(build: &mut Build, shown: &str, need: Need) -> Result<(), Error> {
    let has_copper = build.board.front.is_some() || build.board.back.is_some();
    let missing = [diagnostic::COPPER_MISSING, diagnostic::OUTLINE_MISSING, diagnostic::SIZE_IMPLAUSIBLE];
    build.warnings.retain(|warning| !missing.contains(warning.kind));
    if !has_copper {
        build.warnings.push(diagnostic::COPPER_MISSING.warning("there is no copper layer among the files"));
    }
    if !build.sources.iter().any(|source| source.role == "outline") {
        let message = "there is no outline among the files, so the edge of the board is unknown";
        build.warnings.push(diagnostic::OUTLINE_MISSING.warning(message));
    }
    build.warn_of_size();
    if need == Need::Job {
        build.refuse_size(shown)?;
        if !has_copper && build.board.holes.is_empty() && build.board.outline.is_none() {
            let hint = Words::of(
                "name the layers of the drawing, or choose them with {front}, {outline} or {drill}",
            );
            return Err(Error::content(shown, "nothing of it can be milled", hint));
        }
    }
    Ok(())
}
