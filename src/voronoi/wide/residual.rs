//! What passes leave between them, cleared.
//!
//! ```text
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//!   ━━━━━━━━━━━━━━━━━━━━━━
//!   ░░░░░░░─────────░░│
//!   ━━━━━━━━━━━━━━━━━━━━━━
//!   ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓
//! ```
//!
//! From a foot on copper up to the medial axis, passes run as long as the next one still fits. What
//! the last of them does not reach lies about the axis ─, where its clearance is more than that
//! pass clears and less than where the next would run. It is narrower than a kerf: one cut along
//! the axis clears it, but where another cut comes as near.
//!
//! Beside the last pass copper may stay; but where only a thin strip does between that and another
//! cut, it would come off sooner or later. So it is cut off, too: along the axis between two
//! passes, along the edge of the last pass where it is the first cut that lies beside it.
//!
//! Where passes run out of the board, a strip may stay along its edge. It is cut off along that.
//!
//! M. Held, *On the Computational Geometry of Pocket Machining*, LNCS 500, Springer 1991, ch. 7
//! (uncleared places by the clearance along bisectors).

use rayon::prelude::*;

use crate::geometry::Nm;
use crate::topology::NetId;
use crate::voronoi::clip::{Fence, Node, Piece};
use crate::voronoi::exact::{self, OnAxis};
use crate::voronoi::plane::Spot;
use crate::voronoi::sample::{Sample, length};
use crate::voronoi::{Boundary, OUTSIDE, Owner, Share};

use super::groove::Grooves;

/// A residue begins so much deeper in what the next pass clears than the edge of that, in
/// nanometres. Chosen: more than fitting moves either.
const SURE: f64 = 3_000.0;
/// It is looked at in such steps, in nanometres. Chosen.
const STEP: f64 = 20_000.0;
/// A strip beside the last pass that is thinner than this is cut off, in nanometres, and no less
/// long than that: where it is shorter its ends hold it. Chosen: the first as for what `verify`
/// finds too thin, the second half as long, for that adds up strips.
const THIN: f64 = 50_000.0;
const LONG: f64 = 250_000.0;
/// A residue that is shorter, in nanometres, is a crumb, which takes longer to clear than it is
/// worth. Chosen: on random boards the retracts became two and a half times as many where every
/// crumb was cleared, and an eighth more with this.
const CRUMB: f64 = 50_000.0;

/// Passes, and what is known of the space they run in.
pub(super) struct Passes<'a> {
    pub(super) diagram: &'a exact::Diagram,
    /// Where the board ends.
    pub(super) fence: &'a Fence,
    /// How wide the cutter clears at the bottom of the copper, in nanometres.
    pub(super) kerf: f64,
    /// How far passes lie apart, at most.
    pub(super) step: f64,
    /// How far from copper they run, from the nearest to the farthest.
    pub(super) levels: &'a [f64],
}

/// A place on the axis beside which something is left.
#[derive(Clone, Copy)]
struct Residue {
    on_axis: Sample,
    /// How far from the axis that reaches, and where on one side it ends.
    rest: f64,
    shoulder: Spot,
}

/// What cuts have cleared.
struct Cleared(Vec<Grooves>);

impl Cleared {
    fn holds(&self, p: Spot) -> bool {
        self.0.iter().any(|grooves| grooves.holds(p))
    }
}

impl Passes<'_> {
    /// How much of the kerf neighbouring passes share, as far as it matters.
    fn shared(&self) -> f64 {
        (self.kerf - self.step).clamp(0.0, 4.0 * SURE)
    }

    /// How far residues begin from the pass that they lie beside.
    fn way(&self) -> f64 {
        f64::midpoint(self.kerf, -self.shared()) + SURE
    }

    /// What lies so near to `cuts`, or to those of wider tools `before`, that nothing of it is
    /// left.
    fn cleared<'b>(&self, cuts: impl Iterator<Item = &'b Boundary>, before: &[Share<'_>]) -> Cleared {
        let reach = |kerf: f64| Nm::from_f64((kerf - self.shared()) / 2.0);
        let wider =
            before.iter().filter_map(|wide| Grooves::new(wide.cuts.edges.iter(), reach(wide.kerf.to_f64())));
        Cleared(Grooves::new(cuts, reach(self.kerf)).into_iter().chain(wider).collect())
    }

    /// What clears the residues of all passes, where `cuts` may have cleared them and wider tools
    /// have cut `before`; only between owners that are `wanted`, and with `open` not where no pass
    /// runs because one owner alone encloses that part of the space.
    pub(super) fn residues<'b>(
        &self,
        cuts: impl Iterator<Item = &'b Boundary>,
        before: &[Share<'_>],
        wanted: impl Fn(u32, u32) -> bool,
        open: Option<&exact::Above>,
    ) -> Vec<Piece> {
        let Some(&last) = self.levels.last() else { return Vec::new() };
        let strip = [last + self.way(), last + self.way() + self.thin() / 2.0];
        let between = self.levels.windows(2).map(|pair| [pair[0] + self.way(), pair[1]]);
        let ranges: Vec<[f64; 2]> = between.chain([strip]).filter(|[low, high]| low < high).collect();
        let mut axes = self.diagram.axes_between(&ranges, &wanted);
        // One owner alone encloses them.
        let middles =
            if open.is_none() { self.diagram.middles_between(&ranges, &wanted) } else { Vec::new() };
        if let Some(open) = open {
            // All of an axis lies beyond the first pass.
            let is_open = |place: &OnAxis| !self.diagram.is_enclosed((place.edge, place.sample.at), open);
            axes.retain(|axis| axis.places.first().is_some_and(is_open));
        }
        if axes.is_empty() && middles.is_empty() {
            return Vec::new();
        }
        let cleared = self.cleared(cuts, before);
        let number = |owner: u32| Owner::Net(NetId(owner)).number();
        let spots = middles.iter().filter_map(|&(middle, owner)| {
            let samples = self.round(middle, &cleared)?;
            Some(Piece { left: number(owner), right: number(owner), samples, ends: Some([Node::END; 2]) })
        });
        let residues = axes.par_iter().flat_map_iter(|axis| {
            let places: Vec<Option<Residue>> =
                steps(&axis.places).map(|place| self.residue(&place, &cleared)).collect();
            let [left, right] = axis.owners.map(number);
            let piece = |samples| Piece { left, right, samples, ends: Some([Node::END; 2]) };
            runs(&places).filter_map(|run| self.along(&run).map(piece)).collect::<Vec<_>>()
        });
        residues.chain(spots.collect::<Vec<_>>()).collect()
    }

    /// The cut that clears what is left about the middle of a round space, if it is worth one.
    fn round(&self, middle: Sample, cleared: &Cleared) -> Option<Vec<Sample>> {
        let Sample { at, clearance } = middle;
        let rest = clearance - self.levels[self.inner(clearance)?] - self.way();
        let sides = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| Spot::new(x, y));
        let is_left = |p: Spot| !cleared.holds(p) && self.fence.holds(p);
        let is_residue = is_left(at) || sides.iter().any(|&side| is_left(at + side * rest.max(0.0)));
        if 2.0 * rest < CRUMB || !is_residue || !self.fence.holds(at) {
            return None;
        }
        let part = (STEP / 2.0).min(rest);
        Some(vec![Sample { at: at + sides[0] * part, clearance: clearance - part }, middle])
    }

    /// The last pass that runs nearer to copper than this.
    fn inner(&self, clearance: f64) -> Option<usize> {
        self.levels.iter().rposition(|&level| level < clearance)
    }

    /// A place on the axis, where anything beside it is left: it, or what lies straight towards
    /// copper as far as a pass has not cleared.
    fn residue(&self, place: &OnAxis, cleared: &Cleared) -> Option<Residue> {
        let on_axis @ Sample { at, clearance } = place.sample;
        let inner = self.levels[self.inner(clearance)?];
        let rest = (clearance - inner - self.way()).max(0.0);
        let is_left = |p: Spot| !cleared.holds(p) && self.fence.holds(p);
        let shoulders = self.diagram.away_at(place).map(|away| at + away * -rest);
        let is_residue = is_left(at) || shoulders.into_iter().any(is_left);
        (is_residue && self.fence.holds(at)).then_some(Residue { on_axis, rest, shoulder: shoulders[0] })
    }

    /// The cut that clears residues in a row, if they are worth one. What is no longer than a step
    /// is cleared from its middle: there the axis is short where the residue is round.
    fn along(&self, run: &[Residue]) -> Option<Vec<Sample>> {
        let samples: Vec<Sample> = run.iter().map(|place| place.on_axis).collect();
        let widest = run.iter().max_by(|a, b| a.rest.total_cmp(&b.rest))?;
        let is_strip = self.levels.last().is_some_and(|&last| widest.on_axis.clearance > last);
        let length = length(&samples);
        if length + if is_strip { 0.0 } else { 2.0 * widest.rest } < if is_strip { LONG } else { CRUMB } {
            return None;
        }
        if length >= STEP {
            return Some(samples);
        }
        let Sample { at, clearance } = widest.on_axis;
        let part = (STEP / 2.0).min(widest.rest);
        let way = widest.shoulder - at;
        let beside = at + way * (part / way.length().max(1.0));
        Some(vec![Sample { at: beside, clearance: clearance - part }, widest.on_axis])
    }

    /// How thin a strip is that is cut off.
    fn thin(&self) -> f64 {
        THIN.min(self.kerf / 2.0 - 2.0 * SURE)
    }

    /// The parts of what lies just beyond the last pass, `edges`, where a thin strip beside them
    /// parts them from one of `cuts` or of those of wider tools `before`.
    pub(super) fn strips<'b>(
        &self,
        edges: &[Piece],
        cuts: impl Iterator<Item = &'b Boundary>,
        before: &[Share<'_>],
    ) -> Vec<Piece> {
        let cleared = self.cleared(cuts, before);
        let strips = edges.par_iter().flat_map_iter(|edge| {
            let right = if edge.left > OUTSIDE { self.thin() } else { -self.thin() };
            stretches(edge, LONG, |at, along| {
                let beyond = at + Spot::new(along.y, -along.x) * right;
                cleared.holds(beyond) && !cleared.holds(at)
            })
        });
        strips.collect()
    }

    /// Whether a strip may stay along the board's edge, which begins so far `within` what passes
    /// run out to: one nearer to the edge than passes are apart clears it where it is wide enough.
    pub(super) fn may_leave_edges(&self, within: f64) -> bool {
        self.step - self.kerf / 2.0 > within
    }

    /// The parts of the board's edge, `rims` with the board on their left, beside which something
    /// is left of what is `wanted`. The board itself begins so far `within` them.
    pub(super) fn beside_edge<'b>(
        &self,
        rims: &[Piece],
        within: f64,
        wanted: impl Fn(Spot) -> bool + Sync,
        cuts: impl Iterator<Item = &'b Boundary>,
        before: &[Share<'_>],
    ) -> Vec<Piece> {
        let cleared = self.cleared(cuts, before);
        let parts = rims.par_iter().flat_map_iter(|rim| {
            stretches(rim, CRUMB, |at, along| {
                let on_board = at + Spot::new(-along.y, along.x) * (within + SURE);
                !cleared.holds(on_board) && wanted(on_board)
            })
        });
        parts.collect()
    }

    /// How far from copper the last pass no longer clears.
    pub(super) fn beyond(&self) -> Option<f64> {
        self.levels.last().map(|last| last + self.way())
    }
}

/// Places along an axis, in steps of at most [`STEP`].
fn steps(places: &[OnAxis]) -> impl Iterator<Item = OnAxis> {
    let along = places.windows(2).flat_map(|pair| {
        let count = ((pair[1].sample.at - pair[0].sample.at).length() / STEP).ceil().max(1.0);
        parts(count).map(move |part| pair[0].toward(&pair[1], part))
    });
    places.first().copied().into_iter().chain(along)
}

/// The numbers 1 ÷ count to 1.
fn parts(count: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(1.0), move |i| (i + 1.0 <= count).then_some(i + 1.0)).map(move |i| i / count)
}

/// Places along a line, in steps of at most so many nanometres, each with the direction in which
/// one comes there.
fn ways(line: &Piece, step: f64) -> impl Iterator<Item = (Spot, Spot)> {
    let ends = line.samples.windows(2).map(|ends| (ends[0].at, ends[1].at - ends[0].at));
    let ways = ends.filter(|(_, way)| way.length() > 0.0);
    ways.flat_map(move |(from, way)| {
        let along = way * (1.0 / way.length());
        parts((way.length() / step).ceil()).map(move |part| (from + way * part, along))
    })
}

/// The stretches of a line, no shorter than `long`, at whose places `is_wanted` holds; it is asked
/// with the direction in which one comes there.
fn stretches(line: &Piece, long: f64, is_wanted: impl Fn(Spot, Spot) -> bool) -> Vec<Piece> {
    let clearance = line.samples.iter().map(|sample| sample.clearance).fold(f64::INFINITY, f64::min);
    let place = |(at, along)| is_wanted(at, along).then_some(Sample { at, clearance });
    let places: Vec<Option<Sample>> = ways(line, THIN / 2.0).map(place).collect();
    let Piece { left, right, .. } = *line;
    let part = |samples| Piece { left, right, samples, ends: Some([Node::END; 2]) };
    runs(&places).filter(|run| length(run) >= long).map(part).collect()
}

/// Those stretches of places in a row that are some.
fn runs<T: Copy>(places: &[Option<T>]) -> impl Iterator<Item = Vec<T>> {
    let stretches = places.chunk_by(|a, b| a.is_some() == b.is_some());
    stretches.filter(|run| run[0].is_some()).map(|run| run.iter().copied().flatten().collect())
}
