//! What each file is for: by the job file, by its X2 file function, by its name.
//!
//! Every program names its layers differently, and people rename them. So three witnesses are
//! heard, in this order:
//!
//! 1. a Gerber job file (`.gbrjob`), which lists the files and their functions;
//! 2. the X2 attribute `.FileFunction` in the file itself (Gerber specification 2024.05 §5.6.3),
//!    also where KiCad and Eagle hide it in comments;
//! 3. the name, and where it tells nothing the one inside (`LN`): KiCad's `-F_Cu`, Altium's and
//!    Protel's `.GTL`, Eagle's `.cmp` and `copper_top`, EasyEDA's `Gerber_TopLayer`, DipTrace's
//!    `_Top`, gEDA's `.front` and `group1`, OrCAD's `.top`, what people call sides in other
//!    languages; also with an extension more, `.GTL.gbr`.
//!
//! Words of a name count only where they differ between the files: the board `solder-station` has
//! no back side for it.

use crate::board::{Plating, Side};

use super::excellon;

/// What a file is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Role {
    /// The copper of a side.
    Copper(Side),
    /// A group of layers of gEDA's `pcb`, which numbers them from the component side.
    Group(u32),
    /// The edge of the board.
    Outline,
    /// Holes.
    Drill,
    /// Anything that is not milled, with its name: `solder mask`, `inner copper`.
    Other(&'static str),
}

/// The value of `.FileFunction`, wherever in the head of a file it stands.
pub(super) fn function_of(bytes: &[u8]) -> Option<String> {
    value_of(&bytes[..bytes.len().min(64 * 1024)], b"TF.FileFunction,")
}

/// What stands behind the first `name` in `head`, up to the end of the command or line.
fn value_of(head: &[u8], name: &[u8]) -> Option<String> {
    let start = head.windows(name.len()).position(|window| window == name)? + name.len();
    let value = head[start..].split(|b| matches!(b, b'*' | b'%' | b'\r' | b'\n')).next()?;
    Some(value.iter().map(|&b| char::from(b)).collect::<String>().trim().to_owned())
}

/// The name that a Gerber file calls its layer by, if it does (`LN`, specification 2024.05 §8.1.5):
/// `GLOBAL_BOUNDARY_UROUTE_7`.
pub(super) fn loaded_name(bytes: &[u8]) -> Option<String> {
    value_of(&bytes[..bytes.len().min(4 * 1024)], b"%LN")
}

/// Whether a Gerber of this name draws the holes and no picture of them: pcb-rnd's
/// `amp.global.virtual.pdrill.none.gbr` and `udrill`.
pub(super) fn draws_holes(name: &str) -> bool {
    let words = words(name, false);
    words.windows(2).any(|pair| pair[0] == "virtual" && matches!(pair[1].as_str(), "pdrill" | "udrill"))
}

/// File functions of what is not milled (Gerber specification 2024.05 §5.6.3).
const DOCUMENTATION: &[&str] = &[
    "ArrayDrawing",
    "AssemblyDrawing",
    "Carbonmask",
    "Component",
    "Depthrout",
    "Drawing",
    "FabricationDrawing",
    "Glue",
    "Goldmask",
    "Heatsinkmask",
    "Other",
    "OtherDrawing",
    "Pads",
    "Peelablemask",
    "Silvermask",
    "Tinmask",
    "Vcut",
    "Vcutmap",
    "Viafill",
];

/// What a file function says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Function {
    /// What the file is for.
    pub(super) role: Role,
    /// The side, of a layer of any kind.
    pub(super) side: Option<Side>,
}

impl Function {
    /// None for one that the specification has not.
    pub(super) fn read(function: &str) -> Option<Self> {
        let side = function.split(',').find_map(|field| match field.trim() {
            "Top" => Some(Side::Front),
            "Bot" => Some(Side::Back),
            _ => None,
        });
        Some(Self { role: role_by_function(function)?, side })
    }
}

/// The role that a file function names; none for one that the specification has not, as a damaged
/// byte makes it: then the name of the file decides.
pub(super) fn role_by_function(function: &str) -> Option<Role> {
    let mut fields = function.split(',').map(str::trim);
    Some(match fields.next()? {
        "Copper" => match (fields.next()?, fields.next()) {
            (_, Some("Top")) => Role::Copper(Side::Front),
            (_, Some("Bot")) => Role::Copper(Side::Back),
            (_, Some("Inr")) => Role::Other("inner copper"),
            _ => return None,
        },
        "Profile" => Role::Outline,
        "Plated" | "NonPlated" | "MixedPlating" => Role::Drill,
        "Soldermask" => Role::Other("solder mask"),
        "Paste" => Role::Other("paste"),
        "Legend" => Role::Other("silkscreen"),
        "Drillmap" => Role::Other("drill map"),
        other if DOCUMENTATION.contains(&other) => Role::Other("documentation"),
        _ => return None,
    })
}

/// Extensions that say it all.
const EXTENSIONS: &[(&str, Role)] = &[
    ("gtl", Role::Copper(Side::Front)),
    ("cmp", Role::Copper(Side::Front)),
    ("top", Role::Copper(Side::Front)),
    ("gbl", Role::Copper(Side::Back)),
    ("sol", Role::Copper(Side::Back)),
    ("bot", Role::Copper(Side::Back)),
    ("gko", Role::Outline),
    ("gm1", Role::Outline),
    ("gml", Role::Outline),
    ("oln", Role::Outline),
    ("mil", Role::Outline),
    ("dim", Role::Outline),
    ("drl", Role::Drill),
    ("drd", Role::Drill),
    ("xln", Role::Drill),
    ("exc", Role::Drill),
    ("tap", Role::Drill),
    ("cnc", Role::Drill),
    ("ncd", Role::Drill),
    ("gts", Role::Other("solder mask")),
    ("gbs", Role::Other("solder mask")),
    ("stc", Role::Other("solder mask")),
    ("sts", Role::Other("solder mask")),
    ("smt", Role::Other("solder mask")),
    ("smb", Role::Other("solder mask")),
    ("tsm", Role::Other("solder mask")),
    ("bsm", Role::Other("solder mask")),
    ("tsp", Role::Other("paste")),
    ("bsp", Role::Other("paste")),
    ("tsk", Role::Other("silkscreen")),
    ("bsk", Role::Other("silkscreen")),
    ("gtp", Role::Other("paste")),
    ("gbp", Role::Other("paste")),
    ("crc", Role::Other("paste")),
    ("crs", Role::Other("paste")),
    ("spt", Role::Other("paste")),
    ("spb", Role::Other("paste")),
    ("gto", Role::Other("silkscreen")),
    ("gbo", Role::Other("silkscreen")),
    ("plc", Role::Other("silkscreen")),
    ("pls", Role::Other("silkscreen")),
    ("ast", Role::Other("documentation")),
    ("asb", Role::Other("documentation")),
    ("sst", Role::Other("silkscreen")),
    ("ssb", Role::Other("silkscreen")),
    ("gpt", Role::Other("pad master")),
    ("gpb", Role::Other("pad master")),
    ("gd1", Role::Other("drill drawing")),
    ("gg1", Role::Other("drill guide")),
    ("ipc", Role::Other("netlist")),
    ("apr_lib", Role::Other("aperture macros")),
];

/// How KiCad's names end, old and new, with `.` and `-` written as `_`.
const KICAD: &[(&str, Role)] = &[
    ("f_cu", Role::Copper(Side::Front)),
    ("b_cu", Role::Copper(Side::Back)),
    ("edge_cuts", Role::Outline),
    ("pcb_edges", Role::Outline),
    ("f_mask", Role::Other("solder mask")),
    ("b_mask", Role::Other("solder mask")),
    ("f_paste", Role::Other("paste")),
    ("b_paste", Role::Other("paste")),
    ("f_silks", Role::Other("silkscreen")),
    ("b_silks", Role::Other("silkscreen")),
    ("f_silkscreen", Role::Other("silkscreen")),
    ("b_silkscreen", Role::Other("silkscreen")),
    ("f_adhes", Role::Other("glue")),
    ("b_adhes", Role::Other("glue")),
    ("f_fab", Role::Other("documentation")),
    ("b_fab", Role::Other("documentation")),
    ("f_crtyd", Role::Other("documentation")),
    ("b_crtyd", Role::Other("documentation")),
    ("margin", Role::Other("documentation")),
    ("dwgs_user", Role::Other("documentation")),
    ("cmts_user", Role::Other("documentation")),
    ("eco1_user", Role::Other("documentation")),
    ("eco2_user", Role::Other("documentation")),
];

/// Parts of words, the decisive first: what a name means that holds one of them.
const PARTS: &[(&str, Role)] = &[
    ("mask", Role::Other("solder mask")),
    ("resist", Role::Other("solder mask")),
    ("paste", Role::Other("paste")),
    ("cream", Role::Other("paste")),
    ("stencil", Role::Other("paste")),
    ("silk", Role::Other("silkscreen")),
    ("legend", Role::Other("silkscreen")),
    ("overlay", Role::Other("silkscreen")),
    ("assembly", Role::Other("documentation")),
    ("drawing", Role::Other("documentation")),
    ("document", Role::Other("documentation")),
    ("courtyard", Role::Other("documentation")),
    ("drillmap", Role::Other("drill map")),
    ("inner", Role::Other("inner copper")),
    ("internal", Role::Other("inner copper")),
    ("drill", Role::Drill),
    ("npth", Role::Drill),
    ("padmaster", Role::Other("pad master")),
    ("outline", Role::Outline),
    // As Siemens' tools spell it.
    ("outlline", Role::Outline),
    ("profile", Role::Outline),
    ("contour", Role::Outline),
    ("border", Role::Outline),
    // pcb-rnd's.
    ("boundary", Role::Outline),
    ("dimension", Role::Outline),
    ("cutout", Role::Outline),
    ("perimeter", Role::Outline),
    // Zuken's.
    ("boardfigure", Role::Outline),
    // As people name files in German, French, Spanish and Italian.
    ("stopp", Role::Other("solder mask")),
    ("masque", Role::Other("solder mask")),
    ("maschera", Role::Other("solder mask")),
    ("bestuck", Role::Other("silkscreen")),
    ("siebdruck", Role::Other("silkscreen")),
    ("serigra", Role::Other("silkscreen")),
    ("bohr", Role::Drill),
    ("percage", Role::Drill),
    ("taladro", Role::Drill),
    ("foratura", Role::Drill),
    ("umris", Role::Outline),
    ("kontur", Role::Outline),
    ("contorno", Role::Outline),
];

/// Whole words that set a layer aside, whatever else its name says: `StopTop`, `PosiBot`,
/// `TopAssy`.
const ASIDE: &[(&str, Role)] = &[
    ("stop", Role::Other("solder mask")),
    ("posi", Role::Other("silkscreen")),
    ("pads", Role::Other("pad master")),
    ("fab", Role::Other("documentation")),
    ("assy", Role::Other("documentation")),
    ("mid", Role::Other("inner copper")),
    ("intern", Role::Other("inner copper")),
    ("plane", Role::Other("inner copper")),
];

/// Whole words for the side of a layer of any kind.
const SIDE_WORDS: &[(Side, &[&str])] = &[
    (Side::Front, &["top", "front", "toplayer", "oben", "oberseite", "dessus", "superior", "sopra"]),
    (
        Side::Back,
        &["bottom", "bot", "back", "bottomlayer", "unten", "unterseite", "dessous", "inferior", "sotto"],
    ),
];

/// The side that a word names.
fn side_of(word: &str) -> Option<Side> {
    SIDE_WORDS.iter().find(|(_, words)| words.contains(&word)).map(|&(side, _)| side)
}

/// Whole words; where a name holds several of these or of the sides, the last counts.
const WORDS: &[(&str, Role)] = &[
    ("component", Role::Copper(Side::Front)),
    ("comp", Role::Copper(Side::Front)),
    ("solder", Role::Copper(Side::Back)),
    ("edge", Role::Outline),
    ("edges", Role::Outline),
    ("mechanical", Role::Outline),
    ("pth", Role::Drill),
    ("holes", Role::Drill),
];

/// Words before the number of a layer that is counted from the component side: gEDA's `group1`,
/// Zuken's `Conductive-1`, PADS' `art001`, and `L1`.
const COUNTED: [&str; 5] = ["group", "layer", "conductive", "art", "l"];

fn looked_up(table: &[(&str, Role)], mut fits: impl FnMut(&str) -> bool) -> Option<Role> {
    table.iter().find(|(text, _)| fits(text)).map(|&(_, role)| role)
}

/// The role that a file's name tells; `shared` bytes at its start are the same for all files and
/// tell nothing.
pub(super) fn role_by_name(name: &str, shared: usize) -> Option<Role> {
    let (stem, extension) = name.rsplit_once('.').unwrap_or((name, ""));
    let extension = extension.to_ascii_lowercase();
    let normal = stem.to_ascii_lowercase().replace(['.', '-', ' '], "_");
    let inner =
        |text: &str| text.rsplit('_').nth(1).is_some_and(|word| numbered(word, &["in", "inner"]).is_some());
    looked_up(KICAD, |end| normal == end || normal.ends_with(&format!("_{end}")))
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
pub(super) fn role_by_extension(name: &str) -> Option<Role> {
    let extension = name.rsplit_once('.')?.1.to_ascii_lowercase();
    looked_up(EXTENSIONS, |known| known == extension)
}

/// The role that a name tells for sure: KiCad's endings, and extensions that say it all or speak.
pub(super) fn role_by_sure_name(name: &str) -> Option<Role> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let normal = stem.to_ascii_lowercase().replace(['.', '-', ' '], "_");
    let by_ending = looked_up(KICAD, |end| normal == end || normal.ends_with(&format!("_{end}")));
    by_ending
        .filter(|_| is_gerber_by_extension(name))
        .or_else(|| role_by_extension(name))
        .or_else(|| role_by_words(&extension_words(name, stem.len())).filter(|_| stem.len() < name.len()))
}

/// The kind of layer that a name tells, beyond a side: not by words that any layer's name may hold,
/// nor by numbers; and no mechanical layer, which programs use for anything.
pub(super) fn kind_by_name(name: &str, shared: usize) -> Option<Role> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let by_words = |words: Vec<String>| {
        role_by_parts(&words).or_else(|| looked_up(ASIDE, |known| words.iter().any(|word| word == known)))
    };
    role_by_sure_name(name)
        .or_else(|| by_words(words(stem.get(shared..).unwrap_or(stem), false)))
        .filter(|role| !matches!(role, Role::Group(_) | Role::Other("inner copper" | "mechanical layer")))
}

/// Extensions of layers on one side.
const SIDES: &[(Side, &[&str])] = &[
    (
        Side::Front,
        &[
            "gtl", "cmp", "top", "gts", "stc", "smt", "tsm", "tsp", "tsk", "gtp", "crc", "spt", "gto", "plc",
            "sst", "gpt",
        ],
    ),
    (
        Side::Back,
        &[
            "gbl", "sol", "bot", "gbs", "sts", "smb", "bsm", "bsp", "bsk", "gbp", "crs", "spb", "gbo", "pls",
            "ssb", "gpb",
        ],
    ),
];

/// The side that a name tells, of a layer of any kind: by KiCad's ending, the extension, or the
/// last word that is a side.
pub(super) fn side_by_name(name: &str, shared: usize) -> Option<Side> {
    let (stem, extension) = name.rsplit_once('.').unwrap_or((name, ""));
    let (extension, normal) = (extension.to_ascii_lowercase(), stem.to_ascii_lowercase());
    let normal = normal.replace(['.', '-', ' '], "_");
    let ending = KICAD.iter().find(|(end, _)| normal == *end || normal.ends_with(&format!("_{end}")));
    if let Some((ending, _)) = ending {
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
pub(super) fn is_gerber_by_extension(name: &str) -> bool {
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

/// The words of a name in lower case: parted by anything but letters and digits, where a capital
/// follows a small letter, and where a letter follows a digit; with `in_capitals` also before the
/// last of several capitals, `PCBBottom`.
fn words(text: &str, in_capitals: bool) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    let mut rest = text.chars();
    while let Some(c) = rest.next() {
        let is_last = || rest.clone().next().is_some_and(|next| next.is_ascii_lowercase());
        let begins = match before {
            'a'..='z' => c.is_ascii_uppercase(),
            '0'..='9' => c.is_ascii_alphabetic(),
            'A'..='Z' => in_capitals && c.is_ascii_uppercase() && is_last(),
            _ => false,
        };
        let plain = without_accent(c);
        if !plain.is_ascii_alphanumeric() || begins {
            words.push(String::new());
        }
        if plain.is_ascii_alphanumeric() {
            words.last_mut().expect("never empty").push(plain.to_ascii_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// A letter of western Europe without its accent.
const fn without_accent(c: char) -> char {
    match c {
        'à'..='å' | 'À'..='Å' => 'a',
        'ç' | 'Ç' => 'c',
        'è'..='ë' | 'È'..='Ë' => 'e',
        'ì'..='ï' | 'Ì'..='Ï' => 'i',
        'ñ' | 'Ñ' => 'n',
        'ò'..='ö' | 'Ò'..='Ö' => 'o',
        'ù'..='ü' | 'Ù'..='Ü' => 'u',
        'ß' => 's',
        _ => c,
    }
}

/// How many bytes at the start all `names` share, up to the last mark that parts words; all of one
/// by which more than two begin, which is the board's name: `comp1.cmp`, `comp1.sol`, `comp1.drd`.
pub(super) fn shared_start(names: &[&str]) -> usize {
    /// A layer and its holes may have one name, `bottom.gbr` and `bottom.drl`. Chosen.
    const MANY: usize = 3;
    let Some((first, rest)) = names.split_first().filter(|(_, rest)| !rest.is_empty()) else { return 0 };
    let shared = rest.iter().fold(first.len(), |shared, name| {
        first.bytes().zip(name.bytes()).take(shared).take_while(|(a, b)| a == b).count()
    });
    let ends = |name: &&str| name.as_bytes().get(shared).is_none_or(|b| !b.is_ascii_alphanumeric());
    if names.len() >= MANY && names.iter().all(ends) {
        return shared;
    }
    first.as_bytes()[..shared].iter().rposition(|b| !b.is_ascii_alphanumeric()).map_or(0, |i| i + 1)
}

/// The plating that a drill file's function or name tells.
pub(super) fn plating(function: Option<&str>, name: &str) -> Plating {
    function.map_or_else(|| excellon::plating_by_name(name), excellon::plating_by_function)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRONT: Role = Role::Copper(Side::Front);
    const BACK: Role = Role::Copper(Side::Back);

    #[test]
    fn names_of_thirty_years_are_known() {
        let cases = [
            ("ecc83-pp-F_Cu.gbr", FRONT),
            ("multivibrator-B.Cu.gbr", BACK),
            ("amp-Edge.Cuts.gbr", Role::Outline),
            ("amp-In1_Cu.gbr", Role::Other("inner copper")),
            ("amp-F_Mask.gbr", Role::Other("solder mask")),
            ("amp-PTH.drl", Role::Drill),
            ("SE_SG_IF_V2.GTL", FRONT),
            ("pic18f14k50.gbl", BACK),
            ("pic18f14k50.gm1", Role::Outline),
            ("pic18f14k50.GP1", Role::Other("inner copper")),
            ("arduino-uno.cmp", FRONT),
            ("arduino-uno.sol", BACK),
            ("arduino-uno.stc", Role::Other("solder mask")),
            ("copper_top.gbr", FRONT),
            ("soldermask_top.gbr", Role::Other("solder mask")),
            ("solderpaste_bottom.gbr", Role::Other("paste")),
            ("silkscreen_bottom.gbr", Role::Other("silkscreen")),
            ("profile.gbr", Role::Outline),
            ("drills.xln", Role::Drill),
            ("Gerber_TopLayer.GTL", FRONT),
            ("Gerber_BoardOutlineLayer.GKO", Role::Outline),
            ("Gerber_InnerLayer1.G1", Role::Other("inner copper")),
            ("keyboard_Bottom.gbr", BACK),
            ("keyboard_BoardOutline.gbr", Role::Outline),
            ("keyboard_TopMask.gbr", Role::Other("solder mask")),
            ("hellboard.front.gbr", FRONT),
            ("hellboard.plated-drill.cnc", Role::Drill),
            ("hellboard.frontsilk.gbr", Role::Other("silkscreen")),
            ("numpres.pcb.output_group1.grb", Role::Group(1)),
            ("numpres.pcb.output_componentmask.grb", Role::Other("solder mask")),
            ("rs232_cm.top", FRONT),
            ("rs232_cm.bot", BACK),
            ("thruhole.tap", Role::Drill),
            ("top-cop.gbx", FRONT),
            ("IRNASIoTbank1.2.Top", FRONT),
            ("IRNASIoTbank1.2.StopTop", Role::Other("solder mask")),
            ("IRNASIoTbank1.2.PosiBot", Role::Other("silkscreen")),
            ("IRNASIoTbank1.2.Outline", Role::Outline),
            ("IRNASIoTbank1.2.Drill", Role::Drill),
            ("EtchLayerTop.gdo", FRONT),
            ("EtchLayerBottom.gdo", BACK),
            ("EtchLayer1Top.gdo", FRONT),
            ("EtchLayer2Bottom.gdo", BACK),
            ("etchlayer2bottom.gdo", BACK),
            ("PCBBottom.gbr", BACK),
            ("copper-top1.gbr", FRONT),
            ("BoardOutlline.gdo", Role::Outline),
            ("BOTTOM.art", BACK),
            ("PASTEMASK_TOP.art", Role::Other("solder mask")),
            ("clock - CADCAM Top Copper.TXT", FRONT),
            ("clock - CADCAM Top Solder Resist.TXT", Role::Other("solder mask")),
            ("clock - CADCAM Mechanical 1.TXT", Role::Outline),
            ("amp_COPPER-BOTTOM.gbr", BACK),
            ("amp_OUTLINES.gbr", Role::Outline),
            ("amp.toplayer.ger", FRONT),
            ("amp.internalplane1.ger", Role::Other("inner copper")),
            ("amp_Copper_Signal_Bot.gbr", BACK),
            ("amp_Pads_Top.gbr", Role::Other("pad master")),
            ("Conductive-2.gbr", Role::Group(2)),
            ("art001.pho", Role::Group(1)),
            ("amp-L4.gbr", Role::Group(4)),
            ("amp_copperTop.gtl", FRONT),
            ("amp_contour.gm1", Role::Outline),
            ("amp.global.boundary.uroute.9.gbr", Role::Outline),
            ("amp.intern.copper.none.5.gbr", Role::Other("inner copper")),
            ("amp.global.virtual.udrill.none.gbr", Role::Drill),
            ("GLOBAL_BOUNDARY_UROUTE_7", Role::Outline),
            ("amp_BoardFigure.gbr", Role::Outline),
            ("amp-pad_master.gbr", Role::Other("pad master")),
            ("amp-drill_map.gbr", Role::Other("drill map")),
            ("amp.GTL.gbr", FRONT),
            ("amp-B_Cu.gbl.gbr", BACK),
            ("amp.gts.txt", Role::Other("solder mask")),
            ("amp_Kupfer oben.gbr", FRONT),
            ("amp_Lötstopp unten.gbr", Role::Other("solder mask")),
            ("Unterseite.gbr", BACK),
            ("Bestückung_oben.gbr", Role::Other("silkscreen")),
            ("dessous.gbr", BACK),
            ("perçage.gbr", Role::Drill),
            ("cara superior.gbr", FRONT),
        ];
        for (name, role) in cases {
            assert_eq!(role_by_name(name, 0), Some(role), "{name}");
        }
        assert_eq!(role_by_name("example.grb", 0), None, "a name that tells nothing");
    }

    #[test]
    fn words_that_all_files_share_tell_nothing() {
        let names = ["solder-station.gbr", "solder-station-extra.gbr"];
        assert_eq!(shared_start(&names), "solder-".len(), "up to a mark");
        assert_eq!(role_by_name("solder-station.gbr", 7), None, "the board's name is no side");
        assert_eq!(shared_start(&["one.gbr"]), 0, "one file shares nothing");
        let alike = ["comp1", "comp1", "comp1-extra"];
        assert_eq!((shared_start(&alike), shared_start(&alike[..2])), (5, 0), "two may be of one layer");
    }

    #[test]
    fn file_functions_are_read_from_commands_and_comments() {
        for text in ["%TF.FileFunction,Copper,L2,Bot*%\n", "G04 #@! TF.FileFunction,Copper,L2,Bot,Signal*\n"]
        {
            let function = function_of(text.as_bytes()).expect("a function");
            assert_eq!(role_by_function(&function), Some(BACK), "{text}");
        }
        assert_eq!(role_by_function("Copper,L2,Inr"), Some(Role::Other("inner copper")), "an inner layer");
        assert_eq!(role_by_function("Profile,NP"), Some(Role::Outline), "the edge");
        assert_eq!(role_by_function("NonPlated,1,2,NPTH"), Some(Role::Drill), "holes");
        assert_eq!(role_by_function("Vcut,Top"), Some(Role::Other("documentation")), "not milled");
        for damaged in ["CoppeX,L2,Bot,Mixed", "Copper,L2,BoX,Mixed", "CopperXL2,Bot", ""] {
            assert_eq!(role_by_function(damaged), None, "{damaged}: the name decides");
        }
    }
}
