//! Damage to real boards: files cut off, bytes flipped, files emptied and swapped. Whatever becomes
//! of a board, it never has more or fewer layers of copper or drill files than before without a
//! word.
//!
//! `VOROMILL_MUTATIONS` says how many cuts and flips there are for each file (one unless told);
//! emptied is each file, swapped each pair. The same numbers give the same damage. With 25:
//!
//! ```sh
//! VOROMILL_MUTATIONS=25 cargo test --test it no_damage_changes -- --nocapture
//! ```

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use voromill::import::{Loaded, load};

use crate::corpus::board_folders;
use crate::random::splitmix64;
use crate::real_boards;

/// What is done to a board.
enum Damage {
    /// A file ends after so many bytes.
    Cut(usize, usize),
    /// A byte of a file gets these bits flipped.
    Flip(usize, usize, u8),
    /// A file is empty.
    Empty(usize),
    /// Two files have each other's content.
    Swap(usize, usize),
}

/// A board's files, and how it is read as it is.
struct Subject {
    name: String,
    files: Vec<(String, Vec<u8>)>,
    before: Census,
}

/// What must not change in silence.
#[derive(Clone, PartialEq, Eq)]
struct Census {
    copper: usize,
    drills: usize,
    /// The codes of all warnings, sorted.
    warnings: Vec<&'static str>,
}

impl From<Loaded> for Census {
    fn from(loaded: Loaded) -> Self {
        let mut warnings: Vec<_> = loaded.warnings.iter().map(|warning| warning.code()).collect();
        warnings.sort_unstable();
        Self {
            copper: [loaded.board.front.is_some(), loaded.board.back.is_some()]
                .iter()
                .filter(|&&is| is)
                .count(),
            drills: loaded.sources.iter().filter(|source| source.role == "drill").count(),
            warnings,
        }
    }
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cut(file, at) => write!(f, "file {file} cut at byte {at}"),
            Self::Flip(file, at, bits) => write!(f, "file {file}, byte {at} ^ {bits:#04x}"),
            Self::Empty(file) => write!(f, "file {file} empty"),
            Self::Swap(one, other) => write!(f, "files {one} and {other} swapped"),
        }
    }
}

impl Damage {
    /// The kind, as a row of the counts.
    const fn kind(&self) -> usize {
        match self {
            Self::Cut(..) => 0,
            Self::Flip(..) => 1,
            Self::Empty(_) => 2,
            Self::Swap(..) => 3,
        }
    }

    fn done_to(&self, files: &mut [(String, Vec<u8>)]) {
        match *self {
            Self::Cut(file, at) => files[file].1.truncate(at),
            Self::Flip(file, at, bits) => files[file].1[at] ^= bits,
            Self::Empty(file) => files[file].1.clear(),
            Self::Swap(one, other) => {
                let content = std::mem::take(&mut files[one].1);
                let content = std::mem::replace(&mut files[other].1, content);
                files[one].1 = content;
            }
        }
    }
}

/// Numbers that look random and are the same every time (SplitMix64, G. Steele and others, OOPSLA
/// 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        usize::try_from(splitmix64(&mut self.0) % end.max(1) as u64).expect("below a usize")
    }
}

/// The boards that are read as they are, or with what a person has to say; what lies beside their
/// files for the tests is no part of them.
fn subjects() -> Vec<Subject> {
    board_folders()
        .into_iter()
        .filter_map(|folder| {
            let is_of_board =
                |path: &PathBuf| path.is_file() && path.extension().is_none_or(|end| end != "json");
            let entries =
                fs::read_dir(&folder).expect("readable").map(|entry| entry.expect("an entry").path());
            let mut paths: Vec<PathBuf> = entries.filter(is_of_board).collect();
            paths.sort();
            let name = |path: &Path| path.file_name().expect("a name").to_string_lossy().into_owned();
            let files: Vec<_> =
                paths.iter().map(|path| (name(path), fs::read(path).expect("readable"))).collect();
            let before = read(&files)?;
            Some(Subject { name: name(&folder), files, before })
        })
        .collect()
}

/// How these files are read as a board; none where they are refused.
fn read(files: &[(String, Vec<u8>)]) -> Option<Census> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("written");
    }
    load(&[folder.path().to_owned()], &real_boards::selection(folder.path())).ok().map(Census::from)
}

/// All damage to a board, `count` cuts and flips a file.
fn damages(subject: &Subject, count: usize, seed: u64) -> Vec<Damage> {
    let mut random = Random(seed);
    let mut damages = Vec::new();
    for (file, (_, bytes)) in subject.files.iter().enumerate() {
        let ends: Vec<usize> =
            bytes.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(at, _)| at + 1).collect();
        for _ in 0..count {
            let at = ends.get(random.below(ends.len())).copied().unwrap_or(bytes.len() / 2);
            damages.push(Damage::Cut(file, at));
            let bits = u8::try_from(1 + random.below(255)).expect("a byte");
            damages.push(Damage::Flip(file, random.below(bytes.len().min(200)), bits));
        }
        damages.push(Damage::Empty(file));
        damages.extend((0..file).map(|other| Damage::Swap(other, file)));
    }
    damages
}

#[test]
fn no_damage_changes_the_number_of_layers_or_drill_files_without_a_word() {
    let count = std::env::var("VOROMILL_MUTATIONS").ok().and_then(|count| count.parse().ok()).unwrap_or(1);
    let subjects = subjects();
    let work: Vec<(&Subject, Damage)> = subjects
        .iter()
        .zip(1_u64..)
        .flat_map(|(subject, seed)| {
            damages(subject, count, seed).into_iter().map(move |damage| (subject, damage))
        })
        .collect();
    // Of each kind: refused, warned of, the same board's layers, and in silence.
    let outcome = |(subject, damage): &(&Subject, Damage)| {
        let mut files = subject.files.clone();
        damage.done_to(&mut files);
        let Some(after) = read(&files) else { return (damage.kind(), 0, None) };
        let same = (after.copper, after.drills) == (subject.before.copper, subject.before.drills);
        match (after.warnings == subject.before.warnings, same) {
            (false, _) => (damage.kind(), 1, None),
            (true, true) => (damage.kind(), 2, None),
            (true, false) => {
                let before = &subject.before;
                let names: Vec<&str> = subject.files.iter().map(|(name, _)| name.as_str()).collect();
                let what = format!(
                    "{} {names:?}, {damage}: {} copper and {} drills, once {} and {}",
                    subject.name, after.copper, after.drills, before.copper, before.drills
                );
                (damage.kind(), 3, Some(what))
            }
        }
    };
    let outcomes: Vec<_> = work.par_iter().map(outcome).collect();
    let mut counts = [[0_u32; 4]; 4];
    for (kind, what, _) in &outcomes {
        counts[*kind][*what] += 1;
    }
    for (kind, [refused, warned, same, silent]) in ["cut", "flip", "empty", "swap"].iter().zip(counts) {
        println!("{kind:6} {refused:6} refused {warned:6} warned of {same:6} the same {silent:6} in silence");
    }
    let silent: Vec<String> = outcomes.into_iter().filter_map(|(.., what)| what).collect();
    assert!(silent.is_empty(), "{} in silence:\n{}", silent.len(), silent.join("\n"));
}
