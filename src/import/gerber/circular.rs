//! Circular interpolation (G02, G03 with G74 or G75; specification §4.7 and §8.1.10).

use std::ops::Range;

use crate::geometry::{Arc, Nm, Point, Turn, Vector};
use crate::import::diagnostic;

use super::super::error::Error;
use super::quadrants::{Quadrants, Reading};
use super::radii::{COARSE, Verdict, single_quadrant};
use super::reader::{Reader, Words};
use super::state::Unit;

impl<'a> Reader<'a> {
    /// The arc from `from` to `to`; none where it is no longer than a point or has no radius, and
    /// so is a line.
    pub(super) fn arc(
        &mut self,
        from: Point,
        to: Point,
        turn: Turn,
        words: Words,
        place: &Range<usize>,
    ) -> Result<Option<Arc>, Error> {
        let format = self.format(place)?;
        let mut offset = Vector::default();
        if let Some(i) = words.i {
            offset.x = self.coordinate(i, format.x, place)?;
        }
        if let Some(j) = words.j {
            offset.y = self.coordinate(j, format.y, place)?;
        }
        if offset == Vector::default() {
            if from != to {
                let message = "an arc without a centre (I and J) is read as a line";
                self.warnings.add(&diagnostic::ARC_WITHOUT_CENTRE, place.clone(), message);
            }
            return Ok(None);
        }
        self.radii[Self::index(self.quadrants)].add((from, to), offset, turn, place);
        let signed = offset.x < Nm::ZERO || offset.y < Nm::ZERO;
        let quadrants = match self.reading.of(self.quadrants) {
            Quadrants::Single if signed => {
                let message = "this arc has a negative offset, so it is read as G75, multi quadrant";
                self.warnings.add(&diagnostic::QUADRANT_MODE, place.clone(), message);
                Quadrants::Multi
            }
            quadrants => quadrants,
        };
        let center = match quadrants {
            Quadrants::Multi => from + offset,
            Quadrants::Single if from == to => return Ok(None),
            Quadrants::Single => single_quadrant(from, to, offset, turn).unwrap_or(from + offset),
        };
        let mismatch = center.distance(from) - center.distance(to);
        if mismatch.abs() > COARSE {
            let message = "the start and the end of an arc lie at different distances from its centre; the radius is interpolated";
            self.warnings.add(&diagnostic::ARC_RADIUS_MISMATCH, place.clone(), message);
        }
        let turn = if self.placement.mirrors() { turn.reversed() } else { turn };
        let (start, end) = (self.place(from, place)?, self.place(to, place)?);
        let center = start + self.placement.vector(center - from);
        Ok(Some(Arc { start, end, center, turn }))
    }

    /// Where the radii of arcs so declared are kept.
    const fn index(declared: Option<Quadrants>) -> usize {
        match declared {
            Some(Quadrants::Single) => 0,
            Some(Quadrants::Multi) => 1,
            None => 2,
        }
    }

    /// How what has been read so far asks for the file to be read: the radii of its arcs, and how
    /// large the board is that it draws.
    pub(super) fn reading_by_evidence(&self) -> Reading {
        let [single, multi, undeclared] = &self.radii;
        let declared = |mode| match mode {
            Quadrants::Single => single.refutes(mode).map_or(mode, |(other, _)| other),
            Quadrants::Multi => multi.refutes(mode).map_or(mode, |(other, _)| other),
        };
        let undeclared = match undeclared.verdict() {
            Verdict::Single(_) => Quadrants::Single,
            Verdict::Multi(_) | Verdict::Either | Verdict::Contradiction { .. } => Quadrants::Multi,
        };
        let unit = self.is_too_wide().then_some(Unit::Millimetre);
        Reading { unit, single: declared(Quadrants::Single), multi: declared(Quadrants::Multi), undeclared }
    }

    /// Says how arcs are read that the file leaves open or declares against their radii.
    ///
    /// # Errors
    ///
    /// Arcs that the file leaves open, and that contradict each other or fit neither way.
    pub(super) fn explain_arcs(&mut self) -> Result<(), Error> {
        let [single, multi, undeclared] = self.radii.clone();
        for (radii, declared, name) in [(single, Quadrants::Single, "G74"), (multi, Quadrants::Multi, "G75")]
        {
            if let Some((other, misfits)) = radii.refutes(declared) {
                let message = format!(
                    "the file declares {name}, but its arcs are read as {}: {misfits} of {} would begin and end at different radii, and now none does",
                    other.describe(),
                    radii.count
                );
                self.warnings.add(&diagnostic::QUADRANT_MODE, radii.first, message);
            }
        }
        if undeclared.count == 0 {
            return Ok(());
        }
        let count = undeclared.count;
        let reason = match undeclared.verdict() {
            Verdict::Contradiction { single, multi } => {
                let what = format!(
                    "neither G74 nor G75 is set, and the arcs contradict each other: of {count} arcs {} fit only G74, and {} fit only G75, as this one",
                    single.count, multi.count
                );
                let place = multi.first.clone();
                return Err(self.error(place, what, "G74 or G75 before the first arc", WRITE_AGAIN));
            }
            Verdict::Single(misfits) => {
                format!("as G75, {misfits} of {count} would begin and end at different radii")
            }
            Verdict::Multi(misfits) => format!(
                "as G74, {misfits} of {count} would begin and end at different radii, or be longer than a quarter circle"
            ),
            Verdict::Either => "their radii fit both".to_owned(),
        };
        if let Some(place) = undeclared.unfit {
            let what = "neither G74 nor G75 is set, and this arc fits neither: its ends lie at different distances from its centre";
            return Err(self.error(place, what, "G74 or G75 before the first arc", WRITE_AGAIN));
        }
        let message = format!(
            "neither G74 nor G75 is set; arcs are read as {}: {reason}",
            self.reading.undeclared.describe()
        );
        self.warnings.add(&diagnostic::QUADRANT_MODE, undeclared.first, message);
        Ok(())
    }
}

const WRITE_AGAIN: &str = "export the layer with G75";
