//! The kinds of things that are wrong with files and do not keep them from being read: what was
//! expected instead, and what a person does about it.
//!
//! A warning of a reader is one of these at one place, so none can go out without advice.

use crate::board::{Help, Warning};

/// A kind of flaw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flaw {
    /// Its stable name, by which people filter.
    pub code: &'static str,
    /// What was found, as a sentence.
    pub what: &'static str,
    /// What was expected, and what to do.
    pub help: Help,
}

impl Flaw {
    /// A warning of this kind, without a place.
    pub(in crate::import) fn warning(&self, message: impl Into<String>) -> Warning {
        Warning::new(self.code, message).with(self.help)
    }
}

/// A constant for each kind, whose doc is what was found, and [`ALL`] of them.
macro_rules! flaws {
    ($(#[doc = $what:literal] $name:ident = $code:literal, $expected:literal, $advice:literal;)*) => {
        $(
            #[doc = $what]
            pub(in crate::import) const $name: Flaw = Flaw {
                code: $code,
                what: $what,
                help: Help { expected: $expected, advice: $advice },
            };
        )*

        /// Every kind.
        pub const ALL: &[Flaw] = &[$($name),*];
    };
}

flaws! {
    // Of pictures.

    /// Nobody told which colour is copper.
    PICTURE_COLOUR_GUESSED =
        "picture-colour-guessed",
        "the colour of copper, where it is not the rarer one",
        "say --copper dark or --copper light";

    /// Single pixels that nobody drew.
    PICTURE_SPECKS =
        "picture-specks",
        "copper and gaps of more than a few pixels",
        "leave specks out with --despeckle 0.05";

    // Of drawings.

    /// Nobody told which layer of a drawing is for what.
    DRAWING_GUESSED =
        "drawing-role-guessed",
        "layers named as those of a board are: F.Cu, Edge.Cuts, drill",
        "say --front FILE, --outline FILE or --drill FILE, with #LAYER behind the name for one layer of it";

    /// Layers of a drawing that no name tells of, beside such as are told.
    DRAWING_LAYERS =
        "drawing-layers-aside",
        "layers named as those of a board are: F.Cu, Edge.Cuts, drill",
        "say what they are: --front FILE#LAYER, --outline FILE#LAYER or --drill FILE#LAYER";

    /// What of a DXF was not read.
    DXF_LEFT_OUT =
        "dxf-left-out",
        "lines, arcs, circles, polylines, ellipses, splines, solids, hatches and inserts of them",
        "explode other things into these in the drawing program";

    /// A DXF without its last word.
    DXF_NO_END =
        "dxf-no-end",
        "EOF as the last word of the file",
        "fetch the file again, or have it written again";

    /// What of an SVG was not read.
    SVG_LEFT_OUT =
        "svg-left-out",
        "visible paths and shapes, and texts with a font",
        "name a font with --font FILE for texts; turn other things into paths";

    /// Effects of an SVG that are not followed.
    SVG_EFFECTS =
        "svg-effects",
        "plain fills and strokes",
        "apply clipping, masks and filters in the drawing program, so that only paths are left";

    /// The width of an SVG's page has no unit.
    SVG_UNIT_ASSUMED =
        "svg-unit-assumed",
        "a page with a width in mm or in",
        "say how long one unit is: --unit mm, or --unit 90dpi for old Inkscape";

    /// White paint on an SVG.
    SVG_WHITE =
        "svg-white-erases",
        "no white paint, or holes that it makes",
        "delete white figures that are not meant to erase";

    // Of Gerber files.

    /// The number format comes after coordinates.
    LATE_FORMAT =
        "late-format",
        "`%FS…*%` before the first coordinate",
        "have the file written with its number format in the header";

    /// The unit comes after numbers that need it.
    LATE_UNITS =
        "late-units",
        "`%MOMM*%` or `%MOIN*%` before the first number",
        "have the file written with its unit in the header";

    /// The unit never comes.
    MISSING_UNITS =
        "missing-units",
        "`%MOMM*%` or `%MOIN*%` in the header",
        "compare the board's size with what it should be; where it is 25.4 times off, add the unit";

    /// A second number format.
    FORMAT_CHANGES =
        "format-changes",
        "one `%FS…*%` in a file",
        "check that the features behind this place lie where they should";

    /// A second unit that is not the first.
    CONFLICTING_UNITS =
        "conflicting-units",
        "one unit in a file",
        "check that the features behind this place lie where they should";

    /// An aperture list without a unit.
    APERTURE_UNITS_GUESSED =
        "aperture-units-guessed",
        "an aperture list that says mm, mil or inch",
        "write the unit into the list, and check the widths that `inspect -v` lists";

    /// One number for two apertures.
    APERTURE_DEFINED_TWICE =
        "aperture-defined-twice",
        "each `%ADD…*%` with a number of its own",
        "check which of the two is meant; the later one holds from here on";

    /// One name for two macros.
    MACRO_DEFINED_TWICE =
        "macro-defined-twice",
        "each `%AM…*%` with a name of its own",
        "check which of the two is meant; the later one holds from here on";

    /// An aperture that is chosen and not defined.
    UNDEFINED_APERTURE =
        "undefined-aperture",
        "an aperture that an `%ADD…*%` defined before",
        "have the layer written again; nothing is lost as long as nothing is drawn with it";

    /// An aperture with a hole of negative size.
    NEGATIVE_HOLE =
        "negative-hole",
        "a hole of a diameter above zero, or none",
        "have the layer written again without the hole";

    /// A command without its end.
    MISSING_STAR =
        "missing-star",
        "`*` at the end of every command",
        "have the layer written again, or add the `*`";

    /// An extended command without its brackets.
    MISSING_PERCENT =
        "missing-percent",
        "`%` before and after commands of two letters",
        "have the layer written again, or add the `%`";

    /// An aperture that cannot be read and is not needed.
    MALFORMED_APERTURE =
        "malformed-aperture",
        "an aperture definition, such as `%ADD10C,0.25*%`",
        "have the layer written again if something of it is missing";

    /// A drill that cannot be read and is not needed.
    MALFORMED_TOOL =
        "malformed-tool",
        "a tool with its diameter, such as `T1C0.8`",
        "count the holes that `inspect` lists";

    /// A command that no Gerber specification has.
    UNKNOWN_COMMAND =
        "unknown-command",
        "a command of the Gerber format",
        "compare the copper drawn (`draw --stage copper`) with what it should be";

    /// A coordinate that does not say what it is for.
    OPERATION_CODE_MISSING =
        "operation-code-missing",
        "D01, D02 or D03 after a coordinate",
        "have the layer written with an operation in every coordinate, as specifications since 2012 ask";

    /// An arc without, or against, its quadrant mode.
    QUADRANT_MODE =
        "quadrant-mode",
        "`G75*` before the first arc",
        "have the layer written with G75, and look at its arcs";

    /// An arc without a centre.
    ARC_WITHOUT_CENTRE =
        "arc-without-centre",
        "I and J, the way from the arc's start to its centre",
        "look at this place of the layer; it is drawn as a line";

    /// An arc whose two ends lie at different distances from its centre.
    ARC_RADIUS_MISMATCH =
        "arc-radius-mismatch",
        "both ends at one distance from the centre",
        "have the layer written with more decimals";

    /// A contour that does not end where it began.
    REGION_NOT_CLOSED =
        "region-not-closed",
        "a last point equal to the first",
        "look at the edge of this region: a straight line closes it";

    /// A flash where only edges may be.
    FLASH_IN_REGION =
        "flash-in-region",
        "D01 and D02 between G36 and G37",
        "have the layer written again; if the pad is missing, it is this one";

    /// What leaves no copper.
    NOTHING_DRAWN =
        "nothing-drawn",
        "something that covers an area",
        "check that the layer was exported with its content, and its apertures with a size";

    /// A negative image.
    NEGATIVE_IMAGE =
        "negative-image",
        "`%IPPOS*%`",
        "have the layer written positive: dark where copper is";

    /// A file that calls itself negative.
    NEGATIVE_FILE =
        "negative-file",
        "`%TF.FilePolarity,Positive*%`",
        "compare the copper drawn (`draw --stage copper`) with what it should be";

    /// What stands behind the end.
    TEXT_AFTER_END =
        "text-after-end",
        "nothing after `M02*`",
        "have the layer written again where something is missing from it";

    // Of any file.

    /// A Gerber file without its end.
    MISSING_END_OF_FILE =
        "missing-end-of-file",
        "`M02*` at the end of the file",
        "export or copy the file again; where it is whole, add the end";

    /// A drill file without its end.
    MISSING_END_OF_DRILL_FILE =
        "missing-end-of-file",
        "`M30` at the end of the file",
        "export or copy the file again; where it is whole, add the end";

    /// A file that ends within something.
    TRUNCATED_FILE =
        "truncated-file",
        "the rest of what began here",
        "export or copy the file again";

    // Of drill files.

    /// A diameter without a decimal point.
    DIAMETER_WITHOUT_POINT =
        "diameter-without-point",
        "a diameter such as C0.8",
        "compare the diameter with the drill table, and have the file written with decimal points";

    /// A number format that the file leaves open.
    DRILL_FORMAT_GUESSED =
        "drill-format-guessed",
        "`METRIC` or `INCH` with `LZ` or `TZ`, or decimal points",
        "have the file written with decimal points, and look at the holes on the copper";

    /// A unit that the file leaves open.
    DRILL_UNITS_GUESSED =
        "drill-units-guessed",
        "`METRIC`, `INCH`, `M71` or `M72`",
        "have the file written with a header, and look at the holes on the copper";

    /// Holes beside the copper.
    DRILL_OFF_BOARD =
        "drill-off-board",
        "holes within the copper",
        "check that the files belong to one board and have one origin, and the drill file its own unit";

    /// Some holes off the board.
    HOLES_OFF_BOARD =
        "holes-off-board",
        "holes on the board, or in 5 mm of frame round it",
        "look whether they are meant: what is drilled there is drilled into the bed";

    /// A drill wider than any.
    DRILL_IMPLAUSIBLE =
        "drill-implausible",
        "a drill of 10 mm at most",
        "check the unit of the file; wider holes are better routed";

    /// A drill file that drills nothing.
    DRILL_WITHOUT_HOLES =
        "drill-without-holes",
        "at least one hole",
        "leave the file out where the board has no such holes";

    /// A second unit in a drill file.
    UNIT_CHANGES =
        "unit-changes",
        "one unit in a file",
        "check that the holes behind this place lie where they should";

    /// A cut beside the programmed line.
    CUTTER_COMPENSATION =
        "cutter-compensation",
        "a path of the cutter's middle",
        "have the slots written without G41 and G42";

    /// Axes that change their names.
    AXES_NOT_SWAPPED =
        "axes-not-swapped",
        "X to the right and Y up",
        "have the file written without swapped axes, or turn the board";

    /// A cut in the air.
    ROUTER_NOT_LOWERED =
        "router-not-lowered",
        "M15 before a cut",
        "check whether a slot is missing";

    /// A pattern repeated that was not drilled.
    PATTERN_MISSING =
        "pattern-missing",
        "a pattern (M25 … M01) before it is repeated",
        "have the file written without repeats";

    /// Letters to be drilled.
    DRILLED_TEXT =
        "drilled-text",
        "holes, slots and tools",
        "have the file written without text; it is no part of the circuit";

    /// A command that no drill machine is known to have.
    UNKNOWN_DRILL_COMMAND =
        "unknown-drill-command",
        "a command of the Excellon format",
        "count the holes that `inspect` lists";

    /// A shape that no drill makes.
    NOT_A_HOLE =
        "not-a-hole",
        "round and obround shapes in a drill file",
        "have the drill data written as Excellon";

    /// Holes in two files.
    DUPLICATE_HOLES =
        "duplicate-holes",
        "each hole in one drill file",
        "leave out the file that repeats the others (--drill names those to read)";

    // Of the outline.

    /// An outline layer without lines.
    OUTLINE_EMPTY =
        "outline-empty",
        "lines and arcs along the edge of the board",
        "export the outline layer again, or name another with --outline";

    /// An outline that does not close.
    OUTLINE_OPEN =
        "outline-open",
        "lines that meet at their ends, all round the board",
        "close the edge in the board's program, or allow wider gaps with --outline-gap";

    /// Flashes on the outline layer.
    OUTLINE_FLASHES =
        "outline-flashes",
        "lines, arcs and regions on an outline layer",
        "remove them from the layer where they are meant as holes, and drill them";

    /// Ends that did not meet.
    OUTLINE_GAP =
        "outline-gap",
        "each line to end where the next begins",
        "close the edge in the board's program";

    /// Lines that enclose nothing.
    OUTLINE_LOOSE_LINES =
        "outline-loose-lines",
        "lines that belong to a closed edge",
        "look at the outline; lines of a drawing's frame or of dimensions may be left out";

    /// Lines across the board.
    OUTLINE_PARTED =
        "outline-parted",
        "one closed line around each board",
        "for several boards in a panel, mill each from a file of its own";

    /// Contours that nothing can be cut along.
    OUTLINE_TINY =
        "outline-tiny",
        "contours wider than the tool",
        "remove them from the layer; a small hole is drilled";

    /// Small contours beside the board.
    OUTLINE_LETTERING =
        "outline-lettering",
        "the edge of the board and its cut-outs, no text",
        "remove the text from the outline layer";

    /// Two files with an edge.
    OUTLINE_TWICE =
        "outline-twice",
        "one outline layer",
        "choose one with --outline FILE";

    /// No file with an edge.
    OUTLINE_MISSING =
        "outline-missing",
        "an outline layer among the files",
        "export it too, or name it with --outline FILE; without it the board is not cut out";

    // Of the files together.

    /// A job file that is none.
    JOB_FILE_UNREADABLE =
        "job-file-unreadable",
        "a Gerber job file (.gbrjob)",
        "export the job file again, or remove it";

    /// A job file with more files than there are.
    JOB_FILE_INCOMPLETE =
        "job-file-incomplete",
        "all files of the job",
        "export the board again, or name layers with --front, --back, --outline and --drill";

    /// A copper layer of either side.
    SIDE_ASSUMED =
        "side-assumed",
        "a name or file function that tells the side",
        "name it with --front FILE or --back FILE";

    /// A layer of any kind, of which name and file function say different things.
    LAYER_DISPUTED =
        "layer-disputed",
        "a name and a file function that say the same",
        "rename it, say with --front, --back or --outline FILE what it is, or leave it aside with --skip FILE";

    /// A layer of any kind.
    ROLE_UNKNOWN =
        "role-unknown",
        "a name or file function that tells the layer",
        "where it is needed, name it with --front, --back, --outline or --drill";

    /// A text that is no prose, no layer and no drill file.
    FILE_NOT_UNDERSTOOD =
        "file-not-understood",
        "layers, drill files and documents",
        "export it again where it is a drill file; else leave it aside with --skip";

    /// A folder inside the given one.
    FOLDER_NOT_READ =
        "folder-not-read",
        "all files of the board in one folder",
        "give this folder too where it holds layers or drill files; else leave it aside with --skip";

    /// The tape of a drilling machine.
    BINARY_DRILL_FILE =
        "binary-drill-file",
        "a drill file as text (Excellon)",
        "nothing, where the text file has the same holes; --skip leaves the binary one aside";

    /// No copper.
    COPPER_MISSING =
        "copper-missing",
        "a layer of copper",
        "add a copper layer, or name it with --front or --back";

    /// Lines of no width on a copper layer.
    ZERO_WIDTH_COPPER =
        "zero-width-copper",
        "apertures with a size",
        "have the layer written with apertures; lines of no width are for outlines";

    /// A copper layer without copper.
    EMPTY_COPPER =
        "empty-copper",
        "copper",
        "check that the layer was exported with its content";

    /// A board as wide as a table.
    SIZE_IMPLAUSIBLE =
        "size-implausible",
        "a board of 620 mm at most",
        "check the unit of each file with `inspect`";

    // Of KiCad boards.

    /// A text that KiCad draws with a font of its own.
    KICAD_TEXT =
        "kicad-text",
        "copper whose shape is in the file",
        "plot the board as Gerber in KiCad and give those files, where the text matters; nets do not change";

    /// Something drawn that is none of what is read.
    KICAD_NOT_READ =
        "kicad-not-read",
        "pads, tracks, vias, zones, lines, arcs, circles, rectangles, polygons and curves",
        "plot the board as Gerber in KiCad and give those files";

    /// Dashes, hatches, round corners.
    KICAD_LINE_STYLE =
        "kicad-line-style",
        "solid lines, full areas and square corners on copper",
        "plot the board as Gerber in KiCad and give those files";

    /// A via to an inner layer.
    KICAD_BLIND_VIA =
        "kicad-blind-via",
        "vias from the front to the back",
        "use through vias on a board that is milled";

    /// A via without a hole.
    KICAD_VIA_WITHOUT_DRILL =
        "kicad-via-without-drill",
        "`(drill …)` in a via",
        "save the board again in KiCad";

    /// A zone that was filled with nothing.
    KICAD_ZONE_EMPTY =
        "kicad-zone-empty",
        "copper in a zone",
        "nothing, where the zone has no room; else press B in KiCad and save";

    /// A board from the future.
    KICAD_VERSION =
        "kicad-version",
        "a board of KiCad 4 to 9",
        "compare what `draw` shows with KiCad, or plot the board as Gerber and give those files";
}
