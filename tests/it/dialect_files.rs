//! Dialects of one's own, a file for each tool, and gaps that must not be too narrow, as the
//! command line has them.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::cli::{stderr, stdout, voromill};

fn board(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(name).to_string_lossy().into_owned()
}

fn listing(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_dialect_in_a_file_writes_as_it_says_with_a_file_for_each_tool() {
    let folder = TempDir::new().expect("a folder");
    let text = "name = 'mine'\nbase = 'linuxcnc'\nextension = 'nc'\ndecimals = 3\ntool-change = 'files'\nline-numbers = 'by-tens'\nstart = ['G17 G21 G90', 'M8']\n";
    fs::write(folder.path().join("mine.toml"), text).expect("written");
    let done = voromill(
        folder.path(),
        &[
            "mill",
            &board("regulator"),
            "-o",
            "out",
            "--dialect",
            "mine.toml",
            "--no-html",
            "--tool",
            "endmill:0.5mm,endmill:0.1mm",
        ],
    );
    assert!(done.status.success(), "{}", stderr(&done));
    let names = listing(&folder.path().join("out"));
    let drills =
        ["0.6mm", "0.8mm", "1.0mm", "1.3mm", "3.2mm"].map(|drill| format!("regulator-drill-{drill}.nc"));
    assert!(drills.iter().all(|drill| names.contains(drill)), "a file for each drill: {names:?}");
    assert!(
        names.contains(&"regulator-front-endmill-0.5mm.nc".to_owned())
            && names.contains(&"regulator-front-endmill-0.1mm.nc".to_owned()),
        "{names:?}"
    );
    for name in names.iter().filter(|name| name.ends_with(".nc")) {
        let program = fs::read_to_string(folder.path().join("out").join(name)).expect("written");
        assert!(program.contains("N20 M8\n") && program.contains("(dialect mine)"), "{name}");
        assert!(!program.contains("M6") && !program.contains("M0\n"), "{name}: nothing is changed within it");
        assert_eq!(program.matches("M3 S").count(), 1, "{name}: one tool");
    }
    let one = voromill(
        folder.path(),
        &[
            "isolate",
            &board("regulator"),
            "--side",
            "front",
            "-o",
            "x.nc",
            "--dialect",
            "mine.toml",
            "--tool",
            "endmill:0.5mm,endmill:0.1mm",
        ],
    );
    assert_eq!(one.status.code(), Some(2), "two tools do not go into one file");
}

#[test]
fn a_dialect_that_is_none_says_why() {
    let folder = TempDir::new().expect("a folder");
    fs::write(folder.path().join("bad.toml"), "name = 'bad'\nbase = 'grbl'\narcs = 'round'\n")
        .expect("written");
    for (dialect, reason) in [
        ("bad.toml", "bad.toml: the dialect cannot be read"),
        ("none.toml", "cannot read the dialect none.toml"),
        ("gerbil", "or a file such as mine.toml"),
    ] {
        let done = voromill(folder.path(), &["mill", &board("blinker"), "-o", "out", "--dialect", dialect]);
        assert_eq!(done.status.code(), Some(2), "{dialect}");
        assert!(stderr(&done).contains(reason), "{dialect}: {}", stderr(&done));
    }
}

#[test]
fn programs_have_the_names_and_tool_changes_that_are_asked_for() {
    let folder = TempDir::new().expect("a folder");
    let mill = |more: &[&str]| {
        let done = voromill(
            folder.path(),
            &[&["mill", &board("regulator"), "-o", "out", "--no-html", "--no-verify"], more].concat(),
        );
        (done.status.code(), stderr(&done), stdout(&done))
    };
    let names = ["--output-name", "front=top side.nc", "--output-name", "drill=holes.nc"];
    let (code, message, summary) = mill(&names);
    assert_eq!(code, Some(0), "{message}");
    assert!(folder.path().join("out/top side.nc").exists(), "{summary}");
    assert!(summary.contains("holes-0.8mm.nc"), "a file for each drill, and in the summary:\n{summary}");
    let (code, message, summary) = mill(&[&names[..], &["--tool-change", "pause"]].concat());
    assert_eq!(code, Some(0), "{message}");
    assert!(summary.contains("holes.nc"), "one for all where they are held at one length:\n{summary}");
    let (code, message, _) = mill(&["--tool-change", "m6"]);
    assert_eq!(code, Some(2), "error 20 on the machine");
    assert!(message.contains("tool-change: grbl does not wait at M6"), "{message}");
    let (code, message, _) = mill(&["--output-name", "cutout=regulator.json"]);
    assert_eq!(code, Some(2), "the report has that name");
    assert!(message.contains("two outputs would be out/regulator.json"), "{message}");
    let (_, _, summary) = mill(&["--blend", "0.01mm"]);
    assert!(summary.contains("grbl has no path blending"), "{summary}");
}

#[test]
fn axes_and_passes_beside_copper_do_not_go_together() {
    let folder = TempDir::new().expect("a folder");
    let done = voromill(
        folder.path(),
        &["mill", &board("blinker"), "-o", "out", "--sites", "core", "--passes", "2"],
    );
    assert_eq!(done.status.code(), Some(2), "copper would be cut");
    assert!(
        stderr(&done).contains("sites: with core, --passes would keep its distance from the axes"),
        "{}",
        stderr(&done)
    );
}

#[test]
fn a_gap_too_narrow_is_an_error_where_that_is_asked_for() {
    let folder = TempDir::new().expect("a folder");
    let mill = |more: &[&str]| {
        let done = voromill(
            folder.path(),
            &[&["mill", &board("qfn-breakout"), "-o", "out", "--no-html", "--no-verify"], more].concat(),
        );
        (done.status.code(), stderr(&done))
    };
    let (code, message) = mill(&["--tool", "endmill:0.8mm", "--narrow", "error"]);
    assert_eq!(code, Some(2), "it does not fit");
    assert!(
        message.contains("less than its kerf of 800.0 µm at x = ") && message.contains("hint: "),
        "{message}"
    );
    assert!(!folder.path().join("out").exists(), "nothing is made");
    assert_eq!(mill(&["--tool", "endmill:0.05mm", "--narrow", "error"]).0, Some(0), "it fits");
}

#[test]
fn a_board_can_be_moved_and_the_machine_waits_as_high_as_said() {
    let folder = TempDir::new().expect("a folder");
    let mill = |out: &str, more: &[&str]| {
        let done =
            voromill(folder.path(), &[&["mill", &board("regulator"), "-o", out, "--no-html"], more].concat());
        assert!(done.status.success(), "verified where it lies: {}", stderr(&done));
        fs::read_to_string(folder.path().join(out).join("regulator-drill.ngc")).expect("written")
    };
    let (here, there) = (
        mill("a", &["--tool-change", "pause"]),
        mill(
            "b",
            &[
                "--offset",
                "10mm,-5mm",
                "--tool-change-at",
                "25mm",
                "--tool-change",
                "pause",
                "--drill-plunge",
                "33mm/min",
                "--drill-spindle",
                "7777",
            ],
        ),
    );
    let first = |text: &str| text.lines().find(|line| line.starts_with("G0 X")).expect("a hole").to_owned();
    assert_ne!(first(&here), first(&there), "moved");
    assert!(there.contains("G0 Z25\n") && there.contains("F33") && there.contains("M3 S7777"), "{there}");
    let judged = voromill(
        folder.path(),
        &[
            "verify",
            "b/regulator-front.ngc",
            "b/regulator-back.ngc",
            "b/regulator-drill.ngc",
            "--board",
            &board("regulator"),
        ],
    );
    assert!(judged.status.success(), "its comments say where it lies: {}", stderr(&judged));
}
