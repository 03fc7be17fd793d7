//! Distances to the copper of nets by an index of its own: square cells, each with the edges that
//! reach into it.
//!
//! It shares nothing with the program's index but the features themselves: outlines are taken apart
//! into bars (lines with a radius), cells are looked at in growing squares round a point, and what
//! lies inside a polygon is told by counting edges.

use voromill::board::{Copper, Shape};
use voromill::geometry::{Nm, Point, Polygon, Rect};
use voromill::topology::{NetId, Nets};

/// A position in nanometres.
pub(crate) type Spot = [f64; 2];

/// All points within `radius` of the line from `a` to `b`, and whose they are.
struct Bar {
    a: Spot,
    b: Spot,
    radius: f64,
    net: NetId,
}

/// A polygon, its edges by the horizontal bands that they reach into.
struct Area {
    net: NetId,
    bounds: Rect,
    bands: Vec<Vec<(Point, Point)>>,
}

/// What of the copper reaches into a cell.
#[derive(Default)]
struct Cell {
    bars: Vec<u32>,
    areas: Vec<u32>,
}

/// The copper of a layer by place.
pub(crate) struct Field {
    bars: Vec<Bar>,
    areas: Vec<Area>,
    cells: Vec<Cell>,
    columns: i64,
    rows: i64,
    origin: Spot,
    side: f64,
}

/// A distance in nanometres, zero on copper, and the unit vector away from what is nearest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    pub(crate) distance: f64,
    pub(crate) away: Spot,
}

/// How far two nets are from a point, and how far whatever other is nearest: none where that is
/// farther than both.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub(crate) two: [Reach; 2],
    pub(crate) other: Option<Reach>,
}

const NOWHERE: Reach = Reach { distance: f64::INFINITY, away: [0.0, 0.0] };
/// Bands of a polygon: chosen, so that a plane of ten thousand edges has some tens in each.
const BANDS: i64 = 512;

#[expect(clippy::cast_possible_truncation, reason = "positions on a board, over the side of a cell")]
fn whole(x: f64) -> i64 {
    x.floor() as i64
}

#[expect(clippy::cast_precision_loss, reason = "a count of cells")]
fn real(n: i64) -> f64 {
    n as f64
}

fn spot(p: Point) -> Spot {
    p.to_f64().into()
}

/// An edge of a polygon; where it is a chord within a quarter of a micrometre of a circle that the
/// polygon remembers, as points on that, ten times as many: their chords leave it by a hundredth.
fn curve(polygon: &Polygon, a: Point, b: Point) -> Vec<Point> {
    let mut bows = polygon.circles().iter().filter_map(|circle| {
        let (center, radius) = (spot(circle.center), circle.radius.to_f64());
        let is_on = |p: Point| (circle.center.distance(p) - radius).abs() <= 2.0;
        let half = a.distance(b) / 2.0;
        let is_near = half < radius && radius - (radius * radius - half * half).sqrt() <= 252.0;
        (is_on(a) && is_on(b) && is_near).then_some((center, radius))
    });
    let Some((center, radius)) = bows.next() else { return vec![a, b] };
    let between = (1..10_i32).map(|i| {
        let way = [0, 1].map(|axis| {
            let (from, to) = (spot(a)[axis], spot(b)[axis]);
            from + (to - from) * f64::from(i) / 10.0 - center[axis]
        });
        let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
        Point::from_f64(center[0] + way[0] / length * radius, center[1] + way[1] / length * radius)
    });
    std::iter::once(a).chain(between).chain([b]).collect()
}

impl Field {
    /// The index of a layer that has copper.
    pub(crate) fn new(copper: &Copper, nets: &Nets) -> Self {
        let bounds = copper.bounds().expect("copper");
        let (width, height) = (bounds.width().to_f64(), bounds.height().to_f64());
        let edges: usize = copper.features.iter().map(|feature| edge_count(&feature.shape)).sum();
        let edges = f64::from(u32::try_from(edges).expect("below 2³² edges"));
        let side = (width * height / edges).sqrt().clamp(width.max(height) / 2048.0, 1e6).max(1e4);
        let (columns, rows) = (whole(width / side) + 1, whole(height / side) + 1);
        let mut cells = Vec::new();
        cells.resize_with(usize::try_from(columns * rows).expect("a few million cells"), Cell::default);
        let origin = spot(bounds.min());
        let mut field = Self { bars: Vec::new(), areas: Vec::new(), cells, columns, rows, origin, side };
        for (i, feature) in copper.features.iter().enumerate() {
            field.add(&feature.shape, nets.of(i));
        }
        field
    }

    fn add(&mut self, shape: &Shape, net: NetId) {
        match shape {
            Shape::Disc { center, radius } => self.add_bar(*center, *center, *radius, net),
            Shape::Stroke { from, to, radius } => self.add_bar(*from, *to, *radius, net),
            Shape::Arc { arc, radius } => {
                let points: Vec<_> = std::iter::once(arc.start).chain(arc.flatten(Nm::new(5))).collect();
                points.windows(2).for_each(|pair| self.add_bar(pair[0], pair[1], *radius, net));
            }
            Shape::Polygon(polygon) => {
                for (a, b) in polygon.edges() {
                    let points = curve(polygon, a, b);
                    points.windows(2).for_each(|pair| self.add_bar(pair[0], pair[1], Nm::ZERO, net));
                }
                self.add_area(polygon, net);
            }
        }
    }

    fn add_bar(&mut self, a: Point, b: Point, radius: Nm, net: NetId) {
        let bar = Bar { a: spot(a), b: spot(b), radius: radius.to_f64(), net };
        let number = u32::try_from(self.bars.len()).expect("below 2³² bars");
        // A long bar goes in piece by piece, or a slanted one would fill its whole box.
        let pieces = whole(a.distance(b) / self.side) + 1;
        let along = |k: i64| {
            let t = real(k) / real(pieces);
            [0, 1].map(|i| bar.a[i] + (bar.b[i] - bar.a[i]) * t)
        };
        for k in 0..pieces {
            let (from, to) = (along(k), along(k + 1));
            let low = [0, 1].map(|i| from[i].min(to[i]) - bar.radius - 1.0);
            let high = [0, 1].map(|i| from[i].max(to[i]) + bar.radius + 1.0);
            self.each_cell(low, high, |cell| {
                if cell.bars.last() != Some(&number) {
                    cell.bars.push(number);
                }
            });
        }
        self.bars.push(bar);
    }

    fn add_area(&mut self, polygon: &Polygon, net: NetId) {
        let bounds = polygon.bounds();
        let number = u32::try_from(self.areas.len()).expect("below 2³² areas");
        self.each_cell(spot(bounds.min()), spot(bounds.max()), |cell| cell.areas.push(number));
        let mut area = Area { net, bounds, bands: Vec::new() };
        area.bands.resize_with(usize::try_from(BANDS).expect("a few"), Vec::new);
        for (a, b) in polygon.edges() {
            let (low, high) = (area.band(a.y.min(b.y)), area.band(a.y.max(b.y)));
            area.bands[low..=high].iter_mut().for_each(|band| band.push((a, b)));
        }
        self.areas.push(area);
    }

    fn each_cell(&mut self, low: Spot, high: Spot, mut visit: impl FnMut(&mut Cell)) {
        let ([x0, y0], [x1, y1]) = (self.cell(low), self.cell(high));
        for y in y0.max(0)..=y1.min(self.rows - 1) {
            for x in x0.max(0)..=x1.min(self.columns - 1) {
                visit(&mut self.cells[usize::try_from(y * self.columns + x).expect("on the board")]);
            }
        }
    }

    /// Column and row of the cell that holds `p`, wherever that is.
    fn cell(&self, p: Spot) -> [i64; 2] {
        [0, 1].map(|i| whole((p[i] - self.origin[i]) / self.side))
    }

    /// The distances from `p` to two nets, and to the nearest of the others where that comes nearer
    /// than the farther of the two.
    pub(crate) fn see(&self, p: Spot, pair: [NetId; 2]) -> Seen {
        let mut seen = [NOWHERE; 3];
        let [column, row] = self.cell(p);
        let last = [column, self.columns - 1 - column, row, self.rows - 1 - row].map(i64::abs);
        let last = last.into_iter().max().unwrap_or(0);
        for ring in 0..=last {
            if real(ring - 1) * self.side > seen[0].distance.max(seen[1].distance) {
                break;
            }
            for y in (row - ring).max(0)..=(row + ring).min(self.rows - 1) {
                // Inside the ring only its two sides are new.
                let step = if (y - row).abs() == ring || ring == 0 { 1 } else { 2 * ring };
                let mut x = column - ring;
                while x <= column + ring {
                    if (0..self.columns).contains(&x) {
                        let cell = usize::try_from(y * self.columns + x).expect("on the board");
                        self.look(&self.cells[cell], p, pair, &mut seen);
                    }
                    x += step;
                }
            }
        }
        let [first, second, other] = seen;
        let farther = first.distance.max(second.distance);
        Seen { two: [first, second], other: (other.distance < farther).then_some(other) }
    }

    fn look(&self, cell: &Cell, p: Spot, pair: [NetId; 2], seen: &mut [Reach; 3]) {
        let slot = |net: NetId| pair.iter().position(|&other| other == net).unwrap_or(2);
        for &bar in &cell.bars {
            let bar = &self.bars[bar as usize];
            let reach = bar.reach(p);
            if reach.distance < seen[slot(bar.net)].distance {
                seen[slot(bar.net)] = reach;
            }
        }
        for &area in &cell.areas {
            let area = &self.areas[area as usize];
            let nearest = &mut seen[slot(area.net)];
            if nearest.distance > 0.0 && area.holds(Point::from_f64(p[0], p[1])) {
                nearest.distance = 0.0;
            }
        }
    }
}

impl Bar {
    fn reach(&self, p: Spot) -> Reach {
        let way = [self.b[0] - self.a[0], self.b[1] - self.a[1]];
        let from = [p[0] - self.a[0], p[1] - self.a[1]];
        let squared = way[0] * way[0] + way[1] * way[1];
        let along = from[0] * way[0] + from[1] * way[1];
        let t = if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { 0.0 };
        let off = [from[0] - way[0] * t, from[1] - way[1] * t];
        let length = (off[0] * off[0] + off[1] * off[1]).sqrt();
        let away = if length > 0.0 { off.map(|part| part / length) } else { [0.0, 0.0] };
        Reach { distance: (length - self.radius).max(0.0), away }
    }
}

impl Area {
    fn band(&self, y: Nm) -> usize {
        let height = self.bounds.height().get().max(1);
        let band = (y - self.bounds.min().y).get() * BANDS / height;
        usize::try_from(band.clamp(0, BANDS - 1)).expect("a band")
    }

    /// Whether `p` lies inside, by the non-zero rule: how often the edges to its right wind round
    /// it.
    fn holds(&self, p: Point) -> bool {
        if !self.bounds.contains(p) {
            return false;
        }
        let winding = |&(a, b): &(Point, Point)| {
            let left = (b - a).cross(p - a) > 0;
            match (a.y <= p.y, b.y <= p.y) {
                (true, false) if left => 1,
                (false, true) if !left => -1,
                _ => 0,
            }
        };
        self.bands[self.band(p.y)].iter().map(winding).sum::<i32>() != 0
    }
}

fn edge_count(shape: &Shape) -> usize {
    match shape {
        Shape::Disc { .. } | Shape::Stroke { .. } => 1,
        Shape::Arc { arc, .. } => arc.chords(Nm::new(5)),
        Shape::Polygon(polygon) => polygon.contours().iter().map(Vec::len).sum(),
    }
}
