//! Coordinates within flat shapes.

use glam::DVec3;

use crate::within::within;

/// The u and v of I = P + u U + v V for a point of the plane, each within 0..1 for a point of the shape.
pub fn affine_coordinates(p: DVec3, u: DVec3, v: DVec3, point: DVec3) -> (f64, f64) {
    let w = point - p;
    let normal = u.cross(v);
    let area = normal.length_squared();
    let (s, t) = (w.cross(v).dot(normal) / area, u.cross(w).dot(normal) / area);
    (within(s, 0.0, 1.0), within(t, 0.0, 1.0))
}
