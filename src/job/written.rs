//! A program of the job: planned, measured, as text, and what its file is called.

use crate::board::{Side, Warning};
use crate::gcode::{self, Header};
use crate::geometry::Point;
use crate::toolpath::{Program, Statistics, Tiling, measure};

use super::Settings;
use super::quantity::{ToolChangeAt, Triple};

/// What a program is for; its file is named after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Drills the holes on whose pins the board is flipped.
    Alignment,
    /// Isolates the front.
    Front,
    /// Isolates the back, the board flipped.
    Back,
    /// Drills.
    Drill,
    /// Cuts the board out.
    Cutout,
}

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

impl Part {
    /// Whether an option, by its key in the settings file, changes this program.
    #[must_use]
    pub fn is_changed_by(self, option: &str) -> bool {
        match option {
            "outline-gap" => !matches!(self, Self::Drill | Self::Alignment),
            "feed" | "plunge" | "spindle" | "spin-up" | "safe-z" | "dialect" | "origin" | "tile"
            | "tile-spacing" | "thickness" | "machine" | "machine-travel" | "tool-change"
            | "tool-change-at" | "tool-probe" | "park" | "before" | "after" | "at-tool-change" | "blend"
            | "offset" => true,
            "output-name" => false,
            "direction" => matches!(self, Self::Front | Self::Back | Self::Cutout),
            _ if option.starts_with("alignment") => self == Self::Alignment,
            "drill-tip-angle" | "drill-safe-z" | "drill-plunge" | "drill-spindle" | "material" => {
                matches!(self, Self::Alignment | Self::Drill)
            }
            "break-through" | "rivet" | "one-drill" => self == Self::Drill,
            _ if option.starts_with("drill") => self == Self::Drill,
            _ if option.starts_with("cutout") || option.starts_with("tab") => self == Self::Cutout,
            _ => matches!(self, Self::Front | Self::Back),
        }
    }

    /// The program of this [`name`](Self::name).
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        [Self::Alignment, Self::Front, Self::Back, Self::Drill, Self::Cutout]
            .into_iter()
            .find(|part| part.name() == name)
    }

    /// The last part of its file's name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Alignment => "alignment",
            Self::Front => "front",
            Self::Back => "back",
            Self::Drill => "drill",
            Self::Cutout => "cutout",
        }
    }
}

impl Written {
    /// `program`, on every tile, in the dialect of `settings`, under `header` with its settings and
    /// the time it takes.
    #[must_use]
    pub fn new(
        (part, side, tag): (Part, Side, String),
        program: Program,
        header: &Header,
        tiling: Option<Tiling>,
        settings: &Settings,
    ) -> Self {
        let place = |at: ToolChangeAt| match at {
            ToolChangeAt::Place(Triple([x, y, z])) => (Some(Point::new(x.nm(), y.nm())), z.nm()),
            ToolChangeAt::Height(z) => (None, z.nm()),
        };
        let end = place(settings.park);
        let change = settings.tool_change.map_or(end, place);
        let wait = |program: Program| program.parking(change, end);
        let whole = wait(tiling.map_or_else(|| program.clone(), |tiling| program.clone().tiled(tiling)));
        let statistics = measure(&whole, &settings.machine);
        let mut options = settings.options().listed();
        // How the board is turned every program must say, so that it can be judged by itself.
        let turned = |option: &str, value: &str| option == "rotate" && value != "0deg";
        options.retain(|(option, value)| part.is_changed_by(option) || turned(option, value));
        let header = Header { settings: options, seconds: Some(statistics.seconds), ..header.clone() };
        let text = gcode::write(&whole, &settings.dialect, &header);
        let tile = tiling.map(|_| gcode::write(&wait(program.clone()), &settings.dialect, &header));
        let warning = whole.check_travel(&settings.machine);
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
