//! What a caller says of a primitive: fill rule, caps, offset and limit.

use super::PixelPoint;

/// Which points contours enclose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FillRule {
    /// Those they wind round.
    NonZero,
    /// Those they wind round an odd number of times.
    EvenOdd,
}

/// Which ends of a curve are round: a cone's part each.
///
/// ```text
///            ┆ strip  ┆
///     start  ┆        ┆  end
///      cap  from ──── to  cap
///            ┆        ┆
/// ```
///
/// With [`Caps::Start`] on every edge, a closed chain needs one primitive an edge and leaves no
/// gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Caps {
    /// Neither: the strip alone.
    None,
    /// What lies before the start, too.
    Start,
    /// What lies beyond the end, too.
    End,
    /// All round: the distance to the curve.
    Both,
}

impl Caps {
    pub(super) const fn start(self) -> bool {
        matches!(self, Self::Start | Self::Both)
    }

    pub(super) const fn end(self) -> bool {
        matches!(self, Self::End | Self::Both)
    }

    pub(super) const fn reversed(self) -> Self {
        match self {
            Self::None => Self::None,
            Self::Start => Self::End,
            Self::End => Self::Start,
            Self::Both => Self::Both,
        }
    }
}

/// On which sides of its directed segment a curtain hangs. A point on the line belongs to both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sides {
    /// On both.
    Both,
    /// To the left of one who walks from `from` to `to` on the picture: above a curtain that runs
    /// to the right.
    Left,
    /// To the right.
    Right,
}

/// Which way an arc runs, as seen on the picture (x right, y down).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Spin {
    /// With the clock: from +x (right) to +y (down).
    Clockwise,
    /// Against it.
    CounterClockwise,
}

/// A surface over the pixel plane: which pixels it covers, and how deep it lies there.
///
/// Distances are in pixels. A distance surface lies at max(0, d − `offset`), where d is the
/// distance to its curve: a stroke of half-width r is the curve with offset r. Where that depth
/// exceeds `limit`, it has no fragment.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// Flat at `depth` wherever the contours enclose the sample (each closed from its last point to
    /// its first). A sample on an edge is inside on a left or top edge and outside on a right or
    /// bottom one.
    ///
    /// ```
    /// # use voromill::raster::*;
    /// # let p = PixelPoint::from_f64;
    /// let mut scene = Scene::new(6, 4);
    /// let triangle = vec![p(0.0, 0.0), p(6.0, 0.0), p(0.0, 4.0)];
    /// scene.add(Label(1), Surface::Polygon { contours: vec![triangle], rule: FillRule::NonZero, depth: 0.0 });
    /// # let mut picture = Buffers::new();
    /// # render(&scene, &mut picture);
    /// # let rows: Vec<String> = picture.labels().chunks(6).map(|row| row.iter().map(|&l| if l > 0 { '#' } else { '.' }).collect()).collect();
    /// assert_eq!(rows, ["#####.", "####..", "##....", "#....."]);
    /// ```
    Polygon {
        /// Closed rings of points; those of fewer than three points enclose nothing.
        contours: Vec<Vec<PixelPoint>>,
        /// What they enclose.
        rule: FillRule,
        /// How deep.
        depth: f32,
    },
    /// A triangle whose depth runs evenly between its corners. Covers as a polygon does, either way
    /// round.
    ///
    /// ```
    /// # use voromill::raster::*;
    /// # let p = PixelPoint::from_f64;
    /// let mut scene = Scene::new(6, 1);
    /// scene.add(Label(1), Surface::Triangle { corners: [p(0.0, 0.0), p(8.0, 0.0), p(0.0, 8.0)], depths: [0.0, 8.0, 0.0] });
    /// # let mut picture = Buffers::new();
    /// # render(&scene, &mut picture);
    /// assert_eq!(picture.depths(), [0.5, 1.5, 2.5, 3.5, 4.5, 5.5], "as deep as they are to the right");
    /// ```
    Triangle {
        /// Its corners.
        corners: [PixelPoint; 3],
        /// The depth at each.
        depths: [f32; 3],
    },
    /// The distance to a point.
    ///
    /// ```
    /// # use voromill::raster::*;
    /// # let p = PixelPoint::from_f64;
    /// let mut scene = Scene::new(5, 1);
    /// scene.add(Label(1), Surface::Cone { apex: p(2.5, 0.5), offset: 0.5, limit: Some(1.0) });
    /// # let mut picture = Buffers::new();
    /// # render(&scene, &mut picture);
    /// assert_eq!(picture.depths(), [f32::INFINITY, 0.5, 0.0, 0.5, f32::INFINITY], "half a pixel thick");
    /// ```
    Cone {
        /// The point.
        apex: PixelPoint,
        /// Subtracted from the distance.
        offset: f32,
        /// Nothing is drawn deeper.
        limit: Option<f32>,
    },
    /// The distance to a segment.
    ///
    /// ```
    /// # use voromill::raster::*;
    /// # let p = PixelPoint::from_f64;
    /// let mut scene = Scene::new(6, 5);
    /// let (from, to) = (p(2.5, 2.5), p(4.5, 2.5));
    /// let (caps, sides) = (Caps::None, Sides::Both);
    /// scene.add(Label(1), Surface::Curtain { from, to, caps, sides, offset: 0.0, limit: Some(1.5) });
    /// # let mut picture = Buffers::new();
    /// # render(&scene, &mut picture);
    /// # let rows: Vec<String> = picture.labels().chunks(6).map(|row| row.iter().map(|&l| if l > 0 { '#' } else { '.' }).collect()).collect();
    /// assert_eq!(rows, ["......", "..###.", "..###.", "..###.", "......"], "its strip");
    /// ```
    Curtain {
        /// Where it starts.
        from: PixelPoint,
        /// Where it ends.
        to: PixelPoint,
        /// Its round ends.
        caps: Caps,
        /// Its sides.
        sides: Sides,
        /// Subtracted from the distance.
        offset: f32,
        /// Nothing is drawn deeper.
        limit: Option<f32>,
    },
    /// The distance to a circular arc; the whole circle where `start` = `end`.
    ///
    /// The radius is the mean of the two that the end points give. The strip of an arc is its
    /// sector.
    ///
    /// ```
    /// # use voromill::raster::*;
    /// # let p = PixelPoint::from_f64;
    /// let mut scene = Scene::new(7, 7);
    /// let (center, start) = (p(3.5, 3.5), p(6.5, 3.5));
    /// let (spin, caps) = (Spin::Clockwise, Caps::None);
    /// scene.add(Label(1), Surface::Ring { center, start, end: start, spin, caps, offset: 0.0, limit: Some(0.5) });
    /// # let mut picture = Buffers::new();
    /// # render(&scene, &mut picture);
    /// # let rows: Vec<String> = picture.labels().chunks(7).map(|row| row.iter().map(|&l| if l > 0 { '#' } else { '.' }).collect()).collect();
    /// assert_eq!(rows, ["..###..", ".#...#.", "#.....#", "#.....#", "#.....#", ".#...#.", "..###.."], "a circle");
    /// ```
    Ring {
        /// The point it runs round.
        center: PixelPoint,
        /// Where it starts.
        start: PixelPoint,
        /// Where it ends.
        end: PixelPoint,
        /// Which way.
        spin: Spin,
        /// Its round ends.
        caps: Caps,
        /// Subtracted from the distance.
        offset: f32,
        /// Nothing is drawn deeper.
        limit: Option<f32>,
    },
}
