//! The graphics state (specification §4), which commands change and draw with.

use std::ops::Range;
use std::sync::Arc as Shared;

use crate::board::polarity::Polarity;
use crate::board::{ApertureUse, Axis, FLATTEN, Shape};
use crate::geometry::{Arc, Nm, Point, Turn, Vector};
use crate::import::diagnostic;

use super::aperture::Template;
use super::aperture_list::ApertureList;
use super::apertures::Apertures;
use super::arcs::Arcs;
use super::canvas::{Frame, Refusal};
use super::command::{Command, Interpolation, Operation, Words};
use super::draw;
use super::fault::{Fault, Here};
use super::format::Unit;
use super::numbers::Numbers;
use super::quadrants::Reading;
use super::region::Region;
use super::sink::{Ink, Sink};
use super::transformation::Transformation;

/// The area in mm² that contours may wind round twice without a word. Chosen: a spot of a tenth of
/// a millimetre, in which no tool leaves anything.
const DOUBT: f64 = 0.01;

/// What is in force at one place of a file.
#[derive(Debug)]
pub(super) struct State<'a> {
    numbers: Numbers<'a>,
    apertures: Apertures<'a>,
    transformation: Transformation,
    arcs: Arcs,
    polarity: Polarity,
    interpolation: Interpolation,
    operation: Option<Operation>,
    /// Where the last operation led, in the file's coordinates.
    position: Point,
    region: Option<Region>,
    /// Where IPNEG stands.
    negative: Option<Range<usize>>,
}

impl<'a> State<'a> {
    /// At the beginning of a file, beside which `list` may lie.
    pub(super) fn new(list: Option<&'a ApertureList>, reading: Reading) -> Self {
        Self {
            numbers: Numbers::new(list, reading.unit),
            apertures: Apertures::new(list),
            transformation: Transformation::new(),
            arcs: Arcs::new(reading),
            polarity: Polarity::Dark,
            interpolation: Interpolation::Linear,
            operation: None,
            position: Point::default(),
            region: None,
            negative: None,
        }
    }

    /// Carries out one command.
    pub(super) fn carry_out(
        &mut self,
        command: Command<'a>,
        here: &mut Here<'_, '_>,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        match command {
            Command::Remark(diagnostic, message) => here.warn(diagnostic, message),
            Command::Comment(text) => sink.attributes.comment(text),
            Command::Operate(words) => return self.operate(words, here, sink),
            Command::Select(number) => {
                sink.attributes.forget();
                self.apertures.select(number, here)?;
            }
            Command::Interpolate(interpolation) => self.interpolation = interpolation,
            Command::Region(begins) => {
                self.end_contour(here, sink)?;
                self.region = begins.then(Region::default);
                sink.attributes.forget();
            }
            Command::OldUnit(unit) => self.numbers.set_old_unit(unit, here),
            Command::Quadrants(quadrants) => self.arcs.declare(quadrants),
            Command::Incremental(incremental) => self.numbers.set_incremental(incremental),
            Command::Format(format) => self.numbers.set_format(format, here),
            Command::Unit(unit) => self.numbers.set_unit(unit, here)?,
            Command::Define(definition) => {
                sink.attributes.forget();
                let unit = self.numbers.unit(here);
                self.apertures.define(&definition, unit, sink.attributes.aperture(), here);
            }
            Command::Malformed(number, fault) => {
                sink.attributes.forget();
                self.apertures.keep_malformed(number, fault, here);
            }
            Command::Macro(definition) => self.apertures.define_macro(definition, here),
            Command::OpenBlock(number) => {
                sink.canvas.open(Frame::Block(number))?;
                self.transformation.set_in_block(sink.canvas.is_in_block());
            }
            Command::CloseBlock => {
                let (number, objects) = sink.canvas.close_block().ok_or_else(|| {
                    Fault::new("this closes a block that is not open", "`%ABD12*%` before it")
                })?;
                self.apertures.define_block(number, objects);
                self.transformation.set_in_block(sink.canvas.is_in_block());
                sink.attributes.forget();
            }
            Command::CloseRepeat => {
                sink.canvas.close_repeat()?;
            }
            Command::OpenRepeat(copies, step) => {
                let step = self.numbers.vector(step, here)?;
                let along = [Vector::new(step.x, Nm::ZERO), Vector::new(Nm::ZERO, step.y)];
                let steps = along.map(|step| self.transformation.turning().vector(step));
                sink.canvas.open(Frame::Repeat { copies, steps })?;
            }
            Command::Polarity(polarity) => {
                if self.region.as_ref().is_some_and(Region::is_open) && polarity != self.polarity {
                    let message = "the polarity changes within a contour; it counts from the next one on";
                    here.warn(&diagnostic::POLARITY_IN_REGION, message);
                }
                self.polarity = polarity;
            }
            Command::Transform(change) => {
                self.transformation.change(change);
                self.apertures.forget_form();
            }
            Command::Offset(offset) => self.transformation.set_offset(self.numbers.vector(offset, here)?),
            Command::Negative(negative) => self.negative = negative.then(|| here.place.clone()),
            Command::Attribute(text) => sink.attributes.command(&text),
        }
        Ok(())
    }

    /// D01, D02 and D03 (specification §4.8).
    fn operate(&mut self, words: Words, here: &mut Here<'_, '_>, sink: &mut Sink) -> Result<(), Fault> {
        let operation = words.operation.unwrap_or_else(|| {
            let message = match self.operation {
                Some(_) => "a coordinate without D01, D02 or D03 repeats the previous operation",
                None => "a coordinate without D01, D02 or D03, and none before it, is read as a move (D02)",
            };
            here.warn(&diagnostic::OPERATION_CODE_MISSING, message);
            self.operation.unwrap_or(Operation::Move)
        });
        self.operation = Some(operation);
        let from = self.position;
        let to = self.numbers.point(from, (words.x, words.y), here)?;
        self.position = to;
        match operation {
            Operation::Move => self.end_contour(here, sink),
            Operation::Flash => self.flash(to, here, sink),
            Operation::Draw => self.draw(from, to, words, here, sink),
        }
    }

    fn flash(&mut self, at: Point, here: &mut Here<'_, '_>, sink: &mut Sink) -> Result<(), Fault> {
        if self.region.is_some() {
            here.warn(&diagnostic::FLASH_IN_REGION, "a flash between G36 and G37 is ignored");
            return Ok(());
        }
        let at = self.transformation.point(at)?;
        let number = self.apertures.selected()?;
        let ink = self.ink(here.line, sink);
        if let Template::Block(objects) = &**self.apertures.flash(number) {
            let (objects, linear) = (Shared::clone(objects), self.transformation.of_blocks());
            return Ok(sink.flash_block(&objects, linear, at, ink)?);
        }
        let linear = || self.transformation.of_apertures();
        let form = self.apertures.form(number, linear, &mut sink.canvas)?;
        let shapes = draw::flash(&form, at);
        if shapes.is_empty() {
            here.warn(&diagnostic::NOTHING_DRAWN, format!("D{number} has no area; its flashes are ignored"));
        }
        Ok(sink.draw(shapes, Axis::Flash(at), ink)?)
    }

    fn draw(
        &mut self,
        from: Point,
        to: Point,
        words: Words,
        here: &mut Here<'_, '_>,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let arc = match self.interpolation {
            Interpolation::Linear => None,
            Interpolation::Circular(turn) => self.arc((from, to), turn, words, here)?,
        };
        let (from, to) = (self.transformation.point(from)?, self.transformation.point(to)?);
        if let Some(region) = &mut self.region {
            if !region.is_open() {
                let set = sink.attributes.set(|| None);
                region.begin(from, Ink { polarity: self.polarity, set, line: here.line }, &here.place);
            }
            match arc {
                None => region.line(to),
                Some(arc) => {
                    region.arc(arc);
                    sink.canvas.charge(arc.chords(FLATTEN) as u64)?;
                }
            }
            return Ok(());
        }
        let number = self.apertures.selected()?;
        let ink = self.ink(here.line, sink);
        let linear = || self.transformation.of_apertures();
        let form = self.apertures.form(number, linear, &mut sink.canvas)?;
        self.apertures.draw(number);
        let axis = arc.map_or(Axis::Line(from, to), Axis::Arc);
        draw::check_reach(&form, axis)?;
        let shapes = match arc {
            None => draw::line(&form, from, to),
            Some(arc) => {
                sink.canvas.charge(draw::effort(&form, &arc))?;
                draw::along(&form, arc)
            }
        };
        Ok(sink.draw(shapes, axis, ink)?)
    }

    /// The arc between two places of the file; none where it is a line.
    fn arc(
        &mut self,
        (from, to): (Point, Point),
        turn: Turn,
        words: Words,
        here: &mut Here<'_, '_>,
    ) -> Result<Option<Arc>, Fault> {
        let offset = self.numbers.offset((words.i, words.j), here)?;
        let Some(center) = self.arcs.center((from, to), offset, turn, here) else { return Ok(None) };
        let turn = if self.transformation.mirrors() { turn.reversed() } else { turn };
        let (start, end) = (self.transformation.point(from)?, self.transformation.point(to)?);
        let center = start + self.transformation.vector(center - from);
        Ok(Some(Arc { start, end, center, turn }))
    }

    /// Ends the contour of a region, where one is open (specification §4.10).
    fn end_contour(&mut self, here: &mut Here<'_, '_>, sink: &mut Sink) -> Result<(), Fault> {
        let Some(region) = &mut self.region else { return Ok(()) };
        let reaches = region.all(|p| p.x.abs() <= Nm::MAX && p.y.abs() <= Nm::MAX);
        let Some(contour) = region.finish() else { return Ok(()) };
        let refused = |refusal: Refusal| Fault::from(refusal).at(&contour.place);
        if !reaches {
            return Err(refused(Refusal::Range));
        }
        if contour.tangled {
            return Err(refused(Refusal::Tangled));
        }
        if !contour.closed {
            let message = "the contour of a region is not closed; a straight line closes it";
            here.warnings.add(&diagnostic::REGION_NOT_CLOSED, contour.place.clone(), message);
        }
        if contour.pieces.is_empty() {
            let message = "the contour of a region has no area; it is ignored";
            here.warnings.add(&diagnostic::NOTHING_DRAWN, contour.place, message);
            return Ok(());
        }
        if contour.doubtful > DOUBT {
            let message = format!(
                "the contour of a region winds round {:.3} mm² twice: they are filled here, where other programs \
                 leave them out",
                contour.doubtful
            );
            here.warnings.add(&diagnostic::REGION_WINDS_TWICE, contour.place.clone(), message);
        }
        let shapes = contour.pieces.into_iter().map(Shape::Polygon).collect();
        sink.draw(shapes, Axis::Region, contour.ink)
            .map_err(|refusal| Fault::from(refusal).at(&contour.place))
    }

    /// What is drawn with now, by a command on `line`.
    fn ink(&self, line: u32, sink: &mut Sink) -> Ink {
        let set = sink.attributes.set(|| Some(self.apertures.function()));
        Ink { polarity: self.polarity, set, line }
    }

    /// Whether no aperture is defined so far.
    pub(super) fn is_bare(&self) -> bool {
        self.apertures.are_none()
    }

    /// How what has been read so far asks for the file to be read: the radii of its arcs, and how
    /// large the board is that it draws.
    pub(super) fn reading_by_evidence(&self, sink: &Sink) -> Reading {
        let extent = sink.canvas.bounds().map_or(Nm::ZERO, |bounds| bounds.width().max(bounds.height()));
        let unit = self.numbers.is_too_wide(extent).then_some(Unit::Millimetre);
        Reading { unit, ..self.arcs.reading_by_evidence() }
    }

    /// Ends the file: says what it left open, and closes its region and its repeats.
    pub(super) fn finish(&mut self, here: &mut Here<'_, '_>, sink: &mut Sink) -> Result<(), Fault> {
        self.arcs.explain(here.warnings)?;
        for (place, message) in self.apertures.explain_malformed() {
            here.warnings.add(&diagnostic::MALFORMED_APERTURE, place, message);
        }
        if self.region.is_some() {
            here.warn(&diagnostic::TRUNCATED_FILE, "the file ends within a region, which is closed there");
            self.end_contour(here, sink)?;
        }
        while sink.canvas.innermost().is_some() {
            if !sink.canvas.close_repeat()? {
                sink.canvas.close_block();
                let message = "the file ends within a block (%AB), which is ignored";
                here.warn(&diagnostic::TRUNCATED_FILE, message);
            }
        }
        Ok(())
    }

    /// Where the file says that its image is negative.
    pub(super) const fn negative(&self) -> Option<&Range<usize>> {
        self.negative.as_ref()
    }

    /// The unit and the number format, as people write them.
    pub(super) fn number_names(&self) -> (String, String) {
        self.numbers.names()
    }

    /// How often each aperture was used, by number.
    pub(super) fn aperture_uses(&self) -> Vec<ApertureUse> {
        self.apertures.uses()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::error::Warnings;
    use crate::import::gerber::canvas::{Canvas, Object};
    use crate::import::gerber::definition::Definition;
    use crate::import::gerber::format::Format;
    use crate::import::gerber::lex::{Lexer, Number};
    use crate::import::gerber::transformation::Change;

    /// What these commands draw.
    fn drawn(commands: Vec<Command<'_>>) -> Result<Vec<Object>, Fault> {
        let mut state = State::new(None, Reading::USUAL);
        let mut sink = Sink::new(Canvas::new(100, 1000));
        let (mut warnings, ahead) = (Warnings::new("f", b""), &Lexer::new(b""));
        let mut here = Here { place: 0..0, line: 1, is_bare: false, ahead, warnings: &mut warnings };
        for command in commands {
            state.carry_out(command, &mut here, &mut sink)?;
        }
        Ok(sink.canvas.finish())
    }

    fn flash(x: &str) -> Command<'static> {
        let x = Number::whole(x.as_bytes());
        Command::Operate(Words { x, operation: Some(Operation::Flash), ..Words::default() })
    }

    #[test]
    fn what_is_drawn_depends_on_what_is_in_force_then() {
        let definition = Definition::read(b"D10C,1").map_err(|(_, fault)| fault).expect("an aperture");
        let objects = drawn(vec![
            Command::Format(Format::read(b"LAX33Y33").expect("a format")),
            Command::Unit(Unit::Millimetre),
            Command::Define(definition),
            Command::Select(10),
            flash("2000"),
            Command::Transform(Change::Scale(3.0)),
            Command::Polarity(Polarity::Clear),
            flash("4000"),
        ]);
        let disc = |x: i64, um: i64| Shape::Disc {
            center: Point::new(Nm::from_mm(x), Nm::ZERO),
            radius: Nm::from_um(um),
        };
        let objects: Vec<_> = objects.expect("drawn").into_iter().map(|(f, p)| (f.shape, p)).collect();
        assert_eq!(objects, [(disc(2, 500), Polarity::Dark), (disc(4, 1500), Polarity::Clear)], "two discs");
    }

    #[test]
    fn nothing_is_drawn_without_an_aperture() {
        let format = || Command::Format(Format::read(b"LAX33Y33").expect("a format"));
        assert!(drawn(vec![format(), flash("2000")]).is_err(), "none is selected");
        assert!(drawn(vec![format(), Command::Select(11), flash("2000")]).is_err(), "none is defined");
    }
}
