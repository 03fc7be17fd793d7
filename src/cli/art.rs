//! Shapes to be milled, and what becomes of them: what `carve` and `pocket` have in common.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use voromill::board::diagnostic::planning;
use voromill::board::{Copper, Diagnostic, FLATTEN, Feature, Side, Warning, polarity};
use voromill::gcode;
use voromill::geometry::{Nm, Polygon};
use voromill::import::drawing::Unit;
use voromill::import::{self, Loaded, Shapes, diagnostic, load_copper, picture, text::text};
use voromill::job::{self, Art, Length, OneTool, Reach, Settings};
use voromill::report;
use voromill::report::document::{Figures, ProgramEntry, SCHEMA_VERSION, WarningEntry};
use voromill::report::stages::{Stage, Stages};
use voromill::report::verdict::FindingEntry;
use voromill::verify::{Finding, Severity};

use super::config::Config;
use super::format::Format;
use super::input::{Colour, Input, Scan, dpi};
use super::output::{Output, name_of, refuse_kind};
use super::progress::Progress;
use super::{Failure, Shared};

/// What both take.
#[derive(Args)]
pub(super) struct Work {
    #[command(flatten)]
    shapes: Source,

    /// Program to write; `-` for stdout. Where several tools work, each has a program of its own:
    /// NAME-1, NAME-2 and so on, the widest first; NAME-flat for the end mill of `carve --flat`
    #[arg(long, short, value_name = "FILE", required_unless_present = "check")]
    output: Option<PathBuf>,

    /// The greatest depth of one pass, for hard material or a thin tool [default: all of the depth
    /// at once]
    #[arg(long, value_name = "LENGTH", help_heading = "Shapes")]
    depth_pass: Option<Length>,

    /// Leave the shapes standing and mill the area round them, as for a stamp
    #[arg(long, help_heading = "Shapes")]
    invert: bool,

    /// With --invert or --inlay male: how far beyond the shapes is milled [default: 2mm for carve,
    /// or twice the end mill round a plug; 5mm for pocket]
    #[arg(long, value_name = "LENGTH", help_heading = "Shapes")]
    margin: Option<Length>,

    /// Simulate this program, from any CAM, and compare it with the shapes instead of writing one;
    /// where several tools work one for each, in the order in which they run
    #[arg(long, value_name = "PROGRAM", conflicts_with_all = ["output", "no_verify"], help_heading = "Output")]
    check: Vec<PathBuf>,

    /// Write a picture of the milled surface too, seen at a slant: a PNG, 1600 pixels wide
    #[arg(long, value_name = "FILE", requires = "output", help_heading = "Output")]
    picture: Option<PathBuf>,

    /// Do not verify: the program is otherwise read back, simulated and compared with the shapes
    #[arg(long, help_heading = "Output")]
    no_verify: bool,

    /// What is printed: the summary for people, or the report for programs
    #[arg(long, value_enum, default_value = "text", help_heading = "Output")]
    format: Format,

    /// The same as --format json
    #[arg(long, hide = true, help_heading = "Output")]
    json: bool,

    #[command(flatten)]
    config: Config,
}

/// The programs of one command, as all of its run that is common needs them.
pub(super) trait Milled {
    /// What comparing them with the shapes comes to.
    type Judged;

    /// The options that mean something to them.
    const REACH: Reach;

    /// A program for each tool, in the order in which they run.
    fn programs(&self) -> &[OneTool];

    /// What a person must know.
    fn warnings(&self) -> &[Warning];

    /// Where the time of planning them went.
    fn stages(&self) -> &Stages;

    /// Judges its own programs, or others in their place, each with its name.
    fn judge(&self, others: Option<&[(&str, &str)]>) -> Result<Self::Judged, job::Error>;

    /// What judging found.
    fn findings(judged: &Self::Judged) -> &[Finding];

    /// What is milled, as a PNG so many pixels wide.
    fn picture(&self, width: u32) -> Result<Vec<u8>, job::Error>;

    /// What the programs do, for a person; `files` are what they are called where they are written.
    fn summary(&self, files: &[String]) -> String;

    /// What judging came to, for a person: a line.
    fn verdict(&self, judged: &Self::Judged) -> String;

    /// What is said of them in the report: its own keys.
    fn figures(&self) -> impl Serialize;

    /// What is said of their judgement in the report: its own keys.
    fn verification(judged: &Self::Judged) -> impl Serialize;
}

/// What was made and found, as data.
#[derive(Serialize)]
struct Account<'a, F, V> {
    schema_version: u32,
    name: &'a str,
    #[serde(flatten)]
    figures: F,
    programs: Vec<ProgramEntry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    verification: Option<Verification<V>>,
    warnings: &'a [WarningEntry],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    stages: &'a [Stage],
}

/// What came of comparing the programs with the shapes.
#[derive(Serialize)]
struct Verification<V> {
    #[serde(flatten)]
    figures: V,
    findings: Vec<FindingEntry>,
}

impl Work {
    /// Reads the shapes, has programs planned for them, judges, writes and reports them.
    pub(super) fn run<M: Milled>(
        &self,
        shared: Shared,
        plan: impl FnOnce(Art, &Settings, &Self) -> Result<M, Failure>,
    ) -> Result<ExitCode, Failure> {
        if let Some(picture) = &self.picture {
            refuse_kind(picture, "name the picture .png")?;
        }
        let input = self.input();
        let settings = self.config.for_artwork(&input, M::REACH, shared)?;
        let progress = Progress::start(shared);
        let mut stages = Stages::default();
        progress.say("reading");
        let areas = |art: &Result<Art, _>| [("areas", art.as_ref().map_or(0, |art| art.areas.len()))];
        let art = stages.run("reading", || self.shapes.art(&input, &settings), areas)?;
        let name = art.name.clone();
        progress.say("planning");
        let made = plan(art, &settings, self)?;
        stages.extend(made.stages());
        progress.say("simulating");
        let judge = || stages.run("simulating", || self.judge(&made), |_| []);
        let judged = (!self.no_verify).then(judge).transpose()?;
        let picture = self.picture.as_deref().map(|path| {
            progress.say("drawing");
            let png = stages.run("picture", || made.picture(WIDTH), |_| [])?;
            Ok::<_, Failure>((path, png))
        });
        let picture = picture.transpose()?;
        drop(progress);
        let stale = self.output.as_deref().and_then(|output| stale(output, made.programs()));
        let warnings = made.warnings().iter().chain(&stale);
        let warnings: Vec<WarningEntry> = warnings.map(WarningEntry::from).collect();
        shared.say(&report::warnings(&warnings, shared.is_verbose()));
        if let Some(output) = &self.output {
            write(Output::new(input.sources()), output, picture, made.programs())?;
        }
        shared.tell_stages(&stages);
        let findings = judged.as_ref().map_or(&[][..], M::findings);
        let entries: Vec<FindingEntry> = findings.iter().map(FindingEntry::from).collect();
        shared.complain(&FindingEntry::failing(&entries, Severity::Error));
        let to_stdout = self.output.as_deref() == Some(Path::new("-"));
        if (self.json || self.format == Format::Json) && !to_stdout {
            let told = if shared.tells_stages() { stages.list() } else { &[] };
            super::print(&self.to_json((&name, &made), judged.as_ref(), &warnings, told))?;
        } else {
            let name = |output: &PathBuf| {
                let files = made.programs().iter().map(|one| name_of(&tagged(output, &one.tag)));
                made.summary(&files.filter(|_| !to_stdout).collect::<Vec<_>>())
            };
            let mut summary = self.output.as_ref().map_or(String::new(), name);
            summary.extend(judged.as_ref().map(|judged| made.verdict(judged)));
            summary += &FindingEntry::list(&entries, shared.is_verbose());
            if to_stdout { shared.say(&summary) } else { shared.report(&summary)? }
        }
        let is_spoilt = findings.iter().any(|finding| finding.severity == Severity::Error);
        Ok(if is_spoilt { ExitCode::from(1) } else { ExitCode::SUCCESS })
    }

    /// The file with the shapes, as a board is read.
    pub(super) fn input(&self) -> Input {
        self.shapes.input()
    }

    /// Where tools of one's own come from.
    pub(super) fn config(&self) -> &Config {
        &self.config
    }

    /// The greatest depth of one pass.
    pub(super) fn depth_pass(&self) -> Option<Nm> {
        self.depth_pass.map(Length::nm)
    }

    /// How far round the shapes is milled where they are to stand, `usual` unless that is said.
    pub(super) fn raised(&self, usual: Nm) -> Option<Nm> {
        self.invert.then(|| self.margin.map_or(usual, Length::nm))
    }

    /// How far beyond the shapes is milled, where that was said.
    pub(super) fn margin(&self) -> Option<Nm> {
        self.margin.map(Length::nm)
    }

    /// Fails for a margin that nothing is round, since no shapes stand.
    pub(super) fn judge_margin(&self, standing: &str) -> Result<(), Failure> {
        let cause = "--margin has no effect without shapes that stand";
        let hint = format!("add {standing}, or leave it out");
        if self.margin.is_some() { Err(Failure::new(cause, hint)) } else { Ok(()) }
    }

    /// Whether the shapes are to stand.
    pub(super) const fn is_inverted(&self) -> bool {
        self.invert
    }

    /// Judges the programs that were made, or those to be checked in their place.
    fn judge<M: Milled>(&self, made: &M) -> Result<M::Judged, Failure> {
        Ok(match self.check.as_slice() {
            [] => made.judge(None)?,
            paths => made.judge(Some(&borrowed(&programs(paths)?)))?,
        })
    }

    fn to_json<M: Milled>(
        &self,
        (name, made): (&str, &M),
        judged: Option<&M::Judged>,
        warnings: &[WarningEntry],
        stages: &[Stage],
    ) -> String {
        let verification = judged.map(|judged| Verification {
            figures: M::verification(judged),
            findings: M::findings(judged).iter().map(FindingEntry::from).collect(),
        });
        let programs = made.programs().iter();
        let account = Account {
            schema_version: SCHEMA_VERSION,
            name,
            figures: made.figures(),
            // Of others in their place the figures are not known.
            programs: programs.filter(|_| self.check.is_empty()).map(|one| self.entry(one)).collect(),
            verification,
            warnings,
            stages,
        };
        serde_json::to_string_pretty(&account).expect("numbers and texts") + "\n"
    }

    /// A program in the report, under the name it is written to.
    fn entry(&self, one: &OneTool) -> ProgramEntry {
        let written = self.output.as_ref().map(|output| tagged(output, &one.tag));
        ProgramEntry {
            file: written.as_deref().map_or_else(String::new, name_of),
            title: one.program.title.clone(),
            tools: vec![one.program.sections[0].tool.kind.to_string()],
            figures: Figures::from(&one.statistics),
        }
    }
}

/// Where the shapes come from.
#[derive(Args)]
struct Source {
    /// The file with the shapes: a picture, a drawing (SVG, DXF) or FILE#LAYER for one layer of it,
    /// copper of a board
    #[arg(required_unless_present = "text", conflicts_with = "text", value_name = "PATH")]
    path: Option<PathBuf>,

    /// Text to mill instead of a file; \n begins a new line
    #[arg(long, value_name = "TEXT", requires = "font", help_heading = "Text")]
    text: Option<String>,

    /// Font of --text, or for the texts of an SVG: a TrueType or OpenType file
    #[arg(long, value_name = "FILE", help_heading = "Text")]
    font: Option<PathBuf>,

    /// Height of capitals of --text [default: 6mm]
    #[arg(long, value_name = "LENGTH", requires = "text", help_heading = "Text")]
    height: Option<Length>,

    /// Resolution of a picture in pixels per inch, even if the file has another
    #[arg(long, value_name = "NUMBER", value_parser = dpi, help_heading = "Pictures")]
    picture_dpi: Option<f64>,

    /// Width of the whole picture, instead of --picture-dpi
    #[arg(long, value_name = "LENGTH", conflicts_with = "picture_dpi", help_heading = "Pictures")]
    picture_width: Option<Length>,

    #[command(flatten)]
    scan: Scan,

    /// Which part of a picture is milled [default: the rarer]
    #[arg(long, visible_alias = "copper", value_enum, value_name = "COLOUR", help_heading = "Pictures")]
    ink: Option<Colour>,

    /// Length of one unit of a drawing (SVG, DXF), even if the file has another: mm, in, 0.1mm, or
    /// 90dpi for 1/90 inch
    #[arg(long, value_name = "UNIT", help_heading = "Drawings")]
    unit: Option<Unit>,
}

impl Source {
    /// The file, as a board is read.
    fn input(&self) -> Input {
        Input {
            paths: self.path.iter().cloned().collect(),
            picture_dpi: self.picture_dpi,
            picture_width: self.picture_width,
            copper: self.ink,
            scan: self.scan,
            unit: self.unit,
            fonts: self.font.iter().cloned().collect(),
            ..Input::default()
        }
    }

    /// The shapes.
    fn art(&self, input: &Input, settings: &Settings) -> Result<Art, Failure> {
        match (&self.text, &self.font, &self.path) {
            (Some(words), Some(font), _) => {
                self.judge(Origin::Text)?;
                lettering(words, font, self.height.map_or(CAPITALS, Length::nm))
            }
            (_, _, Some(path)) => self.drawn(path, input, settings),
            (..) => Err(Failure::new("there is nothing to mill", "give a file, or --text and --font")),
        }
    }

    /// Fails for an option that what is read makes nothing of.
    fn judge(&self, origin: Origin) -> Result<(), Failure> {
        let pictures = [
            ("--picture-dpi", self.picture_dpi.is_some()),
            ("--picture-width", self.picture_width.is_some()),
            ("--picture-pitch", self.scan.picture_pitch.is_some()),
            ("--ink", self.ink.is_some()),
            ("--despeckle", self.scan.despeckle.is_some()),
            ("--crop", self.scan.crop.is_some()),
        ];
        let unit = [("--unit", self.unit.is_some())];
        let font = [("--font", self.font.is_some())];
        let (what, idle) = match origin {
            Origin::Text => ("with --text", [&pictures[..], &unit].concat()),
            Origin::Drawing => ("on a drawing", pictures.to_vec()),
            Origin::Picture => ("on a picture", [unit, font].concat()),
            Origin::Board => ("on a file of a board", [&pictures[..], &unit, &font].concat()),
        };
        let Some((option, _)) = idle.into_iter().find(|(_, is_given)| *is_given) else { return Ok(()) };
        let hint = match option {
            "--unit" => "leave it out: it is for drawings",
            "--font" => "leave it out: it is for --text and for texts of an SVG",
            _ => "leave it out: it is for pictures",
        };
        Err(Failure::new(format!("{option} has no effect {what}"), hint))
    }

    /// The shapes of a file.
    fn drawn(&self, path: &Path, input: &Input, settings: &Settings) -> Result<Art, Failure> {
        if let Some(shapes) = import::load_shapes(path, &input.drawing()?, settings.outline_gap)? {
            self.judge(Origin::Drawing)?;
            let Shapes { name, areas, source, warnings } = shapes;
            let inputs = vec![gcode::Input { file: source.file, design: source.design }];
            return Ok(Art { name, areas, inputs, warnings });
        }
        self.judge(if is_picture(path)? { Origin::Picture } else { Origin::Board })?;
        let loaded = if is_board(path) { input.load(settings)? } else { load_copper(path, Side::Front)? };
        Ok(of_board(loaded))
    }
}

/// How high capitals are unless that is said. Chosen.
const CAPITALS: Nm = Nm::from_mm(6);

/// What shapes are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Origin {
    Text,
    Drawing,
    Picture,
    Board,
}

fn read_text(path: &Path) -> Result<String, Failure> {
    let bytes = std::fs::read(path).map_err(|error| Failure::io("read", path, &error))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The programs of files, each with its name.
fn programs(paths: &[PathBuf]) -> Result<Vec<(String, String)>, Failure> {
    paths.iter().map(|path| Ok((name_of(path), read_text(path)?))).collect()
}

/// Those as they are judged.
fn borrowed(texts: &[(String, String)]) -> Vec<(&str, &str)> {
    texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect()
}

/// How many pixels a picture is wide. Chosen: fills a screen.
const WIDTH: u32 = 1600;

/// Writes a file for each tool, called as asked for but for its tag, and a picture.
fn write(
    mut staged: Output,
    output: &Path,
    picture: Option<(&Path, Vec<u8>)>,
    programs: &[OneTool],
) -> Result<(), Failure> {
    if let Some((path, bytes)) = &picture {
        staged.stage(path, bytes)?;
    }
    if output == Path::new("-") {
        let [one] = programs else {
            let cause = format!(
                "each of {} tools has a program of its own, but stdout takes only one",
                programs.len()
            );
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

/// What a person must know of programs that are there and not written again: one tool more or less,
/// and they have other names.
fn stale(output: &Path, programs: &[OneTool]) -> Option<Warning> {
    let ours: Vec<PathBuf> = programs.iter().map(|one| tagged(output, &one.tag)).collect();
    let tags =
        ["", "flat"].map(str::to_owned).into_iter().chain((1..=MOST_TOOLS).map(|number| number.to_string()));
    let others = tags.map(|tag| tagged(output, &tag)).filter(|path| !ours.contains(path) && path.is_file());
    let names: Vec<String> = others.map(|path| name_of(&path)).collect();
    let message = format!("not written by this run: {}; do not mill it with these", names.join(", "));
    (!names.is_empty()).then(|| planning::STALE_OUTPUT.warning(message))
}

/// Programs of so many tools are looked for. Chosen: more than anybody changes for a pocket.
const MOST_TOOLS: usize = 9;

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
    let words = words.replace("\\n", "\n");
    let areas = text(&bytes, &words, height).map_err(|error| {
        Failure::new(format!("{file}: {error}"), "choose another --font, --text or --height")
    })?;
    let inputs = vec![gcode::Input { file, design: import::sha256(&bytes) }];
    // It stands in comments and names no file.
    let name: String = words.chars().filter(char::is_ascii_alphanumeric).collect();
    let name = if name.is_empty() { "text".to_owned() } else { name };
    Ok(Art { name, areas, inputs, warnings: Vec::new() })
}

/// Whether a file is a picture.
fn is_picture(path: &Path) -> Result<bool, Failure> {
    if path.is_dir() {
        return Ok(false);
    }
    let bytes = std::fs::read(path).map_err(|error| Failure::io("read", path, &error))?;
    Ok(picture::is_picture(path, &bytes))
}

/// Kinds of files but drawings that say by themselves what they are; any other is one Gerber layer.
const BOARDS: [&str; 12] =
    ["zip", "kicad_pcb", "png", "jpg", "jpeg", "bmp", "gif", "tif", "tiff", "webp", "pnm", "pbm"];

/// Whether a file is one of these, or a folder of files.
fn is_board(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    path.is_dir() || ending.is_some_and(|ending| BOARDS.contains(&ending.as_str()))
}

/// The copper of the front as shapes, or that of the back where there is no other.
fn of_board(loaded: Loaded) -> Art {
    let copper = [&loaded.board.front, &loaded.board.back].into_iter().find_map(Option::as_ref);
    let areas = copper.map_or_else(Vec::new, areas);
    let inputs = loaded
        .sources
        .iter()
        .filter(|source| !source.role.starts_with("ignored"))
        .map(|source| gcode::Input { file: source.file.clone(), design: source.design.clone() });
    // What is said of boards and their outlines is of no use here; and what a solder mask calls
    // negative, what it draws, are its openings. Letters may be slanted.
    let is_of_use = |kind: &Diagnostic| {
        let of_boards = [diagnostic::NEGATIVE_FILE, diagnostic::COPPER_MISSING, diagnostic::PICTURE_SKEWED];
        !kind.is_of_the_outline() && !of_boards.contains(kind)
    };
    let warnings = loaded.warnings.into_iter().filter(|warning| is_of_use(warning.kind));
    Art { name: loaded.board.name, areas, inputs: inputs.collect(), warnings: warnings.collect() }
}

/// What a layer covers.
fn areas(copper: &Copper) -> Vec<Polygon> {
    let shape = |feature: &Feature| feature.shape.polygon(FLATTEN);
    let rings: Vec<_> =
        copper.features.iter().filter_map(shape).flat_map(|polygon| polygon.contours().to_vec()).collect();
    polarity::clean(&rings)
}

/// To a thousandth.
pub(super) fn rounded(number: f64) -> f64 {
    (number * 1_000.0).round() / 1_000.0
}
