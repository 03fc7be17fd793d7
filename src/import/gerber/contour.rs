//! The end of a contour within a region (G36, G37; specification §4.10).

use crate::board::{Axis, Feature, Shape};
use crate::geometry::{Nm, Point};
use crate::import::diagnostic;

use super::super::error::Error;
use super::canvas::Refusal;
use super::reader::Reader;

impl<'a> Reader<'a> {
    pub(super) fn end_contour(&mut self) -> Result<(), Error> {
        let Some(region) = &mut self.region else { return Ok(()) };
        let in_range = |p: Point| p.x.abs() <= Nm::MAX && p.y.abs() <= Nm::MAX;
        let reaches = region.all(in_range);
        let Some(contour) = region.finish() else { return Ok(()) };
        if !reaches {
            return Err(self.refused(contour.place, &Refusal::Range));
        }
        if contour.tangled {
            return Err(self.refused(contour.place, &Refusal::Tangled));
        }
        if !contour.closed {
            let message = "the contour of a region is not closed; a straight line closes it";
            self.warnings.add(&diagnostic::REGION_NOT_CLOSED, contour.place.clone(), message);
        }
        if contour.pieces.is_empty() {
            let message = "the contour of a region has no area; it is ignored";
            self.warnings.add(&diagnostic::NOTHING_DRAWN, contour.place, message);
            return Ok(());
        }
        self.counts.regions += 1;
        let set = self.set();
        for piece in contour.pieces {
            let shape = Shape::Polygon(piece);
            let feature = Feature { shape, axis: Axis::Region, attributes: set, line: contour.line };
            let pushed = self.canvas.push((feature, self.polarity));
            pushed.map_err(|refusal| self.refused(contour.place.clone(), &refusal))?;
        }
        Ok(())
    }
}
