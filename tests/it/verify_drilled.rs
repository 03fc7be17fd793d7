//! What holes leave of copper, though each is where the board has it.

use std::fmt::Write as _;
use std::fs;

use tempfile::TempDir;
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Settings};
use voromill::verify::{self, Program, Severity, verify};

/// What is found of copper, `objects` of a Gerber file in millimetres, with `holes`, each a
/// diameter and the words of a drill file.
fn told(objects: &str, holes: &[(f64, &str)], options: &str) -> Vec<(&'static str, String)> {
    let folder = TempDir::new().expect("a folder");
    let write = |name: &str, text: String| fs::write(folder.path().join(name), text).expect("written");
    let apertures =
        "%ADD10C,1.6*%\n%ADD11C,0.4*%\n%ADD12C,0.8*%\n%ADD13C,2.2X1*%\n%ADD14R,6X6*%\n%ADD15C,2.05*%";
    let front = "%TF.FileFunction,Copper,L1,Top*%\n%FSLAX42Y42*%\n%MOMM*%";
    write("plate-F_Cu.gbr", format!("{front}\n{apertures}\n{objects}\nM02*\n"));
    let ring = "D10*\nX0Y0D02*\nX4000D01*\nY2000D01*\nX0D01*\nY0D01*";
    let profile = "%TF.FileFunction,Profile,NP*%\n%FSLAX42Y42*%\n%MOMM*%\n%ADD10C,0.1*%";
    write("plate-Edge_Cuts.gbr", format!("{profile}\n{ring}\nM02*\n"));
    let mut drill = "M48\nMETRIC\n".to_owned();
    for (index, (diameter, _)) in holes.iter().enumerate() {
        writeln!(drill, "T{}C{diameter}", index + 1).expect("a string");
    }
    drill += "%\n";
    for (index, (_, places)) in holes.iter().enumerate() {
        writeln!(drill, "T{}\n{places}", index + 1).expect("a string");
    }
    write("plate.drl", drill + "M30\n");
    let loaded = import::load(&[folder.path().to_path_buf()], &Selection::default()).expect("a board");
    let options = Options::from_toml("settings", options).expect("options");
    let job = job::mill(loaded, &Settings::resolve(options).expect("settings")).expect("a job");
    let program = |written: &job::Written| Program {
        file: written.tag.clone(),
        text: written.text.clone(),
        ..Program::default()
    };
    let programs: Vec<Program> = job.programs.iter().map(program).collect();
    let report = verify(&programs, &job.board, &[], &verify::Settings::default()).expect("a verdict");
    let findings = report.findings.into_iter().filter(|finding| finding.severity >= Severity::Warning);
    findings.map(|finding| (finding.name, finding.message)).collect()
}

/// A trace of 0.4 mm from x = 5 to 15 at y = 10 with pads of this aperture at its ends; and one
/// from x = 25 to 35.
fn traces(pad: u32) -> String {
    let trace = |x: u32| {
        let (from, to) = (x * 100, x * 100 + 1000);
        format!("D{pad}*\nX{from}Y1000D03*\nX{to}D03*\nD11*\nX{from}Y1000D02*\nX{to}D01*")
    };
    format!("{}\n{}", trace(5), trace(25))
}

#[test]
fn a_hole_as_wide_as_its_pad_leaves_no_ring() {
    let missing = ("ring-missing", "next to nothing is left of the pad of net 1 round a hole".to_owned());
    for (pad, hole, expected) in [
        // 1.6 mm leave 0.4 mm round a hole of 0.8 mm, 0.025 mm round one of 1.55 mm.
        (10, 0.8, false),
        (10, 1.4, false),
        (10, 1.55, true),
        (12, 0.8, true),
        (12, 1.0, true),
        (12, 0.6, false),
        // An aperture with a hole of 1 mm, which the drill finds.
        (13, 1.0, false),
        (13, 2.2, false),
        // A screw.
        (15, 2.05, false),
    ] {
        let found = told(&traces(pad), &[(hole, "X5.0Y10.0")], "");
        let expected = if expected { vec![missing.clone()] } else { Vec::new() };
        assert_eq!(found, expected, "a hole of {hole} mm in D{pad}");
    }
    let lone = "D12*\nX500Y500D03*\nX1500Y500D03*";
    assert_eq!(told(lone, &[(0.8, "X5.0Y5.0")], ""), [], "nothing leads to it");
    let snapped = |drill: &str| told(&traces(12), &[(0.65, "X5.0Y10.0")], &format!("drills = [\"{drill}\"]"));
    assert_eq!(snapped("0.66mm"), []);
    assert!(snapped("0.74mm").contains(&missing), "the drill that there is takes the pad");
}

#[test]
fn a_hole_through_a_trace_is_told() {
    let parted = ("hole-in-copper", "net 1 is cut in two by a hole".to_owned());
    let traces = traces(10);
    for (hole, place, expected) in [
        (0.6, "X10.0Y10.0", Some(parted.clone())),
        (0.6, "X10.0Y10.3", Some(("hole-in-copper", "a hole reaches 0.200 mm into net 1".to_owned()))),
        (0.6, "X10.0Y10.6", None),
        // A slot across.
        (0.6, "X10.0Y9.0G85X10.0Y11.0", Some(parted.clone())),
        // Within the trace.
        (0.2, "X10.0Y10.0", None),
    ] {
        let found = told(&traces, &[(hole, place)], "");
        assert_eq!(found, Vec::from_iter(expected), "{hole} mm at {place}");
    }
    // A way round: from the pad up, across and down again.
    let round = "D11*\nX500Y1000D02*\nY1500D01*\nX1500D01*\nY1000D01*";
    let found = told(&format!("{traces}\n{round}"), &[(0.6, "X10.0Y10.0")], "");
    assert_eq!(found, [], "the net hangs together");
    let far = told(&format!("{traces}\n{round}"), &[(0.6, "X10.0Y10.0\nX10.0Y15.0")], "");
    assert_eq!(far, [parted.clone(), parted], "each of two holes lies between the parts");
}

#[test]
fn a_hole_that_two_nets_reach_is_told() {
    let near = "D10*\nX1000Y1000D03*\nX1180Y1000D03*\nX3000Y1500D03*";
    let found = told(near, &[(0.8, "X10.9Y10.0")], "");
    let both = ("hole-in-copper", "a hole reaches into net 1 and net 2".to_owned());
    assert!(found.contains(&both), "{found:?}");
    assert_eq!(told(near, &[(0.8, "X10.0Y10.0\nX11.8Y10.0")], ""), [], "each in its pad");
    let plane = "D14*\nX1000Y1000D03*\nD10*\nX3000Y1000D03*";
    assert_eq!(told(plane, &[(1.0, "X10.0Y10.0\nX12.0Y11.0")], ""), [], "within a plane");
}
