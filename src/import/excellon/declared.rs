//! What the header and the comments of a drill file declare.
//!
//! Half of it stands in comments, each program its own way: `;FILE_FORMAT=2:4` (Altium, EasyEDA,
//! Eagle), `;FORMAT={3:3/ absolute / metric / suppress leading zeros}` and
//! `; #@! TF.FileFunction,…` (KiCad), `;TYPE=NON_PLATED` (Altium, EasyEDA),
//! `;Holesize 1. = 24.0 … PLATED MILS` and `;T01 Holesize 1. = 24.0 …` (OrCAD and Allegro, whose
//! tools have no `C`, and which may name none where it drills: then `M00` changes to the next).

use std::collections::BTreeMap;
use std::ops::Range;

use super::format::{Digits, Units, Zeros};
use super::lex::{Kind, Line, Word};
use crate::board::Plating;
use crate::geometry::Nm;

/// What a file says about itself; none where it does not.
#[derive(Clone, Debug, Default)]
pub(super) struct Declared {
    /// The first unit named, and where.
    pub(super) units: Option<(Units, Range<usize>)>,
    /// Which zeros are kept.
    pub(super) zeros: Option<Zeros>,
    /// Digits before and after the point.
    pub(super) digits: Option<Digits>,
    /// The X2 file function, `Plated,1,2,PTH`.
    pub(super) function: Option<String>,
    /// The program that wrote it.
    pub(super) generator: Option<String>,
    /// Tools that stand in comments only, by number.
    pub(super) commented: BTreeMap<u32, Commented>,
    /// Whether a tool is chosen anywhere.
    chooses_tools: bool,
    /// Whether `M30` ends it, or `M00` with no place behind it.
    pub(super) ended: bool,
    /// Whether `M30` was met.
    is_over: bool,
}

/// A tool of a table in comments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Commented {
    pub(super) diameter: Nm,
    /// The units that its size is given in.
    pub(super) units: Units,
    /// None where the table does not say.
    pub(super) plating: Option<Plating>,
}

impl Declared {
    /// Gathers what `lines` declare, wherever it stands.
    pub(super) fn gather(lines: &[Line]) -> Self {
        let mut declared = Self::default();
        for line in lines {
            match &line.kind {
                Kind::Comment(text) => declared.comment(text),
                Kind::Keyword(fields) => declared.keyword(fields, &line.place),
                Kind::Words(words) => declared.words(words, &line.place),
                Kind::BrokenTool(..) => declared.chooses_tools = true,
                Kind::Percent => {}
            }
        }
        declared
    }

    fn keyword(&mut self, fields: &[String], place: &Range<usize>) {
        let Some(units) = units_of(&fields[0]) else { return };
        self.units.get_or_insert((units, place.clone()));
        for field in &fields[1..] {
            self.zeros = self.zeros.or(match field.as_str() {
                "LZ" => Some(Zeros::Leading),
                "TZ" => Some(Zeros::Trailing),
                _ => None,
            });
            self.digits = self.digits.or_else(|| pattern(field));
        }
    }

    /// Whether tools change by a stop alone, in the order of the table.
    pub(super) fn changes_by_stops(&self) -> bool {
        !self.chooses_tools && !self.commented.is_empty()
    }

    /// The tool that comes after another in the table, the first where there is none before.
    pub(super) fn tool_after(&self, tool: Option<u32>) -> Option<u32> {
        self.commented.keys().copied().find(|&next| tool.is_none_or(|tool| next > tool))
    }

    fn words(&mut self, words: &[Word], place: &Range<usize>) {
        self.chooses_tools |= words.iter().any(|word| word.letter == b'T');
        self.ended &= self.is_over || !words.iter().any(Word::is_coordinate);
        for word in words.iter().filter(|word| word.letter == b'M') {
            match word.number.integer() {
                Some(71) => _ = self.units.get_or_insert((Units::Mm, place.clone())),
                Some(72) => _ = self.units.get_or_insert((Units::Inch, place.clone())),
                Some(0) => self.ended = true,
                Some(30) => (self.ended, self.is_over) = (true, true),
                _ => {}
            }
        }
    }

    fn comment(&mut self, text: &str) {
        let upper = text.to_ascii_uppercase();
        if let Some(format) = upper.strip_prefix("FILE_FORMAT=") {
            self.digits = self.digits.or_else(|| colon(format));
        } else if let Some(format) = upper.strip_prefix("FORMAT={") {
            self.kicad_format(format);
        } else if let Some(rest) = text.strip_prefix("#@! TF.") {
            self.attribute(rest);
        } else if let Some((tool, table)) = hole_table(&upper) {
            self.hole_size(tool, table);
        } else if let Some(start) = text.find("DRILL file {") {
            let named = text[start + 12..].split('}').next().unwrap_or_default();
            self.generator.get_or_insert_with(|| named.replace("KiCad ", "KiCad,"));
        } else if let Some(named) = text.strip_prefix("GenerationSoftware,") {
            self.generator.get_or_insert_with(|| named.trim_end_matches(['*', '%']).to_owned());
        } else if upper.starts_with("EASYEDA V") {
            self.generator.get_or_insert_with(|| text.split(',').next().unwrap_or(text).to_owned());
        }
    }

    fn attribute(&mut self, text: &str) {
        match text.split_once(',') {
            Some(("FileFunction", value)) => _ = self.function.get_or_insert_with(|| value.to_owned()),
            Some(("GenerationSoftware", value)) => self.generator = Some(value.to_owned()),
            _ => {}
        }
    }

    /// `3:3/ absolute / metric / suppress leading zeros}`; `-:-` with decimal points.
    fn kicad_format(&mut self, text: &str) {
        let mut fields = text.trim_end_matches('}').split('/').map(str::trim);
        self.digits = self.digits.or_else(|| colon(fields.next().unwrap_or_default()));
        for field in fields {
            self.zeros = self.zeros.or(match field {
                "SUPPRESS LEADING ZEROS" => Some(Zeros::Trailing),
                "SUPPRESS TRAILING ZEROS" => Some(Zeros::Leading),
                _ => None,
            });
        }
    }

    /// `HOLESIZE 1. = 24.000000 TOLERANCE = … PLATED MILS QUANTITY = 12`,
    /// `HOLESIZE 1 = 0.0120 INCH`; of the tool that stands before it, or else of the one that it
    /// counts.
    fn hole_size(&mut self, tool: Option<u32>, text: &str) {
        let mut words = text.split_whitespace().skip(1);
        let counted = words.next().and_then(|word| word.trim_end_matches('.').parse::<u32>().ok());
        let tool = tool.or(counted);
        let size = words.find(|&word| word != "=");
        let (mut unit, mut plating) = (None, None);
        for word in words {
            unit = unit.or(match word {
                "MILS" | "MIL" => Some(("mil", Units::Inch)),
                "INCH" | "INCHES" => Some(("in", Units::Inch)),
                "MM" | "MILLIMETERS" => Some(("mm", Units::Mm)),
                _ => None,
            });
            plating = plating.or(match word {
                "PLATED" => Some(Plating::Plated),
                "NON_PLATED" => Some(Plating::NonPlated),
                _ => None,
            });
        }
        let (Some(tool), Some(size), Some((unit, units))) = (tool, size, unit) else { return };
        if let Some(diameter) = format!("{size}{unit}").parse::<Nm>().ok().filter(|&d| d > Nm::ZERO) {
            self.commented.entry(tool).or_insert(Commented { diameter, units, plating });
        }
    }
}

/// A line of a table of tools: the tool that it names first, if it does, and what begins with
/// `HOLESIZE`.
fn hole_table(text: &str) -> Option<(Option<u32>, &str)> {
    let (head, rest) = text.split_at_checked(text.find("HOLESIZE")?)?;
    let head = head.trim();
    if head.is_empty() {
        return Some((None, rest));
    }
    Some((Some(head.strip_prefix('T')?.parse().ok()?), rest))
}

/// The units that a header command names.
pub(super) fn units_of(keyword: &str) -> Option<Units> {
    match keyword {
        "INCH" | "M72" => Some(Units::Inch),
        "METRIC" | "M71" => Some(Units::Mm),
        _ => None,
    }
}

/// Whether a comment says that the tools after it plate or do not.
pub(super) fn plating_of(comment: &str) -> Option<Plating> {
    let aperture = comment.strip_prefix("#@! TA.AperFunction,");
    let function = aperture.or_else(|| comment.strip_prefix("#@! TF.FileFunction,"));
    match function.map(|fields| fields.split(',').next().unwrap_or_default()) {
        Some("Plated") => return Some(Plating::Plated),
        Some("NonPlated") => return Some(Plating::NonPlated),
        Some(_) => return Some(Plating::Unknown),
        None => {}
    }
    match comment.to_ascii_uppercase().replace([' ', '-'], "_").as_str() {
        "TYPE=PLATED" => Some(Plating::Plated),
        "TYPE=NON_PLATED" | "TYPE=NONPLATED" => Some(Plating::NonPlated),
        _ => None,
    }
}

/// `2:4`.
fn colon(text: &str) -> Option<Digits> {
    let (whole, decimals) = text.trim().split_once(':')?;
    let (whole, decimals) = (whole.trim().parse().ok()?, decimals.trim().parse().ok()?);
    (whole <= 6 && decimals <= 6).then_some(Digits { whole, decimals })
}

/// `000.000`, `00.0000`: the digits by example.
fn pattern(text: &str) -> Option<Digits> {
    let (whole, decimals) = text.split_once('.')?;
    let zeros = |s: &str| s.bytes().all(|b| b == b'0').then(|| u8::try_from(s.len()).ok())?;
    let (whole, decimals) = (zeros(whole)?, zeros(decimals)?);
    (whole <= 6 && decimals <= 6).then_some(Digits { whole, decimals })
}
