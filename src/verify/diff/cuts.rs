//! What a program cuts, and how deep, by place.

use bitvec::vec::BitVec;
use rustc_hash::FxHashMap;

use crate::board::{Board, Shape};
use crate::geometry::{Arc, Nm, Point, Rect, RectIndex, Turn};
use crate::grid::Grid;
use crate::raster::{Label, Scene};
use crate::topology::surface;
use crate::verify::machining::{Machining, SINK, Swept};
use crate::verify::{Error, Placement, Program, Role, Settings};

use super::capsule::Capsule;

/// A shape that is cut, where the machine has it, and how deep.
#[derive(Debug)]
pub(super) struct Cut {
    pub(super) shape: Shape,
    /// Between the least and the most: slopes are cut in steps.
    least: Nm,
    most: Nm,
}

impl Cut {
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
    pub(super) cuts: Vec<Cut>,
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

    fn new(cuts: Vec<Cut>, alone: BitVec) -> Self {
        let index = RectIndex::new(cuts.iter().map(|cut| cut.shape.bounds()));
        Self { cuts, alone, index }
    }

    /// Of the cuts that touch `rect` those that the other program does not have as deep, arcs as
    /// chords within `chord`, each at least so deep.
    pub(super) fn alone(&self, rect: Rect, chord: Nm) -> Vec<Capsule> {
        let near = self.index.touching(rect).into_iter().filter(|&cut| self.alone[cut]);
        let near = near.map(|cut| &self.cuts[cut]);
        near.flat_map(|cut| Capsule::of(&cut.shape, chord, cut.least)).collect()
    }

    /// The cuts that come nearer to `rect` than `tolerance`, arcs as chords within `chord`, each
    /// at most so deep, and the tolerance deeper.
    pub(super) fn near(&self, rect: Rect, chord: Nm, tolerance: Nm) -> Vec<Capsule> {
        let near = self.index.touching(rect.inflate(tolerance)).into_iter().map(|cut| &self.cuts[cut]);
        near.flat_map(|cut| Capsule::of(&cut.shape, chord, cut.most + tolerance)).collect()
    }

    /// How deep it is cut within `tolerance` of a place, arcs as chords within `chord`.
    pub(super) fn depth_at(&self, place: Point, chord: Nm, tolerance: Nm) -> Option<Nm> {
        let near = self.index.touching(Rect::new(place, place).inflate(tolerance)).into_iter();
        let near = near.map(|cut| &self.cuts[cut]).filter(|cut| {
            let parts = Capsule::of(&cut.shape, chord, Nm::ZERO);
            parts.iter().any(|part| part.beyond(place.to_f64()) <= tolerance.to_f64())
        });
        near.map(|cut| (cut.least + cut.most) / 2).max()
    }

    /// Marks the pixels of `grid` that are cut with zero.
    pub(super) fn draw(&self, grid: &Grid, scene: &mut Scene) {
        for cut in self.index.touching(grid.rect()) {
            scene.add(Label(1), surface(&self.cuts[cut].shape, grid, Some(0.0)));
        }
    }
}

/// What a program cuts, each shape once, as deep as it comes; of an empty text nothing.
fn read(program: &Program, settings: &Settings) -> Result<Vec<Cut>, Error> {
    if program.text.is_empty() {
        return Ok(Vec::new());
    }
    // Where the board lies and what for is no matter: both are compared as the machine moves.
    let role = program.role.unwrap_or(Role::Cutout);
    let placed = Program { role: Some(role), placement: Some(Placement::default()), ..program.clone() };
    let read = Machining::read(&placed, &Board::default(), settings)?;
    // The same way is cut again and again, deeper each time.
    let mut known: FxHashMap<Shape, usize> = FxHashMap::default();
    let mut cuts: Vec<Cut> = Vec::new();
    for cut in read.swept.into_iter().map(Cut::new) {
        let at = *known.entry(cut.shape.clone()).or_insert(cuts.len());
        match cuts.get_mut(at) {
            Some(known) if known.least < cut.least => *known = cut,
            Some(_) => {}
            None => cuts.push(cut),
        }
    }
    Ok(cuts)
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

/// Which cuts are not among others, as deep.
fn alone(cuts: &[Cut], others: &[Cut], tolerance: Nm) -> BitVec {
    let others: FxHashMap<&Shape, Nm> = others.iter().map(|cut| (&cut.shape, cut.most + tolerance)).collect();
    cuts.iter().map(|cut| others.get(&cut.shape).is_none_or(|deep| cut.least > *deep)).collect()
}
