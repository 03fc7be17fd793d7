//! `voromill probe`: the program that probes the surface for `voromill level`.

use std::path::{Path, PathBuf};

use clap::Args;
use voromill::board::Side;
use voromill::job::{self, Length, ProbeGrid, Probing};
use voromill::toolpath::Feed;

use super::config::Config;
use super::draw::SideName;
use super::input::Input;
use super::output::Output;
use super::{Failure, Shared};

/// The program that probes a board's surface, for `voromill level`
///
/// Touches the copper in a grid over the board as it will lie on the machine (with the same
/// --origin, --rotate, --tile and --mirror-axis as `voromill mill`), with the tool itself, a wire
/// on it and the spindle off. LinuxCNC keeps the touches in a file that the program names; of Grbl
/// keep what it reports. Work zero stays where it was.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Probe {
    #[command(flatten)]
    input: Input,

    /// Program to write; `-` for stdout
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,

    /// The side that is up
    #[arg(long, value_enum, default_value = "front")]
    side: SideName,

    /// Greatest distance between two probed points, or how many columns and rows, such as 7x5
    #[arg(long, value_name = "LENGTH|NxM", default_value = "10mm", help_heading = "Probing")]
    probe_grid: ProbeGrid,

    /// How far below zero the probe searches for the surface before it fails
    #[arg(long, value_name = "LENGTH", default_value = "1mm", help_heading = "Probing")]
    probe_depth: Length,

    /// Height at which the tool travels between points: above all unevenness
    #[arg(long, value_name = "LENGTH", default_value = "1mm", help_heading = "Probing")]
    probe_clearance: Length,

    /// Feed rate of probing
    #[arg(long, value_name = "SPEED", default_value = "50mm/min", help_heading = "Probing")]
    probe_feed: Feed,

    /// Distance of the outermost points from the edge of the board
    #[arg(long, value_name = "LENGTH", default_value = "0mm", help_heading = "Probing")]
    probe_inset: Length,

    #[command(flatten)]
    config: Config,
}

const EXAMPLES: &str = "\
Examples:
  voromill probe board/ -o probe.ngc --dialect linuxcnc
  voromill probe board/ -o probe.ngc --probe-grid 7x5 --probe-depth 0.5mm
  voromill probe board/ -o probe.ngc --side back --tile 3x2

Then, with what the machine has found:
  voromill level out/board-front.ngc --map board-front-probe.txt";

impl Probe {
    pub(super) fn run(self, shared: Shared) -> Result<(), Failure> {
        let settings = self.config.settings(&self.input, shared)?;
        let loaded = self.input.survey(&settings)?;
        let settings = self.config.settings_for(&self.input, &loaded.board)?;
        self.input.tell(&loaded.warnings, shared)?;
        let side = Side::from(self.side);
        let probing = Probing {
            side,
            grid: self.probe_grid,
            inset: self.probe_inset,
            depth: self.probe_depth,
            clearance: self.probe_clearance,
            feed: self.probe_feed,
        };
        let text = job::probe(&loaded, &settings, &probing)?;
        if self.output == Path::new("-") {
            return super::print(&text);
        }
        let mut output = Output::new(self.input.sources());
        output.stage(&self.output, text.as_bytes())?;
        output.commit()?;
        let is_touch = |line: &&str| line.starts_with(|c: char| !"(;".contains(c)) && line.contains("G38.2");
        let touches = text.lines().filter(is_touch).count();
        shared.report(&format!("{}: {touches} points to probe\n", self.output.display()))
    }
}
