//! What a person can do about a file: words that several readers share.

use crate::board::Words;

/// What to do about a drill file that cannot be read, if nothing else.
pub(super) const NO_DRILL: Words = Words::of("{no-drill} makes everything but the holes");

/// What to do about a file that cannot be used, put its name in.
pub(super) const LEAVE_ASIDE: Words = Words::of("export it again, or ignore it: {skip} {0}");

/// A name as a shell takes it.
pub(super) fn quoted(name: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-+/".contains(c);
    if name.chars().all(plain) { name.to_owned() } else { format!("'{name}'") }
}
