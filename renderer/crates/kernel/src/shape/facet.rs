//! The triangle: a TRIANGLE, or a facet of POLYGONS or TERRAIN. Thesis 3.3.5 and 4.3.3.
//!
//! The straight test decides by the signs of three volumes, one an edge, after Möller's and Trumbore's successors
//! that share edge terms between neighbours: an edge's term has the same size and the opposite sign in the facet
//! next door, so that no ray slips through between two facets.

use glam::DVec3;

use super::affine::affine_coordinates;
use super::geometry::{Bounds, Geometry};
use crate::optics::crossing::{Crossing, Range, meet_segment};
use crate::optics::path::Path;
use crate::optics::radial_plane::RadialPlane;
use crate::ray::Ray;

/// A triangle by its corners VERTEX1, VERTEX2 and VERTEX3, and the normals there where it is smooth. Facets are many:
/// `Shapes` stores them as rows of numbers, and makes one of these where it is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Facet<'a> {
    pub corners: [&'a DVec3; 3],
    pub normals: Option<[DVec3; 3]>,
}

/// The corners of a TRIANGLE from its P, U and V.
pub fn corners(point: DVec3, u: DVec3, v: DVec3) -> [DVec3; 3] {
    [point + v, point, point + u]
}

impl Facet<'_> {
    /// P, U and V: the corner VERTEX2, and the ways from it to VERTEX3 and VERTEX1.
    fn spanned(&self) -> (DVec3, DVec3, DVec3) {
        let [&first, &second, &third] = self.corners;
        (second, third - second, first - second)
    }
}

impl Geometry for Facet<'_> {
    fn bounds(&self) -> Bounds {
        let [&a, &b, &c] = self.corners;
        let area = (a - b).cross(c - b).length_squared();
        if area > 0.0 && area < f64::INFINITY { Bounds::about(&[a, b, c]) } else { Bounds::Nowhere }
    }

    #[inline(always)] // It is called for every facet of every leaf.
    fn meet(&self, ray: &Ray, own: bool) -> Option<f64> {
        if own {
            return None;
        }
        let [a, b, c] = self.corners.map(|&corner| corner - ray.origin);
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

    #[inline]
    fn meet_curve(&self, plane: &RadialPlane, path: &mut Path, range: &mut Range) -> Option<Crossing> {
        meet_segment(path, &plane.cut(self.corners)?, range)
    }

    fn normal(&self, _point: DVec3) -> DVec3 {
        let (_, u, v) = self.spanned();
        u.cross(v).normalize_or_zero()
    }

    fn shading_normal(&self, point: DVec3) -> Option<DVec3> {
        let [n1, n2, n3] = self.normals?;
        let (p, u, v) = self.spanned();
        let (s, t) = affine_coordinates(p, u, v, point);
        (t * n1 + (1.0 - s - t) * n2 + s * n3).try_normalize()
    }

    fn uv(&self, point: DVec3) -> Option<(f64, f64)> {
        let (p, u, v) = self.spanned();
        Some(affine_coordinates(p, u, v, point))
    }
}
