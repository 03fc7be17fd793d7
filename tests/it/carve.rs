//! Carving: what programs mill beside the ideal surface, and spoilt programs that are found out.

use voromill::board::polarity::{offset, union};
use voromill::geometry::{Nm, Point, Polygon, Rect};
use voromill::import::text::text;
use voromill::job::{Art, Carving, Engraving, Inlay, Options, Settings, carve};
use voromill::toolpath::{Angle, ToolKind};
use voromill::verify::Surface;
use voromill::verify::carving::{Text, milled};
use voromill::verify::{Cutter, CutterKind};

use crate::art::{is_cut, is_made_checked_and_found_spoilt, is_refused, lines, voromill, word};
use crate::medial_axis::{capitals, random_areas};
use crate::seeds::seeds;

/// How far apart places are looked at: a debug build looks at few.
const PITCH: Option<Nm> = Some(Nm::from_um(if cfg!(debug_assertions) { 80 } else { 25 }));

const HOW: Carving =
    Carving { max_depth: None, step: None, corner: Angle::ZERO, raised: None, flat: None, inlay: None };

fn settings(tool: &str) -> Settings {
    let tool = vec![tool.parse().expect("a tool")];
    Settings::resolve(Options { tool, ..Options::default() }).expect("settings")
}

fn engraving(name: &str, areas: Vec<Polygon>, tool: &str, how: &Carving) -> Engraving {
    let art = Art { name: name.to_owned(), areas, ..Art::default() };
    carve(art, &settings(tool), how).expect("a program")
}

fn letters(words: &str) -> Vec<Polygon> {
    text(dejavu::serif::bold(), words, Nm::from_mm(4)).expect("letters")
}

/// The surface of capitals is off by 2 µm at most at 99 of 100 places, and by 10 µm anywhere.
#[test]
fn capitals_are_carved_to_micrometres() {
    let every = if cfg!(debug_assertions) { 23 } else { 1 };
    let (mut p99, mut worst, mut places) = (0.0_f64, 0.0_f64, 0);
    for (name, areas) in capitals().step_by(every) {
        for tool in ["vbit:0mm:60deg", "vbit:0.1mm:60deg"] {
            let engraving = engraving(&name, areas.clone(), tool, &HOW);
            assert_eq!(engraving.warnings, [], "{name} with {tool}");
            let judged = engraving.verify(PITCH).expect("a program");
            assert_eq!(judged.findings, [], "{name} with {tool}");
            p99 = p99.max(judged.p99);
            worst = worst.max(judged.over).max(judged.under);
            places += judged.places;
        }
    }
    println!("capitals: {places} places, p99 {p99:.0} nm, worst {worst:.0} nm");
    assert!(p99 <= 2_000.0 && worst <= 10_000.0, "p99 {p99:.0} nm, worst {worst:.0} nm");
}

#[test]
fn random_areas_with_holes_are_carved_to_micrometres() {
    let usual = if cfg!(debug_assertions) { 3 } else { 200 };
    let (mut p99, mut worst) = (0.0_f64, 0.0_f64);
    for seed in seeds(0..usual) {
        let areas = random_areas(seed, if seed % 2 == 0 { 1 } else { 250_000 });
        let engraving = engraving("random", areas, "vbit:0mm:90deg", &HOW);
        let judged = engraving.verify(PITCH).expect("a program");
        assert_eq!(judged.findings, [], "seed {seed}");
        p99 = p99.max(judged.p99);
        worst = worst.max(judged.over).max(judged.under);
    }
    println!("random areas: p99 {p99:.0} nm, worst {worst:.0} nm");
    assert!(p99 <= 2_000.0 && worst <= 10_000.0, "p99 {p99:.0} nm, worst {worst:.0} nm");
}

#[test]
fn passes_end_at_the_same_surface_and_none_goes_deeper_than_it_may() {
    let how = Carving { step: Some(Nm::from_um(250)), ..HOW };
    let stepped = engraving("S", letters("S"), "vbit:0.1mm:60deg", &how);
    let whole = engraving("S", letters("S"), "vbit:0.1mm:60deg", &HOW);
    let apart = (stepped.deepest - whole.deepest).abs();
    assert!(apart < Nm::from_um(2), "in the end, within what both may be off: {apart:?}");
    let judged = stepped.verify(PITCH).expect("a program");
    assert_eq!(judged.findings, [], "what is right at once is right in passes");
    let how = Carving { max_depth: Some(Nm::from_um(300)), ..HOW };
    let shallow = engraving("I", letters("I"), "vbit:0.1mm:60deg", &how);
    assert_eq!(shallow.deepest, Nm::from_um(300), "as deep as it may");
    let judged = shallow.verify(PITCH).expect("a program");
    assert_eq!(judged.findings, [], "what is wide is left, and said so");
    assert!(judged.left_mm2 > 0.1, "{} mm² are left", judged.left_mm2);
    assert_eq!(
        shallow.warnings.iter().map(|warning| warning.code()).collect::<Vec<_>>(),
        ["wide-place-left"]
    );
}

#[test]
fn corners_that_were_left_out_are_asked_of_nobody() {
    let how = Carving { corner: Angle::from_degrees(100), ..HOW };
    let made = engraving("corners", letters("LEFT OUT"), "vbit:0.05mm:60deg", &how);
    let judged = made.verify(PITCH).expect("a program that can be followed");
    assert!(judged.findings.is_empty(), "{:?}", judged.findings);
    let mut strict = made.clone();
    strict.corner = Angle::ZERO;
    let judged = strict.verify(PITCH).expect("a program that can be followed");
    assert!(judged.findings.iter().all(|found| found.name == "carved-too-shallow"), "{:?}", judged.findings);
    assert!(judged.findings.len() > 10, "they are missed by who asks for them: {:?}", judged.findings);
    // What lies between corners is asked for all the same.
    let text = made.programs[0].text.clone();
    let (cut, rest) = text.split_at(text.find("Z-0.4").expect("deep somewhere"));
    let raised = cut.to_owned() + &rest.replacen("Z-0.4", "Z-0.1", 1);
    let judged = made.judge(&[("raised.ngc", &raised)], PITCH).expect("a program that can be followed");
    assert!(!judged.findings.is_empty(), "a place that is too shallow");
}

/// A letter is one axis: a program of it retracts no more often than the axis has parts and pairs
/// of odd nodes that are too far apart.
#[test]
fn an_axis_is_walked_with_few_retracts() {
    for (letter, most) in [("I", 3), ("O", 2), ("X", 4), ("E", 6)] {
        let made = engraving(
            letter,
            text(dejavu::sans::regular(), letter, Nm::from_mm(4)).expect("a letter"),
            "vbit:0.1mm:60deg",
            &HOW,
        );
        let retracts = made.programs[0].statistics.retracts;
        assert!(retracts <= most, "{letter}: {retracts} retracts");
    }
}

/// A curve is chords here, a quarter of a micrometre off it: less than any V-bit is to go into the
/// corner between two of them for, however steep it is.
#[test]
fn curves_have_no_spokes_however_steep_the_flanks_are() {
    let disc = |x: i64| {
        Polygon::disc(Point::new(Nm::from_um(x), Nm::ZERO), Nm::from_mm(2), Nm::new(250)).expect("a disc")
    };
    let between =
        Rect::new(Point::new(Nm::ZERO, Nm::from_mm(-2)), Point::new(Nm::from_mm(5), Nm::from_mm(2)));
    let slot = union(&[disc(0), disc(5_000), Polygon::rectangle(between)]);
    for tool in ["vbit:0.1mm:10deg", "vbit:0.1mm:20deg", "vbit:0.1mm:30deg", "vbit:0.1mm:45deg"] {
        for (areas, most) in [(vec![disc(0)], 1.0), (slot.clone(), 6.0)] {
            let made = engraving("round", areas, tool, &HOW);
            let made_of = &made.programs[0].statistics;
            assert!(made_of.cut_length.to_mm() < most, "{tool}: {}", made_of.cut_length);
            assert_eq!(made.verify(Some(Nm::from_um(20))).expect("a program").findings, [], "{tool}");
        }
    }
}

/// What is left out between chords is not what a corner is.
#[test]
fn steep_flanks_enter_blunt_corners() {
    for corners in [4_i32, 6, 12, 40] {
        let corner = |number: i32| {
            let angle = std::f64::consts::TAU * f64::from(number) / f64::from(corners);
            Point::from_f64(2e6 * libm::cos(angle), 2e6 * libm::sin(angle))
        };
        let area = Polygon::new(vec![(0..corners).map(corner).collect()]).expect("a regular polygon");
        let made = engraving("regular", vec![area], "vbit:0mm:20deg", &HOW);
        let judged = made.verify(Some(Nm::from_um(10))).expect("a program");
        assert_eq!(judged.findings, [], "{corners} corners");
        assert!(judged.under < 4_000.0, "{corners} corners: {} nm", judged.under);
    }
}

/// What is wider than the V-bit cuts is flat: an end mill clears it, the V-bit the rest.
#[test]
fn wide_places_become_flat() {
    let flat = Some("endmill:1mm".parse().expect("a tool"));
    let how = Carving { max_depth: Some(Nm::from_um(300)), flat, ..HOW };
    for (areas, tool) in [
        (text(dejavu::serif::bold(), "L", Nm::from_mm(9)).expect("a letter"), "vbit:0.1mm:60deg"),
        (text(dejavu::sans::bold(), "R", Nm::from_mm(12)).expect("a letter"), "vbit:0.2mm:90deg"),
    ] {
        let made = engraving("flat", areas, tool, &how);
        let judged = made.verify(PITCH).expect("programs");
        let retracts: Vec<u64> = made.programs.iter().map(|one| one.statistics.retracts).collect();
        println!(
            "{tool}: {:?} mm² left, {retracts:?} retracts, worst {:.0} nm",
            judged.left_mm2, judged.under
        );
        assert_eq!(judged.findings, [], "with {tool}");
        assert_eq!(made.programs.len(), 2, "a program for each tool");
    }
}

/// The smaller disc is but little more than the tool reaches, and touches the larger from within:
/// no way leads to its middle. Where its chords meet it is as wide as between.
#[test]
fn a_place_is_as_wide_where_chords_meet_as_between() {
    let disc = |x: i64, radius: i64| {
        let center = Point::new(Nm::new(x), Nm::ZERO);
        Polygon::disc(center, Nm::new(radius), Nm::new(200)).expect("a disc")
    };
    let areas = union(&[disc(0, 863_200), disc(150_000, 1_012_700)]);
    let how = Carving { max_depth: Some(Nm::from_um(860)), ..HOW };
    let engraving = engraving("discs", areas, "vbit:0mm:90deg", &how);
    let judged = engraving.verify(Some(Nm::from_um(10))).expect("a program");
    assert_eq!(judged.findings, []);
    assert!(judged.left_mm2 > 0.01, "{} mm² are wider than the tool reaches", judged.left_mm2);
}

/// Offsets of strokes leave such, and no axis is certain beside an island of some nanometres.
#[test]
fn slivers_are_no_islands() {
    let at = |x: i64, y: i64| Point::new(Nm::new(x), Nm::new(y));
    let plate = [at(0, 0), at(1_470_000, 0), at(1_470_000, 581_400), at(0, 581_400)];
    let slivers = [
        [at(260_916, 290_703), at(313_099, 290_707), at(313_099, 290_703)],
        [at(1_156_000, 290_699), at(1_210_452, 290_695), at(1_156_000, 290_695)],
    ];
    let rings = [plate.to_vec()].into_iter().chain(slivers.map(|sliver| sliver.to_vec()));
    let area = Polygon::new(rings.collect()).expect("a plate");
    let engraving = engraving("plate", vec![area], "vbit:0.1mm:120deg", &HOW);
    assert_eq!(engraving.verify(Some(Nm::from_um(10))).expect("a program").findings, []);
}

/// What lines are off sideways, walls are off by eleven times as much in depth.
#[test]
fn steep_walls_are_within_a_coarse_tolerance() {
    let options = Options {
        tool: vec!["vbit:0.2mm:10deg".parse().expect("a tool")],
        tolerance: Some("0.005mm".parse().expect("a length")),
        ..Options::default()
    };
    let settings = Settings::resolve(options).expect("settings");
    let art = Art { name: "B".to_owned(), areas: letters("B"), ..Art::default() };
    let judged = carve(art, &settings, &HOW).expect("a program").verify(PITCH).expect("a program");
    assert!(judged.over.max(judged.under) <= 6_000.0, "{:.0} and {:.0} nm", judged.over, judged.under);
}

/// What the end mill leaves in corners the V-bit clears, and stays down from line to line.
#[test]
fn wide_places_of_random_areas_become_flat() {
    let flat = Some("endmill:1.2mm".parse().expect("a tool"));
    let how = Carving { max_depth: Some(Nm::from_mm(1)), flat, ..HOW };
    let usual = if cfg!(debug_assertions) { 2 } else { 40 };
    for seed in seeds(0..usual) {
        let areas = random_areas(seed, 1);
        let made = engraving("flat", areas, "vbit:0.2mm:10deg", &how);
        let judged = made.verify(PITCH).expect("programs");
        assert_eq!(judged.findings, [], "seed {seed}");
        for one in &made.programs {
            println!("seed {seed}: {} retracts, {}", one.statistics.retracts, one.statistics.cut_length);
        }
    }
}

/// Of what is wider than the V-bit cuts, the walls are cut all the same: who looks for them finds
/// them, and misses them where one end of a contour is left out.
#[test]
fn walls_of_wide_places_are_cut_without_an_end_mill() {
    let how = Carving { max_depth: Some(Nm::from_mm(1)), ..HOW };
    let usual = if cfg!(debug_assertions) { 3 } else { 100 };
    for seed in seeds(0..usual) {
        for (scale, tool) in [(1, "vbit:0.2mm:10deg"), (250_000, "vbit:0mm:60deg")] {
            let made = engraving("walls", random_areas(seed, scale), tool, &how);
            let judged = made.verify(PITCH).expect("programs");
            assert_eq!(judged.findings, [], "seed {seed} with {tool}");
        }
    }
    let side = Nm::from_mm(10);
    let square = vec![Polygon::rectangle(Rect::new(Point::default(), Point::new(side, side)))];
    let made = engraving("square", square, "vbit:0.1mm:60deg", &how);
    let judged = made.verify(PITCH).expect("a program");
    assert_eq!(judged.findings, []);
    assert_eq!(made.programs[0].statistics.retracts, 1, "round it, and on the way into each corner");
    assert!((60.0..90.0).contains(&judged.left_mm2), "the middle of 100 mm² stays: {}", judged.left_mm2);
    let text = &made.programs[0].text;
    let corner = text.lines().rfind(|line| line.starts_with("G1 X")).expect("a cut");
    let spoilt = text.replacen(&format!("{corner}\n"), "", 1);
    let judged = made.judge(&[("spoilt.ngc", &spoilt)], PITCH).expect("a program");
    assert!(judged.findings.iter().any(|found| found.name == "carved-too-shallow"), "{:?}", judged.findings);
}

/// What the walls leave between them stays as it is: no way from one wall to the next leads
/// through.
#[test]
fn what_is_left_between_walls_is_not_cut_through() {
    let depth = Nm::from_um(300);
    let how = Carving { max_depth: Some(depth), ..HOW };
    for letter in ["8", "B", "O"] {
        let made = engraving(letter, letters(letter), "vbit:0.1mm:60deg", &how);
        let tool: ToolKind = "vbit:0.1mm:60deg".parse().expect("a tool");
        // Beside its tip, and where the flank is as good as at the floor.
        let cleared = tool.width_at(depth) / 2 + Nm::from_um(50) + Nm::from_um(6);
        let areas = letters(letter);
        let left = areas.iter().flat_map(|area| offset(area, -cleared, Nm::from_um(1)));
        let expected: f64 = left.map(|left| left.area_mm2()).sum();
        let judged = made.verify(Some(Nm::from_um(20))).expect("a program");
        let found = judged.left_mm2;
        assert!((found - expected).abs() < 0.03 * expected, "{letter}: {found} of {expected} mm² are left");
    }
}

#[test]
fn how_a_program_ends_is_looked_at() {
    let made = engraving("I", letters("I"), "vbit:0.1mm:60deg", &HOW);
    let told = |text: &str| -> Vec<&str> {
        let judged = made.judge(&[("ends.ngc", text)], PITCH).expect("a program");
        judged.findings.iter().map(|found| found.name).collect()
    };
    let text = &made.programs[0].text;
    assert_eq!(told(text), [""; 0]);
    // What is looked for in programs for boards.
    assert_eq!(told(&text.replace("G17 G21 G90 G94", "G17 G90 G94")), ["unclear"], "no unit");
    assert_eq!(told(&text.replace("M3 S", "M4 S")), ["unclear"], "backwards");
    let low = text.replacen("G0 Z2\n", "", 1).replacen("G0 X", "G0 Z0.01\nG0 X", 1);
    assert!(told(&low).contains(&"rapid-in-material"), "hardly above: {:?}", told(&low));
    assert_eq!(told(&text.replacen("G17", "M6 T1\nG17", 1)), ["word-not-taken"], "Grbl knows no M6");
    assert_eq!(told(&format!("{text}G0 Z-3\n")), ["code-after-end"]);
    assert_eq!(told(&text.replace("M5\nM2\n", "")), ["spindle-left-on"]);
    let down = text.replace("M5\nM2\n", "G1 Z-0.1 F60\nM5\nM2\n");
    assert!(told(&down).contains(&"tool-left-down"), "{:?}", told(&down));
}

#[test]
fn a_deep_pass_is_warned_of() {
    let side = Nm::from_mm(10);
    let square = || vec![Polygon::rectangle(Rect::new(Point::default(), Point::new(side, side)))];
    let codes = |how: &Carving| -> Vec<&str> {
        let made = engraving("square", square(), "vbit:0.1mm:60deg", how);
        made.warnings.iter().map(|warning| warning.code()).collect()
    };
    assert_eq!(codes(&HOW), ["carving-pass-too-deep"], "8.6 mm at once");
    assert_eq!(codes(&Carving { step: Some(Nm::from_mm(3)), ..HOW }), [""; 0], "in three passes");
}

/// Where the end mill has room to a nanometre there is no loop for it, and the V-bit clears.
#[test]
fn a_square_as_wide_as_the_end_mill_becomes_flat() {
    let flat = Some("endmill:1.2mm".parse().expect("a tool"));
    let how = Carving { max_depth: Some(Nm::from_mm(1)), flat, ..HOW };
    // From the edge the flank of the V-bit takes tan 5° of the depth, then the mill its radius.
    for more in [-10, 0, 1, 2, 3, 5, 20, 300, 2_000, 5_000] {
        let half = Nm::new(87_489 + 600_000 + more);
        let square = Rect::new(Point::new(-half, -half), Point::new(half, half));
        let made = engraving("flat", vec![Polygon::rectangle(square)], "vbit:0.2mm:10deg", &how);
        let judged = made.verify(PITCH).expect("programs");
        assert_eq!(judged.findings, [], "{more} nm wider");
    }
}

#[test]
fn what_stands_is_as_sharp_as_what_is_sunk() {
    let how = Carving { raised: Some(Nm::from_mm(1)), max_depth: None, ..HOW };
    let made = engraving("T", letters("T"), "vbit:0.1mm:60deg", &how);
    let judged = made.verify(PITCH).expect("a program");
    assert_eq!(judged.findings, [], "round the letter");
}

/// How deep the programs of one half mill at a place of the machine.
fn surface(made: &Engraving) -> Surface {
    let texts = made.programs.iter().map(|one| {
        let cutter = match one.program.sections[0].tool.kind {
            ToolKind::VBit { tip, angle } => Cutter { kind: CutterKind::VBit, tip, degrees: angle.degrees() },
            ToolKind::EndMill { diameter } | ToolKind::Drill { diameter } => {
                Cutter { kind: CutterKind::EndMill, tip: diameter, degrees: 0.0 }
            }
        };
        Text { file: "it", text: &one.text, cutter }
    });
    milled(&texts.collect::<Vec<_>>()).expect("programs")
}

/// The plug of an inlay, put in face down as deep as it is meant to go, touches the pocket on
/// its flanks and nowhere enters it but by what a blunt tip leaves of the pocket's grooves; its end
/// is a gap above the floor, and the ground round it a gap above the surface.
#[test]
fn a_plug_fits_its_pocket() {
    let flat = "endmill:1mm".parse().expect("a tool");
    let (depth, gap, margin) = (Nm::from_um(800), Nm::from_um(150), Nm::from_mm(3));
    let female = Carving { max_depth: Some(depth), flat: Some(flat), inlay: Some(Inlay::Female), ..HOW };
    let male = Carving { inlay: Some(Inlay::Male { gap }), raised: Some(margin), ..female.clone() };
    let font = dejavu::serif::bold();
    for (areas, tool, blunt_um) in [
        (text(font, "R", Nm::from_mm(12)).expect("a letter"), "vbit:0.05mm:60deg", 25.0),
        (text(font, "g\u{e9}", Nm::from_mm(9)).expect("letters"), "vbit:0.1mm:90deg", 50.0),
        (random_areas(7, 1), "vbit:0.1mm:90deg", 50.0),
    ] {
        let bounds = areas.iter().map(Polygon::bounds).reduce(Rect::union).expect("areas");
        let [pocket, plug] = [&female, &male].map(|how| {
            let made = engraving("inlay", areas.clone(), tool, how);
            let judged = made.verify(None).expect("programs");
            // Corners of a floor that the tip alone clears may keep a burr.
            assert!(judged.over <= 2_000.0, "{:?} with {tool}: {:?}", how.inlay, judged.findings);
            assert!(judged.under <= 20_000.0, "{:?} with {tool}: {:?}", how.inlay, judged.findings);
            assert!(judged.p99 <= 2_000.0, "{:?} with {tool}: {:.0} nm", how.inlay, judged.p99);
            surface(&made)
        });
        let flank = if tool.ends_with("90deg") { 1.0 } else { 0.577 };
        let tight = blunt_um * 1e3 / flank;
        let pitch = if cfg!(debug_assertions) { 100_000.0 } else { 20_000.0 };
        let (width, height, beside) = (bounds.width().to_f64(), bounds.height().to_f64(), 1e6);
        let (mut least, mut most, mut touching, mut places) = (f64::INFINITY, 0.0_f64, 0, 0);
        let mut y = -beside;
        while y < height + beside {
            let mut x = -beside;
            while x < width + beside {
                let other = (width - x + margin.to_f64(), y + margin.to_f64());
                // How far below the pocket's surface its floor and the plug are.
                let (floor, end) = (pocket.depth((x, y)), (depth - gap).to_f64() - plug.depth(other));
                let between = floor - end;
                (least, most) = (least.min(between), most.max(between));
                touching += i32::from(floor > 1e4 && between.abs() < 4_000.0);
                places += i32::from(floor > 1e4);
                x += pitch;
            }
            y += pitch;
        }
        println!("{tool}: {least:.0} to {most:.0} nm apart, {touching} of {places} places touch");
        assert!(least > -tight - 20_000.0, "{tool}: the plug goes {least:.0} nm into the pocket");
        assert!(most < gap.to_f64() + tight + 4_000.0, "{tool}: {most:.0} nm apart");
        assert!(20 * touching > places, "{tool}: {touching} of {places} places touch");
    }
}

/// What is done to a program.
type Change = fn(&str) -> String;

/// A plug that is too high, too low, beside its place or not mirrored would not go in.
#[test]
fn a_spoilt_plug_is_found() {
    let flat = Some("endmill:1mm".parse().expect("a tool"));
    let male = Some(Inlay::Male { gap: Nm::from_um(100) });
    let how =
        Carving { max_depth: Some(Nm::from_um(500)), flat, inlay: male, raised: Some(Nm::from_mm(2)), ..HOW };
    let made = engraving("L", letters("L"), "vbit:0.1mm:60deg", &how);
    let found = |change: Change| {
        let texts: Vec<String> = made.programs.iter().map(|one| change(&one.text)).collect();
        let texts: Vec<(&str, &str)> = texts.iter().map(|text| ("it", text.as_str())).collect();
        made.judge(&texts, PITCH).map_or(1, |judged| judged.findings.len())
    };
    assert_eq!(found(str::to_owned), 0, "as it is");
    let spoilt: [(&str, Change); 4] = [
        ("too high", |text| {
            lines(text, |line, _| Some(word(line, 'Z', |z| if z < 0.0 { z + 0.03 } else { z })))
        }),
        ("too low", |text| {
            lines(text, |line, _| Some(word(line, 'Z', |z| if z < 0.0 { z - 0.03 } else { z })))
        }),
        ("moved", |text| lines(text, |line, _| Some(word(line, 'X', |x| x + 0.02)))),
        ("not mirrored", |text| lines(text, |line, _| Some(word(line, 'X', |x| 6.0 - x)))),
    ];
    for (how, change) in spoilt {
        assert!(found(change) > 0, "{how}: nothing is found");
    }
}

#[test]
fn twenty_kinds_of_spoiling_are_found() {
    let made = engraving("Ri", letters("Ri"), "vbit:0.1mm:60deg", &HOW);
    let judge = |text: &str| made.judge(&[("it", text)], PITCH).expect("a program").findings;
    assert_eq!(judge(&made.programs[0].text), [], "nothing is wrong with it as it is");
    let text = made.programs[0].text.as_str();
    let each = |letter: char, change: fn(f64) -> f64| lines(text, |line, _| Some(word(line, letter, change)));
    let half = text.lines().filter(|line| is_cut(line)).count() / 2;
    let spoilt: [(&str, String); 22] = [
        ("moved to the right", each('X', |x| x + 0.03)),
        ("moved up", each('Y', |y| y - 0.03)),
        ("zero too low", each('Z', |z| if z < 0.0 { z - 0.03 } else { z })),
        ("zero too high", each('Z', |z| if z < 0.0 { z + 0.03 } else { z })),
        ("twice as deep", each('Z', |z| if z < 0.0 { 2.0 * z } else { z })),
        ("half as deep", each('Z', |z| if z < 0.0 { z / 2.0 } else { z })),
        ("a hundredth larger", each('X', |x| x * 1.02)),
        ("mirrored", each('X', |x| -x)),
        ("a depth for the whole", each('Z', |z| if z < 0.0 { -0.2 } else { z })),
        ("never below the surface", each('Z', |z| z.max(0.0))),
        (
            "some lines left out",
            lines(text, |line, n| {
                (!(half..half + 15).contains(&n) || !is_cut(line)).then(|| line.to_owned())
            }),
        ),
        (
            "the second half left out",
            lines(text, |line, n| (n <= half || !is_cut(line)).then(|| line.to_owned())),
        ),
        ("arcs the other way", text.replace("G2 ", "G9 ").replace("G3 ", "G2 ").replace("G9 ", "G3 ")),
        (
            "one place too deep",
            lines(text, |line, n| {
                Some(if n == half && is_cut(line) {
                    word(&with_z(line), 'Z', |z| z.min(0.0) - 0.2)
                } else {
                    line.to_owned()
                })
            }),
        ),
        (
            "a lift left out",
            lines(text, |line, n| (n < 1 || !line.starts_with("G0 Z2")).then(|| line.to_owned())),
        ),
        (
            "rapids instead of cuts",
            lines(text, |line, n| {
                Some(if n == half {
                    line.replacen("G1 X", "G0 X", 1).replacen("G2 ", "G0 ", 1).replacen("G3 ", "G0 ", 1)
                } else {
                    line.to_owned()
                })
            })
            .replace("I", "(I) I"),
        ),
        ("the spindle off", lines(text, |line, _| (!line.starts_with("M3")).then(|| line.to_owned()))),
        ("no feed", lines(text, |line, _| Some(line.split(" F").next().unwrap_or_default().to_owned()))),
        ("inches", text.replace("G21", "G20")),
        ("relative", text.replace("G90", "G91")),
        ("places to a tenth", each('X', |x| (x * 10.0).round() / 10.0)),
        ("depths to a tenth", each('Z', |z| (z * 10.0).round() / 10.0)),
    ];
    for (how, spoilt) in spoilt {
        assert_ne!(spoilt, text, "{how}: it is changed");
        // A text that cannot be followed is found, too.
        let found = made.judge(&[("it", spoilt.as_str())], PITCH).map_or(1, |judged| judged.findings.len());
        assert!(found > 0, "{how}: nothing is found");
    }
}

/// On a large drawing the places of the grid lie half a millimetre from each other, between which
/// all of this fits.
#[test]
fn what_is_small_is_found_on_a_large_drawing() {
    let rectangle = |x: i64, y: i64, width: i64, height: i64| {
        let corner = |x, y| Point::new(Nm::from_um(x), Nm::from_um(y));
        Polygon::rectangle(Rect::new(corner(x, y), corner(x + width, y + height)))
    };
    let areas = vec![rectangle(0, 0, 300_000, 200), rectangle(0, 299_800, 200, 200)];
    let made = engraving("far apart", areas, "vbit:0mm:60deg", &HOW);
    let found = |text: &str| {
        let judged = made.judge(&[("it", text)], None).expect("a program");
        judged.findings.iter().map(|finding| finding.name).collect::<Vec<_>>()
    };
    let text = made.programs[0].text.as_str();
    assert_eq!(found(text), [""; 0], "nothing is wrong with it as it is");
    let flat = lines(text, |line, _| {
        let is_far = line.split('Y').nth(1).is_some_and(|y| y.starts_with("299"));
        Some(if is_far { word(line, 'Z', |z| z.max(0.0)) } else { line.to_owned() })
    });
    assert!(found(&flat).contains(&"carved-too-shallow"), "a square that is left out: {:?}", found(&flat));
    let short = text.replacen("G1 X0 Y0 Z0 ", "G1 X0.1 Y0.1 Z-0.1732 ", 1);
    assert_ne!(short, text, "the branch into the first corner");
    assert!(found(&short).contains(&"carved-too-shallow"), "a corner that is missing: {:?}", found(&short));
    let before = text.rfind("M5").expect("the spindle stops");
    for beside in ["G1 Z-0.1\n", "G1 Z-0.02\nG1 X150.3\n"] {
        let groove = format!("{}G0 X150 Y150\n{beside}G0 Z2\n{}", &text[..before], &text[before..]);
        assert_eq!(found(&groove), ["carved-outside"], "a groove beside the areas: {beside}");
    }
}

/// The line with a height, if it has none.
fn with_z(line: &str) -> String {
    if line.contains('Z') { line.to_owned() } else { format!("{line} Z-0.1") }
}

/// A wrong tool is found by what it would mill.
#[test]
fn another_tool_than_the_one_planned_for_is_found() {
    let areas = letters("A");
    let planned = engraving("A", areas.clone(), "vbit:0.1mm:60deg", &HOW);
    for other in ["vbit:0.1mm:50deg", "vbit:0.1mm:70deg", "vbit:0.2mm:60deg"] {
        let fitted = engraving("A", areas.clone(), other, &HOW);
        let found =
            fitted.judge(&[("it", planned.programs[0].text.as_str())], PITCH).expect("a program").findings;
        assert!(!found.is_empty(), "{other} instead of the one planned for");
    }
}

#[test]
fn a_text_becomes_a_program_that_passes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    std::fs::write(path("font.ttf"), dejavu::sans::bold()).expect("a font");
    let font = path("font.ttf");
    let wanted = ["carve", "--text", "R1", "--font", &font, "--height", "2mm", "--tool", "vbit:0.1mm:60deg"];
    let (told, spoiling) = (["verified at"], ["Z-0.2", "Z-0.3"]);
    is_made_checked_and_found_spoilt(&wanted, folder.path(), &told, spoiling, "carved-too-deep");
}

#[test]
fn a_layer_is_carved_and_what_makes_no_sense_is_refused() {
    let layer = "fixtures/gerber/clear_polarity.gbr";
    let most = ["--max-depth", "0.2mm", "--no-verify"];
    let made = voromill(&[&["carve", layer, "-o", "-", "--tool", "vbit:0.1mm:90deg"], &most[..]].concat());
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    assert!(String::from_utf8_lossy(&made.stdout).contains("Z-0.2"), "as deep as asked for");
    is_refused(
        "carve",
        &[
            (&["--tool", "endmill:1mm"], "is not a V-bit"),
            (&["--max-depth", "0mm"], "above zero"),
            (&["--depth-pass", "0mm"], "above zero"),
            (&["--depth-pass", "0.009mm"], "less than 0.01mm: so thin a pass"),
            (&["--max-depth", "1mm", "--inlay", "female", "--gap", "0.1mm"], "has no effect"),
            (&["--max-depth", "0.1mm", "--inlay", "male", "--flat", "endmill:1mm"], "less than the depth"),
            (&["--max-depth", "0.1mm", "--inlay", "female"], "in the way of the other half: --flat"),
            (&["--depth", "1mm"], "has no effect"),
            (&["--offset", "0mm,-1060mm"], "from zero: expected at most 1050.0 mm"),
            (&["--tool", "vbit:9.8mm:60deg"], "narrower than the tip"),
        ],
    );
}

#[test]
fn open_lines_have_no_area() {
    let folder = tempfile::tempdir().expect("a folder");
    let drawing = folder.path().join("open.dxf").display().to_string();
    let line = "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n5\n21\n5\n";
    std::fs::write(&drawing, format!("0\nSECTION\n2\nENTITIES\n{line}0\nENDSEC\n0\nEOF\n"))
        .expect("a drawing");
    for (command, tool) in [("carve", "vbit:0.1mm:60deg"), ("pocket", "endmill:1mm")] {
        let refused = voromill(&[command, &drawing, "-o", "-", "--unit", "mm", "--tool", tool]);
        let said = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert!(said.contains("nothing in it has an area") && !said.contains("copper"), "{command}: {said}");
    }
}

#[test]
fn nothing_is_carved_deeper_than_tools_are_long() {
    let disc =
        |radius: i64| Polygon::disc(Point::default(), Nm::from_mm(radius), Nm::from_um(1)).expect("a disc");
    let art = |radius: i64| Art { name: "table".to_owned(), areas: vec![disc(radius)], ..Art::default() };
    let with = |radius: i64, how: &Carving| carve(art(radius), &settings("vbit:0.1mm:60deg"), how);
    let error = with(90, &HOW).expect_err("156 mm deep").to_string();
    assert!(error.contains("a place is 180 mm wide") && error.contains("100 mm"), "{error}");
    with(90, &Carving { max_depth: Some(Nm::from_mm(3)), ..HOW }).expect("three are deep enough");
    assert!(with(5, &HOW).expect("a program").deepest > Nm::from_um(8_500), "to the middle");
}

/// Capitals and digits are where a ruler would find them.
#[test]
fn letters_are_as_high_as_asked_for() {
    let areas = letters("H");
    let bounds = areas.iter().map(Polygon::bounds).next().expect("a letter");
    assert!((bounds.height() - Nm::from_mm(4)).abs() < Nm::from_um(30), "{:?}", bounds.height());
    assert_eq!(bounds.min().y, Point::default().y, "on the line");
    let two = text(dejavu::sans::bold(), "l\nl", Nm::from_mm(4)).expect("two lines");
    assert_eq!(two.len(), 2, "one below the other");
    assert!(text(dejavu::sans::bold(), "\u{e000}", Nm::from_mm(4)).is_err(), "no such glyph");
    assert!(text(b"no font", "a", Nm::from_mm(4)).is_err(), "no font");
    assert!(text(dejavu::sans::bold(), " ", Nm::from_mm(4)).is_err(), "nothing to see");
}
