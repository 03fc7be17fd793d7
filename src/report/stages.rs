//! Where the time goes: what `-vv` prints.
//!
//! Times are a clock's, so they are in no file that is written: only on stderr, and in the JSON
//! that is printed, where somebody asks.

use std::fmt::Write as _;
use std::time::Instant;

use serde::Serialize;

/// A stage of a job.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stage {
    /// What was done.
    pub stage: String,
    /// How long it took. Stages of two sides may run at the same time.
    pub seconds: f64,
    /// What it dealt with, and how many.
    pub counts: Vec<(&'static str, usize)>,
}

/// Stages, in the order in which they ended.
#[derive(Clone, Debug, Default)]
pub struct Stages {
    list: Vec<Stage>,
}

impl Stages {
    /// Does it, and notes how long it took and what `count` says of what came of it.
    pub fn run<T, const N: usize>(
        &mut self,
        stage: impl Into<String>,
        work: impl FnOnce() -> T,
        count: impl FnOnce(&T) -> [(&'static str, usize); N],
    ) -> T {
        let start = Instant::now();
        let made = work();
        let seconds = start.elapsed().as_secs_f64();
        self.list.push(Stage { stage: stage.into(), seconds, counts: count(&made).to_vec() });
        made
    }

    /// Adds the stages of a part of the job.
    pub fn extend(&mut self, part: &Self) {
        self.list.extend_from_slice(&part.list);
    }

    /// All of them.
    #[must_use]
    pub fn list(&self) -> &[Stage] {
        &self.list
    }

    /// For people: a line for each.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for Stage { stage, seconds, counts } in &self.list {
            let counts: Vec<String> = counts.iter().map(|(name, count)| format!("{count} {name}")).collect();
            let _ = writeln!(text, "{:9.1} ms  {stage:28} {}", seconds * 1e3, counts.join(", "));
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_names_stage_and_counts() {
        let mut stages = Stages::default();
        let made = stages.run("front: nets", || 7, |&nets| [("nets", nets), ("features", 9)]);
        assert_eq!((made, stages.list().len()), (7, 1), "what was made, and one stage");
        let text = stages.to_text();
        assert!(text.contains(" ms  front: nets") && text.ends_with("7 nets, 9 features\n"), "{text}");
    }
}
