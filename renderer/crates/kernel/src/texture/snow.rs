//! SNOW: it fell straight down and lies on top of things. Thesis 7.5.5.4.
//!
//! Snow lies where z is at least (Z_max - Z_min) e + Z_min, the scene's extents, and the surface is no
//! steeper than SLOPE. e = ELEVATION - SCALE (1 - N_z) + TURBULENCE f(P) / 2: the steeper the surface, the
//! further the snow has slid down, and noise summed over octaves (`fractal`, f from -1 to 1) shifts the line
//! by up to half of the scene's height. LOCAL and TRANSFORM move that noise and nothing else. N is the normal
//! on the side one sees, as the textures before have left it: nothing lies on the underside.

use glam::DVec3;

use super::heights::Heights;
use super::placement::Placement;
use super::spot::Spot;
use crate::noise::fractal;

/// Within which the coordinates of a normal are known.
const UNCERTAINTY: f64 = 1e-12;

#[derive(Clone, Debug)]
pub struct Snow {
    pub placement: Placement,
    pub color: DVec3,
    /// None in a scene without finite shapes, where there is no snow.
    pub heights: Option<Heights>,
    pub elevation: f64,
    pub scale: f64,
    /// Cosine of the steepest angle that holds snow.
    pub steepest: f64,
    pub turbulence: f64,
}

impl Snow {
    pub fn color(&self, surface: DVec3, normal: DVec3, spot: &Spot) -> DVec3 {
        let Some(heights) = self.heights else {
            return surface;
        };
        // A slope of just SLOPE holds snow, but for an upright one.
        if normal.z < self.steepest - UNCERTAINTY || (self.steepest < UNCERTAINTY && normal.z < UNCERTAINTY) {
            return surface;
        }
        let mut line = self.elevation - self.scale * (1.0 - normal.z);
        if self.turbulence != 0.0 {
            line += 0.5 * self.turbulence * fractal(self.placement.point(spot.point));
        }
        if spot.point.z + spot.uncertainty >= heights.at(line) { self.color } else { surface }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat4;

    fn snow() -> Snow {
        Snow {
            placement: Placement::new(DMat4::IDENTITY),
            color: DVec3::ONE,
            heights: Some(Heights { low: -20.0, high: 80.0 }),
            elevation: 0.7,
            scale: 0.0,
            steepest: 50f64.to_radians().cos(),
            turbulence: 0.0,
        }
    }

    fn lies(snow: &Snow, z: f64, slope: f64) -> bool {
        let (sin, cos) = slope.to_radians().sin_cos();
        let spot = Spot::at(3.3, 1.7, z);
        snow.color(DVec3::ZERO, DVec3::new(sin, 0.0, cos), &spot) == DVec3::ONE
    }

    #[test]
    fn it_lies_above_the_elevation_and_where_it_is_not_too_steep() {
        assert!(lies(&snow(), 50.1, 0.0) && !lies(&snow(), 49.9, 0.0));
        assert!(lies(&snow(), 70.0, 49.9) && !lies(&snow(), 70.0, 50.1));
        assert!(!lies(&snow(), 70.0, 180.0));
        assert!(!lies(&Snow { heights: None, ..snow() }, 70.0, 0.0));
    }

    #[test]
    fn a_roof_at_the_very_elevation_and_slope_is_white_as_a_whole() {
        let top = Snow { elevation: 1.0, steepest: 1.0, ..snow() };
        for (z, normal) in [(80.0 - 1e-13, 1.0), (80.0 + 1e-13, 1.0 - 1e-16), (80.0, 1.0)] {
            let spot = Spot { uncertainty: 1e-12, ..Spot::at(3.3, 1.7, z) };
            assert_eq!(top.color(DVec3::ZERO, normal * DVec3::Z, &spot), DVec3::ONE);
        }
        let upright = Snow { steepest: 90f64.to_radians().cos(), ..snow() };
        for z in [0.0, 1e-16, -1e-16] {
            let spot = Spot::at(3.3, 1.7, 70.0);
            assert_eq!(upright.color(DVec3::ZERO, DVec3::new(1.0, 0.0, z), &spot), DVec3::ZERO);
        }
    }

    #[test]
    fn it_slides_down_slopes_by_scale() {
        // cos 40° = 0.766: the line is lowered by 0.234 SCALE of 100.
        let sliding = Snow { scale: 0.5, ..snow() };
        assert!(!lies(&sliding, 49.9, 0.0));
        assert!(lies(&sliding, 38.5, 40.0) && !lies(&sliding, 38.1, 40.0));
    }

    #[test]
    fn turbulence_shifts_the_line_by_up_to_half() {
        let shift = 50.0 * 0.4 * fractal(DVec3::new(3.3, 1.7, 45.0));
        let windy = Snow { turbulence: 0.4, elevation: 0.65 - shift / 100.0 + 1e-9, ..snow() };
        assert!(!lies(&windy, 45.0, 0.0));
        assert!(lies(&Snow { elevation: windy.elevation - 2e-9, ..windy.clone() }, 45.0, 0.0));
    }
}
