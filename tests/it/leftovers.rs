//! Programs of earlier runs and other revisions: what a run leaves in its folder, and what programs
//! say of their files.

use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;
use voromill::board::Source;
use voromill::import::{Selection, load};

use crate::cli::{listing, stderr, stdout, voromill};

/// A copy of a board of ours, in which files may be changed.
fn copied(board: &str) -> TempDir {
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(board);
    let folder = TempDir::new().expect("a folder");
    fs::create_dir(folder.path().join("board")).expect("made");
    for entry in fs::read_dir(from).expect("readable").map(|entry| entry.expect("an entry")) {
        fs::copy(entry.path(), folder.path().join("board").join(entry.file_name())).expect("copied");
    }
    folder
}

/// Mills quickly, with `more` options, and returns what is said.
fn mill(folder: &Path, more: &[&str]) -> String {
    let fixed = ["mill", "board", "-o", "out", "--no-verify", "--no-html", "--dialect", "linuxcnc"];
    let done = voromill(folder, &[&fixed, more].concat());
    assert!(done.status.success(), "{}", stderr(&done));
    stderr(&done)
}

/// Writes a file of the board anew, with `from` as `to`.
fn change(file: &Path, from: &str, to: &str) {
    let text = fs::read_to_string(file).expect("readable");
    assert!(text.contains(from), "{} has {from}", file.display());
    fs::write(file, text.replace(from, to)).expect("written");
}

#[test]
fn what_a_run_does_not_write_again_goes_unless_somebody_changed_it() {
    let folder = copied("blinker");
    let out = folder.path().join("out");
    assert_eq!(mill(folder.path(), &["--svg"]), "", "nothing to say of a new folder");
    assert_eq!(mill(folder.path(), &["--svg"]), "", "nor of the same once more");
    let manifest: serde_json::Value =
        serde_json::from_slice(&fs::read(out.join("blinker.json")).expect("readable")).expect("JSON");
    let listed = manifest["outputs"].as_array().expect("a list");
    let mut names: Vec<&str> = listed.iter().filter_map(|entry| entry["file"].as_str()).collect();
    names.push("blinker.json");
    names.sort_unstable();
    assert_eq!(names, listing(&out), "the report lists every other file");
    // The next revision has no outline any more; the picture was painted on, and a program is
    // somebody's.
    fs::write(out.join("blinker-back.svg"), "painted on").expect("written");
    fs::write(out.join("old-front.ngc"), "G21\n").expect("written");
    fs::write(out.join("notes.txt"), "mine").expect("written");
    let said = mill(folder.path(), &["--skip", "blinker-Edge_Cuts.gbr"]);
    let left = listing(&out);
    assert!(!left.contains(&"blinker-cutout.ngc".to_owned()), "the cutout is gone: {left:?}");
    for name in ["blinker-back.svg", "old-front.ngc", "notes.txt"] {
        assert!(left.contains(&name.to_owned()), "{name} stays: {left:?}");
    }
    assert!(said.contains("removed from out, written by an earlier run: blinker-cutout.ngc"), "{said}");
    assert!(said.contains("blinker-back.svg") && said.contains("changed since"), "{said}");
    assert!(said.contains("did not write: old-front.ngc") && !said.contains("notes.txt"), "{said}");
    let denied = voromill(
        folder.path(),
        &["mill", "board", "-o", "out", "--deny-warnings", "--no-html", "--dialect", "linuxcnc"],
    );
    assert_eq!(denied.status.code(), Some(2), "where warnings are denied: {}", stderr(&denied));
    assert_eq!(listing(&out), left, "nothing was touched");
}

#[test]
fn a_manifest_leads_to_no_file_elsewhere() {
    let folder = copied("blinker");
    let out = folder.path().join("out");
    fs::create_dir(&out).expect("made");
    fs::write(folder.path().join("dear.txt"), "").expect("written");
    let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
    let entry = |file: &str| format!(r#"{{"file": "{file}", "sha256": "{empty}"}}"#);
    let entries = ["../dear.txt", "", ".", "..", ".hidden"].map(entry).join(",");
    fs::write(out.join(".hidden"), "").expect("written");
    fs::write(out.join("blinker.json"), format!(r#"{{"outputs": [{entries}]}}"#)).expect("written");
    mill(folder.path(), &[]);
    assert!(folder.path().join("dear.txt").exists() && out.join(".hidden").exists(), "both are there");
}

#[test]
fn a_comment_changes_no_program_and_a_track_does() {
    let folder = copied("blinker");
    let layer = folder.path().join("board/blinker-B_Cu.gbr");
    mill(folder.path(), &[]);
    let programs = || {
        let names = listing(&folder.path().join("out"));
        let names = names.into_iter().filter(|name| name.ends_with(".ngc"));
        names
            .map(|name| fs::read_to_string(folder.path().join("out").join(name)).expect("readable"))
            .collect()
    };
    let before: Vec<String> = programs();
    assert_eq!(before.len(), 3, "a side, the holes, the edge");
    // As a later export has it: another date, a comment more, other line ends.
    let text = fs::read_to_string(&layer).expect("readable");
    let date = "%TF.CreationDate,2031-05-06T07:08:09+01:00*%\r\nG04 another day*\r\n";
    fs::write(&layer, date.to_owned() + &text.replace('\n', "\r\n")).expect("written");
    let drill = folder.path().join("board/blinker-PTH.drl");
    change(&drill, "M48\n", "M48\n; DRILL file created in another year\n");
    mill(folder.path(), &[]);
    assert_eq!(programs(), before, "not a byte of any program");
    change(&layer, "D10*", "D10*\r\nX100000Y0D03*");
    mill(folder.path(), &[]);
    assert_ne!(programs(), before, "another design is another program");
}

#[test]
fn verify_says_that_a_program_was_made_from_another_revision() {
    let folder = copied("blinker");
    mill(folder.path(), &[]);
    let verify = || {
        let done = voromill(
            folder.path(),
            &["verify", "out/blinker-drill.ngc", "--board", "board", "--deny", "warning"],
        );
        (done.status.code(), stdout(&done) + &stderr(&done))
    };
    let (code, said) = verify();
    assert_eq!(code, Some(0), "its own files: {said}");
    // The outline has nothing to do with the holes, and the program is of another revision all the
    // same.
    fs::remove_file(folder.path().join("board/blinker-Edge_Cuts.gbr")).expect("removed");
    let (code, said) = verify();
    assert!(code == Some(1) && said.contains("[revision]"), "a file is missing: {said}");
    assert!(said.contains("blinker-Edge_Cuts.gbr, which is not among these"), "{said}");
    let folder = copied("blinker");
    mill(folder.path(), &[]);
    change(&folder.path().join("board/blinker-PTH.drl"), "M48\n", "M48\n; only a comment\n");
    let verify = ["verify", "out/blinker-drill.ngc", "--board", "board", "--deny", "warning"];
    assert!(voromill(folder.path(), &verify).status.success(), "a comment is no revision");
    let layer = folder.path().join("board/blinker-B_Cu.gbr");
    let text = fs::read_to_string(&layer).expect("readable");
    let at = text.rfind("D01*").expect("a line is drawn");
    let start = text[..at].rfind('\n').expect("a line") + 1;
    let end = at + text[at..].find('\n').expect("its end") + 1;
    fs::write(&layer, text[..start].to_owned() + &text[end..]).expect("written");
    let done = voromill(folder.path(), &verify);
    assert!(stdout(&done).contains("blinker-B_Cu.gbr, which has another content now"), "{}", stdout(&done));
}

#[test]
fn every_file_that_is_read_has_the_hash_of_its_design() {
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/regulator");
    let loaded = load(&[board], &Selection::default()).expect("a board");
    let is_read = |source: &&Source| !source.role.starts_with("ignored");
    let mut designs: Vec<&str> =
        loaded.sources.iter().filter(is_read).map(|source| &*source.design).collect();
    assert!(designs.len() > 3 && designs.iter().all(|design| design.len() == 64), "{designs:?}");
    designs.sort_unstable();
    let count = designs.len();
    designs.dedup();
    assert_eq!(designs.len(), count, "each its own");
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_nothing_half_written() {
    use std::os::unix::process::ExitStatusExt;

    for (signal, number) in [("INT", 2), ("TERM", 15)] {
        let folder = copied("blinker");
        let out = folder.path().join("out");
        fs::create_dir(&out).expect("made");
        let shell = |command: &str, argument: &str| {
            let done = Command::new(command).args(argument.split(' ')).current_dir(&out).status();
            assert!(done.expect("it runs").success(), "{command} {argument}");
        };
        // Nobody reads the pipe, so the program waits for a reader, with all other files written
        // and none renamed.
        shell("mkfifo", "blinker-drill.ngc");
        let arguments =
            ["mill", "board", "-o", "out", "--no-verify", "--no-html", "--quiet", "--dialect", "linuxcnc"];
        let program = Command::new(env!("CARGO_BIN_EXE_voromill"));
        let mut run = { program }.args(arguments).current_dir(folder.path()).spawn().expect("it runs");
        let is_report = |name: &String| name.starts_with(".blinker.json.");
        while !listing(&out).iter().any(is_report) {
            assert!(run.try_wait().expect("asked").is_none(), "it waits for a reader");
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        shell("kill", &format!("-{signal} {}", run.id()));
        assert_eq!(run.wait().expect("it ends").signal(), Some(number), "SIG{signal} ends it");
        assert_eq!(listing(&out), ["blinker-drill.ngc"], "SIG{signal}: only the pipe is left");
    }
}
