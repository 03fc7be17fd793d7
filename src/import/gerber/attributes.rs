//! Attributes (TF, TA, TO, TD; specification §5), also those that KiCad writes into comments for
//! readers of old.

use std::borrow::Cow;

use rustc_hash::FxHashMap;

use crate::board;
use crate::import::error::printable;

/// The attributes in force, and the sets that objects refer to.
#[derive(Debug, Default)]
pub(super) struct Attributes {
    /// `.FileFunction`, its fields joined by commas.
    function: Option<String>,
    /// Whether `.FilePolarity` is negative.
    is_negative: bool,
    /// `.GenerationSoftware`, its fields joined by blanks.
    generator: Option<String>,
    /// A comment that names a program.
    signature: Option<String>,
    /// `.AperFunction` as apertures and regions defined now get it.
    aperture: Option<String>,
    object: board::Attributes,
    /// The number of the set of what is drawn now; none after something changed.
    current: Option<u32>,
    sets: Vec<board::Attributes>,
    numbers: FxHashMap<board::Attributes, u32>,
    /// The sets of objects of blocks that are flashed, by theirs and the flash's.
    merged: FxHashMap<(u32, u32), u32>,
}

impl Attributes {
    pub(super) fn new() -> Self {
        let empty = board::Attributes::default();
        let numbers = FxHashMap::from_iter([(empty.clone(), 0)]);
        Self { sets: vec![empty], numbers, ..Self::default() }
    }

    /// Reads a comment: an attribute for readers of old, or a program that names itself.
    pub(super) fn comment(&mut self, text: &[u8]) {
        const PROGRAMS: [&str; 13] = [
            "kicad",
            "pcbnew",
            "eagle",
            "easyeda",
            "altium",
            "protel",
            "geda",
            "pcb,",
            "orcad",
            "diptrace",
            "fritzing",
            "upverter",
            "created by",
        ];
        let text = text.trim_ascii();
        if let Some(attribute) = text.strip_prefix(b"#@!") {
            self.command(attribute.trim_ascii());
        } else if self.signature.is_none() && text.len() < 200 {
            let shown = printable(text);
            let lower = shown.to_lowercase();
            self.signature = PROGRAMS.iter().any(|program| lower.contains(program)).then_some(shown);
        }
    }

    /// Reads `TO.N,GND` and the like.
    pub(super) fn command(&mut self, text: &[u8]) {
        let text = String::from_utf8_lossy(text);
        let Some((kind, rest)) = text.split_at_checked(2) else { return };
        let mut fields = rest.split(',').map(|field| decoded(field.trim()));
        let name = fields.next().unwrap_or_default();
        let values: Vec<String> = fields.map(Cow::into_owned).collect();
        match kind {
            "TF" => self.file(&name, &values),
            "TA" if name == ".AperFunction" => self.aperture = Some(values.join(",")),
            "TO" => self.object(&name, &values),
            "TD" => self.delete(&name),
            _ => {}
        }
        self.forget();
    }

    fn file(&mut self, name: &str, values: &[String]) {
        match name {
            ".FileFunction" => self.function = Some(values.join(",")),
            ".FilePolarity" => self.is_negative = values.first().is_some_and(|value| value == "Negative"),
            ".GenerationSoftware" => self.generator = Some(values.join(" ").trim().to_owned()),
            _ => {}
        }
    }

    fn object(&mut self, name: &str, values: &[String]) {
        let value = |index: usize| values.get(index).filter(|value| !value.is_empty()).cloned();
        match name {
            // `N/C` marks a pad that is not connected: no net.
            ".N" => self.object.net = value(0).filter(|net| net != "N/C"),
            ".C" => self.object.component = value(0),
            ".P" => (self.object.component, self.object.pin) = (value(0), value(1)),
            _ => {}
        }
    }

    fn delete(&mut self, name: &str) {
        match name {
            "" => (self.object, self.aperture) = (board::Attributes::default(), None),
            ".AperFunction" => self.aperture = None,
            ".N" => self.object.net = None,
            ".C" => self.object.component = None,
            ".P" => (self.object.component, self.object.pin) = (None, None),
            _ => {}
        }
    }

    /// To be called when the aperture in use changed, or a region begins or ends.
    pub(super) const fn forget(&mut self) {
        self.current = None;
    }

    /// The number of the set of an object drawn now, with an aperture of this function; of a
    /// contour, where there is no aperture.
    pub(super) fn set<'a>(&mut self, function: impl FnOnce() -> Option<Option<&'a str>>) -> u32 {
        if let Some(current) = self.current {
            return current;
        }
        let function = function().map_or_else(|| self.aperture.clone(), |own| own.map(str::to_owned));
        let number = self.number_of(board::Attributes { function, ..self.object.clone() });
        self.current = Some(number);
        number
    }

    fn number_of(&mut self, set: board::Attributes) -> u32 {
        self.numbers.get(&set).copied().unwrap_or_else(|| {
            let number = u32::try_from(self.sets.len()).unwrap_or(0);
            self.sets.push(set.clone());
            self.numbers.insert(set, number);
            number
        })
    }

    /// The number of the set of an object of a block that is flashed: what it does not have itself
    /// is that of the flash.
    pub(super) fn merged(&mut self, object: u32, flash: u32) -> u32 {
        match (object, flash) {
            (own, 0) => own,
            (0, flash) => flash,
            (object, flash) if object == flash => object,
            (object, flash) => self.both(object, flash),
        }
    }

    fn both(&mut self, object: u32, flash: u32) -> u32 {
        if let Some(&known) = self.merged.get(&(object, flash)) {
            return known;
        }
        let [own, of_flash] = [object, flash].map(|number| self.sets[number as usize].clone());
        let is_part = own.component.is_some();
        let number = self.number_of(board::Attributes {
            net: own.net.or(of_flash.net),
            component: own.component.or(of_flash.component),
            pin: own.pin.or(of_flash.pin.filter(|_| !is_part)),
            function: own.function.or(of_flash.function),
        });
        self.merged.insert((object, flash), number);
        number
    }

    /// The `.AperFunction` of an aperture that is defined now.
    pub(super) fn aperture(&self) -> Option<String> {
        self.aperture.clone()
    }

    pub(super) const fn function(&self) -> Option<&String> {
        self.function.as_ref()
    }

    /// Whether the file declares that it shows what is no copper.
    pub(super) const fn is_negative(&self) -> bool {
        self.is_negative
    }

    /// Whether attributes tell of the file, which those of X2 do.
    pub(super) const fn are_of_file(&self) -> bool {
        self.function.is_some() || self.generator.is_some()
    }

    /// The program that wrote the file.
    pub(super) fn generator(&self) -> Option<String> {
        self.generator.clone().or_else(|| self.signature.clone())
    }

    /// All sets, by number; the first is empty.
    pub(super) fn into_sets(self) -> Vec<board::Attributes> {
        self.sets
    }
}

/// `\uXXXX` (and `\UXXXXXXXX`) replaced by the character (specification §3.4.3).
fn decoded(field: &str) -> Cow<'_, str> {
    if !field.contains('\\') {
        return Cow::Borrowed(field);
    }
    let mut text = String::with_capacity(field.len());
    let mut rest = field;
    while let Some(at) = rest.find('\\') {
        text.push_str(&rest[..at]);
        let digits = if rest[at..].starts_with("\\U") { 8 } else { 4 };
        let code = rest.get(at + 2..at + 2 + digits).filter(|_| rest[at + 1..].starts_with(['u', 'U']));
        let character = code.and_then(|code| u32::from_str_radix(code, 16).ok()).and_then(char::from_u32);
        if let Some(character) = character {
            text.push(character);
            rest = &rest[at + 2 + digits..];
        } else {
            text.push('\\');
            rest = &rest[at + 1..];
        }
    }
    text.push_str(rest);
    Cow::Owned(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_object_keeps_the_attributes_in_force() {
        let mut attributes = Attributes::new();
        for command in ["TO.N,/Data\\u002C0", "TO.P,U1,3,IN", "TA.AperFunction,SMDPad,CuDef"] {
            attributes.command(command.as_bytes());
        }
        let set = attributes.set(|| None);
        attributes.command(b"TD");
        assert_eq!(attributes.set(|| Some(None)), 0, "nothing in force");
        let sets = attributes.into_sets();
        let found = &sets[set as usize];
        assert_eq!(found.net.as_deref(), Some("/Data,0"), "the escape is a comma of the name");
        assert_eq!((found.component.as_deref(), found.pin.as_deref()), (Some("U1"), Some("3")), "the pin");
        assert_eq!(found.function.as_deref(), Some("SMDPad,CuDef"), "all fields");
    }
}
