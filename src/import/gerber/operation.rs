//! D01, D02 and D03: what is drawn where (specification §4.8).

use std::ops::Range;
use std::sync::Arc as Shared;

use crate::board::polarity::Polarity;
use crate::board::{Axis, Feature, Shape};
use crate::geometry::{Nm, Point, Rect};
use crate::import::diagnostic;

use super::super::error::Error;
use super::aperture::{Form, Template};
use super::canvas::{Refusal, moved};
use super::draw;
use super::lex::{Block, Number};
use super::reader::{Interpolation, Operation, Reader, Words};
use super::state::Linear;

impl<'a> Reader<'a> {
    /// Carries out D01, D02 or D03.
    pub(super) fn operate(&mut self, words: Words, block: &Block<'a>) -> Result<(), Error> {
        let place = block.place();
        let operation = match (words.operation, self.operation) {
            (Some(operation), _) => operation,
            (None, Some(operation)) => {
                let message = "a coordinate without D01, D02 or D03 repeats the previous operation";
                self.warnings.add(&diagnostic::OPERATION_CODE_MISSING, place.clone(), message);
                operation
            }
            (None, None) => {
                let message =
                    "a coordinate without D01, D02 or D03, and none before it, is read as a move (D02)";
                self.warnings.add(&diagnostic::OPERATION_CODE_MISSING, place.clone(), message);
                Operation::Move
            }
        };
        self.operation = Some(operation);
        let from = self.position;
        let to = self.target(words, &place)?;
        self.position = to;
        match operation {
            Operation::Move => self.end_contour(),
            Operation::Flash => self.flash(to, block),
            Operation::Draw => self.draw(from, to, words, block),
        }
    }

    /// Where the operation leads, in the file's coordinates.
    pub(super) fn target(&mut self, words: Words, place: &Range<usize>) -> Result<Point, Error> {
        let mut to = self.position;
        if let Some(x) = words.x {
            let format = self.format(place)?;
            let base = if format.incremental { to.x } else { Nm::ZERO };
            to.x = base + self.coordinate(x, format.x, place)?;
        }
        if let Some(y) = words.y {
            let format = self.format(place)?;
            let base = if format.incremental { to.y } else { Nm::ZERO };
            to.y = base + self.coordinate(y, format.y, place)?;
        }
        if Nm::try_new(to.x.get()).is_err() || Nm::try_new(to.y.get()).is_err() {
            return Err(self.refused(place.clone(), &Refusal::Range));
        }
        Ok(to)
    }

    pub(super) fn coordinate(
        &mut self,
        number: Number,
        places: (u32, u32),
        at: &Range<usize>,
    ) -> Result<Nm, Error> {
        let (format, unit) = (self.format(at)?, self.unit(at)?);
        let coordinate = format.coordinate(number, places, unit);
        self.is_beyond |= coordinate.is_none();
        coordinate.ok_or_else(|| {
            self.error(
                at.clone(),
                "this coordinate is out of range",
                "coordinates within ±1073.741823 mm",
                "check the number format and the units of the file",
            )
        })
    }

    /// Where `p` of the file lies on the board.
    pub(super) fn place(&self, p: Point, at: &Range<usize>) -> Result<Point, Error> {
        let p = self.placement.point(p);
        if Nm::try_new(p.x.get()).is_err() || Nm::try_new(p.y.get()).is_err() {
            return Err(self.refused(at.clone(), &Refusal::Range));
        }
        Ok(p)
    }

    pub(super) fn flash(&mut self, at: Point, block: &Block<'a>) -> Result<(), Error> {
        let place = block.place();
        if self.region.is_some() {
            self.warnings.add(&diagnostic::FLASH_IN_REGION, place, "a flash between G36 and G37 is ignored");
            return Ok(());
        }
        let at = self.place(at, &place)?;
        let number = self.selected(&place)?;
        let set = self.set();
        self.counts.flashes += 1;
        let aperture = self.apertures.get_mut(&number).expect("selected");
        aperture.flashes += 1;
        if let Template::Block(objects) = &*aperture.template {
            let (objects, linear) = (Shared::clone(objects), self.linear());
            return self.expand(&objects, linear, at, set, block);
        }
        let form = self.form(number, &place)?;
        let shapes = draw::flash(&form, at);
        if shapes.is_empty() {
            self.warnings.add(
                &diagnostic::NOTHING_DRAWN,
                place,
                format!("D{number} has no area; its flashes are ignored"),
            );
            return Ok(());
        }
        self.push_all(shapes, Axis::Flash(at), set, block)
    }

    /// Draws the objects of a block aperture.
    pub(super) fn expand(
        &mut self,
        objects: &[(Feature, Polarity)],
        linear: Linear,
        at: Point,
        set: u32,
        block: &Block<'a>,
    ) -> Result<(), Error> {
        let way = at - Point::default();
        for (feature, polarity) in objects {
            let mut feature = moved(feature, linear, way);
            if feature.attributes == 0 {
                feature.attributes = set;
            }
            let polarity = if self.polarity == Polarity::Clear { polarity.toggled() } else { *polarity };
            self.canvas.push((feature, polarity)).map_err(|refusal| self.refused(block.place(), &refusal))?;
        }
        Ok(())
    }

    pub(super) fn draw(
        &mut self,
        from: Point,
        to: Point,
        words: Words,
        block: &Block<'a>,
    ) -> Result<(), Error> {
        let place = block.place();
        let arc = match self.interpolation {
            Interpolation::Linear => None,
            Interpolation::Circular(turn) => self.arc(from, to, turn, words, &place)?,
        };
        let (from, to) = (self.place(from, &place)?, self.place(to, &place)?);
        if let Some(region) = &mut self.region {
            region.begin(from, block.line, &place);
            match arc {
                None => region.line(to),
                Some(arc) => {
                    region.arc(arc);
                    let cost = arc.chords(crate::board::FLATTEN) as u64;
                    self.canvas.charge(cost).map_err(|refusal| self.refused(place, &refusal))?;
                }
            }
            return Ok(());
        }
        let number = self.selected(&place)?;
        let set = self.set();
        let form = self.form(number, &place)?;
        self.apertures.get_mut(&number).expect("selected").draws += 1;
        let (shapes, axis) = match arc {
            None => {
                self.counts.strokes += 1;
                self.reaches(&form, Rect::new(from, to), &place)?;
                (draw::line(&form, from, to), Axis::Line(from, to))
            }
            Some(arc) => {
                self.counts.arcs += 1;
                self.reaches(&form, arc.bounds(), &place)?;
                let cost = draw::effort(&form, &arc);
                self.canvas.charge(cost).map_err(|refusal| self.refused(place, &refusal))?;
                (draw::along(&form, arc), Axis::Arc(arc))
            }
        };
        self.push_all(shapes, axis, set, block)
    }

    /// Checks that `form`, drawn anywhere in `bounds`, stays in the range of coordinates.
    pub(super) fn reaches(&self, form: &Form, bounds: Rect, place: &Range<usize>) -> Result<(), Error> {
        let own = match form {
            Form::Disc(_) => return Ok(()),
            Form::Obround { half, radius } => {
                Rect::new(Point::default() - *half, Point::default() + *half).inflate(*radius)
            }
            Form::Area { hull, .. } => match Rect::around(hull.iter().copied()) {
                Some(own) => own,
                None => return Ok(()),
            },
        };
        let low = (bounds.min().x + own.min().x).min(bounds.min().y + own.min().y);
        let high = (bounds.max().x + own.max().x).max(bounds.max().y + own.max().y);
        if low >= Nm::MIN && high <= Nm::MAX {
            return Ok(());
        }
        Err(self.refused(place.clone(), &Refusal::Range))
    }

    pub(super) fn push_all(
        &mut self,
        shapes: Vec<Shape>,
        axis: Axis,
        set: u32,
        block: &Block<'a>,
    ) -> Result<(), Error> {
        for shape in shapes {
            let feature = Feature { shape, axis, attributes: set, line: block.line };
            let pushed = self.canvas.push((feature, self.polarity));
            pushed.map_err(|refusal| self.refused(block.place(), &refusal))?;
        }
        Ok(())
    }
}
