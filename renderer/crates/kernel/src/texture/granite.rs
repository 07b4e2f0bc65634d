//! GRANITE: grains of all sizes, without a direction. Thesis 7.5.5.4.
//!
//! t = TURBULENCE times the sum of |noise(4fP) - 1/2| / f over six octaves f = 1, 2, 4, ..., cut off at 1:
//! half of Perlin's turbulence (1985), at four times the lattice's frequency, as in POV-Ray 1 (1992). More
//! TURBULENCE makes the grains larger and denser; 0 leaves the surface as it is.

use glam::DVec3;

use super::placement::Placement;
use super::spot::Spot;
use super::tint::Tint;
use crate::noise::turbulence;

const GRAINS_A_UNIT: f64 = 4.0;

#[derive(Clone, Debug)]
pub struct Granite {
    pub placement: Placement,
    pub tint: Tint,
    pub turbulence: f64,
}

impl Granite {
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        if self.turbulence <= 0.0 {
            return surface;
        }
        let t = self.turbulence * 0.5 * turbulence(GRAINS_A_UNIT * self.placement.point(spot.point));
        self.tint.over(surface, t)
    }
}
