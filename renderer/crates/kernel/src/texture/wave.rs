//! WAVE: a source of spherical waves. Thesis 7.5.5.4.
//!
//! The height at a point P is A sin d with d = |P - C| FREQ + PHASE in radians and A = AMPLITUDE e^(-DAMP d):
//! waves are 2π / FREQ long, and a PHASE of 2π moves them by one length, inwards.

use glam::DVec3;

#[derive(Clone, Copy, Debug)]
pub struct Wave {
    pub center: DVec3,
    pub amplitude: f64,
    pub freq: f64,
    pub phase: f64,
    pub damp: f64,
}

impl Wave {
    /// The height's gradient: ∇h = A FREQ (cos d - DAMP sin d) (P - C)/|P - C|; none at the centre.
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        let away = point - self.center;
        let d = away.length() * self.freq + self.phase;
        let amplitude = self.amplitude * (-self.damp * d).exp();
        amplitude * self.freq * (d.cos() - self.damp * d.sin()) * away.normalize_or_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_gradient_is_the_heights(
            x in -5.0..5.0f64, y in -5.0..5.0f64, z in 0.1..5.0f64,
            freq in 0.1..4.0f64, phase in -5.0..5.0f64, damp in 0.0..0.5f64,
        ) {
            let wave = Wave { center: DVec3::new(0.5, -0.25, -1.0), amplitude: 0.3, freq, phase, damp };
            let height = |p: DVec3| {
                let d = (p - wave.center).length() * freq + phase;
                0.3 * (-damp * d).exp() * d.sin()
            };
            let (p, step) = (DVec3::new(x, y, z), 1e-5);
            for axis in DVec3::AXES {
                let slope = (height(p + step * axis) - height(p - step * axis)) / (2.0 * step);
                let found = wave.gradient(p).dot(axis);
                prop_assert!((slope - found).abs() < 1e-6 * (1.0 + found.abs()), "{slope} {found}");
            }
        }
    }

    #[test]
    fn the_center_is_flat() {
        let wave = Wave { center: DVec3::ONE, amplitude: 1.0, freq: 1.0, phase: 0.0, damp: 0.0 };
        assert_eq!(wave.gradient(DVec3::ONE), DVec3::ZERO);
    }
}
