//! The rectangle (after a shearing transform, a parallelogram). Thesis 3.3.6 and 4.3.4.

use glam::DVec3;

use super::affine::affine_coordinates;
use super::geometry::{Bounds, Geometry};
use crate::optics::crossing::{Crossing, Range, meet_segment};
use crate::optics::path::Path;
use crate::optics::radial_plane::RadialPlane;
use crate::ray::Ray;

/// P + u U + v V, 0 <= u, v <= 1.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    pub point: DVec3,
    pub u: DVec3,
    pub v: DVec3,
}

impl Rectangle {
    fn corners(&self) -> [DVec3; 4] {
        let (p, u, v) = (self.point, self.u, self.v);
        [p, p + u, p + u + v, p + v]
    }
}

impl Geometry for Rectangle {
    fn bounds(&self) -> Bounds {
        let area = self.u.cross(self.v).length_squared();
        if area > 0.0 && area < f64::INFINITY && self.point.is_finite() {
            Bounds::about(&self.corners())
        } else {
            Bounds::Nowhere
        }
    }

    /// By eq. 3.4, 3.7 and 3.8.
    fn meet(&self, ray: &Ray, own: bool) -> Option<f64> {
        if own {
            return None;
        }
        let normal = self.u.cross(self.v);
        let slant = ray.direction.dot(normal);
        let to_point = self.point - ray.origin;
        let t = to_point.dot(normal) / slant;
        if !(t > ray.from && t < f64::INFINITY) {
            return None;
        }
        let u = -ray.direction.dot(to_point.cross(self.v)) / slant;
        let v = -ray.direction.dot(self.u.cross(to_point)) / slant;
        ((0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)).then_some(t)
    }

    #[inline]
    fn meet_curve(&self, plane: &RadialPlane, path: &mut Path, range: &mut Range) -> Option<Crossing> {
        meet_segment(path, &plane.cut(self.corners().each_ref())?, range)
    }

    fn normal(&self, _point: DVec3) -> DVec3 {
        self.u.cross(self.v).normalize_or_zero()
    }

    fn uv(&self, point: DVec3) -> Option<(f64, f64)> {
        Some(affine_coordinates(self.point, self.u, self.v, point))
    }
}
