//! Options that were given and have no effect: told, so that nobody believes they had.

use crate::board::diagnostic::planning;
use crate::board::{Board, Copper, Warning, Words};

use super::by_net::{names, without_net};
use super::clearing::Clearing;
use super::{Area, Layer, Options, Pattern, Settings, Sites};
use crate::topology::NetId;

impl Settings {
    /// The first of the `given` options that changes nothing beside the other settings, and what to
    /// say with it or instead.
    ///
    /// A settings file may have it: it is for many boards.
    #[must_use]
    pub fn without_effect(&self, given: &Options) -> Option<(&'static str, Words)> {
        let all = self.options();
        let is_cleared = all.clear == Some(true);
        let is_wide = all.width.is_some() || all.passes.is_some() || is_cleared || self.clearing.is_wanted();
        let is_held = all.tabs != Some(0) || all.tab_spacing.is_some() || !all.tab_at.is_empty();
        let bores = self.drill_bore || self.alignment.is_some();
        let without = [
            ("overlap", given.overlap.is_some() && !is_wide, "set {width}, {passes} or {clear} too"),
            ("clear-nets", !given.clear_nets.is_empty() && is_cleared, "leave {clear} out"),
            ("clear-area", !given.clear_area.is_empty() && is_cleared, "leave {clear} out"),
            ("distance-for", !given.distance_for.is_empty() && is_cleared, "leave {clear} out"),
            ("keep-area", !given.keep_area.is_empty() && !is_wide, "set {width}, {passes} or {clear} too"),
            ("drill-bore-tool", given.drill_bore_tool.is_some() && !bores, "leave {drill-bore}=false out"),
            ("tile-spacing", given.tile_spacing.is_some() && self.tiles.is_none(), "set {tile} too"),
            (
                "alignment-margin",
                given.alignment_margin.is_some() && self.alignment.is_none(),
                "set {alignment-holes} too",
            ),
            (
                "alignment-depth",
                given.alignment_depth.is_some() && self.alignment.is_none(),
                "set {alignment-holes} too",
            ),
            (
                "break-through",
                given.break_through.is_some() && all.drill_depth.is_some(),
                "leave {drill-depth} out",
            ),
            ("tab-width", given.tab_width.is_some() && !is_held, "set {tabs} too, which is 0 here"),
            ("tab-height", given.tab_height.is_some() && !is_held, "set {tabs} too, which is 0 here"),
            ("frame-margin", given.frame_margin.is_some() && !self.frame, "leave {no-frame} out"),
            (
                "no-min-width",
                given.min_width.is_some() && self.sites == Sites::Copper,
                "set {sites} core too",
            ),
        ];
        without
            .into_iter()
            .find(|(_, has_none, _)| *has_none)
            .map(|(option, _, hint)| (option, Words::of(hint)))
    }
}

/// A `pattern-without-net` for each pattern that means no net of any layer.
pub(super) fn patterns<'a>(
    layers: impl Iterator<Item = (&'a Copper, &'a Layer)> + Clone,
    settings: &Settings,
) -> Vec<Warning> {
    let means_one = |pattern: &Pattern| {
        layers.clone().any(|(copper, layer)| {
            let mut ids = (0..).map(NetId).take(layer.nets.nets().len());
            ids.any(|id| pattern.matches_any(&names(copper, &layer.nets, id)))
        })
    };
    let strategies = settings.strategy_for.iter().map(|own| (&own.nets, "it sets no strategy"));
    let cleared = settings.clearing.patterns().map(|pattern| (pattern, "nothing is cleared for it"));
    let without = strategies.chain(cleared).filter(|(pattern, _)| !means_one(pattern));
    without.map(|(pattern, so)| without_net(pattern, so)).collect()
}

/// An `area-off-the-board` for each area to be cleared or kept that does not touch the board.
pub(super) fn areas(board: &Board, settings: &Settings) -> Vec<Warning> {
    let Clearing { areas, kept, .. } = &settings.clearing;
    let is_off = |area: &&Area| board.bounds().is_some_and(|bounds| !bounds.touches((**area).into()));
    let off = areas.iter().chain(kept).filter(is_off);
    off.map(|area| {
        let message = format!("the area {area} is not on the board");
        planning::AREA_OFF_THE_BOARD.warning(message).at(area.corner.into())
    })
    .collect()
}

/// Warns of each isolating tool that cuts nothing on any side: a wider or a finer one cuts all it
/// could.
pub(super) fn tools(layers: &[Layer], settings: &Settings) -> Vec<Warning> {
    let tools = settings.isolation.iter().map(|cutting| &cutting.tool);
    let cuts =
        |name: &str| layers.iter().flat_map(|layer| &layer.sections).any(|section| section.tool.name == name);
    let without = tools.filter(|tool| !layers.is_empty() && !cuts(&tool.name));
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
