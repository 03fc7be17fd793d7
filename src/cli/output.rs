//! Files appear whole or not at all: all are written beside their place under another name, and renamed once
//! every one of them is complete. A link is followed, and what is no file (a device, a pipe) is written to as it
//! stands: renamed onto, `/dev/null` would be a file from then on, for every program of the machine.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

use super::failure::Failure;

/// Files about to be written.
pub(super) struct Output {
    /// Where it is now, where it will be.
    staged: Vec<(PathBuf, PathBuf)>,
    /// Devices and pipes, and what goes into them.
    streams: Vec<(PathBuf, Vec<u8>)>,
    /// Folders that were made for it, outermost first.
    made: Vec<PathBuf>,
}

impl Output {
    /// No file yet.
    pub(super) const fn new() -> Self {
        Self { staged: Vec::new(), streams: Vec::new(), made: Vec::new() }
    }

    /// Makes `folder` and what is missing above it.
    pub(super) fn make_folder(&mut self, folder: &Path) -> Result<(), Failure> {
        let missing: Vec<PathBuf> = folder
            .ancestors()
            .take_while(|path| !path.as_os_str().is_empty() && !path.exists())
            .map(Path::to_path_buf)
            .collect();
        fs::create_dir_all(folder).map_err(|error| Failure::io("make the folder", folder, &error))?;
        self.made.extend(missing.into_iter().rev());
        Ok(())
    }

    /// Writes `bytes` for `path`, under another name as yet.
    pub(super) fn stage(&mut self, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
        if path.is_dir() {
            let error = std::io::Error::from(std::io::ErrorKind::IsADirectory);
            return Err(Failure::io("write", path, &error));
        }
        let path = &*followed(path);
        if path.exists() && !path.is_file() {
            self.streams.push((path.to_path_buf(), bytes.to_vec()));
            return Ok(());
        }
        if self.staged.iter().any(|(_, staged)| staged == path) {
            let hint = "choose another name with --output-name";
            return Err(Failure::new(format!("two outputs would be {}", path.display()), hint));
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let partial = path.with_file_name(format!(".{name}.{}.partial", std::process::id()));
        self.staged.push((partial.clone(), path.to_path_buf()));
        fs::write(&partial, bytes).map_err(|error| Failure::io("write", path, &error))
    }

    /// Gives all files their names.
    pub(super) fn commit(mut self) -> Result<(), Failure> {
        for (partial, path) in &self.staged {
            fs::rename(partial, path).map_err(|error| Failure::io("write", path, &error))?;
        }
        self.staged.clear();
        self.made.clear();
        for (path, bytes) in &self.streams {
            fs::write(path, bytes).map_err(|error| Failure::io("write", path, &error))?;
        }
        Ok(())
    }
}

/// Where a link leads, or `path` itself.
fn followed(path: &Path) -> Cow<'_, Path> {
    let target = path.is_symlink().then(|| fs::canonicalize(path).ok()).flatten();
    target.map_or(Cow::Borrowed(path), Cow::Owned)
}

/// What was not committed leaves no trace.
impl Drop for Output {
    fn drop(&mut self) {
        for (partial, _) in &self.staged {
            let _ = fs::remove_file(partial);
        }
        for folder in self.made.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}
