//! The real boards, which are not part of the repository: `VOROMILL_BOARDS` names their folder.

use std::path::Path;

use voromill::board::{Copper, Outline};
use voromill::import::{self, Selection};

use crate::corpus::board_folders;

/// A layer of copper with the board's name and side.
pub(crate) struct Layer {
    pub(crate) name: String,
    pub(crate) copper: Copper,
    pub(crate) outline: Option<Outline>,
}

/// All layers, board by board; an unoptimised test gets those with at most so many features.
pub(crate) fn layers(unoptimised: usize) -> impl Iterator<Item = Layer> {
    let is_quick = move |layer: &Layer| !cfg!(debug_assertions) || layer.copper.features.len() <= unoptimised;
    all().into_iter().filter(is_quick)
}

/// What a person has to say of the board in `folder`: the side of a file whose name tells none.
pub(crate) fn selection(folder: &Path) -> Selection {
    let untold = folder.join("example.grb");
    Selection { front: untold.is_file().then_some(untold), ..Selection::default() }
}

/// None where there are no boards.
fn all() -> Vec<Layer> {
    let mut layers = Vec::new();
    for folder in board_folders() {
        let Ok(loaded) = import::survey(std::slice::from_ref(&folder), &selection(&folder)) else {
            continue;
        };
        let board = loaded.board;
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        for copper in [board.front, board.back].into_iter().flatten() {
            let name = format!("{name} {}", copper.side);
            layers.push(Layer { name, copper, outline: board.outline.clone() });
        }
    }
    layers
}
