use crate::gcode::Dialect;
use crate::geometry::Nm;
use crate::toolpath::{self, Angle, Heights, Machine, Tool, ToolKind};
use crate::voronoi::Widening;

use super::Error;
use super::options::{Narrow, Options, Origin, Sites, Strategy, Topology};
use super::quantity::{Drills, Length};

/// Everything a job needs to know, complete and checked.
///
/// # Guarantees
///
/// Lengths that must be are above zero; tools suit what they are for; the cutout's tabs are thinner than its depth.
#[derive(Clone, Debug)]
pub struct Settings {
    options: Options,
    /// The tool that isolates, with its speeds.
    pub isolation_tool: Tool,
    /// How high and deep it goes.
    pub isolation: Heights,
    /// Voronoi or outline.
    pub strategy: Strategy,
    /// What cuts are midway between.
    pub sites: Sites,
    /// How far from copper a net's region may reach.
    pub limit: Option<Nm>,
    /// How far the gap beside every net is cleared; none for a single cut.
    pub widening: Option<Widening>,
    /// The pixel of the picture that finds the boundaries.
    pub pixel: Nm,
    /// Whether a lap is cut round copper without an outline.
    pub frame: bool,
    /// Whether with core axes every region holds at least its net's copper.
    pub min_width: bool,
    /// How touching copper is found.
    pub topology: Topology,
    /// How far a fitted cut may leave its place.
    pub tolerance: Nm,
    /// What the machine speaks.
    pub dialect: &'static Dialect,
    /// Where x and y are zero.
    pub origin: toolpath::Origin,
    /// Where the cut does not fit.
    pub narrow: Narrow,
    /// The least depth to which a V-bit may rise.
    pub adaptive_depth: Option<Nm>,
    /// How the board is turned on the machine.
    pub rotate: Angle,
    /// The line about which it is turned over; none for its middle.
    pub mirror_axis: Option<Nm>,
    /// The drills at hand; none for one of each diameter.
    pub drills: Vec<Tool>,
    /// How far a drill may differ from its hole.
    pub drill_tolerance: Nm,
    /// Whether slots, and holes without a drill, are bored with the cutout's end mill.
    pub drill_bore: bool,
    /// What the machine can do.
    pub machine: Machine,
    /// How high and deep drills go.
    pub drilling: Heights,
    /// How far apart two lines of the outline may end and still meet.
    pub outline_gap: Nm,
    /// The end mill that cuts the board out.
    pub cutout_tool: Tool,
    /// How high and deep it goes.
    pub cutout: Heights,
    /// How many tabs hold each contour.
    pub tabs: u32,
    /// How wide each is.
    pub tab_width: Nm,
    /// How thick each is.
    pub tab_height: Nm,
}

/// The height above the copper from which the tool goes down at the plunge feed. Chosen: clear of any burr, and not
/// long enough to cost time.
const APPROACH: Nm = Nm::from_um(200);

/// The finest pixel.
const FINEST: Nm = Nm::from_um(1);

impl Settings {
    /// What `options` say, and the defaults where they leave something open.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for the first setting whose value makes no sense.
    pub fn resolve(options: Options) -> Result<Self, Error> {
        let options = options.or(Options::defaults());
        let open = "the defaults leave nothing open";
        let feed = options.feed.expect(open);
        let plunge = options.plunge.expect(open);
        let spindle = options.spindle.expect(open);
        let tool = |kind: ToolKind| Tool { feed, plunge, spindle, ..Tool::new(kind) };
        let isolation_tool = tool(not_a_drill("tool", options.tool.expect(open))?);
        let cutout_tool = tool(end_mill("cutout-tool", options.cutout_tool.expect(open))?);
        let safe = positive("safe-z", options.safe_z)?;
        let heights = |cut: Nm, step: Option<Nm>| Heights { safe, approach: APPROACH.min(safe), cut, step };
        let cutout_depth = positive("cutout-depth", options.cutout_depth)?;
        let tab_height = positive("tab-height", options.tab_height)?;
        let tabs = options.tabs.expect(open);
        if tabs > 0 && tab_height >= cutout_depth {
            let problem = format!(
                "tabs of {} in a cut of {} would leave it uncut",
                Length(tab_height),
                Length(cutout_depth)
            );
            return Err(Error::Value { key: "tab-height", problem });
        }
        let isolation = heights(positive("depth", options.depth)?, None);
        let kerf = isolation_tool.width_at(isolation.cut);
        Ok(Self {
            isolation,
            widening: widening(&options, kerf)?,
            drilling: heights(
                positive("drill-depth", options.drill_depth)?,
                given("drill-peck", options.drill_peck)?,
            ),
            narrow: options.narrow.expect(open),
            adaptive_depth: given("adaptive-depth", options.adaptive_depth)?,
            rotate: options.rotate.expect(open),
            mirror_axis: options.mirror_axis.map(Length::nm),
            drills: drills(options.drills.as_ref())?,
            drill_tolerance: options.drill_tolerance.expect(open).nm(),
            drill_bore: options.drill_bore.expect(open),
            outline_gap: outline_gap(&options)?,
            cutout: heights(cutout_depth, Some(positive("cutout-pass", options.cutout_pass)?)),
            isolation_tool,
            cutout_tool,
            strategy: options.strategy.expect(open),
            sites: options.sites.expect(open),
            limit: given("limit", options.limit)?,
            pixel: pixel(&options)?,
            frame: options.frame.expect(open),
            min_width: options.min_width.expect(open),
            topology: options.topology.expect(open),
            tolerance: positive("tolerance", options.tolerance)?,
            dialect: options.dialect.expect(open).0,
            origin: match options.origin.expect(open) {
                Origin::LowerLeft => toolpath::Origin::LowerLeft,
                Origin::Keep => toolpath::Origin::Keep,
                Origin::Center => toolpath::Origin::Center,
            },
            machine: Machine::default(),
            tabs,
            tab_width: positive("tab-width", options.tab_width)?,
            tab_height,
            options,
        })
    }

    /// The options they came from, complete: what the report repeats.
    #[must_use]
    pub const fn options(&self) -> &Options {
        &self.options
    }

    /// The width of an isolation cut at the surface.
    #[must_use]
    pub fn kerf(&self) -> Nm {
        self.isolation_tool.width_at(self.isolation.cut)
    }
}

/// A length that may be left open.
fn given(key: &'static str, length: Option<Length>) -> Result<Option<Nm>, Error> {
    length.map(|length| positive(key, Some(length))).transpose()
}

/// The drills at hand, numbered from 1 in the order given.
fn drills(diameters: Option<&Drills>) -> Result<Vec<Tool>, Error> {
    let drill = |(number, &diameter): (u32, &Length)| {
        let diameter = positive("drills", Some(diameter))?;
        Ok(Tool { number, ..Tool::new(ToolKind::Drill { diameter }) })
    };
    diameters.map_or_else(|| Ok(Vec::new()), |Drills(all)| (1..).zip(all).map(drill).collect())
}

fn positive(key: &'static str, length: Option<Length>) -> Result<Nm, Error> {
    let length = length.expect("the defaults leave no length open");
    if length.nm() > Nm::ZERO {
        return Ok(length.nm());
    }
    Err(Error::Value { key, problem: format!("`{length}` makes no sense: it must be more than zero") })
}

/// A gap of nothing leaves the outline as it is drawn.
fn outline_gap(options: &Options) -> Result<Nm, Error> {
    /// Chosen: wider gaps are sides that are missing, not corners.
    const WIDEST: Nm = Nm::from_mm(5);
    let gap = options.outline_gap.expect("the defaults leave no length open");
    if gap.nm() < Nm::ZERO || gap.nm() > WIDEST {
        let problem = format!("`{gap}` makes no sense: it must be from 0mm to {}", Length(WIDEST));
        return Err(Error::Value { key: "outline-gap", problem });
    }
    Ok(gap.nm())
}

/// How wide the gap is to be, from a width or a number of passes.
fn widening(options: &Options, kerf: Nm) -> Result<Option<Widening>, Error> {
    let overlap = match options.overlap {
        None => kerf / 10,
        Some(overlap) if overlap.nm() < Nm::ZERO || overlap.nm() >= kerf => {
            let problem =
                format!("passes that share `{overlap}` of a kerf of {} do not advance", Length(kerf));
            return Err(Error::Value { key: "overlap", problem });
        }
        Some(overlap) => overlap.nm(),
    };
    let width = match (options.width, options.passes) {
        (Some(width), _) => positive("width", Some(width))?,
        (None, Some(passes)) => kerf + (kerf - overlap) * (i64::from(passes) - 1),
        (None, None) => return Ok(None),
    };
    Ok(Some(Widening { kerf, width, overlap }))
}

fn pixel(options: &Options) -> Result<Nm, Error> {
    let inch = Nm::from_um(25_400);
    let (key, pixel) = match options.dpi {
        Some(dpi) => ("dpi", Nm::new((inch.get() + i64::from(dpi) / 2) / i64::from(dpi))),
        None => ("pixel", positive("pixel", options.pixel)?),
    };
    if pixel < FINEST {
        return Err(Error::Value {
            key,
            problem: format!("a pixel of {} is finer than 0.001mm, the finest", Length(pixel)),
        });
    }
    Ok(pixel)
}

fn not_a_drill(key: &'static str, kind: ToolKind) -> Result<ToolKind, Error> {
    match kind {
        ToolKind::VBit { .. } | ToolKind::EndMill { .. } => Ok(kind),
        ToolKind::Drill { .. } => Err(Error::Value {
            key,
            problem: format!("`{kind}` cannot cut sideways: name a vbit or an endmill"),
        }),
    }
}

fn end_mill(key: &'static str, kind: ToolKind) -> Result<ToolKind, Error> {
    match kind {
        ToolKind::EndMill { .. } => Ok(kind),
        ToolKind::VBit { .. } | ToolKind::Drill { .. } => {
            Err(Error::Value { key, problem: format!("`{kind}` cannot cut a board out: name an endmill") })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(text: &str) -> Result<Settings, Error> {
        Options::from_toml("voromill.toml", text).and_then(Settings::resolve)
    }

    #[test]
    fn the_defaults_are_settings() {
        let settings = Settings::resolve(Options::default()).expect("the defaults");
        assert_eq!(settings.kerf(), Nm::new(153_590), "0.1 + 2 · 0.1 · tan 15°");
        assert_eq!(settings.pixel, Nm::from_um(25) + Nm::new(400), "1000 DPI");
    }

    #[test]
    fn dpi_and_pixel_replace_each_other() {
        assert_eq!(settings("dpi = 500").expect("settings").pixel, Nm::new(50_800), "an inch by 500");
        let over = Options::from_toml("f", "pixel = \"20um\"").expect("options");
        let under = Options::from_toml("f", "dpi = 500").expect("options");
        assert_eq!(
            Settings::resolve(over.or(under)).expect("settings").pixel,
            Nm::from_um(20),
            "the later wins"
        );
    }

    #[test]
    fn values_that_make_no_sense_are_refused_by_name() {
        for (text, key) in [
            ("depth = \"0mm\"", "depth"),
            ("tool = \"drill:1mm\"", "tool"),
            ("cutout-tool = \"vbit:0.1mm:30deg\"", "cutout-tool"),
            ("tab-height = \"2mm\"", "tab-height"),
            ("pixel = \"10nm\"", "pixel"),
            ("limit = \"-1mm\"", "limit"),
            ("outline-gap = \"10mm\"", "outline-gap"),
        ] {
            let error = settings(text).expect_err(text).to_string();
            assert!(error.starts_with(key), "{text}: {error}");
        }
    }
}
