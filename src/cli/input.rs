//! The options that name input files and their roles, shared by all commands that read a board.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::{Args, ValueEnum};
use voromill::board::{Side, Source, Warning};
use voromill::geometry::{Nm, Point, Rect, Vector};
use voromill::grid::Grid;
use voromill::import::drawing::{self, Unit};
use voromill::import::picture::Pixels;
use voromill::import::{self, Loaded, Selection, diagnostic, picture};
use voromill::job::{self, Length, MillProject, ProjectFiles, Settings};
use voromill::report;
use voromill::report::document::WarningEntry;
use voromill::report::thinning::Thinning;

use super::given::length_if;
use super::{Failure, Shared};

/// What to read.
#[derive(Args, Default)]
pub(super) struct Input {
    /// A folder, a zip archive, the files themselves, a KiCad board (.kicad_pcb), a drawing (SVG,
    /// DXF) or a picture
    #[arg(required_unless_present_any = ["millproject", "front", "back"], value_name = "PATH")]
    pub(super) paths: Vec<PathBuf>,

    /// Take options and files over from a millproject of pcb2gcode; options given here win
    #[arg(long, value_name = "FILE")]
    pub(super) millproject: Option<PathBuf>,

    /// File with the front copper, if not known by its name
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub(super) front: Option<PathBuf>,

    /// File with the back copper, if not known by its name
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub(super) back: Option<PathBuf>,

    /// File with the outline of the board, if not known by its name
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub(super) outline: Option<PathBuf>,

    /// File with holes, if not known by its name; may be given several times
    #[arg(long = "drill", value_name = "FILE", help_heading = "Files")]
    pub(super) drill_files: Vec<PathBuf>,

    /// Ignore this file or folder, by name, or a layer of a KiCad board, such as F.Cu; may be given
    /// several times
    #[arg(long, value_name = "FILE", help_heading = "Files")]
    pub(super) skip: Vec<PathBuf>,

    /// Read no drill file: everything but the holes
    #[arg(long, conflicts_with = "drill_files", help_heading = "Files")]
    pub(super) no_drill: bool,

    /// Name of the board, and of its output files [default: from the files]
    #[arg(long, value_name = "NAME", help_heading = "Files")]
    pub(super) name: Option<String>,

    /// Resolution of a picture in pixels per inch, even if the file has another; --dpi is for files
    /// that have none
    #[arg(long, value_name = "NUMBER", value_parser = dpi, help_heading = "Pictures")]
    pub(super) picture_dpi: Option<f64>,

    /// Width of the whole picture, instead of --picture-dpi
    #[arg(
        long,
        value_name = "LENGTH",
        value_parser = width,
        conflicts_with = "picture_dpi",
        help_heading = "Pictures"
    )]
    pub(super) picture_width: Option<Length>,

    #[command(flatten)]
    pub(super) scan: Scan,

    /// Turn a scan back, by the directions of its edges; up to 15 degrees
    #[arg(long, help_heading = "Pictures")]
    pub(super) straighten: bool,

    /// Which part of a picture is copper [default: the rarer]
    #[arg(long, value_enum, value_name = "COLOUR", help_heading = "Pictures")]
    pub(super) copper: Option<Colour>,

    /// Swap copper and bare board of a picture
    #[arg(long, help_heading = "Pictures")]
    pub(super) invert: bool,

    /// Length of one unit of a drawing (SVG, DXF), even if the file has another: mm, in, 0.1mm, or
    /// 90dpi for 1/90 inch
    #[arg(long, value_name = "UNIT", help_heading = "Drawings")]
    pub(super) unit: Option<Unit>,

    /// Font file for the texts of an SVG; may be given several times
    #[arg(long = "font", value_name = "FILE", help_heading = "Drawings")]
    pub(super) fonts: Vec<PathBuf>,

    /// Fail and write nothing if there is any warning; for CI
    #[arg(long, help_heading = "Output")]
    pub(super) deny_warnings: bool,

    /// The names of the files that were read.
    #[arg(skip)]
    pub(super) read: RefCell<BTreeSet<String>>,
}

/// What pictures of paper need, whatever is made of them.
#[derive(Args, Clone, Copy, Default)]
pub(super) struct Scan {
    /// Distance of neighbouring pins, such as 2.54mm, instead of --picture-dpi: the resolution is
    /// found by the grid of the drill dots
    #[arg(
        long,
        value_name = "LENGTH",
        value_parser = pitch,
        conflicts_with_all = ["picture_dpi", "picture_width"],
        help_heading = "Pictures"
    )]
    pub(super) picture_pitch: Option<Length>,

    /// Remove specks and holes of a picture that are smaller than this, in square millimetres; for
    /// scans
    #[arg(long, value_name = "MM2", value_parser = area, help_heading = "Pictures")]
    pub(super) despeckle: Option<f64>,

    /// Read a part of a picture: left, top, width and height in pixels
    #[arg(long, value_name = "X,Y,W,H", value_parser = pixels, help_heading = "Pictures")]
    pub(super) crop: Option<[u32; 4]>,
}

/// Which part of a picture is copper.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Colour {
    Dark,
    Light,
}

pub(super) fn dpi(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| (10.0..=30_000.0).contains(number));
    number.ok_or_else(|| "expected from 10 to 30000 pixels per inch".to_owned())
}

fn pitch(text: &str) -> Result<Length, String> {
    length_in(text, Nm::from_um(100)..=Nm::from_mm(100), "expected from 0.1mm to 100mm, such as 2.54mm")
}

fn width(text: &str) -> Result<Length, String> {
    length_in(text, Nm::from_mm(1)..=Nm::from_mm(1000), "expected from 1mm to 1000mm, such as 80mm")
}

fn length_in(text: &str, range: RangeInclusive<Nm>, expected: &str) -> Result<Length, String> {
    length_if(text, |length| range.contains(&length), expected).map(Length)
}

fn area(text: &str) -> Result<f64, String> {
    let number = text.trim_end_matches("mm2").trim().parse::<f64>();
    let number = number.ok().filter(|number| (0.0..=1000.0).contains(number));
    number.ok_or_else(|| "expected an area in square millimetres, such as 0.05".to_owned())
}

fn pixels(text: &str) -> Result<[u32; 4], String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let numbers = numbers.ok().and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| "expected four numbers of pixels: left, top, width, height".to_owned())
}

impl Input {
    /// The board to be milled: without copper it is none.
    pub(super) fn load(&self, settings: &Settings) -> Result<Loaded, Failure> {
        self.read(settings, import::load)
    }

    /// The board to be looked at, which may be a drill file or an outline alone.
    pub(super) fn survey(&self, settings: &Settings) -> Result<Loaded, Failure> {
        self.read(settings, import::survey)
    }

    /// Fails for `warnings` where they are denied.
    pub(super) fn judge(&self, warnings: &[WarningEntry]) -> Result<(), Failure> {
        let warnings: Vec<_> = warnings.iter().filter(|warning| !warning.kind.is_bookkeeping()).collect();
        if !self.deny_warnings || warnings.is_empty() {
            return Ok(());
        }
        let shown: String = warnings.iter().map(|warning| warning.to_text()).collect();
        let all = shown.trim_end();
        let cause = format!("--deny-warnings is set, and there are {}:\n{all}", warnings.len());
        Err(Failure::new(cause, "repair the files, or leave --deny-warnings out"))
    }

    /// Fails where warnings are denied, and else says what was found in the files.
    pub(super) fn tell(&self, warnings: &[Warning], shared: Shared) -> Result<(), Failure> {
        let warnings: Vec<WarningEntry> = warnings.iter().map(WarningEntry::from).collect();
        self.judge(&warnings)?;
        shared.say(&report::warnings(&warnings, shared.is_verbose()));
        Ok(())
    }

    /// What to read: what is named here, by itself or by what it is, or else the files of the
    /// millproject.
    pub(super) fn paths(&self) -> Vec<PathBuf> {
        if !self.paths.is_empty() {
            return self.paths.clone();
        }
        if self.millproject.is_none() {
            let layers = [&self.front, &self.back, &self.outline].into_iter().flatten();
            return layers.chain(&self.drill_files).cloned().collect();
        }
        let ProjectFiles { front, back, outline, drill } = self.project().unwrap_or_default().files;
        [front, back, outline, drill].into_iter().flatten().collect()
    }

    /// The files that were read.
    pub(super) fn sources(&self) -> Vec<PathBuf> {
        let layers = [&self.front, &self.back, &self.outline].into_iter().flatten();
        let others = layers.chain(&self.drill_files).chain(&self.millproject).chain(&self.fonts);
        let read = self.read.borrow();
        let mut files = Vec::new();
        for path in self.paths().into_iter().chain(others.cloned()) {
            if path.is_dir() {
                add_below(&path, &read, DEEPEST, &mut files);
            } else {
                files.push(drawing::file_of(&path));
            }
        }
        files
    }

    /// What the millproject says, its files as seen from here; nothing where none is named.
    pub(super) fn project(&self) -> Result<MillProject, Failure> {
        let Some(path) = &self.millproject else { return Ok(MillProject::default()) };
        let text = std::fs::read_to_string(path).map_err(|error| Failure::io("read", path, &error))?;
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let folder = path.with_file_name("");
        let mut project = MillProject::read(&name, &text)?.with_own_code(&name, &folder)?;
        let ProjectFiles { front, back, outline, drill } = &mut project.files;
        for file in [front, back, outline, drill, &mut project.output].into_iter().flatten() {
            *file = folder.join(&*file);
        }
        Ok(project)
    }

    fn picture(&self, settings: &Settings) -> picture::Options {
        picture::Options {
            dpi: self.picture_dpi,
            dpi_unless_said: settings.options().dpi.map(f64::from),
            width: self.picture_width.map(Length::nm),
            pitch: self.scan.picture_pitch.map(Length::nm),
            straighten: self.straighten,
            colour: match self.copper {
                None => picture::Colour::Rarer,
                Some(Colour::Dark) => picture::Colour::Dark,
                Some(Colour::Light) => picture::Colour::Light,
            },
            invert: self.invert,
            despeckle: self.scan.despeckle.unwrap_or(0.0),
            crop: self.scan.crop,
            most_pixels: None,
        }
    }

    /// The pixels of the picture that shows `side`; none where it is no picture, or is to be
    /// turned.
    fn pixels(&self, settings: &Settings, side: Side) -> Result<Option<Pixels>, Failure> {
        let named = match side {
            Side::Front => self.front.as_ref().or(self.paths.first()),
            Side::Back => self.back.as_ref(),
        };
        let Some(path) = named.filter(|path| path.is_file() && !self.straighten) else { return Ok(None) };
        let bytes = std::fs::read(path).map_err(|error| Failure::io("read", path, &error))?;
        if !picture::is_picture(path, &bytes) {
            return Ok(None);
        }
        let shown = path.display().to_string();
        Ok(Some(picture::pixels(&shown, &bytes, &self.picture(settings))?))
    }

    /// The picture that shows `side`, thinned by its own pixels; none where it is no picture, or is
    /// to be turned.
    pub(super) fn thinned(&self, settings: &Settings, side: Side) -> Result<Option<Thinning>, Failure> {
        let Some(picture) = self.pixels(settings, side)? else { return Ok(None) };
        let count = |pixels: usize| i64::try_from(pixels).unwrap_or(i64::MAX);
        let [width, height] = [picture.width, picture.height].map(|pixels| picture.pixel * count(pixels));
        let area = Rect::new(Point::default(), Point::default() + Vector::new(width, height));
        let grid = Grid::covering(area, picture.pixel).map_err(job::Error::from)?;
        Ok(Some(Thinning::of_pixels(grid, |at| !picture.is_copper[at])))
    }

    /// The same, where the picture lies on the board as it is: none that was moved onto another.
    pub(super) fn thinned_as_it_lies(
        &self,
        settings: &Settings,
        side: Side,
        loaded: &Loaded,
    ) -> Result<Option<Thinning>, Failure> {
        let moved = |warning: &Warning| warning.is(&diagnostic::PICTURES_REGISTERED);
        if side == Side::Back && loaded.warnings.iter().any(moved) {
            return Ok(None);
        }
        self.thinned(settings, side)
    }

    /// What is said of drawings.
    pub(super) fn drawing(&self) -> Result<drawing::Options, Failure> {
        let read = |path: &PathBuf| match std::fs::read(path) {
            Ok(bytes) => Ok(Arc::new(bytes)),
            Err(error) => Err(Failure::io("read", path, &error)),
        };
        Ok(drawing::Options {
            unit: self.unit,
            fonts: self.fonts.iter().map(read).collect::<Result<_, _>>()?,
        })
    }

    fn read(
        &self,
        settings: &Settings,
        read: fn(&[PathBuf], &Selection) -> Result<Loaded, import::Error>,
    ) -> Result<Loaded, Failure> {
        let project = self.project()?;
        // With files named here, those of the project are of another board.
        let files = if self.paths.is_empty() { project.files } else { ProjectFiles::default() };
        let drill = if self.no_drill {
            Vec::new()
        } else if self.drill_files.is_empty() {
            files.drill.into_iter().collect()
        } else {
            self.drill_files.clone()
        };
        let selection = Selection {
            front: self.front.clone().or(files.front),
            back: self.back.clone().or(files.back),
            outline: self.outline.clone().or(files.outline),
            drill,
            skip: self.skip.clone(),
            no_drill: self.no_drill,
            name: self.name.clone().or(project.name),
            outline_gap: Some(settings.outline_gap),
            picture: self.picture(settings),
            drawing: self.drawing()?,
        };
        let paths = self.paths();
        if paths.is_empty() {
            let hint = "give files, a folder or an archive, or set `front` and `back` in the project";
            return Err(Failure::new("the millproject gives no file of a board", hint));
        }
        let mut loaded = read(&paths, &selection)?;
        loaded.warnings.extend(project.left);
        self.judge_idle(&loaded.sources)?;
        self.read.borrow_mut().extend(loaded.sources.iter().map(|source| source.file.clone()));
        Ok(loaded)
    }

    /// Fails for an option of pictures or drawings where none was read.
    fn judge_idle(&self, sources: &[Source]) -> Result<(), Failure> {
        let is_any = |formats: &[&str]| {
            sources.iter().any(|source| formats.iter().any(|format| source.format.starts_with(format)))
        };
        let pictures = [
            ("--picture-dpi", self.picture_dpi.is_some()),
            ("--picture-width", self.picture_width.is_some()),
            ("--picture-pitch", self.scan.picture_pitch.is_some()),
            ("--straighten", self.straighten),
            ("--copper", self.copper.is_some()),
            ("--invert", self.invert),
            ("--despeckle", self.scan.despeckle.is_some()),
            ("--crop", self.scan.crop.is_some()),
        ];
        let drawings = [("--unit", self.unit.is_some()), ("--font", !self.fonts.is_empty())];
        let kinds = [
            ("pictures", &pictures[..], is_any(&["picture"])),
            ("drawings", &drawings, is_any(&["svg", "dxf"])),
        ];
        for (what, options, _) in kinds.into_iter().filter(|(.., is_read)| !is_read) {
            if let Some((option, _)) = options.iter().find(|(_, is_given)| *is_given) {
                let hint = format!("leave it out: it is for {what}");
                return Err(Failure::new(format!("{option} has no effect on these files"), hint));
            }
        }
        Ok(())
    }
}

/// Folders within folders are looked into so far. Chosen: no board lies deeper.
const DEEPEST: u32 = 8;

/// Adds the files with such names in a folder, and in those inside it.
fn add_below(folder: &Path, names: &BTreeSet<String>, deepest: u32, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() && deepest > 0 {
            add_below(&path, names, deepest - 1, files);
        } else if names.contains(&*entry.file_name().to_string_lossy()) {
            files.push(path);
        }
    }
}
