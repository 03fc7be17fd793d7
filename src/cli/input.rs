use std::path::PathBuf;

use clap::Args;
use voromill::import::{self, Loaded, Selection};

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
}

impl Input {
    pub(super) fn load(&self) -> Result<Loaded, Failure> {
        let selection = Selection {
            front: self.front.clone(),
            back: self.back.clone(),
            outline: self.outline.clone(),
            drill: self.drill_files.clone(),
            name: self.name.clone(),
        };
        Ok(import::load(&self.paths, &selection)?)
    }
}
