//! What kind of thing a list of a board is, by its first word.

/// Whether `head` is that of something drawn, without `gr_` and `fp_`.
pub(super) fn is_graphic(head: &[u8]) -> bool {
    matches!(kind(head), b"line" | b"arc" | b"circle" | b"rect" | b"poly" | b"curve")
}

/// A head without where it belongs to.
pub(super) fn kind(head: &[u8]) -> &[u8] {
    head.strip_prefix(b"gr_").or_else(|| head.strip_prefix(b"fp_")).unwrap_or(head)
}

/// Whether `head` is that of a text, or of a field shown as one.
pub(super) fn is_text(head: &[u8]) -> bool {
    matches!(head, b"gr_text" | b"fp_text" | b"gr_text_box" | b"fp_text_box" | b"property")
}
