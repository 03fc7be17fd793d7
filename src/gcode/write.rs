//! Toolpath → text.
//!
//! Coordinates are rounded here, once, to the dialect's last digit, and everything is decided on
//! the rounded figures: what has not moved is not written, and an arc that rounding would turn into
//! another (a short one whose end slips behind its start would become a full circle) is written as
//! lines. A full circle is written in two halves, as controllers differ in what an arc is that ends
//! where it begins: all round, nothing, or an error; what is opposite is so to the last digit.

use std::fmt::Write as _;

use crate::geometry::{Arc, Nm, Point, Turn};
use crate::toolpath::{Feed, Move, Position, Program, Section, Tool};

use super::dialect::{
    ArcCheck, Arcs, Blend, Comments, Dialect, Dwell, LineNumbers, Messages, OwnCode, Rapids, ToolChange,
    TouchOff,
};
use super::header::{Header, brief, highest, named};

/// The whole program as text, every line ended.
///
/// It retracts first, has the spindle up to speed before each plunge, and ends retracted with the
/// spindle off.
///
/// # Panics
///
/// For a section whose first move that goes anywhere is an arc, which [`Section`] rules out.
#[must_use]
pub fn write(program: &Program, dialect: &Dialect, header: &Header) -> String {
    let mut writer = Writer::new(dialect);
    writer.begin(program, header);
    let mut before = None;
    for section in &program.sections {
        writer.section(program, section, before);
        before = Some(&section.tool);
    }
    writer.finish(program);
    // It is kept while it is verified.
    writer.text.shrink_to_fit();
    writer.text
}

/// A position in whole units of the last digit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Rounded {
    x: i64,
    y: i64,
    z: i64,
}

pub(super) struct Writer<'a> {
    dialect: &'a Dialect,
    pub(super) text: String,
    /// One unit of the last digit, in nanometres.
    unit: i64,
    line: u32,
    at: Option<Rounded>,
    /// How high the tool is, which is known before the place is.
    height: Option<i64>,
    /// Where the plan is: what the rounded position stands for.
    planned: Option<Position>,
    /// The feed in force; none where the controller may have another, or lost it.
    feed: Option<Feed>,
    /// Whether a rapid has said its speed.
    fed: bool,
}

impl<'a> Writer<'a> {
    pub(super) fn new(dialect: &'a Dialect) -> Self {
        let unit = 10_i64.pow(u32::try_from(6_usize.saturating_sub(dialect.decimals)).unwrap_or(0));
        Self {
            dialect,
            text: String::new(),
            unit,
            line: 0,
            at: None,
            height: None,
            planned: None,
            feed: None,
            fed: false,
        }
    }

    /// Header, start lines, and the first retract: as high as the program goes anywhere, since
    /// nobody knows where the machine stands.
    pub(super) fn begin(&mut self, program: &Program, header: &Header) {
        for line in brief(program, self.dialect, header).iter().chain(&header.provenance()) {
            self.comment(line);
        }
        self.own(|own| &own.before);
        self.modes();
        self.retract(highest(program));
    }

    /// What numbers and words mean from here on.
    fn modes(&mut self) {
        for line in self.dialect.start.iter() {
            self.line(line);
        }
        if let Some(Blend::Within(most)) = self.dialect.blend {
            self.line(&format!("G64 P{}", most.to_string().trim_end_matches('0').trim_end_matches('.')));
        }
    }

    /// Lines of the user's own as they are, between comments that tell them from ours.
    fn own(&mut self, which: impl Fn(&OwnCode) -> &Vec<String>) {
        let lines = which(&self.dialect.own);
        if lines.is_empty() {
            return;
        }
        self.comment(OWN_BEGINS);
        for line in lines {
            self.text.push_str(line);
            self.end_line();
        }
        self.comment(OWN_ENDS);
    }

    /// The tool change and the spindle, unless the tool is in and turning, and the moves.
    fn section(&mut self, program: &Program, section: &Section, before: Option<&Tool>) {
        if before != Some(&section.tool) {
            if before.is_some() {
                self.stop();
            }
            self.comment(&section.label);
            let height = self.height.unwrap_or_default().max(self.round(program.safe));
            if before.is_some() {
                self.own(|own| &own.at_tool_change);
            }
            self.change(&section.tool, before.is_none());
            if before.is_some() && !self.dialect.own.at_tool_change.is_empty() {
                self.modes();
            }
            if before.is_some() || self.dialect.tool_change == ToolChange::M6 {
                // Whoever changes the tool may have moved the machine: the next place is written in
                // full.
                self.at = None;
                self.retract(Nm::new(height * self.unit));
            }
            if let Some(plate) = self.dialect.touch_off {
                self.touch_off(plate, height);
            }
            self.start(&section.tool);
        } else {
            self.comment(&section.label);
        }
        for step in &section.moves {
            self.step(step);
        }
    }

    /// The tool down to the plate, twice, the second time slowly; what it is high there is said; up
    /// again.
    fn touch_off(&mut self, plate: TouchOff, from: i64) {
        let Some(sets) = &self.dialect.sets_height else { return };
        let (x, y) = (self.round(plate.at.x), self.round(plate.at.y));
        let (top, reach) = (self.round(plate.height), self.round(SHORTER));
        self.comment(TOUCH_OFF_BEGINS);
        self.message("the tool touches the plate - the probe is on both");
        self.begin_line("G0");
        self.word('X', x);
        self.word('Y', y);
        self.rapid_feed(false);
        self.end_line();
        self.line("G91");
        self.line(&format!("G38.2 Z{} F{FAST}", self.number(top - reach - from)));
        self.begin_line("G0 Z1");
        self.rapid_feed(true);
        self.end_line();
        self.line(&format!("G38.2 Z-2 F{SLOW}"));
        self.line("G90");
        self.line(&format!("{sets} Z{}", self.number(top)));
        self.retract(Nm::new(from * self.unit));
        self.comment(TOUCH_OFF_ENDS);
        // What comes after says all anew, as after any lines that programs may be read without.
        (self.at, self.feed) = (None, None);
    }

    fn start(&mut self, tool: &Tool) {
        self.line(&format!("{} S{}", self.dialect.spindle, tool.spindle));
        if let Some((on, _)) = &self.dialect.coolant {
            self.line(on);
        }
        if self.dialect.spin_up > 0 {
            self.dwell(self.dialect.spin_up);
        }
    }

    /// The last retract, the spindle off, and the end lines.
    pub(super) fn finish(&mut self, program: &Program) {
        let safe = self.round(program.safe);
        if self.height.is_some_and(|height| height < safe) {
            self.retract(program.safe);
        }
        self.stop();
        self.own(|own| &own.after);
        for line in self.dialect.end.iter() {
            self.line(line);
        }
    }

    fn stop(&mut self) {
        if let Some((_, off)) = &self.dialect.coolant {
            self.line(off);
        }
        self.line("M5");
    }

    /// Up to the safe height, whatever the height is: after a tool change nobody knows.
    pub(super) fn retract(&mut self, safe: Nm) {
        let z = self.round(safe);
        self.begin_line("G0");
        self.word('Z', z);
        self.rapid_feed(true);
        self.end_line();
        self.height = Some(z);
        self.at = self.at.map(|at| Rounded { z, ..at });
        self.planned = self.planned.map(|at| Position { z: safe, ..at });
    }

    fn change(&mut self, tool: &Tool, first: bool) {
        let text = named(tool);
        match self.dialect.tool_change {
            ToolChange::M6 => {
                self.message(&text);
                self.line(&format!("T{} M6", tool.number));
            }
            ToolChange::Pause | ToolChange::PauseWithText | ToolChange::Files if first => {
                self.message(&format!("starts with {text}"))
            }
            // A program for files has one tool; with more it waits, as the safest.
            ToolChange::Pause | ToolChange::Files => {
                self.message(&format!("fit {text}"));
                self.line(&self.dialect.pause);
            }
            ToolChange::PauseWithText => self.line(&format!("M0 fit {}", plain(&text))),
        }
        self.feed = None;
    }

    fn dwell(&mut self, milliseconds: u32) {
        let seconds = format!("{}.{:03}", milliseconds / 1000, milliseconds % 1000);
        let seconds = seconds.trim_end_matches('0').trim_end_matches('.');
        self.line(&match self.dialect.dwell {
            Dwell::SecondsP => format!("G4 P{seconds}"),
            Dwell::SecondsS => format!("G4 S{seconds}"),
            Dwell::MillisecondsP => format!("G4 P{milliseconds}"),
        });
    }

    pub(super) fn step(&mut self, step: &Move) {
        match *step {
            Move::Dwell { milliseconds } => self.dwell(milliseconds),
            Move::Rapid { to } => self.straight("G0", to, None),
            Move::Feed { to, feed } => self.straight("G1", to, Some(feed)),
            Move::Arc { to, center, turn, feed } => self.arc(to, center, turn, feed),
        }
    }

    /// A line to `to`, unless that is where it is to the last digit.
    fn straight(&mut self, word: &str, to: Position, feed: Option<Feed>) {
        let rounded = self.position(to);
        self.planned = Some(to);
        if self.at == Some(rounded) {
            return;
        }
        if feed.is_none() && self.at.is_none() && self.height.is_some_and(|height| height > rounded.z) {
            // From the height at which the tool was changed: there first, and then down.
            let height = Nm::new(self.height.unwrap_or_default() * self.unit);
            self.straight(word, Position { z: height, ..to }, None);
        }
        self.begin_line(word);
        let at = self.at;
        self.coordinate('X', rounded.x, at.map(|at| at.x));
        self.coordinate('Y', rounded.y, at.map(|at| at.y));
        // Before the first level rapid only z is known, and it is the safe height.
        if at.is_some() || feed.is_some() {
            self.coordinate('Z', rounded.z, at.map(|at| at.z));
        }
        match feed {
            Some(feed) => self.feed_word(feed),
            None => self.rapid_feed(at.is_some_and(|at| (at.x, at.y) == (rounded.x, rounded.y))),
        }
        self.end_line();
        self.at = Some(rounded);
        self.height = Some(rounded.z);
    }

    /// The speed of a rapid, where it must be said; the cut that follows it then says its own
    /// again.
    fn rapid_feed(&mut self, is_vertical: bool) {
        let says = match self.dialect.rapids {
            Rapids::Unfed => false,
            Rapids::FirstFed => !self.fed,
            Rapids::Fed => {
                self.feed = None;
                true
            }
        };
        if says {
            self.fed = true;
            let [level, vertical] = self.dialect.rapid;
            // A feed that is for all rapids is the fast one: each axis goes no faster than it can.
            let straight = self.dialect.rapids == Rapids::Fed && is_vertical;
            _ = write!(self.text, " F{}", if straight { vertical } else { level }.number());
        }
    }

    fn arc(&mut self, to: Position, center: Point, turn: Turn, feed: Feed) {
        let from = self.planned.expect("an arc follows a move");
        let arc = Arc { start: from.point(), end: to.point(), center, turn };
        let ends = self.ends(&arc);
        let starts = std::iter::once(arc.start).chain(ends.iter().copied());
        let parts: Vec<Arc> = starts.zip(&ends).map(|(start, &end)| Arc { start, end, ..arc }).collect();
        if self.dialect.arcs == Arcs::Lines || !parts.iter().all(|part| self.survives_rounding(part)) {
            return self.chords(&arc, from.z, to, feed);
        }
        let count = i64::try_from(parts.len()).expect("at most four");
        for (index, part) in (1..).zip(&parts) {
            let z =
                if index == count { to.z } else { from.z + Nm::new((to.z - from.z).get() * index / count) };
            self.part(part, z, feed);
        }
        self.planned = Some(to);
    }

    /// Where the parts end in which an arc is written: by radius each of less than half a turn,
    /// where that is unambiguous, else halves of a full circle.
    fn ends(&self, arc: &Arc) -> Vec<Point> {
        let sweep = arc.sweep().abs();
        match self.dialect.arcs {
            Arcs::Radius if sweep > 3.0 => arc.parts(4).collect(),
            Arcs::Radius if sweep > 1.5 => arc.parts(2).collect(),
            Arcs::Center if arc.start == arc.end => {
                let (start, center) = (self.snap(arc.start), self.snap(arc.center));
                vec![Point::new(center.x * 2 - start.x, center.y * 2 - start.y), arc.end]
            }
            Arcs::Center | Arcs::Radius | Arcs::Lines => vec![arc.end],
        }
    }

    /// As it is written.
    fn snap(&self, p: Point) -> Point {
        Point::new(Nm::new(self.round(p.x) * self.unit), Nm::new(self.round(p.y) * self.unit))
    }

    /// Whether the arc between the rounded points round the rounded centre is still that arc: every
    /// point of it within two units of the last digit, and the two radii as near as the controller
    /// asks.
    fn survives_rounding(&self, arc: &Arc) -> bool {
        let [start, end, center] = [arc.start, arc.end, arc.center].map(|p| self.snap(p));
        let rounded = Arc { start, end, center, turn: arc.turn };
        if (arc.start == arc.end) != (rounded.start == rounded.end) || rounded.radius() < 1.0 {
            return false;
        }
        let unit = Nm::new(self.unit).to_f64();
        let off = (rounded.sweep() - arc.sweep()).abs() * arc.radius();
        let radii = (rounded.radius() - rounded.center.distance(rounded.end)).abs();
        let most = match self.dialect.arc_check {
            ArcCheck::Absolute => RADIUS_ERROR.to_f64(),
            ArcCheck::Relative => RADIUS_ERROR.to_f64().min(rounded.radius() / RELATIVE),
        };
        arc.length() > 8.0 * unit && off <= 4.0 * unit && radii <= most.min(4.0 * unit)
    }

    /// As lines within [`CHORD`] of the arc, evenly up or down.
    fn chords(&mut self, arc: &Arc, from: Nm, to: Position, feed: Feed) {
        let points: Vec<Point> = arc.flatten(CHORD).collect();
        let count = i64::try_from(points.len()).expect("at most 2¹⁶ chords");
        for (index, point) in (1..).zip(points) {
            let z = if index == count { to.z } else { from + Nm::new((to.z - from).get() * index / count) };
            self.straight("G1", Position::over(point, z), Some(feed));
        }
    }

    /// An arc that survives rounding, up or down to a height.
    fn part(&mut self, arc: &Arc, z: Nm, feed: Feed) {
        let at = self.at.expect("an arc follows a move");
        let to = self.position(Position::over(arc.end, z));
        self.begin_line(match arc.turn {
            Turn::Clockwise => "G2",
            Turn::CounterClockwise => "G3",
        });
        self.word('X', to.x);
        self.word('Y', to.y);
        self.coordinate('Z', to.z, Some(at.z));
        if self.dialect.arcs == Arcs::Radius {
            self.word('R', self.round(Nm::from_f64(arc.radius())));
        } else {
            self.word('I', self.round(arc.center.x) - at.x);
            self.word('J', self.round(arc.center.y) - at.y);
        }
        self.feed_word(feed);
        self.end_line();
        self.at = Some(to);
        self.height = Some(to.z);
    }

    fn coordinate(&mut self, letter: char, value: i64, before: Option<i64>) {
        if before != Some(value) {
            self.word(letter, value);
        }
    }

    /// A length as the dialect writes it.
    pub(super) fn length(&self, length: Nm) -> String {
        self.number(self.round(length))
    }

    fn feed_word(&mut self, feed: Feed) {
        if self.feed != Some(feed) {
            self.feed = Some(feed);
            _ = write!(self.text, " F{}", feed.number());
        }
    }

    fn position(&self, p: Position) -> Rounded {
        Rounded { x: self.round(p.x), y: self.round(p.y), z: self.round(p.z) }
    }

    /// In units of the last digit, halves away from zero.
    fn round(&self, length: Nm) -> i64 {
        let half = self.unit / 2 * length.get().signum();
        (length.get() + half) / self.unit
    }

    /// A rounded length in millimetres.
    fn number(&self, value: i64) -> String {
        let mut text = String::new();
        add_number(&mut text, value, self.dialect.decimals);
        text
    }

    /// Adds a rounded length to the line that is being written.
    fn word(&mut self, letter: char, value: i64) {
        self.text.push(' ');
        self.text.push(letter);
        add_number(&mut self.text, value, self.dialect.decimals);
    }

    /// A comment that the operator sees, where the controller shows any.
    fn message(&mut self, text: &str) {
        match self.dialect.messages {
            Messages::Msg => self.comment(&format!("MSG, {text}")),
            Messages::Hidden => self.comment(text),
        }
    }

    /// A comment in as many lines as it needs.
    pub(super) fn comment(&mut self, text: &str) {
        let (open, close) = match self.dialect.comments {
            Comments::Parentheses => ("(", ")"),
            Comments::Semicolon => ("; ", ""),
            Comments::None => return,
        };
        let room = self.dialect.longest_line.saturating_sub(open.len() + close.len()).max(8);
        for line in wrap(&plain(text), room) {
            _ = writeln!(self.text, "{open}{line}{close}");
        }
    }

    pub(super) fn line(&mut self, text: &str) {
        self.begin_line(text);
        self.end_line();
    }

    /// Begins a line, to which words are added until it ends.
    fn begin_line(&mut self, text: &str) {
        if self.dialect.line_numbers == LineNumbers::ByTens {
            self.line += 10;
            _ = write!(self.text, "N{} ", self.line);
        }
        self.text.push_str(text);
    }

    fn end_line(&mut self) {
        self.text.push('\n');
    }
}

/// Adds a length in units of the last digit, in millimetres and without zeros that say nothing.
fn add_number(text: &mut String, value: i64, decimals: usize) {
    let mut left = value.unsigned_abs();
    let mut decimals = decimals.min(6);
    while decimals > 0 && left.is_multiple_of(10) {
        (left, decimals) = (left / 10, decimals - 1);
    }
    // The last digit first.
    let mut digits = [b'0'; 20];
    let mut count = 0;
    while left > 0 || count <= decimals {
        digits[count] = b'0' + u8::try_from(left % 10).expect("below ten");
        (left, count) = (left / 10, count + 1);
    }
    if value < 0 {
        text.push('-');
    }
    for place in (0..count).rev() {
        text.push(char::from(digits[place]));
        if place == decimals && place > 0 {
            text.push('.');
        }
    }
}

/// How much shorter than the tool before it a tool may be, to find its plate. Chosen: with more,
/// the way down would be longer than small machines have.
const SHORTER: Nm = Nm::from_mm(10);

/// How fast a tool looks for the plate, and how fast it touches it, in millimetres a minute.
/// Chosen: at the second, an axis that brakes with 10 mm/s² stops 6 µm beyond.
const FAST: u32 = 100;
const SLOW: u32 = 20;

/// What stands before and after the touch of a tool.
const TOUCH_OFF_BEGINS: &str = "touch-off begins";
const TOUCH_OFF_ENDS: &str = "touch-off ends";

/// What stands before and after lines of the user's own, for whoever reads the program.
const OWN_BEGINS: &str = "own G-code begins";
const OWN_ENDS: &str = "own G-code ends";

/// How far chords may leave an arc that is written as lines. Chosen: below the resolution of the
/// machine.
const CHORD: Nm = Nm::from_um(1);

/// How far the radii at an arc's two ends may differ: LinuxCNC refuses more than 1.27 µm, Grbl more
/// than 5 µm.
const RADIUS_ERROR: Nm = Nm::new(1200);

/// The part of the radius by which they may differ where that is asked too: half of the thousandth
/// that is refused.
const RELATIVE: f64 = 2_000.0;

/// Text that every controller bears in a comment: printable ASCII, without what ends a comment or
/// acts at once.
pub(super) fn plain(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            'µ' | 'μ' => out.push('u'),
            '×' => out.push('x'),
            '°' => out.push_str("deg"),
            '–' | '—' => out.push('-'),
            '(' => out.push('['),
            ')' => out.push(']'),
            '{' => out.push('['),
            '}' => out.push(']'),
            '?' | '!' | '~' | ';' | '%' | '#' | '*' => out.push('.'),
            ' '..='\x7d' => out.push(c),
            _ => out.push('_'),
        }
    }
    out
}

/// `text` in lines of at most `room` characters, broken at blanks where there are any. ASCII only.
///
/// A line that goes on begins with `+`, and with a blank behind that where there was one: who reads
/// the comments back puts them together.
fn wrap(text: &str, room: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let (mut mark, mut rest) = ("", text);
    while mark.len() + rest.len() > room {
        let own = room - mark.len();
        let at = rest[..=own].rfind(' ').filter(|&at| at > 0).unwrap_or(own);
        let (line, after) = rest.split_at(at);
        lines.push(format!("{mark}{line}"));
        rest = after.trim_start_matches(' ');
        mark = if after.starts_with(' ') { "+ " } else { "+" };
    }
    lines.push(format!("{mark}{}", rest.trim_end()));
    lines
}
