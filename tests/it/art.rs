//! What the tests of `carve` and `pocket` have in common: programs that are spoilt, and both
//! commands as a person runs them.

use std::path::Path;
use std::process::Output;

use crate::cli::{stderr, stdout};

/// Changes every line of a program that `change` does not leave as it is, told how many cuts there
/// are up to it; what becomes nothing is left out.
pub(crate) fn lines(text: &str, mut change: impl FnMut(&str, usize) -> Option<String>) -> String {
    let mut cut = 0;
    let line = |line: &str| {
        cut += usize::from(is_cut(line));
        change(line, cut).map(|line| line + "\n").unwrap_or_default()
    };
    text.lines().map(line).collect()
}

/// Whether a line cuts sideways.
pub(crate) fn is_cut(line: &str) -> bool {
    ["G1 X", "G1 Y", "G2 ", "G3 "].iter().any(|start| line.starts_with(start))
}

/// The number after a letter of a line, changed.
pub(crate) fn word(line: &str, letter: char, change: impl Fn(f64) -> f64) -> String {
    let code = !line.starts_with('(') && !line.starts_with(';');
    let Some(at) = line.find(letter).filter(|_| code) else { return line.to_owned() };
    let rest = &line[at + 1..];
    let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-')).unwrap_or(rest.len());
    let Ok(number) = rest[..end].parse::<f64>() else { return line.to_owned() };
    format!("{}{letter}{:.4}{}", &line[..at], change(number), &rest[end..])
}

/// Runs the program where the fixtures are.
pub(crate) fn voromill(arguments: &[&str]) -> Output {
    crate::cli::voromill(Path::new(env!("CARGO_MANIFEST_DIR")), arguments)
}

/// Runs `wanted` into a program and a picture, and says `told`; `--check` finds nothing in the
/// program, and what `spoiling` (from, to) does to it as `code`.
pub(crate) fn is_made_checked_and_found_spoilt(
    wanted: &[&str],
    folder: &Path,
    told: &[&str],
    spoiling: [&str; 2],
    code: &str,
) {
    let path = |name: &str| folder.join(name).display().to_string();
    let (program, picture) = (path("made.ngc"), path("made.png"));
    let made = voromill(&[wanted, &["-o", &program, "--picture", &picture]].concat());
    assert!(made.status.success(), "{}{}", stdout(&made), stderr(&made));
    for words in told {
        assert!(stdout(&made).contains(words), "`{words}` is said: {}", stdout(&made));
    }
    assert_eq!(std::fs::read(&picture).expect("a picture")[1..4], *b"PNG", "what it looks like");
    let checked = voromill(&[wanted, &["--check", &program]].concat());
    assert_eq!(checked.status.code(), Some(0), "{}", stdout(&checked));
    let text = std::fs::read_to_string(&program).expect("a program");
    std::fs::write(&program, text.replace(spoiling[0], spoiling[1])).expect("spoilt");
    let checked = voromill(&[wanted, &["--check", &program, "--format", "json"]].concat());
    assert_eq!(checked.status.code(), Some(1), "{}", stdout(&checked));
    let report: serde_json::Value = serde_json::from_str(&stdout(&checked)).expect("JSON");
    let findings = report["verification"]["findings"].as_array().expect("a list");
    assert!(findings.iter().any(|finding| finding["code"] == code), "{code}: {report}");
}

/// Refuses each of these arguments, with words of the reason.
pub(crate) fn is_refused(command: &str, cases: &[(&[&str], &str)]) {
    let layer = "fixtures/gerber/clear_polarity.gbr";
    for (arguments, expected) in cases {
        let refused = voromill(&[&[command, layer, "-o", "-"], *arguments].concat());
        let said = stderr(&refused);
        assert!(refused.status.code() == Some(2) && said.contains(expected), "{arguments:?}: {said}");
    }
}

/// The touch of a tool on its plate is no cut; and what layers of a drawing are is no matter where
/// all that is drawn is milled.
#[test]
fn a_tool_may_touch_its_plate_before_it_cuts() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = folder.path().join("made.ngc").display().to_string();
    for (command, tool) in [("carve", "vbit:0.1mm:60deg"), ("pocket", "endmill:0.5mm")] {
        let plate = ["--tool-probe", "50mm,0mm,0.5mm", "--tool", tool, "-o", &program];
        let made = voromill(&[&[command, "fixtures/drawings/strokes.svg"][..], &plate].concat());
        assert!(made.status.success(), "{}{}", stdout(&made), stderr(&made));
        assert_eq!(stderr(&made), "", "{command}: nothing is said against it");
        let text = std::fs::read_to_string(&program).expect("a program");
        assert!(text.contains("G38.2"), "{command}: it touches");
    }
}

#[test]
fn the_tool_parks_where_it_was_asked_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let program = folder.path().join("made.ngc").display().to_string();
    for (command, tool) in [("carve", "vbit:0.1mm:60deg"), ("pocket", "endmill:0.5mm")] {
        for (park, ends) in [("30mm", "G0 Z30\nM5\nM2\n"), ("1mm,2mm,40mm", "G0 Z40\nG0 X1 Y2\nM5\nM2\n")] {
            let parks = ["--park", park, "--tool", tool, "-o", &program];
            let made = voromill(&[&[command, "fixtures/drawings/strokes.svg"][..], &parks].concat());
            assert!(made.status.success(), "{}{}", stdout(&made), stderr(&made));
            let text = std::fs::read_to_string(&program).expect("a program");
            assert!(text.ends_with(ends), "{command} {park}: {}", &text[text.len() - 60..]);
        }
    }
}

/// A text in a font, set by the drawing's own words or by those of the command line.
#[test]
fn texts_are_set_in_the_font_that_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let drawing = "<svg xmlns='http://www.w3.org/2000/svg' width='60mm' height='20mm' viewBox='0 0 60 20'>\
        <text x='2' y='14' font-family='X' font-size='10'>Il</text></svg>";
    std::fs::write(path("t.svg"), drawing).expect("a drawing");
    std::fs::write(path("font.ttf"), dejavu::sans::bold()).expect("a font");
    let (drawing, font, program) = (path("t.svg"), path("font.ttf"), path("made.ngc"));
    for (command, tool) in [("carve", "vbit:0.1mm:60deg"), ("pocket", "endmill:0.5mm")] {
        let made = voromill(&[command, &drawing, "--font", &font, "--tool", tool, "-o", &program]);
        assert!(made.status.success(), "{}{}", stdout(&made), stderr(&made));
        assert_eq!(stderr(&made), "", "{command}: nothing is left out");
        let bare = voromill(&[command, &drawing, "--tool", tool, "-o", &program]);
        assert_eq!(bare.status.code(), Some(2), "{command}: without a font there is nothing");
        let lines = ["--text", "Il\\nIl", "--font", &font, "--tool", tool, "-o", &program];
        let made = voromill(&[&[command][..], &lines].concat());
        assert!(made.status.success(), "{}{}", stdout(&made), stderr(&made));
        assert!(stdout(&made).starts_with("IlIl"), "{command}: {}", stdout(&made));
    }
}

#[test]
fn what_is_said_of_pictures_helps() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let picture = image::GrayImage::from_fn(60, 60, |x, y| {
        let is_ink = (10..40).contains(&x) && (10..40).contains(&y) || (x, y) == (50, 50);
        image::Luma([if is_ink { 0 } else { 255 }])
    });
    picture.save(path("logo.png")).expect("a picture");
    let (logo, program) = (path("logo.png"), path("made.ngc"));
    let wide = ["pocket", &logo, "--picture-width", "12mm", "--tool", "endmill:1mm", "-o", &program];
    let told = stderr(&voromill(&wide));
    assert!(told.contains("--copper dark") && told.contains("--despeckle 0.05"), "{told}");
    let made = voromill(&[&wide[..], &["--copper", "dark", "--despeckle", "0.05"]].concat());
    assert!(made.status.success(), "{}{}", stdout(&made), stderr(&made));
    assert_eq!(stderr(&made), "", "as it was advised");
}

#[test]
fn options_that_change_nothing_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    image::GrayImage::new(9, 9).save(path("p.png")).expect("a picture");
    std::fs::write(path("font.ttf"), dejavu::sans::bold()).expect("a font");
    let (picture, font) = (path("p.png"), path("font.ttf"));
    let (drawing, layer) = ("fixtures/drawings/strokes.svg", "fixtures/gerber/clear_polarity.gbr");
    let text = ["--text", "A", "--font", &font];
    let cases: [(&[&str], &[&str], &str); 9] = [
        (&[drawing], &["--ink", "dark"], "--ink has no effect on a drawing"),
        (&[drawing], &["--picture-width", "9mm"], "--picture-width has no effect on a drawing"),
        (&[drawing], &["--margin", "9mm"], "--margin has no effect without"),
        (&[drawing], &["--height", "9mm"], "--text <TEXT>"),
        (&[&picture], &["--unit", "mm"], "--unit has no effect on a picture"),
        (&[&picture], &["--font", &font], "--font has no effect on a picture"),
        (&[layer], &["--crop", "0,0,1,1"], "--crop has no effect on a file of a board"),
        (&text, &["--unit", "mm"], "--unit has no effect with --text"),
        (&text, &["--picture-dpi", "600"], "--picture-dpi has no effect with --text"),
    ];
    for (what, options, expected) in cases {
        for (command, tool) in [("carve", "vbit:0.1mm:60deg"), ("pocket", "endmill:0.5mm")] {
            let refused = voromill(&[&[command], what, options, &["--tool", tool, "-o", "-"]].concat());
            let said = stderr(&refused);
            assert!(
                refused.status.code() == Some(2) && said.contains(expected),
                "{command} {options:?}: {said}"
            );
        }
    }
}
