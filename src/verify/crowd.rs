//! What is left where cuts cross by the hundred thousand: by pictures alone, as fine as it takes.
//!
//! Polygons of so many kerfs take minutes. Two pictures bound the truth instead: one with kerfs
//! narrower by three quarters of a pixel shows whatever may be left, one with kerfs wider by as
//! much what is left for certain. Where both say the same of a net it is so; else pixels are
//! halved, down to a least size. What is still in doubt then is told as such.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::{Nm, Polygon, Rect};
use crate::grid::Grid;
use crate::topology::NetId;

use super::Settings;
use super::exact::{FINE, designed};
use super::milled::{self, narrower};
use super::pieces::{Extent, Part};
use super::rest::{Doubt, Joined, Remains, Remnant, Rest};
use super::sheet::Sheet;

/// The finest pixel. Chosen: a hundredth of a usual kerf; a crumb has a thousand of them.
const FINEST: Nm = Nm::from_um(3);
/// Rows of pixels that all kerfs together may run through in a picture. Chosen: a second's work.
const ROWS: i64 = 8_000_000;

/// What became of a net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fate {
    Lost,
    Whole,
    Parted,
}

/// What a picture shows.
struct Seen {
    /// The parts of each net that count, by the piece that they are in.
    nets: BTreeMap<NetId, Vec<Remnant>>,
    /// Nets that are in one piece with others, with all that are, and where.
    joined: BTreeMap<usize, (Vec<NetId>, Rect)>,
}

impl Seen {
    fn fate(&self, net: NetId) -> Fate {
        match self.nets.get(&net).map_or(0, Vec::len) {
            0 => Fate::Lost,
            1 => Fate::Whole,
            _ => Fate::Parted,
        }
    }

    /// The pairs of nets that are joined.
    fn pairs(&self) -> BTreeSet<(NetId, NetId)> {
        let pairs = |nets: &Vec<NetId>| {
            let each = nets.iter().enumerate();
            each.flat_map(|(at, &a)| nets[at + 1..].iter().map(move |&b| (a, b))).collect::<Vec<_>>()
        };
        self.joined.values().flat_map(|(nets, _)| pairs(nets)).collect()
    }
}

/// What is left in a part of the board.
pub(super) fn within(sheet: &Sheet<'_>, doubt: &Doubt, settings: &Settings) -> Remains {
    let rests: BTreeMap<NetId, Rest> = doubt
        .nets
        .iter()
        .map(|&net| (net, Rest { designed: designed(sheet, net, doubt.rect, FINE), parts: Vec::new() }))
        .collect();
    let least = rests.iter().map(|(&net, rest)| (net, rest.least(settings))).collect();
    let mut pitch = sheet.pitch();
    loop {
        let picture = |narrower: Nm| seen(sheet, doubt.rect, pitch, narrower, &least);
        let (may, does) = (picture(narrower(pitch)), picture(-narrower(pitch)));
        let doubtful: BTreeSet<NetId> =
            doubt.nets.iter().copied().filter(|&net| may.fate(net) != does.fate(net)).collect();
        let (maybe, surely) = (may.pairs(), does.pairs());
        let finer = pitch / 2;
        let is_clear = doubtful.is_empty() && maybe == surely;
        if is_clear || finer < FINEST || rows(sheet, doubt.rect, finer) > ROWS {
            let pairs = maybe.difference(&surely).flat_map(|&(a, b)| [a, b]);
            let unsure = doubtful.into_iter().chain(pairs).collect();
            return remains(doubt, rests, may, does, unsure);
        }
        pitch = finer;
    }
}

/// How many rows of pixels all kerfs near `rect` run through together.
fn rows(sheet: &Sheet<'_>, rect: Rect, pitch: Nm) -> i64 {
    let near = sheet.places.cuts.touching(rect).into_iter();
    let height = |cut: usize| sheet.cuts[cut].swept.shape.bounds().height().min(rect.height());
    near.map(|cut| height(cut).get() / pitch.get()).sum()
}

/// What is so beyond doubt; of nets that are not, what may be.
fn remains(
    doubt: &Doubt,
    mut rests: BTreeMap<NetId, Rest>,
    may: Seen,
    does: Seen,
    unsure: BTreeSet<NetId>,
) -> Remains {
    let joined = does.joined.into_values();
    let joined = joined.map(|(nets, place)| Joined { place, nets, crowded: true }).collect();
    let mut parts = may.nets;
    rests.retain(|net, _| doubt.parted.contains(net) && !unsure.contains(net));
    for (net, rest) in &mut rests {
        rest.parts = parts.remove(net).unwrap_or_default();
        rest.parts.sort_by(|a, b| b.area.total_cmp(&a.area));
    }
    Remains { joined, nets: rests, unsure }
}

/// What a picture of a part of the board shows of nets, of which so much counts.
fn seen(sheet: &Sheet<'_>, rect: Rect, pitch: Nm, narrower: Nm, least: &BTreeMap<NetId, f64>) -> Seen {
    let mut seen = Seen { nets: BTreeMap::new(), joined: BTreeMap::new() };
    let Ok(grid) = Grid::covering(rect, pitch) else { return seen };
    let parts = milled::pieces(sheet, &grid, narrower);
    let mm2 = pitch.to_mm() * pitch.to_mm();
    for parts in parts.chunk_by(|a, b| a.piece == b.piece) {
        let remnant = |part: &Part| {
            let net = Sheet::net(part.label)?;
            #[expect(clippy::cast_precision_loss, reason = "an area")]
            let area = part.pixels as f64 * mm2;
            let polygon = Polygon::rectangle(part.extent.rect(&grid));
            let piece = usize::try_from(part.piece).ok()?;
            (area >= *least.get(&net)?).then_some((net, Remnant { polygon, area, piece }))
        };
        let found: Vec<(NetId, Remnant)> = parts.iter().filter_map(remnant).collect();
        if found.len() > 1 {
            let mut nets: Vec<NetId> = found.iter().map(|(net, _)| *net).collect();
            nets.sort_unstable();
            let extent = parts.iter().map(|part| part.extent).reduce(Extent::union);
            let extent = extent.expect("a piece has parts");
            seen.joined.insert(found[0].1.piece, (nets, extent.rect(&grid)));
        }
        for (net, remnant) in found {
            seen.nets.entry(net).or_default().push(remnant);
        }
    }
    seen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::{Axis, Board, Copper, Feature, Shape, Side};
    use crate::geometry::Point;
    use crate::verify::exact;
    use crate::verify::machining::Machining;
    use crate::verify::{Program, Role};

    /// Two rows of pads of 1 mm, 1.5 mm apart.
    fn board() -> Board {
        let at = |c: i64, r: i64| Point::new(Nm::from_um(1500 * c), Nm::from_um(1500 * r));
        let pads = (0..8).map(|n| Shape::Disc { center: at(n % 4, n / 4), radius: Nm::from_um(500) });
        let features = pads.map(|shape| Feature { shape, axis: Axis::Region, attributes: 0, line: 0 });
        let copper =
            Copper { side: Side::Front, features: features.collect(), attributes: vec![Default::default()] };
        Board { front: Some(copper), ..Board::default() }
    }

    /// Cuts across the board, by chance.
    fn chords(count: u32, mut seed: u64) -> String {
        let mut text = "(tool endmill:0.1mm)\nG21 G90 F100\nM3 S1000\nG0 Z2\n".to_owned();
        let mut next = |most: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % most
        };
        for _ in 0..count {
            let [x, to_x, y, to_y] = [6500, 6500, 3500, 3500].map(&mut next);
            text += &format!(
                "G0 X{}.{:03} Y{}.{:03}\nG1 Z-0.1\nG1 X{}.{:03} Y{}.{:03}\nG0 Z2\n",
                x / 1000,
                x % 1000,
                y / 1000,
                y % 1000,
                to_x / 1000,
                to_x % 1000,
                to_y / 1000,
                to_y % 1000,
            );
        }
        text + "M5\nM2\n"
    }

    #[test]
    fn pictures_say_what_polygons_say() {
        let (board, settings) = (board(), Settings::default());
        let mut told = 0;
        for (count, seed) in [(3, 1), (12, 2), (30, 3), (60, 4), (90, 5)] {
            let role = Some(Role::Isolation(Side::Front));
            let program = Program { text: chords(count, seed), role, ..Program::default() };
            let read = Machining::read(&program, &board, &settings).expect("a program");
            let copper = board.front.as_ref().expect("its copper");
            let sheet = Sheet::new(copper, None, &board, &[&read], &settings).expect("it can be judged");
            let nets: BTreeSet<NetId> = (0..8).map(NetId).collect();
            let doubt = Doubt { rect: sheet.rect(), nets: nets.clone(), parted: nets.clone() };
            let (exact, seen) = (exact::within(&sheet, &doubt, &settings), within(&sheet, &doubt, &settings));
            let pieces = |remains: &Remains, net: &NetId| remains.nets[net].apart().len();
            for net in nets.iter().filter(|net| !seen.unsure.contains(net)) {
                let [a, b] = [&exact, &seen].map(|remains| pieces(remains, net).min(2));
                assert_eq!(a, b, "net {} after {count} cuts", net.0);
                told += 1;
            }
            let pairs = |remains: &Remains| {
                let nets = remains.joined.iter().map(|joined| joined.nets.clone());
                nets.flat_map(|nets| {
                    let pair = |a: &NetId| {
                        nets.iter().filter(move |b| a < *b).map(move |b| (*a, *b)).collect::<Vec<_>>()
                    };
                    nets.iter().flat_map(pair).collect::<Vec<_>>()
                })
                .collect::<BTreeSet<_>>()
            };
            assert!(
                pairs(&seen).is_subset(&pairs(&exact)),
                "no nets are joined that are apart, {count} cuts"
            );
            let sure = |(a, b): &(NetId, NetId)| !seen.unsure.contains(a) && !seen.unsure.contains(b);
            let missed: Vec<_> = pairs(&exact).difference(&pairs(&seen)).copied().filter(sure).collect();
            assert_eq!(missed, [], "nets joined after {count} cuts");
        }
        assert!(told > 30, "pictures are sure of most nets: {told} of 40");
    }
}
