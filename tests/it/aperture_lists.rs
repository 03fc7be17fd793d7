//! RS-274-D: Gerber files whose apertures stand in a list beside them.

use std::path::{Path, PathBuf};

use voromill::board::Shape;
use voromill::import::{Error, Loaded, Selection, load};

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/rs274d").join(name)
}

fn board(paths: &[PathBuf]) -> Result<Loaded, Error> {
    load(paths, &Selection::default())
}

/// The board drawn by every fixture: a trace of 10 mils and an inch, with a pad of 60 × 75 mils at
/// either end.
#[track_caller]
fn is_drawn(loaded: &Loaded, what: &str) {
    let front = loaded.board.front.as_ref().unwrap_or_else(|| panic!("{what}: no copper"));
    let sizes: Vec<(i64, i64)> = front
        .features
        .iter()
        .map(|feature| feature.shape.bounds())
        .map(|bounds| (bounds.width().get(), bounds.height().get()))
        .collect();
    let pad = (1_524_000, 1_905_000);
    assert_eq!(sizes, [(25_654_000, 254_000), pad, pad], "{what}: in nanometres");
    assert!(matches!(front.features[0].shape, Shape::Stroke { .. }), "{what}: the trace stays a stroke");
}

#[test]
fn a_list_in_the_same_folder_is_found_whatever_its_layout() {
    for (name, list) in
        [("protel", "board.apt"), ("eagle", "board.whl"), ("pads", "top.rep"), ("gap", "wheel.gap")]
    {
        let loaded = board(&[folder(name)]).unwrap_or_else(|error| panic!("{name}: {}", error.render()));
        is_drawn(&loaded, name);
        let roles: Vec<(&str, &str)> =
            loaded.sources.iter().map(|source| (source.file.as_str(), source.role.as_str())).collect();
        assert!(roles.contains(&(list, "apertures")), "{name}: the list is among the sources: {roles:?}");
        assert_eq!(loaded.sources[0].format, "gerber-d", "{name}: and the layer is called what it is");
    }
}

#[test]
fn a_list_is_found_beside_a_file_that_is_named_alone() {
    let loaded = board(&[folder("protel").join("board.gtl")]).expect("a board");
    is_drawn(&loaded, "the file alone");
}

/// A comment that speaks of an address defines no aperture, and regions need none.
#[test]
fn what_draws_with_no_aperture_needs_no_list() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    let (one, two) = ("D10 ROUND 10\nD11 RECTANGLE 60 75\n", "D10 ROUND 12\nD11 RECTANGLE 60 75\n");
    write("one.apt", one);
    write("board.gtl", "G04 Board ADDRESS decoder*\n%FSLAX23Y23*%\nG70*\nD10*\nX1000Y1000D03*\nM02*\n");
    assert!(board(&[folder.path().to_path_buf()]).is_ok(), "the one list is for it");
    write("two.apt", two);
    let ambiguous = board(&[folder.path().to_path_buf()]).expect_err("either may be meant").render();
    assert!(ambiguous.contains("one.apt, two.apt"), "{ambiguous}");
    write("board.gtl", "%FSLAX23Y23*%\nG70*\nG36*\nX0Y0D02*\nX1000D01*\nY1000D01*\nX0Y0D01*\nG37*\nM02*\n");
    let loaded = board(&[folder.path().to_path_buf()]).expect("a region needs no list");
    assert!(loaded.sources.iter().all(|source| source.role != "apertures"), "and none is used");
}

#[test]
fn a_list_without_units_is_read_by_its_sizes_and_says_so() {
    let loaded = board(&[folder("protel")]).expect("a board");
    let warning = loaded.warnings.iter().find(|warning| warning.code() == "aperture-units-guessed");
    let message = &warning.expect("a warning").message;
    assert!(message.contains("board.apt") && message.contains("mil"), "{message}");
    let said = board(&[folder("eagle")]).expect("a board");
    assert!(said.warnings.iter().all(|w| w.code() != "aperture-units-guessed"), "a list that says its unit");
}

#[test]
fn what_a_list_leaves_open_is_an_error_that_says_what_is_missing() {
    for (name, words) in [
        ("two_lists", ["one.apt, two.apt", "rename the right one to"]),
        ("no_format", ["board.apt has a number format", "FORMAT 2.3"]),
        ("unclear", ["D11, which board.apt:2 does not define clearly", "a thermal"]),
    ] {
        let message = board(&[folder(name)]).expect_err(name).render();
        for word in words {
            assert!(message.contains(word), "{name} says `{word}`:\n{message}");
        }
    }
}
