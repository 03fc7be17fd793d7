//! What is left of the copper that was to be cleared, where a tool fits.
//!
//! ```text
//!   ▓▓▓▓▓▓▓▓│   ·   the middle of the cutter stays half its kerf from copper, on the board; all that is as near to where it
//!     net   │╎  ·   may be as the cutter is wide at the copper's bottom can be cleared: an opening, by exact booleans
//!   ▓▓▓▓▓▓▓▓│       of polygons. What of it was asked for and is not swept is left, row by row.
//! ```
//!
//! Neither the planner nor the diagram has a part in it.

use rayon::prelude::*;

use crate::board::polarity::{clean, common, difference, offset, remainder, union};
use crate::board::{FLATTEN, Feature, Shape};
use crate::geometry::{Nm, Point, Polygon};
use crate::topology::NetId;

use super::asked::{Asked, meant};
use super::machining::{Kerf, with_radius};
use super::region::region;
use super::runs::{Piece, Sweep, Sweeps, left};
use super::sheet::Sheet;

/// A strip between two cuts that is half as wide again is none, and copper is cleared to within
/// as much of where it could be. Chosen: twice what cuts are off at most.
const SLACK: Nm = Nm::from_um(5);

/// How far the rows are apart that are looked at. Chosen: the width of the narrowest strip that
/// counts.
const PITCH: f64 = 10_000.0;

/// Where the middle of a tool has less room, in mm², it is not asked to go: 10 µm each way. Chosen:
/// what it clears there is a crumb.
const SPECK: f64 = 1e-4;

/// What is no wider than twice this has no room for a middle. Chosen: growing a polygon leaves
/// spikes of some nanometres at corners with edges as short.
const SPIKE: Nm = Nm::from_um(1);

/// Arcs become chords within this of them. Chosen: a tenth of [`SLACK`].
const CHORD: Nm = Nm::new(500);

/// What tools can clear of a sheet, and what they do.
pub(super) struct Cleared<'a> {
    sheet: &'a Sheet<'a>,
    asked: &'a Asked,
    board: Vec<Polygon>,
    /// Of each tool, where its middle may be.
    middles: Vec<(Kerf, Vec<Polygon>)>,
    /// Copper with the slope that the flattest of several V-bits leaves beside it: that a steeper
    /// one would leave less is no reason to go round everything with that, too.
    slopes: Vec<Polygon>,
    swept: Sweeps,
}

impl<'a> Cleared<'a> {
    /// Of a sheet of which `asked` was asked for.
    pub(super) fn new(sheet: &'a Sheet<'a>, asked: &'a Asked) -> Self {
        let board = board(sheet);
        let kerfs = sheet.kerfs.par_iter();
        let middles = kerfs.map(|&kerf| (kerf, middle(sheet, asked, &board, kerf))).collect();
        let slopes = slopes(sheet, slack(asked));
        Self { sheet, asked, board, middles, slopes, swept: Sweeps::new(sweeps(sheet)) }
    }

    /// What is left of the areas and regions that were to be cleared.
    pub(super) fn left_of_areas(&self) -> Vec<Piece> {
        let Self { sheet, asked, .. } = self;
        if asked.everything {
            return self.left_of(&self.board, None);
        }
        let mut areas = asked.areas.clone();
        let nets = meant(asked.nets.iter(), sheet.copper, &sheet.nets);
        if !nets.is_empty() {
            areas.extend(region(sheet, &nets, sheet.floor));
        }
        let areas = union(&areas);
        self.left_of(&areas, Some(&areas))
    }

    /// What is left within a distance of some nets.
    pub(super) fn left_round(&self, nets: &[NetId], distance: Nm) -> Vec<Piece> {
        let Self { sheet, .. } = self;
        let features = nets.iter().flat_map(|net| &sheet.nets.nets()[net.index()].features);
        let shapes = features.map(|&feature| &sheet.copper.features[feature as usize].shape);
        let round: Vec<Polygon> = shapes.flat_map(|shape| grown(shape, distance - SLACK)).collect();
        self.left_of(&union(&round), None)
    }

    /// What is left of areas where a tool clears them whose middle is in `within`, if that is said.
    fn left_of(&self, areas: &[Polygon], within: Option<&[Polygon]>) -> Vec<Piece> {
        let slack = self.slack();
        let wide: Vec<Polygon> = self
            .middles
            .par_iter()
            .flat_map_iter(|(kerf, middle)| {
                let middle = within.map_or_else(|| middle.clone(), |within| common(middle, within));
                let roomy = middle.iter().flat_map(|part| offset(part, -SPIKE, FLATTEN));
                let roomy = roomy.filter(|part| part.area_mm2() > SPECK);
                roomy.flat_map(|part| offset(&part, kerf.floor - slack + SPIKE, FLATTEN)).collect::<Vec<_>>()
            })
            .collect();
        let wanted = common(&common(&union(&wide), areas), &self.board);
        let wanted = if self.slopes.is_empty() { wanted } else { remainder(&wanted, &self.slopes) };
        left(&wanted, &self.swept, 0.0, PITCH)
    }

    fn slack(&self) -> Nm {
        slack(self.asked)
    }
}

/// How much is allowed for.
fn slack(asked: &Asked) -> Nm {
    SLACK.max(asked.tolerance * 2)
}

/// The board; without an outline the hull of its copper.
fn board(sheet: &Sheet<'_>) -> Vec<Polygon> {
    if let Some(outline) = &sheet.outline {
        return clean(outline.contours());
    }
    let shapes = sheet.copper.features.iter().filter_map(|feature| feature.shape.polygon(FLATTEN));
    let points: Vec<Point> = shapes.flat_map(|polygon| polygon.contours().concat()).collect();
    Polygon::hull(points).into_iter().collect()
}

/// Where the middle of a tool may be.
fn middle(sheet: &Sheet<'_>, asked: &Asked, board: &[Polygon], kerf: Kerf) -> Vec<Polygon> {
    let away = kerf.half + slack(asked);
    let mut walls: Vec<Polygon> =
        sheet.copper.features.par_iter().flat_map_iter(|feature| grown(&feature.shape, away)).collect();
    walls.extend(union(&asked.kept).iter().flat_map(|kept| offset(kept, away, FLATTEN)));
    let walls = union(&walls);
    board.iter().flat_map(|board| difference(board, &walls)).collect()
}

/// What the slopes of V-bits leave beside copper, where tools are not all alike in that, with so
/// much to spare.
fn slopes(sheet: &Sheet<'_>, slack: Nm) -> Vec<Polygon> {
    let wide = || sheet.kerfs.iter().map(|kerf| kerf.half - kerf.floor);
    let (Some(steepest), Some(flattest)) = (wide().min(), wide().max()) else { return Vec::new() };
    if steepest == flattest {
        return Vec::new();
    }
    let grown = |feature: &Feature| grown(&feature.shape, flattest + slack);
    union(&sheet.copper.features.par_iter().flat_map_iter(grown).collect::<Vec<_>>())
}

/// A shape grown by so much.
fn grown(shape: &Shape, by: Nm) -> Vec<Polygon> {
    match *shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => {
            with_radius(shape, radius + by).polygon(FLATTEN).into_iter().collect()
        }
        Shape::Polygon(ref polygon) => {
            clean(polygon.contours()).iter().flat_map(|part| offset(part, by, FLATTEN)).collect()
        }
    }
}

/// What is swept at the copper's bottom, a little wider: what is left between is no strip.
fn sweeps(sheet: &Sheet<'_>) -> Vec<Sweep> {
    let mut sweeps = Vec::with_capacity(sheet.cuts.len());
    for swept in sheet.cuts.iter().map(|cut| cut.swept) {
        let radius = (swept.floor + SLACK / 2).to_f64();
        let mut add = |from: Point, to: Point| {
            let order = sweeps.len();
            sweeps.push(Sweep { from: from.to_f64(), to: to.to_f64(), radius, depth: 1.0, order });
        };
        match &swept.shape {
            Shape::Disc { center, .. } => add(*center, *center),
            Shape::Stroke { from, to, .. } => add(*from, *to),
            Shape::Arc { arc, .. } => {
                let mut from = arc.start;
                for to in arc.flatten(CHORD) {
                    add(from, to);
                    from = to;
                }
            }
            Shape::Polygon(_) => {}
        }
    }
    sweeps
}
