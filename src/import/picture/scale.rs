//! Where pixels lie on the board: how large they are, and how the picture is turned.

use crate::board::{Warning, Words};
use crate::geometry::Point;
use crate::import::diagnostic;
use crate::import::error::Error;
use crate::vectorize::Contour;

use super::Options;
use super::decode::Decoded;
use super::motion::{Motion, Place};

/// An inch in nanometres.
pub(super) const INCH: f64 = 25.4e6;

/// The widest picture, in millimetres. Chosen: beyond any board.
const WIDEST: f64 = 1000.0;

/// Where pixels lie on the board.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Nanometres a pixel, across and down.
    pub(super) pixel: (f64, f64),
    /// Rows of the picture: y points up on the board.
    pub(super) height: f64,
    /// How the picture is turned and shifted on the board, where it is.
    pub(super) motion: Option<Motion>,
}

impl Scale {
    /// By what a person or the file says.
    pub(super) fn of(name: &str, decoded: &Decoded, options: &Options) -> Result<Self, Error> {
        let dpi = match (options.dpi, options.width) {
            (Some(dpi), _) => Some((dpi, dpi)),
            (None, Some(width)) => {
                let dpi = f64::from(decoded.whole) / width.to_f64().max(1.0) * INCH;
                Some((dpi, dpi))
            }
            (None, None) => decoded.dpi.or(options.dpi_unless_said.map(|dpi| (dpi, dpi))),
        };
        let Some((x, y)) = dpi.filter(|(x, y)| x.min(*y) > 0.0) else {
            return Err(Error::content(
                name,
                "the picture has no resolution (DPI)",
                Words::of(
                    "set it: {picture-dpi} 600 (`mill` takes {dpi} 600 too), {picture-width} 80mm for the whole picture, or {picture-pitch} 2.54mm for the grid of its drill dots",
                ),
            ));
        };
        Self::new(name, decoded, (INCH / x, INCH / y))
    }

    /// With pixels of so many nanometres.
    pub(super) fn new(name: &str, decoded: &Decoded, pixel: Place) -> Result<Self, Error> {
        let (columns, rows) = decoded.field.size();
        let (width, height) = (columns * pixel.0 / 1e6, rows * pixel.1 / 1e6);
        if width.max(height) > WIDEST {
            let dpi = INCH / pixel.0;
            let what =
                format!("at {dpi:.0} DPI the picture is {width:.0} × {height:.0} mm: no board is that large");
            return Err(Error::content(name, what, Words::of("set the resolution: {picture-dpi} 600")));
        }
        Ok(Self::of_pixels(decoded, pixel))
    }

    /// With pixels of any size.
    pub(super) const fn of_pixels(decoded: &Decoded, pixel: Place) -> Self {
        Self { pixel, height: decoded.field.size().1, motion: None }
    }

    /// Pixels to the inch, across and down.
    pub(super) fn dpi(&self) -> Place {
        (INCH / self.pixel.0, INCH / self.pixel.1)
    }

    /// The longer side of a pixel.
    pub(super) const fn longer(&self) -> f64 {
        self.pixel.0.max(self.pixel.1)
    }

    /// The place of a point of the picture, as the picture lies.
    pub(super) fn nanometres(&self, (x, y): (f64, f64)) -> Place {
        (x * self.pixel.0, (self.height - y) * self.pixel.1)
    }

    /// The place of a point of the picture, as the board lies.
    pub(super) fn point(&self, p: (f64, f64)) -> Point {
        let place = self.nanometres(p);
        let (x, y) = self.motion.map_or(place, |motion| motion.place(place));
        Point::from_f64(x, y)
    }

    /// The same, moved.
    #[must_use]
    pub(super) fn moved(self, motion: Motion) -> Self {
        Self { motion: Some(self.motion.map_or(motion, |first| motion.after(first))), ..self }
    }

    /// The area inside a contour in mm²; negative for a hole.
    pub(super) fn area(&self, contour: &Contour) -> f64 {
        let ends = contour.points.iter().zip(contour.points.iter().cycle().skip(1));
        let twice: f64 = ends.map(|(a, b)| b.0 * a.1 - a.0 * b.1).sum();
        twice / 2.0 * self.pixel.0 * self.pixel.1 / 1e12
    }

    /// Contours without those of less than `least` mm²; a warning for specks that are left.
    pub(super) fn without_specks(
        &self,
        contours: Vec<Contour>,
        least: f64,
        warnings: &mut Vec<Warning>,
    ) -> Vec<Contour> {
        /// What is so small is no copper that was drawn. Chosen: four pixels.
        const SPECK: f64 = 4.0;
        /// What is no wider, in pixels, is a line whose pieces may touch at corners alone. Chosen:
        /// pixels one after another have less.
        const THIN: f64 = 1.0;
        let kept: Vec<Contour> =
            contours.into_iter().filter(|contour| self.area(contour).abs() >= least).collect();
        let pixel = self.pixel.0 * self.pixel.1 / 1e12;
        let is_speck = |contour: &&Contour| {
            let area = self.area(contour).abs() / pixel;
            area < SPECK || 2.0 * area < THIN * contour.length()
        };
        let specks: Vec<&Contour> = kept.iter().filter(is_speck).collect();
        if let Some(first) = specks.first() {
            let message = format!(
                "{} specks of less than four pixels, or lines no wider than one, are read as copper or bare board",
                specks.len()
            );
            let at = first.points.first().map(|&p| self.point(p)).unwrap_or_default();
            warnings.push(diagnostic::PICTURE_SPECKS.warning(message).at(at));
        }
        kept
    }
}
