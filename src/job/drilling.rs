//! How holes are drilled, and those on whose pins the board is flipped: what the options say of it.

use crate::geometry::Nm;
use crate::toolpath::{Angle, DrillSpeeds, ParseToolError, Tool, ToolKind};

use super::Error;
use super::checked::{given, positive, wrong};
use super::options::Complete;
use super::quantity::{DrillChoice, Drills, Length};
use super::tools::{ToolChoice, Workshop, point_angle};

/// The tools at hand, with the speeds of those that do not say theirs.
pub(super) fn workshop(options: &Complete) -> Result<Workshop<'_>, Error> {
    Ok(Workshop {
        library: &options.tools,
        feed: options.feed,
        plunge: options.plunge,
        spindle: options.spindle,
        drilling: drill_speeds(options),
        point: tip_angle(options)?,
    })
}

/// How drills are run: as fast as the machine turns, or, where nothing is known of it, as fast as
/// its cutters are to turn.
fn drill_speeds(options: &Complete) -> DrillSpeeds {
    let machine = options.machine.as_ref().map(|machine| machine.0.machine());
    let usual = options.spindle;
    let turns = match machine.and_then(|machine| machine.spindle) {
        Some((least, most)) if most < u32::MAX => (least, most),
        Some((least, _)) => (least, usual.max(least)),
        None => (0, usual),
    };
    DrillSpeeds {
        plunge: options.drill_plunge,
        spindle: options.drill_spindle,
        material: options.material,
        turns,
        most: machine.and_then(|machine| machine.feed).map(|[.., z]| z),
    }
}

/// The tip of drills that do not say theirs.
fn tip_angle(options: &Complete) -> Result<Angle, Error> {
    point_angle(options.drill_tip_angle).map_err(|problem| Error::Value { key: "drill-tip-angle", problem })
}

/// The drills at hand.
pub(super) fn drills(choices: Option<&Drills>, workshop: &Workshop<'_>) -> Result<Vec<Tool>, Error> {
    let drill = |choice: &DrillChoice| match choice {
        DrillChoice::Diameter(length) => {
            let diameter = positive("drills", *length)?;
            Ok(workshop.fetch("drills", &ToolChoice::Kind(ToolKind::Drill { diameter }))?.tool)
        }
        DrillChoice::Named(name) => {
            let refused = |error: ParseToolError| Error::Value { key: "drills", problem: error.to_string() };
            let tool = workshop.fetch("drills", &name.parse().map_err(refused)?)?.tool;
            if matches!(tool.kind, ToolKind::Drill { .. }) {
                return Ok(tool);
            }
            Err(Error::Value { key: "drills", problem: format!("`{name}` is not a drill") })
        }
    };
    choices.map_or_else(|| Ok(Vec::new()), |Drills(all)| all.iter().map(drill).collect())
}

/// How far a drill may differ from its hole.
pub(super) fn drill_tolerance(options: &Complete) -> Result<Nm, Error> {
    let tolerance = options.drill_tolerance.nm();
    if tolerance < Nm::ZERO {
        wrong("drill-tolerance", tolerance, "it must be zero or more")
    } else {
        Ok(tolerance)
    }
}

/// Diameter and distance of the holes on whose pins the board is flipped, which lie beside it.
pub(super) fn alignment(options: &Complete) -> Result<Option<(Nm, Nm)>, Error> {
    let margin = positive("alignment-margin", options.alignment_margin)?;
    let Some(diameter) = given("alignment-holes", options.alignment_holes)? else { return Ok(None) };
    if margin < diameter / 2 {
        let expected = format!("at this distance holes of {} reach into the board", Length(diameter));
        return wrong("alignment-margin", margin, &expected);
    }
    Ok(Some((diameter, margin)))
}

/// How deep the holes for pins go, which must be through the board.
pub(super) fn alignment_depth(options: &Complete, thickness: Nm) -> Result<Option<Nm>, Error> {
    let depth = given("alignment-depth", options.alignment_depth)?;
    match depth.filter(|&depth| depth <= thickness) {
        Some(depth) => {
            let expected = format!("it does not go through a board of {}", Length(thickness));
            wrong("alignment-depth", depth, &expected)
        }
        None => Ok(depth),
    }
}
