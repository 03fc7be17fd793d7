//! Circular interpolation (G02, G03 with G74 or G75; specification §4.7 and §8.1.10).

use crate::geometry::{Nm, Point, Turn, Vector};
use crate::import::diagnostic;
use crate::import::error::Warnings;

use super::fault::{Fault, Here};
use super::quadrants::{Quadrants, Reading};
use super::radii::{COARSE, Radii, Verdict, single_quadrant};

/// How the arcs of a file give their centres, and what their radii tell of it.
#[derive(Debug)]
pub(super) struct Arcs {
    reading: Reading,
    declared: Option<Quadrants>,
    /// Of the arcs after G74, after G75, and before either.
    radii: [Radii; 3],
}

impl Arcs {
    pub(super) fn new(reading: Reading) -> Self {
        Self { reading, declared: None, radii: Default::default() }
    }

    /// G74 and G75.
    pub(super) const fn declare(&mut self, quadrants: Quadrants) {
        self.declared = Some(quadrants);
    }

    /// Where the centre of the arc lies; none where it is no longer than a point or has no radius,
    /// and so is a line.
    pub(super) fn center(
        &mut self,
        (from, to): (Point, Point),
        offset: Vector,
        turn: Turn,
        here: &mut Here<'_, '_>,
    ) -> Option<Point> {
        if offset == Vector::default() {
            if from != to {
                let message = "an arc without a centre (I and J) is read as a line";
                here.warn(&diagnostic::ARC_WITHOUT_CENTRE, message);
            }
            return None;
        }
        let index = match self.declared {
            Some(Quadrants::Single) => 0,
            Some(Quadrants::Multi) => 1,
            None => 2,
        };
        self.radii[index].add((from, to), offset, turn, &here.place);
        let signed = offset.x < Nm::ZERO || offset.y < Nm::ZERO;
        let quadrants = match self.reading.of(self.declared) {
            Quadrants::Single if signed => {
                let message = "this arc has a negative offset, so it is read as G75, multi quadrant";
                here.warn(&diagnostic::QUADRANT_MODE, message);
                Quadrants::Multi
            }
            quadrants => quadrants,
        };
        let center = match quadrants {
            Quadrants::Multi => from + offset,
            Quadrants::Single if from == to => return None,
            Quadrants::Single => single_quadrant(from, to, offset, turn).unwrap_or(from + offset),
        };
        let mismatch = center.distance(from) - center.distance(to);
        if mismatch.abs() > COARSE {
            let message = "the start and the end of an arc lie at different distances from its centre; the radius is interpolated";
            here.warn(&diagnostic::ARC_RADIUS_MISMATCH, message);
        }
        Some(center)
    }

    /// How the radii seen so far ask for the file to be read, its lengths as they were.
    pub(super) fn reading_by_evidence(&self) -> Reading {
        let [single, multi, undeclared] = &self.radii;
        let undeclared = match undeclared.verdict() {
            Verdict::Single(_) => Quadrants::Single,
            Verdict::Multi(_) | Verdict::Either | Verdict::Contradiction { .. } => Quadrants::Multi,
        };
        Reading {
            unit: None,
            single: single.refutes(Quadrants::Single).map_or(Quadrants::Single, |(other, _)| other),
            multi: multi.refutes(Quadrants::Multi).map_or(Quadrants::Multi, |(other, _)| other),
            undeclared,
        }
    }

    /// Says how arcs are read that the file leaves open or declares against their radii.
    ///
    /// # Errors
    ///
    /// Arcs that the file leaves open, and that contradict each other or fit neither way.
    pub(super) fn explain(&self, warnings: &mut Warnings<'_>) -> Result<(), Fault> {
        let [single, multi, undeclared] = &self.radii;
        for (radii, declared, name) in [(single, Quadrants::Single, "G74"), (multi, Quadrants::Multi, "G75")]
        {
            if let Some((other, misfits)) = radii.refutes(declared) {
                let message = format!(
                    "the file declares {name}, but its arcs are read as {}: {misfits} of {} would begin and end at different radii, and now none does",
                    other.describe(),
                    radii.count
                );
                warnings.add(&diagnostic::QUADRANT_MODE, radii.first.clone(), message);
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
                return Err(undecided(what).at(&multi.first));
            }
            Verdict::Single(misfits) => {
                format!("as G75, {misfits} of {count} would begin and end at different radii")
            }
            Verdict::Multi(misfits) => format!(
                "as G74, {misfits} of {count} would begin and end at different radii, or be longer than a quarter circle"
            ),
            Verdict::Either => "their radii fit both".to_owned(),
        };
        if let Some(place) = &undeclared.unfit {
            let what = "neither G74 nor G75 is set, and this arc fits neither: its ends lie at different distances from its centre";
            return Err(undecided(what).at(place));
        }
        let message = format!(
            "neither G74 nor G75 is set; arcs are read as {}: {reason}",
            self.reading.undeclared.describe()
        );
        warnings.add(&diagnostic::QUADRANT_MODE, undeclared.first.clone(), message);
        Ok(())
    }
}

fn undecided(what: impl Into<String>) -> Fault {
    Fault::new(what, "G74 or G75 before the first arc").hint("export the layer with G75")
}
