//! What a program carves beside what it should: the depth of what is milled at many places, and how
//! deep an ideal V-bit would go there.
//!
//! ```text
//!   ════╲         ╱════   At distance d from the edge of an area nothing may be deeper than d / tan(angle / 2), the cone that
//!        ╲ ideal ╱        touches the edge there, nor than the most depth. How deep a tool can go at a place is asked of one
//!         ╲     ╱         that moves straight away from the nearest edge for as long as that stays the nearest: it fits
//!          ╲▁▁▁╱ tip      there, so what it would mill must be milled.
//! ```
//!
//! The places are a grid, and, as that is coarse on a large drawing: along the edges, just outside
//! and where the largest disc inside that touches the edge there has its centre; and along the way
//! of the tip. Distances are measured to the edges themselves, and what is milled to the motions
//! that the text is read back as: no medial axis, no diagram, nothing of the planner.

mod places;

use crate::board::diagnostic::planning;
use crate::board::{Diagnostic, Severity};
use rayon::prelude::*;

use super::check;
use super::cutter::{Cone, Cutter};
use super::declared::Declared;
use super::edges::{Edges, Spot};
use super::followed::Followed;
use super::report::Finding;
use super::surface::{self, Surface};
use super::{Error, Placement, Program, Settings};
use crate::geometry::{Nm, Point, Polygon, Rect};
use places::{Along, along};

/// What should be carved, on the machine.
#[derive(Clone, Debug)]
pub struct Ideal<'a> {
    /// The areas, simple polygons.
    pub areas: &'a [Polygon],
    /// The V-bit that reaches the walls.
    pub v_bit: Cutter,
    /// Whether what is too wide for it is cleared, too.
    pub clears: bool,
    /// No deeper than this; none for as deep as it comes.
    pub most: Option<Nm>,
    /// How deep the edges of the areas lie: above them the walls go on outwards, to the surface.
    pub start: Nm,
    /// Corners at which the edge turns by an angle with a larger cosine are not entered; 1 for
    /// none.
    pub corner: f64,
    /// What is less off is right.
    pub tolerance: Nm,
    /// The distance of the places that are looked at.
    pub pitch: Nm,
}

/// A program to be judged.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    /// Its name.
    pub file: &'a str,
    /// What the machine reads.
    pub text: &'a str,
    /// The one tool that it has.
    pub cutter: Cutter,
}

/// What came of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Carved {
    /// How many places were looked at.
    pub places: usize,
    /// How far the surface is off, in nanometres: at 99 of 100 places in areas no more than this.
    pub p99: f64,
    /// The most that it is too deep, in nanometres.
    pub over: f64,
    /// The most that it is too shallow.
    pub under: f64,
    /// How much of the areas is wider than the V-bit cuts at the most depth and was left, in mm².
    pub left_mm2: f64,
    /// What is wrong, worst first.
    pub findings: Vec<Finding>,
}

/// Places nearer to each other are one finding. Chosen.
const APART: f64 = 500_000.0;

/// Places nearer than this are the same, in nanometres. Chosen: the resolution of coordinates.
const SAME: f64 = 0.5;

/// So far beside the areas every place is looked at; beyond, where the tip goes. Chosen: wider than
/// tools are.
const BESIDE: Nm = Nm::from_mm(1);

/// So many findings of one kind are listed. Chosen.
const MOST_LISTED: usize = 50;

/// A place that is off: where, by how much (too deep above zero), and whether it lies in an area.
#[derive(Clone, Copy, Debug)]
struct Off {
    at: Spot,
    by: f64,
    inside: bool,
}

/// Reads programs and compares what they carve together with the ideal.
///
/// # Errors
///
/// [`Error::Read`] for a text that cannot be followed.
pub fn carving(programs: &[Text<'_>], ideal: &Ideal<'_>) -> Result<Carved, Error> {
    let programs = followed(programs)?;
    let mut carved = compare(&Surface::new(&programs, surface::CHORD), ideal);
    carved.findings.splice(0..0, harm(&programs));
    Ok(carved)
}

/// What programs mill, for pictures of it.
///
/// # Errors
///
/// [`Error::Read`] for a text that cannot be followed.
pub fn milled(programs: &[Text<'_>]) -> Result<Surface, Error> {
    Ok(Surface::new(&followed(programs)?, surface::COARSE))
}

/// What programs do, each with its tool.
pub(super) fn followed(programs: &[Text<'_>]) -> Result<Vec<Followed>, Error> {
    let follow = |text: &Text<'_>| {
        let program = Program {
            file: text.file.to_owned(),
            text: text.text.to_owned(),
            cutter: Some(text.cutter),
            ..Program::default()
        };
        Followed::read(&program, Declared::read(text.text).mounted, Placement::default())
    };
    programs.iter().map(follow).collect()
}

/// What harms the machine or the work whatever is carved.
pub(super) fn harm(programs: &[Followed]) -> Vec<Finding> {
    programs.iter().flat_map(harm_of).collect()
}

fn harm_of(program: &Followed) -> Vec<Finding> {
    let settings = Settings::default();
    let mut findings = check::any(program, &settings);
    // At the surface a trail begins and ends: a rapid there is one that was not lifted.
    let touches = |finding: &Finding| finding.size >= Some(settings.clearance);
    let rapids = findings.iter_mut().filter(|finding| finding.name == check::RAPID_IN_MATERIAL.code);
    rapids.filter(|finding| touches(finding)).for_each(|finding| finding.severity = Severity::Error);
    findings.extend(too_fast(program));
    findings
}

/// The first motion at a feed that the tool does not bear where it is deepest: there a V-bit is
/// widest, and near its tip it bears none at all.
fn too_fast(program: &Followed) -> Option<Finding> {
    let cuts = || program.listing.motions.iter().filter(|motion| check::cut_depth(motion).is_some());
    let deepest = cuts().filter_map(check::cut_depth).max()?;
    cuts().find_map(|motion| {
        let (step, message) = check::too_fast(motion, program.tools.at(motion.line)?, deepest)?;
        let kind = &check::FEED_PER_TURN;
        Some(Finding {
            program: Some(program.file.clone()),
            line: Some(motion.line),
            at: motion.to.point(),
            size: Some(step),
            ..Finding::new(kind.code, kind.severity, message)
        })
    })
}

fn compare(milled: &Surface, ideal: &Ideal<'_>) -> Carved {
    let Some(bounds) = ideal.areas.iter().map(Polygon::bounds).reduce(Rect::union) else {
        return Carved::default();
    };
    let edges = Edges::new(ideal.areas);
    let limits = Limits::new(ideal);
    let around = bounds.inflate(BESIDE + Nm::from_f64(limits.start * limits.flank));
    let pitch = ideal.pitch.to_f64();
    let (rows, columns) = (count(around.height(), pitch), count(around.width(), pitch));
    let (x0, y0) = around.min().to_f64();
    // Off the grid that drawings are on.
    let place = |i: u32| (f64::from(i) + 0.381_966) * pitch;
    let row = |row: u32| {
        let y = y0 + place(row);
        let crossings = edges.crossings(y);
        let mut found = Row::default();
        for column in 0..columns {
            let at = (x0 + place(column), y);
            let inside = crossings.iter().filter(|&&x| x < at.0).count() % 2 == 1;
            found.look(at, inside, milled, &edges, &limits);
        }
        found
    };
    let rows: Vec<Row> = (0..rows).into_par_iter().map(row).collect();
    let mut carved = sum_up(&rows, ideal);
    let in_rows = |places: Vec<Along>, look: &(dyn Fn(&mut Row, Along) + Sync)| -> Vec<Row> {
        let row = |places: &[Along]| {
            let mut found = Row::default();
            places.iter().for_each(|&place| look(&mut found, place));
            found
        };
        places.par_chunks(IN_ROW).map(row).collect()
    };
    let edge =
        in_rows(along(edges.all()), &|row, (at, way)| row.look_at_edge(at, way, milled, &edges, &limits));
    let tip = in_rows(along(milled.ways()), &|row, (at, _)| {
        // What lies on an edge lies on neither side of it.
        if edges.nearest(at).0 > SAME {
            row.look(at, edges.hold(at), milled, &edges, &limits);
        }
    });
    let beyond = milled.beyond(around).filter(|&(_, depth)| depth > 0.0);
    let beyond = beyond.map(|(at, by)| Off { at, by, inside: false });
    let rows = || rows.iter().chain(&edge).chain(&tip);
    carved.places = rows().map(|row| row.places).sum();
    let errors = || rows().flat_map(|row| &row.errors).copied();
    let mut off: Vec<Off> = rows().flat_map(|row| &row.off).copied().chain(beyond).collect();
    carved.over = errors().chain(off.iter().map(|off| off.by)).fold(0.0, f64::max);
    carved.under = -errors().fold(0.0, f64::min);
    off.sort_by(|a, b| b.by.abs().total_cmp(&a.by.abs()).then(a.at.0.total_cmp(&b.at.0)));
    carved.findings = findings(&off);
    carved
}

/// So many places along lines are looked at in one go. Chosen.
const IN_ROW: usize = 256;

/// So far outside an edge nothing may be milled, in nanometres. Chosen: half of what is tolerated.
const OUTSIDE: f64 = 5_000.0;

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
fn count(length: Nm, pitch: f64) -> u32 {
    (length.to_f64() / pitch).ceil() as u32
}

/// How deep the V-bit may go.
struct Limits {
    /// Half the width of its tip.
    blunt: f64,
    /// How much wider it cuts on either side for each unit of depth.
    flank: f64,
    most: f64,
    /// How deep the edges lie.
    start: f64,
    /// Whether a second tool clears what is wide.
    clears: bool,
    corner: f64,
    tolerance: f64,
}

impl Limits {
    fn new(ideal: &Ideal<'_>) -> Self {
        let Cone { blunt, flank } = ideal.v_bit.cone();
        Self {
            blunt,
            flank,
            most: ideal.most.map_or(f64::INFINITY, Nm::to_f64),
            start: ideal.start.to_f64(),
            clears: ideal.clears,
            corner: ideal.corner,
            tolerance: ideal.tolerance.to_f64(),
        }
    }

    /// How deep the tool mills at a distance from its axis, where the nearest edge is `radius` from
    /// that.
    fn at(&self, radius: f64, off: f64) -> f64 {
        let depth = (self.start + (radius - self.blunt) / self.flank).min(self.most);
        depth - (off - self.blunt).max(0.0) / self.flank
    }

    /// How far from the edges the tool is where it is as deep as it may.
    fn full(&self) -> f64 {
        self.blunt + (self.most - self.start) * self.flank
    }

    /// How deep a tool can mill beside the areas, at least: one that moves straight away from the
    /// nearest place of an edge, on its other side.
    fn reachable_beside(
        &self,
        at: Spot,
        (distance, foot): (f64, Spot),
        edges: &Edges,
        last: &mut Last,
    ) -> f64 {
        let way = ((foot.0 - at.0) / distance, (foot.1 - at.1) / distance);
        let beyond = (foot.0 + way.0, foot.1 + way.1);
        let farthest = edges.farthest(beyond, (1.0, foot), self.farthest_of(1.0), &mut last.way);
        let centers = [0.0, self.blunt.min(farthest), self.full().min(farthest), farthest];
        centers.map(|radius| self.at(radius, radius + distance)).into_iter().fold(0.0, f64::max)
    }

    /// How deep a tool can mill at a place, at least; where it is wider than the tool cuts and
    /// nothing else clears it, along the walls.
    fn reachable(&self, at: Spot, (distance, foot): (f64, Spot), edges: &Edges, last: &mut Last) -> f64 {
        let full = self.full();
        if !self.clears && distance > full {
            return self.at(full, distance - full);
        }
        let most = self.farthest_of(distance);
        let farthest = edges.farthest(at, (distance, foot), most, &mut last.way);
        if farthest < most && self.is_left_out((distance, farthest), at, foot, last) {
            return f64::NEG_INFINITY;
        }
        let centers = [farthest, full.clamp(distance, farthest), (distance + self.blunt).min(farthest)];
        centers.map(|radius| self.at(radius, radius - distance)).into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    /// The tool need go no farther from an edge to mill a place at a distance from it.
    fn farthest_of(&self, distance: f64) -> f64 {
        self.full().max(distance + self.blunt) + SAME
    }

    /// Whether the way away from `foot` ends between two edges that meet in a corner which is not
    /// entered: the normals of both, where the largest disc touches them, differ as much as they
    /// turn there.
    fn is_left_out(&self, (distance, farthest): (f64, f64), at: Spot, foot: Spot, last: &Last) -> bool {
        let Some((_, other)) = last.way.filter(|_| self.corner < 1.0) else { return false };
        let part = farthest / distance;
        let normal = ((at.0 - foot.0) * part, (at.1 - foot.1) * part);
        let across = (foot.0 + normal.0 - other.0, foot.1 + normal.1 - other.1);
        normal.0 * across.0 + normal.1 * across.1 > (self.corner - ALIKE) * farthest * farthest
    }
}

/// How much larger than that of an edge the cosine at a corner that is left out may seem. Chosen: a
/// disc that touches edges of some micrometres is known to a nanometre.
const ALIKE: f64 = 1e-3;

/// What was found at the place before, which is often found here.
#[derive(Default)]
struct Last {
    /// How far the way went, and what ended it.
    way: Option<(f64, Spot)>,
    /// Which motion milled it.
    sweep: usize,
}

/// What was found in a row of places.
#[derive(Default)]
struct Row {
    last: Last,
    places: usize,
    errors: Vec<f64>,
    off: Vec<Off>,
    left: usize,
}

impl Row {
    /// Looks at a place inside or outside the areas.
    fn look(&mut self, at: Spot, inside: bool, milled: &Surface, edges: &Edges, limits: &Limits) {
        self.places += 1;
        let depth = milled.depth_after(at, &mut self.last.sweep);
        if !inside {
            self.look_beside(at, depth, edges, limits);
            return;
        }
        let (distance, foot) = edges.nearest(at);
        let most = (limits.start + distance / limits.flank).min(limits.most);
        let mut error = depth - most;
        if error < 0.0 {
            let least = limits.reachable(at, (distance, foot), edges, &mut self.last);
            let is_off = depth < least - limits.tolerance;
            if !is_off && !limits.clears && distance > limits.full() && error < -limits.tolerance {
                self.left += 1;
                return;
            }
            error = (depth - least.max(0.0)).min(0.0);
        }
        self.errors.push(error);
        if error.abs() > limits.tolerance {
            self.off.push(Off { at, by: error, inside });
        }
    }

    /// Looks beside a place of an edge, whose areas are on the left of its way: just outside, and
    /// inside in the middle of the largest disc that touches it there.
    fn look_at_edge(
        &mut self,
        at: Spot,
        way: Option<Spot>,
        milled: &Surface,
        edges: &Edges,
        limits: &Limits,
    ) {
        let Some(way) = way else { return };
        let off = |by: f64| (at.0 - by * way.1, at.1 + by * way.0);
        let far = edges.farthest(off(1.0), (1.0, at), limits.farthest_of(1.0), &mut self.last.way);
        self.look(off(far), true, milled, edges, limits);
        // Beyond a gap that is narrower lies another area.
        if edges.nearest(off(-OUTSIDE)).0 > OUTSIDE - SAME {
            self.look(off(-OUTSIDE), false, milled, edges, limits);
        }
    }

    /// The same beside the areas, where it is milled so deep.
    fn look_beside(&mut self, at: Spot, depth: f64, edges: &Edges, limits: &Limits) {
        let mut error = depth;
        if limits.start > 0.0 {
            let (distance, foot) = edges.nearest(at);
            let most = (limits.start - distance / limits.flank).max(0.0);
            error = depth - most;
            if error < 0.0 {
                let least = limits.reachable_beside(at, (distance, foot), edges, &mut self.last);
                error = (depth - least).min(0.0);
            }
            self.errors.push(error);
        }
        if error.abs() > limits.tolerance {
            self.off.push(Off { at, by: error, inside: false });
        }
    }
}

/// What rows of a grid say of the whole.
fn sum_up(rows: &[Row], ideal: &Ideal<'_>) -> Carved {
    let pitch = ideal.pitch.to_mm();
    let left: usize = rows.iter().map(|row| row.left).sum();
    let mut errors: Vec<f64> = rows.iter().flat_map(|row| &row.errors).map(|error| error.abs()).collect();
    errors.sort_by(f64::total_cmp);
    Carved {
        p99: errors.get(errors.len() * 99 / 100).copied().unwrap_or(0.0),
        left_mm2: pitch * pitch * u32::try_from(left).map_or(f64::INFINITY, f64::from),
        ..Carved::default()
    }
}

/// A kind, which places it is said of, and what is wrong there.
type Kind = (&'static Diagnostic, fn(&Off) -> bool, &'static str);

/// The worst places of each kind, none near another.
fn findings(off: &[Off]) -> Vec<Finding> {
    let kinds: [Kind; 3] = [
        (&planning::CARVED_OUTSIDE, |off| !off.inside && off.by > 0.0, "it mills outside the areas"),
        (
            &planning::CARVED_TOO_DEEP,
            |off| off.inside && off.by > 0.0,
            "it mills deeper than the areas are wide",
        ),
        (&planning::CARVED_TOO_SHALLOW, |off| off.by < 0.0, "it leaves material that its tool could mill"),
    ];
    let mut findings = Vec::new();
    for (kind, is_one, what) in kinds {
        let mut listed: Vec<Spot> = Vec::new();
        for found in off.iter().filter(|off| is_one(off)) {
            let near = |&(x, y): &Spot| (x - found.at.0).abs().max((y - found.at.1).abs()) < APART;
            if listed.iter().any(near) {
                continue;
            }
            listed.push(found.at);
            let by = Nm::from_f64(found.by.abs());
            let message = format!("{what}, by {:.1} µm", by.to_f64() / 1_000.0);
            let at = Some(Point::from_f64(found.at.0, found.at.1));
            findings.push(Finding { at, size: Some(by), ..Finding::new(kind.code, kind.severity, message) });
            if listed.len() == MOST_LISTED {
                break;
            }
        }
    }
    findings
}
