//! The problem of Apollonius: the points equally far from three forms. Every event is one.
//!
//! With the distance s as a third unknown a line is a plane, n · p − s = h, and a circle a cone, |p
//! − c| = q ± s. The difference of two cones is a plane again, so two linear equations leave a line
//! in space; it meets the cone that is left twice. Newton's method then takes the residue of the
//! distances to rounding.

use super::form::{Form, clockwise};
use crate::voronoi::plane::Spot;

/// A place with its distance.
pub(super) type Solution = (Spot, f64);

/// e · (x, y, s) + k = 0.
type Plane = ([f64; 3], f64);

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn scaled((e, k): Plane) -> Plane {
    let length = dot(e, e).sqrt();
    if length > 0.0 { (e.map(|x| x / length), k / length) } else { (e, k) }
}

/// The points equally far from three forms, wherever their feet lie; at most two.
pub(super) fn solve(forms: [&Form; 3]) -> [Option<Solution>; 2] {
    solve_within(forms, (Spot::default(), f64::INFINITY))
}

/// Those no farther than this from a place; others, too, but not all.
pub(super) fn solve_within(forms: [&Form; 3], (middle, reach): (Spot, f64)) -> [Option<Solution>; 2] {
    let base = forms.iter().position(|form| matches!(form, Form::Circle { .. }));
    let (origin, raw) = match base {
        Some(i) => on_cone(forms, i),
        None => on_planes(forms),
    };
    raw.map(|root| {
        let [x, y, s] = root?;
        let p = origin + Spot::new(x, y);
        let may_be = (p - middle).length() <= reach + f64::from(POLISHES) * most(s);
        may_be.then(|| polished(forms, p, s)).flatten()
    })
}

/// The plane of a line, from `origin`.
fn plane_of(from: Spot, along: Spot, origin: Spot) -> Plane {
    let n = clockwise(along);
    scaled(([n.x, n.y, -1.0], -n.dot(from - origin)))
}

fn on_planes(forms: [&Form; 3]) -> (Spot, [Option<[f64; 3]>; 2]) {
    let Form::Line { from: origin, .. } = *forms[0] else { return (Spot::default(), [None; 2]) };
    let planes = forms.map(|form| match *form {
        Form::Line { from, along, .. } => plane_of(from, along, origin),
        Form::Circle { .. } => ([0.0; 3], 0.0),
    });
    let [(e, k), (f, l), (g, m)] = planes;
    let (fg, ge, ef) = (cross(f, g), cross(g, e), cross(e, f));
    let volume = dot(e, fg);
    if volume.abs() < 1e-14 {
        return (origin, [None; 2]);
    }
    let root = [0, 1, 2].map(|i| -(fg[i] * k + ge[i] * l + ef[i] * m) / volume);
    (origin, [Some(root), None])
}

fn on_cone(forms: [&Form; 3], base: usize) -> (Spot, [Option<[f64; 3]>; 2]) {
    let Form::Circle { center: origin, radius, hollow, .. } = *forms[base] else {
        return (Spot::default(), [None; 2]);
    };
    let sign = |hollow: bool| if hollow { -1.0 } else { 1.0 };
    let own = sign(hollow);
    let plane = |form: &Form| match *form {
        Form::Line { from, along, .. } => plane_of(from, along, origin),
        Form::Circle { center, radius: q, hollow: h, .. } => {
            let c = center - origin;
            let k = c.dot(c) + (radius - q) * (radius + q);
            scaled(([-2.0 * c.x, -2.0 * c.y, -2.0 * (sign(h) * q - own * radius)], k))
        }
    };
    let [(e, k), (f, l)] = [plane(forms[(base + 1) % 3]), plane(forms[(base + 2) % 3])];
    let way = cross(e, f);
    let squared = dot(way, way);
    if squared < 1e-24 {
        return (origin, [None; 2]);
    }
    let (fw, we) = (cross(f, way), cross(way, e));
    let start = [0, 1, 2].map(|i| -(k * fw[i] + l * we[i]) / squared);
    let length = squared.sqrt();
    let d = way.map(|x| x / length);
    let (g0, g1) = (radius + own * start[2], own * d[2]);
    let a = d[0] * d[0] + d[1] * d[1] - d[2] * d[2];
    let b = start[0] * d[0] + start[1] * d[1] - g0 * g1;
    let c = start[0] * start[0] + start[1] * start[1] - g0 * g0;
    let mut under = b * b - a * c;
    if under < 0.0 {
        // A touch that rounding has parted.
        if under < -1e-10 * (b * b + (a * c).abs()) {
            return (origin, [None; 2]);
        }
        under = 0.0;
    }
    let q = -(b + under.sqrt().copysign(b));
    let at = |t: f64| t.is_finite().then(|| [0, 1, 2].map(|i| start[i] + d[i] * t));
    (origin, [at(q / a), at(c / q)])
}

/// How many of Newton's steps are taken. Chosen: the second finds rounding alone.
const POLISHES: u32 = 2;

/// How long one of them may be.
fn most(s: f64) -> f64 {
    1.0 + 1e-3 * s.abs()
}

/// The solution nearest to a rough one; none on the wrong sheet of a cone.
fn polished(forms: [&Form; 3], mut p: Spot, mut s: f64) -> Option<Solution> {
    // What Newton's steps may have to make good.
    let slack = 1e-3 + 1e-9 * s.abs();
    let on_sheet = |form: &&Form, s: f64| match **form {
        Form::Circle { radius, hollow, .. } => {
            let reach = if hollow { radius - s } else { radius + s };
            reach >= -slack
        }
        Form::Line { .. } => true,
    };
    if s < -slack || !forms.iter().all(|form| on_sheet(form, s)) {
        return None;
    }
    for _ in 0..POLISHES {
        let d = forms.map(|form| form.distance(p));
        let away = forms.map(|form| form.away(p));
        let (u, v) = (away[0] - away[2], away[1] - away[2]);
        let volume = u.cross(v);
        if volume.abs() < 1e-9 {
            break;
        }
        let (e, f) = (d[2] - d[0], d[2] - d[1]);
        let step = Spot::new(e * v.y - f * u.y, f * u.x - e * v.x) * (1.0 / volume);
        if step.length() > most(s) {
            break;
        }
        p = p + step;
    }
    s = forms[0].distance(p);
    (p.x.is_finite() && p.y.is_finite()).then_some((p, s))
}
