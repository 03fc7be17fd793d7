//! Settings that are lengths like any others, and make no sense on a machine.

use crate::geometry::Nm;
use crate::toolpath::{Feed, ToolKind};
use crate::verify;

use super::quantity::{Length, Triple};
use super::settings::{given, positive};
use super::{Cutting, Error, Options, Profile};

/// The options with what a machine says where a person left it open: its dialect, and the default
/// speeds no faster than it goes.
pub(super) fn defaults_for(profile: Option<&Profile>, mut options: Options) -> Options {
    let Some(profile) = profile else { return options };
    let usual = Options::defaults();
    options.dialect = options.dialect.or_else(|| profile.dialect.clone());
    let machine = profile.machine();
    let limited = |speed: Option<Feed>, most: Feed| speed.filter(|&speed| speed > most).map(|_| most);
    if let Some([x, y, z]) = machine.feed {
        options.feed = options.feed.or_else(|| limited(usual.feed, x.min(y)));
        options.plunge = options.plunge.or_else(|| limited(usual.plunge, z));
    }
    if let Some((least, most)) = machine.spindle {
        let turns = usual.spindle.map(|turns| turns.clamp(least, most));
        options.spindle = options.spindle.or(turns.filter(|_| turns != usual.spindle));
    }
    options
}

/// A number as large as it can be meant: the command line says the same, a settings file has
/// nothing else that does.
pub(super) fn count(
    key: &'static str,
    count: Option<u32>,
    range: std::ops::RangeInclusive<u32>,
) -> Result<(), Error> {
    match count.filter(|count| !range.contains(count)) {
        None => Ok(()),
        Some(count) => {
            let problem = format!("`{count}` makes no sense: expected {} to {}", range.start(), range.end());
            Err(Error::Value { key, problem })
        }
    }
}

/// The height for travel: one that clears the surface as a rapid must.
pub(super) fn travel_height(key: &'static str, height: Option<Length>) -> Result<Nm, Error> {
    let safe = positive(key, height)?;
    let least = verify::Settings::default().clearance;
    if safe < least {
        return wrong(key, safe, &format!("the tool travels {} above the surface at least", Length(least)));
    }
    Ok(safe)
}

/// How much each of the passes down to `depth` takes.
pub(super) fn step(key: &'static str, step: Option<Length>, depth: Nm) -> Result<Option<Nm>, Error> {
    /// Chosen: of a board of 2 mm each would take 2 µm.
    const MOST: i64 = 1000;
    let step = given(key, step)?;
    if let Some(step) = step.filter(|&step| step * MOST < depth) {
        return wrong(key, step, &format!("down to {} that would be more than {MOST} steps", Length(depth)));
    }
    Ok(step)
}

/// How far a drill may differ from its hole.
pub(super) fn drill_tolerance(options: &Options) -> Result<Nm, Error> {
    let tolerance = options.drill_tolerance.expect("the defaults leave no length open").nm();
    if tolerance < Nm::ZERO {
        wrong("drill-tolerance", tolerance, "it must be zero or more")
    } else {
        Ok(tolerance)
    }
}

/// Diameter and distance of the holes on whose pins the board is flipped, which lie beside it.
pub(super) fn alignment(options: &Options) -> Result<Option<(Nm, Nm)>, Error> {
    let margin = positive("alignment-margin", options.alignment_margin)?;
    let Some(diameter) = given("alignment-holes", options.alignment_holes)? else { return Ok(None) };
    if margin < diameter / 2 {
        let expected = format!("holes of {} so far from the board reach into it", Length(diameter));
        return wrong("alignment-margin", margin, &expected);
    }
    Ok(Some((diameter, margin)))
}

/// How deep the holes for pins go, which must be through the board.
pub(super) fn alignment_depth(options: &Options, thickness: Nm) -> Result<Option<Nm>, Error> {
    let depth = given("alignment-depth", options.alignment_depth)?;
    match depth.filter(|&depth| depth <= thickness) {
        Some(depth) => {
            let expected = format!("a board of {} is not drilled through", Length(thickness));
            wrong("alignment-depth", depth, &expected)
        }
        None => Ok(depth),
    }
}

/// How far the machine goes.
pub(super) fn machine_travel(options: &Options) -> Result<Option<[Nm; 3]>, Error> {
    let Some(Triple(travel)) = options.machine_travel else { return Ok(None) };
    let travel = travel.map(Length::nm);
    match travel.iter().find(|&&length| length <= Nm::ZERO) {
        Some(&length) => wrong("machine-travel", length, "it must be more than zero"),
        None => Ok(Some(travel)),
    }
}

/// The least depth to which a V-bit may rise, where there is one that goes deeper.
pub(super) fn adaptive_depth(options: &Options, cuttings: &[Cutting]) -> Result<Option<Nm>, Error> {
    let Some(least) = given("adaptive-depth", options.adaptive_depth)? else { return Ok(None) };
    let is_v_bit = |cutting: &&Cutting| matches!(cutting.tool.kind, ToolKind::VBit { .. });
    let deepest = cuttings.iter().filter(is_v_bit).map(|cutting| cutting.heights.cut).max();
    match deepest {
        None => wrong("adaptive-depth", least, "only a V-bit cuts narrower where it rises"),
        Some(deepest) if least >= deepest => wrong(
            "adaptive-depth",
            least,
            &format!("it must be less than the {} of the cut", Length(deepest)),
        ),
        Some(_) => Ok(Some(least)),
    }
}

/// The widest isolating cut. Chosen: wider ones leave nothing of a board, and take minutes to say
/// so.
const WIDEST: Nm = Nm::from_mm(10);

/// Fails for tools that would cut boards away.
pub(super) fn kerfs(cuttings: &[Cutting]) -> Result<(), Error> {
    match cuttings.iter().find(|cutting| cutting.kerf() > WIDEST) {
        None => Ok(()),
        Some(cutting) => {
            let (name, depth) = (&cutting.tool.name, Length(cutting.heights.cut));
            let problem = format!(
                "`{name}` cuts {} wide at a depth of {depth}: expected {} at most",
                Length(cutting.kerf()),
                Length(WIDEST)
            );
            Err(Error::Value { key: "tool", problem })
        }
    }
}

fn wrong<T>(key: &'static str, value: Nm, expected: &str) -> Result<T, Error> {
    Err(Error::Value { key, problem: format!("`{}` makes no sense: {expected}", Length(value)) })
}
