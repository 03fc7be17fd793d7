//! The words of one line of a drill program, sorted by what they do.

use super::lex::Word;
use crate::geometry::Turn;

/// A command that makes more of a place than a hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cycle {
    /// `G85`, `G87`: a slot to the X and Y behind it.
    Slot,
    /// `G84`: a hole as wide as the X behind it, of many.
    DrilledCircle,
    /// `G32`, `G33`: a hole of the radius `A`, routed.
    RoutedCircle(Turn),
    /// `G82`: two rows of holes.
    DualInLine,
    /// `G83`: eight holes in a circle.
    RoundPack,
}

impl Cycle {
    const fn of(code: u32) -> Option<Self> {
        Some(match code {
            85 | 87 => Self::Slot,
            84 => Self::DrilledCircle,
            32 => Self::RoutedCircle(Turn::Clockwise),
            33 => Self::RoutedCircle(Turn::CounterClockwise),
            82 => Self::DualInLine,
            83 => Self::RoundPack,
            _ => return None,
        })
    }
}

/// The words of a line, sorted by what they do.
///
/// A tool that stands behind coordinates (`X2876Y1842T1`) is changed before they are drilled, as
/// the machines do; so the order of the words matters only for `G84` and `G85`, which part a place
/// from what is done there.
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
    /// `P`: how often the last package.
    pub(super) packages: Option<&'a Word>,
    /// What makes more of the place than a hole.
    pub(super) cycle: Option<Cycle>,
    /// X and Y behind `G84`, `G85` or `G87`.
    pub(super) beyond: Option<(Option<&'a Word>, Option<&'a Word>)>,
    /// X or Y where there was one already.
    pub(super) twice: Option<&'a Word>,
    /// Words of no known meaning.
    pub(super) unknown: Vec<&'a Word>,
}

impl<'a> Block<'a> {
    /// Sorts `words`.
    pub(super) fn new(words: &'a [Word]) -> Self {
        let mut block = Self::default();
        let mut times = false;
        for word in words {
            match (word.letter, &mut block.beyond) {
                // X behind G04 is a time.
                (b'X', _) if times => {}
                (b'X', Some((Some(_), _))) | (b'Y', Some((_, Some(_)))) => block.twice = Some(word),
                (b'X', Some((x, _))) => *x = Some(word),
                (b'Y', Some((_, y))) => *y = Some(word),
                (b'X', None) if block.x.is_some() => block.twice = Some(word),
                (b'Y', None) if block.y.is_some() => block.twice = Some(word),
                (b'X', None) => block.x = Some(word),
                (b'Y', None) => block.y = Some(word),
                (b'P', _) => block.packages = Some(word),
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
                    block.cycle = code.and_then(Cycle::of).or(block.cycle);
                    if matches!(block.cycle, Some(Cycle::Slot | Cycle::DrilledCircle)) {
                        block.beyond = Some((None, None));
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

    /// Whether `M02` repeats a pattern, which other words then mirror.
    pub(super) fn repeats_pattern(&self) -> bool {
        self.miscellaneous.iter().any(|word| matches!(word.number.integer(), Some(2 | 26)))
    }

    /// Whether a word that mirrors or swaps axes is there: `M70`, or `M23` in format 1.
    pub(super) fn has(&self, codes: [u32; 2]) -> bool {
        self.miscellaneous.iter().any(|word| word.number.integer().is_some_and(|code| codes.contains(&code)))
    }

    /// How often `R` says, 1 without; the word where that is no number.
    pub(super) fn repeats(&self) -> Result<u32, &'a Word> {
        self.repeat.map_or(Ok(1), |word| word.number.integer().ok_or(word))
    }
}
