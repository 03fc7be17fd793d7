//! The borders between differently owned pixels of one tile, placed.
//!
//! Between two pixels of different owners runs a *crack*, a unit edge between pixel corners. A corner where two
//! cracks meet only passes a boundary on; where three or four meet, regions meet, and the corner is a node. A
//! checkerboard corner (A B / B A) has four cracks and is a node like any other: all four boundaries end there, so
//! neither region is joined or torn by a guess.
//!
//! ```text
//!     A A │ B          A A │ C                  a tile owns the left and upper crack of each of its
//!     ────┘ B          ────┼────                pixels; pieces end at its border and are stitched
//!     C  ...           B B │ C                  at the corners there (see `stitch`)
//!     two cracks:      four cracks:
//!     passed on        a node
//! ```
//!
//! Each piece is placed as it is traced, on the worker that drew the tile: cracks are sampled, moved to the true
//! boundary, and sampled again between wherever the true boundary leaves the chord or its clearance bends. A straight piece costs
//! three samples, whatever its length.

use super::place::{Candidates, Placer, Target, Vertex};
use super::plane::Spot;
use super::{BACKGROUND, OUTSIDE};

/// How far the true boundary may leave the chord between two samples, in nanometres. Chosen: a tenth of the
/// default fitting tolerance, so that fitting has the rest.
pub(super) const CHORD: f64 = 200.0;
/// How far the clearance may leave its interpolation between two samples, in nanometres.
const CLEARANCE_CHORD: f64 = 1_000.0;
/// Samples between two neighbouring cracks are halved at most so often: a kink is met within 1/64 of a pixel.
const HALVINGS: u32 = 6;
/// How many cracks from the end of a piece may have to be passed over. Chosen: twice the leash.
const LOOK_AHEAD: usize = 6;

/// A pixel corner of the picture: its key for stitching, and whether boundaries end there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) column: u32,
    pub(super) row: u32,
    pub(super) node: bool,
}

/// A stretch of boundary within one tile: `vertices[first..first + len]`, both corners' places included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) from: Corner,
    pub(super) to: Corner,
    pub(super) left: u32,
    pub(super) right: u32,
    pub(super) first: u32,
    pub(super) len: u32,
}

/// What a tile adds to the graph.
#[derive(Clone, Debug, Default)]
pub(super) struct Traced {
    pub(super) pieces: Vec<Piece>,
    pub(super) vertices: Vec<Vertex>,
    /// Samples that kept their pixel's place because the true one was not within reach.
    pub(super) unplaced: u32,
}

/// The pixels of a tile as tracing sees them: who owns each, and by which site, two pixels beyond the tile's border.
pub(super) struct Pixels<'a> {
    /// Owner of each pixel, row by row, `width + 4` a row.
    pub(super) owners: &'a [u32],
    /// Label of each pixel, the same shape.
    pub(super) labels: &'a [u32],
    pub(super) width: i32,
    pub(super) height: i32,
    /// The picture's coordinates of the tile's first pixel.
    pub(super) column0: u32,
    pub(super) row0: u32,
}

/// How many pixels beyond the tile tracing looks at.
pub(super) const APRON: u32 = 2;

impl Pixels<'_> {
    #[expect(clippy::cast_sign_loss, reason = "two pixels of apron keep the index positive")]
    fn index(&self, x: i32, y: i32) -> usize {
        ((y + 2) * (self.width + 4) + x + 2) as usize
    }

    fn owner(&self, x: i32, y: i32) -> u32 {
        self.owners[self.index(x, y)]
    }

    fn label(&self, x: i32, y: i32) -> u32 {
        self.labels[self.index(x, y)]
    }
}

/// The four ways from a corner, in the order in which they are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Heading {
    East,
    South,
    West,
    North,
}

const HEADINGS: [Heading; 4] = [Heading::East, Heading::South, Heading::West, Heading::North];

/// A crack as walked: from a corner, in a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Crack {
    x: i32,
    y: i32,
    heading: Heading,
}

impl Crack {
    const fn end(self) -> (i32, i32) {
        match self.heading {
            Heading::East => (self.x + 1, self.y),
            Heading::South => (self.x, self.y + 1),
            Heading::West => (self.x - 1, self.y),
            Heading::North => (self.x, self.y - 1),
        }
    }

    /// The pixels on its left and right.
    const fn sides(self) -> ((i32, i32), (i32, i32)) {
        let (x, y) = (self.x, self.y);
        match self.heading {
            Heading::East => ((x, y - 1), (x, y)),
            Heading::South => ((x, y), (x - 1, y)),
            Heading::West => ((x - 1, y), (x - 1, y - 1)),
            Heading::North => ((x - 1, y - 1), (x, y - 1)),
        }
    }

    /// The pixel that owns it, and whether it is that pixel's left (else upper) crack.
    const fn home(self) -> ((i32, i32), bool) {
        let (x, y) = (self.x, self.y);
        match self.heading {
            Heading::East => ((x, y), false),
            Heading::South => ((x, y), true),
            Heading::West => ((x - 1, y), false),
            Heading::North => ((x, y - 1), true),
        }
    }
}

/// A place to sample: where the pixels have the boundary, and what equation holds there.
#[derive(Clone, Copy)]
struct Anchor {
    at: Spot,
    target: Target,
}

/// What tracing needs to know beside the pixels.
#[derive(Clone, Copy)]
pub(super) struct Course {
    /// The place of the picture's corner (0, 0), in nanometres.
    pub(super) origin: Spot,
    /// The side of a pixel, in nanometres.
    pub(super) pitch: f64,
    /// The distance that bounds regions against the background, in nanometres.
    pub(super) level: f64,
    /// The label of what earlier cuts have cleared.
    pub(super) groove: u32,
    /// Whether only boundaries against the background are wanted.
    pub(super) levels_only: bool,
}

/// Traces one tile.
pub(super) struct Tracer<'a> {
    pixels: Pixels<'a>,
    placer: &'a Placer<'a>,
    course: Course,
    visited: [Vec<bool>; 2],
    traced: Traced,
}

/// All boundary pieces of a tile.
pub(super) fn trace(pixels: Pixels<'_>, placer: &Placer<'_>, course: Course) -> Traced {
    let area = pixels.index(pixels.width, pixels.height);
    let visited = [vec![false; area], vec![false; area]];
    let mut tracer = Tracer { pixels, placer, course, visited, traced: Traced::default() };
    tracer.run();
    tracer.traced
}

impl Tracer<'_> {
    fn run(&mut self) {
        let cracks = self.cracks();
        for &crack in &cracks {
            for end in [(crack.x, crack.y), crack.end()] {
                if self.is_end(end) {
                    self.pieces_from(end);
                }
            }
        }
        for crack in cracks {
            if !self.seen(crack) {
                self.piece(crack);
            }
        }
    }

    /// The left and upper cracks of all pixels, row by row.
    fn cracks(&self) -> Vec<Crack> {
        let mut cracks = Vec::new();
        for y in 0..self.pixels.height {
            let row = |y: i32| {
                &self.pixels.owners[self.pixels.index(-1, y)..self.pixels.index(self.pixels.width, y)]
            };
            let (above, here) = (row(y - 1), row(y));
            if above[1..] == here[1..] && here.windows(2).all(|pair| pair[0] == pair[1]) {
                continue;
            }
            for (x, (pair, &above)) in (0..).zip(here.windows(2).zip(&above[1..])) {
                if pair[1] != pair[0] {
                    cracks.push(Crack { x, y, heading: Heading::South });
                }
                if pair[1] != above {
                    cracks.push(Crack { x, y, heading: Heading::East });
                }
            }
        }
        cracks
    }

    fn is_crack(&self, crack: Crack) -> bool {
        let (left, right) = crack.sides();
        self.pixels.owner(left.0, left.1) != self.pixels.owner(right.0, right.1)
    }

    fn is_ours(&self, crack: Crack) -> bool {
        let ((x, y), _) = crack.home();
        (0..self.pixels.width).contains(&x) && (0..self.pixels.height).contains(&y)
    }

    fn slot(&self, crack: Crack) -> (usize, usize) {
        let ((x, y), left) = crack.home();
        (usize::from(left), self.pixels.index(x, y))
    }

    fn seen(&self, crack: Crack) -> bool {
        let (plane, at) = self.slot(crack);
        self.visited[plane][at]
    }

    fn degree(&self, (x, y): (i32, i32)) -> usize {
        HEADINGS.iter().filter(|&&heading| self.is_crack(Crack { x, y, heading })).count()
    }

    /// Whether pieces end at this corner: on the tile's border, and at nodes.
    fn is_end(&self, (x, y): (i32, i32)) -> bool {
        x == 0 || y == 0 || x == self.pixels.width || y == self.pixels.height || self.degree((x, y)) > 2
    }

    fn pieces_from(&mut self, (x, y): (i32, i32)) {
        for heading in HEADINGS {
            let crack = Crack { x, y, heading };
            if self.is_ours(crack) && self.is_crack(crack) && !self.seen(crack) {
                self.piece(crack);
            }
        }
    }

    /// Follows the boundary from `first` to where it ends or closes, and places it.
    fn piece(&mut self, first: Crack) {
        let mut cracks = vec![first];
        self.mark(first);
        let start = (first.x, first.y);
        let mut at = first.end();
        while at != start && !self.is_end(at) {
            let next = HEADINGS
                .iter()
                .map(|&heading| Crack { x: at.0, y: at.1, heading })
                .find(|&crack| self.is_crack(crack) && !self.seen(crack));
            let Some(next) = next else { break };
            self.mark(next);
            cracks.push(next);
            at = next.end();
        }
        let first_vertex = self.traced.vertices.len();
        let (left, right) = first.sides();
        let (left, right) = (self.pixels.owner(left.0, left.1), self.pixels.owner(right.0, right.1));
        self.place(&cracks, start, at);
        let count = |n: usize| u32::try_from(n).expect("a tile has few vertices");
        let piece = Piece {
            from: self.corner(start),
            to: self.corner(at),
            left,
            right,
            first: count(first_vertex),
            len: count(self.traced.vertices.len() - first_vertex),
        };
        self.traced.pieces.push(piece);
    }

    fn mark(&mut self, crack: Crack) {
        let (plane, at) = self.slot(crack);
        self.visited[plane][at] = true;
    }

    #[expect(clippy::cast_sign_loss, reason = "corners of the tile are not negative")]
    fn corner(&self, at: (i32, i32)) -> Corner {
        Corner {
            column: self.pixels.column0 + at.0 as u32,
            row: self.pixels.row0 + at.1 as u32,
            node: self.degree(at) > 2,
        }
    }

    /// The place of a position in the tile's pixels.
    fn spot(&self, x: f64, y: f64) -> Spot {
        let (column, row) = (f64::from(self.pixels.column0) + x, f64::from(self.pixels.row0) + y);
        let Course { origin, pitch, .. } = self.course;
        Spot::new(origin.x + column * pitch, origin.y - row * pitch)
    }

    /// Writes the vertices of a piece: its first corner, samples along its cracks, its last corner.
    fn place(&mut self, cracks: &[Crack], start: (i32, i32), end: (i32, i32)) {
        let (left, right) = cracks[0].sides();
        let first = self.end_vertex(start);
        let last = if start == end { first } else { self.end_vertex(end) };
        self.traced.vertices.push(first);
        if self.is_wanted(self.pixels.owner(left.0, left.1), self.pixels.owner(right.0, right.1)) {
            let pairs = cracks.iter().map(|crack| {
                let (left, right) = crack.sides();
                (self.pixels.label(left.0, left.1), self.pixels.label(right.0, right.1))
            });
            let run = Run { pairs: pairs.collect(), cracks };
            if self.straight(&run, first, last) {
                self.traced.vertices.push(last);
                return;
            }
            let (head, tail) = (self.short_of(cracks, first), self.short_of_reversed(cracks, last));
            self.halve(&head.1, first, head.2, HALVINGS);
            if head.0 < tail.0 {
                self.traced.vertices.push(head.2);
                self.sample(&run, (head.0, head.2), (tail.0, tail.2));
                self.traced.vertices.push(tail.2);
                self.halve(&tail.1, tail.2, last, HALVINGS);
            }
        } // Nobody cuts along the others: their corners are enough.
        self.traced.vertices.push(last);
    }

    /// Whether one curve bounds the whole piece and its middle lies on the chord of its ends; writes the middle if so.
    fn straight(&mut self, run: &Run<'_>, first: Vertex, last: Vertex) -> bool {
        let count = run.cracks.len();
        if count < 4 || !run.is_one_curve(0, count - 1) {
            return false;
        }
        let anchor = self.anchor(run.cracks[count / 2]);
        let Some(middle) = self.placer.project(&anchor.target, anchor.at) else { return false };
        let way = last.at - first.at;
        let between = (middle.at - first.at).dot(way) > 0.0 && (last.at - middle.at).dot(way) > 0.0;
        let straight = between && is_straight(first, middle, last);
        if straight {
            self.traced.vertices.push(middle);
        }
        straight
    }

    /// Whether anybody cuts along the boundary between two owners.
    const fn is_wanted(&self, left: u32, right: u32) -> bool {
        let bare = left == BACKGROUND || right == BACKGROUND;
        left != OUTSIDE && right != OUTSIDE && (bare || !self.course.levels_only)
    }

    /// The first crack whose place lies ahead of the start of the piece, with its equation and place.
    ///
    /// Near a node a crack may be moved past it, along the continuation of the boundary that the third region cuts off;
    /// going there and back would cut into that region.
    fn short_of(&mut self, cracks: &[Crack], start: Vertex) -> (usize, Target, Vertex) {
        let mut here = self.placed_crack(cracks[0]);
        for (i, &next) in cracks.iter().enumerate().skip(1).take(LOOK_AHEAD) {
            let ahead = self.placed_crack(next);
            if (here.1.at - start.at).dot(ahead.1.at - here.1.at) > 0.0 {
                return (i - 1, here.0, here.1);
            }
            here = ahead;
        }
        (cracks.len().min(LOOK_AHEAD + 1) - 1, here.0, here.1)
    }

    /// The same from the end of the piece.
    fn short_of_reversed(&mut self, cracks: &[Crack], end: Vertex) -> (usize, Target, Vertex) {
        let tail: Vec<Crack> = cracks.iter().rev().take(LOOK_AHEAD + 1).copied().collect();
        let (i, target, vertex) = self.short_of(&tail, end);
        (cracks.len() - 1 - i, target, vertex)
    }

    fn placed_crack(&mut self, crack: Crack) -> (Target, Vertex) {
        let anchor = self.anchor(crack);
        (anchor.target, self.placed(&anchor.target, anchor.at))
    }

    /// Samples between two placed cracks until chords follow the boundary; writes what lies between.
    fn sample(&mut self, run: &Run<'_>, (i, from): (usize, Vertex), (j, to): (usize, Vertex)) {
        if j == i + 1 {
            let (a, b) = (self.anchor(run.cracks[i]), self.anchor(run.cracks[j]));
            self.halve(&a.target.join(&b.target), from, to, HALVINGS);
            return;
        }
        let middle = usize::midpoint(i, j);
        let anchor = self.anchor(run.cracks[middle]);
        let vertex = self.placed(&anchor.target, anchor.at);
        let settled = run.is_one_curve(i, j) && is_straight(from, vertex, to);
        if !settled {
            self.sample(run, (i, from), (middle, vertex));
        }
        self.traced.vertices.push(vertex);
        if !settled {
            self.sample(run, (middle, vertex), (j, to));
        }
    }

    /// Samples between two neighbouring places by halving.
    fn halve(&mut self, target: &Target, from: Vertex, to: Vertex, left: u32) {
        if left == 0 || (to.at - from.at).length() < 4.0 * CHORD {
            return;
        }
        let Some(vertex) = self.placer.project(target, from.at.midpoint(to.at)) else { return };
        if is_straight(from, vertex, to) {
            return;
        }
        // A projection that runs off along the boundary would fold the path back on itself.
        let way = to.at - from.at;
        if (vertex.at - from.at).dot(way) <= 0.0 || (to.at - vertex.at).dot(way) <= 0.0 {
            return;
        }
        self.halve(target, from, vertex, left - 1);
        self.traced.vertices.push(vertex);
        self.halve(target, vertex, to, left - 1);
    }

    fn placed(&mut self, target: &Target, at: Spot) -> Vertex {
        self.placer.project(target, at).unwrap_or_else(|| {
            self.traced.unplaced += 1;
            Vertex { at, clearance: self.placer.clearance(target, at).max(0.0) }
        })
    }

    fn anchor(&self, crack: Crack) -> Anchor {
        let (left, right) = crack.sides();
        let (ex, ey) = crack.end();
        let at = self.spot(f64::from(crack.x + ex) / 2.0, f64::from(crack.y + ey) / 2.0);
        let (x0, x1) = (left.0.min(right.0), left.0.max(right.0));
        let (y0, y1) = (left.1.min(right.1), left.1.max(right.1));
        let owners = (self.pixels.owner(left.0, left.1), self.pixels.owner(right.0, right.1));
        let pair = (self.pixels.label(left.0, left.1), self.pixels.label(right.0, right.1));
        Anchor { at, target: self.target(owners, pair, (x0 - 1, y0 - 1, x1 + 1, y1 + 1)) }
    }

    /// The equation of a boundary between two owners, with the sites seen in a window of pixels.
    fn target(&self, owners: (u32, u32), pair: (u32, u32), window: (i32, i32, i32, i32)) -> Target {
        let (a, b) = (self.candidates(owners.0, pair.0, window), self.candidates(owners.1, pair.1, window));
        match owners {
            (OUTSIDE, _) | (_, OUTSIDE) => Target::OnBorder,
            (BACKGROUND, _) => Target::At(b, self.course.level),
            (_, BACKGROUND) => Target::At(a, self.course.level),
            _ => match (self.flat(a), self.flat(b)) {
                (Some(a), None) => Target::At(a, 0.0),
                (None, Some(b)) => Target::At(b, 0.0),
                _ => Target::Between(a, b),
            },
        }
    }

    /// The labels of an owner in a window of pixels, the given one first.
    fn candidates(&self, owner: u32, label: u32, (x0, y0, x1, y1): (i32, i32, i32, i32)) -> Candidates {
        let mut candidates = Candidates::default();
        if owner <= OUTSIDE {
            return candidates;
        }
        if self.placer.owners[label as usize] == owner {
            candidates.add(label);
        }
        let mut last = label;
        for y in y0..=y1 {
            let row = self.pixels.index(x0, y)..=self.pixels.index(x1, y);
            for &label in &self.pixels.labels[row] {
                if label != last && self.placer.owners[label as usize] == owner {
                    candidates.add(label);
                }
                last = label;
            }
        }
        candidates
    }

    /// Those candidates that are a trace's own copper above the cones, if the first one is.
    fn flat(&self, candidates: Candidates) -> Option<Candidates> {
        let is_flat = |label: u32| self.placer.sites[label as usize].flat;
        let first = *candidates.as_slice().first()?;
        is_flat(first).then(|| {
            let mut flats = Candidates::default();
            candidates
                .as_slice()
                .iter()
                .copied()
                .filter(|&label| is_flat(label))
                .for_each(|label| flats.add(label));
            flats
        })
    }

    /// The place of a piece's end: the same whichever piece, of whichever tile, asks.
    fn end_vertex(&mut self, at: (i32, i32)) -> Vertex {
        let window = (at.0 - 2, at.1 - 2, at.0 + 1, at.1 + 1);
        let spot = self.spot(f64::from(at.0), f64::from(at.1));
        if self.degree(at) > 2 {
            self.node(at, window, spot)
        } else {
            self.placed(&self.passing(at, window), spot)
        }
    }

    /// The equation at a corner that passes a boundary on.
    fn passing(&self, at: (i32, i32), window: (i32, i32, i32, i32)) -> Target {
        let regions = self.around(at);
        let first = regions[0];
        let other = regions.into_iter().find(|r| r.0 != first.0).unwrap_or(first);
        let (a, b) = if first.0 < other.0 { (first, other) } else { (other, first) };
        self.target((a.0, b.0), (a.1, b.1), window)
    }

    /// Owner and label of the four pixels round a corner.
    fn around(&self, (x, y): (i32, i32)) -> [(u32, u32); 4] {
        [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)]
            .map(|(x, y)| (self.pixels.owner(x, y), self.pixels.label(x, y)))
    }

    /// The place where three or more regions meet: equally far from the first three, or on the limit, or on the border.
    fn node(&mut self, at: (i32, i32), window: (i32, i32, i32, i32), spot: Spot) -> Vertex {
        let mut regions = self.around(at).to_vec();
        regions.sort_unstable();
        // A groove has no border to be placed on: what meets there runs on along its own course.
        if regions.iter().any(|region| region.1 != self.course.groove && region.0 != BACKGROUND) {
            regions.retain(|region| region.1 != self.course.groove);
        }
        regions.dedup_by_key(|region| region.0);
        let target = |a: (u32, u32), b: (u32, u32)| self.target((a.0, b.0), (a.1, b.1), window);
        let mut wedge = false;
        let met = match regions.as_slice() {
            [a, b] => self.placer.project(&target(*a, *b), spot),
            [a, b, c, ..] => {
                // Sorted by owner: background and outside come first, so both equations hold with what follows.
                let (first, second) = match a.0 {
                    BACKGROUND | OUTSIDE => {
                        (target(*a, *b), if b.0 == OUTSIDE { target(*a, *c) } else { target(*b, *c) })
                    }
                    _ => (target(*a, *b), target(*a, *c)),
                };
                let met = self.placer.meet(&first, &second, spot);
                // A region that ends in a wedge thinner than a pixel is seen to end too early; its tip is not placed.
                wedge = met.is_none();
                met.or_else(|| self.placer.project(&first, spot))
            }
            _ => None,
        };
        let fallback = target(regions[regions.len() - 1], regions[0]);
        self.traced.unplaced += u32::from(wedge && met.is_some());
        met.unwrap_or_else(|| {
            self.traced.unplaced += 1;
            Vertex { at: spot, clearance: self.placer.clearance(&fallback, spot).max(0.0) }
        })
    }
}

/// The cracks of a piece with the labels on their left and right.
struct Run<'a> {
    cracks: &'a [Crack],
    pairs: Vec<(u32, u32)>,
}

impl Run<'_> {
    /// Whether the same two sites bound the boundary all the way from crack `i` to crack `j`.
    fn is_one_curve(&self, i: usize, j: usize) -> bool {
        self.pairs[i..=j].iter().all(|&pair| pair == self.pairs[i])
    }
}

/// Whether a sample half way lies on the chord, and its clearance on the interpolation.
fn is_straight(from: Vertex, middle: Vertex, to: Vertex) -> bool {
    middle.at.distance_to_chord(from.at, to.at) <= CHORD
        && (middle.clearance - f64::midpoint(from.clearance, to.clearance)).abs() <= CLEARANCE_CHORD
}
