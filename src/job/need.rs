//! What an option needs so that it changes anything.

/// What the other options must say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Need {
    /// More than one pass somewhere.
    Passes,
    /// Something that is not cleared anyway.
    Kept,
    /// Holes that are bored.
    Boring,
    /// More than one tile.
    Tiles,
    /// Holes for pins.
    Alignment,
    /// Holes as deep as the board is thick.
    ThroughHoles,
    /// Tabs.
    Tabs,
    /// A frame cut.
    Frame,
    /// Cuts that are midway between axes.
    Axes,
    /// Programs with several tools.
    Waiting,
}

impl Need {
    /// What to set or to leave out so that it is met.
    pub(super) const fn hint(self) -> &'static str {
        match self {
            Self::Passes => "set {width}, {passes} or {clear} too",
            Self::Kept => "leave {clear} out",
            Self::Boring => "leave {drill-bore}=false out",
            Self::Tiles => "set {tile} too",
            Self::Alignment => "set {alignment-holes} too",
            Self::ThroughHoles => "leave {drill-depth} out",
            Self::Tabs => "set {tabs} too, which is 0 here",
            Self::Frame => "leave {no-frame} out",
            Self::Axes => "set {sites} core too",
            Self::Waiting => "leave it out: each tool has a file of its own here ({tool-change}, {dialect})",
        }
    }
}
