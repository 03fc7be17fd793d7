//! What programs mill of pockets beside what they should.
//!
//! ```text
//!   ┌─────────────────╮     Where a mill fits is the area less a strip of its radius along the edge; what it can clear there is that
//!   │ ╭─────────────╮ │     much wider again. All of it must be swept at the full depth (*residue*), no motion may come nearer to
//!   │ │ where its   │ │     an edge than the radius (*overcut*), no pass may take more than it is allowed to, and the tool comes
//!   │ │ middle fits │ │     down no more often than there are places farthest from the edge: counted as pieces of the area, offset
//!   │ ╰─────────────╯ │     inwards level by level, within which no piece of the next level lies.
//!   └─────────────────╯
//! ```
//!
//! Offsets are exact integer booleans, distances are measured to the edges themselves, and what is
//! swept is asked of the motions that the text is read back as: no Voronoi diagram, nothing of the
//! planner. In a slot just as wide as the mill its middle fits on a line, which is no polygon: so
//! the strip is narrower than the radius by what the tool may be nearer to an edge
//! ([`Floor::within`]).

mod engagement;

use rayon::prelude::*;

use crate::board::diagnostic::planning;
use crate::board::polarity::offset;
use crate::board::{Diagnostic, FLATTEN, Severity};
use crate::gcode::read::Motion;
use crate::geometry::{Nm, Point, Polygon, coarse};

use super::Error;
use super::carving::{Text, followed, harm};
use super::check;
use super::cutter::Cutter;
use super::edges::Edges;
use super::followed::Followed;
use super::report::Finding;
use super::surface::stretches;

use super::runs::{Piece, Spot, Sweep, Sweeps, left};
use engagement::{Stretch, Work, borne};

pub use engagement::Borne;

/// What should be milled, on the machine.
#[derive(Clone, Debug)]
pub struct Floor<'a> {
    /// The areas, simple polygons.
    pub areas: &'a [Polygon],
    /// How deep.
    pub depth: Nm,
    /// The most that one pass may take; none for all at once.
    pub step: Option<Nm>,
    /// How steeply the tool may go down into material, in units of depth for one of way, where
    /// there is room; none for any way.
    pub steepest: Option<f64>,
    /// What is left for a loop along the wall, so that there is less room before that.
    pub stock: Nm,
    /// What says how often the first tool may come down; none for as often as it likes.
    pub plunges: Option<Plunges<'a>>,
    /// The greatest radial engagement of the first tool, as a part of its diameter; none for any.
    pub engagement: Option<f64>,
    /// How much nearer to an edge than its radius the middle of a tool may be, so that it fits what
    /// is just as wide.
    pub within: Nm,
    /// What is less off is right.
    pub tolerance: Nm,
    /// The distance of the rows that are looked at.
    pub pitch: Nm,
}

/// How often a tool need come down: once in each pass where the areas are widest, and more often
/// where what a pass takes is milled in layers.
#[derive(Clone, Copy, Debug)]
pub struct Plunges<'a> {
    /// How far from the edge its loops are, in nanometres and rising.
    pub levels: &'a [f64],
    /// How often more it comes down in each pass, for layers.
    pub layered: usize,
    /// In how many passes it mills.
    pub passes: usize,
}

/// What came of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pocketed {
    /// How much the finest tool can clear, in mm².
    pub reachable_mm2: f64,
    /// How much of the areas no tool reaches, in corners and narrow places.
    pub unreachable_mm2: f64,
    /// How much of what can be cleared was left, all pieces together.
    pub residue_mm2: f64,
    /// The most that a tool cuts beyond an edge, in nanometres; zero if none does.
    pub overcut: f64,
    /// How often a tool comes down into the material.
    pub plunges: usize,
    /// How often the first tool need come down, in all passes; none where nobody asks.
    pub maxima: Option<usize>,
    /// What the first tool bears; none where nobody asks.
    pub borne: Option<Borne>,
    /// What is wrong.
    pub findings: Vec<Finding>,
}

/// A smaller piece left is none, in mm². Chosen: a square of 32 µm, less than a burr.
const SPECK: f64 = 1e-3;

/// Arcs become chords within this of them. Chosen: a tenth of what is tolerated.
const CHORD: Nm = Nm::new(400);

/// How far within arcs their chords lie where it is worked out what a tool reaches from where it
/// fits. Chosen: a quarter of what is tolerated; where it fits is worked out more closely, as necks
/// as wide as the tool are passed or not.
const ROUND: Nm = Nm::from_um(1);

/// Heights that differ by less are one, in nanometres: the last digit of a program, and rounding.
const LEVEL: f64 = 1_500.0;

/// So many findings of one kind are listed. Chosen.
const MOST_LISTED: usize = 50;

/// So many diameters one pass takes at most where nobody says how much.
#[expect(clippy::cast_precision_loss, reason = "a small number")]
const DIAMETERS: f64 = check::MOST_DIAMETERS as f64;

/// With less room than this part of its radius a tool may go straight down. Chosen.
const ROOM: f64 = 0.25;

/// How much steeper than asked for is too steep: arcs are measured by their chords.
const STEEPER: f64 = 1.05;

/// A straight part of a motion, of which some is below the surface.
#[derive(Clone, Copy, Debug)]
struct Step {
    ends: [Spot; 2],
    /// How deep the tip is at either end, downwards.
    depths: [f64; 2],
    radius: f64,
    order: usize,
    line: u32,
    program: usize,
}

impl Step {
    /// What it clears for certain: all along as deep as its higher end, and straight down as deep
    /// as it comes.
    fn sweep(&self) -> Sweep {
        let Self { ends: [from, to], depths: [a, b], radius, order, .. } = *self;
        Sweep { from, to, radius, depth: if from == to { a.max(b) } else { a.min(b) }, order }
    }

    /// Whether that is all that it clears.
    fn is_level(&self) -> bool {
        self.ends[0] == self.ends[1] || (self.depths[0] - self.depths[1]).abs() < LEVEL
    }
}

/// What steps clear for certain.
struct Swept {
    level: Sweeps,
    /// As deep as their higher ends.
    slopes: Sweeps,
}

impl Swept {
    fn by(steps: &[Step]) -> Self {
        let (level, slopes): (Vec<&Step>, Vec<&Step>) = steps.iter().partition(|step| step.is_level());
        let sweeps = |steps: Vec<&Step>| Sweeps::new(steps.into_iter().map(Step::sweep).collect());
        Self { level: sweeps(level), slopes: sweeps(slopes) }
    }

    /// Whether a place was swept before a motion, no less deep than `least`.
    fn clear(&self, p: Spot, least: f64, before: usize) -> bool {
        [&self.level, &self.slopes].into_iter().any(|sweeps| sweeps.clear(p, least, before))
    }
}

/// Reads programs and compares what they mill together with the pockets.
///
/// # Errors
///
/// [`Error::Read`] for a text that cannot be followed.
pub fn pocketing(programs: &[Text<'_>], floor: &Floor<'_>) -> Result<Pocketed, Error> {
    let followed = followed(programs)?;
    let mut steps = Vec::new();
    for (number, (followed, text)) in followed.iter().zip(programs).enumerate() {
        all_steps(followed, &text.cutter, number, &mut steps);
    }
    let swept = Swept::by(&steps);
    let edges = Edges::new(floor.areas);
    let pocketed = Pocketed { findings: harm(&followed), ..Pocketed::default() };
    let mut judge = Judge { floor, programs, pocketed };
    judge.overcut(&steps, &edges);
    judge.depths(&steps, &swept, &edges);
    judge.residue(&swept.level);
    judge.plunges(&followed);
    judge.engagement(&steps, &swept);
    Ok(judge.pocketed)
}

/// The steps of a program below the surface.
fn all_steps(followed: &Followed, cutter: &Cutter, program: usize, steps: &mut Vec<Step>) {
    for motion in &followed.listing.motions {
        for (from, to, depths) in stretches(motion, CHORD) {
            steps.push(Step {
                ends: [from, to],
                depths,
                radius: cutter.cone().blunt,
                order: steps.len(),
                line: motion.line,
                program,
            });
        }
    }
}

struct Judge<'a> {
    floor: &'a Floor<'a>,
    programs: &'a [Text<'a>],
    pocketed: Pocketed,
}

impl Judge<'_> {
    /// Lists the worst of some steps, one for each line.
    fn list(&mut self, kind: &Diagnostic, mut worst: Vec<(f64, &Step)>, what: impl Fn(f64) -> String) {
        worst.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.order.cmp(&b.1.order)));
        let mut listed: Vec<(usize, u32)> = Vec::new();
        for (by, step) in worst {
            if listed.contains(&(step.program, step.line)) {
                continue;
            }
            listed.push((step.program, step.line));
            let found = Finding::new(kind.code, kind.severity, what(by));
            let (x, y) = step.ends[1];
            self.pocketed.findings.push(Finding {
                at: Some(Point::from_f64(x, y)),
                line: Some(step.line),
                program: Some(self.programs[step.program].file.to_owned()),
                ..found
            });
            if listed.len() == MOST_LISTED {
                break;
            }
        }
    }

    /// Motions that come nearer to an edge than the tool is wide, or lie outside.
    fn overcut(&mut self, steps: &[Step], edges: &Edges) {
        let tolerance = self.floor.tolerance.to_f64();
        let mut found = Vec::new();
        for (number, step) in steps.iter().enumerate() {
            let is_new = number.checked_sub(1).is_none_or(|before| steps[before].ends[1] != step.ends[0]);
            // Whoever crosses no edge stays on its side of all.
            let near = edges.nearest_to_way(step.ends, step.radius);
            let is_out =
                (is_new || near.is_some_and(|near| near < step.radius / 2.0)) && !edges.hold(step.ends[1]);
            let by = if is_out { step.radius } else { near.map_or(0.0, |near| step.radius - near) };
            self.pocketed.overcut = self.pocketed.overcut.max(by);
            if by > tolerance {
                found.push((by, step));
            }
        }
        self.list(&planning::POCKET_OVERCUT, found, |by| {
            format!("the tool cuts {:.1} µm beyond the edge of the area", by / 1e3)
        });
    }

    /// Motions that go too deep, take too much at once, or go down too steeply.
    fn depths(&mut self, steps: &[Step], swept: &Swept, edges: &Edges) {
        let tolerance = self.floor.tolerance.to_f64();
        let (depth, stock) = (self.floor.depth.to_f64(), self.floor.stock.to_f64());
        // What no more than the rim of the tool meets it may bear at any depth.
        let inner = self.floor.engagement.map_or(WITHIN, |target| (1.0 - 2.0 * target).clamp(0.0, WITHIN));
        let (mut deep, mut thick, mut steep) = (Vec::new(), Vec::new(), Vec::new());
        for step in steps {
            let bottom = step.depths[0].max(step.depths[1]);
            if bottom > depth + tolerance {
                deep.push((bottom - depth, step));
            }
            let borne = step.radius * 2.0 * DIAMETERS;
            let most = self.floor.step.map_or(borne, Nm::to_f64) + tolerance;
            if bottom > most && !is_clear(step, WITHIN, bottom - most, swept) {
                thick.push((bottom, step));
            }
            let way = (step.ends[1].0 - step.ends[0].0, step.ends[1].1 - step.ends[0].1);
            let drop = step.depths[1] - step.depths[0].max(0.0);
            let slope = drop / (way.0 * way.0 + way.1 * way.1).sqrt().max(1.0);
            let is_steep = self.floor.steepest.is_some_and(|steepest| slope > steepest * STEEPER);
            if is_steep
                && drop > tolerance
                && !is_clear(step, inner, bottom - tolerance, swept)
                && edges.nearest(step.ends[1]).0 - step.radius - stock >= step.radius * ROOM
            {
                steep.push((slope, step));
            }
        }
        self.list(&planning::POCKET_TOO_DEEP, deep, |by| {
            format!("it mills {:.1} µm below the floor", by / 1e3)
        });
        if self.floor.step.is_some() {
            self.list(&planning::POCKET_PASS_TOO_THICK, thick, |by| {
                format!(
                    "it mills material at a depth of {:.3} mm that no pass above it has cleared",
                    by / 1e6
                )
            });
        } else {
            // One says it: all that is deep is milled at once.
            let worst = thick.into_iter().reduce(|a, b| if b.0 > a.0 { b } else { a });
            let width = worst.map_or(0.0, |(_, step)| step.radius * 2.0);
            self.list(&check::PASS_TOO_DEEP, worst.into_iter().collect(), |by| {
                format!("a pass down to {:.3} mm with an end mill of {:.3} mm", by / 1e6, width / 1e6)
            });
        }
        self.list(&planning::POCKET_PLUNGE_TOO_STEEP, steep, |_| {
            "it plunges steeply into material where there is room for a ramp".to_owned()
        });
    }

    /// What the finest tool could clear and none does.
    fn residue(&mut self, sweeps: &Sweeps) {
        let radius = self.programs.iter().map(|program| program.cutter.tip / 2).min().unwrap_or(Nm::ZERO);
        let (reach, tolerance) = (radius - self.floor.within, self.floor.tolerance);
        let offsets = |areas: &[Polygon], by: Nm, chord: Nm| -> Vec<Polygon> {
            areas.par_iter().flat_map_iter(|area| offset(area, by, chord)).collect()
        };
        let fits = offsets(self.floor.areas, -reach, FLATTEN);
        let wide = |by: Nm| offsets(&fits, by, ROUND);
        let area = |polygons: &[Polygon]| polygons.iter().map(Polygon::area_mm2).sum::<f64>();
        self.pocketed.reachable_mm2 = area(&crate::board::polarity::union(&wide(reach)));
        self.pocketed.unreachable_mm2 = area(self.floor.areas) - self.pocketed.reachable_mm2;
        let least = (self.floor.depth - tolerance).to_f64();
        let wanted = crate::board::polarity::union(&wide(reach - tolerance));
        let pieces: Vec<Piece> = left(&wanted, sweeps, least, self.floor.pitch.to_f64());
        self.pocketed.residue_mm2 = pieces.iter().fold(0.0, |sum, piece| sum + piece.mm2);
        for piece in pieces.iter().take_while(|piece| piece.mm2 > SPECK).take(MOST_LISTED) {
            let message = format!("{:.4} mm² are left where the tool fits", piece.mm2);
            let found = Finding::new(planning::POCKET_RESIDUE.code, Severity::Error, message);
            self.pocketed.findings.push(Finding { at: Some(piece.at), ..found });
        }
    }

    /// How often the first tool comes down, and how often it need.
    fn plunges(&mut self, followed: &[Followed]) {
        let comes_down = |motion: &&Motion| {
            let (Some(from), Some(to)) = (motion.from.z, motion.to.z) else { return false };
            from >= Nm::ZERO && to < Nm::ZERO
        };
        let count = |program: &Followed| program.listing.motions.iter().filter(comes_down).count();
        self.pocketed.plunges = followed.iter().map(count).sum();
        let Some(Plunges { levels, layered, passes }) = self.floor.plunges else { return };
        let first = followed.first().map_or(0, count);
        let made = (first / passes.max(1)).saturating_sub(layered);
        // Each piece that the tool fits into needs one, however often its width rises and falls.
        let pieces = pieces(self.floor.areas, levels);
        let least = if made <= pieces { pieces } else { needed(self.floor.areas, levels, made) };
        let maxima = (least + layered) * passes;
        self.pocketed.maxima = Some(maxima);
        if first > maxima {
            let message = format!(
                "the tool plunges {first} times, and {maxima} are needed: once in each pass where the area is widest"
            );
            self.pocketed.findings.push(Finding::new(
                planning::POCKET_PLUNGES.code,
                Severity::Warning,
                message,
            ));
        }
    }
}

/// How much more than asked for is too much, as a part of the diameter: what measuring may be off.
const TOLERATED: f64 = 0.02;

impl Judge<'_> {
    /// What the first tool bears.
    fn engagement(&mut self, steps: &[Step], swept: &Swept) {
        let (Some(target), Some(first)) = (self.floor.engagement, self.programs.first()) else { return };
        // A program for somewhere else is wrong whatever the tool bears there.
        if self.pocketed.overcut > first.cutter.tip.to_f64() {
            return;
        }
        let passes = self.floor.step.map_or(1.0, |step| (self.floor.depth.to_f64() / step.to_f64()).ceil());
        let stretch = |step: &Step| {
            let Step { ends, depths, line, order, .. } = *step;
            Stretch { ends, depths, line, order }
        };
        let stretches: Vec<Stretch> = steps.iter().filter(|step| step.program == 0).map(stretch).collect();
        let work = Work {
            areas: self.floor.areas,
            radius: first.cutter.tip / 2,
            depth: self.floor.depth,
            pass: self.floor.depth.to_f64() / passes.max(1.0),
            allowed: target + TOLERATED,
            sweeps: [&swept.level, &swept.slopes],
        };
        let found = borne(&stretches, &work);
        self.pocketed.borne = Some(found);
        if found.most > target + TOLERATED {
            let message = format!(
                "the radial engagement is {:.1} % of the diameter, where {:.1} % are allowed",
                found.most * 100.0,
                target * 100.0
            );
            let kind = &planning::POCKET_ENGAGEMENT;
            self.pocketed.findings.push(Finding {
                at: Some(Point::from_f64(found.at.0, found.at.1)),
                program: Some(first.file.to_owned()),
                line: Some(found.line),
                ..Finding::new(kind.code, Severity::Error, message)
            });
        }
    }
}

/// The part of its radius within which the tool must be clear of material. Chosen: rounding.
const WITHIN: f64 = 0.97;

/// Whether where a step ends all under a part of the tool's radius was swept before, no less deep
/// than `least`.
fn is_clear(step: &Step, part: f64, least: f64, swept: &Swept) -> bool {
    let (x, y) = step.ends[1];
    let off = step.radius * part;
    let slant = off * std::f64::consts::FRAC_1_SQRT_2;
    let round = [
        (0.0, 0.0),
        (off, 0.0),
        (slant, slant),
        (0.0, off),
        (-slant, slant),
        (-off, 0.0),
        (-slant, -slant),
        (0.0, -off),
        (slant, -slant),
    ];
    round.into_iter().all(|(right, up)| swept.clear((x + right, y + up), least, step.order))
}

/// A piece that is smaller is none, in nanometres. Chosen: above rounding.
const SMALL: Nm = Nm::from_um(4);

/// How far chords of arcs lie from them where maxima are counted. Chosen: it adds up to a part of
/// [`SMALL`] over a hundred levels.
const FINE: Nm = Nm::new(30);

/// The same as [`maxima`], each level from the pieces of the one before, which have fewer corners
/// that lie behind each other. Rings are thinned, so a level is off by as much for each before it.
fn maxima_by_steps(areas: &[Polygon], levels: &[f64]) -> usize {
    let Some(&first) = levels.first() else { return 0 };
    let inwards = |pieces: &[Polygon], by: Nm| -> Vec<Vec<Polygon>> {
        let inner = |piece: &Polygon| offset(piece, -by, FINE).iter().filter_map(thinned).collect();
        pieces.par_iter().map(inner).collect()
    };
    let mut pieces = inwards(areas, Nm::from_f64(first)).concat();
    let mut count = 0;
    for pair in levels.windows(2) {
        let mut next = inwards(&pieces, Nm::from_f64(pair[1]) - Nm::from_f64(pair[0]));
        for parts in &mut next {
            parts.retain(|piece| {
                let bounds = piece.bounds();
                bounds.width().max(bounds.height()) >= SMALL
            });
        }
        count += next.iter().filter(|parts| parts.is_empty()).count();
        pieces = next.concat();
    }
    count + pieces.len()
}

/// Corners of rings that are nearer than this to the line between those that stay go, in
/// nanometres. Chosen: as [`FINE`].
const THIN: f64 = 30.0;

/// A polygon with fewer corners; none where none are left.
fn thinned(polygon: &Polygon) -> Option<Polygon> {
    let thin = |ring: &Vec<Point>| coarse(ring, THIN).into_iter().map(|corner| ring[corner]).collect();
    Polygon::new(polygon.contours().iter().map(thin).collect())
}

/// A place that is so near to a level, in nanometres, is on either side of it. Chosen: chords and
/// rounding leave the first, and a piece of [`SMALL`] size is no higher than the second.
const BESIDE_LEVEL: [f64; 2] = [30.0, 300.0];

/// How often the tool need come down, which did so `made` times in a pass.
fn needed(areas: &[Polygon], levels: &[f64], made: usize) -> usize {
    // Two ways of counting that agree with the program are enough; else the exact one decides,
    // unless no program comes down less often.
    let stepped = maxima_by_steps(areas, levels);
    if stepped == made || made == 0 {
        return stepped;
    }
    let exact = maxima(areas, levels);
    if exact == made {
        return made;
    }
    // Unless where a neck is as wide as a loop, or an area hardly wider, decides.
    let (mut least, mut most) = (exact, exact);
    for by in BESIDE_LEVEL.into_iter().flat_map(|by| [-by, by]) {
        let count = maxima(areas, &levels.iter().map(|level| level + by).collect::<Vec<f64>>());
        (least, most) = (least.min(count), most.max(count));
        if (least..=most).contains(&made) {
            return made;
        }
    }
    exact
}

/// How many pieces of areas there are at the first level.
fn pieces(areas: &[Polygon], levels: &[f64]) -> usize {
    let Some(&first) = levels.first() else { return 0 };
    areas.par_iter().map(|area| offset(area, -Nm::from_f64(first), FINE).len()).sum()
}

/// How many pieces of areas, offset inwards to rising levels, have none of the next level in them.
fn maxima(areas: &[Polygon], levels: &[f64]) -> usize {
    let pieces_of = |area: &Polygon, number: usize, level: f64| {
        let mut pieces = offset(area, -Nm::from_f64(level), FINE);
        pieces.retain(|piece| {
            let bounds = piece.bounds();
            number == 0 || bounds.width().max(bounds.height()) >= SMALL
        });
        pieces
    };
    let mut count = 0;
    for area in areas {
        let mut before: Vec<Polygon> = Vec::new();
        let inner = levels.par_iter().enumerate().map(|(number, &level)| pieces_of(area, number, level));
        for pieces in inner.collect::<Vec<_>>() {
            let holds = |outer: &Polygon| pieces.iter().any(|piece| outer.contains(piece.contours()[0][0]));
            count += before.iter().filter(|outer| !holds(outer)).count();
            if pieces.is_empty() {
                before.clear();
                break;
            }
            before = pieces;
        }
        count += before.len();
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Rect;
    use crate::topology::random;

    /// A square and a smaller one that no farther loop fits into, with a passage between them that
    /// is as wide as a loop is from its walls.
    #[test]
    fn a_neck_as_wide_as_a_loop_is_passed_or_not() {
        let block = |[left, right, height]: [i64; 3]| {
            let at = |x: i64, y: i64| Point::new(Nm::new(x), Nm::new(y));
            Polygon::rectangle(Rect::new(at(left, -height / 2), at(right, height / 2)))
        };
        let necked = |width: i64| {
            let neck = block([5_999_999, 8_000_001, width]);
            let blocks = [block([0, 6_000_000, 6_000_000]), block([8_000_000, 9_200_000, 1_200_000]), neck];
            crate::board::polarity::union(&blocks)
        };
        let levels = [250_000.0, 500_000.0, 750_000.0];
        for (width, wanted) in
            [(998_000, [2, 2]), (999_900, [1, 2]), (1_000_100, [1, 2]), (1_002_000, [1, 1])]
        {
            let found = [1, 2].map(|made| needed(&necked(width), &levels, made));
            assert_eq!(found, wanted, "of a neck {width} nm wide");
        }
    }

    /// Discs of random sizes, some of which meet: pieces that fall apart at many levels.
    #[test]
    fn both_ways_of_counting_agree() {
        let mut random = random();
        for _ in 0..20 {
            let discs: Vec<Polygon> = (0..12)
                .filter_map(|_| {
                    let center = Point::new(Nm::from_um(random(12_000)), Nm::from_um(random(12_000)));
                    Polygon::disc(center, Nm::from_um(800 + random(2_500)), Nm::from_um(1))
                })
                .collect();
            let areas = crate::board::polarity::union(&discs);
            let levels: Vec<f64> =
                (0..40_i32).map(|level| 250_000.0 + 120_000.0 * f64::from(level)).collect();
            assert_eq!(maxima_by_steps(&areas, &levels), maxima(&areas, &levels), "{} areas", areas.len());
        }
    }
}
