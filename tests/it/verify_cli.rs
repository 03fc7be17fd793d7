//! Judging and comparing on the command line: what is printed, and the exit code.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use tempfile::TempDir;

use crate::cli::{stderr, stdout, voromill};

fn fixture(name: &str) -> String {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/verify").join(name);
    path.to_string_lossy().into_owned()
}

fn verify(program: &str, more: &[&str]) -> Output {
    let (program, board) = (fixture(program), fixture("pads-F_Cu.gbr"));
    let fixed = ["verify", &program, "--board", &board, "--tool", "endmill:0.2mm", "--side", "front"];
    voromill(Path::new("."), &[&fixed, more].concat())
}

#[test]
fn the_exit_code_of_verify_says_what_was_found() {
    let clean = verify("loops.nc", &[]);
    assert_eq!(clean.status.code(), Some(0), "nothing: {}", stderr(&clean));
    assert!(stdout(&clean).contains("nothing found, pixels of 25 µm"), "and how finely: {}", stdout(&clean));
    let short = verify("arcs.nc", &[]);
    assert_eq!(short.status.code(), Some(1), "a short: {}", stdout(&short));
    assert!(stdout(&short).contains("[short]"), "by name: {}", stdout(&short));
    // It spans 5.3 mm by 2.3 mm, and 2.1 mm up and down.
    let narrow = verify("loops.nc", &["--travel", "5mm,100mm,100mm"]);
    assert_eq!(narrow.status.code(), Some(1), "a machine too small: {}", stdout(&narrow));
    assert!(stdout(&narrow).contains("[overtravel]"), "by name: {}", stdout(&narrow));
    for wrong in [&["--side", "back"][..], &["--mirror", "1"], &["--travel", "1mm"], &["--deny", "bad"]] {
        let refused = voromill(
            Path::new("."),
            &[&["verify", &fixture("loops.nc"), "--board", &fixture("pads-F_Cu.gbr")], wrong].concat(),
        );
        assert_eq!(refused.status.code(), Some(2), "{wrong:?}: {}", stdout(&refused));
        assert!(!stderr(&refused).is_empty(), "{wrong:?} says why");
    }
}

/// What sends or keeps programs puts lines of its own above.
#[test]
fn the_title_need_not_be_the_first_line() {
    let folder = TempDir::new().expect("a folder");
    let text = fs::read_to_string(fixture("loops.nc")).expect("a program");
    let path = folder.path().join("front.nc").to_string_lossy().into_owned();
    let board = fixture("pads-F_Cu.gbr");
    for above in ["", "%\n", "\n(saved by a sender)\nG21\n"] {
        fs::write(&path, format!("{above}(pads front isolation)\n{text}")).expect("written");
        let done = voromill(Path::new("."), &["verify", &path, "--board", &board, "--tool", "endmill:0.2mm"]);
        assert_eq!(done.status.code(), Some(0), "`{above}`: {}{}", stdout(&done), stderr(&done));
    }
}

/// A levelled program follows a surface that nobody knows here: what it was made of is judged.
#[test]
fn of_a_levelled_program_its_origin_is_judged() {
    let folder = TempDir::new().expect("a folder");
    let text = format!("(loops)\n{}", fs::read_to_string(fixture("loops.nc")).expect("a program"));
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("written");
        path.to_string_lossy().into_owned()
    };
    let judge = |programs: &[&str]| {
        let board = fixture("pads-F_Cu.gbr");
        let fixed = ["--board", &board, "--tool", "endmill:0.2mm", "--side", "front"];
        let done = voromill(Path::new("."), &[&["verify"], programs, &fixed].concat());
        (done.status.code(), stdout(&done))
    };
    let shallow = text.replace("Z-0.1", "Z-0.01");
    let (good, bad) = (write("good.nc", &text), write("bad.nc", &shallow));
    let level = |name: &str, text: &str| write(name, &format!("(levelled by voromill 0.1.0)\n{text}"));
    let (deep, high) = (level("deep.nc", &text), level("high.nc", &shallow));
    assert_eq!(judge(&[&good, &high]).0, Some(0), "along a surface that lies lower it is as deep");
    let (code, told) = judge(&[&bad, &deep]);
    assert_eq!((code, told.contains("[short]")), (Some(1), true), "what one lacks the other has not: {told}");
    assert_eq!(judge(&[&high]).0, Some(1), "alone it is judged as along a flat one");
    let (code, told) = judge(&[&good, &level("old.nc", &text.replace("(loops)", "(other loops)"))]);
    assert_eq!((code, told.contains("[revision]")), (Some(0), true), "of another program: {told}");
    let corner = text.lines().rfind(|line| line.starts_with("G01 X6.1500 Y3.1500")).expect("a corner");
    let (code, told) = judge(&[&good, &level("part.nc", &text.replace(corner, ""))]);
    assert_eq!((code, told.contains("it mills 17.1 mm where")), (Some(0), true), "a part of it: {told}");
}

#[test]
fn a_program_says_how_thick_its_board_is_and_a_person_knows_better() {
    let folder = TempDir::new().expect("a folder");
    let text = fs::read_to_string(fixture("loops.nc")).expect("a program");
    let write = |name: &str, thickness: &str| {
        let path = folder.path().join(name);
        fs::write(&path, format!("(thickness {thickness})\n{text}")).expect("written");
        path.to_string_lossy().into_owned()
    };
    let (thin, thick) = (write("thin.nc", "0.1mm"), write("thick.nc", "1.6mm"));
    let judge = |programs: &[&str], more: &[&str]| {
        let board = fixture("pads-F_Cu.gbr");
        let fixed = ["--board", &board, "--tool", "endmill:0.2mm", "--side", "front"];
        voromill(Path::new("."), &[&["verify"], programs, &fixed, more].concat())
    };
    let through = judge(&[&thin], &[]);
    assert!(stdout(&through).contains("[too-deep]"), "more than half the board: {}", stdout(&through));
    assert_eq!(judge(&[&thick], &[]).status.code(), Some(0), "less than that");
    assert_eq!(judge(&[&thin], &["--thickness", "1.6mm"]).status.code(), Some(0), "the person's word counts");
    let both = judge(&[&thin, &thick], &[]);
    assert_eq!(both.status.code(), Some(2), "{}", stdout(&both));
    assert!(stderr(&both).contains("0.100 mm") && stderr(&both).contains("--thickness"), "{}", stderr(&both));
    assert_eq!(judge(&[&thin], &["--thickness", "0mm"]).status.code(), Some(2), "no board is so thin");
}

#[test]
fn in_a_folder_the_programs_that_nobody_wrote_are_missed() {
    let folder = TempDir::new().expect("a folder");
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    let board = board.to_string_lossy();
    let done = voromill(
        folder.path(),
        &["mill", &board, "-o", "out", "--no-verify", "--alignment-holes", "3mm", "--dialect", "linuxcnc"],
    );
    assert!(done.status.success(), "{}", stderr(&done));
    let judge = || voromill(folder.path(), &["verify", "out", "--board", &board]);
    assert_eq!(judge().status.code(), Some(0), "all are there: {}", stdout(&judge()));
    for (part, said) in
        [("drill", "no program drills"), ("cutout", "no program cuts it out"), ("back", "on the back")]
    {
        let (file, aside) = (format!("out/blinker-{part}.ngc"), format!("{part}.aside"));
        let [file, aside] = [file, aside].map(|name| folder.path().join(name));
        fs::rename(&file, &aside).expect("moved away");
        let without = judge();
        assert_eq!(without.status.code(), Some(1), "without {part}: {}", stdout(&without));
        assert!(stdout(&without).contains(said), "{part}: {}", stdout(&without));
        assert!(stdout(&without).contains("[program-missing]"), "{part}: {}", stdout(&without));
        fs::rename(&aside, &file).expect("moved back");
    }
    let one = voromill(folder.path(), &["verify", "out/blinker-back.ngc", "--board", &board]);
    assert_eq!(one.status.code(), Some(0), "one was chosen: {}", stdout(&one));
    fs::create_dir(folder.path().join("empty")).expect("a folder");
    let empty = voromill(folder.path(), &["verify", "empty", "--board", &board]);
    assert_eq!(empty.status.code(), Some(2), "none: {}", stdout(&empty));
}

#[test]
fn every_form_is_printed() {
    let json = stdout(&verify("arcs.nc", &["--format", "json"]));
    let verdict: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(verdict["findings"][0]["code"], "short", "the finding: {json}");
    let sarif = stdout(&verify("arcs.nc", &["--format", "sarif"]));
    let log: serde_json::Value = serde_json::from_str(&sarif).expect("JSON");
    assert_eq!(log["version"], "2.1.0", "SARIF: {sarif}");
    let uri = |log: &serde_json::Value| {
        let place = &log["runs"][0]["results"][0]["locations"][0]["physicalLocation"];
        place["artifactLocation"]["uri"].as_str().unwrap_or_default().to_owned()
    };
    assert!(uri(&log).starts_with("file:///"), "where the program is: {sarif}");
    // No line of a program drills the second hole.
    let folder = TempDir::new().expect("a folder");
    let text = fs::read_to_string(fixture("cycle.nc")).expect("a program");
    fs::create_dir(folder.path().join("out")).expect("writable");
    fs::write(folder.path().join("out/one.nc"), text.replace("X5\n", "")).expect("writable");
    let (copper, holes) = (fixture("pads-F_Cu.gbr"), fixture("pads.drl"));
    let board = ["--board", &copper, &holes, "--tool", "drill:0.8mm", "--format", "sarif"];
    let missing = voromill(folder.path(), &[&["verify", "out/one.nc"], &board[..]].concat());
    let log: serde_json::Value = serde_json::from_str(&stdout(&missing)).expect("JSON");
    assert_eq!(log["runs"][0]["results"][0]["ruleId"], "hole-missing", "{}", stdout(&missing));
    assert_eq!(uri(&log), "out/one.nc", "code hosts leave out what has no place");
    assert!(stdout(&verify("arcs.nc", &["--format", "junit"])).starts_with("<?xml"), "JUnit");
}

#[test]
fn a_text_that_steers_terminals_is_shown_as_a_text() {
    let folder = TempDir::new().expect("a folder");
    let program = folder.path().join("steers.nc");
    fs::write(&program, "G90 G21\n\u{1b}[31mX1\n").expect("writable");
    let board = ["--board", &fixture("pads-F_Cu.gbr"), "--tool", "endmill:0.2mm", "--side", "front"];
    let refused = voromill(folder.path(), &[&["verify", "steers.nc"], &board[..]].concat());
    assert_eq!(refused.status.code(), Some(2), "no program");
    assert!(stderr(&refused).contains("`\\u{1b}[31mX1`"), "escaped: {:?}", stderr(&refused));
    assert!(!stderr(&refused).contains('\u{1b}'), "and nothing else: {:?}", stderr(&refused));
}

#[test]
fn mill_judges_what_it_writes() {
    let out = TempDir::new().expect("a temporary folder");
    let (copper, edge) = (fixture("seven-F_Cu.gbr"), fixture("seven-Edge_Cuts.gbr"));
    let mill = |more: &[&str]| {
        let fixed = ["mill", &copper, &edge, "-o", "out", "--tool", "endmill:0.4mm", "--json"];
        voromill(out.path(), &[&fixed, more].concat())
    };
    // The narrowest gaps are 0.3 mm wide: the kerf must take copper, which is a warning.
    let narrow = mill(&[]);
    assert_eq!(narrow.status.code(), Some(0), "a warning does not fail: {}", stderr(&narrow));
    let report: serde_json::Value = serde_json::from_str(&stdout(&narrow)).expect("JSON");
    assert_eq!(report["verification"]["errors"], 0, "{}", report["verification"]);
    assert_eq!(report["verification"]["findings"][0]["code"], "gouge", "{}", report["verification"]);
    assert_eq!(mill(&["--deny", "warning"]).status.code(), Some(1), "unless it is asked to");
    assert!(out.path().join("out").is_dir(), "and the programs are there to be looked at");
    let unjudged = mill(&["--no-verify", "--deny", "warning"]);
    assert_eq!(unjudged.status.code(), Some(0), "unjudged: {}", stderr(&unjudged));
    assert!(!stdout(&unjudged).contains("verification"), "no verdict");
}

#[test]
fn where_a_program_lies_is_found_and_said() {
    let found = verify("pcb2gcode.nc", &["--register"]);
    assert_eq!(found.status.code(), Some(0), "{}{}", stdout(&found), stderr(&found));
    assert!(stderr(&found).contains("placed as with --offset "), "{}", stderr(&found));
    let lost = verify("pcb2gcode.nc", &[]);
    assert_eq!(lost.status.code(), Some(1), "as it is, it lies beside the board: {}", stdout(&lost));
}

#[test]
fn diff_shows_what_copper_changes() {
    let out = TempDir::new().expect("a temporary folder");
    let loops = fs::read_to_string(fixture("loops.nc")).expect("a program");
    for folder in ["old", "new"] {
        fs::create_dir(out.path().join(folder)).expect("a folder");
        fs::write(out.path().join(folder).join("same.nc"), &loops).expect("written");
        fs::write(out.path().join(folder).join("notes.txt"), folder).expect("written");
    }
    let tool = ["--tool", "endmill:0.2mm"];
    let same = voromill(out.path(), &[&["diff", "old", "new"][..], &tool].concat());
    assert_eq!(same.status.code(), Some(0), "{}{}", stdout(&same), stderr(&same));
    fs::write(out.path().join("new/added.nc"), loops.replace("X3.1500", "X2.5")).expect("written");
    let other = voromill(out.path(), &[&["diff", "old", "new", "-o", "pictures"][..], &tool].concat());
    assert_eq!(other.status.code(), Some(1), "{}{}", stdout(&other), stderr(&other));
    assert!(stdout(&other).contains("same.nc: the same copper"), "{}", stdout(&other));
    assert!(stdout(&other).contains("added.nc: "), "{}", stdout(&other));
    assert!(!stdout(&other).contains("-0.0000"), "nothing is nothing: {}", stdout(&other));
    let picture = fs::read(out.path().join("pictures/added.nc.png")).expect("a picture");
    assert!(picture.starts_with(b"\x89PNG"), "of what differs");
    assert!(!out.path().join("pictures/same.nc.png").exists(), "and none of what does not");
    fs::write(out.path().join("old/broken.nc"), "G1 X1 Yone\n").expect("written");
    let broken = voromill(out.path(), &["diff", "old/broken.nc", "new/same.nc"]);
    assert!(stderr(&broken).contains("old/broken.nc: line 1, column 7"), "which one: {}", stderr(&broken));
    let mixed = voromill(out.path(), &["diff", "old", "new/added.nc"]);
    assert_eq!(mixed.status.code(), Some(2), "a folder and a file: {}", stdout(&mixed));
}

#[test]
fn programs_for_several_tiles_say_so_and_are_judged_on_all_of_them() {
    let out = TempDir::new().expect("a temporary folder");
    let (copper, edge) = (fixture("seven-F_Cu.gbr"), fixture("seven-Edge_Cuts.gbr"));
    let mill = [
        "mill",
        &copper,
        &edge,
        "-o",
        "out",
        "--tool",
        "endmill:0.2mm",
        "--tile",
        "2x2",
        "--rotate",
        "90deg",
    ];
    let made = voromill(out.path(), &mill);
    assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    let front = out.path().join("out/seven-front.ngc").to_string_lossy().into_owned();
    let cutout = out.path().join("out/seven-cutout.ngc").to_string_lossy().into_owned();
    let judge = |more: &[&str]| {
        voromill(out.path(), &[&["verify", &front, &cutout, "--board", &copper, &edge][..], more].concat())
    };
    let good = judge(&[]);
    assert_eq!(good.status.code(), Some(0), "{}{}", stdout(&good), stderr(&good));
    let elsewhere = judge(&["--tile-spacing", "5mm"]);
    assert_eq!(elsewhere.status.code(), Some(1), "tiles elsewhere: {}", stdout(&elsewhere));
    // What is cut last is missing on one tile alone.
    let text = fs::read_to_string(&front).expect("a program");
    let lines: Vec<&str> = text.lines().collect();
    let lift = lines.iter().rposition(|line| line.starts_with("G0 X")).expect("the last path");
    fs::write(&front, format!("{}\nM5\nM2\n", lines[..lift].join("\n"))).expect("written");
    let spoilt = judge(&[]);
    assert_eq!(spoilt.status.code(), Some(1), "{}", stdout(&spoilt));
    assert!(stdout(&spoilt).contains("[short]"), "{}", stdout(&spoilt));
}

#[test]
fn nets_that_were_left_out_are_not_missed() {
    let out = TempDir::new().expect("a temporary folder");
    let (copper, edge) = (fixture("seven-F_Cu.gbr"), fixture("seven-Edge_Cuts.gbr"));
    let mill = ["mill", &copper, &edge, "-o", "out", "--tool", "endmill:0.2mm", "--ignore", "A*,B*"];
    let made = voromill(out.path(), &mill);
    assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    let front = out.path().join("out/seven-front.ngc").to_string_lossy().into_owned();
    let judge = |more: &[&str]| {
        voromill(out.path(), &[&["verify", &front, "--board", &copper, &edge][..], more].concat())
    };
    let good = judge(&[]);
    assert_eq!(good.status.code(), Some(0), "as the program says: {}", stdout(&good));
    let all = judge(&["--ignore", "nothing"]);
    assert_eq!(all.status.code(), Some(1), "all nets: {}", stdout(&all));
}

/// As it lies beside the others once a board was probed.
#[test]
fn a_program_that_probes_is_left_out_and_that_is_said() {
    let folder = TempDir::new().expect("a folder");
    let blinker = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker").display().to_string();
    let done = |arguments: &[&str]| voromill(folder.path(), arguments);
    assert!(done(&["mill", &blinker, "-o", "out"]).status.success());
    assert!(done(&["probe", &blinker, "-o", "out/probe.ngc"]).status.success());
    let judged = done(&["verify", "out", "--board", &blinker]);
    assert_eq!(judged.status.code(), Some(0), "{}", stderr(&judged));
    assert!(stdout(&judged).contains("fit to mill"), "{}", stdout(&judged));
    assert!(
        stderr(&judged).contains("probe.ngc: it probes the surface, and mills nothing"),
        "{}",
        stderr(&judged)
    );
    let alone = done(&["verify", "out/probe.ngc", "--board", &blinker]);
    assert_eq!(alone.status.code(), Some(2), "{}", stdout(&alone));
    assert!(stderr(&alone).contains("the programs mill nothing"), "{}", stderr(&alone));
}

#[test]
fn a_picture_is_not_written_as_something_else_than_its_name_says() {
    let folder = TempDir::new().expect("a folder");
    let board = fixture("pads-F_Cu.gbr");
    for name in ["a.jpg", "a.PDF"] {
        let refused = voromill(folder.path(), &["draw", &board, "--stage", "copper", "-o", name]);
        assert_eq!(refused.status.code(), Some(2), "{name}");
        assert!(stderr(&refused).contains("pictures are not written as"), "{}", stderr(&refused));
        assert!(!folder.path().join(name).exists(), "{name}");
    }
    let chosen = ["draw", &board, "--stage", "copper", "-o", "a.jpg", "--format", "png"];
    assert!(voromill(folder.path(), &chosen).status.success(), "as it was chosen");
}

#[test]
fn what_was_warned_of_before_counts_in_the_last_line() {
    let folder = TempDir::new().expect("a folder");
    let blinker = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker");
    let last = |arguments: &[&str]| {
        let done = voromill(folder.path(), arguments);
        assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
        stdout(&done).lines().last().unwrap_or_default().to_owned()
    };
    assert_eq!(last(&["mill", &blinker.display().to_string(), "-o", "all"]), "  fit to mill");
    fs::create_dir(folder.path().join("board")).expect("a folder");
    for name in ["blinker-B_Cu.gbr", "blinker-Edge_Cuts.gbr"] {
        fs::copy(blinker.join(name), folder.path().join("board").join(name)).expect("copied");
    }
    let accepts = "  fit to mill if you accept 1 warning: look at it first";
    assert_eq!(last(&["mill", "board", "-o", "undrilled"]), accepts, "pads have no holes");
}
