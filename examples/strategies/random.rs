//! Boards at random that look like boards: chips and passive parts on a grid, traces between pads
//! where there is room, on some of them a plane.

#[path = "../../tests/it/random.rs"]
mod splitmix;

use std::fmt::Write as _;

use splitmix::splitmix64;

/// A splitmix64 generator: the same boards on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> u64 {
        splitmix64(&mut self.0)
    }

    /// From `low` to `high`, both included.
    fn within(&mut self, low: i64, high: i64) -> i64 {
        let span = u64::try_from(high - low + 1).expect("a range");
        low + i64::try_from(self.next() % span).expect("below the span")
    }

    fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        let last = i64::try_from(choices.len()).expect("a few") - 1;
        choices[usize::try_from(self.within(0, last)).expect("an index")]
    }

    fn chance(&mut self, percent: i64) -> bool {
        self.within(1, 100) <= percent
    }
}

/// Micrometres of a cell.
const CELL: i64 = 250;

/// What stands on a cell: nothing, or a net.
type Cell = Option<u32>;

/// A pad: its place in cells, its size in micrometres, and whether it is round.
type Pad = ((i64, i64), (i64, i64), bool);

struct Board {
    cells: Vec<Cell>,
    width: i64,
    height: i64,
    pads: Vec<Pad>,
    /// Traces: corners in cells, width in micrometres.
    traces: Vec<(Vec<(i64, i64)>, i64)>,
}

/// A copper layer as Gerber text.
pub(crate) fn gerber(seed: u64) -> String {
    let mut random = Random(seed);
    let (width, height) = (random.within(60, 360), random.within(60, 300));
    let cells = usize::try_from(width * height).expect("positive");
    let mut board = Board { cells: vec![None; cells], width, height, pads: Vec::new(), traces: Vec::new() };
    let parts = width * height / random.within(500, 4000);
    (0..parts).for_each(|_| board.part(&mut random));
    let trace = random.within(2, 4) * 100;
    let joined = random.within(20, 95);
    for from in 0..board.pads.len() {
        if random.chance(joined) {
            board.join(from, trace, &mut random);
        }
    }
    let plane = random.chance(30).then(|| random.within(200, 500));
    board.text(plane, random.within(3, 20))
}

impl Board {
    fn cell(&self, (x, y): (i64, i64)) -> Option<usize> {
        let inside = (0..self.width).contains(&x) && (0..self.height).contains(&y);
        inside.then(|| usize::try_from(y * self.width + x).expect("inside"))
    }

    /// Whether nothing but `net` is within `reach` cells.
    fn is_free(&self, (x, y): (i64, i64), reach: i64, net: Cell) -> bool {
        (-reach..=reach).all(|dy| {
            (-reach..=reach).all(|dx| {
                let cell = self.cell((x + dx, y + dy));
                cell.is_some_and(|cell| self.cells[cell].is_none() || self.cells[cell] == net)
            })
        })
    }

    fn take(&mut self, (x, y): (i64, i64), (dx, dy): (i64, i64), net: u32) {
        for row in y - dy..=y + dy {
            for column in x - dx..=x + dx {
                if let Some(cell) = self.cell((column, row)) {
                    self.cells[cell] = Some(net);
                }
            }
        }
    }

    /// Rows of pads, one or two, lying or standing, where there is room.
    fn part(&mut self, random: &mut Random) {
        let fine = random.chance(40);
        let pitch = if fine { random.within(4, 6) } else { random.one_of(&[8, 10, 10, 20]) };
        let pads = if random.chance(50) { 2 } else { random.within(3, 14) };
        let rows = if pads > 3 && random.chance(60) { 2 } else { 1 };
        let apart = random.within(16, 40);
        let at = (random.within(4, self.width - 4), random.within(4, self.height - 4));
        let lies = random.chance(50);
        let size = if fine { (600, 1200) } else { random.one_of(&[(1600, 1600), (1800, 1400)]) };
        let round = !fine && random.chance(60);
        let size = if lies { size } else { (size.1, size.0) };
        let half = (size.0 / 2 / CELL, size.1 / 2 / CELL);
        for row in 0..rows {
            for pad in 0..pads {
                let (along, across) = (pad * pitch, row * apart);
                let place = if lies { (at.0 + along, at.1 + across) } else { (at.0 + across, at.1 + along) };
                if self.is_free(place, half.0.max(half.1) + 1, None) {
                    let net = u32::try_from(self.pads.len()).expect("few");
                    self.take(place, half, net);
                    self.pads.push((place, size, round));
                }
            }
        }
    }

    /// A trace from a pad to one near it, by one corner, where there is room for it.
    fn join(&mut self, from: usize, width: i64, random: &mut Random) {
        let start = self.pads[from].0;
        let reach = random.within(20, 140);
        let far = |to: (i64, i64)| (to.0 - start.0).abs() + (to.1 - start.1).abs();
        let near: Vec<usize> =
            (0..self.pads.len()).filter(|&to| (1..reach).contains(&far(self.pads[to].0))).collect();
        if near.is_empty() {
            return;
        }
        let to = random.one_of(&near);
        let end = self.pads[to].0;
        let [own, other] = [start, end].map(|place| self.cell(place).and_then(|cell| self.cells[cell]));
        let corner = if random.chance(50) { (start.0, end.1) } else { (end.0, start.1) };
        let way = [start, corner, end];
        let cells: Vec<(i64, i64)> = way.windows(2).flat_map(|leg| between(leg[0], leg[1])).collect();
        let is_open = cells.iter().all(|&cell| self.is_free(cell, 2, own) || self.is_free(cell, 2, other));
        let (Some(own), Some(other), true) = (own, other, is_open) else { return };
        for cell in &mut self.cells {
            if *cell == Some(other) {
                *cell = Some(own);
            }
        }
        cells.iter().for_each(|&cell| self.take(cell, (0, 0), own));
        self.traces.push((way.to_vec(), width));
    }

    /// The layer; its plane keeps so far from all but every so manieth pad.
    fn text(&self, plane: Option<i64>, joins: i64) -> String {
        let mut text = "%FSLAX46Y46*%\n%MOMM*%\nG01*\n".to_owned();
        let mut code = 10;
        if let Some(clearance) = plane {
            let (x, y) = (self.width * CELL * 1000, self.height * CELL * 1000);
            let _ = writeln!(
                text,
                "G36*\nX0Y0D02*\nX{x}Y0D01*\nX{x}Y{y}D01*\nX0Y{y}D01*\nX0Y0D01*\nG37*\n%LPC*%"
            );
            self.draw(&mut text, &mut code, clearance, joins);
            text.push_str("%LPD*%\n");
        }
        self.draw(&mut text, &mut code, 0, i64::MAX);
        text + "M02*\n"
    }

    fn draw(&self, text: &mut String, code: &mut u32, grown: i64, joins: i64) {
        let mm = |um: i64| format!("{}.{:03}", um / 1000, um % 1000);
        let at = |(x, y): (i64, i64)| format!("X{}Y{}", x * CELL * 1000, y * CELL * 1000);
        for (number, &(place, size, round)) in (1..).zip(&self.pads) {
            if number % joins == 0 {
                continue;
            }
            let (width, height) = (mm(size.0 + 2 * grown), mm(size.1 + 2 * grown));
            let shape =
                if round && size.0 == size.1 { format!("C,{width}") } else { format!("R,{width}X{height}") };
            let _ = writeln!(text, "%ADD{code}{shape}*%\nD{code}*\n{}D03*", at(place));
            *code += 1;
        }
        for (way, width) in &self.traces {
            let _ = writeln!(text, "%ADD{code}C,{}*%\nD{code}*\n{}D02*", mm(width + 2 * grown), at(way[0]));
            way[1..].iter().for_each(|&to| {
                let _ = writeln!(text, "{}D01*", at(to));
            });
            *code += 1;
        }
    }
}

/// The cells from one to another on its row or column, both included.
fn between(from: (i64, i64), to: (i64, i64)) -> Vec<(i64, i64)> {
    let steps = (to.0 - from.0).abs().max((to.1 - from.1).abs());
    let step = ((to.0 - from.0).signum(), (to.1 - from.1).signum());
    (0..=steps).map(|k| (from.0 + step.0 * k, from.1 + step.1 * k)).collect()
}
