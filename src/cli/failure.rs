//! Why a command did nothing, in words for a terminal: the cause and the way out.
//!
//! The one place where errors of all stages become text; control characters of hostile files are
//! made visible.

use std::io::IsTerminal;

use voromill::board::Sentence;
use voromill::{import, job, verify};

/// Why nothing was done: the cause, and what to do about it.
#[derive(Debug)]
pub(super) struct Failure {
    cause: String,
    hint: Sentence,
}

impl Failure {
    pub(super) fn new(cause: impl Into<String>, hint: impl Into<Sentence>) -> Self {
        Self { cause: cause.into(), hint: hint.into() }
    }

    /// A file that could not be read or written.
    pub(super) fn io(doing: &str, path: &std::path::Path, error: &std::io::Error) -> Self {
        use std::io::ErrorKind as Kind;
        let hint = match error.kind() {
            Kind::NotFound => "check the name",
            Kind::PermissionDenied | Kind::ReadOnlyFilesystem => {
                "check the permissions, or choose another place"
            }
            Kind::StorageFull | Kind::QuotaExceeded => "free some space, or choose another place",
            Kind::NotADirectory | Kind::AlreadyExists => {
                "there is a file where a folder must be: choose another place"
            }
            Kind::IsADirectory => "there is a folder where a file must be: choose another place",
            _ => "",
        };
        Self::new(format!("cannot {doing} {}: {}", path.display(), plain(error)), hint)
    }

    /// Prints it on stderr, in red where that is a terminal.
    pub(super) fn print(&self) {
        let label = if std::io::stderr().is_terminal() { "\x1b[1;31merror\x1b[0m" } else { "error" };
        let cause = self.cause.strip_prefix("error: ").unwrap_or(&self.cause);
        let hint = if self.hint.is_empty() { String::new() } else { format!("\nhint: {}", self.hint) };
        let cause = shown(cause);
        let text = format!("{label}: {cause}{hint}\n");
        // Nowhere is left to say that stderr cannot be written to; the exit code says the rest.
        let _ = super::print_to(&mut std::io::stderr().lock(), text.as_bytes());
    }
}

/// A text with what a file may hold to steer terminals made visible.
pub(super) fn shown(text: &str) -> String {
    let escaped = |c: char| c.is_control() && !matches!(c, '\n' | '\t');
    text.chars().map(|c| if escaped(c) { c.escape_default().to_string() } else { c.to_string() }).collect()
}

/// An error of the system without its number.
fn plain(error: &std::io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}

impl From<import::Error> for Failure {
    fn from(error: import::Error) -> Self {
        match error {
            import::Error::Content { file, what, hint } => Self::new(format!("{file}: {what}"), hint),
            other => Self::new(other.render(), ""),
        }
    }
}

impl From<job::Error> for Failure {
    fn from(error: job::Error) -> Self {
        match error {
            job::Error::Import(error) => error.into(),
            other => Self::new(other.to_string(), other.hint()),
        }
    }
}

impl From<verify::Error> for Failure {
    fn from(error: verify::Error) -> Self {
        Self::new(error.to_string(), error.hint())
    }
}
