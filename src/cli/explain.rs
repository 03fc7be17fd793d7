//! `voromill explain`: what the code behind a message means.

use clap::Args;
use voromill::report::explain;

use super::{Failure, reference};

/// What the code behind a message means, and what to try
///
/// Each finding and each warning ends with a code in brackets, such as [gouge]. Without a code all
/// of them are listed.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Explain {
    /// The code, without its brackets [default: a list of all]
    code: Option<String>,

    /// Print every option of every command, as Markdown: docs/options.md
    #[arg(long, conflicts_with = "code")]
    options: bool,
}

const EXAMPLES: &str = "\
Examples:
  voromill explain
  voromill explain gouge
  voromill explain gap-narrower-than-tool";

impl Explain {
    pub(super) fn run(self) -> Result<(), Failure> {
        if self.options {
            return super::print(&reference::page(&super::whole()));
        }
        let Some(code) = self.code else { return super::print(&explain::list()) };
        let code = code.trim_matches(['[', ']']);
        match explain::explain(code) {
            Some(text) => super::print(&text),
            None => Err(Failure::new(format!("no code is called `{code}`"), "`voromill explain` lists all")),
        }
    }
}
