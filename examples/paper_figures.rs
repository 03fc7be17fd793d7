//! The figures of the VIsolate paper, drawn from fixtures of our own: `cargo run --release
//! --example paper_figures` writes them to `docs/pictures/paper`, and the page about them to
//! `docs/figures.md`. `cargo run --release --example paper_figures BOARD FOLDER` draws another
//! board.

use std::fs;
use std::path::{Path, PathBuf};

use voromill::board::{Copper, Side};
use voromill::import::{self, Selection};
use voromill::report::figures::{Subjects, figures, page};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut named = std::env::args_os().skip(1).map(PathBuf::from);
    let board = named.next().unwrap_or_else(|| root.join("fixtures/boards/blinker"));
    let folder = named.next();
    let board = import::load(&[board], &Selection::default())?.board;
    let side = if board.back.is_some() { Side::Back } else { Side::Front };
    let small = |name: &str| -> Result<Copper, Box<dyn std::error::Error>> {
        let file = root.join("fixtures/figures").join(name);
        Ok(import::load_copper(&file, Side::Front)?.board.front.ok_or("no copper")?)
    };
    let (shared, overlaps) = (small("shared-vertices.gbr")?, small("overlaps.gbr")?);
    let drawn = figures(&Subjects { board: &board, side, shared: &shared, overlaps: &overlaps })?;
    let pictures = folder.clone().unwrap_or_else(|| root.join("docs/pictures/paper"));
    fs::create_dir_all(&pictures)?;
    for figure in &drawn {
        fs::write(pictures.join(figure.file), figure.painting.to_png())?;
    }
    if folder.is_none() {
        fs::write(root.join("docs/figures.md"), page(&drawn))?;
    }
    Ok(())
}
