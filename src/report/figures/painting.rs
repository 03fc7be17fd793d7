//! Pixels in colour, made finer than they are shown.

use crate::report::Canvas;

/// A picture in memory, row 0 on top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Painting {
    /// Pixels in a row.
    pub width: usize,
    /// All pixels.
    pub pixels: Vec<[u8; 3]>,
}

/// The paper that figures stand on.
pub(super) const WHITE: [u8; 3] = [255; 3];

impl Painting {
    /// What `colour` says of each column and row.
    pub(super) fn from_fn(width: u32, height: u32, colour: impl Fn(u32, u32) -> [u8; 3]) -> Self {
        let pixels = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
        Self { width: width as usize, pixels: pixels.map(|(column, row)| colour(column, row)).collect() }
    }

    pub(super) fn of(canvas: Canvas) -> Self {
        let width = canvas.grid().width() as usize;
        Self { width, pixels: canvas.into_rgb().as_chunks().0.to_vec() }
    }

    /// How many rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.pixels.len() / self.width.max(1)
    }

    /// Each pixel the mean of `factor` by `factor`; what is left at the right and below is cut off.
    pub(super) fn smaller(&self, factor: usize) -> Self {
        let (width, height) = (self.width / factor, self.height() / factor);
        let count = u32::try_from(factor * factor).unwrap_or(u32::MAX);
        let mut pixels = Vec::with_capacity(width * height);
        for row in 0..height {
            for column in 0..width {
                let mut sum = [count / 2; 3];
                for y in row * factor..(row + 1) * factor {
                    let from = y * self.width + column * factor;
                    for pixel in &self.pixels[from..from + factor] {
                        sum.iter_mut().zip(pixel).for_each(|(sum, &part)| *sum += u32::from(part));
                    }
                }
                pixels.push(sum.map(|sum| u8::try_from(sum / count).unwrap_or(u8::MAX)));
            }
        }
        Self { width, pixels }
    }

    /// Pictures side by side on white, so many pixels apart; lower ones in the middle.
    pub(super) fn beside(pictures: &[Self], apart: usize) -> Self {
        let height = pictures.iter().map(Self::height).max().unwrap_or(0);
        let width =
            pictures.iter().map(|one| one.width).sum::<usize>() + apart * pictures.len().saturating_sub(1);
        let mut pixels = vec![WHITE; width * height];
        let mut left = 0;
        for one in pictures {
            let top = (height - one.height()) / 2;
            for (row, line) in one.pixels.chunks_exact(one.width).enumerate() {
                let from = (top + row) * width + left;
                pixels[from..from + one.width].copy_from_slice(line);
            }
            left += one.width + apart;
        }
        Self { width, pixels }
    }

    /// FNV-1a of its pixels: the same exactly where the picture is.
    #[must_use]
    pub fn checksum(&self) -> u64 {
        let bytes = self.pixels.as_flattened().iter();
        bytes.fold(0xcbf2_9ce4_8422_2325, |sum, &byte| (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }

    /// As the bytes of a PNG file.
    #[must_use]
    pub fn to_png(&self) -> Vec<u8> {
        crate::report::png::pixels(u32::try_from(self.width).unwrap_or(u32::MAX), &self.pixels)
    }
}

/// A colour so far on the way to another: 0 here, 1 there.
pub(super) fn mix(from: [f64; 3], to: [f64; 3], way: f64) -> [f64; 3] {
    let way = way.clamp(0.0, 1.0);
    [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * way)
}

/// A colour in bytes.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
pub(super) fn bytes(colour: [f64; 3]) -> [u8; 3] {
    colour.map(|part| (part + 0.5) as u8)
}
