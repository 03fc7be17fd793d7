//! KiCad boards beside KiCad's own plots of them: the same nets, copper, holes and edge.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use voromill::board::{Axis, Board, Copper, FLATTEN, Feature, Hole, Outline, Plating, Side, polarity};
use voromill::geometry::{Nm, Polygon, Rect};
use voromill::import::{self, Loaded, Selection};

use crate::corpus;

/// A board of KiCad beside its plots, which are moved to where the board lies.
struct Pair {
    name: &'static str,
    ours: Loaded,
    plotted: Board,
    /// How far the two may be apart.
    within: Nm,
    /// Whether there are texts on copper, whose letters differ in shape.
    lettered: bool,
}

fn load(path: &Path) -> Loaded {
    let loaded = import::load(&[path.to_owned()], &Selection::default());
    loaded.unwrap_or_else(|error| panic!("{}:\n{}", path.display(), error.render()))
}

/// Boards whose plots are of the same revision, read once.
fn pairs() -> &'static [Pair] {
    static PAIRS: OnceLock<Vec<Pair>> = OnceLock::new();
    PAIRS.get_or_init(|| {
        let Some(artwork) = corpus::artwork() else { return Vec::new() };
        let artwork = artwork.join("kicad");
        // Those that are moved were plotted from another origin than they were saved with.
        let beside = [
            ("v4_ftsh", "ftsh_breakout", false),
            ("v4_karacoro", "karacoro", false),
            ("v4_blinds_mainboard", "mainboard-pcb", true),
            ("v9_opentherm", "OpenThermShield", true),
            ("v9_first_exercise", "firstExcercise", false),
        ];
        let mut pairs = Vec::new();
        for (name, file, moved) in beside {
            let ours = load(&artwork.join(name).join(file).with_extension("kicad_pcb"));
            let plotted = load(&artwork.join(name).join("gerbers")).board;
            let plotted = if moved { laid_on(&plotted, &ours.board) } else { plotted };
            pairs.push(Pair { name, ours, plotted, within: Nm::from_um(1), lettered: false });
        }
        // KiCad plots custom pads with few chords for an arc: up to 22 µm inside it where one ends,
        // as a third program measures, and 0.015 % of the copper.
        let elsewhere = [
            ("v6_ecc83-pp", "kicad_ecc83", 1),
            ("v6_custom_pads_test", "kicad_custom_pads", 25),
            ("v6_interf_u", "kicad_interf_u", 1),
            ("v6_StickHub", "kicad_stickhub", 1),
        ];
        if let Some(boards) = corpus::boards() {
            for (name, plots, within) in elsewhere {
                let ours = load(&artwork.join(format!("{name}.kicad_pcb")));
                let plotted = load(&boards.join(plots)).board;
                let lettered = matches!(plots, "kicad_custom_pads" | "kicad_interf_u");
                pairs.push(Pair { name, ours, plotted, within: Nm::from_um(within), lettered });
            }
        }
        pairs
    })
}

/// `board` moved to where the copper of `other` lies.
fn laid_on(board: &Board, other: &Board) -> Board {
    let corner = |board: &Board| board.front.as_ref().and_then(Copper::bounds).expect("copper").min();
    let way = corner(other) - corner(board);
    let feature = |feature: &Feature| Feature { shape: feature.shape.translated(way), ..feature.clone() };
    let copper = |copper: &Copper| Copper {
        features: copper.features.iter().map(feature).collect(),
        ..copper.clone()
    };
    let contours = board.outline.iter().flat_map(Outline::contours);
    let hole = |hole: &Hole| Hole { path: hole.path.translated(way), ..hole.clone() };
    Board {
        front: board.front.as_ref().map(copper),
        back: board.back.as_ref().map(copper),
        outline: Outline::new(contours.map(|contour| contour.translated(way)).collect()),
        holes: board.holes.iter().map(hole).collect(),
        ..board.clone()
    }
}

/// The copper as polygons that do not touch, without lettering, and without what a hole that is not
/// plated takes: KiCad 6 plots the pad of a slot that is as large as the slot.
fn islands(board: &Board, side: Side, pair: &Pair) -> Vec<Polygon> {
    let Some(copper) = board.copper(side) else { return Vec::new() };
    let counts = |feature: &&Feature| {
        let function = copper.attributes_of(feature).function.as_deref();
        !(pair.lettered && function == Some("NonConductor"))
    };
    let features = copper.features.iter().filter(counts);
    let shapes: Vec<Polygon> = features.filter_map(|feature| feature.shape.polygon(FLATTEN)).collect();
    let mut islands = polarity::union(&shapes);
    let bare: Vec<&Hole> = board.holes.iter().filter(|hole| hole.plating == Plating::NonPlated).collect();
    islands.retain(|island| {
        let (low, high) = (island.bounds().min(), island.bounds().max());
        !bare.iter().any(|hole| hole.bounds().contains(low) && hole.bounds().contains(high))
    });
    islands
}

fn area(polygons: &[Polygon]) -> f64 {
    polygons.iter().map(Polygon::area_mm2).sum()
}

/// What of `inner` lies more than `by` outside `outer`.
fn beyond(inner: &[Polygon], outer: &[Polygon], by: Nm) -> Vec<Polygon> {
    let grown: Vec<Polygon> =
        outer.iter().flat_map(|polygon| polarity::offset(polygon, by, Nm::new(50))).collect();
    let near = |polygon: &Polygon| {
        let bounds = polygon.bounds();
        grown.iter().filter(move |other| other.bounds().touches(bounds)).collect::<Vec<_>>()
    };
    inner.iter().flat_map(|polygon| polarity::difference(polygon, near(polygon))).collect()
}

/// How two drawings differ by more than they may, in words.
fn differences(ours: &[Polygon], plotted: &[Polygon], within: Nm) -> Vec<String> {
    let mut found = Vec::new();
    if ours.len() != plotted.len() {
        found.push(format!("{} islands and not {}", ours.len(), plotted.len()));
    }
    let (a, b) = (area(ours), area(plotted));
    let share = if within > Nm::from_um(1) { 2e-4 } else { 1e-4 };
    if (a - b).abs() > share * b {
        found.push(format!("{a} mm² and not {b}"));
    }
    for (inner, outer, side) in [(ours, plotted, "too much"), (plotted, ours, "missing")] {
        let rest = beyond(inner, outer, within);
        if let Some(first) = rest.first() {
            let place = first.bounds();
            found.push(format!("{side}: {} mm² in {} pieces, at {place:?}", area(&rest), rest.len()));
        }
    }
    found
}

/// Fails where any pair differs.
fn agree(differ: impl Fn(&Pair) -> Vec<String>) {
    let said = |pair: &Pair| differ(pair).into_iter().map(|what| format!("{}: {what}", pair.name)).collect();
    let found: Vec<Vec<String>> = pairs().iter().map(said).collect();
    let found = found.concat();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

const SIDES: [Side; 2] = [Side::Front, Side::Back];

#[test]
fn copper_is_that_of_the_plots() {
    agree(|pair| {
        let mut found = Vec::new();
        for side in SIDES.into_iter().filter(|&side| pair.plotted.copper(side).is_some()) {
            let (ours, plotted) = (islands(&pair.ours.board, side, pair), islands(&pair.plotted, side, pair));
            let differ = differences(&ours, &plotted, pair.within);
            found.extend(differ.into_iter().map(|what| format!("{side}: {what}")));
        }
        found
    });
}

/// What letters and other drawings that conduct nothing cover on a side, at most.
fn drawn(board: &Board, side: Side) -> Option<Rect> {
    let copper = board.copper(side)?;
    let function = |feature: &Feature| copper.attributes_of(feature).function.clone();
    let is_drawn = |feature: &&Feature| function(feature).as_deref() == Some("NonConductor");
    copper.features.iter().filter(is_drawn).map(|feature| feature.shape.bounds()).reduce(Rect::union)
}

#[test]
fn letters_lie_where_those_of_the_plots_do() {
    let mut seen = 0;
    for pair in pairs().iter().filter(|pair| pair.lettered) {
        for side in SIDES {
            let (Some(ours), Some(plotted)) = (drawn(&pair.ours.board, side), drawn(&pair.plotted, side))
            else {
                continue;
            };
            seen += 1;
            // A fifth of the height of the largest letters there, 2.3 mm.
            let off = [ours.min() - plotted.min(), ours.max() - plotted.max()];
            let most = off.iter().flat_map(|way| [way.x.abs(), way.y.abs()]).max().expect("four");
            assert!(most < Nm::from_um(460), "{} {side}: {ours:?} and not {plotted:?}", pair.name);
        }
    }
    assert!(seen == 0 || seen >= 3, "both sides of one, one of the other: {seen}");
}

/// A board with a square of copper and what `more` says.
fn lettered(more: &str) -> Loaded {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("board.kicad_pcb");
    let text = format!(
        "(kicad_pcb (version 20221018) (generator test)
          (gr_rect (start 0 0) (end 40 30) (stroke (width 0.1)) (fill none) (layer \"Edge.Cuts\"))
          (gr_rect (start 30 20) (end 38 28) (stroke (width 0)) (fill solid) (layer \"F.Cu\")) {more})"
    );
    std::fs::write(&path, text).expect("written");
    load(&path)
}

/// The letters that `more` draws on `side`: their bounds in mm, left, low, right, high.
fn letters(loaded: &Loaded, side: Side) -> Option<[f64; 4]> {
    let copper = loaded.board.copper(side)?;
    let strokes = copper.features.iter().filter(|feature| !matches!(feature.axis, Axis::Region));
    let bounds = strokes.map(|feature| feature.shape.bounds()).reduce(Rect::union)?;
    let (low, high) = (bounds.min(), bounds.max());
    Some([low.x, low.y, high.x, high.y].map(Nm::to_mm))
}

fn assert_about(found: Option<[f64; 4]>, expected: [f64; 4], what: &str) {
    let found = found.unwrap_or_else(|| panic!("{what}: nothing is drawn"));
    let near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.01);
    assert!(near, "{what}: {found:?} and not {expected:?}");
}

#[test]
fn texts_are_set_as_the_file_says() {
    let text = |said: &str, at: &str, layer: &str, more: &str| {
        let font = "(font (size 2 2) (thickness 0.2))";
        lettered(&format!("(gr_text \"{said}\" (at {at}) (layer \"{layer}\") (effects {font} {more}))"))
    };
    // An H is half as wide as high; a pen of 0.2 mm lies half outside.
    let front = |loaded: Loaded| letters(&loaded, Side::Front);
    assert_about(front(text("H", "10 10", "F.Cu", "")), [9.4, -11.0, 10.6, -8.8], "about its middle");
    let left = "(justify left bottom)";
    assert_about(front(text("H", "10 10", "F.Cu", left)), [9.9, -10.0, 11.1, -7.8], "left, on its line");
    assert_about(front(text("H", "10 10 90", "F.Cu", left)), [7.8, -10.1, 10.0, -8.9], "turned to the left");
    let right = "(justify right top)";
    assert_about(front(text("H", "10 10", "F.Cu", right)), [8.9, -12.0, 10.1, -9.8], "right, under its top");
    // A second line 1.62 heights lower, three eighths between two letters.
    assert_about(front(text("H\\nHH", "10 10", "F.Cu", left)), [9.9, -10.0, 12.85, -4.56], "two lines");
    let mirrored = text("H", "10 10", "B.Cu", "(justify left bottom mirror)");
    assert_about(letters(&mirrored, Side::Back), [8.9, -10.0, 10.1, -7.8], "read from behind");
    assert_about(front(text("~{H}", "10 10", "F.Cu", left)), [9.525, -10.0, 11.475, -7.2], "a bar above");
}

#[test]
fn texts_of_footprints_are_upright_and_say_what_they_refer_to() {
    let turned = |angle: &str| {
        let loaded = lettered(&format!(
            "(footprint \"x\" (layer \"F.Cu\") (at 10 10 180)
               (property \"Reference\" \"H\" (at 0 0) (layer \"F.SilkS\"))
               (fp_text user \"${{REFERENCE}}\" (at -3 0 {angle}) (layer \"F.Cu\")
                 (effects (font (size 2 2) (thickness 0.2)) (justify left))))"
        ));
        letters(&loaded, Side::Front)
    };
    assert_about(turned("0"), [12.9, -11.0, 14.1, -8.8], "beside the footprint, which is turned");
    assert_about(turned("180"), [12.9, -11.0, 14.1, -8.8], "never on its head");
    assert_about(turned("180 unlocked"), [11.9, -11.2, 13.1, -9.0], "but where it may");
    assert_about(turned("unlocked"), turned("0").expect("letters"), "and where it may but is not turned");
}

#[test]
fn letters_keep_clear_of_copper_and_what_is_not_drawn_is_said() {
    let font = "(effects (font (size 2 2) (thickness 0.2)))";
    let text = |said: &str, at: &str, layer: &str, more: &str| {
        let loaded = lettered(&format!("(gr_text \"{said}\" (at {at}) (layer {layer}) {font} {more})"));
        let said: Vec<_> = loaded.warnings.iter().map(|warning| warning.message.clone()).collect();
        (letters(&loaded, Side::Front), said)
    };
    // The square begins at x = 30; the second H ends at 29.575 and at 29.875 mm.
    assert_eq!(text("HH", "28.1 24", "\"F.Cu\"", "").1, Vec::<String>::new(), "clear");
    let (drawn, said) = text("HH", "28.4 24", "\"F.Cu\"", "");
    assert_about(drawn, [26.925, -25.0, 28.125, -22.8], "the first letter alone");
    let near = "1 letter is left out of the text `HH` on F.Cu: within 0.2 mm of other copper";
    assert_eq!(said, [near]);
    let (drawn, said) = text("HHH", "34 24", "\"F.Cu\"", "");
    assert_eq!((drawn, said.len()), (None, 1), "inside copper there is nothing to see");
    let (drawn, said) = text("HжH", "10 10", "\"F.Cu\"", "");
    assert_about(drawn, [8.525, -11.0, 11.475, -8.8], "what there is");
    assert_eq!(said, ["the text `HжH` on F.Cu is drawn without `ж`"]);
    let (drawn, said) = text("H", "10 10", "\"F.Cu\" knockout", "");
    assert_eq!((drawn, said), (None, vec!["the text `H` on F.Cu is not read".to_owned()]));
    let (drawn, said) = text("${ISSUE_DATE}", "10 10", "\"F.Cu\"", "");
    assert_eq!((drawn, said), (None, vec!["the text `${ISSUE_DATE}` on F.Cu is not read".to_owned()]));
}

#[test]
fn the_edge_is_that_of_the_plots() {
    let edge = |board: &Board| -> Vec<Polygon> {
        board.outline.iter().map(|outline| outline.polygon(FLATTEN)).collect()
    };
    agree(|pair| {
        // Marks for drilling, plotted with the edge, make one board's edge another one.
        if pair.ours.warnings.iter().any(|warning| warning.message.contains("targets")) {
            return Vec::new();
        }
        differences(&edge(&pair.ours.board), &edge(&pair.plotted), pair.within)
    });
}

/// A hole by place, size and whether it is a slot.
type Place = (Nm, Nm, Nm, bool);

#[test]
fn holes_are_those_of_the_drill_files() {
    let places = |board: &Board| -> Vec<Place> {
        let place = |hole: &Hole| {
            let (low, high) = (hole.bounds().min(), hole.bounds().max());
            (low.x + high.x, low.y + high.y, hole.diameter, hole.is_slot())
        };
        board.holes.iter().map(place).collect()
    };
    // What an inch of four decimals rounds, doubled as the sums above are.
    let near = |a: Nm, b: Nm| (a - b).abs() <= Nm::from_um(6);
    let same = |a: &Place, b: &Place| near(a.0, b.0) && near(a.1, b.1) && near(a.2, b.2) && a.3 == b.3;
    agree(|pair| {
        let (ours, plotted) = (places(&pair.ours.board), places(&pair.plotted));
        let lacking = |holes: &[Place], others: &[Place], whose: &str| -> Vec<String> {
            let lacks = |hole: &&Place| !others.iter().any(|other| same(hole, other));
            holes.iter().filter(lacks).map(|hole| format!("{hole:?} is drilled {whose} alone")).collect()
        };
        [lacking(&ours, &plotted, "here"), lacking(&plotted, &ours, "there")].concat()
    });
}

#[test]
fn nets_have_the_names_of_the_plots() {
    let names = |board: &Board, side: Side| -> BTreeSet<String> {
        let copper = board.copper(side);
        copper.iter().flat_map(|copper| &copper.attributes).filter_map(|set| set.net.clone()).collect()
    };
    agree(|pair| {
        let mut found = Vec::new();
        for side in SIDES {
            let (ours, plotted) = (names(&pair.ours.board, side), names(&pair.plotted, side));
            if !plotted.is_empty() && ours != plotted {
                found.push(format!("{side}: {ours:?} and not {plotted:?}"));
            }
        }
        found
    });
}

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name)
}

/// What of the copper on `side` the pin `pin` or the function `function` covers, in mm².
fn covers(board: &Board, side: Side, is_wanted: impl Fn(&voromill::board::Attributes) -> bool) -> f64 {
    let copper = board.copper(side).expect("copper");
    let wanted = copper.features.iter().filter(|feature| is_wanted(copper.attributes_of(feature)));
    let shapes: Vec<Polygon> = wanted.filter_map(|feature| feature.shape.polygon(Nm::new(10))).collect();
    area(&polarity::union(&shapes))
}

#[test]
fn every_shape_covers_what_geometry_says() {
    use std::f64::consts::PI;
    let board = load(&fixture("kicad/shapes.kicad_pcb")).board;
    let square = 1.0 - PI / 4.0;
    let pins = [
        ("1", Side::Front, PI),
        ("2", Side::Front, 2.0),
        ("3", Side::Front, 2.0 + PI / 4.0),
        ("4", Side::Front, 2.0 - 4.0 * square * 0.25 * 0.25),
        ("5", Side::Front, 2.0 - 2.0 * 0.5 * 0.5 / 2.0),
        ("6", Side::Front, 2.0),
        // A square, a rectangle beside it, and a line from its other side with a round end.
        ("7", Side::Front, 1.0 + 2.0 + 0.2 * 1.5 + PI * 0.1 * 0.1 / 2.0),
        ("8", Side::Front, 0.4 * 1.6 + PI * 0.8 * 0.8),
        ("8", Side::Back, 0.4 * 1.6 + PI * 0.8 * 0.8),
        ("9", Side::Front, PI),
        ("9", Side::Back, 2.25),
    ];
    for (pin, side, expected) in pins {
        let found = covers(&board, side, |set| {
            set.component.as_deref() == Some("U1") && set.pin.as_deref() == Some(pin)
        });
        assert!((found - expected).abs() < 5e-4, "pin {pin} on the {side}: {found} and not {expected}");
    }
    let function = |side, name: &str| covers(&board, side, |set| set.function.as_deref() == Some(name));
    let found = function(Side::Front, "Conductor");
    let length = 10.0 + 3.0 * PI / 2.0;
    let expected = 0.4 * length + PI * 0.2 * 0.2;
    assert!((found - expected).abs() < 2e-4, "tracks: {found} and not {expected}");
    let found = function(Side::Front, "ViaPad");
    assert!((found - 2.0 * PI * 0.16).abs() < 2e-4, "both vias on the front: {found}");
    let found = function(Side::Back, "ViaPad");
    assert!((found - PI * 0.16).abs() < 2e-4, "one of them on the back: {found}");
    let found = function(Side::Back, "Conductor");
    assert!((found - (80.0 - 16.0)).abs() < 1e-9, "an area with a hole: {found}");
    let found = function(Side::Front, "NonConductor");
    let expected = 2.0 * PI * 0.2 + PI * 1.1 * 1.1;
    assert!((found - expected).abs() < 2e-4, "a ring and a disc: {found} and not {expected}");
}

#[test]
fn pads_lie_where_their_footprint_is_turned_to() {
    let board = load(&fixture("kicad/shapes.kicad_pcb")).board;
    let copper = board.front.as_ref().expect("copper");
    let at = |pin: &str| {
        let of_pin = |feature: &&Feature| copper.attributes_of(feature).pin.as_deref() == Some(pin);
        let bounds = copper.features.iter().find(of_pin).expect("a pad").shape.bounds();
        (bounds.min().midpoint(bounds.max()), bounds.width())
    };
    // The file's origin is its auxiliary one, 100 mm to the right and 130 mm down.
    let point = |x: i64, y: i64| voromill::geometry::Point::new(Nm::from_um(x), Nm::from_um(y));
    assert_eq!(at("1"), (point(10_000, 15_000), Nm::from_mm(2)), "the origin of the footprint");
    assert_eq!(
        at("2"),
        (point(10_000, 20_000), Nm::from_mm(1)),
        "what was to the right is above, and turned"
    );
    assert_eq!(at("4"), (point(15_000, 15_000), Nm::from_mm(1)), "what was below is to the right");
}

/// On the layer of the edge a circle is its rim, filled or without a width.
#[test]
fn a_circle_of_the_edge_is_an_edge() {
    let folder = tempfile::tempdir().expect("a folder");
    for (version, pen) in
        [(20_171_130, "(width 0)"), (20_240_108, "(stroke (width 0.1) (type solid)) (fill solid)")]
    {
        let text = format!(
            "(kicad_pcb (version {version}) (generator pcbnew) (general (thickness 1.6)) \
             (layers (0 F.Cu signal) (31 B.Cu signal) (44 Edge.Cuts user)) (net 0 \"\") \
             (gr_circle (center 50 50) (end 70 50) (layer Edge.Cuts) {pen}) \
             (segment (start 40 50) (end 60 50) (width 0.5) (layer F.Cu) (net 0)))"
        );
        let file = folder.path().join("round.kicad_pcb");
        std::fs::write(&file, text).expect("written");
        let outline = load(&file).board.outline.expect("an outline");
        let around = outline.polygon(Nm::from_um(1)).bounds();
        assert_eq!([around.width(), around.height()], [Nm::from_mm(40); 2], "{version}");
    }
}

#[test]
fn an_area_that_crosses_itself_all_over_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let far = |i: u64, by: u64| f64::from(u32::try_from(i * i * by % 99_991).expect("small")) / 1e3;
    let corners: String = (0..6000).map(|i| format!("(xy {} {})", far(i, 7_919), far(i, 104_729))).collect();
    let text = format!(
        "(kicad_pcb (version 20221018) (generator pcbnew) (general (thickness 1.6)) \
         (layers (0 F.Cu signal) (31 B.Cu signal) (44 Edge.Cuts user)) (net 0 \"\") \
         (gr_poly (pts {corners}) (stroke (width 0) (type solid)) (fill solid) (layer F.Cu)))"
    );
    let file = folder.path().join("tangled.kicad_pcb");
    std::fs::write(&file, text).expect("written");
    let error = import::load(&[file], &Selection::default()).expect_err("tangled").to_string();
    assert!(error.contains("this area crosses itself too often"), "{error}");
}

#[test]
fn edge_holes_and_thickness_are_read() {
    let loaded = load(&fixture("kicad/shapes.kicad_pcb"));
    let board = &loaded.board;
    assert_eq!(board.thickness, Some(Nm::from_um(800)), "as the board says");
    let outline = board.outline.as_ref().expect("an edge");
    let corner = 25.0 * (1.0 - std::f64::consts::FRAC_PI_4);
    let expected = 1200.0 - corner - 4.0 * std::f64::consts::PI - 12.0;
    let found = outline.polygon(Nm::new(10)).area_mm2();
    assert!((found - expected).abs() < 1e-2, "a round corner, a round and a square cut-out: {found}");
    assert_eq!(outline.contours().len(), 3, "the edge and two cut-outs");
    let mut holes: Vec<_> =
        board.holes.iter().map(|hole| (hole.diameter, hole.is_slot(), hole.plating)).collect();
    holes.sort_by_key(|hole| hole.0);
    let um = Nm::from_um;
    let expected = [
        (um(400), false, Plating::Plated),
        (um(800), true, Plating::Plated),
        (um(1000), false, Plating::Plated),
        (um(1200), false, Plating::NonPlated),
    ];
    assert_eq!(holes, expected, "a via, a slot, a pad and a hole that is not plated; no blind via");
}

#[test]
fn what_is_not_read_is_said() {
    let loaded = load(&fixture("kicad/shapes.kicad_pcb"));
    let said: Vec<_> =
        loaded.warnings.iter().map(|warning| (warning.code(), warning.message.as_str())).collect();
    let expected = [
        ("kicad-text", "the text `REV 1` on F.Cu is not read"),
        ("kicad-not-read", "dimensions (dimension) on copper or Edge.Cuts are not read"),
        (
            "kicad-blind-via",
            "a via that ends on an inner layer gets no hole, since inner layers are not milled",
        ),
    ];
    assert_eq!(said, expected, "and nothing else");
    assert!(loaded.warnings.iter().all(|warning| warning.source.is_some()), "each with its line");
}

#[test]
fn zones_that_are_not_filled_are_an_error_that_says_how_to_fill_them() {
    let board = fixture("boards/regulator/regulator.kicad_pcb");
    let error = import::load(&[board], &Selection::default()).expect_err("not filled").render();
    assert!(error.contains("the zone of net GND on F.Cu is not filled, and 1 more"), "{error}");
    assert!(error.contains("press B") && error.contains("regulator.kicad_pcb:539:3"), "{error}");
}

#[test]
fn a_folder_of_layers_stays_one_and_a_folder_without_is_read_from_its_board() {
    let plotted = load(&fixture("boards/blinker"));
    assert!(plotted.ignored.contains(&"blinker.kicad_pcb".to_owned()), "it lies beside the layers");
    assert_eq!(plotted.board.copper(Side::Front).map(|_| ()), None, "which have no front");
    let folder = tempfile::tempdir().expect("a folder");
    let project = folder.path().join("amp");
    std::fs::create_dir_all(project.join("gerbers")).expect("folders");
    std::fs::copy(fixture("boards/blinker/blinker.kicad_pcb"), project.join("amp.kicad_pcb"))
        .expect("copied");
    for (name, text) in [
        ("amp.kicad_pro", "{}"),
        ("amp.kicad_sch", "(kicad_sch (version 20211123))"),
        ("fp-lib-table", "(fp_lib_table (lib (name \"x\")))"),
        ("_autosave-amp.kicad_pcb", "(kicad_pcb)"),
    ] {
        std::fs::write(project.join(name), text).expect("written");
    }
    let loaded = load(&project);
    assert_eq!(loaded.board.name, "amp", "named after its file");
    assert!(loaded.sources.iter().all(|source| source.file == "amp.kicad_pcb"), "nothing else is read");
    assert!(loaded.board.back.is_some() && loaded.board.holes.len() == 47, "all of it");
    std::fs::copy(project.join("amp.kicad_pcb"), project.join("other.kicad_pcb")).expect("copied");
    let error = import::load(&[project], &Selection::default()).expect_err("two boards").to_string();
    assert!(error.contains("amp.kicad_pcb") && error.contains("other.kicad_pcb"), "{error}");
}

#[test]
fn a_layer_of_a_board_can_be_left_aside_and_none_can_be_added() {
    let board = fixture("boards/blinker/blinker.kicad_pcb");
    let skip = vec![PathBuf::from("F.Cu")];
    let loaded = import::load(std::slice::from_ref(&board), &Selection { skip, ..Selection::default() })
        .expect("read");
    assert!(loaded.board.front.is_none() && loaded.board.back.is_some(), "the back alone");
    let roles: Vec<&str> = loaded.sources.iter().map(|source| source.role.as_str()).collect();
    assert_eq!(roles, ["ignored (front copper)", "back-copper", "outline", "drill"], "it is listed");
    let layer = fixture("boards/blinker/blinker-B_Cu.gbr");
    let error = import::load(&[board.clone(), layer.clone()], &Selection::default()).expect_err("two");
    assert!(error.to_string().contains("give the board alone"), "{error}");
    let back = Selection { back: Some(layer), ..Selection::default() };
    let error = import::load(&[board], &back).expect_err("two backs");
    assert!(error.to_string().contains("give the board alone"), "{error}");
}

/// The copper that a board of `version` with `things` on it has on the front and on the back, in
/// mm².
fn copper_of(version: u32, layers: [&str; 2], things: &str) -> [f64; 2] {
    let [front, back] = layers;
    let text = format!(
        "(kicad_pcb (version {version}) (layers (0 {front} signal) (31 {back} signal) (44 Edge.Cuts user))\n\
         (net 0 \"\") (net 1 A) (net 2 B)\n{things}\n)"
    );
    let layout =
        import::kicad::read("x.kicad_pcb", text.as_bytes()).unwrap_or_else(|e| panic!("{}", e.render()));
    [layout.front, layout.back].map(|image| {
        let shapes = image.features.iter().filter_map(|feature| feature.shape.polygon(Nm::new(10)));
        area(&polarity::union(&shapes.collect::<Vec<_>>()))
    })
}

const CANONICAL: [&str; 2] = ["F.Cu", "B.Cu"];

/// Whether areas are those that were expected, within 0.001 mm².
fn near(found: [f64; 2], expected: [f64; 2]) -> bool {
    found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3)
}

#[test]
fn layers_are_known_by_number_where_a_person_named_them() {
    let things = "(gr_poly (pts (xy 0 0) (xy 2 0) (xy 2 1) (xy 0 1)) (layer Top) (width 0))
        (gr_poly (pts (xy 0 0) (xy 3 0) (xy 3 1) (xy 0 1)) (layer \"Solder side\") (width 0))";
    let found = copper_of(20_171_130, ["Top", "\"Solder side\""], things);
    assert!(near(found, [2.0, 3.0]), "KiCad 5: {found:?}");
    let things = "(gr_poly (pts (xy 0 0) (xy 2 0) (xy 2 1) (xy 0 1)) (layer F.Cu) (width 0))";
    let found = copper_of(20_211_014, ["F.Cu", "B.Cu"], things);
    assert!(near(found, [2.0, 0.0]), "KiCad 6 keeps its own names: {found:?}");
}

#[test]
fn rectangles_of_kicad_10_have_round_corners() {
    let rect = |angle: u32, radius: u32, more: &str| {
        let rect = format!("(start 8 6) (end -2 2) {more} (radius {radius}) (layer F.Cu)");
        let things = format!("(footprint x (layer F.Cu) (at 20 20 {angle}) (fp_rect {rect}))");
        copper_of(20_260_206, CANONICAL, &things)[0]
    };
    let pi = std::f64::consts::PI;
    let solid = "(stroke (width 0)) (fill yes)";
    for angle in [0, 90, 33] {
        assert!((rect(angle, 1, solid) - (40.0 - (4.0 - pi))).abs() < 4e-3, "turned by {angle}");
        let pen = rect(angle, 1, "(stroke (width 0.2)) (fill no)");
        assert!(
            (pen - 0.2 * (2.0 * (8.0 + 2.0) + 2.0 * pi)).abs() < 1e-3,
            "its line, turned by {angle}: {pen}"
        );
    }
    assert!((rect(0, 9, solid) - (6.0 * 4.0 + 4.0 * pi)).abs() < 4e-3, "no more than half its height");
    let text = "(kicad_pcb (version 20260206) (layers (0 F.Cu signal) (2 B.Cu signal) (25 Edge.Cuts user))
        (gr_rect (start 10 10) (end 50 40) (radius 5) (stroke (width 0.05)) (fill no) (layer Edge.Cuts))
        (footprint x (layer F.Cu) (at 20 20) (pad 1 smd rect (at 0 0) (size 2 1) (layers F.Cu) (net GND)))
        (segment (start 20 20) (end 30 20) (width 0.3) (layer F.Cu) (net GND)))";
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("ten.kicad_pcb");
    std::fs::write(&path, text).expect("written");
    let loaded = load(&path);
    let outline = loaded.board.outline.as_ref().expect("an edge");
    let around = area(&[outline.polygon(Nm::new(100))]);
    assert!((around - (1200.0 - 25.0 * (4.0 - pi))).abs() < 1e-2, "the board itself: {around}");
    let copper = loaded.board.copper(Side::Front).expect("copper");
    let names =
        copper.features.iter().map(|feature| copper.attributes[feature.attributes as usize].net.as_deref());
    assert_eq!(names.collect::<Vec<_>>(), [Some("GND"), Some("GND")], "nets by their names");
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
}

#[test]
fn old_zones_are_drawn_round_with_a_pen_and_new_ones_are_not() {
    let zone = |more: &str| {
        format!(
            "(zone (net 1) (net_name A) (layer F.Cu) (min_thickness 0.2) {more} (fill yes)
            (filled_polygon (pts (xy 0 0) (xy 10 0) (xy 10 10) (xy 0 10))))"
        )
    };
    let grown = 100.0 + 4.0 * 10.0 * 0.1 + std::f64::consts::PI * 0.01;
    let cases = [
        (20_171_130, "", grown),
        (20_211_014, "", grown),
        (20_211_014, "(filled_areas_thickness no)", 100.0),
        (20_221_018, "", 100.0),
    ];
    for (version, more, expected) in cases {
        let [found, _] = copper_of(version, CANONICAL, &zone(more));
        assert!((found - expected).abs() < 1e-3, "{version} {more}: {found} and not {expected}");
    }
}

#[test]
fn rings_that_nothing_meets_can_be_left_out() {
    let via = |more: &str| {
        format!("(via (at 5 5) (size 2) (drill 1) (layers F.Cu B.Cu) (remove_unused_layers) {more} (net 1))")
    };
    let track = |net: u32, layer: &str| {
        format!("(segment (start 5 5) (end 5.5 5) (width 0.1) (layer {layer}) (net {net}))")
    };
    let disc = std::f64::consts::PI;
    let pad = |shape: &str, x: &str| {
        format!(
            "(footprint X (layer F.Cu) (at {x} 5) (pad 1 smd {shape} (at 0 0) (size 0.6 0.4) (layers F.Cu) (net 1 A)))"
        )
    };
    let through = |x: [&str; 2], y: &str| {
        format!("(segment (start {} {y}) (end {} {y}) (width 0.1) (layer F.Cu) (net 1))", x[0], x[1])
    };
    let curve = "(arc (start 3 5) (mid 5 5.02) (end 7 5) (width 0.1) (layer F.Cu) (net 1))";
    // A millimetre long, with its ends; as much of one of four lies outside the ring, twice.
    let aside = 0.1 + std::f64::consts::PI * 0.0025;
    let passed = disc + aside + 0.1;
    let cases = [
        (via(""), [0.0, 0.0], "nothing meets it"),
        (via("") + &through(["3", "7"], "5"), [passed, 0.0], "a track passes through"),
        (via("") + curve, [passed, 0.0], "an arc does"),
        (
            via("") + &through(["4.5", "5.5"], "5.7"),
            [aside, 0.0],
            "a track beside the hole, as KiCad plots it",
        ),
        (via("") + &pad("circle", "5"), [disc, 0.0], "a round pad on it"),
        (via("") + &pad("oval", "5.6"), [disc, 0.0], "an oval one that reaches the hole"),
        (via("") + &pad("rect", "5.6"), [disc, 0.0], "a rectangle that does"),
        (via("(keep_end_layers)"), [disc, disc], "the outer ones are kept"),
        (via("") + &track(1, "B.Cu"), [0.0, disc], "a track on the back"),
        (via("(zone_layer_connections \"F.Cu\")"), [disc, 0.0], "a zone, as the board says"),
        (
            via("")
                + "(zone (net 1) (layer F.Cu) (fill yes) (filled_polygon (layer F.Cu) (pts (xy 0 0) (xy 9 0) (xy 9 9) (xy 0 9))))",
            [81.0, 0.0],
            "a zone round it",
        ),
    ];
    for (things, expected, what) in cases {
        let found = copper_of(20_241_229, CANONICAL, &things);
        assert!(near(found, expected), "{what}: {found:?} and not {expected:?}");
    }
}

#[test]
fn outlines_of_letters_are_copper() {
    let text = "(gr_text \"o\" (at 5 5) (layer F.Cu) (effects (font (face \"Sans\") (size 1 1)))
        (render_cache \"o\" 0 (polygon (pts (xy 0 0) (xy 4 0) (xy 4 4) (xy 0 4)) (pts (xy 1 1) (xy 3 1) (xy 3 3) (xy 1 3)))))";
    let found = copper_of(20_221_018, CANONICAL, text);
    assert!(near(found, [12.0, 0.0]), "a ring: {found:?}");
}

#[test]
fn what_is_wrong_is_shown_with_its_line() {
    let cases = [
        (
            "(kicad_pcb (segment (start 0 0) (end x 0) (width 1) (layer F.Cu)))",
            "`(end …)` has no number here",
        ),
        ("(kicad_pcb\n (via (at 0 0) (layers F.Cu B.Cu)))", "`(via …)` is incomplete"),
        ("(kicad_pcb (gr_line (start 0 0) (end 9999 0) (layer F.Cu)))", "has no number here"),
        (
            "(kicad_pcb (footprint x (at 0 0) (pad 1 smd star (at 0 0) (size 1 1) (layers F.Cu))))",
            "unknown shape",
        ),
        ("(kicad_pcb (general", "has no end"),
        ("(kicad_sch)", "not a KiCad board"),
    ];
    for (text, words) in cases {
        let error = import::kicad::read("x.kicad_pcb", text.as_bytes()).expect_err(text).render();
        assert!(error.contains(words) && error.contains("x.kicad_pcb:"), "{text}: {error}");
    }
}

fn voromill(arguments: &[&str]) -> std::process::Output {
    let program = env!("CARGO_BIN_EXE_voromill");
    std::process::Command::new(program).args(arguments).output().expect("it runs")
}

#[test]
fn a_board_is_milled_and_verified_by_itself_with_its_thickness() {
    let out = tempfile::tempdir().expect("a folder");
    let out = out.path().to_str().expect("a plain name");
    let board = fixture("kicad/shapes.kicad_pcb");
    let board = board.to_str().expect("a plain name");
    let milled = voromill(&["mill", board, "-o", out, "--no-html"]);
    assert!(milled.status.success(), "{}", String::from_utf8_lossy(&milled.stderr));
    let program = std::fs::read_to_string(Path::new(out).join("shapes-front.ngc")).expect("a program");
    assert_eq!(program.matches("(from shapes.kicad_pcb design ").count(), 1, "one file is said once");
    assert!(program.contains("(thickness 0.8mm)"), "as thick as the board says");
    let verified = voromill(&["verify", out, "--board", board]);
    let said = String::from_utf8_lossy(&verified.stdout).into_owned();
    assert!(verified.status.success(), "{said}");
    assert!(!said.contains("[revision]"), "made from the same board: {said}");
    let told = voromill(&["mill", board, "-o", out, "--no-html", "--no-verify", "--thickness", "1mm"]);
    assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
    let program = std::fs::read_to_string(Path::new(out).join("shapes-front.ngc")).expect("a program");
    assert!(program.contains("(thickness 1mm)") || program.contains("(thickness 1.0mm)"), "as given");
}
