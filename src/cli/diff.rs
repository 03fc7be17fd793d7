//! `voromill diff`: what copper changes between two programs or two folders of them.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use voromill::geometry::Nm;
use voromill::report::comparison::{Compared, picture, to_json};
use voromill::report::png;
use voromill::verify::{self, Comparison, Cutter, Program, diff};

use super::format::Format;
use super::output::{Output, name_of, refuse_kind};
use super::program_files::{programs, without_programs};
use super::{Failure, Shared};

/// What copper changes between two programs, not which lines
///
/// Mills both and compares: how much more is cut away, how much less, what is cut deeper and less
/// deep, and where. For reviewing G-code. Programs in two folders are compared by name; what is in
/// one folder alone is all of it a difference. Exit code 0: the same copper, cut as deep; 1: not
/// the same; 2: it could not be compared.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Diff {
    /// A program, or a folder of programs
    #[arg(value_name = "A")]
    before: PathBuf,

    /// What it is compared with: a program, or a folder
    #[arg(value_name = "B")]
    after: PathBuf,

    /// A PNG picture of the differences; of two folders a folder for them
    #[arg(long, short, value_name = "OUT")]
    output: Option<PathBuf>,

    /// The tool, such as `vbit:0.1mm:30deg` or `endmill:0.2mm` [default: from the programs'
    /// comments]
    #[arg(long, value_name = "TOOL")]
    tool: Option<Cutter>,

    /// How far cuts may differ unnoticed, sideways and in depth
    #[arg(long, value_name = "LENGTH", default_value = "0.005mm")]
    tolerance: Nm,

    /// How thick the copper is: cuts less deep leave it
    #[arg(long, value_name = "LENGTH", default_value = "0.035mm")]
    copper: Nm,

    /// The pixel in which differences are gathered; narrower ones count by their area [default: a
    /// quarter of the kerf, within 5um to 25um]
    #[arg(long = "pixel", alias = "resolution", value_name = "LENGTH")]
    resolution: Option<Nm>,

    /// For people or for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  voromill diff old/board-front.ngc new/board-front.ngc -o diff.png
  voromill diff out-main/ out-branch/ -o pictures/
  voromill diff a.nc b.nc --tool endmill:0.2mm --format json";

/// Files of the same name, either of which may be missing.
type Pair = (String, Option<PathBuf>, Option<PathBuf>);

impl Diff {
    pub(super) fn run(self, shared: Shared) -> Result<ExitCode, Failure> {
        let settings =
            verify::Settings { copper: self.copper, pixel: self.resolution, ..verify::Settings::default() };
        let mut found: Vec<(String, Comparison)> = Vec::new();
        for (name, before, after) in self.pairs()? {
            let [before, after] = [before, after].map(|path| self.program(path.as_deref()));
            found.push((name, diff(&before?, &after?, self.tolerance, &settings)?));
        }
        if let Some(output) = &self.output {
            self.draw(output, &found)?;
        }
        let compared: Vec<Compared> =
            found.iter().map(|(name, comparison)| Compared::new(name, comparison)).collect();
        match self.format {
            Format::Text => {
                let text: String =
                    compared.iter().map(|compared| compared.to_text(shared.is_verbose())).collect();
                shared.report(&text)
            }
            Format::Json => super::print(&to_json(&compared)),
        }?;
        let same = compared.iter().all(Compared::is_same);
        Ok(if same { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    /// What is compared with what, by name.
    fn pairs(&self) -> Result<Vec<Pair>, Failure> {
        let (before, after) = (&self.before, &self.after);
        if before.is_dir() != after.is_dir() {
            let (folder, file) = if before.is_dir() { (before, after) } else { (after, before) };
            let cause = format!("{} is a folder and {} is not", folder.display(), file.display());
            return Err(Failure::new(cause, "name two programs, or two folders"));
        }
        if !before.is_dir() {
            return Ok(vec![(name_of(after), Some(before.clone()), Some(after.clone()))]);
        }
        let [old, new] = [names(before)?, names(after)?];
        let all: BTreeSet<&OsString> = old.union(&new).collect();
        if all.is_empty() {
            return Err(without_programs(&[before, after]));
        }
        let path = |folder: &Path, names: &BTreeSet<OsString>, name: &OsString| {
            names.contains(name).then(|| folder.join(name))
        };
        let pair = |name: &OsString| {
            (name.to_string_lossy().into_owned(), path(before, &old, name), path(after, &new, name))
        };
        Ok(all.into_iter().map(pair).collect())
    }

    /// A program; without a file, one that cuts nothing.
    fn program(&self, path: Option<&Path>) -> Result<Program, Failure> {
        let Some(path) = path else { return Ok(Program::default()) };
        let bytes = std::fs::read(path).map_err(|error| Failure::io("read", path, &error))?;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        Ok(Program { file: path.display().to_string(), text, cutter: self.tool, ..Program::default() })
    }

    fn draw(&self, output: &Path, found: &[(String, Comparison)]) -> Result<(), Failure> {
        let mut files = Output::new([self.before.clone(), self.after.clone()]);
        let folder = self.before.is_dir();
        if folder {
            files.make_folder(output)?;
        } else {
            refuse_kind(output, "name the picture .png")?;
        }
        for (name, comparison) in found.iter().filter(|(_, comparison)| !folder || !comparison.is_same()) {
            let canvas = picture(comparison)?;
            let path = if folder { output.join(format!("{name}.png")) } else { output.to_path_buf() };
            files.stage(&path, &png::rgb(canvas))?;
        }
        files.commit()
    }
}

/// The names of the programs in a folder.
fn names(folder: &Path) -> Result<BTreeSet<OsString>, Failure> {
    Ok(programs(folder)?.iter().filter_map(|path| path.file_name()).map(OsString::from).collect())
}
