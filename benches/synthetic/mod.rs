//! Boards of any size that look like real ones, as Gerber text: tiles of 10 × 10 mm, each a bus, a
//! fine-pitch field, a plane with thermals or a field of holes with traces between, all of it with
//! gaps of 0.2 mm and more.

#[path = "../../tests/it/random.rs"]
mod random;

use std::fmt::Write as _;

use random::splitmix64;

/// Millimetres along a side of a tile.
const TILE: i64 = 10;

/// A splitmix64 generator: the same board on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> i64 {
        i64::try_from(((splitmix64(&mut self.0) >> 32) * bound) >> 32).expect("32 bits")
    }
}

/// A copper layer of about `features` features, and how many it has. Beyond 300 000 everything is
/// half as large, or the board would be larger than a metre.
pub(crate) fn gerber(features: usize) -> (String, usize) {
    let unit = if features > 300_000 { 500 } else { 1000 };
    let along = i64::try_from((features / 90).max(1).isqrt().max(1)).expect("small");
    let places = (0..).flat_map(|row| (0..along).map(move |column| (column, row)));
    tiles(unit, places, |drawn| drawn >= features)
}

/// A copper layer of `side` × `side` tiles, and how many features it has.
#[allow(dead_code, reason = "not every benchmark needs it")]
pub(crate) fn panel(side: i64) -> (String, usize) {
    tiles(1000, (0..side).flat_map(|row| (0..side).map(move |column| (column, row))), |_| false)
}

/// A copper layer of `features` flashes in one place, half of them by a step-and-repeat of no step,
/// and one pad beside them; it has two places with copper.
#[allow(dead_code, reason = "not every benchmark needs it")]
pub(crate) fn coincident(features: usize) -> String {
    let mut text = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,1*%\nD10*\nX0Y2000000D03*\n".to_owned();
    for _ in 0..features / 2 {
        text.push_str("X0Y0D03*\n");
    }
    text + &format!("%SRX{}Y1I0J0*%\nX0Y0D03*\n%SR*%\nM02*\n", (features / 2).max(1))
}

/// Tiles at these columns and rows, until there are enough features; `unit` nanometres stand for a
/// micrometre.
fn tiles(
    unit: i64,
    places: impl Iterator<Item = (i64, i64)>,
    enough: impl Fn(usize) -> bool,
) -> (String, usize) {
    let text = "%FSLAX46Y46*%\n%MOMM*%\n".to_owned();
    let mut layer = Layer { text, features: 0, origin: (0, 0), unit };
    layer.define();
    let mut random = Random(7);
    for (column, row) in places {
        if enough(layer.features) {
            break;
        }
        layer.origin = (column * TILE * 1000, row * TILE * 1000);
        match (column + row * 3) % 4 {
            0 => layer.bus(&mut random),
            1 => layer.field(),
            2 => layer.plane(),
            _ => layer.holes(&mut random),
        }
    }
    layer.text.push_str("M02*\n");
    (layer.text, layer.features)
}

/// Apertures in micrometres from D10 on: trace, round pad, fine pad lying, fine pad standing, via,
/// antipad, spoke.
const APERTURES: [(char, &[i64]); 7] = [
    ('C', &[200]),
    ('C', &[1600]),
    ('R', &[800, 300]),
    ('R', &[300, 800]),
    ('C', &[500]),
    ('C', &[1200]),
    ('C', &[250]),
];

struct Layer {
    text: String,
    features: usize,
    /// The tile's corner in micrometres.
    origin: (i64, i64),
    /// Nanometres in a micrometre, as it were.
    unit: i64,
}

impl Layer {
    fn define(&mut self) {
        for (number, (shape, sizes)) in (10..).zip(APERTURES) {
            let millimetres = |nm: i64| format!("{}.{:06}", nm / 1_000_000, nm % 1_000_000);
            let sizes: Vec<String> = sizes.iter().map(|size| millimetres(size * self.unit)).collect();
            let _ = writeln!(self.text, "%ADD{number}{shape},{}*%", sizes.join("X"));
        }
        self.text.push_str("G01*\n");
    }

    fn say(&mut self, aperture: u32, at: (i64, i64), operation: &str) {
        let (x, y) = ((self.origin.0 + at.0) * self.unit, (self.origin.1 + at.1) * self.unit);
        let _ = writeln!(self.text, "D{aperture}*\nX{x}Y{y}{operation}*");
    }

    fn flash(&mut self, aperture: u32, at: (i64, i64)) {
        self.say(aperture, at, "D03");
        self.features += 1;
    }

    fn trace(&mut self, aperture: u32, points: &[(i64, i64)]) {
        self.say(aperture, points[0], "D02");
        for &to in &points[1..] {
            self.say(aperture, to, "D01");
            self.features += 1;
        }
    }

    /// Sixteen traces side by side, with a jog, and a via at each end.
    fn bus(&mut self, random: &mut Random) {
        let jog = 2000 + random.below(3000);
        for line in 0..16 {
            let y = 500 + line * 500;
            self.trace(10, &[(500, y), (jog, y), (jog + 1000, y + 1000), (9500, y + 1000)]);
            self.flash(14, (500, y));
            self.flash(14, (9500, y + 1000));
        }
    }

    /// A package with 48 pads around it, each with a trace to a via.
    fn field(&mut self) {
        for pad in 0..12 {
            let along = 2250 + pad * 500;
            // Vias take turns near and far, or they would touch.
            let far = 400 + pad % 2 * 600;
            for (aperture, at, via) in [
                (12, (2000, along), (far, along)),
                (12, (8000, along), (TILE * 1000 - far, along)),
                (13, (along, 2000), (along, far)),
                (13, (along, 8000), (along, TILE * 1000 - far)),
            ] {
                self.flash(aperture, at);
                self.trace(10, &[at, via]);
                self.flash(14, via);
            }
        }
    }

    /// A filled area with sixteen pads of its own on four spokes each, cut free by clear discs.
    fn plane(&mut self) {
        let (x0, y0) = ((self.origin.0 + 300) * self.unit, (self.origin.1 + 300) * self.unit);
        let (x1, y1) = (x0 + 9400 * self.unit, y0 + 9400 * self.unit);
        let _ = writeln!(
            self.text,
            "G36*\nX{x0}Y{y0}D02*\nX{x1}Y{y0}D01*\nX{x1}Y{y1}D01*\nX{x0}Y{y1}D01*\nX{x0}Y{y0}D01*\nG37*"
        );
        self.features += 1;
        let places: Vec<_> = (0..16).map(|pad| (1500 + pad % 4 * 2300, 1500 + pad / 4 * 2300)).collect();
        self.text.push_str("%LPC*%\n");
        places.iter().for_each(|&at| self.flash(15, at));
        self.text.push_str("%LPD*%\n");
        for (number, &(x, y)) in places.iter().enumerate() {
            self.flash(14, (x, y));
            // Every third is a via of another net.
            if number % 3 != 0 {
                self.trace(16, &[(x - 800, y), (x, y), (x + 800, y)]);
                self.trace(16, &[(x, y - 800), (x, y), (x, y + 800)]);
            }
        }
    }

    /// Rows of pads for leads, joined here and there to a neighbour.
    fn holes(&mut self, random: &mut Random) {
        for pad in 0..16 {
            let (x, y) = (1200 + pad % 4 * 2540, 1200 + pad / 4 * 2540);
            self.flash(11, (x, y));
            match random.below(4) {
                0 if pad % 4 < 3 => self.trace(10, &[(x, y), (x + 2540, y)]),
                1 if pad / 4 < 3 => self.trace(10, &[(x, y), (x, y + 2540)]),
                2 if pad % 4 < 3 && pad / 4 < 3 => {
                    self.trace(10, &[(x + 1270, y - 900), (x + 1270, y + 900), (x + 1500, y + 1270)]);
                }
                _ => self.trace(10, &[(x, y), (x, y + 1200)]),
            }
        }
    }
}
