//! How strongly neighbouring nets are coupled, as data and as text.

use std::fmt::Write as _;

use serde::Serialize;

use crate::coupling::strips::Substrate;
use crate::coupling::{Coupled, Coupling, Layout, Pair};
use crate::geometry::Nm;
use crate::topology::{NetId, Nets};

use super::quantity::Millimetres;
use crate::board::diagnostic::count;

/// The neighbours of a layer.
#[derive(Clone, Debug, Serialize)]
pub struct CouplingEntry {
    /// How wide cuts are.
    pub kerf_mm: Millimetres,
    /// Of the board, relative to the vacuum.
    pub permittivity: f64,
    /// How thick the board is.
    pub thickness_mm: f64,
    /// How many pairs of nets have regions that meet.
    pub pair_count: usize,
    /// All of them together, as they are cut and as they were drawn.
    pub capacitance_pf: Layouts,
    /// Pairs, those with the most capacitance as cut first.
    pub pairs: Vec<PairEntry>,
    /// The nets that were asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub nets: Vec<CoupledNetEntry>,
}

/// A figure of two layouts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Layouts {
    /// Voronoi regions, a cut apart.
    pub voronoi: f64,
    /// The copper as it was drawn, which outlines leave.
    pub as_drawn: f64,
}

/// Two nets whose regions meet.
#[derive(Clone, Debug, Serialize)]
pub struct PairEntry {
    /// Their names.
    pub between: [String; 2],
    /// The length of the boundary between them.
    pub boundary_mm: Millimetres,
    /// The integral of one by the gap along it.
    pub length_over_gap: Layouts,
    /// Their capacitance.
    pub capacitance_pf: Layouts,
}

/// A net with all its neighbours.
#[derive(Clone, Debug, Serialize)]
pub struct CoupledNetEntry {
    /// Its name.
    pub net: String,
    /// Its capacitance with them.
    pub capacitance_pf: Layouts,
    /// The `--limit` that takes four fifths of what regions add, where one does.
    pub limit_mm: Option<Millimetres>,
    /// What it then has.
    pub limited_pf: Option<f64>,
}

impl CouplingEntry {
    /// The neighbours of a layer cut `kerf` wide: all of them or the `most` strongest, and the nets
    /// that were `asked` for.
    #[must_use]
    pub fn new(
        coupling: &Coupling,
        nets: &Nets,
        (kerf, substrate): (Nm, Substrate),
        most: Option<usize>,
        asked: &[NetId],
    ) -> Self {
        let entry = |pair: &Pair| {
            let [regions, drawn] = [Layout::Regions, Layout::Drawn].map(|layout| coupling.of(pair, layout));
            let layouts = |figure: fn(&Coupled) -> f64| Layouts::new(figure(&regions), figure(&drawn));
            PairEntry {
                between: pair.nets.map(|net| nets.label(net)),
                boundary_mm: Millimetres(Nm::from_f64(pair.length)),
                length_over_gap: layouts(|coupled| coupled.length_over_gap),
                capacitance_pf: layouts(|coupled| coupled.picofarads),
            }
        };
        let mut pairs: Vec<PairEntry> = coupling.pairs.iter().map(entry).collect();
        let sum = |figure: fn(&Layouts) -> f64| pairs.iter().map(|pair| figure(&pair.capacitance_pf)).sum();
        let capacitance_pf = Layouts::new(sum(|pair| pair.voronoi), sum(|pair| pair.as_drawn));
        // Sorting is stable: equals stay by number.
        pairs.sort_by(|a, b| b.capacitance_pf.voronoi.total_cmp(&a.capacitance_pf.voronoi));
        let pair_count = pairs.len();
        pairs.truncate(most.unwrap_or(usize::MAX));
        Self {
            kerf_mm: Millimetres(kerf),
            permittivity: substrate.permittivity,
            thickness_mm: substrate.thickness,
            pair_count,
            capacitance_pf,
            pairs,
            nets: asked.iter().map(|&net| CoupledNetEntry::new(coupling, nets, net)).collect(),
        }
    }

    /// As a person reads it: the ten strongest, or all where `verbose`.
    #[must_use]
    pub fn to_text(&self, verbose: bool) -> String {
        let Layouts { voronoi, as_drawn } = self.capacitance_pf;
        let mut text = format!(
            "  coupling of regions {:.3} mm apart, on {:.1} mm of permittivity {:.1}: {voronoi:.1} pF in {}, as drawn {as_drawn:.1} pF\n",
            self.kerf_mm.0,
            self.thickness_mm,
            self.permittivity,
            count(self.pair_count, "pair"),
        );
        let shown = if verbose { self.pairs.len() } else { SHOWN.min(self.pairs.len()) };
        let name = |pair: &PairEntry| format!("{} and {}", pair.between[0], pair.between[1]);
        let widest = self.pairs[..shown].iter().map(|pair| name(pair).chars().count()).max().unwrap_or(0);
        if shown > 0 {
            let _ = writeln!(
                text,
                "    {:widest$}  {:>12}  {:>10} {:>9}  {:>9} {:>9}",
                "", "boundary", "length/gap", "as drawn", "pF", "as drawn"
            );
        }
        for pair in &self.pairs[..shown] {
            let (over, farads) = (pair.length_over_gap, pair.capacitance_pf);
            let _ = writeln!(
                text,
                "    {:widest$}  {:>9.2} mm  {:>10.0} {:>9.0}  {:>9.2} {:>9.2}",
                name(pair),
                pair.boundary_mm.0,
                over.voronoi,
                over.as_drawn,
                farads.voronoi,
                farads.as_drawn
            );
        }
        if self.pairs.len() > shown {
            let _ = writeln!(text, "    and {} more; -v lists them", self.pairs.len() - shown);
        }
        self.nets.iter().for_each(|net| text.push_str(&net.to_text()));
        text
    }
}

/// Pairs that are shown unless all are asked for. Chosen.
const SHOWN: usize = 10;

impl CoupledNetEntry {
    fn new(coupling: &Coupling, nets: &Nets, net: NetId) -> Self {
        let of = |layout| coupling.of_net(net, layout);
        let limit = coupling.limit_for(net);
        Self {
            net: nets.label(net),
            capacitance_pf: Layouts::new(of(Layout::Regions), of(Layout::Drawn)),
            limit_mm: limit.map(Millimetres),
            limited_pf: limit.map(|limit| rounded(of(Layout::Limited(limit)))),
        }
    }

    fn to_text(&self) -> String {
        let (net, Layouts { voronoi, as_drawn }) = (&self.net, self.capacitance_pf);
        let advice = match (self.limit_mm, self.limited_pf) {
            (Some(limit), Some(limited)) => format!("with --limit {}mm {limited:.2} pF", limit.0.to_mm()),
            _ => "no --limit changes that by much".to_owned(),
        };
        format!("  {net}: {voronoi:.2} pF with its neighbours, as drawn {as_drawn:.2} pF; {advice}\n")
    }
}

impl Layouts {
    fn new(regions: f64, drawn: f64) -> Self {
        Self { voronoi: rounded(regions), as_drawn: rounded(drawn) }
    }
}

/// Three decimals: an estimate has no more.
fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}
