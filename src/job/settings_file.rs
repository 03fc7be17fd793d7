//! `voromill.toml`: where it is looked for and how it is read.

use std::sync::LazyLock;

use super::machine;
use super::tools::TABLE_KEYS;
use super::{Error, Options};

/// The name it has beside a board.
pub const FILE_NAME: &str = "voromill.toml";

/// The defaults, as a commented settings file: there is no second list of them.
pub const DEFAULTS: &str = include_str!("defaults.toml");

/// The settings file that `voromill init` writes: the defaults, each behind a `#`, so that it says
/// nothing until somebody does. What is set wins over what the board or the machine says.
#[must_use]
pub fn commented_defaults() -> String {
    let comment = |line: &str| {
        let is_set = !line.trim().is_empty() && !line.starts_with('#');
        if is_set { format!("# {line}\n") } else { format!("{line}\n") }
    };
    DEFAULTS.lines().map(comment).collect()
}

impl Options {
    /// The options that settings text gives. `file` is its name, for errors.
    ///
    /// # Errors
    ///
    /// [`Error::Settings`] with line and column for what is not TOML, for unknown keys (naming the
    /// nearest), for values that are not what their key takes, and for two keys that say the same.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, Error> {
        let options: Self = toml::from_str(text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start).min(text.len());
            // Of a table that may be a name instead, only the table's own place is known.
            let key = unknown_key(error.message()).and_then(|key| place_from(text, key, start));
            let before = &text[..key.unwrap_or(start)];
            let line = before.matches('\n').count() + 1;
            let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
            Error::Settings { file: file.to_owned(), line, column, problem: problem(error.message()) }
        })?;
        let Some(keys) = options.contradiction() else { return Ok(options) };
        let [one, other] = keys.map(|key| key.replace('_', "-"));
        let place = place_from(text, &other, 0).unwrap_or_default();
        let line = text[..place].matches('\n').count() + 1;
        let problem = format!("`{other}` and `{one}` are two ways to say the same: set one of them");
        Err(Error::Settings { file: file.to_owned(), line, column: 1, problem })
    }

    /// The defaults.
    #[must_use]
    pub fn defaults() -> Self {
        static READ: LazyLock<Options> =
            LazyLock::new(|| toml::from_str(DEFAULTS).expect("the built-in settings are right"));
        READ.clone()
    }
}

/// The key that the reader says it does not know.
fn unknown_key(message: &str) -> Option<&str> {
    message.strip_prefix("unknown field `")?.split('`').next()
}

/// Where `key` is set in `text`, in bytes: from the line on in which `start` lies, as far as the
/// table goes.
fn place_from(text: &str, key: &str, start: usize) -> Option<usize> {
    let mut place = text[..start].rfind('\n').map_or(0, |end| end + 1);
    for line in text[place..].split_inclusive('\n') {
        let written = line.trim_start();
        if written.starts_with('[') && place > start {
            return None;
        }
        let is_set = written.strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with('='));
        if is_set {
            return Some(place + line.len() - written.len());
        }
        place += line.len();
    }
    None
}

/// What the reader says, in our words where a person can be helped more.
fn problem(message: &str) -> String {
    let Some(key) = unknown_key(message) else {
        let message = message.lines().collect::<Vec<_>>().join(" ");
        return match message.strip_suffix("expected u32") {
            Some(what) => format!("{what}expected a whole number"),
            None => message.replace("unknown variant", "it does not take"),
        };
    };
    match (place_of(key), nearest(key)) {
        (Some(place), _) => format!("unknown key `{key}`: it belongs {place}"),
        (None, Some(nearest)) => format!("unknown key `{key}`: did you mean `{nearest}`?"),
        (None, None) => format!("unknown key `{key}`"),
    }
}

/// Where a key belongs that stands where it is not known.
fn place_of(key: &str) -> Option<&'static str> {
    if Options::keys().any(|known| known == key) {
        Some("above all tables")
    } else if machine::KEYS.contains(&key) {
        Some("under [machine]")
    } else {
        TABLE_KEYS.contains(&key).then_some("under a tool, such as [tools.mine]")
    }
}

/// The key that is most like it.
fn nearest(key: &str) -> Option<&'static str> {
    let of_tables = TABLE_KEYS.iter().chain(machine::KEYS).copied();
    Options::keys().chain(of_tables).min_by_key(|known| distance(key, known))
}

/// How many letters to insert, drop, or change to turn `a` into `b` (Levenshtein).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &other) in b.iter().enumerate() {
            let changed = diagonal + usize::from(letter != other);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn refused(text: &str) -> String {
        Options::from_toml("voromill.toml", text).expect_err("not settings").to_string()
    }

    #[test]
    fn an_unknown_key_names_its_place_and_the_nearest_right_one() {
        let error = refused("tool = \"endmill:1mm\"\n\nsafez = \"2mm\"\n");
        assert!(error.contains("voromill.toml:3:1"), "{error}");
        assert!(error.contains("`safez`: did you mean `safe-z`"), "{error}");
        let error = refused("tool = \"endmill:1mm\"\n[machine]\nbase = \"3018\"\n travle = \"1mm\"\n");
        assert!(error.contains("voromill.toml:4:2"), "{error}");
        assert!(error.contains("`travle`: did you mean `travel`"), "{error}");
    }

    #[test]
    fn a_key_in_the_wrong_table_is_told_where_it_belongs() {
        let cases = [
            ("[machine]\nkerf = \"0.2mm\"\n", "`kerf`: it belongs above all tables"),
            ("base = \"3018\"\n", "`base`: it belongs under [machine]"),
            ("tip = \"0.1mm\"\n", "`tip`: it belongs under a tool"),
        ];
        for (text, expected) in cases {
            let error = refused(text);
            assert!(error.contains(expected), "{error}");
        }
    }

    #[test]
    fn a_bare_number_is_refused_with_the_hint_of_the_command_line() {
        let error = refused("depth = 0.1\n");
        assert!(error.contains("voromill.toml:1:9") && error.contains("0.1mm"), "{error}");
    }

    #[test]
    fn types_and_variants_are_in_our_words() {
        assert!(refused("passes = \"3 mm\"\n").ends_with("expected a whole number"), "not u32");
        assert!(refused("material = \"tin\"\n").ends_with("it does not take `tin`, expected `fr4` or `fr1`"));
    }

    #[test]
    fn what_is_not_toml_is_refused_with_its_place() {
        let error = refused("depth = \n");
        assert!(error.contains("voromill.toml:1:"), "{error}");
    }

    #[test]
    fn every_key_is_in_the_file_that_init_writes() {
        for key in Options::keys() {
            assert!(DEFAULTS.contains(&format!("{key} = ")), "`{key}` is missing");
        }
    }

    #[test]
    fn what_init_writes_says_nothing_until_a_line_is_uncommented() {
        let text = commented_defaults();
        assert_eq!(Options::from_toml("voromill.toml", &text).expect("comments"), Options::default());
        let is_key = |line: &&str| {
            line.strip_prefix("# ").is_some_and(|line| DEFAULTS.contains(&format!("\n{line}\n")))
        };
        // The table of a machine has one of them, too.
        let set: BTreeSet<&str> = text.lines().filter(is_key).map(|line| &line[2..]).collect();
        let set: Vec<&str> = set.into_iter().collect();
        let all = Options::from_toml("voromill.toml", &set.join("\n")).expect("lines that were commented");
        assert_eq!(all, Options::defaults(), "all of them uncommented");
    }

    #[test]
    fn distances_are_letters() {
        assert_eq!(distance("safez", "safe-z"), 1, "one dash");
        assert_eq!(distance("", "abc"), 3, "all of it");
        assert_eq!(distance("kitten", "sitting"), 3, "the textbook's");
    }
}
