//! Artwork → the program that carves it, and what that does.

use crate::board::diagnostic::planning;
use crate::board::polarity::offset;
use crate::board::{Warning, Words};
use crate::geometry::{Nm, Point, Polygon, Rect};
use crate::report::stages::Stages;
use crate::toolpath::strategy;
use crate::toolpath::{Angle, Heights, Order, Placement, Section, Tool, ToolKind};
use crate::verify::carving::{self, Carved, Ideal, Text};
use crate::voronoi::medial::{Interior, MedialAxis, Pruning, insets};

use super::art::{self, Art, OneTool, judge_pass, on_machine, round, without_slivers, written};
use super::{Error, Reach, Settings};

/// How it is carved.
#[derive(Clone, Debug, PartialEq)]
pub struct Carving {
    /// No deeper than this; none for as deep as the areas are wide.
    pub max_depth: Option<Nm>,
    /// How much one pass takes; none for all at once.
    pub step: Option<Nm>,
    /// Branches into corners that turn by less are left out.
    pub corner: Angle,
    /// Carve what lies round the areas, up to so far from them, and leave them standing.
    pub raised: Option<Nm>,
    /// The end mill that clears what is too wide at the most depth.
    pub flat: Option<Tool>,
    /// Which half of an inlay it is; none for what is no inlay.
    pub inlay: Option<Inlay>,
}

/// A half of an inlay. Both are carved with the same V-bit to the same most depth, D.
///
/// ```text
///   ▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒▒    the ground round the plug, g above the surface
///   ═══════╲▒▒▒▒▒▒▒▒▒▒▒▒╱═══════    surface of the pocket: here the plug has the edges of the areas
///           ╲▒▒▒▒▒▒▒▒▒▒╱
///            ╲▔▔▔▔▔▔▔▔╱             top of the plug, D − g deep
///             ╲▁▁▁▁▁▁╱              floor of the pocket, D deep
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inlay {
    /// The pocket.
    Female,
    /// The plug, mirrored: glued in, it ends so far above the floor of the pocket, and what is
    /// round it as far above the surface.
    Male {
        /// How far.
        gap: Nm,
    },
}

impl Carving {
    /// How deep the edges of the areas lie: where a plug ends that is glued in.
    fn start(&self) -> Nm {
        match (self.inlay, self.max_depth) {
            (Some(Inlay::Male { gap }), Some(depth)) => depth - gap,
            _ => Nm::ZERO,
        }
    }
}

/// The program and what it is to do.
#[derive(Clone, Debug)]
pub struct Engraving {
    /// What it is called.
    pub name: String,
    /// The areas that are carved, on the machine.
    pub areas: Vec<Polygon>,
    /// No deeper than this, where that was asked for.
    pub max_depth: Option<Nm>,
    /// How deep the edges of the areas lie: zero but for the plug of an inlay.
    pub start: Nm,
    /// Whether an end mill was to clear what is too wide.
    pub clears: bool,
    /// Corners that turn by less were left out.
    pub corner: Angle,
    placement: Placement,
    /// Whether it is carved as seen from behind.
    mirrored: bool,
    /// A program for each tool, in the order in which they are run; the last has the V-bit.
    pub programs: Vec<OneTool>,
    /// How deep they go.
    pub deepest: Nm,
    /// What a person must know.
    pub warnings: Vec<Warning>,
    /// Where the time went.
    pub stages: Stages,
}

/// The narrowest tip that clears corners of a floor. Chosen: finer loops would take days.
const BLUNTEST: Nm = Nm::from_um(20);

/// As deep as any tool. Chosen.
const BOTTOMLESS: Nm = Nm::from_mm(100);

/// A pass that is deeper is warned of. Chosen: the cone of a V-bit of 60° on a shank of 1/8 in is
/// 2.7 mm high.
const DEEP_PASS: Nm = Nm::from_mm(3);

/// The share of the tolerance that what is left out may take. Chosen: lines and arcs have the rest.
const SHARE: f64 = 0.3;

/// What is off by less than this is right, when a program is judged. Chosen: five times the
/// tolerance of the cut.
const TOLERATED: Nm = Nm::from_um(10);

/// Places are looked at so far apart at least, and so many of them at most. Chosen.
const FINEST: Nm = Nm::from_um(10);
const MOST_PLACES: f64 = 4e5;

/// Plans the program that carves `art`.
///
/// # Errors
///
/// [`Error::Value`] for a tool that is no V-bit and lengths that make no sense, and for areas that
/// are all narrower than the tip; [`Error::NoArea`] where there is none.
pub fn carve(art: Art, settings: &Settings, how: &Carving) -> Result<Engraving, Error> {
    let tool = v_bit(settings)?;
    judge(how, tool)?;
    let shapes = match how.inlay {
        Some(Inlay::Male { .. }) => mirrored(&art.areas),
        Some(Inlay::Female) | None => art.areas.clone(),
    };
    let areas = match how.raised {
        None => shapes,
        Some(margin) => round(&shapes, margin),
    };
    let areas = without_slivers(&areas);
    let (placed, placement) = on_machine(&areas, settings, "carve")?;
    let pruning = Pruning {
        loss: left_out(settings, tool).max(Pruning::CHORDS),
        corner: libm::cos(how.corner.radians()),
    };
    let interiors = Interior::all(&areas);
    let mut stages = Stages::default();
    let axis = stages.run(
        "medial axis",
        || MedialAxis::new(&interiors, &pruning),
        |axis| [("areas", areas.len()), ("ways", axis.ways.len())],
    );
    let heights = Heights {
        safe: settings.safe,
        approach: settings.isolation[0].heights.approach,
        cut: how.max_depth.unwrap_or(BOTTOMLESS),
        step: how.step,
    };
    let mut warnings = art.warnings.clone();
    warnings.extend(shape_warnings(&axis, &interiors, tool, how)?);
    let start = how.start();
    let flat = how.flat.as_ref().zip(how.max_depth);
    let is_wide = |depth: Nm| axis.widest() > reach_of(tool, depth - start).to_f64();
    let floor = how.max_depth.filter(|&depth| flat.is_some() || is_wide(depth)).map(|depth| {
        let (depth, tolerance) = (depth - start, settings.tolerance);
        let plan = || match flat {
            Some((mill, _)) => strategy::Floor::new(&interiors, &axis, tool, depth, mill, tolerance),
            None => strategy::Floor::walls(&interiors, tool, depth, tolerance),
        };
        stages.run("floor", plan, |_| [])
    });
    drop(interiors);
    let carving = strategy::Carving {
        tool,
        heights,
        placement: &placement,
        order: Order::default(),
        machine: &settings.machine,
        tolerance: settings.tolerance,
        start,
        floor: floor.as_ref(),
    };
    let count = |section: &Section| [("moves", section.moves.len())];
    let mut sections: Vec<(&'static str, Section)> = Vec::new();
    if let (Some(floor), Some((mill, _))) = (&floor, flat) {
        let label = format!("clear the floor of {}", art.name);
        let clear = || floor.clear(label, mill, heights, &placement);
        sections.push(("flat", stages.run("moves of the end mill", clear, count)));
    }
    let carve = || strategy::carve(format!("carve {}", art.name), &axis, &carving);
    sections.push(("", stages.run("moves of the V-bit", carve, count)));
    sections.retain(|(_, section)| !section.moves.is_empty());
    if let Some((mill, _)) = flat.filter(|_| sections.iter().all(|(tag, _)| tag.is_empty())) {
        let message = format!("`{}` fits nowhere: the V-bit clears the floor alone", mill.kind);
        warnings.push(planning::FLAT_FITS_NOWHERE.warning(message));
    }
    if sections.is_empty() {
        let problem = format!("everything is narrower than the tip of `{}`: nothing is carved", tool.kind);
        return Err(Error::Value { key: "tool", problem });
    }
    let mut programs = Vec::new();
    for (number, (tag, section)) in (1..).zip(sections) {
        let what = if tag.is_empty() { "carving" } else { "floor" };
        let write = || written(&art, (tag, what, number), section, settings, declared(settings, how));
        let (one, found) = stages.run("writing programs", write, |(one, _)| [("bytes", one.text.len())]);
        programs.push(one);
        warnings.extend(found);
    }
    let moves = programs.iter().flat_map(|one| &one.program.sections).flat_map(|section| &section.moves);
    let deepest = -moves.filter_map(|step| step.to()).map(|to| to.z).min().unwrap_or(Nm::ZERO);
    let pass = Heights { cut: deepest, ..heights }.passes().next().unwrap_or(deepest);
    if pass > DEEP_PASS {
        let message = format!("`{}` goes {pass:.3} mm deep in one pass", tool.kind);
        warnings.push(planning::CARVING_PASS_TOO_DEEP.warning(message));
    }
    Ok(Engraving {
        name: art.name,
        areas: placed,
        max_depth: how.max_depth,
        start,
        clears: how.flat.is_some() || how.inlay.is_some(),
        corner: how.corner,
        placement,
        mirrored: matches!(how.inlay, Some(Inlay::Male { .. })),
        programs,
        deepest,
        warnings,
        stages,
    })
}

/// How far what is left out may reach, in nanometres: without it the cut is off by no more than its
/// share of the tolerance, in depth and sideways.
fn left_out(settings: &Settings, tool: &Tool) -> f64 {
    settings.tolerance.to_f64() * SHARE * tool.kind.flank().min(1.0)
}

/// The one tool, which must be a V-bit.
fn v_bit(settings: &Settings) -> Result<&Tool, Error> {
    let wrong = |problem: String| Err(Error::Value { key: "tool", problem });
    match settings.isolation.as_slice() {
        [one] if matches!(one.tool.kind, ToolKind::VBit { .. }) => Ok(&one.tool),
        [one] => {
            wrong(format!("`{}` is not a V-bit: carving needs one, such as vbit:0.1mm:60deg", one.tool.kind))
        }
        several => wrong(format!("carving takes one V-bit, but there are {} tools", several.len())),
    }
}

fn judge(how: &Carving, tool: &Tool) -> Result<(), Error> {
    let positive = |key: &'static str, length: Option<Nm>| match length {
        Some(length) if length <= Nm::ZERO => {
            Err(Error::Value { key, problem: format!("{length:.3} mm is invalid: it must be above zero") })
        }
        _ => Ok(()),
    };
    positive("max-depth", how.max_depth)?;
    judge_pass(how.step)?;
    positive("margin", how.raised)?;
    inlay(how)?;
    if how.corner < Angle::ZERO || how.corner >= Angle::from_degrees(180) {
        let problem = format!("{} is invalid: expected from 0deg to below 180deg", how.corner);
        return Err(Error::Value { key: "corner", problem });
    }
    let Some(flat) = &how.flat else { return Ok(()) };
    let wrong = |problem: String| Err(Error::Value { key: "flat", problem });
    match (flat.kind, tool.kind) {
        (ToolKind::VBit { .. } | ToolKind::Drill { .. }, _) => {
            wrong(format!("`{}` is not an end mill: a flat floor needs one, such as endmill:3mm", flat.kind))
        }
        _ if how.max_depth.is_none() => wrong(
            Words::of("without {max-depth} no place is too wide, and there is no flat floor").to_string(),
        ),
        (_, ToolKind::VBit { tip, .. }) if tip < BLUNTEST => wrong(format!(
            "a V-bit clears what the end mill does not reach with its tip, which must be {BLUNTEST:.2} mm or wider"
        )),
        _ => Ok(()),
    }?;
    Ok(())
}

/// What both halves of an inlay must be.
fn inlay(how: &Carving) -> Result<(), Error> {
    let Some(inlay) = how.inlay else { return Ok(()) };
    let Some(depth) = how.max_depth else {
        let problem = Words::of("an inlay needs {max-depth}: how deep its pocket is").to_string();
        return Err(Error::Value { key: "inlay", problem });
    };
    match inlay {
        Inlay::Male { gap } if gap <= Nm::ZERO || gap >= depth => {
            let problem = format!(
                "{gap:.3} mm is invalid: it must be above zero and less than the depth of the pocket, {depth:.3} mm"
            );
            Err(Error::Value { key: "gap", problem })
        }
        Inlay::Male { .. } if how.raised.is_none() => {
            let problem = "what is round a plug must be carved, so far as the margin says".to_owned();
            Err(Error::Value { key: "margin", problem })
        }
        Inlay::Male { .. } | Inlay::Female => Ok(()),
    }
}

/// Areas as they are seen from behind.
fn mirrored(areas: &[Polygon]) -> Vec<Polygon> {
    let ring = |ring: &Vec<Point>| ring.iter().rev().map(|p| Point::new(-p.x, p.y)).collect();
    areas.iter().filter_map(|area| Polygon::new(area.contours().iter().map(ring).collect())).collect()
}

/// What the tool cannot do of the areas.
///
/// # Errors
///
/// [`Error::Value`] where that is half of an inlay which would not go into the other.
fn shape_warnings(
    axis: &MedialAxis,
    areas: &[Interior<'_>],
    tool: &Tool,
    how: &Carving,
) -> Result<Vec<Warning>, Error> {
    let mut warnings = Vec::new();
    let ToolKind::VBit { tip, .. } = tool.kind else { return Ok(warnings) };
    if let Some(&fault) = axis.faults.first() {
        let message =
            format!("the medial axis may lack a branch, here and at {} places in all", axis.faults.len());
        warnings.push(planning::AXIS_INCOMPLETE.warning(message).at(fault));
    }
    let narrow = areas.iter().filter(|area| offset(area.area(), -tip / 2, Nm::from_um(1)).is_empty()).count();
    if narrow > 0 && tip > Nm::ZERO {
        let message = format!(
            "{narrow} of {} areas are narrower than the tip of {tip:.3} mm: they are not carved",
            areas.len()
        );
        warnings.push(planning::NARROWER_THAN_TIP.warning(message));
    }
    if how.max_depth.is_none() && axis.widest() > (tool.kind.width_at(BOTTOMLESS) / 2).to_f64() {
        let wide = format!("a place is {:.0} mm wide", 2.0 * axis.widest() / 1e6);
        let deep = format!("`{}` would go deeper than {:.0} mm", tool.kind, BOTTOMLESS.to_mm());
        let problem = Words::of("{0}, where {1} if nothing said how deep it may go: see {unit}");
        let problem = problem.with([&wide, &deep]).to_string();
        return Err(Error::Value { key: "max-depth", problem });
    }
    if let Some(most) = how.max_depth.filter(|_| how.flat.is_none()) {
        let reach = reach_of(tool, most - how.start());
        // Along the walls its tip clears as far again as it is wide.
        let cleared = if how.inlay.is_some() { reach } else { reach + tip / 2 };
        let is_wide = axis.widest() > cleared.to_f64();
        let wide = if is_wide { insets(areas, cleared) } else { Vec::new() };
        let area: f64 = wide.iter().map(Polygon::area_mm2).sum();
        if area > LEAST_WIDE && how.inlay.is_some() {
            let left = format!("{area:.2} mm² are farther from the edge than {reach:.3} mm");
            let problem = Words::of("{0}, and would stand in the way of the other half: {flat} clears them");
            return Err(Error::Value { key: "inlay", problem: problem.with([&left]).to_string() });
        }
        if area > LEAST_WIDE {
            let message = format!(
                "{area:.2} mm² are farther from the edge than the {cleared:.3} mm that the tool clears beside it at {most:.3} mm: they are left between the walls"
            );
            warnings.push(planning::WIDE_PLACE_LEFT.warning(message));
        }
    }
    Ok(warnings)
}

/// How far to either side a tool cuts at a depth.
fn reach_of(tool: &Tool, depth: Nm) -> Nm {
    tool.kind.width_at(depth) / 2
}

/// What is wider by less is no flat place, in mm². Chosen.
const LEAST_WIDE: f64 = 1e-3;

/// The settings that matter, for the header.
fn declared(settings: &Settings, how: &Carving) -> Vec<(String, String)> {
    let mut listed = settings.options().listed_for(Reach::CARVING);
    let mut say = |name: &str, length: Option<Nm>| {
        listed.extend(length.map(|length| (name.to_owned(), super::Length(length).to_string())));
    };
    say("max-depth", how.max_depth);
    say("depth-pass", how.step);
    say("raised", how.raised);
    if let Some(Inlay::Male { gap }) = how.inlay {
        say("gap", Some(gap));
    }
    let half = how.inlay.map(|half| if half == Inlay::Female { "female" } else { "male" });
    listed.extend(half.map(|half| ("inlay".to_owned(), half.to_owned())));
    if let Some(flat) = &how.flat {
        listed.push(("flat".to_owned(), flat.kind.to_string()));
    }
    if how.corner > Angle::ZERO {
        listed.push(("corner".to_owned(), how.corner.to_string()));
    }
    listed
}

impl Engraving {
    /// Judges its programs by the areas that are to be carved, at places `pitch` apart; none for as
    /// many as take a second or so.
    ///
    /// # Errors
    ///
    /// [`Error::Verify`] for a text that cannot be followed.
    pub fn verify(&self, pitch: Option<Nm>) -> Result<Carved, Error> {
        self.compare(&art::texts(&self.programs), pitch)
    }

    /// The same of other programs, each with its name, in place of these.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for more or fewer programs than there are tools, [`Error::Verify`] for a
    /// text that cannot be followed.
    pub fn judge(&self, texts: &[(&str, &str)], pitch: Option<Nm>) -> Result<Carved, Error> {
        self.compare(&art::others(&self.programs, texts)?, pitch)
    }

    fn compare(&self, programs: &[Text<'_>], pitch: Option<Nm>) -> Result<Carved, Error> {
        let around = self.areas.iter().map(Polygon::bounds).reduce(Rect::union);
        let area = around.map_or(0.0, |around| around.width().to_f64() * around.height().to_f64());
        let pitch = pitch.unwrap_or_else(|| Nm::from_f64((area / MOST_PLACES).sqrt()).max(FINEST));
        let v_bit = programs[programs.len() - 1].cutter;
        let clears = self.clears;
        let ideal = Ideal {
            areas: &self.areas,
            v_bit,
            clears,
            most: self.max_depth,
            start: self.start,
            corner: libm::cos(self.corner.radians()),
            tolerance: TOLERATED,
            pitch,
        };
        let mut carved = carving::carving(programs, &ideal)?;
        art::on_drawing(&mut carved.findings, |at| {
            let at = self.placement.undo(at);
            if self.mirrored { Point::new(-at.x, at.y) } else { at }
        });
        Ok(carved)
    }

    /// What its programs mill, as a picture at a slant: a PNG so many pixels wide.
    ///
    /// # Errors
    ///
    /// [`Error::Verify`] for a program that cannot be followed, [`Error::Grid`] for a picture that
    /// cannot be drawn.
    pub fn picture(&self, width: u32) -> Result<Vec<u8>, Error> {
        art::picture(&self.programs, &self.areas, width)
    }

    /// What it is, for a person; `files` are what its programs are called, as far as they are
    /// written.
    #[must_use]
    pub fn summary(&self, files: &[String]) -> String {
        format!("{}: carved down to {:.3} mm\n", self.name, self.deepest) + &art::lines(&self.programs, files)
    }
}
