//! How numbers are written: units and number format (MO, FS; specification §4.2).

use crate::geometry::Nm;

use super::fault::Fault;
use super::lex::{Number, is_blank};

/// The unit of lengths (MO; G70 and G71 of old).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Millimetre,
    Inch,
}

impl Unit {
    /// Nanometres in one.
    const fn nm(self) -> i64 {
        match self {
            Self::Millimetre => 1_000_000,
            Self::Inch => 25_400_000,
        }
    }

    /// A length written with its point, rounded to the nanometre; none beyond what is handled.
    pub(super) fn length(self, number: Number) -> Option<Nm> {
        within(number)?;
        scaled(number.mantissa, self.nm(), number.decimals.unwrap_or(0))
    }

    /// A length from an expression, in nanometres.
    #[expect(clippy::cast_precision_loss, reason = "exact: far below 2⁵³")]
    pub(super) fn to_nm(self, value: f64) -> f64 {
        value * self.nm() as f64
    }

    /// As people write it.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Inch => "inch",
        }
    }
}

/// Which zeros of a coordinate are left out (FS).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zeros {
    /// Leading ones: the digits are aligned at the last decimal.
    Leading,
    /// Trailing ones: they are aligned at the first digit.
    Trailing,
}

/// How coordinates are written (FS).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Format {
    pub(super) zeros: Zeros,
    /// Whether each coordinate counts from the one before.
    pub(super) incremental: bool,
    /// Digits before and after the point, in x.
    pub(super) x: (u32, u32),
    /// The same in y.
    pub(super) y: (u32, u32),
}

impl Format {
    /// Reads `LAX46Y46`, what stands behind `FS`.
    pub(super) fn read(text: &[u8]) -> Result<Self, Fault> {
        let bad = || Fault::new("this number format cannot be read", "a format such as `FSLAX46Y46`");
        let mut format = Self { zeros: Zeros::Leading, incremental: false, x: (0, 0), y: (0, 0) };
        let mut at = 0;
        while let Some(&letter) = text.get(at) {
            at += 1;
            let digit = |at: usize| text.get(at).filter(|b| b.is_ascii_digit()).map(|b| u32::from(b - b'0'));
            match letter.to_ascii_uppercase() {
                // `D` of old: no zeros are left out, so either way of reading is right.
                b'L' | b'D' if digit(at).is_none() => format.zeros = Zeros::Leading,
                b'T' => format.zeros = Zeros::Trailing,
                b'A' => format.incremental = false,
                b'I' => format.incremental = true,
                axis @ (b'X' | b'Y') => {
                    let digits = digit(at).zip(digit(at + 1)).ok_or_else(bad)?;
                    at += 2;
                    *(if axis == b'X' { &mut format.x } else { &mut format.y }) = digits;
                }
                // Lengths of sequence numbers and codes, which nothing depends on.
                b'N' | b'G' | b'D' | b'M' | b'Z' if digit(at).is_some() => {
                    at += text[at..].iter().take_while(|b| b.is_ascii_digit()).count();
                }
                byte if is_blank(byte) => {}
                _ => return Err(bad()),
            }
        }
        match (format.x, format.y) {
            ((0, 0), (0, 0)) => return Err(bad()),
            ((0, 0), y) => format.x = y,
            (x, (0, 0)) => format.y = x,
            _ => {}
        }
        Ok(format)
    }

    /// A coordinate with `places` digits before and after the point; none beyond what is handled.
    pub(super) fn coordinate(self, number: Number, places: (u32, u32), unit: Unit) -> Option<Nm> {
        if number.decimals.is_some() {
            return unit.length(number);
        }
        match self.zeros {
            Zeros::Leading => {
                within(number)?;
                scaled(number.mantissa, unit.nm(), places.1)
            }
            Zeros::Trailing => match (places.0 + places.1).checked_sub(number.digits) {
                Some(missing) => {
                    scaled(number.mantissa.checked_mul(10_i64.pow(missing))?, unit.nm(), places.1)
                }
                None => scaled(number.mantissa, unit.nm(), number.digits - places.0 - number.beyond),
            },
        }
    }

    /// As people write it.
    pub(super) fn name(self) -> String {
        let (whole, decimals) = self.x;
        let zeros = match self.zeros {
            Zeros::Leading => "leading",
            Zeros::Trailing => "trailing",
        };
        let mode = if self.incremental { "incremental" } else { "absolute" };
        format!("{whole}.{decimals} {zeros} zeros omitted, {mode}")
    }
}

/// Nothing for a number that is beyond any length by its count of digits.
fn within(number: Number) -> Option<()> {
    (number.beyond == 0).then_some(())
}

/// `mantissa` × `unit` ÷ 10^`decimals`, halves away from zero; none beyond the range of [`Nm`].
fn scaled(mantissa: i64, unit: i64, decimals: u32) -> Option<Nm> {
    if let Some(power) = 10_i64.checked_pow(decimals).filter(|power| unit % power == 0) {
        return Nm::try_new(mantissa.checked_mul(unit / power)?).ok();
    }
    // 18 digits in inches are below 10²⁶ nanometres: of what has more decimals than that nothing is
    // left.
    let (product, power) = (i128::from(mantissa) * i128::from(unit), 10_i128.pow(decimals.min(37)));
    let half = if product < 0 { -power / 2 } else { power / 2 };
    i64::try_from((product + half) / power).ok().and_then(|nm| Nm::try_new(nm).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(text: &str) -> Number {
        Number::read(text.as_bytes()).expect("a number").0
    }

    #[test]
    fn omitted_zeros_are_put_back_on_the_right_side() {
        let leading = Format { zeros: Zeros::Leading, incremental: false, x: (2, 4), y: (2, 4) };
        let trailing = Format { zeros: Zeros::Trailing, ..leading };
        let inch = |format: Format, text| format.coordinate(number(text), format.x, Unit::Inch);
        assert_eq!(inch(leading, "15000"), Some(Nm::new(38_100_000)), "1.5 inch");
        assert_eq!(inch(trailing, "015"), Some(Nm::new(38_100_000)), "1.5 inch from the left");
        assert_eq!(inch(trailing, "0150000"), Some(Nm::new(38_100_000)), "a digit more than the format has");
        assert_eq!(inch(leading, "1.5"), Some(Nm::new(38_100_000)), "a point overrides the format");
        assert_eq!(inch(leading, "999999999"), None, "beyond a metre");
    }

    #[test]
    fn seven_decimals_round_to_the_nanometre() {
        let format = Format { zeros: Zeros::Leading, incremental: false, x: (3, 7), y: (3, 7) };
        let mm = |text| format.coordinate(number(text), format.x, Unit::Millimetre);
        assert_eq!(mm("10000005"), Some(Nm::new(1_000_001)), "half goes away from zero");
        assert_eq!(mm("-10000004"), Some(Nm::new(-1_000_000)), "less does not");
        let written = |text| Unit::Inch.length(number(text));
        assert_eq!(written("0.024000000000000004"), Some(Nm::new(609_600)), "any number of decimals");
        assert_eq!(
            written("0.0000000000000000000000000000000000000000000001"),
            Some(Nm::ZERO),
            "even so many"
        );
        assert_eq!(written("00000000000000000000000000000.5"), Some(Nm::new(12_700_000)), "and of zeros");
        assert_eq!(written("12345678901234567890"), None, "but no more than a metre");
    }
}
