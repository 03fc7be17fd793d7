//! Blocks of words, `G01X10Y20D01` (specification §4.2 to §4.13; the words of old §8).

use crate::geometry::Turn;
use crate::import::diagnostic;
use crate::import::error::printable;

use super::command::{Command, Interpolation, Operation, Said, Words};
use super::fault::Fault;
use super::format::Unit;
use super::lex::{Block, Number, comment, is_blank};
use super::quadrants::Quadrants;

/// Adds to `said` what `block` says, up to what cannot be read. Sets `ended` where it ends the
/// file.
pub(super) fn read<'a>(block: &Block<'a>, said: &mut Vec<Said<'a>>, ended: &mut bool) -> Result<(), Fault> {
    let (text, line) = (block.text, block.line);
    let mut words = Words::default();
    let (mut at, mut drawn) = (0, false);
    // Whether an operation has come after its coordinates: more of them begin another, without
    // a `*` between.
    let mut complete = false;
    while let Some(&letter) = text.get(at) {
        if is_blank(letter) {
            at += 1;
            continue;
        }
        if let Some(comment) = comment(&text[at..]) {
            said.push(Said::of(block, Command::Comment(comment)));
            break;
        }
        let start = block.start + at;
        let Some((number, length)) = Number::read(&text[at + 1..]) else {
            return no_word(block, at, said);
        };
        let place = start..start + 1 + length;
        let letter = letter.to_ascii_uppercase();
        let word = |command| Said { command, place: place.clone(), line };
        if complete && letter != b'M' {
            let message = "a command does not end with `*`; it is read as if it did";
            said.push(word(Command::Remark(&diagnostic::MISSING_STAR, message.into())));
            said.push(Said::of(block, Command::Operate(words)));
            (words, drawn, complete) = (Words::default(), false, false);
        }
        match letter {
            b'X' => words.x = Some(number),
            b'Y' => words.y = Some(number),
            b'I' => words.i = Some(number),
            b'J' => words.j = Some(number),
            b'D' => {
                match number.to_integer() {
                    Some(1) => words.operation = Some(Operation::Draw),
                    Some(2) => words.operation = Some(Operation::Move),
                    Some(3) => words.operation = Some(Operation::Flash),
                    Some(0) => {
                        let message = "D00 is neither an operation nor an aperture; it is ignored";
                        said.push(word(Command::Remark(&diagnostic::UNKNOWN_COMMAND, message.into())));
                    }
                    code => {
                        said.push(word(Command::Select(aperture(code).map_err(|fault| fault.at(&place))?)))
                    }
                }
                complete = drawn && words.operation.is_some();
            }
            b'G' => {
                if let Some(command) = g_code(number).map_err(|fault| fault.at(&place))? {
                    said.push(word(command));
                }
            }
            b'M' => match number.to_integer() {
                Some(0 | 2) => *ended = true,
                Some(1) => {}
                _ => {
                    let message = "this M code is unknown; it is ignored";
                    said.push(word(Command::Remark(&diagnostic::UNKNOWN_COMMAND, message.into())));
                }
            },
            b'N' => {}
            _ => return no_word(block, at, said),
        }
        drawn |= matches!(letter, b'X' | b'Y' | b'I' | b'J');
        at += 1 + length;
    }
    if drawn || words.operation.is_some() {
        said.push(Said::of(block, Command::Operate(words)));
    }
    Ok(())
}

/// A block that begins well enough to be looked at, but holds something that is no word at `at`.
fn no_word<'a>(block: &Block<'a>, at: usize, said: &mut Vec<Said<'a>>) -> Result<(), Fault> {
    let (text, start) = (block.text, block.start + at);
    let place = start..start + (text.len() - at).max(1);
    if at == 0 && !matches!(text[0], b'X' | b'Y' | b'D' | b'G' | b'I' | b'J') {
        said.push(Said::remark(block, &diagnostic::UNKNOWN_COMMAND, unknown(text)));
        return Ok(());
    }
    Err(Fault::new("this is not a command", "a letter and a number, as in `X1500`").at(&place))
}

/// What is said of a block that begins with no command.
pub(super) fn unknown(text: &[u8]) -> String {
    format!("`{}` is not a known command; it is ignored", printable(&text[..text.len().min(20)]))
}

/// The aperture that a D code selects.
fn aperture(code: Option<i64>) -> Result<u32, Fault> {
    let number =
        code.filter(|code| (10..=0x7fff_ffff).contains(code)).and_then(|code| u32::try_from(code).ok());
    number.ok_or_else(|| {
        Fault::new(
            "this is neither an operation nor an aperture",
            "D01 to draw, D02 to move, D03 to flash, or an aperture from D10 on",
        )
    })
}

fn g_code(number: Number) -> Result<Option<Command<'static>>, Fault> {
    Ok(Some(match number.to_integer() {
        // G54 selects an aperture and G55 announces a flash: the D code says as much. G00 moves
        // as D02 does.
        Some(0 | 54 | 55) => return Ok(None),
        Some(1) => Command::Interpolate(Interpolation::Linear),
        Some(2) => Command::Interpolate(Interpolation::Circular(Turn::Clockwise)),
        Some(3) => Command::Interpolate(Interpolation::Circular(Turn::CounterClockwise)),
        Some(code @ (36 | 37)) => Command::Region(code == 36),
        Some(70) => Command::OldUnit(Unit::Inch),
        Some(71) => Command::OldUnit(Unit::Millimetre),
        Some(74) => Command::Quadrants(Quadrants::Single),
        Some(75) => Command::Quadrants(Quadrants::Multi),
        Some(mode @ (90 | 91)) => Command::Incremental(mode == 91),
        Some(code @ 10..=12) => {
            let what = format!("G{code}, scaled interpolation, is not supported");
            return Err(Fault::new(what, "G01, G02 or G03").hint("export the file again as RS-274X"));
        }
        _ => {
            let message = "this G code is unknown; it is ignored";
            Command::Remark(&diagnostic::UNKNOWN_COMMAND, message.into())
        }
    }))
}
