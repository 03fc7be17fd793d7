//! The paper's figures: `docs/figures.md` and its pictures are what the example draws today.

use std::fs;
use std::path::Path;

use voromill::board::{Copper, Side};
use voromill::import::{self, Selection};
use voromill::report::figures::{Subjects, figures, page};

#[test]
fn the_papers_figures_are_in_the_docs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let small = |name: &str| -> Copper {
        let file = root.join("fixtures/figures").join(name);
        let loaded = import::load_copper(&file, Side::Front).expect("a fixture");
        loaded.board.front.expect("copper")
    };
    let board = import::load(&[root.join("fixtures/boards/blinker")], &Selection::default());
    let board = board.expect("a board").board;
    let (shared, overlaps) = (small("shared-vertices.gbr"), small("overlaps.gbr"));
    let subjects = Subjects { board: &board, side: Side::Back, shared: &shared, overlaps: &overlaps };
    let drawn = figures(&subjects).expect("they can be drawn");
    let shown = fs::read_to_string(root.join("docs/figures.md")).expect("the page");
    assert_eq!(page(&drawn), shown, "docs/figures.md: run `cargo run --release --example paper_figures`");
    for figure in &drawn {
        let file = root.join("docs/pictures/paper").join(figure.file);
        let picture = image::open(&file).expect("a picture").into_rgb8();
        assert_eq!(picture.width() as usize, figure.painting.width, "{}", figure.file);
        assert!(
            picture.as_raw() == figure.painting.pixels.as_flattened(),
            "{} is not what is drawn today",
            figure.file
        );
    }
}
