//! Files → roles: who is the front, the back, the edge; what is ambiguous is an error that says how to settle it.

use std::path::{Path, PathBuf};

use super::archive::{Found, Gathered, name_of, read_file};
use super::error::Error;
use super::jobfile::Job;
use super::layers::{self, Kind, Role};
use super::load::{Selection, describe};
use crate::board::{Side, Warning};

/// Which of the gathered files is what, as indices.
#[derive(Debug, Default)]
pub(super) struct Assigned {
    pub(super) front: Option<usize>,
    pub(super) back: Option<usize>,
    pub(super) outline: Option<usize>,
    pub(super) drill: Vec<usize>,
    /// Layers that are not milled, with what they are.
    pub(super) aside: Vec<(usize, String)>,
    /// Files whose role a person chose.
    pub(super) by_hand: Vec<usize>,
    /// What the board is called.
    pub(super) name: String,
    /// Where it was looked for, for messages.
    pub(super) place: String,
    pub(super) warnings: Vec<Warning>,
}

impl Gathered {
    /// Adds the files of `selection` that do not lie under the given paths.
    pub(super) fn add_selected(&mut self, selection: &Selection) -> Result<(), Error> {
        let single = [&selection.front, &selection.back, &selection.outline].into_iter().flatten();
        for path in single.chain(&selection.drill) {
            if self.index_of(path).is_none() {
                let shown = path.display().to_string();
                let bytes = read_file(path, &shown)?;
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
    let mut roles = witness(gathered, &job);
    choose_by_hand(gathered, selection, &mut roles, &mut assigned);
    settle_groups(&mut roles);
    assigned.front = assigned.front.or(only(
        &roles,
        gathered,
        Role::Copper(Side::Front),
        "front copper",
        "--front",
        &assigned.place,
    )?);
    assigned.back = assigned.back.or(only(
        &roles,
        gathered,
        Role::Copper(Side::Back),
        "back copper",
        "--back",
        &assigned.place,
    )?);
    assigned.outline =
        assigned.outline.or(only(&roles, gathered, Role::Outline, "outline", "--outline", &assigned.place)?);
    if selection.drill.is_empty() {
        assigned.drill =
            roles.iter().filter(|vote| vote.role == Some(Role::Drill)).map(|vote| vote.file).collect();
    }
    take_the_only_one(&roles, gathered, &mut assigned);
    set_aside(&roles, gathered, &mut assigned);
    assigned.name = board_name(gathered, paths, selection, &job, &assigned);
    Ok(assigned)
}

/// What is known of one file's role, and how well.
struct Vote {
    file: usize,
    role: Option<Role>,
    witness: Witness,
}

/// Who says so; a later one is believed before an earlier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Witness {
    Name,
    Function,
    Job,
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
    Err(Error::content(
        &file.shown,
        what,
        "give Gerber layers and Excellon drill files, their folder or a zip of them",
    ))
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
                warnings.push(Warning::new("job-file-unreadable", message));
            }
        }
    }
    let missing = |(file, role): &&(String, Role)| {
        !matches!(role, Role::Other(_)) && !gathered.files.iter().any(|found| found.name == *file)
    };
    for (file, _) in merged.files.iter().filter(missing) {
        let message = format!("the job file lists {file}, which is not among the files");
        warnings.push(Warning::new("job-file-incomplete", message));
    }
    merged
}

/// What job file, function and name say of each file.
fn witness(gathered: &Gathered, job: &Job) -> Vec<Vote> {
    let names: Vec<&str> = gathered.files.iter().map(|file| stem(&file.name)).collect();
    let shared = layers::shared_start(&names);
    let vote = |(index, file): (usize, &Found)| {
        let by_job = job.role_of(&file.name).map(|role| (role, Witness::Job));
        let by_function = || {
            let role = layers::role_by_function(&layers::function_of(&file.bytes)?)?;
            Some((role, Witness::Function))
        };
        let by_name = || layers::role_by_name(&file.name, shared).map(|role| (role, Witness::Name));
        let told = by_job.or_else(by_function).or_else(by_name);
        let told = told.map(|(role, witness)| (by_content(role, witness, file.kind), witness));
        let told = told.or_else(|| (file.kind == Kind::Excellon).then_some((Role::Drill, Witness::Name)));
        let (role, witness) = told.map_or((None, Witness::Name), |(role, witness)| (Some(role), witness));
        Vote { file: index, role, witness }
    };
    gathered.files.iter().enumerate().map(vote).collect()
}

/// The role that content allows: Excellon is always a drill file, and a Gerber that only its name calls a drill file
/// is a drawing of one.
fn by_content(role: Role, witness: Witness, kind: Kind) -> Role {
    match (kind, role) {
        (Kind::Excellon, _) => Role::Drill,
        (Kind::Gerber, Role::Drill) if witness == Witness::Name => Role::Other("drill drawing"),
        _ => role,
    }
}

/// What a person chose counts before all; the files chosen have no other role.
fn choose_by_hand(gathered: &Gathered, selection: &Selection, votes: &mut [Vote], assigned: &mut Assigned) {
    let mut choose = |path: &PathBuf| {
        let index = gathered.index_of(path)?;
        votes[index].role = None;
        assigned.by_hand.push(index);
        Some(index)
    };
    assigned.front = selection.front.as_ref().and_then(&mut choose);
    assigned.back = selection.back.as_ref().and_then(&mut choose);
    assigned.outline = selection.outline.as_ref().and_then(&mut choose);
    assigned.drill = selection.drill.iter().filter_map(&mut choose).collect();
}

/// gEDA's numbered groups: the first is the component side, the last the solder side, where nothing better tells.
fn settle_groups(votes: &mut [Vote]) {
    let numbers: Vec<u32> = votes.iter().filter_map(|vote| group(vote.role)).collect();
    let sided = votes.iter().any(|vote| matches!(vote.role, Some(Role::Copper(_))));
    let (Some(&first), Some(&last)) = (numbers.iter().min(), numbers.iter().max()) else { return };
    for vote in votes {
        let Some(number) = group(vote.role) else { continue };
        vote.role = Some(match number {
            _ if sided => Role::Other("inner copper"),
            n if n == first => Role::Copper(Side::Front),
            n if n == last => Role::Copper(Side::Back),
            _ => Role::Other("inner copper"),
        });
    }
}

const fn group(role: Option<Role>) -> Option<u32> {
    match role {
        Some(Role::Group(number)) => Some(number),
        _ => None,
    }
}

/// The one file of a role, by the best witness; two of them are an error that says how to settle it.
fn only(
    votes: &[Vote],
    gathered: &Gathered,
    role: Role,
    what: &str,
    option: &str,
    place: &str,
) -> Result<Option<usize>, Error> {
    let all = || votes.iter().filter(|vote| vote.role == Some(role));
    let best = all().map(|vote| vote.witness).max();
    let mut files: Vec<usize> =
        all().filter(|vote| Some(vote.witness) == best).map(|vote| vote.file).collect();
    // The same file twice, as in a folder and in the zip beside it, is no choice.
    let bytes = |index: &usize| &gathered.files[*index].bytes;
    files.dedup_by(|a, b| bytes(a) == bytes(b));
    match files.as_slice() {
        [] => Ok(None),
        [file] => Ok(Some(*file)),
        _ => {
            let names: Vec<&str> = files.iter().map(|&i| gathered.files[i].name.as_str()).collect();
            let what = format!("{} files could be the {what}: {}", names.len(), names.join(", "));
            Err(Error::content(place, what, format!("choose one with {option} FILE")))
        }
    }
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
        let message = format!(
            "nothing tells the side of {}, so it is taken for the front",
            gathered.files[vote.file].name
        );
        assigned.warnings.push(Warning::new("side-assumed", message));
    }
}

fn set_aside(votes: &[Vote], gathered: &Gathered, assigned: &mut Assigned) {
    let single = [assigned.front, assigned.back, assigned.outline];
    for vote in votes {
        if single.contains(&Some(vote.file)) || assigned.drill.contains(&vote.file) {
            continue;
        }
        let what = match vote.role {
            Some(Role::Other(what)) => what,
            None => {
                let file = &gathered.files[vote.file].name;
                if !assigned.by_hand.contains(&vote.file) {
                    let message = format!("nothing tells what layer {file} is, so it is left aside");
                    assigned.warnings.push(Warning::new("role-unknown", message));
                }
                "unknown role"
            }
            Some(Role::Drill) => "drill file not chosen",
            Some(Role::Copper(_) | Role::Outline | Role::Group(_)) => "not chosen",
        };
        assigned.aside.push((vote.file, what.to_owned()));
    }
}

/// The name without its extension.
pub(super) fn stem(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// What the board is called: as told, as the job file has it, as all layers begin, or as their folder is named.
fn board_name(
    gathered: &Gathered,
    paths: &[PathBuf],
    selection: &Selection,
    job: &Job,
    assigned: &Assigned,
) -> String {
    /// Words that programs put before every layer.
    const NO_NAMES: [&str; 8] = ["gerber", "copper", "drill", "pcb", "board", "layer", "output", "gerbers"];
    let single = [assigned.front, assigned.back, assigned.outline];
    let used: Vec<&str> = single
        .into_iter()
        .flatten()
        .chain(assigned.drill.iter().copied())
        .map(|i| gathered.files[i].name.as_str())
        .collect();
    let fits = |name: &str| {
        let plain = name.to_ascii_lowercase();
        (plain.len() > 1 && !NO_NAMES.contains(&plain.as_str())).then(|| name.to_owned())
    };
    let shared = || {
        let name = match used.as_slice() {
            [one] => without_role(stem(one)),
            _ => used.iter().map(|name| stem(name)).reduce(shared_head)?,
        };
        fits(name.trim_end_matches(|c: char| !c.is_alphanumeric()))
    };
    let folder = || paths.first().and_then(|path| fits(archive_stem(&name_of(path))));
    let name = selection.name.clone().or_else(|| job.name.clone().filter(|name| !name.is_empty()));
    safe(&name.or_else(shared).or_else(folder).unwrap_or_else(|| "board".to_owned()))
}

/// The start that two stems share, up to a mark that parts words; the whole of one that the other begins with.
fn shared_head<'a>(a: &'a str, b: &str) -> &'a str {
    let shared = a.bytes().zip(b.bytes()).take_while(|(x, y)| x == y).count();
    let ends = |text: &str| text.len() == shared || !text.as_bytes()[shared].is_ascii_alphanumeric();
    if ends(a) && ends(b) {
        return a.get(..shared).unwrap_or_default();
    }
    let mark = a.as_bytes()[..shared].iter().rposition(|b| !b.is_ascii_alphanumeric()).unwrap_or(0);
    a.get(..mark).unwrap_or_default()
}

/// A layer's stem without the part that tells its role: `amp-F_Cu` is the board `amp`.
fn without_role(stem: &str) -> &str {
    let mut marks = stem.char_indices().filter(|(_, c)| !c.is_ascii_alphanumeric()).map(|(i, _)| i);
    let told = marks.find(|&i| layers::role_by_name(&stem[i..], 0).is_some());
    told.map_or(stem, |i| &stem[..i])
}

fn archive_stem(name: &str) -> &str {
    if name.to_ascii_lowercase().ends_with(".zip") { stem(name) } else { name }
}

/// A name that every file system takes.
fn safe(name: &str) -> String {
    let kept: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' }).collect();
    let kept = kept.trim_matches('.').to_owned();
    if kept.is_empty() { "board".to_owned() } else { kept.chars().take(100).collect() }
}
