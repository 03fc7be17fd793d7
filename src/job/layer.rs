//! One side of a board: copper → nets → boundaries → what the machine does.

use std::borrow::Cow;

use crate::board::diagnostic::planning;
use crate::board::{Board, Copper, Outline, Side, Warning};
use crate::geometry::{Nm, Path};
use crate::report::coupling::CouplingEntry;
use crate::report::stages::Stages;
use crate::toolpath::strategy::{Isolation, Narrow, Role, fits, isolate, share};
use crate::toolpath::{Order, Placement, Section};
use crate::topology::{self, Extent, Gap, Method, NetId, Nets, Translucency};
use crate::voronoi::{self, Boundaries, Boundary, Diagram, Frame, Loops, Owner, Regions, Share, SiteKind};

use super::choice::{self, Sites};
use super::plain::method;
use super::plan::{Chosen, Plan};
use super::{Cutting, Error, Settings, auto, by_net, coupling};

/// What became of one side.
pub struct Layer {
    /// Which.
    pub side: Side,
    /// Its islands of copper.
    pub nets: Nets,
    /// How they were found by colours, where that was asked for.
    pub translucency: Option<Translucency>,
    /// The narrowest place between two of them.
    pub gap: Option<Gap>,
    /// Their regions, for pictures.
    pub regions: Regions,
    /// The lines between these.
    pub boundaries: Boundaries,
    /// The strongest neighbours, where they are asked for and parted by regions alone.
    pub coupling: Option<CouplingEntry>,
    /// The frame cut round the frame, where one is cut.
    pub frame_cut: Option<Path>,
    /// How the side lies on the machine: the back mirrored.
    pub placement: Placement,
    /// Which nets have loops, where that was left open.
    pub chosen: Option<Chosen>,
    /// What a person must know.
    pub warnings: Vec<Warning>,
    /// Where the time went.
    pub stages: Stages,
}

impl Layer {
    /// Isolates the nets of `copper`, a side of `board` that lies on the machine as `placement`
    /// says. With it comes what the machine does, a section for each tool that has something to
    /// cut.
    ///
    /// # Errors
    ///
    /// [`Error::Voronoi`] where nothing of it lies on the board, or its picture would be too large.
    pub fn isolate(
        copper: &Copper,
        board: &Board,
        placement: Placement,
        settings: &Settings,
    ) -> Result<(Self, Vec<Section>), Error> {
        let side = copper.side;
        let mut stages = Stages::default();
        let (nets, translucency) = stages.run(
            format!("{side}: nets"),
            || recover(copper, method(settings.asked.topology)),
            |(nets, _)| [("features", copper.features.len()), ("nets", nets.nets().len())],
        );
        let gap =
            stages.run(format!("{side}: smallest gap"), || topology::smallest_gap(copper, &nets), |_| []);
        let strategies =
            by_net::strategies(copper, &nets, &settings.asked.strategy_for, settings.asked.strategy);
        let is_open = strategies.contains(&choice::Strategy::Auto);
        // Before there is a diagram, since it takes as much memory.
        let extents =
            if is_open || settings.couples() { topology::extents(copper, &nets) } else { Vec::new() };
        let plan = |looped: Vec<NetId>| {
            let extents = settings.couples().then_some(&extents[..]);
            let planned = Planned { copper, nets: &nets, extents, placement: &placement, settings };
            planned.plan(board, looped)
        };
        let (plan, chosen) = if is_open {
            let (plan, chosen) = auto::fastest(&strategies, &extents, settings, plan)?;
            (plan, Some(chosen))
        } else {
            (plan(by_net::looped(&strategies))?, None)
        };
        stages.extend(&plan.stages);
        let Plan { regions, boundaries, coupling, frame_cut, sections, warnings: found, .. } = plan;
        let mut warnings = topology::names_check(copper, &nets);
        warnings.extend(found);
        let layer = Self {
            side,
            nets,
            translucency,
            gap,
            regions,
            boundaries,
            coupling,
            frame_cut,
            placement,
            chosen,
            warnings,
            stages,
        };
        Ok((layer, sections))
    }

    /// The length of the boundaries that isolate something.
    #[must_use]
    pub fn boundary_length(&self) -> Nm {
        let inner = self.boundaries.edges.iter().filter(|edge| !edge.is_border());
        Nm::from_f64(inner.map(|edge| edge.path.length()).sum())
    }
}

/// What the plans of a side have in common.
struct Planned<'a> {
    copper: &'a Copper,
    nets: &'a Nets,
    /// The extents of the nets, where their coupling is asked for.
    extents: Option<&'a [Extent]>,
    placement: &'a Placement,
    settings: &'a Settings,
}

impl Planned<'_> {
    fn plan(&self, board: &Board, looped: Vec<NetId>) -> Result<Plan, Error> {
        let Self { copper, nets, extents, placement, settings } = *self;
        let side = copper.side;
        let error = |reason| Error::Voronoi { side, reason };
        let mut stages = Stages::default();
        let diagram = stages
            .run(
                format!("{side}: Voronoi diagram"),
                || diagram(copper, nets, board.outline.as_ref(), looped, settings),
                |_| [],
            )
            .map_err(error)?;
        let boundaries = stages
            .run(
                format!("{side}: boundaries"),
                || diagram.boundaries(),
                |found| {
                    let count = |of: fn(&Boundaries) -> usize| found.as_ref().map_or(0, of);
                    [("edges", count(|all| all.edges.len())), ("nodes", count(|all| all.nodes.len()))]
                },
            )
            .map_err(error)?;
        let frame = needed_frame(&diagram, &boundaries);
        let frame_cut = frame.clone().filter(|_| settings.asked.frame);
        let (shares, passes) = stages.run(
            format!("{side}: passes"),
            || shares((copper, nets), &diagram, &boundaries, settings),
            |(shares, _)| [("edges", shares.iter().map(|share| share.cuts.edges.len()).sum())],
        );
        let coupling = extents.map(|extents| {
            let couple = || coupling::strongest(nets, extents, (&diagram, &boundaries), settings);
            stages.run(format!("{side}: coupling"), couple, |found| [("pairs", found.pair_count)])
        });
        let (mut warnings, regions) = (diagram.warnings().to_vec(), diagram.regions());
        // Moves take as much memory.
        drop(diagram);
        let (sections, narrow) = stages.run(
            format!("{side}: moves"),
            || cut(side, nets, &shares, frame_cut.as_ref(), placement, settings),
            |(sections, _)| [("moves", sections.iter().map(|section| section.moves.len()).sum())],
        );
        warnings.extend(passes.into_iter().chain(narrow).map(|warning| warning.on(side)));
        if frame.is_some() && frame_cut.is_none() {
            warnings.push(planning::FRAME_NOT_CUT.warning(FRAME_NOT_CUT).on(side));
        }
        Ok(Plan { regions, boundaries, coupling, frame_cut, sections, warnings, stages })
    }
}

/// The frame cut without which nets that reach the frame stay joined; none where there is no frame,
/// or none reaches it.
fn needed_frame(diagram: &Diagram, boundaries: &Boundaries) -> Option<Path> {
    let reached = boundaries.edges.iter().any(|edge| edge.is_border() && !edge.is_bare());
    diagram.frame().filter(|_| reached).cloned()
}

const FRAME_NOT_CUT: &str = "without an outline and without the frame cut, nets that reach the edge stay joined through the copper outside";

/// The nets of a side, and what Algorithm 2 saw of them if it was asked.
fn recover(copper: &Copper, method: Method) -> (Nets, Option<Translucency>) {
    if method != Method::Translucency {
        return (topology::recover(copper, method), None);
    }
    let found = topology::by_translucency(copper);
    (found.nets.clone(), Some(found))
}

/// The diagram in which some nets have a loop.
fn diagram(
    copper: &Copper,
    nets: &Nets,
    outline: Option<&Outline>,
    looped: Vec<NetId>,
    settings: &Settings,
) -> Result<Diagram, voronoi::Error> {
    let plain = diagram_settings(settings);
    // Half the kerf, and what fitting may take of it: a loop never touches the copper it goes
    // round.
    let radius = settings.kerf() / 2 + settings.tolerance;
    if looped.is_empty() {
        Diagram::new(copper, nets, outline, &plain)
    } else if looped.len() == nets.nets().len() {
        Diagram::new(copper, nets, outline, &voronoi::Settings { limit: Some(radius), ..plain })
    } else {
        Diagram::mixed(copper, nets, outline, &plain, &Loops { nets: looped, radius })
    }
}

fn diagram_settings(settings: &Settings) -> voronoi::Settings {
    voronoi::Settings {
        pitch: settings.pixel.unwrap_or(voronoi::Settings::default().pitch),
        sites: match settings.sites {
            Sites::Copper => SiteKind::Copper,
            Sites::Core => SiteKind::Core,
        },
        passes: passes(settings),
        limit: settings.limit,
        // Nothing is to be isolated there: it is cleared with everything alone.
        enclosed: settings.isolation.iter().any(Cutting::clears_everything),
        // A cut along the edge of a region then leaves the copper alone, where there is room.
        min_width: settings.asked.min_width.then(|| settings.finest_kerf() / 2 + settings.tolerance),
        tolerance: settings.tolerance,
        rises: rises(settings),
        // The end of a cut is round: with half a kerf beyond the outline its whole width reaches
        // the edge, and a fine cutter leaves no scratches outside.
        overlap: voronoi::Settings::default().overlap.min(settings.finest_kerf() / 2),
        frame: Frame::Hull(settings.frame_margin),
        ..voronoi::Settings::default()
    }
}

/// Between which distances from copper all passes run, if that is known before.
fn passes(settings: &Settings) -> Option<[Nm; 2]> {
    let tools = &settings.isolation;
    let is_known = !settings.clearing.is_wanted() && !tools.iter().any(Cutting::clears_everything);
    let wide = tools.iter().filter(|_| is_known).filter_map(|cutting| cutting.widening);
    let ranges = wide.map(|widening| widening.distances(settings.tolerance));
    ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

/// The clearances between which some tool rises.
fn rises(settings: &Settings) -> Option<[Nm; 2]> {
    let least = settings.adaptive_depth?;
    let ends = settings.isolation.iter().map(|Cutting { tool, heights, .. }| {
        [tool.least_width(heights.cut, Some(least)) / 2, tool.width_at(heights.cut) / 2]
    });
    ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

/// What each tool cuts, with its kerf, the widest first: its share of the boundaries, and the
/// passes beside them. With what is to be said of passes.
fn shares<'a>(
    copper: (&Copper, &Nets),
    diagram: &Diagram,
    boundaries: &'a Boundaries,
    settings: &Settings,
) -> (Vec<Share<'a>>, Vec<Warning>) {
    let kerfs: Vec<Nm> = settings.isolation.iter().map(Cutting::kerf).collect();
    let mut cut: Vec<Share<'_>> = Vec::with_capacity(kerfs.len());
    let clearing = settings.clearing.on(copper.0, copper.1, settings.finest_kerf());
    let mut warnings = Vec::new();
    let parts = if kerfs.len() == 1 {
        vec![Cow::Borrowed(boundaries)]
    } else {
        share(boundaries, &kerfs).into_iter().map(Cow::Owned).collect()
    };
    for (cutting, base) in settings.isolation.iter().zip(parts) {
        let all = match &cutting.widening {
            Some(widening) => {
                let kerf = cutting.tool.least_width(cutting.heights.cut, settings.adaptive_depth);
                let base = base.into_owned();
                let (base, uncut) = if widening.skips { fitting(base, kerf) } else { (base, Vec::new()) };
                let (mut all, found) = diagram.widened(copper, base, widening, &clearing, &cut);
                all.edges.extend(uncut);
                warnings.extend(found);
                Cow::Owned(all)
            }
            None => base,
        };
        let kerf = cutting.kerf();
        let floor = cutting.widening.map_or(kerf, |widening| widening.floor);
        cut.push(Share { kerf, floor, cuts: all });
    }
    (cut, warnings)
}

/// Those boundaries that a kerf fits, and the others, which clear nothing where they stay uncut.
fn fitting(mut boundaries: Boundaries, kerf: Nm) -> (Boundaries, Vec<Boundary>) {
    let does_fit = |edge: &Boundary| edge.clearance.iter().all(|&clearance| fits(kerf, clearance));
    let (cut, uncut) = boundaries.edges.into_iter().partition(does_fit);
    boundaries.edges = cut;
    (boundaries, uncut)
}

/// The moves of each tool along the boundaries that isolate something, and round the frame where
/// one must be.
fn cut(
    side: Side,
    nets: &Nets,
    shares: &[Share<'_>],
    frame: Option<&Path>,
    placement: &Placement,
    settings: &Settings,
) -> (Vec<Section>, Vec<Warning>) {
    // What lies along the outline is cut with the board; along a frame it is part of the graph, and
    // joins what ends there.
    let role = |boundary: &Boundary| {
        if boundary.is_border() && (boundary.is_bare() || frame.is_none()) { Role::Leave } else { Role::Cut }
    };
    let name = |owner: Owner| match owner {
        Owner::Net(net) => nets.label(net),
        Owner::Background => "bare board".to_owned(),
        Owner::Outside => "the edge".to_owned(),
    };
    let (mut sections, mut warnings) = (Vec::new(), Vec::new());
    for (cutting, Share { cuts: boundaries, .. }) in settings.isolation.iter().zip(shares) {
        let isolation = Isolation {
            tool: &cutting.tool,
            heights: cutting.heights,
            placement,
            order: Order::default(),
            machine: &settings.machine,
            narrow: match settings.asked.narrow {
                // What fails for it fails where all sides are known.
                choice::Narrow::Centre | choice::Narrow::Error => Narrow::Centre,
                choice::Narrow::Skip => Narrow::Skip,
            },
            adaptive: settings.adaptive_depth,
            direction: settings.asked.direction,
        };
        let (section, found) = isolate(format!("isolate {side}"), boundaries, &[], role, name, &isolation);
        // Of several tools one may find nothing to do; a side where nothing is to be cut still has
        // its program.
        if !section.moves.is_empty() || settings.isolation.len() == 1 {
            sections.push(section);
        }
        warnings.extend(found);
    }
    (sections, warnings)
}
