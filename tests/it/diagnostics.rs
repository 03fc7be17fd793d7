//! What is said is data first: a code stands in one place, options are named by key, and no text is
//! taken apart again.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use voromill::report::explain;

use super::cli::{stderr, stdout, voromill};
use super::layering::{code, sources, src};

/// The stages whose words name options by their keys.
const STAGES: [&str; 8] = ["board", "artwork", "import", "topology", "toolpath", "coupling", "verify", "job"];

/// A sentence about nets cannot be cut at a colon: nets may be called anything.
#[test]
fn a_net_may_be_called_what_it_likes() {
    let folder = TempDir::new().expect("a folder");
    let pad = |name: &str, x: u32| format!("%TO.N,{name}*%\nX{x}Y0D03*\n");
    let layer = format!(
        "%FSLAX46Y46*%\n%MOMM*%\n%TF.FileFunction,Copper,L1,Top*%\n%ADD10C,1.0*%\nD10*\n{}{}M02*\n",
        pad("VCC: 5V", 0),
        pad("GND: 0V", 1_100_000)
    );
    fs::write(folder.path().join("top.gbr"), layer).expect("writable");
    let done = voromill(
        folder.path(),
        &["mill", "top.gbr", "-o", "out", "--tool", "endmill:0.2mm", "--narrow", "error"],
    );
    assert_eq!(done.status.code(), Some(2), "it does not fit");
    let said = stderr(&done);
    let gap =
        "the cut between VCC: 5V and GND: 0V has 100.0 µm of room, less than its kerf of 200.0 µm at x = ";
    assert!(said.contains(gap), "the whole of it: {said}");
    assert!(!said.contains("it removes up to"), "nothing is taken where nothing is milled: {said}");
}

/// What stands between quotes in a file's code, tests of the crate apart.
fn texts(file: &Path) -> Vec<String> {
    let text = fs::read_to_string(file).expect("readable").replace("\\\"", "''");
    code(&text).split('"').skip(1).step_by(2).map(ToOwned::to_owned).collect()
}

/// Where kinds are registered.
fn is_register(file: &Path) -> bool {
    let name = file.strip_prefix(src()).expect("below src").to_string_lossy().replace('\\', "/");
    name.starts_with("board/diagnostic/")
        || name == "import/diagnostic.rs"
        || name.starts_with("verify/check/")
}

#[test]
fn a_code_stands_in_the_register_alone() {
    let kinds = explain::all();
    let mut strays = Vec::new();
    // Plain words are also values of options, and one option is called as what it is about.
    let is_word = |code: &str| !code.contains('-') || code == "outline-gap";
    for file in sources(&src()).into_iter().filter(|file| !is_register(file)) {
        for text in texts(&file) {
            let known = kinds.iter().any(|kind| kind.code == text && !is_word(kind.code));
            if known {
                strays.push(format!("{}: {text}", file.display()));
            }
        }
        let text = code(&fs::read_to_string(&file).expect("readable"));
        for comparison in [".code == \"", ".code() == \"", "code.starts_with(\""] {
            if text.contains(comparison) {
                strays.push(format!("{}: {comparison}", file.display()));
            }
        }
    }
    assert!(strays.is_empty(), "codes as text: {strays:#?}");
}

/// Whether a text names an option as the command line has it.
fn has_option(text: &str) -> bool {
    text.match_indices("--").any(|(at, _)| text[at + 2..].starts_with(|c: char| c.is_ascii_lowercase()))
}

#[test]
fn stages_name_options_by_their_keys() {
    let files: Vec<PathBuf> = STAGES.iter().flat_map(|stage| sources(&src().join(stage))).collect();
    let spelt = files.iter().flat_map(|file| {
        let texts = texts(file).into_iter().filter(|text| has_option(text));
        texts.map(|text| format!("{}: {text}", file.display())).collect::<Vec<_>>()
    });
    let spelt: Vec<_> = spelt.collect();
    assert!(has_option("say --front") && !has_option("a -- b"), "it would be seen");
    assert!(spelt.is_empty(), "options as the command line has them: {spelt:#?}");
}

/// The keys in words of the sources, and of the register.
fn keys() -> Vec<String> {
    let mut keys: Vec<String> = Vec::new();
    for stage in STAGES {
        for file in sources(&src().join(stage)) {
            let text = code(&fs::read_to_string(&file).expect("readable"));
            for words in text.split("Words::of(").skip(1) {
                let Some(words) = words.trim_start().strip_prefix('"') else { continue };
                let words = words.split('"').next().unwrap_or_default();
                keys.extend(
                    words.split('{').skip(1).filter_map(|key| Some(key.split_once('}')?.0.to_owned())),
                );
            }
        }
    }
    keys.retain(|key| key.parse::<usize>().is_err());
    for kind in explain::all() {
        keys.extend(kind.effect.options().chain(kind.advice.options()).map(ToOwned::to_owned));
    }
    keys
}

#[test]
fn every_option_that_is_advised_is_one() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let helps: String = super::words::COMMANDS
        .iter()
        .map(|command| stdout(&voromill(root, &[command, "--help-all"])))
        .collect();
    let keys = keys();
    assert!(keys.len() > 100, "they are found: {}", keys.len());
    let is_option = |key: &str| {
        let option = format!("--{key}");
        helps.match_indices(&option).any(|(at, _)| {
            !helps[at + option.len()..].starts_with(|c: char| c.is_ascii_alphanumeric() || c == '-')
        })
    };
    let unknown: Vec<_> = keys.iter().filter(|key| !is_option(key)).collect();
    assert!(unknown.is_empty(), "no command has these options: {unknown:?}");
}
