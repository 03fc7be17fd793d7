//! Carving: a V-bit follows the medial axis of areas, as deep as the disc that fits is wide, and so
//! mills them to their edges.
//!
//! ```text
//!   ══════╲                    ╱══════ surface     depth = (clearance − tip / 2) / tan(angle / 2), at most what is asked for
//!          ╲        ╱╲        ╱
//!           ╲      ╱  ╲______╱ at most so deep
//!            ╲    ╱
//!             ╲  ╱  the axis
//! ```
//!
//! In passes where the step is small: each follows what lies deeper than the one before it, so no
//! way is milled twice at one depth but to save a retract.

mod clip;
mod fit;
mod floor;
mod rims;
mod room;
mod rows;

use crate::geometry::{Nm, Path, Point, Segment};
use crate::toolpath::head::Head;
use crate::toolpath::order::{Order, Stretch, arrange};
use crate::toolpath::trails::{Link, Step, walk};
use crate::toolpath::{Heights, Machine, Placement, Position, Section, Tool, ToolKind};
use crate::voronoi::medial::MedialAxis;

use super::isolate::retract_worth;
use clip::{Pass, Piece, Tip};
use fit::Fit;
use rims::Rims;

pub use floor::Floor;

/// How areas are carved.
#[derive(Clone, Copy, Debug)]
pub struct Carving<'a> {
    /// The tool, a V-bit.
    pub tool: &'a Tool,
    /// How high and deep: no deeper than `cut`, in passes of `step`.
    pub heights: Heights,
    /// From the artwork to the machine.
    pub placement: &'a Placement,
    /// How the trails are ordered.
    pub order: Order,
    /// What a retract costs.
    pub machine: &'a Machine,
    /// How far what is milled may be off its place.
    pub tolerance: Nm,
    /// How deep the edges of the areas lie: zero, or how far the plug of an inlay goes in.
    pub start: Nm,
    /// What is wider than the tool cuts at the most depth, of which it cuts the rims; none to
    /// follow such places along their middle.
    pub floor: Option<&'a Floor>,
}

/// The share of the tolerance that lines and arcs may take. Chosen: the rest is for the chords of
/// the axis and the rounding of coordinates.
const SHARE: f64 = 0.7;

/// Along flanks steeper than this, in units of width for one of depth, lines and arcs follow the
/// axis no more closely if they are within so many nanometres of it. Chosen: below that a tenth of
/// a micrometre sideways, the last digit of a program, is what counts.
const STEEP: f64 = 0.25;
const CLOSE: f64 = 350.0;

/// What is wider by so many nanometres than the tool cuts has rims of no length to speak of, and is
/// followed along its middle, too. Chosen: half the tolerance unless said.
const WIDER: f64 = 1_000.0;

/// Follows the medial axis; no moves for a tool that is no V-bit.
pub fn carve(label: impl Into<String>, axis: &MedialAxis, settings: &Carving<'_>) -> Section {
    let mut head = Head::new(settings.heights, settings.tool.plunge);
    let mut at = Point::default();
    for pass in passes(axis, settings) {
        let lines = lines(axis, &pass, settings);
        at = mill(&mut head, lines, at, settings);
    }
    Section { tool: settings.tool.clone(), label: label.into(), moves: head.finish() }
}

/// The passes: as few as the step allows for the deepest place there is, all equally thick.
fn passes(axis: &MedialAxis, settings: &Carving<'_>) -> Vec<Pass> {
    let ToolKind::VBit { tip, .. } = settings.tool.kind else { return Vec::new() };
    let (blunt, flank) = (tip.to_f64() / 2.0, settings.tool.kind.flank());
    let beyond = settings.floor.map(|_| settings.heights.cut.to_f64() + WIDER / flank);
    let start = settings.start.to_f64();
    let whole = Pass { low: 0.0, high: 0.0, blunt, flank, start, beyond };
    let deepest = Nm::from_f64(whole.depth(axis.widest())).min(settings.heights.cut);
    if deepest <= Nm::ZERO {
        return Vec::new();
    }
    let levels: Vec<f64> = Heights { cut: deepest, ..settings.heights }.passes().map(Nm::to_f64).collect();
    let lows = std::iter::once(0.0).chain(levels.iter().copied());
    lows.zip(&levels).map(|(low, &high)| Pass { low, high, ..whole }).collect()
}

/// A line of the pass on the machine, with the height at each vertex.
#[derive(Clone)]
struct Line {
    path: Path,
    levels: Vec<Level>,
}

/// How deep a vertex is, and whether it lies on the floor, as deep as may be.
#[derive(Clone, Copy, PartialEq)]
struct Level {
    depth: Nm,
    on_floor: bool,
}

impl Line {
    fn reverse(&mut self) {
        self.path = self.path.reversed();
        self.levels.reverse();
    }

    fn append(&mut self, mut next: Self) {
        self.path.segments.append(&mut next.path.segments);
        self.levels.extend(next.levels.drain(1..));
    }

    /// Turned so that a closed one begins with the segment of this index.
    fn begin_at(&mut self, entry: usize) {
        if entry > 0 {
            self.path.start = self.path.segments[entry - 1].to();
            self.path.segments.rotate_left(entry);
            self.levels.pop();
            self.levels.rotate_left(entry);
            self.levels.push(self.levels[0]);
        }
    }

    /// Where it may begin and end: anywhere if it is closed.
    fn stretch(&self) -> Stretch {
        let is_loop = self.path.is_closed() && self.levels.first() == self.levels.last();
        let entries = if is_loop { self.path.steps().map(|(from, _)| from).collect() } else { Vec::new() };
        Stretch { from: self.path.start, to: self.path.end(), entries }
    }
}

/// What a pass mills, in as few trails as the axis allows.
fn lines(axis: &MedialAxis, pass: &Pass, settings: &Carving<'_>) -> Vec<Line> {
    let within = |flank: f64| settings.tolerance.to_f64() * SHARE * flank.min(1.0);
    let tolerance = within(pass.flank).max(within(STEEP).min(CLOSE));
    let fit = Fit { tolerance, flank: pass.flank };
    let mut nodes = axis.nodes.len();
    let mut new_node = || {
        nodes += 1;
        u32::try_from(nodes - 1).expect("below 2³² nodes")
    };
    let (mut ways, mut links): (Vec<Line>, Vec<Link>) = (Vec::new(), Vec::new());
    let mut add = |path: &Path, levels: Vec<Level>, ends: Option<(u32, u32)>| {
        let seconds = path.length() / settings.tool.feed.nm_per_second();
        links.push(Link { ends, seconds, must: true });
        ways.push(Line { path: settings.placement.path(path), levels });
    };
    let mut rims = settings.floor.map(Rims::new);
    for way in &axis.ways {
        for Piece { course, whole } in pass.pieces(&way.course, way.ends.is_none()) {
            let Some((mut path, depths)) = fit.path(&course) else { continue };
            let mut levels: Vec<Level> =
                depths.into_iter().map(|depth| Level { depth, on_floor: false }).collect();
            let is_ring = way.ends.is_none() && whole == [true, true];
            let mut ends = [0, 0];
            for at in if is_ring { 0..0 } else { 0..2 } {
                // Led on to the rim that it comes to.
                let mut on_rim =
                    || rims.as_mut()?.corner(if at == 0 { path.start } else { path.end() }, &mut new_node);
                ends[at] = match way.ends.filter(|_| whole[at]) {
                    Some(ends) => ends[at],
                    None => match on_rim() {
                        Some((corner, node)) => {
                            lead_on(&mut path, &mut levels, at, corner, pass);
                            node
                        }
                        None => new_node(),
                    },
                };
            }
            add(&path, levels, (!is_ring).then_some((ends[0], ends[1])));
        }
    }
    for part in rims.into_iter().flat_map(Rims::parts) {
        let level = Level { depth: Nm::from_f64(pass.high), on_floor: true };
        let ends = part.ends.or_else(|| (!part.path.is_closed()).then(|| (new_node(), new_node())));
        add(&part.path, vec![level; part.path.segments.len() + 1], ends);
    }
    let retract = retract_worth(settings.heights, settings.tool, settings.machine);
    let trails = walk(nodes, &links, retract);
    let mut lines: Vec<Line> = trails.iter().filter_map(|trail| joined(&ways, trail)).collect();
    lines.extend(axis.dots.iter().filter_map(|&dot| {
        let place = axis.nodes[dot as usize];
        let tip = Tip { at: place.at, depth: pass.depth(place.clearance).min(pass.high) };
        (tip.depth > pass.low && !pass.is_left(pass.depth(place.clearance))).then(|| {
            let start = settings.placement.point(Point::from_f64(tip.at.0, tip.at.1));
            let path = Path { start, segments: Vec::new() };
            Line { path, levels: vec![Level { depth: Nm::from_f64(tip.depth), on_floor: false }] }
        })
    }));
    lines
}

/// Leads an end of a piece, its beginning or its end, on to a corner of a rim.
fn lead_on(path: &mut Path, levels: &mut Vec<Level>, at: usize, corner: Point, pass: &Pass) {
    let level = Level { depth: Nm::from_f64(pass.high), on_floor: true };
    let last = levels.len() - 1;
    if [path.start, path.end()][at] == corner {
        levels[at * last] = level;
    } else if at == 0 {
        let to = std::mem::replace(&mut path.start, corner);
        path.segments.insert(0, Segment::Line { to });
        levels.insert(0, level);
    } else {
        path.segments.push(Segment::Line { to: corner });
        levels.push(level);
    }
}

fn joined(ways: &[Line], trail: &[Step]) -> Option<Line> {
    let mut whole: Option<Line> = None;
    for step in trail {
        let mut next = ways[step.link].clone();
        if step.backwards {
            next.reverse();
        }
        match &mut whole {
            None => whole = Some(next),
            Some(whole) => whole.append(next),
        }
    }
    whole
}

/// Mills all lines of a pass from `start` on; where it ends.
fn mill(head: &mut Head, mut lines: Vec<Line>, start: Point, settings: &Carving<'_>) -> Point {
    let stretches: Vec<Stretch> = lines.iter().map(Line::stretch).collect();
    let length = lines.iter().map(|line| line.path.length()).sum();
    // Longer ways over the floor are not worth the retract that they save.
    let retract = retract_worth(settings.heights, settings.tool, settings.machine);
    let longest = retract * settings.tool.feed.nm_per_second();
    let (mut at, mut was_on_floor) = (start, false);
    for leg in arrange(&stretches, start, settings.order, length) {
        let line = &mut lines[leg.stretch];
        line.begin_at(leg.entry.unwrap_or(0));
        if leg.reversed {
            line.reverse();
        }
        let stays_down = was_on_floor
            && line.levels[0].on_floor
            && at.distance(line.path.start) <= longest
            && settings.floor.is_some_and(|floor| {
                let [from, to] = [at, line.path.start].map(|p| settings.placement.undo(p));
                floor.is_cleared && floor.room.leads(from, to)
            });
        if stays_down {
            head.feed_to(Position::over(line.path.start, -line.levels[0].depth), settings.tool.feed);
        } else {
            head.over(line.path.start);
            head.plunge(line.levels[0].depth);
        }
        for (segment, level) in line.path.segments.iter().zip(&line.levels[1..]) {
            head.cut(segment, level.depth, settings.tool.feed);
        }
        (at, was_on_floor) = (line.path.end(), line.levels.last().is_some_and(|level| level.on_floor));
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Polygon, Rect};
    use crate::toolpath::Move;
    use crate::voronoi::medial::{Interior, Pruning};

    fn square(side: i64) -> Polygon {
        Polygon::rectangle(Rect::new(Point::default(), Point::new(Nm::from_um(side), Nm::from_um(side))))
    }

    fn plan(step: Option<Nm>, most: Nm) -> Vec<Move> {
        let tool: Tool = "vbit:0.1mm:90deg".parse().expect("a tool");
        let axis = MedialAxis::new(&Interior::all(&[square(2_000)]), &Pruning { loss: 1.0, corner: 1.0 });
        let (safe, approach) = (Nm::from_mm(2), Nm::from_um(200));
        let settings = Carving {
            tool: &tool,
            heights: Heights { safe, approach, cut: most, step },
            placement: &Placement::default(),
            order: Order::default(),
            machine: &Machine::default(),
            tolerance: Nm::from_um(2),
            start: Nm::ZERO,
            floor: None,
        };
        carve("carve", &axis, &settings).moves
    }

    fn deepest(moves: &[Move]) -> i64 {
        moves.iter().filter_map(Move::to).map(|to| to.z.get()).min().unwrap_or(0)
    }

    #[test]
    fn a_square_is_carved_to_its_middle_from_corner_to_corner() {
        let moves = plan(None, Nm::from_mm(5));
        // Half of 2 mm, less half the tip, at 45°.
        assert_eq!(deepest(&moves), -950_000, "{moves:?}");
        let corners = moves.iter().filter_map(Move::to).filter(|to| to.z == Nm::ZERO);
        let near = |x: i64| (x - 50_000).abs() < 1 || (x - 1_950_000).abs() < 1;
        assert_eq!(corners.filter(|to| near(to.x.get()) && near(to.y.get())).count(), 4, "{moves:?}");
    }

    #[test]
    fn no_deeper_than_asked_for_and_in_passes() {
        assert_eq!(deepest(&plan(None, Nm::from_um(300))), -300_000, "level in the middle");
        let levels = |moves: &[Move]| {
            let mut z: Vec<i64> = moves.iter().filter_map(Move::to).map(|to| to.z.get()).collect();
            z.sort_unstable();
            z.dedup();
            z
        };
        let moves = plan(Some(Nm::from_um(500)), Nm::from_mm(5));
        assert!(levels(&moves).contains(&-475_000), "two equal passes: {:?}", levels(&moves));
    }
}
