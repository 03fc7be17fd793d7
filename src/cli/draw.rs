//! `voromill draw`: a picture of one stage, as PNG, SVG or in the terminal.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::{Args, ValueEnum};
use voromill::board::{Board, Copper, Side};
use voromill::geometry::{Nm, Point, Rect, Vector};
use voromill::grid::Grid;
use voromill::import::Loaded;
use voromill::job::{self, Job, Settings};
use voromill::report::document::WarningEntry;
use voromill::report::picture::{self, Depth, Ground, Shown, Toolpath};
use voromill::report::relief::Relief;
use voromill::report::svg::{self, Over};
use voromill::report::thinning::Thinning;
use voromill::report::translucent::Translucent;
use voromill::report::{self, Canvas, png, terminal};

use super::config::Config;
use super::input::Input;
use super::output::{Output, refuse_kind};
use super::{Failure, Shared, colour};

/// A picture of one stage
///
/// A pixel shows what lies at its centre; row 0 is on top; both sides are seen from the front.
/// `copper` is white on black and nothing between. The picture's pixel is that of --pixel or --dpi,
/// or 1000 to the inch. A name that ends in .svg gives lines and areas instead of pixels, and `-`
/// shows the picture in the terminal.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Draw {
    #[command(flatten)]
    input: Input,

    /// What to show
    #[arg(long, value_enum, default_value = "toolpath")]
    stage: Stage,

    /// Picture to write, PNG or SVG by its name; `-` for the terminal, or a PNG into a pipe
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,

    /// How it is written [default: as the name ends; in a terminal, blocks, or shades where it
    /// wants no colours]
    #[arg(long, value_enum)]
    format: Option<Format>,

    /// Which side, where there are two
    #[arg(long, value_enum)]
    side: Option<SideName>,

    /// Part of the board: left, bottom, width, height, such as `0mm,0mm,2in,1in` [default: all of
    /// it]
    #[arg(long, value_name = "X,Y,W,H", allow_hyphen_values = true)]
    window: Option<Window>,

    /// The picture from which the paper's own program takes its paths, and these: core axes as
    /// triangles of 16 sides, 500 DPI; --strategy outline for its outlines
    #[arg(long, conflicts_with_all = ["stage", "window"])]
    paper: bool,

    #[command(flatten)]
    config: Config,
}

const EXAMPLES: &str = "\
Examples:
  voromill draw board/ --stage voronoi -o regions.png
  voromill draw board-F_Cu.gbr --stage copper --dpi 500 -o copper.png
  voromill draw board/ -o front.svg
  voromill draw board/ -o -                    look at it here
  voromill draw board/ --stage milled -o milled.png   the board as it comes from the mill
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
    /// The boundaries by the room that they leave on either side: red where there is least, blue
    /// from a millimetre on
    Heat,
    /// How far from copper, dark to light: half as bright is a quarter as far
    Depth,
    /// What is cut, at its true width, and the way through the air
    Toolpath,
    /// The side as it comes from the mill, drilled and cut out, seen at a slant: what the programs
    /// mill, read back; the back as one sees it who has turned the board over
    Milled,
    /// The bare board worn away to lines by a cellular automaton, as Cisolate does: dark what goes
    /// first, blue and magenta where three and four lines meet; a picture by its own pixels
    Thinning,
}

/// A side, as the command line names it.
#[derive(Clone, Copy, ValueEnum)]
pub(super) enum SideName {
    Front,
    Back,
}

impl From<SideName> for Side {
    fn from(name: SideName) -> Self {
        match name {
            SideName::Front => Self::Front,
            SideName::Back => Self::Back,
        }
    }
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
    pub(super) fn run(self, shared: Shared) -> Result<(), Failure> {
        let settings = self.config.settings(&self.input, shared)?;
        let loaded = self.input.load(&settings)?;
        let settings = self.config.settings_for(&self.input, &loaded.board)?;
        let side = chosen_side(self.side, loaded.board.front.is_some(), loaded.board.back.is_some())?;
        if self.paper {
            self.config.judge_paper()?;
            if !matches!(self.format, None | Some(Format::Png)) {
                return Err(Failure::new("--paper draws a PNG", "leave --format out"));
            }
            self.input.tell(&loaded.warnings, shared)?;
            let canvas = job::paper_picture(&loaded.board, side, &settings)?;
            return self.write(&png::rgb(canvas.ok_or_else(|| no_copper(side))?));
        }
        let area = self.window.map(|Window(rect)| rect);
        let format = match self.format {
            Some(format) => format,
            None => Format::of(&self.output)?,
        };
        let rim = if self.stage.shows_frame()
            && settings.options().frame == Some(true)
            && loaded.board.outline.is_none()
        {
            settings.frame_margin
        } else {
            Nm::ZERO
        };
        let margin = match (format, self.stage) {
            (_, Stage::Milled) => rim + settings.cutout_tool.width_at(settings.thickness) + MARGIN,
            (Format::Svg, _) => MARGIN.max(rim),
            _ => rim + settings.picture_pixel() * 4,
        };
        let area = area.or_else(|| picture::whole(&loaded.board, margin));
        let area = area.ok_or_else(|| job::Error::NoCopper("to draw".to_owned()))?;
        let sampled =
            if self.stage == Stage::Copper { off_ties(area, settings.picture_pixel()) } else { area };
        let grid = format.grid(sampled, settings.picture_pixel())?;
        if self.stage == Stage::Thinning {
            self.input.tell(&loaded.warnings, shared)?;
            return self.thinning(shared, &settings, &loaded.board, side, (format, grid));
        }
        let read: Vec<WarningEntry> = loaded.warnings.iter().map(WarningEntry::from).collect();
        let mut loaded = loaded;
        match side {
            Side::Front => loaded.board.back = None,
            Side::Back => loaded.board.front = None,
        }
        let drawn = Drawn::new(self.stage, loaded, side, settings)?;
        let warnings = drawn.job.as_ref().map_or(read, |job| job.describe(&drawn.settings).warnings);
        self.input.judge(&warnings)?;
        let bytes = match format {
            Format::Png => drawn.png(grid)?,
            Format::Svg => drawn.svg(area)?.into_bytes(),
            Format::Blocks => terminal::half_blocks(drawn.canvas(grid)?).into_bytes(),
            Format::Shades => terminal::shades(drawn.canvas(grid)?).into_bytes(),
            Format::Sixel => terminal::sixels(drawn.canvas(grid)?).into_bytes(),
        };
        shared.say(&report::warnings(&warnings, shared.is_verbose()));
        self.write(&bytes)
    }

    fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        if self.output == Path::new("-") {
            return super::print_bytes(bytes);
        }
        let mut output = Output::new(self.input.sources());
        output.stage(&self.output, bytes)?;
        output.commit()
    }

    /// The side thinned; what it consists of is said.
    fn thinning(
        &self,
        shared: Shared,
        settings: &Settings,
        board: &Board,
        side: Side,
        (format, grid): (Format, Grid),
    ) -> Result<(), Failure> {
        let whole = format == Format::Png && self.window.is_none();
        let own = if whole { self.input.thinned(settings, side)? } else { None };
        let thinning = match own {
            Some(thinning) => thinning,
            None => {
                let copper = board.copper(side).ok_or_else(|| no_copper(side))?;
                Thinning::of_side(copper, &board.holes, grid)
            }
        };
        let bytes = match format {
            Format::Png => png::rgb(thinning.canvas()),
            Format::Svg => return Err(no_svg()),
            Format::Blocks => terminal::half_blocks(thinning.canvas()).into_bytes(),
            Format::Shades => terminal::shades(thinning.canvas()).into_bytes(),
            Format::Sixel => terminal::sixels(thinning.canvas()).into_bytes(),
        };
        shared.say(&format!("{}\n", thinning.counts()));
        self.write(&bytes)
    }
}

/// Stages that are pixels and nothing else.
fn no_svg() -> Failure {
    let hint = "choose --stage copper, nets, voronoi or toolpath, or name a .png";
    Failure::new("there is no SVG of this stage", hint)
}

/// The side that was asked for, or the only one, or the front.
pub(super) fn chosen_side(asked: Option<SideName>, front: bool, back: bool) -> Result<Side, Failure> {
    match (asked, front, back) {
        (Some(SideName::Front), true, _) | (None, true, _) => Ok(Side::Front),
        (Some(SideName::Back), _, true) | (None, false, true) => Ok(Side::Back),
        (Some(SideName::Front), false, _) => Err(no_copper(Side::Front).into()),
        (Some(SideName::Back), _, false) => Err(no_copper(Side::Back).into()),
        (None, false, false) => Err(job::Error::NoCopper("in these files".to_owned()).into()),
    }
}

/// The area a hair to the right and down: copper that ends exactly at the middle of a pixel, as on
/// boards drawn in mils it often does, then covers the pixel at its left and upper end and not that
/// at its right and lower one.
///
/// Half a step of the raster's fixed point, 24.8, so that what lies on a middle is never rounded
/// back to it.
fn off_ties(area: Rect, pixel: Nm) -> Rect {
    let hair = pixel / 512 + Nm::new(1);
    let way = Vector::new(hair, -hair);
    Rect::new(area.min() + way, area.max() + way)
}

fn no_copper(side: Side) -> job::Error {
    job::Error::NoCopper(format!("on the {side}"))
}

/// What lies round the board in a drawing for documents. Chosen: the cutout shows.
const MARGIN: Nm = Nm::from_um(1500);

/// How a picture is written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Pixels
    Png,
    /// Lines and areas: copper, nets, voronoi and toolpath
    Svg,
    /// Half blocks in 24-bit colour, for the terminal
    Blocks,
    /// Characters of five shades, for a terminal without colours
    Shades,
    /// Sixels, for terminals that show them
    Sixel,
}

/// Columns and lines of a terminal that does not say.
const TERMINAL: (u16, u16) = (100, 40);
/// The longer side of a picture in sixels. Chosen: it fits the terminals of today.
const SIXELS: i64 = 900;

impl Format {
    /// What a file's name asks for; in a terminal, what it can show.
    fn of(output: &Path) -> Result<Self, Failure> {
        if output == Path::new("-") && std::io::stdout().is_terminal() {
            return Ok(if colour::are_wanted() { Self::Blocks } else { Self::Shades });
        }
        let end = output.extension().and_then(|end| end.to_str()).map(str::to_ascii_lowercase);
        refuse_kind(output, "name the picture .png or .svg, or choose how it is written with --format")?;
        Ok(if end.as_deref() == Some("svg") { Self::Svg } else { Self::Png })
    }

    /// The pixels of a picture of `area`: of `pixel`, or as many as the terminal has room for.
    fn grid(self, area: Rect, pixel: Nm) -> Result<Grid, Failure> {
        let grid = match self {
            Self::Png => {
                Grid::covering(area, pixel).and_then(|grid| picture::within_reason(&grid).map(|()| grid))
            }
            Self::Svg => Grid::covering(area, area.width().max(area.height()).max(pixel)),
            Self::Sixel => picture::fit(area, pixel, SIXELS),
            Self::Blocks | Self::Shades => {
                let size = terminal_size::terminal_size().map(|(columns, lines)| (columns.0, lines.0));
                let (columns, lines) = size.unwrap_or(TERMINAL);
                // Two pixels a line, and two lines for what comes after.
                let rows = i64::from(lines.saturating_sub(2).max(1)) * 2;
                let columns = i64::from(columns.max(1));
                let fitting = (area.width().get() / columns).max(area.height().get() / rows) + 1;
                Grid::covering(area, pixel.max(Nm::new(fitting)))
            }
        };
        Ok(grid.map_err(job::Error::from)?)
    }
}

/// A stage with what it takes to draw it.
struct Drawn {
    stage: Stage,
    side: Side,
    /// The job; none for stages that come before it.
    job: Option<Job>,
    board: Board,
    settings: Settings,
}

impl Drawn {
    fn new(stage: Stage, loaded: Loaded, side: Side, settings: Settings) -> Result<Self, Failure> {
        loaded.board.copper(side).ok_or_else(|| no_copper(side))?;
        let board = loaded.board.clone();
        let early = matches!(stage, Stage::Copper | Stage::Translucent);
        let job = if early { None } else { Some(job::mill(loaded, &settings)?) };
        Ok(Self { stage, side, job, board, settings })
    }

    fn copper(&self) -> Result<&Copper, Failure> {
        Ok(self.board.copper(self.side).ok_or_else(|| no_copper(self.side))?)
    }

    fn shown(&self) -> Result<Shown<'_>, Failure> {
        Ok(self.job.as_ref().and_then(|job| job.shown(self.side)).ok_or_else(|| no_copper(self.side))?)
    }

    /// How far the pixels of `grid` are from copper.
    fn depth(&self, grid: &Grid) -> Result<Depth<impl Fn(&Grid) -> Vec<f32>>, Failure> {
        let Shown { regions, copper, nets, .. } = self.shown()?;
        Ok(Depth::new(regions.depths(copper, nets), grid))
    }

    /// What is milled in the area of `grid`.
    fn milled(&self, grid: &Grid) -> Result<Relief<impl Fn(&Grid) -> Vec<f32>>, Failure> {
        let job = self.job.as_ref().ok_or_else(|| no_copper(self.side))?;
        Ok(job.milled(self.side, (grid.rect(), grid.pitch()), &self.settings)?)
    }

    /// As a PNG, band by band.
    fn png(&self, grid: Grid) -> Result<Vec<u8>, Failure> {
        Ok(match self.stage {
            Stage::Copper => {
                let copper = self.copper()?;
                png::grey_bands(&grid, |band| picture::copper(copper, &band))
            }
            Stage::Depth => {
                let depth = self.depth(&grid)?;
                png::grey_bands(&grid, |band| depth.greys(&band))
            }
            Stage::Translucent => {
                let translucent = self.translucent(&grid)?;
                png::bands(&grid, |band| translucent.draw(band))
            }
            Stage::Milled => self.milled(&grid)?.png(),
            Stage::Nets
            | Stage::Voronoi
            | Stage::Boundaries
            | Stage::Heat
            | Stage::Toolpath
            | Stage::Thinning => {
                let shown = self.shown()?;
                let paint = self.stage.painter(&shown, &grid);
                png::bands(&grid, paint)
            }
        })
    }

    /// As pixels in colour.
    fn canvas(&self, grid: Grid) -> Result<Canvas, Failure> {
        Ok(match self.stage {
            Stage::Copper => Canvas::grey(grid, &picture::copper(self.copper()?, &grid)),
            Stage::Depth => Canvas::grey(grid, &self.depth(&grid)?.greys(&grid)),
            Stage::Translucent => self.translucent(&grid)?.draw(grid),
            Stage::Milled => {
                let milled = self.milled(&grid)?;
                milled.draw(*milled.grid())
            }
            Stage::Nets
            | Stage::Voronoi
            | Stage::Boundaries
            | Stage::Heat
            | Stage::Toolpath
            | Stage::Thinning => self.stage.painter(&self.shown()?, &grid)(grid),
        })
    }

    fn translucent(&self, grid: &Grid) -> Result<Translucent<'_>, Failure> {
        Ok(Translucent::new(self.copper()?, grid.pitch()).map_err(job::Error::from)?)
    }

    /// As lines and areas.
    fn svg(&self, area: Rect) -> Result<String, Failure> {
        let over = match self.stage {
            Stage::Nets => return Ok(svg::nets(&self.shown()?, area)),
            Stage::Translucent | Stage::Heat | Stage::Depth | Stage::Milled | Stage::Thinning => {
                return Err(no_svg());
            }
            Stage::Copper => Over::Nothing,
            Stage::Voronoi | Stage::Boundaries => Over::Boundaries,
            Stage::Toolpath => Over::Cuts,
        };
        match &self.job {
            Some(_) => Ok(svg::side(&self.shown()?, area, over)),
            None => Ok(svg::copper(&self.board, self.copper()?, area)),
        }
    }
}

impl Stage {
    /// Whether the frame cut round copper without an outline can be seen.
    const fn shows_frame(self) -> bool {
        match self {
            Self::Copper | Self::Nets | Self::Translucent | Self::Thinning => false,
            Self::Voronoi | Self::Boundaries | Self::Heat | Self::Depth | Self::Toolpath | Self::Milled => {
                true
            }
        }
    }

    /// What paints bands of a picture of `grid`.
    fn painter<'a>(self, shown: &'a Shown<'a>, grid: &Grid) -> Box<dyn Fn(Grid) -> Canvas + 'a> {
        match self {
            Self::Nets => Box::new(|band| picture::nets(shown.board, shown.copper, shown.nets, band)),
            Self::Voronoi => {
                let ground = Ground::new(shown, grid);
                Box::new(move |band| picture::voronoi(&ground, band))
            }
            Self::Boundaries => Box::new(|band| picture::boundaries(shown, band)),
            Self::Heat => Box::new(|band| picture::heat(shown, band)),
            Self::Toolpath
            | Self::Copper
            | Self::Translucent
            | Self::Depth
            | Self::Milled
            | Self::Thinning => {
                let toolpath = Toolpath::new(shown, grid, true);
                Box::new(move |band| toolpath.draw(band))
            }
        }
    }
}
