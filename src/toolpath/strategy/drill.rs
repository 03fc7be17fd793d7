//! Drilling: every hole once, the same bit for all it fits, the way between the holes short.

use std::collections::BTreeMap;

use super::bore;
use crate::board::diagnostic::{count, planning};
use crate::board::{Hole, Warning};
use crate::geometry::{Nm, Path, Point, RectIndex, Segment};
use crate::toolpath::head::Head;
use crate::toolpath::order::{Order, Stretch, arrange};
use crate::toolpath::{Angle, DrillSpeeds, Heights, Placement, Section, Tool, ToolKind};

/// How holes are drilled.
#[derive(Clone, Copy, Debug)]
pub struct Drilling<'a> {
    /// The drills at hand; where there are none, each diameter in the files is taken to be at hand.
    pub drills: &'a [Tool],
    /// How far a hole may become larger or smaller than the files say.
    pub tolerance: Nm,
    /// The end mill that bores holes for which no drill is at hand and mills slots; none
    /// chain-drills slots.
    pub mill: Option<&'a Tool>,
    /// The diameter from which on holes are bored whatever drills are at hand; none where drills go
    /// before.
    pub bored_from: Option<Nm>,
    /// How high and how deep; the step is the peck.
    pub heights: Heights,
    /// How deep a turn of boring goes at most; none where the mill's width alone bounds it.
    pub turn: Option<Nm>,
    /// Whether that depth is the full diameter's: each drill goes deeper by its tip.
    pub tips: bool,
    /// Whether the thinnest of all drills that the holes need drills them all.
    pub one: bool,
    /// From board to machine.
    pub placement: &'a Placement,
    /// How the holes are ordered.
    pub order: Order,
    /// How long the drill stays at the bottom, in milliseconds.
    pub dwell: u32,
    /// How drills are run that are only taken to be at hand.
    pub speeds: DrillSpeeds,
    /// The tip of those drills.
    pub point: Angle,
}

/// The thickest drill that is taken to be at hand unasked, where a mill can bore instead. Chosen:
/// the shank of drills for boards has 3.175 mm, and M3 wants 3.2 mm.
const THICKEST: Nm = Nm::from_um(3200);

/// Drills all holes: a section for each drill, thin ones first, then one for what is bored.
///
/// Tools keep their numbers; drills that are only taken to be at hand all have 1, and who knows all
/// tools of a job numbers them.
///
/// Warned about: `no-drill-for-hole` where neither a drill nor the mill fits, `not-bored` where the
/// mill does not fit what it was to bore, `holes-overlap` where one drilled hole begins within
/// another.
pub fn drill(holes: &[Hole], settings: &Drilling<'_>) -> (Vec<Section>, Vec<Warning>) {
    let mut jobs: BTreeMap<(Nm, u32), (Tool, Vec<&Hole>)> = BTreeMap::new();
    let (mut bored, mut left, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
    let bits = holes.iter().filter(|_| settings.one).filter_map(|hole| match way(hole, settings)? {
        Way::Drilled(tool) => Some(tool),
        Way::Bored => None,
    });
    let thinnest = bits.min_by_key(|tool| tool.width_at(Nm::ZERO));
    for hole in holes {
        match way(hole, settings) {
            Some(Way::Drilled(tool)) => {
                left.extend(is_wide(hole, settings).then_some(hole));
                let tool = thinnest.clone().unwrap_or(tool);
                let key = (tool.width_at(Nm::ZERO), tool.number);
                jobs.entry(key).or_insert_with(|| (tool, Vec::new())).1.push(hole);
            }
            Some(Way::Bored) => bored.push(hole),
            None => warnings.push(missing(hole)),
        }
    }
    warnings.extend(settings.mill.and_then(|mill| not_bored(&left, mill)));
    let plunged = jobs.values().flat_map(|(_, holes)| holes.iter().copied());
    warnings.extend(overlaps(&plunged.filter(|hole| !hole.is_slot()).collect::<Vec<_>>()));
    let mut sections: Vec<Section> = Vec::with_capacity(jobs.len() + 1);
    sections.extend(jobs.into_values().map(|(tool, holes)| section(tool, &holes, settings)));
    if let Some(mill) = settings.mill.filter(|_| !bored.is_empty()) {
        let heights = Heights { step: settings.turn, ..settings.heights };
        sections.push(bore::bore(&bored, mill, heights, settings.placement, settings.order));
    }
    (sections, warnings)
}

/// The holes as wide as [`drill`] makes them; without those that a thinner drill only marks, and
/// those that it leaves out.
pub fn drilled(holes: &[Hole], settings: &Drilling<'_>) -> Vec<Hole> {
    let made = |hole: &Hole| {
        let diameter = match way(hole, settings)? {
            Way::Bored => hole.diameter,
            Way::Drilled(_) if settings.one => return None,
            Way::Drilled(tool) => tool.width_at(Nm::ZERO),
        };
        Some(Hole { diameter, ..hole.clone() })
    };
    holes.iter().filter_map(made).collect()
}

/// How a hole is made.
enum Way {
    /// By a drill.
    Drilled(Tool),
    /// By the end mill.
    Bored,
}

/// How a hole is made; none where neither a drill nor the mill fits.
fn way(hole: &Hole, settings: &Drilling<'_>) -> Option<Way> {
    let fits = settings.mill.is_some_and(|mill| fits(hole, mill, settings));
    if fits && (hole.is_slot() || is_wide(hole, settings)) {
        return Some(Way::Bored);
    }
    bit(hole, settings).map(Way::Drilled).or(fits.then_some(Way::Bored))
}

/// How much wider than a hole the mill may be at most, whatever drills may. Chosen: the usual
/// tolerance.
const SLACK: Nm = Nm::from_um(100);

/// Whether the mill makes a hole hardly wider than it is.
fn fits(hole: &Hole, mill: &Tool, settings: &Drilling<'_>) -> bool {
    bore::fits(hole, mill, settings.tolerance.min(SLACK))
}

/// Whether a hole is so wide that it is to be bored though there is a drill.
fn is_wide(hole: &Hole, settings: &Drilling<'_>) -> bool {
    settings.bored_from.is_some_and(|from| hole.diameter >= from)
}

/// The drill for a hole: the nearest in diameter within the tolerance, the smaller of two as near.
fn bit(hole: &Hole, settings: &Drilling<'_>) -> Option<Tool> {
    if settings.drills.is_empty() {
        if hole.diameter > THICKEST && settings.mill.is_some_and(|mill| fits(hole, mill, settings)) {
            return None;
        }
        let diameter = as_sold(hole.diameter);
        let (plunge, spindle) = settings.speeds.of(diameter);
        let usual = Tool::new(ToolKind::Drill { diameter });
        return Some(Tool { plunge, spindle, point: settings.point, ..usual });
    }
    let off = |tool: &&Tool| (tool.width_at(Nm::ZERO) - hole.diameter).abs();
    let nearest =
        settings.drills.iter().min_by_key(|tool| (off(tool), tool.width_at(Nm::ZERO), tool.number))?;
    (off(&nearest) <= settings.tolerance).then(|| nearest.clone())
}

/// The drill for a diameter that was meant in millimetres and written in inches, where 1 mm is
/// 0.999998 mm or 1.00076 mm: in hundredths of a millimetre if it is a micrometre from them.
fn as_sold(diameter: Nm) -> Nm {
    const STEP: i64 = 10_000;
    const ROUNDING: Nm = Nm::from_um(1);
    let nearest = Nm::new((diameter.get() + STEP / 2) / STEP * STEP);
    if nearest > Nm::ZERO && (nearest - diameter).abs() <= ROUNDING { nearest } else { diameter }
}

/// The warning for a hole that no drill fits.
fn missing(hole: &Hole) -> Warning {
    let message = format!("no available drill is near {:.3} mm: the hole is not drilled", hole.diameter);
    planning::NO_DRILL_FOR_HOLE.warning(message).at(hole.path.start)
}

/// The warning for holes that are drilled though `mill` was to bore them, if any are.
fn not_bored(holes: &[&Hole], mill: &Tool) -> Option<Warning> {
    let first = holes.first()?;
    let what = count(holes.len(), "hole");
    let message = format!("`{}` does not fit {what} that it was to bore: drilled instead", mill.kind);
    Some(planning::NOT_BORED.warning(message).at(first.path.start))
}

/// The warning for holes that begin within others, if any do. One in the middle of another is only
/// widened.
fn overlaps(holes: &[&Hole]) -> Option<Warning> {
    /// So much neither bends a drill nor is more than rounding. Chosen.
    const NOTHING: Nm = Nm::from_um(50);
    let index = RectIndex::new(holes.iter().map(|hole| hole.bounds()));
    let do_overlap = |a: &Hole, b: &Hole| {
        let apart = a.path.start.distance(b.path.start);
        apart > NOTHING.to_f64() && apart < ((a.diameter + b.diameter) / 2 - NOTHING).to_f64()
    };
    let of = |i: usize| index.touching(holes[i].bounds()).into_iter().map(|j| holes[j]);
    let mut found = (0..holes.len()).filter(|&i| of(i).any(|other| do_overlap(holes[i], other)));
    let first = holes[found.next()?];
    let message = format!("{} drilled holes overlap each other", 1 + found.count());
    Some(planning::HOLES_OVERLAP.warning(message).at(first.path.start))
}

/// All holes of one drill.
fn section(tool: Tool, holes: &[&Hole], settings: &Drilling<'_>) -> Section {
    let tip = if settings.tips { tool.tip_length() } else { Nm::ZERO };
    let heights = Heights { cut: settings.heights.cut + tip, ..settings.heights };
    let mut head = Head::new(heights, tool.plunge);
    let chains: Vec<Vec<Point>> =
        holes.iter().map(|hole| chain(&settings.placement.path(&hole.path), hole.diameter)).collect();
    let ends = |chain: &Vec<Point>| Stretch::open(chain[0], chain[chain.len() - 1]);
    let stretches: Vec<Stretch> = chains.iter().map(ends).collect();
    for leg in arrange(&stretches, Point::default(), settings.order, 0.0) {
        let mut points = chains[leg.stretch].clone();
        if leg.reversed {
            points.reverse();
        }
        for point in halved(points.len()).into_iter().map(|index| points[index]) {
            plunge(&mut head, point, heights, settings.dwell);
        }
    }
    let label = format!("drill {:.3} mm, {}", tool.width_at(Nm::ZERO), count(holes.len(), "hole"));
    Section { tool, label, moves: head.finish() }
}

/// One hole: down in pecks, up to the approach height after each to clear the chips.
fn plunge(head: &mut Head, point: Point, heights: Heights, dwell: u32) {
    head.over(point);
    for (peck, depth) in heights.passes().enumerate() {
        if peck > 0 {
            head.rapid_to(heights.approach);
        }
        head.plunge(depth);
    }
    if dwell > 0 {
        head.dwell(dwell);
    }
}

/// The order of so many holes in a row in which the drill always has material, or none, on both
/// sides: the ends first, then the middles between, again and again.
fn halved(count: usize) -> Vec<usize> {
    let last = count.saturating_sub(1);
    let mut order = if last == 0 { vec![0] } else { vec![0, last] };
    let mut gaps = std::collections::VecDeque::from([(0, last)]);
    while let Some((from, to)) = gaps.pop_front() {
        if to > from + 1 {
            let middle = usize::midpoint(from, to);
            order.push(middle);
            gaps.extend([(from, middle), (middle, to)]);
        }
    }
    order
}

/// The holes that make a slot: so close that the scallops between them stay below [`SCALLOP`], but
/// no closer than a quarter of the drill, as a drill that has nothing to bite on slips into the
/// hole beside it.
fn chain(path: &Path, diameter: Nm) -> Vec<Point> {
    let mut points = vec![path.start];
    let pitch = {
        let radius = diameter.to_f64() / 2.0;
        let scallop = SCALLOP.to_f64().min(radius);
        (2.0 * (scallop * (2.0 * radius - scallop)).sqrt()).max(radius / 2.0)
    };
    for (from, segment) in path.steps() {
        points.extend(spaced(from, segment, pitch));
    }
    points
}

/// How high the ridges between the holes of a slot may stand: half a thousandth of an inch, as the
/// drill makers say.
const SCALLOP: Nm = Nm::new(12_700);

/// Points along a segment at most `pitch` apart, without the start and with the end.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "a small count"
)]
fn spaced(from: Point, segment: &Segment, pitch: f64) -> Vec<Point> {
    let count = ((segment.length(from) / pitch.max(1.0)).ceil() as usize).max(1);
    let at = |i: usize| if i == count { segment.to() } else { segment.at(from, i as f64 / count as f64) };
    (1..=count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_in_a_row_are_halved_and_each_comes_once() {
        assert_eq!(halved(1), [0], "one alone");
        assert_eq!(halved(2), [0, 1], "two ends");
        assert_eq!(halved(9), [0, 8, 4, 2, 6, 1, 3, 5, 7], "the middles between");
        for count in 1..40 {
            let mut order = halved(count);
            order.sort_unstable();
            assert!(order.into_iter().eq(0..count), "all of {count}");
        }
    }

    #[test]
    fn drills_are_as_they_are_sold() {
        for (hole, drill) in [
            (999_998, 1_000_000),
            (1_000_760, 1_000_000),
            (249_936, 250_000),
            (299_720, 300_000),
            (812_800, 812_800),
            (3_175_000, 3_175_000),
            (1_016_000, 1_016_000),
            (800, 800),
        ] {
            assert_eq!(as_sold(Nm::new(hole)), Nm::new(drill), "for a hole of {hole} nm");
        }
    }
}
