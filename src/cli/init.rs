//! `voromill init`: a commented settings file with every default.

use std::path::{Path, PathBuf};

use clap::Args;
use voromill::job::{FILE_NAME, commented_defaults};

use super::{Failure, Shared, output::Output};

/// Write a commented settings file with every default
#[derive(Args)]
pub(super) struct Init {
    /// Where to write it; `-` for stdout
    #[arg(default_value = FILE_NAME)]
    path: PathBuf,

    /// Replace a file that is there
    #[arg(long)]
    force: bool,
}

impl Init {
    pub(super) fn run(self, shared: Shared) -> Result<(), Failure> {
        let text = commented_defaults();
        if self.path == Path::new("-") {
            return super::print(&text);
        }
        let path = if self.path.is_dir() { self.path.join(FILE_NAME) } else { self.path };
        if path.exists() && !self.force {
            let cause = format!("{} is there already", path.display());
            return Err(Failure::new(cause, "--force replaces it"));
        }
        let mut output = Output::new([]);
        output.stage(&path, text.as_bytes())?;
        output.commit()?;
        shared.say(&format!("wrote {}: every setting with its default, commented out\n", path.display()));
        Ok(())
    }
}
