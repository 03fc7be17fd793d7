//! Which nets of a layer are neighbours, by thinning and by Voronoi regions.

use crate::board::{Board, Copper};
use crate::grid::Grid;
use crate::report::neighbours::NeighboursEntry;
use crate::report::picture;
use crate::report::thinning::Thinning;
use crate::topology;

use super::{Error, Settings, plain};

/// The neighbours among the nets of `copper`, a side of `board`, by `thinning` of its picture, or
/// else of one that is drawn of it with its holes, and by Voronoi regions of all of it, whatever
/// the outline.
///
/// # Errors
///
/// [`Error`] for a side without copper, or too large to be drawn.
pub fn neighbours(
    copper: &Copper,
    board: &Board,
    settings: &Settings,
    thinning: Option<Thinning>,
) -> Result<NeighboursEntry, Error> {
    let nets = topology::recover(copper, plain::method(settings.asked.topology));
    let (_, boundaries) = plain::diagram(copper, &nets, None, settings)?;
    let thinning = match thinning {
        Some(thinning) => thinning,
        None => {
            let pixel = settings.picture_pixel();
            let area = picture::whole(board, pixel * 4);
            let area = area.ok_or_else(|| Error::NoCopper("to draw".to_owned()))?;
            let grid = Grid::covering(area, pixel)?;
            picture::within_reason(&grid)?;
            Thinning::of_side(copper, &board.holes, grid)
        }
    };
    Ok(NeighboursEntry::new(copper, &nets, &thinning, &boundaries))
}
