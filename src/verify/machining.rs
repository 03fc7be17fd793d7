//! A program followed: its motions on the board, and what the cutter sweeps.

use crate::board::{Board, Shape, Side};
use crate::gcode::read::{self, Motion, Note, Way};
use crate::geometry::{Arc, Nm, Point};

use super::stated::Stated;
use super::{Cutter, CutterKind, Error, Placement, Program, Role, Settings, origin};

/// A program, followed.
#[derive(Debug)]
pub(super) struct Machining {
    pub(super) file: String,
    pub(super) role: Role,
    pub(super) placement: Placement,
    /// What it says, until that was looked at.
    pub(super) motions: Vec<Motion>,
    /// What was assumed to follow it.
    pub(super) notes: Vec<Note>,
    /// What is cut away, deep enough to part the copper.
    pub(super) swept: Vec<Swept>,
    /// Where the tool goes straight down into the board.
    pub(super) plunges: Vec<Plunge>,
}

/// A piece of what the cutter sweeps, on the board.
#[derive(Clone, Debug)]
pub(super) struct Swept {
    /// The axis of the cutter's way, its radius half the kerf.
    pub(super) shape: Shape,
    /// How deep below the surface.
    pub(super) depth: Nm,
    /// The line of the program.
    pub(super) line: u32,
}

impl Swept {
    /// Half the kerf.
    pub(super) const fn half(&self) -> Nm {
        match &self.shape {
            Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => *radius,
            Shape::Polygon(_) => Nm::ZERO,
        }
    }

    /// The way of the cutter's middle.
    pub(super) fn axis(&self) -> Shape {
        with_radius(&self.shape, Nm::ZERO)
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

/// A way straight down into the board that nothing sideways follows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plunge {
    /// On the board.
    pub(super) at: Point,
    pub(super) diameter: Nm,
    pub(super) line: u32,
}

impl Machining {
    /// Follows `program` on `board`.
    pub(super) fn read(program: &Program, board: &Board, settings: &Settings) -> Result<Self, Error> {
        let failed = |reason| Error::Read { file: program.file.clone(), reason };
        let listing = read::read(&read::without_own_code(&program.text)).map_err(failed)?;
        if listing.motions.is_empty() {
            return Err(Error::NoMotion(program.file.clone()));
        }
        let stated = Stated::read(&program.text);
        let tools = Tools { only: program.cutter, stated: &stated.cutters };
        let role = match program.role.or(stated.role) {
            Some(role) => role,
            None => {
                guess(&listing.motions, &tools, board).ok_or_else(|| Error::NoSide(program.file.clone()))?
            }
        };
        let placement = program.placement.or_else(|| {
            let front = origin(stated.origin.as_deref().unwrap_or("keep"), stated.degrees, board)?;
            Some(Placement { mirror: stated.mirror, shift: front.shift + stated.offset, ..front })
        });
        let placement = placement.unwrap_or_default();
        let file = program.file.clone();
        let mut machining = Self {
            file,
            role,
            placement,
            motions: listing.motions,
            notes: listing.notes,
            swept: Vec::new(),
            plunges: Vec::new(),
        };
        machining.sweep(&tools, settings.copper)?;
        machining.plunge(&tools);
        Ok(machining)
    }

    /// Collects what is cut.
    fn sweep(&mut self, tools: &Tools<'_>, copper: Nm) -> Result<(), Error> {
        for motion in &self.motions {
            let (Some(from), Some(to)) = (motion.from.point(), motion.to.point()) else { continue };
            let Some((above, below)) = heights(motion) else { continue };
            if above.min(below) > -copper {
                continue;
            }
            if !within_range(&[from, to]) {
                return Err(Error::Range { file: self.file.clone(), line: motion.line });
            }
            let Some(cutter) = tools.at(motion.line) else {
                return Err(Error::NoTool { file: self.file.clone(), line: motion.line });
            };
            for (shape, depth) in pieces(motion, from, to, cutter) {
                if depth >= copper {
                    let shape = with_radius(&shape, cutter.width_at(depth) / 2);
                    let shape = self.placement.undo_axis(shape);
                    self.swept.push(Swept { shape, depth, line: motion.line });
                }
            }
        }
        self.swept.dedup_by(|a, b| (&a.shape, a.depth) == (&b.shape, b.depth));
        Ok(())
    }

    /// Collects where the tool only goes down and up.
    fn plunge(&mut self, tools: &Tools<'_>) {
        // A full turn ends where it began, too.
        let level = |motion: &Motion| {
            motion.from.point() == motion.to.point() && !matches!(motion.way, Way::Arc { .. })
        };
        let sunk = |z: Option<Nm>| z.is_some_and(|z| z < Nm::ZERO);
        let mut down: Option<Plunge> = None;
        for motion in &self.motions {
            let Some(at) = motion.to.point() else { continue };
            if !level(motion) && (sunk(motion.from.z) || sunk(motion.to.z)) {
                down = None;
                continue;
            }
            if sunk(motion.to.z) && !sunk(motion.from.z) {
                let diameter = tools.at(motion.line).map_or(Nm::ZERO, |cutter| cutter.tip);
                down = Some(Plunge { at: self.placement.undo(at), diameter, line: motion.line });
            } else if sunk(motion.from.z) && !sunk(motion.to.z) {
                self.plunges.extend(down.take());
            }
        }
        self.plunges.dedup_by(|a, b| a.at == b.at && a.diameter == b.diameter);
    }
}

/// The tools of a program by line.
struct Tools<'a> {
    only: Option<Cutter>,
    stated: &'a [(u32, Cutter)],
}

impl Tools<'_> {
    /// The tool that cuts in `line`.
    fn at(&self, line: u32) -> Option<Cutter> {
        let before = self.stated.partition_point(|(from, _)| *from <= line);
        self.only.or_else(|| Some(self.stated[before.checked_sub(1)?].1))
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

/// How much half the kerf may change within a piece.
const STEP: f64 = 1_000.0;

/// A motion as pieces of one depth each: one where it is level, else so many that the kerf is true to [`STEP`].
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small count")]
fn pieces(motion: &Motion, from: Point, to: Point, cutter: Cutter) -> Vec<(Shape, Nm)> {
    let Some((start, end)) = heights(motion) else { return Vec::new() };
    let whole = axis(motion.way, from, to);
    if start == end {
        return straightened(whole).into_iter().map(|shape| (shape, -end)).collect();
    }
    if matches!(whole, Shape::Disc { .. }) {
        return vec![(whole, -start.min(end))];
    }
    let change = (cutter.width_at(-start) - cutter.width_at(-end)).abs().to_f64() / 2.0;
    let count = ((change / STEP).ceil() as u32).clamp(16, 256);
    let at = |step: u32| f64::from(step) / f64::from(count);
    let pieces = (0..count).map(|step| {
        let middle = f64::midpoint(at(step), at(step + 1));
        let z = start.to_f64() + (end - start).to_f64() * middle;
        (part(&whole, at(step), at(step + 1)), Nm::from_f64(-z))
    });
    pieces
        .flat_map(|(shape, depth)| straightened(shape).into_iter().map(move |shape| (shape, depth)))
        .collect()
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
fn part(axis: &Shape, from: f64, to: f64) -> Shape {
    let radius = Nm::ZERO;
    match axis {
        Shape::Stroke { from: a, to: b, .. } => {
            let (x, y) = a.to_f64();
            let way = *b - *a;
            let at = |f: f64| Point::from_f64(x + way.x.to_f64() * f, y + way.y.to_f64() * f);
            let (from, to) = (at(from), at(to));
            if from == to { Shape::Disc { center: from, radius } } else { Shape::Stroke { from, to, radius } }
        }
        Shape::Arc { arc, .. } => {
            let at = |f: f64| Point::from_f64(arc.at(f).0, arc.at(f).1);
            let (start, end) = (at(from), at(to));
            if start == end {
                Shape::Disc { center: start, radius }
            } else {
                Shape::Arc { arc: Arc { start, end, ..*arc }, radius }
            }
        }
        Shape::Disc { .. } | Shape::Polygon(_) => axis.clone(),
    }
}

/// What a program is for, by its motions: drilling where it never goes sideways below the surface, cutting out where it goes
/// deeper than copper asks for, else isolating the side that has copper.
fn guess(motions: &[Motion], tools: &Tools<'_>, board: &Board) -> Option<Role> {
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
