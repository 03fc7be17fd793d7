//! What a command prints: text for people or JSON for programs.

use clap::ValueEnum;

/// How what was found is printed.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    Text,
    Json,
}
