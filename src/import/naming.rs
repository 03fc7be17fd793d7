//! What a board is called.

use std::path::{Path, PathBuf};

use super::archive::{Gathered, name_of};
use super::jobfile::Job;
use super::layers;
use super::selection::Selection;
use super::vote::Assigned;

/// The name without its extension.
pub(super) fn stem(name: &str) -> &str {
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// What the board is called: as told, as the job file has it, as all layers begin, or as their
/// folder is named.
pub(super) fn board_name(
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
    let folder = || paths.first().and_then(|path| fits(&folder_name(path)));
    let name = selection.name.clone().or_else(|| job.name.clone().filter(|name| !name.is_empty()));
    safe(&name.or_else(shared).or_else(folder).unwrap_or_else(|| "board".to_owned()))
}

/// What a KiCad board is called: as told, or as its file is.
pub(super) fn whole_board_name(file: &str, selection: &Selection) -> String {
    safe(selection.name.as_deref().unwrap_or_else(|| stem(file)))
}

/// The start that two stems share, up to a mark that parts words; the whole of one that the other
/// begins with.
fn shared_head<'a>(a: &'a str, b: &str) -> &'a str {
    let shared = a.bytes().zip(b.bytes()).take_while(|(x, y)| x == y).count();
    let ends = |text: &str| text.len() == shared || !text.as_bytes()[shared].is_ascii_alphanumeric();
    if ends(a) && ends(b) {
        return a.get(..shared).unwrap_or_default();
    }
    let common = &a[..a.floor_char_boundary(shared)];
    &common[..common.rfind(|c: char| !c.is_alphanumeric()).unwrap_or(0)]
}

/// A layer's stem without the part that tells its role: `amp-F_Cu` is the board `amp`.
fn without_role(stem: &str) -> &str {
    let mut marks = stem.char_indices().filter(|(_, c)| !c.is_alphanumeric()).map(|(i, _)| i);
    let mark = marks.find(|&i| layers::role_by_name(&stem[i..], 0).is_some());
    mark.map_or(stem, |i| &stem[..i])
}

/// What a folder or an archive is called, or the folder that a file lies in.
fn folder_name(path: &Path) -> String {
    let name = name_of(path);
    if name.to_ascii_lowercase().ends_with(".zip") {
        return stem(&name).to_owned();
    }
    let whole = std::path::absolute(path).ok().filter(|_| !path.is_dir());
    whole.as_deref().and_then(Path::parent).map_or(name, name_of)
}

/// A name that every file system takes, in any script.
fn safe(name: &str) -> String {
    /// Bytes that leave room for what programs add. Chosen: file systems take 255.
    const LONGEST: usize = 100;
    let fitting = |c: char| if c.is_alphanumeric() || "._-".contains(c) { c } else { '_' };
    let kept: String = name.chars().map(fitting).collect();
    let kept = kept.trim_matches('.');
    let kept = &kept[..kept.floor_char_boundary(LONGEST)];
    if kept.is_empty() { "board".to_owned() } else { kept.to_owned() }
}
