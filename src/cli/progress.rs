//! What is being done, shown on a terminal while it takes long.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use super::Shared;

/// What is being done, on a terminal; nothing elsewhere, and nothing for what is done at once.
pub(super) struct Progress(ProgressBar);

impl Progress {
    pub(super) fn start(shared: Shared) -> Self {
        let bar = if shared.shows_progress() { ProgressBar::new_spinner() } else { ProgressBar::hidden() };
        if shared.shows_progress() {
            if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
                bar.set_style(style);
            }
            bar.enable_steady_tick(Duration::from_millis(120));
        }
        Self(bar)
    }

    pub(super) fn say(&self, doing: &str) {
        self.0.set_message(doing.to_owned());
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
