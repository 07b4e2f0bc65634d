//! MARBLE: veins, a unit apart along y, that run along z and across x. Thesis 7.5.5.4; Perlin (1985).
//!
//! Perlin's marble is the sine of a coordinate that turbulence has shifted: t = (1 + cos 2πy') / 2 with y' =
//! y + TURBULENCE turbulence(P). A vein's middle is where y' is whole. SQUEEZE leaves the veins 1/(1 +
//! SQUEEZE) of the space.

use std::f64::consts::PI;

use glam::DVec3;

use super::placement::Placement;
use super::spot::Spot;
use super::squeeze::Squeeze;
use super::tint::Tint;
use crate::noise::turbulence;

#[derive(Clone, Debug)]
pub struct Marble {
    pub placement: Placement,
    pub tint: Tint,
    pub turbulence: f64,
    pub squeeze: Squeeze,
}

impl Marble {
    pub fn color(&self, surface: DVec3, spot: &Spot) -> DVec3 {
        let point = self.placement.point(spot.point);
        // dt/dy is at most π (1 + SQUEEZE).
        let uncertainty = PI * self.squeeze.factor() * self.placement.uncertainty(spot, point).y;
        self.tint.over_known(surface, self.value(point), uncertainty)
    }

    fn value(&self, p: DVec3) -> f64 {
        let shifted = if self.turbulence == 0.0 { p.y } else { p.y + self.turbulence * turbulence(p) };
        let from_vein = 2.0 * (shifted - shifted.round()).abs();
        0.5 - 0.5 * (PI * self.squeeze.apply(1.0 - from_vein)).cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::tint::plain;
    use glam::DMat4;

    fn marble(turbulence: f64, squeeze: f64) -> impl Fn(f64, f64, f64) -> f64 {
        let marble = Marble {
            placement: Placement::new(DMat4::IDENTITY),
            tint: plain(DVec3::ONE),
            turbulence,
            squeeze: Squeeze::new(squeeze),
        };
        move |x, y, z| marble.value(DVec3::new(x, y, z))
    }

    #[test]
    fn without_turbulence_it_is_a_sine_along_y() {
        let t = marble(0.0, 0.0);
        for i in 0..40 {
            let y = 0.1 * f64::from(i) - 2.0;
            assert!((t(7.0, y, -3.0) - 0.5 * (1.0 + (2.0 * PI * y).cos())).abs() < 1e-9);
        }
    }

    #[test]
    fn squeeze_thins_the_veins() {
        let t = marble(0.0, 1.0);
        assert!((t(0.0, 1.0, 0.0) - 1.0).abs() < 1e-9);
        assert!(t(0.0, 0.24, 0.0) > 0.0 && t(0.0, 0.26, 0.0) == 0.0 && t(0.0, 0.74, 0.0) == 0.0);
    }

    #[test]
    fn turbulence_shifts_the_veins() {
        let (x, z) = (0.4, 0.7);
        let shift = 0.5 * turbulence(DVec3::new(x, 0.2, z));
        let expected = marble(0.0, 0.0)(0.0, 0.2 + shift, 0.0);
        assert!((marble(0.5, 0.0)(x, 0.2, z) - expected).abs() < 1e-9);
    }
}
