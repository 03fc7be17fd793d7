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
    /// How far the plane is turned about its origin before it is looked at: in radians, against the
    /// clock as seen from above.
    pub azimuth: f64,
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

/// Towards the light, a unit vector: from above, the left and the front. Chosen for the look.
const LIGHT: [f64; 3] = [-0.36, 0.48, -0.8];

/// Draws faces with flat shading: 3 bytes a pixel, row by row from the top.
///
/// Faces behind the eye or far beyond the picture are left out.
///
/// ```
/// use voromill::raster::view::{Face, Projection, View, draw};
///
/// // A wall along x, seen from above and a little from the front, then turned by a right angle.
/// let wall = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0], [9.0, 0.0, -6.0]];
/// let face = Face { corners: wall, color: [250; 3] };
/// let view = View {
///     azimuth: 0.0,
///     projection: Projection::Oblique { tilt: 0.6 },
///     size: (20, 20),
///     origin: [10.0, 10.0],
///     background: [0; 3],
///     edges: None,
/// };
/// let seen = |view: &View| draw(&[face], view).iter().filter(|&&pixel| pixel != [0; 3]).count();
/// assert!(seen(&view) > 15, "it is 9 long and 4.8 high");
/// let aside = View { azimuth: std::f64::consts::FRAC_PI_2, ..view };
/// assert_eq!(seen(&aside), 0, "its plane now holds the line of sight");
/// ```
#[must_use]
pub fn draw(faces: &[Face], view: &View) -> Vec<[u8; 3]> {
    let mut scene = Scene::new(view.size.0, view.size.1);
    let turn = libm::sincos(view.azimuth);
    for (label, face) in (1..).map(Label).zip(faces) {
        let [Some(a), Some(b), Some(c)] = face.corners.map(|corner| view.project(turned(turn, corner)))
        else {
            continue;
        };
        scene.add(label, Surface::Triangle { corners: [a.0, b.0, c.0], depths: [a.1, b.1, c.1] });
    }
    let mut buffers = Buffers::new();
    render(&scene, &mut buffers);
    let colors: Vec<_> = faces.iter().map(|face| shaded(face, turn)).collect();
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

/// A point of space after a turn, given by its sine and cosine.
fn turned((sin, cos): (f64, f64), [x, y, z]: [f64; 3]) -> [f64; 3] {
    [x * cos + y * sin, y * cos - x * sin, z]
}

/// The colour of a face: brighter the more squarely the light falls on it, from whichever side.
fn shaded(face: &Face, turn: (f64, f64)) -> [u8; 3] {
    let [a, b, c] = face.corners.map(|corner| turned(turn, corner));
    let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let (u, v) = (minus(b, a), minus(c, a));
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let dot = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let length = dot(normal, normal).sqrt();
    let light = if length > 0.0 { (dot(normal, LIGHT) / length).abs() } else { 1.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 255")]
    face.color.map(|component| (f64::from(component) * (0.35 + 0.65 * light)) as u8)
}

impl Face {
    /// The face of a [`Surface::Triangle`], its depths as z: what [`mesh`](super::mesh) makes of
    /// cones, curtains and rings. None for any other surface.
    ///
    /// ```
    /// use voromill::raster::view::Face;
    /// use voromill::raster::{PixelPoint, mesh};
    ///
    /// let cone = mesh::cone(PixelPoint::from_pixels(20, 10), 8.0, 0.1);
    /// let faces: Vec<_> = cone.iter().filter_map(|surface| Face::of(surface, [200; 3])).collect();
    /// assert_eq!(faces.len(), cone.len(), "each triangle is a face");
    /// assert_eq!(faces[0].corners[0], [20.0, 10.0, 0.0], "the apex");
    /// ```
    #[must_use]
    pub fn of(surface: &Surface, color: [u8; 3]) -> Option<Self> {
        let Surface::Triangle { corners, depths } = surface else { return None };
        let at = |i: usize| [corners[i].x.to_pixels(), corners[i].y.to_pixels(), f64::from(depths[i])];
        Some(Self { corners: [0, 1, 2].map(at), color })
    }
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
        let step = |at: f64| (at.abs() < 4e6).then(|| SubPx::from_f64(at));
        let place = PixelPoint::new(step(x + self.origin[0])?, step(y + self.origin[1])?);
        #[expect(clippy::cast_possible_truncation, reason = "rounded correctly")]
        let depth = depth as f32;
        Some((place, depth))
    }
}
