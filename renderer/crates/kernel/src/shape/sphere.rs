//! The sphere. Thesis 3.3.3 (straight rays) and 4.3.1 (curved ones); u and v as in 7.5.5.4, UBLEND.

use glam::{DVec2, DVec3};

use super::geometry::{Bounds, Geometry};
use crate::optics::crossing::{Crossing, Range, meet_circle};
use crate::optics::path::Path;
use crate::optics::radial_plane::{Circle, RadialPlane};
use crate::ray::Ray;
use crate::within::within;

#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    pub center: DVec3,
    pub radius: f64,
    /// Unit vector to the north pole, where u is 0.
    pub pole: DVec3,
    /// Unit vector to where v is 0, at right angles to the pole.
    pub equator: DVec3,
}

impl Sphere {
    /// The circle that a radial plane cuts out: r_c^2 = r_s^2 - d^2.
    fn cut(&self, plane: &RadialPlane) -> Option<Circle> {
        let d = plane.beside(self.center);
        let radius_squared = (self.radius - d) * (self.radius + d);
        (radius_squared > 0.0).then(|| Circle {
            center: DVec2::new(plane.along(self.center), self.center.z),
            radius: radius_squared.sqrt(),
        })
    }
}

impl Geometry for Sphere {
    fn bounds(&self) -> Bounds {
        if self.center.is_finite() && self.radius > 0.0 && self.radius < f64::INFINITY {
            let reach = DVec3::splat(self.radius);
            Bounds::Box { low: self.center - reach, high: self.center + reach }
        } else {
            Bounds::Nowhere
        }
    }

    /// Nearest distance at which the ray enters or leaves: t = D.R -+ sqrt(r^2 - d^2), R = P - O. A ray that only
    /// grazes does not hit. One that starts on this sphere can meet only its other side, at 2 D.R.
    fn meet(&self, ray: &Ray, own: bool) -> Option<f64> {
        let to_center = self.center - ray.origin;
        let along = to_center.dot(ray.direction);
        if own {
            let t = 2.0 * along;
            return (t > 1e-9 * self.radius).then_some(t);
        }
        // d^2 from the foot of the perpendicular, not |R|^2 - (R.D)^2: far spheres keep their digits.
        let foot = to_center - along * ray.direction;
        let half_chord_squared = self.radius * self.radius - foot.length_squared();
        if half_chord_squared.is_nan() || half_chord_squared <= 0.0 {
            return None;
        }
        let half_chord = half_chord_squared.sqrt();
        let (near, far) = (along - half_chord, along + half_chord);
        if near > ray.from {
            Some(near)
        } else if far > ray.from {
            Some(far)
        } else {
            None
        }
    }

    fn meet_curve(&self, plane: &RadialPlane, path: &mut Path, range: &mut Range) -> Option<Crossing> {
        meet_circle(path, &self.cut(plane)?, range)
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        (point - self.center).normalize_or_zero()
    }

    /// u from the north pole (0) to the south pole (1), v counter-clockwise from the equator vector, in turns.
    fn uv(&self, point: DVec3) -> Option<(f64, f64)> {
        let normal = self.normal(point);
        let u = within(normal.dot(self.pole), -1.0, 1.0).acos() / std::f64::consts::PI;
        let east = self.pole.cross(self.equator);
        let turn = normal.dot(east).atan2(normal.dot(self.equator)) / std::f64::consts::TAU;
        Some((u, if turn < 0.0 { turn + 1.0 } else { turn }))
    }
}
