//! The programs of a job, judged by their texts.

use crate::board::Side;
use crate::toolpath;
use crate::verify::{self, Known, Placement, Program, Report, Role, verify};

use super::{Error, Job, Part, Settings, Written};

impl Job {
    /// Mills its programs on a picture, from their texts, and says what is wrong with them.
    ///
    /// Of several tiles the first is judged: the others are the same moves elsewhere.
    ///
    /// The programs say for themselves what tools they are for; how the board lies is told, not
    /// found.
    ///
    /// # Errors
    ///
    /// [`Error::Verify`] where a program cannot be followed.
    pub fn verify(&self, settings: &Settings) -> Result<Report, Error> {
        let everything = settings.options().clear == Some(true);
        let tolerance = settings.tolerance;
        let asked = settings.clearing.drawn(everything, tolerance);
        let programs: Vec<Program> = self
            .programs
            .iter()
            // The holes for turning several tiles over lie beside all of them.
            .filter(|written| written.part != Part::Alignment || settings.tiles.is_none())
            .map(|written| Program {
                file: written.file_name(&self.board.name, settings),
                text: written.tile.as_ref().unwrap_or(&written.text).clone(),
                role: Some(role(written.part)),
                cutter: None,
                placement: Some(self.laid(written)),
                asked: asked.clone(),
            })
            .collect();
        let known: Vec<Known<'_>> =
            self.layers.iter().map(|layer| Known { side: layer.side, nets: &layer.nets }).collect();
        let usual = verify::Settings::default();
        // What the settings allow is no finding.
        let judging = verify::Settings {
            diameter: if settings.one_drill {
                verify::Settings::ANY_DIAMETER
            } else {
                usual.diameter.max(settings.drill_tolerance)
            },
            board: settings.thickness,
            travel: settings.machine.travel,
            tabs: settings.tabs.count(),
            tab_width: Some(settings.tab_width),
            ..usual
        };
        Ok(verify(&programs, &self.board, &known, &judging)?)
    }

    /// How the board lies while a program runs.
    pub(super) fn laid(&self, written: &Written) -> Placement {
        let toolpath::Placement { rotation, shift, .. } = self.placement;
        let mirror = (written.side == Side::Back).then_some(self.axis);
        let degrees = rotation.degrees();
        Placement { degrees, shift, mirror }
    }
}

const fn role(part: Part) -> Role {
    match part {
        Part::Front => Role::Isolation(Side::Front),
        Part::Back => Role::Isolation(Side::Back),
        Part::Alignment => Role::Alignment,
        Part::Drill => Role::Drilling,
        Part::Cutout => Role::Cutout,
    }
}
