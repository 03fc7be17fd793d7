use crate::gcode::{self, Header};
use crate::toolpath::{Program, Statistics, measure};

use super::Settings;

/// What a program is for; its file is named after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Isolates the front.
    Front,
    /// Isolates the back, the board turned over.
    Back,
    /// Drills.
    Drill,
    /// Cuts the board out.
    Cutout,
}

/// A program, planned, measured, and as text.
#[derive(Clone, Debug)]
pub struct Written {
    /// What it is for.
    pub part: Part,
    /// What was planned.
    pub program: Program,
    /// What it amounts to.
    pub statistics: Statistics,
    /// What the machine reads.
    pub text: String,
}

impl Part {
    /// Whether an option changes this program.
    fn is_changed_by(self, option: &str) -> bool {
        match option {
            "feed" | "plunge" | "spindle" | "safe-z" | "dialect" | "origin" => true,
            "outline-gap" => self != Self::Drill,
            _ if option.starts_with("drill") => self == Self::Drill,
            _ if option.starts_with("cutout") || option.starts_with("tab") => self == Self::Cutout,
            _ => matches!(self, Self::Front | Self::Back),
        }
    }

    /// The last part of its file's name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
            Self::Drill => "drill",
            Self::Cutout => "cutout",
        }
    }
}

impl Written {
    /// `program` in the dialect of `settings`, under `header` with its settings and the time it takes.
    #[must_use]
    pub fn new(part: Part, program: Program, header: &Header, settings: &Settings) -> Self {
        let statistics = measure(&program, &settings.machine);
        let mut options = settings.options().listed();
        options.retain(|(option, _)| part.is_changed_by(option));
        let header = Header { settings: options, seconds: Some(statistics.seconds), ..header.clone() };
        let text = gcode::write(&program, settings.dialect, &header);
        Self { part, program, statistics, text }
    }

    /// The name of its file.
    #[must_use]
    pub fn file_name(&self, board: &str, settings: &Settings) -> String {
        format!("{board}-{}.{}", self.part.name(), settings.dialect.extension)
    }
}
