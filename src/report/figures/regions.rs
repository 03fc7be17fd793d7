//! Figures 4 and 6: the layout in black; Voronoi regions of the core axes, each in a colour that
//! its neighbours have not, as far as there is room or to a limit, with the paths between them.

use crate::board::{Axis, Copper, Shape};
use crate::geometry::{Arc, Nm, Path, Point, Segment};
use crate::grid::Grid;
use crate::report::palette::colouring;
use crate::report::{Canvas, Rgb};
use crate::topology::Nets;
use crate::voronoi::{Diagram, Frame, Owner, Settings, SiteKind};

use super::FigureError;
use super::painting::Painting;

/// Pixels that each one shown is the mean of, in a row. Chosen: smooth edges.
const FINER: u32 = 3;
/// Colours of regions: light enough for black lines on them. Regions on a plane need six.
pub(super) const LIGHT: [Rgb; 8] = [
    Rgb(0x8e, 0xc1, 0xf0),
    Rgb(0xf7, 0xc5, 0x6b),
    Rgb(0x9a, 0xd9, 0x9c),
    Rgb(0xf2, 0x9c, 0xa8),
    Rgb(0xc3, 0xae, 0xf0),
    Rgb(0x86, 0xd9, 0xd6),
    Rgb(0xe8, 0xe2, 0x7d),
    Rgb(0xd8, 0xb4, 0x96),
];
const BLACK: Rgb = Rgb(0x14, 0x14, 0x18);
const WHITE: Rgb = Rgb(0xff, 0xff, 0xff);

/// The grid of a picture of a side, `columns` wide once it is shown.
fn grid(copper: &Copper, margin: Nm, columns: u32) -> Result<Grid, FigureError> {
    let bounds = copper.bounds().ok_or(FigureError::NoCopper)?.inflate(margin);
    Ok(Grid::covering(bounds, bounds.width() / i64::from(columns * FINER) + Nm::new(1))?)
}

/// The copper, black on white.
pub(super) fn layout(copper: &Copper, margin: Nm, columns: u32) -> Result<Painting, FigureError> {
    let mut canvas = Canvas::new(grid(copper, margin, columns)?, WHITE);
    canvas.fill(copper.shapes().map(|shape| (shape, BLACK)));
    Ok(Painting::of(canvas).smaller(FINER as usize))
}

/// The regions of the core axes, `limit` wide at most, with the axes in black; between regions that
/// have no limit a white line, else the paths that are cut, in black.
pub(super) fn regions(
    copper: &Copper,
    nets: &Nets,
    (margin, limit): (Nm, Option<Nm>),
    columns: u32,
) -> Result<Painting, FigureError> {
    let grid = grid(copper, margin, columns)?;
    let frame = Frame::Rectangle(margin + grid.pitch() * 8);
    let settings = Settings { sites: SiteKind::Core, limit, frame, ..Settings::default() };
    let diagram = Diagram::new(copper, nets, None, &settings)?;
    let mut owners = vec![0_u32; (grid.width() * grid.height()) as usize];
    diagram.regions().paint(copper, nets, &grid, |row, columns, owner| {
        let number = match owner {
            Owner::Net(net) => net.0 + 1,
            Owner::Background | Owner::Outside => 0,
        };
        let from = (row * grid.width()) as usize;
        owners[from + columns.start as usize..from + columns.end as usize].fill(number);
    });
    let mut canvas = flat(&owners, grid);
    let boundaries = diagram.boundaries()?;
    let lines = boundaries.edges.iter().filter(|edge| !edge.is_border()).map(|edge| &edge.path);
    let (colour, width) = if limit.is_some() { (BLACK, 3) } else { (WHITE, 5) };
    canvas.strokes(lines, grid.pitch() * width, colour, 1.0);
    axes(&mut canvas, copper, grid.pitch() * 5, BLACK);
    Ok(Painting::of(canvas).smaller(FINER as usize))
}

/// A picture of owners, from 1, each in a colour that its neighbours have not; 0 is white.
#[must_use]
pub fn flat(owners: &[u32], grid: Grid) -> Canvas {
    let count = owners.iter().max().map_or(0, |&most| most as usize);
    let colours = colouring(&neighbours(owners, grid.width() as usize, count));
    let mut canvas = Canvas::new(grid, WHITE);
    for (row, line) in (0..grid.height()).zip(owners.chunks_exact(grid.width() as usize)) {
        for (column, &owner) in (0..grid.width()).zip(line) {
            if let Some(net) = owner.checked_sub(1) {
                canvas.set(column, row, LIGHT[colours[net as usize] % LIGHT.len()]);
            }
        }
    }
    canvas
}

/// Which nets are beside each other in a picture of owners, from 1; 0 is nobody.
fn neighbours(owners: &[u32], width: usize, nets: usize) -> Vec<Vec<usize>> {
    let mut found = vec![Vec::new(); nets];
    for at in 0..owners.len() {
        let right = (at % width + 1 < width).then_some(at + 1);
        for other in [right, Some(at + width).filter(|&below| below < owners.len())].into_iter().flatten() {
            let (a, b) = (owners[at], owners[other]);
            if a != b && a > 0 && b > 0 {
                found[a as usize - 1].push(b as usize - 1);
                found[b as usize - 1].push(a as usize - 1);
            }
        }
    }
    for others in &mut found {
        others.sort_unstable();
        others.dedup();
    }
    found
}

/// The core axes as lines, a dot where a flash is.
pub(super) fn axes(canvas: &mut Canvas, copper: &Copper, width: Nm, colour: Rgb) {
    for feature in &copper.features {
        match feature.axis {
            Axis::Flash(center) => canvas.fill([(&Shape::Disc { center, radius: width }, colour)]),
            Axis::Line(from, to) => canvas.stroke(&line(from, to), width, colour, 1.0),
            Axis::Arc(arc) => canvas.stroke(&path_of(&arc), width, colour, 1.0),
            Axis::Region => {}
        }
    }
}

pub(super) fn line(from: Point, to: Point) -> Path {
    Path { start: from, segments: vec![Segment::Line { to }] }
}

fn path_of(arc: &Arc) -> Path {
    Path {
        start: arc.start,
        segments: vec![Segment::Arc { to: arc.end, center: arc.center, turn: arc.turn }],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_touches_in_the_picture_is_beside_each_other() {
        let picture = [1, 1, 2, 0, 3, 3, 2, 0, 0, 0, 0, 4];
        let found = neighbours(&picture, 4, 4);
        assert_eq!(found, [vec![1, 2], vec![0, 2], vec![0, 1], vec![]], "four is alone");
    }
}
