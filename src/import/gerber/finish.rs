//! The end of a file: what is open is closed, polarity is resolved, and the image is what is left.

use crate::board::polarity::{self, Polarity};
use crate::board::{ApertureUse, Axis, Feature, Shape, Source};
use crate::geometry::{Polygon, Rect};
use crate::import::diagnostic;

use super::super::design;
use super::super::digest::sha256;
use super::super::error::{Error, find, last_line};
use super::Image;
use super::distinct::distinct;
use super::lex::is_blank;
use super::reader::{Aperture, Counts, Reader};
use super::state::{Format, Unit};

impl<'a> Reader<'a> {
    pub(super) fn finish(mut self) -> Result<Image, Error> {
        self.explain_arcs()?;
        self.explain_malformed();
        let end = last_line(self.bytes);
        if self.region.is_some() {
            let message = "the file ends within a region, which is closed there";
            self.warnings.add(&diagnostic::TRUNCATED_FILE, end.clone(), message);
            self.end_contour()?;
        }
        while self.canvas.innermost().is_some() {
            let repeated =
                self.canvas.close_repeat().map_err(|refusal| self.refused(end.clone(), &refusal))?;
            if !repeated {
                self.canvas.close_block();
                self.warnings.add(
                    &diagnostic::TRUNCATED_FILE,
                    end.clone(),
                    "the file ends within a block (%AB), which is ignored",
                );
            }
        }
        if self.ended {
            let rest = &self.bytes[self.lexer.position()..];
            if !rest.iter().all(|&b| is_blank(b) || b == b'%') {
                let place = self.lexer.position()..self.bytes.len();
                self.warnings.add(
                    &diagnostic::TEXT_AFTER_END,
                    place,
                    "what follows the end of the file (M02) is ignored",
                );
            }
        } else {
            let message = "the file does not end with M02; it may be truncated";
            self.warnings.add(&diagnostic::MISSING_END_OF_FILE, end, message);
        }
        self.into_image()
    }

    pub(super) fn into_image(mut self) -> Result<Image, Error> {
        let mut source = self.source();
        let mut objects = distinct(self.canvas.finish());
        if let Some(place) = self.negative.clone()
            && let Some(frame) = objects.iter().map(|(feature, _)| feature.shape.bounds()).reduce(Rect::union)
        {
            let message =
                "a negative image (%IPNEG) has no extent of its own; the bounding box of its objects is used";
            self.warnings.add(&diagnostic::NEGATIVE_IMAGE, place, message);
            for (_, polarity) in &mut objects {
                *polarity = polarity.toggled();
            }
            let shape = Shape::Polygon(Polygon::rectangle(frame));
            let ground = Feature { shape, axis: Axis::Region, attributes: 0, line: 1 };
            objects.insert(0, (ground, Polarity::Dark));
        }
        if self.attributes.negative {
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
        let function = self.attributes.function.clone();
        let attributes = self.attributes.into_sets();
        source.design = design::of_features(&features, &attributes);
        Ok(Image { features, function, attributes, source, warnings: self.warnings.finish() })
    }

    pub(super) fn source(&self) -> Source {
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
            format: match (x2, self.list) {
                (true, _) => "gerber-x2",
                (false, Some(_)) => "gerber-d",
                (false, None) => "gerber-x",
            }
            .to_owned(),
            role: String::new(),
            units: self.unit.map_or("unknown", Unit::name).to_owned(),
            number_format: self.format.map_or_else(|| "unknown".to_owned(), Format::name),
            sha256: sha256(self.bytes),
            design: String::new(),
            bytes: self.bytes.len() as u64,
            counts: counts.into_iter().map(|(name, count)| (name.to_owned(), count)).collect(),
            generator: self.attributes.generator.clone().or_else(|| self.generator.clone()),
            apertures: apertures.collect(),
        }
    }
}
