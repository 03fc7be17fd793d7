//! Sites by place: the distance to any owner, wherever one asks.

use rustc_hash::FxHashMap;
use static_aabb2d_index::{Control, StaticAABB2DIndex, StaticAABB2DIndexBuilder};

use super::BACKGROUND;
use super::plane::Spot;
use super::seed::Sites;
use super::site::{Form, Reach, Rings, Site};

/// An index of the sites that have an edge of their own.
pub(super) struct Near {
    labels: Vec<u32>,
    /// The box of each, left, bottom, right, top: a look at it spares most distances.
    boxes: Vec<[f64; 4]>,
    index: StaticAABB2DIndex<f64>,
    /// The entries of each owner that has few.
    owned: FxHashMap<u32, Vec<usize>>,
}

/// How many sites an owner has at most for them to be asked one by one. Chosen: traces and pads
/// have fewer, pours more. Where hundreds of traces point at one place, the nearest of a given one
/// is the last of them all in the order of their boxes.
const FEW: usize = 64;

impl Near {
    /// The index of `sites`; none where there are none.
    pub(super) fn new(sites: &Sites) -> Option<Self> {
        let boxes: Vec<(u32, [f64; 4])> = (0..)
            .zip(&sites.sites)
            .filter_map(|(label, site)| Some((label, bounds(site, &sites.rings, label)?)))
            .collect();
        let mut builder = StaticAABB2DIndexBuilder::new(boxes.len());
        for (_, [left, bottom, right, top]) in &boxes {
            builder.add(*left, *bottom, *right, *top);
        }
        let index = builder.build().ok()?;
        let (labels, boxes): (Vec<u32>, Vec<_>) = boxes.into_iter().unzip();
        let mut owned: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
        for (entry, &label) in labels.iter().enumerate() {
            owned.entry(sites.sites[label as usize].owner).or_default().push(entry);
        }
        owned.retain(|_, entries| entries.len() <= FEW);
        Some(Self { labels, boxes, index, owned })
    }

    /// The site that is nearer to `p` than `bound`, in nanometres, among those that are accepted by
    /// label and owner: the nearest such. `p` lies on no copper.
    pub(super) fn nearer(
        &self,
        sites: &Sites,
        p: Spot,
        bound: f64,
        accept: impl Fn(u32, u32) -> bool,
    ) -> Option<u32> {
        let mut nearest = (bound, None);
        self.visit_box(p, bound, &mut |i| {
            if accept(self.labels[i], sites.sites[self.labels[i] as usize].owner)
                && self.is_box_within(i, p, nearest.0)
            {
                self.take_nearer(sites, i, p, &mut nearest);
            }
        });
        nearest.1
    }

    /// Shows the entries of sites whose boxes come within `radius` of `p`, with their owners, in an
    /// order that is the same wherever one asks.
    pub(super) fn visit(&self, sites: &Sites, p: Spot, radius: f64, mut show: impl FnMut(u32, u32)) {
        self.visit_box(p, radius, &mut |i| {
            if self.is_box_within(i, p, radius) {
                show(
                    u32::try_from(i).expect("as many as labels"),
                    sites.sites[self.labels[i] as usize].owner,
                );
            }
        });
    }

    /// The same as [`nearer`](Self::nearer), among some entries.
    pub(super) fn nearest_of(
        &self,
        sites: &Sites,
        entries: &[u32],
        p: Spot,
        bound: f64,
        accept: impl Fn(u32) -> bool,
    ) -> Option<u32> {
        let mut nearest = (bound, None);
        for i in entries.iter().map(|&entry| entry as usize) {
            if self.is_box_within(i, p, nearest.0) && accept(self.labels[i]) {
                self.take_nearer(sites, i, p, &mut nearest);
            }
        }
        nearest.1
    }

    fn visit_box(&self, p: Spot, reach: f64, visit: &mut impl FnMut(usize)) {
        self.index.visit_query(p.x - reach, p.y - reach, p.x + reach, p.y + reach, visit);
    }

    /// Puts the site of entry `i` in the place of the nearest so far if it is nearer.
    fn take_nearer(&self, sites: &Sites, i: usize, p: Spot, nearest: &mut (f64, Option<u32>)) {
        let site = &sites.sites[self.labels[i] as usize];
        let rank = rank(site, site.reach(&sites.rings, p));
        if rank < nearest.0 {
            *nearest = (rank, Some(self.labels[i]));
        }
    }

    /// Shows `look` every site whose box comes nearer than `room`, in nanometres, to that of two
    /// places: its label, and its box.
    pub(super) fn visit_along(&self, a: Spot, b: Spot, room: f64, look: &mut dyn FnMut(u32, [f64; 4])) {
        let (left, right) = (a.x.min(b.x) - room, a.x.max(b.x) + room);
        let (bottom, top) = (a.y.min(b.y) - room, a.y.max(b.y) + room);
        self.index.visit_query(left, bottom, right, top, &mut |i: usize| look(self.labels[i], self.boxes[i]));
    }

    /// Whether the box of entry `i` comes nearer to `p` than `bound`, in nanometres.
    fn is_box_within(&self, i: usize, p: Spot, bound: f64) -> bool {
        comes_within(self.boxes[i], p, bound)
    }

    /// The distance from `p` to the nearest site, in nanometres; zero inside it.
    pub(super) fn distance(&self, sites: &Sites, p: Spot) -> f64 {
        self.reach(sites, p, |_| true).distance.max(0.0)
    }

    /// The signed distance from `p` to the nearest site whose owner is accepted.
    pub(super) fn reach(&self, sites: &Sites, p: Spot, accept: impl Fn(u32) -> bool) -> Reach {
        self.nearest(sites, p, accept).1
    }

    /// The signed distance from `p` to the nearest site of `owner`.
    pub(super) fn reach_of(&self, sites: &Sites, p: Spot, owner: u32) -> Reach {
        let Some(entries) = self.owned.get(&owner) else {
            return self.reach(sites, p, |other| other == owner);
        };
        let mut nearest = Reach { distance: f64::INFINITY, away: Spot::default() };
        let mut least = f64::INFINITY;
        for &i in entries {
            if least.is_finite() && !self.is_box_within(i, p, least) {
                continue;
            }
            let site = &sites.sites[self.labels[i] as usize];
            let reach = site.reach(&sites.rings, p);
            if rank(site, reach) < least {
                (least, nearest) = (rank(site, reach), reach);
            }
        }
        nearest
    }

    /// The owner of the nearest site among those accepted, and the signed distance to it.
    pub(super) fn nearest(&self, sites: &Sites, p: Spot, accept: impl Fn(u32) -> bool) -> (u32, Reach) {
        let mut nearest = (BACKGROUND, Reach { distance: f64::INFINITY, away: Spot::default() });
        let mut least = f64::INFINITY;
        self.index.visit_neighbors(p.x, p.y, &mut |i: usize, squared: f64| {
            if squared.sqrt() >= least {
                return Control::Break(());
            }
            let site = &sites.sites[self.labels[i] as usize];
            if accept(site.owner) {
                let reach = site.reach(&sites.rings, p);
                if rank(site, reach) < least {
                    (least, nearest) = (rank(site, reach), (site.owner, reach));
                }
            }
            Control::Continue
        });
        nearest
    }
}

/// Whether a box, left, bottom, right, top, comes nearer to `p` than `bound`, in nanometres.
pub(super) fn comes_within([left, bottom, right, top]: [f64; 4], p: Spot, bound: f64) -> bool {
    let x = (left - p.x).max(p.x - right).max(0.0);
    let y = (bottom - p.y).max(p.y - top).max(0.0);
    x * x + y * y < bound * bound
}

/// The insides of polygons by owner, each with its box.
pub(super) struct Insides(FxHashMap<u32, Vec<(u32, [f64; 4])>>);

impl Insides {
    pub(super) fn new(sites: &Sites) -> Self {
        let mut insides: FxHashMap<u32, Vec<(u32, [f64; 4])>> = FxHashMap::default();
        for (label, site) in (0..).zip(&sites.sites) {
            if let Form::Inside { first_ring, rings: count } = site.form {
                let rings = first_ring..first_ring + count;
                let mut vertices = rings.flat_map(|ring| sites.rings.ring(ring).iter().copied());
                insides.entry(site.owner).or_default().push((label, around(&mut vertices, 0.0)));
            }
        }
        Self(insides)
    }

    /// The signed distance to the edge of a polygon of `owner` that holds `p`; none where none
    /// does.
    pub(super) fn reach(&self, sites: &Sites, p: Spot, owner: u32) -> Option<Reach> {
        let holds = |[left, bottom, right, top]: [f64; 4]| {
            (left..=right).contains(&p.x) && (bottom..=top).contains(&p.y)
        };
        let within = self.0.get(&owner)?.iter().filter(|(_, bounds)| holds(*bounds));
        let mut reaches = within.map(|&(label, _)| sites.sites[label as usize].reach(&sites.rings, p));
        reaches.find(|reach| reach.distance < 0.0)
    }
}

/// What sites are compared by: how far their copper is. An edge of a ring that shows its back is no
/// nearer for that.
pub(super) fn rank(site: &Site, reach: Reach) -> f64 {
    match site.form {
        Form::Chain { .. } => reach.distance.abs(),
        Form::Point(_) | Form::Line(..) | Form::Arc { .. } | Form::Inside { .. } | Form::Outside => {
            reach.distance
        }
    }
}

/// The box round places, so much larger on all sides: left, bottom, right, top.
fn around(spots: &mut dyn Iterator<Item = Spot>, radius: f64) -> [f64; 4] {
    let far = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    let [left, bottom, right, top] = spots.fold(far, |[left, bottom, right, top], p| {
        [left.min(p.x), bottom.min(p.y), right.max(p.x), top.max(p.y)]
    });
    [left - radius, bottom - radius, right + radius, top + radius]
}

/// The box round a site's edge: left, bottom, right, top; none for what has no edge of its own.
fn bounds(site: &Site, rings: &Rings, label: u32) -> Option<[f64; 4]> {
    match &site.form {
        Form::Point(p) if label > 1 => Some(around(&mut [*p].into_iter(), site.radius)),
        Form::Line(a, b) => Some(around(&mut [*a, *b].into_iter(), site.radius)),
        Form::Arc { center, radius, .. } => Some(around(&mut [*center].into_iter(), radius + site.radius)),
        Form::Chain { ring, first, count } => {
            let vertices = rings.ring(*ring);
            let mut run = vertices.iter().cycle().skip(*first as usize).take(*count as usize + 1).copied();
            Some(around(&mut run, 0.0))
        }
        Form::Point(_) | Form::Inside { .. } | Form::Outside => None,
    }
}
