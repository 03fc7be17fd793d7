//! Which tools isolate, how deep, and what lies between the copper and the frame cut.

use crate::board::Words;
use crate::geometry::Nm;
use crate::toolpath::{Heights, Tool, ToolKind};
use crate::voronoi::Widening;

use super::Error;
use super::checked::{self, given, positive};
use super::choice::{Narrow, Sites, Strategy};
use super::clearing::Clearing;
use super::options::Complete;
use super::quantity::Length;
use super::tools::{self, Fetched, Workshop};

/// A tool that isolates.
#[derive(Clone, Debug)]
pub struct Cutting {
    /// The tool, with its speeds.
    pub tool: Tool,
    /// How high and deep it goes.
    pub heights: Heights,
    /// How far it clears the gap beside every net, and all where more is cleared; none for a single
    /// cut.
    pub widening: Option<Widening>,
}

impl Cutting {
    /// Whether all copper goes that is none of a net's.
    #[must_use]
    pub fn clears_everything(&self) -> bool {
        self.widening.is_some_and(|widening| widening.width == Some(EVERYTHING))
    }

    /// Its kerf at the surface.
    #[must_use]
    pub fn kerf(&self) -> Nm {
        self.tool.width_at(self.heights.cut)
    }
}

/// The tools that isolate, the widest first.
pub(super) fn isolation(
    options: &Complete,
    workshop: &Workshop<'_>,
    heights: impl Fn(Nm) -> Heights,
) -> Result<Vec<Cutting>, Error> {
    let mut cuttings = Vec::with_capacity(options.tool.len());
    for choice in &options.tool {
        let Fetched { tool, depth } = workshop.fetch("tool", choice)?;
        let tool = not_a_drill("tool", tool)?;
        let heights = heights(depth_of(&tool, depth, options)?);
        let kerf = tool.width_at(heights.cut);
        let floor = tool.width_at((heights.cut - COPPER).max(Nm::ZERO)).max(kerf / 2);
        let widening = widening(options, kerf, floor)?;
        cuttings.push(Cutting { tool, heights, widening });
    }
    cuttings.sort_by_key(|cutting| std::cmp::Reverse(cutting.kerf()));
    if let Some(pair) = cuttings.windows(2).find(|pair| pair[0].kerf() == pair[1].kerf()) {
        let [first, second] = [&pair[0], &pair[1]].map(|cutting| &cutting.tool.name);
        let problem = format!("`{first}` and `{second}` cut equally wide: one of them is enough");
        return Err(Error::Value { key: "tool", problem });
    }
    Ok(cuttings)
}

/// How deep a tool isolates: as its table says, or the kerf or depth of the settings.
fn depth_of(tool: &Tool, own: Option<Nm>, options: &Complete) -> Result<Nm, Error> {
    match (own, options.kerf, tool.kind) {
        (Some(depth), ..) => Ok(depth),
        (None, Some(kerf), ToolKind::VBit { .. }) => {
            tools::depth_for(tool.kind, kerf).map_err(|problem| Error::Value { key: "kerf", problem })
        }
        (None, Some(kerf), ToolKind::EndMill { diameter } | ToolKind::Drill { diameter })
            if options.tool.len() == 1 && kerf.nm() != diameter =>
        {
            let problem = format!("`{}` cuts {} at any depth", tool.kind, Length(diameter));
            Err(Error::Value { key: "kerf", problem })
        }
        // With several tools the kerf is what the V-bits cut.
        (None, ..) => positive("depth", options.depth),
    }
}

/// The least way between copper and the frame cut round it that is taken unasked. Chosen: what
/// boards keep between copper and copper, so that the frame cut is no narrower a place than the
/// rest.
const LEAST_MARGIN: Nm = Nm::from_um(200);
/// The same where copper is cleared, or belongs to nobody, farther out. Chosen.
const ROOM: Nm = Nm::from_mm(1);

/// How far the frame cut round copper without an outline keeps from it: so that the cut itself is
/// clear, and as far as the gap is to be cleared.
pub(super) fn frame_margin(options: &Complete, cuttings: &[Cutting]) -> Result<Nm, Error> {
    let kerf = cuttings.iter().map(Cutting::kerf).max().unwrap_or(Nm::ZERO);
    let Some(margin) = given("frame-margin", options.frame_margin)? else {
        let clearing = Clearing::of(options);
        let cleared = cuttings.iter().filter_map(|cutting| cutting.widening?.width);
        let cleared = cleared.chain(clearing.farthest()).filter(|&width| width < EVERYTHING).max();
        let clears = options.clear == Some(true) || clearing.is_wanted();
        let least = if options.limit.is_some() || clears { ROOM } else { LEAST_MARGIN };
        return Ok(cleared.unwrap_or(kerf).max(kerf).max(least));
    };
    let least = kerf / 2 + options.tolerance.nm();
    if margin < least {
        let problem = format!(
            "a frame cut {} from copper would cut it: with a kerf of {} it needs {}",
            Length(margin),
            Length(kerf),
            Length(least)
        );
        return Err(Error::Value { key: "frame-margin", problem });
    }
    Ok(margin)
}

/// Wider than any gap. Chosen.
const EVERYTHING: Nm = Nm::from_mm(1000);

/// How thick copper is that passes clear. Chosen: one ounce, as `verify` has it unasked.
pub(super) const COPPER: Nm = Nm::from_um(35);
/// So much more passes share there, or a third of what is cut, and at most seven eighths of the
/// kerf. Chosen: no cut is so far off its place; sharper tools would take many more passes.
const SURELY: Nm = Nm::from_um(6);

/// So many passes run beside a net at most. Chosen.
const MOST_PASSES: u32 = 1000;
/// The least width of boards that are cleared, as far as passes are counted. Chosen.
const EXTENT: Nm = Nm::from_mm(5);

/// How wide the gap is to be, where the cutter clears `kerf`, and `floor` at the copper's bottom,
/// from a width or a number of passes.
fn widening(options: &Complete, kerf: Nm, floor: Nm) -> Result<Option<Widening>, Error> {
    // What is left at the bottom of the copper between two passes would be a strip of it.
    let least = (kerf - floor + SURELY.min(floor / 3)).min(kerf * 7 / 8);
    let overlap = match options.overlap {
        None => least.max(kerf / 10),
        Some(overlap) if overlap.of(kerf) < Nm::ZERO || overlap.of(kerf) >= kerf => {
            let problem =
                format!("an overlap of `{overlap}` leaves no stepover with a kerf of {}", Length(kerf));
            return Err(Error::Value { key: "overlap", problem });
        }
        Some(overlap) if floor < kerf => overlap.of(kerf).max(least),
        Some(overlap) => overlap.of(kerf),
    };
    let skips = options.narrow == Narrow::Skip;
    checked::count("passes", options.passes, 1..=MOST_PASSES)?;
    let advance = kerf - overlap;
    // Any board has room for more than these.
    let widest = if options.clear == Some(true) { Some(EXTENT) } else { options.width.map(Length::nm) };
    if let Some(width) = widest.filter(|&width| (width - kerf) / i64::from(MOST_PASSES) > advance) {
        let problem = format!(
            "with passes {} apart a gap of {} would take more than {MOST_PASSES}",
            Length(advance),
            Length(width)
        );
        return Err(Error::Value {
            key: if options.overlap.is_some() { "overlap" } else { "tool" },
            problem,
        });
    }
    let width = match (options.width, options.passes) {
        _ if options.clear == Some(true) => EVERYTHING,
        (Some(width), _) => positive("width", width)?,
        (None, Some(passes)) => kerf + (kerf - overlap) * (i64::from(passes) - 1),
        (None, None) if Clearing::of(options).is_wanted() => {
            return Ok(Some(Widening { kerf, floor, width: None, overlap, skips }));
        }
        (None, None) => return Ok(None),
    };
    Ok(Some(Widening { kerf, floor, width: Some(width), overlap, skips }))
}

/// What cuts are midway between.
pub(super) fn sites(options: &Complete) -> Result<Sites, Error> {
    let sites = options.sites;
    let has_loops = |strategy: Strategy| strategy != Strategy::Voronoi;
    let beside_copper = [
        ("{width}", options.width.is_some()),
        ("{passes}", options.passes.is_some()),
        ("{clear}", options.clear == Some(true)),
        ("{clear-nets}", !options.clear_nets.is_empty()),
        ("{clear-area}", !options.clear_area.is_empty()),
        ("{distance-for}", !options.distance_for.is_empty()),
        ("{strategy} outline", options.strategy == Strategy::Outline),
        ("{strategy} auto", options.strategy == Strategy::Auto),
        ("{strategy-for}", options.strategy_for.iter().any(|some| has_loops(some.strategy))),
    ];
    match (sites, beside_copper.into_iter().find(|(_, is_asked)| *is_asked)) {
        (Sites::Core, Some((other, _))) => {
            let problem = format!(
                "with core, {} would keep its distance from the axes and cut into the copper round them: leave out one of the two",
                Words::of(other)
            );
            Err(Error::Value { key: "sites", problem })
        }
        _ => Ok(sites),
    }
}

fn not_a_drill(key: &'static str, tool: Tool) -> Result<Tool, Error> {
    match tool.kind {
        ToolKind::VBit { .. } | ToolKind::EndMill { .. } => Ok(tool),
        ToolKind::Drill { .. } => Err(Error::Value {
            key,
            problem: format!("`{}` cannot cut sideways: name a vbit or an endmill", tool.name),
        }),
    }
}

/// The finest pixel. Chosen: what [`Grid`](crate::grid::Grid) takes.
const FINEST: Nm = Nm::from_um(1);

/// The pixel that finds boundaries, as it is told.
pub(super) fn pixel(options: &Complete) -> Result<Option<Nm>, Error> {
    let inch = Nm::from_um(25_400);
    checked::count("dpi", options.dpi, 1..=25_400)?;
    let (key, pixel) = match options.dpi {
        Some(dpi) => ("dpi", Some(Nm::new((inch.get() + i64::from(dpi) / 2) / i64::from(dpi)))),
        None => ("pixel", given("pixel", options.pixel)?),
    };
    if let Some(pixel) = pixel.filter(|&pixel| pixel < FINEST) {
        return Err(Error::Value {
            key,
            problem: format!("a pixel of {} is finer than 0.001mm, the finest", Length(pixel)),
        });
    }
    Ok(pixel)
}
