//! The programs of a job, judged by their texts.

use crate::board::Side;
use crate::gcode::dialect::Comments;
use crate::toolpath::{self, ToolKind};
use crate::topology::Method;
use crate::verify::{self, Cutter, CutterKind, Known, Placement, Program, Report, Role, Surface, verify};

use super::art::cutter;
use super::plain::method;
use super::quantity::Tiles;
use super::{Error, Job, Part, Settings, Written};

impl Job {
    /// Mills its programs on a picture, from their texts, and says what is wrong with them.
    ///
    /// Of several tiles the first is judged: the others are the same moves elsewhere. That all of
    /// them lie within the machine is asked of the whole programs. The holes for turning the stock
    /// over lie beside all tiles, and are judged by all.
    ///
    /// The programs say for themselves what tools they are for; how the board lies is told, not
    /// found.
    ///
    /// # Errors
    ///
    /// [`Error::Verify`] where a program cannot be followed.
    pub fn verify(&self, settings: &Settings) -> Result<Report, Error> {
        let programs = self.judged(settings, |written| !is_beside(written, settings));
        let tiled = self.tiled(&programs);
        let (judging, travel) = (judging(settings), settings.machine.travel);
        let judging = verify::Settings { travel: travel.filter(|_| tiled.is_empty()), ..judging };
        // What copper touches is no matter of how it was looked for.
        let are_exact = method(settings.asked.topology) == Method::Contact;
        let layers = self.layers.iter().filter(|_| are_exact);
        let known: Vec<Known<'_>> =
            layers.map(|layer| Known { side: layer.side, nets: &layer.nets }).collect();
        let mut report = verify(&programs, &self.board, &known, &judging)?;
        self.tell_lines_of_whole(&mut report, settings);
        let beside = self.judged(settings, |written| is_beside(written, settings));
        if let Some((Tiles { columns, rows }, spacing)) = settings.tiles.filter(|_| !beside.is_empty()) {
            let tiles = Some(verify::Tiles { columns, rows, spacing });
            let whole = verify::Settings { tiles, travel, ..judging };
            report = report.joined(verify(&beside, &self.board, &[], &whole)?);
        }
        Ok(match travel.filter(|_| !tiled.is_empty()) {
            Some(travel) => report.with(verify::overtravel(&tiled, travel)?),
            None => report,
        })
    }

    /// Has findings in what mills one of several tiles tell the lines of the whole programs.
    fn tell_lines_of_whole(&self, report: &mut Report, settings: &Settings) {
        for written in &self.programs {
            let Some(tile) = &written.tile else { continue };
            let file = written.file_name(&self.board.name, settings);
            let own = report.findings.iter_mut().filter(|found| found.program.as_ref() == Some(&file));
            let lines: Vec<&mut u32> = own.filter_map(|found| found.line.as_mut()).collect();
            if lines.is_empty() {
                continue;
            }
            let whole = lines_of_whole(tile, &written.text);
            for line in lines {
                *line = whole.get(*line as usize - 1).copied().unwrap_or(*line);
            }
        }
    }

    /// Of these programs of one tile, those that mill several, whole.
    fn tiled(&self, judged: &[Program]) -> Vec<Program> {
        let whole = |program: &Program| {
            let written =
                self.programs.iter().find(|written| written.tile.as_ref() == Some(&program.text))?;
            Some(Program { text: written.text.clone(), ..program.clone() })
        };
        judged.iter().filter_map(whole).collect()
    }

    /// What those of its programs mill that run with such a side up, read back from their texts.
    ///
    /// # Errors
    ///
    /// As for [`verify`](Self::verify).
    pub(super) fn surface(
        &self,
        is_up: impl Fn(Side) -> bool,
        settings: &Settings,
    ) -> Result<Surface, Error> {
        let programs = self.judged(settings, |written| is_up(written.side) && !is_beside(written, settings));
        Ok(Surface::of_board(&programs, &self.board, &judging(settings))?)
    }

    /// Those of its programs that `which` asks for, as the judge takes them: of one tile.
    fn judged(&self, settings: &Settings, which: impl Fn(&Written) -> bool) -> Vec<Program> {
        let everything = settings.options().clear == Some(true);
        let asked = settings.clearing.drawn(everything, settings.tolerance);
        let wanted = self.programs.iter().filter(|written| which(written));
        let program = |written: &Written| Program {
            file: written.file_name(&self.board.name, settings),
            text: written.tile.as_ref().unwrap_or(&written.text).clone(),
            role: Some(role(written.part)),
            cutter: unsaid(written, settings),
            placement: Some(self.laid(written)),
            asked: asked.clone(),
            dialect: None,
            is_bytes: false,
        };
        wanted.map(program).collect()
    }

    /// How the board lies while a program runs.
    pub(super) fn laid(&self, written: &Written) -> Placement {
        let toolpath::Placement { rotation, shift, .. } = self.placement;
        let mirror = (written.side == Side::Back).then_some(self.axis);
        let degrees = rotation.degrees();
        Placement { degrees, shift, mirror }
    }
}

/// Where each line of what mills one tile is in the whole program, which has the same lines in the
/// same order and others between them; of one that it has not, where the one before is.
pub(super) fn lines_of_whole(tile: &str, whole: &str) -> Vec<u32> {
    let whole: Vec<&str> = whole.lines().collect();
    let mut next = 0;
    let place = |line: &str| {
        if let Some(further) = whole[next..].iter().position(|other| *other == line) {
            next += further + 1;
        }
        u32::try_from(next).unwrap_or(u32::MAX)
    };
    tile.lines().map(place).collect()
}

/// Whether a program is for all tiles together: the holes for turning them over lie beside them.
fn is_beside(written: &Written, settings: &Settings) -> bool {
    written.part == Part::Alignment && settings.tiles.is_some()
}

/// The tool of a program that has no comments to say which it is for; none where there are several.
pub(super) fn unsaid(written: &Written, settings: &Settings) -> Option<Cutter> {
    let mut tools = written.program.sections.iter().map(|section| section.tool.kind);
    let first = tools.next().filter(|_| settings.dialect.comments == Comments::None)?;
    let angle = settings.drill_tip_angle.degrees();
    tools.all(|tool| tool == first).then(|| match first {
        ToolKind::Drill { diameter } => Cutter { kind: CutterKind::Drill, tip: diameter, degrees: angle },
        other => cutter(other),
    })
}

/// What the judge tolerates: what the settings allow is no finding.
fn judging(settings: &Settings) -> verify::Settings {
    let usual = verify::Settings::default();
    verify::Settings {
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
