//! What the name of a file says: by its ending, its extension, or a word.

use super::Role;
use super::tables::{ASIDE, COUNTED, EXTENSIONS, KICAD, NEVER_MILLED, PARTS, SIDE_WORDS, SIDES, WORDS};
use super::words::words;
use crate::board::Side;

/// Whether a Gerber of this name draws the holes and no picture of them: pcb-rnd's
/// `amp.global.virtual.pdrill.none.gbr` and `udrill`.
pub(in crate::import) fn draws_holes(name: &str) -> bool {
    let words = words(name, false);
    words.windows(2).any(|pair| pair[0] == "virtual" && matches!(pair[1].as_str(), "pdrill" | "udrill"))
}

/// The side that a word names.
fn side_of(word: &str) -> Option<Side> {
    SIDE_WORDS.iter().find(|(_, words)| words.contains(&word)).map(|&(side, _)| side)
}

fn looked_up(table: &[(&str, Role)], mut fits: impl FnMut(&str) -> bool) -> Option<Role> {
    table.iter().find(|(text, _)| fits(text)).map(|&(_, role)| role)
}

/// A name without its extension as it is compared with KiCad's endings.
fn normal(stem: &str) -> String {
    stem.to_ascii_lowercase().replace(['.', '-', ' '], "_")
}

/// The ending of KiCad's that a name has.
fn kicad_ending(normal: &str) -> Option<&'static (&'static str, Role)> {
    KICAD.iter().find(|(end, _)| normal == *end || normal.ends_with(&format!("_{end}")))
}

/// The role that a file's name tells; `shared` bytes at its start are the same for all files and
/// tell nothing.
pub(in crate::import) fn role_by_name(name: &str, shared: usize) -> Option<Role> {
    let (stem, extension) = name.rsplit_once('.').unwrap_or((name, ""));
    let extension = extension.to_ascii_lowercase();
    let normal = normal(stem);
    let inner =
        |text: &str| text.rsplit('_').nth(1).is_some_and(|word| numbered(word, &["in", "inner"]).is_some());
    kicad_ending(&normal)
        .map(|&(_, role)| role)
        .or_else(|| (normal.ends_with("_cu") && inner(&normal)).then_some(Role::Other("inner copper")))
        .or_else(|| looked_up(EXTENSIONS, |known| known == extension))
        .or_else(|| numbered(&extension, &["g", "gp", "l", "ly", "in"]).map(|_| Role::Other("inner copper")))
        .or_else(|| numbered(&extension, &["gm"]).map(|_| Role::Other("mechanical layer")))
        .or_else(|| role_by_extension(stem).filter(|_| extension == "txt" || is_gerber_by_extension(name)))
        .or_else(|| role_by_words(&extension_words(name, stem.len())))
        .or_else(|| role_by_words(&words(stem.get(shared..).unwrap_or(stem), false)))
        .or_else(|| role_by_words(&words(stem.get(shared..).unwrap_or(stem), true)))
}

/// The role that a file's extension alone tells.
pub(in crate::import) fn role_by_extension(name: &str) -> Option<Role> {
    let extension = name.rsplit_once('.')?.1.to_ascii_lowercase();
    looked_up(EXTENSIONS, |known| known == extension)
}

/// The role that a name tells for sure: KiCad's endings, and extensions that say it all or speak.
pub(in crate::import) fn role_by_sure_name(name: &str) -> Option<Role> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let by_ending = kicad_ending(&normal(stem));
    by_ending
        .map(|&(_, role)| role)
        .filter(|_| is_gerber_by_extension(name))
        .or_else(|| role_by_extension(name))
        .or_else(|| role_by_words(&extension_words(name, stem.len())).filter(|_| stem.len() < name.len()))
}

/// The kind of layer that a name tells, beyond a side: not by words that any layer's name may hold,
/// nor by numbers; and no mechanical layer, which programs use for anything.
pub(in crate::import) fn kind_by_name(name: &str, shared: usize) -> Option<Role> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let by_words = |words: Vec<String>| {
        role_by_parts(&words).or_else(|| looked_up(ASIDE, |known| words.iter().any(|word| word == known)))
    };
    role_by_sure_name(name)
        .or_else(|| by_words(words(stem.get(shared..).unwrap_or(stem), false)))
        .filter(|role| !matches!(role, Role::Group(_) | Role::Other("inner copper" | "mechanical layer")))
}

/// Whether a layer that is set aside is so beyond doubt: by KiCad's name, or by a whole word for
/// what nobody mills.
pub(in crate::import) fn is_surely_aside(name: &str, role: &str) -> bool {
    let normal = normal(name);
    let whole = |word: &String| NEVER_MILLED.contains(&word.trim_end_matches(|c: char| c.is_ascii_digit()));
    match role {
        "inner copper" => normal.ends_with("_cu"),
        "pad master" | "mechanical layer" => false,
        _ => {
            kicad_ending(&normal).is_some()
                || [false, true].iter().any(|&in_capitals| words(name, in_capitals).iter().any(whole))
        }
    }
}

/// The side that a name tells, of a layer of any kind: by KiCad's ending, the extension, or the
/// last word that is a side.
pub(in crate::import) fn side_by_name(name: &str, shared: usize) -> Option<Side> {
    let (stem, extension) = name.rsplit_once('.').unwrap_or((name, ""));
    let extension = extension.to_ascii_lowercase();
    if let Some((ending, _)) = kicad_ending(&normal(stem)) {
        return match ending.get(..2) {
            Some("f_") => Some(Side::Front),
            Some("b_") => Some(Side::Back),
            _ => None,
        };
    }
    let by_extension =
        || SIDES.iter().find(|(_, all)| all.contains(&extension.as_str())).map(|&(side, _)| side);
    let of_word = |word: &String| side_of(word.trim_end_matches(|c: char| c.is_ascii_digit()));
    let by_words = |words: Vec<String>| words.iter().rev().find_map(of_word);
    let rest = stem.get(shared..).unwrap_or(stem);
    by_extension()
        .or_else(|| by_words(extension_words(name, stem.len())))
        .or_else(|| by_words(words(rest, false)))
        .or_else(|| by_words(words(rest, true)))
}

/// Whether a name has an extension that Gerber files have, and says nothing more by it.
pub(in crate::import) fn is_gerber_by_extension(name: &str) -> bool {
    const GERBER: [&str; 9] = ["gbr", "ger", "gerber", "grb", "gbx", "gdo", "pho", "art", "gb"];
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    GERBER.iter().any(|known| extension.eq_ignore_ascii_case(known))
}

/// The words of an extension that speaks: `.StopTop`, `.Outline`; none of one of three letters.
fn extension_words(name: &str, stem: usize) -> Vec<String> {
    let extension = name.get(stem..).unwrap_or_default();
    if extension.len() > 4 { words(extension, false) } else { Vec::new() }
}

/// The role that a part of a word tells, or two words that are one elsewhere: `BoardFigure`.
fn role_by_parts(words: &[String]) -> Option<Role> {
    let in_two =
        |part: &str| words.windows(2).any(|pair| part.strip_prefix(pair[0].as_str()) == Some(&pair[1]));
    looked_up(PARTS, |part| words.iter().any(|word| word.contains(part)) || in_two(part))
}

/// The role that a whole word names.
fn role_of_word(word: &str) -> Option<Role> {
    side_of(word).map(Role::Copper).or_else(|| looked_up(WORDS, |known| known == word))
}

fn role_by_words(words: &[String]) -> Option<Role> {
    let inner = || words.iter().any(|word| numbered(word, &["in", "inner", "mid"]).is_some());
    role_by_parts(words)
        .or_else(|| looked_up(ASIDE, |known| words.iter().any(|word| word == known)))
        .or_else(|| words.iter().rev().find_map(|word| role_of_word(word)))
        .or_else(|| words.iter().rev().find_map(|word| side_with_number(word)))
        .or_else(|| inner().then_some(Role::Other("inner copper")))
        .or_else(|| counted(words).map(Role::Group))
}

/// The side that a word names with a number behind it: `top1`.
fn side_with_number(word: &str) -> Option<Role> {
    let bare = word.trim_end_matches(|c: char| c.is_ascii_digit());
    role_of_word(bare).filter(|role| matches!(role, Role::Copper(_)))
}

/// The number of a counted layer, in one word with what is counted or behind it.
fn counted(words: &[String]) -> Option<u32> {
    let in_one = words.iter().rev().find_map(|word| numbered(word, &COUNTED));
    let pair = |pair: &[String]| COUNTED.contains(&pair[0].as_str()).then(|| pair[1].parse().ok())?;
    in_one.or_else(|| words.windows(2).rev().find_map(pair))
}

/// The number behind one of `heads`: `gp1`, `group2`.
fn numbered(word: &str, heads: &[&str]) -> Option<u32> {
    heads.iter().find_map(|head| word.strip_prefix(head)?.parse().ok())
}
