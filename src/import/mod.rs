//! Files → [`Board`](crate::board::Board).

mod error;

pub use error::{Diagnosis, Error};
