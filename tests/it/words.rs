//! The words that people read: help in two steps, codes that are explained, no private language.

use std::fs;
use std::path::{Path, PathBuf};

use voromill::report::explain;

use super::cli::{stderr, stdout, voromill};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

pub(crate) const COMMANDS: [&str; 15] = [
    "mill", "isolate", "draw", "mask", "carve", "pocket", "inspect", "verify", "diff", "probe", "level",
    "tools", "machine", "explain", "init",
];

fn help(arguments: &[&str]) -> String {
    stdout(&voromill(&root(), arguments))
}

/// How many options a help text shows.
fn options(help: &str) -> usize {
    let is_option = |line: &&str| line.trim_start().starts_with('-') && !line.starts_with("       ");
    help.lines().filter(is_option).count()
}

#[test]
fn help_shows_first_what_people_use_first() {
    let (first, all) = (help(&["mill", "--help"]), help(&["mill", "--help-all"]));
    assert!((12..=24).contains(&options(&first)), "two dozen at most: {}", options(&first));
    assert!(options(&all) > 80, "every one: {}", options(&all));
    let further = format!("{} more options: voromill mill --help-all", options(&all) - options(&first));
    assert!(first.contains(&further), "`{further}`: {first}");
    for option in ["--tool", "--depth", "--dialect", "--thickness", "--output"] {
        assert!(first.contains(option), "{option} is among them");
    }
    for command in COMMANDS {
        let done = voromill(&root(), &[command, "--help-all"]);
        assert!(done.status.success() && options(&stdout(&done)) > 2, "{command}: {}", stderr(&done));
    }
}

/// Words of the crate that no reader should have to learn: the glossary has others for them.
const BANNED: [&str; 11] = [
    "turned over",
    "turn it over",
    " bent",
    " bend ",
    "most way",
    " lap ",
    "means a net",
    "speck of",
    "crumb",
    "leash",
    "wheel",
];

#[test]
fn help_speaks_the_language_of_the_trade() {
    let mut texts: Vec<String> = COMMANDS.iter().map(|command| help(&[command, "--help-all"])).collect();
    texts.extend([help(&["--help"]), explain::page(), explain::list()]);
    for text in texts {
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        for banned in BANNED {
            assert!(!words.contains(banned), "`{banned}` in: {text}");
        }
    }
}

#[test]
fn old_names_of_options_are_still_taken() {
    let board = root().join("fixtures/verify/pads-F_Cu.gbr");
    let program = root().join("fixtures/verify/loops.nc");
    let (board, program) = (board.to_string_lossy().into_owned(), program.to_string_lossy().into_owned());
    let run = |option: &str, value: &str| {
        let given = [
            "verify",
            &program,
            "--board",
            &board,
            "--tool",
            "endmill:0.2mm",
            "--side",
            "front",
            option,
            value,
        ];
        stdout(&voromill(&root(), &given))
    };
    for [now, before, value] in [
        ["--machine-travel", "--travel", "5mm,100mm,100mm"],
        ["--pixel", "--resolution", "10um"],
        ["--mirror-axis", "--mirror", "3mm"],
    ] {
        let told = run(now, value);
        assert!(!told.is_empty() && told == run(before, value), "{before} is {now}: {told}");
        assert!(!help(&["verify", "--help-all"]).contains(&format!("{before} ")), "{before} is not shown");
    }
}

#[test]
fn every_code_is_explained() {
    let kinds = explain::all();
    assert!(kinds.len() > 100, "they are listed: {}", kinds.len());
    for kind in kinds {
        let text = explain::explain(kind.code).expect("a code of the register");
        assert!(text.lines().count() >= 3, "{}: what, effect, what to try", kind.code);
        let texts = [kind.what.to_string(), kind.effect.to_string(), kind.advice.to_string()];
        assert!(texts.iter().all(|text| !text.is_empty() && !text.ends_with('.')), "{kind:?}");
    }
    let done = voromill(&root(), &["explain", "gap-narrower-than-tool"]);
    assert!(done.status.success() && stdout(&done).starts_with("gap-narrower-than-tool: "), "by name");
    assert_eq!(voromill(&root(), &["explain", "no-such-code"]).status.code(), Some(2), "an unknown one");
}

/// `VOROMILL_WRITE_DOCS=1 cargo test --test it words` writes it.
#[test]
fn the_page_of_findings_is_todays() {
    let path = root().join("docs/findings.md");
    if std::env::var_os("VOROMILL_WRITE_DOCS").is_some() {
        fs::write(&path, explain::page()).expect("writable");
    }
    assert!(
        fs::read_to_string(path).expect("the page") == explain::page(),
        "docs/findings.md is of another day"
    );
}
