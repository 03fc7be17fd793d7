//! Files → roles: who is the front, the back, the edge; what is ambiguous is an error that says how
//! to settle it.

use std::path::{Path, PathBuf};

use super::archive::{Found, Gathered, name_of, read_file};
use super::describe::{describe, hint};
use super::error::{self, Error, find, locate};
use super::format::Kind;
use super::jobfile::Job;
use super::layers::{self, Function, Role};
use super::selection::Selection;
use super::vote::{Assigned, Vote, Witness};
use super::{contradiction, naming, settle};
use crate::board::{Side, Warning, Words};
use crate::import::diagnostic;

impl Gathered {
    /// Adds the files of `selection` that do not lie under the given paths.
    pub(super) fn add_selected(&mut self, selection: &Selection) -> Result<(), Error> {
        let single = [&selection.front, &selection.back, &selection.outline].into_iter().flatten();
        for path in single.chain(&selection.drill) {
            if self.index_of(path).is_none() {
                let shown = path.display().to_string();
                let bytes = read_file(path, &shown)?;
                self.look_beside(path, &bytes);
                let kind = Kind::of(&bytes);
                self.files.push(Found { name: name_of(path), shown, bytes, kind, named: true });
            }
        }
        Ok(())
    }

    /// The file that a person means by `path`: by path, else by name among what was gathered.
    fn index_of(&self, path: &Path) -> Option<usize> {
        let shown = path.display().to_string();
        let by_path = self.files.iter().position(|file| file.shown == shown);
        let bare = path.components().count() == 1 && !path.exists();
        by_path.or_else(|| bare.then(|| self.files.iter().position(|file| file.name == shown))?)
    }
}

/// Tells the roles of the gathered files.
pub(super) fn assign(
    gathered: &Gathered,
    paths: &[PathBuf],
    selection: &Selection,
) -> Result<Assigned, Error> {
    let place = paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", ");
    let mut assigned = Assigned { place, ..Assigned::default() };
    refuse_unknown(gathered, selection)?;
    let job = read_job(gathered, &mut assigned.warnings);
    assigned.warnings.extend(gathered.refuse_unusable(&job, selection)?);
    let mut roles = witness(gathered, &job);
    choose_by_hand(gathered, selection, &mut roles, &mut assigned);
    contradiction::refuse(gathered, &roles, selection)?;
    assigned.warnings.extend(contradiction::disputed(gathered, &roles));
    assigned.guessed = settle::groups(&mut roles);
    assigned.front = assigned.front.or(settle::only(
        &roles,
        gathered,
        Role::Copper(Side::Front),
        "front copper",
        Words::of("choose one with {front} FILE"),
        &assigned.place,
    )?);
    assigned.back = assigned.back.or(settle::only(
        &roles,
        gathered,
        Role::Copper(Side::Back),
        "back copper",
        Words::of("choose one with {back} FILE"),
        &assigned.place,
    )?);
    if assigned.outline.is_none() {
        settle::outlines(&mut roles, gathered, &mut assigned.warnings);
    }
    assigned.outline = assigned.outline.or(settle::only(
        &roles,
        gathered,
        Role::Outline,
        "outline",
        Words::of("choose one with {outline} FILE"),
        &assigned.place,
    )?);
    if selection.drill.is_empty() && !selection.no_drill {
        assigned.drill =
            roles.iter().filter(|vote| vote.role == Some(Role::Drill)).map(|vote| vote.file).collect();
    }
    take_the_only_one(&roles, gathered, &mut assigned);
    set_aside(&roles, gathered, selection, &mut assigned);
    assigned.name = naming::board_name(gathered, paths, selection, &job, &assigned);
    Ok(assigned)
}

/// A file that a person named must be something that can be read.
fn refuse_unknown(gathered: &Gathered, selection: &Selection) -> Result<(), Error> {
    let chosen = |file: &Found| {
        let single = [&selection.front, &selection.back, &selection.outline].into_iter().flatten();
        single.chain(&selection.drill).any(|path| path.display().to_string() == file.shown)
    };
    let unknown =
        gathered.files.iter().find(|file| file.named && file.kind == Kind::Unknown && !chosen(file));
    let Some(file) = unknown else { return Ok(()) };
    let what = format!("{}, neither Gerber nor Excellon", describe(&file.bytes));
    Err(Error::content(&file.shown, what, hint(&file.bytes)))
}

fn read_job(gathered: &Gathered, warnings: &mut Vec<Warning>) -> Job {
    let mut merged = Job::default();
    for (name, bytes) in &gathered.jobs {
        match Job::read(bytes) {
            Ok(job) => {
                merged.name = merged.name.or(job.name);
                merged.files.extend(job.files);
            }
            Err(error) => {
                let message =
                    format!("the job file {name} cannot be read ({error}), so names and attributes decide");
                let start = error::line(bytes, u32::try_from(error.line()).unwrap_or(u32::MAX)).start;
                let at = (start + error.column().saturating_sub(1)).min(bytes.len());
                let span = locate(name, bytes, at..at + 1);
                warnings.push(diagnostic::JOB_FILE_UNREADABLE.warning(message).caused_by(span));
            }
        }
    }
    let missing = |(file, function): &&(String, Function)| {
        !matches!(function.role, Role::Other(_)) && !gathered.files.iter().any(|found| found.name == *file)
    };
    for (file, _) in merged.files.iter().filter(missing) {
        let message = format!("the job file lists {file}, which is not among the files");
        let warning = diagnostic::JOB_FILE_INCOMPLETE.warning(message);
        let places = gathered.jobs.iter().filter_map(|(name, bytes)| {
            let at = find(bytes, file.as_bytes())?;
            Some(locate(name, bytes, at..at + file.len()))
        });
        let place = places.into_iter().next();
        warnings.push(place.map_or_else(|| warning.clone(), |place| warning.clone().caused_by(place)));
    }
    merged
}

/// What job file, function and name say of each file.
fn witness(gathered: &Gathered, job: &Job) -> Vec<Vote> {
    let (shared, has_drill) = (gathered.shared_start(), gathered.has_drill_file());
    let vote = |(index, file): (usize, &Found)| {
        let by_job = job.function_of(&file.name).map(|function| (function, Witness::Job));
        let by_function = || Some((Function::read(&layers::function_of(&file.bytes)?)?, Witness::Function));
        let by_name = || {
            let inside = || layers::role_by_name(&layers::loaded_name(&file.bytes)?, 0);
            let role = layers::role_by_name(&file.name, shared).or_else(inside)?;
            Some((Function { role, side: None }, Witness::Name))
        };
        let declared = by_job.or_else(by_function).or_else(by_name);
        let side = declared.and_then(|(function, _)| function.side);
        let is_drawing =
            |witness| witness == Witness::Name && (has_drill || !layers::draws_holes(&file.name));
        let declared = declared.map(|(Function { role, .. }, witness)| {
            (by_content(role, file.kind, is_drawing(witness)), witness)
        });
        let declared =
            declared.or_else(|| (file.kind == Kind::Excellon).then_some((Role::Drill, Witness::Name)));
        let (role, witness) = declared.map_or((None, Witness::Name), |(role, witness)| (Some(role), witness));
        Vote { file: index, role, side, witness }
    };
    gathered.files.iter().enumerate().map(vote).collect()
}

/// The role that content allows: Excellon is always a drill file, and a Gerber that only its name
/// calls a drill file is a drawing of one (`is_drawing`).
fn by_content(role: Role, kind: Kind, is_drawing: bool) -> Role {
    match (kind, role) {
        (Kind::Excellon, Role::Other(layers::PARTIAL_HOLES)) => role,
        (Kind::Excellon, _) => Role::Drill,
        (Kind::Gerber, Role::Drill) if is_drawing => Role::Other("drill drawing"),
        _ => role,
    }
}

/// What a person chose counts before all; the files chosen have no other role.
fn choose_by_hand(gathered: &Gathered, selection: &Selection, votes: &mut [Vote], assigned: &mut Assigned) {
    let mut choose = |path: &PathBuf, role: Role| {
        let index = gathered.index_of(path)?;
        assigned.warnings.extend(contradiction::chosen(&gathered.files[index], &votes[index], role));
        votes[index].role = None;
        assigned.by_hand.push(index);
        Some(index)
    };
    assigned.front = selection.front.as_ref().and_then(|path| choose(path, Role::Copper(Side::Front)));
    assigned.back = selection.back.as_ref().and_then(|path| choose(path, Role::Copper(Side::Back)));
    assigned.outline = selection.outline.as_ref().and_then(|path| choose(path, Role::Outline));
    assigned.drill = selection.drill.iter().filter_map(|path| choose(path, Role::Drill)).collect();
}

/// One Gerber file of unknown role, and no copper: it is the front.
fn take_the_only_one(votes: &[Vote], gathered: &Gathered, assigned: &mut Assigned) {
    if assigned.front.is_some() || assigned.back.is_some() {
        return;
    }
    let free = |vote: &&Vote| {
        let file = &gathered.files[vote.file];
        vote.role.is_none() && file.kind == Kind::Gerber && !assigned.by_hand.contains(&vote.file)
    };
    let mut unknown = votes.iter().filter(free);
    if let (Some(vote), None) = (unknown.next(), unknown.next()) {
        assigned.front = Some(vote.file);
        assigned.guessed = Some(vote.file);
        let file = &gathered.files[vote.file];
        let message = format!("the side of {} is unknown; it is read as front copper", file.name);
        assigned.warnings.push(diagnostic::SIDE_ASSUMED.warning(message).caused_by(file.first_line()));
    }
}

/// Lists what has no place, and says what may be missed.
fn set_aside(votes: &[Vote], gathered: &Gathered, selection: &Selection, assigned: &mut Assigned) {
    let single = [assigned.front, assigned.back, assigned.outline];
    let without_holes = assigned.drill.is_empty() && selection.drill.is_empty() && !selection.no_drill;
    for vote in votes {
        if single.contains(&Some(vote.file)) || assigned.drill.contains(&vote.file) {
            continue;
        }
        let file = &gathered.files[vote.file];
        let mut warn = |message| {
            assigned.warnings.push(diagnostic::ROLE_UNKNOWN.warning(message).caused_by(file.first_line()));
        };
        let what = match vote.role {
            Some(Role::Other(what)) => {
                // Words alone say so: an extension such as `.gd1` is that of drawings.
                if what == "drill drawing" && without_holes && layers::role_by_extension(&file.name).is_none()
                {
                    let of =
                        "is named like a drill file, but it is Gerber and taken for a picture of the holes";
                    warn(format!("{} {of}: no holes are read", file.name));
                }
                if what == layers::PARTIAL_HOLES {
                    let message = format!("{} has {what} to inner layers: they are not drilled", file.name);
                    let warning = diagnostic::PARTIAL_HOLES.warning(message);
                    assigned.warnings.push(warning.caused_by(file.first_line()));
                }
                what
            }
            None => {
                if !assigned.by_hand.contains(&vote.file) {
                    warn(format!("the layer of {} is unknown; the file is ignored", file.name));
                }
                "unknown role"
            }
            Some(Role::Drill) => "drill file not chosen",
            Some(Role::Copper(_) | Role::Outline | Role::Group(_)) => "not chosen",
        };
        assigned.aside.push((vote.file, what.to_owned()));
    }
}
