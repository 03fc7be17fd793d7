//! The words that people read: help in two steps, codes that are explained, no private language.

use std::fs;
use std::path::{Path, PathBuf};

use voromill::report::explain;

use super::cli::{stderr, stdout, voromill};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

const COMMANDS: [&str; 15] = [
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

/// Every code that the sources give a warning.
fn codes() -> Vec<String> {
    let mut codes = Vec::new();
    let mut folders = vec![root().join("src")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = fs::read_to_string(&path).expect("text");
            // Tests of the crate make up codes of their own.
            let text = text.split("#[cfg(test)]").next().unwrap_or_default();
            for after in text.split("Warning::new(\"").chain(text.split("warn(\"")).skip(1) {
                let code: String =
                    after.chars().take_while(|&c| c == '-' || c.is_ascii_lowercase()).collect();
                if after[code.len()..].starts_with('"') && code.contains('-') {
                    codes.push(code);
                }
            }
        }
    }
    codes
}

#[test]
fn every_code_is_explained() {
    let codes = codes();
    assert!(codes.len() > 20, "they are found: {codes:?}");
    for code in codes {
        let done = voromill(&root(), &["explain", &code]);
        assert!(done.status.success(), "{code}: {}", stderr(&done));
        assert!(stdout(&done).lines().count() >= 3, "{code}: what, effect, what to try");
    }
    for explained in explain::all() {
        let texts = [explained.what, explained.cost, explained.cure];
        assert!(texts.iter().all(|text| !text.is_empty() && !text.ends_with('.')), "{explained:?}");
    }
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
