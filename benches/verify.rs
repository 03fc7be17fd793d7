//! Judging a board's programs beside making them: the bound is once the time.

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use voromill::import::{self, Selection};
use voromill::job::{self, Options, Settings};

fn boards(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("verify");
    group.sample_size(10);
    for name in ["blinker", "regulator", "qfn-breakout"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(name);
        let settings = Settings::resolve(Options::default()).expect("the defaults are valid");
        let load = || import::load(std::slice::from_ref(&folder), &Selection::default()).expect("a fixture");
        let job = job::mill(load(), &settings).expect("a fixture can be milled");
        group.bench_function(format!("{name}/mill"), |bencher| {
            bencher.iter_with_setup(load, |loaded| job::mill(black_box(loaded), &settings));
        });
        group.bench_function(format!("{name}/verify"), |bencher| {
            bencher.iter(|| black_box(&job).verify(&settings));
        });
    }
    group.finish();
}

criterion_group!(benches, boards);
criterion_main!(benches);
