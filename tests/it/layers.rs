//! Which file is what, and boards put together from folders, archives and single files.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use voromill::board::{Hole, Plating, Side};
use voromill::geometry::{Nm, Point};
use voromill::import::{Loaded, Selection, load, load_copper, survey};

use crate::corpus::board_folders;

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).expect("readable")).expect("JSON")
}

/// The board in a folder; where nothing but `meta.json` tells which side a layer is, as that has
/// it.
fn board(path: &Path) -> Loaded {
    let loaded = load(&[path.to_owned()], &Selection::default()).or_else(|error| {
        if !error.to_string().contains("the side of this copper layer is unknown") {
            return Err(error);
        }
        let front = json(&path.join("meta.json"))["layers"]["front"].as_str().map(|name| path.join(name));
        load(&[path.to_owned()], &Selection { front, ..Selection::default() })
    });
    loaded.unwrap_or_else(|e| panic!("{}:\n{}", path.display(), e.render()))
}

pub(crate) fn files_of(loaded: &Loaded, role: &str) -> Vec<String> {
    loaded.sources.iter().filter(|source| source.role == role).map(|source| source.file.clone()).collect()
}

fn names(value: &Value) -> Vec<String> {
    match value {
        Value::String(name) => vec![name.clone()],
        Value::Array(names) => names.iter().filter_map(Value::as_str).map(str::to_owned).collect(),
        _ => vec![],
    }
}

#[test]
fn every_board_loads_with_its_roles() {
    for path in board_folders() {
        let loaded = board(&path);
        let layers = &json(&path.join("meta.json"))["layers"];
        for (role, key) in
            [("front-copper", "front"), ("back-copper", "back"), ("outline", "outline"), ("drill", "drill")]
        {
            let (mut found, mut expected) = (files_of(&loaded, role), names(&layers[key]));
            found.sort();
            expected.sort();
            assert_eq!(found, expected, "{}: {role}", path.display());
        }
    }
}

#[test]
fn every_outline_encloses_the_area_that_it_should() {
    for path in board_folders() {
        let truth = &json(&path.join("truth_nets.json"))["outline"];
        let (Some(area), Some(grid)) =
            (truth["board_area_mm2"].as_f64(), truth["closes_at_grid_mm"].as_f64())
        else {
            continue;
        };
        let loaded = board(&path);
        let outline = loaded.board.outline.unwrap_or_else(|| panic!("{}: no outline", path.display()));
        let largest = outline.contours().iter().map(|contour| area_of(contour).abs()).fold(0.0, f64::max);
        let perimeter = truth["board_perimeter_mm"].as_f64().expect("a perimeter");
        let allowed = grid * perimeter;
        assert!((largest - area).abs() <= allowed, "{}: {largest} mm², {area} expected", path.display());
        let bounds = outline.bounds();
        let corners = [(bounds.min(), 0), (bounds.max(), 2)];
        for (corner, index) in corners {
            let list = truth["board_bbox_mm"].as_array().expect("a box");
            let (x, y) = (list[index].as_f64().expect("x"), list[index + 1].as_f64().expect("y"));
            let off = (corner.x.to_mm() - x).abs().max((corner.y.to_mm() - y).abs());
            assert!(off <= grid, "{}: the corner {corner:?} is off by {off} mm", path.display());
        }
    }
}

fn area_of(contour: &voromill::geometry::Path) -> f64 {
    let mut points = contour.flatten(Nm::new(250));
    points.pop();
    voromill::geometry::Polygon::new(vec![points]).map_or(0.0, |polygon| polygon.area_mm2())
}

/// Millimetres of a truth file, to the micrometre that it is rounded to.
fn point(value: &Value) -> Point {
    let nm = |v: &Value| Nm::from_f64(v.as_f64().expect("a number") * 1e6);
    Point::new(nm(&value[0]), nm(&value[1]))
}

fn near(a: Point, b: Point) -> bool {
    const ROUNDED: Nm = Nm::from_um(1);
    (a.x - b.x).abs() <= ROUNDED && (a.y - b.y).abs() <= ROUNDED
}

fn has_size(hole: &Hole, size: &Value) -> bool {
    let size = Nm::from_f64(size.as_f64().expect("a diameter") * 1e6);
    (hole.diameter - size).abs() <= Nm::from_um(1)
}

#[test]
fn every_hole_of_every_board_is_read_with_its_size_and_place() {
    let (mut checked, mut slots) = (0, 0);
    for path in board_folders() {
        let truth = path.join("truth_drill.json");
        if !truth.is_file() {
            continue;
        }
        let truth = json(&truth);
        let holes = board(&path).board.holes;
        let mut expected = 0;
        for file in truth.as_array().expect("a list of files") {
            for tool in file["tools"].as_array().into_iter().flatten() {
                for place in tool["xy_mm"].as_array().expect("places").iter().map(point) {
                    let fits =
                        |hole: &&Hole| near(hole.path.start, place) && has_size(hole, &tool["diameter_mm"]);
                    let found = holes.iter().find(|hole| !hole.is_slot() && fits(hole));
                    assert!(found.is_some(), "{}: no hole at {place:?}", path.display());
                    expected += 1;
                }
            }
            let lists = [("slots_mm", "p"), ("routes_mm", "path")];
            for (slot, key) in lists
                .iter()
                .flat_map(|(l, k)| file[*l].as_array().into_iter().flatten().map(move |s| (s, *k)))
            {
                let ends = slot[key].as_array().expect("points");
                let (from, to) = (point(&ends[0]), point(&ends[ends.len() - 1]));
                let fits = |hole: &&Hole| {
                    near(hole.path.start, from)
                        && near(hole.path.end(), to)
                        && has_size(hole, &slot["diameter_mm"])
                };
                assert!(
                    holes.iter().any(|hole| hole.is_slot() && fits(&hole)),
                    "{}: no slot at {from:?}",
                    path.display()
                );
                expected += 1;
                slots += 1;
            }
        }
        assert!(holes.len() <= expected, "{}: {} holes, {expected} expected", path.display(), holes.len());
        checked += expected;
    }
    assert!(checked == 0 || slots > 0, "{checked} holes compared, but no slot");
}

/// A folder of small layers, each a square; what is drawn does not matter to who is what.
pub(crate) struct Folder(tempfile::TempDir);

pub(crate) const SQUARE: &str = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.2*%\nD10*\nX0Y0D02*\nX20000000Y0D01*\nX20000000Y20000000D01*\nX0Y20000000D01*\nX0Y0D01*\nM02*\n";
pub(crate) const DRILL: &str = "M48\nMETRIC\nT1C0.8\n%\nT1\nX5.0Y5.0\nM30\n";

impl Folder {
    pub(crate) fn with(files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("a folder")).expect("made");
            fs::write(path, text).expect("written");
        }
        Self(folder)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn load(&self, selection: &Selection) -> Result<Loaded, String> {
        load(&[self.0.path().to_owned()], selection).map_err(|error| error.to_string())
    }
}

fn function(value: &str) -> String {
    format!("%TF.FileFunction,{value}*%\n{SQUARE}")
}

#[test]
fn two_files_for_one_role_are_an_error_that_says_how_to_settle_it() {
    let folder =
        Folder::with(&[("amp.gtl", SQUARE), ("amp.cmp", &SQUARE.replace("0.2", "0.3")), ("amp.gbl", SQUARE)]);
    let error = folder.load(&Selection::default()).expect_err("two fronts");
    assert!(error.contains("amp.cmp, amp.gtl") && error.contains("--front"), "{error}");
    let chosen = Selection { front: Some(folder.path("amp.gtl")), ..Selection::default() };
    let loaded = folder.load(&chosen).expect("settled");
    assert_eq!(files_of(&loaded, "front-copper"), ["amp.gtl"], "as chosen");
    assert_eq!(loaded.board.name, "amp", "what all names share");
    let bare = Selection { front: Some(PathBuf::from("amp.cmp")), ..Selection::default() };
    assert_eq!(files_of(&folder.load(&bare).expect("settled"), "front-copper"), ["amp.cmp"], "by name alone");
}

#[test]
fn a_job_file_is_believed_before_functions_and_these_before_names() {
    let job = r#"{"GeneralSpecs": {"ProjectId": {"Name": "synth"}},
        "FilesAttributes": [{"Path": "a.gbr", "FileFunction": "Copper,L2,Bot"}]}"#;
    let (a, b, c) = (function("Copper,L1,Top"), function("Copper,L1,Top"), function("Profile,NP"));
    let folder = Folder::with(&[("x.gbrjob", job), ("a.gbr", &a), ("b-F_Mask.gbr", &b), ("c-F_Cu.gbr", &c)]);
    let loaded = folder.load(&Selection::default()).expect("a board");
    assert_eq!(files_of(&loaded, "back-copper"), ["a.gbr"], "by the job file");
    assert_eq!(files_of(&loaded, "front-copper"), ["b-F_Mask.gbr"], "by its function");
    assert_eq!(files_of(&loaded, "outline"), ["c-F_Cu.gbr"], "by its function");
    assert_eq!(loaded.board.name, "synth", "by the job file");
}

/// Only the back is mirrored: taken for the front, its mirror image is milled.
#[test]
fn copper_of_the_other_side_is_what_was_chosen_and_that_is_said() {
    let (front, back) = (function("Copper,L1,Top"), function("Copper,L2,Bot"));
    let plain = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,1*%\nD10*\nX0Y0D03*\nM02*\n";
    let files = [("a.gbr", &*front), ("b.gbr", &*back), ("amp-B_Cu.gbr", plain), ("amp.gtl", plain)];
    let folder = Folder::with(&files);
    let said = |selection: Selection| -> Vec<String> {
        let files = [&selection.front, &selection.back];
        let files: Vec<PathBuf> = files.into_iter().flatten().cloned().collect();
        let loaded = load(&files, &selection).expect("a board");
        let said = loaded.warnings.into_iter().filter(|warning| warning.code() == "other-layer-chosen");
        said.map(|warning| warning.message).collect()
    };
    let as_front = |name: &str| said(Selection { front: Some(folder.path(name)), ..Selection::default() });
    let as_back = |name: &str| said(Selection { back: Some(folder.path(name)), ..Selection::default() });
    for (right, wrong) in [(as_front("a.gbr"), as_back("a.gbr")), (as_back("b.gbr"), as_front("b.gbr"))] {
        assert_eq!((right.len(), wrong.len()), (0, 1), "by its function: {right:?} {wrong:?}");
    }
    assert_eq!((as_back("amp-B_Cu.gbr").len(), as_front("amp.gtl").len()), (0, 0), "by name");
    assert_eq!(as_back("amp.gtl").len(), 1, "by name");
    assert_eq!(
        as_front("amp-B_Cu.gbr"),
        [
            "amp-B_Cu.gbr is chosen as the front copper, but it is named like the back copper: unless it was drawn mirrored, \
             its mirror image is milled"
        ],
        "by name"
    );
}

/// Drilled through, they would join the sides.
#[test]
fn blind_and_buried_holes_are_left_out_and_that_is_said() {
    let (front, back) = (function("Copper,L1,Top"), function("Copper,L4,Bot"));
    let drill = |function: &str, x: u32| {
        format!("M48\n; #@! TF.FileFunction,{function}\nMETRIC\nT1C0.4\n%\nT1\nX{x}.0Y1.0\nM30\n")
    };
    let gerber = function("Plated,2,3,Buried,Drill");
    let (through, blind) = (drill("Plated,1,4,PTH", 5), drill("Plated,1,2,Blind", 7));
    let files = [
        ("a.gbr", &*front),
        ("b.gbr", &*back),
        ("a-PTH.drl", &*through),
        ("a-front-in1.drl", &*blind),
        ("a-in1-in2.gbr", &*gerber),
    ];
    let folder = Folder::with(&files);
    let all: Vec<PathBuf> = files.iter().map(|(name, _)| folder.path(name)).collect();
    let said = |loaded: &Loaded| -> Vec<String> {
        let said = loaded.warnings.iter().filter(|warning| warning.code() == "partial-holes");
        said.map(|warning| warning.message.clone()).collect()
    };
    let loaded = load(&all, &Selection::default()).expect("a board");
    assert_eq!(loaded.board.holes.len(), 1, "that through the board");
    let left = "has blind or buried holes to inner layers: they are not drilled";
    assert_eq!(said(&loaded), [format!("a-front-in1.drl {left}"), format!("a-in1-in2.gbr {left}")]);
    let chosen = Selection {
        drill: vec![folder.path("a-PTH.drl"), folder.path("a-front-in1.drl")],
        ..Selection::default()
    };
    let loaded = load(&all, &chosen).expect("a board");
    assert_eq!(loaded.board.holes.len(), 2, "a person chose them");
}

#[test]
fn a_layer_that_is_no_copper_is_what_was_chosen_and_that_is_said() {
    let mask = function("Soldermask,Top");
    let edge = function("Profile,NP");
    let front = function("Copper,L1,Top");
    let plain = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,1*%\nD10*\nX0Y0D03*\nM02*\n";
    let files = [
        ("a.gbr", &*mask),
        ("b.gbr", &*edge),
        ("c.gbr", &*front),
        ("amp-F_Paste.gbr", plain),
        ("amp-In1_Cu.gbr", plain),
    ];
    let folder = Folder::with(&files);
    let said = |front: &str, outline: Option<&str>| -> Vec<String> {
        let outline = outline.map(|name| folder.path(name));
        let selection = Selection { front: Some(folder.path(front)), outline, ..Selection::default() };
        let files: Vec<PathBuf> =
            [&selection.front, &selection.outline].into_iter().flatten().cloned().collect();
        let loaded = load(&files, &selection).expect("a board");
        let said = loaded.warnings.into_iter().filter(|warning| warning.code() == "other-layer-chosen");
        said.map(|warning| warning.message).collect()
    };
    let copper = "what it draws is taken for copper";
    for (name, says) in [
        ("a.gbr", "its .FileFunction declares the solder mask"),
        ("b.gbr", "its .FileFunction declares the outline"),
        ("amp-F_Paste.gbr", "it is named like the paste"),
    ] {
        assert_eq!(said(name, None), [format!("{name} is chosen as the front copper, but {says}: {copper}")]);
    }
    assert_eq!(said("amp-In1_Cu.gbr", None), [""; 0], "an inner layer is copper, too");
    assert_eq!(said("c.gbr", Some("b.gbr")), [""; 0]);
    assert_eq!(
        said("amp-In1_Cu.gbr", Some("c.gbr")),
        [
            "c.gbr is chosen as the outline, but its .FileFunction declares the front copper: the board is cut out along \
          its copper"
        ]
    );
}

#[test]
fn a_function_that_contradicts_a_name_of_any_layer_is_said() {
    let disputed = |loaded: &Loaded| -> Vec<String> {
        let of_code = loaded.warnings.iter().filter(|warning| warning.code() == "layer-disputed");
        of_code.map(|warning| warning.message.clone()).collect()
    };
    let (copper, mask, edge) =
        (function("Copper,L1,Top"), function("Soldermask,Top"), function("Profile,NP"));
    // Copper and mask in each other's file: the attribute is believed, and both are said.
    let files = [("amp-F_Cu.gbr", &*mask), ("amp-F_Mask.gbr", &*copper), ("amp-Edge_Cuts.gbr", &*edge)];
    let loaded = Folder::with(&files).load(&Selection::default()).expect("the attributes decide");
    assert_eq!(files_of(&loaded, "front-copper"), ["amp-F_Mask.gbr"], "by its function");
    assert_eq!(
        disputed(&loaded),
        [
            "amp-F_Cu.gbr is named like the front copper, but its .FileFunction declares solder mask, so it is not milled",
            "amp-F_Mask.gbr is named like solder mask, but its .FileFunction declares the front copper, so it is read as that",
        ],
        "both"
    );
    // An edge that calls itself a drawing would be lost in silence.
    let drawing = function("OtherDrawing,Comment");
    let loaded = Folder::with(&[("amp-F_Cu.gbr", &copper), ("amp-Edge_Cuts.gbr", &drawing)]);
    let loaded = loaded.load(&Selection::default()).expect("the attributes decide");
    assert!(disputed(&loaded)[0].starts_with("amp-Edge_Cuts.gbr is named like the outline"), "the edge");
    // Layers that are not milled: said where their sides differ, as files may have been mixed up.
    let below = function("Soldermask,Bot");
    let loaded = Folder::with(&[("amp-F_Cu.gbr", &copper), ("amp-F_Mask.gbr", &below)]);
    let loaded = loaded.load(&Selection::default()).expect("a mask is not milled");
    assert!(disputed(&loaded)[0].contains("a layer of the front"), "{:?}", disputed(&loaded));
    // No contradiction: a word that any layer may hold, drawings of holes, another kind of drawing.
    let (legend, map) = (function("Legend,Top"), function("Drillmap"));
    let fab = function("AssemblyDrawing,Top");
    let files = [
        ("amp-F_Cu.gbr", &*copper),
        ("amp-top.gbr", &*legend),
        ("amp-PTH-map.gbr", &*map),
        ("amp-F_Fab.gbr", &*fab),
    ];
    let loaded = Folder::with(&files).load(&Selection::default()).expect("a board");
    assert_eq!(disputed(&loaded), [""; 0], "nothing to say");
}

#[test]
fn a_mask_of_one_side_that_calls_itself_copper_of_the_other_is_an_error() {
    let (back, below) = (function("Copper,L2,Bot"), function("Soldermask,Bot"));
    for (name, text) in [("amp-F_Mask.gbr", &back), ("amp-F_Cu.gbr", &below), ("amp_TopPaste.gbr", &back)] {
        let folder = Folder::with(&[(name, text), ("amp-Edge_Cuts.gbr", SQUARE)]);
        let error = folder.load(&Selection::default()).expect_err("a contradiction");
        assert!(
            error.contains(name) && error.contains("of the back") || error.contains("the back copper"),
            "{error}"
        );
        assert!(error.contains("--skip"), "it says how to go on: {error}");
    }
}

#[test]
fn what_is_no_layer_is_left_aside() {
    let files = [
        ("amp-F_Cu.gbr", SQUARE),
        ("amp-F_Mask.gbr", SQUARE),
        ("amp-In1_Cu.gbr", SQUARE),
        ("amp.drl", DRILL),
        ("README.txt", "Dear reader, this is a board.\n"),
        ("LICENSE", "Do what you like.\n"),
        ("notes.json", "{}"),
    ];
    let loaded = Folder::with(&files).load(&Selection::default()).expect("a board");
    let mut roles: Vec<_> = loaded.sources.iter().map(|s| (s.file.as_str(), s.role.as_str())).collect();
    roles.sort_unstable();
    let expected = [
        ("amp-F_Cu.gbr", "front-copper"),
        ("amp-F_Mask.gbr", "ignored (solder mask)"),
        ("amp-In1_Cu.gbr", "ignored (inner copper)"),
        ("amp.drl", "drill"),
    ];
    assert_eq!(roles, expected, "every layer with its role");
    assert_eq!(loaded.ignored, ["LICENSE", "README.txt", "notes.json"], "and what is none");
}

#[test]
fn an_archive_is_as_good_as_a_folder() {
    let folder = Folder::with(&[]);
    let path = folder.path("amp.zip");
    let (copper, drill) = (SQUARE.as_bytes(), DRILL.as_bytes());
    let archive =
        zipped(&[("out/top.gbr", copper), ("out/drill.drl", drill), ("__MACOSX/out/top.gbr", copper)]);
    fs::write(&path, archive).expect("written");
    let loaded = load(&[path], &Selection::default()).expect("a board");
    assert_eq!(files_of(&loaded, "front-copper"), ["top.gbr"], "from inside");
    assert_eq!(loaded.board.holes.len(), 1, "with its drill file");
    assert_eq!(loaded.board.name, "amp", "named as the archive");
}

#[test]
fn folders_inside_one_that_has_no_file_of_a_board_are_looked_into() {
    let eagle = [
        ("CAMOutputs/GerberFiles/copper_top.gbr", SQUARE),
        ("CAMOutputs/GerberFiles/profile.gbr", SQUARE),
        ("CAMOutputs/DrillFiles/drill_1_16.xln", DRILL),
        ("CAMOutputs/Assembly/amp.txt", "Parts of the board, by name and place\n"),
        (".git/old/copper_top.gbr", &SQUARE.replace("0.2", "0.3")),
    ];
    let loaded = Folder::with(&eagle).load(&Selection::default()).expect("a board");
    assert_eq!(files_of(&loaded, "front-copper"), ["copper_top.gbr"]);
    assert_eq!(loaded.board.holes.len(), 1, "with the drill files of another folder");
    assert!(loaded.board.outline.is_some());
    // Of two folders with layers nothing tells that they are of one board.
    let mixed = [("old/amp-F_Cu.gbr", SQUARE), ("new/amp-B_Cu.gbr", SQUARE), ("new/amp.drl", DRILL)];
    let error = Folder::with(&mixed).load(&Selection::default()).expect_err("which one?");
    assert!(error.contains("no copper layer found") && error.contains("new, old"), "{error}");
    // Whoever gives a folder with layers means these.
    let beside = [("amp-F_Cu.gbr", SQUARE), ("old/amp-B_Cu.gbr", SQUARE)];
    let loaded = Folder::with(&beside).load(&Selection::default()).expect("a board");
    assert!(loaded.board.back.is_none() && loaded.ignored == ["old/"], "{:?}", loaded.ignored);
}

#[test]
fn folders_of_an_archive_are_read_and_nothing_else_is_said_of_them() {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    for folder in ["out/", "out/DrillFiles/", "out/drill/"] {
        zip.add_directory(folder, options).expect("an entry");
    }
    for (name, text) in [("out/top.gbr", SQUARE), ("out/DrillFiles/a.xln", DRILL)] {
        zip.start_file(name, options).expect("an entry");
        std::io::Write::write_all(&mut zip, text.as_bytes()).expect("written");
    }
    let folder = Folder::with(&[]);
    fs::write(folder.path("amp.zip"), zip.finish().expect("finished").into_inner()).expect("written");
    let loaded = load(&[folder.path("amp.zip")], &Selection::default()).expect("a board");
    assert_eq!(loaded.board.holes.len(), 1);
    let told: Vec<&str> =
        loaded.warnings.iter().map(|w| w.message.as_str()).filter(|m| m.contains("folder")).collect();
    assert_eq!(told, ["the folder drill, named like a drill file, is not read"], "only the empty one");
}

#[test]
fn files_that_share_no_name_are_the_board_of_their_folder() {
    let folder = Folder::with(&[]);
    fs::create_dir(folder.path("amp")).expect("made");
    let paths = ["upper-top.gbr", "lower-bottom.gbr"].map(|name| folder.path("amp").join(name));
    paths.iter().for_each(|path| fs::write(path, SQUARE).expect("written"));
    let loaded = load(&paths, &Selection::default()).expect("a board");
    assert_eq!(loaded.board.name, "amp", "none of the files has a name for both");
}

#[test]
fn a_single_file_is_the_side_that_it_or_a_person_says() {
    let back = function("Copper,L2,Bot");
    let files = [("some.gbr", SQUARE), ("other.gbr", &back), ("top.gbr", SQUARE), ("art002.pho", SQUARE)];
    let folder = Folder::with(&files);
    for (name, role) in [("other.gbr", "back-copper"), ("top.gbr", "front-copper")] {
        let loaded = load(&[folder.path(name)], &Selection::default()).expect("a board");
        assert_eq!(files_of(&loaded, role), [name], "{role}");
    }
    for name in ["some.gbr", "art002.pho"] {
        let path = folder.path(name);
        let error =
            load(std::slice::from_ref(&path), &Selection::default()).expect_err("a guess").to_string();
        assert!(
            error.contains("the side of this copper layer is unknown") && error.contains("--back"),
            "{name}: {error}"
        );
        let looked_at =
            survey(std::slice::from_ref(&path), &Selection::default()).expect("it may be looked at");
        assert_eq!(files_of(&looked_at, "front-copper"), [name], "as the front");
        let said = Selection { back: Some(path.clone()), ..Selection::default() };
        assert_eq!(files_of(&load(&[path], &said).expect("said"), "back-copper"), [name], "as it is said");
    }
    let loaded = load_copper(&folder.path("some.gbr"), Side::Back).expect("a layer");
    assert!(loaded.board.back.is_some() && loaded.board.front.is_none(), "as asked for");
}

#[test]
fn a_name_for_one_side_and_a_function_for_the_other_are_an_error() {
    let front = function("Copper,L1,Top");
    let folder = Folder::with(&[("amp-B_Cu.gbr", &front), ("amp-Edge_Cuts.gbr", SQUARE)]);
    let error = folder.load(&Selection::default()).expect_err("a contradiction");
    assert!(error.contains("amp-B_Cu.gbr") && error.contains("declares the front"), "{error}");
    let said = Selection { front: Some(folder.path("amp-B_Cu.gbr")), ..Selection::default() };
    assert_eq!(
        files_of(&folder.load(&said).expect("said"), "front-copper"),
        ["amp-B_Cu.gbr"],
        "a person decides"
    );
}

#[test]
fn without_drill_files_all_but_the_holes_is_done() {
    let folder =
        Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("amp.drl", "M48\nMETRIC\nT1C0.8\n%\nT1\nG99X1Y1\nM30\n")]);
    let error = folder.load(&Selection::default()).expect_err("a drill file that cannot be read");
    assert!(error.contains("amp.drl:6:1") && error.contains("--no-drill"), "{error}");
    let bare = Selection { no_drill: true, ..Selection::default() };
    let loaded = folder.load(&bare).expect("a board");
    assert_eq!((loaded.board.holes.len(), files_of(&loaded, "drill").len()), (0, 0), "no hole");
    assert_eq!(files_of(&loaded, "ignored (drill file not chosen)"), ["amp.drl"], "and it is listed");
}

#[test]
fn holes_beside_the_board_are_an_error_unless_a_person_wants_them() {
    let beside = DRILL.replace("X5.0Y5.0", "X-50.0Y-50.0");
    let folder = Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("amp.drl", &beside)]);
    let error = folder.load(&Selection::default()).expect_err("a drill file of another board");
    assert!(error.contains("0 of 1 holes") && error.contains("--drill amp.drl"), "{error}");
    let said = Selection { drill: vec![folder.path("amp.drl")], ..Selection::default() };
    assert_eq!(folder.load(&said).expect("said").board.holes.len(), 1, "as it is said");
    let outlined =
        Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("amp.drl", DRILL), ("amp-Edge_Cuts.gbr", SQUARE)]);
    let loaded = outlined.load(&Selection::default()).expect("a board");
    assert_eq!(loaded.board.holes.len(), 1, "within the edge");
}

#[test]
fn an_outline_that_does_not_close_is_named_where_there_is_nothing_else() {
    let open = SQUARE.replace("X0Y0D01*\nM02", "M02");
    assert_ne!(open, SQUARE, "one side is gone");
    let folder = Folder::with(&[("amp-Edge_Cuts.gbr", &open)]);
    let error = folder.load(&Selection::default()).expect_err("nothing to mill");
    assert!(error.contains("amp-Edge_Cuts.gbr") && error.contains("is not closed"), "{error}");
}

#[test]
fn some_holes_off_the_board_are_said_and_one_far_off_is_an_error() {
    let with = |line: &str| {
        let more = DRILL.replace("M30", &format!("X2.0Y2.0\nX8.0Y2.0\n{line}\nM30"));
        let files = [("amp-F_Cu.gbr", SQUARE), ("amp-Edge_Cuts.gbr", SQUARE), ("amp.drl", &*more)];
        Folder::with(&files).load(&Selection::default())
    };
    let codes = |loaded: &Loaded| loaded.warnings.iter().map(|warning| warning.code()).collect::<Vec<_>>();
    let loaded = with("X40.0Y5.0").expect("a board");
    assert!(codes(&loaded).contains(&"holes-off-board"), "{:?}", codes(&loaded));
    let framed = with("X13.0Y5.0").expect("a board");
    assert!(!codes(&framed).contains(&"holes-off-board"), "in the frame: {:?}", codes(&framed));
    // As a damaged digit makes it: the programs could not even be judged.
    let error = with("X7.0Y6.0G85X8.0Y677.7").expect_err("a slot of half a metre");
    assert!(error.contains("a slot of line 9 lies") && error.contains("--no-drill"), "{error}");
}

#[test]
fn what_a_person_must_know_is_an_error_in_a_sentence() {
    let mask = function("Soldermask,Top");
    let files = [
        ("empty.gbr", ""),
        ("picture.gbr", "\u{89}PNG\r\n"),
        ("prose.gbr", "this is no layer\n"),
        (
            "eagle.brd",
            "<?xml version=\"1.0\"?>\n<!DOCTYPE eagle SYSTEM \"eagle.dtd\">\n<eagle version=\"9\">\n",
        ),
        ("old.brd", "PCBNEW-BOARD Version 1 date Mon Jun  4\n"),
        ("cuts.gcode", "(front)\nG21 G90\nG0 X1 Y2 Z3\nM2\n"),
        ("holes.drl", DRILL),
        ("mask.gbr", &mask),
        ("nothing_top.gbr", "%FSLAX46Y46*%\n%MOMM*%\nM02*\n"),
        ("copper.gbr", SQUARE),
    ];
    let folder = Folder::with(&files);
    fs::write(folder.path("picture.gbr"), b"\x89PNG\r\n\x1a\n").expect("written");
    let cases = [
        ("missing.gbr", "no such file"),
        ("empty.gbr", "an empty file"),
        ("picture.gbr", "the picture cannot be read"),
        ("prose.gbr", "neither Gerber nor Excellon"),
        ("eagle.brd", "an EAGLE board or schematic, neither Gerber nor Excellon"),
        ("old.brd", "a board of a KiCad before 4"),
        ("cuts.gcode", "a G-code program, neither Gerber nor Excellon"),
        ("mask.gbr", "no copper layer found among mask.gbr (solder mask)"),
        ("nothing_top.gbr", "no copper"),
    ];
    for (name, expected) in cases {
        let error = load(&[folder.path(name)], &Selection::default()).expect_err(name).to_string();
        assert!(error.contains(name) && error.contains(expected), "{name}: {error}");
    }
    let error = load_copper(&folder.path("holes.drl"), Side::Front).expect_err("a drill file").to_string();
    assert!(error.contains("an Excellon drill file where a copper layer"), "{error}");
    let selection = Selection { drill: vec![folder.path("copper.gbr")], ..Selection::default() };
    let error = load(&[folder.path("some.gbr"), folder.path("copper.gbr")], &selection);
    assert!(error.is_err(), "a missing file stays one");
    let selection = Selection {
        front: Some(folder.path("copper.gbr")),
        drill: vec![folder.path("mask.gbr")],
        ..Selection::default()
    };
    let error =
        load(&[folder.path("copper.gbr")], &selection).expect_err("a mask is no drill file").to_string();
    assert!(error.contains("a Gerber file where a drill file was expected"), "{error}");
}

#[test]
fn plated_and_unplated_holes_are_both_taken_and_doubles_once() {
    let npth = DRILL.replace("X5.0Y5.0", "X9.0Y9.0\nX5.0Y5.0");
    let folder = Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("amp-PTH.drl", DRILL), ("amp-NPTH.drl", &npth)]);
    let loaded = folder.load(&Selection::default()).expect("a board");
    assert_eq!(loaded.board.holes.len(), 2, "one from each, and the double once");
    let codes: Vec<_> = loaded.warnings.iter().map(|warning| warning.code()).collect();
    assert!(codes.contains(&"duplicate-holes"), "{codes:?}");
}

#[test]
fn what_one_file_drills_twice_is_one_hole() {
    let twice = DRILL.replace("X5.0Y5.0", "X5.0Y5.0\nX5.0Y5.0\nX5.01Y5.0\nX5.3Y5.0");
    let folder = Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("amp-PTH.drl", &twice)]);
    let loaded = folder.load(&Selection::default()).expect("a board");
    assert_eq!(loaded.board.holes.len(), 2, "one, and that beside it");
    let said = loaded.warnings.iter().find(|warning| warning.code() == "duplicate-holes").expect("a warning");
    assert!(said.message.starts_with("2 holes of amp-PTH.drl are there more than once"), "{}", said.message);
}

#[test]
fn what_a_kicad_board_drills_twice_is_one_hole() {
    let via = "(via (at 5 5) (size 0.8) (drill 0.4) (layers F.Cu B.Cu) (net 0))";
    let board = format!("(kicad_pcb (version 20211014) {via} {via} {})", via.replace("at 5 5", "at 9 5"));
    let folder = Folder::with(&[("amp.kicad_pcb", &board)]);
    let loaded = folder.load(&Selection::default()).expect("a board");
    assert_eq!(loaded.board.holes.len(), 2, "one, and that beside it");
    let said = loaded.warnings.iter().find(|warning| warning.code() == "duplicate-holes").expect("a warning");
    let expected = "1 hole of amp.kicad_pcb is there more than once; it is drilled once";
    assert_eq!(said.message, expected);
}

#[test]
fn a_gerber_drill_file_has_holes_and_slots() {
    let text = "%TF.FileFunction,Plated,1,2,PTH*%\n%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.8*%\n%ADD11O,2.0X1.0*%\nD10*\nX1000000Y1000000D03*\nX5000000Y5000000D02*\nX7000000Y5000000D01*\nD11*\nX9000000Y9000000D03*\nM02*\n";
    let folder = Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("amp-PTH-drl.gbr", text)]);
    let loaded = folder.load(&Selection::default()).expect("a board");
    let slots: Vec<_> = loaded.board.holes.iter().map(|hole| (hole.is_slot(), hole.diameter)).collect();
    let expected = [(false, Nm::from_um(800)), (true, Nm::from_um(800)), (true, Nm::from_um(1000))];
    assert_eq!(slots, expected, "a hole, a drawn slot, an obround");
}

/// Altium writes the macros of its apertures beside the layers.
#[test]
fn a_library_of_apertures_is_no_layer_that_is_missed() {
    let macros = "G04:AMPARAMS|DCode=60*\n%AMROUNDEDRECTD60*\n21,1,1.8,1.1,0,0,90.0*\n%\n";
    let folder = Folder::with(&[("amp.GTL", SQUARE), ("amp-macro.APR_LIB", macros)]);
    let loaded = folder.load(&Selection::default()).expect("a board");
    let codes: Vec<_> = loaded.warnings.iter().map(|warning| warning.code()).collect();
    assert!(!codes.contains(&"role-unknown"), "{codes:?}");
}

/// KiCad's slots that are turned are macros of a line and a disc at each end of it.
#[test]
fn a_turned_slot_of_a_gerber_drill_file_is_drilled() {
    let text = "%TF.FileFunction,Plated,1,2,PTH*%\n%FSLAX46Y46*%\n%MOMM*%\n%AMHorizOval*20,1,$1,$2,$3,$4,$5,0*1,1,$1,$2,$3*1,1,$1,$4,$5*%\n%ADD12HorizOval,1.020000X-0.156054X-0.480284X0.156054X0.480284X0*%\n%AMOther*20,1,$1,$2,$3,$4,$5,0*1,1,$1,$2,$3*%\n%ADD13Other,1.020000X-0.156054X-0.480284X0.156054X0.480284X0*%\nD12*\nX1000000Y1000000D03*\nD13*\nX5000000Y5000000D03*\nM02*\n";
    let folder = Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("amp-PTH-drl.gbr", text)]);
    let loaded = folder.load(&Selection::default()).expect("a board");
    let [slot] = loaded.board.holes.as_slice() else { panic!("one slot: {:?}", loaded.board.holes) };
    let mut ends = [slot.path.start, slot.path.end()].map(|end| (end.x.get(), end.y.get()));
    ends.sort_unstable();
    assert_eq!((ends, slot.diameter), ([(843_946, 519_716), (1_156_054, 1_480_284)], Nm::from_um(1020)));
    let said: Vec<_> = loaded.warnings.iter().filter(|warning| warning.code() == "not-a-hole").collect();
    let message = "neither round nor obround, and so not drilled: 1 shape of the drill file amp-PTH-drl.gbr";
    assert!(said.len() == 1 && said[0].message == message, "one end is square: {said:?}");
}

/// A kind of hole that a board does not have.
#[test]
fn an_empty_gerber_drill_file_is_no_matter() {
    let head = "%TF.FileFunction,NonPlated,1,2,NPTH*%\n%FSLAX46Y46*%\n%MOMM*%\n";
    let empty = format!("{head}M02*\n");
    let codes = |files: &[(&str, &str)]| -> Vec<_> {
        let loaded = Folder::with(files).load(&Selection::default()).expect("a board");
        loaded.warnings.iter().map(|warning| warning.code()).collect()
    };
    let files = [("amp-F_Cu.gbr", SQUARE), ("amp-NPTH-drl.gbr", &empty), ("amp-PTH.drl", DRILL)];
    assert_eq!(codes(&files), ["outline-missing"]);
    assert_eq!(codes(&files[..2]), ["outline-missing", "drill-without-holes"], "none at all");
}

#[test]
fn round_flashes_are_holes_where_a_person_says_so() {
    let flashes =
        "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.8*%\nD10*\nX1000000Y1000000D03*\nX5000000Y5000000D03*\nM02*\n";
    let folder = Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("holes.gbr", flashes), ("drawn.gbr", SQUARE)]);
    let chosen = |name: &str| Selection { drill: vec![folder.path(name)], ..Selection::default() };
    assert_eq!(folder.load(&chosen("holes.gbr")).expect("a board").board.holes.len(), 2);
    let error = folder.load(&chosen("drawn.gbr")).expect_err("lines");
    assert!(error.contains("nor does it consist of round flashes"), "{error}");
}

/// An archive of `files`.
pub(crate) fn zipped(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    for (name, bytes) in files {
        zip.start_file(*name, options).expect("an entry");
        std::io::Write::write_all(&mut zip, bytes).expect("written");
    }
    zip.finish().expect("finished").into_inner()
}

#[test]
fn an_archive_that_fills_the_memory_is_refused() {
    let folder = Folder::with(&[]);
    let bomb = vec![b'\n'; 65 << 20];
    fs::write(folder.path("bomb.zip"), zipped(&[("top.gbr", &bomb)])).expect("written");
    let error = load(&[folder.path("bomb.zip")], &Selection::default()).expect_err("a bomb").to_string();
    assert!(error.contains("unpacks to more than 64 MiB"), "{error}");
}

#[test]
fn damaged_archives_end_in_words() {
    let folder = Folder::with(&[]);
    let good = zipped(&[("top.gbr", SQUARE.as_bytes()), ("holes.drl", DRILL.as_bytes())]);
    for at in (4..good.len()).step_by(3) {
        let mut bad = good.clone();
        bad[at] ^= 0x55;
        fs::write(folder.path("bad.zip"), &bad).expect("written");
        if let Err(error) = load(&[folder.path("bad.zip")], &Selection::default()) {
            assert!(
                error.to_string().contains("bad.zip") || error.to_string().contains("top.gbr"),
                "byte {at}: {error}"
            );
        }
        fs::write(folder.path("cut.zip"), &good[..at]).expect("written");
        assert!(load(&[folder.path("cut.zip")], &Selection::default()).is_err(), "cut at {at}");
    }
}

#[test]
fn of_two_outlines_the_one_that_encloses_a_board_is_taken() {
    let open = SQUARE.replace("X0Y0D01*", "");
    let wide = SQUARE.replace("20000000", "30000000");
    let files = |gm1: &str| Folder::with(&[("amp.gtl", SQUARE), ("amp.gko", SQUARE), ("amp.gm1", gm1)]);
    for gm1 in [open.as_str(), &SQUARE.replace("0.2*", "0.3*")] {
        let loaded = files(gm1).load(&Selection::default()).expect("settled");
        assert_eq!(
            files_of(&loaded, "outline"),
            ["amp.gko"],
            "the one that closes, or the first of two that agree"
        );
        assert!(
            loaded.warnings.iter().any(|warning| warning.code() == "outline-twice"),
            "and a word about it"
        );
    }
    let error = files(&wide).load(&Selection::default()).expect_err("two boards");
    assert!(error.contains("--outline"), "{error}");
}

#[test]
fn the_boards_of_this_repository_load_without_a_warning() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards");
    let mut paths: Vec<_> =
        fs::read_dir(folder).expect("readable").map(|e| e.expect("an entry").path()).collect();
    paths.retain(|path| path.is_dir());
    paths.sort();
    assert!(paths.len() >= 3, "three boards: {paths:?}");
    for path in paths {
        let loaded = board(&path);
        assert!(loaded.warnings.is_empty(), "{}: {:?}", path.display(), loaded.warnings);
        assert!(
            loaded.board.outline.is_some() && (loaded.board.front.is_some() || loaded.board.back.is_some()),
            "{}: a whole board",
            path.display()
        );
        assert!(!loaded.board.holes.is_empty(), "{}: with holes", path.display());
        let name = path.file_name().expect("a name").to_str().expect("text");
        assert_eq!(loaded.board.name, name, "named as its files");
    }
}

/// pcb-rnd writes holes as a Gerber layer of its own, beside Excellon if asked.
#[test]
fn holes_in_gerber_are_read_where_there_is_no_drill_file() {
    let names = ["amp.top.copper.none.3.gbr", "amp.global.virtual.pdrill.none.gbr", "amp.plated-drill.cnc"];
    let files = [(names[0], SQUARE), (names[1], SQUARE), (names[2], DRILL)];
    let alone = Folder::with(&files[..2]).load(&Selection::default()).expect("a board");
    assert_eq!(files_of(&alone, "drill"), [names[1]]);
    assert!(!alone.board.holes.is_empty(), "its lines are slots");
    assert!(alone.board.holes.iter().all(|hole| hole.plating == Plating::Plated), "pdrill: plated");
    let both = Folder::with(&files).load(&Selection::default()).expect("a board");
    assert_eq!(files_of(&both, "drill"), [names[2]], "once");
    // A picture of the holes is told from them by its name alone, so that is said.
    let drawn = Folder::with(&[files[0], ("amp-drill.gbr", SQUARE)]);
    let said = drawn.load(&Selection::default()).expect("a board").warnings;
    let said: Vec<_> = said.iter().filter(|warning| warning.code() == "role-unknown").collect();
    assert!(said.len() == 1 && said[0].message.ends_with("no holes are read"), "{said:?}");
    let none = drawn.load(&Selection { no_drill: true, ..Selection::default() }).expect("a board");
    assert!(none.warnings.iter().all(|warning| warning.code() != "role-unknown"), "as asked for");
}

#[test]
fn a_drill_file_that_ends_at_once_has_no_holes() {
    let folder = Folder::with(&[("amp-F_Cu.gbr", SQUARE), ("amp-PTH.drl", DRILL), ("amp.cnc", "M30\r\n")]);
    let loaded = folder.load(&Selection::default()).expect("a board");
    assert_eq!(files_of(&loaded, "drill"), ["amp-PTH.drl", "amp.cnc"]);
    let said = loaded.warnings.iter().find(|warning| warning.code().starts_with("drill"));
    assert!(said.is_none(), "pcb-rnd writes it: {said:?}");
}

#[test]
fn a_layer_whose_file_name_tells_nothing_may_be_named_inside() {
    let edge = SQUARE.replacen("%MO", "%LNGLOBAL_BOUNDARY_UROUTE_7*%\n%MO", 1);
    assert!(edge.contains("%LN"), "{edge}");
    let folder = Folder::with(&[("amp.top", SQUARE), ("amp.fab", &edge)]);
    let loaded = folder.load(&Selection::default()).expect("a board");
    assert_eq!(files_of(&loaded, "outline"), ["amp.fab"]);
}

#[test]
fn a_drill_drawing_of_orcad_is_no_drill_file_where_there_is_one() {
    let files = [("AMP.TOP", SQUARE), ("AMP.BOT", SQUARE), ("AMP.DRD", SQUARE), ("thruhole.tap", DRILL)];
    let loaded = Folder::with(&files).load(&Selection::default()).expect("a board");
    assert_eq!(files_of(&loaded, "drill"), ["thruhole.tap"]);
    assert_eq!(files_of(&loaded, "ignored (drill drawing)"), ["AMP.DRD"]);
    let error = Folder::with(&files[..3]).load(&Selection::default()).expect_err("holes that are drawn");
    assert!(error.contains("named like a drill file, but it is a Gerber file"), "{error}");
}
