//! `voromill verify`: what programs from any CAM do to a board before a machine does it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::str::FromStr;

use clap::{Args, ValueEnum};
use voromill::board::diagnostic::planning;
use voromill::board::{Board, Side, Source, Warning};
use voromill::gcode::Dialect;
use voromill::geometry::{Nm, Vector};
use voromill::import::{self, Loaded, Selection};
use voromill::job::{self, AreaChoice, DistanceFor, Tiles, Topology};
use voromill::report::Verdict;
use voromill::report::stages::Stages;
use voromill::report::verdict::FindingEntry;
use voromill::toolpath::Angle;
use voromill::topology::Pattern;
use voromill::verify::{self, Asked, Cutter, Laid, Orientation, Placement, Program, Role, Severity};

use super::given::{above_zero, not_below_zero, of_word};
use super::program_files::{programs, text_of, without_programs};
use super::{Failure, Shared};

/// What programs do to a board, before a machine does it
///
/// Reads G-code from any CAM, simulates how the board is milled, and compares what is left with the
/// design: nets joined or cut in two, copper lost, rapids through material, holes missed. What
/// voromill wrote says itself which tool and side it is for; of other programs tell it. Exit code
/// 0: nothing as bad as --deny; 1: something; 2: it could not be judged.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Verify {
    /// Programs to verify, those for the same side together; or a folder: then a program that the
    /// board needs and that is missing is a finding too
    #[arg(required = true, value_name = "PROGRAM")]
    programs: Vec<PathBuf>,

    /// The board: a folder, a zip archive, files, or a KiCad board
    #[arg(long, required = true, value_name = "PATH", num_args = 1..)]
    board: Vec<PathBuf>,

    /// Ignore this file or folder of the board, by name; may be given several times
    #[arg(long, value_name = "FILE")]
    skip: Vec<PathBuf>,

    /// The tool, such as `vbit:0.1mm:30deg` or `endmill:0.2mm` [default: from the program's
    /// comments]
    #[arg(long, value_name = "TOOL")]
    tool: Option<Cutter>,

    /// What the programs are for [default: from their titles or motions]
    #[arg(long, value_enum)]
    side: Option<Purpose>,

    /// What the machine speaks that is to run the programs, such as grbl: codes that it does not
    /// take, or takes otherwise, are findings [default: from the programs' comments]
    #[arg(long, value_name = "NAME", value_parser = dialect)]
    dialect: Option<String>,

    /// What was added to the coordinates of the board [default: from the program's comments]
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    offset: Option<Offset>,

    /// The x about which the back is mirrored, after the board was moved
    #[arg(long = "mirror-axis", alias = "mirror", value_name = "LENGTH", allow_hyphen_values = true)]
    mirror: Option<Nm>,

    /// How far the board was rotated, counter-clockwise, before it was moved
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    rotate: Option<Angle>,

    /// Find from the cuts how the board lies in each program: the offset, and unless given
    /// --mirror-axis and quarter turns; for programs of other CAM
    #[arg(long, conflicts_with = "offset")]
    register: bool,

    /// Exit code 1 for findings of at least this severity: info, warning or error
    #[arg(long, value_name = "SEVERITY", default_value = "error")]
    deny: Severity,

    /// Thickness of the board [default: from the programs' comments, else of the KiCad board, else
    /// 1.6mm]
    #[arg(long, value_name = "LENGTH", value_parser = above_zero)]
    thickness: Option<Nm>,

    /// Thickness of the copper: shallower cuts do not separate nets
    #[arg(long, value_name = "LENGTH", default_value = "0.035mm", value_parser = not_below_zero)]
    copper: Nm,

    /// How far a cut may reach into copper without a finding
    #[arg(long, value_name = "LENGTH", default_value = "0.01mm", value_parser = not_below_zero)]
    max_gouge: Nm,

    /// The part of its width that a net must keep where a cut reaches into it, such as 0.5
    #[arg(long, value_name = "PART", default_value = "0.5", value_parser = part)]
    keep_width: f64,

    /// Strips of copper between two cuts that are narrower than this are slivers
    #[arg(long, value_name = "LENGTH", default_value = "0.05mm", value_parser = not_below_zero)]
    sliver: Nm,

    /// How far the machine can move in x, y and z, such as 280mm,170mm,40mm: a program that spans
    /// more is an error
    #[arg(long = "machine-travel", alias = "travel", value_name = "X,Y,Z")]
    travel: Option<Travel>,

    /// How many tabs must hold each board; 0 for boards that are held by tape or glue [default: at
    /// least one]
    #[arg(long, value_name = "NUMBER")]
    tabs: Option<u32>,

    /// Nets that are not to be isolated, as for mill [default: from the programs' comments]
    #[arg(long, value_name = "PATTERN", value_delimiter = ',')]
    ignore: Vec<Pattern>,

    /// All copper between nets was to be cleared, as for mill; this and the next four [default:
    /// from the programs' comments]
    #[arg(long)]
    clear: bool,

    /// What was to be cleared: an area, as for mill; may be given several times
    #[arg(long, value_name = "X,Y,W,H|FILE", allow_hyphen_values = true)]
    clear_area: Vec<AreaChoice>,

    /// The regions of nets that were to be cleared, as for mill
    #[arg(long, value_name = "PATTERN", value_delimiter = ',')]
    clear_nets: Vec<Pattern>,

    /// How far all other copper was to be from some nets, as for mill
    #[arg(long, value_name = "PATTERN=LENGTH", value_delimiter = ',')]
    distance_for: Vec<DistanceFor>,

    /// Where nothing was to be cleared, as for mill; may be given several times
    #[arg(long, value_name = "X,Y,W,H|FILE", allow_hyphen_values = true)]
    keep_area: Vec<AreaChoice>,

    /// How many boards are in the stock, such as 3x2 [default: from the programs' comments]
    #[arg(long, value_name = "NxM")]
    tile: Option<Tiles>,

    /// Distance between them [default: from the programs' comments]
    #[arg(long, value_name = "LENGTH", value_parser = not_below_zero)]
    tile_spacing: Option<Nm>,

    /// Pixel of the simulation [default: a quarter of the kerf, within 0.005mm to 0.025mm]
    #[arg(long = "pixel", alias = "resolution", value_name = "LENGTH")]
    resolution: Option<Nm>,

    /// What is printed: text for people; json, sarif or junit for CI
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  voromill verify out/*.ngc --board board/
  voromill verify front.gcode --board board-F_Cu.gbr --tool endmill:0.2mm --side front
  voromill verify back.nc --board board.zip --tool vbit:0.1mm:20deg --side back --mirror-axis 25mm --format sarif
  voromill verify flatcam.nc --board board.zip --tool endmill:0.2mm --side front --register";

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
    /// Drills the holes on whose pins the board is flipped
    Alignment,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Json,
    Sarif,
    Junit,
}

/// A part of something: from 0 to 1.
fn part(text: &str) -> Result<f64, String> {
    let part = text.parse().ok().filter(|part| (0.0..=1.0).contains(part));
    part.ok_or_else(|| "expected a part from 0 to 1, such as 0.5".to_owned())
}

/// Two lengths.
#[derive(Clone, Copy)]
struct Offset(Vector);

impl FromStr for Offset {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let [x, y] = lengths(text).ok_or("expected two lengths, such as 1mm,-2.5mm")?;
        Ok(Self(Vector::new(x, y)))
    }
}

/// Three lengths.
#[derive(Clone, Copy)]
struct Travel([Nm; 3]);

impl FromStr for Travel {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        lengths(text).map(Self).ok_or_else(|| "expected three lengths, such as 300mm,180mm,45mm".to_owned())
    }
}

/// A length that a program was made with, as the first that says so says.
fn length(programs: &[Program], setting: &str) -> Option<Nm> {
    programs.iter().find_map(|program| verify::declared_setting(&program.text, setting)?.parse().ok())
}

/// How far a hole may be from its diameter, as the programs say.
fn diameter(programs: &[Program], usual: Nm) -> Nm {
    let is_one = |program: &Program| {
        verify::declared_setting(&program.text, "one-drill").is_some_and(|declared| declared == "true")
    };
    if programs.iter().any(is_one) {
        return verify::Settings::ANY_DIAMETER;
    }
    length(programs, "drill-tolerance").map_or(usual, |own| own.max(usual))
}

/// By which rule copper is one net, as the programs say.
fn topology(programs: &[Program]) -> Topology {
    let declared = programs.iter().find_map(|program| verify::declared_setting(&program.text, "topology"));
    declared.and_then(|name| of_word(&name.to_ascii_lowercase()).ok()).unwrap_or(Topology::Contact)
}

/// How many tabs each board was given, where that is known of all.
fn tabs(programs: &[Program]) -> Option<u32> {
    let of = |program: &Program| {
        let declared = |setting| verify::declared_setting(&program.text, setting);
        let elsewhere = declared("tab-spacing").or_else(|| declared("tab-at"));
        if elsewhere.is_some() { None } else { declared("tabs")?.parse().ok() }
    };
    programs.iter().find_map(of)
}

/// The name of a dialect that is built in.
fn dialect(text: &str) -> Result<String, String> {
    let known = Dialect::by_name(text).map(|dialect| dialect.name.to_string());
    known.ok_or_else(|| format!("expected one of {}", Dialect::names()))
}

/// Lengths between commas, where they are so many.
fn lengths<const COUNT: usize>(text: &str) -> Option<[Nm; COUNT]> {
    let lengths: Option<Vec<Nm>> = text.split(',').map(|length| length.trim().parse().ok()).collect();
    lengths?.try_into().ok()
}

impl Verify {
    pub(super) fn run(self, shared: Shared) -> Result<ExitCode, Failure> {
        let selection = Selection { skip: self.skip.clone(), ..Selection::default() };
        // What is cut says which side it is for; a file of copper that does not may be looked at as
        // either.
        let mut stages = Stages::default();
        let Loaded { mut board, sources, .. } =
            stages.run("reading", || import::survey(&self.board, &selection), |_| [])?;
        let files = self.files()?;
        let read = files.iter().map(|path| self.program(path, &board)).collect::<Result<Vec<_>, _>>()?;
        let is_probe = |program: &Program| verify::is_probe(&program.text);
        let (probes, mut programs): (Vec<Program>, Vec<Program>) = read.into_iter().partition(is_probe);
        for Program { file, .. } in &probes {
            shared.say(&format!("  {file}: it probes the surface, and mills nothing\n"));
        }
        if programs.is_empty() {
            let hint = "name those that isolate, drill or cut out";
            return Err(Failure::new("the programs mill nothing: they probe the surface", hint));
        }
        self.judge_clearing(&board, &programs)?;
        self.leave_out(&mut board, &programs, shared);
        let usual = verify::Settings::default();
        let settings = verify::Settings {
            copper: self.copper,
            gouge: self.max_gouge,
            keep: self.keep_width,
            sliver: self.sliver,
            travel: self.travel.map(|Travel(travel)| travel),
            tabs: self.tabs.or_else(|| tabs(&programs)),
            tab_width: length(&programs, "tab-width"),
            diameter: diameter(&programs, usual.diameter),
            complete: self.programs.iter().any(|path| path.is_dir()),
            tiles: self.tiles(&programs)?,
            pixel: self.resolution,
            board: self.thickness(&programs, &board, shared)?,
            ..usual
        };
        if self.register {
            // Those that isolate tell most; holes may fit in several places.
            let mut likely = Vec::new();
            let (isolate, others): (Vec<_>, Vec<_>) =
                programs.iter_mut().partition(|program| verify::is_isolation(program));
            for program in isolate.into_iter().chain(others) {
                likely.push(self.lay(program, &board, &likely, &settings, shared)?);
            }
        }
        let input = |source: Source| verify::Input { file: source.file, design: source.design };
        let inputs: Vec<verify::Input> = sources.into_iter().map(input).collect();
        let judge = || verify::verify(&programs, &board, &[], &settings);
        let report = stages.run("simulating", judge, |_| [("programs", programs.len())])?;
        shared.tell_stages(&stages);
        let report = report.with(verify::revisions(&programs, &inputs));
        let verdict = Verdict::from(&report);
        shared.complain(&FindingEntry::failing(&verdict.findings, self.deny));
        match self.format {
            Format::Text => {
                shared.report(&format!("{}{}", verdict.to_text(shared.is_verbose()), verdict.fitness(0)))
            }
            Format::Json => super::print(&verdict.to_json()),
            Format::Sarif => super::print(&verdict.to_sarif()),
            Format::Junit => super::print(&verdict.to_junit(self.deny)),
        }?;
        Ok(if report.passes(self.deny) { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    /// Takes the nets out of the copper that were not to be isolated, and widens holes that are for
    /// rivets.
    fn leave_out(&self, board: &mut Board, programs: &[Program], shared: Shared) {
        let mut patterns = self.ignore.clone();
        if patterns.is_empty() {
            let declared = programs.iter().flat_map(|program| verify::declared_list(&program.text, "ignore"));
            let all: BTreeSet<String> = declared.collect();
            patterns = all.iter().filter_map(|name| name.parse().ok()).collect();
        }
        let declared = programs.iter().find_map(|program| verify::declared_setting(&program.text, "rivet"));
        if let Some(wider) = declared.and_then(|length| length.parse().ok()) {
            job::rivet(board, wider);
        }
        let found = job::ignore(board, &patterns, topology(programs));
        // Of patterns that programs say that was told when they were made.
        let without =
            |warning: &&Warning| !self.ignore.is_empty() && warning.is(&planning::PATTERN_WITHOUT_NET);
        for warning in found.iter().filter(without) {
            shared.say(&format!("warning: {}\n", warning.message));
        }
    }

    /// Fails where something is to be cleared that is not there: a judge that looks for nothing
    /// finds nothing.
    fn judge_clearing(&self, board: &Board, programs: &[Program]) -> Result<(), Failure> {
        let missed = self.clearing().misses(board, topology(programs)).into_iter().next();
        missed.map_or(Ok(()), |missed| Err(Failure::new(missed.message.clone(), missed.kind.advice)))
    }

    /// The programs, those of folders in order of their names.
    fn files(&self) -> Result<Vec<PathBuf>, Failure> {
        let mut files = Vec::new();
        for path in &self.programs {
            if !path.is_dir() {
                files.push(path.clone());
                continue;
            }
            let found = programs(path)?;
            if found.is_empty() {
                return Err(without_programs(&[path]));
            }
            files.extend(found);
        }
        // What is named twice is one program.
        let mut seen = BTreeSet::new();
        files.retain(|file| seen.insert(std::fs::canonicalize(file).unwrap_or_else(|_| file.clone())));
        Ok(files)
    }

    /// How thick the board is.
    fn thickness(&self, programs: &[Program], board: &Board, shared: Shared) -> Result<Nm, Failure> {
        if let Some(thickness) = self.thickness {
            return Ok(thickness);
        }
        let declared = programs.iter().filter_map(|program| {
            let text = verify::declared_setting(&program.text, "thickness")?;
            Some((program, text.parse::<Nm>().ok().filter(|&thickness| thickness > Nm::ZERO)?))
        });
        let declared: Vec<(&Program, Nm)> = declared.collect();
        let Some(&(first, thickness)) = declared.first() else {
            return Ok(board.thickness.unwrap_or(verify::Settings::default().board));
        };
        match declared.iter().find(|(_, other)| *other != thickness) {
            None => {
                if let Some(other) = board.thickness.filter(|other| *other != thickness) {
                    shared.say(&format!(
                        "warning: the programs are for a board of {thickness:.3} mm, but its file says {other:.3} mm: \
                         --thickness says which is right\n"
                    ));
                }
                Ok(thickness)
            }
            Some((other, otherwise)) => {
                let cause = format!(
                    "{} is for a board of {thickness:.3} mm, {} for one of {otherwise:.3} mm",
                    first.file, other.file
                );
                Err(Failure::new(cause, "set the thickness of the board: --thickness 1.6mm"))
            }
        }
    }

    /// How many boards there are.
    fn tiles(&self, programs: &[Program]) -> Result<Option<verify::Tiles>, Failure> {
        let declared =
            |setting| programs.iter().find_map(|program| verify::declared_setting(&program.text, setting));
        let tiles = self.tile.or_else(|| declared("tile")?.parse().ok());
        let Some(Tiles { columns, rows }) = tiles.filter(|tiles| tiles.columns * tiles.rows > 1) else {
            return Ok(None);
        };
        let spacing = self.tile_spacing.or_else(|| declared("tile-spacing")?.parse().ok());
        let Some(spacing) = spacing else {
            let cause = format!("the distance between the {columns}x{rows} boards is unknown");
            return Err(Failure::new(cause, "set it: --tile-spacing 3mm"));
        };
        Ok(Some(verify::Tiles { columns, rows, spacing }))
    }

    /// Finds how the board lies under a program, and says so.
    fn lay(
        &self,
        program: &mut Program,
        board: &Board,
        likely: &[Placement],
        settings: &verify::Settings,
        shared: Shared,
    ) -> Result<Placement, Failure> {
        let known = Orientation { degrees: self.rotate.map(Angle::degrees), mirror: self.mirror };
        let found = verify::register(program, board, &known, likely, settings)?;
        let mirror = found.mirror.map_or(String::new(), |axis| format!(" --mirror-axis {axis:.3}mm"));
        let turned = if found.degrees.abs() < 1e-9 {
            String::new()
        } else {
            format!(" --rotate {}deg", found.degrees)
        };
        let (x, y) = (found.shift.x, found.shift.y);
        shared.say(&format!("{}: placed as with --offset {x:.4}mm,{y:.4}mm{mirror}{turned}\n", program.file));
        program.placement = Some(found);
        Ok(found)
    }

    /// What was to be cleared, if anybody says.
    fn asked(&self) -> Option<Asked> {
        let asked = self.clearing().asked(self.clear, Nm::ZERO);
        asked.is_something().then_some(asked)
    }

    /// Where all was to be cleared.
    fn clearing(&self) -> job::Clearing {
        job::Clearing {
            nets: self.clear_nets.clone(),
            areas: self.clear_area.clone(),
            distances: self.distance_for.clone(),
            kept: self.keep_area.clone(),
        }
    }

    fn program(&self, path: &Path, board: &Board) -> Result<Program, Failure> {
        let bytes = std::fs::read(path).map_err(|error| Failure::io("read", path, &error))?;
        let role = self.side.map(|purpose| match purpose {
            Purpose::Front => Role::Isolation(Side::Front),
            Purpose::Back => Role::Isolation(Side::Back),
            Purpose::Drill => Role::Drilling,
            Purpose::Cutout => Role::Cutout,
            Purpose::Alignment => Role::Alignment,
        });
        let given = Laid {
            degrees: self.rotate.map(Angle::degrees),
            shift: self.offset.map(|Offset(shift)| shift),
            mirror: self.mirror,
        };
        let (text, is_bytes) = text_of(bytes);
        let program = Program {
            // As it was given: editors and code hosts find the file by it.
            file: path.display().to_string(),
            text,
            role,
            cutter: self.tool,
            placement: None,
            asked: self.asked(),
            dialect: self.dialect.clone(),
            is_bytes,
        };
        let placement = (given != Laid::default()).then(|| given.of(&program, board));
        Ok(Program { placement, ..program })
    }
}
