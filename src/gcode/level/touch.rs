//! A place that a probe touched, as a file has it.

/// A touched point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// Where the file says it, from 1.
    pub(super) line: usize,
    /// Its x, y and z.
    pub(super) place: [f64; 3],
}
