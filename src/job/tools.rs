//! The tools of a workshop: those that are built in, and one's own as `[tools.NAME]` tables of
//! `voromill.toml`.
//!
//! What a table leaves open is as for any tool: speeds from the settings, the depth from `depth` or
//! `kerf`. What a person says on the command line holds for every tool, whatever its table says.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use serde::Deserialize;

use crate::geometry::Nm;
use crate::toolpath::{Angle, BUILT_IN, CARBIDE_POINT, DrillSpeeds, Feed, ParseToolError, Tool, ToolKind};

use super::Error;
use super::quantity::{Length, text};
use super::turns;

/// A tool as a person names it: by its shape, or by what a table or voromill calls it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ToolChoice {
    /// Such as `vbit:0.1mm:30deg`.
    Kind(ToolKind),
    /// Such as `engraver`.
    Named(String),
}

impl FromStr for ToolChoice {
    type Err = ParseToolError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let text = text.trim();
        let is_name = !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || "-_.+".contains(c));
        if is_name { Ok(Self::Named(text.to_owned())) } else { text.parse().map(Self::Kind) }
    }
}

/// As it is written.
impl fmt::Display for ToolChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Kind(kind) => kind.fmt(f),
            Self::Named(name) => f.write_str(name),
        }
    }
}

/// A `[tools.NAME]` table.
///
/// # Guarantees
///
/// The shape is one that a tool can have, and the depth one at which it cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(try_from = "Table")]
pub struct OwnTool {
    /// Its shape.
    pub kind: ToolKind,
    /// Its number in the machine's table.
    pub number: Option<u32>,
    /// Its speed sideways.
    pub feed: Option<Feed>,
    /// Its speed into the material.
    pub plunge: Option<Feed>,
    /// Its turns per minute.
    pub spindle: Option<u32>,
    /// How deep it isolates.
    pub depth: Option<Nm>,
    /// The angle of a drill's tip.
    pub point: Option<Angle>,
}

impl OwnTool {
    /// A tool of which nothing is known but its shape.
    pub(super) const fn of(kind: ToolKind) -> Self {
        Self { kind, number: None, feed: None, plunge: None, spindle: None, depth: None, point: None }
    }
}

/// The keys of a table, as they are written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Table {
    kind: Shape,
    #[serde(default, with = "text")]
    tip: Option<Length>,
    #[serde(default, with = "text")]
    angle: Option<Angle>,
    carbide: Option<bool>,
    #[serde(default, with = "text")]
    diameter: Option<Length>,
    number: Option<u32>,
    #[serde(default, with = "text")]
    feed: Option<Feed>,
    #[serde(default, with = "text")]
    plunge: Option<Feed>,
    #[serde(default, deserialize_with = "turns::deserialize")]
    spindle: Option<u32>,
    #[serde(default, with = "text")]
    depth: Option<Length>,
    #[serde(default, with = "text")]
    kerf: Option<Length>,
}

/// The keys that only a table has.
pub(super) const TABLE_KEYS: &[&str] = &["kind", "tip", "angle", "diameter", "number", "carbide"];

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Shape {
    VBit,
    EndMill,
    Drill,
}

impl TryFrom<Table> for OwnTool {
    type Error = String;

    fn try_from(table: Table) -> Result<Self, String> {
        let kind = table.kind()?;
        kind.check().map_err(str::to_owned)?;
        let depth = match (table.depth, table.kerf) {
            (Some(_), Some(_)) => return Err("expected a depth or a kerf, not both".to_owned()),
            (Some(depth), None) if depth.nm() <= Nm::ZERO => {
                return Err("expected a depth above zero".to_owned());
            }
            (Some(depth), None) => Some(depth.nm()),
            (None, Some(kerf)) => Some(depth_for(kind, kerf)?),
            (None, None) => None,
        };
        if table.number == Some(0) {
            return Err("expected a number from 1".to_owned());
        }
        let point = table.point(kind)?;
        let Table { number, feed, plunge, spindle, .. } = table;
        Ok(Self { kind, number, feed, plunge, spindle, depth, point })
    }
}

impl Table {
    /// The tip of a drill, where the table says something of it.
    fn point(&self, kind: ToolKind) -> Result<Option<Angle>, String> {
        match (kind, self.angle, self.carbide) {
            (ToolKind::Drill { .. }, Some(angle), _) => point_angle(angle).map(Some),
            (ToolKind::Drill { .. }, None, Some(true)) => Ok(Some(CARBIDE_POINT)),
            (ToolKind::VBit { .. } | ToolKind::EndMill { .. }, _, Some(_)) => {
                Err("expected carbide only for a drill".to_owned())
            }
            (..) => Ok(None),
        }
    }

    fn kind(&self) -> Result<ToolKind, String> {
        let kind = match (self.kind, self.tip, self.angle, self.diameter) {
            (Shape::VBit, Some(tip), Some(angle), None) => ToolKind::VBit { tip: tip.nm(), angle },
            (Shape::VBit, ..) => return Err("expected tip and angle for a vbit".to_owned()),
            (Shape::EndMill, None, None, Some(diameter)) => ToolKind::EndMill { diameter: diameter.nm() },
            (Shape::EndMill, ..) => return Err("expected only diameter for an endmill".to_owned()),
            (Shape::Drill, None, _, Some(diameter)) => ToolKind::Drill { diameter: diameter.nm() },
            (Shape::Drill, ..) => {
                return Err(
                    "expected diameter for a drill, and the angle of its tip if you know it".to_owned()
                );
            }
        };
        Ok(kind)
    }
}

/// An angle that a drill's tip can have.
pub(super) fn point_angle(angle: Angle) -> Result<Angle, String> {
    if angle > Angle::from_degrees(30) && angle < Angle::from_degrees(180) {
        return Ok(angle);
    }
    Err(format!("`{angle}` is not the point angle of a drill: expected an angle between 30deg and 180deg"))
}

/// How deep a tool of this shape cuts a kerf, or why no depth does.
pub(super) fn depth_for(kind: ToolKind, kerf: Length) -> Result<Nm, String> {
    match kind {
        ToolKind::VBit { .. } => kind
            .depth_for(kerf.nm())
            .filter(|&depth| depth > Nm::ZERO)
            .ok_or_else(|| format!("`{kind}` cuts wider than {kerf} at any depth")),
        ToolKind::EndMill { .. } | ToolKind::Drill { .. } => {
            Err(format!("`{kind}` cuts {} at any depth: set the depth", Length(kind.width_at(Nm::ZERO))))
        }
    }
}

/// One's own tools, by name.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(transparent)]
pub struct Library(BTreeMap<String, OwnTool>);

impl Library {
    /// Whether it holds no tool.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// These tools, each changed.
    pub(super) fn each(mut self, change: impl FnMut(&mut OwnTool)) -> Self {
        self.0.values_mut().for_each(change);
        self
    }

    /// These tools, and those of `others` whose names are not among them.
    pub(super) fn with(mut self, others: Self) -> Self {
        for (name, tool) in others.0 {
            self.0.entry(name).or_insert(tool);
        }
        self
    }

    /// The numbers that its tools have.
    pub(super) fn numbers(&self) -> Vec<u32> {
        self.0.values().filter_map(|tool| tool.number).collect()
    }

    /// Whether a tool has this name.
    pub(super) fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// The number that a tool's table says.
    pub(super) fn number(&self, name: &str) -> Option<u32> {
        self.0.get(name)?.number
    }

    /// A tool more.
    pub(super) fn add(&mut self, name: &str, tool: OwnTool) {
        self.0.insert(name.to_owned(), tool);
    }

    /// All names, those that are built in first; an own tool replaces a built-in one of its name.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let built_in = BUILT_IN.iter().map(|(name, _)| (*name).to_owned());
        let own = self.0.keys().filter(|name| BUILT_IN.iter().all(|(other, _)| other != name));
        built_in.chain(own.cloned()).collect()
    }

    fn find(&self, name: &str) -> Option<OwnTool> {
        self.0.get(name).copied().or_else(|| {
            let (_, text) = BUILT_IN.iter().find(|(built_in, _)| *built_in == name)?;
            let kind = text.parse().expect("the built-in tools are right");
            Some(OwnTool::of(kind))
        })
    }
}

/// A library, and the speeds of tools that do not say theirs.
pub(super) struct Workshop<'a> {
    pub(super) library: &'a Library,
    pub(super) feed: Feed,
    pub(super) plunge: Feed,
    pub(super) spindle: u32,
    /// How drills are run that do not say their speeds.
    pub(super) drilling: DrillSpeeds,
    /// The tip of drills that do not say theirs.
    pub(super) point: Angle,
}

/// A tool out of the workshop.
#[derive(Clone, Debug)]
pub(super) struct Fetched {
    /// Numbered 1 where its table gives no number, until all tools of a job are known.
    pub(super) tool: Tool,
    pub(super) depth: Option<Nm>,
}

impl Workshop<'_> {
    /// The tool that `choice` means. `key` is the option that names it.
    pub(super) fn fetch(&self, key: &'static str, choice: &ToolChoice) -> Result<Fetched, Error> {
        let own = match choice {
            ToolChoice::Kind(kind) => OwnTool::of(*kind),
            ToolChoice::Named(name) => self.library.find(name).ok_or_else(|| self.unknown(key, name))?,
        };
        // The settings' speeds are a cutter's; drills have usual ones of their own.
        let usual = match own.kind {
            ToolKind::Drill { .. } => {
                let diameter = own.kind.width_at(Nm::ZERO);
                let speeds = DrillSpeeds { spindle: own.spindle.or(self.drilling.spindle), ..self.drilling };
                let (plunge, spindle) = speeds.of(diameter);
                Tool { plunge, spindle, ..Tool::new(own.kind) }
            }
            ToolKind::VBit { .. } | ToolKind::EndMill { .. } => {
                Tool { feed: self.feed, plunge: self.plunge, spindle: self.spindle, ..Tool::new(own.kind) }
            }
        };
        let tool = Tool {
            name: choice.to_string(),
            number: own.number.unwrap_or(usual.number),
            feed: own.feed.unwrap_or(usual.feed),
            plunge: own.plunge.unwrap_or(usual.plunge),
            spindle: own.spindle.unwrap_or(usual.spindle),
            point: own.point.unwrap_or(self.point),
            ..usual
        };
        Ok(Fetched { tool, depth: own.depth })
    }

    fn unknown(&self, key: &'static str, name: &str) -> Error {
        let problem = format!(
            "no tool is called `{name}`: expected vbit:TIP:ANGLE, endmill:DIAMETER, drill:DIAMETER, or one of {}",
            self.library.names().join(", ")
        );
        Error::Value { key, problem }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Options;
    use super::*;

    fn options(text: &str) -> Options {
        Options::from_toml("voromill.toml", text).expect("options")
    }

    const ENGRAVER: &str = "[tools.fine]\nkind = \"vbit\"\ntip = \"0.1mm\"\nangle = \"30deg\"\nfeed = \"90mm/min\"\nnumber = 7\n";

    #[test]
    fn a_table_is_a_tool_and_the_command_line_wins_over_it() {
        let file = options(ENGRAVER);
        let fetch = |options: Options| {
            let feed = options.feed.unwrap_or(Feed::from_mm_per_min(200));
            let workshop = Workshop {
                library: &options.tools,
                feed,
                plunge: feed,
                spindle: 9000,
                drilling: DrillSpeeds::default(),
                point: crate::toolpath::POINT,
            };
            workshop.fetch("tool", &"fine".parse().expect("a name")).expect("a tool").tool
        };
        let tool = fetch(Options::default().or(file.clone()));
        assert_eq!((tool.number, tool.feed), (7, Feed::from_mm_per_min(90)), "as the table says");
        assert_eq!((tool.name.as_str(), tool.spindle), ("fine", 9000), "and the settings for the rest");
        let fast = Options { feed: Some(Feed::from_mm_per_min(400)), ..Options::default() };
        assert_eq!(fetch(fast.or(file)).feed, Feed::from_mm_per_min(400), "the command line holds for all");
    }

    #[test]
    fn tables_that_are_no_tools_are_refused_where_they_stand() {
        for (table, expected) in [
            ("kind = \"vbit\"\ntip = \"0.1mm\"", "tip and angle"),
            ("kind = \"endmill\"\ntip = \"0.1mm\"", "only diameter"),
            ("kind = \"endmill\"\ndiameter = \"0mm\"", "0.01 mm or more"),
            ("kind = \"endmill\"\ndiameter = \"0.005mm\"", "0.01 mm or more"),
            ("kind = \"endmill\"\ndiameter = \"1mm\"\nkerf = \"2mm\"", "at any depth"),
            ("kind = \"vbit\"\ntip = \"0.1mm\"\nangle = \"30deg\"\nkerf = \"0.05mm\"", "wider"),
            ("kind = \"drill\"\ndiametre = \"1mm\"", "did you mean `diameter`"),
            ("kind = \"drill\"\ndiameter = \"1mm\"\nangle = \"190deg\"", "180deg"),
            ("kind = \"endmill\"\ndiameter = \"1mm\"\ncarbide = true", "only for a drill"),
            ("kind = \"drill\"\ndiameter = \"1mm\"\nnumber = 0", "from 1"),
        ] {
            let error =
                Options::from_toml("voromill.toml", &format!("[tools.x]\n{table}\n")).expect_err(table);
            let error = error.to_string();
            assert!(error.contains(expected) && error.starts_with("voromill.toml:"), "{table}: {error}");
        }
    }

    #[test]
    fn a_name_nobody_knows_is_refused_with_those_that_are() {
        let error = super::super::Settings::resolve(options(&format!("tool = \"fein\"\n{ENGRAVER}")));
        let error = error.expect_err("unknown").to_string();
        assert!(error.contains("`fein`") && error.contains("engraver") && error.contains("fine"), "{error}");
    }
}
