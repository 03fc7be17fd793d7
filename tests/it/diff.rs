//! What two programs cut differently, and how deep.

use std::path::Path;

use voromill::geometry::{Nm, Point};
use voromill::verify::{Change, Comparison, Program, Settings, diff};

fn loops() -> Program {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/verify/loops.nc");
    let text = std::fs::read_to_string(file).expect("a program");
    let cutter = Some("endmill:0.2mm".parse().expect("a tool"));
    Program { file: "loops.nc".to_owned(), text, cutter, ..Program::default() }
}

/// Of an end mill.
fn program(kerf: f64, lines: &str) -> Program {
    let head = format!("(front isolation)\n(tool endmill:{kerf:.4}mm)\nG21 G90 G17 F100\nM3 S1000\nG0 Z2\n");
    Program { file: "x.ngc".to_owned(), text: format!("{head}{lines}M5\nM2\n"), ..Program::default() }
}

fn compared(before: &Program, after: &Program) -> Comparison {
    diff(before, after, Nm::from_um(5), &Settings::default()).expect("compared")
}

#[test]
fn programs_that_cut_the_same_do_not_differ() {
    let loops = loops();
    let text =
        loops.text.replace("X3.1500 Y0.8500", "X2 Y0.85\nG01 X3.1510 Y0.8500").replace("G90", "G90 G94");
    let other = Program { text, ..loops.clone() };
    let same = compared(&loops, &other);
    assert!(same.is_same(), "a micrometre and another line: {:?}", same.regions);
}

#[test]
fn what_is_not_cut_any_more_is_found_with_place_and_area() {
    let loops = loops();
    // The right side of the second loop goes, and is lifted over.
    let text = loops.text.replace("G01 X6.1500 Y3.1500", "G00 Z2.0000\nG00 X6.1500 Y3.1500\nG01 Z-0.1000");
    let other = Program { text, ..loops.clone() };
    let found = compared(&loops, &other);
    assert_eq!(found.total(Change::Cut).0, 0, "nothing more is cut");
    assert_eq!(found.regions.len(), 1, "{:?}", found.regions);
    // 2.3 mm by 0.2 mm without the round ends of the sides that meet it.
    let expected = 2.3 * 0.2 - std::f64::consts::PI * 0.01;
    let region = found.regions[0];
    assert!((region.area - expected).abs() < 0.01, "{} mm² for {expected}", region.area);
    assert!(region.middle().distance(Point::new(Nm::from_um(6150), Nm::from_mm(2))) < 50_000.0, "{region:?}");
    let back = compared(&other, &loops);
    assert_eq!(back.total(Change::Left).0, 0, "the other way round it is cut");
    let nothing = Program { text: String::new(), ..loops.clone() };
    let all = compared(&nothing, &loops);
    assert_eq!(all.total(Change::Cut).0, 2, "two loops where there was nothing");
}

#[test]
fn a_loop_that_moved_is_cut_in_one_place_and_left_in_another() {
    let loops = loops();
    // A side of a loop moved by half the kerf: the strip left and the strip cut lie on either side
    // of what both cut.
    let text = loops.text.replace("X3.1500", "X3.2500");
    let moved = diff(&loops, &Program { text, ..loops.clone() }, Nm::from_um(5), &Settings::default());
    let moved = moved.expect("compared");
    // By more than the kerf: the two strips touch nothing but what both cut at their ends.
    let text = loops.text.replace("X3.1500", "X3.3500");
    let beside = diff(&loops, &Program { text, ..loops.clone() }, Nm::from_um(5), &Settings::default());
    let beside = beside.expect("compared");
    for (found, wide) in [(moved, 0.1), (beside, 0.2)] {
        let [(cut, cut_area), (left, left_area)] = [found.total(Change::Cut), found.total(Change::Left)];
        assert_eq!((cut, left), (1, 1), "{:?}", found.regions);
        assert!((cut_area - 2.5 * wide).abs() < 0.1, "{cut_area} mm² more");
        assert!((left_area - 2.3 * wide).abs() < 0.1, "{left_area} mm² less");
    }
}

/// A corner of two cuts, 10 mm each, on both sides of which strips are cut that are narrower than a
/// pixel of 25 µm, and than are tolerated or not.
#[test]
fn strips_narrower_than_a_pixel_are_one_difference() {
    let program = |kerf: f64| program(kerf, "G0 X0.003 Y0.004\nG1 Z-0.1\nG1 X10.003\nG1 Y10.004\nG0 Z2\n");
    let wide = 0.005;
    for strip in [0.0002, 0.001, 0.006, 0.012] {
        let (narrow, broad) = (program(0.2), program(0.2 + 2.0 * (wide + strip)));
        let more = compared(&narrow, &broad);
        let less = compared(&broad, &narrow);
        // Along the outside, with two round ends and a corner, and along the inside.
        let off = 0.1 + wide + strip / 2.0;
        let expected = strip * (20.0 + 2.5 * std::f64::consts::PI * off + 20.0 - 2.0 * off);
        for (found, change) in [(more, Change::Cut), (less, Change::Left)] {
            assert_eq!(found.regions.len(), 1, "a strip of {strip} mm hangs together: {:?}", found.regions);
            let (places, area) = found.total(change);
            assert!(
                places == 1 && (area / expected - 1.0).abs() < 0.005,
                "{area} mm² for {expected}, {strip} mm wide"
            );
        }
        let same = program(0.2 + 2.0 * (wide - strip / 4.0));
        let same = compared(&narrow, &same);
        assert!(same.is_same(), "a quarter of {strip} mm less than is tolerated: {:?}", same.regions);
    }
}

/// Round a polygon of sixty short sides, 0.4 µm more than is tolerated: a strip without, and one
/// within.
#[test]
fn strips_along_many_bends_hang_together() {
    let corner = |number: u32| {
        let (sin, cos) = libm::sincos(f64::from(number % 60) * std::f64::consts::TAU / 60.0);
        format!("X{:.6} Y{:.6}", 5.0 * cos, 5.0 * sin)
    };
    let sides: String = (1..=60).map(|number| format!("G1 {}\n", corner(number))).collect();
    let round = |kerf: f64| program(kerf, &format!("G0 {}\nG1 Z-0.1\n{sides}G0 Z2\n", corner(0)));
    let (narrow, broad) = (round(0.2), round(0.2108));
    for (found, change) in
        [(compared(&narrow, &broad), Change::Cut), (compared(&broad, &narrow), Change::Left)]
    {
        let expected = 0.0004 * 2.0 * std::f64::consts::TAU * 5.0;
        let (places, area) = found.total(change);
        // Each may be parted where the middle of a pixel lies at a bend.
        assert!((2..=4).contains(&places), "{places} places, {area} mm² for {expected}");
        assert!((area / expected - 1.0).abs() < 0.05, "{area} mm² for {expected}");
    }
}

/// From where to where, and how deep.
type Stroke = [f64; 5];

/// Strokes by chance, every third the other way round in the second program and every fifth deeper,
/// some in one alone.
#[test]
fn differences_cover_what_exact_distances_say() {
    let coarse = Settings { pixel: Some(Nm::from_mm(1)), ..Settings::default() };
    let mut seed = 5_u64;
    let mut chance = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(seed >> 40).expect("24 bits")) / f64::from(1_u32 << 24)
    };
    let mut stroke = |number: u8| {
        let [x, y, to_x, to_y] = [(); 4].map(|()| 12.0 * chance());
        [x, y, to_x, to_y, 0.1 + f64::from(number % 3) * 0.05]
    };
    let strokes: Vec<Stroke> = (0..40).map(&mut stroke).collect();
    let mut again = strokes[8..].to_vec();
    again.iter_mut().step_by(5).for_each(|stroke| stroke[4] += 0.07);
    // The last of each crosses many tiles and everything else.
    let before: Vec<Stroke> = strokes[..32].iter().copied().chain([[0.0, 0.0, 12.0, 11.0, 0.2]]).collect();
    let after: Vec<Stroke> = again.iter().copied().chain([[0.0, 11.5, 12.0, 0.5, 0.1]]).collect();
    let text = |strokes: &[Stroke], turned: usize| {
        let line = |(number, &[x, y, to_x, to_y, depth]): (usize, &Stroke)| {
            let ends = [(x, y), (to_x, to_y)];
            let [from, to] = if number % 3 == turned { [ends[1], ends[0]] } else { ends };
            let [down, along] =
                [format!("X{:.6} Y{:.6}", from.0, from.1), format!("X{:.6} Y{:.6}", to.0, to.1)];
            format!("G0 {down}\nG1 Z-{depth:.3}\nG1 {along}\nG0 Z2\n")
        };
        program(0.2, &strokes.iter().enumerate().map(line).collect::<String>())
    };
    let (old, new) = (text(&before, 3), text(&after, 1));
    let found = compared(&old, &new);
    // How deep a place is cut, by strokes that are not farther away.
    let deep = |strokes: &[Stroke], x: f64, y: f64, within: f64| {
        let is_near = |&&[ax, ay, bx, by, _]: &&Stroke| {
            let (ux, uy, wx, wy) = (bx - ax, by - ay, x - ax, y - ay);
            let t = ((wx * ux + wy * uy) / (ux * ux + uy * uy)).clamp(0.0, 1.0);
            (wx - t * ux).powi(2) + (wy - t * uy).powi(2) <= within * within
        };
        strokes.iter().filter(is_near).map(|stroke| stroke[4]).reduce(f64::max)
    };
    let places = (0..480).flat_map(|i| (0..480).map(move |j| (f64::from(i) / 40.0, f64::from(j) / 40.0)));
    let mut expected = [0.0; 4];
    for (x, y) in places {
        let [old, near_old] = [0.1, 0.105].map(|within| deep(&before, x, y, within));
        let [new, near_new] = [0.1, 0.105].map(|within| deep(&after, x, y, within));
        let is_deeper =
            |deep: Option<f64>, other: Option<f64>| other.is_some_and(|other| deep > Some(other + 0.005));
        let changes = [
            new.is_some() && near_old.is_none(),
            old.is_some() && near_new.is_none(),
            is_deeper(new, near_old),
            is_deeper(old, near_new),
        ];
        for (area, changed) in expected.iter_mut().zip(changes) {
            *area += if changed { 6.25e-4 } else { 0.0 };
        }
    }
    let few = diff(&old, &new, Nm::from_um(5), &coarse).expect("compared");
    for (change, expected) in Change::ALL.into_iter().zip(expected) {
        let area = few.total(change).1;
        assert!((area / expected - 1.0).abs() < 0.02, "pixels of 1 mm: {change:?} {area} for {expected}");
        let area = found.total(change).1;
        // Ends of strokes lie half a kerf beyond the square that is sampled.
        let most = 0.15 + expected * 0.01;
        assert!(expected > 1.0 && (area - expected).abs() < most, "{change:?} {area} for {expected}");
    }
    let turned = diff(&old, &text(&before, 2), Nm::ZERO, &Settings::default()).expect("compared");
    assert!(turned.is_same(), "the way that a line is cut is no difference");
}

/// A way round a square of 10 mm, 1.7 mm deep in two passes, the last with tabs of 1 mm.
fn cutout(last: &str, tabs: &[f64]) -> Program {
    let lifted = |x: &f64| format!("G1 X{x:.3}\nG1 Z-0.7\nG1 X{:.3}\nG1 Z{last}\n", x + 2.0);
    let tabs: String = tabs.iter().map(lifted).collect();
    let rest = "G1 X10\nG1 Y10\nG1 X0\nG1 Y0\n";
    program(1.0, &format!("G0 X0 Y0\nG1 Z-0.85\n{rest}G1 Z{last}\n{tabs}{rest}G0 Z2\n"))
}

#[test]
fn how_deep_a_cut_goes_is_a_difference() {
    let held = cutout("-1.7", &[2.0, 6.0]);
    let loose = cutout("-1.7", &[2.0]);
    for (before, after, change, depths) in
        [(&held, &loose, Change::Deeper, [850, 1700]), (&loose, &held, Change::Shallower, [1700, 850])]
    {
        let found = compared(before, after);
        assert_eq!(found.regions.len(), 1, "{:?}", found.regions);
        let region = found.regions[0];
        assert_eq!((region.change, region.depths), (change, Some(depths.map(Nm::from_um))));
        assert!(region.middle().distance(Point::new(Nm::from_mm(7), Nm::ZERO)) < 20_000.0, "{region:?}");
        // The round ends of what is cut on either side reach half a millimetre into the tab.
        let expected = 2.0 - std::f64::consts::FRAC_PI_4 - 2.0 * 0.005;
        assert!((region.area - expected).abs() < 0.01, "{} mm² for {expected}", region.area);
    }
    let shallow = compared(&held, &cutout("-1.5", &[2.0, 6.0]));
    assert_eq!(
        shallow.total(Change::Shallower).0,
        2,
        "between the tabs and all round: {:?}",
        shallow.regions
    );
    assert_eq!(shallow.regions.len(), 2, "{:?}", shallow.regions);
    assert!(compared(&held, &cutout("-1.704", &[2.0, 6.0])).is_same(), "less than is tolerated");
}

/// What the tool goes down along, and in how many passes, is gone when it has cut as deep.
#[test]
fn ways_to_a_depth_are_no_difference() {
    let plunged = program(1.0, "G0 X0 Y0\nG1 Z-1.7\nG1 X10\nG0 Z2\n");
    let ramped = program(1.0, "G0 X0 Y0\nG1 Z0\nG1 X6 Z-0.9\nG1 X10\nG1 X4 Z-1.7\nG1 X10\nG1 X0\nG0 Z2\n");
    assert!(compared(&plunged, &ramped).is_same(), "ramps");
    // A slope that stays, cut in one motion or in three.
    let slope = program(1.0, "G0 X0 Y0\nG1 Z-0.1\nG1 X10 Z-1.3\nG0 Z2\n");
    let parts = program(1.0, "G0 X10 Y0\nG1 Z-1.3\nG1 X7 Z-0.94\nG1 X0.5 Z-0.16\nG1 X0 Z-0.1\nG0 Z2\n");
    assert!(compared(&slope, &parts).is_same(), "slopes: {:?}", compared(&slope, &parts).regions);
    let other = program(1.0, "G0 X0 Y0\nG1 Z-0.1\nG1 X10 Z-1.5\nG0 Z2\n");
    let steeper = compared(&slope, &other);
    assert!(steeper.total(Change::Deeper).1 > 5.0, "a slope that is steeper: {:?}", steeper.regions);
}

#[test]
fn what_was_not_followed_is_not_the_same() {
    let cut = "G0 X0 Y0\nG1 Z-0.1\nG1 X5\nG0 Z2\n";
    let known = program(0.2, cut);
    let of = |text: String| Program { text, ..known.clone() };
    for (other, what) in [
        (program(0.2, &format!("G1 Z-1\nG0 Z2\n{cut}")), "line 6: it cuts at a place"),
        (of(format!("{}G0 X50\n", known.text)), "line 12: it goes on behind its end"),
        (of(known.text.replace(" Z2", "").replace("G1 Z-0.1\n", "")), "it cuts at a height"),
    ] {
        for (before, after) in [(&known, &other), (&other, &known)] {
            let error = diff(before, after, Nm::from_um(5), &Settings::default()).expect_err(what);
            assert!(error.to_string().contains(what), "{error}, without {what}");
        }
    }
}
