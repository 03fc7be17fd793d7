//! Findings with their places and figures: what verification says.

use crate::board::{Severity, Side};
use crate::geometry::{Nm, Point};

/// Something that a program does wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Its stable name, that of the check: `short`, `gouge`, `rapid-in-material`.
    pub name: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// The side it concerns.
    pub side: Option<Side>,
    /// The nets it concerns, by name.
    pub nets: Vec<String>,
    /// The place on the board, in the board's own coordinates.
    pub at: Option<Point>,
    /// The same place on the machine.
    pub on_machine: Option<Point>,
    /// How large: the width of a bridge, the depth of a gouge, how much a hole is off.
    pub size: Option<Nm>,
    /// How much copper, in mm².
    pub area: Option<f64>,
    /// The program.
    pub program: Option<String>,
    /// The line of the program, from 1.
    pub line: Option<u32>,
    /// Where else it is the same, and no worse.
    pub places: Vec<Point>,
}

impl Finding {
    /// A finding without a place.
    #[must_use]
    pub fn new(name: &'static str, severity: Severity, message: impl Into<String>) -> Self {
        Self {
            name,
            severity,
            message: message.into(),
            side: None,
            nets: Vec::new(),
            at: None,
            on_machine: None,
            size: None,
            area: None,
            program: None,
            line: None,
            places: Vec::new(),
        }
    }

    /// The same, about these nets.
    #[must_use]
    pub fn of(self, nets: impl IntoIterator<Item = String>) -> Self {
        Self { nets: nets.into_iter().collect(), ..self }
    }
}

/// What was looked at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Judged {
    /// The programs' names.
    pub programs: Vec<String>,
    /// What for: `front isolation`, `drilling`.
    pub role: super::Role,
    /// The pixel of the picture; none where none was needed.
    pub resolution: Option<Nm>,
}

/// The verdict on a board's programs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// What was found, the worst first.
    pub findings: Vec<Finding>,
    /// What was looked at.
    pub judged: Vec<Judged>,
}

impl Report {
    /// How many findings are at least as bad as `severity`.
    #[must_use]
    pub fn count(&self, severity: Severity) -> usize {
        self.findings.iter().filter(|finding| finding.severity >= severity).count()
    }

    /// Whether nothing is as bad as `deny`.
    #[must_use]
    pub fn passes(&self, deny: Severity) -> bool {
        self.count(deny) == 0
    }

    /// The same with more findings.
    #[must_use]
    pub fn with(mut self, findings: impl IntoIterator<Item = Finding>) -> Self {
        self.findings.extend(findings);
        self.sort();
        self
    }

    /// This and another, of other programs.
    #[must_use]
    pub fn joined(mut self, other: Self) -> Self {
        self.judged.extend(other.judged);
        self.with(other.findings)
    }

    /// The worst first, then by name, place and line.
    pub(super) fn sort(&mut self) {
        self.findings.sort_by(|a, b| {
            let key = |finding: &Finding| (finding.side, finding.program.clone(), finding.line, finding.at);
            b.severity.cmp(&a.severity).then(a.name.cmp(b.name)).then_with(|| key(a).cmp(&key(b)))
        });
    }
}
