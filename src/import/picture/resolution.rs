//! How many pixels to the inch a picture file says it has: what the decoders leave aside.

use image::ImageFormat;

/// Pixels to the inch that can be meant.
const MEANT: std::ops::RangeInclusive<f64> = 10.0..=30_000.0;

/// Pixels to the inch, across and down; none where the file does not say, or says a ratio alone.
pub(super) fn resolution(bytes: &[u8], format: ImageFormat) -> Option<(f64, f64)> {
    let said = match format {
        ImageFormat::Png => png(bytes),
        ImageFormat::Bmp => bmp(bytes),
        ImageFormat::Jpeg => jpeg(bytes),
        ImageFormat::Tiff => tiff(bytes),
        _ => None,
    };
    said.filter(|(x, y)| MEANT.contains(x) && MEANT.contains(y))
}

const METRE: f64 = 0.0254;

fn big(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..at.checked_add(4)?)?.try_into().map(u32::from_be_bytes).ok()
}

fn little(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..at.checked_add(4)?)?.try_into().map(u32::from_le_bytes).ok()
}

/// The chunk `pHYs` (PNG 3rd edition, 11.3.4.3).
fn png(bytes: &[u8]) -> Option<(f64, f64)> {
    let mut at = 8;
    loop {
        let length = big(bytes, at)? as usize;
        let kind = bytes.get(at + 4..at + 8)?;
        if kind == b"pHYs" && length == 9 {
            let is_metre = bytes.get(at + 16) == Some(&1);
            let (x, y) = (big(bytes, at + 8)?, big(bytes, at + 12)?);
            return is_metre.then(|| (f64::from(x) * METRE, f64::from(y) * METRE));
        }
        if kind == b"IDAT" {
            return None;
        }
        at = at.checked_add(length)?.checked_add(12)?;
    }
}

/// `biXPelsPerMeter` and `biYPelsPerMeter` of a BITMAPINFOHEADER.
fn bmp(bytes: &[u8]) -> Option<(f64, f64)> {
    if little(bytes, 14)? < 40 {
        return None;
    }
    Some((f64::from(little(bytes, 38)?) * METRE, f64::from(little(bytes, 42)?) * METRE))
}

/// The density of JFIF, or the resolution of Exif.
fn jpeg(bytes: &[u8]) -> Option<(f64, f64)> {
    let mut at = 2;
    let mut exif = None;
    while bytes.get(at) == Some(&0xFF) {
        let marker = *bytes.get(at + 1)?;
        let length = usize::from(u16::from_be_bytes(bytes.get(at + 2..at + 4)?.try_into().ok()?));
        let segment = bytes.get(at + 4..at + 2 + length)?;
        if marker == 0xE0 && segment.starts_with(b"JFIF\0") && segment.len() >= 12 {
            let density = |at: usize| f64::from(u16::from_be_bytes([segment[at], segment[at + 1]]));
            match segment[7] {
                1 => return Some((density(8), density(10))),
                2 => return Some((density(8) * 2.54, density(10) * 2.54)),
                _ => {}
            }
        }
        if marker == 0xE1 && segment.starts_with(b"Exif\0\0") {
            exif = exif.or_else(|| tiff(&segment[6..]));
        }
        if marker == 0xDA {
            break;
        }
        at += 2 + length;
    }
    exif
}

/// How many pages a TIFF has: directories that are not marked as a smaller copy of a page or as its
/// mask (tag 254; TIFF 6.0, section 8).
pub(super) fn pages(bytes: &[u8]) -> usize {
    /// More are not counted, as they may go round. Chosen.
    const MOST: usize = 100;
    let tiff = Tiff::new(bytes);
    let next = |directory: usize| {
        let count = usize::from(tiff.short(directory)?);
        Some(tiff.long(directory.checked_add(2 + count * 12)?)? as usize).filter(|&at| at > 0)
    };
    let directories = std::iter::successors(tiff.long(4).map(|at| at as usize), |&at| next(at)).take(MOST);
    let kind = |directory: usize| tiff.entry(directory, 254).and_then(|at| tiff.long(at.checked_add(8)?));
    directories.filter(|&directory| kind(directory).is_none_or(|kind| kind & 0b101 == 0)).count()
}

/// A file in the byte order that it says.
struct Tiff<'a> {
    bytes: &'a [u8],
    is_little: bool,
}

impl<'a> Tiff<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, is_little: bytes.starts_with(b"II") }
    }

    fn long(&self, at: usize) -> Option<u32> {
        if self.is_little { little(self.bytes, at) } else { big(self.bytes, at) }
    }

    fn short(&self, at: usize) -> Option<u16> {
        let pair = self.bytes.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if self.is_little { u16::from_le_bytes(pair) } else { u16::from_be_bytes(pair) })
    }

    /// Where a directory has a tag.
    fn entry(&self, directory: usize, tag: u16) -> Option<usize> {
        let count = usize::from(self.short(directory)?);
        let mut places = (0..count).filter_map(|number| directory.checked_add(2 + number * 12));
        places.find(|&at| self.short(at) == Some(tag))
    }
}

/// The tags 282, 283 and 296 of the first directory (TIFF 6.0, section 8).
fn tiff(bytes: &[u8]) -> Option<(f64, f64)> {
    let tiff = Tiff::new(bytes);
    let directory = tiff.long(4)? as usize;
    let ratio = |tag: u16| {
        let at = tiff.long(tiff.entry(directory, tag)?.checked_add(8)?)? as usize;
        let (over, under) = (f64::from(tiff.long(at)?), f64::from(tiff.long(at.checked_add(4)?)?));
        (under > 0.0).then(|| over / under)
    };
    let unit = match tiff.entry(directory, 296).and_then(|at| tiff.short(at.checked_add(8)?)) {
        None | Some(2) => 1.0,
        Some(3) => 2.54,
        Some(_) => return None,
    };
    Some((ratio(282)? * unit, ratio(283)? * unit))
}
