//! What strategies plan: safe by construction, everything done once, tabs really there.

use proptest::prelude::*;
use voromill::board::{Hole, Outline, Plating, Warning};
use voromill::gcode::{Dialect, Header, write};
use voromill::geometry::{Arc, Nm, Path, Point, Rect, Segment, Turn};
use voromill::toolpath::strategy::{
    Cutout, Drilling, Isolation, Narrow, Role, TabPlaces, Tabs, cutout, drill, isolate,
};
use voromill::toolpath::{
    Angle, DrillSpeeds, Heights, Machine, Move, Order, Origin, POINT, Placement, Position, Program, Section,
    Tiling, Tool, alignment_holes, measure,
};
use voromill::topology::NetId;
use voromill::voronoi::{Boundaries, Boundary, NodeId, Owner};

fn at(x: i64, y: i64) -> Point {
    Point::new(Nm::from_um(x), Nm::from_um(y))
}

fn heights(cut: i64, step: Option<i64>) -> Heights {
    Heights {
        safe: Nm::from_mm(2),
        approach: Nm::from_um(500),
        cut: Nm::from_um(cut),
        step: step.map(Nm::from_um),
    }
}

fn tool(text: &str) -> Tool {
    text.parse().expect("a tool")
}

fn line(points: &[Point]) -> Path {
    Path::polyline(points.iter().copied()).expect("a point")
}

fn boundary(points: &[Point], clearance: i64, ends: Option<(u32, u32)>) -> Boundary {
    Boundary {
        path: line(points),
        clearance: vec![Nm::from_um(clearance); points.len()],
        left: Owner::Net(NetId(0)),
        right: Owner::Net(NetId(1)),
        ends: ends.map(|(a, b)| (NodeId(a), NodeId(b))),
    }
}

/// A short bar between two forks, and a loop beside.
fn forks() -> Boundaries {
    let nodes =
        vec![at(0, 0), at(1000, 0), at(-5000, 5000), at(-5000, -5000), at(6000, 5000), at(6000, -5000)];
    let edge = |a: u32, b: u32| boundary(&[nodes[a as usize], nodes[b as usize]], 500, Some((a, b)));
    let ring = [at(9000, 0), at(12_000, 0), at(12_000, 3000), at(9000, 3000), at(9000, 0)];
    let mut edges = vec![edge(0, 1), edge(0, 2), edge(0, 3), edge(1, 4), edge(1, 5)];
    edges.push(boundary(&ring, 60, None));
    Boundaries { nodes, edges, links: vec![] }
}

fn name(owner: Owner) -> String {
    match owner {
        Owner::Net(NetId(0)) => "GND".to_owned(),
        Owner::Net(_) => "VCC".to_owned(),
        Owner::Background | Owner::Outside => "the edge".to_owned(),
    }
}

/// What every section must keep: it begins and ends at the safe height, rapids are level there or
/// straight up or down through air, and only feeds go sideways below.
fn assert_safe(section: &Section, heights: Heights) {
    let mut here: Option<Position> = None;
    for step in &section.moves {
        let Some(to) = step.to() else { continue };
        match (here, step) {
            (None, Move::Rapid { to }) => {
                assert_eq!(to.z, heights.safe, "the first move is at the safe height")
            }
            (None, _) => panic!("the first move is a rapid"),
            (Some(from), Move::Rapid { .. }) if from.point() == to.point() => {
                let up = to.z >= from.z;
                assert!(up || to.z >= heights.approach, "a rapid goes down to {:?} µm", to.z);
            }
            (Some(from), Move::Rapid { .. }) => {
                assert!(
                    from.z == heights.safe && to.z == heights.safe,
                    "a rapid goes sideways below the safe height"
                );
            }
            (Some(_), Move::Feed { .. } | Move::Arc { .. }) => {
                assert!(to.z >= -heights.cut, "a feed goes deeper than the cut");
            }
            (Some(_), Move::Dwell { .. }) => {}
        }
        here = Some(to);
    }
    assert!(here.is_none_or(|here| here.z == heights.safe), "it ends at the safe height");
}

fn text(sections: Vec<Section>) -> String {
    let program = Program { title: "a test".to_owned(), notes: Vec::new(), safe: Nm::from_mm(2), sections };
    write(&program, Dialect::by_name("grbl").expect("built in"), &Header::default())
}

/// A section as text, compared with the one that was looked at.
fn assert_as_looked_at(case: &str, sections: Vec<Section>) {
    insta::with_settings!({
        snapshot_path => concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots/toolpath"),
        prepend_module_to_snapshot => false
    }, {
        insta::assert_snapshot!(case, text(sections));
    });
}

fn isolation<'a>(tool: &'a Tool, placement: &'a Placement, machine: &'a Machine) -> Isolation<'a> {
    Isolation {
        tool,
        heights: heights(100, None),
        placement,
        order: Order::Improved,
        machine,
        narrow: Narrow::Centre,
        adaptive: None,
        direction: None,
    }
}

#[test]
fn a_short_bar_is_cut_twice_rather_than_lifting() {
    let (tool, placement, machine) = (tool("vbit:0.1mm:30deg"), Placement::default(), Machine::default());
    let settings = isolation(&tool, &placement, &machine);
    let (section, _) = isolate("isolate front", &forks(), &[], |_| Role::Cut, name, &settings);
    assert_safe(&section, settings.heights);
    let program = Program {
        title: String::new(),
        notes: Vec::new(),
        safe: settings.heights.safe,
        sections: vec![section.clone()],
    };
    let statistics = measure(&program, &machine);
    assert_eq!(statistics.retracts, 3, "two trails through the forks and the loop");
    assert_as_looked_at("forks", vec![section]);
}

#[test]
fn a_gap_narrower_than_the_kerf_is_listed_with_its_place_and_its_nets() {
    let (tool, placement, machine) = (tool("vbit:0.1mm:30deg"), Placement::default(), Machine::default());
    let mut settings = isolation(&tool, &placement, &machine);
    let (all, warnings) = isolate("", &forks(), &[], |_| Role::Cut, name, &settings);
    let [warning] = warnings.as_slice() else { panic!("one boundary is narrow: {warnings:?}") };
    assert_eq!((warning.code(), warning.at), ("gap-narrower-than-tool", Some(at(9000, 0))), "where it is");
    for part in ["GND and VCC", "120.0 µm of room", "153.6 µm", "16.8 µm"] {
        assert!(warning.text().contains(part), "`{}` does not say `{part}`", warning.text());
    }
    settings.narrow = Narrow::Skip;
    let (wide, _) = isolate("", &forks(), &[], |_| Role::Cut, name, &settings);
    assert!(wide.moves.len() < all.moves.len(), "the narrow loop is left");
}

#[test]
fn a_v_bit_rises_where_the_gap_is_narrow() {
    let (tool, placement, machine) = (tool("vbit:0.1mm:30deg"), Placement::default(), Machine::default());
    let settings = Isolation { adaptive: Some(Nm::from_um(20)), ..isolation(&tool, &placement, &machine) };
    let (section, narrow) = isolate("isolate front", &forks(), &[], |_| Role::Cut, name, &settings);
    assert!(narrow.is_empty(), "nothing is narrower than the cut at its least depth: {narrow:?}");
    let shallow = Isolation { adaptive: Some(Nm::from_um(50)), ..settings };
    let (_, narrow) = isolate("isolate front", &forks(), &[], |_| Role::Cut, name, &shallow);
    assert!(narrow.len() == 1 && narrow[0].message.contains("kerf of 126.8 µm"), "{narrow:?}");
    assert_safe(&section, settings.heights);
    let around: Vec<Nm> = section
        .moves
        .iter()
        .filter_map(Move::to)
        .filter(|to| to.x >= Nm::from_mm(9) && to.z < Nm::ZERO)
        .map(|to| tool.width_at(-to.z))
        .collect();
    assert!(!around.is_empty(), "the loop is cut");
    assert!(around.iter().all(|&kerf| kerf <= Nm::from_um(120)), "the kerf fits the gap: {around:?}");
    assert_as_looked_at("adaptive_depth", vec![section]);
}

fn outline() -> Outline {
    let ring = |rect: Rect| line(&[rect.corners().as_slice(), &rect.corners()[..1]].concat());
    let board = ring(Rect::new(at(0, 0), at(40_000, 30_000)));
    let window = ring(Rect::new(at(10_000, 10_000), at(25_000, 20_000)));
    Outline::new(vec![board, window]).expect("closed contours")
}

fn cutting<'a>(tool: &'a Tool, placement: &'a Placement, count: u32) -> Cutout<'a> {
    let tabs = Tabs { places: TabPlaces::Count(count), width: Nm::from_mm(2), top: Nm::from_um(1100) };
    Cutout {
        tool,
        heights: heights(1700, Some(600)),
        placement,
        tabs,
        ramp: None,
        direction: None,
        drilled: &[],
    }
}

#[test]
fn a_board_with_a_window_is_cut_from_the_inside_out() {
    let (tool, placement) = (tool("endmill:1mm"), Placement::default());
    let settings = cutting(&tool, &placement, 2);
    let (section, warnings) = cutout(&outline(), &settings);
    assert!(warnings.is_empty(), "nothing to warn about: {warnings:?}");
    assert_safe(&section, settings.heights);
    let first = section.moves[0].to().expect("a place");
    assert!(Rect::new(at(10_000, 10_000), at(25_000, 20_000)).contains(first.point()), "the window first");
    assert_as_looked_at("cutout", vec![section]);
}

/// How much of the way at full depth is missing, in stretches: the openings over the tabs.
fn bridges(section: &Section, top: Nm) -> Vec<(Point, f64)> {
    let (mut here, mut bridges) = (Position::default(), Vec::new());
    for step in &section.moves {
        let to = step.to().unwrap_or(here);
        let level = matches!(step, Move::Feed { .. }) && here.z == to.z && here.point() != to.point();
        if level && here.z == -top {
            bridges.push((here.point(), here.point().distance(to.point())));
        }
        here = to;
    }
    bridges
}

#[test]
fn tabs_are_really_there() {
    let (tool, placement) = (tool("endmill:1mm"), Placement::default());
    let settings = cutting(&tool, &placement, 3);
    let (section, _) = cutout(&outline(), &settings);
    let top = settings.tabs.top;
    let bridges = bridges(&section, top);
    let below = settings.heights.passes().filter(|&depth| depth > top).count();
    assert_eq!(bridges.len(), 2 * 3 * below, "three on each contour, in each pass below their top");
    for (_, bridge) in bridges {
        // A tab of 2 mm and half a cutter on both sides.
        assert!((bridge - 3e6).abs() < 2.0, "an opening of {bridge} nm");
    }
}

/// Where a cutter goes down into what is not cut yet, more steeply than a ramp may be: the deepest
/// that each place was cut before counts, level ways between places that are looked at too.
fn plunges(section: &Section, angle: Angle) -> Vec<Position> {
    const GRID: f64 = 20_000.0;
    let cell = |p: Point| [p.x, p.y].map(|length| length.get().div_euclid(20_000));
    let mut cut: std::collections::BTreeMap<[i64; 2], f64> = std::collections::BTreeMap::new();
    let (mut here, mut plunges) = (Position::default(), Vec::new());
    for step in &section.moves {
        let to = step.to().unwrap_or(here);
        let (from, end) = ([here.x, here.y, here.z].map(Nm::to_f64), [to.x, to.y, to.z].map(Nm::to_f64));
        let way = match *step {
            Move::Arc { center, turn, .. } => Segment::Arc { to: to.point(), center, turn },
            _ => Segment::Line { to: to.point() },
        };
        let long = way.length(here.point());
        let steps = (long / GRID * 4.0).ceil().max(1.0);
        let slope = if long > 0.0 { (from[2] - end[2]) / long } else { f64::INFINITY };
        let mut done = 0.0;
        while done < steps {
            done += 1.0;
            let p = way.at(here.point(), done / steps);
            let z = from[2] + (end[2] - from[2]) * done / steps;
            let floor = cut.entry(cell(p)).or_insert(0.0);
            let is_steep = slope > libm::tan(angle.radians()) * 1.01;
            // A cell is as wide as a ramp goes down by that much.
            if is_steep && z < *floor - 2.0 * GRID * libm::tan(angle.radians()) - 10.0 {
                plunges.push(to);
            }
            *floor = floor.min(z);
        }
        here = to;
    }
    plunges
}

#[test]
fn a_cutter_that_cannot_plunge_goes_down_ramps_alone() {
    let (tool, placement) = (tool("endmill:1mm"), Placement::default());
    let straight = cutout(&outline(), &cutting(&tool, &placement, 4)).0;
    for degrees in [1, 3, 20] {
        // At one degree a pass of 0.6 mm is longer than the window is round.
        let angle = Angle::from_degrees(degrees);
        assert!(!plunges(&straight, angle).is_empty(), "it plunges, so that this can be seen");
        for tabs in [0, 1, 4] {
            let settings = Cutout { ramp: Some(angle), ..cutting(&tool, &placement, tabs) };
            let (section, _) = cutout(&outline(), &settings);
            assert_safe(&section, settings.heights);
            assert_eq!(plunges(&section, angle), [], "{tabs} tabs, {degrees} degrees");
        }
    }
}

#[test]
fn the_cutter_stays_outside_the_board() {
    let (tool, placement) = (tool("endmill:1mm"), Placement::default());
    let (section, _) = cutout(&outline(), &cutting(&tool, &placement, 4));
    let board = Rect::new(at(0, 0), at(40_000, 30_000)).inflate(Nm::from_um(497));
    let window = Rect::new(at(10_000, 10_000), at(25_000, 20_000)).inflate(Nm::from_um(-497));
    for to in section.moves.iter().filter_map(Move::to) {
        let p = to.point();
        let inside = |r: Rect| r.min().x < p.x && p.x < r.max().x && r.min().y < p.y && p.y < r.max().y;
        let round = [at(0, 0), at(40_000, 0), at(40_000, 30_000), at(0, 30_000)]
            .iter()
            .any(|corner| corner.distance(p) >= 497_000.0 && corner.distance(p) <= 503_000.0);
        assert!(!inside(board) || inside(window) || round || window.contains(p), "{p:?} is in the board");
    }
}

#[test]
fn a_window_narrower_than_the_cutter_is_left_with_a_warning() {
    let (tool, placement) = (tool("endmill:12mm"), Placement::default());
    let (_, warnings) = cutout(&outline(), &cutting(&tool, &placement, 0));
    assert_eq!(warnings.iter().map(|w| w.code()).collect::<Vec<_>>(), ["cut-out-narrower-than-tool"], "one");
}

#[test]
fn boards_that_the_cutter_does_not_fit_between_have_tabs_of_their_own() {
    let (tool, placement) = (tool("endmill:1mm"), Placement::default());
    let square = |left: i64| {
        let corners = [(left, 0), (left + 20_000, 0), (left + 20_000, 20_000), (left, 20_000), (left, 0)];
        line(&corners.map(|(x, y)| at(x, y)))
    };
    let settings = cutting(&tool, &placement, 3);
    let top = settings.tabs.top;
    let below = settings.heights.passes().filter(|&depth| depth > top).count();
    for (gap, codes) in [(1_100, vec![]), (600, vec!["boards-closer-than-tool"])] {
        let outline = Outline::new(vec![square(0), square(20_000 + gap)]).expect("two boards");
        let (section, warnings) = cutout(&outline, &settings);
        assert_eq!(warnings.iter().map(|w| w.code()).collect::<Vec<_>>(), codes, "{gap} µm apart");
        let bridges = bridges(&section, top);
        let middle = Nm::from_um(20_000 + gap / 2);
        let of_first = bridges.iter().filter(|(at, _)| at.x < middle).count();
        assert_eq!((bridges.len(), of_first), (6 * below, 3 * below), "{gap} µm apart: three each");
    }
}

fn hole(x: i64, y: i64, diameter: i64, to: Option<Point>) -> Hole {
    let points: Vec<Point> = std::iter::once(at(x, y)).chain(to).collect();
    Hole { path: line(&points), diameter: Nm::from_um(diameter), plating: Plating::Plated, tool: 1, line: 1 }
}

fn drilling<'a>(drills: &'a [Tool], mill: Option<&'a Tool>, placement: &'a Placement) -> Drilling<'a> {
    Drilling {
        drills,
        tolerance: Nm::from_um(50),
        mill,
        bored_from: None,
        heights: heights(1800, Some(1000)),
        turn: None,
        placement,
        order: Order::Improved,
        dwell: 0,
        tips: false,
        one: false,
        speeds: DrillSpeeds::default(),
        point: POINT,
    }
}

#[test]
fn from_a_diameter_on_holes_are_bored_though_a_drill_fits() {
    let (placement, mill) = (Placement::default(), tool("endmill:1mm"));
    let holes = [hole(0, 0, 800, None), hole(5000, 0, 1200, None), hole(9000, 0, 3200, None)];
    let drilled = |from: Option<i64>| {
        let settings =
            Drilling { bored_from: from.map(Nm::from_um), ..drilling(&[], Some(&mill), &placement) };
        drill(&holes, &settings)
    };
    let labels = |from: Option<i64>| -> Vec<String> {
        drilled(from).0.into_iter().map(|section| section.label).collect()
    };
    assert_eq!(labels(None).len(), 3, "a drill each");
    assert_eq!(labels(Some(1200)), ["drill 0.800 mm, 1 hole", "bore 2 holes and slots"], "the two wide ones");
    assert_eq!(
        labels(Some(100)),
        ["drill 0.800 mm, 1 hole", "bore 2 holes and slots"],
        "the mill does not fit the narrow one"
    );
    assert_eq!(drilled(Some(1200)).1, [], "it fits all");
    let warnings = drilled(Some(100)).1;
    assert_eq!(warnings.iter().map(Warning::code).collect::<Vec<_>>(), ["not-bored"], "and that is said");
    assert!(warnings[0].message.contains("does not fit 1 hole"), "{}", warnings[0].message);
}

#[test]
fn holes_go_to_the_nearest_drill_or_to_the_mill_or_to_a_warning() {
    let (placement, mill) = (Placement::default(), tool("endmill:1mm"));
    let drills = [tool("drill:0.6mm"), tool("drill:0.8mm")];
    let holes = [
        hole(0, 0, 830, None),
        hole(5000, 0, 600, None),
        hole(9000, 0, 3200, None),
        hole(0, 9000, 1200, Some(at(3000, 9000))),
        hole(5000, 5000, 700, None),
    ];
    let (sections, warnings) = drill(&holes, &drilling(&drills, Some(&mill), &placement));
    let labels: Vec<&str> = sections.iter().map(|section| section.label.as_str()).collect();
    assert_eq!(
        labels,
        ["drill 0.600 mm, 1 hole", "drill 0.800 mm, 1 hole", "bore 2 holes and slots"],
        "the plan"
    );
    assert_eq!(
        warnings.iter().map(|w| (w.code(), w.at)).collect::<Vec<_>>(),
        [("no-drill-for-hole", Some(at(5000, 5000)))],
        "0.7 mm"
    );
    for section in &sections {
        assert_safe(section, heights(1800, None));
    }
    assert_as_looked_at("drill_and_bore", sections);
}

#[test]
fn a_slot_without_a_mill_is_a_chain_of_holes_with_low_ridges() {
    let (placement, holes) = (Placement::default(), [hole(0, 0, 1000, Some(at(3000, 0)))]);
    let (sections, _) = drill(&holes, &drilling(&[], None, &placement));
    let mut deep: Vec<Nm> = sections[0]
        .moves
        .iter()
        .filter_map(Move::to)
        .filter(|to| to.z == Nm::from_um(-1800))
        .map(|to| to.x)
        .collect();
    deep.sort_unstable();
    assert_eq!((deep.first(), deep.last()), (Some(&Nm::ZERO), Some(&Nm::from_mm(3))), "both ends");
    for pair in deep.windows(2) {
        let half = (pair[1] - pair[0]).to_f64() / 2.0;
        let ridge = 500_000.0 - (500_000.0_f64 * 500_000.0 - half * half).sqrt();
        // A quarter of the drill apart, which leaves more than half a thousandth of an inch from
        // 0.8 mm on.
        assert!(ridge <= 16_000.0, "a ridge of {ridge} nm");
        assert!(half <= 125_000.0 && half > 100_000.0, "{half} nm");
    }
}

/// From where a tool is changed the machine goes over the next hole first, and then down.
#[test]
fn the_way_back_from_a_tool_change_is_measured() {
    let at = |x: i64, z: i64| Position { x: Nm::from_mm(x), y: Nm::ZERO, z: Nm::from_mm(z) };
    let hole = |name: &str, x: i64, number: u32| {
        let moves = vec![
            Move::Rapid { to: at(x, 2) },
            Move::Feed { to: at(x, -1), feed: tool(name).plunge },
            Move::Rapid { to: at(x, 2) },
        ];
        Section { tool: Tool { number, ..tool(name) }, label: String::new(), moves }
    };
    let sections = vec![hole("drill:1mm", 10, 1), hole("drill:2mm", 30, 2)];
    let mut program = Program { title: String::new(), notes: Vec::new(), safe: Nm::from_mm(2), sections };
    let machine = Machine::default();
    let near = measure(&program, &machine);
    let parked = (None, Nm::from_mm(40));
    let far = program.while_parking(parked, (None, Nm::from_mm(2)), |parked| measure(parked, &machine));
    assert_eq!(near.rapid_length, Nm::from_mm(30), "from zero to both");
    assert_eq!(far.rapid_length, near.rapid_length, "above it is as long");
    let down = 38.0 / (600.0 / 60.0);
    assert!(far.seconds > near.seconds + 2.0 * down, "up and down: {} and {}", far.seconds, near.seconds);
}

#[test]
fn rises_are_as_fast_as_the_machine_without_a_word() {
    let at = |z: i64| Position { z: Nm::from_um(z), ..Position::default() };
    let fast: voromill::toolpath::Feed = "600mm/min".parse().expect("a feed");
    let slow: voromill::toolpath::Feed = "150mm/min".parse().expect("a feed");
    let machine = Machine { feed: Some([fast, fast, slow]), ..Machine::default() };
    let told = |to: i64| {
        let moves = vec![Move::Rapid { to: at(0) }, Move::Feed { to: at(to), feed: fast }];
        let own = Tool { plunge: slow, ..tool("endmill:1mm") };
        let section = Section { tool: own, label: String::new(), moves };
        let mut program =
            Program { title: String::new(), notes: Vec::new(), safe: Nm::ZERO, sections: vec![section] };
        let warnings = machine.restrain(&mut program).len();
        let Move::Feed { feed, .. } = program.sections[0].moves[1] else { panic!("a feed") };
        (warnings, feed)
    };
    assert_eq!(told(1000), (0, slow), "up");
    assert_eq!(told(-1000), (1, slow), "down");
}

/// Down a slope of 45° z is √2 times as slow as the way is.
#[test]
fn down_a_slope_z_goes_no_faster_than_it_can() {
    let at = |x: i64, z: i64| Position { x: Nm::from_um(x), z: Nm::from_um(z), ..Position::default() };
    let [fast, slow]: [voromill::toolpath::Feed; 2] =
        ["600mm/min", "100mm/min"].map(|feed| feed.parse().expect("a feed"));
    let machine = Machine { feed: Some([fast, fast, slow]), ..Machine::default() };
    let limited = |to: Position| {
        let moves = vec![Move::Rapid { to: at(0, 0) }, Move::Feed { to, feed: fast }];
        let own = Tool { plunge: fast, ..tool("endmill:1mm") };
        let section = Section { tool: own, label: String::new(), moves };
        let mut program =
            Program { title: String::new(), notes: Vec::new(), safe: Nm::ZERO, sections: vec![section] };
        assert_eq!(machine.restrain(&mut program).len(), 0, "of plunges is told");
        let Move::Feed { feed, .. } = program.sections[0].moves[1] else { panic!("a feed") };
        feed.to_string()
    };
    assert_eq!(limited(at(1000, -1000)), "141mm/min", "as fast down as along");
    assert_eq!(limited(at(1000, -10)), "600mm/min", "hardly down");
    assert_eq!(limited(at(1000, 1000)), "600mm/min", "up");
}

/// In a hole of 10 × 10 mm a tab of 2 mm has no straight way of twice its opening: it stands on a
/// side all the same, and none goes round a corner.
#[test]
fn in_a_small_cut_out_tabs_stand_between_its_corners() {
    let (tool, placement) = (tool("endmill:2mm"), Placement::default());
    let ring = |[left, right]: [i64; 2]| {
        let corners = [at(left, left), at(left, right), at(right, right), at(right, left), at(left, left)];
        line(&corners)
    };
    let outline = Outline::new(vec![ring([0, 30_000]), ring([10_000, 20_000])]).expect("an outline");
    let section = cutout(&outline, &cutting(&tool, &placement, 4)).0;
    let top = cutting(&tool, &placement, 4).tabs.top;
    let mut within: Vec<Position> = section.moves.iter().filter_map(Move::to).collect();
    within.retain(|to| (10_000_001..20_000_000).contains(&to.x.get()) && to.z == -top);
    assert!(within.len() >= 2, "tabs: {within:?}");
    for tab in within {
        let near = [tab.x, tab.y].map(|side| (side.get() - 15_000_000).abs());
        assert!(near[0].min(near[1]) < 3_999_000, "no corner of the way: {tab:?}");
    }
}

#[test]
fn tiles_repeat_every_section_before_the_next_tool() {
    let (placement, holes) = (Placement::default(), [hole(0, 0, 800, None), hole(5000, 0, 1000, None)]);
    let (sections, _) = drill(&holes, &drilling(&[], None, &placement));
    let program = Program { title: String::new(), notes: Vec::new(), safe: Nm::from_mm(2), sections };
    let tiling = Tiling { columns: 2, rows: 3, pitch: at(20_000, 10_000) - at(0, 0) };
    let tiled = program.clone().tiled(tiling);
    assert_eq!(tiled.sections.len(), 2, "no tool is fitted twice");
    for (one, all) in program.sections.iter().zip(&tiled.sections) {
        assert_eq!(all.moves.len(), 6 * one.moves.len(), "six tiles");
        assert_safe(all, heights(1800, None));
    }
    assert_eq!(tiled.bounds(), Some(Rect::new(at(0, 0), at(25_000, 20_000))), "all tiles and no more");
}

#[test]
fn a_program_that_the_machine_cannot_reach_is_warned_about() {
    let (placement, holes) = (Placement::default(), [hole(0, 0, 800, None), hole(50_000, 0, 800, None)]);
    let (sections, _) = drill(&holes, &drilling(&[], None, &placement));
    let program = Program { title: String::new(), notes: Vec::new(), safe: Nm::from_mm(2), sections };
    let reach = |x| Machine {
        travel: Some([Nm::from_mm(x), Nm::from_mm(40), Nm::from_mm(10)]),
        ..Machine::default()
    };
    assert_eq!(program.check_travel(&reach(60)), None, "it fits");
    let warning = program.check_travel(&reach(40)).expect("too small");
    assert_eq!(warning.code(), "beyond-the-machine", "{}", warning.message);
}

#[test]
fn alignment_holes_fall_on_themselves_when_the_board_is_turned_over() {
    let bounds = Rect::new(at(0, 0), at(40_000, 30_000));
    let axis = Placement::default().middle(bounds);
    let over = Placement::default().turned_over(axis);
    for hole in alignment_holes(bounds, axis, Nm::from_mm(5)) {
        assert_eq!(over.point(hole), hole, "on the axis");
        assert!(!bounds.contains(hole), "beside the board");
    }
}

#[test]
fn holes_that_begin_within_others_are_told() {
    let placement = Placement::default();
    let codes = |holes: &[Hole]| {
        let (_, warnings) = drill(holes, &drilling(&[], None, &placement));
        warnings.iter().map(|warning| warning.code()).collect::<Vec<_>>()
    };
    let beside = |apart: i64, diameter: i64| codes(&[hole(0, 0, 800, None), hole(apart, 0, diameter, None)]);
    assert_eq!(beside(400, 800), ["holes-overlap"], "half a hole apart");
    assert_eq!(beside(840, 1000), ["holes-overlap"], "of two drills");
    assert_eq!(beside(900, 1000), Vec::<&str>::new(), "side by side");
    assert_eq!(beside(0, 1000), Vec::<&str>::new(), "one in the middle of the other");
    let slot = hole(400, 0, 800, Some(at(3000, 0)));
    assert_eq!(
        codes(&[hole(0, 0, 800, None), slot]),
        Vec::<&str>::new(),
        "slots are holes in a row themselves"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn every_hole_is_drilled_exactly_once(
        places in prop::collection::btree_map((0..400_i64, 0..300_i64), 0..3_usize, 1..40),
        mirror in prop::option::of(0..50_i64),
    ) {
        let holes: Vec<Hole> =
            places.iter().map(|(&(x, y), &size)| hole(x * 100, y * 100, [600, 800, 1000][size], None)).collect();
        let placement = Placement { mirror: mirror.map(Nm::from_mm), ..Placement::default() };
        let settings = drilling(&[], None, &placement);
        let (sections, warnings) = drill(&holes, &settings);
        let is_told = warnings.iter().all(|warning| warning.code() == "holes-overlap");
        prop_assert!(is_told, "all diameters are at hand: {warnings:?}");
        let bottom = Nm::from_um(-1800);
        let mut hit: Vec<(Point, Nm)> = Vec::new();
        for section in &sections {
            assert_safe(section, settings.heights);
            let deep = section.moves.iter().filter_map(Move::to).filter(|to| to.z == bottom);
            hit.extend(deep.map(|to| (to.point(), section.tool.width_at(Nm::ZERO))));
        }
        let mut wanted: Vec<(Point, Nm)> =
            holes.iter().map(|hole| (placement.point(hole.path.start), hole.diameter)).collect();
        hit.sort_unstable();
        wanted.sort_unstable();
        prop_assert_eq!(hit, wanted);
    }

    #[test]
    fn every_boundary_is_cut_and_the_tool_is_safe(
        edges in prop::collection::vec((0..12_u32, 0..12_u32, any::<bool>()), 1..30),
        step in prop::option::of(30..100_i64),
    ) {
        let nodes: Vec<Point> = (0..12).map(|i| at(i % 4 * 7000 + i * i * 30, i / 4 * 9000 + i * 170)).collect();
        let edges: Vec<Boundary> = edges
            .into_iter()
            .map(|(a, b, bent)| {
                let (from, to) = (nodes[a as usize], nodes[b as usize]);
                let middle = at(i64::from(a) * 900 + 3000, i64::from(b) * 700 + 20_000);
                let points = if bent || a == b { vec![from, middle, to] } else { vec![from, to] };
                boundary(&points, 300, Some((a, b)))
            })
            .collect();
        let boundaries = Boundaries { nodes, edges, links: vec![] };
        let (tool, placement, machine) = (tool("endmill:0.2mm"), Placement::default(), Machine::default());
        let settings = Isolation { heights: heights(100, step), ..isolation(&tool, &placement, &machine) };
        let (section, warnings) = isolate("", &boundaries, &[], |_| Role::Cut, name, &settings);
        prop_assert!(warnings.is_empty(), "the gaps are wide");
        assert_safe(&section, settings.heights);
        let bottom = -settings.heights.cut;
        let mut cuts: Vec<(Point, Point)> = Vec::new();
        let mut here = Position::default();
        for step in &section.moves {
            let to = step.to().unwrap_or(here);
            if here.z == bottom && to.z == bottom {
                cuts.push((here.point().min(to.point()), here.point().max(to.point())));
            }
            here = to;
        }
        for edge in &boundaries.edges {
            for (from, segment) in edge.path.steps() {
                let wanted = (from.min(segment.to()), from.max(segment.to()));
                prop_assert!(cuts.contains(&wanted), "{wanted:?} is not cut");
            }
        }
    }

    #[test]
    fn arcs_stay_arcs_wherever_the_board_is_placed(x in -50_000..50_000_i64, y in -50_000..50_000_i64, turned in 0..4_i64, mirrored in any::<bool>()) {
        let rotation = format!("{}deg", turned * 37).parse().expect("an angle");
        let bounds = Rect::new(at(0, 0), at(100_000, 80_000));
        let front = Placement::front(Origin::LowerLeft, bounds, rotation, at(x, y) - at(0, 0));
        let placement = if mirrored { front.turned_over(front.middle(bounds)) } else { front };
        let arc = Arc { start: at(3000, 0), end: at(0, 3000), center: at(0, 0), turn: Turn::CounterClockwise };
        let placed = Arc {
            start: placement.point(arc.start),
            end: placement.point(arc.end),
            center: placement.point(arc.center),
            turn: placement.turn(arc.turn),
        };
        prop_assert!((placed.length() - arc.length()).abs() < 10.0, "{} became {}", arc.length(), placed.length());
    }
}
