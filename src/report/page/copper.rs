//! The copper of a side as paths, net by net.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::board::{Copper, Shape};
use crate::geometry::{Nm, Rect};
use crate::topology::{Net, Nets};

use crate::report::ink::{Ink, pen, place, um};

/// Features that one path holds at most. Chosen: few paths to draw, and small ones to leave out
/// where they are not seen.
const MOST: usize = 256;

/// The copper of a net.
#[derive(Clone, Debug, Serialize)]
pub struct NetDrawing {
    /// The middle of its largest feature, and how wide that is: where its name stands.
    pub label: [i64; 3],
    /// What it is made of.
    pub paths: Vec<CopperPath>,
}

/// Some features drawn with one pen: its width (zero for areas), left, bottom, right and top of
/// what it draws, and an SVG path.
#[derive(Clone, Debug, Serialize)]
pub struct CopperPath(pub i64, pub [i64; 4], pub String);

/// All nets of a side, by number.
pub(super) fn nets(copper: &Copper, nets: &Nets) -> Vec<NetDrawing> {
    nets.nets().iter().map(|net| drawing(copper, net)).collect()
}

fn drawing(copper: &Copper, net: &Net) -> NetDrawing {
    let mut pens: BTreeMap<Nm, Vec<&Shape>> = BTreeMap::new();
    let mut largest: Option<Rect> = None;
    let size = |rect: Rect| rect.width().max(rect.height());
    for &feature in &net.features {
        let shape = &copper.features[feature as usize].shape;
        pens.entry(pen(shape)).or_default().push(shape);
        let bounds = shape.bounds();
        if largest.is_none_or(|largest| size(bounds) > size(largest)) {
            largest = Some(bounds);
        }
    }
    let label = largest.map_or([0; 3], |rect| {
        let [x, y] = place(rect.min().midpoint(rect.max()));
        [x, y, um(rect.width())]
    });
    let chunks = pens.iter().flat_map(|(width, shapes)| shapes.chunks(MOST).map(|chunk| (*width, chunk)));
    NetDrawing { label, paths: chunks.map(|(width, shapes)| path(width, shapes)).collect() }
}

fn path(width: Nm, shapes: &[&Shape]) -> CopperPath {
    let mut ink = Ink::default();
    for shape in shapes {
        ink.shape(shape);
    }
    let bounds = shapes.iter().map(|shape| shape.bounds()).reduce(Rect::union);
    let bounds = bounds.map_or([0; 4], |rect| {
        let ([left, bottom], [right, top]) = (place(rect.min()), place(rect.max()));
        [left, bottom, right, top]
    });
    CopperPath(um(width), bounds, ink.into_text())
}
