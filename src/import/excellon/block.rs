use super::lex::Word;

/// The words of a line, sorted by what they do.
///
/// A tool that stands behind coordinates (`X2876Y1842T1`) is changed before they are drilled, as the machines do; so
/// the order of the words matters only for `G85`, which separates the two ends of a slot.
#[derive(Debug, Default)]
pub(super) struct Block<'a> {
    pub(super) tool: Option<&'a Word>,
    /// `C` behind `T`.
    pub(super) diameter: Option<&'a Word>,
    pub(super) general: Vec<&'a Word>,
    pub(super) miscellaneous: Vec<&'a Word>,
    pub(super) x: Option<&'a Word>,
    pub(super) y: Option<&'a Word>,
    pub(super) i: Option<&'a Word>,
    pub(super) j: Option<&'a Word>,
    /// `A`: an arc's radius.
    pub(super) radius: Option<&'a Word>,
    /// `R`: how often.
    pub(super) repeat: Option<&'a Word>,
    /// X and Y behind `G85` or `G87`.
    pub(super) slot: Option<(Option<&'a Word>, Option<&'a Word>)>,
    /// Words of no known meaning.
    pub(super) unknown: Vec<&'a Word>,
}

impl<'a> Block<'a> {
    /// Sorts `words`.
    pub(super) fn new(words: &'a [Word]) -> Self {
        let mut block = Self::default();
        let mut times = false;
        for word in words {
            match (word.letter, &mut block.slot) {
                // X behind G04 is a time.
                (b'X', _) if times => {}
                (b'X', Some((x, _))) => *x = Some(word),
                (b'Y', Some((_, y))) => *y = Some(word),
                (b'X', None) => block.x = Some(word),
                (b'Y', None) => block.y = Some(word),
                (b'I', _) => block.i = Some(word),
                (b'J', _) => block.j = Some(word),
                (b'A', _) => block.radius = Some(word),
                (b'R', _) => block.repeat = Some(word),
                (b'T', _) => block.tool = Some(word),
                (b'C', _) => block.diameter = Some(word),
                (b'M', _) => block.miscellaneous.push(word),
                (b'G', _) => {
                    let code = word.number.integer();
                    times |= code == Some(4);
                    if matches!(code, Some(85 | 87)) {
                        block.slot = Some((None, None));
                    }
                    block.general.push(word);
                }
                // Block numbers, feeds, speeds, hit counts, depths.
                (b'N' | b'F' | b'S' | b'B' | b'H' | b'Z' | b'Q' | b'U' | b'V', _) => {}
                _ => block.unknown.push(word),
            }
        }
        block
    }

    /// Whether X and Y are the new zero: `G92`, `G93`.
    pub(super) fn sets_zero(&self) -> bool {
        self.general.iter().any(|word| matches!(word.number.integer(), Some(92 | 93)))
    }

    /// How often `R` says, 1 without; the word where that is no number.
    pub(super) fn repeats(&self) -> Result<u32, &'a Word> {
        self.repeat.map_or(Ok(1), |word| word.number.integer().ok_or(word))
    }
}
