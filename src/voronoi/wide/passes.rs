//! Further passes beside the first cut: level sets of the clearance.
//!
//! ```text
//!   copper │←─ width ─→│                  each pass runs at one distance from copper, on both sides of the
//!   ▓▓▓▓▓▓▓│ 1   2   3 │   ·   3   2   1  │▓▓▓▓▓    boundary, from where the kerf just misses copper outwards,
//!          ╰─kerf─╯    boundary                     as far as there is room
//! ```
//!
//! The level sets are those of the certified diagram. Where a pass would run nearer to the first
//! cut than passes overlap it clears nothing that its neighbours do not, and is left out
//! ([`super::groove`]); and what lies between two passes that do run is never wider than a kerf, so
//! one more cut clears it ([`super::residual`]). Passes need not mind each other: a step apart in
//! their distance from copper, they are no nearer anywhere.

use rayon::prelude::*;

use crate::board::diagnostic::planning;
use crate::board::{Copper, Warning};
use crate::geometry::{Nm, Point};
use crate::topology::{NetId, Nets};
use crate::voronoi::clip::{Fence, Piece};
use crate::voronoi::{Boundaries, Boundary, Diagram, FLOOR, NOBODY, NodeId, Owner, Share, SiteKind};
use crate::voronoi::{exact, walked};

use super::clearing::{Clearing, Room, Zone};
use super::groove::Grooves;
use super::link::Rules;
use super::residual::Passes;
use super::spike::Spikes;

/// Links are no longer. Chosen: there and back they cost as much as a retract.
const LONGEST: Nm = Nm::from_mm(3);

/// Between the innermost pass and copper no other clears: it is left out only where it would run so
/// near to the first cut. Chosen: what stays beside copper is thinner than a mill is true.
const BESIDE: Nm = Nm::from_um(10);

/// How the gap beside copper is widened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Widening {
    /// How wide the cutter clears, at the surface.
    pub kerf: Nm,
    /// How wide at the bottom of the copper, where a V-bit is narrower: what is left there between
    /// passes is a strip of copper.
    pub floor: Nm,
    /// How wide the gap beside every net is to be, where there is room; none for as wide as one
    /// cut.
    pub width: Option<Nm>,
    /// How much of the kerf neighbouring passes share, at least.
    pub overlap: Nm,
    /// Whether gaps between nets that the kerf does not fit stay uncut.
    pub skips: bool,
}

impl Widening {
    /// How far from copper the nearest pass runs, and the farthest of those that make the gap wide,
    /// so that fitting them to a `tolerance` leaves the copper alone.
    #[must_use]
    pub fn distances(&self, tolerance: Nm) -> [Nm; 2] {
        let first = self.kerf / 2 + tolerance;
        [first, self.width.map_or(first, |width| first.max(width - self.kerf / 2))]
    }

    /// The distances from copper at which these run, from the nearest to the farthest, evenly
    /// spaced; none of more than `most`.
    fn levels(&self, [first, last]: [Nm; 2], most: Nm) -> Vec<Nm> {
        if self.width.is_none() {
            return Vec::new();
        }
        let gaps = (last - first + self.advance() - Nm::new(1)).get() / self.advance().get();
        (0..=gaps)
            .map(|i| first + (last - first) * i / gaps.max(1))
            .take_while(|&level| level <= most)
            .collect()
    }

    /// Those farther out: `next`, and what follows on it.
    fn further(&self, next: Nm, most: Nm) -> Vec<Nm> {
        std::iter::successors(Some(next), |&level| {
            Some(level + self.advance()).filter(|&level| level <= most)
        })
        .collect()
    }

    /// How far passes are apart at most.
    fn advance(&self) -> Nm {
        (self.kerf - self.overlap).max(Nm::new(1))
    }
}

impl Diagram {
    /// `base` with further passes beside its cuts, until the gap beside every net is as wide as
    /// asked for, and all is cleared where `clearing` says so. `before` is what wider tools have
    /// cut, each with its kerf: nothing of that is cut again.
    ///
    /// A pass never runs nearer to copper than half the kerf and the fitting tolerance. What `base`
    /// has at that distance already (the outline strategy's loops) is not cut again. With it comes
    /// what could not be placed.
    #[must_use]
    pub fn widened(
        &self,
        (copper, nets): (&Copper, &Nets),
        base: Boundaries,
        widening: &Widening,
        clearing: &Clearing,
        before: &[Share<'_>],
    ) -> (Boundaries, Vec<Warning>) {
        let distances @ [first, _] = widening.distances(self.settings.tolerance);
        let most = self.farthest(widening.advance()) + widening.advance() * 2 + widening.kerf;
        let levels = widening.levels(distances, most);
        let next = levels.last().map_or(first, |&last| last + widening.advance());
        let further = if clearing.is_wanted() { widening.further(next, most) } else { Vec::new() };
        // What is to be cleared may be space that one net encloses, where passes did not run.
        let again: &[Nm] = if further.is_empty() || self.settings.enclosed { &[] } else { &levels };
        // Where all is cleared, passes farther out lie a whole advance apart: what any leave is
        // judged by that.
        let near = levels.get(1).filter(|_| further.is_empty());
        let step = near.map_or(widening.advance(), |&second| second - levels[0]);
        // Loops at the first level are passes themselves.
        let is_pass = |edge: &Boundary| self.settings.limit == Some(first) && edge.is_bare();
        let unlooped = |levels: &[Nm]| -> Vec<Nm> {
            levels.iter().copied().filter(|&level| !self.has_loops_of_all_at(level)).collect()
        };
        // Loops, too, did not run there.
        let all_around = if self.settings.enclosed { unlooped(&further) } else { further.clone() };
        let wanted = [unlooped(&levels), again.to_vec(), all_around];
        if wanted.iter().all(Vec::is_empty) {
            return (base, Vec::new());
        }
        let farthest = levels.iter().chain(&further).copied().max().unwrap_or(first);
        let wall = walked::wall(self.copper, farthest);
        let floor = FLOOR.min(first / 2);
        let kind = if further.is_empty() { self.settings.kind(floor) } else { exact::Kind::Above(floor) };
        let zone = Zone::new(clearing, widening.kerf);
        let lines = |diagram: &exact::Diagram| {
            // What the cutter reaches from where nets are parted is cleared, whoever is round it.
            let open = (!self.settings.enclosed).then(|| diagram.above(first.to_f64()));
            let pieces = |(stage, &level): (usize, &Nm)| {
                let found = self.level_pieces(diagram, level, open.as_ref().filter(|_| stage == 0))?;
                Some(if stage > 0 { zone.cleared(found) } else { zone.open(found) })
            };
            let levels = wanted.iter().enumerate();
            let levels: Vec<_> =
                levels.flat_map(|(stage, all)| all.iter().map(move |level| (stage, level))).collect();
            let found = levels.into_par_iter().map(pieces).collect::<Option<Vec<_>>>()?;
            Some((open, found))
        };
        let (diagram, found) = self.walked((copper, nets), kind, wall, lines);
        let is_whole = found.is_some();
        let (open, found) = found.unwrap_or_default();
        let wider = wider(before, widening);
        let grooves = Grooves::new(base.edges.iter().filter(|edge| !is_pass(edge)), widening.floor - step);
        // What also runs in enclosed space minds the loops outside it.
        let has_both = !further.is_empty() && !self.settings.enclosed;
        let loops = base.edges.iter().filter(|edge| has_both && is_pass(edge));
        let loops = Grooves::new(loops, step / 2);
        let innermost = grooves.as_ref().map(|grooves| grooves.within(BESIDE));
        let fence = Fence::new(&self.border);
        let spikes = Spikes {
            kerf: widening.floor.to_f64(),
            step: step.to_f64(),
            clearance: &|at| diagram.distance(at.into()),
            nearest: first.to_f64(),
            fence: &fence,
        };
        let first_pass = base.edges.len();
        let mut all = base;
        let mut passed: Option<Grooves> = None;
        for (number, (&level, mut lines)) in wanted.iter().flatten().zip(found).enumerate() {
            let minds_loops = number >= wanted[0].len() && !self.settings.enclosed;
            if !minds_loops {
                lines.retain(|line| !self.has_loop_at(level, line));
            } else if number == wanted[0].len() && !again.is_empty() {
                passed = Grooves::new(all.edges[first_pass..].iter(), step / 2);
            }
            let grooves = if level > first { &grooves } else { &innermost };
            let loops = loops.as_ref().filter(|_| minds_loops && level == first);
            for grooves in wider.iter().chain(grooves).chain(&passed).chain(loops) {
                lines = lines.into_par_iter().flat_map_iter(|line| grooves.take_out(line)).collect();
            }
            let mut passes = self.fitted(lines);
            if level > first {
                passes.edges.par_iter_mut().for_each(|pass| spikes.add(pass));
            }
            all.append(passes);
        }
        let clearance = |at| diagram.room(at);
        let owner = |at| diagram.owner_near(at, f64::INFINITY, NOBODY).map(NetId);
        let farthest = levels.last().map_or(0.0, |last| last.to_f64());
        let room = Room { clearance: &clearance, owner: &owner, nearest: first.to_f64(), farthest };
        let mut lines = zone.edges(&fence, &room);
        for grooves in wider.iter().chain(&grooves) {
            lines = lines.into_par_iter().flat_map_iter(|line| grooves.take_out(line)).collect();
        }
        all.append(self.fitted(lines));
        let heights = |levels: &[Nm]| -> Vec<f64> { levels.iter().map(|level| level.to_f64()).collect() };
        let levels = heights(&levels);
        let kerf = widening.floor.to_f64();
        let passes = Passes { diagram: &diagram, fence: &fence, kerf, step: step.to_f64(), levels: &levels };
        // Between all nets there is a cut along the axis.
        let is_open = |left: u32, right: u32| left == right || widening.skips || !self.is_plain();
        let mut lines = zone.open(passes.residues(all.edges.iter(), before, is_open, open.as_ref()));
        let edges = passes
            .beyond()
            .and_then(|beyond| self.level_pieces(&diagram, Nm::from_f64(beyond), open.as_ref()));
        if let Some(edges) = edges {
            let cuts = all.edges[..first_pass].iter().filter(|edge| !is_pass(edge));
            lines.extend(zone.beside(passes.strips(&edges, cuts, before)));
        }
        all.append(self.fitted(lines));
        if !further.is_empty() {
            let levels: Vec<f64> = levels.iter().copied().chain(heights(&further)).collect();
            let passes = Passes { levels: &levels, ..passes };
            let lines = zone.cleared(passes.residues(all.edges.iter(), before, is_open, None));
            all.append(self.fitted(lines));
        }
        let within = self.settings.overlap.to_f64();
        if self.border.frame.is_none() && passes.may_leave_edges(within) {
            let wanted = |at| zone.is_cleared(at, &room);
            let rims = zone.rims(&fence, &room);
            let lines = passes.beside_edge(&rims, within, wanted, all.edges.iter(), before);
            all.append(self.fitted(lines));
        }
        let longest =
            if further.is_empty() { widening.width.unwrap_or(LONGEST).min(LONGEST) } else { LONGEST };
        let rules = Rules {
            clearance: &|at, reach| diagram.distance_within(at, reach),
            is_open: &|a, b| zone.is_open(a, b),
            nearest: (widening.kerf / 2).to_f64(),
            step: step.to_f64(),
            short: (widening.kerf * 3 / 2).to_f64(),
            longest: longest.to_f64(),
        };
        let missing = |at: Point| {
            let message = "further passes are missing: a bug in voromill".to_owned();
            planning::PASSES_MISSING.warning(message).at(at).on(self.side)
        };
        let warning =
            (!is_whole).then(|| missing(diagram.faults().first().copied().unwrap_or(self.copper.min())));
        (all.linked(&rules), warning.into_iter().collect())
    }

    /// Whether boundaries run midway between all nets.
    fn is_plain(&self) -> bool {
        self.settings.sites == SiteKind::Copper && self.settings.limit.is_none() && self.mixed.is_none()
    }

    /// Where copper is just so far away on the board; with `open` not in parts of that space that
    /// one net alone encloses.
    fn level_pieces(
        &self,
        diagram: &exact::Diagram,
        level: Nm,
        open: Option<&exact::Above>,
    ) -> Option<Vec<Piece>> {
        let chains = diagram.curves_at(level.to_f64(), NOBODY, open)?;
        // Who owns the border between two crossings nobody asks.
        let (mut pieces, _) = self.on_board(diagram, chains, level.to_f64());
        pieces.retain(|piece| !piece.is_border());
        Some(pieces)
    }

    /// Whether every net has a loop at this distance already.
    fn has_loops_of_all_at(&self, level: Nm) -> bool {
        self.mixed.is_none() && self.settings.limit == Some(level)
    }

    /// Whether the net that `line` goes round has one.
    fn has_loop_at(&self, level: Nm, line: &Piece) -> bool {
        let owner = Owner::from_number(line.left.max(line.right));
        self.settings.limit == Some(level) && self.mixed.as_ref().is_none_or(|mixed| mixed.has_loop(owner))
    }
}

/// What wider tools have cleared of what this one would clear: with a part of its kerf to spare,
/// for a pass along the very edge of it would come and go.
fn wider(before: &[Share<'_>], widening: &Widening) -> Vec<Grooves> {
    let Widening { kerf, floor, .. } = *widening;
    let of = |wide: &Share<'_>| {
        let alone = Grooves::new(wide.cuts.edges.iter(), (wide.kerf - kerf) / 2 + kerf / 8)?;
        Some(alone.together(wide.floor / 2, floor / 2))
    };
    before.iter().filter_map(of).collect()
}

impl Boundaries {
    /// Adds the nodes and edges of `other` behind its own.
    fn append(&mut self, other: Self) {
        let offset = u32::try_from(self.nodes.len()).expect("below 2³² nodes");
        self.nodes.extend(other.nodes);
        self.edges.extend(other.edges.into_iter().map(|mut edge| {
            edge.ends = edge.ends.map(|(a, b)| (NodeId(a.0 + offset), NodeId(b.0 + offset)));
            edge
        }));
    }
}
