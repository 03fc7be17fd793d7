//! What each code means: what was found, what it does to the board, and what to try.
//!
//! Three sources are put together here: the checks of [`verify`](crate::verify), the flaws of files
//! that [`import`] knows, and [`PLANNED`], what is noticed while programs are made.

use std::fmt::Write as _;

use crate::import;
use crate::verify::check;

/// What a code means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Explained {
    /// The stable name, in brackets behind each message.
    pub code: &'static str,
    /// Who says it.
    pub source: Source,
    /// What was found.
    pub what: &'static str,
    /// What it does to the board, the tool or the machine; of files, what was expected.
    pub cost: &'static str,
    /// What to try.
    pub cure: &'static str,
}

/// Who says something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    /// What programs do to the board.
    Verification,
    /// What planning noticed.
    Planning,
    /// What reading files noticed.
    Files,
}

impl Source {
    const fn heading(self) -> &'static str {
        match self {
            Self::Verification => "Findings of verification",
            Self::Planning => "Warnings of planning",
            Self::Files => "Warnings about files",
        }
    }

    const fn cost(self) -> &'static str {
        match self {
            Self::Verification | Self::Planning => "effect",
            Self::Files => "expected",
        }
    }
}

const fn planned(
    code: &'static str,
    what: &'static str,
    cost: &'static str,
    cure: &'static str,
) -> Explained {
    Explained { code, source: Source::Planning, what, cost, cure }
}

/// What is noticed while programs and masks are made.
const PLANNED: &[Explained] = &[
    planned(
        "axis-incomplete",
        "the medial axis of a carved shape may lack a branch",
        "a corner may stay uncut: this is a fault of voromill",
        "look at the place, and report it with the file",
    ),
    planned(
        "narrower-than-tip",
        "shapes are narrower than the tip of the V-bit",
        "they are not carved",
        "use a V-bit with a finer tip (--tool), or larger shapes",
    ),
    planned(
        "wide-place-left",
        "shapes are wider than the V-bit cuts at its greatest depth",
        "there it follows the middle alone, and leaves the rest",
        "allow more (--max-depth), or clear the rest with an end mill",
    ),
    planned(
        "carved-outside",
        "a program mills beside the shapes to be carved",
        "the picture is spoilt there",
        "check offset, scale and tool of the program",
    ),
    planned(
        "carved-too-deep",
        "a program mills deeper than the shapes are wide",
        "edges of the shapes are cut away",
        "check the tool: its angle and its tip",
    ),
    planned(
        "carved-too-shallow",
        "a program leaves what its tool could carve",
        "lines come out thinner than they are",
        "check the tool, and where Z is zero",
    ),
    planned(
        "narrower-than-tool",
        "areas are narrower than the end mill",
        "they are not milled",
        "use a thinner end mill (--tool), or larger shapes",
    ),
    planned(
        "loops-by-offsets",
        "the Voronoi diagram of a pocket has a flaw",
        "its loops are offset polygons instead, which mill the same: this is a fault of voromill",
        "report it with the file",
    ),
    planned(
        "plunge-straight-down",
        "a pocket is hardly wider than the tool",
        "the tool goes straight down there, and one that does not cut in its middle breaks",
        "use a thinner tool, or one that can drill",
    ),
    planned(
        "pocket-residue",
        "a program leaves material where its tool fits",
        "the floor of the pocket has ridges",
        "check tool, stepover and depth of the program",
    ),
    planned(
        "pocket-overcut",
        "a tool comes nearer to the edge of a pocket than it is wide",
        "the pocket becomes too large, or the program mills beside it",
        "check offset, scale and tool of the program",
    ),
    planned(
        "pocket-too-deep",
        "a program mills below the floor of the pocket",
        "the pocket is too deep, or goes through",
        "check depth, and where Z is zero",
    ),
    planned(
        "pocket-pass-too-thick",
        "a pass takes more than --depth-pass allows",
        "the tool may break",
        "mill the passes above it first",
    ),
    planned(
        "pocket-plunge-too-steep",
        "the tool goes down more steeply than --ramp allows, where there is room",
        "a tool that does not cut in its middle breaks",
        "go down in a helix or along a ramp",
    ),
    planned(
        "pocket-plunges",
        "the tool comes down more often than it need",
        "it takes longer, and each plunge wears the tool",
        "link the loops within what is milled",
    ),
    planned(
        "beyond-the-machine",
        "the program spans more than the machine can move",
        "the machine runs into its end stops",
        "turn the board (--rotate 90deg), mill fewer tiles at once (--tile), or correct --machine-travel",
    ),
    planned(
        "beyond-the-machine-speed",
        "a speed is asked for that the machine does not reach",
        "the job takes longer, and the chip load is smaller than planned",
        "choose a speed that the machine reaches (--feed, --plunge, --spindle), or correct its profile (--machine)",
    ),
    planned(
        "blend-unknown",
        "the dialect has no command for rounding corners off",
        "--blend has no effect",
        "leave --blend out, or set the machine to round corners off",
    ),
    planned(
        "boundary-artifacts",
        "parts of boundaries smaller than the tolerance were merged",
        "none that could be seen",
        "nothing",
    ),
    planned(
        "boundary-not-placed",
        "parts of a boundary lie where the picture has them, and not exactly",
        "cuts there are off by up to a pixel",
        "use smaller pixels (--pixel)",
    ),
    planned(
        "boundary-torn",
        "a boundary ends where nothing else begins",
        "two nets may stay joined there: this is a fault of voromill",
        "use smaller pixels (--pixel), and report it with the board",
    ),
    planned(
        "copper-outside-board",
        "copper lies outside the outline",
        "it is not milled: it is not on the board",
        "nothing for drawing frames and text; where it belongs to the board, correct the outline (--outline)",
    ),
    planned(
        "cut-out-narrower-than-tool",
        "the cutter does not fit into a contour of the outline",
        "the cut-out is not made",
        "use a thinner cutter (--cutout-tool)",
    ),
    planned(
        "flat-fits-nowhere",
        "the end mill of --flat is wider than every floor",
        "the V-bit clears the floor alone, which takes longer",
        "use a thinner end mill (--flat)",
    ),
    planned(
        "frame-not-cut",
        "without an outline, nothing is cut round the copper",
        "copper at the edge stays joined to the clad around it",
        "give an outline (--outline), or leave --no-frame out",
    ),
    planned(
        "gap-narrower-than-tool",
        "a gap between two nets is narrower than the kerf",
        "the cut takes copper of both nets",
        "use a narrower tool, a smaller --depth with a V-bit, or --narrow skip to leave the gap uncut",
    ),
    planned(
        "mask-from-pads",
        "openings of a solder mask were made from the pads of the copper",
        "they may differ from those of the design",
        "nothing, where that is what is wanted",
    ),
    planned(
        "mask-gap-takes-copper",
        "copper is nearer to a boundary than the gap of the mask",
        "the gap takes some of it",
        "choose a smaller --gap",
    ),
    planned(
        "mask-net-without-region",
        "a net has no region of its own",
        "the mask shows nothing of it",
        "choose a smaller --gap",
    ),
    planned(
        "mask-regions-joined",
        "regions of nets meet",
        "etching does not part these nets",
        "choose a larger --gap",
    ),
    planned(
        "millproject-option",
        "an option of pcb2gcode has no effect here, or another one",
        "programs differ from those of pcb2gcode in that",
        "see docs/millproject.md for what to say instead",
    ),
    planned(
        "net-in-pieces",
        "a net is in several pieces that no plated hole joins",
        "the pieces are isolated from each other",
        "join them with wire, or check that the drill file of plated holes is there",
    ),
    planned(
        "nets-ignored",
        "nets are not isolated, as asked by --ignore",
        "their copper is cut where a boundary of other nets runs",
        "nothing, where that is what is wanted",
    ),
    planned(
        "nets-joined",
        "copper of two nets touches in the design",
        "they are isolated as one net",
        "nothing for a net tie; else correct the short in the design",
    ),
    planned(
        "no-drill-for-hole",
        "no drill at hand has the diameter of a hole",
        "the hole is not drilled",
        "add the drill (--drills), allow more (--drill-tolerance), or bore it (--drill-bore)",
    ),
    planned(
        "no-place-for-tabs",
        "fewer tabs than asked for find a place on a contour",
        "the board is held by fewer tabs",
        "make tabs narrower (--tab-width), or say where they go (--tab-at)",
    ),
    planned(
        "outline-missing",
        "no outline was found, or none was named",
        "the board is not cut out",
        "export the outline too, or name it with --outline FILE",
    ),
    planned(
        "pattern-without-net",
        "no net has a name that a pattern matches",
        "the option that has the pattern has no effect",
        "compare it with the names that `voromill inspect` lists",
    ),
    planned(
        "rivet-without-hole",
        "no hole of the board is plated",
        "--rivet has no effect",
        "check that the drill file says which holes are plated",
    ),
    planned(
        "stale-output",
        "programs lie in the output folder that this run did not write",
        "somebody may mill programs of different boards together",
        "move them, or write into another folder (-o)",
    ),
    planned(
        "tab-off-the-outline",
        "a tab is asked for where no contour is",
        "the tab is left out",
        "correct --tab-at: coordinates are those of the files",
    ),
    planned(
        "tool-cuts-nothing",
        "a tool has nothing to cut",
        "none: the other tools do all of it",
        "leave it out of --tool",
    ),
];

/// The code of what was merged below all tolerances: it changes nothing that could be seen.
const BOOKKEEPING: &str = "boundary-artifacts";

/// Whether a code tells of the program's own work alone: shown where more is asked for, and never a
/// reason to fail.
#[must_use]
pub fn is_bookkeeping(code: &str) -> bool {
    code == BOOKKEEPING
}

/// Every code, by source and name.
#[must_use]
pub fn all() -> Vec<Explained> {
    let checks = check::ALL.iter().map(|check| Explained {
        code: check.name,
        source: Source::Verification,
        what: check.about,
        cost: check.cost,
        cure: check.cure,
    });
    let flaws = import::FLAWS.iter().map(|flaw| Explained {
        code: flaw.code,
        source: Source::Files,
        what: flaw.what.trim().trim_end_matches('.'),
        cost: flaw.help.expected,
        cure: flaw.help.advice,
    });
    let mut all: Vec<Explained> = checks.chain(PLANNED.iter().copied()).chain(flaws).collect();
    all.sort_by_key(|explained| (explained.source, explained.code));
    all
}

/// What a code means, in lines; none for a code that there is not.
#[must_use]
pub fn explain(code: &str) -> Option<String> {
    let text: String = all().iter().filter(|explained| explained.code == code).map(Explained::text).collect();
    (!text.is_empty()).then_some(text)
}

/// Every code with a line, under headings.
#[must_use]
pub fn list() -> String {
    let mut text = String::new();
    for same in all().chunk_by(|a, b| a.source == b.source) {
        let _ = writeln!(text, "{}:", same[0].source.heading());
        for Explained { code, what, .. } in same {
            let _ = writeln!(text, "  {code:28} {what}");
        }
    }
    text
}

/// `docs/findings.md`.
#[must_use]
pub fn page() -> String {
    let mut text = "# Findings and warnings\n\nEach message ends with a code in brackets. `voromill explain CODE` prints \
                    what is said here; a test holds this page to it.\n"
        .to_owned();
    for same in all().chunk_by(|a, b| a.source == b.source) {
        let (heading, cost) = (same[0].source.heading(), same[0].source.cost());
        let _ = write!(text, "\n## {heading}\n\n| code | what | {cost} | what to try |\n|---|---|---|---|\n");
        for Explained { code, what, cost, cure, .. } in same {
            let cell = |words: &str| words.replace('|', "\\|");
            let _ = writeln!(text, "| `{code}` | {} | {} | {} |", cell(what), cell(cost), cell(cure));
        }
    }
    text
}

impl Explained {
    fn text(&self) -> String {
        let Self { code, source, what, cost, cure } = self;
        let label = source.cost();
        format!("{code}: {what}\n  {label:9} {cost}\n  try       {cure}\n")
    }
}
