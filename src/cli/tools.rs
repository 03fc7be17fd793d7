//! `voromill tools`: the tools there are, and the kerf of each at several depths.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use voromill::geometry::Nm;
use voromill::job::{Length, ToolChoice, Workbench};
use voromill::toolpath::Tool;

use super::config::Config;
use super::given::above_zero;
use super::{Failure, Shared};

/// The tools there are, and their kerf at several depths
///
/// Lists the built-in tools and those of the `[tools.NAME]` tables of voromill.toml here, with
/// their speeds and the kerf of each at several depths. With --depth: the kerf at that depth; with
/// --kerf: the depth for that kerf.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Tools {
    /// Tools to show, by name or as vbit:TIP:ANGLE, endmill:DIAMETER, drill:DIAMETER [default: all]
    #[arg(value_name = "TOOL")]
    tools: Vec<ToolChoice>,

    /// Depths to show the kerf at, such as 50um,100um [default: 50um,100um,150um,200um]
    #[arg(long, value_name = "LENGTH", value_delimiter = ',', value_parser = length)]
    depth: Vec<Length>,

    /// Kerfs to show the depth for, such as 0.15mm
    #[arg(long, value_name = "LENGTH", value_delimiter = ',', value_parser = length)]
    kerf: Vec<Length>,

    /// Settings file [default: voromill.toml here, if there]
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  voromill tools
  voromill tools vbit:0.1mm:20deg --kerf 0.15mm,0.2mm
  voromill tools engraver --depth 50um,80um

A tool of your own, in voromill.toml:
  [tools.engraver-20]
  kind = \"vbit\"            # vbit, endmill or drill
  tip = \"0.1mm\"            # of a vbit; endmill and drill have a diameter
  angle = \"20deg\"
  feed = \"300mm/min\"       # keys left out are as in the settings
  plunge = \"100mm/min\"
  spindle = 20000
  number = 3               # in the machine's tool table
  kerf = \"0.15mm\"          # or depth: for isolation";

/// The depths at which kerfs are shown unless others are asked for. Chosen: about one to six times
/// common copper.
const DEPTHS: [Length; 4] =
    [Length(Nm::from_um(50)), Length(Nm::from_um(100)), Length(Nm::from_um(150)), Length(Nm::from_um(200))];

impl Tools {
    pub(super) fn run(self, _: Shared) -> Result<(), Failure> {
        let bench = Workbench::new(Config::found(self.config.as_deref(), &[])?)?;
        let choices = if self.tools.is_empty() { bench.all() } else { self.tools };
        let depths = if self.depth.is_empty() && self.kerf.is_empty() { DEPTHS.to_vec() } else { self.depth };
        let mut rows = vec![heading(&depths, &self.kerf)];
        for choice in choices {
            rows.push(row(&bench.fetch(&choice)?, bench.number(&choice), &depths, &self.kerf));
        }
        super::print(&table(&rows))
    }
}

fn length(text: &str) -> Result<Length, String> {
    above_zero(text).map(Length)
}

fn heading(depths: &[Length], kerfs: &[Length]) -> Vec<String> {
    let fixed = ["tool", "", "number", "feed", "plunge", "rpm"].map(str::to_owned);
    let depths = depths.iter().map(|depth| format!("at {depth}"));
    let kerfs = kerfs.iter().map(|kerf| format!("for {kerf}"));
    fixed.into_iter().chain(depths).chain(kerfs).collect()
}

fn row(tool: &Tool, number: Option<u32>, depths: &[Length], kerfs: &[Length]) -> Vec<String> {
    let number = number.map_or(String::new(), |number| number.to_string());
    let name = if tool.name == tool.kind.to_string() { String::new() } else { tool.name.clone() };
    let fixed = [
        name,
        tool.kind.to_string(),
        number,
        tool.feed.to_string(),
        tool.plunge.to_string(),
        tool.spindle.to_string(),
    ];
    let micrometre = |length: Nm| format!("{length:.3} mm");
    let widths = depths.iter().map(|depth| micrometre(tool.width_at(depth.nm())));
    let depths = kerfs.iter().map(|kerf| match tool.depth_for(kerf.nm()) {
        Some(Nm::ZERO) => "any".to_owned(),
        Some(depth) => micrometre(depth),
        None => "-".to_owned(),
    });
    fixed.into_iter().chain(widths).chain(depths).collect()
}

/// Rows in columns: text to the left, what begins with a digit to the right.
fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for ((cell, width), column) in row.iter().zip(&widths).zip(0..) {
            let _ =
                if column < 2 { write!(line, "  {cell:width$}") } else { write!(line, "  {cell:>width$}") };
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
