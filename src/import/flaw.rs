//! The kinds of things that are wrong with files and do not keep them from being read: what was
//! expected instead, and what a person does about it.
//!
//! A warning of a reader is one of these at one place, so none can go out without advice.

use crate::board::{Help, Warning};

/// A kind of flaw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::import) struct Flaw {
    /// Its stable name, by which people filter.
    pub(in crate::import) code: &'static str,
    help: Help,
}

impl Flaw {
    const fn new(code: &'static str, expected: &'static str, advice: &'static str) -> Self {
        Self { code, help: Help { expected, advice } }
    }

    /// A warning of this kind, without a place.
    pub(in crate::import) fn warning(&self, message: impl Into<String>) -> Warning {
        Warning::new(self.code, message).with(self.help)
    }
}

// Of pictures.

/// Nobody told which colour is copper.
pub(in crate::import) const PICTURE_COLOUR_GUESSED: Flaw = Flaw::new(
    "picture-colour-guessed",
    "the colour of copper, where it is not the rarer one",
    "say --copper dark or --copper light",
);

/// Single pixels that nobody drew.
pub(in crate::import) const PICTURE_SPECKS: Flaw = Flaw::new(
    "picture-specks",
    "copper and gaps of more than a few pixels",
    "leave specks out with --despeckle 0.05",
);

// Of Gerber files.

/// The number format comes after coordinates.
pub(in crate::import) const LATE_FORMAT: Flaw = Flaw::new(
    "late-format",
    "`%FS…*%` before the first coordinate",
    "have the file written with its number format in the header",
);

/// The unit comes after numbers that need it.
pub(in crate::import) const LATE_UNITS: Flaw = Flaw::new(
    "late-units",
    "`%MOMM*%` or `%MOIN*%` before the first number",
    "have the file written with its unit in the header",
);

/// The unit never comes.
pub(in crate::import) const MISSING_UNITS: Flaw = Flaw::new(
    "missing-units",
    "`%MOMM*%` or `%MOIN*%` in the header",
    "compare the board's size with what it should be; where it is 25.4 times off, add the unit",
);

/// A second number format.
pub(in crate::import) const FORMAT_CHANGES: Flaw = Flaw::new(
    "format-changes",
    "one `%FS…*%` in a file",
    "check that the features behind this place lie where they should",
);

/// A second unit that is not the first.
pub(in crate::import) const CONFLICTING_UNITS: Flaw = Flaw::new(
    "conflicting-units",
    "one unit in a file",
    "check that the features behind this place lie where they should",
);

/// An aperture list without a unit.
pub(in crate::import) const APERTURE_UNITS_GUESSED: Flaw = Flaw::new(
    "aperture-units-guessed",
    "an aperture list that says mm, mil or inch",
    "write the unit into the list, and check the widths that `inspect -v` lists",
);

/// One number for two apertures.
pub(in crate::import) const APERTURE_DEFINED_TWICE: Flaw = Flaw::new(
    "aperture-defined-twice",
    "each `%ADD…*%` with a number of its own",
    "check which of the two is meant; the later one holds from here on",
);

/// One name for two macros.
pub(in crate::import) const MACRO_DEFINED_TWICE: Flaw = Flaw::new(
    "macro-defined-twice",
    "each `%AM…*%` with a name of its own",
    "check which of the two is meant; the later one holds from here on",
);

/// An aperture that is chosen and not defined.
pub(in crate::import) const UNDEFINED_APERTURE: Flaw = Flaw::new(
    "undefined-aperture",
    "an aperture that an `%ADD…*%` defined before",
    "have the layer written again; nothing is lost as long as nothing is drawn with it",
);

/// An aperture with a hole of negative size.
pub(in crate::import) const NEGATIVE_HOLE: Flaw = Flaw::new(
    "negative-hole",
    "a hole of a diameter above zero, or none",
    "have the layer written again without the hole",
);

/// A command without its end.
pub(in crate::import) const MISSING_STAR: Flaw = Flaw::new(
    "missing-star",
    "`*` at the end of every command",
    "have the layer written again, or add the `*`",
);

/// An extended command without its brackets.
pub(in crate::import) const MISSING_PERCENT: Flaw = Flaw::new(
    "missing-percent",
    "`%` before and after commands of two letters",
    "have the layer written again, or add the `%`",
);

/// An aperture that cannot be read and is not needed.
pub(in crate::import) const MALFORMED_APERTURE: Flaw = Flaw::new(
    "malformed-aperture",
    "an aperture definition, such as `%ADD10C,0.25*%`",
    "have the layer written again if something of it is missing",
);

/// A drill that cannot be read and is not needed.
pub(in crate::import) const MALFORMED_TOOL: Flaw = Flaw::new(
    "malformed-tool",
    "a tool with its diameter, such as `T1C0.8`",
    "count the holes that `inspect` lists",
);

/// A command that no Gerber specification has.
pub(in crate::import) const UNKNOWN_COMMAND: Flaw = Flaw::new(
    "unknown-command",
    "a command of the Gerber format",
    "compare the copper drawn (`draw --stage copper`) with what it should be",
);

/// A coordinate that does not say what it is for.
pub(in crate::import) const OPERATION_CODE_MISSING: Flaw = Flaw::new(
    "operation-code-missing",
    "D01, D02 or D03 after a coordinate",
    "have the layer written with an operation in every coordinate, as specifications since 2012 ask",
);

/// An arc without, or against, its quadrant mode.
pub(in crate::import) const QUADRANT_MODE: Flaw = Flaw::new(
    "quadrant-mode",
    "`G75*` before the first arc",
    "have the layer written with G75, and look at its arcs",
);

/// An arc without a centre.
pub(in crate::import) const ARC_WITHOUT_CENTRE: Flaw = Flaw::new(
    "arc-without-centre",
    "I and J, the way from the arc's start to its centre",
    "look at this place of the layer; it is drawn as a line",
);

/// An arc whose two ends lie at different distances from its centre.
pub(in crate::import) const ARC_RADIUS_MISMATCH: Flaw = Flaw::new(
    "arc-radius-mismatch",
    "both ends at one distance from the centre",
    "have the layer written with more decimals",
);

/// A contour that does not end where it began.
pub(in crate::import) const REGION_NOT_CLOSED: Flaw = Flaw::new(
    "region-not-closed",
    "a last point equal to the first",
    "look at the edge of this region: a straight line closes it",
);

/// A flash where only edges may be.
pub(in crate::import) const FLASH_IN_REGION: Flaw = Flaw::new(
    "flash-in-region",
    "D01 and D02 between G36 and G37",
    "have the layer written again; if the pad is missing, it is this one",
);

/// What leaves no copper.
pub(in crate::import) const NOTHING_DRAWN: Flaw = Flaw::new(
    "nothing-drawn",
    "something that covers an area",
    "check that the layer was exported with its content, and its apertures with a size",
);

/// A negative image.
pub(in crate::import) const NEGATIVE_IMAGE: Flaw =
    Flaw::new("negative-image", "`%IPPOS*%`", "have the layer written positive: dark where copper is");

/// A file that calls itself negative.
pub(in crate::import) const NEGATIVE_FILE: Flaw = Flaw::new(
    "negative-file",
    "`%TF.FilePolarity,Positive*%`",
    "compare the copper drawn (`draw --stage copper`) with what it should be",
);

/// What stands behind the end.
pub(in crate::import) const TEXT_AFTER_END: Flaw = Flaw::new(
    "text-after-end",
    "nothing after `M02*`",
    "have the layer written again where something is missing from it",
);

// Of any file.

/// A Gerber file without its end.
pub(in crate::import) const MISSING_END_OF_FILE: Flaw = Flaw::new(
    "missing-end-of-file",
    "`M02*` at the end of the file",
    "export or copy the file again; where it is whole, add the end",
);

/// A drill file without its end.
pub(in crate::import) const MISSING_END_OF_DRILL_FILE: Flaw = Flaw::new(
    "missing-end-of-file",
    "`M30` at the end of the file",
    "export or copy the file again; where it is whole, add the end",
);

/// A file that ends within something.
pub(in crate::import) const TRUNCATED_FILE: Flaw =
    Flaw::new("truncated-file", "the rest of what began here", "export or copy the file again");

// Of drill files.

/// A diameter without a decimal point.
pub(in crate::import) const DIAMETER_WITHOUT_POINT: Flaw = Flaw::new(
    "diameter-without-point",
    "a diameter such as C0.8",
    "compare the diameter with the drill table, and have the file written with decimal points",
);

/// A number format that the file leaves open.
pub(in crate::import) const DRILL_FORMAT_GUESSED: Flaw = Flaw::new(
    "drill-format-guessed",
    "`METRIC` or `INCH` with `LZ` or `TZ`, or decimal points",
    "have the file written with decimal points, and look at the holes on the copper",
);

/// A unit that the file leaves open.
pub(in crate::import) const DRILL_UNITS_GUESSED: Flaw = Flaw::new(
    "drill-units-guessed",
    "`METRIC`, `INCH`, `M71` or `M72`",
    "have the file written with a header, and look at the holes on the copper",
);

/// Holes beside the copper.
pub(in crate::import) const DRILL_OFF_BOARD: Flaw = Flaw::new(
    "drill-off-board",
    "holes within the copper",
    "check that the files belong to one board and have one origin, and the drill file its own unit",
);

/// Some holes off the board.
pub(in crate::import) const HOLES_OFF_BOARD: Flaw = Flaw::new(
    "holes-off-board",
    "holes on the board, or in 5 mm of frame round it",
    "look whether they are meant: what is drilled there is drilled into the bed",
);

/// A drill wider than any.
pub(in crate::import) const DRILL_IMPLAUSIBLE: Flaw = Flaw::new(
    "drill-implausible",
    "a drill of 10 mm at most",
    "check the unit of the file; wider holes are better routed",
);

/// A drill file that drills nothing.
pub(in crate::import) const DRILL_WITHOUT_HOLES: Flaw = Flaw::new(
    "drill-without-holes",
    "at least one hole",
    "leave the file out where the board has no such holes",
);

/// A second unit in a drill file.
pub(in crate::import) const UNIT_CHANGES: Flaw = Flaw::new(
    "unit-changes",
    "one unit in a file",
    "check that the holes behind this place lie where they should",
);

/// A cut beside the programmed line.
pub(in crate::import) const CUTTER_COMPENSATION: Flaw = Flaw::new(
    "cutter-compensation",
    "a path of the cutter's middle",
    "have the slots written without G41 and G42",
);

/// Axes that change their names.
pub(in crate::import) const AXES_NOT_SWAPPED: Flaw = Flaw::new(
    "axes-not-swapped",
    "X to the right and Y up",
    "have the file written without swapped axes, or turn the board",
);

/// A cut in the air.
pub(in crate::import) const ROUTER_NOT_LOWERED: Flaw =
    Flaw::new("router-not-lowered", "M15 before a cut", "check whether a slot is missing");

/// A pattern repeated that was not drilled.
pub(in crate::import) const PATTERN_MISSING: Flaw = Flaw::new(
    "pattern-missing",
    "a pattern (M25 … M01) before it is repeated",
    "have the file written without repeats",
);

/// Letters to be drilled.
pub(in crate::import) const DRILLED_TEXT: Flaw = Flaw::new(
    "drilled-text",
    "holes, slots and tools",
    "have the file written without text; it is no part of the circuit",
);

/// A command that no drill machine is known to have.
pub(in crate::import) const UNKNOWN_DRILL_COMMAND: Flaw = Flaw::new(
    "unknown-drill-command",
    "a command of the Excellon format",
    "count the holes that `inspect` lists",
);

/// A shape that no drill makes.
pub(in crate::import) const NOT_A_HOLE: Flaw = Flaw::new(
    "not-a-hole",
    "round and obround shapes in a drill file",
    "have the drill data written as Excellon",
);

/// Holes in two files.
pub(in crate::import) const DUPLICATE_HOLES: Flaw = Flaw::new(
    "duplicate-holes",
    "each hole in one drill file",
    "leave out the file that repeats the others (--drill names those to read)",
);

// Of the outline.

/// An outline layer without lines.
pub(in crate::import) const OUTLINE_EMPTY: Flaw = Flaw::new(
    "outline-empty",
    "lines and arcs along the edge of the board",
    "export the outline layer again, or name another with --outline",
);

/// An outline that does not close.
pub(in crate::import) const OUTLINE_OPEN: Flaw = Flaw::new(
    "outline-open",
    "lines that meet at their ends, all round the board",
    "close the edge in the board's program, or allow wider gaps with --outline-gap",
);

/// Flashes on the outline layer.
pub(in crate::import) const OUTLINE_FLASHES: Flaw = Flaw::new(
    "outline-flashes",
    "lines, arcs and regions on an outline layer",
    "remove them from the layer where they are meant as holes, and drill them",
);

/// Ends that did not meet.
pub(in crate::import) const OUTLINE_GAP: Flaw = Flaw::new(
    "outline-gap",
    "each line to end where the next begins",
    "close the edge in the board's program",
);

/// Lines that enclose nothing.
pub(in crate::import) const OUTLINE_LOOSE_LINES: Flaw = Flaw::new(
    "outline-loose-lines",
    "lines that belong to a closed edge",
    "look at the outline; lines of a drawing's frame or of dimensions may be left out",
);

/// Lines across the board.
pub(in crate::import) const OUTLINE_PARTED: Flaw = Flaw::new(
    "outline-parted",
    "one closed line around each board",
    "for several boards in a panel, mill each from a file of its own",
);

/// Contours that nothing can be cut along.
pub(in crate::import) const OUTLINE_TINY: Flaw = Flaw::new(
    "outline-tiny",
    "contours wider than the tool",
    "remove them from the layer; a small hole is drilled",
);

/// Small contours beside the board.
pub(in crate::import) const OUTLINE_LETTERING: Flaw = Flaw::new(
    "outline-lettering",
    "the edge of the board and its cut-outs, no text",
    "remove the text from the outline layer",
);

/// Two files with an edge.
pub(in crate::import) const OUTLINE_TWICE: Flaw =
    Flaw::new("outline-twice", "one outline layer", "choose one with --outline FILE");

/// No file with an edge.
pub(in crate::import) const OUTLINE_MISSING: Flaw = Flaw::new(
    "outline-missing",
    "an outline layer among the files",
    "export it too, or name it with --outline FILE; without it the board is not cut out",
);

// Of the files together.

/// A job file that is none.
pub(in crate::import) const JOB_FILE_UNREADABLE: Flaw = Flaw::new(
    "job-file-unreadable",
    "a Gerber job file (.gbrjob)",
    "export the job file again, or remove it",
);

/// A job file with more files than there are.
pub(in crate::import) const JOB_FILE_INCOMPLETE: Flaw = Flaw::new(
    "job-file-incomplete",
    "all files of the job",
    "export the board again, or name layers with --front, --back, --outline and --drill",
);

/// A copper layer of either side.
pub(in crate::import) const SIDE_ASSUMED: Flaw = Flaw::new(
    "side-assumed",
    "a name or file function that tells the side",
    "name it with --front FILE or --back FILE",
);

/// A layer of any kind, of which name and file function say different things.
pub(in crate::import) const LAYER_DISPUTED: Flaw = Flaw::new(
    "layer-disputed",
    "a name and a file function that say the same",
    "rename it, say with --front, --back or --outline FILE what it is, or leave it aside with --skip FILE",
);

/// A layer of any kind.
pub(in crate::import) const ROLE_UNKNOWN: Flaw = Flaw::new(
    "role-unknown",
    "a name or file function that tells the layer",
    "where it is needed, name it with --front, --back, --outline or --drill",
);

/// A text that is no prose, no layer and no drill file.
pub(in crate::import) const FILE_NOT_UNDERSTOOD: Flaw = Flaw::new(
    "file-not-understood",
    "layers, drill files and documents",
    "export it again where it is a drill file; else leave it aside with --skip",
);

/// A folder inside the given one.
pub(in crate::import) const FOLDER_NOT_READ: Flaw = Flaw::new(
    "folder-not-read",
    "all files of the board in one folder",
    "give this folder too where it holds layers or drill files; else leave it aside with --skip",
);

/// The tape of a drilling machine.
pub(in crate::import) const BINARY_DRILL_FILE: Flaw = Flaw::new(
    "binary-drill-file",
    "a drill file as text (Excellon)",
    "nothing, where the text file has the same holes; --skip leaves the binary one aside",
);

/// No copper.
pub(in crate::import) const COPPER_MISSING: Flaw =
    Flaw::new("copper-missing", "a layer of copper", "add a copper layer, or name it with --front or --back");

/// Lines of no width on a copper layer.
pub(in crate::import) const ZERO_WIDTH_COPPER: Flaw = Flaw::new(
    "zero-width-copper",
    "apertures with a size",
    "have the layer written with apertures; lines of no width are for outlines",
);

/// A copper layer without copper.
pub(in crate::import) const EMPTY_COPPER: Flaw =
    Flaw::new("empty-copper", "copper", "check that the layer was exported with its content");

/// A board as wide as a table.
pub(in crate::import) const SIZE_IMPLAUSIBLE: Flaw =
    Flaw::new("size-implausible", "a board of 620 mm at most", "check the unit of each file with `inspect`");

// Of KiCad boards.

/// A text that KiCad draws with a font of its own.
pub(in crate::import) const KICAD_TEXT: Flaw = Flaw::new(
    "kicad-text",
    "copper whose shape is in the file",
    "plot the board as Gerber in KiCad and give those files, where the text matters; nets do not change",
);

/// Something drawn that is none of what is read.
pub(in crate::import) const KICAD_NOT_READ: Flaw = Flaw::new(
    "kicad-not-read",
    "pads, tracks, vias, zones, lines, arcs, circles, rectangles, polygons and curves",
    "plot the board as Gerber in KiCad and give those files",
);

/// Dashes, hatches, round corners.
pub(in crate::import) const KICAD_LINE_STYLE: Flaw = Flaw::new(
    "kicad-line-style",
    "solid lines, full areas and square corners on copper",
    "plot the board as Gerber in KiCad and give those files",
);

/// A via to an inner layer.
pub(in crate::import) const KICAD_BLIND_VIA: Flaw = Flaw::new(
    "kicad-blind-via",
    "vias from the front to the back",
    "use through vias on a board that is milled",
);

/// A via without a hole.
pub(in crate::import) const KICAD_VIA_WITHOUT_DRILL: Flaw =
    Flaw::new("kicad-via-without-drill", "`(drill …)` in a via", "save the board again in KiCad");

/// A zone that was filled with nothing.
pub(in crate::import) const KICAD_ZONE_EMPTY: Flaw = Flaw::new(
    "kicad-zone-empty",
    "copper in a zone",
    "nothing, where the zone has no room; else press B in KiCad and save",
);

/// A board from the future.
pub(in crate::import) const KICAD_VERSION: Flaw = Flaw::new(
    "kicad-version",
    "a board of KiCad 4 to 9",
    "compare what `draw` shows with KiCad, or plot the board as Gerber and give those files",
);
