//! A program of the job: planned, measured, as text, and what its file is called.

use crate::board::{Side, Warning};
use crate::gcode::{self, Header};
use crate::geometry::{Nm, Point};
use crate::toolpath::{Program, Statistics, Tiling, measure};

use super::part::Part;
use super::quantity::{ToolChangeAt, Triple};
use super::{Options, Settings};

/// A program, planned, measured, and as text.
#[derive(Clone, Debug)]
pub struct Written {
    /// What it is for.
    pub part: Part,
    /// The side that is up.
    pub side: Side,
    /// What its file's name ends in: the part, and the tool where each has a file of its own.
    pub tag: String,
    /// What was planned, for one tile.
    pub program: Program,
    /// What it amounts to.
    pub statistics: Statistics,
    /// What the machine reads.
    pub text: String,
    /// The same for one tile alone; none where there is but one.
    pub tile: Option<String>,
    /// Where it goes farther than the machine.
    pub warning: Option<Warning>,
}

impl Settings {
    /// Where the tool stands while another is fitted, and at the end: a place if there is one, and
    /// a height.
    pub(super) fn parking(&self) -> [(Option<Point>, Nm); 2] {
        let place = |at: ToolChangeAt| match at {
            ToolChangeAt::Place(Triple([x, y, z])) => (Some(Point::new(x.nm(), y.nm())), z.nm()),
            ToolChangeAt::Height(z) => (None, z.nm()),
        };
        let end = place(self.asked.park);
        [self.asked.tool_change_at.map_or(end, place), end]
    }
}

impl Written {
    /// `program`, on every tile, in the dialect of `settings`, under `header` with its settings and
    /// the time it takes.
    #[must_use]
    pub fn new(
        (part, side, tag): (Part, Side, String),
        mut program: Program,
        header: &Header,
        tiling: Option<Tiling>,
        settings: &Settings,
    ) -> Self {
        let [change, end] = settings.parking();
        let mut options = settings.options().listed();
        // How the board is turned every program must say, so that it can be judged by itself.
        let turned = |option: &str, value: &str| option == "rotate" && value != "0deg";
        options.retain(|(option, value)| {
            Options::reach(option).is_some_and(|changes| changes.meets(part.reach())) || turned(option, value)
        });
        let write = |program: &Program, seconds: f64| {
            let header = Header { settings: options.clone(), seconds: Some(seconds), ..header.clone() };
            gcode::write(program, &settings.dialect, &header)
        };
        let make = |whole: &Program| {
            let statistics = measure(whole, &settings.machine);
            let text = write(whole, statistics.seconds);
            (statistics, text, whole.check_travel(&settings.machine))
        };
        let (statistics, text, warning) = match tiling {
            None => program.while_parking(change, end, make),
            Some(tiling) => program.clone().tiled(tiling).while_parking(change, end, make),
        };
        let of_tile = |tile: &Program| write(tile, statistics.seconds);
        let tile = tiling.map(|_| program.while_parking(change, end, of_tile));
        Self { part, side, tag, program, statistics, text, tile, warning }
    }

    /// The name of its file.
    #[must_use]
    pub fn file_name(&self, board: &str, settings: &Settings) -> String {
        let named = settings.options().output_name.iter().find(|name| name.part == self.part);
        // The tool, where there is a file for each.
        let tool = self.tag.strip_prefix(self.part.name()).unwrap_or_default();
        named.map_or_else(
            || format!("{board}-{}.{}", self.tag, settings.dialect.extension),
            |name| name.with(tool),
        )
    }
}
