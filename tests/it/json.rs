//! The reports as data: each key that is written is documented in docs/json.md, and each key
//! documented there is written.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::cli::{stderr, stdout, voromill};

/// Keys whose own keys are names of options and of things that are counted.
const OPEN: [&str; 2] = ["settings", "counts"];

/// What writes reports, between them all keys; @ is the folder of the fixtures.
const RUNS: [&str; 15] = [
    "mill @boards/unsafe-gap -o a -vv --strategy auto",
    "mill @boards/unsafe-gap/unsafe-gap-F_Cu.gbr -o b --name unsafe-gap --topology translucency --tool endmill:0.0905mm",
    "mill @boards/blinker -o c --tool endmill:0.55mm --no-verify",
    "mill @sloppy -o d",
    "inspect @boards/unsafe-gap --topology all --coupling=*",
    "inspect pads.png --picture-dpi 100 --thinning",
    "inspect @figures/overlaps.gbr --topology all --paper",
    "verify a --board @boards/unsafe-gap",
    "verify @verify/arcs.nc --board @verify/pads-F_Cu.gbr --tool endmill:0.2mm --side front",
    "diff a/unsafe-gap-front.ngc b/unsafe-gap-front.ngc",
    "diff a/unsafe-gap-front.ngc a/unsafe-gap-cutout.ngc",
    "carve @gerber/clear_polarity.gbr -o carved.ngc --tool vbit:0.1mm:90deg --max-depth 0.2mm",
    "carve @gerber/clear_polarity.gbr --check carved.ngc --tool vbit:0.1mm:60deg",
    "pocket @gerber/clear_polarity.gbr -o milled.ngc --tool endmill:0.3mm --depth 0.1mm",
    "pocket @gerber/clear_polarity.gbr -o arcs.ngc --tool endmill:0.3mm --depth 0.1mm --strategy engagement",
];

/// What docs/json.md says: for each path in its headings, the keys of the table below.
fn documented() -> BTreeMap<String, BTreeSet<String>> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/json.md");
    let text = fs::read_to_string(page).expect("the page");
    let mut objects: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut open: Vec<String> = Vec::new();
    for line in text.lines() {
        let quoted = |text: &str| text.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>();
        if let Some(heading) = line.strip_prefix("### ") {
            open = quoted(heading.split(": ").next().unwrap_or_default());
            objects.extend(open.iter().map(|path| (path.clone(), BTreeSet::new())));
        } else if let Some(cell) = line.strip_prefix("| `") {
            let keys = quoted(&format!("`{}", cell.split(" |").next().unwrap_or_default()));
            for path in &open {
                objects.get_mut(path).expect("a heading").extend(keys.iter().cloned());
            }
        }
    }
    objects
}

/// The heading for an object at `path`: the longest that it ends with.
fn heading<'a>(objects: &'a BTreeMap<String, BTreeSet<String>>, path: &str) -> Option<&'a String> {
    let fits = |heading: &&String| path == **heading || path.ends_with(&format!(".{heading}"));
    objects.keys().filter(fits).max_by_key(|heading| heading.len())
}

/// Every object of a report with the path of keys that leads to it.
fn objects(path: &str, value: &Value, found: &mut Vec<(String, BTreeSet<String>)>) {
    match value {
        Value::Array(items) => items.iter().for_each(|item| objects(path, item, found)),
        Value::Object(map) if !OPEN.contains(&path.rsplit('.').next().unwrap_or_default()) => {
            found.push((path.to_owned(), map.keys().cloned().collect()));
            map.iter().for_each(|(key, value)| objects(&format!("{path}.{key}"), value, found));
        }
        _ => {}
    }
}

#[test]
fn every_key_is_documented_and_every_documented_key_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let fixtures = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/");
    let documented = documented();
    let mut written: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut unknown: Vec<String> = Vec::new();
    super::thinning::pads(12).save(folder.path().join("pads.png")).expect("written");
    for run in RUNS {
        let words: Vec<String> = run.split(' ').map(|word| word.replace('@', fixtures)).collect();
        let run: Vec<&str> = words.iter().map(String::as_str).chain(["--format", "json"]).collect();
        let done = voromill(folder.path(), &run);
        let report: Value = serde_json::from_str(&stdout(&done))
            .unwrap_or_else(|error| panic!("{run:?}: {error}: {}{}", stdout(&done), stderr(&done)));
        assert_eq!(report["schema_version"], 2, "{run:?}");
        let mut found = Vec::new();
        objects(run[0], &report, &mut found);
        for (path, keys) in found {
            let Some(heading) = heading(&documented, &path) else {
                unknown.push(format!("{path}: {keys:?}"));
                continue;
            };
            unknown.extend(keys.difference(&documented[heading]).map(|key| format!("{path}: {key}")));
            written.entry(heading.clone()).or_default().extend(keys);
        }
    }
    let none = BTreeSet::new();
    let mut missing = Vec::new();
    for (heading, keys) in &documented {
        let seen = written.get(heading).unwrap_or(&none);
        missing.extend(keys.difference(seen).map(|key| format!("{heading}: {key}")));
    }
    assert_eq!(unknown, [""; 0], "in a report and not in docs/json.md");
    assert_eq!(missing, [""; 0], "in docs/json.md and in no report");
}
