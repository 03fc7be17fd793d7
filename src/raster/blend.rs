//! Pictures in which a pixel shows more than what is nearest: translucent layers, and how many
//! there are.

use rayon::prelude::*;

use super::Scene;
use super::bin::Bin;
use super::canvas::{Canvas, SIDE, count};
use super::cell::Cell;
use super::mosaic::{Cuts, Mosaic};
use super::node::signed;

/// A rectangle of pixels of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// The leftmost column.
    pub column: u32,
    /// The topmost row.
    pub row: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Window {
    /// All of a scene's picture.
    #[must_use]
    pub const fn all(scene: &Scene) -> Self {
        Self { column: 0, row: 0, width: scene.width(), height: scene.height() }
    }
}

/// The colour of one pixel over which translucent layers lie, the nearest first: each component is
/// Σ ⌈cᵢ / 2ⁱ⌉ with i = 1, 2, … ([Vona and Rus, VIsolate, § III-A.2]), at most 255.
///
/// From the ninth layer on nothing is left of a component but its being there.
///
/// ```
/// use voromill::raster::blend::mix;
///
/// assert_eq!(mix([[200, 0, 0]]), [100, 0, 0], "half of the nearest");
/// assert_eq!(mix([[200, 0, 0], [0, 0, 100]]), [100, 0, 25], "and a quarter of the next");
/// ```
///
/// [Vona and Rus, VIsolate, § III-A.2]: super#references
#[must_use]
pub fn mix(layers: impl IntoIterator<Item = [u8; 3]>) -> [u8; 3] {
    let mut sum = [0_u8; 3];
    for (layer, i) in layers.into_iter().zip(1_u32..) {
        for (sum, component) in sum.iter_mut().zip(layer) {
            let halved = u16::from(component).div_ceil(1 << i.min(8));
            *sum = sum.saturating_add(u8::try_from(halved).unwrap_or(u8::MAX));
        }
    }
    sum
}

/// Draws every label translucently, in its colour from `colors` (black where there is none): a
/// pixel is the [`mix`] of the distinct labels that have a fragment there, in the order of their
/// depth. Row by row from the top.
///
/// However many primitives of one label lie on a pixel, they count once, at the nearest.
///
/// ```
/// use voromill::raster::blend::{Window, render_translucent};
/// use voromill::raster::{Label, PixelPoint, Scene, Surface};
///
/// let mut scene = Scene::new(4, 1);
/// for (label, x) in [(1, 0.5), (2, 3.5)] {
///     let apex = PixelPoint::from_f64(x, 0.5);
///     scene.add(Label(label), Surface::Cone { apex, offset: 0.0, limit: Some(2.0) });
/// }
/// let colors = [[0; 3], [200, 0, 0], [0, 0, 200]];
/// let picture = render_translucent(&scene, &colors, Window::all(&scene));
/// assert_eq!(picture, [[100, 0, 0], [100, 0, 50], [50, 0, 100], [0, 0, 100]], "both in the middle");
/// ```
///
/// # Panics
///
/// Where `window` reaches beyond the picture.
#[must_use]
pub fn render_translucent(scene: &Scene, colors: &[[u8; 3]], window: Window) -> Vec<[u8; 3]> {
    let color = |label: u32| colors.get(label as usize).copied().unwrap_or_default();
    layered(scene, window, [0; 3], |layers| {
        layers.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut distinct: Vec<u32> = Vec::with_capacity(layers.len());
        for &(_, label) in layers.iter() {
            if !distinct.contains(&label) {
                distinct.push(label);
            }
        }
        mix(distinct.into_iter().map(color))
    })
}

/// Counts the fragments on every pixel: how often it is drawn over. Row by row from the top.
///
/// ```
/// use voromill::raster::blend::{Window, render_overdraw};
/// use voromill::raster::{Label, PixelPoint, Scene, Surface};
///
/// let mut scene = Scene::new(4, 1);
/// for x in [0.5, 1.5] {
///     let apex = PixelPoint::from_f64(x, 0.5);
///     scene.add(Label(1), Surface::Cone { apex, offset: 0.0, limit: Some(1.0) });
/// }
/// assert_eq!(render_overdraw(&scene, Window::all(&scene)), [2, 2, 1, 0], "two cones, three pixels wide");
/// ```
///
/// # Panics
///
/// Where `window` reaches beyond the picture.
#[must_use]
pub fn render_overdraw(scene: &Scene, window: Window) -> Vec<u32> {
    layered(scene, window, 0, |layers| u32::try_from(layers.len()).unwrap_or(u32::MAX))
}

/// Depth and label of a fragment.
type Layer = (f32, u32);

/// A picture in which `shade` makes each pixel from all its fragments; it gets none where there is
/// no fragment.
fn layered<P: Copy + Send + Sync>(
    scene: &Scene,
    window: Window,
    empty: P,
    shade: impl Fn(&mut Vec<Layer>) -> P + Sync,
) -> Vec<P> {
    let Window { column, row, width, height } = window;
    let inside = column.checked_add(width).is_some_and(|right| right <= scene.width())
        && row.checked_add(height).is_some_and(|bottom| bottom <= scene.height());
    assert!(inside, "a window reaches beyond the picture");
    if width == 0 || height == 0 {
        return Vec::new();
    }
    let stride = width as usize;
    let mut pixels = vec![empty; stride * height as usize];
    let cell = Cell { x: signed(column), y: signed(row), width: signed(width), height: signed(height) };
    let root = Bin::root(scene, cell).seen_through();
    let tops: Vec<_> = (cell.y..cell.y + cell.height).step_by(count(SIDE)).collect();
    let bands = pixels.par_chunks_mut(stride * count(SIDE)).zip(tops);
    bands.for_each(|(pixels, y)| {
        let band = Cell { y, height: (signed(height) - (y - cell.y)).min(SIDE), ..cell };
        let mut layers = Layers { scene, canvas: Canvas::new(), mosaic: Mosaic::new(), layers: Vec::new() };
        let whole = Cuts { columns: vec![(band.x, band.width)], rows: vec![(band.y, band.height)] };
        let mut bins = Vec::new();
        layers.mosaic.split(scene, &root, cell, &whole, &mut bins);
        layers.paint(&bins[0], band, &mut |block, at, layers| {
            let index = count(block.y - band.y) * stride + count(block.x - band.x);
            pixels[index + at.1 * stride + at.0] = shade(layers);
        });
    });
    pixels
}

/// Draws all layers of a band of the picture.
struct Layers<'a> {
    scene: &'a Scene,
    canvas: Canvas,
    mosaic: Mosaic,
    /// For each pixel of a block.
    layers: Vec<Vec<Layer>>,
}

impl Layers<'_> {
    /// Cuts a cell until it is small enough, and draws it.
    fn paint(&mut self, bin: &Bin, cell: Cell, done: &mut impl FnMut(Cell, (usize, usize), &mut Vec<Layer>)) {
        if cell.width <= SIDE {
            self.draw(bin, cell, done);
            return;
        }
        let (mut cuts, mut bins) = (Cuts::default(), Vec::new());
        cuts.even(cell, SIDE);
        self.mosaic.split(self.scene, bin, cell, &cuts, &mut bins);
        for (piece, bin) in cuts.cells().zip(&bins) {
            self.paint(bin, piece, done);
        }
    }

    fn draw(&mut self, bin: &Bin, cell: Cell, done: &mut impl FnMut(Cell, (usize, usize), &mut Vec<Layer>)) {
        let width = count(cell.width);
        let Self { scene, canvas, layers, .. } = self;
        layers.iter_mut().for_each(Vec::clear);
        layers.resize(width * count(cell.height), Vec::new());
        bin.draw_each(scene, cell, canvas, |label, canvas| {
            let depths = canvas.finished().flat_map(|(depths, _)| depths);
            for (layers, &depth) in layers.iter_mut().zip(depths).filter(|(_, depth)| **depth < f32::INFINITY)
            {
                layers.push((depth, label.0));
            }
        });
        for (index, layers) in layers.iter_mut().enumerate().filter(|(_, layers)| !layers.is_empty()) {
            done(cell, (index % width, index / width), layers);
        }
    }
}
