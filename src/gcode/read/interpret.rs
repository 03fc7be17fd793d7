//! Words → motions: the modal state of RS274/NGC, as far as one tool in one plane needs it.

use crate::geometry::{Nm, Point, Turn};

use super::error::ReadError;
use super::lex::{Number, Pointer, Word, words};
use super::{Listing, Motion, Place, Way};

/// Follows a program.
///
/// # Errors
///
/// The first word that cannot be read or whose meaning the text alone does not tell, with its place and the reason.
pub fn read(text: &str) -> Result<Listing, ReadError> {
    let mut state = State::default();
    for (index, source) in text.lines().enumerate() {
        let pointer = Pointer { line: u32::try_from(index + 1).unwrap_or(u32::MAX), source };
        if state.listing.end.is_none() {
            state.line(pointer)?;
        }
    }
    state.listing.spinning = state.spinning;
    Ok(state.listing)
}

/// The modal group of motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Mode {
    #[default]
    None,
    Rapid,
    Feed,
    Arc(Turn),
    /// G81, G82 and G83.
    Cycle(Peck),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Peck {
    Once,
    Dwelling,
    Pecking,
}

/// What a coordinate counts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Distance {
    #[default]
    Absolute,
    Incremental,
}

#[derive(Debug)]
struct State {
    listing: Listing,
    mode: Mode,
    distance: Distance,
    centers: Distance,
    /// Nanometres in a unit.
    unit: i64,
    at: Place,
    feed: Option<i64>,
    speed: u32,
    spinning: bool,
    selected: Option<u32>,
    tool: Option<u32>,
    cycle: Cycle,
}

impl Default for State {
    fn default() -> Self {
        Self {
            listing: Listing::default(),
            mode: Mode::None,
            distance: Distance::Absolute,
            centers: Distance::Incremental,
            unit: 1_000_000,
            at: Place::default(),
            feed: None,
            speed: 0,
            spinning: false,
            selected: None,
            tool: None,
            cycle: Cycle::default(),
        }
    }
}

/// What the drilling cycles remember from hole to hole.
#[derive(Clone, Copy, Debug, Default)]
struct Cycle {
    /// G98: back to where it was before the cycle, not to `retract`.
    to_initial: bool,
    initial: Option<Nm>,
    bottom: Option<Nm>,
    retract: Option<Nm>,
    peck: Option<Nm>,
    dwell: u64,
}

/// The values of one line, each with the word it came from.
#[derive(Default)]
struct Values<'a> {
    words: [Option<Word<'a>>; 26],
}

impl<'a> Values<'a> {
    fn slot(letter: char) -> usize {
        usize::from(u8::try_from(letter).unwrap_or(b'A').saturating_sub(b'A')).min(25)
    }

    fn get(&self, letter: char) -> Option<Word<'a>> {
        self.words[Self::slot(letter)]
    }
}

impl State {
    fn line(&mut self, pointer: Pointer<'_>) -> Result<(), ReadError> {
        let (mut values, mut codes) = (Values::default(), Vec::new());
        for word in words(pointer)? {
            match word.letter {
                'G' | 'M' => codes.push(word),
                'N' => {}
                'F' | 'I' | 'J' | 'P' | 'Q' | 'R' | 'S' | 'T' | 'X' | 'Y' | 'Z' | 'H' | 'L' => {
                    let slot = &mut values.words[Values::slot(word.letter)];
                    if slot.replace(word).is_some() {
                        return Err(pointer.error(
                            word.column,
                            word.text,
                            "the letter stands twice in the line",
                        ));
                    }
                }
                _ => {
                    let what = "expected one of F G I J L M N P Q R S T X Y Z";
                    return Err(pointer.error(word.column, word.text, what));
                }
            }
        }
        self.execute(pointer, &codes, &values)
    }

    /// In the order of RS274/NGC §3.8: feed, speed, tool, spindle, dwell, units, distance, motion, stop.
    fn execute(
        &mut self,
        pointer: Pointer<'_>,
        codes: &[Word<'_>],
        values: &Values<'_>,
    ) -> Result<(), ReadError> {
        let (mut stop, mut end, mut dwell) = (false, false, false);
        let mut motion_given = None;
        for &code in codes {
            let key = code.number.times(10).unwrap_or(-1);
            match (code.letter, key) {
                ('G', 0) => motion_given = Some(Mode::Rapid),
                ('G', 10) => motion_given = Some(Mode::Feed),
                ('G', 20) => motion_given = Some(Mode::Arc(Turn::Clockwise)),
                ('G', 30) => motion_given = Some(Mode::Arc(Turn::CounterClockwise)),
                ('G', 810) => motion_given = Some(Mode::Cycle(Peck::Once)),
                ('G', 820) => motion_given = Some(Mode::Cycle(Peck::Dwelling)),
                ('G', 830) => motion_given = Some(Mode::Cycle(Peck::Pecking)),
                ('G', 800) => motion_given = Some(Mode::None),
                ('G', 40) => dwell = true,
                ('G', 200) => self.unit = 25_400_000,
                ('G', 210) => self.unit = 1_000_000,
                ('G', 900) => self.distance = Distance::Absolute,
                ('G', 910) => self.distance = Distance::Incremental,
                ('G', 901) => self.centers = Distance::Absolute,
                ('G', 911) => self.centers = Distance::Incremental,
                ('G', 980) => self.cycle.to_initial = true,
                ('G', 990) => self.cycle.to_initial = false,
                ('G', 170 | 400 | 430 | 490 | 540 | 610 | 611 | 640 | 940 | 970) => {}
                ('M', 0 | 10 | 60 | 600 | 6000) => stop = true,
                ('M', 20 | 300) => end = true,
                ('M', 30 | 40) => self.spinning = true,
                ('M', 50) => self.spinning = false,
                ('M', 70 | 80 | 90 | 480 | 490 | 840 | 1170 | 4000) => {}
                _ => return Err(pointer.error(code.column, code.text, refusal(code.letter, key))),
            }
            if (code.letter, key) == ('M', 60) {
                self.tool =
                    values.get('T').map_or(Ok(self.selected), |word| whole(pointer, word).map(Some))?;
            }
        }
        self.settings(pointer, values)?;
        if dwell {
            return self.dwell(pointer, values);
        }
        if let Some(mode) = motion_given {
            if let (Mode::Cycle(_), false) = (mode, matches!(self.mode, Mode::Cycle(_))) {
                self.cycle.initial = self.at.z;
            }
            self.mode = mode;
        }
        self.motion(pointer, values)?;
        if stop {
            self.listing.stops.push((self.listing.motions.len(), pointer.line));
        }
        if end {
            self.listing.end = Some(pointer.line);
            self.spinning = false;
        }
        Ok(())
    }

    /// F, S and T.
    fn settings(&mut self, pointer: Pointer<'_>, values: &Values<'_>) -> Result<(), ReadError> {
        if let Some(word) = values.get('F') {
            self.feed = Some(self.scaled(pointer, word)?);
        }
        if let Some(word) = values.get('S') {
            self.speed =
                word.number.times(1).and_then(|speed| u32::try_from(speed).ok()).ok_or_else(|| {
                    pointer.error(
                        word.column,
                        word.text,
                        "expected revolutions per minute that are not negative",
                    )
                })?;
        }
        if let Some(word) = values.get('T') {
            self.selected = Some(whole(pointer, word)?);
        }
        Ok(())
    }

    /// G4: P in seconds with a decimal point or below 100, else in milliseconds, as controllers differ; S in seconds.
    fn dwell(&mut self, pointer: Pointer<'_>, values: &Values<'_>) -> Result<(), ReadError> {
        let milliseconds = |word: Word<'_>, unit: i64| {
            let value = word.number.times(unit).and_then(|value| u64::try_from(value).ok());
            value.ok_or_else(|| pointer.error(word.column, word.text, "expected a time that is not negative"))
        };
        self.listing.dwell += match (values.get('P'), values.get('S')) {
            (Some(p), _) if p.number.decimals == 0 && p.number.mantissa >= 100 => milliseconds(p, 1)?,
            (Some(word), _) | (None, Some(word)) => milliseconds(word, 1000)?,
            (None, None) => 0,
        };
        Ok(())
    }

    fn motion(&mut self, pointer: Pointer<'_>, values: &Values<'_>) -> Result<(), ReadError> {
        let words = ['X', 'Y', 'Z', 'I', 'J'].map(|letter| values.get(letter));
        let Some(first) = words.into_iter().flatten().next() else { return Ok(()) };
        let to = self.target(pointer, values)?;
        match self.mode {
            Mode::None => {
                let what = "a coordinate before the first of G0 to G3 or G81 to G83";
                Err(pointer.error(first.column, first.text, what))
            }
            Mode::Rapid => {
                self.go(pointer, Way::Rapid, to);
                Ok(())
            }
            Mode::Feed => {
                self.go(pointer, Way::Feed, to);
                Ok(())
            }
            Mode::Arc(turn) => {
                let center = self.center(pointer, values, turn, to, first)?;
                self.go(pointer, Way::Arc { center, turn }, to);
                Ok(())
            }
            Mode::Cycle(peck) => self.drill(pointer, values, peck, first),
        }
    }

    fn go(&mut self, pointer: Pointer<'_>, way: Way, to: Place) {
        let spindle = self.spinning.then_some(self.speed);
        let (from, feed, tool, line) = (self.at, self.feed, self.tool, pointer.line);
        self.listing.motions.push(Motion { way, from, to, feed, spindle, tool, line });
        self.at = to;
    }

    /// Where X, Y and Z lead.
    fn target(&self, pointer: Pointer<'_>, values: &Values<'_>) -> Result<Place, ReadError> {
        let axis = |letter: char, before: Option<Nm>| match values.get(letter) {
            None => Ok(before),
            Some(word) => {
                let value = Nm::new(self.scaled(pointer, word)?);
                match (self.distance, before) {
                    (Distance::Absolute, _) => Ok(Some(value)),
                    (Distance::Incremental, Some(before)) => Ok(Some(before + value)),
                    (Distance::Incremental, None) => {
                        let what = "an incremental move from a place that the program has not given";
                        Err(pointer.error(word.column, word.text, what))
                    }
                }
            }
        };
        Ok(Place { x: axis('X', self.at.x)?, y: axis('Y', self.at.y)?, z: axis('Z', self.at.z)? })
    }

    /// The centre of an arc, from I and J or from R.
    fn center(
        &self,
        pointer: Pointer<'_>,
        values: &Values<'_>,
        turn: Turn,
        to: Place,
        first: Word<'_>,
    ) -> Result<Point, ReadError> {
        let unknown =
            || pointer.error(first.column, first.text, "an arc from a place that the program has not given");
        let (from, to) = (self.at.point().ok_or_else(unknown)?, to.point().ok_or_else(unknown)?);
        if let Some(word) = values.get('R') {
            let radius = self.scaled(pointer, word)?;
            return by_radius(from, to, radius, turn)
                .map_err(|what| pointer.error(word.column, word.text, what));
        }
        let axis = |letter: char, from: Nm| match (values.get(letter), self.centers) {
            (Some(word), Distance::Incremental) => Ok(from + Nm::new(self.scaled(pointer, word)?)),
            (Some(word), Distance::Absolute) => Ok(Nm::new(self.scaled(pointer, word)?)),
            (None, _) => Ok(from),
        };
        let center = Point::new(axis('I', from.x)?, axis('J', from.y)?);
        let (start, end) = (center.distance(from), center.distance(to));
        if start < 1.0 || ((start - end).abs() > 5_000.0 && (start - end).abs() > start / 1000.0) {
            let what = format!(
                "the arc's ends are {:.4} mm and {:.4} mm from its centre: expected the same above zero",
                start / 1e6,
                end / 1e6
            );
            return Err(pointer.error(first.column, first.text, what));
        }
        Ok(center)
    }

    /// G81 to G83: over the hole, down to R, drill, up again.
    fn drill(
        &mut self,
        pointer: Pointer<'_>,
        values: &Values<'_>,
        peck: Peck,
        first: Word<'_>,
    ) -> Result<(), ReadError> {
        let absolute = |state: &Self, word: Word<'_>| match state.distance {
            Distance::Absolute => state.scaled(pointer, word).map(Nm::new),
            Distance::Incremental => {
                Err(pointer.error(word.column, word.text, "a drilling cycle with G91 is not followed"))
            }
        };
        if let Some(word) = values.get('R') {
            self.cycle.retract = Some(absolute(self, word)?);
        }
        if let Some(word) = values.get('Z') {
            self.cycle.bottom = Some(absolute(self, word)?);
        }
        if let Some(word) = values.get('Q') {
            self.cycle.peck = Some(absolute(self, word)?).filter(|&peck| peck > Nm::ZERO);
        }
        if let Some(word) = values.get('P') {
            self.cycle.dwell = word.number.times(1000).and_then(|ms| u64::try_from(ms).ok()).unwrap_or(0);
        }
        let (Some(bottom), Some(retract)) = (self.cycle.bottom, self.cycle.retract) else {
            return Err(pointer.error(first.column, first.text, "a drilling cycle needs Z and R"));
        };
        let place = self.target(pointer, values)?;
        let level = self.at.z.map_or(retract, |z| z.max(retract));
        let hole = |z: Nm| Place { x: place.x, y: place.y, z: Some(z) };
        if self.at.z != Some(level) {
            self.go(pointer, Way::Rapid, Place { z: Some(level), ..self.at });
        }
        self.go(pointer, Way::Rapid, hole(level));
        self.go(pointer, Way::Rapid, hole(retract));
        let step = self.cycle.peck.filter(|_| peck == Peck::Pecking);
        let mut depth = retract;
        while depth > bottom {
            depth = step.map_or(bottom, |step| (depth - step).max(bottom));
            self.go(pointer, Way::Feed, hole(depth));
            if depth > bottom {
                self.go(pointer, Way::Rapid, hole(retract));
            }
        }
        if peck == Peck::Dwelling {
            self.listing.dwell += self.cycle.dwell;
        }
        let up =
            if self.cycle.to_initial { self.cycle.initial.unwrap_or(retract).max(retract) } else { retract };
        self.go(pointer, Way::Rapid, hole(up));
        Ok(())
    }

    /// A length or feed in nanometres.
    fn scaled(&self, pointer: Pointer<'_>, word: Word<'_>) -> Result<i64, ReadError> {
        const LARGEST: i64 = 1 << 40;
        let value = word.number.times(self.unit).filter(|value| value.abs() < LARGEST);
        value.ok_or_else(|| pointer.error(word.column, word.text, "expected a length below a kilometre"))
    }
}

/// A number that counts.
fn whole(pointer: Pointer<'_>, word: Word<'_>) -> Result<u32, ReadError> {
    let Number { mantissa, decimals } = word.number;
    let value = if decimals == 0 { u32::try_from(mantissa).ok() } else { None };
    value.ok_or_else(|| pointer.error(word.column, word.text, "expected a whole number"))
}

/// The centre of the arc of this radius; negative for more than half a turn (RS274/NGC §3.5.3.1).
///
/// ```text
///              c           |ac| = r, m the middle of the chord;
///            ╱ ┊ ╲         c lies left of a → b for a short turn against the clock
///          a───m───b
/// ```
fn by_radius(a: Point, b: Point, radius: i64, turn: Turn) -> Result<Point, &'static str> {
    let (way, radius_nm) = (b - a, Nm::new(radius).to_f64());
    let half = way.length() / 2.0;
    if half < 0.5 {
        return Err("an arc with R must end elsewhere than it begins");
    }
    if half > radius_nm.abs() + 5_000.0 {
        return Err("the radius is smaller than half the way to the end");
    }
    let height = (radius_nm * radius_nm - half * half).max(0.0).sqrt();
    let left = (turn == Turn::CounterClockwise) == (radius > 0);
    let along = if left { height } else { -height } / (2.0 * half);
    let (ax, ay) = a.to_f64();
    let (x, y) = (way.x.to_f64(), way.y.to_f64());
    Ok(Point::from_f64(ax + x / 2.0 - y * along, ay + y / 2.0 + x * along))
}

/// Why a code is refused.
fn refusal(letter: char, key: i64) -> &'static str {
    match (letter, key) {
        ('G', 920..=923) => {
            "G92 moves the zero point, so the places that follow are not on the board any more"
        }
        ('G', 280 | 281 | 300 | 301 | 530) => {
            "it goes to a place of the machine that the program does not give"
        }
        ('G', 550..=593) => "another coordinate system, whose zero the program does not give",
        ('G', 180 | 190) => "only the plane of the board (G17) is followed",
        ('G', 410..=421) => "cutter compensation: the path depends on a tool table",
        ('G', 382..=385) => "a probe: the path depends on what it finds",
        ('G', 930 | 950) => "only feeds per minute (G94) are followed",
        ('M', 970..=999) => "subprograms are not followed",
        _ => "a code that is not known here",
    }
}
