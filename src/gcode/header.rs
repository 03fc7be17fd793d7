use std::fmt::Write as _;

use crate::toolpath::duration;

/// What a program says of itself before it begins: what made it, from what, how. No clock, no path, no host.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Header {
    /// The program and its version: `voromill 0.1.0`.
    pub generator: String,
    /// The files it was made from.
    pub inputs: Vec<Input>,
    /// The settings that matter, by name.
    pub settings: Vec<(String, String)>,
    /// How long it will take, in seconds; none where nobody knows.
    pub seconds: Option<f64>,
}

/// A file that a program was made from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Its name without its folder.
    pub file: String,
    /// SHA-256 of what was read from it, in hexadecimal: comments and dates do not count.
    pub design: String,
}

impl Header {
    /// Its lines, as plain text.
    pub(super) fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("made by {}", self.generator)];
        for Input { file, design } in &self.inputs {
            let short: String = design.chars().take(12).collect();
            lines.push(format!("from {file} design {short}"));
        }
        lines.extend(self.settings.iter().flat_map(|(name, value)| setting(name, value)));
        lines.extend(self.seconds.map(|seconds| format!("takes about {}", duration(seconds))));
        lines
    }
}

/// A setting in lines short enough to stand each in one comment, the name before each part.
fn setting(name: &str, value: &str) -> Vec<String> {
    /// Chosen: shorter than any controller's line.
    const ROOM: usize = 70;
    let mut lines: Vec<String> = Vec::new();
    for word in escaped(value).split(' ') {
        match lines.last_mut().filter(|line| line.len() + word.len() < ROOM) {
            Some(line) => {
                line.push(' ');
                line.push_str(word);
            }
            None => lines.push(format!("{name} {word}")),
        }
    }
    lines
}

/// A value whose every character survives in a comment: what does not is written as `^` and two hexadecimal digits for each byte.
fn escaped(value: &str) -> String {
    let mut out = String::with_capacity(value.len());
    for byte in value.bytes() {
        if (b' '..0x7f).contains(&byte) && !b"?!~%();*#{}^".contains(&byte) {
            out.push(char::from(byte));
        } else {
            _ = write!(out, "^{byte:02X}");
        }
    }
    out
}
