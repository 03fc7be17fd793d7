//! Distances between curves, which are rows of points close enough together.

use super::field::Spot;

/// The distance from `p` to the nearest of several polylines; infinite where there is none.
pub(crate) fn distance(p: Spot, lines: &[Vec<Spot>]) -> f64 {
    let chords = lines.iter().flat_map(|line| line.windows(2));
    chords.map(|chord| to_chord(p, chord[0], chord[1])).fold(f64::INFINITY, f64::min)
}

/// The distance from `p` to the line from `a` to `b`, ends included.
pub(crate) fn to_chord(p: Spot, a: Spot, b: Spot) -> f64 {
    let (way, from) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let squared = way[0] * way[0] + way[1] * way[1];
    let along = from[0] * way[0] + from[1] * way[1];
    let t = if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { 0.0 };
    let off = [from[0] - way[0] * t, from[1] - way[1] * t];
    (off[0] * off[0] + off[1] * off[1]).sqrt()
}

/// Points of a polyline no farther apart than `step`.
pub(crate) fn points(line: &[Spot], step: f64) -> Vec<Spot> {
    let mut points = Vec::new();
    for chord in line.windows(2) {
        let way = [chord[1][0] - chord[0][0], chord[1][1] - chord[0][1]];
        let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
        let count = (length / step).ceil().max(1.0);
        let mut place = 0.0;
        while place < count {
            let t = place / count;
            points.push([chord[0][0] + way[0] * t, chord[0][1] + way[1] * t]);
            place += 1.0;
        }
    }
    points.extend(line.last());
    points
}
