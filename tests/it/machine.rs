//! Machines: what their profiles change in programs, times and warnings, and how people come by
//! them.

use std::fs;

use tempfile::TempDir;

use crate::cli::{stderr, stdout, voromill};

fn folder() -> TempDir {
    TempDir::new().expect("a folder")
}

fn board() -> String {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    path.to_string_lossy().into_owned()
}

/// Mills the board in `folder` with further arguments: what is said, and the program that isolates.
fn milled(folder: &TempDir, arguments: &[&str]) -> (String, String, serde_json::Value) {
    let board = board();
    let mut all = vec!["mill", board.as_str(), "-o", "out", "--no-html", "--no-verify"];
    all.extend(arguments);
    let done = voromill(folder.path(), &all);
    assert!(done.status.success(), "{arguments:?}: {}", stderr(&done));
    let report = fs::read_to_string(folder.path().join("out/blinker.json")).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    let file = report["programs"][0]["file"].as_str().expect("a name").to_owned();
    let text = fs::read_to_string(folder.path().join("out").join(file)).expect("a program");
    (stdout(&done), text, report)
}

fn seconds(report: &serde_json::Value) -> f64 {
    report["programs"][0]["seconds"].as_f64().expect("seconds")
}

#[test]
fn a_machine_has_its_dialect_its_speeds_and_its_times() {
    let folder = folder();
    let (said, text, usual) = milled(&folder, &[]);
    assert!(text.contains("S12000") && !said.contains("beyond-the-machine"), "{said}");
    let (said, text, slow) = milled(&folder, &["--machine", "3018"]);
    assert!(text.contains("S10000"), "a default is what the machine can do");
    assert!(!said.contains("beyond-the-machine"), "and nothing to warn of: {said}");
    let (_, text, router) = milled(&folder, &["--machine", "LinuxCNC-Router"]);
    assert!(text.contains("G64 P"), "the router speaks LinuxCNC");
    let (_, text, _) = milled(&folder, &["--machine", "linuxcnc-router", "--dialect", "grbl"]);
    assert!(!text.contains("G64"), "unless told otherwise");
    assert!(seconds(&router) < seconds(&slow), "and is faster: {} and {}", seconds(&router), seconds(&slow));
    assert!((seconds(&usual) - seconds(&slow)).abs() < 0.2, "the 3018 is what is assumed of a machine");
}

#[test]
fn rapids_that_must_say_their_speed_say_that_of_the_machine() {
    let folder = folder();
    let rapids = |text: &str| -> Vec<String> {
        let fed = text.lines().filter(|line| line.starts_with("G0 "));
        let mut feeds: Vec<String> = fed
            .filter_map(|line| line.split(' ').find(|word| word.starts_with('F')))
            .map(str::to_owned)
            .collect();
        feeds.sort();
        feeds.dedup();
        feeds
    };
    let mine = "[machine]\nbase = \"3018\"\nrapid = \"2100mm/min,2400mm/min,450mm/min\"\n";
    fs::write(folder.path().join("mine.toml"), mine).expect("written");
    let (_, text, _) = milled(&folder, &["--dialect", "marlin"]);
    assert_eq!(rapids(&text), ["F1500", "F600"], "what is usual, where nobody says more");
    let (_, text, _) = milled(&folder, &["--machine", "mine.toml", "--dialect", "marlin"]);
    assert_eq!(rapids(&text), ["F2100", "F450"], "the slower of x and y, and z");
    let (_, text, _) = milled(&folder, &["--machine", "mine.toml", "--dialect", "smoothieware"]);
    assert_eq!(rapids(&text), ["F2100"], "the first rapid speaks for all");
    let (_, text, _) = milled(&folder, &["--machine", "mine.toml", "--dialect", "grbl"]);
    assert_eq!(rapids(&text), [""; 0], "Grbl knows");
}

#[test]
fn several_tools_in_one_file_are_refused_with_what_helps() {
    let folder = folder();
    let board = board();
    for (dialect, option) in [
        ("grbl", "--tool-change pause waits at M0"),
        ("linuxcnc", "--tool-change m6"),
        ("tinyg", "use one --tool"),
    ] {
        let arguments = ["isolate", &board, "--side", "back", "-o", "x.ngc", "--dialect", dialect];
        let tools = ["--tool", "endmill:0.8mm", "--tool", "endmill:0.2mm", "--tool-change", "files"];
        let done = voromill(folder.path(), &[&arguments[..], &tools].concat());
        assert!(!done.status.success() && stderr(&done).contains(option), "{dialect}: {}", stderr(&done));
    }
}

#[test]
fn what_a_machine_cannot_do_is_lowered_and_said() {
    let folder = folder();
    let arguments =
        ["--machine", "3018", "--feed", "2500mm/min", "--plunge", "900mm/min", "--spindle", "24000"];
    let (said, text, _) = milled(&folder, &arguments);
    for (asked, given, word) in [
        ("2500mm/min", "1500mm/min", "F1500"),
        ("900mm/min", "600mm/min", "F600"),
        ("24000 rpm", "10000 rpm", "S10000"),
    ] {
        assert!(said.contains(asked) && said.contains(given), "{asked}: {said}");
        assert!(text.lines().any(|line| line.ends_with(word)), "{word}");
    }
    assert!(said.contains("[beyond-the-machine-speed]"), "with a name: {said}");
    assert!(
        !text.contains("F2500") && !text.contains("F900") && !text.contains("S24000"),
        "nothing beyond it"
    );
}

#[test]
fn the_time_for_tool_changes_is_a_line_of_its_own() {
    let folder = folder();
    fs::write(
        folder.path().join("mine.toml"),
        "[machine]\nbase = \"3018\"\ntool-change-time = \"120s\"\ntravel = \"20mm,20mm,20mm\"\n",
    )
    .expect("written");
    let (said, _, report) = milled(&folder, &["--machine", "mine.toml"]);
    let count = report["tool_changes"]["count"].as_f64().expect("a count");
    let changes = report["tool_changes"]["seconds"].as_f64().expect("seconds");
    assert!(count >= 2.0 && (changes - 120.0 * count).abs() < 1e-9, "{count} changes in {changes} s");
    let line = said.lines().find(|line| line.contains("tool changes")).expect("a line");
    assert!(line.trim_start().starts_with(&format!("{count} tool changes")), "{line}");
    let programs = report["programs"].as_array().expect("programs").iter();
    let running: f64 = programs.map(|program| program["seconds"].as_f64().expect("seconds")).sum();
    let total = report["total"]["seconds"].as_f64().expect("seconds");
    assert!((running + changes - total).abs() < 1.0, "{running} and {changes} are {total}");
    assert!(said.contains("[beyond-the-machine]"), "its travel is held against the programs: {said}");
}

#[test]
fn a_settings_file_holds_a_machine_by_name_or_as_a_table() {
    let folder = folder();
    for text in ["machine = \"3018\"", "machine = 3018", "[machine]\nspindle-max = 10000\n"] {
        fs::write(folder.path().join("settings.toml"), text).expect("written");
        let (_, program, _) = milled(&folder, &["--config", "settings.toml"]);
        assert!(program.contains("S10000"), "{text}");
    }
    fs::write(folder.path().join("settings.toml"), "[machine]\ntravle = \"1mm,1mm,1mm\"\n").expect("written");
    let done = voromill(folder.path(), &["mill", &board(), "-o", "x", "--config", "settings.toml"]);
    let error = stderr(&done);
    assert_eq!(done.status.code(), Some(2), "{error}");
    assert!(error.contains("settings.toml:") && error.contains("did you mean `travel`"), "{error}");
}

#[test]
fn a_machine_that_nobody_knows_is_refused_with_those_that_are_known() {
    let folder = folder();
    for (machine, expected) in [("3019", "3018, shapeoko"), ("none.toml", "none.toml")] {
        let done = voromill(folder.path(), &["mill", &board(), "-o", "x", "--machine", machine]);
        assert_eq!(done.status.code(), Some(2), "{machine}");
        assert!(stderr(&done).contains(expected), "{}", stderr(&done));
    }
    let done = voromill(folder.path(), &["machine", "show", "nothing"]);
    assert_eq!(done.status.code(), Some(2), "{}", stderr(&done));
}

#[test]
fn what_a_controller_says_becomes_a_machine_to_mill_with() {
    let folder = folder();
    let dump = "$11=0.010\n$30=8000\n$31=0\n$110=800.000\n$111=800.000\n$112=300.000\n$120=20.000\n$121=20.000\n$122=10.000\n$130=280.000\n$131=170.000\n$132=40.000\nok\n";
    fs::write(folder.path().join("dump.txt"), dump).expect("written");
    let done = voromill(folder.path(), &["machine", "import", "dump.txt"]);
    assert!(done.status.success(), "{}", stderr(&done));
    fs::write(folder.path().join("mine.toml"), stdout(&done)).expect("written");
    let (_, text, slow) = milled(&folder, &["--machine", "mine.toml"]);
    assert!(text.contains("S8000"), "its spindle");
    let (_, _, usual) = milled(&folder, &["--machine", "3018"]);
    assert!(seconds(&slow) > seconds(&usual), "{} and {}", seconds(&slow), seconds(&usual));
    fs::write(folder.path().join("dump.txt"), dump.replace("$121=20.000", "$121=-3")).expect("written");
    let done = voromill(folder.path(), &["machine", "import", "dump.txt"]);
    let error = stderr(&done);
    assert_eq!(done.status.code(), Some(2), "{error}");
    assert!(error.contains("dump.txt: line 8: `-3` is not a value for $121"), "{error}");
}

#[test]
fn every_machine_of_the_list_can_be_shown_and_taken() {
    let folder = folder();
    let listed = stdout(&voromill(folder.path(), &["machine", "list"]));
    for (name, text) in voromill::job::READY {
        assert!(listed.contains(&format!("{name}: ")), "{listed}");
        assert_eq!(stdout(&voromill(folder.path(), &["machine", "show", name])), *text, "{name}");
    }
    assert!(listed.contains("typical figures"), "how far to believe them: {listed}");
}
