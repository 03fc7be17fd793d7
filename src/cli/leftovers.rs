//! What earlier runs left in the folder that is written to: an old program beside new ones is
//! milled by mistake.
//!
//! `NAME.json` lists the files that a run wrote, with their hashes. What the next run of the same
//! board does not write again goes, unless somebody has changed it since. All other programs in the
//! folder are named: nobody knows of which board, or of which revision of it, they are.

use std::fs;
use std::path::{Path, PathBuf};

use voromill::board::Source;
use voromill::board::diagnostic::planning;
use voromill::import::sha256;
use voromill::report::document::{OutputEntry, WarningEntry};

use super::program_files::ENDINGS;

/// How many names are shown of many. Chosen: fits a line.
const SHOWN: usize = 5;

/// Files of earlier runs.
#[derive(Debug, Default)]
pub(super) struct Leftovers {
    /// Written by the run before and unchanged since.
    pub(super) obsolete: Vec<PathBuf>,
    /// Written by the run before and changed since, by name.
    changed: Vec<String>,
    /// Programs that no run of this board lists, by name.
    others: Vec<String>,
}

/// The part of `NAME.json` that lists the outputs.
#[derive(serde::Deserialize)]
struct Manifest {
    #[serde(default)]
    outputs: Vec<OutputEntry>,
}

impl Leftovers {
    /// What lies in `folder` where a run writes `written`, the last of them its manifest, from
    /// `sources`; programs end in `own`, too.
    pub(super) fn find(folder: &Path, written: &[(String, Vec<u8>)], sources: &[Source], own: &str) -> Self {
        // A file system may hold names of capitals and small letters for the same.
        let is_written = |name: &str| written.iter().any(|(other, _)| other.eq_ignore_ascii_case(name));
        let is_read = |name: &str| sources.iter().any(|source| source.file.eq_ignore_ascii_case(name));
        let mut found = Self::default();
        let mut listed = Vec::new();
        for OutputEntry { file, sha256: recorded } in
            written.last().map_or_else(Vec::new, |(name, _)| outputs(&folder.join(name)))
        {
            let path = folder.join(&file);
            if !is_name(&file) || is_written(&file) || is_read(&file) || !is_plain_file(&path) {
                continue;
            }
            let same = fs::read(&path).is_ok_and(|bytes| sha256(&bytes) == recorded);
            if same {
                found.obsolete.push(path)
            } else {
                found.changed.push(file.clone())
            }
            listed.push(file);
        }
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
        let ending = |name: &str| name.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
        let is_program =
            |name: &String| ending(name).is_some_and(|ending| ending == own || ENDINGS.contains(&&*ending));
        found.others = names
            .filter(is_program)
            .filter(|name| !is_written(name) && !is_read(name) && !listed.contains(name))
            .collect();
        found.others.sort();
        found
    }

    /// What a person must know of what stays.
    pub(super) fn warnings(&self, folder: &Path) -> Vec<WarningEntry> {
        let folder = folder.display();
        let mut warnings = Vec::new();
        if !self.changed.is_empty() {
            let names = named(&self.changed);
            let message =
                format!("{folder} keeps what an earlier run wrote and somebody changed since: {names}");
            warnings.push(planning::STALE_OUTPUT.warning(message));
        }
        if !self.others.is_empty() {
            let message = format!(
                "{folder} holds programs that this run did not write: {}; do not mill them together",
                named(&self.others)
            );
            warnings.push(planning::STALE_OUTPUT.warning(message));
        }
        warnings.iter().map(WarningEntry::from).collect()
    }

    /// What is said of it: what goes, and the warnings.
    pub(super) fn to_text(&self, folder: &Path) -> String {
        let names: Vec<String> = self
            .obsolete
            .iter()
            .filter_map(|path| path.file_name())
            .map(|name| name.to_string_lossy().into_owned())
            .collect();
        let removed = if names.is_empty() {
            String::new()
        } else {
            format!("  removed from {}, written by an earlier run: {}\n", folder.display(), named(&names))
        };
        self.warnings(folder).iter().map(WarningEntry::to_text).fold(removed, |text, warning| text + &warning)
    }
}

/// What the manifest at `path` lists; nothing where there is none.
fn outputs(path: &Path) -> Vec<OutputEntry> {
    let read = fs::read(path).ok().filter(|_| is_plain_file(path));
    let manifest = read.and_then(|bytes| serde_json::from_slice::<Manifest>(&bytes).ok());
    manifest.map_or_else(Vec::new, |manifest| manifest.outputs)
}

/// Whether it is a name alone: a manifest that somebody wrote leads nowhere else.
fn is_name(file: &str) -> bool {
    !file.is_empty() && !file.starts_with('.') && !file.contains(['/', '\\', ':'])
}

/// Whether it is a file itself, and no link to one.
fn is_plain_file(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|meta| meta.is_file())
}

/// The first names, and how many more there are.
fn named(names: &[String]) -> String {
    let shown = names[..names.len().min(SHOWN)].join(", ");
    match names.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}
