use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::str::FromStr;

use clap::{Args, ValueEnum};
use voromill::board::Side;
use voromill::geometry::{Nm, Vector};
use voromill::import::{self, Selection};
use voromill::report::Verdict;
use voromill::verify::{self, Cutter, Placement, Program, Role, Severity};

use super::{Failure, Shared};

/// What programs do to a board, before a machine does it
///
/// Reads G-code, anybody's, mills the board with it on a picture, and compares what is left with the design: nets joined or cut in two,
/// copper lost, rapids through material, holes missed. What voromill wrote says itself which tool and side it is
/// for; of other programs tell it. Exit code 0: nothing as bad as --deny; 1: something; 2: it could not be judged.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Verify {
    /// Programs to judge; those for the same side together
    #[arg(required = true, value_name = "PROGRAM")]
    programs: Vec<PathBuf>,

    /// The board: a folder, a zip archive, or files
    #[arg(long, required = true, value_name = "PATH", num_args = 1..)]
    board: Vec<PathBuf>,

    /// The tool, such as `vbit:0.1mm:30deg` or `endmill:0.2mm` [default: as the program's comments say]
    #[arg(long, value_name = "TOOL")]
    tool: Option<Cutter>,

    /// What the programs are for [default: as their titles or motions say]
    #[arg(long, value_enum)]
    side: Option<Purpose>,

    /// What was added to the board's coordinates [default: as the program's comments say]
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    offset: Option<Offset>,

    /// The vertical line about which the moved board was mirrored
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    mirror: Option<Nm>,

    /// How bad a finding must be to fail
    #[arg(long, value_name = "SEVERITY", default_value = "error")]
    deny: Severity,

    /// How thick the copper is: cuts less deep leave it connected
    #[arg(long, value_name = "LENGTH", default_value = "0.035mm")]
    copper: Nm,

    /// How far a cut may reach into copper
    #[arg(long, value_name = "LENGTH", default_value = "0.01mm")]
    max_gouge: Nm,

    /// The pixel of the picture [default: an eighth of the kerf, within 5um to 25um]
    #[arg(long, value_name = "LENGTH")]
    resolution: Option<Nm>,

    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  voromill verify out/*.ngc --board board/
  voromill verify front.gcode --board board-F_Cu.gbr --tool endmill:0.2mm --side front
  voromill verify back.nc --board board.zip --tool vbit:0.1mm:20deg --side back --mirror 25mm --format sarif";

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Purpose {
    /// Isolates the front
    Front,
    /// Isolates the back
    Back,
    /// Drills
    Drill,
    /// Cuts the board out
    Cutout,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Json,
    Sarif,
    Junit,
}

/// Two lengths.
#[derive(Clone, Copy)]
struct Offset(Vector);

impl FromStr for Offset {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (x, y) = text.split_once(',').ok_or("expected two lengths: x,y")?;
        let length = |text: &str| text.parse::<Nm>().map_err(|error| error.to_string());
        Ok(Self(Vector::new(length(x)?, length(y)?)))
    }
}

impl Verify {
    pub(super) fn run(self, shared: Shared) -> Result<ExitCode, Failure> {
        let loaded = import::load(&self.board, &Selection::default())?;
        let programs = self.programs.iter().map(|path| self.program(path)).collect::<Result<Vec<_>, _>>()?;
        let settings = verify::Settings {
            copper: self.copper,
            gouge: self.max_gouge,
            pixel: self.resolution,
            ..verify::Settings::default()
        };
        let report = verify::verify(&programs, &loaded.board, &[], &settings)?;
        let verdict = Verdict::from(&report);
        match self.format {
            Format::Text => shared.report(&verdict.to_text(shared.verbose)),
            Format::Json => super::print(&verdict.to_json()),
            Format::Sarif => super::print(&verdict.to_sarif()),
            Format::Junit => super::print(&verdict.to_junit(self.deny)),
        }
        Ok(if report.passes(self.deny) { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    fn program(&self, path: &Path) -> Result<Program, Failure> {
        let bytes = std::fs::read(path).map_err(|error| Failure::io("read", path, &error))?;
        let role = self.side.map(|purpose| match purpose {
            Purpose::Front => Role::Isolation(Side::Front),
            Purpose::Back => Role::Isolation(Side::Back),
            Purpose::Drill => Role::Drilling,
            Purpose::Cutout => Role::Cutout,
        });
        let placed = self.offset.is_some() || self.mirror.is_some();
        let shift = self.offset.map_or(Vector::default(), |Offset(shift)| shift);
        Ok(Program {
            file: path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            text: String::from_utf8_lossy(&bytes).into_owned(),
            role,
            cutter: self.tool,
            placement: placed.then_some(Placement { shift, mirror: self.mirror, ..Placement::default() }),
        })
    }
}
