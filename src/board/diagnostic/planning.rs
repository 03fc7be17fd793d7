//! The kinds of things that are noticed while programs and masks are made, in the order of their
//! codes: what was found, what it does to the board, and what to try.
//!
//! Those that judge a carving or a pocket by its program are here, too: nothing else is checked of
//! them.

use super::{Stage, diagnostics};

diagnostics! {
    Stage::Planning;

    AXIS_INCOMPLETE: Warning =
        "axis-incomplete",
        "the medial axis of a carved shape may lack a branch",
        "a corner may stay uncut: this is a fault of voromill",
        "look at the place, and report it with the file";

    BEYOND_THE_MACHINE: Warning =
        "beyond-the-machine",
        "the program spans more than the machine can move",
        "the machine runs into its end stops",
        "turn the board ({rotate} 90deg), mill fewer tiles at once ({tile}), or correct {machine-travel}";

    BEYOND_THE_MACHINE_SPEED: Warning =
        "beyond-the-machine-speed",
        "a speed is asked for that the machine does not reach",
        "the job takes longer, and the chip load is smaller than planned",
        "choose a speed that the machine reaches ({feed}, {plunge}, {spindle}), or correct its profile ({machine})";

    BLEND_UNKNOWN: Warning =
        "blend-unknown",
        "the dialect has no command for rounding corners off",
        "{blend} has no effect",
        "leave {blend} out, or set the machine to round corners off";

    BOUNDARY_TORN: Warning =
        "boundary-torn",
        "a boundary ends where nothing else begins",
        "two nets may stay joined there: this is a fault of voromill",
        "report it with the board";

    CARVED_OUTSIDE: Error =
        "carved-outside",
        "a program mills beside the shapes to be carved",
        "the picture is spoilt there",
        "check offset, scale and tool of the program";

    CARVED_TOO_DEEP: Error =
        "carved-too-deep",
        "a program mills deeper than the shapes are wide",
        "edges of the shapes are cut away",
        "check the tool: its angle and its tip";

    CARVED_TOO_SHALLOW: Error =
        "carved-too-shallow",
        "a program leaves what its tool could carve",
        "lines come out thinner than they are",
        "check the tool, and where Z is zero";

    COPPER_OUTSIDE_BOARD: Warning =
        "copper-outside-board",
        "copper lies outside the outline",
        "it is not milled: it is not on the board",
        "nothing for drawing frames and text; where it belongs to the board, correct the outline ({outline})";

    CUT_OUT_NARROWER_THAN_TOOL: Warning =
        "cut-out-narrower-than-tool",
        "the cutter does not fit into a contour of the outline",
        "the cut-out is not made",
        "use a thinner cutter ({cutout-tool})";

    FLAT_FITS_NOWHERE: Warning =
        "flat-fits-nowhere",
        "the end mill of {flat} is wider than every floor",
        "the V-bit clears the floor alone, which takes longer",
        "use a thinner end mill ({flat})";

    FRAME_NOT_CUT: Warning =
        "frame-not-cut",
        "without an outline, nothing is cut round the copper",
        "copper at the edge stays joined to the clad around it",
        "give an outline ({outline}), or leave {no-frame} out";

    GAP_NARROWER_THAN_TOOL: Warning =
        "gap-narrower-than-tool",
        "a gap between two nets is narrower than the kerf",
        "the cut removes copper of both nets",
        "use a narrower tool, a smaller {depth} with a V-bit, or {narrow} skip to leave the gap uncut";

    LOOPS_BY_OFFSETS: Warning =
        "loops-by-offsets",
        "the Voronoi diagram of a pocket has a flaw",
        "its loops are offset polygons instead, which mill the same: this is a fault of voromill",
        "report it with the file";

    MASK_FROM_PADS: Warning =
        "mask-from-pads",
        "openings of a solder mask were made from the pads of the copper",
        "they may differ from those of the design",
        "nothing, where that is what is wanted";

    MASK_GAP_TAKES_COPPER: Warning =
        "mask-gap-takes-copper",
        "copper is nearer to a boundary than the gap of the mask",
        "the gap removes some of it",
        "choose a smaller {gap}";

    MASK_NET_WITHOUT_REGION: Warning =
        "mask-net-without-region",
        "a net has no region of its own",
        "the mask shows nothing of it",
        "choose a smaller {gap}";

    MASK_REGIONS_JOINED: Warning =
        "mask-regions-joined",
        "regions of nets meet",
        "etching does not part these nets",
        "choose a larger {gap}";

    MILLPROJECT_OPTION: Warning =
        "millproject-option",
        "an option of pcb2gcode has no effect here, or another one",
        "programs differ from those of pcb2gcode in that",
        "see docs/millproject.md for what to say instead";

    NARROWER_THAN_TIP: Warning =
        "narrower-than-tip",
        "shapes are narrower than the tip of the V-bit",
        "they are not carved",
        "use a V-bit with a finer tip ({tool}), or larger shapes";

    NARROWER_THAN_TOOL: Warning =
        "narrower-than-tool",
        "areas are narrower than the end mill",
        "they are not milled",
        "use a thinner end mill ({tool}), or larger shapes";

    NET_IN_PIECES: Warning =
        "net-in-pieces",
        "a net is in several pieces that no plated hole joins",
        "the pieces are isolated from each other",
        "join them with wire, or check that the drill file of plated holes is there";

    NETS_IGNORED: Warning =
        "nets-ignored",
        "nets are not isolated, as asked by {ignore}",
        "their copper is cut where a boundary of other nets runs",
        "nothing, where that is what is wanted";

    NETS_JOINED: Warning =
        "nets-joined",
        "copper of two nets touches in the design",
        "they are isolated as one net",
        "nothing for a net tie; else correct the short in the design";

    NO_DRILL_FOR_HOLE: Warning =
        "no-drill-for-hole",
        "no drill at hand has the diameter of a hole",
        "the hole is not drilled",
        "add the drill ({drills}), allow more ({drill-tolerance}), or bore it ({drill-bore})";

    NO_PLACE_FOR_TABS: Warning =
        "no-place-for-tabs",
        "fewer tabs than asked for find a place on a contour",
        "the board is held by fewer tabs",
        "make tabs narrower ({tab-width}), or say where they go ({tab-at})";

    OUTLINE_MISSING: Warning =
        "outline-missing",
        "no outline was found, or none was named",
        "the board is not cut out",
        "export the outline too, or name it with {outline} FILE";

    PATTERN_WITHOUT_NET: Warning =
        "pattern-without-net",
        "no net has a name that a pattern matches",
        "the option that has the pattern has no effect",
        "compare it with the names that `voromill inspect` lists";

    PLUNGE_STRAIGHT_DOWN: Warning =
        "plunge-straight-down",
        "a pocket is hardly wider than the tool",
        "the tool goes straight down there, and one that does not cut in its middle breaks",
        "use a thinner tool, or one that can drill";

    POCKET_OVERCUT: Error =
        "pocket-overcut",
        "a tool comes nearer to the edge of a pocket than it is wide",
        "the pocket becomes too large, or the program mills beside it",
        "check offset, scale and tool of the program";

    POCKET_PASS_TOO_THICK: Error =
        "pocket-pass-too-thick",
        "a pass takes more than {depth-pass} allows",
        "the tool may break",
        "mill the passes above it first";

    POCKET_PLUNGE_TOO_STEEP: Error =
        "pocket-plunge-too-steep",
        "the tool goes down more steeply than {ramp} allows, where there is room",
        "a tool that does not cut in its middle breaks",
        "go down in a helix or along a ramp";

    POCKET_PLUNGES: Warning =
        "pocket-plunges",
        "the tool plunges more often than it needs to",
        "it takes longer, and each plunge wears the tool",
        "link the loops within what is milled";

    POCKET_RESIDUE: Error =
        "pocket-residue",
        "a program leaves material where its tool fits",
        "the floor of the pocket has ridges",
        "check tool, stepover and depth of the program";

    POCKET_TOO_DEEP: Error =
        "pocket-too-deep",
        "a program mills below the floor of the pocket",
        "the pocket is too deep, or goes through",
        "check depth, and where Z is zero";

    RIVET_WITHOUT_HOLE: Warning =
        "rivet-without-hole",
        "no hole of the board is plated",
        "{rivet} has no effect",
        "check that the drill file says which holes are plated";

    STALE_OUTPUT: Warning =
        "stale-output",
        "programs lie in the output folder that this run did not write",
        "somebody may mill programs of different boards together",
        "move them, or write into another folder (-o)";

    TAB_OFF_THE_OUTLINE: Warning =
        "tab-off-the-outline",
        "a tab is asked for where no contour is",
        "the tab is left out",
        "correct {tab-at}: coordinates are those of the files";

    TOOL_CUTS_NOTHING: Warning =
        "tool-cuts-nothing",
        "a tool has nothing to cut",
        "none: the other tools do all of it",
        "leave it out of {tool}";

    WIDE_PLACE_LEFT: Warning =
        "wide-place-left",
        "shapes are wider than the V-bit cuts at its greatest depth",
        "there it follows the medial axis alone, and leaves the rest",
        "allow more ({max-depth}), or clear the rest with an end mill";
}
