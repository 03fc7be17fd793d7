//! Parabolas by points.

use super::field::Spot;

/// The points equally far from a focus and a line through `a` and `b`, from one to another, as many
/// chords as `count` says of the length along the line and the height of the focus above it.
pub(crate) fn parabola(
    focus: Spot,
    [a, b]: [Spot; 2],
    from: Spot,
    to: Spot,
    count: impl Fn(f64, f64) -> f64,
) -> Vec<Spot> {
    let way = [b[0] - a[0], b[1] - a[1]];
    let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
    let along = way.map(|x| x / length);
    let local = |p: Spot| {
        let off = [p[0] - a[0], p[1] - a[1]];
        [off[0] * along[0] + off[1] * along[1], off[1] * along[0] - off[0] * along[1]]
    };
    let [x, height] = local(focus);
    let (start, end) = (local(from)[0], local(to)[0]);
    let count = count((end - start).abs(), height);
    let mut points = Vec::new();
    let mut place = 0.0;
    while place <= count {
        let u = start + (end - start) * place / count;
        let v = ((u - x) * (u - x) / height + height) / 2.0;
        points.push([a[0] + along[0] * u - along[1] * v, a[1] + along[1] * u + along[0] * v]);
        place += 1.0;
    }
    points
}
