//! What a file is that is no layer.

/// What a file is that is no layer, in a few words.
pub(super) fn describe(bytes: &[u8]) -> &'static str {
    const KNOWN: [(&[u8], &str); 9] = [
        (b"\x89PNG", "a PNG picture"),
        (b"\xff\xd8\xff", "a JPEG picture"),
        (b"%PDF", "a PDF document"),
        (b"PK", "a zip archive"),
        (b"(kicad_sch", "a KiCad schematic, not its board (.kicad_pcb)"),
        (b"<?xml", "an XML file"),
        (b"<!doctype", "a web page, perhaps from a failed download"),
        (b"<html", "a web page, perhaps from a failed download"),
        (b"g21", "a G-code program"),
    ];
    if bytes.iter().all(|b| b.is_ascii_whitespace() || *b == 0) {
        return "an empty file";
    }
    let lower = bytes[..bytes.len().min(16)].to_ascii_lowercase();
    let begins = |start: &[u8]| bytes.starts_with(start) || lower.starts_with(start);
    let text = |b: &u8| b.is_ascii_graphic() || b.is_ascii_whitespace() || *b >= 0xa0;
    match KNOWN.iter().find(|(start, _)| begins(start)) {
        Some((_, what)) => what,
        None if bytes.iter().take(4096).all(text) => "a text file of unknown type",
        None => "a file of unknown type",
    }
}
