//! From paths to files in memory: folders, zip archives and single files, mixed.

#[cfg(feature = "zip")]
mod zipped;
#[cfg(not(feature = "zip"))]
#[path = "no_zip.rs"]
mod zipped;

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use super::error::{self, Error, locate};
use super::format::Kind;
use super::gerber::ApertureList;
use super::jobfile::Job;
use super::unusable::Unusable;
use crate::board::{SourceSpan, Words};

/// The largest file that is read, and the most that an archive may unpack to.
///
/// Chosen: a Gerber of a 600 mm panel has some 50 MB; ten times that.
const MOST_BYTES: u64 = 512 << 20;

/// So many bytes of a file are its head: twice what any reader looks at, as letters may be two
/// bytes each.
const HEAD: u64 = 8192;

/// A file that may belong to the board.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// Its name without folders.
    pub(super) name: String,
    /// Its name as the person gave it, for messages.
    pub(super) shown: String,
    /// The content.
    pub(super) bytes: Vec<u8>,
    /// What it is, by content.
    pub(super) kind: Kind,
    /// Whether the person named it, rather than the folder it lies in.
    pub(super) named: bool,
}

impl Found {
    /// Its first line, for what concerns all of it.
    pub(super) fn first_line(&self) -> SourceSpan {
        self.at_line(1)
    }

    pub(super) fn at_line(&self, number: u32) -> SourceSpan {
        locate(&self.name, &self.bytes, error::line(&self.bytes, number))
    }
}

/// What lies under the paths that a person gave.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    /// Layers and drill files, in the order of paths and, in folders and archives, of names.
    pub(super) files: Vec<Found>,
    /// Job files.
    pub(super) jobs: Vec<(String, Vec<u8>)>,
    /// Aperture lists of RS-274-D files.
    pub(super) lists: Vec<ApertureList>,
    /// Names of what is neither.
    pub(super) ignored: Vec<String>,
    /// What of it can be no layer by its content, and may be meant as one.
    pub(super) unusable: Vec<Unusable>,
    /// Folders that are not looked into.
    pub(super) folders: Vec<String>,
    /// What a person wants left aside, and whether it was met.
    skipped: Vec<(PathBuf, bool)>,
    look: Look,
    /// How many files were looked at, where folders inside folders are looked into.
    looked_at: usize,
}

/// What is looked for in folders and archives.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Look {
    /// Whether KiCad boards, and not layers.
    pub(super) boards: bool,
    /// How deep in folders inside the given ones. Archives are looked through.
    pub(super) depth: u32,
}

/// The most files of folders inside folders that are looked at. Chosen: a board has some dozen, and
/// whoever gives the wrong folder does not wait.
const MOST_NESTED: usize = 1000;

impl Gathered {
    /// What is looked for under `paths`, but what `skip` names.
    pub(super) fn under(paths: &[impl AsRef<Path>], skip: &[PathBuf], look: Look) -> Result<Self, Error> {
        let plain = |path: &PathBuf| path.components().filter(|part| *part != Component::CurDir).collect();
        let skipped = skip.iter().map(|path| (plain(path), false)).collect();
        let mut gathered = Self { skipped, look, ..Self::default() };
        for path in paths {
            gathered.path(path.as_ref())?;
        }
        Ok(gathered)
    }

    /// Whether something was found, and lies as the files of one board do: all layers in one
    /// folder, and all drill files in one, be it another, as EAGLE and Altium write them.
    pub(super) fn lies_together(&self) -> bool {
        let is_alone = |kind: Kind| {
            let mut of_kind = self.files.iter().filter(|file| file.kind == kind);
            let folder = |file: &Found| Path::new(&file.shown).parent().map(Path::to_path_buf);
            let first = of_kind.next().map(folder);
            of_kind.all(|file| first == Some(folder(file)))
        };
        self.looked_at <= MOST_NESTED
            && !self.files.is_empty()
            && [Kind::Gerber, Kind::Excellon].into_iter().all(is_alone)
    }

    /// Whether a person wants the layer `name` of a KiCad board left aside.
    pub(super) fn skips_layer(&mut self, name: &str) -> bool {
        let mut skips = false;
        for (_, met) in self.skipped.iter_mut().filter(|(path, _)| path.as_os_str() == name) {
            (*met, skips) = (true, true);
        }
        skips
    }

    /// Fails for what was to be left aside and is not there.
    pub(super) fn refuse_unmet_skips(&self) -> Result<(), Error> {
        match self.skipped.iter().find(|(_, met)| !met) {
            None => Ok(()),
            Some((path, _)) => {
                let what = "no such file or folder among those given, so it cannot be ignored";
                Err(Error::content(
                    &path.display().to_string(),
                    what,
                    Words::of("check the name after {skip}"),
                ))
            }
        }
    }

    /// Whether a person wants `shown` left aside: by its name, or by the end of its path.
    fn skips(&mut self, shown: &str) -> bool {
        let mut skips = false;
        for (path, met) in self.skipped.iter_mut().filter(|(path, _)| Path::new(shown).ends_with(path)) {
            (*met, skips) = (!path.as_os_str().is_empty(), true);
        }
        if skips {
            self.ignored.push(name_of(Path::new(shown)));
        }
        skips
    }

    fn path(&mut self, path: &Path) -> Result<(), Error> {
        let shown = path.display().to_string();
        if self.skips(&shown) {
            return Ok(());
        }
        let meta = fs::metadata(path).map_err(|error| unreadable(&shown, &error))?;
        if meta.is_dir() {
            return self.folder(path, &shown, self.look.depth);
        }
        let bytes = read_file(path, &shown)?;
        if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06") {
            return self.zip(&shown, bytes);
        }
        self.look_beside(path, &bytes);
        self.take(name_of(path), shown, bytes, true);
        Ok(())
    }

    /// Takes what a folder holds, and those inside it so deep.
    fn folder(&mut self, path: &Path, shown: &str, depth: u32) -> Result<(), Error> {
        let entries = fs::read_dir(path).and_then(Iterator::collect::<io::Result<Vec<_>>>);
        let mut paths: Vec<_> =
            entries.map_err(|error| unreadable(shown, &error))?.iter().map(fs::DirEntry::path).collect();
        paths.sort();
        for path in paths {
            let (name, shown) = (name_of(&path), path.display().to_string());
            if self.skips(&shown) {
                continue;
            }
            if self.look.depth > 0 {
                self.looked_at += 1;
                if self.looked_at > MOST_NESTED {
                    return Ok(());
                }
            }
            if path.is_dir() && depth > 0 && !name.starts_with('.') {
                self.folder(&path, &shown, depth - 1)?;
            } else if path.is_dir() {
                self.folders.push(name.clone());
                self.unusable.push(Unusable::folder(name, shown));
            } else if !self.looks_for(&name) {
                self.ignored.push(name);
            } else if let Some(what) = special(&path) {
                self.ignored.push(name.clone());
                self.unusable.push(Unusable::special(name, shown, what));
            } else {
                let bytes = read_file(&path, &shown)?;
                self.take(name, shown, bytes, false);
            }
        }
        Ok(())
    }

    /// Whether a file of a folder or an archive is opened.
    fn looks_for(&self, name: &str) -> bool {
        if self.look.boards { is_board(name) } else { worth_reading(name) }
    }

    fn take(&mut self, name: String, shown: String, bytes: Vec<u8>, named: bool) {
        if Job::is_named(&name) {
            return self.jobs.push((name, bytes));
        }
        let kind = Kind::of(&bytes);
        if kind == Kind::Kicad && !named && !self.look.boards {
            return self.ignored.push(name);
        }
        let listed = named || ApertureList::is_named(&name);
        let list = (kind == Kind::Unknown && listed).then(|| ApertureList::read(&name, &bytes)).flatten();
        if let Some(list) = list {
            self.lists.push(list);
        } else if kind == Kind::Unknown && !named {
            self.ignored.push(name.clone());
            self.unusable.push(Unusable::file(name, shown, &bytes));
        } else {
            self.files.push(Found { name, shown, bytes, kind, named });
        }
    }
}

/// The last part of a path; of `.` and `..`, that of the folder they stand for.
pub(super) fn name_of(path: &Path) -> String {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
    let real = || fs::canonicalize(path).ok()?.file_name().map(|name| name.to_string_lossy().into_owned());
    name.or_else(real).unwrap_or_default()
}

/// What a path is that is neither a folder nor a file that can be read to its end.
fn special(path: &Path) -> Option<&'static str> {
    match fs::metadata(path) {
        Ok(meta) if meta.is_file() => None,
        Ok(_) => Some("a pipe or a device, not a file"),
        // Whatever else is wrong with it, reading it will tell.
        Err(error) if error.kind() != io::ErrorKind::NotFound && !path.is_symlink() => None,
        Err(_) => Some("a broken link"),
    }
}

/// Texts of two bytes a character as texts of one or more (UTF-8), and all without a byte order
/// mark.
///
/// Editors of Windows save them so. Without a mark they are known by every other byte of the
/// beginning, which is zero.
fn decoded(bytes: Vec<u8>) -> Vec<u8> {
    /// How many characters must be of plain ASCII where there is no mark. Chosen: no other text
    /// begins with eight zero bytes between eight letters.
    const ENOUGH: usize = 8;
    let of_ascii = |high: usize| {
        let pairs = bytes.chunks_exact(2).take(ENOUGH);
        pairs.len() == ENOUGH && pairs.clone().all(|pair| pair[high] == 0 && pair[1 - high] != 0)
    };
    let read: fn([u8; 2]) -> u16 = match bytes.as_slice() {
        [0xef, 0xbb, 0xbf, rest @ ..] => return rest.to_vec(),
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ if of_ascii(1) => u16::from_le_bytes,
        _ if of_ascii(0) => u16::from_be_bytes,
        _ => return bytes,
    };
    let units = bytes.chunks_exact(2).map(|pair| read([pair[0], pair[1]])).filter(|&unit| unit != 0xfeff);
    let text: String = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
    text.into_bytes()
}

/// Reads a file of at most [`MOST_BYTES`].
pub(super) fn read_file(path: &Path, shown: &str) -> Result<Vec<u8>, Error> {
    let bytes = read_first(path, shown, MOST_BYTES + 1)?;
    if bytes.len() as u64 > MOST_BYTES {
        let what = format!("the file has more than {} MiB", MOST_BYTES >> 20);
        return Err(Error::content(shown, what, "no board layer is that large"));
    }
    Ok(decoded(bytes))
}

/// Reads how a file begins, by which pictures and drawings are told from all others.
pub(super) fn read_head(path: &Path, shown: &str) -> Result<Vec<u8>, Error> {
    read_first(path, shown, HEAD).map(decoded)
}

/// Reads so many bytes of a file, or all.
fn read_first(path: &Path, shown: &str, most: u64) -> Result<Vec<u8>, Error> {
    // Opening a pipe waits for somebody to write into it.
    if !path.is_dir()
        && let Some(what) = special(path).filter(|_| path.exists())
    {
        return Err(Error::content(shown, what, "save its output to a file, and give that file"));
    }
    let read = || {
        let file = File::open(path)?;
        let size = file.metadata()?.len().min(most);
        let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or_default());
        file.take(most).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    read().map_err(|error| unreadable(shown, &error))
}

fn unreadable(shown: &str, error: &io::Error) -> Error {
    match error.kind() {
        io::ErrorKind::NotFound => Error::content(shown, "no such file or folder", "check the path"),
        io::ErrorKind::PermissionDenied => Error::content(shown, "may not be read", "check its permissions"),
        _ => Error::content(shown, format!("cannot be read: {error}"), "check the path"),
    }
}

/// Whether a file of a folder is a KiCad board: what it saves by itself between times is none.
fn is_board(name: &str) -> bool {
    let hidden = name.starts_with('.') || name.starts_with("_autosave-");
    !hidden && name.to_ascii_lowercase().ends_with(".kicad_pcb")
}

/// Whether a file of a folder could be a layer: hidden files, pictures and documents are not
/// opened.
fn worth_reading(name: &str) -> bool {
    const NEVER: [&str; 24] = [
        "png",
        "jpg",
        "jpeg",
        "gif",
        "bmp",
        "svg",
        "pdf",
        "ps",
        "html",
        "htm",
        "md",
        "json",
        "toml",
        "yaml",
        "yml",
        "csv",
        "xml",
        "zip",
        "kicad_pcb",
        "brd",
        "sch",
        "ngc",
        "nc~",
        "exe",
    ];
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension).to_ascii_lowercase();
    !name.starts_with('.') && !NEVER.contains(&extension.as_str())
}
