//! The command line: one file a subcommand, and all that prints.

mod art;
mod carve;
mod colour;
mod config;
mod diff;
mod draw;
mod explain;
mod failure;
mod format;
mod given;
mod help;
mod init;
mod input;
mod inspect;
mod isolate;
mod leftovers;
mod level;
mod machine;
mod mask;
mod memory;
mod mill;
mod output;
mod pocket;
mod probe;
mod program_files;
mod progress;
mod reference;
mod scope;
mod tools;
mod verify;

use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use voromill::job::Options;
use voromill::report::stages::Stages;

use failure::Failure;

/// Gerber and drill files in, G-code for a mill out
///
/// voromill isolates the nets of a printed-circuit board along the Voronoi diagram of its copper:
/// one cut midway between neighbours, as far from copper as there is room. No GPU, no display, the
/// same bytes on every machine.
#[derive(Parser)]
#[command(version, propagate_version = true, arg_required_else_help = true, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    shared: Shared,
}

const EXAMPLES: &str = "\
Examples:
  voromill inspect board/                      what is in these files
  voromill mill board/ -o out                  all programs, pictures and the report of a board
  voromill mill board.zip -o out --tool endmill:0.2mm --depth 0.1mm
  voromill isolate board-F_Cu.gbr -o front.ngc  one layer alone
  voromill verify out/*.ngc --board board/     what programs do to the board, from any CAM
  voromill diff old/ new/                      what copper changes between programs
  voromill draw board/ --stage voronoi -o v.png  a picture of one stage
  voromill mask board/ -o front.png --dpi 1200  a mask for etching, lasers or UV light
  voromill carve logo.png -o logo.ngc --tool vbit:0.1mm:60deg --picture-dpi 600
                                               V-carve shapes, as deep as they are wide
  voromill pocket plate.svg -o plate.ngc --tool endmill:3mm --depth 4mm --depth-pass 1mm
                                               mill shapes to a flat floor
  voromill probe board/ -o probe.ngc           probe the surface of the board on the machine
  voromill level front.ngc --map probe.txt     adapt a program to the probed surface
  voromill tools                               the tools, and their kerf at several depths
  voromill machine list                        the built-in machine profiles
  voromill explain gouge                       what the code behind a message means
  voromill init                                write voromill.toml with every setting and its default

Lengths carry units: nm, um, mm, cm, mil, in. `voromill mill --help` shows the options that people use first,
`voromill mill --help-all` every one.
Exit codes: 0 done, 1 verification found something or programs differ, 2 failed.";

#[derive(Subcommand)]
#[command(defer = true)]
enum Command {
    Mill(mill::Mill),
    Isolate(isolate::Isolate),
    Draw(draw::Draw),
    Mask(mask::Mask),
    Carve(carve::Carve),
    Pocket(pocket::Pocket),
    Inspect(inspect::Inspect),
    Verify(verify::Verify),
    Diff(diff::Diff),
    Probe(probe::Probe),
    Level(level::Level),
    Tools(tools::Tools),
    Machine(machine::Machine),
    Explain(explain::Explain),
    Init(init::Init),
}

/// Where help shows what every subcommand takes: behind its own options, before --help.
const LATE: usize = 900;

/// What every subcommand takes.
#[derive(Clone, Copy, Args)]
struct Shared {
    /// Print errors alone
    #[arg(long, short, global = true, display_order = LATE)]
    quiet: bool,

    /// Print all findings and warnings, not the first few of each kind; -vv: and how long each
    /// stage took
    #[arg(long, short, global = true, conflicts_with = "quiet", action = clap::ArgAction::Count, display_order = LATE + 1)]
    verbose: u8,

    /// Number of threads; the output is the same for any [default: one for each processor]
    #[arg(long = "jobs", short = 'j', global = true, value_name = "THREADS", value_parser = clap::value_parser!(u16).range(1..=1024), display_order = LATE + 2)]
    threads: Option<u16>,
}

/// Reads the arguments, does what they say, prints errors.
pub(crate) fn run() -> ExitCode {
    memory::give_back_large_blocks();
    let print_panic = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        // What a broken picture does to its decoder is told as an error.
        if std::thread::current().name() != Some(voromill::import::picture::DECODER) {
            print_panic(panic);
        }
    }));
    let given: Vec<String> =
        std::env::args_os().map(|argument| argument.to_string_lossy().into_owned()).collect();
    if let Some(word) = given.iter().find(|word| ["-out", "-output"].contains(&word.as_str())) {
        let cause = format!("`{word}` would be read as `-o` with `{}`", &word[2..]);
        Failure::new(cause, "write -o FOLDER, or --output FOLDER").print();
        return ExitCode::from(2);
    }
    // What help says of defaults is worked out where it is shown: most runs show none.
    let read = arguments().try_get_matches().or_else(|_| command().try_get_matches());
    let (cli, matches) = match read.and_then(|matches| Ok((Cli::from_arg_matches(&matches)?, matches))) {
        Ok(read) => read,
        Err(error) => return refuse(error, given.get(1)),
    };
    let ready = scope::check(&matches).and_then(|()| cli.shared.start_threads());
    let done = ready.and_then(|()| match cli.command {
        Command::Mill(mill) => mill.run(cli.shared),
        Command::Isolate(isolate) => isolate.run(cli.shared).map(|()| ExitCode::SUCCESS),
        Command::Draw(draw) => draw.run(cli.shared).map(|()| ExitCode::SUCCESS),
        Command::Mask(mask) => mask.run(cli.shared).map(|()| ExitCode::SUCCESS),
        Command::Carve(carve) => carve.run(cli.shared),
        Command::Pocket(pocket) => pocket.run(cli.shared),
        Command::Inspect(inspect) => inspect.run(cli.shared).map(|()| ExitCode::SUCCESS),
        Command::Verify(verify) => verify.run(cli.shared),
        Command::Diff(diff) => diff.run(cli.shared),
        Command::Probe(probe) => probe.run(cli.shared).map(|()| ExitCode::SUCCESS),
        Command::Level(level) => level.run(cli.shared).map(|()| ExitCode::SUCCESS),
        Command::Tools(tools) => tools.run(cli.shared).map(|()| ExitCode::SUCCESS),
        Command::Machine(machine) => machine.run(cli.shared).map(|()| ExitCode::SUCCESS),
        Command::Explain(explain) => explain.run().map(|()| ExitCode::SUCCESS),
        Command::Init(init) => init.run(cli.shared).map(|()| ExitCode::SUCCESS),
    });
    match done {
        Ok(code) => code,
        Err(failure) => {
            failure.print();
            ExitCode::from(2)
        }
    }
}

/// Prints what is wrong with the arguments, or the help that was asked for.
fn refuse(error: clap::Error, first: Option<&String>) -> ExitCode {
    let is_path = |first: &&String| Path::new(first).exists();
    if let Some(path) = first.filter(is_path).filter(|_| error.kind() == ErrorKind::InvalidSubcommand) {
        let hint = format!("to mill it: voromill mill {path} -o out; `voromill help` lists the subcommands");
        Failure::new(format!("`{path}` is a file or a folder, and no subcommand"), hint).print();
        return ExitCode::from(2);
    }
    error.format(&mut command()).exit()
}

/// The command as it is read: of the subcommands those options are there that one is asked for.
fn arguments() -> clap::Command {
    help::with_all(Cli::command())
}

/// What options call their values that are numbers.
const NUMBERS: &[&str] = &["LENGTH", "ANGLE", "SPEED", "RPM", "NUMBER", "TIME", "PERCENT"];

/// The command as its help shows it.
fn command() -> clap::Command {
    help::shortened(whole())
}

/// The command with the default of each option that it takes, as the built-in settings have it, in
/// its help. All of it is there.
fn whole() -> clap::Command {
    let defaults = Options::defaults().listed();
    let mut command = arguments();
    command.build();
    scope::hidden(command).mut_subcommands(move |sub| {
        let defaults = defaults.clone();
        sub.mut_args(move |argument| {
            // What is wrong with a number below zero its option says, and not that `-0` is none.
            let is_number =
                |names: &[clap::builder::Str]| matches!(names, [name] if NUMBERS.contains(&name.as_str()));
            let is_number = argument.get_value_names().is_some_and(is_number);
            let argument = if is_number { argument.allow_hyphen_values(true) } else { argument };
            let key = given::key_of(argument.get_id());
            let default = defaults.iter().find(|(name, _)| *name == key).map(|(_, value)| value);
            let help = argument.get_help().map(ToString::to_string).unwrap_or_default();
            // Another subcommand's option of the same name may have a default of its own.
            let says_it = help.contains("[default: ") || !argument.get_default_values().is_empty();
            match default {
                Some(default) if !says_it && key != "frame" && key != "min-width" => {
                    argument.help(format!("{help} [default: {default}]"))
                }
                _ => argument,
            }
        })
    })
}

impl Shared {
    fn start_threads(self) -> Result<(), Failure> {
        // One for each processor where none are asked for. This thread is one of them.
        let threads = self.threads.map_or(0, usize::from);
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .use_current_thread()
            .build_global()
            .map_err(|error| Failure::new(format!("cannot start threads: {error}"), "try fewer with -j"))
    }

    /// Whether everything is told, not the first few of each.
    const fn is_verbose(self) -> bool {
        self.verbose > 0
    }

    /// Whether it is told where the time went.
    const fn tells_stages(self) -> bool {
        self.verbose > 1
    }

    /// Prints where the time went, if that was asked for, on stderr.
    fn tell_stages(self, stages: &Stages) {
        if self.tells_stages() {
            self.say(&stages.to_text());
        }
    }

    /// Prints a line for a person, on stderr so that stdout carries results alone.
    fn say(self, text: &str) {
        if !self.quiet {
            let _ = print_to(&mut io::stderr().lock(), failure::shown(text).as_bytes());
        }
    }

    /// Prints what came of it, unless nobody wants to know.
    fn report(self, text: &str) -> Result<(), Failure> {
        if !self.quiet {
            return print(&colour::on_terminal(&failure::shown(text)));
        }
        Ok(())
    }

    /// Prints what is wrong, on stderr, where errors alone are printed.
    fn complain(self, text: &str) {
        if self.quiet {
            let _ = print_to(&mut io::stderr().lock(), failure::shown(text).as_bytes());
        }
    }

    /// Whether progress may be shown.
    fn shows_progress(self) -> bool {
        !self.quiet && io::stderr().is_terminal()
    }
}

/// Prints a result.
fn print(text: &str) -> Result<(), Failure> {
    print_bytes(text.as_bytes())
}

/// Prints a result that is no text.
fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    print_to(&mut io::stdout().lock(), bytes)
        .map_err(|error| Failure::io("write", Path::new("to stdout"), &error))
}

/// A reader that went away, such as `head`, is no error; a full disk is.
fn print_to(stream: &mut impl Write, bytes: &[u8]) -> io::Result<()> {
    match stream.write_all(bytes).and_then(|()| stream.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        done => done,
    }
}
