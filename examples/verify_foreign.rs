//! Judges G-code that somebody else's program wrote.
//!
//! `cargo run --example verify_foreign` mills two loops of straight lines, one of them with its
//! last side left out, round two pads.
#![expect(clippy::print_stdout, reason = "an example shows what it did")]

use voromill::board::Side;
use voromill::import::{self, Selection};
use voromill::verify::{Program, Role, Settings, Severity, verify};

const LOOPS: &str = "G21 G90
G0 Z2
M3 S10000
G0 X0.85 Y0.85
G1 Z-0.1 F120
G1 X3.15
G1 Y3.15
G1 X0.85
G1 Y0.85
G0 Z2
G0 X3.85 Y0.85
G1 Z-0.1
G1 X6.15
G1 Y3.15
G1 X3.85
G0 Z2
M5
M30
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let copper = concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/verify/pads-F_Cu.gbr");
    let board = import::load(&[copper.into()], &Selection::default())?.board;
    // A foreign program names neither its tool nor the side; where it lies on the board can be
    // found with `verify::register`.
    let program = Program {
        file: "loops.nc".to_owned(),
        text: LOOPS.to_owned(),
        role: Some(Role::Isolation(Side::Front)),
        cutter: Some("endmill:0.2mm".parse()?),
        placement: None,
        ..Program::default()
    };
    let report = verify(&[program], &board, &[], &Settings::default())?;
    for finding in &report.findings {
        println!("{}: {} [{}]", finding.severity, finding.message, finding.name);
    }
    println!("{} errors", report.count(Severity::Error));
    Ok(())
}
