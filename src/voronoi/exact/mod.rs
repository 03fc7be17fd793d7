//! One certified Voronoi diagram of points, segments and arcs: exact vertices, conic edges, and a
//! certificate for each.
//!
//! ```text
//!  ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓             A *generator* is a piece of the edge of copper, with an owner. The *cell* of a generator is what is
//!  ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓             nearer to it than to any other. An *edge* is the border of two cells, part of the bisector of two
//!   ─────●───────               generators: a line, a parabola, a hyperbola or an ellipse. A *vertex* is a place where three or
//!       ╱ ╲   edge              more are equally far: the centre of a circle that touches them and holds none, or a place where
//!  ▓▓▓ ╱   ╲ ▓▓▓▓▓              one generator of an owner hands over to the next.
//! ```
//!
//! # How it is found
//!
//! 1. [`Generators`] are the one-sided edges of the copper, each alike but for its [form]:
//!    lines and circles.
//! 2. *Seeds* are provable places on the graph: one ray for each owner and the sides of the window
//!    (`seed`).
//! 3. From each, the [walk] follows the bisector to the first event: the end of a generator,
//!    or a third one that enters the empty circle. All events are one equation, the problem of
//!    [Apollonius](apollonius), which is solved for what may enter the circles of a [sweep].
//! 4. At an event all generators within a [tie](vertex) of the circle are sorted by the direction
//!    of their feet; an edge leaves between each two neighbours with different owners. Four and
//!    more, the rule on a grid, are nothing special.
//! 5. The [graph] grows until nothing is open, by batches that are followed on all threads, the
//!    same however many there are. An edge must arrive where one leaves; if not, the place is one
//!    of [`Diagram::faults`].
//! 6. [`Diagram::certify`] asks all generators anew whether each circle is empty, at vertices and
//!    along edges; where one is not, the place is a fault, too.
//!
//! # What it guarantees
//!
//! Vertices and edges depend on the generators alone: they are solved from the lowest tied
//! generators whatever the walk came from, and sorted by place at the end. Only `+ − × ÷ √` are
//! used. With [`Kind::Owners`] the graph is complete if every owner's copper is connected.
//! Distances that differ by less than a *tie* are equal; where one tie leaves an end loose, all is
//! walked anew, one edge after the other, then with another tie, and what no tie resolves is a
//! fault, for which [`Diagram`](super::Diagram) leaves chords what they are, or shakes the copper
//! by some nanometres, and walks again. None of the 47 layers of real boards needs that, at six
//! levels each and in both kinds of level sets.
//!
//! Polygons come with slits and with corners that are only rounding: rings that lead in to a hole
//! and out again along themselves (`slit`), and points within a nanometre and a half of the chord
//! between their neighbours. Neither becomes a generator: what they part no distance tells. And
//! what was flattened into chords is an arc again (`rounding`): one generator for a hundred.
//!
//! With [`Kind::MedialAxis`] less is proven: of 1200 random scenes two break a certificate, where
//! an edge steps over an event. What one owner encloses is found from the edges that lie open
//! there. Copper of different owners must not touch.
//!
//! # Level sets
//!
//! Where copper is equally far away, curves run from cell to cell ([`Diagram::level_set`]): the
//! loops of the outline strategy and of regions with a limit, and the passes of wide isolation.
//! They need the edges between one owner's own generators, too, but only above the level
//! ([`Kind::Above`]), and where it is owners that are to be parted not in space that one of them
//! alone encloses ([`Kind::Between`]).
//!
//! # Sources
//!
//! M. Held, *On the Computational Geometry of Pocket Machining*, LNCS 500, Springer 1991
//! (wavefronts and bisectors as conics by clearance). A. Okabe, B. Boots, K. Sugihara, S. N. Chiu,
//! *Spatial Tessellations*, 2nd ed., Wiley 2000, ch. 3 (line and area Voronoi diagrams). K. E. Hoff
//! et al., *Fast Computation of Generalized Voronoi Diagrams Using Graphics Hardware*, SIGGRAPH
//! 1999 (cells as lower envelopes of distance surfaces). Apollonius of Perga, *Tangencies*, after
//! Pappus (circles that touch three given ones).

mod apollonius;
mod axis;
mod breaks;
mod certify;
mod chain;
mod course;
mod enclosed;
mod exposed;
mod form;
mod generator;
mod graph;
mod index;
mod level;
mod pair;
mod parallel;
mod rounding;
mod seed;
mod slit;
mod sweep;
mod tolerances;
mod vertex;
mod walk;
mod weld;

use std::sync::OnceLock;

use crate::geometry::{BoxTree, Nm, Point, Rect};
use crate::topology::Groups;
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::Sample;

use breaks::{Breaks, breaks};
use form::Form;
use index::Index;
use tolerances::WRONG;
use vertex::TIES;

pub use certify::Violation;
pub use generator::Generators;
pub use level::LevelCurve;

pub(super) use axis::OnAxis;
pub(super) use chain::Chain;
pub(super) use enclosed::Above;
pub(super) use weld::NEAR;

/// The number of no generator.
const NOBODY: u32 = u32::MAX;

/// The owner of a wall round everything.
pub(super) const WALL: u32 = u32::MAX - 1;

/// Which edges a diagram has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Those between different owners.
    Owners,
    /// All: the medial axis of the free space.
    MedialAxis,
    /// All, but those of one owner only where copper is farther away than this: what level sets
    /// need. Where copper of one owner leaves slits, nothing is walked.
    Above(Nm),
    /// The same, without the space that one owner alone encloses: what parts owners.
    Between(Nm),
}

/// Where the space is free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Outside the generators, up to a window that is so much larger than they are on all sides.
    Around(Nm),
    /// Outside the generators, within a rectangle and all round them.
    Window(Rect),
    /// Within what [`Generators::inside`] and [`Generators::wall`] enclose, and outside all else.
    Within,
}

/// A place where edges meet or end.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertex {
    /// Where it is, in nanometres.
    pub at: (f64, f64),
    /// The radius of the empty circle round it, in nanometres.
    pub clearance: f64,
    /// The generators that touch the circle, ascending.
    pub tied: Vec<u32>,
}

/// The bisector of two generators between two vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edge {
    /// The vertex it begins at.
    pub from: u32,
    /// The vertex it ends at.
    pub to: u32,
    /// The generator on its left.
    pub left: u32,
    /// The generator on its right.
    pub right: u32,
}

/// The Voronoi diagram of generators.
pub struct Diagram {
    generators: Generators,
    index: Index,
    /// Empty when all edges are known.
    breaks: Breaks,
    /// The bodies of copper by place, once they are asked for.
    bodies: OnceLock<BoxTree>,
    kind: Kind,
    /// Distances that differ by less are equal, in nanometres.
    tie: f64,
    /// Left, bottom, right, top.
    window: [f64; 4],
    vertices: Vec<Vertex>,
    edges: Vec<Edge>,
    /// What leaves each vertex, counter-clockwise.
    leaving: Groups<Link>,
    /// Of each edge that a level set was asked for, where its clearance turns.
    stretches: OnceLock<Vec<OnceLock<Vec<Sample>>>>,
    faults: Vec<Point>,
}

/// An edge, and whether it is followed from its end to its beginning.
type Link = (u32, bool);

impl Diagram {
    /// The diagram of `generators`.
    #[must_use]
    pub fn new(generators: Generators, kind: Kind, space: Space) -> Self {
        let mut diagram = Self::unwalked(generators, kind, space);
        if !diagram.has_edges() {
            return diagram;
        }
        for tie in TIES {
            diagram.breaks = breaks(&diagram.generators, &diagram.index, tie);
            diagram.tie = tie;
            if AT_ONCE.into_iter().any(|at_once| diagram.walk_certified(space, at_once)) {
                break;
            }
        }
        diagram.breaks = Breaks::default();
        diagram
    }

    /// Walks it, and says whether it has no fault.
    fn walk_certified(&mut self, space: Space, at_once: usize) -> bool {
        self.walk_all(space, at_once);
        if self.faults.is_empty() {
            let wrong = self.certify(CLOSE).into_iter().filter(|found| found.by > WRONG);
            self.faults = wrong.map(|found| found.at).collect();
        }
        self.faults.is_empty()
    }

    /// The diagram before any edge is known.
    fn unwalked(generators: Generators, kind: Kind, space: Space) -> Self {
        let generators = generators.finished();
        let index = Index::new(&generators);
        let margin = match space {
            Space::Around(margin) => margin.to_f64(),
            Space::Window(_) | Space::Within => BEYOND,
        };
        let [left, bottom, right, top] = index.bounds();
        let mut window = [left - margin, bottom - margin, right + margin, top + margin];
        if let Space::Window(rect) = space {
            let [low, high] = [rect.min(), rect.max()].map(Spot::from);
            let [left, bottom, right, top] = window;
            window = [left.min(low.x), bottom.min(low.y), right.max(high.x), top.max(high.y)];
        }
        Self {
            generators,
            index,
            breaks: Breaks::default(),
            bodies: OnceLock::new(),
            kind,
            tie: TIES[0],
            window,
            vertices: Vec::new(),
            edges: Vec::new(),
            leaving: Groups::default(),
            stretches: OnceLock::new(),
            faults: Vec::new(),
        }
    }

    /// Whether it can have edges: nothing parts one owner from itself.
    fn has_edges(&self) -> bool {
        let owners = &self.generators.owners;
        !owners.is_empty() && (self.kind != Kind::Owners || owners.iter().any(|&owner| owner != owners[0]))
    }

    /// The vertices, by place.
    #[must_use]
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// The edges, by their vertices.
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Where an edge could not be followed to its end, or ended where no other begins, or copper
    /// lies in a circle: none, unless the program is at fault.
    #[must_use]
    pub fn faults(&self) -> &[Point] {
        &self.faults
    }

    /// The owner of a generator.
    #[must_use]
    pub fn owner(&self, generator: u32) -> u32 {
        self.generators.owners[generator as usize]
    }

    fn forms(&self) -> &[Form] {
        &self.generators.forms
    }

    /// Whether `p` lies within the window, but for a little.
    fn holds(&self, p: Spot) -> bool {
        let [left, bottom, right, top] = self.window;
        (left - BEYOND..=right + BEYOND).contains(&p.x) && (bottom - BEYOND..=top + BEYOND).contains(&p.y)
    }
}

/// At places so close together edges are asked, in nanometres. Chosen: narrower pads are rare.
const CLOSE: f64 = 250_000.0;

/// So many edges are followed at a time: where distances are all but equal, both ends of one may
/// lead to different places, which does not show when they are followed one after the other. Of
/// 3000 scenes of tracks whose lines and arcs end fractions of a nanometre apart 36 have a fault
/// with the first, and 6 with the second.
const AT_ONCE: [usize; 2] = [64, 1];

/// Edges end so far beyond the window that its sides can be walked, in nanometres. Chosen.
const BEYOND: f64 = 1_000.0;
