//! Pictures → copper and holes: scans, toner-transfer artwork, pictures from other programs.
//!
//! ```text
//!  bytes ─ decode ─▶ one value a pixel ─ vectorize ─▶ contours ─ dots ─▶ holes, copper
//!             └ resolution, or lattice of dots ─── skew ──┘ pixels to nanometres
//! ```
//!
//! A picture is seen from the front. Its lower left corner is zero. One that was turned is turned
//! back about its middle: not its pixels, but the contours found in them. These run where the
//! interpolated picture passes midway between the two classes that Otsu's method finds, so that
//! greys at an edge place it within a pixel; they become as few straight lines as the pixels leave
//! open.

mod decode;
mod dots;
mod lattice;
mod motion;
mod register;
mod resolution;
mod scale;
mod skew;

use std::collections::BTreeMap;

use crate::board::{Axis, Feature, Hole, Shape, Source, Warning, Words, polarity};
use crate::geometry::{Nm, Point, Polygon};
use crate::vectorize::{self, Contour, Field, Inside, Level};

use super::diagnostic;
use super::error::Error;

use decode::Decoded;
use scale::Scale;
use skew::Skew;

pub use decode::{DECODER, is_picture};
pub(super) use motion::Motion;
pub(super) use register::{Registration, register};

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
    /// The grid of its drill dots, by which its resolution is found.
    pub pitch: Option<Nm>,
    /// Whether a picture whose edges run aslant is turned back.
    pub straighten: bool,
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
/// [`Error`] for what is no picture, is broken or too large, does not say how large a pixel is,
/// shows no two colours that tell copper from bare board, or shall be straightened and has no edges
/// that run alike.
pub fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Picture, Error> {
    Traced::read(name, bytes, options)?.picture()
}

/// A picture as the contours of its copper: it may still be moved.
pub(super) struct Traced {
    name: String,
    contours: Vec<Contour>,
    /// Drill dots, as the picture lies.
    dots: Vec<Hole>,
    scale: Scale,
    /// How far a straight line may leave the points of a contour, in pixels.
    tolerance: f64,
    source: Source,
    warnings: Vec<Warning>,
}

impl Traced {
    /// As [`read`], as far as contours go.
    pub(super) fn read(name: &str, bytes: &[u8], options: &Options) -> Result<Self, Error> {
        let decoded = decode::decode(name, bytes, options)?;
        let told = if options.pitch.is_none() { Some(Scale::of(name, &decoded, options)?) } else { None };
        let level = two_colours(name, &decoded.field)?;
        let mut warnings = Vec::new();
        if decoded.pages > 1 {
            let message = "the file has several pages or frames: the first is read";
            warnings.push(diagnostic::PICTURE_PAGES.warning(message));
        }
        let inside = inside(&level, decoded.is_bright, options, &mut warnings);
        let contours = contours(name, &decoded.field, inside)?;
        let tolerance = tolerance(&decoded.field, &level);
        let scale = match told {
            Some(scale) => scale,
            None => by_dots(name, &decoded, inside, &contours, tolerance, options, &mut warnings)?,
        };
        let scale = straight(name, scale, &decoded, &contours, tolerance, options, &mut warnings)?;
        let contours = scale.without_specks(contours, options.despeckle, &mut warnings);
        let (dots, contours) = dots::part(contours, &decoded.field, inside, &scale);
        let source = source(name, bytes, &decoded, &scale);
        Ok(Self { name: name.to_owned(), contours, dots, scale, tolerance, source, warnings })
    }

    /// Its drill dots, as the board lies.
    pub(super) fn dots(&self) -> Vec<Hole> {
        let Some(motion) = self.scale.motion else { return self.dots.clone() };
        let moved = |dot: &Hole| {
            let mut hole = dot.clone();
            hole.path.start = motion.point(hole.path.start);
            hole
        };
        self.dots.iter().map(moved).collect()
    }

    /// The longer side of a pixel, in nanometres.
    pub(super) const fn pixel(&self) -> f64 {
        self.scale.longer()
    }

    /// The same, moved on the board.
    #[must_use]
    pub(super) fn moved(self, motion: &Motion) -> Self {
        let moved = |warning: Warning| Warning { at: warning.at.map(|at| motion.point(at)), ..warning };
        let warnings = self.warnings.into_iter().map(moved).collect();
        Self { scale: self.scale.moved(*motion), warnings, ..self }
    }

    /// The picture, read.
    ///
    /// # Errors
    ///
    /// [`Error`] where no copper is left of it.
    pub(super) fn picture(self) -> Result<Picture, Error> {
        let holes = self.dots();
        let copper = straightened(&self.contours, &self.scale, self.tolerance);
        if copper.is_empty() {
            let hint = Words::of(
                "set the colour of copper with {copper} dark or {copper} light, or leave {despeckle} out",
            );
            return Err(Error::content(&self.name, "no copper is left of the picture", hint));
        }
        let feature =
            |polygon| Feature { shape: Shape::Polygon(polygon), axis: Axis::Region, attributes: 0, line: 1 };
        let features: Vec<Feature> = copper.into_iter().map(feature).collect();
        let counts = [("regions", features.len()), ("holes", holes.len())];
        let counts = counts.into_iter().map(|(what, count)| (what.to_owned(), count as u64)).collect();
        Ok(Picture { features, holes, source: Source { counts, ..self.source }, warnings: self.warnings })
    }
}

/// The contours of what is inside.
fn contours(name: &str, field: &Field, inside: Inside) -> Result<Vec<Contour>, Error> {
    let traced = vectorize::contours(field, inside, MOST_POINTS);
    traced.filter(|contours| contours.len() <= MOST_CONTOURS).ok_or_else(|| {
        let what = "it has too many specks for artwork: noise, or a photo";
        Error::content(
            name,
            what,
            Words::of("scan or draw the copper in two colours, or cut a part out with {crop}"),
        )
    })
}

/// The scale at which the drill dots lie on the grid that was told.
fn by_dots(
    name: &str,
    decoded: &Decoded,
    inside: Inside,
    contours: &[Contour],
    tolerance: f64,
    options: &Options,
    warnings: &mut Vec<Warning>,
) -> Result<Scale, Error> {
    let shape = lattice::shape(decoded);
    let pixels = Scale::of_pixels(decoded, shape);
    let turned = match skew::skew(contours, &pixels, tolerance > GREYS) {
        Skew::Turned(angle, _) | Skew::TooFar(angle) => angle,
        Skew::Unknown => 0.0,
    };
    let upright = Motion::new(-turned, (0.0, 0.0), (0.0, 0.0));
    let dots: Vec<_> = dots::middles(contours, &decoded.field, inside, &pixels)
        .into_iter()
        .map(|p| upright.place(p))
        .collect();
    lattice::scale(name, decoded, shape, &dots, options.pitch.unwrap_or_default(), warnings)
}

/// The scale with the turn that makes edges run along the axes, where that is asked for; else what
/// is to be said of their skew.
fn straight(
    name: &str,
    scale: Scale,
    decoded: &Decoded,
    contours: &[Contour],
    tolerance: f64,
    options: &Options,
    warnings: &mut Vec<Warning>,
) -> Result<Scale, Error> {
    let by_hand = Words::of("turn it in a picture program, and leave {straighten} out");
    let turned = |angle: f64| {
        let way = if angle > 0.0 { "counter-clockwise" } else { "clockwise" };
        format!("{:.3} degrees {way}", angle.to_degrees().abs())
    };
    match skew::skew(contours, &scale, tolerance > GREYS) {
        Skew::Turned(angle, doubt) if options.straighten && angle.abs() < doubt => {
            let doubt = doubt.to_degrees();
            let message = format!("the picture is straight to {doubt:.2} degrees, and stays as it is");
            warnings.push(diagnostic::PICTURE_STRAIGHTENED.warning(message));
            Ok(scale)
        }
        Skew::Turned(angle, _) if options.straighten => {
            let message = format!("the picture was turned by {}, and is turned back", turned(angle));
            warnings.push(diagnostic::PICTURE_STRAIGHTENED.warning(message));
            let (columns, rows) = decoded.field.size();
            let middle = scale.nanometres((columns / 2.0, rows / 2.0));
            Ok(scale.moved(Motion::new(-angle, middle, middle)))
        }
        Skew::Turned(angle, _) if angle.abs() >= skew::SEEN => {
            let message = format!("most edges of the picture are turned by {}", turned(angle));
            warnings.push(diagnostic::PICTURE_SKEWED.warning(message));
            Ok(scale)
        }
        Skew::TooFar(angle) if options.straighten => {
            let what = format!(
                "the picture cannot be straightened: most of its edges are turned by {}, at most 15 degrees can be told from a diagonal",
                turned(angle)
            );
            Err(Error::content(name, what, by_hand))
        }
        Skew::Unknown if options.straighten => {
            let what = "the picture cannot be straightened: too few of its edges run in the same directions, or midway between";
            Err(Error::content(name, what, by_hand))
        }
        Skew::Turned(..) | Skew::TooFar(_) | Skew::Unknown => Ok(scale),
    }
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

/// Reads the pixels of the picture `name` with content `bytes`, as the picture lies.
///
/// # Errors
///
/// As [`read`] for the same picture.
pub fn pixels(name: &str, bytes: &[u8], options: &Options) -> Result<Pixels, Error> {
    let decoded = decode::decode(name, bytes, options)?;
    let level = two_colours(name, &decoded.field)?;
    let inside = inside(&level, decoded.is_bright, options, &mut Vec::new());
    let field = &decoded.field;
    let scale = if options.pitch.is_some() {
        let (contours, tolerance) = (contours(name, field, inside)?, tolerance(field, &level));
        by_dots(name, &decoded, inside, &contours, tolerance, options, &mut Vec::new())?
    } else {
        Scale::of(name, &decoded, options)?
    };
    let is_copper = (0..).take(field.height()).flat_map(|y| (0..).take(field.width()).map(move |x| (x, y)));
    let is_copper = is_copper.map(|(x, y)| inside.depth(field, x, y) > 0).collect();
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

/// Which samples are copper: higher ones or lower ones; a guess is said.
fn inside(level: &Level, is_bright: bool, options: &Options, warnings: &mut Vec<Warning>) -> Inside {
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
    let is_high = is_high != options.invert;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "means of samples")]
    let bare = if is_high { level.low as u16 } else { level.high as u16 };
    Inside::new(level.middle, is_high, bare)
}

/// How far a straight line may leave the points of a contour where greys tell more, in pixels.
/// Chosen.
const GREYS: f64 = 0.25;

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
    if greys > twos.count() as f64 * 0.5 { GREYS } else { 0.51 }
}

/// The areas of contours made of few straight lines: finer ones where those would join or part
/// pieces, or let them touch at a corner.
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
    let fitting = tries.into_iter().find(|polygons| polygons.len() == expected && !have_corner(polygons));
    fitting.unwrap_or_else(|| made(0.0))
}

/// Whether two of some polygons have a corner at the same place.
fn have_corner(polygons: &[Polygon]) -> bool {
    let corners = |(number, polygon): (usize, &Polygon)| -> Vec<(Point, usize)> {
        polygon.contours().iter().flatten().map(|&p| (p, number)).collect()
    };
    let mut all: Vec<(Point, usize)> = polygons.iter().enumerate().flat_map(corners).collect();
    all.sort_unstable();
    all.windows(2).any(|pair| pair[0].0 == pair[1].0 && pair[0].1 != pair[1].1)
}

/// What is known of the file; what is counted in it is for later.
fn source(name: &str, bytes: &[u8], decoded: &Decoded, scale: &Scale) -> Source {
    let (x, y) = scale.dpi();
    let degrees = scale.motion.map_or(0.0, |motion| -motion.degrees());
    let turned = if degrees == 0.0 { String::new() } else { format!(", turned by {degrees:.3} degrees") };
    let sha256 = super::digest::sha256(bytes);
    Source {
        file: name.to_owned(),
        format: format!("picture-{}", decoded.format),
        role: String::new(),
        units: "pixel".to_owned(),
        number_format: format!(
            "{} × {} pixels, {x:.2} × {y:.2} DPI{turned}",
            decoded.field.width(),
            decoded.field.height()
        ),
        design: sha256.clone(),
        sha256,
        bytes: bytes.len() as u64,
        counts: BTreeMap::new(),
        generator: None,
        apertures: Vec::new(),
    }
}
