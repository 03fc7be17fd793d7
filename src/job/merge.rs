//! What one place leaves open is taken from another: the command line goes before the settings
//! file, that before the defaults.

/// What an option holds, which may be left open.
pub(super) trait Open: Default {
    /// What it holds where it is not open.
    type Held;

    /// Whether nothing was said.
    fn is_open(&self) -> bool;

    /// This, and where it is open, `other`.
    #[must_use]
    fn otherwise(self, other: Self) -> Self {
        if self.is_open() { other } else { self }
    }
}

impl<T> Open for Option<T> {
    type Held = T;

    fn is_open(&self) -> bool {
        self.is_none()
    }
}

impl<T> Open for Vec<T> {
    type Held = Self;

    fn is_open(&self) -> bool {
        self.is_empty()
    }
}

/// Drops of another place what says in one way what is said here in the other.
pub(super) fn replace<T: Open, U: Open>(
    (one, other): (&T, &U),
    (others_one, others_other): (&mut T, &mut U),
) {
    if !one.is_open() {
        *others_other = U::default();
    }
    if !other.is_open() {
        *others_one = T::default();
    }
}
