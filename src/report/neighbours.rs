//! Which nets are neighbours by thinning and which by Voronoi regions, as data and as text.
//!
//! Where four regions nearly meet in a point, the two ways may pair them differently: the boundary
//! of a pair that only one of them has is short there. Longer ones are worth a look.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde::Serialize;

use crate::board::Copper;
use crate::geometry::{Nm, Point};
use crate::raster::{self, Buffers, Label, Scene};
use crate::topology::{self, DisjointSets, NetId, Nets};
use crate::voronoi::{Boundaries, Boundary, Owner};

use super::quantity::{Millimetres, Place};
use super::thinning::Thinning;
use crate::board::diagnostic::count;

/// The neighbours of a layer by both ways.
#[derive(Clone, Debug, Serialize)]
pub struct NeighboursEntry {
    /// The pixel that is thinned.
    pub pixel_mm: Millimetres,
    /// How many pairs of nets are neighbours by both.
    pub common: usize,
    /// Nets that are one by their pixels, and are taken for one.
    pub merged: Vec<Vec<String>>,
    /// Pairs whose regions meet, with no line between them.
    pub only_voronoi: Vec<NeighbourEntry>,
    /// Pairs with a line between them whose regions do not meet.
    pub only_thinning: Vec<NeighbourEntry>,
}

/// Two nets that are neighbours by one of two ways.
#[derive(Clone, Debug, Serialize)]
pub struct NeighbourEntry {
    /// Their names.
    pub between: [String; 2],
    /// How long the boundary between them is, or the line: by its pixels.
    pub boundary_mm: Millimetres,
    /// A place on it.
    pub at: Place,
}

/// Neighbours by the numbers of what they belong to.
type Pairs = BTreeMap<[u32; 2], NeighbourEntry>;

impl NeighboursEntry {
    /// The neighbours among the nets of `copper` that a thinned picture of it and the boundaries of
    /// its regions have.
    #[must_use]
    pub fn new(copper: &Copper, nets: &Nets, thinning: &Thinning, boundaries: &Boundaries) -> Self {
        let faces = thinning.faces();
        let owners = owners(copper, nets, thinning);
        // Each net, and behind them each face: one with what it shares a pixel with.
        let all = u32::try_from(nets.nets().len()).unwrap_or(u32::MAX);
        let mut parts = DisjointSets::new(nets.nets().len() + faces.count() as usize + 1);
        let mut of_face: Vec<Option<NetId>> = vec![None; faces.count() as usize + 1];
        for (&owner, &face) in owners.iter().zip(faces.labels()) {
            if let Some(net) = owner.filter(|_| face != 0) {
                let known = &mut of_face[face as usize];
                *known = Some(known.map_or(net, |known| known.min(net)));
                parts.union(net.0, all + face);
            }
        }
        let ours = by_regions(boundaries, nets, &mut parts);
        let mut theirs = Pairs::new();
        for (pair, meeting) in faces.meetings() {
            let [Some(a), Some(b)] = pair.map(|face| of_face[face as usize]) else { continue };
            let grid = thinning.grid();
            let [column, row] = [meeting.at.0, meeting.at.1].map(|at| i64::try_from(at).unwrap_or(i64::MAX));
            let length = grid.pitch() * i64::try_from(meeting.pixels).unwrap_or(i64::MAX);
            let entry = NeighbourEntry::new([a.min(b), a.max(b)], nets, length, grid.center(column, row));
            put(&mut theirs, &mut parts, [a, b], entry);
        }
        let common = ours.keys().filter(|pair| theirs.contains_key(*pair)).count();
        let alone = |these: &Pairs, others: &Pairs| {
            let mut alone: Vec<NeighbourEntry> = these
                .iter()
                .filter(|(pair, _)| !others.contains_key(*pair))
                .map(|(_, entry)| entry.clone())
                .collect();
            alone.sort_by_key(|entry| std::cmp::Reverse(entry.boundary_mm.0));
            alone
        };
        let mut merged: BTreeMap<u32, Vec<String>> = BTreeMap::new();
        for net in (0..all).map(NetId) {
            merged.entry(parts.find(net.0)).or_default().push(nets.label(net));
        }
        Self {
            pixel_mm: Millimetres(thinning.grid().pitch()),
            common,
            merged: merged.into_values().filter(|names| names.len() > 1).collect(),
            only_voronoi: alone(&ours, &theirs),
            only_thinning: alone(&theirs, &ours),
        }
    }

    /// As a person reads it: the ten longest of each, or all where `verbose`.
    pub(super) fn to_text(&self, verbose: bool) -> String {
        let (regions, thinning) = (&self.only_voronoi, &self.only_thinning);
        let mut text = format!(
            "  neighbours by Voronoi regions and by thinning (pixels of {:.4} mm): {} in common, {} by regions alone, {} by thinning alone\n",
            self.pixel_mm.0,
            count(self.common, "pair"),
            regions.len(),
            thinning.len(),
        );
        for names in &self.merged {
            let _ = writeln!(text, "    one by their pixels: {}", names.join(", "));
        }
        for (alone, what) in [(regions, "regions"), (thinning, "thinning")] {
            let shown = if verbose { alone.len() } else { SHOWN.min(alone.len()) };
            for entry in &alone[..shown] {
                let ([a, b], Place { x_mm, y_mm }) = (&entry.between, entry.at);
                let length = entry.boundary_mm.0;
                let _ = writeln!(
                    text,
                    "    by {what} alone: {a} and {b}, along {length:.3} mm, at {:.3}, {:.3} mm",
                    x_mm.0, y_mm.0
                );
            }
            if alone.len() > shown {
                let _ = writeln!(text, "    and {} more by {what} alone; -v lists them", alone.len() - shown);
            }
        }
        text
    }
}

/// Pairs that are shown unless all are asked for. Chosen.
const SHOWN: usize = 10;

impl NeighbourEntry {
    fn new(pair: [NetId; 2], nets: &Nets, length: Nm, at: Point) -> Self {
        Self { between: pair.map(|net| nets.label(net)), boundary_mm: Millimetres(length), at: at.into() }
    }
}

/// The net of each pixel that is copper in the picture and on the board.
fn owners(copper: &Copper, nets: &Nets, thinning: &Thinning) -> Vec<Option<NetId>> {
    let grid = thinning.grid();
    let mut scene = Scene::new(grid.width(), grid.height());
    for (index, feature) in copper.features.iter().enumerate() {
        if feature.shape.bounds().touches(grid.rect()) {
            scene.add(Label(nets.of(index).0 + 1), topology::surface(&feature.shape, grid, Some(0.0)));
        }
    }
    let mut buffers = Buffers::new();
    raster::render(&scene, &mut buffers);
    let owner =
        |(at, &label): (usize, &u32)| label.checked_sub(1).filter(|_| thinning.is_copper(at)).map(NetId);
    buffers.labels().iter().enumerate().map(owner).collect()
}

/// The pairs of nets whose regions meet.
fn by_regions(boundaries: &Boundaries, nets: &Nets, parts: &mut DisjointSets) -> Pairs {
    let mut longest: Vec<&Boundary> = boundaries.edges.iter().collect();
    longest.sort_by(|a, b| b.path.length().total_cmp(&a.path.length()));
    let mut pairs = Pairs::new();
    for edge in longest {
        if let (Owner::Net(a), Owner::Net(b)) = (edge.left, edge.right) {
            let steps: Vec<_> = edge.path.steps().collect();
            let at = steps.get(steps.len() / 2).map_or(edge.path.start, |(from, segment)| {
                let to = segment.to();
                Point::new((from.x + to.x) / 2, (from.y + to.y) / 2)
            });
            let entry = NeighbourEntry::new([a.min(b), a.max(b)], nets, Nm::from_f64(edge.path.length()), at);
            put(&mut pairs, parts, [a, b], entry);
        }
    }
    pairs
}

/// Adds a boundary between two nets to those of the parts that they belong to.
fn put(pairs: &mut Pairs, parts: &mut DisjointSets, [a, b]: [NetId; 2], entry: NeighbourEntry) {
    let (a, b) = (parts.find(a.0), parts.find(b.0));
    if a == b {
        return;
    }
    let length = entry.boundary_mm.0;
    pairs.entry([a.min(b), a.max(b)]).and_modify(|known| known.boundary_mm.0 += length).or_insert(entry);
}
