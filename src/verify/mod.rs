//! Programs milled before anybody mills them: text and a board → a [`Report`].
//!
//! The text is read back by [`gcode::read`](mod@crate::gcode::read), laid over the board, and the
//! cutter that it moves is drawn on a picture of the copper. What is left conducts: its pieces are
//! found as connected pixels, and compared with the nets of the design. How much copper the cutter
//! takes is asked of the exact geometry instead, so that it does not depend on the pixel. Neither
//! the planner nor the diagram is used, so that agreement says something, and any program can be
//! judged.
//!
//! ```text
//!   ▒▒▒▒▒▒░░░░▒▒▒▒▒    ▒ net   ░ clad that stays   · cut
//!   ▒▒▒▒··░░░░··▒▒▒    Two nets in one connected piece of what is not cut: a short.
//!   ▒▒··▒▒▒▒▒▒▒▒··▒    One net in two pieces: an open.  Net under the cut: a gouge.
//! ```
//!
//! What is left is asked in four ways, since none of them alone is both certain and quick:
//!
//! | how | says | because |
//! |---|---|---|
//! | runs of pixels (`milled`, of `spans` joined by `pieces`), kerfs narrower than they are | what holds one net alone | a strip left between kerfs shows, however thin; memory follows regions |
//! | runs with kerfs wider (`parting`, of one net and what it was before; `crowd`, of all) | what hangs together | what shows is left, however coarse the pixel |
//! | polygons (`exact`) | the rest, where not too many cuts cross | both pictures leave a doubt at any pixel |
//! | distances from the engine (`flood`) | where the narrowest place of what is joined lies | a run knows no distance; no verdict depends on it |
//!
//! How wide something is there is measured along a line through the exact shapes (`ruling`, for
//! `width` and `loss`), of which the runs are the crossings with rows of pixels. `remains` puts the
//! question to one after the other. The edge of the board (`contours`) is another matter: it is cut
//! at depths, and looked at in spots along it.
//!
//! Checks are listed in [`check::ALL`], a file each.

mod asked;
mod border;
mod bores;
mod boxes;
pub mod carving;
pub mod check;
mod cleared;
mod contours;
mod crowd;
mod cut;
mod cutter;
mod declared;
mod diff;
mod drilled;
mod edges;
mod exact;
mod flood;
mod followed;
mod hit;
mod interior;
mod levelled;
mod loss;
mod machining;
mod milled;
mod outcome;
mod parting;
mod pieces;
mod placement;
pub mod pocketing;
mod region;
mod register;
mod remains;
mod report;
mod rest;
mod ruling;
mod runs;
mod sheet;
mod spans;
mod stream;
mod surface;
mod sweep;
mod tiles;
mod walls;
mod width;

use std::fmt;

use rayon::prelude::*;

use crate::board::{Board, Side, Words};
use crate::gcode::ReadError;
use crate::geometry::{Nm, Point, Rect, Vector};
use crate::grid::GridError;
use crate::topology::Nets;

pub use crate::board::Severity;
pub use asked::Asked;
pub use contours::THINNEST_TAB;
pub use cutter::{Cutter, CutterKind, ParseCutterError};
pub use declared::{declared_list, declared_setting, is_isolation, is_probe};
pub use diff::{Change, Comparison, Region, Spot, diff};
pub use placement::Placement;
pub use register::{Orientation, register};
pub use report::{Finding, Judged, Report};
pub use surface::Surface;
pub use tiles::Tiles;

use bores::Bores;
use contours::Contours;
use declared::Declared;
use drilled::Drilled;
use machining::Machining;
use outcome::Outcome;
use sheet::Sheet;

/// What a program is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// Isolates the nets of a side.
    Isolation(Side),
    /// Drills.
    Drilling,
    /// Cuts the board out.
    Cutout,
    /// Drills the holes on whose pins the board is flipped.
    Alignment,
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Isolation(side) => write!(f, "{side} isolation"),
            Self::Drilling => f.write_str("drilling"),
            Self::Cutout => f.write_str("cutout"),
            Self::Alignment => f.write_str("alignment"),
        }
    }
}

/// A program to be judged, with what is known of it beside its text.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Its name.
    pub file: String,
    /// Its text.
    pub text: String,
    /// What it is for; else what its title says, or what its motions look like.
    pub role: Option<Role>,
    /// The tool; else those that its comments name.
    pub cutter: Option<Cutter>,
    /// How the board lies; else as its comments say.
    pub placement: Option<Placement>,
    /// What it was asked to clear; else what its comments say.
    pub asked: Option<Asked>,
    /// The [dialect](crate::gcode::dialect::ALL) of the machine that is to run it; else what its
    /// comments say.
    pub dialect: Option<String>,
    /// Whether each character of its text is one byte of its file, as of one that is no UTF-8.
    pub is_bytes: bool,
}

/// What is given of how the board lies in a program, in place of what its comments say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Laid {
    /// How far the board was turned, counter-clockwise in degrees.
    pub degrees: Option<f64>,
    /// What was added to its coordinates then.
    pub shift: Option<Vector>,
    /// The x about which it was mirrored at last; of no matter for a program that says it was not.
    pub mirror: Option<Nm>,
}

impl Laid {
    /// How `board` lies in `program`: as its comments say, but for what is given.
    #[must_use]
    pub fn of(&self, program: &Program, board: &Board) -> Placement {
        machining::laid(&Declared::read(&program.text), board, self)
    }
}

/// A file of the board that programs are judged by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// Its name without its folder.
    pub file: String,
    /// The hash of what was read from it, as headers of programs have its beginning.
    pub design: String,
}

/// What says of `programs` that they were made from other files than `inputs`; nothing for programs
/// that do not tell.
#[must_use]
pub fn revisions(programs: &[Program], inputs: &[Input]) -> Vec<Finding> {
    programs.iter().flat_map(|program| check::inputs(program, inputs)).collect()
}

/// What in `programs` spans more than the machine can travel; of nothing else they are judged.
///
/// # Errors
///
/// [`Error::Read`] for a text that cannot be followed.
pub fn overtravel(programs: &[Program], travel: [Nm; 3]) -> Result<Vec<Finding>, Error> {
    let found: Vec<Vec<Finding>> =
        programs.par_iter().map(|program| check::overtravel(program, travel)).collect::<Result<_, _>>()?;
    Ok(found.into_iter().flatten().collect())
}

/// What is tolerated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How thick the copper is: a cut less deep leaves it connected.
    pub copper: Nm,
    /// How far a cut may reach into copper.
    pub gouge: Nm,
    /// The part of its width that a net must keep wherever a cut reaches into it.
    pub keep: f64,
    /// A deeper cut into copper is an error, however much is left.
    pub deep: Nm,
    /// Copper below this area, in mm², is a crumb: it neither conducts nor is missed.
    pub crumb: f64,
    /// How far the stock reaches beyond the board.
    pub margin: Nm,
    /// How high a rapid must be.
    pub clearance: Nm,
    /// How far a hole may be off its place.
    pub place: Nm,
    /// How far a hole's diameter may be off.
    pub diameter: Nm,
    /// Below this width a strip of clad between two cuts is a sliver.
    pub sliver: Nm,
    /// How thick the board is.
    pub board: Nm,
    /// How far the machine can go in x, y and z; none where nobody said so.
    pub travel: Option<[Nm; 3]>,
    /// How many tabs were asked for; none where nobody said so: at least one for each board.
    pub tabs: Option<u32>,
    /// How wide tabs were asked for; none where nobody said so: whatever is short may be one.
    pub tab_width: Option<Nm>,
    /// How far the board's edge may be off.
    pub edge: Nm,
    /// Whether these are all programs there are, so that one that the board asks for is missed.
    pub complete: bool,
    /// How many boards there are in the stock; none for one.
    pub tiles: Option<Tiles>,
    /// The pixel of the picture; none for a quarter of the narrowest kerf, within 5 µm to 25 µm.
    pub pixel: Option<Nm>,
}

impl Settings {
    /// As far as no hole's diameter is off: for holes that one drill drills, whatever they ask for.
    /// Chosen.
    pub const ANY_DIAMETER: Nm = Nm::from_mm(100);
}

impl Default for Settings {
    /// Copper of 35 µm (one ounce); 10 µm into copper, twice what a centred cut may be off, a tenth
    /// of a millimetre at the deepest, and half of each net's width left; crumbs of 0.01 mm², a
    /// tenth of a millimetre square; 10 mm of stock; rapids 0.1 mm up; holes within 0.05 mm; strips
    /// of 0.05 mm; a board of 1.6 mm, its edge within 0.1 mm. All chosen.
    fn default() -> Self {
        Self {
            copper: Nm::from_um(35),
            gouge: Nm::from_um(10),
            keep: 0.5,
            deep: Nm::from_um(100),
            crumb: 0.01,
            margin: Nm::from_mm(10),
            clearance: Nm::from_um(100),
            place: Nm::from_um(50),
            diameter: Nm::from_um(50),
            sliver: Nm::from_um(50),
            board: Nm::from_um(1600),
            travel: None,
            tabs: None,
            tab_width: None,
            edge: Nm::from_um(100),
            complete: false,
            tiles: None,
            pixel: None,
        }
    }
}

/// Why nothing could be said.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A program that cannot be followed.
    #[error("{file}: {reason}")]
    Read {
        /// Its name.
        file: String,
        /// What, where and why.
        reason: ReadError,
    },
    /// A motion to where nothing is handled exactly.
    #[error("{file}: line {line}: the position is more than half a metre away")]
    Range {
        /// The program.
        file: String,
        /// Its line.
        line: u32,
    },
    /// Nothing says which tool cuts.
    #[error("{file}: line {line}: the tool that cuts here is unknown")]
    NoTool {
        /// The program.
        file: String,
        /// Its line.
        line: u32,
    },
    /// It cuts where nobody knows, or may: what is left of it says nothing of the copper.
    #[error("{file}: line {line}: {what}: what it cuts cannot be compared")]
    Unfollowed {
        /// The program.
        file: String,
        /// Its line.
        line: u32,
        /// What it does there.
        what: &'static str,
    },
    /// Nothing says which side a program isolates.
    #[error("{0}: the side that this isolates is unknown")]
    NoSide(String),
    /// The board has no copper there.
    #[error("{file}: the board has no copper on the {side}")]
    NoCopper {
        /// The program.
        file: String,
        /// The side.
        side: Side,
    },
    /// The board has no outline.
    #[error("{0}: the board has no outline: what cuts it out cannot be judged")]
    NoOutline(String),
    /// A program that was to be laid over the board, and fits nowhere.
    #[error("{0}: it does not fit the board in any position")]
    Unplaced(String),
    /// A text without motions.
    #[error("{0}: no motion in it")]
    NoMotion(String),
    /// A board too large for its pixels.
    #[error(transparent)]
    Grid(#[from] GridError),
}

impl Error {
    /// What to do about it; may be empty.
    #[must_use]
    pub fn hint(&self) -> Words {
        Words::of(match self {
            Self::NoTool { .. } => "set it: {tool} vbit:0.1mm:30deg, or endmill:0.2mm",
            Self::NoSide(_) => "set it: {side} front, or back",
            Self::NoCopper { .. } => {
                "give the board that the program is for, with the copper of that side; if it is for the other side, say so: {side}"
            }
            Self::NoOutline(_) => {
                "give the board with its outline; if the program is for something else, say so: {side}"
            }
            Self::Grid(_) => "choose a larger {pixel}",
            Self::Unplaced(_) => "set its placement: {offset}, {mirror-axis}, {rotate}",
            Self::Read { .. } | Self::Range { .. } | Self::Unfollowed { .. } | Self::NoMotion(_) => "",
        })
    }
}

/// One side of a board with the nets of its copper, where somebody has found them already.
#[derive(Clone, Copy, Debug)]
pub struct Known<'a> {
    /// The side.
    pub side: Side,
    /// Its nets.
    pub nets: &'a Nets,
}

/// Mills `board` with `programs` and says what is wrong with them.
///
/// Programs for the same side are milled one after another, into the same copper. Of one that is
/// levelled and the one that it was made of the latter is judged.
///
/// # Errors
///
/// [`Error`] where something cannot be judged at all: a text that cannot be followed, a tool or a
/// side that nothing names.
pub fn verify(
    programs: &[Program],
    board: &Board,
    known: &[Known<'_>],
    settings: &Settings,
) -> Result<Report, Error> {
    let mut read: Vec<Machining> = programs
        .par_iter()
        .map(|program| Machining::read(program, board, settings))
        .collect::<Result<_, _>>()?;
    // All lie alike: what one program says of how the board is turned goes for all tiles.
    let degrees = read.first().map_or(0.0, |machining| machining.followed.placement.degrees);
    let tiled = settings.tiles.map(|tiles| tiles.lay(board, degrees));
    if let Some(tiles) = settings.tiles {
        let ways = tiles.ways(board, degrees);
        read.iter_mut().for_each(|machining| machining.repeat(&ways));
    }
    let (board, known) = tiled.as_ref().map_or((board, known), |tiled| (tiled, &[]));
    let mut findings: Vec<Finding> =
        read.par_iter().flat_map_iter(|program| check::motion(program, board, settings)).collect();
    findings.extend(levelled::set_aside(&mut read, programs));
    // Nothing else asks for them, and they are as much again as what is cut.
    read.iter_mut().for_each(|machining| machining.followed.listing.motions = Vec::new());
    let mut roles: Vec<Role> = read.iter().map(|machining| machining.role).collect();
    roles.sort_unstable();
    roles.dedup();
    findings.extend(check::whole(&read, board, settings));
    let drills: Vec<&Machining> = read.iter().filter(|machining| machining.role == Role::Drilling).collect();
    let bores = Bores::new(&drills, board);
    let judged: Vec<(Judged, Vec<Finding>)> = roles
        .into_par_iter()
        .map(|role| judge(role, &read, &bores, board, known, settings))
        .collect::<Result<_, _>>()?;
    let mut report = Report::default();
    for (judged, found) in judged {
        report.judged.push(judged);
        findings.extend(found);
    }
    for finding in &mut findings {
        finding.on_machine = on_machine(finding, &read);
    }
    report.findings = findings;
    report.sort();
    Ok(report)
}

/// The place of a finding as its program has it; of what no program does, as one of those that
/// should have done it has it.
fn on_machine(finding: &Finding, read: &[Machining]) -> Option<Point> {
    let by_name = |machining: &&Machining| finding.program.as_ref() == Some(&machining.followed.file);
    let role = finding.side.map_or(Role::Drilling, Role::Isolation);
    let by_role = || read.iter().find(|machining| machining.role == role);
    Some(read.iter().find(by_name).or_else(by_role)?.followed.placement.apply(finding.at?))
}

fn judge(
    role: Role,
    read: &[Machining],
    bores: &Bores<'_>,
    board: &Board,
    known: &[Known<'_>],
    settings: &Settings,
) -> Result<(Judged, Vec<Finding>), Error> {
    let of =
        |role: Role| -> Vec<&Machining> { read.iter().filter(|machining| machining.role == role).collect() };
    let programs = of(role);
    let mut findings = Vec::new();
    let mut resolution = None;
    match role {
        Role::Isolation(side) => {
            let missing = || Error::NoCopper { file: programs[0].followed.file.clone(), side };
            let copper =
                board.copper(side).filter(|copper| !copper.features.is_empty()).ok_or_else(missing)?;
            let nets = known.iter().find(|known| known.side == side).map(|known| known.nets);
            let milled = Outcome::new(Sheet::new(copper, nets, board, &programs, settings)?, settings);
            resolution = Some(milled.pitch());
            let drilled = Drilled::new(&milled, bores, settings);
            findings.extend(check::isolation(&milled, &drilled, settings));
        }
        Role::Drilling => findings.extend(check::drilling(bores, board, settings)),
        Role::Cutout => {
            let contours = Contours::new(&programs, &of(Role::Drilling), board, settings)
                .ok_or_else(|| Error::NoOutline(programs[0].followed.file.clone()))?;
            findings.extend(check::cutout(&contours, board, settings));
        }
        Role::Alignment => {
            let others = read.iter().filter(|machining| machining.role != Role::Alignment);
            let mirror = others.filter_map(|machining| machining.followed.placement.mirror).next();
            findings.extend(check::alignment(&programs, mirror, board, settings));
        }
    }
    let programs = programs.iter().map(|program| program.followed.file.clone()).collect();
    Ok((Judged { programs, role, resolution }, findings))
}

/// Where a board lies, turned so, whose lower left corner (or middle, or own zero) is the machine's
/// zero.
fn origin(name: &str, degrees: f64, board: &Board) -> Option<Placement> {
    let zero = |around: Rect| match name {
        "lower-left" => around.min(),
        "center" => around.min().midpoint(around.max()),
        _ => Point::default(),
    };
    Some(Placement::turned(degrees, board.bounds()?, zero))
}
