//! What hangs together: the connected pieces of a picture, found tile by tile.
//!
//! A row of pixels is kept as runs of one label; only the row above is remembered. Runs that share an edge are joined (union-find), so
//! memory follows the number of regions, not of pixels.

use crate::raster::{Options, Scene, Tile, TileContent, stream};

/// A label's share of a connected piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    /// The piece, from 0.
    pub(super) piece: u32,
    pub(super) label: u32,
    pub(super) pixels: u64,
    pub(super) extent: Extent,
}

/// Columns and rows, the last included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Extent {
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) right: u32,
    pub(super) bottom: u32,
}

impl Extent {
    pub(super) fn union(self, other: Self) -> Self {
        Self {
            left: self.left.min(other.left),
            top: self.top.min(other.top),
            right: self.right.max(other.right),
            bottom: self.bottom.max(other.bottom),
        }
    }
}

/// The pieces of `scene`, of pixels whose label `stays`; neighbours share an edge. By piece, then by label.
pub(super) fn pieces(scene: &Scene, stays: impl Fn(u32) -> bool + Sync) -> Vec<Part> {
    let mut joiner = Joiner::default();
    stream(scene, &Options::default(), |tile| Strip::new(tile, &stays), |strip| joiner.take(strip));
    joiner.flush();
    joiner.parts()
}

/// Neighbouring pixels of one label in a row.
#[derive(Clone, Copy)]
pub(super) struct Run {
    pub(super) start: u32,
    /// The column after the last.
    pub(super) end: u32,
    pub(super) label: u32,
}

/// A tile as runs, row by row.
struct Strip {
    row: u32,
    height: u32,
    /// Where each row ends in `runs`; one entry where all rows are alike.
    ends: Vec<u32>,
    runs: Vec<Run>,
}

impl Strip {
    fn new(tile: Tile<'_>, stays: impl Fn(u32) -> bool) -> Self {
        let Tile { column0, row0, width, height, content } = tile;
        let mut strip = Self { row: row0, height, ends: Vec::new(), runs: Vec::new() };
        match content {
            TileContent::Uniform(label) => {
                if stays(label) {
                    strip.runs.push(Run { start: column0, end: column0 + width, label });
                }
                strip.close();
            }
            TileContent::Pixels(pixels) => {
                for row in (0..).take(height as usize) {
                    let labels = &pixels.label_row(row)[..width as usize];
                    let mut start = column0;
                    for same in labels.chunk_by(|a, b| a == b) {
                        let end = start + u32::try_from(same.len()).expect("a tile is small");
                        if stays(same[0]) {
                            strip.runs.push(Run { start, end, label: same[0] });
                        }
                        start = end;
                    }
                    strip.close();
                }
            }
        }
        strip
    }

    fn close(&mut self) {
        self.ends.push(u32::try_from(self.runs.len()).expect("a tile is small"));
    }

    fn row(&self, row: u32) -> &[Run] {
        let row = if self.ends.len() == 1 { 0 } else { row as usize };
        let start = if row == 0 { 0 } else { self.ends[row - 1] };
        &self.runs[start as usize..self.ends[row] as usize]
    }
}

/// Pixels of one label that hang together, as far as is known.
struct Node {
    /// Itself, or one before it in the same piece.
    parent: u32,
    label: u32,
    pixels: u64,
    extent: Extent,
}

/// Joins runs, row by row.
#[derive(Default)]
pub(super) struct Joiner {
    nodes: Vec<Node>,
    /// The row above: its runs and their nodes.
    above: Vec<(Run, u32)>,
    /// The tiles of the row of tiles that is coming in.
    strips: Vec<Strip>,
}

impl Joiner {
    fn take(&mut self, strip: Strip) {
        if self.strips.first().is_some_and(|first| first.row != strip.row) {
            self.flush();
        }
        self.strips.push(strip);
    }

    /// Joins the rows of a finished row of tiles.
    fn flush(&mut self) {
        let strips = std::mem::take(&mut self.strips);
        let Some(first) = strips.first() else { return };
        for row in 0..first.height {
            let mut runs: Vec<Run> = Vec::new();
            for &run in strips.iter().flat_map(|strip| strip.row(row)) {
                match runs.last_mut().filter(|last| last.end == run.start && last.label == run.label) {
                    Some(last) => last.end = run.end,
                    None => runs.push(run),
                }
            }
            self.row(first.row + row, &runs);
        }
    }

    /// The runs of the row that was taken last, each with what stands for its region; see [`find`](Self::find).
    pub(super) fn last(&self) -> &[(Run, u32)] {
        &self.above
    }

    /// Takes the next row, the one below the row before.
    pub(super) fn row(&mut self, row: u32, runs: &[Run]) {
        let above = std::mem::take(&mut self.above);
        let mut now: Vec<(Run, u32)> = Vec::with_capacity(runs.len());
        let mut first = 0;
        for &run in runs {
            while above.get(first).is_some_and(|(other, _)| other.end <= run.start) {
                first += 1;
            }
            let touching = || above[first..].iter().take_while(|(other, _)| other.start < run.end);
            let same = touching().find(|(other, _)| other.label == run.label).map(|(_, node)| *node);
            let extent = Extent { left: run.start, top: row, right: run.end - 1, bottom: row };
            let node = same.unwrap_or_else(|| self.node(run.label, extent));
            let own = &mut self.nodes[node as usize];
            own.pixels += u64::from(run.end - run.start);
            own.extent = own.extent.union(extent);
            for (_, other) in touching() {
                self.union(node, *other);
            }
            if let Some((_, left)) = now.last().filter(|(left, _)| left.end == run.start) {
                self.union(node, *left);
            }
            now.push((run, node));
        }
        self.above = now;
    }

    fn node(&mut self, label: u32, extent: Extent) -> u32 {
        let own = u32::try_from(self.nodes.len()).expect("fewer than 2³² regions");
        self.nodes.push(Node { parent: own, label, pixels: 0, extent });
        own
    }

    /// The piece that a region belongs to, as far as rows were taken.
    pub(super) fn find(&mut self, mut node: u32) -> u32 {
        while self.nodes[node as usize].parent != node {
            let above = self.nodes[self.nodes[node as usize].parent as usize].parent;
            self.nodes[node as usize].parent = above;
            node = above;
        }
        node
    }

    fn union(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.nodes[a.max(b) as usize].parent = a.min(b);
    }

    /// All nodes of a label in a piece as one part.
    pub(super) fn parts(mut self) -> Vec<Part> {
        let count = u32::try_from(self.nodes.len()).expect("fewer than 2³² regions");
        let pieces: Vec<u32> = (0..count).map(|node| self.find(node)).collect();
        let mut parts: Vec<Part> = pieces
            .into_iter()
            .zip(&self.nodes)
            .map(|(piece, node)| Part { piece, label: node.label, pixels: node.pixels, extent: node.extent })
            .collect();
        parts.sort_by_key(|part| (part.piece, part.label));
        parts.dedup_by(|next, part| {
            let same = (next.piece, next.label) == (part.piece, part.label);
            if same {
                part.pixels += next.pixels;
                part.extent = part.extent.union(next.extent);
            }
            same
        });
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{FillRule, Label, PixelPoint, Surface};

    fn square(left: i32, top: i32, right: i32, bottom: i32) -> Surface {
        let contours = vec![vec![
            PixelPoint::from_pixels(left, top),
            PixelPoint::from_pixels(right, top),
            PixelPoint::from_pixels(right, bottom),
            PixelPoint::from_pixels(left, bottom),
        ]];
        Surface::Polygon { contours, rule: FillRule::NonZero, depth: 0.0 }
    }

    #[test]
    fn a_wall_with_a_door_parts_nothing() {
        for (bottom, expected) in [(200, 2), (199, 1)] {
            let mut scene = Scene::new(300, 200);
            scene.add(Label(1), square(100, 0, 110, bottom));
            scene.add(Label(5), square(20, 20, 90, 90));
            scene.add(Label(6), square(200, 20, 290, 150));
            let parts = pieces(&scene, |label| label != 1);
            let count = parts.chunk_by(|a, b| a.piece == b.piece).count();
            assert_eq!(count, expected, "a wall down to row {bottom}");
            let five = parts.iter().find(|part| part.label == 5).expect("a part");
            assert_eq!(five.pixels, 70 * 70, "its pixels");
            assert_eq!(five.extent, Extent { left: 20, top: 20, right: 89, bottom: 89 }, "its place");
        }
    }
}
