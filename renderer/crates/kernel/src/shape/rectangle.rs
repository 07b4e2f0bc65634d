//! The rectangle (after a shearing transform, a parallelogram). Thesis 3.3.6 and 4.3.4.

use glam::DVec3;

use super::triangle::affine_coordinates;
use super::{RadialPlane, Segment, cut};
use crate::ray::Ray;

/// P + u U + v V, 0 <= u, v <= 1.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    pub point: DVec3,
    pub u: DVec3,
    pub v: DVec3,
}

impl Rectangle {
    pub fn corners(&self) -> [DVec3; 4] {
        let (p, u, v) = (self.point, self.u, self.v);
        [p, p + u, p + u + v, p + v]
    }

    pub fn normal(&self) -> DVec3 {
        self.u.cross(self.v)
    }

    /// Distance along the ray, by eq. 3.4, 3.7 and 3.8.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<f64> {
        let normal = self.normal();
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
    pub fn cut(&self, plane: &RadialPlane) -> Option<Segment> {
        cut(plane, self.corners().each_ref())
    }

    pub fn uv(&self, point: DVec3) -> (f64, f64) {
        affine_coordinates(self.point, self.u, self.v, point)
    }
}
