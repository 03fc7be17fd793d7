//! The number format and the unit in force, also where they come late or never.

use crate::geometry::{Nm, Point, Vector};
use crate::import::diagnostic;

use super::aperture_list::ApertureList;
use super::canvas::in_reach;
use super::fault::{Fault, Here};
use super::format::{Format, Unit};
use super::lex::{Number, one_line};

/// What numbers of the file mean.
#[derive(Debug)]
pub(super) struct Numbers<'a> {
    /// The list beside an RS-274-D file.
    list: Option<&'a ApertureList>,
    /// The unit where nothing says it; none where the number format decides.
    assumed: Option<Unit>,
    format: Option<Format>,
    /// What G90 or G91 says before there is a format.
    incremental: Option<bool>,
    unit: Option<Unit>,
    /// Whether MO gave the unit, rather than G70 or G71.
    by_mode: bool,
    /// Whether the number format gave it, because nothing else does.
    is_guessed: bool,
    /// Whether a coordinate was beyond what is handled.
    is_beyond: bool,
    /// Whether points in coordinates mean nothing; none before the first.
    idle_points: Option<bool>,
}

impl<'a> Numbers<'a> {
    pub(super) const fn new(list: Option<&'a ApertureList>, assumed: Option<Unit>) -> Self {
        Self {
            list,
            assumed,
            format: None,
            incremental: None,
            unit: None,
            by_mode: false,
            is_guessed: false,
            is_beyond: false,
            idle_points: None,
        }
    }

    /// FS.
    pub(super) fn set_format(&mut self, format: Format, here: &mut Here<'_, '_>) {
        let contradicts = self.incremental.take().is_some_and(|before| before != format.incremental);
        if contradicts || self.format.is_some_and(|before| before != format) {
            let message =
                "the number format changes within the file; coordinates after it are read with the new one";
            here.warn(&diagnostic::FORMAT_CHANGES, message);
        }
        self.format = Some(format);
    }

    /// G90 and G91, which may stand before the number format.
    pub(super) const fn set_incremental(&mut self, incremental: bool) {
        match &mut self.format {
            Some(format) => format.incremental = incremental,
            None => self.incremental = Some(incremental),
        }
    }

    /// MO.
    pub(super) fn set_unit(&mut self, unit: Unit, here: &mut Here<'_, '_>) -> Result<(), Fault> {
        if self.by_mode && self.unit != Some(unit) {
            let hint = "find out which of the two is right, and delete the other";
            return Err(Fault::new("the file declares two different units", "one %MO").hint(hint));
        }
        if self.unit.is_some_and(|before| before != unit) {
            let message = "%MO contradicts G70 or G71 before it; %MO is used";
            here.warn(&diagnostic::CONFLICTING_UNITS, message);
        }
        (self.unit, self.by_mode) = (Some(unit), true);
        Ok(())
    }

    /// G70 and G71, which MO overrides.
    pub(super) fn set_old_unit(&mut self, unit: Unit, here: &mut Here<'_, '_>) {
        if !self.by_mode {
            self.unit = Some(unit);
        } else if self.unit != Some(unit) {
            here.warn(&diagnostic::CONFLICTING_UNITS, "G70 or G71 contradicts %MO; %MO is used");
        }
    }

    /// The number format. Where none has been given yet, the file is searched for one that comes
    /// late.
    fn format(&mut self, here: &mut Here<'_, '_>) -> Result<Format, Fault> {
        if let Some(format) = self.format {
            return Ok(format);
        }
        if let Some(late) = here.ahead.clone().find(|block| block.text.starts_with(b"FS")) {
            let place = late.place();
            let format = Format::read(&one_line(&late.text[2..])).map_err(|fault| fault.at(&place));
            let message = "the number format comes after the first coordinate";
            here.warnings.add(&diagnostic::LATE_FORMAT, place, message);
            self.format = Some(format?);
        }
        self.format = self.format.or(self.list.and_then(|list| list.format));
        if let (Some(format), Some(incremental)) = (&mut self.format, self.incremental.take()) {
            format.incremental = incremental;
        }
        self.format.ok_or_else(|| self.unformatted(here.is_bare))
    }

    /// The fault of a file without a number format.
    fn unformatted(&self, is_bare: bool) -> Fault {
        if let Some(list) = self.list.filter(|list| list.contradictory) {
            let what =
                format!("the aperture list {} contradicts itself in which zeros are left out", list.file);
            let expected = "leading or trailing zeros: `LEADING ZEROS SUPPRESSED` in the list, or `%FSLAX23Y23*%` \
                            as the first line here";
            return Fault::new(what, expected).hint("the plot settings of the CAD program show the format");
        }
        if let Some(list) = self.list {
            let what = format!("neither this file nor its aperture list {} has a number format", list.file);
            let expected =
                "a number format: `%FSLAX23Y23*%` as the first line here, or `FORMAT 2.3` in the list";
            return Fault::new(what, expected).hint("the plot settings of the CAD program show the format");
        }
        let (what, expected) = if is_bare {
            let what = "this file (RS-274-D) has neither a number format nor aperture definitions";
            (
                what,
                "a number format, `%FSLAX46Y46*%`, and apertures, `%ADD10C,0.25*%`, before the first coordinate, \
                 or an aperture list (.apt, .gap, .rep) beside the file",
            )
        } else {
            let what = "this file has no number format";
            (what, "a number format, such as `%FSLAX46Y46*%`, before the first coordinate")
        };
        Fault::new(what, expected).hint("export the file as RS-274X")
    }

    /// The unit. Where none has been given yet, the file is searched for one that comes late.
    pub(super) fn unit(&mut self, here: &mut Here<'_, '_>) -> Result<Unit, Fault> {
        if let Some(unit) = self.unit {
            return Ok(unit);
        }
        let late = here.ahead.clone().find_map(|block| match block.text {
            [b'M', b'O', b'I', ..] | [b'G', b'7', b'0', ..] => Some((Unit::Inch, block)),
            [b'M', b'O', b'M', ..] | [b'G', b'7', b'1', ..] => Some((Unit::Millimetre, block)),
            _ => None,
        });
        let unit = if let Some((unit, block)) = late {
            let message = format!(
                "the unit, {}, comes after the first length; it holds for the whole file",
                unit.name()
            );
            here.warnings.add(&diagnostic::LATE_UNITS, block.place(), message);
            unit
        } else if let Some(list) = self.list {
            list.unit
        } else {
            // Four digits before the point are ten metres in millimetres and 250 m in inches.
            let usual = if self.format(here)?.x.0 >= 4 { Unit::Millimetre } else { Unit::Inch };
            let unit = self.assumed.unwrap_or(usual);
            self.is_guessed = true;
            let reason = if unit == usual {
                "as its number format suggests"
            } else {
                "because in inches it would be wider than any board"
            };
            let message = format!("the file does not declare its unit; {} is assumed, {reason}", unit.name());
            here.warn(&diagnostic::MISSING_UNITS, message);
            unit
        };
        self.unit = Some(unit);
        Ok(unit)
    }

    /// Where a coordinate leads from `from`, in the file's coordinates; what it leaves out stays.
    pub(super) fn point(
        &mut self,
        from: Point,
        (x, y): (Option<Number>, Option<Number>),
        here: &mut Here<'_, '_>,
    ) -> Result<Point, Fault> {
        let mut to = from;
        if let Some(x) = x {
            let format = self.format(here)?;
            let base = if format.incremental { from.x } else { Nm::ZERO };
            to.x = base + self.coordinate(x, format, format.x, here)?;
        }
        if let Some(y) = y {
            let format = self.format(here)?;
            let base = if format.incremental { from.y } else { Nm::ZERO };
            to.y = base + self.coordinate(y, format, format.y, here)?;
        }
        Ok(in_reach(to)?)
    }

    /// The offset of an arc's centre; zero where it is left out.
    pub(super) fn offset(
        &mut self,
        (i, j): (Option<Number>, Option<Number>),
        here: &mut Here<'_, '_>,
    ) -> Result<Vector, Fault> {
        let format = self.format(here)?;
        let mut offset = Vector::default();
        if let Some(i) = i {
            offset.x = self.coordinate(i, format, format.x, here)?;
        }
        if let Some(j) = j {
            offset.y = self.coordinate(j, format, format.y, here)?;
        }
        Ok(offset)
    }

    fn coordinate(
        &mut self,
        number: Number,
        format: Format,
        places: (u32, u32),
        here: &mut Here<'_, '_>,
    ) -> Result<Nm, Fault> {
        let unit = self.unit(here)?;
        let number = if self.has_idle_point(number, unit, here) { number.without_point() } else { number };
        let coordinate = format.coordinate(number, places, unit);
        self.is_beyond |= coordinate.is_none();
        coordinate.ok_or_else(|| {
            Fault::new("this coordinate is out of range", "coordinates within ±1073.741823 mm")
                .hint("check the number format and the units of the file")
        })
    }

    /// Whether the point of a coordinate means nothing: some versions of EasyEDA write whole
    /// numbers of the number format as `6350568.0`. Then no coordinate has anything but zeros
    /// behind the point, and as lengths some are beyond any board.
    fn has_idle_point(&mut self, number: Number, unit: Unit, here: &mut Here<'_, '_>) -> bool {
        if number.decimals.is_none() {
            return false;
        }
        if let Some(known) = self.idle_points {
            return known;
        }
        let (mut is_whole, mut is_far) = (true, false);
        let mut look = |number: Number| {
            is_whole &= number.is_whole();
            is_far |= unit.length(number).is_none();
        };
        look(number);
        here.ahead.clone().for_each(|block| coordinates(block.text).for_each(&mut look));
        let idle = is_whole && is_far;
        if idle {
            let message = "coordinates are whole numbers with a decimal point, as `6350568.0`: they are read by \
                           the number format, as if there were none";
            here.warn(&diagnostic::IDLE_POINTS, message);
        }
        self.idle_points = Some(idle);
        idle
    }

    /// A length with its point, zero where it is left out.
    fn length(&mut self, number: Option<Number>, here: &mut Here<'_, '_>) -> Result<Nm, Fault> {
        let Some(number) = number else { return Ok(Nm::ZERO) };
        let length = self.unit(here)?.length(number);
        length.ok_or_else(|| Fault::new("this length is out of range", "at most 1073.741823 mm"))
    }

    /// The vector with these lengths.
    pub(super) fn vector(
        &mut self,
        (x, y): (Option<Number>, Option<Number>),
        here: &mut Here<'_, '_>,
    ) -> Result<Vector, Fault> {
        Ok(Vector::new(self.length(x, here)?, self.length(y, here)?))
    }

    /// Whether a board so wide, its unit a guess, is none in inches, or lies beyond what is
    /// handled: then it is in millimetres.
    pub(super) fn is_too_wide(&self, extent: Nm) -> bool {
        /// Chosen: the largest panels are 610 mm long.
        const WIDEST: Nm = Nm::from_mm(620);
        self.is_guessed && self.unit == Some(Unit::Inch) && (extent > WIDEST || self.is_beyond)
    }

    /// The unit and the number format, as people write them.
    pub(super) fn names(&self) -> (String, String) {
        let unknown = || "unknown".to_owned();
        let unit = self.unit.map_or_else(unknown, |unit| unit.name().to_owned());
        (unit, self.format.map_or_else(unknown, Format::name))
    }
}

/// The numbers behind X, Y, I and J in a block that draws; none of other blocks.
fn coordinates(text: &[u8]) -> impl Iterator<Item = Number> {
    let draws = matches!(text.first(), Some(b'X' | b'Y' | b'I' | b'J' | b'G'));
    let starts = text.iter().enumerate().filter(|(_, byte)| matches!(byte, b'X' | b'Y' | b'I' | b'J'));
    starts.filter(move |_| draws).filter_map(|(at, _)| Some(Number::read(&text[at + 1..])?.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::error::Warnings;
    use crate::import::gerber::lex::Lexer;

    /// What `test` says of numbers before the rest of a file, and the codes of what it warns of.
    fn before<T>(
        rest: &str,
        test: impl Fn(&mut Numbers<'_>, &mut Here<'_, '_>) -> T,
    ) -> (T, Vec<&'static str>) {
        let mut warnings = Warnings::new("f", rest.as_bytes());
        let ahead = &Lexer::new(rest.as_bytes());
        let mut here = Here { place: 0..1, line: 1, is_bare: false, ahead, warnings: &mut warnings };
        let found = test(&mut Numbers::new(None, None), &mut here);
        (found, warnings.finish().iter().map(|warning| warning.kind.code).collect())
    }

    fn number(text: &str) -> Option<Number> {
        Number::whole(text.as_bytes())
    }

    #[test]
    fn format_and_unit_may_come_late() {
        let (found, codes) = before("%FSLAX24Y24*%G70*", |numbers, here| {
            numbers.point(Point::default(), (number("15000"), None), here).map(|p| p.x)
        });
        assert_eq!(found, Ok(Nm::new(38_100_000)), "1.5 inch");
        assert_eq!(codes, ["late-format", "late-units"], "both are said");
        let (found, codes) = before("M02*", |numbers, here| numbers.offset((None, None), here));
        assert!(found.is_err() && codes.is_empty(), "no format at all: {found:?}");
    }

    #[test]
    fn mode_overrides_old_codes_and_nothing_overrides_mode() {
        let (found, codes) = before("", |numbers, here| {
            numbers.set_old_unit(Unit::Inch, here);
            numbers.set_unit(Unit::Millimetre, here).expect("MO overrides");
            numbers.set_old_unit(Unit::Inch, here);
            assert!(numbers.set_unit(Unit::Inch, here).is_err(), "another MO contradicts");
            numbers.unit(here)
        });
        assert_eq!(found, Ok(Unit::Millimetre), "the first MO holds");
        assert_eq!(codes, ["conflicting-units", "conflicting-units"], "either way round");
    }
}
