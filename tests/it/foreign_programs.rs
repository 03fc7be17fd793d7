//! Programs as people and other tools write them, followed as their controllers would run them.

use std::path::PathBuf;

use voromill::gcode::read;
use voromill::gcode::read::{Listing, Spindle, Way};
use voromill::geometry::Nm;

use crate::corpus;

/// Ends of all motions in millimetres; not a number where it is not known.
fn ends(listing: &Listing) -> Vec<[f64; 3]> {
    let mm = |at: Option<Nm>| at.map_or(f64::NAN, Nm::to_mm);
    listing.motions.iter().map(|motion| [mm(motion.to.x), mm(motion.to.y), mm(motion.to.z)]).collect()
}

#[track_caller]
fn assert_ends(text: &str, expected: &[[f64; 3]]) -> Listing {
    let listing = read(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let found = ends(&listing);
    let alike = |a: f64, b: f64| (a - b).abs() < 1e-5 || (a.is_nan() && b.is_nan());
    let same = found.len() == expected.len()
        && found.iter().zip(expected).all(|(a, b)| a.iter().zip(b).all(|(a, b)| alike(*a, *b)));
    assert!(same, "{text}\ngoes to {found:?}\nnot to {expected:?}");
    listing
}

#[track_caller]
fn assert_notes(listing: &Listing, expected: &[(bool, &str)]) {
    let found: Vec<(bool, &str)> =
        listing.notes.iter().map(|note| (note.warns, note.message.as_str())).collect();
    let same = found.len() == expected.len()
        && found.iter().zip(expected).all(|(a, b)| a.0 == b.0 && a.1.contains(b.1));
    assert!(same, "noted is {found:?}, not {expected:?}");
}

/// What is not known.
const NOWHERE: f64 = f64::NAN;

#[test]
fn parameters_loops_and_subprograms_run_as_linuxcnc_runs_them() {
    let text = "g21 g90 g0 x0 y0 z1\no<row> sub\n#<end> = [#1 * 2]\no1 while [#2 gt 0]\ng1 x#<end> z-.1 f100\n\
                #2 = [#2 - 1]\no1 endwhile\no<row> endsub [#<end> + 1]\n#1 = 7\no<row> call [1.5] [2]\n\
                o2 if [#<_value> eq 4 and #1 eq 7]\ng0 y5\no2 elseif [1]\ng0 y6\no2 else\ng0 y7\no2 endif\n\
                o3 repeat [2]\no4 if [#9 eq 1]\no3 break\no4 endif\n#9 = 1\ng91 g0 x1\ng90\no3 endrepeat\n\
                o5 do\n#<n> = [#<n2> + 1]\n#<n2> = #<n>\no5 while [#<n> lt 2]\ng0 z[-#<n>]\nm2\n";
    let text = text.replace("#9 = 1\n", "#9 = 1\n#<n2> = 0\n");
    let mut expected = vec![[0.0, 0.0, 1.0], [3.0, 0.0, -0.1], [3.0, 0.0, -0.1], [3.0, 5.0, -0.1]];
    expected.extend([[4.0, 5.0, -0.1], [4.0, 5.0, -2.0]]);
    let listing = assert_ends(&text, &expected);
    assert_notes(&listing, &[(true, "#9 is read before")]);
}

#[test]
fn subprograms_of_numbers_run_as_often_as_they_are_asked_for() {
    let text = "%\nG21 G90 G0 X0 Y0 Z1\nM98 P7 L2\nM98 P20007\nM30\nO7 (a hole)\nG91 G0 X1\nM99\n%\nX100\n";
    assert_ends(text, &[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0], [3.0, 0.0, 1.0], [4.0, 0.0, 1.0]]);
}

#[test]
fn loops_without_end_are_refused_and_do_not_hang() {
    let cases = [
        ("o1 while [1]\no1 endwhile\n", "no end"),
        ("o1 sub\no1 call\no1 endsub\no1 call\n", "call each other"),
        ("g21 g0 x0 y0 z1\ng83 x0 y0 z-999 r1 q0.0001 f1\n", "pecks of a micrometre"),
        ("o1 while [1]\n", "has no end"),
        ("o1 call\n", "not in this file"),
        ("o1 endsub\n", "nothing has called"),
    ];
    for (text, reason) in cases {
        let error = read(text).expect_err(text).to_string();
        assert!(error.contains(reason), "`{text}` gives `{error}`, without `{reason}`");
    }
}

#[test]
fn a_moved_zero_moves_what_follows() {
    let text = "G21 G90\nG92 X10 Y20 Z5\nG0 X11\nG92 X0\nG0 X1\nG92.2\nG0 X1\nG92.3 G0 X1\n";
    // The second line says where the machine stands; the fourth makes of 11 zero.
    let ends = [[11.0, 20.0, 5.0], [12.0, 20.0, 5.0], [1.0, 20.0, 5.0]];
    let listing = assert_ends(&text.replace("G92.3 G0 X1\n", ""), &ends);
    assert!(listing.indirect.is_some(), "its lines cannot be changed one by one");
    let text = "G21 G90 G10 L2 P1 X5 Y0\nG10 L2 P2 X25 Y0\nG54 G0 X1 Y0 Z2\nG55 G0 X1\nG53 G0 X0\nG10 L20 P2 X3\nG0 X4\n";
    let ends = [[1.0, 0.0, 2.0], [21.0, 0.0, 2.0], [-5.0, 0.0, 2.0], [-4.0, 0.0, 2.0]];
    assert_ends(text, &ends);
}

#[test]
fn a_place_of_the_machine_is_a_retract_where_it_can_only_be_one() {
    let text = "G21 G90 G0 X1 Y2 Z3\nG53 G0 Z0\nG0 X5\nZ1\nG91 G28 Z0\nG90 G28\nG0 X0 Y0\n";
    let known = [[1.0, 2.0, 3.0], [1.0, 2.0, NOWHERE], [5.0, 2.0, NOWHERE], [5.0, 2.0, 1.0]];
    let home = [[5.0, 2.0, NOWHERE], [NOWHERE, NOWHERE, NOWHERE], [0.0, 0.0, NOWHERE]];
    let listing = assert_ends(text, &[known.as_slice(), &home].concat());
    assert_notes(&listing, &[(false, "assumed to be above all work")]);
    let low = read("G21 G90 G0 X1 Y2 Z3\nG53 G0 Z-50\n").expect("followed");
    assert_notes(&low, &[(true, "its height above the board")]);
}

#[test]
fn printers_home_axes_that_are_named_without_numbers() {
    let text = "G21 G90 G0 X1 Y2 Z3\nG28 Z\nG0 X5\nG28 X Y\nG0 X0 Y0\nM84 X Y E\n";
    let ends = [[1.0, 2.0, 3.0], [1.0, 2.0, NOWHERE], [5.0, 2.0, NOWHERE], [NOWHERE; 3], [0.0, 0.0, NOWHERE]];
    let listing = assert_ends(text, &ends);
    assert_notes(&listing, &[(false, "assumed to be above all work")]);
}

#[test]
fn sideways_before_a_height_is_told() {
    let rest = "G0 X1 Y1\nX2\nG0 Z2\nG0 X3\nG1 Z-0.1 F100\nM2\n";
    let (told, above) = ((true, "before it says how high"), (false, "assumed to be above all work"));
    for (start, expected) in [("", &[told][..]), ("G0 Z2\n", &[]), ("G53 G0 Z0\n", &[above])] {
        let listing = read(&format!("G21 G90\nM3 S1000\n{start}{rest}")).expect("followed");
        assert_notes(&listing, expected);
    }
}

#[test]
fn a_cut_to_where_nobody_can_know_is_refused() {
    let cases = [
        ("G21 G54 G0 X0 Y0 Z1\nG1 Z-.1 F9\nG55 G1 X5\n", "an unknown position"),
        ("G21 G0 X0 Y0 Z-1\nG53 G1 X-50\n", "a cut to a machine position"),
        ("G21 G0 X0 Y0 Z1\nG28\nG91 G1 X1 F9\n", "does not give"),
        ("G21 G41 D1\nG1 X1 F9\n", "cutter compensation since line 1"),
        ("G21 G0 X[#5221]\n", "only the controller knows"),
        ("G21 G68 X0 Y0 R30\n", "rotated"),
        ("G21 M97 P1\n", "a jump"),
    ];
    for (text, reason) in cases {
        let error = read(text).expect_err(text).to_string();
        assert!(error.contains(reason), "`{text}` gives `{error}`, without `{reason}`");
    }
    read("G21 G55 G0 X0 Y0 Z1\nG1 Z-.1 F9\nX5\nG53 G0 Z0\nG54\nG41\nG40\nM30\n")
        .expect("one system, no path");
}

#[test]
fn cycles_drill_in_all_planes_back_to_where_they_are_told() {
    // G98 goes back to 2; the second hole only to R.
    let text = "G21 G90 G17 G98 G0 X0 Y0 Z2\nG82 X1 Z-1 R1 P0.5 F60\nG99 X2\nG80\n";
    let holes = [
        [0.0, 0.0, 2.0],
        [1.0, 0.0, 2.0],
        [1.0, 0.0, 1.0],
        [1.0, 0.0, -1.0],
        [1.0, 0.0, 2.0],
        [2.0, 0.0, 2.0],
        [2.0, 0.0, 1.0],
        [2.0, 0.0, -1.0],
        [2.0, 0.0, 1.0],
    ];
    assert_eq!(assert_ends(text, &holes).dwell, 1000, "half a second in each hole");
    // Along Y, twice, a step apart, R and Z counted from where it is; out at the feed.
    let text = "G21 G90 G18 G99 G0 X0 Y2 Z0\nG91 G85 X1 Y-2 R-1 L2 F60\n";
    let bored = [
        [0.0, 2.0, 0.0],
        [1.0, 2.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, -1.0, 0.0],
        [1.0, 1.0, 0.0],
        [2.0, 1.0, 0.0],
        [2.0, -1.0, 0.0],
        [2.0, 1.0, 0.0],
    ];
    let listing = assert_ends(text, &bored);
    assert!(listing.motions[4].way == Way::Feed, "a bore is left at the feed");
    let broken = read("G21 G90 G0 X0 Y0 Z1\nG73 Z-2 R0 Q1.5 X0 F60\n").expect("followed");
    let depths: Vec<f64> = ends(&broken).iter().map(|end| end[2]).collect();
    assert_eq!(
        depths,
        [1.0, 1.0, 0.0, -1.5, -1.246, -2.0, 0.0],
        "chips are broken a hundredth of an inch up"
    );
}

#[test]
fn arcs_run_in_all_planes_and_several_times_round() {
    let text = "G21 G90 G0 X1 Y0 Z0\nG2 X1 Y0 I-1 P3 Z-3 F60\n";
    let listing = assert_ends(text, &[[1.0, 0.0, 0.0], [1.0, 0.0, -1.0], [1.0, 0.0, -2.0], [1.0, 0.0, -3.0]]);
    assert!(matches!(listing.motions[1].way, Way::Arc { .. }), "a whole turn each");
    // A half turn over the board, from x = 0 to x = 2, counter-clockwise from Z to X.
    let listing = read("G21 G90 G0 X0 Y0 Z0\nG18 G3 X2 Z0 R1 F60\n").expect("followed");
    let top = ends(&listing).iter().map(|end| end[2]).fold(f64::MIN, f64::max);
    assert!((top - 1.0).abs() < 1e-3, "it rises to {top}");
    let off = ends(&listing)[1..]
        .iter()
        .map(|end| (libm::hypot(end[0] - 1.0, end[2]) - 1.0).abs())
        .fold(0.0, f64::max);
    assert!(off < 1e-6, "all its points lie on the arc but {off} mm");
}

#[test]
fn what_is_restored_is_all_but_the_kind_of_motion() {
    let text = "G21 G90 G0 X0 Y0 Z1\nM70\nG1 G91 G20 X1 F10\nM72\nX2\nM2\n";
    let listing = assert_ends(text, &[[0.0, 0.0, 1.0], [25.4, 0.0, 1.0], [2.0, 0.0, 1.0]]);
    assert_eq!(listing.motions[2].way, Way::Feed, "the G1 of before M72 goes on");
}

#[test]
fn curves_run_through_their_points() {
    let weights = "G21 G90 G0 X1 Y0 Z0\nG5.2 X1 Y1 P0.7071067811865476 F60\nX0 Y1 P1\nG5.3\n";
    let listing = read(weights).expect("followed");
    let off =
        ends(&listing)[1..].iter().map(|end| (libm::hypot(end[0], end[1]) - 1.0).abs()).fold(0.0, f64::max);
    assert!(off < 1e-6, "a quarter circle but {off} mm");
    assert_eq!(ends(&listing).last(), Some(&[0.0, 1.0, 0.0]), "to its end");
    let cubic = read("G21 G90 G0 X0 Y0 Z0\nG5 I0 J1 P0 Q1 X1 Y0 F60\n").expect("followed");
    let highest = ends(&cubic).iter().map(|end| end[1]).fold(0.0, f64::max);
    assert!((highest - 0.75).abs() < 1e-4, "three quarters of its tangents: {highest}");
}

#[test]
fn feeds_by_time_and_by_turn_become_feeds_by_minute() {
    let text = "G21 G90 G0 X0 Y0 Z0\nS1000 M3\nG93 G1 X3 Y4 F2\nG95 X0 F0.1\nG94 X1 F60\n";
    let feeds: Vec<Option<i64>> = read(text).expect("followed").motions[1..].iter().map(|m| m.feed).collect();
    assert_eq!(
        feeds,
        [Some(10_000_000), Some(100_000_000), Some(60_000_000)],
        "of 5 mm twice a minute, and so on"
    );
    assert!(read("G21 G90 G0 X0 Y0 Z0\nG93 G1 X1\n").is_err(), "each line needs its F");
}

#[test]
fn a_spindle_without_a_speed_turns() {
    let text = "G21 G90 M3\nG0 X0 Y0 Z1\nG1 Z-1 F9\nS500\nX1\nM5\nX2\n";
    let spindles: Vec<Spindle> = read(text).expect("followed").motions.iter().map(|m| m.spindle).collect();
    assert_eq!(
        spindles,
        [Spindle::Unstated, Spindle::Unstated, Spindle::At(500), Spindle::Off],
        "by a knob, by S, not at all"
    );
}

/// Cutters for M4 are left-handed, and hardly anybody has them.
#[test]
fn a_spindle_that_turns_backwards_turns_and_is_told() {
    let listing = read("G21 G90 M4 S900\nG0 X0 Y0 Z1\nG1 Z-1 F9\nM3\nX1\nM5\n").expect("followed");
    let spindles: Vec<Spindle> = listing.motions.iter().map(|motion| motion.spindle).collect();
    assert_eq!(spindles, [Spindle::At(900); 3], "either way");
    assert_notes(&listing, &[(true, "M4 turns the spindle backwards")]);
}

/// Marlin's dwell has its seconds in S; with P, as LinuxCNC reads it, S is a speed there, too.
#[test]
fn the_seconds_of_a_dwell_are_no_speed() {
    let text = "G21 G90 M3 S900\nG4 S0\nG0 X0 Y0 Z1\nG4 P1 S800\nG1 Z-1 F9\n";
    let listing = read(text).expect("followed");
    let spindles: Vec<Spindle> = listing.motions.iter().map(|m| m.spindle).collect();
    assert_eq!((spindles, listing.dwell), (vec![Spindle::At(900), Spindle::At(800)], 1000));
}

#[test]
fn what_does_not_move_anything_is_noted_and_followed() {
    let checksum = |line: &str| format!("{line}*{}", line.bytes().fold(0, |sum, byte| sum ^ byte));
    let good = checksum("N1 G1 X1 F9 A5");
    let text = format!(
        "\u{feff}G90\rG0 X0 Y0 Z1\r{good}\rN2 G1 X2*1\r$H\r/G1 X3\rM123 P1\r(open\rM117 G1 X9\rM0 X stop\r"
    );
    let listing = read(&text).expect("followed");
    let last = listing.motions.last().expect("motions");
    assert_eq!(
        (listing.motions.len(), last.line),
        (6, 6),
        "by CR alone, and no text is a motion: {listing:?}"
    );
    let notes = [
        (true, "neither G20 nor G21"),
        (true, "A is ignored"),
        (true, "the checksum of a line is wrong"),
        (false, "a command of the controller"),
        (false, "after `/`"),
        (true, "M123 is unknown"),
        (true, "a comment does not end"),
    ];
    assert_notes(&listing, &notes);
}

#[test]
fn a_probe_finds_the_surface_and_the_zero_it_sets() {
    // With a plate of 1.5 mm: what follows counts from the surface all the same.
    let text = "G21 G90 G38.2 Z-10 F50\nG92 Z1.5\nG0 Z5\nX1 Y1\nG1 Z-0.1 F50\n";
    let expected = [[NOWHERE, NOWHERE, 0.0], [NOWHERE, NOWHERE, 5.0], [1.0, 1.0, 5.0], [1.0, 1.0, -0.1]];
    let listing = assert_ends(text, &expected);
    assert_notes(&listing, &[(false, "assumed to touch")]);
    let heights = "G20 G90 G0 X0 Y0 Z.1\nG38.2 Z-.1 F2\n#500 = #5063\nG0 Z.1\nG1 Z[#500 - 0.01]\n";
    assert_ends(heights, &[[0.0, 0.0, 2.54], [0.0, 0.0, 0.0], [0.0, 0.0, 2.54], [0.0, 0.0, -0.254]]);
}

#[test]
fn polar_coordinates_turn_about_zero() {
    let text = "G21 G90 G0 X2 Y0 Z0\nG1 ^90 F9\n@1\nG91 ^90\n";
    assert_ends(text, &[[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
    // An arc of which only its polar end is told: round where it is, which is no arc.
    let error = read("G21 G90 G0 X2 Y0 Z-1\nG2 @3 F9\n").expect_err("no centre").to_string();
    assert!(error.contains("from its centre"), "{error}");
}

/// Other people's programs.
fn gathered() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders: Vec<PathBuf> = corpus::artwork().map(|root| root.join("gcode")).into_iter().collect();
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(&folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
            let is_program = path.extension().is_some_and(|extension| {
                ["nc", "ngc", "gcode", "txt"].contains(&extension.to_string_lossy().to_lowercase().as_str())
            });
            if path.is_dir() && !path.ends_with("gerbers") {
                folders.push(path);
            } else if is_program {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Why a program cannot be followed: the motion depends on what only the machine knows.
const REASONS: [&str; 4] = ["cutter compensation", "unknown position", "unknown depth", "unknown centre"];

#[test]
fn gathered_programs_are_read_or_say_what_only_the_machine_knows() {
    let programs = gathered();
    if programs.is_empty() {
        println!("no programs at VOROMILL_ARTWORK/gcode: nothing is read");
        return;
    }
    let mut refused = Vec::new();
    for path in &programs {
        let text = String::from_utf8_lossy(&std::fs::read(path).expect("readable")).into_owned();
        match read(&text) {
            Ok(listing) => assert!(!listing.motions.is_empty(), "{}: no motion", path.display()),
            Err(error) => refused.push((path, error.to_string())),
        }
    }
    for (path, reason) in &refused {
        println!("{}: {reason}", path.display());
        assert!(REASONS.iter().any(|known| reason.contains(known)), "{}: {reason}", path.display());
    }
    assert!(refused.len() * 15 <= programs.len(), "{} of {} are refused", refused.len(), programs.len());
}
