//! A job as its page.

use crate::report::Document;
use crate::report::page::{Drawing, Machined, Page, SideDrawing, ToolUse};

use super::verification::{lines_of_whole, unsaid};
use super::{Error, Job, Layer, Part, Settings, Written};

impl Job {
    /// The page about it, with the report that `document` is.
    ///
    /// # Errors
    ///
    /// [`Error::Page`] where a program cannot be read back.
    pub fn page<'a>(&self, settings: &Settings, document: &'a Document) -> Result<Page<'a>, Error> {
        let side = |layer: &Layer| {
            let copper = self.board.copper(layer.side)?;
            Some(SideDrawing::new(copper, &layer.nets, &layer.boundaries, &settings.kerfs()))
        };
        let programs: Vec<Machined<'_>> =
            self.programs.iter().map(|program| self.machined(program, settings)).collect();
        let sides = self.layers.iter().filter_map(side).collect();
        let drawing = Drawing::new(&self.board, sides, &programs).map_err(Error::Page)?;
        Ok(Page { report: document, drawing })
    }

    fn machined<'a>(&self, written: &'a Written, settings: &Settings) -> Machined<'a> {
        let tools = written.statistics.tools.iter().map(|tool| ToolUse {
            number: tool.number,
            name: tool.name.clone(),
            cut_mm: tool.cut_length.to_mm(),
            seconds: (tool.seconds * 10.0).round() / 10.0,
        });
        Machined {
            file: written.file_name(&self.board.name, settings),
            // Of several tiles the first is shown: the board is drawn once.
            text: written.tile.as_ref().unwrap_or(&written.text),
            lines: written.tile.as_ref().map(|tile| lines_of_whole(tile, &written.text)),
            cutter: unsaid(written, settings),
            side: match written.part {
                Part::Front => Some(crate::board::Side::Front),
                Part::Back => Some(crate::board::Side::Back),
                Part::Alignment | Part::Drill | Part::Cutout => None,
            },
            part: written.part.name(),
            placement: self.laid(written),
            seconds: written.statistics.seconds,
            rapid: settings.machine.level_rapid().nm_per_second() * 60e-6,
            tools: tools.collect(),
        }
    }
}
