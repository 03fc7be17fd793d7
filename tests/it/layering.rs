//! A module may name only the modules above it in the flow: the table of `src/lib.rs`, kept true.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Module → what it may use. `gcode::read` is its own row: the reader may use geometry alone.
const MAY_USE: &[(&str, &[&str])] = &[
    ("geometry", &[]),
    ("raster", &[]),
    ("vectorize", &[]),
    ("board", &["geometry"]),
    ("artwork", &["geometry", "board"]),
    ("import", &["geometry", "board", "artwork", "vectorize"]),
    ("grid", &["geometry", "raster"]),
    ("topology", &["geometry", "raster", "board", "grid"]),
    ("voronoi", &["geometry", "raster", "board", "artwork", "grid", "topology"]),
    ("coupling", &["geometry", "topology", "voronoi"]),
    ("prediction", &["geometry", "board", "topology"]),
    ("toolpath", &["geometry", "board", "topology", "voronoi"]),
    ("gcode", &["geometry", "toolpath"]),
    ("gcode::read", &["geometry", "gcode"]),
    ("verify", &["geometry", "raster", "board", "grid", "topology", "gcode"]),
    (
        "report",
        &[
            "geometry",
            "raster",
            "board",
            "import",
            "grid",
            "topology",
            "voronoi",
            "coupling",
            "prediction",
            "toolpath",
            "gcode",
            "verify",
        ],
    ),
    (
        "job",
        &[
            "geometry",
            "raster",
            "board",
            "import",
            "grid",
            "topology",
            "voronoi",
            "coupling",
            "prediction",
            "toolpath",
            "gcode",
            "verify",
            "report",
        ],
    ),
];

/// Words of the trade that the engine must not know.
const BOARD_WORDS: &[&str] =
    &["gerber", "copper", "net", "nets", "pcb", "solder", "drill", "millimetre", "nanometre"];

pub(crate) fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("src is readable").map(|e| e.expect("an entry").path()) {
        if entry.is_dir() {
            found.extend(sources(&entry));
        } else if entry.extension().is_some_and(|e| e == "rs") {
            found.push(entry);
        }
    }
    found.sort();
    found
}

pub(crate) fn src() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The row of the table a file belongs to.
fn row_of(file: &Path) -> Option<&'static str> {
    let relative = file.strip_prefix(src()).expect("below src").with_extension("");
    let path = relative.to_string_lossy().replace('/', "::");
    let module = path.split("::").next().unwrap_or_default();
    MAY_USE
        .iter()
        .map(|row| row.0)
        .filter(|row| path == *row || path.starts_with(&format!("{row}::")) || *row == module)
        .max_by_key(|row| row.len())
}

/// The code of a file without comments, doc links and its unit tests.
pub(crate) fn code(text: &str) -> String {
    let body = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    body.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

#[test]
fn no_module_names_one_that_comes_after_it() {
    let allowed: BTreeMap<_, _> = MAY_USE.iter().copied().collect();
    let mut broken = Vec::new();
    for file in sources(&src()) {
        let Some(row) = row_of(&file) else { continue };
        let own = row.split("::").next().unwrap_or_default();
        let text = code(&fs::read_to_string(&file).expect("readable"));
        for named in text.split("crate::").skip(1) {
            for module in first_names(named) {
                let fine = module == own || allowed[row].contains(&module.as_str());
                if !fine && MAY_USE.iter().any(|r| r.0 == module) {
                    broken.push(format!("{} names crate::{module}", file.display()));
                }
            }
        }
    }
    assert!(broken.is_empty(), "the layering is broken:\n{}", broken.join("\n"));
}

/// The modules named right after `crate::`, also in `{a::b, c}`.
fn first_names(after: &str) -> Vec<String> {
    let ident =
        |s: &str| s.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    match after.strip_prefix('{') {
        Some(group) => group.split('}').next().unwrap_or_default().split(',').map(ident).collect(),
        None => vec![ident(after)],
    }
}

#[test]
fn the_raster_engine_knows_no_boards() {
    for file in sources(&src().join("raster")) {
        let text = fs::read_to_string(&file).expect("readable").to_lowercase();
        let mut words = text.split(|c: char| !c.is_alphabetic());
        let found = words.find(|word| BOARD_WORDS.contains(word));
        assert!(found.is_none(), "{} speaks of {found:?}", file.display());
    }
}

#[test]
fn every_top_level_module_has_a_row() {
    let lib = fs::read_to_string(src().join("lib.rs")).expect("readable");
    for module in
        lib.lines().filter_map(|line| line.strip_prefix("pub mod ")).map(|m| m.trim_end_matches(';'))
    {
        assert!(MAY_USE.iter().any(|row| row.0 == module), "`{module}` has no row in the layering table");
    }
}
