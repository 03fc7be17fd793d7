//! Lengths in whole nanometres, their range and their decimal text.
//!
//! Integers, so that contact and containment are decided exactly and no bit depends on a machine.

use std::fmt;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A length or coordinate in whole nanometres.
///
/// # Range
///
/// A coordinate read from a file lies within [`Nm::MIN`]..=[`Nm::MAX`] (±(2³⁰ − 1) nm, ±1.07 m):
/// [`Nm::try_new`] checks it. Arithmetic on coordinates in range (differences, a tool's offset, a
/// margin) cannot overflow the `i64` inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Nm(i64);

/// A length outside [`Nm::MIN`]..=[`Nm::MAX`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("coordinate lies beyond ±1073.741823 mm, the largest that is handled exactly")]
pub struct RangeError;

impl Nm {
    /// The largest coordinate, 2³⁰ − 1 nm.
    pub const MAX: Self = Self((1 << 30) - 1);
    /// The smallest coordinate, −(2³⁰ − 1) nm.
    pub const MIN: Self = Self(-((1 << 30) - 1));
    /// Zero.
    pub const ZERO: Self = Self(0);

    /// `value` nanometres, unchecked: for constants and for results of arithmetic on checked
    /// coordinates.
    #[must_use]
    pub const fn new(value: i64) -> Self {
        Self(value)
    }

    /// `value` nanometres, if that is a coordinate.
    ///
    /// # Errors
    ///
    /// [`RangeError`] outside [`Nm::MIN`]..=[`Nm::MAX`].
    pub const fn try_new(value: i64) -> Result<Self, RangeError> {
        if value >= Self::MIN.0 && value <= Self::MAX.0 { Ok(Self(value)) } else { Err(RangeError) }
    }

    /// `um` micrometres.
    #[must_use]
    pub const fn from_um(um: i64) -> Self {
        Self(um * 1_000)
    }

    /// `mm` millimetres.
    #[must_use]
    pub const fn from_mm(mm: i64) -> Self {
        Self(mm * 1_000_000)
    }

    /// The nearest whole nanometre to `value` nanometres, halves away from zero.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "`as` saturates, and no length comes near 2⁶³ nm")]
    pub fn from_f64(value: f64) -> Self {
        Self(value.round() as i64)
    }

    /// The number of nanometres.
    #[must_use]
    pub const fn get(self) -> i64 {
        self.0
    }

    /// The number of nanometres as a float; exact below 2⁵³.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "lengths stay far below 2⁵³ nm")]
    pub const fn to_f64(self) -> f64 {
        self.0 as f64
    }

    /// In millimetres, as a float: for display and speeds, never for geometry.
    #[must_use]
    pub const fn to_mm(self) -> f64 {
        self.to_f64() / 1e6
    }

    /// The distance from zero.
    #[must_use]
    pub const fn abs(self) -> Self {
        Self(self.0.abs())
    }
}

/// Millimetres with as many decimals as the precision asks for (6 by default), rounded half away
/// from zero by integer division; never `-0`.
impl fmt::Display for Nm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let decimals = f.precision().unwrap_or(6).min(6);
        let unit = 10_u64.pow(u32::try_from(6 - decimals).unwrap_or(0));
        let rounded = (self.0.unsigned_abs() + unit / 2) / unit;
        let per_mm = 1_000_000 / unit;
        let sign = if self.0 < 0 && rounded != 0 { "-" } else { "" };
        if decimals == 0 {
            write!(f, "{sign}{rounded}")
        } else {
            write!(f, "{sign}{}.{:0decimals$}", rounded / per_mm, rounded % per_mm)
        }
    }
}

impl Add for Nm {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Nm {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Neg for Nm {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Mul<i64> for Nm {
    type Output = Self;
    fn mul(self, factor: i64) -> Self {
        Self(self.0 * factor)
    }
}

/// Towards zero, as integers divide.
impl Div<i64> for Nm {
    type Output = Self;
    fn div(self, divisor: i64) -> Self {
        Self(self.0 / divisor)
    }
}

impl AddAssign for Nm {
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl SubAssign for Nm {
    fn sub_assign(&mut self, other: Self) {
        self.0 -= other.0;
    }
}

impl Sum for Nm {
    fn sum<I: Iterator<Item = Self>>(lengths: I) -> Self {
        lengths.fold(Self::ZERO, Add::add)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn millimetres_print_by_integer_division() {
        let cases = [(0, "0.000000"), (-1, "-0.000001"), (1_234_567_890, "1234.567890")];
        for (nm, text) in cases {
            assert_eq!(Nm::new(nm).to_string(), text, "{nm} nm");
        }
        assert_eq!(format!("{:.3}", Nm::new(-499)), "0.000", "rounds to zero without a sign");
        assert_eq!(format!("{:.3}", Nm::new(-500)), "-0.001", "half goes away from zero");
        assert_eq!(format!("{:.0}", Nm::from_mm(12)), "12", "no decimals, no point");
        assert_eq!(format!("{:.3}", Nm::new(i64::MIN)), "-9223372036854.776", "whatever was saturated");
    }

    #[test]
    fn the_range_is_checked_at_both_ends() {
        assert!(Nm::try_new(Nm::MAX.get()).is_ok(), "the largest is in range");
        assert!(Nm::try_new(Nm::MAX.get() + 1).is_err(), "one more is not");
        assert!(Nm::try_new(Nm::MIN.get() - 1).is_err(), "one less is not");
    }
}
