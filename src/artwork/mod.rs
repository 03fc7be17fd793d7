//! Artwork: what was drawn, before anybody says that it is copper.
//!
//! ```text
//!  svg, dxf, picture ─ import ─▶ Artwork ┬─▶ features, lines, rounds ─ import ─▶ Board
//!                                        └─▶ polygons ─▶ carving, pocketing
//! ```
//!
//! Layers of figures in the order in which they were painted: areas of closed contours, and lines
//! with a width. Lengths are true ones: a drawing whose unit nobody knows is an error of its
//! reader, not artwork. x runs to the right and y up, as on a [`Board`](crate::board::Board).

mod effort;
mod figure;
mod layer;
mod round;
mod union;

pub use effort::Effort;
pub use figure::{Area, Drawn, Figure, Line};
pub use layer::Layer;
pub use round::{diameter, hole, innermost};
pub use union::united;

use crate::board::polarity::{self, TooMuch};
use crate::geometry::{Nm, Polygon, Rect};

/// A drawing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Artwork {
    /// Its layers, in the order in which they first appear; none without a figure.
    pub layers: Vec<Layer>,
}

impl Artwork {
    /// The layer `name`, in any case of letters.
    #[must_use]
    pub fn layer(&self, name: &str) -> Option<&Layer> {
        self.layers.get(self.place(name)?)
    }

    /// The layer `name` alone, in any case of letters.
    ///
    /// # Errors
    ///
    /// All of it where there is none.
    pub fn into_layer(mut self, name: &str) -> Result<Layer, Self> {
        match self.place(name) {
            Some(at) => Ok(self.layers.swap_remove(at)),
            None => Err(self),
        }
    }

    fn place(&self, name: &str) -> Option<usize> {
        self.layers.iter().position(|layer| layer.name.eq_ignore_ascii_case(name))
    }

    /// The figures of all layers, in their order.
    #[must_use]
    pub fn into_figures(self) -> Vec<Figure> {
        self.layers.into_iter().flat_map(|layer| layer.figures).collect()
    }

    /// A rectangle that holds all figures; none without one.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        self.layers.iter().filter_map(Layer::bounds).reduce(Rect::union)
    }

    /// The filled shapes of all layers together: simple polygons with holes, one for each connected
    /// piece, curves within `tolerance`.
    ///
    /// # Errors
    ///
    /// [`TooMuch`] for figures made to keep a program busy.
    pub fn polygons(&self, tolerance: Nm) -> Result<Vec<Polygon>, TooMuch> {
        let layers: Result<Vec<_>, _> = self.layers.iter().map(|layer| layer.polygons(tolerance)).collect();
        Ok(polarity::union(layers?.iter().flatten()))
    }
}
