//! Shapes to be milled, and what becomes of them: what `carve` and `pocket` have in common.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;
use voromill::board::{Copper, FLATTEN, Feature, Side, polarity};
use voromill::gcode::Input as Origin;
use voromill::geometry::{Nm, Polygon};
use voromill::import::drawing::Unit;
use voromill::import::{self, Loaded, text::text};
use voromill::job::{Art, Length, OneTool, Settings};
use voromill::verify::Finding;

use super::Failure;
use super::input::{Colour, Input, dpi};
use super::output::Output;

/// Where the shapes come from.
#[derive(Args)]
pub(super) struct Shapes {
    /// The file with the shapes
    #[arg(required_unless_present = "text", conflicts_with = "text", value_name = "PATH")]
    path: Option<PathBuf>,

    /// Letters instead of a file; \n begins a new line
    #[arg(long, value_name = "TEXT", requires = "font", help_heading = "Text")]
    text: Option<String>,

    /// The font: a TrueType or OpenType file
    #[arg(long, value_name = "FILE", help_heading = "Text")]
    font: Option<PathBuf>,

    /// How high capitals are
    #[arg(long, value_name = "LENGTH", default_value = "6mm", help_heading = "Text")]
    height: Length,

    /// Pixels to the inch of a picture, whatever the file says
    #[arg(long, value_name = "NUMBER", value_parser = dpi, help_heading = "Pictures")]
    picture_dpi: Option<f64>,

    /// The same as the width of the whole picture
    #[arg(long, value_name = "LENGTH", conflicts_with = "picture_dpi", help_heading = "Pictures")]
    picture_width: Option<Length>,

    /// Which part of a picture is milled [default: the rarer]
    #[arg(long, value_enum, value_name = "COLOUR", help_heading = "Pictures")]
    ink: Option<Colour>,

    /// How long one unit of a drawing (SVG, DXF) is, whatever the file says: mm, in, 0.1mm, or
    /// 90dpi for a 90th inch
    #[arg(long, value_name = "UNIT", help_heading = "Drawings")]
    unit: Option<Unit>,
}

impl Shapes {
    /// The file, as a board is read.
    pub(super) fn input(&self) -> Input {
        Input::artwork(self.path.clone(), self.picture_dpi, self.picture_width, self.ink, self.unit)
    }

    /// The shapes.
    pub(super) fn art(&self, input: &Input, settings: &Settings) -> Result<Art, Failure> {
        match (&self.text, &self.font, &self.path) {
            (Some(words), Some(font), _) => lettering(words, font, self.height.nm()),
            (_, _, Some(path)) => drawn(path, input, settings),
            (..) => Err(Failure::new("there is nothing to mill", "name a file, or --text and --font")),
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

/// The programs of files, each with its name.
pub(super) fn programs(paths: &[PathBuf]) -> Result<Vec<(String, String)>, Failure> {
    paths.iter().map(|path| Ok((name_of(path), read_text(path)?))).collect()
}

/// Those as they are judged.
pub(super) fn borrowed(texts: &[(String, String)]) -> Vec<(&str, &str)> {
    texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect()
}

/// How many pixels a picture is wide.
pub(super) const WIDTH: u32 = 1600;

/// Writes a file for each tool, called as asked for but for its tag, and a picture.
pub(super) fn write(
    output: &Path,
    picture: Option<(&Path, Vec<u8>)>,
    programs: &[OneTool],
) -> Result<(), Failure> {
    let mut staged = Output::new();
    if let Some((path, bytes)) = &picture {
        staged.stage(path, bytes)?;
    }
    if output == Path::new("-") {
        let [one] = programs else {
            let cause =
                format!("each of {} tools has a program of its own, and stdout takes one", programs.len());
            return Err(Failure::new(cause, "name a file: -o NAME.ngc"));
        };
        staged.commit()?;
        return super::print(&one.text);
    }
    for one in programs {
        staged.stage(&tagged(output, &one.tag), one.text.as_bytes())?;
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
    let is_board = path.is_dir() || ending.as_ref().is_some_and(|ending| BOARDS.contains(&ending.as_str()));
    let is_drawing = ending.is_some_and(|ending| ["svg", "dxf"].contains(&ending.as_str()));
    let filled = |loaded: &Loaded| {
        let copper = [&loaded.board.front, &loaded.board.back].into_iter().find_map(Option::as_ref);
        copper.map_or_else(Vec::new, areas)
    };
    let loaded = if is_board { input.load(settings) } else { Ok(import::load_copper(path, Side::Front)?) };
    let (loaded, areas) = match loaded {
        Ok(loaded) => {
            let areas = filled(&loaded);
            if areas.is_empty() && is_drawing { enclosed(input, settings)? } else { (loaded, areas) }
        }
        Err(failure) if is_drawing => enclosed(input, settings).map_err(|_| failure)?,
        Err(failure) => return Err(failure),
    };
    let inputs = loaded
        .sources
        .iter()
        .filter(|source| !source.role.starts_with("ignored"))
        .map(|source| Origin { file: source.file.clone(), design: source.design.clone() });
    // What is said of boards and their outlines is of no use here; and what a solder mask calls
    // negative, what it draws, are its openings.
    let is_of_use =
        |code: &str| !code.starts_with("outline") && !["negative-file", "copper-missing"].contains(&code);
    let warnings = loaded.warnings.into_iter().filter(|warning| is_of_use(warning.code));
    Ok(Art { name: loaded.board.name, areas, inputs: inputs.collect(), warnings: warnings.collect() })
}

/// What the lines of a drawing enclose that fills nothing, and what is read so.
fn enclosed(input: &Input, settings: &Settings) -> Result<(Loaded, Vec<Polygon>), Failure> {
    let loaded = input.as_outline().survey(settings)?;
    let outline = loaded.board.outline.as_ref().map(|outline| outline.polygon(FLATTEN));
    let areas = outline.map_or_else(Vec::new, |outline| polarity::clean(outline.contours()));
    Ok((loaded, areas))
}

/// What a layer covers.
fn areas(copper: &Copper) -> Vec<Polygon> {
    let shape = |feature: &Feature| feature.shape.polygon(FLATTEN);
    let rings: Vec<_> =
        copper.features.iter().filter_map(shape).flat_map(|polygon| polygon.contours().to_vec()).collect();
    polarity::clean(&rings)
}

/// What one tool does.
#[derive(Serialize)]
pub(super) struct Cut {
    tool: String,
    cut_mm: f64,
    lifts: u64,
    seconds: f64,
}

impl Cut {
    pub(super) fn new(one: &OneTool) -> Self {
        Self {
            tool: one.program.sections[0].tool.kind.to_string(),
            cut_mm: one.statistics.cut_length.to_mm(),
            lifts: one.statistics.lifts,
            seconds: rounded(one.statistics.seconds),
        }
    }
}

/// Something that is wrong.
#[derive(Serialize)]
pub(super) struct Entry {
    name: &'static str,
    message: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    at_mm: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<u32>,
}

impl Entry {
    pub(super) fn new(finding: &Finding) -> Self {
        Self {
            name: finding.name,
            message: finding.message.clone(),
            at_mm: finding.at.map(|at| [at.x.to_mm(), at.y.to_mm()]),
            line: finding.line,
        }
    }
}

/// To a thousandth.
pub(super) fn rounded(number: f64) -> f64 {
    (number * 1_000.0).round() / 1_000.0
}

/// What is wrong, a line for each.
pub(super) fn lines(findings: &[Finding]) -> String {
    let line = |finding: &Finding| {
        let place =
            finding.at.map_or(String::new(), |at| format!(" at x = {:.3} mm, y = {:.3} mm", at.x, at.y));
        let line = finding.line.map_or(String::new(), |line| format!(" (line {line})"));
        format!("{}: {}{place}{line}\n", finding.name, finding.message)
    };
    findings.iter().map(line).collect()
}
