//! A program followed: its motions on the board, and what the cutter sweeps.

use std::f64::consts::PI;

use crate::board::{Board, Shape, Side};
use crate::gcode::level;
use crate::gcode::read::{Motion, Way};
use crate::geometry::{Arc, Nm, Point, Vector};

use super::asked::Asked;
use super::declared::Declared;
use super::followed::Followed;
use super::{Cutter, CutterKind, Error, Laid, Placement, Program, Role, Settings, origin};

/// A program, followed.
#[derive(Debug)]
pub(super) struct Machining {
    /// What any machine does with it.
    pub(super) followed: Followed,
    pub(super) role: Role,
    /// Whether it follows the surface as it was probed.
    pub(super) is_levelled: bool,
    /// Who says how it lies; none where nobody does.
    pub(super) zero: Option<Zero>,
    /// What is cut away, deep enough to part the copper.
    pub(super) swept: Vec<Swept>,
    /// Where the tool goes straight down into the board and nothing sideways follows, on the board.
    pub(super) plunges: Vec<Point>,
    /// What each of its tools that part copper cuts where it is deepest.
    pub(super) kerfs: Vec<Kerf>,
    /// What it was asked to clear.
    pub(super) asked: Asked,
}

/// Who says where zero is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zero {
    /// The program itself.
    Told,
    /// Who has it judged; it may be found from what is cut.
    Given,
}

/// How wide a tool cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Kerf {
    /// Half its kerf at the surface.
    pub(super) half: Nm,
    /// The same at the copper's bottom.
    pub(super) floor: Nm,
}

/// A piece of what the cutter sweeps, on the board.
#[derive(Clone, Debug)]
pub(super) struct Swept {
    /// The axis of the cutter's way, its radius half the kerf.
    pub(super) shape: Shape,
    /// Half the kerf at the bottom of the copper: what the cutter leaves below it on either side
    /// conducts.
    ///
    /// ```text
    ///   ▔▔▔▔▔╲         ╱▔▔▔▔▔   surface: shape's radius, what copper is lost by
    ///   copper╲       ╱
    ///   ▁▁▁▁▁▁▁╲     ╱▁▁▁▁▁▁▁   bottom: floor, what nets are parted by
    ///           ╲___╱
    /// ```
    pub(super) floor: Nm,
    /// How deep below the surface.
    pub(super) depth: Nm,
    /// How deep it has its full width: the point of a drill is narrower.
    pub(super) full: Nm,
    /// The line of the program.
    pub(super) line: u32,
    /// Whether it is a step of a motion that goes up or down, as deep as its middle: half of
    /// [`SINK`] more at one end, and less at the other.
    pub(super) slopes: bool,
}

impl Swept {
    /// Half the kerf.
    pub(super) const fn half(&self) -> Nm {
        half(&self.shape)
    }

    /// What it takes away down to the bottom of the copper.
    pub(super) fn parting(&self) -> Shape {
        with_radius(&self.shape, self.floor)
    }

    /// The way of the cutter's middle.
    pub(super) fn axis(&self) -> Shape {
        with_radius(&self.shape, Nm::ZERO)
    }
}

/// Half as wide as what is cut along an axis.
pub(super) const fn half(shape: &Shape) -> Nm {
    match shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => *radius,
        Shape::Polygon(_) => Nm::ZERO,
    }
}

/// The same axis with another radius.
pub(super) fn with_radius(shape: &Shape, radius: Nm) -> Shape {
    match *shape {
        Shape::Disc { center, .. } => Shape::Disc { center, radius },
        Shape::Stroke { from, to, .. } => Shape::Stroke { from, to, radius },
        Shape::Arc { arc, .. } => Shape::Arc { arc, radius },
        Shape::Polygon(ref polygon) => Shape::Polygon(polygon.clone()),
    }
}

impl Machining {
    /// Follows `program` on `board`.
    pub(super) fn read(program: &Program, board: &Board, settings: &Settings) -> Result<Self, Error> {
        let declared = Declared::read(&program.text);
        let (zero, placement) = lying(program, &declared, board);
        let followed = Followed::read(program, declared.mounted, placement)?;
        if followed.listing.motions.is_empty() {
            return Err(Error::NoMotion(program.file.clone()));
        }
        let role = match program.role.or(declared.role) {
            Some(role) => role,
            None => guess(&followed, board).ok_or_else(|| Error::NoSide(program.file.clone()))?,
        };
        let mut machining = Self {
            followed,
            role,
            is_levelled: level::is_levelled(&program.text),
            zero,
            swept: Vec::new(),
            plunges: Vec::new(),
            kerfs: Vec::new(),
            asked: program.asked.clone().unwrap_or_else(|| Asked::declared(&program.text)),
        };
        machining.sweep(settings)?;
        machining.plunge();
        Ok(machining)
    }

    /// Collects what is cut.
    fn sweep(&mut self, settings: &Settings) -> Result<(), Error> {
        let copper = settings.copper;
        let mut deepest: Vec<(Cutter, Nm)> = Vec::new();
        for motion in &self.followed.listing.motions {
            let (Some(from), Some(to)) = (motion.from.point(), motion.to.point()) else { continue };
            let Some((above, below)) = heights(motion) else { continue };
            if above.min(below) > -copper {
                continue;
            }
            if !within_range(&[from, to]) {
                return Err(Error::Range { file: self.followed.file.clone(), line: motion.line });
            }
            let Some(cutter) = self.followed.tools.at(motion.line) else {
                return Err(Error::NoTool { file: self.followed.file.clone(), line: motion.line });
            };
            match deepest.iter_mut().find(|(known, _)| *known == cutter) {
                Some((_, depth)) => *depth = (*depth).max(-above.min(below)),
                None => deepest.push((cutter, -above.min(below))),
            }
            let levels = [copper, settings.board + cutter.point()];
            let slopes = above != below && !matches!(axis(motion.way, from, to), Shape::Disc { .. });
            for (shape, depth) in pieces(motion, from, to, cutter, levels) {
                if depth >= copper {
                    let shape = with_radius(&shape, cutter.width_at(depth) / 2);
                    let shape = self.followed.placement.undo_axis(shape);
                    let floor = cutter.width_at(depth - copper) / 2;
                    let full = depth - cutter.point();
                    self.swept.push(Swept { shape, floor, depth, full, line: motion.line, slopes });
                }
            }
        }
        self.swept.dedup_by(|a, b| (&a.shape, a.depth) == (&b.shape, b.depth));
        self.swept.shrink_to_fit();
        let half = |(cutter, depth): (Cutter, Nm)| cutter.width_at(depth) / 2;
        let kerf =
            |(cutter, depth)| Kerf { half: half((cutter, depth)), floor: half((cutter, depth - copper)) };
        self.kerfs = deepest.into_iter().map(kerf).collect();
        Ok(())
    }

    /// Asks the same of boards that lie so far from the first.
    pub(super) fn repeat(&mut self, ways: &[Vector]) {
        self.asked = std::mem::take(&mut self.asked).repeated(ways);
    }

    /// Collects where the tool only goes down and up.
    fn plunge(&mut self) {
        // A full turn ends where it began, too.
        let level = |motion: &Motion| {
            motion.from.point() == motion.to.point() && !matches!(motion.way, Way::Arc { .. })
        };
        let sunk = |z: Option<Nm>| z.is_some_and(|z| z < Nm::ZERO);
        let mut down: Option<Point> = None;
        for motion in &self.followed.listing.motions {
            let Some(at) = motion.to.point() else { continue };
            if !level(motion) && (sunk(motion.from.z) || sunk(motion.to.z)) {
                down = None;
                continue;
            }
            if sunk(motion.to.z) && !sunk(motion.from.z) {
                down = Some(self.followed.placement.undo(at));
            } else if sunk(motion.from.z) && !sunk(motion.to.z) {
                self.plunges.extend(down.take());
            }
        }
        self.plunges.dedup();
    }
}

/// Who says how a program lies on a board, and how.
fn lying(program: &Program, declared: &Declared, board: &Board) -> (Option<Zero>, Placement) {
    match program.placement {
        Some(placement) => (Some(Zero::Given), placement),
        None => (declared.origin.as_ref().map(|_| Zero::Told), laid(declared, board, &Laid::default())),
    }
}

/// How a program lies on a board: as its comments say, but for what is given.
pub(super) fn laid(declared: &Declared, board: &Board, given: &Laid) -> Placement {
    let degrees = given.degrees.unwrap_or(declared.degrees);
    let front = origin(declared.origin.as_deref().unwrap_or("keep"), degrees, board);
    let Some(front) = front else { return Placement::default() };
    // Of one that says how it lies and is not mirrored no line is asked for.
    let is_mirrored = declared.mirror.is_some() || declared.origin.is_none();
    Placement {
        mirror: given.mirror.filter(|_| is_mirrored).or(declared.mirror),
        shift: given.shift.unwrap_or(front.shift + declared.offset),
        ..front
    }
}

/// The heights at both ends; one that the program has not given is the other.
fn heights(motion: &Motion) -> Option<(Nm, Nm)> {
    let z = motion.to.z.or(motion.from.z)?;
    Some((motion.from.z.unwrap_or(z), motion.to.z.unwrap_or(z)))
}

/// Whether points lie where geometry is exact wherever the board is put: within half of the range.
fn within_range(points: &[Point]) -> bool {
    points.iter().flat_map(|p| [p.x, p.y]).all(|coordinate| Nm::try_new(coordinate.get() * 2).is_ok())
}

/// How much half the kerf may change within a piece, and how much the depth. In nanometres. Chosen.
const STEP: f64 = 1_000.0;
pub(super) const SINK: f64 = 50_000.0;

/// A motion as pieces of one depth each: one where it is level, else so many that the kerf is true
/// to [`STEP`]. Each lies either above or below each of `levels`, depths that something is judged
/// by.
fn pieces(motion: &Motion, from: Point, to: Point, cutter: Cutter, levels: [Nm; 2]) -> Vec<(Shape, Nm)> {
    let Some((start, end)) = heights(motion) else { return Vec::new() };
    let whole = axis(motion.way, from, to);
    if start == end {
        return straightened(whole).into_iter().map(|shape| (shape, -end)).collect();
    }
    if matches!(whole, Shape::Disc { .. }) {
        return vec![(whole, -start.min(end))];
    }
    let (top, sink) = (start.to_f64(), (end - start).to_f64());
    let mut stops: Vec<f64> = levels.iter().map(|level| (-level.to_f64() - top) / sink).collect();
    stops.retain(|stop| *stop > 0.0 && *stop < 1.0);
    stops.extend([0.0, 1.0]);
    stops.sort_by(f64::total_cmp);
    let change = (cutter.width_at(-start) - cutter.width_at(-end)).abs().to_f64() / 2.0;
    let steps = (change / STEP).max(sink.abs() / SINK);
    let parts = stops.windows(2).flat_map(|pair| shares(pair[0], pair[1], steps));
    let pieces = parts.map(|(first, last)| {
        (part(&whole, first, last), Nm::from_f64(-(top + sink * f64::midpoint(first, last))))
    });
    pieces
        .flat_map(|(shape, depth)| straightened(shape).into_iter().map(move |shape| (shape, depth)))
        .collect()
}

/// Equal shares of the part of a way from one fraction of it to another, of which the whole has
/// `steps`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
fn shares(from: f64, to: f64, steps: f64) -> impl Iterator<Item = (f64, f64)> {
    let count = ((steps * (to - from)).ceil() as u32).clamp(1, 256);
    let at = move |step: u32| from + (to - from) * f64::from(step) / f64::from(count);
    (0..count).map(move |step| (at(step), at(step + 1)))
}

/// A shape, and where it is an arc so flat that its centre lies out of range, its chords.
fn straightened(shape: Shape) -> Vec<Shape> {
    match shape {
        Shape::Arc { arc, radius } if !within_range(&[arc.center]) => {
            let points: Vec<Point> = std::iter::once(arc.start).chain(arc.flatten(CHORD)).collect();
            let chord = |pair: &[Point]| Shape::Stroke { from: pair[0], to: pair[1], radius };
            points.windows(2).filter(|pair| pair[0] != pair[1]).map(chord).collect()
        }
        other => vec![other],
    }
}

/// How far chords may leave an arc. Chosen: far below what is tolerated.
const CHORD: Nm = Nm::new(100);

/// The way of the cutter's middle.
fn axis(way: Way, from: Point, to: Point) -> Shape {
    let radius = Nm::ZERO;
    match way {
        Way::Arc { center, turn } => Shape::Arc { arc: Arc { start: from, end: to, center, turn }, radius },
        Way::Rapid | Way::Feed if from == to => Shape::Disc { center: from, radius },
        Way::Rapid | Way::Feed => Shape::Stroke { from, to, radius },
    }
}

/// The part of an axis between two fractions of it.
pub(super) fn part(axis: &Shape, from: f64, to: f64) -> Shape {
    let (radius, start, end) = (Nm::ZERO, axis.at(from), axis.at(to));
    match axis {
        Shape::Disc { .. } | Shape::Polygon(_) => axis.clone(),
        // What ends where it begins is next to nothing, or a whole turn.
        Shape::Arc { arc, .. } if start != end || (to - from) * arc.sweep().abs() > PI => {
            Shape::Arc { arc: Arc { start, end, ..*arc }, radius }
        }
        Shape::Stroke { .. } if start != end => Shape::Stroke { from: start, to: end, radius },
        Shape::Stroke { .. } | Shape::Arc { .. } => Shape::Disc { center: start, radius },
    }
}

/// What a program is for, by its motions: drilling where it never goes sideways below the surface,
/// cutting out where it goes deeper than copper asks for, else isolating the side that has copper.
fn guess(Followed { listing, tools, .. }: &Followed, board: &Board) -> Option<Role> {
    let motions = &listing.motions;
    let sunk = |motion: &&Motion| heights(motion).is_some_and(|(a, b)| a.min(b) < Nm::ZERO);
    let sideways =
        |motion: &Motion| motion.from.point() != motion.to.point() || matches!(motion.way, Way::Arc { .. });
    let drill =
        |motion: &Motion| tools.at(motion.line).is_some_and(|cutter| cutter.kind == CutterKind::Drill);
    let mut below = motions.iter().filter(sunk).peekable();
    if below.peek().is_some() && below.all(|motion| !sideways(motion) || drill(motion)) {
        return Some(Role::Drilling);
    }
    let deep = motions.iter().filter(sunk).any(|motion| motion.to.z.is_some_and(|z| z < -CUTOUT));
    match (deep, board.front.is_some(), board.back.is_some()) {
        (true, _, _) => Some(Role::Cutout),
        (false, true, false) => Some(Role::Isolation(Side::Front)),
        (false, false, true) => Some(Role::Isolation(Side::Back)),
        (false, _, _) => None,
    }
}

/// Deeper than this no isolation is cut. Chosen: half the thickness of a thin board.
const CUTOUT: Nm = Nm::from_um(500);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gcode::read::{Place, Spindle};

    #[test]
    fn a_move_that_rises_is_cut_in_two_where_it_leaves_the_copper() {
        let place =
            |x: i64, z: i64| Place { x: Some(Nm::from_um(x)), y: Some(Nm::ZERO), z: Some(Nm::from_um(z)) };
        let (from, to) = (place(0, -100), place(10_000, 0));
        let motion =
            Motion { way: Way::Feed, from, to, feed: None, spindle: Spindle::Off, tool: None, line: 1 };
        let ends = [from, to].map(|place| place.point().expect("a place"));
        for tool in ["endmill:0.2mm", "vbit:0.1mm:30deg"] {
            let cutter: Cutter = tool.parse().expect("a tool");
            let levels = [Nm::from_um(35), Nm::from_um(1600)];
            let pieces = pieces(&motion, ends[0], ends[1], cutter, levels);
            let parting = pieces.iter().filter(|(_, depth)| *depth >= levels[0]);
            let last = parting.map(|(shape, _)| shape.bounds().max().x).max();
            assert_eq!(last, Some(Nm::from_um(6500)), "{tool} parts copper to where it is 35 µm deep");
            let half = |depth: Nm| cutter.width_at(depth).to_f64() / 2.0;
            let step = pieces.windows(2).map(|pair| (half(pair[0].1) - half(pair[1].1)).abs());
            assert!(step.fold(0.0, f64::max) <= 1_001.0, "{tool} narrows in steps of a micrometre");
        }
    }
}
