//! The transformations of what follows (LM, LR, LS; specification §4.9) and of the whole image (of
//! old AS, IR, MI, OF, SF; §8).

use crate::geometry::{Point, Vector};

use super::canvas::{Refusal, in_reach};
use super::fault::Fault;
use super::fields::Fields;
use super::lex::Number;
use super::linear::Linear;

/// The largest factor of LS and SF. Chosen: it keeps products far from the ends of the integers.
const SCALE: f64 = 1e6;

/// What one command changes of the transformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    /// LM, per axis.
    Mirror(bool, bool),
    /// LR, in degrees.
    Rotation(f64),
    /// LS.
    Scale(f64),
    /// AS.
    ImageSwap(bool),
    /// IR, in degrees.
    ImageRotation(f64),
    /// MI, per axis.
    ImageMirror(bool, bool),
    /// SF, per axis.
    ImageScale(f64, f64),
}

impl Change {
    /// Reads the command `code` with what stands behind it.
    pub(super) fn read(code: &[u8], text: &[u8]) -> Result<Self, Fault> {
        let text = text.trim_ascii();
        let number = Number::whole(text);
        let factor = |factor: f64| factor > 0.0 && factor <= SCALE;
        let fault = |what: &str, expected: &str| Err(Fault::new(what, expected));
        match (code, text) {
            (b"LM", b"N") => Ok(Self::Mirror(false, false)),
            (b"LM", b"X") => Ok(Self::Mirror(true, false)),
            (b"LM", b"Y") => Ok(Self::Mirror(false, true)),
            (b"LM", b"XY") => Ok(Self::Mirror(true, true)),
            (b"LM", _) => fault("this mirroring is unknown", "`LMN`, `LMX`, `LMY` or `LMXY`"),
            (b"LR" | b"LS", _) => match number.map(Number::to_f64) {
                Some(degrees) if code == b"LR" => Ok(Self::Rotation(degrees)),
                Some(scale) if factor(scale) => Ok(Self::Scale(scale)),
                _ => fault(
                    "this transformation cannot be read",
                    "degrees, as in `%LR45*%`, or a factor above zero, as in `%LS0.8*%`",
                ),
            },
            (b"AS", b"AXBY") => Ok(Self::ImageSwap(false)),
            (b"AS", b"AYBX") => Ok(Self::ImageSwap(true)),
            (b"AS", _) => fault("these axes are unknown", "`ASAXBY` or `ASAYBX`"),
            (b"IR", _) => match number.and_then(Number::to_integer) {
                Some(0) => Ok(Self::ImageRotation(0.0)),
                Some(90) => Ok(Self::ImageRotation(90.0)),
                Some(180) => Ok(Self::ImageRotation(180.0)),
                Some(270) => Ok(Self::ImageRotation(270.0)),
                _ => fault("this rotation is unknown", "`IR0`, `IR90`, `IR180` or `IR270`"),
            },
            (b"MI", _) => {
                let fields = Fields::read(text)?;
                let set = |letter| fields.get(letter).is_some_and(|number| number.mantissa != 0);
                Ok(Self::ImageMirror(set(b'A'), set(b'B')))
            }
            _ => {
                let fields = Fields::read(text)?;
                let [x, y] = [b'A', b'B'].map(|letter| fields.get(letter).map_or(1.0, Number::to_f64));
                if factor(x) && factor(y) {
                    return Ok(Self::ImageScale(x, y));
                }
                fault("this scale cannot be used", "factors above zero, as in `SFA1.0B1.0`")
            }
        }
    }
}

/// The transformations in force.
///
/// Of the deprecated ones, mirror and scale act on coordinates and not on apertures, offsets and
/// steps; image rotation and, after all others, axis select turn everything (§8.1.2: the order is
/// MI, SF, OF, IR and AS).
#[derive(Clone, Copy, Debug)]
pub(super) struct Transformation {
    mirror: Linear,
    rotation: Linear,
    scale: Linear,
    image_swap: Linear,
    image_rotation: Linear,
    image_mirror: (f64, f64),
    image_scale: (f64, f64),
    image_offset: Vector,
    /// Whether what is drawn is part of a block, which is offset where it is flashed.
    in_block: bool,
    /// What all of the image's make of an offset in the file.
    image: Linear,
    is_identity: bool,
}

impl Transformation {
    pub(super) fn new() -> Self {
        Self {
            mirror: Linear::IDENTITY,
            rotation: Linear::rotation(0.0),
            scale: Linear::IDENTITY,
            image_swap: Linear::IDENTITY,
            image_rotation: Linear::IDENTITY,
            image_mirror: (1.0, 1.0),
            image_scale: (1.0, 1.0),
            image_offset: Vector::default(),
            in_block: false,
            image: Linear::IDENTITY,
            is_identity: true,
        }
    }

    pub(super) fn change(&mut self, change: Change) {
        let sign = |mirror: bool| if mirror { -1.0 } else { 1.0 };
        match change {
            Change::Mirror(x, y) => self.mirror = Linear::stretch(sign(x), sign(y)),
            Change::Rotation(degrees) => self.rotation = Linear::rotation(degrees),
            Change::Scale(scale) => self.scale = Linear::stretch(scale, scale),
            Change::ImageSwap(swap) => self.image_swap = if swap { Linear::SWAP } else { Linear::IDENTITY },
            Change::ImageRotation(degrees) => self.image_rotation = Linear::rotation(degrees),
            Change::ImageMirror(x, y) => self.image_mirror = (sign(x), sign(y)),
            Change::ImageScale(x, y) => self.image_scale = (x, y),
        }
        self.update();
    }

    /// OF.
    pub(super) fn set_offset(&mut self, offset: Vector) {
        self.image_offset = offset;
        self.update();
    }

    /// What is drawn is part of a block from now on, or no longer.
    pub(super) fn set_in_block(&mut self, in_block: bool) {
        self.in_block = in_block;
        self.update();
    }

    fn update(&mut self) {
        let (mirror, scale) = (self.image_mirror, self.image_scale);
        let stretch = Linear::stretch(mirror.0 * scale.0, mirror.1 * scale.1);
        self.image = self.turning().after(stretch);
        self.is_identity = self.image == Linear::IDENTITY && self.offset() == Vector::default();
    }

    /// What is made of apertures: mirrored, then rotated, then scaled (specification §4.9).
    pub(super) fn of_apertures(&self) -> Linear {
        self.turning().after(self.load())
    }

    /// What is made of everything, apertures, offsets and steps included.
    pub(super) fn turning(&self) -> Linear {
        self.image_swap.after(self.image_rotation)
    }

    /// What is made of a block: mirrored, rotated, scaled along the axes of the file. Its objects
    /// are drawn along the image's, as all others.
    pub(super) fn of_blocks(&self) -> Linear {
        let load = self.load();
        if load == Linear::IDENTITY || self.image == Linear::IDENTITY {
            return load;
        }
        self.image.after(load).after(self.image.inverse())
    }

    fn load(&self) -> Linear {
        self.scale.after(self.rotation).after(self.mirror)
    }

    fn offset(&self) -> Vector {
        if self.in_block { Vector::default() } else { self.image_offset }
    }

    /// Where a coordinate of the file lies on the board.
    pub(super) fn point(&self, p: Point) -> Result<Point, Refusal> {
        if self.is_identity {
            return in_reach(p);
        }
        let way = self.image.vector(p - Point::default());
        in_reach(Point::default() + way + self.turning().vector(self.offset()))
    }

    /// Which way one place of the file lies from another.
    pub(super) fn vector(&self, way: Vector) -> Vector {
        if self.is_identity { way } else { self.image.vector(way) }
    }

    /// Whether arcs run the other way round.
    pub(super) fn mirrors(&self) -> bool {
        self.image.mirrors()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Nm;

    fn changed(commands: &[&str]) -> Transformation {
        let mut transformation = Transformation::new();
        for command in commands {
            let (code, text) = command.as_bytes().split_at(2);
            transformation.change(Change::read(code, text).expect(command));
        }
        transformation
    }

    #[test]
    fn the_image_is_stretched_then_turned_then_swapped() {
        let at = |x: i64, y: i64| Point::new(Nm::new(x), Nm::new(y));
        let place = |commands: &[&str], p| changed(commands).point(p).expect("in reach");
        assert_eq!(place(&["ASAYBX"], at(3, 5)), at(5, 3), "axes exchanged");
        assert_eq!(place(&["SFA2B1", "ASAYBX"], at(3, 5)), at(5, 6), "the scale is that of the file's axes");
        assert_eq!(place(&["ASAYBX", "IR90"], at(3, 5)), at(3, -5), "turned left, then exchanged");
        assert_eq!(place(&["IR90", "MIA1B0"], at(3, 5)), at(-5, -3), "mirrored in x, then turned left");
        assert!(changed(&["MIA1"]).mirrors(), "a mirror changes the hand");
    }

    #[test]
    fn apertures_are_mirrored_then_rotated_then_scaled_whatever_came_first() {
        let way =
            |commands: &[&str]| changed(commands).of_apertures().vector(Vector::new(Nm::new(10), Nm::new(1)));
        let expected = Vector::new(Nm::new(-2), Nm::new(-20));
        assert_eq!(way(&["LS2", "LR90", "LMX"]), expected, "in this order");
        assert_eq!(way(&["LMX", "LS2", "LR90"]), expected, "and in that");
        assert_eq!(way(&["SFA7B7"]), Vector::new(Nm::new(10), Nm::new(1)), "SF leaves apertures alone");
        assert_eq!(way(&["ASAYBX"]), Vector::new(Nm::new(1), Nm::new(10)), "axis select does not");
    }

    #[test]
    fn what_cannot_be_read_is_a_fault() {
        for (code, text) in [("LM", "Z"), ("LS", "0"), ("AS", ""), ("IR", "45"), ("SF", "A0"), ("MI", "?")] {
            assert!(Change::read(code.as_bytes(), text.as_bytes()).is_err(), "{code}{text}");
        }
    }
}
