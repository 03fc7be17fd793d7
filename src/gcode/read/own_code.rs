//! G-code of a user's own within a program that voromill wrote: it may go to places of the machine,
//! or turn on what nobody knows, so it is passed over.

use std::borrow::Cow;

use super::source::lines;

/// The comments that stand round it.
const BEGINS: &str = "own G-code begins";
const ENDS: &str = "own G-code ends";

/// `text` with the user's own G-code as empty lines, so that all others keep their numbers.
///
/// The program says after it what is in force and where it goes, so nothing that follows depends on
/// it.
#[must_use]
pub fn without_own_code(text: &str) -> Cow<'_, str> {
    if !lines(text).any(|line| is(line, BEGINS)) {
        return Cow::Borrowed(text);
    }
    let (mut own, mut out) = (false, String::with_capacity(text.len()));
    for line in lines(text) {
        own = (own || is(line, BEGINS)) && !is(line, ENDS);
        if !own {
            out.push_str(line);
        }
        out.push('\n');
    }
    Cow::Owned(out)
}

/// Whether a line is this comment.
fn is(line: &str, comment: &str) -> bool {
    line.trim().trim_matches(['(', ')', ';', ' ']) == comment && line.trim_start().starts_with(['(', ';'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_keep_their_numbers() {
        let text = "G21\n(own G-code begins)\nG28\n(own G-code ends)\nG0 Z2\n; own G-code begins\nM64 P0\n; own G-code ends\n";
        let read = without_own_code(text);
        assert_eq!(read, "G21\n\n\n(own G-code ends)\nG0 Z2\n\n\n; own G-code ends\n");
        assert_eq!(without_own_code("G28\n"), "G28\n", "what is not marked is read");
    }
}
