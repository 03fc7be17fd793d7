//! # What it checks
//!
//! A program has no code that its controller stops at, passes over though something depends on it,
//! or takes for another one; no line that it reads otherwise, and no character that it takes out of
//! the stream at once.
//!
//! # Why
//!
//! A job that stops half-way leaves the tool in the board. A pause that is passed over leaves the
//! wrong tool in, a drilling cycle no hole. A code that means something else moves the machine to
//! where nobody thought of.
//!
//! # What it can miss
//!
//! Options that a controller was built with, and macros. Programs that do not say which controller
//! they are for. The user's own G-code.
//!
//! # Sources
//!
//! The firmwares: Grbl 1.1h, grblHAL (f80fc34), FluidNC 4.0, TinyG (39df38c), g2core (1fb5940),
//! Smoothieware (bb41e99), Marlin 2, RepRapFirmware 3.5.3, Klipper (84104bb).

use super::{Check, Diagnostic, Run, Severity, Stage, Words, Wrong, found, often};
use crate::gcode::read::{Coded, Odd, Tally};
use crate::verify::followed::Followed;
use crate::verify::report::Finding;
use crate::verify::stream::Feature;

const KIND: Diagnostic = Diagnostic {
    code: NAME,
    stage: Stage::Verification,
    severity: Severity::Error,
    what: Words::of("a code that the controller does not take, or takes for another one"),
    effect: Words::of("the job stops half-way, does not wait for a tool, drills no hole, or goes elsewhere"),
    advice: Words::of("make the program for this controller ({dialect}), or take the code out"),
};

pub(super) const CHECK: Check = Check { kind: &KIND, run: Run::Program(|program, _| check(program)) };

const NAME: &str = "word-not-taken";

/// What controllers do with some codes.
struct Rule {
    controllers: &'static [&'static str],
    codes: Codes,
    /// What they do, behind the name of the controller.
    does: &'static str,
}

/// Some codes, with blanks between.
enum Codes {
    These(&'static str),
    AllBut(&'static str),
}
use Codes::{AllBut, These};

/// All that Grbl takes.
const GRBL: &str = "G0 G1 G2 G3 G4 G10 G17 G18 G19 G20 G21 G28 G28.1 G30 G30.1 G38.2 G38.3 G38.4 G38.5 G40 G43.1 G49 \
                    G53 G54 G55 G56 G57 G58 G59 G61 G80 G90 G91 G91.1 G92 G92.1 G93 G94 \
                    M0 M1 M2 M3 M4 M5 M8 M9 M30";
const CYCLES: &str = "G73 G74 G81 G82 G83 G84 G85 G86 G89";

const STOPS: &str = "stops there with an error";
const PASSES: &str = "passes over it, and does not wait";

const HOMES: &str = "goes to its switches, and where one is at the bed, down through the board";

const NO_HOLE: &str = "passes over it, and drills no hole";

const RULES: &[Rule] = &[
    Rule { controllers: &["grbl"], codes: AllBut(GRBL), does: STOPS },
    Rule { controllers: &["grblhal", "fluidnc"], codes: These("G90.1"), does: STOPS },
    Rule { controllers: &["fluidnc"], codes: These("G43 G64 G98 G99"), does: STOPS },
    Rule { controllers: &["fluidnc"], codes: These("G59.1 G59.2 G59.3 G61.1 G95"), does: STOPS },
    Rule { controllers: &["tinyg"], codes: These("G38.3 G38.4 G38.5 G43 G95"), does: STOPS },
    Rule { controllers: &["fluidnc", "tinyg", "g2core"], codes: These(CYCLES), does: STOPS },
    Rule { controllers: &["marlin", "klipper"], codes: These(CYCLES), does: NO_HOLE },
    Rule { controllers: &["smoothieware"], codes: These("G73 G74 G84 G85 G86 G89"), does: NO_HOLE },
    Rule {
        controllers: &["reprapfirmware"],
        codes: These(CYCLES),
        does: "runs a macro of that name, and drills no hole where there is none",
    },
    Rule { controllers: &["klipper"], codes: These("G20"), does: STOPS },
    Rule { controllers: &["fluidnc", "marlin"], codes: These("M6"), does: PASSES },
    Rule { controllers: &["grbl"], codes: These("M1"), does: PASSES },
    Rule {
        controllers: &["tinyg", "g2core", "smoothieware", "klipper"],
        codes: These("M0 M1 M6"),
        does: PASSES,
    },
    Rule {
        controllers: &["marlin", "smoothieware"],
        codes: These("G91.1"),
        does: "takes it for G91, and all that follows for steps",
    },
    Rule {
        controllers: &["marlin", "smoothieware"],
        codes: These("G90.1"),
        does: "takes it for G90, and counts I and J from where the arc begins",
    },
    Rule {
        controllers: &["klipper", "reprapfirmware"],
        codes: These("G90.1"),
        does: "does not take it, and counts I and J from where the arc begins",
    },
    Rule { controllers: &["marlin", "reprapfirmware", "klipper"], codes: These("G28"), does: HOMES },
    Rule {
        controllers: &["marlin", "reprapfirmware"],
        codes: These("G30"),
        does: "takes it for a probe of its bed, and sends the tool down into the board",
    },
    Rule { controllers: &["klipper"], codes: These("G30 G53"), does: "does not take it, and does not move" },
    Rule {
        controllers: &["marlin", "reprapfirmware"],
        codes: These("G53"),
        does: "counts it from the bed, which is below the board, and not from the top",
    },
    Rule {
        controllers: &["klipper"],
        codes: These("G38.2 G38.3 G38.4 G38.5"),
        does: "passes over it, and finds no surface",
    },
    Rule {
        controllers: &["marlin", "klipper", "smoothieware", "tinyg", "g2core", "fluidnc", "grblhal"],
        codes: These("M98"),
        does: "runs no subprogram of the file",
    },
    Rule { controllers: &["reprapfirmware"], codes: These("M98"), does: "runs another file" },
    Rule { controllers: &["reprapfirmware"], codes: These("M0"), does: "ends the job there" },
    Rule { controllers: &["marlin", "reprapfirmware"], codes: These("M30"), does: "deletes a file there" },
];

fn check(program: &Followed) -> Vec<Finding> {
    let Some(controller) = &program.controller else { return Vec::new() };
    let rules = || RULES.iter().filter(|rule| rule.controllers.contains(&controller.as_str()));
    let finding = |code: &Coded| {
        let name = code.to_string();
        let rule = rules().find(|rule| rule.is_for(&name))?;
        let message = format!("{name}: {controller} {}{}", rule.does, often(code.count, "times"));
        Some(found(program, NAME, Wrong { severity: Severity::Error, message, size: None }, None, code.line))
    };
    let codes = program.listing.codes.iter().filter_map(finding);
    codes.chain(lines(program, controller)).collect()
}

/// Lines of some kind that controllers take otherwise than they read, whatever their codes are.
struct LineRule {
    controllers: &'static [&'static str],
    feature: Feature,
    what: &'static str,
    /// What they do, behind the name of the controller.
    does: &'static str,
}

const IS_UNKNOWN: &str = "does not know it, and stops, or goes elsewhere";

const NOT_TAKEN: &str = "does not take the line, and asks for another";

const LINES: &[LineRule] = &[
    LineRule {
        controllers: &["marlin", "klipper"],
        feature: Feature::Run(Odd::Bare),
        what: "coordinates in a line without a code",
        does: "passes over them",
    },
    LineRule {
        controllers: &["marlin", "klipper"],
        feature: Feature::Run(Odd::Several),
        what: "several codes in a line",
        does: "runs the first alone",
    },
    LineRule {
        controllers: &["smoothieware"],
        feature: Feature::Run(Odd::Radius),
        what: "an arc with R",
        does: "does not read R, and cuts another arc or none",
    },
    LineRule {
        controllers: &["klipper"],
        feature: Feature::Run(Odd::Radius),
        what: "an arc with R",
        does: STOPS,
    },
    LineRule {
        controllers: &["marlin", "klipper"],
        feature: Feature::BesideComment,
        what: "a comment in parentheses in a line with code",
        does: "takes its letters for words of the code",
    },
    LineRule {
        controllers: &["tinyg", "smoothieware"],
        feature: Feature::BehindComment,
        what: "code behind a comment in its line",
        does: "passes over it",
    },
    LineRule {
        controllers: &["marlin"],
        feature: Feature::Unchecked,
        what: "a line with a number and no checksum",
        does: NOT_TAKEN,
    },
    LineRule {
        controllers: &["marlin", "smoothieware"],
        feature: Feature::OutOfOrder,
        what: "a line whose number is not one more than the last",
        does: NOT_TAKEN,
    },
    LineRule {
        controllers: &["grbl"],
        feature: Feature::Parameter,
        what: "a line with a parameter or an expression",
        does: STOPS,
    },
    LineRule {
        controllers: &["marlin", "klipper", "smoothieware", "tinyg", "g2core"],
        feature: Feature::Parameter,
        what: "a line with a parameter or an expression",
        does: IS_UNKNOWN,
    },
    LineRule {
        controllers: &["marlin", "klipper", "smoothieware", "tinyg", "g2core"],
        feature: Feature::Flow,
        what: "a subprogram, a branch or a loop",
        does: IS_UNKNOWN,
    },
    LineRule {
        controllers: &["marlin", "klipper"],
        feature: Feature::Run(Odd::Data),
        what: "G10 with L",
        does: "sets no zero with it",
    },
    LineRule {
        controllers: &["tinyg", "smoothieware"],
        feature: Feature::Deleted,
        what: "a line that begins with `/`",
        does: "passes over it",
    },
    LineRule {
        controllers: &["smoothieware"],
        feature: Feature::Other,
        what: "a line that does not begin with G M T S N X Y Z or F",
        does: "passes over it",
    },
    LineRule {
        controllers: &["smoothieware"],
        feature: Feature::LowerCase,
        what: "a line that begins with a lower-case letter",
        does: "takes it for a command of its own",
    },
    LineRule {
        controllers: &["marlin"],
        feature: Feature::Cut,
        what: "a line with code behind its 96th character",
        does: "drops the rest",
    },
    LineRule {
        controllers: &["fluidnc"],
        feature: Feature::Resumed,
        what: "a comment that goes on behind one within it",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl"],
        feature: Feature::Subprogram,
        what: "a line with an O-word",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl", "grblhal", "linuxcnc"],
        feature: Feature::Nested,
        what: "a comment within a comment",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl", "grblhal", "fluidnc"],
        feature: Feature::Run(Odd::Endless),
        what: "an arc without X and Y",
        does: STOPS,
    },
    LineRule {
        controllers: &["tinyg"],
        feature: Feature::Run(Odd::Circle),
        what: "a full circle with X and Y",
        does: "does not move",
    },
    LineRule {
        controllers: &["g2core"],
        feature: Feature::Run(Odd::LeftCircle),
        what: "a full circle of G3 with X and Y",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl", "grblhal", "fluidnc"],
        feature: Feature::Run(Odd::ShortRadius),
        what: "an arc whose R is less than half the way to its end",
        does: STOPS,
    },
    LineRule {
        controllers: &["tinyg"],
        feature: Feature::Run(Odd::SmallUneven),
        what: "an arc whose ends are not as far from its centre, by more than 0.1 %",
        does: STOPS,
    },
    LineRule {
        controllers: &["mach3"],
        feature: Feature::Run(Odd::Uneven),
        what: "an arc whose ends are not as far from its centre, by more than 0.002 mm",
        does: STOPS,
    },
    LineRule {
        controllers: &["klipper"],
        feature: Feature::Run(Odd::StepArc),
        what: "an arc in G91",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl", "grblhal", "fluidnc", "linuxcnc"],
        feature: Feature::Run(Odd::Contrary),
        what: "a line with codes of which one alone can hold",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl", "grblhal", "fluidnc"],
        feature: Feature::Run(Odd::Cancels),
        what: "G80 beside a motion",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl"],
        feature: Feature::Run(Odd::Unasked),
        what: "a line with a word for which none of its codes asks",
        does: STOPS,
    },
    LineRule {
        controllers: &["grblhal", "fluidnc"],
        feature: Feature::Run(Odd::Idle),
        what: "a line with a word for which none of its codes asks",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl", "grblhal", "fluidnc", "linuxcnc"],
        feature: Feature::Run(Odd::Untimed),
        what: "a dwell without P",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl"],
        feature: Feature::Run(Odd::HighTool),
        what: "a tool above T255",
        does: STOPS,
    },
    LineRule {
        controllers: &["grbl"],
        feature: Feature::HighNumber,
        what: "a line with a number above 10000000",
        does: STOPS,
    },
    LineRule { controllers: &["grbl"], feature: Feature::Percent, what: "a line with `%`", does: STOPS },
    LineRule {
        controllers: &["grbl"],
        feature: Feature::Long,
        what: "a line of more than 79 characters",
        does: STOPS,
    },
];

fn lines(program: &Followed, controller: &str) -> Vec<Finding> {
    let rules = LINES.iter().filter(|rule| rule.controllers.contains(&controller));
    let of_rule = |rule: &LineRule| {
        let of_it = program.features.iter().find(|(feature, _)| *feature == rule.feature);
        of_it.map(|(_, tally)| (format!("{}: {controller} {}", rule.what, rule.does), *tally))
    };
    let taken = |&(c, tally): &(char, Tally)| {
        let does = match c {
            '!' => "holds the feed",
            '~' => "goes on where it waits",
            '%' => "drops the lines that it has not run yet",
            '\u{18}' => "resets",
            _ => "changes feed or spindle, or opens the safety door",
        };
        let c = c.escape_debug();
        (format!("`{c}`: {controller} takes it at once, in comments, too, and {does}"), tally)
    };
    let finding = |(message, Tally { line, count }): (String, Tally)| {
        let message = message + &often(count, "times");
        found(program, NAME, Wrong { severity: Severity::Error, message, size: None }, None, line)
    };
    rules.filter_map(of_rule).chain(program.at_once.iter().map(taken)).map(finding).collect()
}

impl Rule {
    fn is_for(&self, code: &str) -> bool {
        let among = |codes: &str| codes.split_whitespace().any(|known| known == code);
        match self.codes {
            These(codes) => among(codes),
            AllBut(codes) => !among(codes),
        }
    }
}
