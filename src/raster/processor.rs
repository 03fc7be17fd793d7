//! On how many pixels at once the processor works.

use super::simd::{Arch, WithSimd};

/// Pixels that most processors work on at once: what rows are padded to, and cells are cut at
/// multiples of.
pub(super) const LANES: i32 = 8;

/// The most pixels that any processor works on at once.
pub(super) const WIDEST: usize = 16;

/// The kinds of lanes that are taken; the bits are the same with any.
#[derive(Clone, Copy)]
pub(super) struct Processor {
    /// For rows of multiples of [`WIDEST`].
    wide: Arch,
    /// For those of multiples of [`LANES`] only.
    narrow: Arch,
}

impl Processor {
    /// The best of the processor at hand.
    pub(super) fn new() -> Self {
        let wide = Arch::new();
        #[cfg(all(feature = "simd", target_arch = "x86_64"))]
        let narrow = super::simd::x86::V3::try_new().map_or(Arch::Scalar, Arch::V3);
        #[cfg(not(all(feature = "simd", target_arch = "x86_64")))]
        let narrow = wide;
        Self { wide, narrow }
    }

    /// Does work on rows of `width` pixels, a multiple of [`LANES`].
    #[inline(always)]
    pub(super) fn dispatch<W: WithSimd>(self, width: usize, work: W) -> W::Output {
        let arch = if width.is_multiple_of(WIDEST) { self.wide } else { self.narrow };
        arch.dispatch(work)
    }
}

#[cfg(all(test, feature = "simd"))]
mod tests {
    use super::super::bin::{Bin, Painter};
    use super::super::cell::Cell;
    use super::super::{Caps, FillRule, Label, PixelPoint, Scene, Sides, Spin, Surface};
    use super::*;

    const SIDE: i32 = 256;

    /// All surfaces, near ones and far ones, over and beside each other.
    fn scene() -> Scene {
        let mut scene = Scene::new(SIDE as u32, SIDE as u32);
        for (label, number) in (1..).zip(0..120) {
            let [from, to, third] = [0, 1, 2].map(|turn| {
                let (x, y) = ((number * 197 + turn * 43) % SIDE, (number * 71 + turn * turn * 59) % SIDE);
                PixelPoint::from_f64(f64::from(x) + 0.37, f64::from(y) + 0.81)
            });
            let offset = [0.0, 1.0, 2.5, 4.0][label as usize % 4];
            let limit = (number % 3 == 0).then_some(20.5);
            let caps = [Caps::None, Caps::Start, Caps::End, Caps::Both][label as usize / 4 % 4];
            let surface = match number % 6 {
                0 => Surface::Cone { apex: from, offset, limit },
                1 => Surface::Triangle { corners: [from, to, third], depths: [30.0, offset, 60.0] },
                2 => Surface::Polygon {
                    contours: vec![vec![from, to, third]],
                    rule: FillRule::NonZero,
                    depth: 4.0,
                },
                3 => Surface::Curtain { from, to, caps, sides: Sides::Left, offset, limit },
                4 => Surface::Curtain { from, to, caps, sides: Sides::Both, offset, limit },
                _ => {
                    let spin = Spin::Clockwise;
                    Surface::Ring { center: from, start: to, end: third, spin, caps, offset, limit }
                }
            };
            scene.add(Label(label), surface);
        }
        scene
    }

    /// What is drawn of the scene with these lanes, from a column on: labels and bits of depths.
    fn drawn(scene: &Scene, processor: Processor, x: i32) -> Vec<(u32, u32)> {
        let mut painter = Painter::new();
        (painter.canvas.processor, painter.mosaic.processor) = (processor, processor);
        let cell = Cell { x, y: 0, width: SIDE - x, height: SIDE };
        painter.canvas.stretch(cell);
        painter.paint(scene, &Bin::root(scene, cell), cell);
        let rows = painter.canvas.finished();
        rows.flat_map(|(depths, labels)| depths.iter().zip(labels).map(|(d, &l)| (l, d.to_bits()))).collect()
    }

    #[test]
    fn the_same_pixels_are_drawn_with_lanes_of_any_number() {
        let (scene, best) = (scene(), Processor::new());
        let alone = Processor { wide: Arch::Scalar, narrow: Arch::Scalar };
        let narrow = Processor { wide: best.narrow, narrow: best.narrow };
        for x in [0, 3] {
            let expected = drawn(&scene, alone, x);
            let labels: std::collections::BTreeSet<u32> = expected.iter().map(|pixel| pixel.0).collect();
            assert!(labels.len() > 60, "{} labels are seen", labels.len());
            assert!(drawn(&scene, narrow, x) == expected, "at most {LANES}, from column {x}");
            assert!(drawn(&scene, best, x) == expected, "as many as the processor takes, from column {x}");
        }
    }
}
