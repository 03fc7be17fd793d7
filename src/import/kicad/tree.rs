//! The lists of a board file, `(head word "text" (…))`, as one flat list of nodes.
//!
//! A node knows where the next one after it begins, so nothing here or in the readers calls itself
//! however deep a file nests, and a file of any size costs a few words a node.

use std::borrow::Cow;
use std::ops::Range;

use super::super::error::Error;

/// A file, taken apart.
#[derive(Debug)]
pub(super) struct Tree<'a> {
    name: &'a str,
    bytes: &'a [u8],
    nodes: Vec<Entry>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    start: u32,
    end: u32,
    /// The index of the first node that is not inside this one.
    next: u32,
    line: u32,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    List,
    Word,
    Text,
}

impl<'a> Tree<'a> {
    /// Takes the file `name` with content `bytes` apart; what follows the first list is not looked
    /// at.
    pub(super) fn read(name: &'a str, bytes: &'a [u8]) -> Result<Self, Error> {
        let mut tree = Self { name, bytes, nodes: Vec::with_capacity(bytes.len() / 16) };
        let (mut at, mut line, mut open) = (0, 1_u32, Vec::new());
        while let Some(&byte) = bytes.get(at) {
            match byte {
                b'\n' => (at, line) = (at + 1, line.saturating_add(1)),
                b if b.is_ascii_whitespace() => at += 1,
                b'#' if begins_line(bytes, at) => at = line_end(bytes, at),
                b'(' => {
                    open.push(tree.nodes.len());
                    tree.push(at..at, line, Kind::List);
                    at += 1;
                }
                b')' => {
                    let Some(list) = open.pop() else { return Err(tree.not_a_list(at)) };
                    at += 1;
                    tree.close(list, at);
                    if open.is_empty() {
                        return Ok(tree);
                    }
                }
                _ if open.is_empty() => return Err(tree.not_a_list(at)),
                b'"' => {
                    let end = text_end(bytes, at).ok_or_else(|| tree.endless("text", at..at + 1))?;
                    tree.push(at..end, line, Kind::Text);
                    let lines = bytes[at..end].iter().filter(|&&b| b == b'\n').count();
                    line = line.saturating_add(u32::try_from(lines).unwrap_or(u32::MAX));
                    at = end;
                }
                _ => {
                    let ends = |b: &u8| b.is_ascii_whitespace() || matches!(b, b'(' | b')' | b'"');
                    let end = bytes[at..].iter().position(ends).map_or(bytes.len(), |length| at + length);
                    tree.push(at..end, line, Kind::Word);
                    at = end;
                }
            }
        }
        match open.pop() {
            Some(list) => {
                let start = tree.nodes[list].start as usize;
                Err(tree.endless("list", start..start + 1))
            }
            None => Err(tree.not_a_list(at)),
        }
    }

    /// The list that the file is.
    pub(super) fn root(&self) -> Node<'_> {
        Node { tree: self, index: 0 }
    }

    fn push(&mut self, place: Range<usize>, line: u32, kind: Kind) {
        let number = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        let next = number(self.nodes.len() + 1);
        self.nodes.push(Entry { start: number(place.start), end: number(place.end), next, line, kind });
    }

    fn close(&mut self, list: usize, end: usize) {
        let next = u32::try_from(self.nodes.len()).unwrap_or(u32::MAX);
        let entry = &mut self.nodes[list];
        (entry.next, entry.end) = (next, u32::try_from(end).unwrap_or(u32::MAX));
    }

    fn not_a_list(&self, at: usize) -> Error {
        let place = at.min(self.bytes.len())..(at + 1).min(self.bytes.len());
        Error::syntax(self.name, self.bytes, place, "this is not a KiCad board", "`(kicad_pcb …)`", "")
    }

    fn endless(&self, what: &str, place: Range<usize>) -> Error {
        let what = format!("this {what} has no end: the file is truncated");
        let expected = if place.len() == 1 { "its end further down" } else { "its end" };
        Error::syntax(self.name, self.bytes, place, what, expected, "save the board again in KiCad")
    }
}

/// Whether nothing but blanks stand before `at` on its line.
fn begins_line(bytes: &[u8], at: usize) -> bool {
    let before = bytes[..at].iter().rev().take_while(|&&b| b != b'\n');
    before.into_iter().all(u8::is_ascii_whitespace)
}

fn line_end(bytes: &[u8], at: usize) -> usize {
    bytes[at..].iter().position(|&b| b == b'\n').map_or(bytes.len(), |length| at + length)
}

/// Behind the text in quotes that begins at `at`.
fn text_end(bytes: &[u8], at: usize) -> Option<usize> {
    let mut end = at + 1;
    loop {
        match bytes.get(end)? {
            b'"' => return Some(end + 1),
            b'\\' => end += 2,
            _ => end += 1,
        }
    }
}

/// A list, a word or a text in quotes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<'a> {
    tree: &'a Tree<'a>,
    index: usize,
}

impl<'a> Node<'a> {
    const fn entry(self) -> Entry {
        self.tree.nodes.as_slice()[self.index]
    }

    /// Its bytes in the file.
    pub(super) const fn place(self) -> Range<usize> {
        let entry = self.entry();
        entry.start as usize..entry.end as usize
    }

    /// The line that it begins on.
    pub(super) const fn line(self) -> u32 {
        self.entry().line
    }

    pub(super) fn is_list(self) -> bool {
        self.entry().kind == Kind::List
    }

    /// What the file has there.
    pub(super) fn raw(self) -> &'a [u8] {
        &self.tree.bytes[self.place()]
    }

    /// What it says: a text without quotes and escapes; nothing of a list.
    pub(super) fn text(self) -> Cow<'a, str> {
        match self.entry().kind {
            Kind::List => Cow::Borrowed(""),
            Kind::Word => String::from_utf8_lossy(self.raw()),
            Kind::Text => {
                let inner = &self.raw()[1..self.raw().len() - 1];
                if inner.contains(&b'\\') {
                    Cow::Owned(unescaped(inner))
                } else {
                    String::from_utf8_lossy(inner)
                }
            }
        }
    }

    /// What stands in the list.
    pub(super) fn children(self) -> impl Iterator<Item = Node<'a>> + use<'a> {
        let (tree, end) = (self.tree, self.entry().next as usize);
        let mut index = self.index + 1;
        std::iter::from_fn(move || {
            let node = (index < end).then_some(Node { tree, index })?;
            index = node.entry().next as usize;
            Some(node)
        })
    }

    /// What the list is called: its first word.
    pub(super) fn head(self) -> &'a [u8] {
        let first = self.children().next().filter(|first| !first.is_list());
        if self.is_list() { first.map_or(b"", Node::raw) } else { b"" }
    }

    /// What stands behind its head.
    pub(super) fn arguments(self) -> impl Iterator<Item = Node<'a>> + use<'a> {
        self.children().skip(1)
    }

    /// The word or text at place `number` behind its head.
    pub(super) fn argument(self, number: usize) -> Option<Node<'a>> {
        self.arguments().nth(number).filter(|node| !node.is_list())
    }

    /// The lists in it that are called `name`.
    pub(super) fn all(self, name: &'static str) -> impl Iterator<Item = Node<'a>> + use<'a> {
        self.children().filter(move |node| node.is_list() && node.head() == name.as_bytes())
    }

    /// The first list in it that is called `name`.
    pub(super) fn find(self, name: &'static str) -> Option<Node<'a>> {
        self.all(name).next()
    }

    /// Whether one of its words is `word`.
    pub(super) fn has_word(self, word: &str) -> bool {
        self.arguments().any(|node| !node.is_list() && node.raw() == word.as_bytes())
    }

    /// Whether it has a list `(name)` or `(name yes)`, and not `(name no)`.
    pub(super) fn says(self, name: &'static str) -> bool {
        let denied = |node: Node<'a>| matches!(node.raw(), b"no" | b"false" | b"none");
        self.find(name).is_some_and(|node| !node.argument(0).is_some_and(denied))
    }
}

/// A text with `\n`, `\t` and `\"` read; of what else is escaped, the sign itself.
fn unescaped(text: &[u8]) -> String {
    let mut plain = Vec::with_capacity(text.len());
    let mut rest = text.iter();
    while let Some(&byte) = rest.next() {
        plain.push(match (byte, byte == b'\\') {
            (_, true) => match rest.next() {
                Some(b'n') => b'\n',
                Some(b'r') => b'\r',
                Some(b't') => b'\t',
                Some(&sign) => sign,
                None => b'\\',
            },
            (byte, false) => byte,
        });
    }
    String::from_utf8_lossy(&plain).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_words_and_texts_are_told_apart() {
        let text = b"# a comment\n(kicad_pcb (version 4)\n  (net 1 \"a \\\"b\\\" )\") word)\nrest";
        let tree = Tree::read("x", text).expect("a list");
        let root = tree.root();
        assert_eq!(root.head(), b"kicad_pcb", "the head");
        let net = root.find("net").expect("a net");
        assert_eq!(net.line(), 3, "its line");
        assert_eq!(net.argument(1).expect("a name").text(), "a \"b\" )", "its name");
        assert!(root.has_word("word") && !root.has_word("version"), "a word is no head");
    }

    #[test]
    fn what_never_ends_is_an_error_that_shows_where_it_begins() {
        for (text, place) in [("(a (b \"c", "x:1:7"), ("(a\n (b)", "x:1:1"), ("  a", "x:1:3"), ("", "x:1:1")]
        {
            let error = Tree::read("x", text.as_bytes()).expect_err(text).to_string();
            assert!(error.starts_with(place), "{text}: {error}");
        }
    }

    #[test]
    fn a_file_may_nest_as_deep_as_it_likes() {
        let deep = [b"(".repeat(1_000_000), b")".repeat(1_000_000)].concat();
        let tree = Tree::read("x", &deep).expect("closed");
        assert_eq!(tree.root().children().count(), 1, "one list in the first");
    }
}
