//! Boards on which a search can take the square of their size, as files, in any size: many equal
//! distances, many neighbours of one thing, long things beside each other, the same place over and
//! over. All made here, in nanometres.

use std::fmt::Write as _;

/// A kind of board.
#[derive(Clone, Copy)]
pub(crate) struct Member {
    pub(crate) name: &'static str,
    /// What its smallest board has so many of.
    pub(crate) of: &'static str,
    /// The smallest size.
    pub(crate) least: u32,
    make: fn(u32) -> Files,
}

/// Names and texts.
type Files = Vec<(&'static str, String)>;

impl Member {
    /// The files of a board of this size.
    pub(crate) fn files(self, size: u32) -> Files {
        (self.make)(size)
    }
}

const fn member(name: &'static str, of: &'static str, least: u32, make: fn(u32) -> Files) -> Member {
    Member { name, of, least, make }
}

/// All of them.
pub(crate) const FAMILY: [Member; 14] = [
    member("ring", "pads in two rings", 60, ring),
    member("star", "traces that point at a centre", 64, star),
    member("spiral", "segments of two coils, one in the other", 512, spiral),
    member("equal", "pads on a grid", 256, equal),
    member("hatch", "windows of a hatched pour", 256, hatch),
    member("antipads", "pads in discs cleared from a plane", 625, antipads),
    member("coincident", "traces and pads in one place", 1000, coincident),
    member("region", "vertices of one region with cut-ins", 6250, region),
    member("serrated", "vertices of one disc's edge", 6250, serrated),
    member("text", "letters of 18 vertices", 250, text),
    member("diagonal", "traces side by side, aslant", 32, diagonal),
    member("wheel", "millimetres of arcs, one in the other", 200, wheel),
    member("clusters", "holes in clusters, of 4 sizes", 1000, clusters),
    member("lattice", "holes on a grid, of one size", 1000, lattice),
];

/// The file of the copper.
const COPPER: &str = "board-F_Cu.gbr";
/// The file of the holes.
const HOLES: &str = "board.drl";

type Place = (i64, i64);

/// A copper layer as text.
struct Layer(String);

impl Layer {
    /// One with apertures from D10 on, as a shape and sizes in millimetres.
    fn new(apertures: &[&str]) -> Self {
        let mut text = "%FSLAX46Y46*%\n%MOMM*%\n%TF.FileFunction,Copper,L1,Top*%\n".to_owned();
        for (number, aperture) in (10..).zip(apertures) {
            let _ = writeln!(text, "%ADD{number}{aperture}*%");
        }
        text.push_str("G01*\nG75*\n");
        Self(text)
    }

    fn say(&mut self, aperture: u32, (x, y): Place, operation: &str) {
        let _ = writeln!(self.0, "D{aperture}*\nX{x}Y{y}{operation}*");
    }

    fn flash(&mut self, aperture: u32, at: Place) {
        self.say(aperture, at, "D03");
    }

    fn trace(&mut self, aperture: u32, points: &[Place]) {
        self.say(aperture, points[0], "D02");
        points[1..].iter().for_each(|&to| self.say(aperture, to, "D01"));
    }

    fn region(&mut self, points: impl IntoIterator<Item = Place>) {
        self.0.push_str("G36*\n");
        let mut operation = "D02";
        for (x, y) in points {
            let _ = writeln!(self.0, "X{x}Y{y}{operation}*");
            operation = "D01";
        }
        self.0.push_str("G37*\n");
    }

    fn polarity(&mut self, dark: bool) {
        self.0.push_str(if dark { "%LPD*%\n" } else { "%LPC*%\n" });
    }

    fn files(self) -> Files {
        vec![(COPPER, self.0 + "M02*\n")]
    }
}

/// A place as far as `radius` from zero, after `part` of `parts` of a turn.
#[expect(clippy::cast_possible_truncation, reason = "a board is small")]
fn polar(radius: f64, part: f64, parts: f64) -> Place {
    let angle = std::f64::consts::TAU * part / parts;
    ((radius * libm::cos(angle)).round() as i64, (radius * libm::sin(angle)).round() as i64)
}

/// The side of a square of so many.
fn side(size: u32) -> i64 {
    i64::from(size.isqrt())
}

/// The columns and rows of a square of so many, `step` apart.
fn square(size: u32, step: i64) -> impl Iterator<Item = Place> {
    let side = side(size);
    (0..side).flat_map(move |row| (0..side).map(move |column| (column * step, row * step)))
}

/// Half of the pads in each ring, 1.5 mm apart.
fn ring(size: u32) -> Files {
    let mut layer = Layer::new(&["C,1"]);
    let each = f64::from(size / 2);
    let radius = 1.5e6 * each / std::f64::consts::TAU;
    for pad in 0..size / 2 {
        layer.flash(10, polar(radius, f64::from(pad), each));
        layer.flash(10, polar(radius + 2e6, f64::from(pad), each));
    }
    layer.files()
}

/// They end 0.5 mm apart, all as far from the centre.
fn star(size: u32) -> Files {
    let mut layer = Layer::new(&["C,0.2"]);
    let count = f64::from(size);
    let radius = 0.5e6 * count / std::f64::consts::TAU;
    for trace in 0..size {
        let part = f64::from(trace);
        layer.trace(10, &[polar(radius, part, count), polar(radius + 10e6, part, count)]);
    }
    layer.files()
}

/// Two traces, 0.5 mm from each other everywhere, in chords of about 1 mm.
fn spiral(size: u32) -> Files {
    let mut layer = Layer::new(&["C,0.25"]);
    for start in [0.0, 0.5] {
        // The radius grows by a millimetre a turn, so the way is about the square of the angle.
        let point = |chord: u32| {
            let turns = (f64::from(chord + 8) * 2.0 / std::f64::consts::TAU).sqrt();
            polar(1e6 * turns, turns + start, 1.0)
        };
        layer.trace(10, &(0..size / 2).map(point).collect::<Vec<_>>());
    }
    layer.files()
}

/// 1.27 mm apart.
fn equal(size: u32) -> Files {
    let mut layer = Layer::new(&["C,0.8"]);
    square(size, 1_270_000).for_each(|at| layer.flash(10, at));
    layer.files()
}

/// Lines of 0.3 mm, 2 mm apart, with a pad in every window.
fn hatch(size: u32) -> Files {
    let mut layer = Layer::new(&["C,0.3", "C,0.8"]);
    let (lines, far) = (side(size), side(size) * 2_000_000);
    for line in 0..=lines {
        let at = line * 2_000_000;
        layer.trace(10, &[(at, 0), (at, far)]);
        layer.trace(10, &[(0, at), (far, at)]);
    }
    square(size, 2_000_000).for_each(|(x, y)| layer.flash(11, (x + 1_000_000, y + 1_000_000)));
    layer.files()
}

/// 1.5 mm apart, in a plane.
fn antipads(size: u32) -> Files {
    let mut layer = Layer::new(&["C,1.1", "C,0.6"]);
    let far = side(size) * 1_500_000;
    layer.region([(-1_500_000, -1_500_000), (far, -1_500_000), (far, far), (-1_500_000, far)]);
    layer.polarity(false);
    square(size, 1_500_000).for_each(|at| layer.flash(10, at));
    layer.polarity(true);
    square(size, 1_500_000).for_each(|at| layer.flash(11, at));
    layer.files()
}

/// A quarter of them the same trace, a quarter the same pad, beside it another net of the same.
fn coincident(size: u32) -> Files {
    let mut layer = Layer::new(&["C,0.5", "R,1.5X1"]);
    for _ in 0..size / 4 {
        for y in [0, 2_000_000] {
            layer.trace(10, &[(0, y), (5_000_000, y)]);
            layer.flash(11, (5_000_000, y));
        }
    }
    layer.files()
}

/// Round holes of 48 vertices in a plane, each reached by a cut-in of no width, a pad in each.
fn region(size: u32) -> Files {
    let mut layer = Layer::new(&["C,0.6"]);
    let holes = (size / 50).isqrt().pow(2);
    let far = side(holes) * 2_000_000;
    let mut points = vec![(-1_000_000, -1_000_000), (far, -1_000_000), (far, far), (-1_000_000, far)];
    // Row by row along the left edge, downwards; each cut-in goes right through a row of holes.
    for row in (0..side(holes)).rev() {
        let y = row * 2_000_000;
        points.push((-1_000_000, y));
        let half = |x: i64, range: std::ops::RangeInclusive<i32>| {
            range.map(move |corner| {
                let (dx, dy) = polar(0.6e6, f64::from(corner), 48.0);
                (x + dx, y + dy)
            })
        };
        let columns = || (0..side(holes)).map(|column| column * 2_000_000);
        columns().for_each(|x| points.extend(half(x, -24..=0)));
        columns().rev().for_each(|x| points.extend(half(x, 0..=24)));
        points.push((-1_000_000, y));
    }
    points.push((-1_000_000, -1_000_000));
    layer.region(points);
    square(holes, 2_000_000).for_each(|at| layer.flash(10, at));
    layer.files()
}

/// A disc of 20 mm with teeth of 20 µm, in a ring of pads.
fn serrated(size: u32) -> Files {
    let mut layer = Layer::new(&["C,1"]);
    let count = f64::from(size);
    let corner = |vertex: u32| polar(20e6 + f64::from(vertex % 2) * 2e4, f64::from(vertex), count);
    layer.region((0..size).chain([0]).map(corner));
    (0..64).for_each(|pad| layer.flash(10, polar(21.5e6, f64::from(pad), 64.0)));
    layer.files()
}

/// Octagons with an octagonal hole, 0.8 mm high.
fn text(size: u32) -> Files {
    let mut layer = Layer::new(&["C,0.1"]);
    for (x, y) in square(size, 1_000_000) {
        let around = |radius: f64, corners: [u32; 9]| {
            corners.map(|corner| {
                let (dx, dy) = polar(radius, f64::from(corner), 8.0);
                (x + dx * 3 / 4, y + dy)
            })
        };
        let outer = around(0.4e6, [0, 1, 2, 3, 4, 5, 6, 7, 0]);
        let inner = around(0.2e6, [0, 7, 6, 5, 4, 3, 2, 1, 0]);
        layer.region(outer.into_iter().chain(inner).chain([outer[0]]));
    }
    layer.files()
}

/// 80 mm long and 0.5 mm apart.
fn diagonal(size: u32) -> Files {
    let mut layer = Layer::new(&["C,0.2"]);
    for trace in 0..i64::from(size) {
        let at = trace * 500_000;
        layer.trace(10, &[(at, -at), (at + 60_000_000, -at + 53_000_000)]);
    }
    layer.files()
}

/// Nearly full circles, 1 mm apart, open on the right.
fn wheel(size: u32) -> Files {
    let mut layer = Layer::new(&["C,0.4"]);
    for arc in 0..(size / 3).isqrt() {
        let radius = 2e6 + 1e6 * f64::from(arc);
        let gap = 0.5e6 / radius / std::f64::consts::TAU;
        let ((x, y), (to_x, to_y)) = (polar(radius, gap, 1.0), polar(radius, -gap, 1.0));
        let _ = writeln!(layer.0, "D10*\nX{x}Y{y}D02*\nG03*\nX{to_x}Y{to_y}I{}J{}D01*\nG01*", -x, -y);
    }
    layer.files()
}

/// Holes as a drill file, of tools in hundredths of a millimetre, between two pads.
fn drill(tools: &[u32], holes: impl Iterator<Item = (usize, Place)>) -> Files {
    let mut by_tool = vec![String::new(); tools.len()];
    let (mut far_x, mut far_y) = (0, 0);
    let millimetres = |nm: i64| {
        let sign = if nm < 0 { "-" } else { "" };
        format!("{sign}{}.{:03}", nm.abs() / 1_000_000, nm.abs() / 1000 % 1000)
    };
    for (tool, (x, y)) in holes {
        (far_x, far_y) = (far_x.max(x), far_y.max(y));
        let _ = writeln!(by_tool[tool], "X{}Y{}", millimetres(x), millimetres(y));
    }
    let mut text = "M48\nMETRIC,TZ\n".to_owned();
    for (number, tool) in (1..).zip(tools) {
        let _ = writeln!(text, "T{number}C{}.{:02}", tool / 100, tool % 100);
    }
    text.push_str("%\n");
    for (number, holes) in (1..).zip(by_tool) {
        let _ = write!(text, "T{number}\n{holes}");
    }
    let mut layer = Layer::new(&["C,1"]);
    layer.flash(10, (-10_000_000, -10_000_000));
    layer.flash(10, (far_x + 10_000_000, far_y + 10_000_000));
    let mut files = layer.files();
    files.push((HOLES, text + "M30\n"));
    files
}

/// Fifty to a cluster, clusters 20 mm apart on a line.
fn clusters(size: u32) -> Files {
    let hole = |hole: u32| {
        let (dx, dy) = polar(0.35e6 * f64::from(hole % 50), f64::from(hole % 50) * 0.382, 1.0);
        let cluster = i64::from(hole / 50);
        (hole as usize % 4, (cluster % 40 * 20_000_000 + dx, cluster / 40 * 40_000_000 + dy))
    };
    // Within half a metre, so smaller where there are many.
    let shrink = move |(tool, (x, y)): (usize, Place)| (tool, (x / 2, y / 2));
    drill(&[60, 80, 100, 120], (0..size).map(hole).map(shrink))
}

/// 1.27 mm apart.
fn lattice(size: u32) -> Files {
    drill(&[80], square(size, 1_270_000).map(|at| (0, at)))
}
