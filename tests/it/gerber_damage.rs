//! Damaged Gerber files: whatever the bytes, an image that keeps its promises or an error; never a
//! panic, never a hang.

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use voromill::board::Shape;
use voromill::geometry::{Nm, Point};
use voromill::import::gerber::{Options, read};

use crate::cases;

/// Small, so that a bomb is refused soon.
const LIMITS: Options = Options { features: 5_000, vertices: 50_000 };

/// What files are made of, and some of what they should not hold.
const WORDS: &[&str] = &[
    "*",
    "%",
    "\n",
    "\r",
    "\0",
    ",",
    "X",
    "Y",
    "I",
    "J",
    "D01*",
    "D02*",
    "D03*",
    "D10*",
    "D11*",
    "D12*",
    "D99*",
    "G01*",
    "G02*",
    "G03*",
    "G36*",
    "G37*",
    "G70*",
    "G71*",
    "G74*",
    "G75*",
    "G90*",
    "G91*",
    "G04 x*",
    "M02*",
    "0",
    "1",
    "-1",
    "1000000",
    "2500000",
    "-2500000",
    "1073741823",
    "99999999999999999",
    ".5",
    "-.5",
    "$1",
    "%FSLAX46Y46*%\n",
    "%FSTAX24Y24*%\n",
    "%FSLIX23Y23*%\n",
    "%MOMM*%\n",
    "%MOIN*%\n",
    "%ADD10C,1*%\n",
    "%ADD11R,2X0.5*%\n",
    "%ADD12O,1X2X0.5*%\n",
    "%ADD10P,3X5X12X1*%\n",
    "%AMA*",
    "1,1,$1,0,0*",
    "21,0,1,1,0,0,45*",
    "4,1,3,0,0,1,0,0,1,0,0,0*",
    "7,0,0,3,2,0.5,10*",
    "6,0,0,5,.5,.5,3,.1,6,0*",
    "$2=$1x2*",
    "%ADD11A,2*%\n",
    "%ABD12*%\n",
    "%AB*%\n",
    "%SRX3Y2I1J1*%\n",
    "%SR*%\n",
    "%LPC*%\n",
    "%LPD*%\n",
    "%LMXY*%\n",
    "%LR30*%\n",
    "%LS0.5*%\n",
    "%LS1000*%\n",
    "%IPNEG*%\n",
    "%MIA1B0*%\n",
    "%SFA2B.5*%\n",
    "%OFA1B-1*%\n",
    "%ASAYBX*%\n",
    "%IR90*%\n",
    "%TO.N,GND*%\n",
    "%TA.AperFunction,X*%\n",
    "%TD*%\n",
    "X0Y0D02*\n",
    "X5000000Y0D01*\n",
    "X5000000Y5000000D01*\n",
    "X0Y0I2500000J0D01*\n",
    "X3000000Y3000000D03*\n",
];

fn text() -> impl Strategy<Value = Vec<u8>> {
    let words = prop::collection::vec(prop::sample::select(WORDS), 0..120);
    words.prop_map(|words| format!("%FSLAX46Y46*%%MOMM*%%ADD10C,1*%D10*{}", words.concat()).into_bytes())
}

/// A fixture with pieces cut out, doubled and overwritten.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/gerber");
    let mut files: Vec<_> =
        fs::read_dir(folder).expect("fixtures").map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    let files: Vec<Vec<u8>> = files.iter().map(|file| fs::read(file).expect("a fixture")).collect();
    let wound = (any::<prop::sample::Index>(), 0_usize..12, prop::sample::select(WORDS), 0_u8..4);
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

/// Reads `bytes` and checks what an image promises.
fn survives(bytes: &[u8]) {
    let image = match read("damaged.gbr", bytes, &LIMITS) {
        Ok(image) => image,
        Err(error) => {
            assert!(!error.render().is_empty(), "it says something");
            return;
        }
    };
    let in_range = |p: Point| p.x.abs() <= Nm::MAX && p.y.abs() <= Nm::MAX;
    for feature in &image.features {
        let bounds = feature.shape.bounds();
        assert!(in_range(bounds.min()) && in_range(bounds.max()), "{feature:?} is out of range");
        assert!((feature.attributes as usize) < image.attributes.len(), "{feature:?} has no attributes");
        assert!(
            !matches!(feature.shape, Shape::Stroke { from, to, .. } if from == to),
            "{feature:?} is a disc"
        );
    }
    assert!(!image.features.is_empty() || !image.warnings.is_empty(), "nothing, and not a word about it");
}

proptest! {
    #![proptest_config(cases::same(300, 274))]

    #[test]
    fn damaged_files_are_read_or_refused(bytes in damaged()) {
        survives(&bytes);
    }

    #[test]
    fn words_in_any_order_are_read_or_refused(bytes in text()) {
        survives(&bytes);
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        survives(&[b"%FSLAX46Y46*%%MOMM*%%ADD10C,1*%D10*".as_slice(), &bytes].concat());
    }
}
