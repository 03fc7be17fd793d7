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
        "The colour of copper was guessed",
        "the colour of copper, where it is not the rarer one",
        "use {copper} dark or {copper} light";

    PICTURE_SPECKS: Warning =
        "picture-specks",
        "Specks or lines of single pixels",
        "copper and gaps of more than a few pixels",
        "remove specks with {despeckle} 0.05; lines want more pixels per inch";

    PICTURE_PAGES: Warning =
        "picture-pages",
        "A picture file with several pages",
        "a file with one picture",
        "save each side of the board in a file of its own, and give them with {front} and {back}";

    PICTURE_DOTS_DIFFER: Warning =
        "picture-dots-differ",
        "Drill dots that one of two pictures shows alone",
        "the same drill dots on the front and on the back",
        "look at this place on both pictures: is there a hole in the board?";

    PICTURE_SKEWED: Warning =
        "picture-skewed",
        "A picture whose edges run aslant",
        "edges along the sides of the picture",
        "turn it back with {straighten}";

    PICTURE_STRAIGHTENED: Info =
        "picture-straightened",
        "A picture was straightened",
        "edges along the sides of the picture",
        "nothing: this is what {straighten} is for";

    PICTURE_PITCH: Info =
        "picture-pitch",
        "The resolution of a picture was found by its drill dots",
        "drill dots on a grid",
        "nothing: this is what {picture-pitch} is for";

    PICTURE_PITCH_DISPUTED: Warning =
        "picture-pitch-disputed",
        "The drill dots and the file tell resolutions that differ as grids do",
        "drill dots on the grid of {picture-pitch}",
        "measure a part on the board, or its width; {picture-pitch} is the distance of neighbouring pins";

    PICTURES_REGISTERED: Info =
        "pictures-registered",
        "The picture of the back was moved onto that of the front",
        "drill dots of both sides at the same places",
        "nothing, if what is left between the dots is less than a pixel or two";

    PICTURES_NOT_REGISTERED: Warning =
        "pictures-not-registered",
        "It is not known how the pictures of the two sides lie on each other",
        "drill dots that both pictures show: three at least, and most of them",
        "check that both pictures have the same corner: they are laid corner on corner";

    // Of drawings.

    DRAWING_GUESSED: Warning =
        "drawing-role-guessed",
        "The roles of the layers of a drawing were guessed",
        "layers named as in KiCad: F.Cu, Edge.Cuts, drill",
        "use {front} FILE, {outline} FILE or {drill} FILE, with #LAYER after the name for one layer";

    DRAWING_LAYERS: Warning =
        "drawing-layers-aside",
        "Layers of a drawing that are ignored, with names that are unknown or may mean copper",
        "layers named as in KiCad: F.Cu, Edge.Cuts, drill",
        "name one layer behind the file, FILE#LAYER; what it is of a board say {front}, {outline} or {drill}";

    DRAWING_ASIDE: Warning =
        "drawing-not-milled",
        "Layers of a drawing that are not milled",
        "shapes in one layer, or in layers that are not named like those of a board",
        "name the layer that is meant behind the file: FILE#LAYER";

    DRAWING_GAP: Warning =
        "drawing-gap",
        "Gaps between lines of a drawing",
        "each line to end where the next begins",
        "close the lines in the drawing program";

    DRAWING_LINES_OPEN: Warning =
        "drawing-lines-open",
        "Lines of a drawing that are not closed",
        "lines that meet at their ends, all round each shape",
        "if they are part of a shape, close them in the drawing program, or allow wider gaps with {outline-gap}";

    DRAWING_LINES_TOUCH: Warning =
        "drawing-lines-touch",
        "Closed lines of a drawing that touch or cross each other",
        "closed lines that lie apart from each other, or within each other",
        "unite the shapes in the drawing program, or cut one out of the other";

    DRAWING_LINES_UNFILLED: Warning =
        "drawing-lines-unfilled",
        "Lines of a drawing that fill nothing, beside shapes that are filled",
        "shapes that are all filled, or closed lines alone",
        "fill the shapes that are meant, or put what belongs together into a layer and name it: FILE#LAYER";

    DXF_LEFT_OUT: Warning =
        "dxf-left-out",
        "Entities of a DXF were not read",
        "lines, arcs, circles, polylines, ellipses, splines, solids, hatches and inserts of them",
        "explode other entities into these in the drawing program";

    DXF_NO_END: Warning =
        "dxf-no-end",
        "A DXF without EOF at its end",
        "EOF at the end of the file",
        "copy or export the file again";

    SVG_LEFT_OUT: Warning =
        "svg-left-out",
        "Elements of an SVG were not read",
        "visible paths and shapes, and texts with a font",
        "choose a font for texts with {font} FILE; convert other elements to paths";

    SVG_EFFECTS: Warning =
        "svg-effects",
        "Effects of an SVG were not followed",
        "plain fills and strokes, clipping paths, masks in black and white",
        "apply filters and other masks in the drawing program, so that only paths are left";

    SVG_UNIT_ASSUMED: Warning =
        "svg-unit-assumed",
        "The page width of an SVG has no unit",
        "a page with a width in mm or in",
        "set the unit: {unit} mm, or {unit} 90dpi for old Inkscape";

    SVG_WHITE: Warning =
        "svg-white-erases",
        "White shapes in an SVG",
        "no white shapes, or white shapes that make holes",
        "delete white shapes that are not meant to erase";

    // Of Gerber files.

    LATE_FORMAT: Warning =
        "late-format",
        "The number format comes after coordinates",
        "`%FS…*%` before the first coordinate",
        "export the file with its number format in the header";

    IDLE_POINTS: Warning =
        "idle-points",
        "Coordinates of a Gerber file with decimal points that mean nothing",
        "whole numbers in the number format: `X6350568`",
        "export the file anew with another version of the CAD program, or check the size of the board";

    LATE_UNITS: Warning =
        "late-units",
        "The unit comes after numbers that need it",
        "`%MOMM*%` or `%MOIN*%` before the first number",
        "export the file with its unit in the header";

    MISSING_UNITS: Warning =
        "missing-units",
        "The unit is missing",
        "`%MOMM*%` or `%MOIN*%` in the header",
        "check the size of the board; if it is wrong by a factor of 25.4, add the unit";

    FORMAT_CHANGES: Warning =
        "format-changes",
        "A second number format",
        "one `%FS…*%` in a file",
        "check the positions of the objects after this line";

    CONFLICTING_UNITS: Warning =
        "conflicting-units",
        "A second, different unit",
        "one unit in a file",
        "check the positions of the objects after this line";

    APERTURE_UNITS_GUESSED: Warning =
        "aperture-units-guessed",
        "An aperture list without a unit",
        "an aperture list that says mm, mil or inch",
        "write the unit into the list, and check the widths that `inspect -v` lists";

    APERTURE_DEFINED_TWICE: Warning =
        "aperture-defined-twice",
        "Two apertures with one number",
        "each `%ADD…*%` with a number of its own",
        "check which of the two is right; the later one is used from here on";

    MACRO_DEFINED_TWICE: Warning =
        "macro-defined-twice",
        "Two aperture macros with one name",
        "each `%AM…*%` with a name of its own",
        "check which of the two is right; the later one is used from here on";

    UNDEFINED_APERTURE: Warning =
        "undefined-aperture",
        "An aperture that is selected but not defined",
        "an aperture that an `%ADD…*%` has defined",
        "export the layer again; nothing is lost, since nothing is drawn with it";

    NEGATIVE_HOLE: Warning =
        "negative-hole",
        "An aperture with a hole of negative size",
        "a hole of a diameter above zero, or none",
        "export the layer again without the hole";

    MISSING_STAR: Warning =
        "missing-star",
        "A command without its end character",
        "`*` at the end of every command",
        "export the layer again, or add the `*`";

    MISSING_PERCENT: Warning =
        "missing-percent",
        "An extended command without `%`",
        "`%` before and after commands of two letters",
        "export the layer again, or add the `%`";

    MALFORMED_APERTURE: Warning =
        "malformed-aperture",
        "An unused aperture that cannot be read",
        "an aperture definition, such as `%ADD10C,0.25*%`",
        "export the layer again if something is missing";

    MALFORMED_TOOL: Warning =
        "malformed-tool",
        "An unused tool that cannot be read",
        "a tool with its diameter, such as `T1C0.8`",
        "count the holes that `inspect` lists";

    UNKNOWN_COMMAND: Warning =
        "unknown-command",
        "An unknown Gerber command",
        "a command of the Gerber format",
        "compare the copper drawn (`draw {stage} copper`) with the design";

    OPERATION_CODE_MISSING: Warning =
        "operation-code-missing",
        "A coordinate without an operation code",
        "D01, D02 or D03 after a coordinate",
        "export the layer with an operation code in every coordinate, as the specification asks since 2012";

    QUADRANT_MODE: Warning =
        "quadrant-mode",
        "An arc without its quadrant mode, or with the wrong one",
        "`G75*` before the first arc",
        "export the layer with G75, and look at its arcs";

    ARC_WITHOUT_CENTRE: Warning =
        "arc-without-centre",
        "An arc without a centre",
        "I and J, the offset from the start of the arc to its centre",
        "look at this place on the layer; it is drawn as a line";

    ARC_RADIUS_MISMATCH: Warning =
        "arc-radius-mismatch",
        "An arc whose ends lie at different distances from its centre",
        "both ends at the same distance from the centre",
        "export the layer with more decimals";

    REGION_NOT_CLOSED: Warning =
        "region-not-closed",
        "A contour that is not closed",
        "a last point equal to the first",
        "look at the edge of this region: a straight line closes it";

    REGION_WINDS_TWICE: Warning =
        "region-winds-twice",
        "A contour that winds twice round a part of what it encloses",
        "holes that run the other way round than the contour, and contours that do not cross themselves",
        "look at this region: if that part is a hole, export the layer with another program";

    FLASH_IN_REGION: Warning =
        "flash-in-region",
        "A flash inside a region",
        "D01 and D02 between G36 and G37",
        "export the layer again; if a pad is missing, it is this one";

    POLARITY_IN_REGION: Warning =
        "polarity-in-region",
        "A polarity that changes within a region",
        "`%LPD*%` and `%LPC*%` outside of G36 and G37",
        "look at the region that begins above it: is it copper, or cut out of copper?";

    NOTHING_DRAWN: Warning =
        "nothing-drawn",
        "An object without area",
        "an object that covers an area",
        "check that the layer was exported with its content, and its apertures with a size";

    NEGATIVE_IMAGE: Warning =
        "negative-image",
        "A negative image",
        "`%IPPOS*%`",
        "export the layer positive: dark where copper is";

    NEGATIVE_FILE: Warning =
        "negative-file",
        "A file that is declared negative",
        "`%TF.FilePolarity,Positive*%`",
        "compare the copper drawn (`draw {stage} copper`) with the design";

    TEXT_AFTER_END: Warning =
        "text-after-end",
        "Content after the end of the file",
        "nothing after `M02*`, in a drill file after `M30`",
        "export it again if something is missing; of two programs in one file make two files";

    // Of any file.

    MISSING_END_OF_FILE: Warning =
        "missing-end-of-file",
        "A Gerber file without its end",
        "`M02*` at the end of the file",
        "export or copy the file again; if it is complete, add the end";

    MISSING_END_OF_DRILL_FILE: Warning =
        "missing-end-of-file",
        "A drill file without its end",
        "`M30` at the end of the file",
        "export or copy the file again; if it is complete, add the end";

    TRUNCATED_FILE: Warning =
        "truncated-file",
        "A truncated file",
        "the rest of what begins here",
        "export or copy the file again";

    // Of drill files.

    DIAMETER_WITHOUT_POINT: Warning =
        "diameter-without-point",
        "A diameter without a decimal point",
        "a diameter such as C0.8",
        "compare the diameter with the drill table, and export the file with decimal points";

    DRILL_FORMAT_GUESSED: Warning =
        "drill-format-guessed",
        "A file without a number format",
        "`METRIC` or `INCH` with `LZ` or `TZ`, or decimal points",
        "export the file with decimal points, and compare the holes with the copper";

    DRILL_UNITS_GUESSED: Warning =
        "drill-units-guessed",
        "A file without a unit",
        "`METRIC`, `INCH`, `M71` or `M72`",
        "export the file with a header, and compare the holes with the copper";

    DRILL_OFF_BOARD: Warning =
        "drill-off-board",
        "Holes outside the copper",
        "holes within the copper",
        "check that the files belong to one board, have the same origin, and that the unit of the drill file is right";

    LAYERS_NOT_REGISTERED: Warning =
        "layers-not-registered",
        "Layers or holes that do not lie on each other",
        "holes on pads, and pads on pads",
        "export all files with the same origin, and no layer mirrored";

    PARTIAL_HOLES: Warning =
        "partial-holes",
        "A drill file with blind or buried holes",
        "holes that go through the board",
        "use through vias on a board that is milled, or choose the file with {drill} to drill them through";

    PADS_WITHOUT_HOLES: Warning =
        "pads-without-holes",
        "Through-hole pads without a hole",
        "a hole in each pad of a through-hole component or a via",
        "export the drill files too, all of the same revision, or choose them with {drill}; {no-drill} if none is to be drilled";

    HOLES_OFF_BOARD: Warning =
        "holes-off-board",
        "Some holes off the board",
        "holes on the board, or at most 5 mm outside it",
        "check whether they are intended: they are drilled into the bed";

    DRILL_IMPLAUSIBLE: Warning =
        "drill-implausible",
        "A very large drill",
        "a drill of 10 mm at most",
        "check the unit of the file; larger holes are better milled";

    DRILL_WITHOUT_HOLES: Warning =
        "drill-without-holes",
        "A drill file without holes",
        "at least one hole",
        "leave the file out if the board has no such holes";

    UNIT_CHANGES: Warning =
        "unit-changes",
        "A second unit in a drill file",
        "one unit in a file",
        "check the positions of the holes after this line";

    CUTTER_COMPENSATION: Warning =
        "cutter-compensation",
        "Cutter compensation in a drill file",
        "a path of the cutter's centre",
        "export the slots without G41 and G42";

    AXES_NOT_SWAPPED: Warning =
        "axes-not-swapped",
        "Swapped or mirrored axes",
        "X to the right and Y up",
        "export the file without swapped axes, or rotate the board";

    ROUTER_NOT_LOWERED: Warning =
        "router-not-lowered",
        "A rout without a plunge",
        "M15 before a cut",
        "check whether a slot is missing";

    PATTERN_MISSING: Warning =
        "pattern-missing",
        "A repeat without a pattern",
        "a pattern (M25 … M01) before it is repeated",
        "export the file without repeats";

    DRILLED_TEXT: Warning =
        "drilled-text",
        "Drilled text",
        "holes, slots and tools",
        "export the file without text; it is not part of the circuit";

    UNKNOWN_DRILL_COMMAND: Warning =
        "unknown-drill-command",
        "An unknown drill command",
        "a command of the Excellon format",
        "count the holes that `inspect` lists";

    NOT_A_HOLE: Warning =
        "not-a-hole",
        "A shape that cannot be drilled",
        "round and obround shapes in a drill file",
        "export the drill data as Excellon";

    DUPLICATE_HOLES: Warning =
        "duplicate-holes",
        "The same holes twice",
        "each hole once, in one drill file",
        "nothing, or take one of two out of the design; {drill} chooses the files to read";

    // Of the outline.

    OUTLINE_EMPTY: Warning =
        "outline-empty",
        "An outline layer without lines",
        "lines and arcs along the edge of the board",
        "export the outline layer again, or choose another with {outline}";

    OUTLINE_OPEN: Warning =
        "outline-open",
        "An outline that is not closed",
        "lines that meet at their ends, all round the board",
        "close the outline in the CAD program, or allow wider gaps with {outline-gap}";

    OUTLINE_FLASHES: Warning =
        "outline-flashes",
        "Flashes on the outline layer",
        "lines, arcs and regions on an outline layer",
        "if they are holes, move them to the drill file";

    OUTLINE_GAP: Warning =
        "outline-gap",
        "Gaps in the outline",
        "each line to end where the next begins",
        "close the outline in the CAD program";

    OUTLINE_LOOSE_LINES: Warning =
        "outline-loose-lines",
        "Open lines on the outline layer",
        "lines that belong to a closed contour",
        "look at the outline; lines of a drawing frame or of dimensions do no harm";

    OUTLINE_PARTED: Warning =
        "outline-parted",
        "Lines across the board",
        "one closed line around each board",
        "for several boards in a panel, mill each from a file of its own";

    OUTLINE_TINY: Warning =
        "outline-tiny",
        "Contours that are too small to be cut",
        "contours wider than the tool",
        "remove them from the layer; small holes belong to the drill file";

    OUTLINE_LETTERING: Warning =
        "outline-lettering",
        "Small contours beside the board",
        "the edge of the board and its cut-outs, no text",
        "remove the text from the outline layer";

    OUTLINE_TWICE: Warning =
        "outline-twice",
        "Several outline layers",
        "one outline layer",
        "choose one with {outline} FILE";

    OUTLINE_MISSING: Warning =
        "outline-missing",
        "No outline layer",
        "an outline layer among the files",
        "export it too, or choose it with {outline} FILE; without it the board is not cut out";

    // Of the files together.

    JOB_FILE_UNREADABLE: Warning =
        "job-file-unreadable",
        "A job file that cannot be read",
        "a Gerber job file (.gbrjob)",
        "export the job file again, or remove it";

    JOB_FILE_INCOMPLETE: Warning =
        "job-file-incomplete",
        "A job file that lists missing files",
        "all files of the job",
        "export the board again, or choose layers with {front}, {back}, {outline} and {drill}";

    SIDE_ASSUMED: Warning =
        "side-assumed",
        "A copper layer whose side is unknown",
        "a file name or file function with the side",
        "choose it with {front} FILE or {back} FILE";

    LAYER_DISPUTED: Warning =
        "layer-disputed",
        "A layer whose name and file function differ",
        "a file name and a file function that agree",
        "rename it, choose it with {front}, {back} or {outline} FILE, or ignore it with {skip} FILE";

    OTHER_LAYER_CHOSEN: Warning =
        "other-layer-chosen",
        "A layer chosen as something else than it says it is",
        "a file that is what it is chosen as",
        "choose copper with {front} FILE if it is the front, with {back} FILE if it is the back, which is mirrored; the edge of the board with {outline} FILE";

    ROLE_UNKNOWN: Warning =
        "role-unknown",
        "A layer whose role is unknown",
        "a file name or file function of a layer",
        "if it is needed, choose it with {front}, {back}, {outline} or {drill}";

    FILE_NOT_UNDERSTOOD: Warning =
        "file-not-understood",
        "A text file that is neither a document, a layer nor a drill file",
        "layers, drill files and documents",
        "export it again if it is a drill file; else ignore it with {skip}";

    FOLDER_NOT_READ: Warning =
        "folder-not-read",
        "A folder inside the given one that was not read",
        "all files of the board in one folder",
        "give this folder too if it has layers or drill files; else ignore it with {skip}";

    BINARY_DRILL_FILE: Warning =
        "binary-drill-file",
        "A binary drill file",
        "a drill file as text (Excellon)",
        "nothing, if the text file has the same holes; {skip} ignores the binary one";

    COPPER_MISSING: Warning =
        "copper-missing",
        "No copper",
        "a layer of copper",
        "add a copper layer, or choose it with {front} or {back}";

    ZERO_WIDTH_COPPER: Warning =
        "zero-width-copper",
        "Lines of no width on a copper layer",
        "apertures with a size",
        "export the layer with apertures; lines of no width are for outlines";

    EMPTY_COPPER: Warning =
        "empty-copper",
        "A copper layer without copper",
        "copper",
        "check that the layer was exported with its content";

    SIZE_IMPLAUSIBLE: Warning =
        "size-implausible",
        "A very large board",
        "a board of 620 mm at most",
        "check the unit of each file with `inspect`";

    // Of KiCad boards.

    KICAD_TEXT: Warning =
        "kicad-text",
        "A text that is not drawn, or not whole",
        "texts on copper, clear of all other copper, in letters that the program has",
        "if the text matters, plot the board as Gerber in KiCad and give those files; nets do not change";

    KICAD_NOT_READ: Warning =
        "kicad-not-read",
        "An object of an unknown type",
        "pads, tracks, vias, zones, lines, arcs, circles, rectangles, polygons and curves",
        "plot the board as Gerber in KiCad and give those files";

    KICAD_LINE_STYLE: Warning =
        "kicad-line-style",
        "A line style or fill that is simplified",
        "solid lines and solid fills on copper",
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
        "A zone whose fill is empty",
        "copper in a zone",
        "nothing, if the zone has no room; else press B in KiCad and save";

    KICAD_VERSION: Warning =
        "kicad-version",
        "A board of a newer KiCad",
        "a board of KiCad 4 to 10",
        "compare what `draw` shows with KiCad, or plot the board as Gerber and give those files";
}
