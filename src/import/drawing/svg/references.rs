//! How far clipping paths, masks, patterns and markers refer to each other.
//!
//! `usvg` follows references by recursion, and copies what a mask holds wherever it is set: a few
//! kilobytes can ask for more stack and memory than there is. So they are followed here first, with
//! bounds. References in a circle are cut by `usvg`.

use std::collections::BTreeMap;

use usvg::roxmltree::{Document, Node};

use crate::import::error::Error;

/// What is drawn wherever it is referred to.
const RESOURCES: [&str; 4] = ["clipPath", "mask", "pattern", "marker"];

/// How many may refer to each other in a row. Chosen: drawings have two or three.
const DEEPEST: usize = 64;

/// How many elements all references together may stand for. Chosen, as for elements themselves.
const MOST: u64 = 2_000_000;

/// How many of them style sheets may set: those are not followed. Chosen.
const MOST_IN_SHEETS: usize = 16;

/// Checks the references of `xml`.
///
/// # Errors
///
/// [`Error`] where they go too deep, or stand for too many elements.
pub(super) fn check(name: &str, xml: &Document<'_>) -> Result<(), Error> {
    let elements = || xml.root().descendants().filter(Node::is_element);
    let named = elements().filter_map(|node| Some((node.attribute("id")?, node)));
    let mut references = References { elements: named.collect(), known: BTreeMap::new() };
    let outside = elements().filter(|node| !node.ancestors().any(|above| is_resource(&above)));
    let mut total = Some(0_u64);
    for id in outside.flat_map(|node| of(&node)) {
        if references.elements.get(id).is_some_and(is_resource) {
            let size = references.size(id, 0).map(|(size, _)| size);
            total = total.zip(size).map(|(total, size)| total + size).filter(|&total| total <= MOST);
        }
    }
    let sheets = elements().filter(|node| node.tag_name().name() == "style").filter_map(|node| node.text());
    let in_sheets = sheets.flat_map(urls).filter(|id| references.elements.get(id).is_some_and(is_resource));
    if total.is_some() && in_sheets.count() <= MOST_IN_SHEETS {
        return Ok(());
    }
    let what = "clipping paths, masks, patterns or markers of the SVG refer to each other too often";
    Err(Error::content(name, what, "apply them in the drawing program, so that only paths are left"))
}

struct References<'a> {
    elements: BTreeMap<&'a str, Node<'a, 'a>>,
    /// For how many elements each stands, and how many refer to each other below it; none while it
    /// is worked out.
    known: BTreeMap<&'a str, Option<(u64, usize)>>,
}

impl<'a> References<'a> {
    /// For how many elements `id` stands, so many references deep, and how many are below it; none
    /// beyond the bounds.
    fn size(&mut self, id: &'a str, depth: usize) -> Option<(u64, usize)> {
        match self.known.get(id) {
            Some(None) => return Some((0, 0)),
            Some(Some((size, below))) => return (depth + below <= DEEPEST).then_some((*size, *below)),
            None => {}
        }
        if depth > DEEPEST {
            return None;
        }
        let Some(&node) = self.elements.get(id) else { return Some((0, 0)) };
        self.known.insert(id, None);
        let (mut size, mut below) = (0_u64, 0);
        for part in node.descendants().filter(Node::is_element) {
            size += 1;
            for next in of(&part) {
                let (more, deeper) = self.size(next, depth + 1)?;
                size += more;
                below = below.max(deeper + 1);
                if size > MOST {
                    return None;
                }
            }
        }
        self.known.insert(id, Some((size, below)));
        Some((size, below))
    }
}

fn is_resource(node: &Node<'_, '_>) -> bool {
    RESOURCES.contains(&node.tag_name().name())
}

/// What the attributes of an element refer to.
fn of<'a>(node: &Node<'a, 'a>) -> impl Iterator<Item = &'a str> + use<'a> {
    node.attributes().flat_map(|attribute| {
        let link = attribute.value().strip_prefix('#').filter(|_| attribute.name() == "href");
        link.into_iter().chain(urls(attribute.value()))
    })
}

/// Each `x` of `url(#x)` in a text.
fn urls(text: &str) -> impl Iterator<Item = &str> {
    let inner = text.split("url(").skip(1).filter_map(|rest| rest.split(')').next());
    let bare = inner.map(|id| id.trim_matches(|c: char| c.is_whitespace() || c == '"' || c == '\''));
    bare.filter_map(|id| id.strip_prefix('#'))
}
