//! Witnesses that disagree: a file whose name says one thing and whose content or attribute
//! another.
//!
//! Where a wrong guess would cut the wrong side or the wrong thing, that is an error; where the
//! attribute is believed before the name, it is said.

use super::advice::quoted;
use super::archive::{Found, Gathered};
use super::error::{Error, find, locate};
use super::format::Kind;
use super::layers::{self, Role};
use super::selection::Selection;
use super::vote::{Vote, Witness};
use crate::board::{Side, SourceSpan, Warning, Words};
use crate::import::diagnostic;

/// What a name says: what kind of layer it is, and on which side.
fn named(file: &Found, shared: usize) -> Option<(Option<Role>, Option<Side>)> {
    let role = layers::role_by_name(&file.name, shared);
    let side = match role {
        Some(Role::Copper(side)) => Some(side),
        _ => layers::side_by_name(&file.name, shared),
    };
    (role.is_some() || side.is_some()).then_some((role, side))
}

const fn is_sided(role: Role) -> bool {
    matches!(role, Role::Copper(_))
}

/// A role in words.
const fn what(role: Role) -> &'static str {
    match role {
        Role::Copper(Side::Front) => "the front copper",
        Role::Copper(Side::Back) => "the back copper",
        Role::Group(_) => "a copper layer",
        Role::Outline => "the outline",
        Role::Drill => "a drill file",
        Role::Other(what) => what,
    }
}

fn on_side(what: &str, side: Option<Side>) -> String {
    side.map_or_else(|| what.to_owned(), |side| format!("{what} of the {side}"))
}

const fn who(witness: Witness) -> &'static str {
    match witness {
        Witness::Job => "the job file",
        Witness::Function | Witness::Name => "its .FileFunction",
    }
}

const LEAVE_DRILL: Words = Words::of("export the drill file again as Excellon, or ignore it: {skip} {0}");
const LEAVE_LAYER: Words =
    Words::of("export the layer again, read it as a drill file: {drill} {0}, or ignore it: {skip} {0}");

/// A file whose name says drill and whose content says layer, or the other way round, or one named
/// for one side that calls itself the other: one of the two is wrong, and guessing cuts the wrong
/// thing.
pub(super) fn refuse(gathered: &Gathered, votes: &[Vote], selection: &Selection) -> Result<(), Error> {
    refuse_other_side(gathered, votes)?;
    let shared = gathered.shared_start();
    let has_drill = gathered.has_drill_file();
    for vote in votes {
        let file = &gathered.files[vote.file];
        let by_words = || layers::role_by_name(&file.name, shared);
        // Words count where the extension says layer and the content does not.
        let is_odd = file.kind == Kind::Excellon && layers::is_gerber_by_extension(&file.name);
        let named = layers::role_by_sure_name(&file.name).or_else(|| by_words().filter(|_| is_odd));
        let name = quoted(&file.name);
        let (what, hint) = match (named, file.kind, vote.role) {
            (Some(Role::Drill), Kind::Gerber, Some(Role::Copper(_))) if vote.witness == Witness::Function => {
                (
                    "named like a drill file, but it is a Gerber file that declares itself copper (.FileFunction)",
                    Words::of(
                        "export the drill file again, or choose this file as copper with {front} or {back}",
                    )
                    .into(),
                )
            }
            (Some(Role::Drill), Kind::Gerber, Some(Role::Other("drill drawing")))
                if selection.drill.is_empty() && !(has_drill && is_orcad_drawing(&file.name)) =>
            {
                let what = "named like a drill file, but it is a Gerber file without a file function";
                (what, LEAVE_DRILL.with([&name]))
            }
            (Some(Role::Copper(_) | Role::Outline | Role::Group(_)), Kind::Excellon, Some(Role::Drill))
                if selection.drill.is_empty() =>
            {
                let what = "named like a layer, but it is an Excellon drill file";
                (what, LEAVE_LAYER.with([&name]))
            }
            _ => continue,
        };
        return Err(Error::content(&file.shown, what, hint));
    }
    Ok(())
}

/// Whether a name ends as OrCAD's drill drawings do; EAGLE ends its drill files so.
fn is_orcad_drawing(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("drd"))
}

/// A file named for one side that calls itself the other, where either says that it is copper.
fn refuse_other_side(gathered: &Gathered, votes: &[Vote]) -> Result<(), Error> {
    let shared = gathered.shared_start();
    for vote in votes.iter().filter(|vote| vote.witness > Witness::Name) {
        let file = &gathered.files[vote.file];
        let (Some(declared), Some(side)) = (vote.role, vote.side) else { continue };
        let Some((named, named_side)) = named(file, shared) else { continue };
        let is_copper = matches!(declared, Role::Copper(_)) || matches!(named, Some(Role::Copper(_)));
        if named_side.is_some_and(|named| named != side) && is_copper {
            let like = named.map_or("a layer", what);
            let like = if named.is_some_and(is_sided) { like.to_owned() } else { on_side(like, named_side) };
            let calls = if is_sided(declared) {
                what(declared).to_owned()
            } else {
                on_side(what(declared), Some(side))
            };
            let message = format!("named like {like}, but {} declares {calls}", who(vote.witness));
            let hint = Words::of("choose its side: {front} {0} or {back} {0}, or ignore it: {skip} {0}");
            return Err(Error::content(&file.shown, message, hint.with([&quoted(&file.name)])));
        }
    }
    Ok(())
}

/// A file that a person chose as one thing, and that is another by all that is known of it: the
/// person is believed, and it is said what comes of it.
pub(super) fn chosen(file: &Found, vote: &Vote, as_what: Role) -> Option<Warning> {
    let role = vote.role.filter(|role| *role != as_what)?;
    let (called, comes_of_it) = match (as_what, role) {
        (Role::Copper(_), Role::Copper(_)) => {
            (what(role).to_owned(), "unless it was drawn mirrored, its mirror image is milled")
        }
        // Whoever mills an inner layer has to choose it.
        (Role::Copper(_), Role::Other("inner copper")) => return None,
        (Role::Copper(_), Role::Other(other)) => {
            (format!("the {other}"), "what it draws is taken for copper")
        }
        (Role::Copper(_), Role::Outline) => (what(role).to_owned(), "what it draws is taken for copper"),
        (Role::Outline, Role::Copper(_)) => (what(role).to_owned(), "the board is cut out along its copper"),
        _ => return None,
    };
    let says = match vote.witness {
        Witness::Name => format!("it is named like {called}"),
        Witness::Function | Witness::Job => format!("{} declares {called}", who(vote.witness)),
    };
    let message = format!("{} is chosen as {}, but {says}: {comes_of_it}", file.name, what(as_what));
    Some(diagnostic::OTHER_LAYER_CHOSEN.warning(message).caused_by(says_so(file, vote.witness)))
}

/// Where a file says what it is.
fn says_so(file: &Found, witness: Witness) -> SourceSpan {
    let place = find(&file.bytes, b"FileFunction,").filter(|_| witness == Witness::Function);
    place.map_or_else(|| file.first_line(), |at| locate(&file.name, &file.bytes, at..at + 12))
}

/// Layers of which the name says one thing and the file or the job file another, and either is
/// milled: the name is not believed, and that is said.
pub(super) fn disputed(gathered: &Gathered, votes: &[Vote]) -> Vec<Warning> {
    let shared = gathered.shared_start();
    let mut warnings = Vec::new();
    for vote in votes.iter().filter(|vote| vote.witness > Witness::Name) {
        let file = &gathered.files[vote.file];
        let Some(declared) = vote.role else { continue };
        let kind = layers::kind_by_name(&file.name, shared).filter(|named| !agree(*named, declared));
        let other_side = || {
            layers::side_by_name(&file.name, shared)
                .filter(|side| vote.side.is_some_and(|declared| declared != *side))
        };
        let like = match (kind, other_side()) {
            (Some(named), _) => what(named).to_owned(),
            (None, side @ Some(_)) => on_side("a layer", side),
            (None, None) => continue,
        };
        let calls =
            if kind.is_some() { what(declared).to_owned() } else { on_side(what(declared), vote.side) };
        let so =
            if matches!(declared, Role::Other(_)) { "so it is not milled" } else { "so it is read as that" };
        let message =
            format!("{} is named like {like}, but {} declares {calls}, {so}", file.name, who(vote.witness));
        warnings.push(diagnostic::LAYER_DISPUTED.warning(message).caused_by(says_so(file, vote.witness)));
    }
    warnings
}

/// Whether what a name says and what a file says of itself can both be true, or neither is milled.
const fn agree(named: Role, declared: Role) -> bool {
    match (named, declared) {
        (Role::Copper(_), Role::Copper(_))
        | (Role::Outline, Role::Outline)
        | (Role::Drill, Role::Drill | Role::Other(_))
        | (Role::Other(_), Role::Other(_)) => true,
        (Role::Copper(_) | Role::Group(_) | Role::Outline | Role::Drill | Role::Other(_), _) => false,
    }
}
