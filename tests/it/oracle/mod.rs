//! Each stage once more, slow and obvious, to hold the fast one against.

pub(crate) mod distance;
pub(crate) mod field;
pub(crate) mod parabola;
pub(crate) mod polyline;
pub(crate) mod raster;
