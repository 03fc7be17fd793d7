//! Warnings about files: where, what stands there, what was expected, what to do; for a person and
//! for a program.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::{stdout, voromill};

/// A drill file and two layers in which much is wrong that can be read all the same.
fn sloppy() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/sloppy")
}

#[test]
fn a_warning_shows_the_line_and_says_what_to_do() {
    let done = voromill(&sloppy(), &["inspect", ".", "-v"]);
    let text = stdout(&done);
    let warnings = text.find("\n  warning").map_or("", |start| &text[start..]);
    insta::with_settings!({
        snapshot_path => concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots/import"),
        prepend_module_to_snapshot => false,
        omit_expression => true,
    }, { insta::assert_snapshot!("warnings", warnings) });
}

#[test]
fn a_program_reads_of_each_warning_where_it_is_and_what_to_do() {
    let done = voromill(&sloppy(), &["inspect", ".", "--format", "json"]);
    let report: serde_json::Value = serde_json::from_slice(&done.stdout).expect("JSON");
    let warnings = report["warnings"].as_array().expect("a list");
    assert!(warnings.len() > 15, "there is much to say: {}", warnings.len());
    for warning in warnings.iter().filter(|warning| !warning["source"].is_null()) {
        let source = &warning["source"];
        let name = source["file"].as_str().expect("a file");
        let number = |key: &str| usize::try_from(source[key].as_u64().expect("a number")).expect("small");
        let file = fs::read_to_string(sloppy().join(name)).expect("readable");
        let line = file.lines().nth(number("line") - 1).expect("a line of the file");
        let text = source["text"].as_str().expect("the offending text");
        assert!(!text.is_empty(), "a text is shown: {warning}");
        assert!(line[number("column") - 1..].starts_with(text), "`{text}` stands there: {warning}");
        for key in ["expected", "advice"] {
            assert!(warning[key].as_str().is_some_and(|words| !words.is_empty()), "has its {key}: {warning}");
        }
    }
}
