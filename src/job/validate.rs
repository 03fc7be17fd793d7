//! Settings that are lengths like any others, and make no sense on a machine.

use crate::geometry::Nm;
use crate::toolpath::{Feed, ToolKind};
use crate::verify::THINNEST_TAB;

use super::checked::{given, positive, wrong};
use super::cutting::COPPER;
use super::options::Complete;
use super::quantity::{Length, Triple};
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

/// How far the machine goes.
pub(super) fn machine_travel(options: &Complete) -> Result<Option<[Nm; 3]>, Error> {
    let Some(Triple(travel)) = options.machine_travel else { return Ok(None) };
    let travel = travel.map(Length::nm);
    match travel.iter().find(|&&length| length <= Nm::ZERO) {
        Some(&length) => wrong("machine-travel", length, "it must be more than zero"),
        None => Ok(Some(travel)),
    }
}

/// The least depth to which a V-bit may rise, where there is one that goes deeper.
pub(super) fn adaptive_depth(options: &Complete, cuttings: &[Cutting]) -> Result<Option<Nm>, Error> {
    let Some(least) = given("adaptive-depth", options.adaptive_depth)? else { return Ok(None) };
    let is_v_bit = |cutting: &&Cutting| matches!(cutting.tool.kind, ToolKind::VBit { .. });
    let deepest = cuttings.iter().filter(is_v_bit).map(|cutting| cutting.heights.cut).max();
    match deepest {
        None => wrong("adaptive-depth", least, "only a V-bit cuts narrower when raised"),
        Some(deepest) if least >= deepest => wrong(
            "adaptive-depth",
            least,
            &format!("it must be less than the {} of the cut", Length(deepest)),
        ),
        // As thick as `verify` has it unasked.
        Some(_) if least < COPPER => wrong(
            "adaptive-depth",
            least,
            &format!("it must be {} at least, as thick as copper is", Length(COPPER)),
        ),
        Some(_) => Ok(Some(least)),
    }
}

/// Fails for tabs that hold nothing, and for those that leave the `cut` or the `board` uncut.
pub(super) fn tabs(height: Nm, cut: Nm, board: Nm) -> Result<(), Error> {
    let (what, deep) = if cut < board { ("a cut", cut) } else { ("a board", board) };
    let [tabs, limit, least] = [height, deep, THINNEST_TAB].map(Length);
    let problem = if height >= deep {
        format!("tabs of {tabs} in {what} of {limit} would leave it uncut")
    } else if height < THINNEST_TAB {
        format!("tabs of {tabs} would break when they are looked at: expected {least} or more")
    } else {
        return Ok(());
    };
    Err(Error::Value { key: "tab-height", problem })
}

/// How far a cut may be from its place: with more than a fifth of the narrowest it would go
/// wherever lines and arcs are fewest.
pub(super) fn tolerance(options: &Complete, cuttings: &[Cutting]) -> Result<Nm, Error> {
    let tolerance = positive("tolerance", options.tolerance)?;
    let finest = cuttings.iter().map(Cutting::kerf).min().unwrap_or(Nm::ZERO);
    let most = (finest / 5).max(Options::defaults().tolerance.map_or(Nm::ZERO, Length::nm));
    if tolerance > most {
        let most = Length(most);
        return wrong(
            "tolerance",
            tolerance,
            &format!("it must be at most {most}, a fifth of the finest cut"),
        );
    }
    Ok(tolerance)
}

/// How far regions reach, if they end before their neighbours': no nearer to copper than half of
/// the narrowest cut, which runs there.
pub(super) fn limit(options: &Complete, cuttings: &[Cutting]) -> Result<Option<Nm>, Error> {
    let Some(limit) = given("limit", options.limit)? else { return Ok(None) };
    let narrowest = cuttings.iter().map(Cutting::kerf).min().unwrap_or(Nm::ZERO);
    // Rounded up, so that what is said is accepted.
    let least = Nm::from_um((narrowest.get() + 1_999) / 2_000);
    if limit * 2 >= narrowest {
        return Ok(Some(limit));
    }
    let problem = format!(
        "a cut {} wide would run into the copper that it goes round: expected at least {}",
        Length(narrowest),
        Length(least)
    );
    wrong("limit", limit, &problem)
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
