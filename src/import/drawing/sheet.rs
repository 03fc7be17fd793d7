//! A drawing as its reader has it, and what a person says of it.

use std::sync::Arc;

use super::unit::Unit;
use crate::artwork::Artwork;
use crate::board::{Source, Warning};

/// What a person says of drawings.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How long one unit is, whatever the file says.
    pub unit: Option<Unit>,
    /// The content of fonts for texts, the first one first.
    pub fonts: Vec<Arc<Vec<u8>>>,
}

/// A drawing with what is known of its file.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// What is drawn.
    pub artwork: Artwork,
    /// The file; its role is for the caller to fill in.
    pub source: Source,
    /// What was left out or assumed.
    pub warnings: Vec<Warning>,
}
