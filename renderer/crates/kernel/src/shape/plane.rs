//! The infinite plane. Thesis 3.3.4 (straight rays) and 4.3.2 (curved ones).

use glam::DVec3;

use super::RadialPlane;
use crate::ray::Ray;

#[derive(Clone, Copy, Debug)]
pub struct Plane {
    pub point: DVec3,
    /// Unit normal.
    pub normal: DVec3,
}

/// The line a r + c z + d = 0 that a plane leaves in a radial plane (thesis eq. 4.5, measured from the eye).
#[derive(Clone, Copy, Debug)]
pub struct Line {
    pub a: f64,
    pub c: f64,
    pub d: f64,
}

impl Plane {
    /// t = N.(P - O) / N.D (thesis eq. 3.4).
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<f64> {
        let t = self.normal.dot(self.point - ray.origin) / self.normal.dot(ray.direction);
        (t > ray.from && t < f64::INFINITY).then_some(t)
    }

    /// None where the two planes are parallel.
    pub fn cut(&self, plane: &RadialPlane) -> Option<Line> {
        let a = self.normal.x * plane.radial.x + self.normal.y * plane.radial.y;
        let c = self.normal.z;
        let (x, y) = (plane.origin.x - self.point.x, plane.origin.y - self.point.y);
        let d = self.normal.x * x + self.normal.y * y - c * self.point.z;
        (a != 0.0 || c != 0.0).then_some(Line { a, c, d })
    }
}
