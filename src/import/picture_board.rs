//! Pictures among what was named → their board.

use std::path::{Path, PathBuf};

use super::archive::{name_of, read_file};
use super::build::Loaded;
use super::error::Error;
use super::naming;
use super::picture::{is_picture, read};
use super::selection::Selection;
use crate::board::{Attributes, Board, Copper, Side, Source, Words};

/// The board of pictures among what was named; none where there is no picture.
pub(super) fn load(paths: &[PathBuf], selection: &Selection) -> Result<Option<Loaded>, Error> {
    let is_file = |path: &&PathBuf| path.is_file();
    let named: Vec<&PathBuf> =
        paths.iter().chain(&selection.front).chain(&selection.back).filter(is_file).collect();
    let mut pictures: Vec<&PathBuf> = Vec::new();
    for path in &named {
        if !pictures.contains(path) && is_picture(path, &read_file(path, &path.display().to_string())?) {
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
    for (side, path) in [(Side::Front, front), (Side::Back, back)] {
        if let Some(path) = path {
            add(&mut loaded, side, path, selection)?;
        }
    }
    Ok(Some(loaded))
}

/// Reads the picture of a side. The holes are those of the first one read.
fn add(loaded: &mut Loaded, side: Side, path: &Path, selection: &Selection) -> Result<(), Error> {
    let shown = path.display().to_string();
    let bytes = read_file(path, &shown)?;
    let picture = read(&shown, &bytes, &selection.picture)?;
    let copper = Copper { side, features: picture.features, attributes: vec![Attributes::default()] };
    match side {
        Side::Front => loaded.board.front = Some(copper),
        Side::Back => loaded.board.back = Some(copper),
    }
    if loaded.board.holes.is_empty() && !selection.no_drill {
        loaded.board.holes = picture.holes;
    }
    let role = format!("{side}-copper");
    loaded.sources.push(Source { file: name_of(path), role, ..picture.source });
    loaded.warnings.extend(picture.warnings.into_iter().map(|warning| warning.on(side)));
    Ok(())
}
