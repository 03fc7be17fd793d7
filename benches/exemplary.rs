//! One real board from bytes to G-code, the number people quote; and its stages, at several
//! resolutions.

use std::path::PathBuf;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

use voromill::board::Side;
use voromill::geometry::Nm;
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Settings};
use voromill::topology::{self, Method};
use voromill::voronoi::{self, Diagram};

fn fixture(board: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(board)
}

/// Files to programs, without pictures.
fn whole(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("mill");
    for board in ["blinker", "regulator", "qfn-breakout"] {
        let paths = [fixture(board)];
        group.bench_function(board, |bencher| {
            bencher.iter(|| {
                let loaded = import::load(&paths, &Selection::default()).expect("a board of ours");
                let settings = Settings::resolve(Options::default()).expect("the defaults");
                job::mill(loaded, &settings).expect("it is milled")
            });
        });
    }
    group.finish();
}

/// Nets, and boundaries at 250 to 2000 DPI: twice the resolution must cost little more than twice
/// the time.
fn stages(criterion: &mut Criterion) {
    let loaded = import::load(&[fixture("qfn-breakout")], &Selection::default()).expect("a board of ours");
    let copper = loaded.board.copper(Side::Front).expect("two sides");
    let outline = loaded.board.outline.as_ref();
    let mut group = criterion.benchmark_group("qfn-breakout front");
    group.bench_function("contact", |bencher| bencher.iter(|| topology::recover(copper, Method::Contact)));
    let nets = topology::recover(copper, Method::Contact);
    for dpi in [250_i64, 500, 1000, 2000] {
        let settings = voronoi::Settings { pitch: Nm::new(25_400_000 / dpi), ..voronoi::Settings::default() };
        group.bench_with_input(BenchmarkId::new("boundaries", dpi), &settings, |bencher, settings| {
            bencher.iter(|| Diagram::new(copper, &nets, outline, settings).expect("a diagram").boundaries());
        });
    }
    group.finish();
}

criterion_group! {
    name = exemplary;
    config = Criterion::default().sample_size(20);
    targets = whole, stages
}
criterion_main!(exemplary);
