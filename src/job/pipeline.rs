//! The whole job as one function: a board and settings in, programs and findings out.

use rayon::prelude::*;

use crate::board::diagnostic::planning;
use crate::board::{Board, Hole, Side, Source, Warning, Words};
use crate::gcode::dialect::ToolChange;
use crate::gcode::{Header, Input};
use crate::geometry::Nm;
use crate::import::{Loaded, diagnostic};
use crate::report::stages::Stages;
use crate::toolpath::strategy::{Cutout, Tabs, cutout, drill, drilled};
use crate::toolpath::{Placement, Program, Section};
use crate::topology::{self, Electrical};

use super::ignore::ignore;
use super::rivet::rivet;
use super::stock::{Stock, is_flipped, zero};
use super::{Error, Layer, Narrow, Part, Settings, Written, effect, numbering, room, tag};

/// What made the outputs.
pub(super) const GENERATOR: &str = concat!("voromill ", env!("CARGO_PKG_VERSION"));

/// A board with everything that was made of it.
pub struct Job {
    /// The board.
    pub board: Board,
    /// The files it was read from.
    pub sources: Vec<Source>,
    /// Files and folders beside them that are no layer of a board.
    pub ignored: Vec<String>,
    /// How it lies on the machine, seen from the front.
    pub placement: Placement,
    /// The line about which it is flipped, in machine coordinates.
    pub axis: Nm,
    /// Its sides, front first.
    pub layers: Vec<Layer>,
    /// The nets of the assembled board; none where it has one side.
    pub electrical: Option<Electrical>,
    /// The programs, in the order they are run.
    pub programs: Vec<Written>,
    /// What a person must know, from reading to cutting out.
    pub warnings: Vec<Warning>,
    /// Where the time went.
    pub stages: Stages,
}

/// Does all there is to do to a board.
///
/// # Errors
///
/// [`Error`] if there is neither copper nor an outline nor a hole, a file was cut off, or a side
/// cannot be isolated.
pub fn mill(loaded: Loaded, settings: &Settings) -> Result<Job, Error> {
    make(loaded, None, settings)
}

/// Isolates one side of a board alone, where its zero is that of all of it.
///
/// # Errors
///
/// As [`mill`].
pub fn mill_side(loaded: Loaded, side: Side, settings: &Settings) -> Result<Job, Error> {
    make(loaded, Some(side), settings)
}

fn make(loaded: Loaded, side: Option<Side>, settings: &Settings) -> Result<Job, Error> {
    let Loaded { mut board, sources, mut warnings, ignored } = loaded;
    refuse_cut_off(&warnings)?;
    if !settings.asked.ignore.is_empty() {
        warnings.extend(ignore(&mut board, &settings.asked.ignore, settings.asked.topology));
    }
    if let Some(wider) = settings.rivet
        && rivet(&mut board, wider) == 0
    {
        let warning = planning::RIVET_WITHOUT_HOLE.warning("no hole of the board is plated");
        warnings.push(warning.so(Words::of("{rivet} has no effect")));
    }
    if let Some(side) = side {
        board.leave_copper(side);
    }
    if settings.alignment.is_some() && !is_flipped(&board, settings) {
        let warning = planning::PINS_WITHOUT_FLIP.warning("nothing is milled with the back up");
        warnings.push(warning.so(Words::of("{alignment-holes} has no effect")));
    }
    let bounds = board.bounds().ok_or_else(|| no_copper(settings))?;
    let stock = Stock::new(bounds, settings);
    let mut stages = Stages::default();
    let (layers, sections): (Vec<Layer>, Vec<Vec<Section>>) =
        isolate(&board, &stock, settings)?.into_iter().unzip();
    layers.iter().for_each(|layer| stages.extend(&layer.stages));
    if settings.asked.narrow == Narrow::Error {
        refuse_narrow(&layers)?;
    }
    let header = header(&sources);
    let mut planned: Vec<(Part, Side, Program)> = Vec::new();
    if let Some((program, found)) = stock.alignment(&board, settings) {
        planned.push((Part::Alignment, Side::Front, program));
        warnings.extend(found);
    }
    let idle = effect::tools(&sections, settings);
    planned.extend(layers.iter().zip(sections).flat_map(|(layer, sections)| {
        let files = in_files(isolation(layer, sections, &board, settings), settings);
        files.into_iter().map(|program| (Part::of(layer.side), layer.side, program))
    }));
    let sides = layers.iter().filter_map(|layer| Some((board.copper(layer.side)?, &layer.nets)));
    warnings.extend(effect::patterns(sides, settings));
    warnings.extend(effect::areas(&board, &settings.clearing));
    warnings.extend(idle);
    warnings.extend(layers.iter().flat_map(|layer| layer.warnings.iter().cloned()));
    if !board.holes.is_empty() {
        let side = settings.drill_side;
        let placement = stock.placement(side);
        let (sections, found) = stages.run(
            "drilling",
            || drill(&board.holes, &settings.drilling_at(&placement)),
            |_| [("holes", board.holes.len())],
        );
        let drilling = turned(whole("drill", &board, sections, settings), &placement);
        let drilling = Program { safe: settings.drilling.safe, ..drilling };
        let files = in_files(drilling, settings);
        planned.extend(files.into_iter().map(|program| (Part::Drill, side, program)));
        warnings.extend(found);
    }
    if let Some(outline) = &board.outline {
        let side = settings.cutout_side;
        let placement = stock.placement(side);
        let (section, found) = stages.run(
            "cutout",
            || {
                let drilled = drilled(&board.holes, &settings.drilling_at(&placement));
                cutout(outline, &cutout_settings(&placement, &drilled, settings))
            },
            |(section, _)| [("moves", section.moves.len())],
        );
        let program = turned(whole("cutout", &board, vec![section], settings), &placement);
        planned.push((Part::Cutout, side, program));
        warnings.extend(found);
    }
    room::check(&planned, &stock, settings)?;
    warnings.extend(restrained(planned.iter_mut().map(|(.., program)| program), settings));
    numbering::number(planned.iter_mut().map(|(.., program)| program), &settings.options().tools);
    let tags = tag::tags(&planned, settings);
    let write = |((part, side, program), tag): ((Part, Side, Program), String)| {
        let tiling = stock.tiling(side).filter(|_| part != Part::Alignment);
        Written::new((part, side, tag), program, &header, tiling, settings)
    };
    let programs: Vec<Written> = stages.run(
        "writing programs",
        || planned.into_par_iter().zip(tags).map(write).collect(),
        |programs: &Vec<Written>| {
            [("bytes", programs.iter().map(|program| program.text.len()).sum()), ("programs", programs.len())]
        },
    );
    warnings.extend(programs.iter().filter_map(|program| program.warning.clone()));
    if board.outline.is_none() && !warnings.iter().any(|warning| warning.kind.is_of_the_outline()) {
        warnings.push(planning::OUTLINE_MISSING.warning("no outline was given, so the board is not cut out"));
    }
    if settings.options().blend.is_some() && settings.dialect.blend.is_none() {
        let message = format!("{} has no path blending (G64 P)", settings.dialect.name);
        let warning = planning::BLEND_UNKNOWN.warning(message);
        warnings.push(warning.so(Words::of("{blend} has no effect")));
    }
    let electrical = stages.run("nets of the assembled board", || electrical(&board, &layers), |_| []);
    warnings.extend(electrical.iter().flat_map(Electrical::check));
    let (placement, axis) = (stock.front, stock.axis);
    Ok(Job { board, sources, ignored, placement, axis, layers, electrical, programs, warnings, stages })
}

/// Fails for a file that was cut off.
pub(super) fn refuse_cut_off(warnings: &[Warning]) -> Result<(), Error> {
    let Some(cut_off) = warnings.iter().find(|warning| warning.is(&diagnostic::TRUNCATED_FILE)) else {
        return Ok(());
    };
    let place =
        cut_off.source.as_ref().map_or(String::new(), |s| format!("{}:{}:{}: ", s.file, s.line, s.column));
    Err(Error::Truncated(format!("{place}{}", cut_off.message)))
}

/// Lowers what programs ask of the machine to what it can do; what is said of several programs is
/// said once.
fn restrained<'a>(programs: impl Iterator<Item = &'a mut Program>, settings: &Settings) -> Vec<Warning> {
    let mut warnings: Vec<Warning> = Vec::new();
    for warning in programs.flat_map(|program| settings.machine.restrain(program)) {
        if warnings.iter().all(|other| other.text() != warning.text()) {
            warnings.push(warning);
        }
    }
    warnings
}

/// Both sides at once.
fn isolate(board: &Board, stock: &Stock, settings: &Settings) -> Result<Vec<(Layer, Vec<Section>)>, Error> {
    let sides: Vec<_> = [Side::Front, Side::Back].into_iter().filter_map(|side| board.copper(side)).collect();
    let copper = sides.iter().filter(|copper| !copper.features.is_empty());
    // A board without copper is drilled and cut out; one whose copper is all left out is a mistake.
    let is_bare = sides.is_empty() && (board.outline.is_some() || !board.holes.is_empty());
    if copper.count() == 0 && !is_bare {
        return Err(no_copper(settings));
    }
    let isolate = |copper: &&_| {
        let copper: &crate::board::Copper = copper;
        Layer::isolate(copper, board, stock.placement(copper.side), settings)
    };
    sides.par_iter().filter(|copper| !copper.features.is_empty()).map(isolate).collect()
}

fn no_copper(settings: &Settings) -> Error {
    let place = if settings.asked.ignore.is_empty() { "in these files" } else { "beside what is ignored" };
    Error::NoCopper(place.to_owned())
}

/// Fails for the first gap that the cut does not fit.
fn refuse_narrow(layers: &[Layer]) -> Result<(), Error> {
    let warnings = layers.iter().flat_map(|layer| &layer.warnings);
    let narrow: Vec<&Warning> =
        warnings.filter(|warning| warning.is(&planning::GAP_NARROWER_THAN_TOOL)).collect();
    let Some(first) = narrow.first() else { return Ok(()) };
    let side = first.side.map_or(String::new(), |side| format!("{side}: "));
    // What would have been done, the outcome, is not what is done.
    let gap = &first.message;
    let place = first
        .at
        .map_or(String::new(), |at| format!(" at x = {:.3} mm, y = {:.3} mm of the files", at.x, at.y));
    let more = match narrow.len() - 1 {
        0 => String::new(),
        1 => ", and at one more place".to_owned(),
        more => format!(", and at {more} more places"),
    };
    Err(Error::Narrow(format!("{side}{gap}{place}{more}")))
}

fn isolation(layer: &Layer, sections: Vec<Section>, board: &Board, settings: &Settings) -> Program {
    let side = layer.side;
    turned(whole(&format!("{side} isolation"), board, sections, settings), &layer.placement)
}

/// The program with a note where the board is flipped for it.
fn turned(mut program: Program, placement: &Placement) -> Program {
    if let Some(axis) = placement.mirror {
        program.notes.push(format!("mirrored left to right about the vertical line x = {axis:.3} mm"));
    }
    program
}

/// A program, or one for each tool where the machine wants each in a file of its own.
fn in_files(program: Program, settings: &Settings) -> Vec<Program> {
    if settings.dialect.tool_change == ToolChange::Files { program.by_tool() } else { vec![program] }
}

fn whole(what: &str, board: &Board, sections: Vec<Section>, settings: &Settings) -> Program {
    Program {
        title: format!("{} {what}", board.name),
        notes: vec![zero(settings, "copper")],
        safe: settings.safe,
        sections,
    }
}

fn cutout_settings<'a>(placement: &'a Placement, drilled: &'a [Hole], settings: &'a Settings) -> Cutout<'a> {
    Cutout {
        tool: &settings.cutout_tool,
        heights: settings.cutout,
        placement,
        tabs: Tabs { places: settings.tabs.places(), width: settings.tab_width, top: settings.tab_top },
        ramp: settings.cutout_ramp,
        direction: settings.asked.direction,
        drilled,
    }
}

/// What every program says of itself.
pub(super) fn header(sources: &[Source]) -> Header {
    let used = sources.iter().filter(|source| !source.role.starts_with("ignored"));
    let input = |source: &Source| Input { file: source.file.clone(), design: source.design.clone() };
    // A KiCad board is one file for both sides, the edge and the holes.
    let mut inputs: Vec<Input> = used.map(input).collect();
    inputs.dedup();
    Header { generator: GENERATOR.to_owned(), inputs, settings: Vec::new(), seconds: None }
}

fn electrical(board: &Board, layers: &[Layer]) -> Option<Electrical> {
    let side = |side: Side| {
        let layer = layers.iter().find(|layer| layer.side == side)?;
        Some((board.copper(side)?, &layer.nets))
    };
    let (front, back) = (side(Side::Front), side(Side::Back));
    (front.is_some() && back.is_some()).then(|| topology::electrical(front, back, &board.holes))
}
