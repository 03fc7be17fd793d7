//! Isolation: each boundary is cut once, in as few trails as the graph allows.

use std::borrow::Cow;

use rustc_hash::FxHashMap;

use crate::board::Warning;
use crate::board::diagnostic::planning;
use crate::geometry::{Nm, Path, Point, Segment};
use crate::toolpath::head::Head;
use crate::toolpath::order::{Order, Stretch, arrange};
use crate::toolpath::planner::hop;
use crate::toolpath::trails::{Link, Step, walk};
use crate::toolpath::{Direction, Heights, Machine, Move, Placement, Section, Tool};
use crate::topology::DisjointSets;
use crate::voronoi::{self, Boundaries, Boundary, NodeId, Owner};

use super::share::fits;

/// What is done with a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It is cut.
    Cut,
    /// It need not be cut, but may be where that saves a retract: where the board is cut out
    /// anyway.
    Link,
    /// It is left.
    Leave,
}

/// What is done where a gap is narrower than the kerf.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Narrow {
    /// The cut stays in the middle and takes some copper on both sides.
    #[default]
    Centre,
    /// The whole boundary is left, so its two nets stay joined.
    Skip,
}

/// How isolation is cut.
#[derive(Clone, Copy, Debug)]
pub struct Isolation<'a> {
    /// The tool.
    pub tool: &'a Tool,
    /// How high and how deep.
    pub heights: Heights,
    /// From board to machine.
    pub placement: &'a Placement,
    /// How the trails are ordered.
    pub order: Order,
    /// What a retract costs.
    pub machine: &'a Machine,
    /// What is done where the kerf does not fit.
    pub narrow: Narrow,
    /// The least depth to which a V-bit may rise so that its kerf fits the gap; none keeps the full
    /// depth.
    pub adaptive: Option<Nm>,
    /// Which way round copper a loop goes that has copper on one side alone; none for either.
    pub direction: Option<Direction>,
}

/// Cuts every boundary that `role` says to cut, once, and the closed `frame_cuts` beside.
///
/// `name` says what people call an owner, for the warnings: one `gap-narrower-than-tool` per
/// boundary whose clearance falls below half the kerf, that of the least depth where the tool may
/// rise, at its narrowest place, in board coordinates.
pub fn isolate(
    label: impl Into<String>,
    boundaries: &Boundaries,
    frame_cuts: &[Path],
    role: impl Fn(&Boundary) -> Role,
    name: impl Fn(Owner) -> String,
    settings: &Isolation<'_>,
) -> (Section, Vec<Warning>) {
    // A tool that may rise takes no more copper than at its least depth.
    let kerf = settings.tool.least_width(settings.heights.cut, settings.adaptive);
    let mut contentions: Vec<Contention> = Vec::new();
    let mut ways = Vec::with_capacity(boundaries.edges.len() + boundaries.links.len() + frame_cuts.len());
    for (number, boundary) in boundaries.edges.iter().enumerate() {
        let role = role(boundary);
        if role == Role::Leave {
            continue;
        }
        let contention =
            (role == Role::Cut).then(|| contention(boundary, kerf, &name, settings.narrow)).flatten();
        let narrow = contention.is_some();
        contentions.extend(contention.map(|(room, warning)| Contention { number, room, warning }));
        if !narrow || settings.narrow == Narrow::Centre {
            ways.push(Way::boundary(boundary, role, settings));
        }
    }
    // Who says which way round loops go wants them for themselves.
    if settings.direction.is_none() {
        ways.extend(boundaries.links.iter().map(|link| Way::link(link, settings)));
    }
    ways.extend(frame_cuts.iter().map(Way::frame_cut));
    (
        Section {
            tool: settings.tool.clone(),
            label: label.into(),
            moves: cut(&ways, &boundaries.nodes, settings),
        },
        of_gaps(contentions, &boundaries.edges),
    )
}

/// A boundary that comes nearer to copper than half the kerf.
struct Contention {
    /// Which.
    number: usize,
    /// How far copper is from it.
    room: Nm,
    warning: Warning,
}

/// One warning for each gap, at its narrowest place: passes beside it part its boundary into many.
fn of_gaps(contentions: Vec<Contention>, edges: &[Boundary]) -> Vec<Warning> {
    if contentions.len() < 2 {
        return contentions.into_iter().map(|one| one.warning).collect();
    }
    let mut gaps = DisjointSets::new(edges.len());
    let mut known: FxHashMap<(Owner, Owner, NodeId), usize> = FxHashMap::default();
    for (number, edge) in edges.iter().enumerate() {
        let (a, b) = (edge.left.min(edge.right), edge.left.max(edge.right));
        for node in edge.ends.iter().flat_map(|&(from, to)| [from, to]) {
            let first = *known.entry((a, b, node)).or_insert(number);
            gaps.union(index(first), index(number));
        }
    }
    let mut found: Vec<Contention> = Vec::new();
    let mut of_gap: FxHashMap<u32, usize> = FxHashMap::default();
    for one in contentions {
        let at = *of_gap.entry(gaps.find(index(one.number))).or_insert(found.len());
        match found.get_mut(at) {
            Some(narrowest) if one.room < narrowest.room => *narrowest = one,
            Some(_) => {}
            None => found.push(one),
        }
    }
    found.into_iter().map(|one| one.warning).collect()
}

fn index(number: usize) -> u32 {
    u32::try_from(number).expect("below 2³² edges")
}

/// A boundary, a link or a cut round the frame.
struct Way<'a> {
    /// On the board.
    path: &'a Path,
    clearance: Cow<'a, [Nm]>,
    link: Link,
    /// Whether copper lies on its left, or else on its right; none where it lies on both sides or
    /// on none.
    left: Option<bool>,
}

impl<'a> Way<'a> {
    fn boundary(boundary: &'a Boundary, role: Role, settings: &Isolation<'_>) -> Self {
        Self {
            path: &boundary.path,
            clearance: Cow::Borrowed(&boundary.clearance),
            link: Link {
                ends: boundary.ends.map(|(from, to)| (from.0, to.0)),
                seconds: boundary.path.length() / settings.tool.feed.nm_per_second(),
                must: role == Role::Cut,
            },
            left: match (boundary.left, boundary.right) {
                (Owner::Net(_), Owner::Background | Owner::Outside) => Some(true),
                (Owner::Background | Owner::Outside, Owner::Net(_)) => Some(false),
                (Owner::Net(_) | Owner::Background | Owner::Outside, _) => None,
            },
        }
    }

    fn link(link: &'a voronoi::Link, settings: &Isolation<'_>) -> Self {
        Self {
            path: &link.path,
            clearance: Cow::Owned(vec![link.clearance; link.path.segments.len() + 1]),
            link: Link {
                ends: Some((link.ends.0.0, link.ends.1.0)),
                seconds: link.path.length() / settings.tool.feed.nm_per_second(),
                must: false,
            },
            left: None,
        }
    }

    fn frame_cut(path: &'a Path) -> Self {
        Self {
            path,
            clearance: Cow::Borrowed(&[]),
            link: Link { ends: None, seconds: 0.0, must: true },
            left: None,
        }
    }
}

/// The room of a boundary that comes nearer to copper than half the kerf, and the warning.
fn contention(
    boundary: &Boundary,
    kerf: Nm,
    name: impl Fn(Owner) -> String,
    narrow: Narrow,
) -> Option<(Nm, Warning)> {
    let (index, &clearance) =
        boundary.clearance.iter().enumerate().min_by_key(|(index, nm)| (**nm, *index))?;
    if fits(kerf, clearance) {
        return None;
    }
    let lost = kerf / 2 - clearance;
    let at = vertex(&boundary.path, index);
    let [left, right] = [boundary.left, boundary.right].map(&name);
    let done = match narrow {
        Narrow::Centre => format!("it removes up to {:.1} µm of copper on each side", micrometres(lost)),
        Narrow::Skip => "it is not cut, and the two stay joined".to_owned(),
    };
    // The room is the gap where the cut is midway between copper. Along core axes it is not.
    let message = format!(
        "the cut between {left} and {right} has {:.1} µm of room, less than its kerf of {:.1} µm",
        micrometres(clearance * 2),
        micrometres(kerf),
    );
    let size = (narrow == Narrow::Centre).then_some(lost);
    let warning = planning::GAP_NARROWER_THAN_TOOL.warning(message).so(done).about([left, right]).at(at);
    Some((clearance, Warning { size, ..warning }))
}

/// For display.
fn micrometres(length: Nm) -> f64 {
    length.to_f64() / 1000.0
}

/// The vertex of `path` with this index: the start, then the ends of the segments.
fn vertex(path: &Path, index: usize) -> Point {
    index.checked_sub(1).and_then(|before| path.segments.get(before)).map_or(path.start, Segment::to)
}

/// How many moves a trail has beside its segments: up, over, down to the approach height, the
/// plunge.
const AROUND: usize = 4;

/// The moves that cut all ways that must be cut.
fn cut(ways: &[Way<'_>], nodes: &[Point], settings: &Isolation<'_>) -> Vec<Move> {
    let links: Vec<Link> = ways.iter().map(|way| way.link).collect();
    let trails = walk(nodes.len(), &links, retract_worth(settings.heights, settings.tool, settings.machine));
    let trails = trails.iter().flat_map(|trail| one_sided(ways, trail, settings.direction));
    let lines = trails.filter_map(|trail| Line::along(ways, trail, settings.placement));
    let mut lines: Vec<Option<Line>> = lines.map(Some).collect();
    let stretches: Vec<Stretch> = lines.iter().flatten().map(Line::stretch).collect();
    let mut head = Head::new(settings.heights, settings.tool.plunge);
    head.reserve(lines.iter().flatten().map(|line| line.path.segments.len() + AROUND).sum());
    let mut before = None;
    let length = lines.iter().flatten().map(|line| line.path.length()).sum();
    for leg in arrange(&stretches, Point::default(), settings.order, length) {
        // Each is cut once, and let go then.
        let Some(mut line) = lines[leg.stretch].take() else { continue };
        line.begin_at(leg.entry.unwrap_or(0));
        if line.reverses(settings).unwrap_or(leg.reversed) {
            line.reverse();
        }
        if !before.is_some_and(|before| hops(before, &line, settings)) {
            head.over(line.path.start);
        }
        cut_line(&mut head, &mut line, settings);
        before = line.clearance.last().copied().flatten().map(|clearance| (line.path.end(), clearance));
    }
    head.finish()
}

/// The parts of a trail along which copper lies on one side, where a direction is asked for: each
/// can be cut in it.
///
/// Nets so near to each other that they share a cut have one trail:
///
/// ```text
///   ╭── × ──╮    up on the left, down between them, up on the right:
///   ↑   ↓   ↑    the one lies on its right, the other on its left
///   ╰── × ──╯
/// ```
fn one_sided<'a>(ways: &[Way<'_>], trail: &'a [Step], direction: Option<Direction>) -> Vec<&'a [Step]> {
    if direction.is_none() {
        return vec![trail];
    }
    let side = |step: &Step| ways[step.link].left.map(|left| left != step.backwards);
    let (mut parts, mut from, mut known) = (Vec::new(), 0, None);
    for (at, step) in trail.iter().enumerate() {
        let here = side(step);
        if known.is_some() && here.is_some() && known != here {
            parts.push(&trail[from..at]);
            from = at;
        }
        known = here.or(known);
    }
    parts.push(&trail[from..]);
    // A link leads from one to the next alone.
    let must = |step: &Step| ways[step.link].link.must;
    let needed = |part: &'a [Step]| Some(&part[part.iter().position(must)?..=part.iter().rposition(must)?]);
    parts.into_iter().filter_map(needed).collect()
}

/// Whether the tool may stay down from the end of a trail, with its clearance, to the beginning of
/// the next: where that is no farther than its kerf, so that nothing is cut but what its two
/// grooves nearly meet in, and no copper is within its reach on the way.
fn hops(before: (Point, Nm), next: &Line, settings: &Isolation<'_>) -> bool {
    let kerf = settings.tool.width_at(settings.heights.cut);
    let Some(clearance) = next.clearance[0] else { return false };
    let hop = Nm::from_f64(before.0.distance(next.path.start));
    // Any point of the way is at most the rest of it nearer to copper than the one end, and than
    // the other.
    let nearest = (before.1 + clearance - hop) / 2;
    settings.heights.step.is_none() && hop <= kerf && nearest >= kerf / 2
}

/// One trail in all its passes: there at the first depth, and where it is open back at the next,
/// without a retract.
fn cut_line(head: &mut Head, line: &mut Line, settings: &Isolation<'_>) {
    for (pass, depth) in settings.heights.passes().enumerate() {
        if pass > 0 && !line.path.is_closed() {
            line.reverse();
        }
        let depths = line.depths(depth, settings);
        head.reach(line.path.start, depths[0], settings.tool.feed);
        for (segment, &depth) in line.path.segments.iter().zip(&depths[1..]) {
            head.cut(segment, depth, settings.tool.feed);
        }
    }
}

/// A trail as one path on the machine, with the clearance at each vertex; none along a frame cut.
struct Line {
    path: Path,
    clearance: Vec<Option<Nm>>,
    /// As of its ways, of which all that know have the same where a direction is asked for.
    left: Option<bool>,
}

impl Line {
    /// Whether it must be turned round for the direction that is asked for; none where either will
    /// do.
    fn reverses(&self, settings: &Isolation<'_>) -> Option<bool> {
        Some(settings.direction?.reverses(self.left?, settings.placement.mirror.is_some()))
    }

    fn along(ways: &[Way<'_>], steps: &[Step], placement: &Placement) -> Option<Self> {
        let mut line: Option<Self> = None;
        for step in steps {
            let way = &ways[step.link];
            let mut clearance: Vec<Option<Nm>> = way.clearance.iter().copied().map(Some).collect();
            clearance.resize(way.path.segments.len() + 1, None);
            let mut next = Self { path: placement.path(way.path), clearance, left: way.left };
            if step.backwards {
                next.reverse();
            }
            match &mut line {
                None => line = Some(next),
                Some(line) => {
                    line.path.segments.append(&mut next.path.segments);
                    line.clearance.extend(next.clearance.drain(1..));
                    line.left = line.left.or(next.left);
                }
            }
        }
        line
    }

    /// Where it may begin and end: anywhere if it is closed.
    fn stretch(&self) -> Stretch {
        let entries = if self.path.is_closed() {
            self.path.steps().map(|(from, _)| from).collect()
        } else {
            Vec::new()
        };
        Stretch { from: self.path.start, to: self.path.end(), entries }
    }

    /// Turned so that it begins with the segment of this index; only a closed one is asked.
    fn begin_at(&mut self, entry: usize) {
        if entry > 0 {
            self.path.start = self.path.segments[entry - 1].to();
            self.path.segments.rotate_left(entry);
            self.clearance.pop();
            self.clearance.rotate_left(entry);
            self.clearance.push(self.clearance[0]);
        }
    }

    fn reverse(&mut self) {
        self.clearance.reverse();
        self.left = self.left.map(|left| !left);
        self.path = self.path.reversed();
    }

    /// How deep the tool goes at each vertex, at most `depth`: less where it rises to fit the gap.
    fn depths(&self, depth: Nm, settings: &Isolation<'_>) -> Vec<Nm> {
        let fits = |clearance: Option<Nm>| match (settings.adaptive, clearance) {
            (Some(least), Some(clearance)) => {
                let fitting = settings.tool.depth_for(clearance * 2).unwrap_or(Nm::ZERO);
                fitting.max(least).min(depth)
            }
            _ => depth,
        };
        self.clearance.iter().copied().map(fits).collect()
    }
}

/// How much of a retract's time a second cut may take that saves it. Measured: from 0.6 to 1 boards
/// take the same time within half a percent; with less, less is cut twice and the tool lasts
/// longer, and with 0.7 none of the nine boards in docs/millproject.md is cut longer than by
/// pcb2gcode.
const WORTH: f64 = 0.7;

/// The way over which the next trail is expected, for what a retract costs. Chosen: the middle of
/// what boards show.
const EXPECTED_HOP: Nm = Nm::from_mm(5);

/// What may be cut instead of a retract, in seconds.
pub(super) fn retract_worth(heights: Heights, tool: &Tool, machine: &Machine) -> f64 {
    WORTH * retract_seconds(heights, tool, machine)
}

/// What a retract costs: up, over, down to the approach height, the plunge, and each time from a
/// standstill to a standstill.
fn retract_seconds(heights: Heights, tool: &Tool, machine: &Machine) -> f64 {
    let Heights { safe, approach, cut, .. } = heights;
    let (level, vertical) = (machine.level_acceleration(), machine.acceleration[2]);
    let stop = tool.feed.nm_per_second() / level.nm_per_s2();
    let rapid_z = machine.rapid[2].nm_per_second();
    hop(safe + cut, rapid_z, vertical)
        + hop(EXPECTED_HOP, machine.level_rapid().nm_per_second(), level)
        + hop(safe - approach, rapid_z, vertical)
        + hop(approach + cut, tool.plunge.nm_per_second(), vertical)
        + stop
}
