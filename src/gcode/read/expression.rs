//! Numbers, parameters and expressions in brackets (NIST RS274/NGC §3.3, with LinuxCNC's named
//! parameters).
//!
//! Angles are in degrees. Operators of one rank are taken from left to right, `**` too, as LinuxCNC
//! does.

use super::error::ReadError;
use super::source::Code;
use super::variables::Name;

/// What expressions ask the program that is being run.
pub(super) trait Scope {
    /// What a parameter holds.
    ///
    /// # Errors
    ///
    /// The reason why nobody can tell from the text alone.
    fn parameter(&mut self, name: &Name) -> Result<f64, String>;

    /// Whether a parameter holds anything.
    fn exists(&self, name: &Name) -> bool;
}

/// How deep brackets may nest. Chosen: deeper than anybody writes, and no danger to the stack.
const DEPTH: u32 = 64;

/// A value: a number, a parameter, an expression or a function of one.
pub(super) fn value(code: &mut Code<'_>, scope: &mut dyn Scope) -> Result<f64, ReadError> {
    Parser { code, scope, depth: 0 }.value()
}

/// An expression in brackets.
pub(super) fn bracketed(code: &mut Code<'_>, scope: &mut dyn Scope) -> Result<f64, ReadError> {
    if code.peek() == Some(b'[') {
        value(code, scope)
    } else {
        Err(code.error("expected an expression in brackets"))
    }
}

/// The name of a parameter, behind its `#`.
pub(super) fn name(code: &mut Code<'_>, scope: &mut dyn Scope) -> Result<Name, ReadError> {
    Parser { code, scope, depth: 0 }.name()
}

struct Parser<'p, 'a> {
    code: &'p mut Code<'a>,
    scope: &'p mut dyn Scope,
    depth: u32,
}

/// The operators, by rank from the weakest; what begins like another stands behind it.
const OPERATORS: [&[&str]; 5] =
    [&["AND", "XOR", "OR"], &["EQ", "NE", "GT", "GE", "LT", "LE"], &["+", "-"], &["*", "/", "MOD"], &["**"]];

impl Parser<'_, '_> {
    fn value(&mut self) -> Result<f64, ReadError> {
        self.depth += 1;
        if self.depth > DEPTH {
            return Err(self.code.error("brackets are nested too deep"));
        }
        let value = match self.code.peek() {
            Some(b'[') => {
                self.code.take(b'[');
                let value = self.expression(0)?;
                self.expect(b']')?;
                Ok(value)
            }
            Some(b'#') => {
                let before = self.code.clone();
                self.code.take(b'#');
                let name = self.name()?;
                self.scope.parameter(&name).map_err(|reason| before.error(reason))
            }
            Some(sign @ (b'-' | b'+')) => {
                self.code.take(sign);
                if matches!(self.code.peek(), Some(b'-' | b'+')) {
                    Err(self.code.error("expected a number behind the sign"))
                } else {
                    self.value().map(|value| if sign == b'-' { -value } else { value })
                }
            }
            Some(b'A'..=b'Z') => self.function(),
            _ => self.number(),
        };
        self.depth -= 1;
        value
    }

    fn expect(&mut self, byte: u8) -> Result<(), ReadError> {
        if self.code.take(byte) {
            Ok(())
        } else {
            Err(self.code.error(format!("expected a `{}`", char::from(byte))))
        }
    }

    fn number(&mut self) -> Result<f64, ReadError> {
        let (pointer, column) = (self.code.pointer, self.code.column());
        self.code.take_number().ok_or_else(|| pointer.error(column, "expected a number"))
    }

    /// Behind a `#`: a number, `<a name>`, or a value that gives the number.
    fn name(&mut self) -> Result<Name, ReadError> {
        if self.code.take(b'<') {
            let text = self.code.take_while(|byte| byte != b'>');
            self.expect(b'>')?;
            return Ok(Name::Text(text));
        }
        let before = self.code.clone();
        let value = self.value()?;
        index(value).map(Name::Number).ok_or_else(|| before.error("expected the whole number of a parameter"))
    }

    /// Operators of `rank` and stronger ones.
    fn expression(&mut self, rank: usize) -> Result<f64, ReadError> {
        let Some(operators) = OPERATORS.get(rank) else { return self.value() };
        let mut left = self.expression(rank + 1)?;
        while let Some(operator) = self.operator(operators) {
            let before = self.code.clone();
            let right = self.expression(rank + 1)?;
            left = apply(operator, left, right).map_err(|reason| before.error(reason))?;
        }
        Ok(left)
    }

    fn operator(&mut self, operators: &[&'static str]) -> Option<&'static str> {
        // `**` is stronger than `*`, and begins like it.
        let power = self.code.clone().take_text("**");
        let fits = |operator: &&&'static str| **operator != "*" || !power;
        let found = operators.iter().filter(fits).find(|operator| self.code.clone().take_text(operator))?;
        self.code.take_text(found);
        Some(found)
    }

    fn function(&mut self) -> Result<f64, ReadError> {
        let before = self.code.clone();
        let name = self.code.take_while(|byte| byte.is_ascii_uppercase());
        if name == "EXISTS" {
            self.expect(b'[')?;
            self.expect(b'#')?;
            let parameter = self.name()?;
            self.expect(b']')?;
            return Ok(f64::from(u8::from(self.scope.exists(&parameter))));
        }
        if self.code.peek() != Some(b'[') {
            return Err(before.error("expected a number, a parameter or a function"));
        }
        let x = self.value()?;
        if name == "ATAN" {
            self.expect(b'/')?;
            let over = self.value()?;
            return Ok(libm::atan2(x, over).to_degrees());
        }
        let value = match name.as_str() {
            "ABS" => x.abs(),
            "ACOS" => libm::acos(x).to_degrees(),
            "ASIN" => libm::asin(x).to_degrees(),
            "COS" => libm::cos(x.to_radians()),
            "EXP" => libm::exp(x),
            "FIX" => x.floor(),
            "FUP" => x.ceil(),
            "LN" => libm::log(x),
            "ROUND" => x.round(),
            "SIN" => libm::sin(x.to_radians()),
            "SQRT" => x.sqrt(),
            "TAN" => libm::tan(x.to_radians()),
            _ => return Err(before.error("expected a function such as SIN, SQRT or ATAN")),
        };
        if value.is_finite() {
            Ok(value)
        } else {
            Err(before.error(format!("{name} of {x} is not a number")))
        }
    }
}

/// A value as the number of something, where it is within a ten thousandth of a whole one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked before")]
pub(super) fn index(value: f64) -> Option<u32> {
    let whole = value.round();
    ((value - whole).abs() <= 1e-4 && (0.0..4e9).contains(&whole)).then_some(whole as u32)
}

/// How near two values are that count as equal: LinuxCNC's tolerance.
const EQUAL: f64 = 1e-6;

fn apply(operator: &str, a: f64, b: f64) -> Result<f64, &'static str> {
    let truth = |truth: bool| f64::from(u8::from(truth));
    let holds = |value: f64| value != 0.0;
    let value = match operator {
        "**" => libm::pow(a, b),
        "*" => a * b,
        "/" if b == 0.0 => return Err("a division by zero"),
        "/" => a / b,
        "MOD" if b == 0.0 => return Err("a division by zero"),
        "MOD" => a.rem_euclid(b),
        "+" => a + b,
        "-" => a - b,
        "EQ" => truth((a - b).abs() < EQUAL),
        "NE" => truth((a - b).abs() >= EQUAL),
        "GT" => truth(a > b),
        "GE" => truth(a >= b),
        "LT" => truth(a < b),
        "LE" => truth(a <= b),
        "AND" => truth(holds(a) && holds(b)),
        "OR" => truth(holds(a) || holds(b)),
        _ => truth(holds(a) != holds(b)),
    };
    if value.is_finite() { Ok(value) } else { Err("the result is not a number") }
}

#[cfg(test)]
mod tests {
    use super::super::source::Pointer;
    use super::*;

    struct None;

    impl Scope for None {
        fn parameter(&mut self, name: &Name) -> Result<f64, String> {
            match name {
                Name::Number(number) => Ok(f64::from(*number) + 0.5),
                Name::Text(text) => Err(format!("nothing sets {text}")),
            }
        }

        fn exists(&self, name: &Name) -> bool {
            *name == Name::Text("HERE".to_owned())
        }
    }

    fn of(text: &str) -> Result<f64, String> {
        let mut code = Code::new(Pointer { line: 1, source: text });
        value(&mut code, &mut None).map_err(|error| error.to_string())
    }

    #[test]
    fn expressions_have_the_values_of_the_specification() {
        let cases = [
            ("1.5", 1.5),
            ("-.5", -0.5),
            ("[2 + 3 * 4 - 5]", 9.0),
            ("[2 ** 3 ** 2]", 64.0),
            ("[-7 mod 3]", 2.0),
            ("[1 + 2 eq 3]", 1.0),
            ("[1 lt 2 and 3 ge 4]", 0.0),
            ("[1 xor 1 or 1]", 1.0),
            ("atan[1]/[-1]", 135.0),
            ("[10 - fix[-2.5] + fup[2.1]]", 16.0),
            ("sqrt[9]", 3.0),
            ("#4", 4.5),
            ("#[2 + round[#2 - 2.1]]", 2.5),
            ("exists[#<here>]", 1.0),
            ("exists[#<the re>]", 0.0),
        ];
        for (text, expected) in cases {
            let value = of(text).expect(text);
            assert!((value - expected).abs() < 1e-12, "{text} is {value}, not {expected}");
        }
    }

    #[test]
    fn what_has_no_value_says_why() {
        let cases = [
            ("[1", "expected a `]`"),
            ("[1 / 0]", "division by zero"),
            ("sqrt[-1]", "not a number"),
            ("foo[1]", "expected a function"),
            ("#<gone>", "nothing sets GONE"),
            ("##1", "whole number of a parameter"),
            (".", "expected a number"),
        ];
        for (text, reason) in cases {
            let error = of(text).expect_err(text);
            assert!(error.contains(reason), "`{text}` gives `{error}`, without `{reason}`");
        }
        assert!(
            of(&"[".repeat(100_000)).is_err_and(|error| error.contains("nested too deep")),
            "the stack is safe"
        );
    }
}
