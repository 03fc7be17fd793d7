//! Lengths and counts of the options, checked: what a later stage takes without asking again.

use std::ops::RangeInclusive;

use super::Error;
use super::quantity::{Length, ToolChangeAt, Triple};
use crate::geometry::Nm;
use crate::verify;

/// A length that may be left open.
pub(super) fn given(key: &'static str, length: Option<Length>) -> Result<Option<Nm>, Error> {
    length.map(|length| positive(key, length)).transpose()
}

/// A length that must be more than zero.
pub(super) fn positive(key: &'static str, length: Length) -> Result<Nm, Error> {
    if length.nm() > Nm::ZERO {
        return Ok(length.nm());
    }
    if length.nm() < Nm::ZERO && key.ends_with("depth") {
        let problem = format!("depths are positive here: write `{}`, not `{length}`", Length(-length.nm()));
        return Err(Error::Value { key, problem });
    }
    Err(Error::Value { key, problem: format!("`{length}` is invalid: it must be more than zero") })
}

/// A number as large as it can be meant: the command line says the same, a settings file has
/// nothing else that does.
pub(super) fn count(key: &'static str, count: Option<u32>, range: RangeInclusive<u32>) -> Result<(), Error> {
    match count.filter(|count| !range.contains(count)) {
        None => Ok(()),
        Some(count) => {
            let problem = format!("`{count}` is invalid: expected {} to {}", range.start(), range.end());
            Err(Error::Value { key, problem })
        }
    }
}

/// The height for travel: one that clears the surface as a rapid must.
pub(super) fn travel_height(key: &'static str, height: Length) -> Result<Nm, Error> {
    let safe = positive(key, height)?;
    let least = verify::Settings::default().clearance;
    if safe < least {
        return wrong(key, safe, &format!("the tool travels {} above the surface at least", Length(least)));
    }
    Ok(safe)
}

/// Refuses a place to wait at that is lower than the tool travels.
pub(super) fn parking_height(key: &'static str, at: Option<ToolChangeAt>, safe: Nm) -> Result<(), Error> {
    let height = match at {
        Some(ToolChangeAt::Place(Triple([.., z])) | ToolChangeAt::Height(z)) => z,
        None => return Ok(()),
    };
    if height.nm() < safe {
        let expected = format!("the tool waits no lower than it travels, at {}", Length(safe));
        return wrong(key, height.nm(), &expected);
    }
    Ok(())
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

/// A value that is invalid, and what was expected.
pub(super) fn wrong<T>(key: &'static str, value: Nm, expected: &str) -> Result<T, Error> {
    Err(Error::Value { key, problem: format!("`{}` is invalid: {expected}", Length(value)) })
}
