//! `voromill carve`: the program that carves shapes with a V-bit.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use voromill::job::{Carving, Engraving, Length, ToolChoice, carve};
use voromill::report;
use voromill::report::document::WarningEntry;
use voromill::toolpath::Angle;
use voromill::verify::carving::Carved;

use super::art::{Cut, Entry, Shapes, WIDTH, borrowed, lines, programs, rounded, write};
use super::config::Config;
use super::input::Input;
use super::{Failure, Shared};

/// Carve shapes with a V-bit, as deep as they are wide
///
/// Reads a Gerber layer (silkscreen, solder mask, copper), an SVG or DXF drawing, a picture or a
/// KiCad board, or sets a text in a font, and writes a program: the V-bit follows the medial axis
/// of the shapes, so deep that its flanks touch their edges on both sides, up into every corner.
/// The program is read back and what it mills compared with the ideal before anybody mills it: exit
/// code 1 where that finds something.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Carve {
    #[command(flatten)]
    shapes: Shapes,

    /// Program to write; `-` for stdout
    #[arg(long, short, value_name = "FILE", required_unless_present = "check")]
    output: Option<PathBuf>,

    /// No deeper than this; what is wider is followed along its middle, or cleared by --flat
    /// [default: as deep as it is wide]
    #[arg(long, value_name = "LENGTH", help_heading = "Carving")]
    max_depth: Option<Length>,

    /// How much one pass takes at most [default: all at once]
    #[arg(long, value_name = "LENGTH", help_heading = "Carving")]
    depth_pass: Option<Length>,

    /// End mill that clears what is too wide at --max-depth, with a program of its own: NAME-flat
    #[arg(long, value_name = "TOOL", requires = "max_depth", help_heading = "Carving")]
    flat: Option<ToolChoice>,

    /// Leave branches into corners out where the edge turns by less than this; 37deg is
    /// OpenVoronoi's filter
    #[arg(long, value_name = "ANGLE", default_value = "0deg", help_heading = "Carving")]
    corner: Angle,

    /// Leave the shapes standing and carve what is round them
    #[arg(long, help_heading = "Carving")]
    invert: bool,

    /// How far round the shapes that reaches
    #[arg(long, value_name = "LENGTH", default_value = "2mm", help_heading = "Carving")]
    margin: Length,

    /// Judge this program, whoever made it, instead of writing one; with --flat two, that of the
    /// end mill first
    #[arg(long, value_name = "PROGRAM", conflicts_with_all = ["output", "no_verify"], help_heading = "Output")]
    check: Vec<PathBuf>,

    /// Picture of what is milled, seen at a slant: a PNG, 1600 pixels wide
    #[arg(long, value_name = "FILE", requires = "output", help_heading = "Output")]
    picture: Option<PathBuf>,

    /// Do not read the program back
    #[arg(long, help_heading = "Output")]
    no_verify: bool,

    /// Print what was made and found as JSON on stdout
    #[arg(long, help_heading = "Output")]
    json: bool,

    #[command(flatten)]
    config: Config,
}

const EXAMPLES: &str = "\
Examples:
  voromill carve --text 'R1' --font DejaVuSans.ttf --height 6mm -o r1.ngc --tool vbit:0.1mm:60deg
  voromill carve board-F_Silkscreen.gbr -o silk.ngc --tool vbit:0.1mm:30deg --max-depth 0.2mm
  voromill carve logo.png --picture-width 40mm -o logo.ngc --max-depth 2mm --depth-pass 0.5mm
  voromill carve logo.png --picture-width 40mm --check logo.ngc   what this program would carve";

impl Carve {
    pub(super) fn run(self, shared: Shared) -> Result<ExitCode, Failure> {
        let input = self.shapes.input();
        let settings = self.config.settings(&input)?;
        let art = self.shapes.art(&input, &settings)?;
        let engraving = carve(art, &settings, &self.how(&input)?)?;
        let judged = match self.check.as_slice() {
            [] if self.no_verify => None,
            [] => Some(engraving.verify(None)?),
            paths => Some(engraving.judge(&borrowed(&programs(paths)?), None)?),
        };
        let warnings: Vec<WarningEntry> = engraving.warnings.iter().map(WarningEntry::from).collect();
        shared.say(&report::warnings(&warnings, shared.is_verbose()));
        if let Some(output) = &self.output {
            let picture = self.picture.as_deref();
            let picture =
                picture.map(|path| Ok::<_, Failure>((path, engraving.picture(WIDTH)?))).transpose()?;
            write(output, picture, &engraving.programs)?;
        }
        let to_stdout = self.output.as_deref() == Some(Path::new("-"));
        let account = Account::new(&engraving, judged.as_ref(), &warnings);
        let said = if self.output.is_none() { String::new() } else { engraving.summary() };
        let told = said + &judged.as_ref().map_or(String::new(), to_text);
        if self.json && !to_stdout {
            super::print(&account.to_json())?;
        } else if to_stdout {
            shared.say(&told);
        } else {
            shared.report(&told)?;
        }
        let passes = judged.is_none_or(|judged| judged.findings.is_empty());
        Ok(if passes { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    fn how(&self, input: &Input) -> Result<Carving, Failure> {
        let flat = self
            .flat
            .as_ref()
            .map(|choice| self.config.workbench(input)?.fetch(choice).map_err(Failure::from));
        Ok(Carving {
            max_depth: self.max_depth.map(Length::nm),
            step: self.depth_pass.map(Length::nm),
            corner: self.corner,
            raised: self.invert.then(|| self.margin.nm()),
            flat: flat.transpose()?,
        })
    }
}

/// What was made and found, as data.
#[derive(Serialize)]
struct Account<'a> {
    name: &'a str,
    deepest_mm: f64,
    programs: Vec<Cut>,
    #[serde(skip_serializing_if = "Option::is_none")]
    verification: Option<Verification>,
    warnings: &'a [WarningEntry],
}

/// What came of comparing it with the ideal; micrometres.
#[derive(Serialize)]
struct Verification {
    places: usize,
    surface_p99_um: f64,
    too_deep_um: f64,
    too_shallow_um: f64,
    left_wide_mm2: f64,
    findings: Vec<Entry>,
}

impl<'a> Account<'a> {
    fn new(engraving: &'a Engraving, judged: Option<&Carved>, warnings: &'a [WarningEntry]) -> Self {
        Self {
            name: &engraving.name,
            deepest_mm: engraving.deepest.to_mm(),
            programs: engraving.programs.iter().map(Cut::new).collect(),
            verification: judged.map(Verification::new),
            warnings,
        }
    }

    fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("numbers and texts") + "\n"
    }
}

impl Verification {
    fn new(judged: &Carved) -> Self {
        Self {
            places: judged.places,
            surface_p99_um: rounded(judged.p99 / 1e3),
            too_deep_um: rounded(judged.over / 1e3),
            too_shallow_um: rounded(judged.under / 1e3),
            left_wide_mm2: rounded(judged.left_mm2),
            findings: judged.findings.iter().map(Entry::new).collect(),
        }
    }
}

/// What judging found, for a person.
fn to_text(judged: &Carved) -> String {
    let micrometres = |nm: f64| nm / 1_000.0;
    let text = format!(
        "verified at {} places: the surface is off by {:.1} µm at most at 99 of 100, {:.1} µm too deep and {:.1} µm too shallow at worst\n",
        judged.places,
        micrometres(judged.p99),
        micrometres(judged.over),
        micrometres(judged.under)
    );
    text + &lines(&judged.findings)
}
