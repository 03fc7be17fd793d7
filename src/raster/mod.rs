//! A deterministic z-buffer on the CPU: surfaces over a plane of pixels in, the nearest label of
//! every pixel out.
//!
//! Give every point the surface of its own distance, a cone, and look at the cones from below: what
//! is seen at a pixel is the nearest point, and the picture is the Voronoi diagram ([Hoff et
//! al.][hoff], [Vona and Rus][visolate]). So for segments ([`Surface::Curtain`]), circular arcs
//! ([`Surface::Ring`]) and areas ([`Surface::Polygon`]), each with a label of the caller's
//! choosing. A GPU did this for the papers; here it is arithmetic that gives the same bits
//! everywhere.
//!
//! # Tour
//!
//! ```
//! use voromill::raster::{Buffers, Label, Picker, PixelPoint, Scene, Surface, render};
//!
//! // A dozen points, a label each, in a picture of 120 × 80 pixels.
//! let mut scene = Scene::new(120, 80);
//! for number in 0..12 {
//!     let apex = PixelPoint::from_pixels(7 + 37 * number % 113, 5 + 23 * number % 71);
//!     scene.add(Label(1 + number as u32), Surface::Cone { apex, offset: 0.0, limit: None });
//! }
//! let mut diagram = Buffers::new();
//! render(&scene, &mut diagram);
//!
//! // Whose is this pixel, and which points are the next nearest?
//! let nearest = diagram.pixel(60, 40);
//! let picker = Picker::new(&scene);
//! let list: Vec<_> = picker.pick(60, 40).take(3).collect();
//! assert_eq!(list[0], nearest, "a pick begins with what is seen");
//! assert!(list[0].depth <= list[1].depth && list[1].depth <= list[2].depth, "nearest first");
//! ```
//!
//! [`render()`] draws a picture into [`Buffers`]; [`stream()`] hands out finished tiles in a fixed
//! order, for pictures larger than memory, and can leave out those that one label has to itself.
//! [`Picker`] lists what lies at a pixel, [`blend`] makes pictures of layers, a [`Palette`] gives
//! labels their colours, [`mesh`] tessellates the surfaces as the papers did, [`view`] looks at
//! them from the side. `examples/engine` is a crate that has all of this and nothing else of this
//! one: `default-features = false, features = ["raster"]`. With `simd` beside it the engine draws
//! on as many pixels at once as the processor takes, and gets the same bits.
//!
//! # Laws
//!
//! * A pixel is the least of its fragments by (depth, label). A fragment depends on its primitive
//!   and its pixel alone: nothing is stepped along a row. So the order of the scene, the size of
//!   tiles and the number of threads cannot change a bit, and since only + − × ÷ √ touch floats,
//!   neither can the machine.
//! * What a primitive covers is decided in integers: positions are 24.8 fixed point ([`SubPx`]),
//!   samples lie at pixel centres, an edge through a sample belongs to the triangle or polygon
//!   right of or below it. A conformant OpenGL fills the same pixels.
//! * Culling is conservative. What is left out is strictly behind something that covers the whole
//!   cell, by more than both depths may be off; a tie is always decided at the pixel.
//!
//! # How exact a depth is
//!
//! Depths are `f32` pixels; let u = 2⁻²⁴ be half a unit in the last place. Samples and coordinates
//! within 65 536 pixels of the origin are exact in an `f32`, and so are their differences (24
//! bits). Then:
//!
//! * A cone's dx² + dy² takes three roundings, its root halves them and adds one, the offset takes
//!   one: off by at most 3 u (d + |offset|).
//! * A curtain's foot t is off by about 4 u |w| / L, with |w| ≤ d + L; that moves the foot by 4 u
//!   (d + L) and the distance by no more. Rounding t·u costs another u L, the rest as above: at
//!   most 10 u (d + L + |offset|).
//! * A ring subtracts its radius: at most 4 u (d + 2 R + |offset|).
//!
//! So two labels can be seen in the wrong order only where their true distances differ by less than
//! the sum of the two bounds: at 1000 pixels, by about a thousandth of a pixel. The culling allows
//! for 32 u.
//!
//! # How it is fast
//!
//! The picture is cut into cells, eight by eight from each, and so on down to blocks of about 16 ×
//! 16 pixels. A cell has a bin: what may be seen in it. To split a bin, every candidate's depth is
//! computed in the middle of each of the 64 pieces by the very loop that draws pixels; by the
//! piece's radius up or down, that bounds it everywhere. Gone is what lies behind something else
//! that covers the piece. The radius alone cannot tell neighbours apart that lie the same way; the
//! difference of their gradients can. Distances are convex, and curve by at most one over
//! themselves, so
//!
//! ```text
//!   d₁ − d₂  ≥  d₁(c) − d₂(c)  −  |g₁ − g₂| r  −  r² / (2 d₂(c))
//! ```
//!
//! A bin runs in the order of labels, so drawing needs no look at labels to break ties. Cost is
//! O(n) to bin for n primitives, and then per block; it grows with n · levels and with pixels ·
//! (what is left in a block).
//!
//! What was tried, with 2000 segments at 4096², one thread of a Xeon with AVX-512, against writing
//! 8 bytes a pixel:
//!
//! | step | ratio |
//! |---|---|
//! | quadtree of scalar bounds, loops left to the compiler: selects became branches, nothing vectorized | 14.3 |
//! | lanes of eight, dispatched at run time by `pulp` (no `unsafe` here), baseline elsewhere | 7.8 |
//! | bounds from a coarse picture of 8 × 8 blocks; blocks not cleared where the first primitive covers them | 4.0 |
//! | bins split into 64 at once, neighbours told apart by gradients: dense scenes gain a third, this one loses a little | 4.0 |
//! | blocks gathered into squares of 128 pixels before they go to memory: it takes rows of 512 bytes better than of 64 | 3.7 |
//! | primitives laid where the square is, not on a block that is copied there; eight squares side by side, rows of 4 KiB; a stride that is no power of two | 2.7 |
//!
//! Where a fragment may lose, a choice between it and what is there became masked stores
//! (`vmaskmovps`), which cost an AMD Zen 4 dozens of cycles each. The nearer depth as a minimum and
//! the label merged by exclusive or are the same bits without a choice: on one thread of an EPYC
//! 64 ms became 46 drawn and 46 became 29 streamed, where writing 8 bytes a pixel takes 7 (least of
//! three runs each in turn, on a busy machine).
//!
//! A block is drawn column by column of lanes, down its rows: what is constant in the columns (the
//! way along x, its part of the products) is worked out once for sixteen rows, where a row has two
//! groups of lanes only. With that, and bins of one primitive left as they are, an EPYC of the
//! fifth generation (Zen 5) takes a tenth less: on two threads 3.5 times writing 8 bytes a pixel
//! became 3.25 drawn, and 2.9 became 2.7 streamed.
//!
//! Where there is AVX-512, blocks whose rows are multiples of sixteen are drawn with as many lanes:
//! the same EPYC takes 11.2 ms instead of 13.6 drawn and 8.5 instead of 10.7 streamed (two threads,
//! medians of four runs in turns). Pieces of a mosaic, eight in a row, are weighed by eight: two
//! rows at once made boards of thousands of segments 2 to 4 % quicker and those of a million 7 %
//! slower.
//!
//! What remains: streamed, without a picture to write, the same scene takes 2.0; three quarters of
//! one part is writing long rows. Of the 2.0, one is fragments, most of which is square roots, the
//! rest bins. (Four squares: 3.1; one: 3.7; sixteen, more than half of a second-level cache of 2
//! MiB: 3.0.)
//!
//! # How it grows
//!
//! Two threads, times writing 8 bytes a pixel (8.9 ms at 4096²) and in all;
//! `cargo bench --bench raster` repeats it.
//!
//! | 4096², segments of about | number | ratio | ms | µs a segment |
//! |---|---|---|---|---|
//! | 100 pixels | 10² | 1.8 | 17 | 170 |
//! | 100 pixels | 10³ | 2.3 | 21 | 21 |
//! | 40 pixels | 10⁴ | 5.6 | 50 | 5.0 |
//! | 12 pixels | 10⁵ | 33 | 300 | 3.0 |
//! | 4 pixels | 10⁶ | 270 | 2500 | 2.5 |
//!
//! Up to some thousand segments the pixels are paid for. Beyond that a block of 16 × 16 pixels has
//! several sites, and each is weighed on its way down the levels (three for this picture) and drawn
//! in the few blocks where it is seen: a constant each. At 10⁶ there are 17 pixels for a segment.
//!
//! | 2000 segments, a fortieth of the side long | 512² | 1024² | 2048² | 4096² | 8192² |
//! |---|---|---|---|---|---|
//! | ms | 3.5 | 5.2 | 9.9 | 24 | 74 |
//! | ns a pixel | 13 | 4.9 | 2.4 | 1.5 | 1.1 |
//!
//! Here the segments are paid for first, and then the pixels. Streamed with tiles of 32 pixels, of
//! which those of one label are skipped (50 labels), the same picture at 2048², 4096², 8192² and
//! 16384² takes 9, 18, 35 and 68 ms: the length of the boundaries, not the area. At 16384² 20 000
//! segments stream in 10 MiB, and in less time a pixel than 2000 at 4096².
//!
//! # Beside others
//!
//! `benches/peers/raster.py` installs and runs them; the same segments, two threads, wrong by brute
//! force at 1024².
//!
//! | 4096², 2000 segments | ms | labels off by more than half a pixel |
//! |---|---|---|
//! | this engine | 24 | none |
//! | OpenCV's labelled distance transform (5 × 5) | 363 | 0.39 % |
//! | edt (distances, no labels) | 348 | |
//! | SciPy's exact distance transform with indices | 1930 | 0.18 % (its sites are pixels) |
//! | Mesa's llvmpipe: 64-sided cones and curtains as 264 000 triangles, limit 300 pixels | 1700 to 1820 | |
//!
//! A pick among 10⁵ segments takes 2 µs, one of the ten nearest 5 µs.
//!
//! # References
//!
//! * K. Hoff et al., *Fast computation of generalized Voronoi diagrams using graphics hardware*,
//!   SIGGRAPH 1999.
//! * M. A. Vona and D. Rus, *VIsolate*: the translucent and picking methods of § III-A.2, the
//!   distance meshes of § III-B.
//!
//! [hoff]: #references
//! [visolate]: #references

mod bin;
mod bits;
pub mod blend;
mod canvas;
mod cell;
mod faces;
mod fragment;
mod half_plane;
mod lanes;
pub mod mesh;
mod mosaic;
mod node;
mod palette;
mod pick;
mod primitive;
mod processor;
mod render;
mod scene;
#[cfg(not(feature = "simd"))]
mod simd;
mod stream;
mod subpixel;
mod surface;
mod thin;
mod tile;
pub mod view;

#[cfg(feature = "simd")]
use pulp as simd;

pub use bits::{Bits, Node};
pub use faces::{Faces, Meeting};
pub use fragment::{Fragment, Label};
pub use palette::Palette;
pub use pick::{Picker, Picks};
pub use render::{Buffers, render};
pub use scene::Scene;
pub use stream::{Options, stream};
pub use subpixel::{PixelPoint, SubPx};
pub use surface::{Caps, FillRule, Sides, Spin, Surface};
pub use thin::{Thinned, thin};
pub use tile::{Tile, TileContent, TilePixels};
