//! Units, number format and the transformations of apertures and coordinates.

use crate::geometry::{Nm, Point, Vector};

use super::lex::Number;

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

/// A linear map of the plane: rows (`xx` `xy`), (`yx` `yy`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Linear {
    xx: f64,
    xy: f64,
    yx: f64,
    yy: f64,
}

impl Linear {
    pub(super) const IDENTITY: Self = Self { xx: 1.0, xy: 0.0, yx: 0.0, yy: 1.0 };

    /// Stretches x and y.
    pub(super) const fn stretch(x: f64, y: f64) -> Self {
        Self { xx: x, xy: 0.0, yx: 0.0, yy: y }
    }

    /// Exchanges x and y.
    pub(super) const SWAP: Self = Self { xx: 0.0, xy: 1.0, yx: 1.0, yy: 0.0 };

    /// Turns counter-clockwise by `degrees`; exact for whole quarters.
    pub(super) fn rotation(degrees: f64) -> Self {
        let turn = degrees - (degrees / 360.0).floor() * 360.0;
        let quarters = [(0.0, (0.0, 1.0)), (90.0, (1.0, 0.0)), (180.0, (0.0, -1.0)), (270.0, (-1.0, 0.0))];
        let (sin, cos) = quarters
            .into_iter()
            .find(|(angle, _)| (turn - angle).abs() < 1e-9)
            .map_or_else(|| libm::sincos(turn.to_radians()), |(_, exact)| exact);
        Self { xx: cos, xy: -sin, yx: sin, yy: cos }
    }

    /// This map after `first`.
    pub(super) fn after(self, first: Self) -> Self {
        Self {
            xx: self.xx * first.xx + self.xy * first.yx,
            xy: self.xx * first.xy + self.xy * first.yy,
            yx: self.yx * first.xx + self.yy * first.yx,
            yy: self.yx * first.xy + self.yy * first.yy,
        }
    }

    pub(super) fn apply(self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.xx * x + self.xy * y, self.yx * x + self.yy * y)
    }

    /// The image of `way`, rounded to whole nanometres.
    pub(super) fn vector(self, way: Vector) -> Vector {
        let (x, y) = self.apply((way.x.to_f64(), way.y.to_f64()));
        Vector::new(Nm::from_f64(x), Nm::from_f64(y))
    }

    /// Whether it turns left into right.
    pub(super) fn mirrors(self) -> bool {
        self.xx * self.yy - self.xy * self.yx < 0.0
    }

    /// By how much it scales a length; exact where it scales all alike along an axis.
    pub(super) fn scale(self) -> f64 {
        (self.xx * self.xx + self.yx * self.yx).sqrt()
    }

    /// Its entries as bits: what a cache compares.
    pub(super) fn bits(self) -> [u64; 4] {
        [self.xx, self.xy, self.yx, self.yy].map(f64::to_bits)
    }
}

/// What the deprecated commands AS, MI, SF, OF and IR do to coordinates (specification §8).
///
/// Axis select, mirror and scale act on coordinates and not on apertures; image rotation turns
/// both.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    /// IR.
    pub(super) rotation: Linear,
    /// AS.
    pub(super) swap: bool,
    /// MI, per axis.
    pub(super) mirror: (bool, bool),
    /// SF, per axis.
    pub(super) scale: (f64, f64),
    /// OF.
    pub(super) offset: Vector,
    linear: Linear,
    identity: bool,
}

impl Placement {
    pub(super) fn new() -> Self {
        Self {
            rotation: Linear::IDENTITY,
            swap: false,
            mirror: (false, false),
            scale: (1.0, 1.0),
            offset: Vector::default(),
            linear: Linear::IDENTITY,
            identity: true,
        }
    }

    /// To be called after a change.
    pub(super) fn update(&mut self) {
        let sign = |mirror: bool| if mirror { -1.0 } else { 1.0 };
        let stretch = Linear::stretch(sign(self.mirror.0) * self.scale.0, sign(self.mirror.1) * self.scale.1);
        let swap = if self.swap { Linear::SWAP } else { Linear::IDENTITY };
        self.linear = self.rotation.after(stretch).after(swap);
        self.identity = self.linear == Linear::IDENTITY && self.offset == Vector::default();
    }

    /// Where a coordinate of the file lies.
    pub(super) fn point(&self, p: Point) -> Point {
        if self.identity {
            return p;
        }
        let way = self.linear.vector(p - Point::default());
        Point::default() + way + self.rotation.vector(self.offset)
    }

    /// Which way an offset of the file goes.
    pub(super) fn vector(&self, way: Vector) -> Vector {
        if self.identity { way } else { self.linear.vector(way) }
    }

    /// Whether arcs run the other way round.
    pub(super) fn mirrors(&self) -> bool {
        self.linear.mirrors()
    }
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

    #[test]
    fn quarter_turns_are_exact() {
        let quarter = Linear::rotation(-270.0);
        assert_eq!(
            quarter.vector(Vector::new(Nm::new(3), Nm::new(0))),
            Vector::new(Nm::new(0), Nm::new(3)),
            "left"
        );
        assert!(!quarter.mirrors(), "a turn keeps the hand");
    }
}
