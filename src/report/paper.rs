//! The figures of the paper's Table V for a layer, the paper's way and voromill's, as data and as
//! text.

use std::fmt::Write as _;

use serde::Serialize;

/// One row of Table V, twice. Lengths are in inches, as in the paper.
#[derive(Clone, Debug, Serialize)]
pub struct PaperEntry {
    /// Traces that shared vertices leave (Algorithm 1).
    pub coincident: usize,
    /// Traces that overlaps in the picture leave of these (Algorithm 2): the paper's "traces".
    pub traces: usize,
    /// The box round the copper.
    pub area_in2: f64,
    /// How long Algorithms 1 and 2 took.
    pub overlap_s: f64,
    /// How long drawing, tracing and simplifying the Voronoi picture took (Algorithm 3).
    pub toolpaths_s: f64,
    /// The frame cut, which Voronoi lengths contain.
    pub frame_in: f64,
    /// From a picture of 500 DPI, as the paper has it.
    pub paper: Columns,
    /// From exact boundaries between copper edges.
    pub exact: Columns,
}

/// The columns that depend on how boundaries are found.
#[derive(Clone, Debug, Serialize)]
pub struct Columns {
    /// Round every trace.
    pub outline: Paths,
    /// Between Voronoi regions, and once round the frame.
    pub voronoi: Paths,
    /// The mean of copper area by stroke length.
    pub normal_width_in: f64,
    /// The mean of region area by stroke length.
    pub voronoi_width_in: f64,
}

/// Toolpaths of one kind.
#[derive(Clone, Debug, Serialize)]
pub struct Paths {
    /// How many.
    pub paths: usize,
    /// The length of the staircase between pixels, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub staircase_in: Option<f64>,
    /// Their length.
    pub length_in: f64,
    /// How many segments they have.
    pub segments: usize,
}

impl Columns {
    /// The paper's "length savings": how much longer the outline is than the Voronoi paths, in
    /// percent of these.
    #[must_use]
    pub fn savings(&self) -> f64 {
        percent(self.outline.length_in / self.voronoi.length_in - 1.0)
    }

    /// How much shorter the Voronoi paths, less the frame, are than the outline, in percent of it.
    #[must_use]
    pub fn decrease(&self, frame: f64) -> f64 {
        percent(1.0 - (self.voronoi.length_in - frame) / self.outline.length_in)
    }

    /// How much wider Voronoi regions are than traces, in percent.
    #[must_use]
    pub fn increase(&self) -> f64 {
        percent(self.voronoi_width_in / self.normal_width_in - 1.0)
    }
}

/// In percent; zero where there was nothing to compare with.
fn percent(fraction: f64) -> f64 {
    if fraction.is_finite() { fraction * 100.0 } else { 0.0 }
}

impl PaperEntry {
    /// As a person reads it.
    pub(super) fn to_text(&self) -> String {
        let mut text = format!(
            "  Table V: {} traces ({} by Algorithm 1 alone), {:.1} in², overlap {:.2} s, toolpaths {:.2} s\n",
            self.traces, self.coincident, self.area_in2, self.overlap_s, self.toolpaths_s
        );
        let _ = writeln!(text, "  {:44}  {:>11}  {:>11}", "", "paper's way", "exact paths");
        let mut row = |what: &str, unit: &str, decimals: usize, of: &dyn Fn(&Columns) -> Option<f64>| {
            let cell = |columns: &Columns| {
                of(columns).map_or(String::new(), |value| format!("{value:.decimals$} {unit}"))
            };
            let _ = writeln!(text, "  {what:44}  {:>11}  {:>11}", cell(&self.paper), cell(&self.exact));
        };
        row("outline, staircase", "in", 3, &|columns| columns.outline.staircase_in);
        row("outline", "in", 3, &|columns| Some(columns.outline.length_in));
        row("Voronoi, staircase, with the frame", "in", 3, &|columns| columns.voronoi.staircase_in);
        row("Voronoi, with the frame", "in", 3, &|columns| Some(columns.voronoi.length_in));
        row("Voronoi, without the frame", "in", 3, &|columns| {
            Some(columns.voronoi.length_in - self.frame_in)
        });
        row("length savings (outline ÷ Voronoi − 1)", "%", 1, &|columns| Some(columns.savings()));
        row("decrease (1 − Voronoi ÷ outline)", "%", 1, &|columns| Some(columns.decrease(0.0)));
        row("decrease without the frame", "%", 1, &|columns| Some(columns.decrease(self.frame_in)));
        row("normal width", "in", 5, &|columns| Some(columns.normal_width_in));
        row("Voronoi width", "in", 5, &|columns| Some(columns.voronoi_width_in));
        row("width increase", "%", 0, &|columns| Some(columns.increase()));
        text
    }
}
