//! Pictures → copper and holes: scans, toner-transfer artwork, pictures from other programs.
//!
//! ```text
//!  bytes ─ decode ─▶ one value a pixel ─ vectorize ─▶ contours ─ dots ─▶ holes, copper
//!             └ resolution ──────────────────────────────┘ pixels to nanometres
//! ```
//!
//! A picture is seen from the front. Its lower left corner is zero. The contours run where the
//! interpolated picture passes midway between the two classes that Otsu's method finds, so that
//! greys at an edge place it within a pixel; they become as few straight lines as the pixels leave
//! open.

mod decode;
mod dots;
mod resolution;

use std::collections::BTreeMap;

use crate::board::{Axis, Feature, Hole, Shape, Source, Warning, Words, polarity};
use crate::geometry::{Nm, Point, Polygon};
use crate::vectorize::{self, Contour, Field, Inside, Level};

use super::diagnostic;
use super::error::Error;

use decode::Decoded;

pub use decode::{DECODER, is_picture};

/// Which pixels of a picture are copper.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colour {
    /// Those of which there are fewer.
    #[default]
    Rarer,
    /// The dark ones.
    Dark,
    /// The light ones.
    Light,
}

/// What a person says of a picture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Pixels to the inch, whatever the file says.
    pub dpi: Option<f64>,
    /// The same where the file does not say.
    pub dpi_unless_said: Option<f64>,
    /// The width of the whole picture.
    pub width: Option<Nm>,
    /// Which pixels are copper.
    pub colour: Colour,
    /// Whether it is the others after all.
    pub invert: bool,
    /// The area in mm² below which specks of copper and holes in it are left out.
    pub despeckle: f64,
    /// The part that is read: left, top, width and height in pixels.
    pub crop: Option<[u32; 4]>,
    /// The most pixels that are decoded, where it is not what memory allows.
    pub most_pixels: Option<u64>,
}

/// A picture, read.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The copper.
    pub features: Vec<Feature>,
    /// The drill dots.
    pub holes: Vec<Hole>,
    /// What is known of the file; its role is for the caller to fill in.
    pub source: Source,
    /// What was guessed or left out.
    pub warnings: Vec<Warning>,
}

/// The most points of contours. Chosen: a board of a thousand pads at 2400 DPI has a million.
const MOST_POINTS: usize = 20_000_000;
/// The most contours. Chosen: noise has more.
const MOST_CONTOURS: usize = 50_000;
/// How much of the variance must lie between two colours. Measured: artwork and scans of it have
/// 0.93 and more, photos of boards 0.85 and less.
const SEPARATION: f64 = 0.9;

/// Reads the picture `name` with content `bytes`.
///
/// # Errors
///
/// [`Error`] for what is no picture, is broken or too large, does not say how large a pixel is, or
/// shows no two colours that tell copper from bare board.
pub fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Picture, Error> {
    let decoded = decode::decode(name, bytes, options)?;
    let scale = Scale::of(name, &decoded, options)?;
    let level = two_colours(name, &decoded.field)?;
    let mut warnings = Vec::new();
    let is_high = copper_is_high(&level, decoded.is_bright, options, &mut warnings);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "means of samples")]
    let bare = if is_high { level.low as u16 } else { level.high as u16 };
    let inside = Inside::new(level.middle, is_high, bare);
    let traced = vectorize::contours(&decoded.field, inside, MOST_POINTS);
    let contours = traced.filter(|contours| contours.len() <= MOST_CONTOURS).ok_or_else(|| {
        let what = "it has too many specks for artwork: noise, or a photo";
        Error::content(
            name,
            what,
            Words::of("scan or draw the copper in two colours, or cut a part out with {crop}"),
        )
    })?;
    let contours = scale.without_specks(contours, options.despeckle, &mut warnings);
    let (dots, contours) = dots::part(contours, &decoded.field, inside, &scale);
    let copper = straightened(&contours, &scale, tolerance(&decoded.field, &level));
    if copper.is_empty() {
        let hint = Words::of(
            "set the colour of copper with {copper} dark or {copper} light, or leave {despeckle} out",
        );
        return Err(Error::content(name, "no copper is left of the picture", hint));
    }
    let feature =
        |polygon| Feature { shape: Shape::Polygon(polygon), axis: Axis::Region, attributes: 0, line: 1 };
    let features: Vec<Feature> = copper.into_iter().map(feature).collect();
    let source = source(name, bytes, &decoded, &scale, features.len(), dots.len());
    Ok(Picture { features, holes: dots, source, warnings })
}

/// The pixels of a picture as they are: no contours, no drill dots taken out.
#[derive(Clone, Debug)]
pub struct Pixels {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// How wide one is.
    pub pixel: Nm,
    /// Which are copper, row by row from the top.
    pub is_copper: Vec<bool>,
}

/// Reads the pixels of the picture `name` with content `bytes`.
///
/// # Errors
///
/// As [`read`] for the same picture.
pub fn pixels(name: &str, bytes: &[u8], options: &Options) -> Result<Pixels, Error> {
    let decoded = decode::decode(name, bytes, options)?;
    let scale = Scale::of(name, &decoded, options)?;
    let level = two_colours(name, &decoded.field)?;
    let is_high = copper_is_high(&level, decoded.is_bright, options, &mut Vec::new());
    let field = &decoded.field;
    let is_copper = field.samples().iter().map(|&sample| (sample > level.middle) == is_high).collect();
    let pixel = Nm::from_f64(f64::midpoint(scale.pixel.0, scale.pixel.1));
    Ok(Pixels { width: field.width(), height: field.height(), pixel, is_copper })
}

/// The two classes of a picture's pixels, well apart.
fn two_colours(name: &str, field: &Field) -> Result<Level, Error> {
    let Some(level) = vectorize::level(field) else {
        let what = "the picture has only one colour: there is no copper or no bare board";
        return Err(Error::content(name, what, "check that it is the right file"));
    };
    if level.separation < SEPARATION {
        let what = format!(
            "the picture does not have two clear colours ({:.0} % of its contrast lies between two, at least {:.0} % is needed): \
             a photo, or a scan with shadows",
            level.separation * 100.0,
            SEPARATION * 100.0
        );
        return Err(Error::content(
            name,
            what,
            Words::of("scan the artwork flat, in black and white, or cut shadows off with {crop}"),
        ));
    }
    Ok(level)
}

/// Whether copper has the higher samples; a guess is said.
fn copper_is_high(level: &Level, is_bright: bool, options: &Options, warnings: &mut Vec<Warning>) -> bool {
    let told = match options.colour {
        Colour::Rarer => None,
        Colour::Dark => Some(!is_bright),
        Colour::Light => Some(is_bright),
    };
    let is_high = told.unwrap_or_else(|| {
        let is_high = level.share < 0.5;
        let share = if is_high { level.share } else { 1.0 - level.share };
        let colour = if is_high == is_bright { "light" } else { "dark" };
        let message =
            format!("copper is assumed to be the {colour} part, {:.0} % of the picture", share * 100.0);
        warnings.push(diagnostic::PICTURE_COLOUR_GUESSED.warning(message));
        is_high
    });
    is_high != options.invert
}

/// How far a straight line may leave the points of a contour, in pixels: half of one where pixels
/// are of two values, less where greys at the edges tell more.
#[expect(clippy::cast_precision_loss, reason = "counts of pixels")]
fn tolerance(field: &Field, level: &Level) -> f64 {
    let fifth = (level.high - level.low) / 5.0;
    let between = |&&sample: &&u16| {
        let sample = f64::from(sample);
        sample > level.low + fifth && sample < level.high - fifth
    };
    let greys = field.samples().iter().filter(between).count() as f64;
    let twos = field.samples().windows(2).filter(|pair| {
        let middle = f64::from(level.middle);
        (f64::from(pair[0]) > middle) != (f64::from(pair[1]) > middle)
    });
    if greys > twos.count() as f64 * 0.5 { 0.25 } else { 0.51 }
}

/// The areas of contours made of few straight lines: finer ones where those would join or part
/// pieces.
fn straightened(contours: &[Contour], scale: &Scale, tolerance: f64) -> Vec<Polygon> {
    let expected = contours.iter().filter(|contour| scale.area(contour) > 0.0).count();
    let made = |tolerance: f64| {
        let ring = |contour: &Contour| -> Vec<Point> {
            let few = if tolerance > 0.0 {
                vectorize::straighten(&contour.points, tolerance)
            } else {
                contour.points.clone()
            };
            few.into_iter().map(|p| scale.point(p)).collect()
        };
        polarity::clean(&contours.iter().map(ring).collect::<Vec<_>>())
    };
    let tries = [tolerance, tolerance / 2.0].into_iter().map(made);
    let fitting = tries.into_iter().find(|polygons| polygons.len() == expected);
    fitting.unwrap_or_else(|| made(0.0))
}

/// Where pixels lie on the board.
struct Scale {
    /// Nanometres a pixel, across and down.
    pixel: (f64, f64),
    /// Rows of the picture: y points up on the board.
    height: f64,
}

/// The widest picture, in millimetres. Chosen: beyond any board.
const WIDEST: f64 = 1000.0;

impl Scale {
    #[expect(clippy::cast_precision_loss, reason = "a picture is less than 2¹⁶ pixels wide")]
    fn of(name: &str, decoded: &Decoded, options: &Options) -> Result<Self, Error> {
        const INCH: f64 = 25.4e6;
        let (columns, rows) = (decoded.field.width() as f64, decoded.field.height() as f64);
        let dpi = match (options.dpi, options.width) {
            (Some(dpi), _) => Some((dpi, dpi)),
            (None, Some(width)) => {
                let dpi = columns / width.to_f64().max(1.0) * INCH;
                Some((dpi, dpi))
            }
            (None, None) => decoded.dpi.or(options.dpi_unless_said.map(|dpi| (dpi, dpi))),
        };
        let Some((x, y)) = dpi.filter(|(x, y)| x.min(*y) > 0.0) else {
            return Err(Error::content(
                name,
                "the picture has no resolution (DPI)",
                Words::of(
                    "set it: {picture-dpi} 600 (`mill` takes {dpi} 600 too), or {picture-width} 80mm for the whole picture",
                ),
            ));
        };
        let scale = Self { pixel: (INCH / x, INCH / y), height: rows };
        let (width, height) = (columns * scale.pixel.0 / 1e6, rows * scale.pixel.1 / 1e6);
        if width.max(height) > WIDEST {
            let what =
                format!("at {x:.0} DPI the picture is {width:.0} × {height:.0} mm: no board is that large");
            return Err(Error::content(name, what, Words::of("set the resolution: {picture-dpi} 600")));
        }
        Ok(scale)
    }

    /// The place of a point of the picture.
    fn nanometres(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x * self.pixel.0, (self.height - y) * self.pixel.1)
    }

    fn point(&self, p: (f64, f64)) -> Point {
        let (x, y) = self.nanometres(p);
        Point::from_f64(x, y)
    }

    /// The area inside a contour in mm²; negative for a hole.
    fn area(&self, contour: &Contour) -> f64 {
        let ends = contour.points.iter().zip(contour.points.iter().cycle().skip(1));
        let twice: f64 = ends.map(|(a, b)| b.0 * a.1 - a.0 * b.1).sum();
        twice / 2.0 * self.pixel.0 * self.pixel.1 / 1e12
    }

    /// Contours without those of less than `least` mm²; a warning for specks that are left.
    fn without_specks(
        &self,
        contours: Vec<Contour>,
        least: f64,
        warnings: &mut Vec<Warning>,
    ) -> Vec<Contour> {
        /// What is so small is no copper that was drawn. Chosen: four pixels.
        const SPECK: f64 = 4.0;
        let kept: Vec<Contour> =
            contours.into_iter().filter(|contour| self.area(contour).abs() >= least).collect();
        let pixel = self.pixel.0 * self.pixel.1 / 1e12;
        let specks: Vec<&Contour> =
            kept.iter().filter(|contour| self.area(contour).abs() < SPECK * pixel).collect();
        if let Some(first) = specks.first() {
            let message =
                format!("{} specks of less than four pixels are read as copper or bare board", specks.len());
            let at = first.points.first().map(|&p| self.point(p)).unwrap_or_default();
            warnings.push(diagnostic::PICTURE_SPECKS.warning(message).at(at));
        }
        kept
    }
}

fn source(name: &str, bytes: &[u8], decoded: &Decoded, scale: &Scale, islands: usize, dots: usize) -> Source {
    let (x, y) = (25.4e6 / scale.pixel.0, 25.4e6 / scale.pixel.1);
    let sha256 = super::digest::sha256(bytes);
    Source {
        file: name.to_owned(),
        format: format!("picture-{}", decoded.format),
        role: String::new(),
        units: "pixel".to_owned(),
        number_format: format!(
            "{} × {} pixels, {x:.2} × {y:.2} DPI",
            decoded.field.width(),
            decoded.field.height()
        ),
        design: sha256.clone(),
        sha256,
        bytes: bytes.len() as u64,
        counts: BTreeMap::from([("regions".to_owned(), islands as u64), ("holes".to_owned(), dots as u64)]),
        generator: None,
        apertures: Vec::new(),
    }
}
