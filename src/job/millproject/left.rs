//! What pcb2gcode knows and voromill does another way, or not at all: each option with the reason
//! that a person is told.

use super::value::Entry;
use crate::board::Words;

/// The value at which an option asks for nothing, so that nothing is told of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Idle {
    /// There is none.
    Never,
    /// The flag is not set.
    Unset,
    /// The flag is set: voromill does so always.
    Set,
    /// Zero, with any unit or none.
    Zero,
}

/// How voromill orders its cuts is its own affair.
const ORDER: &str = "voromill orders and joins its cuts its own way";
/// What is written round the cuts.
const FRAME: &str =
    "{before} and {after} insert G-code before and after a program, and nothing is inserted between cuts";

/// The options that are only told of, in the order of their names.
const LEFT: &[(&str, Idle, &str)] = &[
    ("backtrack", Idle::Zero, ORDER),
    ("config", Idle::Never, "only one project is read"),
    ("dpi", Idle::Never, "copper is exact; {pixel} and {dpi} are of the picture that finds the boundaries"),
    ("eulerian-paths", Idle::Never, ORDER),
    ("fill-outline", Idle::Set, "an outline is a contour or an area, as its file draws it"),
    ("g0-horizontal-speed", Idle::Never, ORDER),
    ("g0-vertical-speed", Idle::Never, ORDER),
    ("ignore-warnings", Idle::Unset, "errors stay errors"),
    ("metricoutput", Idle::Set, "programs are in millimetres"),
    ("milldrill-output", Idle::Never, "bored holes are in the drill program"),
    ("min-path-length", Idle::Zero, ORDER),
    ("no-export", Idle::Unset, "`voromill draw` and `voromill inspect` show a board and write no programs"),
    ("nog81", Idle::Set, "holes are drilled with G0 and G1"),
    ("nog91-1", Idle::Unset, "the dialect sets whether programs have G91.1"),
    ("optimise", Idle::Zero, "{tolerance} sets how far a cut may be from its exact place"),
    ("optimize", Idle::Zero, "{tolerance} sets how far a cut may be from its exact place"),
    ("outline-width", Idle::Never, "the middle of the outline's line is the board's edge"),
    ("path-finding-limit", Idle::Never, ORDER),
    ("post-milling-gcode", Idle::Never, FRAME),
    ("pre-milling-gcode", Idle::Never, FRAME),
    ("preamble-text", Idle::Never, "a program begins with comments on what to mount and where zero is"),
    ("preserve-thermal-reliefs", Idle::Unset, "gaps within a net are not cut"),
    ("spindown-time", Idle::Zero, "no program waits for a spindle to stop"),
    ("svg", Idle::Never, "`{svg}` writes pictures of both sides"),
    ("tsp-2opt", Idle::Never, ORDER),
    ("vectorial", Idle::Set, "copper is always exact"),
];

/// Why the option of this line is not taken over; an empty reason where the line asks for nothing,
/// none for what is no such option.
pub(super) fn reason(entry: &Entry<'_>) -> Option<Words> {
    let (_, idle, reason) = LEFT.iter().find(|(name, ..)| *name == entry.name)?;
    let asks_nothing = match idle {
        Idle::Never => false,
        Idle::Unset => matches!(entry.flag(), Ok(false)),
        Idle::Set => matches!(entry.flag(), Ok(true)),
        Idle::Zero => is_zero(entry.value),
    };
    Some(Words::of(if asks_nothing { "" } else { reason }))
}

/// Whether the number of a value is zero.
fn is_zero(value: &str) -> bool {
    let number = value.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '/' || c.is_whitespace());
    number.contains('0') && number.bytes().all(|c| matches!(c, b'0' | b'.'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_asks_for_nothing_is_not_told_of() {
        let reason = |name, value| reason(&Entry { name, value, line: 1 });
        for (name, value) in [
            ("backtrack", "0"),
            ("optimise", "0.0000"),
            ("spindown-time", "0s"),
            ("fill-outline", "true"),
            ("vectorial", "1"),
        ] {
            assert_eq!(reason(name, value), Some(Words::of("")), "{name} = {value}");
        }
        for (name, value) in [("backtrack", "1000mm/s"), ("fill-outline", "0"), ("post-milling-gcode", "M5")]
        {
            assert!(reason(name, value).is_some_and(|reason| !reason.is_empty()), "{name} = {value}");
        }
        assert_eq!(reason("zwork", "-0.1"), None, "it has a counterpart");
    }

    #[test]
    fn the_options_are_in_the_order_of_their_names() {
        let names: Vec<_> = LEFT.iter().map(|(name, ..)| *name).collect();
        assert!(names.is_sorted(), "{names:?}");
    }
}
