//! What the lines of a project mean together: mills and how wide they clear, the cutter and its
//! bridges, drills and what is bored.

use crate::board::Words;
use crate::gcode::dialect::ToolChange;
use crate::geometry::Nm;
use crate::job::Options;
use crate::job::choice::Strategy;
use crate::job::overlap::Overlap;
use crate::job::quantity::{Length, ToolChangeAt};
use crate::job::tools::{OwnTool, ToolChoice};
use crate::toolpath::{Feed, Percent, ToolKind};
use crate::verify::THINNEST_TAB;

use super::MillProject;
use super::draft::{Draft, Needs, usual_cutter};
use super::value::{Entry, Wrong};

/// How the cutter's table is called.
const CUTTER: &str = "millproject-cutter";
/// How the table of the mill that bores is called.
const BORER: &str = "millproject-borer";

/// How deep a bridge that reaches the surface is cut all the same: a tab is thinner than the cut is
/// deep. Chosen: through the copper, so that it is seen where the bridge is.
const SCRATCH: Nm = Nm::from_um(50);

impl Draft<'_> {
    /// Puts together what belongs together.
    pub(super) fn finish(mut self) -> Result<MillProject, Wrong> {
        self.refuse()?;
        self.isolation();
        self.cutout();
        self.holes()?;
        self.changes()?;
        self.touches();
        self.place();
        self.made.left.sort_by_key(|warning| warning.source.as_ref().map_or(0, |source| source.line));
        Ok(self.made)
    }

    /// Fails for the first value that is invalid and matters.
    fn refuse(&mut self) -> Result<(), Wrong> {
        if let Some((overlap, entry)) = &self.isolating.overlap
            && overlap.of(Nm::from_mm(1)) < Nm::ZERO
        {
            let expected = "zero or more: passes that lie apart leave copper between them";
            self.refused.push((Needs::Copper, entry.wrong(expected)));
        }
        let files = &self.made.files;
        // Where a project names no file of a board, any may come.
        let is_open = [&files.front, &files.back, &files.outline, &files.drill].iter().all(|f| f.is_none());
        let matters = |needs: Needs| {
            is_open
                || match needs {
                    Needs::Copper => files.front.is_some() || files.back.is_some(),
                    Needs::Back => files.back.is_some(),
                    Needs::Holes => files.drill.is_some(),
                    Needs::Outline => files.outline.is_some(),
                }
        };
        let first = self.refused.drain(..).filter(|(needs, _)| matters(*needs)).map(|(_, wrong)| wrong);
        first.min_by_key(Wrong::line).map_or(Ok(()), Err)
    }

    /// Whether there is copper on the back alone, so that whoever mills it has the back up for the
    /// rest too.
    fn is_back_alone(&self) -> bool {
        self.made.files.back.is_some() && self.made.files.front.is_none()
    }

    /// The mills, and how wide the gap is to be.
    fn isolation(&mut self) {
        let mut mills = std::mem::take(&mut self.isolating.mills);
        mills.retain(|&mill| mill > Nm::ZERO);
        mills.sort();
        mills.dedup();
        let tool = |&diameter: &Nm| ToolChoice::Kind(ToolKind::EndMill { diameter });
        self.made.options.tool = mills.iter().map(tool).collect();
        // Half of it, where it is not said.
        if let (Some(feed), None) = (self.made.options.feed, self.made.options.plunge) {
            self.made.options.plunge = half(feed);
        }
        self.widening(&mills);
        self.strategy(&mills);
        if let Some((infeed, entry)) = self.isolating.infeed
            && self.made.options.depth.is_some_and(|depth| infeed < depth.nm())
        {
            self.leave(&entry, "copper is cut through at once");
        }
    }

    /// How wide gaps are cleared.
    fn widening(&mut self, mills: &[Nm]) {
        let widest = mills.last().copied().unwrap_or(Nm::ZERO);
        let options = &mut self.made.options;
        match self.isolating.width {
            Some(None) => options.clear = Some(true),
            // A gap that one cut makes wide enough needs no second.
            Some(Some(width)) => options.width = Some(Length(width)).filter(|_| width > widest),
            None => {}
        }
        let mut overlap = self.isolating.overlap.map(|(overlap, _)| overlap);
        let is_open = options.width.is_none() && options.clear.is_none();
        match self.isolating.extra_passes.filter(|&(extra, _)| extra > 0 && is_open) {
            Some((extra, _)) if !mills.is_empty() => {
                // More than ever fit are as many as fit.
                options.passes = Some(extra.saturating_add(1).min(MOST_PASSES));
                // Each of its extra passes is half a cutter further out.
                overlap = Some(Overlap::OfKerf(Percent::new(50)));
            }
            Some((_, entry)) => self.leave(
                &entry,
                "passes of a mill without a diameter lie on each other: set mill-diameters, or isolation-width",
            ),
            None => {}
        }
        let options = &mut self.made.options;
        if options.width.is_some() || options.passes.is_some() || options.clear.is_some() {
            options.overlap = overlap.or(Some(Overlap::OfKerf(Percent::new(50))));
        }
    }

    /// Midway between nets, or round each; `offset` keeps cuts from copper, as far as the middle of
    /// the gap allows.
    fn strategy(&mut self, mills: &[Nm]) {
        let is_voronoi = self.isolating.voronoi == Some(true);
        self.made.options.strategy = Some(if is_voronoi { Strategy::Voronoi } else { Strategy::Outline });
        let Some((offset, entry)) = self.isolating.offset.filter(|(offset, _)| *offset != Nm::ZERO) else {
            return;
        };
        let is_wide = self.made.options.width.is_some()
            || self.made.options.passes.is_some()
            || self.made.options.clear.is_some();
        if offset < Nm::ZERO {
            return self.leave(&entry, "cuts would lie in the copper");
        }
        if is_voronoi {
            return self.leave(&entry, "with voronoi cuts lie midway, however far that is");
        }
        if is_wide || mills.len() > 1 {
            return self.leave(&entry, "wide gaps are cleared from the copper outwards");
        }
        let options = &mut self.made.options;
        // The middle of its cut is half a mill and the offset from copper, or midway where that is
        // nearer: so far a net reaches.
        let mill = mills.first().copied().unwrap_or(Nm::ZERO);
        options.strategy = Some(Strategy::Voronoi);
        options.limit = Some(Length(mill / 2 + offset));
        if mills.is_empty() && usual_kerf(options) > offset * 2 {
            let diameter = offset * 2;
            options.tool = vec![ToolChoice::Kind(ToolKind::EndMill { diameter })];
            self.advise(&entry, "without mill-diameters the mill is assumed to be twice as wide");
        }
    }

    /// The cutter with its own speeds, and its bridges.
    fn cutout(&mut self) {
        if let (Some(feed), None) = (self.cutting.cutter.feed, self.cutting.cutter.plunge) {
            self.cutting.cutter.plunge = half(feed);
        }
        let is_back_alone = self.is_back_alone();
        let options = &mut self.made.options;
        options.cutout_side = self.cutting.side.of(self.cutting.front, is_back_alone);
        if self.cutting.cutter != usual_cutter() {
            options.tools.add(CUTTER, self.cutting.cutter);
            options.cutout_tool = Some(ToolChoice::Named(CUTTER.to_owned()));
        }
        let usual = Options::defaults().tab_height.map_or(Nm::ZERO, Length::nm);
        let depth = self.cutting.depth;
        match self.cutting.bridges {
            Some(width) if width > Nm::ZERO => self.bridges(width, depth),
            Some(_) => options.tabs = Some(0),
            // A cut so shallow goes through nothing that would need to be held.
            None if depth.is_some_and(|depth| depth <= usual) => options.tabs = Some(0),
            None => {}
        }
        if let Some((_, entry)) = self.cutting.zbridges
            && self.cutting.bridges.is_none_or(|width| width <= Nm::ZERO)
        {
            self.leave(&entry, "without bridges it has no effect");
        }
    }

    /// Bridges of this width.
    fn bridges(&mut self, width: Nm, depth: Option<Nm>) {
        let options = &mut self.made.options;
        // Two unless it says how many.
        options.tabs = Some(self.cutting.bridges_count.unwrap_or(2));
        options.tab_width = Some(Length(width));
        let Some(depth) = depth else { return };
        // Where it is not said, the cutter is lifted out of the board.
        let top = self.cutting.zbridges.map_or(Nm::ZERO, |(top, _)| top);
        let back = Options::defaults().thickness.map_or(depth, |thickness| depth.min(thickness.nm()));
        let problem = if top <= -depth {
            options.tabs = Some(0);
            "bridges below the cut hold nothing".to_owned()
        } else if top <= -back {
            format!("bridges below a board of {} hold nothing: tabs of the usual height do", Length(back))
        } else {
            options.tab_height = Some(Length((top + back).min(back - SCRATCH).max(THINNEST_TAB)));
            return;
        };
        if let Some((_, entry)) = self.cutting.zbridges {
            self.leave(&entry, problem);
        }
    }

    /// What is drilled, what is bored, and from which side.
    fn holes(&mut self) -> Result<(), Wrong> {
        let is_back_alone = self.is_back_alone();
        let cutter = self.cutting.cutter;
        let options = &mut self.made.options;
        options.drill_side = self.drilling.side.of(self.drilling.front, is_back_alone);
        if let Some(diameter) = self.drilling.mill {
            options.tools.add(BORER, OwnTool { kind: ToolKind::EndMill { diameter }, ..cutter });
        }
        let Some(from) = self.drilling.milled_from else {
            // Drilled whatever the diameter, and slots hole by hole.
            options.drill_bore = Some(false);
            if let Some((_, entry)) = self.drilling.mill_depth {
                self.leave(&entry, "nothing is bored");
            }
            return Ok(());
        };
        options.drill_bore = Some(true);
        if self.drilling.mill.is_some() {
            options.drill_bore_tool = Some(ToolChoice::Named(BORER.to_owned()));
        }
        // All that the mill fits into, where any hole is to be milled.
        let mill = self.drilling.mill.unwrap_or(cutter.kind.width_at(Nm::ZERO));
        options.drill_bore_from = Some(Length(from.max(mill).max(Nm::from_um(1))));
        if let Some((depth, entry)) = self.drilling.mill_depth
            && self.drilling.depth != Some(depth)
        {
            if from == Nm::ZERO || self.drilling.depth.is_none() {
                options.drill_depth = Some(Length(depth));
            } else {
                self.leave(&entry, "holes are bored as deep as they are drilled");
            }
        }
        Ok(())
    }

    /// Where and how tools are changed.
    fn changes(&mut self) -> Result<(), Wrong> {
        let units = self.units;
        match (self.zchange, self.is_change_absolute) {
            (Some(_), Some(absolute)) => {
                self.leave(
                    &absolute,
                    Words::of(
                        "heights count from work zero, so zchange is not taken over either: use {park}",
                    ),
                );
            }
            (Some(entry), None) => {
                let height = Length(entry.length(units)?);
                // It rises as high in the end.
                self.made.options.park = Some(ToolChangeAt::Height(height));
            }
            (None, _) => {}
        }
        let Some(entry) = self.nom6 else { return Ok(()) };
        match &self.made.options.dialect {
            Some(dialect) if dialect.0.tool_change == ToolChange::M6 => {
                let holds = dialect.0.changes.contains(&ToolChange::Pause);
                self.made.options.tool_change =
                    Some(if holds { ToolChange::Pause } else { ToolChange::Files });
            }
            Some(_) => {}
            None => self.advise(
                &entry,
                Words::of("the dialect sets how tools are changed; {tool-change} sets another way"),
            ),
        }
        Ok(())
    }

    /// What pcb2gcode's programs do for themselves takes two commands here.
    fn touches(&mut self) {
        for (entry, side) in [(self.probing.front, "front"), (self.probing.back, "back")] {
            let Some(entry) = entry else { continue };
            let grid = [self.probing.x, self.probing.y].into_iter().flatten().min();
            let grid = grid.map(|grid| Words::of(" {probe-grid} {0}").with([&Length(grid)]));
            let feed = self.probing.feed.map(|feed| Words::of(" {probe-feed} {0}").with([&feed]));
            let [grid, feed] = [grid, feed].map(Option::unwrap_or_default);
            let why = Words::of(
                "`voromill probe {side} {0}{1}{2}` probes the board, `voromill level` adapts the program to the heights (docs/levelling.md)",
            );
            self.leave(&entry, why.with([&side, &grid, &feed]));
        }
    }
}

/// More passes than fit between any two nets. Chosen.
const MOST_PASSES: u32 = 1000;

/// Half of a speed, which is its own where it cannot be halved.
fn half(feed: Feed) -> Option<Feed> {
    Feed::try_new(feed.get() / 2).or(Some(feed))
}

/// How wide the tool isolates that is taken where none is said.
fn usual_kerf(options: &Options) -> Nm {
    let defaults = Options::defaults();
    let depth = options.depth.or(defaults.depth).map_or(Nm::ZERO, Length::nm);
    let usual = defaults.tool.first().and_then(|choice| match choice {
        ToolChoice::Kind(kind) => Some(kind.width_at(depth)),
        ToolChoice::Named(_) => None,
    });
    usual.unwrap_or(Nm::MAX)
}

/// The options of a project behind a setting of ours.
pub(super) const BEHIND: &[(&str, &[&str])] = &[
    ("safe-z", &["zsafe"]),
    ("tool", &["mill-diameters", "offset"]),
    ("overlap", &["milling-overlap", "extra-passes"]),
    ("width", &["isolation-width"]),
    ("limit", &["offset"]),
    ("frame-margin", &["mill-diameters"]),
    ("cutout-tool", &["cutter-diameter"]),
    ("cutout-depth", &["zcut"]),
    ("cutout-pass", &["cut-infeed"]),
    ("tab-height", &["zbridges", "zcut"]),
    ("drill-depth", &["zdrill"]),
    ("drill-bore-tool", &["milldrill-diameter"]),
    ("tool-change", &["nom6"]),
    ("park", &["zchange"]),
    ("output-name", &["front-output", "back-output", "drill-output", "outline-output"]),
];

/// The line of a project with the first of these options that it has, the last of several.
pub(super) fn behind<'a>(names: &[&str], entries: &[Entry<'a>]) -> Option<Entry<'a>> {
    names.iter().find_map(|name| entries.iter().rev().find(|entry| entry.name == *name)).copied()
}
