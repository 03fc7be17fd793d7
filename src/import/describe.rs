//! What a file is that is no layer.

use crate::board::Words;

const GIVE: Words =
    Words::of("give Gerber layers and Excellon drill files, their folder or a zip of them, or a KiCad board");
const EXPORT: Words =
    Words::of("export Gerber layers and an Excellon drill file from that program, and give those");
const JUDGE: Words = Words::of("`voromill verify` judges programs, and `voromill diff` compares them");
const SAVE: Words = Words::of("open it in KiCad, save it, and give its .kicad_pcb");
const TAKE_OVER: Words = Words::of("{millproject} takes the board and the options from it");
const UNPACK: Words = Words::of("unpack it, or give a zip");

/// How much of a file is looked at. Chosen: enough to see what a text is.
pub(super) const HEAD: usize = 1 << 16;

/// How files begin that are no layers, in lower case; what they are, and what a person can do.
const KNOWN: &[(&[u8], &str, Words)] = &[
    (b"\x89png", "a PNG picture", GIVE),
    (b"\xff\xd8\xff", "a JPEG picture", GIVE),
    (b"%pdf", "a PDF document", GIVE),
    (b"pk", "a zip archive", GIVE),
    (b"7z\xbc\xaf", "a 7z archive", UNPACK),
    (b"rar!", "a RAR archive", UNPACK),
    (b"\x1f\x8b", "a gzip archive", UNPACK),
    (b"(kicad_sch", "a KiCad schematic, not its board (.kicad_pcb)", GIVE),
    (b"(footprint", "a footprint, not a KiCad board (.kicad_pcb)", GIVE),
    (b"(module", "a footprint, not a KiCad board (.kicad_pcb)", GIVE),
    (b"pcbnew-board", "a board of a KiCad before 4", SAVE),
    (b"\x10\0", "a board or schematic of an EAGLE before 6", EXPORT),
    (b"\x10\x80", "a board or schematic of an EAGLE before 6", EXPORT),
    (b"\xd0\xcf\x11\xe0", "a document of Altium or of an office", EXPORT),
    (b"|record=board", "a Protel board", EXPORT),
    (b"(librepcb_", "a file of a LibrePCB project", EXPORT),
    (b"# release: pcb", "a board of gEDA pcb", EXPORT),
    (b"fileversion[", "a board of gEDA pcb", EXPORT),
    (b"pcb[", "a board of gEDA pcb", EXPORT),
    (b"li:pcb-rnd", "a board of pcb-rnd", EXPORT),
    (b"ha:pcb-rnd", "a board of pcb-rnd", EXPORT),
    (b"<!doctype", "a web page, perhaps from a failed download", GIVE),
    (b"<html", "a web page, perhaps from a failed download", GIVE),
];

/// What is near the beginning of XML files, in lower case.
const XML: &[(&[u8], &str, Words)] =
    &[(b"<eagle", "an EAGLE board or schematic", EXPORT), (b"<ipc-2581", "an IPC-2581 file", EXPORT)];

/// What a file is that is no layer, in a few words.
pub(super) fn describe(bytes: &[u8]) -> &'static str {
    known(bytes).0
}

/// What a person can do who gave a file that is no layer.
pub(super) fn hint(bytes: &[u8]) -> Words {
    known(bytes).1
}

fn known(bytes: &[u8]) -> (&'static str, Words) {
    /// Comments and declarations before what counts take less. Chosen.
    const BEGINNING: usize = 1024;
    if bytes.iter().all(|b| b.is_ascii_whitespace() || *b == 0) {
        return ("an empty file", GIVE);
    }
    let head = &bytes[..bytes.len().min(HEAD)];
    let beginning = bytes[..bytes.len().min(BEGINNING)].to_ascii_lowercase();
    let text = |b: &u8| b.is_ascii_graphic() || b.is_ascii_whitespace() || *b >= 0xa0;
    if beginning.starts_with(b"<?xml") {
        let holds = |words: &[u8]| beginning.windows(words.len()).any(|part| part == words);
        let found = XML.iter().find(|(words, ..)| holds(words));
        return found.map_or(("an XML file", GIVE), |&(_, what, hint)| (what, hint));
    }
    match KNOWN.iter().find(|(start, ..)| beginning.starts_with(start)) {
        Some(&(_, what, hint)) => (what, hint),
        None if is_program(head) => ("a G-code program", JUDGE),
        None if is_project(head) => ("the options of pcb2gcode", TAKE_OVER),
        None if beginning.iter().all(text) => ("a text file of unknown type", GIVE),
        None => ("a file of unknown type", GIVE),
    }
}

/// Whether it sets a height of pcb2gcode's.
pub(super) fn is_project(bytes: &[u8]) -> bool {
    const HEIGHTS: [&str; 4] = ["zwork", "zsafe", "zdrill", "zcut"];
    let text = String::from_utf8_lossy(bytes);
    let mut settings = text.lines().filter_map(|line| line.split_once('='));
    settings.any(|(key, _)| HEIGHTS.contains(&key.trim()))
}

/// Whether it is G-code: it goes to a height, which neither a layer nor a drill file does.
pub(super) fn is_program(bytes: &[u8]) -> bool {
    let text: String = bytes.iter().map(|&b| char::from(b)).collect();
    let mut lines = text.lines().map(|line| line.split(['(', ';']).next().unwrap_or_default().trim());
    let is_word = |word: &str, letter: char| {
        let number = word.strip_prefix(letter).or_else(|| word.strip_prefix(letter.to_ascii_lowercase()));
        number.is_some_and(|number| number.parse::<f64>().is_ok())
    };
    !bytes.contains(&b'*') && lines.any(|line| line.split_whitespace().any(|word| is_word(word, 'Z')))
}
