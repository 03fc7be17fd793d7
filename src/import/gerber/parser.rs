//! Blocks → commands. What a block says depends on no other, but for the `%` around it.

use crate::import::diagnostic;

use super::command::Said;
use super::fault::Fault;
use super::lex::{Block, End, Lexer};
use super::{extended, words};

/// Tells what a file says, block by block.
#[derive(Debug)]
pub(super) struct Parser<'a> {
    lexer: Lexer<'a>,
    /// Whether a `%` is open.
    bracketed: bool,
    ended: bool,
}

impl<'a> Parser<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { lexer: Lexer::new(bytes), bracketed: false, ended: false }
    }

    /// Adds to `said` what the next block says; where some of it cannot be read, what comes before
    /// that. None at the end of the file.
    pub(super) fn read(&mut self, said: &mut Vec<Said<'a>>) -> Option<Result<(), Fault>> {
        let block = if self.ended { None } else { self.lexer.next() }?;
        Some(self.block(&block, said).map_err(|fault| fault.at(&block.place())))
    }

    fn block(&mut self, block: &Block<'a>, said: &mut Vec<Said<'a>>) -> Result<(), Fault> {
        match block.end {
            End::Star => {}
            End::Percent => {
                let message = "a command does not end with `*`; it is read as if it did";
                said.push(Said::remark(block, &diagnostic::MISSING_STAR, message));
            }
            End::File if matches!(block.text.trim_ascii(), b"M02" | b"M00") => {
                let message = "the last command does not end with `*`";
                said.push(Said::remark(block, &diagnostic::MISSING_STAR, message));
            }
            End::File if block.text.trim_ascii_end().is_empty() => return Ok(()),
            End::File => {
                let message =
                    "the file ends in the middle of a command, which is ignored: it may be truncated";
                said.push(Said::remark(block, &diagnostic::TRUNCATED_FILE, message));
                return Ok(());
            }
        }
        let is_extended = matches!(block.text, [b'A'..=b'Z', b'A'..=b'Z', ..]);
        self.bracketed ^= block.percents % 2 == 1;
        if is_extended != self.bracketed {
            let message = "a `%` is missing before or after this command; it is read as if it were there";
            said.push(Said::remark(block, &diagnostic::MISSING_PERCENT, message));
            self.bracketed = is_extended;
        }
        if is_extended {
            extended::read(block, &mut self.lexer, said)
        } else {
            words::read(block, said, &mut self.ended)
        }
    }

    /// The rest of the file.
    pub(super) const fn ahead(&self) -> &Lexer<'a> {
        &self.lexer
    }

    /// Whether the file has said that it ends.
    pub(super) const fn has_ended(&self) -> bool {
        self.ended
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::gerber::command::Command;

    /// The names of the commands, each with the text it stands at, and whether all could be read.
    fn said(text: &str) -> (Vec<String>, bool) {
        let (mut parser, mut said, mut fine) = (Parser::new(text.as_bytes()), Vec::new(), true);
        while let Some(read) = parser.read(&mut said) {
            fine &= read.is_ok();
        }
        let name = |command: &Command<'_>| {
            let shown = format!("{command:?}");
            shown.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default().to_owned()
        };
        (
            said.iter()
                .map(|said| format!("{} {}", name(&said.command), &text[said.place.clone()]))
                .collect(),
            fine,
        )
    }

    #[test]
    fn words_say_what_they_change_and_the_block_what_it_draws() {
        let (commands, fine) = said("D11G02G75X1I2D01*");
        let expected = ["Select D11", "Interpolate G02", "Quadrants G75", "Operate D11G02G75X1I2D01"];
        assert_eq!((commands, fine), (expected.map(str::to_owned).to_vec(), true), "in this order");
        let (commands, _) = said("X1D01X2D01*");
        assert_eq!(commands, ["Remark X2", "Operate X1D01X2D01", "Operate X1D01X2D01"], "two without a star");
    }

    #[test]
    fn what_comes_before_something_unreadable_is_said() {
        let (commands, fine) = said("G36X1D99999999999*G37*");
        assert_eq!(commands, ["Region G36", "Region G37"], "no operation of a block that is not whole");
        assert!(!fine, "the D code is none");
    }

    #[test]
    fn a_repeat_closes_the_one_before_it_and_nothing_follows_the_end() {
        let (commands, fine) = said("%SRX2Y1I1J1*%%SR*%%AMA*1,1,$1,0,0*%M02*G01*");
        let expected = ["CloseRepeat SRX2Y1I1J1", "OpenRepeat SRX2Y1I1J1", "CloseRepeat SR", "Macro AMA"];
        assert_eq!(
            (commands, fine),
            (expected.map(str::to_owned).to_vec(), true),
            "the macro is one command"
        );
    }
}
