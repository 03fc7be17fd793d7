//! Loops round some nets, boundaries midway between the others: the paper's "Voronoi regions for
//! only a subset of traces" (§V).
//!
//! A net with a loop takes no more room than that, and the others share what is left as if it were
//! a hole in the board:
//!
//! ```text
//!       region of B                 ━ the loop of A: what it parts, it parts for both sides
//!    ╭━━━━━━━━━━╮                   ─ the boundary of B and C, from loop to loop
//!    ┃ ▓▓ A ▓▓  ┣───────────
//!    ╰━━━━━━━━━━╯                   Where B is nearer to A than two radii, the loop runs midway.
//!       region of C
//! ```
//!
//! First all nets are gone round. The loops of those that are to have one cut what remains of the
//! board into fields; each field has a diagram of the nets that lie in it, so that nothing is
//! parted where a loop has parted it already: a field with one net has no boundary. The ends of
//! the fields' boundaries become junctions of the loops.

use std::collections::BTreeMap;

use crate::board::{Copper, Outline, Shape, polarity};
use crate::geometry::{Edges, Nm, Path, Point, Polygon, RectIndex};
use crate::topology::{NetId, Nets};

use super::edge::Border;
use super::junction::Junctions;
use super::part::foot;
use super::plane::Spot;
use super::regions::{Parts, has_loop};
use super::{Boundaries, Boundary, Diagram, Error, Owner, Settings, SiteKind};

/// Which nets have a loop of their own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Loops {
    /// The nets.
    pub nets: Vec<NetId>,
    /// How far from their copper the loops run.
    pub radius: Nm,
}

/// What a diagram with loops knows beside the one in which every net has one.
pub(super) struct Mixed {
    looped: Vec<bool>,
    loops: Boundaries,
    /// What is left of the board, piece by piece.
    fields: Vec<Diagram>,
}

/// A boundary that ends so near to a loop ends on it. Chosen: many times what the border of a field
/// may leave the loops, and less than any kerf.
const LEASH: Nm = Nm::from_um(38);

/// How far the border of a field may leave the loops: its boundaries are led on to the loops
/// themselves. Chosen: far below any kerf, and few corners.
const FLAT: Nm = Nm::from_um(2);

impl Diagram {
    /// The diagram of all nets but those that have a loop, and these.
    ///
    /// # Errors
    ///
    /// As for [`Diagram::new`].
    pub fn mixed(
        copper: &Copper,
        nets: &Nets,
        outline: Option<&Outline>,
        settings: &Settings,
        loops: &Loops,
    ) -> Result<Self, Error> {
        let round = Settings { sites: SiteKind::Copper, limit: Some(loops.radius), ..settings.clone() };
        let mut all = Self::new(copper, nets, outline, &round)?;
        let mut cut = all.boundaries()?;
        let mut looped = vec![false; nets.nets().len()];
        loops.nets.iter().for_each(|net| looped[net.index()] = true);
        cut.edges.retain(|edge| has_loop(&looped, edge.left) || has_loop(&looped, edge.right));
        let fields = fields(&all, &cut, &looped, copper, nets, settings)?;
        all.mixed = Some(Box::new(Mixed { looped, loops: cut, fields }));
        Ok(all)
    }
}

impl Mixed {
    /// Whether `owner` is a net with a loop.
    pub(super) fn has_loop(&self, owner: Owner) -> bool {
        has_loop(&self.looped, owner)
    }

    /// The loops with the boundaries of all fields.
    pub(super) fn boundaries(&self, all: &Diagram) -> Result<Boundaries, Error> {
        let clearance = |p: Point| Nm::from_f64(all.certified.distance(p.into()));
        let leash = LEASH.to_f64();
        let in_frame =
            |edge: &Boundary| all.frame().is_some_and(|frame| foot(frame, middle(edge)).2 <= leash);
        let mut junctions = Junctions::new(self.loops.clone(), leash);
        for field in &self.fields {
            junctions.add(field.boundaries()?, |edge| !edge.is_border() || in_frame(edge), clearance);
        }
        Ok(junctions.finish())
    }

    /// What pictures are drawn from.
    pub(super) fn parts(&self) -> Parts {
        Parts { looped: self.looped.clone(), fields: self.fields.iter().map(Diagram::regions).collect() }
    }
}

/// A point of a boundary between its ends.
fn middle(edge: &Boundary) -> Spot {
    let path = &edge.path;
    match path.segments.len() {
        0 | 1 => path.start.midpoint(path.end()).into(),
        count => path.segments[count / 2 - 1].to().into(),
    }
}

/// The diagrams of the pieces into which `loops` cut the board, each of the nets that lie in it;
/// pieces without a net have none.
fn fields(
    all: &Diagram,
    loops: &Boundaries,
    looped: &[bool],
    copper: &Copper,
    nets: &Nets,
    settings: &Settings,
) -> Result<Vec<Diagram>, Error> {
    let pieces: Vec<Polygon> = pieces(all, &gone_round(loops, looped));
    let edges: Vec<Edges> = pieces.iter().map(Edges::new).collect();
    let near = RectIndex::new(edges.iter().map(Edges::bounds));
    let lies_in = |shape: &Shape, piece: usize| {
        if edges[piece].any(shape.bounds(), |_| true) {
            shape.lies_in(&pieces[piece])
        } else {
            // All of it lies on one side.
            edges[piece].contains(shape.bounds().min())
        }
    };
    // A net that goes on beyond a loop lies in several.
    let homes = |(net, looped): (&crate::topology::Net, &bool)| {
        let mut homes: Vec<usize> = Vec::new();
        for &feature in net.features.iter().filter(|_| !looped) {
            let shape = &copper.features[feature as usize].shape;
            let others = near.touching(shape.bounds()).into_iter().filter(|&piece| lies_in(shape, piece));
            homes.extend(others.filter(|piece| !homes.contains(piece)).collect::<Vec<_>>());
        }
        homes
    };
    let homes: Vec<Vec<usize>> = nets.nets().iter().zip(looped).map(homes).collect();
    let mut is_inhabited = vec![false; pieces.len()];
    homes.iter().flatten().for_each(|&piece| is_inhabited[piece] = true);
    let inhabited = pieces.into_iter().enumerate().filter(|(piece, _)| is_inhabited[*piece]);
    let field = |(piece, polygon): (usize, Polygon)| {
        let Border { window, ref frame, clearance, .. } = all.border;
        let border = Border::round(vec![polygon], window, frame.clone(), clearance);
        let kept = homes.iter().map(|homes| homes.contains(&piece)).collect();
        // Passes are those of the diagram in which every net has a loop.
        let settings = Settings { passes: None, ..settings.clone() };
        Diagram::within(border, copper, nets, &settings, kept)
    };
    inhabited.map(field).collect()
}

/// What the board is without `taken`.
///
/// Along an outline loops are cut a little beside it, and a strip may remain: whatever is
/// narrower than twice the leash is none.
fn pieces(all: &Diagram, taken: &[Polygon]) -> Vec<Polygon> {
    let left = all.border.inside.iter().flat_map(|board| polarity::difference(board, taken));
    if all.border.frame.is_some() {
        return left.collect();
    }
    let strip = LEASH.min(all.settings.limit.unwrap_or(Nm::MAX) / 2);
    let shrunk = left.flat_map(|piece| polarity::offset(&piece, -strip, FLAT));
    shrunk.flat_map(|piece| polarity::offset(&piece, strip, FLAT)).collect()
}

/// What the loops go round.
fn gone_round(loops: &Boundaries, looped: &[bool]) -> Vec<Polygon> {
    let mut contours = Vec::new();
    // By where they begin; each has the looped side on its left, so as many begin at a point as end
    // there.
    let mut open: BTreeMap<Point, Vec<Vec<Point>>> = BTreeMap::new();
    for edge in &loops.edges {
        let way = match (has_loop(looped, edge.left), has_loop(looped, edge.right)) {
            (true, false) => edge.path.flatten(FLAT),
            (false, true) => Path::reversed(&edge.path).flatten(FLAT),
            (true, true) | (false, false) => continue,
        };
        if way.first() == way.last() {
            contours.push(way);
        } else {
            open.entry(way[0]).or_default().push(way);
        }
    }
    while let Some((_, mut ways)) = open.pop_first() {
        let Some(mut contour) = ways.pop() else { continue };
        if !ways.is_empty() {
            open.insert(contour[0], ways);
        }
        while contour.first() != contour.last() {
            let next = contour.last().and_then(|end| open.get_mut(end)).and_then(Vec::pop);
            let Some(next) = next else { break };
            contour.extend_from_slice(&next[1..]);
        }
        contours.push(contour);
    }
    polarity::clean(&contours)
}
