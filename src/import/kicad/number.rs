//! Numbers of a board file: millimetres to whole nanometres without a float between, and degrees.

use crate::geometry::Nm;

/// The length that `text` says in millimetres, rounded to the nanometre, halves away from zero;
/// none where it is no number or lies beyond the range of coordinates.
pub(super) fn length(text: &[u8]) -> Option<Nm> {
    /// More digits than any coordinate in range has in front of the point and behind it. Chosen.
    const DIGITS: usize = 30;
    /// A power of ten beyond which nothing in range is left. Chosen.
    const POWER: i32 = 60;
    let (negative, text) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    let mark = text.iter().position(|b| matches!(b, b'e' | b'E')).unwrap_or(text.len());
    let (mantissa, exponent) = text.split_at(mark);
    let exponent =
        exponent.get(1..).map_or(Some(0), |digits| std::str::from_utf8(digits).ok()?.parse().ok())?;
    let point = mantissa.iter().position(|&b| b == b'.').unwrap_or(mantissa.len());
    let (whole, fraction) = (&mantissa[..point], mantissa.get(point + 1..).unwrap_or_default());
    let whole = &whole[whole.iter().take_while(|&&b| b == b'0').count()..];
    let digits = || whole.iter().chain(fraction);
    if mantissa.len() < 1 + usize::from(point < mantissa.len()) || !digits().all(u8::is_ascii_digit) {
        return None;
    }
    let kept = digits().count().min(DIGITS);
    let value = digits().take(kept).fold(0_i128, |value, b| value * 10 + i128::from(b - b'0'));
    // In nanometres, the value times ten to this.
    let behind = i32::try_from(kept).ok()? - i32::try_from(whole.len()).ok()?;
    let power = 6_i32.checked_sub(behind)?.checked_add(exponent)?;
    let value = match power {
        _ if value == 0 => 0,
        0..=9 => value.checked_mul(10_i128.pow(power.unsigned_abs()))?,
        10..=i32::MAX => return None,
        _ if power < -POWER => 0,
        _ => {
            let unit = 10_i128.checked_pow(power.unsigned_abs());
            unit.map_or(0, |unit| (value + unit / 2) / unit)
        }
    };
    let value = i64::try_from(value).ok()?;
    Nm::try_new(if negative { -value } else { value }).ok()
}

/// The number that `text` says, such as an angle in degrees; none where it is none or not finite.
pub(super) fn number(text: &[u8]) -> Option<f64> {
    std::str::from_utf8(text).ok()?.parse().ok().filter(|value: &f64| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn millimetres_become_whole_nanometres() {
        let cases = [
            ("1.27", 1_270_000),
            ("-0.049149", -49_149),
            ("20.", 20_000_000),
            (".5", 500_000),
            ("1e-05", 10),
            ("6.35E-3", 6_350),
            ("-2.5e1", -25_000_000),
            ("0.0000005", 1),
            ("-0.0000005", -1),
            ("0.00000049999999999999999999999999999999999", 0),
            ("000000000000000000000000000000000000000000000001", 1_000_000),
            ("1e-400", 0),
            ("0e400", 0),
        ];
        for (text, nm) in cases {
            assert_eq!(length(text.as_bytes()), Some(Nm::new(nm)), "{text}");
        }
        for text in ["", "-", ".", "1.2.3", "x", "1e", "1e999999999999", "2000", "1e9", "0x1", "--1"] {
            assert_eq!(length(text.as_bytes()), None, "{text}");
        }
    }
}
