//! What bounds the copper that is left, exactly: the ways of the cutter with half the kerf round
//! them, and the board's edge.
//!
//! The kerf is that at the copper's bottom. What a V-bit leaves between two cuts is wider there
//! than at the surface: that width holds a strip to the board, and conducts.

use crate::board::Shape;
use crate::geometry::{Nm, Point, Polygon, Vector};
use crate::topology::{Near, Proximity};

use super::cut::Cut;
use super::machining::Swept;

/// Cuts and the board's edge, to be asked what is near.
pub(super) struct Walls<'a> {
    /// The axes of all cuts, then the edges of the outline.
    near: Proximity,
    cuts: Vec<&'a Swept>,
    edges: Vec<Shape>,
    widest: Nm,
}

/// A wall near a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wall {
    /// Below the number of cuts, the cut; else the edge.
    pub(super) index: usize,
    /// How far its face is, in nanometres; negative within the kerf.
    pub(super) distance: f64,
    /// The point of its axis nearest to the place.
    pub(super) foot: Point,
}

/// A place where what is left between two walls is narrowest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neck {
    pub(super) at: Point,
    /// From face to face in nanometres; not above zero where the walls meet.
    pub(super) width: f64,
}

/// Steps towards the narrowest place. Chosen: two are enough for straight walls, the rest are for
/// corners.
const STEPS: usize = 5;

impl<'a> Walls<'a> {
    pub(super) fn new(cuts: &[Cut<'a>], outline: Option<&Polygon>) -> Self {
        let edges = outline.into_iter().flat_map(Polygon::edges).filter(|(from, to)| from != to);
        let edges: Vec<Shape> =
            edges.map(|(from, to)| Shape::Stroke { from, to, radius: Nm::ZERO }).collect();
        // Nothing to spare, and let go as soon as all are by place: there are many.
        let mut axes = Vec::with_capacity(cuts.len() + edges.len());
        axes.extend(cuts.iter().map(|cut| cut.swept.axis()));
        axes.extend(edges.iter().cloned());
        let cuts: Vec<&Swept> = cuts.iter().map(|cut| cut.swept).collect();
        let widest = cuts.iter().map(|cut| cut.floor).max().unwrap_or(Nm::ZERO);
        Self { near: Proximity::of(&axes), cuts, edges, widest }
    }

    /// The axis of a wall.
    fn axis(&self, index: usize) -> Shape {
        self.cuts.get(index).map_or_else(|| self.edges[index - self.cuts.len()].clone(), |cut| cut.axis())
    }

    /// Half its kerf, at the copper's bottom.
    fn half(&self, index: usize) -> Nm {
        self.cuts.get(index).map_or(Nm::ZERO, |cut| cut.floor)
    }

    /// The walls whose faces are within `reach` of `p`, the nearest first.
    pub(super) fn around(&self, p: Point, reach: Nm) -> Vec<Wall> {
        self.around_of(p, reach, |_| true)
    }

    /// The same of those that are `wanted`.
    pub(super) fn around_of(&self, p: Point, reach: Nm, wanted: impl Fn(usize) -> bool) -> Vec<Wall> {
        let spot = Shape::Disc { center: p, radius: Nm::ZERO };
        let near = self.near.near_of(&spot, self.widest + reach, wanted);
        let walls = near.iter().map(|near| self.wall(p, near));
        let mut walls: Vec<Wall> = walls.filter(|wall| wall.distance <= reach.to_f64()).collect();
        walls.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.index.cmp(&b.index)));
        walls
    }

    /// The point of a wall's axis nearest to a place within its kerf.
    pub(super) fn foot(&self, index: usize, p: Point) -> Point {
        self.one(index, p, Nm::ZERO).map_or(p, |wall| wall.foot)
    }

    /// A wall, where its face is within `reach` of `p`.
    pub(super) fn one(&self, index: usize, p: Point, reach: Nm) -> Option<Wall> {
        let spot = Shape::Disc { center: p, radius: Nm::ZERO };
        let near = self.near.near_one(&spot, self.widest + reach, index)?;
        Some(self.wall(p, &near)).filter(|wall| wall.distance <= reach.to_f64())
    }

    /// Whether a wall whose face is within `reach` of `p`, of the first `count`, is `wanted`.
    pub(super) fn any(&self, p: Point, reach: Nm, count: usize, wanted: impl Fn(&Wall) -> bool) -> bool {
        let spot = Shape::Disc { center: p, radius: Nm::ZERO };
        self.near.any(
            &spot,
            self.widest + reach,
            |wall| wall < count,
            |near| {
                let wall = self.wall(p, near);
                wall.distance <= reach.to_f64() && wanted(&wall)
            },
        )
    }

    /// How many ways, stretches of long ones each, may come within `reach` of that of wall `index`;
    /// counts no further than `most`.
    pub(super) fn count(&self, index: usize, reach: Nm, most: usize) -> usize {
        self.near.count(&self.axis(index), self.half(index) + self.widest + reach, most)
    }

    /// Whether so many ways, stretches of long ones each, may come within `reach` of that of wall
    /// `index`, or of one stretch of it.
    pub(super) fn is_crowded(&self, index: usize, reach: Nm, most: usize) -> bool {
        self.near.is_crowded(&self.axis(index), self.half(index) + self.widest + reach, most)
    }

    /// The indices of all walls, neighbours close to each other.
    pub(super) fn order(&self) -> Vec<usize> {
        self.near.order()
    }

    fn wall(&self, p: Point, near: &Near) -> Wall {
        Wall {
            index: near.feature,
            distance: near.width - self.half(near.feature).to_f64(),
            foot: near.at + (near.at - p),
        }
    }

    /// The walls that are `wanted` and whose faces come within `reach` of that of wall `index`:
    /// which, how far, and the middle between the axes.
    pub(super) fn beside(
        &self,
        index: usize,
        reach: Nm,
        wanted: impl Fn(usize) -> bool,
    ) -> Vec<(usize, Neck)> {
        let own = self.half(index);
        let near = self.near.near_of(&self.axis(index), own + self.widest + reach, wanted);
        let gap = |near: Near| {
            let width = near.width - (own + self.half(near.feature)).to_f64();
            (near.feature, Neck { at: near.at, width })
        };
        near.into_iter().map(gap).filter(|(_, neck)| neck.width <= reach.to_f64()).collect()
    }

    /// The neck at `p`, give or take `room`, between walls on both sides of it whose faces are
    /// within `reach`; none where there is a wall on no more than one side.
    ///
    /// From the nearest wall and the nearest one across it goes to where these two are nearest to
    /// each other, and looks again.
    pub(super) fn neck(&self, p: Point, reach: Nm, room: Nm) -> Option<Neck> {
        let mut best = self.across(p, reach)?.1;
        let mut at = p;
        for _ in 0..STEPS {
            let Some(((one, other), here)) = self.across(at, reach) else { break };
            if here.width < best.width {
                best = here;
            }
            let facing = self.beside(one, reach + reach, |wall| wall == other).pop();
            // Two ways that meet elsewhere say nothing about this place.
            let Some((_, neck)) = facing.filter(|(_, neck)| neck.at.distance(p) <= room.to_f64()) else {
                break;
            };
            if neck.width < best.width {
                best = neck;
            }
            if neck.at == at {
                break;
            }
            at = neck.at;
        }
        Some(best)
    }

    /// The nearest wall, the nearest on the other side of `p`, and how wide it is between them
    /// there.
    fn across(&self, p: Point, reach: Nm) -> Option<((usize, usize), Neck)> {
        let walls = self.around(p, reach);
        let first = walls.first()?;
        let way = first.foot - p;
        let other = walls.iter().find(|wall| Vector::dot(wall.foot - p, way) < 0)?;
        Some(((first.index, other.index), Neck { at: p, width: first.distance + other.distance }))
    }
}
