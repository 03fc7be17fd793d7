//! A file read from its first command to its last, and what is left of it.

use std::ops::Range;

use crate::board::polarity::{self, Polarity};
use crate::board::{Axis, Feature, Shape, Source};
use crate::geometry::{Polygon, Rect};
use crate::import::design;
use crate::import::diagnostic;
use crate::import::digest::sha256;
use crate::import::error::{Error, Warnings, find, last_line};

use super::aperture_list::ApertureList;
use super::canvas::Canvas;
use super::command::Said;
use super::distinct::distinct;
use super::fault::{Fault, Here};
use super::lex::is_blank;
use super::parser::Parser;
use super::quadrants::Reading;
use super::sink::Sink;
use super::state::State;
use super::{Image, Options, looks_like};

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
    let begin = |reading: Reading| Reader::new(name, bytes, list, options, reading);
    let mut reader = begin(Reading::USUAL);
    let mut drawn = reader.all();
    let reading = reader.state.reading_by_evidence(&reader.sink);
    if reading != Reading::USUAL {
        reader = begin(reading);
        drawn = reader.all();
    }
    drawn.and_then(|()| reader.finish()).map_err(|fault| fault.error(name, bytes))?;
    reader.into_image()
}

/// Reads one file.
struct Reader<'a> {
    name: &'a str,
    bytes: &'a [u8],
    list: Option<&'a ApertureList>,
    warnings: Warnings<'a>,
    parser: Parser<'a>,
    state: State<'a>,
    sink: Sink,
}

impl<'a> Reader<'a> {
    fn new(
        name: &'a str,
        bytes: &'a [u8],
        list: Option<&'a ApertureList>,
        options: &Options,
        reading: Reading,
    ) -> Self {
        let mut warnings = Warnings::new(name, bytes);
        if let Some(list) = list
            && let Some(unit) = list.guessed
        {
            let message = format!(
                "the aperture list {} does not declare its unit; its sizes are read as {unit}",
                list.file
            );
            warnings.add(&diagnostic::APERTURE_UNITS_GUESSED, 0..0, message);
        }
        Self {
            name,
            bytes,
            list,
            warnings,
            parser: Parser::new(bytes),
            state: State::new(list, reading),
            sink: Sink::new(Canvas::new(options.features, options.vertices)),
        }
    }

    /// Carries out all commands.
    fn all(&mut self) -> Result<(), Fault> {
        let mut said = Vec::new();
        while let Some(read) = self.parser.read(&mut said) {
            for Said { command, place, line } in said.drain(..) {
                self.at(place, line, |state, here, sink| state.carry_out(command, here, sink))?;
            }
            read?;
        }
        Ok(())
    }

    /// Has something done at a place of the file, where also its fault is unless it says otherwise.
    fn at(
        &mut self,
        place: Range<usize>,
        line: u32,
        action: impl FnOnce(&mut State<'a>, &mut Here<'_, '_>, &mut Sink) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        let (is_bare, ahead, warnings) = (self.state.is_bare(), self.parser.ahead(), &mut self.warnings);
        let mut here = Here { place, line, is_bare, ahead, warnings };
        action(&mut self.state, &mut here, &mut self.sink).map_err(|fault| fault.at(&here.place))
    }

    fn finish(&mut self) -> Result<(), Fault> {
        let end = last_line(self.bytes);
        self.at(end.clone(), 0, State::finish)?;
        let rest = self.parser.ahead().position()..self.bytes.len();
        if !self.parser.has_ended() {
            let message = "the file does not end with M02; it may be truncated";
            self.warnings.add(&diagnostic::MISSING_END_OF_FILE, end, message);
        } else if !self.bytes[rest.clone()].iter().all(|&b| is_blank(b) || b == b'%') {
            let message = "what follows the end of the file (M02) is ignored";
            self.warnings.add(&diagnostic::TEXT_AFTER_END, rest, message);
        }
        Ok(())
    }

    fn into_image(mut self) -> Result<Image, Error> {
        let mut source = self.source();
        let attributes = self.sink.attributes;
        let mut objects = distinct(self.sink.canvas.finish());
        if let Some(place) = self.state.negative()
            && let Some(frame) = objects.iter().map(|(feature, _)| feature.shape.bounds()).reduce(Rect::union)
        {
            let message =
                "a negative image (%IPNEG) has no extent of its own; the bounding box of its objects is used";
            self.warnings.add(&diagnostic::NEGATIVE_IMAGE, place.clone(), message);
            for (_, polarity) in &mut objects {
                *polarity = polarity.toggled();
            }
            let shape = Shape::Polygon(Polygon::rectangle(frame));
            let ground = Feature { shape, axis: Axis::Region, attributes: 0, line: 1 };
            objects.insert(0, (ground, Polarity::Dark));
        }
        if attributes.is_negative() {
            let words = b"FilePolarity,Negative";
            let place = find(self.bytes, words).map_or(0..0, |start| start..start + words.len());
            let message =
                "the file declares negative polarity (.FilePolarity); it is read as drawn, dark is copper";
            self.warnings.add(&diagnostic::NEGATIVE_FILE, place, message);
        }
        let features = polarity::resolve(objects).map_err(|excess| {
            Error::content(self.name, excess.to_string(), "export the layer without clear objects")
        })?;
        if features.is_empty() {
            self.warnings.add(&diagnostic::NOTHING_DRAWN, last_line(self.bytes), "the file draws nothing");
        }
        let function = attributes.function().cloned();
        let attributes = attributes.into_sets();
        source.design = design::of_features(&features, &attributes);
        Ok(Image { features, function, attributes, source, warnings: self.warnings.finish() })
    }

    fn source(&self) -> Source {
        let (units, number_format) = self.state.number_names();
        let format = match (self.sink.attributes.are_of_file(), self.list) {
            (true, _) => "gerber-x2",
            (false, Some(_)) => "gerber-d",
            (false, None) => "gerber-x",
        };
        Source {
            file: self.name.to_owned(),
            format: format.to_owned(),
            role: String::new(),
            units,
            number_format,
            sha256: sha256(self.bytes),
            design: String::new(),
            bytes: self.bytes.len() as u64,
            counts: self.sink.counts(),
            generator: self.sink.attributes.generator(),
            apertures: self.state.aperture_uses(),
        }
    }
}
