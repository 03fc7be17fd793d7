//! The kinds of things that are noticed while programs and masks are made, in the order of their
//! codes: what was found, what it does to the board, and what to try.
//!
//! Those that judge a carving or a pocket by its program are here, too: nothing else is checked of
//! them.

use super::{Stage, diagnostics};

diagnostics! {
    Stage::Planning;

    AREA_OFF_THE_BOARD: Warning =
        "area-off-the-board",
        "an area to be cleared or kept does not touch the board",
        "it has no effect",
        "correct {clear-area} or {keep-area}: they take the coordinates of the files";

    AXIS_INCOMPLETE: Warning =
        "axis-incomplete",
        "the medial axis of a carved shape may lack a branch",
        "a corner may stay uncut: this is a bug in voromill",
        "look at the place, and report it with the file";

    BEYOND_THE_MACHINE: Warning =
        "beyond-the-machine",
        "the program spans more than the machine can move",
        "the machine runs into its end stops",
        "turn the board ({rotate} 90deg), mill fewer tiles at once ({tile}), or correct {machine-travel}";

    BEYOND_THE_MACHINE_SPEED: Warning =
        "beyond-the-machine-speed",
        "a requested speed is outside the range of the machine",
        "the job takes longer, and the chip load is smaller than planned",
        "choose a speed within that range ({feed}, {plunge}, {spindle}), or correct the profile ({machine})";

    BLEND_UNKNOWN: Warning =
        "blend-unknown",
        "the dialect has no path blending (G64 P)",
        "{blend} has no effect",
        "leave {blend} out, or set path blending on the machine";

    BOARDS_CLOSER_THAN_TOOL: Warning =
        "boards-closer-than-tool",
        "the cutter does not fit between two boards",
        "what lies between them stays on both",
        "use a thinner cutter ({cutout-tool}), or move the boards apart";

    CARVED_OUTSIDE: Error =
        "carved-outside",
        "a program mills outside the shapes to be carved",
        "material that should stay is removed there",
        "check offset, scale and tool of the program";

    CARVED_TOO_DEEP: Error =
        "carved-too-deep",
        "a program mills deeper than the width of the shapes allows",
        "edges of the shapes are cut away",
        "check the tool: its angle and its tip";

    CARVED_TOO_SHALLOW: Error =
        "carved-too-shallow",
        "a program leaves material that its tool could carve",
        "lines become thinner than drawn",
        "check the tool, and where Z is zero";

    CARVING_PASS_TOO_DEEP: Warning =
        "carving-pass-too-deep",
        "a pass of the V-bit is deeper than 3 mm",
        "the V-bit bends or breaks, and its shank may meet the work",
        "carve in several passes ({depth-pass}), or less deep ({max-depth})";

    COPPER_OUTSIDE_BOARD: Warning =
        "copper-outside-board",
        "copper lies outside the outline",
        "it is not milled: it is not on the board",
        "nothing for drawing frames and text; if it belongs to the board, correct the outline ({outline})";

    CUT_OUT_NARROWER_THAN_TOOL: Warning =
        "cut-out-narrower-than-tool",
        "the cutter does not fit into a contour of the outline",
        "that contour is not cut",
        "use a thinner cutter ({cutout-tool})";

    FLAT_FITS_NOWHERE: Warning =
        "flat-fits-nowhere",
        "the end mill of {flat} fits nowhere",
        "the V-bit clears the floor alone, which takes longer",
        "use a thinner end mill ({flat})";

    FRAME_NOT_CUT: Warning =
        "frame-not-cut",
        "there is neither an outline nor a frame cut round the copper",
        "nets at the edge stay joined through the copper around them",
        "give an outline ({outline}), or leave {no-frame} out";

    GAP_NARROWER_THAN_TOOL: Warning =
        "gap-narrower-than-tool",
        "a gap between two nets is narrower than the kerf",
        "the cut removes copper of both nets",
        "use a narrower tool, a smaller {depth} with a V-bit, or {narrow} skip to leave the gap uncut";

    HOLES_OVERLAP: Warning =
        "holes-overlap",
        "holes to be drilled overlap each other",
        "the drill slips into the hole that is there already, or breaks",
        "draw a slot in their place, or bore them with a mill ({drill-bore}, {drill-bore-from})";

    LOOPS_BY_OFFSETS: Warning =
        "loops-by-offsets",
        "the Voronoi diagram of a pocket is faulty",
        "its loops are offset polygons instead, which mill the same: this is a bug in voromill",
        "report it with the file";

    MASK_FROM_PADS: Info =
        "mask-from-pads",
        "solder-mask openings were made from the copper pads",
        "they may differ from those of the design",
        "nothing, if this is intended";

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
        "etching does not separate these nets",
        "choose a larger {gap}";

    MILLED_IN_FULL_WIDTH: Warning =
        "milled-in-full-width",
        "a pocket has no room to either side of the tool for the engagement asked for",
        "the tool mills a groove in its full width there, in layers so shallow that it bears no more than elsewhere",
        "nothing, or use a thinner tool ({tool})";

    MILLED_IN_LOOPS: Warning =
        "milled-in-loops",
        "an area of a pocket is not cleared in arcs: it would take more than 200000, or its medial axis is faulty",
        "it is milled in loops, in layers so shallow that the tool bears no more than elsewhere, which takes longer",
        "use a wider {tool} or a greater {engagement}; a faulty axis is a bug in voromill: report it with the file";

    MILLPROJECT_OPTION: Warning =
        "millproject-option",
        "a pcb2gcode option has no effect here, or a different one",
        "programs differ from those of pcb2gcode",
        "see docs/millproject.md for what to use instead";

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
        "nets are not isolated, as requested with {ignore}",
        "their copper is cut where a boundary of other nets runs",
        "nothing, if this is intended";

    NETS_JOINED: Warning =
        "nets-joined",
        "copper of two nets touches in the design",
        "they are isolated as one net",
        "nothing for a net tie; else correct the short in the design";

    NO_DRILL_FOR_HOLE: Warning =
        "no-drill-for-hole",
        "no available drill fits the diameter of a hole",
        "the hole is not drilled",
        "add the drill ({drills}), allow more ({drill-tolerance}), or bore it ({drill-bore})";

    NO_PLACE_FOR_TABS: Warning =
        "no-place-for-tabs",
        "a contour has no room for all tabs",
        "the board is held by fewer tabs",
        "make tabs narrower ({tab-width}), or place them yourself ({tab-at})";

    NOT_BORED: Warning =
        "not-bored",
        "the end mill does not fit holes that were to be bored ({drill-bore-from})",
        "they are drilled",
        "choose a thinner end mill ({drill-bore-tool}), or bore wider holes alone";

    OUTLINE_MISSING: Warning =
        "outline-missing",
        "no outline was found or given",
        "the board is not cut out",
        "export the outline too, or choose it with {outline} FILE";

    PASSES_MISSING: Warning =
        "passes-missing",
        "further passes could not be placed",
        "copper stays where it should be cleared, but nets are isolated: this is a bug in voromill",
        "report it with the board";

    PATTERN_WITHOUT_NET: Warning =
        "pattern-without-net",
        "a pattern matches no net",
        "the option with this pattern has no effect",
        "compare it with the names that `voromill inspect` lists";

    PINS_WITHOUT_FLIP: Warning =
        "pins-without-flip",
        "nothing is milled with the back up",
        "no program drills alignment holes: {alignment-holes} has no effect",
        "leave it out, or choose what is milled from the back ({drill-side}, {cutout-side})";

    PLUNGE_STRAIGHT_DOWN: Warning =
        "plunge-straight-down",
        "a pocket is hardly wider than the tool",
        "the tool plunges straight down there, and one that is not centre-cutting breaks",
        "use a thinner tool, or a centre-cutting one";

    POCKET_ENGAGEMENT: Error =
        "pocket-engagement",
        "a tool meets material along more of its circumference than the engagement allows",
        "it bends, chatters or breaks",
        "check tool, feed direction and step of the program, or allow more ({engagement})";

    POCKET_OVERCUT: Error =
        "pocket-overcut",
        "a tool cuts beyond the edge of a pocket",
        "the pocket becomes too large, or the program mills outside it",
        "check offset, scale and tool of the program";

    POCKET_PASS_TOO_THICK: Error =
        "pocket-pass-too-thick",
        "a pass is deeper than {depth-pass} allows",
        "the tool may break",
        "mill the passes above it first";

    POCKET_PLUNGE_TOO_STEEP: Error =
        "pocket-plunge-too-steep",
        "the tool plunges more steeply than {ramp} allows, though there is room",
        "a tool that is not centre-cutting breaks",
        "plunge in a helix or along a ramp";

    POCKET_PLUNGES: Warning =
        "pocket-plunges",
        "the tool plunges more often than it needs to",
        "it takes longer, and each plunge wears the tool",
        "link the loops inside the milled area";

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
        "the output folder has programs that this run did not write",
        "programs of different boards may be milled together",
        "move them, or write into another folder (-o)";

    TAB_OFF_THE_OUTLINE: Warning =
        "tab-off-the-outline",
        "a tab is requested where there is no contour",
        "the tab is left out",
        "correct {tab-at}: it takes the coordinates of the files";

    TOOL_CUTS_NOTHING: Warning =
        "tool-cuts-nothing",
        "a tool has nothing to cut",
        "none: the other tools cut everything",
        "leave it out of {tool}";

    WIDE_PLACE_LEFT: Warning =
        "wide-place-left",
        "shapes are wider than the V-bit cuts at its greatest depth",
        "there it cuts the walls, and leaves what is between",
        "allow more ({max-depth}), or clear the rest with an end mill";
}
