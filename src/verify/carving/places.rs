//! Places that a grid may miss on a large drawing: along the edges of areas, and where the tip
//! goes.

use crate::geometry::between;

use super::super::edges::{Spot, length};

/// Places in a row are so far apart at least, in nanometres, and so many at most. Chosen: as many
/// take less time than those of a grid.
const NEAREST: f64 = 10_000.0;
const MOST: f64 = 1e5;

/// A place of a line: where, and the unit vector along the line; none of a line without length.
pub(super) type Along = (Spot, Option<Spot>);

/// Places along lines that follow each other, equally far apart; a line without length is a place.
pub(super) fn along<I>(lines: I) -> Vec<Along>
where
    I: Iterator<Item = [Spot; 2]> + Clone,
{
    let long = |[a, b]: [Spot; 2]| length((b.0 - a.0, b.1 - a.1));
    let pitch = (lines.clone().map(long).sum::<f64>() / MOST).max(NEAREST);
    let mut ahead = pitch / 2.0;
    let mut places = Vec::new();
    for line in lines {
        let [a, b] = line;
        let whole = long(line);
        if whole <= 0.0 {
            places.push((a, None));
            continue;
        }
        let way = ((b.0 - a.0) / whole, (b.1 - a.1) / whole);
        while ahead < whole {
            places.push((between(a, b, ahead / whole), Some(way)));
            ahead += pitch;
        }
        ahead -= whole;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_go_on_from_line_to_line() {
        let lines =
            [[(0.0, 0.0), (25_000.0, 0.0)], [(25_000.0, 0.0); 2], [(25_000.0, 0.0), (25_000.0, 10_000.0)]];
        let (right, up) = (Some((1.0, 0.0)), Some((0.0, 1.0)));
        let expected = [
            ((5_000.0, 0.0), right),
            ((15_000.0, 0.0), right),
            ((25_000.0, 0.0), None),
            ((25_000.0, 0.0), up),
        ];
        assert_eq!(along(lines.into_iter()), expected);
    }
}
