use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, ValueEnum};
use voromill::board::Side;
use voromill::geometry::{Nm, Point, Rect, Vector};
use voromill::grid::Grid;
use voromill::job::{self, Job};
use voromill::report::translucent::translucent;
use voromill::report::{picture, png};

use super::config::Config;
use super::input::Input;
use super::output::Output;
use super::{Failure, Shared};

/// A picture of one stage
///
/// A pixel shows what lies at its centre; row 0 is on top; both sides are seen from the front. `copper` is white on
/// black and nothing between. The picture's pixel is that of --pixel or --dpi, which also finds the boundaries.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Draw {
    #[command(flatten)]
    input: Input,

    /// What to show
    #[arg(long, value_enum, default_value = "toolpath")]
    stage: Stage,

    /// Picture to write, a PNG
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,

    /// Which side, where there are two
    #[arg(long, value_enum)]
    side: Option<SideName>,

    /// Part of the board: left, bottom, width, height, such as `0mm,0mm,2in,1in` [default: all of it]
    #[arg(long, value_name = "X,Y,W,H", allow_hyphen_values = true)]
    window: Option<Window>,

    #[command(flatten)]
    config: Config,
}

const EXAMPLES: &str = "\
Examples:
  voromill draw board/ --stage voronoi -o regions.png
  voromill draw board-F_Cu.gbr --stage copper --dpi 500 -o copper.png
  voromill draw board/ --stage toolpath --side back --window 10mm,5mm,20mm,15mm --pixel 10um -o detail.png";

/// A stage that can be looked at.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Stage {
    /// Where copper is, white on black
    Copper,
    /// A colour for each net
    Nets,
    /// The traces that shared vertices leave, translucent, and where overlaps were picked
    Translucent,
    /// Voronoi regions and their boundaries
    Voronoi,
    /// The boundaries alone, with the points where they meet
    Boundaries,
    /// The boundaries by the room that they leave on either side: red where there is least, blue from a millimetre on
    Heat,
    /// How far from copper, dark to light
    Depth,
    /// What is cut, at its true width, and the way through the air
    Toolpath,
}

/// A side, as the command line names it.
#[derive(Clone, Copy, ValueEnum)]
enum SideName {
    Front,
    Back,
}

/// A part of the board.
#[derive(Clone, Copy)]
struct Window(Rect);

impl FromStr for Window {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let lengths: Vec<Nm> = text
            .split(',')
            .map(|part| part.parse::<Nm>().map_err(|error| error.to_string()))
            .collect::<Result<_, _>>()?;
        let [x, y, width, height] = lengths[..] else {
            return Err("expected four lengths: left, bottom, width, height".to_owned());
        };
        if width <= Nm::ZERO || height <= Nm::ZERO {
            return Err("width and height must be more than zero".to_owned());
        }
        let min = Point::new(x, y);
        Ok(Self(Rect::new(min, min + Vector::new(width, height))))
    }
}

impl Draw {
    pub(super) fn run(self, _: Shared) -> Result<(), Failure> {
        let settings = self.config.settings(&self.input.paths)?;
        let loaded = self.input.load()?;
        let side = self.side(loaded.board.front.is_some(), loaded.board.back.is_some())?;
        let area = self.window.map(|Window(rect)| rect);
        let area = area.or_else(|| picture::whole(&loaded.board, settings.pixel * 4));
        let area = area.ok_or_else(|| job::Error::NoCopper("to draw".to_owned()))?;
        let grid = Grid::covering(area, settings.pixel).map_err(job::Error::from)?;
        picture::within_reason(&grid).map_err(job::Error::from)?;
        let mut loaded = loaded;
        match side {
            Side::Front => loaded.board.back = None,
            Side::Back => loaded.board.front = None,
        }
        let copper = loaded.board.copper(side).ok_or_else(|| no_copper(side))?;
        let bytes = match self.stage {
            Stage::Copper => png::grey(&grid, &picture::copper(copper, &grid)),
            Stage::Translucent => png::rgb(translucent(copper, &grid).map_err(job::Error::from)?),
            stage => stage.draw(&job::mill(loaded, &settings)?, side, grid)?,
        };
        let mut output = Output::new();
        output.stage(&self.output, &bytes)?;
        output.commit()
    }

    /// The side that was asked for, or the only one.
    fn side(&self, front: bool, back: bool) -> Result<Side, Failure> {
        match (self.side, front, back) {
            (Some(SideName::Front), true, _) | (None, true, false) => Ok(Side::Front),
            (Some(SideName::Back), _, true) | (None, false, true) => Ok(Side::Back),
            (None, true, true) => Ok(Side::Front),
            (Some(SideName::Front), false, _) => Err(no_copper(Side::Front).into()),
            (Some(SideName::Back), _, false) => Err(no_copper(Side::Back).into()),
            (None, false, false) => Err(job::Error::NoCopper("in these files".to_owned()).into()),
        }
    }
}

fn no_copper(side: Side) -> job::Error {
    job::Error::NoCopper(format!("on the {side}"))
}

impl Stage {
    fn draw(self, job: &Job, side: Side, grid: Grid) -> Result<Vec<u8>, Failure> {
        let shown = job.shown(side).ok_or_else(|| no_copper(side))?;
        Ok(match self {
            Self::Copper => png::grey(&grid, &picture::copper(shown.copper, &grid)),
            Self::Translucent => png::rgb(translucent(shown.copper, &grid).map_err(job::Error::from)?),
            Self::Nets => png::rgb(picture::nets(shown.board, shown.copper, shown.nets, grid)),
            Self::Voronoi => png::rgb(picture::voronoi(&shown, grid)),
            Self::Boundaries => png::rgb(picture::boundaries(&shown, grid)),
            Self::Heat => png::rgb(picture::heat(&shown, grid)),
            Self::Depth => png::grey(&grid, &picture::depth(shown.diagram, &grid)),
            Self::Toolpath => png::rgb(picture::toolpath(&shown, grid, true)),
        })
    }
}
