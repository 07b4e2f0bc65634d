//! From radiance to picture values: clipped to 0..1 or scaled by the largest, then log-scaled. Thesis 7.2, -x, and
//! 7.5.5.1, LOGSCALE.

use glam::DVec3;

#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Film {
    /// Scale of the logarithm; 1 or less has no effect.
    pub log_scale: f64,
    /// Whether values are divided by the largest one, once all are known, instead of being clipped at 1.
    pub normalize: bool,
}

impl Film {
    /// The values of a pixel: finished ones, or, where they are to be divided by the largest, as they are.
    pub fn expose(&self, color: DVec3) -> [f32; 3] {
        // What is not a number becomes black.
        let positive = |value: f64| if value > 0.0 { value } else { 0.0 };
        if self.normalize {
            color.to_array().map(|value| positive(value).min(f64::from(f32::MAX)) as f32)
        } else {
            let scale = self.scale();
            color.to_array().map(|value| scale(positive(value).min(1.0)))
        }
    }

    /// Finishes exposed pixels.
    pub fn develop(&self, pixels: &mut [f32]) {
        if self.normalize {
            self.develop_by(pixels.iter().copied().fold(0.0, f32::max), pixels);
        }
    }

    /// Finishes some of the pixels, when this is the largest value of all.
    pub fn develop_by(&self, largest: f32, pixels: &mut [f32]) {
        if self.normalize && largest > 0.0 {
            let scale = self.scale();
            for value in pixels {
                *value = scale((f64::from(*value) / f64::from(largest)).min(1.0));
            }
        }
    }

    /// The function v -> log(1 + scale v)/log(1 + scale).
    fn scale(&self) -> impl Fn(f64) -> f32 {
        let log_scale = self.log_scale;
        let whole = if log_scale > 1.0 { log_scale.ln_1p() } else { 0.0 };
        move |value| {
            if log_scale > 1.0 { ((log_scale * value).ln_1p() / whole) as f32 } else { value as f32 }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_stay_and_the_dark_is_lifted() {
        let film = Film { log_scale: 15.0, normalize: false };
        let [low, mid, high] = film.expose(DVec3::new(-1.0, 0.1, 3.0));
        assert_eq!((low, high), (0.0, 1.0));
        assert!((mid - (2.5f32.ln() / 16f32.ln())).abs() < 1e-6);
        assert_eq!(film.expose(DVec3::splat(f64::NAN)), [0.0; 3]);
        let plain = Film { log_scale: 1.0, normalize: false };
        assert_eq!(plain.expose(DVec3::splat(0.25)), [0.25; 3]);
    }

    #[test]
    fn the_largest_value_becomes_one() {
        let film = Film { log_scale: 0.0, normalize: true };
        let mut pixels =
            [film.expose(DVec3::new(0.5, 4.0, 1.0)), film.expose(DVec3::new(f64::NAN, 2.0, -1.0))];
        film.develop(pixels.as_flattened_mut());
        assert_eq!(pixels, [[0.125, 1.0, 0.25], [0.0, 0.5, 0.0]]);
        let mut infinite = film.expose(DVec3::splat(f64::INFINITY));
        film.develop(&mut infinite);
        assert_eq!(infinite, [1.0; 3]);
        let mut black = [0.0; 3];
        film.develop(&mut black);
        assert_eq!(black, [0.0; 3]);
    }
}
