//! Drilling: every hole once, the same bit for all it fits, the way between the holes short.

use std::collections::BTreeMap;

use super::bore;
use crate::board::{Hole, Warning};
use crate::geometry::{Nm, Path, Point, Segment, Vector};
use crate::toolpath::head::Head;
use crate::toolpath::order::{Order, Stretch, arrange};
use crate::toolpath::{Feed, Heights, Placement, Section, Tool, ToolKind};

/// How holes are drilled.
#[derive(Clone, Copy, Debug)]
pub struct Drilling<'a> {
    /// The drills at hand; where there are none, each diameter in the files is taken to be at hand.
    pub drills: &'a [Tool],
    /// How far a hole may become larger or smaller than the files say.
    pub tolerance: Nm,
    /// The end mill that bores holes for which no drill is at hand and mills slots; none chain-drills slots.
    pub mill: Option<&'a Tool>,
    /// The diameter from which on holes are bored whatever drills are at hand; none where drills go before.
    pub bored_from: Option<Nm>,
    /// How high and how deep; the step is the peck.
    pub heights: Heights,
    /// From board to machine.
    pub placement: &'a Placement,
    /// How the holes are ordered.
    pub order: Order,
    /// How long the drill stays at the bottom, in milliseconds.
    pub dwell: u32,
    /// The plunge feed and turns per minute of drills that are only taken to be at hand; none for those that suit their diameters.
    pub speeds: (Option<Feed>, Option<u32>),
}

/// Drills all holes: a section for each drill, thin ones first, then one for what is bored.
///
/// Tools keep their numbers; drills that are only taken to be at hand all have 1, and who knows all tools of a job numbers them.
///
/// Warned about: `no-drill-for-hole` where neither a drill nor the mill fits.
pub fn drill(holes: &[Hole], settings: &Drilling<'_>) -> (Vec<Section>, Vec<Warning>) {
    let mut jobs: BTreeMap<(Nm, u32), (Tool, Vec<&Hole>)> = BTreeMap::new();
    let (mut bored, mut warnings) = (Vec::new(), Vec::new());
    let is_wide = |hole: &Hole| settings.bored_from.is_some_and(|from| hole.diameter >= from);
    for hole in holes {
        let milled = settings.mill.filter(|mill| bore::fits(hole, mill, settings.tolerance));
        match bit(hole, settings) {
            _ if milled.is_some() && (hole.is_slot() || is_wide(hole)) => bored.push(hole),
            Some(tool) => {
                let key = (tool.width_at(Nm::ZERO), tool.number);
                jobs.entry(key).or_insert_with(|| (tool, Vec::new())).1.push(hole);
            }
            None if milled.is_some() => bored.push(hole),
            None => warnings.push(missing(hole)),
        }
    }
    let mut sections: Vec<Section> = Vec::with_capacity(jobs.len() + 1);
    sections.extend(jobs.into_values().map(|(tool, holes)| section(tool, &holes, settings)));
    if let Some(mill) = settings.mill.filter(|_| !bored.is_empty()) {
        sections.push(bore::bore(&bored, mill, settings.heights, settings.placement, settings.order));
    }
    (sections, warnings)
}

/// The drill for a hole: the nearest in diameter within the tolerance, the smaller of two as near.
fn bit(hole: &Hole, settings: &Drilling<'_>) -> Option<Tool> {
    if settings.drills.is_empty() {
        let usual = Tool::new(ToolKind::Drill { diameter: hole.diameter });
        let (plunge, spindle) = settings.speeds;
        let (plunge, spindle) = (plunge.unwrap_or(usual.plunge), spindle.unwrap_or(usual.spindle));
        return Some(Tool { plunge, spindle, ..usual });
    }
    let off = |tool: &&Tool| (tool.width_at(Nm::ZERO) - hole.diameter).abs();
    let nearest =
        settings.drills.iter().min_by_key(|tool| (off(tool), tool.width_at(Nm::ZERO), tool.number))?;
    (off(&nearest) <= settings.tolerance).then(|| nearest.clone())
}

/// The warning for a hole that no drill fits.
fn missing(hole: &Hole) -> Warning {
    let message = format!("no drill at hand is near {:.3} mm: the hole is left", hole.diameter);
    Warning::new("no-drill-for-hole", message).at(hole.path.start)
}

/// All holes of one drill.
fn section(tool: Tool, holes: &[&Hole], settings: &Drilling<'_>) -> Section {
    let mut head = Head::new(settings.heights, tool.plunge);
    let chains: Vec<Vec<Point>> =
        holes.iter().map(|hole| chain(&settings.placement.path(&hole.path), hole.diameter)).collect();
    let ends = |chain: &Vec<Point>| Stretch::open(chain[0], chain[chain.len() - 1]);
    let stretches: Vec<Stretch> = chains.iter().map(ends).collect();
    for leg in arrange(&stretches, Point::default(), settings.order, 0.0) {
        let mut points = chains[leg.stretch].clone();
        if leg.reversed {
            points.reverse();
        }
        for point in points {
            plunge(&mut head, point, settings);
        }
    }
    let count = holes.len();
    let label = format!(
        "drill {:.3} mm, {count} {}",
        tool.width_at(Nm::ZERO),
        if count == 1 { "hole" } else { "holes" }
    );
    Section { tool, label, moves: head.finish() }
}

/// One hole: down in pecks, up to the approach height after each to clear the chips.
fn plunge(head: &mut Head, point: Point, settings: &Drilling<'_>) {
    head.over(point);
    for (peck, depth) in settings.heights.passes().enumerate() {
        if peck > 0 {
            head.rapid_to(settings.heights.approach);
        }
        head.plunge(depth);
    }
    if settings.dwell > 0 {
        head.dwell(settings.dwell);
    }
}

/// The holes that make a slot: so close that the scallops between them stay below [`SCALLOP`]; the ends first, then
/// the middles between, so that the bit always has material, or none, on both sides.
fn chain(path: &Path, diameter: Nm) -> Vec<Point> {
    let mut points = vec![path.start];
    let pitch = {
        let radius = diameter.to_f64() / 2.0;
        let scallop = SCALLOP.to_f64().min(radius);
        2.0 * (scallop * (2.0 * radius - scallop)).sqrt()
    };
    for (from, segment) in path.steps() {
        points.extend(spaced(from, segment, pitch));
    }
    points
}

/// How high the ridges between the holes of a slot may stand: half a thousandth of an inch, as the drill makers say.
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
    let at = |i: usize| {
        let fraction = i as f64 / count as f64;
        match segment.arc(from) {
            _ if i == count => segment.to(),
            Some(arc) => {
                let (x, y) = arc.at(fraction);
                Point::from_f64(x, y)
            }
            None => {
                let way = segment.to() - from;
                from + Vector::new(
                    Nm::from_f64(way.x.to_f64() * fraction),
                    Nm::from_f64(way.y.to_f64() * fraction),
                )
            }
        }
    };
    (1..=count).map(at).collect()
}
