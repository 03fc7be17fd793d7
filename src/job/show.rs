//! A job as its pictures.

use crate::board::Side;
use crate::geometry::{Nm, Rect};
use crate::grid::Grid;
use crate::report::picture::{self, Shown, Toolpath};
use crate::report::relief::{Material, Relief};
use crate::report::{legend, png, svg};
use crate::toolpath::{Placement, Section};
use crate::verify;

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
        let cuts = self.programs.iter().filter(|program| program.part == Part::of(side));
        Some(Shown {
            board: &self.board,
            copper: self.board.copper(side)?,
            nets: &layer.nets,
            regions: &layer.regions,
            boundaries: &layer.boundaries,
            sections: cuts.flat_map(|program| &program.program.sections).collect(),
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

    /// `side` as it comes from the mill, drilled and cut out, seen at a slant by someone who stands
    /// before it: the back is mirrored. `area` is the part of the board, `pitch` its pixels. All is
    /// what the texts of the programs mill; of those that run with the other side up one sees where
    /// they go through.
    ///
    /// # Errors
    ///
    /// [`Error::Verify`] for a program that cannot be followed, [`Error::Grid`] for pixels that are
    /// too small or too many.
    pub fn milled(
        &self,
        side: Side,
        (area, pitch): (Rect, Nm),
        settings: &Settings,
    ) -> Result<Relief<impl Fn(&Grid) -> Vec<f32>>, Error> {
        let thickness = settings.thickness;
        let own = self.surface(|up| up == side, settings)?;
        let other = self.surface(|up| up != side, settings)?;
        let depths = move |grid: &Grid| {
            let mut depths = own.depths(grid);
            for (depth, below) in depths.iter_mut().zip(other.depths(grid)) {
                if f64::from(below) >= thickness.to_f64() {
                    *depth = depth.max(below);
                }
            }
            if side == Side::Back {
                depths.chunks_mut(grid.width() as usize).for_each(<[f32]>::reverse);
            }
            depths
        };
        let material = Material::Clad { copper: verify::Settings::default().copper, thickness };
        Ok(Relief::new(depths, thickness, (area, pitch), material)?)
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
