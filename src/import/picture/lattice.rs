//! The size of a pixel, by the grid on which drill dots lie.
//!
//! The pins of most parts are a tenth of an inch apart, so a picture that does not say how large it
//! is says it all the same. Of each dot the next one to the right and the next one above count;
//! their distances are whole multiples of the pitch, or most of them are. The pitch is the longest
//! of which that is so: each part of it would do as well. Then pairs farther and farther apart make
//! it finer, as long as it is sure how many pitches lie between them.

use crate::board::{Warning, Words};
use crate::geometry::Nm;
use crate::import::diagnostic;
use crate::import::error::Error;

use super::decode::Decoded;
use super::motion::Place;
use super::scale::Scale;

/// How far a dot may be off its place, in pixels. Chosen: the middles of dots of two values are
/// within half a pixel of theirs, so that the distance of two is within one.
const OFF: f64 = 1.0;

/// The shortest pitch, in pixels: below it every distance is near a multiple. Chosen.
const SHORTEST: f64 = 8.0;

/// The part of the distances that must be multiples of the pitch. Chosen: some parts are not on the
/// grid, vias seldom are.
const SHARE: f64 = 0.6;

/// How many distances must be multiples of the pitch. Chosen.
const LEAST: usize = 6;

/// How many pitches apart the next dot may be at most. Chosen: farther off, the error of the first
/// guess is half a pitch.
const APART: u32 = 6;

/// The most dots that are looked at, since all pairs are. Chosen.
const MOST: usize = 2000;

/// The scale at which drill dots with their middles at `dots`, in pixels of the right shape, are
/// `pitch` apart.
pub(super) fn scale(
    name: &str,
    decoded: &Decoded,
    shape: Place,
    dots: &[Place],
    pitch: Nm,
    warnings: &mut Vec<Warning>,
) -> Result<Scale, Error> {
    let hint = || {
        Words::of(
            "give the resolution ({picture-dpi} 600) or the width of the picture ({picture-width} 80mm) instead",
        )
    };
    let found = match lattice(&dots[..dots.len().min(MOST)]) {
        Found::Pitch(found) => found,
        Found::TooFew(count) => {
            let what = format!(
                "the grid of its drill dots cannot be measured: of {} dots, {count} have a neighbour in line with \
                 them, at least {LEAST} are needed",
                dots.len()
            );
            return Err(Error::content(name, what, hint()));
        }
        Found::NoGrid => {
            let what = format!(
                "the grid of its drill dots cannot be measured: the distances of {} dots have no common divisor",
                dots.len()
            );
            return Err(Error::content(name, what, hint()));
        }
    };
    let unit = pitch.to_f64() / found;
    let scale = Scale::new(name, decoded, (unit * shape.0, unit * shape.1))?;
    let dpi = scale.dpi().0;
    let message = format!(
        "the drill dots lie on a grid of {found:.2} pixels: {dpi:.1} DPI with a pitch of {} mm",
        pitch.to_mm()
    );
    warnings.push(diagnostic::PICTURE_PITCH.warning(message));
    if let Some((said, _)) = decoded.dpi.filter(|said| is_a_multiple(dpi / said.0)) {
        let message = format!(
            "by its drill dots the picture has {dpi:.0} DPI, the file says {said:.0}: another pitch may be meant"
        );
        warnings.push(diagnostic::PICTURE_PITCH_DISPUTED.warning(message));
    }
    Ok(scale)
}

/// Whether two resolutions differ as if the grid were another: twice, three or four times as fine
/// or coarse, within 3 %.
fn is_a_multiple(ratio: f64) -> bool {
    [2.0, 3.0, 4.0]
        .into_iter()
        .any(|times| [times, 1.0 / times].iter().any(|r| (ratio / r - 1.0).abs() < 0.03))
}

/// The shape of pixels: one across, and so many down as the file says.
pub(super) fn shape(decoded: &Decoded) -> Place {
    (1.0, decoded.dpi.map_or(1.0, |(x, y)| x / y))
}

/// What the distances of dots say.
#[derive(Debug, PartialEq)]
enum Found {
    /// The pitch in the unit of the places.
    Pitch(f64),
    /// So few dots have neighbours.
    TooFew(usize),
    /// Distances without a common divisor.
    NoGrid,
}

/// The pitch of dots that lie along the axes.
fn lattice(dots: &[Place]) -> Found {
    let steps = neighbours(dots);
    if steps.len() < LEAST {
        return Found::TooFew(steps.len());
    }
    let mut tried: Vec<f64> =
        steps.iter().flat_map(|step| (1..=APART).map(move |part| step / f64::from(part))).collect();
    tried.retain(|&pitch| pitch >= SHORTEST);
    tried.sort_by(|a, b| b.total_cmp(a));
    tried.dedup_by(|a, b| (*a - *b).abs() < 0.05);
    let most = steps.len();
    let fits = |&pitch: &f64| {
        let pitch = refined(&steps, pitch, f64::from(APART) + 0.5)?;
        let count = steps.iter().filter(|&&step| is_multiple(step, pitch)).count();
        (count >= LEAST && share(count, most) >= SHARE).then_some(pitch)
    };
    let Some(mut pitch) = tried.iter().find_map(fits) else { return Found::NoGrid };
    let all = in_line(dots);
    for reach in [6.5, 16.5, 48.5, 160.5, f64::INFINITY] {
        pitch = refined(&all, pitch, reach).unwrap_or(pitch);
    }
    Found::Pitch(pitch)
}

#[expect(clippy::cast_precision_loss, reason = "counts of dots")]
fn share(count: usize, of: usize) -> f64 {
    count as f64 / of as f64
}

/// Whether a distance is a whole multiple of `pitch`, within what dots may be off.
fn is_multiple(step: f64, pitch: f64) -> bool {
    let times = (step / pitch).round();
    times >= 1.0 && (step - times * pitch).abs() <= OFF.min(pitch / 8.0)
}

/// The pitch by least squares of the distances up to `reach` pitches that are near multiples of it.
fn refined(steps: &[f64], pitch: f64, reach: f64) -> Option<f64> {
    let (mut over, mut under) = (0.0, 0.0);
    for &step in steps {
        let times = (step / pitch).round();
        if times >= 1.0 && times <= reach && (step - times * pitch).abs() <= pitch / 8.0 {
            (over, under) = (over + step * times, under + times * times);
        }
    }
    (under > 0.0).then(|| over / under)
}

/// The distance of each dot to the next one to the right and to the next one above, where there is
/// one in line with it.
fn neighbours(dots: &[Place]) -> Vec<f64> {
    let mut steps = Vec::new();
    for &dot in dots {
        for turned in [false, true] {
            let along = dots.iter().filter_map(|&other| ahead(dot, other, turned));
            let next = along.fold(f64::INFINITY, f64::min);
            if next.is_finite() {
                steps.push(next);
            }
        }
    }
    steps
}

/// The distances of all pairs of dots that are in line.
fn in_line(dots: &[Place]) -> Vec<f64> {
    let pairs = dots.iter().flat_map(|&dot| {
        let ahead = move |&other: &Place| [false, true].map(|turned| ahead(dot, other, turned));
        dots.iter().flat_map(ahead).flatten()
    });
    pairs.collect()
}

/// How far `other` lies ahead of `dot`, to the right or, turned, above; none where it lies aside.
fn ahead(dot: Place, other: Place, turned: bool) -> Option<f64> {
    let (dx, dy) = (other.0 - dot.0, other.1 - dot.1);
    let (along, across) = if turned { (dy, dx) } else { (dx, dy) };
    // A far one may be aside by the error of the skew, too.
    (along >= SHORTEST && across.abs() <= OFF + along * 5e-4).then_some(along)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rows of pins a tenth of an inch apart, at 300.5 DPI, each off by up to a third of a pixel,
    /// and as many places of no grid as are asked for.
    fn board(aside: u32) -> Vec<Place> {
        let mut state = 12_345_u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1_u32 << 24) - 0.5
        };
        let pitch = 30.05;
        let mut dots = Vec::new();
        for (x, y, pins) in [(3.0, 4.0, 8), (3.0, 7.0, 8), (15.0, 2.0, 7), (14.0, 9.0, 10)] {
            for pin in 0..pins {
                let (dx, dy) = (noise() * 0.6, noise() * 0.6);
                dots.push(((x + f64::from(pin)) * pitch + dx, y * pitch + dy));
            }
        }
        for _ in 0..aside {
            dots.push((noise() * 900.0 + 450.0, noise() * 500.0 + 250.0));
        }
        dots
    }

    #[test]
    fn pins_tell_their_pitch_and_vias_beside_them_do_no_harm() {
        for aside in [0, 12] {
            let Found::Pitch(pitch) = lattice(&board(aside)) else { panic!("pins on a grid") };
            assert!((pitch / 30.05 - 1.0).abs() < 0.001, "{pitch} pixels with {aside} vias");
        }
    }

    #[test]
    fn few_dots_and_dots_without_a_grid_tell_nothing() {
        assert_eq!(lattice(&board(0)[..4]), Found::TooFew(3), "a row of four");
        let scattered: Vec<Place> = (0..12)
            .map(|at| (f64::from(at * at * 7 % 101) * 9.3 + f64::from(at), 50.0 + 0.1 * f64::from(at % 3)))
            .collect();
        assert_eq!(lattice(&scattered), Found::NoGrid, "{scattered:?}");
    }
}
