//! Lines of one level kept off the copper where the picture misleads them.
//!
//! ```text
//!     ╲ copper        In a wedge of copper narrower than a few pixels a line turns within one pixel. Too little is seen there to
//!      ╲    ╱         solve the two equations of its corner, and its vertex keeps the pixel's place, up to half a kerf too near.
//!       ●──╱──        So it goes straight away from what is nearest, until nothing is too near: that ends at the corner.
//! ```

use rustc_hash::FxHashMap;

use crate::geometry::Nm;

use super::near::Near;
use super::span::Vertex;
use super::stitch::Line;
use super::{BACKGROUND, Diagram};

/// What lies nearer than this below its level is there by rounding, in nanometres.
const ROUNDING: f64 = 50.0;
/// How often a vertex is moved at most. Derived: between two edges at an angle of 60° each turn
/// leaves a quarter of what is missing.
const TURNS: usize = 48;

impl Diagram {
    /// Moves the vertices of `lines` that lie nearer to copper than `level` off it; where a corner
    /// is farther away than pixels mislead, they stay, and who judges the cut finds them.
    pub(super) fn keep_off(&self, lines: &mut [Line], level: Nm) {
        let Some(near) = &self.near else { return };
        let level = level.to_f64();
        let leash = 3.0 * self.grid.pitch().to_f64();
        let mut moved: FxHashMap<[u64; 2], Vertex> = FxHashMap::default();
        let of_level = lines.iter_mut().filter(|line| line.left == BACKGROUND || line.right == BACKGROUND);
        for vertex in of_level.filter(|line| !line.is_border()).flat_map(|line| &mut line.vertices) {
            if vertex.has_course() && vertex.clearance() > level - ROUNDING {
                continue;
            }
            let key = [vertex.at.x, vertex.at.y].map(f64::to_bits);
            *vertex = *moved.entry(key).or_insert_with(|| self.off(near, *vertex, level, leash));
        }
    }

    /// The vertex, or where it comes to lie `level` away from copper within `leash`.
    fn off(&self, near: &Near, vertex: Vertex, level: f64, leash: f64) -> Vertex {
        let mut at = vertex.at;
        for _ in 0..TURNS {
            let reach = near.reach(&self.sites, at, |_| true);
            if reach.distance > level - ROUNDING {
                break;
            }
            at = at + reach.away * (level - reach.distance);
            if (at - vertex.at).length() > leash {
                return vertex;
            }
        }
        if at == vertex.at { vertex } else { Vertex::new(at, near.distance(&self.sites, at)) }
    }
}
