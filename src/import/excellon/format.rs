//! How digits become lengths.
//!
//! A coordinate such as `X0152` has no decimal point: units, the number of digits before and after
//! the point, and which zeros were left out decide together where the hole is. The words are a
//! trap: Excellon's `LZ` says that *leading* zeros are *kept* (so trailing ones are left out), the
//! opposite of Gerber's `L`.

use std::fmt;

use super::lex::Number;
use crate::geometry::Nm;

/// The unit of all lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Units {
    /// `INCH`, `M72`.
    Inch,
    /// `METRIC`, `M71`.
    Mm,
}

impl Units {
    const fn nm(self) -> i128 {
        match self {
            Self::Inch => 25_400_000,
            Self::Mm => 1_000_000,
        }
    }

    /// As [`Source::units`](crate::board::Source::units) has it.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Inch => "inch",
            Self::Mm => "mm",
        }
    }

    /// Digits before and after the point where the file does not say: the formats of the Excellon
    /// CNC-7 manual.
    pub(super) const fn default_digits(self) -> Digits {
        match self {
            Self::Inch => Digits { whole: 2, decimals: 4 },
            Self::Mm => Digits { whole: 3, decimals: 3 },
        }
    }
}

/// Which zeros a coordinate without a point keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Zeros {
    /// `LZ`: counted from the left; trailing zeros may be missing.
    Leading,
    /// `TZ`: counted from the right; leading zeros may be missing.
    Trailing,
}

/// How many digits stand before and after the point that is not written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Digits {
    /// Before it.
    pub(super) whole: u8,
    /// After it.
    pub(super) decimals: u8,
}

/// All that it takes to read a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct NumberFormat {
    pub(super) units: Units,
    pub(super) digits: Digits,
    pub(super) zeros: Zeros,
}

impl NumberFormat {
    /// What has no point is a whole number of units.
    pub(super) const fn whole(units: Units) -> Self {
        Self { units, digits: Digits { whole: 4, decimals: 0 }, zeros: Zeros::Trailing }
    }

    /// The length that `number` means; none outside what [`Nm`] holds.
    pub(super) fn length(self, number: Number) -> Option<Nm> {
        let point = number.decimals.map_or_else(
            || match self.zeros {
                Zeros::Trailing => i32::from(self.digits.decimals),
                Zeros::Leading => i32::from(number.count) - i32::from(self.digits.whole),
            },
            i32::from,
        );
        scaled(number, point - i32::from(number.beyond), self.units)
    }

    /// The diameter that `number` means. One without a point is whole millimetres where that makes
    /// a drill, else micrometres; mils where the unit is the inch.
    pub(super) fn diameter(self, number: Number) -> Option<Nm> {
        let point = match (number.decimals, self.units) {
            (Some(decimals), _) => i32::from(decimals),
            (None, Units::Mm) if number.digits <= 10 => 0,
            (None, _) => 3,
        };
        scaled(number, point - i32::from(number.beyond), self.units)
    }
}

/// `digits` × 10^−`point` units in nanometres, rounded half away from zero.
fn scaled(number: Number, point: i32, units: Units) -> Option<Nm> {
    let value = i128::from(number.digits) * units.nm();
    // 18 digits in inches are below 10²⁶ nanometres: of what has more decimals than that nothing is
    // left.
    let power =
        10_i128.checked_pow(if point < 0 { point.unsigned_abs() } else { point.unsigned_abs().min(37) })?;
    let nm = if point < 0 { value.checked_mul(power)? } else { (value + power / 2) / power };
    let nm = i64::try_from(if number.negative { -nm } else { nm }).ok()?;
    Nm::try_new(nm).ok()
}

impl fmt::Display for NumberFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.digits.decimals == 0 {
            return f.write_str("whole numbers");
        }
        let zeros = match self.zeros {
            Zeros::Leading => "trailing zeros omitted",
            Zeros::Trailing => "leading zeros omitted",
        };
        write!(f, "{}.{} {zeros}", self.digits.whole, self.digits.decimals)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const INCH: NumberFormat =
        NumberFormat { units: Units::Inch, digits: Digits { whole: 2, decimals: 4 }, zeros: Zeros::Leading };

    fn number(digits: u64, count: u8) -> Number {
        Number { negative: false, digits, count, decimals: None, beyond: 0 }
    }

    #[test]
    fn the_zeros_that_are_kept_say_where_the_point_is() {
        let (x0152, x152) = (number(152, 4), number(152, 3));
        assert_eq!(INCH.length(x0152), Some(Nm::new(38_608_000)), "01.52 inch");
        let trailing = NumberFormat { zeros: Zeros::Trailing, ..INCH };
        assert_eq!(trailing.length(x0152), Some(Nm::new(386_080)), "0.0152 inch");
        assert_eq!(trailing.length(x152), trailing.length(x0152), "leading zeros change nothing");
    }

    #[test]
    fn a_point_settles_it() {
        let written = Number { negative: true, digits: 15, count: 2, decimals: Some(1), beyond: 0 };
        assert_eq!(INCH.length(written), Some(Nm::new(-38_100_000)), "-1.5 inch");
    }

    #[test]
    fn what_lies_beyond_a_metre_is_refused() {
        assert_eq!(INCH.length(number(99_999_999, 8)), None, "99.999999 inch");
    }
}
