//! Chains: the edges between the same two owners, one after the other, from where boundaries meet
//! to where they meet again.
//!
//! ```text
//!    A    ╱           Most vertices are *joints*: a generator hands over to the next one of its
//!   ●────●───○──╮     owner ○. Only where more than two regions meet, or a boundary ends, is there a
//!    B    ╲     ○     node ●. What closes without a node is a loop.
//! ```

use rayon::prelude::*;

use super::course::COURSE;
use super::{Diagram, Edge, Link, WALL};
use crate::topology::Groups;
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::Sample;

/// Edges in a row between the same two owners.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::voronoi) struct Chain {
    /// The owner on its left.
    pub(in crate::voronoi) left: u32,
    /// The owner on its right.
    pub(in crate::voronoi) right: u32,
    /// Places along it, so dense that chords follow the curves.
    pub(in crate::voronoi) samples: Vec<Sample>,
    /// The vertices at its ends; none for a loop, of which the last sample is the first again.
    pub(in crate::voronoi) ends: Option<[u32; 2]>,
}

impl Diagram {
    /// The chains between different owners: first those between nodes, by their lower vertices,
    /// then the loops.
    pub(in crate::voronoi) fn chains(&self) -> Vec<Chain> {
        let rows = self.rows().into_par_iter();
        rows.map_init(Vec::new, |scratch, (row, is_loop)| self.chain(&row, is_loop, scratch)).collect()
    }

    /// The links of each chain, and whether it is a loop.
    pub(super) fn rows(&self) -> Vec<(Vec<Link>, bool)> {
        let ends = self.ends_by_vertex();
        let joint = |vertex: u32| self.is_joint(ends.of(vertex as usize));
        let mut seen = vec![false; self.edges.len()];
        let mut rows: Vec<(Vec<Link>, bool)> = Vec::new();
        let nodes = (0_u32..).take(ends.len()).filter(|&vertex| !joint(vertex));
        for link in nodes.flat_map(|vertex| ends.of(vertex as usize).iter().copied()) {
            if !seen[link.0 as usize] {
                rows.push((self.row(link, &ends, &mut seen), false));
            }
        }
        for number in (0_u32..).take(self.edges.len()) {
            if !seen[number as usize] && self.is_boundary(&self.edges[number as usize]) {
                rows.push((self.row((number, false), &ends, &mut seen), true));
            }
        }
        rows
    }

    fn is_boundary(&self, edge: &Edge) -> bool {
        self.owner(edge.left) != self.owner(edge.right)
    }

    /// The boundary edges that leave each vertex.
    fn ends_by_vertex(&self) -> Groups<Link> {
        let boundary = (0_u32..).zip(&self.edges).filter(|(_, edge)| self.is_boundary(edge));
        let ends =
            boundary.flat_map(|(number, edge)| [(edge.from, (number, false)), (edge.to, (number, true))]);
        Groups::new(self.vertices.len(), ends)
    }

    /// The vertex that a link leads to.
    pub(super) fn target(&self, (edge, reversed): Link) -> u32 {
        let edge = &self.edges[edge as usize];
        if reversed { edge.from } else { edge.to }
    }

    /// The owners on the left and on the right of a link.
    pub(super) fn sides(&self, (edge, reversed): Link) -> (u32, u32) {
        let Edge { left, right, .. } = self.edges[edge as usize];
        let (left, right) = (self.owner(left), self.owner(right));
        if reversed { (right, left) } else { (left, right) }
    }

    /// Whether what leaves a vertex is one boundary that goes on.
    fn is_joint(&self, leaving: &[Link]) -> bool {
        let [one, other] = leaving else { return false };
        let (left, right) = self.sides(*one);
        one.0 != other.0 && self.sides(*other) == (right, left)
    }

    /// The links from `first` to the next node, or round.
    fn row(&self, first: Link, ends: &Groups<Link>, seen: &mut [bool]) -> Vec<Link> {
        let mut row = vec![first];
        seen[first.0 as usize] = true;
        let mut link = first;
        loop {
            let leaving = ends.of(self.target(link) as usize);
            let next = leaving.iter().find(|next| next.0 != link.0 && !seen[next.0 as usize]);
            match next {
                Some(&next) if self.is_joint(leaving) => {
                    seen[next.0 as usize] = true;
                    row.push(next);
                    link = next;
                }
                _ => return row,
            }
        }
    }

    /// The chain of some links; `samples` is scratch memory.
    fn chain(&self, row: &[Link], is_loop: bool, samples: &mut Vec<Sample>) -> Chain {
        samples.clear();
        for &(number, reversed) in row {
            // Where the last one ended this one begins.
            samples.pop();
            let from = samples.len();
            self.add_samples(&self.edges[number as usize], COURSE, samples);
            if reversed {
                samples[from..].reverse();
            }
        }
        let (left, right) = self.sides(row[0]);
        let (first, last) = (row[0], row[row.len() - 1]);
        let ends = (!is_loop).then(|| [self.target((first.0, !first.1)), self.target(last)]);
        Chain { left, right, samples: samples.clone(), ends }
    }

    /// The owner of the copper nearest to `p`, or that `p` lies in; `nobody` where it is farther
    /// than `level` nanometres from all.
    pub(in crate::voronoi) fn owner_near(&self, p: Spot, level: f64, nobody: u32) -> Option<u32> {
        let (off, owner) = self.nearest_edge(p, f64::INFINITY)?;
        Some(if off <= level || self.is_copper(p) { owner } else { nobody })
    }

    /// How far the nearest edge of copper is, from whichever side, in nanometres.
    pub(in crate::voronoi) fn distance(&self, p: Spot) -> f64 {
        self.distance_within(p, f64::INFINITY)
    }

    /// [`Diagram::distance`], where that is no more than `reach` nanometres.
    pub(in crate::voronoi) fn distance_within(&self, p: Spot, reach: f64) -> f64 {
        self.nearest_edge(p, reach).map_or(f64::INFINITY, |(off, _)| off)
    }

    /// How far copper is, in nanometres; within it zero.
    pub(in crate::voronoi) fn room(&self, p: Spot) -> f64 {
        if self.is_copper(p) { 0.0 } else { self.distance(p) }
    }

    /// How far the nearest edge is, from whichever side, and its owner, if it is no farther than
    /// `reach` nanometres.
    fn nearest_edge(&self, p: Spot, reach: f64) -> Option<(f64, u32)> {
        let mut nearest: Option<(f64, u32)> = None;
        self.index.visit_nearest(p, reach, |i| {
            let found = (self.forms()[i as usize].off(p), i);
            if self.owner(i) != WALL && nearest.is_none_or(|nearest| found < nearest) {
                nearest = Some(found);
            }
            nearest.map_or(reach, |(off, _)| off)
        });
        nearest.map(|(off, generator)| (off, self.owner(generator)))
    }
}
