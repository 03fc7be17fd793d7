//! The options of a job, each known once: its name on the command line is its key in
//! `voromill.toml` and in the report, its text is read by the same parser everywhere.

use serde::{Deserialize, Serialize};

use crate::gcode::dialect::ToolChange;
use crate::toolpath::{Angle, Direction, Feed, Material};

use super::choice::{DialectChoice, DrillSide, Narrow, Origin, Sites, Strategy, Topology};
use super::distance_for::DistanceFor;
use super::machine::{MachineChoice, in_settings};
use super::output_name::OutputName;
use super::overlap::Overlap;
use super::own_lines::OwnLines;
use super::pattern::Pattern;
use super::quantity::{Area, Drills, Length, Place, Tiles, ToolChangeAt, Triple, Wait, list, text};
use super::strategy_for::StrategyFor;
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
    /// Cutter for isolation: vbit:TIP:ANGLE, endmill:DIAMETER or a name (`voromill tools`); of
    /// several the widest that fits cuts each place, so a fine tool is saved for narrow gaps
    #[arg(long, value_name = "TOOL", value_delimiter = ',', help_heading = "Isolation")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub tool: Vec<ToolChoice>,

    /// Nets that are not isolated, such as text and logos: by name, with * and ?, or by what their
    /// copper is for (NonConductor)
    #[arg(long, value_name = "PATTERN", value_delimiter = ',', help_heading = "Isolation")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub ignore: Vec<Pattern>,

    /// How deep the cutter isolates; deeper where the sheet is not flat, but a V-bit then cuts a
    /// wider kerf
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub depth: Option<Length>,

    /// How wide the cutter isolates, instead of --depth: the depth that a V-bit needs for this kerf
    #[arg(long, value_name = "LENGTH", conflicts_with = "depth", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub kerf: Option<Length>,

    /// One cut midway between nets (voronoi: fewest cuts, most copper), a loop round each net
    /// (outline: keeps the shape of the traces), or for each net whichever takes less time (auto)
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

    /// What a cut is midway between: the edges of the copper (copper), or the axes of its traces
    /// (core), as the paper has it
    #[arg(long, value_parser = choice::<Sites>(), hide_possible_values = true, value_name = "SITES", help_heading = "Isolation")]
    pub sites: Option<Sites>,

    /// Greatest distance from its copper at which the region of a net ends, and is cut round; for
    /// less capacitance between nets
    #[arg(long, value_name = "LENGTH", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub limit: Option<Length>,

    /// Clear this width beside every net where there is room, in several passes; for easier
    /// soldering and higher voltages
    #[arg(long, value_name = "LENGTH", conflicts_with = "passes", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub width: Option<Length>,

    /// Number of passes beside every net, instead of --width
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=1000), help_heading = "Isolation")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub passes: Option<u32>,

    /// Clear all copper between nets, as far as the tools fit; takes long
    #[arg(
        long,
        num_args = 0,
        default_missing_value = "true",
        conflicts_with_all = ["width", "passes"],
        help_heading = "Isolation"
    )]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clear: Option<bool>,

    /// Clear all copper in the regions of some nets, by name as for --ignore
    #[arg(long, value_name = "PATTERN", value_delimiter = ',', help_heading = "Isolation")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub clear_nets: Vec<Pattern>,

    /// Clear all copper in this area of the board, in the files' coordinates; may be given several
    /// times
    #[arg(long, value_name = "X,Y,W,H", allow_hyphen_values = true, help_heading = "Isolation")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub clear_area: Vec<Area>,

    /// Clear all other copper within a distance of some nets, for high voltages, such as HV*=6mm;
    /// by name as for --ignore
    #[arg(long, value_name = "PATTERN=LENGTH", value_delimiter = ',', help_heading = "Isolation")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub distance_for: Vec<DistanceFor>,

    /// Clear nothing in this area of the board but the cuts between nets, in the files'
    /// coordinates; may be given several times
    #[arg(long, value_name = "X,Y,W,H", allow_hyphen_values = true, help_heading = "Isolation")]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub keep_area: Vec<Area>,

    /// Overlap of neighbouring passes: a length, or a percentage of the kerf; more where slivers
    /// are left [default: 10%]
    #[arg(long, value_name = "LENGTH|PERCENT", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub overlap: Option<Overlap>,

    /// Pixel of pictures of the regions; cuts do not depend on it [default: 0.0254mm]
    #[arg(long, value_name = "LENGTH", conflicts_with = "dpi", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub pixel: Option<Length>,

    /// The same as --pixel, in pixels per inch
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=25_400), help_heading = "Isolation")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dpi: Option<u32>,

    /// Make no frame cut: without an outline the copper is otherwise cut out once all round
    #[arg(long = "no-frame", num_args = 0, default_missing_value = "false", help_heading = "Isolation")]
    pub frame: Option<bool>,

    /// Distance between the frame cut and the copper [default: the kerf or the width to be cleared,
    /// at least 0.2mm]
    #[arg(long, value_name = "LENGTH", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub frame_margin: Option<Length>,

    /// With --sites core: let cuts run through copper that is nearer to the axis of a neighbour
    #[arg(long = "no-min-width", num_args = 0, default_missing_value = "false", help_heading = "Isolation")]
    pub min_width: Option<bool>,

    /// How it is found which copper touches: contact (exact), or as in the paper translucency or
    /// coincidence; all compares them in inspect
    #[arg(long, value_parser = choice::<Topology>(), hide_possible_values = true, value_name = "METHOD", help_heading = "Isolation")]
    pub topology: Option<Topology>,

    /// How far a cut may be from its exact place, so that it has few lines and arcs
    #[arg(long, value_name = "LENGTH", help_heading = "Isolation")]
    #[serde(with = "text")]
    pub tolerance: Option<Length>,

    /// What to do where a gap is narrower than the kerf: cut midway, into the copper of both nets
    /// (centre), leave the gap uncut (skip), or fail (error)
    #[arg(long, value_parser = choice::<Narrow>(), hide_possible_values = true, value_name = "WHAT", help_heading = "Isolation")]
    pub narrow: Option<Narrow>,

    /// Raise a V-bit where a gap is narrow, so that it cuts narrower there, to no less than this
    /// depth; keep it deeper than the copper is thick
    #[arg(long, value_name = "LENGTH", help_heading = "Isolation")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub adaptive_depth: Option<Length>,

    /// Profile of the machine, for its dialect, travel, speeds and times: 3018, shapeoko,
    /// linuxcnc-router, pcb-mill, or a file such as mine.toml (`voromill machine`)
    #[arg(long, value_name = "MACHINE", help_heading = "Machine")]
    #[serde(with = "in_settings", skip_serializing_if = "Option::is_none")]
    pub machine: Option<MachineChoice>,

    /// Feed rate of the cutter along a cut
    #[arg(long, value_name = "SPEED", help_heading = "Machine")]
    #[serde(with = "text")]
    pub feed: Option<Feed>,

    /// Feed rate of the cutter down into the material
    #[arg(long, value_name = "SPEED", help_heading = "Machine")]
    #[serde(with = "text")]
    pub plunge: Option<Feed>,

    /// Spindle speed of the cutter, in revolutions per minute
    #[arg(long, value_name = "RPM", value_parser = turns, help_heading = "Machine")]
    #[serde(deserialize_with = "turns::deserialize")]
    pub spindle: Option<u32>,

    /// Direction of loops round nets and contours: climb (what is kept on the right) or
    /// conventional [default: either]
    #[arg(long, value_parser = choice::<Direction>(), hide_possible_values = true, value_name = "WAY", help_heading = "Machine")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<Direction>,

    /// Pause for the spindle to come up to speed [default: 3s, or as the dialect sets]
    #[arg(long, value_name = "TIME", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub spin_up: Option<Wait>,

    /// Height above the copper at which the tool travels after a retract: above all clamps
    #[arg(long, value_name = "LENGTH", help_heading = "Machine")]
    #[serde(with = "text")]
    pub safe_z: Option<Length>,

    /// G-code of the controller: grbl, grblhal, fluidnc, linuxcnc, mach3, mach4, marlin,
    /// reprapfirmware, klipper, smoothieware, tinyg, g2core, or a file such as mine.toml that
    /// describes a dialect
    #[arg(long, value_name = "DIALECT", help_heading = "Machine")]
    #[serde(with = "text")]
    pub dialect: Option<DialectChoice>,

    /// How far the machine may round off corners to keep its speed (G64 P), such as 0.01mm; machine
    /// leaves it as the machine is set [default: 0.005mm for linuxcnc]
    #[arg(long, value_name = "LENGTH|machine", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub blend: Option<Blend>,

    /// How tools are changed: files (each tool has its own program), m6, pause (M0), or
    /// pause-with-text, where the machine waits [default: as the dialect sets]
    #[arg(long, value_parser = choice::<ToolChange>(), hide_possible_values = true, value_name = "HOW", help_heading = "Machine")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tool_change: Option<ToolChange>,

    /// Where x and y are zero: lower-left or center of the board, or keep for the files'
    /// coordinates
    #[arg(long, value_parser = choice::<Origin>(), hide_possible_values = true, value_name = "PLACE", help_heading = "Machine")]
    pub origin: Option<Origin>,

    /// Rotate the board counter-clockwise on the machine, such as 90deg where it is longer than the
    /// travel
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text")]
    pub rotate: Option<Angle>,

    /// Move the board on the machine, after --origin; for a clamp or a corner of the stock
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub offset: Option<Place>,

    /// The x about which the back is mirrored, on the machine; where the pins for flipping the
    /// board are [default: the middle of the board]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub mirror_axis: Option<Length>,

    /// Mill the board several times in one piece of stock: columns and rows, such as 3x2
    #[arg(long, value_name = "NxM", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tile: Option<Tiles>,

    /// Distance between tiles [default: the diameter of the cutout tool and 2mm]
    #[arg(long, value_name = "LENGTH", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tile_spacing: Option<Length>,

    /// How far the machine can move in x, y and z, such as 280mm,170mm,40mm: a program that spans
    /// more is an error
    #[arg(long, value_name = "X,Y,Z", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub machine_travel: Option<Triple>,

    /// Where the tool goes at the end of each program and for tool changes: x, y and z, such as
    /// 0mm,80mm,30mm, or a height alone
    #[arg(long, value_name = "X,Y,Z|Z", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text")]
    pub park: Option<ToolChangeAt>,

    /// File with G-code of your own for the start of each program, written as it is, after the
    /// header
    #[arg(long, value_name = "FILE", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub before: Option<OwnLines>,

    /// File with G-code of your own for the end of each program, with the tool retracted and the
    /// spindle off
    #[arg(long, value_name = "FILE", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub after: Option<OwnLines>,

    /// File with G-code of your own for each tool change within a program, before the machine waits
    #[arg(long, value_name = "FILE", help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub at_tool_change: Option<OwnLines>,

    /// Where the machine waits for a tool change, such as 0mm,0mm,30mm, or a height alone [default:
    /// where it parks]
    #[arg(long, value_name = "X,Y,Z|Z", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tool_change_at: Option<ToolChangeAt>,

    /// Touch off each tool after it is mounted, on a plate: its x and y, and the height of its top
    /// above the copper, such as -10mm,5mm,1.6mm; needs a wire on the tool and one on the plate
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, help_heading = "Machine")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tool_probe: Option<Triple>,

    /// Thickness of the board, copper included: what holes and the cutout are made and verified
    /// for; a KiCad board declares it
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub thickness: Option<Length>,

    /// The drills that you have, such as 0.8mm,1mm,3.2mm [default: one for each diameter in the
    /// files]
    #[arg(long, value_name = "LENGTHS", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drills: Option<Drills>,

    /// Drill all holes with the thinnest of --drills, or of those in the files, to be drilled to
    /// size by hand
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

    /// How much a drill that you have may differ from the diameter of a hole
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub drill_tolerance: Option<Length>,

    /// Peck depth: how deep a drill goes before it retracts to clear chips [default: no pecks]
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_peck: Option<Length>,

    /// Dwell of a drill at the bottom of each hole [default: none]
    #[arg(long, value_name = "TIME", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_dwell: Option<Wait>,

    /// Feed rate of a drill [default: by its diameter and --material]
    #[arg(long, value_name = "SPEED", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_plunge: Option<Feed>,

    /// Spindle speed of a drill, in revolutions per minute [default: by its diameter]
    #[arg(long, value_name = "RPM", value_parser = turns, help_heading = "Drilling and cutting out")]
    #[serde(deserialize_with = "turns::deserialize", skip_serializing_if = "Option::is_none")]
    pub drill_spindle: Option<u32>,

    /// Mill slots, and holes for which no drill is thick enough, with an end mill (helical boring);
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

    /// Bore holes of this diameter and wider, and slots, even if there is a drill; for drills that
    /// wander
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_bore_from: Option<Length>,

    /// End mill for boring [default: --cutout-tool]
    #[arg(long, value_name = "TOOL", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_bore_tool: Option<ToolChoice>,

    /// The side that is up while holes are drilled: front or back [default: front]
    #[arg(
        long,
        value_parser = choice::<DrillSide>(),
        hide_possible_values = true,
        value_name = "SIDE",
        help_heading = "Drilling and cutting out"
    )]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drill_side: Option<DrillSide>,

    /// Make two holes of this diameter beside the board, for the pins on which it is flipped: a
    /// program of their own
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub alignment_holes: Option<Length>,

    /// Distance from the edge of the board to the centres of the alignment holes
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub alignment_margin: Option<Length>,

    /// Depth of alignment holes at their full diameter, into the bed so that pins stand [default:
    /// the thickness of the board and 3mm]
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub alignment_depth: Option<Length>,

    /// Depth of all holes, for any drill [default: --thickness, --break-through and the tip of each
    /// drill]
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        help_heading = "Drilling and cutting out"
    )]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_depth: Option<Length>,

    /// How far the full diameter of a drill goes below the back of the board
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub break_through: Option<Length>,

    /// Point angle of drills, for how deep they go; carbide drills have 130deg
    #[arg(long, value_name = "ANGLE", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub drill_tip_angle: Option<Angle>,

    /// Material of the board, for the speeds of drills: fr4 (glass epoxy) or fr1 (paper phenolic)
    #[arg(
        long,
        value_parser = choice::<Material>(),
        hide_possible_values = true,
        value_name = "MATERIAL",
        help_heading = "Drilling and cutting out"
    )]
    pub material: Option<Material>,

    /// Height above the copper at which drills travel [default: --safe-z]
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub drill_safe_z: Option<Length>,

    /// How much wider plated holes are drilled, for rivets or tubes that join the two sides
    /// [default: no wider]
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub rivet: Option<Length>,

    /// Widest gap of the outline that is closed: how far apart two of its lines may end
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub outline_gap: Option<Length>,

    /// End mill that cuts the board out of the stock
    #[arg(long, value_name = "TOOL", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub cutout_tool: Option<ToolChoice>,

    /// The side that is up while the board is cut out: front or back [default: front]
    #[arg(
        long,
        value_parser = choice::<DrillSide>(),
        hide_possible_values = true,
        value_name = "SIDE",
        help_heading = "Drilling and cutting out"
    )]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cutout_side: Option<DrillSide>,

    /// Depth of the cutout [default: 0.1 mm more than --thickness]
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        help_heading = "Drilling and cutting out"
    )]
    #[serde(with = "text")]
    pub cutout_depth: Option<Length>,

    /// Depth of each pass of the cutout; less for a thin cutter
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub cutout_pass: Option<Length>,

    /// Angle at which the cutter ramps down along the contour in each pass, for cutters that cannot
    /// plunge [default: straight down]
    #[arg(long, value_name = "ANGLE", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub cutout_ramp: Option<Angle>,

    /// Number of holding tabs on each contour; small cut-outs have none
    #[arg(long, value_name = "NUMBER", help_heading = "Drilling and cutting out")]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tabs: Option<u32>,

    /// Greatest distance between tabs along the contour, instead of --tabs
    #[arg(long, value_name = "LENGTH", conflicts_with = "tabs", help_heading = "Drilling and cutting out")]
    #[serde(with = "text", skip_serializing_if = "Option::is_none")]
    pub tab_spacing: Option<Length>,

    /// Put a tab at this place of the outline, in the files' coordinates; may be given several
    /// times
    #[arg(
        long,
        value_name = "X,Y",
        allow_hyphen_values = true,
        conflicts_with_all = ["tabs", "tab_spacing"],
        help_heading = "Drilling and cutting out"
    )]
    #[serde(with = "list", skip_serializing_if = "Vec::is_empty")]
    pub tab_at: Vec<Place>,

    /// Width of a tab
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub tab_width: Option<Length>,

    /// Height of a tab above the back of the board: less is easier to break
    #[arg(long, value_name = "LENGTH", help_heading = "Drilling and cutting out")]
    #[serde(with = "text")]
    pub tab_height: Option<Length>,

    /// File name of a program: front, back, drill, cutout or alignment, and a name, such as
    /// front=top.ngc
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
