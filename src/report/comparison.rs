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

/// Places that the short text shows for each file; the rest are counted. Chosen.
const SHOWN: usize = 5;
/// Pixels along a side of a picture, at most. Chosen: larger than a screen.
const SIDE: u32 = 2400;

/// Programs of the same name, compared.
#[derive(Clone, Debug, Serialize)]
pub struct Compared {
    /// Their name.
    pub file: String,
    /// Whether both cut the same.
    pub same: bool,
    /// How much is cut now that was not.
    pub more_cut: Amount,
    /// How much is left now that was cut.
    pub less_cut: Amount,
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
    /// `cut` where it is cut now and was not, else `left`.
    pub change: &'static str,
    /// Its middle, where the machine has it.
    pub at: Place,
    /// Its width and height.
    pub size_mm: [Millimetres; 2],
    /// In mm².
    pub area_mm2: f64,
}

impl Compared {
    /// What came of comparing two programs called `file`.
    #[must_use]
    pub fn new(file: &str, comparison: &Comparison) -> Self {
        let amount = |change: Change| {
            let (places, area) = comparison.total(change);
            Amount { places, area_mm2: rounded(area) }
        };
        Self {
            file: file.to_owned(),
            same: comparison.is_same(),
            more_cut: amount(Change::Cut),
            less_cut: amount(Change::Left),
            pixel_mm: Millimetres(comparison.resolution),
            places: comparison.regions.iter().map(Difference::new).collect(),
        }
    }

    /// For people: a line, and the largest differences below it; all of them where `verbose`.
    #[must_use]
    pub fn to_text(&self, verbose: bool) -> String {
        if self.same {
            return format!("{}: the same copper\n", self.file);
        }
        let Self { more_cut: more, less_cut: less, .. } = self;
        let places = |amount: &Amount| crate::board::diagnostic::count(amount.places, "place");
        let mut text = format!(
            "{}: {:.4} mm² more cut away in {}, {:.4} mm² less in {}\n",
            self.file,
            more.area_mm2,
            places(more),
            less.area_mm2,
            places(less)
        );
        let shown = if verbose { usize::MAX } else { SHOWN };
        for place in self.places.iter().take(shown) {
            let sign = if place.change == "more" { "more" } else { "less" };
            let (at, [width, height]) = (&place.at, &place.size_mm);
            let _ = writeln!(
                text,
                "  {sign} at {:.3}, {:.3} mm: {:.4} mm² within {:.3} × {:.3} mm",
                at.x_mm.0, at.y_mm.0, place.area_mm2, width.0, height.0
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
            },
            at: Place::from(region.middle()),
            size_mm: [region.rect.width(), region.rect.height()].map(Millimetres),
            area_mm2: rounded(region.area),
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
/// what is left now is green.
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
                    Spot::One(Change::Cut) => NEWLY_CUT,
                    Spot::One(Change::Left) => NEWLY_LEFT,
                },
            );
        }
    }
    Ok(canvas)
}
