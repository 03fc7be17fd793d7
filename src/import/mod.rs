//! Files → [`Board`](crate::board::Board).

mod digest;
mod error;
pub mod excellon;

pub use error::{Diagnosis, Error};
