//! `voromill mask`: a side as ink on a page of its true size.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::{Args, ValueEnum};
use voromill::board::Side;
use voromill::geometry::Nm;
use voromill::job::{self, Length, Masking, Settings};
use voromill::report::document::WarningEntry;
use voromill::report::mask::{self, Placing, Sheet, What};
use voromill::{job::mask as make, report};

use super::config::Config;
use super::draw::{SideName, chosen_side};
use super::input::Input;
use super::output::Output;
use super::{Failure, Shared};

/// A mask for etching, lasers, UV light or a photoplotter
///
/// Ink is black, on a page of the true size: PNG (one bit a pixel), SVG, PDF or Gerber, by the
/// name's end. The page is the board, or the copper of both sides, and --margin. PNG, SVG and PDF
/// show the side as one looks at it, so the back is mirrored. A film that lies with its ink on the
/// copper, and toner that is ironed on, want --mirror. Gerber is mirrored where that is asked for
/// alone.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Mask {
    #[command(flatten)]
    input: Input,

    /// Mask to write: .png, .svg, .pdf or .gbr
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,

    /// What is inked
    #[arg(long, value_enum, default_value = "copper", help_heading = "Mask")]
    what: Kind,

    /// Which side, where there are two
    #[arg(long, value_enum, help_heading = "Mask")]
    side: Option<SideName>,

    /// How far regions are apart [default: 0.2mm]
    #[arg(long, value_name = "LENGTH", help_heading = "Mask")]
    gap: Option<Length>,

    /// How much larger openings are than pads, on every side [default: 0.05mm]
    #[arg(long, value_name = "LENGTH", help_heading = "Mask")]
    clearance: Option<Length>,

    /// How far the page reaches beyond the board
    #[arg(long, value_name = "LENGTH", default_value = "0mm", help_heading = "Mask")]
    margin: Length,

    /// Invert: ink what is otherwise left bare
    #[arg(long, help_heading = "Mask")]
    negative: bool,

    /// Mirror left to right
    #[arg(long, help_heading = "Mask")]
    mirror: bool,

    /// How much larger than true, in x and y: what a printer shrinks
    #[arg(long, value_name = "X,Y", default_value = "1", help_heading = "Mask")]
    scale: Scale,

    /// Pixels to the inch of a PNG [default: 1200]
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(10..=25_400), help_heading = "Mask")]
    dpi: Option<u32>,

    /// Settings file [default: voromill.toml beside the board or else here, if there]
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  voromill mask board/ -o front.png --dpi 2400       the copper, black on white
  voromill mask board/ -o back.pdf --side back --mirror  to be ironed on
  voromill mask board/ -o front.svg --what regions --gap 0.2mm  as much copper as can stay
  voromill mask board/ -o film.png --negative --margin 5mm --scale 1.002,0.998
  voromill mask board/ -o front.gbr --what regions   with the names of the nets
  voromill mask board/ -o openings.pdf --what mask --clearance 0.1mm";

/// How far regions are apart unless told. Chosen: what home etching parts without fail.
const GAP: Nm = Nm::from_um(200);
/// How much larger openings are unless told. Chosen: what board houses ask for.
const CLEARANCE: Nm = Nm::from_um(50);

/// What is inked.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// The copper as the files have it
    Copper,
    /// All but a gap along the boundaries between nets: the widest traces, the least to etch
    Regions,
    /// Openings of a solder mask: the pads, by --clearance larger
    Mask,
}

/// How a mask is written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Png,
    Svg,
    Pdf,
    Gerber,
}

impl Format {
    fn of(output: &Path) -> Result<Self, Failure> {
        let end = output.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        Ok(match end.as_str() {
            "png" => Self::Png,
            "svg" => Self::Svg,
            "pdf" => Self::Pdf,
            "gbr" | "ger" => Self::Gerber,
            _ => {
                let cause = format!("the format of {} is unknown", output.display());
                return Err(Failure::new(cause, "let its name end in .png, .svg, .pdf or .gbr"));
            }
        })
    }
}

/// How much larger than true, in x and in y.
#[derive(Clone, Copy)]
struct Scale(f64, f64);

impl FromStr for Scale {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let number = |text: &str| {
            let number = text.trim().parse::<f64>().ok().filter(|number| (0.5..=2.0).contains(number));
            number.ok_or_else(|| format!("`{text}` is not a scale: expected from 0.5 to 2, such as 1.002"))
        };
        match text.split_once(',') {
            Some((x, y)) => Ok(Self(number(x)?, number(y)?)),
            None => number(text).map(|both| Self(both, both)),
        }
    }
}

impl Mask {
    pub(super) fn run(self, shared: Shared) -> Result<(), Failure> {
        let format = Format::of(&self.output)?;
        self.judge(format)?;
        let settings = self.settings()?;
        let loaded = self.input.load(&settings)?;
        let board = &loaded.board;
        let side = chosen_side(self.side, board.front.is_some(), board.back.is_some())?;
        let (sheet, found) = make(&loaded, &settings, &self.masking(side))?;
        let warnings: Vec<WarningEntry> =
            loaded.warnings.iter().chain(&found).map(WarningEntry::from).collect();
        self.input.judge(&warnings)?;
        let seen_from_behind = side == Side::Back && format != Format::Gerber;
        let placing =
            Placing { mirrored: self.mirror != seen_from_behind, scale: (self.scale.0, self.scale.1) };
        let sheet = placing.place(sheet);
        let mut line = format!(
            "{}: {}, {:.3} × {:.3} mm",
            self.output.display(),
            sheet.describe(),
            sheet.area.width(),
            sheet.area.height()
        );
        let bytes = match format {
            Format::Svg => mask::drawing(&sheet).into_bytes(),
            Format::Pdf => mask::page(&sheet),
            Format::Gerber => mask::film(&sheet).into_bytes(),
            Format::Png => self.png(sheet, &mut line)?,
        };
        if placing.mirrored {
            line.push_str(", mirrored");
        }
        shared.say(&report::warnings(&warnings, shared.is_verbose()));
        let mut output = Output::new(self.input.sources());
        output.stage(&self.output, &bytes)?;
        output.commit()?;
        shared.report(&format!("{line}\n"))
    }

    fn png(&self, sheet: Sheet, line: &mut String) -> Result<Vec<u8>, Failure> {
        let dpi = self.dpi.unwrap_or(1200);
        let (width, height) = mask::bitmap_size(&sheet, dpi).map_err(job::Error::from)?;
        line.push_str(&format!(", {width} × {height} pixels at {dpi} DPI"));
        Ok(mask::bitmap(sheet, dpi).map_err(job::Error::from)?)
    }

    /// What the settings file and a millproject say of reading.
    fn settings(&self) -> Result<Settings, Failure> {
        let from_file = Config::found(self.config.as_deref(), &self.input.paths())?;
        let project = self.input.project()?;
        let settings = Settings::resolve(project.options.clone().or(from_file));
        Ok(settings.map_err(|error| project.explain(error))?)
    }

    fn masking(&self, side: Side) -> Masking {
        let or = |length: Option<Length>, unasked: Nm| length.map_or(unasked, Length::nm);
        let what = match self.what {
            Kind::Copper => What::Copper,
            Kind::Regions => What::Regions,
            Kind::Mask => What::Openings,
        };
        Masking {
            side,
            what,
            gap: or(self.gap, GAP),
            clearance: or(self.clearance, CLEARANCE),
            margin: self.margin.nm(),
            negative: self.negative,
        }
    }

    /// Fails for an option that changes nothing of what is made.
    fn judge(&self, format: Format) -> Result<(), Failure> {
        let without_effect = [
            ("dpi", self.dpi.is_some() && format != Format::Png, "without pixels"),
            ("gap", self.gap.is_some() && self.what != Kind::Regions, "that has no regions"),
            ("clearance", self.clearance.is_some() && self.what != Kind::Mask, "that has no openings"),
        ];
        if let Some((option, _, what)) = without_effect.into_iter().find(|(_, has_none, _)| *has_none) {
            return Err(Failure::new(format!("--{option} has no effect on a mask {what}"), "leave it out"));
        }
        Ok(())
    }
}
