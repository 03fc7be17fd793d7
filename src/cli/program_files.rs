//! Which files of a folder are programs.

use std::path::{Path, PathBuf};

use super::Failure;

/// What they end in.
pub(super) const ENDINGS: [&str; 9] = ["ngc", "nc", "gcode", "gco", "gc", "g", "cnc", "tap", "iso"];

/// The programs of a folder in order of their names.
pub(super) fn programs(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let failed = |error: &std::io::Error| Failure::io("read", folder, error);
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(|error| failed(&error))? {
        let path = entry.map_err(|error| failed(&error))?.path();
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        if path.is_file() && ending.is_some_and(|ending| ENDINGS.contains(&ending.as_str())) {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// A text: where its bytes are not UTF-8, each is a character, as controllers take it; and whether
/// it is so.
pub(super) fn text_of(bytes: Vec<u8>) -> (String, bool) {
    match String::from_utf8(bytes) {
        Ok(text) => (text, false),
        Err(error) => (error.as_bytes().iter().copied().map(char::from).collect(), true),
    }
}

/// The bytes of a text, of which each character is one where it was read so.
pub(super) fn bytes_of(text: String, is_bytes: bool) -> Vec<u8> {
    if is_bytes { text.chars().map(|c| u8::try_from(c).unwrap_or(b'?')).collect() } else { text.into_bytes() }
}

/// The failure where none of `folders` has any.
pub(super) fn without_programs(folders: &[&Path]) -> Failure {
    let (last, others) = ENDINGS.split_last().expect("several");
    let names: Vec<String> = folders.iter().map(|folder| folder.display().to_string()).collect();
    let hint = format!("a program ends in .{} or .{last}; name others one by one", others.join(", ."));
    Failure::new(format!("{}: no program in this folder", names.join(" and ")), hint)
}
