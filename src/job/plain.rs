//! The nets of a side and the boundaries midway between all of them, whatever the strategy.

use crate::board::{Copper, Outline};
use crate::topology::{Method, Nets};
use crate::voronoi::{self, Boundaries, Diagram, Frame};

use super::choice::Topology;
use super::{Error, Settings};

/// The topology's own name for what was chosen.
pub(super) fn method(topology: Topology) -> Method {
    match topology {
        Topology::Contact | Topology::All => Method::Contact,
        Topology::Coincidence => Method::Coincidence,
        Topology::Translucency => Method::Translucency,
    }
}

/// The diagram of all nets, midway between them and as far as there is room, with its boundaries
/// whatever strategy is asked for: what parts regions on a mask.
pub(super) fn diagram(
    copper: &Copper,
    nets: &Nets,
    outline: Option<&Outline>,
    settings: &Settings,
) -> Result<(Diagram, Boundaries), Error> {
    let settings = voronoi::Settings {
        tolerance: settings.tolerance,
        frame: Frame::Hull(settings.frame_margin),
        ..voronoi::Settings::default()
    };
    let error = |reason| Error::Voronoi { side: copper.side, reason };
    let diagram = Diagram::new(copper, nets, outline, &settings).map_err(error)?;
    let boundaries = diagram.boundaries().map_err(error)?;
    Ok((diagram, boundaries))
}
