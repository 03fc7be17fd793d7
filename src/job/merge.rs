//! Options of one place over those of another: the command line over the settings file, that over
//! the defaults.

use super::Options;
use super::tools::Library;

impl Options {
    /// These, and where they leave something open, `others`.
    #[must_use]
    pub fn or(self, others: Self) -> Self {
        // A pixel said in either way replaces a pixel said in the other.
        let resolution_is_open = self.pixel.is_none() && self.dpi.is_none();
        let (pixel, dpi) =
            if resolution_is_open { (others.pixel, others.dpi) } else { (self.pixel, self.dpi) };
        let width_is_open = self.width.is_none() && self.passes.is_none() && self.clear.is_none();
        let (width, passes, clear) = if width_is_open {
            (others.width, others.passes, others.clear)
        } else {
            (self.width, self.passes, self.clear)
        };
        let depth_is_open = self.depth.is_none() && self.kerf.is_none();
        let (depth, kerf) = if depth_is_open { (others.depth, others.kerf) } else { (self.depth, self.kerf) };
        let tools = self.tools.clone().with(yielding(others.tools, &self));
        let tabs_are_open = self.tabs.is_none() && self.tab_spacing.is_none() && self.tab_at.is_empty();
        let (tabs, tab_spacing, tab_at) = if tabs_are_open {
            (others.tabs, others.tab_spacing, others.tab_at)
        } else {
            (self.tabs, self.tab_spacing, self.tab_at)
        };
        Self {
            tool: if self.tool.is_empty() { others.tool } else { self.tool },
            output_name: if self.output_name.is_empty() { others.output_name } else { self.output_name },
            ignore: if self.ignore.is_empty() { others.ignore } else { self.ignore },
            tile: self.tile.or(others.tile),
            tile_spacing: self.tile_spacing.or(others.tile_spacing),
            machine: self.machine.or(others.machine),
            machine_travel: self.machine_travel.or(others.machine_travel),
            direction: self.direction.or(others.direction),
            park: self.park.or(others.park),
            before: self.before.or(others.before),
            after: self.after.or(others.after),
            at_tool_change: self.at_tool_change.or(others.at_tool_change),
            tool_change_at: self.tool_change_at.or(others.tool_change_at),
            tool_probe: self.tool_probe.or(others.tool_probe),
            alignment_holes: self.alignment_holes.or(others.alignment_holes),
            alignment_margin: self.alignment_margin.or(others.alignment_margin),
            depth,
            kerf,
            strategy: self.strategy.or(others.strategy),
            strategy_for: if self.strategy_for.is_empty() { others.strategy_for } else { self.strategy_for },
            sites: self.sites.or(others.sites),
            limit: self.limit.or(others.limit),
            width,
            passes,
            clear,
            clear_nets: if self.clear_nets.is_empty() { others.clear_nets } else { self.clear_nets },
            clear_area: if self.clear_area.is_empty() { others.clear_area } else { self.clear_area },
            distance_for: if self.distance_for.is_empty() { others.distance_for } else { self.distance_for },
            keep_area: if self.keep_area.is_empty() { others.keep_area } else { self.keep_area },
            overlap: self.overlap.or(others.overlap),
            pixel,
            dpi,
            frame: self.frame.or(others.frame),
            frame_margin: self.frame_margin.or(others.frame_margin),
            min_width: self.min_width.or(others.min_width),
            topology: self.topology.or(others.topology),
            tolerance: self.tolerance.or(others.tolerance),
            narrow: self.narrow.or(others.narrow),
            adaptive_depth: self.adaptive_depth.or(others.adaptive_depth),
            offset: self.offset.or(others.offset),
            rotate: self.rotate.or(others.rotate),
            mirror_axis: self.mirror_axis.or(others.mirror_axis),
            thickness: self.thickness.or(others.thickness),
            drills: self.drills.or(others.drills),
            drill_tolerance: self.drill_tolerance.or(others.drill_tolerance),
            drill_peck: self.drill_peck.or(others.drill_peck),
            drill_dwell: self.drill_dwell.or(others.drill_dwell),
            drill_plunge: self.drill_plunge.or(others.drill_plunge),
            drill_spindle: self.drill_spindle.or(others.drill_spindle),
            drill_bore: self.drill_bore.or(others.drill_bore),
            one_drill: self.one_drill.or(others.one_drill),
            drill_bore_from: self.drill_bore_from.or(others.drill_bore_from),
            drill_bore_tool: self.drill_bore_tool.or(others.drill_bore_tool),
            drill_side: self.drill_side.or(others.drill_side),
            feed: self.feed.or(others.feed),
            plunge: self.plunge.or(others.plunge),
            spindle: self.spindle.or(others.spindle),
            spin_up: self.spin_up.or(others.spin_up),
            safe_z: self.safe_z.or(others.safe_z),
            dialect: self.dialect.or(others.dialect),
            blend: self.blend.or(others.blend),
            tool_change: self.tool_change.or(others.tool_change),
            origin: self.origin.or(others.origin),
            drill_depth: self.drill_depth.or(others.drill_depth),
            alignment_depth: self.alignment_depth.or(others.alignment_depth),
            break_through: self.break_through.or(others.break_through),
            drill_tip_angle: self.drill_tip_angle.or(others.drill_tip_angle),
            material: self.material.or(others.material),
            drill_safe_z: self.drill_safe_z.or(others.drill_safe_z),
            rivet: self.rivet.or(others.rivet),
            outline_gap: self.outline_gap.or(others.outline_gap),
            cutout_tool: self.cutout_tool.or(others.cutout_tool),
            cutout_side: self.cutout_side.or(others.cutout_side),
            cutout_depth: self.cutout_depth.or(others.cutout_depth),
            cutout_pass: self.cutout_pass.or(others.cutout_pass),
            cutout_ramp: self.cutout_ramp.or(others.cutout_ramp),
            tabs,
            tab_spacing,
            tab_at,
            tab_width: self.tab_width.or(others.tab_width),
            tab_height: self.tab_height.or(others.tab_height),
            tools,
        }
    }
}

/// These tools; what `options` say for every tool, no table says.
fn yielding(tools: Library, options: &Options) -> Library {
    tools.each(|tool| {
        tool.feed = tool.feed.filter(|_| options.feed.is_none());
        tool.plunge = tool.plunge.filter(|_| options.plunge.is_none());
        tool.spindle = tool.spindle.filter(|_| options.spindle.is_none());
        tool.depth = tool.depth.filter(|_| options.depth.is_none() && options.kerf.is_none());
    })
}
