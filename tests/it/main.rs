//! The integration tests: one module a stage, one binary.

mod aperture_lists;
mod cli;
mod excellon;
mod gcode;
mod gerber;
mod gerber_constructs;
mod gerber_damage;
mod gl_parity;
mod job;
mod layering;
mod layers;
mod oracle;
mod outline;
mod page;
mod paper;
mod programs;
mod raster;
mod snapshot;
mod toolpath;
mod topology;
mod verdict;
mod verify;
mod verify_cli;
mod verify_foreign;
mod verify_mutations;
mod voronoi;
