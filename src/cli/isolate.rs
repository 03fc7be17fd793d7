//! `voromill isolate`: the isolation program of one copper layer.

use std::path::{Path, PathBuf};

use clap::Args;
use voromill::board::Side;
use voromill::gcode::Dialect;
use voromill::gcode::dialect::ToolChange;
use voromill::job::{self, Part};
use voromill::report::stages::Stages;

use super::config::Config;
use super::draw::SideName;
use super::input::Input;
use super::output::{Output, name_of};
use super::progress::Progress;
use super::{Failure, Shared};

/// The isolation program of one copper layer
///
/// Reads one copper file (with an outline beside it, if it is named too) and writes the one program
/// that isolates its nets. A back layer is mirrored, as the program's header says.
#[derive(Args)]
pub(super) struct Isolate {
    #[command(flatten)]
    input: Input,

    /// Program to write; `-` for stdout
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,

    /// The side to isolate, where there is copper for both
    #[arg(long, value_enum)]
    side: Option<SideName>,

    /// The program as the paper's software writes it: pixels of 500 DPI, its simplified paths in
    /// its order; to compare with, not to mill
    #[arg(long)]
    paper: bool,

    #[command(flatten)]
    config: Config,
}

impl Isolate {
    pub(super) fn run(self, shared: Shared) -> Result<(), Failure> {
        let settings = self.config.settings(&self.input, shared)?;
        let progress = Progress::start(shared);
        let mut stages = Stages::default();
        let mut loaded = stages.run("reading", || self.input.load(&settings), |_| [])?;
        let settings = self.config.settings_for(&self.input, &loaded.board)?;
        let sides = [Side::Front, Side::Back].into_iter().filter(|side| loaded.board.copper(*side).is_some());
        let is_asked = |side: &Side| self.side.is_none_or(|asked| Side::from(asked) == *side);
        let side = match sides.filter(is_asked).collect::<Vec<_>>()[..] {
            [side] => side,
            [] => {
                let place = |side| format!("on the {}", Side::from(side));
                let place = self.side.map_or_else(|| "in these files".to_owned(), place);
                return Err(job::Error::NoCopper(place).into());
            }
            _ => {
                let hint = "give the file of one layer, set --side, or use `voromill mill`";
                return Err(Failure::new("there is copper on both sides, but a program is for one", hint));
            }
        };
        if self.paper {
            self.config.judge_paper()?;
            self.input.tell(&loaded.warnings, shared)?;
            loaded.board.leave_copper(side);
            let text = job::paper_program(&loaded.board, side, &settings)?.unwrap_or_default();
            drop(progress);
            return self.write(&text);
        }
        let mut job = job::mill_side(loaded, side, &settings)?;
        // No other is written, so no other is told of.
        job.programs.retain(|program| matches!(program.part, Part::Front | Part::Back));
        let mut document = job.describe(&settings);
        self.input.judge(&document.warnings)?;
        drop(progress);
        stages.extend(&job.stages);
        shared.tell_stages(&stages);
        let text = job.programs.first().map_or("", |program| &program.text);
        if job.programs.len() > 1 {
            return Err(several_tools(&settings.dialect, job.programs.len()));
        }
        let is_stdout = self.output == Path::new("-");
        for entry in &mut document.programs {
            entry.file = if is_stdout { "stdout".to_owned() } else { name_of(&self.output) };
        }
        if is_stdout {
            shared.say(&document.summary(shared.is_verbose()));
            return super::print(text);
        }
        self.write(text)?;
        shared.report(&document.summary(shared.is_verbose()))
    }

    fn write(&self, text: &str) -> Result<(), Failure> {
        if self.output == Path::new("-") {
            return super::print(text);
        }
        let mut output = Output::new(self.input.sources());
        output.stage(&self.output, text.as_bytes())?;
        output.commit()
    }
}

/// Several tools where each has a file of its own, and what to do about it.
fn several_tools(dialect: &Dialect, tools: usize) -> Failure {
    let cause = format!(
        "with the dialect {} each of {tools} tools has a file of its own, but this command writes only one",
        dialect.name
    );
    let all = "`voromill mill` writes them all";
    let hint = if dialect.changes.contains(&ToolChange::M6) {
        format!("{all}; --tool-change m6 changes tools within one")
    } else if dialect.changes.contains(&ToolChange::Pause) {
        let word = &dialect.pause;
        format!("{all}; --tool-change pause waits at {word} within one, for tools that all reach as far down")
    } else {
        format!("{all}; or use one --tool")
    };
    Failure::new(cause, hint)
}
