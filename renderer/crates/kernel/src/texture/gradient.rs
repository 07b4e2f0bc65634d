//! GRADIENT: a colour that changes with elevation, such as a mountain's from its foot to its top. Thesis
//! 7.5.5.4.
//!
//! t is the share of the scene's height, from its lowest to its highest z without planes, plus TURBULENCE
//! f(P) / 2, where f is noise summed over octaves (`fractal`, -1 to 1): a TURBULENCE of 1 shifts the
//! elevation by up to half of the scene's height. LOCAL and TRANSFORM move that noise and nothing else.

use glam::DVec3;

use super::heights::Heights;
use super::placement::Placement;
use super::spot::Spot;
use super::tint::Tint;
use crate::noise::fractal;

#[derive(Clone, Debug)]
pub struct Gradient {
    pub placement: Placement,
    pub tint: Tint,
    /// None in a scene without finite shapes, which keeps its colours.
    pub heights: Option<Heights>,
    pub turbulence: f64,
}

impl Gradient {
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        let Some(heights) = self.heights else {
            return surface;
        };
        let mut t = heights.share(spot.point.z);
        if self.turbulence != 0.0 {
            t += 0.5 * self.turbulence * fractal(self.placement.point(spot.point));
        }
        self.tint.over_known(surface, t, heights.share_of(spot.uncertainty))
    }
}
