//! A job as its pictures.

use crate::board::Side;
use crate::geometry::Nm;
use crate::grid::Grid;
use crate::report::picture::{self, Shown, Toolpath};
use crate::report::{legend, png, svg};
use crate::toolpath::{Placement, Section};

use super::{Error, Job, Layer, Part, Settings};

/// Bare ground round the board, and the most pixels of the longer side. Chosen: the cutout shows,
/// and it fills a large screen.
const MARGIN: Nm = Nm::from_um(1500);
const MOST: i64 = 2400;

impl Job {
    /// The layer of `side`.
    #[must_use]
    pub fn layer(&self, side: Side) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.side == side)
    }

    /// What a picture of `side` shows.
    #[must_use]
    pub fn shown(&self, side: Side) -> Option<Shown<'_>> {
        let layer = self.layer(side)?;
        Some(Shown {
            board: &self.board,
            copper: self.board.copper(side)?,
            nets: &layer.nets,
            diagram: &layer.diagram,
            boundaries: &layer.boundaries,
            sections: &layer.sections,
            placement: &layer.placement,
            cutout: self.cutout(),
        })
    }

    /// The picture of `side` that goes with its program, as the bytes of a PNG file: regions,
    /// copper, cuts, holes, and a legend. None where the side has no copper.
    pub fn picture(&self, side: Side, settings: &Settings) -> Option<Result<Vec<u8>, Error>> {
        let shown = self.shown(side)?;
        let area = picture::whole(&self.board, MARGIN)?;
        let caption = self.caption(side, settings);
        let draw = |grid: Grid| {
            let toolpath = Toolpath::new(&shown, &grid, false);
            png::bands(&grid, |band| {
                let mut canvas = toolpath.draw(band);
                legend::draw(&mut canvas, &grid, &caption);
                canvas
            })
        };
        let grid = legend::grid(area, settings.picture_pixel(), MOST);
        Some(grid.map(draw).map_err(Error::from))
    }

    /// `side` with its cuts as SVG. None where the side has no copper.
    #[must_use]
    pub fn svg(&self, side: Side) -> Option<String> {
        Some(svg::side(&self.shown(side)?, picture::whole(&self.board, MARGIN)?, svg::Over::Cuts))
    }

    /// The section that cuts the board out, with how the board lies.
    fn cutout(&self) -> Option<(&Section, &Placement)> {
        let program = self.programs.iter().find(|program| program.part == Part::Cutout)?;
        Some((program.program.sections.first()?, &self.placement))
    }

    fn caption(&self, side: Side, settings: &Settings) -> String {
        let nets = self.layer(side).map_or(0, |layer| layer.nets.nets().len());
        let tools = settings.isolation.iter();
        let tools: Vec<_> =
            tools.map(|cutting| format!("{} · kerf {:.3} mm", cutting.tool.kind, cutting.kerf())).collect();
        format!("{} {side} · {nets} nets · {}", self.board.name, tools.join(" · "))
    }
}
