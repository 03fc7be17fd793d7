//! A module may name only the modules above it in the flow: the table of `src/lib.rs`, kept true.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// What `report` may use, and `job` beside it.
const BELOW_REPORT: &[&str] = &[
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
];

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
    ("report", BELOW_REPORT),
    // And `report`, the only other module that is above all these.
    ("job", BELOW_REPORT),
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
                let is_last = own == "job" && module == "report";
                let fine = module == own || is_last || allowed[row].contains(&module.as_str());
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

/// Circles between the files of one module that are still there: a primitive says itself how it is
/// put into bins and mosaics, which hold primitives.
const CIRCLES: &[&str] = &["raster: bin mosaic primitive scene"];

/// A module's path: `["import", "gerber", "reader"]`.
type Module = Vec<String>;

fn module_of(file: &Path) -> Module {
    let relative = file.strip_prefix(src()).expect("below src").with_extension("");
    let mut path: Module = relative.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if path.last().is_some_and(|last| last == "mod") {
        path.pop();
    }
    path
}

fn is_ident(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The paths that begin at the start of `text`: one, or each of a group.
fn paths_at(text: &str) -> Vec<Module> {
    let text = text.trim_start();
    let end = text.find(|c| !is_ident(c)).unwrap_or(text.len());
    let (first, rest) = text.split_at(end);
    if first.is_empty() {
        return Vec::new();
    }
    let Some(rest) = rest.strip_prefix("::") else { return vec![vec![first.to_owned()]] };
    let tails = match rest.trim_start().strip_prefix('{') {
        Some(group) => members(group).iter().flat_map(|member| paths_at(member)).collect(),
        None => paths_at(rest),
    };
    let tails = if tails.is_empty() { vec![Vec::new()] } else { tails };
    tails.into_iter().map(|tail| [vec![first.to_owned()], tail].concat()).collect()
}

/// What stands between the commas of a group, up to its end.
fn members(group: &str) -> Vec<&str> {
    let (mut depth, mut start, mut found) = (0, 0, Vec::new());
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => {
                found.push(&group[start..at]);
                return found;
            }
            '}' => depth -= 1,
            ',' if depth == 0 => {
                found.push(&group[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    found
}

/// All paths in a file that begin with one of these words.
fn paths(text: &str, firsts: &[&str]) -> Vec<Module> {
    let starts =
        firsts.iter().flat_map(|first| text.match_indices(&format!("{first}::")).collect::<Vec<_>>());
    let whole = starts.filter(|(at, _)| !text[..*at].ends_with(|c| is_ident(c) || c == ':'));
    whole.flat_map(|(at, _)| paths_at(&text[at..])).collect()
}

/// Every module with what it names of this crate, re-exports followed.
fn named() -> BTreeMap<Module, Vec<Module>> {
    let files = sources(&src()).into_iter().filter(|file| !file.starts_with(src().join("cli")));
    let texts: BTreeMap<Module, String> =
        files.map(|file| (module_of(&file), code(&fs::read_to_string(&file).expect("readable")))).collect();
    let mut shown: BTreeMap<Module, Module> = BTreeMap::new();
    for (module, text) in &texts {
        for (at, _) in text.match_indices("use ") {
            let is_shown = text[..at].lines().last().is_some_and(|line| line.starts_with("pub"));
            for path in paths_at(&text[at + 4..]).into_iter().filter(|_| is_shown) {
                let target = [module.clone(), path].concat();
                let name = [module.clone(), vec![target[target.len() - 1].clone()]].concat();
                if texts.contains_key(&target[..=module.len()]) {
                    shown.insert(name, target);
                }
            }
        }
    }
    let resolve = |module: &Module, path: Module| -> Option<Module> {
        let mut base = module.clone();
        let mut rest = path.into_iter().peekable();
        if rest.next_if(|first| first == "crate").is_some() {
            base.clear();
        }
        while rest.next_if(|first| first == "super").is_some() {
            base.pop();
        }
        base.extend(rest);
        // A name may be shown by one module after another.
        for _ in 0..4 {
            let known = (1..=base.len()).rev().find(|&n| shown.contains_key(&base[..n]));
            let Some(n) = known.filter(|&n| !texts.contains_key(&base[..n])) else { break };
            base = [shown[&base[..n]].clone(), base[n..].to_vec()].concat();
        }
        let n = (1..=base.len()).rev().find(|&n| texts.contains_key(&base[..n]))?;
        base.truncate(n);
        Some(base)
    };
    let targets = |module: &Module, text: &str| {
        paths(text, &["crate", "super"]).into_iter().filter_map(|path| resolve(module, path)).collect()
    };
    texts.iter().map(|(module, text)| (module.clone(), targets(module, text))).collect()
}

/// The circles between siblings, each as its names in order.
fn circles() -> Vec<String> {
    let mut edges: BTreeMap<Module, BTreeMap<String, BTreeSet<String>>> = BTreeMap::new();
    for (from, targets) in named() {
        for to in targets {
            let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
            if let (Some(a), Some(b), 1..) = (from.get(common), to.get(common), common) {
                let inside = edges.entry(from[..common].to_vec()).or_default();
                inside.entry(a.clone()).or_default().insert(b.clone());
            }
        }
    }
    let mut found = BTreeSet::new();
    for (module, inside) in edges {
        let reached = |from: &String| {
            let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
            while let Some(next) = open.pop() {
                let new = inside.get(next).into_iter().flatten().filter(|to| seen.insert((*to).clone()));
                open.extend(new);
            }
            seen
        };
        let reach: BTreeMap<&String, BTreeSet<String>> =
            inside.keys().map(|from| (from, reached(from))).collect();
        for (from, to) in &reach {
            let back = to.iter().filter(|other| reach.get(other).is_some_and(|back| back.contains(*from)));
            let circle: Vec<&str> = back.map(String::as_str).collect();
            if !circle.is_empty() {
                found.insert(format!("{}: {}", module.join("::"), circle.join(" ")));
            }
        }
    }
    found.into_iter().collect()
}

#[test]
fn files_of_one_module_do_not_go_in_circles() {
    let circles = circles();
    let new: Vec<_> = circles.iter().filter(|circle| !CIRCLES.contains(&circle.as_str())).collect();
    assert!(new.is_empty(), "move what both use below them: {new:#?}");
    let gone: Vec<_> = CIRCLES.iter().filter(|circle| !circles.iter().any(|c| c == *circle)).collect();
    assert!(gone.is_empty(), "no longer there, leave them out: {gone:#?}");
}

#[test]
fn circles_are_seen() {
    let uses = "use super::{a::B, c::{self, D}};\nfn f() { crate::x::y() }\nuse not_super::z;";
    let found: Vec<String> = paths(uses, &["crate", "super"]).iter().map(|path| path.join("::")).collect();
    assert_eq!(found, ["crate::x::y", "super::a::B", "super::c::self", "super::c::D"], "all paths");
    assert!(named().values().map(Vec::len).sum::<usize>() > 1000, "the crate names itself");
}
