//! The graphics state and the commands that draw with it (specification §4).

use std::ops::Range;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::board::polarity::Polarity;
use crate::geometry::{Point, Turn};
use crate::import::diagnostic;

use super::super::error::{Error, Warnings, printable};
use super::aperture::{Form, Template};
use super::aperture_list::ApertureList;
use super::aperture_macro::Macro;
use super::attributes::Attributes;
use super::canvas::{Canvas, Refusal};
use super::lex::{Block, End, Lexer, Number, is_blank};
use super::quadrants::{Quadrants, Reading};
use super::radii::Radii;
use super::region::Region;
use super::state::{Format, Placement, Unit};
use super::{Image, Options, looks_like};

/// How D01 moves (G01, G02, G03).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Interpolation {
    Linear,
    Circular(Turn),
}

/// D01, D02, D03.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operation {
    Draw,
    Move,
    Flash,
}

/// An aperture and how it is used.
#[derive(Debug)]
pub(super) struct Aperture {
    pub(super) template: Rc<Template>,
    /// `.AperFunction` when it was defined.
    pub(super) function: Option<String>,
    pub(super) flashes: u64,
    pub(super) draws: u64,
}

impl Aperture {
    pub(super) fn new(template: Template, function: Option<String>) -> Self {
        Self { template: Rc::new(template), function, flashes: 0, draws: 0 }
    }
}

/// An aperture definition that cannot be read: an error where it is selected.
#[derive(Debug)]
pub(super) struct Malformed {
    /// Its number, where that can be read.
    pub(super) number: Option<u32>,
    pub(super) place: Range<usize>,
    pub(super) error: Error,
}

/// The words of one block that are left for its operation.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Words {
    pub(super) x: Option<Number>,
    pub(super) y: Option<Number>,
    pub(super) i: Option<Number>,
    pub(super) j: Option<Number>,
    pub(super) operation: Option<Operation>,
}

/// What has been drawn, by kind.
#[derive(Debug, Default)]
pub(super) struct Counts {
    pub(super) flashes: u64,
    pub(super) strokes: u64,
    pub(super) arcs: u64,
    pub(super) regions: u64,
}

/// Reads one file.
pub(super) struct Reader<'a> {
    pub(super) name: &'a str,
    pub(super) bytes: &'a [u8],
    /// The list beside an RS-274-D file.
    pub(super) list: Option<&'a ApertureList>,
    pub(super) lexer: Lexer<'a>,
    pub(super) warnings: Warnings<'a>,
    pub(super) unit: Option<Unit>,
    /// Whether MO gave the unit, rather than G70 or G71.
    pub(super) unit_by_mode: bool,
    /// Whether the number format gave it, because nothing else does.
    pub(super) unit_guessed: bool,
    /// Whether a coordinate was beyond what is handled.
    pub(super) is_beyond: bool,
    pub(super) format: Option<Format>,
    pub(super) apertures: FxHashMap<u32, Aperture>,
    /// Definitions that cannot be read, and that nothing has selected.
    pub(super) malformed: Vec<Malformed>,
    pub(super) macros: FxHashMap<&'a [u8], Macro<'a>>,
    pub(super) canvas: Canvas,
    pub(super) attributes: Attributes,
    pub(super) polarity: Polarity,
    /// LM, LR and LS.
    pub(super) mirror: (bool, bool),
    pub(super) rotation: f64,
    pub(super) scale: f64,
    pub(super) placement: Placement,
    /// IPNEG.
    pub(super) negative: Option<Range<usize>>,
    pub(super) forms: FxHashMap<(u32, [u64; 4]), Rc<Form>>,
    pub(super) position: Point,
    pub(super) aperture: Option<u32>,
    /// The form of the aperture under the transformation in force; none after either changed.
    pub(super) form: Option<Rc<Form>>,
    /// The attribute set of what is drawn now; none after something changed.
    pub(super) set: Option<u32>,
    pub(super) interpolation: Interpolation,
    pub(super) quadrants: Option<Quadrants>,
    /// How arcs are read, given after G74, after G75, or before either.
    pub(super) reading: Reading,
    /// What the radii of the arcs tell that are given in each of these ways.
    pub(super) radii: [Radii; 3],
    pub(super) operation: Option<Operation>,
    pub(super) region: Option<Region>,
    pub(super) counts: Counts,
    pub(super) generator: Option<String>,
    /// Whether a `%` is open.
    pub(super) bracketed: bool,
    pub(super) ended: bool,
}

/// Reads a whole file.
pub(super) fn read<'a>(
    name: &'a str,
    bytes: &'a [u8],
    list: Option<&'a ApertureList>,
    options: &Options,
) -> Result<Image, Error> {
    if !looks_like(bytes) {
        let what = if bytes.iter().all(|&b| is_blank(b)) {
            "the file is empty"
        } else {
            "this is not a Gerber file"
        };
        return Err(Error::content(
            name,
            what,
            "expected commands that end with `*`, such as `%FSLAX46Y46*%`",
        ));
    }
    let begin = |reading: Reading| {
        let mut reader = Reader::new(name, bytes, options);
        reader.reading = reading;
        if let Some(list) = list {
            reader.take_list(list);
        }
        reader
    };
    let mut reader = begin(Reading::USUAL);
    let mut drawn = reader.all();
    let reading = reader.reading_by_evidence();
    if reading != Reading::USUAL {
        reader = begin(reading);
        drawn = reader.all();
    }
    drawn?;
    reader.finish()
}

impl<'a> Reader<'a> {
    fn new(name: &'a str, bytes: &'a [u8], options: &Options) -> Self {
        Self {
            name,
            bytes,
            list: None,
            lexer: Lexer::new(bytes),
            warnings: Warnings::new(name, bytes),
            unit: None,
            unit_by_mode: false,
            unit_guessed: false,
            is_beyond: false,
            format: None,
            apertures: FxHashMap::default(),
            malformed: Vec::new(),
            macros: FxHashMap::default(),
            canvas: Canvas::new(options.features, options.vertices),
            attributes: Attributes::new(),
            polarity: Polarity::Dark,
            mirror: (false, false),
            rotation: 0.0,
            scale: 1.0,
            placement: Placement::new(),
            negative: None,
            forms: FxHashMap::default(),
            position: Point::default(),
            aperture: None,
            form: None,
            set: None,
            interpolation: Interpolation::Linear,
            quadrants: None,
            reading: Reading::USUAL,
            radii: Default::default(),
            operation: None,
            region: None,
            counts: Counts::default(),
            generator: None,
            bracketed: false,
            ended: false,
        }
    }

    /// Carries out all blocks.
    fn all(&mut self) -> Result<(), Error> {
        while let Some(block) = self.lexer.next() {
            self.block(block)?;
            if self.ended {
                break;
            }
        }
        Ok(())
    }

    /// An error at `place`.
    pub(super) fn error(
        &self,
        place: Range<usize>,
        what: impl Into<String>,
        expected: impl Into<String>,
        hint: &str,
    ) -> Error {
        Error::syntax(self.name, self.bytes, place, what, expected, hint)
    }

    /// The error for an object that the canvas refuses.
    pub(super) fn refused(&self, place: Range<usize>, refusal: &Refusal) -> Error {
        let (what, expected) = refusal.describe();
        self.error(place, what, expected, "")
    }

    pub(super) fn block(&mut self, block: Block<'a>) -> Result<(), Error> {
        let place = block.place();
        match block.end {
            End::Star => {}
            End::Percent => {
                self.warnings.add(
                    &diagnostic::MISSING_STAR,
                    place,
                    "a command does not end with `*`; it is read as if it did",
                );
            }
            End::File if block.text.trim_ascii() == b"M02" || block.text.trim_ascii() == b"M00" => {
                self.warnings.add(&diagnostic::MISSING_STAR, place, "the last command does not end with `*`");
            }
            End::File if block.text.trim_ascii_end().is_empty() => return Ok(()),
            End::File => {
                let message =
                    "the file ends in the middle of a command, which is ignored: it may be truncated";
                self.warnings.add(&diagnostic::TRUNCATED_FILE, place, message);
                return Ok(());
            }
        }
        let extended = matches!(block.text, [b'A'..=b'Z', b'A'..=b'Z', ..]);
        self.bracketed ^= block.percents % 2 == 1;
        if extended != self.bracketed {
            let message = "a `%` is missing before or after this command; it is read as if it were there";
            self.warnings.add(&diagnostic::MISSING_PERCENT, block.place(), message);
            self.bracketed = extended;
        }
        if extended { self.extended(block) } else { self.words(block.text, &block) }
    }

    /// A block of words: `G01X10Y20D01`.
    pub(super) fn words(&mut self, text: &'a [u8], block: &Block<'a>) -> Result<(), Error> {
        let mut words = Words::default();
        let (mut at, mut drawn) = (0, false);
        // Whether an operation has come after its coordinates: more of them begin another, without
        // a `*` between.
        let mut complete = false;
        while let Some(&letter) = text.get(at) {
            if is_blank(letter) {
                at += 1;
                continue;
            }
            if let Some(comment) = comment(&text[at..]) {
                self.comment(comment);
                break;
            }
            let start = block.start + at;
            let Some((number, length)) = Number::read(&text[at + 1..]) else {
                return self.not_a_word(text, at, block);
            };
            let place = start..start + 1 + length;
            let letter = letter.to_ascii_uppercase();
            if complete && letter != b'M' {
                let message = "a command does not end with `*`; it is read as if it did";
                self.warnings.add(&diagnostic::MISSING_STAR, place.clone(), message);
                self.operate(words, block)?;
                (words, drawn, complete) = (Words::default(), false, false);
            }
            match letter {
                b'X' => words.x = Some(number),
                b'Y' => words.y = Some(number),
                b'I' => words.i = Some(number),
                b'J' => words.j = Some(number),
                b'D' => {
                    words.operation = self.d_code(number, &place)?.or(words.operation);
                    complete = drawn && words.operation.is_some();
                }
                b'G' => self.g_code(number, &place)?,
                b'M' => self.m_code(number, &place),
                b'N' => {}
                _ => return self.not_a_word(text, at, block),
            }
            drawn |= matches!(letter, b'X' | b'Y' | b'I' | b'J');
            at += 1 + length;
        }
        if drawn || words.operation.is_some() { self.operate(words, block) } else { Ok(()) }
    }

    /// A block that begins well enough to be looked at, but holds something that is no word.
    pub(super) fn not_a_word(&mut self, text: &[u8], at: usize, block: &Block<'a>) -> Result<(), Error> {
        let start = block.start + at;
        let place = start..start + (text.len() - at).max(1);
        if at == 0 && !matches!(text[0], b'X' | b'Y' | b'D' | b'G' | b'I' | b'J') {
            let shown = printable(&text[..text.len().min(20)]);
            let message = format!("`{shown}` is not a known command; it is ignored");
            self.warnings.add(&diagnostic::UNKNOWN_COMMAND, place, message);
            return Ok(());
        }
        Err(self.error(place, "this is not a command", "a letter and a number, as in `X1500`", ""))
    }

    pub(super) fn comment(&mut self, text: &[u8]) {
        let text = text.trim_ascii();
        if let Some(attribute) = text.strip_prefix(b"#@!") {
            let changes = self.attributes.command(attribute.trim_ascii());
            if changes {
                self.set = None;
            }
        } else if self.generator.is_none() && text.len() < 200 {
            const NAMES: [&str; 13] = [
                "kicad",
                "pcbnew",
                "eagle",
                "easyeda",
                "altium",
                "protel",
                "geda",
                "pcb,",
                "orcad",
                "diptrace",
                "fritzing",
                "upverter",
                "created by",
            ];
            let shown = printable(text);
            let lower = shown.to_lowercase();
            if NAMES.iter().any(|name| lower.contains(name)) {
                self.generator = Some(shown);
            }
        }
    }
}

/// What G04 says; none for another word. Not read as a number, because a comment may begin with
/// digits.
fn comment(text: &[u8]) -> Option<&[u8]> {
    let rest = text.strip_prefix(b"G04").or_else(|| text.strip_prefix(b"G4"))?;
    (!rest.first().is_some_and(u8::is_ascii_digit)).then_some(rest)
}
