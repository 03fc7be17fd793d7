//! What controllers take, as tables: each program in each dialect is held against the rules that
//! the firmwares' own sources give.
//!
//! The tables and the tokens here share nothing with the writer or the reader: who looked into a
//! firmware writes down what it bears. A rule says where it is from: Grbl 1.1h (gcode.c,
//! protocol.c, serial.c), grblHAL, FluidNC, LinuxCNC 2.9 (interp_arc.cc, manual), Smoothieware
//! (GcodeDispatch.cpp, Robot.cpp), TinyG (gcode_parser.c, plan_arc.c), g2core, RepRapFirmware 3.5,
//! Marlin 2, Klipper (gcode.py), Mach (manual).

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use voromill::gcode::level::{HeightMap, Levelling, level};
use voromill::gcode::read::{Place, Way, read};
use voromill::gcode::{Dialect, Header, dialect};
use voromill::geometry::Nm;
use voromill::import;
use voromill::job::{self, Job, Options, Settings, Written};
use voromill::verify::Severity;

use crate::corpus::board_folders;
use crate::real_boards::selection;

/// What a controller takes.
struct Rules {
    name: &'static str,
    /// The G and M words that a program may contain, and what each does is what is meant.
    words: &'static [&'static str],
    /// Those that it must say before it moves.
    says: &'static [&'static str],
    comment: Comment,
    /// Only the first command of a line counts.
    one_a_line: bool,
    rapids: RapidFeed,
    arcs: Arcs,
    /// The decimals that a millimetre needs at least.
    decimals: usize,
    /// How three seconds are written.
    dwell: &'static str,
    /// What turns the spindle on.
    spindle: &'static str,
    change: Change,
    /// What stands last, after the spindle is off.
    end: &'static [&'static str],
    /// What says how high a tool is that has touched a plate; none where no program can.
    touched: Option<&'static str>,
}

#[derive(Clone, Copy, PartialEq)]
enum Comment {
    Parentheses,
    Semicolon,
}

#[derive(Clone, Copy, PartialEq)]
enum RapidFeed {
    Never,
    First,
    Always,
}

#[derive(Clone, Copy, PartialEq)]
enum Arcs {
    None,
    /// The radii may differ by 2 µm.
    Near,
    /// And by a thousandth.
    NearAndRound,
}

#[derive(Clone, Copy, PartialEq)]
enum Change {
    /// A file for each tool: nothing makes it wait.
    Files,
    /// `T1 M6` waits.
    M6,
}

const MOVES: [&str; 4] = ["G0", "G1", "G2", "G3"];

const TABLE: &[Rules] = &[
    Rules {
        name: "grbl",
        words: &["G0", "G1", "G2", "G3", "G4", "G17", "G21", "G90", "G94", "M2", "M3", "M5"],
        says: &["G17", "G21", "G90", "G94"],
        comment: Comment::Parentheses,
        one_a_line: false,
        rapids: RapidFeed::Never,
        arcs: Arcs::Near,
        decimals: 4,
        dwell: "G4 P3",
        spindle: "M3",
        change: Change::Files,
        end: &["M2"],
        touched: Some("G92 Z1.6"),
    },
    Rules {
        name: "grblhal",
        words: &["G0", "G1", "G2", "G3", "G4", "G17", "G21", "G90", "G91.1", "G94", "M2", "M3", "M5", "M6"],
        says: &["G17", "G21", "G90", "G94"],
        comment: Comment::Parentheses,
        one_a_line: false,
        rapids: RapidFeed::Never,
        arcs: Arcs::Near,
        decimals: 4,
        dwell: "G4 P3",
        spindle: "M3",
        change: Change::M6,
        end: &["M2"],
        touched: Some("G92 Z1.6"),
    },
    Rules {
        name: "fluidnc",
        words: &["G0", "G1", "G2", "G3", "G4", "G17", "G21", "G90", "G94", "M2", "M3", "M5"],
        says: &["G17", "G21", "G90", "G94"],
        comment: Comment::Parentheses,
        one_a_line: false,
        rapids: RapidFeed::Never,
        arcs: Arcs::Near,
        decimals: 4,
        dwell: "G4 P3",
        spindle: "M3",
        change: Change::Files,
        end: &["M2"],
        touched: Some("G92 Z1.6"),
    },
    Rules {
        name: "linuxcnc",
        words: &[
            "G0", "G1", "G2", "G3", "G4", "G17", "G21", "G40", "G49", "G64", "G80", "G90", "G91.1", "G94",
            "M2", "M3", "M5", "M6",
        ],
        says: &["G17", "G21", "G40", "G49", "G80", "G90", "G91.1", "G94", "G64"],
        comment: Comment::Parentheses,
        one_a_line: false,
        rapids: RapidFeed::Never,
        arcs: Arcs::Near,
        decimals: 4,
        dwell: "G4 P3",
        spindle: "M3",
        change: Change::M6,
        end: &["M2"],
        touched: Some("G10 L20 P0 Z1.6"),
    },
    Rules {
        name: "mach3",
        words: &[
            "G0", "G1", "G2", "G3", "G4", "G17", "G21", "G40", "G49", "G61", "G80", "G90", "G91.1", "G94",
            "M3", "M5", "M6", "M30",
        ],
        says: &["G17", "G21", "G40", "G49", "G61", "G80", "G90", "G91.1", "G94"],
        comment: Comment::Parentheses,
        one_a_line: false,
        rapids: RapidFeed::Never,
        arcs: Arcs::Near,
        decimals: 4,
        dwell: "G4 P3",
        spindle: "M3",
        change: Change::M6,
        end: &["M30"],
        touched: None,
    },
    Rules {
        name: "mach4",
        words: &[
            "G0", "G1", "G2", "G3", "G4", "G17", "G21", "G40", "G49", "G61", "G80", "G90", "G91.1", "G94",
            "M3", "M5", "M6", "M30",
        ],
        says: &["G17", "G21", "G40", "G49", "G61", "G80", "G90", "G91.1", "G94"],
        comment: Comment::Parentheses,
        one_a_line: false,
        rapids: RapidFeed::Never,
        arcs: Arcs::Near,
        decimals: 4,
        dwell: "G4 P3",
        spindle: "M3",
        change: Change::M6,
        end: &["M30"],
        touched: None,
    },
    Rules {
        name: "marlin",
        // G94 is unknown to it, and per minute is all that it knows.
        words: &["G0", "G1", "G4", "G17", "G21", "G90", "M3", "M5", "M400"],
        says: &["G17", "G21", "G90"],
        comment: Comment::Semicolon,
        one_a_line: true,
        rapids: RapidFeed::Always,
        arcs: Arcs::None,
        decimals: 4,
        dwell: "G4 S3",
        spindle: "M3",
        change: Change::Files,
        end: &["M400"],
        touched: None,
    },
    Rules {
        name: "reprapfirmware",
        words: &["G0", "G1", "G2", "G3", "G4", "G17", "G21", "G90", "G94", "M2", "M3", "M5"],
        says: &["G17", "G21", "G90", "G94"],
        comment: Comment::Semicolon,
        one_a_line: false,
        rapids: RapidFeed::Always,
        arcs: Arcs::Near,
        decimals: 4,
        dwell: "G4 S3",
        spindle: "M3 P0",
        change: Change::Files,
        end: &["M2"],
        touched: None,
    },
    Rules {
        name: "klipper",
        words: &["G0", "G1", "G4", "G21", "G90", "M3", "M5", "M400"],
        says: &["G21", "G90"],
        comment: Comment::Semicolon,
        one_a_line: true,
        rapids: RapidFeed::Always,
        arcs: Arcs::None,
        decimals: 4,
        dwell: "G4 P3000",
        spindle: "M3",
        change: Change::Files,
        end: &["M400"],
        touched: None,
    },
    Rules {
        name: "smoothieware",
        // G91.1 is G91 to it. Its arcs are chords of a setting.
        words: &["G0", "G1", "G4", "G17", "G21", "G90", "G94", "M2", "M3", "M5"],
        says: &["G17", "G21", "G90", "G94"],
        comment: Comment::Semicolon,
        one_a_line: false,
        rapids: RapidFeed::First,
        arcs: Arcs::None,
        decimals: 4,
        dwell: "G4 S3",
        spindle: "M3",
        change: Change::Files,
        end: &["M2"],
        touched: None,
    },
    Rules {
        name: "tinyg",
        words: &[
            "G0", "G1", "G2", "G3", "G4", "G17", "G21", "G40", "G64", "G80", "G90", "G91.1", "G94", "M2",
            "M3", "M5",
        ],
        says: &["G17", "G21", "G90", "G94", "G64"],
        comment: Comment::Parentheses,
        one_a_line: false,
        rapids: RapidFeed::Never,
        arcs: Arcs::NearAndRound,
        decimals: 5,
        dwell: "G4 P3",
        spindle: "M3",
        change: Change::Files,
        end: &["M2"],
        touched: None,
    },
    Rules {
        name: "g2core",
        words: &[
            "G0", "G1", "G2", "G3", "G4", "G17", "G21", "G40", "G64", "G80", "G90", "G91.1", "G94", "M2",
            "M3", "M5",
        ],
        says: &["G17", "G21", "G90", "G94", "G64"],
        comment: Comment::Parentheses,
        one_a_line: false,
        rapids: RapidFeed::Never,
        arcs: Arcs::Near,
        decimals: 4,
        dwell: "G4 P3",
        spindle: "M3",
        change: Change::Files,
        end: &["M2"],
        touched: None,
    },
];

/// A program as a controller gets it.
struct Case {
    what: String,
    rules: &'static Rules,
    lines: Vec<Line>,
}

/// A line: its text, its words, and its comment.
struct Line {
    number: usize,
    text: String,
    words: Vec<(char, String)>,
    comment: Option<String>,
}

impl Line {
    fn new(number: usize, text: &str) -> Self {
        let mut words: Vec<(char, String)> = Vec::new();
        let mut comment = None;
        let mut rest = text.chars();
        while let Some(c) = rest.next() {
            match c {
                '(' => comment = Some(rest.by_ref().take_while(|&c| c != ')').collect()),
                ';' => comment = Some(rest.by_ref().collect()),
                ' ' => {}
                '0'..='9' | '.' | '-' | '+' if !words.is_empty() => words.last_mut().expect("one").1.push(c),
                other => words.push((other, String::new())),
            }
        }
        Self { number, text: text.to_owned(), words, comment }
    }

    /// The G and M words, such as `G91.1`.
    fn codes(&self) -> impl Iterator<Item = String> + '_ {
        self.words
            .iter()
            .filter(|(letter, _)| matches!(letter, 'G' | 'M'))
            .map(|(letter, n)| format!("{letter}{n}"))
    }

    fn has(&self, code: &str) -> bool {
        self.codes().any(|other| other == code)
    }

    /// The number after a letter, in nanometres (or a millionth of what it counts).
    fn value(&self, letter: char) -> Option<i64> {
        self.words.iter().find(|(other, _)| *other == letter).map(|(_, number)| millionths(number))
    }

    /// The motion that it carries.
    fn motion(&self) -> Option<String> {
        self.codes().find(|code| MOVES.contains(&code.as_str()))
    }

    fn is_bare(&self) -> bool {
        self.words.is_empty()
    }
}

/// A decimal number in millionths.
fn millionths(text: &str) -> i64 {
    let (whole, part) = text.split_once('.').unwrap_or((text, ""));
    let negative = whole.starts_with('-');
    let digits: String = whole.trim_start_matches(['-', '+']).chars().chain(part.chars()).collect();
    let scale = 10_i64.pow(6 - u32::try_from(part.len()).expect("a few digits"));
    let value = digits.parse::<i64>().unwrap_or_else(|_| panic!("`{text}` is not a number")) * scale;
    if negative { -value } else { value }
}

/// A motion: its line, where it begins and where it ends.
type Step<'a> = (&'a Line, [Option<i64>; 3], [Option<i64>; 3]);

/// Where a program is, line by line: x, y and z where they are known.
fn followed(case: &Case) -> Vec<Step<'_>> {
    let mut at = [None; 3];
    let mut steps = Vec::new();
    for line in &case.lines {
        if line.has("M0") || line.has("M6") || line.has("M600") {
            // Whoever changes a tool may have moved the machine.
            at = [None; 3];
        }
        if line.motion().is_some() {
            let before = at;
            for (place, letter) in at.iter_mut().zip(['X', 'Y', 'Z']) {
                *place = line.value(letter).or(*place);
            }
            steps.push((line, before, at));
        }
    }
    steps
}

/// What is wrong with a program, in the words of one rule.
type Rule = fn(&Case) -> Vec<String>;

fn wrong(line: &Line, what: &str) -> String {
    format!("line {}: {what}: {}", line.number, line.text)
}

/// Lines for which `is_wrong`.
fn lines(case: &Case, what: &str, is_wrong: impl Fn(&Line) -> bool) -> Vec<String> {
    case.lines.iter().filter(|line| is_wrong(line)).map(|line| wrong(line, what)).collect()
}

/// Grbl's gcode.c: words it knows, one of each modal group, no value twice, none unused.
fn grbl_accepts(case: &Case) -> Vec<String> {
    let groups: &[&[&str]] =
        &[&["G0", "G1", "G2", "G3"], &["G17"], &["G21"], &["G90"], &["G94"], &["M3", "M5"], &["M2", "M0"]];
    lines(case, "Grbl refuses it", |line| {
        let codes: Vec<String> = line.codes().collect();
        let twice =
            groups.iter().any(|group| codes.iter().filter(|code| group.contains(&code.as_str())).count() > 1);
        let letters: Vec<char> =
            line.words.iter().map(|word| word.0).filter(|c| !matches!(c, 'G' | 'M')).collect();
        let repeated = letters.iter().collect::<BTreeSet<_>>().len() < letters.len();
        let arc = line.has("G2") || line.has("G3");
        let used = |letter: &char| match letter {
            'X' | 'Y' | 'Z' => line.motion().is_some(),
            'I' | 'J' => arc,
            'P' => line.has("G4"),
            'S' => line.has("M3"),
            'F' => line.motion().is_some_and(|code| code != "G0"),
            _ => false,
        };
        let valued = line.words.iter().all(|(_, number)| !number.is_empty());
        let plane = !arc || line.value('X').is_some() || line.value('Y').is_some();
        case.rules.name == "grbl" && (twice || repeated || !valued || !plane || !letters.iter().all(used))
    })
}

fn short_lines(case: &Case) -> Vec<String> {
    lines(case, "too long", |line| {
        let code: usize = line.words.iter().map(|(_, number)| 1 + number.len()).sum();
        code > 79 || line.text.len() > 94
    })
}

fn plain_text(case: &Case) -> Vec<String> {
    lines(case, "a byte that acts or ends a comment", |line| {
        let comment = line.comment.as_deref().unwrap_or_default();
        !line.text.bytes().all(|byte| (0x20..0x7f).contains(&byte))
            || comment.contains(['?', '!', '~', '%', '(', ')', ';', '*', '#', '{', '}'])
    })
}

fn comments_alone(case: &Case) -> Vec<String> {
    lines(case, "a comment beside code, or of another form", |line| {
        let form = match case.rules.comment {
            Comment::Parentheses => line.text.starts_with('(') && line.text.ends_with(')'),
            Comment::Semicolon => line.text.starts_with(';'),
        };
        line.comment.is_some() && (!form || !line.is_bare())
    })
}

fn no_other_letters(case: &Case) -> Vec<String> {
    lines(case, "a letter that no program of ours needs", |line| {
        line.words.iter().any(|(letter, _)| !"GMXYZIJFSPT".contains(*letter))
    })
}

fn words_it_knows(case: &Case) -> Vec<String> {
    lines(case, "a word that this controller does not know, or that means something else", |line| {
        line.codes().any(|code| !case.rules.words.contains(&code.as_str()))
    })
}

fn says_how_it_is_meant(case: &Case) -> Vec<String> {
    let before = case.lines.iter().take_while(|line| line.motion().is_none());
    let said: BTreeSet<String> = before.flat_map(Line::codes).collect();
    let missing = case.rules.says.iter().filter(|word| !said.contains(**word));
    let mut wrong: Vec<String> = missing.map(|word| format!("{word} is not said before it moves")).collect();
    if case.rules.one_a_line {
        wrong.extend(lines(case, "only the first command counts", |line| line.codes().count() > 1));
    }
    wrong
}

fn feeds_are_said(case: &Case) -> Vec<String> {
    let mut wrongs = Vec::new();
    let mut fed = false;
    for line in &case.lines {
        if line.has("M6") || line.has("M0") || line.has("G94") || line.has("G21") {
            fed = false;
        }
        let feed = line.value('F');
        if feed.is_some_and(|feed| feed <= 0) {
            wrongs.push(wrong(line, "no feed"));
        }
        match line.motion().as_deref() {
            Some("G0") if case.rules.rapids == RapidFeed::Always => fed = false,
            Some("G0") | None => {}
            Some(_) => {
                fed |= feed.is_some();
                if !fed {
                    wrongs.push(wrong(line, "nothing says how fast"));
                }
            }
        }
    }
    wrongs
}

fn rapids_say_their_speed(case: &Case) -> Vec<String> {
    let rapids = case.lines.iter().filter(|line| line.has("G0"));
    let says = |first: bool| match case.rules.rapids {
        RapidFeed::Never => false,
        RapidFeed::First => first,
        RapidFeed::Always => true,
    };
    let of = |(index, line): (usize, &Line)| {
        (line.value('F').is_some() != says(index == 0)).then(|| wrong(line, "a rapid's F"))
    };
    rapids.enumerate().filter_map(of).collect()
}

fn motions_say_which(case: &Case) -> Vec<String> {
    lines(case, "coordinates without G0 to G3", |line| {
        line.motion().is_none()
            && ['X', 'Y', 'Z', 'I', 'J'].iter().any(|&letter| line.value(letter).is_some())
    })
}

fn numbers_are_plain(case: &Case) -> Vec<String> {
    lines(case, "a number that a controller may misread", |line| {
        line.words.iter().any(|(_, number)| {
            let digits = number.chars().filter(char::is_ascii_digit).count();
            let zero = number.starts_with('-') && number.chars().all(|c| "-0.".contains(c));
            digits == 0 || digits > 8 || zero || number.starts_with('+') || number.starts_with('.')
        })
    })
}

fn moves_go_somewhere(case: &Case) -> Vec<String> {
    let stays = |(line, before, after): Step<'_>| (before == after).then(|| wrong(line, "it goes nowhere"));
    followed(case).into_iter().filter_map(stays).collect()
}

fn arcs_are_arcs(case: &Case) -> Vec<String> {
    let mut wrongs = Vec::new();
    for (line, before, after) in followed(case) {
        let arc = line.has("G2") || line.has("G3");
        if line.value('R').is_some() {
            wrongs.push(wrong(line, "a radius"));
        }
        if arc && case.rules.arcs == Arcs::None {
            wrongs.push(wrong(line, "an arc"));
        }
        if arc && (line.value('X').is_none() || line.value('Y').is_none()) {
            wrongs.push(wrong(line, "an arc without its end"));
        }
        if arc && before[..2] == after[..2] {
            wrongs.push(wrong(line, "a full circle"));
        }
    }
    wrongs
}

/// From the numbers as they stand.
#[expect(clippy::cast_precision_loss, reason = "nanometres of a board")]
fn arcs_are_round(case: &Case) -> Vec<String> {
    let mut wrongs = Vec::new();
    for (line, before, after) in followed(case) {
        let (Some(i), Some(j)) = (line.value('I'), line.value('J')) else { continue };
        let ([Some(x), Some(y), _], [Some(to_x), Some(to_y), _]) = (before, after) else {
            wrongs.push(wrong(line, "an arc from nowhere"));
            continue;
        };
        let radius = ((i * i + j * j) as f64).sqrt();
        let (dx, dy) = (to_x - x - i, to_y - y - j);
        let off = (((dx * dx + dy * dy) as f64).sqrt() - radius).abs();
        let least = if case.rules.arcs == Arcs::NearAndRound { radius / 1000.0 } else { f64::INFINITY };
        if radius < 1.0 || off > least.min(2_000.0) {
            wrongs.push(wrong(line, &format!("radii differ by {off} nm of {radius}")));
        }
    }
    wrongs
}

fn no_drilling_cycles(case: &Case) -> Vec<String> {
    lines(case, "a canned cycle", |line| {
        line.codes().any(|code| ["G73", "G81", "G82", "G83", "G85", "G86", "G89"].contains(&code.as_str()))
    })
}

fn dwells_are_as_long_as_meant(case: &Case) -> Vec<String> {
    lines(case, "three seconds are written otherwise", |line| line.has("G4") && line.text != case.rules.dwell)
}

fn spindle_is_up_to_speed(case: &Case) -> Vec<String> {
    let mut wrongs = Vec::new();
    let mut ready = false;
    let code: Vec<&Line> = case.lines.iter().filter(|line| !line.is_bare()).collect();
    let steps = followed(case);
    for (index, line) in code.iter().enumerate() {
        if line.has("M3") {
            let alone = line.text.starts_with(&format!("{} S", case.rules.spindle));
            let speed = line.value('S').is_some_and(|speed| speed > 0);
            let waits = code.get(index + 1).is_some_and(|next| next.has("G4"));
            if !alone || !speed || !waits {
                wrongs.push(wrong(line, "the spindle is not given time"));
            }
            ready = true;
        }
        if line.has("M5") || line.has("M6") || line.has("M0") {
            ready = false;
        }
        let low = steps.iter().find(|step| std::ptr::eq(step.0, *line)).and_then(|step| step.2[2]);
        if !ready && low.is_some_and(|z| z < 1_000_000) {
            wrongs.push(wrong(line, "low with the spindle off"));
        }
    }
    wrongs
}

fn states_its_conditions(case: &Case) -> Vec<String> {
    let comments: Vec<&str> = case.lines.iter().filter_map(|line| line.comment.as_deref()).collect();
    let says = |what: &str| comments.iter().any(|comment| comment.contains(what));
    let wanted = match case.rules.name {
        "grbl" | "grblhal" => "$32 must be 0",
        "mach3" | "mach4" => "G4 must count seconds",
        "klipper" => "macros",
        _ => "",
    };
    if says(wanted) { Vec::new() } else { vec![format!("its header does not say `{wanted}`")] }
}

fn tools_are_changed_where_it_waits(case: &Case) -> Vec<String> {
    let changes = case.lines.iter().filter(|line| line.has("M6")).count();
    let mut wrongs = lines(case, "it does not wait here", |line| {
        let waits = line.has("M0") || line.has("M1") || line.has("M600");
        waits || (case.rules.change == Change::Files && (line.has("M6") || line.value('T').is_some()))
    });
    if case.rules.change == Change::M6 && changes == 0 {
        wrongs.push("it asks for no tool".to_owned());
    }
    if case.rules.change == Change::Files && case.lines.iter().filter(|line| line.has("M3")).count() > 1 {
        wrongs.push("two tools in one file".to_owned());
    }
    wrongs.extend(lines(case, "M6 without a tool", |line| line.has("M6") && line.value('T').is_none()));
    // Whoever fitted the tool may have left it on the copper.
    let steps: Vec<&Line> =
        case.lines.iter().filter(|line| ["M6", "M0", "G0"].iter().any(|code| line.has(code))).collect();
    let sideways = steps
        .windows(2)
        .filter(|pair| !pair[0].has("G0") && (pair[1].value('Z').is_none() || pair[1].value('X').is_some()));
    wrongs.extend(sideways.map(|pair| format!("`{}` after a change of tools", pair[1].text)));
    wrongs
}

fn ends_as_it_must(case: &Case) -> Vec<String> {
    let code: Vec<&str> =
        case.lines.iter().filter(|line| !line.is_bare()).map(|line| line.text.as_str()).collect();
    let wanted: Vec<&str> = ["M5"].iter().chain(case.rules.end).copied().collect();
    let ends = code.ends_with(&wanted);
    let last = case.lines.last().is_some_and(|line| line.text == *wanted.last().expect("an end"));
    let up =
        followed(case).last().is_some_and(|(line, _, after)| line.has("G0") && after[2] >= Some(20_000_000));
    if ends && last && up {
        Vec::new()
    } else {
        vec![format!("ends with {:?}", &code[code.len().saturating_sub(4)..])]
    }
}

fn goes_nowhere_unsaid(case: &Case) -> Vec<String> {
    let codes = ["G28", "G28.1", "G30", "G30.1", "G10", "G92", "G53"];
    lines(case, "a place that the program does not give", |line| {
        line.codes().any(|code| codes.contains(&code.as_str()))
    })
}

fn goes_straight_down_and_up(case: &Case) -> Vec<String> {
    let mut wrongs = Vec::new();
    let steps = followed(case);
    if let Some((line, _, after)) = steps.first()
        && (after[0].is_some() || after[1].is_some() || after[2] < Some(1_000_000))
    {
        wrongs.push(wrong(line, "it does not rise first"));
    }
    for (line, before, after) in steps {
        let sideways = line.value('X').is_some() || line.value('Y').is_some();
        let crosses = before[2] > Some(0) && after[2] < Some(0) || before[2] < Some(0) && after[2] > Some(0);
        if sideways && (crosses || (line.has("G0") && line.value('Z').is_some())) {
            wrongs.push(wrong(line, "a slanting way through the surface"));
        }
    }
    wrongs
}

/// The rules of a single program, by the number they have in our notes on the firmwares.
const RULES: &[(u8, Rule)] = &[
    (1, grbl_accepts),
    (2, short_lines),
    (3, plain_text),
    (4, comments_alone),
    (5, no_other_letters),
    (5, words_it_knows),
    (6, says_how_it_is_meant),
    (7, feeds_are_said),
    (8, rapids_say_their_speed),
    (9, motions_say_which),
    (10, numbers_are_plain),
    (11, moves_go_somewhere),
    (12, arcs_are_arcs),
    (13, arcs_are_round),
    (15, no_drilling_cycles),
    (16, dwells_are_as_long_as_meant),
    (17, spindle_is_up_to_speed),
    (18, states_its_conditions),
    (19, tools_are_changed_where_it_waits),
    (21, ends_as_it_must),
    (22, goes_nowhere_unsaid),
    (23, goes_straight_down_and_up),
];

fn mill(folder: &Path, dialect: &str, more: &str) -> (Job, Settings) {
    let loaded = import::load(&[folder.to_path_buf()], &selection(folder)).expect("a board");
    let settings = settings(dialect, more);
    (job::mill(loaded, &settings).expect("a job"), settings)
}

fn settings(dialect: &str, more: &str) -> Settings {
    let options = Options::from_toml("voromill.toml", &format!("dialect = \"{dialect}\"\n{more}"));
    Settings::resolve(options.expect("settings")).expect("settings that make sense")
}

/// A board's programs as every controller gets them; it is planned once for those that change tools
/// and once for those with a file for each.
fn cases(folder: &Path, more: &str) -> Vec<Case> {
    let jobs = [Change::Files, Change::M6].map(|change| {
        let of = TABLE.iter().find(|rules| rules.change == change).expect("such a dialect");
        (change, mill(folder, of.name, more).0)
    });
    let written = |rules: &'static Rules| {
        let settings = settings(rules.name, more);
        let (_, job) = jobs.iter().find(|(change, _)| *change == rules.change).expect("planned");
        let case = move |program: &Written| {
            let place = (program.part, program.side, program.tag.clone());
            let text = Written::new(place, program.program.clone(), &Header::default(), None, &settings).text;
            let lines = text.lines().zip(1..).map(|(text, number)| Line::new(number, text)).collect();
            Case { what: format!("{} {} in {}", job.board.name, program.tag, rules.name), rules, lines }
        };
        job.programs.iter().map(case).collect::<Vec<_>>()
    };
    TABLE.iter().flat_map(written).collect()
}

fn fixture(board: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/boards").join(board)
}

/// All kinds of moves: V-bits and end mills, bored holes and slots, ramps, pins, several tools.
const EVERYTHING: &str = "tool = [\"endmill:0.6mm\", \"vbit:0.1mm:20deg\"]\ncutout-ramp = \"4deg\"\ndrill-bore = true\n\
                          alignment-holes = \"3mm\"\ndrills = \"0.6mm,0.8mm\"\nstrategy-for = \"GND*=outline\"\n";

static FIXTURES: LazyLock<Vec<Case>> = LazyLock::new(|| {
    let mut all = cases(&fixture("blinker"), "");
    all.extend(cases(&fixture("regulator"), EVERYTHING));
    all
});

/// Holds every program of the fixture boards, in every dialect, against the rules of this number.
fn holds(number: u8) {
    let rules: Vec<Rule> = RULES.iter().filter(|rule| rule.0 == number).map(|rule| rule.1).collect();
    assert!(!rules.is_empty(), "there is a rule {number}");
    for case in &*FIXTURES {
        for rule in &rules {
            let wrong = rule(case);
            assert!(wrong.is_empty(), "{}: {:#?}", case.what, &wrong[..wrong.len().min(5)]);
        }
    }
}

#[test]
fn every_dialect_has_its_table() {
    let names: Vec<&str> = TABLE.iter().map(|rules| rules.name).collect();
    let written: Vec<&str> = dialect::ALL.iter().map(|dialect| dialect.name.as_ref()).collect();
    assert_eq!(names, written, "in the same order");
}

#[test]
fn names_of_dialects_are_known_in_any_case() {
    for (name, known) in [
        ("grblHAL", "grblhal"),
        ("FluidNC", "fluidnc"),
        ("LinuxCNC", "linuxcnc"),
        ("RepRapFirmware", "reprapfirmware"),
    ] {
        assert_eq!(Dialect::by_name(name).expect(name).name, known, "{name}");
        assert_eq!(settings(name, "").dialect.name, known, "{name} in the settings");
    }
}

#[test]
fn rule_1_grbl_accepts_every_line() {
    holds(1);
}

#[test]
fn rule_2_lines_fit_the_buffers() {
    holds(2);
}

#[test]
fn rule_3_a_program_is_plain_ascii_whatever_its_board_is_called() {
    holds(3);
    let header = Header {
        generator: "Ä — ?!~%#*{}();\u{84}".to_owned(),
        settings: vec![("strategy-for".to_owned(), "NET*=outline größe?".to_owned())],
        ..Header::default()
    };
    let case = &FIXTURES[0];
    let (job, _) = mill(&fixture("blinker"), "grbl", "");
    for dialect in dialect::ALL {
        let rules = TABLE.iter().find(|rules| rules.name == dialect.name).expect("a table");
        let text = voromill::gcode::write(&job.programs[0].program, dialect, &header);
        let lines = text.lines().zip(1..).map(|(text, number)| Line::new(number, text)).collect();
        let named = Case { what: case.what.clone(), rules, lines };
        assert_eq!(plain_text(&named), Vec::<String>::new(), "{}", dialect.name);
        assert_eq!(comments_alone(&named), Vec::<String>::new(), "{}", dialect.name);
    }
}

#[test]
fn rule_4_comments_stand_alone_in_the_form_that_is_read() {
    holds(4);
}

#[test]
fn rule_5_no_word_is_unknown_or_means_something_else() {
    holds(5);
}

#[test]
fn rule_6_programs_say_what_their_numbers_mean() {
    holds(6);
}

#[test]
fn rule_7_feeds_are_said_before_they_are_needed() {
    holds(7);
}

#[test]
fn rule_8_rapids_say_their_speed_where_feeds_are_shared() {
    holds(8);
}

#[test]
fn rule_9_every_motion_says_which_it_is() {
    holds(9);
}

#[test]
fn rule_10_numbers_are_fine_and_plain() {
    holds(10);
    for rules in TABLE {
        let fine = FIXTURES.iter().filter(|case| case.rules.name == rules.name).flat_map(|case| &case.lines);
        let decimals =
            fine.flat_map(|line| &line.words).filter_map(|(_, number)| Some(number.split_once('.')?.1.len()));
        assert!(decimals.max() >= Some(rules.decimals), "{} loses digits", rules.name);
    }
}

#[test]
fn rule_11_no_move_goes_nowhere() {
    holds(11);
}

#[test]
fn rule_12_and_14_no_full_circle_is_one_arc_and_printers_get_lines() {
    holds(12);
    let arcs = |name: &str| {
        let lines = FIXTURES.iter().filter(|case| case.rules.name == name).flat_map(|case| &case.lines);
        lines.filter(|line| line.has("G2") || line.has("G3")).count()
    };
    assert!(arcs("grbl") > 100, "there are arcs to be judged");
}

#[test]
fn rule_13_arcs_are_round_as_they_are_written() {
    holds(13);
}

#[test]
fn rule_15_nothing_is_drilled_in_cycles() {
    holds(15);
}

#[test]
fn rule_16_dwells_are_as_long_as_they_are_meant() {
    holds(16);
}

#[test]
fn rule_17_the_spindle_turns_before_anything_goes_down() {
    holds(17);
}

#[test]
fn rule_18_programs_state_what_must_be_set() {
    holds(18);
}

#[test]
fn rule_19_and_20_tools_are_changed_only_where_the_machine_waits() {
    holds(19);
    for rules in TABLE.iter().filter(|rules| !rules.words.contains(&"M6")) {
        let refused = Options::from_toml("f", &format!("dialect = \"{}\"\ntool-change = \"m6\"", rules.name));
        let refused = Settings::resolve(refused.expect("settings")).expect_err(rules.name).to_string();
        assert!(refused.contains("does not wait at M6"), "{refused}");
    }
    let waits = ["grbl", "grblhal", "linuxcnc", "mach3", "mach4", "smoothieware"];
    for rules in TABLE {
        let asked =
            Options::from_toml("f", &format!("dialect = \"{}\"\ntool-change = \"pause\"", rules.name));
        let taken = Settings::resolve(asked.expect("settings"));
        assert_eq!(taken.is_ok(), waits.contains(&rules.name), "{} at M0", rules.name);
    }
    // M0 is ignored there: it would go on with the drill that is in.
    let (job, _) = mill(&fixture("regulator"), "smoothieware", "tool-change = \"pause\"");
    let drilling = job.programs.iter().find(|program| program.tag == "drill").expect("a program that drills");
    assert!(drilling.text.contains("\nM600\n") && !drilling.text.contains("M0\n"), "{}", drilling.text);
}

#[test]
fn rule_21_programs_end_lifted_with_the_spindle_off_and_delete_nothing() {
    holds(21);
}

#[test]
fn rule_22_nothing_goes_where_the_program_does_not_say() {
    holds(22);
}

#[test]
fn rule_23_the_tool_goes_straight_down_and_up() {
    holds(23);
}

/// A text without what stands between the marks of a touch, and the lines of each touch.
fn touches(text: &str) -> (String, Vec<Vec<&str>>) {
    let (mut rest, mut touches, mut within) = (String::new(), Vec::new(), false);
    for line in text.lines() {
        match line {
            "(touch-off begins)" => {
                within = true;
                touches.push(Vec::new());
            }
            "(touch-off ends)" => within = false,
            line if within => touches.last_mut().expect("begun").push(line),
            line => rest.extend([line, "\n"]),
        }
    }
    (rest, touches)
}

/// The way of a program at or below the surface, in order.
fn cuts(text: &str) -> Vec<(Way, Place, Place)> {
    let listing = read(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let low = |place: Place| place.z.is_some_and(|z| z < Nm::ZERO);
    let motions = listing.motions.iter().filter(|motion| low(motion.from) || low(motion.to));
    motions.map(|motion| (motion.way, motion.from, motion.to)).collect()
}

#[test]
fn each_tool_touches_a_plate_before_it_turns_where_a_program_can_say_how_high_it_is_then() {
    const PLATE: &str = "tool-probe = \"-10mm,5mm,1.6mm\"";
    for rules in TABLE {
        let Some(touched) = rules.touched else {
            let options = Options::from_toml("f", &format!("dialect = \"{}\"\n{PLATE}", rules.name));
            let refused = Settings::resolve(options.expect("settings")).expect_err(rules.name).to_string();
            assert!(refused.contains("cannot touch off a tool within a program: "), "{refused}");
            continue;
        };
        let (job, settings) = mill(&fixture("blinker"), rules.name, PLATE);
        let found = job.verify(&settings).expect("it can be judged");
        assert!(found.passes(Severity::Warning), "{}: {:?}", rules.name, found.findings);
        for program in &job.programs {
            let what = format!("{} in {}", program.tag, rules.name);
            let (rest, touches) = touches(&program.text);
            assert_eq!(touches.len(), rest.matches("\nM3 S").count(), "{what}: once for each tool");
            for touch in touches {
                let code: Vec<&str> = touch.into_iter().filter(|line| !line.starts_with('(')).collect();
                let down = ["G0 X-10 Y5", "G91", "G38.2 Z-28.4 F100", "G0 Z1", "G38.2 Z-2 F20", "G90"];
                assert_eq!(code, [&down[..], &[touched, "G0 Z20"]].concat(), "{what}");
            }
            // Where it begins the spindle is off, and what follows turns it on.
            let at = |text: &str| program.text.find(text).expect("it is there");
            let before = &program.text[..at("(touch-off begins)")];
            assert!(!before.contains("\nM3"), "{what}: the spindle is off");
            let lines = rest.lines().zip(1..).map(|(text, number)| Line::new(number, text)).collect();
            let case = Case { what: what.clone(), rules, lines };
            for (number, rule) in RULES {
                assert_eq!(rule(&case), Vec::<String>::new(), "{what}, rule {number}, beside the touch");
            }
            assert_eq!(cuts(&program.text), cuts(&rest), "{what}: it is read back, and cuts where it would");
            let map =
                HeightMap::through(&[[0.0, 0.0, 1e4], [2e8, 0.0, 1e4], [0.0, 2e8, 1e4], [2e8, 2e8, 1e4]]);
            let levelling = Levelling { margin: Nm::from_mm(200), ..Levelling::default() };
            let bent = level(&program.text, &map.expect("a plane"), &levelling).expect("it can be bent").text;
            assert_eq!(
                self::touches(&bent).1,
                self::touches(&program.text).1,
                "{what}: bent, it is touched as before"
            );
        }
    }
}

#[test]
fn a_plate_lies_below_the_way() {
    for (place, reason) in
        [("0mm,0mm,-1mm", "is invalid"), ("0mm,0mm,2mm", "--safe-z"), ("0mm,0mm", "three lengths")]
    {
        let options = Options::from_toml("f", &format!("tool-probe = \"{place}\""));
        let error = match options.map(Settings::resolve) {
            Err(error) | Ok(Err(error)) => error.to_string(),
            Ok(Ok(_)) => panic!("{place} is taken"),
        };
        assert!(error.contains(reason), "{error}");
    }
}

#[test]
fn the_rules_refuse_what_breaks_them() {
    let broken = [
        ("grbl", 1, "G1 X1 P5"),
        ("grbl", 1, "G2 I1 J0"),
        ("linuxcnc", 2, &format!("({})", "x".repeat(100))),
        ("grbl", 3, "(really?)"),
        ("marlin", 4, "(no comment)"),
        ("tinyg", 4, "(x) G1 X1"),
        ("smoothieware", 5, "G91.1"),
        ("marlin", 5, "M30"),
        ("klipper", 6, "G21 G90"),
        ("grbl", 7, "G1 X1 F0"),
        ("marlin", 8, "G0 X1"),
        ("marlin", 9, "X1"),
        ("grbl", 10, "G1 X-0"),
        ("grbl", 11, "G0 X1\nG0 X1"),
        ("linuxcnc", 12, "G0 X1 Y1\nG2 X1 Y1 I1 J0"),
        ("grbl", 13, "G0 X1 Y1\nG2 X2 Y2 I0.51 J0.5"),
        ("tinyg", 13, "G0 X1 Y1\nG2 X1.1 Y1.1 I0.0505 J0.05"),
        ("grbl", 15, "G81 X1"),
        ("marlin", 16, "G4 P3"),
        ("grbl", 17, "M3 S0\nG4 P3"),
        ("grbl", 19, "T2 M6"),
        ("grblhal", 19, "T1 M6\nG0 X1"),
        ("tinyg", 19, "M0"),
        ("marlin", 21, "M2"),
        ("grbl", 22, "G28"),
        ("grbl", 23, "G0 Z2\nG0 X1 Z0.1"),
    ];
    for (name, number, text) in broken {
        let rules = TABLE.iter().find(|rules| rules.name == name).expect("a table");
        let lines = text.lines().zip(1..).map(|(text, number)| Line::new(number, text)).collect();
        let case = Case { what: text.to_owned(), rules, lines };
        let found = RULES.iter().filter(|rule| rule.0 == number).any(|rule| !rule.1(&case).is_empty());
        assert!(found, "{name} bears `{text}` against rule {number}");
    }
}

#[test]
#[cfg_attr(debug_assertions, ignore = "takes minutes in a debug build")]
fn real_boards_keep_the_rules_in_every_dialect() {
    for board in board_folders() {
        for case in cases(&board, "tool = \"endmill:0.1mm\"") {
            for (number, rule) in RULES {
                let wrong = rule(&case);
                assert!(
                    wrong.is_empty(),
                    "{}, rule {number}: {:#?}",
                    case.what,
                    &wrong[..wrong.len().min(5)]
                );
            }
        }
    }
}
