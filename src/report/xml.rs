//! Text within XML and HTML.

/// `text` as it stands between tags or in an attribute; what no XML may have (XML 1.0, 2.2) as the
/// character for that.
pub(super) fn escaped(text: &str) -> String {
    let is_forbidden =
        |c: char| matches!(c, '\0'..='\x08' | '\x0b' | '\x0c' | '\x0e'..='\x1f' | '\u{fffe}' | '\u{ffff}');
    let text = text.replace(is_forbidden, "\u{fffd}");
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_means_something_is_written_otherwise() {
        assert_eq!(escaped("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;", "all four");
        assert_eq!(escaped("\u{1b}[31m\tNET\0"), "\u{fffd}[31m\tNET\u{fffd}", "what no XML may have");
    }
}
