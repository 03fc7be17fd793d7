//! Colours for labels: what a picture of labels is painted with.

use super::{Buffers, Label};

/// A colour for every label, red, green, blue and how opaque (255 is wholly), each from 0 to 255.
///
/// ```
/// use voromill::raster::{Label, Palette};
///
/// let palette = Palette::new([255, 255, 255], vec![[200, 0, 0, 255], [0, 0, 200, 128]]);
/// assert_eq!(palette.rgba(Label(1)), [200, 0, 0, 255], "the first is that of label 1");
/// assert_eq!(palette.rgba(Label(3)), palette.rgba(Label(1)), "they come again");
/// assert_eq!(palette.rgba(Label::BACKGROUND)[3], 0, "nothing is transparent");
/// assert_eq!(palette.rgb(Label(2)), [127, 127, 227], "over white");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Palette {
    background: [u8; 3],
    colors: Vec<[u8; 4]>,
}

impl Palette {
    /// The colours of the labels 1, 2, and so on, which come again behind the last; with none, all
    /// are transparent. What lies under them is the `background`.
    #[must_use]
    pub const fn new(background: [u8; 3], colors: Vec<[u8; 4]>) -> Self {
        Self { background, colors }
    }

    /// The colour of a label.
    #[must_use]
    pub fn rgba(&self, label: Label) -> [u8; 4] {
        let [r, g, b] = self.background;
        let index = (label.0 as usize).checked_sub(1);
        let color = index.and_then(|index| self.colors.get(index.checked_rem(self.colors.len())?));
        color.copied().unwrap_or([r, g, b, 0])
    }

    /// The colour of a label over the background.
    #[must_use]
    pub fn rgb(&self, label: Label) -> [u8; 3] {
        let [r, g, b, opaque] = self.rgba(label).map(u32::from);
        let [under_r, under_g, under_b] = self.background.map(u32::from);
        [(r, under_r), (g, under_g), (b, under_b)].map(|(over, under)| {
            let mixed = (over * opaque + under * (255 - opaque) + 127) / 255;
            u8::try_from(mixed).unwrap_or(u8::MAX)
        })
    }
}

impl Buffers {
    /// The colour of every pixel, row by row from the top, as the depths are.
    ///
    /// ```
    /// use voromill::raster::{Buffers, Label, Palette, PixelPoint, Scene, Surface, render};
    ///
    /// let mut scene = Scene::new(3, 1);
    /// let apex = PixelPoint::from_f64(0.5, 0.5);
    /// scene.add(Label(1), Surface::Cone { apex, offset: 0.0, limit: Some(1.5) });
    /// let mut picture = Buffers::new();
    /// render(&scene, &mut picture);
    /// let colors = picture.rgba(&Palette::new([0; 3], vec![[9, 8, 7, 255]]));
    /// assert_eq!(colors, [[9, 8, 7, 255], [9, 8, 7, 255], [0; 4]], "as far as the cone reaches");
    /// assert_eq!(picture.depths(), [0.0, 1.0, f32::INFINITY], "and how deep it is there");
    /// ```
    #[must_use]
    pub fn rgba(&self, palette: &Palette) -> Vec<[u8; 4]> {
        self.labels().iter().map(|&label| palette.rgba(Label(label))).collect()
    }

    /// The colour of every pixel over the background.
    #[must_use]
    pub fn rgb(&self, palette: &Palette) -> Vec<[u8; 3]> {
        self.labels().iter().map(|&label| palette.rgb(Label(label))).collect()
    }
}
