//! Colours for what is read in a terminal: the verdict green, yellow or red, so that it is seen at
//! once.

use std::borrow::Cow;
use std::io::IsTerminal;

const RED: &str = "\x1b[1;31m";
const YELLOW: &str = "\x1b[33m";
const GREEN: &str = "\x1b[32m";
const BOLD: &str = "\x1b[1m";
const FAINT: &str = "\x1b[2m";

/// `text` with colours where stdout is a terminal that wants them.
pub(super) fn on_terminal(text: &str) -> Cow<'_, str> {
    let shown = std::io::stdout().is_terminal() && are_wanted();
    if shown { Cow::Owned(coloured(text)) } else { Cow::Borrowed(text) }
}

/// Whether the terminal wants colours: it is not a dumb one, and `NO_COLOR` is not set.
pub(super) fn are_wanted() -> bool {
    let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
    let dumb = std::env::var_os("TERM").is_some_and(|terminal| terminal == "dumb");
    !refused && !dumb
}

fn coloured(text: &str) -> String {
    let lines = text.split_inclusive('\n').enumerate();
    lines
        .map(|(index, line)| paint(line, if index == 0 { Some(BOLD) } else { colour(line.trim_start()) }))
        .collect()
}

/// The colour of a line, by what it begins with.
fn colour(line: &str) -> Option<&'static str> {
    match line.split([' ', ':']).next()? {
        "error" => Some(RED),
        "warning" => Some(YELLOW),
        "cut" => Some(FAINT),
        "total" => Some(BOLD),
        "verified" if line.contains("nothing found") => Some(GREEN),
        "verified" if line.contains(" 0 errors") => Some(YELLOW),
        "verified" => Some(RED),
        _ => None,
    }
}

/// A line in a colour, its end left as it is.
fn paint(line: &str, colour: Option<&str>) -> String {
    let bare = line.trim_end_matches('\n');
    match colour {
        Some(colour) => format!("{colour}{bare}\x1b[0m{}", &line[bare.len()..]),
        None => line.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_verdict_is_seen_by_its_colour() {
        let text = "board, 1 × 1 mm\n  cut  rapid\n  verified 3 programs: nothing found\n  warning: narrow\n  plain\n";
        let lines: Vec<String> = coloured(text).lines().map(str::to_owned).collect();
        let colours = [Some(BOLD), Some(FAINT), Some(GREEN), Some(YELLOW), None];
        for (line, colour) in lines.iter().zip(colours) {
            assert!(colour.is_none_or(|colour| line.starts_with(colour)), "{line:?}");
            assert_eq!(colour.is_some(), line.ends_with("\x1b[0m"), "{line:?}");
        }
    }

    #[test]
    fn what_is_not_coloured_is_left_as_it_is() {
        assert_eq!(paint("  front: 3 nets\n", None), "  front: 3 nets\n", "the same");
        assert_eq!(paint("x\n", Some(RED)), "\x1b[1;31mx\x1b[0m\n", "the line's end comes last");
    }
}
