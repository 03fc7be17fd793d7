//! Which file is what, and boards put together from folders, archives and single files.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use voromill::board::Hole;
use voromill::geometry::{Nm, Point};
use voromill::import::{Loaded, Selection, load};

#[expect(clippy::print_stderr, reason = "a test that skips says so")]
fn boards() -> Option<Vec<PathBuf>> {
    let folder =
        std::env::var_os("VOROMILL_BOARDS").map_or_else(|| PathBuf::from("../shared/boards"), PathBuf::from);
    if !folder.is_dir() {
        eprintln!("skipped: no boards in {} (set VOROMILL_BOARDS)", folder.display());
        return None;
    }
    let entries = fs::read_dir(&folder).expect("readable").map(|entry| entry.expect("an entry").path());
    let mut found: Vec<_> = entries.filter(|path| path.join("meta.json").is_file()).collect();
    found.sort();
    Some(found)
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("readable")).expect("JSON")
}

fn board(path: &Path) -> Loaded {
    load(&[path.to_owned()], &Selection::default())
        .unwrap_or_else(|e| panic!("{}:\n{}", path.display(), e.render()))
}

fn files_of(loaded: &Loaded, role: &str) -> Vec<String> {
    loaded.sources.iter().filter(|source| source.role == role).map(|source| source.file.clone()).collect()
}

fn names(value: &Value) -> Vec<String> {
    match value {
        Value::String(name) => vec![name.clone()],
        Value::Array(names) => names.iter().filter_map(Value::as_str).map(str::to_owned).collect(),
        _ => vec![],
    }
}

#[test]
fn every_board_loads_with_its_roles() {
    for path in boards().into_iter().flatten() {
        let loaded = board(&path);
        let layers = &json(&path.join("meta.json"))["layers"];
        for (role, key) in
            [("front-copper", "front"), ("back-copper", "back"), ("outline", "outline"), ("drill", "drill")]
        {
            let (mut found, mut expected) = (files_of(&loaded, role), names(&layers[key]));
            found.sort();
            expected.sort();
            assert_eq!(found, expected, "{}: {role}", path.display());
        }
        for warning in &loaded.warnings {
            eprintln!("{}: {}: {}", loaded.board.name, warning.code, warning.message);
        }
        let outline = loaded.board.outline.as_ref().map(|outline| {
            let bounds = outline.bounds();
            format!(
                "{} contours, {:.3} × {:.3} mm",
                outline.contours().len(),
                bounds.width(),
                bounds.height()
            )
        });
        eprintln!("{}: {} holes, outline {outline:?}", loaded.board.name, loaded.board.holes.len());
    }
}

/// Millimetres of a truth file, to the micrometre that it is rounded to.
fn point(value: &Value) -> Point {
    let nm = |v: &Value| Nm::from_f64(v.as_f64().expect("a number") * 1e6);
    Point::new(nm(&value[0]), nm(&value[1]))
}

fn near(a: Point, b: Point) -> bool {
    const ROUNDED: Nm = Nm::from_um(1);
    (a.x - b.x).abs() <= ROUNDED && (a.y - b.y).abs() <= ROUNDED
}

fn has_size(hole: &Hole, size: &Value) -> bool {
    let size = Nm::from_f64(size.as_f64().expect("a diameter") * 1e6);
    (hole.diameter - size).abs() <= Nm::from_um(1)
}

#[test]
fn every_hole_of_every_board_is_read_with_its_size_and_place() {
    let (mut checked, mut slots) = (0, 0);
    for path in boards().into_iter().flatten() {
        let truth = path.join("truth_drill.json");
        if !truth.is_file() {
            continue;
        }
        let truth = json(&truth);
        let holes = board(&path).board.holes;
        let mut expected = 0;
        for file in truth.as_array().expect("a list of files") {
            for tool in file["tools"].as_array().into_iter().flatten() {
                for place in tool["xy_mm"].as_array().expect("places").iter().map(point) {
                    let fits =
                        |hole: &&Hole| near(hole.path.start, place) && has_size(hole, &tool["diameter_mm"]);
                    let found = holes.iter().find(|hole| !hole.is_slot() && fits(hole));
                    assert!(found.is_some(), "{}: no hole at {place:?}", path.display());
                    expected += 1;
                }
            }
            let lists = [("slots_mm", "p"), ("routes_mm", "path")];
            for (slot, key) in lists
                .iter()
                .flat_map(|(l, k)| file[*l].as_array().into_iter().flatten().map(move |s| (s, *k)))
            {
                let ends = slot[key].as_array().expect("points");
                let (from, to) = (point(&ends[0]), point(&ends[ends.len() - 1]));
                let fits = |hole: &&Hole| {
                    near(hole.path.start, from)
                        && near(hole.path.end(), to)
                        && has_size(hole, &slot["diameter_mm"])
                };
                assert!(
                    holes.iter().any(|hole| hole.is_slot() && fits(&hole)),
                    "{}: no slot at {from:?}",
                    path.display()
                );
                expected += 1;
                slots += 1;
            }
        }
        assert!(holes.len() <= expected, "{}: {} holes, {expected} expected", path.display(), holes.len());
        checked += expected;
    }
    eprintln!("{checked} holes compared, {slots} of them slots");
}
