//! The labels of a tile as tracing reads them.

/// The pixels of a tile as tracing sees them: who owns each, and by which site, two pixels beyond
/// the tile's border.
pub(in crate::voronoi) struct Pixels<'a> {
    /// Owner of each pixel, row by row, `width + 4` a row.
    pub(in crate::voronoi) owners: &'a [u32],
    /// Label of each pixel, the same shape.
    pub(in crate::voronoi) labels: &'a [u32],
    pub(in crate::voronoi) width: i32,
    pub(in crate::voronoi) height: i32,
    /// The picture's coordinates of the tile's first pixel.
    pub(in crate::voronoi) column0: u32,
    pub(in crate::voronoi) row0: u32,
}

/// How many pixels beyond the tile tracing looks at.
pub(in crate::voronoi) const APRON: u32 = 2;

impl Pixels<'_> {
    #[expect(clippy::cast_sign_loss, reason = "two pixels of apron keep the index positive")]
    pub(super) fn index(&self, x: i32, y: i32) -> usize {
        ((y + 2) * (self.width + 4) + x + 2) as usize
    }

    pub(super) fn owner(&self, x: i32, y: i32) -> u32 {
        self.owners[self.index(x, y)]
    }

    pub(super) fn label(&self, x: i32, y: i32) -> u32 {
        self.labels[self.index(x, y)]
    }
}
