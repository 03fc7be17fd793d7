//! Every file of a folder or an archive is accounted for: what is meant as a layer and cannot be
//! read is an error that names it and how to leave it aside.

use std::fs;
use std::path::PathBuf;

use voromill::import::{Loaded, Selection, load};

use crate::layers::{DRILL, Folder, SQUARE, files_of, zipped};

/// A board of two sides with holes, as KiCad names its files.
fn board() -> Folder {
    Folder::with(&[
        ("amp-F_Cu.gbr", SQUARE),
        ("amp-B_Cu.gbr", SQUARE),
        ("amp-Edge_Cuts.gbr", SQUARE),
        ("amp.drl", DRILL),
    ])
}

/// What is said of the board with `name` written anew; the message must tell how to leave it aside,
/// and that must do.
fn refused(name: &str, bytes: &[u8]) -> String {
    let folder = board();
    fs::write(folder.path(name), bytes).expect("written");
    is_refused(&folder, name)
}

fn is_refused(folder: &Folder, name: &str) -> String {
    let error = folder.load(&Selection::default()).expect_err(name);
    assert!(error.contains(name) && error.contains(&format!("--skip {name}")), "{name}: {error}");
    let loaded = folder.load(&skipping(name)).unwrap_or_else(|error| panic!("{name} is skipped: {error}"));
    assert!(loaded.ignored.iter().any(|ignored| ignored == name), "{name} is listed: {:?}", loaded.ignored);
    error
}

fn skipping(name: &str) -> Selection {
    Selection { skip: vec![PathBuf::from(name)], ..Selection::default() }
}

fn codes(loaded: &Loaded) -> Vec<&'static str> {
    loaded.warnings.iter().map(|warning| warning.code()).collect()
}

#[test]
fn a_layer_that_cannot_be_read_is_an_error_that_says_how_to_leave_it_aside() {
    let cases: [(&[u8], &str); 5] = [
        (b"", "an empty file"),
        (&[0; 400], "an empty file"),
        (b"<!DOCTYPE html>\n<html><body>404</body></html>\n", "a web page"),
        (b"Dear manufacturer, see the other file.\n", "a text file of unknown type"),
        (b"G04 #@! TF.FileFunction,Copper,L2,Bot*\nG04 made by hand*\n", "it is truncated"),
    ];
    for (bytes, what) in cases {
        let error = refused("amp-B_Cu.gbr", bytes);
        assert!(error.contains(what), "says what it is, {what}: {error}");
    }
    let error = refused("amp-B_Cu.gbr", b"");
    assert!(error.contains("by its name it should be the copper of the back"), "{error}");
    assert!(refused("amp-Edge_Cuts.gbr", b"").contains("the outline"), "so with an outline");
    assert!(refused("amp-new.gbr", b"").contains("a layer"), "and with an extension alone");
}

#[test]
fn a_damaged_drill_file_is_an_error() {
    for damaged in ["", "\u{1}48\nMETRIC\nT1C0.8\n%\nT1\nX5.0Y5.0\nM30\n", "M48\nMETRIC\nT1C0.8\n"] {
        refused("amp.drl", damaged.as_bytes());
    }
    // Where the name tells nothing, its lines do.
    let many = DRILL.replace("M48", "@48").replace("X5.0Y5.0", "X5.0Y5.0\nX6.0Y5.0\nX7.0Y5.0");
    let error = refused("data.txt", many.as_bytes());
    assert!(error.contains("a drill file"), "{error}");
}

#[test]
fn what_a_job_file_or_an_attribute_calls_a_layer_must_be_readable() {
    let job = r#"{"FilesAttributes": [{"Path": "amp.dat", "FileFunction": "Copper,L2,Bot"}]}"#;
    let folder = Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("amp.gbrjob", job), ("amp.dat", "oops")]);
    assert!(is_refused(&folder, "amp.dat").contains("by the job file"), "by the job file");
    let text = "; #@! TF.FileFunction,Plated,1,2,PTH\n; made by hand\n";
    assert!(refused("holes.dat", text.as_bytes()).contains("its file function"), "by its attribute");
}

#[cfg(unix)]
#[test]
fn folders_links_to_nothing_and_pipes_named_like_layers_are_errors() {
    let folder = board();
    fs::remove_file(folder.path("amp-B_Cu.gbr")).expect("removed");
    std::os::unix::fs::symlink("elsewhere.gbr", folder.path("amp-B_Cu.gbr")).expect("linked");
    assert!(is_refused(&folder, "amp-B_Cu.gbr").contains("a broken link"), "a dangling link");
    fs::remove_file(folder.path("amp-B_Cu.gbr")).expect("removed");
    fs::create_dir(folder.path("amp-B_Cu.gbr")).expect("made");
    assert!(is_refused(&folder, "amp-B_Cu.gbr").contains("a folder"), "a folder");
    fs::remove_dir(folder.path("amp-B_Cu.gbr")).expect("removed");
    let made = std::process::Command::new("mkfifo").arg(folder.path("amp-B_Cu.gbr")).status();
    assert!(made.expect("mkfifo runs").success(), "a pipe is made");
    assert!(is_refused(&folder, "amp-B_Cu.gbr").contains("a pipe"), "a pipe, without waiting for a writer");
    let error = load(&[folder.path("amp-B_Cu.gbr")], &Selection::default()).expect_err("a pipe");
    assert!(error.to_string().contains("a pipe"), "nor where it is named: {error}");
}

#[test]
fn a_file_whose_name_and_content_contradict_each_other_is_an_error() {
    let folder = board();
    fs::write(folder.path("amp.drl"), SQUARE).expect("written");
    assert!(is_refused(&folder, "amp.drl").contains("a Gerber file"), "a layer named like a drill file");
    let folder = board();
    fs::write(folder.path("amp-B_Cu.gbr"), DRILL.replace("5.0", "7.0")).expect("written");
    assert!(
        is_refused(&folder, "amp-B_Cu.gbr").contains("an Excellon drill file"),
        "and the other way round"
    );
}

#[test]
fn a_drill_file_named_like_a_layer_by_its_words_is_an_error() {
    let drill = DRILL.replace("5.0", "7.0");
    let folder = Folder::with(&[("a_group1.grb", SQUARE), ("a_group2.grb", &drill), ("a_holes.drl", DRILL)]);
    assert!(
        is_refused(&folder, "a_group2.grb").contains("named like a layer"),
        "an error, not one side less"
    );
}

#[test]
fn a_person_who_named_the_layer_needs_no_other() {
    let folder = board();
    fs::write(folder.path("amp-back.txt"), [1, 2, 3]).expect("written");
    let back = Selection { back: Some(folder.path("amp-B_Cu.gbr")), ..Selection::default() };
    assert_eq!(files_of(&folder.load(&back).expect("chosen"), "back-copper"), ["amp-B_Cu.gbr"], "as chosen");
    folder.load(&Selection::default()).expect_err("else it could be the back");
}

#[test]
fn options_of_pcb2gcode_beside_a_board_are_told_of() {
    let folder = board();
    fs::write(folder.path("millproject"), "metric = true\nzwork = -0.05\n").expect("written");
    let loaded = folder.load(&Selection::default()).expect("a board");
    assert_eq!(codes(&loaded), ["file-not-understood"], "told: {:?}", loaded.warnings);
    assert!(loaded.warnings[0].text().contains("options of pcb2gcode"), "what it is: {:?}", loaded.warnings);
}

#[test]
fn odd_extras_are_notes() {
    let folder = board();
    for name in ["README", "parts.pdf", "amp-front.png", "amp-F_Mask.gbr", "amp.kicad_pro", "amp-top.pos"] {
        fs::write(folder.path(name), "").expect("written");
    }
    // What this program has written before lies in the same folder.
    fs::write(folder.path("amp-drill.tap"), "(amp drill)\nG21\nG0 Z5\nG0 X1 Y1\nG1 Z-2\nM2\n")
        .expect("written");
    fs::write(folder.path("front.txt"), "These are the files of the front, made by me.\n").expect("written");
    let loaded = folder.load(&Selection::default()).expect("a board");
    assert_eq!(loaded.ignored.len(), 8, "each is listed: {:?}", loaded.ignored);
    assert_eq!(codes(&loaded), ["file-not-understood"], "README is empty: {:?}", loaded.warnings);
}

#[test]
fn a_folder_beside_the_files_that_is_named_like_a_layer_is_warned_of() {
    let folder = board();
    fs::create_dir(folder.path("drill")).expect("made");
    assert_eq!(codes(&folder.load(&Selection::default()).expect("a board")), ["folder-not-read"], "a word");
    assert!(codes(&folder.load(&skipping("drill")).expect("a board")).is_empty(), "none where it is skipped");
}

#[test]
fn a_binary_drill_file_beside_its_text_is_warned_of_and_alone_an_error() {
    // Bytes with an odd number of bits each, as on paper tape.
    let tape = [0x01, 0x02, 0x80, 0x37, 0x38, 0x80];
    let folder = Folder::with(&[("amp.gtl", SQUARE), ("amp.TXT", DRILL)]);
    fs::write(folder.path("amp.DRL"), tape).expect("written");
    assert_eq!(
        codes(&folder.load(&Selection::default()).expect("a board"))[..1],
        ["binary-drill-file"],
        "a word"
    );
    fs::remove_file(folder.path("amp.TXT")).expect("removed");
    is_refused(&folder, "amp.DRL");
}

#[test]
fn what_is_to_be_skipped_must_be_there() {
    let error = board().load(&skipping("amp-B_Cu.gbx")).expect_err("a slip of the pen");
    assert!(error.contains("amp-B_Cu.gbx") && error.contains("--skip"), "{error}");
    let loaded = board().load(&skipping("amp-B_Cu.gbr")).expect("a board");
    assert!(loaded.board.back.is_none(), "a layer that could be read is skipped too");
}

#[test]
fn texts_with_a_byte_order_mark_or_of_two_bytes_a_character_are_read() {
    let wide =
        |text: &str, bytes: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(bytes).collect::<Vec<u8>>();
    for bytes in [
        format!("\u{feff}{SQUARE}").into_bytes(),
        wide(&format!("\u{feff}{SQUARE}"), u16::to_le_bytes),
        wide(&format!("\u{feff}{SQUARE}"), u16::to_be_bytes),
        wide(SQUARE, u16::to_le_bytes),
        wide(SQUARE, u16::to_be_bytes),
    ] {
        let folder = board();
        fs::write(folder.path("amp-B_Cu.gbr"), &bytes).expect("written");
        let loaded =
            folder.load(&Selection::default()).unwrap_or_else(|error| panic!("{:?}: {error}", &bytes[..4]));
        let plain = board().load(&Selection::default()).expect("a board");
        assert_eq!(format!("{:?}", loaded.board), format!("{:?}", plain.board), "the same board");
        assert!(loaded.warnings.is_empty(), "and nothing to say: {:?}", loaded.warnings);
    }
}

#[test]
fn entries_of_an_archive_are_accounted_for_too() {
    let folder = Folder::with(&[]);
    let path = folder.path("amp.zip");
    let (copper, drill) = (SQUARE.as_bytes(), DRILL.as_bytes());
    let loaded = |archive: Vec<u8>, selection: &Selection| {
        fs::write(&path, archive).expect("written");
        load(std::slice::from_ref(&path), selection).map_err(|error| error.to_string())
    };
    let empty = || zipped(&[("out/top.gbr", copper), ("out/amp-B_Cu.gbr", b""), ("out/holes.drl", drill)]);
    let error = loaded(empty(), &Selection::default()).expect_err("an empty back");
    assert!(error.contains("amp.zip/out/amp-B_Cu.gbr: an empty file"), "{error}");
    loaded(empty(), &skipping("amp-B_Cu.gbr")).expect("skipped by its name");
    loaded(empty(), &skipping("out/amp-B_Cu.gbr")).expect("or by its path");
    // The second entry gets the first one's name: the writer refuses to write it so.
    let other = SQUARE.replace("C,0.2", "C,0.3");
    for (second, is_error) in [(other.as_bytes(), true), (copper, false)] {
        let mut archive = zipped(&[("top.gbr", copper), ("tip.gbr", second), ("holes.drl", drill)]);
        let places: Vec<usize> =
            (0..archive.len() - 7).filter(|&at| archive[at..].starts_with(b"tip.gbr")).collect();
        places.iter().for_each(|&at| archive[at + 1] = b'o');
        let found = loaded(archive, &Selection::default());
        let told =
            found.as_ref().is_err_and(|error| error.contains("two entries") && error.contains("top.gbr"));
        assert_eq!(told, is_error, "{found:?}");
    }
}
