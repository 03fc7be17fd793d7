//! Rewrites a program so that its cuts follow a height map, whoever wrote it.
//!
//! Only the z of cutting moves changes; all else stays as it was, so that a diff shows nothing but
//! that.

use std::fmt::Write as _;

use super::words::{Word, words};
use crate::gcode::read::{Counting, Listing, Motion, Place, Way, lines, read, without_unlevelled};
use crate::geometry::{Arc, Nm, Point, Turn};

use super::course::Course;
use super::digit::{decimals, digit};
use super::error::LevelError;
use super::height_map::HeightMap;

/// How a program is levelled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Levelling {
    /// How far the tool may leave its depth below the surface between the points where the program
    /// is split.
    pub tolerance: Nm,
    /// How far outside the touched area the program may cut; the surface is taken to go on level
    /// there.
    pub margin: Nm,
    /// The height from which on nothing is levelled; none for the height of the program's lowest
    /// level rapid.
    pub safe: Option<Nm>,
    /// What the program says of it, in a comment before its first word. One that begins with
    /// [`MARK`] keeps the program from being levelled a second time.
    pub note: String,
}

/// How the comment of a levelled program begins.
pub const MARK: &str = "levelled by voromill";

/// 5 µm is a twentieth of a common depth; 2 mm is where a cutter goes that cuts the board out. Both
/// chosen.
impl Default for Levelling {
    fn default() -> Self {
        Self { tolerance: Nm::from_um(5), margin: Nm::from_mm(2), safe: None, note: String::new() }
    }
}

/// A levelled program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Levelled {
    /// The program.
    pub text: String,
    /// The height from which on it is as it was.
    pub safe: Nm,
    /// How many motions go below that.
    pub levelled: usize,
    /// How many lines were added to split them.
    pub added: usize,
    /// The lowest and highest surface below them; none where nothing goes below the safe height.
    pub heights: Option<[Nm; 2]>,
}

/// Levels a program to the surface of `map`. The user's own G-code and the touch of a tool within
/// one of ours stay as they are: what follows them says anew what is in force and where it goes.
///
/// # Errors
///
/// [`LevelError`] for a program that cannot be followed or has no motion, that is levelled already
/// by a comment with [`MARK`], that cuts outside the touched area, that goes down before it says
/// where, or that travels lower than the surface is high.
pub fn level(text: &str, map: &HeightMap, levelling: &Levelling) -> Result<Levelled, LevelError> {
    if let Some(at) = lines(text).position(is_mark) {
        return Err(LevelError::Levelled { line: at + 1 });
    }
    let ours = without_unlevelled(text);
    let listing = read(&ours)?;
    if let Some((line, what)) = listing.indirect {
        return Err(LevelError::Indirect { line, what });
    }
    if listing.motions.is_empty() {
        return Err(LevelError::NoMotion);
    }
    let safe = levelling.safe.unwrap_or_else(|| travel(&listing));
    let [_, (place, height)] = map.extremes();
    if height >= safe {
        return Err(LevelError::High { height, x: place.x, y: place.y, safe });
    }
    let mut leveller = Leveller::new(map, levelling, safe);
    let mut motions = listing.motions.chunk_by(|a, b| a.line == b.line).peekable();
    let mut countings = listing.countings.iter().peekable();
    for ((number, source), ours) in (1_u32..).zip(lines(text)).zip(lines(&ours)) {
        let own = motions.next_if(|own| own[0].line == number).unwrap_or_default();
        if listing.end.is_some_and(|end| number > end) || ours != source {
            leveller.lines.push(source.to_owned());
        } else {
            if let Some((_, counting)) = countings.next_if(|(line, _)| *line == number) {
                leveller.counting = *counting;
            }
            leveller.line(Line { number, source }, own)?;
        }
    }
    let end = if text.contains("\r\n") { "\r\n" } else { "\n" };
    let mut out = leveller.lines.join(end);
    if text.ends_with('\n') {
        out.push_str(end);
    }
    Ok(Levelled { text: out, safe, ..leveller.done })
}

/// Whether a program says that it is levelled.
#[must_use]
pub fn is_levelled(text: &str) -> bool {
    lines(text).any(is_mark)
}

/// Whether a line is the comment of a levelled program.
fn is_mark(line: &str) -> bool {
    line.trim_start().strip_prefix(['(', ';']).is_some_and(|comment| comment.trim_start().starts_with(MARK))
}

/// Whether a motion goes round a centre.
const fn is_arc(motion: &Motion) -> bool {
    matches!(motion.way, Way::Arc { .. })
}

/// The height of the lowest level rapid, or where there is none the highest z.
fn travel(listing: &Listing) -> Nm {
    let level = |motion: &Motion| {
        let sideways = motion.from.point() != motion.to.point() && motion.from.z == motion.to.z;
        motion.to.z.filter(|&z| sideways && motion.way == Way::Rapid && z > Nm::ZERO)
    };
    let highest = || listing.motions.iter().filter_map(|motion| motion.to.z).max();
    listing.motions.iter().filter_map(level).min().or_else(highest).unwrap_or(Nm::ZERO)
}

/// A line of the program.
#[derive(Clone, Copy)]
struct Line<'a> {
    /// From 1.
    number: u32,
    source: &'a str,
}

struct Leveller<'a> {
    map: &'a HeightMap,
    slope: f64,
    levelling: &'a Levelling,
    safe: Nm,
    /// As the reader has it.
    counting: Counting,
    /// Where the levelled program is; in x and y, at the end of a line, where the program is.
    at: Place,
    /// Z and R of the last drilling cycle.
    cycle: Option<(Nm, Nm)>,
    noted: bool,
    lines: Vec<String>,
    done: Levelled,
}

impl<'a> Leveller<'a> {
    fn new(map: &'a HeightMap, levelling: &'a Levelling, safe: Nm) -> Self {
        let done = Levelled { text: String::new(), safe, levelled: 0, added: 0, heights: None };
        Self {
            map,
            slope: map.slope(),
            levelling,
            safe,
            counting: Counting::default(),
            at: Place::default(),
            cycle: None,
            noted: levelling.note.is_empty(),
            lines: Vec::new(),
            done,
        }
    }

    fn line(&mut self, line: Line<'_>, motions: &[Motion]) -> Result<(), LevelError> {
        if motions.is_empty() && self.noted {
            self.lines.push(line.source.to_owned());
            return Ok(());
        }
        let words = words(line.number, line.source)?;
        self.note(&words);
        match motions {
            [] => self.lines.push(line.source.to_owned()),
            [_] => self.motion(line, &words, motions)?,
            turns if turns.iter().all(is_arc) => self.motion(line, &words, turns)?,
            cycle if self.counting.cycle => self.drill(line, &words, cycle)?,
            _ => {
                let what = "several motions of one line that are no drilling cycle";
                return Err(LevelError::Indirect { line: line.number, what });
            }
        }
        let summed = words.iter().any(|word| word.letter == '*');
        if summed && self.lines.last().is_some_and(|made| made != line.source) {
            let what = "a checksum, which would be wrong once its line changes";
            return Err(LevelError::Indirect { line: line.number, what });
        }
        Ok(())
    }

    /// The comment, once, in the form of the comments before it.
    fn note(&mut self, words: &[Word<'_>]) {
        if !self.noted && !words.is_empty() {
            self.noted = true;
            let semicolons = self.lines.iter().any(|line| line.trim_start().starts_with(';'));
            let note = &self.levelling.note;
            self.lines.push(if semicolons { format!("; {note}") } else { format!("({note})") });
        }
    }

    /// One motion, or the turns of an arc that goes round several times (P).
    fn motion(&mut self, line: Line<'_>, words: &[Word<'_>], motions: &[Motion]) -> Result<(), LevelError> {
        let mut ends = Vec::with_capacity(motions.len());
        for motion in motions {
            ends.extend(self.ends(motion)?);
        }
        let (first, last) = (motions[0], motions[motions.len() - 1]);
        let motion = &Motion { to: last.to, ..first };
        if ends.len() == motions.len() && self.rise_alike(motions, &ends) {
            ends.drain(..ends.len() - 1);
        }
        if let [end] = ends.as_slice() {
            let z = end.z;
            let value = z.filter(|_| z != motion.to.z || self.at.z != motion.from.z);
            let changed = value.and_then(|value| self.change(words, 'Z', value, self.at.z));
            self.lines
                .push(changed.map_or_else(|| line.source.to_owned(), |change| change.made(line.source)));
        } else {
            self.pieces(line.source, words, motion, &ends);
        }
        self.at = Place { z: ends.last().and_then(|end| end.z), ..motion.to };
        Ok(())
    }

    /// Whether these motions, each unsplit, are as much higher at all their ends as where they
    /// begin: then they stay one line. Rounding counts for nothing.
    fn rise_alike(&self, motions: &[Motion], ends: &[Place]) -> bool {
        let rise = |before: Place, after: Place| before.z.zip(after.z).map(|(before, after)| after - before);
        let first = rise(motions[0].from, self.at);
        let alike = |rise: Option<Nm>| match first.zip(rise) {
            Some((first, rise)) => (rise - first).abs().get() <= digit(self.counting.unit),
            None => first == rise,
        };
        motions.iter().zip(ends).all(|(motion, end)| alike(rise(motion.to, *end)))
    }

    /// Where the pieces of a motion end, levelled; one alone where it need not be split.
    fn ends(&mut self, motion: &Motion) -> Result<Vec<Place>, LevelError> {
        let (from, to) = (motion.from, motion.to);
        if !self.is_low(from.z) && !self.is_low(to.z) {
            return Ok(vec![to]);
        }
        let nowhere = || LevelError::Nowhere { line: motion.line, safe: self.safe };
        let end = to.point().ok_or_else(nowhere)?;
        let course = match (motion.way, from.point()) {
            (Way::Arc { center, turn }, Some(start)) => Course::Arc(Arc { start, end, center, turn }),
            (_, start) => Course::Line { from: start.unwrap_or(end), to: end },
        };
        self.stay_inside(&course, motion.line)?;
        self.done.levelled += 1;
        let below = from.z.or(to.z).unwrap_or(Nm::ZERO);
        let rise = to.z.map_or(0.0, |z| (z - below).to_f64());
        let splits = course.splits(self.map, self.slope, self.levelling.tolerance);
        let last = splits.len() - 1;
        let mut ends = Vec::with_capacity(splits.len());
        for (index, fraction) in splits.into_iter().enumerate() {
            let (point, z) = if index == last {
                (end, to.z)
            } else {
                let (x, y) = course.at(fraction);
                (self.snapped(Point::from_f64(x, y)), Some(below + Nm::from_f64(rise * fraction)))
            };
            ends.push(Place { x: Some(point.x), y: Some(point.y), z: z.map(|z| self.levelled(point, z)) });
        }
        Ok(ends)
    }

    fn is_low(&self, z: Option<Nm>) -> bool {
        z.is_some_and(|z| z < self.safe)
    }

    /// The height that z below the safe height becomes over a point.
    fn levelled(&mut self, point: Point, z: Nm) -> Nm {
        if z >= self.safe {
            return z;
        }
        let height = self.map.over(point);
        let [low, high] = self.done.heights.unwrap_or([height; 2]);
        self.done.heights = Some([low.min(height), high.max(height)]);
        if height == Nm::ZERO { z } else { self.round(z + height) }
    }

    fn stay_inside(&self, course: &Course, line: u32) -> Result<(), LevelError> {
        let (area, margin) = (self.map.area(), self.levelling.margin);
        let (bounds, room) = (course.bounds(), area.inflate(margin));
        match [bounds.min(), bounds.max()].into_iter().find(|&corner| !room.contains(corner)) {
            Some(corner) => Err(LevelError::outside(line, corner, area, margin)),
            None => Ok(()),
        }
    }

    /// The lines of a motion that is split: the first is the old one with other coordinates, the
    /// rest are new.
    fn pieces(&mut self, source: &str, words: &[Word<'_>], motion: &Motion, ends: &[Place]) {
        let stops = |word: &&Word<'_>| {
            word.letter == 'M' && matches!(word.number.times(1), Some(0 | 1 | 2 | 30 | 60))
        };
        let stop: String = words.iter().filter(stops).map(|word| format!(" {}", word.text)).collect();
        let skip = if source.trim_start().starts_with('/') { "/" } else { "" };
        let (word, center) = match motion.way {
            Way::Rapid => ("G0", None),
            Way::Feed => ("G1", None),
            Way::Arc { center, turn: Turn::Clockwise } => ("G2", Some(center)),
            Way::Arc { center, turn: Turn::CounterClockwise } => ("G3", Some(center)),
        };
        self.at = Place { z: self.at.z, ..motion.from };
        for (index, &end) in ends.iter().enumerate() {
            let coordinates = self.coordinates(end, center);
            self.lines.push(if index == 0 {
                // The P of an arc is how often it goes round, and each piece does so once.
                let moving = |word: &&Word<'_>| match word.letter {
                    'X' | 'Y' | 'Z' | 'I' | 'J' | 'R' => true,
                    letter => letter == 'P' && center.is_some(),
                };
                let gone = words.iter().filter(|word| moving(word) || stops(word));
                without(source, gone, coordinates.trim_start())
            } else if index + 1 == ends.len() {
                format!("{skip}{word}{coordinates}{stop}")
            } else {
                format!("{skip}{word}{coordinates}")
            });
            self.at = end;
        }
        self.done.added += ends.len() - 1;
    }

    /// The words that lead to `end`, each after a blank.
    fn coordinates(&self, end: Place, center: Option<Point>) -> String {
        let mut text = String::new();
        for (letter, to, at) in [('X', end.x, self.at.x), ('Y', end.y, self.at.y), ('Z', end.z, self.at.z)] {
            if let Some(to) = to.filter(|_| to != at || (center.is_some() && letter != 'Z')) {
                _ = write!(text, " {letter}{}", self.number(self.counted(to, at)));
            }
        }
        if let (Some(center), Some(at)) = (center, self.at.point()) {
            let from = if self.counting.absolute_centers { Point::default() } else { at };
            _ = write!(text, " I{} J{}", self.number(center.x - from.x), self.number(center.y - from.y));
        }
        text
    }

    /// A drilling cycle: its bottom and its R follow the surface over the hole.
    fn drill(&mut self, line: Line<'_>, words: &[Word<'_>], motions: &[Motion]) -> Result<(), LevelError> {
        let last = motions[motions.len() - 1].to;
        let nowhere = LevelError::Nowhere { line: line.number, safe: self.safe };
        let hole = last.point().ok_or(nowhere)?;
        let feed = motions.iter().find(|motion| motion.way == Way::Feed);
        let retract = feed.and_then(|motion| motion.from.z);
        let bottom = motions.iter().filter_map(|motion| motion.to.z).min();
        let (Some(retract), Some(bottom)) = (retract.or(bottom), bottom) else {
            self.lines.push(line.source.to_owned());
            return Ok(());
        };
        let mut given = (bottom, retract);
        if self.is_low(Some(bottom)) {
            self.stay_inside(&Course::Line { from: hole, to: hole }, line.number)?;
            self.done.levelled += 1;
            given = (self.levelled(hole, bottom), self.levelled(hole, retract));
        }
        let mut text = line.source.to_owned();
        let (bottom_before, retract_before) = self.cycle.unzip();
        let z = self.change(words, 'Z', given.0, bottom_before);
        let r = self.change(words, 'R', given.1, retract_before);
        let mut changes: Vec<Change> = z.into_iter().chain(r).collect();
        // From the last in the line to the first, so that the places of those before still hold.
        changes.sort_by_key(|change| std::cmp::Reverse(change.from));
        for change in changes {
            text = change.made(&text);
        }
        self.lines.push(text);
        self.cycle = Some(given);
        self.at = Place { z: if last.z == Some(retract) { Some(given.1) } else { last.z }, ..last };
        Ok(())
    }

    /// What makes a line lead to `value` on an axis that is at `at`; none where it does already.
    fn change(&self, words: &[Word<'_>], letter: char, value: Nm, at: Option<Nm>) -> Option<Change> {
        let counted = self.counted(value, at);
        let text = format!("{letter}{}", self.number(counted));
        match words.iter().find(|word| word.letter == letter) {
            Some(word) => {
                let written = word.number.times(self.counting.unit).map(Nm::new);
                let from = word.from;
                (written != Some(counted)).then(|| Change { from, to: from + word.text.len(), text })
            }
            None if at == Some(value) => None,
            None => {
                let after = words.iter().rfind(|word| matches!(word.letter, 'X' | 'Y' | 'Z'));
                let after = after.or(words.last())?;
                let from = after.from + after.text.len();
                Some(Change { from, to: from, text: format!(" {text}") })
            }
        }
    }

    /// A coordinate as the program counts: from zero, or from where it is.
    fn counted(&self, value: Nm, at: Option<Nm>) -> Nm {
        if self.counting.incremental && !self.counting.cycle { value - at.unwrap_or(Nm::ZERO) } else { value }
    }

    fn snapped(&self, p: Point) -> Point {
        Point::new(self.round(p.x), self.round(p.y))
    }

    /// To the last decimal that is written.
    fn round(&self, length: Nm) -> Nm {
        let digit = digit(self.counting.unit);
        Nm::new((length.get() + digit / 2).div_euclid(digit) * digit)
    }

    /// In the program's unit, without zeros that say nothing.
    fn number(&self, length: Nm) -> String {
        let decimals = decimals(self.counting.unit);
        let digits = self.round(length).get() / digit(self.counting.unit);
        let scale = 10_i64.pow(if decimals == 4 { 4 } else { 5 });
        let sign = if digits < 0 { "-" } else { "" };
        let text = format!("{sign}{}.{:0decimals$}", digits.abs() / scale, digits.abs() % scale);
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    }
}

/// A part of a line that becomes another.
struct Change {
    from: usize,
    to: usize,
    text: String,
}

impl Change {
    fn made(&self, line: &str) -> String {
        format!("{}{}{}", &line[..self.from], self.text, &line[self.to..])
    }
}

/// A line without some of its words, and `text` where the first of them was.
fn without<'a>(line: &str, gone: impl Iterator<Item = &'a Word<'a>>, text: &str) -> String {
    let (mut out, mut at, mut placed) = (String::new(), 0, false);
    for word in gone {
        let from = word.from;
        out.push_str(&line[at..from]);
        if !placed {
            out.push_str(text);
            placed = true;
        }
        at = from + word.text.len();
        // Words leave no blanks behind.
        at += line[at..].len() - line[at..].trim_start_matches(' ').len();
        if placed && line[at..].starts_with(|c: char| !c.is_whitespace()) && !out.ends_with(' ') {
            out.push(' ');
        }
    }
    out.push_str(&line[at..]);
    out.trim_end().to_owned()
}
