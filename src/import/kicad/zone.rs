//! Zones: the areas that KiCad filled, as it saved them.
//!
//! Filling a zone is KiCad's work, and another program would fill it otherwise. So the areas in the
//! file are read as they are, and a board whose zones were never filled is an error. Until version
//! 5, the edge of an area is drawn with a pen of the zone's least width on top of it; since then,
//! areas are saved as they are (`filled_areas_thickness no`).

use super::curve::line;
use super::layers::Layers;
use super::reader::Reader;
use super::ring::Drawing;
use super::tree::Node;
use crate::board::{Axis, Shape, Side, polarity};
use crate::geometry::{Nm, Point};
use crate::import::diagnostic;
use crate::import::error::Error;

/// The most that the areas of all zones may cost, in vertices of booleans: about a microsecond
/// each. Chosen: many times what the densest pours take.
const MOST_EFFORT: u64 = 16_000_000;

impl Reader<'_> {
    /// Fails for an area whose booleans would take too long, with what to do about it.
    pub(super) fn refuse_tangled(
        &mut self,
        points: &Vec<Point>,
        area: Node<'_>,
        hint: &'static str,
    ) -> Result<(), Error> {
        self.effort += polarity::effort([points].into_iter());
        if self.effort <= MOST_EFFORT && !polarity::is_tangled([points].into_iter()) {
            return Ok(());
        }
        let what = "this area crosses itself too often";
        let expected = "an area that does not cross itself";
        Err(Error::syntax(self.name, self.bytes, area.place(), what, expected, hint))
    }

    /// A zone; one that keeps copper out draws none.
    pub(super) fn zone(&mut self, node: Node<'_>) -> Result<(), Error> {
        let layers = self.layers(node);
        if node.find("keepout").is_some() || !layers.is_copper() {
            return Ok(());
        }
        self.count("zones");
        if let Some(lines) = node.find("fill_segments") {
            let what = "a zone with line fill, as in old versions";
            let expected = "a zone with solid fill";
            let hint = "choose solid fill for it in KiCad, fill it (press B) and save";
            return Err(Error::syntax(self.name, self.bytes, lines.place(), what, expected, hint));
        }
        let pen = self.zone_pen(node)?;
        let attributes = self.conductor(node, "Conductor");
        let mut any = false;
        for area in node.all("filled_polygon") {
            let own = self.layers(area);
            // Until version 5 a zone has one layer, and its areas name none.
            let on = if area.find("layer").is_some() { own } else { layers };
            let Some(points) = area.find("pts") else { return Err(self.lacks(area, "`(pts (xy …) …)`")) };
            let frame = self.frame;
            let points = self.points(points, &frame)?;
            self.refuse_tangled(&points, area, "fill it again in KiCad (press B) and save")?;
            let drawing = filled(&points, pen);
            for side in on.sides() {
                any = true;
                self.put(side, area, drawing.clone(), &attributes)?;
            }
        }
        if any {
            self.filled_zones += 1;
        } else {
            let was_filled = node.find("fill").is_some_and(|fill| fill.has_word("yes"));
            self.bare_zones.push((
                node.place(),
                zone_name(node, attributes.net.as_deref(), layers),
                was_filled,
            ));
        }
        Ok(())
    }

    /// The width of the pen that draws the edge of each area; nothing where none does.
    fn zone_pen(&self, node: Node<'_>) -> Result<Nm, Error> {
        /// The last version of the format whose areas may want a pen: that of KiCad 6.
        const LAST: u32 = 20_211_014;
        let denied = node.find("filled_areas_thickness").is_some() && !node.says("filled_areas_thickness");
        let saved_bare = denied || self.version > LAST;
        match node.find("min_thickness") {
            Some(width) if !saved_bare => self.length(width, 0),
            _ => Ok(Nm::ZERO),
        }
    }

    /// Fails for zones that were not filled; warns of those that nothing is left of.
    pub(super) fn judge_zones(&mut self) -> Result<(), Error> {
        let zones = std::mem::take(&mut self.bare_zones);
        let bare = |(_, _, was_filled): &&(_, String, bool)| !was_filled || self.filled_zones == 0;
        let count = zones.iter().filter(bare).count();
        if let Some((place, name, _)) = zones.iter().find(bare) {
            let others = if count > 1 { format!(", and {} more", count - 1) } else { String::new() };
            let what = format!("{name} is not filled{others}, so its copper is not in the file");
            let place = place.start..place.end.min(place.start + "(zone".len());
            let expected = "a zone with its `(filled_polygon …)`";
            let hint = "open the board in KiCad, press B (Edit, Fill All Zones), and save it";
            return Err(Error::syntax(self.name, self.bytes, place, what, expected, hint));
        }
        for (place, name, _) in zones {
            let message = format!("{name} is filled, but has no copper");
            self.warnings.add(&diagnostic::KICAD_ZONE_EMPTY, place, message);
        }
        Ok(())
    }
}

/// What a message calls a zone.
fn zone_name(node: Node<'_>, net: Option<&str>, layers: Layers) -> String {
    let name = node.find("name").and_then(|name| name.argument(0)).map(|name| name.text().into_owned());
    let called = name.filter(|name| !name.is_empty()).map_or_else(String::new, |name| format!(" {name}"));
    let of = net.map_or_else(String::new, |net| format!(" of net {net}"));
    let on = match (layers.on(Side::Front), layers.on(Side::Back)) {
        (true, true) => "F.Cu and B.Cu",
        (true, false) => "F.Cu",
        _ => "B.Cu",
    };
    format!("the zone{called}{of} on {on}")
}

/// The area inside `points`, and its edge drawn with a pen. Cut-ins become holes.
fn filled(points: &[Point], pen: Nm) -> Drawing {
    let mut drawing = Drawing::new();
    if points.len() >= 3 {
        let pieces = polarity::clean(&[points.to_vec()]);
        drawing.extend(pieces.into_iter().map(|piece| (Shape::Polygon(piece), Axis::Region)));
    }
    if pen > Nm::ZERO {
        let next = points.iter().cycle().skip(1);
        drawing.extend(points.iter().zip(next).map(|(&from, &to)| line(from, to, pen / 2)));
    }
    drawing
}
