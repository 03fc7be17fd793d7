//! What artwork becomes programs of: its areas, one program for each tool, and what they have in
//! common.

use crate::board::Warning;
use crate::board::diagnostic::count;
use crate::board::polarity::difference;
use crate::gcode::{self, Header, Input};
use crate::geometry::{Nm, Point, Polygon, Rect};
use crate::grid::Grid;
use crate::report::relief::{Material, Relief};
use crate::toolpath::{Placement, Program, Section, Statistics, ToolKind, measure};
use crate::verify::carving::{self, Text};
use crate::verify::{Cutter, CutterKind, Finding};

use super::pipeline::GENERATOR;
use super::stock::zero;
use super::{Error, Length, Settings};

/// What is milled.
#[derive(Clone, Debug, Default)]
pub struct Art {
    /// What it is called.
    pub name: String,
    /// Its areas, simple polygons.
    pub areas: Vec<Polygon>,
    /// The files it was read from.
    pub inputs: Vec<Input>,
    /// What reading it had to warn of.
    pub warnings: Vec<Warning>,
}

/// A program with one tool.
#[derive(Clone, Debug)]
pub struct OneTool {
    /// What its file's name ends in; empty for the V-bit's, and for a pocket's one tool.
    pub tag: String,
    /// What was planned.
    pub program: Program,
    /// What it amounts to.
    pub statistics: Statistics,
    /// What the machine reads.
    pub text: String,
}

/// No pass takes less. Chosen: what machines repeat, and what a cutter takes off that does not rub.
const THINNEST: Nm = Nm::from_um(10);

/// Fails for passes that take too little.
///
/// # Errors
///
/// [`Error::Value`] where they do.
pub(super) fn judge_pass(step: Option<Nm>) -> Result<(), Error> {
    let Some(step) = step.filter(|&step| step < THINNEST) else { return Ok(()) };
    let problem = if step <= Nm::ZERO {
        "a pass depth of zero is invalid: it must be above zero".to_owned()
    } else {
        let [step, least] = [step, THINNEST].map(Length);
        format!(
            "{step} is less than {least}: so thin a pass rubs and does not cut, and a program of them has no end"
        )
    };
    Err(Error::Value { key: "depth-pass", problem })
}

/// What lies round the areas in a picture. Chosen: a little of the top.
const MARGIN: Nm = Nm::from_mm(2);

/// What lies round areas, up to `margin` from the rectangle that holds them.
pub(super) fn round(areas: &[Polygon], margin: Nm) -> Vec<Polygon> {
    let bounds = areas.iter().map(Polygon::bounds).reduce(Rect::union);
    let frame = bounds.map(|bounds| Polygon::rectangle(bounds.inflate(margin)));
    frame.map_or_else(Vec::new, |frame| difference(&frame, areas))
}

/// What is narrower than this, in the mean of its length, is a sliver. Chosen: no drawing means
/// what is narrower than a micrometre, but rounding leaves such.
const SLIVER: Nm = Nm::from_um(1);

/// Areas without those that are slivers and without islands in them that are: what lies between
/// the two edges of one is no wider than coordinates are apart, and no axis tells them.
pub(super) fn without_slivers(areas: &[Polygon]) -> Vec<Polygon> {
    let is_wide = |ring: &&Vec<Point>| {
        let ring = Polygon::new(vec![(*ring).clone()]);
        ring.is_some_and(|ring| 2e12 * ring.area_mm2().abs() >= ring.perimeter() * SLIVER.to_f64())
    };
    let kept = |area: &Polygon| {
        let rings = area.contours().iter().filter(is_wide).cloned().collect();
        Some(Polygon::new(rings)?.of_circles(area.circles().iter().copied()))
    };
    areas.iter().filter_map(kept).collect()
}

/// Shapes lie no farther from zero than this, in their file and on the machine. Derived: what is
/// worked out round them stays in the range of [`Nm`].
const FARTHEST: Nm = Nm::from_mm(1050);

/// Areas on the machine, and how they are placed there.
///
/// # Errors
///
/// [`Error::NoArea`] where there is none to `mill`, [`Error::Beyond`] for what lies too far out.
pub(super) fn on_machine(
    areas: &[Polygon],
    settings: &Settings,
    mill: &'static str,
) -> Result<(Vec<Polygon>, Placement), Error> {
    let around = |areas: &[Polygon]| areas.iter().map(Polygon::bounds).reduce(Rect::union);
    let bounds = around(areas).ok_or(Error::NoArea(mill))?;
    let placement = Placement::front(settings.origin, bounds, settings.asked.rotate, settings.offset);
    let placed = |area: &Polygon| {
        let rings = area.contours().iter().map(|ring| ring.iter().map(|&p| placement.point(p)).collect());
        Polygon::new(rings.collect()).expect("as many corners as before")
    };
    let areas: Vec<Polygon> = areas.iter().map(placed).collect();
    let farthest = |bounds: Rect| {
        let (least, most) = (bounds.min(), bounds.max());
        [least.x, least.y, most.x, most.y].into_iter().map(Nm::abs).max().unwrap_or_default()
    };
    let reach = around(&areas).into_iter().chain([bounds]).map(farthest).max().unwrap_or_default();
    if reach > FARTHEST { Err(Error::Beyond { reach, most: FARTHEST }) } else { Ok((areas, placement)) }
}

/// Has findings that are where the machine has them lie where the drawing does, too.
pub(super) fn on_drawing(findings: &mut [Finding], undo: impl Fn(Point) -> Point) {
    for finding in findings {
        finding.on_machine = finding.at;
        finding.at = finding.at.map(&undo);
    }
}

/// A section as a program of its own: what its file's name ends in, what it does, the number of its
/// tool, and the settings that its header says.
pub(super) fn written(
    art: &Art,
    (tag, what, number): (&str, &str, u32),
    section: Section,
    settings: &Settings,
    said: Vec<(String, String)>,
) -> (OneTool, Vec<Warning>) {
    let mut program = Program {
        title: format!("{} {what}", art.name),
        notes: vec![zero(settings, "material")],
        safe: settings.safe,
        sections: vec![section],
    };
    let mut warnings = settings.machine.restrain(&mut program);
    program.sections[0].tool.number = number;
    let [change, end] = settings.parking();
    let (statistics, text, warning) = program.while_parking(change, end, |program| {
        let statistics = measure(program, &settings.machine);
        let header = Header {
            generator: GENERATOR.to_owned(),
            inputs: art.inputs.clone(),
            settings: said,
            seconds: Some(statistics.seconds),
        };
        let text = gcode::write(program, &settings.dialect, &header);
        (statistics, text, program.check_travel(&settings.machine))
    });
    warnings.extend(warning);
    (OneTool { tag: tag.to_owned(), program, statistics, text }, warnings)
}

/// The programs as the judge takes them.
pub(super) fn texts(programs: &[OneTool]) -> Vec<Text<'_>> {
    fn text(one: &OneTool) -> Text<'_> {
        let kind = one.program.sections[0].tool.kind;
        Text { file: &one.program.title, text: &one.text, cutter: cutter(kind) }
    }
    programs.iter().map(text).collect()
}

/// Programs of files, each with its name, in place of those that were made.
pub(super) fn others<'a>(programs: &[OneTool], texts: &[(&'a str, &'a str)]) -> Result<Vec<Text<'a>>, Error> {
    if texts.len() != programs.len() {
        let problem =
            format!("expected a program for each of {} tools, but there are {}", programs.len(), texts.len());
        return Err(Error::Value { key: "check", problem });
    }
    let cutters = programs.iter().map(|one| cutter(one.program.sections[0].tool.kind));
    Ok(texts.iter().zip(cutters).map(|(&(file, text), cutter)| Text { file, text, cutter }).collect())
}

/// What programs mill of areas, as a picture at a slant: a PNG so many pixels wide.
pub(super) fn picture(programs: &[OneTool], areas: &[Polygon], width: u32) -> Result<Vec<u8>, Error> {
    let milled = carving::milled(&texts(programs))?;
    let around = areas.iter().map(Polygon::bounds).reduce(Rect::union);
    let around = around.ok_or_else(|| Error::NoCopper("to show".to_owned()))?.inflate(MARGIN);
    let pitch = around.width() / i64::from(width.max(1)) + Nm::new(1);
    let depths = |grid: &Grid| milled.depths(grid);
    Ok(Relief::new(depths, milled.deepest(), (around, pitch), Material::Wood)?.png())
}

/// What programs do, a line for each; `files` are what they are called, in the same order, as far
/// as they are written.
pub(super) fn lines(programs: &[OneTool], files: &[String]) -> String {
    let line = |(index, OneTool { program, statistics, .. }): (usize, &OneTool)| {
        let Statistics { cut_length, retracts, seconds, .. } = statistics;
        let file = files.get(index).map_or(String::new(), |file| format!("{file}, "));
        let (tool, retracts) = (
            program.sections[0].tool.kind,
            count(usize::try_from(*retracts).unwrap_or(usize::MAX), "retract"),
        );
        let time = crate::toolpath::duration(*seconds);
        format!("  {file}{tool}: {:.1} mm cut, {retracts}, {time}\n", cut_length.to_mm())
    };
    programs.iter().enumerate().map(line).collect()
}

/// The tool as the judge sees it.
pub(super) fn cutter(kind: ToolKind) -> Cutter {
    match kind {
        ToolKind::VBit { tip, angle } => Cutter { kind: CutterKind::VBit, tip, degrees: angle.degrees() },
        ToolKind::EndMill { diameter } => Cutter { kind: CutterKind::EndMill, tip: diameter, degrees: 0.0 },
        ToolKind::Drill { diameter } => Cutter { kind: CutterKind::Drill, tip: diameter, degrees: 0.0 },
    }
}
