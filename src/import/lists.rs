//! Which aperture list belongs to which RS-274-D file.
//!
//! A list lies in the same folder or archive as its files. One list is for all; of several, the one
//! named like the file; where that tells nothing, guessing would draw with the wrong sizes, so it
//! is an error.

use std::collections::BTreeSet;
use std::path::Path;

use super::archive::{Found, Gathered, name_of, read_file};
use super::error::Error;
use super::format::Kind;
use super::gerber::{self, ApertureList, Image, Options};
use super::naming::stem;

impl Gathered {
    /// Looks for aperture lists beside a file that a person named, if it needs one.
    pub(super) fn look_beside(&mut self, path: &Path, bytes: &[u8]) {
        if !(gerber::lacks_apertures(bytes) && Kind::of(bytes) == Kind::Gerber) {
            return;
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let mut paths: Vec<_> = entries.map(|entry| entry.path()).filter(|path| path.is_file()).collect();
        paths.sort();
        for path in paths.iter().filter(|path| ApertureList::is_named(&name_of(path))) {
            // What cannot be read is no list, and its absence is reported where one is needed.
            let bytes = read_file(path, &path.display().to_string()).unwrap_or_default();
            self.lists.extend(ApertureList::read(&name_of(path), &bytes));
        }
    }

    /// The list that `file` draws with; none where it has apertures of its own, or where there is
    /// no list.
    pub(super) fn list_for(&self, file: &Found) -> Result<Option<&ApertureList>, Error> {
        if self.lists.is_empty() || !gerber::lacks_apertures(&file.bytes) {
            return Ok(None);
        }
        let alike = |list: &&ApertureList| stem(&list.file).eq_ignore_ascii_case(stem(&file.name));
        let mut named: Vec<&ApertureList> = self.lists.iter().filter(alike).collect();
        if named.is_empty() {
            named = self.lists.iter().collect();
        }
        named.dedup_by(|a, b| a.source().sha256 == b.source().sha256);
        match named.as_slice() {
            [list] => Ok(Some(list)),
            lists => {
                let names: BTreeSet<&str> = lists.iter().map(|list| list.file.as_str()).collect();
                let names = names.into_iter().collect::<Vec<_>>().join(", ");
                let what = format!("its apertures (RS-274-D) may be in any of several lists: {names}");
                let hint =
                    format!("rename the right one to {}.apt, or leave the others out", stem(&file.name));
                Err(Error::content(&file.shown, what, hint))
            }
        }
    }

    /// Reads a Gerber file, with the list beside it where it needs one.
    pub(super) fn read_gerber(&self, file: &Found) -> Result<Image, Error> {
        let options = Options::default();
        let alone = || gerber::read(&file.name, &file.bytes, &options);
        match self.list_for(file) {
            Ok(Some(list)) => gerber::read_beside(&file.name, &file.bytes, list, &options),
            Ok(None) => alone(),
            // Which one it is matters to what draws with apertures alone.
            Err(ambiguous) => alone().map_err(|_| ambiguous),
        }
    }
}
