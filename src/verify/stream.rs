//! How a program's text reads before its codes count: what its lines look like, and which
//! characters controllers take out of the stream.

use std::collections::BTreeMap;

use crate::gcode::read::{Listing, Odd, Tally, lines};

use super::Program;

/// Something about a line that some controllers take otherwise than it reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Feature {
    /// What it does when it is run.
    Run(Odd),
    /// Code and a comment in parentheses.
    BesideComment,
    /// Code behind a comment in parentheses.
    BehindComment,
    /// A number without a checksum.
    Unchecked,
    /// A number that is not one more than the last.
    OutOfOrder,
    /// A parameter or an expression.
    Parameter,
    /// An O-word.
    Subprogram,
    /// An O-word that is more than the number of a program.
    Flow,
    /// A `/` at the beginning.
    Deleted,
    /// A beginning that Smoothieware does not know.
    Other,
    /// A lower-case letter at the beginning.
    LowerCase,
    /// A `%` that begins or ends a tape.
    Percent,
    /// More characters than Grbl keeps.
    Long,
    /// Code behind what Marlin keeps.
    Cut,
    /// A comment within a comment in parentheses.
    Nested,
    /// More of the outer comment behind it.
    Resumed,
    /// A number of more digits than Grbl takes.
    HighNumber,
}

/// So many characters of a line Grbl keeps, blanks and comments not counted (protocol.c of 1.1h).
const KEPT: usize = 79;

/// So many characters of a line Marlin keeps, blanks and comments in parentheses among them
/// (MAX_CMD_SIZE of 2.0).
const BUFFERED: usize = 96;

/// What lines begin with that Smoothieware runs (GcodeDispatch.cpp), and what is no code.
const BEGINNINGS: &str = "GMTSNXYZF%$";

/// The highest number of a line that Grbl takes (gcode.h of 1.1h).
const HIGHEST: u64 = 10_000_000;

/// What the lines of a program have, without the user's own G-code, by kind.
pub(super) fn features(text: &str, listing: &Listing) -> Vec<(Feature, Tally)> {
    let mut found: BTreeMap<Feature, Tally> =
        listing.odd.iter().map(|(&odd, &tally)| (Feature::Run(odd), tally)).collect();
    let mut last = None;
    for (line, text) in (1_u32..).zip(lines(text)).filter(|(_, text)| !is_plain(text)) {
        for feature in Text::of(text).features(&mut last) {
            found.entry(feature).or_insert(Tally { line, count: 0 }).count += 1;
        }
    }
    found.into_iter().collect()
}

/// Whether a line has no more than words and numbers, none of them its own: most have.
fn is_plain(line: &str) -> bool {
    let tells = |byte: u8| matches!(byte, b'#' | b'%' | b'(' | b'[' | b'N' | b'O' | b'n' | b'o');
    let begins = line.trim_start().chars().next().is_none_or(|c| BEGINNINGS.contains(c));
    begins && line.len() <= KEPT && !line.bytes().any(tells)
}

/// A line without blanks and comments, and where its comments in parentheses are.
#[derive(Default)]
struct Text {
    code: String,
    has_comment: bool,
    goes_on_behind: bool,
    is_nested: bool,
    /// Whether a comment goes on behind one within it.
    resumes: bool,
    /// What the code begins with.
    first: Option<char>,
    /// How many characters there are up to the last of the code.
    reach: usize,
}

impl Text {
    /// Comments in comments count as one: some write the name of a tool so.
    fn of(line: &str) -> Self {
        let (mut text, mut depth) = (Self::default(), 0_u32);
        // Whether a comment has ended within the one that is read.
        let mut inner_ended = false;
        for (before, c) in line.trim_start().chars().enumerate() {
            match c {
                '(' => {
                    text.is_nested |= depth > 0;
                    text.resumes |= depth > 0 && inner_ended;
                    inner_ended &= depth > 0;
                    depth += 1;
                }
                ')' if depth > 0 => {
                    depth -= 1;
                    inner_ended = depth > 0;
                }
                _ if depth > 0 => text.resumes |= inner_ended && !c.is_whitespace(),
                ';' => break,
                c if c.is_whitespace() || c.is_control() => {}
                c => {
                    text.goes_on_behind |= text.has_comment;
                    text.first = text.first.or(Some(c));
                    text.reach = before + 1;
                    text.code.push(c.to_ascii_uppercase());
                }
            }
            text.has_comment |= depth > 0;
        }
        text
    }

    /// What of it some take otherwise; `last` is the number of the last line that has one.
    fn features(&self, last: &mut Option<u64>) -> impl Iterator<Item = Feature> {
        let code = self.code.trim_start_matches('/');
        let (number, words) = numbered(code);
        let follows = number.zip(*last).is_none_or(|(number, last)| last.checked_add(1) == Some(number));
        // M110 sets the number that is counted from, as any number does here.
        let sets = words.contains("M110");
        *last = number.or(*last);
        let here = |is: bool, feature: Feature| is.then_some(feature);
        let label = words.strip_prefix('O').map(|name| name.trim_start_matches(|c: char| c.is_ascii_digit()));
        let flows = label.is_some_and(|rest| !rest.is_empty());
        let first = self.first;
        // What begins with `/` or O is told as that.
        let is_other = first.is_some_and(|c| c.is_ascii_uppercase() && c != 'O' && !BEGINNINGS.contains(c));
        let among = [
            here(self.has_comment && !code.is_empty(), Feature::BesideComment),
            here(self.goes_on_behind, Feature::BehindComment),
            here(number.is_some() && !code.contains('*'), Feature::Unchecked),
            here(!follows && !sets, Feature::OutOfOrder),
            here(code.contains(['#', '[']) && !code.starts_with('$'), Feature::Parameter),
            here(words.starts_with('O'), Feature::Subprogram),
            here(flows, Feature::Flow),
            here(first == Some('/'), Feature::Deleted),
            here(is_other, Feature::Other),
            here(first.is_some_and(|c| c.is_ascii_lowercase()), Feature::LowerCase),
            here(self.reach > BUFFERED, Feature::Cut),
            here(self.resumes, Feature::Resumed),
            here(code.starts_with('%'), Feature::Percent),
            here(code.chars().count() > KEPT, Feature::Long),
            here(self.is_nested, Feature::Nested),
            here(number.is_some_and(|number| number > HIGHEST), Feature::HighNumber),
        ];
        among.into_iter().flatten()
    }
}

/// The number of a line, and its words.
fn numbered(code: &str) -> (Option<u64>, &str) {
    let Some(rest) = code.strip_prefix('N') else { return (None, code) };
    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    match rest[..end].parse() {
        Ok(number) => (Some(number), &rest[end..]),
        Err(_) => (None, code),
    }
}

/// Characters that controllers take out of the stream at once, wherever they stand.
struct AtOnce {
    controllers: &'static [&'static str],
    /// Of a character and its bytes.
    takes: fn(char, &[u8]) -> bool,
    /// Whether in comments in parentheses, too.
    in_parentheses: bool,
}

const RESET: char = '\u{18}';

/// To hold the feed, to go on, to reset, and the overrides, which are bytes of letters with
/// accents, or characters where UTF-8 is decoded. TinyG empties its queue at `%`.
const AT_ONCE: &[AtOnce] = &[
    AtOnce {
        controllers: &["grbl"],
        takes: |c, bytes| matches!(c, '!' | '~' | RESET) || has_override(bytes),
        in_parentheses: true,
    },
    AtOnce { controllers: &["grblhal"], takes: |c, _| matches!(c, '!' | '~'), in_parentheses: false },
    AtOnce {
        controllers: &["grblhal"],
        takes: |c, bytes| c == RESET || has_override(bytes),
        in_parentheses: true,
    },
    AtOnce {
        controllers: &["fluidnc"],
        takes: |c, _| matches!(c, '!' | '~' | RESET | '\u{84}'..='\u{a1}'),
        in_parentheses: true,
    },
    AtOnce {
        controllers: &["tinyg"],
        takes: |c, _| matches!(c, '!' | '~' | '%' | RESET),
        in_parentheses: true,
    },
];

/// Whether one of these bytes is an override of Grbl.
fn has_override(bytes: &[u8]) -> bool {
    let takes = |byte: &u8| matches!(byte, 0x84 | 0x85 | 0x90..=0x97 | 0x99..=0x9e | 0xa0 | 0xa1);
    bytes.iter().any(takes)
}

/// The characters of a program that its controller takes at once, in the order of their first
/// occurrence.
pub(super) fn taken_at_once(program: &Program, controller: &str) -> Vec<(char, Tally)> {
    let text = &program.text;
    let mut found: Vec<(char, Tally)> = Vec::new();
    let rules: Vec<&AtOnce> = AT_ONCE.iter().filter(|rule| rule.controllers.contains(&controller)).collect();
    // Most programs have none.
    if !text.bytes().any(|byte| !byte.is_ascii() || matches!(byte, b'!' | b'~' | b'%' | 0x18)) {
        return found;
    }
    for (line, text) in (1_u32..).zip(lines(text)) {
        let mut within = false;
        for c in text.chars() {
            within = (within || c == '(') && c != ')';
            let mut utf8 = [0; 4];
            let byte = u8::try_from(c).ok().filter(|_| program.is_bytes);
            let bytes = match &byte {
                Some(byte) => std::slice::from_ref(byte),
                None => c.encode_utf8(&mut utf8).as_bytes(),
            };
            if !rules.iter().any(|rule| (rule.takes)(c, bytes) && (rule.in_parentheses || !within)) {
                continue;
            }
            match found.iter_mut().find(|(known, _)| *known == c) {
                Some((_, tally)) => tally.count += 1,
                None => found.push((c, Tally { line, count: 1 })),
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(lines: &str) -> Vec<(Feature, u32, u32)> {
        let found = features(lines, &Listing::default());
        found.into_iter().map(|(feature, tally)| (feature, tally.line, tally.count)).collect()
    }

    #[test]
    fn comments_lie_beside_code_before_it_or_alone() {
        assert_eq!(of("(end mill)\n; (a)\nG0 X1 ; (b (c))\n"), [], "alone");
        assert_eq!(of("(end mill (long))\n"), [(Feature::Nested, 1, 1)], "within one");
        assert_eq!(
            of("(a (long) mill)\n"),
            [(Feature::Nested, 1, 1), (Feature::Resumed, 1, 1)],
            "and more behind it"
        );
        assert_eq!(of("G0 X1\nG0 X1 (up)\n"), [(Feature::BesideComment, 2, 1)], "behind the code");
        assert_eq!(
            of("(on) M3\nG0 (up) Z2\n"),
            [(Feature::BesideComment, 1, 2), (Feature::BehindComment, 1, 2)],
            "before it"
        );
    }

    #[test]
    fn numbers_are_to_be_checked_and_to_follow_each_other() {
        assert_eq!(of("N1 G21*18\nN2 G90*27\n"), [], "as printers want them");
        assert_eq!(of("N5 M110*1\nN3 M110*1\nN4 G90*1\n"), [], "a number that is set");
        assert_eq!(
            of("N10 G21\nN20 G90\nG0 X1\nN21 M5\n"),
            [(Feature::Unchecked, 1, 3), (Feature::OutOfOrder, 2, 1)],
            "as CAM programs number lines"
        );
    }

    #[test]
    fn what_is_no_plain_code_is_seen() {
        assert_eq!(
            of("%\nO100 sub\n/N3 G0 Z[#1+3]\n"),
            [
                (Feature::Unchecked, 3, 1),
                (Feature::Parameter, 3, 1),
                (Feature::Subprogram, 2, 1),
                (Feature::Flow, 2, 1),
                (Feature::Deleted, 3, 1),
                (Feature::Percent, 1, 1),
            ]
        );
        assert_eq!(of("O0001\n"), [(Feature::Subprogram, 1, 1)], "the number of a program");
        assert_eq!(
            of("g0 X1\nI1 G0\n"),
            [(Feature::Other, 2, 1), (Feature::LowerCase, 1, 1)],
            "what begins otherwise"
        );
        let far = format!("G0 X1{}Y1 ; {}\n", " ".repeat(89), "=".repeat(90));
        assert_eq!(of(&far), [], "96 characters and a comment");
        assert_eq!(of(&far.replace("Y1", " Y1")), [(Feature::Cut, 1, 1)], "97 of them");
        let (kept, long) = ("X1 ".repeat(39) + "Y", "X1 ".repeat(39) + "Y1");
        assert_eq!(of(&kept), [(Feature::Cut, 1, 1)], "79 characters without blanks");
        assert_eq!(of(&long), [(Feature::Long, 1, 1), (Feature::Cut, 1, 1)], "80 of them");
    }
}
