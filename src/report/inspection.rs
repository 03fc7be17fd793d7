//! What is in the files of a board, as data and as text.

use std::fmt::Write as _;

use serde::Serialize;

use crate::board::{Side, Source};

use super::coupling::CouplingEntry;
use super::document::{DrillEntry, GapEntry, NetEntry, WarningEntry};
use super::methods::MethodsEntry;
use super::neighbours::NeighboursEntry;
use super::paper::PaperEntry;
use super::prediction::PredictionEntry;
use super::quantity::Millimetres;
use super::summary::warnings;
use crate::board::diagnostic::count;

/// What `voromill inspect` says.
#[derive(Clone, Debug, Serialize)]
pub struct Inspection {
    /// The version of this shape, as of [`Document`](super::Document).
    pub schema_version: u32,
    /// The board's name.
    pub board: String,
    /// Its width and height.
    pub size_mm: Option<[Millimetres; 2]>,
    /// Whether an outline was found.
    pub outline: bool,
    /// The files.
    pub sources: Vec<Source>,
    /// Files and folders beside them that are no layer of a board.
    pub ignored: Vec<String>,
    /// The copper, front first.
    pub layers: Vec<InspectedLayer>,
    /// How many nets the assembled board has, its sides joined through plated holes.
    pub electrical_nets: Option<usize>,
    /// Holes by diameter.
    pub drills: Vec<DrillEntry>,
    /// What was repaired, left out, or looks wrong.
    pub warnings: Vec<WarningEntry>,
}

/// One layer of copper.
#[derive(Clone, Debug, Serialize)]
pub struct InspectedLayer {
    /// Which.
    pub side: Side,
    /// Pieces of copper in the file.
    pub features: usize,
    /// Islands of copper, by number.
    pub nets: Vec<NetEntry>,
    /// The narrowest place between two of them.
    pub smallest_gap: Option<GapEntry>,
    /// How the three ways to find nets compare, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub methods: Option<MethodsEntry>,
    /// How long toolpaths will be, where there are nets to part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub prediction: Option<PredictionEntry>,
    /// How strongly neighbouring nets are coupled, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coupling: Option<CouplingEntry>,
    /// How its neighbours by thinning compare, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thinning: Option<NeighboursEntry>,
    /// The paper's figures, where they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub paper: Option<PaperEntry>,
}

impl Inspection {
    /// As JSON text, indented, ended by a line feed.
    #[must_use]
    pub fn to_json(&self) -> String {
        super::quantity::json(self)
    }

    /// As a person reads it; apertures and all names where `verbose`.
    #[must_use]
    pub fn to_text(&self, verbose: bool) -> String {
        let mut text = self.board.clone();
        if let Some([width, height]) = self.size_mm {
            let _ = write!(text, ", {:.2} × {:.2} mm", width.0, height.0);
        }
        text.push_str(if self.outline { "\n" } else { ", no outline\n" });
        for source in &self.sources {
            text.push_str(&file(source, verbose));
        }
        if !self.ignored.is_empty() {
            let _ = writeln!(text, "\nno layer of a board: {}", self.ignored.join(", "));
        }
        for layer in &self.layers {
            text.push_str(&self::layer(layer, verbose));
        }
        if let Some(nets) = self.electrical_nets {
            let _ = writeln!(text, "\nboth sides joined through plated holes: {}", count(nets, "net"));
        }
        if !self.drills.is_empty() {
            text.push_str("\nholes\n");
        }
        for drill in &self.drills {
            let slots =
                if drill.slots > 0 { format!(", {}", count(drill.slots, "slot")) } else { String::new() };
            let _ =
                writeln!(text, "  {:>7.3} mm  {}{slots}", drill.diameter_mm.0, count(drill.holes, "hole"));
        }
        text.push_str(&warnings(&self.warnings, verbose));
        text
    }
}

/// One of what a count is of: a hole of holes, a flash of flashes.
fn one_of(many: &str) -> &str {
    let end = if many.ends_with("shes") { "es" } else { "s" };
    many.strip_suffix(end).unwrap_or(many)
}

fn file(source: &Source, verbose: bool) -> String {
    let some = source.counts.iter().filter(|(_, n)| **n > 0);
    let counts: Vec<String> =
        some.map(|(what, &n)| format!("{n} {}", if n == 1 { one_of(what) } else { what })).collect();
    let details = [source.format.as_str(), &source.units, &source.number_format];
    let details: Vec<&str> = details.into_iter().filter(|detail| !detail.is_empty()).collect();
    let mut text = format!("\n{}: {}\n", source.file, source.role);
    let _ = writeln!(text, "  {}, {} bytes", details.join(", "), source.bytes);
    if let Some(generator) = &source.generator {
        let _ = writeln!(text, "  written by {generator}");
    }
    if !counts.is_empty() {
        let _ = writeln!(text, "  {}", counts.join(", "));
    }
    let used = source.apertures.iter().filter(|aperture| aperture.flashes + aperture.draws > 0).count();
    if verbose {
        for aperture in &source.apertures {
            let _ = writeln!(
                text,
                "  {:5} {:32} {:>6} flashed {:>6} drawn",
                aperture.name, aperture.what, aperture.flashes, aperture.draws
            );
        }
    } else if !source.apertures.is_empty() {
        let _ =
            writeln!(text, "  {used} of {} used; -v lists them", count(source.apertures.len(), "aperture"));
    }
    text
}

fn layer(layer: &InspectedLayer, verbose: bool) -> String {
    let mut text = format!(
        "\n{} copper: {} in {}\n",
        layer.side,
        count(layer.features, "feature"),
        count(layer.nets.len(), "net")
    );
    if let Some(gap) = &layer.smallest_gap {
        let [a, b] = &gap.between;
        let _ = writeln!(
            text,
            "  smallest gap {:.4} mm between {a} and {b}, at {:.3}, {:.3} mm",
            gap.width_mm.0, gap.at.x_mm.0, gap.at.y_mm.0
        );
    }
    let named: Vec<&str> = layer.nets.iter().filter(|net| net.named).map(|net| net.name.as_str()).collect();
    if !named.is_empty() {
        let shown = if verbose { named.len() } else { 12 };
        let rest = named.len().saturating_sub(shown);
        let more = if rest > 0 { format!(" and {rest} more; -v lists them") } else { String::new() };
        let _ = writeln!(text, "  {}{more}", named[..named.len() - rest].join(", "));
    }
    text.extend(layer.methods.as_ref().map(|methods| methods.to_text(verbose)));
    text.extend(layer.prediction.as_ref().map(PredictionEntry::to_text));
    text.extend(layer.coupling.as_ref().map(|coupling| coupling.to_text(verbose)));
    text.extend(layer.thinning.as_ref().map(|thinning| thinning.to_text(verbose)));
    text.extend(layer.paper.as_ref().map(PaperEntry::to_text));
    text
}
