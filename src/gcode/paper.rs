//! G-code as the paper's program writes it, to set beside a program of voromill's own.
//!
//! Its order is greedy: the path whose beginning is nearest to where the tool is, from zero on;
//! never backwards, never from another corner of a loop, and retracted between any two. Its words
//! are those of its release 3: a header of G21 G17 G40 G49 G80 G90, no spindle, the feed once a
//! path, five decimals at most.

use std::fmt::Write as _;

use crate::geometry::{Nm, Point};

/// Heights and feeds of the program's own defaults, in millimetres and millimetres a minute.
const CLEAR: &str = "1";
const CUT: &str = "-0.1";
const PLUNGE: &str = "60";
const MILL: &str = "250";

/// The program that cuts `paths`, polylines in board coordinates, in the paper's order.
#[must_use]
pub fn program(mut paths: Vec<Vec<Point>>) -> String {
    paths.retain(|path| path.len() > 1);
    let mut text = "G21\nG17\nG40\nG49\nG80\nG90\n".to_owned();
    let mut at = Point::default();
    while let Some(next) = (0..paths.len()).min_by_key(|&i| ((paths[i][0] - at).length_squared(), i)) {
        let path = paths.remove(next);
        let _ = writeln!(text, "G0 Z{CLEAR}\nG0 {}\nG1 Z{CUT} F{PLUNGE}", place(path[0]));
        for (i, &to) in path.iter().enumerate().skip(1) {
            let feed = if i == 1 { format!(" F{MILL}") } else { String::new() };
            let _ = writeln!(text, "G1 {}{feed}", place(to));
        }
        at = path[path.len() - 1];
    }
    let _ = writeln!(text, "G0 Z{CLEAR}\nM5\nM2");
    text
}

fn place(p: Point) -> String {
    format!("X{} Y{}", number(p.x), number(p.y))
}

/// Millimetres with five decimals at most.
fn number(length: Nm) -> String {
    let text = format!("{length:.5}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_taken_from_the_nearest_beginning() {
        let at = |x: i64, y: i64| Point::new(Nm::from_um(x), Nm::from_um(y));
        let text = program(vec![vec![at(5000, 0), at(1000, 0)], vec![at(2000, 0), at(4500, 1)]]);
        let expected = "G21\nG17\nG40\nG49\nG80\nG90\n\
            G0 Z1\nG0 X2 Y0\nG1 Z-0.1 F60\nG1 X4.5 Y0.001 F250\n\
            G0 Z1\nG0 X5 Y0\nG1 Z-0.1 F60\nG1 X1 Y0 F250\nG0 Z1\nM5\nM2\n";
        assert_eq!(text, expected, "the end at 1 mm is nearer than the beginning at 2 mm, and is not asked");
    }
}
