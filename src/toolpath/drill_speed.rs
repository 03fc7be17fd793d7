//! How fast a drill turns and goes down, by its diameter and what it drills.
//!
//! Two figures decide: the speed of the drill's rim, and how far it goes down in one turn, its chip
//! load. A spindle for boards at home turns too slowly for the first, so what counts is the second:
//! a drill that advances too little rubs and burns, one that advances too much breaks. The feed is
//! the chip load times the turns that the spindle really makes.
//!
//! | | rim | chip load |
//! |---|---|---|
//! | glass epoxy, industry | 500 to 600 ft/min | 3 mil a turn; copper alone 2 mil |
//! | fine bits, by rule of thumb | | 1 % of the diameter a turn |
//! | here, FR-4 | 150 m/min (490 ft/min) | [`CHIP_LOADS`] |
//!
//! Sources: P. Gould on IPC TechNet, 9 February 1996 (industry); the rule of pcb-gcode as
//! forscience.nl quotes it; the formulae between rim, turns, chip load and feed are Union Tool's
//! ("Terms for drilling parameter"). The table goes by the rule for fine drills, and stays at half
//! of what industry gives copper for thick ones: small machines have no pressure foot, and their
//! spindles give way. Chosen between those bounds.

use crate::geometry::Nm;

use super::feed::Feed;

/// What boards are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Material {
    /// Glass cloth in epoxy: hard on tools.
    #[default]
    Fr4,
    /// Paper in phenolic resin: softer; a quarter more chip load. Chosen.
    Fr1,
}

/// The speed of the rim, in nanometres per minute. 150 m/min; chosen, see the module's doc.
const RIM: f64 = 150e9;

/// Diameters in micrometres, rising, with the chip load in nanometres for FR-4. Between them the
/// chip load goes evenly, and beyond the last it stays.
const CHIP_LOADS: &[(i64, i64)] = &[
    (0, 0),
    (300, 5_000),
    (500, 8_000),
    (800, 12_000),
    (1000, 14_000),
    (1500, 18_000),
    (2000, 21_000),
    (3200, 25_000),
];

/// How drills are run that have no speeds of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrillSpeeds {
    /// The speed into the material that was asked for.
    pub plunge: Option<Feed>,
    /// The turns per minute that were asked for.
    pub spindle: Option<u32>,
    /// What is drilled.
    pub material: Material,
    /// The least and the most turns per minute of the spindle.
    pub turns: (u32, u32),
    /// The most that the machine goes down in a feed.
    pub most: Option<Feed>,
}

/// A spindle of 12000 turns in FR-4.
impl Default for DrillSpeeds {
    fn default() -> Self {
        Self { plunge: None, spindle: None, material: Material::Fr4, turns: (0, 12_000), most: None }
    }
}

impl DrillSpeeds {
    /// The speed into the material and the turns per minute for a drill of this diameter.
    #[must_use]
    pub fn of(&self, diameter: Nm) -> (Feed, u32) {
        let turns = self.spindle.unwrap_or_else(|| self.turns(diameter));
        let load = chip_load(diameter, self.material);
        // Whole millimetres per minute: what is left of one is less than a spindle wavers.
        let millimetres = (load * i64::from(turns) / 1_000_000).max(1);
        let feed = Feed::try_new(millimetres * 1000).unwrap_or(Feed::from_mm_per_min(1000));
        let feed = self.most.map_or(feed, |most| most.min(feed));
        (self.plunge.unwrap_or(feed), turns)
    }

    /// As many turns as the rim may have and the spindle makes, in hundreds.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
    fn turns(&self, diameter: Nm) -> u32 {
        let (least, most) = self.turns;
        let wanted = RIM / (std::f64::consts::PI * diameter.to_f64().max(1.0));
        (((wanted / 100.0).floor() * 100.0) as u32).min(most).max(least)
    }
}

/// How far a drill goes down in one turn, in nanometres.
fn chip_load(diameter: Nm, material: Material) -> i64 {
    let row = |(diameter, load): (i64, i64)| (Nm::from_um(diameter).get(), load);
    let mut rows = CHIP_LOADS.windows(2).map(|pair| (row(pair[0]), row(pair[1])));
    let between = rows.find(|(_, (to, _))| diameter.get() <= *to);
    let load = match between {
        Some(((from, low), (to, high))) => low + (high - low) * (diameter.get() - from) / (to - from),
        None => CHIP_LOADS.last().map_or(0, |(_, load)| *load),
    };
    match material {
        Material::Fr4 => load,
        Material::Fr1 => load * 5 / 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_follow_the_diameter_the_material_and_the_spindle() {
        let slow = DrillSpeeds::default();
        for (diameter, feed, turns) in
            [(300, 60, 12_000), (800, 144, 12_000), (1000, 168, 12_000), (6000, 197, 7900)]
        {
            let got = slow.of(Nm::from_um(diameter));
            assert_eq!(got, (Feed::from_mm_per_min(feed), turns), "{diameter} um");
        }
        let fast = DrillSpeeds { turns: (8000, 60_000), ..slow };
        assert_eq!(
            fast.of(Nm::from_um(1000)),
            (Feed::from_mm_per_min(667), 47_700),
            "as fast as the rim may be"
        );
        assert_eq!(fast.of(Nm::from_mm(8)).1, 8000, "and no slower than the spindle turns");
        let soft = DrillSpeeds { material: Material::Fr1, ..slow };
        assert_eq!(soft.of(Nm::from_um(800)).0, Feed::from_mm_per_min(180), "a quarter more");
        let asked = DrillSpeeds { spindle: Some(6000), ..slow };
        assert_eq!(asked.of(Nm::from_um(800)), (Feed::from_mm_per_min(72), 6000), "the chip stays as thick");
        let limited = DrillSpeeds { most: Some(Feed::from_mm_per_min(100)), ..slow };
        assert_eq!(limited.of(Nm::from_um(800)).0, Feed::from_mm_per_min(100), "no faster than z goes");
    }

    #[test]
    fn a_thicker_drill_never_has_a_thinner_chip() {
        let loads: Vec<i64> = (1..400).map(|i| chip_load(Nm::from_um(i * 10), Material::Fr4)).collect();
        assert!(loads.is_sorted() && loads[0] > 0, "{loads:?}");
    }
}
