//! `voromill pocket`: the program that mills shapes to a flat floor.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use voromill::job::{self, Length, Overlap, Pocketing};
use voromill::report;
use voromill::report::document::WarningEntry;
use voromill::toolpath::Angle;
use voromill::toolpath::strategy::Sequence;
use voromill::verify::pocketing::Pocketed;

use super::art::{Cut, Entry, Shapes, WIDTH, borrowed, lines, programs, rounded, write};
use super::config::Config;
use super::{Failure, Shared};

/// Mill shapes to a flat floor with an end mill
///
/// Reads a Gerber layer (such as the openings of a solder mask), an SVG or DXF drawing, a picture
/// or a KiCad board, or sets a text in a font, and writes a program: the mill comes down in a helix
/// wherever the shapes are widest, and goes round in nested loops to their edges, from each to the
/// next where the material is gone already. The program is read back and what it mills compared
/// with the shapes before anybody mills it: exit code 1 where that finds something.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Pocket {
    #[command(flatten)]
    shapes: Shapes,

    /// Program to write; `-` for stdout. With several tools NAME-1, NAME-2 and so on, the widest
    /// first
    #[arg(long, short, value_name = "FILE", required_unless_present = "check")]
    output: Option<PathBuf>,

    /// How much one pass takes at most [default: all at once]
    #[arg(long, value_name = "LENGTH", help_heading = "Pocketing")]
    depth_pass: Option<Length>,

    /// How far neighbouring loops are apart: a length, or a part of the tool's diameter, at most
    /// half of it
    #[arg(long, value_name = "LENGTH|PERCENT", default_value = "40%", help_heading = "Pocketing")]
    stepover: Overlap,

    /// What is left along the edges for a last loop
    #[arg(long, value_name = "LENGTH", default_value = "0mm", help_heading = "Pocketing")]
    stock: Length,

    /// Which loops come first: those in the middle (inside-out, a plunge wherever the shape is
    /// widest) or those along the edge (outside-in, one plunge for each shape)
    #[arg(
        long,
        value_enum,
        hide_possible_values = true,
        value_name = "ORDER",
        default_value = "inside-out",
        help_heading = "Pocketing"
    )]
    order: Sequence,

    /// How steeply the tool goes down
    #[arg(long, value_name = "ANGLE", default_value = "3deg", help_heading = "Pocketing")]
    ramp: Angle,

    /// Leave the shapes standing and mill what is round them
    #[arg(long, help_heading = "Pocketing")]
    invert: bool,

    /// How far round the shapes that reaches
    #[arg(long, value_name = "LENGTH", default_value = "5mm", help_heading = "Pocketing")]
    margin: Length,

    /// Judge this program, whoever made it, instead of writing one; with several tools one for
    /// each, the widest first
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
  voromill pocket plate.svg -o plate.ngc --tool endmill:3mm --depth 4mm --depth-pass 1mm
  voromill pocket sign.svg -o sign.ngc --tool endmill:1mm --depth 1mm --stock 0.1mm --picture sign.png
  voromill pocket board-F_Mask.gbr -o mask.ngc --tool endmill:0.3mm --depth 0.05mm
  voromill pocket plate.svg --tool endmill:3mm --depth 4mm --check plate.ngc   what this program mills";

impl Pocket {
    pub(super) fn run(self, shared: Shared) -> Result<ExitCode, Failure> {
        let input = self.shapes.input();
        let settings = self.config.settings(&input)?;
        let art = self.shapes.art(&input, &settings)?;
        let pocket = job::pocket(art, &settings, &self.how())?;
        let judged = match self.check.as_slice() {
            [] if self.no_verify => None,
            [] => Some(pocket.verify(None)?),
            paths => Some(pocket.judge(&borrowed(&programs(paths)?), None)?),
        };
        let warnings: Vec<WarningEntry> = pocket.warnings.iter().map(WarningEntry::from).collect();
        shared.say(&report::warnings(&warnings, shared.is_verbose()));
        if let Some(output) = &self.output {
            let picture = self.picture.as_deref();
            let picture = picture.map(|path| Ok::<_, Failure>((path, pocket.picture(WIDTH)?))).transpose()?;
            write(output, picture, &pocket.programs)?;
        }
        let to_stdout = self.output.as_deref() == Some(Path::new("-"));
        let account = Account::new(&pocket, judged.as_ref(), &warnings);
        let said = if self.output.is_none() { String::new() } else { pocket.summary() };
        let told = said
            + &judged.as_ref().map_or(String::new(), |judged| to_text(judged, pocket.programs.len() > 1));
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

    fn how(&self) -> Pocketing {
        Pocketing {
            step: self.depth_pass.map(Length::nm),
            stepover: self.stepover,
            stock: self.stock.nm(),
            sequence: self.order,
            ramp: self.ramp,
            raised: self.invert.then(|| self.margin.nm()),
        }
    }
}

/// What was made and found, as data.
#[derive(Serialize)]
struct Account<'a> {
    name: &'a str,
    areas: usize,
    depth_mm: f64,
    plunges: usize,
    programs: Vec<Cut>,
    #[serde(skip_serializing_if = "Option::is_none")]
    verification: Option<Verification>,
    warnings: &'a [WarningEntry],
}

/// What came of comparing it with the shapes.
#[derive(Serialize)]
struct Verification {
    reachable_mm2: f64,
    unreachable_mm2: f64,
    residue_mm2: f64,
    overcut_um: f64,
    plunges: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    maxima: Option<usize>,
    findings: Vec<Entry>,
}

impl<'a> Account<'a> {
    fn new(pocket: &'a job::Pocket, judged: Option<&Pocketed>, warnings: &'a [WarningEntry]) -> Self {
        Self {
            name: &pocket.name,
            areas: pocket.areas.len(),
            depth_mm: pocket.depth.to_mm(),
            plunges: pocket.entries.all,
            programs: pocket.programs.iter().map(Cut::new).collect(),
            verification: judged.map(Verification::new),
            warnings,
        }
    }

    fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("numbers and texts") + "\n"
    }
}

impl Verification {
    fn new(judged: &Pocketed) -> Self {
        Self {
            reachable_mm2: rounded(judged.reachable_mm2),
            unreachable_mm2: rounded(judged.unreachable_mm2),
            residue_mm2: rounded(judged.residue_mm2),
            overcut_um: rounded(judged.overcut / 1e3),
            plunges: judged.plunges,
            maxima: judged.maxima,
            findings: judged.findings.iter().map(Entry::new).collect(),
        }
    }
}

/// What judging found, for a person; how often the tool need come down is known of one alone.
fn to_text(judged: &Pocketed, several: bool) -> String {
    let need =
        judged.maxima.filter(|_| !several).map_or(String::new(), |maxima| format!(" ({maxima} are needed)"));
    let text = format!(
        "verified: of {:.2} mm² that the tool reaches {:.4} mm² are left, it cuts at most {:.1} µm beyond an edge, and comes down {} times{need}; {:.2} mm² in corners and narrow places are out of its reach\n",
        judged.reachable_mm2,
        judged.residue_mm2,
        judged.overcut / 1e3,
        judged.plunges,
        judged.unreachable_mm2.max(0.0),
    );
    text + &lines(&judged.findings)
}
