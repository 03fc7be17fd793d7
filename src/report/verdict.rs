//! A verdict in the forms that people and build systems read: text, JSON, SARIF 2.1.0 and JUnit
//! XML.

use std::fmt::Write as _;

use serde::Serialize;
use serde_json::json;

use crate::board::Side;
use crate::board::diagnostic::count;
use crate::verify::{Finding, Report, Severity, check};

use super::explain;
use super::quantity::{Millimetres, Place, SCHEMA_VERSION, json as to_json};
use super::xml::escaped;

/// A verdict as data.
#[derive(Clone, Debug, Serialize)]
pub struct Verdict {
    /// Whether nothing is an error.
    pub passed: bool,
    /// How many findings are errors.
    pub errors: usize,
    /// How many are warnings.
    pub warnings: usize,
    /// What was looked at.
    pub judged: Vec<JudgedEntry>,
    /// What was found, the worst first.
    pub findings: Vec<FindingEntry>,
}

/// Programs that were judged together.
#[derive(Clone, Debug, Serialize)]
pub struct JudgedEntry {
    /// Their names.
    pub programs: Vec<String>,
    /// What for.
    pub role: String,
    /// The pixel of the picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pixel_mm: Option<Millimetres>,
}

/// A finding with its places.
#[derive(Clone, Debug, Serialize)]
pub struct FindingEntry {
    /// Its stable name.
    pub code: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// The sentence.
    pub message: String,
    /// The side it concerns.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub side: Option<Side>,
    /// The nets it concerns.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub nets: Vec<String>,
    /// The place on the board.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Place>,
    /// The same place on the machine.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on_machine: Option<Place>,
    /// How large.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_mm: Option<Millimetres>,
    /// How much copper, in mm².
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area_mm2: Option<f64>,
    /// The program.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub program: Option<String>,
    /// Its line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// Where else it is the same, and no worse.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub places: Vec<Place>,
}

impl From<&Finding> for FindingEntry {
    fn from(finding: &Finding) -> Self {
        Self {
            code: finding.name,
            severity: finding.severity,
            message: finding.message.clone(),
            side: finding.side,
            nets: finding.nets.clone(),
            at: finding.at.map(Place::from),
            on_machine: finding.on_machine.map(Place::from),
            size_mm: finding.size.map(Millimetres),
            area_mm2: finding.area.map(|area| (area * 1e6).round() / 1e6),
            program: finding.program.clone(),
            line: finding.line,
            places: finding.places.iter().copied().map(Place::from).collect(),
        }
    }
}

impl From<&Report> for Verdict {
    fn from(report: &Report) -> Self {
        let errors = report.count(Severity::Error);
        let judged = report.judged.iter().map(|judged| JudgedEntry {
            programs: judged.programs.clone(),
            role: judged.role.to_string(),
            pixel_mm: judged.resolution.map(Millimetres),
        });
        Self {
            passed: errors == 0,
            errors,
            warnings: report.count(Severity::Warning) - errors,
            judged: judged.collect(),
            findings: report.findings.iter().map(FindingEntry::from).collect(),
        }
    }
}

/// Findings of one name that the short text shows; the rest are counted. Chosen.
const SHOWN: usize = 5;

impl FindingEntry {
    /// Findings, sorted as reports have them, for people, with what to try; where `verbose`, all of
    /// them, and what is only worth knowing.
    #[must_use]
    pub fn list(findings: &[Self], verbose: bool) -> String {
        let mut text = String::new();
        let count = findings.iter().filter(|finding| verbose || finding.severity > Severity::Info).count();
        for same in findings[..count].chunk_by(|a, b| (a.severity, a.code) == (b.severity, b.code)) {
            let shown = if verbose { same.len() } else { SHOWN };
            for finding in same.iter().take(shown) {
                let Self { severity, code, message, .. } = finding;
                let _ = writeln!(text, "  {severity}: {}{message} [{code}]", place(finding));
            }
            let (severity, name) = (same[0].severity, same[0].code);
            if same.len() > shown {
                let _ = writeln!(text, "  {severity}: {} more [{name}]; -v shows all", same.len() - shown);
            }
            if let Some(kind) = explain::of_programs(name).filter(|_| severity > Severity::Info) {
                let _ = writeln!(text, "    try: {}", kind.advice);
            }
        }
        text
    }

    /// For people who asked for errors alone: those that are as bad as `deny`, as
    /// [`list`](Self::list) has them.
    #[must_use]
    pub fn failing(findings: &[Self], deny: Severity) -> String {
        let failing = findings.iter().filter(|finding| finding.severity >= deny);
        Self::list(&failing.cloned().collect::<Vec<_>>(), false)
    }
}

impl Verdict {
    /// For people: what was found, as [`FindingEntry::list`] has it, and what was judged.
    #[must_use]
    pub fn to_text(&self, verbose: bool) -> String {
        FindingEntry::list(&self.findings, verbose) + &self.line()
    }

    /// The verdict in one line.
    #[must_use]
    pub fn line(&self) -> String {
        let programs: usize = self.judged.iter().map(|judged| judged.programs.len()).sum();
        let pixels = self.judged.iter().filter_map(|judged| judged.pixel_mm).map(|pixel| pixel.0.get()).max();
        let programs = count(programs, "program");
        let pixels = pixels.map_or(String::new(), |nm| format!(", pixels of {} µm", nm.div_euclid(1000)));
        let found = match (self.errors, self.warnings) {
            (0, 0) => "nothing found".to_owned(),
            (errors, warnings) => {
                format!("{}, {}", count(errors, "error"), count(warnings, "warning"))
            }
        };
        format!("  verified {programs}: {found}{pixels}\n")
    }

    /// Whether the board is fit to be milled so, and what to change first where it is not; so many
    /// `others` were warned of before, of files and while planning.
    #[must_use]
    pub fn fitness(&self, others: usize) -> String {
        let first = |severity: Severity| {
            let worst = self.findings.iter().find(|finding| finding.severity == severity);
            let check = worst.and_then(|finding| check::of(finding.code));
            check.map_or(String::new(), |check| {
                format!("; first, about `{}`: {}", check.kind.code, check.kind.advice)
            })
        };
        match (self.errors, self.warnings + others) {
            (0, 0) => "  fit to mill\n".to_owned(),
            (0, warnings) => {
                let them = if warnings == 1 { "it" } else { "them" };
                format!("  fit to mill if you accept {}: look at {them} first\n", count(warnings, "warning"))
            }
            (errors, _) => {
                format!("  not fit to mill: {}{}\n", count(errors, "error"), first(Severity::Error))
            }
        }
    }

    /// As JSON text.
    #[must_use]
    pub fn to_json(&self) -> String {
        #[derive(Serialize)]
        struct Alone<'a> {
            schema_version: u32,
            #[serde(flatten)]
            verdict: &'a Verdict,
        }
        to_json(&Alone { schema_version: SCHEMA_VERSION, verdict: self })
    }

    /// As a SARIF 2.1.0 log, which code hosts show beside the lines of the programs.
    #[must_use]
    pub fn to_sarif(&self) -> String {
        let rules: Vec<_> = check::ALL
            .iter()
            .map(|check| {
                json!({
                    "id": check.kind.code,
                    "shortDescription": { "text": check.kind.what },
                    "fullDescription": { "text": check.kind.effect },
                    "help": { "text": check.kind.advice },
                })
            })
            .collect();
        let results: Vec<_> =
            self.findings.iter().map(|finding| sarif(finding, self.program(finding))).collect();
        to_json(&json!({
            "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
            "version": "2.1.0",
            "runs": [{
                "tool": { "driver": { "name": "voromill", "version": env!("CARGO_PKG_VERSION"), "rules": rules } },
                "results": results,
            }],
        }))
    }

    /// The program that a finding is about: of what no line does, the first that should have done
    /// it.
    fn program<'a>(&'a self, finding: &'a FindingEntry) -> Option<&'a str> {
        let role = finding.side.map_or("drilling".to_owned(), |side| side.to_string());
        let judged = || self.judged.iter().find(|judged| judged.role.starts_with(&role));
        finding.program.as_deref().or_else(|| judged()?.programs.first().map(String::as_str))
    }

    /// As JUnit XML: a test case for each check, which fails once with all its findings of at least
    /// `deny`.
    #[must_use]
    pub fn to_junit(&self, deny: Severity) -> String {
        let of = |name: &str| {
            self.findings.iter().filter(|f| f.code == name && f.severity >= deny).collect::<Vec<_>>()
        };
        let failures = check::ALL.iter().filter(|check| !of(check.kind.code).is_empty()).count();
        let count = check::ALL.len();
        let mut text = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <testsuites><testsuite name=\"voromill verify\" tests=\"{count}\" failures=\"{failures}\" errors=\"0\">\n"
        );
        for check in check::ALL {
            let found = of(check.kind.code);
            let _ = write!(text, "<testcase classname=\"voromill\" name=\"{}\">", check.kind.code);
            if let Some(first) = found.first() {
                let lines: String = found.iter().map(|f| format!("{}{}\n", place(f), f.message)).collect();
                let (message, lines) = (escaped(&first.message), escaped(&lines));
                let _ = write!(text, "<failure message=\"{message}\">{lines}</failure>");
            }
            text.push_str("</testcase>\n");
        }
        text.push_str("</testsuite></testsuites>\n");
        text
    }
}

fn sarif(finding: &FindingEntry, program: Option<&str>) -> serde_json::Value {
    let level = match finding.severity {
        Severity::Info => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    };
    let mut result = json!({
        "ruleId": finding.code,
        "ruleIndex": check::ALL.iter().position(|check| check.kind.code == finding.code),
        "level": level,
        "message": { "text": finding.message },
        "properties": { "side": finding.side, "nets": finding.nets, "at": finding.at, "size_mm": finding.size_mm },
    });
    // Code hosts leave out what has no place.
    if let Some(program) = program {
        let line = finding.line.unwrap_or(1);
        result["locations"] = json!([{ "physicalLocation": {
            "artifactLocation": { "uri": uri(program) },
            "region": { "startLine": line },
        } }]);
    }
    result
}

/// A file's name as a URI, relative unless it is absolute (RFC 3986 §2.1): what is not unreserved
/// becomes bytes in hexadecimal.
fn uri(name: &str) -> String {
    let mut text = if name.starts_with('/') { "file://".to_owned() } else { String::new() };
    for byte in name.bytes() {
        if byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'.' | b'_' | b'~' | b'/') {
            text.push(char::from(byte));
        } else {
            let _ = write!(text, "%{byte:02X}");
        }
    }
    text
}

/// Where a finding belongs: in the program and on the board.
fn place(finding: &FindingEntry) -> String {
    let mut text = String::new();
    if let Some(program) = &finding.program {
        let line = finding.line.map_or(String::new(), |line| format!(":{line}"));
        let _ = write!(text, "{program}{line}: ");
    }
    let side = finding.side.map_or(String::new(), |side| format!("{side} "));
    if let Some(at) = finding.at {
        let _ = write!(text, "{side}at {:.3}, {:.3} mm", at.x_mm.0, at.y_mm.0);
        if let Some(on_machine) = finding.on_machine.filter(|place| *place != at) {
            let _ = write!(text, " (machine {:.3}, {:.3})", on_machine.x_mm.0, on_machine.y_mm.0);
        }
        text.push_str(": ");
    }
    text
}
