//! Boards drawn for one trap each, isolated and judged by the command line.

use std::path::Path;

use tempfile::TempDir;

use crate::cli::{stderr, stdout, voromill};

/// A coordinate of a file, in its nanometres, from millimetres.
fn place((x, y): (f64, f64)) -> String {
    format!("X{:.0}Y{:.0}", x * 1e6, y * 1e6)
}

fn line(aperture: u32, from: (f64, f64), to: (f64, f64)) -> String {
    format!("D{aperture}*\n{}D02*\n{}D01*\n", place(from), place(to))
}

fn flash(aperture: u32, at: (f64, f64)) -> String {
    format!("D{aperture}*\n{}D03*\n", place(at))
}

fn region(corners: &[(f64, f64)]) -> String {
    let first = corners[0];
    let lines: String = corners[1..].iter().chain([&first]).map(|&p| place(p) + "D01*\n").collect();
    format!("G36*\n{}D02*\n{lines}G37*\n", place(first))
}

/// A layer drawn with round apertures of these diameters, the first of which is D10.
fn layer(diameters: &[f64], drawn: &str) -> String {
    let defined = (10..).zip(diameters).map(|(number, mm)| format!("%ADD{number}C,{mm}*%\n"));
    format!("%FSLAX46Y46*%\n%MOMM*%\n{}{drawn}M02*\n", defined.collect::<String>())
}

/// A folder with such a board, and an outline from zero to here where there is one.
fn board(diameters: &[f64], drawn: &str, outline: Option<(f64, f64)>) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("b")).expect("a folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    write("b/b.gtl", &layer(diameters, drawn));
    if let Some((x, y)) = outline {
        let corners = [(0.0, 0.0), (x, 0.0), (x, y), (0.0, y)];
        let sides = (0..4).map(|i| line(10, corners[i], corners[(i + 1) % 4]));
        write("b/b.gko", &layer(&[0.1], &sides.collect::<String>()));
    }
    folder
}

/// What is said of the board's program, isolated with these options: what `verify` finds.
#[track_caller]
fn judged(folder: &Path, options: &[&str]) -> String {
    let made = voromill(folder, &[&["isolate", "b", "-o", "b.ngc"], options].concat());
    assert!(made.status.success(), "{}", stderr(&made));
    let found = voromill(folder, &["verify", "--board", "b", "--", "b.ngc"]);
    stdout(&found) + &stderr(&found)
}

#[track_caller]
fn is_clean(folder: &Path, options: &[&str]) {
    let said = judged(folder, options);
    assert!(said.contains("nothing found"), "{options:?}: {said}");
}

/// A pour drawn past the edge of the board, and a trace whose clearance parts the board between its
/// ends: it lies in both fields.
#[test]
fn a_net_that_loops_leave_in_several_fields_is_in_all_of_them() {
    let pour = region(&[(-1.0, -1.0), (21.0, -1.0), (21.0, 16.0), (-1.0, 16.0)]);
    let round = |aperture: u32, end: f64| {
        line(aperture, (5.0, end), (5.0, 6.0))
            + &line(aperture, (5.0, 6.0), (12.0, 6.0))
            + &line(aperture, (12.0, 6.0), (12.0, end))
    };
    let finger = |aperture: u32| line(aperture, (8.5, 2.0), (8.5, 4.0));
    let drawn = [&pour, "%LPC*%\n", &round(10, -0.4), &finger(10), "%LPD*%\n", &round(11, 0.1), &finger(11)];
    let board = board(&[1.1, 0.5], &drawn.concat(), Some((20.0, 15.0)));
    is_clean(board.path(), &["--strategy-for", "*2=outline"]);
    is_clean(board.path(), &["--strategy", "auto"]);
}

/// The medial axis of a round void is a place, and no line.
#[test]
fn the_middle_of_a_round_void_is_cleared() {
    let plane = region(&[(1.0, 1.0), (12.0, 1.0), (12.0, 15.0), (1.0, 15.0)]);
    let drawn = plane + "%LPC*%\n" + &flash(10, (6.5, 8.0)) + "%LPD*%\n" + &flash(11, (16.0, 8.0));
    for diameter in [4.58, 4.2, 5.0, 6.1, 2.4] {
        let board = board(&[diameter, 1.5], &drawn, Some((20.0, 16.0)));
        is_clean(board.path(), &["--tool", "endmill:1mm", "--clear"]);
    }
}

/// Beside the area that is kept, what is to be cleared ends far from all copper.
#[test]
fn passes_round_what_is_kept_end_where_nothing_is_cleared() {
    let drawn = flash(10, (2.0, 2.0)) + &flash(10, (6.0, 2.0));
    let board = board(&[1.5], &drawn, Some((80.0, 50.0)));
    let areas = ["--clear-area", "30mm,35mm,9mm,10mm", "--clear-area", "47mm,35mm,9mm,10mm"];
    let options = [&["--tool", "endmill:1mm"], &areas[..], &["--keep-area", "32mm,38mm,22mm,4mm"]].concat();
    is_clean(board.path(), &options);
    let text = std::fs::read_to_string(board.path().join("b.ngc")).expect("a program");
    // Straight through the gap between both areas.
    let word = |line: &str, letter: char| {
        let words = line.split_whitespace().find_map(|word| word.strip_prefix(letter));
        words.and_then(|number| number.parse::<f64>().ok())
    };
    let mut x = 0.0;
    for line in text.lines().filter(|line| line.starts_with('G')) {
        let to = word(line, 'X').unwrap_or(x);
        let crosses = x.min(to) < 41.0 && x.max(to) > 45.0;
        assert!(!crosses || line.starts_with("G0"), "{line} cuts between the areas");
        x = to;
    }
}

#[test]
fn what_is_ignored_counts_for_no_zero() {
    let drawn = flash(10, (2.0, 2.0)) + &flash(10, (5.0, 2.0)) + &flash(10, (8.0, 2.0));
    let board = board(&[1.5], &drawn, None);
    is_clean(board.path(), &["--ignore", "*1"]);
    let made = voromill(board.path(), &["mill", "b", "-o", "out", "--ignore", "*1", "--no-html"]);
    assert!(made.status.success(), "{}", stderr(&made));
    let extent = |path: &str| -> String {
        let text = std::fs::read_to_string(board.path().join(path)).expect("a program");
        text.lines().find(|line| line.starts_with("(x ")).expect("how far it goes").to_owned()
    };
    assert_eq!(extent("b.ngc"), extent("out/board-front.ngc"), "where one command and the other have it");
}

/// Midway between two axes the gap is narrowest where a pad lies, far from the ends of the
/// boundary.
#[test]
fn a_pad_on_a_trace_takes_a_finer_tool_beside_it() {
    let trace = |y: f64| line(10, (2.0, y), (28.0, y));
    let drawn = trace(5.0) + &trace(7.0) + &flash(11, (15.0, 7.0));
    let board = board(&[0.3, 1.6], &drawn, Some((30.0, 12.0)));
    let options = ["--sites", "core", "--tool", "endmill:0.8mm,endmill:0.1mm", "--no-html"];
    let made = voromill(board.path(), &[&["mill", "b", "-o", "out"], &options[..]].concat());
    let said = stdout(&made) + &stderr(&made);
    assert!(made.status.success() && said.contains("nothing found"), "{said}");
}

/// Passes part the boundary of a gap; it is one gap nevertheless.
#[test]
fn a_narrow_gap_is_told_once_however_many_passes_there_are() {
    let trace = |y: f64| line(10, (2.0, y), (28.0, y));
    let board = board(&[0.3], &(trace(5.0) + &trace(5.35)), Some((30.0, 12.0)));
    let options = ["--tool", "endmill:0.1mm"];
    for more in [&[][..], &["--width", "0.5mm"], &["--width", "1mm"], &["--clear"]] {
        let made = voromill(board.path(), &[&["isolate", "b", "-o", "b.ngc"], &options[..], more].concat());
        let said = stdout(&made) + &stderr(&made);
        assert!(made.status.success(), "{said}");
        assert_eq!(said.matches("gap-narrower-than-tool").count(), 1, "{more:?}: {said}");
        assert!(!said.contains("gaps are narrower"), "{more:?}: {said}");
    }
}
