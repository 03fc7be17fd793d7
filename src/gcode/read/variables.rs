//! Parameters: numbered ones, named ones, and those of each subprogram that is being run.

use std::collections::BTreeMap;

/// The numbers of a subprogram's own parameters: its arguments, and the rest of the first thirty.
const OWN: u32 = 30;

/// What all parameters hold.
#[derive(Clone, Debug)]
pub(super) struct Variables {
    numbered: BTreeMap<u32, f64>,
    global: BTreeMap<String, f64>,
    /// The parameters of each subprogram that is being run, the outermost the program's own.
    frames: Vec<Own>,
}

/// A subprogram's own parameters.
#[derive(Clone, Debug, Default)]
struct Own {
    numbered: BTreeMap<u32, f64>,
    named: BTreeMap<String, f64>,
}

impl Default for Variables {
    fn default() -> Self {
        Self { numbered: BTreeMap::new(), global: BTreeMap::new(), frames: vec![Own::default()] }
    }
}

/// Which parameter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Name {
    Number(u32),
    /// With a leading underscore for one that every subprogram shares.
    Text(String),
}

impl Variables {
    fn own(&self) -> &Own {
        self.frames.last().expect("the program's own are never dropped")
    }

    /// What a parameter holds; none where the program has not said.
    pub(super) fn get(&self, name: &Name) -> Option<f64> {
        match name {
            Name::Number(number @ 1..=OWN) => self.own().numbered.get(number),
            Name::Number(number) => self.numbered.get(number),
            Name::Text(text) if text.starts_with('_') => self.global.get(text),
            Name::Text(text) => self.own().named.get(text),
        }
        .copied()
    }

    pub(super) fn set(&mut self, name: Name, value: f64) {
        let own = self.frames.last_mut().expect("the program's own are never dropped");
        match name {
            Name::Number(number @ 1..=OWN) => own.numbered.insert(number, value),
            Name::Number(number) => self.numbered.insert(number, value),
            Name::Text(text) if text.starts_with('_') => self.global.insert(text, value),
            Name::Text(text) => own.named.insert(text, value),
        };
    }

    /// Begins a subprogram with these arguments; where LinuxCNC's has fewer than thirty, the rest
    /// are zero.
    pub(super) fn enter(&mut self, arguments: &[f64]) {
        let mut numbered: BTreeMap<u32, f64> = (1..=OWN).map(|number| (number, 0.0)).collect();
        numbered.extend((1_u32..).zip(arguments.iter().copied()));
        self.frames.push(Own { numbered, named: BTreeMap::new() });
    }

    /// Ends it.
    pub(super) fn leave(&mut self) {
        if self.frames.len() > 1 {
            self.frames.pop();
        }
    }
}
