use super::block::{Block, Extent, LANES, SIDE};
use super::cell::Cell;
use super::half_plane::Cover;
use super::mosaic::Mosaic;
use super::primitive::{Part, Primitive, Reach, Shape};
use super::{Label, Scene};

/// The primitives that may be seen in a cell: the bin of the cell.
///
/// # Guarantees
///
/// Both lists run in the order of labels. What is not in them has no visible fragment in the cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Bin {
    shapes: Vec<Candidate>,
    parts: Vec<Part>,
    part_reaches: Vec<Reach>,
    edges: Vec<u32>,
    near: f64,
    far: f64,
    /// Whether what lies behind is kept, too: for blending, where nothing hides anything.
    sees_through: bool,
}

#[derive(Clone, Copy, Debug)]
struct Candidate {
    primitive: u32,
    whole: bool,
    near: f64,
}

impl Bin {
    /// The bin of the whole picture: everything.
    pub(super) fn root(scene: &Scene, picture: Cell) -> Self {
        let mut order: Vec<_> = (0..).zip(&scene.primitives).map(|(index, p)| (p.label, index)).collect();
        order.sort_unstable();
        let mut bin = Self { near: f64::NEG_INFINITY, far: f64::INFINITY, ..Self::default() };
        for (_, primitive) in order {
            let shape = &scene.primitives[index(primitive)].shape;
            if let Shape::Polygon(polygon) = shape {
                let (x, y) = picture.first();
                let begin = bin.edges.len();
                bin.edges.extend((0..).take(polygon.edge_count()));
                let edges = begin..bin.edges.len();
                bin.parts.push(Part { primitive, winding: polygon.winding(x, y), edges });
            } else {
                bin.shapes.push(Candidate { primitive, whole: false, near: 0.0 });
            }
        }
        bin
    }

    /// The same, and nothing in it hides anything.
    pub(super) fn seen_through(self) -> Self {
        Self { sees_through: true, ..self }
    }

    /// Becomes the bin of `cell`, given that of a cell `around` it.
    ///
    /// A primitive that covers the whole cell no deeper than `far` hides all that lie entirely behind. Only what is
    /// strictly behind goes: a tie is decided pixel by pixel.
    pub(super) fn narrow(&mut self, scene: &Scene, from: &Self, around: Cell, cell: Cell) {
        self.shapes.clear();
        self.parts.clear();
        self.part_reaches.clear();
        self.edges.clear();
        (self.near, self.far, self.sees_through) = (f64::INFINITY, f64::INFINITY, from.sees_through);
        for part in &from.parts {
            let Shape::Polygon(polygon) = &scene.primitives[index(part.primitive)].shape else { continue };
            if let Some((part, reach)) = polygon.narrow(part, &from.edges, around, cell, &mut self.edges) {
                self.near = self.near.min(reach.near);
                self.far = self.far.min(reach.far);
                self.parts.push(part);
                self.part_reaches.push(reach);
            }
        }
        for candidate in &from.shapes {
            if candidate.near > self.far && !self.sees_through {
                continue;
            }
            let Some(reach) = scene.primitives[index(candidate.primitive)].shape.reach(cell) else {
                continue;
            };
            if reach.near > self.far && !self.sees_through {
                continue;
            }
            self.near = self.near.min(reach.near);
            self.far = self.far.min(reach.far);
            let whole = reach.cover == Cover::Whole;
            self.shapes.push(Candidate { primitive: candidate.primitive, whole, near: reach.near });
        }
        let far = if self.sees_through { f64::INFINITY } else { self.far };
        self.shapes.retain(|candidate| candidate.near <= far);
        let mut reaches = self.part_reaches.iter();
        self.parts.retain(|_| reaches.next().is_some_and(|reach| reach.near <= far));
    }

    /// The one owner of every pixel of the cell, where that is certain, and certain that no pixel lies at a depth
    /// on the other side of one of `levels` than another.
    pub(super) fn uniform(&self, scene: &Scene, levels: &[f32]) -> Option<u32> {
        let mut candidates = self.primitives();
        let Some(first) = candidates.next() else { return Some(scene.owner(Label::BACKGROUND)) };
        let owner = scene.owner(scene.primitives[index(first)].label);
        let covered = self.far < f64::INFINITY;
        let alone = candidates.all(|other| scene.owner(scene.primitives[index(other)].label) == owner);
        let crossed = levels.iter().any(|&level| (self.near..=self.far).contains(&f64::from(level)));
        (covered && alone && !crossed).then_some(owner)
    }

    /// All that may be seen, in no particular order.
    fn primitives(&self) -> impl Iterator<Item = u32> {
        self.shapes
            .iter()
            .map(|candidate| candidate.primitive)
            .chain(self.parts.iter().map(|part| part.primitive))
    }

    /// Whether the cell can be drawn as a mosaic: few enough edges that every block can look at all.
    fn is_ripe(&self, cell: Cell) -> bool {
        let fits = cell.width.max(cell.height) <= Mosaic::SIDE;
        let bare = self.edges.len() <= 16 || cell.width.max(cell.height) <= SIDE;
        fits && bare
    }

    /// Becomes the bin of a block of the mosaic that was drawn for `around` and its bin `from`.
    fn narrow_to_block(
        &mut self,
        scene: &Scene,
        from: &Self,
        around: Cell,
        mosaic: &Mosaic,
        (row, column, block): (usize, usize, Cell),
    ) {
        self.shapes.clear();
        self.parts.clear();
        self.edges.clear();
        let hidden = mosaic.hidden(row, column);
        let mut far = hidden;
        for part in &from.parts {
            let Shape::Polygon(polygon) = &scene.primitives[index(part.primitive)].shape else { continue };
            if let Some((part, reach)) = polygon.narrow(part, &from.edges, around, block, &mut self.edges) {
                if reach.cover == Cover::Whole {
                    far = far.min(polygon.depth());
                }
                if polygon.depth() <= hidden {
                    self.parts.push(part);
                }
            }
        }
        for (number, candidate) in from.shapes.iter().enumerate() {
            let (near, deepest) = mosaic.depths(number, row, column);
            if near <= far && near < f32::INFINITY {
                let whole = deepest < f32::INFINITY;
                self.shapes.push(Candidate { primitive: candidate.primitive, whole, near: 0.0 });
            }
        }
    }

    /// Draws each primitive alone on a block for `cell`; `drawn` gets them in the order of labels.
    pub(super) fn draw_each(
        &self,
        scene: &Scene,
        cell: Cell,
        block: &mut Block,
        mut drawn: impl FnMut(Label, &Block),
    ) {
        block.place(cell);
        let shapes = self.shapes.iter().map(|shape| (shape.primitive, None));
        let parts = self.parts.iter().map(|part| (part.primitive, Some(part)));
        let mut all: Vec<_> = shapes.chain(parts).collect();
        all.sort_by_key(|(primitive, _)| scene.primitives[index(*primitive)].label);
        for (number, part) in all {
            let Primitive { label, shape } = &scene.primitives[index(number)];
            block.clear();
            match (shape, part) {
                (Shape::Polygon(polygon), Some(part)) => {
                    polygon.draw(*label, part, &self.edges, Extent::Whole, block);
                }
                _ => shape.draw(*label, Cover::Part, false, block),
            }
            drawn(*label, block);
        }
    }

    /// Draws all of it on `block`, in the order of labels.
    fn draw(&self, scene: &Scene, block: &mut Block) {
        let (mut shapes, mut parts) = (self.shapes.as_slice(), self.parts.as_slice());
        let label = |primitive: u32| scene.primitives[index(primitive)].label;
        let mut first = self.fills(scene);
        if !first {
            block.clear();
        }
        loop {
            let shape_first = match (shapes, parts) {
                ([], []) => return,
                ([shape, ..], [part, ..]) => label(shape.primitive) <= label(part.primitive),
                (shapes, _) => !shapes.is_empty(),
            };
            if let (true, [candidate, rest @ ..]) = (shape_first, shapes) {
                let cover = if candidate.whole { Cover::Whole } else { Cover::Part };
                let primitive = &scene.primitives[index(candidate.primitive)];
                primitive.shape.draw(primitive.label, cover, first, block);
                shapes = rest;
            } else if let [part, rest @ ..] = parts {
                if let Shape::Polygon(polygon) = &scene.primitives[index(part.primitive)].shape {
                    let extent = if first { Extent::First } else { Extent::Whole };
                    polygon.draw(label(part.primitive), part, &self.edges, extent, block);
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
            (Some(shape), _) => shape.whole && scene.primitives[index(shape.primitive)].shape.fills(),
            (None, Some(part)) => part.edges.is_empty(),
            (None, None) => false,
        }
    }
}

/// Draws cells; owns the memory that takes.
pub(super) struct Painter {
    block: Block,
    mosaic: Mosaic,
    /// The bin of a block.
    bin: Bin,
    /// Bins of the cells on the way down.
    bins: Vec<Bin>,
}

impl Painter {
    pub(super) fn new() -> Self {
        Self { block: Block::new(), mosaic: Mosaic::new(), bin: Bin::default(), bins: Vec::new() }
    }

    /// Draws the cell whose bin is `bin`; `finished` gets it in blocks.
    pub(super) fn paint(&mut self, scene: &Scene, bin: &Bin, cell: Cell, finished: &mut impl FnMut(&Block)) {
        if bin.is_ripe(cell) {
            self.paint_mosaic(scene, bin, cell, finished);
            return;
        }
        for quarter in cell.quarters(LANES) {
            let mut own = self.bins.pop().unwrap_or_default();
            own.narrow(scene, bin, cell, quarter);
            self.paint(scene, &own, quarter, finished);
            self.bins.push(own);
        }
    }

    fn paint_mosaic(&mut self, scene: &Scene, bin: &Bin, cell: Cell, finished: &mut impl FnMut(&Block)) {
        let Self { block, mosaic, bin: own, .. } = self;
        mosaic.draw(
            cell,
            bin.shapes.iter().map(|candidate| &scene.primitives[index(candidate.primitive)].shape),
        );
        for place in mosaic.blocks() {
            own.narrow_to_block(scene, bin, cell, mosaic, place);
            block.place(place.2);
            own.draw(scene, block);
            finished(block);
        }
    }
}

/// An index of a primitive as a `usize`.
pub(super) const fn index(primitive: u32) -> usize {
    primitive as usize
}
