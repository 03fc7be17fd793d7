//! Attributes (TF, TA, TO, TD; specification §5), also those that KiCad writes into comments for
//! readers of old.

use std::borrow::Cow;

use rustc_hash::FxHashMap;

use crate::board;

/// The attributes in force, and the sets that objects refer to.
#[derive(Debug)]
pub(super) struct Attributes {
    /// `.FileFunction`, its fields joined by commas.
    pub(super) function: Option<String>,
    /// Whether `.FilePolarity` is negative.
    pub(super) negative: bool,
    /// `.GenerationSoftware`, its fields joined by blanks.
    pub(super) generator: Option<String>,
    /// `.AperFunction` as apertures and regions defined now get it.
    pub(super) aperture: Option<String>,
    object: board::Attributes,
    sets: Vec<board::Attributes>,
    numbers: FxHashMap<board::Attributes, u32>,
}

impl Attributes {
    pub(super) fn new() -> Self {
        let empty = board::Attributes::default();
        Self {
            function: None,
            negative: false,
            generator: None,
            aperture: None,
            object: empty.clone(),
            sets: vec![empty.clone()],
            numbers: FxHashMap::from_iter([(empty, 0)]),
        }
    }

    /// Reads `TO.N,GND` and the like; false where it is no attribute command.
    pub(super) fn command(&mut self, text: &[u8]) -> bool {
        let text = String::from_utf8_lossy(text);
        let Some((kind, rest)) = text.split_at_checked(2) else { return false };
        let mut fields = rest.split(',').map(|field| decoded(field.trim()));
        let name = fields.next().unwrap_or_default();
        let values: Vec<String> = fields.map(Cow::into_owned).collect();
        match kind {
            "TF" => self.file(&name, &values),
            "TA" if name == ".AperFunction" => self.aperture = Some(values.join(",")),
            "TO" => self.object(&name, &values),
            "TD" => self.delete(&name),
            "TA" => {}
            _ => return false,
        }
        true
    }

    fn file(&mut self, name: &str, values: &[String]) {
        match name {
            ".FileFunction" => self.function = Some(values.join(",")),
            ".FilePolarity" => self.negative = values.first().is_some_and(|value| value == "Negative"),
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

    /// The number of the set of an object drawn now, with an aperture of this function.
    pub(super) fn set(&mut self, function: Option<&str>) -> u32 {
        let set = board::Attributes { function: function.map(str::to_owned), ..self.object.clone() };
        if let Some(&number) = self.numbers.get(&set) {
            return number;
        }
        let number = u32::try_from(self.sets.len()).unwrap_or(0);
        self.sets.push(set.clone());
        self.numbers.insert(set, number);
        number
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
            assert!(attributes.command(command.as_bytes()), "{command}");
        }
        let function = attributes.aperture.clone();
        let set = attributes.set(function.as_deref());
        assert!(attributes.command(b"TD"), "delete all");
        assert_eq!(attributes.set(None), 0, "nothing in force");
        let sets = attributes.into_sets();
        let found = &sets[set as usize];
        assert_eq!(found.net.as_deref(), Some("/Data,0"), "the escape is a comma of the name");
        assert_eq!((found.component.as_deref(), found.pin.as_deref()), (Some("U1"), Some("3")), "the pin");
        assert_eq!(found.function.as_deref(), Some("SMDPad,CuDef"), "all fields");
    }
}
