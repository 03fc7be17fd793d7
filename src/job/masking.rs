//! A side of a board as a mask: what is inked, for a page that both sides share.

use crate::board::diagnostic::planning;
use crate::board::{Board, Copper, Side, Warning};
use crate::geometry::Nm;
use crate::import::Loaded;
use crate::report::mask::{Parted, Sheet, What, ground};
use crate::report::picture;
use crate::topology;

use super::pipeline::refuse_cut_off;
use super::plain::{self, method};
use super::{Error, Settings};

/// How a mask is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Masking {
    /// The side.
    pub side: Side,
    /// What of it.
    pub what: What,
    /// How far regions are apart.
    pub gap: Nm,
    /// How much larger openings are than pads, on every side.
    pub clearance: Nm,
    /// How far the page reaches beyond the board.
    pub margin: Nm,
    /// Whether the ink is what is not meant.
    pub negative: bool,
}

/// The narrowest gap between regions. Chosen: a tenth of what is etched.
const NARROWEST: Nm = Nm::from_um(10);
/// The widest gap, clearance or margin. Chosen: beyond it a unit is mistaken.
const WIDEST: Nm = Nm::from_mm(50);

/// The mask of a side, with what a person must know.
///
/// # Errors
///
/// [`Error::Value`] for lengths that make no sense, [`Error::NoCopper`] for a side without copper
/// or pads, [`Error::Truncated`] for files that were cut off, [`Error::Voronoi`] where regions
/// cannot be found.
pub fn mask(loaded: &Loaded, settings: &Settings, masking: &Masking) -> Result<(Sheet, Vec<Warning>), Error> {
    masking.judge()?;
    refuse_cut_off(&loaded.warnings)?;
    let (board, side) = (&loaded.board, masking.side);
    let copper = board.copper(side).filter(|copper| !copper.features.is_empty());
    let copper = copper.ok_or_else(|| Error::NoCopper(format!("on the {side}")))?;
    let nets = topology::recover(copper, method(settings.asked.topology));
    let mut warnings = topology::names_check(copper, &nets);
    // Both sides have the same page, so that they register.
    let has_frame = masking.what == What::Regions && board.outline.is_none();
    let rim = if has_frame { settings.frame_margin } else { Nm::ZERO };
    let of_copper = [&board.front, &board.back].into_iter().flatten().filter_map(Copper::bounds);
    let all = of_copper.map(|bounds| bounds.inflate(rim));
    let area = all.chain(picture::whole(board, Nm::ZERO)).reduce(crate::geometry::Rect::union);
    let area = area.ok_or_else(|| Error::NoCopper("in these files".to_owned()))?;
    let sheet = match masking.what {
        What::Copper => Sheet::copper(board, copper, &nets, area),
        What::Openings => openings(board, copper, &nets, area, masking.clearance, &mut warnings)?,
        What::Regions => {
            let (diagram, boundaries) = plain::diagram(copper, &nets, board.outline.as_ref(), settings)?;
            warnings.extend_from_slice(diagram.warnings());
            let ground = ground(board.outline.as_ref(), diagram.frame());
            let ground = ground.ok_or_else(|| Error::NoCopper(format!("on the {side}")))?;
            let side = Parted { board, copper, nets: &nets, boundaries: &boundaries };
            let (sheet, found) = Sheet::regions(&side, area, &ground, masking.gap);
            warnings.extend(found);
            sheet
        }
    };
    let sheet = sheet.with_margin(masking.margin);
    Ok((if masking.negative { sheet.inverted() } else { sheet }, warnings))
}

/// Openings for the pads of a side; there must be some.
fn openings(
    board: &Board,
    copper: &Copper,
    nets: &topology::Nets,
    area: crate::geometry::Rect,
    clearance: Nm,
    warnings: &mut Vec<Warning>,
) -> Result<Sheet, Error> {
    let sheet = Sheet::openings(board, copper, nets, area, clearance);
    if sheet.nets.is_empty() {
        let place =
            format!("on the {} that is a pad: nothing is flashed, and no file declares one", copper.side);
        return Err(Error::NoCopper(place));
    }
    let message = format!(
        "openings are the pads of the copper, {clearance:.3} mm larger; solder-mask files are not read"
    );
    warnings.push(planning::MASK_FROM_PADS.warning(message).on(copper.side));
    Ok(sheet)
}

impl Masking {
    /// Whether all lengths make sense.
    fn judge(&self) -> Result<(), Error> {
        let within = |key, length: Nm, least: Nm| {
            let problem =
                format!("{length:.3} mm is out of range: expected from {least:.3} mm to {WIDEST:.0} mm");
            if (least..=WIDEST).contains(&length) { Ok(()) } else { Err(Error::Value { key, problem }) }
        };
        within("gap", self.gap, NARROWEST)?;
        within("clearance", self.clearance, Nm::ZERO)?;
        within("margin", self.margin, Nm::ZERO)
    }
}
