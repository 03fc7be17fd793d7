//! The kinds of things that are wrong with files and do not keep them from being read: what was
//! expected instead, and what a person does about it.
//!
//! A warning of a reader is one of these at one place, so none can go out without advice.

use crate::board::diagnostic::{Stage, diagnostics};

diagnostics! {
    Stage::Files;

    // Of pictures.

    PICTURE_COLOUR_GUESSED: Warning =
        "picture-colour-guessed",
        "Nobody told which colour is copper",
        "the colour of copper, where it is not the rarer one",
        "say {copper} dark or {copper} light";

    PICTURE_SPECKS: Warning =
        "picture-specks",
        "Single pixels that nobody drew",
        "copper and gaps of more than a few pixels",
        "leave specks out with {despeckle} 0.05";

    // Of drawings.

    DRAWING_GUESSED: Warning =
        "drawing-role-guessed",
        "Nobody told which layer of a drawing is for what",
        "layers named as those of a board are: F.Cu, Edge.Cuts, drill",
        "say {front} FILE, {outline} FILE or {drill} FILE, with #LAYER behind the name for one layer of it";

    DRAWING_LAYERS: Warning =
        "drawing-layers-aside",
        "Layers of a drawing that no name tells of, beside such as are told",
        "layers named as those of a board are: F.Cu, Edge.Cuts, drill",
        "say what they are: {front} FILE#LAYER, {outline} FILE#LAYER or {drill} FILE#LAYER";

    DXF_LEFT_OUT: Warning =
        "dxf-left-out",
        "What of a DXF was not read",
        "lines, arcs, circles, polylines, ellipses, splines, solids, hatches and inserts of them",
        "explode other things into these in the drawing program";

    DXF_NO_END: Warning =
        "dxf-no-end",
        "A DXF without its last word",
        "EOF as the last word of the file",
        "fetch the file again, or have it written again";

    SVG_LEFT_OUT: Warning =
        "svg-left-out",
        "What of an SVG was not read",
        "visible paths and shapes, and texts with a font",
        "name a font with {font} FILE for texts; turn other things into paths";

    SVG_EFFECTS: Warning =
        "svg-effects",
        "Effects of an SVG that are not followed",
        "plain fills and strokes",
        "apply clipping, masks and filters in the drawing program, so that only paths are left";

    SVG_UNIT_ASSUMED: Warning =
        "svg-unit-assumed",
        "The width of an SVG's page has no unit",
        "a page with a width in mm or in",
        "say how long one unit is: {unit} mm, or {unit} 90dpi for old Inkscape";

    SVG_WHITE: Warning =
        "svg-white-erases",
        "White paint on an SVG",
        "no white paint, or holes that it makes",
        "delete white figures that are not meant to erase";

    // Of Gerber files.

    LATE_FORMAT: Warning =
        "late-format",
        "The number format comes after coordinates",
        "`%FS…*%` before the first coordinate",
        "have the file written with its number format in the header";

    LATE_UNITS: Warning =
        "late-units",
        "The unit comes after numbers that need it",
        "`%MOMM*%` or `%MOIN*%` before the first number",
        "have the file written with its unit in the header";

    MISSING_UNITS: Warning =
        "missing-units",
        "The unit never comes",
        "`%MOMM*%` or `%MOIN*%` in the header",
        "compare the board's size with what it should be; where it is 25.4 times off, add the unit";

    FORMAT_CHANGES: Warning =
        "format-changes",
        "A second number format",
        "one `%FS…*%` in a file",
        "check that the features behind this place lie where they should";

    CONFLICTING_UNITS: Warning =
        "conflicting-units",
        "A second unit that is not the first",
        "one unit in a file",
        "check that the features behind this place lie where they should";

    APERTURE_UNITS_GUESSED: Warning =
        "aperture-units-guessed",
        "An aperture list without a unit",
        "an aperture list that says mm, mil or inch",
        "write the unit into the list, and check the widths that `inspect -v` lists";

    APERTURE_DEFINED_TWICE: Warning =
        "aperture-defined-twice",
        "One number for two apertures",
        "each `%ADD…*%` with a number of its own",
        "check which of the two is meant; the later one holds from here on";

    MACRO_DEFINED_TWICE: Warning =
        "macro-defined-twice",
        "One name for two macros",
        "each `%AM…*%` with a name of its own",
        "check which of the two is meant; the later one holds from here on";

    UNDEFINED_APERTURE: Warning =
        "undefined-aperture",
        "An aperture that is chosen and not defined",
        "an aperture that an `%ADD…*%` defined before",
        "have the layer written again; nothing is lost as long as nothing is drawn with it";

    NEGATIVE_HOLE: Warning =
        "negative-hole",
        "An aperture with a hole of negative size",
        "a hole of a diameter above zero, or none",
        "have the layer written again without the hole";

    MISSING_STAR: Warning =
        "missing-star",
        "A command without its end",
        "`*` at the end of every command",
        "have the layer written again, or add the `*`";

    MISSING_PERCENT: Warning =
        "missing-percent",
        "An extended command without its brackets",
        "`%` before and after commands of two letters",
        "have the layer written again, or add the `%`";

    MALFORMED_APERTURE: Warning =
        "malformed-aperture",
        "An aperture that cannot be read and is not needed",
        "an aperture definition, such as `%ADD10C,0.25*%`",
        "have the layer written again if something of it is missing";

    MALFORMED_TOOL: Warning =
        "malformed-tool",
        "A drill that cannot be read and is not needed",
        "a tool with its diameter, such as `T1C0.8`",
        "count the holes that `inspect` lists";

    UNKNOWN_COMMAND: Warning =
        "unknown-command",
        "A command that no Gerber specification has",
        "a command of the Gerber format",
        "compare the copper drawn (`draw {stage} copper`) with what it should be";

    OPERATION_CODE_MISSING: Warning =
        "operation-code-missing",
        "A coordinate that does not say what it is for",
        "D01, D02 or D03 after a coordinate",
        "have the layer written with an operation in every coordinate, as specifications since 2012 ask";

    QUADRANT_MODE: Warning =
        "quadrant-mode",
        "An arc without, or against, its quadrant mode",
        "`G75*` before the first arc",
        "have the layer written with G75, and look at its arcs";

    ARC_WITHOUT_CENTRE: Warning =
        "arc-without-centre",
        "An arc without a centre",
        "I and J, the way from the arc's start to its centre",
        "look at this place of the layer; it is drawn as a line";

    ARC_RADIUS_MISMATCH: Warning =
        "arc-radius-mismatch",
        "An arc whose two ends lie at different distances from its centre",
        "both ends at one distance from the centre",
        "have the layer written with more decimals";

    REGION_NOT_CLOSED: Warning =
        "region-not-closed",
        "A contour that does not end where it began",
        "a last point equal to the first",
        "look at the edge of this region: a straight line closes it";

    FLASH_IN_REGION: Warning =
        "flash-in-region",
        "A flash where only edges may be",
        "D01 and D02 between G36 and G37",
        "have the layer written again; if the pad is missing, it is this one";

    NOTHING_DRAWN: Warning =
        "nothing-drawn",
        "What leaves no copper",
        "something that covers an area",
        "check that the layer was exported with its content, and its apertures with a size";

    NEGATIVE_IMAGE: Warning =
        "negative-image",
        "A negative image",
        "`%IPPOS*%`",
        "have the layer written positive: dark where copper is";

    NEGATIVE_FILE: Warning =
        "negative-file",
        "A file that calls itself negative",
        "`%TF.FilePolarity,Positive*%`",
        "compare the copper drawn (`draw {stage} copper`) with what it should be";

    TEXT_AFTER_END: Warning =
        "text-after-end",
        "What stands behind the end",
        "nothing after `M02*`",
        "have the layer written again where something is missing from it";

    // Of any file.

    MISSING_END_OF_FILE: Warning =
        "missing-end-of-file",
        "A Gerber file without its end",
        "`M02*` at the end of the file",
        "export or copy the file again; where it is whole, add the end";

    MISSING_END_OF_DRILL_FILE: Warning =
        "missing-end-of-file",
        "A drill file without its end",
        "`M30` at the end of the file",
        "export or copy the file again; where it is whole, add the end";

    TRUNCATED_FILE: Warning =
        "truncated-file",
        "A file that ends within something",
        "the rest of what began here",
        "export or copy the file again";

    // Of drill files.

    DIAMETER_WITHOUT_POINT: Warning =
        "diameter-without-point",
        "A diameter without a decimal point",
        "a diameter such as C0.8",
        "compare the diameter with the drill table, and have the file written with decimal points";

    DRILL_FORMAT_GUESSED: Warning =
        "drill-format-guessed",
        "A number format that the file leaves open",
        "`METRIC` or `INCH` with `LZ` or `TZ`, or decimal points",
        "have the file written with decimal points, and look at the holes on the copper";

    DRILL_UNITS_GUESSED: Warning =
        "drill-units-guessed",
        "A unit that the file leaves open",
        "`METRIC`, `INCH`, `M71` or `M72`",
        "have the file written with a header, and look at the holes on the copper";

    DRILL_OFF_BOARD: Warning =
        "drill-off-board",
        "Holes beside the copper",
        "holes within the copper",
        "check that the files belong to one board and have one origin, and the drill file its own unit";

    HOLES_OFF_BOARD: Warning =
        "holes-off-board",
        "Some holes off the board",
        "holes on the board, or in 5 mm of frame round it",
        "look whether they are meant: what is drilled there is drilled into the bed";

    DRILL_IMPLAUSIBLE: Warning =
        "drill-implausible",
        "A drill wider than any",
        "a drill of 10 mm at most",
        "check the unit of the file; wider holes are better routed";

    DRILL_WITHOUT_HOLES: Warning =
        "drill-without-holes",
        "A drill file that drills nothing",
        "at least one hole",
        "leave the file out where the board has no such holes";

    UNIT_CHANGES: Warning =
        "unit-changes",
        "A second unit in a drill file",
        "one unit in a file",
        "check that the holes behind this place lie where they should";

    CUTTER_COMPENSATION: Warning =
        "cutter-compensation",
        "A cut beside the programmed line",
        "a path of the cutter's middle",
        "have the slots written without G41 and G42";

    AXES_NOT_SWAPPED: Warning =
        "axes-not-swapped",
        "Axes that change their names",
        "X to the right and Y up",
        "have the file written without swapped axes, or turn the board";

    ROUTER_NOT_LOWERED: Warning =
        "router-not-lowered",
        "A cut in the air",
        "M15 before a cut",
        "check whether a slot is missing";

    PATTERN_MISSING: Warning =
        "pattern-missing",
        "A pattern repeated that was not drilled",
        "a pattern (M25 … M01) before it is repeated",
        "have the file written without repeats";

    DRILLED_TEXT: Warning =
        "drilled-text",
        "Letters to be drilled",
        "holes, slots and tools",
        "have the file written without text; it is no part of the circuit";

    UNKNOWN_DRILL_COMMAND: Warning =
        "unknown-drill-command",
        "A command that no drill machine is known to have",
        "a command of the Excellon format",
        "count the holes that `inspect` lists";

    NOT_A_HOLE: Warning =
        "not-a-hole",
        "A shape that no drill makes",
        "round and obround shapes in a drill file",
        "have the drill data written as Excellon";

    DUPLICATE_HOLES: Warning =
        "duplicate-holes",
        "Holes in two files",
        "each hole in one drill file",
        "leave out the file that repeats the others ({drill} names those to read)";

    // Of the outline.

    OUTLINE_EMPTY: Warning =
        "outline-empty",
        "An outline layer without lines",
        "lines and arcs along the edge of the board",
        "export the outline layer again, or name another with {outline}";

    OUTLINE_OPEN: Warning =
        "outline-open",
        "An outline that does not close",
        "lines that meet at their ends, all round the board",
        "close the edge in the board's program, or allow wider gaps with {outline-gap}";

    OUTLINE_FLASHES: Warning =
        "outline-flashes",
        "Flashes on the outline layer",
        "lines, arcs and regions on an outline layer",
        "remove them from the layer where they are meant as holes, and drill them";

    OUTLINE_GAP: Warning =
        "outline-gap",
        "Ends that did not meet",
        "each line to end where the next begins",
        "close the edge in the board's program";

    OUTLINE_LOOSE_LINES: Warning =
        "outline-loose-lines",
        "Lines that enclose nothing",
        "lines that belong to a closed edge",
        "look at the outline; lines of a drawing's frame or of dimensions may be left out";

    OUTLINE_PARTED: Warning =
        "outline-parted",
        "Lines across the board",
        "one closed line around each board",
        "for several boards in a panel, mill each from a file of its own";

    OUTLINE_TINY: Warning =
        "outline-tiny",
        "Contours that nothing can be cut along",
        "contours wider than the tool",
        "remove them from the layer; a small hole is drilled";

    OUTLINE_LETTERING: Warning =
        "outline-lettering",
        "Small contours beside the board",
        "the edge of the board and its cut-outs, no text",
        "remove the text from the outline layer";

    OUTLINE_TWICE: Warning =
        "outline-twice",
        "Two files with an edge",
        "one outline layer",
        "choose one with {outline} FILE";

    OUTLINE_MISSING: Warning =
        "outline-missing",
        "No file with an edge",
        "an outline layer among the files",
        "export it too, or name it with {outline} FILE; without it the board is not cut out";

    // Of the files together.

    JOB_FILE_UNREADABLE: Warning =
        "job-file-unreadable",
        "A job file that is none",
        "a Gerber job file (.gbrjob)",
        "export the job file again, or remove it";

    JOB_FILE_INCOMPLETE: Warning =
        "job-file-incomplete",
        "A job file with more files than there are",
        "all files of the job",
        "export the board again, or name layers with {front}, {back}, {outline} and {drill}";

    SIDE_ASSUMED: Warning =
        "side-assumed",
        "A copper layer of either side",
        "a name or file function that tells the side",
        "name it with {front} FILE or {back} FILE";

    LAYER_DISPUTED: Warning =
        "layer-disputed",
        "A layer of any kind, of which name and file function say different things",
        "a name and a file function that say the same",
        "rename it, say with {front}, {back} or {outline} FILE what it is, or leave it aside with {skip} FILE";

    ROLE_UNKNOWN: Warning =
        "role-unknown",
        "A layer of any kind",
        "a name or file function that tells the layer",
        "where it is needed, name it with {front}, {back}, {outline} or {drill}";

    FILE_NOT_UNDERSTOOD: Warning =
        "file-not-understood",
        "A text that is no prose, no layer and no drill file",
        "layers, drill files and documents",
        "export it again where it is a drill file; else leave it aside with {skip}";

    FOLDER_NOT_READ: Warning =
        "folder-not-read",
        "A folder inside the given one",
        "all files of the board in one folder",
        "give this folder too where it holds layers or drill files; else leave it aside with {skip}";

    BINARY_DRILL_FILE: Warning =
        "binary-drill-file",
        "The tape of a drilling machine",
        "a drill file as text (Excellon)",
        "nothing, where the text file has the same holes; {skip} leaves the binary one aside";

    COPPER_MISSING: Warning =
        "copper-missing",
        "No copper",
        "a layer of copper",
        "add a copper layer, or name it with {front} or {back}";

    ZERO_WIDTH_COPPER: Warning =
        "zero-width-copper",
        "Lines of no width on a copper layer",
        "apertures with a size",
        "have the layer written with apertures; lines of no width are for outlines";

    EMPTY_COPPER: Warning =
        "empty-copper",
        "A copper layer without copper",
        "copper",
        "check that the layer was exported with its content";

    SIZE_IMPLAUSIBLE: Warning =
        "size-implausible",
        "A board as wide as a table",
        "a board of 620 mm at most",
        "check the unit of each file with `inspect`";

    // Of KiCad boards.

    KICAD_TEXT: Warning =
        "kicad-text",
        "A text that KiCad draws with a font of its own",
        "copper whose shape is in the file",
        "plot the board as Gerber in KiCad and give those files, where the text matters; nets do not change";

    KICAD_NOT_READ: Warning =
        "kicad-not-read",
        "Something drawn that is none of what is read",
        "pads, tracks, vias, zones, lines, arcs, circles, rectangles, polygons and curves",
        "plot the board as Gerber in KiCad and give those files";

    KICAD_LINE_STYLE: Warning =
        "kicad-line-style",
        "Dashes, hatches, round corners",
        "solid lines, full areas and square corners on copper",
        "plot the board as Gerber in KiCad and give those files";

    KICAD_BLIND_VIA: Warning =
        "kicad-blind-via",
        "A via to an inner layer",
        "vias from the front to the back",
        "use through vias on a board that is milled";

    KICAD_VIA_WITHOUT_DRILL: Warning =
        "kicad-via-without-drill",
        "A via without a hole",
        "`(drill …)` in a via",
        "save the board again in KiCad";

    KICAD_ZONE_EMPTY: Warning =
        "kicad-zone-empty",
        "A zone that was filled with nothing",
        "copper in a zone",
        "nothing, where the zone has no room; else press B in KiCad and save";

    KICAD_VERSION: Warning =
        "kicad-version",
        "A board from the future",
        "a board of KiCad 4 to 9",
        "compare what `draw` shows with KiCad, or plot the board as Gerber and give those files";
}
