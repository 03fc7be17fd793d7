//! The page: what it holds, and that a browser can read it. What it does in a browser is tested by
//! `tests/browser`.

use std::path::Path;

use voromill::import::{self, Selection};
use voromill::job::{self, Job, Options, Settings};
use voromill::report::Verdict;

/// The page of `fixtures/boards/<board>`, verified: its drawing as JSON, and as HTML.
fn page(board: &str) -> (serde_json::Value, String) {
    let (drawing, html, _) = page_with(board, "");
    (drawing, html)
}

/// The same with settings as they stand in a file, and the job.
fn page_with(board: &str, settings: &str) -> (serde_json::Value, String, Job) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(board);
    let loaded = import::load(&[folder], &Selection::default()).expect("a fixture can be read");
    let options = Options::from_toml("voromill.toml", settings).expect("sound options");
    let settings = Settings::resolve(options).expect("sound settings");
    let job = job::mill(loaded, &settings).expect("a fixture can be milled");
    let mut document = job.describe(&settings);
    document.verification = Some(Verdict::from(&job.verify(&settings).expect("its programs can be judged")));
    let page = job.page(&settings, &document).expect("its programs can be read back");
    let drawing = serde_json::to_value(&page.drawing).expect("JSON");
    let html = page.to_html();
    (drawing, html, job)
}

/// The letters of the motions that a program's drawing makes, and their lines. A letter that is as
/// the one before is left out.
fn motions(program: &serde_json::Value) -> Vec<(char, usize)> {
    let text = program["motions"].as_str().expect("text");
    let starts: Vec<usize> = text.match_indices(|c: char| c.is_ascii_lowercase()).map(|(at, _)| at).collect();
    let (mut line, mut lines, mut found) = (0, 0, Vec::new());
    for (n, &start) in starts.iter().enumerate() {
        let end = starts.get(n + 1).copied().unwrap_or(text.len());
        let numbers = text[start + 1..end].replace('-', " -");
        let numbers: Vec<i64> =
            numbers.split_whitespace().map(|number| number.parse().expect("a number")).collect();
        let letter = char::from(text.as_bytes()[start]);
        let takes = match letter {
            'n' => {
                lines = *numbers.last().expect("a number");
                continue;
            }
            's' => 3,
            'r' | 'f' => 2,
            'a' | 'c' => 4,
            _ => continue,
        };
        for _ in 0..numbers.len() / takes {
            line += lines;
            lines = 1;
            found.push((letter, usize::try_from(line).expect("a line")));
        }
    }
    found
}

/// Of several tiles the page shows the first, and of a program with several tools its lines lie
/// between those of the others.
#[test]
fn the_page_names_lines_of_the_whole_program() {
    let settings = "dialect = \"linuxcnc\"\ntile = \"2x1\"\nwidth = \"1mm\"\ntool = [\"endmill:0.8mm\", \"endmill:0.3mm\"]\n";
    let (drawing, _, job) = page_with("regulator", settings);
    let mut seen = 0;
    for (program, written) in drawing["programs"].as_array().expect("programs").iter().zip(&job.programs) {
        let lines: Vec<&str> = written.text.lines().collect();
        for (letter, line) in motions(program) {
            let expected = match letter {
                'r' | 's' => "G0",
                'f' => "G1",
                _ => "G",
            };
            let text = lines[line - 1];
            assert!(text.starts_with(expected), "{}: {letter} is {text} in line {line}", program["file"]);
            seen += usize::from(letter == 'f');
        }
    }
    assert!(seen > 1000, "{seen} lines are cut");
}

/// Of several tools the finest that it takes cuts where the gap is narrow.
#[test]
fn the_page_knows_the_kerfs_of_all_tools() {
    let tools = "tool = [\"endmill:0.8mm\", \"endmill:0.3mm\"]\n";
    let (drawing, ..) = page_with("regulator", tools);
    assert_eq!(drawing["sides"][0]["kerfs"], serde_json::json!([[800, 800], [300, 300]]));
    let (drawing, ..) = page_with("regulator", "depth = \"0.1mm\"\nadaptive-depth = \"0.05mm\"\n");
    let kerfs = drawing["sides"][0]["kerfs"][0].as_array().expect("two widths");
    assert!(kerfs[0].as_i64() < kerfs[1].as_i64(), "it may rise: {kerfs:?}");
}

#[test]
fn the_drawing_of_a_board_is_as_before() {
    let (drawing, _) = page("unsafe-gap");
    let text = serde_json::to_string_pretty(&drawing).expect("JSON");
    insta::with_settings!(
        { snapshot_path => Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots/report"), prepend_module_to_snapshot => false,
          omit_expression => true },
        { insta::assert_snapshot!("unsafe-gap-page", text) }
    );
}

#[test]
fn the_page_asks_nothing_of_the_network() {
    let (_, html) = page("unsafe-gap");
    for call in
        ["http:", "https:", " src=", "@import", "url(", "fetch(", "XMLHttpRequest", "WebSocket", "import("]
    {
        assert!(!html.contains(call), "`{call}` would ask for something");
    }
    assert!(html.contains("default-src 'none'"), "and the browser is told to allow nothing");
}

#[test]
fn every_tag_of_the_page_is_closed_in_turn() {
    let (_, html) = page("blinker");
    let mut open: Vec<String> = Vec::new();
    let mut rest = html.strip_prefix("<!doctype html>").expect("it says what it is");
    while let Some(at) = rest.find('<') {
        let (tag, after) = rest[at + 1..].split_once('>').expect("a tag ends");
        rest = after;
        let name: String =
            tag.trim_start_matches('/').chars().take_while(char::is_ascii_alphanumeric).collect();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name.clone()), "</{name}> closes what was opened last");
        } else if !["meta", "link", "input", "br"].contains(&name.as_str()) {
            open.push(name.clone());
        }
        if !tag.starts_with('/') && (name == "script" || name == "style") {
            // What is within is not markup, and ends at its end tag only.
            rest = &rest[rest.find(&format!("</{name}")).expect("it ends")..];
        }
    }
    assert!(open.is_empty(), "still open: {open:?}");
}

#[test]
fn text_from_files_stays_text() {
    let source = fixture_with_name("</script><b>&\"");
    assert!(!source.contains("</script><b>"), "a net's name ends no script");
}

/// The page of a copper file in which a net has this name.
fn fixture_with_name(name: &str) -> String {
    let gerber = format!(
        "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,1.0*%\nD10*\n%TO.N,{name}*%\nX0Y0D03*\n%TD*%\nX3000000Y0D03*\nM02*\n"
    );
    let folder = tempfile::TempDir::new().expect("a folder");
    let file = folder.path().join("named-F_Cu.gbr");
    std::fs::write(&file, gerber).expect("written");
    let loaded = import::load(&[file], &Selection::default()).expect("it can be read");
    let settings = Settings::resolve(Options::default()).expect("sound settings");
    let job = job::mill(loaded, &settings).expect("it can be milled");
    let document = job.describe(&settings);
    job.page(&settings, &document).expect("its programs can be read back").to_html()
}

#[test]
fn the_page_plays_every_line_that_moves() {
    let (drawing, _) = page("blinker");
    for program in drawing["programs"].as_array().expect("programs") {
        let motions = program["motions"].as_str().expect("text");
        let letters: Vec<char> = motions.chars().filter(char::is_ascii_lowercase).collect();
        let file = &program["file"];
        assert!(motions.starts_with('t'), "{file}: the first tool comes first: {motions:.40}");
        assert!(letters.contains(&'s') && letters.contains(&'r'), "{file} begins and moves");
        assert!(letters.contains(&'z'), "{file} goes down and up");
        assert_eq!(
            program["cutters"].as_array().map_or(0, Vec::len),
            program["tools"].as_array().map_or(1, Vec::len),
            "{file}: a cutter a tool"
        );
    }
}
