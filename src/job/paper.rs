//! The figures of the paper's Table V for one side, its own way and by exact boundaries.

use std::time::Instant;

use crate::board::{Board, Copper, Side};
use crate::gcode;
use crate::geometry::{Nm, Path};
use crate::report::figures::flat;
use crate::report::paper::{Columns, PaperEntry, Paths};
use crate::report::{Canvas, Rgb};
use crate::topology::{self, Method, Nets, Sampling};
use crate::voronoi::paper::{Paper, Toolpaths, mean_width};
use crate::voronoi::{self, Diagram, Frame};

use super::{Error, Settings};

/// The figures of the paper's Table V for a side, its own way and by exact boundaries; none where
/// there is no copper.
///
/// # Errors
///
/// [`Error`] for a board too large to be drawn.
pub fn paper(board: &Board, side: Side) -> Result<Option<PaperEntry>, Error> {
    let Some(copper) = board.copper(side) else { return Ok(None) };
    let started = Instant::now();
    let coincident = topology::recover(copper, Method::Coincidence);
    let nets = topology::translucency(copper, &coincident, Sampling::default())?.nets;
    let overlap = started.elapsed();
    let Some(drawn) = Paper::new(copper, &nets)? else { return Ok(None) };
    let started = Instant::now();
    let voronoi = drawn.voronoi();
    let toolpaths = started.elapsed();
    let strokes = drawn.stroke_lengths();
    Ok(Some(PaperEntry {
        coincident: coincident.nets().len(),
        traces: nets.nets().len(),
        area_in2: drawn.board().width().to_f64() * drawn.board().height().to_f64() / (INCH * INCH),
        overlap_s: overlap.as_secs_f64(),
        toolpaths_s: toolpaths.as_secs_f64(),
        frame_in: drawn.lap() / INCH,
        paper: Columns {
            outline: paths(drawn.outline()),
            voronoi: paths(voronoi),
            normal_width_in: mean_width(&drawn.copper_areas(), &strokes) / INCH,
            voronoi_width_in: mean_width(&drawn.region_areas(), &strokes) / INCH,
        },
        exact: exact(copper, &nets, &drawn, &strokes)?,
    }))
}

/// What the paper's program makes of a side: traces by Algorithms 1 and 2, paths from its picture.
fn traces(copper: &Copper) -> Result<Nets, Error> {
    let coincident = topology::recover(copper, Method::Coincidence);
    Ok(topology::translucency(copper, &coincident, Sampling::default())?.nets)
}

/// The G-code that the paper's program writes for a side; none where there is no copper.
///
/// # Errors
///
/// [`Error`] for a board too large to be drawn.
pub fn paper_program(board: &Board, side: Side, settings: &Settings) -> Result<Option<String>, Error> {
    let Some(copper) = board.copper(side) else { return Ok(None) };
    let nets = traces(copper)?;
    Ok(Paper::new(copper, &nets)?
        .map(|paper| gcode::paper::program(paper.paths(settings.asked.strategy.paper()))))
}

/// The picture from which the paper's program takes its paths, a colour for each net and the paths
/// in black; none where there is no copper.
///
/// # Errors
///
/// [`Error`] for a board too large to be drawn.
pub fn paper_picture(board: &Board, side: Side, settings: &Settings) -> Result<Option<Canvas>, Error> {
    let Some(copper) = board.copper(side) else { return Ok(None) };
    let nets = traces(copper)?;
    let Some(paper) = Paper::new(copper, &nets)? else { return Ok(None) };
    let way = settings.asked.strategy.paper();
    let (grid, labels) = paper.labels(way);
    let owners: Vec<u32> = labels.into_iter().map(|label| label.saturating_sub(1)).collect();
    let mut canvas = flat(&owners, grid);
    let lines: Vec<Path> = paper.paths(way).into_iter().filter_map(Path::polyline).collect();
    canvas.strokes(&lines, Nm::ZERO, Rgb(0, 0, 0), 1.0);
    Ok(Some(canvas))
}

/// An inch in nanometres.
const INCH: f64 = 25_400_000.0;

fn paths(toolpaths: Toolpaths) -> Paths {
    let Toolpaths { paths, raw, simplified, segments } = toolpaths;
    Paths { paths, staircase_in: Some(raw / INCH), length_in: simplified / INCH, segments }
}

/// The same by exact boundaries: copper edges as sites, and the frame where the paper has it.
fn exact(copper: &Copper, nets: &Nets, drawn: &Paper<'_>, strokes: &[f64]) -> Result<Columns, Error> {
    let trace = |limit: Option<Nm>, margin: Nm| -> Result<_, Error> {
        let settings =
            voronoi::Settings { limit, frame: Frame::Rectangle(margin), ..voronoi::Settings::default() };
        let found = Diagram::new(copper, nets, None, &settings).and_then(|diagram| diagram.boundaries());
        found.map_err(|reason| Error::Voronoi { side: copper.side, reason })
    };
    let (outline, regions) = (trace(Some(Nm::ZERO), Nm::from_mm(1))?, trace(None, Nm::ZERO)?);
    let width = |found: &voronoi::Boundaries| mean_width(&found.areas(strokes.len()), strokes) / INCH;
    let columns = |found: &voronoi::Boundaries, lap: f64| {
        let cut = || found.edges.iter().filter(|edge| !edge.is_border());
        Paths {
            paths: cut().count(),
            staircase_in: None,
            length_in: (found.length() + lap) / INCH,
            segments: cut().map(|edge| edge.path.segments.len()).sum(),
        }
    };
    Ok(Columns {
        outline: columns(&outline, 0.0),
        voronoi: columns(&regions, drawn.lap()),
        normal_width_in: width(&outline),
        voronoi_width_in: width(&regions),
    })
}
