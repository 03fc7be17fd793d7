use std::path::PathBuf;

use crate::board::{SourceSpan, Warning};
use crate::gcode::dialect::Blend;
use crate::gcode::dialect::ToolChange;
use crate::geometry::Nm;
use crate::job::choice::{DialectChoice, DrillSide, Origin, Strategy};
use crate::job::output_name::OutputName;
use crate::job::overlap::Overlap;
use crate::job::quantity::{DrillChoice, Drills, Length, Place, Tiles, ToolChangeAt};
use crate::job::tools::{OwnTool, ToolChoice};
use crate::job::written::Part;
use crate::toolpath::ToolKind;

use super::MillProject;
use super::value::{Entry, Units, Wrong};

/// A project while its lines are read; some options mean something only together.
pub(super) struct Draft<'a> {
    units: Units,
    file: &'a str,
    made: MillProject,
    mills: Vec<Nm>,
    width: Option<Nm>,
    extra_passes: Option<u32>,
    overlap: Option<Overlap>,
    cutter: OwnTool,
    zcut: Option<Nm>,
    bridges: Option<Nm>,
    bridges_count: Option<u32>,
    zbridges: Option<Nm>,
    offset: (Option<Nm>, Option<Nm>),
    tiles: (u32, u32),
}

/// How the cutter's table is called.
const CUTTER: &str = "millproject-cutter";

/// What pcb2gcode knows and voromill does another way, or not at all.
const LEFT: &[&str] = &[
    "al-back",
    "al-front",
    "al-probe-off",
    "al-probe-on",
    "al-probecode",
    "al-probefeed",
    "al-probevar",
    "al-setzzero",
    "al-x",
    "al-y",
    "backtrack",
    "config",
    "cut-front",
    "cut-side",
    "dpi",
    "draw-gerber-lines",
    "drill-front",
    "eulerian-paths",
    "fill-outline",
    "g0-horizontal-speed",
    "g0-vertical-speed",
    "ignore-warnings",
    "invert-gerbers",
    "mill-feed-direction",
    "mill-infeed",
    "milldrill-output",
    "min-path-length",
    "mirror-yaxis",
    "no-export",
    "nog91-1",
    "offset",
    "onedrill",
    "optimise",
    "optimize",
    "outline-width",
    "path-finding-limit",
    "post-milling-gcode",
    "postamble",
    "pre-milling-gcode",
    "preamble",
    "preamble-text",
    "preserve-thermal-reliefs",
    "spindown-time",
    "svg",
    "tsp-2opt",
    "vectorial",
    "zchange-absolute",
    "zmilldrill",
];

impl<'a> Draft<'a> {
    pub(super) fn new(units: Units, file: &'a str) -> Self {
        let kind = ToolKind::EndMill { diameter: Nm::ZERO };
        Self {
            units,
            file,
            made: MillProject::default(),
            mills: Vec::new(),
            width: None,
            extra_passes: None,
            overlap: None,
            cutter: OwnTool { kind, number: None, feed: None, plunge: None, spindle: None, depth: None },
            zcut: None,
            bridges: None,
            bridges_count: None,
            zbridges: None,
            offset: (None, None),
            tiles: (1, 1),
        }
    }

    /// Takes a line into account.
    pub(super) fn take(&mut self, entry: &Entry<'_>) -> Result<(), Wrong> {
        let units = self.units;
        match entry.name {
            "metric" => {}
            "metricoutput" if !entry.flag()? => self.leave(entry, "programs count millimetres"),
            "metricoutput" => {}
            "mill-diameters" => self.mills.extend(entry.lengths(units)?),
            "isolation-width" => self.width = Some(entry.length(units)?),
            "extra-passes" => self.extra_passes = Some(entry.count()?),
            "milling-overlap" => self.overlap = Some(entry.overlap(units)?),
            "cutter-diameter" => self.cutter.kind = ToolKind::EndMill { diameter: entry.length(units)? },
            "cut-feed" => self.cutter.feed = Some(entry.feed(units)?),
            "cut-vertfeed" => self.cutter.plunge = Some(entry.feed(units)?),
            "cut-speed" => self.cutter.spindle = Some(entry.turns()?),
            "bridges" => self.bridges = Some(entry.length(units)?),
            "bridgesnum" => self.bridges_count = Some(entry.count()?),
            "zbridges" => self.zbridges = Some(entry.length(units)?),
            "x-offset" => self.offset.0 = Some(entry.length(units)?),
            "y-offset" => self.offset.1 = Some(entry.length(units)?),
            "tile-x" => self.tiles.0 = entry.count()?,
            "tile-y" => self.tiles.1 = entry.count()?,
            "front" => self.made.files.front = Some(PathBuf::from(entry.value)),
            "back" => self.made.files.back = Some(PathBuf::from(entry.value)),
            "outline" => self.made.files.outline = Some(PathBuf::from(entry.value)),
            "drill" => self.made.files.drill = Some(PathBuf::from(entry.value)),
            "output-dir" => self.made.output = Some(PathBuf::from(entry.value)),
            "basename" => self.made.name = Some(entry.value.to_owned()),
            name if LEFT.contains(&name) => self.leave(entry, "it has no counterpart"),
            _ => self.option(entry)?,
        }
        Ok(())
    }

    /// The options that are one of ours each.
    fn option(&mut self, entry: &Entry<'_>) -> Result<(), Wrong> {
        let (units, options) = (self.units, &mut self.made.options);
        match entry.name {
            "voronoi" if entry.flag()? => options.strategy = Some(Strategy::Voronoi),
            "voronoi" => options.strategy = Some(Strategy::Outline),
            "zwork" => options.depth = Some(Length(entry.depth(units)?)),
            "zsafe" => options.safe_z = Some(Length(entry.length(units)?)),
            "zchange" => options.tool_change_at = Some(ToolChangeAt::Height(Length(entry.length(units)?))),
            "mill-feed" => options.feed = Some(entry.feed(units)?),
            "mill-vertfeed" => options.plunge = Some(entry.feed(units)?),
            "spinup-time" => options.spin_up = Some(entry.wait()?),
            "mill-speed" => options.spindle = Some(entry.turns()?),
            "zdrill" => options.drill_depth = Some(Length(entry.depth(units)?)),
            "drill-feed" => options.drill_plunge = Some(entry.feed(units)?),
            "drill-speed" => options.drill_spindle = Some(entry.turns()?),
            "drills-available" => self.drills(entry)?,
            "milldrill-diameter" => {
                let diameter = entry.length(units)?;
                options.drill_bore_tool = Some(ToolChoice::Kind(ToolKind::EndMill { diameter }));
            }
            // Corners are rounded by no more than this where it is said, and as the machine is set where it is not to be.
            "g64" | "tolerance" => {
                let most = entry.length(units)?;
                if most <= Nm::ZERO {
                    return Err(entry.wrong("a length above zero"));
                }
                if options.blend != Some(Blend::Machine) {
                    options.blend = Some(Blend::Within(most));
                }
            }
            "nog64" if entry.flag()? => options.blend = Some(Blend::Machine),
            "nog64" => {}
            // Holes are always drilled with G0 and G1.
            "nog81" if entry.flag()? => {}
            "nog81" => self.leave(entry, "holes are drilled with G0 and G1"),
            "nom6" if entry.flag()? => options.tool_change = Some(ToolChange::Pause),
            "nom6" => {}
            "front-output" => self.output(entry, Part::Front),
            "back-output" => self.output(entry, Part::Back),
            "drill-output" => self.output(entry, Part::Drill),
            "outline-output" => self.output(entry, Part::Cutout),
            "drill-side" => match entry.value.to_ascii_lowercase().as_str() {
                "front" => options.drill_side = Some(DrillSide::Front),
                "back" => options.drill_side = Some(DrillSide::Back),
                // The front, where there is one.
                "auto" => {}
                _ => return Err(entry.wrong("front, back or auto")),
            },
            "milldrill" => options.drill_bore = Some(entry.flag()?),
            "min-milldrill-hole-diameter" => options.drill_bore = Some(entry.value != "inf"),
            "zcut" => {
                self.zcut = Some(entry.depth(units)?);
                options.cutout_depth = self.zcut.map(Length);
            }
            "cut-infeed" => options.cutout_pass = Some(Length(entry.length(units)?)),
            "zero-start" if entry.flag()? => options.origin = Some(Origin::LowerLeft),
            "zero-start" => options.origin = Some(Origin::Keep),
            // Its back is mirrored about an absolute line, zero unless `mirror-axis` says otherwise.
            "mirror-absolute" if entry.flag()? => {
                options.mirror_axis = options.mirror_axis.or(Some(Length(Nm::ZERO)));
            }
            "mirror-absolute" => {
                self.leave(entry, "the back is turned about the board's middle unless mirror-axis says where")
            }
            "mirror-axis" => options.mirror_axis = Some(Length(entry.length(units)?)),
            "software" => match entry.value.to_ascii_lowercase().as_str() {
                "linuxcnc" => options.dialect = "linuxcnc".parse::<DialectChoice>().ok(),
                name @ ("mach3" | "mach4") => options.dialect = name.parse::<DialectChoice>().ok(),
                _ => self.leave(entry, "--dialect names the controller"),
            },
            _ => return Err(entry.wrong("an option of pcb2gcode")),
        }
        Ok(())
    }

    /// `0.8mm:-0.1mm:+0.05mm, 1mm`: diameters, each with how far a hole may be from it.
    fn drills(&mut self, entry: &Entry<'_>) -> Result<(), Wrong> {
        let options = &mut self.made.options;
        let mut drills = options.drills.take().map_or_else(Vec::new, |Drills(drills)| drills);
        let mut tolerance = options.drill_tolerance.map(Length::nm);
        for drill in entry.value.split([',', ' ']).filter(|part| !part.is_empty()) {
            let mut lengths = drill.split(':').map(|value| Entry { value, ..*entry }.length(self.units));
            drills
                .extend(lengths.next().transpose()?.map(|diameter| DrillChoice::Diameter(Length(diameter))));
            for off in lengths {
                let off = off?.abs();
                tolerance = Some(tolerance.map_or(off, |before| before.max(off)));
            }
        }
        options.drills = Some(Drills(drills));
        options.drill_tolerance = tolerance.map(Length);
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

    /// Notes an option that is not taken over.
    fn leave(&mut self, entry: &Entry<'_>, why: &str) {
        let text = format!("{} = {}", entry.name, entry.value);
        let message = format!("`{}` is not taken over: {why}", entry.name);
        let line = u32::try_from(entry.line).unwrap_or(u32::MAX);
        let source = SourceSpan::of_line(self.file, line, &text);
        self.made.left.push(Warning { source: Some(source), ..Warning::new("millproject-option", message) });
    }

    /// Puts together what belongs together.
    pub(super) fn finish(mut self) -> MillProject {
        self.isolation();
        self.cutout();
        let options = &mut self.made.options;
        if let (x @ Some(_), y) | (x, y @ Some(_)) = self.offset {
            let length = |length: Option<Nm>| Length(length.unwrap_or(Nm::ZERO));
            options.offset = Some(Place { x: length(x), y: length(y) });
        }
        let (columns, rows) = self.tiles;
        if columns * rows > 1 {
            options.tile = Some(Tiles { columns, rows });
        }
        self.made
    }

    /// The mills, and how wide the gap is to be.
    fn isolation(&mut self) {
        let options = &mut self.made.options;
        self.mills.retain(|&mill| mill > Nm::ZERO);
        options.tool =
            self.mills.iter().map(|&diameter| ToolChoice::Kind(ToolKind::EndMill { diameter })).collect();
        let widest = self.mills.iter().max().copied().unwrap_or(Nm::ZERO);
        // A gap that one cut makes wide enough needs no second.
        options.width = self.width.filter(|&width| width > widest).map(Length);
        let mut overlap = self.overlap;
        if let Some(extra) = self.extra_passes.filter(|&extra| extra > 0 && options.width.is_none()) {
            options.passes = Some(extra + 1);
            // Each of its extra passes is half a cutter further out.
            overlap = Some(Overlap::OfKerf { hundredths: 5_000 });
        }
        if options.width.is_some() || options.passes.is_some() {
            options.overlap = overlap;
        }
    }

    /// The cutter with its own speeds, and its bridges.
    fn cutout(&mut self) {
        let options = &mut self.made.options;
        if self.cutter.kind.width_at(Nm::ZERO) > Nm::ZERO {
            options.tools.add(CUTTER, self.cutter);
            options.cutout_tool = Some(ToolChoice::Named(CUTTER.to_owned()));
        }
        match self.bridges {
            Some(width) if width > Nm::ZERO => {
                // Two unless it says how many.
                options.tabs = Some(self.bridges_count.unwrap_or(2));
                options.tab_width = Some(Length(width));
            }
            Some(_) => options.tabs = Some(0),
            None => {}
        }
        if let (Some(top), Some(depth)) = (self.zbridges, self.zcut) {
            options.tab_height = Some(Length(top + depth));
        }
    }
}
