//! RIPPLES: rings of waves about one or more sources, all of their full height. Thesis 7.5.5.4.
//!
//! The surface is shaded as if it were raised by the sum of the waves' heights, after Perlin (1985). It stays
//! flat in its outline. Without a WAVE nothing changes.

use glam::DVec3;

use super::placement::Placement;
use super::spot::Spot;
use super::wave::Wave;

#[derive(Clone, Debug)]
pub struct Ripples {
    pub placement: Placement,
    pub waves: Vec<Wave>,
}

impl Ripples {
    pub fn normal(&self, normal: DVec3, spot: &Spot) -> DVec3 {
        let point = self.placement.point(spot.point);
        let gradient = self.waves.iter().map(|wave| wave.gradient(point)).sum();
        self.placement.raised(normal, gradient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat4;

    #[test]
    fn sources_add_up() {
        let wave = |x| Wave { center: DVec3::X * x, amplitude: 0.2, freq: 2.0, phase: 0.3, damp: 0.1 };
        let placement = Placement::new(DMat4::IDENTITY);
        let at = |waves: &[Wave]| {
            let ripples = Ripples { placement, waves: waves.to_vec() };
            ripples.normal(DVec3::Z, &Spot::at(0.0, 1.0, 0.0))
        };
        // Half-way between two equal sources the slopes along x cancel.
        assert!(at(&[wave(1.0), wave(-1.0)]).x.abs() < 1e-15);
        assert!(at(&[wave(1.0)]).x.abs() > 0.05);
        assert_eq!(at(&[]), DVec3::Z);
    }
}
