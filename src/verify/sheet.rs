//! The copper-clad sheet and what is cut out of it: exact shapes, and pictures of parts of it.

use std::borrow::Cow;
use std::sync::OnceLock;

use crate::board::{Board, Copper, FLATTEN, Shape, Side, polarity};
use crate::geometry::{Nm, Point, Polygon, Rect, RectIndex};
use crate::grid::Grid;
use crate::raster::{Buffers, FillRule, Label, Scene, Surface, render};
use crate::topology::{Method, NetId, Nets, Proximity, recover, surface};

use super::asked::Asked;
use super::cut::Cut;
use super::machining::{Kerf, Machining, with_radius};
use super::walls::Walls;
use super::{Error, Settings};

/// Beyond the board's outline. What no label covers is clad that belongs to no net.
pub(super) const OUTSIDE: u32 = 1;
/// Cut away.
pub(super) const CUT: u32 = 2;
/// The label of the first net. Where several surfaces cover a pixel the smallest label wins.
pub(super) const NETS: u32 = 3;

/// One side of the board, clad all over, and what programs cut out of it.
pub(super) struct Sheet<'a> {
    pub(super) side: Side,
    pub(super) copper: &'a Copper,
    pub(super) nets: Cow<'a, Nets>,
    /// Where the copper is.
    pub(super) proximity: Proximity,
    /// All that is cut, program by program in order.
    pub(super) cuts: Vec<Cut<'a>>,
    /// What bounds the copper that is left.
    pub(super) walls: Walls<'a>,
    /// Half the narrowest kerf.
    pub(super) half: Nm,
    /// The same at the copper's bottom.
    pub(super) floor: Nm,
    /// What each tool cuts where it is deepest.
    pub(super) kerfs: Vec<Kerf>,
    /// What was to be cleared.
    pub(super) asked: Asked,
    pub(super) places: Places,
    /// The board's edge, where it is known.
    pub(super) outline: Option<Polygon>,
    /// The pixels of its picture.
    pub(super) grid: Grid,
    /// Whether any of a feature lies on the board, once it is asked for.
    on_board: Vec<OnceLock<bool>>,
}

/// Where cuts and features lie, by their bounds.
pub(super) struct Places {
    pub(super) cuts: RectIndex,
    pub(super) features: RectIndex,
}

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Show {
    /// What is left: nets, clad, cuts, the outside.
    Left,
    /// How far it is to the way of the nearest cut, less what half its kerf at the copper's bottom
    /// has beyond half the narrowest.
    Ways,
    /// How far it is to the board's edge.
    Edge,
}

impl<'a> Sheet<'a> {
    /// `copper`, and what `programs` cut.
    pub(super) fn new(
        copper: &'a Copper,
        nets: Option<&'a Nets>,
        board: &Board,
        programs: &[&'a Machining],
        settings: &Settings,
    ) -> Result<Self, Error> {
        let nets = nets.map_or_else(|| Cow::Owned(recover(copper, Method::default())), Cow::Borrowed);
        let cuts: Vec<Cut<'a>> = Cut::all(programs).collect();
        let outline = board.outline.as_ref().map(|outline| outline.polygon(FLATTEN));
        let half = cuts.iter().map(|cut| cut.swept.half()).min().unwrap_or(Nm::from_um(100));
        let floor = cuts.iter().map(|cut| cut.swept.floor).min().unwrap_or(half);
        let mut kerfs: Vec<Kerf> =
            programs.iter().flat_map(|program| program.kerfs.iter().copied()).collect();
        kerfs.sort_unstable();
        kerfs.dedup();
        let pitch = settings.pixel.unwrap_or_else(|| pixel(half));
        let walls = Walls::new(&cuts, outline.as_ref());
        let area = area(copper, outline.as_ref(), &cuts, pitch);
        let grid = Grid::covering(area, pitch)?;
        let places = Places {
            cuts: RectIndex::new(cuts.iter().map(|cut| cut.swept.shape.bounds())),
            features: RectIndex::new(copper.features.iter().map(|feature| feature.shape.bounds())),
        };
        Ok(Self {
            side: copper.side,
            copper,
            nets,
            proximity: Proximity::new(copper),
            cuts,
            walls,
            half,
            floor,
            kerfs,
            asked: programs.iter().fold(Asked::default(), |asked, program| asked.and(&program.asked)),
            places,
            outline,
            grid,
            on_board: copper.features.iter().map(|_| OnceLock::new()).collect(),
        })
    }

    /// The pixel of its picture.
    pub(super) const fn pitch(&self) -> Nm {
        self.grid.pitch()
    }

    /// The part of the board that the picture shows.
    pub(super) fn rect(&self) -> Rect {
        self.grid.rect()
    }

    /// The board as far as it lies within `rect`.
    pub(super) fn ground(&self, rect: Rect) -> Vec<Polygon> {
        let clipped = match &self.outline {
            Some(outline) => outline.clipped(rect),
            None => Polygon::rectangle(self.rect()).clipped(rect),
        };
        clipped.map_or(Vec::new(), |clipped| polarity::clean(clipped.contours()))
    }

    /// What bounds a net.
    pub(super) fn extent(&self, net: NetId) -> Option<Rect> {
        let features = self.nets.nets()[net.index()].features.iter();
        features.map(|&feature| self.copper.features[feature as usize].shape.bounds()).reduce(Rect::union)
    }

    /// The copper of a net near `rect`; of polygons what lies within it.
    pub(super) fn within(&self, net: NetId, rect: Rect) -> impl Iterator<Item = Shape> {
        let features = self.places.features.touching(rect).into_iter();
        let own = features.filter(move |&feature| self.nets.of(feature) == net);
        own.filter_map(move |feature| match &self.copper.features[feature].shape {
            Shape::Polygon(polygon) => polygon.clipped(rect).map(Shape::Polygon),
            shape => Some(shape.clone()),
        })
    }

    /// Whether a point lies on the board.
    pub(super) fn holds(&self, p: Point) -> bool {
        self.outline.as_ref().is_none_or(|outline| outline.contains(p))
    }

    /// Whether any copper of a feature lies on the board: what lies beyond its edge altogether is
    /// not isolated, and may be cut away.
    pub(super) fn has_some_of(&self, feature: usize) -> bool {
        let Some(outline) = &self.outline else { return true };
        let shape = &self.copper.features[feature].shape;
        // Its very edge is the board's.
        let is_on_board = || outline.contains(shape.anchor()) || shape.lies_in(outline);
        *self.on_board[feature].get_or_init(is_on_board)
    }

    /// The area of so many of its pixels, in mm².
    #[expect(clippy::cast_precision_loss, reason = "a display figure")]
    pub(super) fn mm2(&self, pixels: u64) -> f64 {
        pixels as f64 * self.pitch().to_mm() * self.pitch().to_mm()
    }

    /// The net that a label stands for.
    pub(super) fn net(label: u32) -> Option<NetId> {
        label.checked_sub(NETS).map(NetId)
    }

    /// A picture of a part of it, of pixels of at least `pitch` and no more than `most` each way.
    pub(super) fn window(&self, rect: Rect, pitch: Nm, most: u32, show: &[Show]) -> (Grid, Vec<Buffers>) {
        let least = (rect.width().max(rect.height()) / i64::from(most)).get() + 1;
        let pitch = pitch.max(Nm::new(least));
        let grid = Grid::covering(rect, pitch).expect("as many pixels as asked for");
        let draw = |show: &Show| {
            let mut buffers = Buffers::new();
            render(&self.scene(&grid, *show), &mut buffers);
            buffers
        };
        (grid, show.iter().map(draw).collect())
    }

    /// What is to be drawn on `grid`.
    fn scene(&self, grid: &Grid, show: Show) -> Scene {
        let mut scene = Scene::new(grid.width(), grid.height());
        if show == Show::Left {
            for index in self.places.cuts.touching(grid.rect()) {
                scene.add(Label(CUT), surface(&self.cuts[index].swept.shape, grid, Some(0.0)));
            }
        }
        if show == Show::Ways {
            for swept in self.cuts.iter().map(|cut| cut.swept) {
                let shape = with_radius(&swept.shape, swept.floor - self.floor);
                scene.add(Label(CUT), surface(&shape, grid, None));
            }
        }
        if show == Show::Left {
            for index in self.places.features.touching(grid.rect()) {
                let label = Label(NETS + self.nets.of(index).0);
                scene.add(label, surface(&self.copper.features[index].shape, grid, Some(0.0)));
            }
        }
        if let Some(outline) = &self.outline {
            self.edge(outline, grid, show, &mut scene);
        }
        scene
    }

    /// The outside as an area, or the edge as what distances are counted from.
    fn edge(&self, outline: &Polygon, grid: &Grid, show: Show, scene: &mut Scene) {
        match show {
            Show::Ways => {}
            Show::Edge => {
                for (from, to) in outline.edges() {
                    let edge = Shape::Stroke { from, to, radius: Nm::ZERO };
                    scene.add(Label(OUTSIDE), surface(&edge, grid, None));
                }
            }
            Show::Left => {
                let around = grid.rect().union(outline.bounds()).inflate(grid.pitch() * 4);
                let mut contours = vec![around.corners().to_vec()];
                contours.extend(outline.contours().iter().cloned());
                let pixels =
                    contours.iter().map(|ring| ring.iter().map(|&p| grid.pixel(p)).collect()).collect();
                let rule = FillRule::EvenOdd;
                scene.add(Label(OUTSIDE), Surface::Polygon { contours: pixels, rule, depth: 0.0 });
            }
        }
    }
}

/// A quarter of the narrowest kerf, so that a cut that is drawn narrower is still a wall without
/// doors, within 5 µm to 25 µm.
pub(super) fn pixel(half: Nm) -> Nm {
    (half / 2).max(Nm::from_um(5)).min(Nm::from_um(25))
}

/// The sheet: the board, or without an outline all copper and cuts and a rim round them, which is
/// clad and conducts.
fn area(copper: &Copper, outline: Option<&Polygon>, cuts: &[Cut<'_>], pitch: Nm) -> Rect {
    if let Some(outline) = outline {
        return outline.bounds().inflate(pitch * 2);
    }
    let features = copper.features.iter().map(|feature| feature.shape.bounds());
    let all = features.chain(cuts.iter().map(|cut| cut.swept.shape.bounds())).reduce(Rect::union);
    all.unwrap_or(Rect::new(Point::default(), Point::default())).inflate(Nm::from_mm(1))
}
