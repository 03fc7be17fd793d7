//! Linear maps of the plane: how apertures and coordinates are mirrored, turned and scaled.

use crate::geometry::{Nm, Vector};

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

    /// The map back, of one that leaves no length zero.
    pub(super) fn inverse(self) -> Self {
        let area = self.xx * self.yy - self.xy * self.yx;
        Self { xx: self.yy / area, xy: -self.xy / area, yx: -self.yx / area, yy: self.xx / area }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        let quarter = Linear::rotation(-270.0);
        assert_eq!(
            quarter.vector(Vector::new(Nm::new(3), Nm::new(0))),
            Vector::new(Nm::new(0), Nm::new(3)),
            "left"
        );
        assert!(!quarter.mirrors(), "a turn keeps the hand");
        assert_eq!(quarter.inverse(), Linear::rotation(-90.0), "and back");
    }
}
