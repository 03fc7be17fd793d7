//! Paths → board: which file is what, each read by its reader, and put together.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::advice::{LEAVE_ASIDE, NO_DRILL, quoted};
use super::archive::{Found, Gathered, Look, name_of, read_file};
use super::assign::assign;
use super::build::{Build, Loaded};
use super::describe::describe;
use super::error::Error;
use super::excellon::{self, Context};
use super::format::Kind;
use super::gerber::{ApertureList, Image};
use super::registration::Flashed;
use super::selection::{Need, Selection};
use super::vote::Assigned;
use super::{
    drawing_board, gerber_drill, kicad, layers, off_board, outline, picture_board, registration, whole_board,
};
use crate::board::{Axis, Copper, Diagnostic, Hole, Outline, Side, Source, Warning, Words};
use crate::geometry::{Nm, Rect};
use crate::import::diagnostic;

/// Reads the board in `paths`: folders, zip archives and single files, mixed, or one KiCad board.
/// Folders inside folders are looked into only where the given ones have neither a layer nor a
/// board.
///
/// # Errors
///
/// A path that cannot be read, two files for one role, a copper layer whose side nothing tells, one
/// that was chosen and draws nothing, neither copper nor outline nor holes, or what the readers say
/// of a file.
pub fn load(paths: &[PathBuf], selection: &Selection) -> Result<Loaded, Error> {
    let loaded = put_together(paths, selection, Need::Job)?;
    let chosen = [(Side::Front, &selection.front), (Side::Back, &selection.back)];
    for (side, path) in chosen.into_iter().filter_map(|(side, path)| Some((side, path.as_ref()?))) {
        if loaded.board.copper(side).is_none() {
            let what = format!("chosen as the copper of the {side}, but it draws none");
            let hint = "copper is areas, and lines of a width: export the layer again as Gerber or SVG";
            return Err(Error::content(&path.display().to_string(), what, hint));
        }
    }
    Ok(loaded)
}

/// As [`load()`], to be looked at: copper that draws nothing, or of which only a guess tells the
/// side, is a warning.
///
/// # Errors
///
/// A path that cannot be read, two files for one role, no layer at all, or what the readers say of
/// a file.
pub fn survey(paths: &[PathBuf], selection: &Selection) -> Result<Loaded, Error> {
    put_together(paths, selection, Need::AnyLayer)
}

fn put_together(paths: &[PathBuf], selection: &Selection, need: Need) -> Result<Loaded, Error> {
    if let Some(loaded) = drawing_board::load(paths, selection, need, of_files)? {
        return Ok(loaded);
    }
    of_files(paths, selection, need)
}

/// The board of a picture, of a KiCad board, or of layers.
fn of_files(paths: &[PathBuf], selection: &Selection, need: Need) -> Result<Loaded, Error> {
    if let Some(loaded) = picture_board::load(paths, selection)? {
        return Ok(loaded);
    }
    let mut gathered = Gathered::under(paths, &selection.skip, Look::default())?;
    gathered.add_selected(selection)?;
    let gathered = whole_board::instead(gathered, paths, selection)?;
    if whole_board::is_among(&gathered) {
        return whole_board::load(gathered, selection, need);
    }
    gathered.refuse_unmet_skips()?;
    let assigned = assign(&gathered, paths, selection)?;
    if let (Need::Job, Some(index)) = (need, assigned.guessed) {
        return Err(side_unknown(&gathered.files[index]));
    }
    let mut build = Build::new(assigned.name.clone());
    build.warnings.extend(assigned.warnings.iter().cloned());
    build.coppers(&gathered, &assigned, need)?;
    build.outline(&gathered, &assigned, selection.outline_gap.unwrap_or(outline::GAP))?;
    let pads = Flashed::new(&build.sides());
    build.drills(&gathered, &assigned, need, &pads)?;
    build.register(&gathered, &assigned, need, &pads)?;
    // Who names single files knows which.
    if !selection.no_drill && gathered.files.iter().any(|file| !file.named) {
        build.warn_of_bare_pads();
    }
    build.warn_of_size();
    if need == Need::Job {
        build.refuse_size(&assigned.place)?;
        build.refuse_nothing(assigned.outline.map(|index| &gathered.files[index]))?;
    }
    build.set_aside(&gathered, &assigned);
    let read = [assigned.front, assigned.back, assigned.outline]
        .into_iter()
        .flatten()
        .chain(assigned.drill.iter().copied());
    build.aperture_lists(&gathered, read.map(|index| &gathered.files[index]));
    let used = |list: &ApertureList| build.sources.contains(list.source());
    let unused = gathered.lists.iter().filter(|list| !used(list)).map(|list| list.file.clone()).collect();
    let ignored =
        [gathered.ignored, unused, gathered.folders.into_iter().map(|folder| folder + "/").collect()]
            .concat();
    Ok(Loaded { board: build.board, sources: build.sources, warnings: build.warnings, ignored })
}

/// Reads one layer of copper as the given side, whatever its name and attributes say.
///
/// # Errors
///
/// A path that cannot be read, a file that is neither Gerber nor a drawing, or one that draws
/// nothing.
pub fn load_copper(path: &Path, side: Side) -> Result<Loaded, Error> {
    let told = Some(path.to_path_buf());
    let selection = match side {
        Side::Front => Selection { front: told, ..Selection::default() },
        Side::Back => Selection { back: told, ..Selection::default() },
    };
    if let Some(loaded) = drawing_board::load(&[], &selection, Need::AnyLayer, of_files)? {
        return Ok(loaded);
    }
    let shown = path.display().to_string();
    let name = name_of(path);
    let bytes = read_file(path, &shown)?;
    let kind = Kind::of(&bytes);
    let found = Found { name, shown, bytes, kind, named: true };
    let mut build = Build::new(super::naming::stem(&found.name).to_owned());
    let mut gathered = Gathered::default();
    gathered.look_beside(path, &found.bytes);
    let image = if kind == Kind::Kicad {
        let layout = kicad::read(&found.name, &found.bytes)?;
        build.board.thickness = layout.thickness;
        build.warnings.extend(layout.warnings);
        if side == Side::Front { layout.front } else { layout.back }
    } else {
        read_gerber(&gathered, &found, "a copper layer")?
    };
    build.copper(&found, image, side);
    build.aperture_lists(&gathered, [&found]);
    build.require_copper(&[&found])?;
    Ok(Loaded { board: build.board, sources: build.sources, warnings: build.warnings, ignored: Vec::new() })
}

impl Build {
    fn coppers(&mut self, gathered: &Gathered, assigned: &Assigned, need: Need) -> Result<(), Error> {
        let file = |index: usize| &gathered.files[index];
        let read = |index: Option<usize>| {
            let read = |index| {
                let image = read_gerber(gathered, file(index), "a copper layer")?;
                refuse_cut_off(file(index), image.features.is_empty(), &image.warnings)?;
                Ok((file(index), image))
            };
            index.map(read).transpose()
        };
        let (front, back) = rayon::join(|| read(assigned.front), || read(assigned.back));
        for (side, image) in [(Side::Front, front?), (Side::Back, back?)] {
            if let Some((file, image)) = image {
                self.copper(file, image, side);
            }
        }
        let read: Vec<&Found> = [assigned.front, assigned.back].into_iter().flatten().map(file).collect();
        let has_more = assigned.outline.is_some() || !assigned.drill.is_empty();
        // What nobody knows may be the copper.
        let may_be_copper = |(index, what): &(usize, String)| {
            what == "unknown role" && gathered.files[*index].kind == Kind::Gerber
        };
        let doubtful = need == Need::Job && assigned.aside.iter().any(may_be_copper);
        match need {
            _ if read.is_empty() && (!has_more || doubtful) => Err(no_copper(gathered, assigned)),
            _ if read.is_empty() => {
                self.warnings
                    .push(diagnostic::COPPER_MISSING.warning("there is no copper layer among the files"));
                Ok(())
            }
            Need::Job => self.require_copper(&read),
            Need::AnyLayer => Ok(()),
        }
    }

    fn outline(&mut self, gathered: &Gathered, assigned: &Assigned, gap: Nm) -> Result<(), Error> {
        let Some(file) = assigned.outline.map(|index| &gathered.files[index]) else {
            let message = "there is no outline layer among the files, so the edge of the board is unknown";
            self.warnings.push(diagnostic::OUTLINE_MISSING.warning(message));
            return Ok(());
        };
        let image = read_gerber(gathered, file, "an outline layer")?;
        refuse_cut_off(file, image.features.is_empty(), &image.warnings)?;
        self.warnings.extend(image.warnings);
        self.sources.push(Source { role: "outline".to_owned(), ..image.source });
        let joined = outline::join(&file.name, &file.bytes, &image.features, gap);
        self.board.outline = joined.outline;
        self.warnings.extend(joined.warnings);
        Ok(())
    }

    fn drills(
        &mut self,
        gathered: &Gathered,
        assigned: &Assigned,
        need: Need,
        pads: &Flashed,
    ) -> Result<(), Error> {
        let context = self.context();
        let place = self.board.bounds();
        let mut warnings = Vec::new();
        for &index in &assigned.drill {
            let (file, stands) = (&gathered.files[index], assigned.stands(index, need));
            let (holes, source) = match file.kind {
                Kind::Gerber => {
                    gerber_holes(gathered, file, assigned.by_hand.contains(&index), &mut warnings)
                        .map_err(|error| error.or(NO_DRILL))?
                }
                Kind::Excellon | Kind::Kicad | Kind::Unknown => {
                    let drilling = excellon::read(&file.name, &file.bytes, &context)
                        .map_err(|error| error.or(NO_DRILL))?;
                    refuse_cut_off(file, drilling.holes.is_empty(), &drilling.warnings)
                        .map_err(|error| error.or(NO_DRILL))?;
                    let is_off = |warning: &&Warning| warning.is(&diagnostic::DRILL_OFF_BOARD);
                    if let Some(off) = drilling.warnings.iter().find(is_off)
                        && !stands
                    {
                        return Err(off_board::most(file, off));
                    }
                    warnings.extend(drilling.warnings);
                    (drilling.holes, drilling.source)
                }
            };
            if let Some(stray) = place.and_then(|place| off_board::some(file, &holes, place)) {
                warnings.push(stray.warning);
                stray.refusal.filter(|_| !stands).map_or(Ok(()), Err)?;
            }
            if let Some(misplaced) = pads.drilled(&holes) {
                let warning = diagnostic::LAYERS_NOT_REGISTERED.warning(misplaced.of_holes());
                warnings.push(warning.caused_by(file.first_line()));
                stands.then_some(()).ok_or_else(|| misplaced.refuse_holes(file))?;
            }
            self.sources.push(Source { role: "drill".to_owned(), ..source });
            self.add_holes(holes, file, &mut warnings);
        }
        // Programs write an empty file for a kind of hole that a board does not have.
        let any = !self.board.holes.is_empty();
        warnings.retain(|warning| !(any && warning.is(&diagnostic::DRILL_WITHOUT_HOLES)));
        self.warnings.append(&mut warnings);
        Ok(())
    }

    /// Those that there are.
    fn sides(&self) -> Vec<&Copper> {
        [&self.board.front, &self.board.back].into_iter().flatten().collect()
    }

    /// Pads that are to be drilled, and are not.
    fn warn_of_bare_pads(&mut self) {
        if let Some(undrilled) = registration::undrilled(&self.board.holes, &self.sides()) {
            let warning = diagnostic::PADS_WITHOUT_HOLES.warning(undrilled.message());
            self.warnings.push(warning.at(undrilled.at).on(undrilled.side));
        }
    }

    /// A side whose through-hole pads do not lie on those of the other.
    fn register(
        &mut self,
        gathered: &Gathered,
        assigned: &Assigned,
        need: Need,
        pads: &Flashed,
    ) -> Result<(), Error> {
        let Some((side, misplaced)) = pads.plotted(&self.board.holes) else { return Ok(()) };
        let index = if side == Side::Front { assigned.front } else { assigned.back };
        let Some(index) = index else { return Ok(()) };
        let file = &gathered.files[index];
        if !assigned.stands(index, need) {
            return Err(misplaced.refuse_layer(file, side));
        }
        let warning = diagnostic::LAYERS_NOT_REGISTERED.warning(misplaced.of_pads(side));
        self.warnings.push(warning.on(side).caused_by(file.first_line()));
        Ok(())
    }

    /// An outline that is none, and nothing beside it to mill.
    fn refuse_nothing(&self, outline: Option<&Found>) -> Result<(), Error> {
        let board = &self.board;
        let has_copper = board.front.is_some() || board.back.is_some();
        let Some(outline) = outline.filter(|_| !has_copper && board.holes.is_empty()) else { return Ok(()) };
        if board.outline.is_some() {
            return Ok(());
        }
        let is_outline =
            |warning: &&Warning| [diagnostic::OUTLINE_OPEN, diagnostic::OUTLINE_EMPTY].contains(warning.kind);
        let why = self.warnings.iter().find(is_outline);
        let why = why.map_or("it draws no outline", |warning| warning.message.as_str());
        let hint = "without copper and holes there is nothing else to mill";
        Err(Error::content(&outline.shown, why, hint))
    }

    /// Lists the aperture lists that `files` draw with.
    fn aperture_lists<'a>(&mut self, gathered: &'a Gathered, files: impl IntoIterator<Item = &'a Found>) {
        for file in files {
            // What can be read though there are several draws with none.
            let source = gathered.list_for(file).ok().flatten().map(ApertureList::source);
            self.sources.extend(source.filter(|source| !self.sources.contains(source)).cloned());
        }
    }

    /// What the copper tells about where holes should be.
    fn context(&self) -> Context {
        let coppers = || [&self.board.front, &self.board.back].into_iter().flatten();
        let pads = coppers().flat_map(|copper| &copper.features).filter_map(|feature| match feature.axis {
            Axis::Flash(at) => Some(at),
            Axis::Line(..) | Axis::Arc(_) | Axis::Region => None,
        });
        let edge = self.board.outline.iter().map(Outline::bounds);
        let bounds = coppers().filter_map(Copper::bounds).chain(edge).reduce(Rect::union);
        let context = Context::new(pads, bounds);
        if self.board.outline.is_some() { context.with_edge() } else { context }
    }

    /// Lists the layers that are recognised but not milled.
    fn set_aside(&mut self, gathered: &Gathered, assigned: &Assigned) {
        for (index, what) in &assigned.aside {
            let file = &gathered.files[*index];
            self.sources.push(Source {
                file: file.name.clone(),
                format: file.kind.name().to_owned(),
                role: format!("ignored ({what})"),
                units: String::new(),
                number_format: String::new(),
                sha256: super::digest::sha256(&file.bytes),
                design: String::new(),
                bytes: file.bytes.len() as u64,
                counts: BTreeMap::new(),
                generator: None,
                apertures: Vec::new(),
            });
        }
    }
}

/// The holes of a Gerber file; one that does not say it is a drill file is refused where a person
/// chose it.
fn gerber_holes(
    gathered: &Gathered,
    file: &Found,
    by_hand: bool,
    warnings: &mut Vec<Warning>,
) -> Result<(Vec<Hole>, Source), Error> {
    let mut image = gathered.read_gerber(file)?;
    let function = image.function.as_deref().unwrap_or_default();
    let says_drill = ["Plated", "NonPlated"].iter().any(|start| function.starts_with(start));
    if by_hand && !says_drill && !layers::draws_holes(&file.name) && !gerber_drill::is_all_flashes(&image) {
        let what = "a Gerber file where a drill file was expected, and neither is its file function Plated or NonPlated nor does it consist of round flashes";
        return Err(Error::content(&file.shown, what, Words::of("give an Excellon drill file with {drill}")));
    }
    let (holes, warning) = gerber_drill::holes(file, &image);
    if image.features.is_empty() {
        image.warnings.retain(|warning| !warning.is(&diagnostic::NOTHING_DRAWN));
        let none = diagnostic::DRILL_WITHOUT_HOLES.warning("the drill file has no holes");
        warnings.push(none.caused_by(file.first_line()));
    }
    warnings.extend(image.warnings);
    warnings.extend(warning);
    let mut source = image.source;
    source.format = "gerber-drill".to_owned();
    source.counts.insert("holes".to_owned(), holes.iter().filter(|hole| !hole.is_slot()).count() as u64);
    source.counts.insert("slots".to_owned(), holes.iter().filter(|hole| hole.is_slot()).count() as u64);
    Ok((holes, source))
}

/// Fails for a file that draws nothing and has no end: what it had was cut off. One that was
/// written empty has its end.
fn refuse_cut_off(file: &Found, is_empty: bool, warnings: &[Warning]) -> Result<(), Error> {
    const CUT_OFF: [Diagnostic; 3] =
        [diagnostic::MISSING_END_OF_FILE, diagnostic::MISSING_END_OF_DRILL_FILE, diagnostic::TRUNCATED_FILE];
    if is_empty && warnings.iter().any(|warning| CUT_OFF.contains(warning.kind)) {
        let what = "the file draws nothing and has no end: it is truncated";
        let hint = LEAVE_ASIDE.with([&quoted(&file.name)]);
        return Err(Error::content(&file.shown, what, hint));
    }
    Ok(())
}

/// Reads a Gerber file, or says what it is instead.
fn read_gerber(gathered: &Gathered, file: &Found, wanted: &str) -> Result<Image, Error> {
    let (what, hint) = match file.kind {
        Kind::Gerber => return gathered.read_gerber(file),
        Kind::Excellon => ("an Excellon drill file", Words::of("give it with {drill}")),
        Kind::Kicad => ("a whole KiCad board", Words::of("give it alone: it has all layers")),
        Kind::Unknown => (describe(&file.bytes), Words::of("export the layer as Gerber RS-274X")),
    };
    Err(Error::content(&file.shown, format!("{what} where {wanted} (Gerber) was expected"), hint))
}

/// A copper layer that may be either side: a back that is not mirrored is a ruined board.
fn side_unknown(file: &Found) -> Error {
    let hint = Words::of("choose it: {front} {0} or {back} {0}").with([&file.shown]);
    Error::content(&file.shown, "the side of this copper layer is unknown", hint)
}

/// Why nothing could be milled, with what was found instead.
fn no_copper(gathered: &Gathered, assigned: &Assigned) -> Error {
    let aside =
        assigned.aside.iter().map(|(index, what)| format!("{} ({what})", gathered.files[*index].name));
    let others = assigned.outline.iter().map(|&i| format!("{} (outline)", gathered.files[i].name));
    let drills = assigned.drill.iter().map(|&i| format!("{} (drill)", gathered.files[i].name));
    let found: Vec<String> = aside.chain(others).chain(drills).collect();
    let what = if found.is_empty() {
        "no copper layer found: there is no Gerber file".to_owned()
    } else {
        format!("no copper layer found among {}", found.join(", "))
    };
    let hint = if gathered.folders.is_empty() {
        Words::of("choose it with {front} or {back}").into()
    } else {
        Words::of("choose it with {front} or {back}, or give the folder that holds it: {0}")
            .with([&gathered.folders.join(", ")])
    };
    Error::content(&assigned.place, what, hint)
}
