//! `voromill carve`: the program that carves shapes with a V-bit.

use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use voromill::board::Warning;
use voromill::geometry::Nm;
use voromill::job::{self, Carving, Engraving, Inlay, Length, OneTool, Reach, ToolChoice, carve};
use voromill::report::stages::Stages;
use voromill::toolpath::{Angle, Tool};
use voromill::verify::Finding;
use voromill::verify::carving::Carved;

use super::art::{Milled, Work, rounded};
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
#[command(mut_arg("tool", |tool| tool.help("The V-bit: vbit:TIP:ANGLE or a name (`voromill tools`)")))]
pub(super) struct Carve {
    #[command(flatten)]
    work: Work,

    /// Greatest depth: of wider places the walls are cut, and --flat clears what is between
    /// [default: as deep as the shape is wide]
    #[arg(long, value_name = "LENGTH", help_heading = "Carving")]
    max_depth: Option<Length>,

    /// End mill that clears what is too wide at --max-depth to a flat floor, in a program of its
    /// own: NAME-flat
    #[arg(long, value_name = "TOOL", requires = "max_depth", help_heading = "Carving")]
    flat: Option<ToolChoice>,

    /// Do not carve into corners where the edge turns by less than this angle, for less machine
    /// time; 37deg is the filter of OpenVoronoi
    #[arg(long, value_name = "ANGLE", default_value = "0deg", help_heading = "Carving")]
    corner: Angle,

    /// Carve one half of an inlay: the pocket (female), or the plug that is glued into it (male),
    /// mirrored, with the ground round it. Both take the same V-bit and --max-depth
    #[arg(
        long,
        value_name = "HALF",
        value_enum,
        requires = "max_depth",
        conflicts_with = "invert",
        help_heading = "Carving"
    )]
    inlay: Option<Half>,

    /// With --inlay male: how far the plug ends above the floor of the pocket, for glue
    /// [default: 0.1mm]
    #[arg(long, value_name = "LENGTH", requires = "inlay", help_heading = "Carving")]
    gap: Option<Length>,
}

/// The halves of an inlay.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Half {
    Female,
    Male,
}

const EXAMPLES: &str = "\
Examples:
  voromill carve --text 'R1' --font DejaVuSans.ttf --height 6mm -o r1.ngc --tool vbit:0.1mm:60deg
  voromill carve board-F_Silkscreen.gbr -o silk.ngc --tool vbit:0.1mm:30deg --max-depth 0.2mm
  voromill carve logo.png --picture-width 40mm -o logo.ngc --max-depth 2mm --depth-pass 0.5mm
  voromill carve sign.svg -o plug.ngc --tool vbit:0.1mm:60deg --max-depth 2mm --flat endmill:2mm --inlay male
  voromill carve logo.png --picture-width 40mm --check logo.ngc   what this program would carve";

/// How far round shapes that stand is carved unless that is said. Chosen.
const MARGIN: Nm = Nm::from_mm(2);

/// How far a plug ends above the floor unless that is said. Chosen: room for glue.
const GAP: Nm = Nm::from_um(100);

impl Carve {
    pub(super) fn run(self, shared: Shared) -> Result<ExitCode, Failure> {
        if self.gap.is_some() && self.inlay == Some(Half::Female) {
            let cause = "--gap has no effect with --inlay female";
            return Err(Failure::new(
                cause,
                "give it for the plug: --inlay male; the pocket is as deep as --max-depth",
            ));
        }
        if !self.work.is_inverted() && self.inlay != Some(Half::Male) {
            self.work.judge_margin("--invert or --inlay male")?;
        }
        self.work.run(shared, |art, settings, work| Ok(carve(art, settings, &self.how(work)?)?))
    }

    fn how(&self, work: &Work) -> Result<Carving, Failure> {
        let flat = self.flat.as_ref();
        let fetch = |choice| Ok::<_, Failure>(work.config().workbench(&work.input())?.fetch(choice)?);
        let flat: Option<Tool> = flat.map(fetch).transpose()?;
        let gap = self.gap.map_or(GAP, Length::nm);
        let inlay = self.inlay.map(|half| match half {
            Half::Female => Inlay::Female,
            Half::Male => Inlay::Male { gap },
        });
        // The end mill must fit between a plug and the wall that stays round it.
        let room = flat.as_ref().map_or(MARGIN, |mill| MARGIN.max(mill.width_at(Nm::ZERO) * 2));
        let raised = match self.inlay {
            Some(Half::Male) => Some(work.margin().unwrap_or(room)),
            Some(Half::Female) | None => work.raised(MARGIN),
        };
        Ok(Carving {
            max_depth: self.max_depth.map(Length::nm),
            step: work.depth_pass(),
            corner: self.corner,
            raised,
            flat,
            inlay,
        })
    }
}

impl Milled for Engraving {
    type Judged = Carved;

    const REACH: Reach = Reach::CARVING;

    fn programs(&self) -> &[OneTool] {
        &self.programs
    }

    fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    fn stages(&self) -> &Stages {
        &self.stages
    }

    fn judge(&self, others: Option<&[(&str, &str)]>) -> Result<Carved, job::Error> {
        others.map_or_else(|| self.verify(None), |others| Self::judge(self, others, None))
    }

    fn findings(judged: &Carved) -> &[Finding] {
        &judged.findings
    }

    fn picture(&self, width: u32) -> Result<Vec<u8>, job::Error> {
        Self::picture(self, width)
    }

    fn summary(&self, files: &[String]) -> String {
        Self::summary(self, files)
    }

    fn verdict(&self, judged: &Carved) -> String {
        format!(
            "verified at {} points: the surface is within {:.1} µm at 99 % of them, at worst {:.1} µm too deep and {:.1} µm too shallow\n",
            judged.places,
            judged.p99 / 1e3,
            judged.over / 1e3,
            judged.under / 1e3
        )
    }

    fn figures(&self) -> impl Serialize {
        Figures { depth_mm: self.deepest.to_mm() }
    }

    fn verification(judged: &Carved) -> impl Serialize {
        Verification {
            points: judged.places,
            surface_p99_um: rounded(judged.p99 / 1e3),
            too_deep_um: rounded(judged.over / 1e3),
            too_shallow_um: rounded(judged.under / 1e3),
            uncleared_mm2: rounded(judged.left_mm2),
        }
    }
}

/// What was carved, as data.
#[derive(Serialize)]
struct Figures {
    depth_mm: f64,
}

/// What came of comparing it with the ideal, as data; micrometres.
#[derive(Serialize)]
struct Verification {
    points: usize,
    surface_p99_um: f64,
    too_deep_um: f64,
    too_shallow_um: f64,
    uncleared_mm2: f64,
}
