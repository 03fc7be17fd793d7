//! What the paper gave to its GPU: 16 corners to a circle, and the core axes as triangles that
//! slope away from the viewer (§III-D).
//!
//! ```text
//!        ╲  fan ╱                 beside every stroke a quad on either hand, sloping at 45°; where strokes turn away from each
//!   ══════◉─────                  other by more than half a turn, a fan of triangles of at most 22.5° between the quads; at a
//!    quad  ╲                      loose end that is half a turn. A flash that no stroke meets has a fan all round: a cone.
//!     ══════╲
//! ```
//!
//! Where a stroke was drawn twice, the program paired it with its double and left both without fans
//! at their common ends. That costs one net of dataset 6 a ninth of its region, so it is done here,
//! too.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::board::{Axis, Copper, Feature, Shape};
use crate::geometry::{Arc, Nm, Point, Rect};
use crate::grid::Grid;
use crate::raster::{FillRule, Label, PixelPoint, Scene, Surface, mesh};
use crate::topology::{NetId, Nets};
use crate::voronoi::certified;
use crate::voronoi::plane::Spot;

/// The label of the frame.
const FRAME: Label = Label(1);
/// The label of the first net.
pub(super) const FIRST: u32 = 2;
/// The paper's depths, nearest first: frame, copper, meshes from zero down.
const FRAME_DEPTH: f32 = -2.0;
const COPPER_DEPTH: f32 = -1.0;
/// How far meshes reach: the default of the paper's program, an inch.
const REACH: Nm = Nm::new(25_400_000);
/// Corners of a circle, and sides of a cone, as in the paper's program.
const CORNERS: u32 = 16;
/// The widest triangle of a fan: a sixteenth of a turn.
const STEP: f64 = PI / 8.0;
/// Arcs become strokes of this angle, as in the paper's program.
const ARC_STEP: f64 = PI / 128.0;

/// A layer as the paper draws it.
pub(super) struct Mesh<'a> {
    pub(super) copper: &'a Copper,
    pub(super) nets: &'a Nets,
    pub(super) grid: Grid,
    /// How far slopes reach.
    reach: Nm,
}

/// What a net's axes are made of: strokes by their ends, and points where no stroke ends.
#[derive(Default)]
struct Skeleton {
    strokes: Vec<(Point, Point)>,
    flashes: Vec<Point>,
}

impl<'a> Mesh<'a> {
    pub(super) const fn new(copper: &'a Copper, nets: &'a Nets, grid: Grid) -> Self {
        Self { copper, nets, grid, reach: REACH }
    }

    /// The slopes of a net's axes alone, as far as `reach`.
    pub(super) fn slopes(self, net: NetId, reach: Nm) -> Vec<Surface> {
        let skeletons = self.skeletons();
        let mesh = Self { reach, ..self };
        skeletons.get(&net.0).map_or_else(Vec::new, |skeleton| mesh.skeleton(skeleton))
    }

    /// The copper alone.
    pub(super) fn outline(&self) -> Scene {
        let mut scene = Scene::new(self.grid.width(), self.grid.height());
        for (index, feature) in self.copper.features.iter().enumerate() {
            let label = self.label(index);
            for contours in flat(feature) {
                let contours =
                    contours.into_iter().map(|ring| ring.into_iter().map(|p| self.at(p)).collect()).collect();
                scene.add(label, Surface::Polygon { contours, rule: FillRule::NonZero, depth: COPPER_DEPTH });
            }
        }
        scene
    }

    /// The copper above the meshes of the axes, below what lies beyond `board`.
    pub(super) fn voronoi(&self, board: Option<Rect>) -> Scene {
        let mut scene = self.outline();
        for (net, skeleton) in self.skeletons() {
            let label = Label(net + FIRST);
            for surface in self.skeleton(&skeleton) {
                scene.add(label, surface);
            }
        }
        if let Some(board) = board {
            let ring = |rect: Rect| rect.corners().map(|p| self.grid.pixel(p)).to_vec();
            let contours = vec![ring(self.grid.rect().inflate(REACH)), ring(board)];
            scene.add(FRAME, Surface::Polygon { contours, rule: FillRule::EvenOdd, depth: FRAME_DEPTH });
        }
        scene
    }

    fn label(&self, feature: usize) -> Label {
        Label(self.nets.of(feature).0 + FIRST)
    }

    fn at(&self, spot: Spot) -> PixelPoint {
        self.grid.pixel(spot.rounded())
    }

    /// The axes of every net that has some; a region's are its edges.
    fn skeletons(&self) -> BTreeMap<u32, Skeleton> {
        let mut skeletons: BTreeMap<u32, Skeleton> = BTreeMap::new();
        for (index, feature) in self.copper.features.iter().enumerate() {
            let skeleton = skeletons.entry(self.nets.of(index).0).or_default();
            match certified::axis(feature) {
                Some(Axis::Flash(center)) => skeleton.flashes.push(center),
                Some(Axis::Line(from, to)) if from == to => skeleton.flashes.push(from),
                Some(Axis::Line(from, to)) => skeleton.strokes.push((from, to)),
                Some(Axis::Arc(arc)) => skeleton.strokes.extend(chords(&arc)),
                Some(Axis::Region) | None => skeleton.strokes.extend(edges(&feature.shape)),
            }
        }
        skeletons
    }

    fn skeleton(&self, skeleton: &Skeleton) -> Vec<Surface> {
        let mut surfaces = Vec::new();
        let mut ways: BTreeMap<Point, Vec<f64>> = BTreeMap::new();
        for &(from, to) in &skeleton.strokes {
            let way = Spot::from(to) - Spot::from(from);
            let angle = libm::atan2(way.y, way.x);
            ways.entry(from).or_default().push(angle);
            ways.entry(to).or_default().push(turned(angle, PI));
            for side in [PI / 2.0, -PI / 2.0] {
                surfaces.extend(self.quad(from.into(), to.into(), angle + side));
            }
        }
        for (&vertex, angles) in &ways {
            let angles = single(angles);
            for (i, &from) in angles.iter().enumerate() {
                let to = angles.get(i + 1).copied().unwrap_or(angles[0] + 2.0 * PI);
                surfaces.extend(self.fan(vertex.into(), from + PI / 2.0, to - PI / 2.0));
            }
        }
        let reach = f64::from(self.grid.pixels(self.reach));
        // A hair more than the error of 16 sides, so that rounding does not make them 17.
        let error = reach * (1.0 - libm::cos(PI / f64::from(CORNERS))) * (1.0 + 1e-9);
        for &flash in skeleton.flashes.iter().filter(|flash| !ways.contains_key(flash)) {
            surfaces.extend(mesh::cone(self.grid.pixel(flash), reach, error));
        }
        surfaces
    }

    /// The slope beside a stroke, towards `angle`.
    fn quad(&self, from: Spot, to: Spot, angle: f64) -> [Surface; 2] {
        let (near, far) = (self.slope(from, angle), self.slope(to, angle));
        let (from, to) = ((self.at(from), 0.0), (self.at(to), 0.0));
        [triangle([from, to, far]), triangle([from, far, near])]
    }

    /// The slopes round a vertex from one direction to another, counter-clockwise.
    fn fan(&self, vertex: Spot, from: f64, to: f64) -> Vec<Surface> {
        let span = to - from;
        if span <= 1e-9 {
            return Vec::new();
        }
        let steps = (span / STEP - 1e-9).ceil().max(1.0);
        let mut surfaces = Vec::new();
        let mut step = 0.0;
        while step < steps {
            let corner = |step: f64| self.slope(vertex, from + span * step / steps);
            surfaces.push(triangle([(self.at(vertex), 0.0), corner(step), corner(step + 1.0)]));
            step += 1.0;
        }
        surfaces
    }

    /// The far end of a slope that begins at `from`, with its depth.
    fn slope(&self, from: Spot, angle: f64) -> (PixelPoint, f32) {
        let (sin, cos) = libm::sincos(angle);
        (self.at(from + Spot::new(cos, sin) * self.reach.to_f64()), self.grid.pixels(self.reach))
    }
}

fn triangle(corners: [(PixelPoint, f32); 3]) -> Surface {
    Surface::Triangle { corners: corners.map(|corner| corner.0), depths: corners.map(|corner| corner.1) }
}

/// The angles that occur once, in order.
fn single(angles: &[f64]) -> Vec<f64> {
    let mut sorted = angles.to_vec();
    sorted.sort_by(f64::total_cmp);
    let same = |a: f64, b: f64| (a - b).abs() < 1e-9;
    sorted.chunk_by(|&a, &b| same(a, b)).filter(|run| run.len() == 1).map(|run| run[0]).collect()
}

/// An angle turned by another, within half a turn of zero.
fn turned(angle: f64, by: f64) -> f64 {
    let turned = angle + by;
    if turned > PI { turned - 2.0 * PI } else { turned }
}

/// The polygons of a feature's copper: curves by 16 corners.
fn flat(feature: &Feature) -> Vec<Vec<Vec<Spot>>> {
    match &feature.shape {
        Shape::Disc { center, radius } => vec![vec![circle(*center, *radius)]],
        Shape::Stroke { from, to, radius } => stroke(*from, *to, *radius),
        Shape::Arc { arc, radius } => {
            chords(arc).into_iter().flat_map(|(from, to)| stroke(from, to, *radius)).collect()
        }
        Shape::Polygon(polygon) => {
            let ring = |ring: &Vec<Point>| ring.iter().map(|&p| p.into()).collect();
            vec![polygon.contours().iter().map(ring).collect()]
        }
    }
}

/// A circle of 16 corners, the first to the right.
fn circle(center: Point, radius: Nm) -> Vec<Spot> {
    let corner = |i: u32| {
        let (sin, cos) = libm::sincos(2.0 * PI * f64::from(i) / f64::from(CORNERS));
        Spot::from(center) + Spot::new(cos, sin) * radius.to_f64()
    };
    (0..CORNERS).map(corner).collect()
}

/// A stroke as the paper has it: a rectangle, and the aperture at either end.
fn stroke(from: Point, to: Point, radius: Nm) -> Vec<Vec<Vec<Spot>>> {
    let (a, b) = (Spot::from(from), Spot::from(to));
    let way = b - a;
    let out = Spot::new(-way.y, way.x) * (radius.to_f64() / way.length().max(f64::MIN_POSITIVE));
    let back = out * -1.0;
    vec![
        vec![circle(from, radius)],
        vec![vec![a + out, a + back, b + back, b + out]],
        vec![circle(to, radius)],
    ]
}

/// An arc as strokes of 1.4°, their ends on whole nanometres.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
fn chords(arc: &Arc) -> Vec<(Point, Point)> {
    let steps = (arc.sweep().abs() / ARC_STEP).ceil().max(1.0) as u32;
    let ends: Vec<Point> = std::iter::once(arc.start).chain(arc.parts(steps)).collect();
    ends.windows(2).map(|pair| (pair[0], pair[1])).filter(|(from, to)| from != to).collect()
}

/// The edges of a polygon, or none.
fn edges(shape: &Shape) -> Vec<(Point, Point)> {
    match shape {
        Shape::Polygon(polygon) => polygon.edges().filter(|(a, b)| a != b).collect(),
        Shape::Disc { .. } | Shape::Stroke { .. } | Shape::Arc { .. } => Vec::new(),
    }
}
