//! Names with `*` and `?`, by which options choose nets.

use std::convert::Infallible;
use std::fmt;
use std::str::FromStr;

/// A name with `*` for any letters and `?` for one, as shells have it; letters count as they are
/// written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern(String);

impl Pattern {
    /// Whether `name` is one that it means.
    #[must_use]
    pub fn matches(&self, name: &str) -> bool {
        let (pattern, name): (Vec<char>, Vec<char>) = (self.0.chars().collect(), name.chars().collect());
        let (mut p, mut n) = (0, 0);
        // Where the last star was, and how much of the name it stands for.
        let mut star: Option<(usize, usize)> = None;
        while n < name.len() {
            if pattern.get(p) == Some(&'*') {
                star = Some((p, n));
                p += 1;
            } else if pattern.get(p).is_some_and(|&c| c == '?' || c == name[n]) {
                (p, n) = (p + 1, n + 1);
            } else if let Some((at, taken)) = star {
                star = Some((at, taken + 1));
                (p, n) = (at + 1, taken + 1);
            } else {
                return false;
            }
        }
        pattern[p..].iter().all(|&c| c == '*')
    }

    /// Whether one of `names` is one that it means.
    #[must_use]
    pub fn matches_any(&self, names: &[String]) -> bool {
        names.iter().any(|name| self.matches(name))
    }
}

impl FromStr for Pattern {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(Self(text.to_owned()))
    }
}

impl fmt::Display for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_and_question_marks_stand_for_letters() {
        for (pattern, name, meant) in [
            ("GND", "GND", true),
            ("GND", "AGND", false),
            ("*GND", "AGND", true),
            ("NET-*-?", "NET-12-A", true),
            ("NET-*-?", "NET-12-", false),
            ("*", "", true),
            ("a*b*c", "a--b-b--c", true),
            ("a*b*c", "a--b-b--", false),
            ("?", "é", true),
        ] {
            let pattern: Pattern = pattern.parse().expect("any text");
            assert_eq!(pattern.matches(name), meant, "{pattern} and {name}");
        }
    }
}
