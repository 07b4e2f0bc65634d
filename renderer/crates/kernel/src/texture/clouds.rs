//! CLOUDS: a sky of clouds, layered parallel to the xy plane. Thesis 7.5.5.4.
//!
//! c = 1/2 + n₀ + TURBULENCE (n₁/2 + n₂/4 + ...), where nᵢ is the signed noise at 2ⁱ times the frequency, -1
//! to 1, with z three times as fast as x and y, so that clouds are wide and flat. Without TURBULENCE they are
//! round puffs, with it torn as Perlin's sums over octaves are (1985). SQUEEZE thins them out: only the upper
//! 1/(1 + SQUEEZE) of c is cloud, stretched to 0..1, and t is a cubic of that.

use glam::DVec3;

use super::placement::Placement;
use super::spot::Spot;
use super::squeeze::Squeeze;
use super::tint::Tint;
use crate::noise::{OCTAVES, cubic, noise, octave};
use crate::within::within;

/// How flat the clouds are.
const FLATNESS: DVec3 = DVec3::new(1.0, 1.0, 3.0);

#[derive(Clone, Debug)]
pub struct Clouds {
    pub placement: Placement,
    pub tint: Tint,
    pub turbulence: f64,
    pub squeeze: Squeeze,
}

impl Clouds {
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        let cover = within(self.cover(self.placement.point(spot.point)), 0.0, 1.0);
        self.tint.over(surface, cubic(self.squeeze.apply(cover)))
    }

    fn cover(&self, point: DVec3) -> f64 {
        let p = FLATNESS * point;
        let signed = |i| 2.0 * noise(octave(p, i)) - 1.0;
        let mut sum = signed(0);
        if self.turbulence != 0.0 {
            let finer: f64 = (1..OCTAVES).map(|i| signed(i) / f64::from(1u32 << i)).sum();
            sum += self.turbulence * finer;
        }
        0.5 + sum
    }
}
