//! A deterministic z-buffer on the CPU: surfaces over a plane of pixels in, the nearest label of every pixel out.

mod bin;
pub mod blend;
mod block;
mod cell;
mod fragment;
mod half_plane;
mod lanes;
mod mosaic;
mod node;
mod pick;
mod primitive;
mod render;
mod scene;
mod stream;
mod subpixel;
mod surface;
mod tile;

pub use fragment::{Fragment, Label};
pub use pick::{Picker, Picks};
pub use render::{Buffers, render};
pub use scene::Scene;
pub use stream::{Options, stream};
pub use subpixel::{PixelPoint, SubPx};
pub use surface::{Caps, FillRule, Sides, Spin, Surface};
pub use tile::{Tile, TileContent, TilePixels};
