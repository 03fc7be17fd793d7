//! A KiCad board instead of layers: one file that has both sides, the edge and the holes.
//!
//! A folder of layers with the board they were plotted from beside them is a folder of layers: the
//! plots are what a person chose to have made. Only where a folder or an archive has no layer is
//! its board read, as KiCad's project folders are. Where a folder has neither, those inside it are
//! looked into, as EAGLE's `CAMOutputs` and Altium's `Project Outputs` are laid out.

use std::path::PathBuf;

use super::advice::quoted;
use super::archive::{Found, Gathered, Look};
use super::build::{Build, Loaded};
use super::error::Error;
use super::format::Kind;
use super::jobfile::Job;
use super::naming;
use super::selection::{Need, Selection};
use super::{kicad, outline};
use crate::board::{Side, Source, Words};
use crate::import::diagnostic;

/// How deep folders are looked into that have nothing to read themselves. Chosen:
/// `Project/Outputs/Gerber`.
const DEPTH: u32 = 2;

/// What is to be read: `gathered`, or where it has no layer the boards under `paths`, if any; else
/// what folders inside folders hold, if it is one board.
pub(super) fn instead(
    gathered: Gathered,
    paths: &[PathBuf],
    selection: &Selection,
) -> Result<Gathered, Error> {
    if !gathered.files.is_empty() || !gathered.jobs.is_empty() {
        return Ok(gathered);
    }
    for look in [Look { boards: true, depth: 0 }, Look { boards: false, depth: DEPTH }] {
        let found = Gathered::under(paths, &selection.skip, look)?;
        if found.lies_together() {
            // A layer that is damaged must not be replaced in silence.
            gathered.refuse_unusable(&Job::default(), selection)?;
            return Ok(found);
        }
    }
    Ok(gathered)
}

/// Whether a KiCad board is among the files.
pub(super) fn is_among(gathered: &Gathered) -> bool {
    gathered.files.iter().any(|file| file.kind == Kind::Kicad)
}

/// Loads the board that `gathered` is.
pub(super) fn load(mut gathered: Gathered, selection: &Selection, need: Need) -> Result<Loaded, Error> {
    refuse_company(&gathered, selection)?;
    let file = gathered.files.remove(0);
    let layout = kicad::read(&file.name, &file.bytes)?;
    let mut build = Build::new(naming::whole_board_name(&file.name, selection));
    build.board.thickness = layout.thickness;
    build.warnings.extend(layout.warnings);
    for (side, image, name) in [(Side::Front, layout.front, "F.Cu"), (Side::Back, layout.back, "B.Cu")] {
        if gathered.skips_layer(name) {
            build.sources.push(aside(image.source, &format!("{side} copper")));
        } else if !image.features.is_empty() {
            build.copper(&file, image, side);
        }
    }
    if layout.inner > 0 {
        build.sources.push(aside(layout.drill.clone(), "inner copper"));
    }
    if gathered.skips_layer("Edge.Cuts") {
        build.sources.push(aside(layout.edge.source, "outline"));
    } else if layout.edge.features.is_empty() {
        let message = "nothing is drawn on Edge.Cuts, so the edge of the board is unknown";
        build.warnings.push(diagnostic::OUTLINE_MISSING.warning(message));
    } else {
        let gap = selection.outline_gap.unwrap_or(outline::GAP);
        let joined = outline::join(&file.name, &file.bytes, &layout.edge.features, gap);
        build.sources.push(Source { role: "outline".to_owned(), ..layout.edge.source });
        build.board.outline = joined.outline;
        build.warnings.extend(joined.warnings);
    }
    if selection.no_drill {
        build.sources.push(aside(layout.drill, "holes"));
    } else if !layout.holes.is_empty() {
        build.sources.push(Source { role: "drill".to_owned(), ..layout.drill });
        let mut warnings = Vec::new();
        build.add_holes(layout.holes, &file, &mut warnings);
        build.warnings.append(&mut warnings);
    }
    gathered.refuse_unmet_skips()?;
    build.warn_of_size();
    if need == Need::Job {
        build.require_copper(&[&file])?;
        build.refuse_size(&file.shown)?;
    }
    let folders = gathered.folders.into_iter().map(|folder| folder + "/").collect();
    let ignored = [gathered.ignored, folders].concat();
    Ok(Loaded { board: build.board, sources: build.sources, warnings: build.warnings, ignored })
}

/// A part of the board that is left aside.
fn aside(source: Source, what: &str) -> Source {
    Source { role: format!("ignored ({what})"), design: String::new(), ..source }
}

/// A board has all layers, so there is no other file beside it, nor another board.
fn refuse_company(gathered: &Gathered, selection: &Selection) -> Result<(), Error> {
    let is_board = |file: &&Found| file.kind == Kind::Kicad;
    let boards: Vec<&Found> = gathered.files.iter().filter(is_board).collect();
    let first = boards[0];
    if let Some(other) = boards.get(1) {
        let what = format!("there are {} KiCad boards, and only one can be read", boards.len());
        let hint = format!("give one of them: {}, {}", quoted(&first.shown), quoted(&other.shown));
        return Err(Error::content(&first.shown, what, hint));
    }
    let single = [&selection.front, &selection.back, &selection.outline].into_iter().flatten();
    if single.chain(&selection.drill).next().is_some() {
        let what = "a KiCad board has all layers, so no layer file can be given with it";
        let hint = Words::of(
            "give the board alone; {skip} F.Cu, {skip} B.Cu or {skip} Edge.Cuts ignores a layer of it",
        );
        return Err(Error::content(&first.shown, what, hint));
    }
    let other = gathered.files.iter().find(|file| file.kind != Kind::Kicad).map(|file| &file.name);
    if let Some(other) = other.or_else(|| gathered.jobs.first().map(|(name, _)| name)) {
        let what = format!("a KiCad board has all layers, but {other} was given too");
        return Err(Error::content(
            &first.shown,
            what,
            "give the board alone, or its plotted layers without it",
        ));
    }
    Ok(())
}
