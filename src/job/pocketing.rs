//! Artwork → the programs that mill it as pockets, and what they do.

use rayon::prelude::*;

use crate::board::FLATTEN;
use crate::board::Warning;
use crate::board::diagnostic::count;
use crate::board::diagnostic::planning;
use crate::board::polarity::{difference, intersection, offset, union};
use crate::geometry::{Edges, Nm, Point, Polygon, Rect, RectIndex};
use crate::report::stages::Stages;
use crate::toolpath::strategy::{self, Clearings, Engaging, Entries, Groove, Levels, Planned, Sequence};
use crate::toolpath::{Angle, Direction, Heights, Placement, Tool, ToolKind};
use crate::verify::carving::Text;
use crate::verify::pocketing::{self, Floor, Plunges, Pocketed};
use crate::voronoi::medial::Interior;
use crate::voronoi::medial::nest::Nest;

use super::art::{self, Art, OneTool, judge_pass, on_machine, round, without_slivers, written};
use super::{Cutting, Error, Length, Overlap, Reach, Settings};

/// How pockets are milled.
#[derive(Clone, Debug, PartialEq)]
pub struct Pocketing {
    /// How much one pass takes; none for all at once.
    pub step: Option<Nm>,
    /// How far neighbouring loops are apart: a length, or a part of the tool's diameter; of a
    /// hundredth to half of it.
    pub stepover: Overlap,
    /// What is left along the edge for a last loop; zero for none.
    pub stock: Nm,
    /// In which order loops are milled.
    pub sequence: Sequence,
    /// How steeply the tool goes down, above 0° and below 90°.
    pub ramp: Angle,
    /// Mill what lies round the areas, up to so far from them, and leave them standing.
    pub raised: Option<Nm>,
    /// Clear along the medial axis what the widest tool mills, so that it bears no more than this;
    /// none for loops.
    pub engaging: Option<Engaging>,
}

/// The programs and what they are to do.
#[derive(Clone, Debug)]
pub struct Pocket {
    /// What it is called.
    pub name: String,
    /// The areas that are milled, on the machine.
    pub areas: Vec<Polygon>,
    /// How deep.
    pub depth: Nm,
    /// A program for each tool, in the order in which they are run.
    pub programs: Vec<OneTool>,
    /// How the tools come down.
    pub entries: Entries,
    /// What a person must know.
    pub warnings: Vec<Warning>,
    /// Where the time went.
    pub stages: Stages,
    how: Pocketing,
    placement: Placement,
    levels: Vec<f64>,
    /// How often more than once in each part the tool comes down in a pass: where there is no room
    /// for arcs, in layers.
    layered: usize,
}

/// How much nearer to the edge than the tool's radius its middle may be, so that a slot as wide as
/// the tool is one still. Chosen: rounding is less, and a cut may be off by four times as much.
const WITHIN: Nm = Nm::new(500);

/// What is off by less than this is right, when a program is judged. Chosen: twice the tolerance of
/// the cut and what writing rounds.
const TOLERATED: Nm = Nm::from_um(5);

/// Rows are looked at so far apart at least, and so many of them at most. Chosen.
const FINEST: Nm = Nm::from_um(5);
const MOST_ROWS: i64 = 10_000;

/// Plans the programs that mill `art`.
///
/// # Errors
///
/// [`Error::Value`] for a tool that is no end mill and lengths that make no sense, and for areas
/// that are all narrower than the tool; [`Error::NoArea`] where there is none.
pub fn pocket(art: Art, settings: &Settings, how: &Pocketing) -> Result<Pocket, Error> {
    let mills = end_mills(settings)?;
    judge(how)?;
    let areas = match how.raised {
        None => art.areas.clone(),
        Some(margin) => round(&art.areas, margin),
    };
    let areas = without_slivers(&areas);
    let (areas, placement) = on_machine(&areas, settings, "mill")?;
    let mut made = Pocket {
        name: art.name.clone(),
        areas,
        depth: mills[0].1.cut,
        programs: Vec::new(),
        entries: Entries::default(),
        warnings: art.warnings.clone(),
        stages: Stages::default(),
        how: how.clone(),
        placement,
        levels: Vec::new(),
        layered: 0,
    };
    let mut before: Option<Nm> = None;
    for &(tool, heights) in &mills {
        let radius = tool.width_at(Nm::ZERO) / 2;
        let left = before.map(|coarser| {
            let rest = || rest(&made.areas, coarser, radius);
            made.stages.run(format!("{}: what is left", tool.kind), rest, |left| [("areas", left.len())])
        });
        if made.mill(&art, left.as_deref(), (tool, heights), settings, mills.len() > 1)? {
            before = Some(radius);
        }
    }
    let finest = mills[mills.len() - 1].0;
    if made.programs.is_empty() {
        let problem = format!("everything is narrower than `{}`: nothing is milled", finest.kind);
        return Err(Error::Value { key: "tool", problem });
    }
    let found = shape_warnings(&made.areas, finest, made.entries);
    made.warnings.extend(found);
    Ok(made)
}

impl Pocket {
    /// Adds the program of a tool for what it is to clear; false where it fits nowhere.
    fn mill(
        &mut self,
        art: &Art,
        left: Option<&[Polygon]>,
        (tool, heights): (&Tool, Heights),
        settings: &Settings,
        is_one_of_several: bool,
    ) -> Result<bool, Error> {
        let areas = match left {
            None => self.areas.clone(),
            Some(left) => round_what_is_left(&self.areas, left, tool.width_at(Nm::ZERO)),
        };
        let areas = Interior::all(&areas);
        let levels = levels(tool, settings, &self.how)?;
        let nest = self.stages.run(
            format!("{}: loops", tool.kind),
            || Nest::new(&areas, |level| levels.at(level)),
            |nest| [("areas", areas.len()), ("loops", nest.loops.len())],
        );
        if nest.flaws > 0 {
            let message = format!(
                "the Voronoi diagram of {} areas is faulty: their loops are offset polygons instead",
                nest.flaws
            );
            self.warnings.push(planning::LOOPS_BY_OFFSETS.warning(message));
        }
        if nest.roots.is_empty() {
            if is_one_of_several {
                let message = format!(
                    "`{}` cuts nothing: it fits nowhere, or the other tools leave it nothing",
                    tool.name
                );
                self.warnings.push(planning::TOOL_CUTS_NOTHING.warning(message));
            }
            return Ok(false);
        }
        let clearings = self.how.engaging.filter(|_| left.is_none()).map(|engaging| {
            let planned = Planned {
                areas: &areas,
                nest: &nest,
                tool,
                levels,
                direction: settings.asked.direction.unwrap_or(Direction::Climb),
                tolerance: settings.tolerance,
                engaging,
            };
            self.stages.run(format!("{}: arcs", tool.kind), || Clearings::new(&planned), |_| [])
        });
        if let Some(clearings) = &clearings {
            let grooves = clearings.grooves.iter();
            self.warnings.extend(grooves.map(|groove| groove_warning(groove, &self.placement)));
            self.warnings.extend(clearings.looped.iter().map(|&(at, is_large)| {
                let why = if is_large { "it would take too many" } else { "its medial axis is faulty" };
                let message = format!(
                    "an area is milled in loops, in {} layers, and not in arcs: {why}",
                    clearings.layers()
                );
                planning::MILLED_IN_LOOPS.warning(message).at(self.placement.undo(at))
            }));
            let in_loops = (0..nest.roots.len()).filter(|&root| !clearings.has(root)).count();
            self.layered = in_loops * usize::try_from(clearings.layers() - 1).unwrap_or(0);
        }
        // Its areas lie round what is left; what is farther off than the tool reaches is cleared.
        let done = left.map_or_else(Vec::new, |left| done(&nest, left, tool.width_at(Nm::ZERO) / 2));
        let plan = strategy::Pocketing {
            tool,
            heights: Heights { step: self.how.step, ..heights },
            levels,
            sequence: self.how.sequence,
            direction: settings.asked.direction.unwrap_or(Direction::Climb),
            ramp: self.how.ramp,
            tolerance: settings.tolerance,
            done: &done,
            clearings: clearings.as_ref(),
        };
        let number = self.programs.len() + 1;
        let what = if number == 1 { "pocket" } else { "rest" };
        let (section, entries) = self.stages.run(
            format!("{}: moves", tool.kind),
            || strategy::pocket(format!("{what} {}", art.name), &nest, &plan),
            |(section, _)| [("moves", section.moves.len())],
        );
        let tag = if is_one_of_several { number.to_string() } else { String::new() };
        let number = u32::try_from(number).unwrap_or(u32::MAX);
        let said = declared(settings, &self.how);
        let (one, found) = self.stages.run(
            format!("{}: writing the program", tool.kind),
            || written(art, (&tag, what, number), section, settings, said),
            |(one, _)| [("bytes", one.text.len())],
        );
        self.warnings.extend(found);
        if self.programs.is_empty() {
            let deepest = nest.loops.iter().map(|one| one.level).max().unwrap_or(0);
            self.levels = (0..=deepest + 1).map(|level| levels.at(level)).collect();
        }
        self.programs.push(one);
        self.entries.all += entries.all;
        self.entries.straight += entries.straight;
        self.entries.unlinked += entries.unlinked;
        Ok(true)
    }
}

/// A place that the tool mills in its full width.
fn groove_warning(groove: &Groove, placement: &Placement) -> Warning {
    let message = format!(
        "a place {:.3} mm wide and {:.3} mm long is milled in the full width of the tool, in shallow layers",
        groove.width.to_mm(),
        groove.length.to_mm()
    );
    let at = placement.undo(groove.at);
    Warning { size: Some(groove.width), ..planning::MILLED_IN_FULL_WIDTH.warning(message).at(at) }
}

/// What a finer tool can clear of areas that a coarser one has cleared as far as it fits.
fn rest(areas: &[Polygon], coarser: Nm, finer: Nm) -> Vec<Polygon> {
    let opened = |area: &Polygon, radius: Nm| -> Vec<Polygon> {
        let reach = radius - WITHIN;
        let fits = offset(area, -reach, FLATTEN);
        union(&fits.iter().flat_map(|fit| offset(fit, reach, FLATTEN)).collect::<Vec<_>>())
    };
    let of_area = |area: &Polygon| -> Vec<Polygon> {
        let cleared = opened(area, coarser);
        let left = opened(area, finer).into_iter().flat_map(|open| difference(&open, &cleared));
        let thick = left.flat_map(|piece| offset(&piece, -THIN, FLATTEN));
        thick.flat_map(|piece| offset(&piece, THIN * 5, FLATTEN)).collect()
    };
    areas.par_iter().flat_map_iter(of_area).collect()
}

/// What lies in areas within a tool's diameter of what is left: it holds every disc of that tool
/// that touches it, so its loops are those that clear it.
fn round_what_is_left(areas: &[Polygon], left: &[Polygon], diameter: Nm) -> Vec<Polygon> {
    let near = left.iter().flat_map(|piece| offset(piece, diameter, FLATTEN));
    let near = union(&near.collect::<Vec<_>>());
    let index = RectIndex::new(near.iter().map(Polygon::bounds));
    let within = |area: &Polygon| -> Vec<Polygon> {
        let meets = index.touching(area.bounds()).into_iter();
        meets.flat_map(|number| intersection(&near[number], area)).collect()
    };
    areas.par_iter().flat_map_iter(within).collect()
}

/// Of each loop whether a tool of this radius meets nothing of what is left along it.
fn done(nest: &Nest, left: &[Polygon], radius: Nm) -> Vec<bool> {
    let near = left.iter().flat_map(|piece| offset(piece, radius + THIN * 5, FLATTEN));
    let near: Vec<Edges> = near.map(|near| Edges::new(&near)).collect();
    let index = RectIndex::new(near.iter().map(Edges::bounds));
    let apart = radius.to_f64() / 8.0;
    let meets = |(x, y): (f64, f64)| {
        let at = Point::from_f64(x, y);
        index.touching(Rect::new(at, at)).into_iter().any(|number| near[number].contains(at))
    };
    let is_done = |ring: &[(f64, f64)]| {
        let next = ring.iter().cycle().skip(1);
        !ring.iter().zip(next).any(|(&(ax, ay), &(bx, by))| {
            let count = (((bx - ax) * (bx - ax) + (by - ay) * (by - ay)).sqrt() / apart).ceil().max(1.0);
            let mut part = 0.0;
            while part < count && !meets((ax + (bx - ax) * part / count, ay + (by - ay) * part / count)) {
                part += 1.0;
            }
            part < count
        })
    };
    nest.loops.iter().map(|one| is_done(&one.ring)).collect()
}

/// What is left in strips of twice this width is nothing. Chosen: what a cut may be off.
const THIN: Nm = Nm::from_um(2);

/// The tools, which must be end mills, the widest first, and how they go.
fn end_mills(settings: &Settings) -> Result<Vec<(&Tool, Heights)>, Error> {
    let end_mill = |cutting: &'_ Cutting| match cutting.tool.kind {
        ToolKind::EndMill { .. } => Ok(()),
        kind @ (ToolKind::VBit { .. } | ToolKind::Drill { .. }) => {
            let problem = format!("`{kind}` is not an end mill: a flat floor needs one, such as endmill:1mm");
            Err(Error::Value { key: "tool", problem })
        }
    };
    settings.isolation.iter().try_for_each(end_mill)?;
    Ok(settings.isolation.iter().map(|cutting| (&cutting.tool, cutting.heights)).collect())
}

/// Fails for what is invalid with any tool.
fn judge(how: &Pocketing) -> Result<(), Error> {
    let wrong = |key: &'static str, problem: String| Err(Error::Value { key, problem });
    judge_pass(how.step)?;
    if let Some(engaging) = how.engaging
        && how.sequence == Sequence::OutsideIn
    {
        let problem = format!("outside-in has no effect with an engagement of {}", engaging.target);
        return wrong("order", problem);
    }
    if how.ramp <= Angle::ZERO || how.ramp >= Angle::from_degrees(90) {
        return wrong("ramp", format!("{} is invalid: expected above 0deg and below 90deg", how.ramp));
    }
    if how.raised.is_some_and(|margin| margin <= Nm::ZERO) {
        return wrong("margin", "a margin of zero is invalid: it must be above zero".to_owned());
    }
    Ok(())
}

/// Loops are no nearer to each other than this part of the diameter. Chosen: the least engagement
/// that may be asked for.
const FINEST_STEP: i64 = 100;

/// How far loops are from the edge.
fn levels(tool: &Tool, settings: &Settings, how: &Pocketing) -> Result<Levels, Error> {
    let wrong = |key: &'static str, problem: String| Err(Error::Value { key, problem });
    let diameter = tool.width_at(Nm::ZERO);
    let step = how.stepover.of(diameter);
    if step <= Nm::ZERO || step > diameter / 2 {
        return wrong(
            "stepover",
            format!(
                "`{}` is not between zero and half the tool diameter: farther apart, loops leave material in corners",
                how.stepover
            ),
        );
    }
    if step < diameter / FINEST_STEP {
        let problem = format!(
            "`{}` is less than a hundredth of the tool diameter, {}: so near to each other loops rub and do not cut, and there is no end of them",
            how.stepover,
            Length(diameter / FINEST_STEP)
        );
        return wrong("stepover", problem);
    }
    if how.stock < Nm::ZERO || how.stock > diameter / 2 {
        let problem = format!("{} is not between zero and half the tool diameter", Length(how.stock));
        return wrong("stock", problem);
    }
    if let Some(engaging) = how.engaging {
        let most = engaging.target.part() * diameter.to_f64();
        if how.stock.to_f64() > most {
            let problem = format!(
                "{} is more than the engagement of {}: {:.3} mm with this tool",
                Length(how.stock),
                engaging.target,
                most / 1e6
            );
            return wrong("stock", problem);
        }
    }
    // Each loop may be off its place by the tolerance.
    let most = diameter.to_f64() / 2.0 - 2.0 * settings.tolerance.to_f64();
    Ok(Levels {
        wall: diameter.to_f64() / 2.0 - WITHIN.to_f64(),
        stock: how.stock.to_f64(),
        step: step.to_f64().min(most),
    })
}

/// What the tool cannot do of the areas.
fn shape_warnings(areas: &[Polygon], tool: &Tool, entries: Entries) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let radius = tool.width_at(Nm::ZERO) / 2;
    let narrow = areas.iter().filter(|area| offset(area, WITHIN - radius, Nm::from_um(1)).is_empty()).count();
    if narrow > 0 {
        let message = format!(
            "{narrow} of {} areas are narrower than `{}`: they are not milled",
            areas.len(),
            tool.kind
        );
        warnings.push(planning::NARROWER_THAN_TOOL.warning(message));
    }
    if entries.straight > 0 {
        let message = format!(
            "at {} places the tool plunges straight down, since there is no room for a ramp: it must be centre-cutting",
            entries.straight
        );
        warnings.push(planning::PLUNGE_STRAIGHT_DOWN.warning(message));
    }
    warnings
}

/// The settings that matter, for the header.
fn declared(settings: &Settings, how: &Pocketing) -> Vec<(String, String)> {
    let mut listed = settings.options().listed_for(Reach::POCKETS);
    let mut say = |name: &str, text: Option<String>| {
        listed.extend(text.map(|text| (name.to_owned(), text)));
    };
    say("stepover", Some(how.stepover.to_string()));
    say("depth-pass", how.step.map(|step| Length(step).to_string()));
    say("stock", (how.stock > Nm::ZERO).then(|| Length(how.stock).to_string()));
    say("ramp", Some(how.ramp.to_string()));
    say("order", (how.sequence == Sequence::OutsideIn).then(|| "outside-in".to_owned()));
    say("strategy", how.engaging.map(|_| "engagement".to_owned()));
    say("engagement", how.engaging.map(|engaging| engaging.target.to_string()));
    say("both-ways", how.engaging.filter(|engaging| engaging.both_ways).map(|_| "yes".to_owned()));
    say("raised", how.raised.map(|margin| Length(margin).to_string()));
    listed
}

impl Pocket {
    /// Judges its programs by the areas that are to be milled, in rows `pitch` apart; none for as
    /// many as take a second or so.
    ///
    /// # Errors
    ///
    /// [`Error::Verify`] for a text that cannot be followed.
    pub fn verify(&self, pitch: Option<Nm>) -> Result<Pocketed, Error> {
        self.compare(&art::texts(&self.programs), pitch)
    }

    /// The same of other programs, each with its name, in place of these.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for more or fewer programs than there are tools, [`Error::Verify`] for a
    /// text that cannot be followed.
    pub fn judge(&self, texts: &[(&str, &str)], pitch: Option<Nm>) -> Result<Pocketed, Error> {
        self.compare(&art::others(&self.programs, texts)?, pitch)
    }

    fn compare(&self, programs: &[Text<'_>], pitch: Option<Nm>) -> Result<Pocketed, Error> {
        let around = self.areas.iter().map(Polygon::bounds).reduce(Rect::union);
        let height = around.map_or(Nm::ZERO, Rect::height);
        let pitch = pitch.unwrap_or_else(|| (height / MOST_ROWS).max(FINEST));
        let passes = Heights { safe: Nm::ZERO, approach: Nm::ZERO, cut: self.depth, step: self.how.step }
            .passes()
            .count();
        // In arcs the tool comes down once in each connected part.
        let is_inside_out = self.how.sequence == Sequence::InsideOut && self.how.engaging.is_none();
        let levels = if is_inside_out { self.levels.as_slice() } else { &self.levels[..1] };
        let floor = Floor {
            areas: &self.areas,
            depth: self.depth,
            step: self.how.step,
            steepest: Some(libm::tan(self.how.ramp.radians())),
            stock: self.how.stock,
            plunges: Some(Plunges { levels, layered: self.layered, passes }),
            engagement: self.how.engaging.map(|engaging| engaging.target.part()),
            within: WITHIN,
            tolerance: TOLERATED,
            pitch,
        };
        let mut judged = pocketing::pocketing(programs, &floor)?;
        art::on_drawing(&mut judged.findings, |at| self.placement.undo(at));
        Ok(judged)
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
        let (areas, entries) = (count(self.areas.len(), "area"), count(self.entries.all, "plunge"));
        format!("{}: {areas} milled {:.3} mm deep, {entries}\n", self.name, self.depth)
            + &art::lines(&self.programs, files)
    }
}
