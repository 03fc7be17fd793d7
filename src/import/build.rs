//! A board in the making.

use std::collections::BTreeMap;

use super::archive::Found;
use super::error::Error;
use super::gerber::Image;
use crate::board::diagnostic::count;
use crate::board::{Board, Copper, Feature, Hole, Shape, Side, Source, Warning};
use crate::geometry::{Nm, Point};
use crate::import::diagnostic;

/// A board with what is known of where it came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The board.
    pub board: Board,
    /// The files it was read from and the layers left aside, each with its role.
    pub sources: Vec<Source>,
    /// What was repaired, guessed or left out.
    pub warnings: Vec<Warning>,
    /// Files and folders beside them that are no layer of a board.
    pub ignored: Vec<String>,
}

/// A board in the making.
pub(super) struct Build {
    pub(super) board: Board,
    pub(super) sources: Vec<Source>,
    pub(super) warnings: Vec<Warning>,
}

impl Build {
    pub(super) fn new(name: String) -> Self {
        Self { board: Board { name, ..Board::default() }, sources: Vec::new(), warnings: Vec::new() }
    }

    /// Takes over a copper layer; one that draws nothing is a warning.
    pub(super) fn copper(&mut self, file: &Found, image: Image, side: Side) {
        let mut warnings = image.warnings;
        let name = &file.name;
        self.sources.push(Source { role: format!("{side}-copper"), ..image.source });
        let mut features = image.features;
        let bare: Vec<Feature> = features.extract_if(.., |feature| !has_area(feature)).collect();
        if let Some(first) = bare.first() {
            let message =
                format!("no copper is drawn by {} of {name} without width", count(bare.len(), "object"));
            let warning = diagnostic::ZERO_WIDTH_COPPER.warning(message).at(first.shape.anchor());
            warnings.push(warning.caused_by(file.at_line(first.line)));
        }
        if features.is_empty() {
            let warning = diagnostic::EMPTY_COPPER.warning(format!("{name} draws no copper"));
            warnings.push(warning.caused_by(file.first_line()));
        }
        self.warnings.extend(warnings.into_iter().map(|warning| warning.on(side)));
        if features.is_empty() {
            return;
        }
        let copper = Copper { side, features, attributes: image.attributes };
        match side {
            Side::Front => self.board.front = Some(copper),
            Side::Back => self.board.back = Some(copper),
        }
    }

    /// A board without copper is an error.
    pub(super) fn require_copper(&self, read: &[&Found]) -> Result<(), Error> {
        if self.board.front.is_some() || self.board.back.is_some() {
            return Ok(());
        }
        let shown = read.iter().map(|file| file.shown.as_str()).collect::<Vec<_>>().join(", ");
        let hint = "check that the layer was exported with its content";
        Err(Error::content(&shown, "the board has no copper: nothing is drawn", hint))
    }

    /// Takes over `holes`, less those that are drilled already, by this file or another.
    pub(super) fn add_holes(&mut self, holes: Vec<Hole>, file: &Found, warnings: &mut Vec<Warning>) {
        /// The cell in which holes of one place are looked for. In nanometres; as wide as they may
        /// be apart (`same_hole`).
        const CELL: i64 = 20_000;
        let cell = |p: Point| (p.x.get().div_euclid(CELL), p.y.get().div_euclid(CELL));
        let all = &mut self.board.holes;
        let others = all.len();
        let mut known: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
        for (index, hole) in all.iter().enumerate() {
            known.entry(cell(hole.path.start)).or_default().push(index);
        }
        // The first of those of another file, and of this one.
        let mut doubles = [None::<(u32, Point, u32)>; 2];
        for hole in holes {
            let (at, line) = (hole.path.start, hole.line);
            let (x, y) = cell(at);
            let near = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)));
            let mut near = near.filter_map(|cell| known.get(&cell)).flatten();
            if let Some(&double) = near.find(|&&i| same_hole(&all[i], &hole)) {
                let of = &mut doubles[usize::from(double >= others)];
                of.get_or_insert((0, at, line)).0 += 1;
            } else {
                known.entry((x, y)).or_default().push(all.len());
                all.push(hole);
            }
        }
        let places = ["in another drill file, too", "there more than once"];
        let number = |count| match count {
            1 => ("hole", "is", "it is"),
            _ => ("holes", "are", "they are"),
        };
        for ((count, at, line), place) in
            doubles.into_iter().zip(places).filter_map(|(of, place)| Some((of?, place)))
        {
            let (holes, are, they_are) = number(count);
            let message = format!("{count} {holes} of {} {are} {place}; {they_are} drilled once", file.name);
            let warning = diagnostic::DUPLICATE_HOLES.warning(message).at(at);
            warnings.push(warning.caused_by(file.at_line(line)));
        }
    }

    /// A board as wide as a table is a unit taken for another.
    pub(super) fn warn_of_size(&mut self) {
        /// Chosen: the largest panels are 610 mm long; an inch taken for a millimetre makes 25 mm
        /// wider than this.
        const WIDEST: Nm = Nm::from_mm(620);
        let Some(bounds) = self.board.bounds() else { return };
        if bounds.width().max(bounds.height()) > WIDEST {
            let (width, height) = (bounds.width(), bounds.height());
            let message =
                format!("the board is {width:.1} × {height:.1} mm: the unit of a file may be wrong");
            self.warnings.push(diagnostic::SIZE_IMPLAUSIBLE.warning(message));
        }
    }

    /// A board of a metre is none: a file is in another unit than it says.
    pub(super) fn refuse_size(&self, place: &str) -> Result<(), Error> {
        /// Chosen: beyond what any mill for boards reaches, and below a board of 50 mm whose
        /// millimetres are taken for inches.
        const METRE: Nm = Nm::from_mm(1000);
        let bounds = self.board.bounds().filter(|bounds| bounds.width().max(bounds.height()) > METRE);
        let Some(bounds) = bounds else { return Ok(()) };
        let (width, height) = (bounds.width(), bounds.height());
        let what = format!("the board is {width:.1} × {height:.1} mm: a file declares the wrong unit");
        Err(Error::content(place, what, "`inspect` lists the unit of each file; export the wrong one again"))
    }
}

/// Whether two mean the same hole: within a rounding to 0.001 inch.
fn same_hole(a: &Hole, b: &Hole) -> bool {
    /// Derived: a rounding to 0.001 inch is off by 13 µm at most. Two of them are 18 µm apart.
    const NEAR: Nm = Nm::from_um(20);
    let near = |p: Point, q: Point| (p.x - q.x).abs() <= NEAR && (p.y - q.y).abs() <= NEAR;
    near(a.path.start, b.path.start)
        && near(a.path.end(), b.path.end())
        && (a.diameter - b.diameter).abs() <= Nm::from_um(50)
        && a.path.segments.len() == b.path.segments.len()
}

fn has_area(feature: &Feature) -> bool {
    match &feature.shape {
        Shape::Disc { radius, .. } | Shape::Stroke { radius, .. } | Shape::Arc { radius, .. } => {
            *radius > Nm::ZERO
        }
        Shape::Polygon(_) => true,
    }
}
