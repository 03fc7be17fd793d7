//! Damaged KiCad boards: whatever the bytes, a layout that keeps its promises or an error; never a
//! panic, never a hang.

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use voromill::geometry::{Nm, Point};
use voromill::import::kicad::read;

use crate::cases;

/// What boards are made of, and some of what they should not hold.
const WORDS: &[&str] = &[
    "(",
    ")",
    "\"",
    "\n",
    "\0",
    " ",
    "\\",
    "# ",
    "1",
    "-1.5",
    "1073.741823",
    "-1073.741823",
    "1e9",
    "0.0000001",
    "yes",
    "no",
    "(at 10 10 33.3)",
    "(at 1073 -1073 45)",
    "(start 0 0)",
    "(mid 1 0.0001)",
    "(mid 5 5)",
    "(end 10 0)",
    "(end 0 0)",
    "(center 5 5)",
    "(angle 90)",
    "(angle -1e6)",
    "(width 0.2)",
    "(width -1)",
    "(stroke (width 0.1) (type dash))",
    "(fill yes)",
    "(fill none)",
    "(layer F.Cu)",
    "(layer \"Edge.Cuts\")",
    "(layers \"*.Cu\")",
    "(layers F&B.Cu)",
    "(net 1 \"GND\")",
    "(net 1)",
    "(pts (xy 0 0) (xy 5 0) (xy 5 5) (xy 0 5))",
    "(pts (xy 0 0) (xy 5 5) (xy 5 0) (xy 0 5))",
    "(pts (arc (start 0 0) (mid 1 1) (end 2 0)))",
    "(size 2 1)",
    "(size 0 0)",
    "(drill 0.8)",
    "(drill oval 0.8 2 (offset 0.3 0))",
    "(roundrect_rratio 0.25)",
    "(chamfer_ratio 9) (chamfer top_left bottom_right)",
    "(rect_delta 9 9)",
    "(remove_unused_layers)",
    "(min_thickness 0.25)",
    "(gr_line ",
    "(gr_arc ",
    "(gr_circle ",
    "(gr_rect ",
    "(gr_poly ",
    "(gr_curve ",
    "(fp_line ",
    "(gr_text \"x\" ",
    "(segment ",
    "(arc ",
    "(via ",
    "(via blind ",
    "(zone ",
    "(filled_polygon ",
    "(footprint \"x\" ",
    "(pad 1 smd rect ",
    "(pad 1 thru_hole oval ",
    "(pad \"\" np_thru_hole circle ",
    "(pad 1 smd roundrect ",
    "(pad 1 smd trapezoid ",
    "(pad 1 smd custom ",
    "(primitives ",
    "(general (thickness 1.6))",
    "(setup (aux_axis_origin 1 2) (pcbplotparams (useauxorigin yes)))",
    "(version 20990101)",
];

fn text() -> impl Strategy<Value = Vec<u8>> {
    let words = prop::collection::vec(prop::sample::select(WORDS), 0..80);
    words.prop_map(|words| {
        let text = words.concat();
        let open = text.matches('(').count().saturating_sub(text.matches(')').count());
        format!("(kicad_pcb {text}{})", ")".repeat(open)).into_bytes()
    })
}

/// One whole thing of parts in any order: most are incomplete, some are not.
fn thing() -> impl Strategy<Value = Vec<u8>> {
    let is_part = |word: &&&str| word.starts_with('(') && word.ends_with(')');
    let is_head = |word: &&&str| word.starts_with('(') && word.ends_with(' ');
    let parts: Vec<&str> = WORDS.iter().filter(is_part).copied().collect();
    let heads: Vec<&str> = WORDS.iter().filter(is_head).copied().collect();
    let parts = prop::collection::vec(prop::sample::select(parts), 3..14);
    (prop::sample::select(heads), parts).prop_map(|(head, parts)| {
        let wrap = if head.starts_with("(pad") { ["(footprint x (at 3 4 30)", ")"] } else { ["", ""] };
        format!("(kicad_pcb {}{head}{}){})", wrap[0], parts.join(" "), wrap[1]).into_bytes()
    })
}

/// A board of our own with pieces cut out, doubled and overwritten.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    let files = ["boards/blinker/blinker.kicad_pcb", "kicad/shapes.kicad_pcb"];
    let files: Vec<Vec<u8>> =
        files.iter().map(|file| fs::read(folder.join(file)).expect("a fixture")).collect();
    let wound = (any::<prop::sample::Index>(), 0_usize..40, prop::sample::select(WORDS), 0_u8..4);
    (prop::sample::select(files), prop::collection::vec(wound, 1..8)).prop_map(|(mut bytes, wounds)| {
        for (place, length, word, kind) in wounds {
            let at = place.index(bytes.len() + 1);
            let end = (at + length).min(bytes.len());
            match kind {
                0 => drop(bytes.drain(at..end)),
                1 => drop(bytes.splice(at..at, word.bytes())),
                2 => drop(bytes.splice(at..end, word.bytes())),
                _ => bytes.extend_from_within(at..end),
            }
        }
        bytes
    })
}

/// Reads `bytes` and checks what a layout promises.
fn survives(bytes: &[u8]) {
    let layout = match read("damaged.kicad_pcb", bytes) {
        Ok(layout) => layout,
        Err(error) => {
            assert!(!error.render().is_empty(), "it says something");
            return;
        }
    };
    let in_range = |p: Point| p.x.abs() <= Nm::MAX && p.y.abs() <= Nm::MAX;
    for image in [&layout.front, &layout.back, &layout.edge] {
        for feature in &image.features {
            let bounds = feature.shape.bounds();
            assert!(in_range(bounds.min()) && in_range(bounds.max()), "{feature:?} is out of range");
            assert!((feature.attributes as usize) < image.attributes.len(), "{feature:?}: attributes");
        }
    }
    for hole in &layout.holes {
        assert!(hole.diameter > Nm::ZERO && in_range(hole.bounds().max()), "{hole:?}");
    }
}

proptest! {
    #![proptest_config(cases::same(300, 9))]

    #[test]
    fn damaged_boards_are_read_or_refused(bytes in damaged()) {
        survives(&bytes);
    }

    #[test]
    fn parts_in_any_order_are_read_or_refused(bytes in thing()) {
        survives(&bytes);
    }

    #[test]
    fn words_in_any_order_are_read_or_refused(bytes in text()) {
        survives(&bytes);
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        survives(&[b"(kicad_pcb ".as_slice(), &bytes].concat());
    }
}
