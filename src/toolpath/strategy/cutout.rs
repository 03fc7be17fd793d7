//! Cutout: round the board outside its edge, in passes, with tabs that hold it until the end.

use crate::board::{Outline, Warning};
use crate::geometry::Nm;
use crate::toolpath::head::Head;
use crate::toolpath::{Heights, Placement, Section, Tool};

/// What holds the board while it is cut out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tabs {
    /// How many on each contour; none holds the board otherwise.
    pub count: u32,
    /// How wide each stays.
    pub width: Nm,
    /// How thick each stays, from the bottom of the cut.
    pub height: Nm,
}

/// How the board is cut out.
#[derive(Clone, Copy, Debug)]
pub struct Cutout<'a> {
    /// The cutter.
    pub tool: &'a Tool,
    /// How high and how deep, and how much a pass takes.
    pub heights: Heights,
    /// From board to machine.
    pub placement: &'a Placement,
    /// What holds the board.
    pub tabs: Tabs,
}

/// Cuts along every contour of `outline`, half the cutter's width outside the board; cut-outs first.
pub fn cutout(outline: &Outline, settings: &Cutout<'_>) -> (Section, Vec<Warning>) {
    let mut head = Head::new(settings.heights, settings.tool.plunge);
    for contour in outline.contours() {
        let path = settings.placement.path(contour);
        head.over(path.start);
        for depth in settings.heights.passes() {
            head.plunge(depth);
            head.follow(&path, settings.tool.feed);
        }
    }
    (Section { tool: settings.tool.clone(), label: "cut out".to_owned(), moves: head.finish() }, Vec::new())
}
