//! The graphics state and the commands that draw with it (specification §4).

use std::ops::Range;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::board::polarity::{self, Polarity};
use crate::board::{ApertureUse, Axis, Feature, Shape, Source};
use crate::geometry::{Arc, Nm, Point, Polygon, Rect, Turn, Vector};

use super::super::digest::sha256;
use super::super::error::{Error, Warnings, printable};
use super::aperture::{Form, Template};
use super::aperture_macro::Macro;
use super::attributes::Attributes;
use super::canvas::{Canvas, Refusal, moved};
use super::lex::{Block, End, Lexer, Number, is_blank};
use super::region::Region;
use super::state::{Format, Linear, Placement, Unit};
use super::{Image, Options, draw, looks_like};

/// How far the two radii of an arc may differ before it is mentioned. Chosen: twice the step of the coarsest usual
/// format, 2.3 inches.
const RADII: f64 = 50_800.0;

/// How D01 moves (G01, G02, G03).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Interpolation {
    Linear,
    Circular(Turn),
}

/// How an arc's centre is given (G74, G75).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quadrants {
    /// Offsets without sign, at most a quarter.
    Single,
    /// Offsets with sign, any arc.
    Multi,
}

/// D01, D02, D03.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Operation {
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
    flashes: u64,
    draws: u64,
}

impl Aperture {
    pub(super) fn new(template: Template, function: Option<String>) -> Self {
        Self { template: Rc::new(template), function, flashes: 0, draws: 0 }
    }
}

/// The words of one block that are left for its operation.
#[derive(Clone, Copy, Debug, Default)]
struct Words {
    x: Option<Number>,
    y: Option<Number>,
    i: Option<Number>,
    j: Option<Number>,
    operation: Option<Operation>,
}

/// What has been drawn, by kind.
#[derive(Debug, Default)]
struct Counts {
    flashes: u64,
    strokes: u64,
    arcs: u64,
    regions: u64,
}

/// Reads one file.
pub(super) struct Reader<'a> {
    pub(super) name: &'a str,
    pub(super) bytes: &'a [u8],
    pub(super) lexer: Lexer<'a>,
    pub(super) warnings: Warnings<'a>,
    pub(super) unit: Option<Unit>,
    /// Whether MO gave the unit, rather than G70 or G71.
    pub(super) unit_by_mode: bool,
    pub(super) format: Option<Format>,
    pub(super) apertures: FxHashMap<u32, Aperture>,
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
    pub(super) negative: bool,
    forms: FxHashMap<(u32, [u64; 4]), Rc<Form>>,
    position: Point,
    aperture: Option<u32>,
    /// The form of the aperture under the transformation in force; none after either changed.
    form: Option<Rc<Form>>,
    /// The attribute set of what is drawn now; none after something changed.
    set: Option<u32>,
    interpolation: Interpolation,
    quadrants: Option<Quadrants>,
    operation: Option<Operation>,
    region: Option<Region>,
    counts: Counts,
    generator: Option<String>,
    /// Whether a `%` is open.
    bracketed: bool,
    ended: bool,
}

/// Reads a whole file.
pub(super) fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Image, Error> {
    if !looks_like(bytes) {
        let what =
            if bytes.iter().all(|&b| is_blank(b)) { "the file is empty" } else { "this is no Gerber file" };
        return Err(Error::content(
            name,
            what,
            "expected commands that end with `*`, such as `%FSLAX46Y46*%`",
        ));
    }
    let mut reader = Reader::new(name, bytes, options);
    while let Some(block) = reader.lexer.next() {
        reader.block(block)?;
        if reader.ended {
            break;
        }
    }
    reader.finish()
}

impl<'a> Reader<'a> {
    fn new(name: &'a str, bytes: &'a [u8], options: &Options) -> Self {
        Self {
            name,
            bytes,
            lexer: Lexer::new(bytes),
            warnings: Warnings::new(name, bytes),
            unit: None,
            unit_by_mode: false,
            format: None,
            apertures: FxHashMap::default(),
            macros: FxHashMap::default(),
            canvas: Canvas::new(options.features, options.vertices),
            attributes: Attributes::new(),
            polarity: Polarity::Dark,
            mirror: (false, false),
            rotation: 0.0,
            scale: 1.0,
            placement: Placement::new(),
            negative: false,
            forms: FxHashMap::default(),
            position: Point::default(),
            aperture: None,
            form: None,
            set: None,
            interpolation: Interpolation::Linear,
            quadrants: None,
            operation: None,
            region: None,
            counts: Counts::default(),
            generator: None,
            bracketed: false,
            ended: false,
        }
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

    fn block(&mut self, block: Block<'a>) -> Result<(), Error> {
        let place = block.place();
        match block.end {
            End::Star => {}
            End::Percent => {
                self.warnings.add(
                    "missing-star",
                    place,
                    "a command does not end with `*`; it is read as if it did",
                );
            }
            End::File if block.text.trim_ascii() == b"M02" || block.text.trim_ascii() == b"M00" => {
                self.warnings.add("missing-star", place, "the last command does not end with `*`");
            }
            End::File if block.text.trim_ascii_end().is_empty() => return Ok(()),
            End::File => {
                let message =
                    "the file ends in the middle of a command, which is left out: it may have been cut off";
                self.warnings.add("truncated-file", place, message);
                return Ok(());
            }
        }
        let extended = matches!(block.text, [b'A'..=b'Z', b'A'..=b'Z', ..]);
        self.bracketed ^= block.percents % 2 == 1;
        if extended != self.bracketed {
            let message = "a `%` is missing before or after this; it is read as what it looks like";
            self.warnings.add("missing-percent", block.place(), message);
            self.bracketed = extended;
        }
        if extended { self.extended(block) } else { self.words(block.text, &block) }
    }

    /// A block of words: `G01X10Y20D01`.
    fn words(&mut self, text: &'a [u8], block: &Block<'a>) -> Result<(), Error> {
        let mut words = Words::default();
        let (mut at, mut drawn) = (0, false);
        // Whether an operation has come after its coordinates: more of them begin another, without a `*` between.
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
                self.warnings.add("missing-star", place.clone(), message);
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
    fn not_a_word(&mut self, text: &[u8], at: usize, block: &Block<'a>) -> Result<(), Error> {
        let start = block.start + at;
        let place = start..start + (text.len() - at).max(1);
        if at == 0 && !matches!(text[0], b'X' | b'Y' | b'D' | b'G' | b'I' | b'J') {
            let shown = printable(&text[..text.len().min(20)]);
            let message = format!("`{shown}` is no command that is known; it is left out");
            self.warnings.add("unknown-command", place, message);
            return Ok(());
        }
        Err(self.error(
            place,
            "this is not a command",
            "a letter and a number of at most 18 digits, as in `X1500`",
            "",
        ))
    }

    fn comment(&mut self, text: &[u8]) {
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

    fn d_code(&mut self, number: Number, place: &Range<usize>) -> Result<Option<Operation>, Error> {
        match number.to_integer() {
            Some(1) => Ok(Some(Operation::Draw)),
            Some(2) => Ok(Some(Operation::Move)),
            Some(3) => Ok(Some(Operation::Flash)),
            Some(code @ 10..=0x7fff_ffff) => {
                self.aperture = u32::try_from(code).ok();
                (self.form, self.set) = (None, None);
                if self.aperture.is_none_or(|number| !self.apertures.contains_key(&number)) {
                    let message = format!("aperture D{code} is selected, but not defined");
                    self.warnings.add("undefined-aperture", place.clone(), message);
                }
                Ok(None)
            }
            _ => Err(self.error(
                place.clone(),
                "this is neither an operation nor an aperture",
                "D01 to draw, D02 to move, D03 to flash, or an aperture from D10 on",
                "",
            )),
        }
    }

    fn g_code(&mut self, number: Number, place: &Range<usize>) -> Result<(), Error> {
        match number.to_integer() {
            // G54 selects an aperture and G55 announces a flash: the D code says as much. G00 moves as D02 does.
            Some(0 | 54 | 55) => {}
            Some(1) => self.interpolation = Interpolation::Linear,
            Some(2) => self.interpolation = Interpolation::Circular(Turn::Clockwise),
            Some(3) => self.interpolation = Interpolation::Circular(Turn::CounterClockwise),
            Some(36) => {
                self.end_contour()?;
                self.region = Some(Region::default());
                self.set = None;
            }
            Some(37) => {
                self.end_contour()?;
                self.region = None;
                self.set = None;
            }
            Some(70) => self.old_unit(Unit::Inch, place),
            Some(71) => self.old_unit(Unit::Millimetre, place),
            Some(74) => self.quadrants = Some(Quadrants::Single),
            Some(75) => self.quadrants = Some(Quadrants::Multi),
            Some(mode @ (90 | 91)) => {
                let format = self.format(place)?;
                self.format = Some(Format { incremental: mode == 91, ..format });
            }
            Some(code @ 10..=12) => {
                return Err(self.error(
                    place.clone(),
                    format!("G{code}, scaled interpolation, is not handled"),
                    "G01, G02 or G03",
                    "write the file anew with a tool of this century",
                ));
            }
            _ => {
                let message = "this G code is not known; it is left out";
                self.warnings.add("unknown-command", place.clone(), message);
            }
        }
        Ok(())
    }

    /// G70 and G71, which MO overrides.
    fn old_unit(&mut self, unit: Unit, place: &Range<usize>) {
        if !self.unit_by_mode {
            self.unit = Some(unit);
        } else if self.unit != Some(unit) {
            let message = "G70 or G71 contradicts %MO, which is followed";
            self.warnings.add("conflicting-units", place.clone(), message);
        }
    }

    fn m_code(&mut self, number: Number, place: &Range<usize>) {
        match number.to_integer() {
            Some(0 | 2) => self.ended = true,
            Some(1) => {}
            _ => self.warnings.add(
                "unknown-command",
                place.clone(),
                "this M code is not known; it is left out",
            ),
        }
    }

    /// Carries out D01, D02 or D03.
    fn operate(&mut self, words: Words, block: &Block<'a>) -> Result<(), Error> {
        let place = block.place();
        let operation = match (words.operation, self.operation) {
            (Some(operation), _) => operation,
            (None, Some(operation)) => {
                let message = "a coordinate without D01, D02 or D03 repeats the one before";
                self.warnings.add("operation-code-missing", place.clone(), message);
                operation
            }
            (None, None) => {
                let message = "a coordinate without D01, D02 or D03, and none before it, moves as D02 does";
                self.warnings.add("operation-code-missing", place.clone(), message);
                Operation::Move
            }
        };
        self.operation = Some(operation);
        let from = self.position;
        let to = self.target(words, &place)?;
        self.position = to;
        match operation {
            Operation::Move => self.end_contour(),
            Operation::Flash => self.flash(to, block),
            Operation::Draw => self.draw(from, to, words, block),
        }
    }

    /// Where the operation leads, in the file's coordinates.
    fn target(&mut self, words: Words, place: &Range<usize>) -> Result<Point, Error> {
        let mut to = self.position;
        if let Some(x) = words.x {
            let format = self.format(place)?;
            let base = if format.incremental { to.x } else { Nm::ZERO };
            to.x = base + self.coordinate(x, format.x, place)?;
        }
        if let Some(y) = words.y {
            let format = self.format(place)?;
            let base = if format.incremental { to.y } else { Nm::ZERO };
            to.y = base + self.coordinate(y, format.y, place)?;
        }
        if Nm::try_new(to.x.get()).is_err() || Nm::try_new(to.y.get()).is_err() {
            return Err(self.refused(place.clone(), &Refusal::Range));
        }
        Ok(to)
    }

    fn coordinate(&mut self, number: Number, places: (u32, u32), at: &Range<usize>) -> Result<Nm, Error> {
        let (format, unit) = (self.format(at)?, self.unit(at)?);
        format.coordinate(number, places, unit).ok_or_else(|| {
            self.error(
                at.clone(),
                "this coordinate lies beyond what is handled",
                "coordinates within ±1073.741823 mm",
                "check the number format and the units of the file",
            )
        })
    }

    /// Where `p` of the file lies on the board.
    fn place(&self, p: Point, at: &Range<usize>) -> Result<Point, Error> {
        let p = self.placement.point(p);
        if Nm::try_new(p.x.get()).is_err() || Nm::try_new(p.y.get()).is_err() {
            return Err(self.refused(at.clone(), &Refusal::Range));
        }
        Ok(p)
    }

    fn flash(&mut self, at: Point, block: &Block<'a>) -> Result<(), Error> {
        let place = block.place();
        if self.region.is_some() {
            self.warnings.add("flash-in-region", place, "a flash within G36 and G37 is left out");
            return Ok(());
        }
        let at = self.place(at, &place)?;
        let number = self.selected(&place)?;
        let set = self.set();
        self.counts.flashes += 1;
        let aperture = self.apertures.get_mut(&number).expect("selected");
        aperture.flashes += 1;
        if let Template::Block(objects) = &*aperture.template {
            let (objects, linear) = (Rc::clone(objects), self.linear());
            return self.expand(&objects, linear, at, set, block);
        }
        let form = self.form(number, &place)?;
        let shapes = draw::flash(&form, at);
        if shapes.is_empty() {
            self.warnings.add(
                "nothing-drawn",
                place,
                format!("D{number} has no area; flashes of it are left out"),
            );
            return Ok(());
        }
        self.push_all(shapes, Axis::Flash(at), set, block)
    }

    /// Draws the objects of a block aperture.
    fn expand(
        &mut self,
        objects: &[(Feature, Polarity)],
        linear: Linear,
        at: Point,
        set: u32,
        block: &Block<'a>,
    ) -> Result<(), Error> {
        let way = at - Point::default();
        for (feature, polarity) in objects {
            let mut feature = moved(feature, linear, way);
            if feature.attributes == 0 {
                feature.attributes = set;
            }
            let polarity = if self.polarity == Polarity::Clear { polarity.toggled() } else { *polarity };
            self.canvas.push((feature, polarity)).map_err(|refusal| self.refused(block.place(), &refusal))?;
        }
        Ok(())
    }

    fn draw(&mut self, from: Point, to: Point, words: Words, block: &Block<'a>) -> Result<(), Error> {
        let place = block.place();
        let arc = match self.interpolation {
            Interpolation::Linear => None,
            Interpolation::Circular(turn) => self.arc(from, to, turn, words, &place)?,
        };
        let (from, to) = (self.place(from, &place)?, self.place(to, &place)?);
        if let Some(region) = &mut self.region {
            region.begin(from, block.line, &place);
            match arc {
                None => region.line(to),
                Some(arc) => {
                    region.arc(arc);
                    let cost = arc.chords(crate::board::FLATTEN) as u64;
                    self.canvas.charge(cost).map_err(|refusal| self.refused(place, &refusal))?;
                }
            }
            return Ok(());
        }
        let number = self.selected(&place)?;
        let set = self.set();
        let form = self.form(number, &place)?;
        self.apertures.get_mut(&number).expect("selected").draws += 1;
        let (shapes, axis) = match arc {
            None => {
                self.counts.strokes += 1;
                self.reaches(&form, Rect::new(from, to), &place)?;
                (draw::line(&form, from, to), Axis::Line(from, to))
            }
            Some(arc) => {
                self.counts.arcs += 1;
                self.reaches(&form, arc.bounds(), &place)?;
                let cost = draw::effort(&form, &arc);
                self.canvas.charge(cost).map_err(|refusal| self.refused(place, &refusal))?;
                (draw::along(&form, arc), Axis::Arc(arc))
            }
        };
        self.push_all(shapes, axis, set, block)
    }

    /// Checks that `form`, drawn anywhere in `bounds`, stays in the range of coordinates.
    fn reaches(&self, form: &Form, bounds: Rect, place: &Range<usize>) -> Result<(), Error> {
        let own = match form {
            Form::Disc(_) => return Ok(()),
            Form::Obround { half, radius } => {
                Rect::new(Point::default() - *half, Point::default() + *half).inflate(*radius)
            }
            Form::Area { hull, .. } => match Rect::around(hull.iter().copied()) {
                Some(own) => own,
                None => return Ok(()),
            },
        };
        let low = (bounds.min().x + own.min().x).min(bounds.min().y + own.min().y);
        let high = (bounds.max().x + own.max().x).max(bounds.max().y + own.max().y);
        if low >= Nm::MIN && high <= Nm::MAX {
            return Ok(());
        }
        Err(self.refused(place.clone(), &Refusal::Range))
    }

    fn push_all(&mut self, shapes: Vec<Shape>, axis: Axis, set: u32, block: &Block<'a>) -> Result<(), Error> {
        for shape in shapes {
            let feature = Feature { shape, axis, attributes: set, line: block.line };
            let pushed = self.canvas.push((feature, self.polarity));
            pushed.map_err(|refusal| self.refused(block.place(), &refusal))?;
        }
        Ok(())
    }

    /// The arc from `from` to `to`; none where it is no longer than a point or has no radius, and so is a line.
    fn arc(
        &mut self,
        from: Point,
        to: Point,
        turn: Turn,
        words: Words,
        place: &Range<usize>,
    ) -> Result<Option<Arc>, Error> {
        let format = self.format(place)?;
        let mut offset = Vector::default();
        if let Some(i) = words.i {
            offset.x = self.coordinate(i, format.x, place)?;
        }
        if let Some(j) = words.j {
            offset.y = self.coordinate(j, format.y, place)?;
        }
        let signed = offset.x < Nm::ZERO || offset.y < Nm::ZERO;
        let quadrants = match self.quadrants {
            Some(Quadrants::Single) if !signed => Quadrants::Single,
            Some(Quadrants::Multi) => Quadrants::Multi,
            other => {
                let message = match other {
                    Some(_) => "this arc has a negative offset, so it is read as G75, several quadrants",
                    None => {
                        "neither G74 nor G75 says how arcs are meant; they are read as G75, several quadrants"
                    }
                };
                self.warnings.add("quadrant-mode", place.clone(), message);
                Quadrants::Multi
            }
        };
        if offset == Vector::default() {
            if from != to {
                let message = "an arc without a centre (I and J) is read as a line";
                self.warnings.add("arc-without-centre", place.clone(), message);
            }
            return Ok(None);
        }
        let center = match quadrants {
            Quadrants::Multi => from + offset,
            Quadrants::Single if from == to => return Ok(None),
            Quadrants::Single => single_quadrant(from, to, offset, turn),
        };
        let mismatch = center.distance(from) - center.distance(to);
        if mismatch.abs() > RADII {
            let message = "the start and the end of an arc lie at different distances from its centre; the radius is \
                           changed evenly from one to the other";
            self.warnings.add("arc-radius-mismatch", place.clone(), message);
        }
        let turn = if self.placement.mirrors() { turn.reversed() } else { turn };
        let (start, end) = (self.place(from, place)?, self.place(to, place)?);
        let center = start + self.placement.vector(center - from);
        Ok(Some(Arc { start, end, center, turn }))
    }

    fn end_contour(&mut self) -> Result<(), Error> {
        let Some(region) = &mut self.region else { return Ok(()) };
        let in_range = |p: Point| p.x.abs() <= Nm::MAX && p.y.abs() <= Nm::MAX;
        let reaches = region.all(in_range);
        let Some(contour) = region.finish() else { return Ok(()) };
        if !reaches {
            return Err(self.refused(contour.place, &Refusal::Range));
        }
        if contour.tangled {
            return Err(self.refused(contour.place, &Refusal::Tangled));
        }
        if !contour.closed {
            let message = "the contour of a region does not end where it began; it is closed with a line";
            self.warnings.add("region-not-closed", contour.place.clone(), message);
        }
        if contour.pieces.is_empty() {
            let message = "the contour of a region has no area; it is left out";
            self.warnings.add("nothing-drawn", contour.place, message);
            return Ok(());
        }
        self.counts.regions += 1;
        let set = self.set();
        for piece in contour.pieces {
            let shape = Shape::Polygon(piece);
            let feature = Feature { shape, axis: Axis::Region, attributes: set, line: contour.line };
            let pushed = self.canvas.push((feature, self.polarity));
            pushed.map_err(|refusal| self.refused(contour.place.clone(), &refusal))?;
        }
        Ok(())
    }

    /// The aperture in use, which must be defined.
    fn selected(&mut self, place: &Range<usize>) -> Result<u32, Error> {
        match self.aperture {
            Some(number) if self.apertures.contains_key(&number) => Ok(number),
            _ if self.apertures.is_empty() => Err(self.error(
                place.clone(),
                "this file draws with apertures that it does not define (RS-274-D)",
                "aperture definitions, such as `%ADD10C,0.25*%`",
                "have the file written as RS-274X, with its apertures embedded",
            )),
            Some(number) => Err(self.error(
                place.clone(),
                format!("this draws with aperture D{number}, which is not defined"),
                format!("`%ADD{number}…*%` before it"),
                "",
            )),
            None => Err(self.error(
                place.clone(),
                "this draws without an aperture",
                "an aperture, such as `D10*`, before it",
                "",
            )),
        }
    }

    /// The transformation of apertures in force: mirrored, then rotated, then scaled (specification §4.9).
    fn linear(&self) -> Linear {
        let sign = |mirror: bool| if mirror { -1.0 } else { 1.0 };
        let mirror = Linear::stretch(sign(self.mirror.0), sign(self.mirror.1));
        let scale = Linear::stretch(self.scale, self.scale);
        self.placement.rotation.after(scale).after(Linear::rotation(self.rotation)).after(mirror)
    }

    /// To be called when an aperture or the transformation changed.
    pub(super) fn forget_form(&mut self) {
        self.form = None;
    }

    /// To be called when aperture `number` is defined anew.
    pub(super) fn forget_aperture(&mut self, number: u32) {
        self.forms.retain(|(of, _), _| *of != number);
        (self.form, self.set) = (None, None);
    }

    /// To be called when attributes changed.
    pub(super) fn forget_set(&mut self) {
        self.set = None;
    }

    fn form(&mut self, number: u32, place: &Range<usize>) -> Result<Rc<Form>, Error> {
        if let Some(form) = &self.form {
            return Ok(Rc::clone(form));
        }
        let linear = self.linear();
        let key = (number, linear.bits());
        let form = match self.forms.get(&key) {
            Some(form) => Rc::clone(form),
            None => Rc::new(self.make_form(number, linear, place)?),
        };
        self.forms.insert(key, Rc::clone(&form));
        self.form = Some(Rc::clone(&form));
        Ok(form)
    }

    fn make_form(&mut self, number: u32, linear: Linear, place: &Range<usize>) -> Result<Form, Error> {
        let template = Rc::clone(&self.apertures.get(&number).expect("selected").template);
        if template.reach() * linear.scale() > Nm::MAX.to_f64() {
            return Err(self.refused(place.clone(), &Refusal::Range));
        }
        if template.is_tangled() {
            return Err(self.refused(place.clone(), &Refusal::Tangled));
        }
        self.canvas.charge(template.cost()).map_err(|refusal| self.refused(place.clone(), &refusal))?;
        template.form(linear).ok_or_else(|| {
            let what = format!("D{number} is a block, which cannot be drawn along a line");
            self.error(place.clone(), what, "a flash, D03", "")
        })
    }

    /// The attribute set of what is drawn now.
    fn set(&mut self) -> u32 {
        if let Some(set) = self.set {
            return set;
        }
        let of_region = self.attributes.aperture.clone();
        let function = match (&self.region, self.aperture.and_then(|number| self.apertures.get(&number))) {
            (Some(_), _) => of_region,
            (None, aperture) => aperture.and_then(|aperture| aperture.function.clone()),
        };
        let set = self.attributes.set(function.as_deref());
        self.set = Some(set);
        set
    }

    fn finish(mut self) -> Result<Image, Error> {
        let end = self.bytes.len()..self.bytes.len();
        if self.region.is_some() {
            let message = "the file ends within a region, which is ended there";
            self.warnings.add("truncated-file", end.clone(), message);
            self.end_contour()?;
        }
        while self.canvas.innermost().is_some() {
            let repeated =
                self.canvas.close_repeat().map_err(|refusal| self.refused(end.clone(), &refusal))?;
            if !repeated {
                self.canvas.close_block();
                self.warnings.add(
                    "truncated-file",
                    end.clone(),
                    "the file ends within a block (%AB), which is left out",
                );
            }
        }
        if self.ended {
            let rest = &self.bytes[self.lexer.position()..];
            if !rest.iter().all(|&b| is_blank(b) || b == b'%') {
                let place = self.lexer.position()..self.bytes.len();
                self.warnings.add(
                    "text-after-end",
                    place,
                    "what follows the end of the program (M02) is left out",
                );
            }
        } else {
            let message = "the file does not end with M02; it may have been cut off";
            self.warnings.add("missing-end-of-file", end, message);
        }
        self.into_image()
    }

    fn into_image(mut self) -> Result<Image, Error> {
        let source = self.source();
        let mut objects = self.canvas.finish();
        if self.negative
            && let Some(frame) = objects.iter().map(|(feature, _)| feature.shape.bounds()).reduce(Rect::union)
        {
            let message = "a negative image (%IPNEG) has no extent of its own; its ground is the rectangle round its objects";
            self.warnings.add("negative-image", 0..0, message);
            for (_, polarity) in &mut objects {
                *polarity = polarity.toggled();
            }
            let shape = Shape::Polygon(Polygon::rectangle(frame));
            let ground = Feature { shape, axis: Axis::Region, attributes: 0, line: 1 };
            objects.insert(0, (ground, Polarity::Dark));
        }
        if self.attributes.negative {
            let message = "the file calls its polarity negative (.FilePolarity); it is read as it is drawn, dark for copper";
            self.warnings.add("negative-file", 0..0, message);
        }
        let features = polarity::resolve(objects).map_err(|excess| {
            Error::content(self.name, excess.to_string(), "have the layer written without clear objects")
        })?;
        if features.is_empty() {
            self.warnings.add("nothing-drawn", 0..0, "the file draws nothing");
        }
        Ok(Image {
            features,
            function: self.attributes.function.clone(),
            attributes: self.attributes.into_sets(),
            source,
            warnings: self.warnings.finish(),
        })
    }

    fn source(&self) -> Source {
        let mut numbers: Vec<_> = self.apertures.keys().copied().collect();
        numbers.sort_unstable();
        let apertures = numbers.iter().filter_map(|number| {
            let Aperture { template, flashes, draws, .. } = self.apertures.get(number)?;
            let (name, what) = (format!("D{number}"), template.describe());
            Some(ApertureUse { name, what, flashes: *flashes, draws: *draws })
        });
        let Counts { flashes, strokes, arcs, regions } = self.counts;
        let counts = [("flashes", flashes), ("strokes", strokes), ("arcs", arcs), ("regions", regions)];
        let x2 = self.attributes.function.is_some() || self.attributes.generator.is_some();
        Source {
            file: self.name.to_owned(),
            format: if x2 { "gerber-x2" } else { "gerber-x" }.to_owned(),
            role: String::new(),
            units: self.unit.map_or("unknown", Unit::name).to_owned(),
            number_format: self.format.map_or_else(|| "unknown".to_owned(), Format::name),
            sha256: sha256(self.bytes),
            bytes: self.bytes.len() as u64,
            counts: counts.into_iter().map(|(name, count)| (name.to_owned(), count)).collect(),
            generator: self.attributes.generator.clone().or_else(|| self.generator.clone()),
            apertures: apertures.collect(),
        }
    }
}

/// What G04 says; none for another word. Not read as a number, because a comment may begin with digits.
fn comment(text: &[u8]) -> Option<&[u8]> {
    let rest = text.strip_prefix(b"G04").or_else(|| text.strip_prefix(b"G4"))?;
    (!rest.first().is_some_and(u8::is_ascii_digit)).then_some(rest)
}

/// The centre of an arc of at most a quarter whose offsets carry no sign: of the four places it may be at, the one that
/// both ends are equally far from (specification §8.1.10, G74).
fn single_quadrant(from: Point, to: Point, offset: Vector, turn: Turn) -> Point {
    /// A quarter, and a little for rounded coordinates.
    const QUARTER: f64 = std::f64::consts::FRAC_PI_2 * 1.02;
    let signs = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
    let candidates = signs.map(|(x, y)| from + Vector::new(offset.x * x, offset.y * y));
    let score = |&center: &Point| {
        let arc = Arc { start: from, end: to, center, turn };
        let mismatch = (center.distance(from) - center.distance(to)).abs();
        (arc.sweep().abs() > QUARTER, mismatch)
    };
    candidates
        .into_iter()
        .min_by(|a, b| {
            let (a, b) = (score(a), score(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
        .unwrap_or(from)
}
