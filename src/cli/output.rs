//! Files appear whole or not at all: all are written beside their place under another name, and
//! renamed once every one of them is complete. A link is followed, and what is no file (a device, a
//! pipe) is written to as it stands: renamed onto, `/dev/null` would be a file from then on, for
//! every program of the machine.
//!
//! A program that is interrupted (SIGINT, SIGTERM) leaves nothing either: a thread waits for these
//! signals, removes what was not renamed yet, and lets the signal end the program as it would have.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::failure::Failure;

/// Files about to be written.
pub(super) struct Output {
    pending: Arc<Mutex<Pending>>,
    /// Devices and pipes, and what goes into them.
    streams: Vec<(PathBuf, Vec<u8>)>,
    /// What goes once everything is in its place.
    obsolete: Vec<PathBuf>,
    /// What all is made from, which must not be replaced.
    sources: Vec<PathBuf>,
}

/// What there is before all is in its place.
#[derive(Debug, Default)]
struct Pending {
    /// Where it is now, where it will be.
    staged: Vec<(PathBuf, PathBuf)>,
    /// Folders that were made for it, outermost first.
    made: Vec<PathBuf>,
}

impl Output {
    /// No file yet; none may be one of `sources`, which it is made from.
    pub(super) fn new(sources: impl IntoIterator<Item = PathBuf>) -> Self {
        let pending = Arc::default();
        leave_nothing_when_interrupted(&pending);
        let sources = sources.into_iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
        Self { pending, streams: Vec::new(), obsolete: Vec::new(), sources }
    }

    fn pending(&self) -> MutexGuard<'_, Pending> {
        lock(&self.pending)
    }

    /// Makes `folder` and what is missing above it.
    pub(super) fn make_folder(&mut self, folder: &Path) -> Result<(), Failure> {
        let missing: Vec<PathBuf> = folder
            .ancestors()
            .take_while(|path| !path.as_os_str().is_empty() && !path.exists())
            .map(Path::to_path_buf)
            .collect();
        let mut pending = self.pending();
        fs::create_dir_all(folder).map_err(|error| Failure::io("make the folder", folder, &error))?;
        pending.made.extend(missing.into_iter().rev());
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
        if fs::canonicalize(path).is_ok_and(|path| self.sources.contains(&path)) {
            let cause = format!("{} is what this is made from, and would be lost", path.display());
            return Err(Failure::new(cause, "write to another file"));
        }
        // Held while it is written, so that no signal ends the program between the file and its
        // entry.
        let mut pending = self.pending();
        if pending.staged.iter().any(|(_, staged)| staged == path) {
            let hint = "give each a name of its own";
            return Err(Failure::new(format!("two outputs would be {}", path.display()), hint));
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let partial = path.with_file_name(format!(".{name}.{}.partial", std::process::id()));
        pending.staged.push((partial.clone(), path.to_path_buf()));
        fs::write(&partial, bytes).map_err(|error| Failure::io("write", path, &error))
    }

    /// Removes `path` once everything is in its place.
    pub(super) fn remove(&mut self, path: PathBuf) {
        self.obsolete.push(path);
    }

    /// Fills devices and pipes, then gives all files their names.
    pub(super) fn commit(self) -> Result<(), Failure> {
        // A pipe may wait for its reader for ever, and must not keep a signal waiting: nothing is
        // locked yet.
        for (path, bytes) in &self.streams {
            fs::write(path, bytes).map_err(|error| Failure::io("write", path, &error))?;
        }
        let mut pending = self.pending();
        for (partial, path) in &pending.staged {
            fs::rename(partial, path).map_err(|error| Failure::io("write", path, &error))?;
        }
        *pending = Pending::default();
        for path in &self.obsolete {
            fs::remove_file(path).map_err(|error| Failure::io("remove", path, &error))?;
        }
        Ok(())
    }
}

impl Pending {
    fn clear(&mut self) {
        for (partial, _) in self.staged.drain(..) {
            let _ = fs::remove_file(partial);
        }
        for folder in self.made.drain(..).rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}

/// A thread that died while it held the lock left only whole entries.
fn lock(pending: &Mutex<Pending>) -> MutexGuard<'_, Pending> {
    pending.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Clears `pending` where a signal ends the program. Where no signal can be waited for, it ends as
/// it always did.
#[cfg(unix)]
fn leave_nothing_when_interrupted(pending: &Arc<Mutex<Pending>>) {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let pending = Arc::clone(pending);
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            // Held to the end: nothing more is staged.
            let mut pending = lock(&pending);
            pending.clear();
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    });
}

#[cfg(not(unix))]
fn leave_nothing_when_interrupted(_: &Arc<Mutex<Pending>>) {}

/// Where a link leads, or `path` itself.
fn followed(path: &Path) -> Cow<'_, Path> {
    let target = path.is_symlink().then(|| fs::canonicalize(path).ok()).flatten();
    target.map_or(Cow::Borrowed(path), Cow::Owned)
}

/// What was not committed leaves no trace.
impl Drop for Output {
    fn drop(&mut self) {
        self.pending().clear();
    }
}

/// The name of a file alone.
pub(super) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Refuses a name for a picture that asks for another kind than those that are written.
pub(super) fn refuse_kind(picture: &Path, hint: &str) -> Result<(), Failure> {
    const OTHERS: [&str; 8] = ["jpg", "jpeg", "bmp", "gif", "tif", "tiff", "webp", "pdf"];
    let ending = picture.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.filter(|ending| OTHERS.contains(&ending.as_str())) {
        Some(other) => {
            let cause = format!("{}: pictures are not written as .{other}", picture.display());
            Err(Failure::new(cause, hint))
        }
        None => Ok(()),
    }
}
