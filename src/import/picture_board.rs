//! Pictures among what was named → their board.

use std::path::{Path, PathBuf};

use super::archive::{name_of, read_file, read_head};
use super::build::Loaded;
use super::diagnostic;
use super::error::Error;
use super::naming;
use super::picture::{Picture, Registration, Traced, is_picture, register};
use super::selection::Selection;
use crate::board::diagnostic::count;
use crate::board::{Attributes, Board, Copper, Hole, Side, Source, Warning, Words};

/// The board of pictures among what was named; none where there is no picture.
pub(super) fn load(paths: &[PathBuf], selection: &Selection) -> Result<Option<Loaded>, Error> {
    let is_file = |path: &&PathBuf| path.is_file();
    let named: Vec<&PathBuf> =
        paths.iter().chain(&selection.front).chain(&selection.back).filter(is_file).collect();
    let mut pictures: Vec<&PathBuf> = Vec::new();
    for path in &named {
        if !pictures.contains(path) && is_picture(path, &read_head(path, &path.display().to_string())?) {
            pictures.push(path);
        }
    }
    let Some(&first) = pictures.first() else { return Ok(None) };
    let others = paths.iter().chain(&selection.front).chain(&selection.back).chain(&selection.outline);
    if let Some(other) = others.chain(&selection.drill).find(|path| !pictures.contains(path)) {
        let what = "a picture and other files cannot be combined: their alignment is unknown";
        return Err(Error::content(&other.display().to_string(), what, "give the picture alone"));
    }
    let (front, back) = match (&selection.front, &selection.back) {
        (None, None) => (pictures.first().copied(), None),
        (front, back) => (front.as_ref(), back.as_ref()),
    };
    if let Some(open) = pictures.iter().find(|path| front != Some(**path) && back != Some(**path)) {
        let hint = Words::of("choose the picture of each side with {front} and {back}");
        return Err(Error::content(&open.display().to_string(), "the side of this picture is unknown", hint));
    }
    let name = selection.name.clone().unwrap_or_else(|| naming::stem(&name_of(first)).to_owned());
    let mut loaded = Loaded {
        board: Board { name, ..Board::default() },
        sources: Vec::new(),
        warnings: Vec::new(),
        ignored: Vec::new(),
    };
    let traced = |path: Option<&PathBuf>| -> Result<Option<Traced>, Error> {
        let Some(path) = path else { return Ok(None) };
        let shown = path.display().to_string();
        Traced::read(&shown, &read_file(path, &shown)?, &selection.picture).map(Some)
    };
    let (front_picture, mut back_picture) = (traced(front)?, traced(back)?);
    let mut is_laid = false;
    if let (Some(seen), Some(path)) = (&front_picture, back)
        && let Some(unmoved) = back_picture.take()
    {
        let (moved, is_known) = registered(seen, unmoved, path, &mut loaded.warnings)?;
        (back_picture, is_laid) = (Some(moved), is_known);
    }
    for (side, path, picture) in [(Side::Front, front, front_picture), (Side::Back, back, back_picture)] {
        if let (Some(path), Some(picture)) = (path, picture) {
            add(&mut loaded, (side, path), picture.picture()?, is_laid, selection);
        }
    }
    Ok(Some(loaded))
}

/// The picture of the back, moved onto that of the front by the drill dots of both; as it is where
/// they do not tell, with a warning. And whether they do.
fn registered(
    front: &Traced,
    back: Traced,
    path: &Path,
    warnings: &mut Vec<Warning>,
) -> Result<(Traced, bool), Error> {
    let (front_dots, back_dots) = (front.dots(), back.dots());
    let pixel = front.pixel().max(back.pixel());
    let counts = format!("{} drill dots on the front and {} on the back", front_dots.len(), back_dots.len());
    let unknown = |why: String| diagnostic::PICTURES_NOT_REGISTERED.warning(why);
    let warning = match register(&front_dots, &back_dots, pixel) {
        Registration::Aligned => return Ok((back, true)),
        Registration::Moved(fit) => {
            let (x, y) = fit.motion.place((0.0, 0.0));
            let message = format!(
                "the picture of the back is turned by {:.3} degrees and its corner moved to {:.3}, {:.3} mm: of {counts}, \
                 {} meet, {:.1} µm apart on average and {:.1} µm at most",
                fit.motion.degrees(),
                x / 1e6,
                y / 1e6,
                fit.count,
                fit.mean / 1e3,
                fit.worst / 1e3,
            );
            warnings.push(diagnostic::PICTURES_REGISTERED.warning(message).on(Side::Back));
            return Ok((back.moved(&fit.motion), true));
        }
        Registration::Mirrored(count) => {
            let what = format!(
                "this picture of the back is mirrored: of {counts}, {count} meet once it is mirrored, and not without"
            );
            let hint = "the back is seen from the front: mirror the picture left to right";
            return Err(Error::content(&path.display().to_string(), what, hint));
        }
        Registration::TooFew(_) => unknown(format!("{counts} are too few to lay the pictures on each other")),
        Registration::Apart(count) => {
            unknown(format!("of {counts}, {count} at most meet, however the back is turned and moved"))
        }
        Registration::Ambiguous(count) => {
            unknown(format!("of {counts}, {count} meet in more than one way to lay the back on the front"))
        }
    };
    warnings.push(warning.on(Side::Back));
    Ok((back, false))
}

/// Whether two drill dots are of the same hole.
fn meets(hole: &Hole, dot: &Hole) -> bool {
    hole.path.start.distance(dot.path.start) < hole.diameter.max(dot.diameter).to_f64() / 2.0
}

/// Adds the picture of a side. The holes are those of the first one added, and those that the
/// other shows besides where it is known to be `laid` on it.
fn add(
    loaded: &mut Loaded,
    (side, path): (Side, &Path),
    picture: Picture,
    is_laid: bool,
    selection: &Selection,
) {
    let copper = Copper { side, features: picture.features, attributes: vec![Attributes::default()] };
    match side {
        Side::Front => loaded.board.front = Some(copper),
        Side::Back => loaded.board.back = Some(copper),
    }
    if loaded.board.holes.is_empty() && !selection.no_drill {
        loaded.board.holes = picture.holes;
    } else if is_laid && !selection.no_drill {
        let holes = &mut loaded.board.holes;
        let alone: Vec<Hole> =
            picture.holes.into_iter().filter(|dot| !holes.iter().any(|hole| meets(hole, dot))).collect();
        if let Some(first) = alone.first() {
            let message = format!(
                "{} of the back that the front does not show: drilled, too",
                count(alone.len(), "drill dot")
            );
            let at = first.path.start;
            loaded.warnings.push(diagnostic::PICTURE_DOTS_DIFFER.warning(message).at(at).on(side));
        }
        holes.extend(alone);
    }
    let role = format!("{side}-copper");
    loaded.sources.push(Source { file: name_of(path), role, ..picture.source });
    loaded.warnings.extend(picture.warnings.into_iter().map(|warning| warning.on(side)));
}
