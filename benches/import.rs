//! Time to read Gerber files: a real board, and ten megabytes each of what large files are full of.

#![expect(clippy::print_stdout, reason = "a bench says what it measured on")]

use std::fmt::Write;
use std::fs;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};

use voromill::import::gerber::{Options, read};

const HEADER: &str = "%FSLAX46Y46*%\n%MOMM*%\n\
    %AMRoundRect*21,1,$1-2x$3,$2,0,0,0*21,1,$1,$2-2x$3,0,0,0*\
    1,1,2x$3,$1/2-$3,$2/2-$3*1,1,2x$3,$1/2-$3,-$2/2+$3*1,1,2x$3,-$1/2+$3,$2/2-$3*1,1,2x$3,-$1/2+$3,-$2/2+$3*%\n\
    %ADD10C,0.2*%\n%ADD11R,1.5X0.6*%\n%ADD12RoundRect,1.5X0.6X0.15*%\n";

/// A file of `bytes` bytes: the header, then what `line` writes for 0, 1, 2, …
fn file(bytes: usize, line: impl Fn(&mut String, usize)) -> String {
    let mut text = HEADER.to_owned();
    for index in 0.. {
        if text.len() > bytes {
            break;
        }
        line(&mut text, index);
    }
    text + "M02*\n"
}

/// The place of the pad with this number, in nanometres, on a square of 300 mm.
fn place(index: usize) -> (usize, usize) {
    (1_000_000 + index % 150 * 2_000_000, 1_000_000 + index / 150 % 300 * 1_000_000)
}

fn traces(text: &mut String, index: usize) {
    let (x, y) = place(index);
    if index.is_multiple_of(8) {
        let _ = writeln!(text, "D10*\nX{x}Y{y}D02*");
    }
    let _ = writeln!(text, "X{}Y{}D01*", x + 500_000, y + index % 3 * 250_000);
}

fn flashes(text: &mut String, index: usize) {
    let (x, y) = place(index);
    if index.is_multiple_of(16) {
        let _ = writeln!(text, "D{}*\n%TO.N,Net-{}*%", 10 + index / 16 % 3, index / 64);
    }
    let _ = writeln!(text, "X{x}Y{y}D03*");
}

/// A ground plane with a square hole round every pad, each joined to the outline by a cut-in.
fn plane(holes: usize) -> String {
    let mut text = HEADER.to_owned() + "G36*\nX0Y0D02*\n";
    let rows = holes / 150;
    for row in 0..rows {
        let y = 1_000_000 + row * 1_000_000;
        let _ = writeln!(text, "Y{y}D01*");
        for column in 0..150 {
            let x = 1_000_000 + column * 2_000_000;
            let (low, high) = (y - 300_000, y + 300_000);
            let _ = writeln!(text, "X{x}Y{y}D01*\nY{high}D01*\nX{}D01*\nY{low}D01*\nX{x}D01*", x + 900_000);
            let _ = writeln!(text, "Y{y}D01*\nX0D01*");
        }
    }
    let top = 1_000_000 + rows * 1_000_000;
    let _ = writeln!(text, "Y{top}D01*\nX301000000D01*\nY0D01*\nX0D01*\nG37*");
    text + "M02*\n"
}

/// A plane from which a clear ring round every pad is erased before the pad is flashed.
fn erased(pads: usize) -> String {
    let mut text = HEADER.to_owned();
    text += "G36*\nX0Y0D02*\nX301000000D01*\nY301000000D01*\nX0D01*\nY0D01*\nG37*\n%LPC*%\n%ADD13C,0.9*%\n%ADD14C,0.6*%\nD13*\n";
    let flash = |text: &mut String, index| {
        let (x, y) = place(index);
        let _ = writeln!(text, "X{x}Y{y}D03*");
    };
    (0..pads).for_each(|index| flash(&mut text, index));
    text += "%LPD*%\nD14*\n";
    (0..pads).for_each(|index| flash(&mut text, index));
    text + "M02*\n"
}

fn bench(criterion: &mut Criterion) {
    const MEGABYTES: usize = 10 << 20;
    let board = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards/regulator/regulator-F_Cu.gbr");
    let cases = [
        ("regulator", fs::read_to_string(board).expect("the fixture is there")),
        ("traces", file(MEGABYTES, traces)),
        ("flashes", file(MEGABYTES, flashes)),
        ("plane", plane(4_500)),
        ("erased", erased(3_000)),
    ];
    let options = Options { vertices: u64::MAX, ..Options::default() };
    let mut group = criterion.benchmark_group("gerber");
    for (name, text) in &cases {
        let features = read(name, text.as_bytes(), &options).expect("it reads").features.len();
        println!("{name}: {} bytes, {features} features", text.len());
        group.throughput(Throughput::Bytes(text.len() as u64)).sample_size(10);
        group.bench_function(*name, |bencher| bencher.iter(|| read(name, text.as_bytes(), &options)));
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
