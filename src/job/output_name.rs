//! What files are called, where a person says it.

use std::fmt;
use std::str::FromStr;

use super::{Error, Part};

/// The name of a program's file.
///
/// # Guarantees
///
/// It is a name alone, without folders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputName {
    /// Which program.
    pub part: Part,
    file: String,
}

/// A text that names no file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseOutputNameError {
    /// No equals sign, or no program.
    #[error(
        "`{0}` does not choose a program: expected front, back, drill, cutout or alignment, and a file, such as front=top.ngc"
    )]
    Form(String),
    /// With folders.
    #[error("`{0}` is not a file name: expected one without folders, such as top.ngc")]
    File(String),
}

impl OutputName {
    /// The name of the file for `part`.
    ///
    /// # Errors
    ///
    /// [`ParseOutputNameError::File`] for a name with folders.
    pub fn try_new(part: Part, file: &str) -> Result<Self, ParseOutputNameError> {
        let is_name = !file.is_empty() && !file.starts_with('.') && !file.contains(['/', '\\', ':']);
        let file = file.to_owned();
        if is_name { Ok(Self { part, file }) } else { Err(ParseOutputNameError::File(file)) }
    }

    /// The file; with `addition` before its ending, where one program becomes several files.
    #[must_use]
    pub fn with(&self, addition: &str) -> String {
        let (stem, ending) = self
            .file
            .rsplit_once('.')
            .map_or((self.file.as_str(), None), |(stem, ending)| (stem, Some(ending)));
        ending.map_or_else(|| format!("{stem}{addition}"), |ending| format!("{stem}{addition}.{ending}"))
    }
}

impl FromStr for OutputName {
    type Err = ParseOutputNameError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let named =
            text.split_once('=').and_then(|(part, file)| Some((Part::by_name(part.trim())?, file.trim())));
        let (part, file) = named.ok_or_else(|| ParseOutputNameError::Form(text.to_owned()))?;
        Self::try_new(part, file)
    }
}

/// As it is written.
impl fmt::Display for OutputName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.part.name(), self.file)
    }
}

/// Refuses two names for one program, and one for two.
pub(super) fn check(names: &[OutputName]) -> Result<(), Error> {
    for (i, name) in names.iter().enumerate() {
        let clash = names[..i]
            .iter()
            .find(|other| other.part == name.part || other.file.eq_ignore_ascii_case(&name.file));
        if let Some(other) = clash {
            return Err(Error::Value {
                key: "output-name",
                problem: format!("`{other}` and `{name}` exclude each other"),
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_reads_back_and_takes_an_addition_before_its_ending() {
        let name: OutputName = "front=top side.v2.ngc".parse().expect("a name");
        assert_eq!(name.to_string(), "front=top side.v2.ngc", "as it is written");
        assert_eq!(name.with("-tool-2"), "top side.v2-tool-2.ngc", "before the ending");
        let bare: OutputName = "drill=holes".parse().expect("a name");
        assert_eq!(
            (bare.with(""), bare.with("-tool-1")),
            ("holes".to_owned(), "holes-tool-1".to_owned()),
            "none"
        );
    }

    #[test]
    fn what_names_no_file_beside_the_others_is_refused() {
        for text in ["top.ngc", "top=x.ngc", "front=", "front=out/x.ngc", "front=..", "front=c:x"] {
            assert!(text.parse::<OutputName>().is_err(), "{text}");
        }
        for (one, other) in [("front=a.ngc", "front=b.ngc"), ("front=a.ngc", "back=A.NGC")] {
            let names = [one, other].map(|text| text.parse().expect(text));
            assert!(check(&names).is_err(), "{one} {other}");
        }
    }
}
