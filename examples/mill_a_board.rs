//! Mills a board through `job`:
//! `cargo run --release --example mill_a_board -- fixtures/boards/regulator out`.
#![expect(clippy::print_stdout, reason = "an example shows what it did")]

use std::error::Error;
use std::path::PathBuf;
use std::{env, fs};

use voromill::import::{self, Selection};
use voromill::job::{self, Options, Settings};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let board = PathBuf::from(arguments.next().unwrap_or_else(|| "fixtures/boards/regulator".to_owned()));
    let out = PathBuf::from(arguments.next().unwrap_or_else(|| "out".to_owned()));

    let loaded = import::load(&[board], &Selection::default())?;
    let options = Options::from_toml("here", "tool = \"endmill:0.2mm\"\ndepth = \"0.08mm\"")?;
    let settings = Settings::resolve(options)?;
    let job = job::mill(loaded, &settings)?;

    fs::create_dir_all(&out)?;
    for program in &job.programs {
        let name = program.file_name(&job.board.name, &settings);
        fs::write(out.join(&name), &program.text)?;
        println!(
            "{name}: {} lines, {:.1} min",
            program.text.lines().count(),
            program.statistics.seconds / 60.0
        );
    }
    for warning in &job.warnings {
        println!("warning: {} [{}]", warning.text(), warning.code());
    }
    Ok(())
}
