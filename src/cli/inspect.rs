//! `voromill inspect`: what is in the files, before anything is made of them.

use clap::Args;
use voromill::job::{coupling, inspect, neighbours, paper};
use voromill::topology::Pattern;

use super::config::Config;
use super::format::Format;
use super::input::Input;
use super::{Failure, Shared};

/// What is in these files
///
/// Lists each file with its role, format, units and apertures; size, nets, names, smallest gaps and
/// holes of the board; and everything that was repaired or left out. Nothing is written.
#[derive(Args)]
pub(super) struct Inspect {
    #[command(flatten)]
    input: Input,

    /// As text for people or JSON for programs
    #[arg(long, value_enum, default_value = "text")]
    format: Format,

    /// Add the figures of the paper's Table V, computed the paper's way at 500 DPI, and voromill's
    /// own beside them
    ///
    /// Run times are among them, so no two runs print the same.
    #[arg(long)]
    paper: bool,

    /// Add how strongly neighbouring nets are coupled: length over gap and an estimate in pF, as
    /// Voronoi regions and as drawn; `--coupling=CLK,D*` says of these nets what --limit helps
    ///
    /// The estimate takes two nets for coplanar strips as wide as each is on average, on FR-4 as
    /// thick as the board, along the boundary between them.
    #[arg(
        long,
        value_name = "PATTERN",
        value_delimiter = ',',
        num_args = 0..,
        require_equals = true,
        default_missing_value = ""
    )]
    coupling: Option<Vec<Pattern>>,

    /// Add which nets are neighbours by thinning (`draw --stage thinning`) and which by Voronoi
    /// regions, with the places of those that only one of them has
    #[arg(long)]
    thinning: bool,

    #[command(flatten)]
    config: Config,
}

impl Inspect {
    pub(super) fn run(self, shared: Shared) -> Result<(), Failure> {
        let settings = self.config.settings(&self.input, shared)?;
        let loaded = self.input.survey(&settings)?;
        let settings = self.config.settings_for(&self.input, &loaded.board)?;
        let mut inspection = inspect(&loaded, &settings);
        if self.paper {
            for layer in &mut inspection.layers {
                layer.paper = paper(&loaded.board, layer.side)?;
            }
        }
        if self.thinning {
            for layer in &mut inspection.layers {
                let Some(copper) = loaded.board.copper(layer.side) else { continue };
                let own = self.input.thinned_as_it_lies(&settings, layer.side, &loaded)?;
                layer.thinning = Some(neighbours(copper, &loaded.board, &settings, own)?);
            }
        }
        if let Some(asked) = &self.coupling {
            let mut are_met = vec![false; asked.len()];
            for layer in &mut inspection.layers {
                let Some(copper) = loaded.board.copper(layer.side) else { continue };
                let (found, have_met) = coupling(copper, loaded.board.outline.as_ref(), &settings, asked)?;
                layer.coupling = Some(found);
                are_met.iter_mut().zip(have_met).for_each(|(before, met)| *before |= met);
            }
            let unmet = asked.iter().zip(are_met).filter(|(_, is_met)| !is_met);
            if let Some(pattern) = unmet.map(|(pattern, _)| pattern.to_string()).find(|p| !p.is_empty()) {
                let hint = "compare it with the names that `voromill inspect -v` lists";
                return Err(Failure::new(format!("no net is called `{pattern}`"), hint));
            }
        }
        super::print(&match self.format {
            Format::Text => inspection.to_text(shared.is_verbose()),
            Format::Json => inspection.to_json(),
        })?;
        self.input.judge(&inspection.warnings)
    }
}
