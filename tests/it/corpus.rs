//! What others made, which is no part of the repository: a variable names its folder, or it lies
//! beside the repository. A test that needs what is not there says so, and checks nothing.

use std::path::{Path, PathBuf};

/// Real boards.
pub(crate) fn boards() -> Option<PathBuf> {
    folder("VOROMILL_BOARDS", "boards")
}

/// The folder of each of the real boards, in order.
pub(crate) fn board_folders() -> Vec<PathBuf> {
    let entries = boards().into_iter().flat_map(|boards| std::fs::read_dir(boards).expect("readable"));
    let mut folders: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    folders.retain(|folder| folder.join("meta.json").is_file());
    folders.sort();
    folders
}

/// Pictures, drawings, KiCad boards, projects of pcb2gcode and programs.
pub(crate) fn artwork() -> Option<PathBuf> {
    folder("VOROMILL_ARTWORK", "artwork")
}

/// What the paper's own program said of its boards.
pub(crate) fn paper_results() -> Option<PathBuf> {
    folder("VOROMILL_PAPER", "paper-results")
}

#[expect(clippy::print_stderr, reason = "a test that skips says so")]
fn folder(variable: &str, usual: &str) -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(usual);
    let folder = std::env::var_os(variable).map_or_else(beside, PathBuf::from);
    if !folder.is_dir() {
        eprintln!("skipped: no folder {} (set {variable})", folder.display());
        return None;
    }
    Some(folder)
}
