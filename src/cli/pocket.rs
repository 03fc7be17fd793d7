//! `voromill pocket`: the program that mills shapes to a flat floor.

use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use voromill::board::Warning;
use voromill::geometry::Nm;
use voromill::job::{self, Length, OneTool, Overlap, Pocketing, Reach};
use voromill::report::stages::Stages;
use voromill::toolpath::Angle;
use voromill::toolpath::strategy::{Engagement, Engaging, Sequence};
use voromill::verify::Finding;
use voromill::verify::pocketing::Pocketed;

use super::art::{Milled, Work, rounded};
use super::given::choice;
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
// The strategy of pockets has the name that that of isolation has elsewhere, which means nothing to
// pockets: it is out of the way.
#[command(mut_arg("strategy", |isolation| isolation.long("isolation-strategy").hide(true)))]
#[command(mut_arg("tool", |tool| tool.help(TOOL)))]
pub(super) struct Pocket {
    #[command(flatten)]
    work: Work,

    /// Distance between neighbouring loops: a length, or a percentage of the diameter of the tool,
    /// of 1 % to half of it
    #[arg(long, value_name = "LENGTH|PERCENT", default_value = "40%", help_heading = "Pocketing")]
    stepover: Overlap,

    /// Stock left along the edges for a finishing loop
    #[arg(long, value_name = "LENGTH", default_value = "0mm", help_heading = "Pocketing")]
    stock: Length,

    /// Order of the loops: inside-out (a plunge wherever the shape is widest), or outside-in (one
    /// plunge for each shape)
    #[arg(
        long,
        value_parser = choice::<Sequence>(),
        hide_possible_values = true,
        value_name = "ORDER",
        default_value = "inside-out",
        help_heading = "Pocketing"
    )]
    order: Sequence,

    /// Strategy: offset (nested loops, offset from the edges), or engagement (arcs along the medial
    /// axis, so that the tool nowhere meets more material than --engagement says)
    #[arg(
        id = "pocketing-strategy",
        long = "strategy",
        value_enum,
        hide_possible_values = true,
        value_name = "STRATEGY",
        default_value = "offset",
        help_heading = "Pocketing"
    )]
    strategy: Strategy,

    /// With --strategy engagement: the greatest radial engagement, 1% to 50% of the diameter of the
    /// tool [default: 15%]
    #[arg(long, value_name = "PERCENT", help_heading = "Pocketing")]
    engagement: Option<Engagement>,

    /// With --strategy engagement: mill every other arc the other way round instead of going back
    /// without cutting, climb and conventional by turns
    #[arg(long, help_heading = "Pocketing")]
    both_ways: bool,

    /// Angle at which the tool goes down, in a helix or ramp
    #[arg(long, value_name = "ANGLE", default_value = "3deg", help_heading = "Pocketing")]
    ramp: Angle,
}

/// What the way in a pocket follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Strategy {
    Offset,
    Engagement,
}

/// Help of the tool: that of isolation speaks of V-bits.
const TOOL: &str = "End mill: endmill:DIAMETER or a name (`voromill tools`); of several, between commas, the \
                    wider one clears what it fits, the finer one the rest [default: none]";

const EXAMPLES: &str = "\
Examples:
  voromill pocket plate.svg -o plate.ngc --tool endmill:3mm --depth 4mm --depth-pass 1mm
  voromill pocket sign.svg -o sign.ngc --tool endmill:1mm --depth 1mm --stock 0.1mm --picture sign.png
  voromill pocket board-F_Mask.gbr -o mask.ngc --tool endmill:0.3mm --depth 0.05mm
  voromill pocket plate.svg --tool endmill:3mm --depth 4mm --check plate.ngc   what this program mills";

/// How far round shapes that stand is milled unless that is said. Chosen.
const MARGIN: Nm = Nm::from_mm(5);

impl Pocket {
    pub(super) fn run(self, shared: Shared) -> Result<ExitCode, Failure> {
        self.judge()?;
        if !self.work.is_inverted() {
            self.work.judge_margin("--invert")?;
        }
        self.work.run(shared, |art, settings, work| Ok(job::pocket(art, settings, &self.how(work))?))
    }

    /// Fails for options that the strategy does not know.
    fn judge(&self) -> Result<(), Failure> {
        let without = match self.strategy {
            Strategy::Offset if self.engagement.is_some() => "--engagement has no effect",
            Strategy::Offset if self.both_ways => "--both-ways has no effect",
            Strategy::Engagement if self.order == Sequence::OutsideIn => "--order outside-in has no effect",
            Strategy::Offset | Strategy::Engagement => return Ok(()),
        };
        let (what, hint) = match self.strategy {
            Strategy::Offset => ("offset", "add --strategy engagement, or leave it out"),
            Strategy::Engagement => ("engagement", "leave it out: arcs are milled from inside"),
        };
        Err(Failure::new(format!("{without} with --strategy {what}"), hint))
    }

    fn how(&self, work: &Work) -> Pocketing {
        Pocketing {
            step: work.depth_pass(),
            stepover: self.stepover,
            stock: self.stock.nm(),
            sequence: self.order,
            ramp: self.ramp,
            raised: work.raised(MARGIN),
            engaging: (self.strategy == Strategy::Engagement).then(|| Engaging {
                target: self.engagement.unwrap_or(Engagement::USUAL),
                both_ways: self.both_ways,
            }),
        }
    }
}

impl Milled for job::Pocket {
    type Judged = Pocketed;

    const REACH: Reach = Reach::POCKETS;

    fn programs(&self) -> &[OneTool] {
        &self.programs
    }

    fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    fn stages(&self) -> &Stages {
        &self.stages
    }

    fn judge(&self, others: Option<&[(&str, &str)]>) -> Result<Pocketed, job::Error> {
        others.map_or_else(|| self.verify(None), |others| Self::judge(self, others, None))
    }

    fn findings(judged: &Pocketed) -> &[Finding] {
        &judged.findings
    }

    fn picture(&self, width: u32) -> Result<Vec<u8>, job::Error> {
        Self::picture(self, width)
    }

    fn summary(&self, files: &[String]) -> String {
        Self::summary(self, files)
    }

    /// How many plunges are needed is known of one tool alone.
    fn verdict(&self, judged: &Pocketed) -> String {
        let needed = judged.maxima.filter(|_| self.programs.len() == 1);
        let needed = needed.map_or(String::new(), |maxima| format!(" ({maxima} needed)"));
        let plunges = if judged.plunges == 1 { "plunge" } else { "plunges" };
        let borne = judged.borne.map_or(String::new(), |borne| {
            format!(
                "engagement: {:.1} % of the diameter at most, no more than {:.1} % on 99 % of the way that cuts; {:.1} % of the way at depth cut nothing, and {:.1} % of all are links above the floor\n",
                borne.most * 100.0,
                borne.p99 * 100.0,
                borne.air * 100.0,
                borne.lifted * 100.0,
            )
        });
        format!(
            "verified: of {:.2} mm² that the tool reaches {:.4} mm² are left, it cuts at most {:.1} µm beyond an edge, with {} {plunges}{needed}; {:.2} mm² in corners and narrow places are out of its reach\n{borne}",
            judged.reachable_mm2,
            judged.residue_mm2,
            judged.overcut / 1e3,
            judged.plunges,
            judged.unreachable_mm2.max(0.0),
        )
    }

    fn figures(&self) -> impl Serialize {
        Figures { areas: self.areas.len(), depth_mm: self.depth.to_mm(), plunges: self.entries.all }
    }

    fn verification(judged: &Pocketed) -> impl Serialize {
        Verification {
            reachable_mm2: rounded(judged.reachable_mm2),
            unreachable_mm2: rounded(judged.unreachable_mm2),
            residual_mm2: rounded(judged.residue_mm2),
            overcut_um: rounded(judged.overcut / 1e3),
            plunges: judged.plunges,
            plunges_needed: judged.maxima,
            engagement_percent: judged.borne.map(|borne| rounded(borne.most * 100.0)),
            engagement_p99_percent: judged.borne.map(|borne| rounded(borne.p99 * 100.0)),
            air_percent: judged.borne.map(|borne| rounded(borne.air * 100.0)),
            lifted_percent: judged.borne.map(|borne| rounded(borne.lifted * 100.0)),
        }
    }
}

/// What was milled, as data.
#[derive(Serialize)]
struct Figures {
    areas: usize,
    depth_mm: f64,
    plunges: usize,
}

/// What came of comparing it with the shapes, as data.
#[derive(Serialize)]
struct Verification {
    reachable_mm2: f64,
    unreachable_mm2: f64,
    residual_mm2: f64,
    overcut_um: f64,
    plunges: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    plunges_needed: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    engagement_percent: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    engagement_p99_percent: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    air_percent: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lifted_percent: Option<f64>,
}
