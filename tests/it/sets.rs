//! Open sets are lists: a member is a file of its own and a line in the list; none is forgotten.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use voromill::board::diagnostic::planning;
use voromill::gcode::dialect;
use voromill::gcode::level::FORMATS as MAPS;
use voromill::import::{self, diagnostic, drawing};
use voromill::verify::check;

use super::layering::{code, src};

/// The names of the files and folders of a module, without those that serve all members.
fn members(module: &str, shared: &[&str]) -> BTreeSet<String> {
    let entries = fs::read_dir(src().join(module)).expect("a module");
    let name = |path: &Path| path.file_stem().expect("a name").to_string_lossy().into_owned();
    let names = entries.map(|entry| name(&entry.expect("an entry").path()));
    names.filter(|name| name != "mod" && !shared.contains(&name.as_str())).collect()
}

fn folders(module: &str) -> BTreeSet<String> {
    let is_folder = |name: &String| src().join(module).join(name).is_dir();
    members(module, &[]).into_iter().filter(is_folder).collect()
}

fn text(file: &str) -> String {
    code(&fs::read_to_string(src().join(file)).expect("readable"))
}

/// The names that stand before `::` in a list of constants.
fn listed(file: &str, list: &str) -> BTreeSet<String> {
    let text = text(file);
    let after = text.split(list).nth(1).expect("the list");
    let (_, after) = after.split_once('=').expect("what it is");
    let body = after.split("];").next().expect("its end");
    let name =
        |entry: &str| Some(entry.trim().trim_start_matches(['&', '[']).trim().split_once("::")?.0.to_owned());
    body.split(',').filter_map(name).collect()
}

#[test]
fn every_check_is_a_file_and_an_entry() {
    let listed: BTreeSet<String> = check::ALL.iter().map(|check| check.kind.code.replace('-', "_")).collect();
    assert_eq!(listed, members("verify/check", &[]), "named alike");
    assert_eq!(listed.len(), check::ALL.len(), "each once");
}

#[test]
fn every_format_of_files_is_a_folder_and_an_entry() {
    let of_layers =
        import::FORMATS.iter().map(|format| format.name.split('-').next().expect("a name").to_owned());
    let mut expected: BTreeSet<String> = of_layers.collect();
    // Those of drawings, pictures, what edges are joined by, what files lie in and are for.
    expected.extend(["drawing", "picture", "outline", "archive", "layers"].map(ToOwned::to_owned));
    assert_eq!(folders("import"), expected, "layers and boards");
    let drawings: BTreeSet<String> = drawing::FORMATS.iter().map(|format| format.name.to_owned()).collect();
    assert_eq!(folders("import/drawing"), drawings, "drawings");
    assert!(drawing::looks_like(b"<svg xmlns='http://www.w3.org/2000/svg'/>"), "the list is asked");
}

#[test]
fn every_dialect_is_a_constant_and_an_entry() {
    let files = members("gcode/dialect", &["blend", "custom"]);
    assert_eq!(files, listed("gcode/dialect/mod.rs", "pub const ALL"), "each file has one at least");
    let constants =
        files.iter().map(|file| text(&format!("gcode/dialect/{file}.rs")).matches(": Dialect =").count());
    assert_eq!(constants.sum::<usize>(), dialect::ALL.len(), "all of them");
}

#[test]
fn every_format_of_height_maps_is_a_file_and_an_entry() {
    let files = members("gcode/level/format", &[]);
    assert_eq!(files, listed("gcode/level/format/mod.rs", "pub const FORMATS"), "by file");
    assert_eq!(files.len(), MAPS.len(), "each once");
}

#[test]
fn every_primitive_is_a_file_and_a_shape() {
    let text = text("raster/primitive/mod.rs");
    let body =
        text.split("enum Shape {").nth(1).expect("shapes").split('}').next().expect("its end").to_owned();
    let variant = |line: &str| Some(line.trim().split_once('(')?.0.to_lowercase());
    let shapes: BTreeSet<String> = body.lines().filter_map(variant).collect();
    assert_eq!(members("raster/primitive", &["bounds", "stroke"]), shapes, "a file each");
}

#[test]
fn every_strategy_is_a_file_that_is_offered() {
    let text = text("toolpath/strategy/mod.rs");
    for file in members("toolpath/strategy", &[]) {
        // Boring is drilling with an end mill.
        assert!(file == "bore" || text.contains(&format!("pub use {file}::")), "{file} can be asked for");
    }
}

#[test]
fn kinds_of_planning_are_in_the_order_of_their_codes() {
    let codes: Vec<&str> = planning::ALL.iter().map(|kind| kind.code).collect();
    assert!(codes.is_sorted_by(|a, b| a < b), "each once: {codes:?}");
    let mut files: Vec<&str> = diagnostic::ALL.iter().map(|kind| kind.code).collect();
    files.sort_unstable();
    let twice: Vec<_> = files.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]).collect();
    assert_eq!(twice, ["missing-end-of-file"], "one code for layers and drill files alone");
}
