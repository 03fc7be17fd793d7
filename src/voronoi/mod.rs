//! Nets → Voronoi regions → a planar graph of boundaries → smooth exact paths (the paper's §III-B
//! to III-D).
//!
//! ```text
//! Copper, Nets ─ certified ─▶ Diagram ─ chain, level ─▶ chains ─ clip ─▶ pieces ─ fit ─▶ Boundaries
//!       │                        │                         │
//!       │                        │                  edge: where the board ends
//!       │                        ╰── wide ──▶ passes beside the cut, what they leave, links
//!       ╰─ cones ── raster ──▶ pictures of the regions
//! ```
//!
//! Everything that is cut comes from the certified diagram of [`exact`], which no pixel has a part
//! in: boundaries between nets are its edges between owners; the loops round nets whose regions
//! have a limit, and passes beside a cut, are level sets of its clearance, for which one walk of
//! the copper's free space does ([`walked`](self)); what passes leave is found along its medial
//! axis; between core axes it is a diagram of these, which the copper's [`band`](self) overrules.
//! Loops round some nets and not others cut the board into fields with a diagram each.
//!
//! The rasterizer draws the same regions from cones and curtains, tile by tile, for whoever looks
//! at them. The two share no code: that they agree, pixel for pixel and on both sides of each
//! boundary, is a test on all layers of the corpus (`tests/it/certified_boundaries.rs`).

mod band;
mod boundary;
mod certified;
mod clip;
mod cones;
mod edge;
pub mod exact;
mod fit;
mod frame;
mod junction;
mod measure;
pub mod medial;
mod mixed;
pub mod paper;
mod part;
mod plane;
mod regions;
mod sample;
mod sliver;
mod walked;
mod wide;

use std::borrow::Cow;
use std::sync::{Arc, Mutex};

use crate::board::diagnostic::planning;
use crate::board::{Copper, Outline, Side, Warning};
use crate::geometry::{Nm, Path, Point, Rect};
use crate::topology::{NetId, Nets};

pub use fit::fit_points;
pub use frame::Frame;
pub use mixed::Loops;
pub use regions::Regions;
pub use wide::{Clearing, Link, Widening};

use band::Band;
use certified::Owned;
use edge::Border;
use mixed::Mixed;
use walked::{Certified, Walked};

/// The owner number of nothing at all.
const BACKGROUND: u32 = 0;
/// The owner number of what lies beyond the border.
const OUTSIDE: u32 = 1;

/// The number of nobody among the owners of the certified diagram.
const NOBODY: u32 = u32::MAX;

/// How far beyond the reach of regions the wall round everything stands. Chosen.
const BEYOND: Nm = Nm::from_um(100);
/// Slits of one net that are narrower than twice this are not walked: no cutter fits. Chosen.
const FLOOR: Nm = Nm::from_um(10);
/// No region reaches farther. Chosen.
const FARTHEST: Nm = Nm::from_mm(10_000);

/// What lies on one side of a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Owner {
    /// Nothing within the limit.
    Background,
    /// Beyond the board's edge or the frame.
    Outside,
    /// The region of a net.
    Net(NetId),
}

impl Owner {
    const fn from_number(number: u32) -> Self {
        match number {
            BACKGROUND => Self::Background,
            OUTSIDE => Self::Outside,
            net => Self::Net(NetId(net - 2)),
        }
    }

    const fn number(self) -> u32 {
        match self {
            Self::Background => BACKGROUND,
            Self::Outside => OUTSIDE,
            Self::Net(NetId(net)) => net + 2,
        }
    }
}

/// A node of the boundary graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u32);

/// An edge of the boundary graph, to be cut once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Boundary {
    /// The way, from node to node (or closed).
    pub path: Path,
    /// The distance to the nearest copper at each vertex of `path`: the start, then the end of each
    /// segment. Between vertices it is never less than at the nearer end by more than the fitting
    /// tolerance.
    pub clearance: Vec<Nm>,
    /// The region on its left.
    pub left: Owner,
    /// The region on its right.
    pub right: Owner,
    /// The nodes it begins and ends at; none for a loop without a node.
    pub ends: Option<(NodeId, NodeId)>,
}

impl Boundary {
    /// Whether it runs along the edge of the board or the frame, and so isolates nothing.
    #[must_use]
    pub fn is_border(&self) -> bool {
        self.left == Owner::Outside || self.right == Owner::Outside
    }

    /// Whether there is a side that nobody owns: it runs at the limit of regions.
    #[must_use]
    pub fn is_bare(&self) -> bool {
        self.left == Owner::Background || self.right == Owner::Background
    }
}

/// The boundaries of one layer as a planar graph.
///
/// # Guarantees
///
/// A boundary begins and ends exactly at the points of its nodes; nodes and boundaries are in a
/// fixed order that depends on the board and the settings alone.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Boundaries {
    /// Where boundaries meet or end.
    pub nodes: Vec<Point>,
    /// The edges.
    pub edges: Vec<Boundary>,
    /// Ways between passes on which the cutter may stay down: none where nothing was widened.
    pub links: Vec<Link>,
}

/// What one of several tools cuts.
#[derive(Clone, Debug)]
pub struct Share<'a> {
    /// How wide it cuts, at the surface.
    pub kerf: Nm,
    /// How wide at the bottom of the copper.
    pub floor: Nm,
    /// Along what.
    pub cuts: Cow<'a, Boundaries>,
}

/// What distances are measured to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SiteKind {
    /// The true edges of the copper.
    #[default]
    Copper,
    /// The paper's approximate core medial axes: flash centres and stroke axes (§III-D).
    Core,
}

/// How boundaries are found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The side of a pixel of pictures of the regions.
    pub pitch: Nm,
    /// What distances are measured to.
    pub sites: SiteKind,
    /// Between which distances from copper passes will run ([`Diagram::widened`]), if that is
    /// known: then what is walked for the boundaries serves them, too.
    pub passes: Option<[Nm; 2]>,
    /// How far regions reach (§III-D.1); none for as far as there is room. The outline strategy is
    /// `copper` sites with the cutter's radius here (§III-C).
    pub limit: Option<Nm>,
    /// Whether regions with a limit, and further passes, end in space that one net alone encloses,
    /// too, where nothing is to be isolated. The paper's outlines do.
    pub enclosed: bool,
    /// With [`SiteKind::Core`], what every region holds at least: its net's copper (§III-D.2),
    /// fattened by so much (§III-C), but no more than half of the gap; none for no such minimum.
    pub min_width: Option<Nm>,
    /// How far a fitted path may leave the true boundary.
    pub tolerance: Nm,
    /// Whether paths may have arcs.
    pub arcs: bool,
    /// The clearances between which the tool rises as they fall, if it does: there clearance goes
    /// evenly from vertex to vertex.
    pub rises: Option<[Nm; 2]>,
    /// How far boundaries run out beyond the outline.
    pub overlap: Nm,
    /// What boundaries run out to where no outline is known.
    pub frame: Frame,
}

impl Settings {
    /// The edges that level sets need where copper is farther away than `floor`.
    const fn kind(&self, floor: Nm) -> exact::Kind {
        if self.enclosed { exact::Kind::Above(floor) } else { exact::Kind::Between(floor) }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            pitch: Nm::new(25_400),
            sites: SiteKind::Copper,
            passes: None,
            limit: None,
            enclosed: true,
            min_width: Some(Nm::ZERO),
            tolerance: Nm::from_um(2),
            arcs: true,
            rises: None,
            overlap: Nm::from_um(100),
            frame: Frame::Rectangle(Nm::from_mm(1)),
        }
    }
}

/// Why no boundaries were found.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// There is nothing to isolate on the board.
    #[error(
        "there is no copper, or none within the board's outline: is the outline from another board, or in other units?"
    )]
    NoCopper,
    /// Boundaries do not go on as they should.
    #[error(
        "{count} ends of the boundaries between nets are dangling, the first at ({:.3}, {:.3}): a bug in voromill",
        at.x, at.y
    )]
    Torn {
        /// How many ends.
        count: usize,
        /// The first of them.
        at: Point,
    },
}

/// The Voronoi diagram of a layer.
pub struct Diagram {
    border: Border,
    settings: Settings,
    side: Side,
    /// The box round all copper.
    copper: Rect,
    warnings: Vec<Warning>,
    /// What makes it one of loops and of boundaries midway, where nets differ.
    mixed: Option<Box<Mixed>>,
    /// The certified diagram of the sites.
    certified: Arc<exact::Diagram>,
    /// Its chains, where they had to be found to certify it, until they are asked for.
    found: Mutex<Option<Vec<exact::Chain>>>,
    /// What has been walked of the copper's free space.
    walked: Mutex<Option<Walked>>,
    /// What belongs to the copper's nets whatever core axes say.
    band: Option<Box<Band>>,
    /// Whether each net has anything on the board.
    kept: Vec<bool>,
}

impl Diagram {
    /// The diagram of the nets of `copper` on a board with this `outline`, if one is known.
    ///
    /// Nets that lie beyond the outline altogether are left aside, with a warning.
    ///
    /// # Errors
    ///
    /// [`Error`] where there is nothing to draw or it would be too large.
    pub fn new(
        copper: &Copper,
        nets: &Nets,
        outline: Option<&Outline>,
        settings: &Settings,
    ) -> Result<Self, Error> {
        let bounds = copper.bounds().ok_or(Error::NoCopper)?;
        let border = Border::new(outline, copper, bounds, settings);
        let aside = nets_beyond(copper, nets, &border);
        let warnings = aside.iter().map(|&(net, at)| {
            let message = format!("{} lies outside the board's outline and is ignored", nets.label(net));
            planning::COPPER_OUTSIDE_BOARD.warning(message).at(at).on(copper.side)
        });
        let warnings = warnings.collect();
        if aside.len() == nets.nets().len() {
            return Err(Error::NoCopper);
        }
        let mut kept = vec![true; nets.nets().len()];
        aside.iter().for_each(|(net, _)| kept[net.index()] = false);
        let diagram = Self::within(border, copper, nets, settings, kept)?;
        Ok(Self { warnings, ..diagram })
    }

    /// The diagram, within `border`, of those nets that are `kept`.
    fn within(
        border: Border,
        copper: &Copper,
        nets: &Nets,
        settings: &Settings,
        kept: Vec<bool>,
    ) -> Result<Self, Error> {
        let keep = |feature: usize| kept[nets.of(feature).index()];
        let bounds = copper.bounds().unwrap_or(border.window);
        let owned = match settings.sites {
            SiteKind::Copper => Owned::copper(copper, nets, keep),
            SiteKind::Core => Owned::axes(copper, nets, keep),
        };
        let board = border.bounds().unwrap_or(border.window);
        let Certified { diagram: certified, found, walked } = Certified::new(&owned, settings, bounds, board);
        let mut band = None;
        // Nothing parts one net from itself, but its loop goes round its copper, too.
        let is_cut = settings.limit.is_some() || !owned.is_of_one();
        let width = settings.min_width.map(Band::width).filter(|_| is_cut);
        if let (SiteKind::Core, Some(width)) = (settings.sites, width) {
            let (room, floor) = Band::room(width);
            let copper = Owned::copper(copper, nets, keep);
            let wall = Some(bounds.inflate(room));
            let edges = |diagram: &exact::Diagram| diagram.limited_chains(width.to_f64(), NOBODY, true);
            let (copper, edges) =
                copper.diagram(exact::Kind::Above(floor), exact::Space::Within, wall, edges);
            band = Some(Box::new(Band::new(copper, width, edges.unwrap_or_default())));
        }
        Ok(Self {
            border,
            settings: settings.clone(),
            side: copper.side,
            copper: bounds,
            warnings: Vec::new(),
            mixed: None,
            certified,
            found: Mutex::new(found),
            walked: Mutex::new(walked),
            band,
            kept,
        })
    }

    /// What was left aside.
    #[must_use]
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// One lap round the frame, where no outline is known.
    #[must_use]
    pub const fn frame(&self) -> Option<&Path> {
        self.border.frame.as_ref()
    }

    /// The regions, for pictures.
    #[must_use]
    pub fn regions(&self) -> Regions {
        let parts = self.mixed.as_ref().map(|mixed| Box::new(mixed.parts()));
        let (border, settings, kept) = (self.border.clone(), self.settings.clone(), self.kept.clone());
        Regions { border, settings, kept, parts }
    }

    /// The boundaries between all regions.
    ///
    /// # Errors
    ///
    /// [`Error::Torn`] where they contradict each other: nets might stay joined there.
    pub fn boundaries(&self) -> Result<Boundaries, Error> {
        if let Some(mixed) = &self.mixed {
            return mixed.boundaries(self);
        }
        let (boundaries, faults) = self.certified_boundaries();
        match faults.first() {
            None => Ok(boundaries),
            Some(&at) => Err(Error::Torn { count: faults.len(), at }),
        }
    }
}

/// A fitted path with its clearance, the numbers of the owners on its left and right, and whether
/// it is a loop.
type Fitted = ((Path, Vec<Nm>), (u32, u32), bool);

impl Boundaries {
    /// The graph of fitted paths, with nodes in the order in which they are met.
    fn of(fitted: Vec<Fitted>) -> Self {
        let mut numbers = rustc_hash::FxHashMap::default();
        let mut nodes = Vec::new();
        let mut node = |at: Point| {
            *numbers.entry(at).or_insert_with(|| {
                nodes.push(at);
                NodeId(u32::try_from(nodes.len() - 1).expect("below 2³² nodes"))
            })
        };
        let edge = |((path, clearance), (left, right), is_loop): Fitted| {
            let ends = (!is_loop).then(|| (node(path.start), node(path.end())));
            let (left, right) = (Owner::from_number(left), Owner::from_number(right));
            Boundary { path, clearance, left, right, ends }
        };
        let edges = fitted.into_iter().map(edge).collect();
        Self { nodes, edges, links: Vec::new() }
    }
}

/// The nets of which nothing lies on the board, each with a place.
fn nets_beyond(copper: &Copper, nets: &Nets, border: &Border) -> Vec<(NetId, Point)> {
    let mut on_board = vec![false; nets.nets().len()];
    let outlined = border.frame.is_none();
    for (i, feature) in copper.features.iter().enumerate() {
        let net = nets.of(i).index();
        on_board[net] = on_board[net] || !outlined || border.has_some_of(&feature.shape);
    }
    let beyond = (0_u32..).zip(nets.nets()).filter(|(id, _)| !on_board[NetId(*id).index()]);
    beyond
        .map(|(id, net)| (NetId(id), middle(copper.features[net.features[0] as usize].shape.bounds())))
        .collect()
}

fn middle(rect: Rect) -> Point {
    rect.min().midpoint(rect.max())
}
