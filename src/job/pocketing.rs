//! Artwork → the programs that mill it as pockets, and what they do.

use crate::board::Warning;
use crate::board::polarity::offset;
use crate::geometry::{Nm, Polygon, Rect};
use crate::toolpath::strategy::{self, Entries, Levels, Sequence};
use crate::toolpath::{Angle, Direction, Heights, Placement, Tool, ToolKind};
use crate::verify::carving::Text;
use crate::verify::pocketing::{self, Floor, Pocketed};
use crate::voronoi::medial::nest::Nest;

use super::art::{self, Art, OneTool, placed, round, written};
use super::{CARVING_OPTIONS, Error, Length, Overlap, Settings};

/// How pockets are milled.
#[derive(Clone, Debug, PartialEq)]
pub struct Pocketing {
    /// How much one pass takes; none for all at once.
    pub step: Option<Nm>,
    /// How far neighbouring loops are apart: a length, or a part of the tool's diameter; at most
    /// half of it.
    pub stepover: Overlap,
    /// What is left along the edge for a last loop; zero for none.
    pub stock: Nm,
    /// In which order loops are milled.
    pub sequence: Sequence,
    /// How steeply the tool goes down, above 0° and below 90°.
    pub ramp: Angle,
    /// Mill what lies round the areas, up to so far from them, and leave them standing.
    pub raised: Option<Nm>,
}

/// The programs and what they are to do.
#[derive(Clone, Debug)]
pub struct Pocket {
    /// What it is called.
    pub name: String,
    /// The areas that are milled, on the machine.
    pub areas: Vec<Polygon>,
    /// How deep.
    pub depth: Nm,
    /// A program for each tool, in the order in which they are run.
    pub programs: Vec<OneTool>,
    /// How the first tool comes down.
    pub entries: Entries,
    /// What a person must know.
    pub warnings: Vec<Warning>,
    how: Pocketing,
    levels: Vec<f64>,
}

/// How much nearer to the edge than the tool's radius its middle may be, so that a slot as wide as
/// the tool is one still. Chosen: rounding is less, and a cut may be off by four times as much.
const WITHIN: f64 = 500.0;

/// What is off by less than this is right, when a program is judged. Chosen: twice the tolerance of
/// the cut and what writing rounds.
const TOLERATED: Nm = Nm::from_um(5);

/// Rows are looked at so far apart at least, and so many of them at most.
const FINEST: Nm = Nm::from_um(5);
const MOST_ROWS: i64 = 10_000;

/// The options of a job that change pockets, by name: those of carving, and two more.
pub const POCKETING_OPTIONS: &[&str] = &["depth", "direction"];

/// Plans the programs that mill `art`.
///
/// # Errors
///
/// [`Error::Value`] for a tool that is no end mill and lengths that make no sense, and for areas
/// that are all narrower than the tool.
pub fn pocket(art: Art, settings: &Settings, how: &Pocketing) -> Result<Pocket, Error> {
    let (tool, heights) = end_mill(settings)?;
    let heights = Heights { step: how.step, ..heights };
    let levels = levels(tool, settings, how)?;
    let areas = match how.raised {
        None => art.areas.clone(),
        Some(margin) => round(&art.areas, margin),
    };
    let bounds = areas.iter().map(Polygon::bounds).reduce(Rect::union);
    let bounds = bounds.ok_or_else(|| Error::NoCopper("in it: nothing to mill".to_owned()))?;
    let placement = Placement::front(settings.origin, bounds, settings.rotate, settings.offset);
    let areas: Vec<Polygon> = areas.iter().map(|area| placed(area, &placement)).collect();
    let nest = Nest::new(&areas, |level| levels.at(level));
    if nest.roots.is_empty() {
        let problem = format!("everything is narrower than `{}`: nothing is milled", tool.kind);
        return Err(Error::Value { key: "tool", problem });
    }
    let mut warnings = art.warnings.clone();
    let plan = strategy::Pocketing {
        tool,
        heights,
        levels,
        sequence: how.sequence,
        direction: settings.direction.unwrap_or(Direction::Climb),
        ramp: how.ramp,
        tolerance: settings.tolerance,
    };
    let (section, entries) = strategy::pocket(format!("pocket {}", art.name), &nest, &plan);
    warnings.extend(flaws(&areas, tool, &nest, entries));
    let (one, found) = written(&art, ("", "pocket", 1), section, settings, said(settings, how));
    warnings.extend(found);
    let deepest = nest.loops.iter().map(|one| one.level).max().unwrap_or(0);
    Ok(Pocket {
        name: art.name,
        areas,
        depth: heights.cut,
        programs: vec![one],
        entries,
        warnings,
        how: how.clone(),
        levels: (0..=deepest + 1).map(|level| levels.at(level)).collect(),
    })
}

/// The one tool, which must be an end mill, and how it goes.
fn end_mill(settings: &Settings) -> Result<(&Tool, Heights), Error> {
    let wrong = |problem: String| Err(Error::Value { key: "tool", problem });
    match settings.isolation.as_slice() {
        [one] if matches!(one.tool.kind, ToolKind::EndMill { .. }) => Ok((&one.tool, one.heights)),
        [one] => {
            wrong(format!("`{}` is no end mill: a flat floor needs one, such as endmill:1mm", one.tool.kind))
        }
        several => wrong(format!("a pocket takes one end mill, and here are {} tools", several.len())),
    }
}

/// How far loops are from the edge.
fn levels(tool: &Tool, settings: &Settings, how: &Pocketing) -> Result<Levels, Error> {
    let wrong = |key: &'static str, problem: String| Err(Error::Value { key, problem });
    let diameter = tool.width_at(Nm::ZERO);
    let step = how.stepover.of(diameter);
    if step <= Nm::ZERO || step > diameter / 2 {
        return wrong(
            "stepover",
            format!(
                "`{}` is not between nothing and half the tool's diameter: farther apart, loops leave material in corners",
                how.stepover
            ),
        );
    }
    if how.step.is_some_and(|step| step <= Nm::ZERO) {
        return wrong("depth-pass", "a pass of nothing makes no sense: it must be above zero".to_owned());
    }
    if how.stock < Nm::ZERO || how.stock > diameter / 2 {
        let problem = format!("{} is not between nothing and half the tool's diameter", Length(how.stock));
        return wrong("stock", problem);
    }
    if how.ramp <= Angle::ZERO || how.ramp >= Angle::from_degrees(90) {
        return wrong("ramp", format!("{} makes no sense: expected above 0deg and below 90deg", how.ramp));
    }
    if how.raised.is_some_and(|margin| margin <= Nm::ZERO) {
        return wrong("margin", "a margin of nothing makes no sense: it must be above zero".to_owned());
    }
    // Each loop may be off its place by the tolerance.
    let most = diameter.to_f64() / 2.0 - 2.0 * settings.tolerance.to_f64();
    Ok(Levels {
        wall: diameter.to_f64() / 2.0 - WITHIN,
        stock: how.stock.to_f64(),
        step: step.to_f64().min(most),
    })
}

/// What the tool cannot do of the areas.
fn flaws(areas: &[Polygon], tool: &Tool, nest: &Nest, entries: Entries) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let radius = tool.width_at(Nm::ZERO) / 2;
    let narrow =
        areas.iter().filter(|area| offset(area, Nm::from_f64(WITHIN) - radius, Nm::from_um(1)).is_empty());
    let narrow = narrow.count();
    if narrow > 0 {
        let message =
            format!("{narrow} of {} areas are narrower than `{}`: they are left", areas.len(), tool.kind);
        warnings.push(Warning::new("narrower-than-tool", message));
    }
    if nest.flaws > 0 {
        let message = format!(
            "the Voronoi diagram of {} areas has a flaw: their loops are offset polygons instead",
            nest.flaws
        );
        warnings.push(Warning::new("loops-by-offsets", message));
    }
    if entries.straight > 0 {
        let message = format!(
            "at {} places the tool goes straight down, since there is no room for a ramp: it must be one that can drill",
            entries.straight
        );
        warnings.push(Warning::new("plunge-straight-down", message));
    }
    warnings
}

/// The settings that matter, for the header.
fn said(settings: &Settings, how: &Pocketing) -> Vec<(String, String)> {
    let mut listed = settings.options().listed();
    listed.retain(|(option, _)| {
        CARVING_OPTIONS.contains(&option.as_str()) || POCKETING_OPTIONS.contains(&option.as_str())
    });
    let mut say = |name: &str, text: Option<String>| {
        listed.extend(text.map(|text| (name.to_owned(), text)));
    };
    say("stepover", Some(how.stepover.to_string()));
    say("depth-pass", how.step.map(|step| Length(step).to_string()));
    say("stock", (how.stock > Nm::ZERO).then(|| Length(how.stock).to_string()));
    say("ramp", Some(how.ramp.to_string()));
    say("order", (how.sequence == Sequence::OutsideIn).then(|| "outside-in".to_owned()));
    say("raised", how.raised.map(|margin| Length(margin).to_string()));
    listed
}

impl Pocket {
    /// Judges its programs by the areas that are to be milled, in rows `pitch` apart; none for as
    /// many as take a second or so.
    ///
    /// # Errors
    ///
    /// [`Error::Verify`] for a text that cannot be followed.
    pub fn verify(&self, pitch: Option<Nm>) -> Result<Pocketed, Error> {
        self.compare(&art::texts(&self.programs), pitch)
    }

    /// The same of other programs, each with its name, in place of these.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for more or fewer programs than there are tools, [`Error::Verify`] for a
    /// text that cannot be followed.
    pub fn judge(&self, texts: &[(&str, &str)], pitch: Option<Nm>) -> Result<Pocketed, Error> {
        self.compare(&art::others(&self.programs, texts)?, pitch)
    }

    fn compare(&self, programs: &[Text<'_>], pitch: Option<Nm>) -> Result<Pocketed, Error> {
        let around = self.areas.iter().map(Polygon::bounds).reduce(Rect::union);
        let height = around.map_or(Nm::ZERO, Rect::height);
        let pitch = pitch.unwrap_or_else(|| (height / MOST_ROWS).max(FINEST));
        let passes = Heights { safe: Nm::ZERO, approach: Nm::ZERO, cut: self.depth, step: self.how.step }
            .passes()
            .count();
        let is_inside_out = self.how.sequence == Sequence::InsideOut;
        let levels = if is_inside_out { self.levels.as_slice() } else { &self.levels[..1] };
        let floor = Floor {
            areas: &self.areas,
            depth: self.depth,
            step: self.how.step,
            steepest: Some(libm::tan(self.how.ramp.radians())),
            plunges: Some((levels, passes)),
            tolerance: TOLERATED,
            pitch,
        };
        Ok(pocketing::pocketing(programs, &floor)?)
    }

    /// What its programs mill, as a picture at a slant: a PNG so many pixels wide.
    ///
    /// # Errors
    ///
    /// [`Error::Verify`] for a program that cannot be followed, [`Error::Grid`] for a picture that
    /// cannot be drawn.
    pub fn picture(&self, width: u32) -> Result<Vec<u8>, Error> {
        art::picture(&self.programs, &self.areas, width)
    }

    /// What it is, for a person.
    #[must_use]
    pub fn summary(&self) -> String {
        let [areas, entries] = [self.areas.len(), self.entries.all];
        let areas = if areas == 1 { "1 area".to_owned() } else { format!("{areas} areas") };
        let entries = if entries == 1 { "1 plunge".to_owned() } else { format!("{entries} plunges") };
        format!("{}: {areas} milled {:.3} mm deep, {entries}\n", self.name, self.depth)
            + &art::lines(&self.programs)
    }
}
