//! A figure for each axis, written once for all or three times.

use std::fmt;
use std::str::FromStr;

/// A figure for x, y and z, written as three with commas between, or as one for all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PerAxis<T>(pub [T; 3]);

/// Why a text is not a figure for each axis.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParsePerAxisError<E> {
    /// Two, or more than three.
    #[error("`{0}` is neither one value for all axes nor three, separated by commas, for x, y and z")]
    Count(String),
    /// A part that is none.
    #[error("{0}")]
    Part(E),
}

impl<T: FromStr + Copy> FromStr for PerAxis<T> {
    type Err = ParsePerAxisError<T::Err>;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let part = |text: &str| text.parse().map_err(ParsePerAxisError::Part);
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        match parts[..] {
            [all] => Ok(Self([part(all)?; 3])),
            [x, y, z] => Ok(Self([part(x)?, part(y)?, part(z)?])),
            _ => Err(ParsePerAxisError::Count(text.to_owned())),
        }
    }
}

impl<T: fmt::Display> fmt::Display for PerAxis<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self([x, y, z]) = self;
        write!(f, "{x},{y},{z}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::toolpath::Feed;

    #[test]
    fn one_figure_is_for_all_axes() {
        let one: PerAxis<Feed> = "500mm/min".parse().unwrap();
        assert_eq!(one.to_string(), "500mm/min,500mm/min,500mm/min", "all the same");
        let three: PerAxis<Feed> = "500mm/min, 5mm/s,1mm/min".parse().unwrap();
        assert_eq!(three.to_string(), "500mm/min,300mm/min,1mm/min", "each its own");
        assert!("1mm/min,2mm/min".parse::<PerAxis<Feed>>().is_err(), "which is z?");
    }
}
