//! BUMPS: dents and bulges everywhere. Thesis 7.5.5.4; Perlin (1985) adds the gradient of the noise to the
//! normal.
//!
//! The surface is shaded as if it were raised by a height h made of noise: with n = noise(P), and t the upper
//! 1/(1 + SQUEEZE) of n stretched to 0..1, h = SCALE t² / (1 + SQUEEZE). SCALE makes the bumps higher,
//! SQUEEZE leaves fewer of them on a flat ground, and TURBULENCE adds finer ones to n, each octave with half
//! the slope of the one before. COLORS paints by t, the height above the ground; COLOR does nothing.

use glam::DVec3;

use super::color_range::{ColorRange, color_at};
use super::placement::Placement;
use super::spot::{Skin, Spot};
use super::squeeze::Squeeze;
use crate::noise::{noise_and_gradient, octave};
use crate::within::within;

/// Octaves of the noise with TURBULENCE: finer ones would be seen as grain, not as bumps.
const OCTAVES: u32 = 4;

#[derive(Clone, Debug)]
pub struct Bumps {
    pub placement: Placement,
    pub scale: f64,
    pub squeeze: Squeeze,
    pub turbulence: f64,
    pub ranges: Vec<ColorRange>,
}

impl Bumps {
    pub fn apply(&self, skin: Skin, spot: &Spot) -> Skin {
        let (t, gradient) = self.height(self.placement.point(spot.point));
        Skin {
            color: color_at(&self.ranges, within(t, 0.0, 1.0)).unwrap_or(skin.color),
            normal: self.placement.raised(skin.normal, gradient),
        }
    }

    /// t, and ∇h = 2 SCALE t ∇n.
    fn height(&self, point: DVec3) -> (f64, DVec3) {
        let (mut n, mut slope) = noise_and_gradient(point);
        if self.turbulence != 0.0 {
            for i in 1..OCTAVES {
                let (finer, finer_slope) = noise_and_gradient(octave(point, i));
                let frequency = f64::from(1u32 << i);
                n += self.turbulence * (finer - 0.5) / (frequency * frequency);
                slope += self.turbulence * finer_slope / frequency;
            }
        }
        let t = self.squeeze.apply(n);
        (t, 2.0 * self.scale * t * slope)
    }
}
