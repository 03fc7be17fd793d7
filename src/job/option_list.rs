//! The one list of the options of a job: all that is said of an option by itself stands here.
//!
//! A macro, since both the command line and serde read options into a structure that they derive:
//! the library knows nothing of the one, and `options.rs` makes the other of it.

/// The options of a job by the heading of their help, for a macro that makes something of them. Of
/// each it says
///
/// - what it is for,
/// - `arg`: how the command line reads it (clap),
/// - `serde`: how a settings file does, unless as its type does,
/// - `instead_of`: the options that say the same in another way, so that one replaces the other,
/// - `needs`: without which [`Need`] it has no effect,
/// - `changes`: its [`Reach`], which the headers of programs and the subcommands go by,
/// - its name and its type, and whether the defaults have a value for it, so that it is never open.
///
/// The names of parsers are those where that macro is called.
#[doc(hidden)]
#[macro_export]
macro_rules! job_options {
    ($reader:ident) => { $reader! {
    "Isolation" {
    /// Cutter for isolation: vbit:TIP:ANGLE, endmill:DIAMETER or a name (`voromill tools`); of
    /// several the widest that fits cuts each place, so a fine tool is saved for narrow gaps
    #[arg(long, value_name = "TOOL", value_delimiter = ',')]
    #[serde(with = "list")]
    #[changes(ISOLATION, ART, PICTURES, INSPECTION)]
    pub tool: Vec<ToolChoice>,

    /// Nets that are not isolated, such as text and logos: by name, with * and ?, or by what their
    /// copper is for (NonConductor)
    #[arg(long, value_name = "PATTERN", value_delimiter = ',')]
    #[serde(with = "list")]
    #[changes(ISOLATION, PICTURES)]
    pub ignore: Vec<Pattern>,

    /// How deep the cutter isolates; deeper where the sheet is not flat, but a V-bit then cuts a
    /// wider kerf
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    #[serde(with = "text")]
    #[changes(ISOLATION, POCKETS, PICTURES, INSPECTION)]
    pub depth: Option<Length> = usual,

    /// How wide the cutter isolates, instead of --depth: the depth that a V-bit needs for this kerf
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[instead_of(depth)]
    #[changes(ISOLATION, PICTURES, INSPECTION)]
    pub kerf: Option<Length>,

    /// One cut midway between nets (voronoi: fewest cuts, most copper), a loop round each net
    /// (outline: keeps the shape of the traces), or for each net whichever takes less time (auto)
    #[arg(long, value_parser = choice::<Strategy>(), hide_possible_values = true, value_name = "STRATEGY")]
    #[changes(ISOLATION, PICTURES)]
    pub strategy: Option<Strategy> = usual,

    /// The strategy of some nets, by name as for --ignore, such as GND*=outline; the first pattern
    /// that matches a net decides
    #[arg(long, value_name = "PATTERN=STRATEGY", value_delimiter = ',')]
    #[serde(with = "list")]
    #[changes(ISOLATION, PICTURES)]
    pub strategy_for: Vec<StrategyFor>,

    /// What a cut is midway between: the edges of the copper (copper), or the axes of its traces
    /// (core), as the paper has it
    #[arg(long, value_parser = choice::<Sites>(), hide_possible_values = true, value_name = "SITES")]
    #[changes(ISOLATION, PICTURES)]
    pub sites: Option<Sites> = usual,

    /// Greatest distance from its copper at which the region of a net ends, and is cut round; for
    /// less capacitance between nets
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(ISOLATION, PICTURES)]
    pub limit: Option<Length>,

    /// Clear this width beside every net where there is room, in several passes; for easier
    /// soldering and higher voltages
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[instead_of(passes)]
    #[changes(ISOLATION, PICTURES)]
    pub width: Option<Length>,

    /// Number of passes beside every net, instead of --width
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=1000))]
    #[changes(ISOLATION, PICTURES)]
    pub passes: Option<u32>,

    /// Clear all copper between nets, as far as the tools fit; takes long
    #[arg(long, num_args = 0, default_missing_value = "true")]
    #[instead_of(width, passes)]
    #[changes(ISOLATION, PICTURES)]
    pub clear: Option<bool>,

    /// Clear all copper in the regions of some nets, by name as for --ignore
    #[arg(long, value_name = "PATTERN", value_delimiter = ',')]
    #[serde(with = "list")]
    #[needs(Kept)]
    #[changes(ISOLATION, PICTURES)]
    pub clear_nets: Vec<Pattern>,

    /// Clear all copper in this area of the board, in the files' coordinates: a rectangle, or what
    /// a Gerber layer, SVG or DXF covers; may be given several times
    #[arg(long, value_name = "X,Y,W,H|FILE", allow_hyphen_values = true)]
    #[serde(with = "list")]
    #[needs(Kept)]
    #[changes(ISOLATION, PICTURES)]
    pub clear_area: Vec<AreaChoice>,

    /// Clear all other copper within a distance of some nets, for high voltages, such as HV*=6mm;
    /// by name as for --ignore
    #[arg(long, value_name = "PATTERN=LENGTH", value_delimiter = ',')]
    #[serde(with = "list")]
    #[needs(Kept)]
    #[changes(ISOLATION, PICTURES)]
    pub distance_for: Vec<DistanceFor>,

    /// Clear nothing in this area of the board but the cuts between nets, in the files'
    /// coordinates: a rectangle, or what a file covers; may be given several times
    #[arg(long, value_name = "X,Y,W,H|FILE", allow_hyphen_values = true)]
    #[serde(with = "list")]
    #[needs(Passes)]
    #[changes(ISOLATION, PICTURES)]
    pub keep_area: Vec<AreaChoice>,

    /// Overlap of neighbouring passes: a length, or a percentage of the kerf; more where slivers
    /// are left. A V-bit's is never less than it is narrower at the bottom of the copper
    /// [default: 10%]
    #[arg(long, value_name = "LENGTH|PERCENT")]
    #[serde(with = "text")]
    #[needs(Passes)]
    #[changes(ISOLATION, PICTURES)]
    pub overlap: Option<Overlap>,

    /// Pixel of pictures of the regions; cuts do not depend on it [default: 0.0254mm]
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[instead_of(dpi)]
    #[changes(ISOLATION, PICTURES)]
    pub pixel: Option<Length>,

    /// The same as --pixel, in pixels per inch
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..=25_400))]
    #[changes(ISOLATION, PICTURES)]
    pub dpi: Option<u32>,

    /// Make no frame cut: without an outline the copper is otherwise cut out once all round
    #[arg(long = "no-frame", num_args = 0, default_missing_value = "false")]
    #[changes(ISOLATION, PICTURES)]
    pub frame: Option<bool> = usual,

    /// Distance between the frame cut and the copper [default: the kerf or the width to be cleared,
    /// at least 0.2mm]
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[needs(Frame)]
    #[changes(ISOLATION, PICTURES)]
    pub frame_margin: Option<Length>,

    /// With --sites core: let cuts run through copper that is nearer to the axis of a neighbour
    #[arg(long = "no-min-width", num_args = 0, default_missing_value = "false")]
    #[needs(Axes)]
    #[changes(ISOLATION, PICTURES)]
    pub min_width: Option<bool> = usual,

    /// How it is found which copper touches: contact (exact), or as in the paper translucency or
    /// coincidence; all compares them in inspect
    #[arg(long, value_parser = choice::<Topology>(), hide_possible_values = true, value_name = "METHOD")]
    #[changes(ISOLATION, PICTURES, INSPECTION)]
    pub topology: Option<Topology> = usual,

    /// How far a cut may be from its exact place, so that it has few lines and arcs
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(ISOLATION, ART, PICTURES)]
    pub tolerance: Option<Length> = usual,

    /// What to do where a gap is narrower than the kerf: cut midway, into the copper of both nets
    /// (centre), leave the gap uncut (skip), or fail (error)
    #[arg(long, value_parser = choice::<Narrow>(), hide_possible_values = true, value_name = "WHAT")]
    #[changes(ISOLATION, PICTURES)]
    pub narrow: Option<Narrow> = usual,

    /// Raise a V-bit where a gap is narrow, so that it cuts narrower there, to no less than this
    /// depth; 35um at least, as thick as copper is
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(ISOLATION, PICTURES)]
    pub adaptive_depth: Option<Length>,
    }
    "Machine" {
    /// Profile of the machine, for its dialect, travel, speeds and times: 3018, shapeoko,
    /// linuxcnc-router, pcb-mill, or a file such as mine.toml (`voromill machine`)
    #[arg(long, value_name = "MACHINE")]
    #[serde(with = "in_settings")]
    #[changes(PROGRAMS, ART, PROBING)]
    pub machine: Option<MachineChoice>,

    /// Feed rate of the cutter along a cut
    #[arg(long, value_name = "SPEED")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART, PICTURES)]
    pub feed: Option<Feed> = usual,

    /// Feed rate of the cutter down into the material, straight or along a slope
    #[arg(long, value_name = "SPEED")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART, PICTURES)]
    pub plunge: Option<Feed> = usual,

    /// Spindle speed of the cutter, in revolutions per minute
    #[arg(long, value_name = "RPM", value_parser = turns)]
    #[serde(deserialize_with = "turns::deserialize")]
    #[changes(PROGRAMS, ART)]
    pub spindle: Option<u32> = usual,

    /// Direction of loops round nets and contours: climb (what is kept on the right) or
    /// conventional [default: either]
    #[arg(long, value_parser = choice::<Direction>(), hide_possible_values = true, value_name = "WAY")]
    #[changes(ISOLATION, CUTOUT, POCKETS)]
    pub direction: Option<Direction>,

    /// Pause for the spindle to come up to speed [default: 3s, or as the dialect sets]
    #[arg(long, value_name = "TIME")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART)]
    pub spin_up: Option<Wait>,

    /// Height above the copper at which the tool travels after a retract: above all clamps
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART, PICTURES, PROBING)]
    pub safe_z: Option<Length> = usual,

    /// G-code of the controller: grbl, grblhal, fluidnc, linuxcnc, mach3, mach4, marlin,
    /// reprapfirmware, klipper, smoothieware, tinyg, g2core, or a file such as mine.toml that
    /// describes a dialect
    #[arg(long, value_name = "DIALECT")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART, PROBING)]
    pub dialect: Option<DialectChoice> = usual,

    /// How far the machine may round off corners to keep its speed (G64 P), such as 0.01mm; machine
    /// leaves it as the machine is set [default: 0.005mm for linuxcnc]
    #[arg(long, value_name = "LENGTH|machine")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART, PROBING)]
    pub blend: Option<Blend>,

    /// How tools are changed: files (each tool has its own program), m6, pause (M0), or
    /// pause-with-text, where the machine waits [default: as the dialect sets]
    #[arg(long, value_parser = choice::<ToolChange>(), hide_possible_values = true, value_name = "HOW")]
    #[changes(PROGRAMS, ART)]
    pub tool_change: Option<ToolChange>,

    /// Where x and y are zero: lower-left or center of the board, or keep for the files'
    /// coordinates
    #[arg(long, value_parser = choice::<Origin>(), hide_possible_values = true, value_name = "PLACE")]
    #[changes(PROGRAMS, ART, PICTURES, PROBING)]
    pub origin: Option<Origin> = usual,

    /// Rotate the board counter-clockwise on the machine, such as 90deg where it is longer than the
    /// travel
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    #[serde(with = "text")]
    #[changes(ISOLATION, ART, PICTURES, PROBING)]
    pub rotate: Option<Angle> = usual,

    /// Move the board on the machine, after --origin; for a clamp or a corner of the stock
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART, PICTURES, PROBING)]
    pub offset: Option<Place>,

    /// The x about which the back is mirrored, on the machine; where the pins for flipping the
    /// board are [default: the middle of the board]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    #[serde(with = "text")]
    #[changes(ISOLATION, PICTURES, PROBING)]
    pub mirror_axis: Option<Length>,

    /// Mill the board several times in one piece of stock: columns and rows, such as 3x2
    #[arg(long, value_name = "NxM")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, TILING)]
    pub tile: Option<Tiles>,

    /// Distance between tiles [default: twice the diameter of the cutout tool and
    /// 1mm, so that a strip is left between the cuts]
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[needs(Tiles)]
    #[changes(PROGRAMS, TILING)]
    pub tile_spacing: Option<Length>,

    /// How far the machine can move in x, y and z, such as 280mm,170mm,40mm: a program that spans
    /// more is an error
    #[arg(long, value_name = "X,Y,Z")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART)]
    pub machine_travel: Option<Triple>,

    /// Where the tool goes at the end of each program and for tool changes: x, y and z, such as
    /// 0mm,80mm,30mm, or a height alone
    #[arg(long, value_name = "X,Y,Z|Z", allow_hyphen_values = true)]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART)]
    pub park: Option<ToolChangeAt> = usual,

    /// File with G-code of your own for the start of each program, written as it is, after the
    /// header
    #[arg(long, value_name = "FILE")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART)]
    pub before: Option<OwnLines>,

    /// File with G-code of your own for the end of each program, with the tool retracted and the
    /// spindle off
    #[arg(long, value_name = "FILE")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART)]
    pub after: Option<OwnLines>,

    /// File with G-code of your own for each tool change within a program, before the machine waits
    #[arg(long, value_name = "FILE")]
    #[serde(with = "text")]
    #[changes(PROGRAMS)]
    pub at_tool_change: Option<OwnLines>,

    /// Where the machine waits for a tool change, such as 0mm,0mm,30mm, or a height alone [default:
    /// where it parks]
    #[arg(long, value_name = "X,Y,Z|Z", allow_hyphen_values = true)]
    #[serde(with = "text")]
    #[needs(Waiting)]
    #[changes(PROGRAMS)]
    pub tool_change_at: Option<ToolChangeAt>,

    /// Touch off each tool after it is mounted, on a plate: its x and y, and the height of its top
    /// above the copper, such as -10mm,5mm,1.6mm; needs a wire on the tool and one on the plate
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    #[serde(with = "text")]
    #[changes(PROGRAMS, ART)]
    pub tool_probe: Option<Triple>,
    }
    "Drilling and cutting out" {
    /// Thickness of the board, copper included: what holes and the cutout are made and verified
    /// for; a KiCad board declares it
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(PROGRAMS, PICTURES, INSPECTION)]
    pub thickness: Option<Length> = usual,

    /// The drills that you have, such as 0.8mm,1mm,3.2mm [default: one for each diameter in the
    /// files]
    #[arg(long, value_name = "LENGTHS")]
    #[serde(with = "text")]
    #[changes(DRILLING)]
    pub drills: Option<Drills>,

    /// Drill all holes that a drill fits with the thinnest of these drills, to be drilled to size
    /// by hand
    #[arg(
        long,
        value_name = "true|false",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "true"
    )]
    #[changes(DRILLING, PICTURES)]
    pub one_drill: Option<bool>,

    /// How much a drill that you have may differ from the diameter of a hole
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(DRILLING)]
    pub drill_tolerance: Option<Length> = usual,

    /// Peck depth: how deep a drill goes before it retracts to clear chips [default: no pecks]
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(DRILLING)]
    pub drill_peck: Option<Length>,

    /// Dwell of a drill at the bottom of each hole [default: none]
    #[arg(long, value_name = "TIME")]
    #[serde(with = "text")]
    #[changes(DRILLING)]
    pub drill_dwell: Option<Wait>,

    /// Feed rate of a drill [default: by its diameter and --material]
    #[arg(long, value_name = "SPEED")]
    #[serde(with = "text")]
    #[changes(ALIGNMENT, DRILLING)]
    pub drill_plunge: Option<Feed>,

    /// Spindle speed of a drill, in revolutions per minute [default: by its diameter]
    #[arg(long, value_name = "RPM", value_parser = turns)]
    #[serde(deserialize_with = "turns::deserialize")]
    #[changes(ALIGNMENT, DRILLING)]
    pub drill_spindle: Option<u32>,

    /// Mill slots, and holes for which no drill is thick enough, with an end mill (helical boring);
    /// =false drills slots hole by hole
    #[arg(
        long,
        value_name = "true|false",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "true"
    )]
    #[changes(DRILLING)]
    pub drill_bore: Option<bool> = usual,

    /// Bore holes of this diameter and wider, and slots, even if there is a drill; for drills that
    /// wander
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(DRILLING)]
    pub drill_bore_from: Option<Length>,

    /// End mill for boring [default: --cutout-tool]
    #[arg(long, value_name = "TOOL")]
    #[serde(with = "text")]
    #[needs(Boring)]
    #[changes(DRILLING)]
    pub drill_bore_tool: Option<ToolChoice>,

    /// The side that is up while holes are drilled: front or back [default: front]
    #[arg(long, value_parser = choice::<DrillSide>(), hide_possible_values = true, value_name = "SIDE")]
    #[changes(DRILLING)]
    pub drill_side: Option<DrillSide>,

    /// Make two holes of this diameter beside the board, for the pins on which it is flipped: a
    /// program of their own
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(ALIGNMENT)]
    pub alignment_holes: Option<Length>,

    /// Distance from the edge of the board to the centres of the alignment holes
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[needs(Alignment)]
    #[changes(ALIGNMENT)]
    pub alignment_margin: Option<Length> = usual,

    /// Depth of alignment holes at their full diameter, into the bed so that pins stand [default:
    /// the thickness of the board and 3mm]
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[needs(Alignment)]
    #[changes(ALIGNMENT)]
    pub alignment_depth: Option<Length>,

    /// Depth of all holes, for any drill [default: --thickness, --break-through and the tip of each
    /// drill]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    #[serde(with = "text")]
    #[changes(DRILLING)]
    pub drill_depth: Option<Length>,

    /// How far the full diameter of a drill goes below the back of the board
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[needs(ThroughHoles)]
    #[changes(DRILLING)]
    pub break_through: Option<Length> = usual,

    /// Point angle of drills, for how deep they go; carbide drills have 130deg
    #[arg(long, value_name = "ANGLE")]
    #[serde(with = "text")]
    #[changes(ALIGNMENT, DRILLING)]
    pub drill_tip_angle: Option<Angle> = usual,

    /// Material of the board, for the speeds of drills: fr4 (glass epoxy) or fr1 (paper phenolic)
    #[arg(long, value_parser = choice::<Material>(), hide_possible_values = true, value_name = "MATERIAL")]
    #[changes(ALIGNMENT, DRILLING)]
    pub material: Option<Material> = usual,

    /// Height above the copper at which drills travel [default: --safe-z]
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(ALIGNMENT, DRILLING)]
    pub drill_safe_z: Option<Length>,

    /// How much wider plated holes are drilled, for rivets or tubes that join the two sides
    /// [default: no wider]
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(DRILLING, PICTURES)]
    pub rivet: Option<Length>,

    /// Widest gap of the outline that is closed: how far apart two of its lines may end
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(ISOLATION, CUTOUT, PICTURES, PROBING, INSPECTION)]
    pub outline_gap: Option<Length> = usual,

    /// End mill that cuts the board out of the stock
    #[arg(long, value_name = "TOOL")]
    #[serde(with = "text")]
    #[changes(CUTOUT, TILING, PICTURES)]
    pub cutout_tool: Option<ToolChoice> = usual,

    /// The side that is up while the board is cut out: front or back [default: front]
    #[arg(long, value_parser = choice::<DrillSide>(), hide_possible_values = true, value_name = "SIDE")]
    #[changes(CUTOUT)]
    pub cutout_side: Option<DrillSide>,

    /// Depth of the cutout [default: 0.1 mm more than --thickness]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    #[serde(with = "text")]
    #[changes(CUTOUT, PICTURES)]
    pub cutout_depth: Option<Length>,

    /// Depth of each pass of the cutout, and of each turn of boring; less for a thin cutter
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[changes(CUTOUT, DRILLING, PICTURES)]
    pub cutout_pass: Option<Length>,

    /// Angle at which the cutter ramps down along the contour wherever it goes down, for cutters
    /// that cannot plunge [default: straight down]
    #[arg(long, value_name = "ANGLE")]
    #[serde(with = "text")]
    #[changes(CUTOUT, PICTURES)]
    pub cutout_ramp: Option<Angle>,

    /// Number of holding tabs on each contour; small cut-outs have none
    #[arg(long, value_name = "NUMBER")]
    #[changes(CUTOUT, PICTURES)]
    pub tabs: Option<u32>,

    /// Greatest distance between tabs along the contour, instead of --tabs
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[instead_of(tabs)]
    #[changes(CUTOUT, PICTURES)]
    pub tab_spacing: Option<Length>,

    /// Put a tab at this place of the outline, in the files' coordinates; may be given several
    /// times
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    #[serde(with = "list")]
    #[instead_of(tabs, tab_spacing)]
    #[changes(CUTOUT, PICTURES)]
    pub tab_at: Vec<Place>,

    /// Width of a tab
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[needs(Tabs)]
    #[changes(CUTOUT, PICTURES)]
    pub tab_width: Option<Length> = usual,

    /// Height of a tab above the back of the board, or above the bottom of a cut that does not
    /// reach it: less is easier to break
    #[arg(long, value_name = "LENGTH")]
    #[serde(with = "text")]
    #[needs(Tabs)]
    #[changes(CUTOUT, PICTURES)]
    pub tab_height: Option<Length> = usual,
    }
    "Output" {
    /// File name of a program: front, back, drill, cutout or alignment, and a name, such as
    /// front=top.ngc
    #[arg(long, value_name = "PROGRAM=FILE")]
    #[serde(with = "list")]
    #[changes(NAMES)]
    pub output_name: Vec<OutputName>,
    }
    } };
}
