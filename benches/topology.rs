//! Time to find the nets of layers of 10³ … 10⁶ features: per feature it should stay the same.

#[path = "../tests/it/random.rs"]
mod random;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

use voromill::board::{Attributes, Axis, Copper, Feature, Shape, Side};
use voromill::geometry::{Nm, Point, Polygon, Rect, Vector};
use voromill::topology::{Method, recover, smallest_gap};

use random::splitmix64;

/// A splitmix64 generator: the same layer on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: i64) -> i64 {
        i64::try_from(splitmix64(&mut self.0) >> 33).expect("31 bits") % bound
    }
}

/// A layer of about `count` features on an area that grows with them: walks of a few strokes from
/// pad to pad, on a raster of half a millimetre, the pads round or rectangular.
fn layer(count: usize) -> Copper {
    let mut random = Random(1);
    let cells = i64::try_from(count).expect("small").isqrt().max(4) * 2;
    let pitch = Nm::new((500_000).min(Nm::MAX.get() / cells));
    let (trace, pad) = (pitch / 5, pitch * 3 / 10);
    let mut features = Vec::with_capacity(count + 8);
    while features.len() < count {
        let mut at = Point::new(pitch * random.below(cells), pitch * random.below(cells));
        for _ in 0..4 {
            let reach = Vector::new(pitch * (random.below(9) - 4), pitch * (random.below(9) - 4));
            let to = at + reach;
            if to != at {
                features.push(feature(Shape::Stroke { from: at, to, radius: trace / 2 }, Axis::Line(at, to)));
            }
            at = to;
        }
        features.push(feature(Shape::Disc { center: at, radius: pad }, Axis::Flash(at)));
        let rect = Rect::new(at, at + Vector::new(pad * 4, pad));
        features.push(feature(Shape::Polygon(Polygon::rectangle(rect)), Axis::Flash(at)));
    }
    Copper { side: Side::Front, features, attributes: vec![Attributes::default()] }
}

fn feature(shape: Shape, axis: Axis) -> Feature {
    Feature { shape, axis, attributes: 0, line: 1 }
}

fn nets(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("nets");
    group.sample_size(10);
    for count in [400, 1_000, 10_000, 100_000, 1_000_000] {
        let copper = layer(count);
        group.throughput(Throughput::Elements(u64::try_from(copper.features.len()).expect("small")));
        for (name, method) in [("coincidence", Method::Coincidence), ("contact", Method::Contact)] {
            let id = BenchmarkId::new(name, count);
            group.bench_with_input(id, &copper, |bench, copper| bench.iter(|| recover(copper, method)));
        }
    }
    group.finish();
}

fn gaps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("smallest gap");
    group.sample_size(10);
    for count in [400, 100_000] {
        let copper = layer(count);
        let found = recover(&copper, Method::Contact);
        let id = BenchmarkId::from_parameter(count);
        group.bench_with_input(id, &copper, |bench, copper| bench.iter(|| smallest_gap(copper, &found)));
    }
    group.finish();
}

criterion_group!(benches, nets, gaps);
criterion_main!(benches);
