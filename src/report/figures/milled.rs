//! A board as it comes from the bath or from the mill, seen from straight above: shaded by how deep
//! it is, on a table that it shades.
//!
//! ```text
//!   light ╲   copper      groove            The light comes from the upper left. What is level has its own colour, what
//!          ╲ ━━━━━━━━━╲  ╱━━━━━━━━┓        falls towards the light is brighter, away from it darker. The board shades the
//!           ░░░░░░░░░░░╲╱░░░░░░░░░┃╲       table below it, beside its edge and in its holes.
//!          ─────────────────────────╲──
//! ```

use crate::board::{Board, Copper, FLATTEN, Outline, Shape};
use crate::geometry::{Nm, Path, Polygon};
use crate::grid::{Grid, GridError};
use crate::raster::{Buffers, Caps, Label, Scene, Sides, Surface, render};
use crate::report::{Canvas, Rgb};

use super::painting::{Painting, bytes, mix};

/// How copper was taken away.
#[derive(Clone, Copy, Debug)]
pub(super) enum Made<'a> {
    /// All that is no net, in a bath; what stays is tinned.
    Etched,
    /// Along lines, by a cutter.
    Cut(&'a [Path]),
}

/// Pixels that each one shown is the mean of, in a row. Chosen: smooth edges.
const FINER: u32 = 3;
/// How wide grooves are at the surface. Chosen: two or three pixels, as wide as coarse cutters are.
const KERF: Nm = Nm::from_um(260);
/// How deep they look, in millimetres. Chosen, four times copper's thickness.
const DEEP: f64 = 0.14;
/// The thickness of copper, in millimetres.
const COPPER: f64 = 0.035;
/// Light colours: copper, tin, the board, the table, and the same in the shade.
const METAL: [f64; 3] = [214.0, 144.0, 92.0];
const TIN: [f64; 3] = [203.0, 207.0, 212.0];
const LAMINATE: [f64; 3] = [172.0, 172.0, 112.0];
const TABLE: [f64; 3] = [255.0, 255.0, 255.0];
const SHADE: [f64; 3] = [70.0, 66.0, 72.0];
/// Towards the light, of length one: x right, y down, z up.
const LIGHT: [f64; 3] = [-0.48, -0.36, 0.8];
/// How far the board's shadow falls. Chosen: less than it would, so that holes stay holes.
const SHADOW: Nm = Nm::from_um(900);

/// The picture of a side, `columns` wide.
pub(super) fn milled(
    board: &Board,
    copper: &Copper,
    made: Made<'_>,
    columns: u32,
) -> Result<Painting, GridError> {
    let area = super::area(board, copper).inflate(Nm::from_mm(1));
    let grid = Grid::covering(area, area.width() / i64::from(columns * FINER) + Nm::new(1))?;
    let stock = stock(board, copper, grid);
    let depth = match made {
        Made::Etched => etched(copper, grid),
        Made::Cut(lines) => grooves(lines, &grid),
    };
    let surface = if matches!(made, Made::Etched) { TIN } else { METAL };
    let (width, height) = (grid.width(), grid.height());
    let at = |column: u32, row: u32| (row * width + column) as usize;
    let pixel = grid.pitch().to_mm();
    let fall = |a: usize, b: usize| (depth[b] - depth[a]) / (2.0 * pixel);
    let painting = Painting::from_fn(width, height, |column, row| {
        let here = at(column, row);
        let beside = (at(column.saturating_sub(1), row), at((column + 1).min(width - 1), row));
        let above = (at(column, row.saturating_sub(1)), at(column, (row + 1).min(height - 1)));
        // Deeper to the right: the surface looks to the right.
        let normal = [fall(beside.0, beside.1), fall(above.0, above.1), 1.0];
        let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
        let lit = normal.iter().zip(LIGHT).map(|(a, b)| a * b).sum::<f64>().max(0.0) / length;
        // Metal shines a little more where it lies nearer to the light.
        let sheen = 1.06 - 0.12 * f64::from(column + row) / f64::from(width + height);
        let bare = ((depth[here] - COPPER * 0.6) / (COPPER * 0.8)).clamp(0.0, 1.0);
        let own = mix(surface.map(|part| part * sheen), LAMINATE, bare);
        let bright = 0.35 + 0.65 * lit / LIGHT[2];
        let board = own.map(|part| (part * bright).min(255.0));
        let table = mix(TABLE, SHADE, 0.9 * shaded(&stock, &grid, (column, row)));
        bytes(mix(table, board, f64::from(stock[here]) / 255.0))
    });
    Ok(painting.smaller(FINER as usize))
}

/// Where there is board: from nothing to 255.
fn stock(board: &Board, copper: &Copper, grid: Grid) -> Vec<u8> {
    let mut canvas = Canvas::new(grid, Rgb(0, 0, 0));
    let whole = |outline: &Outline| outline.polygon(FLATTEN);
    let edge = board.outline.as_ref().map_or_else(|| Polygon::rectangle(super::area(board, copper)), whole);
    canvas.fill([(&Shape::Polygon(edge), Rgb(255, 255, 255))]);
    let holes: Vec<Shape> = board.holes.iter().flat_map(|hole| hole.shapes(Nm::ZERO)).collect();
    canvas.fill(holes.iter().map(|hole| (hole, Rgb(0, 0, 0))));
    red(canvas)
}

/// The depth of each pixel in millimetres where all but copper is etched away.
fn etched(copper: &Copper, grid: Grid) -> Vec<f64> {
    let mut canvas = Canvas::new(grid, Rgb(0, 0, 0));
    canvas.fill(copper.shapes().map(|shape| (shape, Rgb(255, 255, 255))));
    red(canvas).into_iter().map(|part| 1.5 * COPPER * (1.0 - f64::from(part) / 255.0)).collect()
}

/// The same where a cutter went along lines: a V with a flat bottom.
fn grooves(lines: &[Path], grid: &Grid) -> Vec<f64> {
    let half = grid.pixels(KERF / 2);
    let mut scene = Scene::new(grid.width(), grid.height());
    for path in lines {
        for pair in path.flatten(grid.pitch() / 8).windows(2) {
            let [from, to] = [pair[0], pair[1]].map(|point| grid.pixel(point));
            let caps = (Caps::Both, Sides::Both);
            scene.add(
                Label(1),
                Surface::Curtain { from, to, caps: caps.0, sides: caps.1, offset: 0.0, limit: Some(half) },
            );
        }
    }
    let mut buffers = Buffers::new();
    render(&scene, &mut buffers);
    let deep = |(&label, &distance): (&u32, &f32)| match label {
        0 => 0.0,
        _ => DEEP * (1.4 * f64::from(1.0 - distance / half)).clamp(0.0, 1.0),
    };
    buffers.labels().iter().zip(buffers.depths()).map(deep).collect()
}

/// How much of the light the board keeps from a place of the table: 0 to 1.
fn shaded(stock: &[u8], grid: &Grid, (column, row): (u32, u32)) -> f64 {
    /// Steps towards the light at which heights are compared. Chosen.
    const STEPS: u32 = 8;
    let reach = f64::from(grid.pixels(SHADOW));
    let toward = |from: u32, way: f64, most: u32| {
        let to = (f64::from(from) + way).round().clamp(0.0, f64::from(most - 1));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let to = to as u32;
        to
    };
    let sum: u32 = (1..=STEPS)
        .map(|step| {
            let far = reach * f64::from(step) / f64::from(STEPS);
            let x = toward(column, LIGHT[0] * far, grid.width());
            let y = toward(row, LIGHT[1] * far, grid.height());
            u32::from(stock[(y * grid.width() + x) as usize])
        })
        .sum();
    f64::from(sum) / f64::from(STEPS * 255)
}

fn red(canvas: Canvas) -> Vec<u8> {
    canvas.into_rgb().chunks_exact(3).map(|pixel| pixel[0]).collect()
}
