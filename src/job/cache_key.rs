//! What tells the outputs of one job from those of another before they are made.

use std::fmt::{self, Write};

use crate::import::{Loaded, sha256_of};

use super::Settings;
use super::pipeline::GENERATOR;

/// A name for what a job makes, SHA-256 in hexadecimal: the same wherever the version of the
/// program, what was read and the settings are the same.
///
/// The outputs then are the same bytes on every machine, so whoever keeps them by this name (a
/// farm, a build) need not run the job again. `choices` are further settings, of what is written
/// for instance. Folders do not count, names of files do: programs say which files they were made
/// from. What counts of the settings is what they come to: the files that they name (areas,
/// dialects, one's own G-code) with what is in them.
#[must_use]
pub fn cache_key(loaded: &Loaded, settings: &Settings, choices: &[(&str, String)]) -> String {
    sha256_of(|text| write(text, loaded, settings, choices)).expect("a hash takes any text")
}

fn write(
    text: &mut dyn Write,
    loaded: &Loaded,
    settings: &Settings,
    choices: &[(&str, String)],
) -> fmt::Result {
    let Loaded { board, sources, warnings, ignored } = loaded;
    writeln!(text, "{GENERATOR}")?;
    for source in sources {
        writeln!(text, "file {} {} {}", source.role, source.file, source.sha256)?;
    }
    // As it was read, which options for files have a say in: the resolution of a picture.
    writeln!(text, "{board:?}")?;
    for warning in warnings {
        writeln!(text, "{}", warning.text())?;
    }
    writeln!(text, "{ignored:?}")?;
    for (name, value) in settings.options().listed() {
        writeln!(text, "{name} {value}")?;
    }
    for (name, value) in choices {
        writeln!(text, "{name} {value}")?;
    }
    // Which options were given is told by those listed; the rest is what they come to.
    writeln!(text, "{:?}", settings.without_options())
}
