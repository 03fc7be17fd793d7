//! What a file says, one thing at a time.

use std::borrow::Cow;
use std::ops::Range;

use crate::board::Diagnostic;
use crate::board::polarity::Polarity;
use crate::geometry::Turn;

use super::aperture_macro::Macro;
use super::definition::Definition;
use super::fault::Fault;
use super::format::{Format, Unit};
use super::lex::{Block, Number};
use super::quadrants::Quadrants;
use super::transformation::Change;

/// How D01 moves (G01, G02, G03).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Interpolation {
    Linear,
    Circular(Turn),
}

/// D01, D02, D03.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operation {
    Draw,
    Move,
    Flash,
}

/// The words of one block that are left for its operation.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Words {
    pub(super) x: Option<Number>,
    pub(super) y: Option<Number>,
    pub(super) i: Option<Number>,
    pub(super) j: Option<Number>,
    pub(super) operation: Option<Operation>,
}

/// Two lengths along x and y, as they are written.
pub(super) type Lengths = (Option<Number>, Option<Number>);

/// One thing that a file says.
#[derive(Debug)]
pub(super) enum Command<'a> {
    /// Something sloppy that is repaired or ignored: what to warn of.
    Remark(&'static Diagnostic, Cow<'static, str>),
    /// G04.
    Comment(&'a [u8]),
    /// D01, D02, D03, or a coordinate without.
    Operate(Words),
    /// Dnn.
    Select(u32),
    /// G01, G02, G03.
    Interpolate(Interpolation),
    /// G36 and G37: whether a region begins.
    Region(bool),
    /// G70 and G71.
    OldUnit(Unit),
    /// G74 and G75.
    Quadrants(Quadrants),
    /// G90 and G91: whether each coordinate counts from the one before.
    Incremental(bool),
    /// FS.
    Format(Format),
    /// MO.
    Unit(Unit),
    /// AD.
    Define(Definition),
    /// AD that cannot be read: its number, where that can.
    Malformed(Option<u32>, Fault),
    /// AM.
    Macro(Macro<'a>),
    /// ABDnn.
    OpenBlock(u32),
    /// AB.
    CloseBlock,
    /// SR closes what an SR before it opened.
    CloseRepeat,
    /// SR that opens: copies in x and y, and the steps between them.
    OpenRepeat((u32, u32), Lengths),
    /// LP.
    Polarity(Polarity),
    /// LM, LR, LS, AS, IR, MI, SF.
    Transform(Change),
    /// OF.
    Offset(Lengths),
    /// IP: whether the image is negative.
    Negative(bool),
    /// TF, TA, TO, TD.
    Attribute(Cow<'a, [u8]>),
}

/// A command and where it stands.
#[derive(Debug)]
pub(super) struct Said<'a> {
    pub(super) command: Command<'a>,
    /// The bytes of the file.
    pub(super) place: Range<usize>,
    /// The line on which its block begins.
    pub(super) line: u32,
}

impl<'a> Said<'a> {
    /// What all of `block` says.
    pub(super) const fn of(block: &Block<'a>, command: Command<'a>) -> Self {
        Self { command, place: block.place(), line: block.line }
    }

    /// What is to be said of `block`.
    pub(super) fn remark(
        block: &Block<'a>,
        diagnostic: &'static Diagnostic,
        message: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self::of(block, Command::Remark(diagnostic, message.into()))
    }
}
