//! What is no board: each of these once came from somebody, and each is told what it is and what to
//! do.

use std::fs;
use std::path::PathBuf;

use tempfile::TempDir;
use voromill::import::{Selection, load};

/// Writes `bytes` as `name` and returns what is said of it.
fn said(name: &str, bytes: &[u8]) -> String {
    let folder = TempDir::new().expect("a temporary folder");
    let path: PathBuf = folder.path().join(name);
    fs::write(&path, bytes).expect("written");
    match load(&[path], &Selection::default()) {
        Ok(loaded) => loaded
            .warnings
            .iter()
            .map(|warning| format!("{}: {}\n", warning.code(), warning.text()))
            .collect(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn what_is_no_board_is_told_what_it_is() {
    let cases: [(&str, &[u8], &str); 9] = [
        ("board.zip", b"<html><body>404 not found</body></html>", "a web page"),
        ("board.gbr", b"<!DOCTYPE html>\n<html>", "a web page"),
        ("notes.txt", b"Dear manufacturer,\n", "a text file of unknown type"),
        ("noise.gbr", b"\x01\x02\xfe\x03\x00\x7f\x80", "a file of unknown type"),
        ("board.kicad_sch", b"(kicad_sch (version 20221018))", "a KiCad schematic, not its board"),
        ("front.nc", b"G21\nG90\nG0 Z5\n", "a G-code program"),
        ("millproject", b"metric=true\nzwork=-0.05\n", "the options of pcb2gcode"),
        ("cut.zip", b"PK\x03\x04\x14\x00\x00\x00\x08\x00", "damaged or truncated"),
        ("empty.gbr", b"", "an empty file"),
    ];
    for (name, bytes, words) in cases {
        let message = said(name, bytes);
        assert!(message.contains(words), "{name} says `{words}`: {message}");
        assert!(message.starts_with('/') || message.contains(name), "{name} is named: {message}");
    }
}

#[test]
fn an_encrypted_archive_is_called_one() {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    zip.start_file("top.gbr", zip::write::SimpleFileOptions::default()).expect("an entry");
    std::io::Write::write_all(&mut zip, b"%MOMM*%\nM02*\n").expect("written");
    let mut bytes = zip.finish().expect("finished").into_inner();
    // The lowest bit of an entry's flags says that it is encrypted, in its own header and in the
    // directory.
    for (mark, flags) in [(b"PK\x03\x04", 6), (b"PK\x01\x02", 8)] {
        let at = bytes.windows(4).position(|window| window == mark).expect("a header");
        bytes[at + flags] |= 1;
    }
    let message = said("board.zip", &bytes);
    assert!(message.contains("encrypted") && message.contains("password"), "{message}");
}

#[test]
fn a_board_as_wide_as_a_table_is_doubted() {
    let inches = b"%FSLAX46Y46*%\n%MOIN*%\n%ADD10C,0.2*%\nD10*\nX0Y0D03*\nX36000000Y0D03*\nM02*\n";
    let message = said("amp-F_Cu.gbr", inches);
    assert!(message.contains("size-implausible") && message.contains("919.5"), "{message}");
}
