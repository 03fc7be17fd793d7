//! Surfaces seen from the side, as the papers' figures show them: shaded faces with their edges.
//!
//! Faces are projected into the picture and drawn by the engine itself, each under a label of its
//! own; an edge is where the label of a pixel differs from that of the pixel to its right or below.

use super::{Buffers, Label, PixelPoint, Scene, SubPx, Surface, render};

/// A flat triangle in space: x to the right and y down in pixels of the plane, z away from the
/// plane, towards the viewer of [`Projection::Above`] where negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Its corners as (x, y, z).
    pub corners: [[f64; 3]; 3],
    /// Its colour in full light.
    pub color: [u8; 3],
}

/// How space is laid on the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// From above, along z: x and y as they are.
    Above,
    /// Parallel, from the front: y is foreshortened by `tilt` (1 is from above, 0 from the side), z
    /// points down the picture by what is left.
    Oblique {
        /// The cosine of the angle between the line of sight and z, from 0 to 1.
        tilt: f64,
    },
    /// From a point `distance` pixels before the plane's `center`, tilted as
    /// [`Projection::Oblique`]: what is farther is smaller.
    Perspective {
        /// As in [`Projection::Oblique`].
        tilt: f64,
        /// How far away the eye is from the centre.
        distance: f64,
        /// The place of the plane that is looked at.
        center: [f64; 2],
    },
}

/// Where a picture is taken from and how large it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// How space is laid on the picture.
    pub projection: Projection,
    /// Columns and rows.
    pub size: (u32, u32),
    /// Where the plane's origin comes to lie in the picture, in pixels.
    pub origin: [f64; 2],
    /// The colour where there is no face.
    pub background: [u8; 3],
    /// The colour of edges; none where they are not drawn.
    pub edges: Option<[u8; 3]>,
}

/// Towards the light, a unit vector: from above, the left and the front.
const LIGHT: [f64; 3] = [-0.36, 0.48, -0.8];

/// Draws faces with flat shading: 3 bytes a pixel, row by row from the top.
///
/// Faces behind the eye or far beyond the picture are left out.
#[must_use]
pub fn draw(faces: &[Face], view: &View) -> Vec<[u8; 3]> {
    let mut scene = Scene::new(view.size.0, view.size.1);
    for (label, face) in (1..).map(Label).zip(faces) {
        let [Some(a), Some(b), Some(c)] = face.corners.map(|corner| view.project(corner)) else { continue };
        scene.add(label, Surface::Triangle { corners: [a.0, b.0, c.0], depths: [a.1, b.1, c.1] });
    }
    let mut buffers = Buffers::new();
    render(&scene, &mut buffers);
    let colors: Vec<_> = faces.iter().map(shaded).collect();
    let labels = buffers.labels();
    let width = view.size.0 as usize;
    let differs = |at: usize, other: usize| labels.get(other).is_some_and(|&label| label != labels[at]);
    let pixel = |at: usize| {
        let is_edge = (at % width + 1 < width && differs(at, at + 1)) || differs(at, at + width);
        match (view.edges, (labels[at] as usize).checked_sub(1)) {
            (Some(color), _) if is_edge => color,
            (_, Some(face)) => colors[face],
            (_, None) => view.background,
        }
    };
    (0..labels.len()).map(pixel).collect()
}

/// The colour of a face: brighter the more squarely the light falls on it, from whichever side.
fn shaded(face: &Face) -> [u8; 3] {
    let [a, b, c] = face.corners;
    let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let (u, v) = (minus(b, a), minus(c, a));
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let length = dot(normal, normal).sqrt();
    let light = if length > 0.0 { (dot(normal, LIGHT) / length).abs() } else { 1.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
    face.color.map(|component| (f64::from(component) * (0.35 + 0.65 * light)) as u8)
}

impl View {
    /// Where a point comes to lie, and how deep; none behind the eye or far beyond the picture.
    fn project(&self, [x, y, z]: [f64; 3]) -> Option<(PixelPoint, f32)> {
        let tilted = |tilt: f64, y: f64, z: f64| {
            let across = (1.0 - tilt * tilt).max(0.0).sqrt();
            (y * tilt + z * across, z * tilt - y * across)
        };
        let (x, y, depth) = match self.projection {
            Projection::Above => (x, y, z),
            Projection::Oblique { tilt } => {
                let (y, depth) = tilted(tilt, y, z);
                (x, y, depth)
            }
            Projection::Perspective { tilt, distance, center } => {
                let (y, depth) = tilted(tilt, y - center[1], z);
                let away = distance + depth;
                if away <= distance * 1e-3 {
                    return None;
                }
                // Minus one over the distance runs evenly along a line on the picture; the distance
                // itself does not.
                let scale = distance / away;
                (center[0] + (x - center[0]) * scale, center[1] + y * scale, -scale)
            }
        };
        #[expect(clippy::cast_possible_truncation, reason = "rounded to a step; checked to be in range")]
        let step = |at: f64| (at.abs() < 4e6).then(|| SubPx::new((at * 256.0).round() as i32));
        let place = PixelPoint::new(step(x + self.origin[0])?, step(y + self.origin[1])?);
        #[expect(clippy::cast_possible_truncation, reason = "rounded correctly")]
        let depth = depth as f32;
        Some((place, depth))
    }
}
