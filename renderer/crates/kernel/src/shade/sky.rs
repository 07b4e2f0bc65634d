//! SKY: the CIE luminance of clear and overcast skies on a great sphere about the origin. Thesis 7.5.5.1.
//!
//! Clear: Kittler's distribution (CIE 1973), overcast: Moon's and Spencer's (1942), both relative to the zenith.
//! The lower hemisphere mirrors the upper.

use crate::within::within;
use glam::DVec3;

#[derive(Clone, Copy, Debug)]
pub struct Sky {
    pub radius: f64,
    pub intensity: f64,
    pub zenith_color: DVec3,
    pub horizon_color: DVec3,
    /// 0 clear .. 1 overcast.
    pub overcast: f64,
    /// Unit vector toward the sun.
    pub sun: DVec3,
}

/// A point of the sky seen along a ray.
#[derive(Clone, Copy, Debug)]
pub struct SkyPoint {
    /// Unit vector from the origin, mirrored into the upper hemisphere.
    pub direction: DVec3,
    /// Distance from the ray's origin; infinite for a ray that starts outside of the sphere.
    pub distance: f64,
}

impl Sky {
    pub fn seen_along(&self, origin: DVec3, direction: DVec3) -> SkyPoint {
        let along = origin.dot(direction);
        let foot = origin - along * direction;
        let half_chord_squared = self.radius * self.radius - foot.length_squared();
        let inside = origin.length_squared() <= self.radius * self.radius;
        let (place, distance) = if inside && half_chord_squared >= 0.0 {
            let t = half_chord_squared.sqrt() - along;
            (origin + t * direction, t)
        } else {
            (direction, f64::INFINITY)
        };
        let unit = place.try_normalize().unwrap_or(DVec3::Z);
        SkyPoint { direction: DVec3::new(unit.x, unit.y, unit.z.abs()), distance }
    }

    /// Colour of the sky toward a unit vector of the upper hemisphere.
    pub fn color(&self, toward: DVec3) -> DVec3 {
        let sine_of_elevation = within(toward.z, 0.0, 1.0);
        let luminance =
            self.clear(toward) * (1.0 - self.overcast) + overcast(sine_of_elevation) * self.overcast;
        let height = sine_of_elevation.asin() / std::f64::consts::FRAC_PI_2;
        self.intensity * luminance * self.horizon_color.lerp(self.zenith_color, height)
    }

    /// Kittler: (0.91 + 10 e^(-3γ) + 0.45 cos²γ)(1 - e^(-0.32/cos θ)) over the same at the zenith, γ the angle to
    /// the sun, θ the point's zenith angle.
    fn clear(&self, toward: DVec3) -> f64 {
        let indicatrix = |angle: f64| 0.91 + 10.0 * (-3.0 * angle).exp() + 0.45 * angle.cos().powi(2);
        let gradation = |cosine: f64| 1.0 - (-0.32 / cosine).exp();
        let to_sun = within(toward.dot(self.sun), -1.0, 1.0).acos();
        let sun_zenith = within(self.sun.z, -1.0, 1.0).acos();
        indicatrix(to_sun) * gradation(toward.z.max(0.0)) / (indicatrix(sun_zenith) * gradation(1.0))
    }
}

/// Moon and Spencer: (1 + 2 cos θ)/3.
fn overcast(cosine: f64) -> f64 {
    (1.0 + 2.0 * cosine) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const SKY: Sky = Sky {
        radius: 1e8,
        intensity: 0.9,
        zenith_color: DVec3::Z,
        horizon_color: DVec3::ONE,
        overcast: 0.0,
        sun: DVec3::Z,
    };

    #[test]
    fn the_zenith_has_the_zenith_colour_clear_or_overcast() {
        for overcast in [0.0, 0.3, 1.0] {
            let sky = Sky { overcast, sun: DVec3::new(0.6, 0.0, 0.8), ..SKY };
            assert!((sky.color(DVec3::Z) - 0.9 * DVec3::Z).abs().max_element() < 1e-12);
        }
    }

    #[test]
    fn an_overcast_horizon_has_a_third_of_the_zenith() {
        let sky = Sky { overcast: 1.0, ..SKY };
        assert!((sky.color(DVec3::X) - DVec3::splat(0.3)).abs().max_element() < 1e-12);
    }

    #[test]
    fn the_lower_hemisphere_mirrors_the_upper() {
        let down = SKY.seen_along(DVec3::ZERO, DVec3::new(0.0, 0.6, -0.8));
        assert_eq!(down.direction, DVec3::new(0.0, 0.6, 0.8));
        assert!((down.distance - 1e8).abs() < 1e-3);
    }

    #[test]
    fn from_outside_the_rays_direction_counts() {
        let seen = SKY.seen_along(DVec3::new(2e8, 0.0, 0.0), DVec3::Y);
        assert_eq!((seen.direction, seen.distance), (DVec3::Y, f64::INFINITY));
    }
}
