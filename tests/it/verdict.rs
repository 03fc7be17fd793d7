//! Verdicts in the forms that build systems read.

use std::path::Path;

use serde_json::Value;
use voromill::board::Side;
use voromill::import::{self, Selection};
use voromill::report::Verdict;
use voromill::verify::{Program, Role, Settings, Severity, check, verify};

/// Half a circle round one of two pads, with the spindle off: a short and a broken tool.
fn verdict() -> Verdict {
    let fixture = |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/verify").join(name);
    let loaded = import::load(&[fixture("pads-F_Cu.gbr")], &Selection::default()).expect("a board");
    let text = std::fs::read_to_string(fixture("arcs.nc")).expect("a program");
    let program = Program {
        file: "arcs & more.nc".to_owned(),
        text: text.replace("M03 S10000\n", ""),
        role: Some(Role::Isolation(Side::Front)),
        cutter: Some("endmill:0.2mm".parse().expect("a tool")),
        placement: None,
        ..Program::default()
    };
    let report = verify(&[program], &loaded.board, &[], &Settings::default()).expect("it can be judged");
    Verdict::from(&report)
}

fn snapshot(name: &str, text: &str) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots/verify");
    insta::with_settings!({snapshot_path => path, prepend_module_to_snapshot => false}, {
        insta::assert_snapshot!(name, text);
    });
}

#[test]
fn every_form_says_what_was_found() {
    let verdict = verdict();
    snapshot("text", &verdict.to_text(true));
    snapshot("json", &verdict.to_json());
    snapshot("sarif", &verdict.to_sarif());
    snapshot("junit", &verdict.to_junit(Severity::Error));
}

/// What the schema of SARIF 2.1.0 (OASIS, 2020) asks of the properties that are written.
#[test]
fn sarif_has_the_shape_of_its_schema() {
    let log: Value = serde_json::from_str(&verdict().to_sarif()).expect("JSON");
    assert_eq!(log["version"], "2.1.0", "§3.13.2");
    let keys = |value: &Value| value.as_object().map(|map| map.keys().cloned().collect::<Vec<_>>());
    assert_eq!(keys(&log).expect("an object"), ["$schema", "runs", "version"], "§3.13: nothing else");
    let run = &log["runs"][0];
    let rules = run["tool"]["driver"]["rules"].as_array().expect("rules").clone();
    assert_eq!(rules.len(), check::ALL.len(), "a rule for each check");
    assert!(run["tool"]["driver"]["name"].is_string(), "§3.19.8: required");
    let results = run["results"].as_array().expect("§3.14.23: results");
    assert!(!results.is_empty(), "something was found");
    for result in results {
        assert!(result["message"]["text"].is_string(), "§3.27.11: required");
        let level = result["level"].as_str().expect("a level");
        assert!(["none", "note", "warning", "error"].contains(&level), "§3.27.10: {level}");
        let index = usize::try_from(result["ruleIndex"].as_u64().expect("an index")).expect("small");
        assert_eq!(rules[index]["id"], result["ruleId"], "§3.27.6: the rule at the index");
        let place = &result["locations"][0]["physicalLocation"];
        let uri = place["artifactLocation"]["uri"].as_str().expect("a URI");
        assert!(!uri.contains(' '), "§3.4.3: a URI has no blanks: {uri}");
        assert!(place["region"]["startLine"].as_u64() >= Some(1), "§3.30.5: from 1");
    }
}

/// Tags that are opened are closed, in turn, and texts are escaped.
#[test]
fn junit_is_well_formed() {
    let text = verdict().to_junit(Severity::Error);
    let mut open: Vec<&str> = Vec::new();
    for tag in text.split('<').skip(1).map(|rest| rest.split('>').next().unwrap_or_default()) {
        let name = tag.trim_start_matches('/').split(' ').next().unwrap_or_default();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "closed in turn");
        } else if !tag.starts_with('?') && !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?} left open");
    assert!(text.contains("arcs &amp; more.nc") && !text.contains("arcs & "), "escaped: {text}");
    assert_eq!(text.matches("<testcase ").count(), check::ALL.len(), "a case for each check");
    assert_eq!(text.matches("<failure ").count(), 2, "of which two fail");
}
