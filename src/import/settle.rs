//! Several files for one role: settled where the files themselves tell, left to a person where they
//! do not.

use super::archive::{Found, Gathered};
use super::error::Error;
use super::layers::Role;
use super::outline;
use super::vote::{Vote, Witness};
use crate::board::{Side, Warning, Words};
use crate::geometry::{Nm, Point, Rect};
use crate::import::diagnostic;

/// gEDA's numbered groups: the first is the component side, the last the solder side, where nothing
/// better tells. The file whose side that is a guess of: of one layer alone that is not the first.
pub(super) fn groups(votes: &mut [Vote]) -> Option<usize> {
    let numbers: Vec<u32> = votes.iter().filter_map(|vote| group(vote.role)).collect();
    let sided = votes.iter().any(|vote| matches!(vote.role, Some(Role::Copper(_))));
    let (&first, &last) = numbers.iter().min().zip(numbers.iter().max())?;
    let of_the_first = votes.iter().find(|vote| group(vote.role) == Some(first)).map(|vote| vote.file);
    let guessed = of_the_first.filter(|_| !sided && first == last && first > 1);
    for vote in votes {
        let Some(number) = group(vote.role) else { continue };
        vote.role = Some(match number {
            _ if sided => Role::Other("inner copper"),
            n if n == first => Role::Copper(Side::Front),
            n if n == last => Role::Copper(Side::Back),
            _ => Role::Other("inner copper"),
        });
    }
    guessed
}

const fn group(role: Option<Role>) -> Option<u32> {
    match role {
        Some(Role::Group(number)) => Some(number),
        _ => None,
    }
}

/// The one file of a role, by the best witness; two of them are an error that says how to settle
/// it.
pub(super) fn only(
    votes: &[Vote],
    gathered: &Gathered,
    role: Role,
    what: &str,
    option: Words,
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
            Err(Error::content(place, what, option))
        }
    }
}

/// Of several outline layers told by name alone (`.GKO` and `.GM1`), keeps those that draw an edge;
/// of edges that lie in the same place, the first. What is left may still be a choice for a person.
pub(super) fn outlines(votes: &mut [Vote], gathered: &Gathered, warnings: &mut Vec<Warning>) {
    let all = || votes.iter().filter(|vote| vote.role == Some(Role::Outline));
    if all().count() < 2 || all().any(|vote| vote.witness > Witness::Name) {
        return;
    }
    let candidates: Vec<usize> = all().map(|vote| vote.file).collect();
    let edges: Vec<Option<Rect>> =
        candidates.iter().map(|&index| edge_of(gathered, &gathered.files[index])).collect();
    let Some(first) = edges.iter().flatten().next().copied() else { return };
    let mut taken = false;
    for (index, edge) in candidates.into_iter().zip(edges) {
        let reason = match edge {
            None => "encloses nothing",
            Some(edge) if taken && alike(edge, first) => "encloses the same as another",
            Some(_) => {
                taken = true;
                continue;
            }
        };
        votes
            .iter_mut()
            .filter(|vote| vote.file == index)
            .for_each(|vote| vote.role = Some(Role::Other("outline")));
        let message = format!("{} is not used as the outline: it {reason}", gathered.files[index].name);
        warnings
            .push(diagnostic::OUTLINE_TWICE.warning(message).caused_by(gathered.files[index].first_line()));
    }
}

/// The rectangle around the edge that a file draws, if it closes.
fn edge_of(gathered: &Gathered, file: &Found) -> Option<Rect> {
    let image = gathered.read_gerber(file).ok()?;
    let joined = outline::join(&file.name, &file.bytes, &image.features, outline::GAP);
    joined.outline.map(|edge| edge.bounds())
}

/// Whether two edges lie within half a millimetre of each other, as their corners have it.
fn alike(a: Rect, b: Rect) -> bool {
    /// Chosen.
    const NEAR: Nm = Nm::from_um(500);
    let near = |p: Point, q: Point| (p.x - q.x).abs() <= NEAR && (p.y - q.y).abs() <= NEAR;
    near(a.min(), b.min()) && near(a.max(), b.max())
}
