//! Options that were given and have no effect: told, so that nobody believes they had.

use crate::board::diagnostic::planning;
use crate::board::{Board, Copper, Warning, Words};
use crate::gcode::dialect::ToolChange;
use crate::toolpath::Section;
use crate::topology::{self, NetId, Nets, Pattern, called};

use super::by_net::without_net;
use super::clearing::Clearing;
use super::need::Need;
use super::plain::method;
use super::{Options, Settings, Sites, Topology};

impl Settings {
    /// The first of the `given` options that changes nothing beside the other settings, and what to
    /// say with it or instead.
    ///
    /// A settings file may have it: it is for many boards.
    #[must_use]
    pub fn without_effect(&self, given: &Options) -> Option<(&'static str, Words)> {
        let unmet = given.needs().into_iter().find(|&(_, need)| !self.meets(need));
        unmet.map(|(option, need)| (option, Words::of(need.hint())))
    }

    fn meets(&self, need: Need) -> bool {
        let all = self.options();
        let is_cleared = all.clear == Some(true);
        match need {
            Need::Passes => {
                all.width.is_some() || all.passes.is_some() || is_cleared || self.clearing.is_wanted()
            }
            Need::Kept => !is_cleared,
            Need::Boring => self.drill_bore || self.alignment.is_some(),
            Need::Tiles => self.tiles.is_some(),
            Need::Alignment => self.alignment.is_some(),
            Need::ThroughHoles => self.drill_tips,
            Need::Tabs => self.tabs.count() != Some(0),
            Need::Frame => self.asked.frame,
            Need::Axes => self.sites != Sites::Copper,
            Need::Waiting => self.dialect.tool_change != ToolChange::Files,
        }
    }
}

/// A `pattern-without-net` for each pattern that means no net of any layer.
pub(super) fn patterns<'a>(
    layers: impl Iterator<Item = (&'a Copper, &'a Nets)> + Clone,
    settings: &Settings,
) -> Vec<Warning> {
    let strategies = settings.asked.strategy_for.iter().map(|own| (&own.nets, "it sets no strategy"));
    let without = strategies.filter(|(pattern, _)| !means_one(pattern, layers.clone()));
    let mut warnings: Vec<Warning> = without.map(|(pattern, so)| without_net(pattern, so)).collect();
    warnings.extend(cleared(layers, &settings.clearing));
    warnings
}

/// Such a warning for each pattern of what is to be cleared.
fn cleared<'a>(
    layers: impl Iterator<Item = (&'a Copper, &'a Nets)> + Clone,
    clearing: &Clearing,
) -> Vec<Warning> {
    let without = clearing.patterns().filter(|pattern| !means_one(pattern, layers.clone()));
    without.map(|pattern| without_net(pattern, "nothing is cleared for it")).collect()
}

fn means_one<'a>(pattern: &Pattern, mut layers: impl Iterator<Item = (&'a Copper, &'a Nets)>) -> bool {
    layers.any(|(copper, nets)| {
        let mut ids = (0..).map(NetId).take(nets.nets().len());
        ids.any(|id| pattern.matches_any(&called(copper, nets, id)))
    })
}

impl Clearing {
    /// What it says of nets and places that a board does not have: `pattern-without-net`,
    /// `area-off-the-board`.
    #[must_use]
    pub fn misses(&self, board: &Board, topology: Topology) -> Vec<Warning> {
        let mut warnings = areas(board, self);
        if self.patterns().next().is_some() {
            let sides = [&board.front, &board.back].into_iter().flatten();
            let layers: Vec<(&Copper, Nets)> =
                sides.map(|copper| (copper, topology::recover(copper, method(topology)))).collect();
            warnings.extend(cleared(layers.iter().map(|(copper, nets)| (*copper, nets)), self));
        }
        warnings
    }
}

/// An `area-off-the-board` for each area to be cleared or kept that does not touch the board.
pub(super) fn areas(board: &Board, clearing: &Clearing) -> Vec<Warning> {
    let Clearing { areas, kept, .. } = clearing;
    let Some(around) = board.bounds() else { return Vec::new() };
    let off = areas.iter().chain(kept).filter(|area| !around.touches(area.bounds()));
    off.map(|area| {
        let [(left, bottom), (right, top)] = [around.min(), around.max()].map(|p| (p.x, p.y));
        let message = format!(
            "the area {area} is not on the board, which lies in x from {left:.2} to {right:.2} mm, in y from {bottom:.2} to {top:.2} mm"
        );
        planning::AREA_OFF_THE_BOARD.warning(message).at(area.bounds().min())
    })
    .collect()
}

/// Warns of each isolating tool that cuts nothing on any of the sides: a wider or a finer one cuts
/// all it could.
pub(super) fn tools(sides: &[Vec<Section>], settings: &Settings) -> Vec<Warning> {
    let tools = settings.isolation.iter().map(|cutting| &cutting.tool);
    let cuts = |name: &str| sides.iter().flatten().any(|section| section.tool.name == name);
    let without = tools.filter(|tool| !sides.is_empty() && !cuts(&tool.name));
    without
        .map(|tool| {
            let message =
                format!("`{}` cuts nothing: it fits nowhere, or the other tools leave it nothing", tool.name);
            planning::TOOL_CUTS_NOTHING.warning(message)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn without_effect(text: &str) -> Option<&'static str> {
        let given = Options::from_toml("f", text).expect(text);
        let settings = Settings::resolve(given.clone()).expect(text);
        settings.without_effect(&given).map(|(option, _)| option)
    }

    #[test]
    fn an_option_that_needs_another_is_idle_without_it() {
        for (alone, other) in [
            ("overlap = \"50%\"", "passes = 2"),
            ("drill-bore-tool = \"endmill:0.8mm\"\ndrill-bore = false", "alignment-holes = \"3mm\""),
            ("drill-bore-tool = \"endmill:0.8mm\"\ndrill-bore = false", "drill-bore-from = \"1mm\""),
            ("alignment-depth = \"9mm\"", "alignment-holes = \"3mm\""),
            ("tile-spacing = \"3mm\"", "tile = \"2x1\""),
            ("alignment-margin = \"9mm\"", "alignment-holes = \"3mm\""),
            ("tool-change-at = \"30mm\"", "dialect = \"linuxcnc\""),
        ] {
            let name = alone.split(' ').next();
            assert_eq!(without_effect(alone), name, "{alone}");
            assert_eq!(without_effect(&format!("{alone}\n{other}")), None, "{alone} with {other}");
        }
        assert_eq!(without_effect("tabs = 0\ntab-width = \"3mm\""), Some("tab-width"), "no tab");
        assert_eq!(
            without_effect("frame = false\nframe-margin = \"1mm\""),
            Some("frame-margin"),
            "no frame cut"
        );
        assert_eq!(
            without_effect("drill-depth = \"2mm\"\nbreak-through = \"1mm\""),
            Some("break-through"),
            "one depth"
        );
        assert_eq!(without_effect(""), None, "nothing was given");
    }
}
