//! The program as a person runs it: arguments in, files and an exit code out.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

fn fixture(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(path)
}

/// Runs the program in `folder`; a setting beside the board must not come from somewhere else.
pub(crate) fn voromill(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_voromill"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program runs")
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The names of what lies in a folder, sorted.
pub(crate) fn listing(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Asserts that the program fails with one short message that contains `words`, and leaves nothing
/// in `folder` but `left`.
fn fails(folder: &TempDir, arguments: &[&str], words: &[&str], left: &[&str]) {
    let message = refused(folder, arguments, words, left);
    assert!(message.lines().count() <= 10, "{arguments:?} is short: {message}");
}

/// The message with which the program fails; it contains `words`, and nothing is left in `folder`
/// but `left`.
fn refused(folder: &TempDir, arguments: &[&str], words: &[&str], left: &[&str]) -> String {
    let output = voromill(folder.path(), arguments);
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?} must fail: {message}");
    assert!(message.starts_with("error: "), "{arguments:?} begins with what it is: {message}");
    assert!(stdout(&output).is_empty(), "{arguments:?} prints no result");
    for word in words {
        assert!(message.contains(word), "{arguments:?} says `{word}`: {message}");
    }
    assert_eq!(listing(folder.path()), left, "{arguments:?} leaves nothing half-written");
    message
}

fn folder() -> TempDir {
    TempDir::new().expect("a temporary folder")
}

#[test]
fn milling_a_double_sided_board_writes_every_program_picture_and_the_report() {
    let out = folder();
    let board = fixture("boards/regulator");
    let done = voromill(out.path(), &["mill", &board.to_string_lossy(), "-o", "out"]);
    assert!(done.status.success(), "{}", stderr(&done));
    let expected = [
        "regulator-back.ngc",
        "regulator-back.png",
        "regulator-cutout.ngc",
        "regulator-drill-0.6mm.ngc",
        "regulator-drill-0.8mm.ngc",
        "regulator-drill-1.0mm.ngc",
        "regulator-drill-1.3mm.ngc",
        "regulator-drill-3.2mm.ngc",
        "regulator-drill-endmill-1.0mm.ngc",
        "regulator-front.ngc",
        "regulator-front.png",
        "regulator.html",
        "regulator.json",
    ];
    assert_eq!(listing(&out.path().join("out")), expected, "named after the board");
    assert!(stdout(&done).contains("regulator-front.ngc"), "the summary lists them: {}", stdout(&done));
}

#[test]
fn every_thread_count_gives_the_same_bytes() {
    let out = folder();
    for board in ["blinker", "regulator"] {
        let path = fixture("boards").join(board);
        let path = path.to_string_lossy();
        for (threads, to) in [("1", "one"), ("2", "two"), ("2", "again")] {
            let done = voromill(out.path(), &["mill", &path, "-q", "-j", threads, "-o", to]);
            assert!(done.status.success(), "{}", stderr(&done));
            assert!(done.stdout.is_empty() && done.stderr.is_empty(), "--quiet says nothing");
        }
        for name in listing(&out.path().join("one")) {
            let read = |folder: &str| fs::read(out.path().join(folder).join(&name)).expect("written");
            assert!(read("one") == read("two"), "{name} differs between -j 1 and -j 2");
            assert!(read("two") == read("again"), "{name} differs from run to run");
        }
    }
}

#[test]
fn where_the_time_went_is_told_where_asked_and_never_in_a_file() {
    let out = TempDir::new().expect("a folder");
    let board = fixture("boards/unsafe-gap");
    let done =
        voromill(out.path(), &["mill", &board.to_string_lossy(), "--json", "--no-html", "-vv", "-o", "."]);
    let report: serde_json::Value = serde_json::from_slice(&done.stdout).expect("JSON");
    let stages: Vec<&str> =
        report["stages"].as_array().expect("stages").iter().filter_map(|s| s["stage"].as_str()).collect();
    for stage in ["reading", "front: nets", "front: Voronoi diagram", "simulating", "writing files"] {
        assert!(stages.contains(&stage), "{stage} among {stages:?}");
        assert!(stderr(&done).contains(&format!(" ms  {stage}")), "{stage}: {}", stderr(&done));
    }
    let file = fs::read_to_string(out.path().join("unsafe-gap.json")).expect("written");
    assert!(!file.contains("\"stages\""), "no clock in a file");
    let once =
        voromill(out.path(), &["mill", &board.to_string_lossy(), "--json", "--no-html", "-v", "-o", "."]);
    assert_eq!(stdout(&once).trim_end(), file.trim_end(), "with one -v the report is as in the file");
}

#[test]
fn where_the_time_of_carving_and_pockets_went_is_told_where_asked() {
    let out = TempDir::new().expect("a folder");
    let sign = r#"<svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20">
        <path d="M1 1H19V15L9 19Z"/></svg>"#;
    fs::write(out.path().join("sign.svg"), sign).expect("written");
    let carve = ["--tool", "vbit:0.2mm:60deg", "--max-depth", "1mm", "--flat", "endmill:2mm"];
    let pocket = ["--tool", "endmill:2mm", "--tool", "endmill:1mm", "--depth", "1mm"];
    let done = |command: &str, options: &[&str], told: &str| {
        let common = [command, "sign.svg", "-o", "sign.ngc", "--format", "json", told];
        voromill(out.path(), &[&common[..], options].concat())
    };
    let carved = &["reading", "medial axis", "floor", "moves of the V-bit", "simulating"][..];
    let pocketed = &["reading", "endmill:2mm: loops", "endmill:1mm: what is left", "simulating"][..];
    for (command, options, named) in [("carve", carve, carved), ("pocket", pocket, pocketed)] {
        let told = done(command, &options, "-vv");
        let report: serde_json::Value = serde_json::from_slice(&told.stdout).expect("JSON");
        let stages: Vec<&str> =
            report["stages"].as_array().expect("stages").iter().filter_map(|s| s["stage"].as_str()).collect();
        for stage in named {
            assert!(stages.contains(stage), "{stage} among {stages:?}");
            assert!(stderr(&told).contains(&format!(" ms  {stage}")), "{stage}: {}", stderr(&told));
        }
        assert!(!stdout(&done(command, &options, "-v")).contains("\"stages\""), "none with one -v");
    }
}

#[test]
fn the_report_on_stdout_is_the_report_in_the_file() {
    let out = folder();
    let board = fixture("boards/blinker");
    let done = voromill(out.path(), &["mill", &board.to_string_lossy(), "--format", "json", "-o", "."]);
    let file = fs::read_to_string(out.path().join("blinker.json")).expect("written");
    assert_eq!(stdout(&done), file, "the same text");
    assert!(!file.contains(&*out.path().to_string_lossy()), "no path of this machine");
    let report: serde_json::Value = serde_json::from_str(&file).expect("JSON");
    assert_eq!(report["schema_version"], 2, "the version of its shape");
    assert!(report["total"]["cut_mm"].as_f64() > Some(0.0), "something is cut");
}

#[test]
fn a_side_can_be_drawn_as_lines_and_in_the_terminal() {
    let out = folder();
    let board = fixture("boards/unsafe-gap");
    let board = board.to_string_lossy();
    let draw = |arguments: &[&str]| {
        let done = voromill(out.path(), &[&["draw", &board], arguments].concat());
        assert!(done.status.success(), "{arguments:?}: {}", stderr(&done));
        done.stdout
    };
    for (stage, holds, lacks) in [
        ("toolpath", "id=\"cuts\"", "id=\"boundaries\""),
        ("voronoi", "id=\"boundaries\"", "id=\"cuts\""),
        ("copper", "id=\"copper\"", "id=\"cuts\""),
        ("nets", "id=\"net-2\"", "id=\"cuts\""),
    ] {
        assert!(draw(&["--stage", stage, "-o", "board.svg"]).is_empty(), "nothing is printed");
        let svg = fs::read_to_string(out.path().join("board.svg")).expect("written");
        assert!(svg.contains("width=\"43.000mm\""), "in millimetres: {svg:.200}");
        assert!(svg.contains(holds) && !svg.contains(lacks), "{stage}: {svg:.400}");
        assert!(svg.contains("id=\"drills\"") && svg.ends_with("</svg>\n"), "{stage} is whole");
    }
    assert!(draw(&["-o", "-"]).starts_with(b"\x89PNG"), "a pipe gets a PNG");
    let blocks = String::from_utf8(draw(&["-o", "-", "--format", "blocks"])).expect("text");
    assert!(
        blocks.lines().all(|line| line.starts_with("\x1b[38;2;") && line.ends_with("\x1b[0m")),
        "lines of blocks"
    );
    assert!(blocks.lines().count() <= 40, "as many as a terminal has");
    assert!(draw(&["-o", "-", "--format", "sixel"]).starts_with(b"\x1bPq"), "sixels");
    fails(
        &out,
        &["draw", &board, "--stage", "heat", "-o", "heat.svg"],
        &["no SVG", "hint: "],
        &["board.svg"],
    );
}

#[test]
fn mill_writes_what_is_asked_for() {
    let out = folder();
    let board = fixture("boards/unsafe-gap");
    let done =
        voromill(out.path(), &["mill", &board.to_string_lossy(), "-q", "--svg", "--no-html", "-o", "."]);
    assert!(done.status.success(), "{}", stderr(&done));
    let names = listing(out.path());
    assert!(names.contains(&"unsafe-gap-front.svg".to_owned()), "the drawing for documents: {names:?}");
    assert!(!names.contains(&"unsafe-gap.html".to_owned()), "and no page: {names:?}");
}

#[test]
fn one_layer_goes_to_stdout_alone() {
    let out = folder();
    let layer = fixture("boards/blinker/blinker-B_Cu.gbr");
    let done =
        voromill(out.path(), &["isolate", &layer.to_string_lossy(), "-o", "-", "--dialect", "linuxcnc"]);
    assert!(done.status.success(), "{}", stderr(&done));
    let program = stdout(&done);
    assert!(
        program.contains("mirror") || program.contains("mirrored left to right"),
        "the back says how it lies: {program:.400}"
    );
    assert!(program.contains("M2"), "a whole program");
    assert!(listing(out.path()).is_empty(), "and no file");
    let tight =
        voromill(out.path(), &["isolate", &layer.to_string_lossy(), "-o", "-", "--tool", "endmill:1mm"]);
    assert!(stderr(&tight).contains("[gap-narrower-than-tool]"), "what is wrong with it: {}", stderr(&tight));
    assert!(!stdout(&tight).contains("warning"), "beside it");
}

#[test]
#[cfg(unix)]
fn a_pipe_and_a_link_stay_what_they_are() {
    use std::os::unix::fs::FileTypeExt as _;
    let out = folder();
    let layer = fixture("boards/blinker/blinker-B_Cu.gbr");
    let isolate = |name: &str| voromill(out.path(), &["isolate", &layer.to_string_lossy(), "-q", "-o", name]);
    let path = |name: &str| out.path().join(name);
    assert!(isolate("file.ngc").status.success(), "a file");
    let program = fs::read(path("file.ngc")).expect("written");

    std::os::unix::fs::symlink("file.ngc", path("link.ngc")).expect("a link");
    fs::write(path("file.ngc"), "old").expect("written");
    assert!(isolate("link.ngc").status.success(), "through a link");
    assert!(path("link.ngc").is_symlink(), "it is still a link");
    assert!(fs::read(path("file.ngc")).expect("there") == program, "where it leads lies the program");

    let made = Command::new("mkfifo").arg(path("pipe.ngc")).status().expect("mkfifo runs");
    assert!(made.success(), "a pipe with a name");
    let pipe = path("pipe.ngc");
    let reader = std::thread::spawn(move || fs::read(pipe));
    assert!(isolate("pipe.ngc").status.success(), "into a pipe");
    let kind = fs::metadata(path("pipe.ngc")).expect("there").file_type();
    assert!(kind.is_fifo(), "as /dev/null must stay what it is");
    assert!(reader.join().expect("read").expect("read") == program, "who reads gets the program");
    assert_eq!(listing(out.path()), ["file.ngc", "link.ngc", "pipe.ngc"], "and nothing else");
}

#[test]
#[cfg(unix)]
fn a_result_that_nobody_can_take_is_an_error() {
    let out = folder();
    let layer = fixture("boards/blinker/blinker-B_Cu.gbr");
    let layer = layer.to_string_lossy();
    for arguments in [&["isolate", &layer, "-o", "-"][..], &["inspect", &layer], &["draw", &layer, "-o", "-"]]
    {
        // A limit of no bytes stands for a disk that is full.
        let done = Command::new("sh")
            .args(["-c", "trap '' XFSZ; ulimit -f 0; \"$@\" > taken", "sh", env!("CARGO_BIN_EXE_voromill")])
            .args(arguments)
            .current_dir(out.path())
            .output()
            .expect("a shell");
        assert_eq!(done.status.code(), Some(2), "{arguments:?}: {}", stderr(&done));
        assert!(stderr(&done).contains("cannot write to stdout"), "it says why: {}", stderr(&done));
    }
}

#[test]
fn the_lap_round_copper_is_in_the_picture() {
    let out = folder();
    let layer = fixture("boards/blinker/blinker-B_Cu.gbr");
    let size = |options: &[&str]| {
        let layer = layer.to_string_lossy();
        let arguments = [&["draw", &layer, "-o", "p.png"], options].concat();
        let done = voromill(out.path(), &arguments);
        assert!(done.status.success(), "{}", stderr(&done));
        assert!(stderr(&done).contains("[outline-missing]"), "what to know of it: {}", stderr(&done));
        let bytes = fs::read(out.path().join("p.png")).expect("a picture");
        u32::from_be_bytes(bytes[16..20].try_into().expect("the width of a PNG"))
    };
    let without = size(&["--stage", "voronoi", "--no-frame"]);
    let wider = size(&["--stage", "voronoi", "--frame-margin", "2mm"]) - without;
    assert!((157..=159).contains(&wider), "two millimetres on each side at 1000 DPI: {wider}");
    assert_eq!(size(&["--stage", "nets", "--frame-margin", "2mm"]), without, "nets have no frame");
}

#[test]
fn what_is_no_program_is_shown_by_its_beginning() {
    let out = folder();
    fs::write(out.path().join("no.nc"), format!("PK{}", "x".repeat(100_000))).expect("written");
    let board = fixture("boards/blinker");
    let arguments = ["verify", "no.nc", "--board", &board.to_string_lossy()];
    let message = refused(&out, &arguments, &["no.nc: line 1, column 1", "…`: expected"], &["no.nc"]);
    assert!(message.len() < 200, "short: {message}");
}

#[test]
fn an_option_that_changes_nothing_is_neither_shown_nor_taken() {
    let out = folder();
    let board = fixture("boards/regulator");
    let board = board.to_string_lossy();
    for (command, option, value) in [
        ("isolate", "--drill-depth", "2mm"),
        ("isolate", "--output-name", "front=top.ngc"),
        ("draw", "--dialect", "linuxcnc"),
        ("draw", "--drill-bore", ""),
        ("draw", "--cutout-side", "back"),
        ("probe", "--width", "0.5mm"),
        ("probe", "--no-frame", ""),
        ("inspect", "--feed", "100mm/min"),
    ] {
        let mut given = vec![command, &board, option];
        given.extend([value, "-o", "x"].iter().filter(|word| !word.is_empty() && command != "inspect"));
        if command == "inspect" {
            given.push(value);
        }
        fails(&out, &given, &[&format!("{option} has no effect on what `voromill {command}` makes")], &[]);
        let help = stdout(&voromill(out.path(), &[command, "--help-all"]));
        assert!(!help.contains(option), "{command} --help-all is silent on {option}");
        let help = stdout(&voromill(out.path(), &["mill", "--help-all"]));
        assert!(help.contains(option), "mill takes {option}");
    }
    // A settings file is for all of them.
    fs::write(out.path().join("all.toml"), "drill-depth = \"2mm\"\n").expect("written");
    let done = voromill(out.path(), &["probe", &board, "--config", "all.toml", "-o", "probe.ngc"]);
    assert!(done.status.success(), "{}", stderr(&done));
    let done = voromill(out.path(), &["isolate", &board, "--side", "front", "-o", "front.ngc"]);
    assert!(!stdout(&done).contains("cutout"), "only what was written is told of: {}", stdout(&done));
}

/// Without an outline the zero is that of all copper, whichever side is isolated.
#[test]
fn a_side_alone_has_the_zero_of_the_whole_board() {
    let out = folder();
    let pads = |name: &str, pads: &str| {
        let text = format!("%FSLAX26Y26*%%MOMM*%%ADD10C,1*%D10*{pads}M02*");
        fs::write(out.path().join(name), text).expect("written");
    };
    pads("pads-F_Cu.gbr", "X5000000Y5000000D03*X9000000Y5000000D03*");
    pads("pads-B_Cu.gbr", "X0Y0D03*X9000000Y0D03*");
    let whole = voromill(out.path(), &["mill", "pads-F_Cu.gbr", "pads-B_Cu.gbr", "-o", "whole"]);
    assert!(whole.status.success(), "{}", stderr(&whole));
    let arguments = ["isolate", "pads-F_Cu.gbr", "pads-B_Cu.gbr", "--side", "front", "-o", "front.ngc"];
    let alone = voromill(out.path(), &arguments);
    assert!(alone.status.success(), "{}", stderr(&alone));
    let moves = |path: PathBuf| {
        let text = fs::read_to_string(path).expect("a program");
        text.lines().filter(|line| line.starts_with('G')).map(str::to_owned).collect::<Vec<_>>()
    };
    let names = listing(&out.path().join("whole"));
    let front = names.iter().find(|name| name.ends_with("front.ngc")).expect("the front's program");
    assert_eq!(
        moves(out.path().join("front.ngc")),
        moves(out.path().join("whole").join(front)),
        "the same moves"
    );
}

#[test]
fn an_option_that_changes_nothing_beside_the_others_is_refused() {
    let out = folder();
    let board = fixture("boards/regulator");
    let board = board.to_string_lossy();
    for (option, value, hint) in [
        ("--overlap", "50%", "--width"),
        ("--alignment-margin", "9mm", "--alignment-holes"),
        ("--alignment-depth", "9mm", "--alignment-holes"),
        ("--tile-spacing", "3mm", "--tile"),
    ] {
        let said = format!("{option} has no effect with these options");
        fails(&out, &["mill", &board, "-o", "x", option, value], &[&said, hint], &[]);
    }
    fails(
        &out,
        &["mill", &board, "-o", "x", "--depth", "-0.1mm"],
        &["depths are positive here: write `0.1mm`"],
        &[],
    );
    fails(&out, &["mill", &board, "-o", "x", "--passes", "1000000000"], &["1000000000"], &[]);
    fs::write(out.path().join("many.toml"), "passes = 1000000000\n").expect("written");
    let many = ["mill", &board, "--config", "many.toml", "-o", "x"];
    fails(&out, &many, &["passes: `1000000000` is invalid: expected 1 to 1000"], &["many.toml"]);
    fs::write(out.path().join("many.toml"), "overlap = \"50%\"\nspindle = \"9000rpm\"\n").expect("written");
    let done =
        voromill(out.path(), &["isolate", &board, "--side", "front", "--config", "many.toml", "-o", "x.ngc"]);
    assert!(done.status.success(), "a settings file is for many boards: {}", stderr(&done));
    assert!(fs::read_to_string(out.path().join("x.ngc")).expect("a program").contains("S9000"), "turns");
}

#[test]
fn a_default_is_told_once() {
    let out = folder();
    for command in
        ["mill", "isolate", "draw", "inspect", "verify", "diff", "probe", "level", "tools", "machine", "init"]
    {
        let help = stdout(&voromill(out.path(), &[command, "--help-all"]));
        let words = help.split_whitespace().collect::<Vec<_>>().join(" ");
        for option in words.split(" --") {
            let defaults = option.matches("[default: ").count();
            assert!(defaults <= 1, "{command} --{option}");
        }
    }
}

#[test]
fn nonsense_for_input_ends_in_a_message_and_no_file() {
    let out = folder();
    let write = |name: &str, bytes: &[u8]| fs::write(out.path().join(name), bytes).expect("written");
    write("empty.gbr", b"");
    write("picture.gbr", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0\0");
    write("truncated.gbr", b"%FSLAX46Y46*%\n%MOMM*%\n%AMROUND*\n1,1,0.5,");
    write("bare-F_Cu.gbr", b"%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.5*%\nD10*\nM02*\n");
    write("file", b"");
    // Copper was read, and then the file ends in the middle of a command: nobody knows what was to
    // follow.
    write("cut-off-F_Cu.gbr", b"%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.5*%\nD10*\nX1000000Y1000000D03*\nX30000");
    let left = ["bare-F_Cu.gbr", "cut-off-F_Cu.gbr", "empty.gbr", "file", "picture.gbr", "truncated.gbr"];
    fails(&out, &["mill", "missing.gbr", "-o", "out"], &["missing.gbr"], &left);
    fails(&out, &["mill", "empty.gbr", "-o", "out"], &["empty.gbr", "empty"], &left);
    fails(&out, &["mill", "picture.gbr", "-o", "out"], &["picture.gbr", "PNG"], &left);
    fails(&out, &["mill", "truncated.gbr", "-o", "out"], &["truncated.gbr"], &left);
    fails(
        &out,
        &["mill", "cut-off-F_Cu.gbr", "-o", "out"],
        &["cut-off-F_Cu.gbr:6:", "truncated", "hint: "],
        &left,
    );
    fails(&out, &["mill", "bare-F_Cu.gbr", "-o", "out"], &["no copper", "hint: "], &left);
    let board = fixture("boards/blinker");
    fails(&out, &["mill", &board.to_string_lossy(), "-o", "file/out"], &["file/out", "hint: "], &left);
    fails(&out, &["mill", &board.to_string_lossy(), "-o", "file"], &["file", "hint: "], &left);
    fails(&out, &["draw", &board.to_string_lossy(), "-o", "no/such.png"], &["no/such.png", "hint: "], &left);
}

#[test]
fn a_file_that_cannot_be_replaced_leaves_the_others_as_they_were() {
    let out = folder();
    let target = out.path().join("out");
    fs::create_dir_all(target.join("blinker-cutout.ngc")).expect("a folder in the way");
    fs::write(target.join("blinker-back.ngc"), "old").expect("written");
    let board = fixture("boards/blinker");
    fails(
        &out,
        &["mill", &board.to_string_lossy(), "-o", "out"],
        &["blinker-cutout.ngc", "folder"],
        &["out"],
    );
    assert_eq!(listing(&target), ["blinker-back.ngc", "blinker-cutout.ngc"], "nothing new");
    assert_eq!(
        fs::read_to_string(target.join("blinker-back.ngc")).expect("there"),
        "old",
        "nothing replaced"
    );
}

#[test]
fn options_win_over_the_settings_file_and_that_over_the_defaults() {
    let out = folder();
    let layer = out.path().join("layer-B_Cu.gbr");
    fs::copy(fixture("boards/blinker/blinker-B_Cu.gbr"), layer).expect("copied");
    fs::write(out.path().join("voromill.toml"), "depth = \"0.2mm\"\nfeed = \"150mm/min\"\n")
        .expect("written");
    let run = |arguments: &[&str]| {
        let done = voromill(out.path(), &[&["isolate", "layer-B_Cu.gbr", "-o", "-"], arguments].concat());
        assert!(done.status.success(), "{}", stderr(&done));
        stdout(&done)
    };
    let beside = run(&[]);
    assert!(beside.contains("depth 0.2mm") && beside.contains("feed 150mm/min"), "{beside:.900}");
    assert!(beside.contains("spindle 12000"), "the default: {beside:.900}");
    let options = run(&["--depth", "3mil"]);
    assert!(options.contains("depth 0.0762mm") && options.contains("feed 150mm/min"), "{options:.900}");
}

#[test]
fn wrong_settings_are_named_with_their_place() {
    let out = folder();
    fs::write(out.path().join("wrong.toml"), "depht = \"0.2mm\"\n").expect("written");
    let board = fixture("boards/blinker");
    let board = board.to_string_lossy();
    let left = ["wrong.toml"];
    let arguments = ["mill", &board, "-o", "out", "--config", "wrong.toml"];
    fails(&out, &arguments, &["wrong.toml:1:1", "did you mean `depth`"], &left);
    let bare = voromill(out.path(), &["mill", &board, "-o", "out", "--depth", "0.1"]);
    assert_eq!(bare.status.code(), Some(2), "a bare number is refused");
    assert!(stderr(&bare).contains("0.1mm"), "with a hint: {}", stderr(&bare));
    fails(&out, &["mill", &board, "-o", "out", "--tool", "drill:1mm"], &["tool", "endmill"], &left);
}

#[test]
fn init_writes_the_defaults_once() {
    let out = folder();
    let written = voromill(out.path(), &["init"]);
    assert!(written.status.success(), "{}", stderr(&written));
    let text = fs::read_to_string(out.path().join("voromill.toml")).expect("written");
    assert_eq!(text, voromill::job::commented_defaults(), "the commented file");
    fails(&out, &["init"], &["voromill.toml", "--force"], &["voromill.toml"]);
    assert!(voromill(out.path(), &["init", "--force"]).status.success(), "--force replaces it");
}

/// The file beside the board comes before that of the folder in which it is run.
#[test]
fn the_settings_file_that_was_found_is_named() {
    let out = folder();
    fs::create_dir(out.path().join("board")).expect("made");
    let copper = fs::read(fixture("boards/blinker").join("blinker-B_Cu.gbr")).expect("a fixture");
    fs::write(out.path().join("board/blinker-B_Cu.gbr"), copper).expect("written");
    let depth_with = |named: &str| {
        let done = voromill(out.path(), &["mill", "board", "-o", "out", "--no-verify"]);
        assert!(done.status.success(), "{}", stderr(&done));
        let says = stderr(&done).lines().any(|line| line == format!("settings: {named}"));
        assert_eq!(says, !named.is_empty(), "{}", stderr(&done));
        let program = fs::read_to_string(out.path().join("out/blinker-back.ngc")).expect("written");
        program.lines().find(|line| line.starts_with("(depth ")).expect("a depth").to_owned()
    };
    assert_eq!(depth_with(""), "(depth 0.1mm)");
    assert!(voromill(out.path(), &["init"]).status.success());
    assert_eq!(depth_with("voromill.toml"), "(depth 0.1mm)", "what init writes says nothing");
    fs::write(out.path().join("voromill.toml"), "depth = \"0.2mm\"\n").expect("written");
    assert_eq!(depth_with("voromill.toml"), "(depth 0.2mm)");
    fs::write(out.path().join("board/voromill.toml"), "depth = \"0.15mm\"\n").expect("written");
    assert_eq!(depth_with("board/voromill.toml"), "(depth 0.15mm)");
}

#[test]
fn what_newcomers_type_is_answered_with_what_to_type() {
    let out = folder();
    let board = fixture("boards/blinker").to_string_lossy().into_owned();
    fails(&out, &[&board], &["no subcommand", "voromill mill"], &[]);
    fails(&out, &["mill", &board, "-out", "x"], &["`-o` with `ut`", "--output"], &[]);
    let missing = ["carve", "logo.png", "--picture-width", "40mm", "-o", "a.ngc"];
    fails(&out, &missing, &["logo.png", "no such file"], &[]);
    let comma = voromill(out.path(), &["mill", &board, "-o", "out", "--depth", "0,1mm"]);
    assert!(stderr(&comma).contains("decimal comma"), "{}", stderr(&comma));
}

#[test]
fn a_window_of_copper_is_white_where_a_pixels_centre_is_copper() {
    let out = folder();
    let gerber = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,4*%\n%ADD11R,2X2*%\n%LPD*%\nD10*\nX0Y0D03*\nD11*\nX4000000Y0D03*\nM02*\n";
    fs::write(out.path().join("dots-F_Cu.gbr"), gerber).expect("written");
    let arguments = [
        "draw",
        "dots-F_Cu.gbr",
        "--stage",
        "copper",
        "--pixel",
        "1mm",
        "--window",
        "-3mm,-2mm,9mm,4mm",
        "-o",
        "dots.png",
    ];
    let done = voromill(out.path(), &arguments);
    assert!(done.status.success(), "{}", stderr(&done));
    let picture = image::open(out.path().join("dots.png")).expect("a PNG").into_luma8();
    let mark = |pixel: &image::Luma<u8>| if pixel.0[0] == 255 { '#' } else { '.' };
    let rows: Vec<String> = picture.rows().map(|row| row.map(mark).collect()).collect();
    let expected = [
        "..##.....", //
        ".####.##.",
        ".####.##.",
        "..##.....",
    ];
    assert_eq!(rows, expected, "row 0 is on top");
}

#[test]
fn every_stage_can_be_drawn() {
    let out = folder();
    let board = fixture("boards/blinker");
    for stage in
        ["copper", "nets", "voronoi", "boundaries", "heat", "depth", "toolpath", "milled", "thinning"]
    {
        let picture = format!("{stage}.png");
        let arguments =
            ["draw", &board.to_string_lossy(), "--stage", stage, "--pixel", "0.1mm", "-o", &picture];
        let done = voromill(out.path(), &arguments);
        assert!(done.status.success(), "{stage}: {}", stderr(&done));
        let size = image::open(out.path().join(&picture)).expect("a PNG").into_luma8().dimensions();
        assert!(size.0 > 50 && size.1 > 50, "{stage} is {size:?}");
    }
}

#[test]
fn inspect_lists_files_nets_and_holes() {
    let out = folder();
    let board = fixture("boards/regulator");
    let text = voromill(out.path(), &["inspect", &board.to_string_lossy()]);
    assert!(text.status.success(), "{}", stderr(&text));
    let text = stdout(&text);
    for words in ["regulator-F_Cu.gbr", "smallest gap", "holes", "joined through plated holes"] {
        assert!(text.contains(words), "says `{words}`:\n{text}");
    }
    let json = voromill(out.path(), &["inspect", &board.to_string_lossy(), "--format", "json"]);
    let report: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    assert!(report["layers"][0]["nets"].as_array().is_some_and(|nets| nets.len() > 1), "nets by name");
}

#[test]
fn the_papers_own_program_and_picture_are_to_be_had() {
    let out = folder();
    let board = fixture("boards/blinker/blinker-B_Cu.gbr");
    let board = board.to_string_lossy();
    let program = stdout(&voromill(out.path(), &["isolate", &board, "--paper", "-o", "-"]));
    assert!(program.starts_with("G21\nG17\nG40\nG49\nG80\nG90\nG0 Z1\nG0 X"), "{program:.80}");
    assert!(program.ends_with("G0 Z1\nM5\nM2\n") && program.contains("G1 Z-0.1 F60"), "{program:.80}");
    let loops =
        stdout(&voromill(out.path(), &["isolate", &board, "--paper", "--strategy", "outline", "-o", "-"]));
    assert_eq!(loops.matches("G0 X").count(), 17, "a path round each net");
    let done = voromill(out.path(), &["draw", &board, "--paper", "-o", "paper.png"]);
    assert!(done.status.success(), "{}", stderr(&done));
    let picture = image::open(out.path().join("paper.png")).expect("a PNG");
    assert!(picture.width() > 600, "500 dots an inch");
    fs::remove_file(out.path().join("paper.png")).expect("it was there");
    let other = ["isolate", &board, "--paper", "--depth", "0.2mm", "-o", "-"];
    fails(&out, &other, &["--depth has no effect with --paper"], &[]);
}

#[test]
fn inspect_says_which_nets_are_coupled_and_what_a_limit_helps() {
    let out = folder();
    let board = fixture("boards/blinker");
    let board = board.to_string_lossy();
    let text = stdout(&voromill(out.path(), &["inspect", &board, "--coupling=GND"]));
    for words in ["coupling of regions 0.", "length/gap", "GND: ", "with --limit "] {
        assert!(text.contains(words), "says `{words}`:\n{text}");
    }
    let json = voromill(out.path(), &["inspect", &board, "--coupling", "--format", "json"]);
    let report: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    let coupling = &report["layers"][0]["coupling"];
    let figure = |of: &str| coupling["capacitance_pf"][of].as_f64().expect("a number");
    assert!(
        figure("voronoi") > figure("as_drawn") && figure("as_drawn") > 0.0,
        "regions lie closer: {coupling}"
    );
    for unknown in ["--coupling=NOBODY", "--coupling=GND,NOBODY"] {
        fails(&out, &["inspect", &board, unknown], &["no net is called `NOBODY`"], &[]);
    }
}

#[test]
fn a_drill_file_alone_can_be_inspected_and_drilled() {
    let out = folder();
    let drill = fixture("excellon/kicad.drl");
    let drill = drill.to_string_lossy();
    let done = voromill(out.path(), &["inspect", &drill]);
    assert!(done.status.success(), "{}", stderr(&done));
    let text = stdout(&done);
    for words in ["kicad.drl: drill", "3.200 mm  1 hole", "[copper-missing]"] {
        assert!(text.contains(words), "says `{words}`:\n{text}");
    }
    let done = voromill(out.path(), &["mill", &drill, "-o", "out", "--no-verify"]);
    assert!(done.status.success(), "{}", stderr(&done));
    let names = listing(&out.path().join("out"));
    assert!(names.iter().any(|name| name.starts_with("kicad-drill")), "{names:?}");
    assert!(
        !names.iter().any(|name| name.contains("front") || name.contains("cutout")),
        "no more: {names:?}"
    );
    let words = ["there is no copper"];
    fails(&out, &["isolate", &drill, "-o", "a.ngc"], &words, &["out"]);
}

#[test]
fn denied_warnings_fail_and_write_nothing() {
    let out = folder();
    fs::copy(fixture("gerber/missing_end.gbr"), out.path().join("amp-F_Cu.gbr")).expect("copied");
    let left = ["amp-F_Cu.gbr"];
    let words =
        ["--deny-warnings", "amp-F_Cu.gbr:", "[missing-end-of-file]", "^^^ expected `M02*`", "help: "];
    refused(&out, &["mill", "amp-F_Cu.gbr", "-o", "out", "--deny-warnings"], &words, &left);
    refused(&out, &["isolate", "amp-F_Cu.gbr", "-o", "a.ngc", "--deny-warnings"], &words, &left);
    refused(&out, &["draw", "amp-F_Cu.gbr", "-o", "a.png", "--deny-warnings"], &words, &left);
    refused(&out, &["draw", "amp-F_Cu.gbr", "-o", "a.png", "--paper", "--deny-warnings"], &words, &left);
    let thinned = ["draw", "amp-F_Cu.gbr", "-o", "a.png", "--stage", "thinning", "--deny-warnings"];
    refused(&out, &thinned, &words, &left);
    refused(&out, &["isolate", "amp-F_Cu.gbr", "-o", "a.ngc", "--paper", "--deny-warnings"], &words, &left);
    let probed = ["probe", "amp-F_Cu.gbr", "-o", "a.ngc", "--dialect", "linuxcnc", "--deny-warnings"];
    refused(&out, &probed, &words, &left);
    let inspected = voromill(out.path(), &["inspect", "amp-F_Cu.gbr", "--format", "json", "--deny-warnings"]);
    assert_eq!(inspected.status.code(), Some(2), "inspect fails too");
    let report: serde_json::Value =
        serde_json::from_slice(&inspected.stdout).expect("but says what it found");
    let all = report["warnings"].as_array().expect("a list");
    let warning = all.iter().find(|warning| warning["code"] == "missing-end-of-file").expect("this one");
    for key in ["file", "line", "column", "text"] {
        assert!(!warning["source"][key].is_null(), "a place that programs can read has its {key}: {warning}");
    }
    let blinker = fixture("boards/blinker");
    let clean = voromill(out.path(), &["inspect", &blinker.to_string_lossy(), "--deny-warnings"]);
    assert!(clean.status.success(), "a board without warnings: {}", stderr(&clean));
}

#[test]
fn a_drill_file_that_calls_itself_copper_is_a_contradiction() {
    let out = folder();
    let copper = fs::read(fixture("boards/blinker/blinker-B_Cu.gbr")).expect("the fixture");
    fs::write(out.path().join("blinker.drl"), copper).expect("written");
    let words = ["named like a drill file", "--back"];
    fails(&out, &["mill", "blinker.drl", "-o", "out"], &words, &["blinker.drl"]);
}

#[test]
fn gaps_of_the_outline_are_closed_as_far_as_told() {
    let out = folder();
    let copper = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,1*%\nD10*\nX5000000Y5000000D03*\nM02*\n";
    fs::write(out.path().join("amp-F_Cu.gbr"), copper).expect("written");
    let edge = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.1*%\nD10*\nX0Y0D02*\nX10000000D01*\nY10000000D01*\nX0D01*\nY300000D01*\nM02*\n";
    fs::write(out.path().join("amp-Edge_Cuts.gbr"), edge).expect("written");
    let inspect = |more: &[&str]| stdout(&voromill(out.path(), &[&["inspect", "."], more].concat()));
    assert!(inspect(&[]).contains("[outline-open]"), "0.3 mm are too far: {}", inspect(&[]));
    let closed = inspect(&["--outline-gap", "0.5mm"]);
    assert!(
        closed.contains("a gap of 0.3") && !closed.contains("outline-open"),
        "closed, and said: {closed}"
    );
}

#[test]
fn a_cache_key_tells_apart_what_is_written() {
    let folder = TempDir::new().expect("a folder");
    let board = fixture("boards/blinker").to_string_lossy().into_owned();
    let key = |more: &[&str]| {
        let output = voromill(folder.path(), &[&["mill", &board, "--cache-key"], more].concat());
        assert!(output.status.success(), "{more:?}: {}", stderr(&output));
        stdout(&output)
    };
    let keys = [key(&[]), key(&["--svg"]), key(&["--no-html"]), key(&["--no-verify"])];
    let different: std::collections::BTreeSet<_> = keys.iter().collect();
    assert_eq!(different.len(), keys.len(), "each writes something else: {keys:?}");
    assert_eq!(key(&["--deny", "warning"]), keys[0], "an exit code is not among the outputs");
    assert!(listing(folder.path()).is_empty(), "and nothing is made");
}

#[test]
fn a_cache_key_tells_apart_how_files_are_read_and_what_is_in_those_that_settings_name() {
    let folder = folder();
    let key = |file: &str, more: &[&str]| {
        let output = voromill(folder.path(), &[&["mill", file, "--cache-key"], more].concat());
        assert!(output.status.success(), "{more:?}: {}", stderr(&output));
        stdout(&output)
    };
    let drawn = image::GrayImage::from_fn(300, 200, |x, y| {
        let is_ink = (20..120).contains(&x) && (20..150).contains(&y) || (180..190).contains(&x);
        image::Luma([if is_ink { 0 } else { 255 }])
    });
    drawn.save(folder.path().join("board.png")).expect("written");
    let copper = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,1*%\nD10*\nX5000000Y5000000D03*\nX8000000D03*\nM02*\n";
    fs::write(folder.path().join("amp-F_Cu.gbr"), copper).expect("written");
    let ways: [&[&str]; 5] = [
        &["--picture-dpi", "600"],
        &["--picture-dpi", "1000"],
        &["--picture-width", "30mm"],
        &["--picture-dpi", "600", "--invert"],
        &["--picture-dpi", "600", "--crop", "10,10,200,150"],
    ];
    let keys: std::collections::BTreeSet<String> = ways.iter().map(|more| key("board.png", more)).collect();
    assert_eq!(keys.len(), ways.len(), "each is another board");
    let areas = |gerber: &str| {
        fs::write(folder.path().join("areas.gbr"), gerber).expect("written");
        key("amp-F_Cu.gbr", &["--clear-area", "areas.gbr"])
    };
    let first = areas(copper);
    assert_eq!(first, areas(copper), "the same");
    assert_ne!(first, areas(&copper.replace("X5000000", "X6000000")), "other areas");
}

/// What would be one name for all boards lets one overwrite the other.
#[test]
fn names_in_any_script_stay_as_they_are() {
    let out = folder();
    let copper = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,1*%\nD10*\nX5000000Y5000000D03*\nX8000000D03*\nM02*\n";
    for name in ["дом", "сад", "基板"] {
        fs::write(out.path().join(format!("{name}-F_Cu.gbr")), copper).expect("written");
        let done = voromill(out.path(), &["mill", &format!("{name}-F_Cu.gbr"), "-o", "out", "--no-html"]);
        assert!(done.status.success(), "{}", stderr(&done));
        let program = fs::read_to_string(out.path().join(format!("out/{name}-front.ngc"))).expect("its name");
        assert!(program.is_ascii(), "no controller has to read it: {program}");
    }
}

#[test]
fn a_controller_that_takes_no_comments_is_milled_for() {
    let out = folder();
    fs::write(out.path().join("mute.toml"), "name = \"mute\"\nbase = \"grbl\"\ncomments = \"none\"\n")
        .expect("written");
    let board = fixture("boards/regulator").to_string_lossy().into_owned();
    let done = voromill(out.path(), &["mill", &board, "-o", "out", "--dialect", "mute.toml"]);
    assert!(stdout(&done).contains("nothing found"), "{}{}", stdout(&done), stderr(&done));
    let program = fs::read_to_string(out.path().join("out/regulator-front.ngc")).expect("a program");
    assert!(!program.contains(['(', ';']), "{program}");
}

#[test]
fn a_file_that_is_named_twice_is_judged_once() {
    let out = folder();
    let board = fixture("boards/blinker").to_string_lossy().into_owned();
    assert!(voromill(out.path(), &["mill", &board, "-o", "out", "-q"]).status.success());
    let judged = voromill(out.path(), &["verify", "out", "out/blinker-back.ngc", "--board", &board]);
    assert!(stdout(&judged).contains("verified 7 programs"), "{}", stdout(&judged));
}

#[test]
fn pictures_are_not_written_as_what_they_are_not() {
    let out = folder();
    for name in ["a.nc", "b.nc"] {
        fs::write(out.path().join(name), "G21 G90\nG0 Z2\nM2\n").expect("written");
    }
    fails(&out, &["diff", "a.nc", "b.nc", "-o", "c.jpg"], &["not written as .jpg"], &["a.nc", "b.nc"]);
    let plate = fixture("outline/strokes_touch.gbr").to_string_lossy().into_owned();
    let pocket =
        ["pocket", &plate, "--tool", "endmill:1mm", "--depth", "1mm", "-o", "p.ngc", "--picture", "p.webp"];
    fails(&out, &pocket, &["not written as .webp"], &["a.nc", "b.nc"]);
}

/// A square of 10 mm on a layer.
const PLATE: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
 width="20mm" height="20mm" viewBox="0 0 20 20"><g inkscape:groupmode="layer" inkscape:label="Holes" id="Holes">
 <rect x="5" y="5" width="10" height="10"/></g></svg>"#;

/// Whoever names the same file twice keeps it.
#[test]
fn what_all_is_made_from_is_never_replaced() {
    let out = folder();
    let path = |name: &str| out.path().join(name);
    fs::copy(fixture("gerber/clear_polarity.gbr"), path("a-F_Cu.gbr")).expect("copied");
    let plate = b"(loop)\nG21 G90\nG0 Z2\nG0 X0 Y0\nG1 Z-0.1 F60\nG1 X1\nG0 Z2\nM2\n";
    fs::write(path("a.nc"), plate).expect("written");
    fs::create_dir(path("board")).expect("made");
    fs::copy(path("a-F_Cu.gbr"), path("board/a-F_Cu.gbr")).expect("copied");
    fs::write(path("plate.svg"), PLATE).expect("written");
    fs::write(path("b.nc"), "G21 G90\nG0 Z2\nM2\n").expect("written");
    fs::write(path("map.xyz"), "-5 -5 0\n5 -5 0\n-5 5 0\n5 5 0.1\n").expect("written");
    for arguments in [
        &["isolate", "a-F_Cu.gbr", "-o", "a-F_Cu.gbr"][..],
        &["draw", "a-F_Cu.gbr", "--format", "png", "-o", "./a-F_Cu.gbr"],
        &["probe", "a-F_Cu.gbr", "-o", "a-F_Cu.gbr", "--dialect", "linuxcnc"],
        &["pocket", "a-F_Cu.gbr", "--tool", "endmill:0.1mm", "--depth", "0.1mm", "-o", "a-F_Cu.gbr"],
        &["diff", "a.nc", "b.nc", "--tool", "endmill:0.2mm", "-o", "b.nc"],
        &["level", "a.nc", "--map", "map.xyz", "-o", "map.xyz"],
        &["level", "a.nc", "--map", "map.xyz", "-o", "a.nc"],
        &["isolate", "board", "-o", "board/a-F_Cu.gbr"],
        &["mask", "board", "--what", "copper", "-o", "board/a-F_Cu.gbr"],
        &["draw", "board", "--format", "png", "-o", "board/a-F_Cu.gbr"],
        &["probe", ".", "-o", "board/a-F_Cu.gbr", "--dialect", "linuxcnc"],
        &["pocket", "plate.svg#Holes", "--tool", "endmill:1mm", "--depth", "1mm", "-o", "plate.svg"],
    ] {
        let last = |name: &&&str| path(name).is_file();
        let target = arguments.iter().rfind(last).expect("a file");
        let before = fs::read(path(target)).expect("read");
        let refused = voromill(out.path(), arguments);
        let said = stderr(&refused);
        assert!(refused.status.code() == Some(2) && said.contains("would be lost"), "{arguments:?}: {said}");
        assert_eq!(fs::read(path(target)).expect("read"), before, "{arguments:?}");
    }
}

/// A comment in an encoding of old stays as it is, byte for byte.
#[test]
fn levelling_leaves_the_bytes_of_comments() {
    let out = folder();
    let text = b"(Fr\xe4ser 0.2 \xb5m)\nG21 G90\nG0 Z2\nG0 X0 Y0\nG1 Z-0.1 F60\nG1 X1\nG0 Z2\nM2\n";
    fs::write(out.path().join("a.nc"), text).expect("written");
    fs::write(out.path().join("map.xyz"), "-5 -5 0\n5 -5 0\n-5 5 0\n5 5 0.1\n").expect("written");
    let done = voromill(out.path(), &["level", "a.nc", "--map", "map.xyz", "-o", "b.nc"]);
    assert!(done.status.success(), "{}", stderr(&done));
    let levelled = fs::read(out.path().join("b.nc")).expect("a program");
    assert!(levelled.starts_with(b"(Fr\xe4ser 0.2 \xb5m)\n"), "{:?}", &levelled[..20]);
}

#[test]
fn errors_of_programs_are_printed_where_errors_alone_are() {
    let out = folder();
    let board = fixture("boards/regulator").to_string_lossy().into_owned();
    for (arguments, code) in [
        (&["mill", &board, "-o", "out", "-q", "--tool", "endmill:1mm"][..], 1),
        (&["verify", "out", "--board", &board, "-q"], 1),
        (&["mill", &board, "-o", "good", "-q"], 0),
        (&["verify", "good", "--board", &board, "-q"], 0),
    ] {
        let done = voromill(out.path(), arguments);
        let said = stderr(&done);
        assert_eq!((done.status.code(), stdout(&done).as_str()), (Some(code), ""), "{arguments:?}: {said}");
        assert_eq!(said.contains("[gouge]"), code == 1, "{arguments:?}: {said}");
        assert!(!said.contains("warning"), "{arguments:?}: {said}");
    }
}

#[test]
fn what_is_a_program_for_one_command_is_one_for_the_other() {
    let out = folder();
    let path = |name: &str| out.path().join(name);
    for folder in ["old", "new"] {
        fs::create_dir(path(folder)).expect("made");
    }
    for (index, ending) in
        ["ngc", "nc", "gcode", "gco", "gc", "g", "cnc", "tap", "iso", "NGC"].iter().enumerate()
    {
        let text =
            |x: usize| format!("G21 G90\nM3 S1000\nG0 Z2\nG0 X0 Y0\nG1 Z-0.1 F100\nX{x} F200\nG0 Z2\nM2\n");
        fs::write(path(&format!("old/x{index}.{ending}")), text(5)).expect("written");
        fs::write(path(&format!("new/x{index}.{ending}")), text(6)).expect("written");
    }
    let compared = voromill(out.path(), &["diff", "old", "new", "--tool", "endmill:0.2mm"]);
    assert_eq!(stdout(&compared).matches("more cut away").count(), 10, "{}", stdout(&compared));
    let board = fixture("boards/blinker").to_string_lossy().into_owned();
    let judged = ["verify", "old", "--board", &board, "--tool", "endmill:0.2mm", "--side", "back"];
    let judged = voromill(out.path(), &judged);
    assert!(stdout(&judged).contains("verified 10 programs"), "{}{}", stdout(&judged), stderr(&judged));
}

#[test]
fn a_judge_that_is_asked_about_what_is_not_there_says_so() {
    let out = folder();
    let board = fixture("boards/blinker").to_string_lossy().into_owned();
    assert!(voromill(out.path(), &["mill", &board, "-o", "out", "-q"]).status.success());
    for (option, value, said) in [
        ("--distance-for", "VINN=2mm", "no net is called `VINN`"),
        ("--clear-nets", "VINN", "no net is called `VINN`"),
        ("--clear-area", "500mm,500mm,3mm,3mm", "not on the board"),
        ("--keep-area", "500mm,500mm,3mm,3mm", "not on the board"),
    ] {
        fails(&out, &["verify", "out", "--board", &board, option, value], &[said], &["out"]);
    }
    let all = voromill(out.path(), &["verify", "out", "--board", &board, "--ignore", "NOPE"]);
    assert!(all.status.success() && stderr(&all).contains("no net is called `NOPE`"), "{}", stderr(&all));
}

#[test]
fn files_named_for_what_they_are_need_no_folder_beside_them() {
    let folder = TempDir::new().expect("a folder");
    let board = fixture("boards/blinker");
    let file = |name: &str| board.join(name).to_str().expect("a name").to_owned();
    let (back, outline) = (file("blinker-B_Cu.gbr"), file("blinker-Edge_Cuts.gbr"));
    let arguments = ["inspect", "--back", &back, "--outline", &outline];
    let output = voromill(folder.path(), &arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(said.contains("back") && !said.contains("drill"), "a back and an outline alone: {said}");
    fails(&folder, &["inspect", "--outline", &outline], &["required"], &[]);
}

/// Not that `-0` is no option.
#[test]
fn a_number_below_zero_is_refused_as_what_it_is() {
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/blinker").display().to_string();
    for (option, value, says) in [
        ("--width", "-0.5mm", "width"),
        ("--safe-z", "-1mm", "safe-z"),
        ("--tabs", "-1", "--tabs"),
        ("--spindle", "-5", "not a spindle speed"),
        ("--feed", "-5mm/min", "--feed"),
    ] {
        let refused = voromill(Path::new("."), &["mill", &board, "-o", "never", option, value]);
        let said = stderr(&refused);
        assert_eq!(refused.status.code(), Some(2), "{option} {value}");
        assert!(said.contains(says) && said.contains(value), "{option} {value}: {said}");
        assert!(!said.contains("unexpected argument"), "{option} {value}: {said}");
    }
    let forgotten = voromill(Path::new("."), &["mill", &board, "-o", "never", "--width", "--no-html"]);
    assert!(stderr(&forgotten).contains("'--no-html' for '--width <LENGTH>'"), "{}", stderr(&forgotten));
}
