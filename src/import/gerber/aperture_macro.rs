//! Aperture macros (AM, specification §4.5): a definition is kept as text and evaluated for each
//! aperture made of it.

use std::f64::consts::PI;
use std::ops::Range;

use crate::geometry::Nm;
use crate::import::error::printable;

use super::expression::{self, Variables, evaluate};
use super::fault::Fault;
use super::figure::{Figure, Primitive, arc};
use super::format::Unit;
use super::lex::{Block, End, Lexer, Number, is_blank};
use super::linear::Linear;

/// The most vertices of a regular polygon, and the most rings of a moiré. The specification allows
/// 12 vertices; tools have been seen to draw circles with a hundred.
pub(super) const VERTICES: u32 = 1000;

/// A macro as the file defines it.
#[derive(Clone, Debug)]
pub(super) struct Macro<'a> {
    pub(super) name: &'a [u8],
    /// The statements after the name.
    body: Vec<Block<'a>>,
}

impl<'a> Macro<'a> {
    /// `AMDONUT*1,1,$1,0,0*1,0,$2,0,0*%`: the name is `block`, the statements are those up to the
    /// `%`, which `lexer` has before it.
    pub(super) fn read(block: &Block<'a>, lexer: &mut Lexer<'a>) -> Result<Self, Fault> {
        let name = block.text[2..].trim_ascii();
        let mut body = Vec::new();
        while !lexer.percent_follows() {
            let mut ahead = lexer.clone();
            let Some(statement) = ahead.next().filter(|statement| statement.end != End::File) else {
                let what = format!("the file ends within the aperture macro `{}`", printable(name));
                return Err(Fault::new(what, "statements that end with `*`, and a `%` after the last"));
            };
            match statement.text.first() {
                None => *lexer = ahead, // a `*` too many
                Some(b) if b.is_ascii_digit() || *b == b'$' => {
                    *lexer = ahead;
                    body.push(statement);
                }
                Some(_) => break, // the `%` is missing, and the next command begins
            }
        }
        Ok(Self { name, body })
    }

    /// What the macro draws for these parameters.
    pub(super) fn evaluate(&self, parameters: Vec<f64>, unit: Unit) -> Result<Vec<Primitive>, Fault> {
        let drawn = self.draw(parameters, unit);
        drawn.map_err(|fault| fault.within(&format!("the aperture macro `{}`", printable(self.name))))
    }

    fn draw(&self, parameters: Vec<f64>, unit: Unit) -> Result<Vec<Primitive>, Fault> {
        let mut variables = Variables::new(parameters);
        let mut primitives = Vec::new();
        for block in &self.body {
            let statement = Statement { block, unit };
            if block.text.first() == Some(&b'$') {
                statement.assign(&mut variables)?;
            } else {
                statement.draw(&variables, &mut primitives)?;
            }
        }
        Ok(primitives)
    }
}

struct Statement<'a> {
    block: &'a Block<'a>,
    unit: Unit,
}

impl Statement<'_> {
    fn fault(&self, what: impl Into<String>, expected: impl Into<String>) -> Fault {
        Fault::new(what, expected).at(&self.block.place())
    }

    /// The value of the bytes `range` of the statement.
    fn value(&self, range: Range<usize>, variables: &Variables) -> Result<f64, Fault> {
        evaluate(&self.block.text[range.clone()], variables).map_err(
            |expression::Fault { at, what, expected }| {
                let start = self.block.start + range.start + at;
                let place = start..(self.block.start + range.end).max(start + 1);
                Fault::new(what, expected).at(&place)
            },
        )
    }

    /// `$4=$1x0.5`.
    fn assign(&self, variables: &mut Variables) -> Result<(), Fault> {
        let text = self.block.text;
        let expected = "an assignment, such as `$4=$1x0.5`";
        let equals = text.iter().position(|&b| b == b'=');
        let equals = equals.ok_or_else(|| self.fault("this statement has no `=`", expected))?;
        let number = Number::whole(&text[1..equals]).and_then(Number::to_integer);
        let number = number.and_then(|n| usize::try_from(n).ok());
        let value = self.value(equals + 1..text.len(), variables)?;
        if number.is_some_and(|number| variables.set(number, value)) {
            Ok(())
        } else {
            Err(self.fault("this is not a variable", expected))
        }
    }

    /// `code,value,value,…`
    fn draw(&self, variables: &Variables, primitives: &mut Vec<Primitive>) -> Result<(), Fault> {
        let text = self.block.text;
        let code_end = text.iter().position(|&b| b == b',').unwrap_or(text.len());
        if text.first() == Some(&b'0') && text.get(1).is_none_or(|b| !b.is_ascii_digit()) {
            return Ok(()); // a comment
        }
        let code = Number::whole(&text[..code_end]).and_then(Number::to_integer);
        let mut values = Vec::new();
        let mut from = code_end + 1;
        while from <= text.len() {
            let to = text[from..].iter().position(|&b| b == b',').map_or(text.len(), |i| from + i);
            if to == text.len() && text[from..].iter().all(|&b| is_blank(b)) {
                break; // a comma too many at the end
            }
            values.push(self.value(from..to, variables)?);
            from = to + 1;
        }
        let modifiers = Modifiers { statement: self, values };
        match code {
            Some(1) => modifiers.circle(primitives),
            Some(2 | 20) => modifiers.vector_line(primitives),
            Some(21) => modifiers.center_line(primitives),
            Some(22) => modifiers.lower_left_line(primitives),
            Some(4) => modifiers.outline(primitives),
            Some(5) => modifiers.polygon(primitives),
            Some(6) => modifiers.moire(primitives),
            Some(7) => modifiers.thermal(primitives),
            _ => Err(self.fault(
                "this is not a macro primitive",
                "1 circle, 2 or 20 vector line, 21 or 22 centre line, 4 outline, 5 polygon, 6 moiré or 7 thermal",
            )),
        }
    }
}

/// The evaluated modifiers of one primitive.
struct Modifiers<'a> {
    statement: &'a Statement<'a>,
    values: Vec<f64>,
}

impl Modifiers<'_> {
    /// Checks that there are at least `count`; one more, the rotation, may be left out.
    fn need(&self, count: usize, names: &str) -> Result<(), Fault> {
        let found = self.values.len();
        if found >= count {
            return Ok(());
        }
        Err(self.statement.fault(format!("{found} modifiers are too few for this primitive"), names))
    }

    /// The modifier at `index` as a length, in nanometres.
    fn length(&self, index: usize) -> f64 {
        self.statement.unit.to_nm(self.values[index])
    }

    /// The two from `index` as a place.
    fn place(&self, index: usize) -> (f64, f64) {
        (self.length(index), self.length(index + 1))
    }

    /// The modifier at `index` in degrees; zero where left out.
    fn rotation(&self, index: usize) -> f64 {
        self.values.get(index).copied().unwrap_or(0.0)
    }

    fn exposed(&self) -> bool {
        self.values[0].round().abs() > 0.0
    }

    /// The modifier at `index` as a count within `least`..=[`VERTICES`].
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked against the range")]
    fn count(&self, index: usize, least: u32, what: &str) -> Result<u32, Fault> {
        let value = self.values[index].round();
        if value >= f64::from(least) && value <= f64::from(VERTICES) {
            return Ok(value as u32);
        }
        Err(self.statement.fault(
            format!("{value} is not a number of {what}"),
            format!("a number from {least} to {VERTICES}"),
        ))
    }

    fn push(&self, primitives: &mut Vec<Primitive>, exposed: bool, figure: Figure, rotation: f64) {
        primitives.push(Primitive { exposed, figure: figure.rotated(rotation) });
    }

    fn circle(&self, primitives: &mut Vec<Primitive>) -> Result<(), Fault> {
        self.need(4, "exposure, diameter, centre x, centre y, rotation")?;
        let disc = Figure::disc(self.place(2), self.length(1).abs() / 2.0);
        self.push(primitives, self.exposed(), disc, self.rotation(4));
        Ok(())
    }

    fn vector_line(&self, primitives: &mut Vec<Primitive>) -> Result<(), Fault> {
        self.need(6, "exposure, width, start x, start y, end x, end y, rotation")?;
        let ((x0, y0), (x1, y1)) = (self.place(2), self.place(4));
        let (dx, dy) = (x1 - x0, y1 - y0);
        let length = (dx * dx + dy * dy).sqrt();
        if length > 0.0 {
            let half = self.length(1).abs() / 2.0 / length;
            let (nx, ny) = (-dy * half, dx * half);
            let corners = [(x0 - nx, y0 - ny), (x1 - nx, y1 - ny), (x1 + nx, y1 + ny), (x0 + nx, y0 + ny)];
            self.push(primitives, self.exposed(), Figure::Contour(corners.to_vec()), self.rotation(6));
        }
        Ok(())
    }

    fn center_line(&self, primitives: &mut Vec<Primitive>) -> Result<(), Fault> {
        self.need(5, "exposure, width, height, centre x, centre y, rotation")?;
        let rectangle = Figure::rectangle(self.place(3), self.length(1), self.length(2));
        self.push(primitives, self.exposed(), rectangle, self.rotation(5));
        Ok(())
    }

    fn lower_left_line(&self, primitives: &mut Vec<Primitive>) -> Result<(), Fault> {
        self.need(5, "exposure, width, height, lower left x, lower left y, rotation")?;
        let ((x, y), width, height) = (self.place(3), self.length(1), self.length(2));
        let rectangle = Figure::rectangle((x + width / 2.0, y + height / 2.0), width, height);
        self.push(primitives, self.exposed(), rectangle, self.rotation(5));
        Ok(())
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "`as` saturates, then it is checked"
    )]
    fn outline(&self, primitives: &mut Vec<Primitive>) -> Result<(), Fault> {
        let names = "exposure, number of vertices n, then n + 1 points and a rotation";
        self.need(4, names)?;
        let vertices = self.values[1].round();
        let count = if vertices >= 1.0 { vertices as usize } else { 0 };
        // The first point is not counted, and comes again as the last.
        if count == 0 || count > (self.values.len() - 4) / 2 {
            let what = format!("an outline of {vertices} vertices has {} values", self.values.len());
            return Err(self.statement.fault(what, names));
        }
        let places = (0..=count).map(|i| self.place(2 + 2 * i)).collect();
        self.push(primitives, self.exposed(), Figure::Contour(places), self.rotation(4 + 2 * count));
        Ok(())
    }

    fn polygon(&self, primitives: &mut Vec<Primitive>) -> Result<(), Fault> {
        self.need(5, "exposure, number of vertices, centre x, centre y, diameter, rotation")?;
        let vertices = self.count(1, 3, "vertices")?;
        let polygon = Figure::regular(self.place(2), self.length(4).abs() / 2.0, vertices, 0.0);
        self.push(primitives, self.exposed(), polygon, self.rotation(5));
        Ok(())
    }

    fn moire(&self, primitives: &mut Vec<Primitive>) -> Result<(), Fault> {
        self.need(
            8,
            "centre x, centre y, outer diameter, ring thickness, gap, number of rings, cross-hair thickness and length, \
             rotation",
        )?;
        let (center, rotation) = (self.place(0), self.rotation(8));
        let (thickness, gap) = (self.length(3), self.length(4));
        let rings = self.count(5, 0, "rings")?;
        let mut outer = self.length(2) / 2.0;
        for _ in 0..rings {
            if outer <= 0.0 {
                break;
            }
            let ring = Figure::Ring { center, outer, inner: (outer - thickness).max(0.0) };
            self.push(primitives, true, ring, rotation);
            outer -= thickness + gap;
        }
        let (width, length) = (self.length(6), self.length(7));
        for (w, h) in [(length, width), (width, length)] {
            self.push(primitives, true, Figure::rectangle(center, w, h), rotation);
        }
        Ok(())
    }

    /// A ring with a cross cut out: a quarter in each corner that the cross leaves.
    fn thermal(&self, primitives: &mut Vec<Primitive>) -> Result<(), Fault> {
        self.need(5, "centre x, centre y, outer diameter, inner diameter, gap, rotation")?;
        let (x, y) = self.place(0);
        let (outer, inner, half) = (self.length(2) / 2.0, self.length(3) / 2.0, self.length(4) / 2.0);
        if outer <= 0.0 || half * 2.0_f64.sqrt() >= outer {
            return Ok(()); // the cross covers it
        }
        if outer.max(inner) > Nm::MAX.to_f64() {
            let expected = "a thermal of two metres at most";
            return Err(self.statement.fault("this thermal is larger than any board", expected));
        }
        let from = libm::asin(half / outer);
        let mut quarter: Vec<_> = arc((0.0, 0.0), outer, from, PI / 2.0 - 2.0 * from).collect();
        quarter.push((half, (outer * outer - half * half).sqrt()));
        if half * 2.0_f64.sqrt() >= inner {
            quarter.push((half, half));
        } else {
            let from = libm::asin(half / inner);
            quarter.push((half, (inner * inner - half * half).sqrt()));
            quarter.extend(arc((0.0, 0.0), inner, PI / 2.0 - from, 2.0 * from - PI / 2.0).skip(1));
            quarter.push(((inner * inner - half * half).sqrt(), half));
        }
        for corner in 0..4 {
            let turn = Linear::rotation(90.0 * f64::from(corner));
            let places = quarter.iter().map(|&p| turn.apply(p)).map(|(dx, dy)| (x + dx, y + dy)).collect();
            self.push(primitives, true, Figure::Contour(places), self.rotation(5));
        }
        Ok(())
    }
}
