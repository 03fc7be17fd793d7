//! Zip archives, as manufacturers take them.

use std::collections::BTreeMap;
use std::io::{self, Read};

use zip::result::ZipError;

use super::{Gathered, MOST_BYTES, decoded};
use crate::import::error::Error;
use crate::import::unusable::Unusable;

/// How much an archive may unpack to at least, and how many times its own size beyond that. Gerber
/// packs to a tenth; an archive that packs to less than a hundredth is made to fill the memory.
const UNPACKED: (u64, u64) = (64 << 20, 100);

/// The most entries of an archive that are looked at. Chosen: a board has some dozen files.
const MOST_ENTRIES: usize = 10_000;

impl Gathered {
    /// Takes what an archive holds.
    pub(super) fn zip(&mut self, shown: &str, bytes: Vec<u8>) -> Result<(), Error> {
        let limit = (UNPACKED.1 * bytes.len() as u64).clamp(UNPACKED.0, MOST_BYTES);
        let broken = |error: ZipError| broken_zip(shown, &error);
        let mut archive = zip::ZipArchive::new(io::Cursor::new(&bytes)).map_err(broken)?;
        let doubled =
            archive.has_duplicate_names().then(|| doubled(&bytes, archive.central_directory_start()));
        let doubled = doubled.flatten();
        if archive.len() > MOST_ENTRIES {
            let what = format!("the zip archive has {} entries, more than {MOST_ENTRIES}", archive.len());
            return Err(Error::content(shown, what, "give the folder of one board"));
        }
        if let Some(name) = doubled {
            let what = format!("two entries of the zip archive are called {name}, with different contents");
            return Err(Error::content(shown, what, "unpack it, keep the right one, and give the folder"));
        }
        let mut entries: Vec<(String, usize)> = Vec::new();
        let mut folders: Vec<String> = Vec::new();
        for index in 0..archive.len() {
            let entry = archive.by_index_raw(index).map_err(broken)?;
            let name = String::from_utf8_lossy(entry.name_raw()).replace('\\', "/");
            if name.starts_with("__MACOSX/") {
                continue;
            }
            if entry.is_dir() {
                folders.push(name);
                continue;
            }
            entries.push((name, index));
        }
        entries.sort();
        // What others hold is read with the rest.
        folders.retain(|folder| !entries.iter().any(|(name, _)| name.starts_with(folder)));
        for name in folders {
            let (full, name) = (format!("{shown}/{name}"), last_of(name.trim_end_matches('/')));
            if !self.skips(&full) {
                self.unusable.push(Unusable::folder(name, full));
            }
        }
        let mut left = limit;
        for (full, index) in entries {
            let name = last_of(&full);
            if self.skips(&format!("{shown}/{full}")) {
                continue;
            }
            if !self.looks_for(&name) {
                self.ignored.push(name);
                continue;
            }
            let entry = archive.by_index(index).map_err(broken)?;
            let mut content = Vec::new();
            entry.take(left + 1).read_to_end(&mut content).map_err(|error| broken(ZipError::Io(error)))?;
            left = left.checked_sub(content.len() as u64).ok_or_else(|| {
                let what = format!("the zip archive unpacks to more than {} MiB", limit >> 20);
                Error::content(shown, what, "unpack it yourself if you trust it, and give the folder")
            })?;
            self.take(name, format!("{shown}/{full}"), decoded(content), false);
        }
        Ok(())
    }
}

/// The last part of the name of an archive's entry.
fn last_of(full: &str) -> String {
    full.rsplit('/').next().unwrap_or(full).to_owned()
}

/// The name of two entries with different contents, from the directory at the end of an archive.
///
/// Of entries of one name the library shows the last only. The directory's records begin with
/// PK\x01\x02 and have the checksum at byte 16, both lengths behind it, and the name at byte 46
/// (APPNOTE 6.3.10 §4.3.12).
fn doubled(archive: &[u8], start: u64) -> Option<String> {
    let mut rest = archive.get(usize::try_from(start).ok()?..)?;
    let mut seen = BTreeMap::new();
    while rest.starts_with(b"PK\x01\x02") {
        let length =
            |at: usize| Some(usize::from(u16::from_le_bytes(rest.get(at..at + 2)?.try_into().ok()?)));
        let (name, extra, comment) = (length(28)?, length(30)?, length(32)?);
        let (content, name) = (rest.get(16..28)?, rest.get(46..46 + name)?);
        if seen.insert(name, content).is_some_and(|before| before != content) {
            return Some(String::from_utf8_lossy(name).into_owned());
        }
        rest = rest.get(46 + name.len() + extra + comment..)?;
    }
    None
}

/// Why an archive cannot be read, in the words of someone who downloaded it.
fn broken_zip(shown: &str, error: &ZipError) -> Error {
    match error {
        ZipError::InvalidPassword | ZipError::UnsupportedArchive(ZipError::PASSWORD_REQUIRED) => {
            Error::content(
                shown,
                "the zip archive is encrypted",
                "unpack it with its password and give the folder",
            )
        }
        ZipError::UnsupportedArchive(_) | ZipError::CompressionMethodNotSupported(_) => {
            let what = format!("the zip archive cannot be read: {error}");
            Error::content(shown, what, "unpack it and give the folder")
        }
        _ => {
            let what = "the zip archive is damaged or truncated";
            Error::content(
                shown,
                what,
                "download or pack it again, or unpack it yourself and give the folder",
            )
        }
    }
}
