//! What lies among the files of a board, is meant as a layer or a drill file, and cannot be read as
//! one.
//!
//! A board whose back was left out because its file is empty is a wrong board that nobody notices.
//! So whatever says that it is copper, an outline or a drill file, by any of its marks, must be
//! read or be left aside by a person (`--skip`). The marks, the surest first:
//!
//! 1. the job file lists it;
//! 2. it has an X2 file function;
//! 3. its lines are those of a drill file, though its beginning is not;
//! 4. its name: an extension that only layers have, KiCad's endings, or, for texts, words such as
//!    `top` and `drill`.
//!
//! What says nothing of the kind (a README, a list of parts, G-code) is listed as no layer. In
//! between are texts that are no prose, and folders named like a layer: they are warned of.

use super::describe::{HEAD, describe, is_program, is_project};
use super::jobfile::Job;
use super::layers::{self, Role, function_of, role_by_function};
use crate::board::{Side, Warning, Words};
use crate::import::diagnostic;

/// Something among the files of a board that is no layer by its content.
#[derive(Clone, Debug)]
pub(super) struct Unusable {
    pub(super) name: String,
    pub(super) shown: String,
    pub(super) form: Form,
}

/// What it is.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// A file, with its first [`HEAD`] bytes.
    File(Vec<u8>),
    /// A folder.
    Folder,
    /// What is neither, in words.
    Special(&'static str),
}

impl Unusable {
    pub(super) fn file(name: String, shown: String, bytes: &[u8]) -> Self {
        Self { name, shown, form: Form::File(bytes[..bytes.len().min(HEAD)].to_vec()) }
    }

    pub(super) fn folder(name: String, shown: String) -> Self {
        Self { name, shown, form: Form::Folder }
    }

    /// A dangling link, a pipe, a device: `what` says which.
    pub(super) fn special(name: String, shown: String, what: &'static str) -> Self {
        Self { name, shown, form: Form::Special(what) }
    }

    /// What it is, in a few words.
    pub(super) fn what(&self) -> &'static str {
        match &self.form {
            Form::File(head) => describe(head),
            Form::Folder => "a folder",
            Form::Special(what) => what,
        }
    }

    /// What it is meant for, and which mark says so; none where nothing does.
    pub(super) fn claim(&self, shared: usize, job: &Job) -> Option<(Meant, &'static str)> {
        let head = match &self.form {
            Form::File(head) => head.as_slice(),
            Form::Folder | Form::Special(_) => &[],
        };
        let by_job = || meant(job.function_of(&self.name)?.role).map(|meant| (meant, "the job file"));
        let by_function = || {
            let function = function_of(head)?;
            meant(role_by_function(&function)?).map(|meant| (meant, "its file function"))
        };
        let by_lines = || has_lines_of_holes(head).then_some((Meant::Drill, "most of its lines"));
        let by_name = || self.by_name(shared, head).map(|meant| (meant, "its name"));
        by_job().or_else(by_function).or_else(by_lines).or_else(by_name)
    }

    fn by_name(&self, shared: usize, head: &[u8]) -> Option<Meant> {
        let role = || layers::role_by_name(&self.name, shared);
        let sure = match layers::role_by_sure_name(&self.name) {
            Some(role) => meant(role),
            None if layers::is_gerber_by_extension(&self.name) => role().map_or(Some(Meant::Layer), meant),
            None => None,
        };
        match &self.form {
            Form::File(_) if is_program(head) || is_of_another_kind(head) => None,
            Form::File(_) if is_text_by_name(&self.name) && !is_document(head) => {
                sure.or_else(|| meant(role()?))
            }
            Form::File(_) => sure,
            // A folder `drill` holds drill files; a folder `amp-B_Cu.gbr` is one by mistake.
            Form::Folder => sure.filter(|_| self.name.contains('.')),
            Form::Special(_) => sure.or_else(|| meant(role()?)),
        }
    }

    /// What a person must know of it where nothing says that it is a layer.
    pub(super) fn doubt(&self, shared: usize) -> Option<Warning> {
        let role = || layers::role_by_name(&self.name, shared).and_then(meant);
        match &self.form {
            Form::File(head)
                if is_text_by_name(&self.name)
                    && !is_document(head)
                    && !is_program(head)
                    && !is_binary_drill(head) =>
            {
                let name = &self.name;
                let warning = |message: String| diagnostic::FILE_NOT_UNDERSTOOD.warning(message);
                Some(if is_project(head) {
                    warning(format!("{name} holds the options of pcb2gcode"))
                        .so(Words::of("it is ignored; {millproject} takes them over"))
                } else {
                    warning(format!("the type of {name} is unknown ({}); it is ignored", describe(head)))
                })
            }
            Form::Folder => role().map(|meant| {
                let message = format!("the folder {}, named like {}, is not read", self.name, meant);
                diagnostic::FOLDER_NOT_READ.warning(message)
            }),
            Form::File(_) | Form::Special(_) => None,
        }
    }
}

/// What a file is for that must not get lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meant {
    Copper(Side),
    Outline,
    Drill,
    /// A layer of any kind.
    Layer,
}

impl std::fmt::Display for Meant {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Copper(side) => write!(f, "the copper of the {side}"),
            Self::Outline => f.write_str("the outline"),
            Self::Drill => f.write_str("a drill file"),
            Self::Layer => f.write_str("a layer"),
        }
    }
}

/// What of a role must not get lost: masks and silkscreens are not milled.
const fn meant(role: Role) -> Option<Meant> {
    match role {
        Role::Copper(side) => Some(Meant::Copper(side)),
        Role::Outline => Some(Meant::Outline),
        Role::Drill => Some(Meant::Drill),
        Role::Group(_) => Some(Meant::Layer),
        Role::Other(_) => None,
    }
}

/// Whether drill files are called so, and much else too: Altium's and Proteus' are `.TXT`.
fn is_text_by_name(name: &str) -> bool {
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    extension.is_empty() || extension.eq_ignore_ascii_case("txt")
}

/// Whether a person reads it, or a machine that places parts.
fn is_document(bytes: &[u8]) -> bool {
    is_prose(bytes) || is_list_of_parts(bytes)
}

/// Whether it says at its beginning where parts are to be put, as Fritzing's and Altium's lists do.
fn is_list_of_parts(bytes: &[u8]) -> bool {
    const SAYS: [&[u8]; 6] =
        [b"pick and place", b"pick & place", b"pick place", b"designator", b"refdes", b"centroid"];
    let head = bytes[..bytes.len().min(4096)].to_ascii_lowercase();
    SAYS.iter().any(|words| head.windows(words.len()).any(|window| window == *words))
}

/// Whether it is mostly words.
fn is_prose(bytes: &[u8]) -> bool {
    /// Chosen: a sentence has as many; a header of a drill file has fewer.
    const WORDS: usize = 4;
    let text: String = bytes.iter().map(|&b| char::from(b)).collect();
    let is_word = |word: &&str| {
        let word = word.trim_matches(|c: char| c.is_ascii_punctuation());
        word.len() >= 3 && word.chars().all(|c| c.is_alphabetic() || "'-".contains(c))
    };
    let letters = bytes.iter().filter(|b| b.is_ascii_alphabetic() || b.is_ascii_whitespace() || **b >= 0xa0);
    let seen = bytes.iter().filter(|&&b| b.is_ascii_graphic() || b.is_ascii_whitespace() || b >= 0xa0);
    let seen = seen.count();
    seen == bytes.len()
        && 2 * letters.count() > seen
        && text.split_whitespace().filter(is_word).count() >= WORDS
}

/// Whether it is a known file that shares its extension with a layer: KiCad's old list of
/// components is a `.cmp`.
fn is_of_another_kind(bytes: &[u8]) -> bool {
    bytes.starts_with(b"Cmp-Mod")
}

/// Whether every byte has an odd number of bits: the paper tape's code (EIA RS-244), which Altium
/// still writes.
pub(super) fn is_binary_drill(bytes: &[u8]) -> bool {
    !bytes.is_empty() && bytes.iter().all(|b| b.count_ones() % 2 == 1)
}

/// Whether most lines are coordinates and tools: a drill file whose beginning is damaged.
fn has_lines_of_holes(bytes: &[u8]) -> bool {
    /// Chosen: fewer may be anything.
    const FEWEST: usize = 3;
    if is_program(bytes) {
        return false;
    }
    let is_hole = |line: &&[u8]| {
        let of_drilling = |b: &u8| b.is_ascii_digit() || b"XYTCGMRFS.+-%".contains(b);
        let begins = matches!(line.first(), Some(b'X' | b'Y' | b'T'));
        begins && line.len() > 1 && line[1..].iter().all(of_drilling)
    };
    let lines: Vec<&[u8]> = bytes
        .split(|b| matches!(b, b'\n' | b'\r'))
        .map(<[u8]>::trim_ascii)
        .filter(|line| !line.is_empty())
        .collect();
    let holes = lines.iter().filter(|line| is_hole(line)).count();
    holes >= FEWEST && 2 * holes >= lines.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prose_is_told_from_what_only_looks_like_text() {
        assert!(is_prose(b"Dear reader, this is a board.\nMill it with care.\n"), "a letter");
        for bytes in [&b""[..], b"\0\0\0\0", b"%\n", b"M4\x38;FORMAT={-:-/ absolute}\nX1Y1\n", b"12 34 56\n"]
        {
            assert!(!is_prose(bytes), "{bytes:?}");
        }
    }

    #[test]
    fn a_list_of_parts_is_a_document() {
        let list = b"*Pick And Place List\n1;10;41.93;-42.01\n2;22;1.5;-11.5\n3;47;34.53;-26.77\n";
        assert!(!is_prose(list) && is_document(list), "Fritzing's, mostly numbers");
        assert!(!is_document(b"M48\nT1C0.8\n%\nT1\nX1Y1\n"), "a drill file");
    }

    #[test]
    fn a_program_goes_to_a_height_and_a_drill_file_does_not() {
        assert!(is_program(b"(amp front)\nG21\nG0 Z5\nG1 X1 Y1\n"), "G-code");
        assert!(!is_program(b"M48\nT1C0.8\n%\nT1\nX1Y1\nM30\n"), "a drill file");
        assert!(!is_program(b"%MOMM*%\nG04 Z 5*\nM02*\n"), "a layer");
    }

    #[test]
    fn a_drill_file_is_known_by_its_lines() {
        assert!(has_lines_of_holes(b"\xcd48\nT1C0.8\n%\nT1\nX1Y1\nX2Y2\nM30\n"), "its first byte is damaged");
        assert!(!has_lines_of_holes(b"Xaver, Yvonne and Tom\nmade it\n"), "names");
    }
}
