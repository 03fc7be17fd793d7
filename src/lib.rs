//! voromill turns the manufacturing files of a printed-circuit board into G-code for a mill.
//!
//! It isolates nets by *Voronoi toolpaths*: each net is drawn as cones and curtains, surfaces that
//! rise with the distance from its copper; seen from above, every point shows the net that it is
//! nearest to, and the borders between differently labelled regions are cut once. That is the
//! method of VIsolate (M. Vona, D. Rus: *Voronoi toolpaths for PCB mechanical etch*, ICRA 2005),
//! which drew on a GPU. Here a z-buffer engine of our own draws, on any processor, the same bits
//! everywhere; and what it finds is then placed exactly.
//!
//! # The flow
//!
//! ```text
//!  files ─ import ─▶ Board ─ topology ─▶ Nets ─ voronoi ─▶ Boundaries ─ toolpath ─▶ Program ─ gcode ─▶ text
//!                      │                   │       ▲                                                    │
//!                      │                   └─ grid ┤ draws with                                         │
//!                      │                         raster                                                 │
//!                      └──────────────────────── verify ◀───────────────────────────────────────────────┘
//! ```
//!
//! | module | owns | may use |
//! |---|---|---|
//! | [`geometry`] | integer nanometres, points, arcs, paths, polygons | – |
//! | [`raster`] | the z-buffer engine; stands alone, speaks of pixels, labels, depths | – |
//! | [`vectorize`] | pixels → contours; stands alone, speaks of samples and levels | – |
//! | [`board`] | the resolved board: copper, holes, outline; macros, repeats and polarity are gone | geometry |
//! | [`artwork`] | drawings: layers of areas and lines; → polygons, copper, holes | geometry, board |
//! | [`import`] | files → [`Board`](board::Board): Gerber, Excellon, KiCad boards, pictures, drawings, job files, archives | geometry, board, artwork, vectorize |
//! | [`grid`] | the only crossing between nanometres and pixels | geometry, raster |
//! | [`topology`] | which features conduct to each other: [`Nets`](topology::Nets) | geometry, raster, board, grid |
//! | [`voronoi`] | nets → regions → a planar graph of [`Boundaries`](voronoi::Boundaries), placed exactly | all above but import |
//! | [`coupling`] | how near nets lie to each other for how long, and what capacitance that makes | geometry, topology, voronoi |
//! | [`prediction`] | how long toolpaths will be, before they are found | geometry, board, topology |
//! | [`toolpath`] | boundaries, holes, outline and a tool → a [`Program`](toolpath::Program) | geometry, board, topology, voronoi |
//! | [`gcode`] | program ↔ text; dialects are data; the reader shares nothing with the writer | geometry, toolpath |
//! | [`verify`] | text and a board → what is wrong; uses neither voronoi nor toolpath | geometry, raster, board, grid, topology, the reader |
//! | [`report`] | what a person looks at: pictures, tables, JSON | all above |
//! | [`job`] | settings, and the pipeline as one short function | all above |
//!
//! The command line (`src/cli`, in the binary alone) turns arguments into files and an exit code. A
//! test, `tests/it/layering.rs`, keeps the table true.
//!
//! # Laws
//!
//! 1. **The same bytes.** The same input gives the same output for any number of threads, on any
//!    machine. A pixel is the minimum over fragments of (depth, label), and a fragment depends on
//!    its primitive and its pixel alone; floats see only `+ − × ÷ √` and the `libm` crate; no order
//!    of a hash map, no clock and no path reaches an output.
//! 2. **Exact where it decides.** Lengths are integer nanometres; orientation, containment and
//!    contact are decided in integers.
//! 3. **The certificate decides.** Voronoi vertices and edges are solved on the exact distances of
//!    the copper's edges, or of core axes, and hold because an empty circle says so; loops and
//!    passes are level sets of the same diagram. No pixel has a part in what is cut; the picture of
//!    the regions judges it.
//! 4. **Nothing in silence.** What is skipped, too narrow or off the board is a
//!    [`Warning`](board::Warning) with a place; broken input is an error naming file, line, column
//!    and what was expected; no output is half-written.
//! 5. **Bounded memory.** Tiles are drawn, read and dropped; nothing holds a picture of the whole
//!    board to compute with.
//! 6. **Work follows boundaries.** A tile that provably belongs to one net is never drawn.
//!
//! # Example
//!
//! ```
//! use std::path::PathBuf;
//! use voromill::import::{self, Selection};
//! use voromill::job::{self, Options, Settings};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let files = [PathBuf::from("fixtures/boards/blinker")];
//! let loaded = import::load(&files, &Selection::default())?;
//! let settings = Settings::resolve(Options::default())?;
//! let job = job::mill(loaded, &settings)?;
//! let isolation = &job.programs[0];
//! println!("{}: {} lines", isolation.file_name(&job.board.name, &settings), isolation.text.lines().count());
//! # assert!(isolation.text.contains("G1 Z-0.1"), "it cuts");
//! # Ok(())
//! # }
//! ```

#![forbid(unsafe_code)]

#[cfg(feature = "mill")]
pub mod artwork;
#[cfg(feature = "mill")]
pub mod board;
#[cfg(feature = "mill")]
pub mod coupling;
#[cfg(feature = "mill")]
pub mod gcode;
#[cfg(feature = "mill")]
pub mod geometry;
#[cfg(feature = "mill")]
pub mod grid;
#[cfg(feature = "mill")]
pub mod import;
#[cfg(feature = "mill")]
pub mod job;
#[cfg(feature = "mill")]
pub mod prediction;
#[cfg(feature = "raster")]
pub mod raster;
#[cfg(feature = "mill")]
pub mod report;
#[cfg(feature = "mill")]
pub mod toolpath;
#[cfg(feature = "mill")]
pub mod topology;
#[cfg(feature = "mill")]
pub mod vectorize;
#[cfg(feature = "mill")]
pub mod verify;
#[cfg(feature = "mill")]
pub mod voronoi;
