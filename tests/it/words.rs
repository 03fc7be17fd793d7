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
const BANNED: [&str; 36] = [
    "turned over",
    "turn it over",
    "turning over",
    "from behind",
    " bent",
    " bend ",
    "bends the program",
    "most way",
    " lap ",
    "means a net",
    "speck of",
    "crumb",
    "leash",
    "aperture wheel",
    "cut width",
    "width of their cut",
    "saves a lift",
    "lifts,",
    " lifted",
    "anybody's",
    "Freedom of",
    "takes copper",
    "changes nothing",
    "unresolved tip",
    "nothing tells",
    "makes no sense",
    "obody told",
    "as told",
    "fault of voromill",
    "have the layer written",
    "have the file written",
    "is no command",
    "stands twice",
    "leave it aside",
    "nobody can know",
    "passed over",
];

/// Every text that a person may see, with where it stands: help, explanations, the words of the
/// sources, the page, settings, programs, docs.
fn texts() -> Vec<(String, String)> {
    let mut texts: Vec<(String, String)> = COMMANDS
        .iter()
        .map(|command| (format!("{command} --help-all"), help(&[command, "--help-all"])))
        .collect();
    texts.push(("--help".to_owned(), help(&["--help"])));
    texts.push(("docs/findings.md".to_owned(), explain::page() + &explain::list()));
    for file in files(&["src", "docs", "snapshots/gcode", "snapshots/report", "README.md", "CONTRIBUTING.md"])
    {
        let name = file.strip_prefix(root()).unwrap_or(&file).display().to_string();
        let Ok(text) = fs::read_to_string(&file) else { continue };
        if name.ends_with(".rs") {
            // Tests of the crate speak to who reads them.
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            texts.extend(literals(code).into_iter().map(|(line, words)| (format!("{name}:{line}"), words)));
        } else {
            texts.push((name, text));
        }
    }
    texts
}

fn files(roots: &[&str]) -> Vec<PathBuf> {
    let mut left: Vec<PathBuf> = roots.iter().map(|name| root().join(name)).collect();
    let mut found = Vec::new();
    while let Some(path) = left.pop() {
        if path.is_dir() {
            left.extend(fs::read_dir(path).expect("a folder").map(|entry| entry.expect("an entry").path()));
        } else {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The string literals of Rust code that have words in them, each with its line.
pub(crate) fn literals(code: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let (mut rest, mut line) = (code, 1);
    while let Some(first) = rest.chars().next() {
        let taken = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("'\"'") || rest.starts_with("'\\") {
            // A character: at least a quote, what it is, a quote.
            2 + rest[2..].find('\'').map_or(rest.len() - 2, |end| end + 1)
        } else if let Some(raw) = rest.strip_prefix("r#\"") {
            let end = raw.find("\"#").unwrap_or(raw.len());
            found.push((line, raw[..end].to_owned()));
            (end + 5).min(rest.len())
        } else if first == '"' {
            let mut escaped = false;
            let end = rest[1..].find(|c| {
                let ends = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                ends
            });
            let end = end.unwrap_or(rest.len() - 1);
            found.push((line, rest[1..=end].replace("\\\n", " ")));
            (end + 2).min(rest.len())
        } else {
            first.len_utf8()
        };
        line += rest[..taken].matches('\n').count();
        rest = &rest[taken..];
    }
    found.retain(|(_, words)| words.contains(' ') && words.chars().any(char::is_alphabetic));
    found
}

/// `VOROMILL_LIST_WORDS=FILE cargo test --test it words` writes every text into a file, to be gone
/// through with the glossary.
#[test]
fn what_people_read_speaks_the_language_of_the_trade() {
    let texts = texts();
    assert!(texts.len() > 1000, "they are found: {}", texts.len());
    assert!(
        texts.iter().any(|(_, words)| words.contains("no motion in it")),
        "the messages of the sources, too"
    );
    if let Some(file) = std::env::var_os("VOROMILL_LIST_WORDS") {
        let lines: String = texts.iter().map(|(place, words)| format!("{place}: {words}\n")).collect();
        fs::write(file, lines).expect("writable");
    }
    let mut found = Vec::new();
    for (place, text) in &texts {
        let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let is_in = |banned: &&&str| words.contains(**banned);
        found.extend(BANNED.iter().filter(is_in).map(|banned| format!("`{banned}` in {place}")));
    }
    assert_eq!(found, [""; 0], "words that the glossary has others for");
}

/// `VOROMILL_WRITE_DOCS=1 cargo test --test it words` writes it.
#[test]
fn the_page_of_options_is_todays() {
    let page = stdout(&voromill(&root(), &["explain", "--options"]));
    let path = root().join("docs/options.md");
    if std::env::var_os("VOROMILL_WRITE_DOCS").is_some() {
        fs::write(&path, &page).expect("writable");
    }
    assert!(fs::read_to_string(path).expect("the page") == page, "docs/options.md is of another day");
    for command in COMMANDS {
        for line in help(&[command, "--help-all"]).lines() {
            let Some(option) = line.trim_start().split([' ', '=']).find(|word| word.starts_with("--")) else {
                continue;
            };
            let is_option = line.trim_start().starts_with('-') && !line.starts_with("          ");
            let option = option.trim_end_matches([',', '[', '.']);
            assert!(
                !is_option
                    || ["--help", "--help-all", "--version"].contains(&option)
                    || page.contains(option),
                "{command} {option}"
            );
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
