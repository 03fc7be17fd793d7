//! The paper's Figures 1 to 6, drawn of any board: how Voronoi toolpaths are found, step by step.
//!
//! Pictures are made three times as fine as they are shown, and the same bytes everywhere.
//! `examples/paper_figures.rs` writes those of `docs/figures.md`.

mod milled;
mod oblique;
mod painting;
mod regions;
mod steps;

use crate::board::{Axis, Board, Copper, Side};
use crate::geometry::{Nm, Path, Rect};
use crate::grid::GridError;
use crate::topology::{self, Method, NetId, Nets};
use crate::voronoi::{self, Diagram, Frame, Settings};

pub use oblique::Look;
pub use painting::Painting;
pub use regions::flat;

use oblique::Slopes;

/// What figures are drawn of.
#[derive(Clone, Copy, Debug)]
pub struct Subjects<'a> {
    /// A board, for Figures 1, 4, 5 and 6.
    pub board: &'a Board,
    /// Which side of it.
    pub side: Side,
    /// Strokes and flashes that share vertices, for Figure 2.
    pub shared: &'a Copper,
    /// Strokes that overlap without, for Figure 3.
    pub overlaps: &'a Copper,
}

/// A figure of the paper.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The picture's file.
    pub file: &'static str,
    /// What it shows.
    pub caption: &'static str,
    /// The picture.
    pub painting: Painting,
}

/// Why a figure cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FigureError {
    /// There is nothing to show.
    #[error("there is no copper to draw")]
    NoCopper,
    /// The picture would be too large.
    #[error("cannot draw the board: {0}")]
    Grid(#[from] GridError),
    /// There are no regions to show.
    #[error(transparent)]
    Voronoi(#[from] voronoi::Error),
}

/// How far regions of Figure 6 reach: the paper's 0.04 inches.
const LIMIT: Nm = Nm::new(1_016_000);
/// What Figures 4 and 6 show round the copper. Chosen.
const MARGIN: Nm = Nm::from_um(1200);

/// The paper's figures in their order.
///
/// # Errors
///
/// [`FigureError`] where a subject has no copper.
pub fn figures(subjects: &Subjects<'_>) -> Result<Vec<Figure>, FigureError> {
    let Subjects { board, side, shared, overlaps } = *subjects;
    let copper = board.copper(side).ok_or(FigureError::NoCopper)?;
    let nets = topology::recover(copper, Method::Contact);
    let layout = regions::layout(copper, MARGIN, 560)?;
    let of_regions = |limit, columns| regions::regions(copper, &nets, (MARGIN, limit), columns);
    let distances = [400, 800, 1200, 1600].map(Nm::from_um);
    Ok(vec![
        Figure {
            file: "figure-1.png",
            caption: "One board made three ways: etched and tinned (left), milled along outlines (middle), milled along the boundaries of Voronoi regions (right). Cuts are drawn wider than they are milled.",
            painting: three_ways(board, copper, &nets)?,
        },
        Figure {
            file: "figure-2.png",
            caption: "Algorithm 1. Strokes and flashes with their vertices, shared ones red (left); what shares a vertex is one trace (right).",
            painting: steps::shared_vertices(shared, 520)?,
        },
        Figure {
            file: "figure-3-left.png",
            caption: "Algorithm 2. Strokes end in the middle of others, so Algorithm 1 leaves them apart (left); drawn translucent, what lies on each other has a colour of its own, and is picked where the rings are (middle); then traces are whole (right).",
            painting: steps::overlaps(overlaps, 360)?,
        },
        Figure {
            file: "figure-3-right.png",
            caption: "Curves at growing distances from copper, as they are cut (blue), and what they would be if each edge were moved by itself (red): they cross themselves and each other.",
            painting: steps::offsets(overlaps, &distances, 560)?,
        },
        Figure {
            file: "figure-4.png",
            caption: "The layout (left) and the Voronoi diagram of its traces' core axes, in black (right). Neighbours have different colours: they are a colouring of the graph of neighbours.",
            painting: Painting::beside(&[layout, of_regions(None, 560)?], 24),
        },
        Figure {
            file: "figure-5.png",
            caption: "What is drawn for one trace, seen at a slant: roofs along its strokes, fans where they end and turn. The thick line is its core axis. Seen from above, without edges and light, it is the trace's region.",
            painting: one_trace(copper, &nets)?,
        },
        Figure {
            file: "figure-5-all.png",
            caption: "The same of all traces: where the slopes of two meet is the boundary between them.",
            painting: all_traces(copper, &nets)?,
        },
        Figure {
            file: "figure-6.png",
            caption: "The diagram with regions that reach 0.04 inches from the core axes at most, and the paths that are cut.",
            painting: of_regions(Some(LIMIT), 760)?,
        },
    ])
}

/// The board, or the box round its copper.
fn area(board: &Board, copper: &Copper) -> Rect {
    let bounds = board.bounds().or(copper.bounds());
    bounds.unwrap_or(Rect::new(crate::geometry::Point::default(), crate::geometry::Point::default()))
}

/// How far loops of Figure 1 run from copper. Chosen for the look.
const RADIUS: Nm = Nm::from_um(150);
/// Columns of each of its boards. Chosen for the look.
const COLUMNS: u32 = 420;

fn three_ways(board: &Board, copper: &Copper, nets: &Nets) -> Result<Painting, FigureError> {
    let lines = |limit: Option<Nm>| -> Result<Vec<Path>, FigureError> {
        let settings = Settings { limit, frame: Frame::Hull(Nm::from_um(400)), ..Settings::default() };
        let diagram = Diagram::new(copper, nets, board.outline.as_ref(), &settings)?;
        let edges = diagram.boundaries()?.edges;
        Ok(edges.into_iter().filter(|edge| !edge.is_border()).map(|edge| edge.path).collect())
    };
    let (loops, boundaries) = (lines(Some(RADIUS))?, lines(None)?);
    let draw = |made| milled::milled(board, copper, made, COLUMNS);
    let pictures = [
        draw(milled::Made::Etched)?,
        draw(milled::Made::Cut(&loops))?,
        draw(milled::Made::Cut(&boundaries))?,
    ];
    Ok(Painting::beside(&pictures, 6))
}

/// How far the slopes of Figure 5 reach, and where it is seen from. Chosen: far slopes show.
const REACH: Nm = Nm::from_um(2600);
const LOOK: Look = Look { azimuth: 24.0, elevation: 56.0 };

/// The longest trace, without planes.
fn one_trace(copper: &Copper, nets: &Nets) -> Result<Painting, FigureError> {
    let strokes = |net: &topology::Net| {
        let axes = net.features.iter().map(|&feature| copper.features[feature as usize].axis);
        axes.fold((0.0_f64, false), |(length, plane), axis| match axis {
            Axis::Line(from, to) => (length + from.distance(to), plane),
            Axis::Arc(arc) => (length + arc.length(), plane),
            Axis::Region => (length, true),
            Axis::Flash(_) => (length, plane),
        })
    };
    let traces = (0..).map(NetId).zip(nets.nets()).map(|(id, net)| (id, strokes(net)));
    let plain = traces.filter(|(_, (_, plane))| !plane);
    let longest = plain.max_by(|(a, (one, _)), (b, (other, _))| one.total_cmp(other).then(b.cmp(a)));
    let (chosen, _) = longest.ok_or(FigureError::NoCopper)?;
    let slopes = Slopes {
        copper,
        nets,
        shown: vec![(chosen, regions::LIGHT[0])],
        reach: REACH,
        edges: true,
        axis: 0.0042,
    };
    slopes.draw(LOOK, 760)
}

fn all_traces(copper: &Copper, nets: &Nets) -> Result<Painting, FigureError> {
    let frame = Frame::Rectangle(MARGIN);
    let settings = Settings { sites: voronoi::SiteKind::Core, frame, ..Settings::default() };
    let boundaries = Diagram::new(copper, nets, None, &settings)?.boundaries()?;
    let mut neighbours = vec![Vec::new(); nets.nets().len()];
    for edge in &boundaries.edges {
        if let (voronoi::Owner::Net(a), voronoi::Owner::Net(b)) = (edge.left, edge.right) {
            neighbours[a.index()].push(b.index());
            neighbours[b.index()].push(a.index());
        }
    }
    for others in &mut neighbours {
        others.sort_unstable();
        others.dedup();
    }
    let colours = super::palette::colouring(&neighbours);
    let shown = (0..).map(NetId).zip(colours);
    let shown = shown.map(|(net, colour)| (net, regions::LIGHT[colour % regions::LIGHT.len()])).collect();
    Slopes { copper, nets, shown, reach: REACH, edges: false, axis: 0.0028 }.draw(LOOK, 900)
}

/// `docs/figures.md`: each figure with what it shows, and a checksum of its pixels.
#[must_use]
pub fn page(figures: &[Figure]) -> String {
    let mut text = PREFACE.to_owned();
    for figure in figures {
        let name = figure.file.trim_end_matches(".png").replace("figure-", "Figure ").replace('-', ", ");
        let Painting { width, .. } = figure.painting;
        let height = figure.painting.height();
        text.push_str(&format!(
            "\n## {name}\n\n![{name}](pictures/paper/{})\n\n{}\n\n{width} × {height} pixels, checksum `{:016x}`\n",
            figure.file,
            figure.caption,
            figure.painting.checksum()
        ));
    }
    text
}

const PREFACE: &str = "\
# The paper's figures, again

The figures of [VIsolate](../README.md), drawn by voromill from boards of its own: how Voronoi toolpaths are found, step by step. This page and its
pictures are written by `cargo run --release --example paper_figures` and held by a test (`tests/it/figures.rs`); with a board and a folder as arguments it draws
others. No GPU is used, and every machine draws the same pixels.
";
