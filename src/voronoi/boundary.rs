//! Boundaries from the certified diagram: chains cut at the border, stubs merged, slivers closed,
//! fitted.
//!
//! The graph is the diagram's own: no pixel, no tile and no order of search has a part in it.
//!
//! ```text
//!     ╲ stub ╱            ╲  ╱          A stub is a piece between two nodes that are closer than half the
//!      ●────●      ─▶      ●            fitting tolerance: one node stands for both. Fitting takes the other
//!     ╱      ╲            ╱  ╲          half, so what ends there stays within all of it.
//! ```

use std::collections::BTreeMap;
use std::sync::PoisonError;

use rayon::prelude::*;

use crate::geometry::{Nm, Point};
use crate::topology::NetId;

use super::clip::{Node, Piece};
use super::exact;
use super::fit::{self, Fit};
use super::plane::Spot;
use super::sliver::close_slivers;
use super::{BACKGROUND, Boundaries, Diagram, NOBODY, Owner, Settings};

impl Diagram {
    /// The boundaries before they are cut at the border; none where the diagram contradicts itself.
    /// They take more memory than all else, and are not kept.
    fn chains(&self) -> Option<Vec<exact::Chain>> {
        let Settings { limit, enclosed, .. } = self.settings;
        let known = self.found.lock().unwrap_or_else(PoisonError::into_inner).take();
        let chains = match (known, limit) {
            (Some(chains), _) => chains,
            (None, Some(limit)) => self.certified.limited_chains(limit.to_f64(), NOBODY, enclosed)?,
            (None, None) => self.certified.chains(),
        };
        let level = limit.map_or(f64::INFINITY, Nm::to_f64);
        Some(match &self.band {
            Some(band) => band.around(chains, |p| self.certified.owner_near(p, level, NOBODY)),
            None => chains,
        })
    }

    /// The boundaries of the certified diagram, and where it contradicts itself.
    pub(super) fn certified_boundaries(&self) -> (Boundaries, Vec<Point>) {
        let chains = self.chains();
        let is_whole = chains.is_some();
        let level = self.settings.limit.map_or(f64::INFINITY, Nm::to_f64);
        let (mut pieces, mut torn) = self.on_board(&self.certified, chains.unwrap_or_default(), level);
        if !is_whole {
            torn.push(Spot::from(self.border.window.min()));
        }
        let faults = self.certified.faults().iter().copied().chain(torn.iter().map(|at| at.rounded()));
        let faults = faults.collect();
        let half = self.settings.tolerance.to_f64() / 2.0;
        merge_stubs(&mut pieces, half);
        close_slivers(&mut pieces, half);
        (self.fitted(pieces), faults)
    }

    /// What of chains lies on the board, and what contradicts the border.
    pub(super) fn on_board(
        &self,
        diagram: &exact::Diagram,
        mut chains: Vec<exact::Chain>,
        level: f64,
    ) -> (Vec<Piece>, Vec<Spot>) {
        chains.retain(|chain| ![chain.left, chain.right].contains(&exact::WALL));
        let in_band = |p: Spot| self.band.as_ref().and_then(|band| band.owner_at(p));
        let owner = |p: Spot| in_band(p).or_else(|| diagram.owner_near(p, level, NOBODY));
        super::clip::within(&self.border, chains, owner, |net| match net {
            NOBODY => BACKGROUND,
            net => Owner::Net(NetId(net)).number(),
        })
    }

    /// Pieces fitted, with nodes in the order in which they are met.
    pub(super) fn fitted(&self, pieces: Vec<Piece>) -> Boundaries {
        let Settings { tolerance, arcs, rises, .. } = self.settings;
        let how = Fit { tolerance, arcs, rises };
        // Two nodes that fall on the same nanometre are one, and nothing runs between them.
        let fit = |piece: Piece| {
            let fitted = fit::fit(&piece.samples, how)?;
            Some((fitted, (piece.left, piece.right), piece.ends.is_none()))
        };
        Boundaries::of(pieces.into_par_iter().filter_map(fit).collect())
    }
}

/// Makes one node of the ends of every stub shorter than `size` nanometres.
fn merge_stubs(pieces: &mut Vec<Piece>, size: f64) {
    let mut moved: BTreeMap<Node, (Node, Spot)> = BTreeMap::new();
    pieces.retain(|piece| {
        let Some([from, to]) = piece.ends else { return true };
        let samples = &piece.samples;
        let resolve = |node, at| resolved(&moved, node).unwrap_or((node, at));
        let (here, first) = resolve(from, samples[0].at);
        let (there, last) = resolve(to, samples[samples.len() - 1].at);
        let is_near = |at: Spot| (at - first).length() < size;
        let is_stub = is_near(last) && samples.iter().all(|sample| is_near(sample.at));
        // What leads back to its own node, as the last of three round a speck does, goes as well.
        if is_stub && here != there {
            moved.insert(there, (here, first));
        }
        !is_stub
    });
    for piece in pieces {
        let Some(ends) = &mut piece.ends else { continue };
        let last = piece.samples.len() - 1;
        for (end, sample) in ends.iter_mut().zip([0, last]) {
            if let Some((node, at)) = resolved(&moved, *end) {
                piece.samples[sample].at = at;
                *end = node;
            }
        }
    }
}

/// The node that another was merged into, if it was.
fn resolved(moved: &BTreeMap<Node, (Node, Spot)>, node: Node) -> Option<(Node, Spot)> {
    let mut found = *moved.get(&node)?;
    while let Some(&next) = moved.get(&found.0) {
        found = next;
    }
    Some(found)
}
