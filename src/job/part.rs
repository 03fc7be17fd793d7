//! What a program is for, and which options change it.

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
