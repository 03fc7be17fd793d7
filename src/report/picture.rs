//! Pictures of a side: each stage of the work as a person sees it, the front view for both sides.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::board::{Board, Copper, FLATTEN, Hole, Outline, Shape};
use crate::geometry::{Nm, Path, Point, Rect, Segment};
use crate::grid::{Grid, GridError};
use crate::raster::{self, Buffers, Label, Scene};
use crate::toolpath::{Move, Placement, Section};
use crate::topology::{self, Nets};
use crate::voronoi::{Boundaries, Boundary, Owner, Regions};

use super::palette::{COLD, COPPER, CUT, EDGE, GROUND, HOLE, HOT, INK, RAPID, SUBSTRATE, WARM, tints, vivid};
use super::{Canvas, Lettering, Rgb, png};

/// What was done to one side of a board, as far as a picture shows it.
#[derive(Clone)]
pub struct Shown<'a> {
    /// The board.
    pub board: &'a Board,
    /// The copper of the side.
    pub copper: &'a Copper,
    /// Its nets.
    pub nets: &'a Nets,
    /// Their regions.
    pub regions: &'a Regions,
    /// The lines between these.
    pub boundaries: &'a Boundaries,
    /// What the machine does to it, tool by tool.
    pub sections: Vec<&'a Section>,
    /// How the side lies on the machine.
    pub placement: &'a Placement,
    /// What cuts the board out, and how the board lies then.
    pub cutout: Option<(&'a Section, &'a Placement)>,
}

/// Copper alone: white on black, one byte a pixel, white exactly where a pixel's centre is copper.
#[must_use]
pub fn copper(copper: &Copper, grid: &Grid) -> Vec<u8> {
    let mut scene = Scene::new(grid.width(), grid.height());
    for feature in copper.features.iter().filter(|feature| feature.shape.bounds().touches(grid.rect())) {
        scene.add(Label(1), topology::surface(&feature.shape, grid, Some(0.0)));
    }
    let mut buffers = Buffers::new();
    raster::render(&scene, &mut buffers);
    buffers.labels().iter().map(|&label| if label == 0 { 0 } else { u8::MAX }).collect()
}

/// Copper with a colour for each net, and the names of those that have one where there is room.
#[must_use]
pub fn nets(board: &Board, copper: &Copper, nets: &Nets, grid: Grid) -> Canvas {
    let mut canvas = Canvas::new(grid, GROUND);
    substrate(&mut canvas, board.outline.as_ref());
    let colour = |index| vivid(nets.of(index));
    canvas.fill(copper.shapes().zip(0..).map(|(shape, index)| (shape, colour(index))));
    holes(&mut canvas, &board.holes);
    names(&mut canvas, copper, nets);
    canvas
}

/// Regions, copper and the boundaries between them, on a band of the picture that `ground` is for.
#[must_use]
pub fn voronoi(ground: &Ground<'_>, band: Grid) -> Canvas {
    let side = ground.side;
    let mut canvas = ground.canvas(band);
    let lines = side.boundaries.edges.iter().filter(|edge| !edge.is_border()).map(|edge| &edge.path);
    canvas.strokes(lines, Nm::ZERO, CUT, 1.0);
    holes(&mut canvas, &side.board.holes);
    canvas
}

/// The boundaries as a graph over dimmed copper: lines, and a dot where they meet or end.
#[must_use]
pub fn boundaries(side: &Shown<'_>, grid: Grid) -> Canvas {
    let dot = grid.pitch() * 2;
    let mut canvas = dimmed(side, grid);
    canvas.strokes(side.boundaries.edges.iter().map(|edge| &edge.path), Nm::ZERO, CUT, 1.0);
    let dots: Vec<Shape> =
        side.boundaries.nodes.iter().map(|&center| Shape::Disc { center, radius: dot }).collect();
    canvas.fill(dots.iter().map(|dot| (dot, RAPID)));
    canvas
}

/// The clearance from which on a boundary is as free as it can be shown to be. Chosen.
const FREE: Nm = Nm::from_mm(1);

/// The clearance of each stretch of boundary over dimmed copper: how far its narrower end is from
/// copper, red to blue.
#[must_use]
pub fn heat(side: &Shown<'_>, grid: Grid) -> Canvas {
    let width = grid.pitch() * 3;
    let mut canvas = dimmed(side, grid);
    let stretches = |edge: &Boundary| {
        let stretch = |((from, &segment), room): ((Point, &Segment), &[Nm])| {
            let path = Path { start: from, segments: vec![segment] };
            (path, clearance_colour(room[0].min(room[1])))
        };
        edge.path.steps().zip(edge.clearance.windows(2)).map(stretch).collect::<Vec<_>>()
    };
    let edges = side.boundaries.edges.iter().filter(|edge| !edge.is_border());
    let stretches: Vec<(Path, Rgb)> = edges.flat_map(stretches).collect();
    canvas.coloured(stretches.iter().map(|(path, colour)| (path, *colour)), width, 1.0);
    canvas
}

/// Red at no room, over yellow, to blue from [`FREE`] on.
fn clearance_colour(room: Nm) -> Rgb {
    let way = |part: i64| u8::try_from(part.clamp(0, 255)).unwrap_or(u8::MAX);
    let share = room.get() * 510 / FREE.get();
    if share < 255 { HOT.towards(WARM, way(share)) } else { WARM.towards(COLD, way(share - 255)) }
}

/// Ground, and copper just to be made out.
fn dimmed(side: &Shown<'_>, grid: Grid) -> Canvas {
    let mut canvas = Canvas::new(grid, GROUND);
    substrate(&mut canvas, side.board.outline.as_ref());
    canvas.fill(side.copper.shapes().map(|shape| (shape, GROUND.towards(COPPER, 80))));
    canvas
}

/// How far pixels are from copper: dark near it, light far from it, white where nothing is in
/// reach.
///
/// Brightness goes with the square root of the distance. Gaps of a fifth of a millimetre were all
/// but black beside one corner of a centimetre, in proportion; half as bright is a quarter as far.
pub struct Depth<F> {
    depths: F,
    /// The farthest of all that are in reach, in pixels.
    deepest: f32,
}

impl<F: Fn(&Grid) -> Vec<f32>> Depth<F> {
    /// The greys of a picture of `grid`, which is looked through band by band for its deepest
    /// pixel; `depths` are those of the pixels of a band.
    #[must_use]
    pub fn new(depths: F, grid: &Grid) -> Self {
        let mut deepest = 1.0_f32;
        png::each_band(grid, |band| {
            let depths = depths(&band).into_iter().filter(|depth| depth.is_finite());
            deepest = depths.fold(deepest, f32::max);
        });
        Self { depths, deepest }
    }

    /// The pixels of a band of the picture, one byte each.
    #[must_use]
    pub fn greys(&self, band: &Grid) -> Vec<u8> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within 0..=255")]
        let grey = |depth: f32| {
            if depth.is_finite() { ((depth / self.deepest).sqrt() * 255.0) as u8 } else { u8::MAX }
        };
        (self.depths)(band).into_iter().map(grey).collect()
    }
}

/// Everything: regions, copper, cuts at their true width, holes; with the tool's way through the
/// air where asked.
pub struct Toolpath<'a> {
    ground: Ground<'a>,
    ways: Vec<(&'a Section, Ways)>,
    /// What goes all the way through, and how wide: the tabs are where it does not.
    through: Option<(Vec<Path>, Nm)>,
    rapids: bool,
}

impl<'a> Toolpath<'a> {
    /// A picture of `grid`, with the tool's way through the air where `rapids`.
    #[must_use]
    pub fn new(side: &'a Shown<'a>, grid: &Grid, rapids: bool) -> Self {
        let ways = side.sections.iter().map(|&section| (section, Ways::of(section, side.placement)));
        let through = side.cutout.and_then(|(section, placement)| {
            let (depth, paths) = Ways::of(section, placement).cuts.pop_last()?;
            Some((paths, section.tool.width_at(depth)))
        });
        Self { ground: Ground::new(side, grid), ways: ways.collect(), through, rapids }
    }

    /// A band of it.
    #[must_use]
    pub fn draw(&self, band: Grid) -> Canvas {
        let board = self.ground.side.board;
        let mut canvas = self.ground.canvas(band);
        for (section, ways) in &self.ways {
            for (depth, paths) in &ways.cuts {
                canvas.strokes(paths, section.tool.width_at(*depth), CUT, 0.92);
            }
            if self.rapids {
                canvas.strokes(&ways.rapids, Nm::ZERO, RAPID, 0.8);
            }
        }
        if let Some((paths, width)) = &self.through {
            canvas.strokes(paths, *width, EDGE, 0.45);
        }
        if let Some(outline) = &board.outline {
            canvas.strokes(outline.contours(), Nm::ZERO, EDGE, 0.9);
        }
        holes(&mut canvas, &board.holes);
        canvas
    }
}

/// Substrate, regions in their tints, copper.
///
/// The regions of the whole picture are found at once: each of its bands would look at all copper.
pub struct Ground<'a> {
    side: &'a Shown<'a>,
    grid: Grid,
    /// The colour of some columns, row by row.
    rows: Vec<Vec<(Range<u32>, Rgb)>>,
}

impl<'a> Ground<'a> {
    /// That of a picture of `grid`.
    #[must_use]
    pub fn new(side: &'a Shown<'a>, grid: &Grid) -> Self {
        let tints = tints(side.nets.nets().len(), side.boundaries);
        let mut rows = vec![Vec::new(); grid.height() as usize];
        side.regions.paint(side.copper, side.nets, grid, |row, columns, owner| {
            if let Owner::Net(net) = owner {
                rows[row as usize].push((columns, tints[net.index()]));
            }
        });
        Self { side, grid: *grid, rows }
    }

    /// A band of it.
    fn canvas(&self, band: Grid) -> Canvas {
        let mut canvas = Canvas::new(band, GROUND);
        substrate(&mut canvas, self.side.board.outline.as_ref());
        let rows = self.rows.iter().skip(band.first_row(&self.grid) as usize);
        for (row, columns) in (0..band.height()).zip(rows) {
            for (columns, tint) in columns {
                canvas.set_row(row, columns.clone(), *tint);
            }
        }
        canvas.fill(self.side.copper.shapes().map(|shape| (shape, COPPER)));
        canvas
    }
}

fn substrate(canvas: &mut Canvas, outline: Option<&Outline>) {
    if let Some(outline) = outline {
        canvas.fill([(&Shape::Polygon(outline.polygon(FLATTEN)), SUBSTRATE)]);
    }
}

fn holes(canvas: &mut Canvas, holes: &[Hole]) {
    let holes: Vec<Shape> = holes.iter().flat_map(|hole| hole.shapes(Nm::ZERO)).collect();
    canvas.fill(holes.iter().map(|hole| (hole, HOLE)));
}

/// The name of each named net, beside its largest feature, where that is large enough to read it
/// on.
fn names(canvas: &mut Canvas, copper: &Copper, nets: &Nets) {
    /// The smallest letters that are read, in pixels. Chosen.
    const HEIGHT: f32 = 9.0;
    for net in nets.nets().iter().filter(|net| !net.names.is_empty()) {
        let bounds = |feature: &u32| copper.features[*feature as usize].shape.bounds();
        let size = |rect: &Rect| rect.width().max(rect.height());
        let Some(largest) = net.features.iter().map(bounds).max_by_key(size) else { continue };
        let text = net.names.join("+");
        let name = Lettering { text: &text, height: HEIGHT, colour: INK };
        if canvas.grid().pixels(size(&largest)) > name.width() {
            let (x, y) = canvas.place(largest.min().midpoint(largest.max()));
            let plate = [x - name.width() / 2.0 - 3.0, y - HEIGHT, name.width() + 4.0, HEIGHT + 6.0];
            canvas.block(plate, GROUND, 0.7);
            name.draw(canvas, x - name.width() / 2.0, y + 2.0);
        }
    }
}

/// The ways of a tool over the board.
#[derive(Default)]
pub(super) struct Ways {
    /// What it cuts, by depth below the surface.
    pub(super) cuts: BTreeMap<Nm, Vec<Path>>,
    /// How it gets from one to the next.
    rapids: Vec<Path>,
}

impl Ways {
    pub(super) fn of(section: &Section, placement: &Placement) -> Self {
        let mut ways = Self::default();
        let mut at: Option<(Point, Nm)> = None;
        for step in &section.moves {
            let Some(to) = step.to() else { continue };
            let (point, z) = (placement.undo(to.point()), to.z);
            if let Some((from, before)) = at {
                ways.step(from, segment(step, point, placement), before.min(z));
            }
            at = Some((point, z));
        }
        ways
    }

    /// Goes on from `from` at height `z`: with the path being cut there, or with a new one.
    fn step(&mut self, from: Point, segment: Segment, z: Nm) {
        if z >= Nm::ZERO {
            self.rapids.push(Path { start: from, segments: vec![segment] });
            return;
        }
        let paths = self.cuts.entry(-z).or_default();
        match paths.last_mut() {
            Some(path) if path.end() == from => path.segments.push(segment),
            _ => paths.push(Path { start: from, segments: vec![segment] }),
        }
    }
}

/// A move as it runs over the board, ending at `to`.
fn segment(step: &Move, to: Point, placement: &Placement) -> Segment {
    match *step {
        Move::Arc { center, turn, .. } => {
            Segment::Arc { to, center: placement.undo(center), turn: placement.turn(turn) }
        }
        Move::Rapid { .. } | Move::Feed { .. } | Move::Dwell { .. } => Segment::Line { to },
    }
}

/// The area a picture of the whole board covers: the board and what is cut round it.
#[must_use]
pub fn whole(board: &Board, margin: Nm) -> Option<Rect> {
    let copper = [&board.front, &board.back].into_iter().flatten().filter_map(Copper::bounds);
    let all = board.bounds().into_iter().chain(copper.filter(|_| board.outline.is_none()));
    all.reduce(Rect::union).map(|bounds| bounds.inflate(margin))
}

/// The most pixels of a picture: with what it takes to draw it, about 2 GiB of memory. Chosen.
const MOST_PIXELS: i64 = 1 << 27;

/// Refuses a grid whose picture would fill the memory.
///
/// # Errors
///
/// [`GridError::TooLarge`] beyond 2²⁷ pixels.
pub fn within_reason(grid: &Grid) -> Result<(), GridError> {
    let (columns, rows) = (i64::from(grid.width()), i64::from(grid.height()));
    if columns * rows > MOST_PIXELS { Err(GridError::TooLarge { columns, rows }) } else { Ok(()) }
}

/// A grid over `area` of `pixel`, or as much coarser as keeps the longer side within `most` pixels.
///
/// # Errors
///
/// As [`Grid::covering`].
pub fn fit(area: Rect, pixel: Nm, most: i64) -> Result<Grid, GridError> {
    let longer = area.width().max(area.height());
    Grid::covering(area, pixel.max(Nm::new(longer.get() / most + 1)))
}
