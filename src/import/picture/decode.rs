//! The pixels of a picture file as one value each: how far along the line of its two colours they
//! are.
//!
//! The `image` crate reads the formats; sizes are judged before anything is decoded.

use crate::board::Words;
use std::io::Cursor;
use std::path::Path;

use image::codecs::gif::GifDecoder;
use image::codecs::webp::WebPDecoder;
use image::{
    AnimationDecoder as _, DynamicImage, GenericImageView as _, ImageDecoder as _, ImageFormat, ImageReader,
    Limits,
};

use super::resolution::{self, resolution};
use super::{Colour, Options};
use crate::import::error::Error;
use crate::vectorize::Field;

/// The formats, with the names that reports have for them.
const FORMATS: &[(ImageFormat, &str)] = &[
    (ImageFormat::Png, "png"),
    (ImageFormat::Bmp, "bmp"),
    (ImageFormat::Jpeg, "jpeg"),
    (ImageFormat::Tiff, "tiff"),
    (ImageFormat::Gif, "gif"),
    (ImageFormat::WebP, "webp"),
    (ImageFormat::Pnm, "pnm"),
];

/// The most pixels: with what it takes to decode and to trace them, below 2 GiB of memory. Chosen.
const MOST_PIXELS: u64 = 1 << 27;
/// The most bytes that a decoder may ask for at once. Chosen.
const MOST_BYTES: u64 = 1 << 30;

/// Pixels as values.
pub(super) struct Decoded {
    pub(super) field: Field,
    /// Whether higher values are brighter; else they are darker.
    pub(super) is_bright: bool,
    /// Pixels to the inch, across and down, where the file says them.
    pub(super) dpi: Option<(f64, f64)>,
    pub(super) format: &'static str,
    /// Columns of the whole picture, of which a part may be all that is read.
    pub(super) whole: u32,
    /// How many pages or frames the file has, of which the first is read.
    pub(super) pages: usize,
}

/// Whether a file is to be read as a picture: by its first bytes, or by its name.
#[must_use]
pub fn is_picture(path: &Path, bytes: &[u8]) -> bool {
    let by_name = ImageFormat::from_path(path).is_ok_and(|format| name_of(format).is_some());
    by_name || format_of(bytes).is_some()
}

fn name_of(format: ImageFormat) -> Option<&'static str> {
    FORMATS.iter().find(|known| known.0 == format).map(|known| known.1)
}

fn format_of(bytes: &[u8]) -> Option<ImageFormat> {
    image::guess_format(bytes).ok().filter(|&format| name_of(format).is_some())
}

/// Decodes a picture, turned upright, or the part of it that is asked for.
pub(super) fn decode(name: &str, bytes: &[u8], options: &Options) -> Result<Decoded, Error> {
    let Some(format) = format_of(bytes) else {
        let what = if bytes.is_empty() { "an empty file, not a picture" } else { "this is not a picture" };
        return Err(Error::content(name, what, "expected a PNG, BMP, JPEG, TIFF, GIF, WebP or PNM file"));
    };
    if format == ImageFormat::Jpeg && !has_end(bytes) {
        let what = "the JPEG is truncated: it has no end";
        return Err(Error::content(name, what, "copy or save the picture again"));
    }
    let decoded = contained(|| {
        let upright = upright(name, bytes, format, options.most_pixels.unwrap_or(MOST_PIXELS))?;
        Ok((upright, pages(bytes, format)))
    });
    let ((mut picture, (width, height)), pages) = decoded.unwrap_or_else(|words| Err(broken(name, words)))?;
    let mut dpi = resolution(bytes, format);
    if picture.dimensions() != (width, height) {
        dpi = dpi.map(|(x, y)| (y, x));
    }
    let whole = picture.width();
    if let Some([left, top, columns, rows]) = options.crop {
        picture = cropped(name, &picture, [left, top, columns, rows])?;
    }
    let (samples, is_bright) = values(&picture, options);
    let width = picture.width() as usize;
    let empty = || Error::content(name, "the picture has no pixels", "check that it is whole");
    let field = Field::new(width, samples).ok_or_else(empty)?;
    Ok(Decoded { field, is_bright, dpi, format: name_of(format).unwrap_or_default(), whole, pages })
}

/// Whether a JPEG has a marker for its end (EOI; ITU-T T.81, B.1.1.3): its decoder fills with grey
/// what is missing. What is in a segment or behind the end is none of its markers: thumbnails, the
/// film that telephones append.
fn has_end(bytes: &[u8]) -> bool {
    let mut at = 2;
    loop {
        // Data of a scan, or fill bytes: no marker is 0, and those to restart belong to the scan.
        let is_marker = |pair: &[u8]| pair[0] == 0xFF && !matches!(pair[1], 0 | 0xD0..=0xD7 | 0xFF);
        let Some(next) = bytes.get(at..).and_then(|rest| rest.windows(2).position(is_marker)) else {
            return false;
        };
        let marker = bytes[at + next + 1];
        at += next + 2;
        if marker == 0xD9 {
            return true;
        }
        let Some(length) = bytes.get(at..at + 2) else { return false };
        at += usize::from(u16::from_be_bytes([length[0], length[1]]));
    }
}

/// The picture as it is to be looked at, and how wide and high it lies in the file.
fn upright(
    name: &str,
    bytes: &[u8],
    format: ImageFormat,
    most: u64,
) -> Result<(DynamicImage, (u32, u32)), Error> {
    let broken = |error: image::ImageError| broken(name, error);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > most {
        let what = format!("{width} × {height} pixels are too many: at most {most} are read");
        return Err(Error::content(name, what, "save it with fewer pixels per inch, or in parts"));
    }
    let orientation = decoder.orientation().map_err(broken)?;
    let mut picture = DynamicImage::from_decoder(decoder).map_err(broken)?;
    picture.apply_orientation(orientation);
    Ok((picture, (width, height)))
}

fn broken(name: &str, why: impl std::fmt::Display) -> Error {
    let what = format!("the picture cannot be read: {why}");
    Error::content(name, what, "save it again, as PNG in black and white")
}

/// The name of the thread on which pictures are decoded. A panic there is an error of the file and
/// is returned as one: a program may keep its own words about it to itself.
pub const DECODER: &str = "picture decoder";

/// What `work` returns; where a decoder meets bytes that its author did not think of and panics,
/// its last words.
fn contained<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, String> {
    let thread = std::thread::Builder::new().name(DECODER.to_owned());
    std::thread::scope(|scope| {
        let decoding = thread.spawn_scoped(scope, work).map_err(|error| error.to_string())?;
        decoding.join().map_err(|panic| {
            let words = panic.downcast_ref::<String>().map(String::as_str);
            let words = words.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
            format!("its decoder failed ({words})")
        })
    })
}

fn cropped(name: &str, picture: &DynamicImage, part: [u32; 4]) -> Result<DynamicImage, Error> {
    let [left, top, columns, rows] = part;
    let (width, height) = picture.dimensions();
    let lies_within =
        |from: u32, count: u32, all: u32| count > 0 && from.checked_add(count).is_some_and(|end| end <= all);
    if !lies_within(left, columns, width) || !lies_within(top, rows, height) {
        let what = Words::of("{crop} {0},{1},{2},{3} does not lie within its {4} × {5} pixels")
            .with([&left, &top, &columns, &rows, &width, &height]);
        return Err(Error::content(
            name,
            what,
            "left, top, width and height, in pixels from the upper left corner",
        ));
    }
    Ok(picture.crop_imm(left, top, columns, rows))
}

/// How many pictures a file has, as far as that is worth knowing: two are more than one.
fn pages(bytes: &[u8], format: ImageFormat) -> usize {
    match format {
        ImageFormat::Tiff => resolution::pages(bytes),
        ImageFormat::Gif => GifDecoder::new(Cursor::new(bytes))
            .map_or(1, |gif| gif.into_frames().take(2).filter(Result::is_ok).count()),
        ImageFormat::WebP => {
            WebPDecoder::new(Cursor::new(bytes)).map_or(1, |webp| 1 + usize::from(webp.has_animation()))
        }
        _ => 1,
    }
}

/// A value for each pixel, and whether higher ones are brighter.
fn values(picture: &DynamicImage, options: &Options) -> (Vec<u16>, bool) {
    if let DynamicImage::ImageLuma8(grey) = picture {
        return (grey.as_raw().iter().map(|&value| u16::from(value) * 257).collect(), true);
    }
    if let DynamicImage::ImageLuma16(grey) = picture {
        return (grey.as_raw().clone(), true);
    }
    let colours: Vec<[u16; 4]> = match picture {
        DynamicImage::ImageRgb16(_) | DynamicImage::ImageRgba16(_) | DynamicImage::ImageLumaA16(_) => {
            picture.to_rgba16().pixels().map(|pixel| pixel.0).collect()
        }
        _ => picture.to_rgba8().pixels().map(|pixel| pixel.0.map(|value| u16::from(value) * 257)).collect(),
    };
    let on = |ground: u16| colours.iter().map(move |&colour| over(colour, ground));
    let white = Axis::of(on(u16::MAX));
    let is_clear = colours.iter().any(|colour| colour[3] < u16::MAX);
    let black = is_clear.then(|| Axis::of(on(0))).filter(|black| match bare(&colours, options) {
        Some(is_light) => !is_light,
        // Light ink on nothing shows on black alone.
        None => black.variance > white.variance,
    });
    match black {
        Some(axis) => (on(0).map(|colour| axis.value(colour)).collect(), axis.is_bright()),
        None => (on(u16::MAX).map(|colour| white.value(colour)).collect(), white.is_bright()),
    }
}

/// Whether bare board is the lighter of two colours, where pixels that nothing shines through have
/// two: then it is bare board where there is nothing, as at the corners of a scan that was turned.
fn bare(colours: &[[u16; 4]], options: &Options) -> Option<bool> {
    /// The variance from which on there are two, as a part of what black and white may have.
    /// Chosen: a line in a hundredth of the pixels.
    const TWO: f64 = 0.01;
    let opaque = || {
        let solid = colours.iter().filter(|colour| colour[3] == u16::MAX);
        solid.map(|&[r, g, b, _]| [r, g, b].map(f64::from))
    };
    let axis = Axis::of(opaque());
    let most = f64::from(u16::MAX);
    if axis.variance < TWO * most * most {
        return None;
    }
    let is_light = match options.colour {
        Colour::Dark => true,
        Colour::Light => false,
        Colour::Rarer => {
            let half = u16::MAX / 2;
            let (count, high) = opaque().fold((0_usize, 0_usize), |(count, high), colour| {
                (count + 1, high + usize::from(axis.value(colour) > half))
            });
            (2 * high > count) == axis.is_bright()
        }
    };
    Some(is_light != options.invert)
}

/// A colour laid on a ground.
fn over([r, g, b, a]: [u16; 4], ground: u16) -> [f64; 3] {
    let share = f64::from(a) / f64::from(u16::MAX);
    [r, g, b].map(|value| f64::from(value) * share + f64::from(ground) * (1.0 - share))
}

/// The direction in which colours differ most, and how far they reach along it.
struct Axis {
    middle: [f64; 3],
    way: [f64; 3],
    variance: f64,
    low: f64,
    high: f64,
}

impl Axis {
    fn of(colours: impl Iterator<Item = [f64; 3]> + Clone) -> Self {
        let (mut count, mut sum, mut products) = (0.0, [0.0; 3], [[0.0; 3]; 3]);
        for colour in colours.clone() {
            count += 1.0;
            for (row, value) in products.iter_mut().zip(colour) {
                row.iter_mut().zip(colour).for_each(|(product, other)| *product += value * other);
            }
            sum.iter_mut().zip(colour).for_each(|(sum, value)| *sum += value);
        }
        let count = f64::max(count, 1.0);
        let middle = sum.map(|sum| sum / count);
        let mut matrix = products.map(|row| row.map(|product| product / count));
        for (row, a) in matrix.iter_mut().zip(middle) {
            row.iter_mut().zip(middle).for_each(|(value, b)| *value -= a * b);
        }
        // The greatest eigenvector, by powers, from grey: two colours need a few steps.
        let mut way = [1.0, 1.1, 0.9];
        for _ in 0..64 {
            let next = matrix.map(|row| dot(row, way));
            let length = dot(next, next).sqrt();
            if length <= 0.0 {
                break;
            }
            way = next.map(|value| value / length);
        }
        let length = dot(way, way).sqrt();
        way = way.map(|value| value / length);
        let along = |colour: [f64; 3]| dot(less(colour, middle), way);
        let reach = colours.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), colour| {
            (low.min(along(colour)), high.max(along(colour)))
        });
        let variance = dot(matrix.map(|row| dot(row, way)), way);
        Self { middle, way, variance, low: reach.0, high: reach.1 }
    }

    /// A colour as a value: the whole range is used.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the range")]
    fn value(&self, colour: [f64; 3]) -> u16 {
        let along = dot(less(colour, self.middle), self.way);
        let range = (self.high - self.low).max(1.0);
        ((along - self.low) / range * f64::from(u16::MAX)).round() as u16
    }

    /// Whether higher values are brighter, by the weights of ITU-R BT.709.
    fn is_bright(&self) -> bool {
        dot(self.way, [0.2126, 0.7152, 0.0722]) >= 0.0
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn less(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decoder_that_panics_is_an_error() {
        let none: [u8; 0] = [];
        let words = contained(|| none[bytes_of_a_broken_file()]).expect_err("there is no such byte");
        assert!(words.starts_with("its decoder failed (index out of bounds"), "{words}");
        assert_eq!(contained(|| 7), Ok(7), "all others return");
    }

    fn bytes_of_a_broken_file() -> usize {
        std::hint::black_box(3)
    }
}
