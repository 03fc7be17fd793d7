//! How programs differ, as people and build systems read it: text, JSON, and a picture.

use std::fmt::Write as _;

use serde::Serialize;

use crate::geometry::{Nm, Rect};
use crate::grid::Grid;
use crate::verify::{Change, Comparison, Error, Region, Spot};

use super::Canvas;
use super::palette::{COPPER, CUT, GROUND, Rgb};
use super::quantity::{Millimetres, Place, SCHEMA_VERSION, json};

/// What is cut now and was not.
const NEWLY_CUT: Rgb = Rgb(0xff, 0x4d, 0x4d);
/// What was cut and is left now.
const NEWLY_LEFT: Rgb = Rgb(0x3d, 0xd6, 0x8c);
/// What is cut deeper now.
const DEEPER: Rgb = Rgb(0x9b, 0x4d, 0xff);
/// What is cut less deep now.
const SHALLOWER: Rgb = Rgb(0x4d, 0x9d, 0xff);

/// Places that the short text shows for each file; the rest are counted. Chosen.
const SHOWN: usize = 5;
/// Pixels along a side of a picture, at most. Chosen: larger than a screen.
const SIDE: u32 = 2400;

/// Programs of the same name, compared.
#[derive(Clone, Debug, Serialize)]
pub struct Compared {
    /// Their name.
    pub file: String,
    /// Whether both leave the same copper.
    pub same: bool,
    /// Whether both cut as deep.
    pub same_depth: bool,
    /// How much is cut now that was not.
    pub more_cut: Amount,
    /// How much is left now that was cut.
    pub less_cut: Amount,
    /// How much is cut deeper now.
    pub deeper: Amount,
    /// How much is cut less deep now.
    pub shallower: Amount,
    /// The pixel in which differences are gathered.
    pub pixel_mm: Millimetres,
    /// Where, the largest first.
    pub places: Vec<Difference>,
}

/// How much.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Amount {
    /// In how many places.
    pub places: usize,
    /// In mm².
    pub area_mm2: f64,
}

/// A place where programs differ.
#[derive(Clone, Debug, Serialize)]
pub struct Difference {
    /// `more` where it is cut now and was not, `less` where it was; `deeper` or `shallower` where
    /// both cut it.
    pub change: &'static str,
    /// Its middle, where the machine has it.
    pub at: Place,
    /// Its width and height.
    pub size_mm: [Millimetres; 2],
    /// In mm².
    pub area_mm2: f64,
    /// How deep it was cut and is cut, if both cut it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depths_mm: Option<[Millimetres; 2]>,
}

impl Compared {
    /// What came of comparing two programs called `file`.
    #[must_use]
    pub fn new(file: &str, comparison: &Comparison) -> Self {
        let amount = |change: Change| {
            let (places, area) = comparison.total(change);
            Amount { places, area_mm2: rounded(area) }
        };
        let [more_cut, less_cut, deeper, shallower] = Change::ALL.map(amount);
        Self {
            file: file.to_owned(),
            same: more_cut.places + less_cut.places == 0,
            same_depth: deeper.places + shallower.places == 0,
            more_cut,
            less_cut,
            deeper,
            shallower,
            pixel_mm: Millimetres(comparison.resolution),
            places: comparison.regions.iter().map(Difference::new).collect(),
        }
    }

    /// Whether both do the same to the board.
    #[must_use]
    pub const fn is_same(&self) -> bool {
        self.same && self.same_depth
    }

    /// For people: a line, and the largest differences below it; all of them where `verbose`.
    #[must_use]
    pub fn to_text(&self, verbose: bool) -> String {
        let amounts = [
            (&self.more_cut, "more cut away"),
            (&self.less_cut, "less"),
            (&self.deeper, "cut deeper"),
            (&self.shallower, "less deep"),
        ];
        let amounts = amounts.into_iter().filter(|(amount, _)| amount.places > 0).map(|(amount, how)| {
            let places = crate::board::diagnostic::count(amount.places, "place");
            format!("{:.4} mm² {how} in {places}", amount.area_mm2)
        });
        let amounts = amounts.collect::<Vec<_>>().join(", ");
        let copper = match (self.same, self.same_depth) {
            (true, true) => "the same copper",
            (true, false) => "the same copper, but ",
            (false, _) => "",
        };
        let mut text = format!("{}: {copper}{amounts}\n", self.file);
        let shown = if verbose { usize::MAX } else { SHOWN };
        for place in self.places.iter().take(shown) {
            let (change, at, [width, height]) = (place.change, &place.at, &place.size_mm);
            let depths = place.depths_mm.as_ref();
            let depths = depths.map(|[was, is]| format!("{:.3} mm instead of {:.3} mm, ", is.0, was.0));
            let _ = writeln!(
                text,
                "  {change} at {:.3}, {:.3} mm: {}{:.4} mm² within {:.3} × {:.3} mm",
                at.x_mm.0,
                at.y_mm.0,
                depths.unwrap_or_default(),
                place.area_mm2,
                width.0,
                height.0
            );
        }
        if self.places.len() > shown {
            let _ = writeln!(text, "  {} more places; -v shows all", self.places.len() - shown);
        }
        text
    }
}

impl Difference {
    fn new(region: &Region) -> Self {
        Self {
            change: match region.change {
                Change::Cut => "more",
                Change::Left => "less",
                Change::Deeper => "deeper",
                Change::Shallower => "shallower",
            },
            at: Place::from(region.middle()),
            size_mm: [region.rect.width(), region.rect.height()].map(Millimetres),
            area_mm2: rounded(region.area),
            depths_mm: region.depths.map(|depths| depths.map(Millimetres)),
        }
    }
}

/// What differs, as JSON text.
#[must_use]
pub fn to_json(compared: &[Compared]) -> String {
    #[derive(Serialize)]
    struct All<'a> {
        schema_version: u32,
        programs: &'a [Compared],
    }
    json(&All { schema_version: SCHEMA_VERSION, programs: compared })
}

fn rounded(area: f64) -> f64 {
    (area * 1e6).round() / 1e6
}

/// A picture of all that either cuts: what both cut is pale, what is cut now and was not is red,
/// what is left now is green; violet is cut deeper now, and blue less deep.
///
/// # Errors
///
/// Where there is nothing to show in pixels that are coarse enough.
pub fn picture(comparison: &Comparison) -> Result<Canvas, Error> {
    let nothing = Rect::new(Default::default(), Default::default());
    let rect = comparison.rect.unwrap_or(nothing).inflate(Nm::from_um(500));
    let (grid, spots): (Grid, Vec<Spot>) = comparison.picture(rect, SIDE)?;
    let mut canvas = Canvas::new(grid, GROUND);
    let mut spots = spots.into_iter();
    for row in 0..grid.height() {
        for (column, spot) in (0..grid.width()).zip(spots.by_ref()) {
            canvas.set(
                column,
                row,
                match spot {
                    Spot::Neither => COPPER,
                    Spot::Both => CUT,
                    Spot::Changed(Change::Cut) => NEWLY_CUT,
                    Spot::Changed(Change::Left) => NEWLY_LEFT,
                    Spot::Changed(Change::Deeper) => DEEPER,
                    Spot::Changed(Change::Shallower) => SHALLOWER,
                },
            );
        }
    }
    Ok(canvas)
}
