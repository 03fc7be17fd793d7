//! Which line runs after which: O-words as LinuxCNC has them, M98 and M99, the end; bounded, so
//! that no loop hangs.
//!
//! ```text
//!   o1 sub … o1 endsub        o2 if [..] … o2 elseif [..] … o2 else … o2 endif
//!   o1 call [..] [..]         o3 while [..] … o3 endwhile      o3 do … o3 while [..]
//!   M98 P1 L3 … O1 … M99      o4 repeat [..] … o4 endrepeat    break, continue, return
//! ```

use std::collections::BTreeMap;

use super::block::Block;
use super::error::ReadError;
use super::expression::{bracketed, index, value};
use super::listing::Listing;
use super::machine::{Ask, Machine};
use super::source::{AT_ONCE, Code, Pointer, lines};
use super::variables::Name;

/// How many lines are run beside those of the text. Chosen: some seconds of work.
const RUNS: u64 = 1_000_000;
/// How deep subprograms may call each other. Chosen: LinuxCNC allows ten.
const CALLS: usize = 100;
/// The arguments of a call.
const ARGUMENTS: usize = 30;

/// Follows a program.
///
/// # Errors
///
/// The first word that cannot be read or whose meaning the text alone does not tell, with its place
/// and the reason.
pub fn read(text: &str) -> Result<Listing, ReadError> {
    let lines: Vec<&str> = lines(text).collect();
    let mut flow = Flow::new(&lines);
    let mut runs = RUNS + lines.len() as u64;
    while let Some(source) = flow.lines.get(flow.at).copied() {
        let pointer = flow.pointer(flow.at);
        if flow.is_over(source) {
            break;
        }
        if runs == 0 {
            let what = format!("loops run {RUNS} lines and have no end: this is not supported");
            return Err(pointer.error(1, what));
        }
        runs -= 1;
        flow.machine.line = pointer.line;
        flow.line(pointer)?;
        if flow.machine.listing.end.is_some() {
            break;
        }
    }
    flow.finished()?;
    flow.machine.listing.behind_end = flow.behind_end();
    flow.machine.finish();
    let spinning = flow.machine.is_spinning();
    Ok(Listing { spinning, ..flow.machine.listing })
}

/// What an O-word says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Keyword {
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
    /// A number alone: where M98 goes.
    Label,
}

/// What ends subprograms, of LinuxCNC and of others.
const RETURNS: [&str; 2] = ["ENDSUB", "M99"];

const KEYWORDS: [(&str, Keyword); 15] = [
    ("ENDSUB", Keyword::EndSub),
    ("SUB", Keyword::Sub),
    ("CALL", Keyword::Call),
    ("RETURN", Keyword::Return),
    ("IF", Keyword::If),
    ("ELSEIF", Keyword::ElseIf),
    ("ELSE", Keyword::Else),
    ("ENDIF", Keyword::EndIf),
    ("WHILE", Keyword::While),
    ("ENDWHILE", Keyword::EndWhile),
    ("DO", Keyword::Do),
    ("REPEAT", Keyword::Repeat),
    ("ENDREPEAT", Keyword::EndRepeat),
    ("BREAK", Keyword::Break),
    ("CONTINUE", Keyword::Continue),
];

/// A subprogram that is being run.
#[derive(Clone, Copy, Debug)]
struct Call {
    /// The line to go on with.
    back: usize,
    /// Its first line, and how often it runs again: M98 with L.
    first: usize,
    again: u32,
    /// M98: it has no parameters of its own, and ends with M99.
    plain: bool,
    /// How many loops were running.
    loops: usize,
}

/// A counted loop that is being run.
#[derive(Clone, Debug)]
struct Repeat {
    name: String,
    /// Its first line, behind the O-word that begins it.
    first: usize,
    left: u32,
}

struct Flow<'a> {
    lines: &'a [&'a str],
    at: usize,
    /// Where each O-word stands, in order, and what it says there.
    words: BTreeMap<String, Vec<(usize, Keyword)>>,
    calls: Vec<Call>,
    repeats: Vec<Repeat>,
    machine: Machine,
    /// Whether the text stands between two lines of `%`.
    enclosed: bool,
    begun: bool,
}

impl<'a> Flow<'a> {
    fn new(lines: &'a [&'a str]) -> Self {
        let mut words: BTreeMap<String, Vec<(usize, Keyword)>> = BTreeMap::new();
        for (at, source) in lines.iter().enumerate() {
            // Most lines have none.
            if !source.contains(['o', 'O', ':']) {
                continue;
            }
            let mut code = Code::new(Pointer { line: 0, source });
            if let Some((name, Some(keyword))) = o_word(&mut code) {
                words.entry(name).or_default().push((at, keyword));
            }
        }
        Self {
            lines,
            at: 0,
            words,
            calls: Vec::new(),
            repeats: Vec::new(),
            machine: Machine::default(),
            enclosed: false,
            begun: false,
        }
    }

    fn pointer(&self, at: usize) -> Pointer<'a> {
        Pointer { line: u32::try_from(at + 1).unwrap_or(u32::MAX), source: self.lines[at] }
    }

    /// Whether a line is the second `%`, behind which nothing counts.
    fn is_over(&mut self, source: &str) -> bool {
        let is_percent = source.trim().starts_with('%');
        let over = is_percent && self.enclosed && self.begun;
        self.enclosed |= is_percent && !self.begun;
        self.begun |= !source.trim().is_empty();
        over
    }

    fn line(&mut self, pointer: Pointer<'a>) -> Result<(), ReadError> {
        self.at += 1;
        let source = pointer.source.trim();
        if source.is_empty() || source.starts_with('%') {
            return Ok(());
        }
        if source.starts_with(AT_ONCE) {
            return self.command(pointer, source);
        }
        let mut code = Code::new(pointer);
        if code.open_comment {
            let what = "a comment does not end in its line: the rest of the line is read as comment";
            self.machine.listing.note(true, pointer.line, what);
        }
        if source.contains(['o', 'O', ':']) {
            let mut ahead = code.clone();
            if let Some((name, keyword)) = o_word(&mut ahead) {
                let what = "expected an O-word's keyword, such as sub, call, if or while";
                let keyword = keyword.ok_or_else(|| ahead.error(what))?;
                return self.o_line(ahead, &name, keyword);
            }
            // A name that an expression gives: for a call alone.
            if let Some(()) = self.computed_call(&mut code)? {
                return Ok(());
            }
        }
        let block = Block::read(&mut code, &mut self.machine)?;
        match self.machine.run(pointer, &block)? {
            Ask::On | Ask::End => Ok(()),
            Ask::Call => self.m98(pointer, &block),
            Ask::Return => self.m99(pointer),
        }
    }

    /// What Grbl takes at once, and its settings.
    fn command(&mut self, pointer: Pointer<'a>, source: &str) -> Result<(), ReadError> {
        if source.starts_with("$H") || source.starts_with("$J") {
            let block = Block::default();
            self.machine.home_all(pointer, &block)?;
        }
        let sets = source[1..].starts_with(|c: char| c.is_ascii_digit()) && source.contains('=');
        let what = if sets {
            "a setting of the controller is changed, for all programs that come after"
        } else {
            "a command of the controller is ignored"
        };
        self.machine.listing.note(sets, pointer.line, what);
        Ok(())
    }

    fn next_of(&self, name: &str, from: usize, wanted: &[Keyword]) -> Option<(usize, Keyword)> {
        let all = self.words.get(name)?;
        let first = all.partition_point(|(at, _)| *at < from);
        all[first..].iter().copied().find(|(_, keyword)| wanted.contains(keyword))
    }

    fn last_of(&self, name: &str, before: usize, wanted: &[Keyword]) -> Option<(usize, Keyword)> {
        let all = self.words.get(name)?;
        let end = all.partition_point(|(at, _)| *at < before);
        all[..end].iter().rev().copied().find(|(_, keyword)| wanted.contains(keyword))
    }

    /// Goes behind the next of these O-words.
    fn skip(&mut self, code: &Code<'_>, name: &str, wanted: &[Keyword]) -> Result<Keyword, ReadError> {
        let Some((at, keyword)) = self.next_of(name, self.at, wanted) else {
            return Err(code.pointer.error(1, format!("the block of o{} has no end", name.to_lowercase())));
        };
        self.at = at + 1;
        Ok(keyword)
    }

    fn holds(&mut self, code: &mut Code<'_>) -> Result<bool, ReadError> {
        Ok(bracketed(code, &mut self.machine)? != 0.0)
    }

    fn o_line(&mut self, mut code: Code<'a>, name: &str, keyword: Keyword) -> Result<(), ReadError> {
        let own = self.at - 1;
        // A number alone is where M98 goes, which says so itself.
        if keyword != Keyword::Label {
            self.machine.listing.is_indirect(code.pointer.line, "a subprogram, a branch or a loop");
        }
        match keyword {
            Keyword::Label | Keyword::Do | Keyword::EndIf => {}
            Keyword::Sub => {
                self.skip(&code, name, &[Keyword::EndSub])?;
            }
            Keyword::Call => self.call(&mut code, name)?,
            Keyword::Return | Keyword::EndSub => {
                if code.peek() == Some(b'[') {
                    let value = bracketed(&mut code, &mut self.machine)?;
                    self.machine.variables.set(Name::Text("_VALUE".to_owned()), value);
                }
                self.leave(&code)?;
            }
            Keyword::If => self.branch(&mut code, name)?,
            // Reached at the end of a branch that was taken.
            Keyword::ElseIf | Keyword::Else => {
                self.skip(&code, name, &[Keyword::EndIf])?;
            }
            Keyword::While => {
                let holds = self.holds(&mut code)?;
                let before = self.last_of(name, own, &[Keyword::Do, Keyword::EndWhile]);
                match before {
                    Some((at, Keyword::Do)) if holds => self.at = at + 1,
                    Some((_, Keyword::Do)) => {}
                    _ => {
                        let first = self.at;
                        self.skip(&code, name, &[Keyword::EndWhile])?;
                        if holds {
                            self.at = first;
                        }
                    }
                }
            }
            Keyword::EndWhile => {
                let Some((at, _)) = self.last_of(name, own, &[Keyword::While]) else {
                    return Err(code.pointer.error(1, "expected a while before its end"));
                };
                self.at = at;
            }
            Keyword::Repeat => {
                let before = code.clone();
                let count = bracketed(&mut code, &mut self.machine)?;
                let wrong = || before.error("expected a whole number of times");
                let count = if count < 0.5 { 0 } else { index(count).ok_or_else(wrong)? };
                match count {
                    0 => {
                        self.skip(&code, name, &[Keyword::EndRepeat])?;
                    }
                    _ => {
                        let name = name.to_owned();
                        self.repeats.push(Repeat { name, first: self.at, left: count - 1 });
                    }
                }
            }
            Keyword::EndRepeat => {
                let outer = self.outer_repeats();
                let own = self.repeats[outer..].iter().rposition(|repeat| repeat.name == name);
                let Some(own) = own.map(|own| outer + own) else {
                    return Err(code.pointer.error(1, "expected a repeat before its end"));
                };
                if self.repeats[own].left > 0 {
                    self.repeats.truncate(own + 1);
                    self.repeats[own].left -= 1;
                    self.at = self.repeats[own].first;
                } else {
                    self.repeats.truncate(own);
                }
            }
            Keyword::Break | Keyword::Continue => self.quit(&code, name, keyword)?,
        }
        Ok(())
    }

    /// `if`, and what of it is run.
    fn branch(&mut self, code: &mut Code<'a>, name: &str) -> Result<(), ReadError> {
        let mut holds = self.holds(code)?;
        while !holds {
            match self.skip(code, name, &[Keyword::ElseIf, Keyword::Else, Keyword::EndIf])? {
                Keyword::ElseIf => {
                    let mut code = Code::new(self.pointer(self.at - 1));
                    o_word(&mut code);
                    holds = self.holds(&mut code)?;
                }
                _ => return Ok(()),
            }
        }
        Ok(())
    }

    /// How many loops are those of whoever has called the subprogram that is being run.
    fn outer_repeats(&self) -> usize {
        self.calls.last().map_or(0, |call| call.loops)
    }

    /// `break` and `continue`.
    fn quit(&mut self, code: &Code<'_>, name: &str, keyword: Keyword) -> Result<(), ReadError> {
        let own = self.at - 1;
        let begins = [Keyword::While, Keyword::Do, Keyword::Repeat];
        let begin = self.last_of(name, own, &begins).map_or(0, |(at, _)| at);
        self.skip(code, name, &[Keyword::EndWhile, Keyword::EndRepeat, Keyword::While])?;
        let goes_on = keyword == Keyword::Continue;
        if goes_on {
            // The end itself says whether it goes on.
            self.at -= 1;
        }
        // Loops within the block are left with it.
        let outer = self.outer_repeats();
        let is_within = |repeat: &Repeat| repeat.first > begin + usize::from(goes_on);
        if let Some(within) = self.repeats[outer..].iter().position(is_within) {
            self.repeats.truncate(outer + within);
        }
        Ok(())
    }

    /// `o1 call [2] [3]`.
    fn call(&mut self, code: &mut Code<'a>, name: &str) -> Result<(), ReadError> {
        let mut arguments = Vec::new();
        while code.peek() == Some(b'[') {
            arguments.push(value(code, &mut self.machine)?);
        }
        let subs = self.words.get(name).into_iter().flatten();
        let sub = subs.into_iter().find(|(_, keyword)| *keyword == Keyword::Sub);
        let Some(&(sub, _)) = sub else {
            let name = name.to_lowercase();
            return Err(code.pointer.error(1, format!("the subprogram o{name} is not in this file")));
        };
        if arguments.len() > ARGUMENTS {
            return Err(code.pointer.error(1, format!("expected at most {ARGUMENTS} arguments")));
        }
        self.enter(code.pointer, Call { back: self.at, first: sub + 1, again: 0, plain: false, loops: 0 })?;
        self.machine.variables.enter(&arguments);
        Ok(())
    }

    /// `o[#1] call`.
    fn computed_call(&mut self, code: &mut Code<'a>) -> Result<Option<()>, ReadError> {
        let mut ahead = code.clone();
        number_of_line(&mut ahead);
        if !ahead.take(b'O') || !matches!(ahead.peek(), Some(b'[' | b'#')) {
            return Ok(None);
        }
        let before = ahead.clone();
        let number = index(value(&mut ahead, &mut self.machine)?);
        let number = number.ok_or_else(|| before.error("expected the whole number of a subprogram"))?;
        if !ahead.take_text("CALL") {
            return Err(ahead.error("expected a call"));
        }
        self.o_line(ahead, &number.to_string(), Keyword::Call).map(Some)
    }

    fn enter(&mut self, pointer: Pointer<'_>, call: Call) -> Result<(), ReadError> {
        if self.calls.len() >= CALLS {
            let what = format!("more than {CALLS} subprograms call each other: this is not supported");
            return Err(pointer.error(1, what));
        }
        self.at = call.first;
        self.calls.push(Call { loops: self.repeats.len(), ..call });
        Ok(())
    }

    /// The end of a subprogram.
    fn leave(&mut self, code: &Code<'_>) -> Result<(), ReadError> {
        let Some(call) = self.calls.pop() else {
            return Err(code.pointer.error(1, "a subprogram ends that nothing has called"));
        };
        if !call.plain {
            self.machine.variables.leave();
        }
        self.repeats.truncate(call.loops);
        self.at = call.back;
        Ok(())
    }

    /// M98 P, L times; or as older controllers write it, P with four digits of the subprogram
    /// behind the times.
    fn m98(&mut self, pointer: Pointer<'a>, block: &Block) -> Result<(), ReadError> {
        let wrong =
            || pointer.error(1, "expected P, the number of a subprogram in this file, and L, how often");
        let number = block.get('P').and_then(|word| index(word.value)).ok_or_else(wrong)?;
        let times = block.get('L').map_or(Some(1), |word| index(word.value)).ok_or_else(wrong)?;
        let label = |number: u32| {
            let words = self.words.get(&number.to_string())?;
            let found = words.iter().find(|(_, keyword)| matches!(keyword, Keyword::Label | Keyword::Sub));
            found.map(|(at, _)| *at)
        };
        let (at, times) = match (label(number), number / 10_000) {
            (Some(at), _) => (at, times),
            (None, 0) => return Err(wrong()),
            (None, times) => (label(number % 10_000).ok_or_else(wrong)?, times),
        };
        self.machine.listing.is_indirect(pointer.line, "a subprogram, a branch or a loop");
        match times.checked_sub(1) {
            None => Ok(()),
            Some(again) => {
                let call = Call { back: self.at, first: at + 1, again, plain: true, loops: 0 };
                self.enter(pointer, call)
            }
        }
    }

    /// M99: back; in the program itself it begins anew, for ever, and one run is followed.
    fn m99(&mut self, pointer: Pointer<'a>) -> Result<(), ReadError> {
        match self.calls.last_mut() {
            Some(call) if call.again > 0 => {
                call.again -= 1;
                self.at = call.first;
                Ok(())
            }
            Some(_) => self.leave(&Code::new(pointer)),
            None => {
                let what = "M99 repeats the program for ever: it is read once";
                self.machine.listing.note(true, pointer.line, what);
                self.at = self.lines.len();
                Ok(())
            }
        }
    }

    /// The line of the first code behind the end of the program, or the second `%`, that belongs to
    /// no subprogram.
    fn behind_end(&self) -> Option<u32> {
        let mut at = self.at;
        while at < self.lines.len() {
            let pointer = self.pointer(at);
            let mut code = Code::new(pointer);
            if o_word(&mut code).is_some() {
                let returns =
                    |line: &&str| RETURNS.iter().any(|word| line.to_ascii_uppercase().contains(word));
                let Some(end) = self.lines[at..].iter().position(returns) else {
                    return Some(pointer.line);
                };
                at += end + 1;
                continue;
            }
            let words = code.take_while(|_| true);
            if !words.is_empty() && !words.starts_with('%') && !ENDS.contains(&words.as_str()) {
                return Some(pointer.line);
            }
            at += 1;
        }
        None
    }

    /// A text that ends within a subprogram.
    fn finished(&self) -> Result<(), ReadError> {
        let open = self.machine.listing.end.is_none() && !self.calls.is_empty();
        let Some(last) = self.lines.len().checked_sub(1).filter(|_| open) else { return Ok(()) };
        Err(self.pointer(last).error(1, "the text ends within a subprogram"))
    }
}

/// What may stand behind the end: it ends the program once more, or stops what stands already.
const ENDS: [&str; 8] = ["M0", "M2", "M02", "M5", "M05", "M9", "M09", "M30"];

/// Drops the number of a line.
fn number_of_line(code: &mut Code<'_>) {
    code.take(b'/');
    if code.take(b'N') {
        code.take_while(|byte| byte.is_ascii_digit() || byte == b'.');
    }
}

/// The O-word that begins a line, and what it says; of a name without a known keyword, that.
fn o_word(code: &mut Code<'_>) -> Option<(String, Option<Keyword>)> {
    number_of_line(code);
    if !code.take(b'O') && !code.take(b':') {
        return None;
    }
    let name = if code.take(b'<') {
        let name = code.take_while(|byte| byte != b'>');
        code.take(b'>').then(|| format!("<{name}>"))?
    } else {
        let digits = code.take_while(|byte| byte.is_ascii_digit());
        // `O0001` is called by `P1`.
        digits.parse::<u32>().ok()?.to_string()
    };
    let found = KEYWORDS.iter().find(|(text, _)| code.take_text(text));
    match found {
        Some((_, keyword)) => Some((name, Some(*keyword))),
        None => Some((name, code.peek().is_none().then_some(Keyword::Label))),
    }
}
