//! Which primitives may be seen in a cell, and how near at best.
//!
//! A cell's bin is sifted from that of the cell around it, so that unlimited cones do not cost
//! sites × tiles.

use super::canvas::{Canvas, Extent, SIDE};
use super::cell::Cell;
use super::half_plane::Cover;
use super::mosaic::{Cuts, Mosaic};
use super::primitive::{Part, Primitive, Shape};
use super::processor::LANES;
use super::{Label, Scene};

/// The primitives that may be seen in a cell: the bin of the cell.
///
/// # Guarantees
///
/// Both lists run in the order of labels. What is not in them has no visible fragment in the cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Bin {
    pub shapes: Vec<Candidate>,
    pub parts: Vec<Part>,
    /// The edges of the parts.
    pub edges: Vec<u32>,
    /// No fragment that is seen is deeper; infinite where something may not be covered.
    far: f32,
    /// Whether what lies behind is kept, too: for blending, where nothing hides anything.
    pub sees_through: bool,
}

/// A primitive that may be seen in a cell, and what is known of its depth there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub primitive: u32,
    /// No fragment is nearer than this nor than 0.
    pub near: f32,
    /// And none is deeper than the larger of this and 0, where it covers the whole cell; else
    /// infinite.
    pub far: f32,
    /// How its depth changes a pixel along x and y in the middle of the cell, infinite where that
    /// is not known; and how much that may change a pixel.
    pub way: (f32, f32),
    pub curve: f32,
}

const _: () = assert!(size_of::<Candidate>() == 24, "six words");

impl Candidate {
    const UNKNOWN: Self = Self {
        primitive: 0,
        near: 0.0,
        far: f32::INFINITY,
        way: (f32::INFINITY, f32::INFINITY),
        curve: f32::INFINITY,
    };

    /// Whether it lies behind `other` everywhere in a cell whose samples lie within `radius` of its
    /// middle.
    ///
    /// Both depths in the middle are known up to the radius that `near` and `far` allow for. From
    /// there a convex distance grows no slower than its plane says, and no faster than its plane
    /// and its curve say. That tells sites apart that lie the same way, where the radius alone
    /// would not: |d₁ − d₂| > |g₁ − g₂| r + r² / 2 d₂.
    fn lies_behind(&self, other: &Self, radius: f32) -> bool {
        let (x, y) = (self.way.0 - other.way.0, self.way.1 - other.way.1);
        let apart = self.near - other.far + 2.0 * radius;
        // A few roundings of a unit vector each.
        let turned = (x * x + y * y).sqrt() + 1e-5;
        // Where the other is at depth 0, only its being nearer than this one's bound counts.
        self.near > 0.0 && apart > radius * turned + radius * radius * 0.5 * other.curve * 1.001
    }
}

impl Bin {
    /// The bin of the whole picture: everything.
    pub(super) fn root(scene: &Scene, picture: Cell) -> Self {
        let mut order: Vec<_> = (0..).zip(&scene.primitives).map(|(index, p)| (p.label, index)).collect();
        order.sort_unstable();
        let mut bin = Self { far: f32::INFINITY, ..Self::default() };
        for (_, primitive) in order {
            let shape = &scene.primitives[index(primitive)].shape;
            if let Shape::Polygon(polygon) = shape {
                let (x, y) = picture.first();
                let begin = bin.edges.len();
                bin.edges.extend((0..).take(polygon.edge_count()));
                let edges = begin..bin.edges.len();
                bin.parts.push(Part { primitive, winding: polygon.winding(x, y), edges });
            } else {
                bin.shapes.push(Candidate { primitive, ..Candidate::UNKNOWN });
            }
        }
        bin
    }

    /// The same, and nothing in it hides anything.
    pub(super) fn seen_through(self) -> Self {
        Self { sees_through: true, ..self }
    }

    /// Gives back memory that it does not need, for a bin that is to be kept.
    pub(super) fn shrink(&mut self) {
        self.shapes.shrink_to_fit();
        self.parts.shrink_to_fit();
        self.edges.shrink_to_fit();
    }

    /// Empties it, to be filled from `from`.
    pub(super) fn clear(&mut self, from: &Self) {
        self.shapes.clear();
        self.parts.clear();
        self.edges.clear();
        self.sees_through = from.sees_through;
    }

    /// Lets go of all that lies behind `hidden`, and behind the nearest candidate in a cell of this
    /// radius.
    pub(super) fn settle(&mut self, scene: &Scene, hidden: f32, radius: f32) {
        self.far = hidden;
        // One that is alone lies behind nothing: most bins of blocks.
        if self.len() < 2 {
            return;
        }
        let nearer = |a: Candidate, b: &Candidate| if b.far < a.far { *b } else { a };
        if let [first, others @ ..] = self.shapes.as_slice() {
            let nearest = others.iter().fold(*first, nearer);
            let behind = |candidate: &Candidate| {
                !self.sees_through && nearest.far < f32::INFINITY && candidate.lies_behind(&nearest, radius)
            };
            self.shapes.retain(|candidate| candidate.near.max(0.0) <= hidden && !behind(candidate));
        }
        self.parts.retain(|part| depth(scene, part) <= hidden);
    }

    /// The depth that no fragment is nearer than.
    fn near(&self, scene: &Scene) -> f32 {
        let shapes = self.shapes.iter().map(|candidate| candidate.near.max(0.0));
        let parts = self.parts.iter().map(|part| depth(scene, part));
        shapes.chain(parts).fold(f32::INFINITY, f32::min)
    }

    /// The one label of every pixel of the cell, where that is certain, and certain that no pixel
    /// lies at a depth on the other side of one of `levels` than another.
    pub(super) fn uniform(&self, scene: &Scene, levels: &[f32]) -> Option<Label> {
        let mut labels = self.primitives().map(|primitive| scene.primitives[index(primitive)].label);
        let Some(label) = labels.next() else { return Some(Label::BACKGROUND) };
        let covered = self.far < f32::INFINITY;
        let alone = labels.all(|other| other == label);
        let crossed = || {
            let range = self.near(scene)..=self.far;
            levels.iter().any(|level| range.contains(level))
        };
        (covered && alone && !crossed()).then_some(label)
    }

    /// All that may be seen, in no particular order.
    fn primitives(&self) -> impl Iterator<Item = u32> {
        self.shapes
            .iter()
            .map(|candidate| candidate.primitive)
            .chain(self.parts.iter().map(|part| part.primitive))
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.shapes.len() + self.parts.len()
    }

    /// Draws each primitive alone on a canvas as large as `cell`, a block; `drawn` gets them in the
    /// order of labels.
    pub(super) fn draw_each(
        &self,
        scene: &Scene,
        cell: Cell,
        canvas: &mut Canvas,
        mut drawn: impl FnMut(Label, &Canvas),
    ) {
        canvas.stretch(cell);
        canvas.place(cell);
        let shapes = self.shapes.iter().map(|shape| (shape.primitive, None));
        let parts = self.parts.iter().map(|part| (part.primitive, Some(part)));
        let mut all: Vec<_> = shapes.chain(parts).collect();
        all.sort_by_key(|(primitive, _)| scene.primitives[index(*primitive)].label);
        for (number, part) in all {
            let Primitive { label, shape } = &scene.primitives[index(number)];
            canvas.clear();
            match (shape, part) {
                (Shape::Polygon(polygon), Some(part)) => {
                    polygon.draw(*label, part, &self.edges, Extent::Whole, canvas);
                }
                _ => shape.draw(*label, Cover::Part, false, canvas),
            }
            drawn(*label, canvas);
        }
    }

    /// Draws all of it on the block of `canvas`, in the order of labels.
    fn draw(&self, scene: &Scene, canvas: &mut Canvas) {
        let (mut shapes, mut parts) = (self.shapes.as_slice(), self.parts.as_slice());
        let label = |primitive: u32| scene.primitives[index(primitive)].label;
        let mut first = self.fills(scene);
        if !first {
            canvas.clear();
        }
        loop {
            let shape_first = match (shapes, parts) {
                ([], []) => return,
                ([shape, ..], [part, ..]) => label(shape.primitive) <= label(part.primitive),
                (shapes, _) => !shapes.is_empty(),
            };
            if let (true, [candidate, rest @ ..]) = (shape_first, shapes) {
                let cover = if candidate.far < f32::INFINITY { Cover::Whole } else { Cover::Part };
                let primitive = &scene.primitives[index(candidate.primitive)];
                primitive.shape.draw(primitive.label, cover, first, canvas);
                shapes = rest;
            } else if let [part, rest @ ..] = parts {
                if let Shape::Polygon(polygon) = &scene.primitives[index(part.primitive)].shape {
                    let extent = if first { Extent::First } else { Extent::Whole };
                    polygon.draw(label(part.primitive), part, &self.edges, extent, canvas);
                }
                parts = rest;
            }
            first = false;
        }
    }

    /// Whether what is drawn first covers the whole block, so that it need not be cleared.
    fn fills(&self, scene: &Scene) -> bool {
        let label = |primitive: u32| scene.primitives[index(primitive)].label;
        match (self.shapes.first(), self.parts.first()) {
            (Some(shape), Some(part)) if label(part.primitive) < label(shape.primitive) => {
                part.edges.is_empty()
            }
            (Some(shape), _) => {
                shape.far < f32::INFINITY && scene.primitives[index(shape.primitive)].shape.fills()
            }
            (None, Some(part)) => part.edges.is_empty(),
            (None, None) => false,
        }
    }
}

/// The depth of a polygon's part.
fn depth(scene: &Scene, part: &Part) -> f32 {
    match &scene.primitives[index(part.primitive)].shape {
        Shape::Polygon(polygon) => polygon.depth(),
        _ => f32::INFINITY,
    }
}

/// Pixels along a side of a cell that is cut into blocks; a larger one is cut into cells first.
/// Chosen.
const CELL: i32 = 160;

const _: () = assert!(CELL / LANES <= SIDE, "a piece of a cell fits a block");

/// Pixels along a side of the pieces that a cell `side` pixels long is cut into, and how many
/// candidates one of them may have to be drawn as it is. Measured: see the module's doc.
const fn grain(side: i32) -> (i32, usize) {
    match side {
        ..=24 => (8, usize::MAX),
        25..=CELL => (16, 6),
        _ => (CELL, 0),
    }
}

/// Draws cells; owns the memory that takes, and the canvas.
pub(super) struct Painter {
    pub canvas: Canvas,
    pub mosaic: Mosaic,
    /// What a level of the way down needs.
    levels: Vec<(Cuts, Vec<Bin>)>,
}

impl Painter {
    pub(super) fn new() -> Self {
        Self { canvas: Canvas::new(), mosaic: Mosaic::new(), levels: Vec::new() }
    }

    /// Draws the cell whose bin is `bin` on the canvas, in whose frame it lies.
    pub(super) fn paint(&mut self, scene: &Scene, bin: &Bin, cell: Cell) {
        let (mut cuts, mut bins) = self.levels.pop().unwrap_or_default();
        let (pieces, few) = grain(cell.width.max(cell.height));
        cuts.even(cell, pieces);
        self.mosaic.split(scene, bin, cell, &cuts, &mut bins);
        for (piece, bin) in cuts.cells().zip(&bins) {
            if bin.len() <= few {
                self.canvas.place(piece);
                bin.draw(scene, &mut self.canvas);
            } else {
                self.paint(scene, bin, piece);
            }
        }
        self.levels.push((cuts, bins));
    }
}

/// An index of a primitive as a `usize`.
pub(super) const fn index(primitive: u32) -> usize {
    primitive as usize
}
