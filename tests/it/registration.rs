//! Layers and drill files that do not lie on each other: exported with different origins, or
//! mirrored.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use voromill::import::{self, Loaded, Selection};

use crate::corpus;

/// The files of a fixture, each as `change` has it.
fn changed(board: &str, change: impl Fn(&str, String) -> String) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    let fixture = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(board);
    for entry in fs::read_dir(fixture).expect("a fixture") {
        let path = entry.expect("a file").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if name.ends_with(".gbr") || name.ends_with(".drl") {
            let text = change(&name, fs::read_to_string(&path).expect("a text"));
            fs::write(folder.path().join(name), text).expect("written");
        }
    }
    folder
}

/// Each x at the beginning of a line, changed.
fn each_x(text: &str, change: impl Fn(f64) -> f64) -> String {
    let line = |line: &str| {
        let Some(rest) = line.strip_prefix('X') else { return line.to_owned() };
        let end = rest.find('Y').unwrap_or(rest.len());
        let Ok(x) = rest[..end].parse::<f64>() else { return line.to_owned() };
        let digits = if rest[..end].contains('.') { 3 } else { 0 };
        format!("X{:.digits$}{}", change(x), &rest[end..])
    };
    text.lines().map(|text| line(text) + "\n").collect()
}

fn load(folder: &TempDir, selection: &Selection) -> Result<Loaded, String> {
    import::load(&[folder.path().to_path_buf()], selection).map_err(|error| error.to_string())
}

fn said(loaded: &Loaded) -> Vec<&str> {
    let said = loaded.warnings.iter().filter(|warning| warning.code() == "layers-not-registered");
    said.map(|warning| warning.message.as_str()).collect()
}

#[test]
fn holes_that_were_exported_with_another_origin_are_refused_unless_chosen() {
    for (moved, now) in [(0.0, 43), (0.09, 43), (0.3, 0), (1.27, 0), (5.0, 2)] {
        let folder =
            changed(
                "blinker",
                |name, text| {
                    if name.ends_with(".drl") { each_x(&text, |x| x + moved) } else { text }
                },
            );
        let chosen = Selection { drill: vec![PathBuf::from("blinker-PTH.drl")], ..Selection::default() };
        let loaded = load(&folder, &chosen).expect("a person knows better");
        let told = load(&folder, &Selection::default());
        if now == 43 {
            assert_eq!(said(&told.expect("on their pads")), [""; 0], "{moved} mm");
            assert_eq!(said(&loaded), [""; 0], "{moved} mm");
            continue;
        }
        let what = format!(
            "{now} of 43 holes lie on pads, and 43 would if they were moved by {:.3}, 0.000 mm",
            -moved
        );
        let error = told.expect_err("refused");
        assert!(error.contains("blinker-PTH.drl") && error.contains(&what), "{moved} mm: {error}");
        assert_eq!(said(&loaded), [what], "{moved} mm");
    }
}

/// Copper mirrored about x = 130 mm, which is the middle of the one board and not of the other.
#[test]
fn a_layer_that_was_plotted_mirrored_is_refused_unless_chosen() {
    let mirrored = |board: &str, layer: &'static str| {
        changed(board, |name, text| {
            let is_it = name.contains(layer);
            if is_it { each_x(&text, |x| 260_000_000.0 - x).replace("G02*", "G03*") } else { text }
        })
    };
    for (board, layer, file, what) in [
        (
            "blinker",
            "B_Cu",
            "blinker-PTH.drl",
            "0 of 43 holes lie on pads, and 43 would if they were mirrored",
        ),
        (
            "regulator",
            "B_Cu",
            "regulator-B_Cu.gbr",
            "32 of 68 through-hole pads of the front lie on pads of this layer, and 68 would if it were mirrored",
        ),
        (
            "regulator",
            "F_Cu",
            "regulator-F_Cu.gbr",
            "32 of 68 through-hole pads of the back lie on pads of this layer, and 68 would if it were mirrored",
        ),
    ] {
        let folder = mirrored(board, layer);
        let error = load(&folder, &Selection::default()).expect_err("refused");
        assert!(error.contains(file) && error.contains(what), "{board} {layer}: {error}");
        let chosen = Some(PathBuf::from(file));
        let selection = match (board, layer) {
            ("blinker", _) => Selection { drill: chosen.into_iter().collect(), ..Selection::default() },
            (_, "B_Cu") => Selection { back: chosen, ..Selection::default() },
            _ => Selection { front: chosen, ..Selection::default() },
        };
        assert_eq!(
            said(&load(&folder, &selection).expect("a person knows better")),
            [what],
            "{board} {layer}"
        );
        let surveyed = import::survey(&[folder.path().to_path_buf()], &Selection::default());
        assert_eq!(said(&surveyed.expect("looked at")), [what], "{board} {layer}");
    }
}

#[test]
fn few_holes_and_holes_without_pads_say_nothing() {
    // Nine holes are left.
    let few = |name: &str, text: String| {
        let mut left = 9;
        let keep = |line: &&str| {
            let is_hole = name.ends_with(".drl") && line.starts_with('X');
            left -= i32::from(is_hole);
            !is_hole || left >= 0
        };
        let text: String = text.lines().filter(keep).map(|line| line.to_owned() + "\n").collect();
        if name.ends_with(".drl") { each_x(&text, |x| x + 1.27) } else { text }
    };
    let loaded = load(&changed("blinker", few), &Selection::default()).expect("too few to be sure");
    assert_eq!(said(&loaded), [""; 0], "nine holes");
    let unplated = |name: &str, text: String| {
        let moved = if name.ends_with(".drl") { each_x(&text, |x| x + 1.27) } else { text };
        moved.replace(",Plated,", ",NonPlated,")
    };
    let loaded = load(&changed("blinker", unplated), &Selection::default()).expect("they have no pads");
    assert_eq!(said(&loaded), [""; 0], "not plated");
}

#[test]
fn layers_of_real_boards_lie_on_each_other() {
    for folder in corpus::board_folders() {
        let Ok(loaded) = import::survey(std::slice::from_ref(&folder), &Selection::default()) else {
            continue;
        };
        assert_eq!(said(&loaded), [""; 0], "{}", folder.display());
    }
}

#[test]
fn through_hole_pads_without_a_hole_are_told() {
    let said = |folder: &TempDir, selection: &Selection| {
        let loaded = load(folder, selection).expect("a board");
        let said = loaded.warnings.into_iter().filter(|warning| warning.code() == "pads-without-holes");
        said.map(|warning| warning.message).collect::<Vec<_>>()
    };
    let as_usual = Selection::default();
    let without = |board: &str, file: &'static str| {
        let folder = changed(board, |_, text| text);
        for entry in fs::read_dir(folder.path()).expect("a folder") {
            let path = entry.expect("a file").path();
            if path.to_string_lossy().contains(file) {
                fs::remove_file(path).expect("removed");
            }
        }
        folder
    };
    assert_eq!(said(&without("blinker", "none"), &as_usual), [""; 0], "all are there");
    assert_eq!(
        said(&without("blinker", ".drl"), &as_usual),
        ["43 of 43 through-hole pads have no hole"],
        "none"
    );
    assert_eq!(
        said(&without("blinker", "-PTH"), &as_usual),
        ["43 of 43 through-hole pads have no hole"],
        "others"
    );
    let no_drill = Selection { no_drill: true, ..Selection::default() };
    assert_eq!(said(&without("blinker", ".drl"), &no_drill), [""; 0], "as a person wants it");
    // A drill file of the revision before.
    let old = changed("blinker", |name, text| {
        if name.ends_with("-PTH.drl") { text.replacen("X3.81Y11.43", "X5.5Y11.43", 1) } else { text }
    });
    assert_eq!(said(&old, &as_usual).len(), 1, "a hole elsewhere: {:?}", said(&old, &as_usual));
    // Files without attributes: round pads on both sides.
    let plain = |text: String| {
        let lines = text.lines().filter(|line| !line.contains("AperFunction"));
        lines.map(|line| line.to_owned() + "\n").collect::<String>()
    };
    let folder = changed("regulator", |name, text| if name.ends_with(".gbr") { plain(text) } else { text });
    assert_eq!(said(&folder, &as_usual), [""; 0], "all are there");
    for file in ["regulator-PTH.drl", "regulator-NPTH.drl"] {
        let _ = fs::remove_file(folder.path().join(file));
    }
    let told = said(&folder, &as_usual);
    assert!(told.len() == 1 && told[0].ends_with("through-hole pads have no hole"), "{told:?}");
    // Who names single files wants no others.
    let files = ["regulator-F_Cu.gbr", "regulator-B_Cu.gbr"].map(|name| folder.path().join(name));
    let loaded = import::load(&files, &as_usual).expect("a board");
    assert!(loaded.warnings.iter().all(|warning| warning.code() != "pads-without-holes"), "single files");
}
