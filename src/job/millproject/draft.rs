//! A pcb2gcode project as options of ours, while its lines are read.

use std::path::PathBuf;

use crate::board::diagnostic::planning;
use crate::board::{Sentence, SourceSpan, Words};
use crate::gcode::dialect::Blend;
use crate::geometry::Nm;
use crate::job::Options;
use crate::job::choice::{DialectChoice, DrillSide, Origin};
use crate::job::output_name::OutputName;
use crate::job::overlap::Overlap;
use crate::job::part::Part;
use crate::job::quantity::{DrillChoice, Drills, Length, Place, Tiles, Wait};
use crate::job::tools::{OwnTool, ToolChoice};
use crate::toolpath::{Direction, ToolKind};

use super::left;
use super::value::{Entry, Units, Wrong};
use super::{MillProject, OwnFile};

/// A project while its lines are read; many options mean something only together.
pub(super) struct Draft<'a> {
    pub(super) units: Units,
    file: &'a str,
    pub(super) made: MillProject,
    /// Values that make no sense, each for what it matters to.
    pub(super) refused: Vec<(Needs, Wrong)>,
    pub(super) isolating: Isolating<'a>,
    pub(super) cutting: Cutting<'a>,
    pub(super) drilling: Drilling<'a>,
    pub(super) probing: Probing<'a>,
    pub(super) nom6: Option<Entry<'a>>,
    pub(super) zchange: Option<Entry<'a>>,
    pub(super) is_change_absolute: Option<Entry<'a>>,
    offset: (Option<Nm>, Option<Nm>),
    tiles: (u32, u32),
}

/// What a board must have for a value to matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Needs {
    /// Copper on any side.
    Copper,
    /// A side that lies down for the front.
    Back,
    /// Holes.
    Holes,
    /// An outline.
    Outline,
}

/// How copper is isolated.
#[derive(Default)]
pub(super) struct Isolating<'a> {
    pub(super) mills: Vec<Nm>,
    /// None for wider than any board.
    pub(super) width: Option<Option<Nm>>,
    pub(super) extra_passes: Option<(u32, Entry<'a>)>,
    pub(super) overlap: Option<(Overlap, Entry<'a>)>,
    pub(super) offset: Option<(Nm, Entry<'a>)>,
    pub(super) infeed: Option<(Nm, Entry<'a>)>,
    pub(super) voronoi: Option<bool>,
}

/// How the board is cut out.
pub(super) struct Cutting<'a> {
    pub(super) cutter: OwnTool,
    pub(super) depth: Option<Nm>,
    pub(super) bridges: Option<Nm>,
    pub(super) bridges_count: Option<u32>,
    pub(super) zbridges: Option<(Nm, Entry<'a>)>,
    pub(super) side: CutSide,
    /// The same in an older option, which has the last word.
    pub(super) front: Option<bool>,
}

/// How holes are made.
#[derive(Default)]
pub(super) struct Drilling<'a> {
    pub(super) depth: Option<Nm>,
    pub(super) mill_depth: Option<(Nm, Entry<'a>)>,
    pub(super) mill: Option<Nm>,
    /// From which diameter on holes are milled.
    pub(super) milled_from: Option<Nm>,
    pub(super) side: CutSide,
    /// The same in an older option, which has the last word.
    pub(super) front: Option<bool>,
}

/// How the surface is touched.
#[derive(Default)]
pub(super) struct Probing<'a> {
    pub(super) front: Option<Entry<'a>>,
    pub(super) back: Option<Entry<'a>>,
    pub(super) x: Option<Nm>,
    pub(super) y: Option<Nm>,
    pub(super) feed: Option<crate::toolpath::Feed>,
}

/// The side that is up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum CutSide {
    /// The front, unless there is copper on the back alone.
    #[default]
    Auto,
    /// Said.
    Front,
    /// Said.
    Back,
}

impl<'a> Draft<'a> {
    pub(super) fn new(units: Units, file: &'a str) -> Self {
        Self {
            units,
            file,
            made: MillProject::default(),
            refused: Vec::new(),
            isolating: Isolating::default(),
            cutting: Cutting {
                cutter: usual_cutter(),
                depth: None,
                bridges: None,
                bridges_count: None,
                zbridges: None,
                side: CutSide::Auto,
                front: None,
            },
            drilling: Drilling::default(),
            probing: Probing::default(),
            nom6: None,
            zchange: None,
            is_change_absolute: None,
            offset: (None, None),
            tiles: (1, 1),
        }
    }

    /// Takes a line into account.
    pub(super) fn take(&mut self, entry: &Entry<'a>) -> Result<(), Wrong> {
        if let Some(reason) = left::reason(entry) {
            if !reason.is_empty() {
                self.leave(entry, reason);
            }
            return Ok(());
        }
        let units = self.units;
        match entry.name {
            "metric" => {}
            "x-offset" => self.offset.0 = Some(entry.length(units)?),
            "y-offset" => self.offset.1 = Some(entry.length(units)?),
            "tile-x" => self.tiles.0 = tiles(entry)?,
            "tile-y" => self.tiles.1 = tiles(entry)?,
            "front" => self.made.files.front = Some(PathBuf::from(entry.value)),
            "back" => self.made.files.back = Some(PathBuf::from(entry.value)),
            "outline" => self.made.files.outline = Some(PathBuf::from(entry.value)),
            "drill" => self.made.files.drill = Some(PathBuf::from(entry.value)),
            "output-dir" => self.made.output = Some(PathBuf::from(entry.value)),
            "preamble" => self.made.before = Some(OwnFile::new(entry)),
            "postamble" => self.made.after = Some(OwnFile::new(entry)),
            "basename" => self.made.name = Some(entry.value.to_owned()),
            "front-output" => self.output(entry, Part::Front),
            "back-output" => self.output(entry, Part::Back),
            "drill-output" => self.output(entry, Part::Drill),
            "outline-output" => self.output(entry, Part::Cutout),
            name if name.starts_with("al-") => self.touch(entry)?,
            _ => {
                let is_taken =
                    self.isolate(entry)? || self.cut(entry)? || self.drill(entry)? || self.run(entry)?;
                if !is_taken {
                    return Err(entry.wrong("an option of pcb2gcode"));
                }
            }
        }
        Ok(())
    }

    /// What isolates.
    fn isolate(&mut self, entry: &Entry<'a>) -> Result<bool, Wrong> {
        let (units, options) = (self.units, &mut self.made.options);
        let isolating = &mut self.isolating;
        match entry.name {
            "voronoi" => isolating.voronoi = Some(entry.flag()?),
            "zwork" => self.made.options.depth = self.depth(entry, Needs::Copper)?.map(Length),
            "mill-feed" => options.feed = Some(entry.feed(units)?),
            "mill-vertfeed" => options.plunge = Some(entry.feed(units)?),
            "mill-speed" => self.made.options.spindle = self.turns(entry)?,
            "mill-diameters" => isolating.mills.extend(entry.lengths(units)?),
            "mill-infeed" => isolating.infeed = Some((entry.positive(units)?, *entry)),
            "isolation-width" => isolating.width = Some(entry.width(units)?),
            "extra-passes" => isolating.extra_passes = Some((entry.count()?, *entry)),
            "milling-overlap" => isolating.overlap = Some((entry.overlap(units)?, *entry)),
            "offset" => isolating.offset = Some((entry.length(units)?, *entry)),
            "mill-feed-direction" => {
                options.direction = match entry.value.to_ascii_lowercase().as_str() {
                    "any" => None,
                    "climb" | "clockwise" => Some(Direction::Climb),
                    "conventional" | "counterclockwise" | "anticlockwise" => Some(Direction::Conventional),
                    _ => return Err(entry.wrong("any, climb or conventional")),
                };
            }
            "invert-gerbers" | "draw-gerber-lines" => {
                if entry.flag()? {
                    let expected = "false: what is drawn is copper here, and the gaps are cut";
                    self.refused.push((Needs::Copper, entry.wrong(expected)));
                }
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// What cuts the board out.
    fn cut(&mut self, entry: &Entry<'a>) -> Result<bool, Wrong> {
        let (units, cutting) = (self.units, &mut self.cutting);
        match entry.name {
            "cutter-diameter" => {
                let diameter = entry.length(units)?;
                if diameter < Nm::ZERO {
                    return Err(entry.wrong("a length of zero or more"));
                }
                if diameter == Nm::ZERO {
                    self.leave(entry, Words::of("a cutter has a width: that of {cutout-tool} is used"));
                } else {
                    cutting.cutter.kind = ToolKind::EndMill { diameter };
                }
            }
            "cut-feed" => cutting.cutter.feed = Some(entry.feed(units)?),
            "cut-vertfeed" => cutting.cutter.plunge = Some(entry.feed(units)?),
            "cut-speed" => self.cutting.cutter.spindle = self.turns(entry)?,
            "cut-infeed" => self.made.options.cutout_pass = Some(Length(entry.positive(units)?)),
            "cut-side" => cutting.side = side(entry)?,
            "cut-front" => cutting.front = Some(entry.flag()?),
            "bridges" => cutting.bridges = Some(entry.length(units)?),
            "bridgesnum" => cutting.bridges_count = Some(entry.count()?),
            "zbridges" => cutting.zbridges = Some((entry.length(units)?, *entry)),
            "zcut" => {
                let depth = self.depth(entry, Needs::Outline)?;
                self.cutting.depth = depth;
                self.made.options.cutout_depth = depth.map(Length);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// What makes holes.
    fn drill(&mut self, entry: &Entry<'a>) -> Result<bool, Wrong> {
        let (units, options, drilling) = (self.units, &mut self.made.options, &mut self.drilling);
        match entry.name {
            "drill-feed" => options.drill_plunge = Some(entry.feed(units)?),
            "drill-speed" => self.made.options.drill_spindle = self.turns(entry)?,
            "drills-available" => self.drills(entry)?,
            "onedrill" => options.one_drill = entry.flag()?.then_some(true),
            "drill-side" => drilling.side = side(entry)?,
            "drill-front" => drilling.front = Some(entry.flag()?),
            "milldrill-diameter" => drilling.mill = Some(entry.positive(units)?),
            "milldrill" if entry.flag()? => drilling.milled_from = drilling.milled_from.or(Some(Nm::ZERO)),
            "milldrill" => {}
            "min-milldrill-hole-diameter" => {
                let is_never = entry.value.trim_start_matches('+').starts_with("inf");
                drilling.milled_from = if is_never { None } else { Some(entry.length(units)?) };
            }
            "zdrill" => {
                let depth = self.depth(entry, Needs::Holes)?;
                self.drilling.depth = depth;
                self.made.options.drill_depth = depth.map(Length);
            }
            "zmilldrill" => {
                let depth = self.depth(entry, Needs::Holes)?;
                self.drilling.mill_depth = depth.map(|depth| (depth, *entry));
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// What the machine does, and where the board lies on it.
    fn run(&mut self, entry: &Entry<'a>) -> Result<bool, Wrong> {
        let (units, options) = (self.units, &mut self.made.options);
        match entry.name {
            "zsafe" => options.safe_z = Some(Length(entry.length(units)?)),
            "zchange" => self.zchange = Some(*entry),
            "zchange-absolute" => self.is_change_absolute = entry.flag()?.then_some(*entry),
            // A millisecond, which is its own default, is none.
            "spinup-time" => {
                options.spin_up = Some(entry.wait()?).filter(|&Wait { milliseconds }| milliseconds > 1)
            }
            // Corners are rounded by no more than this where it is said, and as the machine is set
            // where it is not to be.
            "g64" | "tolerance" => {
                let most = entry.positive(units)?;
                if options.blend != Some(Blend::Machine) {
                    options.blend = Some(Blend::Within(most));
                }
            }
            "nog64" if entry.flag()? => options.blend = Some(Blend::Machine),
            "nog64" => {}
            "nom6" => self.nom6 = entry.flag()?.then_some(*entry),
            "zero-start" if entry.flag()? => options.origin = Some(Origin::LowerLeft),
            "zero-start" => options.origin = Some(Origin::Keep),
            // Its back is mirrored about an absolute line, zero unless `mirror-axis` says
            // otherwise.
            "mirror-absolute" if entry.flag()? => {
                options.mirror_axis = options.mirror_axis.or(Some(Length(Nm::ZERO)));
            }
            "mirror-absolute" => {
                self.leave(
                    entry,
                    "the back is mirrored about the middle of the board unless mirror-axis is set",
                );
            }
            "mirror-axis" => options.mirror_axis = Some(Length(entry.length(units)?)),
            "mirror-yaxis" => {
                if entry.flag()? {
                    let expected = "false: the back is mirrored left to right here";
                    self.refused.push((Needs::Back, entry.wrong(expected)));
                }
            }
            "software" => match entry.value.to_ascii_lowercase().as_str() {
                "linuxcnc" => options.dialect = "linuxcnc".parse::<DialectChoice>().ok(),
                name @ ("mach3" | "mach4") => options.dialect = name.parse::<DialectChoice>().ok(),
                _ => self.leave(entry, Words::of("{dialect} names the controller")),
            },
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// What touches the surface.
    fn touch(&mut self, entry: &Entry<'a>) -> Result<(), Wrong> {
        let (units, probing) = (self.units, &mut self.probing);
        match entry.name {
            "al-front" => probing.front = entry.flag()?.then_some(*entry),
            "al-back" => probing.back = entry.flag()?.then_some(*entry),
            "al-x" => probing.x = Some(entry.positive(units)?),
            "al-y" => probing.y = Some(entry.positive(units)?),
            "al-probefeed" => probing.feed = Some(entry.feed(units)?),
            // The dialect says how a machine touches.
            "al-probecode" | "al-probevar" | "al-setzzero" | "al-probe-on" | "al-probe-off" => {}
            _ => return Err(entry.wrong("an option of pcb2gcode")),
        }
        Ok(())
    }

    /// The depth of a z below zero; none where it lies above, which matters to boards that need it.
    fn depth(&mut self, entry: &Entry<'_>, needs: Needs) -> Result<Option<Nm>, Wrong> {
        let depth = -entry.length(self.units)?;
        if depth > Nm::ZERO {
            return Ok(Some(depth));
        }
        let expected = if depth == Nm::ZERO {
            "a z below zero: at zero the tool only touches the surface".to_owned()
        } else {
            format!("a z below zero: this one is above the surface, -{} is as far below it", entry.value)
        };
        self.refused.push((needs, entry.wrong(&expected)));
        Ok(None)
    }

    /// `0.8mm:-0.1mm:+0.05mm, 1mm`: diameters, each with how far a hole may be from it, which is as
    /// far as can be where that is not said.
    fn drills(&mut self, entry: &Entry<'a>) -> Result<(), Wrong> {
        let options = &mut self.made.options;
        let mut drills = options.drills.take().map_or_else(Vec::new, |Drills(drills)| drills);
        let mut tolerance = options.drill_tolerance.map(Length::nm);
        let mut is_any = false;
        for drill in entry.parts() {
            let mut parts = drill.split(':').map(|value| Entry { value, ..*entry });
            drills.extend(
                parts
                    .next()
                    .map(|part| part.positive(self.units))
                    .transpose()?
                    .map(|diameter| DrillChoice::Diameter(Length(diameter))),
            );
            let offs: Vec<Entry<'_>> = parts.collect();
            is_any |= offs.is_empty();
            for off in offs {
                if off.value.trim_start_matches(['+', '-']).starts_with("inf") {
                    is_any = true;
                    continue;
                }
                let off = off.length(self.units)?.abs();
                tolerance = Some(tolerance.map_or(off, |before| before.max(off)));
            }
        }
        if is_any {
            tolerance = Some(ANY_HOLE);
        }
        options.drills = Some(Drills(drills));
        options.drill_tolerance = tolerance.map(Length);
        if is_any {
            let reason = "a drill without tolerances is used for every hole nearest to it: 0.8mm:-0.1mm:0.1mm is used for 0.7 to 0.9 mm";
            self.advise(entry, reason);
        }
        Ok(())
    }

    /// What the file of a program is called; folders of single files are not taken over.
    fn output(&mut self, entry: &Entry<'_>, part: Part) {
        match OutputName::try_new(part, entry.value) {
            Ok(name) => {
                let names = &mut self.made.options.output_name;
                names.retain(|other| other.part != part);
                names.push(name);
            }
            Err(_) => self.leave(entry, "all files lie in output-dir"),
        }
    }

    /// The turns of a spindle; none for one that stands, as where it is switched on by hand.
    fn turns(&mut self, entry: &Entry<'_>) -> Result<Option<u32>, Wrong> {
        let turns = Some(entry.turns()?).filter(|&turns| turns > 0);
        if turns.is_none() {
            self.leave(entry, "a spindle that stands cuts nothing: the usual speed is written");
        }
        Ok(turns)
    }

    /// Notes an option that is not taken over.
    pub(super) fn leave(&mut self, entry: &Entry<'_>, why: impl Into<Sentence>) {
        let message = format!("`{}` is not taken over", entry.name);
        self.note(entry, message, why.into());
    }

    /// Notes what a person must know of an option that is.
    pub(super) fn advise(&mut self, entry: &Entry<'_>, what: impl Into<Sentence>) {
        self.note(entry, format!("`{}`", entry.name), what.into());
    }

    fn note(&mut self, entry: &Entry<'_>, message: String, why: Sentence) {
        let text = format!("{} = {}", entry.name, entry.value);
        let line = u32::try_from(entry.line).unwrap_or(u32::MAX);
        let source = SourceSpan::of_line(self.file, line, &text);
        self.made.left.push(planning::MILLPROJECT_OPTION.warning(message).so(why).caused_by(source));
    }

    /// Where the board lies on the machine, and how often.
    pub(super) fn place(&mut self) {
        let options = &mut self.made.options;
        if let (x @ Some(_), y) | (x, y @ Some(_)) = self.offset {
            let length = |length: Option<Nm>| Length(length.unwrap_or(Nm::ZERO));
            options.offset = Some(Place { x: length(x), y: length(y) });
        }
        let (columns, rows) = self.tiles;
        if columns * rows > 1 {
            options.tile = Some(Tiles { columns, rows });
        }
    }
}

/// As far as a hole may be from a drill that takes any. Chosen: wider than any hole.
const ANY_HOLE: Nm = Nm::from_mm(100);

fn tiles(entry: &Entry<'_>) -> Result<u32, Wrong> {
    let count = entry.count()?;
    if (1..=100).contains(&count) { Ok(count) } else { Err(entry.wrong("1 to 100")) }
}

/// The cutter as far as nothing is said of it.
pub(super) fn usual_cutter() -> OwnTool {
    let kind = match Options::defaults().cutout_tool {
        Some(ToolChoice::Kind(kind)) => kind,
        _ => ToolKind::EndMill { diameter: Nm::ZERO },
    };
    OwnTool::of(kind)
}

fn side(entry: &Entry<'_>) -> Result<CutSide, Wrong> {
    match entry.value.to_ascii_lowercase().as_str() {
        "front" => Ok(CutSide::Front),
        "back" => Ok(CutSide::Back),
        "auto" => Ok(CutSide::Auto),
        _ => Err(entry.wrong("front, back or auto")),
    }
}

impl CutSide {
    /// The side that this is of a board with copper on the back alone, or not, unless the option
    /// that asks whether it is the `front` was given.
    pub(super) fn of(self, front: Option<bool>, is_back_alone: bool) -> Option<DrillSide> {
        match (front, self) {
            (Some(true), _) | (None, Self::Front) => Some(DrillSide::Front),
            (Some(false), _) | (None, Self::Back) => Some(DrillSide::Back),
            (None, Self::Auto) => is_back_alone.then_some(DrillSide::Back),
        }
    }
}
