//! The commands between `%`, which begin with two letters (specification §4; those of old §8).

use crate::board::polarity::Polarity;
use crate::import::diagnostic;
use crate::import::error::printable;

use super::aperture_macro::Macro;
use super::command::{Command, Said};
use super::definition::{Definition, aperture_number};
use super::fault::Fault;
use super::fields::Fields;
use super::format::{Format, Unit};
use super::lex::{Block, Lexer, Number, is_blank, one_line};
use super::transformation::Change;
use super::words::unknown;

/// Adds to `said` what `block` says; a macro takes its statements from `lexer`.
pub(super) fn read<'a>(
    block: &Block<'a>,
    lexer: &mut Lexer<'a>,
    said: &mut Vec<Said<'a>>,
) -> Result<(), Fault> {
    let (code, rest) = block.text.split_at(2);
    let rest = one_line(rest);
    let rest = rest.as_ref();
    let word = rest.trim_ascii();
    let fault = |what: &str, expected: &str| Err(Fault::new(what, expected));
    let command = match (code, word) {
        (b"FS", _) => Command::Format(Format::read(rest)?),
        (b"MO", b"MM") => Command::Unit(Unit::Millimetre),
        (b"MO", b"IN") => Command::Unit(Unit::Inch),
        (b"MO", _) => return fault("this unit is unknown", "`%MOMM*%` or `%MOIN*%`"),
        (b"AD", _) => Definition::read(rest)
            .map_or_else(|(number, fault)| Command::Malformed(number, fault), Command::Define),
        (b"AM", _) => Command::Macro(Macro::read(block, lexer)?),
        (b"AB", _) if rest.iter().all(|&b| is_blank(b)) => Command::CloseBlock,
        (b"AB", _) => {
            let number = rest.strip_prefix(b"D").and_then(Number::whole).and_then(aperture_number);
            Command::OpenBlock(number.ok_or_else(|| {
                Fault::new("this block has no number", "an aperture number, as in `%ABD12*%`")
            })?)
        }
        (b"SR", _) => {
            said.push(Said::of(block, Command::CloseRepeat));
            match repeat(rest)? {
                Command::OpenRepeat((1, 1), _) => return Ok(()),
                repeat => repeat,
            }
        }
        (b"LP", b"D") => Command::Polarity(Polarity::Dark),
        (b"LP", b"C") => Command::Polarity(Polarity::Clear),
        (b"LP", _) => return fault("this polarity is unknown", "`%LPD*%` or `%LPC*%`"),
        (b"LM" | b"LR" | b"LS" | b"AS" | b"MI" | b"SF" | b"IR", _) => {
            Command::Transform(Change::read(code, rest)?)
        }
        (b"OF", _) => {
            let fields = Fields::read(word)?;
            Command::Offset((fields.get(b'A'), fields.get(b'B')))
        }
        (b"TF" | b"TA" | b"TO" | b"TD", _) => Command::Attribute(one_line(block.text)),
        (b"IP", b"POS") => Command::Negative(false),
        (b"IP", b"NEG") => Command::Negative(true),
        (b"IP", _) => return fault("this image polarity is unknown", "`%IPPOS*%` or `%IPNEG*%`"),
        // Names, of the image and of what follows; the plotter's film.
        (b"IN" | b"LN" | b"PF", _) => return Ok(()),
        // The code of the file's characters, which is ASCII if it can be read at all; and what
        // says nothing but the default.
        (b"IC", _) if rest.eq_ignore_ascii_case(b"AS") => return Ok(()),
        (b"IO" | b"RO", _) if rest.iter().all(|b| b"AB0.+-".contains(b) || is_blank(*b)) => return Ok(()),
        (b"IJ", _) if rest.iter().all(|b| b"ABL".contains(b) || is_blank(*b)) => return Ok(()),
        (b"IC" | b"IJ" | b"IO" | b"RO", _) => {
            let message = format!("%{} is not supported and is ignored", printable(code));
            Command::Remark(&diagnostic::UNKNOWN_COMMAND, message.into())
        }
        // Ends one: there is none.
        (b"KO", b"") => return Ok(()),
        (b"KO", _) => return fault("%KO, knockout, is not supported", "%LPC and %LPD"),
        (b"IF", _) => {
            let what = "%IF includes another file, which is not supported";
            let hint = "put the content of the other file in its place";
            return Err(Fault::new(what, "a file without includes").hint(hint));
        }
        _ => Command::Remark(&diagnostic::UNKNOWN_COMMAND, unknown(block.text).into()),
    };
    said.push(Said::of(block, command));
    Ok(())
}

/// `SRX2Y3I4.0J3.0`
fn repeat(text: &[u8]) -> Result<Command<'static>, Fault> {
    let fields = Fields::read(text)?;
    let copies = |letter: u8| match fields.get(letter) {
        None => Some(1),
        Some(number) => number.to_integer().and_then(|n| u32::try_from(n).ok()).filter(|n| *n >= 1),
    };
    let (Some(x), Some(y)) = (copies(b'X'), copies(b'Y')) else {
        let expected = "numbers of copies in x and y, as in `%SRX2Y3I4.0J3.0*%`";
        return Err(Fault::new("this is not a number of copies", expected));
    };
    Ok(Command::OpenRepeat((x, y), (fields.get(b'I'), fields.get(b'J'))))
}
