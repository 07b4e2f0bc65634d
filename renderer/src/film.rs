//! From radiance to picture values: clipped to 0..1, then log-scaled. Thesis 7.5.5.1, LOGSCALE.

use glam::DVec3;

#[derive(Clone, Copy, Debug)]
pub struct Film {
    /// Scale of the logarithm; 1 or less has no effect.
    pub log_scale: f64,
}

impl Film {
    /// log(1 + scale v)/log(1 + scale) of each channel.
    pub fn develop(&self, color: DVec3) -> [f32; 3] {
        color.to_array().map(|value| {
            // What is not a number becomes black.
            let value = if value > 0.0 { value.min(1.0) } else { 0.0 };
            let value = if self.log_scale > 1.0 {
                (self.log_scale * value).ln_1p() / self.log_scale.ln_1p()
            } else {
                value
            };
            value as f32
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_stay_and_the_dark_is_lifted() {
        let film = Film { log_scale: 15.0 };
        let [low, mid, high] = film.develop(DVec3::new(-1.0, 0.1, 3.0));
        assert_eq!((low, high), (0.0, 1.0));
        assert!((mid - (2.5f32.ln() / 16f32.ln())).abs() < 1e-6);
        assert_eq!(film.develop(DVec3::splat(f64::NAN)), [0.0; 3]);
        assert_eq!(Film { log_scale: 1.0 }.develop(DVec3::splat(0.25)), [0.25; 3]);
    }
}
