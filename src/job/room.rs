//! Whether there is room for what is milled of a board beside it: to the next tile, and to the pins
//! on which the stock is flipped.
//!
//! ```text
//!  ┌──────┐╴╴╴╴┐     ┌╴╴╴╴┌──────┐
//!  │board │cut ┊strip┊ cut│ board│  tabs hold the boards to the strip
//!  └──────┘╴╴╴╴┘     └╴╴╴╴└──────┘
//!          ←     spacing     →
//! ```

use crate::board::Side;
use crate::geometry::{Nm, Point, Rect};
use crate::toolpath::Program;

use super::stock::Stock;
use super::{Error, Length, Part, Settings};

/// Fails where a tile is cut into by its neighbour's program, where the cuts round two leave
/// nothing between them to hold their tabs, and where the pins stand in what is milled.
pub(super) fn check(
    planned: &[(Part, Side, Program)],
    stock: &Stock,
    settings: &Settings,
) -> Result<(), Error> {
    let milled = |wanted: fn(Part) -> bool| {
        planned.iter().filter(move |(part, ..)| wanted(*part)).filter_map(|(part, side, program)| {
            // Seen from the front, as the tiles and the pins are.
            Some((*part, stock.turned(*side, program.milled()?)))
        })
    };
    let works: Vec<(Part, Rect)> = milled(|part| part != Part::Alignment).collect();
    if let Some((_, spacing)) = settings.tiles {
        works.iter().try_for_each(|&(part, milled)| tiles(part, beyond(stock, milled), spacing))?;
    }
    let pins: Vec<Rect> = milled(|part| part == Part::Alignment).map(|(_, pins)| pins).collect();
    let all = works.into_iter().map(|(_, milled)| stock.over_all_tiles(milled)).reduce(Rect::union);
    match (pins.first(), all) {
        (Some(pins), Some(milled)) => alignment(*pins, milled, stock, settings),
        _ => Ok(()),
    }
}

/// How far what is milled of the first tile reaches beyond it: to the left and right, down and up.
fn beyond(stock: &Stock, milled: Rect) -> [[Nm; 2]; 2] {
    let (tile, none) = (stock.tile, Nm::ZERO);
    let along = |of: fn(Point) -> Nm| {
        let [low, high] = [of(tile.min()) - of(milled.min()), of(milled.max()) - of(tile.max())];
        [low.max(none), high.max(none)]
    };
    [along(|p| p.x), along(|p| p.y)]
}

/// What is no strip: curves are rounded. Chosen.
const NOTHING: Nm = Nm::from_um(10);

fn tiles(part: Part, beyond: [[Nm; 2]; 2], spacing: Nm) -> Result<(), Error> {
    let is_cut_out = part == Part::Cutout;
    // What is cut round two boards must leave a strip between them.
    let needed = beyond.map(|[low, high]| if is_cut_out { low + high } else { low.max(high) });
    let needed = needed[0].max(needed[1]);
    let (has, needs) = (Length(spacing), rounded_up(needed));
    let problem = match part {
        Part::Cutout if spacing < needed + NOTHING => format!(
            "{has} between the tiles leaves nothing between the cuts round them, so that tabs hold no board: it \
             must be more than {needs}, twice the width of the cut"
        ),
        _ if spacing + NOTHING < needed => format!(
            "at {has} what is milled of one tile cuts into the next: it reaches {needs} beyond the board"
        ),
        _ => return Ok(()),
    };
    Err(Error::Value { key: "tile-spacing", problem })
}

/// The holes for pins lie above and below everything.
fn alignment(pins: Rect, milled: Rect, stock: &Stock, settings: &Settings) -> Result<(), Error> {
    let Some((diameter, margin)) = settings.alignment else { return Ok(()) };
    let above = Rect::new(Point::new(pins.min().x, pins.max().y - diameter), pins.max());
    let below = Rect::new(pins.min(), Point::new(pins.max().x, pins.min().y + diameter));
    if !above.touches(milled) && !below.touches(milled) {
        return Ok(());
    }
    let all = stock.bounds;
    let beyond = (milled.max().y - all.max().y).max(all.min().y - milled.min().y);
    let problem = format!(
        "at {} the pins stand in what is milled, {} wide round the board: it must be more than {}",
        Length(margin),
        rounded_up(beyond),
        rounded_up(beyond + diameter / 2),
    );
    Err(Error::Value { key: "alignment-margin", problem })
}

/// To the next hundredth of a millimetre, but for the nanometres of curves that are rounded.
fn rounded_up(length: Nm) -> Length {
    let hundredth = Nm::from_um(10).get();
    Length(Nm::new((length.get() - 10).div_euclid(hundredth) * hundredth + hundredth))
}
