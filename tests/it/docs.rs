//! The commands in README and docs: each is run on the fixtures, in a folder with the files that it
//! names, and what is quoted of its output is today's.
//!
//! A block of commands that is not run says so where people see it: ```` ```sh not run ````.
//!
//! The examples of `--help` and the commands in running text are run on a board of two pads.

use std::fs;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use tempfile::TempDir;

use super::cli::{stderr, stdout, voromill};
use super::words::literals;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A fenced block: what stands behind the fence, the line of the fence, its lines.
struct Block<'a> {
    kind: &'a str,
    line: usize,
    lines: Vec<&'a str>,
}

fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut blocks: Vec<Block<'_>> = Vec::new();
    let mut open = false;
    for (line, number) in text.lines().zip(1..) {
        if let Some(kind) = line.strip_prefix("```") {
            if !open {
                blocks.push(Block { kind, line: number, lines: Vec::new() });
            }
            open = !open;
        } else if open {
            blocks.last_mut().expect("an open one").lines.push(line);
        }
    }
    blocks
}

/// The pages with commands.
fn pages() -> Vec<PathBuf> {
    let docs = fs::read_dir(root().join("docs")).expect("a folder");
    let mut pages: Vec<PathBuf> = docs.map(|entry| entry.expect("an entry").path()).collect();
    pages.push(root().join("README.md"));
    pages.retain(|page| page.extension().is_some_and(|ending| ending == "md"));
    pages.sort();
    pages
}

/// The words of a command as a shell makes them: quotes, a comment, `*` in a file's name.
fn words(line: &str, folder: &Path) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut word: Option<String> = None;
    let mut quoted = false;
    for letter in line.chars() {
        match letter {
            '\'' => {
                quoted = !quoted;
                word.get_or_insert_default();
            }
            ' ' if !quoted => words.extend(word.take()),
            '#' if !quoted && word.is_none() => break,
            _ => word.get_or_insert_default().push(letter),
        }
    }
    words.extend(word);
    words.into_iter().flat_map(|word| expanded(word, folder)).collect()
}

fn expanded(word: String, folder: &Path) -> Vec<String> {
    if word.starts_with("fixtures/") || word.starts_with("docs/") {
        return vec![root().join(word).display().to_string()];
    }
    let Some((start, ending)) = word.split_once("/*") else { return vec![word] };
    let entries = fs::read_dir(folder.join(start)).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(ending)).collect();
    names.sort();
    names.iter().map(|name| format!("{start}/{name}")).collect()
}

/// Runs a line; what it prints, and why it failed.
fn run(line: &str, folder: &Path) -> Result<String, String> {
    let line = line.trim_start_matches("cargo run --release -- ").trim_start_matches("voromill ");
    let mut words = words(line, folder);
    let into = words
        .iter()
        .position(|word| word == ">" || word == ">>")
        .map(|at| words.split_off(at).pop().expect("a name"));
    let done = voromill(folder, &words.iter().map(String::as_str).collect::<Vec<_>>());
    if let Some(into) = into {
        fs::write(folder.join(into), &done.stdout).expect("writable");
    }
    // Judging and comparing may find something.
    let finds = ["verify", "diff"].contains(&words[0].as_str()) || words.iter().any(|word| word == "--check");
    let text = stdout(&done) + &stderr(&done);
    match done.status.code() {
        Some(0) => Ok(text),
        Some(1) if finds => Ok(text),
        code => Err(format!("{code:?}: {text}")),
    }
}

const PLATE: &str = "<svg xmlns='http://www.w3.org/2000/svg' width='30mm' height='20mm' viewBox='0 0 30 20'>\
    <path fill='black' d='M0 0H30V20H0Z'/></svg>";

/// A black cross on white, as a PBM: what a picture is says its content.
fn cross() -> String {
    let is_black = |x: i32, y: i32| {
        (x - 20).abs() < 5 && (y - 20).abs() < 15 || (y - 20).abs() < 5 && (x - 20).abs() < 15
    };
    let row = |y| (0..40).map(|x| if is_black(x, y) { "1 " } else { "0 " }).collect::<String>() + "\n";
    "P1\n40 40\n".to_owned() + &(0..40).map(row).collect::<String>()
}

/// A DXF with a rectangle of lines on the layer Edge, and what else there is.
fn drawing([left, bottom, right, top]: [i32; 4], more: &str) -> String {
    let corners = [(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)];
    let line = |pair: &[(i32, i32)]| {
        let [(a, b), (c, d)] = [pair[0], pair[1]];
        format!("0\nLINE\n8\nEdge\n10\n{a}\n20\n{b}\n11\n{c}\n21\n{d}\n")
    };
    let lines: String = corners.windows(2).map(line).collect();
    let head = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    format!("{head}{lines}{more}0\nENDSEC\n0\nEOF\n")
}

const PROJECT: &str = "metric = true\nfront = board/board-F_Cu.gbr\noutline = board/board-Edge_Cuts.gbr\n\
    zwork = -0.1\nzsafe = 2\nmill-diameters = 0.2mm\nzcut = -1.7\noutput-dir = out\n";

const GRBL: &str = "$30=8000\n$32=0\n$110=800.000\n$111=800.000\n$112=300.000\n$120=20.000\n$121=20.000\n\
    $122=10.000\n$130=280.000\n$131=170.000\n$132=40.000\nok\n";

/// Copies a file.
fn copy(from: &Path, to: &Path) {
    fs::copy(from, to).unwrap_or_else(|error| panic!("{}: {error}", from.display()));
}

/// Writes the layers of a board into a folder, into `board/` in it and as `board.zip`.
fn write_layers(folder: &Path, layers: &[(String, Vec<u8>)]) {
    fs::create_dir(folder.join("board")).expect("writable");
    let mut archive = zip::ZipWriter::new(fs::File::create(folder.join("board.zip")).expect("writable"));
    for (name, bytes) in layers {
        fs::write(folder.join(name), bytes).expect("writable");
        fs::write(folder.join("board").join(name), bytes).expect("writable");
        archive.start_file(name, zip::write::SimpleFileOptions::default()).expect("an entry");
        std::io::Write::write_all(&mut archive, bytes).expect("writable");
    }
    archive.finish().expect("an archive");
}

/// Runs commands that make what others take.
fn prepare(folder: &Path, lines: &[&str]) {
    for line in lines {
        run(line, folder).unwrap_or_else(|error| panic!("{line}: {error}"));
    }
}

/// Copies the programs in `out/` into folders, and under other names: each with its side.
fn copy_programs(folder: &Path, folders: &[&str], names: &[(&str, &str)]) {
    let front = folder.join("out/board-front.ngc");
    for other in folders {
        fs::create_dir(folder.join(other)).expect("writable");
        copy(&front, &folder.join(other).join("board-front.ngc"));
    }
    for (name, side) in names {
        copy(&folder.join(format!("out/board-{side}.ngc")), &folder.join(name));
    }
}

/// What the pages take for a person's own files: a board as `board/` and in other forms, programs,
/// pictures, drawings.
fn own_files(folder: &Path) {
    let fixtures = root().join("fixtures");
    let layer = |layer: &str| {
        let from = fixtures.join(format!("boards/regulator/regulator-{layer}"));
        (format!("board-{layer}"), fs::read(from).expect("a layer"))
    };
    let layers = ["F_Cu.gbr", "B_Cu.gbr", "Edge_Cuts.gbr", "PTH.drl", "F_Mask.gbr", "B_Mask.gbr"];
    write_layers(folder, &layers.map(layer));
    fs::create_dir(folder.join("gerbers")).expect("writable");
    copied(&folder.join("board"), &folder.join("gerbers"));
    copy(&fixtures.join("kicad/shapes.kicad_pcb"), &folder.join("board.kicad_pcb"));
    copy(&fixtures.join("gerber/clear_polarity.gbr"), &folder.join("board-F_Silkscreen.gbr"));
    copy(&fixtures.join("drawings/layers.svg"), &folder.join("board.svg"));
    for probe in ["probe.txt", "board-front-probe.txt"] {
        copy(&root().join("docs/walkthrough/regulator.probe"), &folder.join(probe));
    }
    let write = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).expect("writable");
    write("DejaVuSans.ttf", dejavu::sans::regular());
    ["plate.svg", "sign.svg", "logo.svg", "traces.svg"].iter().for_each(|name| write(name, PLATE.as_bytes()));
    write("logo.png", cross().as_bytes());
    write("plate.dxf", drawing([90, -120, 170, -60], "").as_bytes());
    let hole = "0\nCIRCLE\n8\nHoles\n10\n5\n20\n-3\n40\n0.5\n";
    write("edge.dxf", drawing([-5, -5, 35, 25], hole).as_bytes());
    write("millproject", PROJECT.as_bytes());
    write("settings.txt", GRBL.as_bytes());
    let lines = [
        "machine import settings.txt > mine.toml",
        "mill board/ -o out",
        "mask board/ -o front.png --dpi 600",
        "mask board/ -o back.png --dpi 600 --side back --mirror",
        "mask board/ -o scan.png --dpi 600",
    ];
    prepare(folder, &lines);
    let names = [("flatcam.nc", "front"), ("front.nc", "front"), ("front.ngc", "front"), ("back.nc", "back")];
    copy_programs(folder, &["old", "new", "main-out", "branch-out"], &names);
}

/// Copies a folder with the folders in it.
fn copied(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).expect("a folder").map(|entry| entry.expect("an entry")) {
        let to = to.join(entry.file_name());
        if entry.path().is_dir() {
            fs::create_dir(&to).expect("writable");
            copied(&entry.path(), &to);
        } else {
            fs::copy(entry.path(), &to).expect("writable");
        }
    }
}

/// Runs the commands of a page in a folder of its own; how many, and what is wrong.
fn follow(page: &Path, own: &Path) -> (usize, Vec<String>) {
    let text = fs::read_to_string(page).expect("a page");
    let folder = TempDir::new().expect("a folder");
    let (mut count, mut wrong, mut printed) = (0, Vec::new(), None);
    for block in blocks(&text) {
        let place = format!("{}:{}", page.strip_prefix(root()).expect("of ours").display(), block.line);
        match block.kind {
            "sh" => {
                let is_ours =
                    |line: &&&str| line.starts_with("voromill ") || line.contains("cargo run --release -- ");
                let lines: Vec<&&str> = block.lines.iter().filter(is_ours).collect();
                if count == 0 && !lines.is_empty() {
                    copied(own, folder.path());
                }
                count += lines.len();
                let mut all = String::new();
                for line in lines {
                    match run(line, folder.path()) {
                        Ok(text) => all += &text,
                        Err(error) => wrong.push(format!("{place}: {line}: {error}")),
                    }
                }
                printed = Some(all);
            }
            // What is quoted right behind commands; an ellipsis stands for anything.
            "text" => {
                let Some(printed) = printed.take() else { continue };
                let is_stale = |line: &&&str| !line.contains('…') && !printed.contains(line.trim_end());
                wrong.extend(
                    block.lines.iter().filter(is_stale).map(|line| format!("{place}: not printed: {line}")),
                );
            }
            _ => {
                let marked = ["sh not run", "toml", "yaml", ""].contains(&block.kind);
                if !marked
                    || block.lines.iter().any(|line| block.kind.is_empty() && line.starts_with("voromill "))
                {
                    wrong
                        .push(format!("{place}: commands are ```sh or ```sh not run, not ```{}", block.kind));
                }
            }
        }
    }
    (count, wrong)
}

#[test]
fn every_command_in_the_docs_runs() {
    let own = TempDir::new().expect("a folder");
    own_files(own.path());
    let done: Vec<(usize, Vec<String>)> = pages().par_iter().map(|page| follow(page, own.path())).collect();
    let count: usize = done.iter().map(|(count, _)| count).sum();
    assert!(count > 60, "they are found: {count}");
    let wrong: Vec<String> = done.into_iter().flat_map(|(_, wrong)| wrong).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

const COPPER: &str = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,2.0*%\n%ADD11C,0.5*%\nD10*\nX5000000Y3000000D03*\n\
    X15000000Y3000000D03*\nX15000000Y7000000D03*\nD11*\nX5000000Y3000000D02*\nX5000000Y7000000D01*\nM02*\n";
const OUTLINE: &str = "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,0.1*%\nD10*\nX0Y0D02*\nX20000000Y0D01*\n\
    X20000000Y10000000D01*\nX0Y10000000D01*\nX0Y0D01*\nM02*\n";
const DRILL: &str = "M48\nMETRIC\nT1C0.8\n%\nT1\nX5.0Y3.0\nX15.0Y3.0\nM30\n";
const LINUXCNC: &str = "[TRAJ]\nLINEAR_UNITS = mm\n\
    [AXIS_X]\nMAX_VELOCITY = 20\nMAX_ACCELERATION = 100\nMIN_LIMIT = 0\nMAX_LIMIT = 200\n\
    [AXIS_Y]\nMAX_VELOCITY = 20\nMAX_ACCELERATION = 100\nMIN_LIMIT = 0\nMAX_LIMIT = 200\n\
    [AXIS_Z]\nMAX_VELOCITY = 10\nMAX_ACCELERATION = 50\nMIN_LIMIT = -50\nMAX_LIMIT = 0\n";

/// What examples take for a person's own files, of a board with two pads and a trace.
fn small_files(folder: &Path) {
    let fixtures = root().join("fixtures");
    let layers = [
        ("board-F_Cu.gbr", COPPER),
        ("board-B_Cu.gbr", COPPER),
        ("board-F_Mask.gbr", &COPPER.replace("C,2.0", "C,1.0")),
        ("board-Edge_Cuts.gbr", OUTLINE),
        ("board.drl", DRILL),
    ];
    write_layers(folder, &layers.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec())));
    copy(&fixtures.join("kicad/shapes.kicad_pcb"), &folder.join("board.kicad_pcb"));
    copy(&fixtures.join("level/board.hmap"), &folder.join("board.hmap"));
    for map in ["board.probe", "probe.txt", "board-front-probe.txt"] {
        copy(&fixtures.join("level/board.probe"), &folder.join(map));
    }
    let write = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).expect("writable");
    write("board-F_Silkscreen.gbr", COPPER.as_bytes());
    let touch = |(x, y): (i32, i32)| format!("[PRB:{}.000,{}.000,-31.200:1]\n", x - 120, y - 80);
    let log: String = [(0, 0), (20, 0), (0, 10), (20, 10)].map(touch).concat();
    write("grbl.log", log.as_bytes());
    for font in ["DejaVuSans.ttf", "DejaVuSerif-Bold.ttf"] {
        write(font, dejavu::sans::regular());
    }
    let plate = PLATE.replace("30mm", "6mm").replace("20mm", "5mm");
    ["plate.svg", "sign.svg"].iter().for_each(|name| write(name, plate.as_bytes()));
    write("logo.png", cross().as_bytes());
    write("settings.txt", GRBL.as_bytes());
    write("my-mill.ini", LINUXCNC.as_bytes());
    write("millproject", PROJECT.replace("output-dir", "drill = board/board.drl\noutput-dir").as_bytes());
    let lines = [
        "machine import settings.txt > mine.toml",
        "mill board/ -o out",
        "mask board/ -o scan.png --dpi 600",
        "carve logo.png --picture-width 40mm -o logo.ngc --max-depth 2mm --depth-pass 0.5mm",
        "pocket plate.svg -o plate.ngc --tool endmill:3mm --depth 4mm --depth-pass 1mm",
    ];
    prepare(folder, &lines);
    let fronts = ["front.ngc", "front.gcode", "flatcam.nc", "a.nc", "b.nc"].map(|name| (name, "front"));
    let folders = ["old", "new", "out-main", "out-branch"];
    copy_programs(folder, &folders, &[&fronts[..], &[("back.nc", "back")]].concat());
}

/// The commands of the examples in help texts, with where they stand: what follows two spaces is
/// their description.
fn examples() -> Vec<(String, String)> {
    let mut found = Vec::new();
    for entry in fs::read_dir(root().join("src/cli")).expect("a folder") {
        let path = entry.expect("an entry").path();
        let code = fs::read_to_string(&path).expect("a source");
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        for (_, text) in literals(&code) {
            let lines = text.lines().filter_map(|line| line.strip_prefix("  voromill "));
            found
                .extend(lines.map(|line| (name.clone(), line.split("  ").next().unwrap_or(line).to_owned())));
        }
    }
    found
}

/// The commands in running text: code spans that begin with `voromill` and say more than a name.
fn spans() -> Vec<(String, String)> {
    let mut found = Vec::new();
    for page in pages() {
        let text = fs::read_to_string(&page).expect("a page");
        let place = page.strip_prefix(root()).expect("of ours").display().to_string();
        let mut fenced = false;
        let prose = |line: &&str| {
            let fence = line.starts_with("```");
            fenced ^= fence;
            !fenced && !fence && !line.starts_with('#')
        };
        let prose = text.lines().filter(prose).collect::<Vec<_>>().join(" ");
        let spans = prose.split('`').skip(1).step_by(2).filter_map(|span| span.strip_prefix("voromill "));
        found.extend(spans.filter(|span| span.contains(' ')).map(|span| (place.clone(), own_words(span))));
    }
    found
}

/// A command with an example for what stands for any, and small files for large ones.
fn own_words(span: &str) -> String {
    let words = span.split_whitespace().map(|word| match word {
        "CODE" => "gouge",
        "COMMAND" => "mill",
        "BOARD" | "FILE" => "board/",
        "…" => "board/ -o out",
        "fixtures/boards/regulator/regulator-F_Mask.gbr" => "board-F_Mask.gbr",
        "fixtures/boards/regulator" => "board/",
        "voromill" => "v",
        "14mm" => "3mm",
        _ => word,
    });
    let line = words.collect::<Vec<_>>().join(" ");
    // Where a page speaks of an option it leaves out the board.
    match line.as_str() {
        "mill --millproject board/" => "mill --millproject millproject".to_owned(),
        "draw --stage copper --dpi 500" => "draw board/ --stage copper --dpi 500 -o copper.png".to_owned(),
        _ => line,
    }
}

#[test]
fn every_example_of_help_and_every_command_in_prose_runs() {
    let own = TempDir::new().expect("a folder");
    small_files(own.path());
    let (examples, spans) = (examples(), spans());
    assert!(examples.len() > 60 && spans.len() > 10, "they are found: {}, {}", examples.len(), spans.len());
    let mut commands = [examples, spans].concat();
    commands.sort_by(|a, b| a.1.cmp(&b.1));
    commands.dedup_by(|a, b| a.1 == b.1);
    let wrong: Vec<String> = commands
        .par_iter()
        .filter_map(|(place, line)| {
            let folder = TempDir::new().expect("a folder");
            copied(own.path(), folder.path());
            run(line, folder.path()).err().map(|error| format!("{place}: {line}: {error}"))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
