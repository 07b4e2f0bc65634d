//! The triangle: a TRIANGLE, or a facet of POLYGONS or TERRAIN. Thesis 3.3.5 and 4.3.3.
//!
//! The straight test decides by the signs of three volumes, one an edge, after Möller's and Trumbore's successors
//! that share edge terms between neighbours: an edge's term has the same size and the opposite sign in the facet
//! next door, so that no ray slips through between two facets.

use glam::DVec3;

use crate::ray::Ray;
use crate::within::within;

/// Distance along the ray to the triangle with these corners, from either side.
#[inline(always)] // It is called for every facet of every leaf.
pub fn intersect(corners: [&DVec3; 3], ray: &Ray) -> Option<f64> {
    let [a, b, c] = corners.map(|&corner| corner - ray.origin);
    let d = ray.direction;
    let along_bc = d.dot(b.cross(c));
    let along_ca = d.dot(c.cross(a));
    let along_ab = d.dot(a.cross(b));
    // One branch, because none of these can be foreseen.
    let inside = ((along_bc >= 0.0) & (along_ca >= 0.0) & (along_ab >= 0.0))
        | ((along_bc <= 0.0) & (along_ca <= 0.0) & (along_ab <= 0.0));
    if !inside {
        return None;
    }
    let normal = (a - b).cross(c - b);
    let t = b.dot(normal) / d.dot(normal);
    (t > ray.from && t < f64::INFINITY).then_some(t)
}

/// The u and v of I = P + u U + v V for a point of the plane, each within 0..1 for a point of the shape.
pub fn affine_coordinates(p: DVec3, u: DVec3, v: DVec3, point: DVec3) -> (f64, f64) {
    let w = point - p;
    let normal = u.cross(v);
    let area = normal.length_squared();
    let (s, t) = (w.cross(v).dot(normal) / area, u.cross(w).dot(normal) / area);
    (within(s, 0.0, 1.0), within(t, 0.0, 1.0))
}
