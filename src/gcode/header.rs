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

/// As people say it: `1 h 5 min`, `12 min`, `40 s`.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`as` saturates; a display figure"
)]
fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    let minutes = whole.div_ceil(60);
    match (minutes / 60, minutes % 60) {
        _ if whole < 60 => format!("{whole} s"),
        (0, minutes) => format!("{minutes} min"),
        (hours, minutes) => format!("{hours} h {minutes} min"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_said_as_people_say_them() {
        for (seconds, said) in [
            (12.4, "12 s"),
            (61.0, "2 min"),
            (3599.0, "1 h 0 min"),
            (7199.0, "2 h 0 min"),
            (4000.0, "1 h 7 min"),
        ] {
            assert_eq!(duration(seconds), said, "{seconds} s");
        }
    }
}
