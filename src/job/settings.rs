//! Everything a job needs to know, complete and checked.
//!
//! Options say what a person asked for; settings say what will be done, so that later stages check
//! nothing again.

use crate::board::Side;
use crate::gcode::Dialect;
use crate::geometry::{Nm, Vector};
use crate::toolpath::strategy::Drilling;
use crate::toolpath::{self, Angle, DrillSpeeds, Heights, Machine, Order, Placement, Tool};

use super::Error;
use super::Options;
use super::checked::{self, given, positive};
use super::choice::{DrillSide, Origin, Sites};
use super::clearing::Clearing;
use super::cutting::{Cutting, frame_margin, isolation, pixel, sites};
use super::holding::{Holding, holding};
use super::options::Complete;
use super::output_name;
use super::quantity::{Length, Tiles};
use super::reach::Reach;
use super::{controller, cutting_out, drilling, validate};

/// Everything a job needs to know, complete and checked.
///
/// # Guarantees
///
/// Lengths that must be are above zero; tools suit what they are for; the cutout's tabs are thinner
/// than its depth.
#[derive(Clone, Debug)]
pub struct Settings {
    options: Options,
    /// The same with a value wherever the defaults have one: what needs neither check nor
    /// resolution is taken from here.
    pub(super) asked: Complete,
    /// The tools that isolate, the widest first; each cuts where it is the first that fits.
    pub isolation: Vec<Cutting>,
    /// The height for travel.
    pub safe: Nm,
    /// How often the board is made from one piece of stock, and how far its copies are apart.
    pub tiles: Option<(Tiles, Nm)>,
    /// The diameter of the holes for the pins on which the board is flipped, and their distance
    /// from it.
    pub alignment: Option<(Nm, Nm)>,
    /// What is cleared beside the gaps round nets.
    pub clearing: Clearing,
    /// What cuts are midway between.
    pub sites: Sites,
    /// How far from copper a net's region may reach.
    pub limit: Option<Nm>,
    /// The pixel of pictures; none for one of 1000 to the inch.
    pub pixel: Option<Nm>,
    /// How far the frame cut keeps from copper.
    pub frame_margin: Nm,
    /// How far a fitted cut may leave its place.
    pub tolerance: Nm,
    /// What the machine speaks.
    pub dialect: Dialect,
    /// Where x and y are zero.
    pub origin: toolpath::Origin,
    /// The least depth to which a V-bit may rise.
    pub adaptive_depth: Option<Nm>,
    /// How far it is moved on the machine from its origin.
    pub offset: Vector,
    /// The line about which it is flipped; none for its middle.
    pub mirror_axis: Option<Nm>,
    /// How thick the board is.
    pub thickness: Nm,
    /// The drills at hand; none for one of each diameter.
    pub drills: Vec<Tool>,
    /// How drills are run that have no speeds of their own.
    pub drill_speeds: DrillSpeeds,
    /// The tip of drills that do not say theirs.
    pub drill_tip_angle: Angle,
    /// How long a drill stays at the bottom of a hole, in milliseconds.
    pub drill_dwell: u32,
    /// How far a drill may differ from its hole.
    pub drill_tolerance: Nm,
    /// Whether slots, and holes without a drill, are bored with an end mill.
    pub drill_bore: bool,
    /// The diameter from which on holes are bored whatever drills are at hand.
    pub drill_bore_from: Option<Nm>,
    /// The end mill for it.
    pub drill_bore_tool: Tool,
    /// The side that is up while holes are drilled.
    pub drill_side: Side,
    /// What the machine can do.
    pub machine: Machine,
    /// How high and deep drills go.
    pub drilling: Heights,
    /// Whether each drill goes deeper than that by its tip.
    pub drill_tips: bool,
    /// Whether one drill drills all holes that are drilled.
    pub one_drill: bool,
    /// How deep alignment holes go at their full width.
    pub alignment_depth: Nm,
    /// How much wider plated holes are drilled.
    pub rivet: Option<Nm>,
    /// How far apart two lines of the outline may end and still meet.
    pub outline_gap: Nm,
    /// The end mill that cuts the board out.
    pub cutout_tool: Tool,
    /// The side that is up while it does.
    pub cutout_side: Side,
    /// How high and deep it goes.
    pub cutout: Heights,
    /// How steeply it goes down along the contour; none for straight down.
    pub cutout_ramp: Option<Angle>,
    /// Where tabs hold the board.
    pub tabs: Holding,
    /// How wide each is.
    pub tab_width: Nm,
    /// How far below the surface their tops lie.
    pub tab_top: Nm,
    /// Whether the report says how strongly neighbours are coupled.
    pub couplings: bool,
}

/// The height above the copper from which the tool goes down at the plunge feed. Chosen: clear of
/// any burr, and not long enough to cost time.
const APPROACH: Nm = Nm::from_um(200);

/// How deep alignment pins stand in what lies below the board, unasked. Chosen: as deep as a pin of
/// 3 mm is thick, so that it stands straight.
const PINS: Nm = Nm::from_mm(3);

/// How far below the board its contour is cut, unasked. Chosen: more than sheets are bent and
/// zeroes are off, and little of what lies below.
const BELOW: Nm = Nm::from_um(100);

/// The pixel of pictures: 1000 to the inch. Chosen: the paper's are 500 to the inch.
const PICTURE: Nm = Nm::new(25_400);

impl Settings {
    /// The pixel of pictures that are drawn of the board: that asked for, or one of 1000 to the
    /// inch.
    #[must_use]
    pub fn picture_pixel(&self) -> Nm {
        self.pixel.unwrap_or(PICTURE)
    }

    /// What `options` say, and the defaults where they leave something open.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for the first setting whose value is invalid.
    pub fn resolve(options: Options) -> Result<Self, Error> {
        let settings = Self::of(options)?;
        validate::kerfs(&settings.isolation)?;
        Ok(settings)
    }

    /// The same of those options that change any of `reach`, where no board is milled.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for the first setting whose value is invalid.
    pub fn for_artwork(options: Options, reach: Reach) -> Result<Self, Error> {
        Self::of(options.of_reach(reach))
    }

    fn of(options: Options) -> Result<Self, Error> {
        let profile = options.machine.as_ref().map(|machine| machine.0.clone());
        let written = validate::defaults_for(profile.as_ref(), options).or(Options::defaults());
        let options = written.clone().complete();
        let thickness = positive("thickness", options.thickness)?;
        let workshop = drilling::workshop(&options)?;
        let cutout_tool =
            cutting_out::end_mill("cutout-tool", workshop.fetch("cutout-tool", &options.cutout_tool)?.tool)?;
        let drills = drilling::drills(options.drills.as_ref(), &workshop)?;
        let safe = checked::travel_height("safe-z", options.safe_z)?;
        // Where nobody says where it waits, it waits no lower than it travels.
        let park = written.park.filter(|park| Some(*park) != Options::defaults().park);
        checked::parking_height("park", park, safe)?;
        checked::parking_height("tool-change-at", written.tool_change_at, safe)?;
        let heights = |cut: Nm, step: Option<Nm>| Heights { safe, approach: APPROACH.min(safe), cut, step };
        let below = Length(thickness + BELOW);
        let cutout_depth = positive("cutout-depth", options.cutout_depth.unwrap_or(below))?;
        let tabs = holding(&options)?;
        let tab_height = positive("tab-height", options.tab_height)?;
        let tab_top = cutout_depth.min(thickness) - tab_height;
        let tiles = cutting_out::tiles(&options, &cutout_tool)?;
        let dialect = controller::dialect(&options, options.dialect.0.clone())?;
        output_name::check(&options.output_name)?;
        if tabs != Holding::Count(0) {
            validate::tabs(tab_height, cutout_depth, thickness)?;
        }
        let machine = profile.map_or_else(Machine::default, |profile| profile.machine());
        let isolation = isolation(&options, &workshop, |cut| heights(cut, None))?;
        let through = thickness + positive("break-through", options.break_through)?;
        let drill_depth = given("drill-depth", options.drill_depth)?;
        let drill_safe = match options.drill_safe_z {
            Some(height) => checked::travel_height("drill-safe-z", height)?,
            None => safe,
        };
        let deep = drill_depth.unwrap_or(through);
        let drilling = Heights {
            safe: drill_safe,
            approach: APPROACH.min(drill_safe),
            ..heights(deep, checked::step("drill-peck", options.drill_peck, deep)?)
        };
        let bores = options.drill_bore || options.drill_bore_from.is_some();
        // A tool's own table may say how deep it goes.
        let deep: Vec<Nm> = isolation.iter().map(|cutting| cutting.heights.cut).collect();
        let is_one = options.kerf.is_none() && deep.iter().all(|depth| *depth == deep[0]);
        let depth = deep.first().filter(|_| is_one).copied().map(Length).or(written.depth);
        Ok(Self {
            frame_margin: frame_margin(&options, &isolation)?,
            adaptive_depth: validate::adaptive_depth(&options, &isolation)?,
            limit: validate::limit(&options, &isolation)?,
            tolerance: validate::tolerance(&options, &isolation)?,
            isolation,
            safe,
            tiles,
            alignment: drilling::alignment(&options)?,
            drilling,
            drill_tips: drill_depth.is_none(),
            one_drill: options.one_drill == Some(true),
            alignment_depth: drilling::alignment_depth(&options, thickness)?.unwrap_or(thickness + PINS),
            rivet: given("rivet", options.rivet)?,
            offset: options.offset.map_or_else(Vector::default, |to| Vector::new(to.x.nm(), to.y.nm())),
            mirror_axis: options.mirror_axis.map(Length::nm),
            thickness,
            drills,
            drill_speeds: workshop.drilling,
            drill_tip_angle: workshop.point,
            drill_dwell: options.drill_dwell.map_or(0, |wait| wait.milliseconds),
            drill_tolerance: drilling::drill_tolerance(&options)?,
            drill_bore: bores,
            drill_bore_from: given("drill-bore-from", options.drill_bore_from)?,
            drill_bore_tool: match &options.drill_bore_tool {
                Some(choice) => {
                    cutting_out::end_mill("drill-bore-tool", workshop.fetch("drill-bore-tool", choice)?.tool)?
                }
                None => cutout_tool.clone(),
            },
            drill_side: up(options.drill_side),
            cutout_side: up(options.cutout_side),
            outline_gap: cutting_out::outline_gap(&options)?,
            cutout: heights(cutout_depth, checked::step("cutout-pass", options.cutout_pass, cutout_depth)?),
            cutout_tool,
            clearing: Clearing::of(&options),
            sites: sites(&options)?,
            pixel: pixel(&options)?,
            machine: Machine {
                travel: validate::machine_travel(&options)?.or(machine.travel),
                spin_up: dialect.spin_up,
                ..machine
            },
            dialect,
            origin: match options.origin {
                Origin::LowerLeft => toolpath::Origin::LowerLeft,
                Origin::Keep => toolpath::Origin::Keep,
                Origin::Center => toolpath::Origin::Center,
            },
            cutout_ramp: cutting_out::ramp(options.cutout_ramp)?,
            tabs,
            tab_width: positive("tab-width", options.tab_width)?,
            tab_top,
            couplings: false,
            // Said though nobody gave them, so that programs tell how deep cuts and the cutout are,
            // what is bored and where all tiles lie.
            options: Options {
                depth,
                drill_bore: Some(bores),
                cutout_depth: Some(Length(cutout_depth)),
                tile_spacing: tiles.map(|(_, spacing)| Length(spacing)).or(options.tile_spacing),
                ..written
            },
            asked: options,
        })
    }

    /// The options they came from, complete: what the report repeats.
    #[must_use]
    pub const fn options(&self) -> &Options {
        &self.options
    }

    /// What the options come to, without them.
    pub(super) fn without_options(&self) -> Self {
        Self { options: Options::default(), ..self.clone() }
    }

    /// How holes are drilled on a board that lies so.
    pub(super) fn drilling_at<'a>(&'a self, placement: &'a Placement) -> Drilling<'a> {
        Drilling {
            drills: &self.drills,
            tolerance: self.drill_tolerance,
            mill: self.drill_bore.then_some(&self.drill_bore_tool),
            bored_from: self.drill_bore_from,
            heights: self.drilling,
            turn: self.cutout.step,
            tips: self.drill_tips,
            one: self.one_drill,
            placement,
            order: Order::default(),
            dwell: self.drill_dwell,
            speeds: self.drill_speeds,
            point: self.drill_tip_angle,
        }
    }

    /// The width of the widest isolation cut at the surface.
    #[must_use]
    pub fn kerf(&self) -> Nm {
        self.isolation.first().map_or(Nm::ZERO, Cutting::kerf)
    }

    /// How wide the isolation cuts of each tool are at the surface, at least and at most: the
    /// widest tool first.
    pub(super) fn kerfs(&self) -> Vec<[Nm; 2]> {
        let width = |cutting: &Cutting| {
            let most = cutting.kerf();
            [cutting.tool.least_width(cutting.heights.cut, self.adaptive_depth).min(most), most]
        };
        self.isolation.iter().map(width).collect()
    }

    /// The width of the finest isolation cut at the surface.
    #[must_use]
    pub fn finest_kerf(&self) -> Nm {
        self.isolation.last().map_or(Nm::ZERO, Cutting::kerf)
    }
}

/// The side that is up: the front unless another is said.
fn up(side: Option<DrillSide>) -> Side {
    match side {
        None | Some(DrillSide::Front) => Side::Front,
        Some(DrillSide::Back) => Side::Back,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gcode::dialect::Blend;

    fn settings(text: &str) -> Result<Settings, Error> {
        Options::from_toml("voromill.toml", text).and_then(Settings::resolve)
    }

    #[test]
    fn the_tool_waits_no_lower_than_it_travels() {
        for (text, key) in [
            ("park = \"1mm\"", Some("park")),
            ("park = \"0mm,0mm,1mm\"", Some("park")),
            ("tool-change-at = \"-5mm\"", Some("tool-change-at")),
            ("park = \"2mm\"", None),
            // The usual height is not what anybody asked for.
            ("safe-z = \"25mm\"", None),
        ] {
            let refused = settings(text).err().map(|error| error.to_string());
            match (refused, key) {
                (None, None) => {}
                (Some(error), Some(key)) => assert!(error.starts_with(key), "{text}: {error}"),
                (error, _) => panic!("{text}: {error:?}"),
            }
        }
    }

    #[test]
    fn two_ways_to_say_the_same_in_one_file_are_refused_with_the_line() {
        let error = settings("depth = \"0.1mm\"\npasses = 3\nwidth = \"1mm\"\n").expect_err("both");
        assert_eq!(
            error.to_string(),
            "voromill.toml:3:1: `width` and `passes` are two ways to say the same: set one of them"
        );
        assert!(settings("passes = 3").is_ok(), "one of them");
    }

    #[test]
    fn a_thick_board_is_cut_out_as_deep_as_it_is_thick() {
        let depth = |text: &str| settings(text).expect("settings that make sense").cutout.cut;
        assert_eq!(depth("thickness = \"3.2mm\""), Nm::from_um(3300), "as thick, and a little below");
        assert_eq!(depth("thickness = \"3.2mm\"\ncutout-depth = \"1mm\""), Nm::from_um(1000), "as given");
    }

    #[test]
    fn the_defaults_are_settings() {
        let settings = Settings::resolve(Options::default()).expect("the defaults");
        assert_eq!(settings.kerf(), Nm::new(153_590), "0.1 + 2 · 0.1 · tan 15°");
        assert_eq!(settings.pixel, None, "as the smallest gap allows");
    }

    #[test]
    fn the_depth_follows_from_the_kerf_that_is_wanted() {
        let settings = settings("kerf = \"0.15359mm\"").expect("settings");
        assert_eq!(settings.isolation[0].heights.cut, Nm::from_um(100), "0.1 + 2 · 0.1 · tan 15°");
    }

    #[test]
    fn the_lap_keeps_as_far_from_copper_as_is_cut_or_cleared() {
        for (text, margin) in [
            ("", 200),
            ("tool = \"endmill:0.8mm\"", 800),
            ("width = \"0.5mm\"", 500),
            ("limit = \"0.3mm\"", 1000),
            ("clear = true", 1000),
            ("frame-margin = \"0.08mm\"", 80),
        ] {
            assert_eq!(settings(text).expect(text).frame_margin, Nm::from_um(margin), "{text}");
        }
    }

    #[test]
    fn an_overlap_in_percent_is_of_each_tools_own_kerf() {
        let text = "tool = [\"endmill:0.4mm\", \"endmill:0.1mm\"]\npasses = 3\noverlap = \"50%\"";
        let settings = settings(text).expect("settings");
        let overlap = |cutting: &Cutting| cutting.widening.map(|widening| widening.overlap);
        let overlaps: Vec<_> = settings.isolation.iter().map(overlap).collect();
        assert_eq!(overlaps, [Some(Nm::from_um(200)), Some(Nm::from_um(50))], "half of each");
    }

    #[test]
    fn passes_of_a_v_bit_leave_no_strip_at_the_bottom_of_the_copper() {
        // 83 µm wide at the surface, 54 µm below 35 µm of copper; and 32 and 13 µm.
        for tool in ["vbit:0.05mm:45deg\"\ndepth = \"0.04mm", "vbit:0mm:30deg\"\ndepth = \"0.06mm"] {
            for overlap in ["", "overlap = \"0mm\"", "overlap = \"20%\""] {
                let text = format!("tool = \"{tool}\"\nclear = true\n{overlap}");
                let widening = settings(&text).expect(&text).isolation[0].widening.expect("passes");
                let advance = widening.kerf - widening.overlap;
                assert!(advance <= widening.floor, "{text}: {advance:?} where {:?} are cut", widening.floor);
            }
        }
    }

    #[test]
    fn corners_are_rounded_as_asked_where_the_dialect_has_a_word_for_it() {
        for (text, blend) in [
            ("dialect = \"linuxcnc\"", Some(Blend::Within(Nm::from_um(5)))),
            ("dialect = \"linuxcnc\"\nblend = \"0.02mm\"", Some(Blend::Within(Nm::from_um(20)))),
            ("dialect = \"linuxcnc\"\nblend = \"machine\"", Some(Blend::Machine)),
            ("blend = \"0.02mm\"", None),
        ] {
            assert_eq!(settings(text).expect(text).dialect.blend, blend, "{text}");
        }
    }

    #[test]
    fn dpi_and_pixel_replace_each_other() {
        assert_eq!(settings("dpi = 500").expect("settings").pixel, Some(Nm::new(50_800)), "an inch by 500");
        let over = Options::from_toml("f", "pixel = \"20um\"").expect("options");
        let under = Options::from_toml("f", "dpi = 500").expect("options");
        assert_eq!(
            Settings::resolve(over.or(under)).expect("settings").pixel,
            Some(Nm::from_um(20)),
            "the later wins"
        );
    }

    #[test]
    fn values_that_make_no_sense_are_refused_by_name() {
        for (text, key) in [
            ("depth = \"0mm\"", "depth"),
            ("tool = \"drill:1mm\"", "tool"),
            ("thickness = \"0mm\"", "thickness"),
            ("cutout-tool = \"vbit:0.1mm:30deg\"", "cutout-tool"),
            ("tab-height = \"2mm\"", "tab-height"),
            ("thickness = \"0.6mm\"\ncutout-depth = \"1.6mm\"", "tab-height"),
            ("adaptive-depth = \"0.03mm\"", "adaptive-depth"),
            ("pixel = \"10nm\"", "pixel"),
            ("limit = \"-1mm\"", "limit"),
            ("limit = \"0.07mm\"", "limit"),
            ("outline-gap = \"10mm\"", "outline-gap"),
            ("kerf = \"0.05mm\"", "kerf"),
            ("cutout-ramp = \"90deg\"", "cutout-ramp"),
            ("tab-spacing = \"0mm\"", "tab-spacing"),
            ("tool = \"endmill:0.2mm\"\nkerf = \"0.3mm\"", "kerf"),
            ("tool = [\"endmill:0.2mm\", \"isolator\"]", "tool"),
            ("drills = \"clearer\"", "drills"),
            ("drill-bore-tool = \"drill:1mm\"", "drill-bore-tool"),
            ("frame-margin = \"0.07mm\"", "frame-margin"),
            ("passes = 3\noverlap = \"1mm\"", "overlap"),
            ("sites = \"core\"\nwidth = \"1mm\"", "sites"),
            ("sites = \"core\"\npasses = 2", "sites"),
            ("sites = \"core\"\nclear = true", "sites"),
            ("sites = \"core\"\nstrategy = \"outline\"", "sites"),
            ("sites = \"core\"\nstrategy-for = \"GND=outline\"", "sites"),
            ("output-name = [\"front=a.ngc\", \"back=a.ngc\"]", "output-name"),
            ("safe-z = \"50um\"", "safe-z"),
            ("cutout-pass = \"1nm\"", "cutout-pass"),
            ("drill-peck = \"1nm\"", "drill-peck"),
            ("drill-tip-angle = \"180deg\"", "drill-tip-angle"),
            ("drill-safe-z = \"50um\"", "drill-safe-z"),
            ("break-through = \"0mm\"", "break-through"),
            ("rivet = \"0mm\"", "rivet"),
            ("alignment-depth = \"1mm\"", "alignment-depth"),
            ("drill-tolerance = \"-1um\"", "drill-tolerance"),
            ("alignment-holes = \"3mm\"\nalignment-margin = \"1mm\"", "alignment-margin"),
            ("machine-travel = \"280mm,0mm,40mm\"", "machine-travel"),
            ("adaptive-depth = \"0.1mm\"", "adaptive-depth"),
            ("adaptive-depth = \"0.05mm\"\ntool = \"endmill:0.2mm\"", "adaptive-depth"),
            ("tool = \"endmill:500mm\"", "tool"),
            ("width = \"30mm\"\ntool = \"endmill:0.02mm\"", "tool"),
            ("clear = true\noverlap = \"99.99%\"", "overlap"),
            ("width = \"2mm\"\noverlap = \"99.99%\"", "overlap"),
            ("depth = \"1000mm\"", "tool"),
            ("tool-change = \"m6\"", "tool-change"),
            ("dialect = \"tinyg\"\ntool-change = \"pause\"", "tool-change"),
            ("dialect = \"smoothieware\"\ntool-change = \"m6\"", "tool-change"),
            ("depth = \"-0.1mm\"", "depth: depths are positive here: write `0.1mm`"),
            ("cutout-depth = \"-1.7mm\"", "cutout-depth: depths are positive here: write `1.7mm`"),
            ("passes = 1000000000", "passes"),
            ("passes = 0", "passes"),
            ("dpi = 0", "dpi"),
            ("tabs = 4000000000", "tabs"),
            ("drill-bore-from = \"0mm\"", "drill-bore-from"),
        ] {
            let error = settings(text).expect_err(text).to_string();
            assert!(error.starts_with(key), "{text}: {error}");
        }
    }
}
