//! `voromill carve`: the program that carves shapes with a V-bit.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use voromill::board::{Copper, FLATTEN, Feature, Side, polarity};
use voromill::gcode::Input as Origin;
use voromill::geometry::{Nm, Polygon};
use voromill::import::{self, text::text};
use voromill::job::{Art, Carving, Engraving, Length, OneTool, Settings, ToolChoice, carve};
use voromill::report;
use voromill::report::document::WarningEntry;
use voromill::toolpath::Angle;
use voromill::verify::carving::Carved;

use super::config::Config;
use super::input::{Colour, Input, dpi};
use super::output::Output;
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
    /// The file with the shapes
    #[arg(required_unless_present = "text", conflicts_with = "text", value_name = "PATH")]
    path: Option<PathBuf>,

    /// Program to write; `-` for stdout
    #[arg(long, short, value_name = "FILE", required_unless_present = "check")]
    output: Option<PathBuf>,

    /// Letters instead of a file; \n begins a new line
    #[arg(long, value_name = "TEXT", requires = "font", help_heading = "Text")]
    text: Option<String>,

    /// The font: a TrueType or OpenType file
    #[arg(long, value_name = "FILE", help_heading = "Text")]
    font: Option<PathBuf>,

    /// How high capitals are
    #[arg(long, value_name = "LENGTH", default_value = "6mm", help_heading = "Text")]
    height: Length,

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

    /// Pixels to the inch of a picture, whatever the file says
    #[arg(long, value_name = "NUMBER", value_parser = dpi, help_heading = "Pictures")]
    picture_dpi: Option<f64>,

    /// The same as the width of the whole picture
    #[arg(long, value_name = "LENGTH", conflicts_with = "picture_dpi", help_heading = "Pictures")]
    picture_width: Option<Length>,

    /// Which part of a picture is carved [default: the rarer]
    #[arg(long, value_enum, value_name = "COLOUR", help_heading = "Pictures")]
    ink: Option<Colour>,

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
        let input = Input::artwork(self.path.clone(), self.picture_dpi, self.picture_width, self.ink);
        let settings = self.config.settings(&input)?;
        let art = self.art(&input, &settings)?;
        let engraving = carve(art, &settings, &self.how(&input)?)?;
        let judged = match self.check.as_slice() {
            [] if self.no_verify => None,
            [] => Some(engraving.verify(None)?),
            paths => Some(judged(&engraving, paths)?),
        };
        let warnings: Vec<WarningEntry> = engraving.warnings.iter().map(WarningEntry::from).collect();
        shared.say(&report::warnings(&warnings, shared.is_verbose()));
        if let Some(output) = &self.output {
            write(output, self.picture.as_deref(), &engraving)?;
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

    /// The shapes.
    fn art(&self, input: &Input, settings: &Settings) -> Result<Art, Failure> {
        match (&self.text, &self.font, &self.path) {
            (Some(words), Some(font), _) => lettering(words, font, self.height.nm()),
            (_, _, Some(path)) => drawn(path, input, settings),
            (..) => Err(Failure::new("there is nothing to carve", "name a file, or --text and --font")),
        }
    }
}

fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

fn read_text(path: &Path) -> Result<String, Failure> {
    let bytes = std::fs::read(path).map_err(|error| Failure::io("read", path, &error))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Judges programs of files.
fn judged(engraving: &Engraving, paths: &[PathBuf]) -> Result<Carved, Failure> {
    let texts: Vec<(String, String)> =
        paths.iter().map(|path| Ok((name_of(path), read_text(path)?))).collect::<Result<_, Failure>>()?;
    let texts: Vec<(&str, &str)> = texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    Ok(engraving.judge(&texts, None)?)
}

/// How many pixels a picture is wide.
const WIDTH: u32 = 1600;

/// Writes a file for each tool: that of the V-bit is called as asked for.
fn write(output: &Path, picture: Option<&Path>, engraving: &Engraving) -> Result<(), Failure> {
    let picture = picture.map(|path| Ok::<_, Failure>((path, engraving.picture(WIDTH)?))).transpose()?;
    let mut staged = Output::new();
    if let Some((path, bytes)) = &picture {
        staged.stage(path, bytes)?;
    }
    if output == Path::new("-") {
        let [one] = engraving.programs.as_slice() else {
            let cause = format!(
                "each of {} tools has a program of its own, and stdout takes one",
                engraving.programs.len()
            );
            return Err(Failure::new(cause, "name a file: -o NAME.ngc"));
        };
        staged.commit()?;
        return super::print(&one.text);
    }
    for one in &engraving.programs {
        staged.stage(&tagged(output, one.tag), one.text.as_bytes())?;
    }
    staged.commit()
}

/// The name with a tag before its ending.
fn tagged(path: &Path, tag: &str) -> PathBuf {
    if tag.is_empty() {
        return path.to_path_buf();
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().map_or(String::new(), |ending| format!(".{}", ending.to_string_lossy()));
    path.with_file_name(format!("{stem}-{tag}{ending}"))
}

/// A text in a font.
fn lettering(words: &str, font: &Path, height: Nm) -> Result<Art, Failure> {
    let bytes = std::fs::read(font).map_err(|error| Failure::io("read", font, &error))?;
    let file = name_of(font);
    let areas = text(&bytes, &words.replace("\\n", "\n"), height).map_err(|error| {
        Failure::new(format!("{file}: {error}"), "choose another --font, --text or --height")
    })?;
    let inputs = vec![Origin { file, design: import::sha256(&bytes) }];
    // It stands in comments and names no file.
    let name: String = words.chars().filter(char::is_ascii_alphanumeric).collect();
    let name = if name.is_empty() { "text".to_owned() } else { name };
    Ok(Art { name, areas, inputs, warnings: Vec::new() })
}

/// Kinds of files that say by themselves what they are; any other is one Gerber layer.
const BOARDS: [&str; 14] = [
    "zip",
    "kicad_pcb",
    "svg",
    "dxf",
    "png",
    "jpg",
    "jpeg",
    "bmp",
    "gif",
    "tif",
    "tiff",
    "webp",
    "pnm",
    "pbm",
];

/// The shapes of a file.
fn drawn(path: &Path, input: &Input, settings: &Settings) -> Result<Art, Failure> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    let is_board = path.is_dir() || ending.is_some_and(|ending| BOARDS.contains(&ending.as_str()));
    let loaded = if is_board { input.load(settings)? } else { import::load_copper(path, Side::Front)? };
    let copper = [&loaded.board.front, &loaded.board.back].into_iter().find_map(Option::as_ref);
    let areas = copper.map_or_else(Vec::new, areas);
    let inputs = loaded
        .sources
        .iter()
        .filter(|source| !source.role.starts_with("ignored"))
        .map(|source| Origin { file: source.file.clone(), design: source.design.clone() });
    // What is said of boards and their outlines is of no use here.
    let warnings = loaded.warnings.into_iter().filter(|warning| !warning.code.starts_with("outline"));
    Ok(Art { name: loaded.board.name, areas, inputs: inputs.collect(), warnings: warnings.collect() })
}

/// What a layer covers.
fn areas(copper: &Copper) -> Vec<Polygon> {
    let shape = |feature: &Feature| feature.shape.polygon(FLATTEN);
    let rings: Vec<_> =
        copper.features.iter().filter_map(shape).flat_map(|polygon| polygon.contours().to_vec()).collect();
    polarity::clean(&rings)
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

/// What one tool does.
#[derive(Serialize)]
struct Cut {
    tool: String,
    cut_mm: f64,
    lifts: u64,
    seconds: f64,
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

#[derive(Serialize)]
struct Entry {
    name: &'static str,
    message: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    at_mm: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<u32>,
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

impl Cut {
    fn new(one: &OneTool) -> Self {
        Self {
            tool: one.program.sections[0].tool.kind.to_string(),
            cut_mm: one.statistics.cut_length.to_mm(),
            lifts: one.statistics.lifts,
            seconds: rounded(one.statistics.seconds),
        }
    }
}

/// To a thousandth.
fn rounded(number: f64) -> f64 {
    (number * 1_000.0).round() / 1_000.0
}

impl Verification {
    fn new(judged: &Carved) -> Self {
        let findings = judged.findings.iter().map(|finding| Entry {
            name: finding.name,
            message: finding.message.clone(),
            at_mm: finding.at.map(|at| [at.x.to_mm(), at.y.to_mm()]),
            line: finding.line,
        });
        Self {
            places: judged.places,
            surface_p99_um: rounded(judged.p99 / 1e3),
            too_deep_um: rounded(judged.over / 1e3),
            too_shallow_um: rounded(judged.under / 1e3),
            left_wide_mm2: rounded(judged.left_mm2),
            findings: findings.collect(),
        }
    }
}

/// What judging found, for a person.
fn to_text(judged: &Carved) -> String {
    let micrometres = |nm: f64| nm / 1_000.0;
    let mut text = format!(
        "verified at {} places: the surface is off by {:.1} µm at most at 99 of 100, {:.1} µm too deep and {:.1} µm too shallow at worst\n",
        judged.places,
        micrometres(judged.p99),
        micrometres(judged.over),
        micrometres(judged.under)
    );
    for finding in &judged.findings {
        let place =
            finding.at.map_or(String::new(), |at| format!(" at x = {:.3} mm, y = {:.3} mm", at.x, at.y));
        let line = finding.line.map_or(String::new(), |line| format!(" (line {line})"));
        text += &format!("{}: {}{place}{line}\n", finding.name, finding.message);
    }
    text
}
