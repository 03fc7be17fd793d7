//! The XML of a drawing: its elements counted, its groups named.
//!
//! Of groups, `usvg` keeps the id alone. Inkscape names layers by a label, so every group gets an
//! id here that leads back to its name.

use std::collections::BTreeMap;

use usvg::roxmltree;

use crate::import::drawing::role_of;
use crate::import::error::Error;

/// Inkscape's namespace.
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// What is drawn by itself.
const SHAPES: [&str; 7] = ["path", "rect", "circle", "ellipse", "line", "polyline", "polygon"];

/// What is counted besides.
const OTHERS: [&str; 4] = ["text", "image", "use", "foreignObject"];

/// What is not drawn where it stands.
const STORED: [&str; 8] =
    ["defs", "symbol", "clipPath", "mask", "pattern", "marker", "linearGradient", "radialGradient"];

/// The most elements that are read, entities unfolded. Chosen: ten times the largest drawing known.
const MOST_ELEMENTS: u32 = 2_000_000;

/// The deepest nesting of elements that is read. Chosen: drawings nest some dozen, and the stack
/// holds far more.
const DEEPEST: usize = 400;

/// How much a group's name tells of a layer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    #[default]
    None,
    /// Any id.
    Id,
    /// A layer of Inkscape, or a board.
    Layer,
    /// A group whose name says what it is for: what it holds is that, whatever it is called.
    Role,
    /// A layer of Inkscape whose name says what it is for.
    RoleLayer,
}

impl Rank {
    /// Whether what is in a group of this rank belongs to it and not to the one above.
    pub(super) fn counts_in(self, above: Self) -> bool {
        self > above || (self == above && matches!(self, Self::Layer | Self::RoleLayer))
    }
}

/// A drawing's text and what is known of it before it is resolved.
#[derive(Debug)]
pub(super) struct Document {
    /// The text, every group with an id.
    text: String,
    /// By id: the name of a group and what that tells.
    groups: BTreeMap<String, (String, Rank)>,
    /// How many elements of each kind there are, stored ones included.
    pub(super) counts: BTreeMap<String, u64>,
    /// Shapes that are not shown: `display="none"`.
    pub(super) hidden: u64,
    pub(super) texts: u64,
    pub(super) images: u64,
    /// Shapes whose strokes are to keep their width however they are scaled.
    pub(super) unscaled: u64,
    /// The program that wrote it, where it says so.
    pub(super) generator: Option<String>,
}

impl Document {
    pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Self, Error> {
        let Ok(text) = str::from_utf8(bytes) else {
            let what = "the SVG is not UTF-8";
            return Err(Error::content(name, what, "save it again as uncompressed UTF-8"));
        };
        let text = text.trim_start_matches('\u{feff}');
        let xml = parse(name, text)?;
        let mut document = Self {
            text: String::new(),
            groups: BTreeMap::new(),
            counts: BTreeMap::new(),
            hidden: 0,
            texts: 0,
            images: 0,
            unscaled: 0,
            generator: generator(&xml),
        };
        let mut inserts = Vec::new();
        document.survey(name, &xml, text, &mut inserts)?;
        inserts.sort_unstable();
        let mut from = 0;
        for (at, id) in inserts {
            document.text.push_str(&text[from..at]);
            document.text.push_str(&format!(" id=\"{id}\""));
            from = at;
        }
        document.text.push_str(&text[from..]);
        Ok(document)
    }

    /// The text as elements.
    pub(super) fn parse(&self, name: &str) -> Result<roxmltree::Document<'_>, Error> {
        parse(name, &self.text)
    }

    /// The name of the group `id`, and what that tells.
    pub(super) fn group(&self, id: &str) -> Option<(&str, Rank)> {
        self.groups.get(id).map(|(name, rank)| (name.as_str(), *rank))
    }

    /// Counts elements and names groups; `inserts` are ids for those that have none.
    fn survey(
        &mut self,
        name: &str,
        xml: &roxmltree::Document<'_>,
        text: &str,
        inserts: &mut Vec<(usize, String)>,
    ) -> Result<(), Error> {
        // Depth, and whether an element and all in it is hidden or stored, by number of the node.
        let mut depths = vec![(0_usize, false, false); xml.root().descendants().count()];
        for node in xml.root().descendants() {
            let above = node.parent().map_or((0, false, false), |parent| depths[parent.id().get_usize()]);
            let tag = node.tag_name().name();
            let here = (above.0 + 1, above.1 || is_hidden(&node), above.2 || STORED.contains(&tag));
            depths[node.id().get_usize()] = here;
            if here.0 > DEEPEST {
                let what = format!("elements are nested more than {DEEPEST} deep");
                return Err(Error::content(name, what, "ungroup them and save the drawing again"));
            }
            if !node.is_element() {
                continue;
            }
            let is_shape = SHAPES.contains(&tag);
            if is_shape || OTHERS.contains(&tag) {
                *self.counts.entry(tag.to_owned()).or_insert(0) += 1;
                self.hidden += u64::from(here.1 && !here.2 && (is_shape || tag == "text"));
                let shows = u64::from(!here.1 && !here.2);
                // KiCad puts a text that nobody sees beside the strokes of its letters.
                let is_clear = node.attribute("opacity").is_some_and(|opacity| opacity.parse() == Ok(0.0));
                self.texts += if tag == "text" && !is_clear { shows } else { 0 };
                self.unscaled += if is_shape && keeps_width(&node) { shows } else { 0 };
                self.images += if matches!(tag, "image" | "foreignObject") { shows } else { 0 };
            }
            if tag == "g" {
                self.name_group(name, &node, text, inserts)?;
            }
        }
        Ok(())
    }

    fn name_group(
        &mut self,
        name: &str,
        node: &roxmltree::Node<'_, '_>,
        text: &str,
        inserts: &mut Vec<(usize, String)>,
    ) -> Result<(), Error> {
        let id = node.attribute("id");
        let label = node.attribute((INKSCAPE, "label"));
        let is_layer = node.attribute((INKSCAPE, "groupmode")) == Some("layer");
        let Some(called) = label.filter(|_| is_layer).or(id).or(label) else { return Ok(()) };
        // Fritzing's `board` holds the edge, and may hold all else.
        let is_board = called.eq_ignore_ascii_case("board");
        let rank = match (role_of(called).is_some() && !is_board, is_layer || is_board) {
            (true, true) => Rank::RoleLayer,
            (true, false) => Rank::Role,
            (false, true) => Rank::Layer,
            (false, false) => Rank::Id,
        };
        let key = match id {
            Some(id) => id.to_owned(),
            None => {
                // Unfolded from an entity it does not stand where it says.
                let start = node.range().start;
                let at = text.get(start..).filter(|rest| rest.starts_with('<')).and_then(|rest| {
                    rest[1..].find(|c: char| !(c.is_alphanumeric() || c == ':')).map(|end| start + 1 + end)
                });
                let Some(at) = at else { return Ok(()) };
                let key = format!("voromill-group-{at}");
                inserts.push((at, key.clone()));
                key
            }
        };
        let before = self.groups.insert(key.clone(), (called.to_owned(), rank));
        match before.filter(|(before, _)| role_of(before) != role_of(called)) {
            Some((before, _)) => {
                let what = format!("`{before}` and `{called}` are groups of one id, `{key}`");
                Err(Error::content(name, what, "give each an id of its own"))
            }
            None => Ok(()),
        }
    }
}

/// Whether an element itself says that its stroke is as wide however it is scaled.
fn keeps_width(node: &roxmltree::Node<'_, '_>) -> bool {
    let says = |text: &str| text.contains("non-scaling-stroke");
    node.attribute("vector-effect").is_some_and(says) || node.attribute("style").is_some_and(says)
}

fn parse<'a>(name: &str, text: &'a str) -> Result<roxmltree::Document<'a>, Error> {
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        nodes_limit: MOST_ELEMENTS,
        ..roxmltree::ParsingOptions::default()
    };
    roxmltree::Document::parse_with_options(text, options).map_err(|error| {
        let place = error.pos();
        let before = text.split_inclusive('\n').take(place.row.saturating_sub(1) as usize);
        let start: usize = before.map(str::len).sum();
        let line = text[start..].lines().next().unwrap_or_default();
        let column = line.char_indices().nth(place.col.saturating_sub(1) as usize).map_or(0, |(at, _)| at);
        let at = start + column;
        let what = format!("the XML is broken: {error}");
        Error::syntax(name, text.as_bytes(), at..at + 1, what, "well-formed XML", "save the drawing again")
    })
}

/// Whether an element and all in it is not shown.
fn is_hidden(node: &roxmltree::Node<'_, '_>) -> bool {
    let style = node.attribute("style").unwrap_or_default();
    let declares = |part: &str| {
        part.split_once(':').is_some_and(|(name, value)| name.trim() == "display" && value.trim() == "none")
    };
    node.attribute("display") == Some("none") || style.split(';').any(declares)
}

/// Inkscape says its version in an attribute, other programs in a comment before the drawing.
fn generator(xml: &roxmltree::Document<'_>) -> Option<String> {
    let version = xml.root_element().attribute((INKSCAPE, "version"));
    let inkscape = version.map(|version| format!("Inkscape {version}"));
    let comment = || {
        let node = xml.root().children().find(roxmltree::Node::is_comment)?;
        let text = node.text()?.trim().trim_start_matches("Generator:").trim();
        Some(text.lines().next()?.chars().take(80).collect())
    };
    inkscape.or_else(comment).filter(|text: &String| !text.is_empty())
}
