//! Words that name options by their keys: `say it: {front} FILE`.
//!
//! A stage knows which option helps; how that is written is for those who show it. The command
//! line's way is here, in one place, as what is shown where nothing else is asked for.

use std::fmt;

/// Fixed words, in which `{key}` stands for an option and `{0}` for the first name that is put in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words(&'static str);

impl Words {
    /// These words.
    #[must_use]
    pub const fn of(words: &'static str) -> Self {
        Self(words)
    }

    /// Whether nothing is said.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.0.is_empty()
    }

    /// The sentence with these names put in, which are shown as they are.
    #[must_use]
    pub fn with<const N: usize>(self, names: [&dyn fmt::Display; N]) -> Sentence {
        let names = names.map(ToString::to_string);
        let mut parts = Vec::new();
        let mut rest = self.0;
        while let Some((before, (key, after))) = next_key(rest) {
            parts.push(Part::Text(before.to_owned()));
            parts.push(match key.parse::<usize>() {
                Ok(number) => Part::Text(names[number].clone()),
                Err(_) => Part::Option(key),
            });
            rest = after;
        }
        parts.push(Part::Text(rest.to_owned()));
        Sentence(parts)
    }

    /// The keys of the options that it names.
    pub fn options(self) -> impl Iterator<Item = &'static str> {
        let mut rest = self.0;
        let keys = std::iter::from_fn(move || {
            let (_, (key, after)) = next_key(rest)?;
            rest = after;
            Some(key)
        });
        keys.filter(|key| key.parse::<usize>().is_err())
    }
}

/// The text before the next key, the key, and the text behind it.
fn next_key(text: &'static str) -> Option<(&'static str, (&'static str, &'static str))> {
    let (before, after) = text.split_once('{')?;
    Some((before, after.split_once('}')?))
}

impl fmt::Display for Words {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.with([]).fmt(f)
    }
}

/// As it is shown.
impl serde::Serialize for Words {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Words with names put in: texts and options, one after another.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sentence(Vec<Part>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Text(String),
    Option(&'static str),
}

impl Sentence {
    /// Whether nothing is said.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|part| matches!(part, Part::Text(text) if text.is_empty()))
    }

    /// This, then that; one of them alone where the other says nothing.
    #[must_use]
    pub fn then(mut self, other: impl Into<Self>) -> Self {
        let other = other.into();
        if !self.is_empty() && !other.is_empty() {
            self.0.push(Part::Text("; ".to_owned()));
        }
        self.0.extend(other.0);
        self
    }
}

impl fmt::Display for Sentence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|part| match part {
            Part::Text(text) => f.write_str(text),
            Part::Option(key) => write!(f, "--{key}"),
        })
    }
}

impl From<Words> for Sentence {
    fn from(words: Words) -> Self {
        words.with([])
    }
}

/// As it is: nothing in it is taken for a key.
impl From<String> for Sentence {
    fn from(text: String) -> Self {
        Self(vec![Part::Text(text)])
    }
}

/// As it is: nothing in it is taken for a key.
impl From<&str> for Sentence {
    fn from(text: &str) -> Self {
        text.to_owned().into()
    }
}

/// A number of things.
pub(crate) fn count(number: usize, what: &str) -> String {
    if number == 1 { format!("1 {what}") } else { format!("{number} {what}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_shown_as_they_are_and_options_as_they_are_typed() {
        let words = Words::of("choose it: {front} {0} or {back} {0}");
        assert_eq!(
            words.with([&"{skip}.gbr"]).to_string(),
            "choose it: --front {skip}.gbr or --back {skip}.gbr"
        );
        assert_eq!(words.options().collect::<Vec<_>>(), ["front", "back"], "names are no options");
        assert_eq!(Sentence::from("{front}").to_string(), "{front}", "not ours");
    }

    #[test]
    fn sentences_that_say_nothing_need_no_separator() {
        let say = |text: &str| Sentence::from(text);
        assert_eq!(say("a").then("b").to_string(), "a; b", "two");
        assert_eq!(say("").then("b").to_string(), "b", "one");
        assert_eq!(say("a").then("").to_string(), "a", "one");
    }
}
