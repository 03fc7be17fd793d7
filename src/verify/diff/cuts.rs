//! What a program cuts, and how deep, by place.

use bitvec::vec::BitVec;
use rustc_hash::FxHashMap;

use crate::board::{Board, Shape};
use crate::gcode::read::{Listing, Motion, Way};
use crate::geometry::{Arc, Nm, Point, Rect, RectIndex, Turn};
use crate::grid::Grid;
use crate::raster::{Label, Scene};
use crate::topology::surface;
use crate::verify::bores::from_axis;
use crate::verify::machining::{Machining, SINK, Swept, half};
use crate::verify::{Error, Placement, Program, Role, Settings};

use super::capsule::Capsule;

/// A shape that is cut, where the machine has it, and how deep.
#[derive(Debug)]
pub(super) struct Groove {
    pub(super) shape: Shape,
    /// Between the least and the most: slopes are cut in steps.
    least: Nm,
    most: Nm,
}

impl Groove {
    fn new(swept: Swept) -> Self {
        // The middle of a step.
        let off = if swept.slopes { Nm::from_f64(SINK / 2.0) } else { Nm::ZERO };
        let (least, most) = (swept.depth - off, swept.depth + off);
        Self { shape: undirected(swept.shape), least, most }
    }
}

/// What a program cuts, by place.
#[derive(Debug)]
pub(super) struct Cuts {
    pub(super) grooves: Vec<Groove>,
    /// Those that the other program does not have as deep.
    alone: BitVec,
    index: RectIndex,
}

impl Cuts {
    /// What two programs cut; depths count from `tolerance` on.
    pub(super) fn of(
        programs: [&Program; 2],
        tolerance: Nm,
        settings: &Settings,
    ) -> Result<[Self; 2], Error> {
        let [before, after] = programs.map(|program| read(program, settings));
        let (before, after) = (before?, after?);
        let (old, new) = (alone(&before, &after, tolerance), alone(&after, &before, tolerance));
        Ok([Self::new(before, old), Self::new(after, new)])
    }

    fn new(grooves: Vec<Groove>, alone: BitVec) -> Self {
        let index = RectIndex::new(grooves.iter().map(|groove| groove.shape.bounds()));
        Self { grooves, alone, index }
    }

    /// Of the grooves that touch `rect` those that the other program does not have as deep, arcs as
    /// chords within `chord`, each at least so deep.
    pub(super) fn alone(&self, rect: Rect, chord: Nm) -> Vec<Capsule> {
        let near = self.index.touching(rect).into_iter().filter(|&groove| self.alone[groove]);
        let near = near.map(|groove| &self.grooves[groove]);
        near.flat_map(|groove| Capsule::of(&groove.shape, chord, groove.least)).collect()
    }

    /// The grooves that come nearer to `rect` than `tolerance`, arcs as chords within `chord`, each
    /// at most so deep, and the tolerance deeper.
    pub(super) fn near(&self, rect: Rect, chord: Nm, tolerance: Nm) -> Vec<Capsule> {
        let near = self.touching(rect.inflate(tolerance));
        near.flat_map(|groove| Capsule::of(&groove.shape, chord, groove.most + tolerance)).collect()
    }

    fn touching(&self, rect: Rect) -> impl Iterator<Item = &Groove> {
        self.index.touching(rect).into_iter().map(|groove| &self.grooves[groove])
    }

    /// How deep it is cut within `tolerance` of a place.
    pub(super) fn depth_at(&self, place: Point, tolerance: Nm) -> Option<Nm> {
        let reaches = |shape: &Shape| from_axis(shape, place) <= (half(shape) + tolerance).to_f64();
        let near = self.touching(Rect::new(place, place).inflate(tolerance));
        let near = near.filter(|groove| reaches(&groove.shape));
        near.map(|groove| (groove.least + groove.most) / 2).max()
    }

    /// Marks the pixels of `grid` that are cut with zero.
    pub(super) fn draw(&self, grid: &Grid, scene: &mut Scene) {
        for groove in self.touching(grid.rect()) {
            scene.add(Label(1), surface(&groove.shape, grid, Some(0.0)));
        }
    }
}

/// What a program cuts, each shape once, as deep as it comes; of an empty text nothing.
fn read(program: &Program, settings: &Settings) -> Result<Vec<Groove>, Error> {
    if program.text.is_empty() {
        return Ok(Vec::new());
    }
    // Where the board lies and what for is no matter: both are compared as the machine moves.
    let role = program.role.unwrap_or(Role::Cutout);
    let placed = Program { role: Some(role), placement: Some(Placement::default()), ..program.clone() };
    let read = Machining::read(&placed, &Board::default(), settings)?;
    if let Some((line, what)) = unfollowed(&read.followed.listing) {
        return Err(Error::Unfollowed { file: program.file.clone(), line, what });
    }
    // The same way is cut again and again, deeper each time.
    let mut known: FxHashMap<Shape, usize> = FxHashMap::default();
    let mut grooves: Vec<Groove> = Vec::new();
    for groove in read.swept.into_iter().map(Groove::new) {
        let at = *known.entry(groove.shape.clone()).or_insert(grooves.len());
        match grooves.get_mut(at) {
            Some(known) if known.least < groove.least => *known = groove,
            Some(_) => {}
            None => grooves.push(groove),
        }
    }
    Ok(grooves)
}

/// The first line at which a program does what was not followed, and what that is.
fn unfollowed(listing: &Listing) -> Option<(u32, &'static str)> {
    let motions = || listing.motions.iter();
    let is_low = |motion: &&Motion| motion.to.z.is_some_and(|z| z < Nm::ZERO);
    let lost =
        motions().find(|motion| motion.way != Way::Rapid && motion.to.point().is_none() && is_low(motion));
    if let Some(lost) = lost {
        return Some((lost.line, "it cuts at a place that the program has not given"));
    }
    // As high as the machine is by chance, from the first line to the last.
    let has_height = motions().any(|motion| motion.to.z.is_some());
    let cut = motions().find(|motion| motion.way != Way::Rapid && !has_height);
    if let Some(cut) = cut {
        return Some((cut.line, "it cuts at a height that the program has not given"));
    }
    listing.behind_end.map(|line| (line, "it goes on behind its end"))
}

/// The same shape whichever way it is cut.
fn undirected(shape: Shape) -> Shape {
    match shape {
        Shape::Stroke { from, to, radius } if to < from => Shape::Stroke { from: to, to: from, radius },
        Shape::Arc { arc, radius } if arc.turn == Turn::Clockwise => {
            let arc = Arc { start: arc.end, end: arc.start, turn: Turn::CounterClockwise, ..arc };
            Shape::Arc { arc, radius }
        }
        other => other,
    }
}

/// Which are not among others, as deep.
fn alone(grooves: &[Groove], others: &[Groove], tolerance: Nm) -> BitVec {
    let others: FxHashMap<&Shape, Nm> =
        others.iter().map(|groove| (&groove.shape, groove.most + tolerance)).collect();
    grooves.iter().map(|groove| others.get(&groove.shape).is_none_or(|deep| groove.least > *deep)).collect()
}
