//! Files → [`Board`](crate::board::Board).

mod digest;
mod error;
pub mod excellon;
pub mod gerber;

pub use error::{Diagnosis, Error};
