//! Nets → Voronoi regions → a planar graph of boundaries → smooth exact paths.

use crate::geometry::{Nm, Path, Point};
use crate::topology::NetId;

/// What lies on one side of a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Owner {
    /// The region of a net.
    Net(NetId),
    /// Nothing within the limit.
    Background,
    /// Beyond the board's edge or the frame.
    Outside,
}

/// A node of the boundary graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u32);

/// An edge of the boundary graph, to be cut once.
#[derive(Clone, Debug)]
pub struct Boundary {
    /// The way, from node to node (or closed).
    pub path: Path,
    /// The distance to the nearest copper at each vertex of `path`: the start, then the end of each segment.
    /// Between vertices it is never less than the smaller of the two ends by more than the fitting tolerance.
    pub clearance: Vec<Nm>,
    /// The region on its left.
    pub left: Owner,
    /// The region on its right.
    pub right: Owner,
    /// The nodes it begins and ends at; none for a loop without a node.
    pub ends: Option<(NodeId, NodeId)>,
}

/// The boundaries of one layer as a planar graph.
///
/// # Guarantees
///
/// A boundary begins and ends exactly at the points of its nodes; nodes and boundaries are in a fixed order that
/// depends on the board and the settings alone.
#[derive(Clone, Debug, Default)]
pub struct Boundaries {
    /// Where boundaries meet or end.
    pub nodes: Vec<Point>,
    /// The edges.
    pub edges: Vec<Boundary>,
}
