//! The options of a job, each known once: its name on the command line is its key in
//! `voromill.toml` and in the report, its text is read by the same parser everywhere.

use serde::{Deserialize, Serialize};

use crate::gcode::dialect::ToolChange;
use crate::toolpath::{Angle, Direction, Feed, Material};

use super::by_net::StrategyFor;
use super::choice::{DialectChoice, DrillSide, Narrow, Origin, Sites, Strategy, Topology};
use super::machine::{MachineChoice, in_settings};
use super::output_name::OutputName;
use super::overlap::Overlap;
use super::own_lines::OwnLines;
use super::pattern::Pattern;
use super::quantity::{Drills, Length, Place, Tiles, ToolChangeAt, Triple, Wait, list, text};
use super::tools::{Library, ToolChoice};
use super::turns;
use crate::gcode::dialect::Blend;

/// The options of a job, for a macro that makes something of them: of each what it is for, how the
/// command line (clap) and a settings file (serde) read it, its name and its type. The names of
/// parsers are those where that macro is called.
#[doc(hidden)]
#[macro_export]
macro_rules! job_options {
    ($reader:ident) => { $reader! {
    /// Cutter for isolation: vbit:TIP:ANGLE, endmill:DIAMETER or a name; of several the widest that
    /// fits cuts each place
    #[arg(long, value_name = "TOOL", value_delimiter = ',', help_heading = "Isolation")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub tool: Vec<ToolChoice>,

    /// Nets that are not isolated, such as text: by name, with * and ?, or by what their copper is
    /// for (NonConductor)
    #[arg(long, value_name = "PATTERN", value_delimiter = ',', help_heading = "Isolation")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub ignore: Vec<Pattern>,

    /// How deep it cuts; a V-bit cuts wider the deeper it goes
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub depth: Option<Length>,

    /// How wide it cuts: the depth that a V-bit needs for it
    #[arg(long, value_name = "LENGTH", conflicts_with = "depth", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub kerf: Option<Length>,

    /// One cut midway between nets (voronoi), a loop round each net (outline), or for each net
    /// whichever takes less time (auto)
    #[arg(
        long,
        value_parser = choice::<Strategy>(),
        hide_possible_values = true,
        value_name = "STRATEGY",
        help_heading = "Isolation"
    )]
    pub strategy: Option<Strategy>,

    /// The strategy of some nets, by name as for --ignore, such as GND*=outline; the first pattern
    /// that matches a net decides
    #[arg(long, value_name = "PATTERN=STRATEGY", value_delimiter = ',', help_heading = "Isolation")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub strategy_for: Vec<StrategyFor>,

    /// What a cut is midway between: copper (its edge) or core (the axes it was drawn along)
    #[arg(long, value_parser = choice::<Sites>(), hide_possible_values = true, value_name = "SITES", help_heading = "Isolation")]
    pub sites: Option<Sites>,

    /// A net's region ends at this distance from its copper, and is cut round there
    #[arg(long, value_name = "LENGTH", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub limit: Option<Length>,

    /// Clear the gap beside every net to this width where there is room, in several passes
    #[arg(long, value_name = "LENGTH", conflicts_with = "passes", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub width: Option<Length>,

    /// Number of passes beside every net, instead of --width
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=1000), help_heading = "Isolation")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passes: Option<u32>,

    /// Clear everything between nets, as far as the tools fit
    #[arg(
        long,
        num_args = 0,
        default_missing_value = "true",
        conflicts_with_all = ["width", "passes"],
        help_heading = "Isolation"
    )]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clear: Option<bool>,

    /// Overlap of neighbouring passes: a length, or a part of the kerf [default: 10%]
    #[arg(long, value_name = "LENGTH|PERCENT", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub overlap: Option<Overlap>,

    /// Size of a pixel of the picture that finds the boundaries, at most [default: as coarse as the
    /// smallest gap allows]
    #[arg(long, value_name = "LENGTH", conflicts_with = "dpi", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub pixel: Option<Length>,

    /// --pixel as a number of pixels to the inch
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=25_400), help_heading = "Isolation")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dpi: Option<u32>,

    /// Without an outline: do not cut once round the copper
    #[arg(long = "no-frame", num_args = 0, default_missing_value = "false", help_heading = "Isolation")]
    pub frame: Option<bool>,

    /// How far this frame cut keeps from copper [default: the kerf or the width to be cleared,
    /// 0.2mm at least]
    #[arg(long, value_name = "LENGTH", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub frame_margin: Option<Length>,

    /// With core axes: let boundaries run through copper that a neighbour's axis is nearer to, as
    /// without the paper's minimum width
    #[arg(long = "no-min-width", num_args = 0, default_missing_value = "false", help_heading = "Isolation")]
    pub min_width: Option<bool>,

    /// How touching copper is found: contact, translucency, coincidence; all compares them in
    /// inspect
    #[arg(long, value_parser = choice::<Topology>(), hide_possible_values = true, value_name = "METHOD", help_heading = "Isolation")]
    pub topology: Option<Topology>,

    /// How far a fitted cut may leave its exact place
    #[arg(long, value_name = "LENGTH", help_heading = "Isolation")]
    #[serde(with = "text")]
    pub tolerance: Option<Length>,

    /// Where the cut does not fit: keep it centred (centre), leave the gap uncut (skip), or fail
    /// (error)
    #[arg(long, value_parser = choice::<Narrow>(), hide_possible_values = true, value_name = "WHAT", help_heading = "Isolation")]
    pub narrow: Option<Narrow>,

    /// Let a V-bit rise to no less than this depth where the gap is narrow
    #[arg(long, value_name = "LENGTH", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub adaptive_depth: Option<Length>,

    /// The machine, for its speeds, its travel, its dialect and the time: 3018, shapeoko,
    /// linuxcnc-router, pcb-mill, or a file such as mine.toml
    #[arg(long, value_name = "MACHINE", help_heading = "Machine")]
    #[serde(with = "in_settings", skip_serializing_if = "Option::is_none")]
    pub machine: Option<MachineChoice>,

    /// Speed along a cut
    #[arg(long, value_name = "SPEED", help_heading = "Machine")]
    #[serde(with = "text")]
    pub feed: Option<Feed>,

    /// Speed into the material
    #[arg(long, value_name = "SPEED", help_heading = "Machine")]
    #[serde(with = "text")]
    pub plunge: Option<Feed>,

    /// Spindle speed in turns per minute
    #[arg(long, value_name = "RPM", value_parser = turns, help_heading = "Machine")]
    #[serde(deserialize_with = "turns::deserialize")]
    pub spindle: Option<u32>,

    /// Which way round loops about nets and contours go: climb (what is kept on the right),
    /// conventional [default: either]
    #[arg(long, value_parser = choice::<Direction>(), hide_possible_values = true, value_name = "WAY", help_heading = "Machine")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<Direction>,

    /// How long the spindle is given to come up to speed [default: 3s, or as the dialect says]
    #[arg(long, value_name = "TIME", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub spin_up: Option<Wait>,

    /// Height above the copper at which the tool travels after a retract
    #[arg(long, value_name = "LENGTH", help_heading = "Machine")]
    #[serde(with = "text")]
    pub safe_z: Option<Length>,

    /// What the machine speaks: grbl, grblhal, fluidnc, linuxcnc, mach3, mach4, marlin,
    /// reprapfirmware, klipper, smoothieware, tinyg, g2core, or a file such as mine.toml that
    /// describes a dialect
    #[arg(long, value_name = "DIALECT", help_heading = "Machine")]
    #[serde(with = "text")]
    pub dialect: Option<DialectChoice>,

    /// How far the machine may round corners off to keep its speed (G64 P), such as 0.01mm; machine
    /// leaves it as the machine is set
    #[arg(long, value_name = "LENGTH|machine", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub blend: Option<Blend>,

    /// How tools are changed: files (each tool has its own), m6, pause (M0), or pause-with-text,
    /// where the machine waits at it [default: as the dialect says]
    #[arg(long, value_parser = choice::<ToolChange>(), hide_possible_values = true, value_name = "HOW", help_heading = "Machine")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tool_change: Option<ToolChange>,

    /// Where x and y are zero: lower-left, center, or keep the file's coordinates
    #[arg(long, value_parser = choice::<Origin>(), hide_possible_values = true, value_name = "PLACE", help_heading = "Machine")]
    pub origin: Option<Origin>,

    /// Turn the board counter-clockwise on the machine
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text")]
    pub rotate: Option<Angle>,

    /// Move the board on the machine, after --origin
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub offset: Option<Place>,

    /// The x about which the back is mirrored, on the machine [default: the board's middle]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub mirror_axis: Option<Length>,

    /// The board several times in one piece of stock, such as 3x2: columns and rows
    #[arg(long, value_name = "NxM", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tile: Option<Tiles>,

    /// How far the tiles are apart [default: the cutout tool and 2mm]
    #[arg(long, value_name = "LENGTH", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tile_spacing: Option<Length>,

    /// How far the machine can move in x, y and z, such as 280mm,170mm,40mm: a program that spans
    /// more is an error
    #[arg(long, value_name = "X,Y,Z", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub machine_travel: Option<Triple>,

    /// Where the tool goes at the end of each program, and for each change of tools: x, y and z,
    /// such as 0mm,80mm,30mm; or how high alone
    #[arg(long, value_name = "X,Y,Z|Z", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text")]
    pub park: Option<ToolChangeAt>,

    /// G-code of your own before each program, in a file: lines that are written as they stand,
    /// after the header
    #[arg(long, value_name = "FILE", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub before: Option<OwnLines>,

    /// The same at the end of each, the tool lifted and the spindle off
    #[arg(long, value_name = "FILE", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub after: Option<OwnLines>,

    /// The same at each change of tools within a program, before the machine waits
    #[arg(long, value_name = "FILE", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub at_tool_change: Option<OwnLines>,

    /// Where the machine waits for a tool to be changed, unless that is where it parks, such as
    /// 0mm,0mm,30mm; or how high
    #[arg(long, value_name = "X,Y,Z|Z", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tool_change_at: Option<ToolChangeAt>,

    /// Touch each tool off after it was fitted: where, and how high the plate lies there above the
    /// copper, such as -10mm,5mm,1.6mm; a wire on the tool and one on the plate
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tool_probe: Option<Triple>,

    /// How thick the board is, copper and all: what through-cuts and holes are judged against; a
    /// KiCad board says so itself
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub thickness: Option<Length>,

    /// Drills at hand, such as 0.8mm,1mm,3.2mm; else one for each diameter in the files
    #[arg(long, value_name = "LENGTHS", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drills: Option<Drills>,

    /// Drill all holes with the thinnest of these, or of those in the files, to be drilled open by
    /// hand
    #[arg(
        long,
        value_name = "true|false",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "true",
        help_heading = "Drilling and cutting out"
    )]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub one_drill: Option<bool>,

    /// How far a drill at hand may differ from the hole
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub drill_tolerance: Option<Length>,

    /// How deep a drill goes before it clears its chips
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_peck: Option<Length>,

    /// How long a drill stays at the bottom of each hole
    #[arg(long, value_name = "TIME", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_dwell: Option<Wait>,

    /// Speed of a drill into the material [default: by its diameter and --material]
    #[arg(long, value_name = "SPEED", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_plunge: Option<Feed>,

    /// Spindle speed of a drill in turns per minute [default: by its diameter]
    #[arg(long, value_name = "RPM", value_parser = turns, help_heading = "Drilling and cutting out")]
    #[serde(deserialize_with = "turns::deserialize", skip_serializing_if = "Option::is_none")]
    pub drill_spindle: Option<u32>,

    /// Bore slots, and holes thicker than the thickest drill or without one, with an end mill;
    /// =false drills slots hole by hole
    #[arg(
        long,
        value_name = "true|false",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "true",
        help_heading = "Drilling and cutting out"
    )]
    pub drill_bore: Option<bool>,

    /// Bore holes of this diameter and wider, and slots, whatever drills are at hand
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_bore_from: Option<Length>,

    /// The end mill that bores [default: the one that cuts the board out]
    #[arg(long, value_name = "TOOL", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_bore_tool: Option<ToolChoice>,

    /// The side that is up while holes are drilled: front or back
    #[arg(
        long,
        value_parser = choice::<DrillSide>(),
        hide_possible_values = true,
        value_name = "SIDE",
        help_heading = "Drilling and cutting out"
    )]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drill_side: Option<DrillSide>,

    /// Two holes of this diameter beside the board, to flip it on pins: a program of their own
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub alignment_holes: Option<Length>,

    /// How far from the board their middles are
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub alignment_margin: Option<Length>,

    /// How deep alignment holes go at their full width, for pins to stand in what lies below
    /// [default: the board's thickness and 3mm]
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub alignment_depth: Option<Length>,

    /// How deep all holes go, whatever their drill [default: the board's thickness, --break-through
    /// and the tip of each drill]
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        help_heading = "Drilling and cutting out"
    )]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_depth: Option<Length>,

    /// How far a drill's full width goes beyond the board's back
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub break_through: Option<Length>,

    /// The angle of the tip of drills that have no table of their own; carbide drills have 130deg
    #[arg(long, value_name = "ANGLE", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub drill_tip_angle: Option<Angle>,

    /// What the board is made of, for the speeds of drills: fr4 (glass epoxy) or fr1 (paper
    /// phenolic)
    #[arg(
        long,
        value_parser = choice::<Material>(),
        hide_possible_values = true,
        value_name = "MATERIAL",
        help_heading = "Drilling and cutting out"
    )]
    pub material: Option<Material>,

    /// Height for travel while drilling [default: --safe-z]
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_safe_z: Option<Length>,

    /// Drill plated holes this much wider, for rivets or tubes
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub rivet: Option<Length>,

    /// How far apart two lines of the outline may end and still meet
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub outline_gap: Option<Length>,

    /// End mill that cuts the board out
    #[arg(long, value_name = "TOOL", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub cutout_tool: Option<ToolChoice>,

    /// The side that is up while the board is cut out: front or back
    #[arg(
        long,
        value_parser = choice::<DrillSide>(),
        hide_possible_values = true,
        value_name = "SIDE",
        help_heading = "Drilling and cutting out"
    )]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cutout_side: Option<DrillSide>,

    /// How deep the board is cut out in the end [default: 0.1 mm more than it is thick]
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        help_heading = "Drilling and cutting out"
    )]
    #[serde(with = "text")]
    pub cutout_depth: Option<Length>,

    /// How much deeper each pass goes
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub cutout_pass: Option<Length>,

    /// How steeply the cutter goes down along the contour at each pass, instead of straight down
    #[arg(long, value_name = "ANGLE", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub cutout_ramp: Option<Angle>,

    /// Holding tabs on each contour; small cut-outs have none
    #[arg(long, value_name = "NUMBER", help_heading = "Drilling and cutting out")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tabs: Option<u32>,

    /// The greatest tab spacing, instead of a number of tabs
    #[arg(long, value_name = "LENGTH", conflicts_with = "tabs", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tab_spacing: Option<Length>,

    /// A tab next to this place of the board, in the files' coordinates; as often as there are tabs
    #[arg(
        long,
        value_name = "X,Y",
        allow_hyphen_values = true,
        conflicts_with_all = ["tabs", "tab_spacing"],
        help_heading = "Drilling and cutting out"
    )]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub tab_at: Vec<Place>,

    /// How wide a tab is
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub tab_width: Option<Length>,

    /// How much material a tab leaves
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub tab_height: Option<Length>,

    /// What a program's file is called in the folder of outputs: front, back, drill, cutout or
    /// alignment, and a name, such as front=top.ngc
    #[arg(long, value_name = "PROGRAM=FILE", help_heading = "Output")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub output_name: Vec<OutputName>,
    } };
}

/// The structure of the options, for serde.
macro_rules! structure {
    ($(
        $(#[doc = $about:tt])+
        #[arg($($argument:tt)*)]
        $(#[serde($($key:tt)*)])?
        pub $name:ident: $kind:ty,
    )+) => {
        /// What a person asked for; what they left open is none.
        #[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
        pub struct Options {
            $(
                $(#[doc = $about])+
                $(#[serde($($key)*)])?
                pub $name: $kind,
            )+

            /// One's own tools: tables of the settings file alone.
            #[serde(skip_serializing)]
            pub tools: Library,
        }
    };
}

job_options!(structure);

impl Options {
    /// Every option that is set, by name, as it is written.
    #[must_use]
    pub fn listed(&self) -> Vec<(String, String)> {
        let Ok(serde_json::Value::Object(options)) = serde_json::to_value(self) else { return Vec::new() };
        let shown =
            |value: serde_json::Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let set = options.into_iter().filter(|(_, value)| !value.is_null());
        set.map(|(key, value)| (key, shown(value))).collect()
    }
}
