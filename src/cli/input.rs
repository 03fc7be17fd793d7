use std::path::PathBuf;

use clap::Args;
use voromill::import::{self, Loaded, Selection};
use voromill::job::Settings;
use voromill::report::document::WarningEntry;

use super::Failure;

/// What to read.
#[derive(Args)]
pub(super) struct Input {
    /// A folder, a zip archive, or the files themselves
    #[arg(required = true, value_name = "PATH")]
    pub(super) paths: Vec<PathBuf>,

    /// File with the front copper, where names leave it open
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    front: Option<PathBuf>,

    /// File with the back copper
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    back: Option<PathBuf>,

    /// File with the board's outline
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    outline: Option<PathBuf>,

    /// File with holes; may be given several times
    #[arg(long = "drill", value_name = "FILE", help_heading = "Files")]
    drill_files: Vec<PathBuf>,

    /// What the board is called, and its output files after it
    #[arg(long, value_name = "NAME", help_heading = "Files")]
    name: Option<String>,

    /// Fail where there is anything to warn of, and write nothing
    #[arg(long, help_heading = "Output")]
    deny_warnings: bool,
}

impl Input {
    /// The board to be milled: without copper it is none.
    pub(super) fn load(&self, settings: &Settings) -> Result<Loaded, Failure> {
        Ok(import::load(&self.paths, &self.selection(settings))?)
    }

    /// The board to be looked at, which may be a drill file or an outline alone.
    pub(super) fn survey(&self, settings: &Settings) -> Result<Loaded, Failure> {
        Ok(import::survey(&self.paths, &self.selection(settings))?)
    }

    /// Fails for `warnings` where they are denied.
    pub(super) fn judge(&self, warnings: &[WarningEntry]) -> Result<(), Failure> {
        if !self.deny_warnings || warnings.is_empty() {
            return Ok(());
        }
        let lines: String = warnings.iter().map(|warning| format!("\n  {warning}")).collect();
        let cause = format!("--deny-warnings allows no warning, and here are {}:{lines}", warnings.len());
        Err(Failure::new(cause, "mend the files, or leave --deny-warnings out"))
    }

    fn selection(&self, settings: &Settings) -> Selection {
        Selection {
            front: self.front.clone(),
            back: self.back.clone(),
            outline: self.outline.clone(),
            drill: self.drill_files.clone(),
            name: self.name.clone(),
            outline_gap: Some(settings.outline_gap),
        }
    }
}
