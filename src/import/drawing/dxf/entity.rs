//! Entities → figures: what each of them draws, on which layer.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::curve::{Ellipse, Spline, ahead, bulge, radians};
use super::file::{Dxf, Entity};
use super::frame::Frame;
use super::hatch;
use super::pairs::NoNumber;
use super::vertex::{Beyond, Vertex};
use super::wide;
use crate::artwork::{Area, Drawn, Figure, Line};
use crate::board::polarity::{FillRule, Polarity};
use crate::geometry::{Nm, Path};
use crate::import::drawing::Contour;
use crate::import::drawing::layers::Layers;

/// How deep inserts may lie in each other. Chosen: drawings nest a handful.
const DEEPEST: usize = 24;

/// The most entities, inserted ones each time they are, and the most lines and arcs of them all.
/// Chosen: some hundred megabytes of them.
const MOST: usize = 2_000_000;
const MOST_STEPS: usize = 4_000_000;

/// Why a drawing is not read.
#[derive(Debug)]
pub(super) enum Refusal {
    NoNumber(NoNumber),
    /// A place beyond the range of coordinates, drawn by the entity at a byte.
    Beyond(usize),
    TooMany,
}

impl From<NoNumber> for Refusal {
    fn from(error: NoNumber) -> Self {
        Self::NoNumber(error)
    }
}

/// What was drawn.
#[derive(Debug, Default)]
pub(super) struct Sheet {
    pub(super) layers: Layers,
    /// What was not, by what it is.
    pub(super) left_out: BTreeMap<String, u64>,
    drawn: usize,
    steps: usize,
}

/// Where an entity stands.
#[derive(Clone)]
struct Scope {
    frame: Frame,
    /// The layer of the insert, which what is on layer 0 of a block takes.
    layer: String,
    /// The blocks that it lies in.
    within: Vec<String>,
}

/// The figures of all entities.
pub(super) fn drawn(dxf: &Dxf<'_>, nanometres: f64) -> Result<Sheet, Refusal> {
    let mut drawn = Sheet::default();
    let scope = Scope { frame: Frame::scale(nanometres), layer: "0".to_owned(), within: Vec::new() };
    for entity in &dxf.entities {
        if entity.whole(67)? == 1 {
            drawn.leave("entities in paper space");
            continue;
        }
        drawn.entity(dxf, entity, &scope)?;
    }
    Ok(drawn)
}

impl Sheet {
    fn leave(&mut self, what: &str) {
        *self.left_out.entry(what.to_owned()).or_insert(0) += 1;
    }

    fn entity(&mut self, dxf: &Dxf<'_>, entity: &Entity<'_>, scope: &Scope) -> Result<(), Refusal> {
        self.drawn += 1;
        if self.drawn > MOST {
            return Err(Refusal::TooMany);
        }
        let layer = Some(entity.layer()).filter(|layer| layer != "0").unwrap_or_else(|| scope.layer.clone());
        if dxf.hidden.contains(&layer.to_uppercase()) || entity.whole(60)? == 1 {
            self.leave("entities that are invisible or on a layer that is off or frozen");
            return Ok(());
        }
        let Some(frame) = frame(entity, &scope.frame)? else {
            self.leave("entities that are tilted out of the XY plane");
            return Ok(());
        };
        if entity.kind == "INSERT" {
            return self.insert(dxf, entity, &frame, layer, &scope.within);
        }
        if entity.kind == "HATCH" && entity.whole(70)? == 0 {
            self.leave("hatch patterns, which are filled solid instead");
        }
        let figures = match made(entity, &frame, &scope.frame)? {
            Ok(figures) if figures.is_empty() => {
                self.leave(&format!("{} of zero length", entity.kind));
                return Ok(());
            }
            Ok(figures) => figures,
            Err(what) => {
                self.leave(what);
                return Ok(());
            }
        };
        for figure in figures {
            let drawn = figure.map_err(|Beyond| Refusal::Beyond(entity.at))?;
            let figure = Figure { drawn, polarity: Polarity::Dark, line: entity.line };
            self.steps += steps(&figure);
            if self.steps > MOST_STEPS {
                return Err(Refusal::TooMany);
            }
            self.layers.of(&layer).push(figure);
        }
        Ok(())
    }

    /// All that a block draws, as often as the insert says.
    fn insert(
        &mut self,
        dxf: &Dxf<'_>,
        entity: &Entity<'_>,
        frame: &Frame,
        layer: String,
        within: &[String],
    ) -> Result<(), Refusal> {
        for part in &entity.parts {
            self.leave(&part.kind);
        }
        let name = entity.text(2).unwrap_or_default().to_ascii_uppercase();
        let Some(block) = dxf.blocks.get(&name) else {
            self.leave("inserts of a missing block");
            return Ok(());
        };
        if within.len() >= DEEPEST || within.contains(&name) {
            self.leave("inserts of a block into itself");
            return Ok(());
        }
        let within = [within, &[name]].concat();
        let at = entity.point(10)?;
        let scale = (entity.real_or(41, 1.0)?, entity.real_or(42, 1.0)?);
        let angle = entity.real_or(50, 0.0)?;
        let (columns, rows) = (entity.whole(70)?.max(1), entity.whole(71)?.max(1));
        let (across, up) = (entity.real_or(44, 0.0)?, entity.real_or(45, 0.0)?);
        let (sin, cos) = libm::sincos(radians(angle));
        // Each copy takes time, whatever is in it.
        let copies = usize::try_from(columns.saturating_mul(rows)).unwrap_or(usize::MAX);
        self.drawn = self.drawn.saturating_add(copies);
        if self.drawn > MOST {
            return Err(Refusal::TooMany);
        }
        for row in 0..rows {
            for column in 0..columns {
                #[expect(clippy::cast_precision_loss, reason = "at most two million")]
                let (dx, dy) = (column as f64 * across, row as f64 * up);
                let place = (at.0 + dx * cos - dy * sin, at.1 + dx * sin + dy * cos);
                let frame = frame.inserted(place, scale, angle, block.base);
                let scope = Scope { frame, layer: layer.clone(), within: within.clone() };
                for entity in &block.entities {
                    self.entity(dxf, entity, &scope)?;
                }
            }
        }
        Ok(())
    }
}

/// Of how many lines and arcs a figure is made.
fn steps(figure: &Figure) -> usize {
    let painted = match &figure.drawn {
        Drawn::Line(line) => line.painted.as_ref().map_or(&[][..], |area| &area.contours),
        Drawn::Area(_) => &[],
    };
    figure.paths().iter().chain(painted).map(|path| path.segments.len()).sum()
}

/// The frame of an entity that lies in the plane: seen from the front or from behind; none where it
/// is tilted (DXF Reference, *Arbitrary Axis Algorithm*).
fn frame(entity: &Entity<'_>, frame: &Frame) -> Result<Option<Frame>, NoNumber> {
    let (x, y) = (entity.real_or(210, 0.0)?, entity.real_or(220, 0.0)?);
    let z = entity.real_or(230, 1.0)?;
    if x.abs().max(y.abs()) > 1e-6 * z.abs() {
        return Ok(None);
    }
    Ok(Some(if z < 0.0 { frame.mirrored() } else { *frame }))
}

/// A bare line along a path.
fn bare(contour: Contour) -> Result<Drawn, Beyond> {
    let path = contour.finish().ok_or(Beyond)?;
    Ok(Drawn::Line(Line { path, width: Nm::ZERO, painted: None }))
}

type Made = Vec<Result<Drawn, Beyond>>;

/// What an entity draws, `frame` being that of what lies in a plane of its own and `world` that of
/// the rest; or what it is, where it draws nothing.
fn made<'a>(entity: &'a Entity<'_>, frame: &Frame, world: &Frame) -> Result<Result<Made, &'a str>, NoNumber> {
    let is_closed = entity.whole(70)? & 1 == 1;
    Ok(match entity.kind.as_str() {
        "LINE" => Ok(line(entity, world)?),
        "CIRCLE" | "ARC" => Ok(vec![arc(entity, frame)?]),
        "LWPOLYLINE" => Ok(polyline(&vertices(entity)?, is_closed, frame)),
        "POLYLINE" => {
            let vertices = old_vertices(entity)?;
            vertices.map(|vertices| polyline(&vertices, is_closed, frame)).ok_or("meshes")
        }
        "ELLIPSE" => Ok(vec![ellipse(entity, world)?]),
        "SPLINE" => {
            let figure = spline(entity, world)?;
            figure.map(|figure| vec![figure]).ok_or("invalid splines")
        }
        "SOLID" | "TRACE" => Ok(vec![solid(entity, frame)?]),
        "HATCH" => {
            let area = hatch::area(entity, frame)?;
            area.map(|area| vec![area.map(Drawn::Area)]).ok_or("hatches without a boundary")
        }
        other => Err(other),
    })
}

/// None of no length: what climbs is seen from above.
fn line(entity: &Entity<'_>, frame: &Frame) -> Result<Made, NoNumber> {
    let (from, to) = (frame.place(entity.point(10)?), frame.place(entity.point(11)?));
    let mut contour = Contour::new(from);
    contour.line(to);
    Ok(vec![bare(contour)].into_iter().filter(|made| !is_point(made)).collect())
}

fn is_point(made: &Result<Drawn, Beyond>) -> bool {
    matches!(made, Ok(Drawn::Line(line)) if line.path.segments.is_empty())
}

fn arc(entity: &Entity<'_>, frame: &Frame) -> Result<Result<Drawn, Beyond>, NoNumber> {
    let (center, radius) = (entity.point(10)?, entity.real_or(40, 0.0)?);
    let (from, to) = if entity.kind == "ARC" {
        (radians(entity.real_or(50, 0.0)?), radians(entity.real_or(51, 0.0)?))
    } else {
        (0.0, 0.0)
    };
    Ok(followed(&Ellipse::arc(center, radius, from, to), frame))
}

fn followed(ellipse: &Ellipse, frame: &Frame) -> Result<Drawn, Beyond> {
    let mut contour = Contour::new(frame.place(ellipse.start()));
    ellipse.follow(frame, &mut contour);
    if ellipse.sweep.abs() >= TAU - 1e-12 {
        contour.close();
    }
    bare(contour)
}

fn ellipse(entity: &Entity<'_>, frame: &Frame) -> Result<Result<Drawn, Beyond>, NoNumber> {
    let (center, major) = (entity.point(10)?, entity.point(11)?);
    let ratio = entity.real_or(40, 1.0)?;
    let (from, to) = (entity.real_or(41, 0.0)?, entity.real_or(42, TAU)?);
    // The minor axis is to the left of the major one, seen from where the extrusion points.
    let side = if entity.real_or(230, 1.0)? < 0.0 { -ratio } else { ratio };
    let minor = (-major.1 * side, major.0 * side);
    Ok(followed(&Ellipse { center, axes: (major, minor), from, sweep: ahead(from, to) }, frame))
}

fn spline(entity: &Entity<'_>, frame: &Frame) -> Result<Option<Result<Drawn, Beyond>>, NoNumber> {
    let controls = entity.points(10)?;
    let is_closed = entity.whole(70)? & 1 == 1;
    if controls.is_empty() {
        let mut fits = entity.points(11)?;
        fits.dedup();
        if fits.len() < 2 {
            return Ok(None);
        }
        let mut contour = Contour::new(frame.place(fits[0]));
        for [_, a, b, end] in Spline::through(&fits) {
            contour.cubic(frame.place(a), frame.place(b), frame.place(end));
        }
        if is_closed {
            contour.close();
        }
        return Ok(Some(bare(contour)));
    }
    let spline = Spline {
        degree: usize::try_from(entity.whole(71)?).unwrap_or(0),
        knots: entity.reals(40)?,
        controls,
        weights: entity.reals(41)?,
    };
    if !spline.is_sound() {
        return Ok(None);
    }
    let mut contour = Contour::new(frame.place(spline.start()));
    spline.follow(frame, &mut contour);
    if is_closed {
        contour.close();
    }
    Ok(Some(bare(contour)))
}

/// Four corners in the order of the letter Z.
fn solid(entity: &Entity<'_>, frame: &Frame) -> Result<Result<Drawn, Beyond>, NoNumber> {
    let mut corners = vec![entity.point(10)?, entity.point(11)?, entity.point(12)?];
    if entity.real(13)?.is_some() {
        corners.insert(2, entity.point(13)?);
    }
    let mut contour = Contour::new(frame.place(corners[0]));
    corners[1..].iter().for_each(|&corner| contour.line(frame.place(corner)));
    contour.close();
    let area = |path: Path| Drawn::Area(Area { contours: vec![path], rule: FillRule::NonZero });
    Ok(contour.finish().map(area).ok_or(Beyond))
}

fn vertices(entity: &Entity<'_>) -> Result<Vec<Vertex>, NoNumber> {
    let width = entity.real_or(43, 0.0)?;
    let mut vertices: Vec<Vertex> = Vec::new();
    for pair in entity.pairs() {
        if pair.code == 10 {
            vertices.push(Vertex { at: (pair.real()?, 0.0), widths: (width, width), bulge: 0.0 });
        }
        let Some(vertex) = vertices.last_mut() else { continue };
        match pair.code {
            20 => vertex.at.1 = pair.real()?,
            40 => vertex.widths.0 = pair.real()?,
            41 => vertex.widths.1 = pair.real()?,
            42 => vertex.bulge = pair.real()?,
            _ => {}
        }
    }
    Ok(vertices)
}

/// The corners of a polyline of the old kind, those of a spline's frame left out; none of a mesh.
fn old_vertices(entity: &Entity<'_>) -> Result<Option<Vec<Vertex>>, NoNumber> {
    /// Group code 70 of POLYLINE in the DXF reference: a 3D polygon mesh, a polyface mesh.
    const MESH: i64 = 16 | 64;
    /// Group code 70 of VERTEX in the DXF reference: a control point of a spline's frame.
    const FRAME: i64 = 16;
    if entity.whole(70)? & MESH != 0 {
        return Ok(None);
    }
    let widths = (entity.real_or(40, 0.0)?, entity.real_or(41, 0.0)?);
    let mut vertices = Vec::new();
    for part in entity.parts.iter().filter(|part| part.kind == "VERTEX") {
        if part.whole(70)? & FRAME != 0 {
            continue;
        }
        vertices.push(Vertex {
            at: part.point(10)?,
            bulge: part.real_or(42, 0.0)?,
            widths: (part.real_or(40, widths.0)?, part.real_or(41, widths.1)?),
        });
    }
    Ok(Some(vertices))
}

/// A polyline as one line, or where it is wide as what it covers along its middle.
fn polyline(vertices: &[Vertex], is_closed: bool, frame: &Frame) -> Made {
    let Some(first) = vertices.first() else { return Vec::new() };
    let mut contour = Contour::new(frame.place(first.at));
    let next = vertices.iter().skip(1).chain(is_closed.then_some(first));
    for (from, to) in vertices.iter().zip(next) {
        bulge(frame, &mut contour, from.at, to.at, from.bulge);
    }
    let widest = vertices.iter().map(|vertex| vertex.widths.0.max(vertex.widths.1)).fold(0.0, f64::max);
    let made = contour.finish().ok_or(Beyond).and_then(|path| {
        if widest <= 0.0 {
            return Ok(Drawn::Line(Line { path, width: Nm::ZERO, painted: None }));
        }
        let contours = wide::contours(vertices, is_closed, frame).ok_or(Beyond)?;
        let painted = Some(Area { contours, rule: FillRule::NonZero });
        Ok(Drawn::Line(Line { path, width: Nm::from_f64(widest * frame.mean()), painted }))
    });
    vec![made].into_iter().filter(|made| !is_point(made)).collect()
}
