//! The infinite plane. Thesis 3.3.4 (straight rays) and 4.3.2 (curved ones).

use glam::DVec3;

use super::geometry::{Bounds, Geometry};
use crate::optics::crossing::{Crossing, Range, meet_line};
use crate::optics::path::Path;
use crate::optics::radial_plane::{Line, RadialPlane};
use crate::ray::Ray;

#[derive(Clone, Copy, Debug)]
pub struct Plane {
    point: DVec3,
    /// Unit normal; zero where it has no direction.
    normal: DVec3,
}

impl Plane {
    /// The plane through P along U and V.
    pub fn spanned(point: DVec3, u: DVec3, v: DVec3) -> Self {
        Self { point, normal: u.cross(v).normalize_or_zero() }
    }

    /// The line that is left of it in a radial plane; None where the two are parallel.
    fn cut(&self, plane: &RadialPlane) -> Option<Line> {
        let a = self.normal.x * plane.radial.x + self.normal.y * plane.radial.y;
        let c = self.normal.z;
        let (x, y) = (plane.origin.x - self.point.x, plane.origin.y - self.point.y);
        let d = self.normal.x * x + self.normal.y * y - c * self.point.z;
        (a != 0.0 || c != 0.0).then_some(Line { a, c, d })
    }
}

impl Geometry for Plane {
    fn bounds(&self) -> Bounds {
        if self.point.is_finite() && self.normal != DVec3::ZERO { Bounds::Endless } else { Bounds::Nowhere }
    }

    /// t = N.(P - O) / N.D (thesis eq. 3.4).
    fn meet(&self, ray: &Ray, own: bool) -> Option<f64> {
        if own {
            return None;
        }
        let t = self.normal.dot(self.point - ray.origin) / self.normal.dot(ray.direction);
        (t > ray.from && t < f64::INFINITY).then_some(t)
    }

    fn meet_curve(&self, plane: &RadialPlane, path: &mut Path, range: &mut Range) -> Option<Crossing> {
        meet_line(path, &self.cut(plane)?, range)
    }

    fn normal(&self, _point: DVec3) -> DVec3 {
        self.normal
    }

    fn uv(&self, _point: DVec3) -> Option<(f64, f64)> {
        None
    }
}
