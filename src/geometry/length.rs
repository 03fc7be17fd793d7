//! Lengths as people write them: `0.2mm`, `200um`, `8mil`, `0.1in`. The decimal is read exactly,
//! never as a float.

use std::str::FromStr;

use super::Nm;

/// Why a text is not a length.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParseLengthError {
    /// A number without a unit; the hint offers the likely ones.
    #[error("`{0}` has no unit: write `{0}mm`, `{0}mil` or `{0}in`")]
    NoUnit(String),
    /// A decimal comma.
    #[error("`{0}` has a decimal comma: write a point, as in `0.2mm`")]
    Comma(String),
    /// A unit that is not known.
    #[error("`{unit}` is not a unit of length: expected nm, um, mm, cm, mil or in")]
    UnknownUnit {
        /// The text after the number.
        unit: String,
    },
    /// No decimal number where one was expected.
    #[error("`{0}` is not a length: expected a number and a unit, such as `0.2mm`")]
    NoNumber(String),
    /// Beyond what [`Nm`] holds.
    #[error("`{0}` lies beyond ±1073 mm")]
    OutOfRange(String),
}

impl FromStr for Nm {
    type Err = ParseLengthError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let nm = nanometres(text)?;
        Self::try_new(nm).map_err(|_| ParseLengthError::OutOfRange(text.to_owned()))
    }
}

/// The nanometres of a length, also of one beyond what [`Nm`] holds: what a machine goes in a
/// minute may be longer than any board.
pub(crate) fn nanometres(text: &str) -> Result<i64, ParseLengthError> {
    let trimmed = text.trim();
    let digits = trimmed
        .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+')))
        .unwrap_or(trimmed.len());
    let (number, unit) = (&trimmed[..digits], trimmed[digits..].trim());
    let unit_nm: i128 = match unit {
        _ if number.is_empty() => return Err(ParseLengthError::NoNumber(text.to_owned())),
        "nm" => 1,
        "um" | "µm" | "μm" => 1_000,
        "mm" => 1_000_000,
        "cm" => 10_000_000,
        "mil" | "mils" | "thou" => 25_400,
        "in" | "inch" | "\"" => 25_400_000,
        "" => return Err(ParseLengthError::NoUnit(trimmed.to_owned())),
        other
            if other.strip_prefix(',').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit())) =>
        {
            return Err(ParseLengthError::Comma(trimmed.to_owned()));
        }
        other => return Err(ParseLengthError::UnknownUnit { unit: other.to_owned() }),
    };
    let (mantissa, scale) = decimal(number).ok_or_else(|| ParseLengthError::NoNumber(text.to_owned()))?;
    // A number of many digits before and behind the point is longer than all that is computed with.
    let rounded = mantissa.checked_mul(unit_nm).and_then(|scaled| {
        let half = if scaled < 0 { -scale / 2 } else { scale / 2 };
        i64::try_from(scaled.checked_add(half)? / scale).ok()
    });
    rounded.ok_or_else(|| ParseLengthError::OutOfRange(text.to_owned()))
}

/// A decimal as mantissa and power of ten, `1.25` → (125, 100); at most 18 digits before the point.
/// What stands behind the 18th after it is below any rounding.
fn decimal(text: &str) -> Option<(i128, i128)> {
    let (negative, unsigned) = match text.as_bytes() {
        [b'-', ..] => (true, &text[1..]),
        [b'+', ..] => (false, &text[1..]),
        _ => (false, text),
    };
    let (whole, fraction) = unsigned.split_once('.').unwrap_or((unsigned, ""));
    if ![whole, fraction].concat().bytes().all(|b| b.is_ascii_digit()) || whole.len() + fraction.len() == 0 {
        return None;
    }
    let (whole, fraction) = (whole.trim_start_matches('0'), &fraction[..fraction.len().min(18)]);
    if whole.len() > 18 {
        return None;
    }
    let value: i128 = ["0", whole, fraction].concat().parse().ok()?;
    let scale = 10_i128.pow(u32::try_from(fraction.len()).ok()?);
    Some((if negative { -value } else { value }, scale))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_carry_units() {
        let cases = [
            ("0.2mm", 200_000),
            ("8mil", 203_200),
            ("0.1in", 2_540_000),
            ("-1.5 um", -1_500),
            ("25µm", 25_000),
            ("0.024000000000000004in", 609_600),
        ];
        for (text, nm) in cases {
            assert_eq!(text.parse::<Nm>(), Ok(Nm::new(nm)), "{text}");
        }
    }

    #[test]
    fn a_number_of_any_digits_is_a_length_or_out_of_range() {
        let many = "8".repeat(18);
        for unit in ["nm", "mm", "in"] {
            let text = format!("{many}.{many}{many}{unit}");
            assert_eq!(text.parse::<Nm>(), Err(ParseLengthError::OutOfRange(text.clone())), "{text}");
            let text = format!("-0.{many}{many}{unit}");
            assert!(text.parse::<Nm>().is_ok(), "{text}");
        }
    }

    #[test]
    fn a_bare_number_is_refused_with_a_hint() {
        let error = "0.2".parse::<Nm>().expect_err("no unit");
        assert!(error.to_string().contains("0.2mm"), "{error}");
    }

    #[test]
    fn nonsense_is_refused() {
        for text in ["", "mm", "1.2.3mm", "--1mm", "1furlong", "9999999mm", "0,2mm", "1e5mm"] {
            assert!(text.parse::<Nm>().is_err(), "{text} was taken for a length");
        }
    }
}
