//! A font of strokes, drawn for this program: letters of board texts.
//!
//! KiCad's own font is not ours to carry, and none of the free ones is a library that could be. So
//! these letters differ from those that KiCad plots, in shape though not in size: capitals are as
//! high, lines as far apart, and a text is about a sixth narrower, so that it lies where the board
//! has room for it.
//!
//! A letter stands on a grid of eighths of the height of capitals:
//!
//! ```text
//!   y = 11   brackets       b
//!       10   capitals       a  ┬───┐
//!        7   small letters  7  │   │  ┬──┐
//!        2   the line       2  │   │  └──┘
//!        0   descenders     0  x = 0 … 6
//! ```

/// Eighths of the height of capitals between one letter and the next.
const BETWEEN: f64 = 3.0;
/// How wide a space is.
const SPACE: f64 = 3.0;
/// Where the line is on which letters stand.
const LINE: f64 = 2.0;
const EIGHTH: f64 = 0.125;

/// Letters and their strokes: words of points, a point a digit for x and one for y, both to the
/// base of 36. A word of one point is a dot.
const LETTERS: &[(char, &str)] = &[
    ('!', "0a05 02"),
    ('"', "0a08 3a38"),
    ('#', "2a12 5a42 0858 0454"),
    ('$', "493a1a090716364543321203 2b21"),
    ('%', "125a 09 53"),
    ('&', "5217192a3a49480503123255"),
    ('\'', "0a08"),
    ('(', "1b090311"),
    (')', "0b191301"),
    ('*', "2925 0846 0648"),
    ('+', "2824 0646"),
    (',', "1300"),
    ('-', "0646"),
    ('.', "02"),
    ('/', "014b"),
    ('0', "123243493a1a090312"),
    ('1', "081a12 0222"),
    ('2', "091a3a49470242"),
    ('3', "091a3a4947364543321203 1636"),
    ('4', "323a0444"),
    ('5', "4a0a07374643321203"),
    ('6', "493a1a090312324345361605"),
    ('7', "0a4a12"),
    ('8', "1607091a3a4947361605031232434536"),
    ('9', "03123243493a1a0907163647"),
    (':', "02 06"),
    (';', "16 1300"),
    ('<', "490643"),
    ('=', "0848 0444"),
    ('>', "094603"),
    ('?', "091a3a49472625 22"),
    ('@', "4534241517283847445364685a1a0804124252"),
    ('A', "022a42 1535"),
    ('B', "020a3a49473606 3645433202"),
    ('C', "493a1a0903123243"),
    ('D', "020a2a48442202"),
    ('E', "4a0a0242 0636"),
    ('F', "4a0a02 0636"),
    ('G', "493a1a09031232434626"),
    ('H', "0a02 4a42 0646"),
    ('I', "0a02"),
    ('J', "3a33221203"),
    ('K', "0a02 4a05 1642"),
    ('L', "0a0242"),
    ('M', "020a356a62"),
    ('N', "020a424a"),
    ('O', "124253594a1a090312"),
    ('P', "020a3a49473606"),
    ('Q', "124253594a1a090312 3551"),
    ('R', "020a3a49473606 2642"),
    ('S', "493a1a090716364543321203"),
    ('T', "0a4a 2a22"),
    ('U', "0a031232434a"),
    ('V', "0a224a"),
    ('W', "0a1238526a"),
    ('X', "0a42 024a"),
    ('Y', "0a264a 2622"),
    ('Z', "0a4a0242"),
    ('[', "1b0b0111"),
    ('\\', "0b41"),
    (']', "0b1b1101"),
    ('^', "072a47"),
    ('_', "0141"),
    ('`', "0b19"),
    ('a', "4637170603123243 4742"),
    ('b', "0a02 0617374643321203"),
    ('c', "4637170603123243"),
    ('d', "4a42 4637170603123243"),
    ('e', "05454637170603123243"),
    ('f', "3a2a1912 0727"),
    ('g', "4741301001 4637170603123243"),
    ('h', "0a02 0617374642"),
    ('i', "0702 0a"),
    ('j', "171100 1a"),
    ('k', "0a02 3704 1532"),
    ('l', "0a0312"),
    ('m', "0702 0617273632 3647576662"),
    ('n', "0702 0617374642"),
    ('o', "123243463717060312"),
    ('p', "0700 0617374643321203"),
    ('q', "4740 4637170603123243"),
    ('r', "0702 06172736"),
    ('s', "4637170615354443321203"),
    ('t', "1a132232 0727"),
    ('u', "0703123243 4742"),
    ('v', "072247"),
    ('w', "0712365267"),
    ('x', "0742 0247"),
    ('y', "0722 4710"),
    ('z', "07470242"),
    ('{', "2b1a1706151221"),
    ('|', "0b01"),
    ('}', "0b1a1726151201"),
    ('~', "05163546"),
    ('°', "18091a2918"),
    ('±', "2a26 0848 0343"),
    ('µ', "0700 03123243 4742"),
    ('μ', "0700 03123243 4742"),
    ('Ω', "02121305081a3a4845333242"),
];

/// A letter as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Glyph {
    /// Its strokes, in heights of capitals: from its left edge, from the line it stands on.
    pub(super) strokes: Vec<Vec<(f64, f64)>>,
    /// From its left edge to that of the next letter, without what a line's last letter ends with.
    pub(super) advance: f64,
}

/// How far apart two letters are, in heights of capitals.
pub(super) const GAP: f64 = BETWEEN * EIGHTH;

/// `letter`, if the font has it.
pub(super) fn glyph(letter: char) -> Option<Glyph> {
    if letter == ' ' {
        return Some(Glyph { strokes: Vec::new(), advance: (SPACE + BETWEEN) * EIGHTH });
    }
    let (_, words) = LETTERS.iter().find(|(known, _)| *known == letter)?;
    let digit = |byte: u8| char::from(byte).to_digit(36).map_or(0.0, f64::from);
    let place = |pair: &[u8]| (digit(pair[0]) * EIGHTH, (digit(pair[1]) - LINE) * EIGHTH);
    let strokes: Vec<Vec<_>> =
        words.split(' ').map(|word| word.as_bytes().chunks_exact(2).map(place).collect()).collect();
    let width = strokes.iter().flatten().map(|p: &(f64, f64)| p.0).fold(0.0, f64::max);
    Some(Glyph { strokes, advance: width + GAP })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_printable_letter_is_there_once_and_stays_on_its_grid() {
        for letter in (' '..='~').chain("°±µΩ".chars()) {
            let glyph = glyph(letter).unwrap_or_else(|| panic!("no {letter}"));
            assert!(glyph.advance >= GAP, "{letter}: {}", glyph.advance);
            for &(x, y) in glyph.strokes.iter().flatten() {
                assert!((0.0..=0.75).contains(&x) && (-0.25..=1.125).contains(&y), "{letter}: {x}, {y}");
            }
        }
        let mut letters: Vec<char> = LETTERS.iter().map(|letter| letter.0).collect();
        letters.sort_unstable();
        letters.dedup();
        assert_eq!(letters.len(), LETTERS.len(), "each once");
        assert!(LETTERS.iter().all(|(_, words)| words.split(' ').all(|word| word.len() % 2 == 0)), "pairs");
        assert_eq!(glyph('ж'), None);
    }

    #[test]
    fn no_two_letters_are_drawn_alike() {
        for (place, (a, drawn)) in LETTERS.iter().enumerate() {
            let twin = LETTERS[..place].iter().find(|(_, other)| other == drawn);
            let alike = twin.is_some_and(|(b, _)| !matches!((b, a), ('µ', 'μ') | ('0', 'O')));
            assert!(!alike, "{a} is drawn as {twin:?}");
        }
    }
}
