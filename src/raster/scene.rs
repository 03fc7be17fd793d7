//! What is to be drawn: primitives, in any order, and the size of the picture.

use super::primitive::{Primitive, Shape};
use super::{Label, Surface};

/// The primitives of a picture of a given size. The order in which they are added changes nothing.
#[derive(Clone, Debug)]
pub struct Scene {
    width: u32,
    height: u32,
    pub(super) primitives: Vec<Primitive>,
}

impl Scene {
    /// The largest width and height: sample positions in steps then are exact in an `f32`.
    pub const MAX_SIDE: u32 = 1 << 16;

    /// An empty scene seen in a picture of `width` × `height` pixels.
    ///
    /// # Panics
    ///
    /// Where a side is longer than [`Scene::MAX_SIDE`].
    #[must_use]
    pub const fn new(width: u32, height: u32) -> Self {
        assert!(width <= Self::MAX_SIDE && height <= Self::MAX_SIDE, "a picture is too large");
        Self { width, height, primitives: Vec::new() }
    }

    /// Adds a primitive: `surface`, shown as `label`.
    ///
    /// # Panics
    ///
    /// Where a depth, an offset or a limit is not finite.
    pub fn add(&mut self, label: Label, surface: Surface) {
        if let Some(shape) = Shape::new(surface) {
            self.primitives.push(Primitive { label, shape });
        }
    }

    /// Makes room for so many more primitives at once.
    pub fn reserve(&mut self, primitives: usize) {
        self.primitives.reserve_exact(primitives);
    }

    /// Columns of the picture.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Rows of the picture.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// How many primitives there are; those that cover nothing anywhere are not kept.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.primitives.len()
    }

    /// Whether there are none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.primitives.is_empty()
    }
}
