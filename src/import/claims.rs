//! What is meant as a layer and cannot be read as one is refused, unless a person says otherwise.

use super::advice::{LEAVE_ASIDE, quoted};
use super::archive::Gathered;
use super::error::Error;
use super::format::Kind;
use super::jobfile::Job;
use super::layers;
use super::naming;
use super::selection::Selection;
use super::unusable::{Form, Meant, Unusable, is_binary_drill};
use crate::board::{Side, Warning};
use crate::import::diagnostic;

/// Whether a person has named another file for it.
const fn is_chosen(meant: Meant, selection: &Selection) -> bool {
    match meant {
        Meant::Copper(Side::Front) => selection.front.is_some(),
        Meant::Copper(Side::Back) => selection.back.is_some(),
        Meant::Outline => selection.outline.is_some(),
        Meant::Drill => selection.no_drill || !selection.drill.is_empty(),
        Meant::Layer => false,
    }
}

impl Gathered {
    /// How many characters of all files' names are the board's.
    pub(super) fn shared_start(&self) -> usize {
        let names: Vec<&str> = self.files.iter().map(|file| naming::stem(&file.name)).collect();
        layers::shared_start(&names)
    }

    /// Whether one of the files is a drill file by its content.
    pub(super) fn has_drill_file(&self) -> bool {
        self.files.iter().any(|file| file.kind == Kind::Excellon)
    }

    /// Fails for what is meant as a layer and cannot be read as one; returns what is doubtful.
    pub(super) fn refuse_unusable(&self, job: &Job, selection: &Selection) -> Result<Vec<Warning>, Error> {
        let names: Vec<&str> = self.files.iter().map(|file| naming::stem(&file.name)).collect();
        let mut warnings = Vec::new();
        let mut refused = Vec::new();
        for odd in &self.unusable {
            let shared = layers::shared_start(&[&names[..], &[naming::stem(&odd.name)]].concat());
            match odd.claim(shared, job) {
                Some((meant, _)) if is_chosen(meant, selection) => {}
                Some((Meant::Drill, _)) if self.has_text_beside(odd) => {
                    let message = format!(
                        "{} is a binary drill file; the text file of the same name is read",
                        odd.name
                    );
                    warnings.push(diagnostic::BINARY_DRILL_FILE.warning(message));
                }
                Some((meant, mark)) => refused.push((odd, meant, mark)),
                None => warnings.extend(odd.doubt(shared)),
            }
        }
        let Some((first, meant, mark)) = refused.first() else { return Ok(warnings) };
        let mut what = format!("{}, but by {mark} it should be {meant}", first.what());
        let others: Vec<&str> = refused[1..].iter().map(|(odd, ..)| odd.name.as_str()).collect();
        if !others.is_empty() {
            what += &format!("; {} more cannot be read: {}", others.len(), others.join(", "));
        }
        let hint = LEAVE_ASIDE.with([&quoted(&first.name)]);
        Err(Error::content(&first.shown, what, hint))
    }

    /// Whether `odd` is a binary drill file whose text lies beside it, as Altium writes both.
    fn has_text_beside(&self, odd: &Unusable) -> bool {
        let Form::File(head) = &odd.form else { return false };
        let stem = naming::stem(&odd.name);
        let same = |name: &str| naming::stem(name).eq_ignore_ascii_case(stem);
        is_binary_drill(head) && self.files.iter().any(|file| file.kind == Kind::Excellon && same(&file.name))
    }
}
