//! `voromill level`: a program that follows the surface that a probe has found.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use voromill::gcode::level::{Frame, HeightMap, LevelError, Levelling, MARK, MapError, Outlier, level};
use voromill::geometry::Nm;
use voromill::import::sha256;
use voromill::job::{Length, Place, Triple};

use super::output::Output;
use super::program_files::{bytes_of, text_of};
use super::{Failure, Shared};

/// A program levelled: adapted to the surface that was probed
///
/// Reads a program from any CAM and a map of heights, and adds the height of the surface to every z
/// below the height for travel. Cuts and arcs are split where the surface asks for it; comments,
/// tools, feeds and rapids above the board stay as they are. The map is bCNC's .probe,
/// OpenCNCPilot's .hmap, Candle's .map, an .xyz table of Universal Gcode Sender, a probe log of
/// LinuxCNC or Mach, or a log with Grbl's [PRB:...] or TinyG's {"prb":...} lines, known by what is
/// in it. A touch that lies off its neighbours by more than the rest scatters is refused.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Level {
    /// Program to level
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,

    /// Heights that were probed
    #[arg(long, value_name = "PROBE")]
    map: PathBuf,

    /// Program to write; `-` for stdout [default: PROGRAM with -levelled after its name]
    #[arg(long, short, value_name = "OUT")]
    output: Option<PathBuf>,

    /// How far the tool may be from its depth below the surface between the points where a cut is
    /// split
    #[arg(long, value_name = "LENGTH", default_value = "5um")]
    tolerance: Length,

    /// How far outside the probed area the program may cut; the surface is taken to be level there
    #[arg(long, value_name = "LENGTH", default_value = "2mm")]
    margin: Length,

    /// Height from which on nothing is levelled [default: that of the program's lowest level rapid]
    #[arg(long, value_name = "LENGTH")]
    safe_z: Option<Length>,

    /// Unit of the numbers of the map
    #[arg(long, value_enum, default_value = "mm")]
    map_unit: Unit,

    /// The work zero in the coordinates of the map, for logs of Grbl without a WCO: report
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    map_zero: Option<Triple>,

    /// Level even if probed points lie off their neighbours, and list them
    #[arg(long)]
    accept_outliers: bool,

    /// Take the height at this place as zero: where z was set to zero after probing, with another
    /// tool
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    zero_at: Option<Place>,
}

const EXAMPLES: &str = "\
Examples:
  voromill level out/board-front.ngc --map board.probe
  voromill level flatcam.nc --map board.hmap -o levelled.nc --tolerance 2um
  voromill level front.ngc --map grbl.log --map-zero -120mm,-80mm,-31.2mm
  voromill level front.ngc --map board-front-probe.txt --zero-at 0mm,0mm";

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Unit {
    Mm,
    In,
}

impl Level {
    pub(super) fn run(self, shared: Shared) -> Result<(), Failure> {
        let (text, is_bytes) = read(&self.program)?;
        let (map, format) = self.map()?;
        let (program, name) = (name(&self.program), name(&self.map));
        let hash = sha256(read(&self.map)?.0.as_bytes());
        let levelling = Levelling {
            tolerance: positive("--tolerance", self.tolerance)?,
            margin: self.margin()?,
            safe: self.safe_z.map(Length::nm),
            note: format!(
                "{MARK} {} to {name} sha256 {} within {}",
                env!("CARGO_PKG_VERSION"),
                &hash[..12],
                self.tolerance
            )
            .replace(['(', ')', '?', '!', '~', ';', '%'], "."),
        };
        let done = level(&text, &map, &levelling)
            .map_err(|error| Failure::new(format!("{program}: {error}"), hint(&error)))?;
        let output = self.output.unwrap_or_else(|| beside(&self.program));
        let (columns, rows) = map.size();
        let outliers = map.outliers();
        let accepted =
            if outliers.is_empty() { String::new() } else { format!("{name}: {}\n", off(&outliers)) };
        let text = bytes_of(done.text, is_bytes);
        if output == Path::new("-") {
            shared.say(&accepted);
            return super::print_bytes(&text);
        }
        let mut files = Output::new([self.map.clone(), self.program.clone()]);
        files.stage(&output, &text)?;
        files.commit()?;
        let [low, high] = done.heights.unwrap_or_default();
        shared.report(&format!(
            "{}: {} motions below {:.3} mm follow a surface from {low:.3} mm to {high:.3} mm, {} lines more\n{name}: {}, {columns} by {rows} probed points\n{accepted}",
            output.display(),
            done.levelled,
            done.safe,
            done.added,
            format,
        ))
    }

    fn map(&self) -> Result<(HeightMap, &'static str), Failure> {
        let (text, _) = read(&self.map)?;
        let unit = match self.map_unit {
            Unit::Mm => Nm::from_mm(1),
            Unit::In => Nm::from_um(25_400),
        };
        let zero = self.map_zero.map(|Triple(zero)| zero.map(Length::nm));
        let (map, format) = HeightMap::read(&text, &Frame { unit, zero })
            .map_err(|error| Failure::new(format!("{}: {error}", name(&self.map)), map_hint(&error)))?;
        let outliers = map.outliers();
        if !outliers.is_empty() && !self.accept_outliers {
            let hint = "probe there again, or take them as they are with --accept-outliers";
            return Err(Failure::new(format!("{}: {}", name(&self.map), off(&outliers)), hint));
        }
        let Some(place) = self.zero_at else { return Ok((map, format.name)) };
        if !map.area().inflate(self.margin()?).contains(place.into()) {
            let problem = format!("--zero-at: nothing was probed near {place}");
            return Err(Failure::new(
                problem,
                "give a position on the map, in the coordinates of the program",
            ));
        }
        Ok((map.zeroed_at(place.into()), format.name))
    }

    /// How far outside what was probed the surface is taken to go on.
    fn margin(&self) -> Result<Nm, Failure> {
        let margin = self.margin.nm();
        if margin < Nm::ZERO {
            let problem = format!("--margin: `{}` is invalid: expected zero or more", self.margin);
            return Err(Failure::new(problem, ""));
        }
        Ok(margin)
    }
}

/// What lies off, the first five of it.
fn off(outliers: &[Outlier]) -> String {
    let place = |outlier: &Outlier| {
        let (side, Outlier { at, height, scatter, .. }) =
            (if outlier.off > Nm::ZERO { "above" } else { "below" }, outlier);
        format!(
            "x = {:.3} mm, y = {:.3} mm at {height:.3} mm is {:.3} mm {side} its neighbours, where the others scatter by {scatter:.3} mm",
            at.x,
            at.y,
            outlier.off.abs()
        )
    };
    let shown: Vec<String> = outliers.iter().take(5).map(place).collect();
    let more = match outliers.len().saturating_sub(shown.len()) {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    let touches = if outliers.len() == 1 { "probed point lies" } else { "probed points lie" };
    format!("{} {touches} off the plane of the neighbours: {}{more}", outliers.len(), shown.join("; "))
}

fn positive(option: &str, length: Length) -> Result<Nm, Failure> {
    /// A cut split more often than each micrometre of height is longer than any machine has
    /// patience for. Chosen.
    const LEAST: Nm = Nm::from_um(1);
    if length.nm() >= LEAST {
        return Ok(length.nm());
    }
    Err(Failure::new(format!("{option}: `{length}` is invalid: expected at least {}", Length(LEAST)), ""))
}

fn read(path: &Path) -> Result<(String, bool), Failure> {
    let bytes = std::fs::read(path).map_err(|error| Failure::io("read", path, &error))?;
    Ok(text_of(bytes))
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// `front.ngc` → `front-levelled.ngc`.
fn beside(program: &Path) -> PathBuf {
    let stem = program.file_stem().unwrap_or_default().to_string_lossy();
    let ending = program.extension().map_or(String::new(), |ending| format!(".{}", ending.to_string_lossy()));
    program.with_file_name(format!("{stem}-levelled{ending}"))
}

fn hint(error: &LevelError) -> &'static str {
    match error {
        LevelError::Outside { .. } => {
            "probe a larger area, allow more with --margin, or move the program to the probed area"
        }
        LevelError::High { .. } => "raise the travel height of the program, or zero Z again and probe again",
        LevelError::Levelled { .. } => {
            "level the program as it was made: that without -levelled after its name"
        }
        LevelError::Nowhere { .. } => "set with --safe-z the height above which nothing is levelled",
        _ => "",
    }
}

fn map_hint(error: &MapError) -> &'static str {
    match error {
        MapError::Zero { .. } => {
            "set it with --map-zero X,Y,Z (what $# shows for G54, plus what it shows for G92 and TLO), or keep a status report with WCO: in the log"
        }
        MapError::Steep { .. } => "set the unit of the map with --map-unit, or probe that place again",
        MapError::Contradicting { .. } => "leave the wrong one out of the file, or probe that place again",
        MapError::Beside { .. } => {
            "leave that line out of the file: the touch by which z was set to zero belongs to no grid"
        }
        MapError::Missing { .. } | MapError::Count { .. } => {
            "probe what is missing, or the whole board again"
        }
        _ => "",
    }
}
