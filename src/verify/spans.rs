//! Rows of pixels whose centres lie in shapes, as runs.

use std::ops::Range;

use crate::board::Shape;
use crate::grid::Grid;

use super::pieces::Run;
use super::ruling::Ruling;

/// Runs of pixels in some rows of a grid.
pub(super) struct Spans {
    ruling: Ruling,
    pitch: f64,
    width: u32,
    first: u32,
    rows: Vec<Row>,
    /// How many shapes were added.
    added: u32,
    full: Full,
}

/// Where shapes of one label have covered all rows: others of that label add nothing there.
#[derive(Default)]
struct Full {
    label: u32,
    /// By words of 64 columns; none where no word is full.
    words: Vec<bool>,
}

/// After so many shapes it is looked where rows are full. Chosen: looking takes as long as adding a
/// few.
const LOOK: u32 = 256;

impl Spans {
    /// Nothing yet, in `rows` of `grid`.
    pub(super) fn new(grid: &Grid, rows: Range<u32>) -> Self {
        Self {
            ruling: Ruling::rows(grid),
            pitch: grid.pitch().to_f64(),
            width: grid.width(),
            first: rows.start,
            rows: rows.map(|_| Row::default()).collect(),
            added: 0,
            full: Full::default(),
        }
    }

    /// Adds the pixels of a shape.
    pub(super) fn add(&mut self, shape: &Shape, label: u32) {
        let lines =
            i64::from(self.first)..i64::from(self.first) + i64::try_from(self.rows.len()).unwrap_or(0);
        self.added += 1;
        if self.added.is_multiple_of(LOOK) {
            self.full = self.full();
        }
        if self.full.label == label && !self.full.words.is_empty() && self.is_full(shape, lines.clone()) {
            return;
        }
        let Self { ruling, pitch, width, rows, .. } = self;
        ruling.rule(shape, lines.clone(), &mut |line, from, to| {
            let row = usize::try_from(line - lines.start).expect("one of these lines");
            if let Some(run) = run(from / *pitch, to / *pitch, *width) {
                rows[row].add(Run { label, ..run }, *width);
            }
        });
    }

    /// Where all rows are full.
    fn full(&self) -> Full {
        let crowd = |row: &Row| row.crowd.as_ref().map(|crowd| crowd.label);
        let Some(label) = self.rows.first().and_then(crowd) else { return Full::default() };
        if self.rows.iter().any(|row| crowd(row) != Some(label)) {
            return Full::default();
        }
        let count = (self.width as usize).div_ceil(64);
        let whole = |word: usize| match word + 1 == count {
            true => u64::MAX >> (63 - (self.width - 1) % 64),
            false => u64::MAX,
        };
        let is_full = |word: usize| {
            self.rows
                .iter()
                .filter_map(|row| row.crowd.as_ref())
                .all(|crowd| crowd.words[word] == whole(word))
        };
        let words: Vec<bool> = (0..count).map(is_full).collect();
        if words.contains(&true) { Full { label, words } } else { Full::default() }
    }

    /// Whether all pixels that a shape may have in these rows are full.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the row")]
    fn is_full(&self, shape: &Shape, lines: Range<i64>) -> bool {
        let Some((from, to)) = self.ruling.reach(shape, lines) else { return false };
        let last = f64::from(self.width - 1);
        let word = |at: f64| (at / self.pitch).clamp(0.0, last) as usize / 64;
        self.full.words[word(from)..=word(to)].iter().all(|&full| full)
    }

    /// Adds all pixels.
    pub(super) fn fill(&mut self, label: u32) {
        let whole = Run { start: 0, end: self.width, label };
        self.rows.iter_mut().for_each(|row| row.add(whole, whole.end));
    }

    /// Row by row, runs that share no pixel: see [`apart`].
    pub(super) fn into_rows(self) -> impl Iterator<Item = Vec<Run>> {
        self.rows.into_iter().map(Row::into_runs)
    }
}

/// A row of pixels. Where cuts of one label cross by the thousand few runs are left of them: bits
/// hold what they cover without being sorted. Measured with 10⁴ chords over a board: a quarter less
/// time in a debug build, in a release build none.
#[derive(Default)]
struct Row {
    runs: Vec<Run>,
    crowd: Option<Crowd>,
}

/// Runs in a row that are held side by side. Chosen: several times what the densest board has.
const ROOM: usize = 512;

/// The pixels of one label in a row, a bit each.
struct Crowd {
    label: u32,
    words: Vec<u64>,
}

impl Row {
    fn add(&mut self, run: Run, width: u32) {
        match &mut self.crowd {
            Some(crowd) if crowd.label == run.label => crowd.add(run),
            _ => self.runs.push(run),
        }
        // Which of several labels keeps a pixel is only known when all runs are.
        let is_full = self.crowd.is_none() && self.runs.len() == ROOM;
        if is_full && self.runs.iter().all(|run| run.label == self.runs[0].label) {
            let words = vec![0; (width as usize).div_ceil(64)];
            let mut crowd = Crowd { label: run.label, words };
            self.runs.drain(..).for_each(|run| crowd.add(run));
            self.crowd = Some(crowd);
        }
    }

    fn into_runs(mut self) -> Vec<Run> {
        if let Some(crowd) = self.crowd {
            crowd.add_to(&mut self.runs);
        }
        apart(self.runs)
    }
}

impl Crowd {
    fn add(&mut self, run: Run) {
        let (first, last) = ((run.start / 64) as usize, ((run.end - 1) / 64) as usize);
        let (from, to) = (u64::MAX << (run.start % 64), u64::MAX >> (63 - (run.end - 1) % 64));
        if first == last {
            self.words[first] |= from & to;
            return;
        }
        self.words[first] |= from;
        self.words[first + 1..last].fill(u64::MAX);
        self.words[last] |= to;
    }

    /// Appends its runs, as long as they are.
    fn add_to(&self, runs: &mut Vec<Run>) {
        let mut start = None;
        for (word, at) in self.words.iter().zip((0..).step_by(64)) {
            let mut bit = 0;
            while bit < 64 {
                let rest = word >> bit;
                match start {
                    None if rest == 0 => break,
                    None => {
                        bit += rest.trailing_zeros();
                        start = Some(at + bit);
                    }
                    Some(from) => {
                        bit += rest.trailing_ones();
                        if bit < 64 {
                            runs.push(Run { start: from, end: at + bit, label: self.label });
                            start = None;
                        }
                    }
                }
            }
        }
        if let Some(from) = start {
            let end = u32::try_from(self.words.len()).expect("as many as pixels") * 64;
            runs.push(Run { start: from, end, label: self.label });
        }
    }
}

/// The pixels of a row whose centres lie within a stretch of it; both in pixels.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the row")]
fn run(from: f64, to: f64, width: u32) -> Option<Run> {
    let column = |at: f64| at.clamp(0.0, f64::from(width)) as u32;
    let (start, end) = (column((from - 0.5).ceil()), column((to - 0.5).floor() + 1.0));
    (start < end).then_some(Run { start, end, label: 0 })
}

/// Runs from left to right that share no pixel: those of one label that touch as one; where labels
/// overlap, the one that began first keeps the pixels.
fn apart(mut runs: Vec<Run>) -> Vec<Run> {
    runs.sort_unstable_by_key(|run| (run.start, run.label, run.end));
    let mut apart: Vec<Run> = Vec::with_capacity(runs.len());
    for run in runs {
        match apart.last_mut() {
            Some(last) if last.end >= run.end => {}
            Some(last) if last.end >= run.start && last.label == run.label => last.end = run.end,
            Some(&mut last) => apart.push(Run { start: run.start.max(last.end), ..run }),
            None => apart.push(run),
        }
    }
    apart
}

/// The same with what lies between them under `label`, in a row so wide.
pub(super) fn filled(runs: &[Run], label: u32, width: u32) -> Vec<Run> {
    let mut filled = Vec::with_capacity(runs.len() * 2 + 1);
    let mut at = 0;
    for &run in runs {
        if at < run.start {
            filled.push(Run { start: at, end: run.start, label });
        }
        filled.push(run);
        at = run.end;
    }
    if at < width {
        filled.push(Run { start: at, end: width, label });
    }
    filled
}

/// What `holes` leave of runs; both from left to right.
pub(super) fn less(runs: &[Run], holes: &[Run]) -> Vec<Run> {
    let mut left = Vec::with_capacity(runs.len() + holes.len());
    let mut first = 0;
    for &run in runs {
        while holes.get(first).is_some_and(|hole| hole.end <= run.start) {
            first += 1;
        }
        let mut at = run.start;
        for hole in holes[first..].iter().take_while(|hole| hole.start < run.end) {
            if at < hole.start {
                left.push(Run { start: at, end: hole.start, ..run });
            }
            at = hole.end;
        }
        if at < run.end {
            left.push(Run { start: at, ..run });
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Arc, Nm, Point, Polygon, Rect, Turn};

    fn at(x: i64, y: i64) -> Point {
        Point::new(Nm::from_um(x), Nm::from_um(y))
    }

    /// A picture of a shape as text, 16 by 8 pixels of 100 µm.
    fn drawn(shape: &Shape) -> String {
        let grid = Grid::covering(Rect::new(at(0, 0), at(1600, 800)), Nm::from_um(100)).expect("small");
        let mut spans = Spans::new(&grid, 0..grid.height());
        spans.add(shape, 1);
        let row = |runs: Vec<Run>| {
            let inside = |column: u32| runs.iter().any(|run| (run.start..run.end).contains(&column));
            (0..grid.width()).map(|column| if inside(column) { '#' } else { '.' }).collect::<String>()
        };
        spans.into_rows().map(row).collect::<Vec<_>>().join("\n")
    }

    /// The same, pixel by pixel, by the distances of their centres.
    fn expected(holds: impl Fn(f64, f64) -> bool) -> String {
        let row = |row: u32| {
            let inside =
                |column: u32| holds(f64::from(column) * 100.0 + 50.0, 750.0 - f64::from(row) * 100.0);
            (0..16).map(|column| if inside(column) { '#' } else { '.' }).collect::<String>()
        };
        (0..8).map(row).collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn a_stroke_holds_what_is_near_its_way() {
        let radius = Nm::from_um(170);
        let stroke = Shape::Stroke { from: at(300, 210), to: at(1250, 560), radius };
        let near = |x: f64, y: f64| {
            let share = ((x - 300.0) * 950.0 + (y - 210.0) * 350.0) / (950.0 * 950.0 + 350.0 * 350.0);
            let share = share.clamp(0.0, 1.0);
            let (dx, dy) = (x - 300.0 - 950.0 * share, y - 210.0 - 350.0 * share);
            dx * dx + dy * dy < 170.0 * 170.0
        };
        assert_eq!(drawn(&stroke), expected(near), "a slanting stroke");
    }

    #[test]
    fn an_arc_holds_what_is_near_it_whichever_way_it_turns() {
        let (radius, center) = (Nm::from_um(110), at(800, 300));
        let (start, end) = (at(1200, 300), at(400, 300));
        let on = |x: f64, y: f64, above: bool| {
            let (dx, dy) = (x - 800.0, y - 300.0);
            let ring = ((dx * dx + dy * dy).sqrt() - 400.0).abs() < 110.0 && (dy > 0.0) == above;
            let cap = |x0: f64| (x - x0) * (x - x0) + dy * dy < 110.0 * 110.0;
            ring || cap(400.0) || cap(1200.0)
        };
        for (turn, above) in [(Turn::CounterClockwise, true), (Turn::Clockwise, false)] {
            let arc = Arc { start, end, center, turn };
            assert_eq!(drawn(&Shape::Arc { arc, radius }), expected(|x, y| on(x, y, above)), "{turn:?}");
        }
        let three_quarters = Arc { start, end: at(800, 700), center, turn: Turn::Clockwise };
        let near = |x: f64, y: f64| {
            let (dx, dy) = (x - 800.0, y - 300.0);
            let ring = ((dx * dx + dy * dy).sqrt() - 400.0).abs() < 110.0 && !(dx > 0.0 && dy > 0.0);
            let cap = |x0: f64, y0: f64| (x - x0) * (x - x0) + (y - y0) * (y - y0) < 110.0 * 110.0;
            ring || cap(1200.0, 300.0) || cap(800.0, 700.0)
        };
        assert_eq!(drawn(&Shape::Arc { arc: three_quarters, radius }), expected(near), "three quarters");
    }

    #[test]
    fn a_polygon_holds_what_it_winds_round() {
        let ring = |low: i64, high: i64| vec![at(low, 100), at(high, 100), at(high, 700), at(low, 700)];
        let mut hole = ring(500, 900);
        hole.reverse();
        let polygon = Polygon::new(vec![ring(100, 1400), hole]).expect("a ring");
        let row = ".####....#####..";
        let rows = [vec!["................"], vec![row; 6], vec!["................"]].concat();
        assert_eq!(drawn(&Shape::Polygon(polygon)), rows.join("\n"), "a frame");
    }

    #[test]
    fn runs_are_parted_filled_and_taken_away() {
        let run = |(start, end, label): (u32, u32, u32)| Run { start, end, label };
        let told =
            |runs: Vec<Run>| runs.iter().map(|run| (run.start, run.end, run.label)).collect::<Vec<_>>();
        let runs = apart([(7, 9, 5), (0, 4, 5), (2, 6, 5), (5, 8, 6)].map(run).to_vec());
        assert_eq!(told(runs.clone()), [(0, 6, 5), (6, 8, 6), (8, 9, 5)], "the first keeps its pixels");
        assert_eq!(told(filled(&runs[..1], 0, 8)), [(0, 6, 5), (6, 8, 0)], "the rest of the row");
        let holes = [(1, 2, 1), (5, 7, 1)].map(run);
        let left = less(&runs, &holes);
        assert_eq!(told(left), [(0, 1, 5), (2, 5, 5), (7, 8, 6), (8, 9, 5)], "with holes in them");
    }

    #[test]
    fn what_full_rows_hide_is_not_missed() {
        let mut seed = 9_u32;
        let mut chance = |most: u32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            i64::from((seed >> 8) % most)
        };
        let grid = Grid::covering(Rect::new(at(0, 0), at(20_000, 3_000)), Nm::from_um(50)).expect("small");
        let rows = 10..40;
        let (mut spans, mut single) = (Spans::new(&grid, rows.clone()), Vec::new());
        for _ in 0..6_000 {
            // All but the last fifth of the rows fill up.
            let mut end = || at(chance(16_000), chance(3_000));
            let stroke = Shape::Stroke { from: end(), to: end(), radius: Nm::from_um(70) };
            spans.add(&stroke, 4);
            let mut alone = Spans::new(&grid, rows.clone());
            alone.add(&stroke, 4);
            single.push(alone);
        }
        assert!(spans.full.words.iter().filter(|full| **full).count() >= 3, "some words are full");
        let far = Shape::Stroke { from: at(9_000, 1_500), to: at(19_900, 1_500), radius: Nm::from_um(70) };
        spans.add(&far, 4);
        let told = |runs: &[Run]| runs.iter().map(|run| (run.start, run.end)).collect::<Vec<_>>();
        let mut all: Vec<Vec<Run>> = vec![Vec::new(); rows.len()];
        let mut alone = Spans::new(&grid, rows.clone());
        alone.add(&far, 4);
        single.push(alone);
        for alone in single {
            all.iter_mut().zip(alone.into_rows()).for_each(|(all, runs)| all.extend(runs));
        }
        for (row, (full, all)) in spans.into_rows().zip(all).enumerate() {
            assert_eq!(told(&full), told(&apart(all)), "row {row}");
        }
    }

    #[test]
    fn thousands_of_runs_are_what_few_are() {
        let mut seed = 5_u32;
        let mut chance = |most: u32| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) % most
        };
        for width in [1, 63, 64, 65, 128, 1_000] {
            let runs: Vec<Run> = (0..ROOM * 2)
                .map(|_| {
                    let start = chance(width);
                    let end = (start + 1 + chance(3) * chance(70)).min(width);
                    Run { start, end, label: 7 }
                })
                .filter(|run| run.start % 100 < 90 && run.end % 100 < 90)
                .collect();
            let mut row = Row::default();
            runs.iter().for_each(|&run| row.add(run, width));
            let told =
                |runs: Vec<Run>| runs.iter().map(|run| (run.start, run.end, run.label)).collect::<Vec<_>>();
            assert_eq!(told(row.into_runs()), told(apart(runs)), "a row of {width}");
        }
    }
}
