//! How strongly neighbouring nets are coupled, before and after Voronoi regions (the paper's
//! §III-D.1).
//!
//! The paper warns that regions which meet along one cut lie side by side for longer, and closer,
//! than the traces that were drawn, so that parasitic capacitance grows. How much, each pair of
//! neighbours tells here, as *length over gap* and as an estimate in picofarads:
//!
//! ```text
//!  as drawn: ▓▓▓   2c   ▓▓▓▓     as cut: ▓▓▓▓▓▓▓╳▓▓▓▓▓▓▓▓▓     limited to δ: ▓▓▓▓▓╳   ╳▓▓▓▓▓▓
//!               │    │                    kerf ┘ └                            leftover copper
//! ```
//!
//! Both are integrals along the boundary between the two: of 1 ÷ gap, and of what two coplanar
//! strips have per unit length ([`strips`]). As drawn, the gap at a place of the boundary is twice
//! its clearance; as cut it is the kerf. A strip is as wide as the net's copper, or region, is on
//! average: twice its area by its perimeter. Where regions are limited and do not meet, the way
//! between them is the gap.
//!
//! It is an estimate for comparing layouts: strips bend, have ends and further neighbours, and
//! copper left over between loops, which belongs to nobody, is taken for bare board; it floats, and
//! adds a little. Copper's thickness and the groove in the board, which all but cancel (35 µm of
//! wall beside 0.1 to 0.2 mm of board taken away), are left out.

pub mod strips;

use std::collections::BTreeMap;

use crate::geometry::{Nm, Point};
use crate::topology::{Extent, NetId};
use crate::voronoi::{Boundaries, Boundary, Diagram, Owner};

use strips::{Substrate, capacitance};

/// How nets lie beside each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// As they were drawn, and an outline leaves them where the copper beside them is taken away.
    Drawn,
    /// As Voronoi regions with a cut between them.
    Regions,
    /// As regions that reach so far from their copper at most.
    Limited(Nm),
}

/// The length of a part of a boundary, and the clearance in its middle, in millimetres.
type Stretch = (f64, f64);

/// Two nets whose regions meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The nets, the smaller number first.
    pub nets: [NetId; 2],
    /// The length of the boundary between them, in nanometres.
    pub length: f64,
    stretches: Vec<Stretch>,
}

/// What two nets are to each other in a layout.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coupled {
    /// The integral of one by the gap along their boundary.
    pub length_over_gap: f64,
    /// The estimate of their capacitance.
    pub picofarads: f64,
}

/// The neighbours of a layer.
#[derive(Clone, Debug)]
pub struct Coupling {
    /// Pairs by their nets.
    pub pairs: Vec<Pair>,
    /// The width of cuts in millimetres.
    kerf: f64,
    substrate: Substrate,
    /// How wide copper is on average, and regions, by net, in millimetres.
    copper: Vec<f64>,
    regions: Vec<f64>,
}

/// How long a stretch is at most, in millimetres, and by the clearance before it, if that is more:
/// along it clearance is nearly even. Chosen: a quarter of a common gap, and an eighth of its own.
const STRETCH: f64 = 0.1;
const PART: f64 = 0.25;
/// What copper is taken for that has no width, in millimetres, so that there is an answer.
const LEAST: f64 = 0.01;

impl Coupling {
    /// The neighbours by the `boundaries` of a `diagram` without a limit, where copper has these
    /// `extents` and cuts are `kerf` wide.
    #[must_use]
    pub fn new(
        diagram: &Diagram,
        boundaries: &Boundaries,
        extents: &[Extent],
        kerf: Nm,
        substrate: Substrate,
    ) -> Self {
        let mut perimeters = vec![0.0; extents.len()];
        let mut pairs: BTreeMap<[NetId; 2], (f64, Vec<Stretch>)> = BTreeMap::new();
        for edge in &boundaries.edges {
            for owner in [edge.left, edge.right] {
                if let Owner::Net(net) = owner {
                    perimeters[net.index()] += edge.path.length();
                }
            }
            if let (Owner::Net(left), Owner::Net(right)) = (edge.left, edge.right) {
                let (length, stretches) = pairs.entry([left.min(right), left.max(right)]).or_default();
                *length += edge.path.length();
                stretches.extend(along(edge, diagram));
            }
        }
        let areas = boundaries.areas(extents.len());
        let mean = |(area, perimeter): (f64, f64)| 2.0 * area / f64::max(perimeter, 1.0) / 1e6;
        let pairs = pairs.into_iter();
        Self {
            pairs: pairs.map(|(nets, (length, all))| Pair { nets, length, stretches: merged(all) }).collect(),
            kerf: kerf.to_mm(),
            substrate,
            copper: extents.iter().map(|extent| extent.mean_width() / 1e6).collect(),
            regions: areas.into_iter().zip(perimeters).map(mean).collect(),
        }
    }

    /// What the nets of a pair are to each other in a layout.
    #[must_use]
    pub fn of(&self, pair: &Pair, layout: Layout) -> Coupled {
        let widths = pair.nets.map(|net| self.width(net, layout));
        // As cut the gap is the same everywhere.
        let whole = [(pair.length / 1e6, 0.0)];
        let stretches = if layout == Layout::Regions { &whole[..] } else { &pair.stretches };
        stretches.iter().fold(Coupled::default(), |sum, &(length, clearance)| {
            let gap = self.gap(clearance, layout);
            Coupled {
                length_over_gap: sum.length_over_gap + length / gap,
                picofarads: sum.picofarads + length * capacitance(gap, widths, self.substrate),
            }
        })
    }

    /// The picofarads of a net with all its neighbours.
    #[must_use]
    pub fn of_net(&self, net: NetId, layout: Layout) -> f64 {
        let own = self.pairs.iter().filter(|pair| pair.nets.contains(&net));
        own.map(|pair| self.of(pair, layout).picofarads).sum()
    }

    /// The farthest limit of regions at which a net keeps a fifth at most of what regions without
    /// one add to its capacitance; none where none of them does so.
    #[must_use]
    pub fn limit_for(&self, net: NetId) -> Option<Nm> {
        let [drawn, regions] = [Layout::Drawn, Layout::Regions].map(|layout| self.of_net(net, layout));
        let enough = drawn + KEPT * (regions - drawn);
        let mut limits = LIMITS.into_iter().map(Nm::from_um).filter(|limit| limit.to_mm() > self.kerf / 2.0);
        limits.find(|&limit| self.of_net(net, Layout::Limited(limit)) <= enough)
    }

    /// What lies between two nets where the boundary's clearance is so much, in millimetres.
    fn gap(&self, clearance: f64, layout: Layout) -> f64 {
        let drawn = (2.0 * clearance).max(self.kerf);
        match layout {
            Layout::Drawn => drawn,
            Layout::Regions => self.kerf,
            // Cuts run at the limit: half of each is beyond it.
            Layout::Limited(limit) => (2.0 * (clearance - limit.to_mm()) + self.kerf).clamp(self.kerf, drawn),
        }
    }

    fn width(&self, net: NetId, layout: Layout) -> f64 {
        let (copper, region) = (self.copper[net.index()], self.regions[net.index()] - self.kerf);
        let width = match layout {
            Layout::Drawn => copper,
            Layout::Regions => region.max(copper),
            Layout::Limited(limit) => {
                (copper + 2.0 * limit.to_mm() - self.kerf).clamp(copper, region.max(copper))
            }
        };
        width.max(LEAST)
    }
}

/// What a limit may leave of what regions add. Chosen.
const KEPT: f64 = 0.2;
/// Limits worth naming, in micrometres. Chosen.
const LIMITS: [i64; 12] = [5000, 3000, 2000, 1500, 1000, 800, 600, 500, 400, 300, 200, 150];

/// Stretches whose clearances differ by less than this part are one. Chosen: a fiftieth of a gap
/// changes the capacitance by less than a hundredth.
const ALIKE: f64 = 0.02;

/// The same stretches, those of like clearance made one.
fn merged(mut stretches: Vec<Stretch>) -> Vec<Stretch> {
    stretches.sort_by(|a, b| a.1.total_cmp(&b.1));
    let runs = stretches.into_iter().fold(Vec::<(Stretch, f64)>::new(), |mut runs, (length, clearance)| {
        match runs.last_mut() {
            Some(((all, mean), least)) if clearance <= *least * (1.0 + ALIKE) => {
                *mean = (*mean * *all + clearance * length) / (*all + length).max(f64::MIN_POSITIVE);
                *all += length;
            }
            _ => runs.push(((length, clearance), clearance)),
        }
        runs
    });
    runs.into_iter().map(|(stretch, _)| stretch).collect()
}

/// Stretches of a boundary with the clearance in their middle, in millimetres: between the vertices
/// of a path it may be more than at both.
fn along(edge: &Boundary, diagram: &Diagram) -> Vec<Stretch> {
    let mut found = Vec::new();
    let mut clearance = 0.0;
    for (from, segment) in edge.path.steps() {
        let length = segment.length(from) / 1e6;
        let (start, end) = (from.to_f64(), segment.to().to_f64());
        let mut done = 0.0;
        while done < length {
            let stretch = f64::max(STRETCH, PART * clearance).min(length - done);
            let middle = (done + stretch / 2.0) / length;
            let straight = (start.0 + (end.0 - start.0) * middle, start.1 + (end.1 - start.1) * middle);
            let (x, y) = segment.arc(from).map_or(straight, |arc| arc.at(middle));
            clearance = diagram.clearance_at(Point::from_f64(x, y)).unwrap_or_default() / 1e6;
            found.push((stretch, clearance));
            done += stretch;
        }
    }
    found
}
