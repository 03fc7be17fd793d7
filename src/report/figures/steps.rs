//! Figures 2 and 3: how traces are put together, and curves at a distance.

use crate::board::{Axis, Copper, Feature, Shape, polarity};
use crate::geometry::{Nm, Path, Point, Polygon, Rect, Turn};
use crate::grid::Grid;
use crate::report::translucent::Translucent;
use crate::report::{Canvas, Rgb};
use crate::topology::{self, Method, Nets};

use super::FigureError;
use super::painting::Painting;
use super::regions::{LIGHT, axes};

/// Pixels that each one shown is the mean of, in a row. Chosen: smooth edges.
const FINER: u32 = 3;
const WHITE: Rgb = Rgb(0xff, 0xff, 0xff);
const BLACK: Rgb = Rgb(0x14, 0x14, 0x18);
const GREY: Rgb = Rgb(0xd9, 0xdb, 0xe0);
const SHARED: Rgb = Rgb(0xd2, 0x2f, 0x3a);
/// Traces in the order of the file.
const TRACES: [Rgb; 6] = [LIGHT[0], LIGHT[1], LIGHT[2], LIGHT[3], LIGHT[4], LIGHT[5]];

fn grid(bounds: Rect, columns: u32) -> Result<Grid, FigureError> {
    let bounds = bounds.inflate(Nm::from_um(600));
    Ok(Grid::covering(bounds, bounds.width() / i64::from(columns * FINER) + Nm::new(1))?)
}

fn bounds(copper: &Copper) -> Result<Rect, FigureError> {
    copper.bounds().ok_or(FigureError::NoCopper)
}

/// Figure 2: strokes and flashes with their vertices, those that are shared in red; and the traces
/// that Algorithm 1 makes of them.
pub(super) fn shared_vertices(copper: &Copper, columns: u32) -> Result<Painting, FigureError> {
    let traces = topology::recover(copper, Method::Coincidence);
    let before = pieces(copper, grid(bounds(copper)?, columns)?, |_| GREY);
    let after = pieces(copper, grid(bounds(copper)?, columns)?, |index| colour(&traces, index));
    Ok(Painting::beside(&[before, after], 30))
}

/// Features in their colours with thin edges, their axes and vertices.
fn pieces(copper: &Copper, grid: Grid, colour: impl Fn(usize) -> Rgb) -> Painting {
    let pitch = grid.pitch();
    let mut canvas = Canvas::new(grid, WHITE);
    canvas.fill(copper.shapes().zip(0..).map(|(shape, index)| (shape, colour(index))));
    for feature in &copper.features {
        canvas.strokes(&edges(&feature.shape), pitch * 3, BLACK.towards(WHITE, 120), 1.0);
    }
    axes(&mut canvas, copper, pitch * 5, BLACK);
    let mut vertices: Vec<Point> = copper.features.iter().flat_map(ends).collect();
    vertices.sort_unstable();
    for run in vertices.chunk_by(|a, b| a == b) {
        let disc = |radius| Shape::Disc { center: run[0], radius };
        canvas.fill([(&disc(pitch * 15), BLACK)]);
        canvas.fill([(&disc(pitch * 11), if run.len() > 1 { SHARED } else { WHITE })]);
    }
    Painting::of(canvas).smaller(FINER as usize)
}

/// The vertices of a feature: what Algorithm 1 looks at.
fn ends(feature: &Feature) -> Vec<Point> {
    match feature.axis {
        Axis::Flash(center) => vec![center],
        Axis::Line(from, to) => vec![from, to],
        Axis::Arc(arc) => vec![arc.start, arc.end],
        Axis::Region => Vec::new(),
    }
}

fn colour(traces: &Nets, feature: usize) -> Rgb {
    TRACES[traces.of(feature).index() % TRACES.len()]
}

/// The outlines of a shape.
fn edges(shape: &Shape) -> Vec<Path> {
    rings(shape.polygon(Nm::from_um(5)).iter())
}

fn rings<'a>(polygons: impl Iterator<Item = &'a Polygon>) -> Vec<Path> {
    let rings = polygons.flat_map(Polygon::contours);
    rings.filter_map(|ring| Path::polyline(ring.iter().copied().chain([ring[0]]))).collect()
}

/// Figure 3, left: what Algorithm 1 leaves apart; translucent, with the picks; and put together.
pub(super) fn overlaps(copper: &Copper, columns: u32) -> Result<Painting, FigureError> {
    let traces = topology::recover(copper, Method::Coincidence);
    let apart = pieces(copper, grid(bounds(copper)?, columns)?, |index| colour(&traces, index));
    let grid = grid(bounds(copper)?, columns)?;
    let found = topology::by_translucency(copper);
    let mut seen = Translucent::new(copper, grid.pitch() * i64::from(FINER))?.draw(grid);
    for overlap in &found.overlaps {
        seen.strokes(
            &[Path::circle(overlap.at, grid.pitch() * 24, Turn::CounterClockwise)],
            grid.pitch() * 5,
            WHITE,
            1.0,
        );
    }
    let seen = Painting::of(seen).smaller(FINER as usize);
    let nets = found.nets;
    let together = pieces(copper, grid, |index| colour(&nets, index));
    Ok(Painting::beside(&[apart, seen, together], 24))
}

/// Figure 3, right: the edge of copper and curves at `distances` from it, with what a curve would
/// be that did not know of its crossings, in red.
pub(super) fn offsets(copper: &Copper, distances: &[Nm], columns: u32) -> Result<Painting, FigureError> {
    let farthest = distances.iter().copied().max().unwrap_or(Nm::ZERO);
    let grid = grid(bounds(copper)?.inflate(farthest), columns)?;
    let pitch = grid.pitch();
    let polygons: Vec<Polygon> =
        copper.features.iter().filter_map(|feature| feature.shape.polygon(Nm::from_um(2))).collect();
    let union = polarity::union(&polygons);
    let mut canvas = Canvas::new(grid, WHITE);
    let areas: Vec<Shape> = union.iter().cloned().map(Shape::Polygon).collect();
    canvas.fill(areas.iter().map(|area| (area, GREY)));
    for &distance in distances {
        for ring in union.iter().flat_map(Polygon::contours) {
            canvas.strokes(naive(ring, distance).iter(), pitch * 3, SHARED.towards(WHITE, 90), 1.0);
        }
    }
    for &distance in distances {
        let grown: Vec<Polygon> =
            union.iter().flat_map(|polygon| polarity::offset(polygon, distance, Nm::from_um(1))).collect();
        canvas.strokes(&rings(polarity::union(&grown).iter()), pitch * 5, Rgb(0x1f, 0x5f, 0xa8), 1.0);
    }
    canvas.strokes(&rings(union.iter()), pitch * 7, BLACK, 1.0);
    Ok(Painting::of(canvas).smaller(FINER as usize))
}

/// The ring moved along its normals by `distance`, corner by corner, whatever it then crosses.
fn naive(ring: &[Point], distance: Nm) -> Option<Path> {
    let count = ring.len();
    let mut points = Vec::with_capacity(count * 2);
    for i in 0..count {
        let (a, b) = (ring[i].to_f64(), ring[(i + 1) % count].to_f64());
        let (x, y) = (b.0 - a.0, b.1 - a.1);
        let far = distance.to_f64() / (x * x + y * y).sqrt().max(f64::MIN_POSITIVE);
        let moved = |p: (f64, f64)| Point::from_f64(p.0 + y * far, p.1 - x * far);
        points.extend([moved(a), moved(b)]);
    }
    let first = *points.first()?;
    Path::polyline(points.into_iter().chain([first]))
}
