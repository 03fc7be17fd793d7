//! voromill
#![cfg_attr(not(test), warn(clippy::unwrap_used))]

pub mod board;
pub mod gcode;
pub mod geometry;
pub mod grid;
pub mod import;
pub mod job;
pub mod raster;
pub mod report;
pub mod toolpath;
pub mod topology;
pub mod voronoi;
