//! Pixels of a picture of one bit, and the islands among them by flooding.

/// A picture in black and white.
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Pixels to the metre, both ways.
    pub(super) per_metre: u32,
    ink: Vec<bool>,
}

/// Reads a PNG by the decoder alone.
pub(super) fn read(bytes: &[u8]) -> Picture {
    let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    let mut reader = decoder.read_info().expect("a PNG");
    let info = reader.info();
    assert_eq!(info.bit_depth, png::BitDepth::One, "a bit a pixel");
    let dims = info.pixel_dims.expect("it says how large a pixel is");
    assert_eq!((dims.xppu, dims.unit), (dims.yppu, png::Unit::Meter), "square, and in metres");
    let (width, height) = (info.width as usize, info.height as usize);
    let mut ink = Vec::with_capacity(width * height);
    while let Some(row) = reader.next_row().expect("a row") {
        let bits = row.data().iter().flat_map(|byte| (0..8).rev().map(move |bit| byte >> bit & 1 == 0));
        ink.extend(bits.take(width));
    }
    Picture { width, height, per_metre: dims.xppu, ink }
}

impl Picture {
    pub(super) fn is_ink(&self, x: usize, y: usize) -> bool {
        self.ink[y * self.width + x]
    }

    /// How many pixels are inked.
    pub(super) fn ink(&self) -> f64 {
        self.ink.iter().map(|&ink| f64::from(u8::from(ink))).sum()
    }

    /// Pieces of ink that hang together by the sides of pixels.
    pub(super) fn islands(&self) -> usize {
        let mut open = self.ink.clone();
        let mut count = 0;
        let mut todo = Vec::new();
        for first in 0..open.len() {
            if !open[first] {
                continue;
            }
            count += 1;
            open[first] = false;
            todo.push(first);
            while let Some(at) = todo.pop() {
                let (x, y) = (at % self.width, at / self.width);
                let mut visit = |next: usize| {
                    if open[next] {
                        open[next] = false;
                        todo.push(next);
                    }
                };
                if x > 0 {
                    visit(at - 1);
                }
                if x + 1 < self.width {
                    visit(at + 1);
                }
                if y > 0 {
                    visit(at - self.width);
                }
                if y + 1 < self.height {
                    visit(at + self.width);
                }
            }
        }
        count
    }
}
