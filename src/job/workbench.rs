//! Every tool a person can name, for looking at.

use super::drilling::workshop;
use super::options::Complete;
use super::tools::ToolChoice;
use super::{Error, Options, Settings};
use crate::toolpath::Tool;

/// Every tool a person can name, for looking at.
#[derive(Debug)]
pub struct Workbench {
    options: Complete,
}

impl Workbench {
    /// The tools of a settings file, and those that are built in.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] as for any job with these settings.
    pub fn new(options: Options) -> Result<Self, Error> {
        let settings = Settings::resolve(options)?;
        Ok(Self { options: settings.options().clone().complete() })
    }

    /// All tools that have names, those that are built in first.
    #[must_use]
    pub fn all(&self) -> Vec<ToolChoice> {
        self.options.tools.names().into_iter().map(ToolChoice::Named).collect()
    }

    /// The number that a person's own tool has in the machine's table, if its table says one.
    #[must_use]
    pub fn number(&self, choice: &ToolChoice) -> Option<u32> {
        match choice {
            ToolChoice::Named(name) => self.options.tools.number(name),
            ToolChoice::Kind(_) => None,
        }
    }

    /// The tool that `choice` means.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a name that nobody knows.
    pub fn fetch(&self, choice: &ToolChoice) -> Result<Tool, Error> {
        workshop(&self.options)?.fetch("tools", choice).map(|fetched| fetched.tool)
    }
}
