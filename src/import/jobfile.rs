//! Gerber job files: the list of a board's files and their functions, in JSON (Ucamco, Gerber Job
//! Format 2023.02 §4).

use super::layers::Function;

/// What a job file says that matters here.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Job {
    /// The project's name.
    pub(super) name: Option<String>,
    /// File names without folders, with what they are.
    pub(super) files: Vec<(String, Function)>,
}

impl Job {
    /// Whether a file named so is a job file.
    pub(super) fn is_named(name: &str) -> bool {
        name.to_ascii_lowercase().ends_with(".gbrjob")
    }

    /// Reads a job file; what it has no use for, it does not look at.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, serde_json::Error> {
        let json: serde_json::Value = serde_json::from_slice(bytes)?;
        let entries = json["FilesAttributes"].as_array().map(Vec::as_slice).unwrap_or_default();
        let files = entries.iter().filter_map(|entry| {
            let path = entry["Path"].as_str()?;
            let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
            Some((name.to_owned(), Function::read(entry["FileFunction"].as_str()?)?))
        });
        let name = json["GeneralSpecs"]["ProjectId"]["Name"].as_str().map(str::to_owned);
        Ok(Self { name, files: files.collect() })
    }

    /// What it says that the file `name` is.
    pub(super) fn function_of(&self, name: &str) -> Option<Function> {
        self.files.iter().find(|(file, _)| file == name).map(|&(_, function)| function)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::Side;
    use crate::import::layers::Role;

    #[test]
    fn a_job_names_its_files() {
        let text = br#"{"GeneralSpecs": {"ProjectId": {"Name": "amp"}}, "FilesAttributes": [
            {"Path": "out/a.gbr", "FileFunction": "Copper,L1,Top", "FilePolarity": "Positive"},
            {"Path": "b.gbr", "FileFunction": "Profile"}, {"Path": 3}]}"#;
        let job = Job::read(text).unwrap();
        let role_of = |name| job.function_of(name).map(|function| function.role);
        assert_eq!(role_of("a.gbr"), Some(Role::Copper(Side::Front)), "without its folder");
        assert_eq!(role_of("b.gbr"), Some(Role::Outline), "the edge");
        assert_eq!(job.name.as_deref(), Some("amp"), "the project");
        assert!(Job::read(b"{").is_err(), "cut off");
    }
}
