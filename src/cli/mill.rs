//! `voromill mill`: the main job, from files to all programs, pictures and the report.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use rayon::prelude::*;
use voromill::board::Side;
use voromill::import::sha256;
use voromill::job::{self, Job, Settings};
use voromill::report::Verdict;
use voromill::report::document::OutputEntry;
use voromill::report::stages::Stages;
use voromill::report::verdict::FindingEntry;
use voromill::verify::{Report, Severity};

use super::config::Config;
use super::format::Format;
use super::input::Input;
use super::leftovers::Leftovers;
use super::output::Output;
use super::progress::Progress;
use super::{Failure, Shared};

/// All programs, pictures and the report of a board
///
/// Reads a folder, a zip archive, single files or a KiCad board, finds the copper of both sides,
/// the outline and the holes, and writes into OUT, named after the board: NAME-front.ngc and
/// NAME-back.ngc that isolate the nets (the back mirrored left to right), NAME-drill.ngc or, where
/// each tool has a program of its own, NAME-drill-0.8mm.ngc for each, NAME-cutout.ngc,
/// NAME-front.png and NAME-back.png that show what will be cut, NAME.html to look at it all in a
/// browser, and NAME.json, which lists them. What an earlier run of the board wrote there and this
/// one does not is removed. With one copper file alone, that side. The programs are read back and
/// simulated before anybody mills them: exit code 1 where that finds an error.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Mill {
    #[command(flatten)]
    input: Input,

    /// Folder for the programs, pictures and the report [default: output-dir of a millproject]
    #[arg(long, short, value_name = "OUT", required_unless_present_any = ["cache_key", "millproject"])]
    output: Option<PathBuf>,

    /// Do not verify: programs are otherwise read back, simulated and compared with the board
    #[arg(long, help_heading = "Output")]
    no_verify: bool,

    /// Exit code 1 for findings of at least this severity: info, warning or error
    #[arg(long, value_name = "SEVERITY", default_value = "error", help_heading = "Output")]
    deny: Severity,

    /// Write NAME-front.svg and NAME-back.svg too: copper, cuts and drills as lines, for documents
    #[arg(long, help_heading = "Output")]
    svg: bool,

    /// Write no NAME.html
    #[arg(long, help_heading = "Output")]
    no_html: bool,

    /// What is printed: the summary for people, or the report for programs
    #[arg(long, value_enum, default_value = "text", help_heading = "Output")]
    format: Format,

    /// The same as --format json
    #[arg(long, hide = true, help_heading = "Output")]
    json: bool,

    /// Print a key for build caches and make nothing: it is the same for the same files, settings
    /// and version
    #[arg(long, help_heading = "Output", conflicts_with_all = ["output", "json", "format"])]
    cache_key: bool,

    #[command(flatten)]
    config: Config,
}

const EXAMPLES: &str = "\
Examples:
  voromill mill board/ -o out
  voromill mill board.kicad_pcb -o out         a KiCad board, its zones filled
  voromill mill board.zip -o out --dialect linuxcnc --feed 8in/min
  voromill mill board/ -o out --tool endmill:0.2mm --depth 0.08mm --limit 1mm
  voromill mill board-B_Cu.gbr board.drl -o out --cutout-tool endmill:2mm
  voromill mill --millproject millproject      the options of pcb2gcode, as far as there is a counterpart";

impl Mill {
    pub(super) fn run(self, shared: Shared) -> Result<ExitCode, Failure> {
        let settings = self.config.settings(&self.input, shared)?;
        let progress = Progress::start(shared);
        progress.say("reading");
        let mut stages = Stages::default();
        let loaded = stages.run("reading", || self.input.load(&settings), |_| [])?;
        let mut settings = self.config.settings_for(&self.input, &loaded.board)?;
        settings.couplings = true;
        let folder = self.output.clone().or(self.input.project()?.output).filter(|_| !self.cache_key);
        if folder.is_none() && !self.cache_key {
            let hint = "set -o OUT, or output-dir in the project";
            return Err(Failure::new("no output folder is given", hint));
        }
        let Some(folder) = &folder else {
            drop(progress);
            let choices = [("no-verify", self.no_verify), ("svg", self.svg), ("no-html", self.no_html)]
                .map(|(name, chosen)| (name, chosen.to_string()));
            super::print(&format!("{}\n", job::cache_key(&loaded, &settings, &choices)))?;
            return Ok(ExitCode::SUCCESS);
        };
        progress.say("finding the boundaries between nets");
        let job = job::mill(loaded, &settings)?;
        stages.extend(&job.stages);
        let mut document = job.describe(&settings);
        self.input.judge(&document.warnings)?;
        let mut passes = true;
        if !self.no_verify {
            progress.say("simulating");
            let judge = || job.verify(&settings);
            let findings = |report: &Result<Report, _>| {
                [("findings", report.as_ref().map_or(0, |report| report.findings.len()))]
            };
            let report = stages.run("simulating", judge, findings)?;
            passes = report.passes(self.deny);
            document.verification = Some(Verdict::from(&report));
            document.leave_out_explained_gaps();
        }
        progress.say("drawing");
        let mut files = stages.run("pictures", || files(&job, &settings), |_| [])?;
        if self.svg {
            let drawn = [Side::Front, Side::Back].into_iter().filter_map(|side| Some((side, job.svg(side)?)));
            files.extend(
                drawn.map(|(side, svg)| (format!("{}-{side}.svg", job.board.name), svg.into_bytes())),
            );
        }
        if !self.no_html {
            let page = || Ok::<_, job::Error>(job.page(&settings, &document)?.to_html());
            let page = stages.run("page", page, |page| [("bytes", page.as_ref().map_or(0, String::len))])?;
            files.push((format!("{}.html", job.board.name), page.into_bytes()));
        }
        progress.say("writing");
        let entry =
            |(file, bytes): &(String, Vec<u8>)| OutputEntry { file: file.clone(), sha256: sha256(bytes) };
        document.outputs = files.iter().map(entry).collect();
        files.push((format!("{}.json", job.board.name), document.to_json().into_bytes()));
        let leftovers = Leftovers::find(folder, &files, &job.sources, &settings.dialect.extension);
        self.input.judge(&leftovers.warnings(folder))?;
        let mut output = Output::new(self.input.sources());
        output.make_folder(folder)?;
        let write = || {
            for (name, bytes) in &files {
                output.stage(&folder.join(name), bytes)?;
            }
            leftovers.obsolete.iter().for_each(|path| output.remove(path.clone()));
            output.commit()
        };
        stages.run("writing files", write, |_| [("files", files.len())])?;
        drop(progress);
        shared.tell_stages(&stages);
        shared.say(&leftovers.to_text(folder));
        let findings = document.verification.as_ref().map_or(&[][..], |verdict| &verdict.findings);
        shared.complain(&FindingEntry::failing(findings, self.deny));
        if self.json || self.format == Format::Json {
            if shared.tells_stages() {
                document.stages = stages.list().to_vec();
            }
            super::print(&document.to_json())?;
        } else {
            shared.report(&document.summary(shared.is_verbose()))?;
        }
        Ok(if passes { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }
}

/// Names and contents of the programs and their pictures.
fn files(job: &Job, settings: &Settings) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let board = &job.board.name;
    let pictures: Vec<_> = [Side::Front, Side::Back]
        .into_par_iter()
        .filter_map(|side| {
            job.picture(side, settings).map(|picture| (format!("{board}-{side}.png"), picture))
        })
        .map(|(name, picture)| Ok((name, picture?)))
        .collect::<Result<_, job::Error>>()?;
    let programs = job
        .programs
        .iter()
        .map(|program| (program.file_name(board, settings), program.text.clone().into_bytes()));
    Ok(programs.chain(pictures).collect())
}
