//! How the source reads: what can be held by a test of the rules that it is written by.

use std::fs;
use std::path::{Path, PathBuf};

/// Columns that a comment may take.
const WIDTH: usize = 100;

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder of sources").map(|e| e.expect("an entry").path()) {
        if entry.is_dir() && entry.file_name().is_some_and(|name| name != "target") {
            sources(&entry, found);
        } else if entry.extension().is_some_and(|e| e == "rs") {
            found.push(entry);
        }
    }
}

fn all() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    for folder in ["src", "tests", "benches", "examples"] {
        sources(&root.join(folder), &mut found);
    }
    found.sort();
    assert!(found.len() > 300, "the sources are where they are looked for: {}", found.len());
    found.into_iter().map(|file| (file.clone(), fs::read_to_string(file).expect("text"))).collect()
}

#[test]
fn every_file_begins_with_what_it_is() {
    let bare: Vec<_> = all().into_iter().filter(|(_, text)| !text.starts_with("//!")).collect();
    assert!(
        bare.is_empty(),
        "no //! line first: {:?}",
        bare.iter().map(|(file, _)| file).collect::<Vec<_>>()
    );
}

/// Drawings, tables and examples in code fences are as wide as they must be.
#[test]
fn comments_are_at_most_a_hundred_characters_wide() {
    let mut wide = Vec::new();
    for (file, text) in all() {
        let mut fenced = false;
        for (line, number) in text.lines().zip(1..) {
            let Some(comment) = line.trim_start().strip_prefix("//") else {
                fenced = false;
                continue;
            };
            let body = comment.trim_start_matches(['/', '!']).trim_start();
            if body.starts_with("```") {
                fenced = !fenced;
            } else if !fenced && !body.starts_with('|') && !is_one_word(body) && line.chars().count() > WIDTH
            {
                wide.push(format!("{}:{number}", file.display()));
            }
        }
    }
    assert!(wide.is_empty(), "wider than {WIDTH} characters: {wide:#?}");
}

/// A link or a name that cannot be broken.
fn is_one_word(body: &str) -> bool {
    body.split_whitespace().nth(2).is_none()
}
