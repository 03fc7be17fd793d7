//! Writes a program in a dialect of one's own: `cargo run --example own_dialect`.
#![expect(clippy::print_stdout, reason = "an example shows what it did")]

use std::error::Error;
use std::path::PathBuf;

use voromill::gcode::{self, Dialect, Header, dialect};
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Settings};

fn main() -> Result<(), Box<dyn Error>> {
    // A controller that knows no arcs, wants three decimals, and beeps when it is done.
    let grbl = Dialect::by_name("grbl").ok_or("grbl is built in")?;
    let end = vec!["M300 S440 P200".into(), "M2".into()];
    let mine = Dialect {
        name: "mine".into(),
        decimals: 3,
        arcs: dialect::Arcs::Lines,
        end: end.into(),
        ..grbl.clone()
    };

    let loaded = import::load(&[PathBuf::from("fixtures/boards/blinker")], &Selection::default())?;
    let job = job::mill(loaded, &Settings::resolve(Options::default())?)?;
    let text = gcode::write(&job.programs[0].program, &mine, &Header::default());
    let lines: Vec<&str> = text.lines().collect();
    println!("{}\n…\n{}", lines[..12].join("\n"), lines[lines.len() - 4..].join("\n"));
    Ok(())
}
