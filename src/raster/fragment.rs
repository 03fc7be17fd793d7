//! One primitive's claim on a pixel, and the order that decides between claims.
//!
//! The order (depth, then label) is total, so a picture does not depend on the order of drawing.

/// What a pixel shows: a number of the caller's choosing, 0 for nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label(pub u32);

impl Label {
    /// The label of a pixel that no primitive covers.
    pub const BACKGROUND: Self = Self(0);
}

/// One primitive's claim on one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    /// How far away, in pixels for a distance surface; never NaN, never −0.
    pub depth: f32,
    /// Whose.
    pub label: Label,
}

const _: () = assert!(size_of::<Fragment>() == 8, "one word");

impl Fragment {
    /// What a pixel holds before anything is drawn.
    pub const BACKGROUND: Self = Self { depth: f32::INFINITY, label: Label::BACKGROUND };

    /// Whether this one is seen where both lie on one pixel: the nearer, then the smaller label.
    #[must_use]
    pub fn hides(self, other: Self) -> bool {
        self.depth < other.depth || (self.depth <= other.depth && self.label < other.label)
    }
}
