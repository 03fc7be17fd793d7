//! The sections of a DXF file: the unit, the layers, the blocks and what is drawn.

use std::collections::{BTreeMap, BTreeSet};

use super::pairs::{NoNumber, Pair, SENTINEL};
use crate::import::drawing::Unit;
use crate::import::error::Error;

/// An entity with all its pairs.
#[derive(Clone, Debug)]
pub(super) struct Entity<'a> {
    /// `LINE`, `CIRCLE`, …
    pub(super) kind: String,
    pairs: &'a [Pair<'a>],
    /// Where its name stands.
    pub(super) at: usize,
    /// The line of that, from 1.
    pub(super) line: u32,
    /// What belongs to it: the vertices of a polyline, the attributes of an insert.
    pub(super) parts: Vec<Entity<'a>>,
}

impl<'a> Entity<'a> {
    /// All pairs, in file order.
    pub(super) const fn pairs(&self) -> &'a [Pair<'a>] {
        self.pairs
    }

    /// The first value of `code` as a number.
    pub(super) fn real(&self, code: i32) -> Result<Option<f64>, NoNumber> {
        self.pairs.iter().find(|pair| pair.code == code).map(Pair::real).transpose()
    }

    pub(super) fn real_or(&self, code: i32, or: f64) -> Result<f64, NoNumber> {
        Ok(self.real(code)?.unwrap_or(or))
    }

    /// The first value of `code` as a whole number, zero where there is none.
    pub(super) fn whole(&self, code: i32) -> Result<i64, NoNumber> {
        Ok(self.pairs.iter().find(|pair| pair.code == code).map(Pair::whole).transpose()?.unwrap_or(0))
    }

    pub(super) fn text(&self, code: i32) -> Option<String> {
        self.pairs.iter().find(|pair| pair.code == code).map(|pair| pair.text().into_owned())
    }

    /// The point of `code` and `code + 10`.
    pub(super) fn point(&self, code: i32) -> Result<(f64, f64), NoNumber> {
        Ok((self.real_or(code, 0.0)?, self.real_or(code + 10, 0.0)?))
    }

    /// The points of `code` and the `code + 10` after it, in order.
    pub(super) fn points(&self, code: i32) -> Result<Vec<(f64, f64)>, NoNumber> {
        let mut points: Vec<(f64, f64)> = Vec::new();
        for pair in self.pairs {
            if pair.code == code {
                points.push((pair.real()?, 0.0));
            } else if pair.code == code + 10
                && let Some(last) = points.last_mut()
            {
                last.1 = pair.real()?;
            }
        }
        Ok(points)
    }

    pub(super) fn reals(&self, code: i32) -> Result<Vec<f64>, NoNumber> {
        self.pairs.iter().filter(|pair| pair.code == code).map(Pair::real).collect()
    }

    /// The layer it lies on; `0` where it says none.
    pub(super) fn layer(&self) -> String {
        self.text(8).unwrap_or_else(|| "0".to_owned())
    }
}

/// A block: what an insert draws.
#[derive(Clone, Debug, Default)]
pub(super) struct Block<'a> {
    pub(super) base: (f64, f64),
    pub(super) entities: Vec<Entity<'a>>,
}

/// What a file says.
#[derive(Debug, Default)]
pub(super) struct Dxf<'a> {
    /// `$ACADVER`.
    pub(super) version: Option<String>,
    /// `$INSUNITS`, where it is a unit.
    pub(super) unit: Option<(Unit, &'static str)>,
    /// Layers that are off or frozen.
    pub(super) hidden: BTreeSet<String>,
    pub(super) blocks: BTreeMap<String, Block<'a>>,
    /// What is drawn in the model's space, and in that of the paper.
    pub(super) entities: Vec<Entity<'a>>,
    /// Whether the file has its end.
    pub(super) is_whole: bool,
}

/// Values of `$INSUNITS`: name and nanometres.
const UNITS: [(i64, &str, f64); 11] = [
    (1, "inch", 25.4e6),
    (2, "ft", 304.8e6),
    (4, "mm", 1e6),
    (5, "cm", 1e7),
    (6, "m", 1e9),
    (8, "microinch", 25.4),
    (9, "mil", 25_400.0),
    (10, "yd", 914.4e6),
    (12, "nm", 1.0),
    (13, "micron", 1e3),
    (14, "dm", 1e8),
];

impl<'a> Dxf<'a> {
    /// What `pairs` say, those of the file `name` with content `bytes`.
    pub(super) fn read(name: &str, bytes: &'a [u8], pairs: &'a [Pair<'a>]) -> Result<Self, Error> {
        let mut dxf = Self::default();
        let mut section = String::new();
        let mut block: Option<(String, Block<'a>)> = None;
        let mut open = false;
        let mut records = Records { pairs, bytes, counted: (0, 1) };
        let no_number = |NoNumber(place)| super::no_number(name, bytes, place);
        while let Some(mut record) = records.next() {
            match record.kind.as_str() {
                "SECTION" => {
                    section = record.text(2).unwrap_or_default().to_ascii_uppercase();
                    open = true;
                    if section == "HEADER" {
                        dxf.header(record.pairs).map_err(no_number)?;
                    }
                    continue;
                }
                "ENDSEC" => {
                    section.clear();
                    open = false;
                    continue;
                }
                "EOF" => {
                    dxf.is_whole = true;
                    break;
                }
                _ => {}
            }
            if matches!(record.kind.as_str(), "POLYLINE" | "INSERT") {
                records.parts(&mut record);
            }
            match (section.as_str(), record.kind.as_str()) {
                ("TABLES", "LAYER") => {
                    let is_off = record.whole(62).map_err(no_number)? < 0;
                    let is_frozen = record.whole(70).map_err(no_number)? & 1 != 0;
                    if is_off || is_frozen {
                        dxf.hidden.extend(record.text(2).map(|name| name.to_uppercase()));
                    }
                }
                ("BLOCKS", "BLOCK") => {
                    let base = record.point(10).map_err(no_number)?;
                    let name = record.text(2).unwrap_or_default().to_ascii_uppercase();
                    block = Some((name, Block { base, entities: Vec::new() }));
                }
                ("BLOCKS", "ENDBLK") => dxf.blocks.extend(block.take()),
                ("BLOCKS", _) => {
                    if let Some((_, block)) = &mut block {
                        block.entities.push(record);
                    }
                }
                ("ENTITIES", _) => dxf.entities.push(record),
                _ => {}
            }
        }
        if open {
            let what = "the drawing is truncated: its last section has no end";
            let end = bytes.len().saturating_sub(1)..bytes.len();
            return Err(Error::syntax(
                name,
                bytes,
                end,
                what,
                "ENDSEC and EOF",
                "copy or export the file again",
            ));
        }
        Ok(dxf)
    }

    fn header(&mut self, pairs: &[Pair<'_>]) -> Result<(), NoNumber> {
        let mut variable = String::new();
        for pair in pairs {
            match (pair.code, variable.as_str()) {
                (9, _) => variable = pair.text().into_owned(),
                (1, "$ACADVER") => self.version = Some(pair.text().into_owned()),
                (70, "$INSUNITS") => {
                    let number = pair.whole()?;
                    let known = UNITS.iter().find(|unit| unit.0 == number);
                    self.unit = known.and_then(|&(_, name, nm)| Some((Unit::of_nanometres(nm)?, name)));
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// Pairs from one code 0 to the next.
struct Records<'a> {
    /// What is left of them.
    pairs: &'a [Pair<'a>],
    bytes: &'a [u8],
    /// Up to which byte lines are counted, and the line of that.
    counted: (usize, u32),
}

impl<'a> Records<'a> {
    /// The next record; what stands before the first is passed over.
    fn next(&mut self) -> Option<Entity<'a>> {
        let start = self.pairs.iter().position(|pair| pair.code == 0)?;
        let (first, rest) = self.pairs[start..].split_first()?;
        let count = rest.iter().position(|pair| pair.code == 0).unwrap_or(rest.len());
        let (pairs, rest) = rest.split_at(count);
        self.pairs = rest;
        let kind = first.text().to_ascii_uppercase();
        let at = first.place.start;
        Some(Entity { kind, pairs, at, line: self.line(at), parts: Vec::new() })
    }

    /// The line of the byte `at`, which is not before the last one that was asked for.
    fn line(&mut self, at: usize) -> u32 {
        let (from, line) = self.counted;
        let ends = |i: &usize| match self.bytes[*i] {
            b'\n' => true,
            b'\r' => self.bytes.get(i + 1) != Some(&b'\n'),
            _ => false,
        };
        let passed = if self.bytes.starts_with(SENTINEL) { 0 } else { (from..at).filter(ends).count() };
        self.counted = (at, line.saturating_add(u32::try_from(passed).unwrap_or(u32::MAX)));
        self.counted.1
    }

    /// Adds to `entity` the vertices or attributes that follow, up to the end of their sequence.
    fn parts(&mut self, entity: &mut Entity<'a>) {
        let is_part = |pair: &Pair<'_>| matches!(pair.text().as_ref(), "VERTEX" | "ATTRIB" | "SEQEND");
        while self.pairs.first().is_some_and(is_part) {
            let Some(part) = self.next() else { return };
            if part.kind == "SEQEND" {
                return;
            }
            entity.parts.push(part);
        }
    }
}
