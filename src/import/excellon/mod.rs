//! Excellon drill files, versions 1 and 2, as thirty years of programs wrote them.
//!
//! There is no standard that all of them follow: the manual of the Excellon CNC-7 machines (header
//! `M48` to `%`, tools `T1C0.8`, holes `X…Y…`, slots `G85`, routing `G00`/`M15`/`G01`/`M16`) is a
//! common ground, but files leave out the header, the units, the zeros or the number of digits. So
//! reading goes in four steps:
//!
//! ```text
//!  bytes ─ lex ─▶ lines ─ declared ─▶ what the file says ─ guess ─▶ number formats ─ machine ─▶ holes
//!                                                            ▲                         │
//!                                                            └─ how many lie on pads? ─┘
//! ```
//!
//! Only where the file leaves a choice is it run more than once, and a choice that is not the
//! manual's default is reported with its reason. What cannot be read for certain, such as a square
//! package (`G82`), is an error: a drill in the wrong place ruins the board. `docs/excellon.md`
//! lists every construct with the fixture that shows it.

mod block;
mod declared;
mod format;
mod guess;
mod lex;
mod machine;
mod route;

use std::collections::BTreeMap;

use crate::board::{ApertureUse, Hole, Plating, Source, Warning};
use crate::geometry::{Nm, Point};
use crate::import::diagnostic;
use crate::import::error::{Error, Warnings, last_line};
use declared::Declared;
use format::NumberFormat;
use guess::Score;
use machine::{File, Run};

pub use guess::Context;
pub(in crate::import) use guess::FRAME;

/// What a drill file holds.
#[derive(Clone, Debug)]
pub struct Drilling {
    /// Holes, slots and routed contours, in file order.
    pub holes: Vec<Hole>,
    /// The file as the report lists it.
    pub source: Source,
    /// The X2 file function, where a comment gives it: `Plated,1,2,PTH`.
    pub function: Option<String>,
    /// What was repaired, guessed or left out.
    pub warnings: Vec<Warning>,
}

/// Reads the drill file `name` with content `bytes`. `context` is what is known of the copper: it
/// decides between number formats where the file does not name its own.
///
/// # Errors
///
/// A file that is no Excellon, a command that cannot be read for certain, a tool without a
/// diameter, a coordinate beyond a metre, more holes than any board has.
pub fn read(name: &str, bytes: &[u8], context: &Context) -> Result<Drilling, Error> {
    refuse_others(name, bytes)?;
    let mut lines = lex::lines(name, bytes)?;
    let declared = Declared::gather(&lines);
    let cut_off = cut_off(&declared, bytes).then(|| lines.pop()).flatten();
    let plating = declared.function.as_deref().map_or_else(|| plating_by_name(name), plating_by_function);
    let file = File { name, bytes, lines: &lines, declared: &declared, plating, disbelieved: false };
    let reading = Reading::choose(file, context)?;
    let file = File { disbelieved: reading.against, ..file };
    let mut warnings = Warnings::new(name, bytes);
    let run = machine::run(file, reading.format, &mut warnings)?;
    reading.explain(file, context, &mut warnings);
    if let Some(line) = cut_off {
        let message = "the file ends within a line, which is ignored: it may be truncated; if it is not, end it with M30";
        warnings.add(&diagnostic::TRUNCATED_FILE, line.place, message);
    } else if !declared.ended {
        let message = "the file does not end with M30; if it is truncated, holes are missing";
        warnings.add(&diagnostic::MISSING_END_OF_DRILL_FILE, last_line(bytes), message);
    }
    warn_of_size(&run, &mut warnings);
    for (number, (place, error)) in &run.broken {
        let what = match error {
            Error::Syntax(diagnosis) => diagnosis.what.clone(),
            Error::Content { what, .. } => what.to_string(),
        };
        let message = format!("{what}; tool T{number} drills nothing and is ignored");
        warnings.add(&diagnostic::MALFORMED_TOOL, place.clone(), message);
    }
    if run.holes.is_empty() {
        warnings.add(&diagnostic::DRILL_WITHOUT_HOLES, last_line(bytes), "the drill file has no holes");
    }
    let source = source(file, &reading, &run);
    Ok(Drilling { holes: run.holes, source, function: declared.function, warnings: warnings.finish() })
}

/// Whether `bytes` begin like an Excellon drill file.
#[must_use]
pub fn looks_like(bytes: &[u8]) -> bool {
    /// Lines that may pass before something tells: banners of comments are long. Chosen.
    const FAR: usize = 400;
    let head = &bytes[..bytes.len().min(64 * 1024)];
    if head.contains(&b'*')
        && head.windows(3).any(|w| w == b"%FS" || w == b"%AD" || w == b"%MO" || w == b"%TF")
    {
        return false;
    }
    let text: String = head.iter().filter(|&&b| b != 0).map(|&b| char::from(b)).collect();
    let lines =
        text.split(['\n', '\r']).map(str::trim).filter(|line| !line.is_empty() && !line.starts_with(';'));
    let tells = lines.take(FAR).filter_map(|line| {
        let upper = line.to_ascii_uppercase();
        if upper.ends_with('*') {
            return Some(false);
        }
        let neutral = upper == "%" || upper.starts_with('(') || upper.starts_with('/');
        let modal = ["G90", "G05", "M71", "M72", "G91", "ICI"].iter().any(|code| upper.starts_with(code))
            || machine::WITHOUT_EFFECT.contains(&upper.split(',').next().unwrap_or_default());
        // A program that ends at once: pcb-rnd's for a kind of hole that the board has none of.
        (!neutral && !modal).then(|| upper == "M30" || begins_as_drill(&upper))
    });
    tells.into_iter().next().unwrap_or(false)
}

/// Whether the first line that says something could stand in a drill file, and not in G-code, which
/// has Z.
fn begins_as_drill(line: &str) -> bool {
    if ["M48", "INCH", "METRIC"].iter().any(|head| line.starts_with(head)) {
        // pcb2gcode's options have `metric = true`.
        return !line.contains('=');
    }
    let mut rest = line;
    let mut words = 0;
    while let Some(letter) = rest.chars().next().filter(|c| "XYTCFSGMRNHBIJA".contains(*c)) {
        let after = rest[1..].trim_start_matches(|c: char| c.is_ascii_digit() || ".-+ ".contains(c));
        let number = rest[1..rest.len() - after.len()].trim();
        let of_drilling =
            letter != 'G' || matches!(number, "0" | "00" | "05" | "5" | "81" | "85" | "92" | "93");
        if number.is_empty() || !of_drilling {
            return false;
        }
        rest = after;
        words += 1;
    }
    words > 0 && rest.is_empty() && line.starts_with(['T', 'X', 'Y', 'G'])
}

/// Whether the file ends in the middle of a line: one without its end, in a file without its end. A
/// coordinate that lost its last digits is a hole elsewhere.
fn cut_off(declared: &Declared, bytes: &[u8]) -> bool {
    let last = bytes.iter().rev().take_while(|b| !matches!(b, b'\n' | b'\r'));
    !declared.ended && last.clone().any(|b| matches!(b, b'X' | b'Y' | b'x' | b'y'))
}

/// Says plainly what a file is that is none of ours.
fn refuse_others(name: &str, bytes: &[u8]) -> Result<(), Error> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(Error::content(name, "the drill file is empty", "export it again"));
    }
    if bytes.trim_ascii_start().starts_with(b"%%") {
        let what = "a Sieb & Meyer drill file, which declares neither tool diameters nor a unit";
        return Err(Error::content(
            name,
            what,
            "export the drill data as Excellon (NC drill), or as Gerber X2",
        ));
    }
    if looks_like(bytes) {
        return Ok(());
    }
    let what = if crate::import::gerber::looks_like(bytes) {
        "a Gerber file where an Excellon drill file was expected"
    } else {
        "not an Excellon drill file"
    };
    let hint = "a drill file begins with M48, or with tools (T1C0.8) and holes (X1.5Y2.5)";
    Err(Error::content(name, what, hint))
}

/// What a file's name says of its holes: `board-NPTH.drl`, `plated-drill.cnc`, `virtual.pdrill`.
pub(super) fn plating_by_name(name: &str) -> Plating {
    let name = name.to_ascii_lowercase();
    let squeezed: String = name.chars().filter(char::is_ascii_alphanumeric).collect();
    if ["npth", "nonplated", "unplated", "notplated", "udrill"].iter().any(|word| squeezed.contains(word)) {
        return Plating::NonPlated;
    }
    let mut words = name.split(|c: char| !c.is_ascii_alphanumeric());
    if words.any(|word| matches!(word, "pth" | "plated" | "pdrill")) {
        Plating::Plated
    } else {
        Plating::Unknown
    }
}

/// What an X2 file function says of the holes: `NonPlated,1,2,NPTH`.
pub(super) fn plating_by_function(function: &str) -> Plating {
    match function.split(',').next().unwrap_or_default() {
        "Plated" => Plating::Plated,
        "NonPlated" => Plating::NonPlated,
        _ => Plating::Unknown,
    }
}

/// A drill wider than any drill is a unit taken for another.
fn warn_of_size(run: &Run, warnings: &mut Warnings<'_>) {
    /// Chosen: mounting holes end at 7 mm; an inch taken for a millimetre makes a 0.4 mm drill
    /// wider than this.
    const WIDEST: Nm = Nm::from_mm(10);
    let used = |tool: u32| run.holes.iter().any(|hole| hole.tool == tool && !hole.is_slot());
    for (number, tool) in run.tools.iter().filter(|(number, tool)| tool.diameter > WIDEST && used(**number)) {
        let message =
            format!("tool T{number} has a diameter of {:.3} mm: the unit may be wrong", tool.diameter);
        warnings.add(&diagnostic::DRILL_IMPLAUSIBLE, tool.place.clone(), message);
    }
}

/// The number format that a file is read with, and how it came to be that one.
struct Reading {
    format: NumberFormat,
    /// How the holes fall under it.
    score: Score,
    /// How many of the readings that the file allows put the holes elsewhere.
    rivals: usize,
    /// The reading that would have been taken without looking at the copper.
    usual: NumberFormat,
    usual_score: Score,
    /// Whether it is not one that the file declares.
    against: bool,
}

impl Reading {
    /// The format of `file` that fits the copper best.
    fn choose(file: File<'_>, context: &Context) -> Result<Self, Error> {
        let formats = guess::candidates(file.declared, file.lines);
        let mut first_error = None;
        let mut runs: Vec<(NumberFormat, Vec<Point>, Score)> = Vec::new();
        for &format in &formats {
            match machine::sample(file, format) {
                // A reading that comes to the same as one before it is no rival.
                Ok(holes) => {
                    let places = guess::some_places(&holes);
                    if !runs.iter().any(|(_, others, _)| guess::same_places(others, &places)) {
                        runs.push((format, places, context.judge(&holes)));
                    }
                }
                Err(error) => first_error = first_error.or(Some(error)),
            }
        }
        let Some((usual, _, usual_score)) = runs.first() else {
            let hint = "the file declares no readable number format";
            return Err(
                first_error.unwrap_or_else(|| Error::content(file.name, "nothing could be read", hint))
            );
        };
        let mut best = (*usual, *usual_score);
        for (format, _, score) in &runs {
            if score.points() > best.1.points() {
                best = (*format, *score);
            }
        }
        let (format, score) = best;
        let (usual, usual_score, rivals) = (*usual, *usual_score, runs.len() - 1);
        let allowed = Self { format, score, rivals, usual, usual_score, against: false };
        Ok(if context.is_empty() || !score.is_off() { allowed } else { allowed.or_any(file, context) })
    }

    /// This reading, under which most holes lie beside the board; or the one, if there is one, that
    /// all speaks for but what the file declares: every hole lies on the board, most of them on
    /// pads, and drills are as wide as drills are.
    fn or_any(self, file: File<'_>, context: &Context) -> Self {
        /// Chosen: two holes may lie on pads by chance.
        const LEAST: usize = 3;
        let file = File { disbelieved: true, ..file };
        let mut best = self;
        for format in guess::all(file.lines) {
            let Ok(holes) = machine::sample(file, format) else { continue };
            let score = context.judge(&holes);
            let fits =
                score.inside == score.holes && 2 * score.on_pads > score.holes && score.on_pads >= LEAST;
            let is_better = !best.against || score.points() > best.score.points();
            if fits && is_better && guess::are_drilled(&holes) {
                best = Self { format, score, against: true, ..best };
            }
        }
        best
    }

    /// Warns of what was guessed, and of holes that do not fit the copper.
    fn explain(&self, file: File<'_>, context: &Context, warnings: &mut Warnings<'_>) {
        let Score { on_pads, inside, holes, .. } = self.score;
        if holes == 0 {
            return;
        }
        let place = || file.declared.units.as_ref().map_or(0..0, |(_, place)| place.clone());
        let read_as = format!("read as {} {}", self.format.units.name(), self.format);
        let undeclared = file.declared.units.is_none() || file.declared.zeros.is_none();
        if self.against {
            let Score { inside: before, .. } = self.usual_score;
            let message = format!(
                "with the declared number format ({} {}) {before} of {holes} holes lie on the board; {read_as}, with all on the board and {on_pads} on pads",
                self.usual.units.name(),
                self.usual
            );
            warnings.add(&diagnostic::DRILL_FORMAT_GUESSED, place(), message);
        } else if self.format != self.usual {
            let usual =
                format!("{} with {} {}", self.usual.units.name(), self.usual, self.usual_score.on_pads);
            let message = format!(
                "the file does not declare its number format; {read_as}, with {on_pads} of {holes} holes on pads ({usual})"
            );
            warnings.add(&diagnostic::DRILL_FORMAT_GUESSED, place(), message);
        } else if file.declared.units.is_none() {
            let message = format!(
                "the file does not declare its units; {read_as}, with {on_pads} of {holes} holes on pads"
            );
            warnings.add(&diagnostic::DRILL_UNITS_GUESSED, place(), message);
        } else if self.rivals > 0 && undeclared && context.is_empty() {
            let message = format!(
                "the file does not declare its number format, and there is no copper to compare with; {read_as}"
            );
            warnings.add(&diagnostic::DRILL_FORMAT_GUESSED, place(), message);
        }
        // What can be read in one way alone may lie round the board.
        let is_off = if self.rivals == 0 { self.score.is_elsewhere() } else { self.score.is_off() };
        if !context.is_empty() && is_off {
            let message = format!(
                "only {inside} of {holes} holes lie on the board ({read_as}): the drill file may belong to another board"
            );
            warnings.add(&diagnostic::DRILL_OFF_BOARD, place(), message);
        }
    }
}

/// The file as the report lists it; its role is the loader's to say.
fn source(file: File<'_>, reading: &Reading, run: &Run) -> Source {
    let bare = guess::has_bare_coordinates(file.lines);
    let counts = [
        ("holes", run.holes.iter().filter(|hole| !hole.is_slot()).count()),
        ("slots", run.holes.iter().filter(|hole| hole.is_slot()).count()),
        ("tools", run.tools.len()),
    ];
    Source {
        file: file.name.to_owned(),
        format: "excellon".to_owned(),
        role: String::new(),
        units: reading.format.units.name().to_owned(),
        number_format: match (bare, reading.format.digits.decimals) {
            (true, 1..) => reading.format.to_string(),
            (true, 0) | (false, _) => "decimal point".to_owned(),
        },
        sha256: crate::import::digest::sha256(file.bytes),
        design: crate::import::design::of_holes(&run.holes),
        bytes: file.bytes.len() as u64,
        counts: counts.into_iter().map(|(name, count)| (name.to_owned(), count as u64)).collect(),
        generator: file.declared.generator.clone(),
        apertures: tool_use(run),
    }
}

/// How often each tool drills and routes, by number.
fn tool_use(run: &Run) -> Vec<ApertureUse> {
    let mut used: BTreeMap<u32, (u64, u64)> = run.tools.keys().map(|&tool| (tool, (0, 0))).collect();
    for hole in &run.holes {
        let (flashes, draws) = used.entry(hole.tool).or_default();
        *if hole.is_slot() { draws } else { flashes } += 1;
    }
    let entry = |(tool, (flashes, draws)): (u32, (u64, u64))| {
        let diameter =
            run.tools.get(&tool).map_or_else(String::new, |t| format!("drill {:.3} mm", t.diameter));
        ApertureUse { name: format!("T{tool}"), what: diameter, flashes, draws }
    };
    used.into_iter().map(entry).collect()
}
