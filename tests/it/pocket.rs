//! Pockets: what programs leave and cut beside areas, how often the tool comes down, and spoilt
//! programs that are found out.

use voromill::board::polarity::{difference, offset, union};
use voromill::geometry::{Nm, Point, Polygon, Rect};
use voromill::import::text::text;
use voromill::job::{Art, Options, Pocket, Pocketing, Settings, pocket};
use voromill::toolpath::Angle;
use voromill::toolpath::strategy::{Engaging, Sequence};

use crate::art::{is_cut, is_made_checked_and_found_spoilt, is_refused, lines, voromill, word};
use crate::cli::{stderr, stdout};
use crate::medial_axis::{capitals, random_areas};
use crate::seeds::seeds;

/// How far apart rows are looked at.
const PITCH: Option<Nm> = Some(Nm::from_um(if cfg!(debug_assertions) { 20 } else { 8 }));

fn how() -> Pocketing {
    Pocketing {
        // All at once, whatever the tool bears.
        step: Some(Nm::from_mm(1)),
        stepover: "40%".parse().expect("a part"),
        stock: Nm::ZERO,
        sequence: Sequence::InsideOut,
        ramp: Angle::from_degrees(3),
        raised: None,
        engaging: None,
    }
}

fn settings(tool: &str, depth: &str) -> Settings {
    let tool = tool.split(',').map(|tool| tool.parse().expect("a tool")).collect();
    let depth = Some(depth.parse().expect("a length"));
    Settings::resolve(Options { tool, depth, ..Options::default() }).expect("settings")
}

/// With one tool, or several with commas between them.
fn pocketed(name: &str, areas: Vec<Polygon>, tool: &str, how: &Pocketing) -> Pocket {
    let art = Art { name: name.to_owned(), areas, ..Art::default() };
    pocket(art, &settings(tool, "1mm"), how).expect("a program")
}

fn rectangle([left, bottom, right, top]: [i64; 4]) -> Polygon {
    let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
    Polygon::rectangle(Rect::new(at(left, bottom), at(right, top)))
}

fn disc(radius: i64) -> Polygon {
    Polygon::disc(Point::default(), Nm::from_um(radius), Nm::new(250)).expect("a disc")
}

/// Two squares with a passage between them, and an island in one.
fn dumbbell() -> Vec<Polygon> {
    let whole = union(&[
        rectangle([0, 0, 8000, 8000]),
        rectangle([12_000, 0, 20_000, 8000]),
        rectangle([7900, 3000, 12_100, 5000]),
    ]);
    whole.iter().flat_map(|area| difference(area, &[rectangle([3000, 3500, 4200, 4700])])).collect()
}

/// Nothing is found, and the tool comes down as often as it need.
fn check(name: &str, made: &Pocket) {
    let judged = made.verify(PITCH).expect("a program");
    assert_eq!(judged.findings, [], "{name}");
    assert_eq!(made.entries.unlinked, 0, "{name}: all loops are linked");
    assert_eq!(Some(judged.plunges), judged.maxima, "{name}: plunges");
    assert_eq!(judged.plunges, made.entries.all, "{name}: plunges are told");
    assert!(judged.overcut <= 2_000.0, "{name}: {} nm beyond an edge", judged.overcut);
}

#[test]
fn letters_are_milled_without_residue() {
    let every = if cfg!(debug_assertions) { 29 } else { 1 };
    for (number, (name, areas)) in capitals().step_by(every).enumerate() {
        let stepover = ["40%", "25%", "50%"][number % 3].parse().expect("a part");
        check(&name, &pocketed(&name, areas, "endmill:0.3mm", &Pocketing { stepover, ..how() }));
    }
}

#[test]
fn random_areas_are_milled_without_residue() {
    let usual = if cfg!(debug_assertions) { 6 } else { 200 };
    for seed in seeds(0..usual) {
        let areas = random_areas(seed, if seed % 2 == 0 { 1 } else { 250_000 });
        let sequence = if seed % 3 == 2 { Sequence::OutsideIn } else { Sequence::InsideOut };
        let stock = if seed % 2 == 0 { Nm::ZERO } else { Nm::from_um(50) };
        let how = Pocketing { sequence, stock, ..how() };
        check(&format!("seed {seed}"), &pocketed("random", areas, "endmill:0.5mm", &how));
    }
}

/// How many places of areas are farther from the edge than all round them, by offsets 0.1 mm apart.
fn summits(areas: &[Polygon], wall: i64) -> usize {
    let mut levels: Vec<Vec<Polygon>> = Vec::new();
    loop {
        let by = Nm::from_um(wall) + Nm::from_um(100) * i64::try_from(levels.len()).expect("few");
        let pieces: Vec<Polygon> = areas.iter().flat_map(|area| offset(area, -by, Nm::new(250))).collect();
        if pieces.is_empty() {
            break;
        }
        levels.push(pieces);
    }
    let none = Vec::new();
    let above = levels.iter().skip(1).chain([&none]);
    let is_top = |piece: &Polygon, above: &[Polygon]| {
        above.iter().all(|higher| !piece.contains(higher.contours()[0][0]))
    };
    levels
        .iter()
        .zip(above)
        .map(|(level, above)| level.iter().filter(|piece| is_top(piece, above)).count())
        .sum()
}

#[test]
fn the_tool_comes_down_once_for_each_place_that_is_farthest_from_the_edge() {
    let ring = difference(&disc(5000), &[disc(2000)]);
    let shapes: [(&str, Vec<Polygon>, usize); 5] = [
        ("a square", vec![rectangle([0, 0, 8000, 8000])], 1),
        ("a long one", vec![rectangle([0, 0, 18_000, 4000])], 1),
        ("a disc", vec![disc(4000)], 1),
        ("a ring", ring, 1),
        (
            "two discs and a passage",
            union(&[disc(4000), rectangle([0, -700, 12_000, 700]), rectangle([9000, -3000, 15_000, 3000])]),
            2,
        ),
    ];
    for (name, areas, expected) in shapes {
        assert_eq!(summits(&areas, 537), expected, "{name}: what brute force counts");
        let made = pocketed(name, areas, "endmill:1mm", &how());
        check(name, &made);
        assert_eq!(made.entries.all, expected, "{name}");
    }
    // Two places may lie so near that one loop runs round both.
    let made = pocketed("a dumbbell", dumbbell(), "endmill:1mm", &how());
    check("a dumbbell", &made);
    assert!((2..=summits(&dumbbell(), 537)).contains(&made.entries.all), "{} plunges", made.entries.all);
}

#[test]
fn what_is_just_as_wide_as_the_tool_is_milled() {
    let slot = pocketed("slot", vec![rectangle([0, 0, 9000, 1000])], "endmill:1mm", &how());
    check("slot", &slot);
    assert_eq!((slot.entries.all, slot.entries.straight), (1, 0), "down along it");
    let hole = pocketed("hole", vec![disc(500)], "endmill:1mm", &how());
    check("hole", &hole);
    assert_eq!(hole.entries.straight, 1, "no room but to go straight down");
    assert_eq!(hole.warnings.iter().map(|found| found.code()).collect::<Vec<_>>(), ["plunge-straight-down"]);
    let outside_in = Pocketing { sequence: Sequence::OutsideIn, ..how() };
    let bore = pocketed("bore", vec![disc(65)], "endmill:0.1mm", &outside_in);
    check("bore", &bore);
    assert_eq!(bore.entries.straight, 0, "many turns round where a helix would fit");
}

/// Where the middle of the tool fits on a line or a point alone it is asked for still.
#[test]
fn what_is_just_as_wide_as_the_tool_and_left_out_is_found() {
    let square = rectangle([0, 0, 8000, 8000]);
    let alone = pocketed("square", vec![square.clone()], "endmill:1mm", &how());
    let program = [("one.ngc", alone.programs[0].text.as_str())];
    let center = Point::new(Nm::from_mm(12), Nm::from_mm(4));
    let hole = Polygon::disc(center, Nm::from_um(500), Nm::new(250)).expect("a disc");
    let quarter = std::f64::consts::FRAC_PI_4;
    for (what, other, clear) in
        [("slot", rectangle([10_000, 2000, 19_000, 3000]), 8.0 + quarter), ("hole", hole, quarter)]
    {
        let both = pocketed(what, vec![square.clone(), other], "endmill:1mm", &how());
        let judged = both.verify(PITCH).expect("a program");
        assert_eq!(judged.findings, [], "{what}");
        let reachable = 63.0 + quarter + clear;
        assert!((judged.reachable_mm2 - reachable).abs() < 0.01, "{what}: {} mm²", judged.reachable_mm2);
        let judged = both.judge(&program, PITCH).expect("a program");
        let found: Vec<&str> = judged.findings.iter().map(|finding| finding.name).collect();
        assert_eq!(found, ["pocket-residue"], "{what}");
        assert!((judged.residue_mm2 - clear).abs() < 0.1, "{what}: {} mm² are left", judged.residue_mm2);
    }
}

/// What is found lies where the drawing has it, and on the machine where its zero is.
#[test]
fn places_are_those_of_the_drawing() {
    let made = pocketed("far", vec![rectangle([100_000, 50_000, 106_000, 56_000])], "endmill:1mm", &how());
    let text: String = made.programs[0].text.replace("G1 X5.5", "G1 X4.5");
    let judged = made.judge(&[("it", text.as_str())], PITCH).expect("a program");
    let found = judged.findings.iter().find(|found| found.name == "pocket-residue").expect("what is left");
    let [at, on_machine] = [found.at, found.on_machine].map(|place| place.expect("a place"));
    let zero = Point::new(Nm::from_mm(100), Nm::from_mm(50));
    assert_eq!(at - zero, on_machine - Point::default(), "the lower left corner is zero");
    assert!((0..6_000_000).contains(&on_machine.x.get()), "{on_machine:?}");
}

/// What a coarser tool has milled in its full width is not left for a finer one.
#[test]
fn a_slot_just_as_wide_as_the_coarser_tool_is_milled_once() {
    let slot = vec![rectangle([0, 0, 9000, 1000])];
    let how = Pocketing { ramp: Angle::from_degrees(45), ..how() };
    let both = pocketed("slot", slot.clone(), "endmill:1mm,endmill:0.3mm", &how);
    assert_eq!(both.verify(PITCH).expect("programs").findings, []);
    assert_eq!(both.programs.len(), 2, "corners are left for the finer");
    let alone = pocketed("slot", slot, "endmill:0.3mm", &how);
    let [after, before] =
        [&both, &alone].map(|made| made.programs.last().expect("a program").statistics.cut_length.to_mm());
    assert!(after < 0.5 * before, "{after:.1} mm in four corners, {before:.1} mm in all");
}

#[test]
fn passes_and_both_orders_end_at_the_same_floor() {
    for (sequence, stock) in [
        (Sequence::InsideOut, Nm::ZERO),
        (Sequence::InsideOut, Nm::from_um(100)),
        (Sequence::OutsideIn, Nm::ZERO),
        (Sequence::OutsideIn, Nm::from_um(100)),
    ] {
        let once = Pocketing { sequence, stock, ..how() };
        let [once, thrice] = [once.clone(), Pocketing { step: Some(Nm::from_um(400)), ..once }]
            .map(|how| pocketed("dumbbell", dumbbell(), "endmill:1mm", &how));
        check(&format!("{sequence:?} with {stock:?}"), &thrice);
        assert_eq!(thrice.entries.all, 3 * once.entries.all, "{sequence:?} with {stock:?}");
        assert!(sequence == Sequence::InsideOut || once.entries.all == 1, "once for each area");
    }
}

#[test]
fn a_finer_tool_clears_what_a_coarser_one_left() {
    let asked = seeds(0..if cfg!(debug_assertions) { 2 } else { 50 });
    let random = asked.clone().map(|seed| random_areas(seed, 1));
    for (number, areas) in (asked.start..).zip(random.chain([dumbbell()])) {
        let how = Pocketing { step: Some(Nm::from_um(600)), ..how() };
        let both = pocketed("both", areas.clone(), "endmill:2.2mm,endmill:0.6mm", &how);
        let judged = both.verify(PITCH).expect("programs");
        assert_eq!(judged.findings, [], "with both");
        assert_eq!((judged.plunges, both.entries.unlinked), (both.entries.all, 0), "plunges");
        let alone = pocketed("alone", areas, "endmill:0.6mm", &how);
        let same = alone.verify(PITCH).expect("a program").reachable_mm2 - judged.reachable_mm2;
        assert!(same.abs() < 1e-6, "in the end it is the same: {same} mm²");
        let [coarse, rest] = both.programs.as_slice() else { continue };
        let texts = [("coarse", coarse.text.as_str()), ("rest", coarse.text.as_str())];
        assert_eq!((coarse.tag.as_str(), rest.tag.as_str()), ("1", "2"), "files by their order");
        let found = both.judge(&texts, PITCH).expect("programs").findings;
        assert!(!found.is_empty(), "without the finer one's program much is left");
        if number == asked.end {
            // Of two squares only corners and the passage are left.
            let [after, before] = [&both, &alone]
                .map(|made| made.programs.last().expect("a program").statistics.cut_length.to_mm());
            println!("{after:.1} mm after the coarser one, {before:.1} mm without");
            assert!(after < 0.7 * before, "{after:.1} mm after the coarser one, {before:.1} mm without");
        }
    }
}

#[test]
fn what_stands_is_left() {
    let letter = text(dejavu::sans::bold(), "A", Nm::from_mm(6)).expect("a letter");
    let made = pocketed("A", letter, "endmill:0.5mm", &Pocketing { raised: Some(Nm::from_mm(2)), ..how() });
    check("round a letter", &made);
}

/// In arcs of an engagement, both ways or one.
fn engaging(target: &str, both_ways: bool) -> Pocketing {
    let target = target.parse().expect("an engagement");
    Pocketing { engaging: Some(Engaging { target, both_ways }), ..how() }
}

/// Nothing is found; how much the tool bears and what part of the way at depth is air.
fn check_engaged(name: &str, made: &Pocket, target: f64) {
    let judged = made.verify(PITCH).expect("a program");
    assert_eq!(judged.findings, [], "{name}");
    assert_eq!(made.entries.unlinked, 0, "{name}: all is linked");
    let borne = judged.borne.expect("what it bears");
    assert!(borne.most <= target + 0.02, "{name}: {borne:?}");
    assert!(borne.air <= 0.15, "{name}: {borne:?}");
}

fn star() -> Vec<Polygon> {
    let corner = |i: u32| {
        let (up, right) = libm::sincos(std::f64::consts::PI * f64::from(i) / 5.0);
        let radius = if i.is_multiple_of(2) { 7e6 } else { 2.5e6 };
        Point::from_f64(radius * right, radius * up)
    };
    vec![Polygon::new(vec![(0..10).map(corner).collect()]).expect("a star")]
}

#[test]
fn arcs_along_the_axis_bear_no_more_than_they_may() {
    let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
    let taper = vec![at(0, 0), at(20_000, 2450), at(20_000, 2550), at(0, 5000)];
    let islands = [disc(1500).translated(at(-2500, 0) - at(0, 0)), rectangle([2000, -1000, 4000, 1500])];
    let shapes: [(&str, Vec<Polygon>); 8] = [
        ("a square", vec![rectangle([0, 0, 9000, 9000])]),
        ("an L", union(&[rectangle([0, 0, 12_000, 3000]), rectangle([0, 0, 3500, 8000])])),
        ("a taper", vec![Polygon::new(vec![taper]).expect("a taper")]),
        ("a star", star()),
        ("a ring with two islands", difference(&disc(7000), &islands)),
        ("a disc", vec![disc(4000)]),
        ("a slot", vec![rectangle([0, 0, 9000, 1000])]),
        ("a dumbbell with a passage as wide as the tool", {
            let [left, right] = [rectangle([0, 0, 5000, 5000]), rectangle([8000, 0, 13_000, 5000])];
            union(&[left, right, rectangle([4900, 2000, 8100, 3030])])
        }),
    ];
    for (number, (name, areas)) in shapes.into_iter().enumerate() {
        let (target, part) = [("15%", 0.15), ("8%", 0.08), ("30%", 0.3)][number % 3];
        let stock = if number % 2 == 0 { Nm::ZERO } else { Nm::from_um(30) };
        let how = Pocketing { stock, ..engaging(target, number % 4 == 3) };
        let made = pocketed(name, areas, "endmill:1mm", &how);
        check_engaged(name, &made, part);
        let is_narrow = name.contains("slot") || name.contains("passage");
        let is_told = made.warnings.iter().any(|found| found.code() == "milled-in-full-width");
        assert_eq!(is_told, is_narrow, "{name}: what is milled in full width is told");
        assert!(name.contains("slot") || made.entries.all == 1, "{name}: one plunge");
    }
}

/// What a helix cleared above its last turn stands no more, though it was never level.
/// One area is cleared in arcs at once, the other, just as wide as the tool, in layers.
#[test]
fn layers_are_plunges_where_they_are_milled_alone() {
    let areas = vec![rectangle([0, 0, 9000, 2500]), rectangle([10_000, 0, 19_000, 1000])];
    let made = pocketed("slots", areas, "endmill:1mm", &engaging("15%", false));
    let judged = made.verify(PITCH).expect("a program");
    assert_eq!(judged.findings, []);
    assert_eq!((judged.plunges, judged.maxima), (made.entries.all, Some(made.entries.all)), "as needed");
    assert!(made.entries.all > 2, "more than one in each: {}", made.entries.all);
}

#[test]
fn a_helix_meets_its_own_turns_and_not_the_wall() {
    let areas = vec![rectangle([0, 0, 14_000, 8000])];
    let art = Art { name: "deep".to_owned(), areas, ..Art::default() };
    let made = pocket(art, &settings("endmill:3mm", "3mm"), &engaging("5%", false)).expect("a program");
    check_engaged("deep", &made, 0.05);
}

/// The stock tapers off in a corner, however few places the axis of a long one has: the loop along
/// the wall meets as much there as along a straight edge.
#[test]
fn nothing_is_left_across_a_corner_for_the_loop_along_the_wall() {
    let corner = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
    for opposite in [3_000, 6_500, 10_000] {
        let triangle = [corner(0, 0), corner(13_000, 2_000), corner(12_000, 2_000 + opposite)];
        let triangle = vec![Polygon::new(vec![triangle.to_vec()]).expect("a triangle")];
        for stock in [50, 130] {
            let how = Pocketing { stock: Nm::from_um(stock), ..engaging("15%", false) };
            let made = pocketed("corner", triangle.clone(), "endmill:1mm", &how);
            check_engaged(&format!("{opposite} with {stock} µm"), &made, 0.15);
        }
    }
}

#[test]
fn random_areas_are_cleared_in_arcs_without_residue() {
    let usual = if cfg!(debug_assertions) { 2 } else { 12 };
    // Among sharp islands, to which ways from arc to arc came too near.
    let sharp = (!cfg!(debug_assertions)).then_some(1006);
    for seed in seeds(0..usual).chain(sharp) {
        let areas = random_areas(seed, if seed % 2 == 0 { 1 } else { 250_000 });
        let stock = Nm::from_um(if seed % 3 == 1 { 40 } else { 0 });
        let how = Pocketing { stock, ..engaging("15%", seed % 2 == 1) };
        let made = pocketed("random", areas, "endmill:0.5mm", &how);
        check_engaged(&format!("seed {seed}"), &made, 0.15);
    }
}

#[test]
fn letters_are_cleared_in_arcs() {
    let every = if cfg!(debug_assertions) { 60 } else { 17 };
    for (name, areas) in capitals().step_by(every) {
        check_engaged(&name, &pocketed(&name, areas, "endmill:0.3mm", &engaging("15%", false)), 0.15);
    }
}

#[test]
fn arcs_are_milled_in_passes_and_finer_tools_follow_in_loops() {
    let how = Pocketing { step: Some(Nm::from_um(400)), ..engaging("15%", false) };
    let thrice = pocketed("dumbbell", dumbbell(), "endmill:1mm", &how);
    check_engaged("three passes", &thrice, 0.15);
    assert_eq!(thrice.entries.all, 3, "one plunge in each");
    let both = pocketed("both", dumbbell(), "endmill:2.2mm,endmill:0.6mm", &how);
    assert_eq!(both.verify(PITCH).expect("programs").findings, [], "with both");
}

#[test]
fn more_load_than_asked_for_is_found() {
    let made =
        pocketed("square", vec![rectangle([0, 0, 9000, 9000])], "endmill:1mm", &engaging("15%", false));
    let judge = |text: &str| {
        let judged = made.judge(&[("it", text)], PITCH).expect("a program");
        judged.findings.iter().map(|found| found.name).collect::<Vec<_>>()
    };
    let text = made.programs[0].text.as_str();
    assert_eq!(judge(text), [""; 0], "nothing is wrong with it as it is");
    let cuts = text.lines().filter(|line| is_cut(line)).count();
    // Above the work some of the cuts are left out.
    let without = |from: usize, to: usize| {
        lines(text, |line, n| match (is_cut(line), n) {
            (true, n) if n == from => Some(format!("G1 Z1\n{}", word(line, 'Z', |_| 1.0))),
            (true, n) if n == to => Some(format!("G1 Z-1\n{line}")),
            (is_cut, n) if (from..to).contains(&n) => is_cut.then(|| word(line, 'Z', |_| 1.0)),
            _ => Some(line.to_owned()),
        })
    };
    let spoilt = [
        (
            "arcs the other way round",
            lines(text, |line, n| {
                let is_it = (cuts / 2..cuts / 2 + 40).contains(&n) && is_cut(line);
                Some(if is_it { line.replace("G3 ", "G2 ") } else { line.to_owned() })
            }),
        ),
        ("a loop of the spiral left out", without(cuts / 8, cuts / 8 + 4)),
        ("circles left out", without(cuts / 2, cuts / 2 + 24)),
        ("a branch left out but for its end", without(cuts / 4, cuts / 2)),
        (
            "all farther apart",
            lines(text, |line, _| {
                Some(
                    "XYIJ"
                        .chars()
                        .fold(line.to_owned(), |line, letter| word(&line, letter, |value| value * 1.6)),
                )
            }),
        ),
    ];
    for (how, spoilt) in spoilt {
        assert_ne!(spoilt, text, "{how}: it is changed");
        assert!(judge(&spoilt).contains(&"pocket-engagement"), "{how}: {:?}", judge(&spoilt));
    }
    let loops = pocketed("square", vec![rectangle([0, 0, 9000, 9000])], "endmill:1mm", &how());
    assert!(judge(&loops.programs[0].text).contains(&"pocket-engagement"), "loops bear more");
}

/// Which way a tool goes round: the area that its cuts at full depth enclose, counter-clockwise
/// positive.
fn turning(direction: &str, sequence: Sequence) -> f64 {
    let direction = Some(serde_json::from_value(direction.into()).expect("a direction"));
    let tool = vec!["endmill:1mm".parse().expect("a tool")];
    let settings = Settings::resolve(Options { tool, direction, ..Options::default() }).expect("settings");
    let art = Art { name: "square".to_owned(), areas: vec![rectangle([0, 0, 6000, 6000])], ..Art::default() };
    let made = pocket(art, &settings, &Pocketing { sequence, ..how() }).expect("a program");
    let moves = made.programs[0].program.sections[0].moves.iter();
    let places: Vec<(f64, f64)> = moves.filter_map(|step| step.to()).map(|to| to.point().to_f64()).collect();
    // The last loop ends the program.
    let last = &places[places.len() - 6..];
    last.windows(2).map(|pair| pair[0].0 * pair[1].1 - pair[1].0 * pair[0].1).sum()
}

#[test]
fn climb_has_the_wall_on_the_right() {
    assert!(turning("climb", Sequence::InsideOut) > 0.0, "counter-clockwise along the edge");
    assert!(turning("conventional", Sequence::InsideOut) < 0.0, "clockwise");
}

/// Other programs come down to the floor in one helix.
#[test]
fn turns_of_a_helix_are_passes() {
    let how = Pocketing { step: Some(Nm::from_um(500)), ..how() };
    let made = pocketed("hole", vec![disc(2200)], "endmill:3mm", &how);
    let judge = |turns: f64| {
        let halves = (1..).map(|half| f64::from(half) / (2.0 * turns)).take_while(|&part| part <= 1.0);
        let arc = |(to, depth): (f64, f64)| format!("G3 X{:.1} Y2.2 Z{} I{to} J0\n", 2.2 + to, -depth);
        let helix: String = [-0.7, 0.7].into_iter().cycle().zip(halves.chain([1.0; 2])).map(arc).collect();
        let text = format!("G21 G90 G17\nM3 S9000\nG0 X2.9 Y2.2 Z5\nG1 Z0 F90\n{helix}G0 Z5\nM2\n");
        let judged = made.judge(&[("it", &text)], PITCH).expect("a program");
        judged.findings.iter().map(|found| found.name).collect::<Vec<_>>()
    };
    assert_eq!(judge(2.0), [""; 0], "half a millimetre each");
    assert!(judge(1.0).contains(&"pocket-pass-too-thick"), "a millimetre");
}

#[test]
fn kinds_of_spoiling_are_found() {
    let how = Pocketing { step: Some(Nm::from_um(500)), ..how() };
    let made = pocketed("dumbbell", dumbbell(), "endmill:1mm", &how);
    let judge = |text: &str| {
        let judged = made.judge(&[("it", text)], PITCH);
        judged.map_or(vec!["unreadable"], |judged| judged.findings.iter().map(|found| found.name).collect())
    };
    let text = made.programs[0].text.as_str();
    assert_eq!(judge(text), [""; 0], "nothing is wrong with it as it is");
    let each = |letter: char, change: fn(f64) -> f64| lines(text, |line, _| Some(word(line, letter, change)));
    let all = text.lines().filter(|line| is_cut(line)).count();
    let half = all / 2;
    let spoilt: [(&str, String, &str); 22] = [
        ("moved to the right", each('X', |x| x + 0.02), "pocket-overcut"),
        ("moved down", each('Y', |y| y - 0.02), "pocket-overcut"),
        ("a hundredth larger", each('X', |x| x * 1.01), ""),
        ("a hundredth smaller", each('X', |x| x * 0.99), ""),
        ("mirrored", each('X', |x| -x), ""),
        ("zero too high", each('Z', |z| if z < 0.0 { z + 0.03 } else { z }), "pocket-residue"),
        ("zero too low", each('Z', |z| if z < 0.0 { z - 0.03 } else { z }), "pocket-too-deep"),
        ("twice as deep", each('Z', |z| if z < 0.0 { 2.0 * z } else { z }), "pocket-too-deep"),
        (
            "the first pass left out",
            text.lines().map(|line| word(line, 'Z', |z| if z < 0.0 { -1.0 } else { z }) + "\n").collect(),
            "pocket-pass-too-thick",
        ),
        ("never below the surface", each('Z', |z| z.max(0.0)), "pocket-residue"),
        (
            "a stretch above the work",
            lines(text, |line, n| {
                let turns = is_cut(line) && (n == all - 40 || n == all - 30);
                let z = if n == all - 40 { "G1 Z1" } else { "G1 Z-1" };
                Some(if turns { format!("{z}\n{line}") } else { line.to_owned() })
            }),
            "pocket-residue",
        ),
        (
            "the second half left out",
            lines(text, |line, n| (n <= half || !is_cut(line)).then(|| line.to_owned())),
            "pocket-residue",
        ),
        (
            "a link through the island",
            text.replacen("G0 Z2\nG0 X", "G1 X3.6 Y4.1\nG0 Z2\nG0 X", 6),
            "pocket-overcut",
        ),
        ("arcs the other way", text.replace("G2 ", "G9 ").replace("G3 ", "G2 ").replace("G9 ", "G3 "), ""),
        (
            "a plunge instead of a helix",
            lines(text, |line, _| {
                let is_helix = line.starts_with("G3 ") && line.contains('Z');
                let depth = line.split('Z').nth(1).and_then(|rest| rest.split(' ').next());
                Some(if is_helix { format!("G1 Z{}", depth.unwrap_or_default()) } else { line.to_owned() })
            }),
            "pocket-plunge-too-steep",
        ),
        (
            "lifted for nothing",
            lines(text, |line, n| {
                let lifts = is_cut(line) && !line.contains('Z') && n % 50 == 0;
                Some(if lifts { format!("{line}\nG0 Z2\nG1 Z-1") } else { line.to_owned() })
            }),
            "pocket-plunges",
        ),
        (
            "a lift left out",
            {
                let mut seen = 0;
                lines(text, |line, _| {
                    seen += usize::from(line == "G0 Z2");
                    (line != "G0 Z2" || seen != 3).then(|| line.to_owned())
                })
            },
            "rapid-in-material",
        ),
        (
            "the spindle off",
            lines(text, |line, _| (!line.starts_with("M3")).then(|| line.to_owned())),
            "plunge-spindle-off",
        ),
        ("inches", text.replace("G21", "G20"), "pocket-overcut"),
        (
            "no feed",
            lines(text, |line, _| {
                let without: Vec<&str> = line.split(' ').filter(|word| !word.starts_with('F')).collect();
                Some(without.join(" "))
            }),
            "feed-missing",
        ),
        (
            "the last loop left out",
            lines(text, |line, n| (n <= all - 30 || !is_cut(line)).then(|| line.to_owned())),
            "pocket-residue",
        ),
        ("a strip moved up", each('Y', |y| if (2.0..2.3).contains(&y) { y + 0.3 } else { y }), ""),
    ];
    for (how, spoilt, expected) in spoilt {
        assert_ne!(spoilt, text, "{how}: it is changed");
        let found = judge(&spoilt);
        assert!(
            if expected.is_empty() { !found.is_empty() } else { found.contains(&expected) },
            "{how}: {expected} is not among {found:?}"
        );
    }
}

#[test]
fn another_tool_than_the_one_planned_for_is_found() {
    let planned = pocketed("dumbbell", dumbbell(), "endmill:1mm", &how());
    for (other, expected) in [("endmill:0.9mm", "pocket-residue"), ("endmill:1.1mm", "pocket-overcut")] {
        let fitted = pocketed("dumbbell", dumbbell(), other, &how());
        let found =
            fitted.judge(&[("it", planned.programs[0].text.as_str())], PITCH).expect("a program").findings;
        assert!(found.iter().any(|found| found.name == expected), "{other}: {found:?}");
    }
}

#[test]
fn a_drawing_becomes_a_program_that_passes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let drawing = "<svg xmlns='http://www.w3.org/2000/svg' width='12mm' height='8mm' viewBox='0 0 12 8'>\
        <path fill='black' d='M0 0H12V8H0Z'/></svg>";
    std::fs::write(path("plate.svg"), drawing).expect("a drawing");
    let plate = path("plate.svg");
    let wanted = ["pocket", &plate, "--tool", "endmill:2mm", "--depth", "1mm"];
    let (told, spoiling) = (["1 plunge", "0.0000 mm² are left"], ["Z-1", "Z-1.1"]);
    is_made_checked_and_found_spoilt(&wanted, folder.path(), &told, spoiling, "pocket-too-deep");
}

/// Nothing is wrong with its way: it is told, and the exit code says that it may be milled.
#[test]
fn what_breaks_the_tool_of_a_drawing_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let drawing = "<svg xmlns='http://www.w3.org/2000/svg' width='12mm' height='8mm' viewBox='0 0 12 8'>\
        <path fill='black' d='M0 0H12V8H0Z'/></svg>";
    std::fs::write(path("plate.svg"), drawing).expect("a drawing");
    let (plate, program) = (path("plate.svg"), path("made.ngc"));
    let told = |command: &str, tool: &str, rest: &[&str]| {
        let done = voromill(&[&[command, &plate, "--tool", tool, "-o", &program], rest].concat());
        assert_eq!(done.status.code(), Some(0), "{}", stderr(&done));
        let lines = stdout(&done);
        lines.lines().filter(|line| line.starts_with("  warning: ")).map(str::to_owned).collect::<Vec<_>>()
    };
    let deep = |rest: &[&str]| told("pocket", "endmill:1mm", &[&["--depth", "4mm"], rest].concat());
    assert!(
        matches!(&deep(&[])[..], [one] if one.contains("a pass down to 4.000 mm with an end mill of 1.000 mm"))
    );
    assert_eq!(deep(&["--depth-pass", "4mm"]), [""; 0], "as it was asked for");
    assert_eq!(deep(&["--depth-pass", "1mm"]), [""; 0]);
    assert_eq!(told("pocket", "endmill:2mm", &["--depth", "4mm"]), [""; 0]);
    let fast = ["--feed", "20000mm/min", "--plunge", "20000mm/min", "--spindle", "1200"];
    let found = told("pocket", "endmill:2mm", &[&["--depth", "1mm"][..], &fast].concat());
    assert!(
        matches!(&found[..], [one] if one.contains("a cut 2.000 mm wide at 20000 mm/min: at 1200 rpm")),
        "{found:?}"
    );
    let found = told("carve", "vbit:0.1mm:60deg", &[&["--max-depth", "1mm"][..], &fast].concat());
    assert!(matches!(&found[..], [one] if one.ends_with("[feed-per-turn]")), "{found:?}");
    // Near its tip a V-bit bears no feed at all.
    assert_eq!(told("carve", "vbit:0mm:60deg", &["--max-depth", "1mm"]), [""; 0]);
}

/// Lines that fill nothing are the edge of what they enclose, but for what others enclose in it.
#[test]
fn closed_lines_of_a_drawing_are_a_shape() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let corners = |x: i32, y: i32, w: i32, h: i32| [(x, y), (x + w, y), (x + w, y + h), (x, y + h), (x, y)];
    let mut drawing =
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n".to_owned();
    for ring in [corners(0, 0, 30, 20), corners(12, 8, 5, 5)] {
        for pair in ring.windows(2) {
            let [(a, b), (c, d)] = [pair[0], pair[1]];
            drawing += &format!("0\nLINE\n8\n0\n10\n{a}\n20\n{b}\n11\n{c}\n21\n{d}\n");
        }
    }
    drawing += "0\nENDSEC\n0\nEOF\n";
    std::fs::write(path("plate.dxf"), drawing).expect("a drawing");
    let made =
        voromill(&["pocket", &path("plate.dxf"), "-o", &path("p.ngc"), "--tool", "endmill:2mm", "--json"]);
    let said = String::from_utf8_lossy(&made.stdout).into_owned();
    assert!(made.status.success(), "{said}{}", String::from_utf8_lossy(&made.stderr));
    let reachable = said.split("\"reachable_mm2\": ").nth(1).and_then(|rest| rest.split(',').next());
    let reachable: f64 = reachable.expect("an area").parse().expect("a number");
    let corners = (4.0 - std::f64::consts::PI) * 1.0;
    assert!((reachable - (600.0 - 25.0 - corners)).abs() < 0.01, "{reachable} mm²");
}

#[test]
fn what_makes_no_sense_is_refused() {
    is_refused(
        "pocket",
        &[
            (&["--tool", "vbit:0.1mm:30deg"], "is not an end mill"),
            (&["--tool", "endmill:1mm", "--stepover", "60%"], "half the tool diameter"),
            (&["--tool", "endmill:1mm", "--stepover", "0mm"], "half the tool diameter"),
            (
                &["--tool", "endmill:1mm", "--stepover", "0.009mm"],
                "less than a hundredth of the tool diameter",
            ),
            (&["--tool", "endmill:1mm", "--stepover", "0.9%"], "less than a hundredth of the tool diameter"),
            (&["--tool", "endmill:1mm", "--stock", "0.6mm"], "half the tool diameter"),
            (&["--tool", "endmill:1mm", "--tolerance", "0.3mm"], "at most 0.2mm, a fifth of the finest cut"),
            (&["--tool", "endmill:1mm", "--ramp", "0deg"], "above 0deg"),
            (&["--tool", "endmill:1mm", "--depth-pass", "0mm"], "above zero"),
            (&["--tool", "endmill:1mm", "--depth-pass", "0.009mm"], "less than 0.01mm: so thin a pass"),
            (&["--tool", "endmill:9.8mm"], "narrower than"),
            (&["--tool", "endmill:1mm", "--offset", "1045mm,0mm"], "from zero: expected at most 1050.0 mm"),
            (&["--tool", "endmill:1mm", "--engagement", "15%"], "--engagement has no effect"),
            (&["--tool", "endmill:1mm", "--both-ways"], "--both-ways has no effect"),
            (&["--tool", "endmill:1mm", "--strategy", "engagement", "--engagement", "0%"], "1% to 50%"),
            (&["--tool", "endmill:1mm", "--strategy", "engagement", "--engagement", "15"], "1% to 50%"),
            (
                &["--tool", "endmill:1mm", "--strategy", "engagement", "--order", "outside-in"],
                "--order outside-in has no effect",
            ),
            (
                &["--tool", "endmill:1mm", "--strategy", "engagement", "--stock", "0.2mm"],
                "more than the engagement of 15%",
            ),
            (&["--tool", "endmill:1mm", "--strategy", "voronoi"], "offset, engagement"),
            (&["--tool", "endmill:1mm", "--width", "1mm"], "has no effect"),
        ],
    );
}
