//! The distance surfaces as triangles: what the papers gave to a GPU, to compare with, and to look
//! at.
//!
//! A cone becomes a fan. Its rim is a polygon of n corners inscribed in the circle of radius R, so
//! in the middle of a side it is too deep by R (1 − cos π/n)
//! ([Hoff et al., § 4](super#references)): that is the error asked for, and it is largest at the
//! rim. Corners are rounded to 1/256 pixel and given the depth of where they then lie.

use std::f64::consts::PI;

use super::{PixelPoint, SubPx, Surface};

/// Corners of a rim of `radius` pixels whose sides stay within `error` pixels of it; at least 3.
///
/// ```
/// assert_eq!(voromill::raster::mesh::rim_corners(300.0, 0.36), 65, "a cone 300 pixels wide of about 64 sides errs by a third of a pixel");
/// ```
#[must_use]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
pub fn rim_corners(radius: f64, error: f64) -> u32 {
    let ratio = (error / radius.max(f64::MIN_POSITIVE)).clamp(1e-9, 1.0);
    ((PI / libm::acos(1.0 - ratio)).ceil() as u32).max(3)
}

/// The fan of a cone: the distance to `apex` as far as `reach` pixels.
///
/// ```
/// use voromill::raster::{PixelPoint, Surface, mesh};
///
/// let fan = mesh::cone(PixelPoint::from_pixels(50, 50), 40.0, 0.5);
/// assert_eq!(fan.len() as u32, mesh::rim_corners(40.0, 0.5), "a triangle for each side of the rim");
/// assert!(fan.iter().all(|face| matches!(face, Surface::Triangle { depths: [0.0, ..], .. })), "from the apex");
/// ```
#[must_use]
pub fn cone(apex: PixelPoint, reach: f64, error: f64) -> Vec<Surface> {
    let rim = rim(apex, reach, error);
    let pairs = rim.iter().zip(rim.iter().cycle().skip(1));
    pairs.map(|(&(a, a_depth), &(b, b_depth))| triangle([apex, a, b], [0.0, a_depth, b_depth])).collect()
}

/// Two quads and a fan at each end: the distance to the segment from `from` to `to` as far as
/// `reach` pixels.
#[must_use]
pub fn curtain(from: PixelPoint, to: PixelPoint, reach: f64, error: f64) -> Vec<Surface> {
    let mut faces = cone(from, reach, error);
    let way = (to.x.to_pixels() - from.x.to_pixels(), to.y.to_pixels() - from.y.to_pixels());
    let length = (way.0 * way.0 + way.1 * way.1).sqrt();
    if length <= 0.0 {
        return faces;
    }
    faces.extend(cone(to, reach, error));
    for side in [reach, -reach] {
        let (x, y) = (-way.1 / length * side, way.0 / length * side);
        let (a, b) = (moved(from, x, y), moved(to, x, y));
        #[expect(clippy::cast_possible_truncation, reason = "rounded correctly")]
        let depth = reach as f32;
        faces.push(triangle([from, to, b], [0.0, 0.0, depth]));
        faces.push(triangle([from, b, a], [0.0, depth, depth]));
    }
    faces
}

/// The distance to a circle of `radius` pixels, inside to its centre and outside as far as `reach`
/// pixels.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "rounded correctly")]
pub fn ring(center: PixelPoint, radius: f64, reach: f64, error: f64) -> Vec<Surface> {
    let corners = rim_corners(radius + reach, error);
    let (inner, outer) = (round(center, radius, corners), round(center, radius + reach, corners));
    let mut faces = Vec::new();
    for i in 0..inner.len() {
        let next = (i + 1) % inner.len();
        let (a, b, c, d) = (inner[i], inner[next], outer[next], outer[i]);
        faces.push(triangle([center, a, b], [radius as f32, 0.0, 0.0]));
        faces.push(triangle([a, b, c], [0.0, 0.0, reach as f32]));
        faces.push(triangle([a, c, d], [0.0, reach as f32, reach as f32]));
    }
    faces
}

const fn triangle(corners: [PixelPoint; 3], depths: [f32; 3]) -> Surface {
    Surface::Triangle { corners, depths }
}

/// The corners of a rim with the distance of each, as it was rounded.
fn rim(center: PixelPoint, radius: f64, error: f64) -> Vec<(PixelPoint, f32)> {
    let corners = round(center, radius, rim_corners(radius, error)).into_iter();
    corners
        .map(|corner| {
            let x = corner.x.to_pixels() - center.x.to_pixels();
            let y = corner.y.to_pixels() - center.y.to_pixels();
            #[expect(clippy::cast_possible_truncation, reason = "rounded correctly")]
            let depth = (x * x + y * y).sqrt() as f32;
            (corner, depth)
        })
        .collect()
}

fn round(center: PixelPoint, radius: f64, corners: u32) -> Vec<PixelPoint> {
    let at = |i: u32| {
        let (sin, cos) = libm::sincos(2.0 * PI * f64::from(i) / f64::from(corners));
        moved(center, radius * cos, radius * sin)
    };
    (0..corners).map(at).collect()
}

/// A point moved by pixels, rounded to 1/256.
fn moved(point: PixelPoint, x: f64, y: f64) -> PixelPoint {
    let step = |at: SubPx, by: f64| SubPx::new(at.raw() + SubPx::from_f64(by).raw());
    PixelPoint::new(step(point.x, x), step(point.y, y))
}
