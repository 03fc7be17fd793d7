//! How boards are cut out of their stock: what the options say of it.

use crate::geometry::Nm;
use crate::toolpath::{Angle, Tool, ToolKind};

use super::Error;
use super::checked::given;
use super::options::Complete;
use super::quantity::{Length, Tiles};

/// What is left between the cuts round two tiles. Chosen: as wide as a usual cutter, and it holds
/// the tabs of both.
const BETWEEN_TILES: Nm = Nm::from_mm(1);

/// How often a board is made, and how far its copies are apart.
pub(super) fn tiles(options: &Complete, cutout_tool: &Tool) -> Result<Option<(Tiles, Nm)>, Error> {
    let spacing = given("tile-spacing", options.tile_spacing)?;
    let spacing = spacing.unwrap_or(cutout_tool.width_at(Nm::ZERO) * 2 + BETWEEN_TILES);
    Ok(options.tile.filter(|tiles| tiles.columns * tiles.rows > 1).map(|tiles| (tiles, spacing)))
}

/// How steeply the cutter goes down along the contour.
pub(super) fn ramp(angle: Option<Angle>) -> Result<Option<Angle>, Error> {
    if let Some(angle) = angle.filter(|&angle| angle <= Angle::ZERO || angle >= Angle::from_degrees(90)) {
        let problem = format!("`{angle}` is not a ramp angle: expected an angle between 0deg and 90deg");
        return Err(Error::Value { key: "cutout-ramp", problem });
    }
    Ok(angle)
}

/// A gap of nothing leaves the outline as it is drawn.
pub(super) fn outline_gap(options: &Complete) -> Result<Nm, Error> {
    /// Chosen: wider gaps are sides that are missing, not corners.
    const WIDEST: Nm = Nm::from_mm(5);
    let gap = options.outline_gap;
    if gap.nm() < Nm::ZERO || gap.nm() > WIDEST {
        let problem = format!("`{gap}` is invalid: it must be from 0mm to {}", Length(WIDEST));
        return Err(Error::Value { key: "outline-gap", problem });
    }
    Ok(gap.nm())
}

/// A tool that cuts sideways through a board.
pub(super) fn end_mill(key: &'static str, tool: Tool) -> Result<Tool, Error> {
    match tool.kind {
        ToolKind::EndMill { .. } => Ok(tool),
        ToolKind::VBit { .. } | ToolKind::Drill { .. } => {
            let problem = format!("`{}` cannot cut sideways through a board: name an endmill", tool.name);
            Err(Error::Value { key, problem })
        }
    }
}
