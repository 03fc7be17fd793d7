//! G-code within a program that voromill wrote which is passed over: a user's own, which may go to
//! places of the machine, or turn on what nobody knows; and the touch of a tool, which counts from
//! where the tool is.

use std::borrow::Cow;

use super::source::lines;

/// The comments that stand round it: where it begins, and where it ends.
type Marks = (&'static str, &'static str);
const OWN: Marks = ("own G-code begins", "own G-code ends");
const TOUCH_OFF: Marks = ("touch-off begins", "touch-off ends");

/// `text` with the user's own G-code as empty lines, so that all others keep their numbers.
///
/// The program says after it what is in force and where it goes, so nothing that follows depends on
/// it.
#[must_use]
pub fn without_own_code(text: &str) -> Cow<'_, str> {
    without(text, &[OWN])
}

/// The same, without the touches of tools on their plate too: both stay as they are where a program
/// is levelled to a surface.
#[must_use]
pub fn without_unlevelled(text: &str) -> Cow<'_, str> {
    without(text, &[OWN, TOUCH_OFF])
}

fn without<'a>(text: &'a str, passed: &[Marks]) -> Cow<'a, str> {
    let begins = |line| passed.iter().find(|(begins, _)| is(line, begins)).map(|(_, ends)| *ends);
    if !lines(text).any(|line| begins(line).is_some()) {
        return Cow::Borrowed(text);
    }
    let (mut ends, mut out) = (None, String::with_capacity(text.len()));
    let all: Vec<&str> = lines(text).collect();
    // A block that nothing ends would hide all that follows: it is read.
    let is_ended = |at: usize, ends: &str| all[at..].iter().any(|line| is(line, ends));
    for (at, &line) in all.iter().enumerate() {
        let new = || begins(line).filter(|ends| is_ended(at, ends));
        ends = ends.or_else(new).filter(|ends| !is(line, ends));
        if ends.is_none() {
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
        let open = "(own G-code begins)\nG28\n";
        assert_eq!(without_own_code(open), open, "nor what nothing ends");
    }
}
