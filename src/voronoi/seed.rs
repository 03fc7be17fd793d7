//! Features → sites: what is drawn, each with a label of its own, and who owns it.
//!
//! A label is a site, not a net: the picture then says which *feature* a pixel is nearest to, and
//! placing need not search for it. Regions are judged by owner, which many sites share.
//!
//! A polygon's ring is drawn coarser than it is, by edges that stay within an eighth of a pixel of
//! it; each such edge stands for the run of true edges that distances are measured to. So a pad
//! whose corners were flattened into a hundred edges costs a dozen.

use crate::board::{Axis, Copper, FLATTEN, Feature, Shape};
use crate::geometry::{Arc, Nm, Point, Polygon};
use crate::grid::Grid;
use crate::raster::{Caps, FillRule, Label, Scene, Sides, Spin, Surface};
use crate::topology::{Groups, NetId, Nets};

use super::certified::axis;
use super::edge::Border;
use super::plane::Spot;
use super::site::{Form, Site};
use super::{BACKGROUND, OUTSIDE, Owner, Settings, SiteKind};

/// All sites of a layer. Label 0 is the background and 1 the outside; owners count the same way,
/// nets from 2.
pub(super) struct Sites {
    pub(super) sites: Vec<Site>,
    pub(super) rings: Groups<Spot>,
    /// How far flat copper is fattened.
    pub(super) band: Nm,
}

/// The label of what lies beyond the border.
const OUTSIDE_LABEL: Label = Label(1);
/// The border lies above everything.
const OUTSIDE_DEPTH: f32 = -1.0;

/// How much the two radii of an arc may differ and still be one, in nanometres: what rounding three
/// points leaves. Chosen.
const ROUNDING: f64 = 1_000.0;

/// Edges within this of their chord, in nanometres, are as good as one. Chosen: half of it is what
/// a boundary beside them may be off.
const STRAIGHT: f64 = 500.0;
/// The sine of the most by which an arc's edges turn: 5°. Chosen.
const SMOOTH: f64 = 0.087;

/// The owner number of a net.
pub(super) const fn owner_of(net: NetId) -> u32 {
    Owner::Net(net).number()
}

impl Sites {
    /// The sites of all features whose net `keep` accepts.
    pub(super) fn new(
        copper: &Copper,
        nets: &Nets,
        settings: &Settings,
        keep: impl Fn(usize) -> bool,
    ) -> Self {
        let nobody = |form, owner| Site { form, radius: 0.0, owner, flat: false };
        let start = Spot::default();
        let mut sites = Self {
            sites: vec![nobody(Form::Point(start), BACKGROUND), nobody(Form::Outside, OUTSIDE)],
            rings: Groups::default(),
            band: settings.min_width.filter(|_| settings.sites == SiteKind::Core).unwrap_or(Nm::ZERO),
        };
        let tolerance = settings.pitch.to_f64() / 8.0;
        for (i, feature) in copper.features.iter().enumerate().filter(|(i, _)| keep(*i)) {
            let owner = owner_of(nets.of(i));
            match settings.sites {
                SiteKind::Copper => sites.add_copper(&feature.shape, owner, false, tolerance),
                SiteKind::Core => sites.add_core(feature, owner, settings.min_width.is_some(), tolerance),
            }
        }
        sites.sites.push(nobody(Form::Outside, OUTSIDE));
        sites.sites.shrink_to_fit();
        sites
    }

    /// Who owns each label.
    pub(super) fn owners(&self) -> Vec<u32> {
        self.sites.iter().map(|site| site.owner).collect()
    }

    fn push(&mut self, form: Form, radius: f64, owner: u32, flat: bool) {
        self.sites.push(Site { form, radius, owner, flat });
    }

    /// The true edge of a feature; distance 0 inside.
    fn add_copper(&mut self, shape: &Shape, owner: u32, flat: bool, tolerance: f64) {
        match shape {
            Shape::Disc { center, radius } => {
                self.push(Form::Point((*center).into()), radius.to_f64(), owner, flat)
            }
            Shape::Stroke { from, to, radius } => {
                self.push(Form::Line((*from).into(), (*to).into()), radius.to_f64(), owner, flat);
            }
            Shape::Arc { arc, radius } => self.add_arc(arc, radius.to_f64(), owner, flat),
            Shape::Polygon(polygon) => self.add_polygon(polygon, owner, flat, tolerance),
        }
    }

    /// An arc; one whose ends lie at different distances from its centre, as in sloppy files, by
    /// its chords.
    fn add_arc(&mut self, arc: &Arc, radius: f64, owner: u32, flat: bool) {
        if arc.drift() <= ROUNDING {
            return self.push(Form::arc(arc), radius, owner, flat);
        }
        let points: Vec<Spot> =
            std::iter::once(arc.start).chain(arc.flatten(FLATTEN)).map(Spot::from).collect();
        for pair in points.windows(2) {
            self.push(Form::Line(pair[0], pair[1]), radius, owner, flat);
        }
    }

    /// The paper's approximate core medial axis (§III-D), its copper above it where asked
    /// (§III-D.2).
    fn add_core(&mut self, feature: &Feature, owner: u32, min_width: bool, tolerance: f64) {
        match axis(feature) {
            Some(Axis::Flash(p)) => self.push(Form::Point(p.into()), 0.0, owner, false),
            Some(Axis::Line(a, b)) => self.push(Form::Line(a.into(), b.into()), 0.0, owner, false),
            Some(Axis::Arc(arc)) => self.add_arc(&arc, 0.0, owner, false),
            Some(Axis::Region) | None => self.add_copper(&feature.shape, owner, false, tolerance),
        }
        if min_width {
            self.add_copper(&feature.shape, owner, true, tolerance);
        }
    }

    fn add_polygon(&mut self, polygon: &Polygon, owner: u32, flat: bool, tolerance: f64) {
        let largest =
            polygon.contours().iter().map(|ring| twice_area(ring)).max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let backwards = largest.is_some_and(|area| area < 0.0);
        let inside = self.sites.len();
        let mut first_ring = None;
        self.push(Form::Inside { first_ring: 0, rings: 0 }, 0.0, owner, flat);
        for contour in polygon.contours() {
            let mut points: Vec<Spot> = contour.iter().map(|&p| p.into()).collect();
            points.dedup();
            while points.len() > 1 && points.first() == points.last() {
                points.pop();
            }
            if points.len() < 3 {
                continue;
            }
            if backwards {
                points.reverse();
            }
            let coarse = coarse(&points, tolerance);
            let count = u32::try_from(coarse.len()).expect("below 2³² vertices");
            let ring = self.rings.push(coarse);
            first_ring.get_or_insert(ring);
            for first in 0..count {
                self.push(Form::Edge { ring, first }, 0.0, owner, flat);
            }
            let first_ring = first_ring.unwrap_or(ring);
            self.sites[inside].form = Form::Inside { first_ring, rings: ring - first_ring + 1 };
        }
    }

    /// Everything as the raster draws it on `grid`.
    pub(super) fn scene(&self, grid: &Grid, border: &Border, limit: Option<f32>) -> Scene {
        let mut scene = Scene::new(grid.width(), grid.height());
        scene.set_owners(self.owners());
        scene.reserve(self.sites.len());
        let at = |spot: Spot| grid.pixel(spot.rounded());
        let contours =
            border.outside().iter().map(|ring| ring.iter().map(|&p| grid.pixel(p)).collect()).collect();
        scene
            .add(OUTSIDE_LABEL, Surface::Polygon { contours, rule: FillRule::EvenOdd, depth: OUTSIDE_DEPTH });
        for (label, site) in (0_u32..).zip(&self.sites).skip(2) {
            // A trace's own copper lies above the cones: they begin where its band ends.
            let band = grid.pixels(self.band);
            let radius = grid.pixels(Nm::from_f64(site.radius));
            let (offset, limit) = if site.flat {
                (radius, Some(band))
            } else {
                (radius - band, limit.map(|limit| limit + band))
            };
            let surface = match &site.form {
                Form::Point(apex) => Surface::Cone { apex: at(*apex), offset, limit },
                Form::Line(a, b) => Surface::Curtain {
                    from: at(*a),
                    to: at(*b),
                    caps: Caps::Both,
                    sides: Sides::Both,
                    offset,
                    limit,
                },
                Form::Arc { center, from, to } => Surface::Ring {
                    center: at(*center),
                    start: at(*from),
                    end: at(*to),
                    spin: Spin::CounterClockwise,
                    caps: Caps::Both,
                    offset,
                    limit,
                },
                Form::Edge { ring, first } if !site.flat || band > 0.0 => {
                    let vertices = self.rings.of(*ring as usize);
                    let first = *first as usize;
                    let (from, to) = (at(vertices[first]), at(vertices[(first + 1) % vertices.len()]));
                    Surface::Curtain { from, to, caps: Caps::Start, sides: Sides::Both, offset, limit }
                }
                Form::Inside { first_ring, rings } => {
                    let ring = |ring: u32| self.rings.of(ring as usize).iter().map(|&p| at(p)).collect();
                    let contours = (*first_ring..first_ring + rings).map(ring).collect();
                    Surface::Polygon { contours, rule: FillRule::NonZero, depth: 0.0 }
                }
                Form::Edge { .. } | Form::Outside => continue,
            };
            scene.add(Label(label), surface);
        }
        scene
    }
}

/// Twice the signed area of a ring, in nm².
fn twice_area(ring: &[Point]) -> f64 {
    let origin = Spot::from(ring[0]);
    let spots = || ring.iter().map(|&p| Spot::from(p) - origin);
    spots().zip(spots().cycle().skip(1)).map(|(a, b)| a.cross(b)).sum()
}

/// Those vertices of a ring whose chords all others are within `tolerance` of.
fn coarse(ring: &[Spot], tolerance: f64) -> Vec<Spot> {
    let n = ring.len();
    let mut kept = Vec::new();
    let mut first = 0;
    // Three chords at least: a chord must not stand for a whole ring.
    let most = (n / 3).clamp(1, 64);
    while first < n {
        let mut count = 1;
        while count < most && first + count < n && is_chord(ring, first, count + 1, tolerance) {
            count += 1;
        }
        kept.push(ring[first]);
        first += count;
    }
    kept
}

/// Whether so many edges may be drawn as one: they stay within `tolerance` of it and bend all one
/// way, as the edges of an arc do, or leave it next to nowhere. Beside others a boundary has
/// corners, which two labels must tell of.
fn is_chord(ring: &[Spot], first: usize, count: usize, tolerance: f64) -> bool {
    let vertex = |i: usize| ring[(first + i) % ring.len()];
    let (a, b) = (vertex(0), vertex(count));
    let off = (1..count).map(|i| vertex(i).distance_to_chord(a, b)).fold(0.0, f64::max);
    let turn = |i: usize| {
        let (before, after) = (vertex(i) - vertex(i - 1), vertex(i + 1) - vertex(i));
        before.cross(after) / (before.length() * after.length())
    };
    let is_arc = || {
        let way = turn(1).signum();
        (1..count).all(|i| (0.0..=SMOOTH).contains(&(turn(i) * way)))
    };
    off <= tolerance && (off <= STRAIGHT || is_arc())
}
