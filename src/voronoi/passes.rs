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
//! one more cut clears it ([`super::speck`]). Passes need not mind each other: a step apart in
//! their distance from copper, they are no nearer anywhere.
//!
//! Where there is no certified diagram they are traced from the picture, in which what is cleared
//! is drawn above everything.

use rayon::prelude::*;

use crate::board::Warning;
use crate::geometry::{Nm, Point};
use crate::raster;

use super::clip::Piece;
use super::exact;
use super::groove::{END, Grooves};
use super::link::Rules;
use super::near::Insides;
use super::place::Unplaced;
use super::span::{Sample, Vertex};
use super::speck::Specks;
use super::spike::Spikes;
use super::stitch::Line;
use super::tip::MISPLACED;
use super::{BEYOND, Boundaries, Boundary, Diagram, FLOOR, Owner};

/// How much farther than the last pass is drawn, in pixels: what tracing looks at beyond a tile,
/// and one.
const SPARE: f32 = 3.0;

/// Links are no longer. Chosen: there and back they cost as much as a retract.
const LONGEST: Nm = Nm::from_mm(3);

/// How the gap beside copper is widened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Widening {
    /// How wide the cutter clears.
    pub kerf: Nm,
    /// How wide the gap beside every net is to be, where there is room.
    pub width: Nm,
    /// How much of the kerf neighbouring passes share, at least.
    pub overlap: Nm,
}

impl Widening {
    /// The distances from copper at which passes run, from the nearest to the farthest, evenly
    /// spaced; none of more than `most`.
    fn levels(&self, first: Nm, most: Nm) -> Vec<Nm> {
        let last = self.width - self.kerf / 2;
        let advance = (self.kerf - self.overlap).max(Nm::new(1));
        if last <= first {
            return vec![first];
        }
        let gaps = (last - first + advance - Nm::new(1)).get() / advance.get();
        (0..=gaps).map(|i| first + (last - first) * i / gaps).take_while(|&level| level <= most).collect()
    }
}

impl Diagram {
    /// `base` with further passes beside its cuts, until the gap beside every net is as wide as
    /// asked for. `before` is what wider tools have cut, each with its kerf: nothing of that is cut
    /// again.
    ///
    /// A pass never runs nearer to copper than half the kerf and the fitting tolerance. What `base`
    /// has at that distance already (the outline strategy's loops) is not cut again. With it comes
    /// what could not be placed.
    #[must_use]
    pub fn widened(
        &self,
        base: Boundaries,
        widening: &Widening,
        before: &[(Nm, Boundaries)],
    ) -> (Boundaries, Vec<Warning>) {
        let first = widening.kerf / 2 + self.settings.tolerance;
        let picture = self.grid.rect();
        let levels = widening.levels(first, picture.width() + picture.height());
        let step = levels.get(1).map_or(widening.kerf - widening.overlap, |&second| second - levels[0]);
        let levels: Vec<Nm> = levels.into_iter().filter(|&level| !self.has_loops_of_all_at(level)).collect();
        if levels.is_empty() {
            return (base, Vec::new());
        }
        let reach = widening.kerf - step;
        // Loops at the first level are passes themselves.
        let is_pass = |edge: &Boundary| self.settings.limit == Some(first) && edge.is_bare();
        let grooves = Grooves::new(base.edges.iter().filter(|edge| !is_pass(edge)), reach);
        let spikes = Spikes {
            kerf: widening.kerf.to_f64(),
            step: step.to_f64(),
            clearance: &|at| self.clearance(at),
            nearest: first.to_f64(),
        };
        let first_pass = base.edges.len();
        let found = self.certified_passes(&levels, widening.kerf, before);
        let cleared = || base.edges.iter().filter(|edge| !is_pass(edge));
        let (found, unplaced, torn) = match found {
            Some(lines) => (lines, Unplaced::default(), Unplaced::default()),
            None => self.traced_passes(&levels, widening.kerf, reach, cleared(), before),
        };
        let mut all = base;
        let mut last_pass = first_pass;
        for (&level, mut lines) in levels.iter().zip(found) {
            if let Some(grooves) = &grooves {
                lines = lines.into_par_iter().flat_map_iter(|line| grooves.take_out(line)).collect();
            }
            let mut passes = self.graph(lines);
            if level > first {
                passes.edges.par_iter_mut().for_each(|pass| spikes.add(pass));
            }
            last_pass = all.edges.len();
            all.append(passes);
        }
        if let Some(near) = &self.near {
            let [kerf, step, nearest] = [widening.kerf, step, first].map(Nm::to_f64);
            let specks = Specks { sites: &self.sites, near, border: &self.border, kerf, step, nearest };
            let (inner, last) = all.edges.split_at(last_pass);
            let (base, further) = inner.split_at(first_pass);
            let lines = if specks.are_possible() {
                let inner = base.iter().filter(|edge| is_pass(edge)).chain(further).collect();
                specks.lines(inner, last, all.edges.iter(), before)
            } else {
                specks.lines(Vec::new(), last, base.iter().chain(last), before)
            };
            all.append(self.graph(lines));
        }
        let what = ("points of further passes", "further passes");
        let warnings = self.not_placed(unplaced, what.0).into_iter().chain(self.torn(torn, what.1));
        let rules = Rules {
            clearance: &|at| self.clearance(at.rounded()),
            nearest: (widening.kerf / 2).to_f64(),
            short: (widening.kerf * 3 / 2).to_f64(),
            longest: widening.width.min(LONGEST).to_f64(),
        };
        (all.linked(&rules), warnings.collect())
    }

    /// The passes at each level of the certified diagram, less what wider tools have cut; none
    /// where there is no such diagram, or it contradicts itself.
    fn certified_passes(
        &self,
        levels: &[Nm],
        kerf: Nm,
        before: &[(Nm, Boundaries)],
    ) -> Option<Vec<Vec<Line>>> {
        let certified = self.certified.as_deref().filter(|_| self.mixed.is_none())?;
        let (first, last) = (*levels.first()?, *levels.last()?);
        let diagram = certified
            .within_wall(self.copper.inflate(last * 3 + BEYOND), self.settings.kind(FLOOR.min(first / 2)))?;
        // A pass along the very edge of what is cut already would come and go.
        let spare = kerf / 8;
        let reach = |wide: Nm| (wide - kerf) / 2 + spare;
        let wider: Vec<Grooves> =
            before.iter().filter_map(|(wide, cuts)| Grooves::new(cuts.edges.iter(), reach(*wide))).collect();
        let passes = levels.par_iter().map(|&level| {
            let mut lines = self.level_lines(&diagram, level)?;
            for grooves in &wider {
                lines = lines.into_iter().flat_map(|line| grooves.take_out(line)).collect();
            }
            Some(lines)
        });
        passes.collect()
    }

    /// Where copper is just so far away on the board.
    fn level_lines(&self, diagram: &exact::Diagram, level: Nm) -> Option<Vec<Line>> {
        let (pieces, faults) = self.level_pieces(diagram, level.to_f64())?;
        let line = |Piece { samples, left, right, ends }: Piece| {
            let vertex = |sample: &Sample| Vertex::new(sample.at, sample.clearance);
            Line {
                vertices: samples.iter().map(vertex).collect(),
                left,
                right,
                ends: ends.map(|_| (END, END)),
            }
        };
        faults.is_empty().then(|| pieces.into_iter().map(line).filter(|line| !line.is_border()).collect())
    }

    /// The passes at each level as the picture has them, with what could not be placed and what
    /// hangs loose.
    fn traced_passes<'a>(
        &self,
        levels: &[Nm],
        kerf: Nm,
        reach: Nm,
        cleared: impl Iterator<Item = &'a Boundary>,
        before: &[(Nm, Boundaries)],
    ) -> (Vec<Vec<Line>>, Unplaced, Unplaced) {
        let last = levels.last().copied().unwrap_or_default();
        let mut scene = self.sites.scene(&self.grid, &self.border, Some(self.grid.pixels(last) + SPARE));
        if reach > self.grid.pitch() {
            self.add_grooves(&mut scene, cleared, self.grid.pixels(reach - self.grid.pitch()));
        }
        self.add_wider(&mut scene, kerf, before);
        let insides = Insides::new(&self.sites);
        let (mut unplaced, mut torn) = (Unplaced::default(), Unplaced::default());
        let mut found = Vec::with_capacity(levels.len());
        for (&level, passes) in levels.iter().zip(self.trace_levels(&scene, levels)) {
            torn = torn.join(passes.torn());
            let mut lines = passes.lines();
            lines.retain(|line| !self.has_loop_at(level, line));
            if let Some(tips) = self.tips(Some(&insides), level.to_f64()) {
                tips.extend_level(&mut lines);
            }
            self.keep_off(&mut lines, level);
            unplaced = unplaced.join(self.off_level(&lines, level));
            found.push(lines);
        }
        (found, unplaced, torn)
    }

    /// The vertices that are not so far from copper. Those that were placed have a course, and are.
    fn off_level(&self, lines: &[Line], level: Nm) -> Unplaced {
        let mut unplaced = Unplaced::default();
        for vertex in lines.iter().flat_map(|line| &line.vertices).filter(|vertex| !vertex.has_course()) {
            if (self.clearance(vertex.at.rounded()) - level.to_f64()).abs() > MISPLACED {
                unplaced.add(vertex.at);
            }
        }
        unplaced
    }

    /// How far a place is from copper, in nanometres.
    fn clearance(&self, at: Point) -> f64 {
        match (&self.near, &self.edges) {
            (Some(near), _) => near.distance(&self.sites, at.into()),
            (None, Some(edges)) => edges.distance(at.into()),
            (None, None) => 0.0,
        }
    }

    /// Whether every net has a loop at this distance already.
    fn has_loops_of_all_at(&self, level: Nm) -> bool {
        self.mixed.is_none() && self.settings.limit == Some(level)
    }

    /// Whether the net that `line` goes round has one.
    fn has_loop_at(&self, level: Nm, line: &Line) -> bool {
        let owner = Owner::from_number(line.left.max(line.right));
        self.settings.limit == Some(level) && self.mixed.as_ref().is_none_or(|mixed| mixed.has_loop(owner))
    }

    /// Draws the grooves of wider tools, so wide that a cut of `kerf` along their edges clears next
    /// to nothing beside them: with a part of the kerf to spare, and two pixels, so that a pass
    /// along the very edge does not flicker.
    fn add_wider(&self, scene: &mut raster::Scene, kerf: Nm, before: &[(Nm, Boundaries)]) {
        let spare = (kerf / 8).max(self.grid.pitch() * 2).min(kerf / 3);
        for (wide, cuts) in before {
            let reach = self.grid.pixels((*wide - kerf) / 2 + spare);
            self.add_grooves(scene, cuts.edges.iter(), reach);
        }
    }

    /// Draws what lies within `reach` pixels of cuts as cleared.
    fn add_grooves<'a>(
        &self,
        scene: &mut raster::Scene,
        cuts: impl Iterator<Item = &'a Boundary>,
        reach: f32,
    ) {
        for edge in cuts.filter(|edge| !edge.is_border()) {
            self.sites.add_groove(scene, &self.grid, &edge.path, reach);
        }
    }
}

impl Boundaries {
    /// Adds the nodes and edges of `other` behind its own.
    fn append(&mut self, other: Self) {
        let offset = u32::try_from(self.nodes.len()).expect("below 2³² nodes");
        self.nodes.extend(other.nodes);
        self.edges.extend(other.edges.into_iter().map(|mut edge| {
            edge.ends = edge.ends.map(|(a, b)| (super::NodeId(a.0 + offset), super::NodeId(b.0 + offset)));
            edge
        }));
    }
}
