//! What is inked on a page: shapes, net by net.

use std::collections::BTreeMap;
use std::fmt;

use crate::board::diagnostic::planning;
use crate::board::{
    Axis, Board, Copper, Diagnostic, FLATTEN, Feature, Outline, Shape, Side, Warning, polarity,
};
use crate::geometry::{Nm, Path, Point, Polygon, Rect, Segment, distance_to_segment};
use crate::topology::{NetId, Nets};
use crate::voronoi::{Boundaries, Boundary};

/// What a mask shows of a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// The copper as it was drawn.
    Copper,
    /// All that is not within half a gap of a boundary between two nets.
    Regions,
    /// The openings of the solder mask: pads, a little larger.
    Openings,
}

impl fmt::Display for What {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Copper => "copper",
            Self::Regions => "regions",
            Self::Openings => "solder-mask openings",
        })
    }
}

/// The ink of one net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InkedNet {
    /// What people call it.
    pub label: String,
    /// Its name, where the files give one.
    pub name: Option<String>,
    /// Its shapes; they may overlap.
    pub shapes: Vec<Shape>,
}

/// A page with ink on it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// What the board is called.
    pub name: String,
    /// The side that it shows.
    pub side: Side,
    /// What it shows of it.
    pub what: What,
    /// Whether the ink is what that leaves bare.
    pub negative: bool,
    /// The page, in the board's coordinates.
    pub area: Rect,
    /// The ink.
    pub nets: Vec<InkedNet>,
}

/// A side whose nets have boundaries.
#[derive(Clone, Copy)]
pub struct Parted<'a> {
    /// The board.
    pub board: &'a Board,
    /// The copper of the side.
    pub copper: &'a Copper,
    /// Its nets.
    pub nets: &'a Nets,
    /// What parts them.
    pub boundaries: &'a Boundaries,
}

impl Sheet {
    /// The copper of a side, on a page of `area`.
    #[must_use]
    pub fn copper(board: &Board, copper: &Copper, nets: &Nets, area: Rect) -> Self {
        let shapes = copper.features.iter().enumerate().map(|(at, feature)| (at, feature.shape.clone()));
        Self::of(board, copper, What::Copper, area, grouped(copper, nets, shapes))
    }

    /// The openings of the solder mask: each pad of `copper`, `clearance` larger on every side.
    #[must_use]
    pub fn openings(board: &Board, copper: &Copper, nets: &Nets, area: Rect, clearance: Nm) -> Self {
        let pads = copper.features.iter().enumerate().filter(|(_, feature)| is_pad(copper, feature));
        let grown =
            pads.flat_map(|(at, pad)| grow(&pad.shape, clearance).into_iter().map(move |shape| (at, shape)));
        Self::of(board, copper, What::Openings, area, grouped(copper, nets, grown))
    }

    /// The regions that the boundaries of a side part the `ground` into, `gap` apart, on a page of
    /// `area`; with what went wrong.
    #[must_use]
    pub fn regions(side: &Parted<'_>, area: Rect, ground: &Polygon, gap: Nm) -> (Self, Vec<Warning>) {
        let Parted { board, copper, nets, boundaries } = *side;
        let between = boundaries.edges.iter().filter(|edge| !edge.is_border());
        let strokes: Vec<Polygon> = between.clone().flat_map(|edge| strokes(&edge.path, gap / 2)).collect();
        let regions = polarity::difference(ground, &strokes);
        let (owners, mut warnings) = owners(&regions, copper, nets);
        warnings.extend(narrow(between, gap, copper.side));
        let mut inked: BTreeMap<Option<NetId>, Vec<Shape>> = BTreeMap::new();
        for (region, owner) in regions.into_iter().zip(owners) {
            inked.entry(owner).or_default().push(Shape::Polygon(region));
        }
        let net = |(owner, shapes): (Option<NetId>, Vec<Shape>)| {
            let names = owner.map(|id| &nets.nets()[id.index()].names).filter(|names| !names.is_empty());
            let label = owner.map_or_else(|| "no net".to_owned(), |id| nets.label(id));
            InkedNet { label, name: names.map(|names| names.join("+")), shapes }
        };
        let all = inked.into_iter().map(net).collect();
        (Self::of(board, copper, What::Regions, area.union(ground.bounds()), all), warnings)
    }

    fn of(board: &Board, copper: &Copper, what: What, area: Rect, nets: Vec<InkedNet>) -> Self {
        Self { name: board.name.clone(), side: copper.side, what, negative: false, area, nets }
    }

    /// All shapes, net by net.
    pub fn shapes(&self) -> impl Iterator<Item = &Shape> {
        self.nets.iter().flat_map(|net| &net.shapes)
    }

    /// The page inked where this one is not, its curves within [`FLATTEN`].
    #[must_use]
    pub fn inverted(&self) -> Self {
        let ink: Vec<Polygon> = self.shapes().filter_map(|shape| shape.polygon(FLATTEN)).collect();
        let bare = polarity::difference(&Polygon::rectangle(self.area), &polarity::union(&ink));
        let shapes = bare.into_iter().map(Shape::Polygon).collect();
        let nets = vec![InkedNet { label: "bare".to_owned(), name: None, shapes }];
        Self { negative: !self.negative, nets, ..self.clone() }
    }

    /// The same with `margin` more of page on every side.
    #[must_use]
    pub fn with_margin(self, margin: Nm) -> Self {
        Self { area: self.area.inflate(margin), ..self }
    }

    /// What it is, in a few words: `copper of the front, negative`.
    #[must_use]
    pub fn describe(&self) -> String {
        let negative = if self.negative { ", negative" } else { "" };
        format!("{} of the {}{negative}", self.what, self.side)
    }
}

/// Shapes by the net of the feature that they come from; islands of several names have a group for
/// each.
fn grouped(copper: &Copper, nets: &Nets, shapes: impl Iterator<Item = (usize, Shape)>) -> Vec<InkedNet> {
    let mut groups: BTreeMap<(NetId, Option<&str>), Vec<Shape>> = BTreeMap::new();
    for (at, shape) in shapes {
        let name = copper.attributes_of(&copper.features[at]).net.as_deref();
        groups.entry((nets.of(at), name)).or_default().push(shape);
    }
    let group = |((id, name), shapes): ((NetId, Option<&str>), Vec<Shape>)| InkedNet {
        label: name.map_or_else(|| nets.label(id), str::to_owned),
        name: name.map(str::to_owned),
        shapes,
    };
    groups.into_iter().map(group).collect()
}

/// Whether parts are soldered to a feature: what was flashed, unless the file calls it something
/// else, and what the file calls a pad.
fn is_pad(copper: &Copper, feature: &Feature) -> bool {
    let function = copper.attributes_of(feature).function.as_deref();
    match function.and_then(|function| function.split(',').next()) {
        Some(function) => function.ends_with("Pad") && function != "ViaPad",
        None => matches!(feature.axis, Axis::Flash(_)),
    }
}

/// A shape grown by `by` on every side.
fn grow(shape: &Shape, by: Nm) -> Vec<Shape> {
    match *shape {
        Shape::Disc { center, radius } => vec![Shape::Disc { center, radius: radius + by }],
        Shape::Stroke { from, to, radius } => vec![Shape::Stroke { from, to, radius: radius + by }],
        Shape::Arc { arc, radius } => vec![Shape::Arc { arc, radius: radius + by }],
        Shape::Polygon(ref polygon) => {
            polarity::offset(polygon, by, FLATTEN).into_iter().map(Shape::Polygon).collect()
        }
    }
}

/// All points within `radius` of a path, as polygons that overlap, curves within a micrometre.
fn strokes(path: &Path, radius: Nm) -> Vec<Polygon> {
    let shape = |(from, segment): (Point, &Segment)| match segment.arc(from) {
        Some(arc) => Some(Shape::Arc { arc, radius }),
        None if segment.to() == from => None,
        None => Some(Shape::Stroke { from, to: segment.to(), radius }),
    };
    path.steps().filter_map(shape).filter_map(|shape| shape.polygon(FLATTEN * 4)).collect()
}

/// The net whose copper lies in each region; with a warning where that is none of a net's, or more
/// than one net's.
fn owners(regions: &[Polygon], copper: &Copper, nets: &Nets) -> (Vec<Option<NetId>>, Vec<Warning>) {
    // Small ones first: a plane has thousands of corners to be asked, and most pads within its
    // bounds are not on it.
    let size = |rect: Rect| i128::from(rect.width().get()) * i128::from(rect.height().get());
    let mut order: Vec<(Rect, usize)> = regions.iter().map(Polygon::bounds).zip(0..).collect();
    order.sort_by_key(|&(bounds, at)| (size(bounds), at));
    let find = |p: Point| {
        let near = order.iter().filter(|(bounds, _)| bounds.contains(p)).map(|&(_, at)| at);
        near.into_iter().find(|&at| regions[at].contains(p))
    };
    let anchors = |id: NetId| {
        let features = nets.nets()[id.index()].features.iter();
        features.map(|&feature| copper.features[feature as usize].shape.anchor())
    };
    let warn = |kind: &'static Diagnostic, id: NetId, message: String| {
        kind.warning(message).at(anchors(id).next().unwrap_or_default()).on(copper.side)
    };
    let mut owners: Vec<Option<NetId>> = vec![None; regions.len()];
    let (mut warnings, mut lost) = (Vec::new(), Vec::new());
    for id in (0..).map(NetId).take(nets.nets().len()) {
        match anchors(id).find_map(find) {
            None => lost.push(id),
            Some(at) => match owners[at] {
                None => owners[at] = Some(id),
                Some(other) => {
                    let message = format!(
                        "{} and {} share a region: nothing separates them there",
                        nets.label(other),
                        nets.label(id)
                    );
                    warnings.push(warn(&planning::MASK_REGIONS_JOINED, id, message));
                }
            },
        }
    }
    // A region that necks narrower than the gap cut in two, or where it cut off all anchors.
    for (region, owner) in regions.iter().zip(&mut owners).filter(|(_, owner)| owner.is_none()) {
        *owner = owner_of(region, copper, nets);
    }
    lost.retain(|&id| !owners.contains(&Some(id)));
    warnings.extend(lost.into_iter().map(|id| {
        let message = format!("{} has no region left: --gap removes all of it", nets.label(id));
        warn(&planning::MASK_NET_WITHOUT_REGION, id, message)
    }));
    (owners, warnings)
}

/// The net whose copper is nearest to a corner of `region`: it lies among the places that are
/// nearest to one net, so that any of it tells.
fn owner_of(region: &Polygon, copper: &Copper, nets: &Nets) -> Option<NetId> {
    let corner = region.contours()[0][0];
    let (mut least, mut nearest) = (f64::INFINITY, None);
    for (at, feature) in copper.features.iter().enumerate() {
        let within = |away: f64| feature.shape.bounds().inflate(Nm::from_f64(away)).contains(corner);
        if least.is_finite() && !within(least) {
            continue;
        }
        let Some(polygon) = feature.shape.polygon(FLATTEN) else { continue };
        if polygon.contains(corner) {
            return Some(nets.of(at));
        }
        let edges = polygon.edges().map(|edge| distance_to_segment(corner, edge));
        let away = edges.fold(f64::INFINITY, f64::min);
        if away < least {
            (least, nearest) = (away, Some(nets.of(at)));
        }
    }
    nearest
}

/// What is to be said of boundaries that have less than half a `gap` to copper: the gap takes some.
fn narrow<'a>(boundaries: impl Iterator<Item = &'a Boundary>, gap: Nm, side: Side) -> Option<Warning> {
    /// What fitting may take. Chosen: above the tolerance of the cuts.
    const SLACK: Nm = Nm::from_um(3);
    let tightest = |boundary: &Boundary| {
        let ends = std::iter::once(boundary.path.start).chain(boundary.path.segments.iter().map(Segment::to));
        boundary.clearance.iter().copied().zip(ends).min()
    };
    let tight = boundaries.filter_map(tightest).filter(|(room, _)| *room + SLACK < gap / 2);
    let (count, least) = tight.fold((0_u32, None), |(count, least), found| {
        (count + 1, Some(least.map_or(found, |least: (Nm, Point)| least.min(found))))
    });
    let (room, at) = least?;
    let message = format!(
        "copper is nearer than the gap of {gap:.3} mm at {count} boundaries, {:.3} mm at the narrowest: the gap removes some of it",
        room * 2
    );
    Some(planning::MASK_GAP_TAKES_COPPER.warning(message).at(at).on(side))
}

/// The area that regions part where the board has this `outline`, or else this `frame`.
#[must_use]
pub fn ground(outline: Option<&Outline>, frame: Option<&Path>) -> Option<Polygon> {
    let framed = || {
        let mut corners = frame?.flatten(FLATTEN);
        corners.pop();
        Polygon::new(vec![corners])
    };
    outline.map(|outline| outline.polygon(FLATTEN)).or_else(framed)
}
