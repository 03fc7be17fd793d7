//! The report as a person reads it in ten seconds.

use std::fmt::Write as _;

use super::document::{Document, Figures, LayerEntry, ToolChanges, WarningEntry};
use crate::board::diagnostic::count;
use crate::board::{self, Diagnostic, Severity};
use crate::toolpath::duration;

/// Warnings of one kind that are shown; the rest are counted. Chosen.
const SHOWN: usize = 3;

impl Document {
    /// A short table and the warnings; all of them where `verbose`.
    #[must_use]
    pub fn summary(&self, verbose: bool) -> String {
        let mut text = format!("{}{}\n", self.board, self.size());
        for layer in &self.layers {
            let gap = layer.smallest_gap.as_ref().map_or(String::new(), |gap| {
                let [a, b] = &gap.between;
                format!(", smallest gap {:.3} mm between {a} and {b}", gap.width_mm.0)
            });
            let slight = match layer.negligible_gaps {
                0 => String::new(),
                gaps => format!(", {} narrower than the kerf by little (no warning)", count(gaps, "gap")),
            };
            let lengths = layer.lengths();
            let _ = writeln!(
                text,
                "  {}: {}{gap}, {lengths}{slight}",
                layer.side,
                count(layer.nets.len(), "net")
            );
            if let Some(strategy) = &layer.strategy {
                let time =
                    [strategy.seconds, strategy.voronoi_seconds, strategy.outline_seconds].map(duration);
                let _ = writeln!(
                    text,
                    "  {}: loops round {} of {}, regions for the others: {}; {} with regions alone, {} with loops alone",
                    layer.side,
                    strategy.outlined_nets,
                    count(layer.nets.len(), "net"),
                    time[0],
                    time[1],
                    time[2]
                );
            }
            if let Some(colours) = layer.translucency.as_ref().filter(|_| verbose) {
                let _ = write!(text, "  {}", colours.to_text());
            }
        }
        let holes: usize = self.drills.iter().map(|drill| drill.holes + drill.slots).sum();
        if holes > 0 {
            let _ = writeln!(text, "  {} for {}", count(holes, "hole"), count(self.drills.len(), "drill"));
        }
        if !self.programs.is_empty() {
            text.push('\n');
            text.push_str(&self.table());
        }
        if let Some(verdict) = &self.verification {
            text.push('\n');
            text.push_str(&verdict.to_text(verbose));
        }
        text.push_str(&warnings(&self.warnings, verbose));
        match &self.verification {
            Some(verdict) => {
                let told = self.warnings.iter().filter(|warning| !warning.kind.is_bookkeeping()).count();
                text.push_str(&verdict.fitness(told));
            }
            None if self.programs.is_empty() => {}
            None => text.push_str("  not verified: whether it is fit to mill is not known\n"),
        }
        text
    }

    fn size(&self) -> String {
        self.size_mm.map_or(String::new(), |[width, height]| format!(", {:.1} × {:.1} mm", width.0, height.0))
    }

    /// A line for each program, and one for all.
    fn table(&self) -> String {
        let widest =
            self.programs.iter().map(|program| program.file.chars().count()).max().unwrap_or(0).max(15);
        let row = |name: &str, figures: &Figures| {
            let [cut, rapid] = [figures.cut_mm, figures.rapid_mm].map(|length| format!("{:.0} mm", length.0));
            let time = duration(figures.seconds);
            format!("  {name:widest$}  {cut:>9}  {rapid:>9}  {:>8}  {time:>9}\n", figures.retracts)
        };
        let mut text =
            format!("  {:widest$}  {:>9}  {:>9}  {:>8}  {:>9}\n", "", "cut", "rapid", "retracts", "time");
        for program in &self.programs {
            text.push_str(&row(&program.file, &program.figures));
        }
        let ToolChanges { count: changes, seconds } = self.tool_changes;
        if changes > 0 {
            let (name, time) = (count(changes as usize, "tool change"), duration(seconds));
            let _ = writeln!(text, "  {name:widest$}  {:>9}  {:>9}  {:>8}  {time:>9}", "", "", "");
        }
        if self.programs.len() > 1 || changes > 0 {
            text.push_str(&row("total", &self.total));
        }
        text
    }
}

impl LayerEntry {
    /// How long its boundaries are, without and with the frame cut.
    fn lengths(&self) -> String {
        let bare = self.boundary_length_mm.0;
        let framed = self
            .frame_length_mm
            .map_or(String::new(), |frame| format!(", {:.0} mm with the frame cut", bare + frame.0));
        format!("boundaries {bare:.0} mm{framed}")
    }
}

/// The warnings by kind, of each the first few unless `verbose`, below an empty line; nothing where
/// there are none.
#[must_use]
pub fn warnings(warnings: &[WarningEntry], verbose: bool) -> String {
    let shown = || warnings.iter().filter(|warning| verbose || !warning.kind.is_bookkeeping());
    let mut text = if shown().next().is_none() { String::new() } else { "\n".to_owned() };
    let mut kinds: Vec<&Diagnostic> = Vec::new();
    for warning in shown() {
        if !kinds.contains(&warning.kind) {
            kinds.push(warning.kind);
        }
    }
    for kind in kinds {
        let shown = if verbose { usize::MAX } else { SHOWN };
        let same = || warnings.iter().filter(|warning| warning.kind == kind);
        for warning in same().take(shown) {
            text.push_str(&warning.to_text());
        }
        let rest = same().count().saturating_sub(shown);
        if rest > 0 {
            let _ = writeln!(text, "  warning: {rest} more [{}]; -v shows all", kind.code);
        }
    }
    text
}

impl WarningEntry {
    /// The sentence with the code to filter by, the place with what stands there, and what to do:
    /// indented lines.
    #[must_use]
    pub fn to_text(&self) -> String {
        let what = format!("{}{} [{}]", self.place(), self.message, self.kind.code);
        let [expected, advice] = self
            .help
            .map_or_else(Default::default, |help| [help.expected, help.advice].map(|w| w.to_string()));
        let shown = board::show(Severity::Warning, &what, self.source.as_ref(), &expected, &advice);
        shown.lines().flat_map(|line| ["  ", line, "\n"]).collect()
    }

    /// Where on the board it belongs; nothing for what concerns all of it.
    fn place(&self) -> String {
        let side = self.side.map_or(String::new(), |side| format!("{side} "));
        match self.at {
            Some(at) => format!("{side}at {:.3}, {:.3} mm: ", at.x_mm.0, at.y_mm.0),
            None if side.is_empty() || self.source.is_some() => String::new(),
            None => format!("{}: ", side.trim_end()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::diagnostic::planning;
    use crate::geometry::Nm;
    use crate::report::document::Millimetres;

    #[test]
    fn many_warnings_of_one_kind_are_counted() {
        let one = |n: i32| WarningEntry {
            kind: &planning::GAP_NARROWER_THAN_TOOL,
            message: format!("gap {n}"),
            side: None,
            at: None,
            source: None,
            help: None,
            size_mm: None,
            places: Vec::new(),
        };
        let all: Vec<_> = (1..=5).map(one).collect();
        let short = warnings(&all, false);
        assert!(short.contains("gap 3") && !short.contains("gap 4"), "{short}");
        assert!(short.contains("2 more [gap-narrower-than-tool]"), "{short}");
        assert!(warnings(&all, true).contains("gap 5"), "verbose shows all");
    }

    #[test]
    fn lengths_are_told_with_the_frame_and_without() {
        let layer = |frame_length_mm: Option<Millimetres>| LayerEntry {
            side: board::Side::Front,
            features: 0,
            nets: Vec::new(),
            translucency: None,
            smallest_gap: None,
            boundaries: 1,
            vertices: 0,
            boundary_length_mm: Millimetres(Nm::from_mm(208)),
            frame_length_mm,
            negligible_gaps: 0,
            strategy: None,
            coupling: None,
        };
        assert_eq!(layer(None).lengths(), "boundaries 208 mm", "an outline is no frame cut");
        let framed = layer(Some(Millimetres(Nm::from_mm(81)))).lengths();
        assert_eq!(framed, "boundaries 208 mm, 289 mm with the frame cut", "both lengths");
    }
}
