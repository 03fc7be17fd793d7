//! The arithmetic of aperture macros (specification §4.5.4): `+ - x /`, brackets, signs, `$n` and
//! decimals.

use super::lex::{Number, is_blank};

/// How deep brackets and signs may nest. Chosen: files of tools nest two or three deep.
const DEPTH: u32 = 64;

/// Why an expression has no value, and where in its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// The byte of the text.
    pub(super) at: usize,
    /// What is wrong.
    pub(super) what: &'static str,
    /// What was expected.
    pub(super) expected: &'static str,
}

/// The values of `$1`, `$2`, … of a macro; zero for what was never set.
#[derive(Clone, Debug, Default)]
pub(super) struct Variables(Vec<f64>);

/// The largest variable number. Chosen: a thousand times what files of tools use.
const VARIABLES: usize = 10_000;

impl Variables {
    pub(super) const fn new(parameters: Vec<f64>) -> Self {
        Self(parameters)
    }

    fn get(&self, number: usize) -> f64 {
        number.checked_sub(1).and_then(|i| self.0.get(i)).copied().unwrap_or(0.0)
    }

    /// Sets `$number`; false for a number out of range.
    pub(super) fn set(&mut self, number: usize, value: f64) -> bool {
        if !(1..=VARIABLES).contains(&number) {
            return false;
        }
        if self.0.len() < number {
            self.0.resize(number, 0.0);
        }
        self.0[number - 1] = value;
        true
    }
}

/// The value of `text`.
pub(super) fn evaluate(text: &[u8], variables: &Variables) -> Result<f64, Fault> {
    let mut parser = Parser { text, at: 0, variables };
    let value = parser.sum(0)?;
    match parser.peek() {
        None if value.is_finite() => Ok(value),
        None => Err(Fault { at: 0, what: "this expression has no finite value", expected: "a number" }),
        Some(_) => Err(parser.fault("something follows the expression", "an operator, a comma or the end")),
    }
}

struct Parser<'a> {
    text: &'a [u8],
    at: usize,
    variables: &'a Variables,
}

impl Parser<'_> {
    /// The next byte that is not white space.
    fn peek(&mut self) -> Option<u8> {
        while self.text.get(self.at).is_some_and(|&b| is_blank(b)) {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }

    const fn fault(&self, what: &'static str, expected: &'static str) -> Fault {
        Fault { at: self.at, what, expected }
    }

    fn sum(&mut self, depth: u32) -> Result<f64, Fault> {
        let mut value = self.product(depth)?;
        while let Some(sign @ (b'+' | b'-')) = self.peek() {
            self.at += 1;
            let term = self.product(depth)?;
            value = if sign == b'+' { value + term } else { value - term };
        }
        Ok(value)
    }

    fn product(&mut self, depth: u32) -> Result<f64, Fault> {
        let mut value = self.factor(depth)?;
        while let Some(sign @ (b'x' | b'X' | b'/')) = self.peek() {
            self.at += 1;
            let start = self.at;
            let factor = self.factor(depth)?;
            if sign != b'/' {
                value *= factor;
            } else if factor.abs() > 0.0 {
                value /= factor;
            } else {
                let (what, expected) = ("division by zero", "a divisor that is not zero");
                return Err(Fault { at: start, what, expected });
            }
        }
        Ok(value)
    }

    fn factor(&mut self, depth: u32) -> Result<f64, Fault> {
        if depth > DEPTH {
            return Err(self.fault("this expression is nested too deep", "at most 64 brackets and signs"));
        }
        match self.peek() {
            Some(b'-') => {
                self.at += 1;
                Ok(-self.factor(depth + 1)?)
            }
            Some(b'+') => {
                self.at += 1;
                self.factor(depth + 1)
            }
            Some(b'(') => {
                self.at += 1;
                let value = self.sum(depth + 1)?;
                if self.peek() != Some(b')') {
                    return Err(self.fault("a bracket is not closed", "`)`"));
                }
                self.at += 1;
                Ok(value)
            }
            Some(b'$') => {
                self.at += 1;
                let number = self.number("a variable without a number", "a number, as in `$1`")?;
                let number = number.to_integer().and_then(|n| usize::try_from(n).ok());
                Ok(self.variables.get(number.unwrap_or(0)))
            }
            _ => Ok(self.number("a number is missing here", "a number, a variable or a bracket")?.to_f64()),
        }
    }

    fn number(&mut self, what: &'static str, expected: &'static str) -> Result<Number, Fault> {
        let unsigned = self.text.get(self.at).is_some_and(|b| b.is_ascii_digit() || *b == b'.');
        let read = if unsigned { Number::read(&self.text[self.at..]) } else { None };
        let (number, length) = read.ok_or_else(|| self.fault(what, expected))?;
        self.at += length;
        Ok(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, Fault> {
        evaluate(text.as_bytes(), &Variables::new(vec![2.0, 0.5]))
    }

    #[test]
    fn products_bind_tighter_than_sums() {
        for (text, expected) in [
            ("1+$1x3", 7.0),
            ("(1+$1)X3", 9.0),
            ("-$1-$2", -2.5),
            ("$1/4 + .5", 1.0),
            ("$9", 0.0),
            ("1-1-1", -1.0),
            ("--2", 2.0),
        ] {
            assert_eq!(value(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_has_no_value_says_where() {
        for (text, at) in [("1/0", 2), ("(1", 2), ("1+", 2), ("12x", 3), ("$", 1), ("nan", 0)] {
            assert_eq!(value(text).map_err(|fault| fault.at), Err(at), "{text}");
        }
        assert!(value(&"(".repeat(100_000)).is_err(), "deep nesting is refused");
    }
}
