//! A small board drawn at random, as Gerber text: what copper can look like, in odd places and at
//! odd angles.

use std::fmt::{self, Debug, Formatter, Write};

use proptest::prelude::*;
use voromill::geometry::{Nm, Rect};

/// A place or a way in nanometres.
type Spot = (i64, i64);

/// Places are parts of the board's width and height, in so many.
const PARTS: i64 = 10_000;

/// The shape of a pad, in nanometres and degrees.
#[derive(Clone, Copy, Debug)]
enum Pad {
    Disc {
        diameter: i64,
    },
    Rectangle {
        width: i64,
        height: i64,
    },
    Oblong {
        width: i64,
        height: i64,
    },
    Polygon {
        diameter: i64,
        corners: i64,
        degrees: i64,
    },
    Turned {
        width: i64,
        height: i64,
        degrees: i64,
    },
    /// With corners rounded by so many twentieths of the shorter side, as a macro of discs and
    /// rectangles.
    Rounded {
        width: i64,
        height: i64,
        twentieths: i64,
        degrees: i64,
    },
}

/// A part of a trace: straight on, or round a centre on its left (or right, if the radius is
/// negative).
#[derive(Clone, Copy, Debug)]
enum Leg {
    Line { length: i64, degrees: i64 },
    Arc { radius: i64, from: i64, sweep: i64 },
}

/// Something drawn in one go.
#[derive(Clone, Debug)]
enum Item {
    Flash(Pad),
    /// Two discs with so much between them.
    Pair {
        diameters: [i64; 2],
        gap: i64,
        degrees: i64,
    },
    /// Pads in a row, as along the edge of a chip, turned with it.
    Row {
        size: Spot,
        gap: i64,
        count: i64,
        degrees: i64,
    },
    Trace {
        width: i64,
        legs: Vec<Leg>,
    },
    /// A region with corners that far from its middle, at equal angles.
    Star {
        corners: Vec<i64>,
    },
}

/// What lies below everything.
#[derive(Clone, Copy, Debug)]
struct Plane {
    /// How far it keeps from what is drawn on it.
    clearance: i64,
    /// Every so manieth item it does not keep from: it is on the plane's net.
    joins: usize,
}

/// The edge of the board.
#[derive(Clone, Copy, Debug)]
struct Edge {
    /// How far it lies beyond the copper.
    margin: i64,
    /// By how much its corners are rounded.
    round: i64,
}

/// A hole or a slot drawn on the outline layer.
#[derive(Clone, Debug)]
enum Drawn {
    /// In the middle of an item, of so many, so wide.
    Hole { item: usize, diameter: i64 },
    /// Anywhere, so long between the middles of its round ends, and so wide.
    Slot { at: Spot, length: i64, width: i64, degrees: i64 },
}

/// A board drawn at random.
#[derive(Clone)]
pub(super) struct Drawing {
    /// Width and height.
    size: Spot,
    /// What places are multiples of.
    grid: i64,
    /// What all that is drawn is a multiple of.
    step: i64,
    items: Vec<(Spot, Item)>,
    plane: Option<Plane>,
    edge: Option<Edge>,
    /// Cut out, where there is an edge.
    drawn: Vec<Drawn>,
}

const FULL: std::ops::Range<i64> = 0..360;

/// Any angle, the usual ones more often.
fn degrees() -> impl Strategy<Value = i64> {
    prop_oneof![2 => (0..8_i64).prop_map(|eighth| eighth * 45), 1 => FULL]
}

/// A gap as boards have them, and as they should not.
fn gap() -> impl Strategy<Value = i64> {
    prop_oneof![
        6 => 100_000..400_000_i64,
        2 => prop::sample::select(vec![127_000, 150_000, 200_000, 250_000]),
        1 => 5_000..100_000_i64,
        1 => prop::sample::select(vec![0, 1, 1_000]),
    ]
}

fn side() -> impl Strategy<Value = i64> {
    prop_oneof![3 => (3..25_i64).prop_map(|tenths| tenths * 100_000), 1 => 250_000..2_500_000_i64]
}

fn pad() -> impl Strategy<Value = Pad> {
    prop_oneof![
        side().prop_map(|diameter| Pad::Disc { diameter }),
        (side(), side()).prop_map(|(width, height)| Pad::Rectangle { width, height }),
        (side(), side()).prop_map(|(width, height)| Pad::Oblong { width, height }),
        (side(), 3..=12_i64, FULL).prop_map(|(diameter, corners, degrees)| Pad::Polygon {
            diameter,
            corners,
            degrees
        }),
        (side(), side(), FULL).prop_map(|(width, height, degrees)| Pad::Turned { width, height, degrees }),
        (side(), side(), 1..10_i64, degrees()).prop_map(|(width, height, twentieths, degrees)| {
            Pad::Rounded { width, height, twentieths, degrees }
        }),
    ]
}

fn leg() -> impl Strategy<Value = Leg> {
    let radius = prop_oneof![300_000..3_000_000_i64, -3_000_000..-300_000_i64];
    prop_oneof![
        3 => (100_000..4_000_000_i64, degrees()).prop_map(|(length, degrees)| Leg::Line { length, degrees }),
        1 => (radius, FULL, 5..330_i64).prop_map(|(radius, from, sweep)| Leg::Arc { radius, from, sweep }),
    ]
}

fn item() -> impl Strategy<Value = Item> {
    let width = prop::sample::select(vec![100_000, 150_000, 200_000, 254_000, 300_000, 500_000, 1_000_000]);
    prop_oneof![
        4 => pad().prop_map(Item::Flash),
        1 => ([side(), side()], gap(), degrees())
            .prop_map(|(diameters, gap, degrees)| Item::Pair { diameters, gap, degrees }),
        1 => ((150_000..800_000_i64, 300_000..1_500_000_i64), gap(), 2..8_i64, degrees())
            .prop_map(|(size, gap, count, degrees)| Item::Row { size, gap, count, degrees }),
        4 => (width, prop::collection::vec(leg(), 1..5))
            .prop_map(|(width, legs)| Item::Trace { width, legs }),
        1 => prop::collection::vec(200_000..1_500_000_i64, 3..9).prop_map(|corners| Item::Star { corners }),
    ]
}

/// Any small board.
pub(super) fn drawing() -> impl Strategy<Value = Drawing> {
    let size = (3_000_000..25_000_000_i64, 3_000_000..25_000_000_i64);
    let grid = prop::sample::select(vec![1, 1_000, 25_400, 50_000, 635_000]);
    let items = prop::collection::vec(((0..=PARTS, 0..=PARTS), item()), 2..28);
    let plane = (gap(), 2..9_usize).prop_map(|(clearance, joins)| Plane { clearance, joins });
    let edge = (0..1_500_000_i64, prop_oneof![Just(0), 0..2_000_000_i64])
        .prop_map(|(margin, round)| Edge { margin, round });
    let optional = (prop::option::weighted(0.3, plane), prop::option::weighted(0.6, edge));
    (size, grid, items, optional).prop_map(|(size, grid, items, (plane, edge))| Drawing {
        size,
        grid,
        step: 1,
        items,
        plane,
        edge,
        drawn: Vec::new(),
    })
}

/// Small boards on which everything is a multiple of a tenth of a millimetre and of an eighth of a
/// turn: equal distances, tangencies, copper upon copper.
pub(super) fn coarse_drawing() -> impl Strategy<Value = Drawing> {
    let coarse = |drawing: Drawing| {
        let items = drawing.items.into_iter().map(|(at, item)| (at, item.coarse())).collect();
        let plane = drawing.plane.map(|plane| Plane { clearance: multiple(plane.clearance), ..plane });
        Drawing { grid: STEP, step: STEP, items, plane, ..drawing }
    };
    drawing().prop_map(coarse)
}

/// What all that is coarse is a multiple of.
const STEP: i64 = 100_000;

/// The multiple of the step next to a length, no less than one.
fn multiple(length: i64) -> i64 {
    whole(length, STEP).max(STEP)
}

/// The same of twice the step.
fn even(length: i64) -> i64 {
    whole(length, 2 * STEP).max(2 * STEP)
}

fn whole(length: i64, step: i64) -> i64 {
    (length + step / 2).div_euclid(step) * step
}

/// Some quarters of a turn, at most three.
fn quarters(degrees: i64) -> i64 {
    (degrees / 90).clamp(1, 3) * 90
}

/// Small boards with holes and slots drawn on the outline layer, as some CAD programs do.
pub(super) fn drawing_with_holes() -> impl Strategy<Value = Drawing> {
    let drawn = prop::collection::vec(drawn(), 1..4);
    (drawing(), drawn).prop_map(|(drawing, drawn)| Drawing { drawn, ..drawing })
}

fn drawn() -> impl Strategy<Value = Drawn> {
    let hole =
        (0..28_usize, 400_000..2_000_000_i64).prop_map(|(item, diameter)| Drawn::Hole { item, diameter });
    let slot = ((0..=PARTS, 0..=PARTS), 500_000..4_000_000_i64, 500_000..1_500_000_i64, degrees());
    let slot = slot.prop_map(|(at, length, width, degrees)| Drawn::Slot { at, length, width, degrees });
    prop_oneof![3 => hole, 1 => slot]
}

impl Item {
    /// The same with lengths that are multiples of the step, and eighths of a turn.
    fn coarse(self) -> Self {
        let eighths = |degrees: i64| degrees / 45 * 45;
        match self {
            Self::Flash(pad) => Self::Flash(match pad {
                Pad::Disc { diameter } => Pad::Disc { diameter: even(diameter) },
                Pad::Rectangle { width, height } => {
                    Pad::Rectangle { width: even(width), height: even(height) }
                }
                Pad::Oblong { width, height } => Pad::Oblong { width: even(width), height: even(height) },
                Pad::Polygon { diameter, .. } => {
                    Pad::Polygon { diameter: even(diameter), corners: 4, degrees: 0 }
                }
                Pad::Turned { width, height, degrees } => {
                    Pad::Turned { width: even(width), height: even(height), degrees: eighths(degrees) }
                }
                Pad::Rounded { width, height, degrees, .. } => Pad::Rounded {
                    width: even(width),
                    height: even(height),
                    twentieths: 5,
                    degrees: eighths(degrees),
                },
            }),
            Self::Pair { diameters, gap, degrees } => Self::Pair {
                diameters: diameters.map(even),
                gap: whole(gap, STEP),
                degrees: quarters(degrees),
            },
            Self::Row { size: (width, height), gap, count, degrees } => Self::Row {
                size: (even(width), even(height)),
                gap: whole(gap, STEP),
                count,
                degrees: quarters(degrees),
            },
            Self::Trace { width, legs } => {
                let leg = |leg| match leg {
                    Leg::Line { length, degrees } => {
                        Leg::Line { length: multiple(length), degrees: eighths(degrees) }
                    }
                    Leg::Arc { radius, from, sweep } => Leg::Arc {
                        radius: multiple(radius.abs()) * radius.signum(),
                        from: from / 90 * 90,
                        sweep: quarters(sweep),
                    },
                };
                Self::Trace { width: even(width), legs: legs.into_iter().map(leg).collect() }
            }
            Self::Star { corners } => Self::Star { corners },
        }
    }
}

impl Drawing {
    /// The copper.
    pub(super) fn copper(&self) -> String {
        let mut pen = Pen::new(self.step);
        if let Some(Plane { clearance, joins }) = self.plane {
            let (width, height) = self.size;
            pen.region(&[(0, 0), (width, 0), (width, height), (0, height)]);
            pen.text.push_str("%LPC*%\n");
            for (i, item) in self.items.iter().enumerate() {
                if i % joins != 0 {
                    self.draw(item, clearance, &mut pen);
                }
            }
            pen.text.push_str("%LPD*%\n");
        }
        self.items.iter().for_each(|item| self.draw(item, 0, &mut pen));
        pen.finish()
    }

    /// The board's edge, if it has one, round copper within `bounds`.
    pub(super) fn edge(&self, bounds: Rect) -> Option<String> {
        let Edge { margin, round } = self.edge?;
        let [low, high] = [bounds.min(), bounds.max()];
        let (left, bottom) = (low.x.get() - margin, low.y.get() - margin);
        let (right, top) = (high.x.get() + margin, high.y.get() + margin);
        let round = round.min((right - left).min(top - bottom) / 2);
        let mut pen = Pen::new(1);
        pen.take("C,0.1");
        // Straight to one place, then round a corner to the next, as far as the edge has such
        // parts.
        let legs = [
            ((right - round, bottom), (right, bottom + round), (0, round)),
            ((right, top - round), (right - round, top), (-round, 0)),
            ((left + round, top), (left, top - round), (0, -round)),
            ((left, bottom + round), (left + round, bottom), (round, 0)),
        ];
        let mut from = (left + round, bottom);
        pen.to(from, "D02");
        for (to, then, center) in legs {
            if to != from {
                pen.to(to, "D01");
            }
            if then != to {
                pen.arc(then, center, true);
            }
            from = then;
        }
        self.drawn.iter().for_each(|drawn| self.cut_out(drawn, &mut pen));
        Some(pen.finish())
    }

    /// Draws the edge of a hole or slot.
    fn cut_out(&self, drawn: &Drawn, pen: &mut Pen) {
        match *drawn {
            Drawn::Hole { item, diameter } => {
                let (x, y) = self.place(self.items[item % self.items.len()].0);
                pen.to((x + diameter / 2, y), "D02");
                pen.arc((x + diameter / 2, y), (-diameter / 2, 0), true);
            }
            Drawn::Slot { at, length, width, degrees } => {
                let one = self.place(at);
                let other = polar(one, length, degrees);
                let (right, left) = (degrees - 90, degrees + 90);
                pen.to(polar(one, width / 2, right), "D02");
                for (end, from, to) in [(other, right, left), (one, left, right)] {
                    let start = polar(end, width / 2, from);
                    pen.to(start, "D01");
                    pen.arc(polar(end, width / 2, to), (end.0 - start.0, end.1 - start.1), true);
                }
            }
        }
    }

    /// The multiple of the grid near a place that is told in parts.
    fn place(&self, (x, y): Spot) -> Spot {
        let snap = |part: i64, length: i64| length * part / PARTS / self.grid * self.grid;
        (snap(x, self.size.0), snap(y, self.size.1))
    }

    /// Draws an item, larger by `grown` all round.
    fn draw(&self, (at, item): &(Spot, Item), grown: i64, pen: &mut Pen) {
        let at = self.place(*at);
        match item {
            Item::Flash(pad) => pen.flash(&pad.aperture(grown), at),
            Item::Pair { diameters: [first, second], gap, degrees } => {
                let apart = first / 2 + second / 2 + gap;
                pen.flash(&Pad::Disc { diameter: *first }.aperture(grown), at);
                pen.flash(&Pad::Disc { diameter: *second }.aperture(grown), polar(at, apart, *degrees));
            }
            Item::Row { size: (width, height), gap, count, degrees } => {
                let pad = Pad::Turned { width: *width, height: *height, degrees: *degrees };
                for i in 0..*count {
                    pen.flash(&pad.aperture(grown), polar(at, i * (width + gap), *degrees));
                }
            }
            Item::Trace { width, legs } => {
                pen.take(&Pad::Disc { diameter: *width }.aperture(grown));
                pen.to(at, "D02");
                let mut from = at;
                for leg in legs {
                    from = pen.leg(*leg, from);
                }
            }
            Item::Star { corners } => {
                let step = 360 / i64::try_from(corners.len()).expect("a few");
                let angles = (0..).map(|i| i * step);
                let ring: Vec<Spot> =
                    corners.iter().zip(angles).map(|(&far, degrees)| polar(at, far, degrees)).collect();
                pen.region(&ring);
                if grown > 0 {
                    pen.take(&Pad::Disc { diameter: 0 }.aperture(grown));
                    pen.to(ring[0], "D02");
                    ring.iter().cycle().skip(1).take(ring.len()).for_each(|&corner| pen.to(corner, "D01"));
                }
            }
        }
    }
}

/// The files, for who must look into a failure.
impl Debug for Drawing {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} {:?} on a grid of {} nm\n{}", self.items, self.plane, self.grid, self.copper())
    }
}

impl Pad {
    /// Its aperture, larger by `grown` all round.
    fn aperture(self, grown: i64) -> String {
        let mm = |length: i64| millimetres(length + 2 * grown);
        match self {
            Self::Disc { diameter } => format!("C,{}", mm(diameter)),
            Self::Rectangle { width, height } => format!("R,{}X{}", mm(width), mm(height)),
            Self::Oblong { width, height } => format!("O,{}X{}", mm(width), mm(height)),
            Self::Polygon { diameter, corners, degrees } => {
                format!("P,{}X{corners}X{degrees}", mm(diameter + grown))
            }
            Self::Turned { width, height, degrees } => {
                format!("TURNED,{}X{}X{degrees}", mm(width), mm(height))
            }
            Self::Rounded { width, height, twentieths, degrees } => {
                let radius = millimetres(width.min(height) * twentieths / 20 + grown);
                format!("ROUNDED,{}X{}X{radius}X{degrees}", mm(width), mm(height))
            }
        }
    }
}

/// A length as apertures say it.
fn millimetres(length: i64) -> String {
    format!("{}.{:06}", length / 1_000_000, length % 1_000_000)
}

/// The place so far away in a direction.
fn polar((x, y): Spot, length: i64, degrees: i64) -> Spot {
    let (sine, cosine) = libm::sincos(Nm::new(degrees).to_f64().to_radians());
    let along = |part: f64| Nm::from_f64(Nm::new(length).to_f64() * part).get();
    (x + along(cosine), y + along(sine))
}

/// What each file begins with.
const MACROS: &str = "%FSLAX46Y46*%
%MOMM*%
%AMTURNED*21,1,$1,$2,0,0,$3*%
%AMROUNDED*21,1,$1,$2-$3-$3,0,0,$4*
21,1,$1-$3-$3,$2,0,0,$4*
1,1,$3+$3,$1/2-$3,$2/2-$3,$4*
1,1,$3+$3,$3-$1/2,$2/2-$3,$4*
1,1,$3+$3,$1/2-$3,$3-$2/2,$4*
1,1,$3+$3,$3-$1/2,$3-$2/2,$4*%
";

/// Writes Gerber.
struct Pen {
    apertures: Vec<String>,
    text: String,
    /// What places are rounded to.
    step: i64,
}

impl Pen {
    fn new(step: i64) -> Self {
        Self { apertures: Vec::new(), text: String::new(), step }
    }

    /// Takes up an aperture.
    fn take(&mut self, aperture: &str) {
        let known = self.apertures.iter().position(|other| other == aperture).unwrap_or_else(|| {
            self.apertures.push(aperture.to_owned());
            self.apertures.len() - 1
        });
        self.write(format_args!("D{}*\n", known + 10));
    }

    fn flash(&mut self, aperture: &str, at: Spot) {
        self.take(aperture);
        self.to(at, "D03");
    }

    fn to(&mut self, (x, y): Spot, operation: &str) {
        let [x, y] = [x, y].map(|place| whole(place, self.step));
        self.write(format_args!("X{x}Y{y}{operation}*\n"));
    }

    fn arc(&mut self, (x, y): Spot, (i, j): Spot, left: bool) {
        let way = if left { "G03" } else { "G02" };
        let [x, y, i, j] = [x, y, i, j].map(|place| whole(place, self.step));
        self.write(format_args!("{way}*\nX{x}Y{y}I{i}J{j}D01*\nG01*\n"));
    }

    /// A part of a trace; returns where it ends.
    fn leg(&mut self, leg: Leg, from: Spot) -> Spot {
        match leg {
            Leg::Line { length, degrees } => {
                let end = polar(from, length, degrees);
                self.to(end, "D01");
                end
            }
            Leg::Arc { radius, from: degrees, sweep } => {
                let center = polar(from, radius.abs(), degrees + 180);
                let end = polar(center, radius.abs(), degrees + sweep * radius.signum());
                self.arc(end, (center.0 - from.0, center.1 - from.1), radius > 0);
                end
            }
        }
    }

    fn region(&mut self, ring: &[Spot]) {
        self.write(format_args!("G36*\n"));
        self.to(ring[0], "D02");
        ring.iter().cycle().skip(1).take(ring.len()).for_each(|&corner| self.to(corner, "D01"));
        self.write(format_args!("G37*\n"));
    }

    fn write(&mut self, text: fmt::Arguments<'_>) {
        self.text.write_fmt(text).expect("written to memory");
    }

    /// The file.
    fn finish(self) -> String {
        let mut file = MACROS.to_owned();
        for (code, aperture) in (10..).zip(&self.apertures) {
            writeln!(file, "%ADD{code}{aperture}*%").expect("written to memory");
        }
        file + "G75*\nG01*\n" + &self.text + "M02*\n"
    }
}
