//! The controller: what holds from line to line, and what a line makes of it.

mod arc;
mod curve;
mod cycle;
mod parameters;
mod place;
mod setting;
mod travel;

use crate::geometry::Nm;

use super::block::{Block, Word};
use super::error::ReadError;
use super::expression::index;
use super::frame::{Axis, Plane};
use super::listing::{Counting, Listing, Odd, Place, Spindle, Stop, Waits};
use super::meaning::{Distance, FeedMode, Meaning, Mode, Special, meaning};
use super::source::Pointer;
use super::variables::Variables;

use curve::Curves;
use cycle::Holes;

/// What M70 and M73 keep, and the words of a line change.
#[derive(Clone, Copy, Debug)]
struct Modal {
    mode: Mode,
    plane: Plane,
    distance: Distance,
    centers: Distance,
    /// Nanometres in a unit, and whether the program has said so.
    unit: i64,
    unit_given: bool,
    feed_mode: FeedMode,
    to_initial: bool,
    system: usize,
    feed: Option<i64>,
    speed: Option<u32>,
    spinning: bool,
}

impl Default for Modal {
    fn default() -> Self {
        Self {
            mode: Mode::None,
            plane: Plane::Xy,
            distance: Distance::Absolute,
            centers: Distance::Incremental,
            unit: 1_000_000,
            unit_given: false,
            feed_mode: FeedMode::PerMinute,
            to_initial: false,
            system: 0,
            feed: None,
            speed: None,
            spinning: false,
        }
    }
}

impl Modal {
    fn counting(&self) -> Counting {
        Counting {
            unit: self.unit,
            incremental: self.distance == Distance::Incremental,
            absolute_centers: self.centers == Distance::Absolute,
            cycle: matches!(self.mode, Mode::Cycle(_)),
        }
    }
}

/// A controller that runs a program.
#[derive(Debug, Default)]
pub(super) struct Machine {
    pub(super) listing: Listing,
    pub(super) variables: Variables,
    /// The line that is being run.
    pub(super) line: u32,
    modal: Modal,
    axes: [Axis; 3],
    selected: Option<u32>,
    tool: Option<u32>,
    /// Where cutter compensation was switched on.
    compensated: Option<u32>,
    holes: Holes,
    curves: Curves,
    /// F with G93, of this line.
    inverse: Option<f64>,
    saved: Option<Modal>,
    /// The line that first let go of the motors, and how many motions there were before it.
    released: Option<(u32, usize)>,
    /// What the last probe found, in nanometres on the board.
    probed: [Option<Nm>; 3],
}

/// Corners that are rounded by more are not where they are planned, in nanometres. Chosen: what a
/// hole may be off its place.
const ROUNDED: f64 = 50_000.0;

/// What a line asks of the flow of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ask {
    On,
    End,
    /// M98.
    Call,
    /// M99.
    Return,
}

/// What the codes of a line ask for.
#[derive(Default)]
struct Orders {
    motion: Option<Mode>,
    special: Option<Special>,
    /// Whether that is what the axis words are for.
    takes_axes: bool,
    ends_curve: bool,
    in_machine: bool,
    dwell: bool,
    change_tool: bool,
    /// Waits for a person, or may, and whether that is known.
    stop: Option<Waits>,
    ask: Option<Ask>,
}

/// A line that is being run.
#[derive(Clone, Copy)]
struct Run<'a> {
    pointer: Pointer<'a>,
    block: &'a Block,
}

impl Run<'_> {
    const fn line(&self) -> u32 {
        self.pointer.line
    }

    fn error(&self, word: Word, expected: impl Into<String>) -> ReadError {
        self.pointer.error(word.column, expected)
    }

    /// An error at the line's first word.
    fn refuse(&self, expected: impl Into<String>) -> ReadError {
        let lead = self.pointer.source.len() - self.pointer.source.trim_start().len();
        self.pointer.error(u32::try_from(lead + 1).unwrap_or(1), expected)
    }
}

impl Machine {
    /// Runs a line, in the order of RS274/NGC §3.8: feed, speed, tool, spindle, dwell, plane,
    /// units, systems, distance, motion, stop.
    pub(super) fn run(&mut self, pointer: Pointer<'_>, block: &Block) -> Result<Ask, ReadError> {
        let run = Run { pointer, block };
        self.remarks(run);
        let orders = self.orders(run)?;
        self.settings(run, orders.dwell)?;
        self.oddities(run, &orders);
        if orders.change_tool {
            self.tool = self.selected;
        }
        self.passed_over(run);
        if orders.dwell {
            self.dwell(run)?;
        }
        if orders.ends_curve {
            self.end_curve(run)?;
        }
        self.take_mode(&orders);
        if let Some(special) = orders.special {
            self.special(run, special)?;
        }
        // What takes the axis words of a line leaves none for a motion.
        if !orders.takes_axes {
            self.motion(run, &orders)?;
        }
        self.listing.counts(run.line(), self.modal.counting());
        for (name, value) in &block.assignments {
            self.variables.set(name.clone(), *value);
        }
        if let Some(waits) = orders.stop {
            let before = self.listing.motions.len();
            let spinning = waits != Waits::Perhaps && !orders.change_tool && self.modal.spinning;
            let changes = orders.change_tool;
            self.listing.stops.push(Stop { before, line: run.line(), waits, changes, spinning });
        }
        if orders.ask == Some(Ask::End) {
            self.listing.end = Some(run.line());
            self.modal.spinning = false;
        }
        Ok(orders.ask.unwrap_or(Ask::On))
    }

    /// Whether the spindle turns.
    pub(super) const fn is_spinning(&self) -> bool {
        self.modal.spinning
    }

    /// Where the tool is.
    fn place(&self) -> Place {
        let [x, y, z] = self.axes.map(|axis| axis.at);
        Place { x, y, z }
    }

    const fn spindle(&self) -> Spindle {
        match (self.modal.spinning, self.modal.speed) {
            (false, _) => Spindle::Off,
            (true, None) => Spindle::Unstated,
            (true, Some(speed)) => Spindle::At(speed),
        }
    }

    /// What of a line is passed over.
    fn remarks(&mut self, run: Run<'_>) {
        let (line, block) = (run.line(), run.block);
        for &letter in &block.others {
            let what = if letter == 'E' { "the extruder" } else { "an axis that is not supported" };
            self.listing.note(true, line, format!("{letter} is ignored: {what}"));
        }
        if block.checksum == Some(false) {
            self.listing.note(true, line, "the checksum of a line is wrong: a controller asks for it again");
        }
        if block.computed {
            self.listing.is_indirect(line, "a parameter or an expression");
        }
        let orders = block.orders.len();
        if orders == 0 && block.first("XYZ").is_some() {
            self.listing.is_odd(Odd::Bare, line);
        } else if orders > 1 {
            self.listing.is_odd(Odd::Several, line);
        }
        if block.optional {
            self.listing.note(
                false,
                line,
                "a line after `/` is run: with block delete on, the machine skips it",
            );
        }
    }

    /// Counts what Grbl and its kind stop at in a line, though its codes are theirs.
    fn oddities(&mut self, run: Run<'_>, orders: &Orders) {
        let (line, block) = (run.line(), run.block);
        let meanings = || block.orders.iter().map(|order| meaning(order.letter, order.key));
        // Of motions, `orders` has refused two that differ.
        let cancels = |meaning: &Meaning| *meaning == Meaning::Motion(Mode::None);
        // Most lines have one code, and nothing to be beside it.
        let is_twice = block.orders.len() > 1 && {
            let groups = meanings().filter(|meaning| !cancels(meaning)).filter_map(Meaning::group);
            let mut groups: Vec<u8> = groups.collect();
            groups.sort_unstable();
            groups.windows(2).any(|pair| pair[0] == pair[1])
        };
        // A motion wants the axis words that G28 and its kind take.
        let both = orders.takes_axes && orders.motion.is_some_and(|mode| mode != Mode::None);
        if both && orders.ask != Some(Ask::End) || is_twice {
            self.listing.is_odd(Odd::Contrary, line);
        }
        if meanings().any(|meaning| cancels(&meaning)) && orders.motion != Some(Mode::None) {
            self.listing.is_odd(Odd::Cancels, line);
        }
        // All others are no code of theirs, and told as that.
        let are_known = meanings().all(|meaning| meaning.group().is_some());
        let motion = orders.motion.unwrap_or(self.modal.mode);
        let is_known = matches!(motion, Mode::None | Mode::Rapid | Mode::Feed | Mode::Arc(_) | Mode::Probe);
        let asks = |letter: char| match letter {
            'P' => orders.dwell || orders.special == Some(Special::Data),
            'L' => orders.special == Some(Special::Data),
            'I' | 'J' | 'K' | 'R' => matches!(motion, Mode::Arc(_)),
            _ => false,
        };
        let unasked = |letter: &char| block.get(*letter).is_some() && !asks(*letter);
        let mut unasked = "DHIJKLPQR".chars().filter(unasked).peekable();
        if are_known && is_known {
            if unasked.peek().is_some() || !block.others.is_empty() {
                self.listing.is_odd(Odd::Unasked, line);
            }
            let turns = |letter: char| letter == 'P' && matches!(motion, Mode::Arc(_));
            if unasked.any(|letter| letter != 'D' && !turns(letter)) {
                self.listing.is_odd(Odd::Idle, line);
            }
        }
        if orders.dwell && block.get('P').is_none() {
            self.listing.is_odd(Odd::Untimed, line);
        }
        if block.get('T').is_some_and(|tool| tool.value > f64::from(u8::MAX)) {
            self.listing.is_odd(Odd::HighTool, line);
        }
    }

    /// Takes the codes of a line into account, as far as they act before its motion.
    fn orders(&mut self, run: Run<'_>) -> Result<Orders, ReadError> {
        let mut orders = Orders::default();
        for &order in &run.block.orders {
            let refuse = |expected: &str| Err(run.pointer.error(order.column, expected));
            self.listing.code(order.letter, order.key, run.line());
            match meaning(order.letter, order.key) {
                Meaning::Motion(mode) => {
                    // `G80 G0` is written often; two motions are not.
                    let before = orders.motion.filter(|before| *before != Mode::None && mode != Mode::None);
                    if before.is_some_and(|before| before != mode) {
                        return refuse("a second kind of motion in the line");
                    }
                    orders.motion = orders.motion.filter(|_| mode == Mode::None).or(Some(mode));
                }
                Meaning::EndCurve => orders.ends_curve = true,
                Meaning::Plane(plane) => self.modal.plane = plane,
                Meaning::Unit(unit) => (self.modal.unit, self.modal.unit_given) = (unit, true),
                Meaning::Distance(distance) => self.modal.distance = distance,
                Meaning::Centers(centers) => self.modal.centers = centers,
                Meaning::FeedMode(mode) => {
                    // NIST RS274/NGC §3.5.19 and Grbl: a feed does not outlast what it counts.
                    if (mode == FeedMode::Inverse) != (self.modal.feed_mode == FeedMode::Inverse) {
                        self.modal.feed = None;
                    }
                    self.modal.feed_mode = mode;
                }
                Meaning::ToInitial(to_initial) => self.modal.to_initial = to_initial,
                Meaning::Dwell => orders.dwell = true,
                Meaning::System(system) => self.choose(system, run.line()),
                Meaning::MachineCoordinates => orders.in_machine = true,
                Meaning::Special(special) => {
                    orders.special = Some(special);
                    // Not of G28.1 and G30.1, which keep the place where the tool is.
                    let keeps = matches!(order.key, 281 | 301);
                    let takes = !keeps && !matches!(special, Special::Drop { .. } | Special::Restore);
                    orders.takes_axes |= takes;
                }
                Meaning::Compensation(on) => self.compensated = on.then_some(run.line()),
                Meaning::Spindle(on) => self.modal.spinning = on,
                Meaning::Backwards => {
                    let what = "M4 turns the spindle backwards where the machine can: drills and mills are \
                                made for M3";
                    self.listing.note(true, run.line(), what);
                    self.modal.spinning = true;
                }
                Meaning::ToolChange => {
                    orders.change_tool = true;
                    orders.stop = Some(Waits::Surely);
                    // NIST RS274/NGC §3.6.3: it stands when the change is complete; what the same
                    // line says of it comes after (§3.8).
                    let starts = |key: u32| {
                        run.block.orders.iter().any(|order| (order.letter, order.key) == ('M', key))
                    };
                    self.modal.spinning = starts(30) || starts(40);
                }
                Meaning::SetTool => orders.change_tool = true,
                Meaning::Stop(waits) => orders.stop = Some(waits),
                Meaning::End => orders.ask = Some(Ask::End),
                Meaning::Call => orders.ask = Some(Ask::Call),
                Meaning::Return => orders.ask = Some(Ask::Return),
                Meaning::Save { .. } => self.saved = Some(self.modal),
                // LinuxCNC restores all but the motion mode ("M70 Save Modal State").
                Meaning::Restore => {
                    let mode = self.modal.mode;
                    self.modal = self.saved.map_or(self.modal, |saved| Modal { mode, ..saved });
                }
                Meaning::Nothing => {}
                Meaning::Unknown => {
                    let tenth =
                        if order.key % 10 == 0 { String::new() } else { format!(".{}", order.key % 10) };
                    let message =
                        format!("M{}{tenth} is unknown: it is assumed to move nothing", order.key / 10);
                    self.listing.note(true, run.line(), message);
                    orders.stop = orders.stop.or(Some(Waits::Perhaps));
                }
                Meaning::Refused(why) => return refuse(why),
            }
            if meaning(order.letter, order.key) == (Meaning::Save { again: true }) {
                return refuse("what a subprogram restores at its end is not supported");
            }
        }
        if let Some(Ask::End) = orders.ask {
            orders.motion = orders.motion.or(Some(self.modal.mode));
        }
        Ok(orders)
    }

    /// Notes codes that change how motions run, and that are not followed.
    #[expect(clippy::cast_precision_loss, reason = "a small unit")]
    fn passed_over(&mut self, run: Run<'_>) {
        let block = run.block;
        let value = |letter: char| block.get(letter).map(|word| word.value);
        for order in &block.orders {
            if matches!((order.letter, order.key), ('M', 180 | 840)) && value('S').is_none() {
                self.released.get_or_insert((run.line(), self.listing.motions.len()));
            }
            let what = match ((order.letter, order.key), value('P'), value('S'), value('H')) {
                (('G', 640), Some(p), ..) if p * self.modal.unit as f64 > ROUNDED => {
                    format!("G64 P{p} lets the machine round corners by that much")
                }
                (('G', 640), None, ..) => {
                    let what = "G64 without P: the machine rounds corners as far as its set-up lets it";
                    self.listing.note(false, run.line(), what);
                    continue;
                }
                (('G', 430), .., Some(h)) if self.tool.is_some() && index(h) != self.tool => {
                    format!("G43 H{h} takes the length of another tool than the one that is in")
                }
                (('M', 2200), _, Some(s), _) if (s - 100.0).abs() >= 1.0 => {
                    format!("M220 S{s}: feeds are {s} % of what they say")
                }
                _ => continue,
            };
            self.listing.note(true, run.line(), what);
        }
    }

    /// Another coordinate system.
    fn choose(&mut self, system: usize, line: u32) {
        if system != self.modal.system && !self.listing.motions.is_empty() {
            self.listing.is_indirect(line, "another coordinate system");
        }
        self.modal.system = system;
    }
}
