//! The layers of a drawing while it is read, found by name.

use std::collections::BTreeMap;

use crate::artwork::{Artwork, Figure, Layer};

/// Layers in the order in which they first appear.
#[derive(Debug, Default)]
pub(super) struct Layers {
    layers: Vec<Layer>,
    /// Where each of them stands, by its name.
    places: BTreeMap<String, usize>,
}

impl Layers {
    /// The figures of the layer `name`, which is there from then on.
    pub(super) fn of(&mut self, name: &str) -> &mut Vec<Figure> {
        let at = self.places.get(name).copied().unwrap_or_else(|| {
            self.places.insert(name.to_owned(), self.layers.len());
            self.layers.push(Layer { name: name.to_owned(), figures: Vec::new() });
            self.layers.len() - 1
        });
        &mut self.layers[at].figures
    }

    /// All figures, layer by layer.
    pub(super) fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.layers.iter().flat_map(|layer| &layer.figures)
    }

    /// The same, to be changed.
    pub(super) fn figures_mut(&mut self) -> impl Iterator<Item = &mut Figure> {
        self.layers.iter_mut().flat_map(|layer| &mut layer.figures)
    }

    /// How many figures there are.
    pub(super) fn count(&self) -> u64 {
        self.layers.iter().map(|layer| layer.figures.len() as u64).sum()
    }

    /// The drawing; layers without a figure are left out.
    pub(super) fn into_artwork(mut self) -> Artwork {
        self.layers.retain(|layer| !layer.figures.is_empty());
        Artwork { layers: self.layers }
    }
}
