//! What tells the outputs of one job from those of another before they are made.

use std::fmt::Write as _;

use crate::import::{Loaded, sha256};

use super::Settings;
use super::pipeline::GENERATOR;

/// A name for what a job makes, SHA-256 in hexadecimal: the same wherever the version of the
/// program, the files and the settings are the same.
///
/// The outputs then are the same bytes on every machine, so whoever keeps them by this name (a
/// farm, a build) need not run the job again. `choices` are further settings, of what is written
/// for instance. Folders do not count, names of files do: programs say which files they were made
/// from.
#[must_use]
pub fn cache_key(loaded: &Loaded, settings: &Settings, choices: &[(&str, String)]) -> String {
    let mut text = format!("{GENERATOR}\nboard {}\n", loaded.board.name);
    for source in &loaded.sources {
        let _ = writeln!(text, "file {} {} {}", source.role, source.file, source.sha256);
    }
    for (name, value) in settings.options().listed() {
        let _ = writeln!(text, "{name} {value}");
    }
    for (name, value) in choices {
        let _ = writeln!(text, "{name} {value}");
    }
    // One's own tools are tables, which no option lists.
    let _ = writeln!(text, "{:?} {:?} {:?}", settings.isolation, settings.drills, settings.cutout_tool);
    let _ = writeln!(text, "{:?}", settings.drill_bore_tool);
    let _ = writeln!(text, "{:?} {:?}", settings.dialect, settings.machine);
    sha256(text.as_bytes())
}
