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
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
}

impl Header {
    /// Its lines, as plain text.
    pub(super) fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("made by {}", self.generator)];
        for Input { file, sha256 } in &self.inputs {
            let short: String = sha256.chars().take(12).collect();
            lines.push(format!("from {file} sha256 {short}"));
        }
        lines.extend(self.settings.iter().map(|(name, value)| format!("{name} {value}")));
        lines.extend(self.seconds.map(|seconds| format!("takes about {}", duration(seconds))));
        lines
    }
}
