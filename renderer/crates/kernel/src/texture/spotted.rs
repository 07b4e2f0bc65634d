//! SPOTTED: blotches about a unit wide. Thesis 3.5 and 7.5.5.4; Perlin (1985).
//!
//! A cubic blend, by the noise, from the surface's colour to the texture's: t = 3s² - 2s³ with s = SCALE
//! noise(P), cut off at 1. A larger SCALE lets the blotches grow together.

use glam::DVec3;

use super::placement::Placement;
use super::spot::Spot;
use super::tint::Tint;
use crate::noise::{cubic, noise};
use crate::within::within;

#[derive(Clone, Debug)]
pub struct Spotted {
    pub placement: Placement,
    pub tint: Tint,
    pub scale: f64,
}

impl Spotted {
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        let n = noise(self.placement.point(spot.point));
        self.tint.over(surface, cubic(within(self.scale * n, 0.0, 1.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::tint::plain;
    use glam::DMat4;

    #[test]
    fn scale_makes_it_denser() {
        let at = |scale, i: u32| {
            let spotted =
                Spotted { placement: Placement::new(DMat4::IDENTITY), tint: plain(DVec3::ONE), scale };
            let [x, y, z] = [0.31, 0.17, 0.23].map(|step| f64::from(i) * step);
            spotted.color(DVec3::ZERO, &Spot::at(x, y, z)).x
        };
        for i in 0..100 {
            assert!(at(0.0, i) == 0.0 && at(0.7, i) <= at(1.0, i) && at(1.0, i) <= at(2.0, i));
        }
        assert!((0..100).any(|i| at(2.0, i) == 1.0) && (0..100).all(|i| at(0.7, i) < 1.0));
    }
}
